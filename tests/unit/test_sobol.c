/* test_sobol.c - the points of a pixel: how evenly they lie, for any seed; and
 * that lines and samples take them without a gap. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/pixel.h"

enum { SEEDS = 20, MOST = 10 };

static uint32_t seed_of(int i)
{
    return (uint32_t)rng_mix((uint64_t)i + 1);
}

static void point(uint32_t n, int seed, uint32_t out[SOBOL_DIMENSIONS])
{
    sobol_point(n, out);
    for (int d = 0; d < SOBOL_DIMENSIONS; d++)
        out[d] = sobol_scramble(out[d], seed_of(SOBOL_DIMENSIONS * seed + d));
}

/* Of 2^k points one is in each of the 2^k intervals of each coordinate. */
static void test_intervals(void **state)
{
    (void)state;
    for (int seed = 0; seed < SEEDS; seed++)
        for (int k = 1; k <= MOST; k++) {
            unsigned char taken[SOBOL_DIMENSIONS][1 << MOST] = {{0}};
            for (uint32_t n = 0; n < 1u << k; n++) {
                uint32_t x[SOBOL_DIMENSIONS];
                point(n, seed, x);
                for (int d = 0; d < SOBOL_DIMENSIONS; d++)
                    assert_int_equal(taken[d][x[d] >> (32 - k)]++, 0);
            }
        }
}

/* ... and of each shape of rectangles of that area in the pixel. */
static void test_rectangles(void **state)
{
    (void)state;
    for (int seed = 0; seed < SEEDS; seed++)
        for (int wide = 1; wide < MOST; wide++) {
            unsigned char taken[1 << MOST] = {0};
            for (uint32_t n = 0; n < 1u << MOST; n++) {
                uint32_t x[SOBOL_DIMENSIONS];
                point(n, seed, x);
                uint32_t at = x[0] >> (32 - wide) << (MOST - wide);
                at |= x[1] >> (32 - (MOST - wide));
                assert_int_equal(taken[at]++, 0);
            }
        }
}

/* A pair's points are as even, in whatever order, and by each seed in one of
 * its own. */
static void test_pairs(void **state)
{
    (void)state;
    int apart = 0;
    for (int seed = 0; seed < SEEDS; seed++)
        for (int wide = 0; wide <= MOST; wide++) {
            unsigned char taken[1 << MOST] = {0};
            for (uint32_t n = 0; n < 1u << MOST; n++) {
                const uint32_t s[3] = {seed_of(seed), seed_of(seed + 100),
                                       seed_of(seed + 200)};
                const uint32_t t[3] = {seed_of(seed + 300), s[1], s[2]};
                uint32_t x[2], y[2];
                sobol_pair(n + (1u << 20), s, x);
                sobol_pair(n + (1u << 20), t, y);
                apart += x[0] != y[0];
                uint32_t at = wide ? x[0] >> (32 - wide) << (MOST - wide) : 0;
                at |= wide < MOST ? x[1] >> (32 - (MOST - wide)) : 0;
                assert_int_equal(taken[at]++, 0);
            }
        }
    assert_true(apart > SEEDS * (MOST + 1) << (MOST - 1));
}

/* Where a point lies depends on the seed alone, and any place is as likely. */
static void test_seeds(void **state)
{
    (void)state;
    enum { RUNS = 40000, BINS = 16 };
    for (uint32_t n = 0; n < 5; n++)
        for (int d = 0; d < SOBOL_DIMENSIONS; d++) {
            int count[BINS] = {0};
            double chi = 0;
            for (int i = 0; i < RUNS; i++) {
                uint32_t x[SOBOL_DIMENSIONS];
                point(n, i, x);
                float v = sobol_float(x[d]);
                assert_true(v >= 0 && v < 1);
                count[(int)(v * BINS)]++;
            }
            for (int i = 0; i < BINS; i++) {
                double off = count[i] - (double)RUNS / BINS;
                chi += off * off / ((double)RUNS / BINS);
            }
            assert_true(chi < 45); /* 15 degrees: 1 in 10^4 */
        }
}

/* Lines take points without a gap, and both halves' are counted right. */
static void test_lines(void **state)
{
    (void)state;
    for (int sampled = 0; sampled < 2; sampled++) {
        uint32_t next = 0, half[2] = {0, 0};
        for (uint32_t i = 0; i < 300; i++) {
            assert_int_equal(pixel_lines(i, sampled), next);
            for (uint32_t k = 0; k < 2; k++)
                assert_int_equal(pixel_samples(next, k), half[k]);
            bool line = sampled || i < 4 || i % 8 == 0;
            assert_int_equal(pixel_lines(i + 1, sampled) - next, line);
            if (line)
                half[pixel_half(next++)]++;
        }
        assert_true(next == (sampled ? 300 : 41));
    }
}

/* Samples that see one field are of one half. */
static void test_shares(void **state)
{
    (void)state;
    for (uint32_t share = 1; share <= 8; share *= 2) {
        uint32_t half[2] = {0, 0};
        for (uint32_t n = 0; n < 200; n++) {
            for (uint32_t k = 0; k < 2; k++)
                assert_int_equal(pixel_shared(n, share, k), half[k]);
            half[pixel_half(n / share)]++;
        }
    }
}

/* Each rectangle of a pixel, wide or high, that has four of the first 2^k
 * points has two of each half. */
static void test_halves(void **state)
{
    (void)state;
    for (int k = 2; k <= MOST; k++)
        for (int wide = 0; wide <= k - 2; wide++) {
            int high = k - 2 - wide;
            unsigned char taken[2][1 << MOST] = {{0}};
            for (uint32_t n = 0; n < 1u << k; n++) {
                uint32_t x[SOBOL_DIMENSIONS];
                point(n, k, x);
                uint64_t column = (uint64_t)x[0] << wide >> 32;
                uint64_t row = (uint64_t)x[1] << high >> 32;
                taken[pixel_half(n)][row << wide | column]++;
            }
            for (int i = 0; i < 1 << (k - 2); i++) {
                assert_int_equal(taken[0][i], 2);
                assert_int_equal(taken[1][i], 2);
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_intervals), cmocka_unit_test(test_rectangles),
        cmocka_unit_test(test_seeds),     cmocka_unit_test(test_lines),
        cmocka_unit_test(test_halves),    cmocka_unit_test(test_pairs),
        cmocka_unit_test(test_shares)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
