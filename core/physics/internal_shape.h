/* internal_shape.h - the internal functions of functions.inc that have no
 * field strength: distances, blobs, helices and the like.
 *
 * Identified by the values that POV-Ray 3.7 prints. p are the parameters P0
 * and on; angles are in degrees where the manual says so. */
#ifndef CORE_PHYSICS_INTERNAL_SHAPE_H
#define CORE_PHYSICS_INTERNAL_SHAPE_H
#include "core/physics/elementary.h"

#define INTERNAL_PI REAL(3.141592653589793)

HD real internal_hypot(real x, real y)
{
    return real_sqrt(x * x + y * y);
}

/* a modulo b, in [0, b) */
HD real internal_modulo(real a, real b)
{
    return a - b * real_floor(a / b);
}

/* ---- spherical coordinates --------------------------------------------- */

HD real internal_r(real x, real y, real z, const real *p)
{
    (void)p;
    return real_sqrt(x * x + y * y + z * z);
}

HD real internal_th(real x, real y, real z, const real *p)
{
    (void)y, (void)p;
    return real_atan2(x, z);
}

HD real internal_ph(real x, real y, real z, const real *p)
{
    (void)p;
    return real_atan2(internal_hypot(x, z), y);
}

/* ---- distances --------------------------------------------------------- */

HD real internal_sphere(real x, real y, real z, const real *p)
{
    return internal_r(x, y, z, p) - p[0];
}

HD real internal_ellipsoid(real x, real y, real z, const real *p)
{
    return internal_r(x * p[0], y * p[1], z * p[2], p);
}

HD real internal_torus(real x, real y, real z, const real *p)
{
    return internal_hypot(internal_hypot(x, z) - p[0], y) - p[1];
}

/* How far |x| is beyond a face of half width `half`, `radius` before it. */
HD real internal_beyond(real x, real half, real radius)
{
    return real_max(real_abs(x) - (half - radius), REAL(0.0));
}

HD real internal_rounded_box(real x, real y, real z, const real *p)
{
    return internal_r(internal_beyond(x, p[1], p[0]),
                      internal_beyond(y, p[2], p[0]),
                      internal_beyond(z, p[3], p[0]), p)
         - p[0] - REAL(0.000001);
}

HD real internal_superellipsoid(real x, real y, real z, const real *p)
{
    real equator = real_pow(real_abs(x), 2 / p[0])
                 + real_pow(real_abs(y), 2 / p[0]);
    return 1 - real_pow(real_pow(equator, p[0] / p[1])
                            + real_pow(real_abs(z), 2 / p[1]), p[1] / 2);
}

/* The polynomial P0 + P1 y + ... of degree 4. */
HD real internal_quartic(real y, const real *p)
{
    return p[0] + y * (p[1] + y * (p[2] + y * (p[3] + y * p[4])));
}

HD real internal_poly4(real x, real y, real z, const real *p)
{
    return internal_hypot(x, z) - internal_quartic(y, p);
}

/* Distance to the nearest of P0 curves around the y axis, one of them at
 * x = 0, z > 0. */
HD real internal_polytubes(real x, real y, real z, const real *p)
{
    real r = internal_hypot(x, z), sector = 2 * INTERNAL_PI / p[0];
    real tube = internal_quartic(y, p + 1);
    real turn = real_atan2(x, z) + (tube < 0 ? INTERNAL_PI : REAL(0.0));
    real a = internal_modulo(turn + sector / 2, sector) - sector / 2;
    return internal_hypot(r * real_cos(a) - real_abs(tube), r * real_sin(a));
}

/* Distance to the nearer of the two threads beside u, which lie at whole
 * numbers i, at heights h for even and -h for odd i. */
HD real internal_thread(real u, real y, real h, real thick_u, real thick_y)
{
    real i = real_floor(u), odd = internal_modulo(i, REAL(2.0));
    real low = odd == 0 ? h : -h;
    return real_min(
        internal_hypot(thick_y * (y - low), thick_u * (u - i)),
        internal_hypot(thick_y * (y + low), thick_u * (u - i - 1)));
}

/* Threads along x at z = k P1, and along z at x = k P0, over and under. */
HD real internal_mesh1(real x, real y, real z, const real *p)
{
    real u = x / p[0], v = z / p[1];
    real along = p[3] * real_cos(INTERNAL_PI * u);
    real across = -p[3] * real_cos(INTERNAL_PI * v);
    return real_min(internal_thread(v, y, along, p[1] * p[2], p[4]),
                    internal_thread(u, y, across, p[0] * p[2], p[4]));
}

/* ---- hexagons ---------------------------------------------------------- */

/* From the centre nearest in the hexagons' metric, |x| and |y|. Centres are
 * at <sqrt(3) i, 3 k> and half way between. */
HD void internal_hexagon(real *x, real *y)
{
    const real w = REAL(1.7320508075688772), h = REAL(3.0);
    real ax = *x - w * real_floor(*x / w + REAL(0.5));
    real ay = *y - h * real_floor(*y / h + REAL(0.5));
    real bx = *x - w * (real_floor(*x / w) + REAL(0.5));
    real by = *y - h * (real_floor(*y / h) + REAL(0.5));
    bool first = ax * ax + ay * ay < bx * bx + by * by;
    *x = real_abs(first ? ax : bx);
    *y = real_abs(first ? ay : by);
}

HD real internal_hex_x(real x, real y, real z, const real *p)
{
    (void)z, (void)p;
    internal_hexagon(&x, &y);
    return real_max(x, x / 2 + y * REAL(0.8660254037844386));
}

HD real internal_hex_y(real x, real y, real z, const real *p)
{
    (void)z, (void)p;
    internal_hexagon(&x, &y);
    return real_min(y, real_abs(x * REAL(0.8660254037844386) - y / 2));
}

/* ---- sums and extremes of exponentials --------------------------------- */

/* Squared distance in an ellipsoid's metric, x being the other axis. */
HD real internal_oblate(real xx, real yy, real zz, real eccentricity)
{
    return xx + eccentricity * (yy + zz);
}

/* exp(-s q) of the three ellipsoids around the axes */
HD real3 internal_ellipsoids(real x, real y, real z, real e, real s)
{
    real xx = x * x, yy = y * y, zz = z * z;
    return real3_make(real_exp(-s * internal_oblate(xx, yy, zz, e)),
                      real_exp(-s * internal_oblate(yy, zz, xx, e)),
                      real_exp(-s * internal_oblate(zz, xx, yy, e)));
}

HD real internal_cross_ellipsoids(real x, real y, real z, const real *p)
{
    real3 e = internal_ellipsoids(x, y, z, p[0], p[1]);
    return p[3] - p[2] * real_max(e.x, real_max(e.y, e.z));
}

HD real internal_isect_ellipsoids(real x, real y, real z, const real *p)
{
    real3 e = internal_ellipsoids(x, y, z, p[0], p[1]);
    return p[3] - p[2] * real_min(e.x, real_min(e.y, e.z));
}

HD real internal_flange_cover(real x, real y, real z, const real *p)
{
    real3 e = internal_ellipsoids(x, y, z, p[0], p[1]);
    return p[3] - p[2] * (e.x + e.y + e.z);
}

HD real internal_spikes(real x, real y, real z, const real *p)
{
    real3 e = internal_ellipsoids(x, y, z, p[0], p[1]);
    real ball = real_exp(-p[3] * (x * x + y * y + z * z));
    return p[2] * (e.x + e.y + e.z - p[4] * ball);
}

HD real internal_spikes_2d(real x, real y, real z, const real *p)
{
    return y - p[0] * real_cos(p[1] * x) * real_cos(p[2] * z)
                   * real_exp(-p[3] * (x * x + z * z));
}

HD real internal_blob_part(real xx, real strength, real inverse_radius)
{
    real d = 1 - xx * inverse_radius * inverse_radius;
    return d > 0 ? strength * d * d : REAL(0.0);
}

HD real internal_blob(real x, real y, real z, const real *p)
{
    real left = x + p[0] / 2, right = x - p[0] / 2, rr = y * y + z * z;
    return -internal_blob_part(left * left + rr, p[1], p[2])
         - internal_blob_part(right * right + rr, p[3], p[4]);
}

HD real internal_blob2(real x, real y, real z, const real *p)
{
    real rr = y * y + z * z, u = x - p[0];
    return p[3] - p[2] * (real_exp(-p[1] * (x * x + rr))
                          + real_exp(-p[1] * (u * u + rr)));
}

/* A d orbital. */
HD real internal_quantum(real x, real y, real z, const real *p)
{
    real rr = x * x + z * z, q = 2 * y * y - rr;
    (void)p;
    return REAL(1.2)
         - REAL(1.6) * q * q
               * real_exp(REAL(-1.33333332) * real_sqrt(rr + y * y));
}

/* ---- helices and spirals ----------------------------------------------- */

/* Length of <a, b> in the metric of a cross section: 0 a square, 1 a circle,
 * 2 a diamond. */
HD real internal_section(real a, real b, real type)
{
    real power;
    a = real_abs(a);
    b = real_abs(b);
    if (type == 0)
        return real_max(a, b);
    power = 2 / type;
    return real_pow(real_pow(a, power) + real_pow(b, power), 1 / power);
}

HD real internal_section_turned(real a, real b, real type, real angle)
{
    real s = real_sin(angle), c = real_cos(angle);
    return internal_section(a * c - b * s, a * s + b * c, type);
}

HD real internal_helix1(real x, real y, real z, const real *p)
{
    real r = internal_hypot(x, z);
    real turn = internal_modulo(p[0] * (real_atan2(z, x) + p[1] * y),
                                2 * INTERNAL_PI) - INTERNAL_PI;
    real a = r - p[3], b = turn / (p[0] * p[1] * p[4]);
    real tube = internal_section_turned(a, b, p[5], p[6] * REAL_DEGREE);
    return real_min(tube, r + p[3]) - p[2];
}

HD real internal_helix2(real x, real y, real z, const real *p)
{
    real turn = p[1] * y;
    real a = x - p[3] * real_cos(turn), b = z - p[3] * real_sin(turn);
    return internal_section_turned(a, b, p[5], -turn) - p[2];
}

HD real internal_spiral(real x, real y, real z, const real *p)
{
    real r = internal_hypot(x, z), whole, first, d, tube;
    if (r == 0)
        r = REAL(0.000001);
    whole = internal_hypot(r, y);
    first = p[0] * (INTERNAL_PI - real_atan2(z, x)) / (2 * INTERNAL_PI);
    d = internal_modulo(r - first + p[0] / 2, p[0]) - p[0] / 2;
    tube = real_min(internal_section(d, y, p[5]), whole);
    return real_max(tube - p[1], whole - p[2]);
}

/* A winding around a torus. Across it, w is its angle from the winding's
 * ridge and d the distance from the torus' circle. */
HD real internal_helical_torus(real x, real y, real z, const real *p)
{
    real r = internal_hypot(x, z), d = internal_hypot(r - p[0], y);
    real around = real_atan2(x, z);
    real turn = p[1] * around + p[2] * real_atan2(r - p[0], y);
    real w = internal_modulo(turn, 2 * INTERNAL_PI) - INTERNAL_PI;
    real groove = real_atan2(w * p[8], d - p[5]);
    real core = real_min(
        real_sqrt((d - p[5]) * (d - p[5]) + p[6] * w * w), d + p[5]);
    return core - p[4] - p[3] * real_cos(p[7] * groove + p[9] * around);
}

#endif
