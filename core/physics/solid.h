/* solid.h - what the further primitives share: their line, and their roots.
 *
 * Each solid_X.h is a primitive in its own space, in double:
 *
 *   int X_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
 *               int room)
 *       where the line o + t d crosses the surface, at any sign of t,
 *       ascending; d need not be of unit length. part[i] names the piece of
 *       surface. Of a closed solid the crossings lead in and out in turn, and
 *       their number is even. Where there are more than `room`, the nearest
 *       to t = -infinity are kept, an even number of them.
 *   dvec3 X_normal(const double *data, dvec3 p, int part)
 *       outward at a point of the surface, not of unit length
 *   bool X_inside(const double *data, dvec3 p)
 *
 * `data` is made by core/solid.h. A direction of no length, or what is not
 * finite, crosses nothing. */
#ifndef CORE_PHYSICS_SOLID_H
#define CORE_PHYSICS_SOLID_H
#include "core/physics/dvec.h"

/* Unbounded solids are looked for within this distance of the point of the
 * line that is nearest to their origin, as POV-Ray does from the eye. */
#define SOLID_FAR 1e7

/* A line reckoned from the point nearest to the solid's middle, so that roots
 * are as good from afar: t = shift + u per, u the distance from p along d. */
typedef struct {
    dvec3 p, d;             /* d is of unit length                          */
    double shift, per;
    double half;            /* |u| within the bounding ball                 */
} solid_line;

/* False where the line misses the ball around `middle`. */
HD bool solid_line_make(dvec3 o, dvec3 d, dvec3 middle, double radius,
                        solid_line *line)
{
    double length = dvec3_length(d);
    if (!(length > 0.0 && length < INFINITY))
        return false;
    line->per = 1.0 / length;
    line->d = dvec3_scale(d, line->per);
    double along = dvec3_dot(dvec3_sub(middle, o), line->d);
    line->p = dvec3_mad(o, along, line->d);
    line->shift = along * line->per;
    dvec3 off = dvec3_sub(line->p, middle);
    double over = radius * radius - dvec3_dot(off, off);
    line->half = over > 0.0 ? sqrt(over) : 0.0;
    return over >= 0.0;
}

HD dvec3 solid_line_at(const solid_line *line, double u)
{
    return dvec3_mad(line->p, u, line->d);
}

HD double solid_line_t(const solid_line *line, double u)
{
    return line->shift + u * line->per;
}

/* Puts a root in its place among the n that are there; of more than `room`
 * the last falls out. The new count. */
HD int solid_insert(double root, int piece, double *t, int *part, int n,
                    int room)
{
    int i = n < room ? n : room - 1;
    if (room < 1 || (n == room && !(root < t[i])))
        return n;
    for (; i > 0 && root < t[i - 1]; i--) {
        t[i] = t[i - 1];
        part[i] = part[i - 1];
    }
    t[i] = root;
    part[i] = piece;
    return n < room ? n + 1 : n;
}

#endif
