/* test_function.c - functions through the API against direct evaluation in C:
 * every operation, blocks, calls, random expressions, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include <math.h>
#include "core/brume.h"

static int setup(void **state)
{
    *state = brume_scene_new(NULL);
    return *state ? 0 : -1;
}

static int teardown(void **state)
{
    brume_scene_free(*state);
    return 0;
}

static bool same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static double eval(brume_scene *s, int id, int count, const double *args)
{
    double out[BRUME_MAX_RESULTS] = {0};
    struct brume_error err = {0};
    if (!brume_eval_function(s, id, args, count, out, &err))
        fail_msg("%s", err.text);
    return out[0];
}

/* ---- operations -------------------------------------------------------- */

/* clang-format off */
static double op_negate(double a, double b) { (void)b; return -a; }
static double op_not(double a, double b) { (void)b; return !a; }
static double op_int(double a, double b) { (void)b; return trunc(a); }
static double op_sqr(double a, double b) { (void)b; return a * a; }
static double op_degrees(double a, double b) { (void)b; return a * 180 / M_PI; }
static double op_radians(double a, double b) { (void)b; return a * M_PI / 180; }
#define UNARY(name, f) \
    static double op_##name(double a, double b) { (void)b; return f(a); }
UNARY(abs, fabs) UNARY(acos, acos) UNARY(acosh, acosh) UNARY(asin, asin)
UNARY(asinh, asinh) UNARY(atan, atan) UNARY(atanh, atanh) UNARY(ceil, ceil)
UNARY(cos, cos) UNARY(cosh, cosh) UNARY(exp, exp) UNARY(floor, floor)
UNARY(ln, log) UNARY(log, log10) UNARY(sin, sin) UNARY(sinh, sinh)
UNARY(sqrt, sqrt) UNARY(tan, tan) UNARY(tanh, tanh)
static double op_add(double a, double b) { return a + b; }
static double op_subtract(double a, double b) { return a - b; }
static double op_multiply(double a, double b) { return a * b; }
static double op_divide(double a, double b) { return a / b; }
static double op_div(double a, double b) { return trunc(a / b); }
static double op_min(double a, double b) { return a < b ? a : b; }
static double op_max(double a, double b) { return a > b ? a : b; }
static double op_equal(double a, double b) { return a == b; }
static double op_not_equal(double a, double b) { return a != b; }
static double op_less(double a, double b) { return a < b; }
static double op_less_equal(double a, double b) { return a <= b; }
static double op_greater(double a, double b) { return a > b; }
static double op_greater_equal(double a, double b) { return a >= b; }
static double op_and(double a, double b) { return a != 0 && b != 0; }
static double op_or(double a, double b) { return a != 0 || b != 0; }
/* clang-format on */

static const struct {
    enum brume_op op;
    int operands;
    double (*direct)(double, double);
} ops[] = {
    {BRUME_OP_NEGATE, 1, op_negate},
    {BRUME_OP_NOT, 1, op_not},
    {BRUME_OP_ABS, 1, op_abs},
    {BRUME_OP_ACOS, 1, op_acos},
    {BRUME_OP_ACOSH, 1, op_acosh},
    {BRUME_OP_ASIN, 1, op_asin},
    {BRUME_OP_ASINH, 1, op_asinh},
    {BRUME_OP_ATAN, 1, op_atan},
    {BRUME_OP_ATANH, 1, op_atanh},
    {BRUME_OP_CEIL, 1, op_ceil},
    {BRUME_OP_COS, 1, op_cos},
    {BRUME_OP_COSH, 1, op_cosh},
    {BRUME_OP_DEGREES, 1, op_degrees},
    {BRUME_OP_EXP, 1, op_exp},
    {BRUME_OP_FLOOR, 1, op_floor},
    {BRUME_OP_INT, 1, op_int},
    {BRUME_OP_LN, 1, op_ln},
    {BRUME_OP_LOG, 1, op_log},
    {BRUME_OP_RADIANS, 1, op_radians},
    {BRUME_OP_SIN, 1, op_sin},
    {BRUME_OP_SINH, 1, op_sinh},
    {BRUME_OP_SQR, 1, op_sqr},
    {BRUME_OP_SQRT, 1, op_sqrt},
    {BRUME_OP_TAN, 1, op_tan},
    {BRUME_OP_TANH, 1, op_tanh},
    {BRUME_OP_ADD, 2, op_add},
    {BRUME_OP_SUBTRACT, 2, op_subtract},
    {BRUME_OP_MULTIPLY, 2, op_multiply},
    {BRUME_OP_DIVIDE, 2, op_divide},
    {BRUME_OP_POW, 2, pow},
    {BRUME_OP_ATAN2, 2, atan2},
    {BRUME_OP_MOD, 2, fmod},
    {BRUME_OP_DIV, 2, op_div},
    {BRUME_OP_MIN, 2, op_min},
    {BRUME_OP_MAX, 2, op_max},
    {BRUME_OP_EQUAL, 2, op_equal},
    {BRUME_OP_NOT_EQUAL, 2, op_not_equal},
    {BRUME_OP_LESS, 2, op_less},
    {BRUME_OP_LESS_EQUAL, 2, op_less_equal},
    {BRUME_OP_GREATER, 2, op_greater},
    {BRUME_OP_GREATER_EQUAL, 2, op_greater_equal},
    {BRUME_OP_AND, 2, op_and},
    {BRUME_OP_OR, 2, op_or},
};
enum { OPS = sizeof ops / sizeof *ops };

static const double values[] = {
    0,     -0.0, 1,    -1, 2,   -2,    3,      0.5,      -0.5,      0.25,
    -7.75, 1e10, M_PI, 40, -40, 1e300, 1e-300, INFINITY, -INFINITY, NAN};
enum { VALUES = sizeof values / sizeof *values };

static bool nearly(double a, double b)
{
    return same(a, b) || fabs(a - b) <= 4e-15 * fabs(b);
}

static void test_each_op(void **state)
{
    assert_int_equal(OPS, BRUME_OP_GRAY);
    for (int k = 0; k < OPS; k++) {
        struct brume_function *f = brume_function_new(*state, ops[k].operands,
                                                      NULL);
        for (int p = 0; p < ops[k].operands; p++)
            assert_true(brume_function_parameter(f, p, NULL));
        assert_true(brume_function_op(f, ops[k].op, NULL));
        int id = brume_add_function(*state, f, NULL);
        assert_true(id >= 0);
        for (int i = 0; i < VALUES * VALUES; i++) {
            double args[2] = {values[i % VALUES], values[i / VALUES]};
            double got = eval(*state, id, ops[k].operands, args);
            double truth = ops[k].direct(args[0], args[1]);
            if (!nearly(got, truth))
                fail_msg("op %d of %g and %g: %.17g, not %.17g", k, args[0],
                         args[1], got, truth);
        }
    }
}

/* What POV-Ray 3.7 prints for the same. */
static void test_as_povray(void **state)
{
    static const struct {
        enum brume_op op;
        double a, b, value;
    } rows[] = {
        {BRUME_OP_DIVIDE, 1, 0, INFINITY}, {BRUME_OP_POW, -2, 3, -8},
        {BRUME_OP_POW, 0, 0, 1},           {BRUME_OP_POW, 0, -1, INFINITY},
        {BRUME_OP_MOD, -5, 3, -2},         {BRUME_OP_MOD, 5, -3, 2},
        {BRUME_OP_MOD, 5.5, 2, 1.5},       {BRUME_OP_DIV, -5, 3, -1},
        {BRUME_OP_DIV, 5, -3, -1},         {BRUME_OP_DIV, -5.5, 2, -2},
        {BRUME_OP_EQUAL, 1, 1 + 1e-15, 0}, {BRUME_OP_AND, .5, .3, 1},
        {BRUME_OP_AND, 1e-12, 1, 1},       {BRUME_OP_AND, -1, -1, 1},
        {BRUME_OP_OR, .5, 0, 1},           {BRUME_OP_OR, 0, 0, 0},
        {BRUME_OP_ATAN2, 0, 0, 0},         {BRUME_OP_LESS, 1, 1 + 1e-11, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct brume_function *f = brume_function_new(*state, 0, NULL);
        assert_true(brume_function_constant(f, rows[i].a, NULL));
        assert_true(brume_function_constant(f, rows[i].b, NULL));
        assert_true(brume_function_op(f, rows[i].op, NULL));
        int id = brume_add_function(*state, f, NULL);
        assert_true(eval(*state, id, 0, NULL) == rows[i].value);
    }
}

/* ---- blocks ------------------------------------------------------------ */

/* select(x, 10, 20[, 30]) */
static int add_select(brume_scene *s, int bodies)
{
    struct brume_function *f = brume_function_new(s, 1, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_open(f, BRUME_BLOCK_SELECT, NULL);
    for (int i = 1; i <= bodies; i++) {
        if (i > 1)
            brume_function_next(f, NULL);
        brume_function_constant(f, 10 * i, NULL);
    }
    brume_function_close(f, NULL);
    return brume_add_function(s, f, NULL);
}

static void test_select(void **state)
{
    int two = add_select(*state, 2), three = add_select(*state, 3);
    const double x[] = {-1, 0, 1, 1e-12, NAN};
    const double of_two[] = {10, 20, 20, 20, 20};
    const double of_three[] = {10, 20, 30, 30, 30};
    for (int i = 0; i < 5; i++) {
        assert_true(eval(*state, two, 1, &x[i]) == of_two[i]);
        assert_true(eval(*state, three, 1, &x[i]) == of_three[i]);
    }
    assert_int_equal(add_select(*state, 1), -1);
    assert_int_equal(add_select(*state, 4), -1);
}

/* The sum or product over i from x to y of i * z; nested: of j from 1 to i. */
static int add_loop(brume_scene *s, enum brume_block block, bool nested)
{
    struct brume_function *f = brume_function_new(s, 3, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_parameter(f, 1, NULL);
    brume_function_open(f, block, NULL);
    if (nested) {
        brume_function_constant(f, 1, NULL);
        brume_function_variable(f, 0, NULL);
        brume_function_open(f, block, NULL);
    }
    brume_function_variable(f, nested, NULL);
    brume_function_parameter(f, 2, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_close(f, NULL);
    if (nested)
        brume_function_close(f, NULL);
    return brume_add_function(s, f, NULL);
}

static void test_loops(void **state)
{
    /* POV-Ray's values for i * 10 and, of products, for i. */
    const double bounds[][2] = {{1, 4}, {1.5, 4}, {4, 1}, {1, 4.9}, {1, 1}};
    const double sums[] = {100, 75, 0, 100, 10};
    const double products[] = {24, 13.125, 1, 24, 1};
    int sum = add_loop(*state, BRUME_BLOCK_SUM, false);
    int product = add_loop(*state, BRUME_BLOCK_PROD, false);
    for (int i = 0; i < 5; i++) {
        double a[3] = {bounds[i][0], bounds[i][1], 10};
        assert_true(eval(*state, sum, 3, a) == sums[i]);
        a[2] = 1;
        assert_true(eval(*state, product, 3, a) == products[i]);
    }
    const double nested[3] = {1, 4, 2}, factorials[3] = {1, 4, 1};
    sum = add_loop(*state, BRUME_BLOCK_SUM, true);
    assert_true(eval(*state, sum, 3, nested) == 2 * (1 + 3 + 6 + 10));
    product = add_loop(*state, BRUME_BLOCK_PROD, true);
    assert_true(eval(*state, product, 3, factorials) == 1 * 2 * 6 * 24);
}

static void test_fuel(void **state)
{
    double endless[3] = {1, 1e9, 1}, stuck[3] = {1e300, 2e300, 1};
    double out[BRUME_MAX_RESULTS];
    int sum = add_loop(*state, BRUME_BLOCK_SUM, false);
    struct brume_error err = {0};
    assert_false(brume_eval_function(*state, sum, endless, 3, out, &err));
    assert_int_equal(err.code, BRUME_ERR_LIMIT);
    assert_true(isnan(out[0]));
    assert_false(brume_eval_function(*state, sum, stuck, 3, out, NULL));
}

/* ---- calls and vectors ------------------------------------------------- */

/* rotation by 90 degrees about z, then 3 along x: <x, y, z> -> <3-y, x, z> */
static int add_place(brume_scene *s)
{
    const double place[3][4] = {{0, -1, 0, 3}, {1, 0, 0, 0}, {0, 0, 1, 0}};
    struct brume_function *f = brume_function_new(s, 3, NULL);
    for (int i = 0; i < 3; i++)
        brume_function_parameter(f, i, NULL);
    brume_function_transform(f, place, NULL);
    return brume_add_function(s, f, NULL);
}

static void test_vectors(void **state)
{
    const double p[3] = {1, 2, 5};
    double out[BRUME_MAX_RESULTS];
    int parameters, results, place = add_place(*state);
    assert_true(brume_function_arity(*state, place, &parameters, &results));
    assert_int_equal(parameters, 3);
    assert_int_equal(results, 3);
    assert_true(brume_eval_function(*state, place, p, 3, out, NULL));
    assert_true(out[0] == 1 && out[1] == 1 && out[2] == 5);

    /* 100 + place(x, y, z).y * 10 + place(z, y, x).x */
    struct brume_function *f = brume_function_new(*state, 3, NULL);
    brume_function_constant(f, 100, NULL);
    for (int i = 0; i < 3; i++)
        brume_function_parameter(f, i, NULL);
    brume_function_call(f, place, 3, NULL);
    brume_function_pick(f, 3, 1, NULL);
    brume_function_constant(f, 10, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    for (int i = 2; i >= 0; i--)
        brume_function_parameter(f, i, NULL);
    brume_function_call(f, place, 3, NULL);
    brume_function_pick(f, 3, 0, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    assert_true(eval(*state, brume_add_function(*state, f, NULL), 3, p) == 111);

    /* <y, x> and <y, 7, x, 8, y>: results that are parameters, crosswise */
    f = brume_function_new(*state, 2, NULL);
    brume_function_parameter(f, 1, NULL);
    brume_function_constant(f, 7, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_constant(f, 8, NULL);
    brume_function_parameter(f, 1, NULL);
    int id = brume_add_function(*state, f, NULL);
    assert_true(brume_eval_function(*state, id, p, 2, out, NULL));
    const double crossed[5] = {2, 7, 1, 8, 2};
    assert_memory_equal(out, crossed, sizeof crossed);
}

/* POV-Ray's .gray and .hf of rgb <1, 10, 100>. */
static void test_colours(void **state)
{
    const double truth[2] = {17.587, 1.035155470588};
    for (int k = 0; k < 2; k++) {
        struct brume_function *f = brume_function_new(*state, 0, NULL);
        for (int i = 0; i < 5; i++)
            brume_function_constant(f, i < 3 ? pow(10, i) : 0, NULL);
        brume_function_op(f, k ? BRUME_OP_HEIGHT : BRUME_OP_GRAY, NULL);
        int id = brume_add_function(*state, f, NULL);
        assert_true(fabs(eval(*state, id, 0, NULL) - truth[k]) < 1e-12);
    }
}

/* f_0 = x + 1, f_n = f_(n-1)(x) + 1: as deep as calls may go, not deeper. */
static void test_depth(void **state)
{
    const double zero = 0;
    int id = -1, deep = 0;
    struct brume_error err = {0};
    for (;; deep++) {
        struct brume_function *f = brume_function_new(*state, 1, NULL);
        brume_function_parameter(f, 0, NULL);
        if (deep > 0)
            brume_function_call(f, id, 1, NULL);
        brume_function_constant(f, 1, NULL);
        brume_function_op(f, BRUME_OP_ADD, NULL);
        int next = brume_add_function(*state, f, &err);
        if (next < 0)
            break;
        id = next;
    }
    assert_int_equal(err.code, BRUME_ERR_LIMIT);
    assert_int_equal(deep, 33);
    assert_true(eval(*state, id, 1, &zero) == deep);
}

/* ---- random expressions ------------------------------------------------ */

struct random_tree {
    uint64_t seed;
    brume_scene *scene;
    double args[3];
    double variables[8]; /* of the open loops, while evaluated directly */
    int loops, callee;
    struct brume_function *f;
};

static unsigned pick(struct random_tree *t, unsigned n)
{
    t->seed = t->seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(t->seed >> 33) % n;
}

static double tree(struct random_tree *t, int depth);

static double random_leaf(struct random_tree *t)
{
    unsigned kind = pick(t, t->loops > 0 ? 3 : 2);
    if (kind == 0) {
        double value = values[pick(t, 13)];
        brume_function_constant(t->f, value, NULL);
        return value;
    }
    if (kind == 1) {
        int p = (int)pick(t, 3);
        brume_function_parameter(t->f, p, NULL);
        return t->args[p];
    }
    int v = (int)pick(t, (unsigned)t->loops);
    brume_function_variable(t->f, v, NULL);
    return t->variables[v];
}

static double random_select(struct random_tree *t, int depth)
{
    double condition = tree(t, depth - 1), parts[3];
    int bodies = 2 + (int)pick(t, 2);
    brume_function_open(t->f, BRUME_BLOCK_SELECT, NULL);
    for (int i = 0; i < bodies; i++) {
        if (i > 0)
            brume_function_next(t->f, NULL);
        parts[i] = tree(t, depth - 1);
    }
    brume_function_close(t->f, NULL);
    if (condition < 0)
        return parts[0];
    return bodies == 2 || condition == 0 ? parts[1] : parts[2];
}

/* The callee is (x, y) -> y - 2 x. */
static double random_call(struct random_tree *t, int depth)
{
    double a = tree(t, depth - 1), b = tree(t, depth - 1);
    brume_function_call(t->f, t->callee, 2, NULL);
    return b - 2 * a;
}

/* A loop of one turn, whose body a direct evaluation can follow. */
static double random_loop(struct random_tree *t, int depth)
{
    double first = (double)pick(t, 9) - 4;
    brume_function_constant(t->f, first, NULL);
    brume_function_constant(t->f, first + 0.5, NULL);
    bool sum = pick(t, 2);
    brume_function_open(t->f, sum ? BRUME_BLOCK_SUM : BRUME_BLOCK_PROD, NULL);
    t->variables[t->loops++] = first;
    double body = tree(t, depth - 1);
    t->loops--;
    brume_function_close(t->f, NULL);
    return sum ? 0 + body : 1 * body;
}

static double tree(struct random_tree *t, int depth)
{
    if (depth <= 0 || pick(t, 8) == 0)
        return random_leaf(t);
    switch (pick(t, 8)) {
    case 0:
        return random_select(t, depth);
    case 1:
        return random_call(t, depth);
    case 2:
        if (t->loops < 8)
            return random_loop(t, depth);
    }
    unsigned k = pick(t, OPS);
    while (k == BRUME_OP_DEGREES || k == BRUME_OP_RADIANS)
        k = pick(t, OPS); /* rounded in another order here */
    double a = tree(t, depth - 1);
    double b = ops[k].operands == 2 ? tree(t, depth - 1) : 0;
    brume_function_op(t->f, ops[k].op, NULL);
    return ops[k].direct(a, b);
}

static int add_callee(brume_scene *s)
{
    struct brume_function *f = brume_function_new(s, 2, NULL);
    brume_function_parameter(f, 1, NULL);
    brume_function_constant(f, 2, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_op(f, BRUME_OP_SUBTRACT, NULL);
    return brume_add_function(s, f, NULL);
}

static void test_random(void **state)
{
    struct random_tree t = {.seed = 1, .scene = *state};
    t.callee = add_callee(*state);
    int finite = 0;
    for (int i = 0; i < 4000; i++) {
        for (int k = 0; k < 3; k++)
            t.args[k] = (double)pick(&t, 2000) / 250 - 4;
        t.f = brume_function_new(*state, 3, NULL);
        double truth = tree(&t, 1 + i % 9);
        int id = brume_add_function(*state, t.f, NULL);
        assert_true(id >= 0);
        double got = eval(*state, id, 3, t.args);
        if (!same(got, truth))
            fail_msg("expression %d: %.17g, not %.17g", i, got, truth);
        finite += isfinite(truth) && truth != 0;
    }
    assert_true(finite > 2000);
}

/* ---- what is refused --------------------------------------------------- */

static void test_misuse(void **state)
{
    for (int k = 0; k < 14; k++) {
        struct brume_error err = {0};
        struct brume_function *f = brume_function_new(*state, 1, NULL);
        brume_function_parameter(f, 0, NULL);
        switch (k) {
        case 0:
            brume_function_op(f, BRUME_OP_ADD, &err);
            break;
        case 1:
            brume_function_op(f, (enum brume_op)999, &err);
            break;
        case 2:
            brume_function_parameter(f, 1, &err);
            break;
        case 3:
            brume_function_parameter(f, -1, &err);
            break;
        case 4:
            brume_function_call(f, 12345, 1, &err);
            break;
        case 5:
            brume_function_pick(f, 1, 1, &err);
            break;
        case 6:
            brume_function_pick(f, 2, 0, &err);
            break;
        case 7:
            brume_function_variable(f, 0, &err);
            break;
        case 8:
            brume_function_open(f, BRUME_BLOCK_SUM, &err);
            break;
        case 9:
            brume_function_next(f, &err);
            break;
        case 10:
            brume_function_close(f, &err);
            break;
        case 11: /* left open */
            brume_function_open(f, BRUME_BLOCK_SELECT, NULL);
            break;
        case 12: /* a body takes what is below its block */
            brume_function_parameter(f, 0, NULL);
            brume_function_open(f, BRUME_BLOCK_SELECT, NULL);
            brume_function_op(f, BRUME_OP_ABS, &err);
            break;
        default: /* a body of two numbers */
            brume_function_open(f, BRUME_BLOCK_SELECT, NULL);
            brume_function_parameter(f, 0, NULL);
            brume_function_parameter(f, 0, NULL);
            brume_function_next(f, &err);
        }
        assert_true(err.code == BRUME_ERR_SCENE || k == 11);
        assert_int_equal(brume_add_function(*state, f, &err), -1);
        assert_int_equal(err.code, BRUME_ERR_SCENE);
    }
}

static void test_limits(void **state)
{
    struct brume_error err = {0};
    assert_null(brume_function_new(*state, 57, &err));
    assert_int_equal(err.code, BRUME_ERR_LIMIT);

    /* too many operands, and too many results */
    memset(&err, 0, sizeof err);
    struct brume_function *f = brume_function_new(*state, 0, NULL);
    while (brume_function_constant(f, 1, &err))
        ;
    assert_int_equal(err.code, BRUME_ERR_LIMIT);
    assert_int_equal(brume_add_function(*state, f, NULL), -1);
    f = brume_function_new(*state, 0, NULL);
    for (int i = 0; i < 6; i++)
        brume_function_constant(f, i, NULL);
    assert_int_equal(brume_add_function(*state, f, NULL), -1);

    memset(&err, 0, sizeof err);
    f = brume_function_new(*state, 1, NULL);
    do
        brume_function_parameter(f, 0, NULL);
    while (brume_function_open(f, BRUME_BLOCK_SELECT, &err));
    assert_int_equal(err.code, BRUME_ERR_LIMIT);
    brume_function_free(f);
}

static void test_wrong_calls(void **state)
{
    double out[BRUME_MAX_RESULTS], a[3] = {0, 0, 0};
    int id = add_place(*state), parameters, results;
    assert_false(brume_eval_function(*state, id, a, 2, out, NULL));
    assert_false(brume_eval_function(*state, id + 1, a, 3, out, NULL));
    assert_false(brume_function_arity(*state, -1, &parameters, &results));
    brume_scene *other = brume_scene_new(NULL);
    struct brume_function *f = brume_function_new(other, 0, NULL);
    assert_int_equal(brume_add_function(*state, f, NULL), -1);
    brume_scene_free(other);
}

#define CASE(name)                                                             \
    {                                                                          \
        "function__" #name, test_##name, setup, teardown, NULL                 \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(each_op), CASE(as_povray), CASE(select),  CASE(loops),
        CASE(fuel),    CASE(vectors),   CASE(colours), CASE(depth),
        CASE(random),  CASE(misuse),    CASE(limits),  CASE(wrong_calls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
