/* build_sky.c - sky_sphere: what rays see that meet nothing.
 *
 * Core gets it as a function of the direction: the layers over the
 * background. A picture that goes once around the sky is handed over as it
 * is. */
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/radiance.h"
#include "parser/builder.h"

enum { SKY_LAYERS = 8 };

static void open_sky(struct parser *parser, struct frame *frame)
{
    struct sky_sphere *sky = frame->node;

    (void)parser;
    sky->by = transform_identity();
    for (int i = 0; i < 3; i++)
        sky->emission[i] = 1;
}

static void apply_sky(struct parser *parser, struct frame *frame,
                      const struct value *value, struct location at)
{
    struct sky_sphere *sky = frame->node;
    struct pigment *kept;

    if (value->kind == VALUE_SKY_SPHERE) {
        *sky = *(const struct sky_sphere *)value->node;
        return;
    }
    if (sky->pigments == SKY_LAYERS) {
        parser_mistake(parser, at, "a sky_sphere has at most %d pigments",
                       SKY_LAYERS);
        return;
    }
    kept = parser_alloc(parser, sizeof *kept);
    if (!kept)
        return;
    *kept = *(const struct pigment *)value->node;
    sky->pigment[sky->pigments++] = kept;
}

static void move_sky(struct parser *parser, struct frame *frame,
                     const transform *by)
{
    struct sky_sphere *sky = frame->node;

    (void)parser;
    sky->by = transform_then(&sky->by, by);
}

static const struct param sky_params[] = {
    PARAM_ANY("emission", PARAM_RGB, 1, 0, struct sky_sphere, emission), {0}};

const struct statement build_statement_sky_sphere = {
    .word = "sky_sphere",
    .makes = VALUE_SKY_SPHERE,
    .takes = BUILD_TAKES(VALUE_SKY_SPHERE) | BUILD_TAKES(VALUE_PIGMENT),
    .size = sizeof(struct sky_sphere),
    .params = sky_params,
    .open = open_sky,
    .apply = apply_sky,
    .move = move_sky,
};

/* ---- layers ------------------------------------------------------------ */

/* What has been written so far. */
struct sky_writer {
    struct brume_function *to;
    struct brume_error *err;
};

enum { SKY_BELOW = 0, SKY_COLOR = 3, SKY_FILTER = 6, SKY_TRANSMIT = 7 };

static bool take(struct sky_writer *w, int index)
{
    return brume_function_parameter(w->to, index, w->err);
}

static bool number(struct sky_writer *w, double value)
{
    return brume_function_constant(w->to, value, w->err);
}

static bool apply(struct sky_writer *w, enum brume_op op)
{
    return brume_function_op(w->to, op, w->err);
}

/* emission (1 - filter - transmit) color + (filter color + transmit) below. */
static void write_channel(struct sky_writer *w, int c, double emission)
{
    number(w, 1);
    take(w, SKY_FILTER);
    apply(w, BRUME_OP_SUBTRACT);
    take(w, SKY_TRANSMIT);
    apply(w, BRUME_OP_SUBTRACT);
    take(w, SKY_COLOR + c);
    apply(w, BRUME_OP_MULTIPLY);
    number(w, emission);
    apply(w, BRUME_OP_MULTIPLY);
    take(w, SKY_FILTER);
    take(w, SKY_COLOR + c);
    apply(w, BRUME_OP_MULTIPLY);
    take(w, SKY_TRANSMIT);
    apply(w, BRUME_OP_ADD);
    take(w, SKY_BELOW + c);
    apply(w, BRUME_OP_MULTIPLY);
    apply(w, BRUME_OP_ADD);
}

/* The function of what is below a layer and of its color. */
static int layer_function(brume_scene *scene, const struct sky_sphere *sky,
                          struct brume_error *err)
{
    struct sky_writer w = {brume_function_new(scene, 8, err), err};

    if (!w.to)
        return -1;
    for (int c = 0; c < 3; c++)
        write_channel(&w, c, sky->emission[c]);
    return brume_add_function(scene, w.to, err);
}

/* The color of a layer at the parameters; the mean of one that core cannot
 * do. */
static bool write_pigment(struct parser *parser, struct sky_writer *w,
                          const struct sky_sphere *sky,
                          const struct pigment *pigment)
{
    int id = build_pigment_function(parser, pigment);

    if (id >= 0)
        return take(w, 0) && take(w, 1) && take(w, 2) &&
               brume_function_inverse(w->to, sky->by.m, w->err) &&
               brume_function_call(w->to, id, 3, w->err);
    build_lacks(parser, "some patterns of the sky_sphere",
                (struct location){0, UINT32_MAX});
    for (int i = 0; i < 5; i++)
        number(w, pigment->color[i]);
    return true;
}

static int sky_function(struct parser *parser, const struct sky_sphere *sky,
                        struct brume_error *err)
{
    const double *background = parser->builder->globals.background;
    brume_scene *scene = parser->out->scene;
    int layer = layer_function(scene, sky, err);
    struct sky_writer w = {NULL, err};

    if (layer < 0)
        return -1;
    w.to = brume_function_new(scene, 3, err);
    if (!w.to)
        return -1;
    for (int c = 0; c < 3; c++)
        number(&w, background[c]);
    for (int i = 0; i < sky->pigments; i++) {
        write_pigment(parser, &w, sky, sky->pigment[i]);
        brume_function_call(w.to, layer, 8, err);
    }
    return brume_add_function(scene, w.to, err);
}

/* ---- a picture around the sky ------------------------------------------ */

/* Of the way in which brume_sky lays out a map: its space to that of
 * map_type 1, where the left edge is at +x and columns go on to +z. */
static const transform from_map = {
    {{0, 0, -1, 0}, {0, 1, 0, 0}, {-1, 0, 0, 0}}};

/* The one picture that is all of the sky, or NULL. */
static const struct image *sky_picture(const struct sky_sphere *sky)
{
    const struct pigment *pigment = sky->pigment[0];
    const struct pattern *pattern = pigment->on.pattern;
    const struct image *image;

    if (sky->pigments != 1 || !pattern || pattern->kind != PATTERN_IMAGE_MAP ||
        !surface_is_plain(pattern))
        return NULL;
    image = pattern->image;
    return image->map_type == 1 && image->format && !image->palette &&
                   !strcmp(image->format, "exr")
               ? image
               : NULL;
}

/* Its light, over the background. */
static float *sky_texels(const struct radiance *picture,
                         const struct sky_sphere *sky,
                         const double background[3], struct brume_error *err)
{
    size_t n = (size_t)picture->width * (size_t)picture->height;
    float *texel = memory_new(3 * n, sizeof *texel, err);

    for (size_t i = 0; texel && i < 3 * n; i++) {
        const float *from = picture->sample + i / 3 * 4;
        double own = sky->emission[i % 3] * (double)from[i % 3];
        texel[i] = (float)(own + (1 - (double)from[3]) * background[i % 3]);
    }
    return texel;
}

static bool set_picture(struct parser *parser, const struct sky_sphere *sky,
                        const struct radiance *picture, bool interpolate,
                        struct brume_error *err)
{
    struct brume_sky to = BRUME_SKY_INIT;
    transform by = transform_then(&from_map, &sky->pigment[0]->on.by);
    float *texel = sky_texels(picture, sky, parser->builder->globals.background,
                              err);
    bool good;

    if (!texel)
        return false;
    by = transform_then(&by, &sky->by);
    memcpy(to.transform, by.m, sizeof to.transform);
    to.width = picture->width;
    to.height = picture->height;
    to.radiance = texel;
    to.interpolate = interpolate;
    good = brume_set_sky(parser->out->scene, &to, err);
    free(texel);
    return good;
}

static bool send_picture(struct parser *parser, const struct sky_sphere *sky,
                         const struct image *image, struct brume_error *err)
{
    const char *path;
    struct radiance *picture;
    bool good;

    if (!build_has_file(parser, image->name, image->at))
        return true;
    path = parser_find_file(parser, image->at, image->name, PARSER_DATA);
    picture = path ? radiance_load(path, err) : NULL;
    if (!picture)
        return false;
    good = set_picture(parser, sky, picture, image->interpolate != 0, err);
    radiance_free(picture);
    return good;
}

/* ---- the end of the scene ---------------------------------------------- */

bool build_finish_sky(struct parser *parser, struct brume_error *err)
{
    const struct sky_sphere *sky = parser->builder->sky;
    struct brume_sky to = BRUME_SKY_INIT;

    if (!sky || sky->pigments == 0)
        return true;
    if (sky_picture(sky))
        return send_picture(parser, sky, sky_picture(sky), err);
    to.function = sky_function(parser, sky, err);
    return to.function >= 0 && brume_set_sky(parser->out->scene, &to, err);
}
