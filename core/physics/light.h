/* light.h - point and spot lights as POV-Ray has them.
 *
 * A light of colour C gives a surface the irradiance pi C cos and a medium the
 * in-scattered radiance sigma_s 4 pi p C per length, at any distance unless it
 * fades (LANGUAGE.md). In physical units both see the irradiance pi C / d^2,
 * d in scene units. */
#ifndef CORE_PHYSICS_LIGHT_H
#define CORE_PHYSICS_LIGHT_H
#include "core/physics/fmath.h"
#include "core/physics/rng.h"
#include "core/physics/scene.h"

#define LIGHT_PI 3.14159265f

typedef struct {
    int32_t light;
    float probability;      /* of having been chosen                       */
    vec3 wi;                /* unit, toward the light                      */
    float distance;         /* unit space                                  */
    rgb color;              /* C at this distance and angle                */
} light_sample;

/* POV-Ray's cone: full inside the radius, a smooth cubic of the cosine down to
 * nothing at the falloff, times cos^tightness; nothing behind. A radius beyond
 * the falloff wins. Measured by tests/oracle/lights.py. */
HD float light_cone(const flat_light *l, float cosine)
{
    if (!l->spot)
        return 1.0f;
    if (!(cosine > hd_min(l->cos_falloff, l->cos_radius)) || cosine <= 0.0f)
        return 0.0f;
    float tight = l->tightness > 0.0f ? fm_pow(cosine, l->tightness) : 1.0f;
    if (cosine >= l->cos_radius)
        return tight;
    float x = (cosine - l->cos_falloff) / (l->cos_radius - l->cos_falloff);
    return tight * x * x * (3.0f - 2.0f * x);
}

/* Factor of distance d (unit space). */
HD float light_fade(const flat_scene *s, const flat_light *l, float d)
{
    if (s->physical_units) {
        float scene = d / s->unit;
        return 1.0f / (scene * scene);
    }
    if (l->fade_power <= 0.0f || l->fade_distance <= 0.0f)
        return 1.0f;
    return 2.0f / (1.0f + fm_pow(d / l->fade_distance, l->fade_power));
}

HD int light_find(const flat_scene *s, float u, float *probability)
{
    int i = 0, last = (int)s->lights_count - 1;
    while (i < last && u >= s->lights[i].cumulative)
        i++;
    *probability = s->lights[i].cumulative -
                   (i > 0 ? s->lights[i - 1].cumulative : 0.0f);
    return i;
}

/* Chooses a light for the point p; false where it gives nothing. */
HD bool light_choose(const flat_scene *s, vec3 p, rng *r, light_sample *out)
{
    if (s->lights_count == 0)
        return false;
    out->light = light_find(s, rng_float(r), &out->probability);
    const flat_light *l = &s->lights[out->light];
    vec3 to = vec3_sub(l->position, p);
    out->distance = vec3_length(to);
    if (!(out->distance > 0.0f) || !(out->probability > 0.0f))
        return false;
    out->wi = vec3_scale(to, 1.0f / out->distance);
    float factor = light_cone(l, -vec3_dot(out->wi, l->axis)) *
                   light_fade(s, l, out->distance);
    out->color = rgb_scale(l->color, factor);
    return factor > 0.0f;
}

/* 4 pi, by which a medium multiplies p C; pi in physical units. */
HD float light_medium_factor(const flat_scene *s)
{
    return s->physical_units ? LIGHT_PI : 4.0f * LIGHT_PI;
}

#endif
