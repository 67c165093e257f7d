/* count.cuh - sums of whole numbers over the threads of a warp, and numbers
 * that its threads take of a count. */
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

/* Numbers in a count for those threads of a warp that ask; all are here. */
__device__ __forceinline__ unsigned take_numbers(unsigned *count, bool asks)
{
    unsigned all = __ballot_sync(~0u, asks), first = 0;
    int lane = threadIdx.x % warp_size;
    if (lane == 0 && all != 0u)
        first = atomicAdd(count, __popc(all));
    return __shfl_sync(~0u, first, 0) +
           __popc(all & ((1u << lane) - 1u));
}
#endif
