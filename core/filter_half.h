/* filter_half.h - light and noise in a field, told apart by the halves of its
 * photons (flat->half). */
#ifndef CORE_FILTER_HALF_H
#define CORE_FILTER_HALF_H
#include "core/flat.h"

/* Of a brick: sums over its blocks of what squares of their differences from
 * the brick's mean have of light, and of noise; and the same of the square of
 * its sum. By chance those of light can be negative. */
struct filter_power {
    float detail, noise, whole, whole_noise;
};

/* The squares of what the halves have apart, of each block of a brick, as noise
 * of all photons. */
void filter_half_blocks(const struct flat *flat, size_t brick, float block[64]);

/* Of each brick that is there. */
void filter_half_find(const struct flat *flat, struct filter_power *out);
#endif
