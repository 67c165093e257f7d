/* fileio.c - #fopen, #fclose, #read, #write. */
#include "parser/expand.h"
#include "parser/report.h"
#include "parser/stream.h"

/* The name must be that of an open file; NULL: reported. */
static struct value *open_file(struct expander *expander,
                               const struct name *name, struct location at)
{
    struct value *value = symbols_find(name);
    if (!value || value->kind != VALUE_FILE) {
        parser_error(expander->parser, at, "'%.40s' is not an open file",
                     name->text);
        return NULL;
    }
    return value;
}

/* The name stands for nothing any more. */
static bool close_file(struct expander *expander, struct value *file,
                       struct location at)
{
    struct stream *stream = file->stream;
    file->kind = VALUE_NONE;
    return stream_close(expander->parser, at, stream);
}

/* To close what is closed, as files are that were read to their end, is no
 * mistake. */
static bool run_close(struct expander *expander)
{
    struct location at = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (!name || !symbols_find(name)) {
        return name;
    }
    struct value *file = open_file(expander, name, at);
    return file && close_file(expander, file, at);
}

/* ---- #fopen ------------------------------------------------------------ */

static bool begin_open(struct expander *expander)
{
    struct location at = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    if (!name || !directive_may_declare(expander, name, at)) {
        return false;
    }
    if (symbols_find(name)) {
        return parser_error(expander->parser, at, "'%.40s' is declared already",
                            name->text);
    }
    struct pending *pending = expand_begin(expander, TOK_MODE_STRING, USE_FOPEN,
                                           at);
    if (pending) {
        pending->file = name;
    }
    return pending;
}

static bool take_mode(struct expander *expander, enum stream_mode *mode)
{
    static const char *const word[] = {[STREAM_READ] = "read",
                                       [STREAM_WRITE] = "write",
                                       [STREAM_APPEND] = "append"};
    for (int i = STREAM_READ; i <= STREAM_APPEND; i++) {
        if (directive_take_word(expander, word[i])) {
            *mode = (enum stream_mode)i;
            return true;
        }
    }
    const struct token *token = expand_peek(expander);
    report_wanted(expander->parser, token_location(token),
                  "'read', 'write' or 'append'", token->kind);
    return false;
}

/* The file's name is a global one. */
static bool finish_open(struct expander *expander,
                        const struct pending *pending)
{
    struct parser *parser = expander->parser;
    struct string path = expander->result.string;
    enum stream_mode mode;
    if (!take_mode(expander, &mode)) {
        return false;
    }
    struct stream *stream = stream_open(parser, expander->place, path, mode);
    struct symbol *symbol = stream ? symbols_declare(&parser->symbols,
                                                     pending->file)
                                   : NULL;
    if (!symbol) {
        return parser->failed ? false : report_no_memory(parser);
    }
    struct value *value = symbol_value(symbol);
    value->kind = VALUE_FILE;
    value->stream = stream;
    return true;
}

/* ---- #read ------------------------------------------------------------- */

/* What is read into stays what it was: a number or a string. */
static bool check_target(struct expander *expander, const struct value *target,
                         struct location at)
{
    return !target || target->kind == VALUE_NONE ||
           target->kind == VALUE_NUMBER || target->kind == VALUE_STRING ||
           parser_error(expander->parser, at, "cannot read into this %s",
                        value_name(target));
}

/* Reads one value. At its end the file is closed. */
static bool read_value(struct expander *expander, struct value *file,
                       struct value *value, struct location at)
{
    *value = (struct value){.kind = VALUE_NONE};
    if (file->kind == VALUE_NONE) {
        return true;
    }
    return stream_read(expander->parser, at, file->stream, value) &&
           (!stream_at_end(file->stream) || close_file(expander, file, at));
}

static bool read_name(struct expander *expander, struct value *file,
                      struct name *name, struct location at)
{
    struct value value;
    if (!directive_may_declare(expander, name, at) ||
        !check_target(expander, symbols_find(name), at) ||
        !read_value(expander, file, &value, at)) {
        return false;
    }
    if (value.kind == VALUE_NONE) {
        return true;
    }
    struct symbol *symbol = symbols_declare(&expander->parser->symbols, name);
    if (!symbol) {
        return report_no_memory(expander->parser);
    }
    *symbol_value(symbol) = value;
    return true;
}

static bool read_targets(struct expander *expander, struct value *file)
{
    while (!expand_take(expander, ')')) {
        struct location at = token_location(expand_peek(expander));
        struct name *name = expand_need_name(expander);
        if (!name) {
            return false;
        }
        struct value *value = symbols_find(name);
        if (value && value->kind == VALUE_ARRAY &&
            expand_peek(expander)->kind == '[') {
            struct seek seek = {.item = value, .use = ITEM_READ, .file = file};
            return item_seek(expander, &seek, at);
        }
        if (!read_name(expander, file, name, at)) {
            return false;
        }
        expand_take(expander, ',');
    }
    return true;
}

bool fileio_item(struct expander *expander, const struct seek *seek,
                 struct location at)
{
    struct value value;
    if (!check_target(expander, seek->item, at) ||
        !read_value(expander, seek->file, &value, at)) {
        return false;
    }
    if (value.kind != VALUE_NONE) {
        *seek->item = value;
    }
    expand_take(expander, ',');
    return read_targets(expander, seek->file);
}

/* ---- #write ------------------------------------------------------------ */

static enum stream_word take_stream_word(struct expander *expander)
{
    for (int i = STREAM_TEXT + 1; i < STREAM_WORDS; i++) {
        if (directive_take_word(expander,
                                stream_word_name((enum stream_word)i))) {
            return (enum stream_word)i;
        }
    }
    return STREAM_TEXT;
}

static bool write_next(struct expander *expander, struct value *file,
                       struct location at)
{
    if (expand_take(expander, ')')) {
        return true;
    }
    enum stream_word word = take_stream_word(expander);
    struct pending *pending = expand_begin(expander, TOK_MODE_VALUE, USE_WRITE,
                                           at);
    if (pending) {
        pending->write.file = file;
        pending->write.word = word;
    }
    return pending;
}

static bool finish_write(struct expander *expander,
                         const struct pending *pending)
{
    const struct value *value = &expander->result;
    struct value *file = pending->write.file;
    if (value->kind != VALUE_NUMBER && value->kind != VALUE_STRING) {
        return parser_error(expander->parser, expander->place,
                            "cannot write this %s", value_name(value));
    }
    if (!stream_write(expander->parser, pending->at, file->stream, value,
                      pending->write.word)) {
        return false;
    }
    expand_take(expander, ',');
    return write_next(expander, file, pending->at);
}

/* ---- which is which ---------------------------------------------------- */

bool fileio_run(struct expander *expander, const struct token *token)
{
    struct location at = token_location(token);
    int kind = token->kind;
    if (kind == TOK_HASH_FOPEN) {
        return begin_open(expander);
    }
    if (kind == TOK_HASH_FCLOSE) {
        return run_close(expander);
    }
    if (!expand_need(expander, '(')) {
        return false;
    }
    struct location named = token_location(expand_peek(expander));
    struct name *name = expand_need_name(expander);
    struct value *file = name ? open_file(expander, name, named) : NULL;
    if (!file) {
        return false;
    }
    expand_take(expander, ',');
    return kind == TOK_HASH_WRITE ? write_next(expander, file, at)
                                  : read_targets(expander, file);
}

bool fileio_finish(struct expander *expander, const struct pending *pending)
{
    return pending->use == USE_FOPEN ? finish_open(expander, pending)
                                     : finish_write(expander, pending);
}
