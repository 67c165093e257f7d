/* test_api.c - brume.h as a program without the parser uses it. Only
 * core/brume.h is included, as a foreign program would. */
#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include "core/brume.h"

enum { SIDE = 16, PIXELS = SIDE * SIDE };

static void expect_ok(bool ok, const struct brume_error *err)
{
    if (!ok)
        fail_msg("error %d: %s", (int)err->code, err->text);
}

/* A view of the square from (-half, -half) to (half, half) along +z. */
static void look_along_z(brume_scene *scene, double half)
{
    struct brume_error err = {0};
    struct brume_camera camera = BRUME_CAMERA_INIT;
    camera.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    camera.location[2] = -10;
    camera.right[0] = 2 * half;
    camera.up[1] = 2 * half;
    expect_ok(brume_set_camera(scene, &camera, &err), &err);
}

static brume_scene *new_scene(double half)
{
    struct brume_error err = {0};
    brume_scene *scene = brume_scene_new(&err);
    expect_ok(scene != NULL, &err);
    look_along_z(scene, half);
    return scene;
}

/* A sphere of radius 1 at the origin; ids of -1 leave its part out. */
static void add_sphere(brume_scene *scene, int material, int interior)
{
    struct brume_error err = {0};
    struct brume_shape shape = BRUME_SHAPE_INIT;
    shape.material = material;
    shape.interior = interior;
    shape.hollow = interior >= 0;
    expect_ok(brume_add_shape(scene, &shape, &err) >= 0, &err);
}

static int add_diffuse(brume_scene *scene, double albedo)
{
    struct brume_error err = {0};
    struct brume_material material = BRUME_MATERIAL_INIT;
    for (int c = 0; c < 3; c++) {
        material.color[0][c] = 1;
        material.ambient[c] = 0;
    }
    material.diffuse = albedo;
    int id = brume_add_material(scene, &material, &err);
    expect_ok(id >= 0, &err);
    return id;
}

/* An interior of one medium that absorbs and scatters alike in all colours. */
static int add_fog(brume_scene *scene, double absorption, double scattering)
{
    struct brume_error err = {0};
    struct brume_medium medium = BRUME_MEDIUM_INIT;
    for (int c = 0; c < 3; c++) {
        medium.absorption[c] = absorption;
        medium.scattering[c] = scattering;
    }
    int id = brume_add_medium(scene, &medium, &err);
    expect_ok(id >= 0, &err);
    int interior = brume_add_interior(scene, &id, 1, &err);
    expect_ok(interior >= 0, &err);
    return interior;
}

/* Light of radiance 1 from everywhere, in full transport. */
static void surround(brume_scene *scene)
{
    struct brume_error err = {0};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    for (int c = 0; c < 3; c++)
        globals.background[c] = 1;
    globals.media_multiple = true;
    globals.surfaces_indirect = true;
    globals.environment = true;
    expect_ok(brume_set_globals(scene, &globals, &err), &err);
}

static void light_from_camera(brume_scene *scene)
{
    struct brume_error err = {0};
    struct brume_light light = BRUME_LIGHT_INIT;
    light.location[2] = -1e5;
    expect_ok(brume_add_light(scene, &light, &err) >= 0, &err);
}

static struct brume_options small_options(int spp)
{
    struct brume_options options = BRUME_OPTIONS_INIT;
    options.width = SIDE;
    options.height = SIDE;
    options.spp = spp;
    options.backend = BRUME_BACKEND_CPU;
    return options;
}

static struct brume_frame render(brume_scene *scene,
                                 const struct brume_options *options)
{
    struct brume_error err = {0};
    struct brume_frame frame = {0};
    expect_ok(brume_render(scene, options, &frame, &err), &err);
    assert_int_equal(frame.width, SIDE);
    assert_int_equal(frame.height, SIDE);
    assert_int_equal(frame.stats.majorant_exceeded, 0);
    assert_int_equal(frame.stats.rejected, 0);
    return frame;
}

static double mean(const float *value)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)3 * PIXELS; i++)
        sum += (double)value[i];
    return sum / (3 * PIXELS);
}

/* Where nothing absorbs, all light that is missing from behind comes from
 * elsewhere: every pixel is 1. */
static void api__white_medium_in_a_furnace(void **state)
{
    (void)state;
    brume_scene *scene = new_scene(0.6);
    surround(scene);
    add_sphere(scene, -1, add_fog(scene, 0, 3));
    struct brume_options options = small_options(64);
    struct brume_frame frame = render(scene, &options);
    assert_true(fabs(mean(frame.radiance) - 1) < 1e-3);
    assert_true(mean(frame.opacity) > 0.9);
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

static void api__white_surface_in_a_furnace(void **state)
{
    (void)state;
    brume_scene *scene = new_scene(0.5);
    surround(scene);
    add_sphere(scene, add_diffuse(scene, 1), -1);
    struct brume_options options = small_options(16);
    struct brume_frame frame = render(scene, &options);
    assert_true(fabs(mean(frame.radiance) - 1) < 1e-3);
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

/* Lambert's sphere seen from the light: 0.8 cos, so its mean over the square
 * of side 4 around it is 0.8 (2 pi / 3) / 16. */
static void api__lit_sphere(void **state)
{
    (void)state;
    brume_scene *scene = new_scene(2);
    light_from_camera(scene);
    add_sphere(scene, add_diffuse(scene, 0.8), -1);
    struct brume_options options = small_options(1024);
    struct brume_frame frame = render(scene, &options);
    double truth = 0.8 * (2 * 3.14159265358979 / 3) / 16;
    assert_true(fabs(mean(frame.radiance) / truth - 1) < 5e-3);
    /* The nearest points are 9 before the camera; the corners see nothing. */
    float nearest = INFINITY;
    for (size_t i = 0; i < PIXELS; i++)
        nearest = fminf(nearest, frame.depth[i]);
    assert_true(nearest >= 9 && nearest < 9.05);
    assert_true(isinf(frame.depth[0]));
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

/* Beer and Lambert: along the chord c through the sphere, exp(-2 c) of the
 * background is left; over the disc its mean is
 * the integral of c exp(-2 c) / 2 from 0 to 2. */
static void api__absorbing_sphere(void **state)
{
    (void)state;
    brume_scene *scene = new_scene(1);
    struct brume_error err = {0};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    globals.background[0] = globals.background[1] = globals.background[2] = 1;
    expect_ok(brume_set_globals(scene, &globals, &err), &err);
    add_sphere(scene, -1, add_fog(scene, 2, 0));
    struct brume_options options = small_options(1024);
    struct brume_frame frame = render(scene, &options);
    double pi = 3.14159265358979;
    double left = (1 - 5 * exp(-4.0)) / 8;
    double truth = (left * pi + (4 - pi)) / 4;
    assert_true(fabs(mean(frame.radiance) / truth - 1) < 5e-3);
    assert_true(fabs(mean(frame.opacity) - (1 - truth)) < 5e-3);
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

/* A scene in which chance matters: fog over a sphere, lit. */
static brume_scene *noisy_scene(void)
{
    brume_scene *scene = new_scene(1.2);
    surround(scene);
    light_from_camera(scene);
    add_sphere(scene, -1, add_fog(scene, 0.2, 2));
    return scene;
}

static void expect_same(const struct brume_frame *a,
                        const struct brume_frame *b)
{
    size_t bytes = sizeof(float) * 3 * PIXELS;
    assert_memory_equal(a->radiance, b->radiance, bytes);
    assert_memory_equal(a->opacity, b->opacity, bytes);
    assert_memory_equal(a->depth, b->depth, bytes / 3);
}

static void api__threads_do_not_change_a_bit(void **state)
{
    (void)state;
    brume_scene *scene = noisy_scene();
    struct brume_options options = small_options(8);
    options.threads = 1;
    struct brume_frame one = render(scene, &options);
    for (int threads = 2; threads <= 5; threads += 3) {
        options.threads = threads;
        struct brume_frame more = render(scene, &options);
        expect_same(&one, &more);
        brume_frame_free(&more);
    }
    brume_frame_free(&one);
    brume_scene_free(scene);
}

static void api__seed_and_frame_change_the_noise(void **state)
{
    (void)state;
    brume_scene *scene = noisy_scene();
    struct brume_options options = small_options(4);
    struct brume_frame first = render(scene, &options);
    options.seed = 1;
    struct brume_frame seed = render(scene, &options);
    options.seed = 0;
    options.frame = 1;
    struct brume_frame frame = render(scene, &options);
    size_t bytes = sizeof(float) * 3 * PIXELS;
    assert_memory_not_equal(first.radiance, seed.radiance, bytes);
    assert_memory_not_equal(first.radiance, frame.radiance, bytes);
    brume_frame_free(&first);
    brume_frame_free(&seed);
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

static void *render_alone(void *out)
{
    brume_scene *scene = noisy_scene();
    struct brume_options options = small_options(8);
    struct brume_error err = {0};
    struct brume_frame *frame = out;
    brume_render(scene, &options, frame, &err);
    brume_scene_free(scene);
    return NULL;
}

static void api__two_scenes_in_two_threads(void **state)
{
    (void)state;
    struct brume_frame frame[2] = {{0}, {0}};
    pthread_t thread[2];
    for (int i = 0; i < 2; i++)
        assert_int_equal(
            pthread_create(&thread[i], NULL, render_alone, &frame[i]), 0);
    for (int i = 0; i < 2; i++)
        pthread_join(thread[i], NULL);
    assert_non_null(frame[0].radiance);
    assert_non_null(frame[1].radiance);
    expect_same(&frame[0], &frame[1]);
    brume_frame_free(&frame[0]);
    brume_frame_free(&frame[1]);
}

static bool refuse(void *user, const struct brume_progress *progress)
{
    assert_non_null(progress->stage);
    ++*(int *)user;
    return false;
}

static void api__progress_can_stop(void **state)
{
    (void)state;
    brume_scene *scene = noisy_scene();
    struct brume_options options = small_options(4096);
    struct brume_frame frame = {0};
    struct brume_error err = {0};
    int calls = 0;
    options.progress = refuse;
    options.user = &calls;
    assert_false(brume_render(scene, &options, &frame, &err));
    assert_int_equal(err.code, BRUME_STOPPED);
    assert_true(calls >= 1);
    brume_frame_free(&frame);
    brume_scene_free(scene);
}

/* What cannot be is refused where it is added, with its code and a text. */
static void api__refuses_what_cannot_be(void **state)
{
    (void)state;
    brume_scene *scene = new_scene(1);
    struct brume_shape shape = BRUME_SHAPE_INIT;
    shape.material = 3;
    struct brume_medium medium = BRUME_MEDIUM_INIT;
    medium.absorption[1] = -1;
    struct brume_light light = BRUME_LIGHT_INIT;
    light.location[0] = NAN;
    int nowhere = 7;
    for (int i = 0; i < 4; i++) {
        struct brume_error err = {0};
        int id = i == 0   ? brume_add_shape(scene, &shape, &err)
                 : i == 1 ? brume_add_medium(scene, &medium, &err)
                 : i == 2 ? brume_add_light(scene, &light, &err)
                          : brume_add_interior(scene, &nowhere, 1, &err);
        assert_int_equal(id, -1);
        assert_int_not_equal(err.code, BRUME_OK);
        assert_true(strlen(err.text) > 0);
    }
    brume_scene_free(scene);
}

static void api__plan_tells_what_runs(void **state)
{
    (void)state;
    brume_scene *scene = noisy_scene();
    struct brume_options options = small_options(1);
    struct brume_error err = {0};
    struct brume_plan plan;
    expect_ok(brume_plan_frame(scene, &options, &plan, &err), &err);
    assert_true(plan.stages > 0);
    for (int i = 0; i < plan.stages; i++)
        assert_true(plan.stage[i].name[0] && plan.stage[i].reason[0]);
    brume_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(api__white_medium_in_a_furnace),
        cmocka_unit_test(api__white_surface_in_a_furnace),
        cmocka_unit_test(api__lit_sphere),
        cmocka_unit_test(api__absorbing_sphere),
        cmocka_unit_test(api__threads_do_not_change_a_bit),
        cmocka_unit_test(api__seed_and_frame_change_the_noise),
        cmocka_unit_test(api__two_scenes_in_two_threads),
        cmocka_unit_test(api__progress_can_stop),
        cmocka_unit_test(api__refuses_what_cannot_be),
        cmocka_unit_test(api__plan_tells_what_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
