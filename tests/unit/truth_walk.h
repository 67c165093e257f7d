/* truth_walk.h - many paths together through a scene with a symmetry, for
 * truths that would take a picture too long.
 *
 * Each step is the renderer's: what the straight line sees (march_line), the
 * flight (path_track), lamps (path_light), the new direction (phase_sample).
 * The random numbers that these get, and how many paths go on, are this
 * file's:
 * - Paths of as many events are sorted by where they are, and take their
 *   numbers from one lattice: what befalls neighbours differs, and the mean
 *   over them has little noise [array-RQMC: L'Ecuyer, Lecot, Tuffin 2008].
 * - Where few paths would come to the target, a number is drawn from another
 *   density over all of its interval, and the path carries the ratio of the
 *   two: longer flights toward it, directions, less absorption. A step that
 *   makes the wrong thing of its numbers is found out all the same.
 * - Paths are split, or ended at random, by their weight times what is still
 *   due (truth_importance.h), which decides the noise only. */
#ifndef TESTS_UNIT_TRUTH_WALK_H
#define TESTS_UNIT_TRUTH_WALK_H
#include <stdlib.h>
#include "tests/unit/truth_flat.h"
#include "tests/unit/truth_importance.h"
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/path.h"

struct walker {
    double weight;
    float at, cosine;
    int32_t medium; /* where it scattered                           */
    uint32_t key;
};

struct walk_list {
    struct walker *item;
    size_t count, room;
};

enum { WALK_NUMBERS = 5 };

struct walk {
    const struct walk_plan *plan;
    const struct walk_map *map;
    const flat_scene *scene;
    struct walk_list now, next;
    double unit;  /* unit-space lengths per length                */
    double share; /* weight times importance of a usual walker    */
    uint32_t frame, generation;
    double step[WALK_NUMBERS], shift[WALK_NUMBERS]; /* of the lattice   */
    double sum;
    track_counters counters;
};

/* ---- numbers ------------------------------------------------------------ */

enum { WALK_TURN, WALK_FLY, WALK_CHOOSE, WALK_AROUND, WALK_PICK };

/* Those that matter come first in the lattice. */
static inline int walk_place(const struct walk *w, int number)
{
    int absorbs = w->plan->loss > 0.0;
    if (number <= WALK_FLY)
        return number;
    return number == WALK_CHOOSE ? (absorbs ? 2 : 4) : number - 1 + absorbs;
}

/* Powers of the root of x^(n+1) = x + 1: with i / count a lattice of any
 * length that fills n + 1 dimensions evenly [Roberts 2018]. */
static inline void walk_lattice(struct walk *w)
{
    const struct walk_plan *p = w->plan;
    int n = 2 + (p->loss > 0.0) + 2 * (p->g != 0.0);
    double x = 1.5;
    for (int i = 0; i < 60; i++)
        x = pow(1.0 + x, 1.0 / (n + 1));
    for (int k = 0; k < WALK_NUMBERS; k++)
        w->step[k] = pow(1.0 / x, k + 1);
}

static inline void walk_shift(struct walk *w)
{
    rng r = rng_make(7, w->frame, w->generation, UINT64_MAX);
    for (int k = 0; k < WALK_NUMBERS; k++)
        w->shift[k] = ((double)rng_u32(&r) + 0.5) * 0x1p-32;
}

/* Uniform in (0, 1). */
static inline double walk_number(const struct walk *w, int number, size_t i)
{
    int k = walk_place(w, number);
    double x = w->shift[k] + (double)i * w->step[k];
    x -= floor(x);
    return fmin(fmax(x, 0x1p-33), 1.0 - 0x1p-33);
}

/* The random words of which a flight makes its depth tau and, after the depth
 * of the next, which stays as it was, its choice of an event. */
static inline void walk_words(rng *r, double tau, double choice)
{
    double left = exp(-tau);
    uint64_t x = left < 0.5 ? ~(uint64_t)(left * 0x1p64)
                            : (uint64_t)(-expm1(-tau) * 0x1p64);
    uint32_t high = (uint32_t)(x >> 32);
    r->word[0] = r->word[1] = high;
    if (rng_depth_is_end(high))
        r->word[1] = (uint32_t)x;
    r->word[3] = (uint32_t)(choice * 0x1p32);
    r->used = rng_depth_is_end(high) ? 0 : 1;
}

/* ---- flights ------------------------------------------------------------ */

static inline void walk_ray(const struct walk *w, const struct walker *a,
                            vec3 *o, vec3 *d)
{
    *o = vec3_make(0.0f, 0.0f, (float)((double)a->at * w->unit));
    *d = vec3_make(sqrtf((1.0f - a->cosine) * (1.0f + a->cosine)), 0.0f,
                   a->cosine);
}

/* What the ray sees; far from the target, of one ray in eight. */
static inline void walk_score(struct walk *w, const struct walker *a,
                              const container_set *inside, vec3 o, vec3 d,
                              rng *r)
{
    bool far = fabs((double)a->at - w->plan->target) > 6.0;
    if (far && !rng_chance(r, 0.125f))
        return;
    march_result m = march_line(w->scene, inside, o, d,
                                line_jitter_make(0.5f, 0.5f));
    w->sum += (far ? 8.0 : 1.0) * a->weight * (double)m.radiance.r;
}

/* Optical depth of the flight: by what is due where it ends, but for one in
 * twenty. */
static inline double walk_depth(struct walk *w, struct walker *a, size_t i)
{
    const double plain = 0.05;
    double u = walk_number(w, WALK_FLY, i), at = fmax((double)a->at, 0.0);
    struct walk_law law = walk_law_of(w->map, at, (double)a->cosine);
    double tau = u < plain ? -log1p(-u / plain)
                           : walk_law_depth(&law, (u - plain) / (1.0 - plain));
    a->weight /= plain + (1.0 - plain) * walk_law_ratio(&law, tau);
    return tau;
}

/* The choice of an event: few are absorbed, which then weigh more. */
static inline double walk_choice(struct walk *w, struct walker *a, size_t i)
{
    const double seldom = 0.1;
    double u = walk_number(w, WALK_CHOOSE, i), loss = w->plan->loss;
    double drawn = seldom * loss;
    if (u >= 1.0 - drawn) {
        a->weight /= seldom;
        return 1.0 - (1.0 - u) / seldom;
    }
    a->weight *= (1.0 - loss) / (1.0 - drawn);
    return u * (1.0 - loss) / (1.0 - drawn);
}

/* Lamps, and what goes on, at a scattering. */
static inline void walk_arrive(struct walk *w, struct walker *a, path_state *p,
                               const path_event *event)
{
    path_vertex v;
    v.p = vec3_mad(p->o, event->t, p->d);
    v.d = p->d;
    v.medium = &w->scene->media[event->medium];
    v.on_surface = false;
    v.surface = NULL;
    v.event = event;
    path_light(w->scene, p, &v);
    w->sum += a->weight * (double)p->radiance.r;
    a->weight *= (double)rgb_mean(p->beta) / (double)rgb_mean(p->r_u);
    double at = w->plan->space == WALK_SLAB ? (double)v.p.z
                                            : (double)vec3_length(v.p);
    a->at = (float)(at / w->unit);
    a->medium = event->medium;
}

/* To the next scattering; false if there is none. A flight that goes on behind
 * a boundary takes its choice from the same words. */
static inline bool walk_fly(struct walk *w, struct walker *a, size_t i)
{
    const flat_scene *s = w->scene;
    rng r = rng_make(11, w->frame, w->generation, i);
    container_set inside;
    path_state p;
    vec3 o, d;
    walk_ray(w, a, &o, &d);
    inside_find(s, o, &inside);
    walk_score(w, a, &inside, o, d, &r);
    path_begin(&p, o, d, &inside, true, r);
    p.count = &w->counters;
    p.boost = 1.0f;
    bvh_ray ray = bvh_ray_make(o, d);
    ray_hit h = bvh_nearest(s, &ray, &p.after, s->far);
    double depth = walk_depth(w, a, i);
    walk_words(&p.random, depth, walk_choice(w, a, i));
    for (;;) {
        track_line m;
        path_event event;
        walk_begin(s, &m.walk, &p.inside, true, o, d, p.after.t, h.t);
        int what = m.walk.count ? path_track(s, &p, &m, &event) : PATH_THROUGH;
        if (what == PATH_SCATTERED) {
            walk_arrive(w, a, &p, &event);
            return true;
        }
        if (what == PATH_ENDED || h.shape < 0)
            return false;
        shadow_cross(s, &h, &p.inside);
        p.after = h;
        h = bvh_nearest(s, &ray, &p.after, s->far);
    }
}

/* ---- directions --------------------------------------------------------- */

/* An even phase function forgets the old direction: the axis stands for it,
 * and parts of the cosine are drawn by what lies ahead in their middle. */
static inline vec3 walk_turn_even(struct walk *w, struct walker *a, size_t i)
{
    const flat_medium *m = &w->scene->media[a->medium];
    double u = walk_number(w, WALK_TURN, i), part[WALK_ANGLES], all = 0.0;
    for (int k = 0; k < WALK_ANGLES; k++) {
        part[k] = walk_ahead(w->map, (double)a->at, walk_cosine(k));
        all += part[k];
    }
    double left = u * all;
    int k = 0;
    while (k < WALK_ANGLES - 1 && left >= part[k])
        left -= part[k++];
    a->weight *= all / (WALK_ANGLES * part[k]);
    u = (k + fmin(left / part[k], 1.0)) / WALK_ANGLES;
    float pdf;
    return phase_sample(m->phase, m->g, vec3_make(0, 0, 1), (float)u,
                        (float)walk_number(w, WALK_AROUND, i), &pdf);
}

/* Henyey and Greenstein's: some directions are drawn evenly, so that wide
 * angles come more often. */
static inline double walk_turn_wide(const struct walk_plan *p, double u,
                                    double *weight)
{
    double g = p->g, wide = p->wide, root;
    if (!(wide > 0.0))
        return u;
    double back = 1.0 / (1.0 + g), k = (1.0 - g * g) / (2.0 * g);
    if (u >= wide) {
        u = (u - wide) / (1.0 - wide);
        root = 1.0 / (u / k + back);
    } else {
        root = sqrt(1.0 + g * g - 2.0 * g * (2.0 * u / wide - 1.0));
        u = k * (1.0 / root - back);
    }
    double density = k * g / (root * root * root); /* of the cosine */
    *weight /= 1.0 - wide + wide * 0.5 / density;
    return u;
}

/* Of four directions that are as likely, one that leads on more often. */
static inline vec3 walk_turn_peaked(struct walk *w, struct walker *a, size_t i)
{
    const flat_medium *m = &w->scene->media[a->medium];
    double u = 0.5 * walk_number(w, WALK_TURN, i), all = 0.0;
    double v = 0.5 * walk_number(w, WALK_AROUND, i), value[4], weight[4];
    vec3 o, old, d[4];
    float pdf;
    walk_ray(w, a, &o, &old);
    for (int k = 0; k < 4; k++) {
        weight[k] = a->weight;
        double x = walk_turn_wide(w->plan, k < 2 ? u : 1.0 - u, &weight[k]);
        d[k] = phase_sample(m->phase, m->g, old, (float)x,
                            (float)(v + 0.5 * (k % 2)), &pdf);
        value[k] = weight[k] *
                       walk_ahead(w->map, (double)a->at, (double)d[k].z) +
                   1e-300;
        all += value[k];
    }
    double left = walk_number(w, WALK_PICK, i), chance;
    int k = -1;
    do {
        k++;
        chance = 0.0125 + 0.95 * value[k] / all;
        left -= chance;
    } while (k < 3 && left >= 0.0);
    a->weight = weight[k] * 0.25 / chance;
    return d[k];
}

static inline void walk_turn(struct walk *w, struct walker *a, size_t i)
{
    vec3 d = w->plan->g == 0.0 ? walk_turn_even(w, a, i)
                               : walk_turn_peaked(w, a, i);
    a->cosine = hd_max(hd_min(d.z, 1.0f), -1.0f);
}

/* ---- populations -------------------------------------------------------- */

static inline void walk_room(struct walk_list *l, size_t count)
{
    if (count <= l->room)
        return;
    l->room = 2 * count;
    l->item = realloc(l->item, l->room * sizeof *l->item);
    assert_non_null(l->item);
}

/* `next` becomes `now`. */
static inline void walk_swap(struct walk *w)
{
    struct walk_list l = w->now;
    w->now = w->next;
    w->next = l;
    w->next.count = 0;
}

static inline void walk_sort_by(struct walk *w, int shift)
{
    size_t first[257] = {0};
    walk_room(&w->next, w->now.count);
    for (size_t i = 0; i < w->now.count; i++)
        first[(w->now.item[i].key >> shift & 255u) + 1]++;
    for (int i = 0; i < 256; i++)
        first[i + 1] += first[i];
    for (size_t i = 0; i < w->now.count; i++) {
        const struct walker *a = &w->now.item[i];
        w->next.item[first[a->key >> shift & 255u]++] = *a;
    }
    w->next.count = w->now.count;
    walk_swap(w);
}

/* By place, x in [0, 1]; where directions are kept, by them within layers, to
 * and fro. */
static inline uint32_t walk_key(const struct walk *w, const struct walker *a,
                                double x)
{
    if (w->plan->g == 0.0)
        return (uint32_t)(x * 65535.0);
    double layers = fmin(ceil(sqrt((double)w->now.count)), 255.0);
    uint32_t layer = (uint32_t)(x * layers);
    uint32_t y = (uint32_t)(127.5 * (1.0 + (double)a->cosine));
    return layer << 8 | (layer & 1u ? 255u - y : y);
}

static inline void walk_sort(struct walk *w)
{
    float lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i < w->now.count; i++) {
        lo = fminf(lo, w->now.item[i].at);
        hi = fmaxf(hi, w->now.item[i].at);
    }
    double width = fmax((double)(hi - lo), 1e-9);
    for (size_t i = 0; i < w->now.count; i++) {
        struct walker *a = &w->now.item[i];
        a->key = walk_key(w, a, fmin((double)(a->at - lo) / width, 1.0));
    }
    walk_sort_by(w, 0);
    walk_sort_by(w, 8);
}

static inline double walk_worth(const struct walk *w, const struct walker *a)
{
    return a->weight * walk_due(w->map, (double)a->at, (double)a->cosine);
}

/* Splits and ends: in order, so that neighbours stand in for each other. */
static inline void walk_populate(struct walk *w)
{
    rng r = rng_make(13, w->frame, w->generation, 0);
    double due = (double)rng_float(&r);
    double least = w->plan->space == WALK_SLAB ? 0.1 : 0.5;
    for (size_t i = 0; i < w->now.count; i++) {
        struct walker a = w->now.item[i];
        double share = walk_worth(w, &a) / w->share, copies = 1.0;
        bool light = share < least;
        if (light || share > 3.0) {
            share /= light ? 2.0 * least : 1.0;
            due += share;
            copies = floor(due);
            due -= copies;
            a.weight /= share;
        }
        for (; copies > 0.0; copies -= 1.0) {
            walk_room(&w->next, w->next.count + 1);
            w->next.item[w->next.count++] = a;
        }
    }
    walk_swap(w);
}

/* What a walker is worth after its first flight is what one is worth. */
static inline void walk_set_share(struct walk *w)
{
    double sum = 0.0;
    for (size_t i = 0; i < w->now.count; i++)
        sum += walk_worth(w, &w->now.item[i]);
    w->share = sum / (double)w->now.count;
}

/* All walkers to their next events. */
static inline void walk_generation(struct walk *w)
{
    size_t kept = 0;
    walk_shift(w);
    for (size_t i = 0; i < w->now.count; i++) {
        struct walker a = w->now.item[i];
        if (w->generation > 0)
            walk_turn(w, &a, i);
        if (walk_fly(w, &a, i))
            w->now.item[kept++] = a;
    }
    w->now.count = kept;
    if (w->generation++ == 0)
        walk_set_share(w);
    walk_sort(w);
    walk_populate(w);
}

static inline void walk_start(struct walk *w, size_t n)
{
    struct walker first = {.weight = 1.0,
                           .at = (float)w->plan->start,
                           .cosine = (float)w->plan->cosine};
    walk_room(&w->now, n);
    for (size_t i = 0; i < n; i++)
        w->now.item[i] = first;
    w->now.count = n;
    w->map = walk_map_of(w->plan);
    walk_lattice(w);
}

/* The mean over n paths, like a picture's; frees the scene. */
static inline double truth_walk(brume_scene *s, const struct walk_plan *plan,
                                size_t n, uint32_t frame)
{
    struct flat *f = truth_flat(s);
    struct walk w = {
        .plan = plan, .scene = &f->view, .unit = f->unit, .frame = frame};
    walk_start(&w, n);
    while (w.now.count > 0)
        walk_generation(&w);
    assert_int_equal(w.counters.majorant_exceeded, 0);
    free(w.now.item);
    free(w.next.item);
    flat_free(f);
    brume_scene_free(s);
    return w.sum / (double)n;
}

#endif
