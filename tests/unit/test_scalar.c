/* test_scalar.c - expressions of floats read alone and by the grammar give the
 * same. A '?' leaves an expression to the grammar. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/parse.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t state_of_random = 12345;

static int choose(int count)
{
    state_of_random = state_of_random * 1664525u + 1013904223u;
    return (int)(state_of_random >> 16) % count;
}

static void write_operand(FILE *to, int depth);

static void write_expression(FILE *to, int depth, int full)
{
    static const char *const operators[] = {"+",  "-",  "*", "/",  "<", ">",
                                            "<=", ">=", "=", "!=", "&", "|"};
    write_operand(to, depth);
    for (int i = choose(4); i > 0; i--) {
        fprintf(to, " %s ", operators[choose(full ? 12 : 4)]);
        write_operand(to, depth);
    }
}

static void write_operand(FILE *to, int depth)
{
    static const char *const signs[] = {"", "", "", "-", "+", "!", "- -"};
    static const char *const operands[] = {"1", "2.5", ".5", "3",    "P",   "Q",
                                           "R", "pi",  "0",  "A[1]", "A[P]"};

    fputs(signs[choose(7)], to);
    if (depth > 0 && choose(3) == 0) {
        fputc('(', to);
        write_expression(to, depth - 1, 1);
        fputc(')', to);
    } else if (depth > 0 && choose(6) == 0) {
        fputs("A[((", to);
        write_expression(to, depth - 1, 1);
        fputs(") > 1) + 1]", to);
    } else {
        fputs(operands[choose(11)], to);
    }
}

static const char head[] =
    "#declare P = 2; #declare Q = -1.5; #declare R = 1e-11;\n"
    "#declare A = array[3] {4, 0.25, -7}\n"
    "#macro Same(B, C) #if (strcmp(str(B, 0, 15), str(C, 0, 15)) != 0)\n"
    "    #error \"differ\" #end #end\n";

static void test_random_expressions(void **state)
{
    (void)state;
    char *text, *expression;
    size_t length;
    for (int i = 0; i < 3000; i++) {
        size_t size;
        FILE *to = open_memstream(&expression, &size);
        write_expression(to, 3, 0);
        fclose(to);
        to = open_memstream(&text, &length);
        fprintf(to,
                "%s#declare B = %s;\n#declare C = (1 ? %s : 0);\nSame(B, C)\n"
                "#if (%s) #declare D = 1; #else #declare D = 0; #end\n"
                "#if ((1 ? %s : 0)) #declare E = 1; #else #declare E = 0; "
                "#end\nSame(D, E)\n",
                head, expression, expression, expression, expression);
        fclose(to);
        struct parse_input in = {.path = "scene.pov",
                                 .text = text,
                                 .length = length,
                                 .ambient = PARSE_AMBIENT_INIT};
        struct parse_result result;
        struct diag diag;
        diag_init(&diag);
        if (!parse_scene(&in, &result, &diag)) {
            diag_write(&diag, stderr);
            fail_msg("%s", text);
        }
        brume_scene_free(result.scene);
        diag_release(&diag);
        free(text);
        free(expression);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_expressions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
