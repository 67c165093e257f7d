/* build_velocity.c - how a medium moves. */
#include "parser/builder.h"

static const enum build_kind in_media[] = {BUILD_MEDIA, BUILD_KINDS};
static const char *const unit_words[] = {[VELOCITY_PER_SECOND] = "per_second",
                                         [VELOCITY_PER_FRAME] = "per_frame",
                                         [VELOCITY_VOXELS] = "voxels",
                                         NULL};

static const struct param velocity_params[] = {
    PARAM_ROW("fps", PARAM_FLOAT, 24, 0, INFINITY, PARAM_ABOVE, 0,
              struct velocity, fps),
    PARAM_ANY("strength", PARAM_FLOAT, 1, 0, struct velocity, strength),
    PARAM_WORDS("units", unit_words, 0, struct velocity, units),
    PARAM_OWN("vdb", 1, 2, 0),
    {0}};

static const struct param velocity_vector = PARAM_ANY(
    "velocity", PARAM_VECTOR, 0, 0, struct velocity, constant);

static void open_velocity(struct parser *parser, struct frame *frame)
{
    struct velocity *velocity = frame->node;

    (void)parser;
    param_defaults(velocity_params, velocity);
    velocity->by = transform_identity();
}

/* Whether it has no value yet. */
static bool is_first(struct parser *parser, struct velocity *velocity,
                     struct location at)
{
    if (velocity->on)
        parser_mistake(parser, at,
                       "'velocity' takes a vector or a file, and only one");
    velocity->on = true;
    return !velocity->said++;
}

static void velocity_argument(struct parser *parser, struct frame *frame,
                              const struct value *vector, struct location at)
{
    struct velocity *velocity = frame->node;

    if (is_first(parser, velocity, at) &&
        param_set(parser, &velocity_vector, velocity, at, vector, 1, at))
        velocity->known = load_steady(parser, velocity->constant,
                                      velocity->grid, at);
}

static void velocity_file(struct parser *parser, struct frame *frame,
                          const struct param *row, const struct value *value,
                          int count, struct location at)
{
    struct velocity *velocity = frame->node;
    struct location named = parser->builder->value_at;

    for (int i = 0; i < count; i++)
        if (value[i].kind != VALUE_STRING) {
            parser_mistake(parser, named, "'vdb' needs the name of a %s",
                           i == 0 ? "file" : "grid");
            return;
        }
    if (!is_first(parser, velocity, at))
        return;
    struct data_file file = data_file(row->word, value[0].string, named);
    if (count > 1)
        file.grid = value[1].string;
    velocity->file = true;
    if (build_has_file(parser, file.name, named))
        velocity->known = load_velocity(parser, &file, velocity->grid);
}

static void move_velocity(struct parser *parser, struct frame *frame,
                          const transform *by)
{
    struct velocity *velocity = frame->node;

    (void)parser;
    velocity->by = transform_then(&velocity->by, by);
}

static void close_velocity(struct parser *parser, struct frame *frame,
                           struct location at)
{
    struct media *media = build_around(parser)->node;
    const struct velocity *velocity = frame->node;

    if (!velocity->on)
        parser_mistake(parser, at, "'velocity' needs a vector or a file");
    if (velocity->units == VELOCITY_VOXELS && !velocity->file)
        parser_mistake(parser, at, "'voxels' are those of a file");
    media->velocity = *velocity;
}

const struct statement build_statement_velocity = {
    .word = "velocity",
    .within = in_media,
    .size = sizeof(struct velocity),
    .params = velocity_params,
    .open = open_velocity,
    .argument = velocity_argument,
    .values = velocity_file,
    .move = move_velocity,
    .close = close_velocity,
};
