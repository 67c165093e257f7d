/* fmath.h - elementary functions of floats, the same bits everywhere.
 *
 * Only + - * / and sqrtf, which IEEE 754 rounds one way, so that an image
 * does not depend on the C library or the processor. Compile with contraction
 * off. Errors are the largest seen over all floats, in units in the last place
 * (ulp) of the result, against the same function in double. Coefficients:
 * our own minimax fits, tests/oracle/minimax.py. NaN gives NaN. */
#ifndef CORE_PHYSICS_FMATH_H
#define CORE_PHYSICS_FMATH_H
#include <math.h>
#include <string.h>
#include "core/physics/hd.h"

#define FM_PI 3.14159265f
#define FM_PI_LO -8.74227766e-08f       /* pi - FM_PI            */
#define FM_HALF_PI 1.57079637f
#define FM_HALF_PI_LO -4.37113883e-08f  /* pi/2 - FM_HALF_PI     */
#define FM_LN2_HI 0.693145752f          /* 15 bits: n times it is exact */
#define FM_LN2_LO 1.42860677e-06f
#define FM_SIN_CODY 10000.0f            /* four parts of pi/2 do up to here */

HD uint32_t fm_bits(float x)
{
#ifdef __CUDA_ARCH__
    return __float_as_uint(x);
#else
    uint32_t u;
    memcpy(&u, &x, sizeof u);
    return u;
#endif
}

HD float fm_from_bits(uint32_t u)
{
#ifdef __CUDA_ARCH__
    return __uint_as_float(u);
#else
    float x;
    memcpy(&x, &u, sizeof x);
    return x;
#endif
}

/* ---- numbers that are neither huge nor tiny ----------------------------- */

/* Quotients and roots, to the bits of / and sqrtf, where arguments and result
 * lie within 2^-100 and 2^100 in size, or the numerator is 0. A GPU would ask
 * each time whether they do, and go another way where not: here it takes the
 * steps alone, a third of the instructions. */
#ifdef __CUDA_ARCH__
HD float fm_rough_inverse(float x)
{
    float r;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(x));
    return r;
}

HD float fm_rough_inverse_root(float x)
{
    float r;
    asm("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(x));
    return r;
}
#endif

/* 1 / x, x not 0. */
HD float fm_inverse_within(float x)
{
#ifdef __CUDA_ARCH__
    float r = fm_rough_inverse(x);
    return __fmaf_rn(r, __fmaf_rn(-x, r, 1.0f), r);
#else
    return 1.0f / x;
#endif
}

/* x / y; `inverse` is 1 / y, rounded [Brisebarre, Muller, Raina 2004]. */
HD float fm_over_known(float x, float y, float inverse)
{
#ifdef __CUDA_ARCH__
    float q = x * inverse;
    return __fmaf_rn(__fmaf_rn(-q, y, x), inverse, q);
#else
    (void)inverse;
    return x / y;
#endif
}

/* x / y, y not 0. */
HD float fm_over_within(float x, float y)
{
#ifdef __CUDA_ARCH__
    float r = fm_inverse_within(y), q = x * r;
    q = __fmaf_rn(__fmaf_rn(-q, y, x), r, q);
    return __fmaf_rn(__fmaf_rn(-q, y, x), r, q);
#else
    return x / y;
#endif
}

/* The root of x; of 0 as well. */
HD float fm_root_within(float x)
{
#ifdef __CUDA_ARCH__
    float r = fm_rough_inverse_root(x), q = x * r;
    q = __fmaf_rn(__fmaf_rn(-q, q, x), 0.5f * r, q);
    return x > 0.0f ? q : 0.0f;
#else
    return sqrtf(x);
#endif
}

/* Nearest integer, ties to even, for |x| < 2^22. */
HD float fm_round(float x)
{
    const float shift = 12582912.0f;    /* 1.5 2^23 */
    return (x + shift) - shift;
}

/* x 2^n rounded once, for x near 1 and -252 <= n <= 254. */
HD float fm_scale(float x, int n)
{
    int half = n / 2;
    float a = fm_from_bits((uint32_t)(half + 127) << 23);
    float b = fm_from_bits((uint32_t)(n - half + 127) << 23);
    return x * a * b;
}

/* (e^r - 1 - r) / r^2 for |r| <= ln(2)/2 */
HD float fm_exp_rest(float r)
{
    float q = 0.000197601912f;
    q = q * r + 0.00139323086f;
    q = q * r + 0.00833354797f;
    q = q * r + 0.0416664928f;
    q = q * r + 0.166666657f;
    return q * r + 0.5f;
}

/* e^r - 1 for |r| <= ln(2)/2 */
HD float fm_expm1_reduced(float r)
{
    return r + r * r * fm_exp_rest(r);
}

/* fm_exp for |x| <= 87, whose results are normal: to the same bits. */
HD float fm_exp_within(float x)
{
    const float shift = 12582912.0f;    /* its bits end in those of n */
    float t = x * 1.44269502f + shift, n = t - shift;
    float r = (x - n * FM_LN2_HI) - n * FM_LN2_LO;
    return fm_from_bits(fm_bits(1.0f + fm_expm1_reduced(r)) +
                        (fm_bits(t) << 23));
}

/* Error <= 1 ulp, denormal results included. */
HD float fm_exp(float x)
{
    if (x > 89.0f)
        return INFINITY;
    if (x < -104.0f)
        return 0.0f;
    if (x != x)
        return x;
    float n = fm_round(x * 1.44269502f);
    float r = (x - n * FM_LN2_HI) - n * FM_LN2_LO;
    return fm_scale(1.0f + fm_expm1_reduced(r), (int)n);
}

/* e^x - 1; error <= 1.5 ulp. */
HD float fm_expm1(float x)
{
    if (x > 17.5f)
        return fm_exp(x);
    if (x < -17.5f)
        return -1.0f;
    if (x != x)
        return x;
    float n = fm_round(x * 1.44269502f);
    if (n == 0.0f)
        return fm_expm1_reduced(x);
    float hi = x - n * FM_LN2_HI, lo = n * FM_LN2_LO;
    float r = hi - lo, tail = (hi - r) - lo;
    float e = fm_expm1_reduced(r);
    float scale = fm_scale(1.0f, (int)n);
    return scale * (e + (tail + tail * e)) + (scale - 1.0f);
}

/* x = 2^n m with m in [sqrt(1/2), sqrt(2)); x normal, positive, finite. */
HD float fm_split(float x, int *n)
{
    const uint32_t root_half = 0x3f3504f3u;
    uint32_t u = fm_bits(x) - root_half;
    *n = (int)(u >> 23) - (int)((u >> 31) << 9);
    return fm_from_bits((u & 0x007fffffu) + root_half);
}

/* log(1 + f) + n log 2 + extra, for 1 + f in [sqrt(1/2), sqrt(2)). */
HD float fm_log_reduced(float f, int n, float extra)
{
    float p = 0.0674927905f, square = f * f, k = (float)n;
    p = p * f - 0.116701059f;
    p = p * f + 0.118835501f;
    p = p * f - 0.124062337f;
    p = p * f + 0.142203584f;
    p = p * f - 0.166679889f;
    p = p * f + 0.200020716f;
    p = p * f - 0.250000089f;
    p = p * f + 0.333333135f;
    p = square * f * p + (extra + k * FM_LN2_LO);
    return k * FM_LN2_HI + (f + (p - 0.5f * square));
}

/* Error <= 1 ulp. 0 gives -inf, a negative number NaN. */
HD float fm_log(float x)
{
    int n, denormal = 0;
    if (!(x > 0.0f))
        return x == 0.0f ? -INFINITY : NAN;
    if (x == INFINITY)
        return x;
    if (x < 1.17549435e-38f) {
        x *= 8388608.0f;
        denormal = 23;
    }
    float m = fm_split(x, &n);
    return fm_log_reduced(m - 1.0f, n - denormal, 0.0f);
}

/* log(1 + x); error <= 1 ulp. */
HD float fm_log1p(float x)
{
    int n;
    float u = 1.0f + x;
    if (!(u > 0.0f))
        return u == 0.0f ? -INFINITY : NAN;
    if (u == INFINITY)
        return u;
    float m = fm_split(u, &n);
    if (n == 0)
        return fm_log_reduced(x, 0, 0.0f);
    float lost = x < 1.0f ? x - (u - 1.0f) : 1.0f - (u - x);
    return fm_log_reduced(m - 1.0f, n, lost / u);
}

/* Word i of 0, then 2/pi in binary after the point. */
HD uint32_t fm_two_over_pi(uint32_t i)
{
    switch (i) {
    case 0: return 0u;
    case 1: return 0xa2f9836eu;
    case 2: return 0x4e441529u;
    case 3: return 0xfc2757d1u;
    case 4: return 0xf534ddc0u;
    case 5: return 0xdb629599u;
    case 6: return 0x3c439041u;
    default: return 0xfe5163abu;
    }
}

typedef struct {
    float rest;
    int quadrant;
} fm_turn;

/* x modulo pi/2 for finite x > FM_SIN_CODY: the significand m times those 96
 * bits of 2/pi that neither are multiples of 4 nor vanish [Payne and Hanek
 * 1983]. Returns the rest in [-pi/4, pi/4] and the quotient modulo 4. Apart:
 * it would be a quarter of a kernel. */
HD_APART fm_turn fm_turn_large(float x)
{
    fm_turn out;
    uint32_t u = fm_bits(x);
    uint64_t m = (u & 0x007fffffu) | 0x00800000u;
    uint32_t offset = (u >> 23) - 150u + 30u;       /* x = m 2^(offset-30) */
    uint32_t word = offset / 32u, shift = offset % 32u;
    uint64_t part[3];
    for (uint32_t i = 0; i < 3u; i++) {
        uint64_t two = (uint64_t)fm_two_over_pi(word + i) << 32
                     | fm_two_over_pi(word + i + 1u);
        part[i] = two << shift >> 32;
    }
    uint64_t turns = (m * part[0] << 32) + m * part[1] + (m * part[2] >> 32);
    out.quadrant = (int)((turns + (1ull << 61)) >> 62 & 3u);
    out.rest = (float)(int64_t)(turns << 2) * 8.51530395e-20f;  /* pi/2 2^-64 */
    return out;
}

HD float fm_reduce_large(float x, int *quadrant)
{
    fm_turn out = fm_turn_large(x);
    *quadrant = out.quadrant;
    return out.rest;
}

/* fm_reduce for |x| <= FM_SIN_CODY. The parts of pi/2 have 11 bits but the
 * last, so that products with n <= 6366 are exact. */
HD float fm_reduce_small(float x, int *quadrant)
{
    float n = fm_round(x * 0.636619747f);
    *quadrant = (int)n;
    float r = (x - n * 1.5703125f) - n * 0.000483751297f;
    return (r - n * 7.54953362e-08f) - n * 2.56334407e-12f;
}

/* x = quadrant pi/2 + r with |r| <= pi/4; x finite. */
HD float fm_reduce(float x, int *quadrant)
{
    if (x > FM_SIN_CODY)
        return fm_reduce_large(x, quadrant);
    if (x < -FM_SIN_CODY) {
        float r = -fm_reduce_large(-x, quadrant);
        *quadrant = -*quadrant;
        return r;
    }
    return fm_reduce_small(x, quadrant);
}

HD float fm_sin_reduced(float r)
{
    float z = r * r, p = 2.8375141e-06f;
    p = p * z - 0.000198535112f;
    p = p * z + 0.00833338033f;
    p = p * z - 0.166666672f;
    return r + r * z * p;
}

HD float fm_cos_reduced(float r)
{
    float z = r * r, p = 2.44323273e-05f;
    p = p * z - 0.00138873095f;
    p = p * z + 0.0416666456f;
    return 1.0f - (0.5f * z - z * z * p);
}

/* Of quadrant q, and a rest. */
HD void fm_sincos_reduced(float r, int q, float *sine, float *cosine)
{
    float s = fm_sin_reduced(r), c = fm_cos_reduced(r);
    float a = (q & 1) ? c : s, b = (q & 1) ? s : c;
    *sine = (q & 2) ? -a : a;
    *cosine = ((q + 1) & 2) ? -b : b;
}

/* fm_sincos for |x| <= FM_SIN_CODY, to the same bits. */
HD void fm_sincos_within(float x, float *sine, float *cosine)
{
    int q;
    float r = fm_reduce_small(x, &q);
    fm_sincos_reduced(r, q, sine, cosine);
}

/* Radians. Errors <= 3 ulp for every x; absolute <= 1e-7.
 * An infinite x gives NaN. */
HD void fm_sincos(float x, float *sine, float *cosine)
{
    int q;
    if (!(x - x == 0.0f)) {
        *sine = *cosine = NAN;
        return;
    }
    float r = fm_reduce(x, &q);
    fm_sincos_reduced(r, q, sine, cosine);
}

HD float fm_sin(float x)
{
    float s, c;
    fm_sincos(x, &s, &c);
    return s;
}

HD float fm_cos(float x)
{
    float s, c;
    fm_sincos(x, &s, &c);
    return c;
}

/* atan(z) for 0 <= z <= 1 */
HD float fm_atan_reduced(float z)
{
    float s = z * z, p = -0.00177927758f;
    p = p * s + 0.0108540263f;
    p = p * s - 0.0310719069f;
    p = p * s + 0.057858523f;
    p = p * s - 0.0839811638f;
    p = p * s + 0.109505318f;
    p = p * s - 0.142639637f;
    p = p * s + 0.199985266f;
    p = p * s - 0.333332986f;
    return z + z * s * p;
}

/* Angle of (x, y) in [-pi, pi]; error <= 2.5 ulp. Signs of zero and
 * infinities as in C. */
HD float fm_atan2(float y, float x)
{
    float ax = fabsf(x), ay = fabsf(y);
    if (x != x || y != y)
        return x + y;
    float big = hd_max(ax, ay), small = hd_min(ax, ay);
    float z = small == big ? (big > 0.0f ? 1.0f : 0.0f) : small / big;
    float a = fm_atan_reduced(z);
    if (ay > ax)
        a = FM_HALF_PI - (a - FM_HALF_PI_LO);
    if (fm_bits(x) >> 31)
        a = FM_PI - (a - FM_PI_LO);
    return copysignf(a, y);
}

/* asin(x) for 0 <= x <= 1/2 */
HD float fm_asin_reduced(float x)
{
    float z = x * x, p = 0.0422118045f;
    p = p * z + 0.0241520908f;
    p = p * z + 0.0454760417f;
    p = p * z + 0.0749525204f;
    p = p * z + 0.166667536f;
    return x + x * z * p;
}

/* Error <= 2 ulp; outside [-1, 1] NaN. */
HD float fm_acos(float x)
{
    float a = fabsf(x);
    if (!(a <= 1.0f))
        return NAN;
    if (a <= 0.5f) {
        float s = fm_asin_reduced(a);
        return FM_HALF_PI - ((x < 0.0f ? -s : s) - FM_HALF_PI_LO);
    }
    float half = fm_asin_reduced(sqrtf(0.5f * (1.0f - a)));
    return x < 0.0f ? FM_PI - (2.0f * half - FM_PI_LO) : 2.0f * half;
}

/* The 12 leading bits of x: what is left has 12 too. */
HD float fm_head(float x)
{
    return fm_from_bits(fm_bits(x) & 0xfffff000u);
}

/* a b - p, exactly, for p = a b rounded [Dekker 1971]. */
HD float fm_product_tail(float a, float b, float p)
{
    float ah = fm_head(a), al = a - ah, bh = fm_head(b), bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
}

/* log2(x) as head + *tail, good to 2^-28 of itself; x positive, finite. With
 * x = 2^n m and s = (m - 1)/(m + 1): log2 x = n + 2/ln 2 atanh(s). */
HD float fm_log2_pair(float x, float *tail)
{
    const float c = 2.88539004f, c_tail = 3.85192607e-08f;
    int n, denormal = 0;
    if (x < 1.17549435e-38f) {
        x *= 8388608.0f;
        denormal = 23;
    }
    float f = fm_split(x, &n) - 1.0f;
    float d = 2.0f + f, d_tail = f - (d - 2.0f);
    float s = f / d, sd = s * d;
    float s_tail = (((f - sd) - fm_product_tail(s, d, sd)) - s * d_tail) / d;
    float z = s * s, p = 0.3382532f;
    p = p * z + 0.411853701f;
    p = p * z + 0.577079535f;
    p = p * z + 0.961796701f;
    float k = (float)(n - denormal), a = c * s;
    float a_tail = fm_product_tail(c, s, a)
                 + (s * c_tail + s_tail * c + s * z * p);
    float b = a + a_tail;
    a_tail = a_tail - (b - a);
    float head = k + b;
    *tail = (b - (head - k)) + a_tail;
    return head;
}

/* 2^r for |r| <= 1/2 and a little more */
HD float fm_exp2_reduced(float r)
{
    float p = 1.43202278e-05f;
    p = p * r + 0.000154520938f;
    p = p * r + 0.00133379723f;
    p = p * r + 0.00961808674f;
    p = p * r + 0.0555040501f;
    p = p * r + 0.240226507f;
    p = p * r + 0.693147182f;
    return 1.0f + r * p;
}

HD float fm_pow_special(float x, float y)
{
    if (y == 0.0f || x == 1.0f)
        return 1.0f;
    if (x != x || y != y || x < 0.0f)
        return NAN;
    if (y - y != 0.0f)
        return (x > 1.0f) == (y > 0.0f) ? INFINITY : 0.0f;
    return (x > 0.0f) == (y > 0.0f) ? INFINITY : 0.0f;
}

/* x^y for x >= 0 (NaN below, but x^0 = 1); error <= 1.5 ulp for
 * |y| <= 30, <= 6 ulp beyond: that of log2 grows with y. */
HD float fm_pow(float x, float y)
{
    float tail;
    if (!(x > 0.0f) || !(x < INFINITY) || !(fabsf(y) < INFINITY))
        return fm_pow_special(x, y);
    float head = fm_log2_pair(x, &tail), p = head * y;
    if (p > 129.0f)
        return INFINITY;
    if (p < -151.0f)
        return 0.0f;
    float n = fm_round(p);
    float r = (p - n) + (fm_product_tail(head, y, p) + tail * y);
    return fm_scale(fm_exp2_reduced(r), (int)n);
}

#endif
