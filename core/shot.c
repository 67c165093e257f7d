#include "core/shot.h"
#include <stdlib.h>
#include "core/radiance.h"
#include "lib/timer.h"

void shots_init(struct shots *shots)
{
    *shots = (struct shots){.first = NULL};
    pthread_mutex_init(&shots->lock, NULL);
}

void shots_release(struct shots *shots)
{
    while (shots->first) {
        struct shot *shot = shots->first;
        shots->first = shot->next;
        shot_free(shots, shot);
    }
    pthread_mutex_destroy(&shots->lock);
}

void shots_add(struct shots *shots, struct shot *shot)
{
    pthread_mutex_lock(&shots->lock);
    shot->next = shots->first;
    shots->first = shot;
    pthread_mutex_unlock(&shots->lock);
}

struct shot *shots_find(struct shots *shots, uint32_t number)
{
    pthread_mutex_lock(&shots->lock);
    struct shot *shot = shots->first;
    while (shot && shot->number != number)
        shot = shot->next;
    pthread_mutex_unlock(&shots->lock);
    return shot;
}

static uint64_t ring_bytes(const struct shots *shots)
{
    return __atomic_load_n(&shots->ring, __ATOMIC_RELAXED);
}

/* What is held beside a frame's own: other scenes where there is a limit, as
 * then steps are in turn and it is the same in each run. */
static uint64_t held_beside(const struct shots *shots, const struct shot *shot)
{
    uint64_t open = __atomic_load_n(&shots->open, __ATOMIC_RELAXED);
    return ring_bytes(shots) +
           (shot->options.memory > 0 ? open - shot->bytes : 0);
}

static void count_open(struct shots *shots, struct shot *shot, uint64_t bytes)
{
    __atomic_fetch_add(&shots->open, bytes - shot->bytes, __ATOMIC_RELAXED);
    shot->bytes = bytes;
}

/* Takes the shots below a number off the list. */
static struct shot *take_below(struct shots *shots, uint32_t below)
{
    struct shot *gone = NULL;
    pthread_mutex_lock(&shots->lock);
    struct shot **at = &shots->first;
    while (*at) {
        struct shot *shot = *at;
        if (shot->number >= below) {
            at = &shot->next;
            continue;
        }
        *at = shot->next;
        shot->next = gone;
        gone = shot;
    }
    pthread_mutex_unlock(&shots->lock);
    return gone;
}

void shots_forget(struct shots *shots, uint32_t below)
{
    struct shot *gone = take_below(shots, below);
    while (gone) {
        struct shot *next = gone->next;
        if (gone->kept)
            __atomic_fetch_sub(&shots->ring, filter_bytes(&gone->field),
                               __ATOMIC_RELAXED);
        shot_free(shots, gone);
        gone = next;
    }
}

void shot_close(struct shots *shots, struct shot *shot)
{
    count_open(shots, shot, 0);
    if (shot->open)
        frame_close(&shot->job);
    shot->open = false;
    brume_scene_free(shot->scene);
    shot->scene = NULL;
}

void shot_free(struct shots *shots, struct shot *shot)
{
    shot_close(shots, shot);
    if (shot->kept)
        filter_release(&shot->field);
    brume_frame_free(&shot->out);
    free(shot);
}

static void use_still(struct shot *shot, struct brume_still *still)
{
    if (shot->still)
        shot->options.still = still ? still : shot->still;
}

void shot_prepare(struct shots *shots, struct shot *shot,
                  struct brume_still *still)
{
    use_still(shot, still);
    shot->open = true;
    bool good = frame_open(&shot->job, shot->scene, &shot->options, &shot->out,
                           &shot->err);
    brume_scene_free(shot->scene);
    shot->scene = NULL;
    if (good)
        count_open(shots, shot, flat_bytes(shot->job.flat));
    else
        shot_close(shots, shot);
}

void shot_trace(struct shots *shots, struct shot *shot,
                struct brume_still *still)
{
    struct frame_job *job = &shot->job;
    if (!shot->open || !plan_stages(job->flat, &shot->options).photons)
        return;
    use_still(shot, still);
    job->held = held_beside(shots, shot);
    shot->traced = frame_trace(job, &shot->err);
}

void shot_keep(struct shots *shots, struct shot *shot)
{
    const struct frame_job *job = &shot->job;
    shot->kept = shot->traced &&
                 filter_keep(job->flat, job->power, &shot->field, &shot->err);
    if (shot->kept)
        __atomic_fetch_add(&shots->ring, filter_bytes(&shot->field),
                           __ATOMIC_RELAXED);
    if (shot->err.code || !shot->picture)
        shot_close(shots, shot);
}

/* The fields within reach; false with err set where a frame failed. */
static bool list_fields(struct shots *shots, const struct shot *shot,
                        uint32_t first, uint32_t last, int reach,
                        const struct filter_field **fields,
                        struct brume_error *err)
{
    for (int k = -reach; k <= reach; k++) {
        int64_t number = (int64_t)shot->number + k;
        fields[k + reach] = NULL;
        if (number < first || number > last)
            continue;
        const struct shot *other = shots_find(shots, (uint32_t)number);
        if (!other)
            return brume_fail(err, BRUME_ERR_USAGE,
                              "frame %lld, which is within the reach of frame "
                              "%lu, was not pushed",
                              (long long)number, (unsigned long)shot->number);
        if (other->err.code) {
            *err = other->err;
            return false;
        }
        if (other->kept)
            fields[k + reach] = &other->field;
    }
    return true;
}

static bool run_filter(struct shot *shot,
                       const struct filter_field *const *fields, int reach,
                       struct filter_scratch *scratch, struct brume_error *err)
{
    const struct brume_options *o = &shot->options;
    if (o->photons.adaptive)
        return filter_adapt(shot->job.flat, fields, reach, o->threads, scratch,
                            err);
    return filter_mean(shot->job.flat, fields, o->photons.weight, reach,
                       o->threads, err);
}

bool shot_filter(struct shots *shots, struct shot *shot, uint32_t first,
                 uint32_t last, struct filter_scratch *scratch,
                 struct brume_error *err)
{
    const struct filter_field *fields[BRUME_MAX_TAPS];
    int reach = brume_film_reach(&shot->options);
    struct brume_photon_stats *stats = &shot->out.stats.photons;
    double start = timer_seconds();
    if (!shot->open || !shot->kept)
        return true;
    if (!list_fields(shots, shot, first, last, reach, fields, err) ||
        !run_filter(shot, fields, reach, scratch, err) ||
        !radiance_widen(shot->job.flat, &shot->options, err))
        return false;
    stats->ring = ring_bytes(shots);
    stats->drifts = shot->field.drift != NULL;
    stats->seconds_filter = timer_seconds() - start;
    return true;
}

bool shot_render(const struct shots *shots, struct shot *shot,
                 struct brume_still *still, struct brume_error *err)
{
    if (shot->err.code) {
        *err = shot->err;
        return false;
    }
    if (!shot->open)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "frame %lu was pushed without a picture, or has had "
                          "its own",
                          (unsigned long)shot->number);
    use_still(shot, still);
    shot->job.held = held_beside(shots, shot);
    return frame_render(&shot->job, shot->traced, err);
}
