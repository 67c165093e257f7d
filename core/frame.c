#include "core/frame.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "core/drift.h"
#include "core/physics/kdtree.h"
#include "core/plate.h"
#include "core/prepare.h"
#include "core/radiance.h"
#include "core/still.h"
#include "lib/memory.h"
#include "lib/timer.h"

/* Samples of the first pass: enough for a first estimate of the error. */
#define FIRST_PASS 8u

/* Samples of a pixel for a field of progressive's own, at most. */
#define MOST_SHARE 64u

/* From a stop to its end, though a part of a large picture is kept. */
#define STOP_SECONDS 4.2

/* Entries of a kd-tree's stack, if no other number is asked for. */
#define DEFAULT_STACK 4

static void set_goal(struct frame_job *j)
{
    const struct brume_options *o = j->options;
    bool none = o->spp <= 0 && o->error <= 0.0 && o->seconds <= 0.0;
    j->error = none ? BRUME_DEFAULT_ERROR : fmax(o->error, 0.0);
    j->most = o->spp > 0 ? (uint32_t)o->spp : BRUME_MAX_SPP;
}

/* Of progressive each sample asked for is a field and as many samples of each
 * pixel as do not cost more than its photons, about: in small pictures they
 * are what averages the field's noise over the pixel. Pictures in parts have
 * the whole one's. */
static void set_share(struct frame_job *j)
{
    const struct brume_options *o = j->options;
    uint64_t pixels = (uint64_t)o->width * (uint64_t)o->height;
    uint32_t share = 1;
    while (j->stages.passes && share < MOST_SHARE &&
           4u * share * pixels <= photons_asked(o))
        share *= 2;
    j->film.share = share;
    j->most *= share;
}

/* How much of the whole is done, as far as can be told. */
static double fraction(const struct frame_job *j, double samples)
{
    double part = samples / j->most;
    double estimate = j->out->stats.error;
    if (j->error > 0.0 && estimate > 0.0 && isfinite(estimate)) {
        double need = j->film.samples * (estimate / j->error) *
                      (estimate / j->error);
        part = fmax(part, samples / fmax(need, 1.0));
    }
    if (j->options->seconds > 0.0)
        part = fmax(part, (timer_seconds() - j->start) / j->options->seconds);
    return fmin(part, 1.0);
}

/* Where a picture that is not finished can be kept, the CPU takes all samples
 * of a piece if it is not slow. */
static bool goes_on(const struct frame_job *j, double now)
{
    enum { PATIENCE = 2 }; /* seconds                               */
    bool worth = j->options->keeper && j->backend == &backend_cpu &&
                 j->photons == 0;
    return !j->stopped || (worth && now - j->stopped_at < PATIENCE);
}

static bool tell(struct frame_job *j, struct brume_progress *p, double items)
{
    double now = timer_seconds();
    p->seconds = now - j->start;
    if (now > j->sampling)
        p->rate = items / (now - j->sampling);
    if (!j->stopped && !j->options->progress(j->options->user, p)) {
        j->stopped = true;
        j->stopped_at = now;
    }
    return goes_on(j, now);
}

/* Filters of films tell light from noise by what the halves of the photons
 * have in common. */
static bool wants_halves(const struct frame_job *j)
{
    const struct brume_options *o = j->options;
    return o->photons.adaptive && brume_film_reach(o) > 0 &&
           !j->stages.passes && photons_asked(o) > 1;
}

/* The part of all, of that of the half that is traced. */
static double photons_done(const struct frame_job *j, double done)
{
    double count = (double)j->photons, left = count - (double)j->photons_done;
    double half = wants_halves(j) ? floor(0.5 * count) : count;
    half = j->photons_done > 0 ? left : half;
    return ((double)j->photons_done + done * half) / count;
}

static bool tick(void *user, double done)
{
    struct frame_job *j = user;
    if (!j->options->progress)
        return true;
    if (j->photons > 0) {
        done = photons_done(j, done);
        struct brume_progress p = {
            .stage = "trace", .item = "photons", .fraction = done};
        return tell(j, &p, done * (double)j->photons);
    }
    double samples = j->film.samples + done * j->piece;
    struct brume_progress p = {.stage = "path", .item = "paths"};
    p.fraction = fraction(j, samples);
    return tell(j, &p, samples * (double)film_pixels(&j->film));
}

/* Samples that the error still asks for; 0: enough. `met` counts successive
 * checks at which it was small enough: two are wanted, since a check that
 * stops at the first lucky estimate stops too early. Nothing here may depend
 * on time: pictures must not. */
static uint32_t error_wants(const struct frame_job *j, int met)
{
    uint32_t n = j->film.samples;
    if (met >= 2)
        return 0;
    if (met == 1)
        return n / 8 + 1;
    double ratio = j->out->stats.error / j->error;
    double need = isfinite(ratio) ? n * ratio * ratio : 2.0 * n;
    double more = fmin(fmax(need - n, n / 8 + 1.0), n);
    return (uint32_t)more;
}

/* Samples that fit into the time left; at least one pass runs. */
static uint32_t time_allows(const struct frame_job *j, uint32_t want)
{
    uint32_t n = j->film.samples;
    if (j->options->seconds <= 0.0 || n == 0)
        return want;
    double now = timer_seconds();
    double left = j->options->seconds - (now - j->start);
    double fits = left * n / fmax(now - j->sampling, 1e-9);
    return fits < 1.0 ? 0 : fits < want ? (uint32_t)fits : want;
}

/* Where neither error nor time ends it one pass is all. */
static uint32_t next_pass(const struct frame_job *j, int met)
{
    uint32_t n = j->film.samples;
    uint32_t even = 2u * j->film.share; /* the halves stay equal */
    uint32_t want = n == 0 ? FIRST_PASS * j->film.share : n;
    if (j->error <= 0.0 && j->options->seconds <= 0.0)
        return j->most - n;
    if (n > 0 && j->error > 0.0)
        want = error_wants(j, met);
    want += (even - want % even) % even;
    want = want < j->most - n ? want : j->most - n;
    return time_allows(j, want);
}

/* Bytes that a field is made of: sums, or a copy where it is there. */
static uint64_t gather_bytes(const struct frame_job *j, const struct flat *flat)
{
    return j->traced ? flat->radiance_count * sizeof *flat->radiance
                     : radiance_sum_bytes(flat);
}

static bool check_memory(const struct frame_job *j, const struct flat *flat,
                         struct brume_error *err)
{
    uint64_t bytes = flat_bytes(flat) + gather_bytes(j, flat) +
                     film_pixels(&j->film) * sizeof(film_pixel) + j->held;
    j->out->stats.bytes = bytes;
    if (j->options->memory == 0 || bytes <= j->options->memory)
        return true;
    return brume_fail(err, BRUME_ERR_MEMORY,
                      "the frame needs %.1f MiB but only %.1f may be used",
                      (double)bytes / 1048576.0,
                      (double)j->options->memory / 1048576.0);
}

static bool run_photons(struct frame_job *j, struct brume_error *err);

static bool stop_or(const struct frame_job *j, bool good,
                    struct brume_error *err)
{
    if (good && j->stopped)
        return brume_fail(err, BRUME_STOPPED, "the rendering was stopped");
    return good;
}

/* ---- pictures that are not finished ------------------------------------ */

#define KEPT_COUNTERS(X)                                                       \
    X(0, paths)                                                                \
    X(1, rays)                                                                 \
    X(2, shadow_rays)                                                          \
    X(3, collisions)                                                           \
    X(4, lookups)                                                              \
    X(5, majorant_exceeded)                                                    \
    X(6, overflow)                                                             \
    X(7, rejected)

static struct brume_part part_of(struct frame_job *j)
{
    struct brume_part part = {.backend = j->backend->name,
                              .samples = j->film.samples,
                              .left = j->left,
                              .met = j->met,
                              .error = j->out->stats.error,
                              .pixel = j->film.pixel,
                              .bytes = film_pixels(&j->film) *
                                       sizeof(film_pixel)};
#define X(i, name) part.count[i] = j->out->stats.name - j->begun.name;
    KEPT_COUNTERS(X)
#undef X
    return part;
}

static bool fetch_film(struct frame_job *j)
{
    struct brume_error none = {0};
    return film_room(&j->film, &none) && j->backend->fetch(j->state, &none);
}

static void save_part(struct frame_job *j)
{
    const struct brume_keeper *keeper = j->options->keeper;
    bool there = keeper && !j->torn && j->film.samples > 0 && fetch_film(j);
    struct brume_part part = part_of(j);
    if (j->stopped)
        part.seconds = fmax(j->stopped_at + STOP_SECONDS - timer_seconds(),
                            1e-3);
    if (there)
        keeper->save(keeper->user, j->options->frame, &part);
    j->saved = timer_seconds();
}

/* Before the backend is opened, which takes the film as it is then. */
static void load_part(struct frame_job *j)
{
    const struct brume_keeper *keeper = j->options->keeper;
    struct brume_part part = part_of(j);
    if (!keeper || !j->rendering || part.bytes == 0)
        return;
    part.pixel = memory_new(film_pixels(&j->film), sizeof(film_pixel), NULL);
    if (!part.pixel || !keeper->load(keeper->user, j->options->frame, &part)) {
        free(part.pixel);
        return;
    }
    j->film.pixel = part.pixel;
    j->film.samples = part.samples;
    j->left = part.left;
    j->met = part.met;
    j->out->stats.error = part.error;
    j->loaded = part;
#define X(i, name) j->out->stats.name += part.count[i];
    KEPT_COUNTERS(X)
#undef X
}

/* ---- samples ------------------------------------------------------------ */

/* So many that a stop is heard soon, and a picture that takes long is kept
 * now and then. A GPU stops where it likes, so that many a picture is one
 * piece. */
static uint32_t next_piece(const struct frame_job *j)
{
    bool cpu = j->backend == &backend_cpu;
    double first = cpu ? 1.0 : 64.0;
    double fits = j->rate > 0.0 ? j->rate * (cpu ? 1.0 : 20.0) : first;
    double most = fmin(fmin(fits, 8.0 * fmax(j->piece, first)), j->left);
    return most > 1.0 ? (uint32_t)most : 1u;
}

/* What is left of the pass. */
static bool sample_some(struct frame_job *j, struct brume_error *err)
{
    enum { KEEP = 60 }; /* seconds                               */
    while (j->left > 0) {
        double start = timer_seconds();
        uint32_t count = j->piece = next_piece(j);
        if (!j->backend->sample(j->state, &count, &j->out->stats, err))
            return false;
        j->torn = count == 0;
        j->film.samples += count;
        j->left -= count;
        if (j->stopped)
            return stop_or(j, true, err);
        double now = timer_seconds();
        j->rate = count / fmax(now - start, 1e-6);
        if (now - j->saved > KEEP && j->left > 0)
            save_part(j);
    }
    return true;
}

/* As many samples, `share` of each field, so that the halves of the film tell
 * what the fields' noise is, too. */
static bool sample_fields(struct frame_job *j, struct brume_error *err)
{
    uint32_t share = j->film.share;
    bool good = true;
    for (uint32_t left = j->left; good && left > 0;) {
        uint32_t n = j->film.samples, some = share - n % share;
        some = some < left ? some : left;
        j->piece = 0;
        good = radiance_renew(j->flat, j->options, n / share, err) &&
               check_memory(j, j->flat, err) &&
               (!j->backend->renew || j->backend->renew(j->state, err)) &&
               run_photons(j, err);
        left -= some;
        j->left = some;
        good = good && sample_some(j, err);
        j->left += left;
    }
    return good;
}

static bool check_error(struct frame_job *j, struct brume_error *err)
{
    if (!film_error(&j->film, j->backend->survey, j->state,
                    &j->out->stats.error, err))
        return false;
    j->met = j->out->stats.error <= j->error ? j->met + 1 : 0;
    return true;
}

static bool sample_pass(struct frame_job *j, struct brume_error *err)
{
    bool good = j->stages.passes ? sample_fields(j, err) : sample_some(j, err);
    if (!good && j->stopped)
        save_part(j);
    return good && check_error(j, err);
}

static bool sample_passes(struct frame_job *j, struct brume_error *err)
{
    struct brume_stats *stats = &j->out->stats;
    j->sampling = j->saved = timer_seconds();
    j->begun = *stats;
#define X(i, name) j->begun.name -= j->loaded.count[i];
    KEPT_COUNTERS(X)
#undef X
    /* One that was kept at the end of a pass. */
    if (j->film.samples > 0 && j->left == 0 && !check_error(j, err))
        return false;
    while (j->left > 0 || (j->left = next_pass(j, (int)j->met)) > 0)
        if (!sample_pass(j, err))
            return false;
    stats->spp = (int)j->film.samples;
    stats->seconds_render = timer_seconds() - j->sampling -
                            (j->stages.passes ? stats->photons.seconds : 0.0);
    return true;
}

static void warn(const struct frame_job *j, const char *text)
{
    if (j->options->warn)
        j->options->warn(j->options->user, text);
}

/* Bounds by samples may be exceeded now and then. */
static void report_bounds(const struct frame_job *j)
{
    const struct brume_stats *s = &j->out->stats;
    bool sampled = j->flat->procedures_count > 0;
    char text[256];
    if (s->majorant_exceeded <= (sampled ? s->lookups / 1000 : 0))
        return;
    snprintf(text, sizeof text,
             "a density exceeded its bound at %llu of %llu places: %s",
             (unsigned long long)s->majorant_exceeded,
             (unsigned long long)s->lookups,
             sampled ? "functions finer than samples told; what is drawn is "
                       "right, but with more noise"
                     : "this is a fault of the program");
    warn(j, text);
}

/* What the user must know of how the goal was met. */
static void report_goal(const struct frame_job *j)
{
    const struct brume_stats *s = &j->out->stats;
    char text[256];
    if (j->error > 0.0 && s->error > j->error &&
        j->film.samples >= BRUME_MAX_SPP) {
        snprintf(text, sizeof text,
                 "the error of %g was not reached with %d "
                 "samples per pixel; it is about %.3g",
                 j->error, s->spp, s->error);
        warn(j, text);
    }
    if (s->overflow > 0) {
        snprintf(text, sizeof text,
                 "more than %d media or containers overlap "
                 "on %llu segments; those beyond were left out",
                 MAX_ACTIVE, (unsigned long long)s->overflow);
        warn(j, text);
    }
    report_bounds(j);
    if (s->rejected > 0) {
        snprintf(text, sizeof text,
                 "%llu samples were not finite and were "
                 "left out",
                 (unsigned long long)s->rejected);
        warn(j, text);
    }
}

static bool trace_part(struct frame_job *j, const photon_job *job,
                       struct brume_error *err)
{
    bool good = job->count == 0 ||
                j->backend->trace(j->state, job, &j->out->stats, err);
    j->photons_done += job->count;
    return stop_or(j, good, err);
}

static bool trace_halves(struct frame_job *j, const photon_job *whole,
                         struct brume_error *err)
{
    struct flat *flat = j->flat;
    photon_job half;
    free(flat->half);
    flat->half = memory_new(radiance_blocks(flat), sizeof *flat->half, err);
    if (!flat->half)
        return false;
    photons_halve(whole, 0, &half);
    flat->half_part = (double)half.count / (double)whole->count;
    if (!trace_part(j, &half, err) ||
        !j->backend->halve(j->state, whole->power / (double)whole->count,
                           flat->half, err))
        return false;
    photons_halve(whole, 1, &half);
    return trace_part(j, &half, err);
}

/* Emits, traces and gathers: fills the field of scattered light. */
static bool run_photons(struct frame_job *j, struct brume_error *err)
{
    struct brume_photon_stats *stats = &j->out->stats.photons;
    const struct backend *b = j->backend;
    const struct flat *flat = j->flat;
    struct photons photons;
    if (j->stages.passes && !b->renew)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "backend %s has no integrator progressive yet",
                          b->name);
    uint32_t pass = j->stages.passes ? j->film.samples / j->film.share : 0;
    if (!photons_plan(flat, j->options, pass, &photons, err))
        return false;
    double start = timer_seconds();
    if (!j->stages.passes) {
        j->sampling = start;
        j->photons = photons.job.count;
        j->photons_done = 0;
    }
    bool good = photons.job.sources == 0 ||
                (wants_halves(j) ? trace_halves(j, &photons.job, err)
                                 : trace_part(j, &photons.job, err));
    j->power = photons.job.power / (double)photons.job.count;
    good = good && b->gather(j->state, j->power, err);
    stats->cells = radiance_cells(flat);
    stats->side = (double)flat->view.field.side / flat->unit;
    stats->bytes = radiance_sum_bytes(flat) +
                   flat->radiance_count * sizeof(float);
    stats->seconds += timer_seconds() - start;
    j->photons = 0;
    photons_release(&photons);
    return good;
}

/* The chosen backend, or the CPU's if its memory is too small and it was not
 * asked for by name. */
static void *open_backend(struct frame_job *j,
                          const struct backend_frame *frame,
                          struct brume_error *err)
{
    char text[BACKEND_TEXT] = "";
    bool by_name = j->options->backend != BRUME_BACKEND_AUTO;
    void *state = backend_open(&j->backend, by_name ? NULL : &backend_cpu,
                               frame, text, err);
    if (text[0])
        warn(j, text);
    return state;
}

/* One that is traced alone needs no pixels. */
static bool make_film(struct frame_job *j, struct brume_error *err)
{
    j->film = (struct film){.share = 1};
    return !j->rendering || film_init(&j->film, j->options, err);
}

/* Makes the film and brings the scene to the backend. */
static bool open_state(struct frame_job *j, struct brume_error *err)
{
    double start = timer_seconds();
    j->backend = backend_choose(j->options, err);
    if (!j->backend || !make_film(j, err) || !check_memory(j, j->flat, err))
        return false;
    j->stages = plan_stages(j->flat, j->options);
    j->film.lines = j->stages.lines;
    set_share(j);
    load_part(j);
    struct backend_frame frame = {j->flat,       j->options, &j->stages,
                                  &j->film,      tick,       j,
                                  !j->rendering, j->traced};
    j->state = open_backend(j, &frame, err);
    if (!j->state)
        return false;
    snprintf(j->out->stats.backend, sizeof j->out->stats.backend, "%s",
             j->backend->name);
    j->out->stats.seconds_prepare += timer_seconds() - start;
    return true;
}

static void close_state(struct frame_job *j)
{
    if (j->state)
        j->backend->close(j->state);
    j->state = NULL;
    film_release(&j->film);
    memset(&j->film, 0, sizeof j->film);
}

/* The field without what comes straight from lights, where it is to hold
 * that: no filter is needed for it. */
static bool trace_multiple(struct frame_job *j, struct brume_error *err)
{
    bool single = j->flat->view.field.single;
    j->flat->view.field.single = false;
    bool good = open_state(j, err) && run_photons(j, err) &&
                (!j->backend->take ||
                 j->backend->take(j->state, j->flat->radiance, err));
    j->flat->view.field.single = single;
    return good;
}

bool frame_trace(struct frame_job *j, struct brume_error *err)
{
    double start = timer_seconds();
    bool good = trace_multiple(j, err);
    close_state(j);
    j->spent += timer_seconds() - start;
    return good;
}

static bool run_stages(struct frame_job *j, bool traced,
                       struct brume_error *err)
{
    const struct backend *b = j->backend;
    if (!j->stages.photons || j->stages.passes)
        return sample_passes(j, err);
    bool good = traced
                    ? (!b->put || b->put(j->state, j->flat->radiance, err)) &&
                          b->gather(j->state, 0.0, err)
                    : run_photons(j, err);
    return good && sample_passes(j, err);
}

bool frame_render(struct frame_job *j, bool traced, struct brume_error *err)
{
    j->start = timer_seconds() - j->spent;
    j->rendering = true;
    j->traced = traced;
    bool good = (traced || radiance_widen(j->flat, j->options, err)) &&
                open_state(j, err) && run_stages(j, traced, err) &&
                film_planes(&j->film, j->out, err) &&
                j->backend->develop(j->state, j->options->omit_background,
                                    j->out, err);
    if (good)
        report_goal(j);
    close_state(j);
    return good;
}

/* Whether the backend that will be opened builds trees. */
static bool leaves_tree(const struct brume_options *options)
{
    struct brume_error none = {0};
    const struct backend *b = options->tree_on_cpu
                                  ? NULL
                                  : backend_choose(options, &none);
    return b && b->builds;
}

static struct flat *prepare(brume_scene *scene,
                            const struct brume_options *options,
                            struct brume_error *err)
{
    struct prepare p = {.scene = scene,
                        .threads = options->threads,
                        .warn = options->warn,
                        .user = options->user,
                        .tree = options->tree,
                        .tree_stack = options->tree_stack,
                        .still = options->still,
                        .later = leaves_tree(options),
                        .traced = options->integrator != BRUME_INTEGRATOR_PATH};
    if (!plate_fits(&scene->plate, options->width, options->height, err))
        return NULL;
    if (p.tree_stack == 0)
        p.tree_stack = DEFAULT_STACK;
    if (p.tree_stack < 1 || p.tree_stack > KD_MAX_STACK) {
        brume_fail(err, BRUME_ERR_USAGE,
                   "a kd-tree's stack of %d entries; it has 1 to %d",
                   p.tree_stack, KD_MAX_STACK);
        return NULL;
    }
    return prepare_scene(&p, err);
}

static void count_trees(const struct brume_still *before,
                        const struct brume_still *now, struct brume_stats *out)
{
    int built = now->tree_builds - before->tree_builds;
    out->trees_built = (uint64_t)built;
    out->trees_kept = (uint64_t)(now->tree_uses - before->tree_uses - built);
}

/* With how far media move, where a filter asks for it. */
static bool lay_out(struct frame_job *j, const brume_scene *scene,
                    struct brume_error *err)
{
    const struct brume_options *o = j->options;
    bool follows = o->photons.adaptive && !o->photons.unmoved &&
                   brume_film_reach(o) > 0;
    return plan_layout(j->flat, o, err) &&
           (!follows || drift_find(scene, j->flat, o->threads, err));
}

bool frame_open(struct frame_job *j, brume_scene *scene,
                const struct brume_options *options, struct brume_frame *out,
                struct brume_error *err)
{
    memset(out, 0, sizeof *out);
    *j = (struct frame_job){
        .options = options, .out = out, .start = timer_seconds()};
    set_goal(j);
    struct brume_still before = {.tree_uses = 0}, *still = options->still;
    if (still)
        before = *still;
    j->flat = prepare(scene, options, err);
    if (still)
        count_trees(&before, still, &out->stats);
    bool good = j->flat && lay_out(j, scene, err);
    if (good)
        backend_look(j->flat, options);
    j->spent = timer_seconds() - j->start;
    out->stats.seconds_prepare = j->spent;
    return good;
}

void frame_close(struct frame_job *j)
{
    close_state(j);
    flat_free(j->flat);
    j->flat = NULL;
}

bool brume_render(brume_scene *scene, const struct brume_options *options,
                  struct brume_frame *frame, struct brume_error *err)
{
    struct frame_job job;
    bool good = frame_open(&job, scene, options, frame, err) &&
                frame_render(&job, false, err);
    frame_close(&job);
    return good;
}

bool brume_plan_frame(brume_scene *scene, const struct brume_options *options,
                      struct brume_plan *plan, struct brume_error *err)
{
    struct flat *flat = prepare(scene, options, err);
    bool good = flat && plan_layout(flat, options, err);
    if (good)
        plan_describe(scene, flat, options, plan);
    flat_free(flat);
    return good;
}
