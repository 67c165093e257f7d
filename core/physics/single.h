/* single.h - light that media scatter once, sampled along the eye's ray.
 *
 * Where nothing is followed beyond the first event and lights do not fall off
 * with distance, or a field holds what is, no flights are drawn: the ray goes
 * on to the next surface, and each light is sought at points of the stretch
 * that it can reach, chosen by a profile of how much is scattered there and
 * comes through.
 *
 * Where the field's cells hold the light straight from lights (`lit`), the
 * straight line gathers that without noise (march.h), and what is sampled here
 * is what it is wrong by: the light at a point less that of the cells. The
 * cells are a control variate, and change nothing but the noise. */
#ifndef CORE_PHYSICS_SINGLE_H
#define CORE_PHYSICS_SINGLE_H
#include "core/physics/single_profile.h"

enum { SINGLE_POINTS = 2 };

/* ---- the stretch that a light reaches ---------------------------------- */

/* Where a ray leaves a spotlight's cone or a cylinder's tube: the roots of a
 * quadratic a t^2 + 2 b t + c. */
HD int single_roots(float a, float b, float c, float *t)
{
    float root = b * b - a * c;
    if (!(root > 0.0f))
        return 0;
    float q = -(b + copysignf(sqrtf(root), b));
    t[0] = q / a;
    t[1] = c / q;
    return 2;
}

/* The same of the ray o + t d and a light; how many, and 0 where it may shine
 * all along. */
HD int single_edges(const flat_light *l, vec3 o, vec3 d, float *t)
{
    vec3 from = vec3_sub(o, l->position);
    float along = vec3_dot(from, l->axis), turn = vec3_dot(d, l->axis);
    if (l->kind == LIGHT_SPOT && !l->parallel) {
        float edge = hd_max(hd_min(l->outer, l->inner), 0.0f);
        float e = edge * edge;
        return single_roots(turn * turn - e,
                            turn * along - e * vec3_dot(from, d),
                            along * along - e * vec3_dot(from, from), t);
    }
    if (l->kind != LIGHT_CYLINDER)
        return 0;
    vec3 off = vec3_mad(from, -along, l->axis);
    vec3 move = vec3_mad(d, -turn, l->axis);
    int n = single_roots(vec3_dot(move, move), vec3_dot(off, move),
                         vec3_dot(off, off) - l->outer * l->outer, t);
    t[n] = -along / turn;
    return n + 1;
}

/* Cuts [*a, *b] to where the light may shine; false: nowhere. What is lit is
 * convex: it lies between some of the edges, whose middles tell. */
HD bool single_lit(const flat_scene *s, const flat_light *l, vec3 o, vec3 d,
                   float *a, float *b)
{
    if ((l->kind == LIGHT_POINT) || (l->kind == LIGHT_SPOT && l->parallel) ||
        l->illumination)
        return true;
    float t[5], first = INFINITY, last = -INFINITY;
    int n = 1;
    t[0] = *a;
    float edge[3];
    int edges = single_edges(l, o, d, edge);
    for (int i = 0; i < edges; i++) {
        if (!(edge[i] > *a && edge[i] < *b))
            continue;
        int k = n++;
        for (; k > 1 && t[k - 1] > edge[i]; k--)
            t[k] = t[k - 1];
        t[k] = edge[i];
    }
    t[n] = *b;
    for (int i = 0; i < n; i++) {
        vec3 x = vec3_mad(o, 0.5f * (t[i] + t[i + 1]), d);
        float distance;
        vec3 wi = light_toward(l, l->position, x, &distance);
        if (!(light_factor(s, l, l->position, x, wi, distance) > 0.0f))
            continue;
        first = hd_min(first, t[i]);
        last = hd_max(last, t[i + 1]);
    }
    if (!(first < last))
        return false;
    /* Rounding of the edges. */
    float slack = 1e-3f * (last - first);
    *a = hd_max(*a, first - slack);
    *b = hd_min(*b, last + slack);
    return true;
}

/* ---- light ------------------------------------------------------------- */

/* What passes of the eye's ray up to a place. Where the profile does not know
 * it and media are thick, ratio tracking takes as long as the integral, and
 * makes most of the noise: of a cloud, a fourth part of the variance is left in
 * the same time. */
HD rgb single_passes(const flat_scene *s, path_state *p,
                     const single_profile *f, const single_spot *at)
{
    float t = at->t;
    if (!f->coarse && f->gray)
        return rgb_gray(fm_exp(-at->depth));
    if (!f->thick)
        return track_transmittance(s, &p->inside, true, p->o, p->d,
                                   p->after.t, t, &p->random, p->count);
    line_integral line = line_zero();
    line_integrate(s, &p->inside, p->o, p->d, p->after.t, t, 0.0f, false,
                   false, line_jitter_make(0.5f, 0.5f), &line);
    return line_transmittance(&line);
}

/* What comes of the light of a sample. */
HD rgb single_comes(const flat_scene *s, path_state *p,
                    const single_profile *f, const path_vertex *v,
                    const light_sample *l)
{
    if (!f->thick || !s->lights[l->light].shadows)
        return path_lit(s, p, v, l);
    container_set set = p->inside;
    p->count->shadow_rays++;
    return rgb_mul(l->color, shadow_line(s, &set, v->p, l->shadow_wi,
                                         l->shadow_distance,
                                         line_jitter_make(0.5f, 0.5f)));
}

/* Adds what light i gives at a place, over the density of its choice. */
HD void single_point(const flat_scene *s, path_state *p,
                     const single_profile *f, int i, const single_spot *at,
                     float density)
{
    float t = at->t;
    path_vertex v;
    light_sample l;
    float sigma_s;
    v.p = vec3_mad(p->o, t, p->d);
    v.on_surface = false;
    if (!light_reach(s, i, v.p, &p->random, &l))
        return;
    rgb value = rgb_scale(path_scattered(s, p, t, l.wi, &sigma_s),
                          1.0f / density);
    p->count->lookups++;
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, single_passes(s, p, f, at));
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, single_comes(s, p, f, &v, &l));
    p->count->collisions++;
    path_add(p, rgb_mul(p->beta, value));
}

/* All of light i along the profile. */
HD void single_light(const flat_scene *s, path_state *p,
                     const single_profile *f, int i, float u)
{
    const flat_light *l = &s->lights[i];
    float a = f->t[0], b = f->t[f->count];
    if (!l->media_interaction || rgb_is_black(l->color) ||
        !single_lit(s, l, p->o, p->d, &a, &b))
        return;
    float before = 0.0f, all = f->sum[f->count];
    if (b < f->t[f->count])
        all = single_at(s, p, f, b).sum;
    if (a > f->t[0])
        before = single_at(s, p, f, a).sum;
    all -= before;
    if (!(all > 0.0f))
        return;
    for (int k = 0; k < SINGLE_POINTS; k++) {
        float share = ((float)k + u) / (float)SINGLE_POINTS;
        single_spot at = single_place(s, p, f, before + share * all);
        if (at.density > 0.0f)
            single_point(s, p, f, i, &at,
                         at.density * (float)SINGLE_POINTS / all);
    }
}

/* What one light gives at x, of which `toward` it does; black where it does not
 * come. */
HD rgb single_arrives(const flat_scene *s, path_state *p, int light, vec3 x,
                      vec3 *toward)
{
    light_sample l;
    *toward = p->d;
    if (!s->lights[light].media_interaction ||
        !light_reach(s, light, x, &p->random, &l))
        return rgb_gray(0.0f);
    *toward = l.wi;
    if (!s->lights[light].shadows)
        return l.color;
    container_set set = p->inside;
    p->count->shadow_rays++;
    return rgb_mul(l.color, shadow_line(s, &set, x, l.shadow_wi,
                                        l.shadow_distance,
                                        line_jitter_draw(s, &p->random)));
}

/* What a medium of scattering sigma scatters to the eye of the cells' light
 * straight from lights at distance t. */
HD rgb single_cells(const flat_scene *s, const path_state *p, float t)
{
    vec3 x = vec3_mad(p->o, t, p->d);
    rgb sum = rgb_gray(0.0f), lit = sum;
    int read = RADIANCE_ANYWHERE;
    for (int i = -1; i < container_count(&p->inside); i++) {
        int32_t interior = container_interior(s, &p->inside, i);
        for (int k = 0; interior >= 0 && k < s->interiors[interior].count;
             k++) {
            const flat_medium *m = scene_medium(
                s, s->interior_media[s->interiors[interior].first + k]);
            field_point at = medium_point(s, m, x);
            rgb sigma = rgb_mul(m->sigma_s, medium_density(s, m, &at));
            if (rgb_is_black(sigma))
                continue;
            if (read != m->kind)
                lit = radiance_lit(s, x, m->kind);
            read = m->kind;
            sum = rgb_add(sum, rgb_mul(sigma, lit));
        }
    }
    return sum;
}

/* What the cells are wrong by. */
HD_APART rgb single_error(const flat_scene *s, path_state *p, float t)
{
    vec3 x = vec3_mad(p->o, t, p->d), wi;
    float sigma_s;
    rgb sum = rgb_scale(single_cells(s, p, t), -1.0f);
    p->count->lookups++;
    for (int i = 0; i < (int)s->lights_count; i++) {
        rgb in = single_arrives(s, p, i, x, &wi);
        if (!rgb_is_black(in))
            sum = rgb_add(sum, rgb_mul(in, path_scattered(s, p, t, wi,
                                                          &sigma_s)));
    }
    return sum;
}

HD equiangular single_angles(const path_state *p, const single_profile *f,
                             const flat_light *l)
{
    return equiangular_make(p->o, p->d, f->t[0], f->t[f->count], l->position,
                            l->blunt);
}

/* What a light that falls off has of the places where the error is sought:
 * half of them go to the lights, by their shares. */
HD float single_lamp_share(const flat_scene *s, int i)
{
    float before = i > 0 ? s->lights[i - 1].cumulative : 0.0f;
    bool lamp = s->lights[i].local && s->lights[i].media_interaction;
    return lamp ? 0.5f * (s->lights[i].cumulative - before) : 0.0f;
}

/* Density per length with which single_seek_lamps takes a place. */
HD float single_density(const flat_scene *s, const path_state *p,
                        const single_profile *f, const single_spot *at)
{
    float lamps = 0.0f, density = 0.0f;
    for (int i = 0; i < (int)s->lights_count; i++) {
        float share = single_lamp_share(s, i);
        if (!(share > 0.0f))
            continue;
        equiangular e = single_angles(p, f, &s->lights[i]);
        lamps += share;
        density += share * equiangular_pdf(&e, at->t);
    }
    return density + (1.0f - lamps) * at->density / f->sum[f->count];
}

/* A place for u in [0, 1) by the profile, or by the angles of a light that
 * falls off: near it cells are worst. */
HD single_spot single_seek_lamps(const flat_scene *s, const path_state *p,
                                 const single_profile *f, float u)
{
    float left = 1.0f;
    for (int i = 0; i < (int)s->lights_count; i++) {
        float share = single_lamp_share(s, i);
        if (u < share) {
            equiangular e = single_angles(p, f, &s->lights[i]);
            return single_at(s, p, f, equiangular_sample(&e, u / share));
        }
        u -= share;
        left -= share;
    }
    return single_place(s, p, f, hd_min(u / left, 1.0f) * f->sum[f->count]);
}

/* Where what the cells are wrong by is sought, and how densely. */
HD single_spot single_seek(const flat_scene *s, const path_state *p,
                           const single_profile *f, float u, float *density)
{
    float all = f->sum[f->count];
    if (scene_may(MAY_LAMPS) && s->local_lights) {
        single_spot at = single_seek_lamps(s, p, f, u);
        *density = single_density(s, p, f, &at);
        return at;
    }
    single_spot at = single_place(s, p, f, u * all);
    *density = at.density / all;
    return at;
}

/* Adds it, at the share `u` of the places where it may be. */
HD void single_rest(const flat_scene *s, path_state *p,
                    const single_profile *f, float u)
{
    float density;
    single_spot at = single_seek(s, p, f, u, &density);
    if (!(density > 0.0f))
        return;
    rgb value = rgb_scale(single_error(s, p, at.t), 1.0f / density);
    if (rgb_is_black(value))
        return;
    value = rgb_mul(value, single_passes(s, p, f, &at));
    p->count->collisions++;
    path_add(p, rgb_mul(p->beta, value));
}

/* Whether nothing gives light behind a surface that is a boundary of media
 * alone: what passes them is no matter then. */
HD bool single_is_last(const flat_scene *s, const path_state *p,
                       const bvh_ray *r, const ray_hit *h)
{
    if (s->atmosphere >= 0 || hit_material(s, h) >= 0)
        return false;
    container_set set = p->inside;
    shadow_cross(s, h, &set);
    if (set.count > 0)
        return false;
    p->count->rays++;
    return bvh_nearest(s, r, h, s->far).shape < 0;
}

/* What the media of a segment let pass up to t; `all`: and what comes along it
 * of their emission and the cells' light. */
HD_APART line_integral single_line(const flat_scene *s,
                                   const container_set *set, vec3 o, vec3 d,
                                   float t0, float t1, float p_dir, bool all,
                                   line_jitter jitter)
{
    line_integral line = line_zero();
    line_integrate(s, set, o, d, t0, t1, p_dir, all, all, jitter, &line);
    return line;
}

HD line_integral single_along(const flat_scene *s, path_state *p, float t,
                              bool all)
{
    const container_set *set = &p->inside;
    HD_COPY(container_set, set);
    line_jitter jitter = line_jitter_draw(s, &p->random);
    return single_line(s, HD_COPIED(set), p->o, p->d, p->after.t, t, p->p_dir,
                       all, jitter);
}

/* Whether the eye's rays need no flights. */
HD bool single_does(const flat_scene *s)
{
    bool once = s->field.numbers > 0 ? !s->field.single
                                     : !s->media_multiple && !s->environment;
    return scene_may(MAY_SINGLE) && s->scatters && once &&
           (!s->local_lights || s->field.lit);
}

/* Whether rays that a surface sends on gather the cells as the eye's do: where
 * these hold what goes anywhere. */
HD bool single_follows(const flat_scene *s)
{
    return scene_may(MAY_FIELD) && s->field.lit && s->field.eye < 0;
}

/* Light that media scatter once along a segment. A surface's ray has no place
 * of its own to look at. */
HD void single_scatter(const flat_scene *s, path_state *p, float t1)
{
    single_profile f;
    if (!single_look(s, p, t1, &f))
        return;
    if (!p->straight || s->field.lit) {
        single_rest(s, p, &f, p->straight ? p->along : rng_float(&p->random));
        return;
    }
    for (int i = 0; i < (int)s->lights_count; i++) {
        float u = p->along + 0.61803399f * (float)i;
        single_light(s, p, &f, i, u - (float)hd_floor(u));
    }
}

/* Whether nothing that is behind a segment of the eye's ray gives light. */
HD bool single_ends(const flat_scene *s, const path_state *p,
                    const plate_view *plate, const path_ahead *to)
{
    if (to->covered)
        return !(plate->pass > 0.0f);
    return to->hit.shape < 0 || single_is_last(s, p, &to->ray, &to->hit);
}

/* In place of path_media: what is scattered up to the next surface, and what
 * passes. What a surface sends on gathers the cells' light along it too. */
HD int single_media(const flat_scene *s, path_state *p,
                    const plate_view *plate, const path_ahead *to)
{
    single_scatter(s, p, to->hit.t);
    if (p->straight && single_ends(s, p, plate, to))
        return PATH_ENDED;
    line_integral line = single_along(s, p, to->hit.t, !p->straight);
    if (!p->straight)
        path_add(p, rgb_mul(p->beta, line.radiance));
    p->beta = rgb_mul(p->beta, line_transmittance(&line));
    return rgb_is_black(p->beta) ? PATH_ENDED : PATH_THROUGH;
}

/* One segment: to the next event or surface, or the plate that the eye's ray
 * has ahead. False: the path has ended. */
HD bool single_segment(const flat_scene *s, path_state *p, plate_view *plate,
                       track_counters *count)
{
    path_ahead to;
    path_seek(s, p, plate, count, &to);
    bool all = single_does(s) && (p->straight || single_follows(s));
    int event = all ? single_media(s, p, plate, &to)
                    : path_media(s, p, to.hit.t, &to.event);
    return path_land(s, p, plate, &to, event);
}

#endif
