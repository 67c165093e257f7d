/* medium.h - a medium at a point: coefficients and emitted source.
 *
 * Coefficients are per unit-space length; `source` is radiance per length. */
#ifndef CORE_PHYSICS_MEDIUM_H
#define CORE_PHYSICS_MEDIUM_H
#include "core/physics/field.h"

enum { BRIGHTNESS_PHYSICAL, BRIGHTNESS_NORMALIZED, BRIGHTNESS_CONSTANT,
       BRIGHTNESS_TOTAL };

/* Product of the medium's density fields: of functions a colour. */
HD rgb medium_density(const flat_scene *s, const flat_medium *m,
                      const field_point *x)
{
    float d = 1.0f;
    rgb c = rgb_gray(1.0f);
    for (int i = 0; i < m->densities && d != 0.0f; i++) {
        const flat_field *f = scene_density(s, m, i);
        if (field_is_function(f))
            c = rgb_mul(c, field_color(s, f, x));
        else
            d *= field_plain(s, f, x);
    }
    if (!scene_may(MAY_FUNCTIONS) || !m->functions)
        return rgb_gray(hd_min(d, m->densest));
    c = rgb_scale(c, d);
    return rgb_make(hd_min(c.r, m->densest), hd_min(c.g, m->densest),
                    hd_min(c.b, m->densest));
}

/* What a colour of Planck's law is divided by, so that its size is what the
 * fire's brightness says. */
HD float fire_size(const flat_medium *m, rgb c, float kelvin)
{
    if (m->brightness == BRIGHTNESS_NORMALIZED)
        return rgb_max(c);
    float luminance = rgb_luminance(c);
    if (m->brightness == BRIGHTNESS_TOTAL)
        luminance /= kelvin * kelvin * kelvin * kelvin;
    return luminance;
}

/* Colour and strength of thermal emission at `kelvin`, as the fire's
 * brightness says. Planck's law in linear Rec.709; `intensity` holds the
 * reference. */
HD rgb fire_color(const flat_scene *s, const flat_medium *m, float kelvin)
{
    rgb c = blackbody_rgb(s->blackbody, kelvin);
    float scale = m->intensity;
    if (m->brightness != BRIGHTNESS_PHYSICAL) {
        float size = fire_size(m, c, kelvin);
        if (!(size > 0.0f))
            return rgb_gray(0.0f);
        scale /= size;
    }
    return rgb_scale(c, scale);
}

/* What burns where the density is `density`, so much of it, and so hot. */
HD rgb fire_light(const flat_scene *s, const flat_medium *m, rgb density,
                  float amount, float temperature)
{
    if (amount == 0.0f || (!m->additive && rgb_is_black(density)))
        return rgb_gray(0.0f);
    float kelvin = m->kelvin_offset + m->kelvin_scale * temperature;
    rgb c = rgb_scale(fire_color(s, m, kelvin), amount);
    return m->additive ? c : rgb_mul(c, rgb_mul(m->sigma_a, density));
}

HD rgb fire_source(const flat_scene *s, const flat_medium *m,
                   const field_point *x, rgb density)
{
    if (!m->additive && rgb_is_black(density))
        return rgb_gray(0.0f);
    float amount = m->amount >= 0 ? field_eval(s, scene_amount(s, m), x) : 1.0f;
    if (amount == 0.0f)
        return rgb_gray(0.0f);
    return fire_light(s, m, density, amount,
                      field_eval(s, scene_temperature(s, m), x));
}

/* Radiance per length that the medium emits at x, where its density is
 * `density`. */
HD rgb medium_source(const flat_scene *s, const flat_medium *m,
                     const field_point *x, rgb density)
{
    rgb q = rgb_mul(m->emission, density);
    return m->fire ? rgb_add(q, fire_source(s, m, x, density)) : q;
}

#endif
