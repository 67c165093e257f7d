/* Which cells of majorant lattices no shape's boundary goes through: flights
 * that stay in them seek no surface. Where it can't be told, one may. */
#include <math.h>
#include "core/physics/leaf.h"
#include "core/prepare.h"
#include "lib/thread.h"

/* Boundaries count as so much nearer than they are, for rounding: in cells,
 * and in the units of a shape's own space. */
#define NEAR_CELL 0.02
#define NEAR_SHAPE 1e-4

/* Where more shapes would have to be held against cells, none is clear. */
#define MOST_TESTS 100000000.0

struct clear {
    struct flat *flat;
    const flat_medium *medium;
    matrix from_cell; /* lattice coordinates to unit space           */
};

/* A cell's corner, moved out a little. */
static void corner_of(const struct clear *c, const int cell[3], int corner,
                      double out[3])
{
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = corner >> i & 1 ? cell[i] + 1.0 + NEAR_CELL
                               : cell[i] - NEAR_CELL;
    matrix_point(&c->from_cell, p, out);
}

/* Bounds of a shape's boundary in its own space; false: not known. */
static bool shape_bounds(const flat_shape *f, double lo[3], double hi[3])
{
    bool ball = f->kind == SHAPE_SPHERE || f->kind == SHAPE_BOX;
    if (f->kind < SHAPE_SPHERE || f->kind > SHAPE_DISC)
        return false;
    if (f->kind == SHAPE_PLANE || f->kind == SHAPE_DISC) {
        lo[0] = lo[1] = -INFINITY;
        hi[0] = hi[1] = INFINITY;
        lo[2] = hi[2] = 0.0;
        return true;
    }
    double radius = f->kind == SHAPE_CONE
                        ? fmax((double)f->params[0], (double)f->params[1])
                        : 1.0;
    for (int i = 0; i < 3; i++) {
        lo[i] = i == 2 && !ball ? 0.0 : -radius;
        hi[i] = i == 2 && !ball ? 1.0 : radius;
    }
    return true;
}

/* Well inside of a ball or a box, which are convex. */
static bool deep_inside(const flat_shape *f, const double p[3])
{
    const double most = 1.0 - NEAR_SHAPE;
    if (f->kind == SHAPE_SPHERE)
        return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) < most;
    return f->kind == SHAPE_BOX && fabs(p[0]) < most && fabs(p[1]) < most &&
           fabs(p[2]) < most;
}

static void shape_point(const flat_shape *f, const double p[3], double out[3])
{
    const float *m = f->to_local.m;
    for (int i = 0; i < 3; i++)
        out[i] = (double)m[4 * i] * p[0] + (double)m[4 * i + 1] * p[1] +
                 (double)m[4 * i + 2] * p[2] + (double)m[4 * i + 3];
}

/* Whether the boundary of a shape stays off a cell: it lies in the shape, or
 * beyond one side of its bounds. */
static bool stays_off(const struct clear *c, const flat_shape *f,
                      const int cell[3])
{
    double lo[3], hi[3];
    bool known = shape_bounds(f, lo, hi), in = true;
    bool below[3] = {true, true, true}, above[3] = {true, true, true};
    for (int k = 0; known && k < 8; k++) {
        double p[3], q[3];
        corner_of(c, cell, k, p);
        shape_point(f, p, q);
        in = in && deep_inside(f, q);
        for (int i = 0; i < 3; i++) {
            below[i] = below[i] && q[i] < lo[i] - NEAR_SHAPE;
            above[i] = above[i] && q[i] > hi[i] + NEAR_SHAPE;
        }
    }
    return known && (in || below[0] || below[1] || below[2] || above[0] ||
                     above[1] || above[2]);
}

static void look_at_cell(void *context, size_t index, int thread)
{
    (void)thread;
    const struct clear *c = context;
    const struct flat *f = c->flat;
    const int32_t *n = c->medium->cells;
    int cell[3] = {(int)(index % (size_t)n[0]),
                   (int)(index / (size_t)n[0] % (size_t)n[1]),
                   (int)(index / (size_t)n[0] / (size_t)n[1])};
    bool clear = true;
    for (size_t i = 0; clear && i < f->shapes_count; i++) {
        int kind = f->shapes[i].kind;
        clear = kind == SHAPE_MESH || kind == SHAPE_COMPOSITE ||
                stays_off(c, &f->shapes[i], cell);
    }
    f->cells[c->medium->cell + index].clear = clear;
}

/* Triangles by their boxes in the lattice. */
static void mark_triangle(const struct clear *c, const matrix *to_cell,
                          const flat_triangle *t)
{
    const int32_t *n = c->medium->cells;
    double lo[3] = {INFINITY, INFINITY, INFINITY};
    double hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    int first[3], last[3];
    for (int k = 0; k < 3; k++) {
        double p[3] = {(double)t->p[k].x, (double)t->p[k].y, (double)t->p[k].z},
               q[3];
        matrix_point(to_cell, p, q);
        for (int i = 0; i < 3; i++) {
            lo[i] = fmin(lo[i], q[i]);
            hi[i] = fmax(hi[i], q[i]);
        }
    }
    for (int i = 0; i < 3; i++) {
        first[i] = (int)fmax(floor(lo[i] - NEAR_CELL), 0.0);
        last[i] = (int)fmin(floor(hi[i] + NEAR_CELL), n[i] - 1.0);
    }
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++)
            for (int x = first[0]; x <= last[0]; x++)
                c->flat
                    ->cells[c->medium->cell + (uint64_t)x +
                            (uint64_t)n[0] *
                                ((uint64_t)y + (uint64_t)n[1] * (uint64_t)z)]
                    .clear = 0;
}

static void look_at_medium(const struct prepare *job, const flat_medium *m)
{
    struct clear c = {job->flat, m, matrix_identity()};
    matrix to_cell;
    for (int i = 0; i < 12; i++)
        to_cell.m[i / 4][i % 4] = (double)m->to_cell.m[i];
    size_t cells = (size_t)m->cells[0] * (size_t)m->cells[1] *
                   (size_t)m->cells[2];
    if (m->uniform || !matrix_invert(&to_cell, &c.from_cell) ||
        (double)cells * (double)job->flat->shapes_count > MOST_TESTS)
        return;
    parallel_for(job->threads, cells, look_at_cell, &c, NULL);
    for (size_t i = 0; i < job->flat->triangles_count; i++)
        mark_triangle(&c, &to_cell, &job->flat->triangles[i]);
}

void prepare_clear(const struct prepare *job)
{
    for (size_t i = 0; i < job->flat->media_count; i++)
        look_at_medium(job, &job->flat->media[i]);
}
