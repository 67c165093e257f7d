/* aim.h - directions chosen by a near lamp.
 *
 * What a ray gathers of a lamp's light in media around it goes as 1 over the
 * sine of the angle between the ray and the way to the lamp: rays that pass
 * close by it gather most, and the sum of their squares has no bound [Georgiev
 * et al. 2013]. Directions of that density, more of them the smaller the angle,
 * beside those of the phase function or of the surface, make it even; walls
 * beside lamps are found more often too. The power is the best of those that
 * tests/bench/media.md tells of. */
#ifndef CORE_PHYSICS_AIM_H
#define CORE_PHYSICS_AIM_H
#include "core/physics/warp.h"

typedef struct {
    vec3 to;                /* unit, toward the lamp                       */
    float share;            /* of directions that are chosen by it; or 0   */
} lamp_aim;

/* Density per solid angle: of the angle, in proportion to (pi - angle)^3. */
HD float aim_pdf(const lamp_aim *a, vec3 d)
{
    float sine = vec3_length(vec3_cross(a->to, d));
    float angle = fm_atan2(sine, vec3_dot(a->to, d));
    float near = hd_max(1.0f - angle * WARP_INV_PI, 0.0f);
    return 2.0f * WARP_INV_PI * WARP_INV_PI * near * near * near /
           hd_max(sine, 1e-7f);
}

HD vec3 aim_sample(const lamp_aim *a, float u, float v)
{
    float s, c, half = sqrtf(1.0f - u), near = sqrtf(half);
    /* pi (1 - near), near^4 = 1 - u, without cancellation. */
    fm_sincos(FM_PI * u / ((1.0f + near) * (1.0f + half)), &s, &c);
    return vec3_normalize(warp_frame_to_world(warp_frame(a->to),
                                              warp_around_z(c, s, v)));
}

/* Of a density `pdf` of other directions, that of both together. */
HD float aim_mixed(const lamp_aim *a, vec3 d, float pdf)
{
    return a->share > 0.0f ? pdf + a->share * (aim_pdf(a, d) - pdf) : pdf;
}

#endif
