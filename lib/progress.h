/* progress.h - how far the work is: one line on a terminal, rewritten in
 * place, or a line of JSON per report for other programs.
 *
 * Reports may come as often as the caller likes; few are shown. One thread at
 * a time may use a struct progress. */
#ifndef LIB_PROGRESS_H
#define LIB_PROGRESS_H
#include <stdbool.h>

enum progress_mode {
    PROGRESS_OFF,
    PROGRESS_LINE,      /* for a person, on a terminal                     */
    PROGRESS_JSON       /* {"stage":"march","fraction":0.42,...} and a LF  */
};

struct progress {
    enum progress_mode mode;
    int fd;
    double begun;       /* of the present stage, on timer.h's clock        */
    double shown;       /* of the last line shown                          */
    char stage[64];
    bool line_open;     /* the terminal's line has text on it              */
};

/* PROGRESS_LINE becomes PROGRESS_OFF where `fd` is no terminal. */
void progress_init(struct progress *p, enum progress_mode mode, int fd);

struct progress_report {
    const char *stage;  /* "march"; a new name begins a new clock          */
    double fraction;    /* of the stage, 0 to 1                            */
    double items;       /* done so far; 0: no rate is shown                */
    const char *unit;   /* of the items: "photons"                         */
};

/* Shows the report if the last one shown is old enough, if the stage is new,
 * or if it is complete. */
void progress_update(struct progress *p, const struct progress_report *r);

/* Clears the terminal's line, so that other text can be printed. */
void progress_clear(struct progress *p);

/* The text of a report `elapsed` seconds into its stage; returns its length
 * (as snprintf). What progress_update shows; here for tests. */
int progress_line(const struct progress_report *r, double elapsed,
                  char *text, unsigned long size);
int progress_json(const struct progress_report *r, double elapsed,
                  char *text, unsigned long size);
#endif
