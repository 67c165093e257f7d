/* photons.cuh - the stages of the integrator photon: what their kernels are
 * given, and which there are. Each photons_NAME.cu is the same kernels for
 * other scenes. */
#ifndef CORE_CUDA_PHOTONS_CUH
#define CORE_CUDA_PHOTONS_CUH
#include "core/cuda/sample.cuh"
#include "core/physics/photon.h"

/* Sums of photon_counters; of books in parts of PHOTON_BOOK_ONE. */
struct photon_totals {
    device_counters track;
    unsigned long long photons, events, bounces, stored, clipped;
#define X(name) unsigned long long name;
    PHOTON_BOOKS(X)
#undef X
};

/* Photons from `first` on, as many as `born`. */
struct trace_job {
    flat_scene scene;       /* its pointers are the device's               */
    photon_job photons;
    uint64_t first;
    unsigned born;
    void *list;             /* of photon_state, as the stage knows it: those
                               that are born; black: to no avail           */
    unsigned *taken;        /* of the list                                 */
    int64_t *sum;           /* of the field's cells                        */
    photon_totals *total;
};

/* What is done to every cell. */
struct cell_job {
    flat_scene scene;
    uint64_t seed;
    uint32_t frame;
    float *cells;
};

struct photon_stage {
    int may;                /* MAY_* of the scenes that it can do          */
    size_t state_bytes;     /* of a photon_state                           */
    void (*bear)(const trace_job *job);
    void (*trace)(const trace_job *job, unsigned warps);
    void (*balls)(const cell_job *job);
    void (*light)(const cell_job *job);
};

extern const photon_stage photons_media, photons_lit, photons_fire,
    photons_all;
#endif
