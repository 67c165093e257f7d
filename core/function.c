/* Functions as brume.h's calls write them. The stack of operands is known
 * while code is written, so each has its place in the frame, its home: the
 * register of its height above the parameters. */
#define PHYSICS_DOUBLE
#include "core/function.h"
#include <stdlib.h>
#include "lib/memory.h"

enum { CODE_LIMIT = 1 << 20 }; /* instructions of one function */

static bool fail(struct brume_function *f)
{
    f->failed = true;
    return false;
}

bool function_fail(struct brume_function *f, struct brume_error *err,
                   enum brume_code code, const char *text)
{
    brume_fail(err, code, "%s", text);
    return fail(f);
}

static bool fail_scene(struct brume_function *f, struct brume_error *err,
                       const char *text)
{
    return function_fail(f, err, BRUME_ERR_SCENE, text);
}

struct brume_scene *function_scene(const struct brume_function *f)
{
    return f->scene;
}

static bool usable(struct brume_function *f, struct brume_error *err)
{
    return !f->failed ||
           brume_fail(err, BRUME_ERR_SCENE, "the function has failed before");
}

struct brume_function *brume_function_new(brume_scene *scene, int parameters,
                                          struct brume_error *err)
{
    if (parameters < 0 || parameters > BRUME_MAX_PARAMETERS) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "a function has %d parameters but at most %d are possible",
                   parameters, BRUME_MAX_PARAMETERS);
        return NULL;
    }
    struct brume_function *f = memory_new(1, sizeof *f, err);
    if (!f)
        return NULL;
    f->scene = scene;
    f->parameters = f->registers = parameters;
    return f;
}

void brume_function_free(struct brume_function *function)
{
    if (!function)
        return;
    free(function->code);
    free(function);
}

/* ---- instructions ------------------------------------------------------ */

bool function_emit(struct brume_function *f, enum machine_op op, int dst,
                   int32_t a, int32_t b, int32_t c, struct brume_error *err)
{
    if (f->count >= CODE_LIMIT) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "a function has more than %d operations", CODE_LIMIT);
        return fail(f);
    }
    void *grown = memory_grow(f->code, &f->capacity, f->count + 1,
                              sizeof *f->code, err);
    if (!grown)
        return fail(f);
    f->code = grown;
    f->code[f->count++] = (machine_instruction){(uint16_t)op, (uint16_t)dst, a,
                                                b, c};
    return true;
}

/* Lets the jump at `from` lead to the next instruction. */
static void land(struct brume_function *f, size_t from)
{
    f->code[from].a = (int32_t)(f->count - from - 1);
}

bool pool_add(struct brume_scene *s, const double *numbers, size_t count,
              int32_t *first, struct brume_error *err)
{
    if (count > INT32_MAX - s->pool_count)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "too many numbers in functions");
    void *grown = memory_grow(s->pool, &s->pool_capacity, s->pool_count + count,
                              sizeof *s->pool, err);
    if (!grown)
        return false;
    s->pool = grown;
    *first = (int32_t)s->pool_count;
    for (size_t i = 0; i < count; i++)
        s->pool[s->pool_count++] = numbers[i];
    return true;
}

bool function_numbers(struct brume_function *f, const double *values,
                      size_t count, int32_t *first, struct brume_error *err)
{
    return usable(f, err) &&
           (pool_add(f->scene, values, count, first, err) || fail(f));
}

/* ---- the stack --------------------------------------------------------- */

static int home(const struct brume_function *f, int height)
{
    return f->parameters + height;
}

/* Notes that registers up to there are used. */
static bool reach(struct brume_function *f, int registers,
                  struct brume_error *err)
{
    if (registers > MACHINE_REGISTERS) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "a function with those that it calls needs room for more "
                   "than %d numbers",
                   MACHINE_REGISTERS);
        return fail(f);
    }
    if (registers > f->registers)
        f->registers = registers;
    return true;
}

static bool push(struct brume_function *f, int32_t at, struct brume_error *err)
{
    if (!usable(f, err) || !reach(f, home(f, f->height) + 1, err))
        return false;
    f->stack[f->height++] = at;
    return true;
}

/* A result that stands at its home. */
static bool push_home(struct brume_function *f, struct brume_error *err)
{
    return push(f, home(f, f->height), err);
}

/* Operands that the innermost open block may take. */
static bool has(struct brume_function *f, int count, struct brume_error *err)
{
    int floor = f->open > 0 ? f->blocks[f->open - 1].height : 0;
    if (!usable(f, err))
        return false;
    if (count <= f->height - floor)
        return true;
    return fail_scene(f, err, "an operation of a function lacks an operand");
}

/* Moves the operand at a height home, if it is not there. */
static bool settle(struct brume_function *f, int height,
                   struct brume_error *err)
{
    int32_t at = f->stack[height];
    if (at == home(f, height))
        return true;
    f->stack[height] = home(f, height);
    return function_emit(f, MACHINE_MOVE, home(f, height), at, 0, 0, err);
}

/* How many operands from a height on stand side by side in registers, not at
 * home, as the parameters of a point do. */
static int beside(const struct brume_function *f, int height)
{
    int32_t at = f->stack[height];
    int count = 1;
    if (at < 0 || at == home(f, height))
        return count;
    while (height + count < f->height && f->stack[height + count] == at + count)
        count++;
    return count;
}

static bool settle_top(struct brume_function *f, int count,
                       struct brume_error *err)
{
    for (int h = f->height - count; h < f->height;) {
        int32_t at = f->stack[h];
        int together = beside(f, h);
        if (together == 1 ? !settle(f, h, err)
                          : !function_emit(f, MACHINE_COPY, home(f, h), at, 0,
                                           together, err))
            return false;
        for (int i = 0; i < together; i++, h++)
            f->stack[h] = home(f, h);
    }
    return true;
}

bool function_give(struct brume_function *f, bool done, int gives,
                   struct brume_error *err)
{
    if (!done)
        return fail(f);
    for (int i = 0; i < gives; i++)
        if (!push_home(f, err))
            return false;
    return true;
}

bool function_wide(struct brume_function *f, enum machine_op op, int takes,
                   int gives, int32_t a, int32_t b, int32_t c,
                   struct brume_error *err)
{
    if (!has(f, takes, err) || !settle_top(f, takes, err))
        return false;
    f->height -= takes;
    int dst = home(f, f->height);
    return reach(f, dst + gives, err) &&
           function_give(f, function_emit(f, op, dst, a, b, c, err), gives,
                         err);
}

bool function_take(struct brume_function *f, int takes, int needs, int *at,
                   struct brume_error *err)
{
    if (!has(f, takes, err) || !settle_top(f, needs, err))
        return false;
    f->height -= takes;
    *at = home(f, f->height);
    return reach(f, *at + takes + 3 + 2 * BRUME_MAX_RESULTS, err);
}

bool function_calls(struct brume_function *f, int id, int dst,
                    struct brume_error *err)
{
    const machine_function *callee = &f->scene->functions[id];
    if (callee->calls + 1 > f->calls)
        f->calls = callee->calls + 1;
    return reach(f, dst + callee->registers, err);
}

int32_t function_top(const struct brume_function *f, int below)
{
    return home(f, f->height - below);
}

bool brume_function_copy(struct brume_function *function, int count,
                         struct brume_error *err)
{
    struct brume_function *f = function;
    if (count < 0 || !has(f, count, err))
        return fail_scene(f, err,
                          "an operation of a function lacks an operand");
    int first = f->height - count;
    for (int i = 0; i < count; i++) {
        int32_t at = f->stack[first + i];
        bool lasts = at < home(f, first);
        if (!push(f, at, err) || (!lasts && !settle(f, f->height - 1, err)))
            return false;
    }
    return true;
}

/* ---- operations -------------------------------------------------------- */

bool brume_function_constant(struct brume_function *function, double value,
                             struct brume_error *err)
{
    int32_t first = 0;
    return function_numbers(function, &value, 1, &first, err) &&
           push(function, ~first, err);
}

bool brume_function_parameter(struct brume_function *function, int index,
                              struct brume_error *err)
{
    if (index < 0 || index >= function->parameters)
        return fail_scene(function, err,
                          "a function refers to a parameter it does not have");
    return push(function, index, err);
}

/* clang-format off */
#define OP(name) [BRUME_OP_##name] = MACHINE_##name
static const uint16_t machine_ops[] = {
    OP(NEGATE), OP(NOT), OP(ABS), OP(ACOS), OP(ACOSH), OP(ASIN), OP(ASINH),
    OP(ATAN), OP(ATANH), OP(CEIL), OP(COS), OP(COSH), OP(DEGREES), OP(EXP),
    OP(FLOOR), OP(INT), OP(LN), OP(LOG), OP(RADIANS), OP(SIN), OP(SINH),
    OP(SQR), OP(SQRT), OP(TAN), OP(TANH),
    OP(ADD), OP(SUBTRACT), OP(MULTIPLY), OP(DIVIDE), OP(POW), OP(ATAN2),
    OP(MOD), OP(DIV), OP(MIN), OP(MAX), OP(EQUAL), OP(NOT_EQUAL), OP(LESS),
    OP(LESS_EQUAL), OP(GREATER), OP(GREATER_EQUAL), OP(AND), OP(OR),
    OP(GRAY), OP(HEIGHT)
};
#undef OP
/* clang-format on */

bool brume_function_op(struct brume_function *function, enum brume_op op,
                       struct brume_error *err)
{
    struct brume_function *f = function;
    if ((unsigned)op > BRUME_OP_HEIGHT)
        return fail_scene(f, err, "there is no such operation");
    if (op >= BRUME_OP_GRAY)
        return function_wide(f, machine_ops[op], 5, 1, 0, 0, 0, err);
    int takes = op >= BRUME_OP_ADD ? 2 : 1;
    if (!has(f, takes, err))
        return false;
    f->height -= takes;
    int32_t a = f->stack[f->height];
    int32_t b = takes == 2 ? f->stack[f->height + 1] : 0;
    return function_emit(f, machine_ops[op], home(f, f->height), a, b, 0,
                         err) &&
           push_home(f, err);
}

static bool check_call(struct brume_function *f, int id, int arguments,
                       struct brume_error *err)
{
    const brume_scene *s = f->scene;
    if (id < 0 || (size_t)id >= s->functions_count)
        return fail_scene(f, err, "there is no such function to call");
    int parameters = s->functions[id].parameters;
    if (arguments == parameters)
        return true;
    brume_fail(err, BRUME_ERR_SCENE,
               "a function of %d parameters is called with %d arguments",
               parameters, arguments);
    return fail(f);
}

/* An internal function is called without a frame of its own. */
static const machine_instruction *internal(const brume_scene *s,
                                           const machine_function *callee)
{
    const machine_instruction *i = &s->code[callee->code];
    return i->op == MACHINE_INTERNAL ? i : NULL;
}

bool brume_function_call(struct brume_function *function, int id, int arguments,
                         struct brume_error *err)
{
    struct brume_function *f = function;
    if (!usable(f, err) || !check_call(f, id, arguments, err) ||
        !has(f, arguments, err))
        return false;
    const machine_function *callee = &f->scene->functions[id];
    const machine_instruction *i = internal(f->scene, callee);
    if (i)
        return function_wide(f, MACHINE_INTERNAL, arguments, 1,
                             home(f, f->height - arguments), i->b, 0, err);
    return function_calls(f, id, home(f, f->height - arguments), err) &&
           function_wide(f, MACHINE_CALL, arguments, callee->results, id, 0, 0,
                         err);
}

bool brume_function_pick(struct brume_function *function, int count, int index,
                         struct brume_error *err)
{
    struct brume_function *f = function;
    if (count < 1 || count > BRUME_MAX_RESULTS || index < 0 || index >= count)
        return fail_scene(f, err, "there is no such component");
    if (!has(f, count, err))
        return false;
    int height = f->height - count;
    int32_t at = f->stack[height + index];
    f->height = height;
    return push(f, at, err) && (at < home(f, height) || settle(f, height, err));
}

bool brume_function_transform(struct brume_function *function,
                              const double transform[3][4],
                              struct brume_error *err)
{
    int32_t first = 0;
    return function_numbers(function, transform[0], 12, &first, err) &&
           function_wide(function, MACHINE_TRANSFORM, 3, 3, first, 0, 0, err);
}

bool brume_function_spline(struct brume_function *function, int id, int kind,
                           struct brume_error *err)
{
    struct brume_function *f = function;
    if (!usable(f, err) || !spline_check(f->scene, id, kind, err))
        return fail(f);
    int32_t at = f->scene->splines[id];
    int terms = (int)f->scene->pool[at + 1];
    return function_wide(f, MACHINE_SPLINE, 1, terms, at,
                         home(f, f->height - 1), kind, err);
}

/* ---- blocks ------------------------------------------------------------ */

/* Room for the result of a block whose first operand was at that height. */
static bool open_select(struct brume_function *f, struct function_block *b,
                        struct brume_error *err)
{
    b->condition = f->stack[--f->height];
    b->test[0] = f->count;
    return function_emit(f, MACHINE_JUMP_NOT_NEGATIVE, 0, 0, b->condition, 0,
                         err);
}

/* The variable, its last value and the sum so far, each at home. */
static bool open_loop(struct brume_function *f, struct function_block *b,
                      struct brume_error *err)
{
    bool sum = b->kind == BRUME_BLOCK_SUM;
    if (!settle_top(f, 2, err) ||
        !brume_function_constant(f, sum ? 0.0 : 1.0, err) ||
        !settle_top(f, 1, err))
        return false;
    int variable = home(f, f->height - 3);
    b->test[0] = f->count;
    return function_emit(f, MACHINE_JUMP_GREATER, 0, 0, variable, variable + 1,
                         err);
}

bool brume_function_open(struct brume_function *function,
                         enum brume_block block, struct brume_error *err)
{
    struct brume_function *f = function;
    if ((unsigned)block > BRUME_BLOCK_PROD)
        return fail_scene(f, err, "there is no such block");
    if (!has(f, block == BRUME_BLOCK_SELECT ? 1 : 2, err))
        return false;
    if (f->open == FUNCTION_BLOCKS) {
        brume_fail(err, BRUME_ERR_LIMIT,
                   "more than %d of select, sum and prod are nested",
                   FUNCTION_BLOCKS);
        return fail(f);
    }
    struct function_block b = {.kind = block, .bodies = 1};
    bool done = block == BRUME_BLOCK_SELECT ? open_select(f, &b, err)
                                            : open_loop(f, &b, err);
    b.height = f->height;
    f->blocks[f->open++] = b;
    return done;
}

/* A body ends: its one result, at home. */
static bool end_body(struct brume_function *f, struct brume_error *err)
{
    if (!usable(f, err))
        return false;
    if (f->open == 0)
        return fail_scene(f, err, "no block of the function is open");
    if (f->height != f->blocks[f->open - 1].height + 1)
        return fail_scene(f, err,
                          "each part of select, sum and prod is one number");
    return settle_top(f, 1, err);
}

bool brume_function_next(struct brume_function *function,
                         struct brume_error *err)
{
    struct brume_function *f = function;
    if (!end_body(f, err))
        return false;
    struct function_block *b = &f->blocks[f->open - 1];
    if (b->kind != BRUME_BLOCK_SELECT || b->bodies == 3)
        return fail_scene(f, err, "select has two or three alternatives");
    b->leave[b->bodies - 1] = f->count;
    f->height--;
    if (!function_emit(f, MACHINE_JUMP, 0, 0, 0, 0, err))
        return false;
    land(f, b->test[b->bodies - 1]);
    if (b->bodies++ == 2)
        return true;
    /* For a third alternative; without one, close leads around this. */
    b->test[1] = f->count;
    return function_emit(f, MACHINE_JUMP_NOT_ZERO, 0, 0, b->condition, 0, err);
}

static bool close_select(struct brume_function *f, struct function_block *b,
                         struct brume_error *err)
{
    if (b->bodies == 1)
        return fail_scene(f, err, "select has two or three alternatives");
    if (b->bodies == 2)
        f->code[b->test[0]].a++;
    for (int i = 0; i < b->bodies - 1; i++)
        land(f, b->leave[i]);
    return true;
}

static bool close_loop(struct brume_function *f, struct function_block *b,
                       struct brume_error *err)
{
    bool sum = b->kind == BRUME_BLOCK_SUM;
    int variable = home(f, f->height - 4), total = variable + 2;
    f->height -= 4;
    if (!function_emit(f, sum ? MACHINE_ADD : MACHINE_MULTIPLY, total, total,
                       total + 1, 0, err) ||
        !function_emit(f, MACHINE_LOOP, variable,
                       (int32_t)(f->count - b->test[0] + 1), 0, 0, err))
        return false;
    land(f, b->test[0]);
    return function_emit(f, MACHINE_MOVE, variable, total, 0, 0, err) &&
           push_home(f, err);
}

bool brume_function_close(struct brume_function *function,
                          struct brume_error *err)
{
    struct brume_function *f = function;
    if (!end_body(f, err))
        return false;
    struct function_block *b = &f->blocks[--f->open];
    return b->kind == BRUME_BLOCK_SELECT ? close_select(f, b, err)
                                         : close_loop(f, b, err);
}

bool brume_function_variable(struct brume_function *function, int depth,
                             struct brume_error *err)
{
    struct brume_function *f = function;
    for (int i = 0; i < f->open; i++)
        if (f->blocks[i].kind != BRUME_BLOCK_SELECT && depth-- == 0)
            return push(f, home(f, f->blocks[i].height - 3), err);
    return fail_scene(f, err,
                      "a function refers to a variable of no open "
                      "sum or prod");
}

/* ---- the end ----------------------------------------------------------- */

static bool end(struct brume_function *f, struct brume_error *err)
{
    if (!usable(f, err))
        return false;
    if (f->open > 0)
        return fail_scene(f, err, "a block of the function is not closed");
    if (f->height < 1 || f->height > BRUME_MAX_RESULTS)
        return fail_scene(f, err, "a function has one to five results");
    if (f->height > 1 && !settle_top(f, f->height, err))
        return false;
    return function_emit(f, MACHINE_RETURN, 0, f->stack[0], f->height, 0,
                         err) &&
           reach(f, f->height, err);
}

/* Room for one more function, and for its code. */
static bool make_room(struct brume_function *f, struct brume_error *err)
{
    brume_scene *s = f->scene;
    if (s->code_count > INT32_MAX - f->count)
        return brume_fail(err, BRUME_ERR_LIMIT, "too much code in functions");
    void *code = memory_grow(s->code, &s->code_capacity,
                             s->code_count + f->count, sizeof *s->code, err);
    if (!code)
        return false;
    s->code = code;
    void *functions = memory_grow(s->functions, &s->functions_capacity,
                                  s->functions_count + 1, sizeof *s->functions,
                                  err);
    if (!functions)
        return false;
    s->functions = functions;
    return true;
}

static int add(struct brume_function *f, struct brume_error *err)
{
    brume_scene *s = f->scene;
    if (!end(f, err) || !make_room(f, err))
        return -1;
    machine_function entry = {(int32_t)s->code_count, (int32_t)f->count,
                              (int16_t)f->parameters, (int16_t)f->height,
                              (int16_t)f->registers,  (int16_t)f->calls};
    int id = (int)s->functions_count;
    if (!function_verify(s, f->code, id, &entry, err))
        return -1;
    for (size_t i = 0; i < f->count; i++)
        s->code[s->code_count++] = f->code[i];
    s->functions[s->functions_count++] = entry;
    return id;
}

int brume_add_function(brume_scene *scene, struct brume_function *function,
                       struct brume_error *err)
{
    int id = -1;
    if (!function)
        brume_fail(err, BRUME_ERR_SCENE, "there is no function to add");
    else if (function->scene != scene)
        brume_fail(err, BRUME_ERR_SCENE, "the function is of another scene");
    else
        id = add(function, err);
    brume_function_free(function);
    return id;
}

int brume_add_internal(brume_scene *scene, int number, struct brume_error *err)
{
    int parameters = internal_parameters(number);
    if (parameters < 0) {
        brume_fail(err, BRUME_ERR_SCENE, "there is no internal function %d%s",
                   number, number == 9 ? " (f_comma) in Brume" : "");
        return -1;
    }
    struct brume_function *f = brume_function_new(scene, 3 + parameters, err);
    if (!f)
        return -1;
    function_emit(f, MACHINE_INTERNAL, 3 + parameters, 0, number, 0, err);
    push_home(f, err);
    return brume_add_function(scene, f, err);
}

/* ---- evaluation -------------------------------------------------------- */

static const machine_function *find(const brume_scene *scene, int id)
{
    return id >= 0 && (size_t)id < scene->functions_count
               ? &scene->functions[id]
               : NULL;
}

bool brume_function_arity(const brume_scene *scene, int id, int *parameters,
                          int *results)
{
    const machine_function *f = find(scene, id);
    if (!f)
        return false;
    *parameters = f->parameters;
    *results = f->results;
    return true;
}

machine function_machine(const brume_scene *scene)
{
    machine m = {scene->code,  scene->functions, scene->pool,
                 scene->grids, scene->images,    scene->texels};
    return m;
}

bool brume_eval_function(const brume_scene *scene, int id,
                         const double *arguments, int count,
                         double out[BRUME_MAX_RESULTS], struct brume_error *err)
{
    const machine_function *f = find(scene, id);
    if (!f)
        return brume_fail(err, BRUME_ERR_SCENE, "there is no function %d", id);
    if (count != f->parameters)
        return brume_fail(
            err, BRUME_ERR_SCENE,
            "a function of %d parameters is called with %d arguments",
            f->parameters, count);
    machine m = function_machine(scene);
    double registers[MACHINE_REGISTERS];
    for (int i = 0; i < count; i++)
        registers[i] = arguments[i];
    bool done = machine_run(&m, id, registers);
    for (int i = 0; i < f->results; i++)
        out[i] = registers[i];
    return done || brume_fail(err, BRUME_ERR_LIMIT,
                              "a function makes more than %d calls and turns "
                              "of loops",
                              MACHINE_FUEL);
}
