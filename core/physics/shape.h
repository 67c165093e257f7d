/* shape.h - analytic shapes in their own space: roots along a ray, normals,
 * insides. Every shape is closed and convex, or has no thickness; the roots of
 * a closed one come in pairs, in and out.
 *
 *   sphere    |p| = 1                     box       |x|, |y|, |z| <= 1
 *   cylinder  radius 1, z from 0 to 1
 *   cone      radius params[0] at z = 0, params[1] at z = 1
 *   plane     z = 0, the inside below     disc      z = 0, radius from
 *                                                   params[0] to 1          */
#ifndef CORE_PHYSICS_SHAPE_H
#define CORE_PHYSICS_SHAPE_H
#include "core/physics/real.h"

enum { SHAPE_SPHERE, SHAPE_BOX, SHAPE_CYLINDER, SHAPE_CONE, SHAPE_PLANE,
       SHAPE_DISC };
enum { SHAPE_MAX_ROOTS = 4 };
enum { SHAPE_SIDE, SHAPE_BOTTOM, SHAPE_TOP };   /* of cylinder and cone */

/* Roots of a t^2 - 2 b t + c, t0 <= t1, from the discriminant b^2 - a c that
 * the caller has found without cancellation (Haines et al. 2019). */
HD void shape_quadratic(real a, real b, real c, real discriminant,
                        real *t0, real *t1)
{
    real root = real_sqrt(discriminant);
    real q = b + (b >= 0 ? root : -root);
    real near = q != 0 ? c / q : 0, far = q / a;
    *t0 = real_min(near, far);
    *t1 = real_max(near, far);
}

HD int shape_sphere_roots(real3 o, real3 d, real t[SHAPE_MAX_ROOTS])
{
    real a = real3_dot(d, d), b = -real3_dot(o, d);
    if (!(a > 0))
        return 0;
    /* Distance of the centre from the ray: no cancellation from afar. */
    real3 foot = real3_mad(o, b / a, d);
    real over = 1 - real3_dot(foot, foot);
    if (!(over >= 0))
        return 0;
    real c = real3_dot(o, o) - 1;
    shape_quadratic(a, b, c, over * a, &t[0], &t[1]);
    return 2;
}

/* Clips an interval to lo <= o + t d <= hi; axis names the side it is cut
 * at, negative for the lower one. */
HD bool shape_slab(real o, real d, real lo, real hi, int axis,
                   real t[SHAPE_MAX_ROOTS], int surface[SHAPE_MAX_ROOTS])
{
    if (d == 0)
        return o >= lo && o <= hi;
    real a = (lo - o) / d, b = (hi - o) / d;
    int from = -axis, to = axis;
    if (a > b) {
        real c = a;
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

HD int shape_box_roots(real3 o, real3 d, real t[SHAPE_MAX_ROOTS],
                       int surface[SHAPE_MAX_ROOTS])
{
    t[0] = -INFINITY;
    t[1] = INFINITY;
    bool hit = shape_slab(o.x, d.x, -1, 1, 1, t, surface) &&
               shape_slab(o.y, d.y, -1, 1, 2, t, surface) &&
               shape_slab(o.z, d.z, -1, 1, 3, t, surface);
    return hit && t[1] < INFINITY ? 2 : 0;
}

/* Interval inside of x^2 + y^2 <= 1. */
HD bool shape_tube(real3 o, real3 d, real t[SHAPE_MAX_ROOTS])
{
    real a = d.x * d.x + d.y * d.y, b = -(o.x * d.x + o.y * d.y);
    real c = o.x * o.x + o.y * o.y - 1;
    t[0] = -INFINITY;
    t[1] = INFINITY;
    if (!(a > 0))
        return c <= 0;
    real fx = o.x + b / a * d.x, fy = o.y + b / a * d.y;
    real over = 1 - (fx * fx + fy * fy);
    if (!(over >= 0))
        return false;
    shape_quadratic(a, b, c, over * a, &t[0], &t[1]);
    return true;
}

/* Interval of the ray in x^2 + y^2 <= (r + k z)^2, on the nappe where
 * r + k z >= 0; what lies on the other nappe may come too, beyond the apex. */
HD bool shape_nappe(real r0, real k, real3 o, real3 d,
                    real t[SHAPE_MAX_ROOTS])
{
    real r = r0 + k * o.z, s = k * d.z, t0, t1;
    real a = d.x * d.x + d.y * d.y - s * s;
    real b = r * s - (o.x * d.x + o.y * d.y);
    real c = o.x * o.x + o.y * o.y - r * r;
    real discriminant = b * b - a * c;
    t[0] = -INFINITY;
    t[1] = INFINITY;
    if (a == 0) {
        if (b != 0)
            t[b > 0 ? 0 : 1] = REAL(0.5) * c / b;
        return b != 0 || c <= 0;
    }
    if (a > 0 && !(discriminant >= 0))
        return false;
    shape_quadratic(a, b, c, real_max(discriminant, 0), &t0, &t1);
    if (a > 0 || s < 0)
        t[1] = a > 0 ? t1 : t0;
    if (a > 0 || s > 0)
        t[0] = a > 0 ? t0 : t1;
    return true;
}

/* The interval as roots, cut at the caps. */
HD int shape_between_caps(real3 o, real3 d, real t[SHAPE_MAX_ROOTS],
                          int surface[SHAPE_MAX_ROOTS])
{
    surface[0] = surface[1] = 0;
    if (!shape_slab(o.z, d.z, 0, 1, 1, t, surface) || !(t[1] < INFINITY) ||
        !(t[0] > -INFINITY))
        return 0;
    for (int i = 0; i < 2; i++)
        surface[i] = surface[i] == 0 ? SHAPE_SIDE
                   : surface[i] < 0 ? SHAPE_BOTTOM : SHAPE_TOP;
    return 2;
}

HD int shape_cylinder_roots(real3 o, real3 d, real t[SHAPE_MAX_ROOTS],
                            int surface[SHAPE_MAX_ROOTS])
{
    if (!shape_tube(o, d, t))
        return 0;
    return shape_between_caps(o, d, t, surface);
}

/* Reckoned from the ray's point nearest to the middle of the axis, because
 * the cone's discriminant has no form that stands a distant origin. */
HD int shape_cone_roots(const real *params, real3 o, real3 d,
                        real t[SHAPE_MAX_ROOTS],
                        int surface[SHAPE_MAX_ROOTS])
{
    real3 to_middle = real3_sub(real3_make(0, 0, REAL(0.5)), o);
    real a = real3_dot(d, d);
    if (!(a > 0))
        return 0;
    real shift = real3_dot(to_middle, d) / a;
    real3 near = real3_mad(o, shift, d);
    if (!shape_nappe(params[0], params[1] - params[0], near, d, t))
        return 0;
    int n = shape_between_caps(near, d, t, surface);
    t[0] += shift;
    t[1] += shift;
    return n;
}

HD int shape_flat_roots(bool disc, const real *params, real3 o, real3 d,
                        real t[SHAPE_MAX_ROOTS])
{
    if (d.z == 0)
        return 0;
    t[0] = -o.z / d.z;
    if (!disc)
        return 1;
    real x = o.x + t[0] * d.x, y = o.y + t[0] * d.y, r = x * x + y * y;
    return r <= 1 && r >= params[0] * params[0];
}

/* All roots of the shape along o + t d, ascending, whatever their sign; d need
 * not be of unit length. surface[i] says which face, for shape_normal. */
HD int shape_roots(int kind, const real *params, real3 o, real3 d,
                   real t[SHAPE_MAX_ROOTS], int surface[SHAPE_MAX_ROOTS])
{
    surface[0] = surface[1] = 0;
    switch (kind) {
    case SHAPE_SPHERE:
        return shape_sphere_roots(o, d, t);
    case SHAPE_BOX:
        return shape_box_roots(o, d, t, surface);
    case SHAPE_CYLINDER:
        return shape_cylinder_roots(o, d, t, surface);
    case SHAPE_CONE:
        return shape_cone_roots(params, o, d, t, surface);
    default:
        return shape_flat_roots(kind == SHAPE_DISC, params, o, d, t);
    }
}

/* Outward normal, not of unit length, at a point of the surface. */
HD real3 shape_normal(int kind, const real *params, real3 p, int surface)
{
    switch (kind) {
    case SHAPE_SPHERE:
        return p;
    case SHAPE_BOX: {
        real side = surface < 0 ? -1 : 1;
        int axis = surface < 0 ? -surface : surface;
        return real3_make(axis == 1 ? side : 0, axis == 2 ? side : 0,
                         axis == 3 ? side : 0);
    }
    case SHAPE_CYLINDER:
    case SHAPE_CONE: {
        if (surface != SHAPE_SIDE)
            return real3_make(0, 0, surface == SHAPE_TOP ? 1 : -1);
        real k = kind == SHAPE_CONE ? params[1] - params[0] : 0;
        real rho = real_sqrt(p.x * p.x + p.y * p.y);
        if (rho == 0)                            /* the apex of a cone */
            return real3_make(0, 0, k > 0 ? -1 : 1);
        return real3_make(p.x, p.y, -k * rho);
    }
    default:
        return real3_make(0, 0, 1);
    }
}

HD bool shape_inside(int kind, const real *params, real3 p)
{
    switch (kind) {
    case SHAPE_SPHERE:
        return real3_dot(p, p) < 1;
    case SHAPE_BOX:
        return real_abs(p.x) < 1 && real_abs(p.y) < 1 && real_abs(p.z) < 1;
    case SHAPE_CYLINDER:
        return p.z > 0 && p.z < 1 && p.x * p.x + p.y * p.y < 1;
    case SHAPE_CONE: {
        real r = params[0] + (params[1] - params[0]) * p.z;
        return p.z > 0 && p.z < 1 && p.x * p.x + p.y * p.y < r * r;
    }
    case SHAPE_PLANE:
        return p.z < 0;
    default:
        return false;
    }
}

#endif
