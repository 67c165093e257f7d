/* upload.cuh - copies to the device through memory that it reads by itself:
 * while it reads one part, others are filled; those of a large array by several
 * threads. A plain copy waits for a single thread of the driver's. */
#ifndef CORE_CUDA_UPLOAD_CUH
#define CORE_CUDA_UPLOAD_CUH
#include <atomic>
#include "core/cuda/device.cuh"

/* Threads that fill parts, each two in turn. */
enum { UPLOAD_THREADS = 4, UPLOAD_PARTS = 2 * UPLOAD_THREADS };

struct uploader {
    int device;
    char *memory;               /* of all parts                            */
    cudaEvent_t gone[UPLOAD_PARTS];     /* a part has been read            */
    int which;                  /* that waits, or is next                  */
    char *to;                   /* where it goes                           */
    size_t used;                /* so many bytes of it                     */
    size_t set_aside;           /* of the memory, anew                     */
    std::atomic<char *> *spare; /* where it goes afterwards, or NULL       */
};

/* Memory that a device reads takes long to get: some may wait in *spare. */
bool upload_new(uploader *u, std::atomic<char *> *spare, brume_error *err);
void upload_free(uploader *u);
/* `from` may change afterwards. What is small waits for its neighbours. */
bool upload_put(uploader *u, void *to, const void *from, size_t bytes,
                brume_error *err);
/* What waits is on its way: before what is launched next. */
bool upload_flush(uploader *u, brume_error *err);
#endif
