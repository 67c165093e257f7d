/* test_pattern_normal.c - slope, aoi and bent normals against what POV-Ray
 * shows (tests/oracle/pattern_normals.py prints it). */
#define PHYSICS_DOUBLE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/pattern.h"
#include "core/physics/pattern_bump.h"

enum { SIGHTS = 6, PLACES = 8 };

/* Discs that lean by -80 to 80 degrees, seen along z. */
static real3 lean(int k)
{
    real a = (-80 + 32 * k) * 0.017453292519943295;
    return real3_make(0, sin(a), -cos(a));
}

static void check_slopes(const real *param, const double *want)
{
    for (int k = 0; k < SIGHTS; k++) {
        real3 p = real3_make(k - 2.5, 0, 0);
        real v = wave_value(WAVE_RAMP, 1, 1, 0,
                            pattern_slope(p, lean(k), param));
        assert_float_equal(v, want[k], 3e-5);
    }
}

static void test_pattern_normal__slope(void **state)
{
    (void)state;
    const real plain[] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    const real part[] = {0, 1, 0, 0.25, 1.25, 0, 0, 0, 0, 1, 0};
    const real high[] = {0, 0.5, 0, 0, 1, 2, 0, 0, -8, 8, 0};
    const real point[] = {3, 7, -4, 0, 1, 0, 0, 0, 0, 1, 1};
    check_slopes(plain, (const double[]){0.05555, 0.23333, 0.41112, 0.58888,
                                         0.76666, 0.94445});
    check_slopes(part, (const double[]){0.80554, 0.98335, 0.16111, 0.33890,
                                        0.51666, 0.69443});
    check_slopes(high, (const double[]){0.28612, 0.37167, 0.45722, 0.54278,
                                        0.62835, 0.71390});
    check_slopes(point, (const double[]){0.28093, 0.41182, 0.56992, 0.73980,
                                         0.91050, 0.88860});
}

static void test_pattern_normal__aoi(void **state)
{
    (void)state;
    const double want[] = {0.55555, 0.73333, 0.91112,
                           0.91112, 0.73333, 0.55555};
    for (int k = 0; k < SIGHTS; k++)
        assert_float_equal(pattern_aoi(real3_make(0, 0, 1), lean(k)), want[k],
                           3e-5);
}

/* On the unit sphere, seen along z. */
static real3 place(const double *at)
{
    return real3_make(at[0], at[1], -sqrt(1 - at[0] * at[0] - at[1] * at[1]));
}

/* x, y and the normal there, as a picture tells it. */
static void check_normal(real3 n, const double want[5])
{
    assert_float_equal(n.x, want[2], 1e-4);
    assert_float_equal(n.y, want[3], 1e-4);
    assert_float_equal(n.z, want[4], 1e-4);
}

static void check_facets(const real *param, const double want[PLACES][5])
{
    for (int k = 0; k < PLACES; k++) {
        real3 p = place(want[k]);
        check_normal(pattern_facets(p, p, param), want[k]);
    }
}

static void test_pattern_normal__facets(void **state)
{
    (void)state;
    const double by_half[PLACES][5] = {
        {-0.45, 0.45, -0.48043, 0.33413, -0.81089},
        {0.15, 0.45, -0.09119, 0.41725, -0.90423},
        {-0.15, 0.15, -0.35122, 0.11537, -0.92915},
        {0.45, 0.15, 0.49921, 0.02198, -0.8662},
        {-0.45, -0.15, -0.57073, -0.25871, -0.77932},
        {0.15, -0.15, 0.10285, -0.20958, -0.97237},
        {-0.15, -0.45, -0.2507, -0.39212, -0.88509},
        {0.45, -0.45, 0.53669, -0.44914, -0.7143}};
    const double by_less[PLACES][5] = {
        {-0.45, 0.45, -0.51879, 0.39024, -0.76066},
        {0.15, 0.45, -0.03071, 0.59784, -0.801},
        {-0.15, 0.15, -0.03199, 0.07879, -0.99639},
        {0.45, 0.15, 0.45873, 0.20116, -0.86552},
        {-0.45, -0.15, -0.29516, -0.21766, -0.93034},
        {0.15, -0.15, 0.14541, -0.07487, -0.98655},
        {-0.15, -0.45, -0.18598, -0.38159, -0.90541},
        {0.45, -0.45, 0.52588, -0.41169, -0.74429}};
    const double by_place[PLACES][5] = {
        {-0.45, 0.45, -0.47908, 0.26172, -0.83783},
        {0.15, 0.45, -0.03099, 0.55891, -0.82865},
        {-0.15, 0.15, -0.44582, 0.10246, -0.88923},
        {0.45, 0.15, 0.59861, 0.03527, -0.80026},
        {-0.45, -0.15, -0.39172, -0.11747, -0.91256},
        {0.15, -0.15, 0.28252, 0.04617, -0.95816},
        {-0.15, -0.45, 0.00876, -0.23112, -0.97288},
        {0.45, -0.45, 0.17912, -0.45633, -0.8716}};
    check_facets((const real[]){0.5, 0}, by_half);
    check_facets((const real[]){0.3, 0}, by_less);
    check_facets((const real[]){0, 0.7}, by_place);
}

#define CHECK_PUSH(kind, param, amount, ...)                                   \
    do {                                                                       \
        const double want[PLACES][5] = __VA_ARGS__;                            \
        for (int k = 0; k < PLACES; k++) {                                     \
            real3 p = place(want[k]);                                          \
            real3 push = pattern_push_##kind(p, param);                        \
            check_normal(pattern_pushed(p, amount, push), want[k]);            \
        }                                                                      \
    } while (0)

static void test_pattern_normal__bumps(void **state)
{
    (void)state;
    const real generator[] = {2}, controls[] = {0.25, 0.75};
    real sources[43] = {10, 2, 0.25};
    pattern_wave_sources(10, sources + 3);
    CHECK_PUSH(bumps, generator, 0.4,
               {{-0.45, 0.45, -0.37997, 0.61023, -0.69518},
                {0.15, 0.45, 0.20429, 0.62938, -0.74975},
                {-0.15, 0.15, -0.13367, 0.31783, -0.93866},
                {0.45, 0.15, 0.45074, 0.21325, -0.8668},
                {-0.45, -0.15, -0.39866, -0.04493, -0.91599},
                {0.15, -0.15, 0.02163, -0.23618, -0.97148},
                {-0.15, -0.45, -0.19136, -0.58146, -0.79075},
                {0.45, -0.45, 0.41168, -0.58242, -0.70096}});
    CHECK_PUSH(dents, generator, 1.5,
               {{-0.45, 0.45, -0.3862, 0.59801, -0.70235},
                {0.15, 0.45, 0.18531, 0.5663, -0.8031},
                {-0.15, 0.15, -0.14078, 0.25085, -0.95775},
                {0.45, 0.15, 0.45024, 0.16011, -0.87844},
                {-0.45, -0.15, -0.41245, -0.07205, -0.90814},
                {0.15, -0.15, 0.13041, -0.16358, -0.97788},
                {-0.15, -0.45, -0.1659, -0.5004, -0.84978},
                {0.45, -0.45, 0.43794, -0.49717, -0.74901}});
    CHECK_PUSH(wrinkles, generator, -0.4,
               {{-0.45, 0.45, -0.52407, 0.15586, -0.8373},
                {0.15, 0.45, -0.00491, 0.21682, -0.9762},
                {-0.15, 0.15, -0.23495, -0.07804, -0.96886},
                {0.45, 0.15, 0.21454, 0.05153, -0.97535},
                {-0.45, -0.15, -0.53273, -0.26457, -0.80388},
                {0.15, -0.15, -0.03702, -0.22656, -0.97328},
                {-0.15, -0.45, -0.26423, -0.50045, -0.82445},
                {0.45, -0.45, 0.25248, -0.55172, -0.79489}});
    CHECK_PUSH(quilted, controls, 0.4,
               {{-0.45, 0.45, -0.43537, 0.43535, -0.788},
                {0.15, 0.45, 0.06149, 0.41003, -0.91001},
                {-0.15, 0.15, -0.03135, 0.03136, -0.99901},
                {0.45, 0.15, 0.41003, 0.0615, -0.91},
                {-0.45, -0.15, -0.40999, -0.06146, -0.90999},
                {0.15, -0.15, 0.03136, -0.03137, -0.99902},
                {-0.15, -0.45, -0.0615, -0.41004, -0.91},
                {0.45, -0.45, 0.43534, -0.43536, -0.78802}});
    CHECK_PUSH(ripples, sources, 0.4,
               {{-0.45, 0.45, -0.47916, 0.38247, -0.79004},
                {0.15, 0.45, 0.15726, 0.47969, -0.86324},
                {-0.15, 0.15, -0.16531, 0.22943, -0.9592},
                {0.45, 0.15, 0.47422, 0.18271, -0.86123},
                {-0.45, -0.15, -0.48917, -0.24013, -0.83846},
                {0.15, -0.15, 0.11975, -0.16151, -0.97959},
                {-0.15, -0.45, -0.14702, -0.47382, -0.86828},
                {0.45, -0.45, 0.52961, -0.44201, -0.72396}});
    CHECK_PUSH(waves, sources, 0.4,
               {{-0.45, 0.45, -0.33006, 0.42424, -0.84325},
                {0.15, 0.45, 0.13721, 0.43649, -0.8892},
                {-0.15, 0.15, -0.03848, -0.04229, -0.99836},
                {0.45, 0.15, 0.51177, -0.00746, -0.85911},
                {-0.45, -0.15, -0.24754, 0.04395, -0.96787},
                {0.15, -0.15, 0.14536, 0.00595, -0.98937},
                {-0.15, -0.45, -0.0251, -0.32455, -0.94554},
                {0.45, -0.45, 0.65957, -0.15911, -0.73459}});
}

/* Of any pattern, from its slope. */
static void check_slope(int kind, const real *param, real accuracy,
                        const double want[PLACES][5])
{
    for (int k = 0; k < PLACES; k++) {
        real3 p = place(want[k]), push = real3_make(0, 0, 0);
        for (int i = 0; i < PATTERN_CORNERS; i++) {
            real3 q = real3_mad(p, accuracy, pattern_corner(i));
            real f = wave_value(WAVE_RAMP, 1, 1, 0,
                                pattern_value(kind, q, param));
            push = real3_add(push, pattern_corner_push(i, f, accuracy));
        }
        check_normal(pattern_pushed(p, 0.4, push), want[k]);
    }
}

static void test_pattern_normal__slope_of_a_pattern(void **state)
{
    (void)state;
    const real generator[] = {2};
    const double leopard[PLACES][5] = {
        {-0.45, 0.45, -0.4446, 0.45952, -0.76889},
        {0.15, 0.45, 0.15225, 0.45204, -0.87891},
        {-0.15, 0.15, -0.14103, 0.16052, -0.97691},
        {0.45, 0.15, 0.45209, 0.15217, -0.87892},
        {-0.45, -0.15, -0.44346, -0.13662, -0.88582},
        {0.15, -0.15, 0.16056, -0.14107, -0.97688},
        {-0.15, -0.45, -0.13656, -0.44347, -0.88581},
        {0.45, -0.45, 0.45954, -0.44459, -0.76884}};
    const double bozo[PLACES][5] = {
        {-0.45, 0.45, -0.45951, 0.45252, -0.76424},
        {0.15, 0.45, 0.16501, 0.44195, -0.88173},
        {-0.15, 0.15, -0.13143, 0.12519, -0.9834},
        {0.45, 0.15, 0.45537, 0.13744, -0.87962},
        {-0.45, -0.15, -0.43827, -0.15275, -0.88575},
        {0.15, -0.15, 0.15218, -0.15483, -0.97616},
        {-0.15, -0.45, -0.12802, -0.44623, -0.88569},
        {0.45, -0.45, 0.4372, -0.43888, -0.78498}};
    check_slope(PATTERN_LEOPARD, NULL, 0.02, leopard);
    check_slope(PATTERN_BOZO, generator, 0.1, bozo);
}

/* A normal or a direction of no length is met by some value. */
static void test_pattern_normal__bears_nothing(void **state)
{
    (void)state;
    const real none[11] = {0};
    real3 zero = real3_make(0, 0, 0);
    assert_true(isfinite(pattern_slope(zero, zero, none)));
    assert_true(isfinite(pattern_aoi(zero, zero)));
    assert_true(isfinite(pattern_facets(zero, zero, none).x));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pattern_normal__slope),
        cmocka_unit_test(test_pattern_normal__aoi),
        cmocka_unit_test(test_pattern_normal__facets),
        cmocka_unit_test(test_pattern_normal__bumps),
        cmocka_unit_test(test_pattern_normal__slope_of_a_pattern),
        cmocka_unit_test(test_pattern_normal__bears_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
