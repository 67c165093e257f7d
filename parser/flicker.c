#include "parser/flicker.h"
#include "lib/memory.h"
#include <math.h>
#include <stdlib.h>

/* Pixels whose mean is at least this part of the picture's are lit. */
#define LIT 0.01
#define FRAMES_A_SECOND 24.0

/* ---- single frames ------------------------------------------------------ */

static size_t numbers(const struct flicker_film *f)
{
    return 3 * (size_t)f->width * (size_t)f->height;
}

static double truth(const struct flicker_film *f, int t, size_t i)
{
    return 0.5 *
           ((double)f->reference[0][t][i] + (double)f->reference[1][t][i]);
}

/* What is more than in one of the references. */
static double over(const struct flicker_film *f, int which, int t, size_t i)
{
    return (double)f->frame[t][i] - (double)f->reference[which][t][i];
}

static double mean_of(const struct flicker_film *f)
{
    double sum = 0.0;
    for (int t = 0; t < f->frames; t++)
        for (size_t i = 0; i < numbers(f); i++)
            sum += truth(f, t, i);
    return sum / ((double)f->frames * (double)numbers(f));
}

static double frame_error(const struct flicker_film *f, int t)
{
    double mean = 0.0, sum = 0.0;
    for (size_t i = 0; i < numbers(f); i++)
        mean += truth(f, t, i) / (double)numbers(f);
    for (size_t i = 0; i < numbers(f); i++) {
        double r = truth(f, t, i), d = over(f, 0, t, i) * over(f, 1, t, i);
        if (d != 0.0)
            sum += d / (r * r + 0.01 * mean * mean);
    }
    return sum / (double)numbers(f);
}

/* ---- over time ---------------------------------------------------------- */

/* Mean of a number; variance of its difference from the truth. */
struct course {
    double reference, variance;
};

static struct course course_of(const struct flicker_film *f, size_t i)
{
    struct course c = {0};
    double mean[2] = {0};
    for (int t = 0; t < f->frames; t++) {
        c.reference += truth(f, t, i) / f->frames;
        for (int k = 0; k < 2; k++)
            mean[k] += over(f, k, t, i) / f->frames;
    }
    for (int t = 0; t < f->frames; t++)
        c.variance += (over(f, 0, t, i) - mean[0]) *
                      (over(f, 1, t, i) - mean[1]) / (f->frames - 1);
    return c;
}

static double root(double x)
{
    return x > 0.0 ? sqrt(x) : 0.0;
}

static double deviation(const struct flicker_film *f, double mean)
{
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < numbers(f); i++) {
        struct course c = course_of(f, i);
        if (!(c.reference > LIT * mean))
            continue;
        sum += c.variance / (c.reference * c.reference + 0.01 * mean * mean);
        count += 1.0;
    }
    return count > 0.0 ? root(sum / count) : 0.0;
}

static double change(const float *const *film, int t, size_t i)
{
    return (double)film[t][i] - (double)film[t - 1][i];
}

/* Changes from frame to frame: what is wrong with them, and what of the
 * reference's is in them. Noise, which does not follow the reference, does not
 * count there. */
static void find_changes(const struct flicker_film *f, struct flicker *out)
{
    double wrong = 0.0, along = 0.0, all = 0.0, square = 0.0;
    for (int t = 0; t < f->frames; t++)
        for (size_t i = 0; i < numbers(f); i++) {
            double r = truth(f, t, i);
            square += r * r / f->frames;
            if (t == 0)
                continue;
            double x = change(f->frame, t, i);
            double y = change(f->reference[0], t, i);
            double z = change(f->reference[1], t, i);
            wrong += (x - y) * (x - z) / (f->frames - 1);
            along += 0.5 * x * (y + z);
            all += y * z;
        }
    out->difference = square > 0.0 ? wrong / square : 0.0;
    out->motion = all > 0.0 ? along / all : (double)NAN;
}

static double step(const float *const *film, int t, size_t from, size_t to)
{
    return (double)film[t][to] - (double)film[t][from];
}

static void find_detail(const struct flicker_film *f, struct flicker *out)
{
    double along = 0.0, all = 0.0;
    size_t row = 3 * (size_t)f->width;
    for (int t = 0; t < f->frames; t++)
        for (size_t i = 0; i < numbers(f); i++) {
            size_t beside[2] = {i % row + 3 < row ? i + 3 : i,
                                i + row < numbers(f) ? i + row : i};
            for (int k = 0; k < 2; k++) {
                double x = step(f->frame, t, i, beside[k]);
                double y = step(f->reference[0], t, i, beside[k]);
                double z = step(f->reference[1], t, i, beside[k]);
                along += 0.5 * x * (y + z);
                all += y * z;
            }
        }
    out->detail = all > 0.0 ? along / all : (double)NAN;
}

/* ---- spectrum ----------------------------------------------------------- */

/* Power of the differences of one number at frequency k / frames. */
static double power_at(const struct flicker_film *f, size_t i, int k,
                       const double *cosine, const double *sine)
{
    double re[2] = {0}, im[2] = {0};
    for (int t = 0; t < f->frames; t++) {
        int turn = (int)((long)k * t % f->frames);
        for (int j = 0; j < 2; j++) {
            double d = over(f, j, t, i);
            re[j] += d * cosine[turn];
            im[j] += d * sine[turn];
        }
    }
    return re[0] * re[1] + im[0] * im[1];
}

static bool find_band(const struct flicker_film *f, struct flicker *out,
                      struct brume_error *err)
{
    double inside = 0.0, all = 0.0;
    out->band = (double)NAN;
    if (f->frames < 24)
        return true;
    double *cosine = memory_new(2 * (size_t)f->frames, sizeof *cosine, err);
    if (!cosine)
        return false;
    double *sine = cosine + f->frames;
    for (int t = 0; t < f->frames; t++) {
        cosine[t] = cos(2.0 * 3.14159265358979 * t / f->frames);
        sine[t] = sin(2.0 * 3.14159265358979 * t / f->frames);
    }
    for (int k = 1; k <= f->frames / 2; k++) {
        double hertz = FRAMES_A_SECOND * k / f->frames, power = 0.0;
        for (size_t i = 1; i < numbers(f); i += 3) /* green */
            power += power_at(f, i, k, cosine, sine);
        power *= 2 * k == f->frames ? 0.5 : 1.0;
        all += power;
        inside += hertz >= 5.0 && hertz <= 15.0 ? power : 0.0;
    }
    free(cosine);
    out->band = all > 0.0 ? inside / all : 0.0;
    return true;
}

bool flicker_find(const struct flicker_film *film, struct flicker *out,
                  struct brume_error *err)
{
    if (film->frames < 2)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "flicker takes two frames or more");
    out->error = 0.0;
    for (int t = 0; t < film->frames; t++)
        out->error += frame_error(film, t) / film->frames;
    out->deviation = deviation(film, mean_of(film));
    find_changes(film, out);
    find_detail(film, out);
    return find_band(film, out, err);
}
