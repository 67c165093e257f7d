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
    bvh_box *box;
    uint32_t *name;
};

/* The box of all centres, its numbers in the order of unsigned ones. */
struct tree_extent {
    uint32_t lo[3], hi[3];
};

/* Loads kernels' code, for which their first launches would wait. */
template <typename... kernels> cudaError_t tree_load(kernels *...kernel)
{
    cudaFuncAttributes some;
    cudaError_t code = cudaSuccess;
    ((code = code ? code : cudaFuncGetAttributes(&some, kernel)), ...);
    return code;
}

/* Load the code of what builds a tree; of the bounds by that of all others. */
cudaError_t tree_load_bounds();
cudaError_t tree_load_binary(uint32_t count);
cudaError_t tree_load_wide();
cudaError_t tree_load_kd(uint32_t count);

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

/* A binary tree on the device, as clusters of lbvh.h by their ids: items in the
 * order of their codes, then as many places for inner nodes, of which one is
 * never taken; and what the wide one is made of. All lies in the scratch that
 * it was built in. */
struct tree_binary {
    uint32_t count;
    tree_bounds bounds;
    uint32_t *order;        /* items by their codes                        */
    bvh_box *box;
    wide_part *part;
    uint32_t *above;        /* the id of the cluster that it is part of    */
    uint8_t *room;          /* per place, of a node of the wide tree: 1 and
                               the places that a search has there; or 0    */
    uint64_t *made;         /* 1 << 32 of such a node, and items of its
                               leaves; one more than places                */
    uint64_t *before;       /* the sums of these                           */
    uint32_t root, free;    /* its id; the place that is not taken         */
    uint32_t nodes;         /* of the wide tree                            */
    bool even;              /* it was too deep at first: halved instead    */
};

/* Where a BVH goes: node[0] is the root; and numbers of both in the scene's
 * arrays. */
struct tree_bvh {
    bvh_node *node;
    uint32_t *item;
    uint32_t root, first;
};

/* tree_bvh.cu: builds the binary tree and finds how many nodes the wide one
 * has, of which a search keeps `places`, 40 and more, at most. */
size_t tree_bvh_bytes(uint32_t count);
bool tree_build_binary(const tree_items *items, int places,
                       device_arena *scratch, tree_binary *to,
                       brume_error *err);

/* tree_wide.cu: finds the nodes, with scratch as of tree_sum; makes them. */
bool tree_find_wide(tree_binary *b, int places, void *scratch, size_t bytes,
                    brume_error *err);
bool tree_make_wide(const tree_binary *b, const tree_bvh *to, brume_error *err);

/* A kd-tree, on the device until it is freed. */
struct tree_kd {
    device_arena arena;
    kd_node *node;
    uint32_t *item;
    uint64_t nodes, items;
    bvh_box box;
};

/* tree_kd.cu: builds the tree that kd_build builds, in other places of the
 * arrays; with memory of its own. */
bool tree_build_kd(const tree_items *items, tree_kd *to, brume_error *err);
#endif
