/* bvh.h - the nearest surface along a ray.
 *
 * Hits are ordered by (distance, key), the key naming shape or triangle and
 * the root of it. A ray that passes through a boundary goes on from its hit in
 * that order, origin and direction unchanged: every root is computed from the
 * same numbers again, so none is found twice and none of several at the same
 * distance is lost, without any epsilon. */
#ifndef CORE_PHYSICS_BVH_H
#define CORE_PHYSICS_BVH_H
#include "core/physics/scene.h"
#include "core/physics/shape.h"
#include "core/physics/triangle.h"

enum { SHAPE_MESH = 100, BVH_STACK = 64 };

typedef struct {
    float t;
    uint64_t key;           /* 4 item + root; orders hits at equal t       */
    int32_t shape;          /* -1: no hit                                  */
    int64_t triangle;       /* -1: an analytic shape                       */
    int32_t root, surface;  /* of an analytic shape                        */
    float u, v;             /* barycentric, of corners 1 and 2             */
} ray_hit;

typedef struct {
    vec3 o, d;
    vec3 inverse;           /* 1 / d                                       */
    triangle_ray shear;
} bvh_ray;

HD ray_hit hit_none(float t_max)
{
    ray_hit h;
    h.t = t_max;
    h.key = UINT64_MAX;
    h.shape = -1;
    h.triangle = -1;
    h.root = h.surface = 0;
    h.u = h.v = 0.0f;
    return h;
}

/* The position from which a ray's first hit is sought. */
HD ray_hit hit_start(float t_min)
{
    return hit_none(t_min);
}

HD bool hit_before(float t, uint64_t key, const ray_hit *h)
{
    return t < h->t || (t == h->t && key < h->key);
}

HD bool hit_after(float t, uint64_t key, const ray_hit *h)
{
    return t > h->t || (t == h->t && key > h->key);
}

HD bvh_ray bvh_ray_make(vec3 o, vec3 d)
{
    bvh_ray r;
    r.o = o;
    r.d = d;
    r.inverse = vec3_make(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
    r.shear = triangle_ray_make(d);
    return r;
}

HD void bvh_hit_shape(const flat_scene *s, const bvh_ray *r, int32_t shape,
                      const ray_hit *after, ray_hit *best)
{
    const flat_shape *f = &s->shapes[shape];
    float t[SHAPE_MAX_ROOTS];
    int surface[SHAPE_MAX_ROOTS];
    vec3 o = affine_point(&f->to_local, r->o);
    vec3 d = affine_vector(&f->to_local, r->d);
    int roots = shape_roots(f->kind, f->params, o, d, t, surface);
    for (int i = 0; i < roots; i++) {
        uint64_t key = 4 * (uint64_t)shape + (uint64_t)i;
        if (!hit_after(t[i], key, after) || !hit_before(t[i], key, best))
            continue;
        best->t = t[i];
        best->key = key;
        best->shape = shape;
        best->triangle = -1;
        best->root = i;
        best->surface = surface[i];
    }
}

HD void bvh_hit_triangle(const flat_scene *s, const bvh_ray *r, uint64_t i,
                         const ray_hit *after, ray_hit *best)
{
    const flat_triangle *f = &s->triangles[i];
    float t, u, v;
    if (!triangle_hit(&r->shear, r->o, f->p[0], f->p[1], f->p[2], &t, &u, &v))
        return;
    uint64_t key = 4 * (s->shapes_count + i);
    if (!hit_after(t, key, after) || !hit_before(t, key, best))
        return;
    best->t = t;
    best->key = key;
    best->shape = f->shape;
    best->triangle = (int64_t)i;
    best->u = u;
    best->v = v;
}

HD void bvh_hit_leaf(const flat_scene *s, const bvh_ray *r,
                     const bvh_node *n, const ray_hit *after, ray_hit *best)
{
    for (uint32_t i = 0; i < n->count; i++) {
        uint32_t item = s->bvh_items[n->first + i];
        if (item < s->shapes_count)
            bvh_hit_shape(s, r, (int32_t)item, after, best);
        else
            bvh_hit_triangle(s, r, item - s->shapes_count, after, best);
    }
}

/* Entry distance of the box within [t_min, t_max]; infinite if missed. The
 * far side is widened by the rounding of the slab test (Ize 2013). */
HD float bvh_enter(const bvh_node *n, const bvh_ray *r, float t_min,
                   float t_max)
{
    const float wider = 1.0000004f;
    float ax = (n->lo[0] - r->o.x) * r->inverse.x;
    float bx = (n->hi[0] - r->o.x) * r->inverse.x;
    float ay = (n->lo[1] - r->o.y) * r->inverse.y;
    float by = (n->hi[1] - r->o.y) * r->inverse.y;
    float az = (n->lo[2] - r->o.z) * r->inverse.z;
    float bz = (n->hi[2] - r->o.z) * r->inverse.z;
    float enter = hd_max(hd_max(hd_min(ax, bx), hd_min(ay, by)),
                        hd_max(hd_min(az, bz), t_min));
    float leave = hd_min(hd_min(hd_max(ax, bx), hd_max(ay, by)),
                         hd_max(az, bz));
    return enter <= hd_min(leave * wider, t_max) ? enter : INFINITY;
}

/* Nearest hit behind `after` and before distance t_max. */
HD ray_hit bvh_nearest(const flat_scene *s, const bvh_ray *r,
                       const ray_hit *after, float t_max)
{
    ray_hit best = hit_none(t_max);
    best.key = 0;           /* t_max itself is excluded */
    for (uint64_t i = 0; i < s->unbounded_count; i++)
        bvh_hit_shape(s, r, s->unbounded[i], after, &best);
    uint32_t stack[BVH_STACK];
    int depth = 0;
    uint32_t node = 0;
    if (s->bvh_count == 0 ||
        bvh_enter(&s->bvh[0], r, after->t, best.t) == INFINITY)
        return best;
    for (;;) {
        const bvh_node *n = &s->bvh[node];
        if (n->count > 0) {
            bvh_hit_leaf(s, r, n, after, &best);
        } else {
            uint32_t a = n->first, b = n->first + 1;
            float ta = bvh_enter(&s->bvh[a], r, after->t, best.t);
            float tb = bvh_enter(&s->bvh[b], r, after->t, best.t);
            if (tb < ta) {
                uint32_t c = a;
                a = b;
                b = c;
                float tc = ta;
                ta = tb;
                tb = tc;
            }
            if (tb < INFINITY)
                stack[depth++] = b;
            if (ta < INFINITY) {
                node = a;
                continue;
            }
        }
        do {
            if (depth == 0)
                return best;
            node = stack[--depth];
        } while (bvh_enter(&s->bvh[node], r, after->t, best.t) == INFINITY);
    }
}

/* Whether the ray enters the shape's inside at this hit. The roots of a
 * closed shape alternate; an open mesh or a plane goes by its normal. */
HD bool hit_enters(const flat_scene *s, const ray_hit *h, vec3 d)
{
    const flat_shape *f = &s->shapes[h->shape];
    bool in;
    if (h->triangle >= 0) {
        const flat_triangle *t = &s->triangles[h->triangle];
        vec3 n = vec3_cross(vec3_sub(t->p[1], t->p[0]),
                            vec3_sub(t->p[2], t->p[0]));
        in = (vec3_dot(n, d) < 0.0f) != ((f->flags & SHAPE_FLIPPED) != 0);
    } else if (f->kind == SHAPE_PLANE) {
        in = affine_vector(&f->to_local, d).z < 0.0f;
    } else {
        in = (h->root & 1) == 0;
    }
    return in != ((f->flags & SHAPE_INVERSE) != 0);
}

#endif
