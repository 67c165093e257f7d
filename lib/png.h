/* png.h - PNG files by libpng: sRGB code values, 8 or 16 bits a sample.
 *
 * Linear light is clipped to 0..1, takes the sRGB curve and is rounded to the
 * nearest code, without dither; NaN becomes 0. The file says so (sRGB and
 * gAMA chunks).
 *
 * Alpha in a PNG is unassociated, as POV-Ray writes it too: colour is divided
 * by alpha before the curve. A pixel that only adds light (fire, with alpha
 * near 0) can't be told in such a file: it clips, and at alpha 0 it is black.
 * Compositing such pixels takes an EXR. */
#ifndef LIB_PNG_H
#define LIB_PNG_H
#include <stdio.h>
#include "lib/error.h"
#include "lib/image.h"
#include "lib/raster.h"

/* Writes channels R, G, B and, where `alpha`, A. `bits` is 8 or 16. Errors
 * are BRUME_ERR_FILE and name the file; it appears only when complete. */
bool png_save(const char *path, const struct image *image, int bits,
              bool alpha, struct brume_error *err);

/* The same into an open stream, which `name` stands for in errors. */
bool png_save_stream(FILE *stream, const char *name,
                     const struct image *image, int bits, bool alpha,
                     struct brume_error *err);

/* Reads any PNG; grey of fewer bits becomes 8-bit samples. */
struct raster *png_load(const char *path, struct brume_error *err);
#endif
