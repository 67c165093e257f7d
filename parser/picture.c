#include "parser/picture.h"
#include "lib/memory.h"
#include "lib/png.h"
#include "lib/ppm.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_CHANNELS = 8 };

static void add_channel(struct image *image, struct image_channel *channel,
                        const char *name, const float *base, int stride)
{
    channel[image->channels++] = (struct image_channel){
        name,
        base,
        stride,
        (ptrdiff_t)stride * image->width,
    };
}

static void add_colour(struct image *image, struct image_channel *channel,
                       const char *const name[3], const float *base)
{
    for (int i = 0; i < 3; i++)
        add_channel(image, channel, name[i], base + i, 3);
}

/* One alpha for three opacities: their luminance (Rec.709). */
static float *make_alpha(const struct brume_frame *frame,
                         struct brume_error *err)
{
    size_t pixels = (size_t)frame->width * (size_t)frame->height;
    float *alpha = memory_new(pixels, sizeof *alpha, err);
    for (size_t i = 0; alpha && i < pixels; i++) {
        const float *o = frame->opacity + 3 * i;
        alpha[i] = 0.2126f * o[0] + 0.7152f * o[1] + 0.0722f * o[2];
    }
    return alpha;
}

static bool copy_stream(FILE *from, FILE *to, struct brume_error *err)
{
    char bytes[65536];
    size_t got;
    while ((got = fread(bytes, 1, sizeof bytes, from)) > 0)
        if (fwrite(bytes, 1, got, to) != got)
            return brume_fail(err, BRUME_ERR_FILE,
                              "can't write the picture to "
                              "standard output: %s",
                              strerror(errno));
    return true;
}

/* The EXR writer needs a file in which it can go back. */
static bool write_exr_stream(const struct picture *picture,
                             const struct image *image, FILE *out,
                             struct brume_error *err)
{
    char path[4096];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/brume-XXXXXX",
             folder && *folder ? folder : "/tmp");
    int fd = mkstemp(path);
    if (fd < 0)
        return brume_fail(err, BRUME_ERR_FILE, "can't make the file '%s': %s",
                          path, strerror(errno));
    close(fd);
    bool ok = exr_save(path, image, picture->text, picture->texts,
                       picture->threads, err);
    FILE *from = ok ? fopen(path, "rb") : NULL;
    if (ok && !from)
        ok = brume_fail(err, BRUME_ERR_FILE, "can't open '%s': %s", path,
                        strerror(errno));
    ok = ok && copy_stream(from, out, err);
    if (from)
        fclose(from);
    unlink(path);
    return ok;
}

static bool write_image(const struct picture *p, const struct image *image,
                        const char *path, FILE *out, struct brume_error *err)
{
    static const char name[] = "standard output";
    bool stream = strcmp(path, "-") == 0;
    int bits = p->bits > 8 ? 16 : 8;
    switch (p->format) {
    case OPTIONS_FORMAT_EXR:
        return stream
                   ? write_exr_stream(p, image, out, err)
                   : exr_save(path, image, p->text, p->texts, p->threads, err);
    case OPTIONS_FORMAT_PPM:
        return stream ? ppm_save_stream(out, name, image, bits, err)
                      : ppm_save(path, image, bits, err);
    case OPTIONS_FORMAT_PNG:
        return stream ? png_save_stream(out, name, image, bits, p->alpha, err)
                      : png_save(path, image, bits, p->alpha, err);
    }
    return false;
}

bool picture_write(const struct picture *picture, const char *path, FILE *out,
                   struct brume_error *err)
{
    static const char *const radiance[] = {"R", "G", "B"};
    static const char *const opacity[] = {"opacity.R", "opacity.G",
                                          "opacity.B"};
    const struct brume_frame *frame = picture->frame;
    struct image_channel channel[MAX_CHANNELS];
    struct image image = {
        .width = frame->width,
        .height = frame->height,
        .x1 = frame->width,
        .y1 = frame->height,
        .channel = channel,
    };
    float *alpha = NULL;
    add_colour(&image, channel, radiance, frame->radiance);
    if (picture->alpha) {
        alpha = make_alpha(frame, err);
        if (!alpha)
            return false;
        add_channel(&image, channel, "A", alpha, 1);
    }
    if (picture->format == OPTIONS_FORMAT_EXR) {
        add_colour(&image, channel, opacity, frame->opacity);
        add_channel(&image, channel, "Z", frame->depth, 1);
    }
    bool ok = write_image(picture, &image, path, out, err);
    free(alpha);
    if (ok && strcmp(path, "-") == 0 && fflush(out) != 0)
        ok = brume_fail(err, BRUME_ERR_FILE,
                        "can't write the picture to "
                        "standard output: %s",
                        strerror(errno));
    return ok;
}
