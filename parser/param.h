/* param.h - parameters of statements as tables: a parameter is one row. */
#ifndef PARSER_PARAM_H
#define PARSER_PARAM_H
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include "parser/parser.h"

enum param_kind {
    PARAM_FLOAT,        /* double                                          */
    PARAM_INTEGER,      /* int                                             */
    PARAM_VECTOR,       /* double[3]                                       */
    PARAM_RGB,          /* double[3]; filter and transmit do not matter    */
    PARAM_COLOR,        /* double[5]                                       */
    PARAM_PAIR,         /* double[2]: a number, then another after a comma */
    PARAM_SWITCH,       /* bool; alone it is on                            */
    PARAM_MARK,         /* int: set to `alone`, takes no number            */
    PARAM_CLEAR,        /* bool: set to false, takes no number             */
    PARAM_CHOICE,       /* int: one of the words of `choice`               */
    PARAM_VALUES,       /* least..most numbers and strings, which the
                           statement's `values` takes                      */
    PARAM_IGNORED       /* up to `most` numbers without effect             */
};

/* The most numbers and strings that a word takes. */
enum { PARAM_MOST = 8 };

/* The bounds themselves are allowed unless `open` says otherwise. */
enum { PARAM_ABOVE = 1, PARAM_BELOW = 2 };

struct param {
    const char *word;
    enum param_kind kind;
    double start[3];        /* default                                     */
    double low, high;       /* of each term                                */
    unsigned open;
    size_t offset;          /* where it goes in the statement's node       */
    unsigned given;         /* bit that tells that it was set              */
    double alone;           /* value of the word without a number; NAN: a
                               number must follow                          */
    const char *const *choice;      /* ends with NULL; values from 0       */
    const char *note;       /* why the word has no effect; or NULL         */
    int least, most;        /* of PARAM_VALUES and PARAM_IGNORED           */
    int id;                 /* what a statement knows the row by           */
};

/* A row with a number; `start_` is the default of each term. */
#define PARAM_ROW(word_, kind_, start_, low_, high_, open_, given_, type,     \
                  member)                                                     \
    {.word = word_, .kind = kind_, .start = {start_, start_, start_},         \
     .low = low_, .high = high_, .open = open_,                               \
     .offset = offsetof(type, member), .given = given_, .alone = NAN}
#define PARAM_ANY(word, kind, start, given, type, member)                     \
    PARAM_ROW(word, kind, start, -INFINITY, INFINITY, 0, given, type, member)
/* A row whose value is a word, by default the first of `choice_`. */
#define PARAM_WORDS(word_, choice_, given_, type, member)                     \
    {.word = word_, .kind = PARAM_CHOICE, .offset = offsetof(type, member),   \
     .given = given_, .alone = NAN, .choice = choice_}
/* A row that takes no number: the word says it all. */
#define PARAM_WORD(word_, kind_, alone_, given_, type, member)                \
    {.word = word_, .kind = kind_, .offset = offsetof(type, member),          \
     .given = given_, .alone = alone_}
#define PARAM_WITHOUT(word_, note_)                                           \
    {.word = word_, .kind = PARAM_IGNORED, .alone = NAN, .note = note_,       \
     .most = 2}
/* A row whose numbers and strings the statement itself understands. */
#define PARAM_OWN(word_, least_, most_, id_)                                  \
    {.word = word_, .kind = PARAM_VALUES, .alone = NAN, .least = least_,      \
     .most = most_, .id = id_}

/* Rows are sought in a table that ends with a row without word. */
const struct param *param_find(const struct param *table, const char *word);

/* How many numbers and strings may follow the row's word. */
int param_least(const struct param *row);
int param_most(const struct param *row);

/* Sets every parameter of the node to its default. */
void param_defaults(const struct param *table, void *node);

/* Checks numbers and stores them; the rest as in build_set. False: reported. */
bool param_set(struct parser *parser, const struct param *row, void *node,
               struct location at, const struct value *number, int count,
               struct location number_at);
bool param_choose(struct parser *parser, const struct param *row, void *node,
                  const char *choice, struct location at);

#endif
