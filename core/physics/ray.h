/* ray.h - a line, what it hits and in which order, and boxes on it.
 *
 * Hits are ordered by (distance, key), the key naming shape or triangle and
 * the root of it. */
#ifndef CORE_PHYSICS_RAY_H
#define CORE_PHYSICS_RAY_H
#include "core/physics/lanes.h"
#include "core/physics/scene.h"
#include "core/physics/triangle.h"

/* Places that a search of the BVH keeps, at most. */
enum { BVH_STACK = 64 };

/* What a hit is to the media around it. */
enum { TURN_NONE, TURN_IN, TURN_OUT };

typedef struct {
    real t;
    uint64_t key;           /* orders hits at equal t                      */
    int32_t shape;          /* -1: no hit                                  */
    int64_t triangle;       /* -1: not of a mesh                           */
    int32_t root, surface;  /* number of the root, and face or piece       */
    real u, v;              /* barycentric, of corners 1 and 2             */
    int32_t seen;           /* 0: a boundary of media alone                */
    int32_t turn;           /* of a composite's leaf: TURN_*               */
} ray_hit;

typedef struct {
    real3 o, d;
    real3 inverse;          /* 1 / d                                       */
    triangle_ray shear;
} bvh_ray;

/* Items are shapes, and after them triangles. */
HD uint64_t ray_key(uint64_t item, int root)
{
    return item << 16 | (uint64_t)root;
}

HD ray_hit hit_none(real t_max)
{
    ray_hit h;
    h.t = t_max;
    h.key = UINT64_MAX;
    h.shape = -1;
    h.triangle = -1;
    h.root = h.surface = 0;
    h.u = h.v = 0;
    h.seen = 1;
    h.turn = TURN_NONE;
    return h;
}

/* The position from which a ray's first hit is sought. */
HD ray_hit hit_start(real t_min)
{
    return hit_none(t_min);
}

HD bool hit_before(real t, uint64_t key, const ray_hit *h)
{
    return t < h->t || (t == h->t && key < h->key);
}

HD bool hit_after(real t, uint64_t key, const ray_hit *h)
{
    return t > h->t || (t == h->t && key > h->key);
}

HD bvh_ray bvh_ray_make(real3 o, real3 d)
{
    bvh_ray r;
    r.o = o;
    r.d = d;
    r.inverse = real3_make(1 / d.x, 1 / d.y, 1 / d.z);
    if (scene_may(MAY_MESHES))
        r.shear = triangle_ray_make(d);
    return r;
}

/* What the distance of a hit may be off by, computed from corners about a unit
 * away: boxes count as touched this much before and behind. */
HD real ray_slack(real t)
{
#ifdef PHYSICS_DOUBLE
    return 1e-13 * (1 + t);
#else
    return 2e-6f * (1 + t);
#endif
}

/* Distances at which the line is in the box; the far side is widened by the
 * rounding of the slab test (Ize 2013). */
HD void bvh_slabs(const bvh_box *n, const bvh_ray *r, real *enter,
                  real *leave)
{
    const real wider = REAL(1.0000004);
    real ax = (n->lo[0] - r->o.x) * r->inverse.x;
    real bx = (n->hi[0] - r->o.x) * r->inverse.x;
    real ay = (n->lo[1] - r->o.y) * r->inverse.y;
    real by = (n->hi[1] - r->o.y) * r->inverse.y;
    real az = (n->lo[2] - r->o.z) * r->inverse.z;
    real bz = (n->hi[2] - r->o.z) * r->inverse.z;
    *enter = real_max(real_max(real_min(ax, bx), real_min(ay, by)),
                      real_min(az, bz));
    *leave = wider * real_min(real_min(real_max(ax, bx), real_max(ay, by)),
                              real_max(az, bz));
}

/* Entry distance of the box within [t_min, t_max], t_min >= 0; infinite if
 * missed. */
HD real bvh_enter(const bvh_box *n, const bvh_ray *r, real t_min, real t_max)
{
    real enter, leave;
    bvh_slabs(n, r, &enter, &leave);
    bool touched = enter <= leave && enter <= t_max + ray_slack(t_max) &&
                   leave >= t_min - ray_slack(t_min);
    return touched ? real_max(enter, t_min) : INFINITY;
}

/* Where a line gets into four boxes and out of them by one axis of theirs. */
HD void bvh_cut(const float *lo, const float *hi, real o, real inverse,
                lanes *enter, lanes *leave)
{
    lanes_load(enter, inverse < 0 ? hi : lo);
    lanes_load(leave, inverse < 0 ? lo : hi);
    LANES_EACH(*enter, (LANES_OF(*enter) - o) * inverse);
    LANES_EACH(*leave, (LANES_OF(*leave) - o) * inverse);
}

/* What bvh_enter finds of the boxes of a node's children, but for lines in the
 * plane of a face. */
HD void bvh_enter_all(const bvh_node *n, const bvh_ray *r, real t_min,
                      real t_max, real t[BVH_WIDTH])
{
    const real wider = REAL(1.0000004);
    const real least = t_min - ray_slack(t_min);
    const real most = t_max + ray_slack(t_max);
    lanes enter, leave, near, far;
    bvh_cut(n->lo[0], n->hi[0], r->o.x, r->inverse.x, &enter, &leave);
    bvh_cut(n->lo[1], n->hi[1], r->o.y, r->inverse.y, &near, &far);
    lanes_max(&enter, &enter, &near);
    lanes_min(&leave, &leave, &far);
    bvh_cut(n->lo[2], n->hi[2], r->o.z, r->inverse.z, &near, &far);
    lanes_max(&enter, &enter, &near);
    lanes_min(&leave, &leave, &far);
    for (int i = 0; i < BVH_WIDTH; i++) {
        real from = LANES_AT(enter, i), to = wider * LANES_AT(leave, i);
        bool touched = from <= to && from <= most && to >= least;
        t[i] = touched ? real_max(from, t_min) : INFINITY;
    }
}

#endif
