/* Particles to a grid: a kernel estimate whose radii follow the distance of
 * neighbours (Breiman, Meisel and Purcell 1977), as the published system's
 * preprocess adapts them. The formula is in brume.h. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "core/brume.h"
#include "core/neighbors.h"
#include "lib/memory.h"
#include "lib/thread.h"

enum { DEFAULT_NEIGHBORS = 32, CHUNK = 1024 };

#define MIN_RADIUS 1.5    /* in voxels                                   */
#define MEDIAN_RADII 8.0  /* what neighbours widen to, in medians        */
#define RADIUS_VOXELS 3.0 /* the median radius, in voxels                */
#define FAR 1e100         /* squares of coordinates stay finite          */
#define MAX_SAMPLES 1e10  /* of all balls                                */
#define FEW_SAMPLES 4e8   /* ... where the voxel may be chosen           */
#define MAX_STORED ((size_t)1 << 20) /* bricks: 2 GiB                      */
#define MAX_SLOTS ((size_t)1 << 24)

struct particle {
    double at[3];
    double radius;
    double mass; /* later: mass over the sum of its samples, per volume    */
    double value;
};

struct cloud {
    const struct brume_particles *in;
    struct particle *point;
    size_t count;
    double voxel;
    double corner[3]; /* of the lattice, in whole voxels from 0            */
    int32_t bricks[3];
    struct grid *grid;
    size_t *first;  /* of each stored brick in `list`, and the end       */
    int32_t *place; /* of each stored brick: its index in the grid       */
    uint32_t *list; /* points that reach into a brick                    */
    struct brume_error *err;
};

/* ---- what comes in ---- */

/* NAN, INFINITY or -1, whichever of them a point has first in this order; 0
 * where it is sound. */
static double fault_of(const struct particle *p)
{
    double numbers[] = {p->at[0],  p->at[1], p->at[2],
                        p->radius, p->mass,  p->value};
    double fault = 0;
    for (int i = 0; i < 6; i++) {
        if (isnan(numbers[i]))
            return NAN;
        if (isinf(numbers[i]))
            fault = INFINITY;
        else if (i >= 3 && numbers[i] < 0 && fault == 0)
            fault = -1;
    }
    return fault;
}

/* Copies the sound points that have a mass, and counts the others. */
static void take_points(struct cloud *c, size_t bad[3])
{
    const struct brume_particles *in = c->in;
    for (size_t i = 0; i < in->count; i++) {
        struct particle p = {
            .radius = in->radius ? in->radius[i] : in->default_radius,
            .mass = in->mass ? in->mass[i] : 1,
            .value = in->value ? in->value[i] : 0,
        };
        memcpy(p.at, in->at + 3 * i, sizeof p.at);
        double fault = fault_of(&p);
        bad[0] += isnan(fault) ? 1 : 0;
        bad[1] += isinf(fault) ? 1 : 0;
        bad[2] += fault < 0 ? 1 : 0;
        if (fault == 0 && p.mass > 0)
            c->point[c->count++] = p;
    }
}

static int by_size(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* The median of those numbers that are above 0, or 0; sorts them. */
static double median(double *v, size_t count)
{
    qsort(v, count, sizeof *v, by_size);
    size_t zeros = 0;
    while (zeros < count && !(v[zeros] > 0))
        zeros++;
    return zeros < count ? v[zeros + (count - zeros) / 2] : 0;
}

/* Widens radii to the distances of neighbours. */
static bool adapt(struct cloud *c, int neighbors, double *room)
{
    double *at = memory_new(3 * c->count, sizeof *at, c->err);
    double *far = memory_new(c->count, sizeof *far, c->err);
    bool done = at && far;
    for (size_t i = 0; done && i < c->count; i++)
        memcpy(at + 3 * i, c->point[i].at, sizeof c->point[i].at);
    done = done && neighbors_distances(at, c->count, neighbors, c->in->threads,
                                       far, c->err);
    if (done) {
        memcpy(room, far, c->count * sizeof *far);
        double most = MEDIAN_RADII * median(room, c->count);
        for (size_t i = 0; i < c->count; i++)
            c->point[i].radius = fmax(c->point[i].radius, fmin(far[i], most));
    }
    free(far);
    free(at);
    return done;
}

/* ---- the lattice ---- */

/* A point in the lattice, and its ball there. The lattice has room for it; far
 * from 0, where numbers are coarser than voxels, the bounds make that sure. */
struct ball {
    double at[3], radius;
    int32_t low[3], high[3]; /* samples that it may reach                   */
};

static double radius_in_voxels(const struct cloud *c, const struct particle *p)
{
    return fmax(p->radius / c->voxel, MIN_RADIUS);
}

static struct ball ball_of(const struct cloud *c, const struct particle *p)
{
    struct ball b = {.radius = radius_in_voxels(c, p)};
    for (int a = 0; a < 3; a++) {
        b.at[a] = p->at[a] / c->voxel - c->corner[a];
        double last = GRID_BRICK * (double)c->bricks[a] - 1;
        b.low[a] = (int32_t)ceil(fmax(b.at[a] - b.radius, 0));
        b.high[a] = (int32_t)floor(fmin(b.at[a] + b.radius, last));
    }
    return b;
}

/* Places the lattice around the points; false where a side would have more
 * than 2^30 voxels. Its corner is of whole bricks from 0, so that two clouds
 * of one voxel have their samples at the same places. */
static bool place_lattice(struct cloud *c)
{
    for (int a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < c->count; i++) {
            double at = c->point[i].at[a] / c->voxel;
            double radius = radius_in_voxels(c, &c->point[i]);
            low = fmin(low, at - radius);
            high = fmax(high, at + radius);
        }
        c->corner[a] = GRID_BRICK * floor(low / GRID_BRICK);
        double side = floor((high - c->corner[a]) / GRID_BRICK) + 1;
        if (!(side < (1 << 27)))
            return false;
        c->bricks[a] = (int32_t)side;
    }
    return true;
}

static size_t slots_of(const struct cloud *c)
{
    size_t slots = 1;
    for (int a = 0; a < 3; a++)
        if (!memory_multiply(slots, (size_t)c->bricks[a], &slots))
            return SIZE_MAX;
    return slots;
}

/* How many samples the balls have. */
static double samples_of(const struct cloud *c)
{
    double sum = 0;
    for (size_t i = 0; i < c->count; i++) {
        double side = 2 * radius_in_voxels(c, &c->point[i]) + 1;
        sum += side * side * side;
    }
    return sum;
}

/* Calls `visit` with each brick that a ball reaches. */
typedef void visit_function(struct cloud *, size_t slot, size_t point);

static void visit_bricks(struct cloud *c, visit_function *visit)
{
    for (size_t i = 0; i < c->count; i++) {
        struct ball b = ball_of(c, &c->point[i]);
        for (int32_t z = b.low[2] / 8; z <= b.high[2] / 8; z++)
            for (int32_t y = b.low[1] / 8; y <= b.high[1] / 8; y++)
                for (int32_t x = b.low[0] / 8; x <= b.high[0] / 8; x++)
                    visit(c,
                          (size_t)x + (size_t)c->bricks[0] *
                                          ((size_t)y +
                                           (size_t)c->bricks[1] * (size_t)z),
                          i);
    }
}

static void mark_brick(struct cloud *c, size_t slot, size_t point)
{
    (void)point;
    c->grid->slot[slot] = 0;
}

/* Whether a grid of this voxel is small enough. */
static bool fits(struct cloud *c, double samples, size_t slots)
{
    static const int32_t origin[3] = {0, 0, 0};
    if (!place_lattice(c) || slots_of(c) > slots || samples_of(c) > samples)
        return false;
    grid_free(c->grid);
    c->grid = grid_new(origin, c->bricks, 0, c->err);
    if (!c->grid)
        return false;
    visit_bricks(c, mark_brick);
    for (size_t i = 0, all = slots_of(c); i < all; i++)
        c->grid->stored += c->grid->slot[i] == 0 ? 1 : 0;
    return c->grid->stored <= MAX_STORED;
}

/* A voxel below which fits() is false for sure: the box of the points in
 * MAX_SLOTS bricks along its longest side, two sides, or three, and the balls
 * in so many samples. */
static double least_voxel(const struct cloud *c, double samples)
{
    double side[3], cubes = 0;
    for (int a = 0; a < 3; a++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < c->count; i++) {
            low = fmin(low, c->point[i].at[a]);
            high = fmax(high, c->point[i].at[a]);
        }
        side[a] = (high - low) / GRID_BRICK;
    }
    qsort(side, 3, sizeof *side, by_size);
    for (size_t i = 0; i < c->count; i++)
        cubes += pow(2 * c->point[i].radius, 3);
    double slots = (double)MAX_SLOTS;
    double box = fmax(side[2] / slots,
                      fmax(sqrt(side[2] / slots * side[1]),
                           cbrt(side[2] / slots * side[1] * side[0])));
    return fmax(box, cbrt(cubes / samples));
}

/* The voxel that is asked for, or the least that is small enough. */
static bool choose_voxel(struct cloud *c, double median_radius)
{
    c->voxel = c->in->voxel;
    if (c->voxel > 0)
        return fits(c, MAX_SAMPLES, (size_t)1 << 28) ||
               brume_fail(c->err, BRUME_ERR_LIMIT,
                          "%zu particles on voxels of %g make too large a "
                          "grid; the limits are 2^28 bricks of 8^3 voxels, %zu "
                          "that are not empty, and %g samples: choose larger "
                          "voxels",
                          c->count, c->voxel, MAX_STORED, MAX_SAMPLES);
    double samples = fmax(FEW_SAMPLES, 100.0 * (double)c->count);
    c->voxel = fmax(median_radius / RADIUS_VOXELS, least_voxel(c, samples));
    while (!fits(c, samples, MAX_SLOTS)) {
        if (c->err->code != BRUME_OK)
            return false;
        c->voxel *= 1.25;
    }
    return true;
}

/* ---- sums ---- */

/* What of a ball lies in a brick, samples from 0 to 7 there, and the squares
 * of their distances along each axis over that of the radius. */
struct part {
    int low[3], high[3];
    double square[3][GRID_BRICK];
};

static struct part part_of(const struct ball *b, const int32_t corner[3])
{
    struct part part;
    double scale = 1 / (b->radius * b->radius);
    for (int a = 0; a < 3; a++) {
        int64_t low = (int64_t)b->low[a] - corner[a];
        int64_t high = (int64_t)b->high[a] - corner[a];
        part.low[a] = low > 0 ? (int)low : 0;
        part.high[a] = high < 7 ? (int)high : 7;
        for (int i = part.low[a]; i <= part.high[a]; i++) {
            double d = corner[a] + i - b->at[a];
            part.square[a][i] = d * d * scale;
        }
    }
    return part;
}

/* The kernel without its constant, (1 - d^2 / r^2)^3; `rest` is 1 less the
 * squares along y and z. */
static double kernel(double rest, double square)
{
    double q = rest - square;
    q = q > 0 ? q : 0;
    return q * q * q;
}

static double part_sum(const struct part *p)
{
    double sum = 0;
    for (int z = p->low[2]; z <= p->high[2]; z++)
        for (int y = p->low[1]; y <= p->high[1]; y++) {
            double rest = 1 - p->square[2][z] - p->square[1][y];
            for (int x = p->low[0]; x <= p->high[0] && rest > 0; x++)
                sum += kernel(rest, p->square[0][x]);
        }
    return sum;
}

static double ball_sum(const struct ball *b)
{
    double sum = 0;
    int32_t at[3];
    for (at[2] = b->low[2] & ~7; at[2] <= b->high[2]; at[2] += GRID_BRICK)
        for (at[1] = b->low[1] & ~7; at[1] <= b->high[1]; at[1] += GRID_BRICK)
            for (at[0] = b->low[0] & ~7; at[0] <= b->high[0];
                 at[0] += GRID_BRICK) {
                struct part part = part_of(b, at);
                sum += part_sum(&part);
            }
    return sum;
}

static void scale_chunk(void *context, size_t index, int thread)
{
    struct cloud *c = context;
    size_t end = (index + 1) * CHUNK;
    double volume = c->voxel * c->voxel * c->voxel;
    (void)thread;
    for (size_t i = index * CHUNK; i < end && i < c->count; i++) {
        struct ball b = ball_of(c, &c->point[i]);
        c->point[i].mass /= ball_sum(&b) * volume;
    }
}

struct sums {
    double density[GRID_BRICK_VOXELS], value[GRID_BRICK_VOXELS];
};

static void add_part(const struct part *part, double mass, double value,
                     struct sums *sums)
{
    for (int z = part->low[2]; z <= part->high[2]; z++)
        for (int y = part->low[1]; y <= part->high[1]; y++) {
            double rest = 1 - part->square[2][z] - part->square[1][y];
            int row = GRID_BRICK * (y + GRID_BRICK * z);
            for (int x = part->low[0]; x <= part->high[0] && rest > 0; x++) {
                double add = mass * kernel(rest, part->square[0][x]);
                sums->density[row + x] += add;
                sums->value[row + x] += add * value;
            }
        }
}

static void fill_brick(void *context, size_t index, int thread)
{
    struct cloud *c = context;
    struct sums sums = {{0}, {0}};
    int32_t at = c->place[index], corner[3];
    float *out = c->grid->voxel + index * GRID_BRICK_VOXELS;
    (void)thread;
    for (int a = 0; a < 3; a++) {
        corner[a] = GRID_BRICK * (at % c->bricks[a]);
        at /= c->bricks[a];
    }
    for (size_t i = c->first[index]; i < c->first[index + 1]; i++) {
        const struct particle *p = &c->point[c->list[i]];
        struct ball b = ball_of(c, p);
        struct part part = part_of(&b, corner);
        add_part(&part, p->mass, p->value, &sums);
    }
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        if (!c->in->value)
            out[i] = (float)sums.density[i];
        else if (sums.density[i] > 0)
            out[i] = (float)(sums.value[i] / sums.density[i]);
}

/* ---- which points a brick needs ---- */

static void count_point(struct cloud *c, size_t slot, size_t point)
{
    (void)point;
    c->first[c->grid->slot[slot]]++;
}

static void list_point(struct cloud *c, size_t slot, size_t point)
{
    c->list[--c->first[c->grid->slot[slot]]] = (uint32_t)point;
}

/* Stores the marked bricks, in order. */
static bool store_bricks(struct cloud *c)
{
    struct grid *g = c->grid;
    size_t stored = g->stored;
    g->stored = 0;
    c->place = memory_new(stored, sizeof *c->place, c->err);
    if (!c->place)
        return false;
    for (size_t i = 0, all = slots_of(c); i < all; i++) {
        int x = (int)(i % (size_t)c->bricks[0]);
        size_t yz = i / (size_t)c->bricks[0];
        if (g->slot[i] != 0)
            continue;
        g->slot[i] = -1;
        c->place[g->stored] = (int32_t)i;
        if (!grid_brick(g, x, (int)(yz % (size_t)c->bricks[1]),
                        (int)(yz / (size_t)c->bricks[1]), c->err))
            return false;
    }
    return true;
}

/* The stored brick of the sample before a point: its ball reaches that. */
static int32_t home_of(const struct cloud *c, const struct particle *p)
{
    struct ball b = ball_of(c, p);
    size_t slot = 0;
    for (int a = 2; a >= 0; a--)
        slot = slot * (size_t)c->bricks[a] + (size_t)b.at[a] / GRID_BRICK;
    return c->grid->slot[slot];
}

/* Puts points of one brick together, so that memory is read in order. */
static bool sort_points(struct cloud *c)
{
    size_t stored = c->grid->stored, sum = 0;
    struct particle *sorted = memory_new(c->count, sizeof *sorted, c->err);
    size_t *next = memory_new(stored, sizeof *next, c->err);
    bool done = sorted && next;
    for (size_t i = 0; done && i < c->count; i++)
        next[home_of(c, &c->point[i])]++;
    for (size_t i = 0; done && i < stored; i++) {
        sum += next[i];
        next[i] = sum - next[i];
    }
    for (size_t i = 0; done && i < c->count; i++)
        sorted[next[home_of(c, &c->point[i])]++] = c->point[i];
    free(next);
    if (!done) {
        free(sorted);
        return false;
    }
    free(c->point);
    c->point = sorted;
    return true;
}

/* Lists each brick's points, the last first, by counting them. */
static bool list_points(struct cloud *c)
{
    size_t sum = 0;
    c->first = memory_new(c->grid->stored + 1, sizeof *c->first, c->err);
    if (!c->first)
        return false;
    visit_bricks(c, count_point);
    for (size_t i = 0; i <= c->grid->stored; i++)
        c->first[i] = sum += c->first[i];
    c->list = memory_new(sum, sizeof *c->list, c->err);
    if (!c->list)
        return false;
    visit_bricks(c, list_point);
    return true;
}

/* ---- the grid ---- */

static bool make_grid(struct cloud *c)
{
    if (!store_bricks(c) || !sort_points(c) || !list_points(c))
        return false;
    struct grid *g = c->grid;
    parallel_for(c->in->threads, (c->count + CHUNK - 1) / CHUNK, scale_chunk, c,
                 NULL);
    parallel_for(c->in->threads, g->stored, fill_brick, c, NULL);
    for (int a = 0; a < 3; a++) {
        g->to_world[a][a] = c->voxel;
        g->to_world[a][3] = c->corner[a] * c->voxel;
    }
    g->points = c->count;
    g->own_radii = c->in->radius != NULL;
    g->radius[0] = FLT_MAX;
    for (size_t i = 0; i < c->count; i++) {
        float r = (float)(radius_in_voxels(c, &c->point[i]) * c->voxel);
        g->radius[0] = fminf(g->radius[0], r);
        g->radius[1] = fmaxf(g->radius[1], r);
    }
    grid_finish(g);
    return !(g->bad_inf || g->bad_nan) ||
           brume_fail(c->err, BRUME_ERR_SCENE,
                      "the %s of the particles goes beyond %g",
                      c->in->value ? "value" : "density", (double)FLT_MAX);
}

static bool find_radii(struct cloud *c, double *median_radius)
{
    bool given = c->in->radius || c->in->default_radius > 0;
    int neighbors = c->in->neighbors;
    double *room = memory_new(c->count, sizeof *room, c->err);
    if (!room)
        return false;
    if (neighbors == 0 && !given)
        neighbors = DEFAULT_NEIGHBORS;
    bool done = neighbors == 0 || adapt(c, neighbors, room);
    for (size_t i = 0; i < c->count; i++)
        room[i] = c->point[i].radius;
    *median_radius = median(room, c->count);
    free(room);
    if (!done || *median_radius > 0 || c->in->voxel > 0)
        return done;
    return brume_fail(c->err, BRUME_ERR_SCENE,
                      "nothing tells how wide the particles are: %s; give a "
                      "radius",
                      given           ? "their radii are 0"
                      : c->count == 1 ? "there is only one"
                                      : "all are at one place");
}

static bool check(const struct brume_particles *in, struct brume_error *err)
{
    if (in->count >= INT32_MAX)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "%zu particles; the limit is %d", in->count,
                          INT32_MAX - 1);
    if (!(in->default_radius >= 0 && isfinite(in->default_radius)) ||
        !(in->voxel >= 0 && isfinite(in->voxel)))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the radius of particles is %g and their voxel %g, "
                          "but neither may be negative or infinite",
                          in->default_radius, in->voxel);
    if (in->neighbors < 0 || in->neighbors > BRUME_MAX_NEIGHBORS)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the neighbors of particles are %d but must be 0 to "
                          "%d",
                          in->neighbors, BRUME_MAX_NEIGHBORS);
    for (size_t i = 0; i < 3 * in->count; i++)
        if (isfinite(in->at[i]) && fabs(in->at[i]) > FAR)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "a particle has the coordinate %g; the limit is "
                              "%g",
                              in->at[i], FAR);
    return true;
}

/* Of no particles, an empty grid. */
static bool estimate(struct cloud *c)
{
    static const int32_t origin[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    double median_radius;
    if (c->count == 0)
        c->grid = grid_new(origin, one, 0, c->err);
    if (c->count == 0)
        return c->grid != NULL;
    return find_radii(c, &median_radius) && choose_voxel(c, median_radius) &&
           make_grid(c);
}

struct grid *brume_particles_grid(const struct brume_particles *particles,
                                  struct brume_error *err)
{
    size_t bad[3] = {0, 0, 0};
    struct brume_error own = {0};
    struct cloud c = {.in = particles, .err = &own};
    bool done = check(particles, &own);
    if (done)
        c.point = memory_new(particles->count, sizeof *c.point, &own);
    if (c.point)
        take_points(&c, bad);
    done = c.point && estimate(&c);
    free(c.list);
    free(c.first);
    free(c.place);
    free(c.point);
    if (done) {
        snprintf(c.grid->name, sizeof c.grid->name, "%s",
                 particles->value ? "value" : "density");
        c.grid->bad_nan = bad[0];
        c.grid->bad_inf = bad[1];
        c.grid->bad_negative = bad[2];
        return c.grid;
    }
    grid_free(c.grid);
    brume_fail(err, own.code, "%s", own.text);
    return NULL;
}
