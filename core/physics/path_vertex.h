/* path_vertex.h - light that reaches a vertex of a path: lights, the sky and
 * glowing media, each sought along a connection (see path.h). */
#ifndef CORE_PHYSICS_PATH_VERTEX_H
#define CORE_PHYSICS_PATH_VERTEX_H
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

/* A line along which light comes to a vertex, and what the path has of that
 * light where all of it passes. */
typedef struct {
    vec3 o, d;
    float distance;
    int32_t how;            /* CONNECTION_*                                */
    int32_t atmosphere;     /* its medium takes light too                  */
    int32_t medium;         /* the light's, which is where it ends; or -1  */
    rgb value, color;       /* of both the product                         */
    float weight;
} path_connection;

/* How it is known what passes: all does; by ratio tracking; or, where a field
 * takes the noise of the rest and a surface's light has none either, by the
 * line integral. */
enum { CONNECTION_FREE, CONNECTION_TRACKED, CONNECTION_EXACT };

/* To where the light of a sample comes from. */
HD void path_connect_lamp(const flat_scene *s, const path_vertex *v,
                          const light_sample *l, path_connection *c)
{
    const flat_light *light = &s->lights[l->light];
    c->d = l->shadow_wi;
    c->o = path_origin(v, l->shadow_wi);
    c->distance = l->shadow_distance;
    c->atmosphere = s->media_multiple || light->media_attenuation != 0;
    c->medium = -1;
    c->color = l->color;
    c->weight = 1.0f / l->probability;
    c->how = CONNECTION_TRACKED;
    if (!light->shadows)
        c->how = CONNECTION_FREE;
    else if (scene_may(MAY_FIELD) && s->field.numbers > 0 && v->on_surface &&
             c->atmosphere)
        c->how = CONNECTION_EXACT;
}

/* To what lies in direction d, at that distance. */
HD void path_connect(const path_vertex *v, vec3 d, float distance, rgb value,
                     float weight, path_connection *c)
{
    c->d = d;
    c->o = path_origin(v, d);
    c->distance = distance;
    c->how = CONNECTION_TRACKED;
    c->atmosphere = true;
    c->medium = -1;
    c->value = value;
    c->color = rgb_gray(1.0f);
    c->weight = weight;
}

/* What passes along a connection that is not tracked. */
HD rgb path_passes_plainly(const flat_scene *s, path_state *p,
                           const path_connection *c)
{
    if (c->how == CONNECTION_FREE)
        return rgb_gray(1.0f);
    container_set set = p->inside;
    p->count->shadow_rays++;
    return path_lit_line(s, &set, c->o, c->d, c->distance,
                         line_jitter_draw(s, &p->random));
}

/* What passes along a connection; *set: the containers at its end. */
HD rgb path_passes_along(const flat_scene *s, path_state *p,
                         const path_connection *c, container_set *set)
{
    if (c->how != CONNECTION_TRACKED)
        return path_passes_plainly(s, p, c);
    return shadow_transmittance(s, set, c->atmosphere, c->o, c->d, c->distance,
                                &p->random, p->count);
}

/* What passes of the light of a sample. */
HD rgb path_lit(const flat_scene *s, path_state *p, const path_vertex *v,
                const light_sample *l)
{
    path_connection c;
    container_set set = p->inside;
    path_connect_lamp(s, v, l, &c);
    return rgb_mul(l->color, path_passes_along(s, p, &c, &set));
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

/* How the light of a sample comes to a vertex; false: nothing comes. */
HD bool path_light_sample(const flat_scene *s, const path_state *p,
                          const path_vertex *v, const light_sample *l,
                          path_connection *c)
{
    const flat_light *light = &s->lights[l->light];
    if (!path_faces(v, l->wi) ||
        (!v->on_surface && !light->media_interaction))
        return false;
    c->value = path_response(s, v, l->wi, light->shadows);
    if (!v->on_surface)
        c->value = rgb_scale(c->value, 1.0f -
            path_along_share(p, light, v->event->t, v->event->sigma_s));
    path_connect_lamp(s, v, l, c);
    return !rgb_is_black(c->value);
}

/* Which lights are sought from a vertex: one of them; on surfaces that the eye
 * sees, all; where a field holds their light in media, none. */
typedef struct {
    int32_t next, end;
    float probability;
} path_lights;

HD path_lights path_lights_choose(const flat_scene *s, path_state *p,
                                  const path_vertex *v)
{
    path_lights l;
    l.next = 0;
    l.end = (int)s->lights_count;
    l.probability = 1.0f;
    if (!v->on_surface && s->field.single)
        l.end = 0;
    if (l.end > 0 && !(v->on_surface && p->straight)) {
        l.next = light_find(s, rng_float(&p->random), &l.probability);
        l.end = l.probability > 0.0f ? l.next + 1 : l.next;
    }
    return l;
}

/* Next-event estimation to the next of them that gives light there; false:
 * there is none more. */
HD bool path_light_next(const flat_scene *s, path_state *p,
                        const path_vertex *v, path_lights *lights,
                        path_connection *c)
{
    light_sample l;
    l.probability = lights->probability;
    while (lights->next < lights->end)
        if (light_reach(s, lights->next++, v->p, &p->random, &l) &&
            path_light_sample(s, p, v, &l, c))
            return true;
    return false;
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

/* What media take away per length, as the last stretch of them on the way to a
 * vertex tells; 0 where there was none. */
HD float path_extinction(const path_state *p, const path_vertex *v)
{
    if (p->stretch.on)
        return p->stretch.extinction;
    return v->on_surface ? 0.0f : v->event->sigma_s;
}

/* Where a path goes on from a vertex, a lamp that is near chooses the more of
 * its directions the more is scattered there from the lamp's. Some mean free
 * paths away none: such flights do not come near it, and the weights of
 * hundreds of vertices, multiplied, would be so uneven that a picture's light
 * came by next to no path: a white ball of optical radius 20 around a lamp had
 * a tenth of it. */
HD void path_aim(const flat_scene *s, path_state *p, const path_vertex *v)
{
    const float most = 0.5f, fall = 0.3f;
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
    p->aim.share = most * hd_min(4.0f * FM_PI * pdf, 1.0f) *
                   fm_exp(-fall * path_extinction(p, v) * distance);
}

/* Next-event estimation to the sky; false: it is none. Bounces that find it
 * weigh by the rest. */
HD bool path_sky(const flat_scene *s, path_state *p, const path_vertex *v,
                 path_connection *c)
{
    if (!sky_is_light(s))
        return false;
    float chosen, pdf;
    vec3 wi = sky_choose(s, &p->random, &chosen);
    if (!(chosen > 0.0f) || !path_faces(v, wi))
        return false;
    rgb value = rgb_mul(path_bounce_eval(p, v, wi, &pdf), sky_radiance(s, wi));
    path_connect(v, wi, s->far, value, 1.0f / (chosen + pdf), c);
    return !rgb_is_black(value);
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
 * does; false: nothing. */
HD bool path_sky_rest(const flat_scene *s, path_state *p, const path_vertex *v,
                      path_connection *c)
{
    float pdf;
    if (!s->environment)
        return false;
    vec3 wi = path_bounce_choose(v, p, &pdf);
    rgb value = rgb_mul(path_bounce_eval(p, v, wi, &pdf), sky_radiance(s, wi));
    if (!(pdf > 0.0f) || !path_faces(v, wi) || rgb_is_black(value))
        return false;
    if (sky_is_light(s))
        pdf += sky_pdf(s, wi);
    path_connect(v, wi, s->far, value, 1.0f / pdf, c);
    return true;
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

/* Next-event estimation to the emitting voxels of media; false: none gives
 * light. */
HD bool path_glow(const flat_scene *s, path_state *p, const path_vertex *v,
                  path_connection *c)
{
    if (!scene_may(MAY_EMISSION) || s->glows_count == 0)
        return false;
    glow_sample g = glow_choose(s, &p->random);
    vec3 to = vec3_sub(g.p, v->p);
    float t = vec3_length(to), pdf;
    if (!(t > 0.0f) || !(g.pdf > 0.0f))
        return false;
    vec3 wi = vec3_scale(to, 1.0f / t);
    if (!path_faces(v, wi))
        return false;
    rgb value = path_bounce_eval(p, v, wi, &pdf);
    if (rgb_is_black(value))
        return false;
    const flat_medium *m = &s->media[g.medium];
    field_point x = field_point_make(s, m->lead, g.p);
    rgb q = medium_source(s, m, &x, medium_density(s, m, &x));
    if (rgb_is_black(q))
        return false;
    /* 1 / (pdf t^2) times glow_ray_share's complement. */
    float weight = 1.0f / (g.pdf * t * t + pdf * m->kappa);
    path_connect(v, wi, t, rgb_mul(value, q), weight, c);
    c->medium = g.medium;
    return true;
}

/* Adds the light of a connection along which so much passes, and at whose end
 * these containers are. */
HD void path_receive(const flat_scene *s, path_state *p,
                     const path_connection *c, rgb left,
                     const container_set *set)
{
    if (scene_may(MAY_EMISSION) && c->medium >= 0 &&
        !path_medium_at(s, set, c->medium))
        return;
    rgb value = rgb_mul(c->value, rgb_mul(c->color, left));
    path_add(p, rgb_scale(rgb_mul(p->beta, value), c->weight));
}

HD void path_follow(const flat_scene *s, path_state *p,
                    const path_connection *c)
{
    container_set set = p->inside;
    rgb left = path_passes_along(s, p, c, &set);
    path_receive(s, p, c, left, &set);
}

/* All that lights give there by next-event estimation. */
HD void path_light(const flat_scene *s, path_state *p, const path_vertex *v)
{
    path_connection c;
    path_lights lights = path_lights_choose(s, p, v);
    while (path_light_next(s, p, v, &lights, &c))
        path_follow(s, p, &c);
}

#endif
