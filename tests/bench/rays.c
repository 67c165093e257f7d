/* Transmittance along rays by several estimators of the same integral.
 *
 *     rays                prints the table of media.md
 *
 * Shadow rays from places of the grids of media.c, drawn by density, to the
 * box. All walk over the same cells with bounds of what they hold and fetch
 * the same trilinear densities. The error is the mean of (estimate - T)^2
 * over that of T^2; T is summed up exactly between planes of voxels. Each
 * estimate's mean is held against T: by more than 5 standard errors it ends. */
#include <stdio.h>
#include <string.h>
#include <time.h>
#include "core/physics/fmath.h"
#include "core/physics/rng.h"
#include "core/physics/vec.h"
#include "tests/bench/media_density.h"

enum { RAYS = 256, MOST_CELLS = SIDE / 4 + 1, MOST_STEPS = 4 * MOST_CELLS };

struct cell {
    float least, mean, most;
};

static struct {
    const float *density;
    float sigma;     /* per voxel                                   */
    int side, cells; /* of a cell in voxels; along each axis        */
    struct cell cell[MOST_CELLS * MOST_CELLS * MOST_CELLS];
    long fetches;
} grid;

/* In voxels, whose centres have whole numbers: from -1/2 to SIDE - 1/2. */
struct ray {
    vec3 o, d;
    float end;
    double truth;
};

/* ---- the grid ------------------------------------------------------------ */

static float voxel(int x, int y, int z)
{
    bool in = x >= 0 && y >= 0 && z >= 0 && x < SIDE && y < SIDE && z < SIDE;
    return in ? grid.density[(z * SIDE + y) * SIDE + x] : 0.0f;
}

static float mix(float a, float b, float s)
{
    return a + s * (b - a);
}

/* Extinction per voxel. */
static float extinction(vec3 p)
{
    int x = hd_floor(p.x), y = hd_floor(p.y), z = hd_floor(p.z);
    float u = p.x - (float)x, v = p.y - (float)y, w = p.z - (float)z, c[4];
    for (int i = 0; i < 4; i++)
        c[i] = mix(voxel(x, y + (i & 1), z + (i >> 1)),
                   voxel(x + 1, y + (i & 1), z + (i >> 1)), u);
    grid.fetches++;
    return grid.sigma * mix(mix(c[0], c[1], v), mix(c[2], c[3], v), w);
}

static struct cell look_at_cell(int x, int y, int z)
{
    struct cell out = {INFINITY, 0.0f, 0.0f};
    int n = grid.side, count = 0;
    for (int k = -1; k <= n; k++)
        for (int j = -1; j <= n; j++)
            for (int i = -1; i <= n; i++, count++) {
                float v = voxel(x * n + i, y * n + j, z * n + k);
                out.least = fminf(out.least, v);
                out.most = fmaxf(out.most, v);
                out.mean += v;
            }
    out.mean *= grid.sigma / (float)count;
    out.least *= grid.sigma;
    out.most *= grid.sigma;
    return out;
}

static void make_cells(const float *density, float sigma, int side)
{
    grid.density = density;
    grid.sigma = sigma * 2.0f / SIDE;
    grid.side = side;
    grid.cells = SIDE / side;
    int n = grid.cells;
    for (int i = 0; i < n * n * n; i++)
        grid.cell[i] = look_at_cell(i % n, i / n % n, i / n / n);
}

/* ---- walks over cells ---------------------------------------------------- */

struct step {
    float from, to;
    const struct cell *cell;
};

static float next_plane(float o, float d, float t, float side)
{
    float at = (o + 0.5f + t * d) / side;
    float plane = d > 0.0f ? floorf(at) + 1.0f : ceilf(at) - 1.0f;
    return d == 0.0f ? INFINITY : (plane * side - 0.5f - o) / d;
}

/* The steps of a ray through cells that hold something. */
static int walk(const struct ray *r, struct step steps[MOST_STEPS])
{
    const float over = 1e-4f;
    int count = 0, n = grid.cells;
    float side = (float)grid.side;
    for (float t = 0.0f; t < r->end && count < MOST_STEPS;) {
        float to = fminf(fminf(next_plane(r->o.x, r->d.x, t + over, side),
                               next_plane(r->o.y, r->d.y, t + over, side)),
                         next_plane(r->o.z, r->d.z, t + over, side));
        to = fminf(fmaxf(to, t + over), r->end);
        vec3 p = vec3_mad(r->o, 0.5f * (t + to), r->d);
        int x = hd_floor((p.x + 0.5f) / side),
            y = hd_floor((p.y + 0.5f) / side);
        int z = hd_floor((p.z + 0.5f) / side);
        if (x >= 0 && y >= 0 && z >= 0 && x < n && y < n && z < n) {
            const struct cell *c = &grid.cell[(z * n + y) * n + x];
            if (c->most > 0.0f)
                steps[count++] = (struct step){t, to, c};
        }
        t = to;
    }
    return count;
}

/* ---- the estimators ------------------------------------------------------ */

typedef double estimator(const struct ray *r, rng *random);

/* exp(-controls) times the product of 1 - (mu - control) / majorant; ends at
 * random below a tenth, as track.h does. */
static double residual(const struct ray *r, rng *random, int kind)
{
    struct step steps[MOST_STEPS];
    int count = walk(r, steps);
    float tau = rng_optical_depth(random), known = 0.0f, product = 1.0f;
    for (int i = 0; i < count; i++) {
        const struct cell *c = steps[i].cell;
        float control = kind == 0 ? 0.0f : kind == 1 ? c->least : c->mean;
        float majorant = fmaxf(c->most - control, control - c->least);
        float t = steps[i].from;
        known += control * (steps[i].to - t);
        for (;;) {
            float left = majorant * (steps[i].to - t);
            if (!(tau < left)) {
                tau -= left;
                break;
            }
            t += tau / majorant;
            tau = rng_optical_depth(random);
            float mu = extinction(vec3_mad(r->o, t, r->d));
            product *= 1.0f - (mu - control) / majorant;
            if (!(product > 0.0f))
                return 0.0;
            if (product < 0.1f) {
                if (!rng_chance(random, 10.0f * product))
                    return 0.0;
                product = 0.1f;
            }
        }
    }
    return (double)(product * fm_exp(-known));
}

static double ratio(const struct ray *r, rng *random)
{
    return residual(r, random, 0);
}

static double residual_least(const struct ray *r, rng *random)
{
    return residual(r, random, 1);
}

static double residual_mean(const struct ray *r, rng *random)
{
    return residual(r, random, 2);
}

/* -tau by a comb of points with one offset over all that is not empty. */
static double comb(const struct ray *r, const struct step *steps, int count,
                   float length, int points, rng *random)
{
    float spacing = length / (float)points, sum = 0.0f;
    float next = rng_float(random) * spacing, before = 0.0f;
    for (int i = 0; i < count; i++) {
        float size = steps[i].to - steps[i].from;
        for (; next < before + size; next += spacing)
            sum += extinction(
                vec3_mad(r->o, steps[i].from + next - before, r->d));
        before += size;
    }
    return -(double)(sum * spacing);
}

enum { MOST_ORDER = 30 };

/* Mean over the pivots of exp(pivot) times the series in what the others
 * differ, its terms' chances made good [Kettunen et al. 2021]. */
static double series(const double *x, int order)
{
    double sum = 0.0;
    for (int pivot = 0; pivot <= order; pivot++) {
        double e[MOST_ORDER + 2] = {1.0}, in = 1.0, term = 1.0, reached = 1.0;
        int n = 0;
        for (int i = 0; i <= order; i++) {
            if (i == pivot)
                continue;
            for (int k = ++n; k > 0; k--)
                e[k] += e[k - 1] * (x[i] - x[pivot]);
        }
        for (int k = 1; k <= order; k++) {
            /* C(order, k) k! */
            term *= (double)(order - k + 1);
            reached *= k == 1 ? 0.1 : fmin(1.0, 2.0 / (double)k);
            in += e[k] / (term * reached);
        }
        sum += exp(x[pivot]) * in;
    }
    return sum / (double)(order + 1);
}

static double marching(const struct ray *r, rng *random)
{
    struct step steps[MOST_STEPS];
    double x[MOST_ORDER + 1];
    int count = walk(r, steps), order = 0;
    float bound = 0.0f, length = 0.0f;
    for (int i = 0; i < count; i++) {
        bound += steps[i].cell->most * (steps[i].to - steps[i].from);
        length += steps[i].to - steps[i].from;
    }
    if (count == 0)
        return 1.0;
    int points = (int)ceilf(
        cbrtf((0.015f + bound) * (0.65f + bound) * (60.3f + bound)));
    if (rng_chance(random, 0.1f))
        for (order = 1; order < MOST_ORDER &&
                        rng_chance(random, 2.0f / (float)(order + 1));)
            order++;
    for (int i = 0; i <= order; i++)
        x[i] = comb(r, steps, count, length, points, random);
    return series(x, order);
}

/* Between planes of voxels, where Gauss's rule of two points is exact. */
static double exact(const struct ray *r, rng *random)
{
    const float node = 0.211324865f, over = 1e-4f;
    struct step steps[MOST_STEPS];
    int count = walk(r, steps);
    double tau = 0.0;
    (void)random;
    for (int i = 0; i < count; i++)
        for (float t = steps[i].from; t < steps[i].to;) {
            vec3 o = vec3_sub(r->o, vec3_make(0.5f, 0.5f, 0.5f));
            float to = fminf(fminf(next_plane(o.x, r->d.x, t + over, 1.0f),
                                   next_plane(o.y, r->d.y, t + over, 1.0f)),
                             next_plane(o.z, r->d.z, t + over, 1.0f));
            to = fminf(fmaxf(to, t + over), steps[i].to);
            float shift = node * (to - t);
            tau += 0.5 * (double)(to - t) *
                   (double)(extinction(vec3_mad(r->o, t + shift, r->d)) +
                            extinction(vec3_mad(r->o, to - shift, r->d)));
            t = to;
        }
    return exp(-tau);
}

/* ---- the measure --------------------------------------------------------- */

/* Distance to the box. */
static float reach(vec3 o, vec3 d)
{
    float end = INFINITY, a[3] = {o.x, o.y, o.z}, b[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; i++) {
        float side = b[i] > 0.0f ? SIDE - 0.5f : -0.5f;
        if (b[i] != 0.0f)
            end = fminf(end, (side - a[i]) / b[i]);
    }
    return end;
}

static vec3 place(rng *random)
{
    vec3 p;
    do
        p = vec3_make(rng_float(random) * SIDE - 0.5f,
                      rng_float(random) * SIDE - 0.5f,
                      rng_float(random) * SIDE - 0.5f);
    while (!(extinction(p) > rng_float(random) * grid.sigma));
    return p;
}

static void make_rays(struct ray *rays)
{
    rng random = rng_make(1, 0, 0, 0);
    for (int i = 0; i < RAYS; i++) {
        struct ray *r = &rays[i];
        vec3 d;
        do
            d = vec3_make(rng_float(&random) - 0.5f, rng_float(&random) - 0.5f,
                          rng_float(&random) - 0.5f);
        while (!(vec3_length(d) > 0.01f && vec3_length(d) < 0.5f));
        r->o = place(&random);
        r->d = vec3_normalize(d);
        r->end = reach(r->o, r->d);
        r->truth = exact(r, NULL);
    }
}

static double cpu_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* A row; the product of error and time. */
static double measure(const char *what, const char *name, estimator *f,
                      const struct ray *rays, double ratios)
{
    double errors = 0.0, truths = 0.0, off = 0.0, start = cpu_seconds();
    long repeats = 0;
    grid.fetches = 0;
    for (; cpu_seconds() - start < 2.0; repeats++)
        for (int i = 0; i < RAYS; i++) {
            rng random = rng_make(2, 0, (uint32_t)i, (uint64_t)repeats);
            double e = f(&rays[i], &random) - rays[i].truth;
            errors += e * e;
            off += e;
            truths += rays[i].truth * rays[i].truth;
        }
    double n = (double)repeats * RAYS, us = 1e6 * (cpu_seconds() - start) / n;
    double error = errors / truths, product = error * us;
    if (fabs(off) > 5.0 * sqrt(errors) + 1e-6 * n) {
        fprintf(stderr, "%s, %s: off by %g\n", what, name, off / n);
        exit(1);
    }
    printf("| %s | %s | %.1f | %.2f | %.3g | %.3g | ", what, name,
           (double)grid.fetches / n, us, error, product);
    if (product > 0.0)
        printf("%.3g |\n", (ratios > 0.0 ? ratios : product) / product);
    else
        puts("- |");
    fflush(stdout);
    return product;
}

int main(void)
{
    static struct ray rays[RAYS];
    const struct {
        const char *what;
        bool cloud;
        float sigma;
        int side;
    } media[] = {{"cloud, width 50", true, 60.0f, 4},
                 {"cloud, width 5", true, 6.0f, 8},
                 {"cloud, width 0.5", true, 0.6f, 8},
                 {"smoke, as in the room", false, 2.0f, 8},
                 {"smoke, ten times as dense", false, 20.0f, 8}};
    printf("| rays through | by | fetches | us a ray | error | product | "
           "ratio tracking's over it |\n"
           "| --- | --- | --- | --- | --- | --- | --- |\n");
    for (int i = 0; i < 5; i++) {
        float *density = make_density(media[i].cloud);
        make_cells(density, media[i].sigma, media[i].side);
        make_rays(rays);
        const char *what = media[i].what;
        double by = measure(what, "ratio tracking", ratio, rays, 0.0);
        measure(what, "residual, least", residual_least, rays, by);
        measure(what, "residual, mean", residual_mean, rays, by);
        measure(what, "ray marching", marching, rays, by);
        measure(what, "exact", exact, rays, by);
        free(density);
    }
    return 0;
}
