/* test_warp_pattern.c - warps in double against points of POV-Ray's
 * (tests/oracle/patterns.py), and what they do to points out of bounds. */
#define PHYSICS_DOUBLE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <string.h>
#include "core/physics/pattern_warp.h"

enum { POINTS = 64, NUMBERS = 16 };

static int kind_of(const char *name)
{
#define X(function, constant, numbers)                                         \
    if (strcmp(name, #function) == 0)                                          \
        return WARP_##constant;
    WARP_KINDS(X)
#undef X
    fail_msg("unknown warp %s", name);
    return -1;
}

static real3 read_point(FILE *file)
{
    real3 p;
    assert_int_equal(fscanf(file, "%lf %lf %lf", &p.x, &p.y, &p.z), 3);
    return p;
}

static double distance(real3 a, real3 b)
{
    return real3_length(real3_sub(a, b));
}

static void test_warp_pattern__are_those_of_povray(void **state)
{
    (void)state;
    FILE *file = fopen("tests/data/warps.txt", "r");
    char name[16];
    int count, cases = 0, seen[WARP_COUNT] = {0};
    real3 p[POINTS];
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%d", &count), 1);
    for (int i = 0; i < count; i++)
        p[i] = read_point(file);
    for (; fscanf(file, "%15s", name) == 1; cases++) {
        int kind = kind_of(name);
        real param[NUMBERS];
        for (int i = 0; i < pattern_warp_numbers(kind); i++)
            assert_int_equal(fscanf(file, "%lf", &param[i]), 1);
        for (int i = 0; i < count; i++) {
            real3 want = read_point(file);
            real3 is = pattern_warp(kind, p[i], param);
            if (distance(is, want) > 1e-8)
                fail_msg("case %d, point %d: %.9g %.9g %.9g", cases, i, is.x,
                         is.y, is.z);
        }
        seen[kind] = 1;
    }
    fclose(file);
    for (int kind = 0; kind < WARP_COUNT; kind++)
        assert_true(seen[kind]);
}

/* Nothing but the values is undefined: the sanitizers watch. */
static void test_warp_pattern__bear_any_point(void **state)
{
    (void)state;
    const real far[] = {0, -0.5, 3e10, 1e300, -INFINITY, NAN};
    enum { FAR = sizeof far / sizeof *far };
    const real param[NUMBERS] = {1, 2, 0.5, 1, 0.5, 1, 0, 2, 2, 2, 1, 1, 1, 1};
    for (int kind = 0; kind < WARP_COUNT; kind++)
        for (int i = 0; i < FAR * FAR * FAR; i++) {
            real3 p = real3_make(far[i % FAR], far[i / FAR % FAR],
                                 far[i / FAR / FAR]);
            p = pattern_warp(kind, p, param);
            real v = pattern_bozo(p, (const real[]){2});
            assert_true(v >= 0 && v <= 1);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_warp_pattern__are_those_of_povray),
        cmocka_unit_test(test_warp_pattern__bear_any_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
