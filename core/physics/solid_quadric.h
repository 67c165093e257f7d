/* solid_quadric.h - A x^2 + B y^2 + C z^2 + D xy + E xz + F yz + G x + H y +
 * I z + J = 0, negative inside.
 *
 * Data: A to J. Two crossings at most, one where a line ends inside. */
#ifndef CORE_PHYSICS_SOLID_QUADRIC_H
#define CORE_PHYSICS_SOLID_QUADRIC_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

HD double quadric_value(const double *q, dvec3 p)
{
    return p.x * (q[0] * p.x + q[3] * p.y + q[4] * p.z + q[6]) +
           p.y * (q[1] * p.y + q[5] * p.z + q[7]) +
           p.z * (q[2] * p.z + q[8]) + q[9];
}

HD dvec3 quadric_normal(const double *q, dvec3 p, int part)
{
    (void)part;
    return dvec3_make(2.0 * q[0] * p.x + q[3] * p.y + q[4] * p.z + q[6],
                      2.0 * q[1] * p.y + q[3] * p.x + q[5] * p.z + q[7],
                      2.0 * q[2] * p.z + q[4] * p.x + q[5] * p.y + q[8]);
}

HD bool quadric_inside(const double *q, dvec3 p)
{
    return quadric_value(q, p) <= 0.0;
}

HD int quadric_roots(const double *data, dvec3 o, dvec3 d, double *t,
                     int *part, int room)
{
    solid_line l;
    double c[3], u[2];
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.0, 0.0), INFINITY, &l))
        return 0;
    c[0] = quadric_value(data, l.p);
    c[1] = dvec3_dot(quadric_normal(data, l.p, 0), l.d);
    c[2] = l.d.x * (data[0] * l.d.x + data[3] * l.d.y + data[4] * l.d.z) +
           l.d.y * (data[1] * l.d.y + data[5] * l.d.z) +
           data[2] * l.d.z * l.d.z;
    int n = polynomial_quadratic(c, -SOLID_FAR, SOLID_FAR, u);
    for (int i = 0; i < n && i < room; i++) {
        t[i] = solid_line_t(&l, u[i]);
        part[i] = 0;
    }
    return n < room ? n : room;
}

#endif
