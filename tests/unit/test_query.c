/* test_query.c - trace, inside and extents of shapes against POV-Ray's
 * (tests/data/shapes.txt, made by tests/oracle/shapes.py). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "core/brume.h"
#include "lib/font.h"

static const double turn[3][4] = {
    {0.6, -0.64, 0.48, 0.3}, {0.8, 0.48, -0.36, -0.2}, {0, 0.6, 0.8, 0.1}};

static int add(brume_scene *scene, const struct brume_shape *shape)
{
    struct brume_error err = {0};
    int id = brume_add_shape(scene, shape, &err);
    if (id < 0)
        fail_msg("%s", err.text);
    return id;
}

/* a and b as text, then radius and radius_b: short to read. */
static struct brume_shape make(enum brume_shape_kind kind, const char *points,
                               double radius, double radius_b)
{
    struct brume_shape s = BRUME_SHAPE_INIT;
    s.kind = kind;
    s.radius = radius;
    s.radius_b = radius_b;
    s.part = true;
    sscanf(points, "%lf %lf %lf %lf %lf %lf", &s.a[0], &s.a[1], &s.a[2],
           &s.b[0], &s.b[1], &s.b[2]);
    return s;
}

static int add_made(brume_scene *scene, enum brume_shape_kind kind,
                    const char *points, double radius, double radius_b)
{
    struct brume_shape s = make(kind, points, radius, radius_b);
    return add(scene, &s);
}

static int add_turned(brume_scene *scene, struct brume_shape s)
{
    memcpy(s.transform, turn, sizeof turn);
    return add(scene, &s);
}

static int add_box(brume_scene *scene)
{
    return add_made(scene, BRUME_SHAPE_BOX, "-1 -1 -1 1 1 1", 0, 0);
}

static int add_ball(brume_scene *scene)
{
    return add_made(scene, BRUME_SHAPE_SPHERE, "0.5 0.2 0", 0.9, 0);
}

static int add_tube(brume_scene *scene)
{
    return add_made(scene, BRUME_SHAPE_CYLINDER, "0 -2 0 0 2 0", 0.5, 0);
}

/* A composite of up to three parts; -1: none. */
static struct brume_shape compose(enum brume_shape_kind kind, int *parts, int a,
                                  int b, int c)
{
    struct brume_shape s = make(kind, "", 0, 0);
    parts[0] = a;
    parts[1] = b;
    parts[2] = c;
    s.parts = parts;
    s.part_count = c < 0 ? 2 : 3;
    return s;
}

static int add_composite(brume_scene *scene, enum brume_shape_kind kind, int a,
                         int b, int c)
{
    int parts[3];
    struct brume_shape s = compose(kind, parts, a, b, c);
    return add(scene, &s);
}

static int add_clipped(brume_scene *scene, struct brume_shape s, int clip)
{
    s.clips = &clip;
    s.clip_count = 1;
    return add(scene, &s);
}

static int add_simple(brume_scene *scene, const char *name)
{
    struct brume_shape s;
    if (!strcmp(name, "sphere")) {
        s = make(BRUME_SHAPE_SPHERE, "0.1 0.2 0.3", 0.8, 0);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 4; k++)
                s.transform[i][k] = turn[i][k] * (k == 0   ? 1
                                                  : k == 1 ? 2
                                                  : k == 2 ? 0.5
                                                           : 1);
        return add(scene, &s);
    }
    if (!strcmp(name, "box"))
        return add_turned(scene,
                          make(BRUME_SHAPE_BOX, "-1 -0.5 0 0.4 1 0.7", 0, 0));
    if (!strcmp(name, "cylinder"))
        return add_made(scene, BRUME_SHAPE_CYLINDER,
                        "-0.5 -0.3 0.2 0.5 0.9 1.2", 0.4, 0);
    if (!strcmp(name, "backward"))
        return add_made(scene, BRUME_SHAPE_CYLINDER,
                        "0.5 0.2 0.2 -0.5 0.9 -1.2", 0.4, 0);
    if (!strcmp(name, "cone"))
        return add_made(scene, BRUME_SHAPE_CONE, "0.2 -0.6 -0.4 0.1 0.9 0.5",
                        0.8, 0.25);
    if (!strcmp(name, "disc"))
        return add_made(scene, BRUME_SHAPE_DISC, "0.1 0.2 0.3 1 2 1", 1, 0.3);
    if (!strcmp(name, "plane"))
        return add_made(scene, BRUME_SHAPE_PLANE, "1 2 -1", 0.3, 0);
    if (!strcmp(name, "torus"))
        return add_turned(scene, make(BRUME_SHAPE_TORUS, "", 0.8, 0.3));
    s = make(BRUME_SHAPE_CONE, "0 -1 0 0 1 0", 0.8, 0.25);
    s.open = true;
    if (strcmp(name, "open") != 0) {
        s = make(BRUME_SHAPE_SPHERE, "0 0 0", 1, 0);
        s.inverse = true;
    }
    return add(scene, &s);
}

static int add_text(brume_scene *scene)
{
    struct brume_error err = {0};
    struct brume_shape s = make(BRUME_SHAPE_TEXT, "", 2.5, 0);
    const double offset[2] = {0.1, 0.05};
    double *numbers;
    if (!font_outline("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "B g%",
                      offset, &numbers, &s.count, &err))
        fail_msg("%s", err.text);
    s.data = numbers;
    s.transform[0][3] = -1.3;
    s.transform[1][3] = -0.2;
    s.transform[2][3] = -1;
    int id = add(scene, &s);
    free(numbers);
    return id;
}

static int add_clips(brume_scene *scene, const char *name)
{
    int parts[3];
    if (!strcmp(name, "clipped"))
        return add_clipped(
            scene, make(BRUME_SHAPE_SPHERE, "0 0 0", 1, 0),
            add_made(scene, BRUME_SHAPE_BOX, "-2 -0.4 -2 0.5 0.6 2", 0, 0));
    if (!strcmp(name, "clipped difference")) {
        int box = add_box(scene), tube = add_tube(scene);
        int clip = add_made(scene, BRUME_SHAPE_PLANE, "1 1 0", 0.2, 0);
        return add_clipped(
            scene, compose(BRUME_SHAPE_DIFFERENCE, parts, box, tube, -1), clip);
    }
    if (!strcmp(name, "opened")) {
        struct brume_shape s = make(BRUME_SHAPE_CYLINDER, "0 -2 0 0 0.5 0", 0.5,
                                    0);
        s.open = true;
        int box = add_box(scene), tube = add(scene, &s);
        return add_composite(scene, BRUME_SHAPE_DIFFERENCE, box, tube, -1);
    }
    int clip = add_made(scene, BRUME_SHAPE_PLANE, "1 0 0", 0.1, 0);
    int ball = add_clipped(scene, make(BRUME_SHAPE_SPHERE, "0 0 0", 0.9, 0),
                           clip);
    return add_composite(scene, BRUME_SHAPE_DIFFERENCE, add_box(scene), ball,
                         -1);
}

static int add_csg(brume_scene *scene, const char *name)
{
    int box = add_box(scene), ball = add_ball(scene), tube = add_tube(scene);
    int parts[3];
    if (!strcmp(name, "difference"))
        return add_composite(scene, BRUME_SHAPE_DIFFERENCE, box, ball, tube);
    if (!strcmp(name, "turned"))
        return add_turned(
            scene, compose(BRUME_SHAPE_DIFFERENCE, parts, box, ball, tube));
    if (!strcmp(name, "intersection"))
        return add_composite(
            scene, BRUME_SHAPE_INTERSECTION, box, ball,
            add_made(scene, BRUME_SHAPE_PLANE, "0 1 0", 0.5, 0));
    if (!strcmp(name, "union")) {
        struct brume_shape s = compose(BRUME_SHAPE_UNION, parts, box, ball,
                                       tube);
        memcpy(s.transform, turn, sizeof turn);
        for (int i = 0; i < 9; i++)
            s.transform[i / 3][i % 3] *= 0.7;
        return add(scene, &s);
    }
    if (!strcmp(name, "merge"))
        return add_composite(scene, BRUME_SHAPE_MERGE, box, ball, tube);
    if (!strcmp(name, "twice")) {
        int both = add_composite(scene, BRUME_SHAPE_UNION, ball, tube, -1);
        int less = add_composite(scene, BRUME_SHAPE_DIFFERENCE, box, both, -1);
        return add_composite(
            scene, BRUME_SHAPE_DIFFERENCE,
            add_made(scene, BRUME_SHAPE_SPHERE, "0 0 0", 1.6, 0), less, -1);
    }
    bool cut = !strcmp(name, "cut union");
    int both = add_composite(scene, BRUME_SHAPE_UNION, box, ball, -1);
    int whole = add_made(scene, BRUME_SHAPE_SPHERE, "0 0 0", cut ? 1.2 : 1.6,
                         0);
    return add_composite(
        scene, cut ? BRUME_SHAPE_INTERSECTION : BRUME_SHAPE_DIFFERENCE, whole,
        both, -1);
}

static int add_named(brume_scene *scene, const char *name)
{
    static const char *simple[] = {"sphere", "box",    "cylinder", "backward",
                                   "cone",   "disc",   "plane",    "torus",
                                   "open",   "inverse"};
    for (size_t i = 0; i < sizeof simple / sizeof *simple; i++)
        if (!strcmp(name, simple[i]))
            return add_simple(scene, name);
    if (!strcmp(name, "text"))
        return add_text(scene);
    if (strstr(name, "clipped") || !strcmp(name, "opened"))
        return add_clips(scene, name);
    return add_csg(scene, name);
}

struct about {
    brume_scene *scene;
    int shape;
    char name[64];
};

static void check_near(const struct about *a, const char *what,
                       const double *found, const double *truth, double most)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(found[i] - truth[i]) <= most * fmax(1, fabs(truth[i]))))
            fail_msg("%s: %s is (%.9g %.9g %.9g), not (%.9g %.9g %.9g)",
                     a->name, what, found[0], found[1], found[2], truth[0],
                     truth[1], truth[2]);
}

/* Its glyphs are off by a tenth of a font's unit, 1/2048; rays graze them. */
static double loose(const struct about *a, double most)
{
    return strcmp(a->name, "text") ? most : 2e-3;
}

static void check_bounds(const struct about *a, const double *v)
{
    struct brume_error err = {0};
    double lo[3], hi[3];
    assert_true(brume_extent(a->scene, a->shape, lo, hi, &err));
    check_near(a, "min_extent", lo, v, loose(a, 2e-7));
    check_near(a, "max_extent", hi, v + 3, loose(a, 2e-7));
}

static void check_inside(const struct about *a, const double *v)
{
    struct brume_error err = {0};
    int in = brume_inside(a->scene, a->shape, v, &err);
    if (in != (int)v[3])
        fail_msg("%s: inside of (%g %g %g) is %d", a->name, v[0], v[1], v[2],
                 in);
}

static void check_trace(const struct about *a, const double *v, bool hits)
{
    struct brume_error err = {0};
    double p[3], n[3];
    int found = brume_trace(a->scene, a->shape, v, v + 3, p, n, &err);
    if (found != hits)
        fail_msg("%s: %d hits from (%g %g %g) along (%g %g %g)", a->name, found,
                 v[0], v[1], v[2], v[3], v[4], v[5]);
    if (!hits)
        return;
    check_near(a, "point", p, v + 6, loose(a, 1e-7));
    if (strcmp(a->name, "text") != 0)
        check_near(a, "normal", n, v + 9, 1e-6);
}

static int read_numbers(const char *text, double v[12])
{
    return sscanf(text, "%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf",
                  &v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7], &v[8],
                  &v[9], &v[10], &v[11]);
}

static void check_row(struct about *a, const char *line)
{
    double v[12];
    if (!strncmp(line, "shape ", 6)) {
        sscanf(line + 6, "%63[^\n]", a->name);
        a->shape = add_named(a->scene, a->name);
    } else if (!strncmp(line, "bounds ", 7)) {
        assert_int_equal(read_numbers(line + 7, v), 6);
        check_bounds(a, v);
    } else if (!strncmp(line, "inside ", 7)) {
        assert_int_equal(read_numbers(line + 7, v), 4);
        check_inside(a, v);
    } else if (!strncmp(line, "trace ", 6)) {
        check_trace(a, v, read_numbers(line + 6, v) == 12);
    }
}

static void test_query__as_povray(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct about a = {brume_scene_new(&err), -1, ""};
    FILE *file = fopen("tests/data/shapes.txt", "r");
    char line[512];
    int rows = 0;
    assert_non_null(file);
    for (; fgets(line, sizeof line, file); rows++)
        check_row(&a, line);
    fclose(file);
    assert_true(rows > 1000);
    brume_scene_free(a.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_query__as_povray),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
