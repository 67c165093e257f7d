#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "lib/grid.h"

static const int32_t origin[3] = {-8, 0, 16};
static const int32_t bricks[3] = {3, 2, 2};

static struct grid *make(float background)
{
    struct brume_error err = {0};
    struct grid *g = grid_new(origin, bricks, background, &err);
    assert_non_null(g);
    return g;
}

static float *brick(struct grid *g, int x, int y, int z)
{
    struct brume_error err = {0};
    float *voxel = grid_brick(g, x, y, z, &err);
    assert_non_null(voxel);
    return voxel;
}

static void test_grid__empty_is_background(void **state)
{
    (void)state;
    struct grid *g = make(0.25f);
    assert_true(grid_sample(g, 0, 0, 16) == 0.25f);
    assert_true(grid_sample(g, -1000, 0, 16) == 0.25f);
    assert_true(grid_sample(g, INT32_MAX, INT32_MIN, 0) == 0.25f);
    grid_finish(g);
    assert_int_equal(g->stored, 0);
    assert_int_equal(g->tiles, 1);
    assert_true(g->lowest == 0.25f && g->highest == 0.25f);
    grid_free(g);
}

static void test_grid__samples_where_they_were_put(void **state)
{
    (void)state;
    struct grid *g = make(0);
    float *voxel = brick(g, 2, 1, 1);
    voxel[3 + 8 * (5 + 8 * 7)] = 2;
    assert_true(grid_sample(g, -8 + 16 + 3, 8 + 5, 16 + 8 + 7) == 2);
    assert_true(grid_sample(g, -8 + 16 + 4, 8 + 5, 16 + 8 + 7) == 0);
    assert_ptr_equal(brick(g, 2, 1, 1), voxel);
    grid_free(g);
}

static void test_grid__brick_of_a_tile_has_its_value(void **state)
{
    (void)state;
    struct grid *g = make(0);
    assert_true(grid_set_tile(g, 1, 0, 0, 3, NULL));
    assert_true(grid_sample(g, 0, 0, 16) == 3);
    float *voxel = brick(g, 1, 0, 0);
    assert_true(voxel[0] == 3 && voxel[511] == 3);
    grid_free(g);
}

static void test_grid__finish_cleans_and_counts(void **state)
{
    (void)state;
    struct grid *g = make(0);
    float *voxel = brick(g, 0, 0, 0);
    voxel[0] = NAN;
    voxel[1] = -INFINITY;
    voxel[2] = INFINITY;
    voxel[3] = -1;
    voxel[4] = 5;
    assert_true(grid_set_tile(g, 1, 1, 1, -2, NULL));
    grid_finish(g);
    assert_int_equal(g->bad_nan, 1);
    assert_int_equal(g->bad_inf, 2);
    assert_int_equal(g->bad_negative, 1 + 512);
    assert_true(grid_sample(g, -8, 0, 16) == 0);
    assert_true(grid_sample(g, -5, 0, 16) == 0);
    assert_true(grid_sample(g, -4, 0, 16) == 5);
    assert_true(grid_sample(g, 0, 8, 24) == 0);
    assert_true(g->lowest == 0 && g->highest == 5);
    assert_int_equal(g->tiles, 1);
    grid_free(g);
}

static void test_grid__finish_merges_constants(void **state)
{
    (void)state;
    struct grid *g = make(1);
    for (int i = 0; i < 512; i++) {
        brick(g, 0, 0, 0)[i] = 7;        /* constant: becomes a tile    */
        brick(g, 1, 0, 0)[i] = (float)i; /* stays                       */
        brick(g, 2, 0, 0)[i] = 1;        /* equal to the background     */
    }
    assert_true(grid_set_tile(g, 0, 1, 0, 4, NULL));
    assert_true(grid_set_tile(g, 1, 1, 0, 7, NULL));
    assert_true(grid_set_tile(g, 2, 1, 0, 4, NULL));
    assert_true(grid_set_tile(g, 2, 1, 1, 900, NULL));
    assert_true(grid_set_tile(g, 2, 1, 1, 1, NULL)); /* 900 is unused   */
    grid_finish(g);
    assert_int_equal(g->stored, 1);
    assert_int_equal(g->tiles, 3);
    assert_true(g->tile[0] == 1 && g->tile[1] == 4 && g->tile[2] == 7);
    assert_true(g->lowest == 0 && g->highest == 511);
    assert_true(grid_sample(g, -8, 0, 16) == 7);
    assert_true(grid_sample(g, 0, 8, 16) == 7);
    assert_true(grid_sample(g, -8, 8, 16) == 4);
    assert_true(grid_sample(g, 8, 0, 16) == 1);
    assert_true(grid_sample(g, 7, 7, 23) == 511);
    /* A finished grid can still be added to. */
    brick(g, 0, 1, 1)[9] = 3;
    brick(g, 1, 1, 1)[9] = 3;
    assert_true(grid_sample(g, 7, 7, 23) == 511);
    grid_free(g);
}

/* A copy of a grid without stored bricks grows like any other. */
static void test_grid__copy_is_independent(void **state)
{
    (void)state;
    struct grid *g = make(2);
    grid_finish(g);
    struct grid *copy = grid_copy(g, NULL);
    assert_non_null(copy);
    for (int i = 0; i < 3; i++)
        brick(copy, i, 0, 0)[i] = 9;
    assert_true(grid_sample(copy, 1, 0, 16) == 9);
    assert_true(grid_sample(g, 1, 0, 16) == 2);
    grid_free(copy);
    grid_free(g);
}

static void test_grid__absurd_extents_are_refused(void **state)
{
    (void)state;
    static const int32_t wrong[][6] = {
        {0, 0, 0, 1 << 20, 1 << 20, 1 << 20},
        {0, 0, 0, 1024, 1024, 257},
        {0, 0, 0, INT32_MAX, 1, 1},
        {0, 0, 0, 0, 1, 1},
        {0, 0, 0, 1, -1, 1},
        {3, 0, 0, 1, 1, 1},
        {INT32_MAX - 7, 0, 0, 2, 1, 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct brume_error err = {0};
        assert_null(grid_new(wrong[i], wrong[i] + 3, 0, &err));
        assert_int_equal(err.code, BRUME_ERR_LIMIT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid__empty_is_background),
        cmocka_unit_test(test_grid__samples_where_they_were_put),
        cmocka_unit_test(test_grid__brick_of_a_tile_has_its_value),
        cmocka_unit_test(test_grid__finish_cleans_and_counts),
        cmocka_unit_test(test_grid__finish_merges_constants),
        cmocka_unit_test(test_grid__copy_is_independent),
        cmocka_unit_test(test_grid__absurd_extents_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
