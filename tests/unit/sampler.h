/* sampler.h - one test for every sampler: is what it draws distributed as its
 * density says, and does the density integrate to 1?
 *
 * Directions are counted in rings around a pole and sectors about it, and
 * compared by a chi-square test with the integral of the density. */
#ifndef TESTS_UNIT_SAMPLER_H
#define TESTS_UNIT_SAMPLER_H
#include <math.h>
#include "core/physics/rng.h"
#include "core/physics/vec.h"

enum { SAMPLER_RINGS = 32, SAMPLER_SECTORS = 8, SAMPLER_INNER = 256,
       SAMPLER_BINS = SAMPLER_RINGS * SAMPLER_SECTORS };

/* `density` is a double so that a test may integrate more finely than a float
 * can tell directions apart; `pdf` is what the sampler itself claims. */
struct sampler {
    vec3 (*draw)(const struct sampler *s, float u, float v, float *pdf);
    double (*density)(const struct sampler *s, vec3 w);
    vec3 pole;          /* of the rings, a unit vector                      */
    double crowding;    /* rings end at angle pi t^crowding, t uniform      */
    int kind;           /* parameters of the sampler under test             */
    float g;
};

struct sampler_result {
    double integral;    /* of the density over the sphere                   */
    double z;           /* of the chi-square, as a normal deviate           */
    double claim;       /* largest relative difference of pdf and density   */
    double length;      /* largest | |w| - 1 |                              */
    vec3 mean;          /* of the directions drawn                          */
};

/* The deviate of a normal law as improbable as this chi-square [Wilson and
 * Hilferty 1931]. Bins that expect under 10 are counted together. */
static inline double sampler_chi_square(const double *expected,
                                        const double *seen, int bins)
{
    double chi = 0, few_expected = 0, few_seen = 0;
    int freedom = -1;
    for (int i = 0; i < bins; i++) {
        if (expected[i] < 10) {
            few_expected += expected[i];
            few_seen += seen[i];
            continue;
        }
        chi += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        freedom++;
    }
    if (few_expected >= 10) {
        chi += (few_seen - few_expected) * (few_seen - few_expected)
             / few_expected;
        freedom++;
    } else if (few_seen > 50) {
        return INFINITY;
    }
    double v = 2.0 / (9.0 * freedom);
    return (cbrt(chi / freedom) - (1 - v)) / sqrt(v);
}

/* Two unit vectors that complete the pole. */
static inline void sampler_axes(vec3 pole, vec3 *a, vec3 *b)
{
    vec3 other = fabsf(pole.x) < 0.5f ? vec3_make(1, 0, 0)
                                      : vec3_make(0, 1, 0);
    *a = vec3_normalize(vec3_cross(pole, other));
    *b = vec3_cross(pole, *a);
}

static inline vec3 sampler_direction(const struct sampler *s, double angle,
                                     double turn)
{
    vec3 a, b;
    sampler_axes(s->pole, &a, &b);
    vec3 w = vec3_scale(s->pole, (float)cos(angle));
    w = vec3_mad(w, (float)(sin(angle) * cos(turn)), a);
    return vec3_mad(w, (float)(sin(angle) * sin(turn)), b);
}

/* The integral of the density over a bin, by midpoints in t and turn. */
static inline double sampler_bin(const struct sampler *s, int ring, int sector)
{
    double sum = 0;
    for (int i = 0; i < SAMPLER_INNER; i++) {
        double t = (ring + (i + 0.5) / SAMPLER_INNER) / SAMPLER_RINGS;
        double angle = M_PI * pow(t, s->crowding);
        double slope = M_PI * s->crowding * pow(t, s->crowding - 1);
        for (int k = 0; k < 8; k++) {
            double turn = 2 * M_PI * (sector + (k + 0.5) / 8) / SAMPLER_SECTORS;
            sum += s->density(s, sampler_direction(s, angle, turn))
                 * sin(angle) * slope;
        }
    }
    return sum * 2 * M_PI / SAMPLER_SECTORS / 8
         / SAMPLER_RINGS / SAMPLER_INNER;
}

static inline int sampler_bin_of(const struct sampler *s, vec3 w)
{
    vec3 a, b;
    sampler_axes(s->pole, &a, &b);
    double angle = 2 * atan2(vec3_length(vec3_sub(w, s->pole)),
                             vec3_length(vec3_add(w, s->pole)));
    double t = pow(angle / M_PI, 1 / s->crowding);
    double turn = atan2(vec3_dot(w, b), vec3_dot(w, a)) / (2 * M_PI);
    int ring = (int)(t * SAMPLER_RINGS);
    int sector = (int)((turn < 0 ? turn + 1 : turn) * SAMPLER_SECTORS);
    ring = ring < SAMPLER_RINGS ? ring : SAMPLER_RINGS - 1;
    sector = sector < SAMPLER_SECTORS ? sector : SAMPLER_SECTORS - 1;
    return ring * SAMPLER_SECTORS + sector;
}

static inline struct sampler_result sampler_run(const struct sampler *s, int n)
{
    static double expected[SAMPLER_BINS], seen[SAMPLER_BINS];
    struct sampler_result r = {0};
    double mean[3] = {0};
    rng random = rng_make(11, 0, 0, (uint64_t)s->kind);
    for (int i = 0; i < SAMPLER_BINS; i++) {
        expected[i] = n * sampler_bin(s, i / SAMPLER_SECTORS,
                                      i % SAMPLER_SECTORS);
        seen[i] = 0;
        r.integral += expected[i] / n;
    }
    for (int i = 0; i < n; i++) {
        float pdf, u = rng_float(&random), v = rng_float(&random);
        vec3 w = s->draw(s, u, v, &pdf);
        double density = s->density(s, w);
        seen[sampler_bin_of(s, w)]++;
        r.claim = fmax(r.claim, fabs(pdf / density - 1));
        r.length = fmax(r.length, fabs(sqrt((double)w.x * w.x
            + (double)w.y * w.y + (double)w.z * w.z) - 1));
        mean[0] += w.x;
        mean[1] += w.y;
        mean[2] += w.z;
    }
    r.z = sampler_chi_square(expected, seen, SAMPLER_BINS);
    r.mean = vec3_make((float)(mean[0] / n), (float)(mean[1] / n),
                       (float)(mean[2] / n));
    return r;
}

#endif
