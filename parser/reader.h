/* reader.h - the tokens of a text, scanned as they are wanted.
 *
 * A text comes in chunks, each a run of tokens in which every block that is
 * opened (#if, #while, #macro ...) is closed too; only an unclosed block makes
 * one that lasts to the end of the text. What is behind is forgotten, save
 * chunks with macros, which may be called, and texts of one chunk, which may
 * be included again. */
#ifndef PARSER_READER_H
#define PARSER_READER_H
#include "parser/grammar.h"
#include "parser/parser.h"
#include "parser/source.h"

/* The last token is TOK_END, or TOK_MORE where the text goes on. */
struct chunk {
    struct token *token;
    size_t tokens, room;
    const char *text;           /* that the tokens were scanned from       */
    bool kept;                  /* must not be overwritten                 */
    struct chunk *next;         /* of all those of the parser              */
    struct chunk *spare;        /* of those that may be overwritten        */
    struct kept_text *of;       /* that has it, or NULL; then              */
    struct chunk *after;        /* the text's next                         */
    struct kept_mesh *mesh, *mesh_last, *mesh_hint;
};

struct reader;

/* A place between tokens; `data` is set within a run of plain data. */
struct cursor {
    struct reader *reader;      /* NULL: the chunk is all there is         */
    struct chunk *chunk;
    size_t next;                /* index of the next token                 */
    size_t passed;              /* chunks before this one                  */
    const char *data, *data_end;    /* behind `token`; end of the run      */
    struct token token;             /* of the run, if has_token: the next  */
    bool has_token;
};

/* At the first token of a text. False: reported. */
bool reader_open(struct parser *parser, struct source *source,
                 struct cursor *cursor);
void reader_close(struct parser *parser, struct cursor *cursor);

/* Frees the tokens of all texts, whose readers need not be closed. */
void reader_release(struct parser *parser);

/* For the token where something special is done to get the next one. */
struct token *cursor_special(struct cursor *cursor);

/* The next token, which stays where it is until the one behind it is asked
 * for. */
static inline struct token *cursor_peek(struct cursor *cursor)
{
    struct token *token = &cursor->chunk->token[cursor->next];
    bool special = token->kind == TOK_MORE || token->kind == TOK_DATA;
    return special ? cursor_special(cursor) : token;
}

static inline void cursor_skip(struct cursor *cursor)
{
    if (cursor->data) {
        cursor->has_token = false;
    } else {
        cursor->next++;
    }
}

/* Goes to a token of the chunk. */
static inline void cursor_jump(struct cursor *cursor, size_t next)
{
    cursor->next = next;
    cursor->data = NULL;
}

/* The run of data that comes next, all of it; NULL: something else does. */
static inline struct token *cursor_run(const struct cursor *cursor)
{
    struct token *token = &cursor->chunk->token[cursor->next];
    return token->kind == TOK_DATA && !cursor->data ? token : NULL;
}

#endif
