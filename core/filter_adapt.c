/* A mean over frames with weights of its own for each block of 2^3 cells.
 *
 * How far a neighbour in time differs is judged over the block's surroundings,
 * 6^3 cells: what is above the noise there is change. The frames at the same
 * distance before and after count as one, their mean, since what moves evenly
 * cancels in it; where that differs more than they do singly, as at a cut,
 * they count singly. Weights then make the sum of squared change and variance
 * least: with b the changes, all of one sign at worst, and V the variance,
 * w ~ 1 - b Sum b / (V + Sum b^2).
 *
 * Where media have a velocity frames are judged twice: as they are, since a
 * flow may stand still in space, and where the media took what is in them; for
 * each block those that differ less are taken.
 *
 * Where noise hides what changes such weights are even, and blur it. How much
 * of the detail they lose as a whole shows all the same (filter_fall.h): where
 * that is more than 2 % of its energy they are changed until it is not, most
 * where there is most detail for its noise; the farthest become negative. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/filter_fall.h"
#include "core/filter_judge.h"
#include "core/radiance.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* What a squared difference may be, over what its noise gives: that of the
 * surroundings is known to a fifth or so, and changes that are not there would
 * cost more than those that are overlooked. The square of a mean difference
 * may be so many times that of independent cells, which neighbours are not. */
#define MARGIN 1.2f
#define MARGIN_OF_MEAN 10.0f

/* How many times its chance error one way of comparing must be better by than
 * the other where that was the better one as a whole; few photons that are near
 * each other would choose by their noise, and the choice would keep it. */
#define DOUBT 8.0f

/* What the halves of a frame may show of noise, over what it is told to be. */
#define STRAY 4.0f

/* The part of a frame's variance that is left where its cells are interpolated,
 * which is 0.3 of independent ones at random places. */
#define MOVED_PART 0.6f

enum { NUMBERS = sizeof(struct filter_stats) / sizeof(float) };
enum { MIDDLE = FILTER_MIDDLE, OTHERS = FILTER_OTHERS };

struct adapt {
    struct filter_judge judge;
    size_t bricks;
    float noise[BRUME_MAX_TAPS];
    float apart; /* what halves differ by, squared, over the noise told  */
    struct filter_kinds kinds;
    struct filter_falls fall[2]; /* of detail: as they are, moved */
    float slope[2][FILTER_KINDS];
    struct filter_weights *weights; /* of each brick                 */
    struct filter_desk *desk;       /* a thread's                    */
};

/* Sums over blocks. */
struct tally {
    double weight[BRUME_MAX_TAPS], square, blocks;
};

/* Of a brick's blocks, and whether these are taken where they were. */
struct filter_weights {
    float weight[BRUME_MAX_TAPS][FILTER_BLOCKS];
    bool moved[FILTER_BLOCKS];
    struct tally tally[2]; /* of those that are not, and that are      */
};

struct filter_desk {
    struct filter_stats near[2][FILTER_BLOCKS]; /* as they are, moved */
    struct filter_stats plane[24];
    struct filter_room room;
};

/* ---- surroundings ------------------------------------------------------- */

static void add(struct filter_stats *sum, const struct filter_stats *more)
{
    float *restrict a = sum->shift[0];
    const float *restrict b = more->shift[0];
    for (int i = 0; i < NUMBERS; i++)
        a[i] += b[i];
}

/* The blocks of the bricks around one, itself in the middle; NULL: none. */
static void find_around(const struct adapt *a, bool moved, const int at[3],
                        const struct filter_stats *around[27])
{
    const struct flat *flat = a->judge.flat;
    const int32_t *n = flat->view.field.bricks;
    for (int i = 0; i < 27; i++) {
        int x = at[0] + i % 3 - 1, y = at[1] + i / 3 % 3 - 1,
            z = at[2] + i / 9 - 1;
        bool in = x >= 0 && y >= 0 && z >= 0 && x < n[0] && y < n[1] &&
                  z < n[2];
        int32_t slot =
            in ? flat->radiance_slots[(size_t)x +
                                      (size_t)n[0] * ((size_t)y +
                                                      (size_t)n[1] * (size_t)z)]
               : -1;
        around[i] = slot < 0
                        ? NULL
                        : a->judge.stats[moved] + (size_t)slot * FILTER_BLOCKS;
    }
}

/* Block x, y, z of a brick, from -1 to 4 in each direction. */
static const struct filter_stats *
block_at(const struct filter_stats *const around[27], int x, int y, int z)
{
    int brick = ((z + 4) / 4 * 3 + (y + 4) / 4) * 3 + (x + 4) / 4;
    const struct filter_stats *s = around[brick];
    return s ? s + ((z & 3) * 4 + (y & 3)) * 4 + (x & 3) : NULL;
}

/* Sums over three blocks beside each other along x, of one layer. */
static void sum_layer(struct filter_stats plane[24], int z,
                      const struct filter_stats *const around[27])
{
    memset(plane, 0, 24 * sizeof *plane);
    for (int i = 0; i < 24; i++)
        for (int k = -1; k <= 1; k++) {
            const struct filter_stats *s = block_at(around, (i & 3) + k,
                                                    (i >> 2) - 1, z);
            if (s)
                add(&plane[i], s);
        }
}

/* Sums over each block and those around it: along x, y, then z. */
static void sum_around(struct filter_desk *d,
                       struct filter_stats near[FILTER_BLOCKS],
                       const struct filter_stats *const around[27])
{
    for (int z = -1; z < 5; z++) {
        sum_layer(d->plane, z, around);
        for (int i = 0; i < 16; i++) {
            struct filter_stats row = d->plane[i];
            add(&row, &d->plane[i + 4]);
            add(&row, &d->plane[i + 8]);
            if (z < 3)
                near[16 * (z + 1) + i] = row;
            for (int k = z > 0 ? z - 1 : 0; k <= z && k < 4; k++)
                add(&near[16 * k + i], &row);
        }
    }
}

/* ---- weights ------------------------------------------------------------ */

/* Estimates of the middle frame: their variance, and how far they are off. */
struct estimate {
    float variance, change;
    int from, to; /* frames that it is the mean of               */
};

/* A block that is judged. */
struct judged {
    const struct filter_stats *near, *own; /* of its surroundings, alone    */
    float move[OTHERS];
    float noise, level; /* of the middle frame; see level_of               */
};

/* A frame's variance over its noise, of all channels together, where these are
 * their means. */
static float level_of(const float mean[3])
{
    float square = 0.0f, sum = 0.0f;
    for (int c = 0; c < 3; c++) {
        float x = mean[c] > 0.0f ? mean[c] : 0.0f;
        square += x * x;
        sum += x;
    }
    return sum > 0.0f ? 3.0f * square / sum : 0.0f;
}

/* How far the means changed, squared. */
static void find_moves(const struct filter_stats *s, float move[OTHERS])
{
    for (int i = 0; i < OTHERS; i++) {
        float n = s->count[i] > 0.0f ? s->count[i] : 1.0f;
        float r = s->shift[0][i] / n, g = s->shift[1][i] / n,
              b = s->shift[2][i] / n;
        move[i] = r * r + g * g + b * b;
    }
}

static float above(float square, float variance, float count)
{
    float x = square - MARGIN_OF_MEAN * variance / count;
    return x > 0.0f ? x : 0.0f;
}

/* The level by the mean of those frames that are as bright as the middle one;
 * `level`, of all of them, is a first guess of it. */
static float pool(const struct adapt *a, const struct judged *b, float level,
                  bool all)
{
    const struct filter_stats *s = b->near;
    float mean[3], shift[3] = {0}, count = 1.0f;
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        int i = filter_other(k);
        if (k == MIDDLE || !(s->count[i] > 0.0f))
            continue;
        float variance = (b->noise + a->noise[k]) * level;
        if (!all && above(b->move[i], variance, s->count[i]) > 0.0f)
            continue;
        count += 1.0f;
        for (int c = 0; c < 3; c++)
            shift[c] += s->shift[c][i] / s->count[i];
    }
    for (int c = 0; c < 3; c++)
        mean[c] = s->mean[c] / s->cells - shift[c] / count;
    return level_of(mean);
}

static float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Of a single frame. */
static struct estimate judge_one(const struct adapt *a, const struct judged *b,
                                 int k)
{
    const struct filter_stats *s = b->near;
    int i = filter_other(k);
    struct estimate e = {
        .variance = a->noise[k] * b->level, .from = k, .to = k};
    float both = b->noise * b->level + e.variance;
    float change = s->differ[i] / s->count[i] - MARGIN * both;
    e.change = sqrtf(larger(change, above(b->move[i], both, s->count[i])));
    return e;
}

/* Of the mean of those at distance m. */
static struct estimate judge_two(const struct adapt *a, const struct judged *b,
                                 int m)
{
    const struct filter_stats *s = b->near;
    struct estimate e = {.from = MIDDLE - m, .to = MIDDLE + m};
    int i = filter_other(e.from), j = filter_other(e.to);
    float square = 0.0f;
    e.variance = 0.25f * (a->noise[e.from] + a->noise[e.to]) * b->level;
    float both = b->noise * b->level + e.variance, count = s->pairs[m - 1];
    for (int c = 0; c < 3; c++) {
        float d = 0.5f *
                  (s->shift[c][i] / s->count[i] + s->shift[c][j] / s->count[j]);
        square += d * d;
    }
    float change = s->pair[m - 1] / count - MARGIN * both;
    e.change = sqrtf(larger(change, above(square, both, count)));
    return e;
}

static float precision(const struct estimate *e)
{
    return 1.0f / (e->variance + e->change * e->change);
}

/* Those of one distance: the pair's, or one or two single frames'. */
static int list_estimates(const struct adapt *a, const struct judged *b, int m,
                          struct estimate *out)
{
    int count = 0;
    for (int k = MIDDLE - m; k <= MIDDLE + m; k += 2 * m)
        if (b->own->count[filter_other(k)] > 0.0f)
            out[count++] = judge_one(a, b, k);
    if (count < 2)
        return count;
    struct estimate pair = judge_two(a, b, m);
    if (precision(&pair) < precision(&out[0]) + precision(&out[1]))
        return 2;
    out[0] = pair;
    return 1;
}

/* The slope of the weights, those left out that it makes negative: it grows as
 * they go, until there are as many as before. */
static float find_slope(const struct estimate *e, int count)
{
    float slope = 0.0f;
    int before = -1, used = 0;
    for (int round = 0; round <= count && used != before; round++) {
        float sum = 0.0f, square = 0.0f;
        before = used;
        used = 0;
        for (int i = 0; i < count; i++) {
            if (!(e[i].change * slope < 1.0f))
                continue;
            used++;
            sum += e[i].change / e[i].variance;
            square += e[i].change * e[i].change / e[i].variance;
        }
        slope = sum / (1.0f + square);
    }
    return slope;
}

/* What makes squared change and variance least, of the middle frame, of
 * variance `own`, and these. */
static void weigh(const struct estimate *e, int count, float own,
                  float weight[BRUME_MAX_TAPS])
{
    float slope = find_slope(e, count);
    weight[MIDDLE] = 1.0f / own;
    for (int i = 0; i < count; i++) {
        float w = larger(1.0f - e[i].change * slope, 0.0f) / e[i].variance;
        weight[e[i].from] += 0.5f * w;
        weight[e[i].to] += 0.5f * w;
    }
}

/* How many times the noise that is told the middle frame has by its halves,
 * where that is more than chance has it: a few photons of much power, which
 * else would be taken for a change. What they lay lies in few cells, whose
 * squares are those of the blocks. */
static float stray(const struct adapt *a, const struct judged *b)
{
    const struct filter_stats *s = b->near;
    float told = b->noise * b->level * s->cells;
    return told > 0.0f ? 1.0f + larger(s->apart / told - STRAY * a->apart, 0.0f)
                       : 1.0f;
}

static void find_level(const struct adapt *a, struct judged *b)
{
    b->level = pool(a, b, pool(a, b, 0.0f, true), false);
}

/* The weights of all frames for one block, of sum 1. */
static void find_weights(const struct adapt *a, const struct filter_stats *near,
                         const struct filter_stats *own,
                         float weight[BRUME_MAX_TAPS])
{
    struct judged b = {.near = near, .own = own, .noise = a->noise[MIDDLE]};
    struct estimate e[OTHERS];
    float sum = 0.0f;
    int count = 0;
    memset(weight, 0, BRUME_MAX_TAPS * sizeof *weight);
    find_moves(near, b.move);
    find_level(a, &b);
    float times = stray(a, &b), variance = times * b.noise * b.level;
    if (times > 1.0f) {
        b.noise *= times;
        find_level(a, &b);
        b.noise = b.level > 0.0f ? variance / b.level : 0.0f;
    }
    if (!(b.level > 0.0f) || !(b.noise > 0.0f)) {
        weight[MIDDLE] = 1.0f;
        return;
    }
    for (int m = 1; m <= a->judge.reach; m++)
        count += list_estimates(a, &b, m, e + count);
    weigh(e, count, b.noise * b.level, weight);
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        sum += weight[k];
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        weight[k] /= sum;
}

/* By how much frames and the means of two differ from the middle one beyond
 * noise, squared, on average; `part` is what is left of their variance. */
static float differ(const struct adapt *a, const struct filter_stats *s,
                    float level, float part)
{
    float sum = 0.0f, count = 0.0f;
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        int i = filter_other(k);
        if (k == MIDDLE || !(s->count[i] > 0.0f))
            continue;
        sum += s->differ[i] / s->count[i] -
               (a->noise[MIDDLE] + part * a->noise[k]) * level;
        count += 1.0f;
    }
    for (int m = 1; m <= a->judge.reach; m++) {
        float both = a->noise[MIDDLE - m] + a->noise[MIDDLE + m];
        if (!(s->pairs[m - 1] > 0.0f))
            continue;
        sum += s->pair[m - 1] / s->pairs[m - 1] -
               (a->noise[MIDDLE] + 0.25f * part * both) * level;
        count += 1.0f;
    }
    return count > 0.0f ? sum / count : INFINITY;
}

/* By how much what a block's surroundings differ by in one way must be less
 * than in the other, as a part of their noise, to be believed: more where few
 * photons came. */
static float doubt(const struct filter_stats *s, float level, float noise)
{
    float deposits = s->cells * level / noise;
    return DOUBT * noise * level / sqrtf(deposits + 1.0f);
}

/* What was taken along a velocity is believed to have been, unless as a whole
 * it has lost twice what it does in place. */
static bool is_better_moved(const struct adapt *a, const struct filter_desk *d,
                            int i)
{
    enum { AT = BRUME_MAX_REACH / 2 };
    float noise = larger(a->noise[MIDDLE], 1e-30f);
    const struct filter_stats *s = &d->near[0][i];
    struct judged b = {.near = s, .noise = noise};
    find_moves(s, b.move);
    float level = pool(a, &b, 0.0f, true);
    float slack = doubt(s, level, noise);
    bool moves = 2.0f * a->fall[0].all[AT] >= a->fall[1].all[AT];
    return differ(a, &d->near[1][i], level, MOVED_PART) <
           differ(a, s, level, 1.0f) + (moves ? slack : -slack);
}

/* ---- bricks ------------------------------------------------------------- */

/* Adds a frame's cells times the weights of their blocks. */
static void mix_frame(const float *restrict cells, int numbers,
                      const float weight[FILTER_BLOCKS], float *restrict out)
{
    float row[8 * FILTER_MAX_NUMBERS];
    int size = 8 * numbers;
    for (int block = 0; block < FILTER_BLOCKS; block += 4) {
        for (int i = 0; i < size; i++)
            row[i] = weight[block + i / (2 * numbers)];
        for (int k = 0; k < 4; k++) {
            int z = 2 * (block >> 4) + (k >> 1);
            int y = 2 * (block >> 2 & 3) + (k & 1);
            const float *from = cells + (size_t)(z * 8 + y) * (size_t)size;
            float *to = out + (size_t)(z * 8 + y) * (size_t)size;
            for (int i = 0; i < size; i++)
                to[i] += row[i] * from[i];
        }
    }
}

/* A frame's weights of those blocks that are moved, or are not; false: it has
 * none. */
static bool choose_blocks(const struct filter_weights *w, bool moved, int k,
                          float weight[FILTER_BLOCKS])
{
    bool any = false;
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        weight[i] = w->moved[i] == moved ? w->weight[k][i] : 0.0f;
        any = any || weight[i] != 0.0f;
    }
    return any;
}

static void keep_detail(const struct adapt *a, size_t slot,
                        struct filter_weights *w)
{
    int kind = filter_kind(&a->kinds, &a->judge.common[0][slot]);
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        float weight[BRUME_MAX_TAPS];
        for (int k = 0; k < BRUME_MAX_TAPS; k++)
            weight[k] = w->weight[k][i];
        int moved = w->moved[i];
        filter_detail_keep(a->fall[moved].lost[kind], a->slope[moved][kind],
                           weight);
        for (int k = 0; k < BRUME_MAX_TAPS; k++)
            w->weight[k][i] = weight[k];
    }
}

static void mix_brick(void *context, size_t index, int thread)
{
    const struct adapt *a = context;
    const struct flat *flat = a->judge.flat;
    const radiance_lattice *f = &flat->view.field;
    struct filter_desk *d = &a->desk[thread];
    int32_t slot = flat->radiance_slots[index];
    int corner[3];
    if (slot < 0)
        return;
    struct filter_weights *w = &a->weights[slot];
    size_t size = FILTER_CELLS * (size_t)f->numbers;
    float *out = flat->radiance + (size_t)slot * size;
    float weight[FILTER_BLOCKS];
    filter_corner(f, index, corner);
    keep_detail(a, (size_t)slot, w);
    memset(out, 0, size * sizeof *out);
    for (int j = 0; j < 2; j++)
        for (int k = 0; k < BRUME_MAX_TAPS; k++) {
            const float *cells = choose_blocks(w, j, k, weight)
                                     ? filter_again(&a->judge, k, j,
                                                    (size_t)slot, corner,
                                                    &d->room)
                                     : NULL;
            if (cells)
                mix_frame(cells, f->numbers, weight, out);
        }
}

static void tally_brick(struct filter_weights *w)
{
    memset(w->tally, 0, sizeof w->tally);
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        struct tally *t = &w->tally[w->moved[i]];
        t->blocks += 1.0;
        for (int k = 0; k < BRUME_MAX_TAPS; k++) {
            double x = (double)w->weight[k][i];
            t->weight[k] += x;
            t->square += x * x;
        }
    }
}

/* Weights of a brick's blocks. */
static void weigh_brick(void *context, size_t index, int thread)
{
    const struct adapt *a = context;
    const struct flat *flat = a->judge.flat;
    const struct filter_stats *around[27];
    struct filter_desk *d = &a->desk[thread];
    int32_t slot = flat->radiance_slots[index];
    int corner[3], modes = a->judge.places ? 2 : 1;
    if (slot < 0)
        return;
    struct filter_weights *w = &a->weights[slot];
    filter_corner(&flat->view.field, index, corner);
    for (int j = 0; j < modes; j++) {
        find_around(a, j, (int[3]){corner[0] / 8, corner[1] / 8, corner[2] / 8},
                    around);
        sum_around(d, d->near[j], around);
    }
    for (int i = 0; i < FILTER_BLOCKS; i++) {
        bool moved = modes > 1 && is_better_moved(a, d, i);
        const struct filter_stats *own = a->judge.stats[moved] +
                                         (size_t)slot * FILTER_BLOCKS + i;
        float weight[BRUME_MAX_TAPS];
        find_weights(a, &d->near[moved][i], own, weight);
        w->moved[i] = moved;
        for (int k = 0; k < BRUME_MAX_TAPS; k++)
            w->weight[k][i] = weight[k];
    }
    tally_brick(w);
}

/* How fast the detail changes, as it is and moved, of frames that count by
 * their weights. */
static void find_falls(struct adapt *a, const double weight[BRUME_MAX_TAPS])
{
    filter_fall_sort(a->judge.common[0], a->bricks, weight, &a->kinds);
    for (int j = 0; j < (a->judge.places ? 2 : 1); j++)
        filter_fall_fit(a->judge.common[j], a->bricks, weight, &a->kinds,
                        &a->fall[j]);
}

/* Of all blocks of a kind. */
static void tally_weights(const struct adapt *a,
                          struct tally tally[FILTER_KINDS][2])
{
    memset(tally, 0, FILTER_KINDS * sizeof *tally);
    for (size_t b = 0; b < a->bricks; b++)
        for (int j = 0; j < 2; j++) {
            int kind = filter_kind(&a->kinds, &a->judge.common[0][b]);
            const struct tally *from = &a->weights[b].tally[j];
            struct tally *to = &tally[kind][j];
            for (int k = 0; k < BRUME_MAX_TAPS; k++)
                to->weight[k] += from->weight[k];
            to->square += from->square;
            to->blocks += from->blocks;
        }
}

/* Frames whose mean weight is less than this part of the mean frame's show
 * something else, as behind a cut. */
#define ELSE 0.3

/* Squares of the mean weights where detail is, so that frames of which few
 * blocks are used count for little, and none of those that show something
 * else. */
static void square_weights(const struct adapt *a, double out[BRUME_MAX_TAPS])
{
    struct tally tally[FILTER_KINDS][2];
    double all = 0.0;
    tally_weights(a, tally);
    for (int i = 0; i < FILTER_KINDS; i++)
        all += a->fall[0].energy[i];
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        double mean = 0.0;
        for (int i = 0; i < FILTER_KINDS; i++) {
            const struct tally *t = tally[i];
            double blocks = fmax(t[0].blocks + t[1].blocks, 1.0);
            mean += a->fall[0].energy[i] * (t[0].weight[k] + t[1].weight[k]) /
                    blocks;
        }
        mean *= all > 0.0 ? (double)a->judge.frames / all : 0.0;
        out[k] = mean > ELSE ? mean * mean : 0.0;
    }
}

static struct filter_group group_of(const struct adapt *a,
                                    const struct tally tally[2], int kind,
                                    int moved)
{
    const struct tally *t = &tally[moved];
    double blocks = t->blocks > 0.0 ? t->blocks : 1.0,
           part = t->blocks / fmax(tally[0].blocks + tally[1].blocks, 1.0);
    struct filter_group g = {
        .energy = part * a->fall[moved].energy[kind],
        .noise = part * a->fall[moved].noise[kind],
        .variance = t->square / blocks,
    };
    memcpy(g.lost, a->fall[moved].lost[kind], sizeof g.lost);
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        g.weight[k] = (float)(t->weight[k] / blocks);
    return g;
}

static void find_slopes(struct adapt *a)
{
    struct tally tally[FILTER_KINDS][2];
    struct filter_group group[2 * FILTER_KINDS];
    tally_weights(a, tally);
    for (int i = 0; i < 2 * FILTER_KINDS; i++)
        group[i] = group_of(a, tally[i / 2], i / 2, i % 2);
    filter_detail_slopes(group, 2 * FILTER_KINDS);
    for (int i = 0; i < 2 * FILTER_KINDS; i++)
        a->slope[i % 2][i / 2] = group[i].slope;
}

static bool take_room(struct adapt *a, int threads,
                      struct filter_scratch *scratch, struct brume_error *err)
{
    struct filter_desk *desk = memory_grow(scratch->desk, &scratch->desk_room,
                                           (size_t)threads, sizeof *desk, err);
    scratch->desk = desk ? desk : scratch->desk;
    struct filter_weights *weights = memory_grow(
        scratch->weights, &scratch->weights_room, a->bricks, sizeof *weights,
        err);
    scratch->weights = weights ? weights : scratch->weights;
    a->desk = desk;
    a->weights = weights;
    return desk && weights;
}

/* How much the halves of a brick have apart for the noise that is told, on
 * average; but for what few of them have most of. */
static float find_apart(const struct adapt *a)
{
    double ratio = 1e30;
    for (int round = 0; round < 2; round++) {
        double told = 0.0, apart = 0.0;
        for (size_t i = 0; i < a->bricks; i++) {
            const struct filter_common *c = &a->judge.common[0][i];
            double noise = (double)(a->noise[MIDDLE] * level_of(c->mean));
            told += noise;
            apart += fmin((double)c->apart, STRAY * ratio * noise);
        }
        ratio = told > 0.0 ? apart / told : 0.0;
    }
    return (float)ratio;
}

/* Weights by how blocks differ; then how fast the detail of those frames
 * changes that have weights, and what they may be for that. */
static void adapt_field(struct adapt *a, int threads)
{
    const struct flat *flat = a->judge.flat;
    double weight[BRUME_MAX_TAPS];
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        weight[k] = a->judge.has[k] ? 1.0 : 0.0;
    a->apart = find_apart(a);
    find_falls(a, weight);
    parallel_for(threads, flat->radiance_slots_count, weigh_brick, a, NULL);
    square_weights(a, weight);
    find_falls(a, weight);
    find_slopes(a);
    parallel_for(threads, flat->radiance_slots_count, mix_brick, a, NULL);
}

bool filter_adapt(struct flat *flat, const struct filter_field *const *fields,
                  int reach, int threads, struct filter_scratch *scratch,
                  struct brume_error *err)
{
    struct adapt a = {.judge = {.flat = flat, .reach = reach}};
    const radiance_lattice *f = &flat->view.field;
    a.judge.primary = f->fluence >= 0 ? f->fluence : f->eye;
    for (int k = -reach; k <= reach; k++) {
        const struct filter_field *field = fields[reach + k];
        filter_view_init(&a.judge.view[MIDDLE + k], flat, field);
        a.noise[MIDDLE + k] = field ? (float)field->noise : 0.0f;
    }
    /* A frame without light has no noise, and no weight without end. */
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        a.noise[k] = larger(a.noise[k], 1e-3f * a.noise[MIDDLE]);
    threads = threads > 0 ? threads : thread_processors();
    a.bricks = radiance_cells(flat) / FILTER_CELLS;
    bool good = take_room(&a, threads, scratch, err) &&
                filter_judge(&a.judge, threads, scratch, err);
    if (good && a.bricks > 0)
        adapt_field(&a, threads);
    return good;
}
