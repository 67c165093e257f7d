/* macro.c - macros: their definition, and calls with arguments. */
#include "parser/expand.h"
#include "parser/report.h"
#include <stdio.h>

/* ---- definition -------------------------------------------------------- */

/* A name that may be declared; NULL: reported. */
static struct name *need_free_name(struct expander *expander)
{
    struct location at = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (name && name->symbol && name->symbol->constant) {
        parser_error(expander->parser, at,
                     "'%s' is built in and cannot be "
                     "declared",
                     name->text);
        return NULL;
    }
    return name;
}

/* How many names stand before the ')' that ends them. */
static int count_names(const struct expander *expander)
{
    const struct token *token = expand_peek(expander);
    int count = 0;
    for (; token->kind == TOK_IDENTIFIER || token->kind == ','; token++) {
        count += token->kind == TOK_IDENTIFIER;
    }
    return count;
}

/* Commas between parameters may be left out. */
static bool read_parameters(struct expander *expander, struct macro *macro)
{
    if (!expand_need(expander, '(')) {
        return false;
    }
    macro->parameter = parser_array(expander->parser,
                                    (size_t)count_names(expander),
                                    sizeof *macro->parameter);
    if (!macro->parameter) {
        return false;
    }
    while (!expand_take(expander, ')')) {
        struct name *name = need_free_name(expander);
        if (!name) {
            return false;
        }
        macro->parameter[macro->parameters++] = name;
        expand_take(expander, ',');
    }
    return true;
}

/* A macro that is defined again, in a loop say, stays what it is. */
static bool is_defined(const struct expander *expander, const struct name *name,
                       size_t at)
{
    const struct value *value = symbols_find(name);
    return value && value->kind == VALUE_MACRO &&
           value->macro->chunk == expand_frame(expander)->cursor.chunk &&
           value->macro->define == at;
}

bool macro_define(struct expander *expander)
{
    struct parser *parser = expander->parser;
    struct cursor *cursor = &expand_frame(expander)->cursor;
    uint32_t opener = (uint32_t)cursor->next - 1;
    struct name *name = branch_is_closed(expander, opener)
                            ? need_free_name(expander)
                            : NULL;
    size_t end = cursor->chunk->token[opener].block.pair;
    if (!name) {
        return false;
    }
    if (!is_defined(expander, name, opener)) {
        struct macro *macro = parser_alloc(parser, sizeof *macro);
        if (!macro || !read_parameters(expander, macro)) {
            return false;
        }
        struct symbol *symbol = symbols_declare(&parser->symbols, name);
        if (!symbol) {
            return report_no_memory(parser);
        }
        macro->name = name;
        macro->chunk = cursor->chunk;
        macro->chunk->kept = true;
        macro->define = opener;
        macro->body = cursor->next;
        symbol_value(symbol)->kind = VALUE_MACRO;
        symbol_value(symbol)->macro = macro;
    }
    cursor_jump(cursor, end + 1);
    return true;
}

/* ---- calls ------------------------------------------------------------- */

static struct call *innermost(const struct expander *expander)
{
    return &expander->call[expander->calls - 1];
}

static bool open_call(struct expander *expander, struct macro *macro,
                      struct location at)
{
    struct call *grown = expand_grow(expander, expander->call,
                                     &expander->call_room, expander->calls + 1,
                                     sizeof *grown);
    if (!grown) {
        return false;
    }
    expander->call = grown;
    grown[expander->calls++] = (struct call){
        .macro = macro, .at = at, .first = expander->actuals};
    return true;
}

static bool add_actual(struct expander *expander, const struct value *value,
                       struct value *refers)
{
    struct actual *grown = expand_grow(expander, expander->actual,
                                       &expander->actual_room,
                                       expander->actuals + 1, sizeof *grown);
    if (!grown) {
        return false;
    }
    expander->actual = grown;
    grown[expander->actuals++] = (struct actual){*value, refers};
    innermost(expander)->count++;
    return true;
}

/* Parameters are locals of the macro; one that was given an identifier stands
 * for that. */
static bool bind(struct expander *expander, const struct call *call)
{
    struct parser *parser = expander->parser;
    if (!symbols_enter(&parser->symbols)) {
        return report_no_memory(parser);
    }
    for (int i = 0; i < call->count; i++) {
        const struct actual *actual =
            &expander->actual[call->first + (size_t)i];
        struct symbol *symbol = symbols_local(&parser->symbols,
                                              call->macro->parameter[i]);
        if (!symbol) {
            return report_no_memory(parser);
        }
        symbol->refers = actual->refers;
        symbol->value = actual->value;
    }
    return true;
}

static bool wrong_count(struct expander *expander, const struct call *call,
                        const char *given)
{
    int wanted = call->macro->parameters;
    return parser_error(expander->parser, call->at,
                        "macro '%.40s' takes %d argument%s, %s given",
                        call->macro->name->text, wanted, wanted == 1 ? "" : "s",
                        given);
}

static bool enter(struct expander *expander)
{
    struct parser *parser = expander->parser;
    struct call call = *innermost(expander);
    struct macro *macro = call.macro;
    int most = parser->limits.macro_depth;
    if (call.count != macro->parameters) {
        char given[16];
        snprintf(given, sizeof given, "%d", call.count);
        return wrong_count(expander, &call, given);
    }
    if (expander->frames - expander->texts >= (size_t)most) {
        return parser_fail(parser, BRUME_ERR_LIMIT, call.at, NULL,
                           "macros are called deeper than %d", most);
    }
    struct frame frame = {
        .cursor = {.chunk = macro->chunk, .next = macro->body},
        .macro = macro,
        .called = call.at};
    expander->calls--;
    expander->actuals = call.first;
    return bind(expander, &call) && expand_enter(expander, &frame);
}

/* ---- arguments --------------------------------------------------------- */

static bool ends_argument(const struct token *token)
{
    return token->kind == ',' || token->kind == ')';
}

static bool begin_argument(struct expander *expander)
{
    return expand_begin(expander, TOK_MODE_VALUE, USE_ARGUMENT,
                        innermost(expander)->at);
}

/* An identifier alone is passed by reference, everything else by value. */
enum found { FOUND_TAKEN, FOUND_OTHER, FOUND_ERROR };

static enum found find_reference(struct expander *expander)
{
    const struct token *token = expand_peek(expander);
    if (expander->held || token->kind != TOK_IDENTIFIER ||
        !ends_argument(&token[1])) {
        return FOUND_OTHER;
    }
    struct value *value = symbols_find(token->name);
    if (!value && !token->name->keyword) {
        report_undeclared(expander->parser, token_location(token), token->name);
        return FOUND_ERROR;
    }
    if (!value || token->name->symbol->constant || value->kind == VALUE_MACRO) {
        return FOUND_OTHER;
    }
    expand_skip(expander);
    directive_used(expander, token);
    return add_actual(expander, value, value) ? FOUND_TAKEN : FOUND_ERROR;
}

/* `Array[`: an item, which is passed by reference if nothing follows it. */
static bool seeks_item(struct expander *expander)
{
    const struct token *token = expand_peek(expander);
    const struct value *value = !expander->held && token->kind == TOK_IDENTIFIER
                                    ? symbols_find(token->name)
                                    : NULL;
    return value && value->kind == VALUE_ARRAY && token[1].kind == '[';
}

/* An argument that is made of floats alone. */
static enum found find_float(struct expander *expander)
{
    double x;
    const struct token *end = expand_scalar(expander, 0, false, &x);
    if (!end || !ends_argument(end)) {
        return FOUND_OTHER;
    }
    struct value value = value_float(x);
    bool taken = expand_skip_to(expander, end) &&
                 add_actual(expander, &value, NULL);
    return taken ? FOUND_TAKEN : FOUND_ERROR;
}

static bool read_arguments(struct expander *expander)
{
    for (;;) {
        const struct call *call = innermost(expander);
        if (expand_take(expander, ')')) {
            return enter(expander);
        }
        if (call->count >= call->macro->parameters) {
            return expand_peek(expander)->kind == ','
                       ? wrong_count(expander, call, "more are")
                       : expand_need(expander, ')');
        }
        if (call->count > 0) {
            expand_take(expander, ',');
        }
        if (seeks_item(expander)) {
            const struct token *token = expand_peek(expander);
            struct seek seek = {.item = symbols_find(token->name),
                                .use = ITEM_ARGUMENT};
            expand_skip(expander);
            return item_seek(expander, &seek, token_location(token));
        }
        enum found found = find_reference(expander);
        found = found == FOUND_OTHER ? find_float(expander) : found;
        if (found != FOUND_TAKEN) {
            return found == FOUND_OTHER && begin_argument(expander);
        }
    }
}

bool macro_call(struct expander *expander, struct macro *macro,
                struct location at)
{
    return expand_need(expander, '(') && open_call(expander, macro, at) &&
           read_arguments(expander);
}

bool macro_argument(struct expander *expander, const struct value *value,
                    struct value *refers)
{
    return add_actual(expander, value, refers) && read_arguments(expander);
}

bool macro_item(struct expander *expander, struct value *item,
                struct location at)
{
    if (ends_argument(expand_peek(expander))) {
        return macro_argument(expander, item, item);
    }
    if (!begin_argument(expander)) {
        return false;
    }
    expand_hold(expander, item, at);
    return true;
}
