/* equiangular.h - points along a ray chosen by the angle at which a light sees
 * them [Kulla and Fajardo 2012]: what falls off as 1/d^2 comes out even.
 *
 * The ray is counted in t from the foot of the light on it; `width` is the
 * light's distance from the ray, or more where its fall-off is blunter. */
#ifndef CORE_PHYSICS_EQUIANGULAR_H
#define CORE_PHYSICS_EQUIANGULAR_H
#include "core/physics/fmath.h"
#include "core/physics/vec.h"

typedef struct {
    float foot, width;
    float from, to;         /* angles of the ends                          */
} equiangular;

/* For t in [a, b], b > a, of the ray from o along the unit vector d, and a
 * light at `place` that is even within `blunt`. */
HD equiangular equiangular_make(vec3 o, vec3 d, float a, float b, vec3 place,
                                float blunt)
{
    equiangular e;
    vec3 to = vec3_sub(place, o);
    e.foot = vec3_dot(to, d);
    float off = vec3_length(vec3_mad(to, -e.foot, d));
    /* The same clamped width in angles, place and density. */
    e.width = hd_max(hd_max(off, blunt), 1e-6f * (b - a));
    e.from = fm_atan2(a - e.foot, e.width);
    e.to = fm_atan2(b - e.foot, e.width);
    return e;
}

HD float equiangular_sample(const equiangular *e, float u)
{
    float s, c;
    fm_sincos(e->from + u * (e->to - e->from), &s, &c);
    return e->foot + e->width * (s / hd_max(c, 1e-9f));
}

/* Density per length at t. */
HD float equiangular_pdf(const equiangular *e, float t)
{
    float x = (t - e->foot) / e->width;
    return 1.0f / ((e->to - e->from) * e->width * (1.0f + x * x));
}

#endif
