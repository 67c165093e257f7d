/* test_twin.c - two points of a voxel have what each has alone, whether grids
 * lie alike or not. */
#include "tests/unit/truth_flat.h"
#include "core/physics/rng.h"
#include "core/physics/twin.h"

enum { SMOOTH, BELOW, LARGER, CLIPPED, NEAREST };

/* Of a cube of bricks of random values, but for one brick. */
static int add_grid(brume_scene *s, int kind, rng *r)
{
    int from = kind == BELOW ? -8 : 0, n = kind == LARGER ? 3 : 2;
    const int32_t origin[3] = {0, from, 0}, bricks[3] = {n, n, n};
    struct grid *g = grid_new(origin, bricks, 0.5f, truth_error());
    g->filter = kind == NEAREST ? GRID_NEAREST : GRID_TRILINEAR;
    g->clip = kind == CLIPPED;
    for (int i = 0; i < 3; i++) {
        g->clip_min[i] = 1.0;
        g->clip_max[i] = 12.0;
        for (int k = 0; k < 4; k++)
            g->to_world[i][k] = i == k ? 0.125 : 0.0;
    }
    for (int i = 1; i < n * n * n; i++) {
        float *v = grid_brick(g, i % n, i / n % n, i / n / n, truth_error());
        for (int k = 0; k < GRID_BRICK_VOXELS; k++)
            v[k] = rng_float(r);
    }
    grid_finish(g);
    int id = brume_add_grid(s, g, truth_error());
    grid_free(g);
    return id;
}

/* A fire of one grid's density and another's temperature. */
static struct flat *fire_of(const int kind[2], rng *r)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 1, 1);
    struct brume_medium m = truth_medium(1, 0, 0);
    int field[2];
    for (int i = 0; i < 2; i++) {
        struct brume_field f = BRUME_FIELD_INIT;
        f.kind = BRUME_FIELD_GRID;
        f.grid = add_grid(s, kind[i], r);
        field[i] = brume_add_field(s, &f, truth_error());
    }
    m.density[0] = field[0];
    m.densities = 1;
    m.fire.on = true;
    m.fire.temperature = field[1];
    truth_fill(s, truth_box(2, -1, 3), &m);
    struct flat *f = truth_flat(s);
    brume_scene_free(s);
    return f;
}

static vec3 within(vec3 corner, rng *r)
{
    vec3 p = corner;
    p.x += 0.01f + 0.98f * rng_float(r);
    p.y += 0.01f + 0.98f * rng_float(r);
    p.z += 0.01f + 0.98f * rng_float(r);
    return p;
}

static field_point point_of(const flat_field *lead, vec3 index)
{
    field_point x;
    x.p = vec3_make(NAN, NAN, NAN);
    x.index = index;
    x.lattice = lead->lattice;
    return x;
}

/* Then a second point beyond its brick is not asked for: lines stop there. */
static bool grid_is_constant(const flat_scene *s, const flat_field *f,
                             const field_point *x)
{
    const flat_grid *g = &s->grids[f->grid];
    grid_spot spot = grid_spot_of(g, grid_local(g, x->index));
    return !grid_voxel_at(s, g, spot.brick, spot.sample).stored;
}

/* Of voxels of the grids and around them; those of NEAREST begin a half
 * lower. Every fourth time the second point is in the next one. */
static void check_field(const flat_scene *s, const flat_field *f, int kind,
                        rng *r)
{
    const flat_medium *m = &s->media[0];
    const flat_field *lead = &s->fields[m->lead];
    float from = kind == NEAREST ? -12.5f : -12.0f;
    for (int i = 0; i < 20000; i++) {
        vec3 corner;
        corner.x = (float)(int)(30.0f * rng_float(r)) + from;
        corner.y = (float)(int)(30.0f * rng_float(r)) + from;
        corner.z = (float)(int)(30.0f * rng_float(r)) + from;
        field_point a = point_of(lead, within(corner, r));
        corner.x += i % 4 == 0 ? 1.0f : 0.0f;
        field_point b = point_of(lead, within(corner, r));
        twin_point x = twin_point_of(s, m, a, b);
        twin_float got = twin_plain(s, f, &x);
        float alone = field_plain(s, f, &b);
        assert_true(got.a == field_plain(s, f, &a));
        assert_true(got.b == alone ||
                    (i % 4 == 0 && grid_is_constant(s, f, &a)));
    }
}

static void check_pair(int density, int temperature, bool alike)
{
    const int kind[2] = {density, temperature};
    rng r = rng_make(3, 0, 0, 0);
    struct flat *f = fire_of(kind, &r);
    const flat_scene *s = &f->view;
    const flat_field *a = &s->fields[s->media[0].density[0]];
    const flat_field *b = &s->fields[s->media[0].temperature];
    assert_true((s->grids[a->grid].layout == s->grids[b->grid].layout) ==
                alike);
    check_field(s, a, density, &r);
    check_field(s, b, temperature, &r);
    flat_free(f);
}

static void test_twins(void **state)
{
    (void)state;
    check_pair(SMOOTH, SMOOTH, true);
    check_pair(SMOOTH, BELOW, false);
    check_pair(SMOOTH, LARGER, false);
    check_pair(LARGER, SMOOTH, false);
    check_pair(SMOOTH, CLIPPED, false);
    check_pair(CLIPPED, CLIPPED, true);
    check_pair(SMOOTH, NEAREST, false);
    check_pair(NEAREST, NEAREST, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_twins)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
