#include "core/filter.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/drift.h"
#include "core/filter_view.h"
#include "core/physics/radiance.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* Deposits in a cell are whole photons: the variance of their sum is that of
 * Poisson's law, the sum of their squares. Chords of a cell, and flights that
 * end in it, have a mean square of 0.9 of the mean times the side (measured:
 * 0.8 to 1.0 for cells of any optical thickness below 1). What goes toward
 * the eye has the phase function's mean square over its mean besides. */
static double noise_of(const radiance_lattice *f, double power)
{
    float lobe_g;
    double lobe = (double)radiance_lobe(f->phase[0], f->g[0], &lobe_g);
    double g2 = (double)lobe_g * (double)lobe_g;
    double peak = (1.0 + g2) / ((1.0 - g2) * (1.0 - g2));
    double phase = (1.0 + lobe * lobe * (peak - 1.0)) * (double)WARP_INV_4PI;
    return 0.9 * power / ((double)f->side * (double)f->side) *
           (f->eye >= 0 && f->fluence < 0 ? phase : 1.0);
}

/* Bricks that are there. */
static size_t brick_count(const struct filter_field *f)
{
    return f->count / (512 * (size_t)f->lattice.numbers);
}

/* Numbers that tell how far the blocks move. */
static size_t drift_count(const struct filter_field *f)
{
    return brick_count(f) * DRIFT_BLOCKS * 3;
}

bool filter_keep(const struct flat *flat, double power,
                 struct filter_field *out, struct brume_error *err)
{
    *out = (struct filter_field){
        .lattice = flat->view.field,
        .eye = flat->view.view,
        .unit = flat->unit,
        .bricks = flat->radiance_slots_count,
        .count = flat->radiance_count,
        .noise = noise_of(&flat->view.field, power),
    };
    memcpy(out->centre, flat->centre, sizeof out->centre);
    out->slots = memory_new(out->bricks, sizeof *out->slots, err);
    out->cells = memory_new(out->count, sizeof *out->cells, err);
    out->drift = flat->drift
                     ? memory_new(drift_count(out), sizeof *out->drift, err)
                     : NULL;
    out->power = flat->half
                     ? memory_new(brick_count(out), sizeof *out->power, err)
                     : NULL;
    if (!out->slots || !out->cells || (flat->drift && !out->drift) ||
        (flat->half && !out->power)) {
        filter_release(out);
        return false;
    }
    memcpy(out->slots, flat->radiance_slots, out->bricks * sizeof *out->slots);
    memcpy(out->cells, flat->radiance, out->count * sizeof *out->cells);
    if (out->drift)
        memcpy(out->drift, flat->drift, drift_count(out) * sizeof *out->drift);
    if (out->power)
        filter_half_find(flat, out->power);
    return true;
}

void filter_release(struct filter_field *f)
{
    free(f->slots);
    free(f->cells);
    free(f->drift);
    free(f->power);
    f->power = NULL;
    f->slots = NULL;
    f->cells = f->drift = NULL;
}

uint64_t filter_bytes(const struct filter_field *f)
{
    return f->bricks * sizeof *f->slots + f->count * sizeof *f->cells +
           (f->drift ? drift_count(f) * sizeof *f->drift : 0) +
           (f->power ? brick_count(f) * sizeof *f->power : 0);
}

/* ---- the mean ----------------------------------------------------------- */

struct mean {
    struct flat *flat;
    struct filter_view view[BRUME_MAX_TAPS];
    const double *weights;
    int taps;
    struct filter_room *room; /* a thread's */
};

/* Adds a frame's cells, `weight` times, where they are there, and the weight
 * to each cell's sum of weights. */
static void add_frame(const struct filter_brick *b, int numbers, float weight,
                      float *sum, float *weights)
{
    if (!b->there) {
        for (int i = 0; i < FILTER_CELLS; i++)
            weights[i] += weight;
        for (int i = 0; i < FILTER_CELLS * numbers; i++)
            sum[i] += weight * b->cells[i];
        return;
    }
    for (int i = 0; i < FILTER_CELLS; i++) {
        float w = weight * b->there[i];
        weights[i] += w;
        for (int k = i * numbers; k < (i + 1) * numbers; k++)
            sum[k] += w * b->cells[k];
    }
}

static void mean_of_brick(void *context, size_t index, int thread)
{
    const struct mean *m = context;
    const radiance_lattice *f = &m->flat->view.field;
    int32_t slot = m->flat->radiance_slots[index];
    float sum[FILTER_CELLS * FILTER_MAX_NUMBERS];
    float weights[FILTER_CELLS] = {0};
    struct filter_brick brick;
    int corner[3];
    if (slot < 0)
        return;
    filter_corner(f, index, corner);
    memset(sum, 0, FILTER_CELLS * (size_t)f->numbers * sizeof *sum);
    for (int k = 0; k < m->taps; k++)
        if (filter_view_brick(&m->view[k], corner, NULL, &m->room[thread],
                              &brick))
            add_frame(&brick, f->numbers, (float)m->weights[k], sum, weights);
    float *out = m->flat->radiance +
                 (size_t)slot * FILTER_CELLS * (size_t)f->numbers;
    for (int i = 0; i < FILTER_CELLS; i++)
        for (int k = i * f->numbers; k < (i + 1) * f->numbers; k++)
            out[k] = weights[i] > 0.0f ? sum[k] / weights[i] : out[k];
}

bool filter_mean(struct flat *flat, const struct filter_field *const *fields,
                 const double *weights, int reach, int threads,
                 struct brume_error *err)
{
    struct mean m = {flat, .weights = weights, .taps = 2 * reach + 1};
    for (int k = 0; k < m.taps; k++)
        filter_view_init(&m.view[k], flat, fields[k]);
    threads = threads > 0 ? threads : thread_processors();
    m.room = memory_new((size_t)threads, sizeof *m.room, err);
    if (!m.room)
        return false;
    parallel_for(threads, flat->radiance_slots_count, mean_of_brick, &m, NULL);
    free(m.room);
    return true;
}
