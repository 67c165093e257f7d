/* photons.cuh - the stages of the integrator photon: what their kernels are
 * given, and which there are. Each photons_NAME.cu is the same kernels for
 * other scenes. */
#ifndef CORE_CUDA_PHOTONS_CUH
#define CORE_CUDA_PHOTONS_CUH
#include "core/cuda/count.cuh"
#include "core/physics/lone_scene.h"
#include "core/physics/photon.h"

/* Threads of a block that traces, at most: a multiprocessor has room for one.
 * Fewer where its memory is small. */
const int most_trace_threads = 512;

/* Sums of photon_counters; of books in parts of PHOTON_BOOK_ONE. */
struct photon_totals {
    device_counters track;
    unsigned long long photons, events, bounces, stored, clipped;
#define X(name) unsigned long long name;
    PHOTON_BOOKS(X)
#undef X
};

/* Adds the books of a warp's threads. */
__device__ inline void count_books(photon_totals *total,
                                   const photon_books *books)
{
#define X(name) count_warp(&total->name, static_cast<uint64_t>(books->name));
    PHOTON_BOOKS(X)
#undef X
}

/* Counts of the two lists of photons that wait. Launches take turns: one takes
 * from a list, and leaves in the other what it does not see to the end. */
struct photon_queue {
    unsigned taken;         /* of this launch's list                       */
    unsigned followed;      /* of those that the last launch leaves        */
    unsigned left[2];       /* in each list, of the launch before          */
};

/* Photons from `first` on, as many as `born`, and those that are left. */
struct trace_job {
    flat_scene scene;       /* its pointers are the device's               */
    photon_job photons;
    uint64_t first;
    unsigned born;
    void *list[2];          /* of photon_state, as the stage knows it;
                               black: born to no avail                     */
    uint64_t room;          /* of each list, for photons                   */
    photon_queue *queue;
    int turn;               /* whose list is taken from                    */
    int last;               /* 1: nothing is to be left                    */
    int processors;
    void *rings;            /* of the last photons' warps                  */
    int64_t *sum;           /* of the field's cells                        */
    photon_totals *total;
    lone_scene lone;        /* of stages that are for it                   */
};

/* Counts of the list of cells. */
struct cell_queue {
    unsigned listed, taken;
};

/* What is done to every cell. */
struct cell_job {
    flat_scene scene;
    uint64_t seed;
    uint32_t frame;
    float *cells;
    uint64_t *list;             /* of some of them, room for all: 512 times
                                   the brick, and the number in it         */
    cell_queue *queue;          /* 0                                       */
    int processors;
};

struct photon_stage {
    int may;                /* MAY_* of the scenes that it can do          */
    size_t state_bytes;     /* of a photon_state                           */
    size_t warp_bytes;      /* of a warp's memory that it shares           */
    size_t ring_bytes;      /* of the last photons', a multiprocessor      */
    int threads, blocks;    /* of a block that traces, at most; blocks of a
                               multiprocessor                              */
    void (*bear)(const trace_job *job);
    cudaError_t (*trace)(const trace_job *job, unsigned blocks, int threads);
    /* NULL: another stage's */
    void (*balls)(const cell_job *job);
    void (*light)(const cell_job *job);
};

/* What no photon meets; once photons are born, the others are no matter. */
enum { PHOTONS_IGNORE = MAY_PLATE | MAY_SINGLE,
       TRACE_IGNORES = PHOTONS_IGNORE | MAY_EMISSION | MAY_SKY | MAY_LAMPS };

extern const photon_stage photons_media, photons_balls, photons_colors,
    photons_lit, photons_fire, photons_all;
#endif
