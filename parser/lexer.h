/* lexer.h - characters to tokens with their places; no meaning. */
#ifndef PARSER_LEXER_H
#define PARSER_LEXER_H
#include "parser/parser.h"
#include "parser/source.h"

/* Fills source->token from source->text, which must have two NULs behind its
 * `length` bytes. What is wrong with the text becomes a TOK_BAD, which is
 * reported if it is ever reached. False: no memory or too large, reported. */
bool lexer_scan(struct parser *parser, struct source *source);

#endif
