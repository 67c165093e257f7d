#include "core/cuda/device.cuh"

/* Coalesced access begins at multiples of this. */
static const size_t alignment = 256;

bool device_check(cudaError_t code, const char *stage, struct brume_error *err)
{
    if (code == cudaSuccess)
        return true;
    return brume_fail(
        err,
        code == cudaErrorMemoryAllocation ? BRUME_ERR_MEMORY : BRUME_ERR_DEVICE,
        "the GPU failed in %s: %s", stage, cudaGetErrorString(code));
}

size_t device_round(size_t bytes)
{
    return (bytes + alignment - 1) / alignment * alignment;
}

bool device_arena_new(struct device_arena *arena, size_t size,
                      struct brume_error *err)
{
    void *base = nullptr;
    arena->used = 0;
    arena->size = size;
    bool good = device_check(cudaMalloc(&base, size > 0 ? size : alignment),
                             "allocating the frame", err);
    arena->base = static_cast<char *>(base);
    return good;
}

void *device_take(struct device_arena *arena, size_t bytes)
{
    void *out = arena->base + arena->used;
    arena->used += device_round(bytes);
    return out;
}

void device_arena_free(struct device_arena *arena)
{
    if (arena->base)
        cudaFree(arena->base);
    arena->base = nullptr;
}
