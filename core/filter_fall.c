/* How what frames have in common falls with their distance.
 *
 * Of two frames it is the mean product of what they have; of a frame itself
 * that of its halves. The noise of neither is in it. */
#include "core/filter_fall.h"
#include <math.h>
#include <string.h>

enum { TAPS = BRUME_MAX_TAPS, REACH = BRUME_MAX_REACH };

/* ---- kinds of bricks ---------------------------------------------------- */

/* Bricks are as noisy as they are bright: half octaves below the noisiest. */
enum { BINS = 32 };

static int half_octave(float x)
{
    int exponent;
    float part = frexpf(x, &exponent);
    return 2 * exponent + (part >= 0.70710678f);
}

static int bin_of(const struct filter_kinds *kinds, float noise)
{
    int bin = kinds->top - half_octave(noise);
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

/* Sums over bricks: the energy that frames of a distance have in common, of
 * distance 0 by the halves of each frame; that of the noise, and its square. */
struct sums {
    double energy[REACH + 1], noise, square;
};

/* Of the blocks' detail, and of the bricks as wholes. */
struct scales {
    struct sums fine, whole;
};

/* Weights of pairs of frames by distance: their sums, and those of squares. */
struct spread {
    double sum[REACH + 1], square[REACH + 1];
};

static struct spread spread_of(const double weight[TAPS])
{
    struct spread s = {{0}, {0}};
    for (int k = 0; k < TAPS; k++)
        for (int j = k; j < TAPS && j - k <= REACH; j++) {
            double w = weight[k] * weight[j];
            s.sum[j - k] += w;
            s.square[j - k] += w * w;
        }
    return s;
}

/* The mean over those frames that are given. */
static double own_mean(const float own[TAPS], uint32_t given,
                       const double weight[TAPS])
{
    double sum = 0.0, weights = 0.0;
    for (int k = 0; k < TAPS; k++) {
        double w = given >> k & 1 ? weight[k] * weight[k] : 0.0;
        sum += w * (double)own[k];
        weights += w;
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

/* Adds a brick's: of a distance what frames have of their own less what pairs
 * of them lack of it, so that noise of light that all have is in neither. */
static void add_own(const float own[TAPS], uint32_t given,
                    const double weight[TAPS], const struct spread *spread,
                    const double pair[REACH + 1], double noise,
                    struct sums *out)
{
    double mean = own_mean(own, given, weight), both[REACH + 1] = {0};
    for (int k = 0; k < TAPS; k++)
        for (int j = k + 1; j < TAPS && j - k <= REACH; j++)
            both[j - k] += 0.5 * weight[k] * weight[j] *
                           ((given >> k & 1 ? (double)own[k] : mean) +
                            (given >> j & 1 ? (double)own[j] : mean));
    out->energy[0] += mean;
    for (int d = 1; d <= REACH; d++)
        if (spread->sum[d] > 0.0)
            out->energy[d] += mean - (both[d] - pair[d]) / spread->sum[d];
    out->noise += noise;
    out->square += noise * noise;
}

static void add_brick(const struct filter_common *c, const double weight[TAPS],
                      const struct spread *spread, struct scales *out)
{
    double fine[REACH + 1] = {0}, whole[REACH + 1] = {0};
    const float *pair = c->pair;
    for (int k = 0; k < TAPS; k++)
        for (int j = k + 1; j < TAPS; j++, pair++) {
            double w = weight[k] * weight[j];
            if (j - k > REACH)
                continue;
            fine[j - k] += w * (double)*pair;
            whole[j - k] += w * (double)c->sum[k] * (double)c->sum[j];
        }
    add_own(c->own, c->given, weight, spread, fine, (double)c->noise,
            &out->fine);
    add_own(c->whole, c->given, weight, spread, whole, (double)c->whole_noise,
            &out->whole);
}

/* What frames have in common, on average. */
static double energy_of(const struct sums *s)
{
    double sum = 0.0;
    for (int d = 1; d <= REACH; d++)
        sum += s->energy[d] / REACH;
    return sum > 0.0 ? sum : 0.0;
}

/* The brightest first; each kind has its share of all energy. */
static void share_out(const struct scales bin[BINS], struct filter_kinds *kinds)
{
    double all = 0.0, sum = 0.0;
    for (int i = 0; i < BINS; i++)
        all += energy_of(&bin[i].fine);
    for (int i = 0; i < BINS; i++) {
        int kind = all > 0.0 ? (int)(FILTER_KINDS * sum / all) : 0;
        kinds->of[i] = kind < FILTER_KINDS ? kind : FILTER_KINDS - 1;
        sum += energy_of(&bin[i].fine);
    }
}

static int top_of(const struct filter_common *brick, size_t bricks)
{
    float most = 0.0f;
    for (size_t i = 0; i < bricks; i++)
        most = brick[i].noise > most ? brick[i].noise : most;
    return half_octave(most);
}

int filter_kind(const struct filter_kinds *kinds,
                const struct filter_common *brick)
{
    return brick->noise > 0.0f ? kinds->of[bin_of(kinds, brick->noise)]
                               : FILTER_KINDS - 1;
}

void filter_fall_sort(const struct filter_common *brick, size_t bricks,
                      const double weight[TAPS], struct filter_kinds *kinds)
{
    struct scales bin[BINS];
    struct spread spread = spread_of(weight);
    memset(bin, 0, sizeof bin);
    kinds->top = top_of(brick, bricks);
    for (size_t i = 0; i < bricks; i++)
        if (brick[i].counts)
            add_brick(&brick[i], weight, &spread,
                      &bin[bin_of(kinds, brick[i].noise)]);
    share_out(bin, kinds);
}

/* ---- their fall --------------------------------------------------------- */

enum { TIMES = 20, PARTS = 12 };

/* Noise of blocks side by side has this much in common: squares of it vary by
 * so much more. */
#define ALIKE 2.0
/* What the falls below can't be told nearer than. */
#define UNLIKE 2e-3
/* How much better a fall must fit than another, in squares of chance errors. */
#define CERTAIN 9.0

/* What frames have in common by their distance: a part falls within a time,
 * between as what moves evenly does and what does by chance; the rest stays. */
struct fall {
    double common[REACH + 1];
};

struct falls {
    struct fall still, fall[TIMES * PARTS];
};

static struct fall fall_of(double part, double time)
{
    struct fall f;
    for (int d = 0; d <= REACH; d++) {
        double x = d / time;
        f.common[d] = 1.0 - part * (1.0 - exp(-x * sqrt(x)));
    }
    return f;
}

static void list_falls(struct falls *out)
{
    double time = 0.4;
    out->still = fall_of(0.0, 1.0);
    for (int i = 0; i < TIMES; i++, time *= 1.3) {
        double part = 1.0;
        for (int k = 0; k < PARTS; k++, part *= 0.7)
            out->fall[i * PARTS + k] = fall_of(part, time);
    }
}

/* The chance errors of energies, squared; `free`: numbers of a brick. */
static void find_errors(const struct sums *s, const struct spread *spread,
                        int free, double error[REACH + 1])
{
    double noise = ALIKE * s->square / free, unlike = UNLIKE * energy_of(s);
    for (int d = 0; d <= REACH; d++) {
        double sum = spread->sum[d] * spread->sum[d];
        double part = sum > 0.0 ? spread->square[d] / sum : 1e30;
        /* Each half of a frame has twice its noise. */
        error[d] = (d == 0 ? 4.0 : 1.0) * noise * part +
                   unlike * unlike / free + 1e-300;
    }
}

/* By how many chance errors, squared, energies are off the fall. */
static double misfit(const struct fall *f, const struct sums *s,
                     const double error[REACH + 1])
{
    double square = 0.0, along = 0.0, all = 0.0;
    for (int d = 0; d <= REACH; d++) {
        square += f->common[d] * f->common[d] / error[d];
        along += f->common[d] * s->energy[d] / error[d];
        all += s->energy[d] * s->energy[d] / error[d];
    }
    return along > 0.0 ? all - along * along / square : all;
}

/* The fall that fits best, and what all say by how likely they are: their mean
 * less its chance error. Where photons are few the mean alone lets too much of
 * the detail be lost. */
struct found {
    struct fall best, sure;
    double better; /* than none, in squares of chance errors            */
};

static void find_sure(const struct falls *falls,
                      const double off[TIMES * PARTS], struct found *out)
{
    double least = INFINITY, sum = 0.0;
    struct fall mean = {{0}}, square = {{0}};
    for (int i = 0; i < TIMES * PARTS; i++)
        least = fmin(least, off[i]);
    for (int i = 0; i < TIMES * PARTS; i++) {
        double weight = exp(-0.5 * fmin(off[i] - least, 100.0));
        sum += weight;
        for (int d = 0; d <= REACH; d++) {
            double x = falls->fall[i].common[d];
            mean.common[d] += weight * x;
            square.common[d] += weight * x * x;
        }
    }
    for (int d = 0; d <= REACH; d++) {
        double x = mean.common[d] / sum;
        double variance = fmax(square.common[d] / sum - x * x, 0.0);
        out->sure.common[d] = fmax(x - sqrt(variance), 0.0);
    }
}

/* Of `count` kinds together, with numbers of a brick `free`. */
static struct found fit(const struct falls *falls, const struct sums *const s[],
                        int count, const struct spread *spread, int free)
{
    struct found out = {falls->still, falls->still, 0.0};
    double error[FILTER_KINDS][REACH + 1], still = 0.0, off[TIMES * PARTS];
    for (int n = 0; n < count; n++) {
        find_errors(s[n], spread, free, error[n]);
        still += misfit(&falls->still, s[n], error[n]);
    }
    for (int i = 0; i < TIMES * PARTS; i++) {
        off[i] = 0.0;
        for (int n = 0; n < count; n++)
            off[i] += misfit(&falls->fall[i], s[n], error[n]);
        if (still - off[i] > out.better) {
            out.best = falls->fall[i];
            out.better = still - off[i];
        }
    }
    find_sure(falls, off, &out);
    return out;
}

static void put_lost(const struct fall *f, float lost[REACH + 1])
{
    for (int d = 0; d <= REACH; d++)
        lost[d] = (float)(1.0 - f->common[d]);
}

/* Its own where that fits much better than the one of all. */
static struct fall fall_of_kind(const struct falls *falls,
                                const struct fall *all, const struct sums *fine,
                                const struct spread *spread)
{
    double error[REACH + 1];
    struct found own = fit(falls, &fine, 1, spread, FILTER_BLOCKS - 1);
    find_errors(fine, spread, FILTER_BLOCKS - 1, error);
    bool apart = misfit(all, fine, error) - misfit(&own.best, fine, error) >
                 CERTAIN;
    return apart ? own.sure : *all;
}

/* That something changes shows in the bricks as wholes first, which noise hides
 * least; how much of the detail does, in the blocks. */
static struct fall fall_of_all(const struct falls *falls,
                               const struct scales kind[FILTER_KINDS],
                               const struct spread *spread)
{
    const struct sums *fine[FILTER_KINDS], *whole[FILTER_KINDS];
    for (int i = 0; i < FILTER_KINDS; i++) {
        fine[i] = &kind[i].fine;
        whole[i] = &kind[i].whole;
    }
    struct found f = fit(falls, fine, FILTER_KINDS, spread, FILTER_BLOCKS - 1),
                 w = fit(falls, whole, FILTER_KINDS, spread, 1);
    bool changes = f.better > CERTAIN || w.better > CERTAIN;
    return changes ? f.sure : falls->still;
}

void filter_fall_fit(const struct filter_common *brick, size_t bricks,
                     const double weight[TAPS],
                     const struct filter_kinds *kinds, struct filter_falls *out)
{
    struct scales kind[FILTER_KINDS];
    struct spread spread = spread_of(weight);
    struct falls falls;
    list_falls(&falls);
    memset(kind, 0, sizeof kind);
    for (size_t i = 0; i < bricks; i++)
        if (brick[i].counts)
            add_brick(&brick[i], weight, &spread,
                      &kind[filter_kind(kinds, &brick[i])]);
    struct fall all = fall_of_all(&falls, kind, &spread);
    put_lost(&all, out->all);
    for (int i = 0; i < FILTER_KINDS; i++) {
        const struct sums *fine = &kind[i].fine;
        struct fall own = fall_of_kind(&falls, &all, fine, &spread);
        put_lost(&own, out->lost[i]);
        out->energy[i] = energy_of(fine);
        out->noise[i] = fine->noise;
    }
}
