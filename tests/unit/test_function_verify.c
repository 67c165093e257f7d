/* test_function_verify.c - code that the machine must never see is refused. */
#define PHYSICS_DOUBLE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>
#include "core/function.h"

/* A scene with one function of (x, y): number 0, which needs 4 registers. */
static brume_scene *make_scene(void)
{
    brume_scene *s = brume_scene_new(NULL);
    struct brume_function *f = brume_function_new(s, 2, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_constant(f, 2, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    assert_int_equal(brume_add_function(s, f, NULL), 0);
    return s;
}

static bool accepted(const machine_instruction *code, int length,
                     machine_function f)
{
    brume_scene *s = make_scene();
    f.length = length;
    struct brume_error err = {0};
    bool holds = function_verify(s, code, 1, &f, &err);
    assert_int_equal(holds, err.code == BRUME_OK);
    brume_scene_free(s);
    return holds;
}

/* 4 registers, 2 parameters, 1 result, calls 1 deep */
static const machine_function plain = {0, 0, 2, 1, 4, 1};

static void test_instructions(void **state)
{
    (void)state;
    static const struct {
        bool good;
        machine_instruction i;
    } rows[] = {
        {true, {MACHINE_ADD, 3, 0, 1, 0}},
        {true, {MACHINE_ADD, 3, 0, ~0, 0}},
        {false, {MACHINE_OPS, 0, 0, 0, 0}},
        {false, {65535, 0, 0, 0, 0}},
        {false, {MACHINE_ADD, 4, 0, 1, 0}}, /* beyond the frame */
        {false, {MACHINE_ADD, 3, 4, 1, 0}},
        {false, {MACHINE_ADD, 3, 0, 4, 0}},
        {false, {MACHINE_ADD, 3, 0, ~1, 0}}, /* beyond the pool */
        {false, {MACHINE_ADD, 3, INT32_MIN, 0, 0}},
        {true, {MACHINE_JUMP, 0, 0, 0, 0}},
        {false, {MACHINE_JUMP, 0, 1, 0, 0}}, /* out of the function */
        {false, {MACHINE_JUMP, 0, -1, 0, 0}},
        {false, {MACHINE_JUMP_NOT_ZERO, 0, 0, 9, 0}},
        {true, {MACHINE_LOOP, 2, 1, 0, 0}},
        {false, {MACHINE_LOOP, 2, 2, 0, 0}}, /* before it */
        {false, {MACHINE_LOOP, 2, 0, 0, 0}},
        {true, {MACHINE_CALL, 0, 0, 0, 0}},
        {false, {MACHINE_CALL, 1, 0, 0, 0}}, /* no room for its frame */
        {false, {MACHINE_CALL, 0, 1, 0, 0}}, /* itself */
        {false, {MACHINE_CALL, 0, -1, 0, 0}},
        {false, {MACHINE_RETURN, 0, 0, 2, 0}}, /* another count of results */
        {true, {MACHINE_INTERNAL, 3, 1, 57, 0}},
        {false, {MACHINE_INTERNAL, 3, 1, 70, 0}}, /* lacks arguments */
        {false, {MACHINE_INTERNAL, 3, 0, 9999, 0}},
        {false, {MACHINE_INTERNAL, 3, -1, 57, 0}},
        {false, {MACHINE_TRANSFORM, 0, 0, 0, 0}}, /* the pool is shorter */
        {false, {MACHINE_GRAY, 2, 0, 0, 0}},
        {true, {MACHINE_COPY, 2, 0, 0, 2}},
        {false, {MACHINE_COPY, 3, 0, 0, 2}},
        {false, {MACHINE_COPY, 2, 3, 0, 2}},
        {false, {MACHINE_COPY, 2, 0, 0, 0}},
        {true, {MACHINE_MIX, 0, 0, 0, 2}},
        {false, {MACHINE_MIX, 0, 0, 0, 3}},
        {true, {MACHINE_PATTERN, 0, 0, 0, PATTERN_ONION}},
        {false, {MACHINE_PATTERN, 2, 0, 0, PATTERN_ONION}},
        {false, {MACHINE_PATTERN, 0, 0, 0, PATTERN_GRADIENT}},
        {false, {MACHINE_PATTERN, 0, 0, 0, 1000}},
        {false, {MACHINE_WARP, 0, 0, 0, WARP_PLANAR}},
        {false, {MACHINE_WARP, 0, 0, 0, -1}},
        {false, {MACHINE_WAVE, 0, 0, 0, 0}},
        {false, {MACHINE_GRID, 0, 0, 0, 0}},
        {false, {MACHINE_BLEND, 0, 0, 0, 0}},
        {false, {MACHINE_CALL_ENTRY, 0, 0, 0, 0}},
        {false, {MACHINE_SPLINE, 0, 0, 0, -1}},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        machine_instruction code[2] = {rows[k].i, {MACHINE_RETURN, 0, 0, 1, 0}};
        if (accepted(code, 2, plain) != rows[k].good)
            fail_msg("instruction %d", (int)k);
    }
}

static void test_functions(void **state)
{
    (void)state;
    const machine_instruction back = {MACHINE_RETURN, 0, 0, 1, 0};
    const machine_instruction endless = {MACHINE_MOVE, 0, 0, 0, 0};
    const machine_instruction call[2] = {{MACHINE_CALL, 0, 0, 0, 0}, back};
    machine_function f = plain;
    assert_true(accepted(&back, 1, f));
    assert_false(accepted(&endless, 1, f));
    assert_false(accepted(&back, 0, f));
    f.registers = MACHINE_REGISTERS + 1;
    assert_false(accepted(&back, 1, f));
    f = plain;
    f.registers = 1; /* fewer than parameters */
    assert_false(accepted(&back, 1, f));
    f = plain;
    f.calls = MACHINE_CALLS + 1;
    assert_false(accepted(&back, 1, f));
    f.calls = 0; /* and yet it calls */
    assert_true(accepted(&back, 1, f));
    assert_false(accepted(call, 2, f));
}

#define CASE(name)                                                             \
    {                                                                          \
        "function_verify__" #name, test_##name, NULL, NULL, NULL               \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {CASE(instructions), CASE(functions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
