/* solid_sphere_sweep.h - all balls whose centre C and radius r follow a
 * spline.
 *
 * Data: number of segments, ball around all (centre, radius); a segment is
 * SWEEP_SEGMENT numbers: the coefficients of x, y, z and r as polynomials of u
 * from 0 to 1, and a ball around it. A line is in the ball of u from
 * b - sqrt(D) to b + sqrt(D), b = (C - p) . d, D = r^2 - |C - p - b d|^2: where
 * D >= 0 without a gap the balls' intervals make one, from the least start to
 * the greatest end. The intervals of all segments are joined, so that there is
 * no surface within. Six crossings a segment at most; part is the segment. */
#ifndef CORE_PHYSICS_SOLID_SPHERE_SWEEP_H
#define CORE_PHYSICS_SOLID_SPHERE_SWEEP_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

enum { SWEEP_HEAD = 5, SWEEP_SEGMENT = 20, SWEEP_RADIUS = 12,
       SWEEP_BALL = 16 };

/* A segment along a line: b, D, and the u at which the ends of the ball's
 * interval may turn. */
typedef struct {
    double b[4], D[7], turns[15];
    int count;              /* of turns                                     */
} sweep_line;

/* Adds k a b, of degrees 3 each or less, to the sum. */
HD void sweep_add(const double *a, int a_degree, const double *b,
                  int b_degree, double k, double *sum)
{
    for (int i = 0; i <= a_degree; i++)
        for (int j = 0; j <= b_degree; j++)
            sum[i + j] += k * a[i] * b[j];
}

/* b +- sqrt(D) turn where 4 b'^2 D = D'^2; and, as both may turn at once, a
 * double root that is none by its signs, where D' = 0. */
HD void sweep_turns(sweep_line *s)
{
    double slope_b[3], slope_D[6], square[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    double both[11];
    polynomial_derivative(s->b, 3, 1, slope_b);
    polynomial_derivative(s->D, 6, 1, slope_D);
    for (int i = 0; i < 11; i++)
        both[i] = 0.0;
    sweep_add(slope_b, 2, slope_b, 2, 4.0, square);
    sweep_add(square, 4, s->D, 6, 1.0, both);
    sweep_add(slope_D, 5, slope_D, 5, -1.0, both);
    s->count = polynomial_roots(both, 10, 0.0, 1.0, s->turns);
    s->count += polynomial_roots(slope_D, 5, 0.0, 1.0, s->turns + s->count);
}

HD void sweep_line_make(const double *segment, const solid_line *l,
                        sweep_line *s)
{
    const double p[3] = {l->p.x, l->p.y, l->p.z};
    const double d[3] = {l->d.x, l->d.y, l->d.z};
    double off[3][4];
    for (int i = 0; i < 4; i++) {
        s->b[i] = 0.0;
        for (int k = 0; k < 3; k++) {
            off[k][i] = segment[4 * k + i] - (i == 0 ? p[k] : 0.0);
            s->b[i] += off[k][i] * d[k];
        }
        for (int k = 0; k < 3; k++)
            off[k][i] -= s->b[i] * d[k];
    }
    s->count = -1;
    for (int i = 0; i < 7; i++)
        s->D[i] = 0.0;
    sweep_add(segment + SWEEP_RADIUS, 3, segment + SWEEP_RADIUS, 3, 1.0, s->D);
    for (int k = 0; k < 3; k++)
        sweep_add(off[k], 3, off[k], 3, -1.0, s->D);
}

/* Widens lo, hi by the interval of the ball at u. */
HD void sweep_widen(const sweep_line *s, double u, double *lo, double *hi)
{
    double b = polynomial_value(s->b, 3, u);
    double root = sqrt(fmax(polynomial_value(s->D, 6, u), 0.0));
    *lo = fmin(*lo, b - root);
    *hi = fmax(*hi, b + root);
}

/* Joins an interval with those of t, which lie apart and ascend. */
HD int sweep_join(double lo, double hi, int piece, double *t, int *part,
                  int n, int room)
{
    int first = 0, lo_piece = piece, hi_piece = piece;
    while (first < n && t[first + 1] < lo)
        first += 2;
    int last = first;
    for (; last < n && t[last] <= hi; last += 2) {
        if (t[last] < lo) {
            lo = t[last];
            lo_piece = part[last];
        }
        if (t[last + 1] > hi) {
            hi = t[last + 1];
            hi_piece = part[last + 1];
        }
    }
    if (first == last && first + 2 > room)
        return n;
    if (first == last && n + 2 > room)
        n -= 2;
    int shift = 2 - (last - first);
    if (shift > 0)
        for (int i = n - 1; i >= last; i--) {
            t[i + shift] = t[i];
            part[i + shift] = part[i];
        }
    else
        for (int i = last; shift < 0 && i < n; i++) {
            t[i + shift] = t[i];
            part[i + shift] = part[i];
        }
    t[first] = lo;
    t[first + 1] = hi;
    part[first] = lo_piece;
    part[first + 1] = hi_piece;
    return n + shift;
}

HD int sweep_segment_roots(const double *segment, int index,
                           const solid_line *l, double *t, int *part, int n,
                           int room)
{
    sweep_line s;
    double ends[6];
    sweep_line_make(segment, l, &s);
    int count = polynomial_roots(s.D, 6, 0.0, 1.0, ends);
    bool in = s.D[0] >= 0.0;
    double from = 0.0;
    for (int i = 0; i <= count; i++) {
        double to = i < count ? ends[i] : 1.0, lo = INFINITY, hi = -INFINITY;
        if (in) {
            if (s.count < 0)
                sweep_turns(&s);
            sweep_widen(&s, from, &lo, &hi);
            sweep_widen(&s, to, &lo, &hi);
            for (int k = 0; k < s.count; k++)
                if (s.turns[k] > from && s.turns[k] < to)
                    sweep_widen(&s, s.turns[k], &lo, &hi);
            n = sweep_join(solid_line_t(l, lo), solid_line_t(l, hi), index, t,
                           part, n, room);
        }
        in = !in;
        from = to;
    }
    return n;
}

HD bool sweep_line_near(const double *ball, dvec3 p, dvec3 d)
{
    dvec3 off = dvec3_cross(
        dvec3_sub(dvec3_make(ball[0], ball[1], ball[2]), p), d);
    return dvec3_dot(off, off) <= ball[3] * ball[3];
}

HD int sphere_sweep_roots(const double *data, dvec3 o, dvec3 d, double *t,
                          int *part, int room)
{
    solid_line l;
    int n = 0, count = (int)data[0];
    room &= ~1;
    if (!solid_line_make(o, d, dvec3_make(data[1], data[2], data[3]), data[4],
                         &l))
        return 0;
    for (int i = 0; i < count; i++) {
        const double *segment = data + SWEEP_HEAD + SWEEP_SEGMENT * i;
        if (sweep_line_near(segment + SWEEP_BALL, l.p, l.d))
            n = sweep_segment_roots(segment, i, &l, t, part, n, room);
    }
    return n;
}

HD dvec3 sweep_centre(const double *segment, double u)
{
    return dvec3_make(polynomial_value(segment, 3, u),
                      polynomial_value(segment + 4, 3, u),
                      polynomial_value(segment + 8, 3, u));
}

/* The u of the ball that holds p deepest; *over is |C - p|^2 - r^2. */
HD double sweep_deepest(const double *segment, dvec3 p, double *over)
{
    double f[7] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, slope[6], u[5];
    double off[4], best = 0.0;
    const double at[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 4; i++)
            off[i] = segment[4 * k + i] - (i == 0 ? at[k] : 0.0);
        sweep_add(off, 3, off, 3, 1.0, f);
    }
    sweep_add(segment + SWEEP_RADIUS, 3, segment + SWEEP_RADIUS, 3, -1.0, f);
    polynomial_derivative(f, 6, 1, slope);
    int n = polynomial_roots(slope, 5, 0.0, 1.0, u);
    *over = f[0];
    for (int i = 0; i <= n; i++) {
        double here = i < n ? u[i] : 1.0, value = polynomial_value(f, 6, here);
        if (value < *over) {
            *over = value;
            best = here;
        }
    }
    return best;
}

HD dvec3 sphere_sweep_normal(const double *data, dvec3 p, int part)
{
    double over;
    const double *segment = data + SWEEP_HEAD + SWEEP_SEGMENT * part;
    double u = sweep_deepest(segment, p, &over);
    return dvec3_sub(p, sweep_centre(segment, u));
}

HD bool sphere_sweep_inside(const double *data, dvec3 p)
{
    int count = (int)data[0];
    for (int i = 0; i < count; i++) {
        const double *segment = data + SWEEP_HEAD + SWEEP_SEGMENT * i;
        const double *ball = segment + SWEEP_BALL;
        dvec3 off = dvec3_sub(p, dvec3_make(ball[0], ball[1], ball[2]));
        double over = INFINITY;
        if (dvec3_dot(off, off) <= ball[3] * ball[3])
            sweep_deepest(segment, p, &over);
        if (over <= 0.0)
            return true;
    }
    return false;
}

#endif
