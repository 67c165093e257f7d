/* build_query.c - what the functions of the language ask of objects and of
 * splines. */
#include <string.h>

#include "parser/builder.h"
#include "parser/eval.h"

/* The shape of core for an object's queries, made at the first of them. */
static int query_shape(struct parser *parser, const struct value *value,
                       const char *word, struct location at)
{
    struct object *object = value->node;

    if (parser->failed)
        return -1;
    if (value->kind != VALUE_OBJECT) {
        parser_mistake(parser, at, "'%s' needs an object, not a %s", word,
                       value_name(value));
        return -1;
    }
    if (object->query == 0)
        object->query = build_place_query(parser, object, at) + 1;
    return object->query - 1;
}

static bool is_vector(struct parser *parser, const struct value *value,
                      struct location at)
{
    return value->kind == VALUE_NUMBER ||
           parser_mistake(parser, at, "expected a vector, found a %s",
                          value_name(value));
}

static struct value inside(struct parser *parser, int shape,
                           const struct value *point, struct location at)
{
    struct brume_error err = {0};
    struct value p = value_promote(*point, 3);
    int in = brume_inside(parser->out->scene, shape, p.v, &err);

    if (in < 0)
        parser_relay(parser, at, &err);
    return value_float(in > 0);
}

static struct value extent(struct parser *parser, int shape, bool highest,
                           struct location at)
{
    struct brume_error err = {0};
    double corner[2][3] = {{0}};

    if (!brume_extent(parser->out->scene, shape, corner[0], corner[1], &err))
        parser_relay(parser, at, &err);
    return value_vector(3, corner[highest]);
}

struct value build_object_value(struct parser *parser,
                                const struct name *function,
                                const struct value *object,
                                const struct value *point, struct location at)
{
    const char *word = function->text;
    bool wants_point = !strcmp(word, "inside");
    int shape = query_shape(parser, object, word, at);

    if (shape < 0)
        return value_float(0);
    if (wants_point != (point != NULL)) {
        parser_mistake(parser, at, "'%s' takes an object%s", word,
                       wants_point ? " and a point" : "");
        return value_float(0);
    }
    if (!wants_point)
        return extent(parser, shape, !strcmp(word, "max_extent"), at);
    if (!is_vector(parser, point, at))
        return value_float(0);
    return inside(parser, shape, point, at);
}

/* The variable that trace's normal goes to must be declared. */
static void set_normal(struct parser *parser, const struct name *name,
                       const double normal[3], struct location at)
{
    struct value *variable = symbols_find(name);

    if (!variable || name->symbol->constant)
        parser_mistake(parser, at, "'%.40s' must be declared before trace",
                       name->text);
    else
        *variable = value_vector(3, normal);
}

struct value build_trace(struct parser *parser, const struct value *object,
                         const struct value *from,
                         const struct value *direction,
                         const struct name *normal, struct location at)
{
    struct brume_error err = {0};
    double point[3] = {0}, n[3] = {0};
    int shape = query_shape(parser, object, "trace", at);

    if (shape < 0 || !is_vector(parser, from, at) ||
        !is_vector(parser, direction, at))
        return value_float(0);
    struct value o = value_promote(*from, 3), d = value_promote(*direction, 3);
    if (d.v[0] == 0 && d.v[1] == 0 && d.v[2] == 0) {
        parser_mistake(parser, at, "'trace' needs a direction");
        return value_float(0);
    }
    int hit = brume_trace(parser->out->scene, shape, o.v, d.v, point, n, &err);
    if (hit < 0)
        parser_relay(parser, at, &err);
    if (hit <= 0)
        memset(point, 0, sizeof point), memset(n, 0, sizeof n);
    if (normal)
        set_normal(parser, normal, n, at);
    return value_vector(3, point);
}
