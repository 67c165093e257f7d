/* pattern.h - all patterns: kinds, their numbers, one call for any.
 *
 * A kind's numbers stand in this order; what has the same name is the same:
 * generator 1, 2 or 3; octaves, lambda, omega of turbulence, as integer and
 * factors; amount, that of turbulence written in the pattern itself. Where
 * it has its own place here it does not move the point (marble, wood) or moves
 * it too, by a warp before (spirals: x); agate's always moves it.
 *
 * agate        generator, octaves, lambda, omega, agate_turb
 * bozo dents granite wrinkles  generator; bumps and spotted are bozo
 * crackle      generator, form x y z, metric, offset, solid (0, 1)
 * gradient     direction x y z
 * fractal      magnet (0: none), iterations, exponent, exterior type, factor,
 *              interior type, factor, julia (0: mandel), c re im; when not
 *              given, exponent 2, exterior 1 1, interior 0 1
 * marble       generator, octaves, lambda, omega, amount x
 * pavement     sides, tiles, pattern
 * quilted      control0, control1
 * ripples waves  count, frequency, phase, then 4 numbers for each source, by
 *              pattern_wave_sources; frequency and phase apply again after
 * spiral1 spiral2  generator, octaves, lambda, omega, amount x, arms
 * tiling       which, 1 to 24
 * wood         octaves, lambda, omega, amount x y
 * boxed cells cylindrical leopard onion planar radial spherical  none
 *
 * Block patterns, whose value is the number of a list's item (no wave):
 * brick        size x y z, mortar
 * checker cubic hexagon square triangular  none */
#ifndef CORE_PHYSICS_PATTERN_H
#define CORE_PHYSICS_PATTERN_H
#include "core/physics/pattern_block.h"
#include "core/physics/pattern_fractal.h"
#include "core/physics/pattern_noise.h"
#include "core/physics/pattern_pavement.h"
#include "core/physics/pattern_tiling.h"

/* function, NAME, numbers (of ripples and waves: without sources) */
#define PATTERN_KINDS(X)                                                      \
    X(agate, AGATE, 5) X(boxed, BOXED, 0) X(bozo, BOZO, 1)                    \
    X(brick, BRICK, 4) X(cells, CELLS, 0) X(checker, CHECKER, 0)              \
    X(crackle, CRACKLE, 7) X(cubic, CUBIC, 0)                                 \
    X(cylindrical, CYLINDRICAL, 0) X(dents, DENTS, 1)                         \
    X(fractal, FRACTAL, 10) X(gradient, GRADIENT, 3) X(granite, GRANITE, 1)   \
    X(hexagon, HEXAGON, 0) X(leopard, LEOPARD, 0) X(marble, MARBLE, 5)        \
    X(onion, ONION, 0) X(pavement, PAVEMENT, 3) X(planar, PLANAR, 0)          \
    X(quilted, QUILTED, 2) X(radial, RADIAL, 0) X(ripples, RIPPLES, 3)        \
    X(spherical, SPHERICAL, 0) X(spiral1, SPIRAL1, 6) X(spiral2, SPIRAL2, 6)  \
    X(square, SQUARE, 0) X(tiling, TILING, 1) X(triangular, TRIANGULAR, 0)    \
    X(waves, WAVES, 3) X(wood, WOOD, 5) X(wrinkles, WRINKLES, 1)

enum pattern_kind {
#define X(function, name, numbers) PATTERN_##name,
    PATTERN_KINDS(X)
#undef X
    PATTERN_COUNT
};

/* How many numbers a kind has. */
HD int pattern_numbers(int kind)
{
    switch (kind) {
#define X(function, name, numbers) case PATTERN_##name: return numbers;
    PATTERN_KINDS(X)
#undef X
    default:
        return 0;
    }
}

/* The value at a point; feed it to wave_value (wave.h). */
HD real pattern_value(int kind, real3 p, const real *param)
{
    switch (kind) {
#define X(function, name, numbers)                                            \
    case PATTERN_##name: return pattern_##function(p, param);
    PATTERN_KINDS(X)
#undef X
    default:
        return REAL(0.0);
    }
}

#endif
