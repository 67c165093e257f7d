/* truth_scenes.h - a scene for each table of METHODS.md, section 13: batches
 * of its estimate, through brume.h alone. Lengths are mean free paths. */
#ifndef TESTS_UNIT_TRUTH_SCENES_H
#define TESTS_UNIT_TRUTH_SCENES_H
#include <stdlib.h>
#include <string.h>
#include "tests/unit/truth_walk.h"

/* What a row of a table asks. `p` are its parameters, family by family. */
struct truth_row {
    char name[64];
    void (*measure)(const struct truth_row *row, struct batches *b);
    double p[4];
    double truth, u;
    struct walk_plan plan; /* of a walk instead of a picture              */
    bool walked;
    double rare; /* the largest value of a sample, where most are
                               0; or 0                                     */
    bool sample; /* run by `make test` too                      */
};

enum { BATCH_PIXELS = 16 };

/* Pictures are so many pixels wide and high: on a GPU they are to be large. */
static inline int *batch_side(void)
{
    static int side = BATCH_PIXELS;
    return &side;
}

static inline int batch_pixels(void)
{
    return *batch_side();
}

static inline enum brume_backend batch_backend(void)
{
    const char *name = getenv("BACKEND");
    return name && strcmp(name, "cuda") == 0 ? BRUME_BACKEND_CUDA
                                             : BRUME_BACKEND_CPU;
}

/* Pictures' weighted sums over pixels; frees the scene. `weight` may be NULL
 * for the mean. */
static inline void batch_render(brume_scene *s, int pixels, struct batches *b,
                                const double *weight, int channel)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    int n = pixels * pixels;
    o.width = o.height = pixels;
    o.spp = b->spp;
    o.backend = batch_backend();
    for (int k = 0; k < b->count; k++) {
        struct brume_frame f;
        o.frame = b->frame + b->stride * (uint32_t)k;
        assert_true(brume_render(s, &o, &f, truth_error()));
        assert_int_equal(f.stats.majorant_exceeded, 0);
        assert_int_equal(f.stats.rejected, 0);
        b->mean[k] = 0.0;
        for (int i = 0; i < n; i++)
            b->mean[k] += (double)f.radiance[3 * i + channel] *
                          (weight ? weight[i] : 1.0 / n);
        brume_frame_free(&f);
    }
    brume_scene_free(s);
}

/* The pictures' means, or those of as many paths walked together. */
static inline void batch_measure(brume_scene *s, const struct truth_row *row,
                                 struct batches *b)
{
    size_t side = (size_t)batch_pixels();
    if (row->walked)
        truth_walk(s, &row->plan, side * side * (size_t)b->spp,
                   batch_backend() == BRUME_BACKEND_CUDA, b);
    else
        batch_render(s, batch_pixels(), b, NULL, 0);
}

static inline void batch_scale(struct batches *b, double factor, double more)
{
    for (int k = 0; k < b->count; k++)
        b->mean[k] = factor * b->mean[k] + more;
}

/* Room for the i-th of n estimates of which each of these is made. */
static inline struct batches batch_part(const struct batches *b, int i, int n)
{
    struct batches part = {.count = b->count, .spp = b->spp};
    part.frame = b->frame * (uint32_t)n + (uint32_t)i;
    part.stride = b->stride * (uint32_t)n;
    return part;
}

static inline void batch_add(struct batches *b, const struct batches *part,
                             double factor)
{
    for (int k = 0; k < b->count; k++)
        b->mean[k] += factor * part->mean[k];
}

static inline struct brume_globals batch_globals(bool multiple)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = multiple;
    return g;
}

/* The camera looks along (sine, 0, cosine) from z = -1. */
static inline void batch_tilt(brume_scene *s, double cosine)
{
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.location[2] = -1.0;
    c.direction[0] = sqrt(1.0 - cosine * cosine);
    c.direction[2] = cosine;
    c.right[0] = c.up[1] = 1e-6;
    assert_true(brume_set_camera(s, &c, truth_error()));
}

/* A slab of this depth, wide enough to have no sides. */
static inline brume_scene *batch_slab(bool multiple, double depth, double width,
                                      const struct brume_medium *m)
{
    struct brume_globals g = batch_globals(multiple);
    brume_scene *s = truth_scene(&g, 1.0, 1e-6);
    truth_fill(s, truth_box(width, 0.0, depth), m);
    return s;
}

static inline double slab_width(double depth)
{
    return 50.0 + 20.0 * depth;
}

/* A beam of unit irradiance with this cosine to +z, from beyond all media:
 * nothing dims parallel light behind the plane of its lamp. */
static inline void batch_beam(brume_scene *s, double cosine)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.parallel = true;
    l.location[0] = -1e5 * sqrt(1.0 - cosine * cosine);
    l.location[2] = -1e5 * cosine;
    for (int i = 0; i < 3; i++) {
        l.point_at[i] = 0.0;
        l.color[i] = 1.0 / (4.0 * TRUTH_PI);
    }
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
}

/* A sky of one radiance in front of the slab, another behind. */
static inline void batch_sky(brume_scene *s, float front, float back)
{
    const double turned[3][4] = {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}};
    const float texel[6] = {front, front, front, back, back, back};
    struct brume_sky sky = BRUME_SKY_INIT;
    sky.width = 1;
    sky.height = 2;
    sky.radiance = texel;
    sky.interpolate = false;
    for (int i = 0; i < 12; i++)
        sky.transform[i / 4][i % 4] = turned[i / 4][i % 4];
    assert_true(brume_set_sky(s, &sky, truth_error()));
}

/* p: depth. */
static inline void batch_t3(const struct truth_row *row, struct batches *b)
{
    struct brume_medium m = truth_medium(0.0, 1.0, 0.0);
    brume_scene *s = batch_slab(false, row->p[0], 3000.0, &m);
    batch_beam(s, 1.0);
    batch_render(s, batch_pixels(), b, NULL, 0);
}

/* p: mu_t, gamma in degrees, g. A black disc ends the ray. */
static inline void batch_t4(const struct truth_row *row, struct batches *b)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_material black = BRUME_MATERIAL_INIT;
    struct brume_shape disc = BRUME_SHAPE_INIT;
    double gamma = row->p[1] * TRUTH_PI / 180.0;
    globals.physical_units = true;
    brume_scene *s = truth_scene(&globals, 0.0, 1e-6);
    struct brume_medium m = truth_medium(0.0, row->p[0], row->p[2]);
    int medium = brume_add_medium(s, &m, truth_error());
    int interior = brume_add_interior(s, &medium, 1, truth_error());
    assert_true(brume_set_atmosphere(s, interior, truth_error()));
    l.location[0] = 4.0 * sin(gamma);
    l.location[2] = 4.0 * cos(gamma);
    l.media_attenuation = true;
    for (int i = 0; i < 3; i++) {
        l.color[i] = 1.0 / TRUTH_PI;
        black.ambient[i] = black.diffuse = 0.0;
    }
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    disc.kind = BRUME_SHAPE_DISC;
    disc.a[2] = 10.0;
    disc.b[2] = 1.0;
    disc.material = brume_add_material(s, &black, truth_error());
    assert_true(brume_add_shape(s, &disc, truth_error()) >= 0);
    batch_render(s, batch_pixels(), b, NULL, 0);
}

/* ---- T5: a point source in an infinite medium ---------------------------- */

/* The conservative medium ends at a black sphere, so that paths do: the
 * fluence there is 0 at 0.7104 beyond it [Milne; Hopf]. */
#define T5_EDGE 60.0

static inline void fill_space(brume_scene *s, double albedo)
{
    struct brume_medium m = truth_medium(1.0 - albedo, albedo, 0.0);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    if (albedo == 1.0) {
        ball.radius = T5_EDGE;
        truth_fill(s, ball, &m);
        return;
    }
    int medium = brume_add_medium(s, &m, truth_error());
    int interior = brume_add_interior(s, &medium, 1, truth_error());
    assert_true(brume_set_atmosphere(s, interior, truth_error()));
}

/* The table's formula [Case and Zweifel 1967], here only for how the fluence
 * varies across a shell: a atanh(k) = k by bisection. */
static inline double case_root(double a)
{
    double lo = 1e-9, hi = 1.0 - 1e-15;
    for (int i = 0; i < 200; i++) {
        double k = 0.5 * (lo + hi);
        if (a * atanh(k) < k)
            lo = k;
        else
            hi = k;
    }
    return 0.5 * (lo + hi);
}

static inline double case_fluence(double a, double r)
{
    const int n = 4000;
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        double m = (i + 0.5) / n;
        double p = 1.0 - a * m * atanh(m), q = 0.5 * a * TRUTH_PI * m;
        sum += exp(-r / m) / (m * m * (p * p + q * q));
    }
    sum /= 4.0 * TRUTH_PI * r * n;
    if (a == 0.0)
        return sum;
    if (a == 1.0)
        return sum + 3.0 / (4.0 * TRUTH_PI * r);
    double k = case_root(a), k2 = k * k;
    return sum + k2 * (1.0 - k2) * exp(-k * r) /
                     (2.0 * TRUTH_PI * r * a * (k2 + a - 1.0));
}

/* Int of fluence(x) / fluence(r) 4 pi x^2 dx from r - half to r + half, by
 * Gauss's rule. */
static inline double shell_volume(double a, double r, double half)
{
    double sum = 8.0 * r * r, edge = half * sqrt(0.6);
    double middle = case_fluence(a, r);
    for (int i = -1; i <= 1; i += 2) {
        double x = r + i * edge;
        sum += 5.0 * x * x * case_fluence(a, x) / middle;
    }
    return sum * 4.0 * TRUTH_PI * 2.0 * half / 18.0;
}

static inline void glowing_ball(brume_scene *s, double radius, double emission)
{
    struct brume_medium m = truth_medium(0.0, 0.0, 0.0);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    for (int i = 0; i < 3; i++)
        m.emission[i] = emission;
    ball.radius = radius;
    truth_fill(s, ball, &m);
}

/* p: albedo, distance. By reciprocity the radiance at the source, alike in
 * all directions, of a shell at that distance which emits 1 per length: a
 * ball less a ball. */
static inline void batch_t5(const struct truth_row *row, struct batches *b)
{
    double a = row->p[0], r = row->p[1], half = 0.05 * r, edge = 0.0;
    struct brume_globals g = batch_globals(true);
    brume_scene *s = truth_scene(&g, 0.0, 1e-6);
    fill_space(s, a);
    glowing_ball(s, r + half, 1.0);
    glowing_ball(s, r - half, -1.0);
    if (a == 1.0)
        edge = 3.0 / (4.0 * TRUTH_PI * (T5_EDGE + 0.7104461));
    batch_measure(s, row, b);
    batch_scale(b, 1.0 / shell_volume(a, r, half), edge);
}

/* ---- the same with a lamp: all directions, as three faces of a cube ------ */

enum { FACE_PIXELS = 128 };

/* Int_0^x Int_0^y (1 + u^2 + v^2)^(-3/2) du dv */
static inline double face_corner(double x, double y)
{
    return atan(x * y / sqrt(1.0 + x * x + y * y));
}

static inline void face_weights(double *weight)
{
    double h = 2.0 / FACE_PIXELS;
    for (int i = 0; i < FACE_PIXELS * FACE_PIXELS; i++) {
        double x = -1.0 + h * (i % FACE_PIXELS);
        double y = -1.0 + h * (double)(i / FACE_PIXELS);
        weight[i] = face_corner(x + h, y + h) - face_corner(x, y + h) -
                    face_corner(x + h, y) + face_corner(x, y);
    }
}

static inline void batch_face(const struct truth_row *row, int face,
                              struct batches *b)
{
    static const double toward[3][3] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
    static const double up[3][3] = {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}};
    static double weight[FACE_PIXELS * FACE_PIXELS];
    struct brume_globals g = batch_globals(true);
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_camera c = BRUME_CAMERA_INIT;
    g.physical_units = true;
    brume_scene *s = truth_scene(&g, 1.0, 1.0);
    fill_space(s, row->p[0]);
    c.location[2] = -row->p[1];
    c.right[0] = 2.0;
    for (int i = 0; i < 3; i++) {
        l.color[i] = 1.0 / (4.0 * TRUTH_PI * TRUTH_PI);
        c.direction[i] = toward[face][i];
        c.up[i] = 2.0 * up[face][i];
    }
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    assert_true(brume_set_camera(s, &c, truth_error()));
    face_weights(weight);
    batch_render(s, FACE_PIXELS, b, weight, 0);
}

/* p: albedo, distance. What comes straight is added: a point is not seen. */
static inline void batch_t5_lamp(const struct truth_row *row, struct batches *b)
{
    double r = row->p[1];
    batch_scale(b, 0.0, exp(-r) / (4.0 * TRUTH_PI * r * r));
    for (int face = 0; face < 3; face++) {
        struct batches part = batch_part(b, face, 3);
        batch_face(row, face, &part);
        batch_add(b, &part, face < 2 ? 1.0 : 4.0);
    }
}

/* ---- T6 to T9 ------------------------------------------------------------ */

/* p: g, albedo, depth; 1: reflectance. By reciprocity the share of a sky on
 * one side that comes back to the eye. */
static inline void batch_t6(const struct truth_row *row, struct batches *b)
{
    struct brume_medium m = truth_medium(1.0 - row->p[1], row->p[1], row->p[0]);
    brume_scene *s = batch_slab(true, row->p[2], slab_width(row->p[2]), &m);
    bool reflected = row->p[3] != 0.0;
    batch_sky(s, reflected ? 1.0f : 0.0f, reflected ? 0.0f : 1.0f);
    batch_measure(s, row, b);
}

/* p: out cosine, in cosine, < 0: from behind. */
static inline void batch_t6_radiance(const struct truth_row *row,
                                     struct batches *b)
{
    struct brume_medium m = truth_medium(0.1, 0.9, 0.0);
    brume_scene *s = batch_slab(true, 1.0, slab_width(1.0), &m);
    batch_tilt(s, row->p[0]);
    batch_beam(s, row->p[1]);
    batch_render(s, batch_pixels(), b, NULL, 0);
}

/* p: cosine. */
static inline void batch_t7_slab(const struct truth_row *row, struct batches *b)
{
    struct brume_medium m = truth_medium(0.1, 0.9, 0.0);
    for (int i = 0; i < 3; i++)
        m.emission[i] = m.absorption[i];
    brume_scene *s = batch_slab(true, 2.0, slab_width(2.0), &m);
    batch_tilt(s, row->p[0]);
    batch_render(s, batch_pixels(), b, NULL, 0);
}

/* p: optical radius, albedo. The power that leaves an emitting ball is 4 pi
 * times the integral of its picture. */
static inline void batch_ball(const struct truth_row *row, struct batches *b)
{
    double r = row->p[0], albedo = row->p[1];
    struct brume_medium m = truth_medium(1.0 - albedo, albedo, 0.0);
    struct brume_globals g = batch_globals(true);
    struct brume_camera c = BRUME_CAMERA_INIT;
    struct brume_shape ball = BRUME_SHAPE_INIT;
    for (int i = 0; i < 3; i++)
        m.emission[i] = 1.0;
    brume_scene *s = truth_scene(&g, 1.0, 1.0);
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[2] = -2.0 * r;
    c.right[0] = c.up[1] = 2.0 * r;
    assert_true(brume_set_camera(s, &c, truth_error()));
    ball.radius = r;
    truth_fill(s, ball, &m);
    batch_render(s, 2 * batch_pixels(), b, NULL, 0);
    batch_scale(b, 3.0 / (TRUTH_PI * r), 0.0);
}

/* How deep a walk looks; for albedo 1 the scene ends there, as paths would not,
 * and the rows add what passes it. */
static inline double half_space_depth(double albedo)
{
    return albedo == 1.0 ? 20.0 : 20.0 / sqrt(3.0 * (1.0 - albedo));
}

/* Behind a plane: floats of a deep box put a walk that is near its face
 * outside, for it finds anew what it is in (truths.md). */
static inline brume_scene *half_space(double albedo)
{
    double depth = half_space_depth(albedo);
    struct brume_medium m = truth_medium(1.0 - albedo, albedo, 0.0);
    struct brume_globals g = batch_globals(true);
    struct brume_shape plane = BRUME_SHAPE_INIT;
    if (albedo == 1.0)
        return batch_slab(true, depth, 50.0 + 2.0 * depth, &m);
    brume_scene *s = truth_scene(&g, 1.0, 1e-6);
    plane.kind = BRUME_SHAPE_PLANE;
    plane.radius = 0.0;
    plane.a[2] = -1.0;
    truth_fill(s, plane, &m);
    return s;
}

/* What a conservative slab passes of a beam with that cosine, by its escape
 * function K = sqrt(3)/4 H, and the radiance that it does not reflect for it;
 * good to exp(-depth) [van de Hulst 1980]. */
static inline double passed_share(double h)
{
    double k = 0.25 * sqrt(3.0) * h;
    return 4.0 * k / (3.0 * (half_space_depth(1.0) + 2.0 * 0.7104460896));
}

static inline double passed_radiance(double h, double cosine)
{
    return cosine / TRUTH_PI * 0.25 * sqrt(3.0) * h * passed_share(h);
}

/* p: albedo, cosine in and out, H for albedo 1, or 0: radiance per E,
 * a H^2 / (8 pi). */
static inline void batch_t8_h(const struct truth_row *row, struct batches *b)
{
    brume_scene *s = half_space(row->p[0]);
    batch_tilt(s, row->p[1]);
    batch_beam(s, row->p[1]);
    batch_measure(s, row, b);
    batch_scale(b, 1.0, passed_radiance(row->p[2], row->p[1]));
}

/* p: albedo, cosine, H for albedo 1, or 0: plane albedo, by reciprocity under
 * a sky of 1. */
static inline void batch_t8_plane(const struct truth_row *row,
                                  struct batches *b)
{
    brume_scene *s = half_space(row->p[0]);
    batch_tilt(s, row->p[1]);
    batch_sky(s, 1.0f, 0.0f);
    batch_measure(s, row, b);
    batch_scale(b, 1.0, passed_share(row->p[2]));
}

/* p: albedo, -, the H of the mean, or 0: the mean of the plane albedo over
 * cosine^2, by Gauss's rule. */
static inline void batch_t8_sphere(const struct truth_row *row,
                                   struct batches *b)
{
    static const double node[4] = {0.183434642495650, 0.525532409916329,
                                   0.796666477413627, 0.960289856497536};
    static const double weight[4] = {0.362683783378362, 0.313706645877887,
                                     0.222381034453374, 0.101228536290376};
    batch_scale(b, 0.0, 0.0);
    for (int i = 0; i < 8; i++) {
        double x = i < 4 ? node[i] : -node[i - 4], mu = 0.5 * (1.0 + x);
        struct truth_row at = *row;
        struct batches part = batch_part(b, i, 8);
        at.p[1] = at.plan.cosine = mu;
        batch_t8_plane(&at, &part);
        batch_add(b, &part, weight[i % 4] * mu);
    }
}

/* p: kelvin, channel, or 3 for luminance over that at 6500 K. A fire without
 * absorption, one length deep. */
static inline void batch_t13(const struct truth_row *row, struct batches *b)
{
    static const double luma[3] = {0.2126390, 0.7151687, 0.0721923};
    struct batches rgb[3] = {*b, *b, *b};
    for (int c = 0; c < 3; c++) {
        struct brume_globals g = BRUME_GLOBALS_INIT;
        brume_scene *s = truth_scene(&g, 2.0, 1e-6);
        struct brume_field t = BRUME_FIELD_INIT;
        struct brume_medium m = truth_medium(0.0, 0.0, 0.0);
        m.fire.on = m.fire.additive = true;
        m.fire.temperature = brume_add_field(s, &t, truth_error());
        m.fire.kelvin_scale = row->p[0];
        m.fire.reference = 6500.0;
        truth_fill(s, truth_box(10.0, 0.0, 1.0), &m);
        batch_render(s, 1, &rgb[c], NULL, c);
    }
    for (int k = 0; k < b->count; k++) {
        double luminance = 0.0;
        for (int c = 0; c < 3; c++)
            luminance += luma[c] * rgb[c].mean[k];
        b->mean[k] = row->p[1] == 3.0 ? luminance
                                      : rgb[(int)row->p[1]].mean[k] / luminance;
    }
}

#endif
