/* test_plate.c - pictures from elsewhere behind and between media: closed forms
 * of what the eye sees, by all integrators, and the files that they come in,
 * written by OpenEXR's own library (tests/oracle/plates.py). */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "lib/plate.h"
#include "parser/parse.h"
#include "tests/unit/truth.h"

enum { SIDE = 16, PIXELS = SIDE * SIDE };

static const double absorption[3] = {0.7, 0.2, 1.5};
static const double emission[3] = {0.4, 1.1, 0.0};
static const double behind[3] = {0.3, 0.6, 0.9};

static float radiance[3 * PIXELS], alpha[PIXELS], depth[PIXELS];

/* Depths from before a box between distances 3 and 5 to behind it. */
static void fill_plate(struct brume_plate *plate)
{
    for (int i = 0; i < PIXELS; i++) {
        for (int c = 0; c < 3; c++)
            radiance[3 * i + c] = 0.05f * (float)(i % SIDE) + 0.3f * (float)c;
        alpha[i] = (float)(i / SIDE) / (float)(SIDE - 1);
        depth[i] = 2.5f + 3.0f * (float)i / (float)PIXELS;
    }
    *plate = (struct brume_plate)BRUME_PLATE_INIT;
    plate->width = plate->height = SIDE;
    plate->radiance = radiance;
    plate->depth = depth;
}

static brume_scene *box_scene(double window)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_medium m = BRUME_MEDIUM_INIT;
    memcpy(g.background, behind, sizeof g.background);
    memcpy(m.absorption, absorption, sizeof m.absorption);
    memcpy(m.emission, emission, sizeof m.emission);
    brume_scene *s = truth_scene(&g, 4.0, window);
    truth_fill(s, truth_box(50.0, -1.0, 1.0), &m);
    return s;
}

static struct brume_frame render(brume_scene *s, const struct brume_plate *p,
                                 bool omit)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    assert_true(brume_set_plate(s, p, truth_error()));
    o.width = o.height = SIDE;
    o.spp = 1;
    o.omit_background = omit;
    assert_true(brume_render(s, &o, &f, truth_error()));
    brume_scene_free(s);
    return f;
}

static void check(const char *what, int pixel, int c, double seen, double truth)
{
    if (!(fabs(seen - truth) <= 1e-6 + 1e-5 * fabs(truth)))
        fail_msg("%s, pixel %d, channel %d: %.9g, not %.9g", what, pixel, c,
                 seen, truth);
}

/* How long the middle of a pixel's ray is for a unit along the view. */
static double stretch(int pixel, double window)
{
    double x = ((pixel % SIDE + 0.5) / SIDE - 0.5) * window;
    double y = ((pixel / SIDE + 0.5) / SIDE - 0.5) * window;
    return sqrt(1.0 + x * x + y * y);
}

/* What is seen of the box from distance a to b of the view, its emission
 * through it in *light; lengths along the ray are `far` times as long. */
static double passes(int c, double a, double b, double far, double *light)
{
    double length = far * fmax(fmin(b, 5.0) - fmax(a, 3.0), 0.0);
    double t = exp(-absorption[c] * length);
    *light = emission[c] / absorption[c] * (1.0 - t);
    return t;
}

static void check_picture(const char *what, const struct brume_frame *f,
                          const struct brume_plate *p, double window, bool omit)
{
    for (int i = 0; i < PIXELS; i++) {
        double far = stretch(i, window);
        double z = p->depth ? (double)p->depth[i] : INFINITY;
        double a = p->alpha ? (double)p->alpha[i] : 1.0;
        if (p->along_ray)
            z /= far;
        for (int c = 0; c < 3; c++) {
            double before, after;
            double t = passes(c, 0.0, z, far, &before);
            double t2 = passes(c, z, INFINITY, far, &after);
            double own = (double)p->radiance[3 * i + c];
            double truth = before + t * (1.0 - a) * after;
            if (!omit)
                truth += t * (own + (1.0 - a) * t2 * behind[c]);
            check(what, i, c, (double)f->radiance[3 * i + c], truth);
            check("opacity", i, c, (double)f->opacity[3 * i + c], 1.0 - t);
        }
        double seen = (double)f->depth[i];
        if (a > 0.0 && isfinite(z))
            check("depth", i, 0, seen, z);
        else
            assert_true(isinf(seen));
    }
}

/* T(Z) P + (1 - T(Z)) E, pixel by pixel. */
static void plate__in_a_box(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        double window = k & 1 ? 1.2 : 1e-6;
        struct brume_plate p;
        fill_plate(&p);
        p.along_ray = (k & 2) != 0;
        p.alpha = k & 4 ? alpha : NULL;
        for (int omit = 0; omit < 2; omit++) {
            struct brume_frame f = render(box_scene(window), &p, omit);
            check_picture("radiance", &f, &p, window, omit);
            brume_frame_free(&f);
        }
    }
}

/* Without a depth, and where it is nothing that can be one. */
static void plate__behind_everything(void **state)
{
    (void)state;
    struct brume_plate p, q;
    fill_plate(&p);
    p.alpha = alpha;
    p.depth = NULL;
    struct brume_frame far = render(box_scene(0.7), &p, false);
    check_picture("no depth", &far, &p, 0.7, false);
    static const float none[] = {NAN, 0.0f, -1.0f, INFINITY, -INFINITY, 1e30f};
    fill_plate(&q);
    q.alpha = alpha;
    for (int i = 0; i < PIXELS; i++)
        depth[i] = none[i % 6];
    struct brume_frame f = render(box_scene(0.7), &q, false);
    assert_memory_equal(f.radiance, far.radiance, 3 * PIXELS * sizeof(float));
    brume_frame_free(&f);
    brume_frame_free(&far);
}

/* ---- surfaces ---------------------------------------------------------- */

/* A wall at distance 4 that glows, and lets `pass` through. */
static void add_wall(brume_scene *s, double glow, double pass)
{
    struct brume_material m = BRUME_MATERIAL_INIT;
    struct brume_shape wall = BRUME_SHAPE_INIT;
    for (int c = 0; c < 3; c++) {
        m.color[0][c] = 1.0;
        m.ambient[c] = glow;
    }
    m.color[0][4] = pass;
    m.diffuse = 0.0;
    wall.kind = BRUME_SHAPE_PLANE;
    wall.a[0] = wall.a[1] = 0.0;
    wall.a[2] = 1.0;
    wall.radius = 0.0;
    wall.material = brume_add_material(s, &m, truth_error());
    assert_true(wall.material >= 0);
    assert_true(brume_add_shape(s, &wall, truth_error()) >= 0);
}

/* A surface before the plate hides it; one behind it is hidden. At the very
 * same distance the surface is before it. */
static void plate__among_surfaces(void **state)
{
    (void)state;
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_plate p;
    fill_plate(&p);
    p.alpha = alpha;
    memcpy(g.background, behind, sizeof g.background);
    depth[7] = 4.0f;
    for (int pass = 0; pass < 2; pass++) {
        struct brume_frame f[2];
        for (int omit = 0; omit < 2; omit++) {
            brume_scene *s = truth_scene(&g, 4.0, 1e-6);
            add_wall(s, 2.0, 0.5 * pass);
            f[omit] = render(s, &p, omit);
        }
        for (int i = 0; i < PIXELS; i++) {
            bool before = depth[i] < 4.0f;
            double own = (double)radiance[3 * i];
            double all = (double)f[0].radiance[3 * i];
            double wall = (double)f[1].radiance[3 * i];
            double through = 1.0 - (double)alpha[i], clear = 0.5 * pass;
            check("plate", i, 0, all - wall,
                  (before ? own : clear * own) + clear * through * behind[0]);
            /* Of a clear wall, one sample takes its light or what is behind. */
            if (pass == 0)
                check("wall", i, 0, wall, before ? 2.0 * through : 2.0);
            check("nearest", i, 0, (double)f[0].depth[i],
                  before && through < 1.0 ? (double)depth[i] : 4.0);
        }
        brume_frame_free(&f[0]);
        brume_frame_free(&f[1]);
    }
}

/* ---- light that is scattered ------------------------------------------- */

/* All around the light is 1, and so it is at any point of a medium that does
 * not absorb: whatever integrates it, 1 - T up to the plate. */
static void check_furnace(const char *what, struct brume_options *o,
                          bool along_ray, double most)
{
    enum { WIDE = 8 };
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_medium m = truth_medium(0.0, 0.8, 0.3);
    struct brume_plate p = BRUME_PLATE_INIT;
    struct brume_shape ball = BRUME_SHAPE_INIT;
    struct brume_frame f;
    g.media_multiple = g.environment = true;
    g.background[0] = g.background[1] = g.background[2] = 1.0;
    brume_scene *s = truth_scene(&g, 4.0, 0.1);
    ball.kind = BRUME_SHAPE_SPHERE;
    truth_fill(s, ball, &m);
    for (int i = 0; i < WIDE * WIDE; i++) {
        radiance[3 * i] = radiance[3 * i + 1] = radiance[3 * i + 2] = 3.0f;
        depth[i] = i < WIDE * WIDE / 2 ? 3.5f : 4.5f;
    }
    p.width = p.height = WIDE;
    p.radiance = radiance;
    p.depth = depth;
    p.along_ray = along_ray;
    o->width = o->height = WIDE;
    assert_true(brume_set_plate(s, &p, truth_error()));
    assert_true(brume_render(s, o, &f, truth_error()));
    for (int half = 0; half < 2; half++) {
        double mean = 0.0, truth = 0.0;
        for (int k = 0; k < WIDE * WIDE / 2; k++) {
            int i = k + half * WIDE * WIDE / 2;
            double x = ((i % WIDE + 0.5) / WIDE - 0.5) * 0.1;
            double y = ((i / WIDE + 0.5) / WIDE - 0.5) * 0.1;
            double far = sqrt(1.0 + x * x + y * y);
            double enter = 4.0 / far -
                           sqrt(1.0 - 16.0 * (1.0 - 1.0 / (far * far)));
            double z = (double)depth[i] * (along_ray ? 1.0 : far);
            double t = exp(-0.8 * (z - enter));
            mean += (double)f.radiance[3 * i + 1];
            truth += 1.0 - t + 3.0 * t;
        }
        if (!(fabs(mean / truth - 1.0) < most))
            fail_msg("%s, half %d: %g of the truth", what, half, mean / truth);
    }
    brume_frame_free(&f);
    brume_scene_free(s);
}

static void plate__furnace(void **state)
{
    (void)state;
    for (int ray = 0; ray < 2; ray++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        o.spp = 1024;
        check_furnace("path", &o, ray, 4e-3);
        o.integrator = BRUME_INTEGRATOR_PHOTON;
        o.photons.count = 400000;
        o.spp = 16;
        check_furnace("photon", &o, ray, 2e-2);
        o.integrator = BRUME_INTEGRATOR_PROGRESSIVE;
        o.photons.count = 50000;
        o.spp = 4;
        check_furnace("progressive", &o, ray, 2e-2);
        o.integrator = BRUME_INTEGRATOR_PHOTON;
        brume_photons_paper(&o.photons);
        o.photons.count = 400000;
        check_furnace("paper", &o, ray, 4e-2);
    }
}

/* A lamp from the side: what is before the plate is that of a box that ends
 * there, by the sampler of light scattered once and by flights. */
static void plate__lit_from_aside(void **state)
{
    (void)state;
    for (int multiple = 0; multiple < 2; multiple++) {
        struct estimate e[2];
        for (int cut = 0; cut < 2; cut++) {
            struct brume_globals g = BRUME_GLOBALS_INIT;
            struct brume_light sun = BRUME_LIGHT_INIT;
            struct brume_medium m = truth_medium(multiple ? 0.5 : 0.1, 0.6,
                                                 0.0);
            struct brume_plate p = BRUME_PLATE_INIT;
            g.media_multiple = multiple;
            /* Hardly any is scattered twice. */
            for (int c = 0; multiple && c < 3; c++)
                m.scattering[c] = 1e-3;
            brume_scene *s = truth_scene(&g, 4.0, 1e-3);
            truth_fill(s, truth_box(1.0, -1.0, cut ? 0.25 : 1.0), &m);
            sun.parallel = true;
            sun.location[0] = 100.0;
            sun.point_at[2] = 0.0;
            assert_true(brume_add_light(s, &sun, truth_error()) >= 0);
            for (int i = 0; i < PIXELS; i++) {
                radiance[3 * i] = radiance[3 * i + 1] = 0.0f;
                radiance[3 * i + 2] = 0.0f;
                depth[i] = 4.25f;
            }
            p.width = p.height = SIDE;
            p.radiance = radiance;
            p.depth = cut ? NULL : depth;
            assert_true(brume_set_plate(s, &p, truth_error()));
            e[cut] = truth_render(s, SIDE, 256);
        }
        assert_true(e[1].mean[0] > 1e-4);
        truth_check(multiple ? "flights" : "once", &e[0], e[1].mean[0],
                    e[1].error[0], 8e-2);
    }
}

/* ---- what is refused ---------------------------------------------------- */

static void refuse(struct brume_plate *p, const char *text)
{
    struct brume_error err = {0};
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f = {0};
    struct brume_plan plan;
    brume_scene *s = truth_scene(&g, 4.0, 1.0);
    o.width = o.height = SIDE;
    o.spp = 1;
    if (brume_set_plate(s, p, &err)) {
        struct brume_error again = {0};
        assert_false(brume_render(s, &o, &f, &err));
        assert_false(brume_plan_frame(s, &o, &plan, &again));
        assert_string_equal(again.text, err.text);
    }
    assert_int_equal(err.code, BRUME_ERR_SCENE);
    if (!strstr(err.text, text))
        fail_msg("%s, not %s", err.text, text);
    brume_scene_free(s);
}

static void plate__refused(void **state)
{
    (void)state;
    struct brume_plate p;
    fill_plate(&p);
    p.height = SIDE - 1;
    refuse(&p, "the plate has 16 x 15 pixels, the picture 16 x 16");
    p.height = 0;
    refuse(&p, "a plate of 16 x 0 pixels is not possible");
    fill_plate(&p);
    radiance[7] = INFINITY;
    refuse(&p, "radiance is inf at pixel 2");
    fill_plate(&p);
    p.alpha = alpha;
    alpha[5] = 1.5f;
    refuse(&p, "alpha is 1.5 at pixel 5");
}

/* Nothing is kept for it where there is none; and it is left out again. */
static void plate__plan(void **state)
{
    (void)state;
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_plate p, none = BRUME_PLATE_INIT;
    struct brume_plan plan;
    o.width = o.height = SIDE;
    fill_plate(&p);
    brume_scene *s = truth_scene(&g, 4.0, 1.0);
    for (int k = 0; k < 3; k++) {
        if (k > 0)
            assert_true(brume_set_plate(s, k == 1 ? &p : &none, truth_error()));
        assert_true(brume_plan_frame(s, &o, &plan, truth_error()));
        int i = 0;
        while (i < plan.stages && strcmp(plan.stage[i].name, "composite"))
            i++;
        assert_true(i < plan.stages);
        assert_int_equal(plan.stage[i].runs, k == 1);
        assert_int_equal(plan.stage[i].bytes, k == 1 ? 20 * PIXELS : 0);
    }
    brume_scene_free(s);
}

/* ---- files -------------------------------------------------------------- */

static void plate__file_in_tiles(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct plate *p = plate_load("tests/data/plate.exr", NULL, &err);
    if (!p)
        fail_msg("%s", err.text);
    assert_int_equal(p->width, 160);
    assert_int_equal(p->height, 120);
    assert_null(p->alpha);
    assert_int_equal(p->faulty + p->depthless, 0);
    for (int y = 0; y < 120; y++)
        for (int x = 0; x < 160; x++) {
            int i = 160 * y + x;
            assert_true(p->radiance[3 * i] == (float)(x + 1) / 256.0f);
            assert_true(p->radiance[3 * i + 1] == (float)(y + 1) / 128.0f);
            assert_true(p->radiance[3 * i + 2] == 3.0f);
            assert_true(y < 119 ? fabsf(p->depth[i] - 3.0f - (float)x / 40.0f) <
                                      1e-6f
                                : isinf(p->depth[i]));
        }
    plate_free(p);
}

static void plate__file_with_layers(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct plate *p = plate_load("tests/data/plate_layers.exr", "ViewLayer",
                                 &err);
    if (!p)
        fail_msg("%s", err.text);
    assert_int_equal(p->width, 160);
    assert_int_equal(p->height, 120);
    assert_int_equal(p->faulty, 1);
    assert_int_equal(p->depthless, 3);
    for (int y = 0; y < 120; y++)
        for (int x = 0; x < 160; x++) {
            int i = 160 * y + x;
            bool in = x >= 1 && x <= 5 && y >= 2 && y <= 4;
            bool bad = x == 2 && y == 3, deep = y == 2 && x < 5;
            float a = !in ? 0.0f : bad || (x + y) % 2 == 0 ? 1.0f : 0.5f;
            assert_true(p->alpha[i] == a);
            float c = bad ? 0.0f : a;
            assert_true(p->radiance[3 * i] == c * (float)x);
            assert_true(p->radiance[3 * i + 1] == c * (float)y);
            assert_true(p->radiance[3 * i + 2] == c * 0.25f);
            assert_true(in && !deep ? p->depth[i] == (float)(x + 10 * y)
                                    : isinf(p->depth[i]));
        }
    plate_free(p);
}

static void expect_no_plate(const char *path, const char *layer,
                            const char *text)
{
    struct brume_error err = {0};
    assert_null(plate_load(path, layer, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    assert_string_equal(err.file, path);
    if (!strstr(err.text, text))
        fail_msg("%s, not %s", err.text, text);
}

static void plate__bad_files(void **state)
{
    (void)state;
    char path[] = "/tmp/brume-test-XXXXXX";
    static char bytes[1 << 16];
    FILE *from = fopen("tests/data/plate.exr", "rb");
    assert_non_null(from);
    size_t size = fread(bytes, 1, sizeof bytes, from);
    fclose(from);
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    for (size_t cut = 0; cut < size; cut += 1 + size / 23) {
        assert_int_equal(ftruncate(fd, 0), 0);
        assert_int_equal(pwrite(fd, bytes, cut, 0), cut);
        expect_no_plate(path, NULL, "");
    }
    close(fd);
    unlink(path);
    expect_no_plate("tests/data/plate_layers.exr", NULL,
                    "has neither the channels R, G and B nor Y; its channels "
                    "are ViewLayer.Combined.A, ");
    expect_no_plate("tests/data/plate_layers.exr", "View",
                    "has no layer 'View' with channels R, G and B, or Y");
    expect_no_plate("tests/data/uint.exr", NULL, "its channels are R, id");
    expect_no_plate("tests/data/none.exr", NULL, "");
}

/* ---- the language ------------------------------------------------------- */

static struct parse_plate given;

static brume_scene *scene(const char *text, struct diag *diag)
{
    struct parse_result result = {0};
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = strlen(text),
                             .plate = given,
                             .ambient = PARSE_AMBIENT_INIT};
    diag_init(diag);
    return parse_scene(&in, &result, diag) ? result.scene : NULL;
}

#define BOX                                                                    \
    "camera { location <0, 0, -4> direction z up 0.3*y right 0.4*x }\n"        \
    "box { <-9, -9, -1>, <9, 9, 1> hollow pigment { rgbt 1 }\n"                \
    "  interior { media { emission 0.5 absorption 0.4 } } }\n"

/* The picture of OpenEXR's ramp in a box, from the scene's text: its depth is
 * along the axis, along rays, or none. */
static void check_ramp(const char *background, int kind)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    struct diag diag;
    char text[600];
    snprintf(text, sizeof text, "%s%s", background, BOX);
    brume_scene *s = scene(text, &diag);
    if (!s || diag.first)
        fail_msg("%s: %s", background, diag.first->text);
    o.width = 160;
    o.height = 120;
    o.spp = 1;
    assert_true(brume_render(s, &o, &f, truth_error()));
    for (int i = 0; i < 160 * 120; i++) {
        double x = 0.4 * ((i % 160 + 0.5) / 160.0 - 0.5);
        double y = 0.3 * ((i / 160 + 0.5) / 120.0 - 0.5);
        double far = sqrt(1.0 + x * x + y * y), z = 3.0 + i % 160 / 40.0;
        double end = kind == 1 ? z : z * far;
        if (kind == 2 || i / 160 == 119)
            end = INFINITY;
        double t = exp(-0.4 * fmax(fmin(end, 5.0 * far) - 3.0 * far, 0.0));
        double own[3] = {(i % 160 + 1) / 256.0, (i / 160 + 1) / 128.0, 3.0};
        for (int c = 0; c < 3; c++)
            check(background, i, c, (double)f.radiance[3 * i + c],
                  t * own[c] + (1.0 - t) * 1.25);
    }
    brume_frame_free(&f);
    brume_scene_free(s);
    diag_release(&diag);
}

#define RAMP "tests/data/plate.exr"

static void plate__language(void **state)
{
    (void)state;
    check_ramp("background { exr \"" RAMP "\" }", 0);
    check_ramp("background { rgb 1 depth axis exr \"" RAMP "\" }", 0);
    check_ramp("background { exr \"" RAMP "\" depth ray }", 1);
    check_ramp("background { exr \"" RAMP "\" depth none }", 2);
    check_ramp("background { exr \"none.exr\" depth ray layer \"A\" }\n"
               "background { exr concat(\"tests/data/\", \"plate.exr\") }\n"
               "background { rgb 1 }\n",
               0);
    given = (struct parse_plate){.path = RAMP};
    check_ramp("background { exr \"none.exr\" depth ray layer \"A\" }", 0);
    given.depth = PARSE_DEPTH_RAY;
    check_ramp("", 1);
    given.path = NULL;
    check_ramp("background { exr \"" RAMP "\" depth none }", 1);
    given = (struct parse_plate){0};
}

static void expect_said(const char *text, const char *file, int line,
                        int column, enum brume_code code, const char *said)
{
    struct diag diag;
    brume_scene *s = scene(text, &diag);
    const struct diag_item *first = diag.first;
    assert_int_equal(s == NULL, code != BRUME_OK);
    assert_int_equal(diag.code, code);
    if (!first || !strstr(first->text, said))
        fail_msg("%s, not %s", first ? first->text : "nothing", said);
    assert_int_equal(first->line, line);
    assert_int_equal(first->column, column);
    if (file)
        assert_string_equal(first->file, file);
    else
        assert_null(first->file);
    brume_scene_free(s);
    diag_release(&diag);
}

#define LAYERS "tests/data/plate_layers.exr"

static void plate__diagnostics(void **state)
{
    (void)state;
    expect_said("background { exr \"none.exr\" }", "scene.pov", 1, 18,
                BRUME_ERR_FILE, "file 'none.exr' not found");
    expect_said("\nbackground { exr \"tests/data/dots.png\" }", "scene.pov", 2,
                18, BRUME_ERR_FILE, "dots.png");
    expect_said("background { exr \"tests/data/tiled_half.exr\" }", "scene.pov",
                1, 18, BRUME_ERR_SCENE,
                "the plate has 40 x 23 pixels, the picture 160 x 120");
    expect_said("background { exr \"" LAYERS "\" layer \"ViewLayer\" }",
                "scene.pov", 1, 18, BRUME_OK, "1 pixels of the plate are no");
    expect_said("background { exr \"" LAYERS "\" }", "scene.pov", 1, 18,
                BRUME_ERR_FILE, "neither the channels R, G and B nor Y");
    expect_said("background { exr 2 }", "scene.pov", 1, 14, BRUME_ERR_SCENE,
                "'exr' needs the name of a file");
    expect_said("background { rgb 1 depth }", "scene.pov", 1, 20,
                BRUME_ERR_SCENE, "");
    given = (struct parse_plate){.path = "none.exr"};
    expect_said("", NULL, 0, 0, BRUME_ERR_FILE, "none.exr");
    given.path = "tests/data/tiled_half.exr";
    expect_said("", NULL, 0, 0, BRUME_ERR_SCENE,
                "the plate has 40 x 23 pixels");
    given.path = LAYERS;
    given.layer = "ViewLayer";
    expect_said("", NULL, 0, 0, BRUME_OK, "1 pixels of the plate are no");
    given = (struct parse_plate){0};
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plate__in_a_box),
        cmocka_unit_test(plate__behind_everything),
        cmocka_unit_test(plate__among_surfaces),
        cmocka_unit_test(plate__furnace),
        cmocka_unit_test(plate__lit_from_aside),
        cmocka_unit_test(plate__refused),
        cmocka_unit_test(plate__plan),
        cmocka_unit_test(plate__file_in_tiles),
        cmocka_unit_test(plate__file_with_layers),
        cmocka_unit_test(plate__bad_files),
        cmocka_unit_test(plate__language),
        cmocka_unit_test(plate__diagnostics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
