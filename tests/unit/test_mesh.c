#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include "lib/mesh.h"

static struct mesh *make(int vertices)
{
    struct mesh *m = mesh_new(NULL);
    assert_non_null(m);
    for (int i = 0; i < vertices; i++) {
        double p[3] = {i, 2.0 * i, 1e9 * i};
        assert_true(mesh_add_vertex(m, p, NULL));
    }
    return m;
}

static void test_mesh__keeps_what_is_added(void **state)
{
    (void)state;
    struct mesh *m = make(1000);
    for (uint32_t i = 0; i + 2 < 1000; i++) {
        uint32_t corner[3] = {i, i + 1, i + 2};
        assert_true(mesh_add_triangle(m, corner, NULL, NULL, NULL));
    }
    assert_int_equal(m->vertices, 1000);
    assert_int_equal(m->triangles, 998);
    assert_true(m->position[999][2] == 1e9 * 999);
    assert_int_equal(m->corner[997][2], 999);
    assert_null(m->corner_normal);
    assert_null(m->corner_uv);
    assert_true(mesh_check(m, NULL));
    mesh_free(m);
}

/* Optional indices may begin at any triangle, at and between the points at
 * which the arrays grow. */
static void test_mesh__normals_may_begin_late(void **state)
{
    (void)state;
    static const uint32_t corner[3] = {0, 1, 2};
    for (size_t first = 0; first < 70; first++) {
        struct mesh *m = make(3);
        float n[3] = {0, 1, 0}, uv[2] = {0.5f, 1};
        for (int i = 0; i < 3; i++) {
            assert_true(mesh_add_normal(m, n, NULL));
            assert_true(mesh_add_uv(m, uv, NULL));
        }
        for (size_t t = 0; t < 100; t++)
            assert_true(mesh_add_triangle(m, corner, t >= first ? corner : NULL,
                                          t % 3 ? NULL : corner, NULL));
        assert_true(mesh_check(m, NULL));
        for (size_t t = 0; t < 100; t++) {
            assert_int_equal(m->corner_normal[t][2],
                             t >= first ? 2 : MESH_NONE);
            assert_int_equal(m->corner_uv[t][1], t % 3 ? MESH_NONE : 1);
        }
        mesh_free(m);
    }
}

static void refused(struct mesh *m, const char *word)
{
    struct brume_error err = {0};
    assert_false(mesh_check(m, &err));
    assert_non_null(strstr(err.text, word));
    mesh_free(m);
}

static void test_mesh__check_refuses_wrong_indices(void **state)
{
    (void)state;
    static const uint32_t good[3] = {0, 1, 2}, bad[3] = {0, 1, 3};
    static const uint32_t none[3] = {0, 1, MESH_NONE};
    struct mesh *m = make(3);
    mesh_add_triangle(m, bad, NULL, NULL, NULL);
    refused(m, "vertex 3");
    m = make(3);
    mesh_add_triangle(m, good, good, NULL, NULL);
    refused(m, "normal 0");
    m = make(3);
    mesh_add_triangle(m, good, NULL, good, NULL);
    refused(m, "uv 0");
    m = make(3);
    mesh_add_triangle(m, none, NULL, NULL, NULL);
    refused(m, "vertex");
}

static void test_mesh__check_refuses_infinite_positions(void **state)
{
    (void)state;
    static const double wrong[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        struct mesh *m = make(3);
        m->position[1][i] = wrong[i];
        refused(m, "vertex 1");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mesh__keeps_what_is_added),
        cmocka_unit_test(test_mesh__normals_may_begin_late),
        cmocka_unit_test(test_mesh__check_refuses_wrong_indices),
        cmocka_unit_test(test_mesh__check_refuses_infinite_positions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
