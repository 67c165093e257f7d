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

/* The run whose first item begins at `text`, which ends with NUL; of length 0:
 * none that is worth the name. Where no list is, only a vector of 2 to
 * VALUE_TERMS terms is one: whatever stands around it, it is an operand. */
struct data_span data_measure(const char *text, bool list);

static inline const char *data_skip_blanks(const char *c)
{
    while (*c == ' ' || (*c >= '\t' && *c <= '\r'))
        c++;
    return c;
}

/* The next token of a run at or behind *at, which moves behind it; returns
 * where it begins, or NULL: the run ends at `end`. */
const char *data_token(const char **at, const char *end,
                       struct token *token);

/* The next item, a float or a vector, which begins at run->text afterwards;
 * returns what stands behind it, or NULL: the run is at its end. */
const char *data_item(struct data_run *run, struct value *value);

#endif
