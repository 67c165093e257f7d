/* scan.h - data files of text: lines of words and numbers, parted by blanks.
 *
 * Lines end in LF or CR LF. Numbers are read as in the C locale, whatever the
 * program's locale is. Errors are BRUME_ERR_FILE and name file and line. */
#ifndef LIB_SCAN_H
#define LIB_SCAN_H
#include <locale.h>
#include <stdio.h>
#include "lib/error.h"

enum { SCAN_WORD = 256 };

struct scan {
    FILE *stream;
    const char *path;
    int line;               /* of the word, from 1                         */
    bool line_ended;        /* no more words stand on the line             */
    char word[SCAN_WORD];   /* the last one                                */
    locale_t locale;
    struct brume_error *err;
};

/* Opens a file, before its first line. False with err set; to be closed in
 * both cases. `path` and `err` stay in use until then. */
bool scan_open(struct scan *s, const char *path, struct brume_error *err);
void scan_close(struct scan *s);

/* Goes to the next line, whatever is left on this one; false at the end. */
bool scan_line(struct scan *s);

/* The line's next word into s->word; false where there is none. Longer words
 * are cut, which no number and no keyword of the formats is. */
bool scan_word(struct scan *s);

/* The next word of the file, on whatever line. */
bool scan_any_word(struct scan *s);

/* s->word as a number; false with err set when it is none. */
bool scan_number(struct scan *s, double *value);

/* Text as a number, all of it; false when it is none. Sets no error. */
bool scan_is_number(const struct scan *s, const char *text, double *value);

/* Records an error at the present line; returns false. */
bool scan_fail(struct scan *s, const char *format, ...) BRUME_PRINTF(2, 3);
#endif
