/* test_fmath.c - the polynomials against the C library in double. Every
 * FM_STRIDE-th float is tried (environment; 1 tries them all). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>
#include "core/physics/fmath.h"

static uint32_t stride(void)
{
    const char *text = getenv("FM_STRIDE");
    return text ? (uint32_t)atoi(text) : 2503u;
}

/* Distance in units of the last place that `truth` has as a float. */
static double ulps(float got, double truth)
{
    float near = (float)truth;
    if (isnan(truth) || isnan(got))
        return isnan(truth) && isnan(got) ? 0.0 : INFINITY;
    if (got == near)
        return isinf(near)
                   ? 0.0
                   : fabs(got - truth) /
                         ldexp(1.0,
                               fmax(ilogb(truth == 0.0 ? 1.0 : truth), -126) -
                                   23);
    if (isinf(near) && fabsf(got) == HUGE_VALF)
        return INFINITY;
    if (isinf(near) || isinf(got))
        return fabs(truth) > 3.4028235e38 * (1.0 - 1e-6) ? 1.0 : INFINITY;
    int e = truth == 0.0 ? -126 : ilogb(truth);
    return fabs(got - truth) / ldexp(1.0, (e < -126 ? -126 : e) - 23);
}

/* The largest error in ulps over all floats in [lo, hi], both signs. */
static double worst(const char *name, float (*f)(float),
                    double (*truth)(double), double lo, double hi)
{
    double most = 0.0;
    uint32_t at = 0;
    const uint32_t step = stride();
    for (uint64_t u = 0; u <= 0xffffffffu; u += step) {
        float x = fm_from_bits((uint32_t)u);
        if (!(x >= lo && x <= hi))
            continue;
        double e = ulps(f(x), truth(x));
        if (e > most) {
            most = e;
            at = (uint32_t)u;
        }
    }
    print_message("%s: %.3f ulp at %a\n", name, most, fm_from_bits(at));
    return most;
}

/* clang-format off */
static float exp_f(float x) { return fm_exp(x); }
static float expm1_f(float x) { return fm_expm1(x); }
static float log_f(float x) { return fm_log(x); }
static float log1p_f(float x) { return fm_log1p(x); }
static float sin_f(float x) { return fm_sin(x); }
static float cos_f(float x) { return fm_cos(x); }
static float acos_f(float x) { return fm_acos(x); }
static float atan_f(float x) { return fm_atan2(x, 1.0f); }
/* clang-format on */

static void test_ulps(void **state)
{
    (void)state;
    const double inf = INFINITY;
    assert_true(worst("exp", exp_f, exp, -inf, inf) <= 1.0);
    assert_true(worst("expm1", expm1_f, expm1, -inf, inf) <= 1.5);
    assert_true(worst("log", log_f, log, -inf, inf) <= 1.0);
    assert_true(worst("log1p", log1p_f, log1p, -inf, inf) <= 1.0);
    assert_true(worst("sin", sin_f, sin, -inf, inf) <= 3.0);
    assert_true(worst("cos", cos_f, cos, -inf, inf) <= 3.0);
    assert_true(worst("acos", acos_f, acos, -inf, inf) <= 2.0);
    assert_true(worst("atan", atan_f, atan, -inf, inf) <= 2.0);
}

/* A linear congruential generator: the tests must not need rng.h. */
static uint32_t next_u32(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state ^ *state >> 15;
}

static float uniform(uint32_t *state, float lo, float hi)
{
    return lo + (hi - lo) * (float)(next_u32(state) >> 8) * 0x1p-24f;
}

static void test_sincos_absolute(void **state)
{
    (void)state;
    uint32_t seed = 1;
    double most = 0.0;
    for (int i = 0; i < 2000000; i++) {
        float s, c, x = uniform(&seed, -10000.0f, 10000.0f);
        fm_sincos(x, &s, &c);
        most = fmax(most, fmax(fabs(s - sin(x)), fabs(c - cos(x))));
    }
    print_message("sin, cos: %.3g absolute\n", most);
    assert_true(most <= 1e-7);
}

/* Over random bases in (0, 10), then any positive float, with powers that
 * stay in range. */
static void test_pow_ulps(void **state)
{
    (void)state;
    uint32_t seed = 2;
    double plain = 0.0, wild = 0.0;
    for (int i = 0; i < 4000000; i++) {
        float x = uniform(&seed, 0.0f, 10.0f);
        float y = uniform(&seed, -30.0f, 30.0f);
        plain = fmax(plain, ulps(fm_pow(x, y), pow(x, y)));
        x = fm_from_bits(next_u32(&seed) >> 1);
        y = uniform(&seed, -150.0f, 150.0f) / (float)log2(x);
        if (isfinite(x) && isfinite(y))
            wild = fmax(wild, ulps(fm_pow(x, y), pow(x, y)));
    }
    print_message("pow: %.3f ulp, over all floats %.3f\n", plain, wild);
    assert_true(plain <= 1.5);
    assert_true(wild <= 6.0);
}

static void test_atan2_ulps(void **state)
{
    (void)state;
    uint32_t seed = 3;
    double most = 0.0;
    for (int i = 0; i < 4000000; i++) {
        float x = uniform(&seed, -1.0f, 1.0f), y = uniform(&seed, -1.0f, 1.0f);
        most = fmax(most, ulps(fm_atan2(y, x), atan2(y, x)));
    }
    print_message("atan2: %.3f ulp\n", most);
    assert_true(most <= 2.5);
}

static void check_nan_and_ends(void)
{
    assert_true(isnan(fm_exp(NAN)) && isnan(fm_expm1(NAN)));
    assert_true(isnan(fm_log(NAN)) && isnan(fm_log1p(NAN)));
    assert_true(isnan(fm_sin(NAN)) && isnan(fm_cos(INFINITY)));
    assert_true(isnan(fm_acos(NAN)) && isnan(fm_acos(1.0000001f)));
    assert_true(isnan(fm_atan2(NAN, 1.0f)) && isnan(fm_atan2(1.0f, NAN)));
    assert_true(isnan(fm_pow(NAN, 2.0f)) && isnan(fm_pow(2.0f, NAN)));
    assert_true(isnan(fm_log(-1.0f)) && isnan(fm_log1p(-2.0f)));
}

static void test_specials(void **state)
{
    (void)state;
    check_nan_and_ends();
    assert_true(fm_exp(-INFINITY) == 0.0f && fm_exp(-104.1f) == 0.0f);
    assert_true(fm_exp(-103.0f) == (float)exp(-103.0));
    assert_true(fm_exp(0.0f) == 1.0f && fm_exp(INFINITY) == INFINITY);
    assert_true(fm_exp(88.8f) == INFINITY && fm_exp(88.7f) < INFINITY);
    assert_true(fm_expm1(-INFINITY) == -1.0f);
    assert_true(fm_expm1(INFINITY) == INFINITY && fm_expm1(0.0f) == 0.0f);
    assert_true(fm_expm1(1e-30f) == 1e-30f);
    assert_true(fm_log(0.0f) == -INFINITY && fm_log(1.0f) == 0.0f);
    assert_true(fm_log(INFINITY) == INFINITY);
    assert_true(fm_log1p(-1.0f) == -INFINITY && fm_log1p(0.0f) == 0.0f);
    assert_true(fm_log1p(1e-30f) == 1e-30f);
    assert_true(fm_log1p(INFINITY) == INFINITY);
    assert_true(fm_sin(0.0f) == 0.0f && fm_cos(0.0f) == 1.0f);
    assert_true(fm_acos(1.0f) == 0.0f && fm_acos(-1.0f) == (float)M_PI);
}

static void test_atan2_specials(void **state)
{
    (void)state;
    const float v[] = {0.0f,      -0.0f,  1.0f,  -1.0f, INFINITY,
                       -INFINITY, 1e-45f, 3e38f, -3e38f};
    const int n = (int)(sizeof v / sizeof *v);
    for (int i = 0; i < n * n; i++) {
        float y = v[i / n], x = v[i % n];
        assert_true(ulps(fm_atan2(y, x), atan2(y, x)) <= 2.0);
        assert_int_equal(!!signbit(fm_atan2(y, x)), !!signbit(atan2(y, x)));
    }
}

static void test_pow_specials(void **state)
{
    (void)state;
    const float x[] = {0.0f, 1e-45f, 0.5f, 1.0f, 2.0f, 3e38f, INFINITY};
    const float y[] = {-INFINITY, -3e38f, -2.0f, -0.0f, 0.0f,
                       1e-45f,    1.0f,   2.0f,  3e38f, INFINITY};
    for (size_t i = 0; i < sizeof x / sizeof *x; i++)
        for (size_t j = 0; j < sizeof y / sizeof *y; j++)
            assert_true(ulps(fm_pow(x[i], y[j]), pow(x[i], y[j])) <= 2.0);
    assert_true(isnan(fm_pow(-1.0f, 2.0f)) && fm_pow(-1.0f, 0.0f) == 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ulps),
        cmocka_unit_test(test_sincos_absolute),
        cmocka_unit_test(test_pow_ulps),
        cmocka_unit_test(test_atan2_ulps),
        cmocka_unit_test(test_specials),
        cmocka_unit_test(test_atan2_specials),
        cmocka_unit_test(test_pow_specials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
