/* pattern_tiling.h - the tiling pattern: the plane of x and z in tiles.
 * Tilings 1 to 24 of POV-Ray 3.7, equal to it to 1e-6; 25 to 27 do not repeat
 * and have no table. */
#ifndef CORE_PHYSICS_PATTERN_TILING_H
#define CORE_PHYSICS_PATTERN_TILING_H
#include "core/physics/noise.h"
#include "core/physics/tiling_table.h"

enum { TILING_COUNT = 24 };

HD real tiling_number(int32_t fixed)
{
    return (real)fixed * REAL(1e-8);
}

HD real tiling_length(const int8_t *pair, int root)
{
    real r = root == 2 ? REAL(1.4142135623730951) : REAL(1.7320508075688772);
    return REAL(0.25) * ((real)pair[0] + (real)pair[1] * r);
}

/* Distance from the nearest edge inwards, less than 0 outside, and the same
 * with what the slope of edges is of the tiling's. */
typedef struct { real depth, fall; } tile_place;

HD tile_place tiling_place(int tile, int root, real x, real z)
{
    tile_place place = {REAL(1e30), REAL(1e30)};
    for (int i = tile_first[tile]; i < tile_first[tile + 1]; i++) {
        const int8_t *edge = tile_edge + 3 * i;
        real cosine = tiling_number(tiling_cosine[edge[0] % 24]);
        real sine = tiling_number(tiling_cosine[(edge[0] + 18) % 24]);
        real depth = tiling_length(edge + 1, root) - x * cosine - z * sine;
        real slope = edge[0] < 24 ? REAL(1.0) : REAL(0.8660254037844386);
        place.depth = real_min(place.depth, depth);
        place.fall = real_min(place.fall, depth * slope);
    }
    return place;
}

/* number of the tiling */
HD real pattern_tiling(real3 p, const real *param)
{
    int n = (int)param[0] - 1, kind = 0;
    if (n < 0 || n >= TILING_COUNT)
        return REAL(0.0);
    real way[4];
    for (int i = 0; i < 4; i++)
        way[i] = tiling_length(tiling_period + 8 * n + 2 * i,
                               tiling_root[n]);
    real x = noise_coordinate(p.x), z = noise_coordinate(p.z);
    real area = way[0] * way[3] - way[1] * way[2];
    real a = real_floor((x * way[3] - z * way[2]) / area);
    real b = real_floor((z * way[0] - x * way[1]) / area);
    tile_place best = {REAL(-1e30), REAL(0.0)};
    x -= a * way[0] + b * way[2];
    z -= a * way[1] + b * way[3];
    for (int i = 0; i < 9; i++) {
        real i0 = (real)(i % 3 - 1), i1 = (real)(i / 3 - 1);
        for (int tile = tiling_first[n]; tile < tiling_first[n + 1]; tile++) {
            tile_place place = tiling_place(
                tile, tiling_root[n], x - i0 * way[0] - i1 * way[2],
                z - i0 * way[1] - i1 * way[3]);
            if (place.depth > best.depth) {
                best = place;
                kind = tile_type[tile];
            }
        }
    }
    real types = (real)tiling_types[n];
    return real_max(((real)kind + REAL(1.0)) / types
                    - real_max(best.fall, REAL(0.0))
                      * tiling_number(tiling_slope[n]), (real)kind / types);
}

#endif
