#include "parser/ini.h"
#include <string.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static bool is_comment(char c)
{
    return c == ';' || c == '#';
}

static bool is_quote(char c)
{
    return c == '"' || c == '\'';
}

static bool is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= '0' && c <= '9') || c == '_';
}

void ini_init(struct ini *ini, const char *text, size_t length)
{
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
        text += 3;
        length -= 3;
    }
    ini->at = ini->line = ini->line_end = text;
    ini->end = text + length;
    ini->number = 0;
}

static void skip_blanks(struct ini *ini)
{
    while (ini->at < ini->line_end && is_blank(*ini->at))
        ini->at++;
}

/* At the next line's first byte; false at the end of the text. */
static bool next_line(struct ini *ini)
{
    if (ini->line_end == ini->end && (ini->number || ini->at == ini->end))
        return false;
    const char *start = ini->number ? ini->line_end + 1 : ini->at;
    if (start == ini->end)
        return false;
    const char *stop = memchr(start, '\n', (size_t)(ini->end - start));
    ini->at = ini->line = start;
    ini->line_end = stop ? stop : ini->end;
    ini->number++;
    return true;
}

/* At the next byte that says something, on this line or a later one. */
static bool next_text(struct ini *ini, bool *fresh)
{
    *fresh = false;
    for (;;) {
        skip_blanks(ini);
        if (ini->number && ini->at < ini->line_end && !is_comment(*ini->at))
            return true;
        if (!next_line(ini))
            return false;
        *fresh = true;
    }
}

static bool bad(struct ini *ini, struct ini_item *item, const char *where,
                const char *text)
{
    item->kind = INI_BAD;
    item->where = where;
    item->name = text;
    ini->at = ini->line_end;
    return true;
}

static bool copied(struct arena *arena, const char *from, const char *to,
                   const char **out)
{
    while (to > from && is_blank(to[-1]))
        to--;
    return (*out = arena_copy(arena, from, (size_t)(to - from)));
}

/* Where the quote that opens at `at` closes, or NULL. */
static const char *closing_quote(const struct ini *ini, const char *at)
{
    return memchr(at + 1, *at, (size_t)(ini->line_end - at - 1));
}

static const char *comment_or_end(const struct ini *ini, const char *at)
{
    while (at < ini->line_end && !is_comment(*at))
        at++;
    return at;
}

static bool read_section(struct ini *ini, struct arena *arena,
                         struct ini_item *item)
{
    const char *from = ini->at + 1;
    const char *to = memchr(from, ']', (size_t)(ini->line_end - from));
    if (!to)
        return bad(ini, item, ini->at, "this '[' has no ']'");
    while (from < to && is_blank(*from))
        from++;
    item->kind = INI_SECTION;
    ini->at = to + 1;
    skip_blanks(ini);
    if (ini->at < ini->line_end && !is_comment(*ini->at))
        return bad(ini, item, ini->at, "nothing may follow a section's name");
    ini->at = ini->line_end;
    return copied(arena, from, to, &item->name);
}

static bool read_quoted_value(struct ini *ini, struct arena *arena,
                              struct ini_item *item)
{
    const char *open = ini->at;
    const char *close = closing_quote(ini, open);
    if (!close)
        return bad(ini, item, open, "this quote is not closed");
    ini->at = close + 1;
    skip_blanks(ini);
    if (ini->at < ini->line_end && !is_comment(*ini->at))
        return bad(ini, item, ini->at, "nothing may follow a quoted value");
    ini->at = ini->line_end;
    return (
        item->value = arena_copy(arena, open + 1, (size_t)(close - open - 1)));
}

static bool read_setting(struct ini *ini, struct arena *arena,
                         struct ini_item *item, const char *equals)
{
    item->kind = INI_SETTING;
    item->where = ini->at;
    if (!copied(arena, ini->at, equals, &item->name))
        return false;
    ini->at = equals + 1;
    skip_blanks(ini);
    if (ini->at < ini->line_end && is_quote(*ini->at))
        return read_quoted_value(ini, arena, item);
    const char *from = ini->at;
    ini->at = ini->line_end;
    return copied(arena, from, comment_or_end(ini, from), &item->value);
}

/* A word may be quoted in part, as in +O"my picture.png". */
static bool read_word(struct ini *ini, struct arena *arena,
                      struct ini_item *item)
{
    char *out = arena_alloc(arena, (size_t)(ini->line_end - ini->at) + 1);
    if (!out)
        return false;
    item->kind = INI_WORD;
    item->name = out;
    while (ini->at < ini->line_end && !is_blank(*ini->at) &&
           !is_comment(*ini->at)) {
        if (!is_quote(*ini->at)) {
            *out++ = *ini->at++;
            continue;
        }
        const char *close = closing_quote(ini, ini->at);
        if (!close)
            return bad(ini, item, ini->at, "this quote is not closed");
        size_t length = (size_t)(close - ini->at - 1);
        memcpy(out, ini->at + 1, length);
        out += length;
        ini->at = close + 1;
    }
    *out = '\0';
    return true;
}

/* The '=' of a line that begins with a name and goes on with one, or NULL. */
static const char *find_equals(const struct ini *ini)
{
    const char *at = ini->at;
    while (at < ini->line_end && is_name(*at))
        at++;
    const char *name_end = at;
    while (at < ini->line_end && is_blank(*at))
        at++;
    bool found = at < ini->line_end && *at == '=' && name_end > ini->at;
    return found ? at : NULL;
}

bool ini_next(struct ini *ini, struct arena *arena, struct ini_item *item)
{
    *item = (struct ini_item){INI_END, NULL, NULL, NULL};
    bool fresh;
    if (!next_text(ini, &fresh))
        return true;
    item->where = ini->at;
    size_t left = (size_t)(ini->line_end - ini->at);
    if (memchr(ini->at, '\0', left))
        return bad(ini, item, memchr(ini->at, '\0', left),
                   "a NUL byte: this is no text");
    if (fresh && *ini->at == '[')
        return read_section(ini, arena, item);
    const char *equals = fresh ? find_equals(ini) : NULL;
    if (equals)
        return read_setting(ini, arena, item, equals);
    return read_word(ini, arena, item);
}
