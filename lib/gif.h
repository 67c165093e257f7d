/* gif.h - GIF files by giflib: the numbers of a palette. */
#ifndef LIB_GIF_H
#define LIB_GIF_H
#include "lib/raster.h"

/* The first picture of the file. */
struct raster *gif_load(const char *path, struct brume_error *err);

/* A height field of Fractint (.pot): a GIF whose left half has the high bytes
 * of 16-bit greys, and whose right half the low ones. */
struct raster *pot_load(const char *path, struct brume_error *err);
#endif
