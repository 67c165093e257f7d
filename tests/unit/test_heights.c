/* test_heights.c - height fields of pictures: the heights that POV-Ray 3.7
 * has there, which trace() prints for such a file to 5 digits. */
#include <stdlib.h>
#include <unistd.h>
#include "tests/unit/scene_text.h"
#include "tests/unit/temp_folder.h"

static void put(const char *name, const char *bytes, size_t size)
{
    FILE *f = fopen(name, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
}

#define PUT(name, text) put(name, text, sizeof(text) - 1)

static void check(const char *text, double first, double second)
{
    const brume_scene *s = scene(text);
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_HEIGHT_FIELD);
    assert_int_equal(s->shape[0].steps[0], 2);
    assert_int_equal(s->shape[0].steps[1], 2);
    assert_int_equal(s->shape[0].count, 4);
    for (int i = 0; i < 4; i++) {
        double truth = i == 0 ? first : i == 1 ? second : i == 2 ? 0 : 1;
        if (!(fabs(s->list[0].data[i] - truth) < 3e-5))
            fail_msg("%s: height %d is %g, not %g", text, i, s->list[0].data[i],
                     truth);
    }
}

static void test_heights__grey(void **state)
{
    (void)state;
    PUT("a.PGM", "P5 2 2 255\n\12\74\0\377");
    PUT("w.pgm", "P5 2 2 65535\n\12\115\74\115\0\0\377\377");
    check("height_field { pgm \"a.PGM\" }", 0.0392160, 0.2352908);
    check("height_field { \"a.PGM\" smooth }", 0.0392160, 0.2352908);
    assert_true(result.scene->shape[0].smooth);
    check("height_field { pgm \"w.pgm\" water_level .2 }", 0.0402383,
          0.2355502);
    check("height_field { pgm \"w.pgm\" gamma 2.2 }", 0.0008395, 0.0415499);
    check("height_field { pgm \"w.pgm\" gamma srgb }", 0.0031131, 0.0452731);
}

/* Two bytes of one number; grey where a colour has 16 bits. */
static void test_heights__colours(void **state)
{
    (void)state;
    PUT("c.ppm", "P6 2 2 255\n\12\200\7\74\200\7\0\0\0\377\377\0");
    PUT("w.ppm", "P6 2 2 65535\n\12\5\165\60\2\274\74\5\165\60\2\274"
                 "\0\0\0\0\0\0\377\377\377\377\377\377");
    check("height_field { ppm \"c.ppm\" }", 0.0410165, 0.2363284);
    check("height_field { ppm \"c.ppm\" gamma 2 }", 0.0025028, 0.0561221);
    check("height_field { ppm \"w.ppm\" }", 0.2824557, 0.3404694);
}

/* The number in a palette, of 256. */
static void test_heights__palette(void **state)
{
    (void)state;
    static const char palette[18 + 6 + 4] = {
        [1] = 1,  [2] = 1, [5] = 2,   [7] = 24, [12] = 2, [14] = 2,
        [16] = 8, 0x20,    [24] = 10, 60,       0,        (char)255};
    put("p.tga", palette, sizeof palette);
    const brume_scene *s = scene("height_field { tga \"p.tga\" gamma 2 }");
    NUMBERS(s->list[0].data, 10 / 256., 60 / 256., 0, 255 / 256.);
}

static void test_heights__errors(void **state)
{
    (void)state;
    PUT("broken", "P5 9 9 255\n\1\2\3");
    PUT("a.PGM", "P5 2 2 255\n\12\74\0\377");
    expect_error("height_field { bmp \"a.PGM\" }", BRUME_ERR_SCENE, 1, 20,
                 "format 'bmp' are not supported yet");
    expect_error("height_field { \"broken\" }", BRUME_ERR_SCENE, 1, 16,
                 "format '' are not supported yet");
    expect_error("height_field { pgm \"broken\" }", BRUME_ERR_FILE, 1, 20,
                 "it ends too early");
    expect_error("height_field { pgm \"none\" }", BRUME_ERR_FILE, 1, 20,
                 "not found");
    expect_error("height_field { pgm \"a.PGM\" pgm \"a.PGM\" }",
                 BRUME_ERR_SCENE, 1, 32, "one picture or one function");
    expect_error("height_field { gamma 2 pgm \"a.PGM\" }", BRUME_ERR_SCENE, 1,
                 16, "behind the picture's name");
    expect_error("height_field { pgm \"a.PGM\" gamma 0 }", BRUME_ERR_SCENE, 1,
                 28, "above 0");
    expect_error("height_field { smooth }", BRUME_ERR_SCENE, 1, 23,
                 "needs a picture or a function");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_heights__grey),
        cmocka_unit_test(test_heights__colours),
        cmocka_unit_test(test_heights__palette),
        cmocka_unit_test(test_heights__errors),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
