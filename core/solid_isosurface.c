/* Isosurfaces: container, accuracy and gradient. */
#include "core/physics/solid_isosurface.h"
#include "core/solid.h"
#include <math.h>
#include <string.h>

static bool above_zero(double number, const char *what, struct brume_error *err)
{
    if (number > 0 && isfinite(number))
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "isosurface's %s is %g; expected a number above 0", what,
                      number);
}

static bool gradient_check(const struct brume_shape *shape,
                           struct brume_error *err)
{
    const double *f = shape->evaluate_factors;

    if (!shape->evaluate)
        return above_zero(shape->max_gradient, "max_gradient", err);
    if (!above_zero(f[0], "least gradient", err))
        return false;
    if (f[1] >= 1 && isfinite(f[1]) && f[2] >= 0 && f[2] <= 1)
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "isosurface's gradient adapts by %g and %g; expected 1 "
                      "or more, and 0 to 1",
                      f[1], f[2]);
}

static bool container_check(const struct brume_shape *shape,
                            struct brume_error *err)
{
    bool good = true;

    if (!solid_finite(shape->a, 3, "isosurface's container", err))
        return false;
    if (shape->contained == BRUME_CONTAINED_SPHERE)
        return above_zero(shape->radius, "container's radius", err);
    if (!solid_finite(shape->b, 3, "isosurface's container", err))
        return false;
    for (int i = 0; i < 3; i++)
        good &= shape->a[i] != shape->b[i];
    return good || brume_fail(err, BRUME_ERR_SCENE,
                              "isosurface in a box without volume");
}

static void container_fill(const struct brume_shape *shape, struct solid *solid)
{
    const double *a = shape->a, *b = shape->b;
    double *c = solid->data + ISOSURFACE_CONTAINER, r = shape->radius;

    solid->data[0] = shape->contained == BRUME_CONTAINED_SPHERE;
    if (shape->contained == BRUME_CONTAINED_SPHERE) {
        memcpy(c, a, 3 * sizeof *c);
        c[3] = r;
        solid_bounds(solid, a[0] - r, a[1] - r, a[2] - r, a[0] + r, a[1] + r,
                     a[2] + r);
        return;
    }
    for (int i = 0; i < 3; i++) {
        c[i] = fmin(a[i], b[i]);
        c[3 + i] = fmax(a[i], b[i]);
    }
    solid_bounds(solid, c[0], c[1], c[2], c[3], c[4], c[5]);
}

bool solid_isosurface(struct arena *arena, const struct brume_shape *shape,
                      double number, struct solid *solid,
                      struct brume_error *err)
{
    if (!container_check(shape, err) || !gradient_check(shape, err) ||
        !above_zero(shape->accuracy, "accuracy", err) ||
        !solid_finite(&shape->threshold, 1, "isosurface's threshold", err) ||
        !solid_alloc(arena, ISOSURFACE_DATA, solid, err))
        return false;
    container_fill(shape, solid);
    double *data = solid->data;
    data[ISOSURFACE_THRESHOLD] = shape->threshold;
    data[ISOSURFACE_ACCURACY] = shape->accuracy;
    data[ISOSURFACE_GRADIENT] = shape->max_gradient;
    data[ISOSURFACE_OPEN] = shape->open;
    data[ISOSURFACE_ADAPTS] = shape->evaluate;
    memcpy(data + ISOSURFACE_FACTORS, shape->evaluate_factors,
           sizeof shape->evaluate_factors);
    data[ISOSURFACE_FUNCTION] = number;
    return true;
}
