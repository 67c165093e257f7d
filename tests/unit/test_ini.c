#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>
#include "parser/ini.h"

static void write_item(const struct ini_item *item, int line, char *out,
                       size_t size)
{
    switch (item->kind) {
    case INI_SECTION:
        snprintf(out, size, "%d[%s] ", line, item->name);
        break;
    case INI_SETTING:
        snprintf(out, size, "%d<%s=%s> ", line, item->name, item->value);
        break;
    case INI_WORD:
        snprintf(out, size, "%d<%s> ", line, item->name);
        break;
    case INI_BAD:
        snprintf(out, size, "%d!%s ", line, item->name);
        break;
    case INI_END:
        break;
    }
}

/* The items of a text in one line: LINE[section] LINE<name=value> LINE<word>
 * LINE!error. */
static void list_items(const char *text, size_t length, char *out, size_t size)
{
    struct arena arena;
    struct ini ini;
    struct ini_item item;
    arena_init(&arena, 0);
    ini_init(&ini, text, length);
    *out = '\0';
    while (ini_next(&ini, &arena, &item) && item.kind != INI_END) {
        size_t used = strlen(out);
        write_item(&item, ini.number, out + used, size - used);
    }
    arena_release(&arena);
}

static void assert_items(const char *text, const char *expected)
{
    char out[512];
    list_items(text, strlen(text), out, sizeof out);
    assert_string_equal(out, expected);
}

static void test_ini__settings(void **state)
{
    (void)state;
    assert_items("Width=320\n Height = 240 \n", "1<Width=320> 2<Height=240> ");
    assert_items("Width=320\r\nHeight=240\r\n", "1<Width=320> 2<Height=240> ");
    assert_items("\xef\xbb\xbfWidth=1", "1<Width=1> ");
    assert_items("Declare=N=7", "1<Declare=N=7> ");
    assert_items("Height=", "1<Height=> ");
    assert_items("A=b c d ; e", "1<A=b c d> ");
}

static void test_ini__comments(void **state)
{
    (void)state;
    assert_items("; a\n# b\nWidth=3;c\nHeight=4#d\n",
                 "3<Width=3> 4<Height=4> ");
    assert_items("+W3 ; +H4", "1<+W3> ");
    assert_items("", "");
    assert_items("\n\n", "");
    assert_items(";", "");
}

static void test_ini__quotes(void **state)
{
    (void)state;
    assert_items("A=\"x;y#z\" ; c", "1<A=x;y#z> ");
    assert_items("A='say \"no\"'", "1<A=say \"no\"> ");
    assert_items("A=''", "1<A=> ");
    assert_items("+O\"my picture.png\" +W4", "1<+Omy picture.png> 1<+W4> ");
    assert_items("\"+Oa b\"", "1<+Oa b> ");
    assert_items("A=\"x\nB=1", "1!this quote is not closed 2<B=1> ");
    assert_items("A=\"x\" y", "1!nothing may follow a quoted value ");
    assert_items("+O\"x", "1!this quote is not closed ");
}

static void test_ini__sections(void **state)
{
    (void)state;
    assert_items("[low]\nA=1\n[ High Res ] ; c\nB=2",
                 "1[low] 2<A=1> 3[High Res] 4<B=2> ");
    assert_items("[low\nA=1", "1!this '[' has no ']' 2<A=1> ");
    assert_items("[a] b", "1!nothing may follow a section's name ");
}

static void test_ini__words(void **state)
{
    (void)state;
    assert_items("+W3 +H4 other.ini[x]", "1<+W3> 1<+H4> 1<other.ini[x]> ");
    assert_items("+H4 Width=3", "1<+H4> 1<Width=3> ");
    assert_items("=3", "1<=3> ");
}

static void test_ini__nul_byte(void **state)
{
    (void)state;
    char out[512];
    list_items("A=1\0\nB=2", 8, out, sizeof out);
    assert_string_equal(out, "1!a NUL byte: this is no text 2<B=2> ");
}

/* No byte sequence leads beyond the text; the sanitizers watch. */
static void test_ini__any_bytes(void **state)
{
    (void)state;
    static const char bytes[] = "[]=\"';#\n +-aA\t\r";
    char text[12], out[4096];
    uint32_t x = 1;
    for (int round = 0; round < 20000; round++) {
        size_t length = round % sizeof text;
        for (size_t i = 0; i < length; i++) {
            x = x * 1664525 + 1013904223;
            text[i] = bytes[(x >> 16) % (sizeof bytes - 1)];
        }
        char *exact = test_malloc(length + 1);
        memcpy(exact, text, length);
        list_items(exact, length, out, sizeof out);
        test_free(exact);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ini__settings),
        cmocka_unit_test(test_ini__comments),
        cmocka_unit_test(test_ini__quotes),
        cmocka_unit_test(test_ini__sections),
        cmocka_unit_test(test_ini__words),
        cmocka_unit_test(test_ini__nul_byte),
        cmocka_unit_test(test_ini__any_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
