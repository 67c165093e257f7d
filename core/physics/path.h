/* path.h - the reference integrator: unbiased null-collision path tracing.
 *
 * A path carries its throughput beta and the ratio r_u of its sampling
 * density in each channel to that in the channel that drives it, chosen
 * uniformly once a path: beta / mean(r_u) is the balance heuristic over
 * drivers (Miller, Georgiev, Jarosz 2019; METHODS.md 1.2). Shadow rays weigh
 * by direction alone.
 *
 * What is transported is the scene's to say: a bounce is followed where the
 * scene's transport has it, and a ray that is followed finds all emission. On
 * the straight line from the eye, emission of media and the background are
 * march.h's, which has no noise; the path leaves them out there. */
#ifndef CORE_PHYSICS_PATH_H
#define CORE_PHYSICS_PATH_H
#include "core/physics/equiangular.h"
#include "core/physics/light.h"
#include "core/physics/path_track.h"
#include "core/physics/plate.h"
#include "core/physics/shadow.h"
#include "core/physics/sky.h"
#include "core/physics/warp.h"

/* ---- light that reaches a vertex --------------------------------------- */

/* What a vertex makes of light from direction wi. */
typedef struct {
    vec3 p, d;              /* d: direction of the ray that came there     */
    bool on_surface;        /* or in a medium                              */
    const hit_point *surface;       /* on one                              */
    const flat_medium *medium;      /* in one                              */
    const path_event *event;        /* ... where the path found it         */
} path_vertex;

/* Radiance toward the eye per light C at a surface or per 4 pi C (pi C in
 * physical units) in a medium. A light without shadows makes no highlights. */
HD rgb path_response(const flat_scene *s, const path_vertex *v, vec3 wi,
                     bool highlights)
{
    const hit_point *h = v->surface;
    if (v->on_surface && !highlights)
        return surface_matte(h->material, h->color, h->opacity,
                             vec3_dot(h->ns, wi));
    if (v->on_surface)
        return surface_light(h->material, h->color, h->opacity, h->ns,
                             vec3_scale(v->d, -1.0f), wi);
    float p = phase_eval_between(v->medium->phase, v->medium->g, v->d, wi);
    return rgb_gray(p * phase_pov_scale(v->medium->phase) *
                    light_medium_factor(s));
}

/* Where a ray that leaves the vertex toward wi starts. */
HD vec3 path_origin(const path_vertex *v, vec3 wi)
{
    if (!v->on_surface)
        return v->p;
    vec3 n = v->surface->ng;
    return surface_offset(v->p, vec3_dot(n, wi) < 0.0f ? vec3_scale(n, -1.0f)
                                                       : n);
}

HD bool path_faces(const path_vertex *v, vec3 wi)
{
    return !v->on_surface || vec3_dot(v->surface->ng, wi) > 0.0f;
}

HD_APART rgb path_lit_line(const flat_scene *s, container_set *set, vec3 o,
                           vec3 wi, float distance, line_jitter jitter)
{
    return shadow_line(s, set, o, wi, distance, jitter);
}

/* What passes of the light of a sample. Where a field takes the noise of the
 * rest, a surface's light has none either. */
HD rgb path_lit(const flat_scene *s, path_state *p, const path_vertex *v,
                const light_sample *l)
{
    const flat_light *light = &s->lights[l->light];
    if (!light->shadows)
        return l->color;
    container_set set = p->inside;
    bool atmosphere = s->media_multiple || light->media_attenuation != 0;
    vec3 o = path_origin(v, l->shadow_wi);
    if (scene_may(MAY_FIELD) && s->field.numbers > 0 && v->on_surface &&
        atmosphere) {
        p->count->shadow_rays++;
        return rgb_mul(l->color, path_lit_line(s, &set, o, l->shadow_wi,
            l->shadow_distance, line_jitter_draw(s, &p->random)));
    }
    rgb left = shadow_transmittance(s, &set, atmosphere, o, l->shadow_wi,
                                    l->shadow_distance, &p->random, p->count);
    return rgb_mul(l->color, left);
}

HD equiangular path_angles(const path_state *p, const flat_light *l)
{
    return equiangular_make(p->o, p->d, p->stretch.first, p->stretch.last,
                            l->position, l->blunt);
}

/* Share of a light at the distance t of the segment that is left to
 * path_along: by the density of its choice and a coarse one of flights that
 * end there, with scattering sigma_s. Any share would do, if both agree. */
HD float path_along_share(const path_state *p, const flat_light *l, float t,
                          float sigma_s)
{
    const path_stretch *look = &p->stretch;
    if (!scene_may(MAY_LAMPS) || !look->on || !l->local ||
        !(t > look->first && t < look->last))
        return 0.0f;
    equiangular e = path_angles(p, l);
    float flight = p->boost * sigma_s *
                   fm_exp(-look->stop * (t - look->first));
    return 1.0f / (1.0f + flight / equiangular_pdf(&e, t));
}

HD void path_light_sample(const flat_scene *s, path_state *p,
                          const path_vertex *v, const light_sample *l)
{
    const flat_light *light = &s->lights[l->light];
    if (!path_faces(v, l->wi) ||
        (!v->on_surface && !light->media_interaction))
        return;
    rgb value = path_response(s, v, l->wi, light->shadows);
    if (!v->on_surface)
        value = rgb_scale(value, 1.0f -
            path_along_share(p, light, v->event->t, v->event->sigma_s));
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, path_lit(s, p, v, l));
    path_add(p, rgb_scale(rgb_mul(p->beta, value), 1.0f / l->probability));
}

/* Next-event estimation to one of the lights; on surfaces that the eye sees,
 * to all. */
HD void path_light(const flat_scene *s, path_state *p, const path_vertex *v)
{
    int i = 0, end = (int)s->lights_count;
    light_sample l;
    l.probability = 1.0f;
    if (end > 0 && !(v->on_surface && p->straight)) {
        i = light_find(s, rng_float(&p->random), &l.probability);
        end = l.probability > 0.0f ? i + 1 : i;
    }
    for (; i < end; i++)
        if (light_reach(s, i, v->p, &p->random, &l))
            path_light_sample(s, p, v, &l);
}

/* What the media at distance t of the segment scatter toward the eye of light
 * from wi, per light C; their scattering in *sigma_s. */
HD rgb path_scattered(const flat_scene *s, const path_state *p, float t,
                      vec3 wi, float *sigma_s)
{
    vec3 x = vec3_mad(p->o, t, p->d);
    rgb sum = rgb_gray(0.0f);
    *sigma_s = 0.0f;
    for (int i = -1; i < container_count(&p->inside); i++) {
        int32_t interior = container_interior(s, &p->inside, i);
        for (int k = 0; interior >= 0 && k < s->interiors[interior].count;
             k++) {
            const flat_medium *m = &s->media[
                s->interior_media[s->interiors[interior].first + k]];
            field_point at = field_point_make(s, m->lead, x);
            rgb sigma = rgb_mul(m->sigma_s, medium_density(s, m, &at));
            float phase = phase_eval_between(m->phase, m->g, p->d, wi) *
                          phase_pov_scale(m->phase);
            *sigma_s += rgb_mean(sigma);
            sum = rgb_add(sum, rgb_scale(sigma, phase));
        }
    }
    return rgb_scale(sum, light_medium_factor(s));
}

/* Light of a near lamp that the segment's media scatter, at a point chosen by
 * the lamp and not by a flight. */
HD void path_along(const flat_scene *s, path_state *p)
{
    float probability, sigma_s;
    int i = light_find(s, rng_float(&p->random), &probability);
    const flat_light *light = &s->lights[i];
    if (!light->local || !light->media_interaction || !(probability > 0.0f))
        return;
    equiangular e = path_angles(p, light);
    float first, second;
    path_pair_floats(p, PATH_PAIR_FLIGHT, &first, &second);
    float t = equiangular_sample(&e, second);
    path_vertex v;
    light_sample l;
    v.p = vec3_mad(p->o, t, p->d);
    v.on_surface = false;
    if (!light_reach(s, i, v.p, &p->random, &l))
        return;
    rgb value = path_scattered(s, p, t, l.wi, &sigma_s);
    float share = path_along_share(p, light, t, sigma_s);
    value = rgb_scale(value, share / (equiangular_pdf(&e, t) * probability));
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, track_transmittance(s, &p->inside, true, p->o, p->d,
        p->after.t, t, &p->random, p->count));
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, path_lit(s, p, &v, &l));
    path_add(p, rgb_mul(p->beta, value));
}

/* Radiance per incident radiance and solid angle, cosine included, of light
 * that bounces at the vertex; *pdf is the density of directions in proportion
 * to it. */
HD rgb path_bounce_own(const path_vertex *v, vec3 wi, float *pdf)
{
    if (v->on_surface) {
        float cosine = vec3_dot(v->surface->ns, wi);
        *pdf = hd_max(cosine, 0.0f) * WARP_INV_PI;
        return rgb_scale(surface_matte(v->surface->material,
                                       v->surface->color,
                                       v->surface->opacity, cosine),
                         WARP_INV_PI);
    }
    *pdf = phase_eval_between(v->medium->phase, v->medium->g, v->d, wi);
    return rgb_gray(*pdf);
}

/* The same; *pdf is path_bounce's density. */
HD rgb path_bounce_eval(const path_state *p, const path_vertex *v, vec3 wi,
                        float *pdf)
{
    rgb value = path_bounce_own(v, wi, pdf);
    if (scene_may(MAY_LAMPS))
        *pdf = aim_mixed(&p->aim, wi, *pdf);
    return value;
}

/* Where a path goes on from a vertex, a lamp that is near chooses the more of
 * its directions the more is scattered there from the lamp's. */
HD void path_aim(const flat_scene *s, path_state *p, const path_vertex *v)
{
    const float most = 0.5f;
    float probability, pdf;
    if (!path_has_lamps(s))
        return;
    int i = light_find(s, rng_float(&p->random), &probability);
    vec3 to = vec3_sub(s->lights[i].position, v->p);
    float distance = vec3_length(to);
    if (!s->lights[i].local || !(probability > 0.0f) || !(distance > 0.0f))
        return;
    p->aim.to = vec3_scale(to, 1.0f / distance);
    if (!path_faces(v, p->aim.to))
        return;
    path_bounce_own(v, p->aim.to, &pdf);
    p->aim.share = most * hd_min(4.0f * FM_PI * pdf, 1.0f);
}

/* Next-event estimation to the sky. Bounces that find it weigh by the rest. */
HD void path_sky(const flat_scene *s, path_state *p, const path_vertex *v)
{
    if (!sky_is_light(s))
        return;
    float chosen, pdf;
    vec3 wi = sky_choose(s, &p->random, &chosen);
    if (!(chosen > 0.0f) || !path_faces(v, wi))
        return;
    rgb value = rgb_mul(path_bounce_eval(p, v, wi, &pdf), sky_radiance(s, wi));
    if (rgb_is_black(value))
        return;
    container_set set = p->inside;
    rgb left = shadow_transmittance(s, &set, true, path_origin(v, wi), wi,
                                    s->far, &p->random, p->count);
    value = rgb_mul(value, left);
    path_add(p, rgb_scale(rgb_mul(p->beta, value), 1.0f / (chosen + pdf)));
}

/* What a lamp has of the directions in which a path goes on. */
HD float path_aim_share(const path_state *p)
{
    return scene_may(MAY_LAMPS) ? p->aim.share : 0.0f;
}

/* A direction in proportion to how a diffuse surface or a medium scatters, or
 * as a lamp has it; *own: a medium's density, where no lamp has a share. */
HD vec3 path_bounce_choose(const path_vertex *v, path_state *p, float *own)
{
    float u, w, share = path_aim_share(p);
    path_pair_floats(p, PATH_PAIR_TURN, &u, &w);
    if (u < share)
        return aim_sample(&p->aim, u / share, w);
    u = (u - share) / (1.0f - share);
    if (!v->on_surface)
        return phase_sample(v->medium->phase, v->medium->g, v->d, u, w, own);
    return warp_frame_to_world(warp_frame(v->surface->ns),
                               warp_cosine_hemisphere(u, w));
}

/* What a path that went on from the vertex would find of the sky, where none
 * does. */
HD void path_sky_rest(const flat_scene *s, path_state *p,
                      const path_vertex *v)
{
    float pdf;
    if (!s->environment)
        return;
    vec3 wi = path_bounce_choose(v, p, &pdf);
    rgb value = rgb_mul(path_bounce_eval(p, v, wi, &pdf), sky_radiance(s, wi));
    if (!(pdf > 0.0f) || !path_faces(v, wi) || rgb_is_black(value))
        return;
    container_set set = p->inside;
    rgb left = shadow_transmittance(s, &set, true, path_origin(v, wi), wi,
                                    s->far, &p->random, p->count);
    if (sky_is_light(s))
        pdf += sky_pdf(s, wi);
    path_add(p, rgb_scale(rgb_mul(p->beta, rgb_mul(value, left)), 1.0f / pdf));
}

/* The sky at the end of a path. */
HD void path_escape(const flat_scene *s, path_state *p)
{
    if (p->straight || !s->environment)
        return;
    rgb value = sky_radiance(s, p->d);
    if (p->p_dir > 0.0f && sky_is_light(s))
        value = rgb_scale(value, 1.0f / (1.0f + sky_pdf(s, p->d) / p->p_dir));
    path_add(p, rgb_mul(p->beta, value));
}

HD bool path_medium_at(const flat_scene *s, const container_set *set,
                       int medium)
{
    for (int i = -1; i < container_count(set); i++) {
        int32_t interior = container_interior(s, set, i);
        if (interior < 0)
            continue;
        const flat_interior *in = &s->interiors[interior];
        for (int k = 0; k < in->count; k++)
            if (s->interior_media[in->first + k] == medium)
                return true;
    }
    return false;
}

/* Next-event estimation to the emitting voxels of media. */
HD void path_glow(const flat_scene *s, path_state *p, const path_vertex *v)
{
    if (!scene_may(MAY_EMISSION) || s->glows_count == 0)
        return;
    glow_sample g = glow_choose(s, &p->random);
    vec3 to = vec3_sub(g.p, v->p);
    float t = vec3_length(to), pdf;
    if (!(t > 0.0f) || !(g.pdf > 0.0f))
        return;
    vec3 wi = vec3_scale(to, 1.0f / t);
    if (!path_faces(v, wi))
        return;
    rgb value = path_bounce_eval(p, v, wi, &pdf);
    if (rgb_is_black(value))
        return;
    const flat_medium *m = &s->media[g.medium];
    field_point x = field_point_make(s, m->lead, g.p);
    rgb q = medium_source(s, m, &x, medium_density(s, m, &x));
    if (rgb_is_black(q))
        return;
    container_set set = p->inside;
    rgb left = shadow_transmittance(s, &set, true, path_origin(v, wi), wi, t,
                                    &p->random, p->count);
    if (!path_medium_at(s, &set, g.medium))
        return;
    value = rgb_mul(rgb_mul(value, q), left);
    /* 1 / (pdf t^2) times glow_ray_share's complement. */
    float weight = 1.0f / (g.pdf * t * t + pdf * m->kappa);
    path_add(p, rgb_scale(rgb_mul(p->beta, value), weight));
}

/* Whether the media around the ray do nothing but emit. */
HD bool path_passes_media(const flat_scene *s, const container_set *set)
{
    for (int i = -1; i < container_count(set); i++) {
        int32_t interior = container_interior(s, set, i);
        for (int k = 0; interior >= 0 && k < s->interiors[interior].count;
             k++) {
            const flat_medium *m = &s->media[
                s->interior_media[s->interiors[interior].first + k]];
            if (!rgb_is_black(m->sigma_t) || !rgb_is_black(m->sigma_s))
                return false;
        }
    }
    return true;
}

HD int path_media(const flat_scene *s, path_state *p, float t1,
                  path_event *event)
{
    media_walk w;
    /* On the straight line from the eye emission is march.h's. */
    if (p->straight && path_passes_media(s, &p->inside))
        return PATH_THROUGH;
    walk_begin(s, &w, &p->inside, true, p->o, p->d, p->after.t, t1);
    p->count->overflow += w.overflow;
    if (w.count == 0)
        return PATH_THROUGH;
    if (scene_may(MAY_CLEAR) && !path_walk_scatters(s, &w))
        return path_line(s, p, &w, p->after.t, t1);
    p->boost = 1.0f;
    if (p->straight || path_has_lamps(s))
        path_look(s, p, t1);
    if (scene_may(MAY_LAMPS) && p->stretch.on && !s->field.single)
        path_along(s, p);
    return path_track(s, p, &w, event);
}

/* ---- vertices ---------------------------------------------------------- */

HD void path_turn(path_state *p, vec3 o, vec3 d, float pdf)
{
    p->o = o;
    p->d = d;
    p->p_dir = pdf;
    p->after = hit_start(0.0f);
    p->straight = 0;
    p->depth = -1.0f;
    p->spread -= p->spread > 0;
    p->stretch.on = 0;
    p->aim.share = 0.0f;
}

/* Below a fourth of what it set out with a path may end. */
#define PATH_KEEPS 4.0f

/* Russian roulette on the throughput where it is below 1 / `keeps`; false ends
 * the path. */
HD bool path_survives(path_state *p, float keeps)
{
    float throughput = rgb_size(p->beta) / rgb_mean(may_gray(p->r_u));
    if (!(throughput > 0.0f))
        return false;
    throughput *= keeps;
    if (throughput >= 1.0f)
        return true;
    float q = hd_max(throughput, 0.05f);
    if (!rng_chance(&p->random, q))
        return false;
    p->beta = rgb_scale(p->beta, 1.0f / q);
    return true;
}

/* Near lamps throughput tells little of what is to come: paths go on. */
HD bool path_goes_on(const flat_scene *s, path_state *p)
{
    return path_survives(p, path_has_lamps(s) ? 32.0f : PATH_KEEPS);
}

/* Thickness of all media at x, as a field of balls counts it. */
HD float path_thickness(const flat_scene *s, const container_set *set, vec3 x)
{
    float sum = 0.0f;
    for (int i = -1; i < container_count(set); i++) {
        int32_t interior = container_interior(s, set, i);
        for (int k = 0; interior >= 0 && k < s->interiors[interior].count;
             k++) {
            const flat_medium *m = &s->media[
                s->interior_media[s->interiors[interior].first + k]];
            field_point at = field_point_make(s, m->lead, x);
            sum += radiance_thickness(m, medium_density(s, m, &at));
        }
    }
    return sum;
}

/* All light but the lights' own, where a field holds it. The straight line
 * gathers it by itself. */
HD void path_field(const flat_scene *s, path_state *p, const path_vertex *v)
{
    if (p->straight)
        return;
    radiance_point x = radiance_at(s, v->p, s->field.ball ? 0
                                                         : RADIANCE_ANYWHERE);
    if (s->field.ball) {
        /* Toward the eye: all that there is. */
        float scale = path_thickness(s, &p->inside, v->p) / v->event->sigma_s;
        path_add(p, rgb_scale(rgb_mul(p->beta, x.eye), scale));
        return;
    }
    rgb light = radiance_toward(&x, v->medium->phase, v->medium->g,
                                vec3_scale(v->d, -1.0f));
    path_add(p, rgb_mul(p->beta, light));
}

/* Goes on from a vertex: off a surface diffusely. A medium's directions alone
 * have the density of the phase function, and leave the weight as it is. */
HD bool path_bounce(const flat_scene *s, path_state *p, const path_vertex *v)
{
    float pdf;
    vec3 d = path_bounce_choose(v, p, &pdf);
    if (v->on_surface || path_aim_share(p) > 0.0f) {
        if (!path_faces(v, d))
            return false;
        rgb value = path_bounce_eval(p, v, d, &pdf);
        if (!(pdf > 0.0f))
            return false;
        p->beta = rgb_mul(p->beta, rgb_scale(value, 1.0f / pdf));
    }
    path_turn(p, path_origin(v, d), d, pdf);
    return path_goes_on(s, p);
}

/* Light that comes to a vertex, and the way on from there; false: there is
 * none. */
HD bool path_visit(const flat_scene *s, path_state *p, const path_vertex *v)
{
    bool goes_on = v->on_surface ? s->surfaces_indirect : s->media_multiple;
    if (v->on_surface || !s->field.single)
        path_light(s, p, v);
    if (!v->on_surface && s->field.numbers > 0 &&
        (p->straight || !s->field.straight)) {
        path_field(s, p, v);
        return false;
    }
    if (goes_on) {
        path_aim(s, p, v);
        path_glow(s, p, v);
    }
    path_sky(s, p, v);
    if (goes_on)
        return path_bounce(s, p, v);
    path_sky_rest(s, p, v);
    return false;
}

/* Chooses between passing straight through and the surface's own light in
 * proportion to what each may give; true: pass. */
HD bool path_passes(path_state *p, const hit_point *h)
{
    float pass = rgb_max(h->pass), stay = h->opacity;
    /* A highlight stands on clear glass too. */
    if (surface_has_highlight(h->material))
        stay = hd_max(stay, 0.25f);
    if (!(pass > 0.0f))
        return false;
    if (!(stay > 0.0f)) {
        p->beta = rgb_mul(p->beta, h->pass);
        return true;
    }
    float chance = pass / (pass + stay);
    bool passes = rng_chance(&p->random, chance);
    p->beta = passes ? rgb_mul(p->beta, rgb_scale(h->pass, 1.0f / chance))
                     : rgb_scale(p->beta, 1.0f / (1.0f - chance));
    return passes;
}

/* Crosses the surface of a hit; or PATH_SCATTERED, and *at tells what is
 * there. */
HD int path_surface(const flat_scene *s, path_state *p, const bvh_ray *r,
                    const ray_hit *h, hit_point *at)
{
    if (hit_material(s, h) >= 0) {
        *at = hit_resolve(s, r, h);
        if (!path_passes(p, at))
            return PATH_SCATTERED;
    }
    shadow_cross(s, h, &p->inside);
    p->after = *h;
    return rgb_is_black(p->beta) ? PATH_ENDED : PATH_THROUGH;
}

/* ---- the path ---------------------------------------------------------- */

/* Whether the plate ends the segment, and not its hit. */
HD bool path_meets_plate(const path_state *p, const plate_view *plate,
                         ray_hit *h)
{
    return p->straight && plate_cuts(plate, h);
}

/* What the plate leaves of the path; false: nothing. Its own light is
 * march.h's. */
HD bool path_plate(path_state *p, plate_view *plate)
{
    p->beta = rgb_scale(p->beta, plate->pass);
    plate_cross(plate, &p->after);
    return !rgb_is_black(p->beta);
}

/* What a segment may lead to. */
typedef struct {
    bvh_ray ray;
    ray_hit hit;
    bool covered;           /* the plate that the eye's ray has ahead ends it */
    path_event event;       /* where media scatter, if they do             */
} path_ahead;

/* Seeks the next surface, or the plate. */
HD void path_seek(const flat_scene *s, path_state *p, const plate_view *plate,
                  track_counters *count, path_ahead *to)
{
    p->count = count;
    p->count->rays++;
    to->ray = bvh_ray_make(p->o, p->d);
    to->hit = bvh_nearest(s, &to->ray, &p->after, s->far);
    if (to->hit.shape < 0)
        container_leave_bounded(s, &p->inside);
    to->covered = path_meets_plate(p, plate, &to->hit);
}

/* What is at the end of a segment without events: a surface where the path
 * stays, PATH_SCATTERED, or one that it crosses, or nothing. */
HD int path_arrive(const flat_scene *s, path_state *p, plate_view *plate,
                   const path_ahead *to, hit_point *at)
{
    if (to->covered)
        return path_plate(p, plate) ? PATH_THROUGH : PATH_ENDED;
    if (to->hit.shape >= 0)
        return path_surface(s, p, &to->ray, &to->hit, at);
    path_escape(s, p);
    return PATH_ENDED;
}

/* Takes the event of a segment, or what is at its end. False: the path has
 * ended. */
HD bool path_land(const flat_scene *s, path_state *p, plate_view *plate,
                  const path_ahead *to, int event)
{
    path_vertex v;
    hit_point at;
    v.d = p->d;
    if (event == PATH_SCATTERED) {
        v.on_surface = false;
        v.p = vec3_mad(p->o, to->event.t, p->d);
        v.medium = &s->media[to->event.medium];
        v.event = &to->event;
        return path_visit(s, p, &v);
    }
    if (event == PATH_THROUGH)
        event = path_arrive(s, p, plate, to, &at);
    if (event != PATH_SCATTERED)
        return event == PATH_THROUGH;
    v.on_surface = true;
    v.p = at.p;
    v.surface = &at;
    path_add(p, rgb_mul(p->beta, surface_glow(at.material, at.color,
                                              at.opacity)));
    return path_visit(s, p, &v);
}

/* One segment without a plate: to the next event or surface. False: the path
 * has ended. */
HD bool path_segment(const flat_scene *s, path_state *p,
                     track_counters *count)
{
    plate_view none = plate_none();
    path_ahead to;
    path_seek(s, p, &none, count, &to);
    int event = path_media(s, p, to.hit.t, &to.event);
    return path_land(s, p, &none, &to, event);
}

/* Starts a path at o (containers `inside`) along the unit vector d. A path
 * that is not `straight` finds all emission itself. */
HD void path_begin(path_state *p, vec3 o, vec3 d, const container_set *inside,
                   bool straight, rng random)
{
    p->beta = p->r_u = rgb_gray(1.0f);
    p->radiance = rgb_gray(0.0f);
    p->random = random;
    p->driver = (int32_t)(rng_float(&p->random) * 3.0f);
    p->inside = *inside;
    p->spread = 0;
    path_turn(p, o, d, 0.0f);
    p->straight = straight;
}

#endif
