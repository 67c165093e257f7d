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
    return (double)wave_value(c->wave, c->exponent, c->frequency, c->phase, v);
}

/* All cases at the points of at most this size. A value that may jump where
 * the tolerance does not reach (from 1 to 0) counts as its neighbour. */
static void check_cases(double size, double tolerance)
{
    static char line[65536];
    double p[CASE_POINTS][3];
    int count, cases = 0, bad = 0;
    FILE *file = fopen("tests/data/patterns.txt", "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%d\n", &count), 1);
    for (int i = 0; i < count; i++)
        assert_int_equal(
            fscanf(file, "%lf %lf %lf\n", &p[i][0], &p[i][1], &p[i][2]), 3);
    for (; fgets(line, sizeof line, file); cases++) {
        struct pattern_case c = read_case(line);
        char *rest;
        assert_non_null(fgets(line, sizeof line, file));
        char *word = strtok_r(line, " \n", &rest);
        for (int i = 0; i < count; i++, word = strtok_r(NULL, " \n", &rest)) {
            double want = strtod(word, NULL), biggest = 0;
            for (int k = 0; k < 3; k++)
                biggest = fmax(biggest, fabs(p[i][k]));
            if (biggest > size)
                continue;
            double is = case_value(&c, real3_make((real)p[i][0], (real)p[i][1],
                                                  (real)p[i][2]));
            double off = fabs(is - want);
            if (!(fmin(off, fabs(off - 1)) <= tolerance)) {
                print_error("%s, case %d, point %d: %.12g, not %.12g\n",
                            c.name, cases, i, is, want);
                bad++;
            }
        }
    }
    fclose(file);
    assert_true(cases > 50);
    assert_int_equal(bad, 0);
}

#endif
