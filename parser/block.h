/* block.h - which directives belong together. */
#ifndef PARSER_BLOCK_H
#define PARSER_BLOCK_H
#include "parser/parser.h"
#include "parser/source.h"

/* Fills the block_link of each #if, #else, #while, #break, #end ... of a text,
 * so that dead branches and loops are jumps. A directive that is out of place
 * becomes a TOK_BAD. False: no memory, reported. */
bool block_link(struct parser *parser, struct source *source);

/* Whether a directive opens a block that #end closes. */
bool block_opens(int kind);

#endif
