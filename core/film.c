#include "core/film.h"
#include "core/still.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/thread.h"

static bool check_part(const struct brume_options *o, struct brume_error *err)
{
    if (o->width < 1 || o->height < 1)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "a picture of %d x %d pixels cannot be rendered",
                          o->width, o->height);
    if (o->x0 < 0 || o->y0 < 0 || o->x1 > o->width || o->y1 > o->height ||
        o->x0 > o->x1 || o->y0 > o->y1)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "columns %d to %d, rows %d to %d do not lie in a "
                          "picture of %d x %d pixels",
                          o->x0, o->x1, o->y0, o->y1, o->width, o->height);
    return true;
}

static void clear_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct film *f = context;
    size_t width = (size_t)(f->x1 - f->x0);
    memset(f->pixel + y * width, 0, width * sizeof *f->pixel);
}

/* Memory that a frame before had: to come by as much anew takes longer than to
 * clear it. */
static bool take_kept(struct film *f)
{
    struct brume_still *still = f->still;
    if (!still || !still->pixels ||
        still->pixels_bytes != film_pixels(f) * sizeof *f->pixel)
        return false;
    f->pixel = still->pixels;
    still->pixels = NULL;
    parallel_for(f->threads, (size_t)(f->y1 - f->y0), clear_row, f, NULL);
    return true;
}

static void give_back(struct film *f)
{
    struct brume_still *still = f->still;
    if (!still || !f->pixel) {
        free(f->pixel);
        return;
    }
    free(still->pixels);
    still->pixels = f->pixel;
    still->pixels_bytes = film_pixels(f) * sizeof *f->pixel;
}

bool film_init(struct film *film, const struct brume_options *options,
               struct brume_error *err)
{
    memset(film, 0, sizeof *film);
    if (!check_part(options, err))
        return false;
    bool whole = options->x0 == 0 && options->y0 == 0 && options->x1 == 0 &&
                 options->y1 == 0;
    film->width = options->width;
    film->height = options->height;
    film->share = 1;
    film->x0 = options->x0;
    film->y0 = options->y0;
    film->x1 = whole ? options->width : options->x1;
    film->y1 = whole ? options->height : options->y1;
    film->threads = options->threads;
    film->still = options->still;
    if (!take_kept(film))
        film->pixel = memory_new(film_pixels(film), sizeof *film->pixel, err);
    film->row = memory_new((size_t)(film->y1 - film->y0), sizeof *film->row,
                           err);
    return film->pixel && film->row;
}

void film_release(struct film *film)
{
    give_back(film);
    free(film->row);
    film->pixel = NULL;
    film->row = NULL;
}

size_t film_pixels(const struct film *film)
{
    return (size_t)(film->x1 - film->x0) * (size_t)(film->y1 - film->y0);
}

uint32_t film_lines(const struct film *film, uint32_t samples)
{
    return pixel_lines(samples, film->lines);
}

static double line_count(const struct film *f)
{
    return film_lines(f, f->samples);
}

/* Mean over the samples of one half. */
static double half_mean(const struct film *f, const film_pixel *p,
                        uint32_t half, int channel)
{
    uint32_t paths = pixel_shared(f->samples, f->share, half);
    uint32_t lines = pixel_shared(film_lines(f, f->samples), f->share, half);
    return (paths ? p->path[half][channel] / paths : 0.0) +
           (lines ? p->line[half][channel] / lines : 0.0);
}

static double mean(const struct film *f, const film_pixel *p, int channel)
{
    double lines = line_count(f);
    return (p->path[0][channel] + p->path[1][channel]) / f->samples +
           (p->line[0][channel] + p->line[1][channel]) / lines;
}

/* Mean over the pixels beside one, which know nothing of its noise. */
static double mean_around(const struct film *f, size_t at, int channel)
{
    int width = f->x1 - f->x0, height = f->y1 - f->y0, count = 0;
    int x = (int)(at % (size_t)width), y = (int)(at / (size_t)width);
    double sum = 0.0;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++) {
            if (i == x && j == y)
                continue;
            sum += mean(f, &f->pixel[(size_t)j * (size_t)width + (size_t)i],
                        channel);
            count++;
        }
    return count ? sum / count : mean(f, &f->pixel[at], channel);
}

/* What all rows have together, in their order whoever found them. */
struct survey {
    const struct film *film;
    double image; /* mean of all pixels                      */
};

static double sum_rows(struct survey *s, parallel_body *body)
{
    const struct film *f = s->film;
    double sum = 0.0;
    parallel_for(f->threads, (size_t)(f->y1 - f->y0), body, s, NULL);
    for (int y = 0; y < f->y1 - f->y0; y++)
        sum += f->row[y];
    return sum;
}

static void light_of_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct film *f = ((const struct survey *)context)->film;
    size_t width = (size_t)(f->x1 - f->x0);
    double sum = 0.0;
    for (size_t i = y * width; i < (y + 1) * width; i++)
        for (int c = 0; c < 3; c++)
            sum += mean(f, &f->pixel[i], c);
    f->row[y] = sum;
}

/* Over its own mean a pixel in which few samples found much light would be off
 * by little; so would one beside a bright edge, over its neighbours'. The less
 * of the two counts. */
static void error_of_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct survey *s = context;
    const struct film *f = s->film;
    size_t width = (size_t)(f->x1 - f->x0);
    double floor = 0.01 * s->image * s->image, sum = 0.0;
    for (size_t i = y * width; i < (y + 1) * width; i++)
        for (int c = 0; c < 3; c++) {
            const film_pixel *p = &f->pixel[i];
            double d = half_mean(f, p, 0, c) - half_mean(f, p, 1, c);
            if (d == 0.0)
                continue;
            double m = fmin(fabs(mean(f, p, c)), fabs(mean_around(f, i, c)));
            sum += 0.25 * d * d / (m * m + floor);
        }
    f->row[y] = sum;
}

double film_error(const struct film *film)
{
    struct survey s = {.film = film};
    double values = 3.0 * (double)film_pixels(film);
    if (film->samples < 4 || film->samples < 2 * film->share)
        return INFINITY;
    if (!(values > 0.0))
        return 0.0;
    s.image = sum_rows(&s, light_of_row) / values;
    return sqrt(sum_rows(&s, error_of_row) / values);
}

static void resolve_pixel(const struct film *f, const film_pixel *p,
                          bool omit_background, size_t at,
                          struct brume_frame *frame)
{
    double lines = line_count(f);
    for (int c = 0; c < 3; c++) {
        double m = mean(f, p, c);
        if (omit_background)
            m -= p->background[c] / lines;
        frame->radiance[3 * at + (size_t)c] = (float)m;
        frame->opacity[3 * at + (size_t)c] = (float)(p->opacity[c] / lines);
    }
    frame->depth[at] = p->depth;
}

struct resolve {
    const struct film *film;
    bool omit_background;
    struct brume_frame *frame;
};

static void resolve_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct resolve *r = context;
    const struct film *f = r->film;
    size_t width = (size_t)(f->x1 - f->x0);
    size_t to = ((size_t)f->y0 + y) * (size_t)f->width + (size_t)f->x0;
    for (size_t x = 0; x < width; x++)
        resolve_pixel(f, &f->pixel[y * width + x], r->omit_background, to + x,
                      r->frame);
}

bool film_resolve(const struct film *film, bool omit_background,
                  struct brume_frame *frame, struct brume_error *err)
{
    size_t pixels = (size_t)film->width * (size_t)film->height;
    frame->width = film->width;
    frame->height = film->height;
    frame->radiance = memory_new(pixels, 3 * sizeof(float), err);
    frame->opacity = memory_new(pixels, 3 * sizeof(float), err);
    frame->depth = memory_new(pixels, sizeof(float), err);
    if (!frame->radiance || !frame->opacity || !frame->depth) {
        brume_frame_free(frame);
        return false;
    }
    struct resolve r = {film, omit_background, frame};
    parallel_for(film->threads, (size_t)(film->y1 - film->y0), resolve_row, &r,
                 NULL);
    return true;
}

void brume_frame_free(struct brume_frame *frame)
{
    free(frame->radiance);
    free(frame->opacity);
    free(frame->depth);
    frame->radiance = frame->opacity = frame->depth = NULL;
}
