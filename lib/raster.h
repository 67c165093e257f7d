/* raster.h - pictures from files, as the codes that stand there.
 *
 * Readers check a file's size against its header before they take memory, and
 * hold pictures to RASTER_MOST pixels. Errors are BRUME_ERR_FILE and name the
 * file. */
#ifndef LIB_RASTER_H
#define LIB_RASTER_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

#define RASTER_MOST ((size_t)1 << 28)

struct raster {
    int width, height;
    int channels;           /* 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA     */
    unsigned max;           /* the greatest code: 255 or 65535 but in PNM  */
    int colors;             /* of the palette, whose numbers the one channel
                               has; 0: none                                */
    uint8_t palette[256][3];
    uint8_t opacity[256];   /* of its colours                              */
    int intent;             /* of a PNG's sRGB chunk; -1: there is none    */
    double gamma;           /* that a PNG without it is encoded by (0.45455
                               of usual ones); 0: it does not say          */
    uint16_t *sample;       /* interleaved codes, rows from the top        */
};

/* Of no colours, its samples 0. NULL: too large for the file of that name, or
 * no memory. */
struct raster *raster_new(long long width, long long height, int channels,
                          unsigned max, const char *path,
                          struct brume_error *err);
void raster_free(struct raster *raster);

/* Reads a file of a format by its word in the scene language, or a usual
 * ending: gif, jpeg, jpg, pgm, png, pot, ppm (either kind), tga. NULL with err
 * set. */
struct raster *raster_load(const char *format, const char *path,
                           struct brume_error *err);
/* Whether it reads such files. */
bool raster_reads(const char *format);
#endif
