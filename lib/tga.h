/* tga.h - Targa files: grey of 8 bits, palettes, RGB of 15 to 32 bits, plain
 * or run-length encoded. */
#ifndef LIB_TGA_H
#define LIB_TGA_H
#include "lib/raster.h"

/* Colours of 5 bits become the high bits of 8, as POV-Ray has them. */
struct raster *tga_load(const char *path, struct brume_error *err);
#endif
