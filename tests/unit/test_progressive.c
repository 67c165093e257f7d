/* The integrator progressive: its error goes down to what cannot be told from
 * the path tracer's, where a field of the same cells keeps its bias. */
#include "tests/unit/truth.h"
#include <stdlib.h>
#include <string.h>

enum { SIDE = 12, PIXELS = SIDE * SIDE };

static struct brume_globals full_transport(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    return g;
}

static void add_light(brume_scene *s, double c)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[0] = 3.0;
    l.location[1] = 4.0;
    l.location[2] = -2.0;
    l.color[0] = l.color[1] = l.color[2] = c;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
}

static void add_surface(brume_scene *s, struct brume_shape shape)
{
    struct brume_material m = BRUME_MATERIAL_INIT;
    for (int i = 0; i < 3; i++) {
        m.color[0][i] = 0.2 + 0.3 * i;
        m.ambient[i] = 0.0;
    }
    m.diffuse = 1.0;
    shape.material = brume_add_material(s, &m, truth_error());
    assert_true(brume_add_shape(s, &shape, truth_error()) >= 0);
}

/* Thick and peaked: the eye's cells hold what goes to it. */
static brume_scene *peaked_box(void)
{
    struct brume_globals g = full_transport();
    brume_scene *s = truth_scene(&g, 5.0, 0.5);
    struct brume_medium m = truth_medium(0.1, 4.0, 0.6);
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    add_light(s, 1.0);
    return s;
}

/* A coloured ball in it, which lights the medium and is lit by it: rays that
 * it sends on are paths where the medium is peaked. */
static brume_scene *box_with_ball(double g)
{
    struct brume_globals globals = full_transport();
    brume_scene *s = truth_scene(&globals, 5.0, 0.5);
    struct brume_medium m = truth_medium(0.1, 2.0, g);
    struct brume_shape b = BRUME_SHAPE_INIT;
    b.kind = BRUME_SHAPE_SPHERE;
    b.radius = 0.5;
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    add_surface(s, b);
    add_light(s, 1.0);
    return s;
}

/* Two media in one place that scatter each in its way, one of which glows: the
 * cells keep what goes to the eye by each. */
static brume_scene *mixed_box(void)
{
    struct brume_globals g = full_transport();
    g.background[2] = 0.3;
    brume_scene *s = truth_scene(&g, 5.0, 0.5);
    struct brume_medium m[2] = {truth_medium(0.1, 1.5, 0.0),
                                truth_medium(0.1, 1.5, 0.8)};
    struct brume_shape box = truth_box(1.0, -1.0, 1.0);
    int id[2];
    m[0].emission[0] = 0.2;
    for (int i = 0; i < 2; i++)
        id[i] = brume_add_medium(s, &m[i], truth_error());
    box.interior = brume_add_interior(s, id, 2, truth_error());
    box.hollow = true;
    assert_true(brume_add_shape(s, &box, truth_error()) >= 0);
    add_light(s, 1.0);
    return s;
}

static void render_seed(brume_scene *s, enum brume_integrator integrator,
                        int spp, uint64_t photons, uint64_t seed,
                        struct brume_frame *f)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = integrator;
    o.width = o.height = SIDE;
    o.spp = spp;
    o.photons.count = photons;
    o.photons.spacing = 0.4;
    o.seed = seed;
    assert_true(brume_render(s, &o, f, truth_error()));
}

static void render(brume_scene *s, enum brume_integrator integrator, int spp,
                   uint64_t photons, struct brume_frame *f)
{
    render_seed(s, integrator, spp, photons, 11 + (uint64_t)integrator, f);
}

/* The path tracer's picture, of two seeds, whose difference tells its noise. */
struct reference {
    float radiance[3 * PIXELS];
    double noise;
};

static void make_reference(brume_scene *s, struct reference *r)
{
    struct brume_frame f[2];
    double mean = 0.0, sum = 0.0;
    for (int i = 0; i < 2; i++)
        render_seed(s, BRUME_INTEGRATOR_PATH, 6000, 0, 7 + (uint64_t)i, &f[i]);
    for (int i = 0; i < 3 * PIXELS; i++) {
        r->radiance[i] = 0.5f * (f[0].radiance[i] + f[1].radiance[i]);
        mean += (double)r->radiance[i] / (3 * PIXELS);
    }
    for (int i = 0; i < 3 * PIXELS; i++) {
        double is = (double)r->radiance[i];
        double d = 0.5 * ((double)f[0].radiance[i] - (double)f[1].radiance[i]);
        sum += d * d / (is * is + 0.01 * mean * mean) / (3 * PIXELS);
    }
    r->noise = sqrt(sum);
    brume_frame_free(&f[0]);
    brume_frame_free(&f[1]);
}

/* relRMSE against the reference, without its noise. */
static double error_of(const struct brume_frame *f,
                       const struct reference *reference)
{
    double mean = 0.0, sum = 0.0;
    for (int i = 0; i < 3 * PIXELS; i++)
        mean += (double)reference->radiance[i] / (3 * PIXELS);
    for (int i = 0; i < 3 * PIXELS; i++) {
        double r = (double)reference->radiance[i];
        double d = (double)f->radiance[i] - r;
        sum += d * d / (r * r + 0.01 * mean * mean) / (3 * PIXELS);
    }
    double square = sum - reference->noise * reference->noise;
    return sqrt(fmax(square, 1e-8));
}

/* From 4 to 256 passes the error falls by their power `slope` or faster: by
 * -0.32 to -0.34 here, where the first cells are wider than a mean free path.
 * The noise of fields falls as -0.37 where pixels are finer than cells, else as
 * -0.5, as all other does. A field of as many photons, whose cells stay, keeps
 * four to seven times the error. */
static void check_slope(brume_scene *s, const char *what, double most)
{
    enum { PHOTONS = 4000 };
    const int passes[2] = {4, 256};
    struct reference reference;
    struct brume_frame f;
    double error[2], field;
    make_reference(s, &reference);
    for (int i = 0; i < 2; i++) {
        render(s, BRUME_INTEGRATOR_PROGRESSIVE, passes[i], PHOTONS, &f);
        assert_true(f.stats.photons.traced == (uint64_t)passes[i] * PHOTONS);
        error[i] = error_of(&f, &reference);
        brume_frame_free(&f);
    }
    render(s, BRUME_INTEGRATOR_PHOTON, 256, 256 * PHOTONS, &f);
    field = error_of(&f, &reference);
    double slope = log(error[1] / error[0]) / log(64.0);
    if (!(slope < most) || !(error[1] < 0.35 * field) ||
        !(reference.noise < 1.5 * error[1]))
        fail_msg(
            "%s: 4 passes %.4f, 256 %.4f, slope %.2f; a field %.4f; path %.4f",
            what, error[0], error[1], slope, field, reference.noise);
    brume_frame_free(&f);
    brume_scene_free(s);
}

static void progressive__converges_in_peaked_media(void **state)
{
    (void)state;
    check_slope(peaked_box(), "peaked", -0.30);
}

static void progressive__converges_around_surfaces(void **state)
{
    (void)state;
    check_slope(box_with_ball(0.0), "even, surface", -0.30);
    check_slope(box_with_ball(0.6), "peaked, surface", -0.30);
}

static void progressive__converges_in_mixed_media(void **state)
{
    (void)state;
    check_slope(mixed_box(), "mixed", -0.30);
}

/* Each pass has photons and cells of its own: its estimate of the error knows
 * the noise of the fields, that of photon does not. */
static void progressive__estimate_knows_the_fields(void **state)
{
    (void)state;
    brume_scene *s = peaked_box();
    struct reference reference;
    struct brume_frame f;
    make_reference(s, &reference);
    render(s, BRUME_INTEGRATOR_PROGRESSIVE, 64, 200, &f);
    double truth = error_of(&f, &reference);
    if (!(f.stats.error > 0.5 * truth) || !(f.stats.error < 1.5 * truth))
        fail_msg("estimated %.4f, true %.4f", f.stats.error, truth);
    brume_frame_free(&f);
    brume_scene_free(s);
}

static void progressive__threads_change_no_bit(void **state)
{
    (void)state;
    float first[3 * PIXELS];
    for (int threads = 1; threads <= 3; threads++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        struct brume_frame f;
        brume_scene *s = box_with_ball(0.6);
        o.integrator = BRUME_INTEGRATOR_PROGRESSIVE;
        o.width = o.height = SIDE;
        o.spp = 6;
        o.photons.count = 2000;
        o.threads = threads;
        assert_true(brume_render(s, &o, &f, truth_error()));
        if (threads == 1)
            memcpy(first, f.radiance, sizeof first);
        assert_memory_equal(first, f.radiance, sizeof first);
        brume_frame_free(&f);
        brume_scene_free(s);
    }
}

/* Cells stay as large as --memory asks for. */
static void progressive__keeps_to_memory(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        struct brume_frame f;
        brume_scene *s = peaked_box();
        o.integrator = BRUME_INTEGRATOR_PROGRESSIVE;
        o.width = o.height = SIDE;
        o.spp = 12;
        o.photons.count = 1000;
        o.memory = i == 0 ? 0 : 2 << 20;
        assert_true(brume_render(s, &o, &f, truth_error()));
        assert_int_equal(f.stats.photons.traced, 12000);
        assert_true(i == 0 ? f.stats.bytes > 2 << 20
                           : f.stats.bytes <= o.memory);
        brume_frame_free(&f);
        brume_scene_free(s);
    }
}

/* What the published choices have beyond their balls is no part of it. */
static void progressive__refuses_what_it_lacks(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        struct brume_error err = {0};
        struct brume_frame f;
        brume_scene *s = peaked_box();
        o.integrator = BRUME_INTEGRATOR_PROGRESSIVE;
        o.width = o.height = SIDE;
        o.spp = 2;
        if (i == 0)
            o.photons.single = BRUME_SINGLE_FIELD;
        else
            o.photons.emission = BRUME_EMISSION_PHOTONS;
        assert_false(brume_render(s, &o, &f, &err));
        assert_int_equal(err.code, BRUME_ERR_USAGE);
        assert_non_null(strstr(err.text, "progressive"));
        brume_scene_free(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(progressive__converges_in_peaked_media),
        cmocka_unit_test(progressive__converges_around_surfaces),
        cmocka_unit_test(progressive__converges_in_mixed_media),
        cmocka_unit_test(progressive__estimate_knows_the_fields),
        cmocka_unit_test(progressive__threads_change_no_bit),
        cmocka_unit_test(progressive__keeps_to_memory),
        cmocka_unit_test(progressive__refuses_what_it_lacks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
