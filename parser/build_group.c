/* build_group.c - objects made of objects: CSG, object{}, clipped_by. */
#include <string.h>

#include "parser/builder.h"

static const struct param group_params[] = {BUILD_GROUP_ROWS, {0}};

/* ---- members ----------------------------------------------------------- */

/* Maps that come before a member do not move it. */
static void undo(struct parser *parser, const struct object *object,
                 struct child *child)
{
    const transform identity = transform_identity();
    transform *before;

    if (!memcmp(&object->by, &identity, sizeof identity))
        return;
    before = parser_alloc(parser, sizeof *before);
    if (!before)
        return;
    if (!transform_inverse(&object->by, before))
        *before = identity;
    child->before = before;
}

struct child *build_add_child(struct parser *parser, struct members *members,
                              const struct object *object)
{
    struct child *child = parser_alloc(parser, sizeof *child);

    if (!child)
        return NULL;
    child->object = object;
    if (members->last)
        members->last->next = child;
    else
        members->first = child;
    members->last = child;
    return child;
}

static void add_member(struct parser *parser, const struct object *object,
                       struct members *members, const struct value *value)
{
    struct child *child = build_add_child(parser, members, value->node);

    if (child)
        undo(parser, object, child);
}

static bool is_member(const struct value *value)
{
    return value->kind == VALUE_OBJECT || value->kind == VALUE_LIGHT;
}

/* ---- union, merge, intersection, difference ---------------------------- */

static void open_group(struct parser *parser, struct frame *frame)
{
    static const int kinds[BUILD_KINDS] = {
        [BUILD_UNION] = BRUME_SHAPE_UNION,
        [BUILD_LIGHT_GROUP] = BRUME_SHAPE_UNION,
        [BUILD_MERGE] = BRUME_SHAPE_MERGE,
        [BUILD_INTERSECTION] = BRUME_SHAPE_INTERSECTION,
        [BUILD_DIFFERENCE] = BRUME_SHAPE_DIFFERENCE};

    (void)parser;
    build_object_start(frame, OBJECT_GROUP,
                       (enum brume_shape_kind)kinds[frame->kind],
                       build_statement_of(frame)->word);
}

static void apply_group(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (is_member(value))
        add_member(parser, object, &object->members, value);
    else
        build_object_apply(parser, frame, value, at);
}

static void close_group(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct object *object = frame->node;

    (void)at;
    if (!object->members.first)
        parser_warn(parser, frame->at, "this %s is empty",
                    build_statement_of(frame)->word);
}

#define TAKES_MEMBERS (BUILD_TAKES(VALUE_OBJECT) | BUILD_TAKES(VALUE_LIGHT))

#define GROUP_STATEMENT(name, rows, closed)                                    \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = VALUE_OBJECT,                                                 \
        .takes = BUILD_TAKES_WORN | TAKES_MEMBERS,                             \
        .size = sizeof(struct object),                                         \
        .params = rows,                                                        \
        .open = open_group,                                                    \
        .apply = apply_group,                                                  \
        .move = build_object_move,                                             \
        .close = closed,                                                       \
        .set = build_object_set,                                               \
    }

GROUP_STATEMENT(union, group_params, close_group);
GROUP_STATEMENT(merge, group_params, close_group);
GROUP_STATEMENT(intersection, group_params, close_group);
GROUP_STATEMENT(difference, group_params, close_group);

/* ---- light_group: its lights shine on its objects alone ---------------- */

static void close_light_group(struct parser *parser, struct frame *frame,
                              struct location at)
{
    struct object *object = frame->node;

    object->lacks = "light groups";
    close_group(parser, frame, at);
}

static const struct param light_group_params[] = {
    BUILD_GROUP_ROWS,
    PARAM_WORD("global_lights", PARAM_SWITCH, 1, 0, struct object,
               global_lights),
    {0}};

GROUP_STATEMENT(light_group, light_group_params, close_light_group);

/* ---- object { IDENTIFIER ... } ----------------------------------------- */

/* Until it is given an object it is an empty union. */
static void open_object(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_GROUP, BRUME_SHAPE_UNION, "object");
}

static void apply_object(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (!is_member(value)) {
        build_object_apply(parser, frame, value, at);
        return;
    }
    if (frame->given & OBJECT_NAMED)
        parser_mistake(parser, at, "'object' takes one object; use 'union'");
    frame->given |= OBJECT_NAMED;
    *object = *(const struct object *)value->node;
    object->texture.owned = false;
    object->query = 0;
    object->at = frame->at;
}

static void close_object(struct parser *parser, struct frame *frame,
                         struct location at)
{
    if (!(frame->given & OBJECT_NAMED))
        parser_mistake(parser, at, "'object' needs an object before this");
}

const struct statement build_statement_object = {
    .word = "object",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | TAKES_MEMBERS,
    .size = sizeof(struct object),
    .params = group_params,
    .open = open_object,
    .apply = apply_object,
    .move = build_object_move,
    .close = close_object,
    .set = build_object_set,
};

/* ---- clipped_by, bounded_by -------------------------------------------- */

static void open_clips(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

static void apply_clips(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *object = frame->node;

    (void)at;
    frame->given = 1;
    if (frame->kind == BUILD_BOUNDED_BY)
        add_member(parser, object, &object->bounds, value);
    else
        add_member(parser, object, &object->clips, value);
}

/* `clipped_by { bounded_by }` takes the other's objects. */
static void set_clips(struct parser *parser, struct frame *frame,
                      const struct param *row, struct location at)
{
    struct object *object = frame->node;

    (void)parser;
    (void)row;
    (void)at;
    frame->given = 1;
    if (frame->kind == BUILD_CLIPPED_BY)
        object->clips = object->bounds;
}

static void close_clips(struct parser *parser, struct frame *frame,
                        struct location at)
{
    static const char bounds_note[] = "Brume finds the bounds itself";

    if (frame->kind == BUILD_BOUNDED_BY)
        build_note(parser, "bounded_by", bounds_note, frame->at);
    if (!frame->given)
        parser_mistake(parser, at, "'%s' needs an object before this",
                       build_statement_of(frame)->word);
}

static const struct param clips_params[] = {
    {.word = "bounded_by", .kind = PARAM_IGNORED}, {0}};
static const struct param bounds_params[] = {
    {.word = "clipped_by", .kind = PARAM_IGNORED}, {0}};

const struct statement build_statement_clipped_by = {
    .word = "clipped_by",
    .in_objects = true,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .params = clips_params,
    .open = open_clips,
    .apply = apply_clips,
    .close = close_clips,
    .set = set_clips,
};

/* Bounds tell POV-Ray where to look for an object: Brume knows. */
const struct statement build_statement_bounded_by = {
    .word = "bounded_by",
    .in_objects = true,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .params = bounds_params,
    .open = open_clips,
    .apply = apply_clips,
    .close = close_clips,
    .set = set_clips,
};
