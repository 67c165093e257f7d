/* Parts of pictures that are kept, and found again. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/origins.h"
#include "parser/partial.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FRAME = 7, SIZE = 1 << 25 };

struct kept {
    char picture[64], part[72], scene[64];
    struct partial_list *list;
    struct parse_origins origins;
};

static void write_text(const char *path, const char *text)
{
    FILE *to = fopen(path, "wb");
    assert_non_null(to);
    assert_true(fputs(text, to) >= 0);
    assert_int_equal(fclose(to), 0);
}

static void begin(struct kept *k)
{
    struct brume_error err = {0};
    memset(k, 0, sizeof *k);
    snprintf(k->picture, sizeof k->picture, "partial-%ld.png", (long)getpid());
    snprintf(k->part, sizeof k->part, "%s.part", k->picture);
    snprintf(k->scene, sizeof k->scene, "partial-%ld.pov", (long)getpid());
    write_text(k->scene, "sphere { 0, 1 }");
    origins_add(&k->origins, k->scene);
    k->list = partial_new(&err);
    assert_non_null(k->list);
    partial_begin(k->list, FRAME, k->picture, 1, &k->origins, true);
}

static void end(struct kept *k)
{
    partial_end(k->list, FRAME, false);
    partial_free(k->list);
    parse_origins_release(&k->origins);
    unlink(k->scene);
    assert_int_not_equal(access(k->part, F_OK), 0);
}

static void save(const struct kept *k, char *pixel, double seconds)
{
    const struct brume_keeper *keeper = partial_keeper(k->list);
    struct brume_part part = {.backend = "cpu",
                              .samples = 3,
                              .pixel = pixel,
                              .bytes = SIZE,
                              .seconds = seconds};
    memset(pixel, 42, SIZE);
    keeper->save(keeper->user, FRAME, &part);
}

static bool load(const struct kept *k, char *pixel)
{
    const struct brume_keeper *keeper = partial_keeper(k->list);
    struct brume_part part = {.backend = "cpu", .pixel = pixel, .bytes = SIZE};
    memset(pixel, 0, SIZE);
    return keeper->load(keeper->user, FRAME, &part) && part.samples == 3 &&
           pixel[0] == 42 && pixel[SIZE - 1] == 42;
}

static void partial__is_found_again(void **state)
{
    struct kept k;
    char *pixel = malloc(SIZE);
    (void)state;
    assert_non_null(pixel);
    begin(&k);
    assert_false(load(&k, pixel));
    save(&k, pixel, 0.0);
    assert_true(load(&k, pixel));
    save(&k, pixel, 60.0);
    assert_true(load(&k, pixel));
    end(&k);
    free(pixel);
}

/* What was kept before stays. */
static void partial__is_not_kept_too_late(void **state)
{
    struct kept k;
    char *pixel = malloc(SIZE);
    (void)state;
    assert_non_null(pixel);
    begin(&k);
    save(&k, pixel, 1e-9);
    assert_int_not_equal(access(k.part, F_OK), 0);
    save(&k, pixel, 0.0);
    save(&k, pixel, 1e-9);
    assert_true(load(&k, pixel));
    end(&k);
    free(pixel);
}

/* It would be taken for one of what the file holds now. */
static void partial__is_of_files_as_they_were_read(void **state)
{
    struct kept k;
    char *pixel = malloc(SIZE);
    (void)state;
    assert_non_null(pixel);
    begin(&k);
    write_text(k.scene, "sphere { 0, 2 } /* changed */");
    save(&k, pixel, 0.0);
    assert_int_not_equal(access(k.part, F_OK), 0);
    end(&k);
    begin(&k);
    save(&k, pixel, 0.0);
    write_text(k.scene, "sphere { 0, 3 } /* changed */");
    assert_false(load(&k, pixel));
    end(&k);
    free(pixel);
}

/* One that is torn is none, and nothing of it is left in the picture. */
static void partial__that_is_torn_leaves_nothing(void **state)
{
    struct kept k;
    char *pixel = malloc(SIZE);
    (void)state;
    assert_non_null(pixel);
    begin(&k);
    save(&k, pixel, 0.0);
    FILE *part = fopen(k.part, "r+b");
    assert_non_null(part);
    assert_int_equal(fseek(part, -1, SEEK_END), 0);
    assert_int_equal(fputc(7, part), 7);
    assert_int_equal(fclose(part), 0);
    assert_false(load(&k, pixel));
    for (size_t i = 0; i < SIZE; i++)
        assert_int_equal(pixel[i], 0);
    end(&k);
    free(pixel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(partial__is_found_again),
        cmocka_unit_test(partial__is_not_kept_too_late),
        cmocka_unit_test(partial__is_of_files_as_they_were_read),
        cmocka_unit_test(partial__that_is_torn_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
