/* internal.h - the internal functions of functions.inc, by their number. */
#ifndef CORE_PHYSICS_INTERNAL_H
#define CORE_PHYSICS_INTERNAL_H
#include "core/physics/internal_field.h"
#include "core/physics/internal_noise.h"
#include "core/physics/internal_shape.h"

/* NAME, number of internal(), parameters after x, y, z */
#define INTERNAL_SHAPES(X)                                                    \
    X(blob, 6, 5)                                                             \
    X(blob2, 7, 4)                                                            \
    X(cross_ellipsoids, 10, 4)                                                \
    X(ellipsoid, 17, 3)                                                       \
    X(flange_cover, 19, 4)                                                    \
    X(hetero_mf, 29, 6)                                                       \
    X(helical_torus, 24, 10)                                                  \
    X(helix1, 25, 7)                                                          \
    X(helix2, 26, 7)                                                          \
    X(hex_x, 27, 1)                                                           \
    X(hex_y, 28, 1)                                                           \
    X(isect_ellipsoids, 32, 4)                                                \
    X(mesh1, 40, 5)                                                           \
    X(noise3d, 76, 0)                                                         \
    X(noise_generator, 78, 1)                                                 \
    X(ph, 47, 0)                                                              \
    X(poly4, 51, 5)                                                           \
    X(polytubes, 52, 6)                                                       \
    X(quantum, 53, 1)                                                         \
    X(r, 57, 0)                                                               \
    X(ridge, 58, 6)                                                           \
    X(ridged_mf, 59, 6)                                                       \
    X(rounded_box, 60, 4)                                                     \
    X(sphere, 61, 1)                                                          \
    X(spikes, 62, 5)                                                          \
    X(spikes_2d, 63, 4)                                                       \
    X(spiral, 64, 6)                                                          \
    X(superellipsoid, 68, 2)                                                  \
    X(th, 69, 0)                                                              \
    X(torus, 70, 2)

/* All of them: X(NAME, number, parameters after x, y, z) */
#define INTERNAL_SURFACE_ROW(name, number, parameters, value)                 \
    INTERNAL_ROW(name, number, parameters)
#define INTERNAL_CURVE_ROW(name, number, parameters, sweep, value)            \
    INTERNAL_ROW(name, number, parameters)
#define INTERNAL_FUNCTIONS                                                    \
    INTERNAL_SHAPES(INTERNAL_ROW) INTERNAL_SURFACES(INTERNAL_SURFACE_ROW)     \
    INTERNAL_CURVES(INTERNAL_CURVE_ROW)

/* Parameters after x, y, z; -1 if there is no such function. */
HD int internal_parameters(int number)
{
    switch (number) {
#define INTERNAL_ROW(name, number, parameters)                                \
    case number: return parameters;
    INTERNAL_FUNCTIONS
#undef INTERNAL_ROW
    default: return -1;
    }
}

/* The value of one that there is; v are x, y, z and the parameters. */
HD real internal_eval(int number, const real *v)
{
    real x = v[0], y = v[1], z = v[2];
    const real *p = v + 3;
    switch (number) {
#define INTERNAL_ROW(name, number, parameters)                                \
    case number: return internal_##name(x, y, z, p);
    INTERNAL_FUNCTIONS
#undef INTERNAL_ROW
    }
    return REAL(0.0);
}

#endif
