/* More of the extremes of METHODS.md, section 12: cells of nothing, bricks far
 * down a list, surfaces that shade themselves. */
#include <string.h>
#include "tests/unit/truth.h"
#include "core/physics/grid.h"

static void check_near(const char *what, double got, double truth, double most)
{
    if (!(fabs(got - truth) <= most * fabs(truth)))
        fail_msg("%s: %.9g, truth %.9g", what, got, truth);
}

/* A flight that crosses cells of majorant 0 collides behind them: the last
 * brick has the plane albedo of a half-space (METHODS.md 13.8). */
static void extremes_cells__behind_nothing(void **state)
{
    (void)state;
    const int32_t origin[3] = {0, 0, 0}, size[3] = {1, 1, 4};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    globals.media_multiple = globals.environment = true;
    for (int i = 0; i < 3; i++)
        globals.background[i] = 1.0;
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct grid *g = grid_new(origin, size, 0.0f, truth_error());
    assert_non_null(g);
    float *v = grid_brick(g, 0, 0, 3, truth_error());
    assert_non_null(v);
    for (int i = 0; i < 512; i++)
        v[i] = 1.0f;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            g->to_world[i][j] = i == j ? 1.0 : j == 3 && i < 2 ? -4.0 : 0.0;
    grid_finish(g);
    struct brume_field f = BRUME_FIELD_INIT;
    f.kind = BRUME_FIELD_GRID;
    f.grid = brume_add_grid(s, g, truth_error());
    grid_free(g);
    struct brume_medium m = truth_medium(1e1, 9e1, 0.0);
    m.density[0] = brume_add_field(s, &f, truth_error());
    m.densities = 1;
    truth_fill(s, truth_box(4.0, 0.0, 32.0), &m);
    struct estimate e = truth_render(s, 8, 64);
    assert_int_equal(e.stats.majorant_exceeded, 0);
    check_near("albedo behind nothing", e.mean[0], 0.4149475,
               4 * 0.5 / 64 / 0.4149475);
}

/* A brick whose floats lie beyond what 32 bits count. */
static void extremes_cells__far_bricks(void **state)
{
    (void)state;
    const uint64_t before = 20000000; /* bricks: 1.5e10 floats */
    static float brick[BRICK_FLOATS];
    const float tile = 0.0f;
    const int32_t slot = 0;
    for (int i = 0; i < BRICK_FLOATS; i++)
        brick[i] = (float)i;
    flat_grid g = {.bricks = {1, 1, 1}, .brick = before, .nearest = 1};
    flat_scene s = {.slots = &slot, .tiles = &tile};
    uintptr_t base = (uintptr_t)brick - before * sizeof brick;
    memcpy(&s.voxels, &base, sizeof s.voxels);
    assert_true(grid_lookup(&s, &g, vec3_make(3.0f, 2.0f, 1.0f)) ==
                81.0f + 18.0f + 3.0f);
}

/* Mean light of the middle of a white ball, `away` from the origin, that a lamp
 * beside the eye lights. */
static double ball_light(double size, double away, bool shadows)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 1.0, 0.3);
    struct brume_camera c = BRUME_CAMERA_INIT;
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_material white = BRUME_MATERIAL_INIT;
    struct brume_shape ball = BRUME_SHAPE_INIT;
    for (int k = 0; k < 3; k++) {
        ball.a[k] = away * (k + 1);
        c.location[k] = ball.a[k] - (k == 2 ? 3.0 * size : 0.0);
        l.location[k] = ball.a[k] + (k == 2 ? -1e3 : 300.0) * size;
        white.color[0][k] = 1.0;
    }
    c.right[0] = c.up[1] = 0.3;
    l.shadows = shadows;
    ball.radius = size;
    ball.material = brume_add_material(s, &white, truth_error());
    assert_true(brume_add_shape(s, &ball, truth_error()) >= 0);
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    assert_true(brume_set_camera(s, &c, truth_error()));
    return truth_render(s, 32, 4).mean[0];
}

/* No point of it shades itself, wherever it is and however large. */
static void extremes_cells__surfaces_hit_again(void **state)
{
    (void)state;
    const double rows[][2] = {{1, 0}, {1e-3, 1}, {0.3, 30}, {1e4, 7e4}};
    for (int i = 0; i < 4; i++) {
        double light = ball_light(rows[i][0], rows[i][1], false);
        assert_true(light > 0.1);
        check_near("light on a ball", ball_light(rows[i][0], rows[i][1], true),
                   light, 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extremes_cells__behind_nothing),
        cmocka_unit_test(extremes_cells__far_bricks),
        cmocka_unit_test(extremes_cells__surfaces_hit_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
