/* truth_importance.h - what a path that is somewhere will still bring: how
 * truth_walk.h spreads its paths. It decides the noise of a walk and nothing
 * else: any function above 0 would do. In a slab it is the adjoint of the
 * transport equation, solved on layers and directions; around a point, that of
 * diffusion theory. */
#ifndef TESTS_UNIT_TRUTH_IMPORTANCE_H
#define TESTS_UNIT_TRUTH_IMPORTANCE_H
#include <stdlib.h>
#include <string.h>
#include "tests/unit/truth.h"
#include "tests/unit/truth_law.h"

enum { WALK_SWEEPS = 60 };

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
    double mu = walk_cosine(j), target = m->plan.target;
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
            m->due[i * WALK_ANGLES + j] = (1.0 - m->plan.loss) * sum;
        }
    }
}

/* From diffusion theory on, which is right but near the faces. */
static inline void walk_solve_slab(struct walk_map *m)
{
    static double turn[WALK_ANGLES][WALK_ANGLES];
    const struct walk_plan *p = &m->plan;
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
        m->due[i] = walk_diffused(&m->plan, m->reach * i / m->layers);
    for (int i = 0; i < (m->layers + 1) * WALK_ANGLES; i++) {
        double x = m->reach * (i / WALK_ANGLES) / m->layers;
        double mu = walk_cosine(i % WALK_ANGLES);
        m->ahead[i] = 0.0;
        for (int k = 0; k < 5; k++)
            m->ahead[i] += weight[k] *
                           walk_due(m, walk_moved(m, x, mu, node[k]), mu);
    }
}

/* Kept while plans ask for the same, but for the direction of a start. */
static inline const struct walk_map *walk_map_of(const struct walk_plan *p)
{
    static struct walk_map m;
    struct walk_plan plan = *p;
    plan.cosine = 0.0;
    if (memcmp(&m.plan, &plan, sizeof plan) == 0)
        return &m;
    m.plan = plan;
    m.reach = p->space == WALK_SLAB ? p->depth : fmin(60.0, p->target + 30.0);
    m.layers = (int)fmin(fmax(16.0 * m.reach, 64.0), 4096.0);
    m.due = realloc(m.due, walk_entries(&m) * sizeof *m.due);
    m.ahead = realloc(m.ahead, walk_entries(&m) * sizeof *m.ahead);
    assert_true(m.due && m.ahead);
    if (p->space == WALK_SLAB)
        walk_solve_slab(&m);
    else
        walk_solve_space(&m);
    return &m;
}

#endif
