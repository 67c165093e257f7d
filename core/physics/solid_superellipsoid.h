/* solid_superellipsoid.h - ((|x|^p + |y|^p)^(q/p) + |z|^q) = 1, p = 2/e and
 * q = 2/n.
 *
 * Data: p, q. Reckoned by the gauge, the q-th root of the left side, which
 * grows with the distance and neither over- nor underflows at any exponent.
 * Where both exponents are 1 or more the solid is convex: two crossings. Else
 * it is a star, and a line is cut at the coordinate planes, and between them
 * into SUPERELLIPSOID_CUTS; each cut finds two roots at most. */
#ifndef CORE_PHYSICS_SOLID_SUPERELLIPSOID_H
#define CORE_PHYSICS_SOLID_SUPERELLIPSOID_H
#include "core/physics/bracket.h"
#include "core/physics/solid.h"

enum { SUPERELLIPSOID_CUTS = 8 };

/* (|a|^p + |b|^p)^(1/p) and its derivatives. */
HD double superellipsoid_norm(double a, double b, double p, double *by_a,
                              double *by_b)
{
    double x = fabs(a), y = fabs(b), most = x > y ? x : y;
    *by_a = *by_b = 0.0;
    if (!(most > 0.0))
        return most;
    double xp = pow(x / most, p), yp = pow(y / most, p), sum = xp + yp;
    double root = pow(sum, 1.0 / p), k = root / sum;
    if (x > 0.0)
        *by_a = (a < 0.0 ? -k : k) * xp * (most / x);
    if (y > 0.0)
        *by_b = (b < 0.0 ? -k : k) * yp * (most / y);
    return most * root;
}

HD double superellipsoid_gauge(const double *data, dvec3 p, dvec3 *gradient)
{
    double by_x, by_y, by_h, by_z;
    double h = superellipsoid_norm(p.x, p.y, data[0], &by_x, &by_y);
    double gauge = superellipsoid_norm(h, p.z, data[1], &by_h, &by_z);
    *gradient = dvec3_make(by_h * by_x, by_h * by_y, by_z);
    return gauge;
}

/* Adds the roots in [a, b] in their order. */
HD int superellipsoid_piece(const double *data, const solid_line *l, double a,
                            double b, double *t, int *part, int n, int room)
{
    turning s = turning_make(a, b);
    dvec3 gradient;
    double f;
    do
        f = superellipsoid_gauge(data, solid_line_at(l, s.t), &gradient);
    while (turning_step(&s, f - 1.0, dvec3_dot(gradient, l->d)));
    for (int i = 0; i < s.count && n < room; i++) {
        t[n] = solid_line_t(l, s.root[i]);
        part[n++] = 0;
    }
    return n;
}

/* The least parameter beyond `after` at which a coordinate is 0, or `end`. */
HD double superellipsoid_next_plane(const solid_line *l, double after,
                                    double end)
{
    const double at[3] = {-l->p.x / l->d.x, -l->p.y / l->d.y,
                          -l->p.z / l->d.z};
    for (int i = 0; i < 3; i++)
        if (at[i] > after && at[i] < end)
            end = at[i];
    return end;
}

HD int superellipsoid_roots(const double *data, dvec3 o, dvec3 d, double *t,
                            int *part, int room)
{
    solid_line l;
    int n = 0;
    /* Somewhat more than the ball around the cube that it is in. */
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.0, 0.0), 1.7321, &l))
        return 0;
    if (data[0] >= 1.0 && data[1] >= 1.0)
        return superellipsoid_piece(data, &l, -l.half, l.half, t, part, 0,
                                    room) & ~1;
    for (double a = -l.half; a < l.half;) {
        double b = superellipsoid_next_plane(&l, a, l.half), from = a;
        for (int i = 1; i <= SUPERELLIPSOID_CUTS; i++) {
            double to = i < SUPERELLIPSOID_CUTS
                            ? a + (b - a) * i / SUPERELLIPSOID_CUTS : b;
            n = superellipsoid_piece(data, &l, from, to, t, part, n, room);
            from = to;
        }
        a = b;
    }
    return n & ~1;
}

HD dvec3 superellipsoid_normal(const double *data, dvec3 p, int part)
{
    dvec3 gradient;
    (void)part;
    superellipsoid_gauge(data, p, &gradient);
    return gradient;
}

HD bool superellipsoid_inside(const double *data, dvec3 p)
{
    dvec3 gradient;
    return superellipsoid_gauge(data, p, &gradient) <= 1.0;
}

#endif
