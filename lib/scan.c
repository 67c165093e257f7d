#include "lib/scan.h"
#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool scan_open(struct scan *s, const char *path, struct brume_error *err)
{
    memset(s, 0, sizeof *s);
    s->path = path;
    s->err = err;
    s->line_ended = true;
    s->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    s->stream = s->locale ? fopen(path, "rb") : NULL;
    if (!s->stream)
        return brume_fail_file(err, path, "can't be read: %s", strerror(errno));
    /* A folder can be opened, but not read. */
    int c = getc(s->stream);
    if (c == EOF && ferror(s->stream))
        return brume_fail_file(err, path, "can't be read: %s", strerror(errno));
    ungetc(c, s->stream);
    return true;
}

void scan_close(struct scan *s)
{
    if (s->stream)
        fclose(s->stream);
    if (s->locale)
        freelocale(s->locale);
}

bool scan_line(struct scan *s)
{
    int c = '\n';
    while (!s->line_ended) {
        c = getc_unlocked(s->stream);
        s->line_ended = c == '\n' || c == EOF;
    }
    c = getc_unlocked(s->stream);
    if (c == EOF)
        return false;
    ungetc(c, s->stream);
    s->line++;
    s->line_ended = false;
    return true;
}

static bool is_blank(int c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

bool scan_word(struct scan *s)
{
    size_t length = 0;
    int c = ' ';
    while (!s->line_ended && is_blank(c))
        c = getc_unlocked(s->stream);
    if (s->line_ended)
        return false;
    for (; c != '\n' && c != EOF && !is_blank(c); c = getc_unlocked(s->stream))
        if (length < sizeof s->word - 1)
            s->word[length++] = (char)c;
    s->word[length] = '\0';
    /* CR LF is one end of a line, so that what follows "end_header" there
     * begins where it should. */
    if (c == '\r') {
        int next = getc_unlocked(s->stream);
        if (next == '\n')
            c = next;
        else if (next != EOF)
            ungetc(next, s->stream);
    }
    s->line_ended = c == '\n' || c == EOF;
    return length > 0;
}

bool scan_any_word(struct scan *s)
{
    while (!scan_word(s))
        if (!scan_line(s))
            return false;
    return true;
}

bool scan_is_number(const struct scan *s, const char *text, double *value)
{
    char *end;
    *value = strtod_l(text, &end, s->locale);
    return end != text && *end == '\0';
}

bool scan_number(struct scan *s, double *value)
{
    return scan_is_number(s, s->word, value) ||
           scan_fail(s, "'%.40s' is not a number", s->word);
}

bool scan_fail(struct scan *s, const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return brume_fail_file(s->err, s->path, "line %d: %s", s->line, text);
}
