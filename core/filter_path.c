/* Where what is in the blocks of one frame is in the others: along the drift
 * of the media from frame to frame, in both directions [Stam 1999]. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/drift.h"
#include "core/filter_judge.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* The drift of a block of a frame's field, or NULL: there is none. */
static const float *drift_of(const struct filter_field *f, const int at[3])
{
    const int32_t *n = f->lattice.bricks;
    for (int i = 0; i < 3; i++)
        if (at[i] < 0 || at[i] >= 4 * n[i])
            return NULL;
    size_t brick = (size_t)(at[0] >> 2) +
                   (size_t)n[0] * ((size_t)(at[1] >> 2) +
                                   (size_t)n[1] * (size_t)(at[2] >> 2));
    int block = ((at[2] & 3) * 4 + (at[1] & 3)) * 4 + (at[0] & 3);
    int32_t slot = f->slots[brick];
    return slot < 0
               ? NULL
               : f->drift + ((size_t)slot * DRIFT_BLOCKS + (size_t)block) * 3;
}

/* Those of 2^3 blocks; NULL where there is none. */
static void drifts_of(const struct filter_field *f, const int low[3],
                      const float *out[8])
{
    bool one = (low[0] & 3) < 3 && (low[1] & 3) < 3 && (low[2] & 3) < 3;
    const float *first = one ? drift_of(f, low) : NULL;
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const int at[3] = {low[0] + x, low[1] + y, low[2] + z};
        out[k] = !one    ? drift_of(f, at)
                 : first ? first + 3 * (16 * z + 4 * y + x)
                         : NULL;
    }
}

/* At p, in cells of the middle frame, where the first cell's middle is 0.
 * False: the field has no block there. */
static bool drift_at(const struct filter_view *v, const float p[3],
                     float out[3])
{
    float part[3][2], sum[3] = {0}, weights = 0.0f;
    const float *drift[8];
    int low[3];
    out[0] = out[1] = out[2] = 0.0f;
    if (!v->field->drift)
        return true;
    for (int i = 0; i < 3; i++) {
        float q = 0.5f * (p[i] + (float)v->shift[i] - 0.5f);
        float whole = floorf(q);
        if (!(fabsf(whole) < 1e6f))
            return false;
        low[i] = (int)whole;
        part[i][1] = q - whole;
        part[i][0] = 1.0f - part[i][1];
    }
    drifts_of(v->field, low, drift);
    for (int k = 0; k < 8; k++) {
        const float *d = drift[k];
        float weight = part[0][k & 1] * part[1][k >> 1 & 1] * part[2][k >> 2];
        if (!d)
            continue;
        weights += weight;
        for (int i = 0; i < 3; i++)
            sum[i] += weight * d[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] = sum[i] / (weights > 0.0f ? weights : 1.0f);
    return weights > 0.0f;
}

/* From p in one frame to where it is in the next, or was in the one before:
 * with the mean of the drifts at both ends. */
static bool follow(const struct filter_view *from, const struct filter_view *to,
                   float sign, float p[3])
{
    float first[3], guess[3], second[3];
    if (!drift_at(from, p, first))
        return false;
    for (int i = 0; i < 3; i++)
        guess[i] = p[i] + sign * first[i];
    if (!drift_at(to, guess, second))
        memcpy(second, first, sizeof second);
    for (int i = 0; i < 3; i++)
        p[i] += sign * 0.5f * (first[i] + second[i]);
    return fabsf(p[0]) < 1e6f && fabsf(p[1]) < 1e6f && fabsf(p[2]) < 1e6f;
}

static void follow_block(const struct filter_judge *judge, const float at[3],
                         int block, struct filter_places *places)
{
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        places[k].first[block][0] = NAN;
    for (int sign = -1; sign <= 1; sign += 2) {
        float p[3] = {at[0], at[1], at[2]};
        for (int m = 1; m <= judge->reach; m++) {
            int k = FILTER_MIDDLE + sign * m;
            const struct filter_view *v = &judge->view[k];
            if (!v->field || !follow(&judge->view[k - sign], v, (float)sign, p))
                break;
            for (int i = 0; i < 3; i++)
                places[k].first[block][i] = p[i] - 0.5f + (float)v->shift[i];
        }
    }
}

static void follow_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct filter_judge *judge = context;
    int32_t slot = judge->flat->radiance_slots[index];
    int corner[3];
    if (slot < 0)
        return;
    filter_corner(&judge->flat->view.field, index, corner);
    for (int b = 0; b < FILTER_BLOCKS; b++) {
        float at[3];
        for (int i = 0; i < 3; i++)
            at[i] = (float)(corner[i] + 2 * (b >> 2 * i & 3)) + 0.5f;
        follow_block(judge, at, b,
                     judge->places + (size_t)slot * BRUME_MAX_TAPS);
    }
}

/* Whether anything moves, and all cells are of one size. */
static bool has_drift(const struct filter_judge *judge)
{
    bool drift = false;
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        const struct filter_view *v = &judge->view[k];
        if (v->field && !(fabs(v->scale - 1.0) < 1e-6))
            return false;
        drift = drift || (v->field && v->field->drift);
    }
    return drift;
}

bool filter_follow(struct filter_judge *judge, int threads,
                   struct filter_scratch *scratch, struct brume_error *err)
{
    const struct flat *flat = judge->flat;
    size_t bricks = flat->radiance_count /
                    (FILTER_CELLS * (size_t)flat->view.field.numbers);
    judge->places = NULL;
    if (!has_drift(judge))
        return true;
    struct filter_places *places = memory_grow(
        scratch->places, &scratch->places_room, bricks * BRUME_MAX_TAPS,
        sizeof *places, err);
    if (!places)
        return false;
    judge->places = scratch->places = places;
    parallel_for(threads, flat->radiance_slots_count, follow_brick, judge,
                 NULL);
    return true;
}
