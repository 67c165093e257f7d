/* test_pattern_float.c - patterns as they are rendered, in float: near to
 * what POV-Ray has in double, where points are not too far out for float. */
#include "pattern_cases.h"

static void test_pattern_float__are_those_of_povray(void **state)
{
    (void)state;
    check_cases(3, 2e-4, 5);
    check_cases(40, 5e-3, 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pattern_float__are_those_of_povray),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
