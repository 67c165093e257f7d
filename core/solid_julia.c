/* Julia fractals: their slice, and the ball that they are looked for in. */
#include "core/physics/solid_julia.h"
#include "core/solid.h"
#include <math.h>
#include <string.h>

_Static_assert((int)BRUME_JULIA_PWR == (int)JULIA_PWR, "same functions");

static double length4(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
}

static bool julia_check(enum brume_julia_kind kind,
                        enum brume_julia_function function, int iterations,
                        double precision, const double numbers[11],
                        struct brume_error *err)
{
    if (kind == BRUME_JULIA_QUATERNION && function != BRUME_JULIA_SQR &&
        function != BRUME_JULIA_CUBE)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "julia_fractal of quaternions; expected the "
                          "function sqr or cube");
    if (iterations < 1)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "julia_fractal of %d iterations; expected 1 or more",
                          iterations);
    if (!solid_finite(&precision, 1, "julia_fractal's precision", err) ||
        !solid_finite(numbers, 11, "julia_fractal", err))
        return false;
    if (numbers[7] == 0)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "julia_fractal sliced along its fourth coordinate");
    return true;
}

/* What may not be left, as POV-Ray's trace and extents tell: the manual's 4,
 * but 1 + |c| for quaternions. */
static double julia_radius(enum brume_julia_kind kind, const double *c)
{
    return kind == BRUME_JULIA_QUATERNION ? 1 + length4(c) : 4;
}

bool solid_julia(struct arena *arena, enum brume_julia_kind kind,
                 enum brume_julia_function function, int iterations,
                 double precision, const double numbers[11],
                 struct solid *solid, struct brume_error *err)
{
    const double *normal = numbers + 4;

    if (!julia_check(kind, function, iterations, precision, numbers, err) ||
        !solid_alloc(arena, JULIA_POWER + 2, solid, err))
        return false;
    double r = julia_radius(kind, numbers), *data = solid->data;
    data[0] = kind == BRUME_JULIA_HYPERCOMPLEX;
    data[1] = function;
    data[2] = iterations;
    data[3] = 0.5 / fmax(precision, 1);
    data[4] = r;
    memcpy(data + JULIA_HEAD, numbers, 4 * sizeof *numbers);
    for (int i = 0; i < 3; i++)
        data[JULIA_SLICE + i] = -normal[i] / normal[3];
    data[JULIA_SLICE + 3] = numbers[8] * length4(normal) / normal[3];
    data[JULIA_POWER] = numbers[9];
    data[JULIA_POWER + 1] = numbers[10];
    solid_bounds(solid, -r, -r, -r, r, r, r);
    return true;
}
