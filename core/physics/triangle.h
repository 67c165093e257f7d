/* triangle.h - ray against triangle, watertight: rays through a shared edge or
 * vertex hit one of the neighbours (Woop, Benthin, Wald 2013). */
#ifndef CORE_PHYSICS_TRIANGLE_H
#define CORE_PHYSICS_TRIANGLE_H
#include "core/physics/real.h"

/* The shear that turns a direction into +z; axes chosen so that z is the
 * largest component. */
typedef struct {
    int32_t kx, ky, kz;
    real sx, sy, sz;
} triangle_ray;

HD triangle_ray triangle_ray_make(real3 d)
{
    triangle_ray r;
    real ax = real_abs(d.x), ay = real_abs(d.y), az = real_abs(d.z);
    r.kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    r.kx = (r.kz + 1) % 3;
    r.ky = (r.kx + 1) % 3;
    if (real3_get(d, r.kz) < 0) {
        int32_t swap = r.kx;
        r.kx = r.ky;
        r.ky = swap;
    }
    r.sz = 1 / real3_get(d, r.kz);
    r.sx = real3_get(d, r.kx) * r.sz;
    r.sy = real3_get(d, r.ky) * r.sz;
    return r;
}

/* Twice the signed area that an edge spans with the ray; where float gives 0
 * double decides, so that neighbours agree. */
HD real triangle_edge(real ax, real ay, real bx, real by)
{
    real e = ax * by - ay * bx;
    return e != 0 ? e
         : (real)((double)ax * (double)by - (double)ay * (double)bx);
}

/* Hit at distance *t of either sign, u and v the weights of p1 and p2. Both
 * sides count. */
HD bool triangle_hit(const triangle_ray *r, real3 o, real3 p0, real3 p1,
                     real3 p2, real *t, real *u, real *v)
{
    real3 a = real3_sub(p0, o), b = real3_sub(p1, o), c = real3_sub(p2, o);
    real az = real3_get(a, r->kz), bz = real3_get(b, r->kz);
    real cz = real3_get(c, r->kz);
    real ax = real3_get(a, r->kx) - r->sx * az;
    real ay = real3_get(a, r->ky) - r->sy * az;
    real bx = real3_get(b, r->kx) - r->sx * bz;
    real by = real3_get(b, r->ky) - r->sy * bz;
    real cx = real3_get(c, r->kx) - r->sx * cz;
    real cy = real3_get(c, r->ky) - r->sy * cz;
    real w0 = triangle_edge(cx, cy, bx, by);
    real w1 = triangle_edge(ax, ay, cx, cy);
    real w2 = triangle_edge(bx, by, ax, ay);
    if ((w0 < 0 || w1 < 0 || w2 < 0) &&
        (w0 > 0 || w1 > 0 || w2 > 0))
        return false;
    real sum = w0 + w1 + w2;
    if (sum == 0)
        return false;
    real inverse = 1 / sum;
    *t = (w0 * az + w1 * bz + w2 * cz) * r->sz * inverse;
    *u = w1 * inverse;
    *v = w2 * inverse;
    return true;
}

#endif
