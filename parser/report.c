/* report.c - diagnostics with the line, the trace and a hint. */
#include "parser/report.h"
#include "parser/build.h"
#include "parser/expander.h"
#include "parser/grammar.h"
#include "parser/source.h"
#include "parser/utf8.h"
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 1024, TRACE = 2048 };

/* ---- places ------------------------------------------------------------ */

static const struct source *source_of(const struct parser *parser,
                                      struct location at)
{
    return at.source < parser->sources ? parser->source[at.source] : NULL;
}

/* One line a frame: where the text was included, or the macro was called. */
static void write_trace(const struct parser *parser, char *text, size_t room)
{
    enum { SHOWN = 8 };
    size_t used = 0;
    struct expander_call call;
    *text = 0;
    int depth = expander_depth(parser);
    for (int i = 0; i < depth && used < room; i++) {
        if (depth > 2 * SHOWN && i == SHOWN) {
            used += (size_t)snprintf(text + used, room - used,
                                     "... %d more ...\n", depth - 2 * SHOWN);
            i = depth - SHOWN;
        }
        expander_call(parser, i, &call);
        const struct source *source = source_of(parser, call.at);
        if (!source || used >= room) {
            continue;
        }
        used += (size_t)snprintf(text + used, room - used,
                                 call.macro ? "%s:%d: in macro %s called here\n"
                                            : "%s:%d: included from here\n",
                                 source->name,
                                 source_locate(source, call.at.offset).line,
                                 call.macro);
    }
}

static void add(struct parser *parser, struct diag_item *item,
                struct location at)
{
    char trace[TRACE];
    const struct source *source = source_of(parser, at);
    if (source) {
        struct source_point point = source_locate(source, at.offset);
        item->file = source->name;
        item->line = point.line;
        item->column = point.column;
        write_trace(parser, trace, sizeof trace);
        item->trace = *trace ? trace : NULL;
        if (parser->diag->warnings < parser->diag->warning_limit ||
            item->severity == DIAG_ERROR) {
            item->excerpt = diag_excerpt(&parser->diag->arena, point.start,
                                         point.end, point.at, point.line);
        }
    }
    diag_add(parser->diag, item);
}

static bool fail(struct parser *parser, enum brume_code code,
                 struct location at, const char *hint, const char *text)
{
    struct diag_item item = {
        .severity = DIAG_ERROR, .code = code, .text = text, .hint = hint};
    /* What follows an error is its consequence. */
    if (!parser->failed) {
        add(parser, &item, at);
    }
    parser->failed = true;
    parser->fatal |= code != BRUME_ERR_SCENE && code != BRUME_ERR_FILE &&
                     code != BRUME_ERR_ACCESS;
    return false;
}

bool parser_error(struct parser *parser, struct location at, const char *format,
                  ...)
{
    char text[TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return fail(parser, BRUME_ERR_SCENE, at, NULL, text);
}

bool parser_mistake(struct parser *parser, struct location at,
                    const char *format, ...)
{
    char text[TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fail(parser, BRUME_ERR_SCENE, at, NULL, text);
    parser->failed &= !parser->in->all_errors;
    return false;
}

bool parser_fail(struct parser *parser, enum brume_code code,
                 struct location at, const char *hint, const char *format, ...)
{
    char text[TEXT];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return fail(parser, code, at, hint, text);
}

/* Whether this place was warned of lately: once is enough for a loop. */
static bool warned(struct parser *parser, struct location at)
{
    enum { SLOTS = sizeof parser->warned / sizeof *parser->warned };
    struct location *slot = &parser->warned[at.offset % SLOTS];
    if (slot->offset == at.offset + 1 && slot->source == at.source) {
        return true;
    }
    *slot = (struct location){at.offset + 1, at.source};
    return false;
}

void parser_warn(struct parser *parser, struct location at, const char *format,
                 ...)
{
    char text[TEXT];
    if (warned(parser, at)) {
        return;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    struct diag_item item = {.severity = DIAG_WARNING, .text = text};
    add(parser, &item, at);
}

bool parser_relay(struct parser *parser, struct location at,
                  const struct brume_error *err)
{
    char text[TEXT + 600];
    /* The text names a data file that is at fault. */
    if (err->line) {
        snprintf(text, sizeof text, "%s (line %d)", err->text, err->line);
    } else {
        snprintf(text, sizeof text, "%s", err->text);
    }
    return fail(parser, err->code, at, NULL, text);
}

/* ---- memory ------------------------------------------------------------ */

bool report_no_memory(struct parser *parser)
{
    struct location at = expander_place(parser);
    return parser->arena.limited
               ? parser_fail(
                     parser, BRUME_ERR_LIMIT, at, NULL,
                     "the scene needs "
                     "more than the %zu bytes of memory that it may use",
                     parser->limits.memory)
               : parser_fail(parser, BRUME_ERR_MEMORY, at, NULL,
                             "out of memory");
}

bool parser_hold(struct parser *parser, struct location at, size_t bytes)
{
    size_t most = parser->limits.memory;
    parser->scene_bytes += bytes;
    return !most || parser->scene_bytes <= most ||
           parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                       "the scene needs more than the %zu bytes of memory that "
                       "it may use",
                       most);
}

void report_exhausted(struct parser *parser, struct location at, int depth)
{
    /* There may be some more symbols on the stack than tokens. */
    if (expander_tokens(parser) < (uint64_t)depth / 4) {
        parser_fail(parser, BRUME_ERR_MEMORY, at, NULL, "out of memory");
    } else {
        parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                    "brackets are nested "
                    "deeper than %d",
                    depth);
    }
}

static void *memory_or_report(struct parser *parser, void *block)
{
    if (!block) {
        report_no_memory(parser);
    }
    return block;
}

void *parser_alloc(struct parser *parser, size_t size)
{
    return memory_or_report(parser, arena_alloc(&parser->arena, size));
}

void *parser_array(struct parser *parser, size_t count, size_t size)
{
    return memory_or_report(parser, arena_array(&parser->arena, count, size));
}

/* ---- tokens that do not fit -------------------------------------------- */

static size_t spelling_length(const char *text, size_t left)
{
    size_t length = 0;
    if (*text == '"') {
        length = 1;
        while (length < left && text[length] != '"' && text[length] != '\n') {
            length++;
        }
        return length < left && text[length] == '"' ? length + 1 : length;
    }
    length += *text == '#' || *text == '.';
    while (length < left &&
           (isalnum((unsigned char)text[length]) || text[length] == '_')) {
        length++;
    }
    return length ? length : 1;
}

const char *report_spelling(struct parser *parser, struct location at)
{
    enum { SHOWN = 40 };
    static const char dots[] = "...";
    const struct source *source = source_of(parser, at);
    if (!source || at.offset >= source->length) {
        return "end of file";
    }
    const char *text = source->text + at.offset;
    size_t length = spelling_length(text, source->length - at.offset);
    size_t shown = utf8_cut(text, length, SHOWN);
    char *copy = arena_alloc(&parser->arena, shown + sizeof dots);
    if (!copy) {
        return dots;
    }
    memcpy(copy, text, shown);
    if (shown < length) {
        memcpy(copy + shown, dots, sizeof dots);
    }
    return copy;
}

static bool contains(const int *list, int count, int kind)
{
    for (int i = 0; i < count; i++) {
        if (list[i] == kind) {
            return true;
        }
    }
    return false;
}

/* Tokens that begin a number or a string, or that continue one. */
static bool begins_value(int kind)
{
    /* clang-format off */
    static const int kinds[] = {
        TOK_NUMBER, TOK_STRING, TOK_FLOAT_ID, TOK_VECTOR_ID, TOK_COLOR_ID,
        TOK_STRING_ID, TOK_NUMBER_FUNCTION, TOK_STRING_FUNCTION,
        TOK_DIMENSIONS, TOK_DIMENSION_SIZE, TOK_ARRAY, TOK_ARRAY_ID,
        TOK_OBJECT_FUNCTION, TOK_TRACE, TOK_SERIES, TOK_FUNCTION_ID,
        TOK_SPLINE_ID,
        TOK_COLOR, TOK_RED, TOK_GREEN, TOK_BLUE, TOK_FILTER, TOK_TRANSMIT,
        TOK_RGB, TOK_DATA, '(', '<', '+', '-', '!'
    };
    /* clang-format on */
    return contains(kinds, sizeof kinds / sizeof *kinds, kind);
}

static bool continues_value(int kind)
{
    /* clang-format off */
    static const int kinds[] = {
        '+', '-', '*', '/', '&', '|', '?', '=', '<', '>', TOK_DOT,
        TOK_LESS_EQUAL, TOK_GREATER_EQUAL, TOK_NOT_EQUAL
    };
    /* clang-format on */
    return contains(kinds, sizeof kinds / sizeof *kinds, kind);
}

/* "a, b or c" of what is expected; empty if that is too much to tell. */
static void write_expected(char *text, size_t room, const int *expected,
                           int count)
{
    enum { NAMED = 5 };
    const char *name[NAMED + 1];
    int names = 0;
    bool number = contains(expected, count, TOK_NUMBER);
    *text = 0;
    if (contains(expected, count, TOK_WORD)) {
        return;
    }
    bool string = contains(expected, count, TOK_STRING);
    if (number || string) {
        name[names++] = number ? "a number" : "a string";
    }
    for (int i = 0; i < count && names <= NAMED; i++) {
        if (expected[i] != TOK_END &&
            !(continues_value(expected[i]) && !number) &&
            !((number || string) && begins_value(expected[i]))) {
            name[names++] = grammar_token_name(expected[i]);
        }
    }
    size_t used = 0;
    for (int i = 0; i < names && names <= NAMED && used < room; i++) {
        used += (size_t)snprintf(text + used, room - used, "%s%s",
                                 i == 0          ? ""
                                 : i + 1 < names ? ", "
                                                 : " or ",
                                 name[i]);
    }
}

/* "vector identifier 'Foo'", "'}'", "end of file". */
static void write_found(struct parser *parser, char *text, size_t room,
                        struct location at, int found)
{
    const char *name = grammar_token_name(found);
    const char *spelled = report_spelling(parser, at);
    if (found == TOK_END || name[0] == '\'') {
        snprintf(text, room, "%s", name);
    } else {
        const char *quote = *spelled == '"' ? "" : "'";
        snprintf(text, room, "%s %s%s%s", name, quote, spelled, quote);
    }
}

int report_line(const struct parser *parser, struct location at)
{
    const struct source *source = source_of(parser, at);
    return source ? source_locate(source, at.offset).line : 0;
}

bool report_begins_line(const struct parser *parser, struct location at)
{
    const struct source *source = source_of(parser, at);
    return source && source_locate(source, at.offset).column == 1;
}

/* Asks for the '}' of the statement `word` that began at `began`. */
static void report_open(struct parser *parser, struct location at,
                        const char *got, const char *word,
                        struct location began)
{
    char hint[128];
    snprintf(hint, sizeof hint, "is a '}' missing? '%s' began in line %d", word,
             report_line(parser, began));
    parser_fail(parser, BRUME_ERR_SCENE, at, hint, "%s has no place in '%s'",
                got, word);
}

void report_unexpected(struct parser *parser, struct location at, int found,
                       const int *expected, int count)
{
    char wanted[TEXT / 2], got[128];
    struct location began;
    const char *word = build_innermost(parser, &began);
    write_expected(wanted, sizeof wanted, expected, count);
    write_found(parser, got, sizeof got, at, found);
    if (word && found == TOK_END) {
        report_open(parser, at, got, word, began);
    } else if (*wanted) {
        parser_error(parser, at, "expected %s, found %s", wanted, got);
    } else if (word) {
        parser_error(parser, at, "%s has no place in '%s'", got, word);
    } else {
        parser_error(parser, at, "%s has no place here", got);
    }
}

void report_wanted(struct parser *parser, struct location at,
                   const char *wanted, int found)
{
    char got[128];
    write_found(parser, got, sizeof got, at, found);
    parser_error(parser, at, "expected %s, found %s", wanted, got);
}

void report_undeclared(struct parser *parser, struct location at,
                       const struct name *name)
{
    char hint[128];
    const char *like = symbols_suggest(&parser->symbols, name);
    if (like) {
        snprintf(hint, sizeof hint, "did you mean '%s'?", like);
    }
    parser_fail(parser, BRUME_ERR_SCENE, at, like ? hint : NULL,
                "undeclared identifier '%s'", report_spelling(parser, at));
}

bool report_unknown(struct parser *parser, struct location at, const char *word,
                    const char *in)
{
    if (!build_knows(word)) {
        return parser_mistake(parser, at, "'%s' is not supported yet", word);
    }
    return in ? parser_mistake(parser, at, "'%s' has no place in '%s'", word,
                               in)
              : parser_error(parser, at, "'%s' has no place here", word);
}

static bool is_directive_word(const struct name *name)
{
    for (int i = 0; i < directive_count; i++) {
        if (strcmp(directive_table[i].word, name->text) == 0) {
            return true;
        }
    }
    return false;
}

void report_bad(struct parser *parser, const struct token *token)
{
    struct location at = token_location(token);
    if (token->kind == TOK_BAD) {
        parser_error(parser, at, "%s", token->error);
    } else if (is_directive_word(token->name)) {
        parser_error(parser, at, "'%s' is a directive: write '#%s'",
                     token->name->text, token->name->text);
    } else {
        parser_error(parser, at, "'%s' is not supported yet",
                     report_spelling(parser, at));
    }
}
