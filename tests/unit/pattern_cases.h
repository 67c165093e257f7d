/* pattern_cases.h - values that POV-Ray printed (tests/oracle/patterns.py)
 * against ours, in the precision that the including test chose. */
#ifndef TESTS_UNIT_PATTERN_CASES_H
#define TESTS_UNIT_PATTERN_CASES_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/pattern.h"
#include "core/physics/pattern_warp.h"

enum { CASE_NUMBERS = 3 + 4 * 10, CASE_POINTS = 64 };

/* As the file has it. */
struct pattern_case {
    char name[16];
    int kind;
    bool item;                  /* a block pattern's                       */
    real param[CASE_NUMBERS];
    real turbulence[6];         /* of the point; none if its octaves are 0 */
    int wave;
    real exponent, frequency, phase;
};

static double read_number(char **text)
{
    char *word = strtok_r(NULL, " \n", text);
    assert_non_null(word);
    return strtod(word, NULL);
}

static int kind_of(const char *name)
{
#define X(function, constant, numbers)                                         \
    if (strcmp(name, #function) == 0)                                          \
        return PATTERN_##constant;
    PATTERN_KINDS(X)
#undef X
    fail_msg("unknown pattern %s", name);
    return -1;
}

static int wave_of(const char *name)
{
#define X(constant)                                                            \
    if (strcmp(name, #constant) == 0)                                          \
        return WAVE_##constant;
    WAVE_TYPES(X)
#undef X
    fail_msg("unknown wave %s", name);
    return -1;
}

static struct pattern_case read_case(char *line)
{
    struct pattern_case c = {.exponent = 1, .frequency = 1};
    char *rest, *word = strtok_r(line, " \n", &rest);
    snprintf(c.name, sizeof c.name, "%s", word);
    c.kind = kind_of(word);
    for (int i = 0; i < pattern_numbers(c.kind); i++)
        c.param[i] = (real)read_number(&rest);
    if (c.kind == PATTERN_RIPPLES || c.kind == PATTERN_WAVES)
        pattern_wave_sources((int)c.param[0], c.param + 3);
    while ((word = strtok_r(NULL, " \n", &rest))) {
        if (strcmp(word, "turbulence") == 0) {
            for (int i = 0; i < 6; i++)
                c.turbulence[i] = (real)read_number(&rest);
        } else if (strcmp(word, "item") == 0) {
            c.item = true;
        } else {
            assert_string_equal(word, "wave");
            c.wave = wave_of(strtok_r(NULL, " \n", &rest));
            c.exponent = (real)read_number(&rest);
            c.frequency = (real)read_number(&rest);
            c.phase = (real)read_number(&rest);
        }
    }
    return c;
}

static double case_value(const struct pattern_case *c, real3 p)
{
    if (c->turbulence[0] > 0)
        p = pattern_warp_turbulence(p, c->turbulence);
    real v = pattern_value(c->kind, p, c->param);
    if (c->item)
        return (double)v;
    return (double)wave_value(c->wave, c->exponent, c->frequency, c->phase, v);
}

static double size_of(const double *p)
{
    return fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
}

/* Pictures of these are what was measured, in single precision. */
static bool is_tiled(int kind)
{
    return kind == PATTERN_TILING || kind == PATTERN_PAVEMENT;
}

/* Where a case is looked up: of fractals not further out than 1. */
static real3 case_point(const struct pattern_case *c, const double *p)
{
    double scale = 1;
    if (c->kind == PATTERN_FRACTAL && size_of(p) > 1)
        scale = size_of(p);
    return real3_make((real)(p[0] / scale), (real)(p[1] / scale),
                      (real)(p[2] / scale));
}

/* All cases at the points of at most this size. A value that may jump where
 * the tolerance does not reach (from 1 to 0) counts as its neighbour. Fractals
 * are chaotic: of each case so many points may be off. */
static void check_cases(double size, double tolerance, int fractals_off)
{
    static char line[65536];
    double p[CASE_POINTS][3];
    int count, cases = 0, failed = 0;
    FILE *file = fopen("tests/data/patterns.txt", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%d\n", &count), 1);
    for (int i = 0; i < count; i++)
        assert_int_equal(
            fscanf(file, "%lf %lf %lf\n", &p[i][0], &p[i][1], &p[i][2]), 3);
    for (; fgets(line, sizeof line, file); cases++) {
        struct pattern_case c = read_case(line);
        int bad = 0;
        char *rest;
        assert_non_null(fgets(line, sizeof line, file));
        char *word = strtok_r(line, " \n", &rest);
        for (int i = 0; i < count; i++, word = strtok_r(NULL, " \n", &rest)) {
            if (size_of(p[i]) > size)
                continue;
            double want = strtod(word, NULL);
            double is = case_value(&c, case_point(&c, p[i]));
            double off = fabs(is - want);
            if (!c.item)
                off = fmin(off, fabs(off - 1));
            if (!(off <= tolerance + (is_tiled(c.kind) ? 1e-6 : 0))) {
                print_error("%s, case %d, point %d: %.12g, not %.12g\n",
                            c.name, cases, i, is, want);
                bad++;
            }
        }
        failed += bad > (c.kind == PATTERN_FRACTAL ? fractals_off : 0);
    }
    fclose(file);
    assert_true(cases > 50);
    assert_int_equal(failed, 0);
}

#endif
