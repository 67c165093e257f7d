/* test_pattern_normal.c - slope, aoi and facets against what POV-Ray shows
 * (tests/oracle/pattern_normals.py prints it). */
#define PHYSICS_DOUBLE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/pattern_normal.h"

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

/* On the unit sphere, seen along z: x, y and the normal there. */
static void check_facets(const real *param, const double want[PLACES][5])
{
    for (int k = 0; k < PLACES; k++) {
        real x = want[k][0], y = want[k][1];
        real3 p = real3_make(x, y, -sqrt(1 - x * x - y * y));
        real3 n = pattern_facets(p, p, param);
        assert_float_equal(n.x, want[k][2], 1e-4);
        assert_float_equal(n.y, want[k][3], 1e-4);
        assert_float_equal(n.z, want[k][4], 1e-4);
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
        cmocka_unit_test(test_pattern_normal__bears_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
