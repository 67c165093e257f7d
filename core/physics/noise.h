/* noise.h - POV-Ray 3.7's noise: a value or a vector for each point of space.
 *
 * Found by measuring the program (tests/oracle/noise_tables.py tells how), and
 * equal to it: generators 1 and 2 and the vectors but for rounding, generator
 * 3 to 2e-9. Lattice noise repeats after 4096, gradient noise after 2048. A
 * coordinate beyond 2^30, or that is not a number, counts as 0. */
#ifndef CORE_PHYSICS_NOISE_H
#define CORE_PHYSICS_NOISE_H
#include "core/physics/lanes.h"
#include "core/physics/noise_table.h"
#include "core/physics/perlin_table.h"
#include "core/physics/real.h"

enum { NOISE_ORIGIN = 10000, NOISE_OCTAVES = 10 };

/* The unit cell that a point is in. */
typedef struct {
    int x, y, z;        /* its lowest corner                               */
    real3 at;           /* the point in it, each coordinate in [0, 1)      */
} noise_cell;

HD real noise_coordinate(real x)
{
    return real_abs(x) < REAL(1073741824.0) ? x : REAL(0.0);
}

/* The greatest integer that is not above x. */
HD int noise_floor(real x)
{
    int i = (int)x;
    return i - ((real)i > x);
}

HD noise_cell noise_cell_of(real3 p)
{
    real x = noise_coordinate(p.x), y = noise_coordinate(p.y);
    real z = noise_coordinate(p.z);
    noise_cell c;
    c.x = noise_floor(x);
    c.y = noise_floor(y);
    c.z = noise_floor(z);
    c.at = real3_make(x - (real)c.x, y - (real)c.y, z - (real)c.z);
    return c;
}

/* Cubic with level ends, from 0 to 1. */
HD real noise_ease(real t)
{
    return t * t * (REAL(3.0) - REAL(2.0) * t);
}

/* Weight of the far (1) or near (0) side at the eased distance s. */
HD real noise_side(int far, real s)
{
    return far ? s : REAL(1.0) - s;
}

/* The number of a lattice point, in [0, 4096). */
HD int noise_number(int x, int y, int z)
{
    int a = noise_permutation[x & 4095];
    a = noise_permutation[a ^ (y & 4095)];
    return noise_permutation[a ^ (z & 4095)];
}

/* Adds what a corner of the cell gives: from `entry` of the table on, for each
 * of one sum or three a window of four numbers, a value and slopes; d is (1/2,
 * offset). */
HD void noise_corner(lanes *sum, int count, const lanes *d, real weight,
                     int entry)
{
    lanes part;
    lanes_scale(&part, d, weight);
    lanes_add(&sum[0], &part, noise_lattice + entry);
    if (count < 3)
        return;
    lanes_add(&sum[1], &part, noise_lattice + entry + 4);
    lanes_add(&sum[2], &part, noise_lattice + entry + 8);
}

/* Adds up the corners of a point's cell: one sum, or the three of a vector. */
HD void noise_lattice_sums(real3 p, int count, real *sum)
{
    noise_cell c = noise_cell_of(p);
    real3 s = real3_make(noise_ease(c.at.x), noise_ease(c.at.y),
                         noise_ease(c.at.z));
    lanes all[3], d;
    for (int k = 0; k < count; k++)
        lanes_set(&all[k], REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0));
    for (int x = 0; x < 2; x++) {
        int row = noise_permutation[(c.x + x + NOISE_ORIGIN) & 4095];
        for (int y = 0; y < 2; y++) {
            int column = noise_permutation[
                row ^ ((c.y + y + NOISE_ORIGIN) & 4095)];
            real weight = noise_side(x, s.x) * noise_side(y, s.y);
            for (int z = 0; z < 2; z++) {
                int entry = noise_permutation[
                    column ^ ((c.z + z + NOISE_ORIGIN) & 4095)] & 255;
                lanes_set(&d, REAL(0.5), c.at.x - (real)x, c.at.y - (real)y,
                          c.at.z - (real)z);
                noise_corner(all, count, &d, weight * noise_side(z, s.z),
                             entry);
            }
        }
    }
    for (int k = 0; k < count; k++)
        sum[k] = lanes_sum(&all[k]) * REAL(1e-8);
}

/* Gradient noise (Perlin 1985) of mean 0. */
HD real noise_gradient(real3 p)
{
    real shift = REAL(0.0231572125);
    noise_cell c = noise_cell_of(real3_add(p, real3_make(shift, shift,
                                                         shift)));
    real3 s = real3_make(noise_ease(c.at.x), noise_ease(c.at.y),
                         noise_ease(c.at.z));
    real sum = REAL(0.0);
    for (int i = 0; i < 8; i++) {
        int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        int a = perlin_permutation[(c.x + x) & 2047];
        a = perlin_permutation[(a + c.y + y) & 2047];
        const int16_t *g = perlin_gradient + 3 * ((a + c.z + z) & 2047);
        real3 gradient = real3_make(g[0], g[1], g[2]);
        real3 d = real3_make(c.at.x - (real)x, c.at.y - (real)y,
                             c.at.z - (real)z);
        sum += noise_side(x, s.x) * noise_side(y, s.y) * noise_side(z, s.z)
             * real3_dot(gradient, d) / real3_length(gradient);
    }
    return sum;
}

/* In [0, 1]. Generator 1 is that of POV-Ray 3.1, flat where it is cut off, 2
 * is the same spread over less than the range, 3 is gradient noise. */
HD real noise_value(int generator, real3 p)
{
    real v;
    if (generator == 3)
        v = REAL(0.4925) + REAL(0.795) * noise_gradient(p);
    else {
        noise_lattice_sums(p, 1, &v);
        v = generator == 1 ? v + REAL(0.5)
                           : (v + REAL(1.05242)) * REAL(0.48985582);
    }
    return real_clamp(v, REAL(0.0), REAL(1.0));
}

/* The vector noise that turbulence moves points by: components in about
 * [-1, 1], the same whatever the generator. */
HD real3 noise_vector(real3 p)
{
    real sum[3];
    noise_lattice_sums(p, 3, sum);
    return real3_make(sum[0], sum[1], sum[2]);
}

/* Octaves of noise, each lambda times as fine and omega times as strong as
 * the one before. There are at most NOISE_OCTAVES. */
typedef struct {
    int octaves;
    real lambda, omega;
} noise_series;

/* Of three numbers: octaves, lambda, omega. POV-Ray holds the latter two in
 * single precision, which ten octaves show. */
HD noise_series noise_series_of(const real *param)
{
    noise_series s;
    s.octaves = (int)real_clamp(param[0], REAL(1.0), (real)NOISE_OCTAVES);
    s.lambda = (real)(float)param[1];
    s.omega = (real)(float)param[2];
    return s;
}

HD real3 noise_vector_turbulence(real3 p, noise_series s)
{
    real3 sum = noise_vector(p);
    real scale = s.lambda, weight = s.omega;
    for (int i = 1; i < s.octaves; i++) {
        sum = real3_mad(sum, weight, noise_vector(real3_scale(p, scale)));
        scale *= s.lambda;
        weight *= s.omega;
    }
    return sum;
}

/* Noise for sums of octaves: what generators 2 and 3 leave of the range is
 * spread over it and, sometimes, beyond. */
HD real noise_spread(int generator, real3 p)
{
    real v = noise_value(generator, p);
    return generator == 1 ? v : REAL(2.0) * v - REAL(0.5);
}

/* ... and cut off there. */
HD real noise_full(int generator, real3 p)
{
    return real_clamp(noise_spread(generator, p), REAL(0.0), REAL(1.0));
}

/* Scalar turbulence: in about [0, 1 / (1 - omega)]. */
HD real noise_turbulence(int generator, real3 p, noise_series s)
{
    real sum = noise_full(generator, p);
    real scale = s.lambda, weight = s.omega;
    for (int i = 1; i < s.octaves; i++) {
        sum += weight * noise_spread(generator, real3_scale(p, scale));
        scale *= s.lambda;
        weight *= s.omega;
    }
    return sum;
}

#endif
