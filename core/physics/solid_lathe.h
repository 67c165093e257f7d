/* solid_lathe.h - a curve in the distance from the y axis and in y, turned
 * about that axis.
 *
 * Data: number of segments, size, height of the middle, radius of a ball
 * around the middle; segments of solid_curve.h. Six crossings a segment at
 * most; part is the segment. Where the curve is closed, or ends on the axis
 * at both ends, the solid is closed. Inside is where the curve passes below an
 * odd number of times, as in POV-Ray, also for curves that are not closed. */
#ifndef CORE_PHYSICS_SOLID_LATHE_H
#define CORE_PHYSICS_SOLID_LATHE_H
#include "core/physics/solid_curve.h"

enum { LATHE_HEAD = 4 };

/* With y = p.y + u d.y a line has d.y^2 times (distance from the axis^2 -
 * r^2) = |p d.y + (y - p.y) d|^2 - (r d.y)^2 in x and z, without u. */
HD double lathe_value(const solid_line *l, double r, double y)
{
    double w = y - l->p.y;
    double a = l->p.x * l->d.y + w * l->d.x, b = l->p.z * l->d.y + w * l->d.z;
    return a * a + b * b - r * r * l->d.y * l->d.y;
}

HD void lathe_sextic(const double *segment, const solid_line *l, double c[7])
{
    double a[4], b[4], r[4];
    for (int i = 0; i < 4; i++) {
        double w = segment[4 + i] - (i == 0 ? l->p.y : 0.0);
        a[i] = w * l->d.x + (i == 0 ? l->p.x * l->d.y : 0.0);
        b[i] = w * l->d.z + (i == 0 ? l->p.z * l->d.y : 0.0);
        r[i] = segment[i] * l->d.y;
    }
    for (int i = 0; i < 7; i++)
        c[i] = 0.0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            c[i + j] += a[i] * a[j] + b[i] * b[j] - r[i] * r[j];
}

/* A line of constant y: where the curve has that y there is a circle. */
HD int lathe_level(const double *segment, int index, const solid_line *l,
                   double *t, int *part, int n, int room)
{
    double across = l->d.x * l->d.x + l->d.z * l->d.z, u[5];
    double foot = -(l->p.x * l->d.x + l->p.z * l->d.z) / across;
    double x = l->p.x + foot * l->d.x, z = l->p.z + foot * l->d.z;
    int found = curve_crosses(segment, 0.0, 1.0, -l->p.y, u);
    for (int k = 0; k < found; k++) {
        double r = polynomial_value(segment, 3, u[k]);
        double over = (r * r - (x * x + z * z)) / across;
        if (!(over > 0.0))
            continue;
        for (int side = -1; side <= 1; side += 2)
            n = solid_insert(solid_line_t(l, foot + side * sqrt(over)), index,
                             t, part, n, room);
    }
    return n;
}

HD int lathe_slanted(const double *segment, int index, const solid_line *l,
                     double *t, int *part, int n, int room)
{
    double c[7], u[8];
    const double *start = segment + CURVE_START, *end = segment + CURVE_END;
    lathe_sextic(segment, l, c);
    int found = polynomial_link(c, 6, lathe_value(l, start[0], start[1]) >= 0.0,
                                lathe_value(l, end[0], end[1]) >= 0.0, u);
    for (int k = 0; k < found; k++) {
        double y = polynomial_value(segment + 4, 3, u[k]);
        n = solid_insert(solid_line_t(l, (y - l->p.y) / l->d.y), index, t,
                         part, n, room);
    }
    return n;
}

HD int lathe_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                   int room)
{
    solid_line l;
    int n = 0, count = (int)data[0];
    room &= ~1;
    if (!solid_line_make(o, d, dvec3_make(0.0, data[2], 0.0), data[3], &l))
        return 0;
    bool level = fabs(l.d.y) < 1e-7;        /* its two ends can't be parted */
    for (int i = 0; i < count; i++) {
        const double *segment = data + LATHE_HEAD + CURVE_SEGMENT * i;
        n = level ? lathe_level(segment, i, &l, t, part, n, room)
                  : lathe_slanted(segment, i, &l, t, part, n, room);
    }
    return n;
}

/* Curves may overshoot the axis: the other side counts too. */
HD bool lathe_inside_plane(const double *data, double rho, double y)
{
    int count = (int)data[0];
    return curve_odd(data + LATHE_HEAD, count, rho, y, 1) !=
           curve_odd(data + LATHE_HEAD, count, -rho, y, 1);
}

HD bool lathe_inside(const double *data, dvec3 p)
{
    return lathe_inside_plane(data, sqrt(p.x * p.x + p.z * p.z), p.y);
}

HD dvec3 lathe_normal(const double *data, dvec3 p, int part)
{
    int count = (int)data[0];
    const double *segment = data + LATHE_HEAD +
                            CURVE_SEGMENT * (part < count ? part : 0);
    double rho = sqrt(p.x * p.x + p.z * p.z), near, far, at[2], along[2];
    double u = curve_nearest(segment, rho, p.y, &near);
    double beyond = curve_nearest(segment, -rho, p.y, &far);
    double mirror = far < near ? -1.0 : 1.0;
    curve_point(segment, far < near ? beyond : u, at);
    curve_tangent(segment, far < near ? beyond : u, along);
    double out = along[1], up = -mirror * along[0];
    double step = 1e-6 * data[1] / sqrt(out * out + up * up);
    if (lathe_inside_plane(data, mirror * at[0] + step * out,
                           at[1] + step * up)) {
        out = -out;
        up = -up;
    }
    double k = rho > 0.0 ? out / rho : 0.0;
    return dvec3_make(k * p.x, up, k * p.z);
}

#endif
