#include "parser/formula.h"

#include <limits.h>
#include <string.h>

#include "parser/build.h"
#include "parser/eval.h"
#include "parser/expander.h"
#include "parser/report.h"

enum formula_kind {
    FORMULA_NUMBER,    /* number                                          */
    FORMULA_PARAMETER, /* index                                           */
    FORMULA_VARIABLE,  /* index: how many sums are around it              */
    FORMULA_OP,        /* index: enum brume_op                            */
    FORMULA_SELECT,    /* condition and two or three values               */
    FORMULA_SERIES,    /* first, last, term; index: enum brume_block      */
    FORMULA_CALL,      /* of the function of core named by index          */
    FORMULA_SPLINE,    /* index: of core's spline; number: kind, or -1 */
    FORMULA_PICK       /* index: the component of its operand             */
};

/* A node of an expression. Nodes may have several users. */
struct formula {
    enum formula_kind kind;
    int index;
    int results; /* numbers that it stands for: 1, 3 or 5   */
    double number;
    int operands;
    const struct formula *operand[];
};

enum { NAMES = BRUME_MAX_PARAMETERS };

/* A function whose text is being read. */
struct formula_scope {
    struct formula_scope *around;
    const struct name *name[NAMES];
    int names;
    bool declared;        /* its names were given: else x, y, z      */
    bool open, suspended; /* the names are in force; were in force   */
    uint32_t level;       /* of the scope of its names               */
    int series;           /* sums that are open                      */
    struct function *made;
    int columns, rows;
};

/* ---- nodes ------------------------------------------------------------- */

static struct formula *new_node(struct parser *parser, enum formula_kind kind,
                                int index, int operands)
{
    struct formula *node = parser_alloc(
        parser, sizeof *node + (size_t)operands * sizeof node->operand[0]);

    if (node) {
        node->kind = kind;
        node->index = index;
        node->results = 1;
        node->operands = operands;
    }
    return node;
}

static struct value of_node(const struct formula *node)
{
    struct value value = {.kind = VALUE_FORMULA};

    if (!node)
        return value_float(0);
    value.formula = node;
    value.terms = node->results;
    return value;
}

/* A number or a formula as an operand, which is one float. */
static const struct formula *
operand_of(struct parser *parser, const struct value *value, struct location at)
{
    if (formula_is(value) && value->formula->results == 1)
        return value->formula;
    if (value->kind != VALUE_NUMBER || value->terms != 1) {
        parser_mistake(parser, at, "a function computes with floats, not %s%s",
                       formula_is(value) ? "with a vector" : "with a ",
                       formula_is(value) ? "" : value_name(value));
        return NULL;
    }
    struct formula *node = new_node(parser, FORMULA_NUMBER, 0, 0);
    if (node)
        node->number = value->v[0];
    return node;
}

/* A node whose operands are values; a number where one is wrong. */
static struct value make(struct parser *parser, enum formula_kind kind,
                         int index, const struct value *value, int count,
                         struct location at)
{
    struct formula *node = new_node(parser, kind, index, count);

    for (int i = 0; node && i < count; i++) {
        node->operand[i] = operand_of(parser, &value[i], at);
        if (!node->operand[i])
            node = NULL;
    }
    return of_node(node);
}

/* ---- expressions ------------------------------------------------------- */

struct value formula_binary(struct parser *parser, int op,
                            const struct value *a, const struct value *b,
                            struct location at)
{
    static const enum brume_op ops[] = {
        [VALUE_ADD] = BRUME_OP_ADD,
        [VALUE_SUBTRACT] = BRUME_OP_SUBTRACT,
        [VALUE_MULTIPLY] = BRUME_OP_MULTIPLY,
        [VALUE_DIVIDE] = BRUME_OP_DIVIDE,
        [VALUE_LESS] = BRUME_OP_LESS,
        [VALUE_LESS_EQUAL] = BRUME_OP_LESS_EQUAL,
        [VALUE_EQUAL] = BRUME_OP_EQUAL,
        [VALUE_NOT_EQUAL] = BRUME_OP_NOT_EQUAL,
        [VALUE_GREATER_EQUAL] = BRUME_OP_GREATER_EQUAL,
        [VALUE_GREATER] = BRUME_OP_GREATER,
        [VALUE_AND] = BRUME_OP_AND,
        [VALUE_OR] = BRUME_OP_OR};
    const struct value both[2] = {*a, *b};

    return make(parser, FORMULA_OP, ops[op], both, 2, at);
}

struct value formula_negate(struct parser *parser, const struct value *a,
                            struct location at)
{
    return make(parser, FORMULA_OP, BRUME_OP_NEGATE, a, 1, at);
}

struct value formula_not(struct parser *parser, const struct value *a,
                         struct location at)
{
    return make(parser, FORMULA_OP, BRUME_OP_NOT, a, 1, at);
}

struct value formula_component(struct parser *parser, const struct value *a,
                               enum formula_part part, struct location at)
{
    int results = a->formula->results;
    struct formula *node;

    if (results == 1)
        return *a;
    if (part == FORMULA_GRAY || part == FORMULA_HEIGHT)
        node = new_node(parser, FORMULA_OP,
                        part == FORMULA_GRAY ? BRUME_OP_GRAY : BRUME_OP_HEIGHT,
                        1);
    else
        node = new_node(parser, FORMULA_PICK, (int)part, 1);
    if ((part == FORMULA_GRAY || part == FORMULA_HEIGHT) ? results != 5
                                                         : (int)part >= results)
        parser_mistake(parser, at, "this function has no such component");
    else if (node)
        node->operand[0] = a->formula;
    return node && node->operand[0] ? of_node(node) : value_float(0);
}

static const struct {
    const char *word;
    enum brume_op op;
    int operands;
} builtins[] = {{"abs", BRUME_OP_ABS, 1},         {"acos", BRUME_OP_ACOS, 1},
                {"acosh", BRUME_OP_ACOSH, 1},     {"asin", BRUME_OP_ASIN, 1},
                {"asinh", BRUME_OP_ASINH, 1},     {"atan", BRUME_OP_ATAN, 1},
                {"atan2", BRUME_OP_ATAN2, 2},     {"atanh", BRUME_OP_ATANH, 1},
                {"ceil", BRUME_OP_CEIL, 1},       {"cos", BRUME_OP_COS, 1},
                {"cosh", BRUME_OP_COSH, 1},       {"div", BRUME_OP_DIV, 2},
                {"degrees", BRUME_OP_DEGREES, 1}, {"exp", BRUME_OP_EXP, 1},
                {"floor", BRUME_OP_FLOOR, 1},     {"int", BRUME_OP_INT, 1},
                {"ln", BRUME_OP_LN, 1},           {"log", BRUME_OP_LOG, 1},
                {"max", BRUME_OP_MAX, 0},         {"min", BRUME_OP_MIN, 0},
                {"mod", BRUME_OP_MOD, 2},         {"pow", BRUME_OP_POW, 2},
                {"radians", BRUME_OP_RADIANS, 1}, {"sin", BRUME_OP_SIN, 1},
                {"sinh", BRUME_OP_SINH, 1},       {"sqr", BRUME_OP_SQR, 1},
                {"sqrt", BRUME_OP_SQRT, 1},       {"tan", BRUME_OP_TAN, 1},
                {"tanh", BRUME_OP_TANH, 1}};

/* min and max take any count: two at a time. */
static struct value fold(struct parser *parser, enum brume_op op,
                         const struct value *argument, int count,
                         struct location at)
{
    struct value pair[2] = {argument[0]};

    for (int i = 1; i < count && !parser->failed; i++) {
        pair[1] = argument[i];
        pair[0] = make(parser, FORMULA_OP, (int)op, pair, 2, at);
    }
    return pair[0];
}

struct value formula_builtin(struct parser *parser, const char *word,
                             const struct value *argument, int count,
                             struct location at)
{
    if (!strcmp(word, "select") && (count == 3 || count == 4))
        return make(parser, FORMULA_SELECT, 0, argument, count, at);
    for (size_t i = 0; i < sizeof builtins / sizeof *builtins; i++) {
        if (strcmp(word, builtins[i].word))
            continue;
        if (builtins[i].operands == 0)
            return fold(parser, builtins[i].op, argument, count, at);
        if (builtins[i].operands == count)
            return make(parser, FORMULA_OP, (int)builtins[i].op, argument,
                        count, at);
        parser_mistake(parser, at, "'%s' takes %d arguments, not %d", word,
                       builtins[i].operands, count);
        return value_float(0);
    }
    parser_mistake(parser, at, "'%s' cannot be used in a function", word);
    return value_float(0);
}

/* ---- calls of functions ------------------------------------------------ */

static struct value evaluate(struct parser *parser,
                             const struct function *function,
                             const struct value *argument, int count,
                             struct location at)
{
    double in[BRUME_MAX_PARAMETERS], out[BRUME_MAX_RESULTS];
    struct brume_error err = {0};

    for (int i = 0; i < count; i++)
        in[i] = argument[i].v[0];
    if (brume_eval_function(parser->out->scene, function->id, in, count, out,
                            &err))
        return value_vector(function->results, out);
    parser_relay(parser, at, &err);
    return value_float(0);
}

/* A point may be given as one vector. */
static int spread(const struct function *function, const struct value *argument,
                  int count, struct value spread[3])
{
    if (count != 1 || function->parameters != 3 ||
        argument->kind != VALUE_NUMBER || argument->terms < 2)
        return 0;
    for (int i = 0; i < 3; i++)
        spread[i] = value_float(value_promote(*argument, 3).v[i]);
    return 3;
}

struct value formula_call(struct parser *parser, const struct value *value,
                          int count, struct location at)
{
    const struct function *function = value->node;
    const struct value *argument = eval_pop(parser, count);
    struct value point[3];
    bool numbers = true;

    if (parser->failed)
        return value_float(0);
    if (spread(function, argument, count, point)) {
        argument = point;
        count = 3;
    }
    if (count != function->parameters) {
        parser_mistake(parser, at, "this function takes %d arguments, not %d",
                       function->parameters, count);
        return value_float(0);
    }
    for (int i = 0; i < count; i++) {
        numbers &= argument[i].kind == VALUE_NUMBER;
        if (!operand_of(parser, &argument[i], at))
            return value_float(0);
    }
    if (numbers)
        return evaluate(parser, function, argument, count, at);
    struct value call = make(parser, FORMULA_CALL, function->id, argument,
                             count, at);
    if (formula_is(&call)) {
        ((struct formula *)call.formula)->results = function->results;
        call.terms = function->results;
    }
    return call;
}

struct value formula_spline(struct parser *parser, int id, int terms, int kind,
                            const struct value *t, struct location at)
{
    struct value value = make(parser, FORMULA_SPLINE, id, t, 1, at);

    if (formula_is(&value)) {
        struct formula *node = (struct formula *)value.formula;
        node->number = kind;
        node->results = value.terms = terms;
    }
    return value;
}

/* ---- writing a formula to core ----------------------------------------- */

/* A node whose operands are being written. */
struct writing {
    const struct formula *node;
    int next;
};

static bool write_node(struct brume_function *function,
                       const struct formula *node, struct brume_error *err)
{
    switch (node->kind) {
    case FORMULA_NUMBER:
        return brume_function_constant(function, node->number, err);
    case FORMULA_PARAMETER:
        return brume_function_parameter(function, node->index, err);
    case FORMULA_VARIABLE:
        return brume_function_variable(function, node->index, err);
    case FORMULA_OP:
        return brume_function_op(function, (enum brume_op)node->index, err);
    case FORMULA_CALL:
        return brume_function_call(function, node->index, node->operands, err);
    case FORMULA_SPLINE:
        return brume_function_spline(function, node->index, (int)node->number,
                                     err);
    case FORMULA_PICK:
        return brume_function_pick(function, node->operand[0]->results,
                                   node->index, err);
    default:
        return brume_function_close(function, err);
    }
}

/* Before operand `i` of a node that is written in parts. */
static bool write_between(struct brume_function *function,
                          const struct formula *node, int i,
                          struct brume_error *err)
{
    int first = node->kind == FORMULA_SERIES ? 2 : 1;

    if ((node->kind != FORMULA_SELECT && node->kind != FORMULA_SERIES) ||
        i < first)
        return true;
    if (i > first)
        return brume_function_next(function, err);
    return brume_function_open(function,
                               node->kind == FORMULA_SELECT
                                   ? BRUME_BLOCK_SELECT
                                   : (enum brume_block)node->index,
                               err);
}

/* With a stack in place of recursion: brackets nest as deep as one likes. */
static bool write_formula(struct parser *parser, struct brume_function *to,
                          const struct formula *root, struct brume_error *err)
{
    void *stack = NULL;
    size_t room = 0, depth = 1;

    if (!arena_grow(&parser->arena, &stack, &room, 1, sizeof(struct writing)))
        return report_no_memory(parser);
    *(struct writing *)stack = (struct writing){root, 0};
    while (depth > 0) {
        struct writing *top = (struct writing *)stack + depth - 1;
        if (top->next == top->node->operands) {
            if (!write_node(to, top->node, err))
                return false;
            depth--;
            continue;
        }
        const struct formula *operand = top->node->operand[top->next];
        if (!write_between(to, top->node, top->next++, err))
            return false;
        if (!arena_grow(&parser->arena, &stack, &room, depth + 1, sizeof *top))
            return report_no_memory(parser);
        ((struct writing *)stack)[depth++] = (struct writing){operand, 0};
    }
    return true;
}

static void made(struct parser *parser, int id, struct location at,
                 struct brume_error *err)
{
    struct formula_scope *scope = parser->formula;
    struct function *function = parser_alloc(parser, sizeof *function);

    if (id < 0 && err->code != BRUME_OK)
        parser_relay(parser, at, err);
    if (id < 0 || !function || parser->failed)
        return;
    function->id = id;
    function->columns = scope->columns;
    function->rows = scope->rows;
    brume_function_arity(parser->out->scene, id, &function->parameters,
                         &function->results);
    scope->made = function;
}

void formula_body(struct parser *parser, const struct value *value,
                  struct location at)
{
    struct brume_error err = {0};
    struct formula_scope *scope = parser->formula;
    const struct formula *root = value->kind == VALUE_FORMULA
                                     ? value->formula
                                     : operand_of(parser, value, at);

    if (parser->failed || !root)
        return;
    struct brume_function *function = brume_function_new(parser->out->scene,
                                                         scope->names, &err);
    if (!function || !write_formula(parser, function, root, &err)) {
        brume_function_free(function);
        if (!parser->failed)
            parser_relay(parser, at, &err);
        return;
    }
    made(parser, brume_add_function(parser->out->scene, function, &err), at,
         &err);
}

/* Of 4 parameters, for what Brume has no formula of: no number. */
static int add_nothing(struct parser *parser, struct brume_error *err)
{
    struct brume_function *to = brume_function_new(parser->out->scene, 4, err);

    if (to && brume_function_constant(to, 0, err) &&
        brume_function_constant(to, 0, err) &&
        brume_function_op(to, BRUME_OP_DIVIDE, err))
        return brume_add_function(parser->out->scene, to, err);
    brume_function_free(to);
    return -1;
}

/* POV-Ray's functions.inc declares f_comma, whoever uses it. */
void formula_internal(struct parser *parser, const struct value *number,
                      struct location at)
{
    enum { COMMA = 9 };
    struct brume_error err = {0};
    double which = number->v[0];
    int id;

    if (parser->failed)
        return;
    if (!(which > INT_MIN && which < INT_MAX)) {
        parser_error(parser, at, "there is no internal function %g", which);
        return;
    }
    if ((int)which == COMMA) {
        parser_warn(parser, at,
                    "internal(9), f_comma, is not there yet: it "
                    "gives no number");
        id = add_nothing(parser, &err);
    } else {
        id = brume_add_internal(parser->out->scene, (int)which, &err);
    }
    made(parser, id, at, &err);
}

void formula_statement(struct parser *parser, struct location at)
{
    struct value value = build_close(parser, at);
    struct brume_error err = {0};

    build_resume(parser);
    if (!parser->failed)
        made(parser, build_function(parser, &value, at, &err), at, &err);
}

/* ---- the text of a function -------------------------------------------- */

static struct formula_scope *new_scope(struct parser *parser)
{
    struct formula_scope *scope = parser_alloc(parser, sizeof *scope);

    if (scope) {
        scope->around = parser->formula;
        parser->formula = scope;
    }
    return scope;
}

/* The scope of the function whose '{' has not come yet. */
static struct formula_scope *announced(struct parser *parser)
{
    struct formula_scope *scope = parser->formula;

    return scope && !scope->open && !scope->suspended ? scope
                                                      : new_scope(parser);
}

void formula_parameter(struct parser *parser, const struct name *name)
{
    struct formula_scope *scope = announced(parser);

    if (!scope)
        return;
    if (scope->names == NAMES)
        parser_error(parser, expander_place(parser),
                     "a function has at most %d parameters", NAMES);
    else
        scope->name[scope->names++] = name;
    scope->declared = true;
    expander_want_name(parser, true);
}

void formula_parameters(struct parser *parser)
{
    expander_want_name(parser, false);
}

void formula_grid(struct parser *parser, struct location at)
{
    const struct value *size = eval_pop(parser, 2);
    struct formula_scope *scope = announced(parser);

    if (!scope)
        return;
    for (int i = 0; i < 2; i++)
        if (!(size[i].v[0] >= 2 && size[i].v[0] <= 65536)) {
            parser_error(parser, at,
                         "a height field has 2 to 65536 columns "
                         "and rows");
            return;
        }
    scope->columns = (int)size[0].v[0];
    scope->rows = (int)size[1].v[0];
}

/* Makes a name stand for a formula in the innermost scope of names. */
static void stand_for(struct parser *parser, const struct name *name,
                      enum formula_kind kind, int index)
{
    struct symbol *symbol = symbols_local(&parser->symbols,
                                          (struct name *)name);

    if (!symbol) {
        report_no_memory(parser);
        return;
    }
    symbol->refers = NULL;
    symbol->value = of_node(new_node(parser, kind, index, 0));
}

void formula_open(struct parser *parser)
{
    static const struct {
        const char *word;
        int index;
    } usual[] = {{"x", 0}, {"y", 1}, {"z", 2}, {"u", 0}, {"v", 1}};
    struct formula_scope *scope = announced(parser);

    if (!scope || !symbols_enter(&parser->symbols)) {
        report_no_memory(parser);
        return;
    }
    scope->open = true;
    scope->level = parser->symbols.level;
    for (int i = 0; i < scope->names; i++)
        stand_for(parser, scope->name[i], FORMULA_PARAMETER, i);
    if (scope->declared)
        return;
    scope->names = 3;
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) {
        struct name *name = symbols_name(&parser->symbols, usual[i].word, 1);
        stand_for(parser, name, FORMULA_PARAMETER, usual[i].index);
    }
}

/* A macro that ends inside of the body has taken them with it. */
static void leave_names(struct parser *parser,
                        const struct formula_scope *scope)
{
    while (parser->symbols.level >= scope->level)
        symbols_leave(&parser->symbols);
}

void formula_suspend(struct parser *parser)
{
    struct formula_scope *scope = parser->formula;

    if (!scope || !scope->open)
        return;
    leave_names(parser, scope);
    scope->open = false;
    scope->suspended = true;
}

struct value formula_close(struct parser *parser)
{
    struct formula_scope *scope = parser->formula;

    if (!scope)
        return (struct value){.kind = VALUE_NONE};
    if (scope->open)
        leave_names(parser, scope);
    parser->formula = scope->around;
    if (!scope->made)
        return (struct value){.kind = VALUE_NONE};
    return value_node(VALUE_FUNCTION, scope->made);
}

void formula_reset(struct parser *parser)
{
    parser->formula = NULL;
}

/* ---- sums and products ------------------------------------------------- */

void formula_series_open(struct parser *parser, const struct name *name)
{
    if (!parser->formula || !parser->formula->open) {
        parser_error(parser, expander_place(parser),
                     "'sum' and 'prod' belong into functions");
    } else if (!symbols_enter(&parser->symbols)) {
        report_no_memory(parser);
    } else {
        stand_for(parser, name, FORMULA_VARIABLE, parser->formula->series++);
    }
}

struct value formula_series_close(struct parser *parser,
                                  const struct name *word,
                                  const struct value *first,
                                  const struct value *last,
                                  const struct value *term, struct location at)
{
    const struct value parts[3] = {*first, *last, *term};

    if (parser->failed || !parser->formula)
        return value_float(0);
    if (parser->symbols.level > parser->formula->level)
        symbols_leave(&parser->symbols);
    parser->formula->series--;
    return make(parser, FORMULA_SERIES,
                !strcmp(word->text, "sum") ? BRUME_BLOCK_SUM : BRUME_BLOCK_PROD,
                parts, 3, at);
}
