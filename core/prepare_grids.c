/* Bricks of the host's grids become bricks of 9^3 samples: the 8^3 and one
 * layer of the upper neighbours, so that a lookup reads one brick only. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/grid.h"
#include "core/prepare.h"
#include "lib/thread.h"

struct brick_job {
    const struct grid *grid;
    const flat_grid *out;
    float *voxels;        /* of the grid's first stored brick            */
    const int32_t *where; /* brick index of each                         */
};

/* Between the background and the lowest sample of an axis a lookup still
 * interpolates: one layer of bricks below the grid holds that. */
static void pad_extent(const struct grid *g, flat_grid *out)
{
    int pad = g->filter == GRID_TRILINEAR && !g->clip;
    for (int i = 0; i < 3; i++) {
        out->origin[i] = g->origin[i] - 8 * pad;
        out->bricks[i] = g->bricks[i] + pad;
    }
}

static size_t brick_count(const flat_grid *g)
{
    return (size_t)g->bricks[0] * (size_t)g->bricks[1] * (size_t)g->bricks[2];
}

static void brick_corner(const flat_grid *g, int64_t brick, int corner[3])
{
    for (int i = 0; i < 3; i++) {
        corner[i] = g->origin[i] + 8 * (int)(brick % g->bricks[i]);
        brick /= g->bricks[i];
    }
}

/* The host grid's slot for the brick that begins at a sample. */
static int32_t slot_at(const struct grid *g, const int corner[3])
{
    size_t index = 0;
    for (int i = 2; i >= 0; i--) {
        int b = (corner[i] - g->origin[i]) / 8;
        if (corner[i] < g->origin[i] || b >= g->bricks[i])
            return -1;
        index = index * (size_t)g->bricks[i] + (size_t)b;
    }
    return g->slot[index];
}

/* Whether all 9^3 samples of a brick are one tile; returns its slot then,
 * else 0. */
static int32_t constant_slot(const struct grid *g, const int corner[3])
{
    int32_t slot = slot_at(g, corner);
    if (slot >= 0)
        return 0;
    for (int i = 1; i < 8; i++) {
        int c[3] = {corner[0] + 8 * (i & 1), corner[1] + 4 * (i & 2),
                    corner[2] + 2 * (i & 4)};
        int32_t other = slot_at(g, c);
        if (other >= 0 || g->tile[-1 - other] != g->tile[-1 - slot])
            return 0;
    }
    return slot;
}

static void brick_fill(void *context, size_t index, int thread)
{
    (void)thread;
    const struct brick_job *job = context;
    int c[3];
    brick_corner(job->out, job->where[index], c);
    float *out = job->voxels + index * BRICK_FLOATS;
    for (int z = 0; z < BRICK_SIDE; z++)
        for (int y = 0; y < BRICK_SIDE; y++)
            for (int x = 0; x < BRICK_SIDE; x++)
                *out++ = grid_sample(job->grid, c[0] + x, c[1] + y, c[2] + z);
}

/* Slots of one grid: numbers the bricks that must be stored. */
static int32_t *number_bricks(struct flat *f, const struct grid *g,
                              flat_grid *out, size_t *stored,
                              struct brume_error *err)
{
    size_t bricks = brick_count(out);
    out->slot = f->slots_count;
    int32_t *slots = FLAT_EXTEND(f, slots, bricks, err);
    if (!slots)
        return NULL;
    *stored = 0;
    for (size_t i = 0; i < bricks; i++) {
        int corner[3];
        brick_corner(out, (int64_t)i, corner);
        slots[i] = constant_slot(g, corner);
        if (slots[i] == 0)
            slots[i] = (int32_t)(*stored)++;
    }
    return slots;
}

static bool copy_bricks(const struct prepare *job, const struct grid *g,
                        flat_grid *out, struct brume_error *err)
{
    struct flat *f = job->flat;
    size_t stored, at = 0, bricks = brick_count(out);
    int32_t *slots = number_bricks(f, g, out, &stored, err);
    if (!slots)
        return false;
    out->brick = f->voxels_count / BRICK_FLOATS;
    struct brick_job fill = {.grid = g, .out = out};
    fill.voxels = FLAT_EXTEND(f, voxels, stored * BRICK_FLOATS, err);
    int32_t *where = malloc((stored + 1) * sizeof *where);
    if (!fill.voxels || !where) {
        free(where);
        return brume_fail(err, BRUME_ERR_MEMORY,
                          "out of memory for a grid of %zu bricks", stored);
    }
    for (size_t i = 0; i < bricks; i++)
        if (slots[i] >= 0)
            where[at++] = (int32_t)i;
    fill.where = where;
    parallel_for(job->threads, stored, brick_fill, &fill, NULL);
    free(where);
    return true;
}

/* The first grid that lies as the one to come does. */
static int32_t find_layout(const struct flat *f, const flat_grid *g)
{
    int32_t i = 0;
    while (i < (int32_t)f->grids_count &&
           (f->grids[i].nearest != g->nearest ||
            memcmp(f->grids[i].origin, g->origin, sizeof g->origin) ||
            memcmp(f->grids[i].bricks, g->bricks, sizeof g->bricks)))
        i++;
    return i;
}

static bool add_grid(const struct prepare *job, const struct grid *g,
                     struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_grid out;
    memset(&out, 0, sizeof out);
    pad_extent(g, &out);
    for (int i = 0; i < 3; i++) {
        out.clip_min[i] = (float)g->clip_min[i];
        out.clip_max[i] = (float)g->clip_max[i];
    }
    out.nearest = g->filter == GRID_NEAREST;
    out.clip = g->clip;
    out.layout = find_layout(f, &out);
    out.tile = f->tiles_count;
    float *tiles = FLAT_EXTEND(f, tiles, g->tiles, err);
    if (!tiles)
        return false;
    memcpy(tiles, g->tile, g->tiles * sizeof *tiles);
    if (!copy_bricks(job, g, &out, err))
        return false;
    flat_grid *slot = FLAT_EXTEND(f, grids, 1, err);
    if (slot)
        *slot = out;
    return slot != NULL;
}

/* For a grid that no ray reads. */
static bool hold_place(const struct prepare *job, struct brume_error *err)
{
    return FLAT_EXTEND(job->flat, grids, 1, err) != NULL;
}

/* Grids of one file mostly lie alike: a point's place is then found once. */
static void share_lattice(const struct flat *f, flat_field *out)
{
    out->lattice = (int32_t)(out - f->fields);
    for (int32_t i = 0; i < out->lattice; i++)
        if (f->fields[i].kind != FIELD_CONSTANT &&
            memcmp(&f->fields[i].to_index, &out->to_index,
                   sizeof out->to_index) == 0) {
            out->lattice = i;
            return;
        }
}

/* A field whose own index space `to_index` leads from. */
static bool set_index(const struct prepare *job, const matrix *to_scene,
                      flat_field *out, struct brume_error *err)
{
    matrix to_unit = matrix_compose(&job->flat->to_unit, to_scene), to_index;
    if (!matrix_invert(&to_unit, &to_index))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "the place of a grid or function in the scene has "
                          "no inverse");
    out->to_index = matrix_affine(&to_index);
    share_lattice(job->flat, out);
    return true;
}

/* A field that reads the grid, which `placed` moves. */
static bool place_field(const struct prepare *job, const struct grid *grid,
                        const matrix *placed, flat_field *out,
                        struct brume_error *err)
{
    matrix to_scene = matrix_from(grid->to_world);
    to_scene = matrix_compose(placed, &to_scene);
    return set_index(job, &to_scene, out, err);
}

/* Through grids of its own, which come after all others. */
static bool bake_function(const struct prepare *job, const struct assembly *a,
                          int field, flat_field *out, struct brume_error *err)
{
    matrix here = matrix_identity();
    int component = job->scene->fields[field].component;
    out->colored = component < 0;
    out->grid = (int32_t)job->flat->grids_count;
    for (int i = 0; i < (out->colored ? 3 : 1); i++) {
        struct grid *grid = prepare_bake(job, a, field,
                                         out->colored ? i : component, err);
        bool done = grid && add_grid(job, grid, err) &&
                    place_field(job, grid, &here, out, err);
        grid_free(grid);
        if (!done)
            return false;
    }
    return true;
}

static bool add_function(const struct prepare *job, const struct assembly *a,
                         int field, flat_field *out, struct brume_error *err)
{
    bool bounded;
    matrix to_scene;
    if (!prepare_function(job, a, field, &to_scene, &bounded, err))
        return false;
    if (!bounded)
        return bake_function(job, a, field, out, err);
    out->kind = FIELD_FUNCTION;
    out->colored = job->scene->fields[field].component < 0;
    out->grid = (int32_t)job->flat->procedures_count - 1;
    return set_index(job, &to_scene, out, err);
}

static bool add_field(const struct prepare *job, const struct assembly *a,
                      int field, struct brume_error *err)
{
    const struct brume_field *in = &job->scene->fields[field];
    flat_field *out = FLAT_EXTEND(job->flat, fields, 1, err);
    if (!out)
        return false;
    out->kind = in->kind == BRUME_FIELD_CONSTANT ? FIELD_CONSTANT : FIELD_GRID;
    out->scale = (float)in->scale;
    out->grid = in->grid;
    if (in->kind == BRUME_FIELD_FUNCTION)
        return add_function(job, a, field, out, err);
    if (in->kind == BRUME_FIELD_CONSTANT)
        return true;
    matrix placed = matrix_from(in->transform);
    return place_field(job, job->scene->grids[in->grid], &placed, out, err);
}

bool prepare_grids(const struct prepare *job, const struct assembly *a,
                   struct brume_error *err)
{
    const brume_scene *s = job->scene;
    for (size_t i = 0; i < s->grids_count; i++)
        if (!(s->grids[i]->any_sign ? hold_place(job, err)
                                    : add_grid(job, s->grids[i], err)))
            return false;
    for (size_t i = 0; i < s->fields_count; i++)
        if (!add_field(job, a, (int)i, err))
            return false;
    flat_view(job->flat);
    return true;
}

/* Largest of the samples first to last of a brick, its apron included. */
static float brick_bound(const struct flat *f, const flat_grid *g, int x, int y,
                         int z, const int first[3], const int last[3])
{
    int32_t slot = f->slots[g->slot + (size_t)x +
                            (size_t)g->bricks[0] *
                                ((size_t)y + (size_t)g->bricks[1] * (size_t)z)];
    if (slot < 0)
        return f->tiles[g->tile + (size_t)(-1 - slot)];
    const float *v = f->voxels + (g->brick + (size_t)slot) * BRICK_FLOATS;
    float most = 0.0f;
    for (int k = first[2]; k <= last[2]; k++)
        for (int j = first[1]; j <= last[1]; j++)
            for (int i = first[0]; i <= last[0]; i++)
                most = fmaxf(most, v[(k * BRICK_SIDE + j) * BRICK_SIDE + i]);
    return most;
}

/* Image of a box under a map: the box around its corners. */
static void box_image(const matrix *map, const double lo[3], const double hi[3],
                      double out_lo[3], double out_hi[3])
{
    for (int c = 0; c < 8; c++) {
        double p[3] = {c & 1 ? hi[0] : lo[0], c & 2 ? hi[1] : lo[1],
                       c & 4 ? hi[2] : lo[2]},
               q[3];
        matrix_point(map, p, q);
        for (int i = 0; i < 3; i++) {
            out_lo[i] = c == 0 ? q[i] : fmin(out_lo[i], q[i]);
            out_hi[i] = c == 0 ? q[i] : fmax(out_hi[i], q[i]);
        }
    }
}

/* Range of samples of the grid, from 0, that lookups in [lo, hi] of an axis
 * read; true when some fall outside. A tolerance of 2^-10 voxel covers the
 * rounding of positions; the samples that only it reaches are left out where
 * lookups are continuous (prepare_media.c allows for their share), but never
 * all of a box that is thinner. */
static bool sample_range(const flat_grid *g, int axis, double lo, double hi,
                         int *first, int *last)
{
    double slack = g->nearest ? 1.0 / 1024 : -fmin(1.0 / 1024, (hi - lo) / 4.0);
    double shift = (g->nearest ? 0.5 : 0.0) - g->origin[axis];
    double a = floor(lo + shift - slack);
    double b = floor(hi + shift + slack);
    int top = 8 * g->bricks[axis] - 1;
    *first = a < 0.0 ? 0 : a > top ? top + 1 : (int)a;
    *last = b > top ? top : b < 0.0 ? -1 : (int)b;
    return a < 0.0 || b > top;
}

/* The part of such a range that lies in a brick. The upper neighbours of what
 * is looked up, which a lookup that interpolates reads too, are in it. */
static void range_in_brick(const flat_grid *g, int brick, int first, int last,
                           int *from, int *to)
{
    *from = first > 8 * brick ? first - 8 * brick : 0;
    *to = last < 8 * brick + 7 ? last - 8 * brick : 7;
    *to += g->nearest ? 0 : 1;
}

static float range_bound(const struct flat *flat, const flat_grid *g,
                         const int first[3], const int last[3])
{
    float most = 0.0f;
    int from[3], to[3];
    for (int z = first[2] / 8; 8 * z <= last[2]; z++) {
        range_in_brick(g, z, first[2], last[2], &from[2], &to[2]);
        for (int y = first[1] / 8; 8 * y <= last[1]; y++) {
            range_in_brick(g, y, first[1], last[1], &from[1], &to[1]);
            for (int x = first[0] / 8; 8 * x <= last[0]; x++) {
                range_in_brick(g, x, first[0], last[0], &from[0], &to[0]);
                most = fmaxf(most, brick_bound(flat, g, x, y, z, from, to));
            }
        }
    }
    return most;
}

/* The cells of a procedure, from first to last. */
static float cells_bound(const struct flat *flat, const flat_procedure *p,
                         const int first[3], const int last[3])
{
    float most = 0.0f;
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++)
            for (int x = first[0]; x <= last[0]; x++)
                most = fmaxf(most,
                             flat->bounds[p->bound + (size_t)x +
                                          (size_t)p->cells[0] *
                                              ((size_t)y + (size_t)p->cells[1] *
                                                               (size_t)z)]);
    return most;
}

/* A face that two cells share is of one of them. */
static float procedure_bound(const struct flat *flat, const flat_procedure *p,
                             const double lo[3], const double hi[3])
{
    int first[3], last[3];
    for (int i = 0; i < 3; i++) {
        double slack = fmin(1e-3, 0.25 * (hi[i] - lo[i]));
        double a = floor((lo[i] + slack) / PROCEDURE_SIDE);
        double b = floor((hi[i] - slack) / PROCEDURE_SIDE);
        first[i] = a > 0.0 ? (int)fmin(a, p->cells[i]) : 0;
        last[i] = b < p->cells[i] ? (int)fmax(b, -1.0) : p->cells[i] - 1;
    }
    return cells_bound(flat, p, first, last);
}

static float grid_bound(const struct flat *flat, const flat_grid *g,
                        const double lo[3], const double hi[3])
{
    int first[3], last[3];
    bool outside = false;
    for (int i = 0; i < 3; i++)
        outside |= sample_range(g, i, lo[i], hi[i], &first[i], &last[i]);
    float most = range_bound(flat, g, first, last);
    return fmaxf(most, outside ? flat->tiles[g->tile] : 0.0f);
}

static int field_grids(const flat_field *f)
{
    return f->colored ? 3 : 1;
}

float prepare_field_bound(const struct flat *flat, int field,
                          const matrix *to_unit, const double lo[3],
                          const double hi[3])
{
    const flat_field *f = &flat->fields[field];
    if (f->kind == FIELD_CONSTANT)
        return f->scale;
    matrix to_index, map;
    for (int i = 0; i < 12; i++)
        to_index.m[i / 4][i % 4] = f->to_index.m[i];
    map = matrix_compose(&to_index, to_unit);
    double a[3], b[3];
    box_image(&map, lo, hi, a, b);
    if (f->kind == FIELD_FUNCTION)
        return procedure_bound(flat, &flat->procedures[f->grid], a, b);
    float most = 0.0f;
    for (int i = 0; i < field_grids(f); i++)
        most = fmaxf(most, grid_bound(flat, &flat->grids[f->grid + i], a, b));
    return most * f->scale;
}

float prepare_field_bound_everywhere(const struct flat *flat, int field)
{
    const flat_field *f = &flat->fields[field];
    const int first[3] = {0, 0, 0};
    int last[3];
    float most = 0.0f;
    if (f->kind == FIELD_CONSTANT)
        return f->scale;
    if (f->kind == FIELD_FUNCTION) {
        const flat_procedure *p = &flat->procedures[f->grid];
        for (int i = 0; i < 3; i++)
            last[i] = p->cells[i] - 1;
        return cells_bound(flat, p, first, last);
    }
    for (int k = 0; k < field_grids(f); k++) {
        const flat_grid *g = &flat->grids[f->grid + k];
        for (int i = 0; i < 3; i++)
            last[i] = 8 * g->bricks[i] - 1;
        most = fmaxf(most, range_bound(flat, g, first, last));
        most = fmaxf(most, flat->tiles[g->tile]);
    }
    return most * f->scale;
}
