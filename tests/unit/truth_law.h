/* truth_law.h - what a path that is somewhere will still bring, as its steps
 * read it (truth_step.h): tables that truth_importance.h fills, and the law of
 * a flight that is drawn by them. */
#ifndef TESTS_UNIT_TRUTH_LAW_H
#define TESTS_UNIT_TRUTH_LAW_H
#include <math.h>
#include <stddef.h>
#include "core/physics/hd.h"

/* A slab from z = 0; or space around the origin. Attenuation is 1, a walker's
 * place its depth or distance, its cosine that to +z or to outward. */
enum walk_space { WALK_NOWHERE, WALK_SLAB, WALK_SPACE };

struct walk_plan {
    enum walk_space space;
    double start, cosine; /* of all walkers                               */
    double depth;         /* SLAB                                         */
    double target;        /* SLAB: 0 or the depth; SPACE: a distance      */
    double decay;         /* of importance, per length                    */
    double edge;          /* SLAB: where diffusion ends, beyond the faces */
    double g, loss;       /* of the phase function; 1 - albedo            */
    double wide;          /* share of directions that are drawn evenly    */
};

enum { WALK_ANGLES = 32 };

struct walk_map {
    struct walk_plan plan;
    double reach;  /* the table's end                              */
    int layers;    /* of it, + 1 with both ends                    */
    double *due;   /* at a place: SPACE, of all directions; SLAB, by cosine
                     of arrival, before the path scatters         */
    double *ahead; /* of a flight that starts, by place and cosine */
};

/* Room for either of its tables. */
static inline size_t walk_entries(const struct walk_map *m)
{
    return (size_t)(m->layers + 1) * WALK_ANGLES;
}

/* Directions are the middles of even parts of the cosine. */
HD double walk_cosine(int j)
{
    return (2.0 * j + 1.0) / WALK_ANGLES - 1.0;
}

/* ---- what is read of it ------------------------------------------------- */

/* Between four entries of a table by place and cosine. */
HD double walk_between(const struct walk_map *m, const double *table, double x,
                       double cosine)
{
    double y = x / m->reach * m->layers;
    double c = (cosine + 1.0) * (WALK_ANGLES / 2.0) - 0.5;
    y = y < 0.0 ? 0.0 : y > m->layers ? m->layers : y;
    c = c < 0.0 ? 0.0 : c > WALK_ANGLES - 1 ? WALK_ANGLES - 1 : c;
    int i = (int)y - (y >= m->layers), j = (int)c - (c >= WALK_ANGLES - 1);
    const double *a = &table[i * WALK_ANGLES + j], *b = a + WALK_ANGLES;
    double f = y - i, h = c - j;
    return (1.0 - f) * ((1.0 - h) * a[0] + h * a[1]) +
           f * ((1.0 - h) * b[0] + h * b[1]);
}

/* Of a path that arrives. */
HD double walk_due(const struct walk_map *m, double x, double cosine)
{
    if (m->plan.space == WALK_SLAB)
        return walk_between(m, m->due, x, cosine);
    double y = fmin(fmax(x / m->reach, 0.0), 1.0) * m->layers;
    int i = y < m->layers ? (int)y : m->layers - 1;
    return m->due[i] + (y - i) * (m->due[i + 1] - m->due[i]);
}

/* Place of a path after a flight. */
HD double walk_moved(const struct walk_map *m, double x, double cosine,
                     double t)
{
    return m->plan.space == WALK_SLAB
               ? x + t * cosine
               : sqrt(x * x + 2.0 * x * cosine * t + t * t);
}

/* Of a path that sets out in direction j of the table: as walk_ahead tells. */
HD double walk_ahead_in(const struct walk_map *m, double x, int j)
{
    double y = x / m->reach * m->layers;
    y = y < 0.0 ? 0.0 : y > m->layers ? m->layers : y;
    int i = (int)y - (y >= m->layers);
    const double *a = &m->ahead[i * WALK_ANGLES + j];
    return (1.0 - (y - i)) * a[0] + (y - i) * a[WALK_ANGLES];
}

/* Of one that sets out. */
HD double walk_ahead(const struct walk_map *m, double x, double cosine)
{
    return walk_between(m, m->ahead, x, cosine);
}

/* ---- flights ------------------------------------------------------------ */

/* The law of a flight's depth: within each of a few parts an exponential one,
 * and of a part as much as is due in its middle. */
enum { WALK_PARTS = 14 };

struct walk_law {
    int parts;
    double end;                  /* of the flight, at a slab's face        */
    double mass[WALK_PARTS];     /* of each part                           */
    double due[WALK_PARTS], all; /* what is due in it; the sum of masses   */
};

HD_TABLE(double, walk_knot,
         WALK_PARTS + 1) = {0.0, 0.15, 0.35, 0.6, 0.9,  1.25, 1.7,     2.25,
                            3.0, 4.0,  5.5,  8.0, 12.0, 20.0, INFINITY};

/* exp(-knot). */
HD_TABLE(double, walk_beyond, WALK_PARTS + 1) = {1,
                                                 0.86070797642505781,
                                                 0.70468808971871344,
                                                 0.54881163609402639,
                                                 0.40656965974059911,
                                                 0.28650479686019009,
                                                 0.18268352405273466,
                                                 0.10539922456186433,
                                                 0.049787068367863944,
                                                 0.018315638888734179,
                                                 0.0040867714384640666,
                                                 0.00033546262790251185,
                                                 6.1442123533282098e-06,
                                                 2.0611536224385579e-09,
                                                 0.0};

HD struct walk_law walk_law_of(const struct walk_map *m, double x,
                               double cosine)
{
    struct walk_law l;
    double left = 1.0;
    l.parts = 0;
    l.end = INFINITY;
    l.all = 0.0;
    if (m->plan.space == WALK_SLAB)
        l.end = fmax(cosine > 0.0 ? m->reach - x : x, 1e-6) /
                fmax(fabs(cosine), 1e-6);
    for (int k = 0; k < WALK_PARTS && walk_knot[k] < l.end; k++) {
        double to = walk_knot[k + 1] < l.end ? walk_knot[k + 1] : l.end;
        double rest = to < l.end ? walk_beyond[k + 1] : exp(-to);
        double middle = k == WALK_PARTS - 1 ? walk_knot[k] + 0.5
                                            : 0.5 * (walk_knot[k] + to);
        l.due[k] = walk_due(m, walk_moved(m, x, cosine, middle), cosine);
        l.mass[k] = l.due[k] * (left - rest);
        l.all += l.mass[k];
        l.parts = k + 1;
        left = rest;
    }
    return l;
}

/* The depth at u in (0, 1). */
HD double walk_law_depth(const struct walk_law *l, double u)
{
    double left = u * l->all;
    int k = 0;
    while (k < l->parts - 1 && left >= l->mass[k])
        left -= l->mass[k++];
    double from = walk_knot[k];
    double to = walk_knot[k + 1] < l->end ? walk_knot[k + 1] : l->end;
    double share = fmin(left / l->mass[k], 1.0 - 0x1p-50);
    double tau = from - log1p(share * expm1(from - to));
    return fmin(tau, to);
}

/* How much likelier a depth is than by the exponential law. */
HD double walk_law_ratio(const struct walk_law *l, double tau)
{
    if (tau > l->end)
        return 0.0;
    int k = 0;
    while (k < l->parts - 1 && tau >= walk_knot[k + 1])
        k++;
    return l->due[k] / l->all;
}

#endif
