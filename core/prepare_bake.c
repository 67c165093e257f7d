/* Functions that fill unbounded space become grids: sampled over the bounds
 * of all that is bounded, finer until what interpolation leaves is within a
 * stated error, or as fine as a grid may be. */
#define PHYSICS_DOUBLE
#include "core/function.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "core/prepare.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* Samples along the longest side, and in all; probes of the error. */
enum { LEAST_SAMPLES = 25, MOST_SAMPLES = 2 << 20, PROBES = 2048 };

/* The square root of the mean squared error over that of the mean square. */
#define BAKE_ERROR 0.01

struct bake {
    const brume_scene *scene;
    const struct brume_field *field;
    int component;
    matrix to_field; /* the scene's space to the function's         */
    struct box box;
    struct grid *grid;
    float *voxels; /* of the grid's bricks, all stored in order   */
    int samples[3];
    double step;
};

static double value_at(const struct bake *b, const double p[3])
{
    double r[MACHINE_REGISTERS];
    machine m = function_machine(b->scene);
    matrix_point(&b->to_field, p, r);
    if (!machine_run(&m, b->field->function, r))
        return 0.0;
    double v = r[b->component];
    return v > 0.0 && v < HUGE_VAL ? v : 0.0;
}

static void fill_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct bake *b = context;
    size_t rest = index;
    int corner[3];
    float *out = b->voxels + index * GRID_BRICK_VOXELS;
    for (int i = 0; i < 3; i++) {
        corner[i] = GRID_BRICK * (int)(rest % (size_t)b->grid->bricks[i]);
        rest /= (size_t)b->grid->bricks[i];
    }
    for (int k = 0; k < GRID_BRICK_VOXELS; k++) {
        int at[3] = {corner[0] + k % 8, corner[1] + k / 8 % 8,
                     corner[2] + k / 64};
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = b->box.lo[i] + b->step * at[i];
        out[k] = (float)value_at(b, p);
    }
}

/* A grid with `along` samples on the longest side of the box. */
static bool sample(struct bake *b, int along, int threads,
                   struct brume_error *err)
{
    const int32_t origin[3] = {0, 0, 0};
    int32_t bricks[3];
    double longest = 0.0;
    size_t count = 1;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, b->box.hi[i] - b->box.lo[i]);
    b->step = longest / (along - 1);
    for (int i = 0; i < 3; i++) {
        double side = (b->box.hi[i] - b->box.lo[i]) / b->step;
        b->samples[i] = (int)ceil(side - 1e-9) + 1;
        bricks[i] = (b->samples[i] + GRID_BRICK - 1) / GRID_BRICK;
        count *= (size_t)bricks[i];
    }
    b->grid = grid_new(origin, bricks, 0.0f, err);
    if (!b->grid)
        return false;
    for (size_t k = 0; k < count; k++) {
        int x = (int)(k % (size_t)bricks[0]);
        int y = (int)(k / (size_t)bricks[0] % (size_t)bricks[1]);
        int z = (int)(k / ((size_t)bricks[0] * (size_t)bricks[1]));
        if (!grid_brick(b->grid, x, y, z, err))
            return false;
    }
    b->voxels = b->grid->voxel;
    parallel_for(threads, count, fill_brick, b, NULL);
    return true;
}

static double interpolate(const struct grid *g, const double at[3])
{
    int corner[3];
    double sum = 0.0, u[3];
    for (int i = 0; i < 3; i++) {
        corner[i] = (int)floor(at[i]);
        u[i] = at[i] - corner[i];
    }
    for (int c = 0; c < 8; c++) {
        int x = c & 1, y = c >> 1 & 1, z = c >> 2;
        sum += (x ? u[0] : 1.0 - u[0]) * (y ? u[1] : 1.0 - u[1]) *
               (z ? u[2] : 1.0 - u[2]) *
               (double)grid_sample(g, corner[0] + x, corner[1] + y,
                                   corner[2] + z);
    }
    return sum;
}

/* Of points that fill the box evenly [Roberts 2018]. */
static double error_left(const struct bake *b)
{
    const double steps[3] = {0.8191725133961645, 0.6710436067037893,
                             0.5497004779019703};
    double wrong = 0.0, all = 0.0;
    for (int k = 1; k <= PROBES; k++) {
        double p[3], at[3];
        for (int i = 0; i < 3; i++) {
            double u = fmod(0.5 + k * steps[i], 1.0);
            p[i] = b->box.lo[i] + u * (b->box.hi[i] - b->box.lo[i]);
            at[i] = (p[i] - b->box.lo[i]) / b->step;
        }
        double truth = value_at(b, p), d = interpolate(b->grid, at) - truth;
        wrong += d * d;
        all += truth * truth;
    }
    return all > 0.0 ? sqrt(wrong / all) : 0.0;
}

/* ---- where ------------------------------------------------------------- */

/* The bounds of all that is bounded, and the camera. */
static struct box bounded_part(const brume_scene *s, const struct assembly *a)
{
    struct box all = box_empty();
    box_add(&all, s->camera.location);
    for (size_t i = 0; i < a->parts_count; i++) {
        const struct box *seen = &a->parts[i].seen;
        if (box_is_bounded(seen) && !box_is_empty(seen))
            all = box_hull(&all, seen);
    }
    return all;
}

/* A margin for rounding, and some thickness where there is none. */
static void widen(struct box *box)
{
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, box->hi[i] - box->lo[i]);
    double margin = longest > 0.0 ? 0.01 * longest : 1.0;
    for (int i = 0; i < 3; i++) {
        box->lo[i] -= margin;
        box->hi[i] += margin;
    }
}

/* Outside it is as it is on average, where the field goes on. */
static void set_outside(struct bake *b)
{
    double sum = 0.0;
    size_t count = b->grid->stored * GRID_BRICK_VOXELS;
    for (size_t i = 0; i < count; i++)
        sum += (double)b->voxels[i];
    b->grid->tile[0] = (float)(sum / (double)count);
}

/* ---- all of it --------------------------------------------------------- */

/* Twice as fine each time, while it is too coarse and may be finer. */
static bool refine(struct bake *b, int threads, double *left,
                   struct brume_error *err)
{
    for (int along = LEAST_SAMPLES;; along = 2 * along - 1) {
        if (!sample(b, along, threads, err))
            return false;
        *left = error_left(b);
        double next = 8.0;
        for (int i = 0; i < 3; i++)
            next *= b->samples[i];
        if (*left <= BAKE_ERROR || next > MOST_SAMPLES)
            return true;
        grid_free(b->grid);
        b->grid = NULL;
    }
}

static void tell(const struct prepare *job, int field, double left)
{
    char text[200];
    if (!job->warn)
        return;
    if (left > BAKE_ERROR) {
        snprintf(text, sizeof text,
                 "the function of field %d is drawn from a grid with an error "
                 "of %.1f %%",
                 field, 100.0 * left);
        job->warn(job->user, text);
    }
    snprintf(text, sizeof text,
             "the function of field %d fills unbounded space: beyond the "
             "scene's bounds it is drawn as its mean",
             field);
    job->warn(job->user, text);
}

static void place(struct bake *b)
{
    struct grid *g = b->grid;
    g->filter = GRID_TRILINEAR;
    g->clip = false;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++)
            g->to_world[i][k] = k == 3 ? b->box.lo[i] : k == i ? b->step : 0.0;
    set_outside(b);
    grid_finish(g);
}

struct grid *prepare_bake(const struct prepare *job, const struct assembly *a,
                          int field, int component, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    struct bake b = {
        .scene = s, .field = &s->fields[field], .component = component};
    matrix to_world = matrix_from(b.field->transform);
    double left = 0.0;
    matrix_invert(&to_world, &b.to_field);
    b.box = bounded_part(s, a);
    widen(&b.box);
    if (!refine(&b, job->threads, &left, err)) {
        grid_free(b.grid);
        return NULL;
    }
    place(&b);
    if (component <= 0 || b.field->component >= 0)
        tell(job, field, left);
    return b.grid;
}
