/* scalar.h - expressions of floats alone, without the grammar.
 *
 * The conditions, counters and indices of loops are made of floats, names of
 * floats, items of arrays and operators. They are read here, several times
 * faster than by a parser of their own; whatever else stands in them is left to
 * the grammar, and so is whatever is wrong with them. */
#ifndef PARSER_SCALAR_H
#define PARSER_SCALAR_H
#include <stdbool.h>
#include "parser/token.h"

/* The float that the tokens from `token` on make, and the token behind it.
 * NULL: something else stands there, or there is a mistake. Relations and
 * logic may stand at the outside if `full`, else in parentheses alone. */
const struct token *scalar_read(const struct token *token, bool full,
                                double *value);

#endif
