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
#include "lib/png.h"
#include "lib/ppm.h"
#include "lib/srgb.h"

enum { WIDTH = 19, HEIGHT = 7 };

static char path[] = "/tmp/brume-test-XXXXXX";
static float rgba[HEIGHT][WIDTH][4];

static const struct image_channel channels[] = {
    {"R", &rgba[0][0][0], 4, 4 * WIDTH},
    {"G", &rgba[0][0][1], 4, 4 * WIDTH},
    {"B", &rgba[0][0][2], 4, 4 * WIDTH},
    {"A", &rgba[0][0][3], 4, 4 * WIDTH},
};

static const struct image whole = {.width = WIDTH,
                                   .height = HEIGHT,
                                   .x1 = WIDTH,
                                   .y1 = HEIGHT,
                                   .channel = channels,
                                   .channels = 4};

static int set_up(void **state)
{
    (void)state;
    int fd = mkstemp(path);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            float *p = rgba[y][x];
            p[3] = (float)y / (HEIGHT - 1);
            p[0] = p[3] * (float)x / (WIDTH - 1);
            p[1] = p[3] * 0.5f;
            p[2] = p[3] * 2;
        }
    rgba[1][0][0] = NAN;
    rgba[1][1][0] = INFINITY;
    rgba[1][2][0] = -1;
    rgba[0][5][0] = 3; /* light at alpha 0                        */
    return fd < 0 ? -1 : close(fd);
}

static int tear_down(void **state)
{
    (void)state;
    return unlink(path);
}

static void test_srgb__follows_the_standard(void **state)
{
    (void)state;
    for (int i = 0; i <= 100000; i++) {
        double v = i / 100000.0;
        double truth = v <= 0.0031308 ? 12.92 * v
                                      : 1.055 * pow(v, 1 / 2.4) - 0.055;
        assert_true(fabs(srgb_encode(v) - truth) < 1e-15);
    }
    assert_int_equal(srgb_code(0, 255), 0);
    assert_int_equal(srgb_code(1, 255), 255);
    assert_int_equal(srgb_code(1, 65535), 65535);
    assert_int_equal(srgb_code(0.5f, 255), 188);
    assert_int_equal(srgb_code(0.18f, 255), 118);
    assert_int_equal(srgb_code(0.002f, 255), 7);
    assert_int_equal(srgb_code(NAN, 255), 0);
    assert_int_equal(srgb_code(-1, 255), 0);
    assert_int_equal(srgb_code(-INFINITY, 255), 0);
    assert_int_equal(srgb_code(INFINITY, 255), 255);
    assert_int_equal(srgb_linear_code(0.5f, 255), 128);
}

static struct raster *save_and_load(const struct image *image, int bits,
                                    bool alpha)
{
    struct brume_error err = {0};
    if (!png_save(path, image, bits, alpha, &err))
        fail_msg("%s", err.text);
    struct raster *p = png_load(path, &err);
    if (!p)
        fail_msg("%s", err.text);
    assert_int_equal(p->max, bits == 8 ? 255 : 65535);
    assert_int_equal(p->channels, alpha ? 4 : 3);
    assert_int_equal(p->intent, 1);
    return p;
}

static void test_png__colours_take_the_curve(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        unsigned max = bits == 8 ? 255 : 65535;
        struct raster *p = save_and_load(&whole, bits, false);
        assert_int_equal(p->width, WIDTH);
        assert_int_equal(p->height, HEIGHT);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            for (int c = 0; c < 3; c++)
                assert_int_equal(p->sample[3 * i + c],
                                 srgb_code((&rgba[0][0][0])[4 * i + c], max));
        raster_free(p);
    }
}

static void test_png__alpha_is_unassociated(void **state)
{
    (void)state;
    struct raster *p = save_and_load(&whole, 16, true);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 3; x < WIDTH; x++) {
            const uint16_t *s = p->sample + 4 * (y * WIDTH + x);
            unsigned red = srgb_code((float)x / (WIDTH - 1), 65535);
            unsigned green = srgb_code(0.5f, 65535);
            assert_in_range(s[0], y ? red - !!red : 0, y ? red + 1 : 0);
            assert_in_range(s[1], y ? green - 1 : 0, y ? green + 1 : 0);
            assert_int_equal(s[2], y ? 65535 : 0);
            assert_int_equal(s[3], srgb_linear_code(rgba[y][x][3], 65535));
        }
    raster_free(p);
}

static void test_png__region_keeps_the_full_size(void **state)
{
    (void)state;
    struct image image = whole;
    image.width = 30;
    image.height = 20;
    image.x0 = 3;
    image.x1 = 3 + WIDTH;
    image.y0 = 11;
    image.y1 = 11 + HEIGHT;
    struct raster *p = save_and_load(&image, 8, false);
    assert_int_equal(p->width, 30);
    assert_int_equal(p->height, 20);
    assert_int_equal(p->sample[3 * (17 * 30 + 2) + 2], 0);
    assert_int_equal(p->sample[3 * (17 * 30 + 3) + 2], 255);
    assert_int_equal(p->sample[3 * (17 * 30 + 21) + 2], 255);
    assert_int_equal(p->sample[3 * (17 * 30 + 22) + 2], 0);
    assert_int_equal(p->sample[3 * (18 * 30 + 3) + 2], 0);
    raster_free(p);
}

static unsigned char bytes[1 << 16], broken[1 << 16];

static size_t read_bytes(void)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    size_t n = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    return n;
}

static bool load_bytes(const unsigned char *from, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(from, 1, size, f), size);
    fclose(f);
    struct brume_error err = {0};
    struct raster *p = png_load(path, &err);
    raster_free(p);
    assert_true(p || err.code == BRUME_ERR_FILE);
    assert_true(p || strstr(err.text, path));
    return p != NULL;
}

static void test_png__broken_files_are_errors(void **state)
{
    (void)state;
    raster_free(save_and_load(&whole, 8, true));
    size_t n = read_bytes();
    for (size_t cut = 0; cut < n; cut += n / 40)
        assert_false(load_bytes(bytes, cut));
    for (size_t i = 0; i < n; i++) {
        memcpy(broken, bytes, n);
        broken[i] ^= (unsigned char)(1 << i % 8);
        load_bytes(broken, n);
    }
}

static void test_png__errors_name_the_file(void **state)
{
    (void)state;
    struct brume_error err = {0};
    assert_null(png_load("/no/such.png", &err));
    assert_non_null(strstr(err.text, "/no/such.png"));
    err = (struct brume_error){0};
    assert_false(png_save("/no/such.png", &whole, 8, false, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    err = (struct brume_error){0};
    assert_false(png_save(path, &whole, 12, false, &err));
    assert_int_equal(err.code, BRUME_ERR_USAGE);
    struct image grey = whole;
    grey.channels = 1;
    err = (struct brume_error){0};
    assert_false(png_save(path, &grey, 8, false, &err));
    assert_int_equal(err.code, BRUME_ERR_USAGE);
    if (access("/dev/full", W_OK) != 0)
        return;
    err = (struct brume_error){0};
    assert_false(png_save("/dev/full", &whole, 8, false, &err));
    assert_non_null(strstr(err.text, "No space left"));
    err = (struct brume_error){0};
    assert_false(ppm_save("/dev/full", &whole, 8, &err));
    assert_non_null(strstr(err.text, "No space left"));
}

static void test_ppm__is_the_plain_format(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8) {
        static const char *const heads[] = {
            "P6\n# Software: Brume\n19 7\n255\n",
            "P6\n# Software: Brume\n19 7\n65535\n",
        };
        const char *head = heads[bits == 16];
        size_t width = (size_t)bits / 8, at = strlen(head);
        assert_true(ppm_save(path, &whole, bits, NULL));
        assert_int_equal(read_bytes(), at + WIDTH * HEIGHT * 3 * width);
        assert_memory_equal(bytes, head, at);
        at += ((HEIGHT - 1) * WIDTH + 9) * 3 * width;
        unsigned code = srgb_code(0.5f, bits == 16 ? 65535 : 255);
        assert_int_equal(bytes[at], bits == 16 ? code >> 8 : code);
        if (bits == 16)
            assert_int_equal(bytes[at + 1], code & 255);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_srgb__follows_the_standard),
        cmocka_unit_test(test_png__colours_take_the_curve),
        cmocka_unit_test(test_png__alpha_is_unassociated),
        cmocka_unit_test(test_png__region_keeps_the_full_size),
        cmocka_unit_test(test_png__broken_files_are_errors),
        cmocka_unit_test(test_png__errors_name_the_file),
        cmocka_unit_test(test_ppm__is_the_plain_format),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
