/* block.h - which directives belong together. */
#ifndef PARSER_BLOCK_H
#define PARSER_BLOCK_H
#include "parser/parser.h"
#include "parser/source.h"

struct open_block;

/* Blocks of a text that are open where it is read to. Zero to begin with; the
 * caller frees `open`. */
struct linker {
    struct open_block *open;
    size_t count, room;
};

/* Fills the block_link of token[index] and of those it belongs to, all of
 * which are in the array, so that dead branches and loops are jumps. A
 * directive that is out of place becomes a TOK_BAD. False: no memory,
 * reported. */
bool block_link(struct linker *linker, struct parser *parser,
                struct token *token, uint32_t index);

#endif
