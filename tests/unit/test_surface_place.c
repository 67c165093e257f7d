/* test_surface_place.c - which colour of a checker lies at a point, and where
 * rays that leave a surface start. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/rng.h"
#include "core/physics/surface.h"
#include "core/physics/warp.h"

/* POV-Ray's parity, below zero and in the planes between cubes. */
static void test_surface__checker_as_povray(void **state)
{
    (void)state;
    const float at[] = {-2.5f, -1.5f, -0.5f, 0.5f, 1.5f, 2.5f};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            for (int k = 0; k < 6; k++)
                assert_int_equal(
                    surface_checker(vec3_make(at[i], at[j], at[k])),
                    (i + j + k + 1) % 2);
    assert_int_equal(surface_checker(vec3_make(0.5f, 0.0f, 0.5f)), 0);
    assert_int_equal(surface_checker(vec3_make(0.5f, 1.0f, 0.5f)), 1);
    assert_int_equal(surface_checker(vec3_make(0.5f, -1.0f, 0.5f)), 1);
    assert_int_equal(surface_checker(vec3_make(0.5f, -1e-6f, 0.5f)), 0);
}

/* A moved origin is off the surface, on the right side, and not far: 256 ulps
 * or 2^-16 along each axis at most. */
static void test_surface__offset(void **state)
{
    (void)state;
    rng r = rng_make(2, 0, 0, 0);
    for (int i = 0; i < 200000; i++) {
        float size = fm_exp(20.0f * rng_float(&r) - 15.0f);
        vec3 p = vec3_scale(warp_sphere(rng_float(&r), rng_float(&r)), size);
        vec3 n = warp_sphere(rng_float(&r), rng_float(&r));
        vec3 q = surface_offset(p, n), step = vec3_sub(q, p);
        assert_true(vec3_dot(step, n) > 0.0f);
        assert_true(step.x * n.x >= 0 && step.y * n.y >= 0 &&
                    step.z * n.z >= 0);
        assert_true(vec3_length(step) <= fmaxf(256 * 1.2e-7f * size, 1.6e-5f));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surface__checker_as_povray),
        cmocka_unit_test(test_surface__offset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
