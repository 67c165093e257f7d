/* test_pigments.c - functions of pigments and patterns against the values
 * that POV-Ray prints (tests/oracle/pigments.py). Run from the root of the
 * tree. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "parser/parse.h"

enum { LINE = 400, MOST = 16384 };

static const char head[] =
    "#version 3.7;\n"
    "#declare B = pigment { bozo color_map { [0 rgb 0] [1 rgb 1] } }\n"
    "#macro Same(A, W)\n"
    "  #local D = A - W;\n"
    "  #if (max(abs(D.red), abs(D.green), abs(D.blue), abs(D.filter),\n"
    "           abs(D.transmit)) > 1e-6)\n"
    "    #error concat(vstr(5, A, \" \", 0, 8), \" not \",\n"
    "                  vstr(5, W, \" \", 0, 8))\n"
    "  #end\n"
    "#end\n";

/* The scene in `text` is read without an error. */
static void holds(const char *text, const char *body)
{
    const char *const library = "tests/data";
    struct parse_input in = {.path = "scene.pov",
                             .library = &library,
                             .libraries = 1,
                             .text = text,
                             .length = strlen(text),
                             .ambient = PARSE_AMBIENT_INIT};
    struct parse_result result = {0};
    struct diag diag;

    diag_init(&diag);
    if (!parse_scene(&in, &result, &diag))
        fail_msg("%s: %s", body, diag.first->text);
    brume_scene_free(result.scene);
    diag_release(&diag);
}

static void add(char *text, const char *format, ...)
{
    size_t used = strlen(text);
    va_list list;

    va_start(list, format);
    vsnprintf(text + used, MOST - used, format, list);
    va_end(list);
}

static void check_point(char *text, const char *line)
{
    double v[8];
    int count = sscanf(line, "%lf %lf %lf %lf %lf %lf %lf %lf", &v[0], &v[1],
                       &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]);

    assert_true(count == 8 || count == 5);
    if (count == 5)
        v[5] = v[6] = v[7] = 0;
    add(text, "Same(%s F(%g, %g, %g), rgbft <%.9g, %.9g, %.9g, %.9g, %.9g>)\n",
        count == 5 ? "<1, 0, 0, 0, 0> *" : "", v[0], v[1], v[2], v[3], v[4],
        v[5], v[6], v[7]);
}

/* The bodies of a file in the form that oracle/pigments.py gives it; how
 * many. */
static int check_file(const char *path)
{
    static char text[MOST];
    char line[LINE], body[LINE] = "";
    FILE *file = fopen(path, "r");
    int bodies = 0;

    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (line[0] != 'p') {
            check_point(text, line);
            continue;
        }
        if (bodies++ > 0)
            holds(text, body);
        snprintf(body, sizeof body, "%s", line);
        snprintf(text, sizeof text, "%s#declare F = function { %s }\n", head,
                 line);
    }
    fclose(file);
    holds(text, body);
    return bodies;
}

static void functions_give_what_pov_ray_prints(void **state)
{
    (void)state;
    assert_true(check_file("tests/data/pigments.txt") > 60);
}

/* By oracle/images.py. */
static void pictures_give_what_pov_ray_prints(void **state)
{
    (void)state;
    assert_true(check_file("tests/data/images.txt") > 30);
}

/* ---- what is drawn ----------------------------------------------------- */

/* The pixel (x, y) of 4 by 4, each of a unit square of the plane z = 0.5 from
 * <0, 0> at the lower left, whose texture is given and not lit. */
static void check_pixel(const char *texture, int x, int y, double red,
                        double green, double blue)
{
    char text[2000];
    struct parse_input in = {
        .path = "scene.pov", .text = text, .ambient = PARSE_AMBIENT_INIT};
    struct parse_result result = {0};
    struct brume_options options = BRUME_OPTIONS_INIT;
    struct brume_frame frame = {0};
    struct diag diag;

    snprintf(text, sizeof text,
             "#default { finish { ambient 1 diffuse 0 } }\n"
             "camera { orthographic location <2, 2, -1> right 4*x up 4*y }\n"
             "plane { z, .5 %s }\n",
             texture);
    in.length = strlen(text);
    diag_init(&diag);
    if (!parse_scene(&in, &result, &diag))
        fail_msg("%s: %s", texture, diag.first->text);
    options.width = options.height = 4;
    options.spp = 4;
    options.backend = BRUME_BACKEND_CPU;
    assert_true(brume_render(result.scene, &options, &frame, NULL));
    const float *got = frame.radiance + 3 * (4 * (3 - y) + x);
    if (fabs(got[0] - red) > 1e-4 || fabs(got[1] - green) > 1e-4 ||
        fabs(got[2] - blue) > 1e-4)
        fail_msg("%s: %g %g %g", texture, got[0], got[1], got[2]);
    brume_frame_free(&frame);
    brume_scene_free(result.scene);
    diag_release(&diag);
}

static void pigments_are_drawn(void **state)
{
    const char *steps = "pigment { gradient y color_map { [.25 rgb x]"
                        "  [.25 .5 color rgb y color rgb y] [.5 rgb z] }"
                        "  scale 4 warp { repeat x } }";
    const char *nested = "pigment { checker pigment { rgb z } pigment {"
                         "  checker rgb x rgb y scale 2 translate y } }";
    (void)state;

    const char *picture = "pigment { image_map { png \"tests/data/dots.png\" }"
                          "  scale <3, 2, 1> }";
    const char *grid = "pigment { density_file df3 \"tests/data/cube.df3\""
                       "  scale 4 }";
    /* The lower row is blue, white ..., the upper one begins with red. */
    check_pixel(picture, 0, 0, 0, 0, 1);
    check_pixel(picture, 1, 0, 1, 1, 1);
    check_pixel(picture, 0, 1, 1, 0, 0);
    check_pixel(picture, 3, 3, 1, 0, 0);
    /* Samples 0, 40, 80, 120 of the cube's near half. */
    check_pixel(grid, 0, 0, 0, 0, 0);
    check_pixel(grid, 3, 0, 40 / 255.0, 40 / 255.0, 40 / 255.0);
    check_pixel(grid, 0, 3, 80 / 255.0, 80 / 255.0, 80 / 255.0);
    check_pixel(steps, 2, 0, 1, 0, 0);
    check_pixel(steps, 1, 1, 0, 1, 0);
    check_pixel(steps, 3, 2, 0, 0, 1);
    check_pixel(nested, 0, 0, 0, 0, 1);
    check_pixel(nested, 1, 0, 0, 1, 0);
    check_pixel(nested, 2, 1, 0, 1, 0);
    check_pixel(nested, 0, 1, 1, 0, 0);
}

static void textures_are_drawn(void **state)
{
    const char *layers =
        "texture { pigment { checker rgb x rgb y } translate x }"
        "texture { pigment { checker rgb z rgbt <0, 0, 1, .5> scale 2 } }";
    const char *map = "texture { gradient x texture_map {"
                      "  [.5 pigment { checker rgb x rgb y scale .5 }]"
                      "  [.5 pigment { rgb z }] } scale 4 }";
    (void)state;

    check_pixel(layers, 0, 0, 0, 0, 1);
    check_pixel(layers, 2, 0, 0, 0.5, 0.5);
    check_pixel(layers, 3, 0, 0.5, 0, 0.5);
    check_pixel(map, 3, 0, 0, 0, 1);
    check_pixel(map, 0, 0, 1, 0, 0);
    check_pixel(map, 0, 2, 0, 1, 0);
}

/* No recursion: what is too deep for core is an error. */
static void maps_nest_deep(void **state)
{
    (void)state;
    holds("#declare P = pigment { rgb x }\n"
          "#for (I, 1, 10)\n"
          "  #declare P = pigment { gradient x pigment_map {"
          "    [0 P] [1 P translate y] } }\n"
          "#end\n"
          "#declare F = function { pigment { P } }\n"
          "#if (F(.1, .2, .3).red != 1) #error \"red\" #end\n"
          "#for (I, 1, 5000)\n"
          "  #declare P = pigment { gradient x pigment_map {"
          "    [0 P] [1 P] } }\n"
          "#end\n"
          "sphere { 0, 1 pigment { P } }\n",
          "nested");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(functions_give_what_pov_ray_prints),
        cmocka_unit_test(pictures_give_what_pov_ray_prints),
        cmocka_unit_test(pigments_are_drawn),
        cmocka_unit_test(textures_are_drawn),
        cmocka_unit_test(maps_nest_deep),
    };

    return cmocka_run_group_tests_name("pigments", tests, NULL, NULL);
}
