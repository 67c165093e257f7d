/* shot.h - the frames of a film that are known, each from its scene to its
 * picture in steps: it is prepared, its field traced and kept, the mean of its
 * and its neighbours' fields found, its picture rendered. Steps of different
 * frames may run at once, but for those that work on a device, of which there
 * is one at a time for each device. */
#ifndef CORE_SHOT_H
#define CORE_SHOT_H
#include <pthread.h>
#include "core/filter.h"
#include "core/frame.h"

struct shot {
    struct shot *next;
    uint32_t number;
    brume_scene *scene; /* until it is prepared                    */
    struct brume_options options;
    struct brume_still *still; /* of these as they were given             */
    bool picture;              /* will be asked for                       */
    bool open;                 /* the job is                              */
    uint64_t bytes;            /* of its scene, while it is               */
    struct frame_job job;
    struct brume_frame out;
    bool traced; /* the job's field is there                */
    bool kept;   /* the one below is                        */
    struct filter_field field;
    struct brume_error err; /* what it failed by                       */
};

struct shots {
    pthread_mutex_t lock;
    struct shot *first;
    uint64_t ring; /* bytes of the fields of all              */
    uint64_t open; /* and of the scenes of those that are open */
};

void shots_init(struct shots *shots);
void shots_release(struct shots *shots);
void shots_add(struct shots *shots, struct shot *shot);
/* What is found stays until it is forgotten; NULL: there is none. */
struct shot *shots_find(struct shots *shots, uint32_t number);
/* All below a number. */
void shots_forget(struct shots *shots, uint32_t below);

/* One that is in no list. */
void shot_free(struct shots *shots, struct shot *shot);

/* What stands still is looked for in `still`, or NULL: in that of the options;
 * nowhere if these have none. A failure is told by the picture. */
void shot_prepare(struct shots *shots, struct shot *shot,
                  struct brume_still *still);
/* Its field, where there is one; and that for its neighbours, in the ring. */
void shot_trace(struct shots *shots, struct shot *shot,
                struct brume_still *still);
void shot_keep(struct shots *shots, struct shot *shot);

/* The mean of the fields within reach, of the frames from `first` to `last`;
 * false with err set, where one of these failed too. */
bool shot_filter(struct shots *shots, struct shot *shot, uint32_t first,
                 uint32_t last, struct filter_scratch *scratch,
                 struct brume_error *err);
bool shot_render(const struct shots *shots, struct shot *shot,
                 struct brume_still *still, struct brume_error *err);
/* Its memory but for the field. */
void shot_close(struct shots *shots, struct shot *shot);
#endif
