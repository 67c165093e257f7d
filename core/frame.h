/* frame.h - one frame in steps: prepare the scene, trace its photons, sample
 * until the picture is as good as asked, resolve. */
#ifndef CORE_FRAME_H
#define CORE_FRAME_H
#include "core/backend.h"

struct frame_job {
    const struct brume_options *options;
    struct brume_frame *out;
    struct flat *flat;
    struct film film;
    struct stages stages;
    const struct backend *backend;
    void *state;            /* of the backend, while it is open        */
    double start, sampling; /* seconds of the clock                    */
    double spent;           /* before the picture was begun            */
    uint64_t held;          /* bytes that a film holds besides         */
    double power;           /* of the mean photon that was traced      */
    double error;           /* aimed at, 0: none                       */
    uint32_t most;          /* samples                                 */
    uint32_t left;          /* samples of the pass still to be taken,  */
    uint32_t piece;         /* and of the call of the backend          */
    uint32_t met;           /* successive checks with a small error    */
    double rate;            /* samples a second of the last piece      */
    double saved;           /* when the picture's part was kept        */
    double stopped_at;
    struct brume_stats begun;   /* before the first sample             */
    struct brume_part loaded;   /* that the picture goes on from       */
    bool rendering;         /* the picture, not its field alone        */
    bool traced;            /* the field is there                      */
    bool torn;              /* pixels have different samples           */
    uint64_t photons;       /* of the trace that runs; 0: paths do     */
    uint64_t photons_done;  /* of these, by the traces before          */
    bool stopped;
};

/* Prepares and lays out; `options` and `out` have to stay where they are, the
 * scene is not needed any more. To be closed in any case. */
bool frame_open(struct frame_job *job, brume_scene *scene,
                const struct brume_options *options, struct brume_frame *out,
                struct brume_error *err);
/* Fills the flat scene's field with what is scattered more than once, for a
 * frame whose stages have photons. */
bool frame_trace(struct frame_job *job, struct brume_error *err);
/* The picture, its planes to be freed by the caller; `traced`: the field is
 * in the flat scene. */
bool frame_render(struct frame_job *job, bool traced, struct brume_error *err);
void frame_close(struct frame_job *job);
#endif
