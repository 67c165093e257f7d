#include "core/filter_detail.h"
#include <math.h>
#include <string.h>

/* What means may lose of the size of differences in space: that is 1 % of
 * their energy. */
#define MOST_LOST 0.005

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
static float leave_detail(const float there[FILTER_BLOCKS], float count,
                          float block[FILTER_BLOCKS])
{
    float sum = 0.0f;
    for (int i = 0; i < FILTER_BLOCKS; i++)
        sum += there[i] * block[i];
    for (int i = 0; i < FILTER_BLOCKS; i++)
        block[i] = there[i] * (block[i] - sum / count);
    return sum;
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

bool filter_detail_sum(struct filter_detail *d, const bool has[TAPS],
                       int frames, struct filter_common *out)
{
    float count = 0.0f, *pair = out->pair;
    memset(out->pair, 0, sizeof out->pair);
    for (int i = 0; i < FILTER_BLOCKS; i++)
        count += d->there[i];
    if (d->frames < frames || count < FILTER_BLOCKS)
        return false;
    for (int k = 0; k < TAPS; k++)
        if (has[k])
            out->sum[k] = leave_detail(d->there, count, d->block[k]);
    for (int k = 0; k < TAPS; k++)
        for (int j = k + 1; j < TAPS; j++, pair++)
            if (has[k] && has[j])
                *pair = product(d->block[k], d->block[j]);
    return true;
}

/* ---- weights ------------------------------------------------------------ */

/* The mean of what frames lost, and its variance, both by their weights. */
struct loss {
    float mean, variance;
};

static struct loss loss_of(const float lost[REACH + 1],
                           const float weight[TAPS])
{
    float mean = 0.0f, square = 0.0f;
    for (int k = 0; k < TAPS; k++) {
        float x = lost[k < REACH ? REACH - k : k - REACH];
        mean += weight[k] * x;
        square += weight[k] * x * x;
    }
    return (struct loss){mean, square - mean * mean};
}

/* What a group of bricks loses with its slope, `share` times its energy over
 * its noise, or none. */
static double loss_at(const struct filter_group *g, double share)
{
    struct loss l = loss_of(g->lost, g->weight);
    double slope = share * g->energy / fmax(g->noise * g->variance, 1e-30);
    double left = (double)l.mean - slope * fmax((double)l.variance, 0.0);
    return g->energy * (l.mean > 0.0f ? fmax(left, 0.0) : 0.0);
}

void filter_detail_slopes(struct filter_group *group, int groups)
{
    enum { ROUNDS = 60 };
    double energy = 0.0, lost = 0.0, low = 0.0, high = 1e6;
    for (int i = 0; i < groups; i++) {
        energy += group[i].energy;
        lost += loss_at(&group[i], 0.0);
        group[i].slope = 0.0f;
    }
    if (!(lost > MOST_LOST * energy))
        return;
    for (int n = 0; n < ROUNDS; n++) {
        double share = n < 30 ? sqrt(fmax(low, 1e-9) * high)
                              : 0.5 * (low + high);
        lost = 0.0;
        for (int i = 0; i < groups; i++)
            lost += loss_at(&group[i], share);
        if (lost > MOST_LOST * energy)
            low = share;
        else
            high = share;
    }
    for (int i = 0; i < groups; i++)
        group[i].slope = (float)(high * group[i].energy /
                                 fmax(group[i].noise * group[i].variance,
                                      1e-30));
}

/* Multiplied by a line in what each frame lost: where the weights are those of
 * the least noise, no others lose so little with so little noise. */
void filter_detail_keep(const float lost[REACH + 1], float slope,
                        float weight[TAPS])
{
    struct loss l = loss_of(lost, weight);
    if (!(l.mean > 0.0f) || !(l.variance > 0.0f))
        return;
    if (slope * l.variance > l.mean)
        slope = l.mean / l.variance;
    for (int k = 0; k < TAPS; k++)
        weight[k] *= 1.0f +
                     slope * (l.mean - lost[k < REACH ? REACH - k : k - REACH]);
}
