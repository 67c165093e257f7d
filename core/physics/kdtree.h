/* kdtree.h - the kd-tree of Cha, Yi, Ihm 2010: a ray goes through its leaves
 * from front to back with a short stack (Horn, Sugerman, Houston, Hanrahan
 * 2007), a ring that forgets its oldest entry; when it runs out, the search
 * restarts at the root behind the last leaf. Its hits are those of bvh.h. */
#ifndef CORE_PHYSICS_KDTREE_H
#define CORE_PHYSICS_KDTREE_H
#include "core/physics/item.h"

enum { KD_MAX_STACK = 32 };

typedef struct {
    uint32_t node[KD_MAX_STACK];
    real leave[KD_MAX_STACK];   /* where the ray leaves the node           */
    int32_t top, count;         /* place of the next entry; entries        */
} kd_ring;

HD void kd_push(kd_ring *ring, int32_t size, uint32_t node, real leave)
{
    ring->node[ring->top] = node;
    ring->leave[ring->top] = leave;
    ring->top = ring->top + 1 < size ? ring->top + 1 : 0;
    ring->count += ring->count < size;
}

HD uint32_t kd_pop(kd_ring *ring, int32_t size, real *leave)
{
    ring->top = ring->top > 0 ? ring->top - 1 : size - 1;
    ring->count--;
    *leave = ring->leave[ring->top];
    return ring->node[ring->top];
}

/* Down to the leaf where the ray is at `enter`; *leave becomes the distance
 * of its far side. A plane at `enter` itself counts as passed: so a restart
 * ends in the next leaf. Items that touch a plane are on both its sides, so a
 * ray in the plane (t is no number) needs one of them. */
HD uint32_t kd_descend(const flat_scene *s, const bvh_ray *r, uint32_t node,
                       real enter, real *leave, kd_ring *ring)
{
    while (s->kd[node].kind < KD_LEAF) {
        const kd_node *n = &s->kd[node];
        int axis = (int)n->kind;
        real o = real3_get(r->o, axis);
        real t = (n->split - o) * real3_get(r->inverse, axis);
        bool low = o < n->split ||
                   (o == n->split && real3_get(r->d, axis) <= 0);
        uint32_t near = n->first + (low ? 0u : 1u);
        uint32_t far = n->first + (low ? 1u : 0u);
        if (!(t <= *leave) || t <= 0) {
            node = near;
        } else if (t <= enter) {
            node = far;
        } else {
            kd_push(ring, s->kd_stack, far, *leave);
            *leave = t;
            node = near;
        }
    }
    return node;
}

/* The nearer of `best` and what the tree holds behind `after`. A root may be
 * computed to lie a little before the leaf that it is in: that is looked into
 * too, so that the order of hits does not depend on the tree. */
HD void kd_search(const flat_scene *s, const bvh_ray *r, const ray_hit *after,
                  ray_hit *best)
{
    real enter, end;
    bvh_slabs(&s->kd_box, r, &enter, &end);
    if (bvh_enter(&s->kd_box, r, after->t, best->t) == INFINITY)
        return;
    enter = real_max(enter, after->t - ray_slack(after->t));
    uint32_t node = 0;
    kd_ring ring;
    ring.top = ring.count = 0;
    real leave = end;
    for (;;) {
        node = kd_descend(s, r, node, enter, &leave, &ring);
        const kd_node *n = &s->kd[node];
        item_hit(s, r, s->kd_items + n->first, n->kind - KD_LEAF, after, best);
        if (leave >= end || best->t + ray_slack(best->t) < leave)
            return;
        enter = leave;
        if (ring.count > 0) {
            node = kd_pop(&ring, s->kd_stack, &leave);
        } else {
            node = 0;
            leave = end;
        }
    }
}

#endif
