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

/* The same without noise: media by their line integral. */
HD rgb shadow_line(const flat_scene *s, container_set *set, vec3 o, vec3 wi,
                   float distance, line_jitter jitter)
{
    bvh_ray r = bvh_ray_make(o, wi);
    ray_hit after = hit_start(0.0f);
    rgb left = rgb_gray(1.0f);
    line_integral line = line_zero();
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, distance);
        if (h.shape >= 0)
            left = rgb_mul(left, shadow_surface(s, &r, &h));
        if (rgb_is_black(left))
            return left;
        line_integrate(s, set, o, wi, after.t, h.t, 0.0f, false, false,
                       jitter, &line);
        if (h.shape < 0)
            return rgb_mul(left, line_transmittance(&line));
        shadow_cross(s, &h, set);
        after = h;
    }
}

#endif
