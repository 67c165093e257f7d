/* tile.cuh - pixels of a part of the film by tiles, a warp each. */
#ifndef CORE_CUDA_TILE_CUH
#define CORE_CUDA_TILE_CUH
#include "core/cuda/sample.cuh"

namespace
{

const int block_width = 8, block_height = 4;
const int block_size = block_width * block_height;

/* The pixel of a thread, where `beside` of them, a power of two and no more
 * than a block is wide, have one together; false: it has none. */
__device__ __forceinline__ bool find_pixel(const sample_job *job, int beside,
                                           int *x, int *y, size_t *at)
{
    int tiles = static_cast<int>(blockDim.x) / block_size;
    int i = static_cast<int>(threadIdx.x);
    *x = job->x0 + static_cast<int>(blockIdx.x) * (block_width / beside) +
         i % block_width / beside;
    *y = job->y0 + static_cast<int>(blockIdx.y) * tiles * block_height +
         i / block_width;
    *at = static_cast<size_t>(*y - job->y0) *
              static_cast<size_t>(job->x1 - job->x0) +
          static_cast<size_t>(*x - job->x0);
    return *x < job->x1 && *y < job->y1;
}

/* As many parts of that size as there must be, but one at least. */
unsigned parts_of(int whole, int size)
{
    return whole > size ? static_cast<unsigned>((whole + size - 1) / size) : 1u;
}

/* Blocks of so many tiles, whose pixels have `beside` threads each. */
dim3 find_blocks(const sample_job *job, int beside, int tiles, unsigned deep)
{
    return dim3(parts_of(job->x1 - job->x0, block_width / beside),
                parts_of(job->y1 - job->y0, block_height * tiles), deep);
}

}

#endif
