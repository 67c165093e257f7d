/* test_model.c - parser/model: the camera against the rays of POV-Ray
 * 3.7.0.10, measured where they hit a sphere of radius 1000 about the origin
 * (4x3 pixels, to 0.1 units); textures, media and their maps. */
#include "parser/model.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

/* ---- camera ------------------------------------------------------------ */

/* Where the ray of pixel (x, y) of 4x3 hits the sphere. */
static void hit(const struct brume_camera *camera, int x, int y, double out[3])
{
    double u = (x + 0.5) / 4 - 0.5, v = 0.5 - (y + 0.5) / 3;
    double p[3], d[3], dd = 0, pd = 0, pp = 0;

    for (int i = 0; i < 3; i++) {
        double shift = u * camera->right[i] + v * camera->up[i];
        bool parallel = camera->kind == BRUME_CAMERA_ORTHOGRAPHIC;
        p[i] = camera->location[i] + (parallel ? shift : 0);
        d[i] = camera->direction[i] + (parallel ? 0 : shift);
        dd += d[i] * d[i];
        pd += p[i] * d[i];
        pp += p[i] * p[i];
    }
    double t = (-pd + sqrt(pd * pd - dd * (pp - 1e6))) / dd;
    for (int i = 0; i < 3; i++)
        out[i] = p[i] + t * d[i];
}

struct view {
    const char *says;
    struct camera camera;
    enum camera_fault fault;
    double corner[3][3]; /* pixels (0, 0), (3, 0), (0, 2)           */
};

#define TURNED_Y_30                                                            \
    .by = {{{0.86602540378443865, 0, 0.5, 0},                                  \
            {0, 1, 0, 0},                                                      \
            {-0.5, 0, 0.86602540378443865, 0}}}
#define LOOK_AT(x, y, z) .look_at = {x, y, z}, .has_look_at = true

/* What is left out is as in POV-Ray. */
static const struct view views[] = {
    {"camera {}",
     {.angle = 0},
     CAMERA_FINE,
     {{-427.7, 285.8, 857.5}, {427.7, 285.8, 857.5}, {-427.7, -285.8, 857.5}}},
    {"angle 60",
     {.angle = 60},
     CAMERA_FINE,
     {{-384.1, 256.7, 886.9}, {384.1, 256.7, 886.9}, {-384.1, -256.7, 886.9}}},
    {"right 2*x angle 60",
     {.right = {2, 0, 0}, .angle = 60},
     CAMERA_FINE,
     {{-391.3, 173.9, 903.7}, {391.3, 173.9, 903.7}, {-391.3, -173.9, 903.7}}},
    {"location look_at sky",
     {.location = {1, 2, -3}, LOOK_AT(0, 1, 5), .sky = {1, 2, 0}},
     CAMERA_FINE,
     {{-363.6, 341.5, 866.7}, {402.1, -41.3, 914.7}, {-612.2, -166.5, 773.0}}},
    {"location look_at rotate",
     {.location = {1, 2, -3}, LOOK_AT(0, 1, 5), TURNED_Y_30},
     CAMERA_FINE,
     {{-50.3, 180.6, 982.3}, {739.5, 180.5, 648.5}, {-77.8, -388.6, 918.1}}},
    {"right -1.33*x",
     {.right = {-1.33, 0, 0}, .location = {1, 2, -3}, LOOK_AT(0, 1, 5)},
     CAMERA_FINE,
     {{316.2, 180.5, 931.4}, {-534.7, 180.6, 825.5}, {325.2, -388.4, 862.2}}},
    {"look_at along sky",
     {LOOK_AT(0, 5, 0)},
     CAMERA_SKY_AHEAD,
     {{-427.7, 857.5, -285.8}, {427.7, 857.5, -285.8}, {-427.7, 857.5, 285.8}}},
    {"look_at along sky, right-handed",
     {.right = {-4.0 / 3, 0, 0}, LOOK_AT(0, 5, 0)},
     CAMERA_SKY_AHEAD,
     {{-428.6, 857.1, 285.7}, {428.6, 857.1, 285.7}, {-428.6, 857.1, -285.7}}},
    {"direction 2*z look_at",
     {.direction = {0, 0, 2}, LOOK_AT(1, 0, 5)},
     CAMERA_FINE,
     {{-46.4, 159.7, 986.1}, {422.1, 159.7, 892.4}, {-46.4, -159.7, 986.1}}},
    {"all of them",
     {.location = {1, 2, -3},
      LOOK_AT(0, 1, 5),
      .angle = 40,
      .up = {0, 2, 0},
      .right = {3, 0, 0},
      .direction = {0, 0, 7}},
     CAMERA_FINE,
     {{-378.0, 37.8, 925.0}, {139.9, 37.8, 989.4}, {-373.5, -269.3, 887.7}}},
    {"orthographic",
     {.type = CAMERA_ORTHOGRAPHIC, .location = {0, 0, -100}},
     CAMERA_FINE,
     {{-50.37, 33.68, 998.17},
      {50.37, 33.68, 998.17},
      {-50.37, -33.68, 998.17}}},
    {"orthographic direction 2*z look_at",
     {.type = CAMERA_ORTHOGRAPHIC,
      .location = {0, 0, -100},
      .direction = {0, 0, 2},
      LOOK_AT(0, 0, 0)},
     CAMERA_FINE,
     {{-24.95, 16.68, 999.54},
      {24.95, 16.68, 999.54},
      {-24.95, -16.68, 999.54}}},
    {"orthographic right 200*x",
     {.type = CAMERA_ORTHOGRAPHIC,
      .location = {0, 0, -100},
      LOOK_AT(0, 0, 0),
      .right = {200, 0, 0},
      .has_right = true},
     CAMERA_FINE,
     {{-75, 0.32, 997.19}, {75, 0.32, 997.19}, {-75, -0.32, 997.19}}},
    {"orthographic right up angle 60",
     {.type = CAMERA_ORTHOGRAPHIC,
      .location = {0, 0, -100},
      LOOK_AT(0, 0, 0),
      .right = {200, 0, 0},
      .up = {0, 150, 0},
      .has_right = true,
      .has_up = true,
      .angle = 60},
     CAMERA_FINE,
     {{-43.29, 28.85, 998.66},
      {43.29, 28.85, 998.66},
      {-43.29, -28.85, 998.66}}},
    {"orthographic angle 60, nothing to look at",
     {.type = CAMERA_ORTHOGRAPHIC, .location = {0, 0, -100}, .angle = 60},
     CAMERA_FINE,
     {{-43.75, 29.22, 998.63},
      {43.75, 29.22, 998.63},
      {-43.75, -29.22, 998.63}}},
};

static void fill_vector(double v[3], const double start[3])
{
    if (v[0] == 0 && v[1] == 0 && v[2] == 0)
        memcpy(v, start, 3 * sizeof *v);
}

static struct camera filled(struct camera camera)
{
    const struct camera *start = &model_default_camera;

    fill_vector(camera.direction, start->direction);
    fill_vector(camera.up, start->up);
    fill_vector(camera.right, start->right);
    fill_vector(camera.sky, start->sky);
    if (!camera.has_look_at)
        fill_vector(camera.look_at, start->look_at);
    if (camera.by.m[0][0] == 0)
        camera.by = transform_identity();
    return camera;
}

static void cameras_see_what_pov_ray_sees(void **state)
{
    static const int pixel[3][2] = {{0, 0}, {3, 0}, {0, 2}};
    (void)state;

    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        struct brume_camera camera;
        struct camera said = filled(views[i].camera);
        enum camera_fault fault = model_camera(&said, &camera);

        if (fault != views[i].fault)
            fail_msg("%s: fault %d", views[i].says, (int)fault);
        for (int k = 0; k < 3; k++) {
            double got[3];
            hit(&camera, pixel[k][0], pixel[k][1], got);
            for (int j = 0; j < 3; j++)
                if (!(fabs(got[j] - views[i].corner[k][j]) < 0.11))
                    fail_msg("%s: pixel %d: %.2f, not %.2f", views[i].says, k,
                             got[j], views[i].corner[k][j]);
        }
    }
}

static void a_camera_cannot_look_at_itself(void **state)
{
    struct camera camera = {.location = {1, 2, 3}, LOOK_AT(1, 2, 3)};
    struct brume_camera out;
    (void)state;

    assert_int_equal(model_camera(&camera, &out), CAMERA_LOOKS_AT_ITSELF);
}

/* ---- surfaces ---------------------------------------------------------- */

static struct texture colored(double r, double g, double b, double filter,
                              double transmit)
{
    struct texture texture = model_default_texture;
    double color[5] = {r, g, b, filter, transmit};

    memcpy(texture.pigment.color, color, sizeof color);
    return texture;
}

/* A checker of the colour above and another. */
static struct pattern checker = {.kind = PATTERN_CHECKER, .frequency = 1};
static struct map_entry choice[2];
static struct map choices = {.kind = VALUE_COLOR_MAP, .list = true, .count = 2};

static void chequer(struct texture *texture, double transmit)
{
    double color[5] = {1, 1, 1, 0, transmit};

    memcpy(choice[0].color, texture->pigment.color, sizeof color);
    memcpy(choice[1].color, color, sizeof color);
    choice[0].next = &choice[1];
    choices.first = &choice[0];
    texture->pigment.on.pattern = &checker;
    texture->pigment.on.map = &choices;
    surface_mean_pigment(&texture->pigment);
}

static void clear_textures_are_invisible(void **state)
{
    struct texture texture = colored(1, 1, 1, 0, 1);
    (void)state;

    assert_true(model_is_invisible(&texture));
    texture = colored(0, 0, 0, 0, 1);
    assert_true(model_is_invisible(&texture));
    texture = colored(1, 1, 1, 1, 0);
    assert_true(model_is_invisible(&texture));
    texture = colored(1, 0.5, 1, 1, 0);
    assert_false(model_is_invisible(&texture));
    texture = colored(1, 1, 1, 0, 0.9);
    assert_false(model_is_invisible(&texture));
    texture = colored(1, 1, 1, 0, 1);
    texture.finish.phong = 0.5;
    assert_false(model_is_invisible(&texture));
    texture = colored(1, 1, 1, 0, 1);
    chequer(&texture, 0);
    assert_false(model_is_invisible(&texture));
    texture = colored(1, 1, 1, 0, 1);
    texture.finish.reflection.high[1] = 0.1;
    assert_false(model_is_invisible(&texture));
}

static void textures_without_filter_and_transmit_are_opaque(void **state)
{
    struct texture texture = colored(1, 1, 1, 0, 0);
    (void)state;

    assert_true(model_is_opaque(&texture));
    chequer(&texture, 0.5);
    assert_false(model_is_opaque(&texture));
    struct texture below = colored(1, 1, 1, 0, 0);
    texture.below = &below;
    assert_true(model_is_opaque(&texture));
}

static void maps_follow_the_pigment(void **state)
{
    struct texture texture = model_default_texture;
    transform by = transform_translate((const double[3]){1, 2, 3});
    struct brume_material material;
    (void)state;

    texture.pigment.on.by = transform_scale((const double[3]){2, 2, 2});
    model_material(&texture, &by, &material);
    assert_true(material.pigment_transform[0][0] == 1);
    chequer(&texture, 0);
    model_material(&texture, &by, &material);
    assert_true(material.pigment_transform[0][0] == 2);
    assert_true(material.pigment_transform[2][3] == 3);
    assert_true(material.ambient[1] == 0.1 && material.diffuse == 0.6);
}

/* ---- media ------------------------------------------------------------- */

static void maps_reach_the_densities_that_are_there(void **state)
{
    struct media media = {.densities = 1};
    transform by = transform_translate((const double[3]){1, 2, 3});
    (void)state;

    for (int i = 0; i < 2; i++)
        media.density[i].on.by = transform_identity();
    media.fire.temperature.on.by = transform_identity();
    model_media_transform(&media, &by);
    assert_true(media.density[0].on.by.m[0][3] == 1);
    assert_true(media.density[1].on.by.m[0][3] == 0);
    assert_true(media.fire.temperature.on.by.m[1][3] == 2);
}

/* Cycles emits 5.670373e-8 * 1e-6 / pi * T^4 in luminance. */
static void the_cycles_preset_has_its_brightness(void **state)
{
    struct fire fire;
    (void)state;

    memset(&fire, 0, sizeof fire);
    model_fire_preset(&fire, FIRE_CYCLES);
    assert_int_equal(fire.brightness, BRUME_BRIGHTNESS_TOTAL);
    double ours = fire.intensity * pow(1500 / fire.reference, 4);
    double theirs = 5.670373e-14 / 3.14159265358979 * pow(1500, 4);
    assert_true(fabs(ours / theirs - 1) < 1e-6);
    assert_true(fire.kelvin[0] == 1000 && fire.additive == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_see_what_pov_ray_sees),
        cmocka_unit_test(a_camera_cannot_look_at_itself),
        cmocka_unit_test(clear_textures_are_invisible),
        cmocka_unit_test(textures_without_filter_and_transmit_are_opaque),
        cmocka_unit_test(maps_follow_the_pigment),
        cmocka_unit_test(maps_reach_the_densities_that_are_there),
        cmocka_unit_test(the_cycles_preset_has_its_brightness),
    };

    return cmocka_run_group_tests_name("model", tests, NULL, NULL);
}
