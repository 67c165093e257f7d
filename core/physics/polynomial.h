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
#include "core/physics/bracket.h"

enum { POLYNOMIAL_MAX = 35 };           /* the greatest degree              */

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
 * positive at b. */
HD double polynomial_bracketed(const double *c, int degree, double a,
                               double b, bool rising)
{
    bracket at = bracket_make(a, b, rising);
    double slope = 0.0, f;
    do
        f = polynomial_slope(c, degree, at.t, &slope);
    while (bracket_step(&at, f, slope));
    return at.t;
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

/* The roots of degree 1 and 2 by the same rule: as the signs at the ends ask
 * for, in [lo, hi]. */
HD int polynomial_low(const double *c, int degree, double lo, double hi,
                      double *t)
{
    bool first = polynomial_value(c, degree, lo) >= 0.0;
    bool last = polynomial_value(c, degree, hi) >= 0.0;
    bool outer = c[degree] >= 0.0;
    double r[2];
    r[0] = r[1] = degree == 1 ? -c[0] / c[1] : -0.5 * c[1] / c[2];
    int n = degree == 1 ? 1 : polynomial_quadratic(c, -INFINITY, INFINITY, r);
    if (first != last) {
        t[0] = fmin(fmax(r[first == outer ? 0 : 1], lo), hi);
        return 1;
    }
    if (n < 2 || first != outer || !(r[0] >= lo && r[1] <= hi))
        return 0;
    t[0] = r[0];
    t[1] = r[1];
    return 2;
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
    if (degree <= 2)
        return polynomial_low(c, degree, lo, hi, t);
    polynomial_derivative(c, degree, degree - 2, part);
    int n = polynomial_quadratic(part, lo, hi, t);
    for (int k = degree - 3; k >= 0; k--) {
        polynomial_derivative(c, degree, k, part);
        n = polynomial_between(part, degree - k, lo, hi, t, n);
    }
    return n;
}

/* Roots in [0, 1] of one stretch of what goes on: `positive` is the sign that
 * the stretch before ended with, and becomes the one that this ends with. Where
 * rounding makes the stretches disagree, there is a root at 0. t has room for
 * one more than the degree. */
HD int polynomial_stretch(const double *c, int degree, bool *positive,
                          double *t)
{
    int n = 0;
    double rise = 0.0, fall = 0.0;
    bool first = c[0] >= 0.0;
    if (first != *positive)
        t[n++] = 0.0;
    for (int i = 1; i <= degree; i++) {
        rise += fmax(c[i], 0.0);
        fall += fmin(c[i], 0.0);
    }
    *positive = first;
    if (first ? c[0] + fall >= 0.0 : c[0] + rise < 0.0)
        return n;
    int found = polynomial_roots(c, degree, 0.0, 1.0, t + n);
    *positive = first != (found % 2 == 1);
    return n + found;
}

/* The same where the sign at the other end is known too, from the stretch
 * that goes on there; room for two more than the degree. */
HD int polynomial_link(const double *c, int degree, bool first, bool last,
                       double *t)
{
    int n = polynomial_stretch(c, degree, &first, t);
    if (first != last)
        t[n++] = 1.0;
    return n;
}

#endif
