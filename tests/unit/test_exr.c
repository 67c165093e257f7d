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
#include "lib/exr.h"

enum { WIDTH = 37, HEIGHT = 355 }; /* neither is whole blocks of 16   */

static char path[] = "/tmp/brume-test-XXXXXX";
static float rgba[HEIGHT][WIDTH][4];
static float depth[HEIGHT][WIDTH];

static int set_up(void **state)
{
    (void)state;
    int fd = mkstemp(path);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            for (int c = 0; c < 4; c++)
                rgba[y][x][c] = 0.1f * (float)x + 10.0f * (float)y +
                                1e-3f * (float)c;
            depth[y][x] = 1e6f + (float)(x * y);
        }
    rgba[3][4][0] = NAN;
    rgba[3][5][0] = INFINITY;
    rgba[3][6][0] = -2;
    return fd < 0 ? -1 : close(fd);
}

static int tear_down(void **state)
{
    (void)state;
    return unlink(path);
}

static const struct image_channel channels[] = {
    {"R", &rgba[0][0][0], 4, 4 * WIDTH}, {"G", &rgba[0][0][1], 4, 4 * WIDTH},
    {"B", &rgba[0][0][2], 4, 4 * WIDTH}, {"A", &rgba[0][0][3], 4, 4 * WIDTH},
    {"Z", &depth[0][0], 1, WIDTH},
};

static struct image whole(void)
{
    struct image image = {.width = WIDTH,
                          .height = HEIGHT,
                          .x1 = WIDTH,
                          .y1 = HEIGHT,
                          .channel = channels,
                          .channels = 5};
    return image;
}

static struct exr_picture *save_and_load(const struct image *image, int threads)
{
    static const struct exr_text text[] = {{"software", "Brume"}};
    struct brume_error err = {0};
    if (!exr_save(path, image, text, 1, threads, &err))
        fail_msg("%s", err.text);
    struct exr_picture *p = exr_load(path, &err);
    if (!p)
        fail_msg("%s", err.text);
    return p;
}

static bool same(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void test_exr__round_trip_is_exact(void **state)
{
    (void)state;
    struct image image = whole();
    struct exr_picture *p = save_and_load(&image, 1);
    assert_int_equal(p->width, WIDTH);
    assert_int_equal(p->height, HEIGHT);
    assert_int_equal(p->full_width, WIDTH);
    assert_int_equal(p->channels, 5);
    static const char *const names[] = {"R", "G", "B", "A"};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int c = 0; c < 4; c++)
            assert_true(
                same(exr_plane(p, names[c])[i], (&rgba[0][0][0])[4 * i + c]));
        assert_true(same(exr_plane(p, "Z")[i], (&depth[0][0])[i]));
    }
    assert_null(exr_plane(p, "none"));
    exr_free(p);
}

static void test_exr__region_keeps_the_full_size(void **state)
{
    (void)state;
    struct image image = whole();
    image.width = 50;
    image.height = HEIGHT + 25;
    image.x0 = 5;
    image.y0 = 14;
    image.x1 = 5 + WIDTH;
    image.y1 = 14 + HEIGHT;
    struct exr_picture *p = save_and_load(&image, 1);
    assert_int_equal(p->width, 50);
    assert_int_equal(p->height, HEIGHT + 25);
    const float *green = exr_plane(p, "G");
    for (int y = 0; y < HEIGHT + 25; y++)
        for (int x = 0; x < 50; x++) {
            bool in = x >= 5 && x < 5 + WIDTH && y >= 14 && y < 14 + HEIGHT;
            assert_true(green[y * 50 + x] == (in ? rgba[y - 14][x - 5][1] : 0));
        }
    exr_free(p);
}

static size_t read_bytes(unsigned char *bytes, size_t size)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    size_t n = fread(bytes, 1, size, f);
    fclose(f);
    return n;
}

static void write_bytes(const unsigned char *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
}

static unsigned char first[1 << 19], second[1 << 19];

/* However many threads pack blocks. */
static void test_exr__bytes_are_repeatable(void **state)
{
    (void)state;
    struct image image = whole();
    exr_free(save_and_load(&image, 1));
    size_t n = read_bytes(first, sizeof first);
    for (int threads = 0; threads < 4; threads++) {
        exr_free(save_and_load(&image, threads));
        assert_int_equal(read_bytes(second, sizeof second), n);
        assert_memory_equal(first, second, n);
    }
}

static void test_exr__broken_files_are_errors(void **state)
{
    (void)state;
    struct image image = whole();
    exr_free(save_and_load(&image, 1));
    size_t n = read_bytes(first, sizeof first);
    for (size_t cut = 0; cut < n; cut += n / 40) {
        struct brume_error err = {0};
        write_bytes(first, cut);
        assert_null(exr_load(path, &err));
        assert_int_equal(err.code, BRUME_ERR_FILE);
        assert_non_null(strstr(err.text, path));
    }
    uint32_t random = 1;
    for (int i = 0; i < 400; i++) {
        memcpy(second, first, n);
        random = random * 1664525 + 1013904223;
        second[(random >> 8) % (i % 2 ? n : 600)] ^= (unsigned char)(1
                                                                     << i % 8);
        write_bytes(second, n);
        struct brume_error err = {0};
        struct exr_picture *p = exr_load(path, &err);
        assert_true(p || err.code != BRUME_OK);
        exr_free(p);
    }
}

static void test_exr__errors_name_the_file(void **state)
{
    (void)state;
    struct image image = whole();
    struct brume_error err = {0};
    assert_null(exr_load("/no/such.exr", &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    assert_non_null(strstr(err.text, "/no/such.exr"));
    err = (struct brume_error){0};
    assert_false(exr_save("/no/such.exr", &image, NULL, 0, 1, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    err = (struct brume_error){0};
    image.x1 = WIDTH + 1;
    assert_false(exr_save(path, &image, NULL, 0, 1, &err));
    assert_int_equal(err.code, BRUME_ERR_USAGE);
}

/* Two files of OpenEXR's C++ library: a ramp whose pixel (x, y) is
 * (x, y, x + y), in PIZ tiles of halves with smaller levels, and one of
 * integers beside floats. */
static void test_exr__reads_tiles_halves_and_integers(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct exr_picture *p = exr_load("tests/data/tiled_half.exr", &err);
    if (!p)
        fail_msg("%s", err.text);
    assert_int_equal(p->width, 40);
    assert_int_equal(p->height, 23);
    for (int y = 0; y < 23; y++)
        for (int x = 0; x < 40; x++) {
            assert_true(exr_plane(p, "R")[40 * y + x] == (float)x);
            assert_true(exr_plane(p, "G")[40 * y + x] == (float)y);
            assert_true(exr_plane(p, "B")[40 * y + x] == (float)(x + y));
        }
    exr_free(p);
    p = exr_load("tests/data/uint.exr", &err);
    if (!p)
        fail_msg("%s", err.text);
    assert_true(exr_plane(p, "id")[0] == 7);
    assert_true(exr_plane(p, "id")[7] == 4000000000.0f);
    assert_true(exr_plane(p, "R")[7] == 0.5f);
    exr_free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exr__round_trip_is_exact),
        cmocka_unit_test(test_exr__region_keeps_the_full_size),
        cmocka_unit_test(test_exr__bytes_are_repeatable),
        cmocka_unit_test(test_exr__broken_files_are_errors),
        cmocka_unit_test(test_exr__errors_name_the_file),
        cmocka_unit_test(test_exr__reads_tiles_halves_and_integers),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
