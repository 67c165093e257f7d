/* pnm.h - portable greymaps and pixmaps, plain and binary (P2, P3, P5, P6). */
#ifndef LIB_PNM_H
#define LIB_PNM_H
#include "lib/raster.h"

/* The first picture of the file; raster.max is that of its header. */
struct raster *pnm_load(const char *path, struct brume_error *err);
#endif
