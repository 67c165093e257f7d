/* T5 of METHODS.md: the fluence around a point source in an infinite medium,
 * by following photons with the tracking that paths use. */
#include "tests/unit/truth_flat.h"
#include "core/physics/path.h"

/* ---- the truth: Case and Zweifel 1967, by quadrature ------------------- */

/* a atanh(k) = k by bisection. */
static double diffusion_root(double a)
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

static double transient(double a, double r)
{
    const int n = 4000;
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        double m = (i + 0.5) / n;
        double p = 1.0 - a * m * atanh(m), q = 0.5 * a * TRUTH_PI * m;
        sum += exp(-r / m) / (m * m * (p * p + q * q));
    }
    return sum / (4.0 * TRUTH_PI * r * n);
}

static double fluence(double a, double r)
{
    double k = diffusion_root(a), k2 = k * k;
    double pole = k2 * (1.0 - k2) * exp(-k * r) /
                  (2.0 * TRUTH_PI * r * a * (k2 + a - 1.0));
    return pole + transient(a, r);
}

/* Fluence times volume of a shell. */
static double shell_truth(double a, double lo, double hi)
{
    const double node[3] = {0.112701665379258, 0.5, 0.887298334620742};
    const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        double r = lo + node[i] * (hi - lo);
        sum += weight[i] * 4.0 * TRUTH_PI * r * r * fluence(a, r);
    }
    return sum * (hi - lo);
}

static void photons__truth_matches_table(void **state)
{
    (void)state;
    const double rows[][3] = {{0.5, 1.0, 0.05869514},
                              {0.9, 0.5, 0.4828327},
                              {0.9, 5.0, 0.002915125},
                              {0.99, 2.0, 0.08497689}};
    for (int i = 0; i < 4; i++)
        assert_true(fabs(fluence(rows[i][0], rows[i][1]) / rows[i][2] - 1.0) <
                    2e-4);
}

/* ---- photons ----------------------------------------------------------- */

enum { SHELLS = 4, BATCHES = 32 };
static const double edges[SHELLS][2] = {
    {0.45, 0.55}, {0.95, 1.05}, {1.9, 2.1}, {4.8, 5.2}};

/* Length of o + t d, t in [0, t1], inside the ball of radius r. */
static double length_in_ball(vec3 o, vec3 d, double t1, double r)
{
    double b = (double)vec3_dot(o, d);
    double c = (double)vec3_dot(o, o) - r * r, disc = b * b - c;
    if (disc <= 0.0)
        return 0.0;
    double lo = fmax(-b - sqrt(disc), 0.0), hi = fmin(-b + sqrt(disc), t1);
    return fmax(hi - lo, 0.0);
}

static void follow(const flat_scene *s, uint64_t photon, double tally[SHELLS])
{
    const container_set nowhere = {0, 0, {0}};
    rng random = rng_make(1, 0, 0, photon);
    float u = rng_float(&random);
    vec3 d = warp_sphere(u, rng_float(&random));
    path_state p;
    track_counters count = {0};
    path_event at = {0.0f, 0, 0.0f};
    int event;
    path_begin(&p, vec3_make(0.0f, 0.0f, 0.0f), d, &nowhere, false, random);
    p.count = &count;
    do {
        event = path_media(s, &p, s->far, &at);
        double length = event == PATH_THROUGH ? (double)s->far : (double)at.t;
        for (int i = 0; i < SHELLS; i++)
            tally[i] += length_in_ball(p.o, p.d, length,
                                       edges[i][1] * (double)s->unit) -
                        length_in_ball(p.o, p.d, length,
                                       edges[i][0] * (double)s->unit);
        if (event != PATH_SCATTERED)
            return;
        const flat_medium *m = &s->media[at.medium];
        float pdf, v = rng_float(&p.random);
        vec3 next = phase_sample(m->phase, m->g, p.d, v, rng_float(&p.random),
                                 &pdf);
        path_turn(&p, vec3_mad(p.o, at.t, p.d), next, pdf);
    } while (event == PATH_SCATTERED);
}

static struct flat *infinite_medium(double albedo, brume_scene **scene)
{
    *scene = brume_scene_new(truth_error());
    struct brume_medium m = truth_medium(1.0 - albedo, albedo, 0.0);
    int id = brume_add_medium(*scene, &m, truth_error());
    int in = brume_add_interior(*scene, &id, 1, truth_error());
    assert_true(brume_set_atmosphere(*scene, in, truth_error()));
    return truth_flat(*scene);
}

static void check_fluence(double albedo, int photons)
{
    brume_scene *scene;
    struct flat *f = infinite_medium(albedo, &scene);
    double sum[SHELLS] = {0}, squares[SHELLS] = {0};
    uint64_t n = 0;
    for (int b = 0; b < BATCHES; b++) {
        double tally[SHELLS] = {0};
        for (int i = 0; i < photons / BATCHES; i++)
            follow(&f->view, n++, tally);
        for (int i = 0; i < SHELLS; i++) {
            double x = tally[i] / (photons / BATCHES) / f->unit;
            sum[i] += x;
            squares[i] += x * x;
        }
    }
    for (int i = 0; i < SHELLS; i++) {
        double mean = sum[i] / BATCHES;
        double error = sqrt((squares[i] / BATCHES - mean * mean) /
                            (BATCHES - 1));
        double truth = shell_truth(albedo, edges[i][0], edges[i][1]);
        double z = (mean - truth) / hypot(error, 5e-5 * truth);
        if (!(fabs(z) < 4.0) || !(error < 2e-2 * truth))
            fail_msg("albedo %g, r %g: %.7g +- %.1g, truth %.7g, z %.2f",
                     albedo, edges[i][0], mean, error, truth, z);
    }
    flat_free(f);
    brume_scene_free(scene);
}

static void photons__fluence_albedo_half(void **state)
{
    (void)state;
    check_fluence(0.5, 800000);
}

static void photons__fluence_albedo_high(void **state)
{
    (void)state;
    check_fluence(0.99, 40000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(photons__truth_matches_table),
        cmocka_unit_test(photons__fluence_albedo_half),
        cmocka_unit_test(photons__fluence_albedo_high),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
