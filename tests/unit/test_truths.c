/* Pictures against numbers known from elsewhere: METHODS.md section 13. */
#include "tests/unit/truth.h"
#include <stdlib.h>

/* POV-Ray's light of this colour gives a medium unit irradiance. */
#define UNIT_LIGHT (1.0 / (4.0 * TRUTH_PI))

static const struct brume_globals single = BRUME_GLOBALS_INIT;

static struct brume_globals multiple_under(double sky)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    for (int i = 0; i < 3; i++)
        g.background[i] = sky;
    return g;
}

static void add_distant_light(brume_scene *s, double color)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[2] = -1e7;
    for (int i = 0; i < 3; i++)
        l.color[i] = color;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
}

/* ---- T1: Beer-Lambert --------------------------------------------------- */

static struct estimate black_slab(double tau)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    for (int i = 0; i < 3; i++)
        g.background[i] = 1.0;
    brume_scene *s = truth_scene(&g, 2.0, 1e-6);
    struct brume_medium m = truth_medium(tau, 0.0, 0.0);
    truth_fill(s, truth_box(10.0, 0.0, 1.0), &m);
    return truth_render(s, 2, 2);
}

static void truths__beer_lambert_depth(void **state)
{
    (void)state;
    const double depths[] = {0.01, 0.1, 1.0, 5.0, 20.0, 50.0, 87.0};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        struct estimate e = black_slab(depths[i]);
        double tau = -log(e.mean[0]);
        if (!(fabs(tau / depths[i] - 1.0) < 1e-5))
            fail_msg("tau %g came out as %.9g", depths[i], tau);
    }
}

static void truths__beer_lambert_opacity(void **state)
{
    (void)state;
    const double depths[] = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 1.0};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        double truth = -expm1(-depths[i]);
        struct estimate e = black_slab(depths[i]);
        if (!(fabs(e.opacity / truth - 1.0) < 1e-5))
            fail_msg("opacity %.9g, truth %.9g", e.opacity, truth);
    }
}

static void truths__beer_lambert_ends(void **state)
{
    (void)state;
    double before = 1.0;
    for (double tau = 87.0; tau < 104.0; tau += 1.0) {
        double l = black_slab(tau).mean[0];
        assert_true(l >= 0.0 && l < before);
        before = l;
    }
    assert_true(black_slab(106.0).mean[0] == 0.0);
    assert_true(black_slab(1e6).mean[0] == 0.0);
    assert_true(black_slab(0.0).mean[0] == 1.0);
}

static int add_grid_field(brume_scene *s, struct grid *g)
{
    struct brume_field f = BRUME_FIELD_INIT;
    grid_finish(g);
    f.kind = BRUME_FIELD_GRID;
    f.grid = brume_add_grid(s, g, truth_error());
    assert_true(f.grid >= 0);
    grid_free(g);
    int id = brume_add_field(s, &f, truth_error());
    assert_true(id >= 0);
    return id;
}

static struct grid *new_grid(int bricks, double voxel, double from)
{
    const int32_t origin[3] = {0, 0, 0};
    const int32_t size[3] = {bricks, bricks, bricks};
    struct grid *g = grid_new(origin, size, 0.0f, truth_error());
    assert_non_null(g);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            g->to_world[i][j] = i == j ? voxel : j == 3 ? from : 0.0;
    return g;
}

/* One trilinear cell along its diagonal: the cell lies across four brick
 * corners' worth of positions, wherever it is put. */
static void trilinear_cell(int at)
{
    const float corner[8] = {1, 4, 0, 2, 3, 5, 7, 6};
    brume_scene *s = truth_scene(&single, 1.0, 1e-9);
    struct grid *g = new_grid(2, 1.0, -(double)at);
    for (int i = 0; i < 8; i++) {
        int x = at + (i & 1), y = at + (i >> 1 & 1), z = at + (i >> 2);
        float *v = grid_brick(g, x >> 3, y >> 3, z >> 3, truth_error());
        assert_non_null(v);
        v[((z & 7) * 8 + (y & 7)) * 8 + (x & 7)] = corner[i];
    }
    struct brume_medium m = truth_medium(1.0, 0.0, 0.0);
    m.density[0] = add_grid_field(s, g);
    m.densities = 1;
    struct brume_shape box = BRUME_SHAPE_INIT;
    box.kind = BRUME_SHAPE_BOX;
    for (int i = 0; i < 3; i++)
        box.b[i] = 1.0;
    truth_fill(s, box, &m);
    struct brume_camera c = {BRUME_CAMERA_PERSPECTIVE,
                             {-1, -1, -1},
                             {1, 1, 1},
                             {0, 1e-9, 0},
                             {1e-9, 0, 0}};
    assert_true(brume_set_camera(s, &c, truth_error()));
    struct estimate e = truth_render(s, 2, 2);
    double tau = -log1p(-e.opacity);
    if (!(fabs(tau - 6.062177826) < 2e-4))
        fail_msg("cell at %d: tau %.7f", at, tau);
}

static void truths__beer_lambert_trilinear(void **state)
{
    (void)state;
    trilinear_cell(3);
    trilinear_cell(7); /* across the bricks' corner */
}

/* An emitting absorber: L = B (1 - exp(-tau)) with emission B sigma_a. */
static void truths__emitting_absorber(void **state)
{
    (void)state;
    const double depths[] = {1e-4, 0.3, 2.0, 40.0};
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        brume_scene *s = truth_scene(&single, 2.0, 1e-6);
        struct brume_medium m = truth_medium(depths[i], 0.0, 0.0);
        for (int c = 0; c < 3; c++)
            m.emission[c] = 3.0 * depths[i];
        truth_fill(s, truth_box(10.0, 0.0, 1.0), &m);
        double truth = -3.0 * expm1(-depths[i]);
        double got = truth_render(s, 2, 2).mean[0];
        assert_true(fabs(got / truth - 1.0) < 1e-5);
    }
}

/* A fire of brightness `total` without absorption: its luminance per length
 * is (T / reference)^4. */
static void truths__fire_of_total_brightness(void **state)
{
    (void)state;
    const double kelvins[] = {1000.0, 2000.0, 6000.0};
    for (size_t i = 0; i < sizeof kelvins / sizeof *kelvins; i++) {
        brume_scene *s = truth_scene(&single, 2.0, 1e-6);
        struct brume_field t = BRUME_FIELD_INIT;
        t.scale = 1.0;
        struct brume_medium m = truth_medium(0.0, 0.0, 0.0);
        m.fire.on = m.fire.additive = true;
        m.fire.temperature = brume_add_field(s, &t, truth_error());
        m.fire.kelvin_scale = kelvins[i];
        m.fire.reference = 3000.0;
        m.fire.brightness = BRUME_BRIGHTNESS_TOTAL;
        truth_fill(s, truth_box(10.0, 0.0, 1.0), &m);
        struct estimate e = truth_render(s, 2, 2);
        double got = 0.2126390 * e.mean[0] + 0.7151687 * e.mean[1] +
                     0.0721923 * e.mean[2];
        double truth = pow(kelvins[i] / 3000.0, 4.0);
        if (!(fabs(got / truth - 1.0) < 1e-5))
            fail_msg("%g K: luminance %g, truth %g", kelvins[i], got, truth);
    }
}

/* ---- T2: furnaces ------------------------------------------------------- */

/* A grid of blocks with hard edges and colour: rough on majorants. */
static struct brume_medium rough_medium(brume_scene *s, double peak,
                                        double albedo, double g)
{
    struct grid *grid = new_grid(4, 1.0 / 32.0, -0.5);
    uint32_t random = 12345;
    for (int b = 0; b < 64; b++) {
        random = random * 1664525u + 1013904223u;
        if (random >> 30 == 0)
            continue;
        float *v = grid_brick(grid, b & 3, b >> 2 & 3, b >> 4, truth_error());
        for (int i = 0; i < 512; i++) {
            random = random * 1664525u + 1013904223u;
            v[i] = random >> 30 ? 0.05f : (float)(random >> 8) / 16777216.0f;
        }
    }
    struct brume_medium m = truth_medium(0.0, 0.0, g);
    const double tint[3] = {1.0, 0.7, 0.4};
    for (int c = 0; c < 3; c++) {
        m.absorption[c] = peak * (1.0 - albedo) * tint[c];
        m.scattering[c] = peak * albedo * tint[c];
    }
    m.density[0] = add_grid_field(s, grid);
    m.densities = 1;
    return m;
}

static void furnace(double peak, double g, bool ball, int spp)
{
    struct brume_globals globals = multiple_under(1.0);
    brume_scene *s = truth_scene(&globals, 3.0, 0.4);
    struct brume_medium m = rough_medium(s, peak, 1.0, g);
    truth_fill(s, truth_box(0.6, -0.6, 0.6), &m);
    if (ball) {
        struct brume_material white = BRUME_MATERIAL_INIT;
        for (int i = 0; i < 3; i++)
            white.color[0][i] = 1.0;
        white.diffuse = 1.0;
        struct brume_shape b = BRUME_SHAPE_INIT;
        b.radius = 0.25;
        b.material = brume_add_material(s, &white, truth_error());
        assert_true(brume_add_shape(s, &b, truth_error()) >= 0);
    }
    struct estimate e = truth_render(s, 24, spp);
    truth_check("furnace", &e, 1.0, 0.0, 4e-3);
}

static void truths__furnace_thin(void **state)
{
    (void)state;
    furnace(5.0, 0.0, false, 100);
}

static void truths__furnace_thick_forward(void **state)
{
    (void)state;
    furnace(100.0, 0.8, false, 160);
}

static void truths__furnace_with_surface(void **state)
{
    (void)state;
    furnace(20.0, -0.5, true, 220);
}

/* Isothermal: a medium that emits B sigma_a inside walls of radiance B. */
static void truths__furnace_isothermal(void **state)
{
    (void)state;
    struct brume_globals globals = multiple_under(1.0);
    brume_scene *s = truth_scene(&globals, 3.0, 0.4);
    struct brume_medium m = rough_medium(s, 20.0, 0.6, 0.5);
    for (int c = 0; c < 3; c++)
        m.emission[c] = m.absorption[c];
    truth_fill(s, truth_box(0.6, -0.6, 0.6), &m);
    struct estimate e = truth_render(s, 24, 100);
    truth_check("isothermal", &e, 1.0, 0.0, 4e-3);
}

/* ---- T3, T6: slabs ------------------------------------------------------ */

static struct estimate lit_slab(const struct brume_globals *globals, double tau,
                                double albedo, double g, int spp)
{
    brume_scene *s = truth_scene(globals, 1.0, 1e-6);
    struct brume_medium m = truth_medium(1.0 - albedo, albedo, g);
    truth_fill(s, truth_box(3000.0, 0.0, tau), &m);
    add_distant_light(s, UNIT_LIGHT);
    return truth_render(s, 32, spp);
}

static void truths__single_scattering(void **state)
{
    (void)state;
    const double rows[][2] = {{0.01, 0.000787870},
                              {0.1, 0.007212474},
                              {1.0, 0.034403916},
                              {10.0, 0.039788736}};
    const int spp[] = {3000, 600, 100, 60};
    for (int i = 0; i < 4; i++) {
        struct estimate e = lit_slab(&single, rows[i][0], 1.0, 0.0, spp[i]);
        /* The ends of the thinnest slab are floats near 1. */
        truth_check("T3", &e, rows[i][1], 5e-10 + 1e-5 * rows[i][1], 1e-2);
    }
}

static void truths__slab_radiance(void **state)
{
    (void)state;
    struct brume_globals g = multiple_under(0.0);
    struct estimate e = lit_slab(&g, 1.0, 0.9, 0.0, 400);
    truth_check("T6, 1<-1", &e, 0.0668453, 5e-8, 4e-3);
}

/* Reciprocity turns total reflectance into the radiance that a uniform sky
 * of 1 gives: R + T at normal incidence. */
static void truths__slab_under_sky(void **state)
{
    (void)state;
    const struct {
        double albedo, g, tau, sum;
    } rows[] = {
        {0.9, 0.75, 2.0, 0.097395 + 0.660958},
        {0.5, 0.0, 1.0, 0.099119 + 0.446058},
        {0.99, -0.5, 8.0, 0.782153 + 0.077247},
        {0.9, 0.9, 8.0, 0.064554 + 0.266413},
    };
    for (int i = 0; i < 4; i++) {
        struct brume_globals g = multiple_under(1.0);
        brume_scene *s = truth_scene(&g, 1.0, 1e-6);
        struct brume_medium m = truth_medium(1.0 - rows[i].albedo,
                                             rows[i].albedo, rows[i].g);
        truth_fill(s, truth_box(3000.0, 0.0, rows[i].tau), &m);
        struct estimate e = truth_render(s, 32, 150);
        truth_check("T6, sky", &e, rows[i].sum, 1e-6, 4e-3);
    }
}

/* Each channel is another slab of the table: a path flies by one of them and
 * is weighed by all. */
static void truths__slab_of_three_colors(void **state)
{
    (void)state;
    const double tau[3] = {0.5, 2.0, 8.0}, albedo[3] = {0.5, 0.9, 0.99};
    const double sum[3] = {0.010438 + 0.757015, 0.097395 + 0.660958,
                           0.433048 + 0.416336};
    struct brume_globals g = multiple_under(1.0);
    brume_scene *s = truth_scene(&g, 1.0, 1e-6);
    struct brume_medium m = truth_medium(0.0, 0.0, 0.75);
    for (int c = 0; c < 3; c++) {
        m.absorption[c] = tau[c] * (1.0 - albedo[c]);
        m.scattering[c] = tau[c] * albedo[c];
    }
    truth_fill(s, truth_box(3000.0, 0.0, 1.0), &m);
    struct estimate e = truth_render(s, 32, 300);
    truth_check_colors("T6, colors", &e, sum, 1e-6, 4e-3);
}

/* A lamp in the middle of a white ball of optical radius 20: what it gives
 * comes out, but for what was not scattered; over the square around the ball
 * that is a mean of I / 4. Directions that are chosen by the lamp at each of
 * hundreds of vertices would leave a tenth of it. */
static void truths__lamp_in_a_deep_ball(void **state)
{
    (void)state;
    struct brume_globals globals = multiple_under(0.0);
    globals.physical_units = true;
    brume_scene *s = truth_scene(&globals, 100.0, 0.02);
    struct brume_medium m = truth_medium(0.0, 20.0, 0.0);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    struct brume_light l = BRUME_LIGHT_INIT;
    ball.kind = BRUME_SHAPE_SPHERE;
    ball.radius = 1.0;
    for (int c = 0; c < 3; c++)
        l.color[c] = 1.0 / TRUTH_PI;
    truth_fill(s, ball, &m);
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    struct estimate e = truth_render(s, 32, 256);
    assert_int_equal(e.stats.rejected, 0);
    assert_true(e.error[0] < 0.02);
    if (!(fabs(e.mean[0] - 0.25) < 0.05))
        fail_msg("a lamp in a ball: %.4g +- %.2g, truth 0.25", e.mean[0],
                 e.error[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truths__beer_lambert_depth),
        cmocka_unit_test(truths__beer_lambert_opacity),
        cmocka_unit_test(truths__beer_lambert_ends),
        cmocka_unit_test(truths__beer_lambert_trilinear),
        cmocka_unit_test(truths__emitting_absorber),
        cmocka_unit_test(truths__fire_of_total_brightness),
        cmocka_unit_test(truths__furnace_thin),
        cmocka_unit_test(truths__furnace_thick_forward),
        cmocka_unit_test(truths__furnace_with_surface),
        cmocka_unit_test(truths__furnace_isothermal),
        cmocka_unit_test(truths__single_scattering),
        cmocka_unit_test(truths__lamp_in_a_deep_ball),
        cmocka_unit_test(truths__slab_radiance),
        cmocka_unit_test(truths__slab_under_sky),
        cmocka_unit_test(truths__slab_of_three_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
