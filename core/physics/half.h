/* half.h - sums of the field over blocks of 2^3 cells, as they are when one
 * half of the photons was traced: what both halves tell alike is light, what
 * they tell differently is noise. */
#ifndef CORE_PHYSICS_HALF_H
#define CORE_PHYSICS_HALF_H
#include "core/physics/radiance.h"

#define HALF_BLOCKS 64          /* of a brick                              */

/* The first of the three numbers that filters of films judge by. */
HD int half_primary(const radiance_lattice *f)
{
    return f->fluence >= 0 ? f->fluence : f->eye;
}

/* The first cell of a brick's block. */
HD int half_cell(int block)
{
    return ((block >> 4) * 16 + (block >> 2 & 3) * 2) * 8 + (block & 3) * 2;
}

/* Of block i of all, in the order of slots: its cells' three numbers. */
HD float half_block(const radiance_lattice *f, const int64_t *sum, uint64_t i,
                    double scale)
{
    int64_t all = 0;
    uint64_t first = i / HALF_BLOCKS * 512u +
                     (uint64_t)half_cell((int)(i % HALF_BLOCKS));
    for (int k = 0; k < 8; k++) {
        uint64_t cell = first + (uint64_t)((k >> 2) * 64 + (k >> 1 & 1) * 8 +
                                           (k & 1));
        const int64_t *x = sum + cell * (uint64_t)f->numbers + half_primary(f);
        all += x[0] + x[1] + x[2];
    }
    return (float)((double)all * scale);
}

#endif
