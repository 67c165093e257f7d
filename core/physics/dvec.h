/* dvec.h - points and directions in double: for solids, whose roots would be
 * lost in float. */
#ifndef CORE_PHYSICS_DVEC_H
#define CORE_PHYSICS_DVEC_H
#include <math.h>
#include "core/physics/hd.h"

typedef struct { double x, y, z; } dvec3;

HD dvec3 dvec3_make(double x, double y, double z)
{
    dvec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

HD dvec3 dvec3_add(dvec3 a, dvec3 b)
{
    return dvec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

HD dvec3 dvec3_sub(dvec3 a, dvec3 b)
{
    return dvec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

HD dvec3 dvec3_scale(dvec3 a, double s)
{
    return dvec3_make(a.x * s, a.y * s, a.z * s);
}

/* a + s b */
HD dvec3 dvec3_mad(dvec3 a, double s, dvec3 b)
{
    return dvec3_make(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

HD double dvec3_dot(dvec3 a, dvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HD dvec3 dvec3_cross(dvec3 a, dvec3 b)
{
    return dvec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                      a.x * b.y - a.y * b.x);
}

HD double dvec3_length(dvec3 a)
{
    return sqrt(dvec3_dot(a, a));
}

#endif
