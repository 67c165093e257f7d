#include "lib/gif.h"
#include <stdlib.h>
#include <string.h>

#include <gif_lib.h>

#include "lib/memory.h"

static bool fail(const GifFileType *gif, const char *path,
                 struct brume_error *err)
{
    const char *what = gif->Error ? GifErrorString(gif->Error) : NULL;

    return brume_fail_file(err, path, "%s", what ? what : "this is no GIF");
}

/* Goes on to the first picture. */
static bool find_picture(GifFileType *gif)
{
    GifRecordType type = UNDEFINED_RECORD_TYPE;

    while (DGifGetRecordType(gif, &type) == GIF_OK &&
           type != IMAGE_DESC_RECORD_TYPE) {
        int code;
        GifByteType *block;
        if (type != EXTENSION_RECORD_TYPE ||
            DGifGetExtension(gif, &code, &block) != GIF_OK)
            return false;
        while (block)
            if (DGifGetExtensionNext(gif, &block) != GIF_OK)
                return false;
    }
    return type == IMAGE_DESC_RECORD_TYPE && DGifGetImageDesc(gif) == GIF_OK;
}

static bool take_palette(const GifFileType *gif, struct raster *raster)
{
    const ColorMapObject *map = gif->Image.ColorMap ? gif->Image.ColorMap
                                                    : gif->SColorMap;

    if (!map || map->ColorCount < 1 || map->ColorCount > 256)
        return false;
    raster->colors = map->ColorCount;
    for (int i = 0; i < map->ColorCount; i++) {
        raster->palette[i][0] = map->Colors[i].Red;
        raster->palette[i][1] = map->Colors[i].Green;
        raster->palette[i][2] = map->Colors[i].Blue;
    }
    return true;
}

static bool read_row(GifFileType *gif, GifPixelType *row, int y,
                     struct raster *raster)
{
    uint16_t *to = raster->sample + (size_t)y * (size_t)raster->width;

    if (DGifGetLine(gif, row, raster->width) != GIF_OK)
        return false;
    for (int x = 0; x < raster->width; x++)
        to[x] = row[x];
    return true;
}

/* Interlaced rows come in four passes. */
static bool read_rows(GifFileType *gif, GifPixelType *row,
                      struct raster *raster)
{
    static const int first[] = {0, 4, 2, 1}, step[] = {8, 8, 4, 2};
    bool laced = gif->Image.Interlace;

    for (int pass = 0; pass < (laced ? 4 : 1); pass++)
        for (int y = laced ? first[pass] : 0; y < raster->height;
             y += laced ? step[pass] : 1)
            if (!read_row(gif, row, y, raster))
                return false;
    return true;
}

static struct raster *read_picture(GifFileType *gif, const char *path,
                                   struct brume_error *err)
{
    struct raster *raster;
    GifPixelType *row;
    bool fine;

    if (!find_picture(gif)) {
        fail(gif, path, err);
        return NULL;
    }
    raster = raster_new(gif->Image.Width, gif->Image.Height, 1, 255, path, err);
    if (!raster)
        return NULL;
    row = memory_new((size_t)raster->width, sizeof *row, err);
    fine = row && take_palette(gif, raster) && read_rows(gif, row, raster);
    free(row);
    if (fine)
        return raster;
    if (row)
        fail(gif, path, err);
    raster_free(raster);
    return NULL;
}

struct raster *gif_load(const char *path, struct brume_error *err)
{
    int code = 0;
    GifFileType *gif = DGifOpenFileName(path, &code);
    struct raster *raster;

    if (!gif) {
        const char *what = GifErrorString(code);
        brume_fail_file(err, path, "%s", what ? what : "it cannot be opened");
        return NULL;
    }
    raster = read_picture(gif, path, err);
    DGifCloseFile(gif, &code);
    return raster;
}

struct raster *pot_load(const char *path, struct brume_error *err)
{
    struct raster *halves = gif_load(path, err), *raster;

    if (!halves)
        return NULL;
    raster = raster_new(halves->width / 2, halves->height, 1, UINT16_MAX, path,
                        err);
    for (int y = 0; raster && y < raster->height; y++) {
        const uint16_t *high = halves->sample +
                               (size_t)y * (size_t)halves->width;
        const uint16_t *low = high + raster->width;
        uint16_t *to = raster->sample + (size_t)y * (size_t)raster->width;
        for (int x = 0; x < raster->width; x++)
            to[x] = (uint16_t)(high[x] << 8 | low[x]);
    }
    raster_free(halves);
    return raster;
}
