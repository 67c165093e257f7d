/* ppm.h - binary portable pixmaps (P6): the plainest picture file, which
 * drivers read from standard output. Code values as in png.h, no alpha. */
#ifndef LIB_PPM_H
#define LIB_PPM_H
#include <stdio.h>
#include "lib/error.h"
#include "lib/image.h"

/* `bits` is 8 or 16 (high byte first). Errors as png_save's. */
bool ppm_save(const char *path, const struct image *image, int bits,
              struct brume_error *err);
bool ppm_save_stream(FILE *stream, const char *name,
                     const struct image *image, int bits,
                     struct brume_error *err);
#endif
