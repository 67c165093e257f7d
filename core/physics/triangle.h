/* triangle.h - ray against triangle, watertight: rays through a shared edge or
 * vertex hit one of the neighbours (Woop, Benthin, Wald 2013). */
#ifndef CORE_PHYSICS_TRIANGLE_H
#define CORE_PHYSICS_TRIANGLE_H
#include "core/physics/vec.h"

/* The shear that turns a direction into +z; axes chosen so that z is the
 * largest component. */
typedef struct {
    int32_t kx, ky, kz;
    float sx, sy, sz;
} triangle_ray;

HD triangle_ray triangle_ray_make(vec3 d)
{
    triangle_ray r;
    float ax = fabsf(d.x), ay = fabsf(d.y), az = fabsf(d.z);
    r.kz = ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
    r.kx = (r.kz + 1) % 3;
    r.ky = (r.kx + 1) % 3;
    if (vec3_get(d, r.kz) < 0.0f) {
        int32_t swap = r.kx;
        r.kx = r.ky;
        r.ky = swap;
    }
    r.sz = 1.0f / vec3_get(d, r.kz);
    r.sx = vec3_get(d, r.kx) * r.sz;
    r.sy = vec3_get(d, r.ky) * r.sz;
    return r;
}

/* Twice the signed area that an edge spans with the ray; where float gives 0
 * double decides, so that neighbours agree. */
HD float triangle_edge(float ax, float ay, float bx, float by)
{
    float e = ax * by - ay * bx;
    return e != 0.0f ? e
         : (float)((double)ax * (double)by - (double)ay * (double)bx);
}

/* Hit at distance *t of either sign, u and v the weights of p1 and p2. Both
 * sides count. */
HD bool triangle_hit(const triangle_ray *r, vec3 o, vec3 p0, vec3 p1, vec3 p2,
                     float *t, float *u, float *v)
{
    vec3 a = vec3_sub(p0, o), b = vec3_sub(p1, o), c = vec3_sub(p2, o);
    float az = vec3_get(a, r->kz), bz = vec3_get(b, r->kz);
    float cz = vec3_get(c, r->kz);
    float ax = vec3_get(a, r->kx) - r->sx * az;
    float ay = vec3_get(a, r->ky) - r->sy * az;
    float bx = vec3_get(b, r->kx) - r->sx * bz;
    float by = vec3_get(b, r->ky) - r->sy * bz;
    float cx = vec3_get(c, r->kx) - r->sx * cz;
    float cy = vec3_get(c, r->ky) - r->sy * cz;
    float w0 = triangle_edge(cx, cy, bx, by);
    float w1 = triangle_edge(ax, ay, cx, cy);
    float w2 = triangle_edge(bx, by, ax, ay);
    if ((w0 < 0.0f || w1 < 0.0f || w2 < 0.0f) &&
        (w0 > 0.0f || w1 > 0.0f || w2 > 0.0f))
        return false;
    float sum = w0 + w1 + w2;
    if (sum == 0.0f)
        return false;
    float inverse = 1.0f / sum;
    *t = (w0 * az + w1 * bz + w2 * cz) * r->sz * inverse;
    *u = w1 * inverse;
    *v = w2 * inverse;
    return true;
}

#endif
