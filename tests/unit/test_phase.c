/* test_phase.c - the phase functions against their integrals, their mean
 * cosines and their samplers. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/phase.h"
#include "tests/unit/sampler.h"

enum { DRAWS = 1 << 19, KINDS = 5 };

static vec3 draw(const struct sampler *s, float u, float v, float *pdf)
{
    return phase_sample(s->kind, s->g, s->pole, u, v, pdf);
}

static double density(const struct sampler *s, vec3 w)
{
    return phase_eval_between(s->kind, s->g, s->pole, w);
}

/* The formula itself, in double; minus = 1 - c keeps the peaks. */
static double truth(int kind, double g, double minus)
{
    double c = 1 - minus, x = 1 - minus / 2;
    switch (kind) {
    case 2:
        return (1 + 9 * pow(x, 8)) / (8 * M_PI);
    case 3:
        return (1 + 50 * pow(x, 32)) / (4 * M_PI * (1 + 50 / 33.0));
    case 4:
        return 3 / (16 * M_PI) * (1 + c * c);
    case 5:
        return (1 - g * g) / (4 * M_PI) *
               pow((1 - g) * (1 - g) + 2 * g * minus, -1.5);
    default:
        return 1 / (4 * M_PI);
    }
}

static double mean_cosine(int kind, double g)
{
    switch (kind) {
    case 2:
        return 0.5 * (2 * 9 / 10.0 - 1);
    case 3:
        return 50 / 83.0 * (2 * 33 / 34.0 - 1);
    case 5:
        return g;
    default:
        return 0;
    }
}

/* Rings crowd around d where the lobe does. Backward lobes are mirror images,
 * which test_phase__hg_sample_is_exact pins. */
static void check_sampler(int kind, float g, vec3 d)
{
    double peak = 1 - fabs(g);
    struct sampler s = {.draw = draw,
                        .density = density,
                        .kind = kind,
                        .g = g,
                        .crowding = peak < 0.05 ? 6 : 1};
    s.pole = d;
    struct sampler_result r = sampler_run(&s, DRAWS);
    double mean = vec3_dot(r.mean, d);
    print_message("kind %d, g %g: integral %.6f, z %.2f, claim %.1e, "
                  "mean cosine %.6f\n",
                  kind, g, r.integral, r.z, r.claim, mean);
    assert_true(fabs(r.integral - 1) < 1e-3);
    assert_true(r.z < 4.5);
    assert_true(r.claim < 1e-5 + 1e-6 / peak);
    assert_true(r.length < 2.5e-7);
    assert_true(fabs(mean - mean_cosine(kind, g)) < 4.5 / sqrt(DRAWS));
}

static void test_phase__samplers(void **state)
{
    (void)state;
    const vec3 up = vec3_make(0, 0, 1);
    const vec3 askew = vec3_normalize(vec3_make(0.3f, -0.5f, -0.8f));
    const float g[] = {0, 1e-6f, 0.3f, -0.3f, 0.9f, -0.9f, 0.99f, 0.9999f};
    for (int kind = 1; kind < KINDS; kind++)
        check_sampler(kind, 0, askew);
    for (size_t i = 0; i < sizeof g / sizeof *g; i++) {
        check_sampler(5, g[i], up);
        check_sampler(5, g[i], askew);
    }
}

static void test_phase__eval_is_the_formula(void **state)
{
    (void)state;
    const float g[] = {0, 0.5f, -0.5f, 0.99f, -0.99f, 0.9999f, -0.9999f};
    for (int kind = 1; kind <= KINDS; kind++)
        for (size_t i = 0; i < sizeof g / sizeof *g; i++)
            for (double c = -1; c <= 1; c += 1 / 64.0) {
                float cosine = (float)c;
                double t = truth(kind, g[i], 1 - c);
                float p = phase_eval(kind, g[i], cosine);
                assert_true(fabs(p / t - 1) < 2e-6);
            }
    assert_true(fabs(phase_eval(5, 0.999f, 1) * 4 * M_PI *
                         (1 - (double)0.999f) * (1 - (double)0.999f) /
                         (1 + (double)0.999f) -
                     1) < 1e-6);
}

/* Between two float directions, against the same in double. */
static void test_phase__between_keeps_the_peak(void **state)
{
    (void)state;
    rng random = rng_make(14, 0, 0, 0);
    const float g[] = {0.5f, 0.99f, 0.9999f, -0.9999f};
    for (int i = 0; i < 400000; i++) {
        float pdf, h = g[i % 4], u = rng_float(&random);
        vec3 d = warp_sphere(u, rng_float(&random));
        u = rng_float(&random);
        vec3 w = phase_sample(5, h, d, u, rng_float(&random), &pdf);
        double sign = h < 0 ? -1 : 1;
        double x = d.x - sign * w.x, y = d.y - sign * w.y;
        double z = d.z - sign * w.z;
        double t = truth(5, fabsf(h), 0.5 * (x * x + y * y + z * z));
        assert_true(fabs(phase_eval_between(5, h, d, w) / t - 1) < 1e-6);
        assert_true(isfinite(phase_eval(5, h, vec3_dot(d, w))));
    }
}

/* Integral of the density, and of the cosine, over the sphere: midpoints in
 * s, 1 - c = 2 s^12, from the side of the peak. */
static void test_phase__normalisation(void **state)
{
    (void)state;
    const float g[] = {0, 0.5f, -0.5f, 0.99f, -0.99f, 0.9999f, -0.9999f};
    const int n = 200000;
    for (int kind = 1; kind <= KINDS; kind++)
        for (size_t i = 0; i < sizeof g / sizeof *g; i++) {
            double sum = 0, mean = 0;
            for (int k = 0; k < n; k++) {
                double s = (k + 0.5) / n, near = 2 * pow(s, 12);
                float minus = (float)(g[i] < 0 ? 2 - near : near);
                float plus = (float)(g[i] < 0 ? near : 2 - near);
                double p = phase_eval_ends(kind, g[i], minus, plus) * 2 * M_PI *
                           24 * pow(s, 11) / n;
                sum += p;
                mean += p * (g[i] < 0 ? near - 1 : 1 - near);
            }
            assert_true(fabs(sum - 1) < 2e-6);
            assert_true(fabs(mean - mean_cosine(kind, g[i])) < 2e-6);
        }
}

/* Inverse distribution at 0.1, 0.5, 0.9. */
static void test_phase__hg_quantiles(void **state)
{
    (void)state;
    static const double rows[3][4] = {
        {0.5, -0.31250000, 0.68750000, 0.96301020},
        {0.9, 0.74974490, 0.98550000, 0.99877637},
        {0.99, 0.99542761, 0.99985050, 0.99998822}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            float g = (float)rows[i][0], plus, mirrored;
            float u = (float)(0.1 + 0.4 * k);
            float minus = phase_hg_sample(g, u, &plus);
            assert_true(fabs(minus - (1 - rows[i][1 + k])) < 3e-7);
            assert_true(fabs(plus - (1 + rows[i][1 + k])) < 3e-7);
            phase_hg_sample(-g, 1 - u, &mirrored);
            assert_true(fabs(mirrored / minus - 1) < 1e-5);
        }
}

/* The two ends against (q - (1-g))(q + (1-g))/(2g), q = (1-g^2)/D in long
 * double: every digit of a float, at any g. */
static void test_phase__hg_sample_is_exact(void **state)
{
    (void)state;
    const float g[] = {1e-3f, 0.5f, 0.99f, 0.9999f, 1 - 0x1p-24f};
    for (size_t i = 0; i < sizeof g / sizeof *g; i++)
        for (float u = 0x1p-24f; u < 1;
             u = u < 0.5f ? u * 1.3f : fmaxf(u + 0x1p-24f, 0.3f + 0.7f * u))
            for (int sign = -1; sign <= 1; sign += 2) {
                float plus, minus = phase_hg_sample(sign * g[i], u, &plus);
                long double h = g[i], t = sign > 0 ? u : 1.0f - u;
                long double d = 1 - h + 2 * h * t, q = (1 - h * h) / d;
                long double near = (q - (1 - h)) * (q + (1 - h)) / (2 * h);
                long double far = (1 + h - q) * (1 + h + q) / (2 * h);
                assert_true(fabsl((sign > 0 ? minus : plus) - near) <=
                            1e-6L * near);
                assert_true(fabsl((sign > 0 ? plus : minus) - far) <=
                            1e-6L * far);
            }
}

/* Any direction, any numbers: a finite unit vector and a finite density. */
static void test_phase__ends(void **state)
{
    (void)state;
    const float ends[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
    const float g[] = {0, 0.9999f, -0.9999f, 1 - 0x1p-24f, 0x1p-24f - 1};
    for (int kind = 1; kind <= KINDS; kind++)
        for (int i = 0; i < 5 * 16; i++) {
            float pdf;
            vec3 w = phase_sample(kind, g[i / 16], vec3_make(0, 0, -1),
                                  ends[i / 4 % 4], ends[i % 4], &pdf);
            assert_true(fabsf(vec3_length(w) - 1) < 3e-7f);
            assert_true(pdf > 0 && pdf < INFINITY);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_phase__samplers),
        cmocka_unit_test(test_phase__eval_is_the_formula),
        cmocka_unit_test(test_phase__between_keeps_the_peak),
        cmocka_unit_test(test_phase__normalisation),
        cmocka_unit_test(test_phase__hg_quantiles),
        cmocka_unit_test(test_phase__hg_sample_is_exact),
        cmocka_unit_test(test_phase__ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
