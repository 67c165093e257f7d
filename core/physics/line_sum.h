/* line_sum.h - what stretches of a ray add to its optical depth and to what is
 * seen along it. A stretch is two halves of constant coefficients, or two
 * samples of a density that is a function, taken for a complex number (line.h).
 */
#ifndef CORE_PHYSICS_LINE_SUM_H
#define CORE_PHYSICS_LINE_SUM_H
#include "core/physics/fmath.h"
#include "core/physics/scene.h"

typedef struct {
    double tau[3];          /* optical depth: long sums, so double         */
    float odds[3];          /* of functions, half of what two sets of
                               samples tell of it differently              */
    rgb radiance;           /* emitted toward the ray's origin, attenuated */
    uint32_t overflow;      /* media that were left out                    */
} line_integral;

typedef struct {
    rgb sigma_t, source;
} line_point;

typedef struct {
    line_point a, b;
} line_twins;

/* Where the short form of line_reach holds: below ln(2)/2. */
#define LINE_THIN 0.34f

/* Int_0^length exp(-sigma x) dx, good down to sigma = 0. */
HD float line_reach(float sigma, float length)
{
    float tau = sigma * length;
    return tau < LINE_THIN ? length * (1.0f - tau * fm_exp_rest(-tau))
                           : -fm_expm1(-tau) / sigma;
}

/* exp(-tau) of tau >= 0; where it is not normal, by its root. */
HD float line_left(double tau)
{
    float x = (float)tau;
    bool deep = !(x < 87.0f);
    float left = fm_exp_within(deep ? -hd_min(0.5f * x, 87.0f) : -x);
    return deep ? left * left : left;
}

/* What stands for exp(-depth) of a depth told twice: with half the difference
 * `odds`. */
HD float line_pass(double tau, float odds)
{
    float mean = line_left(tau);
    return scene_may(MAY_FUNCTIONS) && odds != 0.0f ? mean * fm_cos(odds)
                                                    : mean;
}

HD float line_half_channel(float source, float sigma, float length, float odds,
                           double *tau)
{
    float seen = source == 0.0f ? 0.0f
               : line_pass(*tau, odds) * source * line_reach(sigma, length);
    *tau += (double)sigma * (double)length;
    return seen;
}

/* Channels whose depths differ, at most. */
HD int line_channels(void)
{
    return scene_may(MAY_COLORS) ? 3 : 1;
}

HD bool line_is_even(rgb sigma)
{
    return sigma.r == sigma.g && sigma.r == sigma.b;
}

/* Whether what passes is the same in all channels, here and before. */
HD bool line_is_gray(const line_integral *out, const line_point *p)
{
    return line_channels() == 1 ||
           (line_is_even(p->sigma_t) &&
            out->tau[0] == out->tau[1] && out->tau[0] == out->tau[2] &&
            (!scene_may(MAY_FUNCTIONS) || (out->odds[0] == out->odds[1] &&
                                           out->odds[0] == out->odds[2])));
}

/* Adds the same depth to all channels. */
HD void line_deepen(line_integral *out, double depth)
{
    for (int c = 0; c < line_channels(); c++)
        out->tau[c] += depth;
}

/* The same numbers as channel by channel, with a third of the exponentials. */
HD void line_half_gray(line_integral *out, const line_point *p, float length)
{
    double depth = (double)p->sigma_t.r * (double)length;
    if (!rgb_is_black(p->source)) {
        float pass = line_pass(out->tau[0], out->odds[0]);
        float reach = line_reach(p->sigma_t.r, length);
        out->radiance.r += pass * p->source.r * reach;
        out->radiance.g += pass * p->source.g * reach;
        out->radiance.b += pass * p->source.b * reach;
    }
    line_deepen(out, depth);
}

/* Adds a part of constant coefficients. */
HD void line_half(line_integral *out, const line_point *p, float length)
{
    if (line_is_gray(out, p)) {
        line_half_gray(out, p, length);
        return;
    }
    out->radiance.r += line_half_channel(p->source.r, p->sigma_t.r, length,
                                         out->odds[0], &out->tau[0]);
    out->radiance.g += line_half_channel(p->source.g, p->sigma_t.g, length,
                                         out->odds[1], &out->tau[1]);
    out->radiance.b += line_half_channel(p->source.b, p->sigma_t.b, length,
                                         out->odds[2], &out->tau[2]);
}

/* line_reach of two, most often thin ones. */
HD void line_reaches(float sigma_a, float sigma_b, float length, float *a,
                     float *b)
{
    float tau_a = sigma_a * length, tau_b = sigma_b * length;
    if (tau_a < LINE_THIN && tau_b < LINE_THIN) {
        *a = length * (1.0f - tau_a * fm_exp_rest(-tau_a));
        *b = length * (1.0f - tau_b * fm_exp_rest(-tau_b));
        return;
    }
    HD_ROLLED
    for (int i = 0; i < 2; i++) {
        float reach = line_reach(i ? sigma_b : sigma_a, length);
        *a = i ? *a : reach;
        *b = reach;
    }
}

/* What counts of the sources of two parts of constant coefficients, one behind
 * the other, each of that length. */
HD void line_weigh(double tau, float odds, float sigma_a, float sigma_b,
                   float length, float *a, float *b)
{
    float pass = line_pass(tau, odds), reach_a, reach_b;
    line_reaches(sigma_a, sigma_b, length, &reach_a, &reach_b);
    *a = pass * reach_a;
    /* sigma times the reach is what is lost. */
    *b = pass * hd_max(1.0f - sigma_a * reach_a, 0.0f) * reach_b;
}

HD float line_halves_channel(float source_a, float source_b, float sigma_a,
                             float sigma_b, float length, float odds,
                             double *tau)
{
    float a = 0.0f, b = 0.0f;
    if (source_a != 0.0f || source_b != 0.0f)
        line_weigh(*tau, odds, sigma_a, sigma_b, length, &a, &b);
    *tau += (double)sigma_a * (double)length;
    *tau += (double)sigma_b * (double)length;
    return a * source_a + b * source_b;
}

/* Adds both halves of a stretch, each of that length. */
HD void line_halves(line_integral *out, const line_twins *x, float length)
{
    const line_point *p = &x->a, *q = &x->b;
    if (line_is_gray(out, p) && (line_channels() == 1 ||
                                 line_is_even(q->sigma_t))) {
        float a, b;
        if (!rgb_is_black(p->source) || !rgb_is_black(q->source)) {
            line_weigh(out->tau[0], out->odds[0], p->sigma_t.r, q->sigma_t.r,
                       length, &a, &b);
            out->radiance.r += a * p->source.r + b * q->source.r;
            out->radiance.g += a * p->source.g + b * q->source.g;
            out->radiance.b += a * p->source.b + b * q->source.b;
        }
        line_deepen(out, (double)p->sigma_t.r * (double)length);
        line_deepen(out, (double)q->sigma_t.r * (double)length);
        return;
    }
    out->radiance.r += line_halves_channel(
        p->source.r, q->source.r, p->sigma_t.r, q->sigma_t.r, length,
        out->odds[0], &out->tau[0]);
    out->radiance.g += line_halves_channel(
        p->source.g, q->source.g, p->sigma_t.g, q->sigma_t.g, length,
        out->odds[1], &out->tau[1]);
    out->radiance.b += line_halves_channel(
        p->source.b, q->source.b, p->sigma_t.b, q->sigma_t.b, length,
        out->odds[2], &out->tau[2]);
}

/* Int_0^1 exp(-z x) dx of z = re + i im, in its place. */
HD void line_complex_reach(float *re, float *im)
{
    float x = *re, y = *im, r = 1.0f, i = 0.0f;
    if (x * x + y * y < 1.0f) {
        /* The sum of (-z)^k / (k + 1)!, by Horner's rule. */
        for (int k = 8; k > 0; k--) {
            float a = (x * r - y * i) / (float)(k + 1);
            float b = (x * i + y * r) / (float)(k + 1);
            r = 1.0f - a;
            i = -b;
        }
        *re = r;
        *im = i;
        return;
    }
    float s, c, left = fm_exp(-x);
    fm_sincos(y, &s, &c);
    r = 1.0f - left * c;
    i = left * s;
    float scale = 1.0f / (x * x + y * y);
    *re = scale * (r * x + i * y);
    *im = scale * (i * x - r * y);
}

/* One channel of a part in which two samples were taken: as if of the complex
 * number of which they make the mean and i times half the difference. */
HD float line_pair_channel(float source_a, float source_b, float sigma_a,
                           float sigma_b, float length, double *tau,
                           float *odds)
{
    float mean = 0.5f * (sigma_a + sigma_b) * length;
    float half = 0.5f * (sigma_a - sigma_b) * length, seen = 0.0f;
    if (source_a != 0.0f || source_b != 0.0f) {
        float s, c, re = mean, im = half;
        float q = 0.5f * (source_a + source_b);
        float p = 0.5f * (source_a - source_b);
        fm_sincos(*odds, &s, &c);
        line_complex_reach(&re, &im);
        /* (c - i s) (q + i p) (re + i im) */
        seen = fm_exp((float)-*tau) * length *
               (c * (q * re - p * im) + s * (q * im + p * re));
    }
    *tau += (double)mean;
    *odds += half;
    return seen;
}

HD void line_pair(line_integral *out, const line_point *a,
                  const line_point *b, float length)
{
    out->radiance.r += line_pair_channel(a->source.r, b->source.r,
                                         a->sigma_t.r, b->sigma_t.r, length,
                                         &out->tau[0], &out->odds[0]);
    out->radiance.g += line_pair_channel(a->source.g, b->source.g,
                                         a->sigma_t.g, b->sigma_t.g, length,
                                         &out->tau[1], &out->odds[1]);
    out->radiance.b += line_pair_channel(a->source.b, b->source.b,
                                         a->sigma_t.b, b->sigma_t.b, length,
                                         &out->tau[2], &out->odds[2]);
}

HD line_integral line_zero(void)
{
    line_integral line;
    for (int i = 0; i < 3; i++) {
        line.tau[i] = 0.0;
        line.odds[i] = 0.0f;
    }
    line.radiance = rgb_gray(0.0f);
    line.overflow = 0;
    return line;
}

HD rgb line_transmittance(const line_integral *l)
{
    if (line_channels() == 1)
        return rgb_gray(line_pass(l->tau[0], l->odds[0]));
    return rgb_make(line_pass(l->tau[0], l->odds[0]),
                    line_pass(l->tau[1], l->odds[1]),
                    line_pass(l->tau[2], l->odds[2]));
}

HD float line_lost(double tau, float odds)
{
    float lost = -fm_expm1((float)-tau);
    if (!scene_may(MAY_FUNCTIONS) || odds == 0.0f)
        return lost;
    float s = fm_sin(0.5f * odds);
    return lost + 2.0f * s * s * fm_exp((float)-tau);
}

/* 1 - transmittance, exact where it is tiny. */
HD rgb line_opacity(const line_integral *l)
{
    if (line_channels() == 1)
        return rgb_gray(line_lost(l->tau[0], l->odds[0]));
    return rgb_make(line_lost(l->tau[0], l->odds[0]),
                    line_lost(l->tau[1], l->odds[1]),
                    line_lost(l->tau[2], l->odds[2]));
}

#endif
