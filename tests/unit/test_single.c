/* Places along the eye's ray at which light is sought that media scatter once:
 * as dense as these scatter, and come through, whatever edges they have. */
#include <string.h>
#include "core/physics/inside.h"
#include "core/physics/single.h"
#include "tests/unit/heap_scene.h"
#include "tests/unit/truth_flat.h"

/* A ray in the box around the media, and what the profile says of it. */
struct ray {
    path_state path;
    track_counters count;
    single_profile profile;
    float end;
};

/* Media that end from one voxel to the next, of a depth of 1 a voxel or 8. */
static brume_scene *edges(int media)
{
    struct brume_globals g = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&g, 5.0, 0.45);
    for (int i = 0; i < media; i++) {
        struct brume_medium m = truth_medium(1.0, i ? 16.0 : 2.0, 0.0);
        m.density[0] = heap_add(s, 32, 0.0, i ? 3.3 : 12.6);
        m.densities = 1;
        truth_fill(s, truth_box(1.0, -1.0, 1.0), &m);
    }
    return s;
}

static bool begin(const struct flat *f, int n, struct ray *r)
{
    const flat_scene *v = &f->view;
    rng random = rng_make(3, 0, 0, (uint64_t)n);
    float x = 1.8f * rng_float(&random) - 0.9f;
    float y = 1.8f * rng_float(&random) - 0.9f;
    vec3 o = vec3_scale(vec3_make(x, y, -0.999f), (float)f->unit);
    vec3 to = vec3_scale(vec3_make(0.8f * rng_float(&random) - 0.4f,
                                   0.8f * rng_float(&random) - 0.4f, 0.999f),
                         (float)f->unit);
    container_set set;
    vec3 way = vec3_sub(to, o);
    inside_find(v, o, &set);
    path_begin(&r->path, o, vec3_normalize(way), &set, true, random);
    memset(&r->count, 0, sizeof r->count);
    r->path.count = &r->count;
    r->end = vec3_length(way);
    return single_look(v, &r->path, r->end, &r->profile);
}

/* What is scattered at t, in units of what the profile holds, and comes
 * through. */
static double comes(const flat_scene *s, struct ray *r, float t)
{
    float sigma_s;
    vec3 away = vec3_scale(r->path.d, -1.0f);
    rgb at = path_scattered(s, &r->path, t, away, &sigma_s);
    line_integral line = line_zero();
    if (rgb_is_black(at))
        return 0.0;
    line_integrate(s, &r->path.inside, r->path.o, r->path.d, r->path.after.t, t,
                   0.0f, false, false, line_jitter_make(0.5f, 0.5f), &line);
    return (double)(sigma_s * line_transmittance(&line).r);
}

/* Of even places, the sum of all: beside that at many points of the ray. No
 * place counts much more than it would if all were as dense as they should be,
 * but where what comes through changes within half a voxel. */
static void check(const struct flat *f, int n, double *most)
{
    enum { PLACES = 400, POINTS = 20000 };
    const flat_scene *v = &f->view;
    struct ray r;
    double sum = 0.0, truth = 0.0;
    if (!begin(f, n, &r))
        return;
    float all = r.profile.sum[r.profile.count];
    for (int i = 0; i < PLACES; i++) {
        single_spot at = single_place(v, &r.path, &r.profile,
                                      all * ((float)i + 0.5f) / PLACES);
        double value = comes(v, &r, at.t);
        double known = (double)single_at(v, &r.path, &r.profile, at.t).density;
        assert_true(at.density > 0.0f);
        if (!(fabs(known / (double)at.density - 1.0) < 1e-2))
            fail_msg("ray %d: density %g at %g, told as %g", n,
                     (double)at.density, (double)at.t, known);
        *most = fmax(*most, value / (double)at.density);
        sum += value / (double)at.density * (double)all / PLACES;
    }
    for (int i = 0; i < POINTS; i++)
        truth += comes(v, &r, r.end * ((float)i + 0.5f) / POINTS) *
                 (double)r.end / POINTS;
    if (!(fabs(sum - truth) <= 0.02 * truth + 1e-4))
        fail_msg("ray %d: places make %g, points %g", n, sum, truth);
}

static void single__places_follow_what_scatters(void **state)
{
    (void)state;
    for (int media = 1; media <= 2; media++) {
        double most = 0.0;
        brume_scene *s = edges(media);
        struct flat *f = truth_flat(s);
        for (int n = 0; n < 100; n++)
            check(f, n, &most);
        if (!(most > 0.9 && most < 3.5))
            fail_msg("%d media: a place counts %g times", media, most);
        flat_free(f);
        brume_scene_free(s);
    }
}

/* Pictures of thick media with such edges, the sun behind: how far pixels stray
 * from their means over seeds, and below 0. */
static void single__edges_leave_no_outliers(void **state)
{
    (void)state;
    enum { SIDE = 32, NUMBERS = 3 * SIDE * SIDE, SEEDS = 12 };
    static float seen[SEEDS][NUMBERS];
    brume_scene *s = edges(2);
    heap_sun(s);
    double mean = 0.0, least = 0.0, most = 0.0, squares = 0.0;
    for (int k = 0; k < SEEDS; k++) {
        struct brume_options o = BRUME_OPTIONS_INIT;
        struct brume_frame f;
        o.integrator = BRUME_INTEGRATOR_PHOTON;
        o.width = o.height = SIDE;
        o.photons.count = 20000;
        o.spp = 4;
        o.seed = (uint64_t)k + 1;
        assert_true(brume_render(s, &o, &f, truth_error()));
        memcpy(seen[k], f.radiance, sizeof seen[k]);
        brume_frame_free(&f);
    }
    for (int i = 0; i < NUMBERS; i++) {
        double middle = 0.0;
        for (int k = 0; k < SEEDS; k++)
            middle += (double)seen[k][i] / SEEDS;
        for (int k = 0; k < SEEDS; k++) {
            double off = (double)seen[k][i] - middle;
            most = fmax(most, fabs(off));
            least = fmin(least, (double)seen[k][i]);
            squares += off * off / (NUMBERS * SEEDS);
        }
        mean += middle / NUMBERS;
    }
    double noise = sqrt(squares);
    if (!(most < 2.5 * mean) || !(least > -0.2 * mean) || !(noise < 0.3 * mean))
        fail_msg("of a mean of %g: off by %g at most, least %g, noise %g", mean,
                 most, least, noise);
    brume_scene_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single__places_follow_what_scatters),
        cmocka_unit_test(single__edges_leave_no_outliers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
