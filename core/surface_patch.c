/* Bicubic patches as meshes. */
#include <math.h>
#include "core/surfaces.h"

enum { SIDE = 4, MAX_STEPS = 8 };

/* Bernstein's polynomials of degree 3 and their derivatives. */
static void bernstein(double t, double b[SIDE], double d[SIDE])
{
    double s = 1.0 - t;
    b[0] = s * s * s;
    b[1] = 3.0 * s * s * t;
    b[2] = 3.0 * s * t * t;
    b[3] = t * t * t;
    d[0] = -3.0 * s * s;
    d[1] = 3.0 * s * (s - 2.0 * t);
    d[2] = 3.0 * t * (2.0 * s - t);
    d[3] = 3.0 * t * t;
}

static void weigh(const double *points, const double u[SIDE],
                  const double v[SIDE], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        for (int i = 0; i < SIDE * SIDE; i++)
            out[k] += u[i % SIDE] * v[i / SIDE] * points[3 * i + k];
    }
}

/* At an edge that is a point the derivative across is taken nearby. */
static void patch_normal(const double *points, double u, double v,
                         float normal[3])
{
    double n[3] = {0, 0, 0}, length = 0.0;
    for (int try = 0; try < 2 && !(length > 0.0); try++) {
        double bu[SIDE], bv[SIDE], du[SIDE], dv[SIDE], a[3], b[3];
        bernstein(u, bu, du);
        bernstein(v, bv, dv);
        weigh(points, du, bv, a);
        weigh(points, bu, dv, b);
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            n[i] = b[j] * a[k] - b[k] * a[j];
        }
        length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        u += (0.5 - u) * 1e-4;
        v += (0.5 - v) * 1e-4;
    }
    for (int i = 0; i < 3; i++)
        normal[i] = length > 0.0 ? (float)(n[i] / length) : 0.0f;
}

/* How far the control points of one direction lie from its chords. */
static double patch_bend(const double *points, int step, int across)
{
    double most = 0.0;
    for (int line = 0; line < SIDE; line++)
        for (int i = 1; i < SIDE - 1; i++) {
            double off = 0.0;
            for (int k = 0; k < 3; k++) {
                const double *p = points + 3 * line * across + k;
                double on = p[0] + (p[9 * step] - p[0]) * i / 3.0;
                off += (p[3 * i * step] - on) * (p[3 * i * step] - on);
            }
            most = fmax(most, sqrt(off));
        }
    return most;
}

/* Each halving leaves a quarter of the bend. */
static int patch_steps(double bend, double flatness, int most)
{
    int steps = 0;
    most = most < MAX_STEPS ? most : MAX_STEPS;
    while (steps < most && bend > flatness) {
        bend *= 0.25;
        steps++;
    }
    return steps;
}

static bool add_corner(struct mesh *m, const double *points, double u, double v,
                       struct brume_error *err)
{
    double bu[SIDE], bv[SIDE], unused[SIDE], p[3];
    float n[3];
    bernstein(u, bu, unused);
    bernstein(v, bv, unused);
    weigh(points, bu, bv, p);
    patch_normal(points, u, v, n);
    return mesh_add_vertex(m, p, err) && mesh_add_normal(m, n, err);
}

static bool add_cell(struct mesh *m, uint32_t first, uint32_t row,
                     struct brume_error *err)
{
    uint32_t a[3] = {first, first + row, first + 1};
    uint32_t b[3] = {first + 1, first + row, first + row + 1};
    return mesh_add_triangle(m, a, a, NULL, err) &&
           mesh_add_triangle(m, b, b, NULL, err);
}

static bool fill(struct mesh *m, const double *points, uint32_t nu, uint32_t nv,
                 struct brume_error *err)
{
    for (uint32_t j = 0; j <= nv; j++)
        for (uint32_t i = 0; i <= nu; i++)
            if (!add_corner(m, points, (double)i / nu, (double)j / nv, err))
                return false;
    for (uint32_t j = 0; j < nv; j++)
        for (uint32_t i = 0; i < nu; i++)
            if (!add_cell(m, j * (nu + 1) + i, nu + 1, err))
                return false;
    return true;
}

struct mesh *surface_patch(const struct brume_shape *s, struct brume_error *err)
{
    double u = patch_bend(s->data, 1, SIDE), v = patch_bend(s->data, SIDE, 1);
    uint32_t nu = 1u << patch_steps(u, s->accuracy, s->steps[0]);
    uint32_t nv = 1u << patch_steps(v, s->accuracy, s->steps[1]);
    struct mesh *m = mesh_new(err);
    if (!m)
        return NULL;
    if (fill(m, s->data, nu, nv, err)) {
        mesh_mend(m);
        return m;
    }
    mesh_free(m);
    return NULL;
}
