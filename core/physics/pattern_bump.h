/* pattern_bump.h - normals that patterns bend. Measured of POV-Ray 3.7.
 *
 * Point and normal (unit) are in pattern space, and so is the result: normals
 * go there and back as normals do, and are made unit each time, so that a
 * pattern that is scaled evenly keeps its depth. The new normal is
 *
 *     unit(normal + amount push),
 *
 * push being one of those below or, for all other patterns, that of the slope
 * of their value f, with wave type and slope_map, at four corners about p:
 *
 *     push = -0.1 / accuracy sum corner_i f(p + accuracy corner_i)
 *
 * with accuracy 0.02 if none is given. Facets are of another kind. */
#ifndef CORE_PHYSICS_PATTERN_BUMP_H
#define CORE_PHYSICS_PATTERN_BUMP_H
#include "core/physics/pattern_noise.h"
#include "core/physics/pattern_normal.h"

enum { PATTERN_CORNERS = 4 };

/* The corners of a regular tetrahedron. */
HD real3 pattern_corner(int i)
{
    switch (i) {
    case 0:
        return real3_make(REAL(0.0), REAL(1.0), REAL(0.0));
    case 1:
        return real3_make(REAL(0.942809), REAL(-0.333333), REAL(0.0));
    case 2:
        return real3_make(REAL(-0.471405), REAL(-0.333333), REAL(0.816497));
    default:
        return real3_make(REAL(-0.471405), REAL(-0.333333), REAL(-0.816497));
    }
}

/* What f at the i-th corner adds to push. */
HD real3 pattern_corner_push(int i, real f, real accuracy)
{
    return real3_scale(pattern_corner(i), REAL(-0.1) / accuracy * f);
}

/* generator, as for all: bumps do without */
HD real3 pattern_push_bumps(real3 p, const real *param)
{
    (void)param;
    return noise_vector(p);
}

HD real3 pattern_push_dents(real3 p, const real *param)
{
    return real3_scale(noise_vector(p), pattern_dents(p, param));
}

HD real3 pattern_push_wrinkles(real3 p, const real *param)
{
    real3 sum = real3_make(REAL(0.0), REAL(0.0), REAL(0.0));
    real scale = REAL(1.0);
    (void)param;
    for (int i = 0; i < 10; i++) {
        real3 d = noise_vector(real3_scale(p, scale));
        sum = real3_mad(sum, REAL(1.0) / scale,
                        real3_make(real_abs(d.x), real_abs(d.y),
                                   real_abs(d.z)));
        scale *= REAL(2.0);
    }
    return sum;
}

/* control0, control1 */
HD real3 pattern_push_quilted(real3 p, const real *param)
{
    real3 d = real3_make(wave_fraction(p.x) - REAL(0.5),
                         wave_fraction(p.y) - REAL(0.5),
                         wave_fraction(p.z) - REAL(0.5));
    return real3_scale(d, pattern_quilt(real3_length(d), param));
}

/* The numbers of ripples and waves (pattern.h): away from each source. */
HD real3 pattern_push_sources(real3 p, const real *param, bool waves)
{
    int count = (int)param[0];
    real3 sum = real3_make(REAL(0.0), REAL(0.0), REAL(0.0));
    for (int i = 0; i < count; i++) {
        const real *source = param + 3 + 4 * i;
        real3 d = real3_sub(p, real3_make(source[0], source[1], source[2]));
        real far = real3_length(d), frequency = waves ? source[3] : REAL(1.0);
        real wave = wave_sine(far * param[1] * frequency + param[2]);
        if (far > REAL(0.0))
            sum = real3_mad(sum, wave / (far * frequency * (real)count), d);
    }
    return sum;
}

HD real3 pattern_push_ripples(real3 p, const real *param)
{
    return pattern_push_sources(p, param, false);
}

HD real3 pattern_push_waves(real3 p, const real *param)
{
    return pattern_push_sources(p, param, true);
}

HD real3 pattern_pushed(real3 normal, real amount, real3 push)
{
    return pattern_unit(real3_mad(normal, amount, push));
}

/* size or 0, coords: the normal that facets give to a point. By size, normals
 * are drawn to the nearest of the points of crackle; by coords, all points
 * whose nearest is the same are tilted alike. */
HD real3 pattern_facets(real3 p, real3 normal, const real *param)
{
    real metric = REAL(2.0), offset = REAL(0.0);
    if (param[0] != REAL(0.0)) {
        real3 q = real3_scale(normal, REAL(1.0) / param[0]);
        return pattern_unit(crackle_search(q, metric, offset).point);
    }
    real3 q = real3_scale(p, REAL(10.0));
    real3 d = noise_vector(crackle_search(q, metric, offset).point);
    real3 across = real3_mad(d, -real3_dot(d, normal), normal);
    return pattern_unit(real3_mad(normal, param[1], across));
}

#endif
