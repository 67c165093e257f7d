/* sample.cuh - the path stage: what its kernels are given, and which there
 * are. Each lines_NAME.cu and sample_NAME.cu is the same kernel for other
 * scenes. */
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

/* Counts of the list of paths that have left the eye's lines. */
struct path_queue {
    unsigned listed, taken;
};

/* Samples of a job, at most, where light is sought along the eye's rays. */
const unsigned most_samples = 8;

/* Samples [first, first + samples) of the film's pixels. */
struct sample_job {
    flat_scene scene;       /* its pointers are the device's               */
    pixel_job pixels;
    int x0, y0, x1, y1;     /* the film's part, half open                  */
    uint32_t first, samples;
    film_pixel *pixel;
    rgb *result;            /* of paths: a sample's pixels, then the next's */
    void *bent;             /* list of paths, as the stage knows them; NULL:
                               none is kept                                */
    path_queue *queue;
    int processors;
    device_counters *count;  /* sums                                        */
    uint32_t line, line_end;    /* a pixel's lines of these, half open     */
};

struct sample_stage {
    int may;                /* MAY_* of the scenes that it can do          */
    size_t bent_bytes;      /* of a path in the list                       */
    void (*paths)(const sample_job *job);
};

struct lines_stage {
    int may;                /* as of sample_stage                          */
    void (*lines)(const sample_job *job);
};

/* What the lines of a scene are the same with and without. */
const int LINES_IGNORE = MAY_LAMPS | MAY_CLEAR | MAY_SINGLE;

extern const lines_stage lines_media, lines_fire, lines_lit, lines_all;

extern const sample_stage sample_gray, sample_media, sample_glow, sample_lit,
    sample_fire, sample_all;
#endif
