#include "parser/diag.h"
#include "parser/utf8.h"
#include <stdarg.h>
#include <string.h>

enum {
    DIAG_MEMORY = 16 << 20, /* of the list                             */
    WARNINGS = 100,
    TAB = 8,
    WIDTH = 72 /* columns of a source line that are shown */
};

void diag_init(struct diag *diag)
{
    *diag = (struct diag){.warning_limit = WARNINGS};
    arena_init(&diag->arena, DIAG_MEMORY);
}

void diag_release(struct diag *diag)
{
    arena_release(&diag->arena);
}

/* ---- adding ------------------------------------------------------------ */

static const char *keep(struct diag *diag, const char *text)
{
    return text ? arena_copy(&diag->arena, text, strlen(text)) : NULL;
}

/* True if the item is to be kept, not only counted. */
static bool count(struct diag *diag, const struct diag_item *item)
{
    if (item->severity == DIAG_WARNING) {
        return diag->warnings++ < diag->warning_limit;
    }
    if (item->severity == DIAG_ERROR && diag->errors++ == 0) {
        diag->code = item->code;
    }
    return true;
}

void diag_add(struct diag *diag, const struct diag_item *item)
{
    if (!count(diag, item)) {
        return;
    }
    struct diag_item *copy = arena_alloc(&diag->arena, sizeof *copy);
    if (!copy) {
        return;
    }
    *copy = *item;
    copy->file = keep(diag, item->file);
    copy->text = keep(diag, item->text);
    copy->excerpt = keep(diag, item->excerpt);
    copy->trace = keep(diag, item->trace);
    copy->hint = keep(diag, item->hint);
    copy->next = NULL;
    if (!copy->text) {
        copy->text = "out of memory";
    }
    *(diag->last ? &diag->last->next : &diag->first) = copy;
    diag->last = copy;
}

bool diag_error(struct diag *diag, enum brume_code code, const char *format,
                ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    diag_add(diag, &(struct diag_item){
                       .severity = DIAG_ERROR, .code = code, .text = text});
    return false;
}

/* ---- writing ----------------------------------------------------------- */

static const char *const severity_name[] = {"note", "warning", "error"};

void diag_write_item(const struct diag_item *item, FILE *to)
{
    if (item->file && item->line) {
        fprintf(to, "%s:%d:%d: ", item->file, item->line, item->column);
    } else if (item->file) {
        fprintf(to, "%s: ", item->file);
    }
    fprintf(to, "%s: %s\n", severity_name[item->severity], item->text);
    fputs(item->excerpt ? item->excerpt : "", to);
    fputs(item->trace ? item->trace : "", to);
    if (item->hint) {
        fprintf(to, "hint: %s\n", item->hint);
    }
}

void diag_write(const struct diag *diag, FILE *to)
{
    for (const struct diag_item *i = diag->first; i; i = i->next) {
        diag_write_item(i, to);
    }
    if (diag->warnings > diag->warning_limit) {
        fprintf(to, "%d more warnings\n", diag->warnings - diag->warning_limit);
    }
}

void diag_to_error(const struct diag *diag, struct brume_error *err)
{
    const struct diag_item *item = diag->first;
    while (item && item->severity != DIAG_ERROR) {
        item = item->next;
    }
    if (diag->errors == 0 || err->code != BRUME_OK) {
        return;
    }
    err->code = diag->code;
    snprintf(err->text, sizeof err->text, "%s",
             item ? item->text : "out of memory");
    if (item && item->file) {
        snprintf(err->file, sizeof err->file, "%s", item->file);
        err->line = item->line;
        err->column = item->column;
    }
}

/* ---- excerpts ---------------------------------------------------------- */

/* A line as it is shown: each character takes the columns it is given here. */
struct shown {
    char text[4 * WIDTH + 8];
    size_t length;
    int columns;
};

static void show(struct shown *shown, const char *text, size_t length,
                 int columns)
{
    if (shown->columns + columns <= WIDTH) {
        memcpy(shown->text + shown->length, text, length);
        shown->length += length;
        shown->columns += columns;
    }
}

/* Shows the character at `at` and returns the next one. */
static const char *show_next(struct shown *shown, const char *at,
                             const char *end)
{
    size_t size;
    uint32_t code = utf8_decode(at, (size_t)(end - at), &size);
    if (code == '\t') {
        int columns = TAB - shown->columns % TAB;
        show(shown, "        ", (size_t)columns, columns);
    } else if (code < ' ' || code == 0x7F || (code >= 0x80 && size == 1)) {
        show(shown, "?", 1, 1);
    } else {
        show(shown, at, size, 1);
    }
    return at + size;
}

/* Where to start so that the caret comes to stand within the width. */
static const char *first_shown(const char *line, const char *at)
{
    enum { BEFORE = WIDTH * 2 / 3 };
    const char *start = at;
    int columns = 0;
    while (start > line && columns < BEFORE) {
        start--;
        columns += *start == '\t' ? TAB : (*start & 0xC0) != 0x80;
    }
    return columns < BEFORE ? line : start;
}

char *diag_excerpt(struct arena *arena, const char *line, const char *end,
                   const char *at, int number)
{
    struct shown shown = {.length = 0};
    int caret = 0;
    const char *next = first_shown(line, at);
    while (next < end && shown.columns < WIDTH) {
        caret = next <= at ? shown.columns : caret;
        next = show_next(&shown, next, end);
    }
    if (at >= end) {
        caret = shown.columns;
    }
    enum { MARGIN = 32 };
    size_t room = shown.length + (size_t)caret + 2 * MARGIN;
    char *text = arena_alloc(arena, room);
    if (text) {
        snprintf(text, room, "%5d | %.*s\n      | %*s^\n", number,
                 (int)shown.length, shown.text, caret, "");
    }
    return text;
}

/* ---- likeness ---------------------------------------------------------- */

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

size_t diag_distance(const char *a, size_t a_length, const char *b,
                     size_t b_length, size_t bound)
{
    enum { LONGEST = 64 };
    size_t row[LONGEST + 1];
    size_t longer = a_length > b_length ? a_length : b_length;
    if (longer > LONGEST || longer - least(a_length, b_length) > bound) {
        return bound + 1;
    }
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    /* Levenshtein 1966, one row of the table at a time. */
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0], nearest = i;
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
            nearest = least(nearest, row[j]);
        }
        /* What is below is never nearer. */
        if (nearest > bound) {
            return bound + 1;
        }
    }
    return least(row[b_length], bound + 1);
}
