/* test_solid_build.c - what the builders of core/solid.h refuse, by name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>
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
        cmocka_unit_test(test_solid_build__poly_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
