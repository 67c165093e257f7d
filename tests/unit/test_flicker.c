/* Flicker and blur of films that are made of formulae, so that the measures
 * are known. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>
#include "parser/flicker.h"

enum { WIDTH = 64, HEIGHT = 8, FRAMES = 48, SIZE = 3 * WIDTH * HEIGHT };

static float truth[FRAMES][SIZE], film[FRAMES][SIZE];

/* Noise of mean 0 and variance 1, of a fixed order. */
static double noise(void)
{
    static uint64_t state = 12345;
    double sum = 0.0;
    for (int i = 0; i < 12; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        sum += (double)(state >> 11) / 9007199254740992.0;
    }
    return sum - 6.0;
}

static struct flicker measure(int frames)
{
    const float *frame[FRAMES], *reference[FRAMES];
    struct flicker out;
    struct brume_error err = {0};
    for (int t = 0; t < FRAMES; t++) {
        frame[t] = film[t];
        reference[t] = truth[t];
    }
    struct flicker_film f = {
        WIDTH, HEIGHT, frames, frame, {reference, reference}};
    assert_true(flicker_find(&f, &out, &err));
    return out;
}

/* A wave of 16 pixels that moves by `speed` of them a frame. */
static void make_truth(double speed)
{
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            truth[t][i] = (float)(2.0 + sin((i / 3 % WIDTH - speed * t) * 2.0 *
                                            3.14159265358979 / 16.0));
}

static void flicker__noise(void **state)
{
    (void)state;
    make_truth(0.0);
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            film[t][i] = truth[t][i] * (float)(1.0 + 0.1 * noise());
    struct flicker f = measure(FRAMES);
    assert_float_equal(f.deviation, 0.1, 0.002);
    assert_float_equal(f.error, 0.01, 0.0008);
    /* Differences have twice the variance, here of a hundredth. */
    assert_float_equal(f.difference, 0.02, 0.0006);
    assert_float_equal(f.detail, 1.0, 0.02);
    assert_true(isnan(f.motion));
    /* White: bins of 5 to 12 Hz of those of 0.5 to 12. */
    assert_float_equal(f.band, 14.5 / 23.5, 0.02);
}

static void flicker__filters_have_their_variance(void **state)
{
    (void)state;
    static float raw[FRAMES + 2][SIZE];
    make_truth(0.0);
    for (int t = 0; t < FRAMES + 2; t++)
        for (int i = 0; i < SIZE; i++)
            raw[t][i] = truth[0][i] + 0.1f * (float)noise();
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            film[t][i] = raw[t + 1][i];
    struct flicker one = measure(FRAMES);
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            film[t][i] = 0.25f * raw[t][i] + 0.5f * raw[t + 1][i] +
                         0.25f * raw[t + 2][i];
    struct flicker three = measure(FRAMES);
    assert_float_equal(pow(three.deviation / one.deviation, 2.0), 0.375, 0.02);
    assert_float_equal(three.difference / one.difference, 0.125, 0.01);
    assert_true(three.band < 0.6 * one.band);
}

/* A mean over three frames of a wave that moves leaves (1 + cos w) / 2 of it,
 * where w is its turn in a frame. */
static void flicker__blur_is_no_gain(void **state)
{
    (void)state;
    double left = (1.0 + cos(2.0 * 3.14159265358979 / 8.0)) / 2.0;
    make_truth(2.0);
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            film[t][i] = (float)(2.0 + left * ((double)truth[t][i] - 2.0));
    struct flicker f = measure(FRAMES);
    assert_float_equal(f.motion, left, 1e-4);
    assert_float_equal(f.detail, left, 1e-4);
    assert_true(isnan(measure(23).band));
}

/* Nor does noise of the references, where each has its own. */
static void flicker__references_may_be_noisy(void **state)
{
    (void)state;
    static float noisy[2][FRAMES][SIZE];
    const float *frame[FRAMES], *reference[2][FRAMES];
    struct brume_error err = {0};
    struct flicker out;
    make_truth(1.0);
    for (int t = 0; t < FRAMES; t++) {
        frame[t] = film[t];
        for (int i = 0; i < SIZE; i++)
            film[t][i] = truth[t][i] * (float)(1.0 + 0.1 * noise());
        for (int k = 0; k < 2; k++) {
            reference[k][t] = noisy[k][t];
            for (int i = 0; i < SIZE; i++)
                noisy[k][t][i] = truth[t][i] * (float)(1.0 + 0.1 * noise());
        }
    }
    struct flicker_film f = {
        WIDTH, HEIGHT, FRAMES, frame, {reference[0], reference[1]}};
    assert_true(flicker_find(&f, &out, &err));
    /* Over the mean, which squared is 4 of the mean square of 4.5. */
    assert_float_equal(out.deviation, 0.1 * sqrt(1.125 / 1.01), 0.002);
    assert_float_equal(out.error, 0.01, 0.0008);
    assert_float_equal(out.difference, 0.02, 0.001);
    assert_float_equal(out.detail, 1.0, 0.03);
    assert_float_equal(out.motion, 1.0, 0.03);
    assert_float_equal(out.band, 14.5 / 23.5, 0.03);
}

static void flicker__of_itself_is_none(void **state)
{
    (void)state;
    make_truth(1.0);
    for (int t = 0; t < FRAMES; t++)
        for (int i = 0; i < SIZE; i++)
            film[t][i] = truth[t][i];
    struct flicker f = measure(FRAMES);
    assert_true(f.error == 0.0 && f.deviation == 0.0 && f.difference == 0.0);
    assert_float_equal(f.motion, 1.0, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flicker__noise),
        cmocka_unit_test(flicker__filters_have_their_variance),
        cmocka_unit_test(flicker__blur_is_no_gain),
        cmocka_unit_test(flicker__references_may_be_noisy),
        cmocka_unit_test(flicker__of_itself_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
