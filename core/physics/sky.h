/* sky.h - what is seen and comes from beyond the scene: the background, or a
 * picture or a function around it, which is also a light.
 *
 * A texel is chosen in proportion to what it has above the mean, so that an
 * even sky costs nothing: there a path's own directions do as well (MIS
 * compensation; Karlik et al. 2019). */
#ifndef CORE_PHYSICS_SKY_H
#define CORE_PHYSICS_SKY_H
#include "core/physics/rng.h"
#include "core/physics/scene_machine.h"
#include "core/physics/warp.h"

/* Column and row, in texels, of a direction of map space. */
HD void sky_place(const flat_sky *k, vec3 q, float *x, float *y)
{
    float azimuth = fm_atan2(q.x, q.z);
    float polar = fm_atan2(sqrtf(q.x * q.x + q.z * q.z), q.y);
    *x = (0.5f + azimuth / WARP_2PI) * (float)k->width;
    *y = polar * WARP_INV_PI * (float)k->height;
}

/* Columns go around, rows end at the poles. */
HD const sky_texel *sky_texel_at(const flat_scene *s, int x, int y)
{
    const flat_sky *k = s->sky;
    x = x < 0 ? x + k->width : x >= k->width ? x - k->width : x;
    y = y < 0 ? 0 : y >= k->height ? k->height - 1 : y;
    return s->sky_texels + (uint64_t)y * (uint64_t)k->width + (uint64_t)x;
}

HD rgb sky_lerp(rgb a, rgb b, float t)
{
    return rgb_add(rgb_scale(a, 1.0f - t), rgb_scale(b, t));
}

/* Of a function: what it is asked for, not its texels. */
HD_APART rgb sky_function(const flat_scene *s, vec3 d)
{
    float r[MACHINE_REGISTERS];
    machine code = scene_machine(s);
    r[0] = d.x;
    r[1] = d.y;
    r[2] = d.z;
    bool known = machine_run(&code, s->sky->function, r);
    for (int i = 0; i < 3; i++)
        r[i] = known && r[i] > 0.0f && r[i] < 1e30f ? r[i] : 0.0f;
    return rgb_make(r[0], r[1], r[2]);
}

/* Radiance that comes along -d; d of unit length. */
HD rgb sky_radiance(const flat_scene *s, vec3 d)
{
    if (!scene_may(MAY_SKY) || s->sky_count == 0)
        return s->background;
    const flat_sky *k = s->sky;
    float x, y;
    if (scene_may(MAY_FUNCTIONS) && k->function >= 0)
        return sky_function(s, d);
    sky_place(k, affine_vector(&k->to_map, d), &x, &y);
    if (!k->smooth)
        return sky_texel_at(s, hd_floor(x), hd_floor(y))->radiance;
    int i = hd_floor(x - 0.5f), j = hd_floor(y - 0.5f);
    float fx = x - 0.5f - (float)i, fy = y - 0.5f - (float)j;
    return sky_lerp(sky_lerp(sky_texel_at(s, i, j)->radiance,
                             sky_texel_at(s, i + 1, j)->radiance, fx),
                    sky_lerp(sky_texel_at(s, i, j + 1)->radiance,
                             sky_texel_at(s, i + 1, j + 1)->radiance, fx), fy);
}

HD bool sky_is_light(const flat_scene *s)
{
    return scene_may(MAY_SKY) && s->environment && s->sky_count > 0 &&
           s->sky->lights;
}

/* Solid angle of map space over that of the world, at map direction q that
 * the world's unit vector has. */
HD float sky_stretch(const flat_sky *k, vec3 q)
{
    float r = vec3_length(q);
    return k->jacobian / (r * r * r);
}

/* Density per solid angle with which sky_choose takes d. */
HD float sky_pdf(const flat_scene *s, vec3 d)
{
    const flat_sky *k = s->sky;
    float x, y;
    vec3 q = affine_vector(&k->to_map, d);
    sky_place(k, q, &x, &y);
    return sky_texel_at(s, hd_floor(x), hd_floor(y))->density *
           sky_stretch(k, q);
}

/* A unit direction of the sky, for sky_is_light. */
HD vec3 sky_choose(const flat_scene *s, rng *r, float *pdf)
{
    const flat_sky *k = s->sky;
    uint64_t n = s->sky_texels_count;
    uint32_t i = (uint32_t)(((uint64_t)rng_u32(r) * n) >> 32);
    if (!rng_chance(r, s->sky_texels[i].keep))
        i = s->sky_texels[i].alias;
    uint32_t row = i / (uint32_t)k->width, column = i % (uint32_t)k->width;
    float band = FM_PI / (float)k->height;
    float top = fm_cos((float)row * band);
    float low = fm_cos((float)(row + 1u) * band);
    float y = top + rng_float(r) * (low - top);
    float at = ((float)column + rng_float(r)) / (float)k->width - 0.5f;
    vec3 around = warp_around_z(y, sqrtf((1.0f - y) * (1.0f + y)), at);
    vec3 q = vec3_make(around.y, y, around.x);
    vec3 d = vec3_normalize(affine_vector(&k->from_map, q));
    *pdf = s->sky_texels[i].density *
           sky_stretch(k, affine_vector(&k->to_map, d));
    return d;
}

#endif
