/* codes.h - rows of an image as the bytes of display files (PNG, PPM): R, G,
 * B and perhaps A as sRGB codes of 8 or 16 bits, high byte first. */
#ifndef LIB_CODES_H
#define LIB_CODES_H
#include <stddef.h>
#include "lib/image.h"

struct codes {
    const struct image *image;
    const struct image_channel *from[4];    /* R, G, B, A                 */
    int channels;                           /* 3 or 4                     */
    int bits;                               /* 8 or 16                    */
    float *light;                           /* a row, channels interleaved */
    unsigned char *bytes;                   /* the same row, encoded      */
    size_t size;                            /* of bytes                   */
};

/* False with err set when a channel is missing, `bits` is wrong or memory is
 * short. codes_release may follow in any case. */
bool codes_init(struct codes *codes, const struct image *image, int bits,
                bool alpha, struct brume_error *err);
void codes_release(struct codes *codes);

/* Encodes row y and returns its bytes, valid until the next call. */
const unsigned char *codes_row(struct codes *codes, int y);
#endif
