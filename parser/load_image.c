/* load_image.c - pictures of pigments and patterns to core, as linear light. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/radiance.h"
#include "lib/raster.h"
#include "lib/srgb.h"
#include "parser/builder.h"
#include "parser/formula.h"

enum { WORD_ROOM = 8, TERMS = 5, SRGB = -1 };

/* Uses of one file are one picture of core, unless they change its colours. */
struct loaded_image {
    struct loaded_image *next;
    const char *path;
    const struct image *as; /* the one that it was loaded for          */
    enum pattern_kind kind;
};

/* ---- the file ---------------------------------------------------------- */

/* The ending of a file's name, small; empty: there is none so short. */
static void ending_of(struct string name, char word[WORD_ROOM])
{
    const char *dot = strrchr(name.text, '.');
    size_t n = 0;

    if (dot && strlen(dot + 1) < WORD_ROOM)
        for (; dot[n + 1]; n++)
            word[n] = (char)tolower((unsigned char)dot[n + 1]);
    word[n] = '\0';
}

struct raster *load_raster(struct parser *parser, const char *format,
                           struct string name, struct location at)
{
    struct brume_error err = {0};
    char ending[WORD_ROOM];
    const char *path;
    struct raster *raster;

    ending_of(name, ending);
    if (!format)
        format = ending;
    if (!raster_reads(format)) {
        parser_mistake(parser, at,
                       "pictures of format '%s' are not supported yet; gif, "
                       "jpeg, pgm, png, pot, ppm and tga are",
                       format);
        return NULL;
    }
    if (!build_has_file(parser, name, at))
        return NULL;
    path = parser_find_file(parser, at, name, PARSER_DATA);
    raster = path ? raster_load(format, path, &err) : NULL;
    if (path && !raster)
        parser_relay(parser, at, &err);
    return raster;
}

/* ---- its colours ------------------------------------------------------- */

/* What a code or a colour of the palette stands for. */
struct decoder {
    const struct raster *raster;
    bool premultiplied;
    int channels;
    float *light; /* of each code                            */
    float palette[256][TERMS];
};

static double decode(double gamma, double code)
{
    return gamma == SRGB ? srgb_decode(code) : pow(code, gamma);
}

/* As the scene says; else as the file does; else sRGB. Patterns take codes as
 * they are. */
static double gamma_of(const struct pattern *pattern,
                       const struct raster *raster)
{
    if (pattern->image->gamma != 0)
        return pattern->image->gamma;
    if (pattern->kind != PATTERN_IMAGE_MAP)
        return 1;
    return raster->gamma > 0 ? 1 / raster->gamma : SRGB;
}

/* `filter 3, 0.5`: of one colour, or of all. */
static void color_palette(float palette[256][TERMS],
                          const struct image_palette *entry)
{
    int term = entry->transmit ? 4 : 3;

    for (int i = 0; i < 256; i++)
        if (entry->index < 0 || entry->index == i)
            palette[i][term] = (float)entry->amount;
}

/* In the order in which they were said, which the list has reversed. */
static bool change_palette(struct parser *parser, const struct image *image,
                           struct decoder *to)
{
    const struct image_palette *last = NULL;

    while (last != image->palette) {
        const struct image_palette *entry = image->palette;
        while (entry->next != last)
            entry = entry->next;
        if (to->raster->colors == 0 && entry->index >= 0)
            return parser_mistake(parser, image->at,
                                  "this picture has no palette: its colors "
                                  "have no numbers");
        color_palette(to->palette, entry);
        last = entry;
    }
    return true;
}

static bool has_term(const struct decoder *d, int term)
{
    for (int i = 0; i < d->raster->colors; i++)
        if (d->palette[i][term] != 0)
            return true;
    return false;
}

static void fill_palette(struct decoder *d)
{
    const struct raster *raster = d->raster;

    for (int i = 0; i < raster->colors; i++) {
        for (int k = 0; k < 3; k++)
            d->palette[i][k] = d->light[raster->palette[i][k]];
        d->palette[i][4] = 1 - (float)raster->opacity[i] / 255;
    }
}

static bool start_decoder(struct parser *parser, const struct image *image,
                          double gamma, struct decoder *d,
                          struct brume_error *err)
{
    unsigned max = d->raster->max;

    d->premultiplied = image->has_premultiplied && image->premultiplied;
    d->light = memory_new((size_t)max + 1, sizeof *d->light, err);
    for (unsigned i = 0; d->light && i <= max; i++)
        d->light[i] = (float)decode(gamma, i / (double)max);
    if (!d->light)
        return parser_relay(parser, image->at, err);
    d->channels = d->raster->channels;
    if (d->raster->colors == 0)
        return true;
    fill_palette(d);
    if (!change_palette(parser, image, d))
        return false;
    d->channels = has_term(d, 3) ? 5 : has_term(d, 4) ? 4 : 3;
    return true;
}

/* Codes beyond the greatest count as that. */
static void decode_texel(const struct decoder *d, const uint16_t *sample,
                         float *out)
{
    int colors = d->channels < 3 ? 1 : 3;
    unsigned max = d->raster->max;
    float alpha = 1;

    if (d->raster->colors > 0) {
        const float *color = d->palette[sample[0] & 255];
        memcpy(out, color, 3 * sizeof *out);
        if (d->channels == 5)
            out[3] = color[3];
        if (d->channels > 3)
            out[d->channels - 1] = color[4];
        return;
    }
    if (d->channels > colors)
        alpha = (float)sample[colors] / (float)max;
    for (int k = 0; k < colors; k++) {
        out[k] = d->light[sample[k] < max ? sample[k] : max];
        if (d->premultiplied && alpha > 0)
            out[k] /= alpha;
    }
    if (d->channels > colors)
        out[colors] = 1 - alpha;
}

static int send_texels(struct parser *parser, const struct image *image,
                       int width, int height, int channels, const float *texel)
{
    const struct brume_image to = {width, height, channels, texel};
    struct brume_error err = {0};
    int id = brume_add_image(parser->out->scene, &to, &err);

    if (id < 0)
        parser_relay(parser, image->at, &err);
    return id;
}

static int send_raster(struct parser *parser, const struct image *image,
                       const struct raster *raster, struct decoder *d)
{
    size_t pixels = (size_t)raster->width * (size_t)raster->height;
    struct brume_error err = {0};
    float *texel = memory_new(pixels * (size_t)d->channels, sizeof *texel,
                              &err);
    int id = -1;

    for (size_t i = 0; texel && i < pixels; i++)
        decode_texel(d, raster->sample + i * (size_t)raster->channels,
                     texel + i * (size_t)d->channels);
    if (texel)
        id = send_texels(parser, image, raster->width, raster->height,
                         d->channels, texel);
    else
        parser_relay(parser, image->at, &err);
    free(texel);
    return id;
}

/* ---- pictures that are known ------------------------------------------- */

static struct loaded_image *find_image(struct parser *parser, const char *path,
                                       const struct image *image,
                                       enum pattern_kind kind)
{
    struct loaded_image *known = parser->builder->loader.images;

    for (; known; known = known->next)
        if (!strcmp(known->path, path) && known->kind == kind &&
            known->as->gamma == image->gamma &&
            known->as->palette == image->palette &&
            known->as->has_premultiplied == image->has_premultiplied &&
            known->as->premultiplied == image->premultiplied)
            return known;
    return NULL;
}

static void keep_image(struct parser *parser, const char *path,
                       const struct image *image, enum pattern_kind kind)
{
    struct loaded_image *entry = parser_alloc(parser, sizeof *entry);

    if (!entry)
        return;
    *entry = (struct loaded_image){parser->builder->loader.images, path, image,
                                   kind};
    parser->builder->loader.images = entry;
}

/* ---- of all kinds ------------------------------------------------------ */

static int raster_image(struct parser *parser, struct image *image,
                        const struct pattern *pattern)
{
    struct decoder d = {
        .raster = load_raster(parser, image->format, image->name, image->at)};
    struct brume_error err = {0};
    int id = -1;

    if (!d.raster)
        return -1;
    if (start_decoder(parser, image, gamma_of(pattern, d.raster), &d, &err)) {
        id = send_raster(parser, image, d.raster, &d);
        image->clear = d.channels == 2 || d.channels > 3;
        image->indexed = d.raster->colors > 0;
    }
    free(d.light);
    raster_free((struct raster *)d.raster);
    return id;
}

/* Light as it is; colours are divided by their alpha. */
static int radiance_image(struct parser *parser, struct image *image,
                          const char *path)
{
    struct brume_error err = {0};
    struct radiance *picture = radiance_load(path, &err);
    int id = -1;

    if (!picture) {
        parser_relay(parser, image->at, &err);
        return -1;
    }
    size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < pixels; i++) {
        float *texel = picture->sample + 4 * i, alpha = texel[3];
        for (int k = 0; k < 3; k++)
            texel[k] = isfinite(texel[k] / alpha) ? texel[k] / alpha : 0;
        texel[3] = isfinite(alpha) ? 1 - alpha : 0;
    }
    id = send_texels(parser, image, picture->width, picture->height, 4,
                     picture->sample);
    image->clear = true;
    radiance_free(picture);
    return id;
}

bool load_cell(struct parser *parser, const struct function *function,
               int column, int row, double out[BRUME_MAX_RESULTS],
               struct location at)
{
    const double p[3] = {column / (double)function->columns,
                         row / (double)function->rows, 0};
    struct brume_error err = {0};

    return brume_eval_function(parser->out->scene, function->id, p,
                               function->parameters, out, &err) ||
           parser_relay(parser, at, &err);
}

static int function_image(struct parser *parser, struct image *image)
{
    const struct function *function = image->function;
    size_t columns = (size_t)function->columns, rows = (size_t)function->rows;
    int channels = function->results == 5 ? 5 : 1, id = -1;
    struct brume_error err = {0};
    float *texel, *to;
    bool fine = true;

    texel = to = memory_new(columns * rows * (size_t)channels, sizeof *texel,
                            &err);
    if (!texel) {
        parser_relay(parser, image->at, &err);
        return -1;
    }
    for (size_t i = 0; fine && i < columns * rows; i++, to += channels) {
        double out[BRUME_MAX_RESULTS];
        fine = load_cell(parser, function, (int)(i % columns),
                         (int)(i / columns), out, image->at);
        for (int k = 0; fine && k < channels; k++)
            to[k] = isfinite(out[k]) ? (float)out[k] : 0;
    }
    if (fine)
        id = send_texels(parser, image, (int)columns, (int)rows, channels,
                         texel);
    image->clear = channels == 5;
    free(texel);
    return id;
}

static bool is_radiance(const struct image *image)
{
    char ending[WORD_ROOM];

    ending_of(image->name, ending);
    return !strcmp(image->format ? image->format : ending, "exr");
}

static bool is_readable(struct parser *parser, const struct image *image)
{
    char ending[WORD_ROOM];
    const char *format = image->format ? image->format : ending;

    ending_of(image->name, ending);
    if (raster_reads(format) || is_radiance(image))
        return true;
    parser_warn(parser, image->at,
                "pictures of format '%s' are not read yet: a mean stands for "
                "this one",
                format);
    return false;
}

static int file_image(struct parser *parser, struct image *image,
                      const struct pattern *pattern)
{
    const char *path;
    struct loaded_image *known;
    int id;

    if (!is_readable(parser, image) ||
        !build_has_file(parser, image->name, image->at))
        return -1;
    path = parser_find_file(parser, image->at, image->name, PARSER_DATA);
    known = path ? find_image(parser, path, image, pattern->kind) : NULL;
    if (known) {
        image->clear = known->as->clear;
        image->indexed = known->as->indexed;
        return known->as->id - 1;
    }
    if (!path)
        return -1;
    id = is_radiance(image) ? radiance_image(parser, image, path)
                            : raster_image(parser, image, pattern);
    if (id >= 0)
        keep_image(parser, path, image, pattern->kind);
    return id;
}

/* What `filter all` and `transmit all` add where there is no palette. */
static void add_all(const struct image *image, struct brume_image_use *use)
{
    for (const struct image_palette *e = image->palette; e; e = e->next) {
        double *to = e->transmit ? &use->transmit : &use->filter;
        if (e->index < 0 && *to == 0)
            *to = e->amount;
    }
}

bool load_image(struct parser *parser, const struct pattern *pattern,
                struct brume_image_use *use)
{
    struct image *image = (struct image *)pattern->image;

    if (image->id == 0) {
        int id = image->function ? function_image(parser, image)
                                 : file_image(parser, image, pattern);
        image->id = id < 0 ? -1 : id + 1;
    }
    if (image->id < 0)
        return false;
    *use = (struct brume_image_use){
        .image = image->id - 1,
        .map = (enum brume_image_map)image->map_type,
        .once = image->once,
        .interpolate = image->interpolate > 1
                           ? (enum brume_image_interpolate)image->interpolate
                           : BRUME_IMAGE_NEAREST};
    if (!image->indexed)
        add_all(image, use);
    return true;
}
