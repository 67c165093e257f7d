/* photon_lone.h - photons where one gray medium, alike everywhere, fills one
 * ball or box, and there is nothing else: the physics of photon.h, to the bit,
 * with so little state that a GPU keeps it in registers.
 *
 * The container is convex. So a flight between two points deep inside of it
 * meets no surface, and none is sought; and behind its far side there is
 * nothing. What becomes of a flight is known before any of it is laid. */
#ifndef CORE_PHYSICS_PHOTON_LONE_H
#define CORE_PHYSICS_PHOTON_LONE_H
#include "core/physics/lone_stream.h"
#include "core/physics/photon.h"

/* What is next of a photon. */
enum { LONE_FLIES, LONE_SEEKS, LONE_LAYS, LONE_LANDS, LONE_ENDS };

/* How a flight ends, beside PATH_*: out of the container, into it by rounding
 * alone, or behind all surfaces. */
enum { LONE_LEAVES = PATH_ENDED + 1, LONE_ENTERS, LONE_ESCAPES };

/* What is so of a photon: no roulette is due; its weight has changed, since the
 * flight began; the flight begins inside, whatever the rounding, or behind the
 * first root of the container, or behind the second; flights are laid, as
 * photon_state has it; this is the first one of a light's photon; its end has
 * been sought; the depth to the next tentative collision has been drawn. */
enum { LONE_LASTS = 1, LONE_CHANGED = 2, LONE_SURE = 4, LONE_BEHIND_FIRST = 8,
       LONE_BEHIND_LAST = 16, LONE_STORED = 32, LONE_ARRIVES = 64,
       LONE_SOUGHT = 128, LONE_DRAWN = 256,
       LONE_BEHIND = LONE_BEHIND_FIRST | LONE_BEHIND_LAST };

/* What each flight asks for. */
typedef struct {
    vec3 o, d;
    rgb lays;               /* beta over r_u, as it is                     */
    int32_t marks;
    float laid;             /* where the flight begins                     */
    lone_stream numbers;
} lone_photon;

/* What few flights do, or seldom. */
typedef struct {
    rgb beta;               /* without MAY_TINTS its channels are alike    */
    float r_u;              /* of each channel                             */
    float power;            /* beta over r_u, mean over the channels, as it
                               was when the flight began                   */
    int32_t light;          /* whose first flight this is, and what        */
    float nominal;          /* photon_state has of that                    */
    vec3 from;
    uint32_t events;
    uint32_t path[2];       /* of its numbers                              */
    float t, tau;           /* with LONE_DRAWN: how far it is, the depth   */
    float end;              /* with LONE_SOUGHT: of the flight             */
    int32_t ends;           /* what is there                               */
} lone_rest;

/* Of what the books tell. */
#define LONE_BOOKS(X) X(units) X(media) X(roulette) X(dropped) X(escaped)

/* What is counted. */
typedef struct {
    track_count rays, lookups, events, clipped;
#define X(name) photon_sum name;
    LONE_BOOKS(X)
#undef X
} lone_counts;

/* How a flight has ended. */
typedef struct {
    float t;
    int32_t event;          /* PATH_* or LONE_*                            */
} lone_end;

/* ---- what a photon carries --------------------------------------------- */

HD rgb lone_beta(rgb beta)
{
    return scene_may(MAY_TINTS) ? beta : rgb_gray(beta.r);
}

HD float lone_power(const lone_rest *w)
{
    return rgb_mean(lone_beta(w->beta)) / rgb_mean(rgb_gray(w->r_u));
}

/* What roulette goes by. */
HD float lone_throughput(const lone_rest *w)
{
    return rgb_size(lone_beta(w->beta)) / rgb_mean(rgb_gray(w->r_u));
}

HD void lone_mark(lone_photon *p, int32_t marks, bool on)
{
    p->marks = on ? p->marks | marks : p->marks & ~marks;
}

HD rgb lone_lays_of(const lone_rest *w)
{
    return rgb_scale(lone_beta(w->beta), 1.0f / rgb_mean(rgb_gray(w->r_u)));
}

/* What photons take over of the weight. */
typedef struct {
    rgb lays;
    int32_t lasts;
} lone_carries;

HD_APART lone_carries lone_carries_of(const lone_rest *w)
{
    lone_carries out;
    out.lays = lone_lays_of(w);
    out.lasts = lone_throughput(w) * PATH_KEEPS >= 1.0f ? LONE_LASTS : 0;
    return out;
}

HD void lone_renew(lone_photon *p, const lone_rest *w)
{
    lone_carries now = lone_carries_of(w);
    p->lays = now.lays;
    p->marks = (p->marks & ~(LONE_CHANGED | LONE_LASTS)) | now.lasts;
}

/* As photon_power has it. */
HD double lone_told(const lone_rest *w)
{
    double power = (double)w->power;
    return w->light >= 0 ? power * (double)w->nominal : power;
}

/* ---- where it is ------------------------------------------------------- */

/* A row of a map, as it comes: lone_scene.deep has room for its rounding. */
HD float lone_row(const float *m, vec3 p)
{
#ifdef __CUDA_ARCH__
    return fmaf(m[0], p.x, fmaf(m[1], p.y, fmaf(m[2], p.z, m[3])));
#else
    return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
#endif
}

HD bool lone_is_deep(const lone_scene *l, vec3 p)
{
    const float *m = l->to_local.m;
    vec3 q = vec3_make(lone_row(m, p), lone_row(m + 4, p), lone_row(m + 8, p));
    if (l->ball)
        return vec3_dot(q, q) < l->deep * l->deep;
    return hd_max(hd_max(fabsf(q.x), fabsf(q.y)), fabsf(q.z)) < l->deep;
}

/* A flight begins at `laid`. */
HD void lone_take_off(lone_photon *p, track_count *rays)
{
    lone_mark(p, LONE_SOUGHT | LONE_DRAWN, false);
    (*rays)++;
}

/* What is left of a photon that came into the container. */
HD void lone_from(const lone_scene *l, const photon_state *from,
                  lone_photon *p, lone_rest *w)
{
    const path_state *a = &from->path;
    bool entered = a->after.shape >= 0;
    float far = hd_max(fabsf(a->o.x), hd_max(fabsf(a->o.y), fabsf(a->o.z)));
    p->o = a->o;
    p->d = a->d;
    p->marks = 0;
    lone_mark(p, LONE_STORED, from->stored);
    lone_mark(p, LONE_ARRIVES, from->light >= 0);
    lone_mark(p, a->after.root == 0 ? LONE_BEHIND_FIRST : LONE_BEHIND_LAST,
              entered);
    lone_mark(p, LONE_SURE, entered ? hd_max(far, a->after.t) < LONE_NEAR
                                    : lone_is_deep(l, a->o));
    w->beta = a->beta;
    w->r_u = a->r_u.r;
    w->light = from->light;
    w->nominal = from->nominal;
    w->from = from->from;
    w->power = lone_power(w);
    lone_renew(p, w);
    w->events = from->events;
    w->path[0] = a->random.counter[0];
    w->path[1] = a->random.counter[1];
    w->t = w->tau = w->end = 0.0f;
    w->ends = LONE_ESCAPES;
    p->laid = a->after.t;
    lone_set_random(&p->numbers, &a->random);
}

/* Roots of the container along a line, in order; false: it has none. */
HD bool lone_roots(const lone_scene *l, vec3 from, vec3 along, float *root)
{
    int surface[SHAPE_MAX_ROOTS];
    vec3 o = affine_point(&l->to_local, from);
    vec3 d = affine_vector(&l->to_local, along);
    return (l->ball ? shape_sphere_roots(o, d, root)
                    : shape_box_roots(o, d, root, surface)) > 0;
}

/* Comes to the container, from outside, by the way of all scenes; false: it
 * has ended. */
HD_APART bool lone_come(const flat_scene *s, photon_state *g,
                        photon_counters *c)
{
    photon_flight f;
    f.event = PATH_THROUGH;
    while (container_count(&g->path.inside) == 0) {
        photon_take_off(s, g, c, &f);
        photon_seek(s, g, &f);
        photon_passes(s, g, c, &f);
        while (f.lays)
            photon_lay(s, g, c, &f);
        g->events++;
        if (f.hit.shape < 0) {
            photon_end(g, &c->books.escaped);
            return false;
        }
        shadow_cross(s, &f.hit, &g->path.inside);
        g->path.after = f.hit;
    }
    return true;
}

/* The same, for photons that lay nothing there and come in at the first root
 * alone. */
HD bool lone_comes(const flat_scene *s, const lone_scene *l, photon_state *g,
                   photon_counters *c)
{
    float root[SHAPE_MAX_ROOTS];
    path_state *a = &g->path;
    if (container_count(&a->inside) > 0)
        return true;
    if (!g->stored && a->after.shape < 0 &&
        lone_roots(l, a->o, a->d, root) && root[0] > 0.0f &&
        root[0] < s->far) {
        c->track.rays++;
        g->events++;
        a->after.shape = a->after.root = 0;
        a->after.t = root[0];
        return true;
    }
    HD_COPY(photon_state, g);
    HD_COPY(photon_counters, c);
    bool comes = lone_come(s, HD_COPIED(g), HD_COPIED(c));
    HD_RETURN(g);
    HD_RETURN(c);
    return comes;
}

/* A photon from its birth to the container; false: it has ended. */
HD bool lone_begin(const flat_scene *s, const lone_scene *l,
                   const photon_job *job, uint64_t photon, lone_photon *p,
                   lone_rest *w, photon_counters *c)
{
    photon_state g;
    if (!photon_begin(s, job, photon, &g, c) || !lone_comes(s, l, &g, c))
        return false;
    lone_from(l, &g, p, w);
    lone_take_off(p, &c->track.rays);
    return true;
}

/* ---- flights ----------------------------------------------------------- */

/* Seeks the end of the flight, as bvh_nearest does: the first root behind the
 * one at which it began. Where rounding has put its beginning behind all of
 * them, it meets no medium. */
HD void lone_seek(const flat_scene *s, const lone_scene *l, lone_photon *p,
                  lone_rest *w)
{
    float root[SHAPE_MAX_ROOTS];
    bool meets = lone_roots(l, p->o, p->d, root);
    p->marks |= LONE_SOUGHT;
    w->end = s->far;
    w->ends = LONE_ESCAPES;
    for (int i = 1; i >= 0; i--) {
        if (!meets || !(root[i] < s->far))
            continue;
        bool behind = root[i] > p->laid ||
                      (root[i] == p->laid && i == 1 &&
                       (p->marks & LONE_BEHIND_FIRST));
        if (!behind)
            continue;
        w->end = root[i];
        w->ends = i == 1 ? LONE_LEAVES : LONE_ENTERS;
    }
}

/* The flight comes to the end that was sought. */
HD int lone_passes(const lone_rest *w, lone_end *f)
{
    f->t = w->end;
    f->event = w->ends;
    return LONE_LAYS;
}

/* What a collision changes weights by. */
HD void lone_scale(lone_photon *p, lone_rest *w, float beta, float r_u)
{
    w->beta = rgb_scale(lone_beta(w->beta), beta);
    w->r_u *= r_u;
    p->marks |= LONE_CHANGED;
}

/* A tentative collision at t: the event, or on. What is laid of a flight is not
 * changed by its end. */
HD int lone_collide(const lone_scene *l, lone_photon *p, lone_rest *w,
                    const lone_numbers *n, float t, lone_end *f)
{
    float x = rng_fine_of(n->choice) * l->driver;
    bool scatters = x < l->sigma_s;
    p->numbers.next += (uint32_t)(n->collide + (scatters ? 2 : 0));
    f->t = t;
    f->event = scatters ? PATH_SCATTERED : PATH_ENDED;
    if (scatters && l->ratio != 1.0f)
        lone_scale(p, w, l->ratio, l->ratio);
    if (!l->nulls || scatters || x - l->sigma_s < l->sigma_a)
        return LONE_LAYS;
    lone_scale(p, w, l->null_beta, l->null_r);
    p->lays = lone_lays_of(w);
    p->marks |= LONE_DRAWN;
    w->t = t;
    w->tau = rng_depth_of(n->next[0], n->next[1]);
    return LONE_FLIES;
}

/* On to the next tentative collision, and through it. Where the flight may end
 * before, nothing is taken until its end is sought. */
HD int lone_fly(const lone_scene *l, lone_photon *p, lone_rest *w,
                const uint32_t *words, lone_end *f, lone_counts *count)
{
    bool sought = p->marks & LONE_SOUGHT;
    if (sought && w->ends == LONE_ESCAPES)
        return lone_passes(w, f);
    bool drawn = l->nulls && (p->marks & LONE_DRAWN);
    lone_numbers n = lone_look(&p->numbers, words, drawn);
    float from = drawn ? w->t : p->laid;
    float tau = drawn ? w->tau : rng_depth_of(n.depth[0], n.depth[1]);
    float t = from + fm_over_known(tau, l->driver, l->per_driver);
    bool there = sought ? tau < l->driver * (w->end - from)
                        : (p->marks & LONE_SURE) &&
                          lone_is_deep(l, vec3_mad(p->o, t, p->d));
    if (there) {
        count->lookups++;
        return lone_collide(l, p, w, &n, t, f);
    }
    if (!sought)
        return LONE_SEEKS;
    p->numbers.next += (uint32_t)n.fly;
    return lone_passes(w, f);
}

/* ---- events ------------------------------------------------------------ */

/* After a flight that has changed the weight. */
HD_APART void lone_change(lone_rest *w, lone_counts *count)
{
    double before = lone_told(w);
    w->power = lone_power(w);
    photon_book(&count->media, before - lone_told(w));
}

/* The end of a light's first flight, o + t d: where the light comes from. */
HD_APART vec3 lone_arrive(const flat_scene *s, lone_rest *w,
                          lone_counts *count, vec3 o, vec3 d, float t,
                          float factor)
{
    double before = lone_told(w);
    photon_first at = photon_first_at(s, w->light, o, d, w->from, t);
    w->beta = rgb_scale(lone_beta(w->beta), at.law * factor);
    w->light = -1;
    w->power = lone_power(w);
    photon_book(&count->units, (double)w->power - before);
    return at.d;
}

/* Roulette, as path_survives: the numbers behind it, and whether it is won. */
typedef struct {
    lone_stream numbers;
    bool alive;
} lone_fate;

HD_APART lone_fate lone_roulette(const lone_scene *l, lone_stream numbers,
                                 lone_rest *w, lone_counts *count)
{
    lone_fate out;
    float left = lone_throughput(w), q = hd_max(left * PATH_KEEPS, 0.05f);
    float before = w->power;
    rng r = lone_random(l, w->path, &numbers);
    out.alive = left > 0.0f && rng_chance(&r, q);
    out.numbers = numbers;
    lone_set_random(&out.numbers, &r);
    if (out.alive) {
        w->beta = rgb_scale(lone_beta(w->beta), 1.0f / q);
        w->power = lone_power(w);
    }
    photon_book(&count->roulette,
                (double)before - (out.alive ? (double)w->power : 0.0));
    return out;
}

/* 1 - cosine of a scattering, and 1 + cosine. */
typedef struct {
    float minus, plus;
} lone_cosine;

HD_APART lone_cosine lone_cosine_of(int kind, float g, float u)
{
    lone_cosine out;
    out.minus = phase_sample_ends(kind, g, u, &out.plus);
    return out;
}

/* phase_sample, where one kind of phase function is most often met. */
HD vec3 lone_turn(const flat_medium *m, vec3 d, float u, float v)
{
    lone_cosine c;
    if (m->phase == PHASE_HENYEY_GREENSTEIN)
        c.minus = phase_hg_sample(m->g, u, &c.plus);
    else
        c = lone_cosine_of(m->phase, m->g, u);
    return phase_turn(d, c.minus, c.plus, v);
}

HD int lone_scatter(const flat_scene *s, const lone_scene *l, lone_photon *p,
                    lone_rest *w, const uint32_t *words, const lone_end *f,
                    lone_counts *count)
{
    const flat_medium *m = &l->medium;
    vec3 d = p->d, at = vec3_mad(p->o, f->t, d);
    bool seen = true;
    count->events++;
    if (p->marks & LONE_ARRIVES) {
        seen = s->lights[w->light].media_interaction != 0;
        d = lone_arrive(s, w, count, p->o, d, f->t,
                        phase_pov_scale(m->phase));
        lone_renew(p, w);
    }
    if (!seen) {
        photon_book(&count->media, (double)w->power);
        return LONE_ENDS;
    }
    p->d = lone_turn(m, d, rng_float_of(lone_word(&p->numbers, words, -2)),
                     rng_float_of(lone_word(&p->numbers, words, -1)));
    p->o = at;
    p->laid = 0.0f;
    /* A collision at an end that was not sought is deep inside. */
    bool sure = !(p->marks & LONE_SOUGHT) || lone_is_deep(l, at);
    p->marks = (p->marks & LONE_LASTS) | LONE_STORED | (sure ? LONE_SURE : 0);
    if (!(p->marks & LONE_LASTS)) {
        lone_fate fate = lone_roulette(l, p->numbers, w, count);
        p->numbers = fate.numbers;
        if (!fate.alive)
            return LONE_ENDS;
        lone_renew(p, w);
    }
    lone_take_off(p, &count->rays);
    return LONE_FLIES;
}

/* Goes on behind the container's surface. */
HD int lone_cross(const flat_scene *s, lone_photon *p, lone_rest *w,
                  const lone_end *f, lone_counts *count)
{
    bool leaves = f->event == LONE_LEAVES;
    p->laid = w->end;
    lone_mark(p, LONE_SURE | LONE_BEHIND, false);
    lone_mark(p, leaves ? LONE_BEHIND_LAST : LONE_BEHIND_FIRST, true);
    lone_take_off(p, &count->rays);
    if (!leaves)
        return LONE_FLIES;
    p->marks |= LONE_SOUGHT;
    w->end = s->far;
    w->ends = LONE_ESCAPES;
    if (p->marks & LONE_STORED)
        return LONE_FLIES;
    w->events++;
    photon_book(w->events > PHOTON_EVENTS ? &count->dropped : &count->escaped,
                lone_told(w));
    return LONE_ENDS;
}

/* What comes after a flight, of which it is known what is laid. */
HD int lone_land(const flat_scene *s, const lone_scene *l, lone_photon *p,
                 lone_rest *w, const uint32_t *words, const lone_end *f,
                 lone_counts *count)
{
    if (p->marks & LONE_CHANGED) {
        lone_change(w, count);
        lone_renew(p, w);
    }
    bool dropped = ++w->events > PHOTON_EVENTS;
    if (!dropped && f->event == PATH_SCATTERED)
        return lone_scatter(s, l, p, w, words, f, count);
    bool escapes = f->event == LONE_ESCAPES;
    if (dropped || f->event == PATH_ENDED || escapes) {
        photon_book(dropped ? &count->dropped : escapes ? &count->escaped
                                                        : &count->media,
                    lone_told(w));
        return LONE_ENDS;
    }
    if (rgb_is_black(lone_beta(w->beta)))
        return LONE_ENDS;
    return lone_cross(s, p, w, f, count);
}

#endif
