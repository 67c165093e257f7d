/* machine.h - the byte-code machine of user functions, patterns, pigments
 * and densities: one interpreter, in double where the scene is read and in
 * float where it is rendered (real.h).
 *
 * An instruction names registers of its function's frame. An operand that is
 * a value is a register (>= 0) or, as ~i, the i-th number of the pool. A call
 * opens the callee's frame at its first argument, and the results come back
 * there: nothing is copied. core/function.c writes the code and verifies it
 * (operands, jumps, depth of calls, registers), so that nothing is checked
 * here but the fuel, which ends loops that would not end in useful time.
 *
 * Arithmetic is C's: a division by zero gives infinities and NaN, as in
 * POV-Ray. Comparisons are exact and give 1 or 0. */
#ifndef CORE_PHYSICS_MACHINE_H
#define CORE_PHYSICS_MACHINE_H
#include "core/physics/blend.h"
#ifndef PHYSICS_DOUBLE
#include "core/physics/grid.h"
#endif
#include "core/physics/image.h"
#include "core/physics/internal.h"
#include "core/physics/machine_code.h"
#include "core/physics/pattern.h"
#include "core/physics/pattern_warp.h"
#include "core/physics/spline.h"

/* NAME, value of the operand a */
#define MACHINE_UNARY(X)                                                      \
    X(MOVE, a)                                                                \
    X(NEGATE, -a)                                                             \
    X(NOT, a == REAL(0.0))                                                    \
    X(ABS, real_abs(a))                                                       \
    X(ACOS, real_acos(a))                                                     \
    X(ACOSH, real_acosh(a))                                                   \
    X(ASIN, real_asin(a))                                                     \
    X(ASINH, real_asinh(a))                                                   \
    X(ATAN, real_atan(a))                                                     \
    X(ATANH, real_atanh(a))                                                   \
    X(CEIL, real_ceil(a))                                                     \
    X(COS, real_cos(a))                                                       \
    X(COSH, real_cosh(a))                                                     \
    X(DEGREES, a / REAL_DEGREE)                                               \
    X(EXP, real_exp(a))                                                       \
    X(FLOOR, real_floor(a))                                                   \
    X(INT, real_trunc(a))                                                     \
    X(LN, real_log(a))                                                        \
    X(LOG, real_log10(a))                                                     \
    X(RADIANS, a * REAL_DEGREE)                                               \
    X(SIN, real_sin(a))                                                       \
    X(SINH, real_sinh(a))                                                     \
    X(SQR, a * a)                                                             \
    X(SQRT, real_sqrt(a))                                                     \
    X(TAN, real_tan(a))                                                       \
    X(TANH, real_tanh(a))

/* NAME, value of the operands a and b */
#define MACHINE_BINARY(X)                                                     \
    X(ADD, a + b)                                                             \
    X(SUBTRACT, a - b)                                                        \
    X(MULTIPLY, a * b)                                                        \
    X(DIVIDE, a / b)                                                          \
    X(POW, real_power(a, b))                                                  \
    X(ATAN2, real_atan2(a, b))                                                \
    X(MOD, real_fmod(a, b))                                                   \
    X(DIV, real_trunc(a / b))                                                 \
    X(MIN, real_min(a, b))                                                    \
    X(MAX, real_max(a, b))                                                    \
    X(EQUAL, a == b)                                                          \
    X(NOT_EQUAL, a != b)                                                      \
    X(LESS, a < b)                                                            \
    X(LESS_EQUAL, a <= b)                                                     \
    X(GREATER, a > b)                                                         \
    X(GREATER_EQUAL, a >= b)                                                  \
    X(AND, a != REAL(0.0) && b != REAL(0.0))                                  \
    X(OR, a != REAL(0.0) || b != REAL(0.0))

/* The rest: NAME, and what dst, a, b and c are, for the verifier: a digit is
 * that many registers from dst on; v a value, r a register, j a distance to
 * jump forward, l one to loop back, f a function, n a plain number, - none.
 * Of what has a form of its own, i is the first argument of an internal
 * function; in the pool p are 12 numbers, 4 are 4, g those of a picture, s is
 * a spline, w the numbers of a warp, m of a pattern, b a map and t a table of
 * functions. */
#define MACHINE_OTHER(X)                                                      \
    X(RETURN, "-vn-")       /* b results: one is a, more are registers a...*/ \
    X(CALL, "-f--")         /* frame at dst                                */ \
    X(JUMP, "-j--")                                                           \
    X(JUMP_NOT_NEGATIVE, "-jv-")    /* select with two alternatives        */ \
    X(JUMP_NOT_ZERO, "-jv-")                                                  \
    X(JUMP_GREATER, "-jvv") /* out of a loop                               */ \
    X(LOOP, "1l--")         /* dst += 1, and back                          */ \
    X(INTERNAL, "1in-")     /* internal(b) of registers a...               */ \
    X(SPLINE, "-sv-")       /* dst... = the spline at b, as one of type c  */ \
    X(TRANSFORM, "3p--")    /* 12 numbers of the pool: rows of A|b         */ \
    X(WARP, "3w--")         /* the point at dst, through a warp of kind c  */ \
    X(PATTERN, "3m--")      /* dst = pattern of kind c at the point there  */ \
    X(GRID, "3p--")         /* dst = grid c at the point there, to whose       \
                               index space the 12 numbers lead             */ \
    X(IMAGE, "5g--")        /* dst... = picture c at the point there       */ \
    X(WAVE, "14v-")         /* of type, exponent, frequency and phase      */ \
    X(BLEND, "-bv-")        /* dst... = the values of a map at b           */ \
    X(CHOOSE, "-bv-")       /* dst... = those of its entry number b        */ \
    X(FIND, "2bv-")         /* dst = entry of a map before b, dst + 1 what    \
                               part of the next entry b is to have         */ \
    X(CALL_ENTRY, "-tvn")   /* the function of a table for entry b + c     */ \
    X(MIX, "-nvn")          /* dst... = a... and b of the c numbers after     \
                               them                                        */ \
    X(COPY, "-n-n")         /* dst... = the c registers a...               */ \
    X(GRAY, "3---")         /* dst becomes the gray of a colour            */ \
    X(HEIGHT, "3---")       /* ... its height, as in a height field        */

enum machine_op {
#define X(name, value) MACHINE_##name,
    MACHINE_UNARY(X) MACHINE_BINARY(X) MACHINE_OTHER(X)
#undef X
    MACHINE_OPS
};

/* All functions of a scene. */
typedef struct {
    const machine_instruction *code;
    const machine_function *functions;
    const real *pool;
    const void *grids;      /* in float the flat_scene, in double the host's
                               array of struct grid (lib/grid.h)           */
    const flat_image *images;
    const float *texels;
} machine;

/* The value of a grid at a point of its index space. */
#ifdef PHYSICS_DOUBLE
double machine_grid(const machine *m, int id, real3 index);
#else
HD float machine_grid(const machine *m, int id, real3 index)
{
    const flat_scene *s = (const flat_scene *)m->grids;
    return grid_lookup(s, &s->grids[id],
                       vec3_make(index.x, index.y, index.z));
}
#endif

HD real machine_value(const machine *m, const real *r, int32_t operand)
{
    return operand >= 0 ? r[operand] : m->pool[~operand];
}

/* The point r[0..2] through the affine map of 12 numbers. */
HD void machine_transform(const real *t, real *r)
{
    real x = r[0], y = r[1], z = r[2];
    for (int i = 0; i < 3; i++)
        r[i] = t[4 * i] * x + t[4 * i + 1] * y + t[4 * i + 2] * z
             + t[4 * i + 3];
}

/* As many registers, mostly those of a point or a colour. */
HD void machine_copy(real *to, const real *from, int count)
{
    for (; count >= 3; count -= 3, to += 3, from += 3) {
        real x = from[0], y = from[1], z = from[2];
        to[0] = x;
        to[1] = y;
        to[2] = z;
    }
    for (; count > 0; count--)
        *to++ = *from++;
}

HD void machine_return(const machine *m, const machine_instruction *i, real *r)
{
    if (i->b == 1)
        r[0] = machine_value(m, r, i->a);
    else
        machine_copy(r, r + i->a, i->b);
}

HD real3 machine_point(const real *r)
{
    return real3_make(r[0], r[1], r[2]);
}

HD void machine_warp(const real *numbers, int kind, real *r)
{
    real3 p = pattern_warp(kind, machine_point(r), numbers);
    r[0] = p.x;
    r[1] = p.y;
    r[2] = p.z;
}

HD real machine_wave(const real *p, real value)
{
    return wave_value((int)p[0], p[1], p[2], p[3], value);
}

/* Code of the function that a table, which begins with their count, has for
 * an entry. */
HD int32_t machine_entry(const machine *m, const machine_instruction *i,
                         const real *r)
{
    const real *table = m->pool + i->a;
    int entry = blend_index(machine_value(m, r, i->b) + (real)i->c, table[0]);
    return m->functions[(int32_t)table[1 + entry]].code;
}

HD void machine_mix(const real *a, real part, int count, real *out)
{
    for (int k = 0; k < count; k++)
        out[k] = a[k] + part * (a[count + k] - a[k]);
}

/* Evaluates a function whose arguments stand in registers[0...]; its results
 * come there. There is room for MACHINE_REGISTERS. False when it ran out of
 * fuel: the results are then NaN. */
HD bool machine_run(const machine *m, int32_t function, real *registers)
{
    const machine_instruction *back[MACHINE_CALLS];
    int32_t base[MACHINE_CALLS];
    int32_t depth = 0, fuel = MACHINE_FUEL;
    const machine_instruction *i = m->code + m->functions[function].code;
    real *r = registers;
    for (;; i++) {
        switch (i->op) {
#define X(name, value)                                                        \
        case MACHINE_##name: {                                                \
            real a = machine_value(m, r, i->a);                               \
            r[i->dst] = (real)(value);                                        \
            break;                                                            \
        }
        MACHINE_UNARY(X)
#undef X
#define X(name, value)                                                        \
        case MACHINE_##name: {                                                \
            real a = machine_value(m, r, i->a);                               \
            real b = machine_value(m, r, i->b);                               \
            r[i->dst] = (real)(value);                                        \
            break;                                                            \
        }
        MACHINE_BINARY(X)
#undef X
        case MACHINE_RETURN:
            machine_return(m, i, r);
            if (depth == 0)
                return true;
            depth--;
            i = back[depth];
            r = registers + base[depth];
            break;
        case MACHINE_CALL:
            if (--fuel < 0)
                goto dry;
            back[depth] = i;
            base[depth++] = (int32_t)(r - registers);
            r += i->dst;
            i = m->code + m->functions[i->a].code - 1;
            break;
        case MACHINE_JUMP:
            i += i->a;
            break;
        case MACHINE_JUMP_NOT_NEGATIVE:
            if (!(machine_value(m, r, i->b) < REAL(0.0)))
                i += i->a;
            break;
        case MACHINE_JUMP_NOT_ZERO:
            if (machine_value(m, r, i->b) != REAL(0.0))
                i += i->a;
            break;
        case MACHINE_JUMP_GREATER:
            if (!(machine_value(m, r, i->b) <= machine_value(m, r, i->c)))
                i += i->a;
            break;
        case MACHINE_LOOP:
            if (--fuel < 0)
                goto dry;
            r[i->dst] += REAL(1.0);
            i -= i->a;
            break;
        case MACHINE_INTERNAL:
            r[i->dst] = internal_eval(i->b, r + i->a);
            break;
        case MACHINE_SPLINE:
            spline_eval(m->pool + i->a, i->c, machine_value(m, r, i->b),
                        r + i->dst);
            break;
        case MACHINE_TRANSFORM:
            machine_transform(m->pool + i->a, r + i->dst);
            break;
        case MACHINE_WARP:
            machine_warp(m->pool + i->a, i->c, r + i->dst);
            break;
        case MACHINE_PATTERN:
            r[i->dst] = pattern_value(i->c, machine_point(r + i->dst),
                                      m->pool + i->a);
            break;
        case MACHINE_GRID:
            machine_transform(m->pool + i->a, r + i->dst);
            r[i->dst] = machine_grid(m, i->c, machine_point(r + i->dst));
            break;
        case MACHINE_IMAGE:
            image_lookup(m->images + i->c, m->texels, m->pool + i->a,
                         machine_point(r + i->dst), r + i->dst);
            break;
        case MACHINE_WAVE:
            r[i->dst] = machine_wave(m->pool + i->a,
                                     machine_value(m, r, i->b));
            break;
        case MACHINE_BLEND:
            blend_eval(m->pool + i->a, machine_value(m, r, i->b),
                       r + i->dst);
            break;
        case MACHINE_CHOOSE:
            blend_choose(m->pool + i->a, machine_value(m, r, i->b),
                         r + i->dst);
            break;
        case MACHINE_FIND:
            blend_find(m->pool + i->a, machine_value(m, r, i->b),
                       r + i->dst);
            break;
        case MACHINE_CALL_ENTRY:
            if (--fuel < 0)
                goto dry;
            back[depth] = i;
            base[depth++] = (int32_t)(r - registers);
            i = m->code + machine_entry(m, i, r) - 1;
            r += back[depth - 1]->dst;
            break;
        case MACHINE_MIX:
            machine_mix(r + i->a, machine_value(m, r, i->b), i->c,
                        r + i->dst);
            break;
        case MACHINE_COPY:
            machine_copy(r + i->dst, r + i->a, i->c);
            break;
        case MACHINE_GRAY:
            r[i->dst] = REAL(0.297) * r[i->dst] + REAL(0.589) * r[i->dst + 1]
                      + REAL(0.114) * r[i->dst + 2];
            break;
        case MACHINE_HEIGHT:
            r[i->dst] = REAL(0.996093)
                      * (r[i->dst] + r[i->dst + 1] / REAL(255.0));
            break;
        }
    }
dry:
    for (int k = 0; k < m->functions[function].results; k++)
        registers[k] = (real)NAN;
    return false;
}

#endif
