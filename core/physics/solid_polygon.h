/* solid_polygon.h - a flat surface between closed outlines, in the plane z = 0
 * of its own space.
 *
 * Data: the number of corners, then x and y of each; every outline ends at the
 * corner at which it begins. A point belongs to it that an odd number of
 * edges separates from far away. One crossing at most, and no inside. */
#ifndef CORE_PHYSICS_SOLID_POLYGON_H
#define CORE_PHYSICS_SOLID_POLYGON_H
#include "core/physics/dvec.h"

/* Whether the edge from p to q lies across the half line from (x, y) along x:
 * its lower end counts, its upper one does not. */
HD bool polygon_edge(const double *p, const double *q, double x, double y)
{
    if ((p[1] <= y) == (q[1] <= y))
        return false;
    return p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) > x;
}

HD bool polygon_holds(const double *data, double x, double y)
{
    const double *corner = data + 1;
    int count = (int)data[0], first = 0;
    bool in = false;
    for (int i = 1; i < count; i++) {
        const double *p = corner + 2 * (i - 1), *q = corner + 2 * i;
        in ^= polygon_edge(p, q, x, y);
        if (q[0] == corner[2 * first] && q[1] == corner[2 * first + 1])
            first = ++i;
    }
    return in;
}

HD int polygon_roots(const double *data, dvec3 o, dvec3 d, double *t,
                     int *part, int room)
{
    if (d.z == 0.0 || room < 1)
        return 0;
    t[0] = -o.z / d.z;
    part[0] = 0;
    return polygon_holds(data, o.x + t[0] * d.x, o.y + t[0] * d.y);
}

HD dvec3 polygon_normal(const double *data, dvec3 p, int part)
{
    (void)data;
    (void)p;
    (void)part;
    return dvec3_make(0.0, 0.0, 1.0);
}

HD bool polygon_inside(const double *data, dvec3 p)
{
    (void)data;
    (void)p;
    return false;
}

#endif
