#include "parser/eval.h"
#include "parser/builtin.h"
#include "parser/grammar.h"
#include "parser/report.h"
#include <math.h>
#include <string.h>

/* ---- numbers ----------------------------------------------------------- */

struct value eval_float(struct parser *parser, const struct value *value,
                        struct location at)
{
    if (value->terms != 1) {
        parser_error(parser, at, "expected a float, found a %s",
                     value_name(value));
    }
    return value_float(value->v[0]);
}

struct value eval_binary(struct parser *parser, int op, const struct value *a,
                         const struct value *b, struct location at)
{
    struct value result;
    if (!value_combine((enum value_operator)op, a, b, &result)) {
        parser_warn(parser, at, "division by zero gives infinity");
    }
    return result;
}

struct value eval_compare(int op, const struct value *a, const struct value *b)
{
    struct value order = value_float(
        value_compare_strings(a->string, b->string));
    struct value zero = value_float(0), result;
    value_combine((enum value_operator)op, &order, &zero, &result);
    return result;
}

struct value eval_choice(struct parser *parser, const struct value *condition,
                         const struct value *yes, const struct value *no,
                         struct location at)
{
    struct value chosen = eval_float(parser, condition, at);
    return value_is_true(chosen.v[0]) ? *yes : *no;
}

struct value eval_component(struct parser *parser, const struct value *value,
                            const struct name *component, struct location at)
{
    static const struct {
        const char *word;
        int index;
    } names[] = {{"x", 0}, {"u", 0},      {"red", 0},     {"y", 1},
                 {"v", 1}, {"green", 1},  {"z", 2},       {"blue", 2},
                 {"t", 3}, {"filter", 3}, {"transmit", 4}};
    if (strcmp(component->text, "gray") == 0) {
        struct value c = value_promote(*value, 3);
        return value_float(0.297 * c.v[0] + 0.589 * c.v[1] + 0.114 * c.v[2]);
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(component->text, names[i].word) != 0) {
            continue;
        }
        if (value->terms > 1 && names[i].index >= value->terms) {
            parser_error(parser, at, "a vector of %d terms has no '%s'",
                         value->terms, component->text);
        }
        return value_float(value->v[value->terms > 1 ? names[i].index : 0]);
    }
    parser_error(parser, at, "unknown component '%.40s'", component->text);
    return value_float(0);
}

/* ---- lists ------------------------------------------------------------- */

void eval_push(struct parser *parser, const struct value *item)
{
    void *stack = parser->stack;
    if (!arena_grow(&parser->arena, &stack, &parser->stack_room,
                    parser->stacked + 1, sizeof *item)) {
        report_no_memory(parser);
        return;
    }
    parser->stack = stack;
    parser->stack[parser->stacked++] = *item;
}

/* They stay where they are until the next push. */
const struct value *eval_pop(struct parser *parser, int count)
{
    size_t items = (size_t)count;
    parser->stacked -= items < parser->stacked ? items : parser->stacked;
    return parser->stack + parser->stacked;
}

struct value eval_components(struct parser *parser, int count,
                             struct location at)
{
    const struct value *item = eval_pop(parser, count);
    struct value vector = {.kind = VALUE_NUMBER, .terms = count};
    if (count < 2 || count > VALUE_TERMS) {
        parser_error(parser, at, "a vector has 2 to %d terms, not %d",
                     VALUE_TERMS, count);
        return value_float(0);
    }
    for (int i = 0; i < count && !parser->failed; i++) {
        vector.v[i] = eval_float(parser, &item[i], at).v[0];
    }
    return vector;
}

struct value eval_call(struct parser *parser, const struct name *function,
                       int count, struct location at)
{
    const struct value *argument = eval_pop(parser, count);
    struct value result = value_float(0);
    if (!parser->failed) {
        result = builtin_call(parser, function, argument, count, at);
    }
    bool string = function->keyword->kind == TOK_STRING_FUNCTION;
    return !parser->failed ? result
           : string        ? value_string("", 0)
                           : value_float(0);
}

/* ---- colors ------------------------------------------------------------ */

/* IEC 61966-2-1: the linear value of an sRGB channel; odd below 0. */
static double linear(double x)
{
    if (x < 0) {
        return -linear(-x);
    }
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

struct color eval_color_rgb(struct parser *parser, const struct name *word,
                            const struct value *value, struct location at)
{
    struct color color = {.given = 7};
    bool srgb = word->text[0] == 's';
    const char *rest = word->text + (srgb ? 4 : 3);
    int terms = 3 + (int)strlen(rest);
    if (value->terms > terms) {
        parser_warn(parser, at, "%s takes %d terms, %d were given", word->text,
                    terms, value->terms);
    }
    struct value v = value_promote(*value,
                                   value->terms > terms ? value->terms : terms);
    for (int i = 0; i < 3; i++) {
        color.v[i] = srgb ? linear(v.v[i]) : v.v[i];
    }
    for (int i = 3; i < v.terms; i++) {
        int term = i == 3 && strcmp(rest, "t") == 0 ? 4 : i;
        color.v[term] = v.v[i];
        color.given |= 1u << term;
    }
    return color;
}

struct color eval_color_all(const struct value *value)
{
    struct color color = {.given = (1u << VALUE_TERMS) - 1};
    struct value v = value_promote(*value, VALUE_TERMS);
    memcpy(color.v, v.v, sizeof color.v);
    return color;
}

struct color eval_color_term(struct parser *parser, int term,
                             const struct value *value, struct location at)
{
    struct color color = {.given = 1u << term};
    color.v[term] = eval_float(parser, value, at).v[0];
    return color;
}

struct color eval_color_join(const struct color *a, const struct color *b)
{
    struct color color = *a;
    for (int i = 0; i < VALUE_TERMS; i++) {
        color.v[i] = b->given >> i & 1 ? b->v[i] : a->v[i];
    }
    color.given |= b->given;
    return color;
}

struct value eval_color(const struct color *color)
{
    return value_vector(VALUE_TERMS, color->v);
}

struct value eval_color_set(const struct value *value,
                            const struct color *color)
{
    struct color base = eval_color_all(value);
    struct color joined = eval_color_join(&base, color);
    return eval_color(&joined);
}

/* ---- arrays ------------------------------------------------------------ */

static struct value empty_array(struct parser *parser)
{
    struct value value = {.kind = VALUE_ARRAY};
    value.array = parser_alloc(parser, sizeof *value.array);
    return value;
}

struct value eval_list(struct parser *parser, int count)
{
    const struct value *item = eval_pop(parser, count);
    struct value value = empty_array(parser);
    struct value *copy = parser_array(parser, (size_t)count, sizeof *copy);
    if (!value.array || !copy) {
        return value_float(0);
    }
    memcpy(copy, item, (size_t)count * sizeof *copy);
    *value.array = (struct array){
        .rank = 1, .count = (uint32_t)count, .item = copy, .list = true};
    value.array->size[0] = (uint32_t)count;
    return value;
}

/* Copies a list of lists into the items of an array from dimension `depth`
 * on; the depth is at most VALUE_RANK. */
static bool fill(struct parser *parser, const struct array *array, int depth,
                 const struct value *from, struct value *to, struct location at)
{
    uint32_t count = array->size[depth], step = 1;
    for (int i = depth + 1; i < array->rank; i++) {
        step *= array->size[i];
    }
    if (from->kind != VALUE_ARRAY || !from->array->list) {
        return parser_error(parser, at,
                            "dimension %d of the array needs a "
                            "list in braces",
                            depth + 1);
    }
    if (from->array->count != count) {
        return parser_error(parser, at,
                            "dimension %d of the array has %u "
                            "items, not %u",
                            depth + 1, count, from->array->count);
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct value *item = &from->array->item[i];
        if (depth + 1 < array->rank) {
            if (!fill(parser, array, depth + 1, item, to + i * step, at)) {
                return false;
            }
        } else if (item->kind == VALUE_ARRAY && item->array->list) {
            return parser_error(parser, at,
                                "the array has %d dimensions, "
                                "the list has more",
                                array->rank);
        } else {
            to[i] = *item;
        }
    }
    return true;
}

static bool set_sizes(struct parser *parser, struct array *array, int rank,
                      struct location at)
{
    const struct value *size = eval_pop(parser, rank);
    double count = 1;
    if (rank > VALUE_RANK) {
        return parser_error(parser, at, "an array has at most %d dimensions",
                            VALUE_RANK);
    }
    array->rank = rank;
    for (int i = 0; i < rank; i++) {
        double whole = trunc(size[i].v[0]);
        if (!(whole >= 1)) {
            return parser_error(parser, at,
                                "size %g of dimension %d is less "
                                "than 1",
                                size[i].v[0], i + 1);
        }
        count *= whole;
        if (count > UINT32_MAX) {
            return parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                               "the array has %g items, more than 2^32", count);
        }
        array->size[i] = (uint32_t)whole;
    }
    array->count = (uint32_t)count;
    return true;
}

struct value eval_array(struct parser *parser, int rank,
                        const struct value *list, struct location at)
{
    struct value value = empty_array(parser);
    struct array *array = value.array;
    if (parser->failed || !set_sizes(parser, array, rank, at)) {
        return value_float(0);
    }
    array->item = parser_array(parser, array->count, sizeof *array->item);
    if (!array->item ||
        (list && !fill(parser, array, 0, list, array->item, at))) {
        return value_float(0);
    }
    return value;
}

struct value eval_array_copy(struct parser *parser, const struct value *array)
{
    struct value value = empty_array(parser);
    const struct array *from = array->array;
    struct value *item = parser_array(parser, from->count, sizeof *item);
    if (!value.array || !item) {
        return value_float(0);
    }
    memcpy(item, from->item, from->count * sizeof *item);
    *value.array = *from;
    value.array->item = item;
    return value;
}

struct value eval_dimension_size(struct parser *parser,
                                 const struct value *array,
                                 const struct value *dimension,
                                 struct location at)
{
    double which = trunc(dimension->v[0]);
    if (!(which >= 1 && which <= array->array->rank)) {
        parser_error(parser, at, "the array has %d dimensions, not %g",
                     array->array->rank, which);
        return value_float(0);
    }
    return value_float(array->array->size[(int)which - 1]);
}
