/* radiance.h - pictures of light: red, green, blue and alpha as floats, colour
 * associated with alpha, rows from the top.
 *
 * Errors are BRUME_ERR_FILE and name the file. */
#ifndef LIB_RADIANCE_H
#define LIB_RADIANCE_H
#include "lib/error.h"

struct radiance {
    int width, height;
    float *sample;          /* 4 a pixel                                   */
};

/* Reads an OpenEXR file, of its data window: R, G, B or Y for all of them;
 * alpha is 1 without an A. NULL with err set. */
struct radiance *radiance_load(const char *path, struct brume_error *err);
void radiance_free(struct radiance *radiance);
#endif
