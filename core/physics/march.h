/* march.h - the straight line from the eye: what media emit toward it, the
 * background behind them, and how opaque all is. Deterministic, but for media
 * whose density is a function. */
#ifndef CORE_PHYSICS_MARCH_H
#define CORE_PHYSICS_MARCH_H
#include "core/physics/line.h"
#include "core/physics/shadow.h"
#include "core/physics/sky.h"

typedef struct {
    rgb radiance;           /* emission of media and the background        */
    rgb background;         /* the background's part of it                 */
    rgb opacity;            /* 1 - transmittance of all up to the background */
    float depth;            /* distance of the first surface that is not
                               wholly transparent; infinite if none        */
    uint32_t overflow;      /* media that were left out                    */
} march_result;

/* Adds the next segment; its emission passes the surfaces before it. */
HD void march_segment(const flat_scene *s, const container_set *inside,
                      vec3 o, vec3 d, float t0, float t1, rgb pass,
                      line_jitter jitter, line_integral *line,
                      rgb *radiance)
{
    line->radiance = rgb_gray(0.0f);
    line_integrate(s, inside, o, d, t0, t1, 0.0f, true, true, jitter, line);
    *radiance = rgb_add(*radiance, rgb_mul(line->radiance, pass));
}

/* Along the unit vector d from o, whose containers are `inside`; the jitter is
 * for functions (line.h). */
HD march_result march_line(const flat_scene *s, const container_set *inside,
                           vec3 o, vec3 d, line_jitter jitter)
{
    march_result out;
    out.radiance = out.background = rgb_gray(0.0f);
    out.depth = INFINITY;
    rgb pass = rgb_gray(1.0f);
    line_integral line = line_zero();
    container_set set = *inside;
    bvh_ray r = bvh_ray_make(o, d);
    ray_hit after = hit_start(0.0f);
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, s->far);
        march_segment(s, &set, o, d, after.t, h.t, pass, jitter, &line,
                      &out.radiance);
        if (h.shape < 0)
            break;
        if (hit_material(s, &h) >= 0) {
            rgb through = hit_transparency(s, &r, &h);
            if (out.depth == INFINITY &&
                rgb_min(through) < 1.0f)
                out.depth = h.t;
            pass = rgb_mul(pass, through);
        }
        if (rgb_is_black(pass))
            break;
        shadow_cross(s, &h, &set);
        after = h;
    }
    rgb left = rgb_mul(pass, line_transmittance(&line));
    out.overflow = line.overflow;
    out.background = rgb_mul(left, sky_radiance(s, d));
    out.radiance = rgb_add(out.radiance, out.background);
    /* Exact for thin media where no surface is on the way. */
    out.opacity = rgb_add(rgb_sub(rgb_gray(1.0f), pass),
                          rgb_mul(pass, line_opacity(&line)));
    return out;
}

#endif
