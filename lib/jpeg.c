#include "lib/jpeg.h"
#include <errno.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include "lib/memory.h"

/* What libjpeg comes back to when a file is at fault. */
struct fault {
    struct jpeg_error_mgr manager; /* first: libjpeg knows this alone */
    jmp_buf back;
    const char *path;
    struct brume_error *err;
};

static void on_error(j_common_ptr jpeg)
{
    struct fault *fault = (struct fault *)jpeg->err;
    char text[JMSG_LENGTH_MAX];

    jpeg->err->format_message(jpeg, text);
    brume_fail_file(fault->err, fault->path, "%s", text);
    longjmp(fault->back, 1);
}

/* A warning tells of damage. */
static void on_message(j_common_ptr jpeg, int level)
{
    if (level < 0)
        on_error(jpeg);
}

static void print_nothing(j_common_ptr jpeg)
{
    (void)jpeg;
}

static bool start(struct jpeg_decompress_struct *jpeg, FILE *stream,
                  struct fault *fault)
{
    if (setjmp(fault->back))
        return false;
    jpeg_create_decompress(jpeg);
    jpeg_stdio_src(jpeg, stream);
    jpeg_read_header(jpeg, TRUE);
    jpeg->out_color_space = jpeg->num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(jpeg);
    return true;
}

/* `row` holds one row of bytes. */
static bool read_rows(struct jpeg_decompress_struct *jpeg, JSAMPROW row,
                      struct raster *raster, struct fault *fault)
{
    size_t samples = (size_t)raster->width * (size_t)raster->channels;

    if (setjmp(fault->back))
        return false;
    while (jpeg->output_scanline < jpeg->output_height) {
        uint16_t *to = raster->sample + samples * jpeg->output_scanline;
        jpeg_read_scanlines(jpeg, &row, 1);
        for (size_t i = 0; i < samples; i++)
            to[i] = row[i];
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

static struct raster *read_picture(struct jpeg_decompress_struct *jpeg,
                                   struct fault *fault)
{
    int channels = jpeg->output_components;
    struct raster *raster = raster_new(jpeg->output_width, jpeg->output_height,
                                       channels, 255, fault->path, fault->err);
    unsigned char *row;

    if (!raster)
        return NULL;
    row = memory_new((size_t)raster->width, (size_t)channels, fault->err);
    if (row && read_rows(jpeg, row, raster, fault)) {
        free(row);
        return raster;
    }
    free(row);
    raster_free(raster);
    return NULL;
}

struct raster *jpeg_load(const char *path, struct brume_error *err)
{
    struct jpeg_decompress_struct jpeg = {0};
    struct fault fault = {.path = path, .err = err};
    FILE *stream = fopen(path, "rb");
    struct raster *raster = NULL;

    if (!stream) {
        brume_fail_file(err, path, "%s", strerror(errno));
        return NULL;
    }
    jpeg.err = jpeg_std_error(&fault.manager);
    fault.manager.error_exit = on_error;
    fault.manager.emit_message = on_message;
    fault.manager.output_message = print_nothing;
    if (start(&jpeg, stream, &fault))
        raster = read_picture(&jpeg, &fault);
    jpeg_destroy_decompress(&jpeg);
    fclose(stream);
    return raster;
}
