/* test_lexer.c - characters to tokens: kinds, places, blocks; the tables of
 * words. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/builtin.h"
#include "parser/data.h"
#include "parser/grammar.h"
#include "parser/reader.h"
#include "parser/utf8.h"
#include <stdlib.h>
#include <string.h>

/* ---- a scan ------------------------------------------------------------ */

struct fixture {
    struct parse_input in;
    struct parse_result out;
    struct diag diag;
    struct parser parser;
    struct source source, *table[1];
    struct cursor cursor;
    const struct token *token;
    size_t tokens;
};

static void scan(struct fixture *f, const char *text)
{
    size_t length = strlen(text);
    memset(f, 0, sizeof *f);
    diag_init(&f->diag);
    f->parser = (struct parser){.in = &f->in,
                                .out = &f->out,
                                .diag = &f->diag,
                                .source = f->table,
                                .sources = 1};
    f->table[0] = &f->source;
    arena_init(&f->parser.arena, 0);
    assert_true(symbols_init(&f->parser.symbols, &f->parser.arena, NULL));
    f->source = (struct source){.name = "text",
                                .folder = "",
                                .text = calloc(1, length + 2),
                                .length = length};
    memcpy(f->source.text, text, length);
    assert_true(reader_open(&f->parser, &f->source, &f->cursor));
    f->token = f->cursor.chunk->token;
    f->tokens = f->cursor.chunk->tokens;
}

static void release(struct fixture *f)
{
    reader_release(&f->parser);
    free(f->source.text);
    arena_release(&f->parser.arena);
    diag_release(&f->diag);
}

static void assert_kinds(const char *text, const int *kind, size_t count)
{
    struct fixture f;
    scan(&f, text);
    assert_int_equal(f.tokens, count + 1);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(f.token[i].kind, kind[i]);
    }
    assert_int_equal(f.token[count].kind, TOK_END);
    release(&f);
}

/* ---- tokens ------------------------------------------------------------ */

static void test_kinds(void **state)
{
    (void)state;
    static const int sphere[] = {TOK_IDENTIFIER, '{', '<',     TOK_NUMBER, ',',
                                 TOK_IDENTIFIER, '>', TOK_DOT, '}',        ';'};
    assert_kinds("Ball { <1, a>.x };", sphere, sizeof sphere / sizeof *sphere);
    static const int relations[] = {TOK_LESS_EQUAL,
                                    TOK_GREATER_EQUAL,
                                    TOK_NOT_EQUAL,
                                    '<',
                                    '=',
                                    '!',
                                    '&',
                                    '|',
                                    '?',
                                    ':'};
    assert_kinds("<= >= != < = ! & | ? :", relations,
                 sizeof relations / sizeof *relations);
    static const int directives[] = {TOK_HASH_DECLARE, TOK_HASH_IF,
                                     TOK_HASH_ELSE, TOK_HASH_END};
    assert_kinds("#declare # if #\telse #end", directives,
                 sizeof directives / sizeof *directives);
    static const int words[] = {
        TOK_NUMBER_FUNCTION, TOK_STRING_FUNCTION, TOK_RGB,     TOK_RED,
        TOK_COLOR,           TOK_COLOR,           TOK_DEFINED, TOK_ARRAY,
        TOK_IDENTIFIER};
    assert_kinds("sin concat rgbft red color colour defined array Sin", words,
                 sizeof words / sizeof *words);
}

static void test_numbers(void **state)
{
    (void)state;
    struct fixture f;
    static const double want[] = {1, 1, 0.5, 1.5, 1500, 0.025, 7, 1.5, 0.5};
    scan(&f, "1 1. .5 1.5 1.5e3 2.5E-2 007 1.5.5");
    assert_int_equal(f.tokens, 10);
    for (size_t i = 0; i < 9; i++) {
        assert_int_equal(f.token[i].kind, TOK_NUMBER);
        assert_true(f.token[i].number == want[i]);
    }
    release(&f);
}

static void test_strings(void **state)
{
    (void)state;
    struct fixture f;
    scan(&f, "\"a\\tb\\0c\\u00e9\"");
    assert_int_equal(f.token[0].kind, TOK_STRING);
    assert_int_equal(f.token[0].string->length, 7);
    assert_memory_equal(f.token[0].string->text, "a\tb\0c\xC3\xA9", 8);
    release(&f);
}

static void test_places(void **state)
{
    (void)state;
    struct fixture f;
    scan(&f, "a /* \n */ b\n\"\xC3\xA9\" c  ");
    static const int line[] = {1, 2, 3, 3}, column[] = {1, 5, 1, 5};
    for (size_t i = 0; i < 4; i++) {
        struct source_point point = source_locate(&f.source, f.token[i].offset);
        assert_int_equal(point.line, line[i]);
        assert_int_equal(point.column, column[i]);
    }
    release(&f);
}

/* ---- blocks ------------------------------------------------------------ */

static void test_blocks_are_linked(void **state)
{
    (void)state;
    struct fixture f;
    scan(&f, "#while #if #break #elseif #else #if #end #end #end");
    const struct token *token = f.token;
    assert_int_equal(token[0].block.next, 8);
    assert_int_equal(token[0].block.pair, 8);
    assert_int_equal(token[1].block.next, 3);
    assert_int_equal(token[1].block.pair, 7);
    assert_int_equal(token[2].block.pair, 0);
    assert_int_equal(token[3].block.next, 4);
    assert_int_equal(token[4].block.next, 7);
    assert_int_equal(token[4].block.pair, 1);
    assert_int_equal(token[5].block.next, 6);
    assert_int_equal(token[8].block.pair, 0);
    release(&f);
}

static void test_misplaced_directives_are_bad(void **state)
{
    (void)state;
    static const char *const text[] = {
        "#end",           "#else",          "#elseif",    "#case",
        "#range",         "#break",         "#if #break", "#if #case",
        "#while #elseif", "#if #else #else"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        struct fixture f;
        scan(&f, text[i]);
        assert_int_equal(f.token[f.tokens - 2].kind, TOK_BAD);
        release(&f);
    }
}

/* ---- runs of data ------------------------------------------------------ */

static void test_runs_of_data(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint32_t length;
        bool vector;
    } runs[] = {{"<1,2,3>, <4,5,6>}", 16, false},
                {"10, -2.5e-3 , +.5 }", 17, false},
                {"<1,2,3>, <4,5,6>*2 }", 7, true},
                {"<1,2,3>, 4 5}", 7, true},
                {"<1,2,3>, <4,5,6>, x}", 16, false},
                {"<1,2,3> + x, 1}", 7, true},
                {"1, 2}", 0, false},
                {"<1>, <2>}", 0, false},
                {"<1,2,3,4,5,6>, 1, 2}", 0, false},
                {"<1,2,3,>, 1, 2}", 0, false},
                {"100000, 1e}", 6, false},
                {"100000, 1.5.x}", 6, false},
                {"100000, 1.5f}", 6, false},
                {"100000, .}", 6, false},
                {"100000, - 5}", 6, false},
                {"100000", 0, false}};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        struct data_span run = data_measure(runs[i].text, true);
        assert_int_equal(run.length, runs[i].length);
        assert_int_equal(run.vector, runs[i].vector);
    }
    assert_int_equal(data_measure("<1,2, -3>*2", false).length, 9);
    assert_true(data_measure("<1,2>", false).vector);
    assert_int_equal(data_measure("<1,2,3>, 4}", false).length, 7);
    assert_int_equal(data_measure("<1,2,a>", false).length, 0);
    assert_int_equal(data_measure("<1,2", false).length, 0);
    assert_int_equal(data_measure("100000, 1}", false).length, 0);
}

/* The same tokens as if each were scanned by itself. */
static void test_runs_are_tokens(void **state)
{
    (void)state;
    static const int kind[] = {
        TOK_IDENTIFIER, '{', '<', '-',        TOK_NUMBER, ',',
        TOK_NUMBER,     '>', ',', TOK_NUMBER, '}',        TOK_END};
    static const uint32_t offset[] = {0, 2, 4, 5, 6, 7, 8, 10, 11, 13, 16, 17};
    struct fixture f;
    scan(&f, "a { <-1,2.>, 1e3}");
    assert_int_equal(f.token[2].kind, TOK_DATA);
    for (size_t i = 0; i < sizeof kind / sizeof *kind; i++) {
        const struct token *token = cursor_peek(&f.cursor);
        assert_ptr_equal(cursor_peek(&f.cursor), token);
        assert_int_equal(token->kind, kind[i]);
        assert_int_equal(token->offset, offset[i]);
        cursor_skip(&f.cursor);
    }
    release(&f);
}

/* ---- chunks ------------------------------------------------------------ */

/* What is behind is forgotten, unless a block holds it together. */
static void test_chunks(void **state)
{
    (void)state;
    enum { PAIRS = 300000 };
    static char text[2 * PAIRS + 20];
    for (int blocks = 0; blocks < 2; blocks++) {
        char *c = text + sprintf(text, "%s", blocks ? "#if " : "");
        for (int i = 0; i < PAIRS; i++) {
            *c++ = 'a';
            *c++ = ';';
        }
        strcpy(c, blocks ? " #end" : "");
        struct fixture f;
        size_t count = 0;
        scan(&f, text);
        while (cursor_peek(&f.cursor)->kind != TOK_END) {
            cursor_skip(&f.cursor);
            count++;
        }
        assert_int_equal(count, 2 * PAIRS + 2 * blocks);
        assert_int_equal(f.tokens < PAIRS, !blocks);
        assert_int_equal(f.cursor.passed > 1, !blocks);
        assert_null(f.parser.chunks->next);
        release(&f);
    }
}

/* ---- tables ------------------------------------------------------------ */

static void test_words_are_sorted(void **state)
{
    (void)state;
    for (int i = 1; i < keyword_count; i++) {
        assert_true(strcmp(keyword_table[i - 1].word, keyword_table[i].word) <
                    0);
    }
    for (int i = 1; i < directive_count; i++) {
        assert_true(
            strcmp(directive_table[i - 1].word, directive_table[i].word) < 0);
    }
}

static void test_functions_are_there(void **state)
{
    (void)state;
    for (int i = 0; i < keyword_count; i++) {
        int kind = keyword_table[i].kind;
        assert_int_equal(kind == TOK_NUMBER_FUNCTION ||
                             kind == TOK_STRING_FUNCTION,
                         builtin_exists(keyword_table[i].word));
    }
}

/* ---- UTF-8 ------------------------------------------------------------- */

static void test_characters(void **state)
{
    (void)state;
    static const uint32_t code[] = {0,     'a',    0x7F,    0x80,    0x7FF,
                                    0x800, 0xFFFD, 0x10000, 0x10FFFF};
    char text[4];
    size_t size;
    for (size_t i = 0; i < sizeof code / sizeof *code; i++) {
        size_t length = utf8_encode(code[i], text);
        assert_int_equal(utf8_decode(text, length, &size), code[i]);
        assert_int_equal(size, length);
        assert_true(utf8_valid(text, length));
        assert_true(length == 1 || !utf8_valid(text, length - 1));
    }
    assert_int_equal(utf8_encode(0xD800, text), 3);
    assert_memory_equal(text, "\xEF\xBF\xBD", 3);
    /* Overlong, a surrogate, and beyond the last one. */
    assert_false(utf8_valid("\xC0\x80", 2));
    assert_false(utf8_valid("\xE0\x80\x80", 3));
    assert_false(utf8_valid("\xED\xA0\x80", 3));
    assert_false(utf8_valid("\xF4\x90\x80\x80", 4));
    assert_int_equal(utf8_count("a\xC3\xA9\xFF", 4), 3);
    assert_int_equal(utf8_cut("a\xC3\xA9\xFF", 4, 2), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_strings),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_blocks_are_linked),
        cmocka_unit_test(test_misplaced_directives_are_bad),
        cmocka_unit_test(test_runs_of_data),
        cmocka_unit_test(test_runs_are_tokens),
        cmocka_unit_test(test_chunks),
        cmocka_unit_test(test_words_are_sorted),
        cmocka_unit_test(test_functions_are_there),
        cmocka_unit_test(test_characters)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
