/* machine_code.h - what the byte-code machine (machine.h) runs, as a scene
 * keeps it: the same in double and in float. */
#ifndef CORE_PHYSICS_MACHINE_CODE_H
#define CORE_PHYSICS_MACHINE_CODE_H
#include <stdint.h>

enum {
    MACHINE_REGISTERS = 256,    /* of all frames of an evaluation          */
    MACHINE_CALLS = 32,         /* calls that may be open at a time        */
    MACHINE_FUEL = 1 << 22      /* calls and turns of loops in all         */
};

typedef struct {
    uint16_t op, dst;
    int32_t a, b, c;
} machine_instruction;

typedef struct {
    int32_t code;           /* its first instruction                       */
    int32_t length;
    int16_t parameters, results;
    int16_t registers;      /* that it and all it calls need               */
    int16_t calls;          /* depth of its calls, 0 if it calls none      */
} machine_function;

/* A picture: rows of texels from the top, `channels` floats each: grey; grey
 * and transmit; red, green, blue; the same and transmit; or with filter too. */
typedef struct {
    int32_t width, height, channels;
    uint64_t texel;         /* the place of its first number               */
} flat_image;

#endif
