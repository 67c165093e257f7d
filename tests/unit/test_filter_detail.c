/* How fast detail changes, seen through noise that is far above it, and weights
 * that keep it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/filter_fall.h"
#include "tests/unit/truth.h"

enum { TAPS = BRUME_MAX_TAPS, REACH = BRUME_MAX_REACH };
enum { BRICKS = 200, COLORS = 3 };

static uint64_t state_of_chance = 1;

/* Of a normal law, nearly: mean 0, variance 1. */
static float chance(void)
{
    float sum = -6.0f;
    for (int i = 0; i < 12; i++) {
        state_of_chance = state_of_chance * 6364136223846793005u +
                          1442695040888963407u;
        sum += (float)(state_of_chance >> 40) / 16777216.0f;
    }
    return sum;
}

/* A brick of a frame as each half of its photons has it: blocks of 24 numbers,
 * whose noise is as much for each half as makes `noise` squared for both. */
static void halve(const float value[FILTER_BLOCKS], float noise, int k,
                  struct filter_common *out, float block[FILTER_BLOCKS])
{
    double sum[2] = {0}, product = 0.0, square = 0.0;
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        float both[2];
        for (int h = 0; h < 2; h++) {
            both[h] = 7.0f + value[i] + sqrtf(2.0f) * noise * chance();
            sum[h] += (double)both[h];
        }
        block[i] = 0.5f * (both[0] + both[1]);
        product += (double)both[0] * (double)both[1];
        square += pow((double)(both[0] - both[1]), 2.0);
    }
    double off = pow(sum[0] - sum[1], 2.0);
    out->own[k] = (float)(product - sum[0] * sum[1] / FILTER_BLOCKS);
    out->noise += (float)(0.25 * (square - off / FILTER_BLOCKS) / TAPS);
    out->whole[k] = (float)(sum[0] * sum[1]);
    out->whole_noise += (float)(0.25 * off / TAPS);
    out->given |= 1u << k;
}

/* How the detail of a block, of variance 1, goes on from frame to frame. */
typedef void (*course)(float value[TAPS], float keep);

static void fading(float value[TAPS], float keep)
{
    for (int k = 0; k < TAPS; k++)
        value[k] = k == 0 ? chance()
                          : keep * value[k - 1] +
                                sqrtf(1.0f - keep * keep) * chance();
}

/* A part of it lives for one frame, and the rest for ever. */
static void flickering(float value[TAPS], float keep)
{
    float stays = chance();
    for (int k = 0; k < TAPS; k++)
        value[k] = sqrtf(keep) * stays + sqrtf(1.0f - keep) * chance();
}

static void make_brick(course go, float keep, float noise,
                       struct filter_common *out)
{
    static struct filter_detail detail;
    static float color[FILTER_CELLS * COLORS];
    float there[FILTER_BLOCKS], value[FILTER_BLOCKS][TAPS];
    bool has[TAPS];
    memset(out, 0, sizeof *out);
    filter_detail_begin(&detail);
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        there[i] = 1.0f;
        go(value[i], keep);
    }
    for (int k = 0; k < TAPS; k++) {
        float now[FILTER_BLOCKS], block[FILTER_BLOCKS];
        has[k] = true;
        for (int i = 0; i < FILTER_BLOCKS; i++)
            now[i] = value[i][k];
        halve(now, noise, k, out, block);
        for (int i = 0; i < FILTER_CELLS * COLORS; i++) {
            int cell = i / COLORS;
            color[i] = block[(cell >> 7) * 16 + (cell >> 4 & 3) * 4 +
                             (cell >> 1 & 3)] /
                       24.0f;
        }
        filter_detail_add(&detail, k, color, there);
    }
    out->counts = filter_detail_sum(&detail, has, TAPS, out);
}

static void find(course go, float keep, float noise, float lost[REACH + 1])
{
    static struct filter_common common[BRICKS];
    struct filter_kinds kinds;
    struct filter_falls falls;
    double weight[TAPS];
    for (int k = 0; k < TAPS; k++)
        weight[k] = 1.0;
    for (int b = 0; b < BRICKS; b++)
        make_brick(go, keep, noise, &common[b]);
    filter_fall_sort(common, BRICKS, weight, &kinds);
    filter_fall_fit(common, BRICKS, weight, &kinds, &falls);
    memcpy(lost, falls.all, sizeof falls.all);
}

/* In noise of twice its variance. */
static void detail__is_seen_through_noise(void **state)
{
    (void)state;
    float lost[REACH + 1];
    find(fading, 0.95f, 1.5f, lost);
    print_message("lost in 1, 4, 8 frames: %.3f %.3f %.3f\n", (double)lost[1],
                  (double)lost[4], (double)lost[8]);
    assert_float_equal(lost[0], 0.0f, 0.0f);
    assert_float_equal(lost[1], 1.0 - pow(0.95, 1.0), 0.03);
    assert_float_equal(lost[4], 1.0 - pow(0.95, 4.0), 0.06);
    assert_float_equal(lost[8], 1.0 - pow(0.95, 8.0), 0.06);
}

/* No pair of frames tells of what none shares with another: halves do. */
static void detail__of_one_frame_is_seen(void **state)
{
    (void)state;
    float lost[REACH + 1];
    find(flickering, 0.9f, 1.5f, lost);
    print_message("lost in 1, 8 frames: %.3f %.3f\n", (double)lost[1],
                  (double)lost[8]);
    assert_float_equal(lost[1], 0.1, 0.03);
    assert_float_equal(lost[8], 0.1, 0.03);
}

/* In noise of so much variance that what is found has an error, it is as a rule
 * not found to change more slowly than it does. */
static void detail__is_not_trusted_in_more_noise(void **state)
{
    enum { TRIALS = 24 };
    int slow = 0;
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        float lost[REACH + 1];
        find(flickering, 0.9f, 2.0f, lost);
        slow += lost[4] < 0.1f;
    }
    print_message("too slow: %d of %d\n", slow, (int)TRIALS);
    assert_true(slow <= TRIALS / 3);
}

static void detail__that_stays_is_left_alone(void **state)
{
    (void)state;
    float lost[REACH + 1];
    find(fading, 1.0f, 4.0f, lost);
    assert_float_equal(lost[REACH], 0.0f, 0.0f);
}

static double least(struct filter_group *g, double time, double energy,
                    double noise)
{
    *g = (struct filter_group){
        .energy = energy, .noise = noise, .variance = 1.0 / TAPS};
    for (int d = 0; d <= REACH; d++)
        g->lost[d] = 1.0f - expf(-powf((float)(d / time), 1.5f));
    for (int k = 0; k < TAPS; k++)
        g->weight[k] = 1.0f / TAPS;
    return energy;
}

/* What a group loses with its weights, and their squares. */
static void keep(const struct filter_group *g, float slope, float weight[TAPS],
                 double *loss, double *square)
{
    double sum = 0.0;
    *loss = *square = 0.0;
    memcpy(weight, g->weight, sizeof g->weight);
    filter_detail_keep(g->lost, slope, weight);
    for (int k = 0; k < TAPS; k++) {
        sum += (double)weight[k];
        *loss += (double)weight[k] * (double)g->lost[abs(k - REACH)];
        *square += (double)weight[k] * (double)weight[k];
    }
    assert_float_equal(sum, 1.0, 1e-5);
}

/* Of all weights of sum 1 that lose so much, those of the least variance: what
 * is added to them must be at right angles to them. */
static void detail__is_kept_with_least_noise(void **state)
{
    (void)state;
    struct filter_group g;
    float weight[TAPS];
    double loss, square;
    least(&g, 10.0, 1.0, 1.0);
    filter_detail_slopes(&g, 1);
    keep(&g, g.slope, weight, &loss, &square);
    print_message("lost %.4f, variance %.3f\n", loss, square);
    assert_float_equal(loss, 0.005, 1e-5);
    /* Along a change that keeps both: of frames 1, 2 and 3 and the middle. */
    const float *lost = g.lost;
    double a = (double)lost[3] - (double)lost[2],
           b = (double)lost[1] - (double)lost[3],
           c = (double)lost[2] - (double)lost[1];
    double other = a * (double)weight[REACH + 1] +
                   b * (double)weight[REACH + 2] +
                   c * (double)weight[REACH + 3];
    assert_float_equal(other, 0.0, 1e-5);
    assert_true(square < 0.3);
}

/* What is bright for its noise keeps more: to give it back a little of that,
 * and take as much from the other, costs noise. */
static void detail__is_kept_where_noise_is_least(void **state)
{
    (void)state;
    struct filter_group g[2];
    double energy = least(&g[0], 60.0, 1.2, 1.0) + least(&g[1], 60.0, 1.0, 1.2);
    double best = INFINITY, total = 0.0;
    filter_detail_slopes(g, 2);
    for (int i = -1; i <= 1; i++) {
        double lost = 0.0, noise = 0.0, loss, square;
        for (int k = 0; k < 2; k++) {
            float weight[TAPS];
            /* As much loss, by as much less slope for its energy. */
            float more = (k == 0 ? 2.0f : -2.4f) * (float)i;
            keep(&g[k], g[k].slope + more, weight, &loss, &square);
            lost += g[k].energy * loss / energy;
            noise += g[k].noise * square;
        }
        total = i == 0 ? lost : total;
        print_message("slopes %.2f %.2f: lost %.5f, noise %.5f\n",
                      (double)g[0].slope, (double)g[1].slope, lost, noise);
        assert_float_equal(lost, 0.005, 1e-4);
        if (i == 0)
            assert_true(noise < best);
        if (i == 1)
            assert_true(noise > best);
        best = noise;
    }
    assert_float_equal(total, 0.005, 1e-5);
    assert_true(g[0].slope > 1.3f * g[1].slope);
}

static void detail__weights_that_lose_little_stay(void **state)
{
    (void)state;
    struct filter_group g;
    float weight[TAPS];
    least(&g, 10.0, 1.0, 1.0);
    memset(g.lost, 0, sizeof g.lost);
    g.lost[REACH] = 0.04f;
    filter_detail_slopes(&g, 1);
    assert_float_equal(g.slope, 0.0f, 0.0f);
    memcpy(weight, g.weight, sizeof weight);
    filter_detail_keep(g.lost, g.slope, weight);
    assert_memory_equal(g.weight, weight, sizeof weight);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(detail__is_seen_through_noise),
        cmocka_unit_test(detail__of_one_frame_is_seen),
        cmocka_unit_test(detail__is_not_trusted_in_more_noise),
        cmocka_unit_test(detail__that_stays_is_left_alone),
        cmocka_unit_test(detail__is_kept_with_least_noise),
        cmocka_unit_test(detail__is_kept_where_noise_is_least),
        cmocka_unit_test(detail__weights_that_lose_little_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
