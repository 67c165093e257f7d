/* expand.h - what the expander's files share. Private to expander.c,
 * directive.c, fileio.c, branch.c, macro.c and item.c. */
#ifndef PARSER_EXPAND_H
#define PARSER_EXPAND_H
#include "parser/expander.h"
#include "parser/grammar.h"
#include "parser/reader.h"
#include "parser/source.h"
#include "parser/stream.h"

/* What tokens are read from: a text, or a macro's body within one. */
struct frame {
    struct cursor cursor;
    struct macro *macro;        /* NULL: a text                            */
    struct location called;     /* of the #include or the macro's name     */
    size_t loops;               /* open when the frame began               */
    uint32_t level;             /* of its scope of names                   */
};

/* A #for or #switch that is being run; other blocks need no state. */
struct loop {
    uint32_t opener;            /* its token                               */
    uint32_t body;              /* #for: the first token of the body       */
    struct name *name;          /* #for                                    */
    double end, step;           /* #for                                    */
    double value;               /* #switch                                 */
    bool taken;                 /* #switch: a clause was run               */
};

struct macro {
    struct name *name;
    struct name **parameter;
    int parameters;
    struct chunk *chunk;
    size_t define;              /* its #macro                              */
    size_t body;                /* its first token                         */
};

/* An argument of a macro: a value, or what an identifier stands for. */
struct actual {
    struct value value;
    struct value *refers;       /* NULL: `value`                           */
};

/* What is done with a value once its parser has taken the last token. */
enum use {
    USE_NONE,                   /* the scene itself                        */
    USE_DECLARE, USE_VERSION, USE_DEFAULT,
    USE_INCLUDE, USE_DEBUG, USE_WARNING, USE_ERROR,
    USE_IF, USE_ELSEIF, USE_WHILE, USE_SWITCH, USE_CASE, USE_RANGE, USE_FOR,
    USE_INDEX, USE_ARGUMENT, USE_FOPEN, USE_WRITE
};

/* What is done with an array's item once its last index is known. */
enum item_use {
    ITEM_TOKEN, ITEM_DECLARE, ITEM_DEFINED, ITEM_IFDEF, ITEM_ARGUMENT,
    ITEM_READ, ITEM_UNDEF
};

/* An array's item being sought, index by index. */
struct seek {
    struct value *item;         /* the array, then what the indices name   */
    int dimension;              /* indices of this array known so far      */
    uint32_t offset;
    enum item_use use;
    union {
        uint32_t opener;        /* ITEM_IFDEF                              */
        struct value *file;     /* ITEM_READ                               */
    };
};

/* What a value is declared to be. */
struct target {
    struct name *name;
    struct value *item;         /* of an array; NULL: the name             */
    bool local;
    uint32_t level;             /* of the scope that a local belongs to    */
    struct deprecation *deprecated;
};

/* A value being parsed by a parser of its own, inside of another one. */
struct pending {
    enum use use;
    struct scene_yypstate *state;
    struct location at;         /* of the directive or the macro's name    */
    size_t frames;              /* open when it began                      */
    size_t start, passed;       /* of the frame's cursor when it began     */
    size_t depth;               /* brackets that are open in it            */
    size_t braces;              /* of them                                 */
    int last;                   /* the token that was pushed last          */
    bool open_ended;            /* ends where no token fits any more       */
    bool dropping;              /* tokens are lost after an error,         */
    size_t drop_depth;          /* within so many brackets                 */
    union {
        struct target target;           /* USE_DECLARE                     */
        struct seek seek;               /* USE_INDEX                       */
        struct name *file;              /* USE_FOPEN                       */
        struct {
            struct value *file;         /* USE_WRITE                       */
            enum stream_word word;
        } write;
        struct {
            uint32_t opener;            /* USE_IF ... USE_FOR: its token   */
            struct name *name;          /* USE_FOR                         */
        } branch;
    };
};

/* A macro call whose arguments are being read. */
struct call {
    struct macro *macro;
    struct location at;
    size_t first;               /* of the arguments, in expander.actual    */
    int count;
};

struct expander {
    struct parser *parser;
    struct frame *frame;
    size_t frames, frame_room;
    size_t texts;                   /* of the frames                       */
    struct loop *loop;
    size_t loops, loop_room;
    struct pending *pending;        /* [0] is the scene                    */
    size_t pendings, pending_room;
    struct call *call;
    size_t calls, call_room;
    struct actual *actual;          /* of all open calls                   */
    size_t actuals, actual_room;
    struct scene_yypstate **spare;  /* parsers to be used again            */
    size_t spares, spare_room;
    struct location place;          /* of the last token that was pushed   */
    bool want_name;                 /* see expander_want_name              */
    bool held;                      /* hold_value is to be pushed next     */
    struct location hold_at;
    struct value hold_value;
    struct value result;            /* of the last parser that finished    */
    int count;
    uint64_t tokens, iterations, ticks;
    uint64_t pushed, recoveries;    /* tokens that the grammar has seen; at
                                       the last error that was overcome,   */
    struct location recovered;      /* and where that was                  */
    double deadline;                /* of timer_now; 0: none               */
};

/* Functions that give false have reported an error. */

/* ---- expander.c ---- */

static inline struct frame *expand_frame(const struct expander *expander)
{
    return &expander->frame[expander->frames - 1];
}

/* The next token of the innermost frame, not expanded. */
static inline struct token *expand_peek(const struct expander *expander)
{
    return cursor_peek(&expand_frame(expander)->cursor);
}

static inline void expand_skip(const struct expander *expander)
{
    cursor_skip(&expand_frame(expander)->cursor);
}

/* Asks the clock and the caller whether to go on. */
bool expand_may_go_on(struct expander *expander, struct location at);

/* The same, now and then. */
static inline bool expand_tick(struct expander *expander, struct location at)
{
    enum { CHECK = 4096 };
    return ++expander->ticks % CHECK != 0 || expand_may_go_on(expander, at);
}

/* Pushes what comes next. False: reported. */
bool expand_step(struct expander *expander);
/* Takes the next token if it is of that kind. */
bool expand_take(struct expander *expander, int kind);
/* Takes the next token, which must be of that kind. */
bool expand_need(struct expander *expander, int kind);
/* The name that must come next; NULL: there is none. */
struct name *expand_need_name(struct expander *expander);

/* The stack `items` with room for `need` of them; NULL: an error. */
void *expand_grow(struct expander *expander, void *items, size_t *room,
                  size_t need, size_t size);
/* Leaves scopes of names that are not of the innermost text or call. */
void expand_leave_names(struct expander *expander);
bool expand_enter(struct expander *expander, const struct frame *frame);
/* Leaves the text or body that is being read, and its scope of names. */
void expand_leave(struct expander *expander);
/* Begins a value; `mode` is a TOK_MODE_. NULL: an error. */
struct pending *expand_begin(struct expander *expander, int mode,
                             enum use use, struct location at);
/* Sets a token aside that is pushed before the next one is read. */
void expand_hold(struct expander *expander, const struct value *value,
                 struct location at);
/* Out of macros that ended with the last token, until so many frames are
 * left. */
bool expand_return(struct expander *expander, size_t frames,
                   struct location at);

/* ---- recover.c ---- */

/* While pending->dropping: whether a token is lost, being what an error made
 * worthless. */
bool recover_drops(struct pending *pending, int kind);
/* Whether the name that comes next seems to begin a statement, so that no more
 * is lost. */
bool recover_ends(const struct expander *expander);
/* Reports a name that stands for nothing and that comes next. */
bool recover_undeclared(struct expander *expander, struct name *name,
                        struct location at);
/* Makes the parse go on after an error was reported; false: it ends here. */
bool recover_after_error(struct expander *expander);

/* Reads floats alone (scalar.h) from the next token on, which must be `begin`
 * unless that is 0, and gives the token behind them. NULL: they are for the
 * grammar. Nothing is taken until expand_skip_to, which goes to a token of the
 * same chunk and counts those before it. */
const struct token *expand_scalar(const struct expander *expander, int begin,
                                  bool full, double *value);
bool expand_skip_to(struct expander *expander, const struct token *token);

/* ---- directive.c ---- */

bool directive_run(struct expander *expander, const struct token *token);
/* A word without a rule: POV-Ray takes some directives without their '#'. */
bool directive_run_bare(struct expander *expander,
                        const struct token *token);
bool directive_finish(struct expander *expander,
                      const struct pending *pending);
/* Warns if a name that is used was declared deprecated. */
void directive_used(struct expander *expander, const struct token *token);
/* Whether #declare needs its ';'. */
bool directive_strict(const struct expander *expander);
bool directive_declare_item(struct expander *expander, struct value *item,
                            struct location at);

/* Whether a name may be declared: it is not built in. */
bool directive_may_declare(struct expander *expander,
                           const struct name *name, struct location at);
/* Takes a reserved word that has no token of its own. */
bool directive_take_word(struct expander *expander, const char *word);

/* ---- fileio.c: #fopen, #fclose, #read, #write --------------------------- */

bool fileio_run(struct expander *expander, const struct token *token);
bool fileio_finish(struct expander *expander, const struct pending *pending);
/* Goes on with a #read, whose next value goes to an item of an array. */
bool fileio_item(struct expander *expander, const struct seek *seek,
                 struct location at);

/* ---- branch.c: blocks of directives ---- */

bool branch_run(struct expander *expander, const struct token *token);
bool branch_finish(struct expander *expander, const struct pending *pending);
/* Goes on after an #ifdef or #ifndef. */
bool branch_ifdef(struct expander *expander, uint32_t opener, bool defined);
/* Whether the block that the token opens has its #end. */
bool branch_is_closed(struct expander *expander, uint32_t opener);

/* ---- macro.c ---- */

bool macro_define(struct expander *expander);
bool macro_call(struct expander *expander, struct macro *macro,
                struct location at);
/* Adds an argument: a value, or what an identifier stands for. */
bool macro_argument(struct expander *expander, const struct value *value,
                    struct value *refers);
/* The same for an item of an array, which may be the begin of a value. */
bool macro_item(struct expander *expander, struct value *item,
                struct location at);

/* ---- item.c: items of arrays ---- */

/* Begins to seek an item of an array, at the '[' that comes next. */
bool item_seek(struct expander *expander, const struct seek *seek,
               struct location at);
/* An index is known. */
bool item_finish(struct expander *expander, const struct pending *pending);
/* `defined(NAME)`, `#ifdef (NAME)`: the parenthesis and what it says. */
bool item_defined(struct expander *expander, enum item_use use,
                  uint32_t opener, struct location at);

#endif
