/* wave.h - from a pattern's value to the place in its map: frequency, phase
 * and wave type, as POV-Ray 3.7 does it (measured).
 *
 * What comes out is in [0, 1], but for frequency 0 and for poly_wave of a
 * negative exponent. Nothing that is not finite comes out. */
#ifndef CORE_PHYSICS_WAVE_H
#define CORE_PHYSICS_WAVE_H
#include "core/physics/elementary.h"

#define WAVE_TYPES(X)                                                         \
    X(RAMP) X(TRIANGLE) X(SINE) X(SCALLOP) X(CUBIC) X(POLY)

enum wave_type {
#define X(name) WAVE_##name,
    WAVE_TYPES(X)
#undef X
    WAVE_COUNT
};

HD real wave_finite(real v)
{
    return real_abs(v) < REAL(1e30) ? v : REAL(0.0);
}

/* What is left of whole numbers, in [0, 1). */
HD real wave_fraction(real v)
{
    return v - real_floor(v);
}

/* From 0 up to 1 in the middle and down again. */
HD real wave_triangle(real v)
{
    v = wave_fraction(v);
    return REAL(2.0) * real_min(v, REAL(1.0) - v);
}

HD real wave_sine(real v)
{
    return real_sin(REAL(6.283185307179586) * v);
}

/* v frequency + phase, wrapped. The divisor keeps 1 where it is, and what is
 * below needs no division; frequency 0 leaves all as it is. POV-Ray holds both
 * in single precision. */
HD real wave_wrap(real v, real frequency, real phase)
{
    const real period = REAL(1.00001);
    v = wave_finite(v);
    if (frequency != REAL(0.0)) {
        v = v * (real)(float)frequency + (real)(float)phase;
        if (!(v >= REAL(0.0) && v < period))
            v = real_fmod(v, period);
    }
    return v < REAL(0.0) ? wave_fraction(v) : v;
}

/* A wrapped value through a wave of the given type; the exponent is that of
 * poly_wave. */
HD real wave_shape(int type, real exponent, real v)
{
    switch (type) {
    case WAVE_TRIANGLE:
        return wave_triangle(v);
    case WAVE_SINE:
        return REAL(0.5) * (REAL(1.0) + wave_sine(v));
    case WAVE_SCALLOP:
        return real_abs(real_sin(REAL(3.141592653589793) * v));
    case WAVE_CUBIC:
        return v * v * (REAL(3.0) - REAL(2.0) * v);
    case WAVE_POLY:
        return real_power(v, (real)(float)exponent);
    default:
        return v;
    }
}

/* Both. */
HD real wave_value(int type, real exponent, real frequency, real phase,
                   real v)
{
    v = wave_wrap(v, frequency, phase);
    return wave_finite(wave_shape(type, exponent, v));
}

#endif
