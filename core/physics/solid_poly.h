/* solid_poly.h - a polynomial in x, y and z of order 2 to 35, negative
 * inside.
 *
 * Data: the order, then the coefficients in POV-Ray's order: by falling power
 * of x, in it by falling power of y, in it of z. As many crossings as the
 * order at most. */
#ifndef CORE_PHYSICS_SOLID_POLY_H
#define CORE_PHYSICS_SOLID_POLY_H
#include "core/physics/polynomial.h"
#include "core/physics/solid.h"

/* q (of the degree) times a + b t, plus r (of degree + 1). */
HD void poly_horner(double *q, int degree, double a, double b,
                    const double *r)
{
    double below = 0.0;
    for (int i = 0; i <= degree; i++) {
        double here = q[i];
        q[i] = here * a + below * b + r[i];
        below = here;
    }
    q[degree + 1] = below * b + r[degree + 1];
}

/* The polynomial along p + t d: coefficients of t. With `bound`, the sum of
 * the magnitudes that each is made of. */
HD void poly_along(const double *data, dvec3 p, dvec3 d, bool bound,
                   double *q)
{
    int order = (int)data[0];
    const double *next = data + 1;
    double in_y[POLYNOMIAL_MAX + 1], in_z[POLYNOMIAL_MAX + 1];
    double constant[POLYNOMIAL_MAX + 1];
    if (bound) {
        p = dvec3_make(fabs(p.x), fabs(p.y), fabs(p.z));
        d = dvec3_make(fabs(d.x), fabs(d.y), fabs(d.z));
    }
    for (int i = 0; i <= order; i++)
        constant[i] = 0.0;
    for (int i = 0; i <= order; i++) {              /* order - i: power of x */
        for (int j = 0; j <= i; j++) {
            for (int k = 0; k <= j; k++) {
                constant[0] = bound ? fabs(*next) : *next;
                next++;
                if (k == 0)
                    in_z[0] = constant[0];
                else
                    poly_horner(in_z, k - 1, p.z, d.z, constant);
            }
            if (j == 0)
                in_y[0] = in_z[0];
            else
                poly_horner(in_y, j - 1, p.y, d.y, in_z);
        }
        if (i == 0)
            q[0] = in_y[0];
        else
            poly_horner(q, i - 1, p.x, d.x, in_y);
    }
}

/* The degree along the line: coefficients that are the rounding of what
 * cancels don't count. */
HD int poly_degree(const double *data, dvec3 p, dvec3 d, double *q)
{
    double bound[POLYNOMIAL_MAX + 1], most = 0.0;
    int order = (int)data[0];
    for (int i = 0; i < order; i++)
        most = fmax(most, fabs(q[i]));
    if (fabs(q[order]) > 1e-9 * most)
        return order;
    poly_along(data, p, d, true, bound);
    while (order > 0 && !(fabs(q[order]) > 1e-14 * bound[order]))
        order--;
    return order;
}

HD int poly_roots(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                  int room)
{
    double q[POLYNOMIAL_MAX + 1], u[POLYNOMIAL_MAX];
    solid_line l;
    if (!solid_line_make(o, d, dvec3_make(0.0, 0.0, 0.0), INFINITY, &l))
        return 0;
    poly_along(data, l.p, l.d, false, q);
    int degree = poly_degree(data, l.p, l.d, q);
    int n = polynomial_roots(q, degree, -SOLID_FAR, SOLID_FAR, u);
    for (int i = 0; i < n && i < room; i++) {
        t[i] = solid_line_t(&l, u[i]);
        part[i] = 0;
    }
    return n < room ? n : room;
}

/* Value and gradient: Horner's scheme with its derivatives. */
HD double poly_gradient(const double *data, dvec3 p, dvec3 *gradient)
{
    int order = (int)data[0];
    const double *next = data + 1;
    double f = 0.0, fx = 0.0, fy = 0.0, fz = 0.0;
    for (int i = 0; i <= order; i++) {
        double g = 0.0, gy = 0.0, gz = 0.0;
        for (int j = 0; j <= i; j++) {
            double h = 0.0, hz = 0.0;
            for (int k = 0; k <= j; k++) {
                hz = hz * p.z + h;
                h = h * p.z + *next++;
            }
            gz = gz * p.y + hz;
            gy = gy * p.y + g;
            g = g * p.y + h;
        }
        fz = fz * p.x + gz;
        fy = fy * p.x + gy;
        fx = fx * p.x + f;
        f = f * p.x + g;
    }
    *gradient = dvec3_make(fx, fy, fz);
    return f;
}

HD dvec3 poly_normal(const double *data, dvec3 p, int part)
{
    dvec3 gradient;
    (void)part;
    poly_gradient(data, p, &gradient);
    return gradient;
}

HD bool poly_inside(const double *data, dvec3 p)
{
    dvec3 gradient;
    return poly_gradient(data, p, &gradient) <= 0.0;
}

#endif
