/* The verifier: what holds of all code, so that the machine need not look.
 * Operands lie in the frame, the pool and the function; jumps lead forward,
 * save a loop's; a function calls only those before it, so calls end. */
#define PHYSICS_DOUBLE
#include "core/function.h"

#define UNARY(name, value) "1v--",
#define BINARY(name, value) "1vv-",
#define OTHER(name, shape) shape,
static const char shapes[MACHINE_OPS][5] = {
    MACHINE_UNARY(UNARY) MACHINE_BINARY(BINARY) MACHINE_OTHER(OTHER)};
#undef UNARY
#undef BINARY
#undef OTHER

struct verifier {
    const struct brume_scene *scene;
    const machine_instruction *code;
    const machine_function *f;
    int32_t id;
};

static bool in_frame(const struct verifier *v, int64_t first, int64_t count)
{
    return first >= 0 && first + count <= v->f->registers;
}

static bool is_value(const struct verifier *v, int32_t operand)
{
    return operand >= 0 ? in_frame(v, operand, 1)
                        : (size_t)~operand < v->scene->pool_count;
}

/* A function before this one whose frame fits at that register. */
static bool is_call(const struct verifier *v, int32_t id, int dst)
{
    if (id < 0 || id >= v->id || (size_t)id >= v->scene->functions_count)
        return false;
    const machine_function *callee = &v->scene->functions[id];
    return in_frame(v, dst, callee->registers) && callee->calls < v->f->calls;
}

/* The arguments of an internal function lie in the frame. */
static bool is_internal(const struct verifier *v, const machine_instruction *i)
{
    int parameters = internal_parameters(i->b);
    return parameters >= 0 && in_frame(v, i->a, 3 + parameters);
}

/* A spline of the scene, whose terms have room from dst on. */
static bool is_spline(const struct verifier *v, const machine_instruction *i)
{
    const struct brume_scene *s = v->scene;
    for (size_t k = 0; k < s->splines_count; k++)
        if (s->splines[k] == i->a)
            return in_frame(v, i->dst, (int64_t)s->pool[i->a + 1]) &&
                   i->c >= -1 && i->c < SPLINE_TYPES;
    return false;
}

/* The size of what lies in the pool at an operand; 0 if it is none. */
static size_t pool_room(const struct verifier *v, int32_t operand)
{
    size_t count = v->scene->pool_count;
    return operand >= 0 && (size_t)operand < count ? count - (size_t)operand
                                                   : 0;
}

/* A map whose terms, if it has any, have room from dst on. */
static bool is_map(const struct verifier *v, const machine_instruction *i)
{
    size_t room = pool_room(v, i->a);
    const double *map = v->scene->pool + i->a;
    if (room < BLEND_HEAD || !(map[0] >= 1 && map[0] <= BRUME_MAX_ENTRIES) ||
        !(map[1] >= 0 && map[1] <= BRUME_MAX_RESULTS))
        return false;
    return BLEND_HEAD + (size_t)map[0] * (1 + (size_t)map[1]) <= room &&
           in_frame(v, i->dst, (int64_t)map[1]);
}

/* Functions of a point, the frame of each of which fits at dst. */
static bool is_table(const struct verifier *v, const machine_instruction *i)
{
    size_t room = pool_room(v, i->a);
    const double *table = v->scene->pool + i->a;
    if (room < 1 || !(table[0] >= 1 && table[0] <= BRUME_MAX_ENTRIES) ||
        1 + (size_t)table[0] > room)
        return false;
    for (int k = 1; k <= (int)table[0]; k++)
        if (!(table[k] >= 0 && table[k] < v->id) ||
            !is_call(v, (int32_t)table[k], i->dst) ||
            v->scene->functions[(int)table[k]].parameters != 3)
            return false;
    return true;
}

static bool operand_holds(const struct verifier *v, char shape,
                          const machine_instruction *i, int32_t operand,
                          int32_t at)
{
    switch (shape) {
    case 'v':
        return is_value(v, operand);
    case 'j':
        return operand >= 0 && operand < v->f->length - at - 1;
    case 'l':
        return operand > 0 && operand <= at + 1;
    case 'p':
        return pool_room(v, operand) >= 12;
    case '4':
        return pool_room(v, operand) >= 4;
    case 'g':
        return pool_room(v, operand) >= IMAGE_NUMBERS &&
               image_numbers_hold(v->scene->pool + operand);
    case 'w':
        return warp_size(i->c, v->scene->pool + operand,
                         pool_room(v, operand)) > 0;
    case 'm':
        return pattern_size(i->c, v->scene->pool + operand,
                            pool_room(v, operand)) > 0;
    case 'b':
        return is_map(v, i);
    case 't':
        return is_table(v, i);
    case 'i':
        return is_internal(v, i);
    case 's':
        return is_spline(v, i);
    case 'f':
        return is_call(v, operand, i->dst);
    default:
        return true;
    }
}

/* What the shape of an operation does not tell. */
static bool special_holds(const struct verifier *v,
                          const machine_instruction *i)
{
    switch (i->op) {
    case MACHINE_RETURN:
        return i->b == v->f->results && (i->b == 1 || in_frame(v, i->a, i->b));
    case MACHINE_IMAGE:
        return i->c >= 0 && (size_t)i->c < v->scene->images_count;
    case MACHINE_GRID:
        return i->c >= 0 && (size_t)i->c < v->scene->grids_count;
    case MACHINE_MIX:
        return i->c >= 1 && in_frame(v, i->a, 2 * (int64_t)i->c) &&
               in_frame(v, i->dst, i->c);
    case MACHINE_COPY:
        return i->c >= 1 && in_frame(v, i->a, i->c) &&
               in_frame(v, i->dst, i->c);
    default:
        return true;
    }
}

static bool instruction_holds(const struct verifier *v, int32_t at)
{
    const machine_instruction *i = &v->code[at];
    if (i->op >= MACHINE_OPS)
        return false;
    const char *shape = shapes[i->op];
    int written = shape[0] == '-' ? 0 : shape[0] - '0';
    return in_frame(v, i->dst, written) &&
           operand_holds(v, shape[1], i, i->a, at) &&
           operand_holds(v, shape[2], i, i->b, at) &&
           operand_holds(v, shape[3], i, i->c, at) && special_holds(v, i);
}

bool function_verify(const struct brume_scene *scene,
                     const machine_instruction *code, int32_t id,
                     const machine_function *f, struct brume_error *err)
{
    struct verifier v = {scene, code, f, id};
    if (f->calls > MACHINE_CALLS)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "calls of functions are nested more than %d deep",
                          MACHINE_CALLS);
    bool holds = f->length > 0 && f->registers >= f->parameters &&
                 f->registers >= f->results &&
                 f->registers <= MACHINE_REGISTERS && f->results > 0 &&
                 f->results <= BRUME_MAX_RESULTS && f->parameters >= 0;
    for (int32_t at = 0; holds && at < f->length; at++)
        holds = instruction_holds(&v, at);
    return (holds && code[f->length - 1].op == MACHINE_RETURN) ||
           brume_fail(err, BRUME_ERR_SCENE, "a function's code is not valid");
}
