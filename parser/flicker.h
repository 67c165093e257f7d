/* flicker.h - how much the frames of a film flicker, and how much they are
 * blurred, against those of a reference. Pictures are linear radiance, three
 * numbers a pixel. */
#ifndef PARSER_FLICKER_H
#define PARSER_FLICKER_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/error.h"

struct flicker_film {
    int width, height, frames;
    const float *const *frame;
    /* Twice, with noise of their own: of what is multiplied one factor has the
     * one, one the other, so that none of their noise counts. */
    const float *const *reference[2];
};

struct flicker {
    double error;               /* relMSE of single frames, their mean     */
    double deviation;           /* temporal, of a pixel's difference from
                                   the reference, over the reference's mean
                                   (at least a tenth of the picture's): RMS
                                   over pixels that are lit                 */
    double difference;          /* energy of frame-to-frame differences less
                                   the reference's, over its mean square   */
    double band;                /* part of the temporal variance at 5 to 15
                                   Hz of 24 frames a second; NAN below 24
                                   frames                                  */
    double motion;              /* of the reference's changes from frame to
                                   frame, what is there; NAN: none move    */
    double detail;              /* the same of changes from pixel to pixel */
};

/* Of two or more frames. */
bool flicker_find(const struct flicker_film *film, struct flicker *out,
                  struct brume_error *err);
#endif
