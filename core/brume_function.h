/* brume_function.h - the part of brume.h that builds functions, patterns and
 * splines; included by it. */
#ifndef CORE_BRUME_FUNCTION_H
#define CORE_BRUME_FUNCTION_H
/* A function of up to BRUME_MAX_PARAMETERS numbers with 1 to BRUME_MAX_RESULTS
 * numbers as its result, written operation by operation in postfix order: as
 * a parser of expressions reduces its rules. Each call takes its operands from
 * the top of a stack and leaves its results there; what is on the stack at the
 * end are the function's results. sqrt(x*x + 2):
 *
 *     f = brume_function_new(scene, 1, err);
 *     brume_function_parameter(f, 0, err);
 *     brume_function_parameter(f, 0, err);
 *     brume_function_op(f, BRUME_OP_MULTIPLY, err);
 *     brume_function_constant(f, 2, err);
 *     brume_function_op(f, BRUME_OP_ADD, err);
 *     brume_function_op(f, BRUME_OP_SQRT, err);
 *     id = brume_add_function(scene, f, err);
 *
 * A call that fails (an operand is missing, an id does not exist, a limit is
 * reached: BRUME_ERR_LIMIT) leaves the function failed: all later calls for it
 * fail too, so that a caller may look at the last result only. One function
 * may be begun while another is being written. */
struct brume_function;

enum { BRUME_MAX_PARAMETERS = 56, BRUME_MAX_RESULTS = 5 };

/* Arithmetic is C's in double: no operation fails, a division by zero gives
 * infinities and NaN. Comparisons are exact, 1 or 0; any number but 0 is true.
 * Angles are radians but for BRUME_OP_DEGREES and BRUME_OP_RADIANS. */
enum brume_op {
    /* one operand */
    BRUME_OP_NEGATE, BRUME_OP_NOT, BRUME_OP_ABS,
    BRUME_OP_ACOS, BRUME_OP_ACOSH, BRUME_OP_ASIN, BRUME_OP_ASINH,
    BRUME_OP_ATAN, BRUME_OP_ATANH, BRUME_OP_CEIL, BRUME_OP_COS, BRUME_OP_COSH,
    BRUME_OP_DEGREES, BRUME_OP_EXP, BRUME_OP_FLOOR,
    BRUME_OP_INT,           /* towards zero                                */
    BRUME_OP_LN,
    BRUME_OP_LOG,           /* to base 10                                  */
    BRUME_OP_RADIANS, BRUME_OP_SIN, BRUME_OP_SINH, BRUME_OP_SQR, BRUME_OP_SQRT,
    BRUME_OP_TAN, BRUME_OP_TANH,
    /* two, the left one first */
    BRUME_OP_ADD, BRUME_OP_SUBTRACT, BRUME_OP_MULTIPLY, BRUME_OP_DIVIDE,
    BRUME_OP_POW,           /* also the operator ^                         */
    BRUME_OP_ATAN2,         /* atan2(y, x)                                 */
    BRUME_OP_MOD,           /* remainder with the sign of the left one     */
    BRUME_OP_DIV,           /* quotient without its fraction               */
    BRUME_OP_MIN, BRUME_OP_MAX, BRUME_OP_EQUAL, BRUME_OP_NOT_EQUAL,
    BRUME_OP_LESS, BRUME_OP_LESS_EQUAL, BRUME_OP_GREATER,
    BRUME_OP_GREATER_EQUAL, BRUME_OP_AND, BRUME_OP_OR,
    /* of a colour's five numbers, as the language's .gray and .hf */
    BRUME_OP_GRAY, BRUME_OP_HEIGHT
};

/* What is written in parts. A body leaves one number on the stack. */
enum brume_block {
    BRUME_BLOCK_SELECT,     /* takes a condition; two bodies (condition < 0,
                               >= 0) or three (< 0, = 0, > 0); leaves the
                               value of the one that holds. The others are not
                               evaluated                                   */
    BRUME_BLOCK_SUM,        /* takes the first and the last value of a
                               variable; one body, evaluated for first,
                               first + 1, ... <= last; leaves the sum, 0 if
                               there was none                              */
    BRUME_BLOCK_PROD        /* the same with the product, 1 if there was none */
};

/* NULL with err set if there are too many parameters or no memory. Used up by
 * brume_add_function; otherwise to be freed before its scene. */
BRUME_API struct brume_function *
brume_function_new(brume_scene *scene, int parameters, struct brume_error *err);
BRUME_API void brume_function_free(struct brume_function *function);

BRUME_API bool brume_function_constant(struct brume_function *function,
                                       double value, struct brume_error *err);
/* The parameter of that index, from 0. */
BRUME_API bool brume_function_parameter(struct brume_function *function,
                                        int index, struct brume_error *err);
BRUME_API bool brume_function_op(struct brume_function *function,
                                 enum brume_op op, struct brume_error *err);
/* Calls a function of the scene: takes as many operands as it has parameters,
 * which `arguments` must be, and leaves its results. */
BRUME_API bool brume_function_call(struct brume_function *function, int id,
                                   int arguments, struct brume_error *err);
/* Takes `count` numbers, 1 to BRUME_MAX_RESULTS, and leaves the one of that
 * index: .x, .red and the like of what a call has left. */
BRUME_API bool brume_function_pick(struct brume_function *function, int count,
                                   int index, struct brume_error *err);
/* Takes a point and leaves A p + b. */
BRUME_API bool brume_function_transform(struct brume_function *function,
                                        const double transform[3][4],
                                        struct brume_error *err);

/* Leaves the operands that are on top a second time. */
BRUME_API bool brume_function_copy(struct brume_function *function, int count,
                                   struct brume_error *err);

/* A block is opened after its operands; its bodies are parted by next, and
 * close ends it. */
BRUME_API bool brume_function_open(struct brume_function *function,
                                   enum brume_block block,
                                   struct brume_error *err);
BRUME_API bool brume_function_next(struct brume_function *function,
                                   struct brume_error *err);
BRUME_API bool brume_function_close(struct brume_function *function,
                                    struct brume_error *err);
/* The variable of an open sum or product; depth 0 is the outermost. */
BRUME_API bool brume_function_variable(struct brume_function *function,
                                       int depth, struct brume_error *err);

/* Ends the function and frees it, also when it fails. Evaluation has limits,
 * so that it always ends: numbers on the stacks of nested calls, their depth
 * and, when it is evaluated, calls and turns of loops. */
BRUME_API int brume_add_function(brume_scene *scene,
                                 struct brume_function *function,
                                 struct brume_error *err);
/* The function internal(number) of POV-Ray 3.7, which functions.inc names: of
 * x, y, z and the parameters that the name has there. Fails if Brume has none
 * of that number. */
BRUME_API int brume_add_internal(brume_scene *scene, int number,
                                 struct brume_error *err);
/* How many parameters and results it has; false if there is no such id. */
BRUME_API bool brume_function_arity(const brume_scene *scene, int id,
                                    int *parameters, int *results);
/* Evaluates it in double. Fails if the count is not that of its parameters, or
 * with BRUME_ERR_LIMIT if it takes too long. Results may be infinite or NaN. */
BRUME_API bool brume_eval_function(const brume_scene *scene, int id,
                                   const double *arguments, int count,
                                   double out[BRUME_MAX_RESULTS],
                                   struct brume_error *err);

/* The turbulence of a point, as the language's vturbulence has it: octaves of
 * vector noise, 1 to 10 of them (others count as those), each lambda times as
 * fine and omega times as strong as the one before. */
BRUME_API void brume_turbulence(const double point[3], double octaves,
                                double lambda, double omega, double out[3]);

/* Pigments, patterns and densities are functions of a point too: of one
 * value, or of five, red, green, blue, filter, transmit. A pattern under a
 * transform, with its map, is written so:
 *
 *     f = brume_function_new(scene, 3, err);
 *     brume_function_parameter(f, 0, err);    and 1, 2: the point
 *     brume_function_inverse(f, transform, err);
 *     brume_function_copy(f, 3, err);
 *     brume_function_pattern(f, BRUME_PATTERN_BOZO, numbers, 1, err);
 *     brume_function_wave(f, BRUME_WAVE_RAMP, 1, 1, 0, err);
 *     brume_function_map(f, &map, err);
 *
 * What is written last in the scene comes first here: it is undone first. */

/* Their numbers, in this order; they are checked. Generator is 1, 2 or 3;
 * octaves, lambda, omega are those of turbulence. Where an amount of it is
 * among them no warp shall give it, but for the spirals, which have both.
 *   agate        generator, octaves, lambda, omega, agate_turb
 *   bozo dents granite wrinkles  generator; bumps and spotted are bozo
 *   brick        size x y z, mortar
 *   crackle      generator, form x y z, metric, offset, solid (0, 1)
 *   fractal      magnet (0: none), iterations, exponent, exterior type,
 *                factor, interior type, factor, julia (0: mandel), c re im
 *   gradient     direction x y z
 *   marble       generator, octaves, lambda, omega, amount x
 *   pavement     sides, tiles, pattern; its form, exterior and interior are 0
 *   quilted      control0, control1
 *   ripples waves  count of sources (1 to 100), frequency, phase
 *   spiral1 spiral2  generator, octaves, lambda, omega, amount x, arms
 *   tiling       which, 1 to 24
 *   wood         octaves, lambda, omega, amount x y
 *   the others none. Of brick, checker, cubic, hexagon, square, triangular the
 * value is the number of an item of a list, and goes through no wave. */
enum brume_pattern {
    BRUME_PATTERN_AGATE, BRUME_PATTERN_BOXED, BRUME_PATTERN_BOZO,
    BRUME_PATTERN_BRICK, BRUME_PATTERN_CELLS, BRUME_PATTERN_CHECKER,
    BRUME_PATTERN_CRACKLE, BRUME_PATTERN_CUBIC, BRUME_PATTERN_CYLINDRICAL,
    BRUME_PATTERN_DENTS, BRUME_PATTERN_FRACTAL, BRUME_PATTERN_GRADIENT,
    BRUME_PATTERN_GRANITE, BRUME_PATTERN_HEXAGON, BRUME_PATTERN_LEOPARD,
    BRUME_PATTERN_MARBLE, BRUME_PATTERN_ONION, BRUME_PATTERN_PAVEMENT,
    BRUME_PATTERN_PLANAR,
    BRUME_PATTERN_QUILTED, BRUME_PATTERN_RADIAL, BRUME_PATTERN_RIPPLES,
    BRUME_PATTERN_SPHERICAL, BRUME_PATTERN_SPIRAL1, BRUME_PATTERN_SPIRAL2,
    BRUME_PATTERN_SQUARE, BRUME_PATTERN_TILING, BRUME_PATTERN_TRIANGULAR,
    BRUME_PATTERN_WAVES, BRUME_PATTERN_WOOD, BRUME_PATTERN_WRINKLES
};

/* From the point in question to the point where a pattern is looked up.
 *   black_hole   centre x y z, radius, strength, falloff, inverse (0, 1),
 *                repeat x y z (0: not along it), turbulence x y z, turbulent
 *                (0, 1)
 *   cubic        none
 *   cylindrical spherical  orientation x y z (unit), dist_exp
 *   planar       orientation x y z (unit), distance along it
 *   repeat       axis (0, 1, 2), width, offset x y z, flip x y z
 *   toroidal     orientation x y z (unit), dist_exp, major radius
 *   turbulence   octaves, lambda, omega, amount x y z */
enum brume_warp {
    BRUME_WARP_BLACK_HOLE, BRUME_WARP_CUBIC, BRUME_WARP_CYLINDRICAL,
    BRUME_WARP_PLANAR, BRUME_WARP_REPEAT, BRUME_WARP_SPHERICAL,
    BRUME_WARP_TOROIDAL, BRUME_WARP_TURBULENCE
};

enum brume_wave {
    BRUME_WAVE_RAMP, BRUME_WAVE_TRIANGLE, BRUME_WAVE_SINE, BRUME_WAVE_SCALLOP,
    BRUME_WAVE_CUBIC, BRUME_WAVE_POLY
};

/* Takes a point and leaves A^-1 (p - b): where it was before a transform. */
BRUME_API bool brume_function_inverse(struct brume_function *function,
                                      const double transform[3][4],
                                      struct brume_error *err);
/* Takes a point and leaves a point. `count` must be that of the kind. */
BRUME_API bool brume_function_warp(struct brume_function *function,
                                   enum brume_warp kind, const double *numbers,
                                   int count, struct brume_error *err);
/* Takes a point and leaves a value. */
BRUME_API bool brume_function_pattern(struct brume_function *function,
                                      enum brume_pattern kind,
                                      const double *numbers, int count,
                                      struct brume_error *err);
/* Takes a point and leaves the value of a grid there, where its own transform
 * has it: the pattern of a density file. */
BRUME_API bool brume_function_grid(struct brume_function *function, int grid,
                                   struct brume_error *err);
/* A picture: `channels` numbers a texel, row 0 on top, finite: grey; grey and
 * transmit; red, green, blue; the same and transmit; or filter before it. */
struct brume_image {
    int width, height, channels;
    const float *texel;
};
#define BRUME_MAX_TEXELS ((size_t)1 << 28)
/* Copies it. Fails with BRUME_ERR_LIMIT if the scene's have more texels. */
BRUME_API int brume_add_image(brume_scene *scene,
                              const struct brume_image *image,
                              struct brume_error *err);

enum brume_image_map {
    BRUME_IMAGE_PLANAR = 0,     /* x and y from 0 to 1                     */
    BRUME_IMAGE_SPHERICAL = 1,  /* about y, from +x to +z                  */
    BRUME_IMAGE_CYLINDRICAL = 2,    /* the same; y from 0 to 1             */
    BRUME_IMAGE_TOROIDAL = 5    /* about a ring of radius 1 about y        */
};
enum brume_image_interpolate {
    BRUME_IMAGE_NEAREST = 0, BRUME_IMAGE_BILINEAR = 2, BRUME_IMAGE_BICUBIC = 3,
    BRUME_IMAGE_DISTANCE = 4    /* of four, by the squared distance        */
};
/* How a picture is laid over space, and what is added to its filter and
 * transmit. Where it is not, with `once`, it is clear: 1, 1, 1, 0, 1. */
struct brume_image_use {
    int image;
    enum brume_image_map map;
    bool once;
    enum brume_image_interpolate interpolate;
    double filter, transmit;
};
/* Takes a point and leaves red, green, blue, filter, transmit. */
BRUME_API bool brume_function_image(struct brume_function *function,
                                    const struct brume_image_use *use,
                                    struct brume_error *err);
/* Takes a value and leaves its place in a map, from 0 to 1; the exponent is
 * that of poly_wave. */
BRUME_API bool brume_function_wave(struct brume_function *function,
                                   enum brume_wave type, double exponent,
                                   double frequency, double phase,
                                   struct brume_error *err);

enum { BRUME_MAX_ENTRIES = 4096 };

/* What a value chooses from: numbers, or functions of the point. */
struct brume_map {
    int count, terms;           /* entries; numbers that each gives        */
    const double *places;       /* of the entries, from 0 to 1, ascending;
                                   NULL: a value is an entry's number      */
    const double *values;       /* count times terms, if                   */
    const int *functions;       /* ... this is NULL                        */
};
/* Takes a point and a value and leaves the terms: of the two entries beside
 * the value, blended, or of the entry of that number, the first or last if
 * there is none. */
BRUME_API bool brume_function_map(struct brume_function *function,
                                  const struct brume_map *map,
                                  struct brume_error *err);
/* Takes a point and leaves the mean of a map's functions there; their places
 * are weights. */
BRUME_API bool brume_function_average(struct brume_function *function,
                                      const struct brume_map *map,
                                      struct brume_error *err);

enum brume_spline_kind {
    BRUME_SPLINE_LINEAR, BRUME_SPLINE_QUADRATIC, BRUME_SPLINE_CUBIC,
    BRUME_SPLINE_NATURAL
};

/* Points in any order, each with a parameter; where two have the same, the
 * later replaces the earlier, unless it is the greatest so far. */
struct brume_spline {
    enum brume_spline_kind kind;
    int terms;                  /* numbers in a point, 1 to 5              */
    int count;                  /* of points, 1 at least                   */
    const double *parameters;   /* count                                   */
    const double *values;       /* count times terms                       */
};
BRUME_API int brume_add_spline(brume_scene *scene,
                               const struct brume_spline *spline,
                               struct brume_error *err);
/* The spline's terms at t, as if it were of that kind; -1: of its own. Beyond
 * the first and the last point it is what it is there; a cubic one has no
 * curve before the second point and after the last but one. */
BRUME_API bool brume_eval_spline(const brume_scene *scene, int id, int kind,
                                 double t, double out[BRUME_MAX_RESULTS],
                                 struct brume_error *err);
/* Takes t and leaves the spline's terms. */
BRUME_API bool brume_function_spline(struct brume_function *function, int id,
                                     int kind, struct brume_error *err);
#endif
