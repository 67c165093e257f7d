/* solid_isosurface.h - where a function is a threshold, within a container.
 *
 * The function is the caller's, who has the loop:
 *
 *     isosurface_walk w;
 *     isosurface_start(data, o, d, -INFINITY, INFINITY, t, part, room, &w);
 *     while (w.asks)
 *         isosurface_tell(&w, value of the function at w.p);
 *
 * leaves w.count roots, as X_roots of solid.h does. An interval whose ends
 * have one sign holds no root if the function, by max_gradient, can't reach
 * zero and come back in it, or if it is shorter than the accuracy; else it is
 * halved, from left to right. Crossings are as many as the line has accuracies
 * at most; after ISOSURFACE_ASKED values no more are sought. Inside is what is
 * less than the threshold; where it meets the container there is a crossing
 * of the container, if it is not open. max_trace is no limit: all are found.
 *
 * Data: container (0 box, 1 sphere), its corners or its centre and radius (6),
 * threshold, accuracy, max_gradient, 1 if open, 1 if the gradient adapts, its
 * three factors, and a number for the caller, who may keep there which
 * function it is. */
#ifndef CORE_PHYSICS_SOLID_ISOSURFACE_H
#define CORE_PHYSICS_SOLID_ISOSURFACE_H
#include "core/physics/bracket.h"
#include "core/physics/solid.h"

enum { ISOSURFACE_CONTAINER = 1, ISOSURFACE_THRESHOLD = 7,
       ISOSURFACE_ACCURACY = 8, ISOSURFACE_GRADIENT = 9, ISOSURFACE_OPEN = 10,
       ISOSURFACE_ADAPTS = 11, ISOSURFACE_FACTORS = 12,
       ISOSURFACE_FUNCTION = 15, ISOSURFACE_DATA = 16 };
enum { ISOSURFACE_DEPTH = 48, ISOSURFACE_ASKED = 2000000 };

/* part: 0 the surface, +-1 to 3 a face of the box, ISOSURFACE_BALL; a line's
 * end that is the caller's is none of them. */
enum { ISOSURFACE_SURFACE = 0, ISOSURFACE_BALL = 4, ISOSURFACE_CUT = 5 };
enum { ISOSURFACE_FIRST, ISOSURFACE_LAST, ISOSURFACE_HALF, ISOSURFACE_REFINE };

typedef struct {
    bool asks;
    dvec3 p;                /* where                                        */
    int count;              /* roots                                        */
    double steepest;        /* slope that was met, for advice               */
    const double *data;
    solid_line l;
    double *t;
    int *part, room, phase, asked;
    int from_part, to_part;
    double u, a, f;         /* asked; left end of what is left, its value   */
    double end[ISOSURFACE_DEPTH], value[ISOSURFACE_DEPTH];
    int depth;              /* right ends, the nearest one last             */
    double gradient, slope;
    bracket root;
    bool in;
} isosurface_walk;

HD void isosurface_ask(isosurface_walk *w, double u, int phase)
{
    w->u = u;
    w->p = solid_line_at(&w->l, u);
    w->phase = phase;
    w->asks = true;
}

HD void isosurface_found(isosurface_walk *w, double u, int piece)
{
    w->in = !w->in;
    if (piece == ISOSURFACE_CUT || w->count >= w->room)
        return;
    w->t[w->count] = solid_line_t(&w->l, u);
    w->part[w->count++] = piece;
}

HD bool isosurface_slab(double p, double d, double lo, double hi, int axis,
                        isosurface_walk *w)
{
    if (d == 0.0)
        return p >= lo && p <= hi;
    double a = ((d > 0.0 ? lo : hi) - p) / d, b = ((d > 0.0 ? hi : lo) - p) / d;
    if (a > w->a) {
        w->a = a;
        w->from_part = d > 0.0 ? -axis : axis;
    }
    if (b < w->end[0]) {
        w->end[0] = b;
        w->to_part = d > 0.0 ? axis : -axis;
    }
    return w->a < w->end[0];
}

/* The line in the container: from w->a to w->end[0]. */
HD bool isosurface_contain(const double *data, dvec3 o, dvec3 d,
                           isosurface_walk *w)
{
    const double *c = data + ISOSURFACE_CONTAINER;
    bool ball = data[0] != 0.0;
    dvec3 low = dvec3_make(c[0], c[1], c[2]);
    dvec3 high = dvec3_make(c[3], c[4], c[5]);
    dvec3 middle = ball ? low
                        : dvec3_scale(dvec3_add(low, high), 0.5);
    double radius = ball ? c[3] : dvec3_length(dvec3_sub(high, middle));
    if (!solid_line_make(o, d, middle, radius, &w->l))
        return false;
    w->a = -w->l.half;
    w->end[0] = w->l.half;
    w->from_part = w->to_part = ISOSURFACE_BALL;
    if (ball)
        return w->a < w->end[0];
    dvec3 p = w->l.p, v = w->l.d;
    return isosurface_slab(p.x, v.x, low.x, high.x, 1, w) &&
           isosurface_slab(p.y, v.y, low.y, high.y, 2, w) &&
           isosurface_slab(p.z, v.z, low.z, high.z, 3, w);
}

/* Roots are sought for t from lo to hi; if these cut the container's interval
 * their number may be odd. */
HD void isosurface_start(const double *data, dvec3 o, dvec3 d, double lo,
                         double hi, double *t, int *part, int room,
                         isosurface_walk *w)
{
    w->asks = w->in = false;
    w->count = w->asked = 0;
    w->data = data;
    w->t = t;
    w->part = part;
    w->room = room & ~1;
    w->depth = 1;
    w->steepest = 0.0;
    w->gradient = data[ISOSURFACE_ADAPTS] != 0.0 ? data[ISOSURFACE_FACTORS]
                                                 : data[ISOSURFACE_GRADIENT];
    if (!isosurface_contain(data, o, d, w) || w->room == 0)
        return;
    double from = (lo - w->l.shift) / w->l.per;
    double to = (hi - w->l.shift) / w->l.per;
    if (from > w->a) {
        w->a = from;
        w->from_part = ISOSURFACE_CUT;
    }
    if (to < w->end[0]) {
        w->end[0] = to;
        w->to_part = ISOSURFACE_CUT;
    }
    if (w->a < w->end[0])
        isosurface_ask(w, w->a, ISOSURFACE_FIRST);
}

/* The greatest slope is over-estimated where a greater one is met, and wears
 * off where slopes are less, but not below the first factor. */
HD void isosurface_adapt(isosurface_walk *w, double slope)
{
    const double *factors = w->data + ISOSURFACE_FACTORS;
    if (slope > w->steepest)
        w->steepest = slope;
    if (w->data[ISOSURFACE_ADAPTS] == 0.0)
        return;
    if (slope > w->gradient)
        w->gradient = slope * factors[1];
    else
        w->gradient = fmax(factors[0], slope + factors[2] *
                                               (w->gradient - slope));
}

/* All is found: what is still inside ends at the container. */
HD void isosurface_finish(isosurface_walk *w)
{
    w->asks = false;
    if (w->in && w->data[ISOSURFACE_OPEN] == 0.0)
        isosurface_found(w, w->end[0], w->to_part);
}

/* Drops intervals without roots; asks for the middle of the first that may
 * have one, or for a root. */
HD void isosurface_seek(isosurface_walk *w)
{
    double accuracy = w->data[ISOSURFACE_ACCURACY];
    for (; w->depth > 0 && w->count < w->room; w->depth--) {
        double b = w->end[w->depth - 1], f = w->value[w->depth - 1];
        double wide = b - w->a;
        bool fine = !(wide > accuracy) || w->depth == ISOSURFACE_DEPTH ||
                    w->asked > ISOSURFACE_ASKED;
        isosurface_adapt(w, fabs(f - w->f) / wide);
        if ((f < 0.0) != (w->f < 0.0)) {
            if (!fine) {
                isosurface_ask(w, w->a + 0.5 * wide, ISOSURFACE_HALF);
                return;
            }
            w->root = bracket_make(w->a, b, !(f < 0.0));
            w->root.least = fmax(w->root.least, 1e-4 * accuracy);
            w->slope = (f - w->f) / wide;
            isosurface_ask(w, w->root.t, ISOSURFACE_REFINE);
            return;
        }
        if (!fine && !(fabs(f) + fabs(w->f) > w->gradient * wide)) {
            isosurface_ask(w, w->a + 0.5 * wide, ISOSURFACE_HALF);
            return;
        }
        w->a = b;
        w->f = f;
    }
    isosurface_finish(w);
}

/* A step towards a root by the slope of its interval. */
HD void isosurface_refine(isosurface_walk *w, double f)
{
    if (bracket_step(&w->root, f, w->slope)) {
        isosurface_ask(w, w->root.t, ISOSURFACE_REFINE);
        return;
    }
    isosurface_found(w, w->root.t, ISOSURFACE_SURFACE);
    w->depth--;
    w->a = w->end[w->depth];
    w->f = w->value[w->depth];
    isosurface_seek(w);
}

/* Takes the function's value at w->p. */
HD void isosurface_tell(isosurface_walk *w, double value)
{
    double f = value - w->data[ISOSURFACE_THRESHOLD];
    w->asked++;
    switch (w->phase) {
    case ISOSURFACE_FIRST:
        w->f = f;
        if (f < 0.0 && w->data[ISOSURFACE_OPEN] == 0.0)
            isosurface_found(w, w->a, w->from_part);
        isosurface_ask(w, w->end[0], ISOSURFACE_LAST);
        return;
    case ISOSURFACE_LAST:
        w->value[0] = f;
        isosurface_seek(w);
        return;
    case ISOSURFACE_HALF:
        w->end[w->depth] = w->u;
        w->value[w->depth++] = f;
        isosurface_seek(w);
        return;
    default:
        isosurface_refine(w, f);
        return;
    }
}

HD bool isosurface_contains(const double *data, dvec3 p)
{
    const double *c = data + ISOSURFACE_CONTAINER;
    dvec3 off = dvec3_sub(p, dvec3_make(c[0], c[1], c[2]));
    if (data[0] != 0.0)
        return dvec3_dot(off, off) <= c[3] * c[3];
    return off.x >= 0.0 && off.y >= 0.0 && off.z >= 0.0 && p.x <= c[3] &&
           p.y <= c[4] && p.z <= c[5];
}

/* Inside, given the function's value at p. */
HD bool isosurface_inside_of(const double *data, dvec3 p, double value)
{
    return value < data[ISOSURFACE_THRESHOLD] && isosurface_contains(data, p);
}

/* A normal needs the function at six points, k from 0 to 5: two to each side,
 * the accuracy away. */
HD dvec3 isosurface_beside(const double *data, dvec3 p, int k)
{
    double step = k % 2 ? data[ISOSURFACE_ACCURACY]
                        : -data[ISOSURFACE_ACCURACY];
    return dvec3_make(k / 2 == 0 ? p.x + step : p.x,
                      k / 2 == 1 ? p.y + step : p.y,
                      k / 2 == 2 ? p.z + step : p.z);
}

/* Outward, not of unit length, given those values; they are not read for a
 * piece of the container. */
HD dvec3 isosurface_normal_of(const double *data, dvec3 p, int part,
                              const double value[6])
{
    const double *c = data + ISOSURFACE_CONTAINER;
    double side = part < 0 ? -1.0 : 1.0;
    int axis = part < 0 ? -part : part;
    if (part == ISOSURFACE_BALL)
        return dvec3_sub(p, dvec3_make(c[0], c[1], c[2]));
    if (part != ISOSURFACE_SURFACE)
        return dvec3_make(axis == 1 ? side : 0.0, axis == 2 ? side : 0.0,
                          axis == 3 ? side : 0.0);
    return dvec3_make(value[1] - value[0], value[3] - value[2],
                      value[5] - value[4]);
}

#endif
