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
#include "lib/ply.h"
#include "tests/unit/temp_file.h"

static struct mesh *load_text(const char *text)
{
    struct brume_error err = {0};
    write_bytes(text, strlen(text));
    struct mesh *m = ply_load(path, &err);
    if (!m)
        fail_msg("%s", err.text);
    assert_true(mesh_check(m, NULL));
    return m;
}

static void refused(const char *text, const char *word)
{
    struct brume_error err = {0};
    write_bytes(text, strlen(text));
    assert_null(ply_load(path, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
    assert_non_null(strstr(err.text, path));
}

#define HEAD(vertices, faces)                                                  \
    "ply\nformat ascii 1.0\ncomment made by hand\n"                            \
    "element vertex " #vertices "\n"                                           \
    "property float x\nproperty float y\nproperty float z\n"                   \
    "element face " #faces "\n"                                                \
    "property list uchar int vertex_indices\nend_header\n"

static void test_ply__polygons_become_fans(void **state)
{
    (void)state;
    struct mesh *m = load_text(
        HEAD(5, 3) "0 0 0\n1 0 0\r\n1 1e0 0\n0 1 .5\n-1 .5 0\n"
                   "5 0 1 2 3 4\n2 0 1\n3 4 3 2\n");
    static const uint32_t expected[][3] = {
        {0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {4, 3, 2}};
    assert_int_equal(m->vertices, 5);
    assert_int_equal(m->triangles, 4);
    assert_memory_equal(m->corner, expected, sizeof expected);
    assert_true(m->position[3][2] == 0.5);
    assert_null(m->corner_normal);
    assert_null(m->corner_uv);
    mesh_free(m);
}

static const char with_all[] =
    "ply\nformat ascii 1.0\n"
    "element camera 1\nproperty list uint8 double pose\nproperty int id\n"
    "element face 1\nproperty uchar red\n"
    "property list char uint vertex_index\nproperty list int float texcoord\n"
    "element vertex 3\nproperty double z\nproperty double y\n"
    "property double x\nproperty uchar quality\nproperty float nx\n"
    "property float ny\nproperty float nz\nproperty float s\n"
    "property float t\nelement edge 1\nproperty int vertex1\nend_header\n"
    "2 0.5 0.5 7\n255 3 2 1 0 1 0.5\n"
    "3 2 1 9 0 1 0 0.25 0.75\n6 5 4 9 0 0 1 1 nan\n9 8 7 9 1 0 0 0 1\n";

static void test_ply__takes_normals_and_uvs_and_skips_the_rest(void **state)
{
    (void)state;
    struct mesh *m = load_text(with_all);
    assert_int_equal(m->triangles, 1);
    assert_int_equal(m->corner[0][0], 2);
    assert_true(m->position[0][0] == 1 && m->position[0][2] == 3);
    assert_int_equal(m->normals, 3);
    assert_true(m->normal[1][2] == 1);
    assert_int_equal(m->corner_normal[0][1], 1);
    assert_true(m->uv[0][0] == 0.25f && m->uv[0][1] == 0.75f);
    assert_true(m->uv[1][1] == 0);
    assert_int_equal(m->corner_uv[0][2], 0);
    mesh_free(m);
}

/* ---- binary ---- */

struct bytes {
    unsigned char data[4096];
    size_t size;
    bool big;
};

static void put(struct bytes *b, const void *value, size_t size)
{
    const unsigned char *from = value;
    for (size_t i = 0; i < size; i++)
        b->data[b->size++] = from[b->big ? size - 1 - i : i];
}

static void put_text(struct bytes *b, const char *text)
{
    memcpy(b->data + b->size, text, strlen(text));
    b->size += strlen(text);
}

/* A square with every type in it; the end of the header is `end`. */
static void make_binary(struct bytes *b, bool big, const char *end)
{
    b->size = 0;
    b->big = big;
    put_text(b, "ply\nformat binary_");
    put_text(b, big ? "big" : "little");
    put_text(b, "_endian 1.0\nelement vertex 4\nproperty double x\n"
                "property short y\nproperty int8 z\nproperty uint32 skip\n"
                "property list uint16 int16 more\nelement face 1\n"
                "property list int ushort vertex_indices\nend_header");
    put_text(b, end);
    for (int i = 0; i < 4; i++) {
        double x = i / 3.0;
        int16_t y = (int16_t)(-300 * i), more[2] = {1, 2};
        int8_t z = (int8_t)-i;
        uint32_t skip = 0x0a0d0a0d;
        uint16_t length = 2;
        put(b, &x, 8);
        put(b, &y, 2);
        put(b, &z, 1);
        put(b, &skip, 4);
        put(b, &length, 2);
        put(b, &more[0], 2);
        put(b, &more[1], 2);
    }
    int32_t length = 4;
    put(b, &length, 4);
    for (uint16_t i = 0; i < 4; i++)
        put(b, &i, 2);
}

static void test_ply__binary_of_both_endiannesses(void **state)
{
    (void)state;
    static const char *const ends[] = {"\n", "\r\n", " \n"};
    for (int i = 0; i < 6; i++) {
        struct bytes b;
        struct brume_error err = {0};
        make_binary(&b, i % 2, ends[i / 2]);
        write_bytes(b.data, b.size);
        struct mesh *m = ply_load(path, &err);
        if (!m)
            fail_msg("%s", err.text);
        assert_int_equal(m->vertices, 4);
        assert_true(m->position[1][0] == 1 / 3.0);
        assert_true(m->position[3][1] == -900 && m->position[3][2] == -3);
        assert_int_equal(m->triangles, 2);
        assert_int_equal(m->corner[1][2], 3);
        mesh_free(m);
    }
}

static void test_ply__damaged_files_are_errors(void **state)
{
    (void)state;
    struct bytes b, broken;
    make_binary(&b, false, "\n");
    for (size_t cut = 0; cut < b.size; cut++) {
        struct brume_error err = {0};
        write_bytes(b.data, cut);
        assert_null(ply_load(path, &err));
        assert_int_equal(err.code, BRUME_ERR_FILE);
    }
    uint32_t random = 1;
    for (int i = 0; i < 3000; i++) {
        broken = b;
        random = random * 1664525 + 1013904223;
        broken.data[(random >> 8) % b.size] ^= (unsigned char)(1 << i % 8);
        write_bytes(broken.data, broken.size);
        struct brume_error err = {0};
        struct mesh *m = ply_load(path, &err);
        assert_true(m ? mesh_check(m, NULL) : err.code != BRUME_OK);
        mesh_free(m);
    }
}

static void test_ply__errors_say_where(void **state)
{
    (void)state;
    refused("", "is not a PLY file");
    refused("plyx\n", "is not a PLY file");
    refused("ply\nend_header\n", "line 2: no format");
    refused("ply\nformat ascii 1.0\n", "ends in its header");
    refused("ply\nformat cbor 1.0\nend_header\n", "format 'cbor'");
    refused("ply\nformat ascii 1.0\nproperty int x\n", "before the first");
    refused("ply\nformat ascii 1.0\nelement vertex -1\n", "count -1");
    refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n",
            "line 4: unknown type 'half'");
    refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\n"
            "end_header\n",
            "no vertices with x, y and z");
    refused("ply\nformat ascii 1.0\nwhatever\n", "unknown word 'whatever'");
    refused(HEAD(3, 1) "0 0 0\n1 0 0\n1 one 0\n3 0 1 2\n",
            "line 13: 'one' is not a number");
    refused(HEAD(3, 1) "0 0 0\n1 nan 0\n1 1 0\n3 0 1 2\n",
            "line 12: vertex 1 has the coordinate nan");
    refused(HEAD(3, 1) "0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n",
            "line 14: face 0 names vertex 3");
    refused(HEAD(3, 1) "0 0 0\n1 0 0\n1 1 0\n3 0 1 -1\n", "names vertex -1");
    refused(HEAD(3, 1) "0 0 0\n1 0 0\n1 1 0\n-3 0 1 2\n", "length -3");
    refused(HEAD(3, 1) "0 0 0\n1 0 0\n1 1 0\n3 0 1\n", "ends too early");
    refused(HEAD(4000000000, 1) "0 0 0\n", "ends too early");
    refused(HEAD(9000000000000000, 1) "0 0 0\n", "limit");
}

/* Points need no faces, and take what they are named for. */
static void test_ply__points(void **state)
{
    (void)state;
    static const char head[] =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float heat\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float pscale\nproperty float mass\n"
        "property list uchar int more\nend_header\n"
        "900 1 2 3 0.5 7 1 9\n-inf 4 nan 6 -1 8 0\n";
    struct brume_error err = {0};
    write_bytes(head, sizeof head - 1);
    struct points *p = ply_load_points(path, "heat", &err);
    assert_non_null(p);
    assert_int_equal(p->count, 2);
    assert_true(p->at[0] == 1 && p->at[3] == 4 && isnan(p->at[4]));
    assert_true(p->radius[0] == 0.5 && p->radius[1] == -1);
    assert_true(p->mass[0] == 7 && p->mass[1] == 8);
    assert_true(p->value[0] == 900 && p->value[1] == -INFINITY);
    points_free(p);
    p = ply_load_points(path, "mass", &err);
    assert_true(p->value[1] == 8 && p->mass[1] == 8);
    points_free(p);
    p = ply_load_points(path, NULL, &err);
    assert_null(p->value);
    points_free(p);
    assert_null(ply_load_points(path, "temperature", &err));
    assert_non_null(strstr(err.text, "no property 'temperature'"));
    assert_non_null(strstr(err.text, "have heat, pscale, mass"));
    assert_null(ply_load(path, NULL));
    static const char flat[] = "ply\nformat ascii 1.0\nelement vertex 1\n"
                               "property float x\nend_header\n1\n";
    write_bytes(flat, sizeof flat - 1);
    memset(&err, 0, sizeof err);
    assert_null(ply_load_points(path, NULL, &err));
    assert_non_null(strstr(err.text, "no vertices with x, y and z"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ply__polygons_become_fans),
        cmocka_unit_test(test_ply__takes_normals_and_uvs_and_skips_the_rest),
        cmocka_unit_test(test_ply__binary_of_both_endiannesses),
        cmocka_unit_test(test_ply__damaged_files_are_errors),
        cmocka_unit_test(test_ply__errors_say_where),
        cmocka_unit_test(test_ply__points),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
