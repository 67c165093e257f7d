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
 * - Paths are split, or ended at random, by their weight times an importance,
 *   which is diffusion theory's and decides the noise only. */
#ifndef TESTS_UNIT_TRUTH_WALK_H
#define TESTS_UNIT_TRUTH_WALK_H
#include <stdlib.h>
#include "tests/unit/truth.h"
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/path.h"
#include "core/prepare.h"

/* A slab from z = 0; or space around the origin. Attenuation is 1, a walker's
 * place its depth or distance, its cosine that to +z or to outward. */
enum walk_space { WALK_NOWHERE, WALK_SLAB, WALK_SPACE };

struct walk_plan {
    enum walk_space space;
    double start, cosine; /* of all walkers                               */
    double depth;         /* SLAB                                         */
    double target;        /* SLAB: 0 or the depth; SPACE: a distance      */
    double decay;         /* of importance, per length                    */
    double edge;          /* SLAB: where diffusion ends, beyond the faces */
    double g, loss;       /* of the phase function; 1 - albedo            */
    double wide;          /* share of directions that are drawn evenly    */
};

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

enum { WALK_TABLE = 4096, WALK_NUMBERS = 5 };

struct walk {
    const struct walk_plan *plan;
    const flat_scene *scene;
    struct walk_list now, next;
    double unit;  /* unit-space lengths per length                */
    double share; /* weight times importance of a usual walker    */
    uint32_t frame, generation;
    double step[WALK_NUMBERS], shift[WALK_NUMBERS]; /* of the lattice   */
    double reach, seen; /* the table's end, and importance beyond a slab
                               on the side of the target                    */
    double table[WALK_TABLE + 1];
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

/* ---- importance --------------------------------------------------------- */

/* Of a path at depth or distance x, up to a factor. */
static inline double walk_diffused(const struct walk_plan *p, double x)
{
    double k = p->decay;
    if (p->space == WALK_SLAB) {
        double from = p->edge + (p->target > 0.0 ? x : p->depth - x);
        return k * from < 1e-3 ? from : sinh(k * from) / k;
    }
    double r = p->target, a = fmin(x, r), b = fmax(fmax(x, r), 0.2);
    return (k * a < 1e-3 ? 1.0 : sinh(k * a) / (k * a)) * exp(-k * b) / b;
}

static inline void walk_tabulate(struct walk *w)
{
    const struct walk_plan *p = w->plan;
    bool slab = p->space == WALK_SLAB;
    w->reach = slab ? p->depth : fmin(60.0, p->target + 30.0);
    for (int i = 0; i <= WALK_TABLE; i++)
        w->table[i] = walk_diffused(p, w->reach * i / WALK_TABLE);
    if (slab)
        w->seen = walk_diffused(p, p->target > 0.0 ? p->depth + p->edge
                                                   : -p->edge);
}

static inline double walk_looked_up(const struct walk *w, double x)
{
    double y = fmin(fmax(x / w->reach, 0.0), 1.0) * WALK_TABLE;
    int i = y < WALK_TABLE ? (int)y : WALK_TABLE - 1;
    return w->table[i] + (y - i) * (w->table[i + 1] - w->table[i]);
}

/* Where directions are kept, that before a scattering counts too. */
static inline double walk_importance(const struct walk *w, double x,
                                     double cosine)
{
    double here = walk_looked_up(w, x), g = w->plan->g;
    if (g == 0.0)
        return here;
    double lo = fmax(x - 0.5, 0.0), hi = fmin(x + 0.5, w->reach);
    double slope = (walk_looked_up(w, hi) - walk_looked_up(w, lo)) / (hi - lo);
    double turned = g / (1.0 - (1.0 - w->plan->loss) * g);
    return fmax(here + slope * turned * cosine, 0.1 * here);
}

/* Place after a flight; false beyond a slab, with what is seen from there. */
static inline bool walk_reaches(const struct walk *w, double x, double cosine,
                                double t, double *place, double *seen)
{
    if (w->plan->space == WALK_SPACE) {
        *place = sqrt(x * x + 2.0 * x * cosine * t + t * t);
        return true;
    }
    *place = x + t * cosine;
    bool front = *place < 0.0;
    *seen = front == (w->plan->target == 0.0) ? w->seen : 0.0;
    return !front && *place <= w->reach;
}

/* What a flight from x will meet, by Laguerre's rule; in *length its mean
 * length, weighted by that. */
static inline double walk_ahead(const struct walk *w, double x, double cosine,
                                double *length)
{
    static const double node[5] = {0.263560319718, 1.413403059107,
                                   3.596425771041, 7.085810005859,
                                   12.640800844276};
    static const double weight[5] = {0.521755610583, 0.398666811083,
                                     0.0759424496817, 0.00361175867992,
                                     2.33699723858e-05};
    double sum = 0.0, first = 0.0, beyond = 0.0, place, seen = 0.0;
    for (int i = 0; i < 5; i++) {
        if (!walk_reaches(w, x, cosine, node[i], &place, &seen)) {
            beyond += weight[i] * seen;
            continue;
        }
        double value = weight[i] * walk_importance(w, place, cosine);
        sum += value;
        first += value * node[i];
    }
    *length = sum > 0.0 ? first / sum : 1.0;
    return sum + beyond;
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

/* Optical depth of the flight: an exponential law that leads to where it
 * matters, cut where it leaves a slab, but for one in twenty. */
static inline double walk_depth(struct walk *w, struct walker *a, size_t i)
{
    double u = walk_number(w, WALK_FLY, i), at = fmax((double)a->at, 0.0);
    double mu = (double)a->cosine, all = 1.0, end = INFINITY, plain = 0.0;
    double length, tau;
    walk_ahead(w, at, mu, &length);
    double rate = fmax(fmin(1.0 / length, 3.0), 0.1);
    if (w->plan->space == WALK_SLAB) {
        end = fmax(mu > 0.0 ? w->plan->depth - at : at, 1e-6) /
              fmax(fabs(mu), 1e-6);
        all = -expm1(-rate * end);
        plain = 0.05;
    }
    if (u < plain)
        tau = -log1p(-u / plain);
    else
        tau = -log1p(-(u - plain) / (1.0 - plain) * all) / rate;
    double density = tau <= end ? rate * exp(-rate * tau) / all : 0.0;
    a->weight *= exp(-tau) / (plain * exp(-tau) + (1.0 - plain) * density);
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
 * a boundary has what is left of its depth before it. */
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
    double left = walk_depth(w, a, i), choice = walk_choice(w, a, i);
    for (;;) {
        media_walk m;
        path_event event;
        walk_begin(s, &m, &p.inside, true, o, d, p.after.t, h.t);
        walk_words(&p.random, left, choice);
        int what = m.count ? path_track(s, &p, &m, &event) : PATH_THROUGH;
        if (what == PATH_SCATTERED) {
            walk_arrive(w, a, &p, &event);
            return true;
        }
        if (what == PATH_ENDED || h.shape < 0)
            return false;
        if (m.count)
            left = fmax(left - (double)(h.t - p.after.t) / w->unit, 0.0);
        shadow_cross(s, &h, &p.inside);
        p.after = h;
        h = bvh_nearest(s, &ray, &p.after, s->far);
    }
}

/* ---- directions --------------------------------------------------------- */

/* An even phase function forgets the old direction: the axis stands for it,
 * and those that lead on are drawn more often. */
static inline vec3 walk_turn_even(struct walk *w, struct walker *a, size_t i)
{
    const flat_medium *m = &w->scene->media[a->medium];
    double u = walk_number(w, WALK_TURN, i), at = (double)a->at, length;
    double on = walk_ahead(w, at, 1.0, &length);
    double back = walk_ahead(w, at, -1.0, &length);
    double k = fmax(fmin((on - back) / (on + back), 0.8), -0.8);
    if (fabs(k) > 1e-3) {
        double all = log1p(k) - log1p(-k);
        double mu = (1.0 - (1.0 + k) * exp(-all * u)) / k;
        a->weight *= 0.5 * (1.0 - k * mu) * all / k;
        u = 0.5 * (1.0 + mu);
    }
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
    double u = 0.5 * walk_number(w, WALK_TURN, i), all = 0.0, length;
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
                       walk_ahead(w, (double)a->at, (double)d[k].z, &length) +
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
    return a->weight * walk_importance(w, (double)a->at, (double)a->cosine);
}

/* Splits and ends: in order, so that neighbours stand in for each other. */
static inline void walk_populate(struct walk *w)
{
    rng r = rng_make(13, w->frame, w->generation, 0);
    double due = (double)rng_float(&r);
    for (size_t i = 0; i < w->now.count; i++) {
        struct walker a = w->now.item[i];
        double share = walk_worth(w, &a) / w->share, copies = 1.0;
        if (share < 0.5 || share > 3.0) {
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
    walk_tabulate(w);
    walk_lattice(w);
}

/* The mean over n paths, like a picture's; frees the scene. */
static inline double truth_walk(brume_scene *s, const struct walk_plan *plan,
                                size_t n, uint32_t frame)
{
    struct prepare job = {.scene = s, .threads = 1};
    struct flat *f = prepare_scene(&job, truth_error());
    assert_non_null(f);
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
