/* Operations of functions on points: warps, patterns, maps. Their numbers are
 * checked here, so that patterns need not look at them. */
#define PHYSICS_DOUBLE
#include <math.h>
#include <stdlib.h>
#include "core/function.h"
#include "lib/memory.h"

#define SAME(a, b) _Static_assert((int)(a) == (int)(b), "brume.h's order")
#define X(function, name, numbers) SAME(BRUME_PATTERN_##name, PATTERN_##name);
PATTERN_KINDS(X)
#undef X
#define X(function, name, numbers) SAME(BRUME_WARP_##name, WARP_##name);
WARP_KINDS(X)
#undef X
#define X(name) SAME(BRUME_WAVE_##name, WAVE_##name);
WAVE_TYPES(X)
#undef X

enum { SOURCE_LIMIT = 100, ITERATION_LIMIT = 1 << 20, EXPONENT_LIMIT = 64 };

/* ---- checks ------------------------------------------------------------ */

static bool in_range(double v, double low, double high)
{
    return v >= low && v <= high;
}

/* Numbers that patterns take as integers, some as indices. */
static bool plain_numbers(const double *v, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabs(v[i]) < 1e9))
            return false;
    return true;
}

static bool is_waves(int kind)
{
    return kind == PATTERN_RIPPLES || kind == PATTERN_WAVES;
}

size_t pattern_size(int kind, const double *numbers, size_t room)
{
    size_t size = kind >= 0 && kind < PATTERN_COUNT
                      ? (size_t)pattern_numbers(kind)
                      : room + 1;
    if (size > room || !plain_numbers(numbers, size))
        return 0;
    if (kind == PATTERN_FRACTAL && !(in_range(numbers[1], 0, ITERATION_LIMIT) &&
                                     in_range(numbers[2], 1, EXPONENT_LIMIT)))
        return 0;
    if (kind == PATTERN_TILING && !in_range(numbers[0], 1, TILING_COUNT))
        return 0;
    if (kind == PATTERN_PAVEMENT && pavement_of(numbers).index < 0)
        return 0;
    if (is_waves(kind)) {
        if (!in_range(numbers[0], 1, SOURCE_LIMIT))
            return 0;
        size += 4 * (size_t)numbers[0];
    }
    return size > room ? 0 : size ? size : 1;
}

size_t warp_size(int kind, const double *numbers, size_t room)
{
    size_t size = kind >= 0 && kind < WARP_COUNT
                      ? (size_t)pattern_warp_numbers(kind)
                      : room + 1;
    if (size > room || !plain_numbers(numbers, size))
        return 0;
    if (kind == WARP_REPEAT &&
        !(numbers[0] == 0 || numbers[0] == 1 || numbers[0] == 2))
        return 0;
    return size ? size : 1;
}

/* ---- warps and patterns ------------------------------------------------ */

bool brume_function_inverse(struct brume_function *function,
                            const double transform[3][4],
                            struct brume_error *err)
{
    matrix a = matrix_from(transform), inverse;
    if (!matrix_finite(&a) || !matrix_invert(&a, &inverse))
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "the transform of a pattern has no inverse");
    return brume_function_transform(function, (const double(*)[4])inverse.m,
                                    err);
}

bool brume_function_warp(struct brume_function *function, enum brume_warp kind,
                         const double *numbers, int count,
                         struct brume_error *err)
{
    int32_t first = 0;
    if ((unsigned)kind >= WARP_COUNT || count != pattern_warp_numbers(kind) ||
        warp_size(kind, numbers, (size_t)count + 1) == 0)
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "the numbers of a warp are not possible");
    return function_numbers(function, numbers, (size_t)count, &first, err) &&
           function_wide(function, MACHINE_WARP, 3, 3, first, 0, kind, err);
}

/* The numbers given, and for ripples and waves where they come from. */
static bool write_pattern(struct brume_function *f, int kind,
                          const double *numbers, int count, int32_t *first,
                          struct brume_error *err)
{
    double sources[4 * SOURCE_LIMIT] = {0};
    int32_t second;
    if (!function_numbers(f, numbers, (size_t)count, first, err))
        return false;
    if (!is_waves(kind))
        return true;
    pattern_wave_sources((int)numbers[0], sources);
    return function_numbers(f, sources, 4 * (size_t)numbers[0], &second, err);
}

bool brume_function_pattern(struct brume_function *function,
                            enum brume_pattern kind, const double *numbers,
                            int count, struct brume_error *err)
{
    int32_t first = 0;
    size_t room = (size_t)count + 4 * SOURCE_LIMIT;
    if ((unsigned)kind >= PATTERN_COUNT || count != pattern_numbers(kind) ||
        pattern_size(kind, numbers, room) == 0)
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "the numbers of a pattern are not possible");
    return write_pattern(function, kind, numbers, count, &first, err) &&
           function_wide(function, MACHINE_PATTERN, 3, 1, first, 0, kind, err);
}

bool brume_function_wave(struct brume_function *function, enum brume_wave type,
                         double exponent, double frequency, double phase,
                         struct brume_error *err)
{
    const double numbers[4] = {(double)type, exponent, frequency, phase};
    int32_t first = 0;
    if ((unsigned)type >= WAVE_COUNT || !plain_numbers(numbers, 4))
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "the numbers of a wave are not possible");
    return function_numbers(function, numbers, 4, &first, err) &&
           function_wide(function, MACHINE_WAVE, 1, 1, first,
                         function_top(function, 1), 0, err);
}

/* ---- maps -------------------------------------------------------------- */

static bool check_map(struct brume_function *f, const struct brume_map *map,
                      struct brume_error *err)
{
    if (map->count < 1 || map->count > BRUME_MAX_ENTRIES)
        return function_fail(f, err, BRUME_ERR_LIMIT,
                             "a map has 1 to 4096 entries");
    if (map->terms < 1 || map->terms > BRUME_MAX_RESULTS)
        return function_fail(f, err, BRUME_ERR_SCENE,
                             "an entry of a map is 1 to 5 numbers");
    for (int i = 0; map->functions && i < map->count; i++) {
        int parameters, results;
        if (!brume_function_arity(function_scene(f), map->functions[i],
                                  &parameters, &results) ||
            parameters != 3 || results != map->terms)
            return function_fail(f, err, BRUME_ERR_SCENE,
                                 "an entry of a map is no function of a point "
                                 "with as many results as the others");
    }
    return true;
}

/* The map as blend.h reads it. */
static bool write_map(struct brume_function *f, const struct brume_map *map,
                      int32_t *first, struct brume_error *err)
{
    size_t terms = map->functions ? 0 : (size_t)map->terms;
    size_t count = (size_t)map->count;
    double *out = memory_new(BLEND_HEAD + count * (1 + terms), sizeof *out,
                             err),
           *next = out;
    if (!out)
        return false;
    *next++ = map->count;
    *next++ = (double)terms;
    for (size_t i = 0; i < count; i++)
        *next++ = map->places ? map->places[i] : 0.0;
    for (size_t i = 0; i < count * terms; i++)
        *next++ = map->values[i];
    bool done = function_numbers(f, out, (size_t)(next - out), first, err);
    free(out);
    return done;
}

static bool write_table(struct brume_function *f, const struct brume_map *map,
                        int32_t *first, struct brume_error *err)
{
    size_t count = (size_t)map->count;
    double *out = memory_new(1 + count, sizeof *out, err);
    if (!out)
        return false;
    out[0] = map->count;
    for (size_t i = 0; i < count; i++)
        out[1 + i] = map->functions[i];
    bool done = function_numbers(f, out, 1 + count, first, err);
    free(out);
    return done;
}

/* A call of any of a map's functions, with its frame at register dst. */
static bool call_entry(struct brume_function *f, const struct brume_map *map,
                       int dst, int32_t table, int32_t index, int32_t offset,
                       struct brume_error *err)
{
    for (int i = 0; i < map->count; i++)
        if (!function_calls(f, map->functions[i], dst, err))
            return false;
    return function_emit(f, MACHINE_CALL_ENTRY, dst, table, index, offset, err);
}

/* Entry number `value`, or the blend of two: point and value stand at their
 * homes, from register `at` on, where the results go. Beside them are the
 * part of the second entry and room for the results of both. */
static bool map_functions(struct brume_function *f, const struct brume_map *map,
                          int at, struct brume_error *err)
{
    int value = at + 3, part = at + 4, a = at + 5, b = a + map->terms;
    int32_t table = 0, places = 0;
    if (!write_table(f, map, &table, err))
        return false;
    if (!map->places)
        return call_entry(f, map, at, table, value, 0, err);
    if (!write_map(f, map, &places, err) ||
        !function_emit(f, MACHINE_FIND, value, places, value, 0, err) ||
        !function_emit(f, MACHINE_COPY, a, at, 0, 3, err) ||
        !call_entry(f, map, a, table, value, 0, err) ||
        !function_emit(f, MACHINE_NEGATE, b, part, 0, 0, err) ||
        !function_emit(f, MACHINE_JUMP_NOT_NEGATIVE, 0, 3, b, 0, err) ||
        !function_emit(f, MACHINE_COPY, b, at, 0, 3, err) ||
        !call_entry(f, map, b, table, value, 1, err) ||
        !function_emit(f, MACHINE_MIX, a, a, part, map->terms, err))
        return false;
    return function_emit(f, MACHINE_COPY, at, a, 0, map->terms, err);
}

static bool map_values(struct brume_function *f, const struct brume_map *map,
                       int at, struct brume_error *err)
{
    int32_t first = 0;
    return write_map(f, map, &first, err) &&
           function_emit(f, map->places ? MACHINE_BLEND : MACHINE_CHOOSE, at,
                         first, at + 3, 0, err);
}

bool brume_function_map(struct brume_function *function,
                        const struct brume_map *map, struct brume_error *err)
{
    struct brume_function *f = function;
    int at, needs = map->functions ? 4 : 1;
    if (!check_map(f, map, err) || !function_take(f, 4, needs, &at, err))
        return false;
    bool done = map->functions ? map_functions(f, map, at, err)
                               : map_values(f, map, at, err);
    return function_give(f, done, map->terms, err);
}

/* The mean by weights: sums at `sum`, each entry's results beside them. */
bool brume_function_average(struct brume_function *function,
                            const struct brume_map *map,
                            struct brume_error *err)
{
    struct brume_function *f = function;
    double total = 0.0;
    int at;
    if (!check_map(f, map, err))
        return false;
    if (!map->functions || !map->places)
        return function_fail(f, err, BRUME_ERR_SCENE,
                             "an average is of functions with weights");
    if (!function_take(f, 3, 3, &at, err))
        return false;
    bool done = true;
    int sum = at + 3, each = sum + map->terms;
    for (int i = 0; i < map->count; i++)
        total += map->places[i];
    for (int i = 0; done && i < map->count; i++) {
        double weight = map->places[i] / total;
        int32_t first = 0;
        done = function_numbers(f, &weight, 1, &first, err) &&
               function_emit(f, MACHINE_COPY, each, at, 0, 3, err) &&
               function_calls(f, map->functions[i], each, err) &&
               function_emit(f, MACHINE_CALL, each, map->functions[i], 0, 0,
                             err);
        for (int k = 0; done && k < map->terms; k++)
            done = function_emit(f, MACHINE_MULTIPLY, each + k, each + k,
                                 ~first, 0, err) &&
                   (i == 0 ? function_emit(f, MACHINE_MOVE, sum + k, each + k,
                                           0, 0, err)
                           : function_emit(f, MACHINE_ADD, sum + k, sum + k,
                                           each + k, 0, err));
    }
    done = done && function_emit(f, MACHINE_COPY, at, sum, 0, map->terms, err);
    return function_give(f, done, map->terms, err);
}

void brume_turbulence(const double point[3], double octaves, double lambda,
                      double omega, double out[3])
{
    const double series[3] = {octaves, lambda, omega};
    dvec3 t = noise_vector_turbulence(real3_make(point[0], point[1], point[2]),
                                      noise_series_of(series));

    out[0] = t.x;
    out[1] = t.y;
    out[2] = t.z;
}
