/* How fast detail changes, seen through noise that is far above it, and weights
 * that keep it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/filter_detail.h"
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

/* Bricks whose detail, of variance 1 in each block's sum of 24, goes on from
 * frame to frame by `keep` of it; noise of each number besides. */
static void make_bricks(float keep, float noise, struct filter_common *out)
{
    static struct filter_detail detail;
    static float color[FILTER_CELLS * COLORS];
    float there[FILTER_BLOCKS], value[FILTER_BLOCKS];
    bool has[TAPS];
    for (int i = 0; i < FILTER_BLOCKS; i++)
        there[i] = 1.0f;
    for (int b = 0; b < BRICKS; b++) {
        filter_detail_begin(&detail);
        for (int k = 0; k < TAPS; k++) {
            has[k] = true;
            for (int i = 0; i < FILTER_BLOCKS; i++)
                value[i] = k == 0 ? chance()
                                  : keep * value[i] +
                                        sqrtf(1.0f - keep * keep) * chance();
            for (int i = 0; i < FILTER_CELLS * COLORS; i++) {
                int cell = i / COLORS;
                int block = (cell >> 7) * 16 + (cell >> 4 & 3) * 4 +
                            (cell >> 1 & 3);
                color[i] = 7.0f + value[block] / 24.0f + noise * chance();
            }
            filter_detail_add(&detail, k, color, there);
        }
        filter_detail_sum(&detail, has, TAPS, &out[b]);
    }
}

static void find(float keep, float noise, float lost[REACH + 1])
{
    static struct filter_common common[BRICKS];
    double weight[TAPS];
    for (int k = 0; k < TAPS; k++)
        weight[k] = 1.0;
    make_bricks(keep, noise, common);
    filter_detail_fit(common, BRICKS, weight, lost);
}

/* In noise of twice its variance. */
static void detail__is_seen_through_noise(void **state)
{
    (void)state;
    float lost[REACH + 1];
    find(0.95f, 0.3f, lost);
    print_message("lost in 1, 4, 8 frames: %.3f %.3f %.3f\n", (double)lost[1],
                  (double)lost[4], (double)lost[8]);
    assert_float_equal(lost[0], 0.0f, 0.0f);
    assert_float_equal(lost[1], 1.0 - pow(0.95, 1.0), 0.05);
    assert_float_equal(lost[4], 1.0 - pow(0.95, 4.0), 0.08);
    assert_float_equal(lost[8], 1.0 - pow(0.95, 8.0), 0.08);
}

static void detail__that_stays_is_left_alone(void **state)
{
    (void)state;
    float lost[REACH + 1];
    find(1.0f, 1.0f, lost);
    assert_float_equal(lost[REACH], 0.0f, 0.0f);
    find(0.0f, 1.0f, lost);
    print_message("of nothing: %.3f\n", (double)lost[REACH]);
}

/* Of all weights of sum 1 that lose so much, those of the least variance: what
 * is added to them must be at right angles to them. */
static void detail__is_kept_with_least_noise(void **state)
{
    (void)state;
    float lost[REACH + 1], weight[TAPS];
    double sum = 0.0, loss = 0.0, square = 0.0, other = 0.0;
    for (int d = 0; d <= REACH; d++)
        lost[d] = 1.0f - expf(-powf((float)d / 10.0f, 1.5f));
    for (int k = 0; k < TAPS; k++)
        weight[k] = 1.0f / TAPS;
    filter_detail_keep(lost, weight);
    for (int k = 0; k < TAPS; k++) {
        sum += (double)weight[k];
        loss += (double)weight[k] * (double)lost[abs(k - REACH)];
        square += (double)weight[k] * (double)weight[k];
    }
    print_message("lost %.4f, variance %.3f\n", loss, square);
    assert_float_equal(sum, 1.0, 1e-5);
    assert_float_equal(loss, 0.01, 1e-5);
    /* Along a change that keeps both: of frames 1, 2 and 3 and the middle. */
    double a = (double)lost[3] - (double)lost[2],
           b = (double)lost[1] - (double)lost[3],
           c = (double)lost[2] - (double)lost[1];
    other = a * (double)weight[REACH + 1] + b * (double)weight[REACH + 2] +
            c * (double)weight[REACH + 3];
    assert_float_equal(other, 0.0, 1e-5);
    assert_true(square < 0.25);
}

static void detail__weights_that_lose_little_stay(void **state)
{
    (void)state;
    float lost[REACH + 1] = {0}, weight[TAPS], before[TAPS];
    for (int k = 0; k < TAPS; k++)
        weight[k] = 1.0f / TAPS;
    memcpy(before, weight, sizeof before);
    lost[REACH] = 0.05f;
    filter_detail_keep(lost, weight);
    assert_memory_equal(before, weight, sizeof before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(detail__is_seen_through_noise),
        cmocka_unit_test(detail__that_stays_is_left_alone),
        cmocka_unit_test(detail__is_kept_with_least_noise),
        cmocka_unit_test(detail__weights_that_lose_little_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
