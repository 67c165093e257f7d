/* build_spline.c - spline, and its values. */
#include <string.h>

#include "parser/builder.h"
#include "parser/eval.h"
#include "parser/formula.h"

/* Points lie among the builder's numbers while the statement is open: the
 * parameter and VALUE_TERMS terms each. */
enum { POINT_NUMBERS = 1 + VALUE_TERMS };

struct spline {
    int kind;             /* enum brume_spline_kind                  */
    int terms;            /* the most of its points                  */
    int id;               /* in core                                 */
    const double *number; /* the points, for splines made of it      */
    int points;
};

#define SPLINE(word_, kind_)                                                   \
    PARAM_WORD(word_, PARAM_MARK, BRUME_SPLINE_##kind_, 0, struct spline, kind)

static const struct param spline_params[] = {
    SPLINE("linear_spline", LINEAR),
    SPLINE("quadratic_spline", QUADRATIC),
    SPLINE("cubic_spline", CUBIC),
    SPLINE("natural_spline", NATURAL),
    {0}};

static void open_spline(struct parser *parser, struct frame *frame)
{
    struct spline *spline = frame->node;

    spline->kind = BRUME_SPLINE_LINEAR;
    spline->terms = 2;
    frame->mark = parser->builder->numbers;
}

/* A parameter, then a point, and so on. */
static void spline_argument(struct parser *parser, struct frame *frame,
                            const struct value *value, struct location at)
{
    struct spline *spline = frame->node;
    bool point = frame->arguments % 2 == 1;

    if (value->kind != VALUE_NUMBER || (!point && value->terms != 1)) {
        parser_error(parser, at, "a spline needs a %s here",
                     point ? "vector" : "float");
        return;
    }
    if (!point) {
        build_number(parser, value->v[0], at);
        return;
    }
    if (value->terms > spline->terms)
        spline->terms = value->terms;
    struct value v = value_promote(*value, value->terms > 1 ? VALUE_TERMS : 3);
    for (int i = 0; i < VALUE_TERMS; i++)
        build_number(parser, i < v.terms ? v.v[i] : 0, at);
    if (value->terms == 1 && spline->terms < 3)
        spline->terms = 3;
}

static void apply_spline(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    const struct spline *from = value->node;
    struct spline *spline = frame->node;

    *spline = *from;
    for (int i = 0; i < from->points * POINT_NUMBERS; i++)
        if (!build_number(parser, from->number[i], at))
            return;
}

/* Parameters and values apart, as core takes them. */
static bool send_spline(struct parser *parser, struct spline *spline,
                        struct brume_error *err)
{
    size_t count = (size_t)spline->points;
    double *parameters = parser_array(parser, count, sizeof *parameters);
    double *values = parser_array(parser, count * (size_t)spline->terms,
                                  sizeof *values);
    struct brume_spline to = {.kind = (enum brume_spline_kind)spline->kind,
                              .terms = spline->terms,
                              .count = spline->points,
                              .parameters = parameters,
                              .values = values};

    if (!parameters || !values)
        return true;
    for (int i = 0; i < spline->points; i++) {
        const double *point = spline->number + i * POINT_NUMBERS;
        parameters[i] = point[0];
        memcpy(values + i * spline->terms, point + 1,
               (size_t)spline->terms * sizeof *values);
    }
    spline->id = brume_add_spline(parser->out->scene, &to, err);
    return spline->id >= 0;
}

static void close_spline(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct builder *builder = parser->builder;
    struct spline *spline = frame->node;
    struct brume_error err = {0};
    size_t count = builder->numbers - frame->mark;
    double *number = parser_array(parser, count, sizeof *number);

    if (count == 0 || count % POINT_NUMBERS != 0) {
        parser_error(parser, at,
                     count == 0 ? "a spline needs points"
                                : "this spline's last point is "
                                  "missing");
        return;
    }
    if (!number)
        return;
    memcpy(number, builder->number + frame->mark, count * sizeof *number);
    builder->numbers = frame->mark;
    spline->number = number;
    spline->points = (int)(count / POINT_NUMBERS);
    if (!send_spline(parser, spline, &err))
        parser_relay(parser, at, &err);
}

const struct statement build_statement_spline = {
    .word = "spline",
    .makes = VALUE_SPLINE,
    .takes = BUILD_TAKES(VALUE_SPLINE),
    .size = sizeof(struct spline),
    .params = spline_params,
    .open = open_spline,
    .argument = spline_argument,
    .apply = apply_spline,
    .close = close_spline,
};

int build_spline_function(struct parser *parser, const struct value *value,
                          struct brume_error *err)
{
    const struct spline *spline = value->node;
    struct brume_function *function = brume_function_new(parser->out->scene, 1,
                                                         err);

    if (!function)
        return -1;
    if (!brume_function_parameter(function, 0, err) ||
        !brume_function_spline(function, spline->id, -1, err)) {
        brume_function_free(function);
        return -1;
    }
    return brume_add_function(parser->out->scene, function, err);
}

/* ---- values ------------------------------------------------------------ */

static int kind_named(struct parser *parser, const struct name *type,
                      struct location at)
{
    const struct param *row = type ? param_find(spline_params, type->text)
                                   : NULL;

    if (type && !row)
        parser_mistake(parser, at, "'%s' is no type of spline", type->text);
    return row ? (int)row->alone : -1;
}

struct value build_spline_value(struct parser *parser,
                                const struct value *value, int count,
                                const struct name *type, struct location at)
{
    const struct spline *spline = value->node;
    const struct value *t = eval_pop(parser, count);
    int kind = kind_named(parser, type, at);
    struct brume_error err = {0};
    double out[BRUME_MAX_RESULTS] = {0};

    if (parser->failed)
        return value_float(0);
    if (count != 1) {
        parser_mistake(parser, at, "a spline takes one float");
        return value_float(0);
    }
    if (formula_is(t))
        return formula_spline(parser, spline->id, spline->terms, kind, t, at);
    struct value x = eval_float(parser, t, at);
    if (!brume_eval_spline(parser->out->scene, spline->id, kind, x.v[0], out,
                           &err))
        parser_relay(parser, at, &err);
    return value_vector(spline->terms, out);
}
