/* bvh.h - the nearest surface along a ray.
 *
 * A ray that passes through a boundary goes on from its hit in the order of
 * ray.h, origin and direction unchanged: every root is computed from the same
 * numbers again, so none is found twice and none of several at the same
 * distance is lost, without any epsilon. */
#ifndef CORE_PHYSICS_BVH_H
#define CORE_PHYSICS_BVH_H
#include "core/physics/kdtree.h"

/* The nearer of `best` and what the tree below a node holds behind `after`. */
HD void bvh_search(const flat_scene *s, const bvh_ray *r, uint32_t node,
                   const ray_hit *after, ray_hit *best)
{
    uint32_t stack[BVH_STACK];
    int depth = 0;
    if (bvh_enter(&s->bvh[node], r, after->t, best->t) == INFINITY)
        return;
    for (;;) {
        const bvh_node *n = &s->bvh[node];
        if (n->count > 0) {
            item_hit(s, r, s->bvh_items + n->first, n->count, after, best);
        } else {
            uint32_t a = n->first, b = n->first + 1;
            real ta = bvh_enter(&s->bvh[a], r, after->t, best->t);
            real tb = bvh_enter(&s->bvh[b], r, after->t, best->t);
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
                return;
            node = stack[--depth];
        } while (bvh_enter(&s->bvh[node], r, after->t, best->t) == INFINITY);
    }
}

HD_APART ray_hit bvh_seek(const flat_scene *s, const bvh_ray *r,
                          const ray_hit *after, real t_max)
{
    ray_hit best = hit_none(t_max);
    best.key = 0;           /* t_max itself is excluded */
    for (uint64_t i = 0; i < s->unbounded_count; i++)
        item_hit_shape(s, r, s->unbounded[i], after, &best);
    if (s->bvh_root >= 0)
        bvh_search(s, r, (uint32_t)s->bvh_root, after, &best);
    if (scene_may(MAY_KDTREE) && s->kd_count > 0)
        kd_search(s, r, after, &best);
    return best;
}

/* Nearest hit behind `after` and before distance t_max. */
HD ray_hit bvh_nearest(const flat_scene *s, const bvh_ray *r,
                       const ray_hit *after, real t_max)
{
    HD_COPY(bvh_ray, r);
    HD_COPY(ray_hit, after);
    return bvh_seek(s, HD_COPIED(r), HD_COPIED(after), t_max);
}

#endif
