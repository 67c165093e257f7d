/* What the halves of a field's photons have in common, and what not: in that
 * the noise of neither has a part, and so it is the energy of what is there;
 * this is that of the noise. */
#include "core/filter_half.h"
#include "core/physics/half.h"

/* The numbers of a brick's blocks as each half alone would have them. */
struct halves {
    float first[HALF_BLOCKS], second[HALF_BLOCKS];
};

static void load(const struct flat *flat, size_t brick, struct halves *out)
{
    const radiance_lattice *f = &flat->view.field;
    float part = (float)flat->half_part;
    size_t numbers = (size_t)f->numbers;
    const float *half = flat->half + brick * HALF_BLOCKS;
    const float *cells = flat->radiance + brick * 512 * numbers +
                         half_primary(f);
    for (int i = 0; i < HALF_BLOCKS; i++) {
        const float *x = cells + (size_t)half_cell(i) * numbers;
        float sum = 0.0f;
        for (int k = 0; k < 8; k++) {
            size_t at = (size_t)((k >> 2) * 64 + (k >> 1 & 1) * 8 + (k & 1));
            sum += x[at * numbers] + x[at * numbers + 1] + x[at * numbers + 2];
        }
        out->first[i] = half[i] / part;
        out->second[i] = (sum - half[i]) / (1.0f - part);
    }
}

/* Returns the sum. */
static float leave_mean(float block[HALF_BLOCKS])
{
    float sum = 0.0f;
    for (int i = 0; i < HALF_BLOCKS; i++)
        sum += block[i];
    for (int i = 0; i < HALF_BLOCKS; i++)
        block[i] -= sum / HALF_BLOCKS;
    return sum;
}

void filter_half_blocks(const struct flat *flat, size_t brick,
                        float block[HALF_BLOCKS])
{
    float part = (float)flat->half_part;
    struct halves h;
    load(flat, brick, &h);
    for (int i = 0; i < HALF_BLOCKS; i++) {
        float d = h.first[i] - h.second[i];
        block[i] = part * (1.0f - part) * d * d;
    }
}

void filter_half_find(const struct flat *flat, struct filter_power *out)
{
    float part = (float)flat->half_part;
    size_t bricks = flat->radiance_count /
                    (512 * (size_t)flat->view.field.numbers);
    for (size_t b = 0; b < bricks; b++) {
        struct halves h;
        float product = 0.0f, square = 0.0f;
        load(flat, b, &h);
        float first = leave_mean(h.first), second = leave_mean(h.second);
        for (int i = 0; i < HALF_BLOCKS; i++) {
            float d = h.first[i] - h.second[i];
            product += h.first[i] * h.second[i];
            square += d * d;
        }
        out[b].detail = product;
        out[b].noise = part * (1.0f - part) * square;
        out[b].whole = first * second;
        out[b].whole_noise = part * (1.0f - part) * (first - second) *
                             (first - second);
    }
}
