/* token.h - what the scanner makes of a text: tokens and where they stand. */
#ifndef PARSER_TOKEN_H
#define PARSER_TOKEN_H
#include <stdbool.h>
#include <stdint.h>

/* A place in a text, kept small since every token carries one; lines and
 * columns are counted only when a diagnostic needs them. */
struct location {
    uint32_t offset;        /* bytes from the start of the text            */
    uint32_t source;        /* index in the parser's table of texts        */
};

struct name;
struct string;

/* Where a directive stands among those of its block; all are indices of
 * tokens of the same text, 0: there is none. */
struct block_link {
    uint32_t next;          /* the block's next directive: #else ... #end  */
    uint32_t pair;          /* of one that opens a block, its #end; of the
                               others, the one that opened it              */
};

/* A run of plain data (data.h). */
struct data_span {
    uint32_t length;        /* bytes of the text                           */
    bool vector;            /* it is one vector                            */
};

/* `kind` is an enum scene_yytokentype of the grammar. */
struct token {
    uint16_t kind;
    uint16_t source;
    uint32_t offset;
    union {
        double number;                  /* TOK_NUMBER                      */
        const struct string *string;    /* TOK_STRING                      */
        struct name *name;              /* words, TOK_DOT, TOK_UNSUPPORTED */
        const char *error;              /* TOK_BAD: what is wrong with it  */
        struct block_link block;        /* directives of blocks            */
        struct data_span data;          /* TOK_DATA                        */
    };
};

enum keyword_flags {
    KEYWORD_RESERVED = 0,   /* POV-Ray's: never a declared name            */
    KEYWORD_EXTENSION = 1   /* Brume's: a keyword only where the grammar has
                               room for it and the name is not declared    */
};

/* A word of the language. One of POV-Ray's that has no rule yet has the kind
 * TOK_UNSUPPORTED. */
struct keyword {
    const char *word;
    uint16_t kind;
    uint16_t flags;
};

/* Both tables are sorted by `word`, by strcmp. */
extern const struct keyword keyword_table[];
extern const int keyword_count;
/* The words after '#'. */
extern const struct keyword directive_table[];
extern const int directive_count;

static inline struct location token_location(const struct token *token)
{
    return (struct location){token->offset, token->source};
}

#endif
