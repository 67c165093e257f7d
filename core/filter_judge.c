#include "core/filter_judge.h"
#include "core/radiance.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/thread.h"

enum { COLORS = 3, ROW = 8 * COLORS, ROWS = 16, ALL = FILTER_CELLS * COLORS };

/* One frame's part of a brick. */
struct side {
    bool any;
    const float *color;         /* three a cell                       */
    float there[FILTER_BLOCKS]; /* 1 where all cells of a block are   */
    float copy[ALL];
    struct filter_room room;
};

/* The middle frame, the one before and the one after. */
struct filter_side {
    struct side of[3];
    struct filter_detail detail;
};

struct desk {
    const struct filter_judge *judge;
    bool moved;
    struct filter_side *side; /* a thread's                             */
};

/* A block is there if all its cells are. */
static void find_blocks(struct side *s, const float *there)
{
    for (int i = 0; i < FILTER_BLOCKS; i++)
        s->there[i] = 1.0f;
    for (int i = 0; there && i < FILTER_CELLS; i++) {
        int x = i >> 1 & 3, y = i >> 4 & 3, z = i >> 7;
        if (!(there[i] > 0.0f))
            s->there[(z * 4 + y) * 4 + x] = 0.0f;
    }
}

static void load(const struct desk *desk, int k, size_t slot,
                 const int corner[3], struct side *s)
{
    const struct filter_judge *judge = desk->judge;
    struct filter_brick brick;
    int numbers = judge->flat->view.field.numbers;
    bool keeps = desk->moved && judge->kept && k != FILTER_MIDDLE;
    s->room.kept = keeps ? filter_kept(judge, slot, k) : NULL;
    s->any = filter_load(judge, k, desk->moved, slot, corner, &s->room, &brick);
    if (keeps)
        judge->found[filter_kept_at(slot, k)] = s->any;
    if (!s->any)
        return;
    find_blocks(s, brick.there);
    s->color = numbers == COLORS ? brick.cells : s->copy;
    for (int i = 0; numbers != COLORS && i < FILTER_CELLS; i++)
        for (int c = 0; c < COLORS; c++)
            s->copy[COLORS * i + c] =
                brick.cells[i * numbers + judge->primary + c];
}

/* The first of the rows of cells that lie in a row of blocks, and the others:
 * two layers of two. */
static size_t row_at(int row, int i)
{
    int z = 2 * (row >> 2) + (i >> 1), y = 2 * (row & 3) + (i & 1);
    return (size_t)(z * 8 + y) * ROW;
}

/* ---- a row of blocks ---------------------------------------------------- */

static void add_shift(const float *restrict z, const float *restrict x,
                      float *restrict sum, float *restrict square)
{
    for (int i = 0; i < ROW; i++) {
        float d = z[i] - x[i];
        sum[i] += d;
        square[i] += d * d;
    }
}

static void add_pair(const float *restrict z, const float *restrict x,
                     const float *restrict y, float *restrict square)
{
    for (int i = 0; i < ROW; i++) {
        float d = z[i] - 0.5f * (x[i] + y[i]);
        square[i] += d * d;
    }
}

/* Of block b in a row: all its numbers, or one channel's. */
static float sum_of(const float row[ROW], int b)
{
    const float *x = row + 2 * COLORS * b;
    return (x[0] + x[3]) + (x[1] + x[4]) + (x[2] + x[5]);
}

static float sum_of_channel(const float row[ROW], int b, int c)
{
    const float *x = row + 2 * COLORS * b + c;
    return x[0] + x[COLORS];
}

static void judge_other(const struct side *middle, const struct side *other,
                        int place, struct filter_stats *out)
{
    for (int row = 0; row < ROWS; row++) {
        float sum[ROW] = {0}, square[ROW] = {0};
        for (int i = 0; i < 4; i++)
            add_shift(middle->color + row_at(row, i),
                      other->color + row_at(row, i), sum, square);
        for (int b = 0; b < 4; b++) {
            struct filter_stats *s = &out[4 * row + b];
            float both = middle->there[4 * row + b] * other->there[4 * row + b];
            for (int c = 0; c < COLORS; c++)
                s->shift[c][place] = both * sum_of_channel(sum, b, c);
            s->differ[place] = both * sum_of(square, b);
            s->count[place] = 8.0f * both;
        }
    }
}

static void judge_pair(const struct side side[3], int m,
                       struct filter_stats *out)
{
    for (int row = 0; row < ROWS; row++) {
        float square[ROW] = {0};
        for (int i = 0; i < 4; i++)
            add_pair(side[0].color + row_at(row, i),
                     side[1].color + row_at(row, i),
                     side[2].color + row_at(row, i), square);
        for (int b = 0; b < 4; b++) {
            int at = 4 * row + b;
            float all = side[0].there[at] * side[1].there[at] *
                        side[2].there[at];
            out[at].pair[m - 1] = all * sum_of(square, b);
            out[at].pairs[m - 1] = 8.0f * all;
        }
    }
}

static void judge_middle(const struct side *middle, struct filter_stats *out)
{
    for (int row = 0; row < ROWS; row++) {
        float sum[ROW] = {0};
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < ROW; k++)
                sum[k] += middle->color[row_at(row, i) + (size_t)k];
        for (int b = 0; b < 4; b++) {
            float there = middle->there[4 * row + b];
            for (int c = 0; c < COLORS; c++)
                out[4 * row + b].mean[c] = there * sum_of_channel(sum, b, c);
            out[4 * row + b].cells = 8.0f * there;
        }
    }
}

/* Before the field that the halves are of is filled anew. */
static void judge_halves(const struct flat *flat, size_t slot,
                         const struct side *middle, struct filter_stats *out,
                         struct filter_common *common)
{
    float block[FILTER_BLOCKS] = {0};
    if (flat->half)
        filter_half_blocks(flat, slot, block);
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        out[i].apart = middle->there[i] * block[i];
        common->apart += out[i].apart;
        for (int c = 0; c < COLORS; c++)
            common->mean[c] += out[i].mean[c];
    }
}

/* ---- bricks ------------------------------------------------------------- */

/* What the halves of each frame tell of the brick at that place. */
static void find_power(const struct filter_judge *judge, const int corner[3],
                       struct filter_common *out)
{
    float noise = 0.0f, whole = 0.0f, count = 0.0f;
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        const struct filter_power *p = filter_view_power(&judge->view[k],
                                                         corner);
        if (!p)
            continue;
        out->own[k] = p->detail;
        out->whole[k] = p->whole;
        whole += p->whole_noise;
        out->given |= 1u << k;
        noise += p->noise;
        count += 1.0f;
    }
    out->whole_noise = whole / fmaxf(count, 1.0f);
    out->noise = noise / fmaxf(count, 1.0f);
}

static void judge_brick(void *context, size_t index, int thread)
{
    const struct desk *desk = context;
    const struct filter_judge *judge = desk->judge;
    struct side *side = desk->side[thread].of;
    struct filter_detail *detail = &desk->side[thread].detail;
    int32_t slot = judge->flat->radiance_slots[index];
    int corner[3];
    if (slot < 0)
        return;
    filter_corner(&judge->flat->view.field, index, corner);
    struct filter_stats *out = judge->stats[desk->moved] +
                               (size_t)slot * FILTER_BLOCKS;
    memset(out, 0, FILTER_BLOCKS * sizeof *out);
    load(desk, FILTER_MIDDLE, (size_t)slot, corner, &side[0]);
    struct filter_common *common = &judge->common[desk->moved][slot];
    memset(common, 0, sizeof *common);
    if (!side[0].any)
        return;
    judge_middle(&side[0], out);
    judge_halves(judge->flat, (size_t)slot, &side[0], out, common);
    filter_detail_begin(detail);
    filter_detail_add(detail, FILTER_MIDDLE, side[0].color, side[0].there);
    for (int m = 1; m <= judge->reach; m++) {
        for (int j = 1; j <= 2; j++) {
            int k = FILTER_MIDDLE + (j == 1 ? -m : m);
            load(desk, k, (size_t)slot, corner, &side[j]);
            if (!side[j].any)
                continue;
            judge_other(&side[0], &side[j], filter_other(k), out);
            filter_detail_add(detail, k, side[j].color, side[j].there);
        }
        if (side[1].any && side[2].any)
            judge_pair(side, m, out);
    }
    find_power(judge, corner, common);
    common->counts = filter_detail_sum(detail, judge->has, judge->frames,
                                       common) &&
                     common->given >> FILTER_MIDDLE & 1;
}

/* Judges frames as they are, or moved. */
static bool judge_all(struct filter_judge *judge, bool moved, int threads,
                      struct filter_scratch *scratch, struct brume_error *err)
{
    const struct flat *flat = judge->flat;
    size_t bricks = radiance_cells(flat) / FILTER_CELLS;
    size_t blocks = bricks * FILTER_BLOCKS;
    struct filter_stats *stats = memory_grow(scratch->stats[moved],
                                             &scratch->stats_room[moved],
                                             blocks, sizeof *stats, err);
    struct filter_common *common = memory_grow(scratch->common[moved],
                                               &scratch->common_room[moved],
                                               bricks, sizeof *common, err);
    scratch->stats[moved] = stats ? stats : scratch->stats[moved];
    scratch->common[moved] = common ? common : scratch->common[moved];
    if (!stats || !common)
        return false;
    judge->stats[moved] = stats;
    judge->common[moved] = common;
    struct desk desk = {judge, moved, scratch->side};
    parallel_for(threads, flat->radiance_slots_count, judge_brick, &desk, NULL);
    return true;
}

/* Room for cells where they were, which are worth much to be found once, if
 * they are not too many. */
static bool keep_moved(struct filter_judge *judge,
                       struct filter_scratch *scratch, struct brume_error *err)
{
    enum { MOST = 1 << 25 }; /* of floats: 128 MiB                      */
    const struct flat *flat = judge->flat;
    size_t bricks = flat->radiance_count /
                    (FILTER_CELLS * (size_t)flat->view.field.numbers);
    size_t floats = flat->radiance_count * BRUME_MAX_TAPS;
    judge->kept = NULL;
    if (!judge->places || floats > MOST)
        return true;
    bool *found = memory_grow(scratch->found, &scratch->found_room,
                              bricks * BRUME_MAX_TAPS, sizeof *found, err);
    scratch->found = found ? found : scratch->found;
    float *kept = memory_grow(scratch->kept, &scratch->kept_room, floats,
                              sizeof *kept, err);
    scratch->kept = kept ? kept : scratch->kept;
    judge->kept = kept;
    judge->found = found;
    if (found)
        memset(found, 0, bricks * BRUME_MAX_TAPS);
    return found && kept;
}

bool filter_judge(struct filter_judge *judge, int threads,
                  struct filter_scratch *scratch, struct brume_error *err)
{
    struct filter_side *side = memory_grow(scratch->side, &scratch->side_room,
                                           (size_t)threads, sizeof *side, err);
    if (!side)
        return false;
    scratch->side = side;
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        judge->has[k] = judge->view[k].field != NULL;
        judge->frames += judge->has[k];
    }
    return filter_follow(judge, threads, scratch, err) &&
           keep_moved(judge, scratch, err) &&
           judge_all(judge, false, threads, scratch, err) &&
           (!judge->places || judge_all(judge, true, threads, scratch, err));
}

void filter_scratch_release(struct filter_scratch *s)
{
    free(s->stats[0]);
    free(s->stats[1]);
    free(s->places);
    free(s->kept);
    free(s->found);
    free(s->common[0]);
    free(s->common[1]);
    free(s->weights);
    free(s->side);
    free(s->desk);
    memset(s, 0, sizeof *s);
}
