/* truth_step.h - a step of one of the paths that truth_walk.h follows together,
 * for the CPU and for a GPU (tests/gpu/walk.cu).
 *
 * What happens is the renderer's: what the straight line sees (march_line), the
 * flight (path_track), lamps (path_light), the new direction (phase_sample).
 * The random numbers that these get are this file's: of a lattice and, where
 * few paths would come to the target, of another density over all of a number's
 * interval, and the path carries the ratio of the two: longer flights toward
 * it, directions, less absorption. A step that makes the wrong thing of its
 * numbers is found out all the same. */
#ifndef TESTS_UNIT_TRUTH_STEP_H
#define TESTS_UNIT_TRUTH_STEP_H
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/path.h"
#include "tests/unit/truth_law.h"

enum { WALK_NUMBERS = 5 };

/* What all paths of some batches share. */
struct walk {
    struct walk_map map;
    double unit;               /* unit-space lengths per length             */
    double step[WALK_NUMBERS]; /* of the lattice                            */
    double share;              /* weight times importance of a usual walker */
    uint32_t frame, stride;    /* of the first batch, and from one to the
                                  next                                      */
    uint32_t pass;             /* of several for the same batches           */
    uint32_t generation;
};

/* A path between two flights. */
struct walker {
    double weight;
    float at, cosine;
    int32_t medium; /* where it scattered                                   */
    int32_t batch;
    uint32_t key;
};

/* One on its way. */
struct walk_path {
    const struct walk *w;
    const flat_scene *scene;
    struct walker a;
    uint64_t i;                 /* its place in its batch                   */
    double shift[WALK_NUMBERS]; /* of the lattice there                     */
    double seen;                /* what its line and the lamps brought      */
    track_counters counters;
};

/* ---- numbers ------------------------------------------------------------ */

enum { WALK_TURN, WALK_FLY, WALK_CHOOSE, WALK_AROUND, WALK_PICK };

/* For one of three uses in a generation: of path i, or of all of its batch. */
HD rng walk_random(const struct walk *w, int batch, int use, uint64_t i)
{
    return rng_make((uint64_t)use, w->frame + w->stride * (uint32_t)batch,
                    w->generation, i + ((uint64_t)w->pass << 32));
}

HD void walk_shift(struct walk_path *p)
{
    rng r = walk_random(p->w, p->a.batch, 7, UINT64_MAX);
    for (int k = 0; k < WALK_NUMBERS; k++)
        p->shift[k] = ((double)rng_u32(&r) + 0.5) * 0x1p-32;
}

/* Those that matter come first in the lattice. */
HD int walk_dimension(const struct walk *w, int number)
{
    int absorbs = w->map.plan.loss > 0.0;
    if (number <= WALK_FLY)
        return number;
    return number == WALK_CHOOSE ? (absorbs ? 2 : 4) : number - 1 + absorbs;
}

/* Uniform in (0, 1). */
HD double walk_number(const struct walk_path *p, int number)
{
    int k = walk_dimension(p->w, number);
    double x = p->shift[k] + (double)p->i * p->w->step[k];
    x -= floor(x);
    return fmin(fmax(x, 0x1p-33), 1.0 - 0x1p-33);
}

/* The random words of which a flight makes its depth tau and, after the depth
 * of the next, which stays as it was, its choice of an event. */
HD void walk_words(rng *r, double tau, double choice)
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

HD void walk_ray(const struct walk_path *p, vec3 *o, vec3 *d)
{
    float c = p->a.cosine;
    *o = vec3_make(0.0f, 0.0f, (float)((double)p->a.at * p->w->unit));
    *d = vec3_make(sqrtf((1.0f - c) * (1.0f + c)), 0.0f, c);
}

/* What the ray sees; far from the target, of one ray in eight. */
HD void walk_score(struct walk_path *p, const container_set *inside, vec3 o,
                   vec3 d, rng *r)
{
    bool far = fabs((double)p->a.at - p->w->map.plan.target) > 6.0;
    if (far && !rng_chance(r, 0.125f))
        return;
    march_result m = march_line(p->scene, inside, o, d,
                                line_jitter_make(0.5f, 0.5f));
    p->seen += (far ? 8.0 : 1.0) * p->a.weight * (double)m.radiance.r;
}

/* Optical depth of the flight: by what is due where it ends, but for one in
 * twenty. */
HD double walk_depth(struct walk_path *p)
{
    const double plain = 0.05;
    double u = walk_number(p, WALK_FLY), at = fmax((double)p->a.at, 0.0);
    struct walk_law law = walk_law_of(&p->w->map, at, (double)p->a.cosine);
    double tau = u < plain ? -log1p(-u / plain)
                           : walk_law_depth(&law, (u - plain) / (1.0 - plain));
    p->a.weight /= plain + (1.0 - plain) * walk_law_ratio(&law, tau);
    return tau;
}

/* The choice of an event: few are absorbed, which then weigh more. */
HD double walk_choice(struct walk_path *p)
{
    const double seldom = 0.1;
    double u = walk_number(p, WALK_CHOOSE), loss = p->w->map.plan.loss;
    double drawn = seldom * loss;
    if (u >= 1.0 - drawn) {
        p->a.weight /= seldom;
        return 1.0 - (1.0 - u) / seldom;
    }
    p->a.weight *= (1.0 - loss) / (1.0 - drawn);
    return u * (1.0 - loss) / (1.0 - drawn);
}

/* Where a path scattered. Nearer to a face floats of the container may put it
 * outside, where it would see what no path inside does. */
HD double walk_place(const struct walk_path *p, vec3 x)
{
    const struct walk_plan *plan = &p->w->map.plan;
    const double off = 1e-5;
    if (plan->space != WALK_SLAB)
        return (double)vec3_length(x) / p->w->unit;
    return fmax(fmin((double)x.z / p->w->unit, plan->depth - off), off);
}

/* Lamps, and what goes on, at a scattering. */
HD void walk_arrive(struct walk_path *p, path_state *s, const path_event *event)
{
    path_vertex v;
    v.p = vec3_mad(s->o, event->t, s->d);
    v.d = s->d;
    v.medium = &p->scene->media[event->medium];
    v.on_surface = false;
    v.surface = NULL;
    v.event = event;
    path_light(p->scene, s, &v);
    p->seen += p->a.weight * (double)s->radiance.r;
    p->a.weight *= (double)rgb_mean(s->beta) / (double)rgb_mean(s->r_u);
    p->a.at = (float)walk_place(p, v.p);
    p->a.medium = event->medium;
}

/* To the next scattering; false if there is none. A flight that goes on behind
 * a boundary takes its choice from the same words. */
HD bool walk_fly(struct walk_path *p)
{
    const flat_scene *scene = p->scene;
    rng r = walk_random(p->w, p->a.batch, 11, p->i);
    container_set inside;
    path_state s;
    vec3 o, d;
    walk_ray(p, &o, &d);
    inside_find(scene, o, &inside);
    walk_score(p, &inside, o, d, &r);
    path_begin(&s, o, d, &inside, true, r);
    s.count = &p->counters;
    s.boost = 1.0f;
    bvh_ray ray = bvh_ray_make(o, d);
    ray_hit h = bvh_nearest(scene, &ray, &s.after, scene->far);
    double depth = walk_depth(p);
    walk_words(&s.random, depth, walk_choice(p));
    for (;;) {
        track_line m;
        path_event event;
        walk_begin(scene, &m.walk, &s.inside, true, o, d, s.after.t, h.t);
        int what = m.walk.count ? path_track(scene, &s, &m, &event)
                                : PATH_THROUGH;
        if (what == PATH_SCATTERED) {
            walk_arrive(p, &s, &event);
            return true;
        }
        if (what == PATH_ENDED || h.shape < 0)
            return false;
        shadow_cross(scene, &h, &s.inside);
        s.after = h;
        h = bvh_nearest(scene, &ray, &s.after, scene->far);
    }
}

/* ---- directions --------------------------------------------------------- */

/* An even phase function forgets the old direction: the axis stands for it,
 * and parts of the cosine are drawn by what lies ahead in their middle. */
HD vec3 walk_turn_even(struct walk_path *p)
{
    const struct walk_map *map = &p->w->map;
    const flat_medium *m = &p->scene->media[p->a.medium];
    double u = walk_number(p, WALK_TURN), part[WALK_ANGLES], all = 0.0;
    for (int k = 0; k < WALK_ANGLES; k++) {
        part[k] = walk_ahead_in(map, (double)p->a.at, k);
        all += part[k];
    }
    double left = u * all;
    int k = 0;
    while (k < WALK_ANGLES - 1 && left >= part[k])
        left -= part[k++];
    p->a.weight *= all / (WALK_ANGLES * part[k]);
    u = (k + fmin(left / part[k], 1.0)) / WALK_ANGLES;
    float pdf;
    return phase_sample(m->phase, m->g, vec3_make(0, 0, 1), (float)u,
                        (float)walk_number(p, WALK_AROUND), &pdf);
}

/* Henyey and Greenstein's: some directions are drawn evenly, so that wide
 * angles come more often. */
HD double walk_turn_wide(const struct walk_plan *p, double u, double *weight)
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

/* Of some directions that are as likely, one that leads on more often: more of
 * them where few that are likely do. */
HD vec3 walk_turn_peaked(struct walk_path *p)
{
    enum { MOST = 16 };
    const struct walk_map *map = &p->w->map;
    const flat_medium *m = &p->scene->media[p->a.medium];
    int parts = map->plan.g > 0.7 ? 8 : 4, ways = 2 * parts, k = -1;
    double u = walk_number(p, WALK_TURN) / parts, all = 0.0;
    double v = 0.5 * walk_number(p, WALK_AROUND), value[MOST], weight[MOST];
    vec3 o, old, d[MOST];
    float pdf;
    walk_ray(p, &o, &old);
    for (int i = 0; i < ways; i++) {
        int part = i / 2;
        double x = (part % 2 ? 1.0 / parts - u : u) + (double)part / parts;
        weight[i] = p->a.weight;
        x = walk_turn_wide(&map->plan, x, &weight[i]);
        d[i] = phase_sample(m->phase, m->g, old, (float)x,
                            (float)(v + 0.5 * (i % 2)), &pdf);
        value[i] = weight[i] *
                       walk_ahead(map, (double)p->a.at, (double)d[i].z) +
                   1e-300;
        all += value[i];
    }
    double left = walk_number(p, WALK_PICK), chance;
    do {
        k++;
        chance = 0.05 / ways + 0.95 * value[k] / all;
        left -= chance;
    } while (k < ways - 1 && left >= 0.0);
    p->a.weight = weight[k] / (ways * chance);
    return d[k];
}

HD void walk_turn(struct walk_path *p)
{
    vec3 d = p->w->map.plan.g == 0.0 ? walk_turn_even(p) : walk_turn_peaked(p);
    p->a.cosine = hd_max(hd_min(d.z, 1.0f), -1.0f);
}

/* ---- a step ------------------------------------------------------------- */

HD struct walker walk_first(const struct walk *w, int batch)
{
    struct walker a;
    a.weight = 1.0;
    a.at = (float)w->map.plan.start;
    a.cosine = (float)w->map.plan.cosine;
    a.medium = 0;
    a.batch = batch;
    a.key = 0;
    return a;
}

/* Turns and flies, `a` being the i-th of its batch; false if that was its last
 * flight. Its counts are added up in `p`. */
HD bool walk_step(struct walk_path *p, const struct walker *a, uint64_t i)
{
    p->a = *a;
    p->i = i;
    p->seen = 0.0;
    if (p->w->generation > 0)
        walk_turn(p);
    return walk_fly(p);
}

HD double walk_worth(const struct walk *w, const struct walker *a)
{
    return a->weight * walk_due(&w->map, (double)a->at, (double)a->cosine);
}

/* In an order of places, x in [0, 1], of `count` walkers: where directions are
 * kept by them within layers, to and fro. 16 bits. */
HD uint32_t walk_key(const struct walk *w, const struct walker *a, double x,
                     double count)
{
    if (w->map.plan.g == 0.0)
        return (uint32_t)(x * 65535.0);
    double layers = fmin(ceil(sqrt(count)), 255.0);
    uint32_t layer = (uint32_t)(x * layers);
    uint32_t y = (uint32_t)(127.5 * (1.0 + (double)a->cosine));
    return layer << 8 | (layer & 1u ? 255u - y : y);
}

/* Walkers that stand for less of a usual one are ended at random: what was
 * found to leave the least noise for the time. */
HD double walk_least(const struct walk_plan *p)
{
    if (p->space == WALK_SPACE)
        return 0.25;
    return p->target > 0.0 ? 0.1 : 0.4;
}

/* How many usual walkers one stands for; false if it is left as it is. */
HD bool walk_is_split(const struct walk *w, const struct walker *a,
                      double *share)
{
    double least = walk_least(&w->map.plan);
    *share = walk_worth(w, a) / w->share;
    if (*share >= least && *share <= 3.0)
        return false;
    *share /= *share < least ? 2.0 * least : 1.0;
    return true;
}

#endif
