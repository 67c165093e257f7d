/* test_rng.c - the generator against its published vectors, and the shape of
 * what is made from it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/rng.h"

/* Known answers published with Random123 (philox4x32, 10 rounds). */
static void test_known_answers(void **state)
{
    (void)state;
    static const uint32_t v[3][10] = {
        {0, 0, 0, 0, 0, 0, 0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u},
        {~0u, ~0u, ~0u, ~0u, ~0u, ~0u, 0x408f276du, 0x41c83b0eu, 0xa20bc7c6u,
         0x6d5451fdu},
        {0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u, 0xa4093822u,
         0x299f31d0u, 0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u},
    };
    for (int i = 0; i < 3; i++) {
        uint32_t c[4] = {v[i][0], v[i][1], v[i][2], v[i][3]};
        rng_philox(c, v[i][4], v[i][5]);
        for (int k = 0; k < 4; k++)
            assert_int_equal(c[k], v[i][6 + k]);
    }
}

static void test_streams_are_functions_of_place(void **state)
{
    (void)state;
    rng a = rng_make(1, 2, 3, 5000000000ull);
    rng b = rng_make(1, 2, 3, 5000000000ull);
    for (int i = 0; i < 9; i++)
        assert_int_equal(rng_u32(&a), rng_u32(&b));
    const rng other[] = {rng_make(2, 2, 3, 5000000000ull),
                         rng_make(1, 3, 3, 5000000000ull),
                         rng_make(1, 2, 4, 5000000000ull),
                         rng_make(1, 2, 3, 5000000000ull & 0xffffffffu)};
    for (int i = 0; i < 4; i++) {
        rng c = other[i], d = rng_make(1, 2, 3, 5000000000ull);
        int same = 0;
        for (int k = 0; k < 64; k++)
            same += rng_u32(&c) == rng_u32(&d);
        assert_int_equal(same, 0);
    }
}

/* One flipped bit of the seed or of the frame flips half of the key. */
static void test_key_avalanche(void **state)
{
    (void)state;
    int flips = 0, count = 0;
    for (uint32_t frame = 0; frame < 200; frame++) {
        rng a = rng_make(7, frame, 0, 0);
        for (int bit = 0; bit < 64; bit++) {
            rng b = bit < 32 ? rng_make(7, frame ^ 1u << bit, 0, 0)
                             : rng_make(7 ^ 1ull << bit, frame, 0, 0);
            flips += __builtin_popcount(a.key[0] ^ b.key[0]) +
                     __builtin_popcount(a.key[1] ^ b.key[1]);
            count += 64;
        }
    }
    assert_true(fabs(flips / (double)count - 0.5) < 0.003);
}

/* Mean, variance and the correlation of neighbours in one stream and across
 * paths; 4.5 standard deviations each. */
static void test_uniform(void **state)
{
    (void)state;
    const int n = 1 << 20;
    double sum = 0, square = 0, along = 0, across = 0, last = 0.5;
    rng r = rng_make(1, 0, 0, 0);
    for (int i = 0; i < n; i++) {
        double u = rng_float(&r);
        rng first = rng_make(1, 0, 1, (uint64_t)i);
        rng second = rng_make(1, 0, 1, (uint64_t)i + 1u);
        assert_true(u >= 0.0 && u < 1.0);
        sum += u;
        square += u * u;
        along += (u - 0.5) * (last - 0.5);
        across += (rng_float(&first) - 0.5) * (rng_float(&second) - 0.5);
        last = u;
    }
    double root = sqrt(n);
    assert_true(fabs(sum / n - 0.5) * root < 4.5 * 0.2887);
    assert_true(fabs(square / n - 1.0 / 3.0) * root < 4.5 * 0.2982);
    assert_true(fabs(along) / root < 4.5 / 12.0);
    assert_true(fabs(across) / root < 4.5 / 12.0);
}

/* How many of the 2^64 pairs of words give a depth below t, as a fraction;
 * the depth does not decrease with them. */
static long double fraction_below(float t)
{
    uint64_t lo = 0, hi = ~0ull;
    if (rng_depth_of(0, 0) >= t)
        return 0.0L;
    while (lo < hi) {
        uint64_t mid = lo + (hi - lo) / 2 + 1;
        if (rng_depth_of((uint32_t)(mid >> 32), (uint32_t)mid) < t)
            lo = mid;
        else
            hi = mid - 1;
    }
    return ((long double)lo + 1.0L) * 0x1p-64L;
}

/* Exact counts: both tails are the exponential's to 1e-5, or to one of the
 * 2^64 where that is coarser. */
static void test_depth_counts(void **state)
{
    (void)state;
    for (double t = 1e-19; t <= 44.0; t *= 1.01) {
        long double tau = (float)t, below = fraction_below((float)t);
        long double lower = -expm1l(-tau), upper = expl(-tau);
        assert_true(fabsl(below - lower) < 1e-5L * lower + 0x1p-64L);
        assert_true(fabsl(1.0L - below - upper) < 1e-5L * upper + 0x1p-64L);
    }
    assert_true(rng_depth_of(0, 0) > 0.0f);
    assert_true(rng_depth_of(~0u, ~0u) > 44.9f);
}

static void test_depth_is_monotone(void **state)
{
    (void)state;
    float last = 0.0f;
    for (uint64_t x = 0; x <= 0xffffffffu; x += 4093) {
        float tau = rng_depth_of((uint32_t)x, 0x80000000u);
        assert_true(tau >= last);
        last = tau;
    }
    assert_true(rng_depth_of(0xffffu, ~0u) <= rng_depth_of(0x10000u, 0));
    assert_true(rng_depth_of(0xfffeffffu, 0) <= rng_depth_of(0xffff0000u, 0));
}

/* The drawn depths: mean and variance 1, and tails as they should be. */
static void test_depth_statistics(void **state)
{
    (void)state;
    const int n = 1 << 22;
    double sum = 0, square = 0;
    int small = 0, large = 0;
    rng r = rng_make(3, 0, 0, 0);
    for (int i = 0; i < n; i++) {
        double tau = rng_optical_depth(&r);
        sum += tau;
        square += tau * tau;
        small += tau < 1e-4;
        large += tau > 9.0;
    }
    assert_true(fabs(sum / n - 1.0) < 4.5 / sqrt(n));
    assert_true(fabs(square / n - 2.0) < 4.5 * sqrt(20.0 / n));
    assert_true(fabs(small - n * 1e-4) < 4.5 * sqrt(n * 1e-4));
    assert_true(fabs(large - n * exp(-9.0)) < 4.5 * sqrt(n * exp(-9.0)));
}

static void test_chance(void **state)
{
    (void)state;
    const int n = 1 << 22;
    const float p[] = {0.3f, 1e-3f, 2e-5f};
    rng r = rng_make(4, 0, 0, 0);
    for (int k = 0; k < 3; k++) {
        int hits = 0;
        for (int i = 0; i < n; i++)
            hits += rng_chance(&r, p[k]);
        double sd = sqrt(n * p[k] * (1.0 - p[k]));
        assert_true(fabs(hits - n * (double)p[k]) < 4.5 * sd);
    }
    for (int i = 0; i < 1000; i++) {
        assert_true(rng_chance(&r, 1.0f));
        assert_false(rng_chance(&r, 0.0f));
        assert_false(rng_chance(&r, NAN));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_answers),
        cmocka_unit_test(test_streams_are_functions_of_place),
        cmocka_unit_test(test_key_avalanche),
        cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_depth_counts),
        cmocka_unit_test(test_depth_is_monotone),
        cmocka_unit_test(test_depth_statistics),
        cmocka_unit_test(test_chance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
