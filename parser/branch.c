/* branch.c - blocks of directives: #if, #switch, #while, #for.
 *
 * The scanner has linked the directives of each block (block.h), so a branch
 * that is not taken is a jump. #for and #switch alone have a state. */
#include "parser/expand.h"
#include "parser/eval.h"
#include "parser/report.h"

static const double CLOSE = 1e-10; /* POV-Ray's bound for equality    */

static struct token *token_at(const struct expander *expander, uint32_t index)
{
    return &expand_frame(expander)->cursor.chunk->token[index];
}

static void jump(struct expander *expander, uint32_t index)
{
    cursor_jump(&expand_frame(expander)->cursor, index);
}

bool branch_is_closed(struct expander *expander, uint32_t opener)
{
    const struct token *token = token_at(expander, opener);
    return token->block.pair ||
           parser_error(expander->parser, token_location(token),
                        "%s has no '#end'", grammar_token_name(token->kind));
}

/* ---- loops and switches ------------------------------------------------ */

static struct loop *innermost(const struct expander *expander)
{
    return &expander->loop[expander->loops - 1];
}

/* The state of a #for or #switch; NULL: its head was wrong, and where every
 * error is wanted the rest of it is read nevertheless (recover.c). */
static struct loop *state_of(const struct expander *expander, uint32_t opener)
{
    return expander->loops > expand_frame(expander)->loops &&
                   innermost(expander)->opener == opener
               ? innermost(expander)
               : NULL;
}

static bool open_loop(struct expander *expander, const struct loop *loop)
{
    struct loop *grown = expand_grow(expander, expander->loop,
                                     &expander->loop_room, expander->loops + 1,
                                     sizeof *grown);
    if (!grown) {
        return false;
    }
    expander->loop = grown;
    grown[expander->loops++] = *loop;
    return true;
}

/* Goes on behind the block's #end; where there is none, an error told already,
 * with what comes next. */
static void leave(struct expander *expander, uint32_t opener)
{
    uint32_t end = token_at(expander, opener)->block.pair;
    if (state_of(expander, opener)) {
        expander->loops--;
    }
    if (end) {
        jump(expander, end + 1);
    }
}

static bool count_iteration(struct expander *expander, uint32_t opener)
{
    struct location at = token_location(token_at(expander, opener));
    uint64_t most = expander->parser->limits.iterations;
    if (++expander->iterations > most) {
        return parser_fail(expander->parser, BRUME_ERR_LIMIT, at, NULL,
                           "the loops of the scene run more than %llu times",
                           (unsigned long long)most);
    }
    return expand_tick(expander, at);
}

/* The variable of the innermost #for; NULL: it is no float any more. */
static struct value *loop_variable(struct expander *expander)
{
    const struct loop *loop = innermost(expander);
    struct value *value = symbols_find(loop->name);
    if (!value || value->kind != VALUE_NUMBER || value->terms != 1) {
        parser_error(expander->parser,
                     token_location(token_at(expander, loop->opener)),
                     "the loop's variable '%.40s' is no float any more",
                     loop->name->text);
        return NULL;
    }
    return value;
}

/* Runs the body once more, or goes on behind it. */
static bool test_for(struct expander *expander)
{
    const struct loop *loop = innermost(expander);
    const struct value *i = loop_variable(expander);
    if (!i) {
        return false;
    }
    bool more = loop->step > 0 ? i->v[0] < loop->end + CLOSE
                               : i->v[0] > loop->end - CLOSE;
    if (more) {
        jump(expander, loop->body);
        return count_iteration(expander, loop->opener);
    }
    leave(expander, loop->opener);
    return true;
}

static bool next_for(struct expander *expander)
{
    struct value *i = loop_variable(expander);
    if (!i) {
        return false;
    }
    i->v[0] += innermost(expander)->step;
    return test_for(expander);
}

static bool begin_for(struct expander *expander, uint32_t opener,
                      struct location at)
{
    if (!expand_need(expander, '(')) {
        return false;
    }
    struct location named = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (!name || !expand_need(expander, ',')) {
        return false;
    }
    if (name->symbol && name->symbol->constant) {
        return parser_error(expander->parser, named,
                            "'%s' is built in and cannot be a loop's "
                            "variable",
                            name->text);
    }
    struct pending *pending = expand_begin(expander, TOK_MODE_FLOATS, USE_FOR,
                                           at);
    if (!pending) {
        return false;
    }
    pending->branch.opener = opener;
    pending->branch.name = name;
    return true;
}

/* Takes the floats that MODE_FLOATS left. */
static bool take_floats(struct expander *expander, struct location at,
                        int least, int most, double *to)
{
    struct parser *parser = expander->parser;
    const struct value *value = eval_pop(parser, expander->count);
    if (expander->count < least || expander->count > most) {
        return parser_error(parser, at,
                            "expected %d%s floats in parentheses, "
                            "found %d",
                            least, most > least ? " or more" : "",
                            expander->count);
    }
    for (int i = 0; i < expander->count; i++) {
        if (value[i].kind != VALUE_NUMBER) {
            return parser_error(parser, at, "expected a float, found a %s",
                                value_name(&value[i]));
        }
        to[i] = eval_float(parser, &value[i], at).v[0];
    }
    return !parser->failed;
}

static bool finish_for(struct expander *expander, const struct pending *pending)
{
    struct parser *parser = expander->parser;
    double bound[3] = {0, 0, 1};
    if (!take_floats(expander, pending->at, 2, 3, bound)) {
        return false;
    }
    if (bound[2] == 0) {
        return parser_error(parser, pending->at, "the loop's step is 0");
    }
    struct symbol *symbol = symbols_local(&parser->symbols,
                                          pending->branch.name);
    struct loop loop = {.opener = pending->branch.opener,
                        .name = pending->branch.name,
                        .body = (uint32_t)expand_frame(expander)->cursor.next,
                        .end = bound[1],
                        .step = bound[2]};
    if (!symbol) {
        return report_no_memory(parser);
    }
    *symbol_value(symbol) = value_float(bound[0]);
    return open_loop(expander, &loop) && test_for(expander);
}

/* ---- conditions -------------------------------------------------------- */

static bool begin_condition(struct expander *expander, enum use use,
                            uint32_t opener)
{
    struct pending *pending = expand_begin(
        expander, TOK_MODE_CONDITION, use,
        token_location(token_at(expander, opener)));
    if (pending) {
        pending->branch.opener = opener;
    }
    return pending;
}

static bool begin_clause(struct expander *expander, uint32_t index)
{
    const struct token *token = token_at(expander, index);
    struct location at = token_location(token);
    bool range = token->kind == TOK_HASH_RANGE;
    if (range && !expand_need(expander, '(')) {
        return false;
    }
    struct pending *pending = range ? expand_begin(expander, TOK_MODE_FLOATS,
                                                   USE_RANGE, at)
                                    : expand_begin(expander, TOK_MODE_CONDITION,
                                                   USE_CASE, at);
    if (pending) {
        pending->branch.opener = index;
    }
    return pending;
}

/* The branch that this directive begins is not taken: tries the next one. */
static bool skip(struct expander *expander, uint32_t directive)
{
    uint32_t next = token_at(expander, directive)->block.next;
    const struct token *token = token_at(expander, next);
    jump(expander, next + 1);
    switch (token->kind) {
    case TOK_HASH_ELSEIF:
        return begin_condition(expander, USE_ELSEIF, next);
    case TOK_HASH_CASE:
    case TOK_HASH_RANGE:
        return begin_clause(expander, next);
    case TOK_HASH_END:
        leave(expander, token->block.pair);
        return true;
    default:
        return true;
    }
}

static bool choose(struct expander *expander, uint32_t directive, bool taken)
{
    return taken || skip(expander, directive);
}

bool branch_ifdef(struct expander *expander, uint32_t opener, bool defined)
{
    bool wanted = token_at(expander, opener)->kind == TOK_HASH_IFDEF;
    return choose(expander, opener, defined == wanted);
}

static bool finish_switch(struct expander *expander, uint32_t opener,
                          double value)
{
    struct loop loop = {.opener = opener, .value = value};
    return open_loop(expander, &loop);
}

/* Runs a clause of the innermost #switch, or tries the next one. After one
 * that was run, the following are run too, whatever they say: so does POV-Ray,
 * though not its manual (3.3.2.6.4). */
static bool take_clause(struct expander *expander,
                        const struct pending *pending, bool fits)
{
    struct loop *loop = innermost(expander);
    loop->taken = loop->taken || fits;
    return choose(expander, pending->branch.opener, loop->taken);
}

static bool finish_range(struct expander *expander,
                         const struct pending *pending)
{
    double bound[2];
    if (!take_floats(expander, pending->at, 2, 2, bound)) {
        return false;
    }
    double value = innermost(expander)->value;
    bool inside = value >= bound[0] - CLOSE && value <= bound[1] + CLOSE;
    return take_clause(expander, pending, inside);
}

static bool decide(struct expander *expander, enum use use, uint32_t opener,
                   double value)
{
    switch (use) {
    case USE_SWITCH:
        return finish_switch(expander, opener, value);
    case USE_WHILE:
        return value_is_true(value) ? count_iteration(expander, opener)
                                    : (leave(expander, opener), true);
    default:
        return choose(expander, opener, value_is_true(value));
    }
}

static bool finish_condition(struct expander *expander,
                             const struct pending *pending)
{
    struct parser *parser = expander->parser;
    double value = eval_float(parser, &expander->result, pending->at).v[0];
    if (parser->failed) {
        return false;
    }
    if (pending->use == USE_CASE) {
        value -= innermost(expander)->value;
        return take_clause(expander, pending, !value_is_true(value));
    }
    return decide(expander, pending->use, pending->branch.opener, value);
}

bool branch_finish(struct expander *expander, const struct pending *pending)
{
    if (!expand_return(expander, pending->frames, pending->at)) {
        return false;
    }
    switch (pending->use) {
    case USE_FOR:
        return finish_for(expander, pending);
    case USE_RANGE:
        return finish_range(expander, pending);
    default:
        return finish_condition(expander, pending);
    }
}

/* ---- directives in the order they are met ------------------------------ */

/* A clause behind one that was run. */
static bool run_clause(struct expander *expander, const struct token *token,
                       uint32_t index)
{
    if (state_of(expander, token->block.pair)) {
        return begin_clause(expander, index);
    }
    leave(expander, token->block.pair);
    return true;
}

/* The end of a branch that was taken. */
static bool run_else(struct expander *expander, const struct token *token)
{
    uint32_t opener = token->block.pair;
    if (token_at(expander, opener)->kind != TOK_HASH_SWITCH) {
        leave(expander, opener);
    }
    return true;
}

/* The end of a macro's body; of one whose head was wrong, the scene goes on
 * behind it. */
static void leave_macro(struct expander *expander, uint32_t opener)
{
    const struct macro *macro = expand_frame(expander)->macro;
    if (macro && macro->define == opener) {
        expand_leave(expander);
    } else {
        leave(expander, opener);
    }
}

static bool run_end(struct expander *expander, const struct token *token)
{
    uint32_t opener = token->block.pair;
    switch (token_at(expander, opener)->kind) {
    case TOK_HASH_WHILE:
        jump(expander, opener);
        return true;
    case TOK_HASH_FOR:
        if (state_of(expander, opener)) {
            return next_for(expander);
        }
        break;
    case TOK_HASH_MACRO:
        leave_macro(expander, opener);
        return true;
    default:
        break;
    }
    leave(expander, opener);
    return true;
}

static bool run_break(struct expander *expander, const struct token *token)
{
    uint32_t opener = token->block.pair;
    if (token_at(expander, opener)->kind == TOK_HASH_MACRO) {
        leave_macro(expander, opener);
    } else {
        leave(expander, opener);
    }
    return true;
}

/* A condition of floats alone is decided at once. */
static bool run_condition(struct expander *expander, enum use use,
                          uint32_t opener)
{
    double value;
    const struct token *end = expand_scalar(expander, '(', true, &value);
    if (!end || end->kind != ')') {
        return begin_condition(expander, use, opener);
    }
    return expand_skip_to(expander, end + 1) &&
           decide(expander, use, opener, value);
}

static bool run_opener(struct expander *expander, const struct token *token,
                       uint32_t opener)
{
    struct location at = token_location(token);
    if (!branch_is_closed(expander, opener)) {
        return false;
    }
    switch (token->kind) {
    case TOK_HASH_IF:
        return run_condition(expander, USE_IF, opener);
    case TOK_HASH_WHILE:
        return run_condition(expander, USE_WHILE, opener);
    case TOK_HASH_SWITCH:
        return run_condition(expander, USE_SWITCH, opener);
    case TOK_HASH_FOR:
        return begin_for(expander, opener, at);
    default:
        return item_defined(expander, ITEM_IFDEF, opener, at);
    }
}

bool branch_run(struct expander *expander, const struct token *token)
{
    uint32_t index = (uint32_t)expand_frame(expander)->cursor.next - 1;
    switch (token->kind) {
    case TOK_HASH_ELSE:
    case TOK_HASH_ELSEIF:
        return run_else(expander, token);
    case TOK_HASH_CASE:
    case TOK_HASH_RANGE:
        return run_clause(expander, token, index);
    case TOK_HASH_BREAK:
        return run_break(expander, token);
    case TOK_HASH_END:
        return run_end(expander, token);
    default:
        return run_opener(expander, token, index);
    }
}
