/* Cells of the field that the eye can see, and photons that they gather,
 * counted by brute force. */
#include "tests/unit/heap_scene.h"
#include "tests/unit/truth_flat.h"
#include <stdlib.h>
#include <string.h>
#include "core/photons.h"
#include "core/physics/far.h"
#include "core/radiance.h"

enum { SIDE = 12, PIXELS = SIDE * SIDE };

/* Where the deep box begins and ends, before the eye. */
#define NEAR 5.0
#define DEEP 20.0
#define SIGMA 2.0

/* A view into a box that goes on far behind what is opaque. */
static brume_scene *deep_box(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.environment = true;
    brume_scene *s = truth_scene(&g, NEAR, 0.15);
    struct brume_medium m = truth_medium(0.2, SIGMA - 0.2, 0.3);
    truth_fill(s, truth_box(3.0, 0.0, DEEP), &m);
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[0] = 8.0;
    l.location[1] = 6.0;
    l.location[2] = 2.0;
    l.color[0] = l.color[1] = l.color[2] = 1.0;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    return s;
}

static struct brume_options options(enum brume_gather gather, bool far)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.width = o.height = SIDE;
    o.spp = 2;
    o.photons.count = 20000;
    o.photons.gather = gather;
    o.photons.spacing = 0.2;
    o.photons.far_plane = far;
    return o;
}

/* The point's place in the picture, 1/2 being its edges, and its depth. */
static void project(const camera *c, vec3 p, double out[3])
{
    vec3 v = vec3_sub(p, c->location);
    double size = (double)vec3_dot(c->direction, c->direction);
    double depth = (double)vec3_dot(v, c->direction) / size;
    out[0] = (double)vec3_dot(v, c->right) /
             ((double)vec3_dot(c->right, c->right) * depth);
    out[1] = (double)vec3_dot(v, c->up) /
             ((double)vec3_dot(c->up, c->up) * depth);
    out[2] = depth * sqrt(size);
}

/* Whether some point of the brick, grown by `grow` cells, is seen before
 * `far`; the picture grown by `wide` units to each side. */
static bool brick_seen(const struct flat *f, const int at[3], double grow,
                       double wide, double far)
{
    enum { POINTS = 24 };
    const radiance_lattice *l = &f->view.field;
    const camera *c = &f->view.view;
    double side = (double)l->side, size = (double)vec3_length(c->direction);
    for (int k = 0; k <= POINTS; k++)
        for (int j = 0; j <= POINTS; j++)
            for (int i = 0; i <= POINTS; i++) {
                const int n[3] = {i, j, k};
                double x[3], seen[3];
                for (int a = 0; a < 3; a++)
                    x[a] = (double)l->origin[a] +
                           side * (8.0 * at[a] - grow +
                                   (8.0 + 2.0 * grow) * n[a] / POINTS);
                project(c, vec3_make((float)x[0], (float)x[1], (float)x[2]),
                        seen);
                if (!(seen[2] > -wide) || !(seen[2] < far + wide))
                    continue;
                /* A plane moved out by `wide`, at that depth. */
                double edge = 0.5 +
                              1.2 * wide * size /
                                  (seen[2] * (double)vec3_length(c->right));
                if (fabs(seen[0]) < edge && fabs(seen[1]) < edge)
                    return true;
            }
    return false;
}

static double far_truth(const struct flat *f, double opacity_depth)
{
    return (NEAR + opacity_depth / SIGMA) * f->unit;
}

/* All that the eye sees is there, and no brick is that lies clear of the view
 * by more than its margins. */
static void check_bricks(const struct flat *f, double nearest, double farthest)
{
    const radiance_lattice *l = &f->view.field;
    const double margin = 1.8 * (double)l->side;
    int stored = 0, all = 0;
    for (int z = 0; z < l->bricks[2]; z++)
        for (int y = 0; y < l->bricks[1]; y++)
            for (int x = 0; x < l->bricks[0]; x++) {
                const int at[3] = {x, y, z};
                bool there = radiance_cell(&f->view, 8 * x, 8 * y, 8 * z) >= 0;
                if (brick_seen(f, at, 0.5, 0.0, nearest) && !there)
                    fail_msg("brick %d %d %d is seen, and is not there", x, y,
                             z);
                if (!brick_seen(f, at, 1.0, margin, farthest) && there)
                    fail_msg("brick %d %d %d is there, and out of sight", x, y,
                             z);
                stored += there;
                all++;
            }
    assert_true(stored > 4 && stored < all);
}

static void photon_frustum__cells_are_those_in_view(void **state)
{
    (void)state;
    for (int far = 0; far < 2; far++) {
        brume_scene *s = deep_box();
        struct brume_options o = options(BRUME_GATHER_TALLY, far != 0);
        struct flat *f = truth_layout(s, &o);
        /* Told to a part of the stretch. */
        if (far)
            check_bricks(f, 0.97 * far_truth(f, 9.21),
                         far_truth(f, 9.21) + DEEP / 20.0 * f->unit);
        else
            check_bricks(f, INFINITY, INFINITY);
        flat_free(f);
        brume_scene_free(s);
    }
}

/* Whether an event at p lies in the ball of a cell that is there. */
static bool gathered(const struct flat *f, vec3 p)
{
    const radiance_lattice *l = &f->view.field;
    for (uint64_t b = 0; b < f->radiance_slots_count; b++)
        for (int i = 0; f->radiance_slots[b] >= 0 && i < 512; i++) {
            vec3 off = vec3_sub(radiance_middle(&f->view, b, i), p);
            if (vec3_length(off) <= l->radius)
                return true;
        }
    return false;
}

static void photon_frustum__photons_stored_are_those_gathered(void **state)
{
    (void)state;
    enum { PHOTONS = 600 };
    for (int far = 0; far < 2; far++) {
        brume_scene *s = deep_box();
        struct brume_options o = options(BRUME_GATHER_BALL, far != 0);
        struct flat *f = truth_layout(s, &o);
        struct photons photons;
        photon_counters c = {0};
        uint64_t stored = 0, events = 0;
        o.photons.count = PHOTONS;
        assert_true(photons_plan(f, &o, 0, &photons, truth_error()));
        c.tally.sum = calloc(f->radiance_count, sizeof(int64_t));
        for (uint64_t i = 0; i < PHOTONS; i++) {
            photon_state p;
            photon_flight flight = {.event = PATH_THROUGH};
            bool alive = photon_begin(&f->view, &photons.job, i, &p, &c);
            while (alive) {
                photon_pass(&f->view, &p, &c, &flight);
                bool first = p.light >= 0;
                alive = photon_land(&f->view, &p, &c, &flight);
                /* First events of lights are theirs, not photons'. */
                if (c.events > events && !first)
                    stored += gathered(f, p.path.o);
                events = c.events;
            }
        }
        assert_true(stored > 50 && stored < events);
        assert_int_equal(c.stored, stored);
        free(c.tally.sum);
        photons_release(&photons);
        flat_free(f);
        brume_scene_free(s);
    }
}

/* What lies behind the far plane passes a ten-thousandth of its light, and
 * this is no brighter than the picture. */
static void photon_frustum__far_plane_changes_nothing_seen(void **state)
{
    (void)state;
    for (int gather = 0; gather < 2; gather++) {
        float first[3 * PIXELS];
        uint64_t cells[2];
        for (int far = 0; far < 2; far++) {
            brume_scene *s = deep_box();
            struct brume_frame f;
            struct brume_options o = options((enum brume_gather)gather,
                                             far != 0);
            assert_true(brume_render(s, &o, &f, truth_error()));
            cells[far] = f.stats.photons.cells;
            float mean = 0.0f;
            for (int i = 0; i < 3 * PIXELS; i++)
                mean += f.radiance[i] / (3 * PIXELS);
            for (int i = 0; far && i < 3 * PIXELS; i++)
                if (!(fabsf(f.radiance[i] - first[i]) <= 3e-4f * mean))
                    fail_msg("gather %d: %g for %g", gather,
                             (double)f.radiance[i], (double)first[i]);
            memcpy(first, f.radiance, sizeof first);
            brume_frame_free(&f);
            brume_scene_free(s);
        }
        assert_true(cells[1] < cells[0] / 2);
    }
}

/* ---- the far plane ------------------------------------------------------ */

/* A thin heap beside a thick one, whose back is hidden. */
static brume_scene *two_heaps(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = true;
    brume_scene *s = truth_scene(&g, 3.0, 0.7);
    struct brume_medium m = truth_medium(1.0, 3.0, 0.0);
    for (int i = 0; i < 2; i++) {
        m.density[0] = heap_add(s, 32, i ? 0.02 : 0.001, i ? 6.0 : 15.0);
        m.densities = 1;
        m.scattering[0] = m.scattering[1] = m.scattering[2] = i ? 3.0 : 90.0;
        truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    }
    heap_sun(s);
    return s;
}

/* As each pixel tells by itself, whoever is asked first. */
static void photon_frustum__far_is_the_farthest_of_all(void **state)
{
    (void)state;
    brume_scene *s = two_heaps();
    struct brume_options o = options(BRUME_GATHER_TALLY, true);
    o.width = 47;
    o.height = 35;
    float most = 0.0f, least = INFINITY;
    struct flat *f = truth_layout(s, &o);
    for (int i = 0; i < o.width * o.height; i++) {
        float far = far_of_pixel(&f->view, o.width, o.height, i % o.width,
                                 i / o.width, 0.0f);
        most = fmaxf(most, far);
        least = fminf(least, far);
    }
    assert_true(least < 0.8f * most);
    for (o.threads = 1; o.threads <= 3; o.threads++) {
        flat_free(f);
        f = truth_layout(s, &o);
        if (!(f->view.field.far == most))
            fail_msg("%d threads: %.9g, not %.9g", o.threads,
                     (double)f->view.field.far, (double)most);
    }
    flat_free(f);
    brume_scene_free(s);
}

/* A plate before the depth where the box is opaque, of that alpha. */
static void hang_plate(brume_scene *s, float depth, float alpha)
{
    static float color[3 * PIXELS], alphas[PIXELS], depths[PIXELS];
    struct brume_plate p = BRUME_PLATE_INIT;
    for (int i = 0; i < PIXELS; i++) {
        color[3 * i] = color[3 * i + 1] = color[3 * i + 2] = 0.02f;
        alphas[i] = alpha;
        depths[i] = depth;
    }
    p.width = p.height = SIDE;
    p.radiance = color;
    p.alpha = alphas;
    p.depth = depths;
    assert_true(brume_set_plate(s, &p, truth_error()));
}

/* Behind what a plate covers nothing is seen; one that passes a part leaves as
 * much less to be seen. */
static void photon_frustum__plates_hide_what_is_behind(void **state)
{
    (void)state;
    const double depth = NEAR + 1.5;
    const float alpha[2] = {1.0f, 0.9f};
    for (int i = 0; i < 2; i++) {
        brume_scene *s = deep_box();
        struct brume_options o = options(BRUME_GATHER_TALLY, true);
        hang_plate(s, (float)depth, alpha[i]);
        struct flat *f = truth_layout(s, &o);
        double far = (double)f->view.field.far;
        double truth = i == 0 ? depth * f->unit
                              : far_truth(f, 9.21034 + log(0.1));
        double part = i == 0 ? 1e-5 : DEEP / 20.0 * f->unit;
        if (!(far >= 0.97 * truth && far <= truth + part))
            fail_msg("alpha %g: %g, not %g", (double)alpha[i], far, truth);
        flat_free(f);
        brume_scene_free(s);
    }
}

/* ... in the picture. */
static void photon_frustum__what_plates_hide_changes_nothing(void **state)
{
    (void)state;
    float first[3 * PIXELS];
    uint64_t cells[2];
    for (int far = 0; far < 2; far++) {
        brume_scene *s = deep_box();
        struct brume_frame f;
        struct brume_options o = options(BRUME_GATHER_TALLY, far != 0);
        hang_plate(s, (float)(NEAR + 1.5), 1.0f);
        assert_true(brume_render(s, &o, &f, truth_error()));
        cells[far] = f.stats.photons.cells;
        for (int i = 0; far && i < 3 * PIXELS; i++)
            if (!(fabsf(f.radiance[i] - first[i]) <= 1e-6f * first[i]))
                fail_msg("%g for %g", (double)f.radiance[i], (double)first[i]);
        memcpy(first, f.radiance, sizeof first);
        brume_frame_free(&f);
        brume_scene_free(s);
    }
    assert_true(cells[1] < cells[0] / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_frustum__cells_are_those_in_view),
        cmocka_unit_test(photon_frustum__photons_stored_are_those_gathered),
        cmocka_unit_test(photon_frustum__far_plane_changes_nothing_seen),
        cmocka_unit_test(photon_frustum__far_is_the_farthest_of_all),
        cmocka_unit_test(photon_frustum__plates_hide_what_is_behind),
        cmocka_unit_test(photon_frustum__what_plates_hide_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
