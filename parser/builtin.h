/* builtin.h - the functions of the language. */
#ifndef PARSER_BUILTIN_H
#define PARSER_BUILTIN_H
#include "parser/parser.h"

struct value builtin_call(struct parser *parser, const struct name *function,
                          const struct value *argument, int count,
                          struct location at);

/* Whether there is a function of that word. */
bool builtin_exists(const char *word);

#endif
