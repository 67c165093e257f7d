/* build_implicit.c - shapes of functions: isosurface and parametric. */
#include <string.h>

#include "parser/builder.h"
#include "parser/formula.h"

/* ---- contained_by ------------------------------------------------------ */

static void open_contained(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

static void apply_contained(struct parser *parser, struct frame *frame,
                            const struct value *value, struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;
    const struct object *by = value->node;
    bool sphere = by->kind == OBJECT_SHAPE &&
                  by->shape.kind == BRUME_SHAPE_SPHERE;
    bool box = by->kind == OBJECT_SHAPE && by->shape.kind == BRUME_SHAPE_BOX;

    if (!sphere && !box) {
        parser_mistake(parser, at, "'contained_by' takes a sphere or a box");
        return;
    }
    frame->given = 1;
    shape->contained = sphere ? BRUME_CONTAINED_SPHERE : BRUME_CONTAINED_BOX;
    memcpy(shape->a, by->shape.a, sizeof shape->a);
    memcpy(shape->b, by->shape.b, sizeof shape->b);
    shape->radius = by->shape.radius;
}

static const enum build_kind in_implicit[] = {BUILD_ISOSURFACE,
                                              BUILD_PARAMETRIC, BUILD_KINDS};

const struct statement build_statement_contained_by = {
    .word = "contained_by",
    .within = in_implicit,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .open = open_contained,
    .apply = apply_contained,
};

static void start_contained(struct brume_shape *shape)
{
    shape->contained = BRUME_CONTAINED_BOX;
    for (int i = 0; i < 3; i++) {
        shape->a[i] = -1;
        shape->b[i] = 1;
    }
}

/* ---- isosurface -------------------------------------------------------- */

static void open_isosurface(struct parser *parser, struct frame *frame)
{
    struct brume_shape *shape;

    build_shape_open(parser, frame);
    shape = &((struct object *)frame->node)->shape;
    start_contained(shape);
    shape->order = 1;
}

bool build_is_function_of_space(struct parser *parser,
                                const struct value *value, struct location at)
{
    const struct function *function = value->node;

    return (function->parameters == 3 && function->results == 1) ||
           parser_mistake(parser, at,
                          "this needs a function of x, y and z that gives a "
                          "float");
}

static void apply_isosurface(struct parser *parser, struct frame *frame,
                             const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (value->kind != VALUE_FUNCTION)
        build_object_apply(parser, frame, value, at);
    else if (build_is_function_of_space(parser, value, at))
        object->shape.function[0] = ((const struct function *)value->node)->id;
}

static void isosurface_values(struct parser *parser, struct frame *frame,
                              const struct param *row,
                              const struct value *value, int count,
                              struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;

    shape->evaluate = true;
    for (int i = 0; i < count; i++) {
        if (value[i].kind != VALUE_NUMBER)
            parser_mistake(parser, at, "'%s' needs three floats", row->word);
        else
            shape->evaluate_factors[i] = value[i].v[0];
    }
}

static void close_isosurface(struct parser *parser, struct frame *frame,
                             struct location at)
{
    const struct object *object = frame->node;

    if (object->shape.function[0] < 0)
        parser_mistake(parser, at, "an isosurface needs its function");
}

#define ACCURACY(start)                                                        \
    PARAM_ROW("accuracy", PARAM_FLOAT, start, 0, INFINITY, PARAM_ABOVE, 0,     \
              struct object, shape.accuracy)
#define MAX_GRADIENT                                                           \
    PARAM_ROW("max_gradient", PARAM_FLOAT, 1.1, 0, INFINITY, PARAM_ABOVE, 0,   \
              struct object, shape.max_gradient)

static const struct param isosurface_params[] = {
    BUILD_OBJECT_ROWS,
    ACCURACY(0.001),
    MAX_GRADIENT,
    PARAM_ANY("threshold", PARAM_FLOAT, 0, 0, struct object, shape.threshold),
    PARAM_OWN("evaluate", 3, 3, 0),
    PARAM_ROW("max_trace", PARAM_INTEGER, 1, 1, 1e9, 0, 0, struct object,
              shape.order),
    PARAM_WORD("all_intersections", PARAM_MARK, 0, 0, struct object,
               shape.order),
    PARAM_WORD("open", PARAM_SWITCH, 1, 0, struct object, shape.open),
    {0}};

const struct statement build_statement_isosurface = {
    .word = "isosurface",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_FUNCTION),
    .size = sizeof(struct object),
    .params = isosurface_params,
    .open = open_isosurface,
    .values = isosurface_values,
    .apply = apply_isosurface,
    .move = build_object_move,
    .close = close_isosurface,
    .set = build_object_set,
};

/* ---- parametric -------------------------------------------------------- */

static void open_parametric(struct parser *parser, struct frame *frame)
{
    build_shape_open(parser, frame);
    start_contained(&((struct object *)frame->node)->shape);
}

static void apply_parametric(struct parser *parser, struct frame *frame,
                             const struct value *value, struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;
    int i = 0;

    if (value->kind != VALUE_FUNCTION) {
        build_object_apply(parser, frame, value, at);
        return;
    }
    while (i < 3 && shape->function[i] >= 0)
        i++;
    if (i == 3)
        parser_mistake(parser, at, "a parametric has three functions");
    else if (build_is_function_of_space(parser, value, at))
        shape->function[i] = ((const struct function *)value->node)->id;
}

/* The corners of u and v. */
static void parametric_argument(struct parser *parser, struct frame *frame,
                                const struct value *value, struct location at)
{
    if (frame->arguments > 1 || value->kind != VALUE_NUMBER ||
        value->terms < 2) {
        parser_mistake(parser, at, "a parametric has two vectors of u and v");
        return;
    }
    build_number(parser, value->v[0], at);
    build_number(parser, value->v[1], at);
}

/* `precompute depth, x, y, z`: the depth alone matters. */
static void parametric_values(struct parser *parser, struct frame *frame,
                              const struct param *row,
                              const struct value *value, int count,
                              struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;

    (void)count;
    if (value->kind != VALUE_NUMBER || !(value->v[0] >= 0 && value->v[0] <= 20))
        parser_mistake(parser, at, "'%s' needs a depth from 0 to 20",
                       row->word);
    else
        shape->order = (int)value->v[0];
}

static void close_parametric(struct parser *parser, struct frame *frame,
                             struct location at)
{
    const struct object *object = frame->node;

    if (object->shape.function[2] < 0)
        parser_mistake(parser, at, "a parametric needs three functions");
    build_take_numbers(parser, frame, frame->node);
}

static const struct param parametric_params[] = {
    BUILD_OBJECT_ROWS,
    ACCURACY(0.001),
    MAX_GRADIENT,
    PARAM_OWN("precompute", 1, 4, 0),
    {0}};
static const struct param corner_rows[] = {{.word = "first corner of u and v"},
                                           {.word = "second corner of u and v"},
                                           {0}};

const struct statement build_statement_parametric = {
    .word = "parametric",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_FUNCTION),
    .size = sizeof(struct object),
    .params = parametric_params,
    .arguments = corner_rows,
    .needed = 2,
    .open = open_parametric,
    .argument = parametric_argument,
    .values = parametric_values,
    .apply = apply_parametric,
    .move = build_object_move,
    .close = close_parametric,
    .set = build_object_set,
};
