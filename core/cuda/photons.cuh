/* photons.cuh - the stages of the integrator photon: what their kernels are
 * given, and which there are. Each photons_NAME.cu is the same kernels for
 * other scenes. */
#ifndef CORE_CUDA_PHOTONS_CUH
#define CORE_CUDA_PHOTONS_CUH
#include "core/cuda/sample.cuh"
#include "core/physics/photon.h"

/* Sums of photon_counters that are whole numbers. */
struct photon_totals {
    device_counters track;
    unsigned long long photons, events, bounces, stored, clipped;
};

/* Photons [first, last): `chunk` of them a warp, whose books are kept apart. */
struct trace_job {
    flat_scene scene;       /* its pointers are the device's               */
    photon_job photons;
    uint64_t first, last, chunk;
    int64_t *sum;           /* of the field's cells                        */
    photon_totals *total;
    photon_books *books;    /* a warp's                                    */
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
    void (*trace)(const trace_job *job, unsigned warps);
    void (*balls)(const cell_job *job);
    void (*light)(const cell_job *job);
};

extern const photon_stage photons_media, photons_lit, photons_fire,
    photons_all;
#endif
