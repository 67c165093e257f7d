/* test_diag.c - diagnostics: how they are counted and how they look. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "parser/diag.h"
#include <stdlib.h>
#include <string.h>

static char *written(const struct diag *diag)
{
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    assert_non_null(to);
    diag_write(diag, to);
    fclose(to);
    return text;
}

static void assert_excerpt(const char *line, size_t at, const char *want)
{
    struct arena arena;
    arena_init(&arena, 0);
    char *text = diag_excerpt(&arena, line, line + strlen(line), line + at, 7);
    assert_string_equal(text, want);
    arena_release(&arena);
}

static void test_an_item_in_full(void **state)
{
    (void)state;
    struct diag diag;
    struct diag_item item = {.severity = DIAG_ERROR,
                             .code = BRUME_ERR_FILE,
                             .file = "a.pov",
                             .line = 3,
                             .column = 4,
                             .text = "wrong",
                             .excerpt = "x\n^\n",
                             .trace = "b.pov:1: included from here\n",
                             .hint = "do it"};
    diag_init(&diag);
    diag_add(&diag, &item);
    char *text = written(&diag);
    assert_string_equal(text, "a.pov:3:4: error: wrong\nx\n^\n"
                              "b.pov:1: included from here\nhint: do it\n");
    assert_int_equal(diag.code, BRUME_ERR_FILE);
    struct brume_error err = {0};
    diag_to_error(&diag, &err);
    assert_int_equal(err.code, BRUME_ERR_FILE);
    assert_int_equal(err.line, 3);
    assert_string_equal(err.file, "a.pov");
    assert_string_equal(err.text, "wrong");
    free(text);
    diag_release(&diag);
}

static void test_the_first_error_gives_the_code(void **state)
{
    (void)state;
    struct diag diag;
    diag_init(&diag);
    assert_false(diag_error(&diag, BRUME_ERR_ACCESS, "no %d", 1));
    assert_false(diag_error(&diag, BRUME_ERR_FILE, "no %d", 2));
    assert_int_equal(diag.code, BRUME_ERR_ACCESS);
    assert_int_equal(diag.errors, 2);
    char *text = written(&diag);
    assert_string_equal(text, "error: no 1\nerror: no 2\n");
    free(text);
    diag_release(&diag);
}

static void test_many_warnings_are_counted(void **state)
{
    (void)state;
    struct diag diag;
    diag_init(&diag);
    diag.warning_limit = 2;
    for (int i = 0; i < 5; i++) {
        diag_add(&diag,
                 &(struct diag_item){.severity = DIAG_WARNING, .text = "w"});
    }
    char *text = written(&diag);
    assert_string_equal(text, "warning: w\nwarning: w\n3 more warnings\n");
    assert_int_equal(diag.code, BRUME_OK);
    free(text);
    diag_release(&diag);
}

static void test_excerpts(void **state)
{
    (void)state;
    assert_excerpt("abc", 1, "    7 | abc\n      |  ^\n");
    assert_excerpt("abc", 3, "    7 | abc\n      |    ^\n");
    assert_excerpt("", 0, "    7 | \n      | ^\n");
    assert_excerpt("\tab\tc", 4,
                   "    7 |         ab      c\n"
                   "      |                 ^\n");
    assert_excerpt("\xC3\xA9\x01\xFFx", 4,
                   "    7 | \xC3\xA9??x\n      |    ^\n");
}

/* A long line is cut so that the caret is seen. */
static void test_long_excerpts(void **state)
{
    (void)state;
    char line[100001];
    memset(line, 'a', sizeof line - 1);
    line[sizeof line - 1] = 0;
    line[90000] = 'X';
    struct arena arena;
    arena_init(&arena, 0);
    const char *text = diag_excerpt(&arena, line, line + sizeof line - 1,
                                    line + 90000, 1);
    const char *second = strchr(text, '\n') + 1;
    ptrdiff_t column = strchr(second, '^') - second;
    assert_int_equal(text[column], 'X');
    assert_true(strlen(text) < 200);
    arena_release(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_item_in_full),
        cmocka_unit_test(test_the_first_error_gives_the_code),
        cmocka_unit_test(test_many_warnings_are_counted),
        cmocka_unit_test(test_excerpts), cmocka_unit_test(test_long_excerpts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
