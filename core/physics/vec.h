/* vec.h - points, directions, linear colours, affine maps: values. */
#ifndef CORE_PHYSICS_VEC_H
#define CORE_PHYSICS_VEC_H
#include <math.h>
#include "core/physics/hd.h"

typedef struct { float x, y, z; } vec3;
typedef struct { float r, g, b; } rgb;      /* linear Rec.709             */
typedef struct { float m[12]; } affine;     /* rows of A|b: p' = A p + b  */

HD vec3 vec3_make(float x, float y, float z)
{
    vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

HD vec3 vec3_add(vec3 a, vec3 b)
{
    return vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

HD vec3 vec3_sub(vec3 a, vec3 b)
{
    return vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

HD vec3 vec3_scale(vec3 a, float s)
{
    return vec3_make(a.x * s, a.y * s, a.z * s);
}

/* a + s b */
HD vec3 vec3_mad(vec3 a, float s, vec3 b)
{
    return vec3_make(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

HD float vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HD vec3 vec3_cross(vec3 a, vec3 b)
{
    return vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                     a.x * b.y - a.y * b.x);
}

HD float vec3_length(vec3 a)
{
    return sqrtf(vec3_dot(a, a));
}

/* The zero vector stays zero. */
HD vec3 vec3_normalize(vec3 a)
{
    float l = vec3_length(a);
    return l > 0.0f ? vec3_scale(a, 1.0f / l) : a;
}

HD float vec3_get(vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

HD vec3 vec3_min(vec3 a, vec3 b)
{
    return vec3_make(hd_min(a.x, b.x), hd_min(a.y, b.y), hd_min(a.z, b.z));
}

HD vec3 vec3_max(vec3 a, vec3 b)
{
    return vec3_make(hd_max(a.x, b.x), hd_max(a.y, b.y), hd_max(a.z, b.z));
}

HD rgb rgb_make(float r, float g, float b)
{
    rgb c;
    c.r = r;
    c.g = g;
    c.b = b;
    return c;
}

HD rgb rgb_gray(float v)
{
    return rgb_make(v, v, v);
}

HD rgb rgb_add(rgb a, rgb b)
{
    return rgb_make(a.r + b.r, a.g + b.g, a.b + b.b);
}

HD rgb rgb_sub(rgb a, rgb b)
{
    return rgb_make(a.r - b.r, a.g - b.g, a.b - b.b);
}

HD rgb rgb_mul(rgb a, rgb b)
{
    return rgb_make(a.r * b.r, a.g * b.g, a.b * b.b);
}

HD rgb rgb_scale(rgb a, float s)
{
    return rgb_make(a.r * s, a.g * s, a.b * s);
}

HD float rgb_get(rgb a, int channel)
{
    return channel == 0 ? a.r : channel == 1 ? a.g : a.b;
}

HD float rgb_max(rgb a)
{
    return hd_max(a.r, hd_max(a.g, a.b));
}

HD float rgb_min(rgb a)
{
    return hd_min(a.r, hd_min(a.g, a.b));
}

/* The size of its largest component. */
HD float rgb_size(rgb a)
{
    return rgb_max(rgb_make(fabsf(a.r), fabsf(a.g), fabsf(a.b)));
}

HD float rgb_mean(rgb a)
{
    return (a.r + a.g + a.b) * (1.0f / 3.0f);
}

/* CIE Y of linear Rec.709. */
HD float rgb_luminance(rgb a)
{
    return 0.2126390f * a.r + 0.7151687f * a.g + 0.0721923f * a.b;
}

HD bool rgb_is_black(rgb a)
{
    return a.r == 0.0f && a.g == 0.0f && a.b == 0.0f;
}

HD vec3 affine_point(const affine *a, vec3 p)
{
    const float *m = a->m;
    return vec3_make(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                     m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                     m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
}

HD vec3 affine_vector(const affine *a, vec3 v)
{
    const float *m = a->m;
    return vec3_make(m[0] * v.x + m[1] * v.y + m[2] * v.z,
                     m[4] * v.x + m[5] * v.y + m[6] * v.z,
                     m[8] * v.x + m[9] * v.y + m[10] * v.z);
}

/* A^T n: takes a local normal to the world when `a` is world-to-local. */
HD vec3 affine_normal(const affine *a, vec3 n)
{
    const float *m = a->m;
    return vec3_make(m[0] * n.x + m[4] * n.y + m[8] * n.z,
                     m[1] * n.x + m[5] * n.y + m[9] * n.z,
                     m[2] * n.x + m[6] * n.y + m[10] * n.z);
}

#endif
