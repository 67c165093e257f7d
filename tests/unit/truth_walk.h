/* truth_walk.h - many paths together through a scene with a symmetry, for
 * truths that would take a picture too long.
 *
 * - Each step is the renderer's (truth_step.h). Paths of as many events are
 *   sorted by where they are, and take their random numbers from one lattice:
 *   what befalls neighbours differs, and the mean over them has little noise
 *   [array-RQMC: L'Ecuyer, Lecot, Tuffin 2008].
 * - Paths are split, or ended at random, by their weight times what is still
 *   due (truth_importance.h), which decides the noise only. */
#ifndef TESTS_UNIT_TRUTH_WALK_H
#define TESTS_UNIT_TRUTH_WALK_H
#include <stdlib.h>
#include "tests/gpu/walk.h"
#include "tests/unit/truth_flat.h"
#include "tests/unit/truth_importance.h"
#include "tests/unit/truth_step.h"

struct walk_list {
    struct walker *item;
    size_t count, room;
};

/* Those of one batch. */
struct walk_crowd {
    struct walk *w;
    struct walk_list now, next;
    struct walk_path path; /* the one that steps                           */
    double sum;
};

static inline void walk_room(struct walk_list *l, size_t count)
{
    if (count <= l->room)
        return;
    l->room = 2 * count;
    l->item = realloc(l->item, l->room * sizeof *l->item);
    assert_non_null(l->item);
}

/* `next` becomes `now`. */
static inline void walk_swap(struct walk_crowd *c)
{
    struct walk_list l = c->now;
    c->now = c->next;
    c->next = l;
    c->next.count = 0;
}

static inline void walk_sort_by(struct walk_crowd *c, int shift)
{
    size_t first[257] = {0};
    walk_room(&c->next, c->now.count);
    for (size_t i = 0; i < c->now.count; i++)
        first[(c->now.item[i].key >> shift & 255u) + 1]++;
    for (int i = 0; i < 256; i++)
        first[i + 1] += first[i];
    for (size_t i = 0; i < c->now.count; i++) {
        const struct walker *a = &c->now.item[i];
        c->next.item[first[a->key >> shift & 255u]++] = *a;
    }
    c->next.count = c->now.count;
    walk_swap(c);
}

static inline void walk_sort(struct walk_crowd *c)
{
    float lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i < c->now.count; i++) {
        lo = fminf(lo, c->now.item[i].at);
        hi = fmaxf(hi, c->now.item[i].at);
    }
    double width = fmax((double)(hi - lo), 1e-9);
    for (size_t i = 0; i < c->now.count; i++) {
        struct walker *a = &c->now.item[i];
        a->key = walk_key(c->w, a, fmin((double)(a->at - lo) / width, 1.0),
                          (double)c->now.count);
    }
    walk_sort_by(c, 0);
    walk_sort_by(c, 8);
}

/* Splits and ends: in order, so that neighbours stand in for each other. */
static inline void walk_populate(struct walk_crowd *c)
{
    rng r = walk_random(c->w, c->path.a.batch, 13, 0);
    double due = (double)rng_float(&r);
    for (size_t i = 0; i < c->now.count; i++) {
        struct walker a = c->now.item[i];
        double share, copies = 1.0;
        if (walk_is_split(c->w, &a, &share)) {
            due += share;
            copies = floor(due);
            due -= copies;
            a.weight /= share;
        }
        for (; copies > 0.0; copies -= 1.0) {
            walk_room(&c->next, c->next.count + 1);
            c->next.item[c->next.count++] = a;
        }
    }
    walk_swap(c);
}

/* What a walker is worth after its first flight is what one is worth. */
static inline void walk_set_share(struct walk_crowd *c)
{
    double sum = 0.0;
    for (size_t i = 0; i < c->now.count; i++)
        sum += walk_worth(c->w, &c->now.item[i]);
    c->w->share = sum / (double)c->now.count;
}

/* All walkers to their next events. */
static inline void walk_generation(struct walk_crowd *c)
{
    struct walk_path *p = &c->path;
    size_t kept = 0;
    walk_shift(p);
    for (size_t i = 0; i < c->now.count; i++) {
        if (walk_step(p, &c->now.item[i], i))
            c->now.item[kept++] = p->a;
        c->sum += p->seen;
    }
    c->now.count = kept;
    if (c->w->generation++ == 0)
        walk_set_share(c);
    walk_sort(c);
    walk_populate(c);
}

/* The mean over n paths of a batch. */
static inline double walk_batch(struct walk *w, const flat_scene *s, size_t n,
                                int batch)
{
    struct walk_crowd c = {.w = w, .path = {.w = w, .scene = s}};
    walk_room(&c.now, n);
    for (c.now.count = 0; c.now.count < n; c.now.count++)
        c.now.item[c.now.count] = walk_first(w, batch);
    c.path.a.batch = batch;
    w->generation = 0;
    while (c.now.count > 0)
        walk_generation(&c);
    assert_int_equal(c.path.counters.majorant_exceeded, 0);
    free(c.now.item);
    free(c.next.item);
    return c.sum / (double)n;
}

/* Powers of the root of x^(n+1) = x + 1: with i / count a lattice of any
 * length that fills n + 1 dimensions evenly [Roberts 2018]. */
static inline void walk_lattice(struct walk *w)
{
    const struct walk_plan *p = &w->map.plan;
    int n = 2 + (p->loss > 0.0) + 2 * (p->g != 0.0);
    double x = 1.5;
    for (int i = 0; i < 60; i++)
        x = pow(1.0 + x, 1.0 / (n + 1));
    for (int k = 0; k < WALK_NUMBERS; k++)
        w->step[k] = pow(1.0 / x, k + 1);
}

enum { BATCHES = 32 }; /* at most */

/* Estimates of one number, each by random numbers of its own. */
struct batches {
    int count, spp;
    uint32_t frame, stride; /* of the first; from each to the next           */
    double mean[BATCHES];
};

/* The means over n paths, like pictures'; frees the scene. */
static inline void truth_walk(brume_scene *s, const struct walk_plan *plan,
                              size_t n, bool on_gpu, struct batches *b)
{
    struct flat *f = truth_flat(s);
    struct walk w = {.map = *walk_map_of(plan),
                     .unit = f->unit,
                     .frame = b->frame,
                     .stride = b->stride};
    w.map.plan = *plan;
    walk_lattice(&w);
    /* About what one is worth after its first flight; the CPU finds it. */
    w.share = (1.0 - plan->loss) *
              walk_ahead(&w.map, plan->start, plan->cosine);
    for (int i = 0; !on_gpu && i < b->count; i++)
        b->mean[i] = walk_batch(&w, &f->view, n, i);
#ifdef BRUME_CUDA
    if (on_gpu)
        assert_true(walk_on_gpu(&w, f, n, b->count, b->mean, truth_error()));
#else
    assert_false(on_gpu);
#endif
    flat_free(f);
    brume_scene_free(s);
}

#endif
