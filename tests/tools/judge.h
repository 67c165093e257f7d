/* judge.h - how wrong pictures are, beside references that are noisy too.
 *
 * Of two pictures a, b made alike from different seeds and two references r, q
 * all noises are independent, so that the means over pixels of
 *     (a - r) (a - q)     is the square of a picture's error,
 *     (a - r) (b - q)     that of what a and b share of it, the bias,
 *     (a - b)^2 / 2       that of a picture's noise,
 *     (r - q)^2 / 4       that of the noise of the references' mean,
 * with no noise left in the first two but for chance, which parts of the
 * picture tell by how much they differ. All are weighted by 1 / (t^2 + 0.01
 * m^2) as relRMSE is, t being the mean of the references over 3 x 3 pixels, so
 * that their noise does not weigh itself, and m that of the picture. */
#ifndef TESTS_TOOLS_JUDGE_H
#define TESTS_TOOLS_JUDGE_H
#include <math.h>
#include <stdio.h>

struct judged_plane {
    int width, height;
    const float *channel[3];
};

/* The mean over parts, and how uncertain it is. */
struct judged_mean {
    double sum, square, parts;
};

struct judged {
    struct judged_mean error, bias, noise, reference, off;
    double mean;                /* of the references                       */
    double worst;               /* share of one pixel in the error         */
    int x, y;                   /* which                                   */
};

enum { JUDGED_PART = 16 };

static double judged_mean(const struct judged_mean *m)
{
    return m->parts > 0 ? m->sum / m->parts : 0;
}

/* Standard error of it. */
static double judged_doubt(const struct judged_mean *m)
{
    double mean = judged_mean(m);
    double spread = m->square / m->parts - mean * mean;
    return m->parts > 1 ? sqrt(fmax(spread, 0) / (m->parts - 1)) : 0;
}

static void judged_add(struct judged_mean *m, double value)
{
    m->sum += value;
    m->square += value * value;
    m->parts++;
}

/* The references' mean around a pixel. */
static double judged_around(const struct judged_plane *p, int c, int x, int y)
{
    double sum = 0;
    int n = 0;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            if (i < 0 || j < 0 || i >= p->width || j >= p->height)
                continue;
            size_t at = (size_t)j * (size_t)p->width + (size_t)i;
            sum += 0.5 * ((double)p[0].channel[c][at] + p[1].channel[c][at]);
            n++;
        }
    return sum / n;
}

/* Sums over a part of the picture that begins at x0, y0. */
struct judged_part {
    double error, bias, noise, reference, off, n;
};

static void judge_pixel(const struct judged_plane *p, int x, int y,
                        struct judged *out, struct judged_part *part)
{
    size_t i = (size_t)y * (size_t)p->width + (size_t)x;
    double all = 0;
    for (int c = 0; c < 3; c++) {
        double t = judged_around(p, c, x, y);
        double w = 1 / (t * t + 0.01 * out->mean * out->mean);
        double r = p[0].channel[c][i], q = p[1].channel[c][i];
        double a = p[2].channel[c][i], b = p[3].channel[c][i];
        double error = 0.5 * w * ((a - r) * (a - q) + (b - r) * (b - q));
        part->error += error;
        part->bias += 0.5 * w * ((a - r) * (b - q) + (a - q) * (b - r));
        part->noise += 0.5 * w * (a - b) * (a - b);
        part->reference += 0.25 * w * (r - q) * (r - q);
        part->off += 0.5 * (a + b - r - q) / out->mean;
        part->n++;
        all += error;
    }
    if (all > out->worst) {
        out->worst = all;
        out->x = x;
        out->y = y;
    }
}

static void judge_part(const struct judged_plane *p, int x0, int y0,
                       struct judged *out)
{
    struct judged_part s = {0};
    for (int y = y0; y < y0 + JUDGED_PART && y < p->height; y++)
        for (int x = x0; x < x0 + JUDGED_PART && x < p->width; x++)
            judge_pixel(p, x, y, out, &s);
    judged_add(&out->error, s.error / s.n);
    judged_add(&out->bias, s.bias / s.n);
    judged_add(&out->noise, s.noise / s.n);
    judged_add(&out->reference, s.reference / s.n);
    judged_add(&out->off, s.off / s.n);
}

/* Two references and two pictures, all of one size. */
static void judge(const struct judged_plane p[4], struct judged *out)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    double sum = 0;
    *out = (struct judged){.x = -1, .y = -1};
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < pixels; i++)
            sum += 0.5 * ((double)p[0].channel[c][i] + p[1].channel[c][i]);
    out->mean = sum / (3 * (double)pixels);
    for (int y = 0; y < p->height; y += JUDGED_PART)
        for (int x = 0; x < p->width; x += JUDGED_PART)
            judge_part(p, x, y, out);
    out->worst /= 3 * (double)pixels * fmax(judged_mean(&out->error), 1e-30);
}

/* The root of a mean square with its sign, and the root of that by which it
 * may be larger, two standard errors. */
static void judge_print_root(const char *name, const struct judged_mean *m)
{
    double mean = judged_mean(m), doubt = 2 * judged_doubt(m);
    printf("\"%s\": %.6g, \"%s_most\": %.6g, ", name,
           copysign(sqrt(fabs(mean)), mean), name,
           sqrt(fmax(mean + doubt, 0)));
}

static void judge_print(const struct judged *j)
{
    printf("{");
    judge_print_root("error", &j->error);
    judge_print_root("bias", &j->bias);
    judge_print_root("noise", &j->noise);
    judge_print_root("reference_noise", &j->reference);
    printf("\"mean\": %.6g, \"off\": %.6g, \"off_doubt\": %.6g, "
           "\"worst\": %.4g, \"worst_at\": [%d, %d]}\n",
           j->mean, judged_mean(&j->off), judged_doubt(&j->off), j->worst, j->x,
           j->y);
}
#endif
