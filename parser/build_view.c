/* build_view.c - camera, light_source and background. */
#include <string.h>

#include "parser/builder.h"

/* ---- camera ------------------------------------------------------------ */

enum { CAMERA_UP = 1, CAMERA_RIGHT = 2, CAMERA_LOOK_AT = 4 };

#define CAMERA_VECTOR(word_, x, y, z, bit)                                     \
    {                                                                          \
        .word = #word_, .kind = PARAM_VECTOR, .start = {x, y, z},              \
        .low = -INFINITY, .high = INFINITY, .alone = NAN, .given = bit,        \
        .offset = offsetof(struct camera, word_)                               \
    }

const struct param build_camera_params[] = {
    PARAM_WORD("perspective", PARAM_MARK, BRUME_CAMERA_PERSPECTIVE, 0,
               struct camera, kind),
    PARAM_WORD("orthographic", PARAM_MARK, BRUME_CAMERA_ORTHOGRAPHIC, 0,
               struct camera, kind),
    CAMERA_VECTOR(location, 0, 0, 0, 0),
    CAMERA_VECTOR(direction, 0, 0, 1, 0),
    CAMERA_VECTOR(up, 0, 1, 0, CAMERA_UP),
    CAMERA_VECTOR(right, 1.33, 0, 0, CAMERA_RIGHT),
    CAMERA_VECTOR(sky, 0, 1, 0, 0),
    CAMERA_VECTOR(look_at, 0, 0, 1, CAMERA_LOOK_AT),
    PARAM_ROW("angle", PARAM_FLOAT, 0, 0, 180, PARAM_BELOW, 0, struct camera,
              angle),
    {0}};

static void open_camera(struct parser *parser, struct frame *frame)
{
    struct camera *camera = frame->node;

    (void)parser;
    param_defaults(build_camera_params, camera);
    camera->kind = BRUME_CAMERA_PERSPECTIVE;
    camera->by = transform_identity();
    camera->at = frame->at;
}

static void apply_camera(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    struct camera *camera = frame->node;

    if (value->kind != VALUE_CAMERA) {
        build_misplaced(parser, frame, value, at);
        return;
    }
    *camera = *(const struct camera *)value->node;
    camera->at = frame->at;
}

static void move_camera(struct parser *parser, struct frame *frame,
                        const transform *by)
{
    struct camera *camera = frame->node;

    (void)parser;
    camera->by = transform_then(&camera->by, by);
}

static void close_camera(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct camera *camera = frame->node;
    struct brume_camera seen;

    (void)at;
    camera->has_up |= (frame->given & CAMERA_UP) != 0;
    camera->has_right |= (frame->given & CAMERA_RIGHT) != 0;
    camera->has_look_at |= (frame->given & CAMERA_LOOK_AT) != 0;
    switch (model_camera(camera, &seen)) {
    case CAMERA_LOOKS_AT_ITSELF:
        parser_error(parser, frame->at,
                     "the camera's location and look_at are the same point");
        break;
    case CAMERA_SKY_AHEAD:
        parser_warn(parser, frame->at,
                    "the camera looks along its sky "
                    "vector: right stays as it is");
        break;
    case CAMERA_FINE:
        break;
    }
}

const struct statement build_statement_camera = {
    .word = "camera",
    .makes = VALUE_CAMERA,
    .takes = BUILD_TAKES(VALUE_CAMERA),
    .size = sizeof(struct camera),
    .params = build_camera_params,
    .open = open_camera,
    .apply = apply_camera,
    .move = move_camera,
    .close = close_camera,
};

/* ---- light_source ------------------------------------------------------ */

enum { LIGHT_SPOT_ONLY = 1 };

#define LIGHT(word, start, low, high, bit)                                     \
    PARAM_ROW(#word, PARAM_FLOAT, start, low, high, 0, bit, struct object,     \
              light.word)

const struct param build_light_params[] = {
    PARAM_WORD("spotlight", PARAM_MARK, BRUME_LIGHT_SPOT, 0, struct object,
               light.kind),
    {.word = "point_at",
     .kind = PARAM_VECTOR,
     .start = {0, 0, 1},
     .low = -INFINITY,
     .high = INFINITY,
     .alone = NAN,
     .given = LIGHT_SPOT_ONLY,
     .offset = offsetof(struct object, light.point_at)},
    LIGHT(radius, 30, -90, 90, LIGHT_SPOT_ONLY),
    LIGHT(falloff, 45, -90, 90, LIGHT_SPOT_ONLY),
    LIGHT(tightness, 0, 0, INFINITY, LIGHT_SPOT_ONLY),
    LIGHT(fade_distance, 0, 0, INFINITY, 0),
    LIGHT(fade_power, 0, 0, INFINITY, 0),
    PARAM_WORD("shadowless", PARAM_CLEAR, 0, 0, struct object, light.shadows),
    PARAM_ANY("media_interaction", PARAM_SWITCH, 1, 0, struct object,
              light.media_interaction),
    PARAM_ANY("media_attenuation", PARAM_SWITCH, 0, 0, struct object,
              light.media_attenuation),
    {0}};

static const struct param light_arguments[] = {
    PARAM_ANY("location", PARAM_VECTOR, 0, 0, struct object, light.location),
    PARAM_ANY("color", PARAM_RGB, 1, 0, struct object, light.color),
    {0}};

static void open_light(struct parser *parser, struct frame *frame)
{
    static const struct brume_light start = BRUME_LIGHT_INIT;
    struct object *light = build_object_start(
        frame, OBJECT_LIGHT, BRUME_SHAPE_SPHERE, "light_source");

    (void)parser;
    light->light = start;
    param_defaults(build_light_params, light);
}

/* A declared light needs no numbers of its own. */
static void apply_light(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *light = frame->node;

    if (value->kind != VALUE_LIGHT) {
        build_misplaced(parser, frame, value, at);
        return;
    }
    *light = *(const struct object *)value->node;
    light->at = frame->at;
    frame->arguments = 2;
}

static void close_light(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct object *light = frame->node;

    (void)at;
    if (light->light.kind != BRUME_LIGHT_SPOT && frame->given & LIGHT_SPOT_ONLY)
        parser_warn(parser, frame->at,
                    "point_at, radius, falloff and "
                    "tightness have no effect without 'spotlight'");
}

const struct statement build_statement_light = {
    .word = "light_source",
    .makes = VALUE_LIGHT,
    .takes = BUILD_TAKES(VALUE_LIGHT),
    .size = sizeof(struct object),
    .params = build_light_params,
    .arguments = light_arguments,
    .needed = 2,
    .open = open_light,
    .apply = apply_light,
    .move = build_object_move,
    .close = close_light,
};

/* ---- background -------------------------------------------------------- */

static const struct param background_arguments[] = {
    PARAM_ANY("color", PARAM_RGB, 0, 0, struct globals, background), {0}};

static void open_background(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->globals;
}

const struct statement build_statement_background = {
    .word = "background",
    .arguments = background_arguments,
    .needed = 1,
    .open = open_background,
};
