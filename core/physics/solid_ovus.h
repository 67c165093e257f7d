/* solid_ovus.h - an egg: a ball around the origin, one on top of it around
 * (0, bottom radius, 0), and an arc turned about the y axis that touches both.
 *
 * Data: bottom and top radius; radius of the arc, distance of its middle
 * beyond the axis, height of its middle; 1 if the top ball holds all. Convex:
 * two crossings. The arc's radius is twice the greater of the balls', as the
 * normals that POV-Ray's trace gives tell. */
#ifndef CORE_PHYSICS_SOLID_OVUS_H
#define CORE_PHYSICS_SOLID_OVUS_H
#include "core/physics/bracket.h"
#include "core/physics/solid.h"

/* Distance from the surface, negative inside, convex; and its gradient. */
HD double ovus_distance(const double *data, dvec3 p, dvec3 *gradient)
{
    double rho = sqrt(p.x * p.x + p.z * p.z);
    double beyond = data[3], height = data[4], y = p.y;
    double out = rho, radius = data[2];
    /* Against the lines from the arc's middle to those of the balls. */
    if (data[5] != 0.0 || beyond * (y - height) -
                          (data[0] - height) * (rho + beyond) >= 0.0) {
        y -= data[0];
        radius = data[1];
    } else if (beyond * (y - height) + height * (rho + beyond) <= 0.0) {
        radius = data[0];
    } else {
        y -= height;
        out += beyond;
    }
    double length = sqrt(out * out + y * y);
    double k = rho > 0.0 ? out / (rho * length) : 0.0;
    *gradient = dvec3_make(k * p.x, length > 0.0 ? y / length : 1.0, k * p.z);
    return length - radius;
}

HD int ovus_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                  int room)
{
    solid_line l;
    double reach = data[0] + data[1];
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.5 * data[1], 0.0),
                         1.5 * reach, &l))
        return 0;
    turning s = turning_make(-l.half, l.half);
    dvec3 gradient;
    double f;
    do
        f = ovus_distance(data, solid_line_at(&l, s.t), &gradient);
    while (turning_step(&s, f, dvec3_dot(gradient, l.d)));
    if (s.count < 2 || room < 2)
        return 0;
    for (int i = 0; i < 2; i++) {
        t[i] = solid_line_t(&l, s.root[i]);
        part[i] = 0;
    }
    return 2;
}

HD dvec3 ovus_normal(const double *data, dvec3 p, int part)
{
    dvec3 gradient;
    (void)part;
    ovus_distance(data, p, &gradient);
    return gradient;
}

HD bool ovus_inside(const double *data, dvec3 p)
{
    dvec3 gradient;
    return ovus_distance(data, p, &gradient) <= 0.0;
}

#endif
