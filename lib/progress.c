#include "lib/progress.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include "lib/timer.h"

/* Seconds between two reports: what an eye follows, what a log bears. */
static const double line_interval = 0.1, json_interval = 0.5;

enum { TEXT = 256, CLOCK = 32 };

void progress_init(struct progress *p, enum progress_mode mode, int fd)
{
    memset(p, 0, sizeof *p);
    p->mode = mode == PROGRESS_LINE && !isatty(fd) ? PROGRESS_OFF : mode;
    p->fd = fd;
}

/* Nobody sees a report that can't be written, and nothing else suffers. */
static void write_text(const struct progress *p, const char *text, int size)
{
    if (size > 0)
        (void)!write(p->fd, text, (size_t)size);
}

static double clip(double fraction)
{
    return fraction > 0 ? fmin(fraction, 1) : 0;
}

/* Seconds to the end of the stage at its pace so far; negative: unknown. */
static double seconds_left(double fraction, double elapsed)
{
    return fraction > 0 ? elapsed / fraction - elapsed : -1;
}

static void format_clock(double seconds, char *text, size_t size)
{
    if (!(seconds >= 0 && seconds < 1e7)) {
        snprintf(text, size, "?");
        return;
    }
    int s = (int)(seconds + 0.5);
    if (s >= 3600)
        snprintf(text, size, "%d:%02d:%02d", s / 3600, s / 60 % 60, s % 60);
    else
        snprintf(text, size, "%d:%02d", s / 60, s % 60);
}

static double rate_of(const struct progress_report *r, double elapsed)
{
    return r->unit && r->items > 0 && elapsed > 0 ? r->items / elapsed : 0;
}

/* ", 1.2 M photons/s" */
static void format_rate(const struct progress_report *r, double elapsed,
                        char *text, size_t size)
{
    static const char *const scales[] = {"", " k", " M", " G", " T"};
    double rate = rate_of(r, elapsed);
    int scale = 0;
    text[0] = '\0';
    if (rate <= 0)
        return;
    for (; rate >= 999.5 && scale < 4; scale++)
        rate /= 1000;
    snprintf(text, size, ", %.3g%s %s/s", rate, scales[scale], r->unit);
}

int progress_line(const struct progress_report *r, double elapsed, char *text,
                  unsigned long size)
{
    char passed[CLOCK], left[CLOCK], rate[TEXT];
    double fraction = clip(r->fraction);
    format_clock(elapsed, passed, sizeof passed);
    format_clock(seconds_left(fraction, elapsed), left, sizeof left);
    format_rate(r, elapsed, rate, sizeof rate);
    return snprintf(text, size, "%-10s %3d %%  %s, %s left%s", r->stage,
                    (int)(100 * fraction), passed, left, rate);
}

int progress_json(const struct progress_report *r, double elapsed, char *text,
                  unsigned long size)
{
    char left[CLOCK] = "null", unit[TEXT] = "";
    double fraction = clip(r->fraction);
    double seconds = seconds_left(fraction, elapsed);
    double rate = rate_of(r, elapsed);
    if (seconds >= 0)
        snprintf(left, sizeof left, "%.3f", seconds);
    if (rate > 0)
        snprintf(unit, sizeof unit, ",\"rate\":%.6g,\"unit\":\"%s\"", rate,
                 r->unit);
    return snprintf(text, size,
                    "{\"stage\":\"%s\",\"fraction\":%.6f,"
                    "\"elapsed_s\":%.3f,\"left_s\":%s%s}\n",
                    r->stage, fraction, elapsed, left, unit);
}

static void show(struct progress *p, const struct progress_report *r,
                 double elapsed)
{
    char text[3 * TEXT], line[4 * TEXT];
    if (p->mode == PROGRESS_JSON) {
        int size = progress_json(r, elapsed, text, sizeof text);
        if (size < (int)sizeof text)
            write_text(p, text, size);
        return;
    }
    progress_line(r, elapsed, text, sizeof text);
    /* Carriage return, text, erase to the end of the line (ECMA-48 EL). */
    int size = snprintf(line, sizeof line, "\r%s\033[K", text);
    write_text(p, line, size);
    p->line_open = true;
}

void progress_update(struct progress *p, const struct progress_report *r)
{
    if (p->mode == PROGRESS_OFF)
        return;
    double now = timer_seconds();
    double interval = p->mode == PROGRESS_JSON ? json_interval : line_interval;
    bool fresh = strncmp(p->stage, r->stage, sizeof p->stage - 1) != 0;
    if (fresh) {
        snprintf(p->stage, sizeof p->stage, "%s", r->stage);
        p->begun = now;
    }
    if (!fresh && r->fraction < 1 && now - p->shown < interval)
        return;
    p->shown = now;
    show(p, r, now - p->begun);
}

void progress_clear(struct progress *p)
{
    static const char erase[] = "\r\033[K";
    if (p->line_open)
        write_text(p, erase, (int)sizeof erase - 1);
    p->line_open = false;
}
