/* solid.h - builders of the further primitives: they check what they are told
 * and lay out the data that core/physics/solid_X.h reads.
 *
 * Parameters have the units and the order that brume.5 gives them; what is
 * not finite or has no shape is an error. Data lie in the arena. */
#ifndef CORE_SOLID_H
#define CORE_SOLID_H
#include <stdbool.h>
#include <stddef.h>
#include "core/brume.h"
#include "lib/arena.h"
#include "lib/error.h"

struct solid {
    double *data;               /* flat, without pointers: can be moved     */
    size_t count;
    bool bounded;               /* else min and max mean nothing            */
    double min[3], max[3];      /* contains the solid                       */
};

/* Space for `count` numbers; bounds are left. False: no memory. */
bool solid_alloc(struct arena *arena, size_t count, struct solid *solid,
                 struct brume_error *err);
/* Whether all numbers are finite; else an error that names `what`. */
bool solid_finite(const double *numbers, size_t count, const char *what,
                  struct brume_error *err);
void solid_bounds(struct solid *solid, double x0, double y0, double z0,
                  double x1, double y1, double z1);

/* major >= 0, minor > 0. */
bool solid_torus(struct arena *arena, double major, double minor,
                 struct solid *solid, struct brume_error *err);

/* A to J, as solid_quadric.h has them. */
bool solid_quadric(struct arena *arena, const double coefficients[10],
                   struct solid *solid, struct brume_error *err);

/* Order 2 to 35; solid_poly_terms(order) coefficients in POV-Ray's order. */
bool solid_poly(struct arena *arena, int order, const double *coefficients,
                struct solid *solid, struct brume_error *err);
/* (order + 1) (order + 2) (order + 3) / 6 */
int solid_poly_terms(int order);
/* Where the coefficient of x^x y^y z^z is among them; x + y + z <= order. */
int solid_poly_index(int order, int x, int y, int z);

/* e > 0, n > 0. */
bool solid_superellipsoid(struct arena *arena, double e, double n,
                          struct solid *solid, struct brume_error *err);

/* Radii of the bottom ball (above 0) and of the top one (0 or more). */
bool solid_ovus(struct arena *arena, double bottom, double top,
                struct solid *solid, struct brume_error *err);

/* BRUME_BLOB_NUMBERS a component, as brume.h has them; threshold > 0. A
 * component of strength 0 is left out. */
bool solid_blob(struct arena *arena, double threshold,
                const double *components, size_t count, struct solid *solid,
                struct brume_error *err);

/* Points of x and z; sub-shapes one after the other, each closed by its first
 * point on the curve (linear ones close themselves at the end). The heights
 * come in any order. */
bool solid_prism(struct arena *arena, enum brume_curve curve, bool conic,
                 bool open, double height_1, double height_2,
                 const double *points, size_t count, struct solid *solid,
                 struct brume_error *err);

/* Points of distance from the axis (0 or more on the curve) and height. */
bool solid_lathe(struct arena *arena, enum brume_curve curve,
                 const double *points, size_t count, struct solid *solid,
                 struct brume_error *err);

/* Points of radius and height, 4 or more; the first and the last only give
 * slopes. Between them radii are 0 or more and heights rise. */
bool solid_sor(struct arena *arena, bool open, const double *points,
               size_t count, struct solid *solid, struct brume_error *err);

/* Spheres of x, y, z and radius (0 or more): 2 or more for a linear spline, 4
 * or more for a cubic one or a B-spline. */
bool solid_sphere_sweep(struct arena *arena, enum brume_curve curve,
                        const double *spheres, size_t count,
                        struct solid *solid, struct brume_error *err);

/* `numbers` are those of BRUME_SHAPE_JULIA in brume.h. Quaternions have sqr
 * and cube; the slice's normal has a fourth coordinate that is not 0; a
 * precision below 1 is taken as 1. */
bool solid_julia(struct arena *arena, enum brume_julia_kind kind,
                 enum brume_julia_function function, int iterations,
                 double precision, const double numbers[11],
                 struct solid *solid, struct brume_error *err);

/* Members that BRUME_SHAPE_ISOSURFACE reads, but for its function: `number` is
 * kept at ISOSURFACE_FUNCTION of the data for who evaluates it. Accuracy and
 * gradients are above 0; of the adapting gradient's factors the first is the
 * least gradient, the second 1 or more, the third 0 to 1. */
bool solid_isosurface(struct arena *arena, const struct brume_shape *shape,
                      double number, struct solid *solid,
                      struct brume_error *err);

#endif
