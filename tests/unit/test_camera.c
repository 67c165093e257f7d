/* test_camera.c - points of the picture to rays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/camera.h"

static void check(vec3 got, float x, float y, float z)
{
    assert_true(fabsf(got.x - x) < 1e-6f);
    assert_true(fabsf(got.y - y) < 1e-6f);
    assert_true(fabsf(got.z - z) < 1e-6f);
}

static camera example(bool orthographic)
{
    camera c;
    c.orthographic = orthographic;
    c.location = vec3_make(1, 2, 3);
    c.direction = vec3_make(0, 0, 2);
    c.up = vec3_make(0, 1, 0);
    c.right = vec3_make(4, 0, 0);
    return c;
}

static void test_camera__perspective(void **state)
{
    (void)state;
    camera c = example(false);
    vec3 o, d;
    camera_ray(&c, 0.0f, 0.0f, &o, &d);
    check(o, 1, 2, 3);
    check(d, 0, 0, 1);
    camera_ray(&c, 0.5f, 0.0f, &o, &d); /* right edge: (2, 0, 2) */
    check(d, 0.70710678f, 0, 0.70710678f);
    camera_ray(&c, -0.5f, 0.5f, &o, &d); /* top left: (-2, 0.5, 2) */
    check(d, -0.69631062f, 0.17407766f, 0.69631062f);
}

static void test_camera__orthographic(void **state)
{
    (void)state;
    camera c = example(true);
    vec3 o, d;
    camera_ray(&c, 0.5f, -0.5f, &o, &d);
    check(o, 3, 1.5f, 3);
    check(d, 0, 0, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_camera__perspective),
        cmocka_unit_test(test_camera__orthographic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
