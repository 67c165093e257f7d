/* The extremes of METHODS.md, section 12: each case was seen to fail with the
 * remedy that it stands for taken out. What is not of media has its test with
 * its module: phase functions, frames, black bodies, triangles. */
#include "tests/unit/truth_flat.h"
#include "core/physics/path.h"

static struct brume_globals furnace_of(double sky)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    for (int i = 0; i < 3; i++)
        g.background[i] = sky;
    return g;
}

static struct brume_globals plain_before(double sky)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    for (int i = 0; i < 3; i++)
        g.background[i] = sky;
    return g;
}

static void check_near(const char *what, double got, double truth, double most)
{
    if (!(fabs(got - truth) <= most * fabs(truth)))
        fail_msg("%s: %.9g, truth %.9g", what, got, truth);
}

/* Thin media are scattered in more often than they do: their noise counts. */
static void check_white(const struct estimate *e)
{
    assert_int_equal(e->stats.rejected, 0);
    assert_int_equal(e->stats.majorant_exceeded, 0);
    if (!(fabs(e->mean[0] - 1.0) < 1e-4 + 4.0 * e->error[0]) ||
        !(e->error[0] < 0.02))
        fail_msg("white furnace: %.9g +- %.2g", e->mean[0], e->error[0]);
}

static struct grid *grid_of(int x, int y, int z, float background, double voxel)
{
    const int32_t origin[3] = {0, 0, 0}, size[3] = {x, y, z};
    struct grid *g = grid_new(origin, size, background, truth_error());
    assert_non_null(g);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            g->to_world[i][j] = i == j ? voxel : 0.0;
    return g;
}

static int field_of(brume_scene *s, struct grid *g)
{
    struct brume_field f = BRUME_FIELD_INIT;
    grid_finish(g);
    f.kind = BRUME_FIELD_GRID;
    f.grid = brume_add_grid(s, g, truth_error());
    grid_free(g);
    return brume_add_field(s, &f, truth_error());
}

static struct brume_medium dense_as(brume_scene *s, struct grid *g,
                                    double sigma_a, double sigma_s)
{
    struct brume_medium m = truth_medium(sigma_a, sigma_s, 0.0);
    m.density[0] = field_of(s, g);
    m.densities = 1;
    return m;
}

/* ---- optical depth ---------------- */

/* A million voxels in a row: a sum of as many terms, which a float loses; blue
 * has so many times the depth. */
static void check_long_sum(double blue)
{
    struct brume_globals globals = plain_before(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct grid *g = grid_of(1, 1, 125000, 1.0f, 1.0);
    for (int i = 0; i < 2; i++)
        g->to_world[i][3] = -4.0;
    struct brume_medium m = dense_as(s, g, 1e-6, 0.0);
    m.absorption[2] *= blue;
    truth_fill(s, truth_box(3.0, 0.0, 1e6), &m);
    struct estimate e = truth_render(s, 1, 2);
    check_near("opacity of 1e6 voxels", e.opacity,
               (-2.0 * expm1(-1.0) - expm1(-blue)) / 3.0, 1e-6);
}

/* Gray media have a sum of their own. */
static void extremes__long_sums(void **state)
{
    (void)state;
    check_long_sum(1.0);
    check_long_sum(2.0);
}

/* From next to nothing to all: the opacity keeps its digits, and a medium so
 * thin that its depth is no float at all is still none. */
static void extremes__densities(void **state)
{
    (void)state;
    const double densities[] = {1e-30, 1e-20, 1e-10, 1e-5, 1.0, 1e6, 1e12};
    for (int i = 0; i < 7; i++) {
        struct brume_globals globals = plain_before(1.0);
        brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
        struct grid *g = grid_of(2, 2, 2, (float)densities[i], 1.0);
        struct brume_medium m = dense_as(s, g, 1.0, 0.0);
        truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
        struct estimate e = truth_render(s, 2, 2);
        check_near("opacity", e.opacity, -expm1(-densities[i]), 1e-5);
    }
}

/* Emission without any attenuation, and with next to none. */
static void extremes__source_in_a_vacuum(void **state)
{
    (void)state;
    const double sigma[] = {0.0, 1e-30, 1e-12, 1e-6};
    for (int i = 0; i < 4; i++) {
        struct brume_globals globals = plain_before(0.0);
        brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
        struct brume_medium m = truth_medium(sigma[i], 0.0, 0.0);
        m.emission[0] = m.emission[1] = m.emission[2] = 1.0;
        truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
        check_near("L", truth_render(s, 1, 2).mean[0], 1.0, 2e-6);
    }
}

/* ---- many bounces ---------------- */

static void count_cuts(void *user, const char *text)
{
    *(int *)user += strstr(text, "extinction of at most") != NULL;
}

/* Of albedo 0.9 and that deep, under a white sky: what comes back is the plane
 * albedo of the half-space, 1 - sqrt(1 - a) H(1) (METHODS.md 13.8). */
static void check_deep(double half_width, double depth, int cuts)
{
    struct brume_globals globals = furnace_of(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct brume_medium m = truth_medium(0.1 * depth, 0.9 * depth, 0.0);
    truth_fill(s, truth_box(half_width, 0.0, 1.0), &m);
    struct brume_options o = BRUME_OPTIONS_INIT;
    struct brume_frame f;
    int told = 0;
    o.width = o.height = 32;
    o.spp = 64;
    o.warn = count_cuts;
    o.user = &told;
    assert_true(brume_render(s, &o, &f, truth_error()));
    double sum = 0.0;
    for (int i = 0; i < 3 * 32 * 32; i++)
        sum += (double)f.radiance[i] / (3 * 32 * 32);
    /* 65536 paths, each 0 or 1 at most */
    check_near("a deep medium", sum, 0.4149475, 4 * 0.5 / 256 / 0.4149475);
    check_near("its opacity", (double)f.opacity[0], 1.0, 0.0);
    assert_int_equal(f.stats.majorant_exceeded, 0);
    assert_int_equal(told, cuts);
    brume_frame_free(&f);
    brume_scene_free(s);
}

/* Beyond what the places of floats can tell apart it is cut, and told of. */
static void extremes__deep_scattering(void **state)
{
    (void)state;
    check_deep(1.0, 1e4, 0);
    check_deep(1.0, 1e6, 0);
    check_deep(100.0, 1e6, 1);
    check_deep(1.0, 1e12, 1);
}

static struct estimate furnace_slab(double depth, double g, int pixels, int spp)
{
    struct brume_globals globals = furnace_of(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct brume_medium m = truth_medium(0.0, depth, g);
    truth_fill(s, truth_box(100.0, 0.0, 1.0), &m);
    return truth_render(s, pixels, spp);
}

/* White, and as deep as that: a path ends where it leaves, and nowhere else.
 * A limit of N bounces would lose about 1.6 / sqrt(N). */
static void extremes__furnace_of_any_depth(void **state)
{
    (void)state;
    const double depths[] = {1e-6, 0.1, 10.0, 1e3, 1e4};
    for (int i = 0; i < 5; i++) {
        struct estimate e = furnace_slab(depths[i], 0.0, 8,
                                         depths[i] > 500.0 ? 8 : 32);
        check_white(&e);
    }
}

/* Peaks as narrow as a float can tell. */
static void extremes__furnace_of_any_peak(void **state)
{
    (void)state;
    const double g[] = {-0.9999, -0.99, 0.99, 0.9999};
    for (int i = 0; i < 4; i++) {
        struct estimate e = furnace_slab(30.0, g[i], 8, 32);
        check_white(&e);
    }
}

/* Behind a white slab a dark sky with one bright texel, 0.1 wide, in whose
 * direction the camera looks. */
static struct estimate texel_through(double g, double depth)
{
    const double at = TRUTH_PI / 64.0;
    const double d[3] = {sin(at) * cos(at), -sin(at), cos(at) * cos(at)};
    struct brume_globals globals = furnace_of(0.0);
    brume_scene *s = truth_scene(&globals, 1.0, 0.0);
    struct brume_medium m = truth_medium(0.0, depth * d[2], g);
    struct brume_camera c = BRUME_CAMERA_INIT;
    float texel[3 * 64 * 32] = {0};
    struct brume_sky sky = BRUME_SKY_INIT;
    for (int i = 0; i < 3; i++) {
        texel[3 * (16 * 64 + 32) + i] = 1e6f;
        c.direction[i] = d[i];
    }
    c.location[2] = -1.0;
    c.right[0] = c.up[1] = 1e-9;
    sky.width = 64;
    sky.height = 32;
    sky.radiance = texel;
    sky.interpolate = false;
    assert_true(brume_set_camera(s, &c, truth_error()));
    assert_true(brume_set_sky(s, &sky, truth_error()));
    truth_fill(s, truth_box(50.0, 0.0, 1.0), &m);
    return truth_render(s, 16, 512);
}

/* Peaks as narrow as floats have them find it with densities from 1e7 to
 * 4.5e13, or without end where g rounds to 1, the choice of the texel with
 * 100: each has its share by their ratio, as products would be infinite.
 * Forward, all light goes on but for the tail of the peak: (1 - g) / 0.06 of
 * it misses the texel at each of five events. Backward, it goes to and fro as
 * on a line, of which 1 / (1 + tau) passes. */
static void extremes__peaks_and_a_sun(void **state)
{
    (void)state;
    const double rows[][3] = {
        {0.9999, 1.0 - 5.0 * 1e-4 / 0.06, 4e-3},
        {0.99999994, 1.0, 4e-3},
        {0.9999999999, 1.0, 4e-3},
        {-0.9999, 1.0 / 6.0, 0.03},
    };
    for (int i = 0; i < 3; i++) {
        struct estimate e = texel_through(rows[i][0], 5.0);
        assert_int_equal(e.stats.rejected, 0);
        check_near("a texel through a peak", e.mean[0], 1e6 * rows[i][1],
                   rows[i][2]);
    }
}

/* A white medium denser than places can be told apart ends, and is white. */
static void extremes__denser_than_places(void **state)
{
    (void)state;
    const double depths[] = {1e8, 1e12};
    for (int i = 0; i < 2; i++) {
        struct brume_globals globals = furnace_of(1.0);
        brume_scene *s = truth_scene(&globals, 1.5, 0.1);
        struct brume_medium m = truth_medium(0.0, depths[i], 0.0);
        truth_fill(s, truth_box(0.7, -0.7, 0.7), &m);
        struct estimate e = truth_render(s, 4, 2);
        check_white(&e);
    }
}

/* A path that rounding put beyond the boundary of what it is in is out of it:
 * else black fills all space before the sky. */
static void extremes__lost_beyond_a_boundary(void **state)
{
    (void)state;
    struct brume_globals globals = furnace_of(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct brume_medium m = truth_medium(10.0, 0.0, 0.0);
    truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
    struct flat *f = truth_flat(s);
    const container_set inside = {1, 0, {0}};
    const vec3 out = vec3_make(0, 0, -1), o = vec3_make(0, 0, -1e-6f);
    track_counters count = {0};
    path_state p;
    path_begin(&p, o, out, &inside, false, rng_make(1, 0, 0, 0));
    while (path_segment(&f->view, &p, &count))
        continue;
    assert_true(p.radiance.r == 1.0f);
    container_set set = inside;
    rng r = rng_make(1, 0, 0, 1);
    rgb left = shadow_transmittance(&f->view, &set, true, o, out, f->view.far,
                                    &r, &count);
    assert_true(left.r == 1.0f);
    flat_free(f);
    brume_scene_free(s);
}

/* Roulette divides by its chance, which must not be tiny. */
static void extremes__roulette(void **state)
{
    (void)state;
    const container_set nowhere = {0, 0, {0}};
    double sum = 0.0;
    const int n = 100000;
    for (int i = 0; i < n; i++) {
        path_state p;
        path_begin(&p, vec3_make(0, 0, 0), vec3_make(0, 0, 1), &nowhere, true,
                   rng_make(1, 0, 0, (uint64_t)i));
        p.beta = rgb_gray(1e-6f);
        if (!path_survives(&p, PATH_KEEPS))
            continue;
        assert_true(p.beta.r <= 20.001e-6f);
        sum += (double)p.beta.r;
    }
    check_near("mean after roulette", sum / n, 1e-6, 0.06);
}

/* A choice is never rounded to 1: that would end a white path. */
static void extremes__choices_stay_below_one(void **state)
{
    (void)state;
    rng r = rng_make(1, 0, 0, 0);
    r.word[0] = 0xffffffffu;
    r.word[1] = 0u;
    r.used = 0u;
    assert_true(rng_fine(&r) < 1.0f);
    assert_true(rng_fine(&r) > 0.0f);
}

/* A direction stays of unit length over a long path. */
static void extremes__long_paths_keep_directions(void **state)
{
    (void)state;
    rng r = rng_make(3, 0, 0, 0);
    vec3 d = vec3_make(0, 0, 1);
    float pdf;
    for (int i = 0; i < 100000; i++) {
        float u = rng_float(&r);
        d = phase_sample(PHASE_HENYEY_GREENSTEIN, 0.9999f, d, u, rng_float(&r),
                         &pdf);
    }
    assert_true(fabsf(vec3_length(d) - 1.0f) < 1e-6f);
}

/* ---- grids ---------------- */

static void extremes__empty_and_tiny_grids(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct brume_globals globals = furnace_of(0.5);
        brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
        struct grid *g = grid_of(1, 1, 1, 0.0f, 0.125);
        if (i > 0) {
            float *v = grid_brick(g, 0, 0, 0, truth_error());
            assert_non_null(v);
            v[0] = i == 1 ? 0.0f : 1.0f;
        }
        if (i == 2)
            g->filter = GRID_NEAREST;
        struct brume_medium m = dense_as(s, g, 1.0, 1.0);
        for (int k = 0; k < 3; k++)
            m.emission[k] = m.absorption[k] * 0.5;
        truth_fill(s, truth_box(1.0, -0.5, 1.0), &m);
        struct estimate e = truth_render(s, 8, 16);
        assert_int_equal(e.stats.rejected, 0);
        assert_int_equal(e.stats.majorant_exceeded, 0);
        check_near("isothermal", e.mean[0], 0.5, i < 2 ? 1e-6 : 0.02);
    }
}

/* What is no density is none, and nothing of it reaches a picture. */
static void extremes__faulty_voxels(void **state)
{
    (void)state;
    struct brume_globals globals = furnace_of(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 0.5);
    struct grid *g = grid_of(1, 1, 1, 0.0f, 0.125);
    float *v = grid_brick(g, 0, 0, 0, truth_error());
    for (int i = 0; i < 512; i++)
        v[i] = i % 5 == 0   ? NAN
               : i % 5 == 1 ? INFINITY
               : i % 5 == 2 ? -3.0f
                            : 2.0f;
    struct brume_medium m = dense_as(s, g, 0.0, 4.0);
    truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
    struct estimate e = truth_render(s, 8, 32);
    check_white(&e);
}

/* Cells of a fine grid that are thinner than what rounding may be in a coarse
 * one, on a face of its bricks, still have that one's density. */
static void extremes__fine_in_coarse(void **state)
{
    (void)state;
    struct brume_globals globals = plain_before(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct grid *fine = grid_of(1, 1, 1, 1.0f, 1e-4);
    struct grid *coarse = grid_of(1, 1, 2, 1.0f, 1.0);
    for (int i = 0; i < 2; i++) {
        fine->to_world[i][3] = -4e-4;
        coarse->to_world[i][3] = -3.5;
    }
    fine->to_world[2][3] = 7.9995;
    struct brume_medium m = dense_as(s, fine, 1250.0, 0.0);
    m.density[m.densities++] = field_of(s, coarse);
    truth_fill(s, truth_box(4e-4, 7.9995, 8.0003), &m);
    struct estimate e = truth_render(s, 2, 2);
    assert_int_equal(e.stats.majorant_exceeded, 0);
    check_near("opacity", e.opacity, -expm1(-1.0), 1e-3);
}

/* Rays along faces, edges and the diagonal of bricks neither stick nor lose
 * their way. */
static void extremes__rays_on_planes(void **state)
{
    (void)state;
    const double rays[][6] = {
        {2, 2, -1, 0, 0, 1}, {2, 1.7, -1, 0, 0, 1}, {-1, -1, -1, 1, 1, 1},
        {-1, 2, 2, 1, 0, 0}, {5, 5, 5, -1, -1, -1}, {2, -1, -1, 0, 1, 1},
        {1, 5, 1, 0, -1, 0},
    };
    const double lengths[] = {4, 4, 6.92820323, 4, 6.92820323, 5.65685425, 4};
    for (int i = 0; i < 7; i++) {
        struct brume_globals globals = plain_before(1.0);
        brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
        struct grid *g = grid_of(4, 4, 4, 1.0f, 0.125);
        float *v = grid_brick(g, 1, 1, 1, truth_error());
        for (int k = 0; k < 512; k++)
            v[k] = k % 2 ? 1.0f : 0.999999f;
        struct brume_medium m = dense_as(s, g, 0.1, 0.0);
        struct brume_shape box = truth_box(1.0, 0.0, 4.0);
        struct brume_camera c = BRUME_CAMERA_INIT;
        for (int k = 0; k < 3; k++) {
            box.a[k] = 0.0;
            box.b[k] = 4.0;
            c.location[k] = rays[i][k];
            c.direction[k] = rays[i][3 + k];
            c.up[k] = c.right[k] = 0.0;
        }
        truth_fill(s, box, &m);
        assert_true(brume_set_camera(s, &c, truth_error()));
        struct estimate e = truth_render(s, 1, 1);
        check_near("tau", -log1p(-e.opacity), 0.1 * lengths[i], 2e-5);
    }
}

/* A walk through an only shape, whose pieces never turn back, from beginning to
 * end, and lie in their cells at both ends. */
static void check_pieces(const flat_scene *s, vec3 o, vec3 d, float t0,
                         float t1)
{
    const container_set inside = {1, 0, {0}};
    const flat_medium *m = &s->media[0];
    media_walk w;
    walk_begin(s, &w, &inside, true, o, d, t0, t1);
    assert_int_equal(w.count, 1);
    float t = t0;
    do {
        const lattice_walk *l = &w.part[0];
        assert_true(w.t == t && w.t_end >= t);
        for (int k = 0; k < 6 && l->inside; k++) {
            float at = k < 3 ? w.t : w.t_end;
            field_point x = lattice_point(s, l, vec3_mad(o, at, d), at);
            float from = 8.0f * (float)l->cell[k % 3] + m->origin[k % 3];
            assert_in_range(l->cell[k % 3], 0, m->cells[k % 3] - 1);
            assert_true(vec3_get(x.index, k % 3) >= from &&
                        vec3_get(x.index, k % 3) <= from + 8.0f);
        }
        t = w.t_end;
    } while (walk_next(s, &w));
    assert_true(t == t1);
}

static struct flat *cells_along(int x, int y, int z, double voxel,
                                brume_scene **s)
{
    struct brume_globals globals = plain_before(1.0);
    *s = truth_scene(&globals, 1.0, 1e-9);
    struct grid *g = grid_of(x, y, z, 1.0f, voxel);
    float *v = grid_brick(g, 0, 0, z - 1, truth_error());
    for (int k = 0; k < 512; k++)
        v[k] = 2.0f;
    struct brume_medium m = dense_as(*s, g, 0.1, 0.0);
    truth_fill(*s, truth_box(8.0, -8.0, 8.0 + z), &m);
    return truth_flat(*s);
}

/* On an edge of cells, or where rounding makes one of it, walks begin that go
 * on along the diagonal and aslant: a cell that rounding chose too low is left
 * at once, in both directions in turn. */
static void extremes__walks_never_turn_back(void **state)
{
    (void)state;
    brume_scene *s;
    struct flat *f = cells_along(4, 4, 4, 0.125, &s);
    const affine *to_cell = &f->view.media[0].to_cell;
    rng r = rng_make(5, 0, 0, 0);
    for (int i = 0; i < 20000; i++) {
        float off = 32.0f * (rng_float(&r) - 0.5f), bend = rng_float(&r);
        float sign = i & 2 ? -1.0f : 1.0f;
        vec3 o = vec3_scale(vec3_make(off, off, 1.7f), f->view.unit);
        vec3 d = vec3_normalize(vec3_make(sign, sign, i & 1 ? bend : 0.0f));
        float t = ((float)(i % 6) - affine_point(to_cell, o).x) /
                  affine_vector(to_cell, d).x;
        float end = t + 20.0f;
        for (int k = 0; k < 9 && t > 0.0f; k++) {
            check_pieces(&f->view, o, d, t, end);
            t = nextafterf(t, k < 4 ? 0.0f : INFINITY);
        }
    }
    flat_free(f);
    brume_scene_free(s);
}

/* The thousandth plane is as exact as the first: it is computed from its
 * number, not from the one before. */
static void extremes__planes_are_not_summed(void **state)
{
    (void)state;
    brume_scene *s;
    struct flat *f = cells_along(1, 1, 4000, 0.1, &s);
    const container_set inside = {1, 0, {0}};
    const affine *to_cell = &f->view.media[0].to_cell;
    vec3 o = vec3_scale(vec3_make(0.3f, 0.3f, 0.1f), f->view.unit);
    vec3 d = vec3_normalize(vec3_make(1e-5f, 0.0f, 1.0f));
    double from = (double)affine_point(to_cell, o).z;
    double rate = (double)affine_vector(to_cell, d).z;
    media_walk w;
    walk_begin(&f->view, &w, &inside, true, o, d, 0.0f, 100.0f);
    int planes = 0;
    do {
        /* A tenth is no sum of halves: neither is a step. */
        double plane = (double)w.part[0].cell[2] + 1.0;
        if (!w.part[0].inside)
            continue;
        planes++;
        check_near("a plane", (double)w.part[0].next[2], (plane - from) / rate,
                   3e-7);
    } while (walk_next(&f->view, &w));
    assert_true(planes >= 4000);
    flat_free(f);
    brume_scene_free(s);
}

/* Of one axis, the next plane of voxels lies ahead of any place, also of one on
 * a plane, and no farther than a voxel. */
static void extremes__planes_lie_ahead(void **state)
{
    (void)state;
    rng r = rng_make(9, 0, 0, 0);
    for (int i = 0; i < 200000; i++) {
        float o = 64.0f * (rng_float(&r) - 0.5f), d = rng_float(&r) + 1e-3f;
        d = i & 1 ? -d : d;
        float inverse = 1.0f / d;
        float t = (floorf(o + 40.0f * d) - o) * inverse;
        t = i & 2 ? nextafterf(t, INFINITY) : t;
        if (!(t > 0.0f))
            continue;
        line_near first = line_plane(o, d, inverse, t);
        float plane = first.plane, next = first.next;
        assert_true(next > t);
        assert_true((next - t) * fabsf(d) < 1.001f);
        /* And the one behind it. */
        float before = next;
        line_pass_plane(o, d, inverse, before, &plane, &next);
        assert_true(next > before);
        assert_true((next - before) * fabsf(d) < 1.001f);
    }
    /* Where floats are eight voxels apart, none lies ahead: to the end. */
    line_job job = {.lattices = 1};
    line_lattice *l = &job.lattice[0];
    l->o = vec3_make(1e8f, 1e8f, 1e8f);
    l->d = l->inverse = vec3_make(1.0f, 1.0f, 1.0f);
    l->next = vec3_make(-INFINITY, -INFINITY, -INFINITY);
    line_advance(&job, 0.5f);
    assert_true(line_stop(&job, 0.5f, 3.0f) == 3.0f);
}

/* More voxels than 32 bits count, nearly all in tiles. */
static void extremes__huge_grid(void **state)
{
    (void)state;
    struct brume_globals globals = plain_before(1.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    const int n = 170; /* bricks: 1360 voxels on a side, 2.5e9 in all */
    struct grid *g = grid_of(n, n, n, 0.0f, 1.0);
    float *v = grid_brick(g, n - 1, n - 1, n - 1, truth_error());
    for (int i = 0; i < 512; i++)
        v[i] = 1.0f;
    struct brume_medium m = dense_as(s, g, 0.25, 0.0);
    struct brume_shape box = truth_box(1.0, 0.0, 1.0);
    struct brume_camera c = BRUME_CAMERA_INIT;
    for (int k = 0; k < 3; k++) {
        box.a[k] = 0.0;
        box.b[k] = 8.0 * n;
        c.location[k] = k < 2 ? 8.0 * n - 4.0 : -10.0;
        c.up[k] = c.right[k] = 0.0;
    }
    truth_fill(s, box, &m);
    assert_true(brume_set_camera(s, &c, truth_error()));
    /* A ramp of one voxel, seven voxels, and the ramp to the box's end. */
    check_near("tau", -log1p(-truth_render(s, 1, 1).opacity), 0.25 * 8.0, 1e-5);
}

/* ---- scales and places ---------------- */

static struct estimate scaled(double k)
{
    struct brume_globals globals = furnace_of(0.3);
    brume_scene *s = truth_scene(&globals, 3.0 * k, 0.3);
    struct grid *g = grid_of(2, 2, 2, 0.0f, k / 16.0);
    struct brume_light l = BRUME_LIGHT_INIT;
    struct brume_material white = BRUME_MATERIAL_INIT;
    struct brume_shape ball = BRUME_SHAPE_INIT;
    for (int b = 0; b < 8; b++) {
        float *v = grid_brick(g, b & 1, b >> 1 & 1, b >> 2, truth_error());
        for (int i = 0; i < 512; i++)
            v[i] = (float)((i * 7 + b * 3) % 11) / 11.0f;
    }
    for (int i = 0; i < 3; i++) {
        g->to_world[i][3] = -0.5 * k;
        l.location[i] = 2.0 * k;
        white.color[0][i] = 0.8;
    }
    struct brume_medium m = dense_as(s, g, 1.0 / k, 4.0 / k);
    truth_fill(s, truth_box(0.6 * k, -0.6 * k, 0.6 * k), &m);
    ball.radius = 0.2 * k;
    ball.material = brume_add_material(s, &white, truth_error());
    assert_true(brume_add_shape(s, &ball, truth_error()) >= 0);
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    return truth_render(s, 8, 64);
}

/* From an atom's size to a planet's: nothing has a size of its own. */
static void extremes__scales(void **state)
{
    (void)state;
    double truth = scaled(1.0).mean[0];
    const double scales[] = {1e-6, 1.0 / 1048576.0, 1e3, 1e9};
    for (int i = 0; i < 4; i++) {
        struct estimate e = scaled(scales[i]);
        assert_int_equal(e.stats.rejected, 0);
        check_near("scaled scene", e.mean[0], truth, 0.02);
    }
    check_near("a power of two", scaled(1.0 / 1048576.0).mean[0], truth, 0.0);
}

/* Nested boxes that share faces, seen from outside, from within, and from
 * within two. */
static void extremes__nested_media(void **state)
{
    (void)state;
    const double from[] = {-1.0, 0.5, 1.5, 2.5};
    const double tau[] = {0.1 * 3 + 0.2 * 2 + 0.4, 0.1 * 2.5 + 0.2 * 2 + 0.4,
                          0.1 * 1.5 + 0.2 * 1.5 + 0.4,
                          0.1 * 0.5 + 0.2 * 0.5 + 0.4 * 0.5};
    for (int i = 0; i < 4; i++) {
        struct brume_globals globals = plain_before(1.0);
        brume_scene *s = truth_scene(&globals, -from[i], 1e-9);
        for (int k = 0; k < 3; k++) {
            struct brume_medium m = truth_medium(0.1 * (1 << k), 0.0, 0.0);
            truth_fill(s, truth_box(3.0 - k, k, 3.0), &m);
        }
        check_near("tau", -log1p(-truth_render(s, 1, 1).opacity), tau[i], 1e-5);
    }
}

/* ---- light ---------------- */

/* A lamp so near the ray that 1/d^2 is 1e12 times that of the ends: the mean
 * is mu / (4 pi D) (pi - D (1/a + 1/b)), and on the ray all stays finite. */
static void extremes__lamp_on_the_ray(void **state)
{
    (void)state;
    const double off[] = {1e-2, 1e-4, 1e-6, 0.0};
    for (int i = 0; i < 4; i++) {
        struct brume_globals globals = plain_before(0.0);
        globals.physical_units = true;
        brume_scene *s = truth_scene(&globals, 1.0, 0.0);
        struct brume_medium m = truth_medium(0.0, off[i] > 0.0 ? 1e-6 : 0.5,
                                             0.0);
        struct brume_light l = BRUME_LIGHT_INIT;
        l.location[0] = off[i];
        l.location[2] = 1.0;
        for (int c = 0; c < 3; c++)
            l.color[c] = 1.0 / TRUTH_PI;
        truth_fill(s, truth_box(1.0, 0.0, 2.0), &m);
        assert_true(brume_add_light(s, &l, truth_error()) >= 0);
        struct estimate e = truth_render(s, 16, 512);
        assert_int_equal(e.stats.rejected, 0);
        assert_true(isfinite(e.mean[0]));
        if (off[i] > 0.0)
            check_near("L", e.mean[0],
                       1e-6 / (4.0 * TRUTH_PI * off[i]) *
                           (TRUTH_PI - 2.0 * off[i]),
                       5e-3);
    }
}

/* Nothing shines, nothing is there, or what shines is black. */
static void extremes__nothing(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        /* Behind it a background; or a white sky, which it scatters on. */
        int i = k % 4;
        struct brume_globals globals = k < 4 ? plain_before(0.25)
                                             : furnace_of(0.25);
        brume_scene *s = truth_scene(&globals, 1.0, 0.5);
        struct brume_medium m = truth_medium(0.0, i == 3 ? 0.0 : 1.0, 0.0);
        struct brume_light l = BRUME_LIGHT_INIT;
        for (int c = 0; c < 3; c++)
            l.color[c] = 0.0;
        if (i > 0)
            truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
        if (i > 1)
            assert_true(brume_add_light(s, &l, truth_error()) >= 0);
        struct estimate e = truth_render(s, 4, k < 4 ? 8 : 128);
        double depth = i == 0 || i == 3 || k >= 4 ? 0.0 : 1.0;
        assert_int_equal(e.stats.rejected, 0);
        check_near("background", e.mean[0], 0.25 * exp(-depth), 0.03);
    }
}

static double fire_at(double kelvin, enum brume_brightness brightness)
{
    struct brume_globals globals = plain_before(0.0);
    brume_scene *s = truth_scene(&globals, 1.0, 1e-9);
    struct brume_field t = BRUME_FIELD_INIT;
    struct brume_medium m = truth_medium(0.0, 0.0, 0.0);
    m.fire.on = m.fire.additive = true;
    m.fire.temperature = brume_add_field(s, &t, truth_error());
    m.fire.kelvin_scale = kelvin;
    m.fire.brightness = brightness;
    truth_fill(s, truth_box(1.0, 0.0, 1.0), &m);
    struct estimate e = truth_render(s, 1, 2);
    assert_int_equal(e.stats.rejected, 0);
    return e.mean[1];
}

/* No heat gives no light, and the hottest is linear in T [Rayleigh, Jeans]. */
static void extremes__temperatures(void **state)
{
    (void)state;
    assert_true(fire_at(0.0, BRUME_BRIGHTNESS_PHYSICAL) == 0.0);
    assert_true(fire_at(-1e9, BRUME_BRIGHTNESS_PHYSICAL) == 0.0);
    assert_true(fire_at(499.0, BRUME_BRIGHTNESS_NORMALIZED) == 0.0);
    check_near("1e9 K over 1e8 K", fire_at(1e9, BRUME_BRIGHTNESS_PHYSICAL),
               10.0 * fire_at(1e8, BRUME_BRIGHTNESS_PHYSICAL), 3e-3);
    const double hot[] = {600.0, 1e4, 1e6, 1e9};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            assert_true(isfinite(fire_at(hot[i], (enum brume_brightness)k)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extremes__long_sums),
        cmocka_unit_test(extremes__densities),
        cmocka_unit_test(extremes__source_in_a_vacuum),
        cmocka_unit_test(extremes__furnace_of_any_depth),
        cmocka_unit_test(extremes__deep_scattering),
        cmocka_unit_test(extremes__furnace_of_any_peak),
        cmocka_unit_test(extremes__peaks_and_a_sun),
        cmocka_unit_test(extremes__denser_than_places),
        cmocka_unit_test(extremes__lost_beyond_a_boundary),
        cmocka_unit_test(extremes__roulette),
        cmocka_unit_test(extremes__choices_stay_below_one),
        cmocka_unit_test(extremes__long_paths_keep_directions),
        cmocka_unit_test(extremes__empty_and_tiny_grids),
        cmocka_unit_test(extremes__faulty_voxels),
        cmocka_unit_test(extremes__fine_in_coarse),
        cmocka_unit_test(extremes__rays_on_planes),
        cmocka_unit_test(extremes__walks_never_turn_back),
        cmocka_unit_test(extremes__planes_are_not_summed),
        cmocka_unit_test(extremes__planes_lie_ahead),
        cmocka_unit_test(extremes__huge_grid),
        cmocka_unit_test(extremes__scales),
        cmocka_unit_test(extremes__nested_media),
        cmocka_unit_test(extremes__lamp_on_the_ray),
        cmocka_unit_test(extremes__nothing),
        cmocka_unit_test(extremes__temperatures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
