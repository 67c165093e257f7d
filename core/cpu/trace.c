/* The trace stage: batches of photons over threads. What a batch counts is
 * kept apart and added up in order; the sums of the field are whole numbers,
 * which any order adds up to the same. */
#include "core/cpu/cpu.h"
#include <stdlib.h>
#include "lib/memory.h"
#include "lib/thread.h"

#define BATCH 1024u
#define MOST_BATCHES 16384u

struct trace {
    struct cpu_state *state;
    const photon_job *job;
    photon_counters *batch;
    uint64_t size; /* photons of a batch                      */
    size_t batches;
    atomic_size_t done;
};

static void trace_batch(void *context, size_t index, int thread)
{
    struct trace *t = context;
    struct cpu_state *s = t->state;
    uint64_t first = index * t->size, left = t->job->count - first;
    t->batch[index].tally.sum = s->sum;
    photon_run(&s->frame.flat->view, t->job, first,
               left < t->size ? left : t->size, &t->batch[index]);
    size_t done = atomic_fetch_add(&t->done, 1) + 1;
    if (thread == 0 &&
        !s->frame.tick(s->frame.user, (double)done / (double)t->batches))
        atomic_store(&s->stop, true);
}

static void add_books(const photon_books *b, struct brume_photon_stats *out)
{
#define X(name) out->name += b->name;
    PHOTON_BOOKS(X)
#undef X
}

static void add_batch(const photon_counters *c, struct brume_stats *out)
{
    cpu_add_track(&c->track, out);
    out->photons.traced += c->photons;
    out->photons.events += c->events;
    out->photons.bounces += c->bounces;
    out->photons.stored += c->stored;
    out->photons.clipped += c->tally.clipped;
    add_books(&c->books, &out->photons);
}

bool cpu_trace(void *state, const photon_job *job, struct brume_stats *stats,
               struct brume_error *err)
{
    struct cpu_state *s = state;
    struct trace t = {.state = s, .job = job, .size = BATCH};
    if (job->count / MOST_BATCHES >= BATCH)
        t.size = job->count / MOST_BATCHES + 1;
    t.batches = (size_t)((job->count + t.size - 1) / t.size);
    t.batch = memory_new(t.batches, sizeof *t.batch, err);
    if (!t.batch)
        return false;
    atomic_store(&s->stop, false);
    parallel_for(s->threads, t.batches, trace_batch, &t, &s->stop);
    for (size_t i = 0; i < t.batches; i++)
        add_batch(&t.batch[i], stats);
    free(t.batch);
    return true;
}
