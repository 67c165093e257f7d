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
    film->row = memory_new((size_t)(film->y1 - film->y0), sizeof *film->row,
                           err);
    return film->row != NULL;
}

bool film_room(struct film *film, struct brume_error *err)
{
    if (!film->pixel && !take_kept(film))
        film->pixel = memory_new(film_pixels(film), sizeof *film->pixel, err);
    return film->pixel != NULL;
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

film_counts film_counts_of(const struct film *f)
{
    film_counts n = {.width = f->x1 - f->x0, .height = f->y1 - f->y0};
    uint32_t lines = film_lines(f, f->samples);
    n.samples = f->samples;
    n.lines = lines;
    for (uint32_t half = 0; half < 2; half++) {
        n.path[half] = pixel_shared(f->samples, f->share, half);
        n.line[half] = pixel_shared(lines, f->share, half);
    }
    return n;
}

struct survey {
    struct film *film;
    const film_survey *what;
};

static void survey_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct survey *s = context;
    double sum = 0.0;
    for (int32_t x = 0; x < s->what->n.width; x++)
        for (int c = 0; c < 3; c++)
            sum += develop_term(s->what, s->film->pixel, x, (int32_t)y, c);
    s->film->row[y] = sum;
}

bool film_rows_here(void *film, const film_survey *what,
                    struct brume_error *err)
{
    (void)err;
    struct survey s = {film, what};
    parallel_for(s.film->threads, (size_t)what->n.height, survey_row, &s, NULL);
    return true;
}

/* What all rows have together, in their order whoever found them. */
static double sum_of_rows(const struct film *f)
{
    double sum = 0.0;
    for (int y = 0; y < f->y1 - f->y0; y++)
        sum += f->row[y];
    return sum;
}

bool film_error(const struct film *film, film_rows *rows, void *user,
                double *error, struct brume_error *err)
{
    film_survey what = {.n = film_counts_of(film)};
    double values = 3.0 * (double)film_pixels(film);
    bool few = film->samples < 4 || film->samples < 2 * film->share;
    *error = few ? INFINITY : 0.0;
    if (few || !(values > 0.0))
        return true;
    if (!rows(user, &what, err))
        return false;
    double image = sum_of_rows(film) / values;
    what.errors = 1;
    what.floor = 0.01 * image * image;
    if (!rows(user, &what, err))
        return false;
    *error = sqrt(sum_of_rows(film) / values);
    return true;
}

bool film_planes(const struct film *film, struct brume_frame *frame,
                 struct brume_error *err)
{
    size_t pixels = (size_t)film->width * (size_t)film->height;
    frame->width = film->width;
    frame->height = film->height;
    frame->radiance = memory_new(pixels, 3 * sizeof(float), err);
    frame->opacity = memory_new(pixels, 3 * sizeof(float), err);
    frame->depth = memory_new(pixels, sizeof(float), err);
    if (frame->radiance && frame->opacity && frame->depth)
        return true;
    brume_frame_free(frame);
    return false;
}

void film_put(const struct film *film, size_t from, size_t count,
              const film_look *look, struct brume_frame *frame)
{
    size_t width = (size_t)(film->x1 - film->x0);
    for (size_t i = from; i < from + count; i++, look++) {
        size_t x = (size_t)film->x0 + i % width;
        size_t y = (size_t)film->y0 + i / width;
        size_t at = y * (size_t)film->width + x;
        memcpy(frame->radiance + 3 * at, look->radiance, sizeof look->radiance);
        memcpy(frame->opacity + 3 * at, look->opacity, sizeof look->opacity);
        frame->depth[at] = look->depth;
    }
}

struct developing {
    const struct film *film;
    film_counts n;
    bool omit_background;
    struct brume_frame *frame;
};

static void develop_row(void *context, size_t y, int thread)
{
    (void)thread;
    const struct developing *d = context;
    size_t width = (size_t)d->n.width;
    for (size_t i = y * width; i < (y + 1) * width; i++) {
        film_look look = develop_look(&d->n, &d->film->pixel[i],
                                      d->omit_background);
        film_put(d->film, i, 1, &look, d->frame);
    }
}

void film_develop_here(const struct film *film, bool omit_background,
                       struct brume_frame *frame)
{
    struct developing d = {film, film_counts_of(film), omit_background, frame};
    parallel_for(film->threads, (size_t)d.n.height, develop_row, &d, NULL);
}

void brume_frame_free(struct brume_frame *frame)
{
    free(frame->radiance);
    free(frame->opacity);
    free(frame->depth);
    frame->radiance = frame->opacity = frame->depth = NULL;
}
