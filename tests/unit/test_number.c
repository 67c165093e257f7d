/* test_number.c - decimal numbers against strtod. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "lib/number.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void test_number__as_strtod(void **state)
{
    (void)state;
    static const char *const texts[] = {"0",
                                        "1.",
                                        ".5",
                                        "007",
                                        "1.5e3",
                                        "2.5E-2",
                                        "1e+5",
                                        "1e-400",
                                        "1e400",
                                        "9007199254740993",
                                        "9007199254740992.5",
                                        "1e22",
                                        "1e23",
                                        "1e-22",
                                        "123456789012345678901234567890",
                                        "0.000000000000000000000000000001",
                                        "2.2250738585072011e-308",
                                        "4.9e-324",
                                        "1.7976931348623157e308",
                                        "0.1e99999999999",
                                        "0e99999999999",
                                        "179769313486231580793e289"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        double value = -1;
        const char *end = number_read(texts[i], &value);
        assert_ptr_equal(end, texts[i] + strlen(texts[i]));
        assert_true(value == strtod(texts[i], NULL));
    }
}

/* Digits and exponents of every length, from a fixed stream. */
static void test_number__many(void **state)
{
    (void)state;
    uint64_t x = 88172645463325252u;
    for (int i = 0; i < 200000; i++) {
        char text[64];
        double value = -1;
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        snprintf(text, sizeof text, "%llu.%0*llue%d",
                 (unsigned long long)(x >> (x & 63)), (int)(x >> 8 & 7) + 1,
                 (unsigned long long)(x >> 40), (int)(x >> 20 & 63) - 32);
        assert_ptr_equal(number_read(text, &value), text + strlen(text));
        assert_true(value == strtod(text, NULL));
    }
}

static void test_number__ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int length;
        double value;
    } cases[] = {{"1.5.5", 3, 1.5}, {"12x", 2, 12},   {"1e", 1, 1},
                 {"1e+", 1, 1},     {"1..2", 2, 1},   {"0x10", 1, 0},
                 {"3,4", 1, 3},     {"5e2e3", 3, 500}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value;
        assert_ptr_equal(number_read(cases[i].text, &value),
                         cases[i].text + cases[i].length);
        assert_true(value == cases[i].value);
    }
    static const char *const none[] = {"", ".", "-1", "+1", "x", " 1", "e5"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        double value;
        assert_null(number_read(none[i], &value));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_number__as_strtod),
        cmocka_unit_test(test_number__many),
        cmocka_unit_test(test_number__ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
