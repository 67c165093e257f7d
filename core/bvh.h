/* bvh.h - builds the binary tree of physics/bvh.h on the host: binned surface
 * area heuristic (Wald 2007). */
#ifndef CORE_BVH_H
#define CORE_BVH_H
#include "core/flat.h"

struct bvh_item {
    float lo[3], hi[3];     /* bounds in unit space                        */
    uint32_t name;          /* what bvh_items stores                       */
};

/* Adds a tree to flat->bvh and flat->bvh_items, whose root is the next node;
 * reorders `items`. The tree is at most BVH_STACK deep and the same for the
 * same items in the same order. */
bool bvh_build(struct flat *flat, struct bvh_item *items, size_t count,
               struct brume_error *err);
#endif
