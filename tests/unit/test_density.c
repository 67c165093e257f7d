/* test_density.c - densities that are functions: what is drawn of them
 * against closed forms and against the function itself, and majorants. */
#include "tests/unit/truth.h"
#include <stdlib.h>
#include <string.h>
#include "core/physics/machine.h"
#include "core/physics/path.h"
#include "core/prepare.h"

/* (x, y, z) -> slope . p + offset, or its four multiples beside it */
static int add_linear(brume_scene *s, const double slope[3], double offset)
{
    struct brume_function *f = brume_function_new(s, 3, truth_error());
    for (int i = 0; i < 3; i++) {
        brume_function_parameter(f, i, truth_error());
        brume_function_constant(f, slope[i], truth_error());
        brume_function_op(f, BRUME_OP_MULTIPLY, truth_error());
        if (i > 0)
            brume_function_op(f, BRUME_OP_ADD, truth_error());
    }
    brume_function_constant(f, offset, truth_error());
    brume_function_op(f, BRUME_OP_ADD, truth_error());
    return brume_add_function(s, f, truth_error());
}

static int add_pattern(brume_scene *s, enum brume_pattern kind)
{
    const double generator = 2, warp[6] = {6, 2, .5, .7, .7, .7};
    bool bozo = kind == BRUME_PATTERN_BOZO;
    struct brume_function *f = brume_function_new(s, 3, truth_error());
    for (int i = 0; i < 3; i++)
        brume_function_parameter(f, i, truth_error());
    if (bozo)
        brume_function_warp(f, BRUME_WARP_TURBULENCE, warp, 6, truth_error());
    brume_function_pattern(f, kind, &generator, bozo, truth_error());
    return brume_add_function(s, f, truth_error());
}

static int add_field(brume_scene *s, int function)
{
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    field.function = function;
    int id = brume_add_field(s, &field, truth_error());
    assert_true(id >= 0);
    return id;
}

/* In a box of half width 1 from z = 0 to 2. */
static void fill(brume_scene *s, int field)
{
    struct brume_medium m = truth_medium(1, 0, 0);
    m.density[0] = field;
    m.densities = 1;
    truth_fill(s, truth_box(1, 0, 2), &m);
}

/* Absorption of density (x + 1) through 2 units: 1 - exp(-2 (x + 1)). */
static void test_linear(void **state)
{
    (void)state;
    const double slope[3] = {1, 0, 0};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[2] = -3;
    c.right[0] = c.up[1] = 2;
    brume_set_camera(s, &c, truth_error());
    fill(s, add_field(s, add_linear(s, slope, 1)));
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    o.width = o.height = 20;
    o.spp = 512;
    assert_true(brume_render(s, &o, &f, truth_error()));
    for (int i = 2; i < 18; i++) {
        double lo = (i - 10) / 10.0, sum = 0;
        for (int k = 0; k < 20; k++)
            sum += (double)f.opacity[3 * (20 * k + i)] / 20;
        /* the mean of exp over the pixel */
        double a = exp(-2 * (lo + 1)), b = exp(-2 * (lo + 1.1));
        if (!(fabs(sum - (1 - (a - b) / 0.2)) < 1.5e-3))
            fail_msg("pixel %d: %g, not %g", i, sum, 1 - (a - b) / 0.2);
    }
    assert_int_equal(f.stats.majorant_exceeded, 0);
    brume_frame_free(&f);
    brume_scene_free(s);
}

struct counted {
    int errors, beyond;
};

static void count_warning(void *user, const char *text)
{
    struct counted *c = user;
    c->errors += strstr(text, "with an error") != NULL;
    c->beyond += strstr(text, "unbounded") != NULL;
}

static struct flat *prepare(brume_scene *s, struct counted *warned)
{
    struct prepare job = {
        .scene = s, .threads = 1, .warn = count_warning, .user = warned};
    memset(warned, 0, sizeof *warned);
    struct flat *f = prepare_scene(&job, truth_error());
    assert_non_null(f);
    return f;
}

static double random_in(uint64_t *seed, double lo, double hi)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * (double)(*seed >> 40) / 16777216.0;
}

/* Of the medium's lattice at a point of unit space. */
static float majorant_at(const flat_scene *v, const flat_medium *m, vec3 p)
{
    vec3 c = affine_point(&m->to_cell, p);
    int cell[3];
    for (int i = 0; i < 3; i++) {
        cell[i] = hd_floor(vec3_get(c, i));
        if (cell[i] < 0 || cell[i] >= m->cells[i])
            return m->outside.density;
    }
    return v
        ->cells[m->cell + (uint64_t)cell[0] +
                (uint64_t)m->cells[0] *
                    ((uint64_t)cell[1] +
                     (uint64_t)m->cells[1] * (uint64_t)cell[2])]
        .density;
}

/* Draws from the box; root mean square of the error over that of the value.
 * Each lookup is within the majorant of its cell. */
static double compare(brume_scene *s, const struct flat *f, int function)
{
    const flat_scene *v = &f->view;
    const flat_medium *m = &v->media[0];
    uint64_t seed = 7;
    double wrong = 0, all = 0;
    for (int k = 0; k < 20000; k++) {
        double p[3] = {random_in(&seed, -1, 1), random_in(&seed, -1, 1),
                       random_in(&seed, 0, 2)};
        double q[3], out[BRUME_MAX_RESULTS];
        matrix_point(&f->to_unit, p, q);
        vec3 at = vec3_make((float)q[0], (float)q[1], (float)q[2]);
        field_point x = field_point_make(v, m->lead, at);
        float density = field_eval(v, &v->fields[m->density[0]], &x);
        if (!(density <= majorant_at(v, m, at)))
            fail_msg("density %g above %g", (double)density,
                     (double)majorant_at(v, m, at));
        brume_eval_function(s, function, p, 3, out, truth_error());
        double truth = fmax(out[0], 0);
        wrong += ((double)density - truth) * ((double)density - truth);
        all += truth * truth;
    }
    return sqrt(wrong / all);
}

/* How far what is drawn is off. */
static double evaluate(enum brume_pattern kind, struct counted *warned)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    int function = add_pattern(s, kind);
    fill(s, add_field(s, function));
    struct flat *f = prepare(s, warned);
    double error = compare(s, f, function);
    flat_free(f);
    brume_scene_free(s);
    return error;
}

static void test_bounds(void **state)
{
    (void)state;
    struct counted warned;
    assert_true(evaluate(BRUME_PATTERN_SPHERICAL, &warned) < 1e-6);
    assert_true(evaluate(BRUME_PATTERN_BOZO, &warned) < 1e-4);
    /* floats beside an edge fall on the other side */
    assert_true(evaluate(BRUME_PATTERN_CHECKER, &warned) < 0.01);
    assert_int_equal(warned.errors, 0);
    assert_int_equal(warned.beyond, 0);
}

/* Twice as wide by its transform, the second result, times 3. */
static void test_placed(void **state)
{
    (void)state;
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_function *fn = brume_function_new(s, 3, truth_error());
    brume_function_constant(fn, 100, truth_error());
    brume_function_parameter(fn, 2, truth_error());
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    field.function = brume_add_function(s, fn, truth_error());
    field.component = 1;
    field.scale = 3;
    field.transform[2][2] = 2;
    fill(s, brume_add_field(s, &field, truth_error()));
    struct counted warned;
    struct flat *f = prepare(s, &warned);
    for (int k = 1; k < 20; k++) {
        double p[3] = {0.3, -0.4, k / 10.0}, q[3];
        matrix_point(&f->to_unit, p, q);
        field_point x = field_point_make(
            &f->view, f->view.media[0].lead,
            vec3_make((float)q[0], (float)q[1], (float)q[2]));
        double got = (double)field_eval(&f->view, f->view.fields, &x);
        assert_true(fabs(got - 3 * p[2] / 2) < 1e-5);
    }
    flat_free(f);
    brume_scene_free(s);
}

/* <x + 1, 2, -1> as a colour: 1 - exp(-0.5 tau) through 2 units of it. */
static void test_colored(void **state)
{
    (void)state;
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[0] = 0.5;
    c.location[2] = -3;
    c.right[0] = c.up[1] = 1e-3;
    brume_set_camera(s, &c, truth_error());
    struct brume_function *fn = brume_function_new(s, 3, truth_error());
    brume_function_parameter(fn, 0, truth_error());
    brume_function_constant(fn, 1, truth_error());
    brume_function_op(fn, BRUME_OP_ADD, truth_error());
    brume_function_constant(fn, 2, truth_error());
    brume_function_constant(fn, -1, truth_error());
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    field.function = brume_add_function(s, fn, truth_error());
    field.component = BRUME_COMPONENT_COLOR;
    field.scale = 0.5;
    fill(s, brume_add_field(s, &field, truth_error()));
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    o.width = o.height = 1;
    o.spp = 4;
    assert_true(brume_render(s, &o, &f, truth_error()));
    const double truth[3] = {1 - exp(-1.5), 1 - exp(-2), 0};
    for (int i = 0; i < 3; i++)
        assert_true(fabs((double)f.opacity[i] - truth[i]) < 1e-3);
    brume_frame_free(&f);
    brume_scene_free(s);
}

/* In the atmosphere it goes on beyond the scene as its mean. */
static void test_unbounded(void **state)
{
    (void)state;
    const double slope[3] = {0, 0, 0};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_medium m = truth_medium(1, 0, 0);
    m.density[0] = add_field(s, add_linear(s, slope, 2));
    m.densities = 1;
    int id = brume_add_medium(s, &m, truth_error());
    int in = brume_add_interior(s, &id, 1, truth_error());
    brume_set_atmosphere(s, in, truth_error());
    struct counted warned;
    struct flat *f = prepare(s, &warned);
    assert_int_equal(warned.beyond, 1);
    field_point x = field_point_make(&f->view, f->view.media[0].lead,
                                     vec3_make(900, 900, 900));
    assert_true(fabsf(field_eval(&f->view, f->view.fields, &x) - 2) < 1e-5f);
    flat_free(f);
    brume_scene_free(s);
}

/* 1.5 + sin(k x) in the atmosphere, with a box without a medium to bound it;
 * what is drawn of it is off by so much. */
static double baked(double k, struct counted *warned)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_function *fn = brume_function_new(s, 3, truth_error());
    brume_function_parameter(fn, 0, truth_error());
    brume_function_constant(fn, k, truth_error());
    brume_function_op(fn, BRUME_OP_MULTIPLY, truth_error());
    brume_function_op(fn, BRUME_OP_SIN, truth_error());
    brume_function_constant(fn, 1.5, truth_error());
    brume_function_op(fn, BRUME_OP_ADD, truth_error());
    int function = brume_add_function(s, fn, truth_error());
    struct brume_medium m = truth_medium(1, 0, 0);
    m.density[0] = add_field(s, function);
    m.densities = 1;
    int id = brume_add_medium(s, &m, truth_error());
    int in = brume_add_interior(s, &id, 1, truth_error());
    struct brume_shape box = truth_box(1, 0, 2);
    assert_true(brume_set_atmosphere(s, in, truth_error()));
    assert_true(brume_add_shape(s, &box, truth_error()) >= 0);
    struct flat *f = prepare(s, warned);
    double error = compare(s, f, function);
    flat_free(f);
    brume_scene_free(s);
    return error;
}

/* Grids of functions are as fine as the stated error of 1 % asks, and say so
 * where they cannot be. */
static void test_baked(void **state)
{
    (void)state;
    struct counted warned;
    for (double k = 1; k < 20; k *= 2) {
        double error = baked(k, &warned);
        if (!(error < 0.0125 && warned.errors == 0 && warned.beyond == 1))
            fail_msg("frequency %g: error %g", k, error);
    }
    assert_true(baked(3000, &warned) > 0.02);
    assert_int_equal(warned.errors, 1);
}

/* ---- majorants that do not hold ---------------------------------------- */

struct mean {
    double sum[3], square[3];
    int count;
};

static void mean_add(struct mean *m, rgb value)
{
    for (int c = 0; c < 3; c++) {
        double v = (double)rgb_get(value, c);
        m->sum[c] += v;
        m->square[c] += v * v;
    }
    m->count++;
}

static void mean_check(const struct mean *m, const double truth[3])
{
    for (int c = 0; c < 3; c++) {
        double mean = m->sum[c] / m->count;
        double error = sqrt((m->square[c] / m->count - mean * mean) / m->count);
        if (!(error < 0.01 && fabs(mean - truth[c]) < 4 * error))
            fail_msg("channel %d: %g +- %g, not %g", c, mean, error, truth[c]);
    }
}

/* What passes a medium that absorbs and scatters in three ways, by shadow rays
 * and by paths, where the majorants are a third of what they should be. */
static void test_exceeded(void **state)
{
    (void)state;
    enum { RUNS = 200000 };
    const double slope[3] = {1, 0, 0};
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    struct brume_medium m = truth_medium(0.1, 0, 0);
    const double scattering[3] = {0.05, 0.2, 0.1};
    memcpy(m.scattering, scattering, sizeof scattering);
    m.density[0] = add_field(s, add_linear(s, slope, 1));
    m.densities = 1;
    truth_fill(s, truth_box(1, 0, 2), &m);
    struct counted warned;
    struct flat *f = prepare(s, &warned);
    for (size_t i = 0; i < f->cells_count; i++)
        f->cells[i].density *= 0.3f;
    const double from[3] = {0.5, 0.3, 0}, to[3] = {0.5, 0.3, 2};
    double a[3], b[3], truth[3];
    matrix_point(&f->to_unit, from, a);
    matrix_point(&f->to_unit, to, b);
    float length = (float)(b[2] - a[2]);
    vec3 o = vec3_make((float)a[0], (float)a[1], (float)a[2]);
    vec3 d = vec3_make(0, 0, 1);
    for (int c = 0; c < 3; c++)
        truth[c] = exp(-3 * (m.absorption[c] + m.scattering[c]));
    container_set set = {.count = 1, .shape = {0}};
    struct mean shadow = {.count = 0}, path = {.count = 0};
    track_counters count = {0}, flown = {0};
    rng random = rng_make(1, 2, 3, 4);
    for (int i = 0; i < RUNS; i++) {
        mean_add(&shadow, track_transmittance(&f->view, &set, false, o, d, 0,
                                              length, &random, &count));
        path_state p;
        path_event event;
        path_begin(&p, o, d, &set, false, random);
        p.count = &flown;
        bool through = path_media(&f->view, &p, length, &event) == PATH_THROUGH;
        mean_add(&path, through ? rgb_scale(p.beta, 1 / rgb_mean(p.r_u))
                                : rgb_gray(0));
        random = p.random;
    }
    assert_true(count.majorant_exceeded > RUNS / 10);
    assert_true(flown.majorant_exceeded > RUNS / 10);
    mean_check(&shadow, truth);
    mean_check(&path, truth);
    flat_free(f);
    brume_scene_free(s);
}

/* Optical depth of a function's field along z at (0.5, 0.3), by many points. */
static double depth_of(brume_scene *s, int function, double scale, double fine)
{
    enum { POINTS = 200000 };
    double sum = 0;
    for (int i = 0; i < POINTS; i++) {
        double z = 2 * (i + 0.5) / POINTS;
        const double p[3] = {0.5 / fine, 0.3 / fine, z / fine};
        double out[BRUME_MAX_RESULTS];
        brume_eval_function(s, function, p, 3, out, truth_error());
        sum += fmax(out[0], 0) * scale * 2 / POINTS;
    }
    return sum;
}

/* Cells of random densities, far finer than samples of a line: what these
 * tell of the depth varies, but not the mean of what passes, nor of what is
 * emitted, which here is what is lost. */
static void test_lines_mean(void **state)
{
    (void)state;
    enum { RUNS = 60000 };
    const double fine = 0.011, scale = 5;
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, 3, 2);
    int function = add_pattern(s, BRUME_PATTERN_CELLS);
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    field.function = function;
    field.scale = scale;
    for (int i = 0; i < 3; i++)
        field.transform[i][i] = fine;
    struct brume_medium m = truth_medium(1, 0, 0);
    for (int c = 0; c < 3; c++)
        m.emission[c] = 1;
    m.density[0] = brume_add_field(s, &field, truth_error());
    m.densities = 1;
    truth_fill(s, truth_box(1, 0, 2), &m);
    struct counted warned;
    struct flat *f = prepare(s, &warned);
    const double from[3] = {0.5, 0.3, 0}, to[3] = {0.5, 0.3, 2};
    double a[3], b[3];
    matrix_point(&f->to_unit, from, a);
    matrix_point(&f->to_unit, to, b);
    vec3 o = vec3_make((float)a[0], (float)a[1], (float)a[2]);
    container_set set = {.count = 1, .shape = {0}};
    struct mean passed = {.count = 0}, lost = {.count = 0};
    rng random = rng_make(1, 2, 3, 4);
    for (int i = 0; i < RUNS; i++) {
        line_integral line = line_zero();
        line_integrate(&f->view, &set, o, vec3_make(0, 0, 1), 0,
                       (float)(b[2] - a[2]), 0, true, false,
                       line_jitter_draw(&f->view, &random), &line);
        mean_add(&passed, line_transmittance(&line));
        mean_add(&lost, line.radiance);
    }
    double left = exp(-depth_of(s, function, scale, fine));
    mean_check(&passed, (double[3]){left, left, left});
    mean_check(&lost, (double[3]){1 - left, 1 - left, 1 - left});
    flat_free(f);
    brume_scene_free(s);
}

/* ---- grids in functions ------------------------------------------------ */

/* Samples x + 10 y + 100 z at index (x, y, z), placed at twice that. */
static int add_ramp(brume_scene *s, enum grid_filter filter, bool clip)
{
    const int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    struct grid *g = grid_new(origin, bricks, 7, truth_error());
    float *v = grid_brick(g, 0, 0, 0, truth_error());
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        v[i] = (float)(i % 8 + 10 * (i / 8 % 8) + 100 * (i / 64));
    g->filter = filter;
    g->clip = clip;
    for (int i = 0; i < 3; i++) {
        g->clip_min[i] = 0;
        g->clip_max[i] = 5;
        for (int k = 0; k < 4; k++)
            g->to_world[i][k] = i == k ? 2 : 0;
    }
    int id = brume_add_grid(s, g, truth_error());
    grid_free(g);
    struct brume_function *f = brume_function_new(s, 3, truth_error());
    for (int i = 0; i < 3; i++)
        brume_function_parameter(f, i, truth_error());
    brume_function_grid(f, id, truth_error());
    return brume_add_function(s, f, truth_error());
}

static double at_grid(brume_scene *s, int id, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    double out[BRUME_MAX_RESULTS];
    assert_true(brume_eval_function(s, id, p, 3, out, truth_error()));
    return out[0];
}

static void test_grid(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(truth_error());
    int smooth = add_ramp(s, GRID_TRILINEAR, false);
    int clipped = add_ramp(s, GRID_TRILINEAR, true);
    int nearest = add_ramp(s, GRID_NEAREST, false);
    assert_true(fabs(at_grid(s, smooth, 3, 5, 7) - 376.5) < 1e-9);
    assert_true(fabs(at_grid(s, clipped, 3, 5, 7) - 376.5) < 1e-9);
    assert_true(at_grid(s, nearest, 3.1, 5.2, 7.2) == 432);
    assert_true(at_grid(s, smooth, -1, 0, 0) == 3.5);
    assert_true(at_grid(s, smooth, 1e12, 0, 0) == 7);
    assert_true(at_grid(s, smooth, NAN, 0, 0) == 7);
    assert_true(at_grid(s, clipped, 10.1, 0, 0) == 0);
    assert_true(at_grid(s, nearest, 1e300, 0, 0) == 7);

    struct brume_function *f = brume_function_new(s, 3, truth_error());
    assert_false(brume_function_grid(f, 3, NULL));
    brume_function_free(f);
    brume_scene_free(s);
}

/* In float, by the bricks of a renderer, it is the same. */
static void test_grid_float(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(truth_error());
    struct counted warned;
    int ids[3] = {add_ramp(s, GRID_TRILINEAR, false),
                  add_ramp(s, GRID_TRILINEAR, true),
                  add_ramp(s, GRID_NEAREST, false)};
    struct flat *flat = prepare(s, &warned);
    float pool[256], r[MACHINE_REGISTERS];
    assert_true(s->pool_count <= 256);
    for (size_t i = 0; i < s->pool_count; i++)
        pool[i] = (float)s->pool[i];
    machine m = {.code = s->code,
                 .functions = s->functions,
                 .pool = pool,
                 .grids = &flat->view};
    uint64_t seed = 3;
    for (int k = 0; k < 3000; k++) {
        double p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = random_in(&seed, -3, 18);
            r[i] = (float)p[i];
        }
        assert_true(machine_run(&m, ids[k % 3], r));
        double truth = at_grid(s, ids[k % 3], p[0], p[1], p[2]);
        if (!(fabs((double)r[0] - truth) <= 2e-3))
            fail_msg("grid %d at <%g, %g, %g>: %g, not %g", k % 3, p[0], p[1],
                     p[2], (double)r[0], truth);
    }
    flat_free(flat);
    brume_scene_free(s);
}

static void test_refused(void **state)
{
    (void)state;
    const double slope[3] = {1, 0, 0};
    brume_scene *s = brume_scene_new(truth_error());
    struct brume_field field = BRUME_FIELD_INIT;
    field.kind = BRUME_FIELD_FUNCTION;
    assert_int_equal(brume_add_field(s, &field, NULL), -1);
    field.function = add_linear(s, slope, 0);
    field.component = 1;
    assert_int_equal(brume_add_field(s, &field, NULL), -1);
    struct brume_function *f = brume_function_new(s, 2, truth_error());
    brume_function_parameter(f, 0, truth_error());
    field.function = brume_add_function(s, f, truth_error());
    field.component = 0;
    assert_int_equal(brume_add_field(s, &field, NULL), -1);
    brume_scene_free(s);
}

#define CASE(name)                                                             \
    {                                                                          \
        "density__" #name, test_##name, NULL, NULL, NULL                       \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(linear),   CASE(bounds),  CASE(placed),     CASE(unbounded),
        CASE(baked),    CASE(grid),    CASE(grid_float), CASE(refused),
        CASE(exceeded), CASE(colored), CASE(lines_mean)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
