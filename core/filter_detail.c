#include "core/filter_detail.h"
#include <math.h>
#include <string.h>

/* What a mean may lose of the size of differences in space: 0.01 is 2 % of
 * their energy. */
#define MOST_LOST 0.01f

enum { TAPS = BRUME_MAX_TAPS, REACH = BRUME_MAX_REACH };
enum { COLORS = 3, ROW = 8 * COLORS };

void filter_detail_begin(struct filter_detail *d)
{
    d->frames = 0;
    for (int i = 0; i < FILTER_BLOCKS; i++)
        d->there[i] = 1.0f;
}

void filter_detail_add(struct filter_detail *d, int k, const float *color,
                       const float there[FILTER_BLOCKS])
{
    for (int row = 0; row < FILTER_BLOCKS / 4; row++) {
        float sum[ROW] = {0};
        for (int i = 0; i < 4; i++) {
            int z = 2 * (row >> 2) + (i >> 1), y = 2 * (row & 3) + (i & 1);
            const float *x = color + (size_t)(z * 8 + y) * ROW;
            for (int n = 0; n < ROW; n++)
                sum[n] += x[n];
        }
        for (int b = 0; b < 4; b++) {
            const float *x = sum + 2 * COLORS * b;
            d->block[k][4 * row + b] = (x[0] + x[3]) + (x[1] + x[4]) +
                                       (x[2] + x[5]);
        }
    }
    for (int i = 0; i < FILTER_BLOCKS; i++)
        d->there[i] *= there[i];
    d->frames++;
}

/* ---- energies ----------------------------------------------------------- */

/* Less the mean of those blocks that are there in all frames. */
static void leave_detail(const float there[FILTER_BLOCKS], float count,
                         float block[FILTER_BLOCKS])
{
    float sum = 0.0f;
    for (int i = 0; i < FILTER_BLOCKS; i++)
        sum += there[i] * block[i];
    for (int i = 0; i < FILTER_BLOCKS; i++)
        block[i] = there[i] * (block[i] - sum / count);
}

static float product(const float *restrict a, const float *restrict b)
{
    float part[8] = {0};
    for (int i = 0; i < FILTER_BLOCKS; i += 8)
        for (int k = 0; k < 8; k++)
            part[k] += a[i + k] * b[i + k];
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}

void filter_detail_sum(struct filter_detail *d, const bool has[TAPS],
                       int frames, struct filter_common *out)
{
    float count = 0.0f, *pair = out->pair;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < FILTER_BLOCKS; i++)
        count += d->there[i];
    if (d->frames < frames || count < 2.0f)
        return;
    for (int k = 0; k < TAPS; k++)
        if (has[k])
            leave_detail(d->there, count, d->block[k]);
    for (int k = 0; k < TAPS; k++)
        for (int j = k + 1; j < TAPS; j++, pair++)
            if (has[k] && has[j])
                *pair = product(d->block[k], d->block[j]);
}

/* ---- their fall --------------------------------------------------------- */

enum { TIMES = 96, GROUPS = 8 };

/* What frames have in common by their distance, where it falls in times of so
 * many frames: between what moves evenly and what does by chance. The first
 * time is without end. */
struct falls {
    double common[TIMES][REACH + 1];
};

static void list_falls(struct falls *f)
{
    for (int i = 0; i < TIMES; i++)
        for (int d = 0; d <= REACH; d++) {
            double time = 0.7 * pow(1.08, TIMES - 1 - i);
            f->common[i][d] = i == 0 ? 1.0 : exp(-pow(d / time, 1.5));
        }
}

/* Sums over all bricks, and over every GROUPSth. */
struct sums {
    double all[FILTER_PAIRS], group[GROUPS][FILTER_PAIRS];
};

static void add_bricks(const struct filter_common *brick, size_t bricks,
                       struct sums *sums)
{
    memset(sums, 0, sizeof *sums);
    for (size_t i = 0; i < bricks; i++)
        for (int k = 0; k < FILTER_PAIRS; k++)
            sums->group[i % GROUPS][k] += (double)brick[i].pair[k];
    for (int g = 0; g < GROUPS; g++)
        for (int k = 0; k < FILTER_PAIRS; k++)
            sums->all[k] += sums->group[g][k];
}

/* The means by distance, and the weights of these. */
struct means {
    double energy[REACH + 1], weight[REACH + 1];
};

static struct means mean_pairs(const double pair[FILTER_PAIRS],
                               const double weight[TAPS])
{
    struct means m = {{0}, {0}};
    for (int k = 0; k < TAPS; k++)
        for (int j = k + 1; j < TAPS; j++, pair++) {
            double w = j - k <= REACH ? weight[k] * weight[j] : 0.0;
            if (!(w > 0.0))
                continue;
            m.energy[j - k] += w * *pair;
            m.weight[j - k] += w;
        }
    for (int d = 1; d <= REACH; d++)
        if (m.weight[d] > 0.0)
            m.energy[d] /= m.weight[d];
    return m;
}

/* The fall that fits best, by least squares. */
static int fit(const struct falls *f, const struct means *m)
{
    double best = INFINITY;
    int found = 0;
    for (int i = 0; i < TIMES; i++) {
        const double *c = f->common[i];
        double square = 0.0, along = 0.0, left = 0.0;
        for (int d = 1; d <= REACH; d++) {
            square += m->weight[d] * c[d] * c[d];
            along += m->weight[d] * c[d] * m->energy[d];
        }
        double energy = square > 0.0 ? fmax(along / square, 0.0) : 0.0;
        for (int d = 1; d <= REACH; d++) {
            double off = m->energy[d] - energy * c[d];
            left += m->weight[d] * off * off;
        }
        if (left < best) {
            best = left;
            found = i;
        }
    }
    return found;
}

static double mean_lost(const double common[REACH + 1])
{
    double sum = 0.0;
    for (int d = 1; d <= REACH; d++)
        sum += (1.0 - common[d]) / REACH;
    return sum;
}

/* Whether more is lost than chance would have it: 2.5 times the error that
 * leaving out one group of bricks after the other tells, which few bricks tell
 * badly. */
static bool is_certain(const struct falls *f, const struct sums *sums,
                       size_t bricks, const double weight[TAPS], double lost)
{
    double pair[FILTER_PAIRS], square = 0.0;
    for (int g = 0; g < GROUPS; g++) {
        for (int k = 0; k < FILTER_PAIRS; k++)
            pair[k] = sums->all[k] - sums->group[g][k];
        struct means m = mean_pairs(pair, weight);
        double x = mean_lost(f->common[fit(f, &m)]) - lost;
        square += x * x * (GROUPS - 1) / GROUPS;
    }
    double sure = 2.5 + 20.0 / fmax((double)bricks, 1.0);
    return lost > sure * sqrt(square);
}

void filter_detail_fit(const struct filter_common *brick, size_t bricks,
                       const double weight[TAPS], float lost[REACH + 1])
{
    struct sums sums;
    struct falls falls;
    list_falls(&falls);
    add_bricks(brick, bricks, &sums);
    struct means means = mean_pairs(sums.all, weight);
    int found = fit(&falls, &means);
    if (!is_certain(&falls, &sums, bricks, weight,
                    mean_lost(falls.common[found])))
        found = 0;
    for (int d = 0; d <= REACH; d++)
        lost[d] = (float)(1.0 - falls.common[found][d]);
}

/* Multiplied by a line in what each frame lost: where the weights are those of
 * the least noise, no others lose so little with so little noise. */
void filter_detail_keep(const float lost[REACH + 1], float weight[TAPS])
{
    float mean = 0.0f, square = 0.0f;
    for (int k = 0; k < TAPS; k++) {
        float x = lost[k < REACH ? REACH - k : k - REACH];
        mean += weight[k] * x;
        square += weight[k] * x * x;
    }
    float variance = square - mean * mean;
    if (!(mean > MOST_LOST) || !(variance > 0.0f))
        return;
    float slope = (mean - MOST_LOST) / variance;
    for (int k = 0; k < TAPS; k++)
        weight[k] *= 1.0f +
                     slope * (mean - lost[k < REACH ? REACH - k : k - REACH]);
}
