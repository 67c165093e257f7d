/* solid_torus.h - a ring around the y axis.
 *
 * Data: major, minor radius. Four crossings at most. A torus that overlaps
 * itself (minor > major) is the union: the lemon in its middle is inside, and
 * its surface is no surface; major = 0 is a sphere. */
#ifndef CORE_PHYSICS_SOLID_TORUS_H
#define CORE_PHYSICS_SOLID_TORUS_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

/* (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2) along the line, u in half
 * chords: its coefficients. */
HD void torus_quartic(double major, double minor, const solid_line *l,
                      double c[5])
{
    dvec3 p = l->p, d = dvec3_scale(l->d, l->half);
    double q2 = dvec3_dot(d, d), q1 = 2.0 * dvec3_dot(p, d);
    double q0 = dvec3_dot(p, p) + (major - minor) * (major + minor);
    double k = 4.0 * major * major;
    c[4] = q2 * q2;
    c[3] = 2.0 * q2 * q1;
    c[2] = 2.0 * q2 * q0 + q1 * q1 - k * (d.x * d.x + d.z * d.z);
    c[1] = 2.0 * q1 * q0 - 2.0 * k * (p.x * d.x + p.z * d.z);
    c[0] = q0 * q0 - k * (p.x * p.x + p.z * p.z);
}

/* Whether a point of either surface is of the outer one: there the axis is
 * the minor radius from the ring, and not from the ring's far side. */
HD bool torus_outer(double major, double minor, dvec3 p)
{
    return dvec3_dot(p, p) >= (minor - major) * (minor + major);
}

HD int torus_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                   int room)
{
    double major = data[0], minor = data[1], c[5], u[4];
    solid_line l;
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.0, 0.0), major + minor, &l) ||
        !(l.half > 0.0))
        return 0;
    int count = 2;
    u[0] = -1.0;
    u[1] = 1.0;
    if (major > 0.0) {
        torus_quartic(major, minor, &l, c);
        count = polynomial_roots(c, 4, -1.0 - 1e-6, 1.0 + 1e-6, u);
    }
    int n = 0;
    for (int i = 0; i < count && n < room; i++)
        if (major == 0.0 ||
            torus_outer(major, minor, solid_line_at(&l, u[i] * l.half))) {
            t[n] = solid_line_t(&l, u[i] * l.half);
            part[n++] = 0;
        }
    return n & ~1;
}

HD dvec3 torus_normal(const double *data, dvec3 p, int part)
{
    double rho = sqrt(p.x * p.x + p.z * p.z);
    double k = rho > 0.0 ? 1.0 - data[0] / rho : 0.0;
    (void)part;
    return dvec3_make(k * p.x, p.y, k * p.z);
}

HD bool torus_inside(const double *data, dvec3 p)
{
    double rho = sqrt(p.x * p.x + p.z * p.z) - data[0];
    return rho * rho + p.y * p.y <= data[1] * data[1];
}

#endif
