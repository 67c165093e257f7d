/* test_isosurface.c - the walk along isosurfaces where test_solid.c's solids
 * don't lead: odd functions, open ones, gradients too low, a part of a line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>
#include "tests/unit/solids.h"

enum { ROOM = 64 };

struct walked {
    int count, part[ROOM], asked;
    double t[ROOM], steepest;
};

/* Along o + t d from lo to hi. */
static struct walked walk(const double *numbers, size_t count, dvec3 o, dvec3 d,
                          double lo, double hi)
{
    struct walked out = {0};
    struct arena arena;
    struct solid solid;
    isosurface_walk w;

    arena_init(&arena, 0);
    assert_true(build_isosurface(&arena, numbers, count, &solid, NULL));
    isosurface_start(solid.data, o, d, lo, hi, out.t, out.part, ROOM, &w);
    for (; w.asks; out.asked++)
        isosurface_tell(&w, isosurface_function(solid.data, w.p));
    out.count = w.count;
    out.steepest = w.steepest;
    arena_release(&arena);
    return out;
}

#define WALK(numbers, o, d, lo, hi)                                            \
    walk(numbers, sizeof numbers / sizeof *numbers, o, d, lo, hi)

static const dvec3 along_x = {2, 0, 0}, from_left = {-3, 0, 0};

/* All of the container, or nothing of it. */
static void test_isosurface__no_surface(void **state)
{
    (void)state;
    const double full[] = {6, 0, -1, -1, -1, 1, 1, 1, 0, 1e-3, 1, 0};
    const double none[] = {6, 0, -1, -1, -1, 1, 1, 1, -2, 1e-3, 1, 0};
    const double open[] = {6, 0, -1, -1, -1, 1, 1, 1, 0, 1e-3, 1, 1};
    struct walked w = WALK(full, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 2);
    assert_true(w.t[0] == 1 && w.t[1] == 2);
    assert_int_equal(w.part[0], -1);
    assert_int_equal(w.part[1], 1);
    w = WALK(none, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 0);
    w = WALK(open, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 0);
}

/* A ball in a smaller one: the caps are the container's, or not there. */
static void test_isosurface__container(void **state)
{
    (void)state;
    double cut[] = {0, 1, 0.5, 0, 0, 1, 0, 0, 0, 1e-3, 5, 0};
    struct walked w = WALK(cut, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 2);
    assert_true(fabs(w.t[0] - 1.25) < 1e-12 && fabs(w.t[1] - 2) < 1e-6);
    assert_int_equal(w.part[0], ISOSURFACE_BALL);
    assert_int_equal(w.part[1], ISOSURFACE_SURFACE);
    cut[11] = 1;
    w = WALK(cut, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 1);
    assert_true(fabs(w.t[0] - 2) < 1e-6);
}

/* A value that is no number ends nothing, and is outside. */
static void test_isosurface__not_a_number(void **state)
{
    (void)state;
    const double nan[] = {4, 0, -1, -1, -1, 1, 1, 1, 0, 1e-3, 1, 0};
    struct walked w = WALK(nan, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 0);
    assert_in_range(w.asked, 1, 5000);
}

/* An accuracy beyond all need and a gradient beyond all bounds end too. */
static void test_isosurface__endless(void **state)
{
    (void)state;
    const double fine[] = {0, 0, -1, -1, -1, 1, 1, 1, -2, 1e-30, 1e300, 0};
    struct walked w = WALK(fine, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 0);
    assert_in_range(w.asked, 1, 2 * ISOSURFACE_ASKED);
}

/* The torus along x crosses four times, with slopes up to 0.6: a gradient too
 * low oversees them, one that adapts does not; the slope is told. */
static void test_isosurface__gradient(void **state)
{
    (void)state;
    const double high[] = {1, 0, -2, -2, -2, 2, 2, 2, 0, 1e-4, 3, 0};
    const double low[] = {1, 0, -2, -2, -2, 2, 2, 2, 0, 1e-4, 0.01, 0};
    const double adapts[] = {1, 0,    -2,   -2, -2,  2, 2, 2,
                             0, 1e-4, 0.01, 0,  1.5, 2, 1};
    const double at[] = {-1, -0.4, 0.4, 1};
    struct walked w = WALK(high, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 4);
    for (int i = 0; i < 4; i++)
        assert_true(fabs(w.t[i] - 0.5 * (3 + at[i])) < 1e-7);
    assert_true(w.steepest > 0.5 && w.steepest < 2.7);
    w = WALK(low, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 0);
    w = WALK(adapts, from_left, along_x, -INFINITY, INFINITY);
    assert_int_equal(w.count, 4);
}

/* The three numbers of `evaluate`: where the gradient begins and what it never
 * falls below, how far beyond a steeper slope it goes, and how much of what is
 * beyond a lesser one it keeps. */
static void test_isosurface__evaluate(void **state)
{
    (void)state;
    double data[ISOSURFACE_DATA] = {0};
    const double factors[3] = {1.5, 2, 0.5};
    isosurface_walk w = {.data = data, .gradient = 1.5};

    data[ISOSURFACE_ADAPTS] = 1;
    memcpy(data + ISOSURFACE_FACTORS, factors, sizeof factors);
    isosurface_adapt(&w, 4);
    assert_true(w.gradient == 8);
    isosurface_adapt(&w, 4);
    assert_true(w.gradient == 6);
    isosurface_adapt(&w, 1);
    assert_true(w.gradient == 3.5);
    isosurface_adapt(&w, 0);
    isosurface_adapt(&w, 0);
    assert_true(w.gradient == 1.5);
    data[ISOSURFACE_ADAPTS] = 0;
    isosurface_adapt(&w, 4);
    assert_true(w.gradient == 1.5 && w.steepest == 4);
}

/* What is asked of a walk shows them: a higher least gradient and a greater
 * excess look closer, forgetting sooner looks less. */
static void test_isosurface__evaluate_costs(void **state)
{
    (void)state;
    const double factors[4][3] = {
        {1, 1.5, 0.9}, {3, 1.5, 0.9}, {1, 6, 0.9}, {1, 1.5, 0}};
    int asked[4];

    for (int i = 0; i < 4; i++) {
        double torus[15] = {1, 0, -2, -2, -2, 2, 2, 2, 0, 1e-4, 0.01, 0};
        memcpy(torus + 12, factors[i], sizeof factors[i]);
        asked[i] = WALK(torus, from_left, along_x, -INFINITY, INFINITY).asked;
    }
    assert_true(asked[1] > asked[0]);
    assert_true(asked[2] > asked[0]);
    assert_true(asked[3] < asked[0]);
}

/* A distance has the slope 1 wherever one looks from: with that gradient none
 * of its small balls is lost, with less they are. */
static void test_isosurface__distance(void **state)
{
    (void)state;
    int lost = 0;
    for (int i = 0; i < 100; i++) {
        double ball[] = {5, 0, -1, -1, -1, 1 + 0.01 * i, 1, 1, 0, 1e-3, 1, 0};
        struct walked w = WALK(ball, from_left, along_x, -INFINITY, INFINITY);
        assert_int_equal(w.count, 2);
        assert_true(fabs(w.t[0] - 1.475) < 1e-7);
        ball[10] = 0.7;
        lost += WALK(ball, from_left, along_x, -INFINITY, INFINITY).count == 0;
    }
    assert_true(lost > 50);
}

/* Half of the line: what is inside at its end has no crossing there. */
static void test_isosurface__part_of_line(void **state)
{
    (void)state;
    const double torus[] = {1, 0, -2, -2, -2, 2, 2, 2, 0, 1e-4, 3, 0};
    struct walked w = WALK(torus, from_left, along_x, 1.5, INFINITY);
    assert_int_equal(w.count, 2);
    assert_true(fabs(w.t[0] - 1.7) < 1e-7);
    w = WALK(torus, from_left, along_x, 1.2, INFINITY);
    assert_int_equal(w.count, 3);
    assert_true(fabs(w.t[0] - 1.3) < 1e-7);
    w = WALK(torus, from_left, along_x, -INFINITY, 1.8);
    assert_int_equal(w.count, 3);
    w = WALK(torus, from_left, along_x, 3, 2);
    assert_int_equal(w.count, 0);
    assert_int_equal(w.asked, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_isosurface__no_surface),
        cmocka_unit_test(test_isosurface__container),
        cmocka_unit_test(test_isosurface__not_a_number),
        cmocka_unit_test(test_isosurface__endless),
        cmocka_unit_test(test_isosurface__gradient),
        cmocka_unit_test(test_isosurface__evaluate),
        cmocka_unit_test(test_isosurface__evaluate_costs),
        cmocka_unit_test(test_isosurface__distance),
        cmocka_unit_test(test_isosurface__part_of_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
