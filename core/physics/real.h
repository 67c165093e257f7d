/* real.h - numbers of what is computed in two precisions.
 *
 * Functions, patterns and solids are one source compiled twice: in double
 * where the scene is read (a source file defines PHYSICS_DOUBLE before its
 * includes), in float where it is rendered. `real` is the number, REAL(1.5)
 * a constant, real_sin and its like the elementary functions: in float our
 * own (fmath.h), in double the C library's. real3 is vec3 or dvec3. */
#ifndef CORE_PHYSICS_REAL_H
#define CORE_PHYSICS_REAL_H
#include <math.h>
#include "core/physics/dvec.h"
#include "core/physics/fmath.h"
#include "core/physics/hd.h"
#include "core/physics/vec.h"

#ifdef PHYSICS_DOUBLE
typedef double real;
#define REAL(x) (x)
#define REAL_CHOOSE(in_double, in_float) in_double
#else
typedef float real;
#define REAL(x) (x##f)
#define REAL_CHOOSE(in_double, in_float) in_float
#endif

#define REAL_FUNCTION(name, in_double, in_float)                              \
    HD real real_##name(real x)                                               \
    {                                                                         \
        return REAL_CHOOSE(in_double(x), in_float(x));                        \
    }

REAL_FUNCTION(exp, exp, fm_exp)
REAL_FUNCTION(log, log, fm_log)
REAL_FUNCTION(sin, sin, fm_sin)
REAL_FUNCTION(cos, cos, fm_cos)
REAL_FUNCTION(acos, acos, fm_acos)
REAL_FUNCTION(sqrt, sqrt, sqrtf)
REAL_FUNCTION(abs, fabs, fabsf)
REAL_FUNCTION(floor, floor, floorf)
REAL_FUNCTION(ceil, ceil, ceilf)

HD real real_pow(real x, real y)
{
    return REAL_CHOOSE(pow(x, y), fm_pow(x, y));
}

HD real real_atan2(real y, real x)
{
    return REAL_CHOOSE(atan2(y, x), fm_atan2(y, x));
}

HD real real_min(real a, real b)
{
    return a < b ? a : b;
}

HD real real_max(real a, real b)
{
    return a > b ? a : b;
}

HD real real_clamp(real x, real low, real high)
{
    return real_min(real_max(x, low), high);
}

#ifdef PHYSICS_DOUBLE
typedef dvec3 real3;
#else
typedef vec3 real3;
#endif

HD real3 real3_make(real x, real y, real z)
{
    return REAL_CHOOSE(dvec3_make(x, y, z), vec3_make(x, y, z));
}

HD real3 real3_from(vec3 v)
{
    return real3_make(v.x, v.y, v.z);
}

HD dvec3 real3_double(real3 v)
{
    return dvec3_make(v.x, v.y, v.z);
}

HD real3 real3_add(real3 a, real3 b)
{
    return real3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

HD real3 real3_sub(real3 a, real3 b)
{
    return real3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

HD real3 real3_scale(real3 a, real s)
{
    return real3_make(a.x * s, a.y * s, a.z * s);
}

/* a + s b */
HD real3 real3_mad(real3 a, real s, real3 b)
{
    return real3_make(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

HD real3 real3_cross(real3 a, real3 b)
{
    return real3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                      a.x * b.y - a.y * b.x);
}

HD real real3_get(real3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

HD real real3_dot(real3 a, real3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HD real real3_length(real3 a)
{
    return real_sqrt(real3_dot(a, a));
}

#endif
