/* Height fields as meshes. */
#include <math.h>
#include "core/surfaces.h"

struct field {
    const struct brume_shape *shape;
    struct mesh *mesh;
    uint32_t columns, rows;
    double water;
    bool closed;
    struct brume_error *err;
};

static double height(const struct field *f, uint32_t column, uint32_t row)
{
    return f->shape->data[(size_t)row * f->columns + column];
}

static void corner_point(const struct field *f, uint32_t column, uint32_t row,
                         double p[3])
{
    p[0] = (double)column / (f->columns - 1);
    p[1] = height(f, column, row);
    p[2] = 1.0 - (double)row / (f->rows - 1);
}

/* From the slopes between the neighbours. */
static void corner_normal(const struct field *f, uint32_t column, uint32_t row,
                          float n[3])
{
    uint32_t left = column > 0 ? column - 1 : 0;
    uint32_t right = column + 1 < f->columns ? column + 1 : column;
    uint32_t up = row > 0 ? row - 1 : 0;
    uint32_t down = row + 1 < f->rows ? row + 1 : row;
    double dx = (height(f, right, row) - height(f, left, row)) *
                (f->columns - 1) / (right - left);
    double dz = (height(f, column, up) - height(f, column, down)) *
                (f->rows - 1) / (down - up);
    n[0] = (float)-dx;
    n[1] = 1.0f;
    n[2] = (float)-dz;
}

static bool add_corners(const struct field *f)
{
    for (uint32_t row = 0; row < f->rows; row++)
        for (uint32_t column = 0; column < f->columns; column++) {
            double p[3];
            float n[3];
            corner_point(f, column, row, p);
            corner_normal(f, column, row, n);
            if (!mesh_add_vertex(f->mesh, p, f->err) ||
                (f->shape->smooth && !mesh_add_normal(f->mesh, n, f->err)))
                return false;
        }
    return true;
}

static bool add_triangle(const struct field *f, uint32_t a, uint32_t b,
                         uint32_t c, bool smooth)
{
    const uint32_t corner[3] = {a, b, c};
    const uint32_t *normal = f->shape->smooth && smooth ? corner : NULL;
    return mesh_add_triangle(f->mesh, corner, normal, NULL, f->err);
}

/* Where the edge from a to b meets the water, the same from both sides; its
 * normal too. A new corner, or UINT32_MAX with err set. */
static uint32_t cut_edge(const struct field *f, uint32_t a, uint32_t b)
{
    struct mesh *m = f->mesh;
    if (a > b) {
        uint32_t swap = a;
        a = b;
        b = swap;
    }
    double ya = m->position[a][1], yb = m->position[b][1], p[3];
    double w = (f->water - ya) / (yb - ya);
    float n[3];
    for (int k = 0; k < 3; k++)
        p[k] = m->position[a][k] + w * (m->position[b][k] - m->position[a][k]);
    p[1] = f->water;
    if (!mesh_add_vertex(m, p, f->err))
        return UINT32_MAX;
    if (f->shape->smooth) {
        for (int k = 0; k < 3; k++)
            n[k] = (float)((1.0 - w) * (double)m->normal[a][k] +
                           w * (double)m->normal[b][k]);
        if (!mesh_add_normal(m, n, f->err))
            return UINT32_MAX;
    }
    return (uint32_t)m->vertices - 1;
}

/* The part of a triangle above the water, or that below it. */
static bool add_cut(const struct field *f, const uint32_t corner[3], bool above)
{
    uint32_t out[4];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        uint32_t a = corner[i], b = corner[(i + 1) % 3];
        bool in_a = (f->mesh->position[a][1] >= f->water) == above;
        bool in_b = (f->mesh->position[b][1] >= f->water) == above;
        if (in_a)
            out[count++] = a;
        if (in_a != in_b && (out[count++] = cut_edge(f, a, b)) == UINT32_MAX)
            return false;
    }
    return count < 3 ||
           (add_triangle(f, out[0], out[1], out[2], true) &&
            (count < 4 || add_triangle(f, out[0], out[2], out[3], true)));
}

/* Cells are halved from where z is least to where x is, as POV-Ray does. */
static bool add_cells(const struct field *f, bool above)
{
    for (uint32_t row = 0; row + 1 < f->rows; row++)
        for (uint32_t column = 0; column + 1 < f->columns; column++) {
            uint32_t far = row * f->columns + column, near = far + f->columns;
            uint32_t a[3] = {near, far, near + 1};
            uint32_t b[3] = {near + 1, far, far + 1};
            if (!add_cut(f, a, above) || !add_cut(f, b, above))
                return false;
        }
    return true;
}

/* ---- what closes it ---------------------------------------------------- */

/* A wall below the edge between two corners, and its part of the floor. */
static bool add_wall(const struct field *f, uint32_t a, uint32_t b,
                     uint32_t middle)
{
    struct mesh *m = f->mesh;
    const uint32_t top[2] = {a, b};
    uint32_t low[2];
    for (int i = 0; i < 2; i++) {
        double p[3] = {m->position[top[i]][0], 0.0, m->position[top[i]][2]};
        low[i] = (uint32_t)m->vertices;
        if (!mesh_add_vertex(m, p, f->err))
            return false;
    }
    return add_triangle(f, a, b, low[0], false) &&
           add_triangle(f, b, low[1], low[0], false) &&
           add_triangle(f, low[0], low[1], middle, false);
}

static bool add_walls(const struct field *f)
{
    const double centre[3] = {0.5, 0.0, 0.5};
    uint32_t middle = (uint32_t)f->mesh->vertices;
    uint32_t last = (f->rows - 1) * f->columns, right = f->columns - 1;
    if (!mesh_add_vertex(f->mesh, centre, f->err))
        return false;
    for (uint32_t i = 0; i + 1 < f->columns; i++)
        if (!add_wall(f, i + 1, i, middle) ||
            !add_wall(f, last + i, last + i + 1, middle))
            return false;
    for (uint32_t i = 0; i + 1 < f->rows; i++) {
        uint32_t here = i * f->columns, next = here + f->columns;
        if (!add_wall(f, here, next, middle) ||
            !add_wall(f, next + right, here + right, middle))
            return false;
    }
    return true;
}

static bool fill(const struct field *f, size_t *seen)
{
    if (!add_corners(f) || !add_cells(f, true))
        return false;
    *seen = f->mesh->triangles;
    return !f->closed || (add_cells(f, false) && add_walls(f));
}

struct mesh *surface_heights(const struct brume_shape *s, bool closed,
                             size_t *seen, struct brume_error *err)
{
    struct field f = {.shape = s,
                      .mesh = mesh_new(err),
                      .columns = (uint32_t)s->steps[0],
                      .rows = (uint32_t)s->steps[1],
                      .water = s->radius,
                      .closed = closed,
                      .err = err};
    if (!f.mesh)
        return NULL;
    if (fill(&f, seen)) {
        mesh_mend(f.mesh);
        return f.mesh;
    }
    mesh_free(f.mesh);
    return NULL;
}
