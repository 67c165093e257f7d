/* solids.h - the further primitives by name: what builds them from a list of
 * numbers, and their functions. Read by the tests of core/solid.h. */
#ifndef TESTS_SOLIDS_H
#define TESTS_SOLIDS_H
#include "core/brume.h"
#include "core/physics/solid_blob.h"
#include "core/physics/solid_isosurface.h"
#include "core/physics/solid_julia.h"
#include "core/physics/solid_lathe.h"
#include "core/physics/solid_ovus.h"
#include "core/physics/solid_poly.h"
#include "core/physics/solid_prism.h"
#include "core/physics/solid_quadric.h"
#include "core/physics/solid_sor.h"
#include "core/physics/solid_sphere_sweep.h"
#include "core/physics/solid_superellipsoid.h"
#include "core/physics/solid_torus.h"
#include "core/solid.h"
#include <string.h>

struct solid_kind {
    const char *name;
    bool (*build)(struct arena *arena, const double *numbers, size_t count,
                  struct solid *solid, struct brume_error *err);
    int (*roots)(const double *data, dvec3 o, dvec3 d, double *t, int *part,
                 int room);
    dvec3 (*normal)(const double *data, dvec3 p, int part);
    bool (*inside)(const double *data, dvec3 p);
    double tolerance;       /* of POV-Ray's roots, for a size of 1          */
    bool either;            /* POV-Ray's normals may point inward           */
    bool thin;              /* what is thin may be missed                   */
};

#define SOLID_BUILD(name)                                                     \
    static bool build_##name(struct arena *arena, const double *n,            \
                             size_t count, struct solid *solid,               \
                             struct brume_error *err)

SOLID_BUILD(torus)
{
    (void)count;
    return solid_torus(arena, n[0], n[1], solid, err);
}

SOLID_BUILD(quadric)
{
    (void)count;
    return solid_quadric(arena, n, solid, err);
}

SOLID_BUILD(poly)
{
    (void)count;
    return solid_poly(arena, (int)n[0], n + 1, solid, err);
}

SOLID_BUILD(superellipsoid)
{
    (void)count;
    return solid_superellipsoid(arena, n[0], n[1], solid, err);
}

SOLID_BUILD(ovus)
{
    (void)count;
    return solid_ovus(arena, n[0], n[1], solid, err);
}

/* Threshold, then the components. */
SOLID_BUILD(blob)
{
    return solid_blob(arena, n[0], n + 1, (count - 1) / BRUME_BLOB_NUMBERS,
                      solid, err);
}

/* Curve, conic, open, heights, then the points. */
SOLID_BUILD(prism)
{
    return solid_prism(arena, (enum brume_curve)n[0], n[1] != 0, n[2] != 0,
                       n[3], n[4], n + 5, (count - 5) / 2, solid, err);
}

/* Curve, then the points. */
SOLID_BUILD(lathe)
{
    return solid_lathe(arena, (enum brume_curve)n[0], n + 1, (count - 1) / 2,
                       solid, err);
}

/* Open, then the points. */
SOLID_BUILD(sor)
{
    return solid_sor(arena, n[0] != 0, n + 1, (count - 1) / 2, solid, err);
}

/* Curve, then the spheres. */
SOLID_BUILD(sphere_sweep)
{
    return solid_sphere_sweep(arena, (enum brume_curve)n[0], n + 1,
                              (count - 1) / 4, solid, err);
}

/* Hypercomplex, function, iterations, precision, then the numbers. */
SOLID_BUILD(julia)
{
    (void)count;
    return solid_julia(arena, (enum brume_julia_kind)n[0],
                       (enum brume_julia_function)n[1], (int)n[2], n[3], n + 4,
                       solid, err);
}

/* Those of oracle/solids.py. */
static inline double isosurface_function(const double *data, dvec3 p)
{
    double x = p.x, y = p.y, z = p.z, rho = sqrt(x * x + z * z) - 0.7;

    switch ((int)data[ISOSURFACE_FUNCTION]) {
    case 0:
        return x * x + y * y + z * z - 1;
    case 1:
        return rho * rho + y * y - 0.09;
    case 2:
        return sin(3 * x) + sin(3 * y) + sin(3 * z);
    case 3:
        return y + 0.3 * sin(4 * x) * cos(3 * z);
    case 4:
        return NAN;
    case 5:
        return sqrt(x * x + y * y + z * z) - 0.05;
    default:
        return -1;
    }
}

static inline int isosurface_roots(const double *data, dvec3 o, dvec3 d,
                                   double *t, int *part, int room)
{
    isosurface_walk w;

    isosurface_start(data, o, d, -INFINITY, INFINITY, t, part, room, &w);
    while (w.asks)
        isosurface_tell(&w, isosurface_function(data, w.p));
    return w.count;
}

static inline dvec3 isosurface_normal(const double *data, dvec3 p, int part)
{
    double value[6];

    for (int k = 0; k < 6; k++)
        value[k] = isosurface_function(data, isosurface_beside(data, p, k));
    return isosurface_normal_of(data, p, part, value);
}

static inline bool isosurface_inside(const double *data, dvec3 p)
{
    return isosurface_inside_of(data, p, isosurface_function(data, p));
}

/* Function, container, its 6 numbers, threshold, accuracy, max_gradient, open,
 * and for an adapting gradient its factors. */
SOLID_BUILD(isosurface)
{
    struct brume_shape shape = BRUME_SHAPE_INIT;

    shape.contained = (enum brume_contained)n[1];
    memcpy(shape.a, n + 2, sizeof shape.a);
    memcpy(shape.b, n + 5, sizeof shape.b);
    shape.radius = n[5];
    shape.threshold = n[8];
    shape.accuracy = n[9];
    shape.max_gradient = n[10];
    shape.open = n[11] != 0;
    shape.evaluate = count > 12;
    if (shape.evaluate)
        memcpy(shape.evaluate_factors, n + 12, sizeof shape.evaluate_factors);
    return solid_isosurface(arena, &shape, n[0], solid, err);
}

#define SOLID_KIND(name, tolerance, either, thin)                             \
    {#name, build_##name, name##_roots, name##_normal, name##_inside,         \
     tolerance, either, thin}
static const struct solid_kind solid_kinds[] = {
    SOLID_KIND(torus, 1e-6, false, false),
    SOLID_KIND(quadric, 1e-6, false, false),
    SOLID_KIND(poly, 1e-6, false, false),
    SOLID_KIND(superellipsoid, 1e-6, false, false),
    SOLID_KIND(ovus, 1e-6, false, false),
    SOLID_KIND(blob, 1e-5, false, false),
    SOLID_KIND(prism, 1e-6, true, false),
    SOLID_KIND(lathe, 1e-5, true, false),
    SOLID_KIND(sor, 1e-6, false, false),
    SOLID_KIND(sphere_sweep, 1e-5, false, false),
    SOLID_KIND(isosurface, 1e-4, false, false),
    SOLID_KIND(julia, 1e-4, false, true),
};
enum { SOLID_KINDS = sizeof solid_kinds / sizeof *solid_kinds };

#endif
