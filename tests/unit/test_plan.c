/* What a frame's scene does not need: no stage runs for it, and its arrays are
 * empty; with what it needs, both are there. */
#include <string.h>
#include "core/radiance.h"
#include "tests/unit/heap_scene.h"
#include "tests/unit/truth_flat.h"

enum { SIDE = 8 };

static struct brume_options options(void)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.width = o.height = SIDE;
    o.spp = 1;
    o.photons.count = 1000;
    return o;
}

/* A heap in a box: what it emits, if it does, by its temperature. */
static brume_scene *heap(bool fire, double window)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = true;
    brume_scene *s = truth_scene(&g, 5.0, window);
    struct brume_medium m = truth_medium(1.0, 2.0, 0.3);
    m.density[0] = heap_add(s, 16, 0.1, 7.0);
    m.densities = 1;
    m.fire.on = fire;
    if (fire) {
        m.fire.temperature = heap_add(s, 16, 0.1, 7.0);
        m.fire.kelvin_scale = 2000.0;
        m.fire.reference = 2000.0;
    }
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    heap_sun(s);
    return s;
}

/* One medium in all space, and a lamp. */
static brume_scene *fog(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    struct brume_medium m = truth_medium(0.1, 0.2, 0.0);
    brume_scene *s = truth_scene(&g, 5.0, 0.5);
    int medium = brume_add_medium(s, &m, truth_error());
    int interior = brume_add_interior(s, &medium, 1, truth_error());
    assert_true(brume_set_atmosphere(s, interior, truth_error()));
    heap_sun(s);
    return s;
}

/* Whether the stage runs; one that does not takes no byte. */
static bool runs(brume_scene *s, const struct brume_options *o,
                 const char *name)
{
    struct brume_plan plan;
    assert_true(brume_plan_frame(s, o, &plan, truth_error()));
    for (int i = 0; i < plan.stages; i++) {
        if (strcmp(plan.stage[i].name, name) != 0)
            continue;
        assert_true(plan.stage[i].reason[0] != '\0');
        if (plan.stage[i].runs != (plan.stage[i].bytes > 0))
            fail_msg("stage %s takes %zu bytes", name,
                     (size_t)plan.stage[i].bytes);
        return plan.stage[i].runs;
    }
    fail_msg("no stage %s", name);
    return false;
}

static void plan__no_temperature_no_emission_map(void **state)
{
    (void)state;
    for (int fire = 0; fire < 2; fire++) {
        struct brume_options o = options();
        brume_scene *s = heap(fire != 0, 0.5);
        struct flat *f = truth_layout(s, &o);
        assert_int_equal(runs(s, &o, "glow"), fire);
        assert_int_equal(f->glows_count > 0, fire);
        assert_int_equal(f->glow_voxels_count > 0, fire);
        flat_free(f);
        brume_scene_free(s);
    }
}

static void plan__no_geometry_no_tree(void **state)
{
    (void)state;
    for (int box = 0; box < 2; box++) {
        struct brume_options o = options();
        brume_scene *s = box ? heap(false, 0.5) : fog();
        struct flat *f = truth_layout(s, &o);
        assert_int_equal(runs(s, &o, "accel"), box);
        assert_int_equal(f->bvh_count + f->kd_count > 0, box);
        flat_free(f);
        brume_scene_free(s);
    }
}

/* All cells are there where all of the medium is in view. */
static void plan__all_in_view_no_culling(void **state)
{
    (void)state;
    for (int wide = 0; wide < 2; wide++) {
        struct brume_options o = options();
        o.photons.spacing = 0.05;
        brume_scene *s = heap(false, wide ? 2.0 : 0.05);
        struct flat *f = truth_layout(s, &o);
        o.photons.everywhere = true;
        struct flat *all = truth_layout(s, &o);
        assert_int_equal(f->radiance_count == all->radiance_count, wide);
        flat_free(f);
        flat_free(all);
        brume_scene_free(s);
    }
}

/* A ring of as many fields as the filter sees. */
static void plan__a_still_no_ring(void **state)
{
    (void)state;
    for (int taps = 1; taps <= 5; taps += 2) {
        struct brume_options o = options();
        o.photons.taps = taps;
        brume_scene *s = heap(false, 0.5);
        assert_int_equal(runs(s, &o, "filter"), taps > 1);
        brume_scene_free(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plan__no_temperature_no_emission_map),
        cmocka_unit_test(plan__no_geometry_no_tree),
        cmocka_unit_test(plan__all_in_view_no_culling),
        cmocka_unit_test(plan__a_still_no_ring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
