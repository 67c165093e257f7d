/* device.cuh - what all stages on the GPU share: errors as ours, and one
 * allocation for all that a frame reads. */
#ifndef CORE_CUDA_DEVICE_CUH
#define CORE_CUDA_DEVICE_CUH
#include <cstdint>
#include <cuda_runtime.h>
#include "lib/error.h"

/* Records a CUDA error with the stage that met it; true where there is none.
 * Out of memory is BRUME_ERR_MEMORY, all else BRUME_ERR_DEVICE. */
bool device_check(cudaError_t code, const char *stage,
                  struct brume_error *err);

/* Waits for all launches, and tells of one that had no memory for its code or
 * its threads' stacks, which a wait alone does not. */
bool device_wait(const char *stage, struct brume_error *err);

/* Memory of the device, in the order of its work. What is freed is kept for
 * the next that asks, so that frames after the first set none aside. */
void device_keep_memory();
cudaError_t device_new(void **memory, size_t bytes);
void device_free(void *memory);

/* Memory for what outlives a frame: between frames' own it would leave holes
 * that the next does not fit into. NULL: there is none, and it is theirs. */
cudaMemPool_t device_pool_new();
void device_pool_free(cudaMemPool_t pool);
cudaError_t device_new_from(cudaMemPool_t pool, void **memory, size_t bytes);

/* Bytes set aside of frames' memory and of that, or NULL; used or not. */
uint64_t device_reserved(cudaMemPool_t pool);
/* Gives back what is not used, once all work is done. */
void device_trim(cudaMemPool_t pool);

/* Hands out parts of one device allocation. */
struct device_arena {
    char *base;
    size_t size, used;
};

/* A number that the runtime tells of the device. */
bool device_number(cudaDeviceAttr what, int *value, struct brume_error *err);

/* Times on the device, by its own clock. */
enum { DEVICE_MARKS = 3 };

struct device_clock {
    cudaEvent_t event[DEVICE_MARKS];
};

bool device_clock_new(struct device_clock *clock, struct brume_error *err);
void device_clock_free(struct device_clock *clock);
/* Now is mark i. */
void device_clock_mark(struct device_clock *clock, int i);
/* The same, and waits for what came before, a stage. */
bool device_clock_stop(struct device_clock *clock, int i, const char *stage,
                       struct brume_error *err);
/* Adds the seconds from mark i to the next one; returns true. */
bool device_clock_add(struct device_clock *clock, int i, double *sum);

size_t device_round(size_t bytes);
bool device_arena_new(struct device_arena *arena, size_t size,
                      struct brume_error *err);
/* The next part; the arena was made large enough for all of them. */
void *device_take(struct device_arena *arena, size_t bytes);
void device_arena_free(struct device_arena *arena);
#endif
