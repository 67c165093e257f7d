/* solid_curve.h - plane curves of cubic pieces, that prisms and lathes are
 * made of.
 *
 * A segment is CURVE_SEGMENT numbers: the coefficients of the first
 * coordinate as a polynomial of u from 0 to 1, those of the second, then the
 * point where it starts and the one where it ends. Where a segment goes on in
 * another, both have the same numbers there, so that the signs agree. */
#ifndef CORE_PHYSICS_SOLID_CURVE_H
#define CORE_PHYSICS_SOLID_CURVE_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

enum { CURVE_SEGMENT = 12, CURVE_START = 8, CURVE_END = 10 };

/* u where a x + b y + c = 0, as the signs at the ends ask; room for 5. */
HD int curve_crosses(const double *segment, double a, double b, double c,
                     double *u)
{
    double line[4];
    const double *start = segment + CURVE_START, *end = segment + CURVE_END;
    for (int i = 0; i < 4; i++)
        line[i] = a * segment[i] + b * segment[4 + i];
    line[0] += c;
    return polynomial_link(line, 3, a * start[0] + b * start[1] + c >= 0.0,
                           a * end[0] + b * end[1] + c >= 0.0, u);
}

HD void curve_point(const double *segment, double u, double point[2])
{
    point[0] = polynomial_value(segment, 3, u);
    point[1] = polynomial_value(segment + 4, 3, u);
}

HD void curve_tangent(const double *segment, double u, double tangent[2])
{
    polynomial_slope(segment, 3, u, &tangent[0]);
    polynomial_slope(segment + 4, 3, u, &tangent[1]);
    if (tangent[0] == 0.0 && tangent[1] == 0.0)     /* of a cusp: the chord */
        for (int i = 0; i < 2; i++)
            tangent[i] = segment[CURVE_END + i] - segment[CURVE_START + i];
}

HD double curve_distance(const double *segment, double u, double x, double y)
{
    double point[2];
    curve_point(segment, u, point);
    return (point[0] - x) * (point[0] - x) + (point[1] - y) * (point[1] - y);
}

/* The u in [0, 1] that is nearest to a point; *square is the distance's. */
HD double curve_nearest(const double *segment, double x, double y,
                        double *square)
{
    /* (S - q) . S', of degree 5 */
    double slope[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, u[5], best = 0.0;
    for (int i = 0; i < 4; i++)
        for (int j = 1; j < 4; j++)
            slope[i + j - 1] +=
                j * (segment[j] * (segment[i] - (i ? 0.0 : x)) +
                     segment[4 + j] * (segment[4 + i] - (i ? 0.0 : y)));
    int n = polynomial_roots(slope, 5, 0.0, 1.0, u);
    *square = curve_distance(segment, 0.0, x, y);
    for (int i = 0; i <= n; i++) {
        double at = i < n ? u[i] : 1.0;
        double here = curve_distance(segment, at, x, y);
        if (here < *square) {
            *square = here;
            best = at;
        }
    }
    return best;
}

/* How often the half line from (x, y) against the `other` coordinate's
 * direction meets the curve, modulo 2: along -y for other = 1, along -x for
 * other = 0. */
HD bool curve_odd(const double *segments, int count, double x, double y,
                  int other)
{
    bool odd = false;
    double q[2], u[5], point[2];
    q[0] = x;
    q[1] = y;
    for (int i = 0; i < count; i++) {
        const double *s = segments + CURVE_SEGMENT * i;
        int n = other ? curve_crosses(s, 1.0, 0.0, -x, u)
                      : curve_crosses(s, 0.0, 1.0, -y, u);
        for (int k = 0; k < n; k++) {
            curve_point(s, u[k], point);
            odd ^= point[other] < q[other];
        }
    }
    return odd;
}

#endif
