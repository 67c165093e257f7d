/* formula.h - user functions: from expressions to functions of core.
 *
 * While the body of `function(a, b) { ... }` is read, its parameters stand for
 * formulas instead of numbers. The rules of the grammar for numbers then make
 * larger formulas of them; numbers among themselves are computed as ever. At
 * the end the formula is written to core as a function. */
#ifndef PARSER_FORMULA_H
#define PARSER_FORMULA_H
#include "parser/parser.h"

/* What a function identifier stands for. */
struct function {
    int id;                     /* in core                                 */
    int parameters, results;
    int columns, rows;          /* `function 200, 100 { ... }`; 0: none    */
};

/* ---- the body of a function, as the grammar comes to its parts ---- */

/* Its parameters, one after the other, and that they are complete. */
void formula_parameter(struct parser *parser, const struct name *name);
void formula_parameters(struct parser *parser);
/* Columns and rows, pushed; see eval_push. */
void formula_grid(struct parser *parser, struct location at);
void formula_open(struct parser *parser);
/* What the body is: an expression, one of POV-Ray's own functions, or a
 * statement, which formula_suspend has let begin. */
void formula_body(struct parser *parser, const struct value *value,
                  struct location at);
void formula_internal(struct parser *parser, const struct value *number,
                      struct location at);
void formula_suspend(struct parser *parser);
void formula_statement(struct parser *parser, struct location at);
/* The function; VALUE_NONE once the parse has failed. */
struct value formula_close(struct parser *parser);

/* `sum(i, first, last, term)`: i stands for a formula between these two. */
void formula_series_open(struct parser *parser, const struct name *name);
struct value formula_series_close(struct parser *parser,
                                  const struct name *word,
                                  const struct value *first,
                                  const struct value *last,
                                  const struct value *term,
                                  struct location at);

/* All open functions are given up: the text goes on behind an error. */
void formula_reset(struct parser *parser);

/* ---- expressions: of which an operand is a formula ---- */

static inline bool formula_is(const struct value *value)
{
    return value->kind == VALUE_FORMULA;
}

/* `op` is an enum value_operator. */
struct value formula_binary(struct parser *parser, int op,
                            const struct value *a, const struct value *b,
                            struct location at);
struct value formula_negate(struct parser *parser, const struct value *a,
                            struct location at);
struct value formula_not(struct parser *parser, const struct value *a,
                         struct location at);
/* A component of what a function gives: its index, or these. */
enum formula_part { FORMULA_GRAY = 100, FORMULA_HEIGHT };
struct value formula_component(struct parser *parser, const struct value *a,
                               enum formula_part part, struct location at);
/* A numeric function of the language. */
struct value formula_builtin(struct parser *parser, const char *word,
                             const struct value *argument, int count,
                             struct location at);
/* A spline's point at a formula. */
struct value formula_spline(struct parser *parser, int id, int terms, int kind,
                            const struct value *t, struct location at);
/* A user's function called with the `count` values pushed last: a number
 * where all of them are. */
struct value formula_call(struct parser *parser, const struct value *function,
                          int count, struct location at);

#endif
