/* lexer.h - characters to tokens with their places; no meaning. */
#ifndef PARSER_LEXER_H
#define PARSER_LEXER_H
#include "parser/parser.h"
#include "parser/source.h"

struct lexer;

/* Begins to scan source->text, which must have two NULs behind its `length`
 * bytes. Several may scan a text in turns. NULL: no memory or too large,
 * reported. What tokens point at lies in the arena. */
struct lexer *lexer_open(struct parser *parser, struct source *source,
                         struct arena *arena);
void lexer_close(struct lexer *lexer);

/* Scans the next tokens, at most `room` and none behind TOK_END, and returns
 * how many. What is wrong with the text becomes a TOK_BAD, which is reported
 * if it is ever reached. 0: no memory, reported. */
size_t lexer_scan(struct lexer *lexer, struct token *token, size_t room);

#endif
