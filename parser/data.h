/* data.h - runs of plain data: numbers and vectors of numbers, parted by
 * commas, as in the lists of a mesh2.
 *
 * A run is one TOK_DATA to the scanner, so that a text of millions of numbers
 * needs no memory for its tokens. It begins behind a '{' or ',' and ends before
 * a ',' or '}', so that each of its items is a whole value; or it is one
 * vector. */
#ifndef PARSER_DATA_H
#define PARSER_DATA_H
#include <stddef.h>
#include "parser/token.h"
#include "parser/value.h"

struct data_run {
    const char *text, *end;
};

/* The bytes of the run whose first item begins at `text`, which ends with NUL;
 * 0: none that is worth the name. */
size_t data_measure(const char *text);
/* The same for a run that is one vector, of 2 to VALUE_TERMS terms: whatever
 * stands around it, it is an operand. */
size_t data_measure_vector(const char *text);

/* The next token of a run at or behind *at, which moves behind it; returns
 * where it begins, or NULL: the run ends at `end`. */
const char *data_token(const char **at, const char *end,
                       struct token *token);

/* The next item, a float or a vector, which begins at run->text afterwards;
 * returns what stands behind it, or NULL: the run is at its end. */
const char *data_item(struct data_run *run, struct value *value);

#endif
