/* build_density.c - density, and the fields of a fire. */
#include "parser/builder.h"

static void open_density(struct parser *parser, struct frame *frame)
{
    struct density *density = frame->node;

    (void)parser;
    density->on.by = transform_identity();
    for (int i = 0; i < 3; i++)
        density->color[i] = 1;
}

static const struct param density_color = PARAM_ROW(
    "color", PARAM_RGB, 1, 0, INFINITY, 0, 0, struct density, color);

static void density_argument(struct parser *parser, struct frame *frame,
                             const struct value *number, struct location at)
{
    if (build_entry_position(frame, number))
        return;
    if (build_pattern_lists(frame)) {
        build_pattern_choice(parser, frame, number, at);
    } else if (frame->given & FRAME_PLAIN) {
        parser_mistake(parser, at, "'%s' takes no more numbers here",
                       build_statement_of(frame)->word);
    } else {
        frame->given |= FRAME_PLAIN;
        param_set(parser, &density_color, frame->node, at, number, 1, at);
    }
}

static void apply_density(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (value->kind == VALUE_DENSITY)
        build_begin_with(parser, frame, value, sizeof(struct density), at);
    else if (!build_pattern_apply(parser, frame, value, at))
        build_misplaced(parser, frame, value, at);
}

static void move_density(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct density *density = frame->node;

    (void)parser;
    density->on.by = transform_then(&density->on.by, by);
}

static void close_density(struct parser *parser, struct frame *frame,
                          struct location at)
{
    build_pattern_close(parser, frame, at);
    model_mean_density(frame->node);
}

static void close_density_entry(struct parser *parser, struct frame *frame,
                                struct location at)
{
    close_density(parser, frame, at);
    build_entry_close(parser, frame, at);
}

static void close_temperature(struct parser *parser, struct frame *frame,
                              struct location at)
{
    struct fire *fire = build_around(parser)->node;

    close_density(parser, frame, at);
    fire->on = true;
    fire->temperature = *(const struct density *)frame->node;
}

static void close_amount(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct fire *fire = build_around(parser)->node;

    close_density(parser, frame, at);
    fire->has_amount = true;
    fire->amount = *(const struct density *)frame->node;
}

static const enum build_kind in_fire[] = {BUILD_FIRE, BUILD_KINDS};
static const enum build_kind in_density_map[] = {BUILD_DENSITY_MAP,
                                                 BUILD_KINDS};

#define DENSITY_STATEMENT                                                      \
    .takes = BUILD_TAKES_PATTERN | BUILD_TAKES(VALUE_DENSITY) |                \
             BUILD_TAKES(VALUE_COLOR_MAP) | BUILD_TAKES(VALUE_DENSITY_MAP),    \
    .size = sizeof(struct density), .groups = build_pattern_groups,            \
    .open = open_density, .argument = density_argument,                        \
    .apply = apply_density, .move = move_density

const struct statement build_statement_density = {
    DENSITY_STATEMENT,
    .word = "density",
    .makes = VALUE_DENSITY,
    .close = close_density,
};

const struct statement build_statement_density_entry = {
    DENSITY_STATEMENT,
    .word = "[",
    .within = in_density_map,
    .close = close_density_entry,
};

const struct statement build_statement_temperature = {
    DENSITY_STATEMENT,
    .word = "temperature",
    .within = in_fire,
    .close = close_temperature,
};

const struct statement build_statement_amount = {
    DENSITY_STATEMENT,
    .word = "amount",
    .within = in_fire,
    .close = close_amount,
};
