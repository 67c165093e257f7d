/* test_pigment.c - pigments and patterns written as functions, against the
 * values that POV-Ray 3.7 prints for the same (it computes colours in single
 * precision), in float too, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include <math.h>
#include "core/physics/machine.h"
#include "core/scene.h"

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

static struct brume_function *begin(brume_scene *s)
{
    struct brume_function *f = brume_function_new(s, 3, NULL);
    for (int i = 0; i < 3; i++)
        assert_true(brume_function_parameter(f, i, NULL));
    return f;
}

static void float_agrees(const brume_scene *s, int id, const double *p,
                         const double *out)
{
    float *pool = malloc((s->pool_count + 1) * sizeof *pool);
    float r[MACHINE_REGISTERS];
    for (size_t i = 0; i < s->pool_count; i++)
        pool[i] = (float)s->pool[i];
    machine m = {.code = s->code,
                 .functions = s->functions,
                 .pool = pool,
                 .grids = NULL};
    for (int i = 0; i < 3; i++)
        r[i] = (float)p[i];
    assert_true(machine_run(&m, id, r));
    for (int i = 0; i < s->functions[id].results; i++)
        if (!(fabs(r[i] - out[i]) <= 2e-5 * (1 + fabs(out[i]))))
            fail_msg("in float %g, not %g", r[i], out[i]);
    free(pool);
}

static void expect(brume_scene *s, int id, double x, double y, double z,
                   int terms, const double *truth)
{
    double p[3] = {x, y, z}, out[BRUME_MAX_RESULTS];
    struct brume_error err = {0};
    if (!brume_eval_function(s, id, p, 3, out, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < terms; i++)
        if (!(fabs(out[i] - truth[i]) <= 3e-7 * (1 + fabs(truth[i]))))
            fail_msg("at <%g, %g, %g>: %.9g, not %.9g", x, y, z, out[i],
                     truth[i]);
    float_agrees(s, id, p, out);
}

static void expect_gray(brume_scene *s, int id, double x, double y, double z,
                        double truth)
{
    const double gray[3] = {truth, truth, truth};
    expect(s, id, x, y, z, 3, gray);
}

static void gradient(struct brume_function *f, double x, double y, double z)
{
    const double direction[3] = {x, y, z};
    assert_true(
        brume_function_pattern(f, BRUME_PATTERN_GRADIENT, direction, 3, NULL));
    assert_true(brume_function_wave(f, BRUME_WAVE_RAMP, 1, 1, 0, NULL));
}

/* Entries of gray. */
static void gray_map(struct brume_function *f, int count, const double *places,
                     const double *grays)
{
    double values[5 * 8] = {0};
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            values[5 * i + k] = grays[i];
    struct brume_map map = {count, 5, places, values, NULL};
    assert_true(brume_function_map(f, &map, NULL));
}

/* gradient x with a colour map of grays */
static int add_gradient(brume_scene *s, int count, const double *places,
                        const double *grays)
{
    struct brume_function *f = begin(s);
    assert_true(brume_function_copy(f, 3, NULL));
    gradient(f, 1, 0, 0);
    gray_map(f, count, places, grays);
    return brume_add_function(s, f, NULL);
}

static void test_color_map(void **state)
{
    const double places[] = {0, .5, .5, 1}, grays[] = {1, 2, 3, 4};
    int id = add_gradient(*state, 4, places, grays);
    expect_gray(*state, id, 0, 0, 0, 1);
    expect_gray(*state, id, .25, 0, 0, 1.5);
    expect_gray(*state, id, .499999, 0, 0, 1.999997973);
    expect_gray(*state, id, .5, 0, 0, 2);
    expect_gray(*state, id, .5001, 0, 0, 3.0002);
    expect_gray(*state, id, .75, 0, 0, 3.5);
    expect_gray(*state, id, 1, 0, 0, 4);
    expect_gray(*state, id, -.25, 0, 0, 3.5);

    const double inner[] = {.2, .5, .8};
    id = add_gradient(*state, 3, inner, grays);
    expect_gray(*state, id, .1, 0, 0, 1);
    expect_gray(*state, id, .5, 0, 0, 2);
    expect_gray(*state, id, .9, 0, 0, 3);

    const double unsorted[] = {.5, .2, .8};
    id = add_gradient(*state, 3, unsorted, grays);
    expect_gray(*state, id, .1, 0, 0, 1);
    expect_gray(*state, id, .3, 0, 0, 1);
    expect_gray(*state, id, .6, 0, 0, 2.666666508);
    expect_gray(*state, id, .9, 0, 0, 3);
}

/* pigment { gradient x pigment_map { [0 gradient y] [1 gradient z scale 2] }
 * scale 2 } */
static void test_pigment_map(void **state)
{
    const double twice[3][4] = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}};
    const double ends[2] = {0, 1}, grays[2] = {0, 1};
    int entries[2];
    for (int i = 0; i < 2; i++) {
        struct brume_function *f = begin(*state);
        if (i == 1)
            assert_true(brume_function_inverse(f, twice, NULL));
        assert_true(brume_function_copy(f, 3, NULL));
        gradient(f, 0, i == 0, i == 1);
        gray_map(f, 2, ends, grays);
        entries[i] = brume_add_function(*state, f, NULL);
        assert_true(entries[i] >= 0);
    }
    struct brume_function *f = begin(*state);
    struct brume_map map = {2, 5, ends, NULL, entries};
    brume_function_inverse(f, twice, NULL);
    brume_function_copy(f, 3, NULL);
    gradient(f, 1, 0, 0);
    assert_true(brume_function_map(f, &map, NULL));
    int id = brume_add_function(*state, f, NULL);
    expect_gray(*state, id, .5, .3, .4, .1375);
    expect_gray(*state, id, 0, .3, .4, .15);
    expect_gray(*state, id, 2 - 1e-9, .3, .4, .1);
}

static int add_solid(brume_scene *s, double gray, double transmit)
{
    struct brume_function *f = brume_function_new(s, 3, NULL);
    for (int i = 0; i < 3; i++)
        brume_function_constant(f, gray, NULL);
    brume_function_constant(f, 0, NULL);
    brume_function_constant(f, transmit, NULL);
    return brume_add_function(s, f, NULL);
}

/* average pigment_map { [1 rgb 1] [3 rgbt <2, 2, 2, 1>] } */
static void test_average(void **state)
{
    const double weights[2] = {1, 3};
    const double truth[5] = {1.75, 1.75, 1.75, 0, .75};
    int entries[2] = {add_solid(*state, 1, 0), add_solid(*state, 2, 1)};
    struct brume_map map = {2, 5, weights, NULL, entries};
    struct brume_function *f = begin(*state);
    assert_true(brume_function_average(f, &map, NULL));
    int id = brume_add_function(*state, f, NULL);
    expect(*state, id, .5, .3, .4, 5, truth);
}

/* hexagon rgb 1 rgb 2 rgb 3 scale 2, of colours and of pigments */
static void test_list(void **state)
{
    const double twice[3][4] = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}};
    const double grays[3] = {1, 2, 3};
    int entries[3];
    for (int i = 0; i < 3; i++)
        entries[i] = add_solid(*state, grays[i], 0);
    struct brume_map map = {3, 5, NULL, NULL, entries};
    for (int k = 0; k < 2; k++) {
        struct brume_function *f = begin(*state);
        brume_function_inverse(f, twice, NULL);
        brume_function_copy(f, 3, NULL);
        brume_function_pattern(f, BRUME_PATTERN_HEXAGON, NULL, 0, NULL);
        if (k == 0)
            gray_map(f, 3, NULL, grays);
        else
            assert_true(brume_function_map(f, &map, NULL));
        int id = brume_add_function(*state, f, NULL);
        expect_gray(*state, id, .5, .3, .4, 1);
        expect_gray(*state, id, 3.5, .3, .4, 3);
        expect_gray(*state, id, -3.5, .3, .4, 3);
    }
}

/* gradient x color_map { [0 rgbf <1, 1, 1, .5>] [1 rgbt <0, 0, 0, .25>] }
 * turbulence <.3, .2, .1> octaves 3 scale <1, 2, 3> rotate y*30
 * warp { turbulence .2 } translate z: a pattern's own turbulence is next to
 * it, wherever it is written. */
static void test_warps(void **state)
{
    const double c = cos(M_PI / 6), s = sin(M_PI / 6);
    const double move[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}};
    const double turn[3][4] = {
        {c, 0, 3 * s, 0}, {0, 2, 0, 0}, {-s, 0, 3 * c, 0}};
    const double warp[6] = {6, 2, .5, .2, .2, .2};
    const double own[6] = {3, 2, .5, .3, .2, .1};
    const double ends[2] = {0, 1};
    const double colors[10] = {1, 1, 1, .5, 0, 0, 0, 0, 0, .25};
    const double truth[5] = {0.526630998, 0.526630998, 0.526630998, 0.263315499,
                             0.118342243};
    struct brume_map map = {2, 5, ends, colors, NULL};
    struct brume_function *f = begin(*state);
    assert_true(brume_function_inverse(f, move, NULL));
    assert_true(brume_function_warp(f, BRUME_WARP_TURBULENCE, warp, 6, NULL));
    assert_true(brume_function_inverse(f, turn, NULL));
    assert_true(brume_function_warp(f, BRUME_WARP_TURBULENCE, own, 6, NULL));
    brume_function_copy(f, 3, NULL);
    gradient(f, 1, 0, 0);
    assert_true(brume_function_map(f, &map, NULL));
    expect(*state, brume_add_function(*state, f, NULL), .5, .3, .4, 5, truth);
}

/* pattern { gradient x triangle_wave frequency 3 phase .1 turbulence .2
 * scale 2 }, and a function, x/2 + 1/10, in its place, turbulence .1 and
 * sine_wave */
static void test_pattern(void **state)
{
    const double twice[3][4] = {{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}};
    const double direction[3] = {1, 0, 0};
    double turbulence[6] = {6, 2, .5, .2, .2, .2};
    struct brume_function *f = begin(*state);
    brume_function_inverse(f, twice, NULL);
    brume_function_warp(f, BRUME_WARP_TURBULENCE, turbulence, 6, NULL);
    brume_function_pattern(f, BRUME_PATTERN_GRADIENT, direction, 3, NULL);
    brume_function_wave(f, BRUME_WAVE_TRIANGLE, 1, 3, .1, NULL);
    int id = brume_add_function(*state, f, NULL);
    double truth[3] = {.673395107, .387152468, .537112905};
    expect(*state, id, .5, .3, .4, 1, &truth[0]);
    expect(*state, id, 1.5, .3, .4, 1, &truth[1]);
    expect(*state, id, -1.5, .3, .4, 1, &truth[2]);

    f = begin(*state);
    brume_function_pick(f, 3, 0, NULL);
    brume_function_constant(f, .5, NULL);
    brume_function_op(f, BRUME_OP_MULTIPLY, NULL);
    brume_function_constant(f, .1, NULL);
    brume_function_op(f, BRUME_OP_ADD, NULL);
    int inner = brume_add_function(*state, f, NULL);
    for (int i = 3; i < 6; i++)
        turbulence[i] = .1;
    f = begin(*state);
    brume_function_warp(f, BRUME_WARP_TURBULENCE, turbulence, 6, NULL);
    brume_function_call(f, inner, 3, NULL);
    brume_function_wave(f, BRUME_WAVE_SINE, 1, 1, 0, NULL);
    id = brume_add_function(*state, f, NULL);
    const double sines[3] = {.923703333, .094843761, .929123041};
    expect(*state, id, .5, .3, .4, 1, &sines[0]);
    expect(*state, id, 1.5, .3, .4, 1, &sines[1]);
    expect(*state, id, -1.5, .3, .4, 1, &sines[2]);
}

static void refuses(brume_scene *scene, enum brume_pattern kind,
                    const double *numbers, int count)
{
    struct brume_function *f = begin(scene);
    assert_false(brume_function_pattern(f, kind, numbers, count, NULL));
    brume_function_free(f);
}

static void test_tiles_that_are_not(void **state)
{
    const double tilings[] = {0, 25};
    const double pavements[][3] = {{5, 1, 1}, {4, 7, 1},  {4, 2, 2},
                                   {6, 6, 1}, {3, 6, 13}, {4, 1, 0}};
    for (int i = 0; i < 2; i++)
        refuses(*state, BRUME_PATTERN_TILING, &tilings[i], 1);
    for (int i = 0; i < 6; i++)
        refuses(*state, BRUME_PATTERN_PAVEMENT, pavements[i], 3);
}

/* Every pattern and warp that there is, with common numbers: as its own
 * function gives it, and never a fault where the point is none. */
static const double some[14] = {2, 6, 2, .5, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};

static void test_every_kind(void **state)
{
    const double odd[] = {0, 1e300, -INFINITY, NAN, 1e9, -.5};
    const double squares[4] = {4, 6, 35, 0};
    for (int kind = 0; kind < PATTERN_COUNT; kind++) {
        const double *numbers = kind == PATTERN_PAVEMENT ? squares : some;
        int count = pattern_numbers(kind);
        struct brume_function *f = begin(*state);
        assert_true(brume_function_pattern(f, (enum brume_pattern)kind, numbers,
                                           count, NULL));
        brume_function_wave(f, BRUME_WAVE_RAMP, 1, 1, 0, NULL);
        int id = brume_add_function(*state, f, NULL);
        assert_true(id >= 0);
        for (int i = 0; i < 216; i++) {
            double p[3] = {odd[i % 6], odd[i / 6 % 6], odd[i / 36]};
            double out[BRUME_MAX_RESULTS];
            assert_true(brume_eval_function(*state, id, p, 3, out, NULL));
            assert_true(isfinite(out[0]));
        }
        f = begin(*state);
        assert_false(brume_function_pattern(f, (enum brume_pattern)kind,
                                            numbers, count + 1, NULL));
        brume_function_free(f);
    }
    for (int kind = 0; kind < WARP_COUNT; kind++) {
        struct brume_function *f = begin(*state);
        assert_true(brume_function_warp(f, (enum brume_warp)kind, some,
                                        pattern_warp_numbers(kind), NULL));
        assert_true(brume_add_function(*state, f, NULL) >= 0);
    }
}

static void test_refused(void **state)
{
    const double flat[3][4] = {{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}};
    const double axis[8] = {3, 1, 0, 0, 0, 0, 0, 0};
    const double endless[10] = {0, 1e8, 2, 1, 1, 0, 1, 0, 0, 0};
    const double many[3] = {101, 1, 0}, odd[3] = {NAN, 0, 0};
    const double huge[3] = {1e12, 0, 0};
    const int entry[1] = {999};
    const double at[1] = {0};
    const struct brume_map bad_function = {1, 5, at, NULL, entry};
    const struct brume_map empty = {0, 5, at, at, NULL};
    const struct brume_map wide = {1, 6, at, at, NULL};
    for (int k = 0; k < 12; k++) {
        struct brume_function *f = begin(*state);
        bool done = false;
        switch (k) {
        case 0:
            done = brume_function_inverse(f, flat, NULL);
            break;
        case 1:
            done = brume_function_warp(f, BRUME_WARP_REPEAT, axis, 8, NULL);
            break;
        case 2:
            done = brume_function_pattern(f, BRUME_PATTERN_FRACTAL, endless, 10,
                                          NULL);
            break;
        case 3:
            done = brume_function_pattern(f, BRUME_PATTERN_RIPPLES, many, 3,
                                          NULL);
            break;
        case 4:
            done = brume_function_pattern(f, BRUME_PATTERN_GRADIENT, odd, 3,
                                          NULL);
            break;
        case 5:
            done = brume_function_pattern(f, BRUME_PATTERN_GRADIENT, huge, 3,
                                          NULL);
            break;
        case 6:
            done = brume_function_pattern(f, (enum brume_pattern)99, huge, 0,
                                          NULL);
            break;
        case 7:
            done = brume_function_wave(f, (enum brume_wave)9, 1, 1, 0, NULL);
            break;
        case 8:
            done = brume_function_map(f, &empty, NULL);
            break;
        case 9:
            done = brume_function_map(f, &wide, NULL);
            break;
        case 10:
            brume_function_constant(f, 0, NULL);
            done = brume_function_map(f, &bad_function, NULL);
            break;
        default:
            done = brume_function_average(f, &bad_function, NULL);
        }
        if (done)
            fail_msg("case %d", k);
        assert_int_equal(brume_add_function(*state, f, NULL), -1);
    }
}

/* ---- any calls at all -------------------------------------------------- */

static unsigned pick(uint64_t *seed, unsigned n)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*seed >> 33) % n;
}

/* One call with arguments of which many are wrong. */
static void any_call(brume_scene *s, struct brume_function *f, uint64_t *seed)
{
    static const double wild[] = {0,   1,        2, 3, .5, -1, 1e300,
                                  NAN, INFINITY, 7, 0, 1,  0,  1};
    const double *numbers = wild + pick(seed, 3);
    int functions[3] = {(int)pick(seed, 20), (int)pick(seed, 20) - 1, 0};
    struct brume_map map = {1 + (int)pick(seed, 3), 1 + (int)pick(seed, 6),
                            pick(seed, 2) ? wild : NULL, wild,
                            pick(seed, 2) ? functions : NULL};
    map.terms = map.terms * map.count > 12 ? 1 : map.terms;
    switch (pick(seed, 14)) {
    case 0:
        brume_function_constant(f, wild[pick(seed, 10)], NULL);
        break;
    case 1:
    case 2:
    case 3:
        brume_function_parameter(f, (int)pick(seed, 3), NULL);
        break;
    case 4:
        brume_function_op(f, (enum brume_op)pick(seed, 48), NULL);
        break;
    case 5:
        brume_function_call(f, (int)pick(seed, 20), (int)pick(seed, 4), NULL);
        break;
    case 6:
        brume_function_copy(f, (int)pick(seed, 6), NULL);
        break;
    case 7:
        brume_function_open(f, (enum brume_block)pick(seed, 4), NULL);
        break;
    case 8:
        brume_function_close(f, NULL);
        break;
    case 9:
        brume_function_warp(f, (enum brume_warp)pick(seed, 9), numbers,
                            (int)pick(seed, 12), NULL);
        break;
    case 10:
        brume_function_pattern(f, (enum brume_pattern)pick(seed, 40), numbers,
                               (int)pick(seed, 11), NULL);
        break;
    case 11:
        brume_function_map(f, &map, NULL);
        break;
    case 12:
        brume_function_average(f, &map, NULL);
        break;
    default:
        brume_function_spline(f, (int)pick(seed, 2), (int)pick(seed, 6) - 1,
                              NULL);
    }
    (void)s;
}

/* Whatever is called, nothing breaks; what is accepted can be evaluated. */
static void test_any_calls(void **state)
{
    const double t[2] = {0, 1}, values[4] = {1, 2, 3, 4}, p[3] = {1, -.5, 2};
    struct brume_spline spline = {BRUME_SPLINE_CUBIC, 2, 2, t, values};
    brume_scene *s = *state;
    uint64_t seed = 5;
    int accepted = 0;
    brume_add_spline(s, &spline, NULL);
    add_solid(s, 1, 0);
    for (int i = 0; i < 30000; i++) {
        struct brume_function *f = brume_function_new(s, 3, NULL);
        int calls = 1 + (int)pick(&seed, 9);
        for (int k = 0; k < calls; k++)
            any_call(s, f, &seed);
        int id = brume_add_function(s, f, NULL);
        double out[BRUME_MAX_RESULTS];
        if (id < 0)
            continue;
        accepted++;
        brume_eval_function(s, id, p, 3, out, NULL);
    }
    assert_true(accepted > 1000);
}

#define CASE(name)                                                             \
    {                                                                          \
        "pigment__" #name, test_##name, setup, teardown, NULL                  \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(color_map),  CASE(pigment_map),
        CASE(average),    CASE(list),
        CASE(warps),      CASE(pattern),
        CASE(every_kind), CASE(any_calls),
        CASE(refused),    CASE(tiles_that_are_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
