#include "parser/console.h"
#include "lib/memory.h"
#include "parser/stats.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static bool open_files(struct console *c, struct brume_error *err)
{
    for (int i = 0; i < OPTIONS_STREAMS; i++) {
        const char *path = c->options->stream_file[i];
        if (!path)
            continue;
        c->file[i] = fopen(path, c->options->append ? "a" : "w");
        if (!c->file[i])
            return brume_fail(err, BRUME_ERR_FILE, "can't open '%s': %s", path,
                              strerror(errno));
    }
    return true;
}

static enum progress_mode progress_mode(const struct options *options,
                                        bool terminal)
{
    bool quiet = options->has_verbose && !options->verbose;
    if (options->progress == OPTIONS_PROGRESS_JSON)
        return PROGRESS_JSON;
    if (options->progress == OPTIONS_PROGRESS_OFF || quiet || !terminal)
        return PROGRESS_OFF;
    return PROGRESS_LINE;
}

bool console_open(struct console *console, const struct options *options,
                  FILE *to, bool terminal, struct brume_error *err)
{
    *console = (struct console){
        .options = options,
        .to = to,
        .terminal = terminal,
    };
    progress_init(&console->progress, progress_mode(options, terminal),
                  fileno(to));
    return open_files(console, err);
}

void console_close(struct console *console)
{
    progress_clear(&console->progress);
    for (int i = 0; i < OPTIONS_STREAMS; i++)
        if (console->file[i])
            fclose(console->file[i]);
    free(console->seen);
}

/* ---- streams ----------------------------------------------------------- */

/* Where a stream's text goes; returns how many files that are. */
static int targets(struct console *c, enum options_stream stream, FILE *to[3])
{
    int count = 0;
    progress_clear(&c->progress);
    if (stream == OPTIONS_FATAL || c->options->console[stream])
        to[count++] = c->to;
    if (c->file[stream])
        to[count++] = c->file[stream];
    if (c->file[OPTIONS_ALL])
        to[count++] = c->file[OPTIONS_ALL];
    return count;
}

/* #warning and #error come as diagnostics too, with their place. */
void console_message(struct console *console, enum parse_stream stream,
                     const char *text)
{
    FILE *to[3];
    int count = stream == PARSE_DEBUG ? targets(console, OPTIONS_DEBUG, to) : 0;
    for (int i = 0; i < count; i++)
        fputs(text, to[i]);
}

/* ---- diagnostics ------------------------------------------------------- */

/* FNV-1a, 64 bits. */
static uint64_t hash(uint64_t value, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++)
        value = (value ^ at[i]) * 0x100000001b3;
    return value;
}

static bool was_told(struct console *c, const struct diag_item *item)
{
    uint64_t key = 0xcbf29ce484222325;
    key = hash(key, item->text, strlen(item->text));
    if (item->file)
        key = hash(key, item->file, strlen(item->file));
    key = hash(key, &item->line, sizeof item->line);
    key = hash(key, &item->column, sizeof item->column);
    for (size_t i = 0; i < c->seens; i++)
        if (c->seen[i] == key)
            return true;
    uint64_t *grown = memory_grow(c->seen, &c->room, c->seens + 1,
                                  sizeof *grown, NULL);
    if (grown) {
        c->seen = grown;
        c->seen[c->seens++] = key;
    }
    return false;
}

static void write_item(struct console *c, const struct diag_item *item)
{
    bool error = item->severity == DIAG_ERROR;
    FILE *to[3];
    if (!error && (c->options->warning_level == 0 || was_told(c, item)))
        return;
    int count = targets(c, error ? OPTIONS_FATAL : OPTIONS_WARNING, to);
    for (int i = 0; i < count; i++)
        diag_write_item(item, to[i]);
}

void console_diag(struct console *console, const struct diag *diag)
{
    FILE *to[3];
    for (const struct diag_item *i = diag->first; i; i = i->next)
        write_item(console, i);
    int more = diag->warnings - diag->warning_limit;
    int count = more > 0 ? targets(console, OPTIONS_WARNING, to) : 0;
    for (int i = 0; i < count; i++)
        fprintf(to[i], "%d more warnings\n", more);
    if (diag->errors > 0 && !diag->first) /* memory ran out */
        fputs("error: out of memory\n", console->to);
}

/* ---- frames ------------------------------------------------------------ */

void console_frame(struct console *console, const struct frames *frames,
                   int number)
{
    if (frames->animation)
        snprintf(console->frame, sizeof console->frame, "%d/%d ", number,
                 frames->last);
}

void console_progress(struct console *console,
                      const struct brume_progress *progress)
{
    char stage[64];
    snprintf(stage, sizeof stage, "%s%s", console->frame, progress->stage);
    struct progress_report report = {
        .stage = stage,
        .fraction = progress->fraction,
        .items = progress->rate * progress->seconds,
        .unit = progress->item,
    };
    progress_update(&console->progress, &report);
}

/* Where a line about a frame goes: to the terminal, or when +V asks for it. */
static int line_targets(struct console *console, FILE *to[3])
{
    const struct options *o = console->options;
    bool wanted = o->has_verbose ? o->verbose : console->terminal;
    int count = targets(console, OPTIONS_STATISTICS, to), kept = 0;
    for (int i = 0; i < count; i++)
        if (to[i] != console->to || wanted)
            to[kept++] = to[i];
    return kept;
}

void console_finished(struct console *console, const struct reel_record *record)
{
    FILE *to[3];
    int count = line_targets(console, to);
    for (int i = 0; i < count; i++)
        stats_line(record, to[i]);
}

void console_skipped(struct console *console, const char *picture)
{
    FILE *to[3];
    int count = line_targets(console, to);
    for (int i = 0; i < count; i++)
        fprintf(to[i], "%s: left out, it is finished\n", picture);
}
