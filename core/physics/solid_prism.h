/* solid_prism.h - closed curves in x and z, swept along y: at their size, or
 * for the conic sweep at y times their size, with the apex in the origin.
 * Inside is what an odd number of curves is around.
 *
 * Data: lower and upper height, 1 if conic, 1 if open (without caps), number
 * of segments, size; segments of solid_curve.h. Three crossings a segment at
 * most and two of the caps. part is the segment, PRISM_BOTTOM or PRISM_TOP.
 * What a line meets is settled in the plane of the curves, where it is a line
 * too: a cap is met where the number of crossings before it is odd, so that
 * in and out come in turn. */
#ifndef CORE_PHYSICS_SOLID_PRISM_H
#define CORE_PHYSICS_SOLID_PRISM_H
#include "core/physics/solid_curve.h"

enum { PRISM_HEAD = 6, PRISM_BOTTOM = -1, PRISM_TOP = -2 };

/* The line between the caps, and in the plane: a x + b z + c = 0. */
typedef struct {
    solid_line l;
    double from, to;        /* between the heights                          */
    double origin;          /* where the line comes from beyond all curves  */
    double a, b, c;
    bool point;             /* it is but a point in the plane               */
    bool at_from, at_to;    /* inside there                                 */
} prism_line;

HD bool prism_inside_plane(const double *data, double x, double z)
{
    return curve_odd(data + PRISM_HEAD, (int)data[4], x, z, 0);
}

HD bool prism_inside(const double *data, dvec3 p)
{
    if (!(p.y >= data[0] && p.y <= data[1]))
        return false;
    if (data[2] == 0.0)
        return prism_inside_plane(data, p.x, p.z);
    return p.y != 0.0 && prism_inside_plane(data, p.x / p.y, p.z / p.y);
}

HD void prism_project(bool conic, prism_line *line)
{
    dvec3 p = line->l.p, d = line->l.d;
    line->origin = -INFINITY;
    line->a = -d.z;
    line->b = d.x;
    line->c = d.z * p.x - d.x * p.z;
    if (conic) {
        dvec3 n = dvec3_cross(p, d);
        line->a = n.x;
        line->b = n.z;
        line->c = n.y;
        if (d.y != 0.0)
            line->origin = -p.y / d.y;
    }
    line->point = !(line->a * line->a + line->b * line->b +
                    (conic ? line->c * line->c : 0.0) >
                    1e-24 * (conic ? dvec3_dot(p, p) : 1.0));
}

HD bool prism_line_make(const double *data, dvec3 o, dvec3 d, prism_line *line)
{
    double middle = 0.5 * (data[0] + data[1]);
    if (!solid_line_make(o, d, dvec3_make(0.0, middle, 0.0), INFINITY,
                         &line->l) || !(dvec3_dot(o, o) < INFINITY))
        return false;
    double y = line->l.p.y, dy = line->l.d.y;
    line->from = -INFINITY;
    line->to = INFINITY;
    if (dy != 0.0) {
        line->from = (data[dy > 0.0 ? 0 : 1] - y) / dy;
        line->to = (data[dy > 0.0 ? 1 : 0] - y) / dy;
    } else if (!(y >= data[0] && y <= data[1])) {
        return false;
    }
    prism_project(data[2] != 0.0, line);
    return true;
}

/* Where on the line it is at a point of the curve. */
HD double prism_along(const prism_line *line, bool conic, const double *at)
{
    dvec3 p = line->l.p, d = line->l.d;
    if (!conic)
        return ((at[0] - p.x) * d.x + (at[1] - p.z) * d.z) /
               (d.x * d.x + d.z * d.z);
    dvec3 s = dvec3_make(at[0], 1.0, at[1]), across = dvec3_cross(d, s);
    return -dvec3_dot(dvec3_cross(p, s), across) / dvec3_dot(across, across);
}

/* A crossing is one of the walls, and counts for the caps beyond it. */
HD int prism_cross(prism_line *line, double u, int segment, double *t,
                   int *part, int n, int room)
{
    bool before = u < line->origin;
    line->at_from ^= before ? line->from < u : line->from > u;
    line->at_to ^= before ? line->to < u : line->to > u;
    if (u > line->from && u < line->to)
        n = solid_insert(solid_line_t(&line->l, u), segment, t, part, n, room);
    return n;
}

HD int prism_walls(const double *data, prism_line *line, double *t, int *part,
                   int room)
{
    int n = 0, count = (int)data[4];
    line->at_from = line->at_to = false;
    if (line->point) {
        double at = line->from > -INFINITY ? 0.5 * (line->from + line->to)
                                           : 0.0;
        if (data[2] != 0.0 && line->origin == at)
            at = line->to;
        line->at_from = line->at_to =
            prism_inside(data, solid_line_at(&line->l, at));
        return 0;
    }
    for (int i = 0; i < count; i++) {
        const double *segment = data + PRISM_HEAD + CURVE_SEGMENT * i;
        double u[5], at[2];
        int found = curve_crosses(segment, line->a, line->b, line->c, u);
        for (int k = 0; k < found; k++) {
            curve_point(segment, u[k], at);
            n = prism_cross(line, prism_along(line, data[2] != 0.0, at), i, t,
                            part, n, room);
        }
    }
    return n;
}

HD int prism_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                   int room)
{
    prism_line line;
    bool open = data[3] != 0.0;
    if (!open)
        room &= ~1;
    if (!prism_line_make(data, o, d, &line))
        return 0;
    int n = prism_walls(data, &line, t, part, room);
    bool up = line.l.d.y > 0.0;
    if (!open && line.at_from)
        n = solid_insert(solid_line_t(&line.l, line.from),
                         up ? PRISM_BOTTOM : PRISM_TOP, t, part, n, room);
    if (!open && line.at_to)
        n = solid_insert(solid_line_t(&line.l, line.to),
                         up ? PRISM_TOP : PRISM_BOTTOM, t, part, n, room);
    return open ? n : n & ~1;
}

HD dvec3 prism_normal(const double *data, dvec3 p, int part)
{
    if (part < 0 || part >= (int)data[4])
        return dvec3_make(0.0, part == PRISM_BOTTOM ? -1.0 : 1.0, 0.0);
    bool conic = data[2] != 0.0;
    const double *segment = data + PRISM_HEAD + CURVE_SEGMENT * part;
    double k = conic && p.y != 0.0 ? 1.0 / p.y : 1.0, square, at[2], along[2];
    double u = curve_nearest(segment, k * p.x, k * p.z, &square);
    curve_point(segment, u, at);
    curve_tangent(segment, u, along);
    double step = 1e-6 * data[5] / sqrt(along[0] * along[0] +
                                        along[1] * along[1]);
    bool left = prism_inside_plane(data, at[0] + step * along[1],
                                   at[1] - step * along[0]);
    double side = left ? -k : k;
    return dvec3_make(side * along[1],
                      conic ? side * (at[1] * along[0] - at[0] * along[1])
                            : 0.0,
                      -side * along[0]);
}

#endif
