/* develop.h - what the sums of a film's pixels say: the picture, and how far it
 * may be off. */
#ifndef CORE_PHYSICS_DEVELOP_H
#define CORE_PHYSICS_DEVELOP_H
#include "core/physics/pixel.h"

/* Of a part of so many pixels, what each had so far. */
typedef struct {
    int32_t width, height;
    double samples, lines;
    double path[2], line[2]; /* of these in each half                       */
} film_counts;

/* Sums over rows: of the means, or of the squared errors of these. */
typedef struct {
    film_counts n;
    int32_t errors;         /* 1: of errors, relative to the mean there ...   */
    double floor;           /* ... its square and this                        */
} film_survey;

/* A pixel of the picture. */
typedef struct {
    float radiance[3], opacity[3], depth;
} film_look;

HD double develop_mean(const film_counts *n, const film_pixel *p, int channel)
{
    return (p->path[0][channel] + p->path[1][channel]) / n->samples +
           (p->line[0][channel] + p->line[1][channel]) / n->lines;
}

/* Over the samples of one half. */
HD double develop_half(const film_counts *n, const film_pixel *p, int half,
                       int channel)
{
    double path = n->path[half], line = n->line[half];
    return (path > 0.0 ? p->path[half][channel] / path : 0.0) +
           (line > 0.0 ? p->line[half][channel] / line : 0.0);
}

/* Mean over the pixels beside one, which know nothing of its noise. */
HD double develop_around(const film_counts *n, const film_pixel *pixel,
                         int32_t x, int32_t y, int channel)
{
    double sum = 0.0;
    int count = 0;
    for (int32_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < n->height; j++)
        for (int32_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < n->width; i++) {
            if (i == x && j == y)
                continue;
            sum += develop_mean(
                n, pixel + ((int64_t)j * n->width + i), channel);
            count++;
        }
    return count ? sum / count
                 : develop_mean(n, pixel + ((int64_t)y * n->width + x),
                                channel);
}

/* The square of a channel's relative error as the halves tell it (METHODS.md
 * 10). Over its own mean a pixel in which few samples found much light would be
 * off by little; so would one beside a bright edge, over its neighbours'. The
 * less of the two counts. */
HD double develop_error(const film_survey *s, const film_pixel *pixel,
                        int32_t x, int32_t y, int channel)
{
    const film_counts *n = &s->n;
    const film_pixel *p = pixel + ((int64_t)y * n->width + x);
    double d = develop_half(n, p, 0, channel) - develop_half(n, p, 1, channel);
    if (d == 0.0)
        return 0.0;
    double m = fmin(fabs(develop_mean(n, p, channel)),
                    fabs(develop_around(n, pixel, x, y, channel)));
    return 0.25 * d * d / (m * m + s->floor);
}

/* What is summed up, of a channel of a pixel. */
HD double develop_term(const film_survey *s, const film_pixel *pixel, int32_t x,
                       int32_t y, int channel)
{
    return s->errors ? develop_error(s, pixel, x, y, channel)
                     : develop_mean(&s->n,
                                    pixel + ((int64_t)y * s->n.width + x),
                                    channel);
}

HD film_look develop_look(const film_counts *n, const film_pixel *p,
                          bool omit_background)
{
    film_look out;
    for (int c = 0; c < 3; c++) {
        double m = develop_mean(n, p, c);
        if (omit_background)
            m -= p->background[c] / n->lines;
        out.radiance[c] = (float)m;
        out.opacity[c] = (float)(p->opacity[c] / n->lines);
    }
    out.depth = p->depth;
    return out;
}

#endif
