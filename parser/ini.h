/* ini.h - the text of an INI file, item by item; what the items mean is for
 * options.c to say.
 *
 * As POV-Ray reads them: `;` and `#` begin a comment outside quotes; a line is
 * a section's name in brackets, `name = value` with the rest of the line as
 * the value, or words divided by blanks, which are switches and names of
 * further INI files. Quotes of either kind keep blanks and comment marks. */
#ifndef PARSER_INI_H
#define PARSER_INI_H
#include <stdbool.h>
#include <stddef.h>
#include "lib/arena.h"

enum ini_kind {
    INI_END,
    INI_SECTION,        /* [name]                                          */
    INI_SETTING,        /* name = value                                    */
    INI_WORD,           /* name                                            */
    INI_BAD             /* name says what is wrong                         */
};

struct ini {
    const char *at, *end;       /* what is left of the text                */
    const char *line, *line_end;    /* the line that `at` is in            */
    int number;                 /* its number from 1; 0 before the first   */
};

struct ini_item {
    enum ini_kind kind;
    const char *name, *value;   /* in the arena, without their quotes      */
    const char *where;          /* the byte that a diagnostic points at    */
};

/* The text is borrowed and needs no NUL; a byte order mark is skipped. */
void ini_init(struct ini *ini, const char *text, size_t length);

/* False: no memory. After INI_BAD the next line follows. */
bool ini_next(struct ini *ini, struct arena *arena, struct ini_item *item);

#endif
