/* METHODS.md, section 12, for densities as they come from files: df3, OpenVDB,
 * NanoVDB and particles. Of no kind does an empty grid, one voxel, a NaN, an
 * infinity, a negative number or a density of 1e-30 or 1e12 leave the picture
 * wrong or unfinished. A df3 file holds 0 to 1 and nothing else. */
#include "tests/unit/truth.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "lib/df3.h"
#include "lib/nvdb_file.h"
#include "lib/ply.h"
#include "tests/unit/temp_file.h"

enum kind { DF3, VDB, NVDB, PARTICLES, KINDS };

/* What a file holds: a cube of one value, of 0, of a voxel of 1 among 0, or of
 * values some of which are none. */
enum content { VALUE, EMPTY, VOXEL, FAULTY };

static const char *const kind_name[] = {"df3", "vdb", "nvdb", "particles"};
static float sample_of(enum content content, float value, int i)
{
    static const float faults[] = {NAN, INFINITY, -INFINITY, -3, 2};
    switch (content) {
    case VALUE:
        return value;
    case VOXEL:
        return i == 0 ? value : 0;
    case FAULTY:
        return faults[i % 5];
    default:
        return 0;
    }
}

/* ---- files; the density's cube goes from 0 to 1 along z ---------------- */

static struct grid *df3(enum content content, float value)
{
    unsigned char bytes[6 + 4 * 512] = {0, 8, 0, 8, 0, 8};
    bool one = content == VOXEL;
    uint32_t code = (uint32_t)llround((double)value * UINT32_MAX);
    for (int i = 0; i < 512 && content != EMPTY; i++)
        for (int b = 0; b < 4; b++)
            bytes[6 + 4 * i + b] = (unsigned char)(code >> (24 - 8 * b));
    if (one)
        bytes[1] = bytes[3] = bytes[5] = 1;
    write_bytes(bytes, one ? 10 : sizeof bytes);
    return df3_load(path, GRID_TRILINEAR, truth_error());
}

static struct grid *vdb(enum content content, float value)
{
    static const int32_t origin[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    struct grid *g = grid_new(origin, one, 0, truth_error());
    float *brick = grid_brick(g, 0, 0, 0, truth_error());
    for (int i = 0; i < 512; i++)
        brick[i] = sample_of(content, value, i);
    snprintf(g->name, sizeof g->name, "density");
    assert_true(
        vdb_save(path, (const struct grid *const *)&g, 1, 0, truth_error()));
    grid_free(g);
    return vdb_load(path, NULL, VDB_DENSITY, truth_error());
}

/* The leaves of warp.nvdb, with other values; its empty grids are kinds.nvdb's,
 * as is its one voxel, of 1.25. */
static struct grid *nvdb(enum content content, float value)
{
    enum { LEAVES = 672 + 64 + 64 + 32 + 270400 + 33856, LEAF = 2144 };
    static const char kinds[] = "tests/data/kinds.nvdb";
    if (content == EMPTY || content == VOXEL)
        return nvdb_load(kinds, content == EMPTY ? "empty" : "real",
                         VDB_DENSITY, truth_error());
    struct nvdb_file f;
    assert_true(nvdb_file_open(&f, "tests/data/warp.nvdb", truth_error()));
    unsigned char *bytes = nvdb_file_grid(&f, &f.record[0]);
    assert_non_null(bytes);
    bytes[7] = '1';
    for (int leaf = 0; leaf < 6; leaf++)
        for (int i = 0; i < 512; i++) {
            float v = sample_of(content, value, i);
            memcpy(bytes + LEAVES + LEAF * leaf + 96 + 4 * i, &v, sizeof v);
        }
    write_bytes(bytes, f.record[0].size);
    free(bytes);
    nvdb_file_close(&f);
    return nvdb_load(path, NULL, VDB_DENSITY, truth_error());
}

/* One ball of radius 1/2, of the mass that makes it as deep along z as a cube
 * of the value is; faulty ones beside it. */
static struct grid *particles(enum content content, float value)
{
    static const char *const faults[] = {
        "nan 0 0 0.5 1",  "0 -inf 0.5 0.5 1", "0 0 0 -1 1",
        "0 0 0.5 0.5 -1", "0 0 0.5 0.5 nan",  "0 0 0.5 inf 1",
    };
    double mass = content == EMPTY ? 0
                                   : (double)value * 2 * 3.14159265358979 / 36;
    int bad = content == FAULTY ? 6 : 0;
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\n"
            "property float y\nproperty float z\nproperty float radius\n"
            "property float mass\nend_header\n0 0 0.5 %g %.9g\n",
            1 + bad, content == VOXEL ? 0 : 0.5, mass);
    for (int i = 0; i < bad; i++)
        fprintf(f, "%s\n", faults[i]);
    fclose(f);
    struct points *points = ply_load_points(path, NULL, truth_error());
    assert_non_null(points);
    struct brume_particles p = BRUME_PARTICLES_INIT;
    p.count = points->count;
    p.at = points->at;
    p.radius = points->radius;
    p.mass = points->mass;
    p.voxel = content == VOXEL ? 0.3 : 0.025;
    struct grid *g = brume_particles_grid(&p, truth_error());
    points_free(points);
    return g;
}

/* The grid, moved so that its cube is before the camera. */
static struct grid *load(enum kind kind, enum content content, float value)
{
    struct grid *(*const loaders[])(enum content, float) = {df3, vdb, nvdb,
                                                            particles};
    struct grid *g = loaders[kind](content, value);
    if (!g)
        fail_msg("%s: %s", kind_name[kind], truth_error()->text);
    if (kind == DF3)
        g->to_world[0][3] = g->to_world[1][3] = -0.5;
    for (int i = 0; i < 3 && (kind == VDB || kind == NVDB); i++) {
        g->to_world[i][i] = 0.2;
        g->to_world[i][3] = 0.2 * ((i < 2 ? -3.5 : -1.5) - g->origin[i]);
    }
    return g;
}

/* ---- pictures ---------------------------------------------------------- */

/* The picture of a box from 0 to 1 along z, under a sky of 1. */
static struct estimate picture(const struct grid *g, double sigma_a,
                               double sigma_s, bool furnace, int spp)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    globals.media_multiple = globals.surfaces_indirect = furnace;
    globals.environment = furnace;
    for (int i = 0; i < 3; i++)
        globals.background[i] = 1;
    brume_scene *s = truth_scene(&globals, 1.0, furnace ? 0.4 : 1e-9);
    struct brume_medium m = truth_medium(sigma_a, sigma_s, 0.0);
    struct brume_field f = BRUME_FIELD_INIT;
    f.kind = BRUME_FIELD_GRID;
    f.grid = brume_add_grid(s, g, truth_error());
    m.density[0] = brume_add_field(s, &f, truth_error());
    m.densities = 1;
    truth_fill(s, truth_box(0.5, 0.0, 1.0), &m);
    struct estimate e = truth_render(s, furnace ? 8 : 2, spp);
    assert_int_equal(e.stats.rejected, 0);
    assert_int_equal(e.stats.majorant_exceeded, 0);
    return e;
}

static void check_opacity(enum kind kind, float value)
{
    struct grid *g = load(kind, VALUE, value);
    double most = kind == PARTICLES ? 0.01 : kind == DF3 ? 1e-4 : 1e-5;
    double got =
        picture(g, 1.0, 0.0, false, kind == PARTICLES ? 256 : 2).opacity;
    double truth = -expm1(-(double)value);
    if (!(fabs(got - truth) <= most * truth))
        fail_msg("%s of %g: %.9g, truth %.9g", kind_name[kind], (double)value,
                 got, truth);
    grid_free(g);
}

static void check_white(enum kind kind, const struct grid *g)
{
    struct estimate e = picture(g, 0.0, 4.0, true, 64);
    if (!(fabs(e.mean[0] - 1.0) < 1e-4 + 4.0 * e.error[0]) ||
        !(e.error[0] < 0.06))
        fail_msg("%s, white furnace: %.9g +- %.2g", kind_name[kind], e.mean[0],
                 e.error[0]);
}

/* From next to nothing to all the opacity keeps its digits. */
static void extremes_files__densities(void **state)
{
    (void)state;
    static const float values[] = {1e-30f, 1e-20f, 1e-10f, 1e-5f,
                                   1.0f,   1e6f,   1e12f};
    for (enum kind kind = VDB; kind < KINDS; kind++)
        for (int i = 0; i < 7; i++)
            check_opacity(kind, values[i]);
    check_opacity(DF3, 0x1p-32f * 16);
    check_opacity(DF3, 0.25f);
    check_opacity(DF3, 1);
}

static void extremes_files__empty(void **state)
{
    (void)state;
    for (enum kind kind = DF3; kind < KINDS; kind++) {
        struct grid *g = load(kind, EMPTY, 1);
        assert_true(g->lowest == 0 && g->highest == 0);
        assert_true(picture(g, 1.0, 0.0, false, 2).opacity == 0);
        check_white(kind, g);
        grid_free(g);
    }
}

static void extremes_files__one_voxel(void **state)
{
    (void)state;
    for (enum kind kind = DF3; kind < KINDS; kind++) {
        struct grid *g = load(kind, VOXEL, 1);
        assert_true(g->highest > 0 && isfinite(g->highest));
        /* That of a df3 fills the cube, as its outer samples are repeated. */
        double depth = -log1p(-picture(g, 1.0, 0.0, false, 2).opacity);
        assert_true(kind != DF3 || fabs(depth - 1) < 1e-5);
        check_white(kind, g);
        g->filter = GRID_NEAREST;
        check_white(kind, g);
        grid_free(g);
    }
}

/* What is no density is none and is counted; the rest stays. */
static void extremes_files__faulty(void **state)
{
    (void)state;
    static const size_t bad[KINDS][3] = {[VDB] = {103, 205, 102},
                                         [NVDB] = {618, 1230, 612},
                                         [PARTICLES] = {2, 2, 2}};
    for (enum kind kind = VDB; kind < KINDS; kind++) {
        struct grid *g = load(kind, FAULTY, 1);
        assert_int_equal(g->bad_nan, bad[kind][0]);
        assert_int_equal(g->bad_inf, bad[kind][1]);
        assert_int_equal(g->bad_negative, bad[kind][2]);
        assert_true(g->lowest >= 0 && isfinite(g->highest));
        assert_true(g->highest > 0);
        check_white(kind, g);
        grid_free(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extremes_files__densities),
        cmocka_unit_test(extremes_files__empty),
        cmocka_unit_test(extremes_files__one_voxel),
        cmocka_unit_test(extremes_files__faulty),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
