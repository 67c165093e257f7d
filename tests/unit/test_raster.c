/* test_raster.c - pictures from PNG, PNM, Targa, GIF and JPEG files, whole and
 * broken. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "lib/raster.h"
#include "tests/unit/temp_file.h"

static struct raster *load(const char *format, const void *bytes, size_t size,
                           struct brume_error *err)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
    *err = (struct brume_error){0};
    return raster_load(format, path, err);
}

static void check(const char *format, const void *bytes, size_t size,
                  int channels, unsigned max, const uint16_t *sample)
{
    struct brume_error err;
    struct raster *raster = load(format, bytes, size, &err);
    if (!raster)
        fail_msg("%s", err.text);
    assert_int_equal(raster->width, 3);
    assert_int_equal(raster->height, 2);
    assert_int_equal(raster->channels, channels);
    assert_int_equal(raster->max, max);
    assert_memory_equal(raster->sample, sample,
                        6 * (size_t)channels * sizeof *sample);
    raster_free(raster);
}

#define TEXT(text) text, sizeof(text) - 1
#define BYTES(array) array, sizeof(array)
#define CHECK(format, bytes, channels, max, ...)                               \
    check(format, bytes, channels, max, (const uint16_t[]){__VA_ARGS__})

static void test_pnm__kinds(void **state)
{
    (void)state;
    CHECK("pgm", TEXT("P5\n3 2\n255\n\1\2\3\4\5\377"), 1, 255, 1, 2, 3, 4, 5,
          255);
    CHECK("pgm", TEXT("P5 3 2 1000\n\1\2\0\0\3\350\0\5\0\6\377\377"), 1, 1000,
          258, 0, 1000, 5, 6, 1000);
    CHECK("pgm", TEXT("P2#\n# a 9\n3\t2 # b\r\n7\n0 1 2 3 # 4\n 5 7"), 1, 7, 0,
          1, 2, 3, 5, 7);
    CHECK("ppm", TEXT("P6\n3 2\n255\nabcdefghijklmnopqr"), 3, 255, 'a', 'b',
          'c', 'd', 'e', 'f', 'g', 'h', 'i', 'j', 'k', 'l', 'm', 'n', 'o', 'p',
          'q', 'r');
    CHECK("ppm", TEXT("P3 3 2 9 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9"), 3, 9, 1,
          2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9);
}

static const unsigned char colors[18 + 18] = {
    [2] = 2, [12] = 3, [14] = 2, [16] = 24, 0,  3,  2,  1,  6,  5,  4, 9,
    8,       7,        12,       11,        10, 15, 14, 13, 18, 17, 16};
static const unsigned char greys[18 + 6] = {
    [2] = 3, [12] = 3, [14] = 2, [16] = 8, 0x30, 1, 2, 3, 4, 5, 6};
static const unsigned char runs[18 + 5 + 9] = {
    [2] = 10, [12] = 3, [14] = 2, [16] = 32, 0x28, 0x83, 3, 2, 1, 99,
    0x01,     6,        5,        4,         98,   9,    8, 7, 97};
static const unsigned char palette[18 + 4 + 6] = {
    [1] = 1,  [2] = 1, [3] = 7, [5] = 2, [7] = 16, [12] = 3, [14] = 2,
    [16] = 8, 0x20,    0x1f,    0x00,    0xe0,     0x7f,     7,
    8,        7,       8,       8,       7};

/* From the bottom; from the right; runs across rows; of a palette. */
static void test_tga__kinds(void **state)
{
    (void)state;
    struct brume_error err;
    CHECK("tga", BYTES(colors), 3, 255, 10, 11, 12, 13, 14, 15, 16, 17, 18, 1,
          2, 3, 4, 5, 6, 7, 8, 9);
    CHECK("tga", BYTES(greys), 1, 255, 3, 2, 1, 6, 5, 4);
    CHECK("tga", BYTES(runs), 4, 255, 1, 2, 3, 99, 1, 2, 3, 99, 1, 2, 3, 99, 1,
          2, 3, 99, 4, 5, 6, 98, 7, 8, 9, 97);
    CHECK("tga", BYTES(palette), 1, 255, 7, 8, 7, 8, 8, 7);
    struct raster *raster = load("tga", palette, sizeof palette, &err);
    assert_non_null(raster);
    assert_int_equal(raster->colors, 9);
    assert_memory_equal(raster->palette[7], ((uint8_t[]){0, 0, 248}), 3);
    assert_memory_equal(raster->palette[8], ((uint8_t[]){248, 248, 0}), 3);
    raster_free(raster);
}

/* 3 x 2 pixels of 4 bits, numbers of a palette of 3. */
static const unsigned char indexed[] = {
    0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,    0,    13,
    'I',  'H',  'D',  'R',  0,    0,    0,    3,    0,    0,    0,    2,
    4,    3,    0,    0,    0,    0x6f, 0x5a, 0x7b, 0x29, 0x0,  0x0,  0x0,
    0x9,  0x50, 0x4c, 0x54, 0x45, 0xa,  0x14, 0x1e, 0x28, 0x32, 0x3c, 0x46,
    0x50, 0x5a, 0x16, 0xac, 0x84, 0x74, 0x0,  0x0,  0x0,  0xe,  0x49, 0x44,
    0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x54, 0x60, 0x50, 0x64, 0x0,  0x0,
    0x0,  0xcd, 0x0,  0x43, 0x67, 0x30, 0x95, 0xdb, 0x0,  0x0,  0x0,  0x0,
    0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

static void test_png__palette(void **state)
{
    (void)state;
    struct brume_error err;
    CHECK("png", BYTES(indexed), 1, 255, 0, 1, 2, 2, 1, 0);
    struct raster *raster = load("png", indexed, sizeof indexed, &err);
    assert_non_null(raster);
    assert_int_equal(raster->colors, 3);
    assert_memory_equal(raster->palette[1], ((uint8_t[]){40, 50, 60}), 3);
    raster_free(raster);
}

static void spoil(const char *format, const void *bytes, size_t size)
{
    unsigned char broken[512];
    struct brume_error err;
    for (size_t cut = 0; cut < size; cut++) {
        assert_null(load(format, bytes, cut, &err));
        assert_int_equal(err.code, BRUME_ERR_FILE);
        assert_non_null(strstr(err.text, path));
    }
    for (size_t bit = 0; bit < 8 * size; bit++) {
        memcpy(broken, bytes, size);
        broken[bit / 8] ^= (unsigned char)(1 << bit % 8);
        struct raster *raster = load(format, broken, size, &err);
        assert_true(raster || err.code == BRUME_ERR_FILE);
        raster_free(raster);
    }
}

static void test_raster__broken_files_are_errors(void **state)
{
    (void)state;
    spoil("pgm", TEXT("P5\n3 2\n255\n\1\2\3\4\5\377"));
    spoil("ppm", TEXT("P3 3 2 9 1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9"));
    spoil("tga", colors, sizeof colors);
    spoil("tga", runs, sizeof runs);
    spoil("tga", palette, sizeof palette);
}

static void expect(const char *format, const void *bytes, size_t size,
                   const char *text)
{
    struct brume_error err;
    assert_null(load(format, bytes, size, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    if (!strstr(err.text, text))
        fail_msg("'%s' is not in '%s'", text, err.text);
}

static void test_raster__errors(void **state)
{
    (void)state;
    unsigned char huge[18] = {[2] = 10, [12] = 255, 255, 255, 255, 24};
    expect("pgm", TEXT("P1 1 1 0"), "P2, P3, P5 or P6");
    expect("pgm", TEXT("P5 1 x"), "a number is missing");
    expect("pgm", TEXT("P5 1 1 65536\n\1"), "too large");
    expect("pgm", TEXT("P5 1 1 0\n\1"), "greatest value is 0");
    expect("pgm", TEXT("P2 2 1 7 1 8"), "too large");
    expect("pgm", TEXT("P5 99999 99999 255\n\1"), "ends too early");
    expect("pgm", TEXT("P5 0 1 255\n\1"), "0 x 1 pixels");
    expect("tga", huge, sizeof huge, "ends too early");
    expect("tga", TEXT("P5 99999 99999 255\n\1"), "none of the kinds");
    expect("hdr", TEXT("HDR"), "format 'hdr'");
    assert_false(raster_reads("hdr"));
    assert_true(raster_reads("ppm"));
}

/* ---- GIF and JPEG ------------------------------------------------------- */

static size_t read_file(const char *name, unsigned char bytes[2048])
{
    FILE *f = fopen(name, "rb");
    size_t size;

    assert_non_null(f);
    size = fread(bytes, 1, 2048, f);
    fclose(f);
    return size;
}

/* What giflib wrote of these numbers, one row after the other and interlaced;
 * colour i is (50 i + 20, 200 - 45 i, 25 i i). */
static void test_gif__numbers_and_palette(void **state)
{
    const uint16_t sample[] = {0, 1, 2, 3, 3, 3, 0, 1, 2, 0, 1, 2};
    struct brume_error err = {0};
    struct raster *raster = raster_load("gif", "tests/data/dots.gif", &err);
    (void)state;

    assert_non_null(raster);
    assert_int_equal(raster->width, 4);
    assert_int_equal(raster->height, 3);
    assert_int_equal(raster->channels, 1);
    assert_int_equal(raster->colors, 4);
    assert_memory_equal(raster->sample, sample, sizeof sample);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(raster->palette[i][0], 50 * i + 20);
        assert_int_equal(raster->palette[i][1], 200 - 45 * i);
        assert_int_equal(raster->palette[i][2], 25 * i * i);
    }
    raster_free(raster);
    raster = raster_load("gif", "tests/data/laced.gif", &err);
    assert_non_null(raster);
    assert_int_equal(raster->height, 9);
    for (int i = 0; i < 27; i++)
        assert_int_equal(raster->sample[i], i / 3 % 4);
    raster_free(raster);
}

/* The halves 1 2 | 10 20 and 255 0 | 255 7. */
static void test_pot__halves(void **state)
{
    struct brume_error err = {0};
    struct raster *raster = raster_load("pot", "tests/data/dots.pot", &err);
    (void)state;

    assert_non_null(raster);
    assert_int_equal(raster->width, 2);
    assert_int_equal(raster->colors, 0);
    assert_int_equal(raster->max, 65535);
    assert_int_equal(raster->sample[0], 256 + 10);
    assert_int_equal(raster->sample[1], 512 + 20);
    assert_int_equal(raster->sample[2], 65535);
    assert_int_equal(raster->sample[3], 7);
    raster_free(raster);
}

/* What libjpeg wrote of (15 x, 30 y, 200 - 8 x), which it keeps but nearly. */
static void test_jpeg__colors(void **state)
{
    struct brume_error err = {0};
    struct raster *raster = raster_load("jpg", "tests/data/dots.jpeg", &err);
    (void)state;

    assert_non_null(raster);
    assert_int_equal(raster->width, 16);
    assert_int_equal(raster->height, 8);
    assert_int_equal(raster->channels, 3);
    for (int i = 0; i < 128; i++) {
        const uint16_t *s = raster->sample + 3 * i;
        int x = i % 16, y = i / 16;
        assert_true(abs(s[0] - 15 * x) < 30);
        assert_true(abs(s[1] - 30 * y) < 30);
        assert_true(abs(s[2] - (200 - 8 * x)) < 30);
    }
    raster_free(raster);
}

/* A file that ends too early, or is something else, is refused. */
static void test_gif_and_jpeg__broken(void **state)
{
    static const char *const files[][2] = {{"gif", "tests/data/dots.gif"},
                                           {"gif", "tests/data/laced.gif"},
                                           {"pot", "tests/data/dots.pot"},
                                           {"jpeg", "tests/data/dots.jpeg"}};
    unsigned char bytes[2048];
    struct brume_error err;
    (void)state;

    for (int k = 0; k < 4; k++) {
        size_t size = read_file(files[k][1], bytes);
        for (size_t cut = 0; cut + 10 < size; cut++)
            assert_null(load(files[k][0], bytes, cut, &err));
        assert_int_equal(err.code, BRUME_ERR_FILE);
        assert_non_null(strstr(err.text, path));
        for (size_t i = 0; i < size; i++) {
            bytes[i] ^= 0x5a;
            raster_free(load(files[k][0], bytes, size, &err));
            bytes[i] ^= 0x5a;
        }
    }
    assert_null(raster_load("gif", "/nowhere/a.gif", &err));
    err = (struct brume_error){0};
    assert_null(raster_load("jpeg", "/nowhere/a.jpg", &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pnm__kinds),
        cmocka_unit_test(test_tga__kinds),
        cmocka_unit_test(test_png__palette),
        cmocka_unit_test(test_raster__broken_files_are_errors),
        cmocka_unit_test(test_raster__errors),
        cmocka_unit_test(test_gif__numbers_and_palette),
        cmocka_unit_test(test_pot__halves),
        cmocka_unit_test(test_jpeg__colors),
        cmocka_unit_test(test_gif_and_jpeg__broken),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
