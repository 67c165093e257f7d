/* Bounds of a tree's items. */
#include "core/cuda/tree.cuh"

namespace
{

const int block_size = 256, warp_size = 32;

__device__ __forceinline__ bvh_box box_of(const tree_items *items, uint32_t i,
                                          uint32_t *name)
{
    bvh_box box;
    if (i < items->shapes) {
        const bvh_item *shape = &items->shape[i];
        for (int k = 0; k < 3; k++) {
            box.lo[k] = shape->lo[k];
            box.hi[k] = shape->hi[k];
        }
        *name = shape->name;
    } else {
        i -= items->shapes;
        lbvh_triangle_box(items->triangle[i].p, box.lo, box.hi);
        *name = items->name + i;
    }
    lbvh_widen(box.lo, box.hi);
    return box;
}

/* The least and the largest number of a warp's threads, all of them here. */
__device__ __forceinline__ void add_to(uint32_t *lo, uint32_t *hi, float least,
                                       float most)
{
    uint32_t a = tree_ordered(least), b = tree_ordered(most);
    for (int i = warp_size / 2; i > 0; i /= 2) {
        a = min(a, __shfl_xor_sync(~0u, a, i));
        b = max(b, __shfl_xor_sync(~0u, b, i));
    }
    if (threadIdx.x % warp_size == 0) {
        atomicMin(lo, a);
        atomicMax(hi, b);
    }
}

__global__ void __launch_bounds__(block_size)
    find_bounds(tree_items items, tree_bounds to, tree_extent *extent,
                bool centres)
{
    __shared__ tree_extent block;
    uint32_t i = blockIdx.x * block_size + threadIdx.x;
    if (threadIdx.x < 3) {
        block.lo[threadIdx.x] = ~0u;
        block.hi[threadIdx.x] = 0u;
    }
    __syncthreads();
    float lo[3] = {INFINITY, INFINITY, INFINITY};
    float hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    if (i < items.shapes + items.triangles) {
        uint32_t name;
        bvh_box box = box_of(&items, i, &name);
        to.box[i] = box;
        to.name[i] = name;
        for (int k = 0; k < 3; k++) {
            float centre = 0.5f * (box.lo[k] + box.hi[k]);
            lo[k] = fminf(lo[k], centres ? centre : box.lo[k]);
            hi[k] = fmaxf(hi[k], centres ? centre : box.hi[k]);
        }
    }
    for (int k = 0; k < 3; k++)
        add_to(&block.lo[k], &block.hi[k], lo[k], hi[k]);
    __syncthreads();
    if (threadIdx.x < 3) {
        atomicMin(&extent->lo[threadIdx.x], block.lo[threadIdx.x]);
        atomicMax(&extent->hi[threadIdx.x], block.hi[threadIdx.x]);
    }
}

__global__ void clear_extent(tree_extent *extent)
{
    extent->lo[threadIdx.x] = ~0u;
    extent->hi[threadIdx.x] = 0u;
}

}

cudaError_t tree_load_bounds()
{
    return tree_load(find_bounds, clear_extent);
}

void tree_clear_extent(tree_extent *extent)
{
    clear_extent<<<1, 3>>>(extent);
}

void tree_find_bounds(const tree_items *items, const tree_bounds *to,
                      tree_extent *extent, bool centres)
{
    uint32_t count = tree_count(items);
    find_bounds<<<(count + block_size - 1) / block_size, block_size>>>(
        *items, *to, extent, centres);
}
