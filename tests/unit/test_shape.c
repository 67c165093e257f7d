/* test_shape.c - roots of the analytic shapes: none lost for rays that meet
 * the inside, all on the surface, normals outward. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/rng.h"
#include "core/physics/shape.h"
#include "core/physics/warp.h"

struct probe {
    const char *name;
    int kind;
    float params[4];
};

static const struct probe solids[] = {
    {"sphere", SHAPE_SPHERE, {0}},
    {"box", SHAPE_BOX, {0}},
    {"cylinder", SHAPE_CYLINDER, {0}},
    {"cone", SHAPE_CONE, {1.0f, 0.0f}},
    {"cone upside down", SHAPE_CONE, {0.0f, 1.0f}},
    {"frustum", SHAPE_CONE, {0.3f, 2.0f}},
    {"needle", SHAPE_CONE, {0.01f, 0.001f}},
    {"straight cone", SHAPE_CONE, {0.7f, 0.7f}},
};
enum { SOLIDS = sizeof solids / sizeof *solids };

static float uniform(rng *r, float lo, float hi)
{
    return lo + (hi - lo) * rng_float(r);
}

static float radius_at(const struct probe *s, float z)
{
    return s->kind == SHAPE_CONE
               ? s->params[0] + (s->params[1] - s->params[0]) * z
               : 1.0f;
}

/* A point within `depth` < 1 of the way from the solid's axis to its side. */
static vec3 inner_point(const struct probe *s, rng *r, float depth)
{
    vec3 p = vec3_make(uniform(r, -depth, depth), uniform(r, -depth, depth),
                       uniform(r, -depth, depth));
    if (s->kind == SHAPE_BOX)
        return p;
    if (s->kind == SHAPE_SPHERE)
        return vec3_scale(warp_sphere(rng_float(r), rng_float(r)),
                          depth * rng_float(r));
    float z = 0.5f + 0.5f * p.z, a = 2.0f * FM_PI * rng_float(r);
    float radius = radius_at(s, z) * depth * rng_float(r);
    return vec3_make(radius * fm_cos(a), radius * fm_sin(a), z);
}

/* Distance from the surface, about, and negative inside; in double. */
static double implicit(const struct probe *s, vec3 p)
{
    double x = p.x, y = p.y, z = p.z;
    switch (s->kind) {
    case SHAPE_SPHERE:
        return sqrt(x * x + y * y + z * z) - 1;
    case SHAPE_BOX:
        return fmax(fmax(fabs(x), fabs(y)), fabs(z)) - 1;
    default: {
        double a = s->params[0], b = s->params[1];
        double radius = s->kind == SHAPE_CONE ? a + (b - a) * z : 1;
        return fmax(sqrt(x * x + y * y) - radius, fmax(-z, z - 1));
    }
    }
}

static vec3 random_direction(rng *r)
{
    return vec3_scale(warp_sphere(rng_float(r), rng_float(r)),
                      fm_exp(uniform(r, -5.0f, 5.0f)));
}

/* The roots bracket `inside`, a parameter at which the ray is well inside;
 * each is on the surface, its normal along the way out. */
static void check_pair(const struct probe *s, vec3 o, vec3 d, float inside,
                       double tolerance)
{
    float t[SHAPE_MAX_ROOTS];
    int face[SHAPE_MAX_ROOTS];
    int n = shape_roots(s->kind, s->params, o, d, t, face);
    if (n != 2 || !(t[0] < inside && inside < t[1]))
        fail_msg("%s: %d roots from (%a %a %a) along (%a %a %a)", s->name, n,
                 o.x, o.y, o.z, d.x, d.y, d.z);
    for (int i = 0; i < 2; i++) {
        vec3 p = vec3_mad(o, t[i], d);
        vec3 out = shape_normal(s->kind, s->params, p, face[i]);
        if (!(fabs(implicit(s, p)) < tolerance))
            fail_msg("%s: %g off the surface", s->name, implicit(s, p));
        float cosine = vec3_dot(out, d) * (i == 0 ? -1.0f : 1.0f);
        assert_true(cosine > -1e-3f * vec3_length(out) * vec3_length(d));
    }
}

static void test_shape__rays_from_within(void **state)
{
    (void)state;
    rng r = rng_make(1, 0, 0, 0);
    for (int i = 0; i < 400000; i++) {
        const struct probe *s = &solids[i % SOLIDS];
        vec3 o = inner_point(s, &r, 0.98f);
        assert_true(shape_inside(s->kind, s->params, o));
        /* Near an apex the radius is the root of what is rounded. */
        check_pair(s, o, random_direction(&r), 0.0f,
                   s->kind == SHAPE_CONE ? 1e-4 : 1e-5);
    }
}

/* From up to 10 000 radii away, aimed at an inner point; what the surface is
 * missed by grows as the rounding of the origin. */
static void test_shape__rays_from_afar(void **state)
{
    (void)state;
    rng r = rng_make(2, 0, 0, 0);
    for (int i = 0; i < 400000; i++) {
        const struct probe *s = &solids[i % SOLIDS];
        float away = fm_exp(uniform(&r, 1.0f, 9.2f));
        if (s->params[0] == 0.01f)
            away = fminf(away, 30.0f);
        vec3 o = vec3_scale(warp_sphere(rng_float(&r), rng_float(&r)), away);
        vec3 d = vec3_sub(inner_point(s, &r, 0.9f), o);
        check_pair(s, o, d, 1.0f, 1e-5 + 3e-7 * away);
    }
}

/* Along the axes and exactly through edges: as many roots as a solid has. */
static void test_shape__axis_rays(void **state)
{
    (void)state;
    const float at[] = {-0.5f, 0.0f, 0.25f, 0.5f};
    for (int k = 0; k < SOLIDS * 3 * 16; k++) {
        const struct probe *s = &solids[k / 48];
        int axis = k / 16 % 3;
        float u = at[k % 4], v = at[k / 4 % 4];
        vec3 p = axis == 0   ? vec3_make(0, u, 0.5f + 0.9f * v)
                 : axis == 1 ? vec3_make(u, 0, 0.5f + 0.9f * v)
                             : vec3_make(u, v, 0.5f);
        if (implicit(s, p) > -1e-3)
            continue;
        vec3 d = vec3_make(axis == 0, axis == 1, axis == 2);
        check_pair(s, vec3_mad(p, -4.0f, d), d, 4.0f, 1e-5);
    }
}

static int roots_of(int kind, float hole, vec3 o, vec3 d,
                    float t[SHAPE_MAX_ROOTS])
{
    const float params[4] = {hole, 0, 0, 0};
    int face[SHAPE_MAX_ROOTS];
    return shape_roots(kind, params, o, d, t, face);
}

static void test_shape__flat(void **state)
{
    (void)state;
    float t[SHAPE_MAX_ROOTS];
    const vec3 down = vec3_make(0, 0, -2.0f), along = vec3_make(1, 0, 0);
    vec3 high = vec3_make(0.5f, 0, 1.0f);
    assert_int_equal(roots_of(SHAPE_PLANE, 0, high, down, t), 1);
    assert_true(t[0] == 0.5f);
    assert_int_equal(roots_of(SHAPE_PLANE, 0, high, along, t), 0);
    assert_int_equal(roots_of(SHAPE_DISC, 0.4f, high, down, t), 1);
    assert_int_equal(roots_of(SHAPE_DISC, 0.6f, high, down, t), 0);
}

static void test_shape__misses(void **state)
{
    (void)state;
    rng r = rng_make(3, 0, 0, 0);
    for (int i = 0; i < 200000; i++) {
        const struct probe *s = &solids[i % SOLIDS];
        float t[SHAPE_MAX_ROOTS];
        int face[SHAPE_MAX_ROOTS];
        /* All solids lie within 3 of the origin: this line passes at 4. */
        vec3 d = warp_sphere(rng_float(&r), rng_float(&r));
        warp_basis b = warp_frame(d);
        vec3 o = vec3_mad(vec3_scale(b.x, 4.0f), uniform(&r, -9, 9), d);
        assert_int_equal(shape_roots(s->kind, s->params, o, d, t, face), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shape__rays_from_within),
        cmocka_unit_test(test_shape__rays_from_afar),
        cmocka_unit_test(test_shape__axis_rays),
        cmocka_unit_test(test_shape__flat),
        cmocka_unit_test(test_shape__misses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
