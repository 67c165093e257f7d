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

/* Of a device whose number is too high for this: the one that frames have. */
static bool device_pool_kept(cudaMemPool_t *pool)
{
    enum { DEVICES = 64 };
    static cudaMemPool_t pools[DEVICES];
    int device = 0;
    if (cudaGetDevice(&device) != cudaSuccess)
        return false;
    if (device >= DEVICES)
        return device_pool(pool);
    if (!pools[device]) {
        cudaMemPoolProps props = {};
        props.allocType = cudaMemAllocationTypePinned;
        props.location.type = cudaMemLocationTypeDevice;
        props.location.id = device;
        if (cudaMemPoolCreate(&pools[device], &props) != cudaSuccess)
            return false;
    }
    *pool = pools[device];
    return true;
}

/* For each of the two. */
template <typename body> static void device_pools(const body &what)
{
    cudaMemPool_t pool;
    if (device_pool(&pool))
        what(pool);
    if (device_pool_kept(&pool))
        what(pool);
    cudaGetLastError();
}

void device_keep_memory()
{
    device_pools([](cudaMemPool_t pool) {
        uint64_t all = UINT64_MAX;
        cudaMemPoolSetAttribute(pool, cudaMemPoolAttrReleaseThreshold, &all);
    });
}

void device_trim()
{
    cudaDeviceSynchronize();
    device_pools([](cudaMemPool_t pool) { cudaMemPoolTrimTo(pool, 0); });
}

cudaError_t device_new(void **memory, size_t bytes)
{
    return cudaMallocAsync(memory, bytes, nullptr);
}

cudaError_t device_new_kept(void **memory, size_t bytes)
{
    cudaMemPool_t pool;
    return device_pool_kept(&pool)
               ? cudaMallocFromPoolAsync(memory, bytes, pool, nullptr)
               : cudaMallocAsync(memory, bytes, nullptr);
}

void device_free(void *memory)
{
    if (memory)
        cudaFreeAsync(memory, nullptr);
}

uint64_t device_reserved()
{
    uint64_t sum = 0;
    device_pools([&sum](cudaMemPool_t pool) {
        uint64_t bytes = 0;
        cudaMemPoolGetAttribute(pool, cudaMemPoolAttrReservedMemCurrent,
                                &bytes);
        sum += bytes;
    });
    return sum;
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
