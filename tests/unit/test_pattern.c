/* test_pattern.c - patterns in double against values printed by POV-Ray, and
 * what they give for points that are out of bounds. */
#define PHYSICS_DOUBLE
#include "pattern_cases.h"

static void test_pattern__are_those_of_povray(void **state)
{
    (void)state;
    check_cases(1e9, 1e-8, 1);
}

static void test_pattern__are_finite_anywhere(void **state)
{
    (void)state;
    const real far[] = {0,     -0.5,     1e9,       -3e10, 1e30,
                        1e300, INFINITY, -INFINITY, NAN};
    enum { FAR = sizeof far / sizeof *far };
    for (int kind = 0; kind < PATTERN_COUNT; kind++) {
        real param[CASE_NUMBERS] = {2, 1, 2, 3, 0.5, 1};
        if (kind == PATTERN_RIPPLES || kind == PATTERN_WAVES)
            pattern_wave_sources(2, param + 3);
        for (int i = 0; i < FAR * FAR * FAR; i++) {
            real3 p = real3_make(far[i % FAR], far[i / FAR % FAR],
                                 far[i / FAR / FAR]);
            real v = pattern_value(kind, p, param);
            for (int wave = 0; wave < WAVE_COUNT; wave++)
                assert_true(isfinite(wave_value(wave, 0.5, 2, 0.25, v)));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pattern__are_those_of_povray),
        cmocka_unit_test(test_pattern__are_finite_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
