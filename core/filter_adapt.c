/* A mean over frames with weights of its own for each cell.
 *
 * How far a neighbour in time differs is judged over the cell's surroundings,
 * 5^3 cells: what is above the noise there is change. The frames at the same
 * distance before and after count as one, their mean, since what moves evenly
 * cancels in it; where that differs more than they do singly, as at a cut,
 * they count singly. Weights then make the sum of squared change and variance
 * least: with b the changes, all of one sign at worst, and V the variance,
 * w ~ 1 - b Sum b / (V + Sum b^2). */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/filter.h"
#include "core/filter_view.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* What a squared difference may be, over what its noise gives: that of a box
 * is known to a fifth or so, and changes that are not there would cost more
 * than those that are overlooked. The square of a box's mean difference may be
 * so many times that of independent cells, which neighbours are not. */
#define MARGIN 1.2
#define MARGIN_OF_MEAN 10.0

enum { PAD = 2, BOX = 2 * PAD + 1, EDGE = 8 + 2 * PAD };
enum { AROUND = EDGE * EDGE * EDGE, INSIDE = 512, MIDDLE = BRUME_MAX_REACH };

/* What is known of a brick and its surroundings, for one thread. */
struct patch {
    float value[BRUME_MAX_TAPS][3][AROUND];
    float there[BRUME_MAX_TAPS][AROUND];  /* 1, or 0: no cell           */
    float mean[3][INSIDE], cells[INSIDE]; /* of the middle frame         */
    /* Of the pair at each distance, then of the frame before and after: the
     * squared difference from the middle frame's, a cell's part. */
    float differ[BRUME_MAX_REACH][3][INSIDE];
    /* By how much the frame before and after is darker, by channels. */
    float shift[BRUME_MAX_REACH][2][3][INSIDE];
    float work[AROUND], more[AROUND];
};

struct adapt {
    struct flat *flat;
    struct filter_view view[BRUME_MAX_TAPS];
    double noise[BRUME_MAX_TAPS];
    int reach, primary;
    struct patch *patch;
};

/* ---- patches ------------------------------------------------------------ */

static void load_frame(const struct adapt *a, struct patch *p, int k,
                       const int corner[3])
{
    const struct filter_view *v = &a->view[k];
    float cell[FILTER_MAX_NUMBERS];
    int i = 0;
    for (int z = -PAD; z < 8 + PAD; z++)
        for (int y = -PAD; y < 8 + PAD; y++)
            for (int x = -PAD; x < 8 + PAD; x++, i++) {
                int at[3] = {corner[0] + x, corner[1] + y, corner[2] + z};
                bool there = filter_view_cell(v, at, cell);
                p->there[k][i] = there;
                for (int c = 0; c < 3; c++)
                    p->value[k][c][i] = there ? cell[a->primary + c] : 0.0f;
            }
}

/* Sums over the box around each inner cell: along z, y, then x. */
static void box_sums(struct patch *p, const float *in, float *out)
{
    enum { ROW = EDGE, PLANE = EDGE * EDGE };
    for (int z = 0; z < 8; z++)
        for (int i = 0; i < PLANE; i++) {
            float sum = 0.0f;
            for (int k = 0; k < BOX; k++)
                sum += in[(z + k) * PLANE + i];
            p->work[z * PLANE + i] = sum;
        }
    for (int z = 0; z < 8; z++)
        for (int y = 0; y < 8; y++)
            for (int x = 0; x < EDGE; x++) {
                float sum = 0.0f;
                for (int k = 0; k < BOX; k++)
                    sum += p->work[z * PLANE + (y + k) * ROW + x];
                p->more[(z * 8 + y) * EDGE + x] = sum;
            }
    for (int i = 0; i < 64; i++)
        for (int x = 0; x < 8; x++) {
            float sum = 0.0f;
            for (int k = 0; k < BOX; k++)
                sum += p->more[i * EDGE + x + k];
            out[i * 8 + x] = sum;
        }
}

static void find_means(struct patch *p)
{
    for (int c = 0; c < 3; c++)
        box_sums(p, p->value[MIDDLE][c], p->mean[c]);
    box_sums(p, p->there[MIDDLE], p->cells);
}

static void find_shift(struct patch *p, int m, int j, float *sum)
{
    int k = j ? MIDDLE + m : MIDDLE - m;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < AROUND; i++)
            sum[i] = p->there[k][i] * p->there[MIDDLE][i] *
                     (p->value[MIDDLE][c][i] - p->value[k][c][i]);
        box_sums(p, sum, p->shift[m - 1][j][c]);
    }
}

/* Squared differences of the middle frame from what stands for it: the mean of
 * those before and after where both are there. */
static void find_differences(struct patch *p, int m, float *sum)
{
    const int before = MIDDLE - m, after = MIDDLE + m;
    const int from[3] = {before, before, after};
    const int to[3] = {after, before, after};
    for (int j = 0; j < 3; j++) {
        const float *u = p->there[from[j]], *v = p->there[to[j]];
        for (int i = 0; i < AROUND; i++)
            sum[i] = 0.0f;
        for (int c = 0; c < 3; c++) {
            const float *x = p->value[from[j]][c], *y = p->value[to[j]][c];
            const float *z = p->value[MIDDLE][c];
            for (int i = 0; i < AROUND; i++) {
                float d = z[i] - 0.5f * (x[i] + y[i]);
                sum[i] += u[i] * v[i] * p->there[MIDDLE][i] * d * d;
            }
        }
        box_sums(p, sum, p->differ[m - 1][j]);
    }
}

/* ---- weights ------------------------------------------------------------ */

/* An estimate of the middle frame: its variance, and how far it is off. */
struct estimate {
    double variance, change;
    int from, to; /* frames that it is the mean of               */
};

/* A frame's variance over its noise, of all channels together, where these are
 * their sums over the box. */
static double level_of(const double sums[3], double cells)
{
    double square = 0.0, sum = 0.0;
    for (int c = 0; c < 3; c++) {
        double mean = fmax(sums[c] / cells, 0.0);
        square += mean * mean;
        sum += mean;
    }
    return sum > 0.0 ? 3.0 * square / sum : 0.0;
}

/* How far the mean over the box changed, squared, beyond what noise does: j 0
 * the pair's mean, 1 the frame before, 2 the one after. */
static double mean_change(const struct patch *p, int i, int m, int j,
                          double variance)
{
    double cells = (double)p->cells[i], square = 0.0;
    for (int c = 0; c < 3; c++) {
        double before = (double)p->shift[m - 1][0][c][i];
        double after = (double)p->shift[m - 1][1][c][i];
        double d = j == 0 ? 0.5 * (before + after) : j == 1 ? before : after;
        square += d * d / (cells * cells);
    }
    return fmax(square - MARGIN_OF_MEAN * variance / cells, 0.0);
}

/* The level by the mean of those frames that are as bright as the middle one;
 * `level`, of all of them, is a first guess of it. */
static double pool(const struct adapt *a, const struct patch *p, int i,
                   double level, bool all)
{
    double sums[3], shift[3] = {0}, count = 1.0;
    for (int m = 1; m <= a->reach; m++)
        for (int j = 1; j <= 2; j++) {
            int k = j == 1 ? MIDDLE - m : MIDDLE + m;
            double variance = (a->noise[MIDDLE] + a->noise[k]) * level;
            if (!a->view[k].field ||
                (!all && mean_change(p, i, m, j, variance) > 0.0))
                continue;
            count += 1.0;
            for (int c = 0; c < 3; c++)
                shift[c] += (double)p->shift[m - 1][j - 1][c][i];
        }
    for (int c = 0; c < 3; c++)
        sums[c] = (double)p->mean[c][i] - shift[c] / count;
    return level_of(sums, (double)p->cells[i]);
}

static double find_level(const struct adapt *a, const struct patch *p, int i)
{
    return pool(a, p, i, pool(a, p, i, 0.0, true), false);
}

static struct estimate judge(const struct adapt *a, const struct patch *p,
                             int i, int m, int j, double level)
{
    struct estimate e = {.from = j == 2 ? MIDDLE + m : MIDDLE - m,
                         .to = j == 1 ? MIDDLE - m : MIDDLE + m};
    double own = a->noise[MIDDLE] * level;
    double x = a->noise[e.from] * level, y = a->noise[e.to] * level;
    e.variance = e.from == e.to ? x : 0.25 * (x + y);
    double differ = (double)p->differ[m - 1][j][i] / (double)p->cells[i];
    double change = fmax(differ - MARGIN * (own + e.variance),
                         mean_change(p, i, m, j, own + e.variance));
    e.change = sqrt(fmax(change, 0.0));
    return e;
}

static double precision(const struct estimate *e)
{
    return 1.0 / (e->variance + e->change * e->change);
}

static bool is_there(const struct patch *p, int k, int i)
{
    int x = i & 7, y = i >> 3 & 7, z = i >> 6;
    return p->there[k][((z + PAD) * EDGE + y + PAD) * EDGE + x + PAD] > 0.0f;
}

/* Those of one distance: the pair's, or one or two single frames'. */
static int list_estimates(const struct adapt *a, const struct patch *p, int i,
                          int m, double level, struct estimate *out)
{
    bool before = is_there(p, MIDDLE - m, i),
         after = is_there(p, MIDDLE + m, i);
    int count = 0;
    if (before)
        out[count++] = judge(a, p, i, m, 1, level);
    if (after)
        out[count++] = judge(a, p, i, m, 2, level);
    if (count < 2)
        return count;
    struct estimate pair = judge(a, p, i, m, 0, level);
    if (precision(&pair) < precision(&out[0]) + precision(&out[1]))
        return 2;
    out[0] = pair;
    return 1;
}

/* Fills the weights of all frames for one cell. */
static void find_weights(const struct adapt *a, const struct patch *p, int i,
                         double weight[BRUME_MAX_TAPS])
{
    struct estimate e[BRUME_MAX_TAPS];
    double variance = find_level(a, p, i), sum = 0.0, square = 0.0;
    int count = 1;
    for (int k = 0; k < BRUME_MAX_TAPS; k++)
        weight[k] = 0.0;
    weight[MIDDLE] = 1.0;
    if (!(variance > 0.0))
        return;
    for (int m = 1; m <= a->reach; m++)
        count += list_estimates(a, p, i, m, variance, e + count);
    for (int k = 1; k < count; k++) {
        sum += e[k].change / e[k].variance;
        square += e[k].change * e[k].change / e[k].variance;
    }
    double slope = sum / (1.0 + square);
    weight[MIDDLE] = 1.0 / (a->noise[MIDDLE] * variance);
    for (int k = 1; k < count; k++) {
        double w = fmax(1.0 - e[k].change * slope, 0.0) / e[k].variance;
        weight[e[k].from] += 0.5 * w;
        weight[e[k].to] += 0.5 * w;
    }
}

/* ---- bricks ------------------------------------------------------------- */

static void mix_cell(const struct adapt *a, const int at[3],
                     const double weight[BRUME_MAX_TAPS], float *out)
{
    int numbers = a->flat->view.field.numbers;
    double sum[FILTER_MAX_NUMBERS] = {0}, weights = 0.0;
    float value[FILTER_MAX_NUMBERS];
    for (int k = 0; k < BRUME_MAX_TAPS; k++) {
        if (!(weight[k] > 0.0) || !filter_view_cell(&a->view[k], at, value))
            continue;
        weights += weight[k];
        for (int i = 0; i < numbers; i++)
            sum[i] += weight[k] * (double)value[i];
    }
    for (int i = 0; weights > 0.0 && i < numbers; i++)
        out[i] = (float)(sum[i] / weights);
}

static void adapt_brick(void *context, size_t index, int thread)
{
    const struct adapt *a = context;
    const radiance_lattice *f = &a->flat->view.field;
    struct patch *p = &a->patch[thread];
    int32_t slot = a->flat->radiance_slots[index];
    float work[AROUND];
    int corner[3];
    if (slot < 0)
        return;
    filter_corner(f, index, corner);
    for (int k = MIDDLE - a->reach; k <= MIDDLE + a->reach; k++)
        load_frame(a, p, k, corner);
    find_means(p);
    for (int m = 1; m <= a->reach; m++) {
        find_differences(p, m, work);
        find_shift(p, m, 0, work);
        find_shift(p, m, 1, work);
    }
    float *out = a->flat->radiance + (size_t)slot * 512 * (size_t)f->numbers;
    for (int i = 0; i < INSIDE; i++, out += f->numbers) {
        double weight[BRUME_MAX_TAPS];
        int at[3] = {corner[0] + (i & 7), corner[1] + (i >> 3 & 7),
                     corner[2] + (i >> 6)};
        find_weights(a, p, i, weight);
        mix_cell(a, at, weight, out);
    }
}

bool filter_adapt(struct flat *flat, const struct filter_field *const *fields,
                  int reach, int threads, struct brume_error *err)
{
    struct adapt a = {.flat = flat, .reach = reach};
    const radiance_lattice *f = &flat->view.field;
    a.primary = f->fluence >= 0 ? f->fluence : f->eye;
    for (int k = -reach; k <= reach; k++) {
        const struct filter_field *field = fields[reach + k];
        filter_view_init(&a.view[MIDDLE + k], flat, field);
        a.noise[MIDDLE + k] = field ? field->noise : 0.0;
    }
    threads = threads > 0 ? threads : thread_processors();
    a.patch = memory_new((size_t)threads, sizeof *a.patch, err);
    if (!a.patch)
        return false;
    parallel_for(threads, flat->radiance_slots_count, adapt_brick, &a, NULL);
    free(a.patch);
    return true;
}
