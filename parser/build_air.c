/* build_air.c - what is around a scene: background, fog and rainbow. */
#include <string.h>

#include "parser/builder.h"

/* ---- background -------------------------------------------------------- */

enum { BACKGROUND_EXR, BACKGROUND_LAYER };
enum { BACKGROUND_LAYERED = 1, BACKGROUND_DEPTH = 2 };

static const char *const depth_words[] = {"axis", "ray", "none", NULL};

static const struct param background_arguments[] = {
    PARAM_ANY("color", PARAM_RGB, 0, 0, struct globals, background), {0}};

static void open_background(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->globals;
}

static const struct param background_params[] = {
    PARAM_OWN("exr", 1, 1, BACKGROUND_EXR),
    PARAM_OWN("layer", 1, 1, BACKGROUND_LAYER),
    PARAM_WORDS("depth", depth_words, BACKGROUND_DEPTH, struct globals,
                plate.depth),
    {0}};

/* A plate has nothing of what was said of the one that it replaces. */
static void name_plate(struct parser *parser, struct frame *frame,
                       struct string name)
{
    struct background_plate *plate = &parser->builder->globals.plate;

    plate->name = name;
    plate->at = parser->builder->value_at;
    if (!(frame->given & BACKGROUND_LAYERED))
        plate->layer = (struct string){0};
    if (!(frame->given & BACKGROUND_DEPTH))
        plate->depth = 0;
    frame->arguments = 1;
}

static void background_values(struct parser *parser, struct frame *frame,
                              const struct param *row,
                              const struct value *value, int count,
                              struct location at)
{
    (void)count;
    if (value->kind != VALUE_STRING) {
        parser_mistake(parser, at, "'%s' needs the name of a %s", row->word,
                       row->id == BACKGROUND_EXR ? "file" : "layer");
        frame->arguments = 1;
    } else if (row->id == BACKGROUND_EXR) {
        name_plate(parser, frame, value->string);
    } else {
        parser->builder->globals.plate.layer = value->string;
        frame->given |= BACKGROUND_LAYERED;
    }
}

const struct statement build_statement_background = {
    .word = "background",
    .params = background_params,
    .values = background_values,
    .arguments = background_arguments,
    .needed = 1,
    .open = open_background,
};

/* ---- fog --------------------------------------------------------------- */

#define FOG(word, kind, start, member)                                         \
    PARAM_ANY(word, kind, start, 0, struct fog, member)

static const struct param fog_params[] = {
    PARAM_ROW("fog_type", PARAM_INTEGER, 1, 1, 2, 0, 0, struct fog, type),
    PARAM_ROW("distance", PARAM_FLOAT, 0, 0, INFINITY, 0, 0, struct fog,
              distance),
    FOG("turbulence", PARAM_VECTOR, 0, turbulence),
    FOG("turb_depth", PARAM_FLOAT, 0.5, turb_depth),
    FOG("omega", PARAM_FLOAT, 0.5, omega),
    FOG("lambda", PARAM_FLOAT, 2, lambda),
    PARAM_ROW("octaves", PARAM_INTEGER, 6, 1, 10, 0, 0, struct fog, octaves),
    FOG("fog_offset", PARAM_FLOAT, 0, offset),
    FOG("fog_alt", PARAM_FLOAT, 0, alt),
    {.word = "up",
     .kind = PARAM_VECTOR,
     .start = {0, 1, 0},
     .low = -INFINITY,
     .high = INFINITY,
     .alone = NAN,
     .offset = offsetof(struct fog, up)},
    {0}};
static const struct param fog_arguments[] = {
    PARAM_ANY("color", PARAM_COLOR, 0, 0, struct fog, color), {0}};

static void open_fog(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(fog_params, frame->node);
}

/* A color may be said again, after a fog that was declared. */
static void fog_argument(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    param_set(parser, fog_arguments, frame->node, at, value, 1, at);
}

static void apply_fog(struct parser *parser, struct frame *frame,
                      const struct value *value, struct location at)
{
    (void)parser;
    (void)at;
    *(struct fog *)frame->node = *(const struct fog *)value->node;
}

static void move_fog(struct parser *parser, struct frame *frame,
                     const transform *by)
{
    struct fog *fog = frame->node;

    (void)parser;
    transform_vector(by, fog->up, fog->up);
}

const struct statement build_statement_fog = {
    .word = "fog",
    .makes = VALUE_FOG,
    .takes = BUILD_TAKES(VALUE_FOG),
    .size = sizeof(struct fog),
    .params = fog_params,
    .arguments = fog_arguments,
    .open = open_fog,
    .argument = fog_argument,
    .apply = apply_fog,
    .move = move_fog,
};

/* ---- rainbow ----------------------------------------------------------- */

#define RAINBOW(word, kind, start)                                             \
    PARAM_ANY(#word, kind, start, 0, struct rainbow, word)

static const struct param rainbow_params[] = {
    RAINBOW(direction, PARAM_VECTOR, 0),
    RAINBOW(angle, PARAM_FLOAT, 0),
    RAINBOW(width, PARAM_FLOAT, 0),
    RAINBOW(distance, PARAM_FLOAT, 0),
    RAINBOW(jitter, PARAM_FLOAT, 0),
    RAINBOW(up, PARAM_VECTOR, 0),
    RAINBOW(arc_angle, PARAM_FLOAT, 180),
    RAINBOW(falloff_angle, PARAM_FLOAT, 180),
    {0}};

static void open_rainbow(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(rainbow_params, frame->node);
}

static void apply_rainbow(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    struct rainbow *rainbow = frame->node;

    (void)parser;
    (void)at;
    if (value->kind == VALUE_RAINBOW)
        *rainbow = *(const struct rainbow *)value->node;
    else
        rainbow->map = value->node;
}

static void move_rainbow(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct rainbow *rainbow = frame->node;

    (void)parser;
    transform_vector(by, rainbow->direction, rainbow->direction);
    transform_vector(by, rainbow->up, rainbow->up);
}

const struct statement build_statement_rainbow = {
    .word = "rainbow",
    .makes = VALUE_RAINBOW,
    .takes = BUILD_TAKES(VALUE_RAINBOW) | BUILD_TAKES(VALUE_COLOR_MAP),
    .size = sizeof(struct rainbow),
    .params = rainbow_params,
    .open = open_rainbow,
    .apply = apply_rainbow,
    .move = move_rainbow,
};
