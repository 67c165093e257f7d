/* test_machine.c - the machine in float: internal functions against the
 * values that POV-Ray prints (tests/oracle/internal.py), in both precisions,
 * and code that runs in float against the same in double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "core/physics/machine.h"
#include "core/scene.h"

/* ---- internal functions ------------------------------------------------ */

struct row {
    char name[40];
    int number, count; /* arguments                                   */
    double args[32], value;
};

static bool read_row(FILE *file, struct row *row)
{
    char line[512], *next;
    if (!fgets(line, sizeof line, file))
        return false;
    assert_int_equal(sscanf(line, "%39s", row->name), 1);
    next = line + strlen(row->name);
    row->number = (int)strtol(next, &next, 10);
    for (row->count = 0;; row->count++) {
        char *end;
        row->value = strtod(next, &end);
        if (end == next)
            break;
        row->args[row->count] = row->value;
        next = end;
    }
    row->value = row->args[--row->count];
    return true;
}

static double in_float(const struct row *row)
{
    float args[32];
    for (int i = 0; i < row->count; i++)
        args[i] = (float)row->args[i];
    return internal_eval(row->number, args);
}

/* How far the value moves when arguments move by an ulp of a float: what no
 * computation in float can be better than. */
static double sensitivity(const brume_scene *s, int id, const struct row *row)
{
    double sum = 0, out[BRUME_MAX_RESULTS];
    for (int i = 0; i < row->count; i++) {
        double args[32];
        memcpy(args, row->args, sizeof args);
        args[i] += 1.2e-7 * fabs(args[i]);
        assert_true(brume_eval_function(s, id, args, row->count, out, NULL));
        sum += fabs(out[0] - row->value);
    }
    return sum;
}

static void check_row(brume_scene *s, const struct row *row)
{
    double out[BRUME_MAX_RESULTS];
    struct brume_error err = {0};
    int id = brume_add_internal(s, row->number, &err);
    if (id < 0 || !brume_eval_function(s, id, row->args, row->count, out, &err))
        fail_msg("f_%s: %s", row->name, err.text);
    /* noise's generator 3 was found by measurement, to 2e-9 */
    bool noisy = row->args[row->count - 1] == 3;
    double exact = noisy ? 1e-7 : 1e-12;
    if (!(fabs(out[0] - row->value) <= exact * (1 + fabs(row->value))))
        fail_msg("f_%s: %.15g, not %.15g", row->name, out[0], row->value);
    double bound = 4e-6 * (1 + fabs(row->value)) + sensitivity(s, id, row);
    if (!(fabs(in_float(row) - row->value) <= bound))
        fail_msg("f_%s in float: %.9g, not %.9g", row->name, in_float(row),
                 row->value);
}

static void test_internal(void **state)
{
    (void)state;
    int rows = 0;
    struct row row;
    FILE *file = fopen("tests/data/internal.txt", "r");
    brume_scene *s = brume_scene_new(NULL);
    assert_non_null(file);
    for (; read_row(file, &row); rows++)
        check_row(s, &row);
    assert_true(rows >= 800);
    fclose(file);

    struct brume_error err = {0};
    assert_int_equal(brume_add_internal(s, 9, &err), -1);
    assert_non_null(strstr(err.text, "f_comma"));
    assert_int_equal(brume_add_internal(s, -1, NULL), -1);
    brume_scene_free(s);
}

/* An internal function called by another: f_torus(x, y, z, 2, 1) + z */
static void test_internal_call(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(NULL);
    int torus = brume_add_internal(s, 70, NULL);
    struct brume_function *f = brume_function_new(s, 3, NULL);
    for (int i = 0; i < 3; i++)
        brume_function_parameter(f, i, NULL);
    brume_function_constant(f, 2, NULL);
    brume_function_constant(f, 1, NULL);
    brume_function_call(f, torus, 5, NULL);
    brume_function_parameter(f, 2, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    int id = brume_add_function(s, f, NULL);
    double p[3] = {3, 4, 4}, out[BRUME_MAX_RESULTS];
    assert_true(brume_eval_function(s, id, p, 3, out, NULL));
    assert_true(out[0] == 5 - 1 + 4);
    brume_scene_free(s);
}

/* ---- float and double -------------------------------------------------- */

static machine in_single(const brume_scene *s, float **pool)
{
    *pool = malloc((s->pool_count + 1) * sizeof **pool);
    for (size_t i = 0; i < s->pool_count; i++)
        (*pool)[i] = (float)s->pool[i];
    machine m = {.code = s->code,
                 .functions = s->functions,
                 .pool = *pool,
                 .grids = NULL};
    return m;
}

/* sum(i, 1, 9, sin(i x + y) / i) + select(z, x^2, atan2(y, x)) tanh(z) */
static int add_mixed(brume_scene *s)
{
    struct brume_function *f = brume_function_new(s, 3, NULL);
    brume_function_constant(f, 1, NULL);
    brume_function_constant(f, 9, NULL);
    brume_function_open(f, BRUME_BLOCK_SUM, NULL);
    brume_function_variable(f, 0, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_parameter(f, 1, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    brume_function_op(f, BRUME_OP_SIN, NULL);
    brume_function_variable(f, 0, NULL);
    brume_function_op(f, BRUME_OP_DIVIDE, NULL);
    brume_function_close(f, NULL);
    brume_function_parameter(f, 2, NULL);
    brume_function_open(f, BRUME_BLOCK_SELECT, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_constant(f, 2, NULL);
    brume_function_op(f, BRUME_OP_POW, NULL);
    brume_function_next(f, NULL);
    brume_function_parameter(f, 1, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_op(f, BRUME_OP_ATAN2, NULL);
    brume_function_close(f, NULL);
    brume_function_parameter(f, 2, NULL);
    brume_function_op(f, BRUME_OP_TANH, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    return brume_add_function(s, f, NULL);
}

static void test_float(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(NULL);
    int id = add_mixed(s);
    float *pool, r[MACHINE_REGISTERS];
    machine m = in_single(s, &pool);
    for (int i = 0; i < 1000; i++) {
        double p[3] = {i % 10 - 4.7, i / 10 % 10 - 4.8, i / 100 - 4.4};
        double out[BRUME_MAX_RESULTS];
        double truth = p[2] < 0 ? p[0] * p[0] : atan2(p[1], p[0]);
        truth *= tanh(p[2]);
        for (int k = 1; k <= 9; k++)
            truth += sin(k * p[0] + p[1]) / k;
        assert_true(brume_eval_function(s, id, p, 3, out, NULL));
        assert_true(fabs(out[0] - truth) <= 1e-13 * (1 + fabs(truth)));
        for (int k = 0; k < 3; k++)
            r[k] = (float)p[k];
        assert_true(machine_run(&m, id, r));
        assert_true(fabs(r[0] - truth) <= 2e-5 * (1 + fabs(truth)));
    }
    free(pool);
    brume_scene_free(s);
}

/* Every unary and binary operation in float: an error of 4e-6 of the largest
 * of the arguments, the value and 1, where the function is not steep. */
static void test_float_ops(void **state)
{
    (void)state;
    brume_scene *s = brume_scene_new(NULL);
    for (int op = 0; op < BRUME_OP_GRAY; op++) {
        bool two = op >= BRUME_OP_ADD;
        struct brume_function *f = brume_function_new(s, 2, NULL);
        brume_function_parameter(f, 0, NULL);
        if (two)
            brume_function_parameter(f, 1, NULL);
        brume_function_op(f, (enum brume_op)op, NULL);
        int id = brume_add_function(s, f, NULL);
        float *pool, r[MACHINE_REGISTERS];
        machine m = in_single(s, &pool);
        for (int i = 0; i < 40 * 40; i++) {
            double a[2] = {(i % 40 - 20) / 8.0, (i / 40 - 20) / 8.0};
            double out[BRUME_MAX_RESULTS];
            assert_true(brume_eval_function(s, id, a, 2, out, NULL));
            r[0] = (float)a[0];
            r[1] = (float)a[1];
            assert_true(machine_run(&m, id, r));
            double scale = 1 + fabs(a[0]) + fabs(out[0]);
            bool same = fabs(r[0] - out[0]) <= 4e-6 * scale ||
                        (isnan(out[0]) && isnan(r[0])) ||
                        (double)r[0] == out[0];
            if (!same)
                fail_msg("op %d of %g, %g: %g, not %g", op, a[0], a[1], r[0],
                         out[0]);
        }
        free(pool);
    }
    brume_scene_free(s);
}

#define CASE(name)                                                             \
    {                                                                          \
        "machine__" #name, test_##name, NULL, NULL, NULL                       \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(internal),
        CASE(internal_call),
        CASE(float),
        CASE(float_ops),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
