/* image.h - a picture in the caller's memory, as the writers of EXR, PNG and
 * PPM take it: linear light, alpha associated (colour already multiplied by
 * it, as rendering and EXR have it), the first row on top.
 *
 * A file has its full size even when only a region was rendered: the pixels
 * outside the region are 0 in every channel. */
#ifndef LIB_IMAGE_H
#define LIB_IMAGE_H
#include <stddef.h>
#include "lib/error.h"

struct image_channel {
    const char *name;       /* R, G, B, A, Z, ... as the EXR file shall say */
    const float *base;      /* the sample of the region's top left pixel    */
    ptrdiff_t stride;       /* floats from a pixel to its right neighbour   */
    ptrdiff_t row;          /* floats from a row to the one below           */
};

struct image {
    int width, height;      /* of the file                                  */
    int x0, y0, x1, y1;     /* the region held, in pixels; x1, y1 excluded  */
    const struct image_channel *channel;
    size_t channels;
};

/* False with err set (BRUME_ERR_USAGE) unless the sides are in 1..2^24 and the
 * region lies inside. */
bool image_check(const struct image *image, struct brume_error *err);

/* The channel of that name, or NULL. */
const struct image_channel *image_find(const struct image *image,
                                       const char *name);

/* One row of a channel at full width into out[0], out[step], ...: zeros where
 * the region does not reach. */
void image_row(const struct image *image, const struct image_channel *channel,
               int y, float *out, size_t step);
#endif
