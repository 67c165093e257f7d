/* test_manual.c - man/brume.5 lists every word of the language that means
 * something, and the directives. Run from the root of the tree. */
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "parser/build.h"
#include "parser/grammar.h"
#include "parser/token.h"

static char page[1 << 17];

static int read_page(void **state)
{
    FILE *file = fopen("man/brume.5", "rb");
    (void)state;

    if (!file)
        return -1;
    size_t size = fread(page, 1, sizeof page - 1, file);
    fclose(file);
    return size > 0 && size < sizeof page - 1 ? 0 : -1;
}

static bool is_part(int c)
{
    return isalnum(c) || c == '_';
}

static bool is_listed(const char *word)
{
    size_t length = strlen(word);

    for (const char *at = page; (at = strstr(at, word)); at++)
        if ((at == page || !is_part((unsigned char)at[-1])) &&
            !is_part((unsigned char)at[length]))
            return true;
    return false;
}

static bool is_known(const struct keyword *keyword)
{
    switch (keyword->kind) {
    case TOK_UNSUPPORTED:
        return false;
    case TOK_WORD:
        return build_knows(keyword->word);
    default:
        return true;
    }
}

static void every_keyword_is_in_the_manual(void **state)
{
    int missing = 0;
    (void)state;

    for (int i = 0; i < keyword_count; i++)
        if (is_known(&keyword_table[i]) && !is_listed(keyword_table[i].word)) {
            print_message("'%s' is not in man/brume.5\n",
                          keyword_table[i].word);
            missing++;
        }
    assert_int_equal(missing, 0);
}

static void every_directive_is_in_the_manual(void **state)
{
    (void)state;
    for (int i = 0; i < directive_count; i++) {
        char word[64];
        snprintf(word, sizeof word, "#%s", directive_table[i].word);
        if (directive_table[i].kind != TOK_UNSUPPORTED && !strstr(page, word))
            fail_msg("'%s' is not in man/brume.5", word);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_keyword_is_in_the_manual),
        cmocka_unit_test(every_directive_is_in_the_manual),
    };

    return cmocka_run_group_tests_name("manual", tests, read_page, NULL);
}
