/* film.h - the sums of all pixels of the rendered part, and what they say. */
#ifndef CORE_FILM_H
#define CORE_FILM_H
#include "core/brume.h"
#include "core/physics/develop.h"

struct film {
    int width, height;          /* of the whole picture                    */
    int x0, y0, x1, y1;         /* the part, half open                     */
    uint32_t samples;           /* of every pixel so far                   */
    bool lines;                 /* each has run its straight line          */
    uint32_t share;             /* so many of them see the same field      */
    film_pixel *pixel;          /* row by row of the part; NULL: none here */
    double *row;                /* a sum over each row                     */
    int threads;                /* for what is done to all pixels          */
    struct brume_still *still;  /* keeps their memory, or NULL             */
};

/* Without memory for pixels: film_room makes that, where they are on the host,
 * all 0. */
bool film_init(struct film *film, const struct brume_options *options,
               struct brume_error *err);
bool film_room(struct film *film, struct brume_error *err);
void film_release(struct film *film);
size_t film_pixels(const struct film *film);
/* Straight lines of a pixel that the first so many samples run. */
uint32_t film_lines(const struct film *film, uint32_t samples);
film_counts film_counts_of(const struct film *film);

/* Puts a survey's sum over each row, in the order of pixels and channels, into
 * film->row; that of a film whose pixels are on the host is film_rows_here, of
 * which `user` is the film. */
typedef bool film_rows(void *user, const film_survey *what,
                       struct brume_error *err);
film_rows film_rows_here;

/* Estimated relRMSE (DESIGN.md) of the mean so far: the halves' difference
 * stands for the noise, the mean there or around for the reference. Infinite
 * below 4 samples. False: the rows could not be had. */
bool film_error(const struct film *film, film_rows *rows, void *user,
                double *error, struct brume_error *err);

/* Allocates the frame's planes, all 0. */
bool film_planes(const struct film *film, struct brume_frame *frame,
                 struct brume_error *err);
/* Puts pixels of the part, so many from number `from` on, into the planes. */
void film_put(const struct film *film, size_t from, size_t count,
              const film_look *look, struct brume_frame *frame);
/* All of them, where they are on the host. */
void film_develop_here(const struct film *film, bool omit_background,
                       struct brume_frame *frame);
#endif
