/* pattern_fractal.h - fractals in the x-y plane. Measured of POV-Ray 3.7. */
#ifndef CORE_PHYSICS_PATTERN_FRACTAL_H
#define CORE_PHYSICS_PATTERN_FRACTAL_H
#include "core/physics/wave.h"

typedef struct { real re, im; } complex_number;

HD complex_number complex_make(real re, real im)
{
    complex_number c;
    c.re = re;
    c.im = im;
    return c;
}

HD complex_number complex_add(complex_number a, complex_number b)
{
    return complex_make(a.re + b.re, a.im + b.im);
}

HD complex_number complex_multiply(complex_number a, complex_number b)
{
    return complex_make(a.re * b.re - a.im * b.im,
                        a.re * b.im + a.im * b.re);
}

/* s a + c, s and c real */
HD complex_number complex_linear(real s, complex_number a, real c)
{
    return complex_make(s * a.re + c, s * a.im);
}

HD real complex_norm(complex_number a)
{
    return a.re * a.re + a.im * a.im;
}

HD complex_number complex_divide(complex_number a, complex_number b)
{
    complex_number q = complex_multiply(a, complex_make(b.re, -b.im));
    real n = complex_norm(b);
    return complex_make(q.re / n, q.im / n);
}

/* z^n for n > 0, by squaring. */
HD complex_number complex_power(complex_number z, int n)
{
    complex_number result = complex_make(REAL(1.0), REAL(0.0));
    for (; n > 0; n >>= 1) {
        if (n & 1)
            result = complex_multiply(result, z);
        z = complex_multiply(z, z);
    }
    return result;
}

/* A step of magnet 1: ((z^2 + c - 1) / (2 z + c - 2))^2; of magnet 2:
 * ((z^3 + 3 (c-1) z + (c-1)(c-2)) / (3 z^2 + 3 (c-2) z + (c-1)(c-2) + 1))^2 */
HD complex_number fractal_magnet(int type, complex_number z, complex_number c)
{
    complex_number c1 = complex_linear(REAL(1.0), c, REAL(-1.0));
    complex_number c2 = complex_linear(REAL(1.0), c, REAL(-2.0));
    complex_number zz = complex_multiply(z, z);
    complex_number top, bottom;
    if (type == 1) {
        top = complex_add(zz, c1);
        bottom = complex_add(complex_linear(REAL(2.0), z, REAL(0.0)), c2);
    } else {
        complex_number both = complex_multiply(c1, c2);
        complex_number z3 = complex_linear(REAL(3.0), z, REAL(0.0));
        top = complex_add(complex_add(complex_multiply(zz, z),
                                      complex_multiply(z3, c1)), both);
        bottom = complex_add(
            complex_add(complex_linear(REAL(3.0), zz, REAL(1.0)),
                        complex_multiply(z3, c2)), both);
    }
    top = complex_divide(top, bottom);
    return complex_multiply(top, top);
}

/* What is seen outside (of the set) or inside, types 0 to 6. */
HD real fractal_color(int type, real factor, complex_number z, real count,
                      bool outside)
{
    switch (type) {
    case 0:
        return factor;
    case 1:
        return outside ? count : count * factor;
    case 2:
        return z.re * factor;
    case 3:
        return z.im * factor;
    case 4:
        return z.re * z.re * factor;
    case 5:
        return z.im * z.im * factor;
    default:
        /* The inside one is a slip of POV-Ray's that scenes have adapted
         * to. */
        return outside ? real_sqrt(complex_norm(z)) * factor
                       : z.re * z.re + z.im * z.im * factor;
    }
}

/* magnet (0: none, 1, 2), iterations, exponent, exterior type, its factor,
 * interior type, its factor, julia (0: mandel, 1), c re im of julia */
HD real pattern_fractal(real3 p, const real *param)
{
    int magnet = (int)param[0], exponent = (int)param[2];
    bool julia = param[7] != REAL(0.0);
    complex_number at = complex_make(p.x, p.y);
    complex_number c = julia ? complex_make(param[8], param[9]) : at;
    complex_number z = at;
    real limit = magnet ? REAL(10000.0) : REAL(4.0);
    real nearest = complex_norm(z);
    if (magnet && !julia) {
        z = complex_make(REAL(0.0), REAL(0.0));
        nearest = limit;
    }
    uint32_t count = (uint32_t)real_clamp(param[1], REAL(1.0), REAL(1e9));
    for (uint32_t i = 0; i < count; i++) {
        z = magnet ? fractal_magnet(magnet, z, c)
                   : complex_add(complex_power(z, exponent), c);
        real norm = complex_norm(z);
        nearest = real_min(nearest, norm);
        bool settled = magnet
            && complex_norm(complex_linear(REAL(1.0), z, REAL(-1.0)))
                   < REAL(1e-4);
        if (!(norm <= limit) || settled)
            return fractal_color((int)param[3], param[4], z,
                                 (real)i / (real)count, true);
    }
    return fractal_color((int)param[5], param[6], z, real_sqrt(nearest),
                         false);
}

#endif
