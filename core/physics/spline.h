/* spline.h - splines of the scene language: 1 to 5 numbers as a function of
 * one, through knots. POV-Ray's types and its behaviour beyond the knots.
 *
 * A spline is an array of reals: type, numbers a knot (terms), knots; then
 * their parameters, ascending; then the terms of each; then the second
 * derivatives there of the natural spline. core/spline.c makes it. */
#ifndef CORE_PHYSICS_SPLINE_H
#define CORE_PHYSICS_SPLINE_H
#include "core/physics/real.h"

enum { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_NATURAL,
       SPLINE_TYPES };
enum { SPLINE_HEAD = 3, SPLINE_TERMS = 5 };

HD const real *spline_knots(const real *s)
{
    return s + SPLINE_HEAD;
}

/* The term `k` of knot i. */
HD real spline_term(const real *s, int i, int k)
{
    int terms = (int)s[1], count = (int)s[2];
    return s[SPLINE_HEAD + count + i * terms + k];
}

HD real spline_second(const real *s, int i, int k)
{
    int terms = (int)s[1], count = (int)s[2];
    return s[SPLINE_HEAD + count + (count + i) * terms + k];
}

/* The interval [i, i + 1] in which t lies; 2 knots at least. */
HD int spline_interval(const real *s, real t)
{
    const real *knots = spline_knots(s);
    int low = 0, high = (int)s[2] - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (knots[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Slope of the chord from knot i to the next. */
HD real spline_slope(const real *s, int i, int k)
{
    const real *t = spline_knots(s);
    return (spline_term(s, i + 1, k) - spline_term(s, i, k))
         / (t[i + 1] - t[i]);
}

HD real spline_linear(const real *s, int i, int k, real u)
{
    return spline_term(s, i, k)
         + u * (spline_term(s, i + 1, k) - spline_term(s, i, k));
}

/* The parabola through the interval's ends and the knot before it, or, in the
 * first interval, after it. u in [0, 1]. */
HD real spline_quadratic(const real *s, int i, int k, real u)
{
    const real *t = spline_knots(s);
    int first = i > 0 ? i - 1 : 0;
    real h = t[i + 1] - t[i], bend;
    if (s[2] < 3)
        return spline_linear(s, i, k, u);
    bend = (spline_slope(s, first + 1, k) - spline_slope(s, first, k))
         / (t[first + 2] - t[first]);
    return spline_linear(s, i, k, u) - bend * h * h * u * (1 - u);
}

/* Hermite's cubic; its slope at a knot is the mean of the two chords'. */
HD real spline_cubic(const real *s, int i, int k, real u)
{
    const real *t = spline_knots(s);
    real h = t[i + 1] - t[i], chord = spline_slope(s, i, k);
    real a = (spline_slope(s, i - 1, k) + chord) / 2 - chord;
    real b = (chord + spline_slope(s, i + 1, k)) / 2 - chord;
    return spline_linear(s, i, k, u)
         + h * u * (1 - u) * (a * (1 - u) - b * u);
}

HD real spline_natural(const real *s, int i, int k, real u)
{
    const real *t = spline_knots(s);
    real h = t[i + 1] - t[i], v = 1 - u;
    return spline_linear(s, i, k, u)
         + h * h / 6 * ((v * v * v - v) * spline_second(s, i, k)
                        + (u * u * u - u) * spline_second(s, i + 1, k));
}

HD real spline_piece(const real *s, int type, int i, int k, real u)
{
    switch (type) {
    case SPLINE_QUADRATIC:
        return spline_quadratic(s, i, k, u);
    case SPLINE_CUBIC:
        return spline_cubic(s, i, k, u);
    case SPLINE_NATURAL:
        return spline_natural(s, i, k, u);
    default:
        return spline_linear(s, i, k, u);
    }
}

/* The spline at t, its terms in out. Of a type < 0, its own. Beyond the first
 * and last knots, of the cubic spline beyond the second and last but one, it
 * is what it is there; a cubic spline of two knots is their mean. */
HD void spline_eval(const real *s, int type, real t, real *out)
{
    const real *knots = spline_knots(s);
    int terms = (int)s[1], last = (int)s[2] - 1, i = 0;
    real u = REAL(0.0);
    if (type < 0)
        type = (int)s[0];
    if (last > 0) {
        int margin = type == SPLINE_CUBIC && last > 1;
        t = real_clamp(t, knots[margin], knots[last - margin]);
        i = spline_interval(s, t);
        u = (t - knots[i]) / (knots[i + 1] - knots[i]);
    }
    if (type == SPLINE_CUBIC && last == 1)
        u = REAL(0.5);
    for (int k = 0; k < terms; k++) {
        if (u == 0 || last == 0)
            out[k] = spline_term(s, i, k);
        else if (u == 1)
            out[k] = spline_term(s, i + 1, k);
        else
            out[k] = spline_piece(s, last == 1 ? 0 : type, i, k, u);
    }
}

#endif
