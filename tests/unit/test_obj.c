#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "lib/obj.h"
#include "tests/unit/temp_file.h"

#define SPOT "../shared/data/spot.obj"

static void test_obj__faces_of_all_forms(void **state)
{
    (void)state;
    static const uint32_t corner[][3] = {
        {0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4},
        {0, 1, 4}, {1, 4, 5}, {0, 1, 2},
    };
    struct brume_error err = {0};
    struct mesh *m = obj_load("tests/data/corner.obj", &err);
    if (!m)
        fail_msg("%s", err.text);
    assert_true(mesh_check(m, NULL));
    assert_int_equal(m->vertices, 6);
    assert_int_equal(m->triangles, 7);
    assert_memory_equal(m->corner, corner, sizeof corner);
    assert_true(m->uv[3][0] == 0.5f && m->uv[3][1] == 0);
    assert_int_equal(m->corner_uv[1][2], 3);
    assert_int_equal(m->corner_uv[2][0], MESH_NONE);
    assert_int_equal(m->corner_uv[4][2], 2);
    assert_int_equal(m->corner_normal[0][0], 0);
    assert_int_equal(m->corner_normal[3][1], 0);
    assert_int_equal(m->corner_normal[4][0], MESH_NONE);
    assert_int_equal(m->corner_normal[6][0], MESH_NONE); /* zero normal */
    mesh_free(m);
}

static void refused(const char *text, const char *word)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    struct brume_error err = {0};
    assert_null(obj_load(path, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
    assert_non_null(strstr(err.text, path));
}

#define THREE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void test_obj__errors_say_where(void **state)
{
    (void)state;
    refused("", "no faces");
    refused("\x7f"
            "ELF\n\n\n",
            "no faces");
    refused("v 1 2\n", "line 1: a vertex of 2 numbers");
    refused("v 1 2 x\n", "'x' is not a number");
    refused("v 1 2 inf\n", "coordinate inf");
    refused("v 1 -nan 2\n", "coordinate");
    refused(THREE "f 1 2\n", "line 4: a face of 2 corners");
    refused(THREE "f 1 2 4\n", "line 4: a face names vertex 4");
    refused(THREE "f 1 2 0\n", "names vertex 0");
    refused(THREE "f 1 2 -4\n", "names vertex -4");
    refused(THREE "f 1 2 1.5\n", "'1.5' is not");
    refused(THREE "f 1 2 nan\n", "'nan' is not");
    refused(THREE "f 1 2 1e300\n", "a face names vertex");
    refused(THREE "f 1/1 2/1 3/1\n", "texture coordinate 1");
    refused(THREE "f 1//1 2 3\n", "normal 1");
    refused(THREE "f /1 2 3\n", "'' is not");
    struct brume_error err = {0};
    assert_null(obj_load("/no/such.obj", &err));
    assert_non_null(strstr(err.text, "No such file"));
    err = (struct brume_error){0};
    assert_null(obj_load("/tmp", &err));
    assert_non_null(strstr(err.text, "directory"));
}

static void test_obj__reads_a_real_mesh(void **state)
{
    (void)state;
    if (access(SPOT, R_OK) != 0) {
        print_message("no " SPOT " here\n");
        skip();
    }
    struct brume_error err = {0};
    struct mesh *m = obj_load(SPOT, &err);
    if (!m)
        fail_msg("%s", err.text);
    assert_true(mesh_check(m, NULL));
    assert_int_equal(m->triangles, 5856);
    assert_int_equal(m->vertices, 2930);
    assert_int_equal(m->uvs, 3225);
    assert_null(m->corner_normal); /* the file has none              */
    for (size_t t = 0; t < m->triangles; t++)
        assert_true(m->corner_uv[t][0] != MESH_NONE);
    mesh_free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_obj__faces_of_all_forms),
        cmocka_unit_test(test_obj__errors_say_where),
        cmocka_unit_test(test_obj__reads_a_real_mesh),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
