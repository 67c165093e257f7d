/* photon.h - one photon from its birth to its end: what a backend's trace
 * stage loops over. */
#ifndef CORE_PHYSICS_PHOTON_H
#define CORE_PHYSICS_PHOTON_H
#include "core/physics/photon_birth.h"

/* ---- flights ----------------------------------------------------------- */

/* A flight between two events or surfaces, in steps: on a GPU the threads of a
 * warp take them side by side, however many each flight has. What several of
 * its ways lead to stands in one place, and waits until it is come to: there
 * are few instructions, and threads meet. */
typedef struct {
    ray_hit hit;            /* the next surface, where it has been sought  */
    media_walk walk;
    rgb majorant;           /* of the current piece                        */
    float t, tau;           /* how far it is; depth left to the next
                               tentative collision                         */
    double power;           /* at its start, as the books tell it          */
    int32_t event;          /* PATH_*: how it ends                         */
    path_event at;
    int32_t clear;          /* ... in a cell through which no surface goes */
    int32_t seeks;          /* PHOTON_SEEKS_*                              */
    int32_t departs;        /* its walk is to begin                        */
    int32_t flies;          /* it has not ended                            */
    int32_t collides;       /* it is at a tentative collision              */
    int32_t lays;           /* PHOTON_LAYS_*                               */
    radiance_walk stretch;
    rgb lays_power;
} photon_flight;

/* Whether a stretch of a flight is still to be laid. */
enum { PHOTON_LAYS_NONE, PHOTON_LAYS_ALL, PHOTON_LAYS_REST };

/* Whether the next surface is sought: not before the flight comes to a cell
 * through which one may go. */
enum { PHOTON_SEEKS_NOT_YET, PHOTON_SEEKS, PHOTON_HAS_SOUGHT };

/* Lays a cell of the stretch. */
HD void photon_lay(const flat_scene *s, const photon_state *p,
                   photon_counters *c, photon_flight *f)
{
    bool more = f->lays == PHOTON_LAYS_REST ||
                radiance_begin(s, p->path.o, p->path.d, f->stretch.t,
                               f->stretch.end, &f->stretch);
    if (more)
        more = radiance_lay(s, &c->tally, &f->stretch, p->path.o, p->path.d,
                            f->lays_power);
    f->lays = more ? PHOTON_LAYS_REST : PHOTON_LAYS_NONE;
}

/* The flight is to be laid up to t, with that power. While a stretch is left
 * to lay, no more than rounding can follow it. */
HD void photon_leave(const flat_scene *s, photon_state *p,
                     const photon_counters *c, photon_flight *f, float t,
                     rgb beta, rgb r_u)
{
    bool laid = f->lays || !p->stored || !c->tally.sum || s->field.ball;
    if (!laid && t > p->laid) {
        f->lays_power = rgb_scale(beta, 1.0f / rgb_mean(r_u));
        f->lays = PHOTON_LAYS_ALL;
        f->stretch.t = p->laid;
        f->stretch.end = t;
    }
    p->laid = t;
}

HD bool photon_gray(rgb c)
{
    return c.r == c.g && c.g == c.b;
}

/* Flies from t to t + step. Where the channels fly differently, the power
 * changes on the way: it is told at a point of it. */
HD void photon_fly(const flat_scene *s, photon_state *p, photon_counters *c,
                   photon_flight *f, float step)
{
    if (photon_gray(may_gray(f->majorant)))
        return;
    rgb ratio = path_ratio(&p->path, f->majorant,
                           step * rng_float(&p->path.random));
    photon_leave(s, p, c, f, f->t + step, rgb_mul(p->path.beta, ratio),
                 rgb_mul(p->path.r_u, ratio));
    path_fly(&p->path, f->majorant, step);
}

/* The flight ends where it was to, or did not begin. */
HD void photon_passes(const flat_scene *s, photon_state *p,
                      photon_counters *c, photon_flight *f)
{
    f->flies = 0;
    photon_leave(s, p, c, f, f->hit.t, p->path.beta,
                 may_gray(p->path.r_u));
}

HD void photon_take_off(const flat_scene *s, photon_state *p,
                        photon_counters *c, photon_flight *f)
{
    bool clear = f->event == PATH_SCATTERED && f->clear;
    f->seeks = clear ? PHOTON_SEEKS_NOT_YET : PHOTON_SEEKS;
    f->hit.t = s->far;
    f->event = PATH_THROUGH;
    f->power = photon_power(p);
    f->departs = f->flies = 1;
    f->collides = 0;
    f->lays = PHOTON_LAYS_NONE;
    p->laid = p->path.after.t;
    c->track.rays++;
}

/* As the walk comes to a piece. */
HD void photon_enter(const flat_scene *s, photon_flight *f)
{
    f->majorant = path_majorant(s, &f->walk, false);
    f->t = f->walk.t;
    if (f->seeks == PHOTON_SEEKS_NOT_YET && !walk_is_clear(&f->walk))
        f->seeks = PHOTON_SEEKS;
}

/* Begins the walk, once it is known where the flight ends or that it begins
 * where no surface is. */
HD void photon_depart(const flat_scene *s, photon_state *p,
                      photon_counters *c, photon_flight *f)
{
    path_state *a = &p->path;
    f->departs = 0;
    walk_begin(s, &f->walk, &a->inside, true, a->o, a->d, a->after.t,
               f->hit.t);
    c->track.overflow += f->walk.overflow;
    if (f->walk.count == 0) {
        photon_passes(s, p, c, f);
        return;
    }
    f->tau = rng_optical_depth(&a->random);
    photon_enter(s, f);
}

/* Seeks the next surface. */
HD void photon_seek(const flat_scene *s, photon_state *p, photon_flight *f)
{
    bvh_ray r = bvh_ray_make(p->path.o, p->path.d);
    f->hit = bvh_nearest(s, &r, &p->path.after, s->far);
    f->seeks = PHOTON_HAS_SOUGHT;
    if (f->hit.shape < 0)
        container_leave_bounded(s, &p->path.inside);
    if (!f->departs)
        walk_stop(&f->walk, f->hit.t);
}

/* A tentative collision, and where the next one would be. */
HD void photon_collide(const flat_scene *s, photon_state *p,
                       photon_counters *c, photon_flight *f)
{
    path_state *a = &p->path;
    path_point at;
    int which = 0;
    rgb majorant = may_gray(f->majorant);
    f->collides = 0;
    f->tau = rng_optical_depth(&a->random);
    path_point_at(s, a, &f->walk, f->t, majorant, &at);
    rgb beta = a->beta, r_u = may_gray(a->r_u);
    f->event = path_collide(a, &f->walk, &at, majorant, &which);
    f->flies = f->event == PATH_THROUGH;
    if (!f->flies || !photon_gray(at.all_t))
        photon_leave(s, p, c, f, f->t, beta, r_u);
    f->at.t = f->t;
    f->clear = walk_is_clear(&f->walk);
    if (f->event == PATH_SCATTERED)
        f->at.medium = walk_part(&f->walk, which)->medium;
}

/* Delta tracking as in path_track: on to the next tentative collision or the
 * end of a piece. */
HD void photon_track(const flat_scene *s, photon_state *p, photon_counters *c,
                     photon_flight *f)
{
    float driver = rgb_get(may_gray(f->majorant), p->path.driver);
    float left = driver * (f->walk.t_end - f->t);
    f->collides = f->tau < left;
    float step = f->collides ? f->tau / driver : f->walk.t_end - f->t;
    photon_fly(s, p, c, f, step);
    f->t += step;
    if (f->collides)
        return;
    f->tau -= left;
    if (walk_next(s, &f->walk))
        photon_enter(s, f);
    else
        photon_passes(s, p, c, f);
}

/* What is next of a flight; PHOTON_LANDS at its end. */
enum { PHOTON_LANDS, PHOTON_LOOKS, PHOTON_DEPARTS, PHOTON_TRACKS,
       PHOTON_COLLIDES, PHOTON_LAYS };

HD int photon_next(const photon_flight *f)
{
    return f->lays                   ? PHOTON_LAYS
         : !f->flies                 ? PHOTON_LANDS
         : f->seeks == PHOTON_SEEKS  ? PHOTON_LOOKS
         : f->departs                ? PHOTON_DEPARTS
         : f->collides               ? PHOTON_COLLIDES
                                     : PHOTON_TRACKS;
}

/* ---- events ------------------------------------------------------------ */

HD void photon_end(const photon_state *p, photon_sum *book)
{
    photon_book(book, photon_power(p));
}

/* What a light gives at the end of a first flight, and its direction there. */
typedef struct {
    float law;
    vec3 d;
} photon_first;

HD_SHARED photon_first photon_first_at(const flat_scene *s, int32_t light,
                                       vec3 o, vec3 d, vec3 from, float t)
{
    photon_first first;
    photon_state p;
    p.light = light;
    p.path.o = o;
    p.path.d = d;
    p.from = from;
    first.law = photon_law(s, &p, t);
    first.d = photon_arrives(s, &p, t);
    return first;
}

/* The end of a light's first flight at t: its power is told. Returns the
 * direction in which the light comes there. */
HD vec3 photon_arrive(const flat_scene *s, photon_state *p,
                      photon_counters *c, float t, float factor)
{
    double before = photon_power(p);
    photon_first first = photon_first_at(s, p->light, p->path.o, p->path.d,
                                         p->from, t);
    p->path.beta = rgb_scale(p->path.beta, first.law * factor);
    p->light = -1;
    photon_book(&c->books.units, photon_power(p) - before);
    return first.d;
}

HD bool photon_roulette(photon_state *p, photon_counters *c)
{
    double before = photon_power(p);
    bool alive = path_survives(&p->path, PATH_KEEPS);
    photon_book(&c->books.roulette,
                before - (alive ? photon_power(p) : 0.0));
    return alive;
}

/* Stores an event at p, of light that came along d. */
HD void photon_store(const flat_scene *s, const photon_state *p,
                     photon_counters *c, vec3 at, vec3 d, int phase, float g)
{
    if (!scene_may(MAY_BALLS) || !p->stored || !c->tally.sum ||
        !s->field.ball)
        return;
    radiance_event e;
    e.p = at;
    e.d = d;
    e.phase = phase;
    e.g = g;
    e.power = rgb_scale(p->path.beta, 1.0f / rgb_mean(p->path.r_u));
    if (radiance_store(s, &c->tally, &e))
        c->stored++;
}

HD bool photon_scatter(const flat_scene *s, photon_state *p,
                       photon_counters *c, const path_event *event)
{
    const flat_medium *m = &s->media[event->medium];
    vec3 d = p->path.d, at = vec3_mad(p->path.o, event->t, d);
    c->events++;
    photon_store(s, p, c, at, d, m->phase, m->g);
    if (p->light >= 0) {
        bool seen = s->lights[p->light].media_interaction != 0;
        d = photon_arrive(s, p, c, event->t, phase_pov_scale(m->phase));
        if (!seen) {
            photon_book(&c->books.media, photon_power(p));
            return false;
        }
    }
    float pdf, u = rng_float(&p->path.random);
    vec3 next = phase_sample(m->phase, m->g, d, u, rng_float(&p->path.random),
                             &pdf);
    path_turn(&p->path, at, next, pdf);
    p->path.boost = 1.0f;
    p->direct = 0;
    p->stored = 1;
    return photon_roulette(p, c);
}

/* A lobe about the mirror direction as wide as the finish's highlights. */
HD float photon_lobe(const flat_material *m)
{
    float power = 1e6f;
    if (m->phong > 0.0f)
        power = hd_min(power, m->phong_size);
    if (m->specular > 0.0f && m->roughness > 0.0f)
        power = hd_min(power, 0.25f / m->roughness);
    return hd_max(power, 0.0f);
}

HD float photon_lobe_pdf(float power, float cosine)
{
    return cosine > 0.0f ? 0.5f * (power + 1.0f) * WARP_INV_PI *
                               fm_pow(cosine, power)
                         : 0.0f;
}

/* Where a photon leaves the surface for, with the density of that. */
HD vec3 photon_leaves(photon_state *p, const hit_point *at, bool highlights,
                      float *pdf)
{
    rng *r = &p->path.random;
    float u = rng_float(r), v = rng_float(r);
    vec3 out = warp_frame_to_world(warp_frame(at->ng),
                                   warp_cosine_hemisphere(u, v));
    *pdf = warp_cosine_hemisphere_pdf(vec3_dot(at->ng, out));
    if (!highlights)
        return out;
    float power = photon_lobe(at->material);
    vec3 mirror = vec3_mad(p->path.d, -2.0f * vec3_dot(at->ns, p->path.d),
                           at->ns);
    if (rng_chance(r, 0.5f)) {
        float cosine = fm_pow(1.0f - u, 1.0f / (power + 1.0f));
        float sine = sqrtf(hd_max(1.0f - cosine * cosine, 0.0f));
        out = warp_frame_to_world(warp_frame(mirror),
                                  warp_around_z(cosine, sine, v));
        *pdf = warp_cosine_hemisphere_pdf(vec3_dot(at->ng, out));
    }
    *pdf = 0.5f * (*pdf + photon_lobe_pdf(power, vec3_dot(mirror, out)));
    return out;
}

/* Power off the surface over power onto it, per solid angle: the light comes
 * per area seen along its way, and leaves so. */
HD rgb photon_reflects(const hit_point *at, vec3 d, vec3 out, bool highlights)
{
    vec3 wi = vec3_scale(d, -1.0f);
    float in = vec3_dot(at->ng, wi), leaves = vec3_dot(at->ng, out);
    if (!(in > 1e-6f) || !(leaves > 0.0f))
        return rgb_gray(0.0f);
    rgb value = highlights
        ? surface_light(at->material, at->color, at->opacity, at->ns, out, wi)
        : surface_matte(at->material, at->color, at->opacity,
                        vec3_dot(at->ns, wi));
    return rgb_scale(value, leaves * WARP_INV_PI / in);
}

HD bool photon_bounce(const flat_scene *s, photon_state *p,
                      photon_counters *c, const ray_hit *h,
                      const hit_point *at)
{
    bool highlights = false, first = p->light >= 0;
    if (first) {
        const flat_light *l = &s->lights[p->light];
        highlights = l->shadows && surface_has_highlight(at->material);
        photon_arrive(s, p, c, h->t, FM_PI / light_medium_factor(s));
    }
    double before = photon_power(p);
    rgb value = rgb_gray(0.0f);
    float pdf = 0.0f;
    vec3 out = at->ng;
    if (p->direct || s->surfaces_indirect) {
        out = photon_leaves(p, at, highlights, &pdf);
        value = photon_reflects(at, p->path.d, out, highlights);
    }
    if (!(pdf > 0.0f) || rgb_is_black(value)) {
        photon_book(&c->books.surfaces, before);
        return false;
    }
    p->path.beta = rgb_mul(p->path.beta, rgb_scale(value, 1.0f / pdf));
    photon_book(&c->books.surfaces, before - photon_power(p));
    c->bounces++;
    path_turn(&p->path, surface_offset(at->p, at->ng), out, pdf);
    p->direct = 0;
    p->stored = 1;
    return photon_roulette(p, c);
}

HD bool photon_surface(const flat_scene *s, photon_state *p,
                       photon_counters *c, const ray_hit *h)
{
    if (hit_material(s, h) >= 0) {
        bvh_ray r = bvh_ray_make(p->path.o, p->path.d);
        hit_point at = hit_resolve(s, &r, h);
        double before = photon_power(p);
        if (p->light >= 0 && (s->shapes[h->shape].flags & SHAPE_NO_SHADOW))
            at.pass = rgb_gray(1.0f);
        bool passes = path_passes(&p->path, &at);
        photon_book(&c->books.surfaces, before - photon_power(p));
        if (!passes && p->direct && container_is_unbounded(s, h->shape)) {
            photon_end(p, &c->books.walls);
            return false;
        }
        if (!passes)
            return photon_bounce(s, p, c, h, &at);
    }
    shadow_cross(s, h, &p->path.inside);
    p->path.after = *h;
    return !rgb_is_black(p->path.beta);
}

/* What comes after a flight. False: the photon has ended. */
HD bool photon_land(const flat_scene *s, photon_state *p, photon_counters *c,
                    const photon_flight *f)
{
    photon_book(&c->books.media, f->power - photon_power(p));
    if (++p->events > PHOTON_EVENTS) {
        photon_end(p, &c->books.dropped);
        return false;
    }
    if (f->event == PATH_SCATTERED)
        return photon_scatter(s, p, c, &f->at);
    if (f->event == PATH_ENDED)
        photon_end(p, &c->books.media);
    else if (f->hit.shape >= 0)
        return photon_surface(s, p, c, &f->hit);
    else
        photon_end(p, &c->books.escaped);
    return false;
}

/* ---- the whole of it --------------------------------------------------- */

/* The source of a photon: they take turns by their shares. *place, in [0, 1),
 * is the photon's among those of the source. */
HD const photon_source *photon_source_of(const photon_job *job,
                                         uint64_t photon, double *place)
{
    double u = ((double)photon + (double)job->shift_share) /
               (double)job->count;
    int i = 0;
    while (i < job->sources - 1 && u >= job->source[i].cumulative)
        i++;
    const photon_source *source = &job->source[i];
    u = (u - source->cumulative) / source->share + 1.0;
    *place = u < 0.0 ? 0.0 : u < 1.0 ? u : 1.0 - 1e-12;
    return source;
}

/* Stores a birth where a medium emits, `scale` being 1 over the photons of its
 * source. */
HD void photon_store_birth(const flat_scene *s, const photon_source *source,
                           const photon_state *p, photon_counters *c,
                           float scale)
{
    if (!p->emission || !s->field.births || !c->tally.sum)
        return;
    float weight = source->kind == PHOTON_GLOW ? s->glows[0].power * scale
                                               : rgb_mean(p->path.beta);
    radiance_event e;
    e.p = p->path.o;
    e.d = p->path.d;
    e.phase = RADIANCE_BIRTH;
    e.g = 0.0f;
    e.power = rgb_gray(weight);
    if (radiance_store(s, &c->tally, &e))
        c->stored++;
}

/* The birth; false: it has no power. */
HD bool photon_begin(const flat_scene *s, const photon_job *job,
                     uint64_t photon, photon_state *p, photon_counters *c)
{
    float u[PHOTON_DIMENSIONS];
    double place;
    const photon_source *source = photon_source_of(job, photon, &place);
    photon += job->first;
    photon_place(job, photon, u);
    photon_birth(s, source, u, place,
                 rng_make(job->seed, job->frame, PHOTON_PASS, photon), p,
                 &c->track);
    float scale = (float)(1.0 / (source->share * job->power));
    p->path.beta = rgb_scale(p->path.beta, scale);
    c->photons++;
    photon_book(&c->books.emitted, photon_power(p));
    photon_store_birth(s, source, p, c, scale);
    return !rgb_is_black(p->path.beta);
}

/* The whole of a flight. */
HD void photon_pass(const flat_scene *s, photon_state *p, photon_counters *c,
                    photon_flight *f)
{
    photon_take_off(s, p, c, f);
    for (int next; (next = photon_next(f)) != PHOTON_LANDS;)
        if (next == PHOTON_LAYS)
            photon_lay(s, p, c, f);
        else if (next == PHOTON_TRACKS)
            photon_track(s, p, c, f);
        else if (next == PHOTON_COLLIDES)
            photon_collide(s, p, c, f);
        else if (next == PHOTON_LOOKS)
            photon_seek(s, p, f);
        else
            photon_depart(s, p, c, f);
}

/* The whole of photons [first, first + n). */
HD void photon_run(const flat_scene *s, const photon_job *job, uint64_t first,
                   uint64_t n, photon_counters *c)
{
    for (uint64_t i = first; i < first + n; i++) {
        photon_state p;
        photon_flight f;
        f.event = PATH_THROUGH;
        bool alive = photon_begin(s, job, i, &p, c);
        while (alive) {
            photon_pass(s, &p, c, &f);
            alive = photon_land(s, &p, c, &f);
        }
    }
}

#endif
