/* expander.h - the filter between scanner and grammar: runs directives, calls
 * macros, turns declared names into tokens of their kind, and pushes what is
 * left.
 *
 * Nothing here recurses over what a user nests: texts and macro bodies being
 * read, loops, and values being parsed are kept on stacks. */
#ifndef PARSER_EXPANDER_H
#define PARSER_EXPANDER_H
#include "parser/parser.h"

/* Reads the scene's text to its end. False: an error was reported. */
bool expander_run(struct parser *parser);

/* What the grammar's start rules hand over: the value that was parsed, or how
 * many values it left on parser->stack. */
void expander_result(struct parser *parser, const struct value *value);
void expander_count(struct parser *parser, int count);

/* Whether the next name goes to the grammar as it is, whatever it means. */
void expander_want_name(struct parser *parser, bool wanted);

/* The directive under way, for diagnostics without a better place. */
struct location expander_place(const struct parser *parser);

/* Counts tokens that were not pushed one by one; over a limit, an error. */
void expander_spend(struct parser *parser, int tokens, struct location at);

/* How many tokens were pushed so far. */
uint64_t expander_tokens(const struct parser *parser);

/* The texts and macros being read besides the scene itself, innermost first:
 * where each was included or called; `macro` is NULL for a text. */
struct expander_call {
    struct location at;
    const char *macro;
};
int expander_depth(const struct parser *parser);
void expander_call(const struct parser *parser, int depth,
                   struct expander_call *call);

#endif
