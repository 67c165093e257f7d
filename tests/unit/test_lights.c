/* Lights of every kind against POV-Ray's own figures (tests/oracle/lights.py
 * measures them), and the sky as a light against closed forms. */
#include <string.h>
#include "tests/unit/truth.h"

/* A light 10 before a plane that reflects the same at any angle, seen straight
 * on in a row of pixels from x0 to x1. */
struct row {
    int pixels;
    double x0, x1;
    float value[64];
};

static struct brume_light lamp(void)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[2] = -10.0;
    l.point_at[2] = 0.0;
    for (int i = 0; i < 3; i++)
        l.color[i] = 0.5;
    return l;
}

static brume_scene *wall(const struct row *row, double brilliance)
{
    brume_scene *s = brume_scene_new(truth_error());
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[0] = 0.5 * (row->x0 + row->x1);
    c.location[2] = -40.0;
    c.right[0] = row->x1 - row->x0;
    c.up[1] = 1e-3;
    assert_true(brume_set_camera(s, &c, truth_error()));
    struct brume_material m = BRUME_MATERIAL_INIT;
    struct brume_shape plane = BRUME_SHAPE_INIT;
    for (int i = 0; i < 3; i++) {
        m.color[0][i] = m.diffuse = 1.0;
        m.ambient[i] = 0.0;
    }
    m.brilliance = brilliance;
    plane.kind = BRUME_SHAPE_PLANE;
    plane.a[2] = -1.0;
    plane.radius = 0.0;
    plane.material = brume_add_material(s, &m, truth_error());
    assert_true(brume_add_shape(s, &plane, truth_error()) >= 0);
    return s;
}

static void shoot(brume_scene *s, struct row *row, int spp)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    o.width = row->pixels;
    o.height = 1;
    o.spp = spp;
    assert_true(brume_render(s, &o, &f, truth_error()));
    for (int i = 0; i < row->pixels; i++)
        row->value[i] = f.radiance[3 * i];
    brume_frame_free(&f);
    brume_scene_free(s);
}

/* The pixels are samples over their width: narrow ones stand for points. */
static float at(const struct brume_light *l, double x, double brilliance)
{
    struct row row = {.pixels = 1, .x0 = x - 1e-4, .x1 = x + 1e-4};
    brume_scene *s = wall(&row, brilliance);
    assert_true(brume_add_light(s, l, truth_error()) >= 0);
    shoot(s, &row, 256);
    return row.value[0];
}

static void check_at(const struct brume_light *l, double x, double brilliance,
                     double truth, double most)
{
    double got = (double)at(l, x, brilliance);
    if (!(fabs(got - truth) <= most))
        fail_msg("at %g: %g, POV-Ray %g", x, got, truth);
}

static void lights__cylinder(void **state)
{
    (void)state;
    struct brume_light l = lamp();
    l.kind = BRUME_LIGHT_CYLINDER;
    l.radius = 3.0;
    l.falloff = 6.0;
    const double plain[][2] = {{0.5, 0.5},  {2.5, 0.5},     {3.5, 0.46296},
                               {4.5, 0.25}, {5.5, 0.03704}, {6.5, 0.0}};
    for (int i = 0; i < 6; i++) {
        check_at(&l, plain[i][0], 0.0, plain[i][1], 2e-4);
        check_at(&l, plain[i][0], 1.0, plain[i][1], 2e-4);
    }
    l.tightness = 10.0;
    check_at(&l, 0.5, 0.0, 0.20946, 2e-4);
    check_at(&l, 2.5, 0.0, 0.00228, 2e-5);
    l.tightness = l.radius = 0.0;
    check_at(&l, 5.5, 0.0, 0.5, 1e-5);
    l.radius = 7.0;
    check_at(&l, 5.5, 0.0, 0.5, 1e-5);
    check_at(&l, 6.5, 0.0, 0.0, 0.0);
    l.location[2] = 10.0;
    l.point_at[2] = 20.0;
    check_at(&l, 0.5, 0.0, 0.0, 0.0);
}

static void lights__parallel(void **state)
{
    (void)state;
    struct brume_light l = lamp();
    l.parallel = true;
    check_at(&l, 9.5, 1.0, 0.5, 1e-5);
    l.fade_distance = 5.0;
    l.fade_power = 2.0;
    check_at(&l, 9.5, 0.0, 0.2, 1e-5);
    l.point_at[0] = 10.0;
    check_at(&l, 0.5, 0.0, 0.31201, 2e-5);
    check_at(&l, 19.5, 0.0, 0.05433, 2e-5);
    /* With it a spotlight has no cone; what lies behind is lit as well. */
    l = lamp();
    l.kind = BRUME_LIGHT_SPOT;
    l.parallel = true;
    check_at(&l, 19.5, 0.0, 0.5, 1e-5);
    l = lamp();
    l.parallel = true;
    l.location[2] = 10.0;
    l.point_at[2] = 20.0;
    check_at(&l, 3.0, 1.0, 0.5, 1e-5);
}

static struct brume_light panel(void)
{
    struct brume_light l = lamp();
    l.area = true;
    l.area_axis[0][0] = l.area_axis[1][1] = 8.0;
    l.area_size[0] = l.area_size[1] = 5;
    return l;
}

static void lights__area_illumination(void **state)
{
    (void)state;
    struct brume_light l = panel();
    check_at(&l, 7.0, 1.0, 0.4096, 2e-4);
    /* POV-Ray with 65 x 65 lamps, which still reach 2% too far. */
    l.area_illumination = true;
    check_at(&l, 1.0, 1.0, 0.4734, 2e-3);
    check_at(&l, 7.0, 1.0, 0.4018, 2e-3);
    l.fade_distance = 5.0;
    l.fade_power = 2.0;
    check_at(&l, 7.0, 0.0, 0.1395, 2e-3);
    l.fade_power = 0.0;
    l.kind = BRUME_LIGHT_SPOT;
    l.radius = 20.0;
    l.falloff = 30.0;
    check_at(&l, 4.5, 0.0, 0.223, 2e-2);
}

/* The share of an area that a knife's edge at x < 0, half way, lets by. */
static void check_knife(const struct brume_light *l, double x, double truth)
{
    struct row row = {.pixels = 1, .x0 = x - 1e-4, .x1 = x + 1e-4};
    brume_scene *s = wall(&row, 0.0);
    struct brume_shape knife = BRUME_SHAPE_INIT;
    struct brume_material black = BRUME_MATERIAL_INIT;
    knife.kind = BRUME_SHAPE_BOX;
    knife.a[0] = -100.0;
    knife.b[0] = 0.0;
    for (int i = 1; i < 3; i++) {
        knife.a[i] = i == 1 ? -100.0 : -5.0001;
        knife.b[i] = i == 1 ? 100.0 : -5.0;
    }
    black.diffuse = 0.0;
    knife.material = brume_add_material(s, &black, truth_error());
    assert_true(brume_add_shape(s, &knife, truth_error()) >= 0);
    assert_true(brume_add_light(s, l, truth_error()) >= 0);
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[0] = x;
    c.location[2] = -4.0;
    c.right[0] = c.up[1] = 1e-4;
    assert_true(brume_set_camera(s, &c, truth_error()));
    shoot(s, &row, 16384);
    double got = 2.0 * (double)row.value[0];
    if (!(fabs(got - truth) < 4.0 * 0.5 / 128.0))
        fail_msg("behind the knife at %g: %g, truth %g", x, got, truth);
}

/* Closed form of the part of a disc of radius 4 beyond -x. */
static double disc_part(double x)
{
    double t = fmin(fmax(-x / 4.0, -1.0), 1.0);
    return (acos(t) - t * sqrt(1.0 - t * t)) / TRUTH_PI;
}

static void lights__area_shadows(void **state)
{
    (void)state;
    struct brume_light l = panel();
    check_knife(&l, -3.0, 0.125);
    check_knife(&l, 0.0, 0.5);
    check_knife(&l, 2.0, 0.75);
    l.area_circular = true;
    check_knife(&l, -3.0, disc_part(-3.0)); /* POV-Ray: 0.065 */
    check_knife(&l, 2.0, disc_part(2.0));
    /* Facing what it lights: axes of any direction make the same disc. */
    l.area_orient = true;
    l.area_axis[0][0] = 0.0;
    l.area_axis[0][2] = 8.0;
    check_knife(&l, 0.0, 0.5);
    l.area_orient = l.area_circular = false;
    l.area_size[0] = 1; /* no width along the first axis */
    check_knife(&l, -3.0, 0.0);
    check_knife(&l, 3.0, 1.0);
}

static void lights__shadowless_makes_no_highlight(void **state)
{
    (void)state;
    for (int shadows = 0; shadows < 2; shadows++) {
        brume_scene *s = truth_scene(&(struct brume_globals)BRUME_GLOBALS_INIT,
                                     10.0, 1e-3);
        struct brume_material m = BRUME_MATERIAL_INIT;
        struct brume_shape ball = BRUME_SHAPE_INIT;
        struct brume_light l = lamp();
        l.shadows = shadows;
        m.diffuse = 0.0;
        m.specular = 0.5;
        ball.material = brume_add_material(s, &m, truth_error());
        assert_true(brume_add_shape(s, &ball, truth_error()) >= 0);
        assert_true(brume_add_light(s, &l, truth_error()) >= 0);
        double got = truth_render(s, 2, 8).mean[0];
        assert_true(shadows ? fabs(got - 0.25) < 1e-3 : got == 0.0);
    }
}

static void lights__refuses_what_is_not_supported(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(truth_error());
    struct brume_light l[4] = {lamp(), lamp(), panel(), lamp()};
    l[0].looks_like = 0;
    l[1].projected_through = 0;
    l[2].area_size[1] = 0;
    l[3].kind = BRUME_LIGHT_CYLINDER;
    l[3].point_at[2] = l[3].location[2];
    for (int i = 0; i < 4; i++) {
        struct brume_error err = {.code = BRUME_OK};
        assert_int_equal(brume_add_light(s, &l[i], &err), -1);
        assert_int_equal(err.code, BRUME_ERR_SCENE);
    }
    brume_scene_free(s);
}

/* ---- the sky ------------------------------------------------------------ */

/* Fog that does not attenuate shows the length of a ray that sharp beams
 * light: a cone and a tube from above, one from ahead and one that misses. */
static void lights__beams_in_fog(void **state)
{
    (void)state;
    const struct {
        enum brume_light_kind kind;
        double from[3], to[3], radius, length;
    } row[] = {
        {BRUME_LIGHT_SPOT, {0, 10, 0}, {0, 0, 0}, 10.0, 3.5265396},
        {BRUME_LIGHT_SPOT, {6, 10, 0}, {0, 0, 0}, 10.0, 4.1126166},
        {BRUME_LIGHT_SPOT, {0, 0, 10}, {0, 0, 0}, 10.0, 20.0},
        {BRUME_LIGHT_SPOT, {0, 10, 0}, {3, 0, 0}, 10.0, 0.0},
        {BRUME_LIGHT_CYLINDER, {0, 10, 0}, {0, 0, 0}, 2.0, 4.0},
        {BRUME_LIGHT_CYLINDER, {0, -3, 3}, {0, 0, 0}, 2.0, 5.6568542},
        {BRUME_LIGHT_CYLINDER, {0, 0, -4}, {0, 0, 0}, 2.0, 14.0},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        struct brume_globals g = BRUME_GLOBALS_INIT;
        brume_scene *s = truth_scene(&g, 20.0, 1e-6);
        struct brume_medium m = truth_medium(0.0, 0.1, 0.0);
        struct brume_light l = BRUME_LIGHT_INIT;
        m.extinction = 0.0;
        truth_fill(s, truth_box(30.0, -10.0, 10.0), &m);
        l.kind = row[i].kind;
        memcpy(l.location, row[i].from, sizeof l.location);
        memcpy(l.point_at, row[i].to, sizeof l.point_at);
        l.radius = l.falloff = row[i].radius;
        assert_true(brume_add_light(s, &l, truth_error()) >= 0);
        struct estimate e = truth_render(s, 4, 64);
        double truth = 0.1 * row[i].length;
        if (!(fabs(e.mean[0] - truth) <= 4e-3 * truth))
            fail_msg("beam %zu: %g, not %g", i, e.mean[0], truth);
    }
}

enum { SKY_WIDTH = 16, SKY_HEIGHT = 8 };

static struct brume_globals under_sky(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    return g;
}

static void set_sky(brume_scene *s, const float *texel, bool interpolate)
{
    float rgb[3 * SKY_WIDTH * SKY_HEIGHT];
    struct brume_sky sky = BRUME_SKY_INIT;
    for (int i = 0; i < 3 * SKY_WIDTH * SKY_HEIGHT; i++)
        rgb[i] = texel[i / 3];
    sky.width = SKY_WIDTH;
    sky.height = SKY_HEIGHT;
    sky.radiance = rgb;
    sky.interpolate = interpolate;
    /* The map's pole, +y, to the world's -z; its +z to +y. */
    const double turned[3][4] = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}};
    for (int i = 0; i < 12; i++)
        sky.transform[i / 4][i % 4] = turned[i / 4][i % 4];
    assert_true(brume_set_sky(s, &sky, truth_error()));
}

/* A matte wall that faces the map's pole: irradiance of its upper rows. */
static struct estimate lit_wall(const float *texel, bool interpolate, int spp)
{
    struct row row = {.pixels = 1, .x0 = -1e-3, .x1 = 1e-3};
    struct brume_globals g = under_sky();
    brume_scene *s = wall(&row, 1.0);
    assert_true(brume_set_globals(s, &g, truth_error()));
    set_sky(s, texel, interpolate);
    return truth_render(s, 6, spp);
}

/* Rows of radiance: E / pi is the sum of radiance times the difference of
 * sin^2 over the row. */
static void lights__sky_lights_a_wall(void **state)
{
    (void)state;
    float texel[SKY_WIDTH * SKY_HEIGHT];
    double truth = 0.0;
    for (int y = 0; y < SKY_HEIGHT; y++)
        for (int x = 0; x < SKY_WIDTH; x++) {
            float v = 0.1f + (float)((x * 7 + y * 3) % 5);
            double a = sin(TRUTH_PI * y / SKY_HEIGHT);
            double b = sin(TRUTH_PI * (y + 1) / SKY_HEIGHT);
            texel[y * SKY_WIDTH + x] = v;
            if (y < SKY_HEIGHT / 2)
                truth += (double)v * (b * b - a * a) / SKY_WIDTH;
        }
    struct estimate e = lit_wall(texel, false, 1000);
    truth_check("wall under a sky", &e, truth, 1e-6, 5e-3);
}

/* One small bright texel on a dim ground, found by its choice. */
static void lights__sky_with_a_sun(void **state)
{
    (void)state;
    float texel[SKY_WIDTH * SKY_HEIGHT];
    for (int i = 0; i < SKY_WIDTH * SKY_HEIGHT; i++)
        texel[i] = 0.5f;
    texel[2 * SKY_WIDTH + 5] = 5000.0f;
    double a = sin(TRUTH_PI / 4.0), b = sin(TRUTH_PI * 3.0 / 8.0);
    double truth = 0.5 + 4999.5 * (b * b - a * a) / SKY_WIDTH;
    struct estimate e = lit_wall(texel, false, 200);
    truth_check("wall under a sun", &e, truth, 1e-4, 5e-3);
}

/* Interpolated, a map is what its rows are between their centres: one that is
 * linear in the polar angle stays so; E / pi = 2 Int L cos sin. */
static void lights__sky_interpolates(void **state)
{
    (void)state;
    float texel[SKY_WIDTH * SKY_HEIGHT];
    double truth = 0.0;
    for (int y = 0; y < SKY_HEIGHT; y++)
        for (int x = 0; x < SKY_WIDTH; x++)
            texel[y * SKY_WIDTH + x] = y < 4 ? (float)(3 - y) : 0.0f;
    for (int i = 0; i < 100000; i++) {
        double polar = 0.5 * TRUTH_PI * (i + 0.5) / 100000;
        double row = polar / TRUTH_PI * SKY_HEIGHT - 0.5;
        double v = fmin(fmax(3.0 - row, 0.0), 3.0);
        truth += v * sin(2.0 * polar) * 0.5 * TRUTH_PI / 100000;
    }
    struct estimate e = lit_wall(texel, true, 1000);
    truth_check("interpolated sky", &e, truth, 1e-6, 5e-3);
}

/* The eye sees what it is told, where it is told. */
static void lights__sky_is_seen(void **state)
{
    (void)state;
    float texel[SKY_WIDTH * SKY_HEIGHT];
    for (int i = 0; i < SKY_WIDTH * SKY_HEIGHT; i++)
        texel[i] = (float)i;
    const struct {
        double direction[3];
        int x, y;
    } rows[] = {
        {{0.3, 1, 0.05}, 8, 4},   {{0.3, 1, -0.05}, 8, 3},
        {{-0.3, 1, -0.05}, 7, 3}, {{1, 0.1, -0.05}, 11, 3},
        {{0.001, 0.1, -5}, 8, 0}, {{-0.001, 0.1, 5}, 7, 7},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct brume_globals g = BRUME_GLOBALS_INIT;
        brume_scene *s = truth_scene(&g, 1.0, 1e-6);
        struct brume_camera c = BRUME_CAMERA_INIT;
        for (int k = 0; k < 3; k++)
            c.direction[k] = rows[i].direction[k];
        c.right[0] = c.up[1] = 1e-6;
        assert_true(brume_set_camera(s, &c, truth_error()));
        set_sky(s, texel, false);
        double got = truth_render(s, 1, 1).mean[0];
        if (got != rows[i].y * SKY_WIDTH + rows[i].x)
            fail_msg("direction %zu sees texel %g", i, got);
    }
}

/* A white medium under any sky returns a mean of it: reciprocity makes the
 * slab's share of each side a truth of T6 (R + T = 1 for albedo 1). */
static void lights__sky_in_a_medium(void **state)
{
    (void)state;
    float texel[SKY_WIDTH * SKY_HEIGHT];
    for (int i = 0; i < SKY_WIDTH * SKY_HEIGHT; i++)
        texel[i] = i < SKY_WIDTH * SKY_HEIGHT / 2 ? 1.0f : 0.0f;
    struct brume_globals g = under_sky();
    brume_scene *s = truth_scene(&g, 1.0, 1e-6);
    struct brume_medium m = truth_medium(0.1, 0.9, 0.75);
    truth_fill(s, truth_box(3000.0, 0.0, 2.0), &m);
    set_sky(s, texel, false);
    struct estimate e = truth_render(s, 32, 200);
    truth_check("van de Hulst's slab", &e, 0.0973946, 1e-7, 1e-2);
}

static void lights__sky_refuses(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(truth_error());
    float good[3] = {1, 1, 1}, bad[3] = {1, NAN, 1};
    struct brume_error err = {.code = BRUME_OK};
    struct brume_sky sky = BRUME_SKY_INIT;
    sky.width = sky.height = 1;
    sky.radiance = bad;
    assert_false(brume_set_sky(s, &sky, &err));
    err = (struct brume_error){.code = BRUME_OK};
    sky.radiance = good;
    sky.height = 0;
    assert_false(brume_set_sky(s, &sky, &err));
    sky.height = 1;
    assert_true(brume_set_sky(s, &sky, truth_error()));
    assert_true(brume_set_sky(s, &sky, truth_error()));
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights__cylinder),
        cmocka_unit_test(lights__parallel),
        cmocka_unit_test(lights__area_illumination),
        cmocka_unit_test(lights__area_shadows),
        cmocka_unit_test(lights__shadowless_makes_no_highlight),
        cmocka_unit_test(lights__refuses_what_is_not_supported),
        cmocka_unit_test(lights__beams_in_fog),
        cmocka_unit_test(lights__sky_lights_a_wall),
        cmocka_unit_test(lights__sky_with_a_sun),
        cmocka_unit_test(lights__sky_interpolates),
        cmocka_unit_test(lights__sky_is_seen),
        cmocka_unit_test(lights__sky_in_a_medium),
        cmocka_unit_test(lights__sky_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
