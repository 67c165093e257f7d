/* internal_field.h - algebraic surfaces and curves as functions of position:
 * the internal functions of functions.inc that have a field strength P0.
 *
 * The value is P0 times the polynomial, held within a field limit. All were
 * identified by fitting the values that POV-Ray 3.7 prints; most of the
 * polynomials are those of Nordstrand's gallery of surfaces. */
#ifndef CORE_PHYSICS_INTERNAL_FIELD_H
#define CORE_PHYSICS_INTERNAL_FIELD_H
#include "core/physics/elementary.h"

#define INTERNAL_LIMIT REAL(10.0)

HD real internal_cube(real x)
{
    return x * x * x;
}

HD real internal_square(real x)
{
    return x * x;
}

/* NAME, number of internal(), parameters, value before P0. Names: x y z, their
 * squares xx yy zz, rr = xx + zz, ss = rr + yy, and the parameters P(i). */
#define INTERNAL_SURFACES(X)                                                  \
    X(bicorn, 4, 2, yy * (P(1) * P(1) - rr)                                   \
        - internal_square(rr + 2 * P(1) * y - P(1) * P(1)))                   \
    X(bifolia, 5, 2, P(1) * y * rr - ss * ss)                                 \
    X(boy_surface, 8, 2, P(1) * field_boy(x, y, z))                        \
    X(crossed_trough, 11, 1, xx * zz - y)                                     \
    X(cubic_saddle, 12, 1, z + y * yy - x * xx)                               \
    X(cushion, 13, 1, field_cushion(xx, yy, z))                            \
    X(devils_curve, 14, 1, yy * (yy - REAL(0.25)) - rr * rr                   \
        + REAL(0.36) * xx)                                                    \
    X(dupin_cyclid, 16, 6, field_dupin_cyclid(x, y, z, p))                 \
    X(enneper, 18, 1, field_enneper(yy - xx, z))                           \
    X(folium_surface, 20, 3, yy + zz + (1 + P(2)) * xx                        \
        - (4 * P(1) - P(2)) * x * (yy + zz))                                  \
    X(glob, 22, 1, (1 + x) * xx * xx / 2 - yy - zz)                           \
    X(heart, 23, 1, (xx / 10 + yy) * zz * z - internal_cube(ss + xx - 1))     \
    X(hunt_surface, 30, 1, -4 * internal_cube(ss - 13)                        \
        - 27 * internal_square(3 * xx + yy - 4 * zz - 12))                    \
    X(hyperbolic_torus, 31, 3, 4 * P(1) * P(1) * (xx - zz)                    \
        - internal_square(xx + yy - zz + P(1) * P(1) - P(2) * P(2)))          \
    X(kampyle_of_eudoxus, 33, 3, P(2) * P(2) * xx * (xx - P(1) * P(1))        \
        - yy - zz)                                                            \
    X(klein_bottle, 35, 1, -(ss + 2 * y - 1)                                  \
            * (internal_square(ss - 2 * y - 1) - 8 * zz)                      \
        - 16 * x * z * (ss - 2 * y - 1))                                      \
    X(kummer_surface_v1, 36, 1, xx * yy + yy * zz + zz * xx + ss - 1          \
        - (xx * xx + yy * yy + zz * zz))                                      \
    X(kummer_surface_v2, 37, 4, 1 - P(1) * ss                                 \
        - P(2) * (xx * yy + yy * zz + zz * xx) - P(3) * x * y * z             \
        - (xx * xx + yy * yy + zz * zz))                                      \
    X(lemniscate_of_gerono, 38, 1, xx - xx * xx - yy - zz)                    \
    X(mitre, 41, 1, yy * (1 - yy - zz) - 4 * xx * ss)                         \
    X(nodal_cubic, 42, 1, 6 * y * z - y * yy - z * zz)                        \
    X(odd, 43, 1, field_cushion(xx, yy, z))                                \
    X(ovals_of_cassini, 44, 4, P(2) * P(2) + P(3) * P(1) * P(1) * rr          \
        - internal_square(ss + P(1) * P(1)))                                  \
    X(paraboloid, 45, 1, y - rr)                                              \
    X(parabolic_torus, 46, 3, field_parabolic_torus(xx, yy, z, p))         \
    X(pillow, 48, 1, xx * xx + yy * yy + zz * zz - ss)                        \
    X(piriform, 49, 1, xx * xx - xx * x + yy + zz)                            \
    X(quartic_paraboloid, 54, 1, y - xx * xx - zz * zz)                       \
    X(quartic_saddle, 55, 1, y + zz * zz - xx * xx)                           \
    X(quartic_cylinder, 56, 3, P(1) * P(1) * P(2) * P(2)                      \
        - rr * (yy + P(2) * P(2)))                                            \
    X(steiners_roman, 65, 1, -(xx * yy + yy * zz + zz * xx + x * y * z))      \
    X(strophoid, 66, 4, P(3) * P(3) * xx * (P(1) + x)                         \
        + (x - P(2)) * (yy + zz))                                             \
    X(torus2, 71, 3, 4 * P(1) * P(1) * rr                                     \
        - internal_square(ss + P(1) * P(1) - P(2) * P(2)))                    \
    X(torus_gumdrop, 72, 1, 20 * ss - 17 - 17 * xx * (yy + zz)                \
        - 4 * (xx * xx + internal_square(yy + zz)))                           \
    X(umbrella, 73, 1, y * zz - xx)                                           \
    X(witch_of_agnesi, 74, 2, P(1) * (1 - y) - y * rr)

/* Curves, extruded or swept: NAME, number, parameters, index of the first of
 * the three parameters that tell how, value before P0. */
#define INTERNAL_CURVES(X)                                                    \
    X(algbr_cyl1, 0, 5, 2, yy + xx * (real_abs(x) - 1))                       \
    X(algbr_cyl2, 1, 5, 2, yy * (2 * y - 1 - yy) + 3 * xx * y - 2 * xx * xx)  \
    X(algbr_cyl3, 2, 5, 2, yy * (x - 1 - xx) + 2 * xx * y - xx * xx)          \
    X(algbr_cyl4, 3, 5, 2, yy * y - 3 * xx * y - internal_square(xx + yy))    \
    X(devils_curve_2d, 15, 6, 3, yy * (yy - P(2) * P(2))                      \
        - xx * (xx - P(1) * P(1)))                                            \
    X(folium_surface_2d, 21, 6, 3, (4 * P(1) - P(2)) * x * yy - yy            \
        - (1 + P(2)) * xx)                                                    \
    X(kampyle_of_eudoxus_2d, 34, 6, 3, P(2) * P(2) * xx * (xx - P(1) * P(2))  \
        - yy)                                                                 \
    X(lemniscate_of_gerono_2d, 39, 6, 3,                                      \
        P(2) * P(2) * xx * (P(1) * P(1) - xx) - yy)                           \
    X(piriform_2d, 50, 7, 4, P(3) * P(3) * xx * x * (P(1) + P(2) * x) - yy)   \
    X(strophoid_2d, 67, 7, 4, P(3) * P(3) * xx * (P(1) + x)                   \
        + (x - P(2)) * yy)                                                    \
    X(witch_of_agnesi_2d, 75, 6, 3, P(2) - (P(1) * P(1) + xx) * y)

/* Boy's surface */
HD real field_boy(real x, real y, real z)
{
    const real root2 = REAL(1.4142135623730951);
    real xx = x * x, yy = y * y, zz = z * z, s = xx + yy, u = 1 - z;
    return 64 * internal_cube(u * z)
         - 48 * u * u * zz * (3 * s + 2 * zz)
         + 12 * u * z * (27 * s * s - 24 * zz * s
                         + 36 * root2 * y * z * (yy - 3 * xx) + 4 * zz * zz)
         + (9 * s - 2 * zz) * (-81 * s * s - 72 * zz * s
                               + 108 * root2 * x * z * (xx - 3 * yy)
                               + 4 * zz * zz);
}

HD real field_cushion(real xx, real yy, real z)
{
    real zz = z * z;
    return z * (2 * zz - z * zz + 2 * yy) - 2 * zz + yy + xx - yy * zz
         + xx * zz - internal_square(xx + yy);
}

/* The inverse, by a sphere of radius P5, of a torus moved by <P3, P4>; the
 * last term is POV-Ray's, and belongs to no such surface. */
HD real field_dupin_cyclid(real x, real y, real z, const real *p)
{
    real k = p[5] * p[5], s = x * x + y * y + z * z;
    real dx = p[3], dy = p[4], major = p[1] * p[1], c = major - p[2] * p[2];
    real a = k * k - 2 * k * (x * dx + y * dy)
           + (dx * dx + dy * dy + c) * s;
    return 4 * major * (internal_square(k * x - dx * s) + k * k * z * z)
         - a * a - 8 * k * dy * c * y * s;
}

/* w = y^2 - x^2. The divisor keeps away from 0. */
HD real field_enneper(real w, real z)
{
    real d = real_abs(z) < REAL(0.2) ? REAL(0.2) : z;
    return 6 * internal_square(w / (4 * d))
         - internal_cube(w / (2 * d) + 2 * z * z / 9);
}

HD real field_parabolic_torus(real xx, real yy, real z, const real *p)
{
    real major = p[1] * p[1], c = major - p[2] * p[2], s = xx + yy - z;
    return 2 * major * (xx - z) - s * s - c * s - c * c;
}

/* A curve is extruded along z, or, if p[0] > 0, moved by p[1] along x, turned
 * by p[2] degrees about z and then swept about the y axis. */
HD void internal_sweep(real *x, real *y, real z, const real *p)
{
    real u, s, c;
    if (!(p[0] > 0))
        return;
    u = real_sqrt(*x * *x + z * z) - p[1];
    s = real_sin(p[2] * REAL_DEGREE);
    c = real_cos(p[2] * REAL_DEGREE);
    *x = u * c - *y * s;
    *y = u * s + *y * c;
}

#define P(i) p[i]
#define INTERNAL_SURFACE(name, number, parameters, value)                     \
    HD real internal_##name(real x, real y, real z, const real *p)            \
    {                                                                         \
        real xx = x * x, yy = y * y, zz = z * z, rr = xx + zz, ss = rr + yy;  \
        (void)zz, (void)ss;                                                   \
        return real_clamp(p[0] * (value), -INTERNAL_LIMIT, INTERNAL_LIMIT);   \
    }
INTERNAL_SURFACES(INTERNAL_SURFACE)
#undef INTERNAL_SURFACE

/* P1 is the limit of the algebraic cylinders, whose sweep begins at P2. */
#define INTERNAL_CURVE(name, number, parameters, sweep, value)                \
    HD real internal_##name(real x, real y, real z, const real *p)            \
    {                                                                         \
        real xx, yy, limit = sweep == 2 ? p[1] : INTERNAL_LIMIT;              \
        internal_sweep(&x, &y, z, p + sweep);                                 \
        xx = x * x;                                                           \
        yy = y * y;                                                           \
        (void)yy;                                                             \
        return real_clamp(p[0] * (value), -limit, limit);                     \
    }
INTERNAL_CURVES(INTERNAL_CURVE)
#undef INTERNAL_CURVE
#undef P

#endif
