/* complex.h - complex numbers in double, principal branches, for host and
 * device code alike. */
#ifndef CORE_PHYSICS_COMPLEX_H
#define CORE_PHYSICS_COMPLEX_H
#include <math.h>
#include "core/physics/hd.h"

typedef struct {
    double re, im;
} cplx;

HD cplx cplx_make(double re, double im)
{
    cplx z;
    z.re = re;
    z.im = im;
    return z;
}

HD cplx cplx_add(cplx a, cplx b)
{
    return cplx_make(a.re + b.re, a.im + b.im);
}

HD cplx cplx_sub(cplx a, cplx b)
{
    return cplx_make(a.re - b.re, a.im - b.im);
}

HD cplx cplx_mul(cplx a, cplx b)
{
    return cplx_make(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

HD cplx cplx_div(cplx a, cplx b)
{
    double n = b.re * b.re + b.im * b.im;
    return cplx_make((a.re * b.re + a.im * b.im) / n,
                     (a.im * b.re - a.re * b.im) / n);
}

HD double cplx_norm(cplx z)
{
    return z.re * z.re + z.im * z.im;
}

HD cplx cplx_exp(cplx z)
{
    double r = exp(z.re);
    return cplx_make(r * cos(z.im), r * sin(z.im));
}

HD cplx cplx_log(cplx z)
{
    return cplx_make(0.5 * log(cplx_norm(z)), atan2(z.im, z.re));
}

HD cplx cplx_sqrt(cplx z)
{
    double r = sqrt(cplx_norm(z));
    double re = sqrt(fmax(0.5 * (r + z.re), 0.0));
    double im = sqrt(fmax(0.5 * (r - z.re), 0.0));
    return cplx_make(re, z.im < 0.0 ? -im : im);
}

/* i z */
HD cplx cplx_turn(cplx z)
{
    return cplx_make(-z.im, z.re);
}

/* -i z */
HD cplx cplx_back(cplx z)
{
    return cplx_make(z.im, -z.re);
}

HD cplx cplx_sin(cplx z)
{
    return cplx_make(sin(z.re) * cosh(z.im), cos(z.re) * sinh(z.im));
}

HD cplx cplx_cos(cplx z)
{
    return cplx_make(cos(z.re) * cosh(z.im), -sin(z.re) * sinh(z.im));
}

/* ln(z + sqrt(z^2 + 1)) */
HD cplx cplx_asinh(cplx z)
{
    cplx square = cplx_mul(z, z);
    square.re += 1.0;
    return cplx_log(cplx_add(z, cplx_sqrt(square)));
}

/* ln(z + sqrt(z^2 - 1)) */
HD cplx cplx_acosh(cplx z)
{
    cplx square = cplx_mul(z, z);
    square.re -= 1.0;
    return cplx_log(cplx_add(z, cplx_sqrt(square)));
}

/* ln((1 + z) / (1 - z)) / 2 */
HD cplx cplx_atanh(cplx z)
{
    cplx one = cplx_make(1.0, 0.0);
    cplx w = cplx_log(cplx_div(cplx_add(one, z), cplx_sub(one, z)));
    return cplx_make(0.5 * w.re, 0.5 * w.im);
}

#endif
