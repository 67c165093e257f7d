/* pattern_block.h - block patterns: their value is the number of an item of
 * a list, from 0 on. Measured of POV-Ray 3.7. */
#ifndef CORE_PHYSICS_PATTERN_BLOCK_H
#define CORE_PHYSICS_PATTERN_BLOCK_H
#include "core/physics/pattern_plain.h"

/* Modulo a small whole number, of the floor of v. */
HD int block_index(real v, int count)
{
    real m = (real)count, f = real_floor(v);
    real index = f - m * real_floor(f / m);
    return index >= REAL(0.0) && index < m ? (int)index : 0;
}

/* Two items. */
HD real pattern_checker(real3 p, const real *param)
{
    (void)param;
    return (real)((block_index(p.x + PATTERN_EDGE, 2)
                   + block_index(p.y + PATTERN_EDGE, 2)
                   + block_index(p.z + PATTERN_EDGE, 2)) & 1);
}

/* Four, in x and z. */
HD real pattern_square(real3 p, const real *param)
{
    int x = block_index(p.x, 2), z = block_index(p.z, 2);
    (void)param;
    return (real)(x ? 3 - z : z);
}

/* Of a coordinate along which bricks follow one another: in the mortar? */
HD bool block_in_mortar(real x, real size, real mortar)
{
    return wave_fraction(x / size + PATTERN_EDGE) * size >= size - mortar;
}

/* Mortar is 0, brick 1. size x y z, mortar; odd layers are moved by half a
 * brick in x, even ones in z. */
HD real pattern_brick(real3 p, const real *param)
{
    bool odd = block_index(p.y / param[1] + PATTERN_EDGE, 2) == 1;
    real x = p.x + (odd ? param[0] / REAL(2.0) : REAL(0.0));
    real z = p.z + (odd ? REAL(0.0) : param[2] / REAL(2.0));
    bool mortar = block_in_mortar(x, param[0], param[3])
               || block_in_mortar(p.y, param[1], param[3])
               || block_in_mortar(z, param[2], param[3]);
    return mortar ? REAL(0.0) : REAL(1.0);
}

/* Three, of side 1 in x and z. */
HD real pattern_hexagon(real3 p, const real *param)
{
    /* Coordinates of the hexagonal lattice that add up to 0, rounded: the one
     * that was rounded most follows from the others. */
    real a = p.x * REAL(0.6666666666666667);
    real b = p.z * REAL(0.5773502691896258) - a * REAL(0.5);
    real c = -a - b;
    real i = real_floor(a + REAL(0.5)), j = real_floor(b + REAL(0.5));
    real k = real_floor(c + REAL(0.5));
    real da = real_abs(i - a), db = real_abs(j - b), dc = real_abs(k - c);
    (void)param;
    if (da > db && da > dc)
        i = -j - k;
    else if (db > dc)
        j = -i - k;
    return (real)block_index(REAL(2.0) * i + j, 3);
}

/* Six, of side 1 in x and z: pointing to +z 0, 4, 2, to -z 3, 5, 1. */
HD real pattern_triangular(real3 p, const real *param)
{
    real j = p.z * REAL(1.1547005383792515);
    real i = p.x - j * REAL(0.5);
    int n = block_index(real_floor(i) - real_floor(j), 3);
    bool up = wave_fraction(i) + wave_fraction(j) < REAL(1.0);
    (void)param;
    return (real)(up ? 4 * n % 6 : (3 + 2 * n) % 6);
}

/* Six: by the half-axis that is nearest, x y z -x -y -z. */
HD real pattern_cubic(real3 p, const real *param)
{
    real x = real_abs(p.x), y = real_abs(p.y), z = real_abs(p.z);
    int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    real at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    (void)param;
    return (real)(at < REAL(0.0) ? axis + 3 : axis);
}

#endif
