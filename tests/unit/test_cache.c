/* What is kept of data files from scene to scene. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
#include <cmocka.h>
#include "parser/cache.h"

static int released;

static void release(void *item)
{
    released += *(int *)item;
}

static char path[] = "/tmp/brume-test-cache-XXXXXX";

static void write_file(const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void cache__keeps_what_is_asked_for(void **state)
{
    (void)state;
    struct brume_error err = {0};
    int one = 1, ten = 10;
    struct parse_cache *cache = parse_cache_new(&err);
    assert_non_null(cache);
    close(mkstemp(path));
    write_file("a");
    usleep(150000);
    cache_begin(cache);
    assert_null(cache_find(cache, path, "key"));
    assert_true(cache_put(cache, path, "key", &one, release));
    assert_true(cache_put(cache, path, "other", &ten, release));
    cache_end(cache);
    assert_int_equal(released, 0);
    /* The next scene asks for one of them: the other goes. */
    cache_begin(cache);
    assert_ptr_equal(cache_find(cache, path, "key"), &one);
    cache_end(cache);
    assert_int_equal(released, 10);
    /* A file that changed is another one. */
    write_file("longer");
    cache_begin(cache);
    assert_null(cache_find(cache, path, "key"));
    cache_end(cache);
    assert_int_equal(released, 11);
    /* It might be changed again before a clock ticks. */
    write_file("other");
    assert_false(cache_put(cache, path, "key", &one, release));
    usleep(150000);
    cache_begin(cache);
    assert_true(cache_put(cache, path, "key", &one, release));
    parse_cache_free(cache);
    assert_int_equal(released, 12);
    unlink(path);
}

static void cache__may_be_none(void **state)
{
    (void)state;
    int one = 1;
    cache_begin(NULL);
    assert_null(cache_find(NULL, "/", "key"));
    assert_false(cache_put(NULL, "/", "key", &one, release));
    cache_end(NULL);
    parse_cache_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cache__keeps_what_is_asked_for),
        cmocka_unit_test(cache__may_be_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
