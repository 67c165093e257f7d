/* bvh.h - builds the binary tree of physics/bvh.h on the host: binned surface
 * area heuristic (Wald 2007). */
#ifndef CORE_BVH_H
#define CORE_BVH_H
#include "core/flat.h"

struct bvh_item {
    float lo[3], hi[3];     /* bounds in unit space                        */
    uint32_t name;          /* what bvh_items stores                       */
};

/* Widens bounds by what a ray's hit may lie outside of its item: without it a
 * tree could miss what a loop over all items would find. */
void bvh_widen(struct bvh_item *item);

/* The bounds of a triangle of flat; its name is not set. */
void bvh_triangle(const struct flat *flat, uint64_t triangle,
                  struct bvh_item *out);

/* Adds a tree to flat->bvh and flat->bvh_items, whose root is the next node;
 * reorders `items` and
 * widens their bounds. The tree is at most BVH_STACK deep and the same for the
 * same items in the same order. */
bool bvh_build(struct flat *flat, struct bvh_item *items, size_t count,
               struct brume_error *err);

/* The same where items whose names are `from` or more stand for trees, and are
 * each alone in its leaf; as deep as `depth` at most, 32 and more. */
bool bvh_build_over(struct flat *flat, struct bvh_item *items, size_t count,
                    uint64_t from, int depth, struct brume_error *err);

/* Levels below a node. */
int bvh_depth(const struct flat *flat, uint32_t root);
#endif
