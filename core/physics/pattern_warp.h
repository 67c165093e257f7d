/* pattern_warp.h - warps: from a point to the point where the pattern is
 * looked up.
 *
 * All take the point and their numbers, as listed at each; they are those of
 * POV-Ray 3.7, as measured. What is not finite stays so: patterns bear it. */
#ifndef CORE_PHYSICS_PATTERN_WARP_H
#define CORE_PHYSICS_PATTERN_WARP_H
#include "core/physics/pattern_noise.h"

/* function, NAME, numbers */
#define WARP_KINDS(X)                                                         \
    X(black_hole, BLACK_HOLE, 14) X(cubic, CUBIC, 0)                          \
    X(cylindrical, CYLINDRICAL, 4) X(planar, PLANAR, 4)                       \
    X(repeat, REPEAT, 8) X(spherical, SPHERICAL, 4)                           \
    X(toroidal, TOROIDAL, 5) X(turbulence, TURBULENCE, 6)

enum warp_kind {
#define X(function, name, numbers) WARP_##name,
    WARP_KINDS(X)
#undef X
    WARP_COUNT
};

/* octaves, lambda, omega, amount x y z */
HD real3 pattern_warp_turbulence(real3 p, const real *param)
{
    real3 t = noise_vector_turbulence(p, noise_series_of(param));
    return real3_make(p.x + param[3] * t.x, p.y + param[4] * t.y,
                      p.z + param[5] * t.z);
}

/* axis (0, 1, 2), width, offset x y z, flip x y z. The n-th copy is moved by
 * n times the offset; odd ones are mirrored first. POV-Ray computes where a
 * copy begins in single precision. */
HD real3 pattern_warp_repeat(real3 p, const real *param)
{
    int axis = (int)param[0];
    real c[3] = {p.x, p.y, p.z};
    real width = (real)(float)param[1], n = real_floor(c[axis] / width);
    bool odd = real_fmod(n, REAL(2.0)) != REAL(0.0);
    c[axis] -= (real)((float)n * (float)width);
    for (int i = 0; i < 3; i++) {
        if (odd && param[5 + i] != REAL(0.0))
            c[i] = i == axis ? width - c[i] : -c[i];
        c[i] += n * param[2 + i];
    }
    return real3_make(c[0], c[1], c[2]);
}

/* centre x y z, radius, strength, falloff, inverse (0, 1), repeat x y z (0:
 * not along this axis), turbulence x y z, turbulent (0, 1). Of each copy the
 * centre is moved by the turbulence times random numbers of its block. */
HD real3 pattern_warp_black_hole(real3 p, const real *param)
{
    real at[3] = {p.x, p.y, p.z}, block[3], d[3], length = REAL(0.0);
    for (int i = 0; i < 3; i++) {
        real width = param[7 + i];
        block[i] = width != REAL(0.0) ? real_floor(at[i] / width) : REAL(0.0);
        d[i] = at[i] - block[i] * width - param[i];
    }
    if (param[13] != REAL(0.0)) {
        noise_cell c = noise_cell_of(real3_make(block[0], block[1],
                                                block[2]));
        int number = noise_number(c.x, c.y, c.z);
        for (int i = 0; i < 3; i++)
            d[i] -= param[10 + i] * pattern_random(number, i);
    }
    for (int i = 0; i < 3; i++)
        length += d[i] * d[i];
    length = real_sqrt(length);
    if (!(length < param[3]))
        return p;
    real force = param[4]
               * real_pow(REAL(1.0) - length / param[3], param[5]);
    force = real_min(force, REAL(1.0));
    if (param[6] != REAL(0.0))
        force = -force;
    return real3_make(p.x + force * d[0], p.y + force * d[1],
                      p.z + force * d[2]);
}

/* To the plane across the unit vector `to`: z goes along it, x and y where
 * POV-Ray has them, which is no rotation but for the axes. */
HD real3 pattern_warp_orient(real3 p, const real *to)
{
    return real3_make(p.x * (to[1] + to[2]) + p.z * to[0],
                      p.y * (to[0] + to[2]) - p.z * to[1],
                      -p.x * to[0] + p.y * to[1] + p.z * to[2]);
}

/* Turns about y, from x on to z, in [0, 1). */
HD real pattern_warp_turn(real3 p)
{
    real turn = real_atan2(p.z, p.x) / PATTERN_TURN;
    return turn < REAL(0.0) ? turn + REAL(1.0) : turn;
}

/* distance^dist_exp, by which a map is stretched */
HD real pattern_warp_stretch(real distance, real dist_exp)
{
    if (dist_exp == REAL(0.0))
        return REAL(1.0);
    return dist_exp == REAL(1.0) ? distance : real_pow(distance, dist_exp);
}

/* orientation x y z (unit), distance along it */
HD real3 pattern_warp_planar(real3 p, const real *param)
{
    return pattern_warp_orient(real3_make(p.x, p.y, param[3]), param);
}

/* orientation x y z (unit), dist_exp */
HD real3 pattern_warp_cylindrical(real3 p, const real *param)
{
    real far = real_sqrt(p.x * p.x + p.z * p.z);
    real stretch = pattern_warp_stretch(far, param[3]);
    return pattern_warp_orient(real3_make(pattern_warp_turn(p) * stretch,
                                          p.y, far), param);
}

/* orientation x y z (unit), dist_exp */
HD real3 pattern_warp_spherical(real3 p, const real *param)
{
    real far = real3_length(p);
    real stretch = pattern_warp_stretch(far, param[3]);
    real rise = real_atan2(p.y, real_sqrt(p.x * p.x + p.z * p.z))
              / PATTERN_TURN;
    return pattern_warp_orient(
        real3_make(pattern_warp_turn(p) * stretch,
                   (REAL(0.5) + REAL(2.0) * rise) * stretch, far), param);
}

/* orientation x y z (unit), dist_exp, major radius */
HD real3 pattern_warp_toroidal(real3 p, const real *param)
{
    real out = real_sqrt(p.x * p.x + p.z * p.z) - param[4];
    real far = real_sqrt(out * out + p.y * p.y);
    real stretch = pattern_warp_stretch(far, param[3]);
    real about = REAL(0.5) + real_atan2(p.y, out) / PATTERN_TURN;
    return pattern_warp_orient(
        real3_make(pattern_warp_turn(p) * stretch, about * stretch, far),
        param);
}

/* The faces of a cube laid out as a cross in the unit square: four in the
 * middle row (-x, +z, +x, -z), +y above and -y below the second. */
HD real3 pattern_warp_cubic(real3 p, const real *param)
{
    real x = real_abs(p.x), y = real_abs(p.y), z = real_abs(p.z);
    real far = real_max(x, real_max(y, z));
    real s, t, column = REAL(1.0), row = REAL(1.0);
    (void)param;
    if (far == REAL(0.0))
        return p;
    if (x == far) {
        s = p.x > REAL(0.0) ? -p.z : p.z;
        t = p.y;
        column = p.x > REAL(0.0) ? REAL(2.0) : REAL(0.0);
    } else if (y == far) {
        s = p.x;
        t = p.y > REAL(0.0) ? -p.z : p.z;
        row = p.y > REAL(0.0) ? REAL(2.0) : REAL(0.0);
    } else {
        s = p.z > REAL(0.0) ? p.x : -p.x;
        t = p.y;
        column = p.z > REAL(0.0) ? REAL(1.0) : REAL(3.0);
    }
    return real3_make((column + (s / far + REAL(1.0)) / REAL(2.0)) / REAL(4.0),
                      (row + (t / far + REAL(1.0)) / REAL(2.0)) / REAL(3.0),
                      far);
}

HD int pattern_warp_numbers(int kind)
{
    switch (kind) {
#define X(function, name, numbers) case WARP_##name: return numbers;
    WARP_KINDS(X)
#undef X
    default:
        return 0;
    }
}

HD real3 pattern_warp(int kind, real3 p, const real *param)
{
    switch (kind) {
#define X(function, name, numbers)                                            \
    case WARP_##name: return pattern_warp_##function(p, param);
    WARP_KINDS(X)
#undef X
    default:
        return p;
    }
}

#endif
