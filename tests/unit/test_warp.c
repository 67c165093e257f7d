/* test_warp.c - each warp against its density; frames; ends of the square. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/aim.h"
#include "core/physics/warp.h"
#include "tests/unit/sampler.h"

enum { COSINE, SPHERE, CONE, AIM, DRAWS = 1 << 19 };

/* A lamp that has g of all directions, the others go anywhere. */
static lamp_aim aim_of(const struct sampler *s)
{
    return (lamp_aim){s->pole, s->g};
}

static vec3 draw_aimed(const struct sampler *s, float u, float v, float *pdf)
{
    lamp_aim aim = aim_of(s);
    vec3 w = u < s->g ? aim_sample(&aim, u / s->g, v)
                      : warp_sphere((u - s->g) / (1 - s->g), v);
    *pdf = aim_mixed(&aim, w, warp_sphere_pdf());
    return w;
}

/* (pi - angle)^3, as a density of angles. */
static double aimed_density(const struct sampler *s, vec3 w)
{
    double sine = sqrt((double)w.x * w.x + (double)w.y * w.y);
    double near = 1 - atan2(sine, w.z) / M_PI;
    double angles = 4 / M_PI * near * near * near;
    return s->g * angles / (2 * M_PI * sine) + (1 - s->g) / (4 * M_PI);
}

static vec3 draw(const struct sampler *s, float u, float v, float *pdf)
{
    if (s->kind == AIM)
        return draw_aimed(s, u, v, pdf);
    vec3 w = s->kind == COSINE   ? warp_cosine_hemisphere(u, v)
             : s->kind == SPHERE ? warp_sphere(u, v)
                                 : warp_cone(u, v, s->g);
    *pdf = s->kind == COSINE   ? warp_cosine_hemisphere_pdf(w.z)
           : s->kind == SPHERE ? warp_sphere_pdf()
                               : warp_cone_pdf(s->g);
    return w;
}

static double density(const struct sampler *s, vec3 w)
{
    if (s->kind == AIM)
        return aimed_density(s, w);
    if (s->kind == COSINE)
        return w.z > 0 ? w.z / M_PI : 0;
    if (s->kind == SPHERE)
        return 1 / (4 * M_PI);
    /* A draw at the rim must not fall outside of its own density. */
    double h = ((double)w.x * w.x + (double)w.y * w.y) / (1 + w.z);
    return h <= s->g * (1 + 1e-6) ? 1 / (2 * M_PI * s->g) : 0;
}

static void check(struct sampler s, double integral_tolerance)
{
    s.draw = draw;
    s.density = density;
    s.pole = vec3_make(0, 0, 1);
    struct sampler_result r = sampler_run(&s, DRAWS);
    print_message("kind %d, %g: integral %.6f, z %.2f, claim %.1e\n", s.kind,
                  s.g, r.integral, r.z, r.claim);
    assert_true(fabs(r.integral - 1) < integral_tolerance);
    assert_true(r.z < 4.5);
    assert_true(r.claim < (s.kind == AIM ? 3e-6 : 1e-6));
    assert_true(r.length < 2.5e-7);
}

static void test_warp__directions(void **state)
{
    (void)state;
    check((struct sampler){.kind = COSINE, .crowding = 1}, 1e-3);
    check((struct sampler){.kind = SPHERE, .crowding = 1}, 1e-3);
    check((struct sampler){.kind = CONE, .g = 2, .crowding = 1}, 1e-3);
    check((struct sampler){.kind = CONE, .g = 0.3f, .crowding = 1}, 2e-3);
    check((struct sampler){.kind = CONE, .g = 1e-6f, .crowding = 6}, 2e-3);
    check((struct sampler){.kind = AIM, .g = 0.5f, .crowding = 3}, 2e-3);
}

/* Counts of a uniform law on a square of 16 x 16 bins; `inside` says where
 * the law is. */
static double planar_z(vec3 (*warp)(float, float),
                       bool (*inside)(double, double), double lo)
{
    enum { SIDE = 16, FINE = 64 };
    static double expected[SIDE * SIDE], seen[SIDE * SIDE];
    double area = 0;
    rng random = rng_make(12, 0, 0, 0);
    for (int i = 0; i < SIDE * SIDE; i++) {
        expected[i] = seen[i] = 0;
        for (int k = 0; k < FINE * FINE; k++) {
            double x = (i % SIDE + (k % FINE + 0.5) / FINE) / SIDE;
            double y = (i / SIDE + (k / FINE + 0.5) / FINE) / SIDE;
            expected[i] += inside(lo + (1 - lo) * x, lo + (1 - lo) * y);
        }
        area += expected[i];
    }
    for (int i = 0; i < SIDE * SIDE; i++)
        expected[i] *= DRAWS / area;
    for (int i = 0; i < DRAWS; i++) {
        float u = rng_float(&random);
        vec3 p = warp(u, rng_float(&random));
        assert_true(inside(p.x * (1 - 1e-6), p.y * (1 - 1e-6)));
        int x = (int)fmin((p.x - lo) / (1 - lo) * SIDE, SIDE - 1);
        int y = (int)fmin((p.y - lo) / (1 - lo) * SIDE, SIDE - 1);
        seen[y * SIDE + x]++;
    }
    return sampler_chi_square(expected, seen, SIDE * SIDE);
}

static bool in_disc(double x, double y)
{
    return x * x + y * y <= 1;
}
static bool in_triangle(double x, double y)
{
    return x >= 0 && y >= 0 && x + y <= 1;
}

static void test_warp__planar(void **state)
{
    (void)state;
    double disc = planar_z(warp_disc, in_disc, -1);
    double triangle = planar_z(warp_triangle, in_triangle, 0);
    print_message("disc z %.2f, triangle z %.2f\n", disc, triangle);
    assert_true(disc < 4.5 && triangle < 4.5);
}

static void check_frame(vec3 n)
{
    warp_basis f = warp_frame(n);
    vec3 x_cross_y = vec3_cross(f.x, f.y);
    assert_true(vec3_length(vec3_sub(x_cross_y, n)) < 4e-7f);
    assert_true(fabsf(vec3_dot(f.x, f.y)) < 4e-7f);
    assert_true(fabsf(vec3_dot(f.x, n)) < 4e-7f);
    assert_true(fabsf(vec3_length(f.x) - 1) < 4e-7f);
    assert_true(fabsf(vec3_length(f.y) - 1) < 4e-7f);
    vec3 z = warp_frame_to_world(f, vec3_make(0, 0, 1));
    assert_true(vec3_length(vec3_sub(z, n)) == 0.0f);
}

static void test_warp__frames(void **state)
{
    (void)state;
    rng random = rng_make(13, 0, 0, 0);
    for (int i = 0; i < 100000; i++) {
        float u = rng_float(&random);
        check_frame(warp_sphere(u, rng_float(&random)));
    }
    check_frame(vec3_make(0, 0, 1));
    check_frame(vec3_make(0, 0, -1));
    check_frame(vec3_make(1, 0, -0.0f));
    check_frame(vec3_normalize(vec3_make(1e-4f, -1e-4f, -1)));
    check_frame(vec3_normalize(vec3_make(1e-20f, 1e-20f, -1)));
}

/* The ends of the square give finite unit vectors above the plane. */
static void test_warp__ends(void **state)
{
    (void)state;
    const float ends[] = {0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
    for (int i = 0; i < 16; i++) {
        float u = ends[i / 4], v = ends[i % 4];
        assert_true(warp_cosine_hemisphere(u, v).z > 0);
        assert_true(fabsf(vec3_length(warp_sphere(u, v)) - 1) < 3e-7f);
        assert_true(fabsf(vec3_length(warp_cone(u, v, 2)) - 1) < 3e-7f);
        vec3 b = warp_triangle(u, v);
        assert_true(b.x >= 0 && b.y >= 0 && b.z >= 0);
        assert_true(fabsf(b.x + b.y + b.z - 1) < 2e-7f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_warp__directions),
        cmocka_unit_test(test_warp__planar),
        cmocka_unit_test(test_warp__frames),
        cmocka_unit_test(test_warp__ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
