#include "core/cuda/upload.cuh"
#include <cstring>
extern "C" {
#include "lib/thread.h"
}

namespace
{

const size_t part_size = 512u << 10;
const size_t large = 2 * part_size;

/* A gap that is no longer is sent along. */
const size_t most_gap = 256;

char *part_of(const uploader *u, int i)
{
    return u->memory + static_cast<size_t>(i) * part_size;
}

cudaError_t send(uploader *u, int part, char *to, size_t bytes)
{
    cudaError_t code = cudaMemcpyAsync(to, part_of(u, part), bytes,
                                       cudaMemcpyHostToDevice);
    return code != cudaSuccess ? code : cudaEventRecord(u->gone[part]);
}

struct large_array {
    uploader *to;
    char *device;
    const char *host;
    size_t bytes;
    int turn[UPLOAD_THREADS]; /* which of a thread's parts is next       */
    std::atomic<int> code;    /* the first error                         */
};

void put_part(void *context, size_t index, int thread)
{
    large_array *a = static_cast<large_array *>(context);
    size_t at = index * part_size, left = a->bytes - at;
    size_t bytes = left < part_size ? left : part_size;
    int part = 2 * thread + a->turn[thread];
    cudaError_t code = cudaSetDevice(a->to->device);
    if (code == cudaSuccess)
        code = cudaEventSynchronize(a->to->gone[part]);
    if (code == cudaSuccess) {
        memcpy(part_of(a->to, part), a->host + at, bytes);
        code = send(a->to, part, a->device + at, bytes);
    }
    a->turn[thread] = !a->turn[thread];
    int none = cudaSuccess;
    if (code != cudaSuccess)
        a->code.compare_exchange_strong(none, code);
}

bool put_large(uploader *u, char *to, const char *from, size_t bytes,
               brume_error *err)
{
    large_array a = {u, to, from, bytes, {}, {cudaSuccess}};
    parallel_for(UPLOAD_THREADS, (bytes + part_size - 1) / part_size, put_part,
                 &a, nullptr);
    return device_check(static_cast<cudaError_t>(a.code.load()),
                        "uploading the scene", err);
}

/* Whether bytes for that place can follow what waits. */
bool follows(const uploader *u, const char *to)
{
    const char *end = u->to + u->used;
    return to >= end && to - end < static_cast<ptrdiff_t>(most_gap) &&
           to - u->to < static_cast<ptrdiff_t>(part_size);
}

}

bool upload_new(uploader *u, std::atomic<char *> *spare, brume_error *err)
{
    *u = {};
    u->spare = spare;
    void *memory = spare ? spare->exchange(nullptr) : nullptr;
    bool kept = memory != nullptr;
    if (!device_check(cudaGetDevice(&u->device), "opening", err) ||
        (!memory &&
         !device_check(cudaHostAlloc(&memory, UPLOAD_PARTS * part_size,
                                     cudaHostAllocPortable),
                       "opening", err)))
        return false;
    u->memory = static_cast<char *>(memory);
    u->set_aside = kept ? 0 : UPLOAD_PARTS * part_size;
    for (int i = 0; i < UPLOAD_PARTS; i++)
        if (!device_check(
                cudaEventCreateWithFlags(&u->gone[i], cudaEventDisableTiming),
                "opening", err))
            return false;
    return true;
}

void upload_free(uploader *u)
{
    for (int i = 0; i < UPLOAD_PARTS; i++)
        if (u->gone[i]) {
            cudaEventSynchronize(u->gone[i]);
            cudaEventDestroy(u->gone[i]);
        }
    char *old = u->memory;
    if (old && u->spare)
        old = u->spare->exchange(old);
    if (old)
        cudaFreeHost(old);
    *u = {};
}

bool upload_flush(uploader *u, brume_error *err)
{
    if (u->used == 0)
        return true;
    cudaError_t code = send(u, u->which, u->to, u->used);
    u->which = (u->which + 1) % UPLOAD_PARTS;
    u->used = 0;
    return device_check(code, "uploading the scene", err);
}

bool upload_put(uploader *u, void *target, const void *source, size_t bytes,
                brume_error *err)
{
    char *to = static_cast<char *>(target);
    const char *from = static_cast<const char *>(source);
    if (bytes >= large)
        return upload_flush(u, err) && put_large(u, to, from, bytes, err);
    while (bytes > 0) {
        if (u->used > 0 && !follows(u, to) && !upload_flush(u, err))
            return false;
        if (u->used == 0 &&
            !device_check(cudaEventSynchronize(u->gone[u->which]),
                          "uploading the scene", err))
            return false;
        if (u->used == 0)
            u->to = to;
        size_t at = static_cast<size_t>(to - u->to), room = part_size - at;
        size_t n = bytes < room ? bytes : room;
        memcpy(part_of(u, u->which) + at, from, n);
        u->used = at + n;
        to += n;
        from += n;
        bytes -= n;
    }
    return true;
}
