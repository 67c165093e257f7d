/* test_error.c - the first error stays. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>
#include "lib/error.h"

static void error__keeps_the_first(void **state)
{
    (void)state;
    struct brume_error err = {0};
    assert_false(brume_fail(&err, BRUME_ERR_SCENE, "radius %d < 0", -3));
    assert_false(brume_fail(&err, BRUME_ERR_FILE, "later"));
    assert_int_equal(err.code, BRUME_ERR_SCENE);
    assert_string_equal(err.text, "radius -3 < 0");
}

static void error__may_be_null(void **state)
{
    (void)state;
    assert_false(brume_fail(NULL, BRUME_ERR_LIMIT, "no one listens"));
}

static void error__cuts_a_long_text(void **state)
{
    (void)state;
    struct brume_error err = {0};
    brume_fail(&err, BRUME_ERR_USAGE, "%02000d", 7);
    assert_int_equal(strlen(err.text), sizeof err.text - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error__keeps_the_first),
        cmocka_unit_test(error__may_be_null),
        cmocka_unit_test(error__cuts_a_long_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
