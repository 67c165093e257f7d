/* solid_blob.h - where a sum of fields reaches a threshold.
 *
 * A component of strength s has the field s (1 - w)^2, w the square of the
 * distance from its centre or from its axis (a cylinder has round ends), in
 * radii and at most 1. Along a line each field is piecewise a quartic, so the
 * line is walked from one end of a piece to the next: the sum of those that
 * are there has its roots found, and the next end comes from the tree of
 * bounds in the same walk. A line costs what it passes, not what there is.
 * Four crossings a piece at most, and three pieces a component.
 *
 * Data: threshold, number of nodes, offset of the components; the nodes of
 * the tree in depth-first order (box, node after its subtree, component or
 * -1); the components (strength, length of the axis in radii, rows of the map
 * to their own space, where the radius is 1 and the axis z). */
#ifndef CORE_PHYSICS_SOLID_BLOB_H
#define CORE_PHYSICS_SOLID_BLOB_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

enum { BLOB_HEAD = 3, BLOB_NODE = 8, BLOB_COMPONENT = 14 };
enum { BLOB_BOTTOM, BLOB_MIDDLE, BLOB_TOP, BLOB_PIECES };

/* One piece of one component on a line: w = w[0] + w[1] u + w[2] u^2 from
 * `from` to `to`. */
typedef struct {
    double w[3], from, to;
} blob_piece;

/* A stretch of the line without the end of a piece, and the sum of the
 * quartics there, of s = (u - from) / (to - from). */
typedef struct {
    double from, to, c[5];
    bool empty;
} blob_stretch;

HD dvec3 blob_point(const double *component, dvec3 p)
{
    const double *m = component + 2;
    return dvec3_make(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                      m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                      m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
}

HD dvec3 blob_vector(const double *component, dvec3 v)
{
    const double *m = component + 2;
    return dvec3_make(m[0] * v.x + m[1] * v.y + m[2] * v.z,
                      m[4] * v.x + m[5] * v.y + m[6] * v.z,
                      m[8] * v.x + m[9] * v.y + m[10] * v.z);
}

/* Cuts a piece to lo <= a + u b <= hi. */
HD void blob_cut(blob_piece *piece, double a, double b, double lo, double hi)
{
    if (b == 0.0) {
        if (!(a >= lo && a <= hi))
            piece->to = piece->from;
        return;
    }
    double u = (lo - a) / b, v = (hi - a) / b;
    piece->from = fmax(piece->from, b > 0.0 ? u : v);
    piece->to = fmin(piece->to, b > 0.0 ? v : u);
}

/* False where the line misses that piece; a + u b is the line in the
 * component's own space. */
HD bool blob_piece_of(double length, dvec3 a, dvec3 b, int which,
                      blob_piece *piece)
{
    double az = which == BLOB_MIDDLE ? 0.0 : which == BLOB_TOP ? a.z - length
                                                               : a.z;
    double bz = which == BLOB_MIDDLE ? 0.0 : b.z, c[3], u[2];
    piece->w[0] = a.x * a.x + a.y * a.y + az * az;
    piece->w[1] = 2.0 * (a.x * b.x + a.y * b.y + az * bz);
    piece->w[2] = b.x * b.x + b.y * b.y + bz * bz;
    piece->from = -INFINITY;
    piece->to = INFINITY;
    if (piece->w[2] > 0.0) {
        for (int i = 0; i < 3; i++)
            c[i] = piece->w[i];
        c[0] -= 1.0;
        if (polynomial_quadratic(c, -INFINITY, INFINITY, u) != 2)
            return false;
        piece->from = u[0];
        piece->to = u[1];
    } else if (!(piece->w[0] < 1.0)) {
        return false;
    }
    if (length > 0.0)
        blob_cut(piece, a.z, b.z,
                 which == BLOB_BOTTOM ? -INFINITY
                 : which == BLOB_TOP ? length : 0.0,
                 which == BLOB_BOTTOM ? 0.0
                 : which == BLOB_TOP ? INFINITY : length);
    return piece->from < piece->to;
}

/* Adds s (1 - w)^2 on the stretch. */
HD void blob_add(double strength, const blob_piece *piece, blob_stretch *on)
{
    double h = on->to - on->from, u = on->from;
    double m0 = 1.0 - (piece->w[0] + u * (piece->w[1] + u * piece->w[2]));
    double m1 = -h * (piece->w[1] + 2.0 * u * piece->w[2]);
    double m2 = -h * h * piece->w[2];
    on->c[0] += strength * m0 * m0;
    on->c[1] += strength * 2.0 * m0 * m1;
    on->c[2] += strength * (m1 * m1 + 2.0 * m0 * m2);
    on->c[3] += strength * 2.0 * m1 * m2;
    on->c[4] += strength * m2 * m2;
    on->empty = false;
}

/* Whether the line passes the box between u = lo and u = hi. */
HD bool blob_passes(const double *box, dvec3 p, dvec3 d, double lo, double hi)
{
    const double at[3] = {p.x, p.y, p.z}, along[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; i++) {
        if (along[i] == 0.0) {
            if (at[i] < box[i] || at[i] > box[3 + i])
                return false;
            continue;
        }
        double u = (box[i] - at[i]) / along[i];
        double v = (box[3 + i] - at[i]) / along[i];
        lo = fmax(lo, fmin(u, v));
        hi = fmin(hi, fmax(u, v));
    }
    return lo <= hi;
}

/* Visits the components that the line may meet from `after` on: finds the
 * next end of a piece (nothing is summed), or, the stretch being known, sums
 * the pieces that are there. */
HD void blob_visit(const double *data, const solid_line *l, bool sum,
                   blob_stretch *on)
{
    const double *node = data + BLOB_HEAD;
    int nodes = (int)data[1];
    for (int i = 0; i < nodes;) {
        const double *n = node + BLOB_NODE * i;
        if (!blob_passes(n, l->p, l->d, on->from, on->to)) {
            i = (int)n[6];
            continue;
        }
        i++;
        if (n[7] < 0.0)
            continue;
        const double *c = data + (int)data[2] + BLOB_COMPONENT * (int)n[7];
        dvec3 a = blob_point(c, l->p), b = blob_vector(c, l->d);
        for (int k = 0; k < (c[1] > 0.0 ? BLOB_PIECES : 1); k++) {
            blob_piece piece;
            if (!blob_piece_of(c[1], a, b, k, &piece))
                continue;
            if (sum && piece.from <= on->from && piece.to > on->from)
                blob_add(c[0], &piece, on);
            if (!sum && piece.from > on->from && piece.from < on->to)
                on->to = piece.from;
            if (!sum && piece.to > on->from && piece.to < on->to)
                on->to = piece.to;
        }
    }
}

/* The stretch after `from`; false when there is none. */
HD bool blob_next(const double *data, const solid_line *l, double from,
                  blob_stretch *on)
{
    on->from = from;
    on->to = INFINITY;
    on->empty = true;
    blob_visit(data, l, false, on);
    for (int i = 0; i < 5; i++)
        on->c[i] = 0.0;
    on->c[0] = -data[0];
    if (on->to < INFINITY && from > -INFINITY)
        blob_visit(data, l, true, on);
    return on->to < INFINITY;
}

/* False where the line misses the ball around all. */
HD bool blob_line(const double *data, dvec3 o, dvec3 d, solid_line *l)
{
    const double *box = data + BLOB_HEAD;
    if (!(data[1] > 0.0))
        return false;
    dvec3 low = dvec3_make(box[0], box[1], box[2]);
    dvec3 high = dvec3_make(box[3], box[4], box[5]);
    dvec3 half = dvec3_scale(dvec3_sub(high, low), 0.5);
    return solid_line_make(o, d, dvec3_add(low, half), dvec3_length(half), l);
}

HD int blob_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                  int room)
{
    solid_line l;
    blob_stretch on;
    bool in = false;
    int n = 0;
    room &= ~1;
    if (!blob_line(data, o, d, &l))
        return 0;
    for (double u = -INFINITY; n < room && blob_next(data, &l, u, &on);
         u = on.to) {
        double s[5];
        int found = on.empty && !in ? 0
                                    : polynomial_stretch(on.c, 4, &in, s);
        for (int i = 0; i < found && n < room; i++) {
            t[n] = solid_line_t(&l, on.from + s[i] * (on.to - on.from));
            part[n++] = 0;
        }
    }
    if (in && n % 2 == 1 && n < room) {     /* rounding kept it inside      */
        t[n] = solid_line_t(&l, on.from);
        part[n++] = 0;
    }
    return n & ~1;
}

/* The field at p, and its gradient. */
HD double blob_field(const double *data, dvec3 p, dvec3 *gradient)
{
    const double *node = data + BLOB_HEAD;
    int nodes = (int)data[1];
    double sum = 0.0;
    *gradient = dvec3_make(0.0, 0.0, 0.0);
    for (int i = 0; i < nodes;) {
        const double *n = node + BLOB_NODE * i;
        if (!(p.x >= n[0] && p.y >= n[1] && p.z >= n[2] && p.x <= n[3] &&
              p.y <= n[4] && p.z <= n[5])) {
            i = (int)n[6];
            continue;
        }
        i++;
        if (n[7] < 0.0)
            continue;
        const double *c = data + (int)data[2] + BLOB_COMPONENT * (int)n[7];
        const double *m = c + 2;
        dvec3 q = blob_point(c, p);
        q.z -= fmin(fmax(q.z, 0.0), c[1]);
        double rest = 1.0 - dvec3_dot(q, q), k = -4.0 * c[0] * rest;
        if (!(rest > 0.0))
            continue;
        sum += c[0] * rest * rest;
        gradient->x += k * (m[0] * q.x + m[4] * q.y + m[8] * q.z);
        gradient->y += k * (m[1] * q.x + m[5] * q.y + m[9] * q.z);
        gradient->z += k * (m[2] * q.x + m[6] * q.y + m[10] * q.z);
    }
    return sum;
}

HD dvec3 blob_normal(const double *data, dvec3 p, int part)
{
    dvec3 gradient;
    (void)part;
    blob_field(data, p, &gradient);
    return dvec3_scale(gradient, -1.0);
}

HD bool blob_inside(const double *data, dvec3 p)
{
    dvec3 gradient;
    return blob_field(data, p, &gradient) >= data[0];
}

#endif
