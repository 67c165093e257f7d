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
#include "core/physics/path_vertex.h"

/* ---- media between two surfaces ---------------------------------------- */

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

/* Begins the line of a flight; false: no flight is to be drawn, and *event is
 * how the segment ends. */
HD bool path_sets_out(const flat_scene *s, path_state *p, float t1,
                      track_line *l, int *event)
{
    media_walk *w = &l->walk;
    *event = PATH_THROUGH;
    /* On the straight line from the eye emission is march.h's. */
    if (p->straight && path_passes_media(s, &p->inside))
        return false;
    walk_begin(s, w, &p->inside, true, p->o, p->d, p->after.t, t1);
    p->count->overflow += w->overflow;
    if (w->count == 0)
        return false;
    if (scene_may(MAY_CLEAR) && !path_walk_scatters(s, w)) {
        *event = path_line(s, p, w, p->after.t, t1);
        return false;
    }
    p->boost = 1.0f;
    if (p->straight || path_has_lamps(s))
        path_look(s, p, t1);
    if (scene_may(MAY_LAMPS) && p->stretch.on && !s->field.single)
        path_along(s, p);
    return true;
}

HD int path_media(const flat_scene *s, path_state *p, float t1,
                  path_event *to)
{
    track_line l;
    int event;
    return path_sets_out(s, p, t1, &l, &event) ? path_track(s, p, &l, to)
                                               : event;
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

/* What is next at a vertex. */
enum { VISIT_BEGINS, VISIT_LIGHTS, VISIT_GLOW, VISIT_SKY, VISIT_REST,
       VISIT_BOUNCES, VISIT_ENDS };

typedef struct {
    int32_t next;
    path_lights lights;
} path_visit;

/* What a field holds of the light at a vertex; true: all but the lights'. */
HD bool path_visit_field(const flat_scene *s, path_state *p,
                         const path_vertex *v)
{
    if (!scene_may(MAY_FIELD) || v->on_surface || s->field.numbers == 0 ||
        (!p->straight && s->field.straight))
        return false;
    path_field(s, p, v);
    return true;
}

HD bool path_may_go_on(const flat_scene *s, const path_vertex *v)
{
    if (!scene_may(MAY_SINGLE))
        return true;
    return v->on_surface ? s->surfaces_indirect : s->media_multiple;
}

/* The next connection from a vertex; false: there is none more. */
HD bool path_connects(const flat_scene *s, path_state *p, const path_vertex *v,
                      path_visit *visit, path_connection *c)
{
    bool goes_on = path_may_go_on(s, v);
    if (visit->next == VISIT_BEGINS) {
        visit->next = VISIT_LIGHTS;
        visit->lights = path_lights_choose(s, p, v);
    }
    if (visit->next == VISIT_LIGHTS) {
        if (path_light_next(s, p, v, &visit->lights, c))
            return true;
        visit->next = path_visit_field(s, p, v) ? VISIT_ENDS : VISIT_GLOW;
    }
    if (visit->next == VISIT_GLOW) {
        visit->next = VISIT_SKY;
        if (goes_on)
            path_aim(s, p, v);
        if (goes_on && path_glow(s, p, v, c))
            return true;
    }
    if (visit->next == VISIT_SKY) {
        visit->next = goes_on ? VISIT_BOUNCES : VISIT_REST;
        if (path_sky(s, p, v, c))
            return true;
    }
    if (!scene_may(MAY_SINGLE) || visit->next != VISIT_REST)
        return false;
    visit->next = VISIT_ENDS;
    return path_sky_rest(s, p, v, c);
}

/* Light that comes to a vertex, and the way on from there; false: there is
 * none. */
HD bool path_stay(const flat_scene *s, path_state *p, const path_vertex *v)
{
    path_visit visit;
    path_connection c;
    visit.next = VISIT_BEGINS;
    while (path_connects(s, p, v, &visit, &c))
        path_follow(s, p, &c);
    return visit.next == VISIT_BOUNCES && path_bounce(s, p, v);
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
        v.medium = scene_medium(s, to->event.medium);
        v.event = &to->event;
        return path_stay(s, p, &v);
    }
    if (event == PATH_THROUGH)
        event = path_arrive(s, p, plate, to, &at);
    if (event != PATH_SCATTERED)
        return event == PATH_THROUGH;
    v.on_surface = scene_may(MAY_SURFACES);
    v.p = at.p;
    v.surface = &at;
    path_add(p, rgb_mul(p->beta, surface_glow(at.material, at.color,
                                              at.opacity)));
    return path_stay(s, p, &v);
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
