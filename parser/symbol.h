/* symbol.h - names and what they stand for.
 *
 * Every word of a scene is interned once as a `struct name`; its declarations
 * form a stack, the most local on top, so that looking one up costs nothing.
 * Scopes are dynamic, as in POV-Ray: a macro sees the locals of its caller. */
#ifndef PARSER_SYMBOL_H
#define PARSER_SYMBOL_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/arena.h"
#include "parser/token.h"
#include "parser/value.h"

struct name {
    struct name *chain;             /* of its hash bucket                  */
    const struct keyword *keyword;  /* NULL: an ordinary name              */
    struct symbol *symbol;          /* most local declaration; or NULL     */
    uint32_t hash, length;
    bool reported;                  /* as undeclared                       */
    char text[];
};

/* What `#declare deprecated` says of a name. */
struct deprecation {
    struct string text;             /* empty: the usual warning            */
    bool once;                      /* warn of the first use alone         */
    bool told;
};

struct symbol {
    struct name *name;
    struct symbol *outer;           /* the declaration that this one hides */
    struct symbol *next;            /* in its scope                        */
    uint32_t level;                 /* of its scope; 0 is global           */
    bool constant;                  /* predeclared: cannot be declared     */
    bool reserved;                  /* and a word of POV-Ray's: never said
                                       to be defined                       */
    bool removed;                   /* by #undef                           */
    struct deprecation *deprecated; /* or NULL                             */
    struct value *refers;           /* of a macro's parameter that was given
                                       an identifier: its value; or NULL   */
    struct value value;
};

struct name_table {
    struct arena *arena;
    struct name **bucket;
    size_t buckets, names;
};

struct symbols {
    struct arena *arena;
    struct name_table *table;       /* `own`, or one that is kept          */
    struct name_table own;
    struct symbol *spare;
    void *scope;                    /* newest symbol of each level         */
    size_t scope_room;
    uint32_t level;
};

/* Names lie in `kept` where there is one, whose arena is set, and nothing is
 * declared. False: no memory. */
bool symbols_init(struct symbols *symbols, struct arena *arena,
                  struct name_table *kept);

/* The one `struct name` of a word; NULL: no memory. */
struct name *symbols_name(struct symbols *symbols, const char *text,
                          size_t length);

/* Scopes of macros and included files. False: no memory. */
bool symbols_enter(struct symbols *symbols);
void symbols_leave(struct symbols *symbols);

/* The value a name stands for, to read or to set; NULL: not declared. */
struct value *symbols_find(const struct name *name);
struct value *symbol_value(struct symbol *symbol);

/* #declare: the most local declaration, or else a new global one. #local: the
 * one of the current scope, old or new. NULL: no memory. */
struct symbol *symbols_declare(struct symbols *symbols, struct name *name);
struct symbol *symbols_local(struct symbols *symbols, struct name *name);
/* The same for an outer scope: a macro may end behind a value that a #local
 * outside of it declares. */
struct symbol *symbols_local_at(struct symbols *symbols, struct name *name,
                                uint32_t level);
/* #undef: removes the most local declaration, if any. */
void symbols_undefine(struct name *name);

/* The declared name or keyword most like `name`, for "did you mean"; NULL if
 * none is close. */
const char *symbols_suggest(const struct symbols *symbols,
                            const struct name *name);

#endif
