/* shadow.h - how much light passes between two points: surfaces by their
 * transparency, media by ratio tracking or exactly. */
#ifndef CORE_PHYSICS_SHADOW_H
#define CORE_PHYSICS_SHADOW_H
#include "core/physics/bvh.h"
#include "core/physics/hit.h"
#include "core/physics/line.h"
#include "core/physics/track.h"

/* What a straight ray passes at a hit: the colour factor of the surface. */
HD rgb shadow_surface(const flat_scene *s, const bvh_ray *r,
                      const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (hit_material(s, h) < 0 || (f->flags & SHAPE_NO_SHADOW))
        return rgb_gray(1.0f);
    return hit_transparency(s, r, h);
}

/* Updates the containers of a ray that passes straight through a hit. */
HD void shadow_cross(const flat_scene *s, const ray_hit *h,
                     container_set *set)
{
    if (h->turn == TURN_IN)
        container_enter(set, s->shapes[h->shape].container);
    else if (h->turn == TURN_OUT)
        container_leave(set, s->shapes[h->shape].container);
}

HD_APART rgb shadow_seek(const flat_scene *s, container_set *set,
                         bool atmosphere, vec3 o, vec3 d, float distance,
                         rng *random, track_counters *c)
{
    bvh_ray r = bvh_ray_make(o, d);
    ray_hit after = hit_start(0.0f);
    rgb left = rgb_gray(1.0f);
    c->shadow_rays++;
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, distance);
        if (h.shape < 0 && distance >= s->far)
            container_leave_bounded(s, set);
        rgb pass = h.shape >= 0 ? shadow_surface(s, &r, &h) : rgb_gray(1.0f);
        if (rgb_is_black(pass))
            return pass;
        rgb media = track_transmittance(s, set, atmosphere, o, d, after.t,
                                        h.t, random, c);
        left = rgb_mul(left, rgb_mul(media, pass));
        if (h.shape < 0 || rgb_is_black(left))
            return left;
        shadow_cross(s, &h, set);
        after = h;
    }
}

/* Transmittance from o over `distance` along the unit vector d, unbiased.
 * `set` holds the containers at o, and on return those at the end. */
HD rgb shadow_transmittance(const flat_scene *s, container_set *set,
                            bool atmosphere, vec3 o, vec3 d, float distance,
                            rng *random, track_counters *c)
{
    HD_COPY(container_set, set);
    HD_COPY(rng, random);
    rgb left = shadow_seek(s, HD_COPIED(set), atmosphere, o, d, distance,
                           HD_COPIED(random), c);
    HD_RETURN(set);
    HD_RETURN(random);
    return left;
}

/* The same without noise, media by their line integral: a line on its way,
 * segment by segment. What is had at each step is apart, see line_flight. */
typedef struct {
    vec3 o, wi;
    float distance;
    line_jitter jitter;
    container_set inside;
    ray_hit after, hit;     /* the ends of the segment                     */
    rgb left;               /* by surfaces; once it has ended, by all      */
} shadow_way;

HD shadow_way shadow_begin(const container_set *inside, vec3 o, vec3 wi,
                           float distance, line_jitter jitter)
{
    shadow_way w;
    w.o = o;
    w.wi = wi;
    w.distance = distance;
    w.jitter = jitter;
    w.inside = *inside;
    w.after = w.hit = hit_start(0.0f);
    w.left = rgb_gray(1.0f);
    return w;
}

/* To the next surface. True: through media, step by step. */
HD bool shadow_look(const flat_scene *s, shadow_way *w, line_integral *line,
                    line_flight *f)
{
    bvh_ray r = bvh_ray_make(w->o, w->wi);
    w->hit = bvh_nearest(s, &r, &w->after, w->distance);
    if (w->hit.shape >= 0)
        w->left = rgb_mul(w->left, shadow_surface(s, &r, &w->hit));
    return !rgb_is_black(w->left) &&
           line_begin(s, &w->inside, w->o, w->wi, w->after.t, w->hit.t, 0.0f,
                      false, false, w->jitter, line, f);
}

/* At the end of a segment. False: that was the last. */
HD bool shadow_land(const flat_scene *s, shadow_way *w,
                    const line_integral *line)
{
    if (rgb_is_black(w->left))
        return false;
    if (w->hit.shape < 0) {
        w->left = rgb_mul(w->left, line_transmittance(line));
        return false;
    }
    shadow_cross(s, &w->hit, &w->inside);
    w->after = w->hit;
    return true;
}

/* The whole of it. */
HD rgb shadow_line(const flat_scene *s, const container_set *set, vec3 o,
                   vec3 wi, float distance, line_jitter jitter)
{
    shadow_way w = shadow_begin(set, o, wi, distance, jitter);
    line_integral line = line_zero();
    line_flight f;
    do {
        bool more = shadow_look(s, &w, &line, &f);
        while (more)
            more = line_step(s, &f, &line);
    } while (shadow_land(s, &w, &line));
    return w.left;
}

#endif
