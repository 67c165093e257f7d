/* bvh.h - the nearest surface along a ray.
 *
 * A ray that passes through a boundary goes on from its hit in the order of
 * ray.h, origin and direction unchanged: every root is computed from the same
 * numbers again, so none is found twice and none of several at the same
 * distance is lost, without any epsilon. */
#ifndef CORE_PHYSICS_BVH_H
#define CORE_PHYSICS_BVH_H
#include "core/physics/csg.h"

/* Completes a hit at which the ray gets into the primitive or `out` of it;
 * false where it is nothing to the composite that the primitive is part of. */
HD bool bvh_accept(const flat_scene *s, const bvh_ray *r, bool out,
                   ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (csg_has_media(s, f) && f->kind != SHAPE_DISC)
        h->turn = out != ((f->flags & SHAPE_INVERSE) != 0) ? TURN_OUT
                                                           : TURN_IN;
    if (f->node < 0)
        return h->seen || h->turn != TURN_NONE;
    csg_place at = csg_on_ray(r, h->t, h->key);
    return csg_crossing(s, f, &at, h);
}

/* Faces of solids that close them have negative numbers; an isosurface's
 * container has all but 0. */
HD bool bvh_seen(const flat_shape *f, int surface)
{
    bool solid = leaf_is_solid(f) && f->kind != SOLID_ISOSURFACE;
    bool cap = solid ? surface < 0 : surface != SHAPE_SIDE;
    return !(f->flags & SHAPE_UNSEEN) && !(cap && (f->flags & SHAPE_OPEN));
}

HD void bvh_hit_shape(const flat_scene *s, const bvh_ray *r, int32_t shape,
                      const ray_hit *after, ray_hit *best)
{
    const flat_shape *f = &s->shapes[shape];
    real t[LEAF_MAX_ROOTS];
    int surface[LEAF_MAX_ROOTS];
    int roots = leaf_roots(s, f, r, t, surface);
    bool out = leaf_inside_first(s, f, r, t, roots);
    for (int i = 0; i < roots; i++, out = !out) {
        ray_hit h = hit_none(t[i]);
        h.key = ray_key((uint64_t)shape, i);
        h.shape = shape;
        h.root = i;
        h.surface = surface[i];
        h.seen = bvh_seen(f, surface[i]);
        if (hit_after(t[i], h.key, after) && hit_before(t[i], h.key, best) &&
            bvh_accept(s, r, out, &h))
            *best = h;
    }
}

/* Whether the ray leaves a mesh at the hit: by its other walls where it is a
 * leaf, else by the triangle's normal, as it may be open. */
HD_APART bool bvh_leaves(const flat_scene *s, const bvh_ray *r,
                         const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (f->node >= 0) {
        csg_place at = csg_on_ray(r, h->t, h->key);
        return !csg_mesh(s, f, &at);
    }
    const flat_triangle *t = &s->triangles[h->triangle];
    real3 p = real3_from(t->p[0]);
    real3 n = real3_cross(real3_sub(real3_from(t->p[1]), p),
                          real3_sub(real3_from(t->p[2]), p));
    bool flipped = (f->flags & SHAPE_FLIPPED) != 0;
    return (real3_dot(n, r->d) < 0) == flipped;
}

HD void bvh_hit_triangle(const flat_scene *s, const bvh_ray *r, uint64_t i,
                         const ray_hit *after, ray_hit *best)
{
    const flat_triangle *f = &s->triangles[i];
    real t, u, v;
    if (!triangle_hit(&r->shear, r->o, real3_from(f->p[0]),
                      real3_from(f->p[1]), real3_from(f->p[2]), &t, &u, &v))
        return;
    ray_hit h = hit_none(t);
    h.key = ray_key(s->shapes_count + i, 0);
    if (!hit_after(t, h.key, after) || !hit_before(t, h.key, best))
        return;
    h.shape = f->shape;
    h.triangle = (int64_t)i;
    h.u = u;
    h.v = v;
    h.seen = !f->unseen;
    bool media = csg_has_media(s, &s->shapes[h.shape]);
    if (bvh_accept(s, r, media && bvh_leaves(s, r, &h), &h))
        *best = h;
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

/* Nearest hit behind `after` and before distance t_max. */
HD ray_hit bvh_nearest(const flat_scene *s, const bvh_ray *r,
                       const ray_hit *after, real t_max)
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
            real ta = bvh_enter(&s->bvh[a], r, after->t, best.t);
            real tb = bvh_enter(&s->bvh[b], r, after->t, best.t);
            if (tb < ta) {
                uint32_t c = a;
                a = b;
                b = c;
                real tc = ta;
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

#endif
