/* report.h - what goes wrong between the expander and the grammar. */
#ifndef PARSER_REPORT_H
#define PARSER_REPORT_H
#include "parser/parser.h"

/* A token that does not fit: `expected` are kinds of tokens, of which the
 * important ones are named. */
void report_unexpected(struct parser *parser, struct location at, int found,
                       const int *expected, int count);
/* The same where one thing alone can stand. */
void report_wanted(struct parser *parser, struct location at,
                   const char *wanted, int found);
/* A word that stands for nothing, with the word that may be meant. */
void report_undeclared(struct parser *parser, struct location at,
                       const struct name *name);
/* A token that is not one: TOK_BAD, TOK_UNSUPPORTED. */
void report_bad(struct parser *parser, const struct token *token);

/* A word that means nothing in the statement `in`, or, NULL, where none is
 * open. Always false. */
bool report_unknown(struct parser *parser, struct location at,
                    const char *word, const char *in);
/* The line of a place in its text. */
int report_line(const struct parser *parser, struct location at);
/* Whether nothing but blanks stands before it there. */
bool report_begins_line(const struct parser *parser, struct location at);

/* The grammar's stack cannot grow: `depth` was reached, or memory. */
void report_exhausted(struct parser *parser, struct location at, int depth);
/* An arena gave NULL. Always false. */
bool report_no_memory(struct parser *parser);

/* The text of the token at `at`, cut where it is long; in the arena. */
const char *report_spelling(struct parser *parser, struct location at);

#endif
