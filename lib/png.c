#include "lib/png.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <png.h>
#include "lib/codes.h"
#include "lib/memory.h"
#include "lib/output.h"

/* Larger pictures come from broken headers. */
enum { MAX_SIDE = 1 << 20 };

/* What libpng's callbacks see; they leave by longjmp, so whatever must be
 * freed lives here or with the caller of setjmp. */
struct session {
    const char *name;
    struct brume_error *err;
};

static void on_error(png_structp png, png_const_charp message)
{
    const struct session *s = png_get_error_ptr(png);
    brume_fail_file(s->err, s->name, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* ---- writing ---- */

static void write_bytes(png_structp png, png_bytep bytes, size_t size)
{
    if (fwrite(bytes, 1, size, png_get_io_ptr(png)) != size)
        png_error(png, strerror(errno));
}

static void flush_bytes(png_structp png)
{
    if (fflush(png_get_io_ptr(png)) != 0)
        png_error(png, strerror(errno));
}

/* False when libpng left by its error callback. */
static bool write_picture(png_structp png, png_infop info, FILE *stream,
                          struct codes *codes)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    const struct image *image = codes->image;
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_write_fn(png, stream, write_bytes, flush_bytes);
    png_set_IHDR(png, info, (png_uint_32)image->width,
                 (png_uint_32)image->height, codes->bits,
                 codes->channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA
                                      : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, codes_row(codes, y));
    png_write_end(png, NULL);
    flush_bytes(png);
    return true;
}

bool png_save_stream(FILE *stream, const char *name, const struct image *image,
                     int bits, bool alpha, struct brume_error *err)
{
    struct codes codes;
    bool ok = codes_init(&codes, image, bits, alpha, err);
    if (ok) {
        struct session s = {name, err};
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &s,
                                                  on_error, on_warning);
        png_infop info = png ? png_create_info_struct(png) : NULL;
        ok = info ? write_picture(png, info, stream, &codes)
                  : brume_fail(err, BRUME_ERR_MEMORY, "no memory for a PNG");
        png_destroy_write_struct(&png, &info);
    }
    codes_release(&codes);
    return ok;
}

bool png_save(const char *path, const struct image *image, int bits, bool alpha,
              struct brume_error *err)
{
    struct output *o = output_open(path, err);
    return o && output_close(o,
                             png_save_stream(output_stream(o), path, image,
                                             bits, alpha, err),
                             err);
}

/* ---- reading ---- */

static void read_bytes(png_structp png, png_bytep bytes, size_t size)
{
    FILE *stream = png_get_io_ptr(png);
    if (fread(bytes, 1, size, stream) != size)
        png_error(png,
                  ferror(stream) ? strerror(errno) : "the file ends too early");
}

/* What the header says of a picture. */
struct header {
    png_uint_32 width, height;
    int channels, bits, intent;
    double gamma;
};

static bool read_info(png_structp png, png_infop info, FILE *stream,
                      struct header *header)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_user_limits(png, MAX_SIDE, MAX_SIDE);
    png_set_read_fn(png, stream, read_bytes);
    png_read_info(png, info);
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE)
        png_set_packing(png);
    else
        png_set_expand(png);
    png_set_interlace_handling(png);
    if (!png_get_sRGB(png, info, &header->intent))
        header->intent = -1;
    if (header->intent >= 0 || !png_get_gAMA(png, info, &header->gamma))
        header->gamma = 0;
    png_read_update_info(png, info);
    header->width = png_get_image_width(png, info);
    header->height = png_get_image_height(png, info);
    header->channels = png_get_channels(png, info);
    header->bits = png_get_bit_depth(png, info);
    return true;
}

static void take_palette(png_structp png, png_infop info, struct raster *raster)
{
    png_colorp color;
    png_bytep opacity;
    int opacities = 0;
    if (png_get_color_type(png, info) != PNG_COLOR_TYPE_PALETTE ||
        !png_get_PLTE(png, info, &color, &raster->colors))
        return;
    png_get_tRNS(png, info, &opacity, &opacities, NULL);
    for (int i = 0; i < raster->colors; i++) {
        raster->opacity[i] = i < opacities ? opacity[i] : 255;
        raster->palette[i][0] = color[i].red;
        raster->palette[i][1] = color[i].green;
        raster->palette[i][2] = color[i].blue;
    }
}

static bool read_rows(png_structp png, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_read_image(png, rows);
    png_read_end(png, NULL);
    return true;
}

/* Rows of bytes to rows of codes. */
static void widen(struct raster *raster, const unsigned char *bytes)
{
    size_t samples = (size_t)raster->width * (size_t)raster->height *
                     (size_t)raster->channels;
    for (size_t i = 0; i < samples; i++)
        raster->sample[i] = raster->max > 255 ? (uint16_t)(bytes[2 * i] << 8 |
                                                           bytes[2 * i + 1])
                                              : bytes[i];
}

static bool read_picture(png_structp png, png_infop info, struct raster *raster,
                         struct brume_error *err)
{
    size_t height = (size_t)raster->height;
    size_t row = png_get_rowbytes(png, info);
    unsigned char *bytes = memory_new(height, row, err);
    png_bytepp rows = memory_new(height, sizeof *rows, err);
    bool ok = bytes && rows;
    for (size_t y = 0; ok && y < height; y++)
        rows[y] = bytes + y * row;
    ok = ok && read_rows(png, rows);
    if (ok)
        widen(raster, bytes);
    free(rows);
    free(bytes);
    return ok;
}

static struct raster *read_raster(png_structp png, png_infop info,
                                  const struct header *header,
                                  const struct session *s)
{
    struct raster *raster = raster_new(
        header->width, header->height, header->channels,
        header->bits == 16 ? UINT16_MAX : 255, s->name, s->err);
    if (!raster)
        return NULL;
    raster->intent = header->intent;
    raster->gamma = header->gamma;
    take_palette(png, info, raster);
    if (read_picture(png, info, raster, s->err))
        return raster;
    raster_free(raster);
    return NULL;
}

static struct raster *load(FILE *stream, struct session *s)
{
    struct raster *raster = NULL;
    struct header header;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, s, on_error,
                                             on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info)
        brume_fail(s->err, BRUME_ERR_MEMORY, "no memory for a PNG");
    else if (read_info(png, info, stream, &header))
        raster = read_raster(png, info, &header, s);
    png_destroy_read_struct(&png, &info, NULL);
    return raster;
}

struct raster *png_load(const char *path, struct brume_error *err)
{
    struct session s = {path, err};
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        brume_fail_file(err, path, "%s", strerror(errno));
        return NULL;
    }
    struct raster *raster = load(stream, &s);
    fclose(stream);
    return raster;
}
