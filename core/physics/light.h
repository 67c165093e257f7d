/* light.h - point, spot, cylinder, parallel and area lights as POV-Ray has
 * them.
 *
 * A light of colour C gives a surface the irradiance pi C cos and a medium the
 * in-scattered radiance sigma_s 4 pi p C per length, at any distance unless it
 * fades (LANGUAGE.md). In physical units both see the irradiance pi C / d^2,
 * d in scene units, or pi C where light is parallel. Cones, tubes, fading and
 * areas were measured by tests/oracle/lights.py. */
#ifndef CORE_PHYSICS_LIGHT_H
#define CORE_PHYSICS_LIGHT_H
#include "core/physics/fmath.h"
#include "core/physics/rng.h"
#include "core/physics/scene.h"
#include "core/physics/warp.h"

/* Of an area that tells in shadows only, light comes from the middle, but
 * what is in its way lies toward a lamp. */
typedef struct {
    int32_t light;
    float probability;      /* of having been chosen                       */
    vec3 wi;                /* unit, toward the light                      */
    rgb color;              /* C at this distance and angle                */
    vec3 shadow_wi;         /* unit, toward the lamp                       */
    float shadow_distance;  /* to it, unit space                           */
} light_sample;

HD float light_cubic(float x)
{
    return x * x * (3.0f - 2.0f * x);
}

/* POV-Ray's cone: full inside the radius, a smooth cubic of the cosine down to
 * nothing at the falloff, times cos^tightness; nothing behind. A radius beyond
 * the falloff wins. */
HD float light_cone(const flat_light *l, float cosine)
{
    if (!(cosine > hd_min(l->outer, l->inner)) || cosine <= 0.0f)
        return 0.0f;
    float tight = l->tightness > 0.0f ? fm_pow(cosine, l->tightness) : 1.0f;
    if (cosine >= l->inner)
        return tight;
    return tight * light_cubic((cosine - l->outer) / (l->inner - l->outer));
}

/* Its tube, by the distance from the axis: as the cone, with a hard edge where
 * the radius is 0 or the falloff less, and nothing behind the light. */
HD float light_tube(const flat_light *l, float distance, float along)
{
    if (!(distance < l->outer) || along <= 0.0f)
        return 0.0f;
    float left = (l->outer - distance) / l->outer;
    float tight = l->tightness > 0.0f ? fm_pow(left, l->tightness) : 1.0f;
    if (distance <= l->inner || l->inner <= 0.0f || l->inner >= l->outer)
        return tight;
    return tight *
           light_cubic((l->outer - distance) / (l->outer - l->inner));
}

/* Factor of distance d (unit space). */
HD float light_fade(const flat_scene *s, const flat_light *l, float d)
{
    if (s->physical_units) {
        float scene = d / s->unit;
        return l->parallel ? 1.0f : 1.0f / (scene * scene);
    }
    if (l->fade_power <= 0.0f || l->fade_distance <= 0.0f)
        return 1.0f;
    return 2.0f / (1.0f + fm_pow(d / l->fade_distance, l->fade_power));
}

/* Toward a lamp at `from`, and its distance. Parallel light comes along the
 * axis, from the plane through the lamp or from behind it. */
HD vec3 light_toward(const flat_light *l, vec3 from, vec3 p, float *distance)
{
    vec3 to = vec3_sub(from, p);
    if (l->parallel) {
        *distance = hd_max(-vec3_dot(to, l->axis), 0.0f);
        return vec3_scale(l->axis, -1.0f);
    }
    *distance = vec3_length(to);
    return vec3_scale(to, 1.0f / *distance);
}

/* Colour factor at p of a lamp at `from`, in direction wi at `distance`. */
HD float light_factor(const flat_scene *s, const flat_light *l, vec3 from,
                      vec3 p, vec3 wi, float distance)
{
    float shape = 1.0f;
    if (l->kind == LIGHT_SPOT && !l->parallel)
        shape = light_cone(l, -vec3_dot(wi, l->axis));
    if (l->kind == LIGHT_CYLINDER) {
        vec3 at = vec3_sub(p, from);
        float along = vec3_dot(at, l->axis);
        vec3 off = vec3_mad(at, -along, l->axis);
        shape = light_tube(l, vec3_length(off), along);
    }
    return shape > 0.0f ? shape * light_fade(s, l, distance) : 0.0f;
}

/* A lamp of an area light, uniform over it, for the lit point p. */
HD vec3 light_lamp_at(const flat_light *l, vec3 p, float u, float v)
{
    vec3 at = vec3_make(u - 0.5f, v - 0.5f, 0.0f);
    if (l->area != LIGHT_RECTANGLE)
        at = vec3_scale(warp_disc(u, v), 0.5f);
    vec3 x = l->side[0], y = l->side[1];
    if (l->area == LIGHT_FACING_DISC) {
        warp_basis b = warp_frame(vec3_normalize(vec3_sub(p, l->position)));
        float size = vec3_length(l->side[0]);
        x = vec3_scale(b.x, size);
        y = vec3_scale(b.y, size);
    }
    return vec3_mad(vec3_mad(l->position, at.x, x), at.y, y);
}

HD vec3 light_lamp(const flat_light *l, vec3 p, rng *r)
{
    float u = rng_float(r);
    return light_lamp_at(l, p, u, rng_float(r));
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

/* How light `i` reaches the point p; false where it gives nothing. */
HD bool light_reach(const flat_scene *s, int i, vec3 p, rng *r,
                    light_sample *out)
{
    const flat_light *l = &s->lights[i];
    vec3 lamp = l->area ? light_lamp(l, p, r) : l->position;
    vec3 from = l->illumination ? lamp : l->position;
    float distance;
    out->light = i;
    out->wi = light_toward(l, from, p, &distance);
    out->shadow_wi = light_toward(l, lamp, p, &out->shadow_distance);
    if (!l->parallel && !(distance > 0.0f && out->shadow_distance > 0.0f))
        return false;
    float factor = light_factor(s, l, from, p, out->wi, distance);
    out->color = rgb_scale(l->color, factor);
    return factor > 0.0f;
}

/* 4 pi, by which a medium multiplies p C; pi in physical units. */
HD float light_medium_factor(const flat_scene *s)
{
    return s->physical_units ? FM_PI : 4.0f * FM_PI;
}

#endif
