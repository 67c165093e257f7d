/* recover.c - going on behind an error, where every error is wanted.
 *
 * An error of the grammar, or one that leaves a statement in pieces, gives up
 * what is open: the text goes on behind the outermost statement. A name that
 * stands for nothing loses its numbers or its braces only. Directives run
 * while tokens are dropped, so that what they declare is there later. */
#include "parser/build.h"
#include "parser/expand.h"
#include "parser/formula.h"
#include "parser/report.h"

/* More are no help. */
enum { MOST_ERRORS = 100 };

/* ---- dropping tokens --------------------------------------------------- */

static void drop(struct pending *pending, size_t depth)
{
    pending->dropping = true;
    pending->drop_depth = depth;
}

/* Tokens before which dropping ends, outside of brackets. */
static bool begins_anew(int kind)
{
    return kind == TOK_WORD || kind == TOK_TEXTURE || kind == '}' ||
           kind == TOK_END;
}

bool recover_drops(struct pending *pending, int kind)
{
    size_t *depth = &pending->drop_depth;

    if (kind == TOK_END || (*depth == 0 && begins_anew(kind))) {
        pending->dropping = false;
        return false;
    }
    if (kind == '{' || kind == '(' || kind == '[')
        ++*depth;
    else if ((kind == '}' || kind == ')' || kind == ']') && *depth > 0)
        pending->dropping = --*depth > 0 || kind != '}';
    return true;
}

/* ---- names that stand for nothing -------------------------------------- */

/* A token behind a name that shows it to have been a number. */
static bool follows_value(int kind)
{
    return kind == ',' || kind == '}' || kind == ')' || kind == '>' ||
           kind == '+' || kind == '-' || kind == '*' || kind == '/' ||
           kind == TOK_DOT;
}

bool recover_ends(const struct expander *expander)
{
    const struct pending *pending = &expander->pending[expander->pendings - 1];

    const struct cursor *cursor = &expand_frame(expander)->cursor;
    const struct token *token = &cursor->chunk->token[cursor->next];

    return pending->dropping && pending->drop_depth == 0 && !cursor->data &&
           token->kind == TOK_IDENTIFIER && token[1].kind == '{';
}

bool recover_undeclared(struct expander *expander, struct name *name,
                        struct location at)
{
    struct parser *parser = expander->parser;
    struct pending *pending = &expander->pending[expander->pendings - 1];

    if (!name->reported)
        report_undeclared(parser, at, name);
    name->reported = true;
    parser->failed = true;
    if (!parser->in->all_errors || parser->fatal)
        return false;
    parser->failed = false;
    expand_skip(expander);
    if (!grammar_accepts(pending->state, TOK_WORD) ||
        follows_value(expand_peek(expander)->kind)) {
        struct value zero = value_float(0);
        expand_hold(expander, &zero, at);
        return true;
    }
    drop(pending, 0);
    return true;
}

/* ---- what is open is given up ------------------------------------------ */

/* Braces of all that is open: those of a scene that lacks one do not count. */
static size_t open_braces(const struct expander *expander)
{
    size_t braces = 0;

    for (size_t i = 0; i < expander->pendings; i++)
        braces += expander->pending[i].braces;
    if (expander->parser->brace_missing && braces > 0)
        braces = 1;
    return braces;
}

/* The same place twice: the token there is passed over. False: there is
 * none. */
static bool advance(struct expander *expander)
{
    struct location at = token_location(expand_peek(expander));
    struct location last = expander->recovered;
    bool stuck = at.offset == last.offset && at.source == last.source &&
                 expander->recoveries == expander->pushed;

    expander->recovered = at;
    expander->recoveries = expander->pushed;
    if (!stuck)
        return true;
    if (expand_peek(expander)->kind == TOK_END)
        return false;
    expand_skip(expander);
    return true;
}

static bool begin_anew(struct expander *expander)
{
    while (expander->pendings > 0)
        scene_yypstate_delete(expander->pending[--expander->pendings].state);
    expander->calls = expander->actuals = 0;
    expander->held = expander->want_name = false;
    if (!expand_begin(expander, TOK_MODE_SCENE, USE_NONE, (struct location){0}))
        return false;
    /* It is the scene's, whatever is being read now. */
    expander->pending[0].frames = 1;
    expander->pending[0].start = expander->pending[0].passed = 0;
    return true;
}

bool recover_after_error(struct expander *expander)
{
    struct parser *parser = expander->parser;
    size_t braces = open_braces(expander);

    if (!parser->in->all_errors || parser->fatal)
        return false;
    if (parser->diag->errors >= MOST_ERRORS)
        return false;
    parser->failed = parser->brace_missing = false;
    parser->stacked = 0;
    formula_reset(parser);
    expand_leave_names(expander);
    build_reset(parser);
    if (!advance(expander) || !begin_anew(expander))
        return false;
    drop(&expander->pending[0], braces);
    return true;
}
