/* pattern_plain.h - patterns that are a formula of the point.
 *
 * All patterns take the point in pattern space and their numbers, which
 * pattern.h lists, and give the value before frequency, phase and wave type.
 * Formulae: the manual of POV-Ray 3.7 and measurement. */
#ifndef CORE_PHYSICS_PATTERN_PLAIN_H
#define CORE_PHYSICS_PATTERN_PLAIN_H
#include "core/physics/noise.h"
#include "core/physics/wave.h"

#define PATTERN_TURN REAL(6.283185307179586)    /* in radians */

/* What a point may be short of the edge of a block or cell and count as in
 * the next, so that planes along edges do not flicker. */
#define PATTERN_EDGE REAL_CHOOSE(1e-10, 1e-5f)

HD real pattern_boxed(real3 p, const real *param)
{
    (void)param;
    real far = real_max(real_abs(p.x), real_max(real_abs(p.y), real_abs(p.z)));
    return REAL(1.0) - real_min(far, REAL(1.0));
}

HD real pattern_cylindrical(real3 p, const real *param)
{
    (void)param;
    return REAL(1.0)
         - real_min(real_sqrt(p.x * p.x + p.z * p.z), REAL(1.0));
}

HD real pattern_planar(real3 p, const real *param)
{
    (void)param;
    return REAL(1.0) - real_min(real_abs(p.y), REAL(1.0));
}

HD real pattern_spherical(real3 p, const real *param)
{
    (void)param;
    return REAL(1.0) - real_min(real3_length(p), REAL(1.0));
}

HD real pattern_gradient(real3 p, const real *param)
{
    real3 along = real3_make(param[0], param[1], param[2]);
    real length = real3_length(along);
    real v = length > REAL(0.0) ? real3_dot(p, along) / length : REAL(0.0);
    return v > REAL(1.0) ? real_fmod(v, REAL(1.0)) : v;
}

HD real pattern_leopard(real3 p, const real *param)
{
    (void)param;
    real v = (real_sin(p.x) + real_sin(p.y) + real_sin(p.z)) / REAL(3.0);
    return v * v;
}

HD real pattern_onion(real3 p, const real *param)
{
    (void)param;
    return real_fmod(real3_length(p), REAL(1.0));
}

HD real pattern_radial(real3 p, const real *param)
{
    (void)param;
    if (real_abs(p.x) < REAL(0.001) && real_abs(p.z) < REAL(0.001))
        return REAL(0.25);
    return REAL(0.75) + real_atan2(p.x, p.z) / PATTERN_TURN;
}

/* Old-style turbulence: along the value, not of the point. */
HD real pattern_marble(real3 p, const real *param)
{
    if (param[4] == REAL(0.0))
        return p.x;
    return p.x + param[4]
         * noise_turbulence((int)param[0], p, noise_series_of(param + 1));
}

/* ... in waves about the place. */
HD real pattern_wood(real3 p, const real *param)
{
    if (param[3] != REAL(0.0) || param[4] != REAL(0.0)) {
        real3 t = noise_vector_turbulence(p, noise_series_of(param));
        p.x += wave_sine((p.x + t.x) * param[3]);
        p.y += wave_sine((p.y + t.y) * param[4]);
    }
    return real_sqrt(p.x * p.x + p.y * p.y);
}

/* Turns about z, from -y on, in [0, 1). */
HD real pattern_turn(real3 p)
{
    if (p.x == REAL(0.0) && p.y == REAL(0.0))
        return REAL(0.0);
    real turn = REAL(0.25) + real_atan2(p.y, p.x) / PATTERN_TURN;
    return turn < REAL(0.0) ? turn + REAL(1.0) : turn;
}

/* Beside the usual turbulence, which comes before, the spirals know one along
 * the value. */
HD real pattern_spiral1(real3 p, const real *param)
{
    real v = p.z + real_sqrt(p.x * p.x + p.y * p.y)
           + param[5] * pattern_turn(p);
    if (param[4] != REAL(0.0))
        v += param[4] * noise_turbulence((int)param[0], p,
                                         noise_series_of(param + 1));
    return v;
}

HD real pattern_spiral2(real3 p, const real *param)
{
    return wave_triangle(pattern_spiral1(p, param))
         + wave_triangle(real_sqrt(p.x * p.x + p.y * p.y));
}

/* The slope of a quilt's cell at the distance t from its middle: a cubic with
 * the ordinates control0 and control1. */
HD real pattern_quilt(real t, const real *param)
{
    real s = REAL(1.0) - t;
    return REAL(1.154700538) * (REAL(3.0) * s * t
                                * (s * param[0] + t * param[1]) + t * t * t);
}

HD real pattern_quilted(real3 p, const real *param)
{
    real x = wave_fraction(p.x) - REAL(0.5);
    real y = wave_fraction(p.y) - REAL(0.5);
    real z = wave_fraction(p.z) - REAL(0.5);
    return (real_abs(x) + real_abs(y) + real_abs(z)) / REAL(3.0)
         * pattern_quilt(real3_length(real3_make(x, y, z)), param);
}

#endif
