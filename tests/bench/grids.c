/* The density grids and meshes of the bench's nine scenes, the same bits on
 * every machine.
 *
 *     grids FOLDER [NAME...]     writes .vdb and .ply files there
 *     grids - [NAME...]          only prints
 *
 * prints a row for each: voxels, their side, the share of them with more than
 * a thousandth of the peak, optical depth through the middle, the first and
 * last voxel of that line with as much, a checksum of all samples. */
#include "core/physics/fmath.h"
#include "lib/grid.h"
#include "lib/thread.h"
#include "lib/vdb.h"
#include "tests/bench/noise.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A grid: `fill` gives density and heat, both from 0 to 1, at a point in
 * units of the box's height from its middle; `time` is in frames. */
struct recipe {
    const char *name;
    int size[3];
    double height;  /* of the box, in scene units                      */
    double sigma_t; /* extinction at density 1, per unit               */
    double level;   /* where the optical depth is taken, of the height */
    int frames;     /* 0: a still                                      */
    bool hot;       /* has a temperature too                           */
    double lift;    /* how fast it rises, of the height in a frame     */
    void (*fill)(point p, double time, double out[2]);
};

static struct brume_error err;

static void require(bool good)
{
    if (good)
        return;
    fprintf(stderr, "grids: %s\n", err.text);
    exit(1);
}

/* ---- shapes ------------------------------------------------------------- */

static double clamp01(double x)
{
    return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x;
}

/* How deep a point is in an ellipsoid: 1 in its middle, 0 on it. */
static double depth_in(point p, point centre, point radius)
{
    double x = (p.x - centre.x) / radius.x, y = (p.y - centre.y) / radius.y;
    double z = (p.z - centre.z) / radius.z;
    return 1.0 - sqrt(x * x + y * y + z * z);
}

/* Billows: octaves of |noise|, 0 to about 1. */
static double billows(point p, int octaves, uint32_t seed)
{
    double sum = 0.0, amount = 0.5, size = 1.0;
    point slope;
    for (int i = 0; i < octaves; i++) {
        point q = point_mad(point_make(0, 0, 0), size, p);
        sum += amount * fabs(noise_at(q, seed + (uint32_t)i, &slope));
        size *= 2.03;
        amount *= 0.5;
    }
    return 2.0 * sum;
}

/* A cumulus: a cluster of ellipsoids on a flat base, eaten into by noise. */
static void fill_cloud(point p, double time, double out[2])
{
    static const double puff[][4] = {
        {0.00, -0.06, 0.00, 0.30},   {-0.22, -0.14, 0.04, 0.20},
        {0.22, -0.13, -0.05, 0.21},  {0.06, 0.14, 0.02, 0.21},
        {-0.10, 0.10, -0.10, 0.18},  {0.02, -0.12, 0.22, 0.19},
        {-0.04, -0.12, -0.22, 0.18}, {0.14, 0.06, 0.12, 0.17},
    };
    double s = -1.0;
    (void)time;
    for (size_t i = 0; i < sizeof puff / sizeof *puff; i++) {
        const double *c = puff[i];
        point r = {1.12 * c[3], 0.95 * c[3], 1.12 * c[3]};
        double d = depth_in(p, point_make(c[0], c[1], c[2]), r) * c[3] / 0.3;
        s = d > s ? d : s;
    }
    if (s < -0.2)
        return;
    point q = point_mad(point_make(3.1, 1.7, 4.2), 7.0, p);
    s += 0.28 - 0.55 * billows(q, 4, 11);
    s *= noise_step(-0.36, -0.28, p.y);
    out[0] = noise_step(0.0, 0.22, s);
}

/* Fog that thins with height as exp(-y / H), H a 21st of the box, in banks. */
static void fill_fog(point p, double time, double out[2])
{
    (void)time;
    double up = 21.0 * (p.y + 0.5);
    if (up > 9.0)
        return;
    double banks = 0.75 + 0.5 * noise_fractal(
                                    point_make(4.0 * p.x, 9.0 * p.y, 4.0 * p.z),
                                    3, 23);
    out[0] = clamp01(banks) * (double)fm_exp((float)-up);
}

/* One flame that stands at (x, z) on the floor of the box. */
struct flame {
    double x, z, radius, height;
};

/* How deep a point is in a flame, 1 on its axis, and how high in it. */
static double in_flame(point p, const struct flame *f, double *up)
{
    double y = (p.y + 0.49) / f->height;
    *up = y;
    if (y <= 0.0 || y >= 1.0)
        return -1.0;
    /* A drop: widest at a third of its height. */
    double wide = f->radius * sqrt(y) * (1.0 - y) * 2.598;
    double x = p.x - f->x, z = p.z - f->z;
    return 1.0 - sqrt(x * x + z * z) / (wide + 1e-6);
}

static void fill_flames(point p, double time, const struct flame *flame,
                        int count, double out[2])
{
    double reach = 0.10 * noise_step(-0.5, 0.3, p.y), best = -1.0, high = 0.0;
    point rising = point_make(p.x, p.y - 0.02 * time, p.z), up = {0, 0, 0};
    if (p.y > 0.495)
        return;
    point a = noise_curl(point_mad(up, 4.0, rising), 31);
    point q = point_mad(p, 0.5 * reach, a);
    a = noise_curl(point_mad(up, 9.0, rising), 37);
    q = point_mad(q, 0.18 * reach, a);
    for (int i = 0; i < count; i++) {
        double y, s = in_flame(q, &flame[i], &y);
        high = s > best ? y : high;
        best = s > best ? s : best;
    }
    if (best <= 0.0)
        return;
    double streaks = noise_fractal(
        point_make(14.0 * q.x, 5.0 * q.y - 0.2 * time, 14.0 * q.z), 3, 41);
    double edge = clamp01(best * (1.0 + 0.5 * streaks));
    out[0] = noise_step(0.0, 0.5, edge);
    out[1] = clamp01(noise_step(0.0, 0.8, edge) * (1.15 - 0.75 * high) +
                     0.12 * streaks);
}

static void fill_flame1(point p, double time, double out[2])
{
    static const struct flame one[] = {{0.0, 0.0, 0.39, 0.98}};
    fill_flames(p, time, one, 1, out);
}

static void fill_flame2(point p, double time, double out[2])
{
    static const struct flame row[] = {{-0.33, 0.03, 0.26, 0.80},
                                       {0.00, -0.04, 0.31, 0.97},
                                       {0.32, 0.05, 0.27, 0.72}};
    fill_flames(p, time + 40.0, row, 3, out);
}

static void fill_flame3(point p, double time, double out[2])
{
    static const struct flame small[] = {{0.0, 0.0, 0.40, 0.96}};
    fill_flames(p, time + 90.0, small, 1, out);
}

static void fill_campfire(point p, double time, double out[2])
{
    static const struct flame fires[] = {
        {0.00, 0.00, 0.26, 0.96},   {0.22, 0.10, 0.19, 0.70},
        {-0.21, 0.12, 0.19, 0.75},  {0.10, -0.24, 0.19, 0.66},
        {-0.14, -0.22, 0.20, 0.72},
    };
    fill_flames(p, time + 140.0, fires, 5, out);
}

/* A ball of billows; its heart shows between them. */
static void fill_explosion(point p, double time, double out[2])
{
    (void)time;
    double s = depth_in(p, point_make(0.0, 0.03, 0.0),
                        point_make(0.38, 0.46, 0.38));
    if (s < -0.2)
        return;
    point zero = {0, 0, 0};
    point q = point_mad(p, 0.03, noise_curl(point_mad(zero, 6.0, p), 53));
    double folds = billows(point_mad(zero, 5.0, q), 5, 59);
    double deep = s + 0.30 - 0.62 * folds;
    out[0] = noise_step(0.0, 0.35, deep) * clamp01(0.35 + 0.65 * folds);
    out[1] = deep > 0.0 ? clamp01(1.6 * deep - 1.1 * folds + 0.45) : 0.0;
}

/* Clouds about the line that the camera flies along, z. */
static void fill_flight(point p, double time, double out[2])
{
    enum { PUFFS = 48, ON_LINE = 4 };
    double s = -1.0;
    (void)time;
    for (int i = 0; i < PUFFS; i++) {
        /* The first few on the line, the others beside it. */
        bool on = i < ON_LINE;
        double along = on ? -1.24 + 2.48 * i / (ON_LINE - 1)
                          : 2.5 * noise_chance(i, 61) - 1.25;
        double side = 2.3 * noise_chance(i, 67) - 1.15;
        side += on ? -side : side < 0.0 ? -0.12 : 0.12;
        double up = (on ? 0.2 : 0.6) * (noise_chance(i, 71) - 0.5) - 0.04;
        point c = {side, up, along};
        double r = (on ? 0.11 : 0.16) + 0.12 * noise_chance(i, 73);
        double d = depth_in(p, c, point_make(1.2 * r, 0.9 * r, 1.2 * r));
        s = d > s ? d : s;
    }
    if (s < -0.3)
        return;
    point q = point_mad(point_make(5.1, 2.7, 1.2), 5.0, p);
    s += 0.20 - 0.5 * billows(q, 4, 79);
    s *= noise_step(0.5, 0.44, fabs(p.y));
    out[0] = noise_step(0.0, 0.35, s);
}

/* What the smoke's noise rises by in a frame. */
#define LIFT 0.018

/* A plume that widens as it rises and sways. */
static void fill_smoke(point p, double time, double out[2])
{
    double up = p.y + 0.5, lift = LIFT * time;
    double wide = 0.055 + 0.26 * up;
    if (p.x * p.x + p.z * p.z > 4.0 * wide * wide)
        return;
    point zero = {0, 0, 0}, rising = {p.x, p.y - lift, p.z};
    point sway = noise_curl(point_mad(zero, 3.0, rising), 83);
    point q = point_mad(p, 0.07 * up + 0.01, sway);
    sway = noise_curl(point_mad(zero, 8.0, rising), 89);
    q = point_mad(q, 0.025 * up + 0.004, sway);
    double r = sqrt(q.x * q.x + q.z * q.z) / wide;
    double folds = noise_fractal(
        point_make(9.0 * q.x, 9.0 * (q.y - lift), 9.0 * q.z), 3, 97);
    double s = (1.0 - r + 0.45 * folds) * noise_step(0.49, 0.2, p.y);
    out[0] = noise_step(0.0, 0.55, s) * noise_step(0.0, 0.03, up) *
             (1.0 - 0.55 * up);
}

static const struct recipe recipes[] = {
    {"t1-cloud", {128, 128, 128}, 1.15, 60, 0.5, 0, false, 0, fill_cloud},
    {"t1-fog", {128, 128, 128}, 2.0, 5, 1 / 21.0, 0, false, 0, fill_fog},
    {"t2-flame1", {300, 250, 200}, 0.72, 25, 0.5, 0, true, 0, fill_flame1},
    {"t2-flame2", {300, 250, 200}, 0.87, 25, 0.5, 0, true, 0, fill_flame2},
    {"t2-flame3", {60, 60, 60}, 0.64, 25, 0.5, 0, true, 0, fill_flame3},
    {"t2-campfire", {70, 70, 80}, 1.15, 25, 0.5, 0, true, 0, fill_campfire},
    {"t2-explosion", {80, 100, 80}, 0.5, 50, 0.5, 0, true, 0, fill_explosion},
    {"t3-flight", {256, 96, 256}, 1.0, 10, 0.5, 0, false, 0, fill_flight},
    {"t4-smoke", {96, 160, 96}, 2.0, 32, 0.5, 60, false, LIFT, fill_smoke},
    {"peer-cloud", {192, 128, 192}, 1.15, 60, 0.5, 0, false, 0, fill_cloud},
};
enum { RECIPES = sizeof recipes / sizeof *recipes };

/* ---- from a recipe to grids --------------------------------------------- */

/* Samples, x fastest: densities, then heats. */
struct samples {
    const struct recipe *recipe;
    double time;
    float *value[2];
};

static size_t samples_count(const struct recipe *r)
{
    return (size_t)r->size[0] * (size_t)r->size[1] * (size_t)r->size[2];
}

static void fill_slice(void *user, size_t z, int thread)
{
    const struct samples *s = user;
    const int *size = s->recipe->size;
    size_t at = z * (size_t)size[0] * (size_t)size[1];
    double side = 1.0 / size[1];
    (void)thread;
    for (int y = 0; y < size[1]; y++)
        for (int x = 0; x < size[0]; x++, at++) {
            double out[2] = {0.0, 0.0};
            s->recipe->fill(point_make((x + 0.5 - 0.5 * size[0]) * side,
                                       (y + 0.5 - 0.5 * size[1]) * side,
                                       ((int)z + 0.5 - 0.5 * size[2]) * side),
                            s->time, out);
            for (int i = 0; i < 2; i++)
                s->value[i][at] = (float)out[i];
        }
}

static struct grid *make_grid(const struct samples *s, int which,
                              const char *name)
{
    const int *size = s->recipe->size;
    const int32_t origin[3] = {0, 0, 0};
    int32_t bricks[3];
    for (int i = 0; i < 3; i++)
        bricks[i] = (size[i] + 7) / 8;
    struct grid *g = grid_new(origin, bricks, 0.0f, &err);
    require(g != NULL);
    const float *value = s->value[which];
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++, value++) {
                if (*value == 0.0f)
                    continue;
                float *brick = grid_brick(g, x / 8, y / 8, z / 8, &err);
                require(brick != NULL);
                brick[x % 8 + 8 * (y % 8) + 64 * (z % 8)] = *value;
            }
    snprintf(g->name, sizeof g->name, "%s", name);
    double side = s->recipe->height / size[1];
    for (int i = 0; i < 3; i++) {
        g->to_world[i][i] = side;
        g->to_world[i][3] = side * (0.5 - 0.5 * size[i]);
    }
    grid_finish(g);
    return g;
}

/* A component of what the recipe says of its velocity, in scene units a second
 * of 24 frames, on voxels of a quarter of the height and wider than the box. */
static struct grid *make_velocity(const struct recipe *r, int axis)
{
    const int32_t origin[3] = {-8, -8, -8}, bricks[3] = {2, 2, 2};
    struct grid *g = grid_new(origin, bricks, 0.0f, &err);
    require(g != NULL);
    double side = 0.25 * r->height;
    float value = axis == 1 ? (float)(24.0 * r->lift * r->height) : 0.0f;
    for (int i = 0; i < 8; i++)
        require(grid_set_tile(g, i & 1, i >> 1 & 1, i >> 2, value, &err));
    for (int i = 0; i < 3; i++)
        g->to_world[i][i] = side;
    snprintf(g->name, sizeof g->name, "velocity");
    g->any_sign = true;
    grid_finish(g);
    return g;
}

static void save(const struct samples *s, const char *path)
{
    struct grid *grid[5];
    const struct grid *all[5];
    size_t count = 0;
    grid[count++] = make_grid(s, 0, "density");
    if (s->recipe->hot)
        grid[count++] = make_grid(s, 1, "temperature");
    for (int i = 0; s->recipe->lift > 0.0 && i < 3; i++)
        grid[count++] = make_velocity(s->recipe, i);
    for (size_t i = 0; i < count; i++)
        all[i] = grid[i];
    require(vdb_save(path, all, count, VDB_SAVE_HALF | VDB_SAVE_ZIP, &err));
    for (size_t i = 0; i < count; i++)
        grid_free(grid[i]);
}

/* FNV-1a, 64 bits. */
static uint64_t checksum(uint64_t sum, const float *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &value[i], sizeof bits);
        for (int k = 0; k < 4; k++)
            sum = (sum ^ (bits >> 8 * k & 255u)) * 0x100000001b3u;
    }
    return sum;
}

static void print_row(const struct samples *s, const char *name)
{
    const struct recipe *r = s->recipe;
    const int *size = r->size;
    size_t count = samples_count(r), dense = 0;
    size_t slice = (size_t)size[0] * (size_t)size[1];
    size_t at = (size_t)size[0] * (size_t)(r->level * size[1]) +
                (size_t)size[0] / 2;
    float peak = 0.0f;
    double side = r->height / size[1], tau = 0.0;
    int first = -1, last = -1;
    for (size_t i = 0; i < count; i++)
        peak = s->value[0][i] > peak ? s->value[0][i] : peak;
    for (size_t i = 0; i < count; i++)
        dense += s->value[0][i] > 0.001f * peak;
    for (int z = 0; z < size[2]; z++, at += slice) {
        tau += r->sigma_t * side * (double)s->value[0][at];
        if (s->value[0][at] > 0.001f * peak) {
            first = first < 0 ? z : first;
            last = z;
        }
    }
    uint64_t sum = checksum(0xcbf29ce484222325u, s->value[0], count);
    if (r->hot)
        sum = checksum(sum, s->value[1], count);
    printf("%-12s %3dx%3dx%3d  side %.6f  peak %.4f  filled %5.2f %%  "
           "depth %6.2f  from %3d to %3d  %016" PRIx64 "\n",
           name, size[0], size[1], size[2], side, (double)peak,
           100.0 * (double)dense / (double)count, tau, first, last, sum);
    fflush(stdout);
}

static void make_frame(const struct recipe *r, int frame, const char *folder)
{
    struct samples s = {r, frame, {NULL, NULL}};
    char name[32], path[4096];
    for (int i = 0; i < 2; i++) {
        s.value[i] = malloc(samples_count(r) * sizeof(float));
        require(s.value[i] || brume_fail(&err, BRUME_ERR_MEMORY, "no memory"));
    }
    parallel_for(0, (size_t)r->size[2], fill_slice, &s, NULL);
    snprintf(name, sizeof name, r->frames ? "%s_%02d" : "%s", r->name, frame);
    print_row(&s, name);
    snprintf(path, sizeof path, "%s/%s.vdb", folder, name);
    if (strcmp(folder, "-") != 0)
        save(&s, path);
    free(s.value[0]);
    free(s.value[1]);
}

/* ---- meshes ------------------------------------------------------------- */

/* A torus knot: around the ring twice, through its hole three times. */
struct knot {
    const char *name;
    int along, around;       /* quadrangles                         */
    float ring, swing, tube; /* radii                               */
    float flat;              /* height of the swing over its width  */
    float lift;
};

static const struct knot knots[] = {
    {"t1-cloud-knot", 449, 4, 0.38f, 0.12f, 0.035f, 1.0f, 0.0f},
    {"t1-fog-knot", 223, 149, 0.52f, 0.20f, 0.07f, 0.5f, -0.86f},
};
enum { KNOTS = sizeof knots / sizeof *knots };

static point knot_point(const struct knot *k, float turn)
{
    float a = 6.2831853f * turn;
    float r = k->ring + k->swing * fm_cos(3.0f * a);
    return point_make((double)(r * fm_cos(2.0f * a)),
                      (double)(k->lift + k->flat * k->swing * fm_sin(3.0f * a)),
                      (double)(r * fm_sin(2.0f * a)));
}

static point unit(point p)
{
    double s = 1.0 / sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return point_make(s * p.x, s * p.y, s * p.z);
}

static point cross(point a, point b)
{
    return point_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                      a.x * b.y - a.y * b.x);
}

/* The knot never runs straight up, so its frame may be made of "up". */
static point tube_point(const struct knot *k, int i, int j)
{
    point p = knot_point(k, (float)i / (float)k->along);
    point ahead = knot_point(k, ((float)i + 0.25f) / (float)k->along);
    point along = unit(point_mad(ahead, -1.0, p));
    point side = unit(cross(along, point_make(0.0, 1.0, 0.0)));
    point up = cross(side, along);
    float a = 6.2831853f * ((float)j + 0.5f) / (float)k->around;
    p = point_mad(p, (double)(k->tube * fm_cos(a)), side);
    return point_mad(p, (double)(k->tube * fm_sin(a)), up);
}

static void write_knot(const struct knot *k, FILE *f)
{
    int n = k->along, m = k->around;
    fprintf(f,
            "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\n"
            "property float y\nproperty float z\nelement face %d\n"
            "property list uchar int vertex_indices\nend_header\n",
            n * m, 2 * n * m);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) {
            point p = tube_point(k, i, j);
            fprintf(f, "%.6f %.6f %.6f\n", p.x, p.y, p.z);
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) {
            int a = i * m + j, b = (i + 1) % n * m + j;
            int c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
            fprintf(f, "3 %d %d %d\n3 %d %d %d\n", a, b, c, a, c, d);
        }
}

static void make_knot(const struct knot *k, const char *folder)
{
    char path[4096];
    printf("%-13s %6d triangles\n", k->name, 2 * k->along * k->around);
    if (strcmp(folder, "-") == 0)
        return;
    snprintf(path, sizeof path, "%s/%s.ply", folder, k->name);
    FILE *f = fopen(path, "w");
    require(f || brume_fail(&err, BRUME_ERR_FILE, "can't write %s", path));
    write_knot(k, f);
    require(fclose(f) == 0 ||
            brume_fail(&err, BRUME_ERR_FILE, "can't write %s", path));
}

/* ---- the program -------------------------------------------------------- */

static bool wanted(const char *name, int count, char **word)
{
    for (int i = 2; i < count; i++)
        if (strcmp(word[i], name) == 0)
            return true;
    return count < 3;
}

int main(int count, char **word)
{
    if (count < 2) {
        fprintf(stderr, "usage: grids FOLDER|- [NAME...]\n");
        return 2;
    }
    for (int i = 0; i < RECIPES; i++)
        if (wanted(recipes[i].name, count, word))
            for (int f = 0; f < recipes[i].frames || f == 0; f++)
                make_frame(&recipes[i], f, word[1]);
    for (int i = 0; i < KNOTS; i++)
        if (wanted(knots[i].name, count, word))
            make_knot(&knots[i], word[1]);
    return 0;
}
