/* Prisms, lathes and surfaces of revolution: their curves as segments. */
#include "core/curve.h"
#include "core/physics/solid_lathe.h"
#include "core/physics/solid_prism.h"
#include "core/physics/solid_sor.h"
#include "core/solid.h"
#include <math.h>
#include <string.h>

/* The segment that begins at point p, between two points of the curve. */
static void segment_fill(enum brume_curve curve, const double *p,
                         const double *start, const double *end, double *out)
{
    for (size_t i = 0; i < 2; i++) {
        curve_cubic(curve, p + i, 2, out + 4 * i);
        out[CURVE_START + i] = start[i];
        out[CURVE_END + i] = end[i];
    }
}

/* Widens x0, x1, y0, y1. */
static void segment_box(const double *segment, double box[4])
{
    curve_range(segment, &box[0], &box[1]);
    curve_range(segment + 4, &box[2], &box[3]);
}

static bool same_point(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

static bool points_check(const char *what, enum brume_curve curve,
                         const double *points, size_t count,
                         struct brume_error *err)
{
    if (curve == BRUME_CURVE_B_SPLINE)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "%s along a B-spline; expected a linear, quadratic, "
                          "cubic or Bezier spline",
                          what);
    if (curve_segments(curve, count) > 0)
        return solid_finite(points, 2 * count, what, err);
    return brume_fail(err, BRUME_ERR_SCENE,
                      "%s of %zu points: a %s spline takes %s", what, count,
                      curve_shape_of(curve)->name,
                      curve == BRUME_CURVE_BEZIER      ? "4 for each segment"
                      : curve == BRUME_CURVE_LINEAR    ? "2 or more"
                      : curve == BRUME_CURVE_QUADRATIC ? "3 or more"
                                                       : "4 or more");
}

/* ---- prisms */

struct prism_curve {
    enum brume_curve curve;
    const double *points;
    size_t count;
    double *out; /* room for count segments                  */
    size_t segments;
};

/* One sub-shape from the point `at` on: the point after it, 0 if it does not
 * close. A linear one that is the last is closed by a segment of its own. */
static size_t prism_loop(struct prism_curve *c, size_t at)
{
    const struct curve_shape *s = curve_shape_of(c->curve);
    const double *first = c->points + 2 * (at + s->start);

    for (; at + s->points <= c->count; at += s->step) {
        const double *p = c->points + 2 * at;
        const double *end = p + 2 * s->end;
        segment_fill(c->curve, p, p + 2 * s->start, end,
                     c->out + CURVE_SEGMENT * c->segments++);
        if (same_point(end, first))
            return at + s->points;
    }
    if (c->curve != BRUME_CURVE_LINEAR)
        return 0;
    const double *last = c->points + 2 * (c->count - 1);
    const double closing[4] = {last[0], last[1], first[0], first[1]};
    segment_fill(c->curve, closing, closing, closing + 2,
                 c->out + CURVE_SEGMENT * c->segments++);
    return c->count;
}

static bool prism_curves(struct prism_curve *c, struct brume_error *err)
{
    size_t at = 0, points = curve_shape_of(c->curve)->points;

    while (at + points <= c->count) {
        size_t next = prism_loop(c, at);
        if (next == 0)
            return brume_fail(err, BRUME_ERR_SCENE,
                              "prism whose %s spline from point %zu on does "
                              "not return to where it starts",
                              curve_shape_of(c->curve)->name, at + 1);
        at = next;
    }
    if (at == c->count)
        return true;
    return brume_fail(err, BRUME_ERR_SCENE,
                      "prism with %zu points left after its last curve",
                      c->count - at);
}

/* The box of the curves, at both heights if the sweep is conic. */
static void prism_bounds(const struct prism_curve *c, bool conic,
                         const double y[2], struct solid *solid)
{
    double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    double wide[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};

    for (size_t i = 0; i < c->segments; i++)
        segment_box(c->out + CURVE_SEGMENT * i, box);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++) {
            double x = conic ? box[i] * y[k] : box[i];
            int lo = i & ~1;
            wide[lo] = fmin(wide[lo], x);
            wide[lo + 1] = fmax(wide[lo + 1], x);
        }
    solid->data[5] = fmax(box[1] - box[0], box[3] - box[2]);
    solid_bounds(solid, wide[0], y[0], wide[2], wide[1], y[1], wide[3]);
}

bool solid_prism(struct arena *arena, enum brume_curve curve, bool conic,
                 bool open, double height_1, double height_2,
                 const double *points, size_t count, struct solid *solid,
                 struct brume_error *err)
{
    const double y[2] = {fmin(height_1, height_2), fmax(height_1, height_2)};
    struct prism_curve c = {curve, points, count, NULL, 0};

    if (curve == BRUME_CURVE_LINEAR && count < 3)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "prism of %zu points; expected 3 or more", count);
    if (!points_check("prism", curve, points, count, err) ||
        !solid_finite(y, 2, "prism's heights", err) ||
        !solid_alloc(arena, PRISM_HEAD + CURVE_SEGMENT * count, solid, err))
        return false;
    c.out = solid->data + PRISM_HEAD;
    if (!prism_curves(&c, err))
        return false;
    memcpy(solid->data, y, sizeof y);
    solid->data[2] = conic;
    solid->data[3] = open;
    solid->data[4] = (double)c.segments;
    prism_bounds(&c, conic, y, solid);
    return true;
}

/* ---- lathes */

/* Only the control points may lie beyond the axis. */
static bool lathe_radii(enum brume_curve curve, const double *points,
                        size_t count, struct brume_error *err)
{
    const struct curve_shape *s = curve_shape_of(curve);

    for (size_t i = 0; i + s->points <= count; i += s->step)
        for (size_t k = s->start; k <= s->end; k += s->end - s->start)
            if (points[2 * (i + k)] < 0)
                return brume_fail(err, BRUME_ERR_SCENE,
                                  "lathe's point %zu lies %g beyond the axis",
                                  i + k + 1, -points[2 * (i + k)]);
    return true;
}

bool solid_lathe(struct arena *arena, enum brume_curve curve,
                 const double *points, size_t count, struct solid *solid,
                 struct brume_error *err)
{
    const struct curve_shape *s = curve_shape_of(curve);
    size_t segments = curve_segments(curve, count);
    double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};

    if (!points_check("lathe", curve, points, count, err) ||
        !lathe_radii(curve, points, count, err) ||
        !solid_alloc(arena, LATHE_HEAD + CURVE_SEGMENT * segments, solid, err))
        return false;
    for (size_t i = 0; i < segments; i++) {
        const double *p = points + 2 * s->step * i;
        double *out = solid->data + LATHE_HEAD + CURVE_SEGMENT * i;
        segment_fill(curve, p, p + 2 * s->start, p + 2 * s->end, out);
        segment_box(out, box);
    }
    double r = fmax(box[1], -box[0]), half = (box[3] - box[2]) / 2;
    solid->data[0] = (double)segments;
    solid->data[1] = 2 * fmax(r, half);
    solid->data[2] = (box[2] + box[3]) / 2;
    solid->data[3] = 1.001 * sqrt(r * r + half * half);
    solid_bounds(solid, -r, box[2], -r, r, box[3], r);
    return true;
}

/* ---- surfaces of revolution */

static bool sor_check(const double *points, size_t count,
                      struct brume_error *err)
{
    if (count < 4)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "surface of revolution of %zu points; expected 4 "
                          "or more",
                          count);
    if (!solid_finite(points, 2 * count, "surface of revolution", err))
        return false;
    for (size_t i = 1; i + 1 < count; i++) {
        const double *p = points + 2 * i;
        if (p[0] < 0)
            return brume_fail(err, BRUME_ERR_SCENE,
                              "surface of revolution: point %zu has the "
                              "radius %g; expected 0 or more",
                              i + 1, p[0]);
        if (i > 1 && !(p[1] > p[-1]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "surface of revolution: point %zu at height "
                              "%g is not above the one before",
                              i + 1, p[1]);
    }
    return true;
}

/* The slope of the squared radius at the middle one of three points. */
static double sor_slope(const double *p)
{
    return 2 * p[2] * (p[4] - p[0]) / (p[5] - p[1]);
}

/* From p[2], p[3] to p[4], p[5]: squared radii and slopes at both ends. */
static void sor_segment(const double *p, double *out, double *most)
{
    double h = p[5] - p[3], r0 = p[2] * p[2], r1 = p[4] * p[4];
    double s0 = sor_slope(p), s1 = sor_slope(p + 2), lo = 0;
    double unit[4] = {r0, s0 * h, 3 * (r1 - r0) - (2 * s0 + s1) * h,
                      2 * (r0 - r1) + (s0 + s1) * h};

    curve_range(unit, &lo, most);
    out[0] = p[3];
    out[1] = p[5];
    out[2] = r0;
    out[3] = r1;
    for (int i = 0; i < 4; i++)
        out[SOR_CUBIC + i] = unit[i] / pow(h, i);
}

bool solid_sor(struct arena *arena, bool open, const double *points,
               size_t count, struct solid *solid, struct brume_error *err)
{
    size_t segments = count - 3;
    double most = 0;

    if (!sor_check(points, count, err) ||
        !solid_alloc(arena, SOR_HEAD + SOR_SEGMENT * segments, solid, err))
        return false;
    for (size_t i = 0; i < segments; i++)
        sor_segment(points + 2 * i, solid->data + SOR_HEAD + SOR_SEGMENT * i,
                    &most);
    double low = points[3], high = points[2 * count - 3], r = sqrt(most);
    if (!solid_finite(solid->data, solid->count, "surface of revolution", err))
        return false;
    solid->data[0] = (double)segments;
    solid->data[1] = open;
    solid->data[2] = (low + high) / 2;
    solid->data[3] = 1.001 * sqrt(most + (high - low) * (high - low) / 4);
    solid_bounds(solid, -r, low, -r, r, high, r);
    return true;
}
