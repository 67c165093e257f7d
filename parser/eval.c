#include "parser/eval.h"
#include "lib/srgb.h"
#include "parser/build.h"
#include "parser/builtin.h"
#include "parser/expander.h"
#include "parser/formula.h"
#include "parser/grammar.h"
#include "parser/report.h"
#include <math.h>
#include <string.h>

/* ---- numbers ----------------------------------------------------------- */

struct value eval_float(struct parser *parser, const struct value *value,
                        struct location at)
{
    if (formula_is(value)) {
        return *value;
    }
    if (value->kind != VALUE_NUMBER || value->terms != 1) {
        parser_mistake(parser, at, "expected a float, found a %s",
                       value_name(value));
    }
    return value_float(value->kind == VALUE_NUMBER ? value->v[0] : 0);
}

/* Long vectors are for the statements that want them. */
static bool is_number(struct parser *parser, const struct value *value,
                      struct location at)
{
    return value->kind == VALUE_NUMBER ||
           parser_mistake(parser, at, "cannot compute with a %s",
                          value_name(value));
}

struct value eval_binary(struct parser *parser, int op, const struct value *a,
                         const struct value *b, struct location at)
{
    struct value result;
    if (formula_is(a) || formula_is(b)) {
        return formula_binary(parser, op, a, b, at);
    }
    if (!is_number(parser, a, at) || !is_number(parser, b, at)) {
        return value_float(0);
    }
    if (!value_combine((enum value_operator)op, a, b, &result)) {
        parser_warn(parser, at, "division by zero gives infinity");
    }
    return result;
}

struct value eval_negate(struct parser *parser, const struct value *value,
                         struct location at)
{
    if (formula_is(value)) {
        return formula_negate(parser, value, at);
    }
    return is_number(parser, value, at) ? value_negate(*value) : value_float(0);
}

struct value eval_not(struct parser *parser, const struct value *value,
                      struct location at)
{
    if (formula_is(value)) {
        return formula_not(parser, value, at);
    }
    return is_number(parser, value, at) ? value_not(*value) : value_float(0);
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
    if (formula_is(condition)) {
        parser_mistake(parser, at,
                       "'?' cannot be used in a function: use "
                       "'select'");
        return value_float(0);
    }
    return value_is_true(chosen.v[0]) ? *yes : *no;
}

/* The term that a component names; -1: none. */
static int component_index(const struct name *component)
{
    static const struct {
        const char *word;
        int index;
    } names[] = {{"x", 0}, {"u", 0},      {"red", 0},     {"y", 1},
                 {"v", 1}, {"green", 1},  {"z", 2},       {"blue", 2},
                 {"t", 3}, {"filter", 3}, {"transmit", 4}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(component->text, names[i].word) == 0) {
            return names[i].index;
        }
    }
    return -1;
}

static struct value formula_part(struct parser *parser,
                                 const struct value *value,
                                 const struct name *component,
                                 struct location at)
{
    int index = strcmp(component->text, "gray") == 0 ? FORMULA_GRAY
                : strcmp(component->text, "hf") == 0
                    ? FORMULA_HEIGHT
                    : component_index(component);
    if (index < 0) {
        parser_mistake(parser, at, "unknown component '%.40s'",
                       component->text);
        return value_float(0);
    }
    return formula_component(parser, value, (enum formula_part)index, at);
}

struct value eval_component(struct parser *parser, const struct value *value,
                            const struct name *component, struct location at)
{
    if (formula_is(value) || !is_number(parser, value, at)) {
        return formula_is(value) ? formula_part(parser, value, component, at)
                                 : value_float(0);
    }
    if (strcmp(component->text, "gray") == 0) {
        struct value c = value_promote(*value, 3);
        return value_float(0.297 * c.v[0] + 0.589 * c.v[1] + 0.114 * c.v[2]);
    }
    int index = component_index(component);
    if (index < 0) {
        parser_mistake(parser, at, "unknown component '%.40s'",
                       component->text);
        return value_float(0);
    }
    if (value->terms > 1 && index >= value->terms) {
        parser_mistake(parser, at, "a vector of %d terms has no '%s'",
                       value->terms, component->text);
        return value_float(0);
    }
    return value_float(value->v[value->terms > 1 ? index : 0]);
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

static struct value long_vector(struct parser *parser, int count,
                                const struct value *item)
{
    struct list *list = parser_alloc(parser, sizeof *list + (size_t)count *
                                                                sizeof(double));
    struct value value = {.kind = VALUE_LIST, .terms = count};
    if (!list) {
        return value_float(0);
    }
    list->count = count;
    for (int i = 0; i < count; i++) {
        list->term[i] = item[i].v[0];
    }
    value.list = list;
    return value;
}

struct value eval_components(struct parser *parser, int count,
                             struct location at)
{
    const struct value *item = eval_pop(parser, count);
    struct value vector = {.kind = VALUE_NUMBER, .terms = count};
    for (int i = 0; i < count; i++) {
        if (item[i].kind != VALUE_NUMBER || item[i].terms != 1) {
            parser_mistake(parser, at,
                           "a term of a vector is a float, not a "
                           "%s",
                           value_name(&item[i]));
            return value_float(0);
        }
        if (count <= VALUE_TERMS) {
            vector.v[i] = item[i].v[0];
        }
    }
    if (count < 2) {
        parser_mistake(parser, at, "a vector has at least 2 terms");
        return value_float(0);
    }
    return count <= VALUE_TERMS ? vector : long_vector(parser, count, item);
}

struct value eval_call(struct parser *parser, const struct name *function,
                       int count, struct location at)
{
    const struct value *argument = eval_pop(parser, count);
    struct value result = value_float(0);
    for (int i = 0; i < count; i++) {
        if (formula_is(&argument[i])) {
            return formula_builtin(parser, function->text, argument, count, at);
        }
    }
    if (!parser->failed) {
        result = builtin_call(parser, function, argument, count, at);
    }
    bool string = function->keyword->kind == TOK_STRING_FUNCTION;
    return !parser->failed ? result
           : string        ? value_string("", 0)
                           : value_float(0);
}

void eval_data(struct parser *parser, struct data_run run, struct location at)
{
    const char *start = run.text, *next;
    struct location here = at;
    struct value item;
    while (!parser->failed && (next = data_item(&run, &item))) {
        here.offset = at.offset + (uint32_t)(run.text - start);
        build_argument(parser, &item, here);
        expander_spend(parser, 2 * item.terms, here);
        run.text = next;
    }
}

/* ---- colors ------------------------------------------------------------ */

struct color eval_color_rgb(struct parser *parser, const struct name *word,
                            const struct value *value, struct location at)
{
    struct color color = {.given = 7};
    if (!is_number(parser, value, at)) {
        return color;
    }
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
        color.v[i] = srgb ? srgb_decode(v.v[i]) : v.v[i];
    }
    for (int i = 3; i < v.terms; i++) {
        int term = i == 3 && strcmp(rest, "t") == 0 ? 4 : i;
        color.v[term] = v.v[i];
        color.given |= 1u << term;
    }
    return color;
}

struct color eval_color_all(struct parser *parser, const struct value *value,
                            struct location at)
{
    struct color color = {.given = (1u << VALUE_TERMS) - 1};
    if (!is_number(parser, value, at)) {
        return color;
    }
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
