/* truth.h - for tests that hold a rendering against a number known from
 * elsewhere: small scenes through brume.h, and means with standard errors. */
#ifndef TESTS_UNIT_TRUTH_H
#define TESTS_UNIT_TRUTH_H
/* cmocka.h wants these before it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include "core/brume.h"

#define TRUTH_PI 3.14159265358979323846

/* A mean over the pixels of a picture that ought to be the same in each. */
struct estimate {
    double mean[3], error[3];   /* per channel; error is the standard error */
    double opacity;
    struct brume_stats stats;
};

static inline struct brume_error *truth_error(void)
{
    static struct brume_error err;
    if (err.code != BRUME_OK)
        fail_msg("%s", err.text);
    return &err;
}

/* A scene whose camera at z = -distance looks along +z through a window of
 * `window` on a side, at distance 1. */
static inline brume_scene *truth_scene(const struct brume_globals *globals,
                                       double distance, double window)
{
    brume_scene *s = brume_scene_new(truth_error());
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.location[2] = -distance;
    c.right[0] = c.up[1] = window;
    assert_non_null(s);
    assert_true(brume_set_camera(s, &c, truth_error()));
    assert_true(brume_set_globals(s, globals, truth_error()));
    return s;
}

/* A hollow shape full of the medium. */
static inline void truth_fill(brume_scene *s, struct brume_shape shape,
                              const struct brume_medium *medium)
{
    int m = brume_add_medium(s, medium, truth_error());
    assert_true(m >= 0);
    shape.interior = brume_add_interior(s, &m, 1, truth_error());
    shape.hollow = true;
    assert_true(brume_add_shape(s, &shape, truth_error()) >= 0);
}

static inline struct brume_shape truth_box(double half_width, double z0,
                                           double z1)
{
    struct brume_shape b = BRUME_SHAPE_INIT;
    b.kind = BRUME_SHAPE_BOX;
    b.a[0] = b.a[1] = -half_width;
    b.b[0] = b.b[1] = half_width;
    b.a[2] = z0;
    b.b[2] = z1;
    return b;
}

static inline struct brume_medium truth_medium(double sigma_a, double sigma_s,
                                               double g)
{
    struct brume_medium m = BRUME_MEDIUM_INIT;
    for (int i = 0; i < 3; i++) {
        m.absorption[i] = sigma_a;
        m.scattering[i] = sigma_s;
    }
    m.phase = g != 0.0 ? BRUME_PHASE_HENYEY_GREENSTEIN
                       : BRUME_PHASE_ISOTROPIC;
    m.eccentricity = g;
    return m;
}

/* Renders pixels x pixels and frees the scene. */
static inline struct estimate truth_render(brume_scene *s, int pixels,
                                           int spp)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    struct estimate out = {.opacity = 0.0};
    int n = pixels * pixels;
    o.width = o.height = pixels;
    o.spp = spp;
    assert_true(brume_render(s, &o, &f, truth_error()));
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < n; i++) {
            double x = (double)f.radiance[3 * i + c];
            sum += x;
            squares += x * x;
            out.opacity += (double)f.opacity[3 * i + c] / (3.0 * n);
        }
        out.mean[c] = sum / n;
        out.error[c] = sqrt(fmax(squares / n - out.mean[c] * out.mean[c],
                                 0.0) / (n - 1));
    }
    out.stats = f.stats;
    brume_frame_free(&f);
    brume_scene_free(s);
    return out;
}

/* |z| < 4 in each channel, each of a truth of its own, with a standard error
 * of at most `most` of that; the uncertainty u of the truth counts too
 * (METHODS.md 13). */
static inline void truth_check_colors(const char *what,
                                      const struct estimate *e,
                                      const double truth[3], double u,
                                      double most)
{
    assert_int_equal(e->stats.majorant_exceeded, 0);
    assert_int_equal(e->stats.rejected, 0);
    for (int c = 0; c < 3; c++) {
        double s = sqrt(e->error[c] * e->error[c] + u * u);
        double z = (e->mean[c] - truth[c]) / s;
        if (!(fabs(z) < 4.0) || !(e->error[c] <= most * truth[c]))
            fail_msg("%s, channel %d: %.9g +- %.2g, truth %.9g, z %.2f",
                     what, c, e->mean[c], e->error[c], truth[c], z);
    }
}

/* The same of all. */
static inline void truth_check(const char *what, const struct estimate *e,
                               double truth, double u, double most)
{
    const double all[3] = {truth, truth, truth};
    truth_check_colors(what, e, all, u, most);
}

#endif
