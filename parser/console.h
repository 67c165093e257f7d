/* console.h - what the user is told while a run goes on: diagnostics, what
 * the scene says, progress and statistics; on the terminal and in the files
 * that POV-Ray's text streams can be copied to. */
#ifndef PARSER_CONSOLE_H
#define PARSER_CONSOLE_H
#include <stdio.h>
#include "lib/progress.h"
#include "parser/diag.h"
#include "parser/options.h"
#include "parser/reel.h"

struct console {
    const struct options *options;
    FILE *to;                       /* standard error                      */
    bool terminal;                  /* `to` is one                         */
    FILE *file[OPTIONS_STREAMS];    /* copies of the streams; or NULL      */
    uint64_t *seen;                 /* warnings told already               */
    size_t seens, room;
    struct progress progress;
    char frame[32];                 /* "3/24 ", or "" for a still          */
};

/* False with err set (BRUME_ERR_FILE) when a stream's file can't be made. */
bool console_open(struct console *console, const struct options *options,
                  FILE *to, bool terminal, struct brume_error *err);
void console_close(struct console *console);

/* Errors always; a warning of a film's scene only once, not for each frame. */
void console_diag(struct console *console, const struct diag *diag);

/* What #debug and the like say. */
void console_message(struct console *console, enum parse_stream stream,
                     const char *text);
void console_frame(struct console *console, const struct frames *frames,
                   int number);
void console_progress(struct console *console,
                      const struct brume_progress *progress);
void console_finished(struct console *console,
                      const struct reel_record *record);
void console_skipped(struct console *console, const char *picture);

#endif
