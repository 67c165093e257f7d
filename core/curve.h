/* curve.h - the language's splines as cubic pieces. */
#ifndef CORE_CURVE_H
#define CORE_CURVE_H
#include <stddef.h>
#include "core/brume.h"

/* Points that a segment needs, and which of them it starts and ends at (a
 * B-spline at none: it passes none); points from one segment to the next. */
struct curve_shape {
    const char *name;
    size_t points, start, end, step;
};
const struct curve_shape *curve_shape_of(enum brume_curve curve);

/* Segments of `count` points; 0 if there are too few, or if the points of a
 * Bezier curve are no multiple of 4. */
size_t curve_segments(enum brume_curve curve, size_t count);

/* Coefficients, c[0] + c[1] u + c[2] u^2 + c[3] u^3 for u from 0 to 1, of one
 * coordinate of a segment; p are its points' values, `stride` apart. */
void curve_cubic(enum brume_curve curve, const double *p, size_t stride,
                 double c[4]);
/* The range of that polynomial for u from 0 to 1 widens *lo and *hi. */
void curve_range(const double c[4], double *lo, double *hi);

#endif
