/* lanes.h - four numbers at once. On the CPU they stand in one vector
 * register; each is rounded as it would be alone. */
#ifndef CORE_PHYSICS_LANES_H
#define CORE_PHYSICS_LANES_H
#include <string.h>
#include "core/physics/real.h"

#if defined(__CUDACC__) || defined(PHYSICS_DOUBLE)
#define LANES_ALONE 1
#else
#define LANES_ALONE 0
#endif

#if LANES_ALONE
typedef struct {
    real v[4];
} lanes;
#define LANES_EACH(out, value)                                                \
    for (int i = 0; i < 4; i++)                                               \
        (out).v[i] = (value)
#define LANES_OF(a) (a).v[i]
#define LANES_AT(a, i) (a).v[i]
#else
typedef real lanes __attribute__((vector_size(4 * sizeof(real))));
#define LANES_EACH(out, value) (out) = (value)
#define LANES_OF(a) (a)
#define LANES_AT(a, i) (a)[i]
#endif

HD void lanes_set(lanes *out, real a, real b, real c, real d)
{
#if LANES_ALONE
    out->v[0] = a;
    out->v[1] = b;
    out->v[2] = c;
    out->v[3] = d;
#else
    const lanes all = {a, b, c, d};
    *out = all;
#endif
}

/* Four numbers that lie side by side, on a GPU at a multiple of 16 bytes. */
HD void lanes_load(lanes *out, const float *from)
{
#if defined(__CUDACC__)
    const float4 all = *(const float4 *)from;
    lanes_set(out, all.x, all.y, all.z, all.w);
#else
    lanes_set(out, from[0], from[1], from[2], from[3]);
#endif
}

/* As real_min and real_max: b where either is no number. */
#if LANES_ALONE
#define LANES_LESS(a, b, yes, no)                                             \
    LANES_EACH(*out, (a)->v[i] < (b)->v[i] ? (yes)->v[i] : (no)->v[i])
#else
typedef int32_t lanes_mask __attribute__((vector_size(4 * sizeof(real))));
#define LANES_LESS(a, b, yes, no)                                             \
    const lanes_mask is = *(a) < *(b);                                        \
    *out = (lanes)((is & (lanes_mask)*(yes)) | (~is & (lanes_mask)*(no)))
#endif

HD void lanes_min(lanes *out, const lanes *a, const lanes *b)
{
    LANES_LESS(a, b, a, b);
}

HD void lanes_max(lanes *out, const lanes *a, const lanes *b)
{
    LANES_LESS(b, a, a, b);
}

/* *out += a times the four numbers at `from`. */
HD void lanes_add(lanes *out, const lanes *a, const real *from)
{
    lanes b;
    memcpy(&b, from, sizeof b);
    LANES_EACH(*out, LANES_OF(*out) + LANES_OF(*a) * LANES_OF(b));
}

/* *out = a times b. */
HD void lanes_scale(lanes *out, const lanes *a, real b)
{
    LANES_EACH(*out, LANES_OF(*a) * b);
}

HD real lanes_sum(const lanes *a)
{
    return LANES_AT(*a, 0) + LANES_AT(*a, 1) + LANES_AT(*a, 2)
         + LANES_AT(*a, 3);
}

#endif
