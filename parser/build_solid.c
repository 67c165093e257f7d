/* build_solid.c - quadric, cubic, quartic, poly, superellipsoid and
 * julia_fractal. */
#include <string.h>

#include "parser/builder.h"

/* Adds the terms of a vector of exactly so many. */
static bool add_terms(struct parser *parser, const struct value *value,
                      int terms, const char *word, struct location at)
{
    const double *term = value->kind == VALUE_LIST ? value->list->term
                                                   : value->v;
    int given = value->kind == VALUE_LIST     ? value->list->count
                : value->kind == VALUE_NUMBER ? value->terms
                                              : 0;

    if (given != terms)
        return parser_mistake(parser, at,
                              "'%s' needs a vector of %d terms here, not %d",
                              word, terms, given);
    for (int i = 0; i < terms; i++)
        if (!build_number(parser, term[i], at))
            return false;
    return true;
}

#define SOLID_STATEMENT(name, count, rows, own_argument, closed)               \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = VALUE_OBJECT,                                                 \
        .takes = BUILD_TAKES_WORN,                                             \
        .size = sizeof(struct object),                                         \
        .params = build_object_params,                                         \
        .arguments = rows,                                                     \
        .needed = count,                                                       \
        .open = build_shape_open,                                              \
        .argument = own_argument,                                              \
        .apply = build_object_apply,                                           \
        .move = build_object_move,                                             \
        .close = closed,                                                       \
        .set = build_object_set,                                               \
    }

/* ---- quadric: three vectors and a number ------------------------------- */

static void quadric_argument(struct parser *parser, struct frame *frame,
                             const struct value *value, struct location at)
{
    if (frame->arguments > 3)
        parser_mistake(parser, at, "a quadric takes no more numbers");
    else
        add_terms(parser, value, frame->arguments < 3 ? 3 : 1, "quadric", at);
}

static void close_numbers(struct parser *parser, struct frame *frame,
                          struct location at)
{
    (void)at;
    build_take_numbers(parser, frame, frame->node);
}

static const struct param quadric_rows[] = {{.word = "first vector"},
                                            {.word = "second vector"},
                                            {.word = "third vector"},
                                            {.word = "constant"},
                                            {0}};
SOLID_STATEMENT(quadric, 4, quadric_rows, quadric_argument, close_numbers);

/* ---- polynomials ------------------------------------------------------- */

enum { POLY_MOST = 35 };

static int coefficients(int order)
{
    return (order + 1) * (order + 2) * (order + 3) / 6;
}

static void poly_terms(struct parser *parser, struct frame *frame,
                       const struct value *value, int order, struct location at)
{
    struct object *object = frame->node;

    object->shape.order = order;
    add_terms(parser, value, coefficients(order), object->word, at);
}

static void take_order(struct parser *parser, struct object *object,
                       const struct value *value, struct location at)
{
    if (value->kind != VALUE_NUMBER || value->terms != 1 ||
        !(value->v[0] >= 2 && value->v[0] <= POLY_MOST))
        parser_error(parser, at, "the order of a %s is from 2 to %d",
                     object->word, POLY_MOST);
    else
        object->shape.order = (int)value->v[0];
}

static void poly_argument(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    struct object *object = frame->node;
    int fixed = frame->kind == BUILD_CUBIC     ? 3
                : frame->kind == BUILD_QUARTIC ? 4
                                               : 0;

    if (frame->arguments > (fixed ? 0 : 1))
        parser_mistake(parser, at, "'%s' takes no more numbers", object->word);
    else if (fixed || frame->arguments == 1)
        poly_terms(parser, frame, value, fixed ? fixed : object->shape.order,
                   at);
    else
        take_order(parser, object, value, at);
}

static const struct param poly_rows[] = {
    {.word = "order"}, {.word = "coefficients"}, {0}};
SOLID_STATEMENT(cubic, 1, poly_rows + 1, poly_argument, close_numbers);
SOLID_STATEMENT(quartic, 1, poly_rows + 1, poly_argument, close_numbers);
SOLID_STATEMENT(poly, 2, poly_rows, poly_argument, close_numbers);

/* `polynomial { order, xyz(a, b, c): number ... }`: all that is not named is
 * zero, and of what is named twice the last counts. */
static void polynomial_argument(struct parser *parser, struct frame *frame,
                                const struct value *value, struct location at)
{
    struct object *object = frame->node;

    if (frame->arguments > 0) {
        parser_mistake(parser, at, "'polynomial' takes no more numbers");
        return;
    }
    take_order(parser, object, value, at);
    for (int i = 0; i < coefficients(object->shape.order); i++)
        if (!build_number(parser, 0, at))
            return;
}

/* Where poly has the coefficient: powers of x fall, then those of y, then
 * those of z. */
static int place_of(int order, int x, int y, int z)
{
    int rest = order - x, last = rest - y;

    return rest * (rest + 1) * (rest + 2) / 6 + last * (last + 1) / 2 + last -
           z;
}

static void polynomial_values(struct parser *parser, struct frame *frame,
                              const struct param *row,
                              const struct value *value, int count,
                              struct location at)
{
    const struct object *object = frame->node;
    struct builder *builder = parser->builder;
    int order = object->shape.order, sum = 0;

    for (int i = 0; i < count; i++) {
        double x = value[i].v[0];
        if (frame->arguments == 0 || value[i].kind != VALUE_NUMBER ||
            value[i].terms != 1 || (i < 3 && !(x > -1 && x < order + 1))) {
            parser_mistake(parser, at,
                           "behind the order '%s' has three powers from 0 to "
                           "it, and a float",
                           row->word);
            return;
        }
        sum += i < 3 ? (int)x : 0;
    }
    if (sum > order) {
        parser_mistake(parser, at, "this term is of order %d, not of %d", sum,
                       order);
        return;
    }
    int place = place_of(order, (int)value[0].v[0], (int)value[1].v[0],
                         (int)value[2].v[0]);
    builder->number[frame->mark + (size_t)place] = value[3].v[0];
}

static const struct param polynomial_params[] = {
    BUILD_OBJECT_ROWS, PARAM_OWN("xyz", 4, 4, 0), {0}};

const struct statement build_statement_polynomial = {
    .word = "polynomial",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .size = sizeof(struct object),
    .params = polynomial_params,
    .arguments = poly_rows,
    .needed = 1,
    .open = build_shape_open,
    .argument = polynomial_argument,
    .values = polynomial_values,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_numbers,
    .set = build_object_set,
};

/* ---- superellipsoid ---------------------------------------------------- */

static const struct param superellipsoid_rows[] = {
    PARAM_ANY("exponents", PARAM_VECTOR, 1, 0, struct object, shape.a), {0}};
SOLID_STATEMENT(superellipsoid, 1, superellipsoid_rows, NULL, NULL);

/* ---- julia_fractal ----------------------------------------------------- */

enum { JULIA_SLICE, JULIA_POWER };

#define JULIA(word_, function)                                                 \
    PARAM_WORD(word_, PARAM_MARK, BRUME_JULIA_##function, 0, struct object,    \
               shape.julia_function)

static const struct param julia_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_WORD("quaternion", PARAM_MARK, BRUME_JULIA_QUATERNION, 0,
               struct object, shape.julia_kind),
    PARAM_WORD("hypercomplex", PARAM_MARK, BRUME_JULIA_HYPERCOMPLEX, 0,
               struct object, shape.julia_kind),
    JULIA("sqr", SQR),
    JULIA("cube", CUBE),
    JULIA("exp", EXP),
    JULIA("reciprocal", RECIPROCAL),
    JULIA("sin", SIN),
    JULIA("asin", ASIN),
    JULIA("sinh", SINH),
    JULIA("asinh", ASINH),
    JULIA("cos", COS),
    JULIA("acos", ACOS),
    JULIA("cosh", COSH),
    JULIA("acosh", ACOSH),
    JULIA("tan", TAN),
    JULIA("atan", ATAN),
    JULIA("tanh", TANH),
    JULIA("atanh", ATANH),
    JULIA("ln", LN),
    PARAM_OWN("pwr", 2, 2, JULIA_POWER),
    PARAM_OWN("slice", 2, 2, JULIA_SLICE),
    PARAM_ROW("max_iteration", PARAM_INTEGER, 20, 1, 1e9, 0, 0, struct object,
              shape.order),
    PARAM_ROW("precision", PARAM_FLOAT, 20, 1, INFINITY, 0, 0, struct object,
              shape.accuracy),
    {0}};

/* The numbers of its data: parameter, slice and its distance, exponent. */
enum {
    JULIA_NORMAL = 4,
    JULIA_DISTANCE = 8,
    JULIA_EXPONENT = 9,
    JULIA_NUMBERS = 11
};

static void open_julia(struct parser *parser, struct frame *frame)
{
    static const double start[JULIA_NUMBERS] = {
        1, 0, 0, 0, /* slice */ 0, 0, 0, 1, 0, /* exponent */ 0, 0};
    struct object *object;

    build_shape_open(parser, frame);
    object = frame->node;
    object->shape.order = 20;
    object->shape.accuracy = 20;
    for (int i = 0; i < JULIA_NUMBERS; i++)
        if (!build_number(parser, start[i], frame->at))
            return;
}

static void julia_argument(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    double *number = parser->builder->number + frame->mark;

    if (frame->arguments > 0 || value->kind != VALUE_NUMBER)
        parser_mistake(parser, at, "a julia_fractal begins with one vector");
    else
        memcpy(number, value_promote(*value, 4).v, 4 * sizeof *number);
}

static void julia_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    double *number = parser->builder->number + frame->mark;
    struct object *object = frame->node;

    if (count != 2 || value[0].kind != VALUE_NUMBER ||
        value[1].kind != VALUE_NUMBER) {
        parser_mistake(parser, at, "'%s' needs numbers", row->word);
    } else if (row->id == JULIA_SLICE) {
        memcpy(number + JULIA_NORMAL, value_promote(value[0], 4).v,
               4 * sizeof *number);
        number[JULIA_DISTANCE] = value[1].v[0];
    } else {
        object->shape.julia_function = BRUME_JULIA_PWR;
        number[JULIA_EXPONENT] = value[0].v[0];
        number[JULIA_EXPONENT + 1] = value[1].v[0];
    }
}

static const struct param julia_rows[] = {{.word = "parameter"}, {0}};

const struct statement build_statement_julia_fractal = {
    .word = "julia_fractal",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .size = sizeof(struct object),
    .params = julia_params,
    .arguments = julia_rows,
    .needed = 1,
    .open = open_julia,
    .argument = julia_argument,
    .values = julia_values,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_numbers,
    .set = build_object_set,
};
