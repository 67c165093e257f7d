/* rng.h - counter-based random numbers: a pure function of where they are
 * used, so that no result depends on threads, machines or order.
 *
 * Philox4x32-10 [Salmon, Moraes, Dror, Shaw 2011]. The key comes from (seed,
 * frame); the counter is (path low, path high, pass, block of four numbers). */
#ifndef CORE_PHYSICS_RNG_H
#define CORE_PHYSICS_RNG_H
#include "core/physics/fmath.h"

typedef struct {
    uint32_t key[2];
    uint32_t counter[4];    /* of the next block                    */
    uint32_t word[4];       /* the block being handed out           */
    uint32_t used;          /* words of it already given, 4 at first */
} rng;

/* One round: two 32x32 -> 64 products, crossed. */
HD void rng_philox_round(uint32_t c[4], uint32_t key0, uint32_t key1)
{
    uint64_t a = (uint64_t)0xd2511f53u * c[0];
    uint64_t b = (uint64_t)0xcd9e8d57u * c[2];
    uint32_t c1 = c[1], c3 = c[3];
    c[0] = (uint32_t)(b >> 32) ^ c1 ^ key0;
    c[1] = (uint32_t)b;
    c[2] = (uint32_t)(a >> 32) ^ c3 ^ key1;
    c[3] = (uint32_t)a;
}

/* By which keys grow from round to round. */
#define RNG_STEP0 0x9e3779b9u
#define RNG_STEP1 0xbb67ae85u

enum { RNG_ROUNDS = 10 };

/* All rounds, in place. */
HD void rng_philox(uint32_t c[4], uint32_t key0, uint32_t key1)
{
    for (int i = 0; i < RNG_ROUNDS; i++) {
        rng_philox_round(c, key0, key1);
        key0 += RNG_STEP0;
        key1 += RNG_STEP1;
    }
}

typedef struct {
    uint32_t word[4];
} rng_block;

/* The block of a counter. */
HD_SHARED rng_block rng_block_of(rng_block counter, uint32_t key0,
                                 uint32_t key1)
{
    rng_philox(counter.word, key0, key1);
    return counter;
}

/* Bijection in which every input bit moves every output bit: the finaliser
 * of splitmix64 [Steele, Lea, Flood 2014; constants: Stafford's mix 13]. */
HD uint64_t rng_mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

/* The stream of one path. Frames and seeds that differ by little must not
 * give keys that do: each passes the mix. */
HD rng rng_make(uint64_t seed, uint32_t frame, uint32_t pass, uint64_t path)
{
    rng r;
    uint64_t key = rng_mix(rng_mix(seed + 0x9e3779b97f4a7c15ull) + frame);
    r.key[0] = (uint32_t)key;
    r.key[1] = (uint32_t)(key >> 32);
    r.counter[0] = (uint32_t)path;
    r.counter[1] = (uint32_t)(path >> 32);
    r.counter[2] = pass;
    r.counter[3] = 0u;
    r.word[0] = r.word[1] = r.word[2] = r.word[3] = 0u;
    r.used = 4u;
    return r;
}

/* The next word of a block of which some are left. No indexing: the block stays
 * in registers on a GPU. */
HD uint32_t rng_take(rng *r)
{
    uint32_t i = r->used++;
    return i == 0u ? r->word[0] : i == 1u ? r->word[1]
         : i == 2u ? r->word[2] : r->word[3];
}

HD uint32_t rng_u32(rng *r)
{
    if (r->used == 4u) {
        rng_block b;
        for (int i = 0; i < 4; i++)
            b.word[i] = r->counter[i];
        b = rng_block_of(b, r->key[0], r->key[1]);
        for (int i = 0; i < 4; i++)
            r->word[i] = b.word[i];
        r->counter[3]++;
        r->used = 0u;
    }
    return rng_take(r);
}

/* Uniform in [0, 1), 24 bits: for directions and choices. */
HD float rng_float_of(uint32_t x)
{
    return (float)(x >> 8) * 5.96046448e-08f;
}

HD float rng_float(rng *r)
{
    return rng_float_of(rng_u32(r));
}

/* Uniform in (0, 1), fine near 0 for rare events; never rounded to 1, which
 * would end white paths. */
HD float rng_fine_of(uint32_t x)
{
    return hd_min(((float)x + 0.5f) * 2.32830644e-10f, 0.99999994f);
}

HD float rng_fine(rng *r)
{
    return rng_fine_of(rng_u32(r));
}

/* True with probability p, to 2^-64: for choices that may be rare, such as
 * a real collision under a loose majorant. */
HD bool rng_chance(rng *r, float p)
{
    uint32_t x = rng_u32(r);
    if (!(p > 0.0f))
        return false;
    if (p >= 1.0f)
        return true;
    uint64_t bound = (uint64_t)(p * 18446744073709551616.0f);
    uint32_t head = (uint32_t)(bound >> 32);
    return x < head || (x == head && rng_u32(r) < (uint32_t)bound);
}

/* Whether a depth drawn from x needs a second word. */
HD bool rng_depth_is_end(uint32_t x)
{
    return x < 0x10000u || x > 0xfffeffffu;
}

/* -log(h), or -log(1 - h) if that is asked for, as fm_log and fm_log1p have
 * them, for h in (0, 1/2]: one logarithm, for which threads meet. */
HD float rng_minus_log(float h, bool rest)
{
    int n;
    float x = rest ? 1.0f - h : h, extra = 0.0f;
    float f = fm_split(x, &n) - 1.0f;
    if (rest && n == 0)
        f = -h;
    else if (rest)
        extra = fm_over_within(-h - (x - 1.0f), x);
    return -fm_log_reduced(f, n, extra);
}

/* The exponential variate of the 64-bit number x y / 2^64, y at the ends
 * only: fine near 0, and up to 45. */
HD float rng_depth_of(uint32_t x, uint32_t y)
{
    bool near = x < 0x80000000u;
    uint32_t near_x = near ? x : ~x, near_y = near ? y : ~y;
    float tail = rng_depth_is_end(x)
               ? ((float)near_y + 0.5f) * 2.32830644e-10f : 0.5f;
    float h = ((float)near_x + tail) * 2.32830644e-10f;
    return rng_minus_log(h, near);
}

/* Optical depth to the next collision, density exp(-tau). P(tau < t) and
 * P(tau > t) are right to 1e-5 of themselves or to 2^-64, at every t. A
 * uniform float would end at 16.6 and hit a medium of depth 1e-7 a fifth too
 * often. */
HD float rng_optical_depth(rng *r)
{
    uint32_t x = rng_u32(r);
    return rng_depth_of(x, rng_depth_is_end(x) ? rng_u32(r) : 0u);
}

#endif
