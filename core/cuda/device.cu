#include "core/cuda/device.cuh"

/* Coalesced access begins at multiples of this. */
static const size_t alignment = 256;

bool device_check(cudaError_t code, const char *stage, struct brume_error *err)
{
    if (code == cudaSuccess)
        return true;
    cudaGetLastError(); /* told once: what is tried next may do well */
    return brume_fail(
        err,
        code == cudaErrorMemoryAllocation ? BRUME_ERR_MEMORY : BRUME_ERR_DEVICE,
        "the GPU failed in %s: %s", stage, cudaGetErrorString(code));
}

bool device_wait(const char *stage, struct brume_error *err)
{
    return device_check(cudaGetLastError(), stage, err) &&
           device_check(cudaDeviceSynchronize(), stage, err);
}

bool device_number(cudaDeviceAttr what, int *value, struct brume_error *err)
{
    int device = 0;
    return device_check(cudaGetDevice(&device), "opening", err) &&
           device_check(cudaDeviceGetAttribute(value, what, device), "opening",
                        err);
}

bool device_clock_new(struct device_clock *clock, struct brume_error *err)
{
    for (int i = 0; i < DEVICE_MARKS; i++)
        if (!device_check(cudaEventCreate(&clock->event[i]), "opening", err))
            return false;
    return true;
}

void device_clock_free(struct device_clock *clock)
{
    for (int i = 0; i < DEVICE_MARKS; i++)
        if (clock->event[i])
            cudaEventDestroy(clock->event[i]);
}

void device_clock_mark(struct device_clock *clock, int i)
{
    cudaEventRecord(clock->event[i]);
}

bool device_clock_stop(struct device_clock *clock, int i, const char *stage,
                       struct brume_error *err)
{
    return device_check(cudaEventRecord(clock->event[i]), stage, err) &&
           device_wait(stage, err);
}

bool device_clock_add(struct device_clock *clock, int i, double *sum)
{
    float milliseconds = 0.0f;
    if (cudaEventElapsedTime(&milliseconds, clock->event[i],
                             clock->event[i + 1]) == cudaSuccess)
        *sum += static_cast<double>(milliseconds) * 1e-3;
    return true;
}

static bool device_pool(cudaMemPool_t *pool)
{
    int device = 0;
    return cudaGetDevice(&device) == cudaSuccess &&
           cudaDeviceGetDefaultMemPool(pool, device) == cudaSuccess;
}

static void keep_all(cudaMemPool_t pool)
{
    uint64_t all = UINT64_MAX;
    cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &all);
}

void device_keep_memory()
{
    cudaMemPool_t pool;
    if (device_pool(&pool))
        keep_all(pool);
}

cudaError_t device_new(void **memory, size_t bytes)
{
    return cudaMallocAsync(memory, bytes, nullptr);
}

void device_free(void *memory)
{
    if (memory)
        cudaFreeAsync(memory, nullptr);
}

cudaMemPool_t device_pool_new()
{
    cudaMemPool_t pool = nullptr;
    cudaMemPoolProps props = {};
    props.allocType = cudaMemAllocationTypePinned;
    props.location.type = cudaMemLocationTypeDevice;
    if (cudaGetDevice(&props.location.id) != cudaSuccess ||
        cudaMemPoolCreate(&pool, &props) != cudaSuccess) {
        cudaGetLastError();
        return nullptr;
    }
    keep_all(pool);
    return pool;
}

void device_pool_free(cudaMemPool_t pool)
{
    if (pool)
        cudaMemPoolDestroy(pool);
}

cudaError_t device_new_from(cudaMemPool_t pool, void **memory, size_t bytes)
{
    return pool ? cudaMallocFromPoolAsync(memory, bytes, pool, nullptr)
                : device_new(memory, bytes);
}

static uint64_t reserved_of(cudaMemPool_t pool)
{
    uint64_t bytes = 0;
    cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent, &bytes);
    return bytes;
}

uint64_t device_reserved(cudaMemPool_t pool)
{
    cudaMemPool_t frames;
    return (device_pool(&frames) ? reserved_of(frames) : 0) +
           (pool ? reserved_of(pool) : 0);
}

void device_trim(cudaMemPool_t pool)
{
    cudaMemPool_t frames;
    cudaDeviceSynchronize();
    if (device_pool(&frames))
        cudaMemPoolTrimTo(frames, 0);
    if (pool)
        cudaMemPoolTrimTo(pool, 0);
    cudaGetLastError();
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
    bool good = device_check(device_new(&base, size > 0 ? size : alignment),
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
    device_free(arena->base);
    arena->base = nullptr;
}
