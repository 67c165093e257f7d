/* The path integrator on three scenes of media: what its noise costs.
 *
 *     media SCENE FRAMES SPP [FOLDER]
 *
 * prints relMSE, CPU seconds and their product, the work-normalised variance,
 * from so many independent frames, and the picture's mean; with a folder it
 * leaves the density grid there, as peers.py wants it (raw floats, x runs
 * fastest), and the mean picture. SCENE is cloud, smoke or fog. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "core/brume.h"
#include "tests/bench/media_density.h"

enum { WIDTH = 96 };

static struct brume_error err;

static int checked(int id)
{
    if (id < 0 || err.code != BRUME_OK) {
        fprintf(stderr, "%s\n", err.text);
        exit(1);
    }
    return id;
}

/* ---- densities: the same numbers for both programs ---------------- */

/* Voxels over the cube from -1 to 1, centres half a voxel in. */
static int add_density(brume_scene *s, const float *d)
{
    const int32_t origin[3] = {0, 0, 0},
                  size[3] = {SIDE / 8, SIDE / 8, SIDE / 8};
    struct grid *g = grid_new(origin, size, 0.0f, &err);
    for (int i = 0; g && i < SIDE * SIDE * SIDE; i++) {
        int x = i % SIDE, y = i / SIDE % SIDE, z = i / SIDE / SIDE;
        float *v = grid_brick(g, x >> 3, y >> 3, z >> 3, &err);
        if (v)
            v[((z & 7) * 8 + (y & 7)) * 8 + (x & 7)] = d[i];
    }
    checked(g ? 0 : -1);
    for (int i = 0; i < 3; i++) {
        g->to_world[i][i] = 2.0 / SIDE;
        g->to_world[i][3] = -1.0 + 1.0 / SIDE;
    }
    grid_finish(g);
    struct brume_field f = BRUME_FIELD_INIT;
    f.kind = BRUME_FIELD_GRID;
    f.grid = checked(brume_add_grid(s, g, &err));
    grid_free(g);
    return checked(brume_add_field(s, &f, &err));
}

/* ---- scenes ---------------- */

static void fill(double v[3], double x, double y, double z)
{
    v[0] = x;
    v[1] = y;
    v[2] = z;
}

static void set_view(brume_scene *s, double z, double tangent)
{
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.location[2] = z;
    c.right[0] = c.up[1] = 2.0 * tangent;
    checked(brume_set_camera(s, &c, &err) - 1);
}

static void set_transport(brume_scene *s, double sky)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    g.physical_units = true;
    fill(g.background, sky, sky, sky);
    checked(brume_set_globals(s, &g, &err) - 1);
}

static void add_box(brume_scene *s, struct brume_medium *m, double half)
{
    struct brume_shape box = BRUME_SHAPE_INIT;
    int medium = checked(brume_add_medium(s, m, &err));
    box.kind = BRUME_SHAPE_BOX;
    fill(box.a, -half, -half, -half);
    fill(box.b, half, half, half);
    box.hollow = true;
    box.interior = checked(brume_add_interior(s, &medium, 1, &err));
    checked(brume_add_shape(s, &box, &err));
}

static struct brume_medium medium_of(double sigma_t, double albedo, double g)
{
    struct brume_medium m = BRUME_MEDIUM_INIT;
    double a = sigma_t * (1.0 - albedo), b = sigma_t * albedo;
    fill(m.absorption, a, a, a);
    fill(m.scattering, b, b, b);
    m.phase = BRUME_PHASE_HENYEY_GREENSTEIN;
    m.eccentricity = g;
    return m;
}

static void add_lamp(brume_scene *s, double x, double y, double z,
                     double intensity)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    double c = intensity / 3.14159265358979323846;
    fill(l.location, x, y, z);
    fill(l.color, c, c, c);
    checked(brume_add_light(s, &l, &err));
}

/* Optical width about 50, sun of irradiance 3 and an even sky of 0.3. */
static void make_cloud(brume_scene *s, const float *density)
{
    struct brume_light sun = BRUME_LIGHT_INIT;
    struct brume_medium m = medium_of(60.0, 0.99, 0.6);
    double c = 3.0 / 3.14159265358979323846;
    set_transport(s, 0.3);
    set_view(s, -4.5, 0.3);
    m.density[0] = add_density(s, density);
    m.densities = 1;
    add_box(s, &m, 1.0);
    sun.parallel = true;
    fill(sun.location, -2000.0, 2000.0, -1000.0);
    fill(sun.point_at, 0.0, 0.0, 0.0);
    fill(sun.color, c, c, c);
    checked(brume_add_light(s, &sun, &err));
}

static void add_triangles(brume_scene *s, const double p[][3], int points,
                          const uint32_t corner[][3], int triangles, int matte)
{
    struct mesh *m = mesh_new(&err);
    struct brume_shape shape = BRUME_SHAPE_INIT;
    for (int i = 0; m && i < points; i++)
        mesh_add_vertex(m, p[i], &err);
    for (int i = 0; m && i < triangles; i++)
        mesh_add_triangle(m, corner[i], NULL, NULL, &err);
    checked(m ? 0 : -1);
    shape.kind = BRUME_SHAPE_MESH;
    shape.mesh = checked(brume_add_mesh(s, m, &err));
    shape.material = matte;
    mesh_free(m);
    checked(brume_add_shape(s, &shape, &err));
}

/* A room open toward the eye, an octahedron in it, and smoke. */
static void make_smoke(brume_scene *s, const float *density)
{
    const double room[8][3] = {{-2, -2, -2}, {2, -2, -2}, {2, 2, -2},
                               {-2, 2, -2},  {-2, -2, 2}, {2, -2, 2},
                               {2, 2, 2},    {-2, 2, 2}};
    const uint32_t walls[10][3] = {{4, 5, 6}, {4, 6, 7}, {0, 4, 7}, {0, 7, 3},
                                   {1, 2, 6}, {1, 6, 5}, {0, 1, 5}, {0, 5, 4},
                                   {3, 7, 6}, {3, 6, 2}};
    const double body[6][3] = {{0.8, -1.2, 0.6}, {1.6, -1.2, 0.6},
                               {1.2, -1.6, 0.6}, {1.2, -0.8, 0.6},
                               {1.2, -1.2, 0.2}, {1.2, -1.2, 1.0}};
    const uint32_t faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    struct brume_material matte = BRUME_MATERIAL_INIT;
    struct brume_medium m = medium_of(2.0, 0.8, 0.3);
    fill(matte.color[0], 0.6, 0.6, 0.6);
    matte.diffuse = 1.0;
    set_transport(s, 0.0);
    set_view(s, -5.0, 0.4);
    int id = checked(brume_add_material(s, &matte, &err));
    add_triangles(s, room, 8, walls, 10, id);
    add_triangles(s, body, 6, faces, 8, id);
    m.density[0] = add_density(s, density);
    m.densities = 1;
    add_box(s, &m, 1.0);
    add_lamp(s, -1.2, 1.5, -1.0, 5.0);
}

/* Even fog around the eye, and a lamp in it. */
static void make_fog(brume_scene *s)
{
    struct brume_medium m = medium_of(0.2, 0.9, 0.5);
    set_transport(s, 0.0);
    set_view(s, -4.0, 0.5);
    add_box(s, &m, 5.0);
    add_lamp(s, 0.6, 0.4, 0.0, 5.0);
}

static brume_scene *make_scene(const char *name, const float *density)
{
    brume_scene *s = brume_scene_new(&err);
    checked(s ? 0 : -1);
    if (strcmp(name, "cloud") == 0)
        make_cloud(s, density);
    else if (strcmp(name, "smoke") == 0)
        make_smoke(s, density);
    else
        make_fog(s);
    return s;
}

/* ---- the measure ---------------- */

/* Mean over pixels of the frames' variance over mean^2 + eps^2. */
static double rel_mse(const double *sum, const double *squares, int n,
                      int frames)
{
    double all = 0.0, out = 0.0;
    for (int i = 0; i < n; i++)
        all += sum[i] / frames;
    double floor = 0.01 * (all / n) * (all / n);
    for (int i = 0; i < n; i++) {
        double m = sum[i] / frames;
        double v = (squares[i] / frames - m * m) * frames / (frames - 1);
        out += v / (m * m + floor);
    }
    return out / n;
}

static void write_floats(const char *folder, const char *name,
                         const float *data, size_t count)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    if (!f || fwrite(data, sizeof *data, count, f) != count)
        fprintf(stderr, "cannot write %s\n", path);
    if (f)
        fclose(f);
}

static double cpu_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

int main(int argc, char **argv)
{
    static double sum[3 * WIDTH * WIDTH], squares[3 * WIDTH * WIDTH];
    static float mean[3 * WIDTH * WIDTH];
    int n = 3 * WIDTH * WIDTH, frames = argc > 2 ? atoi(argv[2]) : 0;
    double rendered = 0.0, all = 0.0;
    if (frames < 2 || argc < 4)
        return 2;
    float *density = make_density(strcmp(argv[1], "cloud") == 0);
    brume_scene *s = make_scene(argv[1], density);
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.width = o.height = WIDTH;
    o.spp = atoi(argv[3]);
    for (int k = 0; k < frames; k++) {
        struct brume_frame f;
        o.frame = (uint32_t)k;
        double start = cpu_seconds();
        checked(brume_render(s, &o, &f, &err) - 1);
        rendered += cpu_seconds() - start;
        for (int i = 0; i < n; i++) {
            sum[i] += (double)f.radiance[i];
            squares[i] += (double)f.radiance[i] * (double)f.radiance[i];
        }
        brume_frame_free(&f);
    }
    for (int i = 0; i < n; i++) {
        mean[i] = (float)(sum[i] / frames);
        all += sum[i] / frames / n;
    }
    double mse = rel_mse(sum, squares, n, frames), cost = rendered / frames;
    printf("%s relMSE %.6g CPU %.4g s product %.6g mean %.6g\n", argv[1], mse,
           cost, mse * cost, all);
    if (argc > 4) {
        write_floats(argv[4], "density.f32", density,
                     (size_t)SIDE * SIDE * SIDE);
        write_floats(argv[4], "mean.f32", mean, (size_t)n);
    }
    brume_scene_free(s);
    free(density);
    return 0;
}
