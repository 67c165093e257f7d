/* The CPU backend: rows of pixels over threads. A pixel is summed by one
 * thread in the order of its samples, so that the picture does not depend on
 * how many there are. */
#include "core/cpu/sample.h"
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/thread.h"

static bool cpu_available(char *why, size_t size)
{
    (void)why;
    (void)size;
    return true;
}

static void cpu_close(void *state)
{
    struct cpu_state *s = state;
    if (s) {
        free(s->count);
        free(s->sum);
    }
    free(s);
}

/* The first that can do all that the scene needs. */
static const struct cpu_stage *choose_stage(int needs)
{
    static const struct cpu_stage *const list[] = {&cpu_plain, &cpu_lit,
                                                   &cpu_all};
    const struct cpu_stage *const *at = list;
    while (needs & ~(*at)->may)
        at++;
    return *at;
}

static void *cpu_open(const struct backend_frame *frame,
                      struct brume_error *err)
{
    struct cpu_state *s = memory_new(1, sizeof *s, err);
    if (!s)
        return NULL;
    int threads = frame->options->threads;
    s->frame = *frame;
    s->threads = threads > 0 ? threads : thread_processors();
    s->job = backend_pixels(frame);
    s->stage = choose_stage(frame->stages->needs & ~MAY_TINTS);
    s->count = memory_new((size_t)s->threads, sizeof *s->count, err);
    bool good = s->count && (frame->raw || film_room(frame->film, err));
    const struct flat *flat = frame->flat;
    if (good && frame->stages->photons)
        s->sum = memory_new(
            flat->radiance_count,
            frame->traced ? sizeof *flat->radiance : sizeof *s->sum, err);
    if (good && (s->sum || !frame->stages->photons))
        return s;
    cpu_close(s);
    return NULL;
}

static bool cpu_renew(void *state, struct brume_error *err)
{
    struct cpu_state *s = state;
    free(s->sum);
    s->sum = memory_new(s->frame.flat->radiance_count, sizeof *s->sum, err);
    return s->sum != NULL;
}

static void sample_row(void *context, size_t index, int thread)
{
    struct cpu_state *s = context;
    const struct film *film = s->frame.film;
    int y = film->y0 + (int)index, columns = film->x1 - film->x0;
    s->stage->row(s, y, film->pixel + index * (size_t)columns,
                  &s->count[thread]);
    size_t done = atomic_fetch_add(&s->rows_done, 1) + 1;
    /* Thread 0 is the caller's own. */
    if (thread == 0 &&
        !s->frame.tick(s->frame.user, (double)done / (film->y1 - film->y0)))
        atomic_store(&s->stop, true);
}

void cpu_add_track(const track_counters *c, struct brume_stats *out)
{
#define X(name) out->name += c->name;
    TRACK_COUNTERS(X)
#undef X
}

static void add_counts(const struct cpu_state *s, struct brume_stats *out)
{
    for (int i = 0; i < s->threads; i++)
        cpu_add_track(&s->count[i], out);
}

static bool cpu_sample(void *state, uint32_t *count, struct brume_stats *stats,
                       struct brume_error *err)
{
    (void)err;
    struct cpu_state *s = state;
    const struct film *film = s->frame.film;
    s->samples = *count;
    atomic_store(&s->rows_done, 0);
    atomic_store(&s->stop, false);
    memset(s->count, 0, (size_t)s->threads * sizeof *s->count);
    parallel_for(s->threads, (size_t)(film->y1 - film->y0), sample_row, s,
                 &s->stop);
    add_counts(s, stats);
    if (atomic_load(&s->stop) &&
        atomic_load(&s->rows_done) < (size_t)(film->y1 - film->y0))
        *count = 0;
    return true;
}

static bool cpu_survey(void *state, const film_survey *what,
                       struct brume_error *err)
{
    const struct cpu_state *s = state;
    return film_rows_here(s->frame.film, what, err);
}

static bool cpu_develop(void *state, bool omit_background,
                        struct brume_frame *frame, struct brume_error *err)
{
    (void)err;
    const struct cpu_state *s = state;
    film_develop_here(s->frame.film, omit_background, frame);
    return true;
}

/* They are there. */
static bool cpu_fetch(void *state, struct brume_error *err)
{
    (void)state;
    (void)err;
    return true;
}

const struct backend backend_cpu = {
    .name = "cpu",
    .available = cpu_available,
    .open = cpu_open,
    .trace = cpu_trace,
    .gather = cpu_gather,
    .halve = cpu_halve,
    .sample = cpu_sample,
    .survey = cpu_survey,
    .develop = cpu_develop,
    .fetch = cpu_fetch,
    .close = cpu_close,
    .renew = cpu_renew,
};
