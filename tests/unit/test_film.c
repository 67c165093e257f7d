/* What a film tells of its own error, beside the error it has. */
#include "tests/unit/truth.h"
#include "core/film.h"

enum { SIDE = 40, SEEDS = 8 };

/* Where the scene is bright, and where dark, in blocks with edges. */
static double truth_at(int x, int y)
{
    return (x / 8 + y / 8) % 2 ? 1.0 : 0.05;
}

/* Samples that are all alike for `rare` = 1, and else 0 but for one in so
 * many, as of paths that seldom find what shines. */
static void fill(struct film *f, uint32_t samples, double rare, uint32_t seed)
{
    f->samples = samples;
    for (int i = 0; i < SIDE * SIDE; i++) {
        rng r = rng_make(seed, 0, 0, (uint64_t)i);
        memset(&f->pixel[i], 0, sizeof f->pixel[i]);
        for (uint32_t k = 0; k < samples; k++) {
            double u = (double)rng_u32(&r) * 0x1p-32;
            double value = rare > 1.0 ? (u < 1.0 / rare ? rare : 0.0) : 0.5 + u;
            for (int c = 0; c < 3; c++)
                f->pixel[i].path[pixel_half(k)][c] += value *
                                                      truth_at(i % SIDE,
                                                               i / SIDE);
        }
    }
}

static double error_of(const struct film *f)
{
    double sum = 0.0, image = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++)
        image += truth_at(i % SIDE, i / SIDE) / (SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const film_pixel *p = &f->pixel[i];
        double truth = truth_at(i % SIDE, i / SIDE);
        double d = (p->path[0][0] + p->path[1][0]) / f->samples - truth;
        sum += d * d / (truth * truth + 0.01 * image * image);
    }
    return sqrt(sum / (SIDE * SIDE));
}

/* Over several seeds, what is told over what is so. */
static double told_over_true(uint32_t samples, double rare)
{
    double told = 0.0, is = 0.0;
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct film f;
    o.width = o.height = SIDE;
    assert_true(film_init(&f, &o, truth_error()));
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        fill(&f, samples, rare, seed);
        told += film_error(&f) * film_error(&f);
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
        double ratio = told_over_true(samples[i], 20.0);
        if (!(ratio > 0.9 && ratio < 2.6))
            fail_msg("of %u samples, told over true: %.2f", samples[i], ratio);
    }
}

static void film__even_noise_is_told_as_it_is(void **state)
{
    (void)state;
    double ratio = told_over_true(64, 1.0);
    if (!(ratio > 0.9 && ratio < 1.3))
        fail_msg("told over true: %.2f", ratio);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(film__rare_light_is_not_told_small),
        cmocka_unit_test(film__even_noise_is_told_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
