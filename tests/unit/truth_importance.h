/* truth_importance.h - what a path that is somewhere will still bring: how
 * truth_walk.h spreads its paths. It decides the noise of a walk and nothing
 * else: any function above 0 would do. In a slab it is the adjoint of the
 * transport equation, solved on layers and directions; around a point, that of
 * diffusion theory. */
#ifndef TESTS_UNIT_TRUTH_IMPORTANCE_H
#define TESTS_UNIT_TRUTH_IMPORTANCE_H
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include "tests/unit/truth.h"

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

enum { WALK_ANGLES = 32, WALK_SWEEPS = 60 };

struct walk_map {
    const struct walk_plan *plan;
    double reach;  /* the table's end                              */
    int layers;    /* of it, + 1 with both ends                    */
    double *due;   /* at a place: SPACE, of all directions; SLAB, by cosine
                     of arrival, before the path scatters         */
    double *ahead; /* of a flight that starts, by place and cosine */
};

/* By diffusion theory, of a path at depth or distance x, up to a factor. */
static inline double walk_diffused(const struct walk_plan *p, double x)
{
    double k = p->decay;
    if (p->space == WALK_SLAB) {
        double from = p->edge + (p->target > 0.0 ? x : p->depth - x);
        return k * from < 1e-3 ? from : sinh(k * from) / k;
    }
    double r = p->target, a = fmin(x, r), b = fmax(fmax(x, r), 0.2);
    return (k * a < 1e-3 ? 1.0 : sinh(k * a) / (k * a)) * exp(-k * b) / b;
}

/* ---- the adjoint in a slab ---------------------------------------------- */

/* Directions are the middles of even parts of the cosine. */
static inline double walk_cosine(int j)
{
    return (2.0 * j + 1.0) / WALK_ANGLES - 1.0;
}

/* Chances of Henyey and Greenstein's to turn from one into another. */
static inline void walk_turns(double g, double turn[WALK_ANGLES][WALK_ANGLES])
{
    enum { AROUND = 32 };
    for (int j = 0; j < WALK_ANGLES; j++) {
        double all = 0.0, a = walk_cosine(j);
        for (int k = 0; k < WALK_ANGLES; k++) {
            double b = walk_cosine(k), sum = 0.0;
            double s = sqrt((1.0 - a * a) * (1.0 - b * b));
            for (int i = 0; i < AROUND; i++) {
                double c = a * b + s * cos(TRUTH_PI * (i + 0.5) / AROUND);
                sum += pow(1.0 + g * g - 2.0 * g * c, -1.5);
            }
            turn[j][k] = sum;
            all += sum;
        }
        for (int k = 0; k < WALK_ANGLES; k++)
            turn[j][k] /= all;
    }
}

/* Flights in direction j, from the face they lead to back to the other. */
static inline void walk_sweep(struct walk_map *m, int j)
{
    double mu = walk_cosine(j), target = m->plan->target;
    int on = mu > 0.0 ? 1 : -1, i = on > 0 ? m->layers : 0;
    double s = m->reach / m->layers / fabs(mu), e = exp(-s);
    double even = 1.0 - e, slope = (1.0 - e * (1.0 + s)) / s;
    m->ahead[i * WALK_ANGLES + j] = (on > 0) == (target > 0.0) ? 1.0 : 0.0;
    for (int n = 0; n < m->layers; n++, i -= on) {
        int there = i * WALK_ANGLES + j, here = there - on * WALK_ANGLES;
        m->ahead[here] = e * m->ahead[there] + even * m->due[here] +
                         slope * (m->due[there] - m->due[here]);
    }
}

static inline void walk_scatter(struct walk_map *m,
                                double turn[WALK_ANGLES][WALK_ANGLES])
{
    for (int i = 0; i <= m->layers; i++) {
        const double *ahead = &m->ahead[i * WALK_ANGLES];
        for (int j = 0; j < WALK_ANGLES; j++) {
            double sum = 0.0;
            for (int k = 0; k < WALK_ANGLES; k++)
                sum += turn[j][k] * ahead[k];
            m->due[i * WALK_ANGLES + j] = (1.0 - m->plan->loss) * sum;
        }
    }
}

/* From diffusion theory on, which is right but near the faces. */
static inline void walk_solve_slab(struct walk_map *m)
{
    static double turn[WALK_ANGLES][WALK_ANGLES];
    const struct walk_plan *p = m->plan;
    double beyond = walk_diffused(p, p->target > 0.0 ? p->depth + p->edge
                                                     : -p->edge);
    size_t n = (size_t)(m->layers + 1) * WALK_ANGLES;
    for (size_t i = 0; i < n; i++)
        m->ahead[i] = walk_diffused(p, m->reach * (double)(i / WALK_ANGLES) /
                                           m->layers) /
                      beyond;
    walk_turns(p->g, turn);
    for (int i = 0; i < WALK_SWEEPS; i++) {
        walk_scatter(m, turn);
        for (int j = 0; j < WALK_ANGLES; j++)
            walk_sweep(m, j);
    }
}

/* ---- what is read of it ------------------------------------------------- */

/* Between four entries of a table by place and cosine. */
static inline double walk_between(const struct walk_map *m, const double *table,
                                  double x, double cosine)
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
static inline double walk_due(const struct walk_map *m, double x, double cosine)
{
    if (m->plan->space == WALK_SLAB)
        return walk_between(m, m->due, x, cosine);
    double y = fmin(fmax(x / m->reach, 0.0), 1.0) * m->layers;
    int i = y < m->layers ? (int)y : m->layers - 1;
    return m->due[i] + (y - i) * (m->due[i + 1] - m->due[i]);
}

/* Place of a path after a flight. */
static inline double walk_moved(const struct walk_map *m, double x,
                                double cosine, double t)
{
    return m->plan->space == WALK_SLAB
               ? x + t * cosine
               : sqrt(x * x + 2.0 * x * cosine * t + t * t);
}

/* Of a path that sets out. */
static inline double walk_ahead(const struct walk_map *m, double x,
                                double cosine)
{
    return walk_between(m, m->ahead, x, cosine);
}

/* ---- the map of a plan -------------------------------------------------- */

/* Around a point; flights by Laguerre's rule. */
static inline void walk_solve_space(struct walk_map *m)
{
    static const double node[5] = {0.263560319718, 1.413403059107,
                                   3.596425771041, 7.085810005859,
                                   12.640800844276};
    static const double weight[5] = {0.521755610583, 0.398666811083,
                                     0.0759424496817, 0.00361175867992,
                                     2.33699723858e-05};
    for (int i = 0; i <= m->layers; i++)
        m->due[i] = walk_diffused(m->plan, m->reach * i / m->layers);
    for (int i = 0; i < (m->layers + 1) * WALK_ANGLES; i++) {
        double x = m->reach * (i / WALK_ANGLES) / m->layers;
        double mu = walk_cosine(i % WALK_ANGLES);
        m->ahead[i] = 0.0;
        for (int k = 0; k < 5; k++)
            m->ahead[i] += weight[k] *
                           walk_due(m, walk_moved(m, x, mu, node[k]), mu);
    }
}

/* Kept for its next batch. */
static inline const struct walk_map *walk_map_of(const struct walk_plan *p)
{
    static struct walk_map m;
    if (m.plan == p)
        return &m;
    m.plan = p;
    m.reach = p->space == WALK_SLAB ? p->depth : fmin(60.0, p->target + 30.0);
    m.layers = (int)fmin(fmax(16.0 * m.reach, 64.0), 4096.0);
    size_t n = (size_t)(m.layers + 1) * WALK_ANGLES;
    m.due = realloc(m.due, n * sizeof *m.due);
    m.ahead = realloc(m.ahead, n * sizeof *m.ahead);
    assert_true(m.due && m.ahead);
    if (p->space == WALK_SLAB)
        walk_solve_slab(&m);
    else
        walk_solve_space(&m);
    return &m;
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

static const double walk_knot[WALK_PARTS + 1] = {
    0.0, 0.15, 0.35, 0.6, 0.9,  1.25, 1.7,     2.25,
    3.0, 4.0,  5.5,  8.0, 12.0, 20.0, INFINITY};

/* exp(-knot). */
static const double walk_beyond[WALK_PARTS + 1] = {1,
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

static inline struct walk_law walk_law_of(const struct walk_map *m, double x,
                                          double cosine)
{
    struct walk_law l = {.end = INFINITY};
    double left = 1.0;
    if (m->plan->space == WALK_SLAB)
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
static inline double walk_law_depth(const struct walk_law *l, double u)
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
static inline double walk_law_ratio(const struct walk_law *l, double tau)
{
    if (tau > l->end)
        return 0.0;
    int k = 0;
    while (k < l->parts - 1 && tau >= walk_knot[k + 1])
        k++;
    return l->due[k] / l->all;
}

#endif
