/* Sphere sweeps: their splines as segments, with a ball around each. */
#include "core/curve.h"
#include "core/physics/solid_sphere_sweep.h"
#include "core/solid.h"
#include <math.h>
#include <string.h>

static bool sweep_check(enum brume_curve curve, const double *spheres,
                        size_t count, struct brume_error *err)
{
    if (curve != BRUME_CURVE_LINEAR && curve != BRUME_CURVE_CUBIC &&
        curve != BRUME_CURVE_B_SPLINE)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "sphere_sweep along a %s spline; expected a linear "
                          "or cubic one or a B-spline",
                          curve_shape_of(curve)->name);
    if (curve_segments(curve, count) == 0)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "sphere_sweep of %zu spheres; expected %zu or more",
                          count, curve_shape_of(curve)->points);
    if (!solid_finite(spheres, 4 * count, "sphere_sweep", err))
        return false;
    for (size_t i = 0; i < count; i++)
        if (spheres[4 * i + 3] < 0)
            return brume_fail(err, BRUME_ERR_SCENE,
                              "sphere_sweep: sphere %zu has the radius %g; "
                              "expected 0 or more",
                              i + 1, spheres[4 * i + 3]);
    return true;
}

/* Ranges of x, y, z and of the radius, widened. */
struct sweep_range {
    double lo[4], hi[4];
};

static const struct sweep_range nothing = {
    {INFINITY, INFINITY, INFINITY, INFINITY},
    {-INFINITY, -INFINITY, -INFINITY, -INFINITY}};

static void ball_around(const struct sweep_range *range, double *ball)
{
    double half = 0;

    for (int k = 0; k < 3; k++) {
        ball[k] = (range->lo[k] + range->hi[k]) / 2;
        half += (range->hi[k] - ball[k]) * (range->hi[k] - ball[k]);
    }
    double r = fmax(fabs(range->lo[3]), fabs(range->hi[3]));
    ball[3] = (sqrt(half) + r) * (1 + 1e-9);
}

static void segment_fill(enum brume_curve curve, const double *spheres,
                         double *out, struct sweep_range *all)
{
    struct sweep_range own = nothing;

    for (size_t k = 0; k < 4; k++) {
        curve_cubic(curve, spheres + k, 4, out + 4 * k);
        curve_range(out + 4 * k, &own.lo[k], &own.hi[k]);
        all->lo[k] = fmin(all->lo[k], own.lo[k]);
        all->hi[k] = fmax(all->hi[k], own.hi[k]);
    }
    ball_around(&own, out + SWEEP_BALL);
}

/* The box of all spheres, at twice their radii for a cubic spline, is what
 * POV-Ray reports; it need not hold a curve that swings out. */
static void sweep_bounds(enum brume_curve curve, const double *spheres,
                         size_t count, const struct sweep_range *all,
                         struct solid *solid)
{
    double lo[3], hi[3], k = curve == BRUME_CURVE_CUBIC ? 2 : 1;
    double r = curve == BRUME_CURVE_CUBIC ? fmax(all->hi[3], -all->lo[3]) : 0;

    for (int i = 0; i < 3; i++) {
        lo[i] = r > 0 ? all->lo[i] - r : INFINITY;
        hi[i] = r > 0 ? all->hi[i] + r : -INFINITY;
        for (size_t s = 0; s < count; s++) {
            const double *sphere = spheres + 4 * s;
            lo[i] = fmin(lo[i], sphere[i] - k * sphere[3]);
            hi[i] = fmax(hi[i], sphere[i] + k * sphere[3]);
        }
    }
    solid_bounds(solid, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
}

bool solid_sphere_sweep(struct arena *arena, enum brume_curve curve,
                        const double *spheres, size_t count,
                        struct solid *solid, struct brume_error *err)
{
    struct sweep_range all = nothing;

    if (!sweep_check(curve, spheres, count, err))
        return false;
    size_t segments = curve_segments(curve, count);
    if (!solid_alloc(arena, SWEEP_HEAD + SWEEP_SEGMENT * segments, solid, err))
        return false;
    for (size_t i = 0; i < segments; i++)
        segment_fill(curve, spheres + 4 * i,
                     solid->data + SWEEP_HEAD + SWEEP_SEGMENT * i, &all);
    solid->data[0] = (double)segments;
    ball_around(&all, solid->data + 1);
    sweep_bounds(curve, spheres, count, &all, solid);
    return true;
}
