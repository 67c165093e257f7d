/* backend.h - the table of functions that a backend gives, and which backend a
 * frame is for. */
#ifndef CORE_BACKEND_H
#define CORE_BACKEND_H
#include "core/film.h"
#include "core/photons.h"
#include "core/plan.h"

/* What a backend works on for one frame. */
struct backend_frame {
    struct flat *flat;          /* its field is the backend's to fill      */
    const struct brume_options *options;
    const struct stages *stages;
    struct film *film;
    /* Asked from the calling thread now and then, with the part of this call
     * that is done; false: stop. */
    bool (*tick)(void *user, double done);
    void *user;
    bool raw;                   /* the field is filtered before it is read */
    bool traced;                /* it is there: no photon will fly         */
};

struct backend {
    const char *name;
    /* Whether it can run here; if not, says why. */
    bool (*available)(char *why, size_t size);
    /* Finds out, in any thread, what helps to open it for a frame of a film,
     * and leaves it in flat->looked; NULL: nothing. */
    void (*look)(struct flat *flat, const struct brume_options *options);
    /* Brings the scene to where it will be read; NULL with err set. */
    void *(*open)(const struct backend_frame *frame, struct brume_error *err);
    /* Traces all photons of the job and adds their flights to the sums of the
     * cells of the field, which are zero after open. */
    bool (*trace)(void *state, const photon_job *job, struct brume_stats *stats,
                  struct brume_error *err);
    /* Makes the field of the sums, `unit` being the power of the mean photon;
     * 0: it is as it was put. Adds what comes straight from lights where it is
     * to hold that. */
    bool (*gather)(void *state, double unit, struct brume_error *err);
    /* Copies sums over blocks (half.h) of what was traced so far. */
    bool (*halve)(void *state, double unit, float *blocks,
                  struct brume_error *err);
    /* Copy the numbers of the field, flat->radiance_count of them, out of the
     * backend and into it; both NULL where it works on those of `flat`. */
    bool (*take)(void *state, float *cells, struct brume_error *err);
    bool (*put)(void *state, const float *cells, struct brume_error *err);
    /* Adds samples [film->samples, film->samples + *count) to every pixel. On
     * a stop *count is how many were added; 0: the film, as on failure, is not
     * to be used any more. */
    bool (*sample)(void *state, uint32_t *count, struct brume_stats *stats,
                   struct brume_error *err);
    /* Sums over the film's rows, as film_rows; its picture, into planes that
     * are there; its pixels, to where film_room is made for them. */
    bool (*survey)(void *state, const film_survey *what,
                   struct brume_error *err);
    bool (*develop)(void *state, bool omit_background,
                    struct brume_frame *frame, struct brume_error *err);
    bool (*fetch)(void *state, struct brume_error *err);
    void (*close)(void *state);
    /* The field has been laid out anew: its sums are zero. NULL where it can't
     * be while the backend is open. */
    bool (*renew)(void *state, struct brume_error *err);
    /* How many devices there are where it can run, and which of them is the
     * calling thread's from now on; NULL: there are none to choose from. */
    int (*devices)(void);
    void (*use)(int device);
    /* Whether it builds trees that are left to it (order.h). */
    bool builds;
};

/* Where a backend keeps what stays on its device from frame to frame of a
 * film, NULL at first; `release` frees it with the still. */
void **still_device(struct brume_still *still, void (*release)(void *));

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
    job.lines = frame->stages->lines;
    job.single = o->spp == 1 && frame->film->share == 1;
    job.share = frame->film->share;
    return job;
}

/* Whether what cells blur is taken out of the field. */
static inline bool backend_sharpens(const struct backend_frame *frame)
{
    const radiance_lattice *f = &frame->flat->view.field;
    return !frame->raw && !f->ball && !f->refined;
}

/* What the options ask for; by itself the GPU's where there is one, as the
 * pictures are the same. NULL with err set: it can't run here. */
const struct backend *backend_choose(const struct brume_options *o,
                                     struct brume_error *err);

/* Lets the backend that will be opened look at what it will be given, where
 * there is a film. */
void backend_look(struct flat *flat, const struct brume_options *options);

/* From now on the calling thread works on this one of the backend's devices, if
 * there are so many; at first it does on the first. The device is started,
 * which takes a tenth of a second in which others may prepare. */
void backend_use_device(const struct brume_options *options, int device);

enum { BACKEND_TEXT = 1100 };

/* The state of *b. Where its memory is too small, `spare`, if any, takes its
 * place as *b, and `text`, of BACKEND_TEXT bytes, says so. NULL: err tells. */
void *backend_open(const struct backend **b, const struct backend *spare,
                   const struct backend_frame *frame, char *text,
                   struct brume_error *err);

extern const struct backend backend_cpu;
#ifdef BRUME_CUDA
extern const struct backend backend_cuda;
#endif
#endif
