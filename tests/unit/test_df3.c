#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "lib/df3.h"
#include "tests/unit/temp_file.h"

static void put(FILE *f, uint32_t value, int bytes)
{
    while (bytes-- > 0)
        fputc((int)(value >> 8 * bytes & 255), f);
}

/* Sample (x, y, z) is 1 + x + 10 y + 100 z of the largest integer's 1000. */
static uint32_t truth(int x, int y, int z, uint32_t largest)
{
    return (uint32_t)((1 + x + 10 * y + 100 * z) * (largest / 1000.0));
}

static void write_file(int nx, int ny, int nz, int bytes, uint32_t largest)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    put(f, (uint32_t)nx, 2);
    put(f, (uint32_t)ny, 2);
    put(f, (uint32_t)nz, 2);
    for (int z = 0; z < nz; z++)
        for (int y = 0; y < ny; y++)
            for (int x = 0; x < nx; x++)
                put(f, truth(x, y, z, largest), bytes);
    fclose(f);
}

static int clamp(int i, int n)
{
    return i < 0 ? 0 : i < n ? i : n - 1;
}

static void check_grid(int nx, int ny, int nz, int bytes, uint32_t largest)
{
    struct brume_error err = {0};
    write_file(nx, ny, nz, bytes, largest);
    struct grid *g = df3_load(path, GRID_TRILINEAR, &err);
    if (!g)
        fail_msg("%s", err.text);
    for (int z = -1; z <= nz; z++)
        for (int y = -1; y <= ny; y++)
            for (int x = -1; x <= nx; x++) {
                double v = truth(clamp(x, nx), clamp(y, ny), clamp(z, nz),
                                 largest) /
                           (double)largest;
                assert_true(grid_sample(g, x, y, z) == (float)v);
            }
    assert_true(grid_sample(g, -2, 0, 0) == 0);
    assert_true(grid_sample(g, nx + 1, 0, 0) == 0);
    assert_true(g->clip);
    /* POV-Ray's place of a sample: i / n, when it interpolates. */
    assert_true(g->clip_min[0] == 0 && g->clip_max[1] == ny);
    assert_true(fabs(g->to_world[2][2] * nz - 1) < 1e-15);
    assert_true(g->to_world[2][3] == 0);
    assert_true(g->to_world[0][1] == 0);
    grid_free(g);
}

static void test_df3__all_widths(void **state)
{
    (void)state;
    check_grid(9, 5, 3, 1, UINT8_MAX);
    check_grid(8, 7, 9, 2, UINT16_MAX);
    check_grid(7, 8, 6, 4, UINT32_MAX);
    check_grid(1, 1, 1, 1, UINT8_MAX);
    check_grid(17, 1, 1, 2, UINT16_MAX);
}

static void test_df3__full_scale_is_one(void **state)
{
    (void)state;
    for (int bytes = 1; bytes <= 4; bytes *= 2) {
        FILE *f = fopen(path, "wb");
        for (int i = 0; i < 3; i++)
            put(f, 1, 2);
        put(f, UINT32_MAX, bytes);
        fclose(f);
        struct grid *g = df3_load(path, GRID_NEAREST, NULL);
        assert_non_null(g);
        assert_true(grid_sample(g, 0, 0, 0) == 1);
        assert_int_equal(g->filter, GRID_NEAREST);
        assert_true(g->clip_min[0] == -0.5 && g->clip_max[1] == 0.5);
        assert_true(g->to_world[2][3] == 0.5);
        grid_free(g);
    }
}

static void refused(const char *word)
{
    struct brume_error err = {0};
    assert_null(df3_load(path, GRID_TRILINEAR, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
    assert_non_null(strstr(err.text, path));
}

static void test_df3__wrong_sizes_are_named(void **state)
{
    (void)state;
    write_file(4, 4, 4, 2, UINT16_MAX);
    assert_int_equal(truncate(path, 6 + 127), 0);
    refused("this has 133");
    refused("70, 134 or 262 bytes");
    assert_int_equal(truncate(path, 5), 0);
    refused("it has 5 bytes");
    assert_int_equal(truncate(path, 0), 0);
    refused("it has 0 bytes");
    write_file(0, 4, 4, 2, UINT16_MAX);
    refused("0 x 4 x 4");
    /* A header that promises 2^48 samples asks for no memory. */
    FILE *f = fopen(path, "wb");
    put(f, UINT32_MAX, 4);
    put(f, UINT32_MAX, 4);
    fclose(f);
    refused("65535 x 65535 x 65535");
    struct brume_error err = {0};
    assert_null(df3_load("/no/such.df3", GRID_NEAREST, &err));
    assert_non_null(strstr(err.text, "No such file"));
    err = (struct brume_error){0};
    assert_null(df3_load("/tmp", GRID_NEAREST, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_df3__all_widths),
        cmocka_unit_test(test_df3__full_scale_is_one),
        cmocka_unit_test(test_df3__wrong_sizes_are_named),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
