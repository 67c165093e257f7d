/* Fields whose cells are the larger the thinner the media in them are, beside
 * those with cells of one size. */
#include "tests/unit/heap_scene.h"
#include "tests/unit/truth_flat.h"
#include <stdlib.h>
#include <string.h>
#include "core/photons.h"
#include "core/radiance.h"
#include "core/physics/lit_cell.h"

enum { VOXELS = 64, SIDE = 16, PIXELS = SIDE * SIDE };

#define SIGMA 16.0
#define SPACING 0.03125

/* Lit from its left; white walls would look everywhere. */
static brume_scene *heap(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    brume_scene *s = truth_scene(&g, 5.0, 0.45);
    struct brume_medium m = truth_medium(0.01 * SIGMA, 0.99 * SIGMA, 0.0);
    /* 32 voxels a unit: from thick to thin. */
    m.density[0] = heap_add(s, VOXELS, 1.0 / 64.0, 30.0);
    m.densities = 1;
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    heap_sun(s);
    return s;
}

static struct brume_options options_of(double depth)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.width = o.height = SIDE;
    o.spp = 4;
    o.photons.count = 20000;
    o.photons.spacing = SPACING;
    o.photons.depth = depth;
    o.photons.everywhere = true;
    return o;
}

/* With photons laid into it. */
static struct flat *fill(brume_scene *s, const struct brume_options *o)
{
    struct flat *f = truth_layout(s, o);
    struct photons photons;
    photon_counters count;
    memset(&count, 0, sizeof count);
    assert_true(photons_plan(f, o, 0, &photons, truth_error()));
    count.tally.sum = calloc(f->radiance_count, sizeof(int64_t));
    assert_non_null(count.tally.sum);
    photon_run(&f->view, &photons.job, 0, photons.job.count, &count);
    assert_int_equal(count.tally.clipped, 0);
    radiance_resolve(f, count.tally.sum, photons.job.power / 20000);
    free(count.tally.sum);
    photons_release(&photons);
    return f;
}

/* Fluence times volume of a brick, its cells, and the level that they tell of;
 * its own cells by the middles of the smallest there may be. */
static double brick_light(const struct flat *f, const int at[3], int *cells)
{
    const flat_scene *v = &f->view;
    double sum = 0.0;
    int64_t last = -1;
    *cells = 0;
    for (int i = 0; i < 512; i++) {
        int64_t cell = radiance_cell(v, 8 * at[0] + (i & 7),
                                     8 * at[1] + (i >> 3 & 7),
                                     8 * at[2] + (i >> 6));
        if (cell < 0)
            return 0.0;
        sum += (double)f->radiance[cell * v->field.numbers + v->field.fluence];
        *cells += cell > last;
        last = cell > last ? cell : last;
    }
    return sum;
}

/* Extinction times the side of a cell, at most, by the voxels. */
static double thickness_of(const struct flat *f, const int at[3])
{
    const radiance_lattice *l = &f->view.field;
    const flat_medium *m = &f->view.media[0];
    double most = 0.0;
    for (int i = 0; i < 16 * 16 * 16; i++) {
        vec3 p;
        p.x = l->origin[0] +
              l->side * (8.0f * (float)at[0] + 0.5f * (float)(i & 15));
        p.y = l->origin[1] +
              l->side * (8.0f * (float)at[1] + 0.5f * (float)(i >> 4 & 15));
        p.z = l->origin[2] +
              l->side * (8.0f * (float)at[2] + 0.5f * (float)(i >> 8));
        field_point x = field_point_make(&f->view, m->lead, p);
        most = fmax(most, (double)medium_density(&f->view, m, &x).r);
    }
    return most * (double)m->sigma_t.r * (double)l->side;
}

/* The same flights lay as much into each brick, whatever its cells; no cell is
 * thicker than was asked for, and thin bricks have few. */
static void photon_depth__cells_hold_what_flies_there(void **state)
{
    (void)state;
    const double depth = 0.25;
    brume_scene *s = heap();
    struct brume_options o = options_of(0.0), deep = options_of(depth);
    struct flat *one = fill(s, &o), *many = fill(s, &deep);
    const int32_t *n = one->view.field.bricks;
    int bricks[4] = {0};
    assert_true(many->radiance_count < one->radiance_count / 3);
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const int at[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
        int cells, ignored;
        double light = brick_light(many, at, &cells);
        double truth = brick_light(one, at, &ignored);
        if (!(fabs(light - truth) < 1e-5 * truth + 1e-9))
            fail_msg("brick %d: %g of %g", i, light, truth);
        if (cells == 0)
            continue;
        int level = cells == 512 ? 0 : cells == 64 ? 1 : cells == 8 ? 2 : 3;
        assert_int_equal(cells, 512 >> 3 * level);
        bricks[level]++;
        double thick = thickness_of(one, at) * (1 << level);
        if (level > 0 && !(thick <= depth))
            fail_msg("brick %d of level %d: cells of thickness %g", i, level,
                     thick);
    }
    for (int i = 0; i < 4; i++)
        assert_true(bricks[i] > 0);
    flat_free(one);
    flat_free(many);
    brume_scene_free(s);
}

/* Across the faces of bricks of all levels, and what is read of a field that
 * is even. */
static void photon_depth__nothing_jumps(void **state)
{
    (void)state;
    brume_scene *s = heap();
    struct brume_options o = options_of(0.25);
    struct flat *f = fill(s, &o);
    const radiance_lattice *l = &f->view.field;
    double across = 0.0, size = 0.0;
    for (int i = 0; i < 40000; i++) {
        rng random = rng_make(1, 0, 0, (uint64_t)i);
        vec3 a;
        float *v[3] = {&a.x, &a.y, &a.z};
        for (int k = 0; k < 3; k++)
            *v[k] = l->origin[k] +
                    l->side * 8.0f * (float)l->bricks[k] * rng_float(&random);
        int axis = i % 3;
        float side = 8.0f * l->side;
        *v[axis] = l->origin[axis] +
                   side * (float)hd_floor((*v[axis] - l->origin[axis]) / side +
                                          0.5f);
        vec3 b = a;
        float near = 1e-4f * l->side;
        *v[axis] -= near;
        if (axis == 0)
            b.x += near;
        else if (axis == 1)
            b.y += near;
        else
            b.z += near;
        double x = (double)radiance_at(&f->view, a, false).fluence.r;
        double y = (double)radiance_at(&f->view, b, false).fluence.r;
        across = fmax(across, fabs(x - y));
        size += x / 40000.0;
    }
    if (!(across < 0.01 * size))
        fail_msg("jumps by %g of %g", across, size);
    for (size_t i = 0; i < f->radiance_count; i++)
        f->radiance[i] = 3.0f;
    for (int i = 0; i < 1000; i++) {
        rng random = rng_make(2, 0, 0, (uint64_t)i);
        float r = 0.5f * (float)f->unit;
        vec3 p = vec3_scale(vec3_make(rng_float(&random), rng_float(&random),
                                      rng_float(&random)),
                            r);
        double x = (double)radiance_at(&f->view, p, false).fluence.r;
        assert_true(fabs(x - 3.0) < 1e-5);
    }
    flat_free(f);
    brume_scene_free(s);
}

static double mean_of(brume_scene *s, const struct brume_options *o)
{
    struct brume_frame f;
    double sum = 0.0;
    assert_true(brume_render(s, o, &f, truth_error()));
    for (int i = 0; i < 3 * PIXELS; i++)
        sum += (double)f.radiance[i] / (3 * PIXELS);
    brume_frame_free(&f);
    return sum;
}

/* Pictures of coarse and of fine cells: thickness is what is wrong. Films have
 * cells of one size. */
static void photon_depth__pictures_agree(void **state)
{
    (void)state;
    brume_scene *s = heap();
    struct brume_options o = options_of(0.0);
    o.photons.everywhere = false;
    o.photons.count = 200000;
    o.spp = 16;
    double truth = mean_of(s, &o);
    o.photons.depth = 0.25;
    double deep = mean_of(s, &o);
    o.photons.depth = 4.0;
    double coarse = mean_of(s, &o);
    if (!(fabs(deep / truth - 1.0) < 0.01) ||
        !(fabs(coarse / truth - 1.0) > 0.01))
        fail_msg("depth 0.25: %.5f, 4: %.5f, fine: %.5f", deep, coarse, truth);
    o.photons.depth = 0.25;
    o.photons.film_cells = true;
    struct flat *film = fill(s, &o);
    assert_false(film->view.field.refined);
    flat_free(film);
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_depth__cells_hold_what_flies_there),
        cmocka_unit_test(photon_depth__nothing_jumps),
        cmocka_unit_test(photon_depth__pictures_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
