/* function.h - byte code as it is written and verified on the host.
 *
 * A scene keeps all its functions as one program: instructions, functions and
 * a pool of numbers, in double; rendering gets them as float. */
#ifndef CORE_FUNCTION_H
#define CORE_FUNCTION_H
#ifndef PHYSICS_DOUBLE
#error "functions are written and verified in double"
#endif
#include "core/physics/machine.h"
#include "core/scene.h"

struct function_block {
    enum brume_block kind;
    int height;             /* operands below its first body               */
    int bodies;
    int32_t condition;      /* select: its operand                         */
    size_t test[2], leave[2];   /* instructions whose jumps are open yet   */
};

enum { FUNCTION_BLOCKS = 32 };

/* Its operands are value operands of machine.h. One that is a parameter, a
 * constant or a loop's variable stays where it is until it is wanted at its
 * place in the frame. */
struct brume_function {
    struct brume_scene *scene;
    bool failed;
    int parameters, height, registers, calls, open;
    machine_instruction *code;
    size_t count, capacity;
    int32_t stack[MACHINE_REGISTERS];
    struct function_block blocks[FUNCTION_BLOCKS];
};

/* The program as the machine reads it. */
machine function_machine(const struct brume_scene *scene);

/* Whether a machine may run the instructions from `code` on as function
 * number `id` of the scene: it may call those before it. */
bool function_verify(const struct brume_scene *scene,
                     const machine_instruction *code, int32_t id,
                     const machine_function *f, struct brume_error *err);

/* `count` numbers into the pool; *first is their place. */
bool pool_add(struct brume_scene *s, const double *numbers, size_t count,
              int32_t *first, struct brume_error *err);

/* Whether there is a spline of that id, and such a kind or -1. */
bool spline_check(const struct brume_scene *s, int id, int kind,
                  struct brume_error *err);

/* ---- what writes more than brume.h's operations ------------------------ */

/* An instruction on `takes` operands, put at their places in the frame from
 * dst on, that leaves `gives` results there. */
bool function_wide(struct brume_function *f, enum machine_op op, int takes,
                   int gives, int32_t a, int32_t b, int32_t c,
                   struct brume_error *err);
#endif
