/* pattern_normal.h - patterns of a surface's direction: slope and aoi, whose
 * values go to wave_value as others' do. Measured of POV-Ray 3.7. */
#ifndef CORE_PHYSICS_PATTERN_NORMAL_H
#define CORE_PHYSICS_PATTERN_NORMAL_H
#include "core/physics/wave.h"

enum { PATTERN_SLOPE_NUMBERS = 11 };

/* Of two unit vectors: 0 if they are opposed, 0.5 across, 1 if alike. */
HD real pattern_alike(real3 a, real3 b)
{
    real c = real_clamp(real3_dot(a, b), REAL(-1.0), REAL(1.0));
    return REAL(1.0) - real_acos(c) * REAL(0.3183098861837907);
}

HD real3 pattern_unit(real3 a)
{
    real length = real3_length(a);
    return length > REAL(0.0) ? real3_scale(a, REAL(1.0) / length) : a;
}

/* Angle of incidence: the ray's direction and the normal (both unit), which
 * faces the ray's origin. */
HD real pattern_aoi(real3 ray, real3 normal)
{
    return pattern_alike(real3_scale(ray, REAL(-1.0)), normal);
}

/* direction x y z or, if point_at, a point; lowest and highest slope (0, 1);
 * altitude x y z, lowest and highest altitude (0, 1); point_at (0, 1). The
 * lengths of direction and altitude weigh the two. The point is in pattern
 * space; the normal, unit, in the world's, facing the ray's origin. */
HD real pattern_slope(real3 p, real3 normal, const real *param)
{
    real3 direction = real3_make(param[0], param[1], param[2]);
    real3 altitude = real3_make(param[5], param[6], param[7]);
    real weight = real3_length(direction);
    real height_weight = real3_length(altitude);
    if (param[10] != REAL(0.0))
        direction = real3_sub(direction, p);
    real slope = pattern_alike(pattern_unit(direction), normal);
    if (param[4] != param[3])
        slope = (slope - param[3]) / (param[4] - param[3]);
    if (height_weight == REAL(0.0) || param[10] != REAL(0.0))
        return slope;
    real height = real3_dot(p, pattern_unit(altitude));
    if (param[9] != param[8])
        height = (height - param[8]) / (param[9] - param[8]);
    return (weight * slope + height_weight * height)
         / (weight + height_weight);
}

#endif
