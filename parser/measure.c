#include "parser/measure.h"
#include "lib/memory.h"
#include "lib/timer.h"
#include "parser/picture.h"
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const struct measure_series measure_series[] = {
    {"path", BRUME_INTEGRATOR_PATH, true, false, 1},
    {"photon", BRUME_INTEGRATOR_PHOTON, false, false, 1},
    {"photon fine", BRUME_INTEGRATOR_PHOTON, false, false, 0.5},
    {"photon paper", BRUME_INTEGRATOR_PHOTON, false, true, 1},
    {"progressive", BRUME_INTEGRATOR_PROGRESSIVE, true, false, 1},
};
const int measure_series_count = sizeof measure_series / sizeof *measure_series;

const double measure_goals[MEASURE_GOALS] = {0.10, 0.03, 0.01};

/* Of the budget, for a reference that has to be rendered. */
#define REFERENCE_SHARE 0.5
/* Samples and photons of a series' first row, photons of any. */
#define FIRST_SPP 4
#define FIRST_PHOTONS 62500u
#define MOST_PHOTONS 10000000000u
/* Rows never share random numbers with a reference of the scene's own seed. */
#define ROW_SEED 0x6d65617375726521u

enum { MAX_SERIES = 16 };

/* What is under way. */
struct sweep {
    struct measure *m;
    brume_scene *scene;
    float *reference; /* 3 per pixel                             */
    double start;
    double side;                             /* of the scene's own cells */
    struct measure_setting next[MAX_SERIES]; /* spp 0: the series is done */
    double wait[MAX_SERIES];                 /* seconds it will take      */
};

/* ---- the reference ------------------------------------------------------ */

static void find_part(const struct brume_options *o, int part[4])
{
    bool whole = !o->x0 && !o->y0 && !o->x1 && !o->y1;
    part[0] = o->x0;
    part[1] = o->y0;
    part[2] = whole ? o->width : o->x1;
    part[3] = whole ? o->height : o->y1;
}

double measure_difference(const float *picture, const float *reference,
                          int width, const int part[4])
{
    double mean = 0.0, sum = 0.0;
    double count = 3.0 * (part[2] - part[0]) * (part[3] - part[1]);
    for (int y = part[1]; y < part[3]; y++)
        for (int i = 3 * part[0]; i < 3 * part[2]; i++)
            mean += (double)
                reference[3 * (size_t)y * (size_t)width + (size_t)i];
    mean /= count;
    for (int y = part[1]; y < part[3]; y++)
        for (int i = 3 * part[0]; i < 3 * part[2]; i++) {
            size_t at = 3 * (size_t)y * (size_t)width + (size_t)i;
            double r = (double)reference[at], d = (double)picture[at] - r;
            if (d != 0.0)
                sum += d * d / (r * r + 0.01 * mean * mean);
        }
    return sqrt(sum / count);
}

static bool interleave(struct sweep *s, const struct exr_picture *p,
                       struct brume_error *err)
{
    static const char *const channels[3] = {"R", "G", "B"};
    size_t pixels = (size_t)p->width * (size_t)p->height;
    s->reference = memory_new(pixels, 3 * sizeof(float), err);
    for (int c = 0; s->reference && c < 3; c++) {
        const float *plane = exr_plane(p, channels[c]);
        if (!plane)
            return brume_fail_file(err, s->m->reference, "has no channel %s",
                                   channels[c]);
        for (size_t i = 0; i < pixels; i++) {
            if (!isfinite(plane[i]))
                return brume_fail_file(err, s->m->reference,
                                       "has samples that are not finite");
            s->reference[3 * i + (size_t)c] = plane[i];
        }
    }
    return s->reference != NULL;
}

/* A picture of Brume's tells its noise in its header. */
static bool take_reference(struct sweep *s, struct brume_error *err)
{
    struct measure *m = s->m;
    char text[64];
    struct exr_picture *p = exr_load(m->reference, err);
    if (!p)
        return false;
    bool fits = p->width == m->options.width && p->height == m->options.height;
    bool ok = fits && interleave(s, p, err);
    if (!fits)
        brume_fail(err, BRUME_ERR_USAGE,
                   "%s has %d x %d pixels; %d x %d are to be measured",
                   m->reference, p->width, p->height, m->options.width,
                   m->options.height);
    exr_free(p);
    if (!ok || !exr_text_of(m->reference, "relativeError", text, sizeof text))
        return ok;
    char *end;
    double noise = strtod(text, &end);
    m->noise_known = end != text && isfinite(noise) && noise >= 0.0;
    m->noise = m->noise_known ? noise : 0.0;
    return true;
}

static bool keep_reference(const struct measure *m,
                           const struct brume_frame *frame,
                           struct brume_error *err)
{
    char samples[32], noise[32];
    snprintf(samples, sizeof samples, "%d", m->reference_spp);
    snprintf(noise, sizeof noise, "%.6g", m->noise);
    const struct exr_text text[] = {{"software", "Brume " BRUME_VERSION},
                                    {"scene", m->scene},
                                    {"samplesPerPixel", samples},
                                    {"relativeError", noise}};
    struct picture picture = {.frame = frame,
                              .format = OPTIONS_FORMAT_EXR,
                              .text = text,
                              .texts = sizeof text / sizeof *text};
    return !m->picture_path ||
           picture_write(&picture, m->picture_path, NULL, err);
}

static bool make_reference(struct sweep *s, struct brume_error *err)
{
    struct measure *m = s->m;
    struct brume_options options = m->options;
    struct brume_frame frame = {0};
    options.integrator = BRUME_INTEGRATOR_PATH;
    options.seconds = REFERENCE_SHARE * m->budget;
    if (!brume_render(s->scene, &options, &frame, err))
        return false;
    m->noise_known = isfinite(frame.stats.error);
    m->noise = m->noise_known ? frame.stats.error : 0.0;
    m->reference_spp = frame.stats.spp;
    m->reference_seconds = frame.stats.seconds_prepare +
                           frame.stats.seconds_render;
    bool ok = keep_reference(m, &frame, err);
    s->reference = frame.radiance;
    frame.radiance = NULL;
    brume_frame_free(&frame);
    return ok;
}

/* ---- rows --------------------------------------------------------------- */

static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Relative difference of the means of pictures in a part of them. */
static double mean_off(const float *picture, const float *reference, int width,
                       const int part[4])
{
    double off = 0.0, all = 0.0;
    for (int y = part[1]; y < part[3]; y++)
        for (int i = 3 * part[0]; i < 3 * part[2]; i++) {
            size_t at = 3 * (size_t)y * (size_t)width + (size_t)i;
            off += (double)picture[at] - (double)reference[at];
            all += (double)reference[at];
        }
    return all > 0.0 ? off / all : 0.0;
}

static struct brume_options row_options(const struct measure *m,
                                        const struct measure_setting *set)
{
    const struct measure_series *series = &measure_series[set->series];
    struct brume_options o = m->options;
    o.integrator = series->integrator;
    o.spp = set->spp;
    o.seed ^= ROW_SEED;
    if (set->photons > 0)
        o.photons.count = set->photons;
    if (set->spacing > 0.0)
        o.photons.spacing = set->spacing;
    if (series->paper)
        brume_photons_paper(&o.photons);
    return o;
}

/* *needed: photons were traced, if the integrator has any. */
static bool render_row(struct sweep *s, const struct measure_setting *set,
                       struct measure_row *row, bool *needed,
                       struct brume_error *err)
{
    const struct measure *m = s->m;
    struct brume_options options = row_options(m, set);
    struct brume_frame frame = {0};
    int part[4];
    find_part(&m->options, part);
    double cpu = cpu_seconds();
    if (!brume_render(s->scene, &options, &frame, err))
        return false;
    const struct brume_stats *stats = &frame.stats;
    *row = (struct measure_row){
        .set = *set,
        .cpu_seconds = cpu_seconds() - cpu,
        .prepare_seconds = stats->seconds_prepare,
        .photon_seconds = stats->photons.seconds,
        .seconds = stats->seconds_prepare + stats->photons.seconds +
                   stats->seconds_render,
        .estimate = stats->error,
        .difference = measure_difference(frame.radiance, s->reference,
                                         m->options.width, part),
        .bias = mean_off(frame.radiance, s->reference, m->options.width, part),
    };
    double square = row->difference * row->difference - m->noise * m->noise;
    row->error = square > 0.0 ? sqrt(square) : 0.0;
    *needed = options.integrator == BRUME_INTEGRATOR_PATH ||
              stats->photons.traced > 0;
    if (s->side == 0.0)
        s->side = stats->photons.side;
    brume_frame_free(&frame);
    return true;
}

/* The series whose next row is soonest done, or -1. */
static int soonest(const struct sweep *s)
{
    int best = -1;
    for (int i = 0; i < measure_series_count; i++)
        if (s->next[i].spp && (best < 0 || s->wait[i] < s->wait[best]))
            best = i;
    return best;
}

static const struct measure_row *last_of(const struct measure *m, int series)
{
    for (int i = m->rows - 1; i >= 0; i--)
        if (m->row[i].set.series == series)
            return &m->row[i];
    return NULL;
}

/* Below the noise of the reference nothing can be told; a bias does not fall
 * with more samples. */
static bool goes_on(const struct measure *m, const struct measure_row *row,
                    const struct measure_row *before)
{
    if (row->set.spp > BRUME_MAX_SPP / 2 || row->set.photons > MOST_PHOTONS ||
        row->difference == 0.0)
        return false;
    if (measure_uncertain(m, row))
        return false;
    return measure_series[row->set.series].unbiased || !before ||
           row->error < 0.97 * before->error;
}

/* Twice as much of what the error comes from: of samples, of photons, or of
 * both where neither is most of it. */
static void plan_next(struct sweep *s, const struct measure_row *row)
{
    struct measure_setting *next = &s->next[row->set.series];
    double noise = row->estimate * row->estimate;
    double rest = row->error * row->error - noise;
    int spp = row->set.photons == 0 || !(noise < rest / 3.0) ? 2 : 1;
    unsigned photons = rest > noise / 3.0 ? 2 : 1;
    *next = row->set;
    next->spp *= spp;
    next->photons *= photons;
    if (row->set.photons == 0)
        photons = 2;
    s->wait[row->set.series] = row->prepare_seconds +
                               photons * row->photon_seconds +
                               spp * (row->seconds - row->prepare_seconds -
                                      row->photon_seconds);
}

/* The first row of a series; of cells of another size, once it is known what
 * the scene's own are. */
static void begin_series(struct sweep *s, int i)
{
    const struct measure *m = s->m;
    const struct measure_series *series = &measure_series[i];
    bool photons = series->integrator == BRUME_INTEGRATOR_PHOTON;
    if ((m->only >= 0 && (int)series->integrator != m->only) ||
        (series->cells != 1.0 && s->side == 0.0) ||
        (series->paper && m->options.photons.gather == BRUME_GATHER_BALL))
        return;
    s->next[i] = (struct measure_setting){
        .series = i,
        .spp = FIRST_SPP,
        .photons = photons ? FIRST_PHOTONS : 0,
        .spacing = series->cells != 1.0 ? s->side * series->cells : 0.0,
    };
}

static bool add_row(struct sweep *s, int series, struct brume_error *err)
{
    struct measure *m = s->m;
    struct measure_row row;
    bool needed, told = s->side > 0.0;
    const struct measure_row *before = last_of(m, series);
    if (!render_row(s, &s->next[series], &row, &needed, err))
        return false;
    s->next[series].spp = 0;
    if (!needed)
        return true;
    if (goes_on(m, &row, before))
        plan_next(s, &row);
    for (int i = 0; !told && s->side > 0.0 && i < measure_series_count; i++)
        if (measure_series[i].cells != 1.0)
            begin_series(s, i);
    m->row[m->rows++] = row;
    measure_conclude(m);
    return measure_csv(m, err);
}

static bool add_rows(struct sweep *s, struct brume_error *err)
{
    struct measure *m = s->m;
    for (int i = 0; i < measure_series_count; i++)
        begin_series(s, i);
    for (int i; m->rows < MEASURE_MAX_ROWS && (i = soonest(s)) >= 0;) {
        double end = timer_seconds() - s->start + s->wait[i];
        if (m->rows > 0 && end > m->budget)
            s->next[i].spp = 0;
        else if (!add_row(s, i, err))
            return false;
    }
    return true;
}

bool measure_run(struct measure *m, brume_scene *scene, struct brume_error *err)
{
    struct sweep s = {.m = m, .scene = scene, .start = timer_seconds()};
    bool ok = m->reference ? take_reference(&s, err) : make_reference(&s, err);
    ok = ok && add_rows(&s, err) && measure_svg(m, err);
    free(s.reference);
    return ok;
}
