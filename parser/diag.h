/* diag.h - diagnostics of scenes: collected here, printed by whoever asks.
 *
 * One reads, when written out,
 *
 *     scene.pov:12:7: error: undeclared identifier 'Radus'
 *        12 |   sphere { 0, Radus }
 *           |               ^
 *     shapes.inc:3: in macro Ball called here
 *     scene.pov:40: included from here
 *     hint: did you mean 'Radius'?
 *
 * Every text is owned by the list until diag_release. */
#ifndef PARSER_DIAG_H
#define PARSER_DIAG_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include "lib/arena.h"
#include "lib/error.h"

enum diag_severity { DIAG_NOTE, DIAG_WARNING, DIAG_ERROR };

struct diag_item {
    enum diag_severity severity;
    enum brume_code code;       /* of an error; BRUME_OK otherwise         */
    const char *file;           /* NULL: no text is at fault               */
    int line, column;           /* from 1; column counts characters        */
    const char *text;           /* lower case, one line                    */
    const char *excerpt;        /* the source line and the caret line, each
                                   ended by '\n'; NULL: none               */
    const char *trace;          /* lines of where the text was included or
                                   called from, innermost first; or NULL   */
    const char *hint;           /* what would help; or NULL                */
    struct diag_item *next;
};

struct diag {
    struct arena arena;
    struct diag_item *first, *last;
    int errors, warnings;
    int warning_limit;          /* more warnings are only counted          */
    enum brume_code code;       /* of the first error: the exit code       */
};

void diag_init(struct diag *diag);
void diag_release(struct diag *diag);

/* Adds a copy of `item`. An error is never lost: without memory the code and
 * the count still tell of it. */
void diag_add(struct diag *diag, const struct diag_item *item);
/* An error that no text is to blame for. Always returns false. */
bool diag_error(struct diag *diag, enum brume_code code, const char *format,
                ...) BRUME_PRINTF(3, 4);

/* Writes one item, or all of them with the count of suppressed warnings. */
void diag_write_item(const struct diag_item *item, FILE *to);
void diag_write(const struct diag *diag, FILE *to);
/* The first error in the form the rest of the program uses. */
void diag_to_error(const struct diag *diag, struct brume_error *err);

/* The source line from `line` to `end` with a caret under the byte `at`, as
 * `excerpt` wants it: tabs widened, control and broken bytes made visible,
 * long lines cut around the caret. NULL: no memory. */
char *diag_excerpt(struct arena *arena, const char *line, const char *end,
                   const char *at, int number);

/* How many edits part two words; more than `bound` counts as bound + 1. */
size_t diag_distance(const char *a, size_t a_length, const char *b,
                     size_t b_length, size_t bound);

#endif
