#include "parser/expand.h"
#include "lib/timer.h"
#include "parser/build.h"
#include "parser/literal.h"
#include "parser/report.h"
#include "parser/scalar.h"
#include <ctype.h>

/* Values in values; each holds a parser of its own. */
enum { PENDING_DEPTH = 20000 };

/* ---- stacks ------------------------------------------------------------ */

void *expand_grow(struct expander *expander, void *items, size_t *room,
                  size_t need, size_t size)
{
    struct parser *parser = expander->parser;
    if (!arena_grow(&parser->arena, &items, room, need, size)) {
        report_no_memory(parser);
        return NULL;
    }
    return items;
}

static struct pending *innermost(const struct expander *expander)
{
    return &expander->pending[expander->pendings - 1];
}

bool expand_enter(struct expander *expander, const struct frame *frame)
{
    struct frame *grown = expand_grow(expander, expander->frame,
                                      &expander->frame_room,
                                      expander->frames + 1, sizeof *grown);
    if (!grown) {
        return false;
    }
    expander->frame = grown;
    grown[expander->frames] = *frame;
    grown[expander->frames].loops = expander->loops;
    grown[expander->frames].level = expander->parser->symbols.level;
    expander->frames++;
    expander->texts += !frame->macro;
    return true;
}

void expand_leave(struct expander *expander)
{
    struct frame *frame = expand_frame(expander);
    reader_close(expander->parser, &frame->cursor);
    expander->loops = frame->loops;
    expander->texts -= !frame->macro;
    expander->frames--;
    while (expander->parser->symbols.level >= frame->level) {
        symbols_leave(&expander->parser->symbols);
    }
    if (expander->frames > 0 && !expander->parser->formula) {
        expand_leave_names(expander);
    }
}

/* Functions that were given up leave theirs. */
void expand_leave_names(struct expander *expander)
{
    struct symbols *symbols = &expander->parser->symbols;
    while (symbols->level > expand_frame(expander)->level) {
        symbols_leave(symbols);
    }
}

bool expand_return(struct expander *expander, size_t frames, struct location at)
{
    while (expander->frames > frames) {
        int kind = expand_peek(expander)->kind;
        if (kind == TOK_HASH_END && expand_frame(expander)->macro) {
            expand_leave(expander);
        } else if (kind == TOK_END) {
            expand_leave(expander);
        } else {
            return parser_error(expander->parser, at,
                                "the directive's value "
                                "must end in the text where it begins");
        }
    }
    return true;
}

static struct scene_yypstate *take_parser(struct expander *expander)
{
    if (expander->spares > 0) {
        return expander->spare[--expander->spares];
    }
    struct scene_yypstate *state = scene_yypstate_new();
    if (!state) {
        parser_fail(expander->parser, BRUME_ERR_MEMORY, expander->place, NULL,
                    "out of memory");
    }
    return state;
}

/* Keeps a parser for the next value; a finished one begins anew. */
static void give_parser(struct expander *expander, struct scene_yypstate *state)
{
    struct scene_yypstate **grown = expand_grow(
        expander, expander->spare, &expander->spare_room, expander->spares + 1,
        sizeof *grown);
    if (!grown) {
        scene_yypstate_delete(state);
        return;
    }
    expander->spare = grown;
    grown[expander->spares++] = state;
}

struct pending *expand_begin(struct expander *expander, int mode, enum use use,
                             struct location at)
{
    struct parser *parser = expander->parser;
    if (expander->pendings >= PENDING_DEPTH) {
        parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                    "values are nested "
                    "deeper than %d",
                    PENDING_DEPTH);
        return NULL;
    }
    struct pending *grown = expand_grow(expander, expander->pending,
                                        &expander->pending_room,
                                        expander->pendings + 1, sizeof *grown);
    struct scene_yypstate *state = grown ? take_parser(expander) : NULL;
    if (!state) {
        return NULL;
    }
    expander->pending = grown;
    struct pending *pending = &grown[expander->pendings++];
    *pending = (struct pending){.use = use,
                                .state = state,
                                .at = at,
                                .frames = expander->frames,
                                .start = expand_frame(expander)->cursor.next,
                                .passed = expand_frame(expander)->cursor.passed,
                                .last = mode,
                                .open_ended = mode == TOK_MODE_VALUE};
    SCENE_YYSTYPE none = {.count = 0};
    scene_yypush_parse(state, mode, &none, &at, parser);
    return pending;
}

/* ---- pushing ----------------------------------------------------------- */

void expander_result(struct parser *parser, const struct value *value)
{
    parser->expander->result = *value;
}

void expander_count(struct parser *parser, int count)
{
    parser->expander->count = count;
}

/* A value is complete: back to what it was for. */
static bool finish(struct expander *expander)
{
    struct pending done = *innermost(expander);
    expander->pendings--;
    give_parser(expander, done.state);
    switch (done.use) {
    case USE_NONE:
        return true;
    case USE_INDEX:
        return item_finish(expander, &done);
    case USE_FOPEN:
    case USE_WRITE:
        return fileio_finish(expander, &done);
    case USE_ARGUMENT:
        return macro_argument(expander, &expander->result, NULL);
    case USE_IF:
    case USE_ELSEIF:
    case USE_WHILE:
    case USE_SWITCH:
    case USE_CASE:
    case USE_RANGE:
    case USE_FOR:
        return branch_finish(expander, &done);
    default:
        return directive_finish(expander, &done);
    }
}

bool expand_may_go_on(struct expander *expander, struct location at)
{
    struct parser *parser = expander->parser;
    const struct parse_input *in = parser->in;
    if (in->stopped && in->stopped(in->user)) {
        return parser_fail(parser, BRUME_STOPPED, at, NULL,
                           "stopped while "
                           "reading the scene");
    }
    if (expander->deadline > 0 && timer_seconds() > expander->deadline) {
        return parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                           "reading the "
                           "scene takes longer than %g s",
                           parser->limits.seconds);
    }
    return true;
}

static bool count_token(struct expander *expander, struct location at)
{
    uint64_t most = expander->parser->limits.tokens;
    if (++expander->tokens > most) {
        return parser_fail(expander->parser, BRUME_ERR_LIMIT, at, NULL,
                           "the scene has more than %llu tokens",
                           (unsigned long long)most);
    }
    return expand_tick(expander, at);
}

void expander_spend(struct parser *parser, int tokens, struct location at)
{
    parser->expander->tokens += (uint64_t)tokens - 1;
    count_token(parser->expander, at);
}

static void count_brackets(struct pending *pending, int kind)
{
    switch (kind) {
    case '{':
        pending->braces++;
        pending->depth++;
        break;
    case '(':
    case '[':
        pending->depth++;
        break;
    case '}':
        pending->braces -= pending->braces > 0;
        pending->depth -= pending->depth > 0;
        break;
    case ')':
    case ']':
        pending->depth -= pending->depth > 0;
        break;
    default:
        break;
    }
}

/* Pushes a token into the innermost parser, and finishes that if it was the
 * last one. */
static bool push(struct expander *expander, int kind,
                 const SCENE_YYSTYPE *meaning, struct location at)
{
    enum { ACCEPTED = 0 };
    struct parser *parser = expander->parser;
    struct pending *pending = innermost(expander);
    if (!count_token(expander, at)) {
        return false;
    }
    if (pending->dropping && recover_drops(pending, kind)) {
        return true;
    }
    expander->pushed++;
    if (kind != TOK_END) {
        expander->place = at;
    }
    count_brackets(pending, kind);
    pending->last = kind;
    int status = scene_yypush_parse(pending->state, kind, meaning, &at, parser);
    if (kind == '{' && parser->in->cache && build_literal_begins(parser)) {
        return literal_run(expander);
    }
    if (parser->failed || status == YYPUSH_MORE) {
        return !parser->failed;
    }
    return status == ACCEPTED ? finish(expander)
                              : parser_error(parser, at, "syntax error");
}

static bool push_end(struct expander *expander)
{
    SCENE_YYSTYPE none = {.count = 0};
    struct location at = token_location(expand_peek(expander));
    return push(expander, TOK_END, &none, at);
}

void expand_hold(struct expander *expander, const struct value *value,
                 struct location at)
{
    expander->held = true;
    expander->hold_value = *value;
    expander->hold_at = at;
}

/* ---- floats alone ------------------------------------------------------ */

const struct token *expand_scalar(const struct expander *expander, int begin,
                                  bool full, double *value)
{
    const struct cursor *cursor = &expand_frame(expander)->cursor;
    const struct token *token = &cursor->chunk->token[cursor->next];
    if (expander->held || cursor->data || (begin && token->kind != begin)) {
        return NULL;
    }
    return scalar_read(token + (begin != 0), full, value);
}

bool expand_skip_to(struct expander *expander, const struct token *token)
{
    struct cursor *cursor = &expand_frame(expander)->cursor;
    size_t next = (size_t)(token - cursor->chunk->token);
    expander->tokens += next - cursor->next - 1;
    expander->place = token_location(token - 1);
    cursor_jump(cursor, next);
    return count_token(expander, expander->place);
}

/* ---- names ------------------------------------------------------------- */

/* The token of a value. */
static int kind_of(const struct value *value)
{
    static const uint16_t kinds[VALUE_OBJECT] = {
        [VALUE_NONE] = TOK_IDENTIFIER,      [VALUE_STRING] = TOK_STRING_ID,
        [VALUE_ARRAY] = TOK_ARRAY_ID,       [VALUE_MACRO] = TOK_MACRO_ID,
        [VALUE_LIST] = TOK_VECTOR_ID,       [VALUE_FORMULA] = TOK_FLOAT_ID,
        [VALUE_FUNCTION] = TOK_FUNCTION_ID, [VALUE_FILE] = TOK_FILE_ID};
    if (value->kind == VALUE_NUMBER) {
        return value->terms == 1             ? TOK_FLOAT_ID
               : value->terms == VALUE_TERMS ? TOK_COLOR_ID
                                             : TOK_VECTOR_ID;
    }
    return value->kind < VALUE_OBJECT    ? kinds[value->kind]
           : value->kind == VALUE_SPLINE ? TOK_SPLINE_ID
                                         : TOK_NODE_ID;
}

static bool push_value(struct expander *expander, const struct value *value,
                       struct location at)
{
    SCENE_YYSTYPE meaning = {.value = *value};
    return push(expander, kind_of(value), &meaning, at);
}

static bool push_word(struct expander *expander, int kind,
                      const struct token *token)
{
    SCENE_YYSTYPE meaning = {.name = token->name};
    return push(expander, kind, &meaning, token_location(token));
}

/* A word of values, as `filter` or `sqr`, that the open statement knows as its
 * own. */
static int word_kind(const struct expander *expander, const struct token *token)
{
    switch (token->kind) {
    case TOK_NUMBER_FUNCTION:
    case TOK_INTERNAL:
    case TOK_RGB:
    case TOK_FILTER:
    case TOK_TRANSMIT:
    case TOK_RED:
    case TOK_GREEN:
    case TOK_BLUE:
        return build_claims(expander->parser, token->name) ? TOK_WORD
                                                           : token->kind;
    default:
        return token->kind;
    }
}

void expander_want_name(struct parser *parser, bool wanted)
{
    parser->expander->want_name = wanted;
}

/* A name: what it stands for, or one of Brume's own words. */
static bool run_name(struct expander *expander, const struct token *token)
{
    struct value *value = symbols_find(token->name);
    struct location at = token_location(token);
    if (expander->want_name) {
        expander->want_name = false;
        expand_skip(expander);
        return push_word(expander, TOK_IDENTIFIER, token);
    }
    if (innermost(expander)->dropping && !recover_ends(expander)) {
        expand_skip(expander);
        return push_word(expander, TOK_IDENTIFIER, token);
    }
    if (!value && !token->name->keyword) {
        return recover_undeclared(expander, token->name, at);
    }
    expand_skip(expander);
    directive_used(expander, token);
    if (!value) {
        return push_word(expander, token->name->keyword->kind, token);
    }
    if (value->kind == VALUE_MACRO) {
        return macro_call(expander, value->macro, at);
    }
    if (value->kind == VALUE_ARRAY && expand_peek(expander)->kind == '[') {
        return item_seek(expander, &(struct seek){.item = value}, at);
    }
    return push_value(expander, value, at);
}

bool expand_take(struct expander *expander, int kind)
{
    if (expander->held || expand_peek(expander)->kind != kind) {
        return false;
    }
    expand_skip(expander);
    return true;
}

/* Reports the next token, where something else must stand. */
static bool unexpected(struct expander *expander, const char *wanted)
{
    const struct token *token = expand_peek(expander);
    if (token->kind == TOK_BAD) {
        report_bad(expander->parser, token);
    } else {
        report_wanted(expander->parser, token_location(token), wanted,
                      token->kind);
    }
    return false;
}

bool expand_need(struct expander *expander, int kind)
{
    return expand_take(expander, kind) ||
           unexpected(expander, grammar_token_name(kind));
}

struct name *expand_need_name(struct expander *expander)
{
    struct token *token = expand_peek(expander);
    if (expand_take(expander, TOK_IDENTIFIER)) {
        return token->name;
    }
    const char *word = report_spelling(expander->parser, token_location(token));
    if (isalpha((unsigned char)*word) && token->kind != TOK_END) {
        parser_error(expander->parser, token_location(token),
                     "expected a name, but '%s' is a reserved word", word);
    } else {
        unexpected(expander, "a name");
    }
    return NULL;
}

/* ---- where a value ends ------------------------------------------------ */

static bool is_directive(int kind)
{
    return kind >= TOK_HASH_IF && kind <= TOK_HASH_ERROR;
}

static bool accepts(const struct pending *pending, int kind)
{
    return grammar_accepts(pending->state, kind);
}

/* Whether an operator could go on with the value: it is a number. */
static bool goes_on(const struct pending *pending)
{
    return accepts(pending, '+');
}

/* Whether a directive belongs to a block that was open before the value
 * began. */
static bool leaves_value(const struct expander *expander,
                         const struct pending *pending,
                         const struct token *token)
{
    switch (token->kind) {
    case TOK_HASH_ELSE:
    case TOK_HASH_ELSEIF:
    case TOK_HASH_END:
    case TOK_HASH_CASE:
    case TOK_HASH_RANGE:
    case TOK_HASH_BREAK:
        return expander->frames == pending->frames &&
               expand_frame(expander)->cursor.passed == pending->passed &&
               token->block.pair < pending->start;
    default:
        return false;
    }
}

/* A directive ends a value that is complete, unless it belongs to it: a block
 * that a number holds, as in `3 #if (A) + 1 #end`. Where the ';' may be left
 * out, a block cannot belong to a complete number. */
static bool directive_ends(const struct expander *expander,
                           const struct pending *pending,
                           const struct token *token)
{
    switch (token->kind) {
    case TOK_HASH_IF:
    case TOK_HASH_IFDEF:
    case TOK_HASH_IFNDEF:
    case TOK_HASH_SWITCH:
    case TOK_HASH_WHILE:
    case TOK_HASH_FOR:
        return !directive_strict(expander) || !goes_on(pending);
    case TOK_HASH_ELSE:
    case TOK_HASH_ELSEIF:
    case TOK_HASH_END:
    case TOK_HASH_CASE:
    case TOK_HASH_RANGE:
    case TOK_HASH_BREAK:
        return leaves_value(expander, pending, token);
    default:
        return true;
    }
}

static bool name_fits(const struct pending *pending, const struct token *token)
{
    const struct value *value = symbols_find(token->name);
    return value ? accepts(pending, kind_of(value))
                 : token->name->keyword &&
                       accepts(pending, token->name->keyword->kind);
}

/* Whether a value may end with the token: after these it never does, and there
 * are many of them. */
static bool may_end(int last)
{
    return last != TOK_MODE_VALUE && last != '+' && last != '-' &&
           last != '*' && last != '/';
}

/* Whether the value is complete and the next token no part of it. */
static bool value_ends(const struct expander *expander,
                       const struct pending *pending)
{
    const struct token *token = expand_peek(expander);
    int kind = token->kind;
    bool directive = is_directive(kind);
    if (expander->held) {
        return !accepts(pending, kind_of(&expander->hold_value)) &&
               accepts(pending, TOK_END);
    }
    if (kind == TOK_BAD || !may_end(pending->last)) {
        return false;
    }
    if (kind == TOK_END && expander->frames > pending->frames) {
        return false;
    }
    if (!directive &&
        (kind == TOK_IDENTIFIER ? name_fits(pending, token)
                                : kind != TOK_END && accepts(pending, kind))) {
        return false;
    }
    return accepts(pending, TOK_END) &&
           (!directive || directive_ends(expander, pending, token));
}

/* ---- the loop ---------------------------------------------------------- */

static bool run_held(struct expander *expander)
{
    struct value value = expander->hold_value;
    expander->held = false;
    return push_value(expander, &value, expander->hold_at);
}

/* The end of a text is the end of the values that began in it. */
static bool run_end(struct expander *expander)
{
    if (expander->frames == innermost(expander)->frames) {
        return push_end(expander);
    }
    expand_leave(expander);
    return true;
}

/* A value that began within a block must end there. */
static bool run_directive(struct expander *expander, const struct token *token)
{
    const struct pending *pending = innermost(expander);
    return leaves_value(expander, pending, token)
               ? parser_error(expander->parser, token_location(token),
                              "%s comes in the middle of a value",
                              grammar_token_name(token->kind))
               : directive_run(expander, token);
}

static bool run_token(struct expander *expander)
{
    struct token *token = expand_peek(expander);
    struct value value;
    switch (token->kind) {
    case TOK_END:
        return run_end(expander);
    case TOK_IDENTIFIER:
        return run_name(expander, token);
    case TOK_BAD:
        report_bad(expander->parser, token);
        return false;
    case TOK_UNSUPPORTED:
        return directive_run_bare(expander, token);
    }
    expand_skip(expander);
    switch (token->kind) {
    case TOK_NUMBER:
        value = value_float(token->number);
        break;
    case TOK_STRING:
        value = value_string(token->string->text, token->string->length);
        break;
    case TOK_DEFINED:
        return item_defined(expander, ITEM_DEFINED, 0, token_location(token));
    default:
        return is_directive(token->kind)
                   ? run_directive(expander, token)
                   : push_word(expander, word_kind(expander, token), token);
    }
    SCENE_YYSTYPE meaning = {.value = value};
    return push(expander, token->kind, &meaning, token_location(token));
}

static bool push_run(struct expander *expander, const struct token *run)
{
    struct cursor *cursor = &expand_frame(expander)->cursor;
    const char *text = cursor->chunk->text + run->offset;
    SCENE_YYSTYPE meaning = {.data = {text, text + run->data.length}};
    cursor_jump(cursor, cursor->next + 1);
    return push(expander, TOK_DATA, &meaning, token_location(run));
}

/* A run that is one vector. */
static bool push_vector(struct expander *expander, const struct token *run)
{
    struct cursor *cursor = &expand_frame(expander)->cursor;
    const char *text = cursor->chunk->text + run->offset;
    struct data_run data = {text, text + run->data.length};
    SCENE_YYSTYPE meaning;
    data_item(&data, &meaning.value);
    struct location at = token_location(run);
    cursor_jump(cursor, cursor->next + 1);
    expander_spend(expander->parser, 2 * meaning.value.terms, at);
    bool going = push(expander, TOK_VECTOR_ID, &meaning, at);
    expander->place.offset = at.offset + run->data.length - 1;
    return going;
}

/* Pushes a run of plain data as a whole, where the grammar takes one; false:
 * there is none, or it is for others token by token. */
static bool take_run(struct expander *expander, bool *going)
{
    const struct pending *pending = innermost(expander);
    const struct token *run = expander->held
                                  ? NULL
                                  : cursor_run(&expand_frame(expander)->cursor);
    if (!run) {
        return false;
    }
    /* An operator may follow a vector, but no other run. */
    if (run->data.vector && accepts(pending, TOK_VECTOR_ID)) {
        *going = push_vector(expander, run);
        return true;
    }
    if (accepts(pending, TOK_DATA)) {
        *going = push_run(expander, run);
        return true;
    }
    return false;
}

bool expand_step(struct expander *expander)
{
    const struct pending *pending = innermost(expander);
    bool going;
    if (take_run(expander, &going)) {
        return going;
    }
    if (pending->open_ended && pending->depth == 0 &&
        value_ends(expander, pending)) {
        return push_end(expander);
    }
    return expander->held ? run_held(expander) : run_token(expander);
}

static void release(struct expander *expander)
{
    while (expander->pendings > 0) {
        scene_yypstate_delete(expander->pending[--expander->pendings].state);
    }
    while (expander->spares > 0) {
        scene_yypstate_delete(expander->spare[--expander->spares]);
    }
}

/* The scene's text, and on top of it the one that the user wants read before
 * (+HI). */
static bool enter_scene(struct expander *expander)
{
    struct parser *parser = expander->parser;
    struct frame scene = {.macro = NULL}, header = scene;
    struct source *source = source_open_scene(parser);
    if (!source || !reader_open(parser, source, &scene.cursor) ||
        !expand_enter(expander, &scene) ||
        !expand_begin(expander, TOK_MODE_SCENE, USE_NONE,
                      (struct location){0})) {
        return false;
    }
    if (!parser->in->header) {
        return true;
    }
    source = source_open_path(parser, (struct location){0}, parser->in->header);
    return source && reader_open(parser, source, &header.cursor) &&
           (symbols_enter(&parser->symbols) || report_no_memory(parser)) &&
           expand_enter(expander, &header);
}

bool expander_run(struct parser *parser)
{
    struct expander expander = {.parser = parser};
    double seconds = parser->limits.seconds;
    expander.deadline = seconds > 0 ? timer_seconds() + seconds : 0;
    parser->expander = &expander;
    bool going = enter_scene(&expander);
    while (going && expander.pendings > 0) {
        going = expand_step(&expander) || recover_after_error(&expander);
    }
    release(&expander);
    parser->expander = NULL;
    return going && !parser->failed;
}

/* ---- for diagnostics --------------------------------------------------- */

struct location expander_place(const struct parser *parser)
{
    return parser->expander ? parser->expander->place
                            : (struct location){0, UINT32_MAX};
}

uint64_t expander_tokens(const struct parser *parser)
{
    return parser->expander->tokens;
}

int expander_depth(const struct parser *parser)
{
    const struct expander *expander = parser->expander;
    return expander && expander->frames ? (int)expander->frames - 1 : 0;
}

void expander_call(const struct parser *parser, int depth,
                   struct expander_call *call)
{
    const struct expander *expander = parser->expander;
    const struct frame *frame =
        &expander->frame[expander->frames - 1 - (size_t)depth];
    call->at = frame->called;
    call->macro = frame->macro ? frame->macro->name->text : NULL;
}
