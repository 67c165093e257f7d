/* media_density.h - the grids of media.c and of rays.c: a cloud and a smoke. */
#ifndef TESTS_BENCH_MEDIA_DENSITY_H
#define TESTS_BENCH_MEDIA_DENSITY_H
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { SIDE = 96 };

static inline double hash(int x, int y, int z)
{
    uint32_t h = (uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^
                 (uint32_t)z * 83492791u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (double)(h ^ h >> 15) / 4294967296.0;
}

static inline double value_noise(double x, double y, double z)
{
    int i = (int)floor(x), j = (int)floor(y), k = (int)floor(z);
    double sum = 0.0, u = x - i, v = y - j, w = z - k;
    u = u * u * (3.0 - 2.0 * u);
    v = v * v * (3.0 - 2.0 * v);
    w = w * w * (3.0 - 2.0 * w);
    for (int c = 0; c < 8; c++)
        sum += (c & 1 ? u : 1.0 - u) * (c & 2 ? v : 1.0 - v) *
               (c & 4 ? w : 1.0 - w) *
               hash(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    return sum;
}

static inline double fractal(double x, double y, double z)
{
    double sum = 0.0, size = 1.0, amount = 0.5;
    for (int i = 0; i < 5; i++) {
        sum += amount * value_noise(size * x, size * y, size * z);
        size *= 2.03;
        amount *= 0.5;
    }
    return sum;
}

/* At a point of the unit cube, in [0, 1]. A cloud has hard billows, smoke is a
 * wisp around a column. */
static inline double density_at(bool cloud, double x, double y, double z)
{
    double noise = fractal(5.0 * x, 5.0 * y, 5.0 * z);
    double dx = x - 0.5, dz = z - 0.5, dy = y - 0.5;
    if (cloud) {
        double r = sqrt(dx * dx + 1.6 * dy * dy + dz * dz);
        double v = 0.42 - r + 0.55 * (noise - 0.5);
        return fmin(fmax(12.0 * v, 0.0), 1.0) * (0.4 + 0.6 * noise);
    }
    double bend = 0.15 * (value_noise(3.0 * y, 7.0, 1.0) - 0.5);
    double r = hypot(dx - bend, dz + bend) / (0.08 + 0.3 * y);
    double v = exp(-r * r) * noise * 2.0 - 0.2;
    return fmin(fmax(v, 0.0), 1.0);
}

static inline float *make_density(bool cloud)
{
    float *d = malloc(sizeof *d * SIDE * SIDE * SIDE);
    for (int i = 0; d && i < SIDE * SIDE * SIDE; i++)
        d[i] = (float)density_at(cloud, (i % SIDE + 0.5) / SIDE,
                                 (i / SIDE % SIDE + 0.5) / SIDE,
                                 (i / SIDE / SIDE + 0.5) / SIDE);
    return d;
}

#endif
