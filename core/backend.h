/* backend.h - the table of functions that a backend gives. */
#ifndef CORE_BACKEND_H
#define CORE_BACKEND_H
#include "core/film.h"
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
    /* Adds samples [film->samples, film->samples + count) to every pixel. On
     * failure or stop the film is not to be used any more. */
    bool (*sample)(void *state, uint32_t count, struct brume_stats *stats,
                   struct brume_error *err);
    void (*close)(void *state);
};

extern const struct backend backend_cpu;
#ifdef BRUME_CUDA
extern const struct backend backend_cuda;
#endif
#endif
