#include "parser/measure_temporal.h"
#include "lib/memory.h"
#include "lib/output.h"
#include "lib/timer.h"
#include "parser/reel_parts.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    int taps;
    bool adaptive;
} filters[MEASURE_FILTERS] = {
    {"1", 1, false},         {"3", 3, false},        {"5", 5, false},
    {"adaptive,4", 9, true}, {"adaptive", 17, true},
};

/* A seed of its own for the reference: what is measured must not share its
 * noise. */
#define REFERENCE_SEED 0x7265666572656e63u

/* One rendering of all frames. */
struct take {
    const struct measure_temporal *m;
    struct measure_filter *filter; /* NULL: of the reference           */
    int which;
    float **picture; /* of each frame so far             */
    size_t count, room;
    int width, height;
};

static void adjust(void *user, struct brume_options *o)
{
    const struct take *take = user;
    uint64_t photons = take->m->photons;
    o->integrator = BRUME_INTEGRATOR_PHOTON;
    o->error = o->seconds = 0.0;
    o->spp = take->m->spp;
    o->omit_background = false;
    if (photons == 0)
        photons = o->photons.count > 0 ? o->photons.count
                                       : BRUME_DEFAULT_PHOTONS;
    o->photons.count = photons;
    o->photons.adaptive = false;
    if (take->filter) {
        o->photons.taps = filters[take->which].taps;
        o->photons.adaptive = filters[take->which].adaptive;
        if (!o->photons.adaptive)
            brume_film_taps(&o->photons, o->photons.taps);
        return;
    }
    o->photons.taps = 1;
    o->photons.count *= MEASURE_MORE_PHOTONS;
    o->spp = o->spp * MEASURE_MORE_SAMPLES < BRUME_MAX_SPP
                 ? o->spp * MEASURE_MORE_SAMPLES
                 : BRUME_MAX_SPP;
    o->seed += REFERENCE_SEED;
}

static bool take_picture(void *user, int number,
                         const struct brume_frame *frame,
                         struct brume_error *err)
{
    struct take *take = user;
    size_t size = 3 * (size_t)frame->width * (size_t)frame->height;
    (void)number;
    float **grown = memory_grow(take->picture, &take->room, take->count + 1,
                                sizeof *grown, err);
    if (!grown)
        return false;
    take->picture = grown;
    float *copy = memory_new(size, sizeof *copy, err);
    if (!copy)
        return false;
    memcpy(copy, frame->radiance, size * sizeof *copy);
    grown[take->count++] = copy;
    take->width = frame->width;
    take->height = frame->height;
    if (take->filter) {
        const struct brume_photon_stats *p = &frame->stats.photons;
        take->filter->filter_seconds += p->seconds_filter;
        take->filter->ring = p->ring > take->filter->ring ? p->ring
                                                          : take->filter->ring;
    }
    return true;
}

static void release(struct take *take)
{
    for (size_t i = 0; i < take->count; i++)
        free(take->picture[i]);
    free(take->picture);
}

static enum brume_code render(struct reel *reel, struct take *take,
                              double *seconds)
{
    const struct reel_sink sink = {take, adjust, take_picture};
    double start = timer_seconds();
    reel->sink = &sink;
    enum brume_code code = reel_film(reel);
    reel->sink = NULL;
    *seconds = (timer_seconds() - start) /
               (double)(take->count > 0 ? take->count : 1);
    return code;
}

static enum brume_code measure_filter(struct measure_temporal *m,
                                      struct reel *reel, int which,
                                      const struct take *reference)
{
    struct measure_filter *filter = &m->filter[which];
    struct take take = {.m = m, .filter = filter, .which = which};
    struct brume_error err = {0};
    filter->name = filters[which].name;
    enum brume_code code = render(reel, &take, &filter->seconds);
    filter->filter_seconds /= (double)(take.count > 0 ? take.count : 1);
    const struct flicker_film film = {take.width, take.height, (int)take.count,
                                      (const float *const *)take.picture,
                                      (const float *const *)reference->picture};
    if (!code && !flicker_find(&film, &filter->flicker, &err))
        code = reel_fail(reel, &err);
    release(&take);
    return code;
}

static bool write_csv(const struct measure_temporal *m, struct brume_error *err)
{
    struct output *out = output_open(m->csv_path, err);
    if (!out)
        return false;
    FILE *to = output_stream(out);
    fputs("temporal,error,flicker,difference,band,motion,detail,seconds,"
          "filter_seconds,ring_bytes\n",
          to);
    for (int i = 0; i < MEASURE_FILTERS; i++) {
        const struct measure_filter *f = &m->filter[i];
        const struct flicker *x = &f->flicker;
        fprintf(to, "\"%s\",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%llu\n",
                f->name, x->error, x->deviation, x->difference, x->band,
                x->motion, x->detail, f->seconds, f->filter_seconds,
                (unsigned long long)f->ring);
    }
    return output_commit(out, err);
}

enum brume_code measure_temporal_run(struct measure_temporal *m,
                                     struct reel *reel)
{
    struct take reference = {.m = m};
    struct brume_error err = {0};
    if (!reel->frames.animation) {
        brume_fail(&err, BRUME_ERR_USAGE,
                   "'brume measure --temporal' needs an animation: give its "
                   "last frame, +KFF");
        return reel_fail(reel, &err);
    }
    if (m->spp == 0)
        m->spp = MEASURE_SPP;
    enum brume_code code = render(reel, &reference, &m->reference_seconds);
    m->frames = (int)reference.count;
    for (int i = 0; !code && i < MEASURE_FILTERS; i++)
        code = measure_filter(m, reel, i, &reference);
    release(&reference);
    if (!code && m->csv_path && !write_csv(m, &err))
        code = reel_fail(reel, &err);
    return code;
}

/* ---- the table ---------------------------------------------------------- */

static void percent(double value, int digits, FILE *to)
{
    if (isnan(value))
        fprintf(to, "%10s", "-");
    else
        fprintf(to, "%8.*f %%", digits, 100.0 * value);
}

void measure_temporal_table(const struct measure_temporal *m, FILE *to)
{
    double first = m->filter[0].flicker.deviation;
    fprintf(to,
            "%d frames, %d samples a pixel; reference: %d times the photons "
            "and %d times the\nsamples, %.3g s a frame\n\n"
            "temporal        error   flicker  of its variance   motion    "
            "detail   s a frame  filter\n",
            m->frames, m->spp, MEASURE_MORE_PHOTONS, MEASURE_MORE_SAMPLES,
            m->reference_seconds);
    for (int i = 0; i < MEASURE_FILTERS; i++) {
        const struct measure_filter *f = &m->filter[i];
        const struct flicker *x = &f->flicker;
        double ratio = first > 0.0 ? x->deviation / first : (double)NAN;
        fprintf(to, "%-11s", f->name);
        percent(x->error, 2, to);
        percent(x->deviation, 2, to);
        fprintf(to, "%17.3f", ratio * ratio);
        percent(x->motion, 1, to);
        percent(x->detail, 1, to);
        fprintf(to, "%12.3g %7.3g\n", f->seconds, f->filter_seconds);
    }
}
