/* surface.h - POV-Ray's finish: what a surface makes of light.
 *
 * wo and wi are unit, away from the surface; n is the shading normal on wo's
 * side. "Per light C" is POV-Ray's measure, an irradiance of pi C cos. */
#ifndef CORE_PHYSICS_SURFACE_H
#define CORE_PHYSICS_SURFACE_H
#include "core/physics/fmath.h"
#include "core/physics/scene.h"

/* Which of a checker's two colours: unit cubes by the parity of their
 * coordinates. A plane at a whole coordinate lies in the cubes above it, to
 * the rounding of a hit, which the shift covers. */
HD int surface_checker(vec3 p)
{
    const float shift = 1e-3f;
    int x = hd_floor(p.x + shift), y = hd_floor(p.y + shift);
    int z = hd_floor(p.z + shift);
    return (x ^ y ^ z) & 1;
}

/* Radiance of its own, ambient included. */
HD rgb surface_glow(const flat_material *m, rgb color, float opacity)
{
    return rgb_scale(rgb_mul(color, rgb_add(m->ambient, m->emission)),
                     opacity);
}

HD bool surface_has_highlight(const flat_material *m)
{
    return m->phong > 0.0f || m->specular > 0.0f;
}

/* Phong's highlight about the mirror direction, Blinn's about the normal. */
HD float surface_highlight(const flat_material *m, vec3 n, vec3 wo, vec3 wi)
{
    float out = 0.0f;
    if (m->phong > 0.0f) {
        vec3 mirror = vec3_sub(vec3_scale(n, 2.0f * vec3_dot(n, wo)), wo);
        float c = vec3_dot(mirror, wi);
        if (c > 0.0f)
            out += m->phong * fm_pow(c, m->phong_size);
    }
    if (m->specular > 0.0f && m->roughness > 0.0f) {
        float c = vec3_dot(n, vec3_normalize(vec3_add(wo, wi)));
        if (c > 0.0f)
            out += m->specular * fm_pow(c, 1.0f / m->roughness);
    }
    return out;
}

/* Diffuse radiance per light C. */
HD rgb surface_matte(const flat_material *m, rgb color, float opacity,
                     float cosine)
{
    if (!(cosine > 0.0f))
        return rgb_gray(0.0f);
    float lobe = m->brilliance == 1.0f ? cosine
                                       : fm_pow(cosine, m->brilliance);
    return rgb_scale(color, m->diffuse * lobe * opacity);
}

/* Colour of a highlight: a metal's is its own, and the light's at grazing
 * incidence, by the curve of Strauss (1990), (1/(x-k)^2 - 1/k^2) over its value
 * at 1, with k = 1.12 and x the angle of incidence in right angles. */
HD rgb surface_tint(const flat_material *m, rgb color, float cosine)
{
    if (m->metallic == 0.0f)
        return rgb_gray(1.0f);
    float x = fm_acos(hd_min(cosine, 1.0f)) * 0.636619772f - 1.12f;
    float curve = 0.0145672258f / (x * x) - 0.0116129032f;
    float own = m->metallic * (1.0f - curve);
    return rgb_add(rgb_gray(1.0f - own), rgb_scale(color, own));
}

/* Radiance per light C from direction wi. Opacity dims the matte part only:
 * highlights stand on clear glass too. Measured by tests/oracle/finish.py. */
HD rgb surface_light(const flat_material *m, rgb color, float opacity, vec3 n,
                     vec3 wo, vec3 wi)
{
    float cosine = vec3_dot(n, wi);
    rgb out = surface_matte(m, color, opacity, cosine);
    if (!(cosine > 0.0f) || !surface_has_highlight(m))
        return out;
    float highlight = surface_highlight(m, n, wo, wi);
    rgb tint = surface_tint(m, color, cosine);
    return rgb_add(out, rgb_scale(tint, highlight));
}

/* Next float in the direction of n, `steps` times. */
HD float surface_nudge(float x, float n)
{
    const float steps = 256.0f, near = 1.0f / 32.0f;
    if (fabsf(x) < near)
        return x + n * (1.0f / 65536.0f);
    int32_t i = (int32_t)fm_bits(x), by = (int32_t)(steps * n);
    return fm_from_bits((uint32_t)(x < 0.0f ? i - by : i + by));
}

/* Origin of a ray that leaves the surface on the side of n, clear of it
 * (Waechter and Binder 2019). */
HD vec3 surface_offset(vec3 p, vec3 n)
{
    return vec3_make(surface_nudge(p.x, n.x), surface_nudge(p.y, n.y),
                     surface_nudge(p.z, n.z));
}

#endif
