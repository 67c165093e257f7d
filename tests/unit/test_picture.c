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
#include "parser/picture.h"
#include "tests/unit/temp_folder.h"

/* Two pixels by one: half-covered white, and a clear one. */
static float radiance[6] = {0.5f, 0.5f, 0.5f, 0, 0, 0};
static float opacity[6] = {0.5f, 0.5f, 0.5f, 0, 0, 0};
static float depth[2] = {3, INFINITY};
static const struct brume_frame frame = {
    .width = 2,
    .height = 1,
    .radiance = radiance,
    .opacity = opacity,
    .depth = depth,
};

static void write_picture(enum options_format format, int bits, bool alpha,
                          const char *path, FILE *out)
{
    struct exr_text text = {"scene", "s.pov"};
    struct picture picture = {&frame, format, bits, alpha, &text, 1, 1};
    struct brume_error err = {0};
    assert_true(picture_write(&picture, path, out, &err));
}

static void assert_plane(const struct exr_picture *exr, const char *name,
                         float a, float b)
{
    const float *plane = exr_plane(exr, name);
    assert_non_null(plane);
    assert_true(plane[0] == a && plane[1] == b);
}

static void test_picture__exr(void **state)
{
    (void)state;
    struct brume_error err = {0};
    write_picture(OPTIONS_FORMAT_EXR, 8, false, "a.exr", NULL);
    struct exr_picture *exr = exr_load("a.exr", &err);
    assert_non_null(exr);
    assert_int_equal(exr->channels, 7);
    assert_plane(exr, "R", 0.5f, 0);
    assert_plane(exr, "opacity.B", 0.5f, 0);
    assert_plane(exr, "Z", 3, INFINITY);
    assert_null(exr_plane(exr, "A"));
    exr_free(exr);
}

static void test_picture__exr_alpha(void **state)
{
    (void)state;
    struct brume_error err = {0};
    opacity[0] = 0.25f;
    write_picture(OPTIONS_FORMAT_EXR, 8, true, "b.exr", NULL);
    opacity[0] = 0.5f;
    struct exr_picture *exr = exr_load("b.exr", &err);
    assert_non_null(exr);
    const float *a = exr_plane(exr, "A");
    assert_non_null(a);
    assert_true(fabsf(a[0] - (0.5f - 0.25f * 0.2126f)) < 1e-6f);
    assert_true(a[1] == 0);
    assert_plane(exr, "G", 0.5f, 0);
    exr_free(exr);
}

static void assert_png(const char *path, int channels, int bits,
                       const uint16_t *sample)
{
    struct brume_error err = {0};
    struct raster *png = png_load(path, &err);
    assert_non_null(png);
    assert_int_equal(png->channels, channels);
    assert_int_equal(png->max, bits == 8 ? 255 : 65535);
    for (int i = 0; i < 2 * channels; i++)
        assert_int_equal(png->sample[i], sample[i]);
    raster_free(png);
}

/* sRGB of linear 0.5 is 188 of 255, 48192 of 65535. */
static void test_picture__png(void **state)
{
    (void)state;
    write_picture(OPTIONS_FORMAT_PNG, 8, false, "a.png", NULL);
    assert_png("a.png", 3, 8, (uint16_t[]){188, 188, 188, 0, 0, 0});
    write_picture(OPTIONS_FORMAT_PNG, 9, false, "b.png", NULL);
    assert_png("b.png", 3, 16, (uint16_t[]){48192, 48192, 48192, 0, 0, 0});
    write_picture(OPTIONS_FORMAT_PNG, 5, true, "c.png", NULL);
    assert_png("c.png", 4, 8, (uint16_t[]){255, 255, 255, 128, 0, 0, 0, 0});
}

/* What a format writes into a stream is what it writes into a file. */
static void test_picture__stream(void **state)
{
    (void)state;
    static const char *const names[] = {"s.png", "s.exr", "s.ppm"};
    for (int format = 0; format < 3; format++) {
        char a[4096], b[4096];
        FILE *out = fopen("stream", "w+b");
        assert_non_null(out);
        write_picture(format, 8, false, "-", out);
        write_picture(format, 8, false, names[format], NULL);
        FILE *file = fopen(names[format], "rb");
        assert_non_null(file);
        rewind(out);
        size_t length = fread(a, 1, sizeof a, out);
        assert_int_equal(fread(b, 1, sizeof b, file), length);
        assert_true(length > 0 && length < sizeof a);
        assert_memory_equal(a, b, length);
        fclose(out);
        fclose(file);
    }
}

static void test_picture__full_stream(void **state)
{
    (void)state;
    for (int format = 0; format < 3; format++) {
        struct picture picture = {.frame = &frame, .format = format, .bits = 8};
        struct brume_error err = {0};
        FILE *out = fopen("/dev/full", "wb");
        assert_non_null(out);
        assert_false(picture_write(&picture, "-", out, &err));
        assert_int_equal(err.code, BRUME_ERR_FILE);
        fclose(out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_picture__exr),
        cmocka_unit_test(test_picture__exr_alpha),
        cmocka_unit_test(test_picture__png),
        cmocka_unit_test(test_picture__stream),
        cmocka_unit_test(test_picture__full_stream),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
