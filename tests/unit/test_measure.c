/* The error measure of brume measure, what it concludes, and its plot. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "lib/plot.h"
#include "parser/measure.h"

/* ---- the error ---------------------------------------------------------- */

/* Two pixels of 1 and 3 in all channels, of mean 2: with 0.2 and 0.6 off, the
 * squares are 0.04 / (1 + 0.04) and 0.36 / (9 + 0.04). */
static void test_measure__difference(void **state)
{
    const float reference[] = {9, 9, 9, 1, 1, 1, 3, 3, 3};
    const float picture[] = {0, 0, 0, 1.2f, 1.2f, 1.2f, 2.4f, 2.4f, 2.4f};
    const int part[4] = {1, 0, 3, 1}, all[4] = {0, 0, 3, 1};
    (void)state;
    assert_float_equal(measure_difference(picture, reference, 3, part),
                       sqrt(0.5 * (0.04 / 1.04 + 0.36 / 9.04)), 1e-7);
    assert_true(measure_difference(reference, reference, 3, all) == 0.0);
}

static void test_measure__difference_of_black(void **state)
{
    const float black[6] = {0};
    const int all[4] = {0, 0, 2, 1};
    (void)state;
    assert_true(measure_difference(black, black, 2, all) == 0.0);
}

/* ---- conclusions -------------------------------------------------------- */

static void add(struct measure *m, int spp, double seconds, double error)
{
    m->row[m->rows++] = (struct measure_row){.set.spp = spp,
                                             .seconds = seconds,
                                             .prepare_seconds = 1,
                                             .error = error};
}

static void test_measure__front(void **state)
{
    struct measure m = {.rows = 0};
    const bool front[] = {true, false, true, false, true};
    (void)state;
    add(&m, 4, 2, 0.30);
    add(&m, 8, 4, 0.31);
    add(&m, 16, 4, 0.20);
    add(&m, 32, 5, 0.20);
    add(&m, 64, 9, 0.10);
    measure_conclude(&m);
    for (int i = 0; i < m.rows; i++)
        assert_int_equal(m.row[i].front, front[i]);
}

/* 10 % by a row, the quicker of two; 3 % and 1 % by four and 36 times the
 * samples of the last. */
static void test_measure__advice(void **state)
{
    struct measure m = {.rows = 0};
    (void)state;
    add(&m, 4, 2, 0.12);
    add(&m, 8, 3, 0.09);
    add(&m, 16, 5, 0.06);
    measure_conclude(&m);
    assert_true(m.advice[0].measured);
    assert_int_equal(m.advice[0].set.spp, 8);
    assert_float_equal(m.advice[0].seconds, 3, 1e-12);
    assert_false(m.advice[1].measured);
    assert_int_equal(m.advice[1].set.spp, 64);
    assert_float_equal(m.advice[1].seconds, 1 + 4 * 4, 1e-9);
    assert_int_equal(m.advice[2].set.spp, 576);
}

static void add_photons(struct measure *m, int spp, double seconds,
                        double error)
{
    add(m, spp, seconds, error);
    m->row[m->rows - 1].set.series = 1;
    m->row[m->rows - 1].set.photons = 1000 * (uint64_t)spp;
}

/* Rows that fall as the cube root of the time go on so; half the error takes
 * eight times as much. */
static void test_measure__measured_slope(void **state)
{
    struct measure m = {.rows = 0};
    (void)state;
    add_photons(&m, 4, 1 + 1, 0.24);
    add_photons(&m, 32, 1 + 8, 0.12);
    add_photons(&m, 256, 1 + 64, 0.06);
    measure_conclude(&m);
    assert_false(m.advice[1].measured);
    assert_int_equal(m.advice[1].set.series, 1);
    assert_int_equal(m.advice[1].set.spp, 256 * 8);
    assert_int_equal(m.advice[1].set.photons, 256 * 8 * 1000);
    assert_float_equal(m.advice[1].seconds, 1 + 64 * 8, 1e-6);
    /* 216 times as long: further than its bias is known. */
    assert_int_equal(m.advice[2].set.series, -1);
}

/* What is left does not fall; one row alone tells nothing of a bias. */
static void test_measure__bias_stays(void **state)
{
    struct measure m = {.rows = 0};
    (void)state;
    add_photons(&m, 4, 2, 0.051);
    measure_conclude(&m);
    assert_int_equal(m.advice[1].set.series, -1);
    add_photons(&m, 8, 3, 0.0505);
    add_photons(&m, 16, 5, 0.05);
    measure_conclude(&m);
    assert_int_equal(m.advice[1].set.series, -1);
    assert_true(m.advice[0].measured);
}

static void test_measure__switches(void **state)
{
    char text[MEASURE_SWITCHES];
    struct measure_setting path = {0, 8, 0, 0}, fine = {2, 4, 1000, 0.25},
                           paper = {3, 16, 2000, 0};
    (void)state;
    measure_switches(&path, text, sizeof text);
    assert_string_equal(text, "--integrator path --spp 8");
    measure_switches(&fine, text, sizeof text);
    assert_string_equal(text, "--integrator photon --photons 1000 "
                              "--field-spacing 0.25 --spp 4");
    measure_switches(&paper, text, sizeof text);
    assert_string_equal(text, "--integrator photon --preset paper "
                              "--photons 2000 --spp 16");
}

static void test_measure__no_rows(void **state)
{
    struct measure m = {.rows = 0};
    (void)state;
    measure_conclude(&m);
    for (int i = 0; i < MEASURE_GOALS; i++)
        assert_int_equal(m.advice[i].set.series, -1);
}

/* An error so large that no number of samples would do. */
static void test_measure__out_of_reach(void **state)
{
    struct measure m = {.rows = 0};
    (void)state;
    add(&m, 4, 2, 50);
    measure_conclude(&m);
    assert_int_equal(m.advice[2].set.series, -1);
}

/* ---- the plot ----------------------------------------------------------- */

static char *draw(const struct plot *plot)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    assert_non_null(f);
    plot_svg(plot, f);
    assert_int_equal(fclose(f), 0);
    return text;
}

/* Whether tags close what they opened, `<` and `&` stand for markup alone and
 * all attributes are quoted. */
static void assert_is_xml(const char *text)
{
    char open[32][16];
    int depth = 0;
    assert_int_equal(strncmp(text, "<?xml", 5), 0);
    text = strchr(text, '\n');
    for (const char *at = text; (at = strpbrk(at, "<&")) != NULL;) {
        if (*at == '&') {
            assert_true(!strncmp(at, "&amp;", 5) || !strncmp(at, "&lt;", 4) ||
                        !strncmp(at, "&gt;", 4));
            at++;
            continue;
        }
        const char *end = strchr(at, '>');
        assert_non_null(end);
        int quotes = 0;
        for (const char *c = at; c < end; c++)
            quotes += *c == '"';
        assert_int_equal(quotes % 2, 0);
        bool closes = at[1] == '/', empty = end[-1] == '/';
        char name[16];
        assert_int_equal(sscanf(at + 1 + closes, "%15[a-z]", name), 1);
        if (closes)
            assert_string_equal(name, open[--depth]);
        else if (!empty)
            memcpy(open[depth++], name, sizeof name);
        assert_in_range(depth, 0, 31);
        at = end;
    }
    assert_int_equal(depth, 0);
}

static size_t count(const char *text, const char *what)
{
    size_t n = 0;
    for (; (text = strstr(text, what)) != NULL; text++)
        n++;
    return n;
}

static void test_plot__xml(void **state)
{
    const double x[] = {0.01, 1, 0, 100}, y[] = {10, 1, 1, INFINITY};
    const struct plot_series series[] = {{"a < b & \"c\"", x, y, 4, false},
                                         {"<best>", x, y, 4, true},
                                         {"none", NULL, NULL, 0, false}};
    const double marks[] = {2};
    const struct plot plot = {"T1 & T2 <>", "x", "y", series, 3, marks, 1};
    (void)state;
    char *text = draw(&plot);
    assert_is_xml(text);
    assert_int_equal(count(text, "<circle"), 2);
    assert_int_equal(count(text, "stroke-dasharray"), 1);
    assert_non_null(strstr(text, "T1 &amp; T2 &lt;&gt;"));
    assert_null(strstr(text, "inf"));
    assert_null(strstr(text, "nan"));
    free(text);
}

static void test_plot__empty(void **state)
{
    const struct plot plot = {"nothing", "x", "y", NULL, 0, NULL, 0};
    (void)state;
    char *text = draw(&plot);
    assert_is_xml(text);
    assert_int_equal(count(text, "<circle"), 0);
    free(text);
}

/* A decade to the right is a decade to the right, wherever it begins. */
static void test_plot__is_logarithmic(void **state)
{
    const double x[] = {1, 10, 100}, y[] = {1, 1, 1};
    const struct plot_series series = {"s", x, y, 3, false};
    const struct plot plot = {"t", "x", "y", &series, 1, NULL, 0};
    double at[3];
    (void)state;
    char *text = draw(&plot);
    const char *c = text;
    for (int i = 0; i < 3; i++) {
        c = strstr(c, "<circle cx=\"");
        assert_non_null(c);
        at[i] = atof(c += 12);
    }
    assert_true(at[1] > at[0] + 100);
    assert_float_equal(at[1] - at[0], at[2] - at[1], 0.11);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measure__difference),
        cmocka_unit_test(test_measure__difference_of_black),
        cmocka_unit_test(test_measure__front),
        cmocka_unit_test(test_measure__advice),
        cmocka_unit_test(test_measure__measured_slope),
        cmocka_unit_test(test_measure__bias_stays),
        cmocka_unit_test(test_measure__switches),
        cmocka_unit_test(test_measure__no_rows),
        cmocka_unit_test(test_measure__out_of_reach),
        cmocka_unit_test(test_plot__xml),
        cmocka_unit_test(test_plot__empty),
        cmocka_unit_test(test_plot__is_logarithmic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
