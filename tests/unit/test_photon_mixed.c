/* The integrator photon where media scatter differently: cells keep what goes
 * to the eye by each phase function, and the light straight from lights too. */
#include "tests/unit/truth.h"
#include <string.h>
#include "core/plan.h"
#include "core/prepare.h"

enum { SIDE = 8, PIXELS = SIDE * SIDE, RUNS = 16 };

static void add_light(brume_scene *s, double x, double y, double z)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[0] = x;
    l.location[1] = y;
    l.location[2] = z;
    l.color[0] = l.color[1] = l.color[2] = 1.0;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
}

/* So many media of different g in one box; the last one over half of it. */
static brume_scene *mixed_box(int media, int lights)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    const double lobe[5] = {0.0, 0.85, -0.6, 0.5, 0.3};
    int id[5];
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    brume_scene *s = truth_scene(&g, 5.0, 0.4);
    struct brume_shape box = truth_box(1.0, -1.0, 1.0);
    for (int i = 0; i < media; i++) {
        struct brume_medium m = truth_medium(0.1, 2.0 / media, lobe[i]);
        id[i] = brume_add_medium(s, &m, truth_error());
        assert_true(id[i] >= 0);
    }
    box.interior = brume_add_interior(s, id, media, truth_error());
    box.hollow = true;
    assert_true(brume_add_shape(s, &box, truth_error()) >= 0);
    for (int i = 0; i < lights; i++)
        add_light(s, 3.0 - i, 4.0, i % 2 ? 3.0 : -2.0);
    return s;
}

static void set_up(struct brume_options *o, enum brume_integrator integrator)
{
    *o = (struct brume_options)BRUME_OPTIONS_INIT;
    o->integrator = integrator;
    o->width = o->height = SIDE;
    o->photons.count = 1000000;
}

/* Three numbers for each phase function and kind of light; none of balls. */
static void photon_mixed__cells_keep_each_phase_function(void **state)
{
    (void)state;
    const int numbers[3] = {6, 12, 24}, media[3] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        struct brume_options o;
        struct brume_plan plan;
        char text[64];
        set_up(&o, BRUME_INTEGRATOR_PHOTON);
        brume_scene *s = mixed_box(media[i], 1);
        assert_true(brume_plan_frame(s, &o, &plan, truth_error()));
        snprintf(text, sizeof text, "%d numbers in each", numbers[i]);
        if (!strstr(plan.note[0], text))
            fail_msg("%d media: %s", media[i], plan.note[0]);
        brume_scene_free(s);
    }
}

/* What a picture of some rows shows, on average. */
static double mean_of(const struct brume_frame *f, int first, int rows)
{
    double sum = 0.0;
    for (int i = 3 * SIDE * first; i < 3 * SIDE * (first + rows); i++)
        sum += (double)f->radiance[i] / (3 * SIDE * rows);
    return sum;
}

/* Near the light and far from it. A fluence and a flux would not tell what is
 * peaked forward and backward at once. */
static void photon_mixed__agrees_with_path(void **state)
{
    (void)state;
    struct brume_options o;
    struct brume_frame f, reference;
    brume_scene *s = mixed_box(3, 1);
    set_up(&o, BRUME_INTEGRATOR_PATH);
    o.spp = 16000;
    assert_true(brume_render(s, &o, &reference, truth_error()));
    set_up(&o, BRUME_INTEGRATOR_PHOTON);
    o.spp = 64;
    o.photons.spacing = 0.1;
    assert_true(brume_render(s, &o, &f, truth_error()));
    for (int half = 0; half < 2; half++) {
        double is = mean_of(&f, half * SIDE / 2, SIDE / 2);
        double should = mean_of(&reference, half * SIDE / 2, SIDE / 2);
        if (!(fabs(is / should - 1.0) < 0.03))
            fail_msg("half %d: %.5f, not %.5f", half, is, should);
    }
    brume_frame_free(&f);
    brume_frame_free(&reference);
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_mixed__cells_keep_each_phase_function),
        cmocka_unit_test(photon_mixed__agrees_with_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
