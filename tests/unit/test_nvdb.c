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
#include "lib/nvdb_file.h"
#include "tests/unit/temp_file.h"

/* The files are other programs', by oracle/nvdb.py; those of kinds.vdb and
 * tiles.vdb hold what OpenVDB reads of these. */
#define DATA(name) "tests/data/" name

static struct grid *load(const char *file, const char *name)
{
    struct brume_error err = {0};
    struct grid *g = nvdb_load(file, name, VDB_DENSITY, &err);
    if (!g)
        fail_msg("%s", err.text);
    return g;
}

static void refused(const char *file, const char *name, enum vdb_role role,
                    const char *word)
{
    struct brume_error err = {0};
    if (nvdb_load(file, name, role, &err))
        fail_msg("'%s' is read; wanted: %s", file, word);
    assert_int_equal(err.code, BRUME_ERR_FILE);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
    assert_non_null(strstr(err.text, file));
}

/* In all samples, and some around. */
static void assert_same(const struct grid *a, const struct grid *b)
{
    assert_memory_equal(a->origin, b->origin, sizeof a->origin);
    assert_memory_equal(a->bricks, b->bricks, sizeof a->bricks);
    assert_memory_equal(a->to_world, b->to_world, sizeof a->to_world);
    assert_int_equal(a->stored, b->stored);
    assert_int_equal(a->tiles, b->tiles);
    const int32_t *o = a->origin, *n = a->bricks;
    for (int z = o[2] - 2; z < o[2] + 8 * n[2] + 2; z++)
        for (int y = o[1] - 2; y < o[1] + 8 * n[1] + 2; y++)
            for (int x = o[0] - 2; x < o[0] + 8 * n[0] + 2; x++)
                if (grid_sample(a, x, y, z) != grid_sample(b, x, y, z))
                    fail_msg("differ at %d %d %d", x, y, z);
}

static void test_nvdb__holds_what_openvdb_reads(void **state)
{
    (void)state;
    static const char *const names[][3] = {
        {DATA("kinds"), "real", "real"},
        {DATA("kinds"), "count", "count"},
        {DATA("kinds"), "big", "big"},
        {DATA("kinds"), "mask", "mask"},
        {DATA("kinds"), "empty", "empty"},
        {DATA("tiles"), "density", "density[0]"},
        {DATA("tiles"), "density[1]", "density[1]"},
        {DATA("tiles"), "shared", "shared"},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char file[2][64];
        snprintf(file[0], sizeof file[0], "%s.nvdb", names[i][0]);
        snprintf(file[1], sizeof file[1], "%s.vdb", names[i][0]);
        struct brume_error err = {0};
        struct grid *a = load(file[0], names[i][1]);
        struct grid *b = vdb_load(file[1], names[i][2], VDB_DENSITY, &err);
        assert_non_null(b);
        assert_string_equal(a->name, names[i][1]);
        assert_same(a, b);
        grid_free(b);
        grid_free(a);
    }
}

/* The ramp of oracle/nvdb.py. */
static float ramp(int x, int y, int z)
{
    return (float)(x + 100 * y + 10000 * z) / 4;
}

/* codes.nvdb: a ramp of 9 x 8 x 8 in 4, 8, 16 and as many bits as FpN takes,
 * each a segment of its own. A code is off by half a quantum at most, of the
 * range over the number of codes less 1. */
static void test_nvdb__quantised_types(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double codes;
    } types[] = {{"density", 15},
                 {"density[1]", 255},
                 {"density[2]", 65535},
                 {"density[3]", 65535}};
    for (int i = 0; i < 4; i++) {
        struct grid *g = load(DATA("codes.nvdb"), types[i].name);
        double bound = 0.51 * ramp(8, 7, 7) / types[i].codes;
        for (int z = 0; z < 8; z++)
            for (int y = 0; y < 8; y++)
                for (int x = 0; x < 9; x++)
                    assert_float_equal(grid_sample(g, x, y, z), ramp(x, y, z),
                                       bound);
        assert_true(grid_sample(g, 3, 4, 8) == 0);
        grid_free(g);
    }
}

/* warp.nvdb: NVIDIA's Warp writes no box, no number of voxels, no name, and
 * leaves out the size of the block in the metadata. */
static void test_nvdb__as_warp_writes_it(void **state)
{
    (void)state;
    struct grid *g = load(DATA("warp.nvdb"), NULL);
    for (int z = 0; z < 17; z++)
        for (int y = 0; y < 3; y++)
            for (int x = 0; x < 9; x++)
                assert_true(grid_sample(g, x, y, z) == ramp(x, y, z));
    assert_true(grid_sample(g, 9, 0, 0) == 0.25f);
    assert_true(grid_sample(g, 0, 0, -1) == 0.25f);
    static const double place[3] = {-4, 2, 8};
    for (int i = 0; i < 3; i++) {
        assert_true(g->to_world[i][i] == 0.5);
        assert_true(g->to_world[i][3] == place[i]);
    }
    grid_free(g);
}

static void test_nvdb__lists_and_refuses(void **state)
{
    (void)state;
    static const char kinds[] = DATA("kinds.nvdb");
    struct vdb_list *list = nvdb_list_new(DATA("tiles.nvdb"), NULL);
    assert_non_null(list);
    assert_int_equal(list->count, 3);
    assert_string_equal(list->entry[1].name, "density[1]");
    assert_string_equal(list->entry[1].type, "float");
    assert_int_equal(list->entry[2].active_voxels, 2097665);
    vdb_list_free(list);
    refused(kinds, "surface", VDB_DENSITY, "convert it to a fog");
    refused(kinds, "velocity", VDB_DENSITY, "vec3f");
    refused(kinds, "nothing", VDB_DENSITY, "no grid named 'nothing'");
    refused(kinds, NULL, VDB_DENSITY, "count (int32), ");
    refused(kinds, NULL, VDB_FLAME, "flame or flames or burn");
    refused(DATA("kinds.vdb"), NULL, VDB_DENSITY, "is not a NanoVDB file");
    refused("/no/such.nvdb", NULL, VDB_DENSITY, "No such file");
    refused(path, NULL, VDB_DENSITY, "is not a NanoVDB file");
}

/* ---- bare grids, whole and damaged ---- */

static void write_file(const unsigned char *bytes, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
}

/* The unpacked bytes of a file's i-th grid, as 32.6 begins them. */
static unsigned char *bare(const char *file, size_t i, size_t *size)
{
    struct nvdb_file f;
    struct brume_error err = {0};
    assert_true(nvdb_file_open(&f, file, &err));
    unsigned char *bytes = nvdb_file_grid(&f, &f.record[i]);
    assert_non_null(bytes);
    *size = f.record[i].size;
    bytes[7] = '1';
    nvdb_file_close(&f);
    return bytes;
}

static void test_nvdb__bare_grids(void **state)
{
    (void)state;
    size_t size;
    unsigned char *bytes = bare(DATA("tiles.nvdb"), 0, &size);
    struct grid *a = load(DATA("tiles.nvdb"), NULL);
    write_file(bytes, size);
    struct grid *b = load(path, "density");
    assert_same(a, b);
    grid_free(b);
    grid_free(a);
    free(bytes);
}

/* What is changed in the bare grid of `real` or `density`, and the answer. */
static void test_nvdb__damage_is_named(void **state)
{
    (void)state;
    enum { TREE = NVDB_GRID, ROOT = NVDB_GRID + NVDB_TREE };
    static const struct {
        size_t at;
        unsigned char value;
        const char *word;
    } cases[] = {
        {TREE + 29, 1, "points outside"},      /* the root              */
        {TREE + 31, 0x80, "points outside"},   /* before the begin      */
        {ROOT + 64 + 14, 1, "points outside"}, /* an upper node         */
        {ROOT + 27, 1, "points outside"},      /* number of tiles       */
        {19, 0x05, "versions 32.x"},
        {39, 1, "outside of it"}, /* size of the grid      */
        {636, 7, "vec3d"},
        {632, 1, "level set"},
        {296 + 88 + 7, 0x7f, "not finite"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size;
        unsigned char *bytes = bare(DATA("tiles.nvdb"), 0, &size);
        bytes[cases[i].at] = cases[i].value;
        if (cases[i].value == 0x7f) /* a NaN needs its exponent whole      */
            bytes[cases[i].at - 1] = 0xf8;
        write_file(bytes, size);
        refused(path, NULL, VDB_DENSITY, cases[i].word);
        free(bytes);
    }
}

/* warp.nvdb, unpacked: a header and metadata that say so, then its grid. */
static unsigned char *plain(size_t *size)
{
    enum { FRONT = 16 + 176 + 1 };
    unsigned char *grid = bare(DATA("warp.nvdb"), 0, size);
    unsigned char *bytes = malloc(FRONT + *size);
    assert_non_null(bytes);
    FILE *f = fopen(DATA("warp.nvdb"), "rb");
    assert_non_null(f);
    assert_int_equal(fread(bytes, 1, FRONT, f), FRONT);
    fclose(f);
    bytes[14] = bytes[16 + 168] = 0; /* the codec                          */
    memcpy(bytes + FRONT, grid, *size);
    *size += FRONT;
    free(grid);
    return bytes;
}

static void test_nvdb__damaged_segments_are_named(void **state)
{
    (void)state;
    static const struct {
        size_t at;
        unsigned char value;
        const char *word;
    } cases[] = {
        {16 + 5, 1, "outside of it"}, /* the size, by 2^40                 */
        {16 + 32, 2, "not of the type"},   {16 + 168, 3, "codec of number 3"},
        {16 + 137, 2, "name is too long"}, {8 + 3, 0x05, "versions 32.x"},
    };
    size_t size;
    unsigned char *bytes = plain(&size);
    write_file(bytes, size);
    grid_free(load(path, NULL));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char old = bytes[cases[i].at];
        bytes[cases[i].at] = cases[i].value;
        write_file(bytes, size);
        refused(path, NULL, VDB_DENSITY, cases[i].word);
        bytes[cases[i].at] = old;
    }
    free(bytes);
}

/* A header that says 4097, and metadata of as many empty grids. */
static void test_nvdb__too_many_grids(void **state)
{
    (void)state;
    enum { HEADER = 16, RECORD = 176, VERSION = 172, MANY = 4097 };
    size_t size;
    unsigned char *bytes = plain(&size);
    unsigned char *more = calloc(HEADER + MANY * RECORD, 1);
    assert_non_null(more);
    memcpy(more, bytes, HEADER);
    more[12] = MANY & 255;
    more[13] = MANY >> 8;
    for (size_t i = 0; i < MANY; i++)
        memcpy(more + HEADER + i * RECORD + VERSION, bytes + 8, 4);
    write_file(more, HEADER + MANY * RECORD);
    refused(path, NULL, VDB_DENSITY, "many grids");
    free(more);
    free(bytes);
}

static void test_nvdb__wide_codes_are_refused(void **state)
{
    (void)state;
    size_t size;
    unsigned char *bytes = bare(DATA("codes.nvdb"), 3, &size);
    bytes[NVDB_GRID + NVDB_TREE + 64 + 32 + 270400 + 33856 + 15] = 7 << 5;
    write_file(bytes, size);
    refused(path, NULL, VDB_DENSITY, "over 16 bits");
    free(bytes);
}

/* A node that is its parent's child twice does not make twice the voxels. */
static void test_nvdb__no_node_counts_twice(void **state)
{
    (void)state;
    size_t size;
    unsigned char *bytes = bare(DATA("warp.nvdb"), 0, &size);
    uint64_t lower = NVDB_GRID + NVDB_TREE + 64 + 32 + 270400;
    uint64_t table = lower + 1088, children = lower + 32 + 512;
    for (size_t i = 0; i < 512; i++)
        bytes[children + i] = 0xff;
    for (size_t i = 1; i < 4096; i++)
        memmove(bytes + table + 8 * i, bytes + table, 8);
    write_file(bytes, size);
    refused(path, NULL, VDB_DENSITY, "nodes that lie on each other");
    free(bytes);
}

/* So for tiles of the root: two with one key. */
static void test_nvdb__no_tile_counts_twice(void **state)
{
    (void)state;
    size_t size;
    unsigned char *bytes = bare(DATA("tiles.nvdb"), 1, &size);
    uint64_t root = NVDB_GRID + NVDB_TREE, tiles = 64 * 1024;
    unsigned char *more = calloc(1, root + 64 + 32 * tiles);
    assert_non_null(more);
    memcpy(more, bytes, size);
    size = root + 64 + 32 * tiles;
    memcpy(more + 32, &size, 8);
    memcpy(more + root + 24, &(uint32_t){(uint32_t)tiles}, 4);
    for (size_t i = 0; i < tiles; i++) {
        unsigned char *tile = more + root + 64 + 32 * i;
        memset(tile, 0, 32);
        tile[16] = 1;    /* active                                         */
        tile[23] = 0x3f; /* 0.5                                            */
    }
    write_file(more, size);
    refused(path, NULL, VDB_DENSITY, "tiles that lie on each other");
    free(more);
    free(bytes);
}

static uint32_t next_random(uint32_t *random)
{
    *random = *random * 1664525 + 1013904223;
    return *random >> 4;
}

static bool survives(const unsigned char *bytes, size_t size)
{
    struct brume_error err = {0};
    write_file(bytes, size);
    struct grid *g = nvdb_load(path, "", VDB_DENSITY, &err);
    assert_true(g || (err.code != BRUME_OK && strstr(err.text, path)));
    bool made = g != NULL;
    grid_free(g);
    return made;
}

/* Bits flip in bytes that say something: those that are not 0. */
static void flip_bits(unsigned char *bytes, size_t size, int times)
{
    uint32_t random = 1;
    size_t *told = malloc(size * sizeof *told), count = 0;
    assert_non_null(told);
    for (size_t i = 0; i < size; i++)
        if (bytes[i])
            told[count++] = i;
    for (int i = 0; i < times; i++) {
        size_t at = told[next_random(&random) % count];
        unsigned char old = bytes[at];
        bytes[at] ^= (unsigned char)(1 << next_random(&random) % 8);
        survives(bytes, size);
        bytes[at] = old;
    }
    assert_true(survives(bytes, size));
    free(told);
}

static void test_nvdb__damaged_grids_are_errors(void **state)
{
    (void)state;
    static const char *const files[] = {DATA("codes.nvdb"), DATA("tiles.nvdb"),
                                        DATA("warp.nvdb")};
    for (size_t i = 0; i < 3; i++) {
        size_t size;
        unsigned char *bytes = bare(files[i], i == 0 ? 3 : 0, &size);
        flip_bits(bytes, size, 200);
        free(bytes);
    }
}

/* Of the packed files every bit and every length. */
static void test_nvdb__damaged_files_are_errors(void **state)
{
    (void)state;
    unsigned char bytes[2285];
    FILE *f = fopen(DATA("warp.nvdb"), "rb");
    assert_non_null(f);
    assert_int_equal(fread(bytes, 1, sizeof bytes, f), sizeof bytes);
    fclose(f);
    for (size_t cut = 0; cut < sizeof bytes; cut += 7)
        assert_false(survives(bytes, cut));
    for (size_t i = 0; i < 8 * sizeof bytes; i += i < 8 * 220 ? 1 : 29) {
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
        survives(bytes, sizeof bytes);
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nvdb__holds_what_openvdb_reads),
        cmocka_unit_test(test_nvdb__quantised_types),
        cmocka_unit_test(test_nvdb__as_warp_writes_it),
        cmocka_unit_test(test_nvdb__lists_and_refuses),
        cmocka_unit_test(test_nvdb__bare_grids),
        cmocka_unit_test(test_nvdb__damage_is_named),
        cmocka_unit_test(test_nvdb__damaged_segments_are_named),
        cmocka_unit_test(test_nvdb__too_many_grids),
        cmocka_unit_test(test_nvdb__wide_codes_are_refused),
        cmocka_unit_test(test_nvdb__no_node_counts_twice),
        cmocka_unit_test(test_nvdb__no_tile_counts_twice),
        cmocka_unit_test(test_nvdb__damaged_grids_are_errors),
        cmocka_unit_test(test_nvdb__damaged_files_are_errors),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
