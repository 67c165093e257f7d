#include "lib/image.h"
#include <string.h>

/* More pixels across than any film holds; strides stay within 32 bits. */
enum { MAX_SIDE = 1 << 24 };

bool image_check(const struct image *image, struct brume_error *err)
{
    if (image->width < 1 || image->height < 1 || image->width > MAX_SIDE ||
        image->height > MAX_SIDE)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "a picture of %d x %d pixels can't be written",
                          image->width, image->height);
    if (image->x0 < 0 || image->x0 > image->x1 || image->x1 > image->width ||
        image->y0 < 0 || image->y0 > image->y1 || image->y1 > image->height)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "the region %d..%d x %d..%d is not inside a picture "
                          "of %d x %d pixels",
                          image->x0, image->x1, image->y0, image->y1,
                          image->width, image->height);
    return true;
}

const struct image_channel *image_find(const struct image *image,
                                       const char *name)
{
    for (size_t i = 0; i < image->channels; i++)
        if (strcmp(image->channel[i].name, name) == 0)
            return &image->channel[i];
    return NULL;
}

void image_row(const struct image *image, const struct image_channel *channel,
               int y, float *out, size_t step)
{
    bool inside = y >= image->y0 && y < image->y1;
    const float *from = inside ? channel->base + (y - image->y0) * channel->row
                               : NULL;
    for (int x = 0; x < image->width; x++) {
        bool held = inside && x >= image->x0 && x < image->x1;
        out[(size_t)x * step] = held ? from[(x - image->x0) * channel->stride]
                                     : 0;
    }
}
