/* backend.h - the table of functions that a backend gives. */
#ifndef CORE_BACKEND_H
#define CORE_BACKEND_H
#include "core/film.h"
#include "core/photons.h"
#include "core/plan.h"

/* What a backend works on for one frame. */
struct backend_frame {
    const struct flat *flat;
    const struct brume_options *options;
    const struct stages *stages;
    struct film *film;
    /* Asked from the calling thread now and then, with the part of this call
     * that is done; false: stop. */
    bool (*tick)(void *user, double done);
    void *user;
};

struct backend {
    const char *name;
    /* Whether it can run here; if not, says why. */
    bool (*available)(char *why, size_t size);
    /* Brings the scene to where it will be read; NULL with err set. */
    void *(*open)(const struct backend_frame *frame, struct brume_error *err);
    /* Traces all photons of the job and adds their flights to the sums of the
     * cells of the field; NULL where it cannot. */
    bool (*trace)(void *state, const photon_job *job, int64_t *sum,
                  struct brume_stats *stats, struct brume_error *err);
    /* Adds what comes straight from lights to the cells of the field; false
     * if it was stopped. */
    bool (*single)(void *state, float *cells);
    /* Adds samples [film->samples, film->samples + count) to every pixel. On
     * failure or stop the film is not to be used any more. */
    bool (*sample)(void *state, uint32_t count, struct brume_stats *stats,
                   struct brume_error *err);
    void (*close)(void *state);
};

/* What the frame asks of every pixel. */
static inline pixel_job backend_pixels(const struct backend_frame *frame)
{
    const struct brume_options *o = frame->options;
    pixel_job job;
    job.width = o->width;
    job.height = o->height;
    job.seed = o->seed;
    job.frame = o->frame;
    job.path = frame->stages->path || frame->stages->single;
    return job;
}

extern const struct backend backend_cpu;
#ifdef BRUME_CUDA
extern const struct backend backend_cuda;
#endif
#endif
