/* function.h - byte code as it is written and verified on the host.
 *
 * A scene keeps all its functions as one program: instructions, functions and
 * a pool of numbers, in double; rendering gets them as float. */
#ifndef CORE_FUNCTION_H
#define CORE_FUNCTION_H
#ifndef PHYSICS_DOUBLE
#error "functions are written and verified in double"
#endif
#include "core/matrix.h"
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

/* Whether a picture can be looked up with those IMAGE_NUMBERS. */
bool image_numbers_hold(const double *numbers);

/* How many numbers from there on a pattern or warp has (1 for none), the
 * sources of waves included; 0 if there are not so many, or not such ones. */
size_t pattern_size(int kind, const double *numbers, size_t room);
size_t warp_size(int kind, const double *numbers, size_t room);

/* ---- what writes more than brume.h's operations ------------------------ */

struct brume_scene *function_scene(const struct brume_function *f);

/* The function has failed; false. */
bool function_fail(struct brume_function *f, struct brume_error *err,
                   enum brume_code code, const char *text);

bool function_numbers(struct brume_function *f, const double *values,
                      size_t count, int32_t *first, struct brume_error *err);
bool function_emit(struct brume_function *f, enum machine_op op, int dst,
                   int32_t a, int32_t b, int32_t c, struct brume_error *err);

/* The register of the operand so far below the top, at its home. */
int32_t function_top(const struct brume_function *f, int below);

/* An instruction on `takes` operands, put at their places in the frame from
 * dst on, that leaves `gives` results there. */
bool function_wide(struct brume_function *f, enum machine_op op, int takes,
                   int gives, int32_t a, int32_t b, int32_t c,
                   struct brume_error *err);

/* The same of several instructions, of which the last `needs` operands alone
 * are read: *at is where the operands stand and the results shall; beyond the
 * operands there is room for 3 numbers and those of two calls. Then gives, if
 * all was done. */
bool function_take(struct brume_function *f, int takes, int needs, int *at,
                   struct brume_error *err);
bool function_give(struct brume_function *f, bool done, int gives,
                   struct brume_error *err);

/* Accounts for a call with its frame at register dst. */
bool function_calls(struct brume_function *f, int id, int dst,
                    struct brume_error *err);
#endif
