/* build_blob.c - blob and its components. */
#include <string.h>

#include "parser/builder.h"

/* A component as its statement reads it. */
struct component {
    double end[2][3];
    double radius, strength;
    transform by;
};

static bool add_component(struct parser *parser, double kind,
                          const struct component *part, struct location at)
{
    const double start[4] = {kind, part->strength, part->radius, 0};

    for (int i = 0; i < 3; i++)
        if (!build_number(parser, start[i], at))
            return false;
    for (int i = 0; i < 6; i++)
        if (!build_number(parser, part->end[i / 3][i % 3], at))
            return false;
    for (int i = 0; i < 12; i++)
        if (!build_number(parser, part->by.m[i / 4][i % 4], at))
            return false;
    return true;
}

/* ---- sphere and cylinder in it ----------------------------------------- */

#define PART(word, kind, start, member)                                        \
    PARAM_ANY(word, kind, start, 0, struct component, member)

static const struct param sphere_arguments[] = {
    PART("center", PARAM_VECTOR, 0, end[0]),
    PART("radius", PARAM_FLOAT, 1, radius),
    PART("strength", PARAM_FLOAT, 1, strength),
    {0}};
static const struct param cylinder_arguments[] = {
    PART("first end", PARAM_VECTOR, 0, end[0]),
    PART("second end", PARAM_VECTOR, 0, end[1]),
    PART("radius", PARAM_FLOAT, 1, radius),
    PART("strength", PARAM_FLOAT, 1, strength),
    {0}};
static const struct param component_params[] = {
    PART("strength", PARAM_FLOAT, 1, strength), {0}};

static void open_component(struct parser *parser, struct frame *frame)
{
    struct component *part = frame->node;

    (void)parser;
    part->strength = 1;
    part->by = transform_identity();
}

static void move_component(struct parser *parser, struct frame *frame,
                           const transform *by)
{
    struct component *part = frame->node;

    (void)parser;
    part->by = transform_then(&part->by, by);
}

static void apply_component(struct parser *parser, struct frame *frame,
                            const struct value *value, struct location at)
{
    struct object *blob = build_around(parser)->node;

    (void)frame;
    (void)value;
    (void)at;
    blob->lacks = "textures of the parts of blobs";
}

static void close_component(struct parser *parser, struct frame *frame,
                            struct location at)
{
    add_component(parser, frame->kind == BUILD_BLOB_CYLINDER, frame->node, at);
}

static const enum build_kind in_blob[] = {BUILD_BLOB, BUILD_KINDS};

#define COMPONENT_STATEMENT(name, word_, count, rows)                          \
    const struct statement build_statement_##name = {                          \
        .word = word_,                                                         \
        .within = in_blob,                                                     \
        .takes = BUILD_TAKES_WORN,                                             \
        .size = sizeof(struct component),                                      \
        .params = component_params,                                            \
        .arguments = rows,                                                     \
        .needed = count,                                                       \
        .open = open_component,                                                \
        .apply = apply_component,                                              \
        .move = move_component,                                                \
        .close = close_component,                                              \
    }

COMPONENT_STATEMENT(blob_sphere, "sphere", 2, sphere_arguments);
COMPONENT_STATEMENT(blob_cylinder, "cylinder", 3, cylinder_arguments);

/* ---- the blob ---------------------------------------------------------- */

static void open_blob(struct parser *parser, struct frame *frame)
{
    build_shape_open(parser, frame);
    ((struct object *)frame->node)->shape.radius = 1;
}

/* `component strength, radius, center`: POV-Ray 1's spheres. */
static void blob_values(struct parser *parser, struct frame *frame,
                        const struct param *row, const struct value *value,
                        int count, struct location at)
{
    struct component part = {.by = transform_identity()};

    (void)frame;
    for (int i = 0; i < count; i++)
        if (value[i].kind != VALUE_NUMBER) {
            parser_mistake(parser, at, "'%s' needs numbers", row->word);
            return;
        }
    part.strength = value[0].v[0];
    part.radius = value[1].v[0];
    memcpy(part.end[0], value_promote(value[2], 3).v, sizeof part.end[0]);
    add_component(parser, 0, &part, at);
}

static void close_blob(struct parser *parser, struct frame *frame,
                       struct location at)
{
    if (parser->builder->numbers == frame->mark)
        parser_mistake(parser, at, "this blob has no components");
    build_take_numbers(parser, frame, frame->node);
}

static const struct param blob_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_ROW("threshold", PARAM_FLOAT, 1, 0, INFINITY, PARAM_ABOVE, 0,
              struct object, shape.radius),
    PARAM_OWN("component", 3, 3, 0),
    {0}};

const struct statement build_statement_blob = {
    .word = "blob",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .size = sizeof(struct object),
    .params = blob_params,
    .open = open_blob,
    .values = blob_values,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_blob,
    .set = build_object_set,
};
