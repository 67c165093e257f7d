/* tree.cuh - trees that are built on the device, over shapes and triangles that
 * lie there. */
#ifndef CORE_CUDA_TREE_CUH
#define CORE_CUDA_TREE_CUH
#include "core/cuda/device.cuh"
extern "C" {
#include "core/kdtree.h"
}
#include "core/physics/lbvh.h"

/* What a tree is over: the items come first, then all triangles, whose names
 * are numbers behind `name`. */
struct tree_items {
    const bvh_item *shape;
    const flat_triangle *triangle;
    uint32_t shapes, triangles, name;
};

inline uint32_t tree_count(const tree_items *items)
{
    return items->shapes + items->triangles;
}

/* Bounds of items with what a hit may lie outside of them, on the device. */
struct tree_bounds {
    lbvh_box *box;
    uint32_t *name;
};

/* The box of all centres, its numbers in the order of unsigned ones. */
struct tree_extent {
    uint32_t lo[3], hi[3];
};

/* tree_items.cu: finds the bounds; `extent` is of what is in it already, too,
 * centres where `centres`, else boxes. */
void tree_find_bounds(const tree_items *items, const tree_bounds *to,
                      tree_extent *extent, bool centres);
void tree_clear_extent(tree_extent *extent);

__device__ __forceinline__ uint32_t tree_ordered(float x)
{
    uint32_t bits = __float_as_uint(x);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

__host__ __device__ __forceinline__ float tree_from_ordered(uint32_t ordered)
{
    union {
        uint32_t bits;
        float x;
    } of;
    of.bits = ordered & 0x80000000u ? ordered & 0x7fffffffu : ~ordered;
    return of.x;
}

/* tree_sort.cu: of pairs, the one from `code` and `order` to the second halves
 * of these; of sums of all before. `scratch` of so many bytes. */
size_t tree_sort_bytes(uint32_t count);
cudaError_t tree_sort(uint64_t *code[2], uint32_t *order[2], uint32_t count,
                      void *scratch, size_t bytes);
cudaError_t tree_sum(const uint64_t *from, uint64_t *to, uint32_t count,
                     void *scratch, size_t bytes);

/* Where a BVH goes: room for 2 count - 1 nodes, of which node[0] is the root,
 * and for count names; and their numbers in the scene's arrays. */
struct tree_bvh {
    bvh_node *node;
    uint32_t *item;
    uint32_t root, first;
};

/* What became of it, on the host. */
struct tree_shape {
    uint32_t depth, nodes;
    bool even;              /* of the wrong shape at first: halved instead */
};

/* tree_bvh.cu: builds it, no deeper than `depth`, 40 and more. */
size_t tree_bvh_bytes(uint32_t count);
bool tree_build_bvh(const tree_items *items, const tree_bvh *to, int depth,
                    device_arena *scratch, tree_shape *shape,
                    brume_error *err);

/* A kd-tree, on the device until it is freed. */
struct tree_kd {
    device_arena arena;
    kd_node *node;
    uint32_t *item;
    uint64_t nodes, items;
    bvh_node box;
};

/* tree_kd.cu: builds the tree that kd_build builds, in other places of the
 * arrays; with memory of its own. */
bool tree_build_kd(const tree_items *items, tree_kd *to, brume_error *err);
#endif
