/* Gathering by balls: pictures against closed forms and the path tracer's, in
 * media whose density changes within a ball. */
#include "tests/unit/heap_scene.h"
#include "tests/unit/truth_flat.h"
#include "core/physics/ball_cell.h"
#include "core/physics/glow.h"

enum { SIDE = 12, PIXELS = SIDE * SIDE };

static struct brume_globals full_transport(void)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    g.media_multiple = g.surfaces_indirect = g.environment = true;
    return g;
}

static struct brume_options ball_options(uint64_t seed)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.photons.gather = BRUME_GATHER_BALL;
    o.width = o.height = SIDE;
    o.spp = 64;
    o.seed = seed;
    return o;
}

static double render_mean(brume_scene *s, const struct brume_options *o)
{
    struct brume_frame f;
    double sum = 0.0;
    assert_true(brume_render(s, o, &f, truth_error()));
    assert_int_equal(f.stats.photons.clipped, 0);
    for (int i = 0; i < 3 * PIXELS; i++)
        sum += (double)f.radiance[i];
    brume_frame_free(&f);
    return sum / (3 * PIXELS);
}

/* Mean and standard error over `times` seeds. */
static void render_often(brume_scene *s, struct brume_options o, int times,
                         double *mean, double *error)
{
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < times; i++) {
        o.seed = (uint64_t)i + 1;
        double x = render_mean(s, &o);
        sum += x;
        squares += x * x;
    }
    *mean = sum / times;
    *error = sqrt(fmax(squares / times - *mean * *mean, 0.0) / (times - 1));
}

/* ---- T9: what leaves a sphere that glows evenly ------------------------- */

/* Seen from afar, a ball of radius 1: the picture's mean times its area is the
 * part that leaves of 4 pi q V, over 4 pi. */
static brume_scene *glowing_ball(double sigma_a, double sigma_s, double q)
{
    struct brume_globals g = full_transport();
    brume_scene *s = truth_scene(&g, 3.0, 1.0);
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = BRUME_CAMERA_ORTHOGRAPHIC;
    c.location[2] = -3.0;
    c.right[0] = c.up[1] = 2.0;
    assert_true(brume_set_camera(s, &c, truth_error()));
    struct brume_medium m = truth_medium(sigma_a, sigma_s, 0.0);
    struct brume_shape b = BRUME_SHAPE_INIT;
    b.kind = BRUME_SHAPE_SPHERE;
    b.radius = 1.0;
    for (int i = 0; i < 3; i++)
        m.emission[i] = q;
    truth_fill(s, b, &m);
    return s;
}

/* Births alone, and births with what they scatter: radii of 2 mean free paths
 * (METHODS.md 13.7). Balls at the rim are half out of the medium; over their
 * whole volume they would lose 18 %. What is scattered falls toward the rim,
 * within a ball too. */
static void photon_ball__births_light_a_sphere(void **state)
{
    (void)state;
    const double rows[2][3] = {{0.0005, 0.33241773, 0.001},
                               {0.5, 0.48830, 0.015}};
    for (int i = 0; i < 2; i++) {
        double albedo = rows[i][0], mean, error;
        double truth = rows[i][1] * 4.0 / 3.0 * TRUTH_PI / 4.0;
        brume_scene *s = glowing_ball(2.0 * (1.0 - albedo), 2.0 * albedo, 1.0);
        struct brume_options o = ball_options(1);
        o.photons.emission = BRUME_EMISSION_PHOTONS;
        o.photons.single = BRUME_SINGLE_FIELD;
        o.photons.count = 150000;
        o.photons.spacing = 0.1;
        render_often(s, o, 8, &mean, &error);
        if (!(fabs(mean / truth - 1.0) < rows[i][2] + 4.0 * error / truth) ||
            !(error < 0.003 * truth))
            fail_msg("albedo %g: %.5f +- %.5f, truth %.5f", albedo, mean, error,
                     truth);
        brume_scene_free(s);
    }
}

/* ---- density that changes within a ball --------------------------------- */

/* A field of a few voxels. */
static int add_heap(brume_scene *s, double steep)
{
    return heap_add(s, 16, steep, 7.0);
}

/* A cloud of a few voxels, dense in its middle, lit from its left. */
static brume_scene *small_cloud(void)
{
    struct brume_globals g = full_transport();
    brume_scene *s = truth_scene(&g, 5.0, 0.45);
    struct brume_medium m = truth_medium(0.1, 12.0, 0.3);
    m.density[0] = add_heap(s, 0.1);
    m.densities = 1;
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    heap_sun(s);
    return s;
}

/* Balls of two voxels, and of one: over their volume alone the light would
 * come from thinner parts than it does, and be 12 and 3 % too bright. */
static void photon_ball__light_stays_where_media_are_thick(void **state)
{
    (void)state;
    const double rows[2][2] = {{0.125, 0.075}, {0.0625, 0.02}};
    brume_scene *s = small_cloud();
    double truth, error, mean, noise;
    struct brume_options o = ball_options(1);
    o.integrator = BRUME_INTEGRATOR_PATH;
    o.spp = 512;
    render_often(s, o, 16, &truth, &error);
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.spp = 64;
    o.photons.count = 150000;
    for (int i = 0; i < 4; i++) {
        const double *row = rows[i / 2];
        o.photons.spacing = row[0];
        o.photons.single = (enum brume_single)(i % 2);
        render_often(s, o, 6, &mean, &noise);
        if (!(fabs(mean / truth - 1.0) < row[1]) ||
            !(hypot(error, noise) < 0.005 * truth))
            fail_msg("cells of %g, single %d: %.5f +- %.5f, path %.5f +- %.5f",
                     row[0], i % 2, mean, noise, truth, error);
    }
    brume_scene_free(s);
}

/* Sum of a picture, and of the squares of what it differs from another. */
static double render_against(brume_scene *s, const struct brume_options *o,
                             float other[3 * PIXELS], double *squares)
{
    struct brume_frame f;
    double sum = 0.0;
    assert_true(brume_render(s, o, &f, truth_error()));
    for (int i = 0; i < 3 * PIXELS; i++) {
        double off = (double)(f.radiance[i] - other[i]);
        sum += (double)f.radiance[i];
        *squares += off * off;
        other[i] = f.radiance[i];
    }
    brume_frame_free(&f);
    return sum;
}

/* A white ball in haze, lit from its left: it shines on the haze, and the haze
 * on it. */
static brume_scene *hazy_ball(void)
{
    struct brume_globals g = full_transport();
    brume_scene *s = truth_scene(&g, 5.0, 0.45);
    struct brume_medium m = truth_medium(0.05, 1.2, 0.0);
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    struct brume_shape b = BRUME_SHAPE_INIT;
    b.kind = BRUME_SHAPE_SPHERE;
    b.radius = 0.6;
    struct brume_material white = BRUME_MATERIAL_INIT;
    for (int i = 0; i < 3; i++)
        white.color[0][i] = 0.9;
    white.diffuse = 1.0;
    b.material = brume_add_material(s, &white, truth_error());
    assert_true(brume_add_shape(s, &b, truth_error()) >= 0);
    heap_sun(s);
    return s;
}

/* More lights than cells keep the light of, which give next to none. */
static void add_dim_lights(brume_scene *s)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    for (int i = 0; i < 16; i++) {
        l.location[0] = 100.0 + i;
        for (int c = 0; c < 3; c++)
            l.color[c] = 1e-9;
        assert_true(brume_add_light(s, &l, truth_error()) >= 0);
    }
}

/* Means of pictures whose cells hold light straight from lights, and of those
 * whose cells do not: they are the same, however coarse the cells; the noise is
 * less by the factor `less`, squared. */
static void compare_cells(brume_scene *s, uint64_t times, double side,
                          double less)
{
    double mean[2] = {0}, var[2] = {0}, noise[2] = {0};
    for (int kind = 0; kind < 2; kind++) {
        if (kind == 1)
            add_dim_lights(s);
        float last[3 * PIXELS] = {0};
        double squares = 0.0, ignored = 0.0;
        struct brume_options o = ball_options(1);
        o.photons.gather = BRUME_GATHER_TALLY;
        o.photons.count = 100000;
        o.photons.spacing = side;
        o.spp = 16;
        for (o.seed = 1; o.seed <= times; o.seed++) {
            double x = render_against(s, &o, last,
                                      o.seed > 1 ? &noise[kind] : &ignored);
            mean[kind] += x / times;
            squares += x * x / times;
        }
        var[kind] = (squares - mean[kind] * mean[kind]) / (times - 1);
    }
    double error = sqrt(var[0] + var[1]);
    if (!(fabs(mean[0] - mean[1]) < 4.0 * error) ||
        !(error < 0.005 * mean[1]) || !(noise[0] < noise[1] / less))
        fail_msg("cells %.5f, rays %.5f, +- %.5f; noise %g of theirs", mean[0],
                 mean[1], error, sqrt(noise[0] / noise[1]));
    brume_scene_free(s);
}

/* Cells tell what is scattered once, and paths seek the rest. (4 times less
 * before places were chosen voxel by voxel, which took nearly half of the noise
 * of what has no cells.) */
static void photon_ball__cells_take_noise_and_nothing_else(void **state)
{
    (void)state;
    compare_cells(small_cloud(), 12, 0.25, 3.0);
}

/* Of what surfaces see, too. */
static void photon_ball__surfaces_gather_cells(void **state)
{
    (void)state;
    compare_cells(hazy_ball(), 6, 0.0625, 2.5);
}

struct fire_kind {
    int voxels;    /* of the temperature; those of the density are 16 */
    double offset; /* kelvin                                          */
    bool amount, additive;
};

/* Soot that is thickest and hottest in its middle, where it glows a thousand
 * times as brightly as a few voxels off. */
static brume_scene *fire_of(const struct fire_kind *kind)
{
    struct brume_globals g = full_transport();
    brume_scene *s = truth_scene(&g, 5.0, 0.45);
    struct brume_medium m = truth_medium(4.0, 1e-3, 0.0);
    double wide = kind->voxels / 16.0;
    m.density[0] = add_heap(s, 0.02);
    m.densities = 1;
    m.fire.on = true;
    m.fire.temperature = heap_add(s, kind->voxels, 0.05 / (wide * wide),
                                  7.0 * wide);
    m.fire.amount = kind->amount ? add_heap(s, 0.1) : -1;
    m.fire.additive = kind->additive;
    m.fire.kelvin_scale = 1400.0;
    m.fire.kelvin_offset = kind->offset;
    m.fire.reference = 2000.0;
    truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    return s;
}

static brume_scene *small_fire(void)
{
    return fire_of(&(struct fire_kind){16, 600.0, false, false});
}

/* Balls of two voxels, and of four: what is born there would be seen as if it
 * were where the ball is colder and thinner. The same seeds see both. */
static void photon_ball__births_are_as_hot_as_the_place(void **state)
{
    (void)state;
    enum { TIMES = 6 };
    brume_scene *s = small_fire();
    for (int i = 0; i < 2; i++) {
        double sum = 0.0, squares = 0.0;
        struct brume_options o = ball_options(1);
        o.photons.count = 50000;
        o.photons.spacing = i == 0 ? 0.125 : 0.25;
        for (o.seed = 1; o.seed <= TIMES; o.seed++) {
            o.photons.emission = BRUME_EMISSION_LINE;
            double line = render_mean(s, &o);
            o.photons.emission = BRUME_EMISSION_PHOTONS;
            double off = render_mean(s, &o) / line - 1.0;
            sum += off / TIMES;
            squares += off * off / TIMES;
        }
        double noise = sqrt((squares - sum * sum) / (TIMES - 1));
        if (!(fabs(sum) < 4.0 * noise + 2e-3) || !(noise < 1e-3))
            fail_msg("cells of %g: births %+.5f +- %.5f of lines",
                     o.photons.spacing, sum, noise);
    }
    brume_scene_free(s);
}

/* Of n even places in the order of voxels each has its share, rounded up or
 * down: the published rule of counts. */
static void photon_ball__voxels_have_their_share_of_births(void **state)
{
    (void)state;
    enum { BIRTHS = 100000, VOXELS = 64 * 64 * 64 };
    static int born[VOXELS];
    static double share[VOXELS];
    brume_scene *s = small_fire();
    struct flat *flat = truth_flat(s);
    const flat_scene *v = &flat->view;
    const flat_glow *g = &v->glows[0];
    assert_int_equal(v->glows_count, 1);
    for (int i = 0; i < BIRTHS; i++) {
        rng random = rng_make(1, 0, 0, (uint64_t)i);
        glow_sample x = glow_choose_at(v, (i + 0.3) / BIRTHS, &random);
        vec3 q = affine_point(&g->to_index, x.p);
        int at[3], n = 0;
        for (int k = 0; k < 3; k++) {
            at[k] = hd_floor(vec3_get(q, k)) - g->origin[k];
            assert_true(at[k] >= 0 && at[k] < 64);
            n = 64 * n + at[k];
        }
        born[n]++;
        share[n] = (double)(x.pdf * g->voxel_volume) * BIRTHS;
    }
    for (int i = 0; i < VOXELS; i++)
        if (born[i] > 0 && !(fabs(born[i] - share[i]) < 1.02))
            fail_msg("voxel %d: %d births of %g", i, born[i], share[i]);
    flat_free(flat);
    brume_scene_free(s);
}

/* What a voxel emits: the mean luminance of its eighths. */
static double emitted(const flat_scene *v, const flat_glow *g, int x, int y,
                      int z)
{
    const flat_medium *m = &v->media[g->medium];
    double sum = 0.0;
    for (int i = 0; i < 8; i++) {
        vec3 q = vec3_make((float)x + (i & 1 ? 0.75f : 0.25f),
                           (float)y + (i & 2 ? 0.75f : 0.25f),
                           (float)z + (i & 4 ? 0.75f : 0.25f));
        field_point at = field_point_make(v, m->lead,
                                          affine_point(&g->from_index, q));
        rgb c = medium_source(v, m, &at, medium_density(v, m, &at));
        sum += 0.2126 * fabs((double)c.r) + 0.7152 * fabs((double)c.g) +
               0.0722 * fabs((double)c.b);
    }
    return sum;
}

/* The shares of all voxels against what they emit: what they are off by, all
 * together. */
static double voxels_off(const flat_scene *v)
{
    enum { SIDE = 64 };
    static double share[SIDE * SIDE * SIDE];
    const flat_glow *g = &v->glows[0];
    double sum = 0.0, off = 0.0;
    for (int n = 0; n < SIDE * SIDE * SIDE; n++) {
        share[n] = emitted(v, g, g->origin[0] + n % SIDE,
                           g->origin[1] + n / SIDE % SIDE,
                           g->origin[2] + n / SIDE / SIDE);
        sum += share[n];
    }
    for (int n = 0; n < SIDE * SIDE * SIDE; n++) {
        vec3 q = vec3_make((float)(g->origin[0] + n % SIDE) + 0.5f,
                           (float)(g->origin[1] + n / SIDE % SIDE) + 0.5f,
                           (float)(g->origin[2] + n / SIDE / SIDE) + 0.5f);
        float pdf = glow_pdf(v, g, affine_point(&g->from_index, q));
        off += fabs((double)(pdf * g->voxel_volume) - share[n] / sum);
    }
    assert_true(sum > 0.0);
    return off;
}

/* Temperatures on the density's lattice and on one of their own. */
static void photon_ball__voxels_weigh_as_they_glow(void **state)
{
    (void)state;
    const struct fire_kind kinds[] = {{16, 600.0, false, false},
                                      {24, 600.0, false, false},
                                      {16, 0.0, true, false},
                                      {24, 0.0, true, true},
                                      {16, 0.0, false, true}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        brume_scene *s = fire_of(&kinds[i]);
        struct flat *flat = truth_flat(s);
        assert_int_equal(flat->view.glows_count, 1);
        double off = voxels_off(&flat->view);
        if (!(off < 2e-4))
            fail_msg("kind %zu: voxels are off by %.2g together", i, off);
        flat_free(flat);
        brume_scene_free(s);
    }
}

/* A heap in a medium that is alone, and balls of a field around it; with a
 * steepness of 2 it is as large as a voxel or two. */
struct heap {
    brume_scene *scene;
    struct flat *flat;
    flat_scene view;
};

static struct heap heap_of(struct brume_medium m, double steep)
{
    struct heap h;
    h.scene = truth_scene(&(struct brume_globals)BRUME_GLOBALS_INIT, 5.0, 0.45);
    m.density[0] = add_heap(h.scene, steep);
    m.densities = 1;
    truth_fill(h.scene, truth_box(1.0, -1.0, 1.0), &m);
    h.flat = truth_flat(h.scene);
    h.view = h.flat->view;
    h.view.field.radius = 0.4f * (float)h.flat->unit;
    return h;
}

static void heap_free(struct heap *h)
{
    flat_free(h->flat);
    brume_scene_free(h->scene);
}

/* What is in balls around a heap, beside the mean of many places: of the ball's
 * own 2 x 16 most miss it. */
static void photon_ball__finds_what_is_thick(void **state)
{
    (void)state;
    enum { PLACES = 50000, BALLS = 16 };
    struct heap h = heap_of(truth_medium(0.0, 1.0, 0.0), 2.0);
    const flat_scene *v = &h.view;
    for (int i = 0; i < BALLS; i++) {
        double sum = 0.0;
        rng random = rng_make(1, 0, 0, (uint64_t)i);
        vec3 x = vec3_scale(ball_offset(i), 0.9f * v->field.radius);
        for (int k = 0; k < PLACES; k++) {
            float z = rng_float(&random), a = rng_float(&random);
            float r = cbrtf(rng_float(&random)) * v->field.radius;
            vec3 p = vec3_mad(x, r, warp_sphere(z, a));
            field_point at = field_point_make(v, v->media[0].lead, p);
            sum += (double)radiance_thickness(
                       &v->media[0], medium_density(v, &v->media[0], &at)) /
                   PLACES;
        }
        double found =
            (double)ball_media_at(v, x, BALL_MEAN, team_alone()).thickness;
        if (!(found > 0.6 * sum && found < 1.6 * sum))
            fail_msg("ball %d: %g of %g", i, found, sum);
    }
    heap_free(&h);
}

/* A medium that is alone scatters alike whether all of its ball has been looked
 * at or a place of it: in every direction, as in the whole ball's mean. Most of
 * every other ball is beyond the medium's end. */
static void photon_ball__a_place_tells_of_one_medium(void **state)
{
    (void)state;
    struct heap h = heap_of(truth_medium(0.5, 2.0, 0.6), 0.05);
    const flat_scene *v = &h.view;
    for (int i = 0; i < 50; i++) {
        vec3 x = vec3_scale(ball_offset(i),
                            (i % 2 ? 0.2f : 1.2f) * v->field.radius);
        x.x += i % 2 ? 1.15f * (float)h.flat->unit : 0.0f;
        vec3 d = ball_offset(i + 50), wi = ball_offset(i + 100);
        d = vec3_scale(d, 1.0f / vec3_length(d));
        wi = vec3_scale(wi, 1.0f / vec3_length(wi));
        ball_media mean = ball_media_at(v, x, BALL_MEAN, team_alone());
        ball_media some = ball_media_at(v, x, BALL_SHARES, team_alone());
        rgb a = ball_scattered(v, &mean, d, wi);
        rgb b = ball_scattered(v, &some, d, wi);
        if (!(a.r > 0.0f && fabsf(b.r / a.r - 1.0f) < 1e-6f))
            fail_msg("ball %d: %g, of its mean %g", i, (double)b.r,
                     (double)a.r);
    }
    heap_free(&h);
}

/* What the table of a ball's points is made of. */
static vec3 point_of_ball(int k)
{
    const float step[3] = {0.819172513f, 0.671043607f, 0.549700478f};
    float u[3];
    for (int i = 0; i < 3; i++) {
        float x = 0.5f + step[i] * (float)(k + 1);
        u[i] = x - floorf(x);
    }
    return vec3_scale(warp_sphere(u[0], u[1]), fm_pow(u[2], 1.0f / 3.0f));
}

static void photon_ball__points_are_the_tables(void **state)
{
    (void)state;
    for (int k = 0; k < BALL_MOST_PAIRS; k++) {
        vec3 a = point_of_ball(k), b = ball_offset(k);
        if (memcmp(&a, &b, sizeof a) != 0)
            fail_msg("point %d: {%.9gf, %.9gf, %.9gf}", k, (double)a.x,
                     (double)a.y, (double)a.z);
    }
}

/* A list whose voxels are turned, and up to twice as long as wide. */
static void turn_voxels(flat_glow *g, rng *r)
{
    vec3 x = warp_sphere(rng_float(r), rng_float(r));
    warp_basis b = warp_frame(x);
    vec3 axis[3] = {vec3_scale(b.x, 0.5f + rng_float(r)),
                    vec3_scale(b.y, 0.5f + rng_float(r)),
                    vec3_scale(x, 0.5f + rng_float(r))};
    for (int i = 0; i < 3; i++) {
        float square = vec3_dot(axis[i], axis[i]);
        for (int k = 0; k < 3; k++) {
            g->from_index.m[4 * k + i] = vec3_get(axis[i], k);
            g->to_index.m[4 * i + k] = vec3_get(axis[i], k) / square;
        }
        g->from_index.m[4 * i + 3] = g->to_index.m[4 * i + 3] = 0.0f;
    }
}

/* Mean of glow_pdf over a ball, by places that fill it evenly. */
static double mean_of_places(const flat_scene *v, const flat_glow *g, vec3 x,
                             float r)
{
    enum { SIDE = 48 };
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        float off[3];
        for (int k = 0; k < 3; k++)
            off[k] = ((float)(2 * at[k] + 1) / (float)SIDE - 1.0f);
        vec3 o = vec3_make(off[0], off[1], off[2]);
        if (!(vec3_dot(o, o) <= 1.0f))
            continue;
        sum += (double)glow_pdf(v, g, vec3_mad(x, r, o));
        count++;
    }
    return sum / count;
}

/* What balls of a tenth of a voxel to ten of them hold of voxels that are
 * turned, around the heap and beside it. */
static void photon_ball__lines_tell_what_glows(void **state)
{
    (void)state;
    brume_scene *s = small_fire();
    struct flat *flat = truth_flat(s);
    const flat_scene *v = &flat->view;
    flat_glow g = v->glows[0];
    double squares = 0.0, most = 0.0;
    for (int n = 0; n < 100; n++) {
        rng r = rng_make(2, 0, 0, (uint64_t)n);
        turn_voxels(&g, &r);
        float q[3], radius = 0.1f * fm_pow(100.0f, rng_float(&r));
        for (int k = 0; k < 3; k++)
            q[k] = (float)g.origin[k] + 32.0f + 16.0f * (rng_float(&r) - 0.5f);
        vec3 x = affine_point(&g.from_index, vec3_make(q[0], q[1], q[2]));
        double truth = mean_of_places(v, &g, x, radius);
        double found = (double)ball_glow(v, &g, x, radius, team_alone());
        /* Sums of floats do not tell what is a millionth of all. */
        if (!(truth > 1e-3))
            continue;
        double off = found / truth - 1.0;
        squares += off * off / 100.0;
        most = fmax(most, fabs(off));
    }
    if (!(most < 0.05) || !(sqrt(squares) < 0.01))
        fail_msg("balls are off by %.3g, %.3g at most", sqrt(squares), most);
    flat_free(flat);
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photon_ball__a_place_tells_of_one_medium),
        cmocka_unit_test(photon_ball__points_are_the_tables),
        cmocka_unit_test(photon_ball__lines_tell_what_glows),
        cmocka_unit_test(photon_ball__finds_what_is_thick),
        cmocka_unit_test(photon_ball__births_light_a_sphere),
        cmocka_unit_test(photon_ball__light_stays_where_media_are_thick),
        cmocka_unit_test(photon_ball__cells_take_noise_and_nothing_else),
        cmocka_unit_test(photon_ball__surfaces_gather_cells),
        cmocka_unit_test(photon_ball__births_are_as_hot_as_the_place),
        cmocka_unit_test(photon_ball__voxels_have_their_share_of_births),
        cmocka_unit_test(photon_ball__voxels_weigh_as_they_glow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
