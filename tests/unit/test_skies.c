/* test_skies.c - sky_sphere and pictures around the sky, from the text to the
 * light: what POV-Ray shows (tests/oracle/skies.py) and closed forms. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "lib/exr.h"
#include "parser/parse.h"
#include "tests/unit/temp_folder.h"
#include "tests/unit/truth.h"

/* The scene of printf's text. */
static brume_scene *scene(const char *format, ...)
{
    char text[4000];
    struct diag diag;
    struct parse_result result = {0};
    va_list list;

    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = strlen(text),
                             .ambient = PARSE_AMBIENT_INIT};
    diag_init(&diag);
    if (!parse_scene(&in, &result, &diag) || diag.first)
        fail_msg("%s\n%s", diag.first->text, text);
    diag_release(&diag);
    return result.scene;
}

/* ---- what is seen ------------------------------------------------------ */

static void check_seen(const char *sky, double azimuth, double height,
                       const double truth[3])
{
    double a = azimuth * TRUTH_PI / 180.0, h = height * TRUTH_PI / 180.0;
    brume_scene *s = scene("background { rgb <0.9, 0.8, 0.3> }\n"
                           "camera { location <3, 4, 5> right x/1e6 up y/1e6\n"
                           "  direction <%.9g, %.9g, %.9g> }\n"
                           "sky_sphere { %s }\n",
                           cos(h) * sin(a), sin(h), cos(h) * cos(a), sky);
    struct estimate e = truth_render(s, 1, 1);
    for (int c = 0; c < 3; c++)
        if (!(fabs(e.mean[c] - truth[c]) < 1e-5))
            fail_msg("%s: channel %d is %g, not %g", sky, c, e.mean[c],
                     truth[c]);
}

/* POV-Ray's own figures, to the four digits that its pictures give. */
static void skies__layers(void **state)
{
    (void)state;
    static const struct {
        const char *sky;
        double seen[3];
    } row[] = {
        {"pigment { rgb <0.2, 0.5, 0.7> }", {0.2, 0.5, 0.7}},
        {"pigment { rgbt <0.2, 0.5, 0.7, 0.5> }", {0.55, 0.65, 0.5}},
        {"pigment { rgbf <0.2, 0.5, 0.7, 0.5> }", {0.19, 0.45, 0.455}},
        {"pigment { rgbft <0.2, 0.5, 0.7, 0.3, 0.2> }", {0.334, 0.53, 0.473}},
        {"pigment { rgbft <0.2, 0.5, 0.7, 0.8, 0.7> }", {0.674, 0.63, 0.028}},
        {"pigment { rgbt <0.6, 0.3, 0.2, 0.4> }"
         "pigment { rgbft <0.2, 0.5, 0.7, 0.3, 0.2> }",
         {0.2872, 0.425, 0.4484}},
        {"pigment { rgbf <0.6, 0.3, 0.2, 0.4> }"
         "pigment { rgbft <0.2, 0.5, 0.7, 0.3, 0.2> } emission 0.5",
         {0.15296, 0.1901, 0.20944}},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        check_seen(row[i].sky, 0, 0, row[i].seen);
}

static void skies__patterns(void **state)
{
    (void)state;
    char sky[300];
    static const double height[] = {-60, -10, 10, 40, 80};
    for (int i = 0; i < 10; i++) {
        double h = height[i / 2] * TRUTH_PI / 180.0;
        double v = i % 2 ? -cos(h) * sin(TRUTH_PI / 6.0) : sin(h);
        double truth[3] = {0.25 * (v + 1.0), 0.35 * (v + 1.0), 0.5 * (v + 1.0)};
        snprintf(sky, sizeof sky,
                 "pigment { gradient y color_map { [0 rgb 0] "
                 "[1 rgb <0.5, 0.7, 1>] } scale <1, 2, 1> translate -y } %s",
                 i % 2 ? "rotate 90*z" : "");
        check_seen(sky, 30, height[i / 2], truth);
    }
}

/* ---- pictures ---------------------------------------------------------- */

/* Each channel of a file is a plane of the caller's. */
static void save(const char *name, int width, int height, int channels,
                 float *const plane[])
{
    static const char *const names[] = {"R", "G", "B", "A"};
    struct image_channel c[4];
    for (int i = 0; i < channels; i++)
        c[i] = (struct image_channel){channels == 1 ? "Y" : names[i], plane[i],
                                      1, width};
    struct image image = {width, height, 0, 0,
                          width, height, c, (size_t)channels};
    assert_true(exr_save(name, &image, NULL, 0, 1, truth_error()));
}

enum { COLUMNS = 8, ROWS = 4 };

/* As POV-Ray has it: the left edge at +x, then on to +z; rows from +y. */
static void skies__picture(void **state)
{
    (void)state;
    float plane[4][COLUMNS * ROWS];
    float *const planes[4] = {plane[0], plane[1], plane[2], plane[3]};
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        plane[0][i] = (float)(i % COLUMNS);
        plane[1][i] = (float)(i / COLUMNS);
        plane[2][i] = 0.25f;
        plane[3][i] = 0.75f;
    }
    save("sky.exr", COLUMNS, ROWS, 4, planes);
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        double azimuth = 20.0 + 45.0 * (i % COLUMNS);
        double height = 67.5 - 45.0 * (i / COLUMNS);
        double turned = 90.0 - azimuth < 0.0 ? 450.0 - azimuth : 90.0 - azimuth;
        int column = (int)(turned / 45.0);
        double truth[3] = {2.0 * column + 0.25 * 0.9,
                           2.0 * (i / COLUMNS) + 0.25 * 0.8,
                           2.0 * 0.25 + 0.25 * 0.3};
        check_seen("pigment { image_map { exr \"sky.exr\" map_type 1 } } "
                   "emission 2",
                   azimuth, height, truth);
        truth[0] += column == 7 ? -14.0 : 2.0;
        check_seen("pigment { image_map { exr \"sky.exr\" map_type 1 } "
                   "rotate 60*y } rotate -15*y emission 2",
                   azimuth, height, truth);
    }
}

static void skies__gray_picture_interpolated(void **state)
{
    (void)state;
    float plane[COLUMNS * ROWS], *const planes[] = {plane};
    for (int i = 0; i < COLUMNS * ROWS; i++)
        plane[i] = (float)(i % COLUMNS);
    save("gray.exr", COLUMNS, ROWS, 1, planes);
    static const struct {
        double azimuth, seen;
    } row[] = {{0, 1.5}, {22.5, 1}, {45, 0.5}, {90, 3.5}, {-90, 3.5}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        check_seen("pigment { image_map { exr \"gray.exr\" map_type 1 "
                   "interpolate 2 } }",
                   row[i].azimuth, 10,
                   (double[3]){row[i].seen, row[i].seen, row[i].seen});
}

/* ---- light ------------------------------------------------------------- */

#define FULL "global_settings { light_units physical }\n"
#define AT_WALL                                                                \
    "camera { orthographic location 4*y direction -y right x/1e3 up z/1e3 }\n" \
    "plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }\n"

/* Radiance of a white wall is the sky's over the cosine: of (1 + y) / 2 it is
 * 5/6, of 1 within an angle a of the zenith sin^2 a. */
static void skies__function_lights(void **state)
{
    (void)state;
    struct estimate e = truth_render(
        scene(FULL AT_WALL "sky_sphere { pigment { gradient y color_map {"
                           "[0 rgb 0] [1 rgb 1] } scale 2 translate -y } }"),
        8, 400);
    truth_check("wall under a gradient", &e, 5.0 / 6.0, 1e-6, 5e-3);
    double c = cos(3.0 * TRUTH_PI / 180.0);
    e = truth_render(
        scene(FULL AT_WALL
              "sky_sphere { pigment { gradient y color_map { [%.9g rgb 0]"
              "[%.9g rgb 300] } scale 2.0001 translate -1.0001*y } }",
              (c + 1.0001) / 2.0001, (c + 1.0001) / 2.0001),
        8, 400);
    truth_check("wall under a cap", &e, 300.0 * (1.0 - c * c), 1e-4, 1e-2);
}

/* In single scattering the sky lights too, if it shall: a medium that does
 * not attenuate adds sigma_s length to what is behind; a wall shows what its
 * finish says. */
static void skies__single_scattering(void **state)
{
    (void)state;
#define SINGLE "global_settings { transport { environment on } }\n"
    struct estimate e = truth_render(
        scene(SINGLE "background { rgb 0.5 }"
                     "camera { location -9*z right x/1e3 up y/1e3 }"
                     "sphere { 0, 1 hollow pigment { rgbt 1 } interior {"
                     "media { scattering { 1, 0.2 extinction 0 } } } }"),
        8, 2000);
    truth_check("medium under a background", &e, 0.5 * 1.4, 1e-6, 2e-3);
    e = truth_render(scene(SINGLE AT_WALL
                           "sky_sphere { pigment { gradient y color_map {"
                           "[0 rgb 0] [1 rgb 1] } scale 2 translate -y } }"),
                     8, 400);
    truth_check("wall, direct light", &e, 5.0 / 6.0, 1e-6, 5e-3);
    e = truth_render(scene(AT_WALL "background { rgb 1 }"), 2, 16);
    assert_true(e.mean[0] == 0.0);
}

/* A white medium and a white ball in it, in a picture of one radiance. */
static void skies__white_furnace(void **state)
{
    (void)state;
    float plane[COLUMNS * ROWS], *const planes[] = {plane};
    for (int i = 0; i < COLUMNS * ROWS; i++)
        plane[i] = 0.7f;
    save("gray.exr", COLUMNS, ROWS, 1, planes);
    struct estimate e = truth_render(
        scene(FULL "camera { location -9*z right x/5 up y/5 }"
                   "sphere { 0, 1 hollow pigment { rgbt 1 } interior {"
                   "media { scattering { 1, 3 } } } }"
                   "sphere { 0, 0.5 pigment { rgb 1 }"
                   "finish { ambient 0 diffuse 1 } }"
                   "sky_sphere { pigment {"
                   "image_map { exr \"gray.exr\" map_type 1 } } }"),
        8, 4000);
    truth_check("white furnace", &e, (double)0.7f, 1e-6, 1e-3);
}

enum { SUN_COLUMNS = 256, SUN_ROWS = 128, SUN_X = 40, SUN_Y = 30 };

static const char *under_the_sun(void)
{
    return FULL "camera { location <0, 1, -9> look_at <0, 1, 0>"
                "  right x/1e3 up y/1e3 }\n"
                "plane { y, 0 pigment { rgb 0.5 }"
                "  finish { ambient 0 diffuse 1 } }\n"
                "sphere { y, 1 hollow pigment { rgbt 1 } interior {"
                "  media { scattering { 5, 1 eccentricity 0.4 } } } }\n";
}

/* A small sun in a picture lights as parallel light of the same irradiance,
 * pi its color, from its middle. */
static void skies__sun(void **state)
{
    (void)state;
    static float plane[SUN_COLUMNS * SUN_ROWS];
    float *const planes[] = {plane};
    const double radiance = 10000.0, step = TRUTH_PI / SUN_ROWS;
    memset(plane, 0, sizeof plane);
    for (int i = 0; i < 4; i++)
        plane[(SUN_Y + i / 2) * SUN_COLUMNS + SUN_X + i % 2] = (float)radiance;
    save("sky.exr", SUN_COLUMNS, SUN_ROWS, 1, planes);
    double polar = (SUN_Y + 1) * step, around = (SUN_X + 1) * step;
    double angle = 2.0 * step * (cos(SUN_Y * step) - cos((SUN_Y + 2) * step));
    struct estimate map = truth_render(
        scene("%s sky_sphere { pigment {"
              "image_map { exr \"sky.exr\" map_type 1 } } }",
              under_the_sun()),
        8, 2000);
    struct estimate lamp = truth_render(
        scene("%s light_source { 1000*<%.9g, %.9g, %.9g> rgb %.9g parallel"
              "  point_at 0 }",
              under_the_sun(), sin(polar) * cos(around), cos(polar),
              sin(polar) * sin(around), radiance * angle / TRUTH_PI),
        8, 2000);
    assert_true(lamp.mean[0] > 0.1);
    truth_check("sun", &map, lamp.mean[0], lamp.error[0], 2e-2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skies__layers),
        cmocka_unit_test(skies__patterns),
        cmocka_unit_test(skies__picture),
        cmocka_unit_test(skies__gray_picture_interpolated),
        cmocka_unit_test(skies__function_lights),
        cmocka_unit_test(skies__single_scattering),
        cmocka_unit_test(skies__white_furnace),
        cmocka_unit_test(skies__sun),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
