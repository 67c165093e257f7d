#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <cmocka.h>
#include "lib/json.h"

static void test_json__text(void **state)
{
    (void)state;
    struct json *object = json_new_object(), *array = json_new_array();
    assert_true(json_put_text(object, "z", "a \"b\"\n"));
    assert_true(json_put_number(object, "number", 0.1));
    assert_true(json_put_number(object, "infinite", INFINITY));
    assert_true(json_put_count(object, "count", INT64_MAX));
    assert_true(json_put_flag(array, NULL, true));
    assert_true(json_put_text(array, NULL, "caf\xc3\xa9"));
    assert_true(json_put_text(array, NULL, "caf\xe9"));
    assert_true(json_put(object, "array", array));
    struct brume_error err = {0};
    char *text = json_text(object, &err);
    assert_string_equal(text, "{\n"
                              "  \"z\": \"a \\\"b\\\"\\n\",\n"
                              "  \"number\": 0.1,\n"
                              "  \"infinite\": null,\n"
                              "  \"count\": 9223372036854775807,\n"
                              "  \"array\": [\n"
                              "    true,\n"
                              "    \"caf\xc3\xa9\",\n"
                              "    \"caf?\"\n"
                              "  ]\n"
                              "}\n");
    free(text);
    json_free(object);
}

static void test_json__no_memory(void **state)
{
    (void)state;
    struct json *object = json_new_object();
    assert_false(json_put(object, "missing", NULL));
    assert_false(json_put_flag(NULL, "into nothing", true));
    json_free(object);
    json_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json__text),
        cmocka_unit_test(test_json__no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
