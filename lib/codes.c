#include "lib/codes.h"
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/srgb.h"

bool codes_init(struct codes *codes, const struct image *image, int bits,
                bool alpha, struct brume_error *err)
{
    static const char *const names[] = {"R", "G", "B", "A"};
    memset(codes, 0, sizeof *codes);
    if (bits != 8 && bits != 16)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "%d bits a colour; 8 or 16 can be written", bits);
    if (!image_check(image, err))
        return false;
    codes->image = image;
    codes->bits = bits;
    codes->channels = alpha ? 4 : 3;
    for (int c = 0; c < codes->channels; c++) {
        codes->from[c] = image_find(image, names[c]);
        if (!codes->from[c])
            return brume_fail(err, BRUME_ERR_USAGE,
                              "a picture without channel %s", names[c]);
    }
    size_t samples = (size_t)image->width * (size_t)codes->channels;
    codes->size = samples * (size_t)(bits / 8);
    codes->light = memory_new(samples, sizeof *codes->light, err);
    codes->bytes = memory_new(codes->size, 1, err);
    return codes->light && codes->bytes;
}

void codes_release(struct codes *codes)
{
    free(codes->bytes);
    free(codes->light);
}

/* Associated colour to unassociated; nothing is seen where alpha is not. */
static void divide_by_alpha(float pixel[4])
{
    bool seen = pixel[3] > 0;
    for (int c = 0; c < 3; c++)
        pixel[c] = seen ? pixel[c] / pixel[3] : 0;
}

const unsigned char *codes_row(struct codes *codes, int y)
{
    int channels = codes->channels;
    unsigned max = codes->bits == 16 ? 65535 : 255;
    unsigned char *to = codes->bytes;
    for (int c = 0; c < channels; c++)
        image_row(codes->image, codes->from[c], y, codes->light + c,
                  (size_t)channels);
    for (int x = 0; x < codes->image->width; x++) {
        float *pixel = codes->light + (size_t)x * (size_t)channels;
        if (channels == 4)
            divide_by_alpha(pixel);
        for (int c = 0; c < channels; c++) {
            unsigned code = c < 3 ? srgb_code(pixel[c], max)
                                  : srgb_linear_code(pixel[c], max);
            if (codes->bits == 16)
                *to++ = (unsigned char)(code >> 8);
            *to++ = (unsigned char)code;
        }
    }
    return codes->bytes;
}
