/* kdtree.h - the kd-tree of Cha, Yi, Ihm 2010: a ray goes through its leaves
 * from front to back with a short stack (Horn, Sugerman, Houston, Hanrahan
 * 2007), a ring that forgets its oldest entry; when it runs out, the search
 * restarts at the root behind the last leaf. Its hits are those of bvh.h. */
#ifndef CORE_PHYSICS_KDTREE_H
#define CORE_PHYSICS_KDTREE_H
#include "core/physics/item.h"

enum { KD_MAX_STACK = 32 };

/* On a GPU, rings of up to so many entries lie in the memory that a block of at
 * most KD_THREADS shares; longer ones, and all of a host, in a thread's own. */
#ifndef KD_SHARED
#define KD_SHARED 0
#endif

typedef struct {
    uint32_t node;
    real leave;             /* where the ray leaves the node               */
} kd_entry;

typedef struct {
    kd_entry own[KD_MAX_STACK];
    int32_t top, count;     /* place of the next entry; entries            */
} kd_ring;

HD kd_entry *kd_place(kd_ring *ring, int32_t size, int32_t i)
{
#if defined(__CUDACC__) && KD_SHARED > 0
    __shared__ kd_entry shared[KD_SHARED][KD_THREADS];
    if (size <= KD_SHARED)
        return &shared[i][threadIdx.y * blockDim.x + threadIdx.x];
#endif
    (void)size;
    return &ring->own[i];
}

HD void kd_push(kd_ring *ring, int32_t size, uint32_t node, real leave)
{
    kd_entry *e = kd_place(ring, size, ring->top);
    e->node = node;
    e->leave = leave;
    ring->top = ring->top + 1 < size ? ring->top + 1 : 0;
    ring->count += ring->count < size;
}

HD uint32_t kd_pop(kd_ring *ring, int32_t size, real *leave)
{
    ring->top = ring->top > 0 ? ring->top - 1 : size - 1;
    ring->count--;
    const kd_entry *e = kd_place(ring, size, ring->top);
    *leave = e->leave;
    return e->node;
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
