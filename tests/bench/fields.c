/* What filters of films leave of the noise of a field of scattered light.
 *
 *     fields SCENE FIRST LAST MOST PHOTONS...
 *
 * For each number of photons and each frame from FIRST to LAST of a film of
 * MOST frames: the squared error of each filter over that of no filter, and
 * what is left of the truth's detail, the products of differences from cell to
 * cell. The truth is two fields of MORE times as many photons (a million at
 * least) whose noise has nothing in common: products of differences from one
 * and from the other have no part of it. `still` has the frames of FIRST, with
 * noise of their own, in place of its neighbours. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "core/filter.h"
#include "core/frame.h"
#include "parser/parse.h"

enum { MORE = 16, LEAST = 1000000, REACH = BRUME_MAX_REACH };
enum { TAPS = BRUME_MAX_TAPS };

static const char *scene_path;
static int most;

static void require(bool good, const char *text)
{
    if (good)
        return;
    fprintf(stderr, "fields: %s\n", text);
    exit(1);
}

/* ---- fields ------------------------------------------------------------- */

static brume_scene *read_scene(int number)
{
    struct diag diag;
    struct parse_result result = {0};
    struct parse_input in = {.path = scene_path, .ambient = PARSE_AMBIENT_INIT};
    in.ambient.clock_on = true;
    in.ambient.clock = most > 1 ? (number - 1.0) / (most - 1.0) : 0.0;
    in.ambient.frame_number = number;
    in.ambient.initial_frame = in.ambient.final_clock = 1;
    in.ambient.final_frame = most;
    diag_init(&diag);
    bool good = parse_scene(&in, &result, &diag);
    require(good, diag.first ? diag.first->text : "the scene can't be read");
    diag_release(&diag);
    return result.scene;
}

/* The field of a frame, and the flat scene that a filter fills. */
static struct flat *trace(int number, uint32_t noise, uint64_t photons,
                          struct filter_field *field)
{
    static struct brume_frame out;
    static struct frame_job job;
    struct brume_error err = {0};
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.width = 64;
    o.height = 48;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.backend = BRUME_BACKEND_CPU;
    o.spp = 1;
    o.frame = noise;
    o.photons.count = photons;
    o.photons.taps = TAPS;
    o.photons.adaptive = true;
    brume_scene *scene = read_scene(number);
    require(frame_open(&job, scene, &o, &out, &err) &&
                frame_trace(&job, &err) &&
                filter_keep(job.flat, job.power, field, &err),
            err.text);
    brume_scene_free(scene);
    struct flat *flat = job.flat;
    job.flat = NULL;
    return flat;
}

/* ---- measures ----------------------------------------------------------- */

enum { FILTERS = 6 };
static const char *const names[FILTERS] = {
    "none", "3", "5", "adaptive,4", "adaptive,8", "mean of 17",
};

struct sums {
    double error[FILTERS], detail[FILTERS], truth;
};

/* What a cell's number is more than that of the next along an axis. */
static double slope(const float *x, size_t i, int axis, size_t numbers)
{
    size_t step = numbers << 3 * axis;
    bool last = (i / step & 7) == 7;
    return last ? 0.0 : (double)x[i + step] - (double)x[i];
}

/* Adds what is wrong with the numbers x, given the truth twice. */
static void add(const float *x, const struct filter_field truth[2], int which,
                struct sums *s)
{
    const float *a = truth[0].cells, *b = truth[1].cells;
    size_t numbers = (size_t)truth[0].lattice.numbers;
    for (size_t i = 0; i < truth[0].count; i++) {
        s->error[which] += ((double)x[i] - (double)a[i]) *
                           ((double)x[i] - (double)b[i]);
        for (int axis = 0; axis < 3; axis++) {
            double u = slope(a, i, axis, numbers),
                   v = slope(b, i, axis, numbers);
            double w = slope(x, i, axis, numbers);
            s->detail[which] += 0.5 * w * (u + v);
            s->truth += which == 0 ? u * v : 0.0;
        }
    }
}

static void filter(int which, struct flat *flat,
                   const struct filter_field *const field[TAPS])
{
    static struct filter_scratch scratch;
    struct brume_error err = {0};
    struct brume_photon_options o = {0};
    double even[TAPS];
    int reach[FILTERS] = {0, 1, 2, 4, 8, 8};
    const struct filter_field *const *list = field + REACH - reach[which];
    for (int i = 0; i < TAPS; i++)
        even[i] = 1.0;
    if (which < 3)
        brume_film_taps(&o, 1 + 2 * which);
    require(which == 3 || which == 4
                ? filter_adapt(flat, list, reach[which], 0, &scratch, &err)
                : filter_mean(flat, list, which < 3 ? o.weight : even,
                              reach[which], 0, &err),
            err.text);
}

/* One frame and its neighbours. */
static void measure(int number, bool still, uint64_t photons, struct sums *s)
{
    static uint32_t noise = 1000;
    struct filter_field truth[2], field[TAPS];
    const struct filter_field *list[TAPS];
    struct flat *flat = NULL;
    uint64_t many = photons * MORE > LEAST ? photons * MORE : LEAST;
    for (int i = 0; i < 2; i++)
        flat_free(trace(number, noise++, many, &truth[i]));
    for (int i = 0; i < TAPS; i++) {
        int k = still ? number : number + i - REACH;
        struct flat *made = trace(k, noise++, photons, &field[i]);
        flat_free(i == REACH ? NULL : made);
        flat = i == REACH ? made : flat;
        list[i] = &field[i];
    }
    require(truth[0].count == field[REACH].count, "cells differ");
    for (int i = 0; i < FILTERS; i++) {
        filter(i, flat, list);
        add(flat->radiance, truth, i, s);
    }
    flat_free(flat);
    for (int i = 0; i < TAPS; i++)
        filter_release(&field[i]);
    for (int i = 0; i < 2; i++)
        filter_release(&truth[i]);
}

/* ---- the program -------------------------------------------------------- */

static void print_row(uint64_t photons, const char *what, const struct sums *s)
{
    printf("| %llu, %s |", (unsigned long long)photons, what);
    for (int i = 1; i < FILTERS; i++)
        printf(" %.3f |", s->error[i] / s->error[0]);
    for (int i = 1; i < FILTERS; i++)
        printf(" %.1f |", 100.0 * (1.0 - s->detail[i] / s->truth));
    printf("\n");
    fflush(stdout);
}

int main(int count, char **word)
{
    require(count > 5, "usage: fields SCENE FIRST LAST MOST PHOTONS...");
    scene_path = word[1];
    int first = atoi(word[2]), last = atoi(word[3]);
    most = atoi(word[4]);
    require(first > REACH && last >= first && last + REACH <= most,
            "frames that lack neighbours");
    printf("| photons |");
    for (int k = 0; k < 2; k++)
        for (int i = 1; i < FILTERS; i++)
            printf(" %s%s |", k ? "lost " : "", names[i]);
    printf("\n");
    for (int i = 5; i < count; i++) {
        uint64_t photons = strtoull(word[i], NULL, 10);
        struct sums still = {0}, moving = {0};
        measure(first, true, photons, &still);
        print_row(photons, "still", &still);
        for (int k = first; k <= last; k++)
            measure(k, false, photons, &moving);
        print_row(photons, "moving", &moving);
    }
    return 0;
}
