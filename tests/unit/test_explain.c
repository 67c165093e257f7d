#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "parser/explain.h"

static const struct brume_plan plan = {
    .stages = 2,
    .notes = 2,
    .stage =
        {
            {"load", true,
             "two media read grids, which are long enough to be "
             "told of in more than one line",
             5 << 20},
            {"accel", false, "there is no geometry", 0},
        },
    .note = {"fire.vdb: density 0 to 1.5", "kelvin 300 to 1800"},
};

static void test_explain__text(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    explain_text(&plan, to);
    fclose(to);
    assert_string_equal(
        text,
        "stage       runs    memory  because\n"
        "load        yes      5 MiB  two media read grids, which are long "
        "enough to be\n"
        "                            told of in more than one line\n"
        "accel       no           -  there is no geometry\n"
        "\n"
        "fire.vdb: density 0 to 1.5\n"
        "kelvin 300 to 1800\n");
    free(text);
}

static void test_explain__json(void **state)
{
    (void)state;
    struct brume_error err = {0};
    char *text = explain_json(&plan, &err);
    assert_non_null(text);
    assert_non_null(strstr(text, "\"name\": \"load\""));
    assert_non_null(strstr(text, "\"bytes\": 5242880"));
    assert_non_null(strstr(text, "\"runs\": false"));
    assert_non_null(strstr(text, "\"kelvin 300 to 1800\""));
    free(text);
}

static void assert_bytes(uint64_t bytes, const char *expected)
{
    char out[32];
    assert_string_equal(explain_bytes(bytes, out, sizeof out), expected);
}

static void test_explain__bytes(void **state)
{
    (void)state;
    assert_bytes(0, "0 B");
    assert_bytes(999, "999 B");
    assert_bytes(1000, "0.977 KiB");
    assert_bytes(1536, "1.5 KiB");
    assert_bytes(1023u << 10, "0.999 MiB");
    assert_bytes(UINT64_MAX, "1.68e+07 TiB");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_explain__text),
        cmocka_unit_test(test_explain__json),
        cmocka_unit_test(test_explain__bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
