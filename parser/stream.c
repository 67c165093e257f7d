#include "parser/stream.h"
#include "parser/grammar.h"
#include "parser/permit.h"
#include "parser/reader.h"
#include "parser/report.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct stream {
    struct stream *next;
    const char *name; /* as it is told                           */
    FILE *out;        /* NULL: it is read, or closed             */
    struct source *source;
    struct cursor cursor; /* of `source`                         */
    bool closed;
};

/* ---- opening and closing ----------------------------------------------- */

static bool open_input(struct parser *parser, struct location at,
                       struct stream *stream, struct string name)
{
    stream->source = source_open_data(parser, at, name);
    return stream->source &&
           reader_open(parser, stream->source, &stream->cursor);
}

static bool open_output(struct parser *parser, struct location at,
                        struct stream *stream, struct string name, bool append)
{
    const char *path;
    int file = permit_open_output(parser, at, name, append, &path);
    if (file < 0) {
        return false;
    }
    source_forget(parser, path);
    stream->out = fdopen(file, append ? "ab" : "wb");
    if (!stream->out) {
        close(file);
        return report_no_memory(parser);
    }
    return true;
}

struct stream *stream_open(struct parser *parser, struct location at,
                           struct string name, enum stream_mode mode)
{
    struct stream *stream = parser_alloc(parser, sizeof *stream);
    if (!stream) {
        return NULL;
    }
    stream->name = name.text;
    bool open = mode == STREAM_READ ? open_input(parser, at, stream, name)
                                    : open_output(parser, at, stream, name,
                                                  mode == STREAM_APPEND);
    if (!open) {
        return NULL;
    }
    stream->next = parser->streams;
    parser->streams = stream;
    return stream;
}

static bool fail_write(struct parser *parser, struct location at,
                       const struct stream *stream)
{
    return parser_fail(parser, BRUME_ERR_FILE, at, NULL,
                       "'%s' could not be written: %s", stream->name,
                       strerror(errno));
}

bool stream_close(struct parser *parser, struct location at,
                  struct stream *stream)
{
    if (stream->closed) {
        return true;
    }
    stream->closed = true;
    if (stream->source) {
        reader_close(parser, &stream->cursor);
        source_close_data(stream->source);
        return true;
    }
    return fclose(stream->out) == 0 || fail_write(parser, at, stream);
}

bool stream_close_all(struct parser *parser)
{
    struct location nowhere = {0, UINT32_MAX};
    bool written = true;
    for (struct stream *s = parser->streams; s; s = s->next) {
        written = stream_close(parser, nowhere, s) && written;
    }
    return written;
}

void stream_release(struct parser *parser)
{
    for (struct stream *s = parser->streams; s; s = s->next) {
        if (s->out && !s->closed) {
            fclose(s->out);
        }
    }
    parser->streams = NULL;
}

/* ---- writing ----------------------------------------------------------- */

static const struct {
    const char *name;
    int bytes;
    bool little, is_signed;
} words[STREAM_WORDS] = {[STREAM_SINT8] = {"sint8", 1, true, true},
                         [STREAM_UINT8] = {"uint8", 1, true, false},
                         [STREAM_SINT16BE] = {"sint16be", 2, false, true},
                         [STREAM_SINT16LE] = {"sint16le", 2, true, true},
                         [STREAM_UINT16BE] = {"uint16be", 2, false, false},
                         [STREAM_UINT16LE] = {"uint16le", 2, true, false},
                         [STREAM_SINT32BE] = {"sint32be", 4, false, true},
                         [STREAM_SINT32LE] = {"sint32le", 4, true, true}};

const char *stream_word_name(enum stream_word word)
{
    return words[word].name;
}

/* The nearest integer that the word can hold; halves go up. */
static void write_word(FILE *out, enum stream_word word, double x)
{
    int bytes = words[word].bytes;
    double range = ldexp(1, 8 * bytes);
    double low = words[word].is_signed ? -range / 2 : 0;
    double whole = isnan(x) ? 0 : floor(x + 0.5);
    whole = fmin(fmax(whole, low), low + range - 1);
    uint32_t bits = (uint32_t)(int64_t)whole;
    for (int i = 0; i < bytes; i++) {
        int place = words[word].little ? i : bytes - 1 - i;
        putc((int)(bits >> 8 * place & 0xFF), out);
    }
}

static void write_number(FILE *out, const struct value *value)
{
    if (value->terms == 1) {
        fprintf(out, "%g", value->v[0]);
        return;
    }
    for (int i = 0; i < value->terms; i++) {
        fprintf(out, "%c%g", i ? ',' : '<', value->v[i]);
    }
    fputs("> ", out);
}

/* A scene must not fill a disk either. */
static bool is_within_limit(struct parser *parser, struct location at,
                            const struct value *value)
{
    enum { NUMBER = 16 };
    size_t most = parser->limits.memory;
    parser->written += value->kind == VALUE_STRING ? value->string.length
                                                   : NUMBER;
    return !most || parser->written <= most ||
           parser_fail(parser, BRUME_ERR_LIMIT, at, NULL,
                       "the scene writes more than %zu bytes", most);
}

bool stream_write(struct parser *parser, struct location at,
                  struct stream *stream, const struct value *value,
                  enum stream_word word)
{
    FILE *out = stream->out;
    if (!out || stream->closed) {
        return parser_error(parser, at, "'%s' is not open for writing",
                            stream->name);
    }
    if (!is_within_limit(parser, at, value)) {
        return false;
    }
    if (value->kind == VALUE_STRING) {
        fwrite(value->string.text, 1, value->string.length, out);
    } else if (word == STREAM_TEXT) {
        write_number(out, value);
    } else {
        for (int i = 0; i < value->terms; i++) {
            write_word(out, word, value->v[i]);
        }
    }
    return !ferror(out) || fail_write(parser, at, stream);
}

/* ---- reading ----------------------------------------------------------- */

static bool take(struct cursor *cursor, int kind)
{
    if (cursor_peek(cursor)->kind != kind) {
        return false;
    }
    cursor_skip(cursor);
    return true;
}

static bool fail_read(struct parser *parser, struct cursor *cursor,
                      const char *wanted)
{
    const struct token *token = cursor_peek(cursor);
    if (token->kind == TOK_BAD) {
        report_bad(parser, token);
    } else {
        report_wanted(parser, token_location(token), wanted, token->kind);
    }
    return false;
}

static bool read_float(struct parser *parser, struct cursor *cursor,
                       double *value)
{
    bool negative = take(cursor, '-');
    if (!negative) {
        take(cursor, '+');
    }
    const struct token *token = cursor_peek(cursor);
    if (token->kind != TOK_NUMBER) {
        return fail_read(parser, cursor, "a float, vector or string");
    }
    *value = negative ? -token->number : token->number;
    cursor_skip(cursor);
    return true;
}

/* Behind its '<'. */
static bool read_vector(struct parser *parser, struct cursor *cursor,
                        struct value *value)
{
    *value = (struct value){.kind = VALUE_NUMBER};
    while (value->terms < VALUE_TERMS) {
        if (!read_float(parser, cursor, &value->v[value->terms])) {
            return false;
        }
        value->terms++;
        take(cursor, ',');
        if (value->terms > 1 && take(cursor, '>')) {
            return true;
        }
    }
    return fail_read(parser, cursor, "'>'");
}

bool stream_read(struct parser *parser, struct location at,
                 struct stream *stream, struct value *value)
{
    struct cursor *cursor = &stream->cursor;
    *value = (struct value){.kind = VALUE_NONE};
    if (!stream->source || stream->closed) {
        return parser_error(parser, at, "'%s' is not open for reading",
                            stream->name);
    }
    const struct token *token = cursor_peek(cursor);
    if (token->kind == TOK_END) {
        return !parser->failed;
    }
    if (token->kind == TOK_STRING) {
        *value = value_string(token->string->text, token->string->length);
        cursor_skip(cursor);
    } else if (take(cursor, '<')) {
        if (!read_vector(parser, cursor, value)) {
            return false;
        }
    } else {
        *value = value_float(0);
        if (!read_float(parser, cursor, &value->v[0])) {
            return false;
        }
    }
    take(cursor, ',');
    return !parser->failed;
}

bool stream_at_end(struct stream *stream)
{
    return stream->source && cursor_peek(&stream->cursor)->kind == TOK_END;
}
