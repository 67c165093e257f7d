/* test_polynomial.c - roots of polynomials that were made from their roots. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/polynomial.h"
#include "core/physics/rng.h"

static double uniform(rng *r, double lo, double hi)
{
    return lo + (hi - lo) * (double)rng_float(r);
}

/* c times (t - root); the new degree. */
static int times(double *c, int degree, double root)
{
    c[degree + 1] = 0;
    for (int i = degree + 1; i > 0; i--)
        c[i] = c[i - 1] - root * c[i];
    c[0] *= -root;
    return degree + 1;
}

/* Up to 10 roots at least 0.05 apart, pairs of complex ones, any factor. */
static void test_polynomial__simple_roots(void **state)
{
    (void)state;
    rng r = rng_make(1, 0, 0, 0);
    for (int trial = 0; trial < 20000; trial++) {
        double c[POLYNOMIAL_MAX + 2] = {uniform(&r, -5, 5)}, at[10], t[36];
        int count = 0, degree = 0, want = trial % 11;
        for (double x = -0.95; count < want && x < 0.95;
             x += uniform(&r, 0.05, 0.4)) {
            at[count++] = x;
            degree = times(c, degree, x);
        }
        if (trial % 2) { /* (t^2 + b^2) */
            double b = uniform(&r, 0.1, 2);
            degree += 2;
            for (int i = degree; i >= 0; i--)
                c[i] = (i >= 2 ? c[i - 2] : 0) +
                       b * b * (i <= degree - 2 ? c[i] : 0);
        }
        assert_int_equal(polynomial_roots(c, degree, -1, 1, t), count);
        for (int i = 0; i < count; i++)
            assert_true(fabs(t[i] - at[i]) < 1e-7);
    }
}

/* Chebyshev's T_n: n roots, cos((2 k + 1) pi / 2 n). */
static void test_polynomial__chebyshev(void **state)
{
    (void)state;
    double a[36] = {1}, b[36] = {0, 1}, next[36], t[36];
    for (int n = 1; n <= 35; n++) {
        assert_int_equal(polynomial_roots(b, n, -1.5, 1.5, t), n);
        for (int k = 0; k < n; k++) {
            double root = -cos((2 * k + 1) * M_PI / (2 * n));
            /* The rounding of coefficients up to (1 + sqrt 2)^n / 2. */
            double off = 1e-15 * pow(1 + sqrt(2), n) / n;
            assert_true(fabs(t[k] - root) < 1e-14 + off);
        }
        for (int i = 0; i <= n + 1 && i < 36; i++)
            next[i] = (i > 0 ? 2 * b[i - 1] : 0) - (i < n ? a[i] : 0);
        for (int i = 0; i < 36; i++) {
            a[i] = b[i];
            b[i] = i <= n + 1 ? next[i] : 0;
        }
    }
}

/* However often a root comes, the count is odd where the signs at the ends
 * differ, even where they do not. */
static void test_polynomial__multiple_roots(void **state)
{
    (void)state;
    rng r = rng_make(2, 0, 0, 0);
    for (int trial = 0; trial < 20000; trial++) {
        double c[POLYNOMIAL_MAX + 2] = {trial % 2 ? -1.5 : 1}, t[36];
        int degree = 0;
        while (degree < 9) {
            double x = uniform(&r, -0.9, 0.9);
            for (int i = trial % 4; i >= 0 && degree < 12; i--)
                degree = times(c, degree, x);
        }
        bool differ = (polynomial_value(c, degree, -1) >= 0) !=
                      (polynomial_value(c, degree, 1) >= 0);
        int n = polynomial_roots(c, degree, -1, 1, t);
        assert_int_equal(n % 2, differ);
        for (int i = 0; i < n; i++) {
            double bound = 1e-14 * pow(2, degree);
            assert_true(fabs(polynomial_value(c, degree, t[i])) < bound);
        }
    }
}

static void test_polynomial__touches(void **state)
{
    (void)state;
    const double above[] = {0.25, -1, 1}, below[] = {-0.25, 1, -1};
    const double thrice[] = {-0.125, 0.75, -1.5, 1}, flat[] = {0, 0, 0, 0, 1};
    double t[4];
    assert_int_equal(polynomial_roots(above, 2, 0, 1, t), 0);
    assert_int_equal(polynomial_roots(below, 2, 0, 1, t), 0);
    assert_int_equal(polynomial_roots(thrice, 3, 0, 1, t), 1);
    assert_true(fabs(t[0] - 0.5) < 1e-5);
    assert_int_equal(polynomial_roots(flat, 4, -1, 1, t) % 2, 0);
}

/* Roots of 1e-150 and 1e150 in one quadratic; a leading 0; a wide interval. */
static void test_polynomial__scales(void **state)
{
    (void)state;
    const double wide[] = {1, -1e150, 1}, line[] = {-3, 2, 0, 0};
    const double far[] = {-1e30, 0, 0, 0, 0, 1};
    double t[5];
    assert_int_equal(polynomial_roots(wide, 2, 0, 1e200, t), 2);
    assert_true(fabs(t[0] - 1e-150) < 1e-165 && fabs(t[1] / 1e150 - 1) < 1e-15);
    assert_int_equal(polynomial_roots(line, 3, -1e7, 1e7, t), 1);
    assert_true(t[0] == 1.5);
    assert_int_equal(polynomial_roots(far, 5, -1e7, 1e7, t), 1);
    assert_true(fabs(t[0] - 1e6) < 1e-9);
}

static void test_polynomial__not_finite(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    double t[36];
    for (int b = 0; b < 3; b++)
        for (int degree = 0; degree <= 8; degree++)
            for (int i = 0; i <= degree; i++) {
                double c[9] = {1, -2, 3, -4, 5, -6, 7, -8, 9};
                c[i] = bad[b];
                assert_int_equal(polynomial_roots(c, degree, -1, 1, t), 0);
            }
    const double good[] = {0, 1};
    assert_int_equal(polynomial_roots(good, 1, -INFINITY, 1, t), 0);
    assert_int_equal(polynomial_roots(good, 1, NAN, 1, t), 0);
    assert_int_equal(polynomial_roots(good, 1, 1, -1, t), 0);
    assert_int_equal(polynomial_roots(good, 0, -1, 1, t), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_polynomial__simple_roots),
        cmocka_unit_test(test_polynomial__chebyshev),
        cmocka_unit_test(test_polynomial__multiple_roots),
        cmocka_unit_test(test_polynomial__touches),
        cmocka_unit_test(test_polynomial__scales),
        cmocka_unit_test(test_polynomial__not_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
