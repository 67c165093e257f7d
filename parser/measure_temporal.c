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
    int repeat;                 /* with noise of its own           */
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
        o->seed += (uint64_t)take->repeat;
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

/* ---- rows --------------------------------------------------------------- */

/* Of the energy of differences, where `left` of their size is left. */
static double lost(double left, double none)
{
    return 1.0 - left * fabs(left) / (none * none);
}

/* The n-th number of a mean. */
static void add_mean(double *mean, double x, int n)
{
    *mean += (x - *mean) / n;
}

static void add_loss(struct measure_loss *loss, double x, int n)
{
    double before = x - loss->mean;
    add_mean(&loss->mean, x, n);
    loss->square += before * (x - loss->mean);
    loss->error = n > 1 ? sqrt(loss->square / (n - 1) / n) : (double)NAN;
}

/* One more repeat; `none` is that of no filter. */
static void add_film(struct measure_filter *row, const struct flicker *film,
                     const struct flicker *none, double seconds)
{
    int n = ++row->repeats;
    struct flicker *mean = &row->flicker;
    add_mean(&mean->error, film->error, n);
    add_mean(&mean->deviation, film->deviation, n);
    add_mean(&mean->difference, film->difference, n);
    add_mean(&mean->band, film->band, n);
    add_mean(&mean->motion, film->motion, n);
    add_mean(&mean->detail, film->detail, n);
    add_mean(&row->seconds, seconds, n);
    add_loss(&row->detail, lost(film->detail, none->detail), n);
    add_loss(&row->motion, lost(film->motion, none->motion), n);
}

/* Renders a film of a row and measures it. */
static enum brume_code measure_film(struct reel *reel, struct take *take,
                                    const struct take reference[2],
                                    struct flicker *none)
{
    struct brume_error err = {0};
    struct flicker found;
    double seconds;
    enum brume_code code = render(reel, take, &seconds);
    const struct flicker_film film = {
        take->width,
        take->height,
        (int)take->count,
        (const float *const *)take->picture,
        {(const float *const *)reference[0].picture,
         (const float *const *)reference[1].picture}};
    if (code)
        return code;
    if (!flicker_find(&film, &found, &err))
        return reel_fail(reel, &err);
    if (take->which == 0)
        *none = found;
    add_film(take->row, &found, none, seconds);
    return BRUME_OK;
}

/* One film with each filter, all with the same noise: one that is the same as
 * another is left out. */
static enum brume_code measure_filters(struct measure_temporal *m,
                                       struct reel *reel, uint64_t photons,
                                       int repeat,
                                       const struct take reference[2])
{
    enum brume_code code = BRUME_OK;
    bool moved = false;
    struct flicker none = {0};
    struct measure_filter *row = m->row + m->rows;
    for (int i = 0; !code && i < MEASURE_FILTERS; i++) {
        struct take take = {.m = m,
                            .row = row,
                            .which = i,
                            .repeat = repeat,
                            .photons = photons};
        if (i == IN_PLACE && (!moved || m->taps > 0))
            break;
        if (i > 0 && m->taps > 0 && m->taps != filters[i].taps)
            continue;
        row++->name = filters[i].name;
        code = measure_film(reel, &take, reference, &none);
        moved = take.moved;
        release(&take);
    }
    return code;
}

static uint64_t fewest(const struct measure_temporal *m)
{
    uint64_t few = m->photons[0];
    for (int k = 1; k < OPTIONS_MOST_PHOTONS && m->photons[k] > 0; k++)
        few = m->photons[k] < few ? m->photons[k] : few;
    return few;
}

/* Where there are more photons their noise is less: no more of them in all. */
static int repeats_of(const struct measure_temporal *m, uint64_t photons)
{
    uint64_t few = fewest(m), all = (uint64_t)m->repeat * few;
    if (m->repeat < 2 || photons == few)
        return m->repeat < 1 ? 1 : m->repeat;
    return all / photons < 1 ? 1 : (int)(all / photons);
}

/* The seconds of filters are sums over all films and frames so far. */
static void end_rows(struct measure_temporal *m)
{
    while (m->rows < MEASURE_ROWS && m->row[m->rows].repeats > 0) {
        struct measure_filter *row = &m->row[m->rows++];
        row->filter_seconds /= (double)row->repeats * m->frames;
    }
}

static enum brume_code measure_rows(struct measure_temporal *m,
                                    struct reel *reel,
                                    const struct take reference[2])
{
    enum brume_code code = BRUME_OK;
    for (int k = 0; !code && k < OPTIONS_MOST_PHOTONS; k++) {
        if (k > 0 && m->photons[k] == 0)
            break;
        int repeats = repeats_of(m, m->photons[k]);
        for (int i = 0; !code && i < repeats; i++)
            code = measure_filters(m, reel, m->photons[k], i, reference);
        end_rows(m);
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
          "seconds,filter_seconds,ring_bytes,repeats,lost_detail,"
          "lost_detail_error,lost_motion,lost_motion_error\n",
          to);
    for (int i = 0; i < m->rows; i++) {
        const struct measure_filter *r = &m->row[i];
        const struct flicker *x = &r->flicker;
        fprintf(to,
                "%llu,\"%s\",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%llu,"
                "%d,%.6g,%.6g,%.6g,%.6g\n",
                (unsigned long long)r->photons, r->name, x->error, x->deviation,
                x->difference, x->band, x->motion, x->detail, r->seconds,
                r->filter_seconds, (unsigned long long)r->ring, r->repeats,
                r->detail.mean, r->detail.error, r->motion.mean,
                r->motion.error);
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

/* With its standard error, where it has one. */
static void put_loss(const struct measure_loss *loss, FILE *to)
{
    percent(loss->mean, to);
    if (isfinite(loss->error))
        fprintf(to, " +-%4.2f", 100.0 * loss->error);
    else
        fprintf(to, " %6s", "");
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
    put_loss(&r->detail, to);
    put_loss(&r->motion, to);
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
        "variance diff.   detail          motion         s a frame filter, "
        "%%\n",
        m->frames, m->spp, MEASURE_MORE_PHOTONS, MEASURE_MORE_SAMPLES,
        m->reference_seconds, 50.0 * m->noise.error,
        100.0 * sqrt(0.5) * m->noise.deviation);
    for (int i = 0; i < m->rows; i++) {
        none = strcmp(m->row[i].name, "1") == 0 ? &m->row[i] : none;
        put_row(&m->row[i], none, to);
    }
}
