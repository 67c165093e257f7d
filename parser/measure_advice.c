/* What the rows of a measurement say: the best of them, and how to get a
 * wanted error. */
#include "parser/measure.h"
#include <math.h>

/* Rows at the end of a series that tell how its error falls. */
#define FITTED 4
/* Times that much longer a bias not seen yet may be what is left. */
#define BIASED_REACH 16.0

bool measure_uncertain(const struct measure *m, const struct measure_row *row)
{
    return m->noise > 0.0 && row->difference < 1.2 * m->noise;
}

static bool beats(const struct measure_row *a, const struct measure_row *b)
{
    bool no_worse = a->seconds <= b->seconds && a->error <= b->error;
    return no_worse && (a->seconds < b->seconds || a->error < b->error);
}

static void take_row(struct measure_advice *to, const struct measure_row *row)
{
    if (to->set.series >= 0 && to->seconds <= row->seconds)
        return;
    *to = (struct measure_advice){row->set, row->seconds, row->error, true};
}

/* The last rows of a series, latest first, that tell an error. */
static int last_rows(const struct measure *m, int series,
                     const struct measure_row *out[FITTED])
{
    int count = 0;
    for (int i = m->rows - 1; i >= 0 && count < FITTED; i--) {
        const struct measure_row *row = &m->row[i];
        if (row->set.series == series && row->error > 0.0 &&
            row->seconds > row->prepare_seconds && !measure_uncertain(m, row))
            out[count++] = row;
    }
    return count;
}

/* Slope of log error over log time, by least squares: where it is all noise
 * and there is but one row, that of 1 / sqrt. 0: it does not fall. */
static double slope_of(const struct measure_row *const row[], int count,
                       bool unbiased)
{
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    if (count < 2)
        return unbiased ? -0.5 : 0.0;
    for (int i = 0; i < count; i++) {
        double a = log(row[i]->seconds - row[i]->prepare_seconds);
        double b = log(row[i]->error);
        x += a / count;
        y += b / count;
        xx += a * a / count;
        xy += a * b / count;
    }
    double slope = xx > x * x ? (xy - x * y) / (xx - x * x) : 0.0;
    /* Faster than stratification makes it fall is chance. */
    slope = fmax(slope, unbiased ? -1.0 : -0.5);
    return slope < -0.1 ? slope : 0.0;
}

/* A number so many times as large; what is whole but for rounding stays. */
static double grown(double number, double factor)
{
    return ceil(number * factor * (1.0 - 1e-9));
}

/* From the last row of a series along its slope. */
static void extrapolate(const struct measure *m, int series, double goal,
                        struct measure_advice *to)
{
    const struct measure_row *row[FITTED];
    bool unbiased = measure_series[series].unbiased;
    int count = last_rows(m, series, row);
    double slope = count > 0 ? slope_of(row, count, unbiased) : 0.0;
    if (slope == 0.0)
        return;
    double factor = fmax(pow(row[0]->error / goal, -1.0 / slope), 1.0);
    double seconds = row[0]->prepare_seconds +
                     factor * (row[0]->seconds - row[0]->prepare_seconds);
    double spp = grown(row[0]->set.spp, factor);
    if (!(spp <= BRUME_MAX_SPP) || (!unbiased && factor > BIASED_REACH) ||
        (to->set.series >= 0 && to->seconds <= seconds))
        return;
    *to = (struct measure_advice){row[0]->set, seconds, goal, false};
    to->set.spp = (int)spp;
    to->set.photons = (uint64_t)grown((double)row[0]->set.photons, factor);
}

static struct measure_advice advise(const struct measure *m, double goal)
{
    struct measure_advice best = {.set.series = -1};
    for (int i = 0; i < m->rows; i++)
        if (m->row[i].error <= goal)
            take_row(&best, &m->row[i]);
    bool measured = best.set.series >= 0;
    for (int i = 0; !measured && i < measure_series_count; i++)
        extrapolate(m, i, goal, &best);
    return best;
}

void measure_conclude(struct measure *m)
{
    for (int i = 0; i < m->rows; i++) {
        m->row[i].front = true;
        for (int k = 0; k < m->rows; k++)
            if (beats(&m->row[k], &m->row[i]))
                m->row[i].front = false;
    }
    for (int i = 0; i < MEASURE_GOALS; i++)
        m->advice[i] = advise(m, measure_goals[i]);
}
