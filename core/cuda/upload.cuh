/* upload.cuh - copies to the device through memory that it reads by itself:
 * what is put waits until all of a frame is known, then threads fill parts of
 * that memory while the device reads others. A plain copy waits for a single
 * thread of the driver's. Pictures come back the same way. */
#ifndef CORE_CUDA_UPLOAD_CUH
#define CORE_CUDA_UPLOAD_CUH
#include <atomic>
#include "core/cuda/device.cuh"

/* Parts that are filled or read at once. */
enum { UPLOAD_PARTS = 4 };

/* Bytes that wait, for a place in the allocation `whole`; `from` may be the
 * device's. */
struct upload_item {
    const void *whole;
    char *to;
    const char *from;
    size_t bytes;
};

struct upload_list {
    upload_item *item;
    size_t count, room;
};

struct uploader {
    int device, threads;
    char *memory;               /* of all parts                            */
    cudaEvent_t gone[UPLOAD_PARTS];     /* a part has been read            */
    upload_list put, moved;     /* from the host, and on the device        */
    size_t set_aside;           /* of the memory, anew                     */
    std::atomic<char *> *spare; /* where it goes afterwards, or NULL       */
};

/* Memory that a device reads takes long to get: some may wait in *spare. So
 * many threads, as parallel_for, but not more than help. */
bool upload_new(uploader *u, int threads, std::atomic<char *> *spare,
                brume_error *err);
void upload_free(uploader *u);
/* Bytes of the host that stay what they are until the flush, to a place in the
 * allocation that begins at `whole`. */
bool upload_put(uploader *u, const void *whole, void *to, const void *from,
                size_t bytes, brume_error *err);
/* Bytes of the device, among them what was put or moved before. */
bool upload_move(uploader *u, const void *whole, void *to, const void *from,
                 size_t bytes, brume_error *err);
/* What waits is on its way: before what is launched next. */
bool upload_flush(uploader *u, brume_error *err);

/* Brings bytes from the device, in their order: each part of them, of whole
 * items, is given to `take`. Waits for all. */
typedef void upload_taker(void *user, size_t from, const char *bytes,
                          size_t count);
bool upload_bring(uploader *u, const void *from, size_t bytes, size_t item,
                  upload_taker *take, void *user, brume_error *err);
#endif
