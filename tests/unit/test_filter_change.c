/* Weights over frames of a field of scattered light where something changes:
 * what moves, an eye that does, and light and fog that come and go. Errors are
 * those against a field of many photons of the middle frame. */
#include <stdlib.h>
#include <string.h>
#include "tests/unit/filter_scene.h"

enum { REACH = BRUME_MAX_REACH, TAPS = BRUME_MAX_TAPS, MANY = 1000000 };

struct left {
    double error, lost; /* over no filter's; of the truth's detail   */
};

/* What a cell's number is more than that of the next along x. */
static double slope(const float *x, size_t i)
{
    return (i / 3 & 7) == 7 ? 0.0 : (double)x[i + 3] - (double)x[i];
}

/* Of a filter's field. Noise of the truth is not in the slopes' products, as
 * what they are multiplied by is of another truth. */
static struct left compare(const float *x, const struct filter_field *own,
                           const struct filter_field truth[2])
{
    double error = 0.0, one = 0.0, kept = 0.0, all = 0.0;
    for (size_t i = 0; i < own->count; i++) {
        double a = (double)truth[0].cells[i], b = (double)truth[1].cells[i];
        error += ((double)x[i] - a) * ((double)x[i] - b);
        one += ((double)own->cells[i] - a) * ((double)own->cells[i] - b);
        double u = slope(truth[0].cells, i), v = slope(truth[1].cells, i);
        kept += 0.5 * slope(x, i) * (u + v);
        all += u * v;
    }
    return (struct left){error / one, 1.0 - kept / all};
}

/* A film that `frame` tells, at frames -REACH to REACH. */
static struct left filter_film(struct fog (*frame)(int k), bool adaptive)
{
    static uint32_t noise = 1;
    struct filter_field field[TAPS], truth[2];
    const struct filter_field *list[TAPS];
    struct filter_scratch scratch = {.desk = NULL};
    struct flat *flat = NULL;
    double even[TAPS];
    for (int k = 0; k < TAPS + 2; k++) {
        int at = k < TAPS ? k - REACH : 0;
        struct fog fog = frame(at);
        struct brume_options o = fog_options(5, noise++);
        o.photons.adaptive = true;
        o.photons.count = k < TAPS ? 20000 : MANY;
        struct filter_field *to = k < TAPS ? &field[k] : &truth[k - TAPS];
        struct flat *made = fog_trace(fog_scene(&fog), &o, to);
        flat_free(k == REACH ? NULL : made);
        flat = k == REACH ? made : flat;
        if (k < TAPS)
            list[k] = to;
    }
    for (int k = 0; k < TAPS; k++)
        even[k] = 1.0;
    assert_int_equal(field[REACH].count, truth[0].count);
    assert_true(
        adaptive ? filter_adapt(flat, list, REACH, 2, &scratch, truth_error())
                 : filter_mean(flat, list, even, REACH, 2, truth_error()));
    filter_scratch_release(&scratch);
    struct left left = compare(flat->radiance, &field[REACH], truth);
    flat_free(flat);
    for (int k = 0; k < TAPS; k++)
        filter_release(&field[k]);
    filter_release(&truth[0]);
    filter_release(&truth[1]);
    return left;
}

/* ---- what moves --------------------------------------------------------- */

/* By a cell in three frames; its fog is lit by a lamp that stands still. */
#define STEP 0.0417

static struct fog still(int k)
{
    (void)k;
    return (struct fog){.lamp = 1.0};
}

static struct fog moving(int k)
{
    return (struct fog){.x = STEP * k, .lamp = 1.0};
}

static struct fog drifting(int k)
{
    return (struct fog){.x = STEP * k, .lamp = 1.0, .drift = STEP};
}

static struct fog wrongly(int k)
{
    (void)k;
    return (struct fog){.lamp = 1.0, .drift = STEP};
}

/* Along its velocity a fog that moves evenly is as if it stood still. */
static void velocity__is_followed(void **state)
{
    (void)state;
    struct left none = filter_film(still, true);
    struct left plain = filter_film(moving, false);
    struct left found = filter_film(moving, true);
    struct left followed = filter_film(drifting, true);
    print_message("still %.4f; moving: mean %.4f, lost %.1f %%; found %.4f, "
                  "%.1f %%; followed %.4f, %.1f %%\n",
                  none.error, plain.error, 100.0 * plain.lost, found.error,
                  100.0 * found.lost, followed.error, 100.0 * followed.lost);
    assert_true(none.error < 1.25 / TAPS);
    assert_true(followed.error < 1.25 / TAPS);
    assert_true(fabs(followed.lost) < 0.05);
    assert_true(plain.lost > 0.05);
    assert_true(found.error > 1.2 * followed.error);
}

/* Of a flow that stands still, as a flame's foot, its velocity tells nothing of
 * the light. */
static void velocity__is_not_believed(void **state)
{
    (void)state;
    struct left left = filter_film(wrongly, true);
    print_message("%.4f, %.1f %%\n", left.error, 100.0 * left.lost);
    assert_true(left.error < 1.3 / TAPS);
    assert_true(fabs(left.lost) < 0.02);
}

/* ---- what must not matter ----------------------------------------------- */

static struct fog seen(int k)
{
    return (struct fog){.eye = 0.1 * k, .lamp = 1.0};
}

static void eye__may_move(void **state)
{
    (void)state;
    struct left left = filter_film(seen, true);
    print_message("%.4f\n", left.error);
    assert_true(left.error < 1.25 / TAPS);
    assert_true(fabs(left.lost) < 0.02);
}

/* ---- what comes and goes ------------------------------------------------ */

static struct fog flash_beside(int k)
{
    return (struct fog){.lamp = k == 1 ? 8.0 : 1.0};
}

static struct fog flash(int k)
{
    return (struct fog){.lamp = k == 0 ? 8.0 : 1.0};
}

static struct fog dark_before(int k)
{
    return (struct fog){.lamp = k < 0 ? 1e-3 : 1.0};
}

static struct fog cut(int k)
{
    return (struct fog){.x = k < 0 ? 0.7 : 0.0, .lamp = 1.0};
}

static struct fog gone(int k)
{
    return (struct fog){.x = k == 0 ? 0.0 : 9.0, .lamp = 1.0};
}

static void change__is_left_out(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        struct fog (*frame)(int k);
        double most, lost;
    } cases[] = {
        {"a flash beside", flash_beside, 1.3 / (TAPS - 1), 0.02},
        {"a flash", flash, 1.0, 0.06},
        {"dark before", dark_before, 1.4 / (REACH + 1), 0.02},
        {"a cut", cut, 1.6 / (REACH + 1), 0.02},
        {"alone", gone, 1.05, 0.02},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct left left = filter_film(cases[i].frame, true);
        print_message("%s: %.4f, lost %.1f %%\n", cases[i].name, left.error,
                      100.0 * left.lost);
        if (!(left.error < cases[i].most && fabs(left.lost) < cases[i].lost))
            fail_msg("%s: %.4f", cases[i].name, left.error);
    }
}

/* ---- stray photons ------------------------------------------------------ */

/* What is left of light that a cell has in one frame of a still scene, a
 * hundred times that of others; in both halves of its photons or in one. */
static double left_of_spark(double half)
{
    enum { CELL = 3 * (512 + 73) };
    struct filter_field field[TAPS];
    const struct filter_field *list[TAPS];
    struct filter_scratch scratch = {.desk = NULL};
    struct flat *flat = NULL;
    double mean = 0.0;
    for (int k = 0; k < TAPS; k++) {
        struct fog fog = {.lamp = 1.0};
        struct brume_options o = fog_options(5, 900 + (uint32_t)k);
        o.photons.adaptive = true;
        o.photons.count = 20000;
        struct flat *made = fog_trace(fog_scene(&fog), &o, &field[k]);
        flat_free(k == REACH ? NULL : made);
        flat = k == REACH ? made : flat;
        list[k] = &field[k];
    }
    for (size_t i = 0; i < field[REACH].count; i++)
        mean += (double)field[REACH].cells[i] / (double)field[REACH].count;
    for (int c = 0; c < 3; c++) {
        field[REACH].cells[CELL + c] += (float)(100.0 * mean);
        flat->radiance[CELL + c] += (float)(100.0 * mean);
    }
    /* The block of cell 73 of the second brick. */
    flat->half[64] += (float)(300.0 * mean * half);
    assert_true(filter_adapt(flat, list, REACH, 2, &scratch, truth_error()));
    double left = (double)flat->radiance[CELL] / (100.0 * mean);
    filter_scratch_release(&scratch);
    flat_free(flat);
    for (int k = 0; k < TAPS; k++)
        filter_release(&field[k]);
    return left;
}

static void stray__photons_are_noise(void **state)
{
    (void)state;
    double both = left_of_spark(0.5), one = left_of_spark(0.0);
    print_message("in both halves %.3f of it is left, in one %.3f\n", both,
                  one);
    assert_true(both > 0.9);
    assert_true(one < 0.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocity__is_followed),
        cmocka_unit_test(velocity__is_not_believed),
        cmocka_unit_test(eye__may_move),
        cmocka_unit_test(change__is_left_out),
        cmocka_unit_test(stray__photons_are_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
