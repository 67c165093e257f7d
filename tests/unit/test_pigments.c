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
    struct parse_input in = {.path = "scene.pov",
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

static void functions_give_what_pov_ray_prints(void **state)
{
    static char text[MOST];
    char line[LINE], body[LINE] = "";
    FILE *file = fopen("tests/data/pigments.txt", "r");
    int bodies = 0;
    (void)state;

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
    assert_true(bodies > 60);
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
        cmocka_unit_test(maps_nest_deep),
    };

    return cmocka_run_group_tests_name("pigments", tests, NULL, NULL);
}
