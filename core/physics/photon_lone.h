/* photon_lone.h - photons where one gray medium, alike everywhere, fills one
 * ball or box, and there is nothing else: the physics of photon.h, to the bit,
 * with so little state that a GPU keeps it in registers.
 *
 * The container is convex. So a flight between two points deep inside of it
 * meets no surface, and none is sought; and behind its far side there is
 * nothing. What becomes of a flight is known before any of it is laid. */
#ifndef CORE_PHYSICS_PHOTON_LONE_H
#define CORE_PHYSICS_PHOTON_LONE_H
#include "core/physics/lone_scene.h"
#include "core/physics/photon.h"

/* What is next of a photon. */
enum { LONE_FLIES, LONE_SEEKS, LONE_LAYS, LONE_LANDS, LONE_ENDS };

/* How a flight ends, beside PATH_*: out of the container, into it by rounding
 * alone, or behind all surfaces. */
enum { LONE_LEAVES = PATH_ENDED + 1, LONE_ENTERS, LONE_ESCAPES };

typedef struct {
    vec3 o, d;
    rgb beta;               /* without MAY_TINTS its channels are alike    */
    float r_u;              /* of each channel                             */
    float power;            /* beta over r_u, mean over the channels, as it
                               was when the flight began                   */
    rgb lays;               /* beta over r_u, as it is                     */
    int32_t lasts;          /* no roulette is due                          */
    int32_t changed;        /* beta or r_u have, since the flight began    */
    float laid;             /* where the flight begins                     */
    float t, tau;           /* as photon_flight's                          */
    int32_t drawn;          /* tau is                                      */
    float end;              /* of the flight, if it has been sought        */
    int32_t sought;
    int32_t ends, root;     /* what is at its end, and which root          */
    int32_t after;          /* the root behind which it begins, or -1      */
    int32_t sure;           /* it begins inside, whatever the rounding     */
    int32_t event;          /* PATH_* or LONE_*: how it ended              */
    int32_t stored, light;  /* as photon_state's, with those that follow   */
    uint32_t events;
    float nominal;
    vec3 from;
    rng random;
} lone_photon;

/* ---- what a photon carries --------------------------------------------- */

HD rgb lone_beta(rgb beta)
{
    return scene_may(MAY_TINTS) ? beta : rgb_gray(beta.r);
}

HD float lone_power(const lone_photon *p)
{
    return rgb_mean(lone_beta(p->beta)) / rgb_mean(rgb_gray(p->r_u));
}

/* What roulette goes by. */
HD float lone_throughput(const lone_photon *p)
{
    return rgb_size(lone_beta(p->beta)) / rgb_mean(rgb_gray(p->r_u));
}

HD void lone_set_lays(lone_photon *p)
{
    p->lays = rgb_scale(lone_beta(p->beta),
                        1.0f / rgb_mean(rgb_gray(p->r_u)));
}

/* What follows from the weights, which few events change. */
HD void lone_weigh(lone_photon *p)
{
    p->power = lone_power(p);
    p->lasts = lone_throughput(p) * PATH_KEEPS >= 1.0f;
    lone_set_lays(p);
    p->changed = 0;
}

/* As photon_power has it. */
HD double lone_told(const lone_photon *p)
{
    double power = (double)p->power;
    return p->light >= 0 ? power * (double)p->nominal : power;
}

/* What a light's photons never change is not kept with each of them. */
HD rng *lone_random(const lone_scene *l, lone_photon *p)
{
    p->random.key[0] = l->key[0];
    p->random.key[1] = l->key[1];
    p->random.counter[2] = PHOTON_PASS;
    return &p->random;
}

/* As rng_u32, with what all photons' rounds share. */
HD uint32_t lone_u32(const lone_scene *l, lone_photon *p)
{
    rng *r = &p->random;
    if (r->used == 4u) {
        uint32_t c[4];
        c[0] = r->counter[0];
        c[1] = r->counter[1];
        c[2] = PHOTON_PASS;
        c[3] = r->counter[3]++;
        for (int i = 0; i < RNG_ROUNDS; i++)
            rng_philox_round(c, l->round_key[2 * i], l->round_key[2 * i + 1]);
        for (int i = 0; i < 4; i++)
            r->word[i] = c[i];
        r->used = 0u;
    }
    return rng_take(r);
}

HD float lone_float(const lone_scene *l, lone_photon *p)
{
    return rng_float_of(lone_u32(l, p));
}

HD float lone_fine(const lone_scene *l, lone_photon *p)
{
    return rng_fine_of(lone_u32(l, p));
}

/* The numbers of a depth; few need it, as a collision draws the next one before
 * it is known whether the flight goes on. */
typedef struct {
    uint32_t x, y;
} lone_draw;

HD lone_draw lone_draw_depth(const lone_scene *l, lone_photon *p)
{
    lone_draw n;
    n.x = lone_u32(l, p);
    n.y = rng_depth_is_end(n.x) ? lone_u32(l, p) : 0u;
    return n;
}

HD float lone_depth(const lone_scene *l, lone_photon *p)
{
    lone_draw n = lone_draw_depth(l, p);
    return rng_depth_of(n.x, n.y);
}

HD bool lone_is_deep(const lone_scene *l, vec3 p)
{
    vec3 q = affine_point(&l->to_local, p);
    if (l->ball)
        return vec3_dot(q, q) < l->deep * l->deep;
    return fabsf(q.x) < l->deep && fabsf(q.y) < l->deep && fabsf(q.z) < l->deep;
}

/* A flight begins at `laid`. */
HD void lone_take_off(lone_photon *p, track_counters *count)
{
    p->t = p->laid;
    p->drawn = p->sought = 0;
    count->rays++;
}

/* What is left of a photon that came into the container. */
HD void lone_from(const lone_scene *l, const photon_state *from,
                  lone_photon *p)
{
    const path_state *a = &from->path;
    bool entered = a->after.shape >= 0;
    float far = hd_max(fabsf(a->o.x), hd_max(fabsf(a->o.y), fabsf(a->o.z)));
    p->o = a->o;
    p->d = a->d;
    p->beta = a->beta;
    p->r_u = a->r_u.r;
    lone_weigh(p);
    p->laid = a->after.t;
    p->after = entered ? a->after.root : -1;
    p->sure = entered ? hd_max(far, a->after.t) < LONE_NEAR
                      : lone_is_deep(l, a->o);
    p->stored = from->stored;
    p->light = from->light;
    p->events = from->events;
    p->nominal = from->nominal;
    p->from = from->from;
    p->random = a->random;
}

/* A photon from its birth to the container; false: it has ended. */
HD bool lone_begin(const flat_scene *s, const lone_scene *l,
                   const photon_job *job, uint64_t photon, lone_photon *p,
                   photon_counters *c)
{
    photon_state g;
    photon_flight f;
    if (!photon_begin(s, job, photon, &g, c))
        return false;
    f.event = PATH_THROUGH;
    while (container_count(&g.path.inside) == 0) {
        photon_take_off(s, &g, c, &f);
        photon_seek(s, &g, &f);
        photon_passes(s, &g, c, &f);
        while (f.lays)
            photon_lay(s, &g, c, &f);
        g.events++;
        if (f.hit.shape < 0) {
            photon_end(&g, &c->books.escaped);
            return false;
        }
        shadow_cross(s, &f.hit, &g.path.inside);
        g.path.after = f.hit;
    }
    lone_from(l, &g, p);
    lone_take_off(p, &c->track);
    return true;
}

/* ---- flights ----------------------------------------------------------- */

/* The flight has come to its end. */
HD int lone_passes(lone_photon *p)
{
    p->t = p->end;
    p->event = p->ends;
    return LONE_LAYS;
}

/* Seeks its end, as bvh_nearest does: the first root behind the one at which it
 * began. Where rounding has put its beginning behind all of them, it meets no
 * medium. */
HD void lone_seek(const flat_scene *s, const lone_scene *l, lone_photon *p)
{
    float root[SHAPE_MAX_ROOTS];
    int surface[SHAPE_MAX_ROOTS];
    vec3 o = affine_point(&l->to_local, p->o);
    vec3 d = affine_vector(&l->to_local, p->d);
    int roots = l->ball ? shape_sphere_roots(o, d, root)
                        : shape_box_roots(o, d, root, surface);
    p->sought = 1;
    p->end = s->far;
    p->ends = LONE_ESCAPES;
    for (int i = 1; i >= 0; i--) {
        bool behind = root[i] > p->laid ||
                      (root[i] == p->laid && p->after >= 0 && i > p->after);
        if (roots == 0 || !behind || !(root[i] < s->far))
            continue;
        p->end = root[i];
        p->root = i;
        p->ends = i == 1 ? LONE_LEAVES : LONE_ENTERS;
    }
}

/* A tentative collision: the event, or on. */
HD int lone_collide(const lone_scene *l, lone_photon *p)
{
    lone_draw next = lone_draw_depth(l, p);
    float x = lone_fine(l, p) * l->driver;
    bool scatters = x < l->sigma_s;
    bool on = l->nulls && !scatters && !(x - l->sigma_s < l->sigma_a);
    p->event = scatters ? PATH_SCATTERED : PATH_ENDED;
    if (scatters && l->ratio != 1.0f) {
        p->beta = rgb_scale(lone_beta(p->beta), l->ratio);
        p->r_u *= l->ratio;
        p->changed = 1;
    }
    if (!on)
        return LONE_LAYS;
    p->beta = rgb_scale(lone_beta(p->beta), l->null_beta);
    p->r_u *= l->null_r;
    p->changed = 1;
    p->tau = rng_depth_of(next.x, next.y);
    p->drawn = 1;
    lone_set_lays(p);
    return LONE_FLIES;
}

/* On to the next tentative collision, tau being drawn, and through it. */
HD int lone_step(const lone_scene *l, lone_photon *p, track_counters *count)
{
    float t = p->t + p->tau / l->driver;
    bool there = p->sought ? p->tau < l->driver * (p->end - p->t)
                           : p->sure &&
                             lone_is_deep(l, vec3_mad(p->o, t, p->d));
    if (there && !(p->sought && p->ends == LONE_ESCAPES)) {
        p->t = t;
        count->lookups++;
        return lone_collide(l, p);
    }
    return p->sought ? lone_passes(p) : LONE_SEEKS;
}

HD int lone_fly(const lone_scene *l, lone_photon *p, track_counters *count)
{
    if (!p->drawn)
        p->tau = lone_depth(l, p);
    p->drawn = 0;
    return lone_step(l, p, count);
}

/* ---- events ------------------------------------------------------------ */

/* The end of a light's first flight. */
HD vec3 lone_arrive(const flat_scene *s, lone_photon *p, photon_counters *c,
                    float factor)
{
    double before = lone_told(p);
    photon_first first = photon_first_at(s, p->light, p->o, p->d, p->from,
                                         p->t);
    p->beta = rgb_scale(lone_beta(p->beta), first.law * factor);
    p->light = -1;
    lone_weigh(p);
    photon_book(&c->books.units, (double)p->power - before);
    return first.d;
}

/* Roulette, as path_survives. */
HD bool lone_survives(const lone_scene *l, lone_photon *p, photon_counters *c)
{
    if (p->lasts)
        return true;
    float left = lone_throughput(p), q = hd_max(left * PATH_KEEPS, 0.05f);
    float before = p->power;
    bool alive = left > 0.0f && rng_chance(lone_random(l, p), q);
    if (alive) {
        p->beta = rgb_scale(lone_beta(p->beta), 1.0f / q);
        lone_weigh(p);
    }
    photon_book(&c->books.roulette,
                (double)before - (alive ? (double)p->power : 0.0));
    return alive;
}

HD int lone_scatter(const flat_scene *s, const lone_scene *l, lone_photon *p,
                    photon_counters *c, track_counters *count)
{
    const flat_medium *m = &l->medium;
    vec3 d = p->d, at = vec3_mad(p->o, p->t, d);
    c->events++;
    if (p->light >= 0) {
        bool seen = s->lights[p->light].media_interaction != 0;
        d = lone_arrive(s, p, c, phase_pov_scale(m->phase));
        if (!seen) {
            photon_book(&c->books.media, (double)p->power);
            return LONE_ENDS;
        }
    }
    float pdf, u = lone_float(l, p);
    p->d = phase_sample(m->phase, m->g, d, u, lone_float(l, p), &pdf);
    p->o = at;
    p->laid = 0.0f;
    p->after = -1;
    /* A collision at an end that was not sought is deep inside. */
    p->sure = !p->sought || lone_is_deep(l, at);
    p->stored = 1;
    if (!lone_survives(l, p, c))
        return LONE_ENDS;
    lone_take_off(p, count);
    return LONE_FLIES;
}

/* What comes after a flight, which has been laid. */
HD int lone_land(const flat_scene *s, const lone_scene *l, lone_photon *p,
                 photon_counters *c, track_counters *count)
{
    if (p->changed) {
        double before = lone_told(p);
        lone_weigh(p);
        photon_book(&c->books.media, before - lone_told(p));
    }
    if (++p->events > PHOTON_EVENTS) {
        photon_book(&c->books.dropped, lone_told(p));
        return LONE_ENDS;
    }
    if (p->event == PATH_SCATTERED)
        return lone_scatter(s, l, p, c, count);
    if (p->event == PATH_ENDED) {
        photon_book(&c->books.media, lone_told(p));
        return LONE_ENDS;
    }
    if (p->event == LONE_ESCAPES) {
        photon_book(&c->books.escaped, lone_told(p));
        return LONE_ENDS;
    }
    if (rgb_is_black(lone_beta(p->beta)))
        return LONE_ENDS;
    p->laid = p->end;
    p->after = p->root;
    p->sure = 0;
    lone_take_off(p, count);
    if (p->event == LONE_ENTERS)
        return LONE_FLIES;
    p->end = s->far;
    p->ends = LONE_ESCAPES;
    if (p->stored)
        return lone_passes(p);
    p->events++;
    photon_book(p->events > PHOTON_EVENTS ? &c->books.dropped
                                          : &c->books.escaped, lone_told(p));
    return LONE_ENDS;
}

/* ---- laying ------------------------------------------------------------ */

/* Floor of a number well within those of 32 bits. */
HD int lone_floor(float x)
{
#ifdef __CUDA_ARCH__
    return __float2int_rd(x);
#else
    return hd_floor(x);
#endif
}

/* radiance_begin for a flight whose both ends are inside of the lattice. */
HD void lone_begin_inside(const flat_scene *s, vec3 o, vec3 d, float t0,
                          float t1, radiance_walk *w)
{
    const radiance_lattice *f = &s->field;
    radiance_set_out(f, o, t0, t1, w);
    for (int i = 0; i < 3; i++) {
        float along = vec3_get(d, i) / f->side;
        int c = lone_floor(vec3_get(w->o, i) + t0 * along);
        int last = 8 * f->bricks[i] - 1;
        w->inverse[i] = walk_inverse(along);
        w->cell[i] = c < 0 ? 0 : c > last ? last : c;
        w->next[i] = walk_plane(vec3_get(w->o, i), w->inverse[i], w->cell[i]);
    }
}

/* Begins to lay the flight; false: there is nothing to lay. */
HD bool lone_lays(const flat_scene *s, const lone_scene *l,
                  const lone_photon *p, const radiance_tally *t,
                  radiance_walk *w)
{
    if (!p->stored || !t->sum || !(p->t > p->laid))
        return false;
    if (p->sought || !p->sure || p->after >= 0 || !l->covered)
        return radiance_begin(s, p->o, p->d, p->laid, p->t, w);
    lone_begin_inside(s, p->o, p->d, p->laid, p->t, w);
    return true;
}

/* radiance_deposit. */
HD void lone_deposit(const flat_scene *s, const lone_scene *l,
                     radiance_tally *t, int64_t cell, vec3 p, vec3 d,
                     rgb value)
{
    if (!l->peaked) {
        radiance_deposit(s, t, cell, p, d, value);
        return;
    }
    if (radiance_clips(t, value))
        return;
    vec3 off = vec3_sub(d, radiance_to_eye(s, p));
    float x = l->law[0] + l->law[1] * (0.5f * vec3_dot(off, off));
    radiance_add_rgb(t->sum + cell * s->field.numbers + s->field.eye,
                     rgb_scale(value, l->law[2] / (x * sqrtf(x))));
}

/* radiance_lay for a field whose cells are of one size. */
HD bool lone_lay(const flat_scene *s, const lone_scene *l, radiance_tally *t,
                 radiance_walk *w, const lone_photon *p)
{
    const radiance_lattice *f = &s->field;
    const int32_t *at = w->cell;
    float from = w->t;
    int in = ((at[2] & 7) * 8 + (at[1] & 7)) * 8 + (at[0] & 7);
    int32_t slot = radiance_slot(s, at[0], at[1], at[2]);
    float next = hd_min(w->next[0], hd_min(w->next[1], w->next[2]));
    w->t = hd_max(w->t, hd_min(next, w->end));
    bool more = w->t < w->end && radiance_step(s, w);
    float length = w->t - from;
    if (slot < 0 || !(length > 0.0f))
        return more;
    lone_deposit(s, l, t, (int64_t)slot * 512 + in,
                 vec3_mad(p->o, from + 0.5f * length, p->d), p->d,
                 rgb_scale(lone_beta(p->lays), length / f->side));
    return more;
}

#endif
