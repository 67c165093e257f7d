/* test_surface.c - finishes and spot lights against what POV-Ray 3.7.0.10
 * shows: rows of tests/oracle/finish.py and lights.py. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/light.h"
#include "core/physics/surface.h"

/* Diffuse, brilliance, phong, phong_size, specular, roughness, metallic;
 * opacity; degrees between view and normal, between view and light, and about
 * the view; radiance. The pigment is 0.3, the light 1. */
static const float rows[][12] = {
    {0.6f, 1, 0, 40, 0, 0.05f, 0, 1, 0, 40, 30, 0.13788f},
    {0.6f, 1, 0, 40, 0, 0.05f, 0, 1, 30, 105, 20, 0.04135f},
    {0.6f, 1, 0, 40, 0, 0.05f, 0, 1, 60, 10, 30, 0.11208f},
    {0.6f, 1, 0, 40, 0, 0.05f, 0, 0.5f, 30, 70, 30, 0.06328f},
    {0.6f, 1, 0, 40, 0, 0.05f, 0, 0.5f, 60, 50, 10, 0.08772f},
    {0.6f, 3, 0, 40, 0, 0.05f, 0, 1, 30, 50, 20, 0.13861f},
    {0.6f, 3, 0, 40, 0, 0.05f, 0, 1, 60, 30, 20, 0.10666f},
    {0.6f, 3, 0, 40, 0, 0.05f, 0, 0.5f, 30, 70, 30, 0.03128f},
    {0.6f, 3, 0, 40, 0, 0.05f, 0, 0.5f, 60, 10, 30, 0.02173f},
    {0.6f, 0.5f, 0, 40, 0, 0.05f, 0, 1, 30, 50, 20, 0.17234f},
    {0.6f, 0.5f, 0, 40, 0, 0.05f, 0, 1, 60, 120, 10, 0.12583f},
    {0.6f, 0.5f, 0, 40, 0, 0.05f, 0, 0.5f, 0, 85, 30, 0.02657f},
    {0.6f, 0.5f, 0, 40, 0, 0.05f, 0, 0.5f, 30, 0, 20, 0.08376f},
    {0, 1, 0.7f, 40, 0, 0.05f, 0, 1, 0, 0, 10, 0.70001f},
    {0, 1, 0.7f, 40, 0, 0.05f, 0, 0.5f, 60, 135, 20, 0.03679f},
    {0, 1, 0.7f, 5, 0, 0.05f, 0, 1, 30, 90, 10, 0.31588f},
    {0, 1, 0.7f, 5, 0, 0.05f, 0, 0.5f, 0, 0, 10, 0.70001f},
    {0, 1, 0.7f, 5, 0, 0.05f, 0, 0.5f, 30, 105, 20, 0.08547f},
    {0, 1, 0, 40, 0.7f, 0.05f, 0, 1, 0, 20, 20, 0.51537f},
    {0, 1, 0, 40, 0.7f, 0.05f, 0, 1, 30, 115, 30, 0.01706f},
    {0, 1, 0, 40, 0.7f, 0.05f, 0, 0.5f, 0, 20, 20, 0.51537f},
    {0, 1, 0, 40, 0.7f, 0.05f, 0, 0.5f, 30, 115, 30, 0.01706f},
    {0, 1, 0, 40, 0.7f, 0.2f, 0, 1, 0, 20, 20, 0.64842f},
    {0, 1, 0, 40, 0.7f, 0.2f, 0, 1, 30, 90, 10, 0.57241f},
    {0, 1, 0, 40, 0.7f, 0.2f, 0, 1, 60, 145, 30, 0.34025f},
    {0, 1, 0, 40, 0.7f, 0.2f, 0, 0.5f, 0, -30, 20, 0.58860f},
    {0, 1, 0, 40, 0.7f, 0.2f, 0, 0.5f, 60, 60, 10, 0.32824f},
    {0, 1, 0.7f, 1, 0, 0.05f, 1, 1, 0, 40, 30, 0.16849f},
    {0, 1, 0.7f, 1, 0, 0.05f, 1, 1, 30, 105, 20, 0.19965f},
    {0, 1, 0.7f, 1, 0, 0.05f, 1, 1, 60, 50, 10, 0.07030f},
    {0, 1, 0.7f, 1, 0, 0.05f, 1, 0.5f, 30, 50, 20, 0.20218f},
    {0, 1, 0.7f, 1, 0, 0.05f, 1, 0.5f, 60, 120, 10, 0.23761f},
    {0, 1, 0, 40, 0.7f, 1, 0.5f, 1, 0, -30, 20, 0.44231f},
    {0, 1, 0, 40, 0.7f, 1, 0.5f, 1, 60, 60, 10, 0.39153f},
    {0, 1, 0, 40, 0.7f, 1, 0.5f, 0.5f, 0, 40, 30, 0.43224f},
    {0, 1, 0, 40, 0.7f, 1, 0.5f, 0.5f, 30, 105, 20, 0.45179f},
    {0, 1, 0, 40, 0.7f, 1, 0.5f, 0.5f, 60, 50, 10, 0.37092f},
    {0.3f, 1, 0.3f, 3, 0.3f, 0.05f, 0, 1, 30, 30, 10, 0.42408f},
    {0.3f, 1, 0.3f, 3, 0.3f, 0.05f, 0, 1, 60, 100, 30, 0.26069f},
    {0.3f, 1, 0.3f, 3, 0.3f, 0.05f, 0, 0.5f, 0, 75, 20, 0.01978f},
    {0.3f, 1, 0.3f, 3, 0.3f, 0.05f, 0, 0.5f, 30, 0, 20, 0.09337f},
};
enum { ROWS = sizeof rows / sizeof *rows };

/* At `angle` degrees from z, `azimuth` about it. */
static vec3 direction(float angle, float azimuth)
{
    const double degree = 3.14159265358979324 / 180;
    double a = angle * degree, b = azimuth * degree;
    return vec3_make((float)(sin(a) * cos(b)), (float)(sin(a) * sin(b)),
                     (float)cos(a));
}

static void test_surface__as_povray(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        const float *r = rows[i];
        flat_material m = {.diffuse = r[0],
                           .brilliance = r[1],
                           .phong = r[2],
                           .phong_size = r[3],
                           .specular = r[4],
                           .roughness = r[5],
                           .metallic = r[6]};
        rgb got = surface_light(&m, rgb_gray(0.3f), r[7], direction(r[8], 0),
                                vec3_make(0, 0, 1), direction(r[9], r[10]));
        assert_true(fabsf(got.g - r[11]) < 2e-5f);
    }
}

static void test_surface__dark_behind(void **state)
{
    (void)state;
    const vec3 n = vec3_make(0, 0, 1);
    flat_material m = {.diffuse = 1,
                       .brilliance = 0,
                       .phong = 1,
                       .phong_size = 1,
                       .specular = 1,
                       .roughness = 1};
    for (float angle = 90.01f; angle < 180; angle += 7)
        assert_true(rgb_is_black(surface_light(
            &m, rgb_gray(1), 1, n, direction(40, 0), direction(angle, 0))));
}

/* Radius, falloff, tightness; then the light at these distances from the axis
 * of a lamp 10 above. */
static void test_light__cone_as_povray(void **state)
{
    (void)state;
    static const float x[] = {0.875f, 2.875f, 4.875f, 6.875f, 8.875f, 10.875f};
    static const float cones[3][9] = {
        {30, 45, 0, 1, 1, 1, 0.82750f, 0.16402f, 0},
        {20, 50, 10, 0.96258f, 0.67228f, 0.32662f, 0.09572f, 0.01575f,
         0.00073f},
        {50, 30, 3, 0.98863f, 0.88769f, 0.72627f, 0.55956f, 0.41839f,
         0.31011f}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 6; k++) {
            flat_light l = {.kind = LIGHT_SPOT,
                            .tightness = cones[i][2],
                            .inner = direction(cones[i][0], 0).z,
                            .outer = direction(cones[i][1], 0).z};
            float cosine = 10 / sqrtf(100 + x[k] * x[k]);
            float got = light_cone(&l, cosine);
            assert_true(fabsf(got - cones[i][3 + k]) < 2e-5f);
            l.outer = -0.99f;
            assert_true(light_cone(&l, -cosine) == 0.0f);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_surface__as_povray),
        cmocka_unit_test(test_surface__dark_behind),
        cmocka_unit_test(test_light__cone_as_povray),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
