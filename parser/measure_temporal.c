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
    bool adaptive, unmoved;
} filters[MEASURE_FILTERS] = {
    {"1", 1, false, false},
    {"3", 3, false, false},
    {"5", 5, false, false},
    {"adaptive", BRUME_MAX_TAPS, true, false},
    /* As if no medium had a velocity. */
    {"in place", BRUME_MAX_TAPS, true, true},
};
enum { FOLLOWS = 3, IN_PLACE = 4 };

/* Seeds of their own for the references: what is measured must not share their
 * noise. */
#define REFERENCE_SEED 0x7265666572656e63u

/* One rendering of all frames. */
struct take {
    const struct measure_temporal *m;
    struct measure_filter *row; /* NULL: of a reference            */
    int which;                  /* filter, or reference            */
    uint64_t photons;
    bool moved;      /* some medium had a velocity      */
    float **picture; /* of each frame so far            */
    size_t count, room;
    int width, height;
};

static void choose_filter(const struct take *take,
                          struct brume_photon_options *p)
{
    p->taps = filters[take->which].taps;
    p->adaptive = filters[take->which].adaptive;
    p->unmoved = filters[take->which].unmoved;
    if (!p->adaptive)
        brume_film_taps(p, p->taps);
}

static void adjust(void *user, struct brume_options *o)
{
    const struct take *take = user;
    o->integrator = BRUME_INTEGRATOR_PHOTON;
    o->error = o->seconds = 0.0;
    o->spp = take->m->spp;
    o->omit_background = false;
    o->photons.adaptive = false;
    o->photons.taps = 1;
    o->photons.film_cells = true;
    if (take->photons > 0)
        o->photons.count = take->photons;
    if (o->photons.count == 0)
        o->photons.count = BRUME_DEFAULT_PHOTONS;
    if (take->row) {
        take->row->photons = o->photons.count;
        choose_filter(take, &o->photons);
        return;
    }
    o->photons.count *= MEASURE_MORE_PHOTONS;
    o->spp = o->spp * MEASURE_MORE_SAMPLES < BRUME_MAX_SPP
                 ? o->spp * MEASURE_MORE_SAMPLES
                 : BRUME_MAX_SPP;
    o->seed += REFERENCE_SEED + (uint64_t)take->which;
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
    const struct brume_photon_stats *p = &frame->stats.photons;
    take->moved = take->moved || p->drifts;
    if (take->row) {
        take->row->filter_seconds += p->seconds_filter;
        take->row->ring = p->ring > take->row->ring ? p->ring : take->row->ring;
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

/* One more row, unless the filter is the same as one before it. */
static enum brume_code measure_row(struct measure_temporal *m,
                                   struct reel *reel, uint64_t photons,
                                   int which, const struct take reference[2],
                                   bool *moved)
{
    struct measure_filter *row = &m->row[m->rows];
    struct take take = {.m = m, .row = row, .which = which, .photons = photons};
    struct brume_error err = {0};
    if (which == IN_PLACE && !*moved)
        return BRUME_OK;
    m->rows++;
    row->name = filters[which].name;
    enum brume_code code = render(reel, &take, &row->seconds);
    row->filter_seconds /= (double)(take.count > 0 ? take.count : 1);
    *moved = take.moved;
    const struct flicker_film film = {
        take.width,
        take.height,
        (int)take.count,
        (const float *const *)take.picture,
        {(const float *const *)reference[0].picture,
         (const float *const *)reference[1].picture}};
    if (!code && !flicker_find(&film, &row->flicker, &err))
        code = reel_fail(reel, &err);
    release(&take);
    return code;
}

static enum brume_code measure_rows(struct measure_temporal *m,
                                    struct reel *reel,
                                    const struct take reference[2])
{
    enum brume_code code = BRUME_OK;
    for (int k = 0; k < OPTIONS_MOST_PHOTONS; k++) {
        bool moved = false;
        if (k > 0 && m->photons[k] == 0)
            break;
        for (int i = 0; !code && i < MEASURE_FILTERS; i++)
            code = measure_row(m, reel, m->photons[k], i, reference, &moved);
    }
    return code;
}

/* ---- references --------------------------------------------------------- */

static bool compare(struct measure_temporal *m, const struct take take[2],
                    struct brume_error *err)
{
    const float *const *other = (const float *const *)take[1].picture;
    const struct flicker_film film = {take[0].width,
                                      take[0].height,
                                      (int)take[0].count,
                                      (const float *const *)take[0].picture,
                                      {other, other}};
    m->frames = (int)take[0].count;
    return flicker_find(&film, &m->noise, err);
}

static enum brume_code make_references(struct measure_temporal *m,
                                       struct reel *reel, struct take take[2])
{
    struct brume_error err = {0};
    enum brume_code code = BRUME_OK;
    uint64_t most = m->photons[0];
    for (int k = 1; k < OPTIONS_MOST_PHOTONS; k++)
        most = m->photons[k] > most ? m->photons[k] : most;
    for (int i = 0; !code && i < 2; i++) {
        take[i] = (struct take){.m = m, .which = i, .photons = most};
        code = render(reel, &take[i], &m->reference_seconds);
    }
    return code || compare(m, take, &err) ? code : reel_fail(reel, &err);
}

static bool write_csv(const struct measure_temporal *m, struct brume_error *err)
{
    struct output *out = output_open(m->csv_path, err);
    if (!out)
        return false;
    FILE *to = output_stream(out);
    fputs("photons,temporal,error,flicker,difference,band,motion,detail,"
          "seconds,filter_seconds,ring_bytes\n",
          to);
    for (int i = 0; i < m->rows; i++) {
        const struct measure_filter *r = &m->row[i];
        const struct flicker *x = &r->flicker;
        fprintf(to,
                "%llu,\"%s\",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%llu\n",
                (unsigned long long)r->photons, r->name, x->error, x->deviation,
                x->difference, x->band, x->motion, x->detail, r->seconds,
                r->filter_seconds, (unsigned long long)r->ring);
    }
    return output_commit(out, err);
}

enum brume_code measure_temporal_run(struct measure_temporal *m,
                                     struct reel *reel)
{
    struct take reference[2] = {{.m = m}, {.m = m}};
    struct brume_error err = {0};
    if (!reel->frames.animation) {
        brume_fail(&err, BRUME_ERR_USAGE,
                   "'brume measure --temporal' needs an animation: give its "
                   "last frame, +KFF");
        return reel_fail(reel, &err);
    }
    if (m->spp == 0)
        m->spp = MEASURE_SPP;
    enum brume_code code = make_references(m, reel, reference);
    if (!code)
        code = measure_rows(m, reel, reference);
    release(&reference[0]);
    release(&reference[1]);
    if (!code && m->csv_path && !write_csv(m, &err))
        code = reel_fail(reel, &err);
    return code;
}

/* ---- the table ---------------------------------------------------------- */

/* In percent, or a dash where there is no such thing. */
static void percent(double value, FILE *to)
{
    if (isfinite(value))
        fprintf(to, " %8.2f", 100.0 * value);
    else
        fprintf(to, " %8s", "-");
}

/* Of the energy of differences, where `left` of their size is left. */
static double lost(double left, double none)
{
    return 1.0 - left * fabs(left) / (none * none);
}

static void put_row(const struct measure_filter *r,
                    const struct measure_filter *none, FILE *to)
{
    const struct flicker *x = &r->flicker, *y = &none->flicker;
    double part = x->deviation / y->deviation;
    fprintf(to, "%9llu %-9s", (unsigned long long)r->photons, r->name);
    percent(x->error, to);
    percent(x->deviation, to);
    fprintf(to, " %7.3f %7.3f", part * part, x->difference / y->difference);
    percent(lost(x->detail, y->detail), to);
    percent(lost(x->motion, y->motion), to);
    fprintf(to, " %8.3g", r->seconds);
    percent(r->filter_seconds / r->seconds, to);
    fputc('\n', to);
}

void measure_temporal_table(const struct measure_temporal *m, FILE *to)
{
    const struct measure_filter *none = m->row;
    fprintf(
        to,
        "%d frames, %d samples a pixel; two references: %d times the most "
        "photons and %d\ntimes the samples, %.3g s a frame, relMSE %.2g %%, "
        "flicker %.2g %% each\n\n"
        "             error                    of     of frames' lost, %%"
        "\n  photons temporal  relMSE, %% flicker, %% "
        "variance diff.   detail   motion  s a frame filter, %%\n",
        m->frames, m->spp, MEASURE_MORE_PHOTONS, MEASURE_MORE_SAMPLES,
        m->reference_seconds, 50.0 * m->noise.error,
        100.0 * sqrt(0.5) * m->noise.deviation);
    for (int i = 0; i < m->rows; i++) {
        none = strcmp(m->row[i].name, "1") == 0 ? &m->row[i] : none;
        put_row(&m->row[i], none, to);
    }
}
