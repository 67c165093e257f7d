/* still.h - what stood still from frame to frame of a film, by the bounds of
 * its items, and the kd-tree over it. */
#ifndef CORE_STILL_H
#define CORE_STILL_H
#include "core/brume.h"
#include "core/bvh.h"
#include "core/mesh_tree.h"

struct brume_still {
    uint64_t *before;       /* of the last frame's items, sorted           */
    size_t befores, before_room;
    struct bvh_item *item;  /* what the tree below is over                 */
    size_t items, item_room;
    kd_node *node;
    uint32_t *reference;    /* numbers of items                            */
    size_t nodes, references;
    bvh_box box;
    int builds;             /* of the tree, so far                         */
    /* Of BRUME_TREE_BVH: all of the last frame's items, and their tree. */
    struct bvh_item *all;
    size_t alls;
    bvh_node *bvh;
    uint32_t *bvh_item;
    size_t bvhs, bvh_items;
    int bvh_builds, room;
    struct mesh_tree *tree; /* of large meshes                             */
    int tree_builds, tree_uses;
    void *pixels;           /* a film's memory, while no film has it       */
    size_t pixels_bytes;
    void *device;           /* a backend's own                             */
    void (*release)(void *device);
};

/* Builds the BVH of what was not there in the frame before, and takes over or
 * builds the kd-tree of what was; reorders `items`. `still` may be NULL: all
 * is new. */
bool still_build(struct brume_still *still, struct flat *flat,
                 struct bvh_item *items, size_t count, int stack,
                 struct brume_error *err);

/* Builds the BVH of all items as bvh_build_over does, or takes over the last
 * frame's where all are the same; the first tree of `flat`. `still` may be
 * NULL. */
bool still_bvh(struct brume_still *still, struct flat *flat,
               struct bvh_item *items, size_t count, uint64_t from, int room,
               struct brume_error *err);
#endif
