/* solids.h - the further primitives, one function each for all of them. */
#ifndef CORE_PHYSICS_SOLIDS_H
#define CORE_PHYSICS_SOLIDS_H
#include "core/physics/solid_blob.h"
#include "core/physics/solid_julia.h"
#include "core/physics/solid_lathe.h"
#include "core/physics/solid_ovus.h"
#include "core/physics/solid_poly.h"
#include "core/physics/solid_polygon.h"
#include "core/physics/solid_prism.h"
#include "core/physics/solid_quadric.h"
#include "core/physics/solid_sor.h"
#include "core/physics/solid_sphere_sweep.h"
#include "core/physics/solid_superellipsoid.h"
#include "core/physics/solid_torus.h"

/* NAME, name; SOLID_POLYGON is what is none of them. */
#define SOLIDS(X)                                                             \
    X(TORUS, torus)                                                           \
    X(QUADRIC, quadric)                                                       \
    X(POLY, poly)                                                             \
    X(SUPERELLIPSOID, superellipsoid)                                         \
    X(OVUS, ovus)                                                             \
    X(BLOB, blob)                                                             \
    X(LATHE, lathe)                                                           \
    X(PRISM, prism)                                                           \
    X(SOR, sor)                                                               \
    X(SPHERE_SWEEP, sphere_sweep)                                             \
    X(JULIA, julia)

enum {
    SOLID_POLYGON = 16,
#define X(NAME, name) SOLID_##NAME,
    SOLIDS(X)
#undef X
    SOLID_ISOSURFACE,       /* isosurface.h                                */
    SOLID_FIRST = SOLID_POLYGON,
    SOLID_MAX_ROOTS = 64
};

HD_APART int solid_roots(int kind, const double *data, dvec3 o, dvec3 d,
                         double *t, int *part)
{
    switch (kind) {
#define X(NAME, name)                                                         \
    case SOLID_##NAME:                                                        \
        return name##_roots(data, o, d, t, part, SOLID_MAX_ROOTS);
    SOLIDS(X)
#undef X
    default:
        return polygon_roots(data, o, d, t, part, SOLID_MAX_ROOTS);
    }
}

HD_APART dvec3 solid_normal(int kind, const double *data, dvec3 p, int part)
{
    switch (kind) {
#define X(NAME, name)                                                         \
    case SOLID_##NAME:                                                        \
        return name##_normal(data, p, part);
    SOLIDS(X)
#undef X
    default:
        return polygon_normal(data, p, part);
    }
}

HD_APART bool solid_inside(int kind, const double *data, dvec3 p)
{
    switch (kind) {
#define X(NAME, name)                                                         \
    case SOLID_##NAME:                                                        \
        return name##_inside(data, p);
    SOLIDS(X)
#undef X
    default:
        return polygon_inside(data, p);
    }
}

#endif
