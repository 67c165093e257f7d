#include "core/solid.h"
#include <math.h>
#include <string.h>

bool solid_alloc(struct arena *arena, size_t count, struct solid *solid,
                 struct brume_error *err)
{
    memset(solid, 0, sizeof *solid);
    solid->data = arena_array(arena, count, sizeof *solid->data);
    solid->count = count;
    return solid->data || brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
}

bool solid_finite(const double *numbers, size_t count, const char *what,
                  struct brume_error *err)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "%s: number %zu is %g; expected a finite one",
                              what, i + 1, numbers[i]);
    return true;
}

void solid_bounds(struct solid *solid, double x0, double y0, double z0,
                  double x1, double y1, double z1)
{
    const double min[3] = {x0, y0, z0}, max[3] = {x1, y1, z1};

    solid->bounded = true;
    memcpy(solid->min, min, sizeof min);
    memcpy(solid->max, max, sizeof max);
}

bool solid_torus(struct arena *arena, double major, double minor,
                 struct solid *solid, struct brume_error *err)
{
    double r = major + minor;

    if (!(major >= 0) || !(minor > 0) || !isfinite(r))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "torus of radii %g and %g; expected a major radius "
                          "of 0 or more and a minor radius above 0",
                          major, minor);
    if (!solid_alloc(arena, 2, solid, err))
        return false;
    /* The two surfaces of what is nearly a sphere can't be told apart. */
    solid->data[0] = major < 1e-6 * minor ? 0 : major;
    solid->data[1] = minor;
    solid_bounds(solid, -r, -minor, -r, r, minor, r);
    return true;
}

static bool all_zero(const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (numbers[i] != 0)
            return false;
    return true;
}

bool solid_quadric(struct arena *arena, const double coefficients[10],
                   struct solid *solid, struct brume_error *err)
{
    if (!solid_finite(coefficients, 10, "quadric", err))
        return false;
    if (all_zero(coefficients, 9))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "quadric with no term of x, y or z");
    if (!solid_alloc(arena, 10, solid, err))
        return false;
    memcpy(solid->data, coefficients, 10 * sizeof *coefficients);
    return true;
}

int solid_poly_terms(int order)
{
    return (order + 1) * (order + 2) * (order + 3) / 6;
}

int solid_poly_index(int order, int x, int y, int z)
{
    int below = order - x; /* powers that are left to y and z          */
    int before = below * (below + 1) * (below + 2) / 6;
    int row = below - y;
    return before + row * (row + 1) / 2 + row - z;
}

bool solid_poly(struct arena *arena, int order, const double *coefficients,
                struct solid *solid, struct brume_error *err)
{
    if (order < 2 || order > 35)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "polynomial of order %d; expected 2 to 35", order);
    size_t count = (size_t)solid_poly_terms(order);
    if (!solid_finite(coefficients, count, "polynomial", err))
        return false;
    if (all_zero(coefficients, count - 1))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "polynomial with no term of x, y or z");
    if (!solid_alloc(arena, count + 1, solid, err))
        return false;
    solid->data[0] = order;
    memcpy(solid->data + 1, coefficients, count * sizeof *coefficients);
    return true;
}

bool solid_superellipsoid(struct arena *arena, double e, double n,
                          struct solid *solid, struct brume_error *err)
{
    /* Beyond, 2/e and its reciprocal are no finite numbers of use. */
    const double least = 1e-6, most = 1e6;

    if (!(e >= least && e <= most && n >= least && n <= most))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "superellipsoid of exponents %g and %g; expected "
                          "%g to %g",
                          e, n, least, most);
    if (!solid_alloc(arena, 2, solid, err))
        return false;
    solid->data[0] = 2 / e;
    solid->data[1] = 2 / n;
    solid_bounds(solid, -1, -1, -1, 1, 1, 1);
    return true;
}

bool solid_ovus(struct arena *arena, double bottom, double top,
                struct solid *solid, struct brume_error *err)
{
    if (!(bottom > 0) || !(top >= 0) || !isfinite(bottom + top))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "ovus of radii %g and %g; expected a bottom radius "
                          "above 0 and a top radius of 0 or more",
                          bottom, top);
    if (!solid_alloc(arena, 6, solid, err))
        return false;
    /* The arc touches both from outside: its middle is arc - bottom from the
     * one and arc - top from the other. */
    double arc = 2 * fmax(bottom, top), to_bottom = arc - bottom;
    double to_top = arc - top;
    double height = (bottom * bottom - to_top * to_top +
                     to_bottom * to_bottom) /
                    (2 * bottom);
    double beyond = sqrt(fmax(to_bottom * to_bottom - height * height, 0));
    bool ball = top >= 2 * bottom;
    const double data[6] = {bottom, top, arc, beyond, height, ball};
    double wide = ball ? top : arc - beyond;
    memcpy(solid->data, data, sizeof data);
    solid_bounds(solid, -wide, ball ? bottom - top : -bottom, -wide, wide,
                 bottom + top, wide);
    return true;
}
