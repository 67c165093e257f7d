/* item.h - what a ray hits of one item of a tree, a shape or a triangle. */
#ifndef CORE_PHYSICS_ITEM_H
#define CORE_PHYSICS_ITEM_H
#include "core/physics/csg.h"

/* Completes a hit at which the ray gets into the primitive or `out` of it;
 * false where it is nothing to the composite that the primitive is part of. */
HD bool item_accept(const flat_scene *s, const bvh_ray *r, bool out,
                   ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (csg_has_media(s, f) && f->kind != SHAPE_DISC)
        h->turn = out != ((f->flags & SHAPE_INVERSE) != 0) ? TURN_OUT
                                                           : TURN_IN;
    if (!scene_may(MAY_COMPOSITES) || f->node < 0)
        return h->seen || h->turn != TURN_NONE;
    csg_place at = csg_on_ray(r, h->t, h->key);
    return csg_crossing(s, f, &at, h);
}

/* Faces of solids that close them have negative numbers; an isosurface's
 * container has all but 0. */
HD bool item_seen(const flat_shape *f, int surface)
{
    bool solid = leaf_is_solid(f) && f->kind != SOLID_ISOSURFACE;
    bool cap = solid ? surface < 0 : surface != SHAPE_SIDE;
    return !(f->flags & SHAPE_UNSEEN) && !(cap && (f->flags & SHAPE_OPEN));
}

HD void item_hit_shape(const flat_scene *s, const bvh_ray *r, int32_t shape,
                      const ray_hit *after, ray_hit *best)
{
    const flat_shape *f = &s->shapes[shape];
    real t[LEAF_MAX_ROOTS];
    int surface[LEAF_MAX_ROOTS];
    int roots = leaf_roots(s, f, r, t, surface);
    bool out = leaf_inside_first(s, f, r, t, roots);
    for (int i = 0; i < roots; i++, out = !out) {
        uint64_t key = ray_key((uint64_t)shape, i);
        if (!hit_after(t[i], key, after) || !hit_before(t[i], key, best))
            continue;
        ray_hit h = hit_none(t[i]);
        h.key = key;
        h.shape = shape;
        h.root = i;
        h.surface = surface[i];
        h.seen = item_seen(f, surface[i]);
        if (item_accept(s, r, out, &h))
            *best = h;
    }
}

/* Whether the ray leaves a mesh at the hit: by its other walls where it is a
 * leaf, else by the triangle's normal, as it may be open. */
HD_APART bool item_leaves(const flat_scene *s, const bvh_ray *r,
                         const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (scene_may(MAY_COMPOSITES) && f->node >= 0) {
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

HD void item_hit_triangle(const flat_scene *s, const bvh_ray *r, uint64_t i,
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
    if (item_accept(s, r, media && item_leaves(s, r, &h), &h))
        *best = h;
}

/* Items of a leaf: numbers of shapes and, after these, of triangles. */
HD void item_hit(const flat_scene *s, const bvh_ray *r, const uint32_t *items,
                 uint32_t count, const ray_hit *after, ray_hit *best)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t item = items[i];
        if (!scene_may(MAY_MESHES) || item < s->shapes_count)
            item_hit_shape(s, r, (int32_t)item, after, best);
        else
            item_hit_triangle(s, r, item - s->shapes_count, after, best);
    }
}

#endif
