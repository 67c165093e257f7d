/* test_noise.c - noise in double against values printed by POV-Ray. */
#define PHYSICS_DOUBLE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include "core/physics/noise.h"

enum { COLUMNS = 15 };

/* The next line of tests/data/noise.txt. */
static int read_line(FILE *file, double *row)
{
    for (int i = 0; i < COLUMNS; i++)
        if (fscanf(file, "%lf", &row[i]) != 1)
            return 0;
    return 1;
}

static void assert_vector(real3 is, const double *want)
{
    assert_float_equal(is.x, want[0], 1e-12);
    assert_float_equal(is.y, want[1], 1e-12);
    assert_float_equal(is.z, want[2], 1e-12);
}

static void test_noise__is_that_of_povray(void **state)
{
    (void)state;
    const real coarse[] = {6, 2, 0.5}, fine[] = {4, 1.7, 0.7};
    double row[COLUMNS];
    int rows = 0;
    FILE *file = fopen("tests/data/noise.txt", "r");
    assert_non_null(file);
    for (; read_line(file, row); rows++) {
        real3 p = real3_make(row[0], row[1], row[2]);
        assert_float_equal(noise_value(1, p), row[3], 1e-12);
        assert_float_equal(noise_value(2, p), row[4], 1e-12);
        assert_float_equal(noise_value(3, p), row[5], 5e-9);
        assert_vector(noise_vector(p), row + 6);
        assert_vector(noise_vector_turbulence(p, noise_series_of(coarse)),
                      row + 9);
        assert_vector(noise_vector_turbulence(p, noise_series_of(fine)),
                      row + 12);
    }
    fclose(file);
    assert_int_equal(rows, 40);
}

static void test_noise__repeats(void **state)
{
    (void)state;
    real3 p = real3_make(0.25, -7.5, 3.125);
    for (int axis = 0; axis < 3; axis++) {
        real3 q = p;
        *(axis == 0 ? &q.x : axis == 1 ? &q.y : &q.z) += 4096;
        for (int generator = 1; generator <= 3; generator++)
            assert_float_equal(noise_value(generator, p),
                               noise_value(generator, q), 1e-12);
    }
}

/* Halves of octaves are none, and none is one. */
static void test_noise__octaves_are_whole(void **state)
{
    (void)state;
    const double given[] = {-1, 0, 1, 2.9, 10, 11, 1e9};
    const int are[] = {1, 1, 1, 2, 10, 10, 10};
    for (int i = 0; i < 7; i++) {
        real param[] = {given[i], 2, 0.5};
        assert_int_equal(noise_series_of(param).octaves, are[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_noise__is_that_of_povray),
        cmocka_unit_test(test_noise__repeats),
        cmocka_unit_test(test_noise__octaves_are_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
