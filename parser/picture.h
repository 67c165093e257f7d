/* picture.h - a finished frame into an EXR, PNG or PPM file. */
#ifndef PARSER_PICTURE_H
#define PARSER_PICTURE_H
#include <stdio.h>
#include "core/brume.h"
#include "lib/exr.h"
#include "parser/options.h"

struct picture {
    const struct brume_frame *frame;
    enum options_format format;
    int bits;                       /* 5 to 16: PNG and PPM have 8 or 16   */
    bool alpha;                     /* the frame is without its background */
    const struct exr_text *text;    /* for the header of an EXR            */
    size_t texts;
    int threads;                    /* 0: as many as processors            */
};

/* An EXR has R, G, B (linear radiance), opacity.R, opacity.G, opacity.B, Z,
 * and with alpha A, the luminance of the opacity, with which R, G, B are
 * associated. PNG and PPM are sRGB, a PPM without alpha. A path of "-" stands
 * for `out`. Errors are lib's. */
bool picture_write(const struct picture *picture, const char *path, FILE *out,
                   struct brume_error *err);

#endif
