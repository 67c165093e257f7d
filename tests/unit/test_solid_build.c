/* test_solid_build.c - what the builders of core/solid.h refuse, by name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>
#include "core/physics/rng.h"
#include "tests/unit/solids.h"

struct refusal {
    const char *kind;
    double numbers[32];
    size_t count;
    const char *text; /* a part of the message                    */
};

#define REFUSE(kind, text, ...)                                                \
    {                                                                          \
        kind, {__VA_ARGS__}, sizeof((double[]){__VA_ARGS__}) / sizeof(double), \
            text                                                               \
    }

#define BALL 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0
static const struct refusal refusals[] = {
    REFUSE("torus", "radii -1 and 1", -1, 1),
    REFUSE("torus", "radii 1 and 0", 1, 0),
    REFUSE("torus", "radii nan and 1", NAN, 1),
    REFUSE("torus", "radii 1 and inf", 1, INFINITY),
    REFUSE("quadric", "no term of x, y or z", 0, 0, 0, 0, 0, 0, 0, 0, 0, 1),
    REFUSE("quadric", "number 3 is nan", 1, 0, NAN, 0, 0, 0, 0, 0, 0, 1),
    REFUSE("poly", "order 1; expected 2 to 35", 1, 1, 1, 1, 1),
    REFUSE("poly", "order 36; expected 2 to 35", 36, 1, 1, 1, 1),
    REFUSE("poly", "no term of x, y or z", 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4),
    REFUSE("superellipsoid", "exponents 0 and 1", 0, 1),
    REFUSE("superellipsoid", "exponents 1 and -1", 1, -1),
    REFUSE("superellipsoid", "exponents 1 and nan", 1, NAN),
    REFUSE("ovus", "radii 0 and 1", 0, 1),
    REFUSE("ovus", "radii 1 and -1", 1, -1),
    REFUSE("blob", "threshold 0;", 0, 0, 1, 1, BALL),
    REFUSE("blob", "0 components", 1),
    REFUSE("blob", "radius 0;", 1, 0, 1, 0, BALL),
    REFUSE("blob", "number 2 is inf", 1, 0, INFINITY, 1, BALL),
    REFUSE("blob", "a transform makes flat", 1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0,
           0, 0, 0, 1, 0, 0, 0, 0, 0, 0),
    REFUSE("prism", "2 points; expected 3", 0, 0, 0, 0, 1, 0, 0, 1, 1),
    REFUSE("prism", "3 points: a cubic spline takes 4 or more", 2, 0, 0, 0, 1,
           0, 0, 1, 1, 0, 1),
    REFUSE("prism", "a Bezier spline takes 4 for each", 3, 0, 0, 0, 1, 0, 0, 1,
           1, 0, 1),
    REFUSE("prism", "from point 1 on does not return", 1, 0, 0, 0, 1, -1, -1, 0,
           0, 1, 0, 1, 1),
    REFUSE("prism", "1 points left", 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0, 3,
           3),
    REFUSE("prism", "heights: number 2 is inf", 0, 0, 0, 0, INFINITY, 0, 0, 1,
           1, 0, 1),
    REFUSE("prism", "prism: number 3 is nan", 0, 0, 0, 0, 1, 0, 0, NAN, 1, 0,
           1),
    REFUSE("prism", "along a B-spline", 4, 0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0),
    REFUSE("lathe", "1 points: a linear spline takes 2 or more", 0, 1, 1),
    REFUSE("lathe", "point 2 lies 1 beyond", 0, 1, 1, -1, 2),
    REFUSE("lathe", "point 4 lies 2 beyond", 3, 0, 0, -1, 1, 1, 2, -2, 3),
    REFUSE("sor", "of 3 points; expected 4", 0, 1, 0, 1, 1, 1, 2),
    REFUSE("sor", "point 2 has the radius -1", 0, 1, 0, -1, 1, 1, 2, 1, 3),
    REFUSE("sor", "point 3 at height 1 is not above", 0, 1, 0, 1, 1, 1, 1, 1,
           3),
    REFUSE("sor", "number 8 is inf", 0, 1, 0, 1, 1, 1, 2, 1, INFINITY),
    REFUSE("sphere_sweep", "along a Bezier spline", 3, 0, 0, 0, 1, 1, 0, 0, 1),
    REFUSE("sphere_sweep", "1 spheres; expected 2", 0, 0, 0, 0, 1),
    REFUSE("sphere_sweep", "2 spheres; expected 4", 2, 0, 0, 0, 1, 1, 0, 0, 1),
    REFUSE("sphere_sweep", "sphere 2 has the radius -1", 0, 0, 0, 0, 1, 1, 0, 0,
           -1),
    REFUSE("sphere_sweep", "number 5 is nan", 0, 0, 0, 0, 1, NAN, 0, 0, 1),
    REFUSE("julia", "expected the function sqr or cube", 0, 2, 8, 20, 0, 0, 0,
           0, 0, 0, 0, 1, 0, 0, 0),
    REFUSE("julia", "of 0 iterations", 0, 0, 0, 20, 0, 0, 0, 0, 0, 0, 0, 1, 0,
           0, 0),
    REFUSE("julia", "along its fourth", 0, 0, 8, 20, 0, 0, 0, 0, 1, 0, 0, 0, 0,
           0, 0),
    REFUSE("julia", "precision: number 1 is nan", 0, 0, 8, NAN, 0, 0, 0, 0, 0,
           0, 0, 1, 0, 0, 0),
    REFUSE("julia", "number 2 is inf", 0, 0, 8, 20, 0, INFINITY, 0, 0, 0, 0, 0,
           1, 0, 0, 0),
    REFUSE("isosurface", "without volume", 0, 0, -1, -1, 1, 1, 1, 1, 0, 1, 1,
           0),
    REFUSE("isosurface", "radius is 0;", 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0),
    REFUSE("isosurface", "accuracy is 0;", 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0),
    REFUSE("isosurface", "max_gradient is -1;", 0, 1, 0, 0, 0, 1, 0, 0, 0, 1,
           -1, 0),
    REFUSE("isosurface", "threshold: number 1 is nan", 0, 1, 0, 0, 0, 1, 0, 0,
           NAN, 1, 1, 0),
    REFUSE("isosurface", "adapts by 0.5 and 1;", 0, 1, 0, 0, 0, 1, 0, 0, 0, 1,
           1, 0, 1, 0.5, 1),
};

static const struct solid_kind *kind_named(const char *name)
{
    for (size_t k = 0; k < SOLID_KINDS; k++)
        if (!strcmp(solid_kinds[k].name, name))
            return &solid_kinds[k];
    fail_msg("no kind %s", name);
    return NULL;
}

static void test_solid_build__refusals(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        const struct refusal *r = &refusals[i];
        struct brume_error err = {0};
        struct solid solid;
        struct arena arena;
        arena_init(&arena, 0);
        if (kind_named(r->kind)->build(&arena, r->numbers, r->count, &solid,
                                       &err))
            fail_msg("%s: accepted, expected '%s'", r->kind, r->text);
        assert_int_equal(err.code, BRUME_ERR_SCENE);
        if (!strstr(err.text, r->text))
            fail_msg("%s: '%s', expected '%s'", r->kind, err.text, r->text);
        arena_release(&arena);
    }
}

static void test_solid_build__no_memory(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct solid solid;
    struct arena arena;
    arena_init(&arena, 1);
    assert_false(solid_torus(&arena, 1, 0.5, &solid, &err));
    assert_int_equal(err.code, BRUME_ERR_MEMORY);
    arena_release(&arena);
}

/* ---- the tree of a blob */

enum { BALLS = 3000 };

static dvec3 unit_point(rng *r)
{
    double x = rng_float(r), y = rng_float(r), z = rng_float(r);

    return dvec3_make(x, y, z);
}

/* The sum of all balls' fields at p, one by one. */
static double field_of(const double *n, dvec3 p)
{
    double sum = 0;

    for (int i = 0; i < BALLS; i++, n += BRUME_BLOB_NUMBERS) {
        double x = p.x - n[3], y = p.y - n[4], z = p.z - n[5];
        double rest = 1 - (x * x + y * y + z * z) / (n[2] * n[2]);
        sum += rest > 0 ? n[1] * rest * rest : 0;
    }
    return sum;
}

static void fill_balls(double *n, rng *r)
{
    for (int i = 0; i < BALLS; i++, n += BRUME_BLOB_NUMBERS) {
        dvec3 centre = unit_point(r);
        n[1] = (double)rng_float(r) - 0.3;
        n[2] = 0.02 + 0.2 * (double)rng_float(r);
        n[3] = centre.x;
        n[4] = centre.y;
        n[5] = centre.z;
        n[9] = n[14] = n[19] = 1;
    }
}

/* The field that the tree sums, and the roots that it leads to. */
static void test_solid_build__many_components(void **state)
{
    (void)state;
    static double n[BALLS * BRUME_BLOB_NUMBERS];
    rng r = rng_make(5, 0, 0, 0);
    struct arena arena;
    struct solid solid;
    int roots = 0;
    fill_balls(n, &r);
    arena_init(&arena, 0);
    assert_true(solid_blob(&arena, 0.4, n, BALLS, &solid, NULL));
    for (int i = 0; i < 1000; i++) {
        dvec3 gradient, p = unit_point(&r);
        double field = blob_field(solid.data, p, &gradient);
        assert_true(fabs(field - field_of(n, p)) < 1e-12);
    }
    for (int i = 0; i < 200; i++) {
        double t[64];
        int part[64];
        dvec3 o = unit_point(&r), d = dvec3_sub(unit_point(&r), o);
        int count = blob_roots(solid.data, o, d, t, part, 64);
        for (int k = 0; k < count; k++)
            assert_true(fabs(field_of(n, dvec3_mad(o, t[k], d)) - 0.4) < 1e-9);
        roots += count;
    }
    assert_in_range(roots, 300, 20000);
    arena_release(&arena);
}

/* ---- any numbers */

static double any_number(rng *r)
{
    static const double odd[] = {0,      -1,    1,     2,   3,   4,
                                 1e-300, 1e300, -1e-9, 1e9, NAN, INFINITY};
    float choice = rng_float(r);

    if (choice < 0.1f)
        return odd[(int)(rng_float(r) * 12)];
    if (choice < 0.3f)
        return (int)(rng_float(r) * 5);
    return 4 * (double)rng_float(r) - 1.5;
}

/* Leaves out what has no such kind, more terms than numbers, or is slow. */
static bool limited(const struct solid_kind *kind, const double *n)
{
    double curve = n[0];

    if (kind->thin)
        return fabs(n[0]) < 2 && n[1] >= 0 && n[1] < 18 && fabs(n[2]) < 20 &&
               !(n[3] > 50);
    if (kind->build == build_poly)
        return n[0] < 4 && n[0] > -1e9;
    if (kind->build == build_prism || kind->build == build_lathe ||
        kind->build == build_sphere_sweep)
        return curve >= 0 && curve < 5;
    return true;
}

/* Roots of what was accepted ascend and are finite or far. */
static void look_at(const struct solid_kind *kind, const struct solid *solid,
                    rng *r)
{
    enum { ROOM = 16 };
    double t[ROOM], c[6];
    int part[ROOM];

    for (int ray = 0; ray < 8; ray++) {
        for (int i = 0; i < 6; i++)
            c[i] = ray < 6 ? 4 * (double)rng_float(r) - 2 : any_number(r);
        dvec3 o = dvec3_make(c[0], c[1], c[2]),
              d = dvec3_make(c[3], c[4], c[5]);
        int n = kind->roots(solid->data, o, d, t, part, ROOM);
        assert_in_range(n, 0, ROOM);
        for (int i = 0; i < n; i++) {
            assert_false(isnan(t[i]));
            assert_true(i == 0 || t[i - 1] <= t[i]);
            kind->normal(solid->data, dvec3_mad(o, t[i], d), part[i]);
        }
        kind->inside(solid->data, o);
    }
}

/* Built or refused with a reason, and then looked at: no crash, no hang. */
static void test_solid_build__any_numbers(void **state)
{
    (void)state;
    rng r = rng_make(4, 0, 0, 0);
    int built = 0;
    for (int trial = 0; trial < 20000; trial++) {
        const struct solid_kind *kind = &solid_kinds[trial % SOLID_KINDS];
        double numbers[60];
        size_t count = trial % 7 ? 48 : 15;
        struct brume_error err = {0};
        struct solid solid;
        struct arena arena;
        if (kind->thin || kind->build == build_poly)
            count = 60;
        for (size_t i = 0; i < count; i++)
            numbers[i] = any_number(&r);
        if (kind->build == build_isosurface)
            numbers[9] = fmax(numbers[9], 0.01);
        if (!limited(kind, numbers))
            continue;
        arena_init(&arena, 0);
        if (kind->build(&arena, numbers, count, &solid, &err)) {
            built++;
            look_at(kind, &solid, &r);
        } else {
            assert_true(err.text[0] != '\0');
        }
        arena_release(&arena);
    }
    assert_in_range(built, 2000, 20000);
}

/* POV-Ray's order: by falling power of x, then of y, then of z. */
static void test_solid_build__poly_order(void **state)
{
    (void)state;
    for (int order = 2; order <= 35; order++) {
        int at = 0;
        for (int x = order; x >= 0; x--)
            for (int y = order - x; y >= 0; y--)
                for (int z = order - x - y; z >= 0; z--)
                    assert_int_equal(solid_poly_index(order, x, y, z), at++);
        assert_int_equal(solid_poly_terms(order), at);
    }
    assert_int_equal(solid_poly_terms(35), 8436);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid_build__refusals),
        cmocka_unit_test(test_solid_build__no_memory),
        cmocka_unit_test(test_solid_build__many_components),
        cmocka_unit_test(test_solid_build__any_numbers),
        cmocka_unit_test(test_solid_build__poly_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
