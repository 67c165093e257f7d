/* bvh.h - the nearest surface along a ray.
 *
 * A ray that passes through a boundary goes on from its hit in the order of
 * ray.h, origin and direction unchanged: every root is computed from the same
 * numbers again, so none is found twice and none of several at the same
 * distance is lost, without any epsilon. */
#ifndef CORE_PHYSICS_BVH_H
#define CORE_PHYSICS_BVH_H
#include "core/physics/kdtree.h"

/* Where a search is to go on: at a child of a node, BVH_WIDTH times the node
 * and the child's number. */
typedef struct {
    real t;                 /* where the ray gets into its box             */
    uint32_t child;
} bvh_place;

HD void bvh_order(bvh_place *a, bvh_place *b)
{
    if (b->t < a->t) {
        bvh_place c = *a;
        *a = *b;
        *b = c;
    }
}

/* Puts a node's children that the ray gets into at t, where this is finite, on
 * the stack, the farthest first, but the nearest into *at; false: there are
 * none. A GPU orders them in registers. */
HD bool bvh_push(bvh_place *stack, int *held, uint32_t node,
                 const real t[BVH_WIDTH], bvh_place *at)
{
#ifdef __CUDACC__
    bvh_place next[BVH_WIDTH];
    for (int i = 0; i < BVH_WIDTH; i++) {
        next[i].t = t[i];
        next[i].child = BVH_WIDTH * node + (uint32_t)i;
    }
    bvh_order(&next[0], &next[1]);
    bvh_order(&next[2], &next[3]);
    bvh_order(&next[0], &next[2]);
    bvh_order(&next[1], &next[3]);
    bvh_order(&next[1], &next[2]);
    for (int i = BVH_WIDTH - 1; i > 0; i--)
        if (next[i].t < INFINITY)
            stack[(*held)++] = next[i];
    *at = next[0];
    return at->t < INFINITY;
#else
    const int before = *held;
    at->t = INFINITY;
    at->child = 0;
    for (int i = 0; i < BVH_WIDTH; i++) {
        bvh_place in;
        in.t = t[i];
        in.child = BVH_WIDTH * node + (uint32_t)i;
        bvh_order(at, &in);
        if (!(in.t < INFINITY))
            continue;
        int k = (*held)++;
        for (; k > before && stack[k - 1].t < in.t; k--)
            stack[k] = stack[k - 1];
        stack[k] = in;
    }
    return at->t < INFINITY;
#endif
}

/* The nearer of `best` and what the tree below a node holds behind `after`. */
HD void bvh_search(const flat_scene *s, const bvh_ray *r, uint32_t node,
                   const ray_hit *after, ray_hit *best)
{
    bvh_place stack[BVH_STACK], at;
    uint32_t first = node, count = 0;
    int held = 0;
    for (;;) {
        bool have = false;
        if (count > 0) {
            item_hit(s, r, s->bvh_items + first, count, after, best);
        } else {
            real t[BVH_WIDTH];
            bvh_enter_all(&s->bvh[first], r, after->t, best->t, t);
            have = bvh_push(stack, &held, first, t, &at);
        }
        if (!have)
            do {
                if (held == 0)
                    return;
                at = stack[--held];
            } while (at.t > best->t + ray_slack(best->t));
        const bvh_node *n = &s->bvh[at.child / BVH_WIDTH];
        first = n->first[at.child % BVH_WIDTH];
        count = n->count[at.child % BVH_WIDTH];
    }
}

/* What it is given lies in memory: its own copies need not. */
HD_APART ray_hit bvh_seek(const flat_scene *s, const bvh_ray *r,
                          const ray_hit *after, real t_max)
{
    HD_COPY(bvh_ray, r);
    HD_COPY(ray_hit, after);
    ray_hit best = hit_none(t_max);
    best.key = 0;           /* t_max itself is excluded */
    for (uint64_t i = 0; i < s->unbounded_count; i++)
        item_hit_shape(s, HD_COPIED(r), s->unbounded[i], HD_COPIED(after),
                       &best);
    if (s->bvh_root >= 0)
        bvh_search(s, HD_COPIED(r), (uint32_t)s->bvh_root, HD_COPIED(after),
                   &best);
    if (scene_may(MAY_KDTREE) && s->kd_count > 0)
        kd_search(s, HD_COPIED(r), HD_COPIED(after), &best);
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
