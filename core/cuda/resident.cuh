/* resident.cuh - large arrays of a film's scenes that stay on a device from
 * frame to frame: one that has the bytes of one that is there is not uploaded
 * again, nor the pieces of one that others have. */
#ifndef CORE_CUDA_RESIDENT_CUH
#define CORE_CUDA_RESIDENT_CUH
#include "core/cuda/device.cuh"
extern "C" {
#include "core/backend.h"
}

struct resident_set;

/* That of a film's worker, made if need be; NULL: there is none. */
resident_set *resident_of(brume_still *still);

/* Whether an array of so many bytes is worth it. */
bool resident_is_worth(const resident_set *set, size_t bytes);

/* A frame takes its arrays; at the end those go that neither it nor the one
 * before took. What was taken stays until the next frame begins. */
void resident_begin(resident_set *set);
/* NULL with err set. */
const void *resident_take(resident_set *set, const void *host, size_t bytes,
                          brume_error *err);
void resident_end(resident_set *set);

/* Bytes uploaded since the last call. */
uint64_t resident_uploaded(resident_set *set);
#endif
