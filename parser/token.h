/* token.h - what the scanner makes of a text: tokens and where they stand. */
#ifndef PARSER_TOKEN_H
#define PARSER_TOKEN_H
#include <stdbool.h>
#include <stdint.h>
#include "parser/value.h"

/* A place in a text, kept small since every token carries one; lines and
 * columns are counted only when a diagnostic needs them. */
struct location {
    uint32_t offset;        /* bytes from the start of the text            */
    uint32_t source;        /* index in the parser's table of texts        */
};

struct name;

/* `kind` is an enum scene_yytokentype of the grammar. */
struct token {
    uint16_t kind;
    uint16_t source;
    uint32_t offset;
    union {
        double number;                  /* TOK_NUMBER                      */
        const struct string *string;    /* TOK_STRING                      */
        struct name *name;              /* TOK_IDENTIFIER and keywords     */
        const char *error;              /* TOK_BAD: what is wrong with it  */
        uint64_t match;                 /* of a directive: see directive.c */
    };
};

enum keyword_flags {
    KEYWORD_RESERVED = 0,   /* POV-Ray's: never a declared name            */
    KEYWORD_EXTENSION = 1   /* Brume's: a keyword only where the grammar has
                               room for it and the name is not declared    */
};

/* Rows are sorted by `word`. A word of POV-Ray that has no rule yet has the
 * kind TOK_UNSUPPORTED. */
struct keyword {
    const char *word;
    uint16_t kind;
    uint16_t flags;
};
extern const struct keyword keyword_table[];
extern const int keyword_count;

#endif
