/* test_build_media.c - media of scenes as text, and the files they name. */
#include <stdlib.h>
#include <unistd.h>
#include "lib/vdb.h"
#include "tests/unit/scene_text.h"

/* ---- media ------------------------------------------------------------- */

#define GLASS "hollow pigment { rgbt 1 } "

static const struct brume_medium *medium_of(const char *items)
{
    char text[1000];

    snprintf(text, sizeof text,
             "sphere { 0, 1 " GLASS "interior { media { %s } } }", items);
    const brume_scene *s = scene(text);
    assert_int_equal(s->shape[0].material, -1);
    assert_int_equal(s->shape[0].interior, 0);
    assert_int_equal(s->interior[0].media[0], 0);
    return &s->medium[0];
}

static void media(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of("");
    NUMBERS(m->absorption, 0, 0, 0);
    NUMBERS(&m->eccentricity, 0, 1);
    m = medium_of("absorption 1 emission rgb <1, 2, 3> "
                  "scattering { 5, rgb <4, 5, 6> eccentricity .3 "
                  "extinction .5 } density { rgb <1, .5, 0> } "
                  "density { 2 }");
    NUMBERS(m->absorption, 2, 1, 0);
    NUMBERS(m->emission, 2, 2, 0);
    NUMBERS(m->scattering, 8, 5, 0);
    assert_int_equal(m->phase, BRUME_PHASE_HENYEY_GREENSTEIN);
    NUMBERS(&m->eccentricity, 0.3, 0.5);
    assert_int_equal(m->densities, 0);
    assert_false(m->fire.on);
    medium_of("intervals 1 samples 3, 10 confidence .9 variance 1/128 "
              "ratio .9 method 3 aa_threshold .1 aa_level 4 jitter .5 "
              "emission 1");
    assert_int_equal(diag.warnings, 1);
}

static void media_that_are_wrong(void **state)
{
    (void)state;
    expect_error("media { absorption rgb <1, -1, 0> }", BRUME_ERR_SCENE, 1, 20,
                 "'absorption' is -1, must be at least 0");
    expect_error("media { scattering { 6, 1 } }", BRUME_ERR_SCENE, 1, 22,
                 "'type' is 6");
    expect_error("media { scattering { 1 } }", BRUME_ERR_SCENE, 1, 24,
                 "needs its color");
    expect_error("media { scattering { 5, 1 eccentricity 1 } }",
                 BRUME_ERR_SCENE, 1, 40, "'eccentricity' is 1");
    expect_error("media { fire { intensity 1 } }", BRUME_ERR_SCENE, 1, 28,
                 "needs its 'temperature'");
    expect_error("media { fire { temperature { 1 } reference 400 } }",
                 BRUME_ERR_SCENE, 1, 44, "'reference' is 400");
    expect_error("media { fire { temperature { 1 } brightness loud } }",
                 BRUME_ERR_SCENE, 1, 45, "");
    expect_error("media { fire { temperature { 1 } brightness single } }",
                 BRUME_ERR_SCENE, 1, 45,
                 "'brightness' must be physical, "
                 "normalized, constant or total, not 'single'");
}

static void interiors(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare M = media { absorption 1 }\n"
        "#declare I = interior { media { M } media { M emission 2 } }\n"
        "#declare G = material { texture { pigment { rgbt 1 } }\n"
        "  interior { I } }\n"
        "sphere { 0, 1 material { G } hollow }\n"
        "box { 0, 1 pigment { rgbf 1 } interior { I media { M } } hollow }\n"
        "box { 0, 1 pigment { rgbf 1 } interior { I } }\n");
    assert_int_equal(s->interior[0].count, 2);
    assert_int_equal(s->interior[1].count, 3);
    assert_int_equal(s->mediums, 2);
    assert_int_equal(s->shape[0].material, -1);
    assert_int_equal(s->shape[1].interior, 1);
    assert_int_equal(s->shape[2].interior, -1);
    check_item(first_of(DIAG_WARNING), 7, 1, "not 'hollow'", "");
}

static void atmospheres(void **state)
{
    (void)state;
    const brume_scene *s = scene("");
    assert_int_equal(s->atmosphere, -1);
    s = scene("media { scattering { 4, .1 } }\n"
              "#declare M = media { absorption 1 }\n"
              "media { M }\n");
    assert_int_equal(s->atmosphere, 0);
    assert_int_equal(s->interior[0].count, 2);
    assert_int_equal(s->medium[0].phase, BRUME_PHASE_RAYLEIGH);
}

static void fires(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "absorption 1 fire { temperature { 1.5 } amount { .5 } "
        "kelvin 1200, 300 intensity 2 reference 1800 brightness constant "
        "coupling additive }");
    assert_true(m->fire.on && m->fire.additive);
    NUMBERS(&m->fire.kelvin_scale, 1200, 300, 2, 1800);
    assert_int_equal(m->fire.brightness, BRUME_BRIGHTNESS_CONSTANT);
    assert_int_equal(result.scene->field[m->fire.temperature].kind,
                     BRUME_FIELD_CONSTANT);
    NUMBERS(&result.scene->field[m->fire.temperature].scale, 1.5);
    NUMBERS(&result.scene->field[m->fire.amount].scale, 0.5);
    m = medium_of("fire { temperature { 1 } }");
    NUMBERS(&m->fire.kelvin_scale, 1000, 0, 1, 2000);
    assert_int_equal(m->fire.brightness, BRUME_BRIGHTNESS_PHYSICAL);
    assert_true(!m->fire.additive && m->fire.amount == -1);
    m = medium_of("fire { temperature { 1 } coupling absorption "
                  "preset cycles }");
    NUMBERS(&m->fire.kelvin_scale, 1000, 0, 1, 2728.2525);
    assert_int_equal(m->fire.brightness, BRUME_BRIGHTNESS_TOTAL);
    assert_true(m->fire.additive);
    m = medium_of("fire { temperature { 1 } preset pbrt kelvin 2 }");
    NUMBERS(&m->fire.kelvin_scale, 2, 0);
    assert_int_equal(m->fire.brightness, BRUME_BRIGHTNESS_NORMALIZED);
    m = medium_of("fire { temperature { 1 } preset houdini "
                  "brightness physical }");
    NUMBERS(&m->fire.kelvin_scale, 5000, 0);
    assert_int_equal(m->fire.brightness, BRUME_BRIGHTNESS_PHYSICAL);
}

/* ---- files ------------------------------------------------------------- */

static char folder[] = "/tmp/brume-build-XXXXXX";

static const char *in_folder(const char *name)
{
    static char path[4][256];
    static int next;
    char *to = path[next++ % 4];

    snprintf(to, sizeof path[0], "%s/%s", folder, name);
    return to;
}

static void write_file(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(in_folder(name), "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Voxels of 1, with the bad ones that readers count. */
static struct grid *small_grid(const char *name, bool bad)
{
    const int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    struct grid *grid = grid_new(origin, bricks, 0, NULL);

    assert_non_null(grid);
    snprintf(grid->name, sizeof grid->name, "%s", name);
    float *voxel = grid_brick(grid, 0, 0, 0, NULL);
    assert_non_null(voxel);
    for (int i = 0; i < 4; i++)
        voxel[2 + i] = 1; /* x from 2 to 5, y and z 0        */
    if (bad) {
        voxel[3] = NAN;
        voxel[4] = -1;
    }
    for (int i = 0; i < 3; i++)
        grid->to_world[i][i] = 0.5;
    return grid;
}

/* A file of tests/data, which is where this program starts. */
static void copy_file(const char *name)
{
    char from[64];
    unsigned char bytes[8192];
    snprintf(from, sizeof from, "tests/data/%s", name);
    FILE *f = fopen(from, "rb");
    assert_non_null(f);
    size_t size = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    write_file(name, bytes, size);
}

static int make_files(void **state)
{
    struct grid *good[3] = {small_grid("density", false),
                            small_grid("temperature", false),
                            small_grid("flame", false)};
    struct grid *bad = small_grid("density", true);
    static const unsigned char df3[] = {0, 2, 0, 1, 0, 1, 0, 255};
    static const char ply[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const char none[] =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nproperty float mass\n"
        "end_header\n0 0 0 0\n";
    static const char obj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;

    assert_non_null(mkdtemp(folder));
    write_file("none.ply", none, sizeof none - 1);
    copy_file("tiles.nvdb");
    copy_file("dust.ply");
    assert_true(vdb_save(in_folder("fire.vdb"),
                         (const struct grid *const *)good, 3, 0, NULL));
    assert_true(vdb_save(in_folder("bad.vdb"), (const struct grid *const *)&bad,
                         1, 0, NULL));
    for (int i = 0; i < 3; i++)
        grid_free(good[i]);
    grid_free(bad);
    write_file("two.df3", df3, sizeof df3);
    write_file("cut.df3", df3, sizeof df3 - 1);
    write_file("one.ply", ply, sizeof ply - 1);
    write_file("one.obj", obj, sizeof obj - 1);
    return chdir(folder);
}

static int remove_files(void **state)
{
    static const char *const names[] = {"fire.vdb",   "bad.vdb",  "two.df3",
                                        "cut.df3",    "one.ply",  "one.obj",
                                        "tiles.nvdb", "dust.ply", "none.ply"};

    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        unlink(in_folder(names[i]));
    forget_scene(state);
    return chdir("/") + rmdir(folder);
}

static void df3_files(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "density { density_file df3 \"two.df3\" translate x } scale 2");
    assert_int_equal(m->densities, 1);
    const struct brume_field *f = &result.scene->field[m->density[0]];
    assert_int_equal(f->kind, BRUME_FIELD_GRID);
    NUMBERS(f->transform[0], 2, 0, 0, 2);
    NUMBERS(&f->scale, 1);
    assert_int_equal(result.scene->grid[0].filter, GRID_NEAREST);
    medium_of("density { density_file df3 \"two.df3\" interpolate 1 }");
    assert_int_equal(result.scene->grid[0].filter, GRID_TRILINEAR);
}

static void all_transforms_reach_a_density(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare D = density { density_file df3 \"two.df3\" translate x }\n"
        "sphere { 0, 1 " GLASS "\n"
        "  interior { media { density { D scale 2 } translate y\n"
        "    density { D } } }\n"
        "  scale 3 }\n"
        "union { sphere { 0, 1 } sphere { 0, 1 scale 9 } " GLASS "\n"
        "  scale 7 interior { media { density { D } } } translate z }\n");
    NUMBERS(s->field[0].transform[0], 6, 0, 0, 6);
    NUMBERS(s->field[0].transform[1], 0, 6, 0, 3);
    NUMBERS(s->field[1].transform[0], 3, 0, 0, 3);
    NUMBERS(s->field[1].transform[1], 0, 3, 0, 0);
    NUMBERS(s->field[2].transform[0], 1, 0, 0, 1);
    NUMBERS(s->field[2].transform[2], 0, 0, 1, 1);
    assert_int_equal(s->grids, 1);
    assert_int_equal(s->mediums, 2);
    assert_int_equal(s->interiors, 2);
    assert_int_equal(s->shape[2].interior, 1);
}

static void vdb_files(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "density { density_file vdb \"fire.vdb\" }\n"
        "density { density_file vdb \"fire.vdb\" \"density\" }\n"
        "fire { temperature { density_file vdb \"fire.vdb\" }\n"
        "  amount { density_file vdb \"fire.vdb\" } translate x }");
    const brume_scene *s = result.scene;
    assert_int_equal(s->grids, 3);
    assert_int_equal(m->densities, 2);
    assert_int_equal(m->density[0], m->density[1]);
    assert_string_equal(s->grid[s->field[m->density[0]].grid].name, "density");
    assert_string_equal(s->grid[s->field[m->fire.temperature].grid].name,
                        "temperature");
    assert_string_equal(s->grid[s->field[m->fire.amount].grid].name, "flame");
    assert_int_equal(s->grid[0].filter, GRID_TRILINEAR);
    NUMBERS(s->field[m->fire.amount].transform[0], 1, 0, 0, 1);
}

/* Voxels 2 to 5 along x of width 1/2, so 1.5 to 5.5 in index space. */
static void vdb_boxes(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "density { density_file vdb \"fire.vdb\" fit }");
    const struct brume_field *f = &result.scene->field[m->density[0]];
    NUMBERS(f->transform[0], 0.5, 0, 0, -0.375);
    NUMBERS(f->transform[1], 0, 2, 0, 0.5);
    m = medium_of("density { density_file vdb \"fire.vdb\" fit up z "
                  "translate <10, 20, 30> }");
    f = &result.scene->field[m->density[0]];
    NUMBERS(f->transform[0], 0.5, 0, 0, 9.625);
    NUMBERS(f->transform[1], 0, 0, 2, 20.5);
    NUMBERS(f->transform[2], 0, 2, 0, 30.5);
    m = medium_of("density { density_file vdb \"fire.vdb\" up z }");
    f = &result.scene->field[m->density[0]];
    NUMBERS(f->transform[1], 0, 0, 1, 0);
    NUMBERS(f->transform[2], 0, 1, 0, 0);
}

static void nvdb_files(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "density { density_file nvdb \"tiles.nvdb\" }\n"
        "density { density_file nvdb \"tiles.nvdb\" \"shared\" fit\n"
        "  interpolate 0 }");
    const brume_scene *s = result.scene;
    assert_int_equal(s->grids, 2);
    assert_string_equal(s->grid[0].name, "density");
    assert_int_equal(s->grid[0].filter, GRID_TRILINEAR);
    assert_string_equal(s->grid[1].name, "shared");
    assert_int_equal(s->grid[1].filter, GRID_NEAREST);
    /* 136 voxels of 1/2 along x, to the unit cube. */
    NUMBERS(s->field[m->density[1]].transform[0], 2.0 / 136, 0, 0, 0.5 / 136);
    expect_error("media { density { density_file nvdb \"fire.vdb\" } }",
                 BRUME_ERR_FILE, 1, 37, "not a NanoVDB file");
    expect_error("media { density { density_file nvdb \"tiles.nvdb\" \"no\" "
                 "} }",
                 BRUME_ERR_FILE, 1, 37, "no grid named 'no'");
}

/* dust.ply: masses 2, 2 and 4 that count. */
static void particle_files(void **state)
{
    (void)state;
    const struct brume_medium *m = medium_of(
        "density { density_file particles \"dust.ply\" voxel 0.25 }\n"
        "density { density_file particles \"dust.ply\" voxel 0.25 fit up z }\n"
        "density { density_file particles \"dust.ply\" \"mass\" }\n"
        "fire { temperature { density_file particles \"dust.ply\" } }");
    const brume_scene *s = result.scene;
    assert_int_equal(s->grids, 3);
    assert_int_equal(m->density[1], m->density[0] + 1);
    const struct fake_grid *g = s->grid;
    assert_string_equal(g[0].name, "density");
    assert_string_equal(g[1].name, "mass");
    assert_string_equal(g[2].name, "temperature");
    expect_warning("media { density { density_file particles \"dust.ply\" } }",
                   1, 42,
                   "1 NaN, 0 infinite and 1 negative particles are left "
                   "out");
    expect_warning("media { density { density_file particles \"none.ply\" } }",
                   1, 42, "no particles with a mass");
    expect_error("media { density { density_file particles \"one.ply\" \"q\" "
                 "} }",
                 BRUME_ERR_FILE, 1, 42, "no property 'q'");
    expect_error("media { fire { temperature { density_file particles "
                 "\"one.ply\" } } }",
                 BRUME_ERR_FILE, 1, 53, "no property 'temperature'");
}

static void files_that_are_wrong(void **state)
{
    (void)state;
    expect_error("media { density {\n  density_file vdb \"none.vdb\" } }",
                 BRUME_ERR_FILE, 2, 20, "none.vdb");
    expect_error("media { density { density_file df3 \"cut.df3\" } }",
                 BRUME_ERR_FILE, 1, 36, "");
    expect_error("media { density { density_file vdb \"fire.vdb\" \"no\" } }",
                 BRUME_ERR_FILE, 1, 36, "no");
    expect_error("media { density { density_file vdb \"one.ply\" } }",
                 BRUME_ERR_FILE, 1, 36, "");
    expect_error("media { density { density_file df3 \"two.df3\" "
                 "interpolate 2 } }",
                 BRUME_ERR_SCENE, 1, 36, "not supported yet");
    expect_error("media { density { density_file vdb \"fire.vdb\" up x } }",
                 BRUME_ERR_SCENE, 1, 50, "y or z");
    expect_error("mesh { ply \"none.ply\" }", BRUME_ERR_FILE, 1, 12,
                 "none.ply");
    expect_warning("media { density { density_file vdb \"bad.vdb\" } }", 1, 36,
                   "1 NaN, 0 infinite and 1 negative");
}

static void mesh_files(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "mesh { ply \"one.ply\" pigment { rgb 1 } }\n"
        "mesh { ply \"one.ply\" scale 2 } mesh { obj \"one.obj\" }\n");
    assert_int_equal(s->meshes, 2);
    assert_int_equal(s->mesh[0].triangles, 1);
    assert_int_equal(s->shape[1].mesh, 0);
    assert_int_equal(s->shape[2].mesh, 1);
    expect_error("mesh { triangle { 0, x, y } ply \"one.ply\" }",
                 BRUME_ERR_SCENE, 1, 33, "not both");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(media),
        cmocka_unit_test(media_that_are_wrong),
        cmocka_unit_test(interiors),
        cmocka_unit_test(atmospheres),
        cmocka_unit_test(fires),
        cmocka_unit_test(df3_files),
        cmocka_unit_test(all_transforms_reach_a_density),
        cmocka_unit_test(vdb_files),
        cmocka_unit_test(nvdb_files),
        cmocka_unit_test(particle_files),
        cmocka_unit_test(vdb_boxes),
        cmocka_unit_test(files_that_are_wrong),
        cmocka_unit_test(mesh_files),
    };

    return cmocka_run_group_tests_name("build_media", tests, make_files,
                                       remove_files);
}
