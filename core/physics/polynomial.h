/* polynomial.h - real roots of polynomials in an interval, degree 35 at most.
 *
 * A polynomial is c[0] + c[1] t + ... + c[degree] t^degree. Between the roots
 * of its derivative it is monotonic, so that a change of sign brackets one
 * root; the derivatives are worked up from the quadratic one, whose roots are
 * closed. Zero counts as positive: a root of even multiplicity gives none or
 * two roots, one of odd multiplicity one, and the count has the parity that
 * the signs at the ends of the interval ask for. */
#ifndef CORE_PHYSICS_POLYNOMIAL_H
#define CORE_PHYSICS_POLYNOMIAL_H
#include <math.h>
#include "core/physics/hd.h"

enum { POLYNOMIAL_MAX = 35 };           /* the greatest degree              */
enum { POLYNOMIAL_STEPS = 200 };        /* of a refinement, never reached   */

HD double polynomial_value(const double *c, int degree, double t)
{
    double f = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        f = f * t + c[i];
    return f;
}

/* Value and slope. */
HD double polynomial_slope(const double *c, int degree, double t,
                           double *slope)
{
    double f = c[degree], df = 0.0;
    for (int i = degree - 1; i >= 0; i--) {
        df = df * t + f;
        f = f * t + c[i];
    }
    *slope = df;
    return f;
}

/* The root in [a, b], at whose ends the signs differ; `rising` if it is
 * positive at b. Newton's steps while they halve, else bisection. */
HD double polynomial_bracketed(const double *c, int degree, double a,
                               double b, bool rising)
{
    double t = 0.5 * (a + b), before = b - a, least = 1e-17 * (b - a);
    for (int i = 0; i < POLYNOMIAL_STEPS; i++) {
        double slope, f = polynomial_slope(c, degree, t, &slope);
        if ((f >= 0.0) == rising)
            b = t;
        else
            a = t;
        double next = t - f / slope;
        if (!(next >= a && next <= b && fabs(next - t) < 0.5 * before))
            next = 0.5 * (a + b);
        before = fabs(next - t);
        t = next;
        if (!(before > least + 2e-16 * fabs(t)))
            break;
    }
    return t;
}

/* Roots of a quadratic (c[2] may be 0) in [lo, hi], ascending; a touch
 * gives none. */
HD int polynomial_quadratic(const double *c, double lo, double hi, double *t)
{
    double half = -0.5 * c[1], over = half * half - c[0] * c[2];
    if (!(over > 0.0))
        return 0;
    double q = half + (half >= 0.0 ? sqrt(over) : -sqrt(over));
    double first = q != 0.0 ? c[0] / q : 0.0, second = q / c[2];
    int n = 0;
    if (second < first && c[2] != 0.0) {
        double swap = first;
        first = second;
        second = swap;
    }
    if (first >= lo && first <= hi && (q != 0.0 || c[2] != 0.0))
        t[n++] = first;
    if (c[2] != 0.0 && second >= lo && second <= hi)
        t[n++] = second;
    return n;
}

/* The k-th derivative over k!: its coefficients; its degree is less by k. */
HD void polynomial_derivative(const double *c, int degree, int k, double *out)
{
    double binomial = 1.0;
    for (int i = 0; i + k <= degree; i++) {
        out[i] = c[i + k] * binomial;
        binomial = binomial * (double)(i + 1 + k) / (double)(i + 1);
    }
}

/* Where a polynomial that is monotonic between the `stops` points t has its
 * roots in [lo, hi]; they replace the points. */
HD int polynomial_between(const double *c, int degree, double lo, double hi,
                          double *t, int stops)
{
    double from = lo;
    bool was = polynomial_value(c, degree, lo) >= 0.0;
    int n = 0;
    for (int i = 0; i <= stops; i++) {
        double to = i < stops ? t[i] : hi;
        bool is = polynomial_value(c, degree, to) >= 0.0;
        if (is != was)          /* n <= i: the point t[n] has been read     */
            t[n++] = polynomial_bracketed(c, degree, from, to, is);
        from = to;
        was = is;
    }
    return n;
}

/* All real roots in [lo, hi], ascending; t has room for as many as the degree.
 * Not finite coefficients or ends give none. */
HD int polynomial_roots(const double *c, int degree, double lo, double hi,
                        double *t)
{
    double part[POLYNOMIAL_MAX + 1], sum = hi - lo;
    while (degree > 0 && c[degree] == 0.0)
        degree--;
    for (int i = 0; i <= degree; i++)
        sum += fabs(c[i]);
    if (!(sum < INFINITY) || !(lo < hi) || degree < 1)
        return 0;
    if (degree == 1) {
        t[0] = -c[0] / c[1];
        return t[0] >= lo && t[0] <= hi;
    }
    polynomial_derivative(c, degree, degree - 2, part);
    int n = polynomial_quadratic(part, lo, hi, t);
    for (int k = degree - 3; k >= 0; k--) {
        polynomial_derivative(c, degree, k, part);
        n = polynomial_between(part, degree - k, lo, hi, t, n);
    }
    return n;
}

#endif
