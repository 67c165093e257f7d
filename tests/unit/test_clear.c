/* test_clear.c - no boundary goes through a cell that is said to be clear. */
#include "tests/unit/truth_flat.h"
#include "core/physics/bvh.h"
#include "core/physics/rng.h"
#include "core/physics/walk.h"
#include "core/physics/warp.h"

static int add_field(brume_scene *s)
{
    struct brume_function *f = brume_function_new(s, 3, truth_error());
    brume_function_constant(f, 1.0, truth_error());
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    field.function = brume_add_function(s, f, truth_error());
    int id = brume_add_field(s, &field, truth_error());
    assert_true(id >= 0);
    return id;
}

static void add_shape(brume_scene *s, enum brume_shape_kind kind,
                      const double a[3], const double b[3], double radius)
{
    struct brume_material m = BRUME_MATERIAL_INIT;
    struct brume_shape shape = BRUME_SHAPE_INIT;
    shape.kind = kind;
    shape.radius = shape.radius_b = radius;
    for (int i = 0; i < 3; i++) {
        shape.a[i] = a[i];
        shape.b[i] = b[i];
    }
    shape.material = brume_add_material(s, &m, truth_error());
    assert_true(brume_add_shape(s, &shape, truth_error()) >= 0);
}

/* A box of half width 1 from z = 0 to 2, full, with things in it. */
static struct flat *make_scene(bool things)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_medium m = truth_medium(1, 0, 0);
    m.density[0] = add_field(s);
    m.densities = 1;
    truth_fill(s, truth_box(1, 0, 2), &m);
    if (things) {
        add_shape(s, BRUME_SHAPE_SPHERE, (double[]){0.4, 0.3, 0.7},
                  (double[]){0, 0, 0}, 0.31);
        add_shape(s, BRUME_SHAPE_CYLINDER, (double[]){-0.7, -0.5, 1.6},
                  (double[]){-0.2, 0.1, 1.1}, 0.06);
        add_shape(s, BRUME_SHAPE_PLANE, (double[]){0.2, 1, 0.1},
                  (double[]){0, 0, 0}, -0.72);
    }
    struct flat *flat = truth_flat(s);
    brume_scene_free(s);
    return flat;
}

static uint64_t clear_cells(const struct flat *f)
{
    uint64_t n = 0;
    for (uint64_t i = 0; i < f->cells_count; i++)
        n += f->cells[i].clear != 0;
    return n;
}

/* Follows a ray from a point of the lattice through the clear cells there. */
static uint64_t follow(const flat_scene *s, vec3 o, vec3 d)
{
    container_set set = {.count = 1};
    media_walk w;
    bvh_ray r = bvh_ray_make(o, d);
    ray_hit start = hit_start(0.0f), h = bvh_nearest(s, &r, &start, s->far);
    uint64_t cells = 0;
    for (int i = 0; i < (int)s->shapes_count; i++)
        if (s->shapes[i].interior >= 0)
            set.shape[0] = i;
    walk_begin(s, &w, &set, true, o, d, 0.0f, s->far);
    while (walk_is_clear(&w)) {
        if (!(h.t > w.t_end))
            fail_msg("a hit at %g, in a clear piece up to %g", (double)h.t,
                     (double)w.t_end);
        cells++;
        if (!walk_next(s, &w))
            break;
    }
    return cells;
}

static void check(bool things, double share)
{
    struct flat *f = make_scene(things);
    const flat_scene *s = &f->view;
    const flat_medium *m = &s->media[0];
    rng random = rng_make(1, 2, 3, 4);
    uint64_t cells = 0, all = f->cells_count;
    assert_true((double)clear_cells(f) > share * (double)all);
    assert_true(clear_cells(f) < all);
    matrix to_cell, back;
    for (int i = 0; i < 12; i++)
        to_cell.m[i / 4][i % 4] = (double)m->to_cell.m[i];
    assert_true(matrix_invert(&to_cell, &back));
    for (int i = 0; i < 200000; i++) {
        double p[3], o[3];
        for (int k = 0; k < 3; k++)
            p[k] = (double)rng_float(&random) * m->cells[k];
        matrix_point(&back, p, o);
        vec3 d = warp_sphere(rng_float(&random), rng_float(&random));
        cells += follow(s, vec3_make((float)o[0], (float)o[1], (float)o[2]), d);
    }
    assert_true(cells > 1000);
    flat_free(f);
}

static void test_clear__box(void **state)
{
    (void)state;
    check(false, 0.3);
}

static void test_clear__things(void **state)
{
    (void)state;
    check(true, 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_clear__box),
        cmocka_unit_test(test_clear__things),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
