/* eval.h - what the grammar's rules for values do. Each reports what is wrong
 * and then gives a harmless value. */
#ifndef PARSER_EVAL_H
#define PARSER_EVAL_H
#include "parser/data.h"
#include "parser/parser.h"

/* Some terms of a color: bit i of `given` tells that v[i] is set. */
struct color {
    double v[VALUE_TERMS];
    unsigned given;
};

/* Where a float is wanted. */
struct value eval_float(struct parser *parser, const struct value *value,
                        struct location at);

struct value eval_binary(struct parser *parser, int op, const struct value *a,
                         const struct value *b, struct location at);
struct value eval_negate(struct parser *parser, const struct value *value,
                         struct location at);
struct value eval_not(struct parser *parser, const struct value *value,
                      struct location at);
struct value eval_compare(int op, const struct value *a,
                          const struct value *b);
struct value eval_choice(struct parser *parser, const struct value *condition,
                         const struct value *yes, const struct value *no,
                         struct location at);
/* `value.x`, `value.red` ... */
struct value eval_component(struct parser *parser, const struct value *value,
                            const struct name *component, struct location at);

/* Lists: each item is pushed; what closes the list takes `count` of them. */
void eval_push(struct parser *parser, const struct value *item);
const struct value *eval_pop(struct parser *parser, int count);
struct value eval_components(struct parser *parser, int count,
                             struct location at);
struct value eval_call(struct parser *parser, const struct name *function,
                       int count, struct location at);

/* Gives the items of a run to the open statement, one by one. */
void eval_data(struct parser *parser, struct data_run run,
               struct location at);

/* Colors. `rgb value` and its like by the word; `color value`; `red value`
 * and its like by the term; a color with others of its terms set. */
struct color eval_color_rgb(struct parser *parser, const struct name *word,
                            const struct value *value, struct location at);
struct color eval_color_all(struct parser *parser, const struct value *value,
                            struct location at);
struct color eval_color_term(struct parser *parser, int term,
                             const struct value *value, struct location at);
struct color eval_color_join(const struct color *a, const struct color *b);
struct value eval_color(const struct color *color);

/* Arrays: `{ items }` as a list, `array[sizes]` with a list or NULL. */
struct value eval_list(struct parser *parser, int count);
struct value eval_array(struct parser *parser, int rank,
                        const struct value *list, struct location at);
struct value eval_array_copy(struct parser *parser,
                             const struct value *array);
struct value eval_dimension_size(struct parser *parser,
                                 const struct value *array,
                                 const struct value *dimension,
                                 struct location at);

#endif
