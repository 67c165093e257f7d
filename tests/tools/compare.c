/* compare.c - pictures against pictures, for the scripts of the suite.
 *
 *   compare same A B               status 0: all samples have the same bits
 *   compare relrmse A REF          prints the error of A
 *   compare mean A X0 Y0 X1 Y1     prints the mean of R, G and B over a part,
 *                                  half open, in pixels
 *   compare judge REF REF2 A B
 *       Of two independent pictures made alike and two independent references:
 *       what is theirs of the difference and what is noise, as JSON; see
 *       judge.h. References may be larger by a whole factor, as samples lie
 *       evenly in a pixel: means of their pixels are those of the picture.
 *   compare bias REF SPP RUN_SPP RUN...
 *       Are the runs, independent and of RUN_SPP samples a pixel, pictures of
 *       what REF, of SPP samples, shows? Prints the worst tile's t and the
 *       chance to see one as bad; status 1 where that is below BIAS_CHANCE.
 *
 * Status 2: usage, 5: a file could not be read. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "lib/exr.h"
#include "tests/tools/judge.h"

/* Seeds are fixed, so a test that passes does so always; the bound is for
 * the change that makes other random choices. */
#define BIAS_CHANCE 1e-4

/* Deviation of a tile that is let be, in units of the picture's mean. */
#define UNSEEN 0.003

enum { TILE = 8, MAX_RUNS = 64 };

static const char *const channels[3] = {"R", "G", "B"};

static struct exr_picture *load(const char *path)
{
    struct brume_error err = {0};
    struct exr_picture *p = exr_load(path, &err);
    if (!p || !exr_plane(p, "R") || !exr_plane(p, "G") || !exr_plane(p, "B")) {
        fprintf(stderr, "compare: %s%s\n", p ? path : err.text,
                p ? " has no R, G and B" : "");
        exit(BRUME_ERR_FILE);
    }
    return p;
}

static void need_same_size(const struct exr_picture *a,
                           const struct exr_picture *b)
{
    if (a->width == b->width && a->height == b->height)
        return;
    fprintf(stderr, "compare: %dx%d pixels against %dx%d\n", a->width,
            a->height, b->width, b->height);
    exit(1);
}

static int same(const char *path_a, const char *path_b)
{
    struct exr_picture *a = load(path_a), *b = load(path_b);
    need_same_size(a, b);
    size_t bytes = (size_t)a->width * (size_t)a->height * sizeof(float);
    int differ = a->channels != b->channels;
    for (size_t i = 0; i < a->channels; i++) {
        const float *other = exr_plane(b, a->name[i]);
        differ |= !other || memcmp(a->plane[i], other, bytes) != 0;
    }
    exr_free(a);
    exr_free(b);
    return differ;
}

/* Mean of a plane over [x0, x1) x [y0, y1). */
static double mean_of(const struct exr_picture *p, int channel, int x0, int y0,
                      int x1, int y1)
{
    const float *plane = exr_plane(p, channels[channel]);
    double sum = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            sum += plane[(size_t)y * (size_t)p->width + (size_t)x];
    return sum / ((double)(x1 - x0) * (y1 - y0));
}

static double mean_of_all(const struct exr_picture *p)
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += mean_of(p, c, 0, 0, p->width, p->height);
    return sum / 3;
}

static int print_mean(const char *path, char *const part[4])
{
    struct exr_picture *p = load(path);
    int x0 = atoi(part[0]), y0 = atoi(part[1]);
    int x1 = atoi(part[2]), y1 = atoi(part[3]);
    bool fits = 0 <= x0 && x0 < x1 && x1 <= p->width && 0 <= y0 && y0 < y1 &&
                y1 <= p->height;
    if (fits)
        printf("%.9g\n",
               (mean_of(p, 0, x0, y0, x1, y1) + mean_of(p, 1, x0, y0, x1, y1) +
                mean_of(p, 2, x0, y0, x1, y1)) /
                   3);
    exr_free(p);
    return fits ? 0 : 2;
}

/* sqrt(mean((x - ref)^2 / (ref^2 + 0.01 mean(ref)^2))), over all pixels and
 * channels. */
static int print_relrmse(const char *path, const char *path_ref)
{
    struct exr_picture *p = load(path), *ref = load(path_ref);
    need_same_size(p, ref);
    double mean = mean_of_all(ref), sum = 0;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    for (int c = 0; c < 3; c++) {
        const float *x = exr_plane(p, channels[c]);
        const float *r = exr_plane(ref, channels[c]);
        for (size_t i = 0; i < pixels; i++) {
            double d = (double)x[i] - r[i];
            sum += d * d / ((double)r[i] * r[i] + 0.01 * mean * mean);
        }
    }
    printf("%.6f\n", sqrt(sum / (3 * (double)pixels)));
    exr_free(p);
    exr_free(ref);
    return 0;
}

/* Means over squares of n x n pixels. */
static void shrink(struct exr_picture *p, int n)
{
    int width = p->width / n, height = p->height / n;
    for (size_t c = 0; c < p->channels; c++)
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                double sum = 0;
                for (int i = 0; i < n * n; i++)
                    sum +=
                        p->plane[c][(size_t)(n * y + i / n) * (size_t)p->width +
                                    (size_t)(n * x + i % n)];
                p->plane[c][(size_t)y * (size_t)width + (size_t)x] =
                    (float)(sum / (n * n));
            }
    p->width = width;
    p->height = height;
}

static int print_judged(char *const path[4])
{
    struct exr_picture *p[4];
    struct judged_plane plane[4];
    struct judged out;
    for (int i = 3; i >= 0; i--) {
        p[i] = load(path[i]);
        if (i < 2 && p[i]->width % p[3]->width == 0)
            shrink(p[i], p[i]->width / p[3]->width);
        need_same_size(p[i], p[3]);
        plane[i] = (struct judged_plane){
            p[i]->width,
            p[i]->height,
            {exr_plane(p[i], "R"), exr_plane(p[i], "G"), exr_plane(p[i], "B")}};
    }
    judge(plane, &out);
    judge_print(&out);
    for (int i = 0; i < 4; i++)
        exr_free(p[i]);
    return 0;
}

/* Continued fraction of the incomplete beta function (DLMF 8.17.22), by
 * Lentz's method. */
static double beta_fraction(double a, double b, double x)
{
    const double tiny = 1e-300;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < tiny ? tiny : d);
    double h = d;
    for (int m = 1; m < 500; m++) {
        double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        double odd = -(a + m) * (a + b + m) * x /
                     ((a + 2 * m) * (a + 2 * m + 1));
        for (int half = 0; half < 2; half++) {
            double term = half ? odd : even;
            d = 1 + term * d;
            c = 1 + term / c;
            d = 1 / (fabs(d) < tiny ? tiny : d);
            c = fabs(c) < tiny ? tiny : c;
            h *= c * d;
        }
        if (fabs(c * d - 1) < 1e-14)
            break;
    }
    return h;
}

/* Chance that Student's t with n degrees of freedom is beyond +-t. */
static double student_two_sided(double t, double n)
{
    double x = n / (n + t * t), a = n / 2, b = 0.5;
    if (!(x < 1))
        return 1;
    double front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) +
                       b * log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(a, b, x) / a;
    return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

struct bias {
    double worst;      /* largest |t| of a tile                          */
    int x, y, channel; /* where                                          */
    int tests;
};

/* The means of one tile in the runs against the reference's. The variance of
 * the reference's mean is the runs' over `effort`, its share of samples; what
 * is below `unseen` is none: light that comes so rarely that the runs may not
 * have met it. */
static double tile_t(struct exr_picture *const *run, int runs,
                     const struct exr_picture *ref, double effort,
                     double unseen, int channel, const int part[4])
{
    double mean = 0, spread = 0, value[MAX_RUNS];
    for (int i = 0; i < runs; i++) {
        value[i] = mean_of(run[i], channel, part[0], part[1], part[2], part[3]);
        mean += value[i] / runs;
    }
    for (int i = 0; i < runs; i++)
        spread += (value[i] - mean) * (value[i] - mean) / (runs - 1);
    double truth = mean_of(ref, channel, part[0], part[1], part[2], part[3]);
    return (mean - truth) /
           sqrt(spread / runs + spread / effort + unseen * unseen);
}

static struct bias worst_tile(struct exr_picture *const *run, int runs,
                              const struct exr_picture *ref, double effort)
{
    struct bias bias = {0};
    double unseen = UNSEEN * mean_of_all(ref);
    for (int y = 0; y < ref->height; y += TILE)
        for (int x = 0; x < ref->width; x += TILE)
            for (int c = 0; c < 3; c++) {
                int right = x + TILE < ref->width ? x + TILE : ref->width;
                int low = y + TILE < ref->height ? y + TILE : ref->height;
                double t = tile_t(run, runs, ref, effort, unseen, c,
                                  (const int[4]){x, y, right, low});
                bias.tests++;
                if (fabs(t) > fabs(bias.worst) || bias.tests == 1) {
                    bias.worst = t;
                    bias.x = x;
                    bias.y = y;
                    bias.channel = c;
                }
            }
    return bias;
}

static int print_bias(const char *path_ref, double spp, double run_spp,
                      char *const *paths, int runs)
{
    struct exr_picture *ref = load(path_ref), *run[MAX_RUNS];
    for (int i = 0; i < runs; i++) {
        run[i] = load(paths[i]);
        need_same_size(run[i], ref);
    }
    struct bias bias = worst_tile(run, runs, ref, spp / run_spp);
    /* One chance for each tile: Bonferroni's bound. */
    double chance = fmin(1,
                         bias.tests * student_two_sided(bias.worst, runs - 1));
    printf("worst of %d tiles: t = %.2f at (%d, %d) in %s, chance %.2g\n",
           bias.tests, bias.worst, bias.x, bias.y, channels[bias.channel],
           chance);
    for (int i = 0; i < runs; i++)
        exr_free(run[i]);
    exr_free(ref);
    return chance >= BIAS_CHANCE ? 0 : 1;
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (!strcmp(what, "same") && argc == 4)
        return same(argv[2], argv[3]);
    if (!strcmp(what, "relrmse") && argc == 4)
        return print_relrmse(argv[2], argv[3]);
    if (!strcmp(what, "mean") && argc == 7)
        return print_mean(argv[2], argv + 3);
    if (!strcmp(what, "judge") && argc == 6)
        return print_judged(argv + 2);
    if (!strcmp(what, "bias") && argc >= 7 && argc - 5 <= MAX_RUNS)
        return print_bias(argv[2], atof(argv[3]), atof(argv[4]), argv + 5,
                          argc - 5);
    fprintf(stderr, "usage: compare same|relrmse|mean|judge|bias ... "
                    "(see tests/tools/compare.c)\n");
    return 2;
}
