/* parser.h - what the parts of the front end share while a scene is read:
 * the expander, the grammar's actions and the builder. Private to parser/. */
#ifndef PARSER_PARSER_H
#define PARSER_PARSER_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/arena.h"
#include "lib/error.h"
#include "parser/diag.h"
#include "parser/parse.h"
#include "parser/symbol.h"
#include "parser/token.h"
#include "parser/value.h"

struct source;
struct reader;
struct chunk;
struct expander;
struct macro;
struct builder;
struct formula_scope;

struct parser {
    const struct parse_input *in;
    struct parse_result *out;
    struct parse_limits limits;     /* defaults filled in                  */
    struct diag *diag;
    struct arena arena;             /* tokens, names, values, nodes        */
    struct symbols symbols;
    struct source **source;         /* texts, by location.source           */
    size_t sources, source_room;
    size_t source_bytes;            /* held by texts and their tokens      */
    size_t scene_bytes;             /* about those of core's scene         */
    struct reader *readers;         /* all of them                         */
    struct chunk *chunks;           /* all of them                         */
    struct stream *streams;         /* that the scene opened               */
    size_t written;                 /* bytes, to all of them               */
    struct chunk *spare_chunk;      /* those that may be overwritten       */
    struct expander *expander;
    struct value *stack;            /* numbers and strings of lists that the
                                       grammar has not closed yet          */
    size_t stacked, stack_room;
    uint32_t *random;               /* state of each stream of seed()      */
    size_t randoms, random_room;
    double version;                 /* of #version                         */
    struct builder *builder;
    struct formula_scope *formula;  /* of the innermost function being read */
    bool failed;                    /* an error was reported: stop, or go on
                                       with the next statement             */
    bool fatal;                     /* and nothing can come after it       */
    bool brace_missing;             /* that error was for want of a '}'    */
    struct location warned[64];     /* offset + 1, by offset               */
};

/* Report at a place of the scene, with its line, the trace of includes and
 * macros, and a hint if there is one to give. An error stops the parse after
 * the current action, which need not undo anything. Always false. */
bool parser_error(struct parser *parser, struct location at,
                  const char *format, ...) BRUME_PRINTF(3, 4);
/* An error that leaves the rest of its statement sound: where every error is
 * wanted, the statement is read on. Always false. */
bool parser_mistake(struct parser *parser, struct location at,
                    const char *format, ...) BRUME_PRINTF(3, 4);
/* As above with a code other than BRUME_ERR_SCENE and a hint (or NULL). */
bool parser_fail(struct parser *parser, enum brume_code code,
                 struct location at, const char *hint, const char *format,
                 ...) BRUME_PRINTF(5, 6);
void parser_warn(struct parser *parser, struct location at,
                 const char *format, ...) BRUME_PRINTF(3, 4);
/* Reports an error that core or lib gave, as if it stood at `at`. */
bool parser_relay(struct parser *parser, struct location at,
                  const struct brume_error *err);

/* From the parse arena, zeroed. NULL: the limit was reported. */
void *parser_alloc(struct parser *parser, size_t size);
void *parser_array(struct parser *parser, size_t count, size_t size);

/* Counts about so many bytes that core or lib hold for the scene. False: the
 * limit was reported. */
bool parser_hold(struct parser *parser, struct location at, size_t bytes);

/* Where a file of that name is, by the folder of the text that names it, the
 * scene's folder and the library path; the path lies in the arena. NULL: not
 * found, or not allowed, and reported. Data files may lie anywhere; scene
 * texts are held to the permitted folders. */
enum parser_purpose { PARSER_TEXT, PARSER_DATA };
const char *parser_find_file(struct parser *parser, struct location at,
                             struct string name,
                             enum parser_purpose purpose);
/* Whether a text of that name would be found; nothing is reported. */
bool parser_file_exists(struct parser *parser, struct location at,
                        struct string name);

#endif
