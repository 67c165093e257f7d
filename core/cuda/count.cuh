/* count.cuh - sums of whole numbers over the threads of a warp. */
#ifndef CORE_CUDA_COUNT_CUH
#define CORE_CUDA_COUNT_CUH
#include "core/cuda/sample.cuh"

const int warp_size = 32;

/* Adds the numbers of a warp's threads, all of them here, to a sum. */
__device__ inline void count_warp(unsigned long long *sum, uint64_t value)
{
    for (int i = 16; i > 0; i /= 2)
        value += __shfl_xor_sync(~0u, value, i);
    if (threadIdx.x % warp_size == 0 && value != 0)
        atomicAdd(sum, static_cast<unsigned long long>(value));
}

__device__ inline void count_add(device_counters *sum, const track_counters *c)
{
#define X(name) count_warp(&sum->name, c->name);
    TRACK_COUNTERS(X)
#undef X
}
#endif
