#include "parser/source.h"
#include "lib/memory.h"
#include "lib/stamp.h"
#include "parser/cache.h"
#include "parser/origins.h"
#include "parser/permit.h"
#include "parser/report.h"
#include "parser/utf8.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PAD = 2 }; /* NULs that the scanner wants behind a text       */

/* ---- the table of texts ------------------------------------------------ */

/* Adds an empty text. NULL: no memory or too many, reported. */
static struct source *add(struct parser *parser, struct location at,
                          const char *name)
{
    if (parser->sources > UINT16_MAX) {
        parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                    "more than %d files are included", UINT16_MAX);
        return NULL;
    }
    void *table = parser->source;
    struct source *source = parser_alloc(parser, sizeof *source);
    if (!source || !arena_grow(&parser->arena, &table, &parser->source_room,
                               parser->sources + 1, sizeof source)) {
        report_no_memory(parser);
        return NULL;
    }
    const char *slash = strrchr(name, '/');
    parser->source = table;
    source->id = (uint32_t)parser->sources;
    source->name = arena_copy(&parser->arena, name, strlen(name));
    source->folder = arena_copy(&parser->arena, name,
                                slash ? (size_t)(slash - name) + 1 : 0);
    if (!source->name || !source->folder) {
        report_no_memory(parser);
        return NULL;
    }
    parser->source[parser->sources++] = source;
    return source;
}

void source_release(struct parser *parser)
{
    for (size_t i = 0; i < parser->sources; i++) {
        if (!parser->source[i]->kept) {
            free(parser->source[i]->text);
        }
    }
    parser->sources = 0;
}

static struct source *known(const struct parser *parser, const char *real)
{
    for (size_t i = 0; i < parser->sources; i++) {
        const char *other = parser->source[i]->real;
        if (other && strcmp(other, real) == 0) {
            return parser->source[i];
        }
    }
    return NULL;
}

/* ---- reading ----------------------------------------------------------- */

bool source_fits(struct parser *parser, struct location at)
{
    size_t most = parser->limits.memory;
    return !most || parser->source_bytes <= most ||
           parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                       "the texts need more than %zu bytes of memory", most);
}

/* Room for `need` bytes and the padding. */
static bool make_room(struct parser *parser, struct location at,
                      struct source *source, size_t need)
{
    struct brume_error err = {0};
    size_t before = source->room;
    char *text = memory_grow(source->text, &source->room, need + PAD, 1, &err);
    if (!text) {
        return parser_relay(parser, at, &err);
    }
    source->text = text;
    parser->source_bytes += source->room - before;
    return source_fits(parser, at);
}

/* Reads up to the end, of pipes too. */
static bool read_all(struct parser *parser, struct location at,
                     struct source *source, int file)
{
    enum { STEP = 65536 };
    struct stat status;
    size_t expected = fstat(file, &status) == 0 && status.st_size > 0
                          ? (size_t)status.st_size
                          : STEP;
    ssize_t got;
    do {
        size_t need = source->length ? source->length + STEP : expected + 1;
        if (!make_room(parser, at, source, need)) {
            return false;
        }
        got = read(file, source->text + source->length,
                   source->room - PAD - source->length);
        if (got < 0 && errno != EINTR) {
            return parser_fail(parser, BRUME_ERR_FILE, at, NULL,
                               "'%s' could not be read: %s", source->name,
                               strerror(errno));
        }
        source->length += got > 0 ? (size_t)got : 0;
    } while (got != 0);
    memset(source->text + source->length, 0, PAD);
    return true;
}

static bool read_file(struct parser *parser, struct location at,
                      struct source *source, int file)
{
    bool done = file >= 0 && read_all(parser, at, source, file);
    if (file >= 0) {
        close(file);
    }
    return done;
}

/* ---- texts that are kept ----------------------------------------------- */

static bool borrow(struct parser *parser, struct location at,
                   struct source *source, struct kept_text *kept)
{
    source->kept = kept;
    source->text = kept->text;
    source->length = kept->length;
    source->room = kept->room;
    parser->source_bytes += kept->bytes;
    kept_label(kept, source->id);
    parser->out->counts.texts_kept += kept->scanned;
    return source_fits(parser, at);
}

/* Hands a text that was read over to the cache, if that has memory for it. */
static void lend(struct kept *cache, struct source *source,
                 const struct stat *was, const char *given)
{
    source->kept = kept_add(cache, source->real, was, given, source->text,
                            source->length, source->room);
    if (source->kept)
        source->kept->source = source->id;
}

/* As read_file; where a film has the file as it is now, without reading. */
static bool read_or_borrow(struct parser *parser, struct location at,
                           struct source *source, int file)
{
    struct kept *cache = cache_kept(parser->in->cache);
    struct stat was, now;
    bool regular = cache && source->real && file >= 0 &&
                   fstat(file, &was) == 0 && S_ISREG(was.st_mode);
    bool settled = regular && stamp_is_settled(&was);
    struct kept_text *kept = regular ? kept_find(cache, source->real, &was)
                                     : NULL;
    if (kept) {
        close(file);
        return borrow(parser, at, source, kept);
    }
    if (!settled) {
        return read_file(parser, at, source, file);
    }
    bool done = read_all(parser, at, source, file);
    if (done && fstat(file, &now) == 0 && stamp_is_same(&was, &now)) {
        lend(cache, source, &was, NULL);
    }
    close(file);
    return done;
}

static bool copy_text(struct parser *parser, struct source *source)
{
    struct location at = {0, source->id};
    struct kept *cache = cache_kept(parser->in->cache);
    struct kept_text *kept = cache ? kept_find_given(cache, parser->in->text)
                                   : NULL;
    if (kept) {
        return borrow(parser, at, source, kept);
    }
    if (!make_room(parser, at, source, parser->in->length)) {
        return false;
    }
    source->length = parser->in->length;
    if (source->length) {
        memcpy(source->text, parser->in->text, source->length);
    }
    memset(source->text + source->length, 0, PAD);
    if (cache) {
        lend(cache, source, NULL, parser->in->text);
    }
    return true;
}

static const char *resolve(struct parser *parser, const char *path)
{
    char real[PATH_MAX];
    return realpath(path, real) ? arena_copy(&parser->arena, real, strlen(real))
                                : NULL;
}

struct source *source_open_scene(struct parser *parser)
{
    struct location nowhere = {0, UINT32_MAX};
    if (!parser->in->text) {
        return source_open_path(parser, nowhere, parser->in->path);
    }
    struct source *source = add(parser, nowhere, parser->in->path);
    return source && copy_text(parser, source) ? source : NULL;
}

static struct source *open_named(
    struct parser *parser, struct location at, const char *path,
    int open_file(struct parser *parser, struct location at, const char *path))
{
    const char *real = resolve(parser, path);
    struct source *source = real ? known(parser, real) : NULL;
    if (source) {
        return source;
    }
    source = add(parser, at, path);
    int file = source ? open_file(parser, at, path) : -1;
    if (file < 0) {
        return NULL;
    }
    source->real = real;
    return read_or_borrow(parser, at, source, file) ? source : NULL;
}

struct source *source_open(struct parser *parser, struct location at,
                           struct string name)
{
    const char *path = parser_find_file(parser, at, name, PARSER_TEXT);
    return path ? open_named(parser, at, path, permit_open_text) : NULL;
}

struct source *source_open_path(struct parser *parser, struct location at,
                                const char *path)
{
    origins_add(parser->in->origins, path);
    return open_named(parser, at, path, permit_open_any);
}

/* A source of data that is not read from any more, to be filled anew. */
static struct source *spare(struct parser *parser, const char *path)
{
    for (size_t i = 0; i < parser->sources; i++) {
        struct source *source = parser->source[i];
        if (source->idle && strcmp(source->name, path) == 0) {
            source->idle = false;
            source->length = 0;
            return source;
        }
    }
    return NULL;
}

struct source *source_open_data(struct parser *parser, struct location at,
                                struct string name)
{
    const char *path = parser_find_file(parser, at, name, PARSER_TEXT);
    int file = path ? permit_open_text(parser, at, path) : -1;
    struct source *source = file >= 0 ? spare(parser, path) : NULL;
    if (file >= 0 && !source) {
        source = add(parser, at, path);
    }
    if (!source) {
        if (file >= 0) {
            close(file);
        }
        return NULL;
    }
    source->data = true;
    return read_file(parser, at, source, file) ? source : NULL;
}

void source_close_data(struct source *source)
{
    source->idle = true;
}

void source_forget(struct parser *parser, const char *real)
{
    struct source *source = known(parser, real);
    if (source) {
        source->real = NULL;
    }
}

/* ---- places ------------------------------------------------------------ */

struct source_point source_locate(const struct source *source, uint32_t offset)
{
    const char *text = source->text;
    const char *end = text + source->length;
    const char *at = offset < source->length ? text + offset : end;
    struct source_point point = {.line = 1, .start = text, .at = at};
    const char *next;
    while ((next = memchr(point.start, '\n', (size_t)(at - point.start)))) {
        point.start = next + 1;
        point.line++;
    }
    next = memchr(at, '\n', (size_t)(end - at));
    point.end = next ? next : end;
    if (point.end > at && point.end[-1] == '\r') {
        point.end--;
    }
    point.column = 1 + (int)utf8_count(point.start, (size_t)(at - point.start));
    return point;
}
