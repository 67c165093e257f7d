#include "core/curve.h"
#include <math.h>
#include "core/physics/polynomial.h"

const struct curve_shape *curve_shape_of(enum brume_curve curve)
{
    static const struct curve_shape shapes[] = {
        [BRUME_CURVE_LINEAR] = {"linear", 2, 0, 1, 1},
        [BRUME_CURVE_QUADRATIC] = {"quadratic", 3, 1, 2, 1},
        [BRUME_CURVE_CUBIC] = {"cubic", 4, 1, 2, 1},
        [BRUME_CURVE_BEZIER] = {"Bezier", 4, 0, 3, 4},
        [BRUME_CURVE_B_SPLINE] = {"B-spline", 4, 1, 2, 1},
    };

    return &shapes[curve];
}

size_t curve_segments(enum brume_curve curve, size_t count)
{
    const struct curve_shape *s = curve_shape_of(curve);

    if (count < s->points || (s->step == s->points && count % s->step))
        return 0;
    return (count - s->points) / s->step + 1;
}

/* Quadratic and cubic ones have, as probed, the slope (p2 - p0) / 2 at p1. */
void curve_cubic(enum brume_curve curve, const double *p, size_t stride,
                 double c[4])
{
    double p0 = p[0], p1 = p[stride];
    double p2 = curve != BRUME_CURVE_LINEAR ? p[2 * stride] : 0;
    double p3 = curve_shape_of(curve)->points == 4 ? p[3 * stride] : 0;
    double from = (p2 - p0) / 2, to = (p3 - p1) / 2;

    c[0] = curve == BRUME_CURVE_LINEAR || curve == BRUME_CURVE_BEZIER ? p0 : p1;
    c[1] = from;
    c[2] = c[3] = 0;
    switch (curve) {
    case BRUME_CURVE_LINEAR:
        c[1] = p1 - p0;
        break;
    case BRUME_CURVE_QUADRATIC:
        c[2] = p2 - p1 - from;
        break;
    case BRUME_CURVE_CUBIC:
        c[2] = 3 * (p2 - p1) - 2 * from - to;
        c[3] = 2 * (p1 - p2) + from + to;
        break;
    case BRUME_CURVE_BEZIER:
        c[1] = 3 * (p1 - p0);
        c[2] = 3 * (p0 - 2 * p1 + p2);
        c[3] = p3 - p0 + 3 * (p1 - p2);
        break;
    case BRUME_CURVE_B_SPLINE:
        c[0] = (p0 + 4 * p1 + p2) / 6;
        c[2] = (p0 - 2 * p1 + p2) / 2;
        c[3] = (p3 - p0 + 3 * (p1 - p2)) / 6;
        break;
    }
}

void curve_range(const double c[4], double *lo, double *hi)
{
    const double slope[3] = {c[1], 2 * c[2], 3 * c[3]};
    double u[4];
    int n = polynomial_roots(slope, 2, 0, 1, u);

    u[n++] = 0;
    u[n++] = 1;
    for (int i = 0; i < n; i++) {
        double x = polynomial_value(c, 3, u[i]);
        *lo = fmin(*lo, x);
        *hi = fmax(*hi, x);
    }
}
