/* Light straight from lights in the cells of the field, and what paths seek of
 * the rest: lamps that fall off against closed forms, near the eye's rays and
 * far from them, and all of it against the path tracer; with less noise. */
#include <string.h>
#include "parser/parse.h"
#include "tests/unit/truth.h"

enum { WIDE = 8 };

static struct brume_options options(enum brume_integrator integrator, int spp)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.width = o.height = WIDE;
    o.integrator = integrator;
    o.photons.count = 20000;
    o.spp = spp;
    return o;
}

/* Of a picture that is the same all over, which is freed. */
static struct estimate estimate_in(struct brume_frame *f)
{
    struct estimate e = {.opacity = 0.0};
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < WIDE * WIDE; i++) {
            double x = (double)f->radiance[3 * i + c];
            sum += x;
            squares += x * x;
        }
        e.mean[c] = sum / (WIDE * WIDE);
        e.error[c] = sqrt(
            fmax(squares / (WIDE * WIDE) - e.mean[c] * e.mean[c], 0.0) /
            (WIDE * WIDE - 1));
    }
    e.stats = f->stats;
    brume_frame_free(f);
    return e;
}

static struct estimate estimate_of(brume_scene *s,
                                   const struct brume_options *o)
{
    struct brume_frame f;
    assert_true(brume_render(s, o, &f, truth_error()));
    return estimate_in(&f);
}

/* ---- closed forms -------------------------------------------------------- */

#define SIGMA_S 1e-4
#define SIGMA_A 0.3

/* A lamp at `off` beside the eye's ray, in the middle of a box that hardly
 * scatters twice: Int sigma_s C / (4 d^2) exp(-sigma (t + d)) along it. */
static double lamp_truth(double off)
{
    enum { STEPS = 200000 };
    double sum = 0.0, step = 2.0 / STEPS;
    for (int i = 0; i < STEPS; i++) {
        double t = (i + 0.5) * step, z = t - 1.0;
        double d = sqrt(z * z + off * off);
        sum += exp(-(SIGMA_A + SIGMA_S) * (t + d)) / (d * d);
    }
    return 0.25 * SIGMA_S * sum * step;
}

static brume_scene *lamp_scene(double off)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_medium m = truth_medium(SIGMA_A, SIGMA_S, 0.0);
    g.media_multiple = g.physical_units = true;
    brume_scene *s = truth_scene(&g, 5.0, 1e-5);
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    l.location[0] = off;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    return s;
}

/* Cells are 1/32 wide: lamps in one with the ray, beside it and far off. */
static void photon_lit__lamps(void **state)
{
    (void)state;
    static const double off[] = {0.003, 0.02, 0.1, 0.5};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) {
        struct brume_options o = options(BRUME_INTEGRATOR_PHOTON, 2048);
        brume_scene *s = lamp_scene(off[i]);
        struct estimate e = estimate_of(s, &o);
        double truth = lamp_truth(off[i]);
        truth_check("lamp", &e, truth, 1e-3 * truth, 0.01);
        brume_scene_free(s);
    }
}

/* ---- beside the path tracer --------------------------------------------- */

static brume_scene *scene(const char *text)
{
    struct parse_result result = {0};
    struct diag diag;
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = strlen(text),
                             .ambient = PARSE_AMBIENT_INIT,
                             .full_transport = true};
    diag_init(&diag);
    if (!parse_scene(&in, &result, &diag))
        fail_msg("%s", diag.first->text);
    diag_release(&diag);
    return result.scene;
}

/* A frame whose field is filtered with those beside it. */
static struct estimate filtered_of(const char *text, struct brume_options o)
{
    struct brume_film *film = brume_film_new(NULL, truth_error());
    struct brume_frame f;
    assert_true(brume_film_taps(&o.photons, 3));
    for (o.frame = 0; o.frame < 3; o.frame++)
        assert_true(brume_film_push(film, scene(text), &o, o.frame == 1,
                                    truth_error()));
    assert_true(brume_film_ask(film, 1, 0, 2, truth_error()) &&
                brume_film_next(film, &f, truth_error()));
    brume_film_free(film);
    return estimate_in(&f);
}

/* Hardly anything is scattered twice: what is compared is light that is
 * scattered once. The error at most a part of the path tracer's. */
static void check_paths(const char *what, const char *text, double part)
{
    char all[2000];
    snprintf(all, sizeof all,
             "camera { location -5*z right x*1e-3 up y*1e-3 direction z }\n%s",
             text);
    brume_scene *s = scene(all);
    struct brume_options o = options(BRUME_INTEGRATOR_PATH, 4096);
    struct estimate truth = estimate_of(s, &o);
    o.spp = 256;
    struct estimate path = estimate_of(s, &o);
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    struct estimate e = estimate_of(s, &o);
    assert_true(truth.mean[0] > 0.0);
    struct estimate film = filtered_of(all, o);
    double u = truth.error[0] + 2e-3 * truth.mean[0];
    truth_check(what, &e, truth.mean[0], u, 0.05);
    truth_check(what, &film, truth.mean[0], u, 0.05);
    double worst = fmax(e.error[0], film.error[0]);
    if (!(worst < part * path.error[0]))
        fail_msg("%s: error %g, in a film %g, of paths %g", what, e.error[0],
                 film.error[0], path.error[0]);
    brume_scene_free(s);
}

#define THIN "scattering { 1, 0.001 } absorption 0.3"

static void photon_lit__falling_off(void **state)
{
    (void)state;
    check_paths("fade",
                "light_source { <0.2, 0.3, 0> 1 fade_distance 0.3 "
                "fade_power 2 }\n"
                "box { -1, 1 hollow pigment { rgbt 1 } interior {"
                "  media { " THIN " } } }",
                0.6);
    check_paths("a spot in a wood of lights",
                "#for (I, 1, 12) light_source { <sin(I), 1, cos(I)> rgb I/12 "
                "  spotlight point_at 0 radius 20 falloff 40 "
                "  fade_distance 0.5 fade_power 1 } #end\n"
                "light_source { <5, 5, -5> 1 }"
                "box { -1, 1 hollow pigment { rgbt 1 } interior {"
                "  media { " THIN " } } }",
                0.02);
}

static void photon_lit__functions(void **state)
{
    (void)state;
    check_paths("a function",
                "light_source { <5, 5, -5> 1 parallel point_at 0 }\n"
                "box { -1, 1 hollow pigment { rgbt 1 } interior {"
                "  media { " THIN " density { function { 1 + z } } } } }",
                0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_lit__lamps),
        cmocka_unit_test(photon_lit__falling_off),
        cmocka_unit_test(photon_lit__functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
