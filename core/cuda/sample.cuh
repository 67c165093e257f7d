/* sample.cuh - the path stage: what its kernels are given, and which there
 * are. Each sample_NAME.cu is the same kernel for other scenes. */
#ifndef CORE_CUDA_SAMPLE_CUH
#define CORE_CUDA_SAMPLE_CUH
#include "core/cuda/device.cuh"
#include "core/physics/pixel.h"

/* Sums of track_counters. */
struct device_counters {
#define X(name) unsigned long long name;
    TRACK_COUNTERS(X)
#undef X
};

/* Samples [first, first + samples) of the film's pixels. */
struct sample_job {
    flat_scene scene;       /* its pointers are the device's               */
    pixel_job pixels;
    int x0, y0, x1, y1;     /* the film's part, half open                  */
    uint32_t first, samples;
    film_pixel *pixel;
    device_counters *count;  /* sums                                        */
};

struct sample_stage {
    int may;                /* MAY_* of the scenes that it can do          */
    void (*lines)(const sample_job *job);
    void (*paths)(const sample_job *job);
};

extern const sample_stage sample_media, sample_lit, sample_fire, sample_all;
#endif
