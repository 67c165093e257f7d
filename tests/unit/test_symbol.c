/* test_symbol.c - names, scopes, and what is like a name. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "parser/diag.h"
#include "parser/symbol.h"
#include <stdio.h>
#include <string.h>

struct fixture {
    struct arena arena;
    struct symbols symbols;
};

static int begin(void **state)
{
    static struct fixture fixture;
    arena_init(&fixture.arena, 0);
    *state = &fixture;
    return symbols_init(&fixture.symbols, &fixture.arena, NULL) ? 0 : -1;
}

static int end(void **state)
{
    struct fixture *f = *state;
    arena_release(&f->arena);
    return 0;
}

static struct name *name_of(struct fixture *f, const char *word)
{
    return symbols_name(&f->symbols, word, strlen(word));
}

static void declare(struct fixture *f, const char *word, double x)
{
    *symbol_value(symbols_declare(&f->symbols, name_of(f, word))) = value_float(
        x);
}

static void declare_local(struct fixture *f, const char *word, double x)
{
    *symbol_value(symbols_local(&f->symbols, name_of(f, word))) = value_float(
        x);
}

static void assert_value(struct fixture *f, const char *word, double x)
{
    const struct value *value = symbols_find(name_of(f, word));
    assert_non_null(value);
    assert_true(value->v[0] == x);
}

static void test_a_word_has_one_name(void **state)
{
    struct fixture *f = *state;
    char word[32];
    struct name *first = name_of(f, "word7");
    for (int i = 0; i < 20000; i++) {
        snprintf(word, sizeof word, "word%d", i);
        assert_string_equal(name_of(f, word)->text, word);
    }
    assert_ptr_equal(name_of(f, "word7"), first);
    assert_non_null(name_of(f, "sphere")->keyword);
    assert_null(name_of(f, "Sphere")->keyword);
}

static void test_locals_hide_and_end(void **state)
{
    struct fixture *f = *state;
    declare(f, "A", 1);
    assert_true(symbols_enter(&f->symbols));
    declare_local(f, "A", 2);
    declare_local(f, "B", 3);
    assert_true(symbols_enter(&f->symbols));
    assert_value(f, "A", 2);
    declare(f, "A", 4);
    declare(f, "C", 5);
    symbols_leave(&f->symbols);
    assert_value(f, "A", 4);
    symbols_leave(&f->symbols);
    assert_value(f, "A", 1);
    assert_value(f, "C", 5);
    assert_null(symbols_find(name_of(f, "B")));
}

static void test_undefine_takes_the_nearest(void **state)
{
    struct fixture *f = *state;
    declare(f, "A", 1);
    symbols_enter(&f->symbols);
    declare_local(f, "A", 2);
    symbols_undefine(name_of(f, "A"));
    assert_value(f, "A", 1);
    symbols_undefine(name_of(f, "A"));
    assert_null(symbols_find(name_of(f, "A")));
    declare(f, "A", 3);
    symbols_leave(&f->symbols);
    assert_value(f, "A", 3);
}

static void test_scopes_reuse_memory(void **state)
{
    struct fixture *f = *state;
    size_t held = 0;
    for (int i = 0; i < 100000; i++) {
        symbols_enter(&f->symbols);
        declare_local(f, "A", i);
        declare_local(f, "B", i);
        symbols_leave(&f->symbols);
        held = i == 10 ? f->arena.held : held;
    }
    assert_int_equal(f->arena.held, held);
}

static void test_suggestions(void **state)
{
    struct fixture *f = *state;
    declare(f, "Radius", 1);
    assert_string_equal(symbols_suggest(&f->symbols, name_of(f, "Radus")),
                        "Radius");
    assert_string_equal(symbols_suggest(&f->symbols, name_of(f, "spere")),
                        "sphere");
    assert_string_equal(symbols_suggest(&f->symbols, name_of(f, "Sphere")),
                        "sphere");
    assert_null(symbols_suggest(&f->symbols, name_of(f, "Q")));
    assert_null(symbols_suggest(&f->symbols, name_of(f, "Quintessence")));
}

static void test_distances(void **state)
{
    (void)state;
    assert_int_equal(diag_distance("", 0, "abc", 3, 9), 3);
    assert_int_equal(diag_distance("kitten", 6, "sitting", 7, 9), 3);
    assert_int_equal(diag_distance("kitten", 6, "sitting", 7, 2), 3);
    assert_int_equal(diag_distance("abc", 3, "abc", 3, 0), 0);
    assert_int_equal(diag_distance("a", 1, "abcdefgh", 8, 2), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_word_has_one_name, begin, end),
        cmocka_unit_test_setup_teardown(test_locals_hide_and_end, begin, end),
        cmocka_unit_test_setup_teardown(test_undefine_takes_the_nearest, begin,
                                        end),
        cmocka_unit_test_setup_teardown(test_scopes_reuse_memory, begin, end),
        cmocka_unit_test_setup_teardown(test_suggestions, begin, end),
        cmocka_unit_test(test_distances)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
