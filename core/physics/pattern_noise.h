/* pattern_noise.h - patterns made of noise and of random numbers.
 *
 * Equal to POV-Ray 3.7's, as measured; see pattern_plain.h. */
#ifndef CORE_PHYSICS_PATTERN_NOISE_H
#define CORE_PHYSICS_PATTERN_NOISE_H
#include "core/physics/cell_table.h"
#include "core/physics/pattern_plain.h"

HD real pattern_bozo(real3 p, const real *param)
{
    return noise_value((int)param[0], p);
}

HD real pattern_dents(real3 p, const real *param)
{
    real v = noise_value((int)param[0], p);
    return v * v * v;
}

HD real pattern_granite(real3 p, const real *param)
{
    real sum = REAL(0.0), weight = REAL(1.0);
    real3 q = real3_scale(p, REAL(4.0));
    for (int i = 0; i < 6; i++) {
        sum += weight
             * real_abs(REAL(0.5) - noise_full((int)param[0], q));
        q = real3_scale(q, REAL(2.0));
        weight *= REAL(0.5);
    }
    return real_min(sum, REAL(1.0));
}

HD real pattern_wrinkles(real3 p, const real *param)
{
    real sum = REAL(0.0), weight = REAL(0.5);
    for (int i = 0; i < 10; i++) {
        sum += weight * noise_full((int)param[0], p);
        p = real3_scale(p, REAL(2.0));
        weight *= REAL(0.5);
    }
    return sum;
}

HD real pattern_agate(real3 p, const real *param)
{
    real t = (real)(float)param[4]
           * noise_turbulence((int)param[0], p, noise_series_of(param + 1));
    real v = REAL(0.5)
           + REAL(0.5) * wave_sine(REAL(1.3) * t + REAL(1.1) * p.z);
    return v > REAL(0.0) ? real_pow(v, REAL(0.77)) : REAL(0.0);
}

/* The i-th random number of a cell, in [0, 1). */
HD real pattern_random(int number, int i)
{
    return (real)cell_random[number + i] * REAL(2.3283064365386963e-10);
}

HD real pattern_cells(real3 p, const real *param)
{
    noise_cell c = noise_cell_of(real3_make(
        p.x + PATTERN_EDGE, p.y + PATTERN_EDGE, p.z + PATTERN_EDGE));
    (void)param;
    return pattern_random(noise_number(c.x, c.y, c.z), 0);
}

/* The points that are nearest to one, and how near. */
typedef struct {
    real first, second, third;
    real3 point;        /* the first                                       */
} crackle_nearest;

/* Distance of metric m, in a space of one more dimension. */
HD real crackle_distance(real3 d, real metric, real offset)
{
    real x = real_abs(d.x), y = real_abs(d.y), z = real_abs(d.z);
    if (metric == REAL(2.0))
        return real_sqrt(x * x + y * y + z * z + offset * offset);
    if (metric == REAL(1.0))
        return x + y + z + offset;
    return real_pow(real_pow(x, metric) + real_pow(y, metric)
                    + real_pow(z, metric) + real_power(offset, metric),
                    REAL(1.0) / metric);
}

HD void crackle_insert(crackle_nearest *n, real distance, real3 point)
{
    if (distance < n->first) {
        n->third = n->second;
        n->second = n->first;
        n->first = distance;
        n->point = point;
    } else if (distance < n->second) {
        n->third = n->second;
        n->second = distance;
    } else if (distance < n->third)
        n->third = distance;
}

/* From `at` in its cell to the cell i further on. */
HD real crackle_gap(int i, real at)
{
    return i > 0 ? (real)i - at : i < 0 ? at - (real)(i + 1) : REAL(0.0);
}

/* Each cell has one point. Those of neighbours come first, then those of
 * cells further off (but for the edges of that cube) where they may matter:
 * no distance is less than the gap, whatever the metric. */
HD crackle_nearest crackle_search(real3 p, real metric, real offset)
{
    noise_cell c = noise_cell_of(p);
    real3 cell = real3_make((real)c.x, (real)c.y, (real)c.z);
    crackle_nearest n;
    n.first = n.second = n.third = REAL(1e30);
    n.point = p;
    for (int i = 0; i < 250; i++) {
        int x = i % 5 - 2, y = i / 5 % 5 - 2, z = i / 25 % 5 - 2;
        int outer = (x * x == 4) + (y * y == 4) + (z * z == 4);
        real gap = real_max(crackle_gap(x, c.at.x),
                            real_max(crackle_gap(y, c.at.y),
                                     crackle_gap(z, c.at.z)));
        if (outer != i / 125 || (gap >= n.third && offset >= REAL(0.0)))
            continue;
        int number = noise_number(c.x + x, c.y + y, c.z + z);
        real3 at = real3_make((real)x + pattern_random(number, 0),
                              (real)y + pattern_random(number, 1),
                              (real)z + pattern_random(number, 2));
        crackle_insert(&n, crackle_distance(real3_sub(c.at, at), metric,
                                            offset),
                       real3_add(cell, at));
    }
    return n;
}

HD real pattern_crackle(real3 p, const real *param)
{
    crackle_nearest n = crackle_search(p, param[4], param[5]);
    if (param[6] != REAL(0.0))
        return noise_value((int)param[0], n.point);
    return real_clamp(param[1] * n.first + param[2] * n.second
                      + param[3] * n.third, REAL(0.0), REAL(1.0));
}

/* Where ripples and waves come from: centres on the unit sphere, and for
 * waves the frequency of each. Fills 4 numbers each, up to 100 of them. */
HD void pattern_wave_sources(int count, real *source)
{
    uint32_t state = 1952292254u;
    for (int i = 0; i < count; i++) {
        real3 c = noise_vector(real3_make((real)i, REAL(0.0), REAL(0.0)));
        real length = real3_length(c);
        source[4 * i] = c.x / length;
        source[4 * i + 1] = c.y / length;
        source[4 * i + 2] = c.z / length;
        source[4 * i + 3] = (real)(state >> 16 & 0x7fff) / REAL(32767.0)
                          + REAL(0.01);
        state = state * 1812433253u + 12345u;
    }
}

HD real pattern_distance(real3 p, const real *source)
{
    return real3_length(real3_sub(p, real3_make(source[0], source[1],
                                                source[2])));
}

HD real pattern_ripples(real3 p, const real *param)
{
    int count = (int)param[0];
    real sum = REAL(0.0);
    for (int i = 0; i < count; i++)
        sum += wave_sine(pattern_distance(p, param + 3 + 4 * i) * param[1]
                         + param[2]);
    return REAL(0.5) + REAL(0.5) * sum / (real)count;
}

HD real pattern_waves(real3 p, const real *param)
{
    int count = (int)param[0];
    real sum = REAL(0.0);
    for (int i = 0; i < count; i++) {
        const real *source = param + 3 + 4 * i;
        sum += wave_sine(pattern_distance(p, source) * param[1] * source[3]
                         + param[2]) / source[3];
    }
    return REAL(0.5) + REAL(0.2) * sum / (real)count;
}

#endif
