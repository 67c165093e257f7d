/* build_object.c - shapes, unions and object{}: what they are and wear. */
#include <string.h>

#include "parser/builder.h"

#define POINT(word, member)                                                    \
    PARAM_ANY(word, PARAM_VECTOR, 0, 0, struct object, shape.member)
#define LENGTH(word, member)                                                   \
    PARAM_ANY(word, PARAM_FLOAT, 0, 0, struct object, shape.member)

/* ---- modifiers that all objects have ----------------------------------- */

const struct param build_object_params[] = {BUILD_OBJECT_ROWS, {0}};
static const struct param tube_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_WORD("open", PARAM_SWITCH, 1, 0, struct object, shape.open),
    {0}};

void build_object_set(struct parser *parser, struct frame *frame,
                      const struct param *row, struct location at)
{
    struct object *object = frame->node;

    if (row->given & OBJECT_HOLLOW)
        object->says_hollow = true;
    if (strcmp(row->word, "inverse"))
        return;
    if (object->kind == OBJECT_UNION)
        parser_error(parser, at, "'inverse' of a union is not supported yet");
    object->inverse = !object->inverse;
}

const struct object *build_object_of(const struct frame *frame)
{
    return build_statement_of(frame)->makes == VALUE_OBJECT ? frame->node
                                                            : NULL;
}

void build_object_apply(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *object = frame->node;
    const struct material *material;

    switch (value->kind) {
    case VALUE_TEXTURE:
    case VALUE_PIGMENT:
    case VALUE_NORMAL:
    case VALUE_FINISH:
        build_wear(parser, &object->texture, value);
        break;
    case VALUE_INTERIOR_TEXTURE:
        object->inner = (struct placed_texture){value->node,
                                                transform_identity(), false};
        break;
    case VALUE_INTERIOR:
        object->interior.what = value->node;
        object->interior.by = transform_identity();
        break;
    case VALUE_MATERIAL:
        material = value->node;
        if (material->interior.what)
            object->interior = material->interior;
        if (material->texture.what) {
            struct placed_texture over = material->texture;
            over.owned = false;
            build_wear_placed(parser, &object->texture, &over);
        }
        if (material->inner.what)
            object->inner = material->inner;
        break;
    default:
        build_misplaced(parser, frame, value, at);
        break;
    }
}

void build_object_move(struct parser *parser, struct frame *frame,
                       const transform *by)
{
    (void)parser;
    model_object_transform(frame->node, by);
}

struct object *build_object_start(struct frame *frame, enum object_kind kind,
                                  enum brume_shape_kind shape, const char *word)
{
    static const struct brume_shape start = BRUME_SHAPE_INIT;
    struct object *object = frame->node;

    object->kind = kind;
    object->word = word;
    object->at = frame->at;
    object->shape = start;
    object->shape.kind = shape;
    object->by = object->texture.by = object->inner.by = object->interior.by =
        transform_identity();
    object->shadow = true;
    return object;
}

/* ---- shapes ------------------------------------------------------------ */

static void open_sphere(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_SPHERE, "sphere");
}

static void open_box(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_BOX, "box");
}

static void open_cylinder(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_CYLINDER, "cylinder");
}

static void open_cone(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_CONE, "cone");
}

static void open_plane(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_PLANE, "plane");
}

static void open_disc(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_SHAPE, BRUME_SHAPE_DISC, "disc");
}

static const struct param sphere_arguments[] = {
    POINT("center", a), LENGTH("radius", radius), {0}};
static const struct param box_arguments[] = {
    POINT("first corner", a), POINT("second corner", b), {0}};
static const struct param cylinder_arguments[] = {POINT("base point", a),
                                                  POINT("cap point", b),
                                                  LENGTH("radius", radius),
                                                  {0}};
static const struct param cone_arguments[] = {POINT("base point", a),
                                              LENGTH("base radius", radius),
                                              POINT("cap point", b),
                                              LENGTH("cap radius", radius_b),
                                              {0}};
static const struct param plane_arguments[] = {
    POINT("normal", a), LENGTH("distance", radius), {0}};
static const struct param disc_arguments[] = {POINT("center", a),
                                              POINT("normal", b),
                                              LENGTH("radius", radius),
                                              LENGTH("hole radius", radius_b),
                                              {0}};

/* Corners may be named in any order, radii may be negative, as in POV-Ray. */
static void close_shape(struct parser *parser, struct frame *frame,
                        struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;

    (void)parser;
    (void)at;
    for (int i = 0; i < 3 && shape->kind == BRUME_SHAPE_BOX; i++)
        if (shape->a[i] > shape->b[i]) {
            double low = shape->b[i];
            shape->b[i] = shape->a[i];
            shape->a[i] = low;
        }
    if (shape->kind != BRUME_SHAPE_PLANE) {
        shape->radius = fabs(shape->radius);
        shape->radius_b = fabs(shape->radius_b);
    }
}

#define SHAPE_STATEMENT(name, count, table)                                    \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = VALUE_OBJECT,                                                 \
        .takes = BUILD_TAKES_WORN,                                             \
        .size = sizeof(struct object),                                         \
        .params = table,                                                       \
        .arguments = name##_arguments,                                         \
        .needed = count,                                                       \
        .open = open_##name,                                                   \
        .apply = build_object_apply,                                           \
        .move = build_object_move,                                             \
        .close = close_shape,                                                  \
        .set = build_object_set,                                               \
    }

SHAPE_STATEMENT(sphere, 2, build_object_params);
SHAPE_STATEMENT(box, 2, build_object_params);
SHAPE_STATEMENT(cylinder, 3, tube_params);
SHAPE_STATEMENT(cone, 4, tube_params);
SHAPE_STATEMENT(plane, 2, build_object_params);
SHAPE_STATEMENT(disc, 3, build_object_params);

/* ---- union ------------------------------------------------------------- */

static void open_union(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_UNION, BRUME_SHAPE_SPHERE, "union");
}

static void apply_union(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (value->kind != VALUE_OBJECT && value->kind != VALUE_LIGHT) {
        build_object_apply(parser, frame, value, at);
        return;
    }
    struct child *child = parser_alloc(parser, sizeof *child);
    if (!child)
        return;
    child->object = value->node;
    if (object->last)
        object->last->next = child;
    else
        object->first = child;
    object->last = child;
}

static void close_union(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct object *object = frame->node;

    (void)at;
    if (!object->first)
        parser_warn(parser, frame->at, "this union is empty");
}

const struct statement build_statement_union = {
    .word = "union",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_OBJECT) |
             BUILD_TAKES(VALUE_LIGHT),
    .size = sizeof(struct object),
    .params = build_object_params,
    .open = open_union,
    .apply = apply_union,
    .move = build_object_move,
    .close = close_union,
    .set = build_object_set,
};

/* ---- object { IDENTIFIER ... } ----------------------------------------- */

/* Until it is given an object it is an empty union. */
static void open_object(struct parser *parser, struct frame *frame)
{
    (void)parser;
    build_object_start(frame, OBJECT_UNION, BRUME_SHAPE_SPHERE, "object");
}

static void apply_object(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (value->kind != VALUE_OBJECT && value->kind != VALUE_LIGHT) {
        build_object_apply(parser, frame, value, at);
        return;
    }
    if (frame->given & OBJECT_NAMED)
        parser_error(parser, at, "'object' takes one object; use 'union'");
    frame->given |= OBJECT_NAMED;
    *object = *(const struct object *)value->node;
    object->texture.owned = false;
    object->at = frame->at;
}

static void close_object(struct parser *parser, struct frame *frame,
                         struct location at)
{
    if (!(frame->given & OBJECT_NAMED))
        parser_error(parser, at, "'object' needs an object before this");
}

const struct statement build_statement_object = {
    .word = "object",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_OBJECT) |
             BUILD_TAKES(VALUE_LIGHT),
    .size = sizeof(struct object),
    .params = build_object_params,
    .open = open_object,
    .apply = apply_object,
    .move = build_object_move,
    .close = close_object,
    .set = build_object_set,
};

/* ---- what functions ask of values -------------------------------------- */

struct value build_spline_value(struct parser *parser,
                                const struct value *spline, int count,
                                const struct name *type, struct location at)
{
    (void)spline;
    (void)count;
    (void)type;
    parser_mistake(parser, at, "splines are not supported yet");
    return value_float(0);
}

struct value build_object_value(struct parser *parser,
                                const struct name *function,
                                const struct value *object,
                                const struct value *point, struct location at)
{
    (void)object;
    (void)point;
    parser_mistake(parser, at, "'%s' is not supported yet", function->text);
    return value_float(0);
}

struct value build_trace(struct parser *parser, const struct value *object,
                         const struct value *from,
                         const struct value *direction,
                         const struct name *normal, struct location at)
{
    (void)object;
    (void)from;
    (void)direction;
    (void)normal;
    parser_mistake(parser, at, "'trace' is not supported yet");
    return value_float(0);
}

int build_function(struct parser *parser, const struct value *value,
                   struct location at, struct brume_error *err)
{
    (void)err;
    parser_mistake(parser, at, "a function of a %s is not supported yet",
                   value_name(value));
    return -1;
}
