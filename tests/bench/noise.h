/* noise.h - what the bench's grids are made of: seeded gradient noise with
 * its derivative (Perlin 2002) and its curl (Bridson 2007). Doubles, and no
 * function of the C library but floor and sqrt, so that every machine makes
 * the same bits. */
#ifndef TESTS_BENCH_NOISE_H
#define TESTS_BENCH_NOISE_H
#include <math.h>
#include <stdint.h>

typedef struct {
    double x, y, z;
} point;

static inline point point_make(double x, double y, double z)
{
    point p = {x, y, z};
    return p;
}

/* a + s b */
static inline point point_mad(point a, double s, point b)
{
    return point_make(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline uint32_t noise_hash(int x, int y, int z, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u ^
                 (uint32_t)z * 83492791u ^ seed * 0x9e3779b9u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

/* A uniform number in [0, 1). */
static inline double noise_chance(int i, uint32_t seed)
{
    return noise_hash(i, 0, 0, seed) / 4294967296.0;
}

/* One of the 12 directions to the edges of a cube. */
static inline point noise_direction(uint32_t h)
{
    double a = h & 1u ? 1.0 : -1.0, b = h & 2u ? 1.0 : -1.0;
    switch ((h >> 2) % 3u) {
    case 0:
        return point_make(0.0, a, b);
    case 1:
        return point_make(a, 0.0, b);
    default:
        return point_make(a, b, 0.0);
    }
}

/* The weight of a corner along an axis, at t from the lower one, and its
 * derivative. */
static inline double noise_weight(double t, int upper, double *slope)
{
    double w = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    double d = 30.0 * t * t * (t * (t - 2.0) + 1.0);
    *slope = upper ? d : -d;
    return upper ? w : 1.0 - w;
}

/* About -1 to 1; its derivative in `slope`. */
static inline double noise_at(point p, uint32_t seed, point *slope)
{
    int i = (int)floor(p.x), j = (int)floor(p.y), k = (int)floor(p.z);
    double sum = 0.0;
    *slope = point_make(0.0, 0.0, 0.0);
    for (int c = 0; c < 8; c++) {
        int a = c & 1, b = c >> 1 & 1, e = c >> 2;
        double sx, sy, sz;
        double wx = noise_weight(p.x - i, a, &sx);
        double wy = noise_weight(p.y - j, b, &sy);
        double wz = noise_weight(p.z - k, e, &sz);
        point g = noise_direction(noise_hash(i + a, j + b, k + e, seed));
        double v = g.x * (p.x - i - a) + g.y * (p.y - j - b) +
                   g.z * (p.z - k - e);
        sum += wx * wy * wz * v;
        slope->x += sx * wy * wz * v + wx * wy * wz * g.x;
        slope->y += wx * sy * wz * v + wx * wy * wz * g.y;
        slope->z += wx * wy * sz * v + wx * wy * wz * g.z;
    }
    return sum;
}

/* The sum of octaves, each twice as fine and half as strong. */
static inline double noise_fractal(point p, int octaves, uint32_t seed)
{
    double sum = 0.0, amount = 1.0, size = 1.0;
    point slope;
    for (int i = 0; i < octaves; i++) {
        point q = point_mad(point_make(0.0, 0.0, 0.0), size, p);
        sum += amount * noise_at(q, seed + (uint32_t)i, &slope);
        size *= 2.03;
        amount *= 0.5;
    }
    return sum;
}

/* A field without divergence: the curl of three noises. */
static inline point noise_curl(point p, uint32_t seed)
{
    point a, b, c;
    noise_at(p, seed, &a);
    noise_at(p, seed + 101u, &b);
    noise_at(p, seed + 202u, &c);
    return point_make(c.y - b.z, a.z - c.x, b.x - a.y);
}

/* 0 below a, 1 above b, smooth between. */
static inline double noise_step(double a, double b, double x)
{
    double t = (x - a) / (b - a);
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return t * t * (3.0 - 2.0 * t);
}
#endif
