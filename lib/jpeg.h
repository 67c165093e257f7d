/* jpeg.h - JPEG files by libjpeg: grey or colours of 8 bits. */
#ifndef LIB_JPEG_H
#define LIB_JPEG_H
#include "lib/raster.h"

/* A file that ends too early or is damaged is refused. */
struct raster *jpeg_load(const char *path, struct brume_error *err);
#endif
