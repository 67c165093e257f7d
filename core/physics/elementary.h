/* elementary.h - elementary functions of `real` beyond those of real.h, as
 * the byte-code machine (machine.h) gives them to user functions.
 *
 * Outside of a function's range the result is NaN or infinite as in C; in
 * float they are composed from fmath.h and are good to about 1e-6, relative
 * to the larger of the argument, the value and 1. */
#ifndef CORE_PHYSICS_ELEMENTARY_H
#define CORE_PHYSICS_ELEMENTARY_H
#include "core/physics/real.h"

#define REAL_DEGREE REAL(0.017453292519943295)  /* pi/180                  */
#define REAL_LN10 REAL(2.3025850929940457)

HD real real_trunc(real x)
{
    return REAL_CHOOSE(trunc(x), truncf(x));
}

HD real real_fmod(real x, real y)
{
    return REAL_CHOOSE(fmod(x, y), fmodf(x, y));
}

HD real real_log10(real x)
{
    return REAL_CHOOSE(log10(x), fm_log(x) / REAL_LN10);
}

HD real real_tan(real x)
{
    return REAL_CHOOSE(tan(x), fm_sin(x) / fm_cos(x));
}

HD real real_atan(real x)
{
    return real_atan2(x, REAL(1.0));
}

/* In float by the half-angle from the nearer end, where acos is steep. */
HD real real_asin(real x)
{
    return REAL_CHOOSE(asin(x),
                       fm_atan2(x, sqrtf((1.0f - x) * (1.0f + x))));
}

HD real real_sinh(real x)
{
    return REAL_CHOOSE(sinh(x), 0.5f * (fm_expm1(x) - fm_expm1(-x)));
}

HD real real_cosh(real x)
{
    return REAL_CHOOSE(cosh(x), 0.5f * (fm_exp(x) + fm_exp(-x)));
}

HD float elementary_tanh(float x)
{
    float e;
    if (fabsf(x) > 20.0f)
        return copysignf(1.0f, x);
    e = fm_expm1(2.0f * x);
    return e / (e + 2.0f);
}

HD real real_tanh(real x)
{
    return REAL_CHOOSE(tanh(x), elementary_tanh(x));
}

HD float elementary_asinh(float x)
{
    float a = fabsf(x);
    float y = a > 1e9f ? fm_log(a) + 0.693147182f
                       : fm_log1p(a + a * a / (1.0f + sqrtf(a * a + 1.0f)));
    return copysignf(y, x);
}

HD real real_asinh(real x)
{
    return REAL_CHOOSE(asinh(x), elementary_asinh(x));
}

HD float elementary_acosh(float x)
{
    float d = x - 1.0f;
    return x > 1e9f ? fm_log(x) + 0.693147182f
                    : fm_log1p(d + sqrtf(d * (x + 1.0f)));
}

HD real real_acosh(real x)
{
    return REAL_CHOOSE(acosh(x), elementary_acosh(x));
}

HD real real_atanh(real x)
{
    return REAL_CHOOSE(atanh(x),
                       0.5f * (fm_log1p(x) - fm_log1p(-x)));
}

/* For x < 0 by that of -x, if y is a whole number. */
HD float elementary_pow(float x, float y)
{
    float p, odd;
    if (!(x < 0.0f) || y != floorf(y))
        return fm_pow(x, y);
    p = fm_pow(-x, y);
    odd = fmodf(y, 2.0f);
    return odd == 1.0f || odd == -1.0f ? -p : p;
}

/* x^y as in C: a negative x takes whole numbers y. */
HD real real_power(real x, real y)
{
    return REAL_CHOOSE(pow(x, y), elementary_pow(x, y));
}

#endif
