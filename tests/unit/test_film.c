/* What a film tells of its own error, beside the error it has. */
#include "tests/unit/truth.h"
#include "core/film.h"

enum { SIDE = 40, SEEDS = 8 };

static double truth[SIDE * SIDE];

static void add(film_pixel *p, uint32_t k, double value)
{
    for (int c = 0; c < 3; c++)
        p->path[pixel_half(k)][c] += value;
}

/* Samples that are all alike for `rare` = 1, and else 0 but for one in so
 * many, as of paths that seldom find what shines; bright and dark in blocks
 * with edges between them. */
static void fill(struct film *f, uint32_t samples, double rare, uint32_t seed)
{
    f->samples = samples;
    for (int i = 0; i < SIDE * SIDE; i++) {
        rng r = rng_make(seed, 0, 0, (uint64_t)i);
        truth[i] = (i % SIDE / 8 + i / SIDE / 8) % 2 ? 1.0 : 0.05;
        memset(&f->pixel[i], 0, sizeof f->pixel[i]);
        for (uint32_t k = 0; k < samples; k++) {
            double u = (double)rng_u32(&r) * 0x1p-32;
            double value = rare > 1.0 ? (u < 1.0 / rare ? rare : 0.0) : 0.5 + u;
            add(&f->pixel[i], k, value * truth[i]);
        }
    }
}

/* A straight edge through each pixel, seen from where samples are taken. */
static void fill_edges(struct film *f, uint32_t samples, double rare,
                       uint32_t seed)
{
    (void)rare;
    f->samples = samples;
    for (int i = 0; i < SIDE * SIDE; i++) {
        rng r = rng_make(seed, 0, 0, (uint64_t)i);
        double slope = 0x1p-32 * (double)rng_u32(&r);
        double at = slope + (1.0 - slope) * 0x1p-32 * (double)rng_u32(&r);
        uint32_t scramble[2] = {rng_u32(&r), rng_u32(&r)};
        truth[i] = at - 0.5 * slope;
        memset(&f->pixel[i], 0, sizeof f->pixel[i]);
        for (uint32_t k = 0; k < samples; k++) {
            uint32_t x[SOBOL_DIMENSIONS];
            sobol_point(k, x);
            double u = 0x1p-32 * (double)sobol_scramble(x[0], scramble[0]);
            double v = 0x1p-32 * (double)sobol_scramble(x[1], scramble[1]);
            add(&f->pixel[i], k, u + slope * v < at ? 1.0 : 0.0);
        }
    }
}

static double error_of(const struct film *f)
{
    double sum = 0.0, image = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++)
        image += truth[i] / (SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const film_pixel *p = &f->pixel[i];
        double d = (p->path[0][0] + p->path[1][0]) / f->samples - truth[i];
        sum += d * d / (truth[i] * truth[i] + 0.01 * image * image);
    }
    return sqrt(sum / (SIDE * SIDE));
}

/* Over several seeds, what is told over what is so. */
static double told_over_true(void (*make)(struct film *, uint32_t, double,
                                          uint32_t),
                             uint32_t samples, double rare)
{
    double told = 0.0, is = 0.0;
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct film f;
    o.width = o.height = SIDE;
    assert_true(film_init(&f, &o, truth_error()) &&
                film_room(&f, truth_error()));
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        make(&f, samples, rare, seed);
        double error;
        assert_true(film_error(&f, film_rows_here, &f, &error, truth_error()));
        told += error * error;
        is += error_of(&f) * error_of(&f);
    }
    film_release(&f);
    return sqrt(told / is);
}

/* Light that few samples find makes those pixels bright, and its own measure:
 * over such a mean it looks small. */
static void film__rare_light_is_not_told_small(void **state)
{
    (void)state;
    const uint32_t samples[] = {16, 64, 256};
    for (int i = 0; i < 3; i++) {
        double ratio = told_over_true(fill, samples[i], 20.0);
        if (!(ratio > 0.9 && ratio < 2.6))
            fail_msg("of %u samples, told over true: %.2f", samples[i], ratio);
    }
}

static void film__even_noise_is_told_as_it_is(void **state)
{
    (void)state;
    double ratio = told_over_true(fill, 64, 1.0);
    if (!(ratio > 0.9 && ratio < 1.3))
        fail_msg("told over true: %.2f", ratio);
}

/* An edge parts the halves of a pixel's samples less the more there are. They
 * make up for one another, so that both together are nearer than they tell. */
static void film__edges_are_told_as_they_are(void **state)
{
    (void)state;
    for (uint32_t samples = 16; samples <= 4096; samples *= 4) {
        double ratio = told_over_true(fill_edges, samples, 1.0);
        if (!(ratio > 1.2 && ratio < 2.2))
            fail_msg("of %u samples, told over true: %.2f", samples, ratio);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film__rare_light_is_not_told_small),
        cmocka_unit_test(film__even_noise_is_told_as_it_is),
        cmocka_unit_test(film__edges_are_told_as_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
