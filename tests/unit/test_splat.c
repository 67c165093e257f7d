/* The ball kernel of a gather (METHODS.md 13.10, T11): events laid into balls
 * give the mean over a ball of what lies around, with the bias and the variance
 * that this has. */
#include "tests/unit/truth.h"
#include <string.h>
#include "core/physics/radiance.h"
#include "core/physics/rng.h"

/* A lattice of one brick, whose cell MIDDLE has its middle at 0. */
enum { CELLS = 512, MIDDLE = (4 * 8 + 4) * 8 + 4 };
#define RADIUS 0.9

struct field {
    flat_scene scene;
    int32_t slot;
    int64_t sum[3 * CELLS];
};

static void field_init(struct field *f)
{
    memset(f, 0, sizeof *f);
    f->scene.radiance_slots = &f->slot;
    f->scene.view.location = vec3_make(0.0f, 0.0f, -100.0f);
    f->scene.field = (radiance_lattice){.origin = {-4.5f, -4.5f, -4.5f},
                                        .side = 1.0f,
                                        .bricks = {1, 1, 1},
                                        .numbers = 3,
                                        .eye = 0,
                                        .fluence = -1,
                                        .flux = -1,
                                        .ball = 1,
                                        .radius = (float)RADIUS};
}

static void lay(struct field *f, const double x[3], double power)
{
    radiance_tally tally = {.sum = f->sum};
    radiance_event event = {
        .p = vec3_make((float)x[0], (float)x[1], (float)x[2]),
        .d = vec3_make(0.0f, 0.0f, 1.0f),
        .phase = PHASE_ISOTROPIC,
        .power = rgb_gray((float)power)};
    radiance_store(&f->scene, &tally, &event);
    assert_int_equal(tally.clipped, 0);
}

/* What the middle cell holds, events of power 1 counting 1. */
static double middle(const struct field *f)
{
    return (double)f->sum[3 * MIDDLE] / RADIANCE_ONE * 4.0 * TRUTH_PI;
}

typedef double function(double x, double k);

static double wave(double x, double k)
{
    return cos(k * x);
}

static double power_of(double x, double k)
{
    return pow(x, k);
}

/* The mean of a function of x over the ball: events on a fine lattice. */
static double mean_over_ball(function *of, double k)
{
    enum { HALF = 40 };
    struct field all, one;
    field_init(&all);
    field_init(&one);
    for (int i = 0; i < 8 * HALF * HALF * HALF; i++) {
        double x[3];
        int at[3] = {i % (2 * HALF), i / (2 * HALF) % (2 * HALF),
                     i / (4 * HALF * HALF)};
        for (int c = 0; c < 3; c++)
            x[c] = (at[c] + 0.5 - HALF) / HALF * RADIUS;
        lay(&all, x, of(x[0], k));
        lay(&one, x, 1.0);
    }
    return middle(&all) / middle(&one);
}

static void splat__waves(void **state)
{
    (void)state;
    const double truth[][2] = {
        {0.5, 0.97522218}, {1.0, 0.90350604}, {2.0, 0.65309666}};
    for (int i = 0; i < 3; i++) {
        double gain = mean_over_ball(wave, truth[i][0] / RADIUS);
        if (!(fabs(gain - truth[i][1]) < 3e-4))
            fail_msg("q = %g: gain %.6f, not %.6f", truth[i][0], gain,
                     truth[i][1]);
    }
}

/* r^2 / 10 of the Laplacian, r^4 / 280 of its own: 2 and 0 for x^2, 0 and 24
 * for x^4 at 0. */
static void splat__bias(void **state)
{
    (void)state;
    double second = mean_over_ball(power_of, 2.0);
    double fourth = mean_over_ball(power_of, 4.0);
    assert_float_equal(second / (pow(RADIUS, 2.0) / 5.0), 1.0, 1e-3);
    assert_float_equal(fourth / (pow(RADIUS, 4.0) * 24.0 / 280.0), 1.0, 1e-3);
}

/* Of photons thrown at random into a cube, those in the ball: their relative
 * variance is 1 / (photons in the ball) times the chance to miss it. */
static void splat__variance(void **state)
{
    (void)state;
    enum { BATCHES = 20000, PHOTONS = 60 };
    double sum = 0.0, square = 0.0;
    rng random = rng_make(7u, 0u, 0u, 0u);
    for (int b = 0; b < BATCHES; b++) {
        struct field f;
        field_init(&f);
        for (int i = 0; i < PHOTONS; i++) {
            double x[3];
            for (int c = 0; c < 3; c++)
                x[c] = (2.0 * (double)rng_float(&random) - 1.0) * RADIUS;
            lay(&f, x, 1.0);
        }
        double n = middle(&f);
        sum += n / BATCHES;
        square += n * n / BATCHES;
    }
    double inside = TRUTH_PI / 6.0, mean = PHOTONS * inside;
    double ratio = (square - sum * sum) / (sum * sum) * mean / (1.0 - inside);
    double sd_mean = sqrt((1.0 - inside) / mean / BATCHES);
    if (!(fabs(sum / mean - 1.0) < 4.0 * sd_mean))
        fail_msg("%.4f photons in the ball, not %.4f", sum, mean);
    if (!(fabs(ratio - 1.0) < 4.0 * sqrt(2.0 / BATCHES)))
        fail_msg("%.4f of their variance", ratio);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splat__waves),
        cmocka_unit_test(splat__bias),
        cmocka_unit_test(splat__variance),
    };
    return cmocka_run_group_tests_name("splat", tests, NULL, NULL);
}
