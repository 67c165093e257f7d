/* Parametric surfaces as meshes: a grid of u and v whose lines are as near as
 * the surface bends, cut at the container. */
#include <math.h>
#include <stdlib.h>
#include "core/surfaces.h"
#include "lib/memory.h"

/* Cells to begin with, along u as along v; the most lines, and passes. */
enum { FIRST_CELLS = 16, MAX_LINES = 1025, MAX_PASSES = 12 };
/* A cell that the container cuts has 3 corners, and one more for each cut. */
enum { MAX_CORNERS = 3 + 6 };

struct corner {
    double p[3];
    float n[3];
};

struct grid_lines {
    double at[MAX_LINES];
    size_t count;
};

struct sheet {
    const struct brume_shape *shape;
    surface_point *point;
    void *context;
    struct grid_lines u, v;
    struct corner *corners; /* of the grid, u running first             */
    uint32_t *index;        /* in the mesh; MESH_NONE: not there yet    */
    struct mesh *mesh;
};

static bool finite3(const double p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

static void sheet_point(const struct sheet *s, double u, double v, double p[3])
{
    s->point(s->context, u, v, p);
}

/* ---- where the lines are */

/* Whether the middle of a cell's edge lies off its chord. */
static bool edge_bends(const struct sheet *s, double u0, double v0, double u1,
                       double v1)
{
    double a[3], b[3], m[3], off = 0;

    sheet_point(s, u0, v0, a);
    sheet_point(s, u1, v1, b);
    sheet_point(s, (u0 + u1) / 2, (v0 + v1) / 2, m);
    for (int i = 0; i < 3; i++) {
        double d = m[i] - (a[i] + b[i]) / 2;
        off += d * d;
    }
    return off > s->shape->accuracy * s->shape->accuracy;
}

/* Splits the stretches along u (or v) that bend at any line across. */
static bool split_lines(const struct sheet *s, bool along_u,
                        struct grid_lines *out)
{
    const struct grid_lines *along = along_u ? &s->u : &s->v;
    const struct grid_lines *across = along_u ? &s->v : &s->u;
    size_t room = MAX_LINES - along->count;

    out->count = 0;
    for (size_t i = 0; i + 1 < along->count; i++) {
        double a = along->at[i], b = along->at[i + 1];
        bool bends = false;
        for (size_t k = 0; !bends && room > 0 && k < across->count; k++) {
            double c = across->at[k];
            bends = along_u ? edge_bends(s, a, c, b, c)
                            : edge_bends(s, c, a, c, b);
        }
        out->at[out->count++] = a;
        if (!bends)
            continue;
        out->at[out->count++] = (a + b) / 2;
        room--;
    }
    out->at[out->count++] = along->at[along->count - 1];
    return out->count > along->count;
}

static void first_lines(double from, double to, struct grid_lines *lines)
{
    lines->count = FIRST_CELLS + 1;
    for (int i = 0; i <= FIRST_CELLS; i++)
        lines->at[i] = from + (to - from) * i / FIRST_CELLS;
}

static void refine_lines(struct sheet *s, struct grid_lines *scratch)
{
    bool more = true;

    for (int pass = 0; more && pass < MAX_PASSES; pass++) {
        more = split_lines(s, true, scratch);
        s->u = *scratch;
        more |= split_lines(s, false, scratch);
        s->v = *scratch;
    }
}

/* ---- what is at their crossings */

static void cross_of(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] -
                 a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* A part of the range further, but not beyond it. */
static double inward(double x, double part, double from, double to)
{
    double lo = fmin(from, to), hi = fmax(from, to);

    return fmin(fmax(x + part * (to - from), lo), hi);
}

/* The derivatives' cross product, as POV-Ray's trace gives it; at a pole, of
 * a place nearby. */
static void sheet_normal(const struct sheet *s, double u, double v, float n[3])
{
    const double *r = s->shape->data;
    double length = 0, cross[3];

    for (int try = 0; try < 2 && !(length > 0 && isfinite(length)); try++) {
        double p[4][3], du[3], dv[3], h = 1e-5;
        u += try * 1e-3 * ((r[0] + r[2]) / 2 - u);
        v += try * 1e-3 * ((r[1] + r[3]) / 2 - v);
        sheet_point(s, inward(u, -h, r[0], r[2]), v, p[0]);
        sheet_point(s, inward(u, h, r[0], r[2]), v, p[1]);
        sheet_point(s, u, inward(v, -h, r[1], r[3]), p[2]);
        sheet_point(s, u, inward(v, h, r[1], r[3]), p[3]);
        for (int i = 0; i < 3; i++) {
            du[i] = (p[1][i] - p[0][i]) / h;
            dv[i] = (p[3][i] - p[2][i]) / h;
        }
        cross_of(du, dv, cross);
        length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] +
                      cross[2] * cross[2]);
        /* What is left of differences at a pole is rounding. */
        double scale = 0;
        for (int i = 0; i < 3; i++)
            scale = fmax(scale, fmax(fabs(du[i]), fabs(dv[i])));
        if (!(length > 1e-6 * scale * scale))
            length = 0;
    }
    for (int i = 0; i < 3; i++)
        n[i] = length > 0 ? (float)(cross[i] / length) : 0.0f;
}

static bool fill_corners(struct sheet *s, struct brume_error *err)
{
    size_t count = s->u.count * s->v.count;

    s->corners = memory_new(count, sizeof *s->corners, err);
    s->index = memory_new(count, sizeof *s->index, err);
    if (!s->corners || !s->index)
        return false;
    for (size_t i = 0; i < count; i++) {
        double u = s->u.at[i % s->u.count], v = s->v.at[i / s->u.count];
        sheet_point(s, u, v, s->corners[i].p);
        sheet_normal(s, u, v, s->corners[i].n);
        s->index[i] = MESH_NONE;
    }
    return true;
}

/* ---- the container */

/* Negative within side k of the container: a sphere has one, a box six. */
static double beyond(const struct brume_shape *c, int k, const double p[3])
{
    if (c->contained == BRUME_CONTAINED_SPHERE) {
        double sum = -c->radius * c->radius;
        for (int i = 0; i < 3; i++)
            sum += (p[i] - c->a[i]) * (p[i] - c->a[i]);
        return sum;
    }
    int axis = k / 2;
    double lo = fmin(c->a[axis], c->b[axis]), hi = fmax(c->a[axis], c->b[axis]);
    return k % 2 ? p[axis] - hi : lo - p[axis];
}

static int container_sides(const struct brume_shape *c)
{
    return c->contained == BRUME_CONTAINED_SPHERE ? 1 : 6;
}

/* Where the edge from a, within, to b, beyond, passes the side. */
static struct corner edge_cut(const struct brume_shape *c, int side,
                              const struct corner *a, const struct corner *b)
{
    struct corner out = *a;
    double lo = 0, hi = 1;

    for (int step = 0; step < 50; step++) {
        double t = (lo + hi) / 2;
        for (int i = 0; i < 3; i++)
            out.p[i] = a->p[i] + t * (b->p[i] - a->p[i]);
        *(beyond(c, side, out.p) <= 0 ? &lo : &hi) = t;
    }
    for (int i = 0; i < 3; i++)
        out.n[i] = a->n[i] + (float)lo * (b->n[i] - a->n[i]);
    return out;
}

/* Cuts a convex polygon at one side; the corners that are left. */
static int polygon_cut(const struct brume_shape *c, int side,
                       struct corner *polygon, int count)
{
    struct corner out[MAX_CORNERS];
    int n = 0;

    for (int i = 0; i < count; i++) {
        const struct corner *a = &polygon[i], *b = &polygon[(i + 1) % count];
        bool in = beyond(c, side, a->p) <= 0;
        bool next_in = beyond(c, side, b->p) <= 0;
        if (in && n < MAX_CORNERS)
            out[n++] = *a;
        if (in != next_in && n < MAX_CORNERS)
            out[n++] = in ? edge_cut(c, side, a, b) : edge_cut(c, side, b, a);
    }
    for (int i = 0; i < n; i++)
        polygon[i] = out[i];
    return n;
}

/* ---- triangles */

static bool add_corner(struct mesh *m, const struct corner *c, uint32_t *index,
                       struct brume_error *err)
{
    *index = (uint32_t)m->vertices;
    return mesh_add_vertex(m, c->p, err) && mesh_add_normal(m, c->n, err);
}

/* Of a triangle within: corners that are shared. */
static bool add_whole(struct sheet *s, const size_t at[3],
                      struct brume_error *err)
{
    uint32_t corner[3];

    for (int i = 0; i < 3; i++) {
        uint32_t *index = &s->index[at[i]];
        if (*index == MESH_NONE &&
            !add_corner(s->mesh, &s->corners[at[i]], index, err))
            return false;
        corner[i] = *index;
    }
    return mesh_add_triangle(s->mesh, corner, corner, NULL, err);
}

static bool add_triangle(struct sheet *s, const size_t at[3],
                         struct brume_error *err)
{
    struct corner polygon[MAX_CORNERS];
    int count = 3;
    bool whole = true;

    for (int i = 0; i < 3; i++) {
        polygon[i] = s->corners[at[i]];
        if (!finite3(polygon[i].p))
            return true;
        for (int k = 0; k < container_sides(s->shape); k++)
            whole &= beyond(s->shape, k, polygon[i].p) <= 0;
    }
    if (whole)
        return add_whole(s, at, err);
    for (int k = 0; count > 0 && k < container_sides(s->shape); k++)
        count = polygon_cut(s->shape, k, polygon, count);
    uint32_t index[MAX_CORNERS];
    for (int i = 0; i < count; i++)
        if (!add_corner(s->mesh, &polygon[i], &index[i], err))
            return false;
    for (int i = 2; i < count; i++) {
        const uint32_t corner[3] = {index[0], index[i - 1], index[i]};
        if (!mesh_add_triangle(s->mesh, corner, corner, NULL, err))
            return false;
    }
    return true;
}

static bool add_cells(struct sheet *s, struct brume_error *err)
{
    for (size_t j = 0; j + 1 < s->v.count; j++)
        for (size_t i = 0; i + 1 < s->u.count; i++) {
            size_t first = j * s->u.count + i, next = first + s->u.count;
            const size_t a[3] = {first, first + 1, next};
            const size_t b[3] = {first + 1, next + 1, next};
            if (!add_triangle(s, a, err) || !add_triangle(s, b, err))
                return false;
        }
    return true;
}

static bool parametric_check(const struct brume_shape *shape,
                             struct brume_error *err)
{
    const double *r = shape->data;

    if (!(shape->accuracy > 0) || !isfinite(shape->accuracy))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "parametric surface of accuracy %g; expected a "
                          "number above 0",
                          shape->accuracy);
    if (isfinite(r[2] - r[0]) && isfinite(r[3] - r[1]) && r[0] != r[2] &&
        r[1] != r[3])
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "parametric surface from <%g, %g> to <%g, %g>; expected "
                      "a range of u and one of v",
                      r[0], r[1], r[2], r[3]);
}

struct mesh *surface_parametric(const struct brume_shape *shape,
                                surface_point *point, void *context,
                                struct brume_error *err)
{
    if (!parametric_check(shape, err))
        return NULL;
    struct sheet *s = memory_new(1, sizeof *s, err);
    struct grid_lines *scratch = memory_new(1, sizeof *scratch, err);
    struct mesh *mesh = s && scratch ? mesh_new(err) : NULL;
    bool good = mesh != NULL;
    if (good) {
        s->shape = shape;
        s->point = point;
        s->context = context;
        s->mesh = mesh;
        first_lines(shape->data[0], shape->data[2], &s->u);
        first_lines(shape->data[1], shape->data[3], &s->v);
        refine_lines(s, scratch);
        good = fill_corners(s, err) && add_cells(s, err);
    }
    if (good)
        mesh_mend(mesh);
    else
        mesh_free(mesh);
    if (s) {
        free(s->corners);
        free(s->index);
    }
    free(scratch);
    free(s);
    return good ? mesh : NULL;
}
