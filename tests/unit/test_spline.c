/* test_spline.c - splines against the values that POV-Ray prints
 * (tests/oracle/splines.py), as functions, in float, and what is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "core/physics/spline.h"
#include "core/scene.h"

enum { POINTS = 16 };

struct row {
    int kind, count;
    double parameters[POINTS], values[POINTS * 3];
    double at, truth[3];
};

static bool read_row(FILE *file, struct row *row)
{
    if (fscanf(file, "%d %d", &row->kind, &row->count) != 2)
        return false;
    assert_in_range(row->count, 1, POINTS);
    for (int i = 0; i < row->count; i++) {
        double *v = row->values + 3 * i;
        assert_int_equal(fscanf(file, "%lf %lf %lf %lf", &row->parameters[i],
                                &v[0], &v[1], &v[2]),
                         4);
    }
    return fscanf(file, "%lf %lf %lf %lf", &row->at, &row->truth[0],
                  &row->truth[1], &row->truth[2]) == 4;
}

static int add(brume_scene *s, const struct row *row, int kind)
{
    struct brume_spline spline = {(enum brume_spline_kind)kind, 3, row->count,
                                  row->parameters, row->values};
    return brume_add_spline(s, &spline, NULL);
}

static int add_as_function(brume_scene *s, int spline, int kind)
{
    struct brume_function *f = brume_function_new(s, 1, NULL);
    brume_function_parameter(f, 0, NULL);
    brume_function_spline(f, spline, kind, NULL);
    return brume_add_function(s, f, NULL);
}

static void in_float(const brume_scene *s, int id, double at, float *out)
{
    float numbers[256];
    const double *from = s->pool + s->splines[id];
    size_t size = s->pool_count - (size_t)s->splines[id];
    for (size_t i = 0; i < size && i < 256; i++)
        numbers[i] = (float)from[i];
    spline_eval(numbers, -1, (float)at, out);
}

static void check(const struct row *row)
{
    brume_scene *s = brume_scene_new(NULL);
    double out[BRUME_MAX_RESULTS], as[BRUME_MAX_RESULTS];
    float single[BRUME_MAX_RESULTS];
    int id = add(s, row, row->kind), other = add(s, row, (row->kind + 1) % 4);
    int function = add_as_function(s, other, row->kind);
    assert_true(id >= 0 && other >= 0 && function >= 0);
    assert_true(brume_eval_spline(s, id, -1, row->at, out, NULL));
    assert_true(brume_eval_function(s, function, &row->at, 1, as, NULL));
    in_float(s, id, row->at, single);
    for (int k = 0; k < 3; k++) {
        if (!(fabs(out[k] - row->truth[k]) <= 2e-12))
            fail_msg("kind %d of %d points at %g: %.13g, not %.13g", row->kind,
                     row->count, row->at, out[k], row->truth[k]);
        assert_true(out[k] == as[k]);
        assert_true(fabs(single[k] - row->truth[k]) <= 4e-3);
    }
    brume_scene_free(s);
}

static void test_povray(void **state)
{
    (void)state;
    struct row row;
    int rows = 0;
    FILE *file = fopen("tests/data/splines.txt", "r");
    assert_non_null(file);
    for (; read_row(file, &row); rows++)
        check(&row);
    fclose(file);
    assert_true(rows > 500);
}

static void test_terms(void **state)
{
    (void)state;
    const double t[2] = {0, 1}, values[10] = {1, 2, 3, 4, 5, 3, 4, 5, 6, 7};
    for (int terms = 1; terms <= 5; terms++) {
        brume_scene *s = brume_scene_new(NULL);
        struct brume_spline spline = {BRUME_SPLINE_LINEAR, terms, 2, t, values};
        double out[BRUME_MAX_RESULTS];
        int id = brume_add_spline(s, &spline, NULL), parameters, results;
        assert_true(brume_eval_spline(s, id, -1, 0.5, out, NULL));
        for (int k = 0; k < terms; k++)
            assert_true(out[k] == (values[k] + values[terms + k]) / 2);
        id = add_as_function(s, id, -1);
        assert_true(brume_function_arity(s, id, &parameters, &results));
        assert_int_equal(results, terms);
        brume_scene_free(s);
    }
}

static void test_refused(void **state)
{
    (void)state;
    const double t[2] = {0, NAN}, values[6] = {0};
    const struct brume_spline wrong[] = {
        {(enum brume_spline_kind)4, 3, 1, t, values},
        {BRUME_SPLINE_LINEAR, 0, 1, t, values},
        {BRUME_SPLINE_LINEAR, 6, 1, t, values},
        {BRUME_SPLINE_LINEAR, 3, 0, t, values},
        {BRUME_SPLINE_LINEAR, 3, 2, t, values},
        {BRUME_SPLINE_LINEAR, 3, 1 << 30, t, values},
    };
    brume_scene *s = brume_scene_new(NULL);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct brume_error err = {0};
        assert_int_equal(brume_add_spline(s, &wrong[i], &err), -1);
        assert_true(err.code != BRUME_OK);
    }
    double out[BRUME_MAX_RESULTS];
    assert_false(brume_eval_spline(s, 0, -1, 0, out, NULL));
    assert_int_equal(add_as_function(s, 0, -1), -1);
    struct brume_spline one = {BRUME_SPLINE_LINEAR, 3, 1, t, values};
    assert_int_equal(brume_add_spline(s, &one, NULL), 0);
    assert_false(brume_eval_spline(s, 0, 4, 0, out, NULL));
    assert_true(brume_eval_spline(s, 0, 3, NAN, out, NULL));
    brume_scene_free(s);
}

#define CASE(name)                                                             \
    {                                                                          \
        "spline__" #name, test_##name, NULL, NULL, NULL                        \
    }

int main(void)
{
    const struct CMUnitTest tests[] = {CASE(povray), CASE(terms),
                                       CASE(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
