/* pattern_pavement.h - the pavement pattern: the plane of x and z in tiles of
 * triangles, squares or hexagons. Measured of POV-Ray 3.7; its form, exterior
 * and interior are taken as 0. */
#ifndef CORE_PHYSICS_PATTERN_PAVEMENT_H
#define CORE_PHYSICS_PATTERN_PAVEMENT_H
#include "core/physics/noise.h"
#include "core/physics/pavement_table.h"

#define PAVEMENT_HEIGHT REAL(0.8660254037844386)    /* of a triangle       */

typedef struct {
    int sides;          /* 3, 4 or 6                                       */
    int index;          /* in the tables; -1 if there is none              */
} pavement;

HD pavement pavement_of(const real *param)
{
    pavement v;
    v.sides = (int)param[0];
    v.index = -1;
    int tiles = (int)param[1], variant = (int)param[2];
    int row = v.sides == 3 ? 0 : v.sides == 4 ? 6 : v.sides == 6 ? 12 : -1;
    if (row < 0 || tiles < 1 || tiles > 6 || variant < 1)
        return v;
    int index = pavement_group[row + tiles - 1] + variant - 1;
    if (index < pavement_group[row + tiles])
        v.index = index;
    return v;
}

HD int pavement_modulo(int a, int n)
{
    return (a % n + n) % n;
}

/* Do tiles meet at this side of a lattice point? */
HD bool pavement_border(pavement v, int i, int j, int side)
{
    const uint8_t *shape = pavement_shape + 3 * v.index;
    int row = pavement_modulo(j, shape[1]);
    int up = (j - row) / shape[1];
    int column = pavement_modulo(
        pavement_modulo(i, shape[0])
            - pavement_modulo(up, shape[0]) * shape[2], shape[0]);
    int at = pavement_first[v.index] + row * shape[0] + column;
    return pavement_borders[at] >> side & 1;
}

/* The k-th side that leaves a corner of squares or triangles (or that bounds
 * a hexagon), counted from x towards z. */
HD bool pavement_spoke(pavement v, int i, int j, int k)
{
    if (v.sides == 4)
        switch (k & 3) {
        case 0:
            return pavement_border(v, i, j, 1);
        case 1:
            return pavement_border(v, i, j, 0);
        case 2:
            return pavement_border(v, i - 1, j, 1);
        default:
            return pavement_border(v, i, j - 1, 0);
        }
    k = pavement_modulo(k, 6);
    switch (k) {
    case 3:
        return pavement_border(v, i - 1, j, 0);
    case 4:
        return pavement_border(v, i, j - 1, 1);
    case 5:
        return pavement_border(v, i + 1, j - 1, 2);
    default:
        return pavement_border(v, i, j, k);
    }
}

/* Distance to the tile's edges next to a corner at the origin, from the
 * sector that is the `own`-th about it. Lines of the two edges are followed
 * beyond it where the tile turns about the corner; if it nearly encloses it,
 * the tip is cut off. */
HD real pavement_corner(pavement v, int i, int j, int own, real x, real z)
{
    int count = v.sides == 4 ? 4 : 6, after = 1, before = 0;
    real turn = REAL(6.283185307179586) / (real)count;
    while (after < count && !pavement_spoke(v, i, j, own + after))
        after++;
    while (before < count && !pavement_spoke(v, i, j, own - before))
        before++;
    if (after == count && before == count)
        return REAL(1.0);
    real a = turn * (real)(own - before), b = turn * (real)(own + after);
    real to_a = z * real_cos(a) - x * real_sin(a);
    real to_b = x * real_sin(b) - z * real_cos(b);
    if (2 * (after + before) <= count)
        return real_min(to_a, to_b);
    real d = real_max(to_a, to_b), middle = REAL(0.5) * (a + b);
    if (after + before == 5)
        d = real_max(d, x * real_cos(middle) + z * real_sin(middle));
    return d;
}

HD real pavement_square(pavement v, real x, real z)
{
    int i = (int)real_floor(x), j = (int)real_floor(z);
    real d = REAL(1.0);
    for (int k = 0; k < 4; k++) {
        int right = k == 1 || k == 2, up = k >= 2;
        d = real_min(d, pavement_corner(v, i + right, j + up, k,
                                        x - (real)(i + right),
                                        z - (real)(j + up)));
    }
    return d;
}

HD real pavement_triangle(pavement v, real x, real z)
{
    real b = z / PAVEMENT_HEIGHT, a = x - b * REAL(0.5);
    int i = (int)real_floor(a), j = (int)real_floor(b);
    bool up = a - real_floor(a) + b - real_floor(b) < REAL(1.0);
    real d = REAL(1.0);
    for (int k = 0; k < 3; k++) {
        int ci = i + (up ? k == 1 : k != 1);
        int cj = j + (up ? k == 2 : k != 2);
        real at_x = (real)ci + (real)cj * REAL(0.5);
        d = real_min(d, pavement_corner(v, ci, cj, 2 * k + (up ? 0 : 3),
                                        x - at_x,
                                        z - (real)cj * PAVEMENT_HEIGHT));
    }
    return d;
}

HD real pavement_hexagon(pavement v, real x, real z)
{
    /* Coordinates that add up to 0, rounded, as in pattern_hexagon. */
    real a = (x - REAL(1.0)) * REAL(0.6666666666666667);
    real b = z * REAL(0.5773502691896258) - a * REAL(0.5);
    real i = real_floor(a + REAL(0.5)), j = real_floor(b + REAL(0.5));
    real k = real_floor(REAL(0.5) - a - b);
    real da = real_abs(i - a), db = real_abs(j - b), dc = real_abs(k + a + b);
    if (da > db && da > dc)
        i = -j - k;
    else if (db > dc)
        j = -i - k;
    x -= REAL(1.0) + REAL(1.5) * i;
    z -= PAVEMENT_HEIGHT * (i + REAL(2.0) * j);
    real d = REAL(1.0);
    for (int side = 0; side < 6; side++) {
        real turn = REAL(0.5235987755982988) * (real)(2 * side + 1);
        if (pavement_spoke(v, (int)i, (int)j, side))
            d = real_min(d, PAVEMENT_HEIGHT - x * real_cos(turn)
                                - z * real_sin(turn));
    }
    return d;
}

/* sides (3, 4, 6), tiles (1 to 6), variant from 1 on */
HD real pattern_pavement(real3 p, const real *param)
{
    pavement v = pavement_of(param);
    real x = noise_coordinate(p.x), z = noise_coordinate(p.z), d;
    if (v.index < 0)
        return REAL(0.0);
    if (v.sides == 4)
        d = pavement_square(v, x, z);
    else if (v.sides == 3)
        d = pavement_triangle(v, x, z);
    else
        d = pavement_hexagon(v, x, z);
    real half = v.sides == 4 ? REAL(0.5) : PAVEMENT_HEIGHT / REAL(3.0);
    return REAL(1.0) - real_min(real_max(d, REAL(0.0)) / half, REAL(1.0));
}

#endif
