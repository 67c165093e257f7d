/* warp.h - uniform squares to directions, points and frames.
 *
 * u and v are in [0, 1). Local frames have z along the axis; directions are
 * unit vectors to 2 ulp. Each density is per solid angle, or per area of the
 * unit disc, and is the one that its warp draws with. */
#ifndef CORE_PHYSICS_WARP_H
#define CORE_PHYSICS_WARP_H
#include "core/physics/fmath.h"
#include "core/physics/vec.h"

#define WARP_INV_PI 0.318309886f
#define WARP_INV_4PI 0.0795774715f
#define WARP_2PI 6.28318531f

/* vec3_normalize for vectors that are neither huge nor tiny, but 0. */
HD vec3 warp_normalize(vec3 a)
{
    float l = fm_root_within(vec3_dot(a, a));
    return l > 0.0f ? vec3_scale(a, fm_inverse_within(l)) : a;
}

/* Right-handed, orthonormal. */
typedef struct { vec3 x, y, z; } warp_basis;

/* A frame around the unit vector n, continuous but at n.z = 0 [Duff, Burgess,
 * Christensen, Hery, Kensler, Liani, Villemin 2017]. */
HD warp_basis warp_frame(vec3 n)
{
    warp_basis f;
    float sign = n.z < 0.0f ? -1.0f : 1.0f;
    float a = -fm_inverse_within(sign + n.z), b = n.x * n.y * a;
    f.x = vec3_make(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    f.y = vec3_make(b, sign + n.y * n.y * a, -n.y);
    f.z = n;
    return f;
}

HD vec3 warp_frame_to_world(warp_basis f, vec3 local)
{
    vec3 v = vec3_scale(f.x, local.x);
    return vec3_mad(vec3_mad(v, local.y, f.y), local.z, f.z);
}

/* The direction whose angle from z has this cosine and sine, v turns about
 * it. */
HD vec3 warp_around_z(float cosine, float sine, float v)
{
    float s, c;
    fm_sincos_within(WARP_2PI * v, &s, &c);
    return vec3_make(sine * c, sine * s, cosine);
}

/* Uniform on the unit disc, z = 0. */
HD vec3 warp_disc(float u, float v)
{
    return warp_around_z(0.0f, sqrtf(u), v);
}

/* Density cosine / pi around z [Malley]; never exactly horizontal. */
HD vec3 warp_cosine_hemisphere(float u, float v)
{
    return warp_around_z(sqrtf(1.0f - u), sqrtf(u), v);
}

HD float warp_cosine_hemisphere_pdf(float cosine)
{
    return hd_max(cosine, 0.0f) * WARP_INV_PI;
}

HD vec3 warp_sphere(float u, float v)
{
    return warp_around_z(1.0f - 2.0f * u, 2.0f * sqrtf(u * (1.0f - u)), v);
}

HD float warp_sphere_pdf(void)
{
    return WARP_INV_4PI;
}

/* Uniform in the cone around z; `spread` is 1 - cosine of its half-angle, in
 * (0, 2]: given so, a narrow cone keeps its digits. */
HD vec3 warp_cone(float u, float v, float spread)
{
    float h = u * spread;       /* 1 - cosine of the angle from z */
    return warp_around_z(1.0f - h, sqrtf(h * (2.0f - h)), v);
}

HD float warp_cone_pdf(float spread)
{
    return WARP_INV_PI * 0.5f / spread;
}

/* Barycentric coordinates, uniform over any triangle; density 1 / area. */
HD vec3 warp_triangle(float u, float v)
{
    float s = sqrtf(u), y = v * s;
    return vec3_make(1.0f - s, y, s - y);
}

#endif
