/* resident.cuh - large arrays of a film's scenes that stay on a device from
 * frame to frame: one that has the bytes of one that is there is not uploaded
 * again, nor the pieces of one that others have. */
#ifndef CORE_CUDA_RESIDENT_CUH
#define CORE_CUDA_RESIDENT_CUH
#include "core/cuda/upload.cuh"
extern "C" {
#include "core/backend.h"
}

struct resident_set;

/* That of a film's worker, made if need be; NULL: there is none. */
resident_set *resident_of(brume_still *still);

/* The memory that it has; NULL of NULL. */
cudaMemPool_t resident_pool(const resident_set *set);

/* Where the memory that uploads go through waits for the next frame; NULL of
 * NULL. */
std::atomic<char *> *resident_spare(resident_set *set);

/* Whether an array of so many bytes is worth it. */
bool resident_is_worth(const resident_set *set, size_t bytes);

/* What a scene's large arrays hold, but for `but`, found by so many threads
 * before the device is at hand; NULL: nothing is known. */
struct resident_looked;
resident_looked *resident_look(const flat_scene *scene, const void *but,
                               int threads);
void resident_forget(void *looked);

/* A frame takes its arrays, of which some may be known; at the end those go
 * that neither it nor the last `before` ones took. What was taken stays until
 * the next frame begins. */
void resident_begin(resident_set *set, uploader *to, int threads,
                    const resident_looked *looked);
/* NULL with err set. */
const void *resident_take(resident_set *set, const void *host, size_t bytes,
                          brume_error *err);
void resident_end(resident_set *set, int before);
/* All go, between frames. */
void resident_empty(resident_set *set);

/* What there is to tell of memory that the device fills itself. */
struct resident_note {
    uint64_t count[2];
    bvh_box box;
};

/* The hash of an array that was taken; false: it is none. */
bool resident_hash(const resident_set *set, const void *device, uint64_t *hash);
/* Memory that was filled, by the hash of what it was made of; NULL: it is not
 * there. It is taken. */
void *resident_find(resident_set *set, uint64_t hash, resident_note *note);
/* Memory to be filled, which is there once that has been said; NULL with err
 * set. */
void *resident_room(resident_set *set, uint64_t hash, size_t bytes,
                    brume_error *err);
void resident_say(resident_set *set, uint64_t hash, const resident_note *note);

/* Counts a tree that was built, or was there; adds up those since the last
 * call. */
void resident_tree(resident_set *set, bool built);
void resident_trees(resident_set *set, uint64_t *built, uint64_t *kept);

/* Bytes uploaded since the last call. */
uint64_t resident_uploaded(resident_set *set);
#endif
