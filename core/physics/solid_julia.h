/* solid_julia.h - where h -> f(h) + c, begun at a point of a slice through
 * four dimensions, stays within a radius: 4, for quaternions 1 + |c|.
 *
 * Data: 1 if hypercomplex, function, iterations, step, the radius, which is
 * that of the ball that is searched too; c (4); x, y, z and constant part of
 * the slice's fourth coordinate (4); exponent of pwr (2).
 *
 * A hypercomplex number a + b i + c j + d k (ij = k, kk = 1) is the pair of
 * complex ones (a - d) + (b + c) i and (a + d) + (b - c) i, on which sums,
 * products and so all functions act one by one; of quaternions there are the
 * square and the cube. A line is stepped along, and each change between in
 * and out is found by bisection. Steps are 1/2 precision, for quaternions
 * longer where the derivative says how far the surface is at least; what is
 * thinner than a step can be missed, and crossings are as many as there are
 * steps at most. part is JULIA_BALL where the ball cuts the solid. */
#ifndef CORE_PHYSICS_SOLID_JULIA_H
#define CORE_PHYSICS_SOLID_JULIA_H
#include "core/physics/complex.h"
#include "core/physics/solid.h"

enum { JULIA_SQR, JULIA_CUBE, JULIA_EXP, JULIA_RECIPROCAL, JULIA_SIN,
       JULIA_ASIN, JULIA_SINH, JULIA_ASINH, JULIA_COS, JULIA_ACOS,
       JULIA_COSH, JULIA_ACOSH, JULIA_TAN, JULIA_ATAN, JULIA_TANH,
       JULIA_ATANH, JULIA_LN, JULIA_PWR };
enum { JULIA_SURFACE, JULIA_BALL };
enum { JULIA_HEAD = 5, JULIA_SLICE = 9, JULIA_POWER = 13 };
enum { JULIA_STEPS = 200000 };

/* A number and its derivatives by x, y and z. */
typedef struct {
    double h[4], by[3][4];
} julia_point;

HD double julia_norm(const double h[4])
{
    return h[0] * h[0] + h[1] * h[1] + h[2] * h[2] + h[3] * h[3];
}

/* f(z), and its derivative. */
HD cplx julia_function(int function, cplx power, cplx z, cplx *slope)
{
    cplx one = cplx_make(1.0, 0.0), f, g;
    switch (function) {
    case JULIA_SQR:
        *slope = cplx_add(z, z);
        return cplx_mul(z, z);
    case JULIA_CUBE:
        f = cplx_mul(z, z);
        *slope = cplx_make(3.0 * f.re, 3.0 * f.im);
        return cplx_mul(f, z);
    case JULIA_EXP:
        return *slope = cplx_exp(z);
    case JULIA_RECIPROCAL:
        f = cplx_div(one, z);
        *slope = cplx_sub(cplx_make(0.0, 0.0), cplx_mul(f, f));
        return f;
    case JULIA_SIN:
        *slope = cplx_cos(z);
        return cplx_sin(z);
    case JULIA_ASIN:
        *slope = cplx_div(one, cplx_sqrt(cplx_sub(one, cplx_mul(z, z))));
        return cplx_back(cplx_asinh(cplx_turn(z)));
    case JULIA_SINH:
        *slope = cplx_cos(cplx_turn(z));
        return cplx_back(cplx_sin(cplx_turn(z)));
    case JULIA_ASINH:
        *slope = cplx_div(one, cplx_sqrt(cplx_add(one, cplx_mul(z, z))));
        return cplx_asinh(z);
    case JULIA_COS:
        f = cplx_sin(z);
        *slope = cplx_make(-f.re, -f.im);
        return cplx_cos(z);
    case JULIA_ACOS:
        f = cplx_div(one, cplx_sqrt(cplx_sub(one, cplx_mul(z, z))));
        *slope = cplx_make(-f.re, -f.im);
        return cplx_back(cplx_acosh(z));
    case JULIA_COSH:
        *slope = cplx_back(cplx_sin(cplx_turn(z)));
        return cplx_cos(cplx_turn(z));
    case JULIA_ACOSH:
        *slope = cplx_div(one, cplx_sqrt(cplx_sub(cplx_mul(z, z), one)));
        return cplx_acosh(z);
    case JULIA_TAN:
        f = cplx_div(cplx_sin(z), cplx_cos(z));
        *slope = cplx_add(one, cplx_mul(f, f));
        return f;
    case JULIA_ATAN:
        *slope = cplx_div(one, cplx_add(one, cplx_mul(z, z)));
        return cplx_back(cplx_atanh(cplx_turn(z)));
    case JULIA_TANH:
        g = cplx_turn(z);
        f = cplx_back(cplx_div(cplx_sin(g), cplx_cos(g)));
        *slope = cplx_sub(one, cplx_mul(f, f));
        return f;
    case JULIA_ATANH:
        *slope = cplx_div(one, cplx_sub(one, cplx_mul(z, z)));
        return cplx_atanh(z);
    case JULIA_LN:
        *slope = cplx_div(one, z);
        return cplx_log(z);
    default:
        f = cplx_exp(cplx_mul(power, cplx_log(z)));
        *slope = cplx_mul(power, cplx_div(f, z));
        return f;
    }
}

/* The pair of complex numbers; halves of sums lead back. */
HD void julia_split(const double h[4], cplx pair[2])
{
    pair[0] = cplx_make(h[0] - h[3], h[1] + h[2]);
    pair[1] = cplx_make(h[0] + h[3], h[1] - h[2]);
}

HD void julia_join(const cplx pair[2], double h[4])
{
    h[0] = 0.5 * (pair[1].re + pair[0].re);
    h[1] = 0.5 * (pair[0].im + pair[1].im);
    h[2] = 0.5 * (pair[0].im - pair[1].im);
    h[3] = 0.5 * (pair[1].re - pair[0].re);
}

/* Of each derivative along with the value, if `by` is asked for. */
HD void julia_hypercomplex(const double *data, bool by, julia_point *p)
{
    cplx pair[2], slope[2], v[2];
    cplx power = cplx_make(data[JULIA_POWER], data[JULIA_POWER + 1]);
    julia_split(p->h, pair);
    for (int i = 0; i < 2; i++)
        pair[i] = julia_function((int)data[1], power, pair[i], &slope[i]);
    julia_join(pair, p->h);
    for (int k = 0; by && k < 3; k++) {
        julia_split(p->by[k], v);
        v[0] = cplx_mul(v[0], slope[0]);
        v[1] = cplx_mul(v[1], slope[1]);
        julia_join(v, p->by[k]);
    }
}

/* With h = a + m, m^2 = -s: h^2 = a^2 - s + 2 a m, h^3 = a (a^2 - 3 s) +
 * (3 a^2 - s) m, and what follows of v = b + n, s' = 2 m . n. */
HD void julia_quaternion(const double *data, bool by, julia_point *p)
{
    double a = p->h[0], *m = p->h + 1;
    double s = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    bool cube = (int)data[1] == JULIA_CUBE;
    double k = cube ? 3.0 * a * a - s : 2.0 * a;
    for (int i = 0; by && i < 3; i++) {
        double b = p->by[i][0], *n = p->by[i] + 1;
        double ds = 2.0 * (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]);
        double dk = cube ? 6.0 * a * b - ds : 2.0 * b;
        p->by[i][0] = cube ? b * (3.0 * a * a - 3.0 * s) - 3.0 * a * ds
                           : 2.0 * a * b - ds;
        for (int j = 0; j < 3; j++)
            n[j] = dk * m[j] + k * n[j];
    }
    p->h[0] = cube ? a * (a * a - 3.0 * s) : a * a - s;
    for (int j = 0; j < 3; j++)
        m[j] *= k;
}

HD void julia_start(const double *data, dvec3 at, julia_point *p)
{
    const double *slice = data + JULIA_SLICE;
    p->h[0] = at.x;
    p->h[1] = at.y;
    p->h[2] = at.z;
    p->h[3] = slice[0] * at.x + slice[1] * at.y + slice[2] * at.z + slice[3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            p->by[i][j] = i == j ? 1.0 : 0.0;
        p->by[i][3] = slice[i];
    }
}

HD void julia_iterate(const double *data, bool by, julia_point *p)
{
    if (data[0] != 0.0)
        julia_hypercomplex(data, by, p);
    else
        julia_quaternion(data, by, p);
    for (int j = 0; j < 4; j++)
        p->h[j] += data[JULIA_HEAD + j];
}

/* Whether the point stays within `limit`, a squared radius, and else the
 * number that left it, with its derivatives. What is not finite has left. */
HD bool julia_stays(const double *data, dvec3 at, double limit, bool by,
                    julia_point *p)
{
    int most = (int)data[2];
    julia_start(data, at, p);
    for (int i = 1; i < most; i++) {
        if (!(julia_norm(p->h) <= limit))
            return false;
        julia_iterate(data, by, p);
    }
    return julia_norm(p->h) <= limit;
}

/* A step that leads past no surface: of an outer point, less than the way to
 * where |h| is the radius, as ln |h| of an analytic function is flat enough. */
HD double julia_reach(const double *data, dvec3 at, bool *in)
{
    julia_point p;
    bool by = data[0] == 0.0;
    *in = julia_stays(data, at, data[4] * data[4], by, &p);
    if (*in || !by)
        return data[3];
    double norm = julia_norm(p.h), steep = 0.0;
    for (int i = 0; i < 3; i++)
        steep += julia_norm(p.by[i]);
    double reach = 0.25 * log(norm / (data[4] * data[4])) * sqrt(norm / steep);
    return reach > data[3] ? reach : data[3];
}

/* Where in and out part, between two points of the line. */
HD double julia_part(const double *data, const solid_line *l, double a,
                     double b, bool in_at_b)
{
    julia_point p;
    double limit = data[4] * data[4];
    for (int i = 0; i < 60; i++) {
        double u = 0.5 * (a + b);
        if (u <= a || u >= b)
            break;
        if (julia_stays(data, solid_line_at(l, u), limit, false, &p) == in_at_b)
            b = u;
        else
            a = u;
    }
    return 0.5 * (a + b);
}

HD int julia_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                   int room)
{
    solid_line l;
    bool was = false, in = false;
    int n = 0;
    room &= ~1;
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.0, 0.0), data[4], &l))
        return 0;
    double before = -l.half, u = before;
    for (int i = 0; i < JULIA_STEPS && n < room; i++) {
        double step = julia_reach(data, solid_line_at(&l, u), &in);
        if (in != was) {
            t[n] = solid_line_t(&l, i ? julia_part(data, &l, before, u, in)
                                      : u);
            part[n++] = i ? JULIA_SURFACE : JULIA_BALL;
        }
        was = in;
        before = u;
        if (u >= l.half)
            break;
        u = u + step < l.half ? u + step : l.half;
    }
    if (n % 2 == 1) {
        t[n] = solid_line_t(&l, l.half);
        part[n++] = JULIA_BALL;
    }
    return n;
}

/* Half the gradient of |h|^2 in the slice. */
HD dvec3 julia_gradient(const julia_point *p)
{
    double by[3];
    for (int i = 0; i < 3; i++) {
        by[i] = 0.0;
        for (int k = 0; k < 4; k++)
            by[i] += p->h[k] * p->by[i][k];
    }
    return dvec3_make(by[0], by[1], by[2]);
}

/* At a right angle to the surface is the gradient for the number that leaves.
 * For squares and cubes POV-Ray takes the last number, one after those that
 * are tested, which is smoother; so it is taken here unless it points in. */
HD dvec3 julia_normal(const double *data, dvec3 p, int part)
{
    julia_point j;
    int most = (int)data[2];
    dvec3 leaving = dvec3_make(0.0, 0.0, 0.0), last;
    bool left = false;
    if (part == JULIA_BALL)
        return p;
    julia_start(data, p, &j);
    for (int i = 0; i < most; i++) {
        if (!left && !(julia_norm(j.h) <= (1.0 - 1e-5) * data[4] * data[4])) {
            leaving = julia_gradient(&j);
            left = true;
        }
        julia_iterate(data, true, &j);
    }
    last = julia_gradient(&j);
    bool smooth = (int)data[1] <= JULIA_CUBE &&
                  dvec3_dot(last, leaving) > 0.0;
    return smooth || !left ? last : leaving;
}

HD bool julia_inside(const double *data, dvec3 p)
{
    julia_point j;
    return dvec3_dot(p, p) <= data[4] * data[4] &&
           julia_stays(data, p, data[4] * data[4], false, &j);
}

#endif
