/* film.h - the sums of all pixels of the rendered part, and what they say. */
#ifndef CORE_FILM_H
#define CORE_FILM_H
#include "core/brume.h"
#include "core/physics/pixel.h"

struct film {
    int width, height;          /* of the whole picture                    */
    int x0, y0, x1, y1;         /* the part, half open                     */
    uint32_t samples;           /* of every pixel so far                   */
    bool lines;                 /* each has run its straight line          */
    uint32_t share;             /* so many of them see the same field      */
    film_pixel *pixel;          /* row by row of the part                  */
    double *row;                /* a sum over each row                     */
    int threads;                /* for what is done to all pixels          */
    struct brume_still *still;  /* keeps their memory, or NULL             */
};

bool film_init(struct film *film, const struct brume_options *options,
               struct brume_error *err);
void film_release(struct film *film);
size_t film_pixels(const struct film *film);
/* Straight lines of a pixel that the first so many samples run. */
uint32_t film_lines(const struct film *film, uint32_t samples);

/* Estimated relRMSE (DESIGN.md) of the mean so far: the halves' difference
 * stands for the noise, the mean there or around for the reference. Infinite
 * below 4 samples. */
double film_error(const struct film *film);

/* Allocates the frame's planes and fills them with the means. */
bool film_resolve(const struct film *film, bool omit_background,
                  struct brume_frame *frame, struct brume_error *err);
#endif
