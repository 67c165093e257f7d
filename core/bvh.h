/* bvh.h - builds the tree of physics/bvh.h on the host: a binary one by the
 * binned surface area heuristic (Wald 2007), then nodes of four children out of
 * it (physics/wide.h). */
#ifndef CORE_BVH_H
#define CORE_BVH_H
#include "core/flat.h"
#include "core/physics/wide.h"

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

/* Adds a tree to flat->bvh and flat->bvh_items, whose root is the next node,
 * children behind their parents; reorders `items` and widens their bounds. A
 * search of it keeps less than BVH_STACK places. The tree is the same for the
 * same items in the same order. */
bool bvh_build(struct flat *flat, struct bvh_item *items, size_t count,
               struct brume_error *err);

/* The same where a search keeps `room` places at most, or as many as the binary
 * tree has levels, which are less than BVH_STACK. */
bool bvh_build_within(struct flat *flat, struct bvh_item *items, size_t count,
                      int room, struct brume_error *err);

/* The same where items whose names are `from` or more stand for trees, and are
 * each alone in its leaf; a search keeps `room` places at most, 32 and more. */
bool bvh_build_over(struct flat *flat, struct bvh_item *items, size_t count,
                    uint64_t from, int room, struct brume_error *err);

/* A binary tree. Part 0 is the root, children lie side by side behind their
 * parents; a leaf's child[0] is the first of its items. */
struct bvh_binary {
    wide_part *part;
    bvh_box *box;
    size_t count;
};

/* Adds the tree made of it to flat->bvh, its items behind bvh_items. A search
 * keeps `room` places at most, or as many as the binary tree has levels. */
bool bvh_collapse(struct flat *flat, struct bvh_binary *binary, int room,
                  struct brume_error *err);

/* Places that a search from a node keeps, at most. */
int bvh_room(const struct flat *flat, uint32_t root);
#endif
