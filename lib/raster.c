#include "lib/raster.h"
#include <stdlib.h>
#include <string.h>
#include "lib/gif.h"
#include "lib/jpeg.h"
#include "lib/memory.h"
#include "lib/png.h"
#include "lib/pnm.h"
#include "lib/tga.h"

static const struct format {
    const char *word;
    struct raster *(*load)(const char *path, struct brume_error *err);
} formats[] = {{"gif", gif_load}, {"jpeg", jpeg_load}, {"jpg", jpeg_load},
               {"pot", pot_load}, {"png", png_load},   {"pgm", pnm_load},
               {"ppm", pnm_load}, {"tga", tga_load}};

enum { FORMATS = sizeof formats / sizeof *formats };

static const struct format *find(const char *word)
{
    for (int i = 0; i < FORMATS; i++)
        if (strcmp(word, formats[i].word) == 0)
            return &formats[i];
    return NULL;
}

bool raster_reads(const char *format)
{
    return find(format) != NULL;
}

struct raster *raster_load(const char *format, const char *path,
                           struct brume_error *err)
{
    const struct format *found = find(format);
    if (found)
        return found->load(path, err);
    brume_fail_file(err, path, "pictures of format '%s' can't be read", format);
    return NULL;
}

struct raster *raster_new(long long width, long long height, int channels,
                          unsigned max, const char *path,
                          struct brume_error *err)
{
    if (width < 1 || height < 1 || width > (long long)RASTER_MOST / height) {
        brume_fail_file(err, path,
                        "a picture of %lld x %lld pixels can't be read; the "
                        "most is %zu pixels",
                        width, height, RASTER_MOST);
        return NULL;
    }
    struct raster *raster = memory_new(1, sizeof *raster, err);
    if (!raster)
        return NULL;
    raster->width = (int)width;
    raster->height = (int)height;
    raster->channels = channels;
    raster->max = max;
    raster->intent = -1;
    memset(raster->opacity, 255, sizeof raster->opacity);
    raster->sample = memory_new((size_t)(width * height * channels),
                                sizeof *raster->sample, err);
    if (raster->sample)
        return raster;
    free(raster);
    return NULL;
}

void raster_free(struct raster *raster)
{
    if (!raster)
        return;
    free(raster->sample);
    free(raster);
}
