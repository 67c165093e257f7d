/* Films of several workers have the pictures of one, each in its turn. */
#include "tests/unit/truth.h"
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 14, SIDE = 8, NUMBERS = SIDE * SIDE * 3, MOST = 8 };

struct made {
    float pixel[FRAMES][NUMBERS];
    int frames[MOST]; /* of each worker                             */
};

/* A ball of fog that moves, lit by a lamp. */
static brume_scene *fog_ball(double x)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    struct brume_camera camera = BRUME_CAMERA_INIT;
    struct brume_light lamp = BRUME_LIGHT_INIT;
    struct brume_medium m = truth_medium(0.3, 3.0, 0.0);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    globals.media_multiple = true;
    brume_scene *s = truth_scene(&globals, 4.0, 1.0);
    camera.location[2] = -4.0;
    assert_true(brume_set_camera(s, &camera, truth_error()));
    lamp.location[1] = 5.0;
    assert_true(brume_add_light(s, &lamp, truth_error()) >= 0);
    ball.a[0] = x;
    truth_fill(s, ball, &m);
    return s;
}

static struct brume_options options(int taps, bool adaptive)
{
    struct brume_options o = BRUME_OPTIONS_INIT;
    o.width = o.height = SIDE;
    o.integrator = BRUME_INTEGRATOR_PHOTON;
    o.backend = BRUME_BACKEND_CPU;
    o.spp = 2;
    o.threads = 1;
    o.photons.count = 2000;
    o.photons.spacing = 0.125;
    o.photons.taps = taps;
    o.photons.adaptive = adaptive;
    if (!adaptive)
        assert_true(brume_film_taps(&o.photons, taps));
    return o;
}

static void push(struct brume_film *film, struct brume_options *o, int frame)
{
    o->frame = (uint32_t)frame;
    assert_true(
        brume_film_push(film, fog_ball(0.05 * frame), o, true, truth_error()));
}

static void take(struct brume_film *film, int frame, struct made *out)
{
    struct brume_frame f;
    assert_true(brume_film_next(film, &f, truth_error()));
    memcpy(out->pixel[frame], f.radiance, sizeof out->pixel[frame]);
    out->frames[f.stats.worker]++;
    brume_frame_free(&f);
}

/* As the front end does it: reads ahead, and asks for a picture more than
 * there are workers. */
static void make_film(struct brume_options o, int workers, struct made *out)
{
    struct brume_film *film = brume_film_new(NULL, truth_error());
    int reach = brume_film_reach(&o), pushed = 0, taken = 0;
    memset(out, 0, sizeof *out);
    assert_true(brume_film_workers(film, workers, truth_error()));
    brume_film_begin(film, &o);
    for (int i = 0; i < FRAMES; i++) {
        while (pushed < FRAMES && pushed <= i + reach)
            push(film, &o, pushed++);
        assert_true(
            brume_film_ask(film, (uint32_t)i, 0, FRAMES - 1, truth_error()));
        assert_true(brume_film_forget(
            film, (uint32_t)(i + 1 > reach ? i + 1 - reach : 0),
            truth_error()));
        if (i >= workers)
            take(film, taken++, out);
    }
    while (taken < FRAMES)
        take(film, taken++, out);
    brume_film_free(film);
}

static void workers__have_the_pictures_of_one(void **state)
{
    static const struct {
        int taps;
        bool adaptive;
    } filter[] = {{1, false}, {5, false}, {9, true}};
    static struct made one, many;
    (void)state;
    for (size_t i = 0; i < sizeof filter / sizeof *filter; i++) {
        struct brume_options o = options(filter[i].taps, filter[i].adaptive);
        make_film(o, 1, &one);
        assert_int_equal(one.frames[0], FRAMES);
        o.threads = 3; /* one and one; the steps of frames overlap */
        make_film(o, 1, &many);
        assert_memory_equal(one.pixel, many.pixel, sizeof one.pixel);
        for (int workers = 2; workers <= 5; workers += 3) {
            int busy = 0;
            make_film(o, workers, &many);
            assert_memory_equal(one.pixel, many.pixel, sizeof one.pixel);
            for (int k = 0; k < MOST; k++)
                busy += many.frames[k] > 0;
            assert_true(busy > 1);
        }
    }
    assert_true(memcmp(one.pixel[0], one.pixel[1], sizeof one.pixel[0]) != 0);
}

static void workers__are_chosen_before_the_first_frame(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct brume_options o = options(1, false);
    struct brume_film *film = brume_film_new(NULL, truth_error());
    assert_false(brume_film_workers(film, 0, &err));
    assert_false(brume_film_workers(film, BRUME_MAX_WORKERS + 1, &err));
    push(film, &o, 0);
    err = (struct brume_error){0};
    assert_false(brume_film_workers(film, 2, &err));
    assert_non_null(strstr(err.text, "begun"));
    brume_film_free(film);
}

static void workers__begin_once_or_never(void **state)
{
    (void)state;
    struct brume_options o = options(1, false);
    struct brume_film *film = brume_film_new(NULL, truth_error());
    brume_film_begin(film, &o);
    brume_film_begin(film, &o);
    brume_film_free(film);
    film = brume_film_new(NULL, truth_error());
    push(film, &o, 0);
    brume_film_begin(film, &o);
    assert_true(brume_film_ask(film, 0, 0, 0, truth_error()));
    struct brume_frame f = {0};
    assert_true(brume_film_next(film, &f, truth_error()));
    brume_frame_free(&f);
    brume_film_free(film);
}

static bool stop_it(void *user, const struct brume_progress *progress)
{
    (void)progress;
    ++*(int *)user;
    return false;
}

/* A scene of whose preparing something is told. */
static brume_scene *with_nothing(void)
{
    struct brume_medium m = truth_medium(0.3, 3.0, 0.0);
    struct brume_shape ball = BRUME_SHAPE_INIT;
    brume_scene *s = fog_ball(0.0);
    ball.radius = 0.0;
    truth_fill(s, ball, &m);
    return s;
}

struct told {
    bool rendering, prepared;
};

static bool until_prepared(void *user, const struct brume_progress *progress)
{
    struct told *told = user;
    told->rendering = told->rendering || strcmp(progress->stage, "path") == 0;
    return !(told->rendering && told->prepared);
}

static void on_warn(void *user, const char *text)
{
    struct told *told = user;
    assert_non_null(strstr(text, "without extent"));
    told->prepared = true;
}

/* If not, the first picture is finished before the second is prepared. */
static void workers__prepare_while_they_render(void **state)
{
    (void)state;
    struct told told = {false, false};
    struct brume_error err = {0};
    struct brume_frame f;
    struct brume_film_events events = {&told, until_prepared, on_warn};
    struct brume_options o = options(1, false);
    struct brume_film *film = brume_film_new(&events, truth_error());
    o.threads = 2;
    o.spp = 1 << 17;
    push(film, &o, 0);
    assert_true(brume_film_ask(film, 0, 0, 1, truth_error()));
    o.frame = 1;
    assert_true(brume_film_push(film, with_nothing(), &o, true, truth_error()));
    assert_false(brume_film_next(film, &f, &err));
    assert_int_equal(err.code, BRUME_STOPPED);
    assert_true(told.rendering && told.prepared);
    brume_film_free(film);
}

/* The middle one of as many frames as its filter wants, of all of which there
 * will be pictures, or of it alone; its bytes, 0: it failed. */
static uint64_t middle_bytes(uint64_t memory, bool all)
{
    struct brume_error err = {0};
    struct brume_frame f;
    struct brume_options o = options(9, true);
    struct brume_film *film = brume_film_new(NULL, truth_error());
    o.threads = 0;
    o.memory = memory;
    for (int i = 0; i < 9; i++) {
        o.frame = (uint32_t)i;
        assert_true(brume_film_push(film, fog_ball(0.05 * i), &o, all || i == 4,
                                    truth_error()));
    }
    assert_true(brume_film_ask(film, 4, 0, 8, truth_error()));
    bool good = brume_film_next(film, &f, &err);
    assert_int_equal(err.code, good ? BRUME_OK : BRUME_ERR_MEMORY);
    uint64_t bytes = good ? f.stats.bytes : 0;
    brume_frame_free(&f);
    brume_film_free(film);
    return bytes;
}

/* Under a limit scenes that wait for pictures count, in each run alike. */
static void workers__keep_to_memory(void **state)
{
    (void)state;
    uint64_t much = (uint64_t)1 << 40, bytes = middle_bytes(much, true);
    uint64_t less = middle_bytes(much, false);
    assert_true(less > 0 && bytes > less + (uint64_t)8 * SIDE * SIDE * 3);
    assert_int_equal(middle_bytes(bytes, true), bytes);
    assert_int_equal(middle_bytes(bytes - 1, true), 0);
}

static void workers__stop_all(void **state)
{
    (void)state;
    int calls = 0;
    struct brume_error err = {0};
    struct brume_frame f;
    struct brume_film_events events = {.user = &calls, .progress = stop_it};
    struct brume_options o = options(1, false);
    struct brume_film *film = brume_film_new(&events, truth_error());
    assert_true(brume_film_workers(film, 3, truth_error()));
    o.spp = 1 << 20;
    for (int i = 0; i < 3; i++) {
        push(film, &o, i);
        assert_true(brume_film_ask(film, (uint32_t)i, 0, 2, truth_error()));
    }
    assert_false(brume_film_next(film, &f, &err));
    assert_int_equal(err.code, BRUME_STOPPED);
    assert_true(calls > 0);
    brume_film_free(film);
}

static void workers__devices_need_a_gpu(void **state)
{
    (void)state;
    char why[256] = "";
    struct brume_options o = options(1, false);
    assert_int_equal(brume_film_devices(&o, why, sizeof why), 0);
    assert_non_null(strstr(why, "the CPU is asked for"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(workers__have_the_pictures_of_one),
        cmocka_unit_test(workers__are_chosen_before_the_first_frame),
        cmocka_unit_test(workers__begin_once_or_never),
        cmocka_unit_test(workers__prepare_while_they_render),
        cmocka_unit_test(workers__keep_to_memory),
        cmocka_unit_test(workers__stop_all),
        cmocka_unit_test(workers__devices_need_a_gpu),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
