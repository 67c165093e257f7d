/* pattern_warp.h - warps: from a point to the point where the pattern is
 * looked up. Numbers as in pattern.h. */
#ifndef CORE_PHYSICS_PATTERN_WARP_H
#define CORE_PHYSICS_PATTERN_WARP_H
#include "core/physics/noise.h"
#include "core/physics/wave.h"

/* octaves, lambda, omega, amount x y z */
HD real3 pattern_warp_turbulence(real3 p, const real *param)
{
    real3 t = noise_vector_turbulence(p, noise_series_of(param));
    return real3_make(p.x + param[3] * t.x, p.y + param[4] * t.y,
                      p.z + param[5] * t.z);
}

#endif
