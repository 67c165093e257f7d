/* backend.cuh - what the stages of the CUDA backend share. */
#ifndef CORE_CUDA_BACKEND_CUH
#define CORE_CUDA_BACKEND_CUH
#include "core/cuda/photons.cuh"
#include "core/cuda/tree.cuh"
#include "core/cuda/upload.cuh"
extern "C" {
#include "core/backend.h"
}

struct cuda_state {
    backend_frame frame;
    device_arena arena;
    device_arena field;         /* of a pass of its own                    */
    uploader to;                /* the device                              */
    struct resident_set *kept;  /* beside it, or NULL                      */
    sample_job job;             /* its scene's pointers are the device's   */
    const sample_stage *stage;
    const lines_stage *liner;
    const photon_stage *photons;
    const photon_stage *births;
    const photon_stage *tracer;     /* of photons that are born            */
    lone_scene lone;
    float *cells;               /* of the field                            */
    int64_t *sum;               /* of its cells; NULL without photons      */
    photon_source *source;
    photon_totals *total;
    void *list[2];              /* of photons that wait                    */
    photon_queue *queue;
    void *rings;                /* of the last photons                     */
    uint64_t *cell_list;        /* room for all; NULL where none is made   */
    cell_queue *cell_queue;
    size_t most_paths;          /* of a launch                             */
    int processors, trace_threads;
    bool one_color;             /* the channels' sums are alike, and those of
                               the first are all that is traced            */
    uint64_t reserved;          /* memory that has been told of            */
    device_clock clock;
    brume_device_seconds spent; /* since the last sample                   */
    device_arena tree;          /* built here, if it does not stay         */
    film_look *film_look;       /* the picture                             */
    double *film_row;           /* sums over its rows                      */
};

/* photons.cu */

/* Bytes of the device that photons need, beside the scene's. */
size_t photons_bytes(const cuda_state *s);
/* Takes them, and clears the sums. */
bool photons_open(cuda_state *s, brume_error *err);
bool photons_warm(cuda_state *s, brume_error *err);
bool cuda_trace(void *state, const photon_job *job, brume_stats *stats,
                brume_error *err);
bool cuda_gather(void *state, double unit, brume_error *err);
bool cuda_halve(void *state, double unit, float *blocks, brume_error *err);
bool cuda_take(void *state, float *cells, brume_error *err);
bool cuda_put(void *state, const float *cells, brume_error *err);
bool cuda_renew(void *state, brume_error *err);

/* tree_scene.cu */

/* Builds a tree that is left to the device, or takes that of a frame before;
 * the triangles are there. */
bool tree_scene_build(cuda_state *s, brume_error *err);

/* backend.cu */
void cuda_add_track(const device_counters *c, brume_stats *out);
#endif
