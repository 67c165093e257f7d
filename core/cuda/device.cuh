/* device.cuh - what all stages on the GPU share: errors as ours, and one
 * allocation for all that a frame reads. */
#ifndef CORE_CUDA_DEVICE_CUH
#define CORE_CUDA_DEVICE_CUH
#include <cuda_runtime.h>
#include "lib/error.h"

/* Records a CUDA error with the stage that met it; true where there is none.
 * Out of memory is BRUME_ERR_MEMORY, all else BRUME_ERR_DEVICE. */
bool device_check(cudaError_t code, const char *stage,
                  struct brume_error *err);

/* Hands out parts of one device allocation. */
struct device_arena {
    char *base;
    size_t size, used;
};

size_t device_round(size_t bytes);
bool device_arena_new(struct device_arena *arena, size_t size,
                      struct brume_error *err);
/* The next part; the arena was made large enough for all of them. */
void *device_take(struct device_arena *arena, size_t bytes);
void device_arena_free(struct device_arena *arena);
#endif
