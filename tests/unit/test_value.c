/* test_value.c - numbers of one to five terms and their operators. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "parser/value.h"
#include <math.h>

static void assert_terms(struct value value, int terms, const double *want)
{
    assert_int_equal(value.kind, VALUE_NUMBER);
    assert_int_equal(value.terms, terms);
    for (int i = 0; i < VALUE_TERMS; i++) {
        assert_true(value.v[i] == (i < terms ? want[i] : 0));
    }
}

static void test_promotion(void **state)
{
    (void)state;
    static const double three[] = {7, 7, 7}, five[] = {1, 2, 0, 0, 0};
    static const double one[] = {1};
    struct value pair = value_vector(2, (double[]){1, 2});
    assert_terms(value_promote(value_float(7), 3), 3, three);
    assert_terms(value_promote(pair, 5), 5, five);
    assert_terms(value_promote(pair, 1), 1, one);
}

static void test_operators(void **state)
{
    (void)state;
    struct value a = value_vector(3, (double[]){1, 2, 3}), out;
    struct value b = value_vector(2, (double[]){4, 5}), two = value_float(2);
    assert_true(value_combine(VALUE_ADD, &a, &b, &out));
    assert_terms(out, 3, (double[]){5, 7, 3});
    assert_true(value_combine(VALUE_SUBTRACT, &two, &a, &out));
    assert_terms(out, 3, (double[]){1, 0, -1});
    assert_true(value_combine(VALUE_MULTIPLY, &a, &two, &out));
    assert_terms(out, 3, (double[]){2, 4, 6});
    assert_true(value_combine(VALUE_DIVIDE, &a, &two, &out));
    assert_terms(out, 3, (double[]){0.5, 1, 1.5});
    assert_terms(value_negate(a), 3, (double[]){-1, -2, -3});
    assert_terms(value_not(value_vector(2, (double[]){0, 3})), 2,
                 (double[]){1, 0});
}

static void test_division_by_zero(void **state)
{
    (void)state;
    struct value a = value_vector(2, (double[]){-1, 4});
    struct value b = value_vector(2, (double[]){0, 2}), out;
    assert_false(value_combine(VALUE_DIVIDE, &a, &b, &out));
    assert_terms(out, 2, (double[]){HUGE_VAL, 2});
}

static void test_relations(void **state)
{
    (void)state;
    static const double close = 1 + 1e-11;
    static const struct {
        enum value_operator op;
        double less, same, more;
    } want[] = {{VALUE_LESS, 1, 1, 0},          {VALUE_LESS_EQUAL, 1, 1, 0},
                {VALUE_EQUAL, 0, 1, 0},         {VALUE_NOT_EQUAL, 1, 0, 1},
                {VALUE_GREATER_EQUAL, 0, 1, 1}, {VALUE_GREATER, 0, 0, 1}};
    struct value a = value_vector(3, (double[]){0, 1, 2}), out;
    struct value b = value_vector(3, (double[]){1, close, 1});
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        value_combine(want[i].op, &a, &b, &out);
        assert_terms(out, 3,
                     (double[]){want[i].less, want[i].same, want[i].more});
    }
}

static void test_infinity_equals_itself(void **state)
{
    (void)state;
    struct value a = value_float(HUGE_VAL), out;
    value_combine(VALUE_EQUAL, &a, &a, &out);
    assert_true(out.v[0] == 1);
}

static void test_strings(void **state)
{
    (void)state;
    struct string a = {"abc", 3}, b = {"ab", 2}, c = {"b", 1}, none = {"", 0};
    assert_int_equal(value_compare_strings(a, a), 0);
    assert_int_equal(value_compare_strings(a, b), 'c');
    assert_int_equal(value_compare_strings(b, a), -'c');
    assert_int_equal(value_compare_strings(a, c), -1);
    assert_int_equal(value_compare_strings(none, none), 0);
}

static void test_names(void **state)
{
    (void)state;
    struct value a = value_float(1), b = value_promote(a, 3);
    struct value c = value_promote(a, 5), d = value_string("", 0);
    assert_string_equal(value_name(&a), "float");
    assert_string_equal(value_name(&b), "vector");
    assert_string_equal(value_name(&c), "color");
    assert_string_equal(value_name(&d), "string");
    for (int kind = 0; kind < VALUE_KINDS; kind++) {
        struct value e = {.kind = (enum value_kind)kind, .terms = 1};
        assert_non_null(value_name(&e));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_promotion),
        cmocka_unit_test(test_operators),
        cmocka_unit_test(test_division_by_zero),
        cmocka_unit_test(test_relations),
        cmocka_unit_test(test_infinity_equals_itself),
        cmocka_unit_test(test_strings),
        cmocka_unit_test(test_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
