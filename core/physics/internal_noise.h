/* internal_noise.h - the internal functions of functions.inc that are made
 * of noise: f_noise3d and fractals.
 *
 * hetero_mf and ridged_mf are Musgrave's heterogeneous terrain and ridged
 * multifractal [Ebert et al. 2003, 16], of noise in [-1, 1]; details are
 * those of the values that POV-Ray 3.7 prints. */
#ifndef CORE_PHYSICS_INTERNAL_NOISE_H
#define CORE_PHYSICS_INTERNAL_NOISE_H
#include "core/physics/elementary.h"
#include "core/physics/noise.h"

enum { INTERNAL_OCTAVES = 64 };

/* The generator a parameter asks for; 0 is that of POV-Ray 3.1. */
HD int internal_generator(real g)
{
    return (int)real_clamp(g, REAL(1.0), REAL(3.0));
}

HD real internal_octaves(real octaves)
{
    return real_clamp(octaves, REAL(0.0), (real)INTERNAL_OCTAVES);
}

HD real internal_noise3d(real x, real y, real z, const real *p)
{
    (void)p;
    return noise_value(2, real3_make(x, y, z));
}

HD real internal_noise_generator(real x, real y, real z, const real *p)
{
    return noise_value(internal_generator(p[0]), real3_make(x, y, z));
}

HD real internal_signed_noise(real3 q, real generator)
{
    return 2 * noise_value(internal_generator(generator), q) - 1;
}

/* P0 H, P1 lacunarity, P2 octaves, P3 offset, P4 T: each octave is weighed by
 * the altitude so far to the whole power T. A fraction of an octave adds to
 * the one begun for it, weighed by the altitude. */
HD real internal_hetero_mf(real x, real y, real z, const real *p)
{
    real octaves = internal_octaves(p[2]);
    real weight = real_power(p[1], -p[0]), scale = weight, height, step;
    real3 q = real3_make(x, y, z);
    int power = (int)real_clamp(p[4], REAL(0.0), REAL(64.0));
    height = p[3] + internal_signed_noise(q, p[5]);
    for (int i = 1; i < octaves; i++) {
        q = real3_scale(q, p[1]);
        step = (internal_signed_noise(q, p[5]) + p[3]) * scale;
        for (int k = 0; k < power; k++)
            step *= height;
        height += step;
        scale *= weight;
    }
    octaves -= real_floor(octaves);
    if (octaves > 0)
        height += octaves * height * scale
                * (internal_signed_noise(real3_scale(q, p[1]), p[5]) + p[3]);
    return height;
}

HD real internal_ridge_signal(real3 q, real offset, real generator)
{
    real d = offset - real_abs(internal_signed_noise(q, generator));
    return d * d;
}

/* P0 H, P1 lacunarity, P2 octaves, P3 offset, P4 gain. In POV-Ray P0 to P2
 * are those of the first call in a scene, which is not imitated. */
HD real internal_ridged_mf(real x, real y, real z, const real *p)
{
    real octaves = internal_octaves(p[2]);
    real weight = real_power(p[1], -p[0]), scale = weight, signal, sum;
    real3 q = real3_make(x, y, z);
    sum = signal = internal_ridge_signal(q, p[3], p[5]);
    for (int i = 1; i < octaves; i++) {
        q = real3_scale(q, p[1]);
        signal = real_clamp(signal * p[4], REAL(0.0), REAL(1.0))
               * internal_ridge_signal(q, p[3], p[5]);
        sum += signal * scale;
        scale *= weight;
    }
    return sum;
}

/* |v - a| or v - a over the farther of 0 and 1 from a */
HD real internal_spread(real v, real a)
{
    return v / real_max(a, 1 - a);
}

/* P0 lambda, P1 octaves, P2 omega, P3 offset, P4 ridge: turbulence folded at
 * the ridge. The last octave may be a fraction. */
HD real internal_ridge(real x, real y, real z, const real *p)
{
    real octaves = real_max(internal_octaves(p[1]), REAL(1.0));
    real weight = REAL(1.0), weights = REAL(0.0), sum = REAL(0.0);
    real3 q = real3_make(x, y, z);
    int generator = internal_generator(p[5]);
    for (; octaves > 0; octaves -= 1) {
        real share = weight * real_min(octaves, REAL(1.0));
        real noise = noise_value(generator, q);
        sum += share * internal_spread(real_abs(noise - p[4]), p[4]);
        weights += share;
        weight *= p[2];
        q = real3_scale(q, p[0]);
    }
    return internal_spread(sum / weights - p[3], p[3]);
}

#endif
