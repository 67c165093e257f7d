/* directive.c - the directives that stand alone. */
#include "parser/expand.h"
#include "parser/report.h"
#include <string.h>

/* ---- #declare, #local, #undef ------------------------------------------ */

bool directive_may_declare(struct expander *expander, const struct name *name,
                           struct location at)
{
    return !name->symbol || !name->symbol->constant ||
           parser_error(expander->parser, at,
                        "'%s' is built in and cannot "
                        "be declared",
                        name->text);
}

static bool assign(struct expander *expander, const struct target *target,
                   const struct value *value)
{
    struct symbols *symbols = &expander->parser->symbols;
    if (target->item) {
        *target->item = *value;
        return true;
    }
    struct symbol *symbol = target->local
                                ? symbols_local_at(symbols, target->name,
                                                   target->level)
                                : symbols_declare(symbols, target->name);
    if (!symbol) {
        return report_no_memory(expander->parser);
    }
    symbol->deprecated = target->deprecated;
    *symbol_value(symbol) = *value;
    return true;
}

/* The '=' and the value. */
static bool begin_value(struct expander *expander, const struct target *target,
                        struct location at)
{
    double x;
    if (!expand_need(expander, '=')) {
        return false;
    }
    const struct token *end = expand_scalar(expander, 0, false, &x);
    if (end && end->kind == ';') {
        struct value value = value_float(x);
        return expand_skip_to(expander, end + 1) &&
               assign(expander, target, &value);
    }
    struct pending *pending = expand_begin(expander, TOK_MODE_VALUE,
                                           USE_DECLARE, at);
    if (pending) {
        pending->target = *target;
    }
    return pending;
}

bool directive_take_word(struct expander *expander, const char *word)
{
    const struct token *token = expand_peek(expander);
    return (token->kind == TOK_UNSUPPORTED || token->kind == TOK_WORD) &&
           strcmp(token->name->text, word) == 0 &&
           expand_take(expander, token->kind);
}

/* `deprecated once "text"`, of which all may be left out but the first. */
static bool read_deprecation(struct expander *expander,
                             struct deprecation **deprecated)
{
    *deprecated = NULL;
    if (!directive_take_word(expander, "deprecated")) {
        return true;
    }
    *deprecated = parser_alloc(expander->parser, sizeof **deprecated);
    if (!*deprecated) {
        return false;
    }
    (*deprecated)->once = directive_take_word(expander, "once");
    const struct token *token = expand_peek(expander);
    if (expand_take(expander, TOK_STRING)) {
        (*deprecated)->text = *token->string;
    }
    return true;
}

void directive_used(struct expander *expander, const struct token *token)
{
    const struct symbol *symbol = token->name->symbol;
    struct deprecation *deprecated = symbol ? symbol->deprecated : NULL;
    if (!deprecated || (deprecated->once && deprecated->told)) {
        return;
    }
    deprecated->told = true;
    if (deprecated->text.length > 0) {
        parser_warn(expander->parser, token_location(token), "%s",
                    deprecated->text.text);
    } else {
        parser_warn(expander->parser, token_location(token),
                    "'%.40s' was declared deprecated", token->name->text);
    }
}

static bool seek_item(struct expander *expander, const struct name *array,
                      enum item_use use, struct location at)
{
    struct seek seek = {.item = symbols_find(array), .use = use};
    return seek.item && seek.item->kind == VALUE_ARRAY
               ? item_seek(expander, &seek, at)
               : parser_error(expander->parser, at, "'%.40s' is not an array",
                              array->text);
}

static bool declare(struct expander *expander, const struct token *token)
{
    struct deprecation *deprecated;
    if (!read_deprecation(expander, &deprecated)) {
        return false;
    }
    struct location at = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (!name || !directive_may_declare(expander, name, at)) {
        return false;
    }
    if (expand_peek(expander)->kind == '[') {
        return seek_item(expander, name, ITEM_DECLARE, at);
    }
    struct target target = {.name = name,
                            .local = token->kind == TOK_HASH_LOCAL,
                            .level = expander->parser->symbols.level,
                            .deprecated = deprecated};
    return begin_value(expander, &target, at);
}

bool directive_declare_item(struct expander *expander, struct value *item,
                            struct location at)
{
    return begin_value(expander, &(struct target){.item = item}, at);
}

/* As POV-Ray does from 3.5 on. */
bool directive_strict(const struct expander *expander)
{
    return expander->parser->version >= 3.5;
}

static bool check_semicolon(struct expander *expander,
                            const struct value *value)
{
    struct parser *parser = expander->parser;
    if (expand_take(expander, ';') || value->kind != VALUE_NUMBER) {
        return true;
    }
    if (!directive_strict(expander)) {
        parser_warn(parser, expander->place, "no ';' after this value");
        return true;
    }
    return parser_fail(parser, BRUME_ERR_SCENE, expander->place,
                       "floats, vectors and colors are declared with ';' "
                       "behind them",
                       "expected ';' after this value");
}

static bool finish_declare(struct expander *expander,
                           const struct pending *pending)
{
    const struct value *value = &expander->result;
    return assign(expander, &pending->target, value) &&
           check_semicolon(expander, value);
}

static bool undefine(struct expander *expander)
{
    struct location at = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (!name || !directive_may_declare(expander, name, at)) {
        return false;
    }
    if (expand_peek(expander)->kind == '[') {
        return seek_item(expander, name, ITEM_UNDEF, at);
    }
    if (!name->symbol) {
        parser_warn(expander->parser, at, "'%.40s' is not declared",
                    name->text);
    }
    symbols_undefine(name);
    expand_take(expander, ';');
    return true;
}

/* ---- #include, #version ------------------------------------------------ */

static bool include(struct expander *expander, const struct pending *pending)
{
    struct parser *parser = expander->parser;
    int most = parser->limits.include_depth;
    if (expander->texts > (size_t)most) {
        return parser_fail(parser, BRUME_ERR_LIMIT, pending->at, NULL,
                           "files are included deeper than %d", most);
    }
    struct frame frame = {.called = pending->at};
    struct source *source = source_open(parser, expander->place,
                                        expander->result.string);
    return source && reader_open(parser, source, &frame.cursor) &&
           (symbols_enter(&parser->symbols) || report_no_memory(parser)) &&
           expand_enter(expander, &frame);
}

static bool set_version(struct expander *expander)
{
    struct parser *parser = expander->parser;
    const struct value *value = &expander->result;
    struct symbol *symbol =
        symbols_name(&parser->symbols, "version", 7)->symbol;
    if (value->kind != VALUE_NUMBER || value->terms != 1) {
        return parser_error(parser, expander->place,
                            "expected a float, found a %s", value_name(value));
    }
    parser->version = value->v[0];
    symbol->value = *value;
    expand_take(expander, ';');
    return true;
}

/* ---- messages ---------------------------------------------------------- */

static bool message(struct expander *expander, const struct pending *pending)
{
    static const enum parse_stream stream[] = {[USE_DEBUG] = PARSE_DEBUG,
                                               [USE_WARNING] = PARSE_WARNING,
                                               [USE_ERROR] = PARSE_ERROR};
    struct parser *parser = expander->parser;
    const struct parse_input *in = parser->in;
    struct string text = expander->result.string;
    if (in->message) {
        in->message(in->user, stream[pending->use], text.text);
    }
    while (text.length > 0 && strchr(" \r\n", text.text[text.length - 1])) {
        text.length--;
    }
    if (pending->use == USE_WARNING) {
        parser_warn(parser, pending->at, "%.*s", (int)text.length, text.text);
    }
    if (pending->use != USE_ERROR) {
        return true;
    }
    parser->fatal = true;
    return parser_error(parser, pending->at, "%.*s", (int)text.length,
                        text.text);
}

/* ---- which is which ---------------------------------------------------- */

bool directive_run_bare(struct expander *expander, const struct token *token)
{
    static const struct {
        const char *word;
        uint16_t kind;
    } bare[] = {{"declare", TOK_HASH_DECLARE},
                {"default", TOK_HASH_DEFAULT},
                {"include", TOK_HASH_INCLUDE}};
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++) {
        if (strcmp(token->name->text, bare[i].word) == 0) {
            struct token directive = *token;
            directive.kind = bare[i].kind;
            parser_warn(expander->parser, token_location(token),
                        "'%s' should have a '#' before it", bare[i].word);
            expand_skip(expander);
            return directive_run(expander, &directive);
        }
    }
    report_bad(expander->parser, token);
    return false;
}

bool directive_run(struct expander *expander, const struct token *token)
{
    struct location at = token_location(token);
    switch (token->kind) {
    case TOK_HASH_DECLARE:
    case TOK_HASH_LOCAL:
        return declare(expander, token);
    case TOK_HASH_UNDEF:
        return undefine(expander);
    case TOK_HASH_MACRO:
        return macro_define(expander);
    case TOK_HASH_INCLUDE:
        return expand_begin(expander, TOK_MODE_STRING, USE_INCLUDE, at);
    case TOK_HASH_DEBUG:
        return expand_begin(expander, TOK_MODE_STRING, USE_DEBUG, at);
    case TOK_HASH_WARNING:
        return expand_begin(expander, TOK_MODE_STRING, USE_WARNING, at);
    case TOK_HASH_ERROR:
        return expand_begin(expander, TOK_MODE_STRING, USE_ERROR, at);
    case TOK_HASH_VERSION:
        return expand_begin(expander, TOK_MODE_VALUE, USE_VERSION, at);
    case TOK_HASH_DEFAULT:
        return expand_begin(expander, TOK_MODE_DEFAULT, USE_DEFAULT, at);
    case TOK_HASH_FOPEN:
    case TOK_HASH_FCLOSE:
    case TOK_HASH_READ:
    case TOK_HASH_WRITE:
        return fileio_run(expander, token);
    case TOK_HASH_ALONE:
        parser_warn(expander->parser, at, "'#' without a directive");
        return true;
    default:
        return branch_run(expander, token);
    }
}

bool directive_finish(struct expander *expander, const struct pending *pending)
{
    switch (pending->use) {
    case USE_DECLARE:
        return finish_declare(expander, pending);
    case USE_VERSION:
        return set_version(expander);
    case USE_INCLUDE:
        return include(expander, pending);
    case USE_DEBUG:
    case USE_WARNING:
    case USE_ERROR:
        return message(expander, pending);
    default:
        return true;
    }
}
