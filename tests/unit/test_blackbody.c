/* test_blackbody.c - the table against the sum that fills it, and the sum
 * against published colours. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/blackbody.h"

static int setup(void **state)
{
    static blackbody_table table;
    blackbody_fill(&table);
    *state = &table;
    return 0;
}

/* Kelvin; x, y; Y in cd/m2; R, G, B over Y. */
static const double rows[][7] = {
    {1000, 0.65275, 0.34446, 2.6870, 4.60018, 0.03960, -0.09000},
    {1500, 0.58572, 0.39312, 7740.3, 3.26455, 0.43411, -0.06420},
    {2000, 0.52668, 0.41330, 4.6376e+05, 2.52027, 0.64687, 0.02042},
    {2500, 0.47699, 0.41368, 5.6238e+06, 2.06788, 0.76935, 0.13951},
    {2856, 0.44753, 0.40743, 1.975e+07, 1.84513, 0.82611, 0.23339},
    {3000, 0.43693, 0.40407, 3.0218e+07, 1.77093, 0.84426, 0.27207},
    {4000, 0.38044, 0.37675, 2.5281e+08, 1.41400, 0.92401, 0.53342},
    {6500, 0.31353, 0.32363, 3.0725e+09, 1.04338, 0.98357, 1.03498},
    {10000, 0.28063, 0.28829, 1.326e+10, 0.87196, 0.99459, 1.43069},
    {40000, 0.24720, 0.24472, 1.8347e+11, 0.70128, 0.98316, 2.04670},
};
enum { ROWS = sizeof rows / sizeof *rows };

static void test_blackbody__chromaticity(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        double c[3];
        blackbody_xyz(rows[i][0], c);
        double sum = c[0] + c[1] + c[2];
        assert_true(fabs(c[0] / sum - rows[i][1]) < 6e-6);
        assert_true(fabs(c[1] / sum - rows[i][2]) < 6e-6);
        assert_true(fabs(c[1] / rows[i][3] - 1) < 4e-5);
    }
}

static void test_blackbody__rec709(void **state)
{
    const blackbody_table *t = *state;
    for (int i = 0; i < ROWS; i++) {
        rgb c = blackbody_rgb(t, (float)rows[i][0]);
        double y = blackbody_luminance(t, (float)rows[i][0]);
        assert_true(fabs(y * BLACKBODY_UNIT / rows[i][3] - 1) < 4e-5);
        assert_true(fabs(c.r / y - rows[i][4]) < 3e-5);
        assert_true(fabs(c.g / y - rows[i][5]) < 3e-5);
        assert_true(fabs(c.b / y - rows[i][6]) < 3e-5);
    }
}

/* X, Y and Z back from Rec.709. */
static void xyz_of(rgb c, double xyz[3])
{
    xyz[0] = 0.41239080 * c.r + 0.35758434 * c.g + 0.18048079 * c.b;
    xyz[1] = 0.21263901 * c.r + 0.71516868 * c.g + 0.07219232 * c.b;
    xyz[2] = 0.01933082 * c.r + 0.11919478 * c.g + 0.95053215 * c.b;
}

/* The largest error of X, Y or Z from lo to hi kelvin, relative to X + Z:
 * by way of Rec.709 a small Z has lost digits. */
static double worst(const blackbody_table *t, double lo, double hi)
{
    double most = 0;
    for (double kelvin = lo; kelvin <= hi; kelvin *= 1.0013) {
        double truth[3], got[3];
        blackbody_xyz((float)kelvin, truth);
        xyz_of(blackbody_rgb(t, (float)kelvin), got);
        for (int k = 0; k < 3; k++)
            most = fmax(most, fabs(got[k] * BLACKBODY_UNIT - truth[k]) /
                                  (truth[0] + truth[2]));
    }
    print_message("%g to %g K: %.2e\n", lo, hi, most);
    return most;
}

static void test_blackbody__interpolation(void **state)
{
    assert_true(worst(*state, 500, 1000) < 2e-6);
    assert_true(worst(*state, 1000, 3000) < 1e-6);
    assert_true(worst(*state, 3000, 40000) < 6e-7);
    assert_true(worst(*state, 40000, 1e12) < 6e-7);
}

static bool is_black(const blackbody_table *t, float kelvin)
{
    return rgb_is_black(blackbody_rgb(t, kelvin));
}

static void test_blackbody__ends(void **state)
{
    const blackbody_table *t = *state;
    assert_true(is_black(t, 0) && is_black(t, -300) && is_black(t, NAN));
    assert_true(is_black(t, 499.99f) && is_black(t, -INFINITY));
    assert_true(blackbody_luminance(t, 500) > 0);
    double tail = blackbody_luminance(t, 1e9f) / 1e9;
    assert_true(fabs(blackbody_luminance(t, 1e12f) / 1e12 / tail - 1) < 2e-5);
    assert_true(isfinite(blackbody_rgb(t, INFINITY).b));
    assert_true(blackbody_rgb(t, 1000).b < 0);
}

static void test_blackbody__grows(void **state)
{
    const blackbody_table *t = *state;
    double last = 0;
    for (float kelvin = 500; kelvin < 1e6f; kelvin *= 1.0001f) {
        double y = blackbody_luminance(t, kelvin);
        assert_true(y > last);
        last = y;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blackbody__chromaticity),
        cmocka_unit_test(test_blackbody__rec709),
        cmocka_unit_test(test_blackbody__interpolation),
        cmocka_unit_test(test_blackbody__ends),
        cmocka_unit_test(test_blackbody__grows),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
