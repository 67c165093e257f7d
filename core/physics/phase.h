/* phase.h - phase functions: how a medium scatters.
 *
 * Directions are those of travel, d before the scattering and w after it (not
 * both away from the point): cosine = d.w is 1 straight on. Densities are per
 * solid angle and integrate to 1 over the sphere; g in (-1, 1) is the mean
 * cosine, > 0 forward. Where the peak of a narrow lobe matters, a cosine has
 * lost it: pass minus = 1 - cosine and plus = 1 + cosine. */
#ifndef CORE_PHYSICS_PHASE_H
#define CORE_PHYSICS_PHASE_H
#include "core/physics/warp.h"

/* POV-Ray's scattering types. */
enum {
    PHASE_ISOTROPIC = 1,
    PHASE_MIE_HAZY = 2,         /* 1 + 9 ((1 + c)/2)^8,   integral 8 pi      */
    PHASE_MIE_MURKY = 3,        /* 1 + 50 ((1 + c)/2)^32, integral 332 pi/33 */
    PHASE_RAYLEIGH = 4,         /* 1 + c^2,               integral 16 pi/3   */
    PHASE_HENYEY_GREENSTEIN = 5
};

#define PHASE_MURKY_NORM 0.0316392357f          /* 33 / (332 pi) */
#define PHASE_MURKY_ISOTROPIC 0.397590361f      /* 33 / 83: its even part */

/* [Henyey and Greenstein 1941]. With h = |g| and 1 - c counted from the peak,
 * the denominator (1-h)^2 + 2h(1-c) does not cancel. */
HD float phase_hg_eval(float g, float minus, float plus)
{
    float h = fabsf(g);
    float d = (1.0f - h) * (1.0f - h) + 2.0f * h * (g < 0.0f ? plus : minus);
    return WARP_INV_4PI * (1.0f - h) * (1.0f + h) / (d * sqrtf(d));
}

/* The inverse of the distribution of the cosine, u = 0 at -1; as 1 - cosine,
 * and 1 + cosine in *plus. One form for every g, 0 included; g < 0 is the
 * mirror image. */
HD float phase_hg_sample(float g, float u, float *plus)
{
    float h = fabsf(g), t = g < 0.0f ? 1.0f - u : u;
    float k = (1.0f - h) + h * t, d = k + h * t;
    float near = fm_over_within(1.0f - h, d), far = fm_over_within(1.0f + h, d);
    float from_peak = 2.0f * near * near * (1.0f - t) * (1.0f + h * t);
    float from_back = 2.0f * far * far * t * k;
    *plus = g < 0.0f ? from_peak : from_back;
    return g < 0.0f ? from_back : from_peak;
}

/* As phase_hg_sample, for 1 + c^2: the cosine solves c^3 + 3 c = 8 u - 4, here
 * by Cardano's formula where nothing cancels. */
HD float phase_rayleigh_sample(float u, float *plus)
{
    float q = fabsf(4.0f * u - 2.0f);
    float t = fm_pow(q + sqrtf(q * q + 1.0f), 1.0f / 3.0f);
    float c = hd_min(t - 1.0f / t, 1.0f);
    *plus = u < 0.5f ? 1.0f - c : 1.0f + c;
    return u < 0.5f ? 1.0f + c : 1.0f - c;
}

/* As phase_hg_sample, for a mixture of `isotropic` of the isotropic law and
 * the rest of one like (1 + c)^(1/inverse - 1). */
HD float phase_mie_sample(float isotropic, float inverse, float u, float *plus)
{
    float x = u < isotropic ? u / isotropic
            : fm_pow((u - isotropic) / (1.0f - isotropic), inverse);
    x = hd_min(x, 1.0f);
    *plus = 2.0f * x;
    return 2.0f * (1.0f - x);
}

/* x^8 */
HD float phase_power8(float x)
{
    float x2 = x * x, x4 = x2 * x2;
    return x4 * x4;
}

/* The density, from 1 - cosine and 1 + cosine. */
HD float phase_eval_ends(int kind, float g, float minus, float plus)
{
    float x8 = phase_power8(0.5f * plus), x16 = x8 * x8, c = plus - 1.0f;
    switch (kind) {
    case PHASE_MIE_HAZY:
        return 0.5f * WARP_INV_4PI * (1.0f + 9.0f * x8);
    case PHASE_MIE_MURKY:
        return PHASE_MURKY_NORM * (1.0f + 50.0f * x16 * x16);
    case PHASE_RAYLEIGH:
        return 0.75f * WARP_INV_4PI * (1.0f + c * c);
    case PHASE_HENYEY_GREENSTEIN:
        return phase_hg_eval(g, minus, plus);
    default:
        return WARP_INV_4PI;
    }
}

/* For g beyond 0.9 ask phase_eval_between: a cosine rounded by 6e-8 is wrong
 * by 6e-5 of the density at 0.9, by 7e-3 at 0.99, and by all at 0.999. */
HD float phase_eval(int kind, float g, float cosine)
{
    cosine = hd_max(hd_min(cosine, 1.0f), -1.0f);
    return phase_eval_ends(kind, g, 1.0f - cosine, 1.0f + cosine);
}

/* The density between two directions; keeps the digits of a narrow peak. */
HD float phase_eval_between(int kind, float g, vec3 d, vec3 w)
{
    vec3 difference = vec3_sub(d, w), sum = vec3_add(d, w);
    return phase_eval_ends(kind, g, 0.5f * vec3_dot(difference, difference),
                           0.5f * vec3_dot(sum, sum));
}

/* 1 - cosine for a uniform u, drawn with the density itself. */
HD float phase_sample_ends(int kind, float g, float u, float *plus)
{
    switch (kind) {
    case PHASE_MIE_HAZY:
        return phase_mie_sample(0.5f, 1.0f / 9.0f, u, plus);
    case PHASE_MIE_MURKY:
        return phase_mie_sample(PHASE_MURKY_ISOTROPIC, 1.0f / 33.0f, u, plus);
    case PHASE_RAYLEIGH:
        return phase_rayleigh_sample(u, plus);
    case PHASE_HENYEY_GREENSTEIN:
        return phase_hg_sample(g, u, plus);
    default:
        *plus = 2.0f * u;
        return 2.0f * (1.0f - u);
    }
}

/* The unit direction whose cosine with d is 1 - minus and plus - 1, v turns
 * about it. */
HD vec3 phase_turn(vec3 d, float minus, float plus, float v)
{
    float cosine = minus < plus ? 1.0f - minus : plus - 1.0f;
    vec3 local = warp_around_z(cosine, fm_root_within(minus * plus), v);
    return warp_normalize(warp_frame_to_world(warp_frame(d), local));
}

/* The unit direction of travel after a scattering, drawn with density *pdf,
 * which equals the phase function: the weight is 1. */
HD vec3 phase_sample(int kind, float g, vec3 d, float u, float v, float *pdf)
{
    float plus, minus = phase_sample_ends(kind, g, u, &plus);
    *pdf = phase_eval_ends(kind, g, minus, plus);
    return phase_turn(d, minus, plus, v);
}

/* POV-Ray's own phase function over 4 pi p: its types 2 to 4 have the shapes
 * above but do not integrate to 4 pi. Measured with POV-Ray 3.7.0.10 at nine
 * angles from 0 to 180 degrees, which differ by 2e-5; types 1 and 5 (g from
 * -0.9 to 0.99) are within 2e-5 of 1. tests/oracle/phase.py */
HD float phase_pov_scale(int kind)
{
    switch (kind) {
    case PHASE_MIE_HAZY:
        return 1.15331f;
    case PHASE_MIE_MURKY:
        return 1.24681f;
    case PHASE_RAYLEIGH:
        return 1.06584f;
    default:
        return 1.0f;
    }
}

#endif
