/* The field of scattered light as a mean over frames, and films that take it:
 * variances against what the weights must give for noise that is independent
 * from frame to frame, splits against the whole. */
#include "tests/unit/filter_scene.h"
#include <stdlib.h>
#include <string.h>

static brume_scene *fog_ball(double x, double g, double eye)
{
    return fog_scene(&(struct fog){.x = x, .eye = eye, .g = g, .lamp = 1.0});
}

/* ---- fields ------------------------------------------------------------- */

/* Frames of a still scene in groups of `taps`, of each of which a filter makes
 * one; the variance over the groups is summed over all cells. */
enum { GROUPS = 40, MOST = 5 };

static double variance_of(int taps, uint32_t first)
{
    struct filter_field fields[MOST];
    const struct filter_field *list[MOST];
    double *sum = NULL, *square = NULL, all = 0.0;
    size_t count = 0;
    for (int group = 0; group < GROUPS; group++) {
        struct flat *flat = NULL;
        for (int k = 0; k < taps; k++) {
            struct brume_options o = fog_options(5, first++);
            flat_free(flat);
            flat = fog_trace(fog_ball(0.0, 0.0, 0.0), &o, &fields[k]);
            list[k] = &fields[k];
        }
        struct brume_options o = fog_options(taps, 0);
        assert_true(filter_mean(flat, list, o.photons.weight, taps / 2, 1,
                                truth_error()));
        count = flat->radiance_count;
        sum = sum ? sum : calloc(count, sizeof *sum);
        square = square ? square : calloc(count, sizeof *square);
        for (size_t i = 0; i < count; i++) {
            sum[i] += (double)flat->radiance[i];
            square[i] += (double)flat->radiance[i] * (double)flat->radiance[i];
        }
        for (int k = 0; k < taps; k++)
            filter_release(&fields[k]);
        flat_free(flat);
    }
    for (size_t i = 0; i < count; i++)
        all += (square[i] - sum[i] * sum[i] / GROUPS) / (GROUPS - 1);
    free(sum);
    free(square);
    return all;
}

static void filter__variance_is_that_of_the_weights(void **state)
{
    (void)state;
    double one = variance_of(1, 1000), three = variance_of(3, 2000),
           five = variance_of(5, 3000);
    print_message("3 taps %.4f, 5 taps %.4f\n", three / one, five / one);
    if (!(fabs(three / one / 0.375 - 1.0) < 0.04))
        fail_msg("3 taps: %.4f of the variance, not 0.375", three / one);
    if (!(fabs(five / one / 0.26 - 1.0) < 0.04))
        fail_msg("5 taps: %.4f of the variance, not 0.26", five / one);
}

/* Fields that swing with f cycles a frame come out times the filter's response
 * (METHODS.md 13.10, T12). */
static void check_response(int taps, const double *frequency,
                           const double *response)
{
    struct filter_field field[5];
    const struct filter_field *list[5];
    struct brume_options o = fog_options(taps, 1);
    struct flat *flat = NULL;
    for (int k = 0; k < taps; k++) {
        flat_free(flat);
        flat = fog_trace(fog_ball(0.0, 0.0, 0.0), &o, &field[k]);
        list[k] = &field[k];
    }
    for (int i = 0; i < 3; i++) {
        double most = 0.0;
        for (int k = 0; k < taps; k++) {
            double swing = cos(2.0 * TRUTH_PI * frequency[i] * (k - taps / 2));
            for (size_t n = 0; n < field[k].count; n++)
                field[k].cells[n] = (float)(2.0 + swing);
        }
        assert_true(filter_mean(flat, list, o.photons.weight, taps / 2, 1,
                                truth_error()));
        for (size_t n = 0; n < flat->radiance_count; n++)
            most = fmax(most,
                        fabs((double)flat->radiance[n] - 2.0 - response[i]));
        if (!(most < 5e-5))
            fail_msg("%d taps, f = %g: %g off", taps, frequency[i], most);
    }
    for (int k = 0; k < taps; k++)
        filter_release(&field[k]);
    flat_free(flat);
}

static void filter__response(void **state)
{
    (void)state;
    const double f[3] = {0.1, 0.25, 0.5};
    check_response(3, f, (double[]){0.9045, 0.5, 0.0});
    check_response(5, f, (double[]){0.7854, 0.2, 0.2});
}

/* Noise of one frame and of the next after the filter. */
static void filter__correlation(void **state)
{
    (void)state;
    const double truth[] = {2.0 / 3.0, 0.769};
    for (int i = 0; i < 2; i++) {
        struct brume_photon_options o;
        double next = 0.0, same = 0.0;
        assert_true(brume_film_taps(&o, 3 + 2 * i));
        for (int k = 0; k < o.taps; k++) {
            same += o.weight[k] * o.weight[k];
            next += k > 0 ? o.weight[k] * o.weight[k - 1] : 0.0;
        }
        assert_float_equal(next / same, truth[i], 5e-4);
    }
}

/* Weights that are found: nearly those of a plain mean where nothing changes,
 * and the frame's own alone where all does. The lamp that is brighter in one
 * half of the frames is a cut. */
static void filter__adapts_to_change(void **state)
{
    (void)state;
    enum { REACH = 4, TAPS = 2 * REACH + 1 };
    double error[3] = {0}, one = 0.0;
    struct filter_scratch scratch = {.desk = NULL};
    struct filter_field field[TAPS], truth;
    const struct filter_field *list[TAPS];
    struct brume_options o = fog_options(5, 77);
    o.photons.count = 2000000;
    flat_free(fog_trace(fog_ball(0.0, 0.0, 0.0), &o, &truth));
    for (int k = 0; k < TAPS; k++) {
        o = fog_options(5, 100 + (uint32_t)k);
        struct flat *flat = fog_trace(fog_ball(0.0, 0.0, 0.0), &o, &field[k]);
        list[k] = &field[k];
        if (k < TAPS - 1) {
            flat_free(flat);
            continue;
        }
        for (size_t i = 0; i < truth.count; i++)
            one += pow((double)(field[REACH].cells[i] - truth.cells[i]), 2.0);
        for (int change = 0; change < 3; change++) {
            assert_true(
                filter_adapt(flat, list, REACH, 2, &scratch, truth_error()));
            for (size_t i = 0; i < truth.count; i++)
                error[change] += pow(
                    (double)(flat->radiance[i] - truth.cells[i]), 2.0);
            /* Then all after the middle, then all others, are 5 times as
             * bright. */
            for (int j = change == 0 ? REACH + 1 : 0;
                 j < (change == 0 ? TAPS : REACH); j++) {
                field[j].noise *= 5.0;
                for (size_t i = 0; i < field[j].count; i++)
                    field[j].cells[i] *= 5.0f;
            }
        }
        flat_free(flat);
    }
    filter_scratch_release(&scratch);
    print_message("still %.4f, one side %.4f, none %.4f\n", error[0] / one,
                  error[1] / one, error[2] / one);
    assert_true(error[0] / one < 1.3 / TAPS);
    assert_true(error[1] / one < 1.5 / (REACH + 1));
    assert_true(error[2] / one < 1.15);
    for (int k = 0; k < TAPS; k++)
        filter_release(&field[k]);
    filter_release(&truth);
}

/* What is the same in all frames comes out as it is, also where some are not
 * there. */
static void filter__keeps_what_does_not_change(void **state)
{
    (void)state;
    struct filter_field field;
    struct brume_options o = fog_options(5, 1);
    struct flat *flat = fog_trace(fog_ball(0.0, 0.0, 0.0), &o, &field);
    const struct filter_field *all[5] = {&field, &field, &field, &field,
                                         &field};
    const struct filter_field *end[5] = {NULL, NULL, &field, &field, &field};
    size_t size = flat->radiance_count * sizeof *flat->radiance;
    for (int i = 0; i < 2; i++) {
        memset(flat->radiance, 0, size);
        assert_true(filter_mean(flat, i ? end : all, o.photons.weight, 2, 1,
                                truth_error()));
        for (size_t k = 0; k < flat->radiance_count; k++)
            assert_float_equal(flat->radiance[k], field.cells[k],
                               1e-6f * field.cells[k]);
    }
    filter_release(&field);
    flat_free(flat);
}

/* The sum over all cells stays where the ball is at the middle of its way: a
 * step of its own, and one that is no multiple of a cell. */
static void filter__fields_lie_in_space(void **state)
{
    (void)state;
    struct brume_options o = fog_options(3, 1);
    struct filter_field field[3];
    const struct filter_field *list[3] = {&field[0], &field[1], &field[2]};
    struct flat *flat = NULL;
    double mean = 0.0, sum = 0.0, cells = 0.0;
    for (int i = 0; i < 3; i++) {
        flat_free(flat);
        o.photons.spacing = i == 1 ? 0.11 : 0.125;
        flat = fog_trace(fog_ball(2.0, 0.0, 0.0), &o, &field[i]);
    }
    /* The last one's lattice, without its own field: all is interpolated. */
    list[2] = list[0] = NULL;
    assert_true(filter_mean(flat, list, o.photons.weight, 1, 1, truth_error()));
    double a = pow((double)field[1].lattice.side, 3.0);
    double b = pow((double)flat->view.field.side, 3.0);
    for (size_t k = 0; k < field[1].count; k++)
        mean += a * (double)field[1].cells[k];
    for (size_t k = 0; k < flat->radiance_count; k++) {
        sum += b * (double)flat->radiance[k];
        cells += flat->radiance[k] > 0.0f;
    }
    assert_true(cells > 1000.0);
    if (!(fabs(sum / mean - 1.0) < 0.02))
        fail_msg("%.4f of the light is left", sum / mean);
    for (int i = 0; i < 3; i++)
        filter_release(&field[i]);
    flat_free(flat);
}

/* Cells of two frames of a moving ball are the same places of the scene. */
static void filter__lattices_of_a_film_agree(void **state)
{
    (void)state;
    struct filter_field field[2];
    for (int i = 0; i < 2; i++) {
        struct brume_options o = fog_options(3, 1);
        flat_free(fog_trace(fog_ball(0.3 * i, 0.0, 0.0), &o, &field[i]));
    }
    assert_true(field[0].lattice.side == field[1].lattice.side);
    for (int k = 0; k < 3; k++) {
        double step = (double)(field[0].lattice.origin[k] -
                               field[1].lattice.origin[k]) /
                      (double)field[0].lattice.side / 8.0;
        assert_float_equal(step, rint(step), 1e-5);
    }
    filter_release(&field[0]);
    filter_release(&field[1]);
}

/* Light that goes to the eye is another's where the eye was elsewhere. */
static void filter__peaked_media_keep_to_the_eye(void **state)
{
    (void)state;
    struct brume_options o = fog_options(3, 1);
    for (int moved = 0; moved < 2; moved++) {
        struct filter_field field[2];
        o.frame = 1;
        flat_free(
            fog_trace(fog_ball(0.0, 0.7, moved ? 2.0 : 0.0), &o, &field[0]));
        o.frame = 2;
        struct flat *flat = fog_trace(fog_ball(0.0, 0.7, 0.0), &o, &field[1]);
        assert_true(flat->view.field.eye == 0);
        const struct filter_field *list[3] = {&field[0], &field[1], NULL};
        assert_true(
            filter_mean(flat, list, o.photons.weight, 1, 1, truth_error()));
        size_t size = flat->radiance_count * sizeof *flat->radiance;
        int same = memcmp(flat->radiance, field[1].cells, size) == 0;
        assert_int_equal(same, moved);
        filter_release(&field[0]);
        filter_release(&field[1]);
        flat_free(flat);
    }
}

/* ---- films -------------------------------------------------------------- */

enum { FRAMES = 6 };

struct made {
    float pixel[FRAMES][3 * PIXELS];
    uint64_t ring[FRAMES];
};

/* Frames `from` to `to` of a film of FRAMES, read from the last on if
 * `backward`. */
static void make_film(int taps, int from, int to, bool backward,
                      struct made *out)
{
    struct brume_film *film = brume_film_new(NULL, truth_error());
    struct brume_options o = fog_options(taps, 0);
    int reach = brume_film_reach(&o), low = from - reach, high = to + reach;
    assert_non_null(film);
    low = low < 0 ? 0 : low;
    high = high < FRAMES ? high : FRAMES - 1;
    for (int i = low; i <= high; i++) {
        int frame = backward ? high + low - i : i;
        o.frame = (uint32_t)frame;
        assert_true(brume_film_push(film, fog_ball(0.05 * frame, 0.0, 0.0), &o,
                                    frame >= from && frame <= to,
                                    truth_error()));
    }
    for (int i = from; i <= to; i++) {
        struct brume_frame f;
        assert_true(
            brume_film_ask(film, (uint32_t)i, 0, FRAMES - 1, truth_error()));
        assert_true(brume_film_next(film, &f, truth_error()));
        memcpy(out->pixel[i], f.radiance, sizeof out->pixel[i]);
        out->ring[i] = f.stats.photons.ring;
        brume_frame_free(&f);
        if (i - reach >= 0)
            assert_true(brume_film_forget(film, (uint32_t)(i + 1 - reach),
                                          truth_error()));
    }
    brume_film_free(film);
}

static void film__any_split_gives_the_same_bits(void **state)
{
    (void)state;
    static struct made whole, part;
    for (int taps = 1; taps <= 5; taps += 2) {
        make_film(taps, 0, FRAMES - 1, false, &whole);
        for (int i = 0; i < FRAMES; i++)
            make_film(taps, i, i, i & 1, &part);
        assert_memory_equal(whole.pixel, part.pixel, sizeof whole.pixel);
        make_film(taps, 0, 3, false, &part);
        make_film(taps, 4, FRAMES - 1, true, &part);
        assert_memory_equal(whole.pixel, part.pixel, sizeof whole.pixel);
    }
    static struct made one;
    make_film(1, 0, FRAMES - 1, false, &one);
    assert_true(memcmp(one.pixel, whole.pixel, sizeof one.pixel) != 0);
}

/* A frame of a film without a filter is that frame alone. */
static void film__without_a_filter_frames_are_stills(void **state)
{
    (void)state;
    static struct made film;
    make_film(1, 0, FRAMES - 1, false, &film);
    for (int i = 0; i < FRAMES; i++) {
        struct brume_options o = fog_options(1, (uint32_t)i);
        struct brume_frame f;
        brume_scene *s = fog_ball(0.05 * i, 0.0, 0.0);
        assert_true(brume_render(s, &o, &f, truth_error()));
        assert_memory_equal(film.pixel[i], f.radiance, sizeof film.pixel[i]);
        assert_int_equal(film.ring[i], 0);
        brume_frame_free(&f);
        brume_scene_free(s);
    }
}

/* The ring holds the fields of all frames within reach, and no more. */
static void film__ring_is_as_long_as_the_filter(void **state)
{
    (void)state;
    for (int taps = 3; taps <= 5; taps += 2) {
        struct brume_film *made = brume_film_new(NULL, truth_error());
        uint64_t one = 0;
        for (int i = 0; i < FRAMES + 4; i++) {
            struct brume_options o = fog_options(taps, (uint32_t)i);
            int centre = i - taps / 2;
            assert_true(brume_film_push(made, fog_ball(0.0, 0.0, 0.0), &o, true,
                                        truth_error()));
            if (centre < 0)
                continue;
            struct brume_frame f;
            assert_true(
                brume_film_ask(made, (uint32_t)centre, 0, 99, truth_error()));
            assert_true(brume_film_next(made, &f, truth_error()));
            one = centre == 0 ? f.stats.photons.ring / (uint64_t)(taps / 2 + 1)
                              : one;
            if (centre >= taps / 2)
                assert_int_equal(f.stats.photons.ring, (uint64_t)taps * one);
            brume_frame_free(&f);
            if (centre >= taps / 2)
                assert_true(brume_film_forget(
                    made, (uint32_t)(centre + 1 - taps / 2), truth_error()));
        }
        assert_true(one >= 8000 * sizeof(float));
        brume_film_free(made);
    }
}

static void film__tells_what_is_missing(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct brume_frame f;
    struct brume_options o = fog_options(3, 4);
    struct brume_film *film = brume_film_new(NULL, truth_error());
    assert_false(brume_film_next(film, &f, &err));
    assert_int_equal(err.code, BRUME_ERR_USAGE);
    assert_true(brume_film_push(film, fog_ball(0.0, 0.0, 0.0), &o, true,
                                truth_error()));
    assert_true(brume_film_ask(film, 4, 0, 9, truth_error()));
    err = (struct brume_error){0};
    assert_false(brume_film_next(film, &f, &err));
    assert_non_null(strstr(err.text, "frame 3"));
    assert_true(brume_film_ask(film, 7, 7, 7, truth_error()));
    err = (struct brume_error){0};
    assert_false(brume_film_next(film, &f, &err));
    assert_non_null(strstr(err.text, "frame 7 was not pushed"));
    brume_film_free(film);
}

static bool stop_it(void *user, const struct brume_progress *progress)
{
    (void)progress;
    ++*(int *)user;
    return false;
}

static void film__stops_where_it_is_told_to(void **state)
{
    (void)state;
    int calls = 0;
    struct brume_error err = {0};
    struct brume_frame f;
    struct brume_film_events events = {.user = &calls, .progress = stop_it};
    struct brume_options o = fog_options(1, 0);
    struct brume_film *film = brume_film_new(&events, truth_error());
    o.spp = 60000;
    assert_true(brume_film_push(film, fog_ball(0.0, 0.0, 0.0), &o, true,
                                truth_error()));
    assert_true(brume_film_ask(film, 0, 0, 0, truth_error()));
    assert_false(brume_film_next(film, &f, &err));
    assert_int_equal(err.code, BRUME_STOPPED);
    assert_true(calls > 0);
    brume_film_free(film);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filter__variance_is_that_of_the_weights),
        cmocka_unit_test(filter__response),
        cmocka_unit_test(filter__correlation),
        cmocka_unit_test(filter__adapts_to_change),
        cmocka_unit_test(filter__keeps_what_does_not_change),
        cmocka_unit_test(filter__fields_lie_in_space),
        cmocka_unit_test(filter__lattices_of_a_film_agree),
        cmocka_unit_test(filter__peaked_media_keep_to_the_eye),
        cmocka_unit_test(film__any_split_gives_the_same_bits),
        cmocka_unit_test(film__without_a_filter_frames_are_stills),
        cmocka_unit_test(film__ring_is_as_long_as_the_filter),
        cmocka_unit_test(film__tells_what_is_missing),
        cmocka_unit_test(film__stops_where_it_is_told_to),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
