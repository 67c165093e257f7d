#include "core/cuda/resident.cuh"
#include <new>
extern "C" {
#include "lib/hash.h"
}

namespace
{

const size_t worth = 1u << 20;

struct resident {
    resident *next;
    size_t bytes;
    uint64_t hash;
    void *device;
    int age; /* frames since it was taken last             */
};

}

struct resident_set {
    resident *first;
    uint64_t uploaded;
};

namespace
{

/* Those not taken for more than `age` frames. */
void drop(resident_set *set, int age)
{
    resident **at = &set->first;
    while (*at) {
        resident *r = *at;
        if (r->age <= age) {
            at = &r->next;
            continue;
        }
        *at = r->next;
        cudaFree(r->device);
        delete r;
    }
}

void release(void *set)
{
    drop(static_cast<resident_set *>(set), -1);
    delete static_cast<resident_set *>(set);
}

/* Where there is no room, what this frame does not use goes. */
bool allocate(resident_set *set, resident *r, brume_error *err)
{
    if (cudaMalloc(&r->device, r->bytes) == cudaSuccess)
        return true;
    cudaGetLastError();
    drop(set, 0);
    return device_check(cudaMalloc(&r->device, r->bytes),
                        "allocating the frame", err);
}

resident *add(resident_set *set, size_t bytes, uint64_t hash, const void *host,
              brume_error *err)
{
    resident *r = new (std::nothrow) resident();
    if (!r) {
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
        return nullptr;
    }
    r->bytes = bytes;
    r->hash = hash;
    if (!allocate(set, r, err)) {
        delete r;
        return nullptr;
    }
    if (!device_check(
            cudaMemcpy(r->device, host, bytes, cudaMemcpyHostToDevice),
            "uploading the scene", err)) {
        cudaFree(r->device);
        delete r;
        return nullptr;
    }
    set->uploaded += bytes;
    r->next = set->first;
    set->first = r;
    return r;
}

}

resident_set *resident_of(brume_still *still)
{
    void **slot = still ? still_device(still, release) : nullptr;
    if (slot && !*slot)
        *slot = new (std::nothrow) resident_set();
    return slot ? static_cast<resident_set *>(*slot) : nullptr;
}

bool resident_is_worth(const resident_set *set, size_t bytes)
{
    return set && bytes >= worth;
}

void resident_begin(resident_set *set)
{
    for (resident *r = set ? set->first : nullptr; r; r = r->next)
        r->age++;
}

const void *resident_take(resident_set *set, const void *host, size_t bytes,
                          brume_error *err)
{
    uint64_t hash = hash_bytes(HASH_START, host, bytes);
    resident *r = set->first;
    while (r && (r->bytes != bytes || r->hash != hash))
        r = r->next;
    if (!r)
        r = add(set, bytes, hash, host, err);
    if (!r)
        return nullptr;
    r->age = 0;
    return r->device;
}

void resident_end(resident_set *set)
{
    if (set)
        drop(set, 1);
}

uint64_t resident_uploaded(resident_set *set)
{
    uint64_t bytes = set ? set->uploaded : 0;
    if (set)
        set->uploaded = 0;
    return bytes;
}
