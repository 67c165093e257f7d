/* shadow.h - how much light passes between two points: surfaces by their
 * transparency, media by ratio tracking. */
#ifndef CORE_PHYSICS_SHADOW_H
#define CORE_PHYSICS_SHADOW_H
#include "core/physics/bvh.h"
#include "core/physics/hit.h"
#include "core/physics/track.h"

/* What a straight ray passes at a hit: the colour factor of the surface. */
HD rgb shadow_surface(const flat_scene *s, const bvh_ray *r,
                      const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (f->material < 0 || (f->flags & SHAPE_NO_SHADOW))
        return rgb_gray(1.0f);
    return hit_transparency(s, r, h);
}

/* Updates the containers of a ray that passes straight through a hit. */
HD void shadow_cross(const flat_scene *s, const ray_hit *h, vec3 d,
                     container_set *set)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (f->interior < 0 || !(f->flags & SHAPE_HOLLOW))
        return;
    if (hit_enters(s, h, d))
        container_enter(set, h->shape);
    else
        container_leave(set, h->shape);
}

/* Transmittance from o over `distance` along the unit vector d, unbiased.
 * `set` holds the containers at o, and on return those at the end. */
HD rgb shadow_transmittance(const flat_scene *s, container_set *set,
                            bool atmosphere, vec3 o, vec3 d, float distance,
                            rng *random, track_counters *c)
{
    bvh_ray r = bvh_ray_make(o, d);
    ray_hit after = hit_start(0.0f);
    rgb left = rgb_gray(1.0f);
    c->shadow_rays++;
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, distance);
        rgb pass = h.shape >= 0 ? shadow_surface(s, &r, &h) : rgb_gray(1.0f);
        if (rgb_is_black(pass))
            return pass;
        rgb media = track_transmittance(s, set, atmosphere, o, d, after.t,
                                        h.t, random, c);
        left = rgb_mul(left, rgb_mul(media, pass));
        if (h.shape < 0 || rgb_is_black(left))
            return left;
        shadow_cross(s, &h, d, set);
        after = h;
    }
}

#endif
