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
#include "lib/vdb.h"
#include "tests/unit/temp_file.h"

#define CAMPFIRE "../shared/data/campfire/campfire_01.vdb"

static struct grid *load(const char *file, const char *name)
{
    struct brume_error err = {0};
    struct grid *g = vdb_load(file, name, VDB_DENSITY, &err);
    if (!g)
        fail_msg("%s", err.text);
    return g;
}

static void refused(const char *file, const char *name, enum vdb_role role,
                    enum brume_code code, const char *word)
{
    struct brume_error err = {0};
    assert_null(vdb_load(file, name, role, &err));
    assert_int_equal(err.code, code);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
    assert_non_null(strstr(err.text, file));
}

static struct grid *make_grid(void)
{
    static const int32_t origin[3] = {-8, 16, 0}, bricks[3] = {2, 3, 1};
    struct grid *g = grid_new(origin, bricks, 0, NULL);
    assert_non_null(g);
    snprintf(g->name, sizeof g->name, "smoke");
    float *brick = grid_brick(g, 1, 2, 0, NULL);
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        brick[i] = (float)i / 512;
    assert_true(grid_set_tile(g, 0, 0, 0, 0.75f, NULL));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            g->to_world[i][j] = 1 + 10 * i + j * j;
    g->to_world[1][1] = -4;
    return g;
}

static void save(const struct grid *g, int flags)
{
    struct brume_error err = {0};
    if (!vdb_save(path, &g, 1, flags, &err))
        fail_msg("%s", err.text);
}

static void test_vdb__round_trip(void **state)
{
    (void)state;
    for (int flags = 0; flags < 4; flags++) {
        struct grid *g = make_grid();
        save(g, flags);
        struct grid *h = load(path, NULL);
        assert_string_equal(h->name, "smoke");
        assert_memory_equal(h->origin, g->origin, sizeof g->origin);
        assert_memory_equal(h->bricks, g->bricks, sizeof g->bricks);
        assert_memory_equal(h->to_world, g->to_world, sizeof g->to_world);
        for (int z = -1; z < 9; z++)
            for (int y = 14; y < 42; y++)
                for (int x = -10; x < 10; x++)
                    assert_true(grid_sample(h, x, y, z) ==
                                grid_sample(g, x, y, z));
        assert_int_equal(h->stored, 1);
        assert_false(h->clip);
        assert_int_equal(h->filter, GRID_TRILINEAR);
        struct vdb_list *list = vdb_list_new(path, NULL);
        assert_non_null(list);
        assert_int_equal(list->count, 1);
        assert_int_equal(list->entry[0].kind, VDB_FOG);
        assert_int_equal(list->entry[0].active_voxels, 1023);
        assert_int_equal(list->entry[0].half, flags & VDB_SAVE_HALF);
        vdb_list_free(list);
        grid_free(h);
        grid_free(g);
    }
}

static void test_vdb__bad_samples_are_counted(void **state)
{
    (void)state;
    struct grid *g = make_grid();
    float *brick = grid_brick(g, 1, 2, 0, NULL);
    brick[1] = NAN;
    brick[2] = INFINITY;
    brick[3] = -INFINITY;
    brick[4] = -1;
    save(g, VDB_SAVE_ZIP);
    struct grid *h = load(path, "smoke");
    assert_int_equal(h->bad_nan, 1);
    assert_int_equal(h->bad_inf, 2);
    assert_int_equal(h->bad_negative, 1);
    assert_true(h->lowest == 0 && h->highest == 511 / 512.0f);
    grid_free(h);
    grid_free(g);
}

static void test_vdb__one_voxel_and_none(void **state)
{
    (void)state;
    static const int32_t origin[3] = {0, 0, -80000};
    static const int32_t bricks[3] = {1, 1, 1};
    struct grid *g = grid_new(origin, bricks, 0, NULL);
    save(g, 0);
    struct grid *h = load(path, NULL);
    assert_int_equal(h->stored, 0);
    assert_true(h->highest == 0);
    grid_free(h);
    grid_brick(g, 0, 0, 0, NULL)[511] = 3;
    save(g, VDB_SAVE_HALF);
    h = load(path, "");
    assert_int_equal(h->stored, 1);
    assert_true(grid_sample(h, 7, 7, -79993) == 3);
    assert_true(grid_sample(h, 7, 7, -79992) == 0);
    grid_free(h);
    grid_free(g);
}

/* kinds.vdb: one active voxel at (-3, 5, 9) in a grid of each scalar type;
 * grids that are no fog; written by OpenVDB itself, ZIP. */
static void test_vdb__takes_every_scalar_type(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        float value;
    } cases[] = {
        {"real", 1.25f},
        {"count", 7},
        {"big", 0x1p40f},
        {"mask", 1},
    };
    for (int i = 0; i < 4; i++) {
        struct grid *g = load("tests/data/kinds.vdb", cases[i].name);
        assert_true(grid_sample(g, -3, 5, 9) == cases[i].value);
        assert_true(grid_sample(g, -2, 5, 9) == (i == 2 ? 1 : 0));
        grid_free(g);
    }
    struct grid *g = load("tests/data/kinds.vdb", "empty");
    assert_int_equal(g->stored, 0);
    grid_free(g);
}

static void test_vdb__refuses_with_the_remedy(void **state)
{
    (void)state;
    static const char kinds[] = "tests/data/kinds.vdb";
    const enum brume_code code = BRUME_ERR_FILE;
    refused(kinds, "surface", VDB_DENSITY, code, "convert it to a fog");
    refused(kinds, "velocity", VDB_DENSITY, code, "vec3s");
    refused(kinds, "view", VDB_DENSITY, code, "resample");
    refused(kinds, "nothing", VDB_DENSITY, code, "no grid named 'nothing'");
    refused(kinds, NULL, VDB_DENSITY, code, "count (int32), ");
    refused(kinds, NULL, VDB_FLAME, code, "flame or flames or burn");
    refused("tests/data/far.vdb", NULL, VDB_DENSITY, BRUME_ERR_LIMIT,
            "too large");
    refused("tests/data/stream.vdb", NULL, VDB_DENSITY, code, "as a file");
    refused("tests/data/uint.exr", NULL, VDB_DENSITY, code,
            "is not a VDB file");
    refused("/no/such.vdb", NULL, VDB_DENSITY, code, "No such file");
    refused("/tmp", NULL, VDB_DENSITY, code, "directory");
}

/* tiles.vdb: 0.5 outside; 2 in a tile of 128^3; beside it bricks of 3 (on)
 * and 4 (off), a leaf with 5 (on) and 6 (off); a transform that turns; a grid
 * that shares the tree under another transform; the name again; Blosc. */
static void test_vdb__tiles_of_all_levels(void **state)
{
    (void)state;
    static const double to_world[3][4] = {
        {0, -3, 0.25, 10},
        {2, 0, 0, 20},
        {0, 0, 0.5, 30},
    };
    struct grid *g = load("tests/data/tiles.vdb", NULL);
    assert_string_equal(g->name, "density[0]");
    assert_true(grid_sample(g, 0, 0, 0) == 2);
    assert_true(grid_sample(g, 127, 127, 127) == 2);
    assert_true(grid_sample(g, 128, 127, 127) == 0.5f);
    assert_true(grid_sample(g, 131, 8, 0) == 3);
    assert_true(grid_sample(g, 128, 0, 0) == 5);
    assert_true(grid_sample(g, 129, 0, 0) == 6);
    assert_true(grid_sample(g, 130, 0, 0) == 0.5f);
    assert_true(grid_sample(g, -1, 0, 0) == 0.5f);
    assert_true(g->lowest == 0.5f && g->highest == 6);
    assert_int_equal(g->stored, 1);
    assert_int_equal(g->tiles, 3);
    assert_memory_equal(g->to_world, to_world, sizeof to_world);
    grid_free(g);
    g = load("tests/data/tiles.vdb", "shared");
    assert_true(grid_sample(g, 131, 8, 0) == 3);
    assert_true(g->to_world[1][1] == 0.5 && g->to_world[1][3] == 0);
    grid_free(g);
    g = load("tests/data/tiles.vdb", "density[1]");
    assert_true(g->highest == 0);
    grid_free(g);
}

static void test_vdb__grids_are_chosen_by_name(void **state)
{
    (void)state;
    static const struct {
        const char *held[4];
        enum vdb_role role;
        const char *chosen;
    } cases[] = {
        {{"smoke", "density", "x"}, VDB_DENSITY, "density"},
        {{"heat", "smoke"}, VDB_DENSITY, "smoke"},
        {{"cloud"}, VDB_DENSITY, "cloud"},
        {{"cloud", "fog"}, VDB_DENSITY, NULL},
        {{"surface", "fog"}, VDB_DENSITY, "fog"},
        {{"heat", "temperature"}, VDB_TEMPERATURE, "temperature"},
        {{"density", "heat"}, VDB_TEMPERATURE, "heat"},
        {{"density"}, VDB_TEMPERATURE, NULL},
        {{"burn", "flames"}, VDB_FLAME, "flames"},
        {{"v"}, VDB_VELOCITY, "v"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct vdb_entry entry[4];
        struct vdb_list list = {.entry = entry};
        memset(entry, 0, sizeof entry);
        for (; list.count < 4 && cases[i].held[list.count]; list.count++) {
            snprintf(entry[list.count].name, sizeof entry->name, "%s",
                     cases[i].held[list.count]);
            entry[list.count].scalar = true;
            if (strcmp(cases[i].held[list.count], "surface") == 0)
                entry[list.count].kind = VDB_LEVEL_SET;
        }
        struct brume_error err = {0};
        const struct vdb_entry *e = vdb_choose(&list, cases[i].role, "x.vdb",
                                               &err);
        if (cases[i].chosen)
            assert_string_equal(e->name, cases[i].chosen);
        else
            assert_null(e);
        assert_int_equal(err.code, e ? BRUME_OK : BRUME_ERR_FILE);
    }
}

/* ---- damaged files ---- */

static unsigned char *whole, *broken;
static size_t size;

static void read_whole(const char *file)
{
    FILE *f = fopen(file, "rb");
    assert_non_null(f);
    fseek(f, 0, SEEK_END);
    size = (size_t)ftell(f);
    rewind(f);
    whole = malloc(size);
    broken = malloc(size);
    assert_int_equal(fread(whole, 1, size, f), size);
    fclose(f);
}

static void free_parts(struct grid *const part[3])
{
    for (int i = 0; i < 3; i++)
        grid_free(part[i]);
}

/* Whatever the bytes, a grid or an error. */
static bool survives(const unsigned char *bytes, size_t count,
                     const char *const *names)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, count, f), count);
    fclose(f);
    bool all = true;
    for (; *names; names++) {
        struct brume_error err = {0};
        struct grid *g = vdb_load(path, *names, VDB_DENSITY, &err);
        assert_true(g || (err.code != BRUME_OK && strstr(err.text, path)));
        all = all && g;
        grid_free(g);
    }
    struct brume_error err = {0};
    struct grid *part[3];
    if (vdb_load_velocity(path, NULL, part, &err))
        free_parts(part);
    else
        assert_true(err.code != BRUME_OK && strstr(err.text, path));
    return all;
}

static uint32_t next_random(uint32_t *random)
{
    *random = *random * 1664525 + 1013904223;
    return *random >> 4;
}

/* Bits flip anywhere, and often near the front and in the topology, where
 * counts and sizes are. */
static void flip_bits(const char *const *names, int times)
{
    uint32_t random = 1;
    for (int i = 0; i < times; i++) {
        size_t range = i % 3 == 0 ? size : i % 3 == 1 ? 1024 : 40000;
        memcpy(broken, whole, size);
        for (int k = 0; k <= i % 4; k++)
            broken[next_random(&random) % (range < size ? range : size)] ^=
                (unsigned char)(1 << next_random(&random) % 8);
        survives(broken, size, names);
    }
}

static void test_vdb__damaged_files_are_errors(void **state)
{
    (void)state;
    static const char *const names[] = {"real", "count", "big", "mask", NULL};
    read_whole("tests/data/kinds.vdb");
    assert_true(survives(whole, size, names));
    for (size_t cut = 0; cut < size; cut += size / 40)
        assert_false(survives(whole, cut, names));
    flip_bits(names, 400);
    free(whole);
    free(broken);
    static const char *const tiles[] = {"density", "shared", NULL};
    read_whole("tests/data/tiles.vdb");
    assert_true(survives(whole, size, tiles));
    flip_bits(tiles, 400);
    free(whole);
    free(broken);
}

static void test_vdb__damaged_fire_is_an_error(void **state)
{
    (void)state;
    if (access(CAMPFIRE, R_OK) != 0) {
        print_message("no " CAMPFIRE " here\n");
        skip();
    }
    static const char *const names[] = {"density", NULL};
    read_whole(CAMPFIRE);
    assert_true(survives(whole, size, names));
    for (int i = 0; i < 40; i++)
        assert_false(survives(whole, size / 40 * (size_t)i, names));
    flip_bits(names, 200);
    free(whole);
    free(broken);
}

/* Any sign, each part its own; what was written is read. */
static void test_vdb__velocities(void **state)
{
    (void)state;
    struct brume_error err = {0};
    const int32_t origin[3] = {-8, 0, 8}, bricks[3] = {1, 2, 1};
    struct grid *made[3], *part[3];
    for (int i = 0; i < 3; i++) {
        made[i] = grid_new(origin, bricks, 0.0f, &err);
        float *brick = grid_brick(made[i], 0, 1, 0, &err);
        for (int v = 0; v < GRID_BRICK_VOXELS; v++)
            brick[v] = (float)((i - 1) * 100 + v);
        for (int k = 0; k < 3; k++)
            made[i]->to_world[k][k] = 0.5;
        strcpy(made[i]->name, "vel");
        made[i]->any_sign = true;
        grid_finish(made[i]);
    }
    assert_true(made[0]->lowest == -100.0f);
    assert_int_equal(made[0]->bad_negative, 0);
    const struct grid *const all[3] = {made[0], made[1], made[2]};
    assert_true(vdb_save(path, all, 3, VDB_SAVE_HALF | VDB_SAVE_ZIP, &err));
    assert_true(vdb_load_velocity(path, NULL, part, &err));
    for (int i = 0; i < 3; i++) {
        assert_true(part[i]->any_sign);
        assert_true(grid_sample(part[i], -8, 8, 8) == (float)(i - 1) * 100.0f);
        assert_true(grid_sample(part[i], -7, 9, 8) ==
                    (float)((i - 1) * 100 + 9));
        assert_true(grid_sample(part[i], -8, 0, 8) == 0.0f);
        assert_true(part[i]->to_world[0][0] == 0.5 &&
                    part[i]->to_world[0][3] == 0.0);
    }
    free_parts(part);
    free_parts(made);
    assert_true(
        vdb_load_velocity("tests/data/kinds.vdb", "velocity", part, &err));
    free_parts(part);
    assert_false(vdb_load_velocity("tests/data/kinds.vdb", "real", part, &err));
    assert_non_null(strstr(err.text, "a velocity is a grid of vectors"));
}

/* Those of a staggered grid are on the faces of its voxels. */
static void test_vdb__staggered_fire(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct grid *part[3];
    if (access(CAMPFIRE, R_OK) != 0) {
        print_message("no " CAMPFIRE " here\n");
        skip();
    }
    struct grid *g = vdb_load(CAMPFIRE, NULL, VDB_DENSITY, &err);
    assert_non_null(g);
    assert_true(vdb_load_velocity(CAMPFIRE, NULL, part, &err));
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            assert_float_equal(part[i]->to_world[k][3] - g->to_world[k][3],
                               i == k ? -0.5 / 30.0 : 0.0, 1e-6);
    /* Fire rises. */
    assert_true(part[2]->highest > 3.0f * part[0]->highest);
    assert_true(part[2]->lowest < 0.0f);
    free_parts(part);
    grid_free(g);
}

static void test_vdb__loads_real_fire(void **state)
{
    (void)state;
    if (access(CAMPFIRE, R_OK) != 0) {
        print_message("no " CAMPFIRE " here\n");
        skip();
    }
    struct vdb_list *list = vdb_list_new(CAMPFIRE, NULL);
    assert_non_null(list);
    assert_int_equal(list->count, 4);
    assert_string_equal(vdb_choose(list, VDB_FLAME, "", NULL)->name, "flame");
    const struct vdb_entry *v = vdb_choose(list, VDB_VELOCITY, "", NULL);
    assert_string_equal(v->type, "vec3s");
    assert_int_equal(v->kind, VDB_STAGGERED);
    vdb_list_free(list);
    struct brume_error err = {0};
    struct grid *g = vdb_load(CAMPFIRE, NULL, VDB_TEMPERATURE, &err);
    assert_non_null(g);
    assert_string_equal(g->name, "temperature");
    assert_true(g->highest > 1 && g->highest < 2.2f);
    assert_int_equal(g->bad_nan + g->bad_inf, 0);
    assert_true(fabs(g->to_world[2][2] - 1 / 30.0) < 1e-6);
    grid_free(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vdb__round_trip),
        cmocka_unit_test(test_vdb__bad_samples_are_counted),
        cmocka_unit_test(test_vdb__one_voxel_and_none),
        cmocka_unit_test(test_vdb__takes_every_scalar_type),
        cmocka_unit_test(test_vdb__refuses_with_the_remedy),
        cmocka_unit_test(test_vdb__tiles_of_all_levels),
        cmocka_unit_test(test_vdb__grids_are_chosen_by_name),
        cmocka_unit_test(test_vdb__damaged_files_are_errors),
        cmocka_unit_test(test_vdb__damaged_fire_is_an_error),
        cmocka_unit_test(test_vdb__velocities),
        cmocka_unit_test(test_vdb__staggered_fire),
        cmocka_unit_test(test_vdb__loads_real_fire),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
