#include "parser/reader.h"
#include "lib/memory.h"
#include "parser/block.h"
#include "parser/data.h"
#include "parser/grammar.h"
#include "parser/kept.h"
#include "parser/lexer.h"
#include "parser/report.h"
#include <stdlib.h>

struct reader {
    struct parser *parser;
    struct source *source;
    struct lexer *lexer;
    struct linker linker;
    struct chunk *chunk; /* of its cursor                           */
    struct reader *next; /* of all those of the parser              */
};

/* Tokens of a chunk, and of a piece that is scanned at once. */
enum { CHUNK = 65536, PIECE = 256 };

/* ---- chunks ------------------------------------------------------------ */

static struct chunk *take_chunk(struct parser *parser)
{
    struct chunk *chunk = parser->spare_chunk;
    if (chunk) {
        parser->spare_chunk = chunk->spare;
        return chunk;
    }
    chunk = parser_alloc(parser, sizeof *chunk);
    if (chunk) {
        chunk->next = parser->chunks;
        parser->chunks = chunk;
    }
    return chunk;
}

static void give_chunk(struct parser *parser, struct chunk *chunk)
{
    if (!chunk->kept) {
        chunk->spare = parser->spare_chunk;
        parser->spare_chunk = chunk;
    }
}

static bool make_room(struct reader *reader, struct chunk *chunk)
{
    struct parser *parser = reader->parser;
    struct location at = {0, reader->source->id};
    struct brume_error err = {0};
    size_t before = chunk->room;
    struct token *grown = memory_grow(chunk->token, &chunk->room,
                                      chunk->tokens + PIECE + 1, sizeof *grown,
                                      &err);
    if (!grown) {
        return parser_relay(parser, at, &err);
    }
    chunk->token = grown;
    parser->source_bytes += (chunk->room - before) * sizeof *grown;
    return source_fits(parser, at);
}

/* ---- scanning ---------------------------------------------------------- */

static bool is_block_directive(int kind)
{
    return kind >= TOK_HASH_IF && kind <= TOK_HASH_MACRO;
}

static bool scan_piece(struct reader *reader, struct chunk *chunk)
{
    if (!make_room(reader, chunk)) {
        return false;
    }
    size_t end = chunk->tokens +
                 lexer_scan(reader->lexer, chunk->token + chunk->tokens, PIECE);
    if (end == chunk->tokens) {
        return false;
    }
    for (; chunk->tokens < end; chunk->tokens++) {
        if (is_block_directive(chunk->token[chunk->tokens].kind) &&
            !block_link(&reader->linker, reader->parser, chunk->token,
                        (uint32_t)chunk->tokens)) {
            return false;
        }
    }
    return true;
}

/* Whether no one looks ahead over this token. */
static bool may_end(int kind)
{
    return kind == '}' || kind == ')' || kind == '>' || kind == ';' ||
           kind == ',' || kind == TOK_DATA;
}

static bool is_complete(const struct reader *reader, const struct chunk *chunk)
{
    int last = chunk->token[chunk->tokens - 1].kind;
    return last == TOK_END || (chunk->tokens >= CHUNK &&
                               reader->linker.count == 0 && may_end(last));
}

static bool fill_chunk(struct reader *reader, struct chunk *chunk)
{
    chunk->text = reader->source->text;
    chunk->tokens = 0;
    do {
        if (!scan_piece(reader, chunk)) {
            return false;
        }
    } while (!is_complete(reader, chunk));
    if (chunk->token[chunk->tokens - 1].kind != TOK_END) {
        chunk->token[chunk->tokens++] = (struct token){.kind = TOK_MORE};
    }
    return true;
}

/* The reader's next chunk; NULL: reported. */
static struct chunk *scan_chunk(struct reader *reader)
{
    struct chunk *chunk = take_chunk(reader->parser);
    if (!chunk) {
        return NULL;
    }
    reader->chunk = chunk;
    return fill_chunk(reader, chunk) ? chunk : NULL;
}

/* ---- texts that are kept ----------------------------------------------- */

/* A quarter of what the front end may hold goes to tokens that are kept. */
static bool is_affordable(const struct parser *parser,
                          const struct kept_text *kept)
{
    size_t most = parser->limits.memory / 4;
    return most == 0 || kept->bytes <= most;
}

/* Scans a text to its end, or as far as there is room. False: reported. */
static bool scan_ahead(struct reader *reader, struct kept_text *kept)
{
    struct chunk *chunk = NULL;
    kept->tried = true;
    while (is_affordable(reader->parser, kept)) {
        chunk = kept_chunk(kept, chunk);
        if (!chunk) {
            return report_no_memory(reader->parser);
        }
        if (!fill_chunk(reader, chunk)) {
            return false;
        }
        kept->bytes += chunk->room * sizeof *chunk->token;
        if (chunk->token[chunk->tokens - 1].kind == TOK_END) {
            kept->scanned = true;
            return true;
        }
    }
    return true;
}

/* ---- readers ----------------------------------------------------------- */

static void release(struct reader *reader)
{
    if (reader->lexer) {
        lexer_close(reader->lexer);
    }
    free(reader->linker.open);
    reader->lexer = NULL;
    reader->linker = (struct linker){0};
}

/* Of a text that is kept: its own chunks, and those behind them that there was
 * no room for. NULL: reported. */
static struct chunk *first_chunk(struct reader *reader)
{
    struct parser *parser = reader->parser;
    struct kept_text *kept = reader->source->kept;
    if (kept && kept->scanned) {
        return reader->chunk = kept->chunk;
    }
    bool ahead = kept && !kept->tried;
    reader->lexer = lexer_open(parser, reader->source,
                               ahead ? &kept->arena : &parser->arena);
    if (!reader->lexer) {
        return NULL;
    }
    parser->out->counts.texts_read++;
    if (!ahead) {
        return scan_chunk(reader);
    }
    if (!scan_ahead(reader, kept)) {
        return NULL;
    }
    return kept->chunk ? reader->chunk = kept->chunk : scan_chunk(reader);
}

bool reader_open(struct parser *parser, struct source *source,
                 struct cursor *cursor)
{
    *cursor = (struct cursor){.chunk = source->whole};
    if (source->whole) {
        return true;
    }
    struct reader *reader = parser_alloc(parser, sizeof *reader);
    if (!reader) {
        return false;
    }
    *reader = (struct reader){
        .parser = parser, .source = source, .next = parser->readers};
    parser->readers = reader;
    cursor->reader = reader;
    cursor->chunk = first_chunk(reader);
    if (!cursor->chunk) {
        return false;
    }
    int last = cursor->chunk->token[cursor->chunk->tokens - 1].kind;
    if (last == TOK_END && !source->data) {
        cursor->chunk->kept = true;
        source->whole = cursor->chunk;
        reader_close(parser, cursor);
    }
    return true;
}

void reader_close(struct parser *parser, struct cursor *cursor)
{
    if (cursor->reader) {
        give_chunk(parser, cursor->reader->chunk);
        release(cursor->reader);
        cursor->reader = NULL;
    }
}

void reader_release(struct parser *parser)
{
    for (struct reader *r = parser->readers; r; r = r->next) {
        release(r);
    }
    for (struct chunk *chunk = parser->chunks; chunk; chunk = chunk->next) {
        free(chunk->token);
    }
    parser->chunks = NULL;
}

/* ---- cursors ----------------------------------------------------------- */

/* The next chunk; where there is none for an error, the end. */
static struct token *go_on(struct cursor *cursor)
{
    struct reader *reader = cursor->reader;
    give_chunk(reader->parser, cursor->chunk);
    struct chunk *chunk = cursor->chunk->after;
    reader->chunk = chunk;
    if (!chunk) {
        chunk = scan_chunk(reader);
    }
    if (!chunk) {
        cursor->token = (struct token){.kind = TOK_END};
        return &cursor->token;
    }
    cursor->chunk = chunk;
    cursor->next = 0;
    cursor->passed++;
    return chunk->token->kind == TOK_DATA ? cursor_special(cursor)
                                          : chunk->token;
}

/* Reads the run's next token; false: it has none any more. */
static bool read_datum(struct cursor *cursor)
{
    const struct token *run = &cursor->chunk->token[cursor->next];
    const char *start = data_token(&cursor->data, cursor->data_end,
                                   &cursor->token);
    if (!start) {
        return false;
    }
    cursor->has_token = true;
    cursor->token.source = run->source;
    cursor->token.offset = (uint32_t)(start - cursor->chunk->text);
    return true;
}

struct token *cursor_special(struct cursor *cursor)
{
    const struct token *token = &cursor->chunk->token[cursor->next];
    if (token->kind == TOK_MORE) {
        return go_on(cursor);
    }
    if (!cursor->data) {
        cursor->data = cursor->chunk->text + token->offset;
        cursor->data_end = cursor->data + token->data.length;
        cursor->has_token = false;
    }
    if (!cursor->has_token && !read_datum(cursor)) {
        cursor_jump(cursor, cursor->next + 1);
        return cursor_peek(cursor);
    }
    return &cursor->token;
}
