/* sobol.h - points that fill the unit cube evenly, however many they are.
 *
 * The first three dimensions of Sobol's sequence [Joe and Kuo 2008], scrambled
 * as Owen has it by hashes of the digits before each digit [Laine and Karras
 * 2011; Burley 2020]: the n-th point, of the sequence that a seed gives. Of the
 * first 2^k points each interval of 1/2^k, of any coordinate, has one. */
#ifndef CORE_PHYSICS_SOBOL_H
#define CORE_PHYSICS_SOBOL_H
#include "core/physics/hd.h"

enum { SOBOL_DIMENSIONS = 3 };

HD uint32_t sobol_reverse(uint32_t x)
{
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

/* Point n, digits from the highest bit on: dimension 0 is n reversed, 1 has
 * the polynomial x + 1, 2 has x^2 + x + 1. */
HD void sobol_point(uint32_t n, uint32_t out[SOBOL_DIMENSIONS])
{
    uint32_t v = 0x80000000u;
    uint32_t w = 0x80000000u, next = 0xc0000000u;
    out[0] = sobol_reverse(n);
    out[1] = out[2] = 0u;
    for (; n != 0u; n >>= 1) {
        if (n & 1u) {
            out[1] ^= v;
            out[2] ^= w;
        }
        v ^= v >> 1;
        uint32_t after = next ^ w ^ w >> 2;
        w = next;
        next = after;
    }
}

/* Flips each digit by a hash of the seed and of those before it. */
HD uint32_t sobol_scramble(uint32_t x, uint32_t seed)
{
    x = sobol_reverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return sobol_reverse(x);
}

/* A pair of further dimensions: the first two anew, each 4096 points in an
 * order of their own [Burley 2020]. Those of all n below 2^k fill the square as
 * evenly, and lie anyhow to the other dimensions. */
HD void sobol_pair(uint32_t n, const uint32_t seed[3], uint32_t out[2])
{
    uint32_t x[SOBOL_DIMENSIONS];
    uint32_t order = sobol_scramble(n << 20, seed[0]) >> 20;
    sobol_point((n & ~4095u) | order, x);
    out[0] = sobol_scramble(x[0], seed[1]);
    out[1] = sobol_scramble(x[1], seed[2]);
}

/* In [0, 1), 24 bits. */
HD float sobol_float(uint32_t x)
{
    return (float)(x >> 8) * 5.96046448e-08f;
}

#endif
