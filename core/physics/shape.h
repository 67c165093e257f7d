/* shape.h - analytic shapes in their own space: roots along a ray, normals,
 * insides. Every shape is closed and convex, or has no thickness; the roots of
 * a closed one come in pairs, in and out.
 *
 *   sphere    |p| = 1                     box       |x|, |y|, |z| <= 1
 *   cylinder  radius 1, z from 0 to 1; params[0] = 1: without caps
 *   cone      radius params[0] at z = 0, params[1] at z = 1; params[2] = 1:
 *             without caps
 *   plane     z = 0, the inside below     disc      z = 0, radius from
 *                                                   params[0] to 1          */
#ifndef CORE_PHYSICS_SHAPE_H
#define CORE_PHYSICS_SHAPE_H
#include "core/physics/vec.h"

enum { SHAPE_SPHERE, SHAPE_BOX, SHAPE_CYLINDER, SHAPE_CONE, SHAPE_PLANE,
       SHAPE_DISC };
enum { SHAPE_MAX_ROOTS = 4 };
enum { SHAPE_SIDE, SHAPE_BOTTOM, SHAPE_TOP };   /* of cylinder and cone */

/* Roots of a t^2 - 2 b t + c, t0 <= t1, from the discriminant b^2 - a c that
 * the caller has found without cancellation (Haines et al. 2019). */
HD void shape_quadratic(float a, float b, float c, float discriminant,
                        float *t0, float *t1)
{
    float root = sqrtf(discriminant);
    float q = b + (b >= 0.0f ? root : -root);
    float near = q != 0.0f ? c / q : 0.0f, far = q / a;
    *t0 = hd_min(near, far);
    *t1 = hd_max(near, far);
}

HD int shape_sphere_roots(vec3 o, vec3 d, float t[SHAPE_MAX_ROOTS])
{
    float a = vec3_dot(d, d), b = -vec3_dot(o, d);
    if (!(a > 0.0f))
        return 0;
    /* Distance of the centre from the ray: no cancellation from afar. */
    vec3 foot = vec3_mad(o, b / a, d);
    float over = 1.0f - vec3_dot(foot, foot);
    if (!(over >= 0.0f))
        return 0;
    float c = vec3_dot(o, o) - 1.0f;
    shape_quadratic(a, b, c, over * a, &t[0], &t[1]);
    return 2;
}

/* Clips an interval to lo <= o + t d <= hi; axis names the side it is cut
 * at, negative for the lower one. */
HD bool shape_slab(float o, float d, float lo, float hi, int axis,
                   float t[SHAPE_MAX_ROOTS], int surface[SHAPE_MAX_ROOTS])
{
    if (d == 0.0f)
        return o >= lo && o <= hi;
    float a = (lo - o) / d, b = (hi - o) / d;
    int from = -axis, to = axis;
    if (a > b) {
        float c = a;
        a = b;
        b = c;
        from = axis;
        to = -axis;
    }
    if (a > t[0]) {
        t[0] = a;
        surface[0] = from;
    }
    if (b < t[1]) {
        t[1] = b;
        surface[1] = to;
    }
    return t[0] <= t[1];
}

HD int shape_box_roots(vec3 o, vec3 d, float t[SHAPE_MAX_ROOTS],
                       int surface[SHAPE_MAX_ROOTS])
{
    t[0] = -INFINITY;
    t[1] = INFINITY;
    bool hit = shape_slab(o.x, d.x, -1.0f, 1.0f, 1, t, surface) &&
               shape_slab(o.y, d.y, -1.0f, 1.0f, 2, t, surface) &&
               shape_slab(o.z, d.z, -1.0f, 1.0f, 3, t, surface);
    return hit && t[1] < INFINITY ? 2 : 0;
}

/* Interval inside of x^2 + y^2 <= 1. */
HD bool shape_tube(vec3 o, vec3 d, float t[SHAPE_MAX_ROOTS])
{
    float a = d.x * d.x + d.y * d.y, b = -(o.x * d.x + o.y * d.y);
    float c = o.x * o.x + o.y * o.y - 1.0f;
    t[0] = -INFINITY;
    t[1] = INFINITY;
    if (!(a > 0.0f))
        return c <= 0.0f;
    float fx = o.x + b / a * d.x, fy = o.y + b / a * d.y;
    float over = 1.0f - (fx * fx + fy * fy);
    if (!(over >= 0.0f))
        return false;
    shape_quadratic(a, b, c, over * a, &t[0], &t[1]);
    return true;
}

/* Interval of the ray in x^2 + y^2 <= (r + k z)^2, on the nappe where
 * r + k z >= 0; what lies on the other nappe may come too, beyond the apex. */
HD bool shape_nappe(float r0, float k, vec3 o, vec3 d,
                    float t[SHAPE_MAX_ROOTS])
{
    float r = r0 + k * o.z, s = k * d.z, t0, t1;
    float a = d.x * d.x + d.y * d.y - s * s;
    float b = r * s - (o.x * d.x + o.y * d.y);
    float c = o.x * o.x + o.y * o.y - r * r;
    float discriminant = b * b - a * c;
    t[0] = -INFINITY;
    t[1] = INFINITY;
    if (a == 0.0f) {
        if (b != 0.0f)
            t[b > 0.0f ? 0 : 1] = 0.5f * c / b;
        return b != 0.0f || c <= 0.0f;
    }
    if (a > 0.0f && !(discriminant >= 0.0f))
        return false;
    shape_quadratic(a, b, c, hd_max(discriminant, 0.0f), &t0, &t1);
    if (a > 0.0f || s < 0.0f)
        t[1] = a > 0.0f ? t1 : t0;
    if (a > 0.0f || s > 0.0f)
        t[0] = a > 0.0f ? t0 : t1;
    return true;
}

/* The interval as roots: cut at the caps, or those of its ends that lie
 * between them. */
HD int shape_between_caps(bool capped, vec3 o, vec3 d,
                          float t[SHAPE_MAX_ROOTS],
                          int surface[SHAPE_MAX_ROOTS])
{
    surface[0] = surface[1] = 0;
    if (capped) {
        if (!shape_slab(o.z, d.z, 0.0f, 1.0f, 1, t, surface) ||
            !(t[1] < INFINITY) || !(t[0] > -INFINITY))
            return 0;
        for (int i = 0; i < 2; i++)
            surface[i] = surface[i] == 0 ? SHAPE_SIDE
                       : surface[i] < 0 ? SHAPE_BOTTOM : SHAPE_TOP;
        return 2;
    }
    int n = 0;
    for (int i = 0; i < 2; i++) {
        float z = o.z + t[i] * d.z;
        if (z >= 0.0f && z <= 1.0f && fabsf(t[i]) < INFINITY)
            t[n++] = t[i];
    }
    return n;
}

HD int shape_cylinder_roots(const float *params, vec3 o, vec3 d,
                            float t[SHAPE_MAX_ROOTS],
                            int surface[SHAPE_MAX_ROOTS])
{
    if (!shape_tube(o, d, t))
        return 0;
    return shape_between_caps(params[0] == 0.0f, o, d, t, surface);
}

/* Reckoned from the ray's point nearest to the middle of the axis, because
 * the cone's discriminant has no form that stands a distant origin. */
HD int shape_cone_roots(const float *params, vec3 o, vec3 d,
                        float t[SHAPE_MAX_ROOTS],
                        int surface[SHAPE_MAX_ROOTS])
{
    vec3 to_middle = vec3_sub(vec3_make(0.0f, 0.0f, 0.5f), o);
    float a = vec3_dot(d, d);
    if (!(a > 0.0f))
        return 0;
    float shift = vec3_dot(to_middle, d) / a;
    vec3 near = vec3_mad(o, shift, d);
    if (!shape_nappe(params[0], params[1] - params[0], near, d, t))
        return 0;
    int n = shape_between_caps(params[2] == 0.0f, near, d, t, surface);
    t[0] += shift;
    t[1] += shift;
    return n;
}

HD int shape_flat_roots(bool disc, const float *params, vec3 o, vec3 d,
                        float t[SHAPE_MAX_ROOTS])
{
    if (d.z == 0.0f)
        return 0;
    t[0] = -o.z / d.z;
    if (!disc)
        return 1;
    float x = o.x + t[0] * d.x, y = o.y + t[0] * d.y, r = x * x + y * y;
    return r <= 1.0f && r >= params[0] * params[0];
}

/* All roots of the shape along o + t d, ascending, whatever their sign; d need
 * not be of unit length. surface[i] says which face, for shape_normal. */
HD int shape_roots(int kind, const float *params, vec3 o, vec3 d,
                   float t[SHAPE_MAX_ROOTS], int surface[SHAPE_MAX_ROOTS])
{
    surface[0] = surface[1] = 0;
    switch (kind) {
    case SHAPE_SPHERE:
        return shape_sphere_roots(o, d, t);
    case SHAPE_BOX:
        return shape_box_roots(o, d, t, surface);
    case SHAPE_CYLINDER:
        return shape_cylinder_roots(params, o, d, t, surface);
    case SHAPE_CONE:
        return shape_cone_roots(params, o, d, t, surface);
    default:
        return shape_flat_roots(kind == SHAPE_DISC, params, o, d, t);
    }
}

/* Outward normal, not of unit length, at a point of the surface. */
HD vec3 shape_normal(int kind, const float *params, vec3 p, int surface)
{
    switch (kind) {
    case SHAPE_SPHERE:
        return p;
    case SHAPE_BOX: {
        float side = surface < 0 ? -1.0f : 1.0f;
        int axis = surface < 0 ? -surface : surface;
        return vec3_make(axis == 1 ? side : 0.0f, axis == 2 ? side : 0.0f,
                         axis == 3 ? side : 0.0f);
    }
    case SHAPE_CYLINDER:
    case SHAPE_CONE: {
        if (surface != SHAPE_SIDE)
            return vec3_make(0.0f, 0.0f, surface == SHAPE_TOP ? 1.0f : -1.0f);
        float k = kind == SHAPE_CONE ? params[1] - params[0] : 0.0f;
        float rho = sqrtf(p.x * p.x + p.y * p.y);
        if (rho == 0.0f)                            /* the apex of a cone */
            return vec3_make(0.0f, 0.0f, k > 0.0f ? -1.0f : 1.0f);
        return vec3_make(p.x, p.y, -k * rho);
    }
    default:
        return vec3_make(0.0f, 0.0f, 1.0f);
    }
}

HD bool shape_inside(int kind, const float *params, vec3 p)
{
    switch (kind) {
    case SHAPE_SPHERE:
        return vec3_dot(p, p) < 1.0f;
    case SHAPE_BOX:
        return fabsf(p.x) < 1.0f && fabsf(p.y) < 1.0f && fabsf(p.z) < 1.0f;
    case SHAPE_CYLINDER:
        return p.z > 0.0f && p.z < 1.0f && p.x * p.x + p.y * p.y < 1.0f;
    case SHAPE_CONE: {
        float r = params[0] + (params[1] - params[0]) * p.z;
        return p.z > 0.0f && p.z < 1.0f && p.x * p.x + p.y * p.y < r * r;
    }
    case SHAPE_PLANE:
        return p.z < 0.0f;
    default:
        return false;
    }
}

#endif
