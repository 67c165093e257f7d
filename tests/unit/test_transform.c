/* test_transform.c - parser/transform against POV-Ray 3.7.0.10, whose answers
 * were printed by functions of the form function { transform { ... } }. */
#include "parser/transform.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

static void check_image(transform t, const double p[3], const double want[3])
{
    double got[3];

    transform_point(&t, p, got);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(got[i] - want[i]) <= 1.5e-6);
}

#define IMAGE(t, px, py, pz, x, y, z)                                          \
    check_image(t, (const double[3]){px, py, pz}, (const double[3]){x, y, z})
#define VEC(x, y, z) ((const double[3]){x, y, z})

static void rotation_is_left_handed_x_then_y_then_z(void **state)
{
    (void)state;
    IMAGE(transform_rotate(VEC(10, 20, 30)), 1, 2, 3, 1.067425, 2.289059,
          2.760581);
    IMAGE(transform_rotate(VEC(90, 0, 0)), 0, 1, 0, 0, 0, 1);
    IMAGE(transform_rotate(VEC(0, 90, 0)), 1, 0, 0, 0, 0, -1);
    IMAGE(transform_rotate(VEC(0, 0, 90)), 1, 0, 0, 0, 1, 0);
}

static void quarter_turns_are_exact(void **state)
{
    (void)state;
    for (int quarter = -8; quarter <= 8; quarter++) {
        transform t = transform_rotate(VEC(90 * quarter, 90, -450));
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                assert_true(t.m[i][j] == 0 || t.m[i][j] == 1 ||
                            t.m[i][j] == -1);
    }
}

static void a_chain_goes_in_order(void **state)
{
    (void)state;
    const double numbers[12] = {1, 2, 3, 4, 5, 7, 7, 8, 10, -1, -2, -3};
    transform parts[4] = {
        transform_rotate(VEC(10, 20, 30)), transform_scale(VEC(1, 2, 3)),
        transform_translate(VEC(4, 5, 6)), transform_matrix(numbers)};
    transform t = transform_identity();

    for (int i = 0; i < 4; i++)
        t = transform_then(&t, &parts[i]);
    IMAGE(t, 1, 2, 3, 142.352111, 170.279400, 222.066551);
}

static void inverse_undoes(void **state)
{
    (void)state;
    transform scale = transform_scale(VEC(1, 2, 3));
    transform move = transform_translate(VEC(4, 5, 6));
    transform turn = transform_rotate(VEC(30, 0, 0));
    transform t = transform_then(&scale, &move), back;

    t = transform_then(&t, &turn);
    assert_true(transform_inverse(&t, &back));
    IMAGE(back, 1, 2, 3, -3, -0.883975, -1.467308);
}

static void inverse_refuses_the_singular(void **state)
{
    (void)state;
    const double flat[12] = {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 2, 3};
    transform t = transform_matrix(flat), out = transform_identity();

    assert_false(transform_inverse(&t, &out));
    assert_true(transform_is_identity(&out));
}

static void scale_by_zero_is_scale_by_one(void **state)
{
    (void)state;
    IMAGE(transform_scale(VEC(1, 0, 3)), 1, 2, 3, 1, 2, 9);
}

static void vectors_are_not_moved(void **state)
{
    (void)state;
    transform move = transform_translate(VEC(4, 5, 6));
    double v[3] = {1, 2, 3};

    transform_vector(&move, v, v);
    assert_true(v[0] == 1 && v[1] == 2 && v[2] == 3);
    assert_false(transform_is_identity(&move));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotation_is_left_handed_x_then_y_then_z),
        cmocka_unit_test(quarter_turns_are_exact),
        cmocka_unit_test(a_chain_goes_in_order),
        cmocka_unit_test(inverse_undoes),
        cmocka_unit_test(inverse_refuses_the_singular),
        cmocka_unit_test(scale_by_zero_is_scale_by_one),
        cmocka_unit_test(vectors_are_not_moved),
    };

    return cmocka_run_group_tests_name("transform", tests, NULL, NULL);
}
