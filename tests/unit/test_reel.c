#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "parser/reel.h"
#include "tests/unit/temp_folder.h"

/* ---- what happens, as a text ------------------------------------------- */

static char told[4096];
static int finished, stop_after;

static void tell(const char *format, ...)
{
    size_t used = strlen(told);
    va_list args;
    va_start(args, format);
    vsnprintf(told + used, sizeof told - used, format, args);
    va_end(args);
}

static void on_report(void *user, const struct diag *diag)
{
    (void)user;
    for (const struct diag_item *i = diag->first; i; i = i->next)
        tell("%s: %s; ", i->severity == DIAG_ERROR ? "error" : "warning",
             i->text);
}

static void on_message(void *user, enum parse_stream stream, const char *text)
{
    (void)user;
    if (stream == PARSE_DEBUG)
        tell("%s; ", text);
}

static void on_frame(void *user, const struct frames *frames, int number)
{
    (void)user;
    (void)frames;
    tell("frame %d; ", number);
}

static void on_planned(void *user, const struct brume_plan *plan)
{
    (void)user;
    tell("plan %d; ", plan->stages > 0);
}

static void on_progress(void *user, const struct brume_progress *progress)
{
    (void)user;
    assert_true(progress->fraction >= 0 && progress->fraction <= 1);
}

static void on_finished(void *user, const struct reel_record *record)
{
    (void)user;
    finished++;
    tell("%s; ", record->picture ? record->picture : "none");
}

static void on_skipped(void *user, const char *picture)
{
    (void)user;
    tell("skipped %s; ", picture);
}

static bool on_stopped(void *user)
{
    (void)user;
    return stop_after >= 0 && finished >= stop_after;
}

/* Runs a scene, given as a text, with these options. */
#define RUN(scene, ...)                                                        \
    run_words(scene, (const char *const[]){"+W2", "+H2", "--spp=1",            \
                                           __VA_ARGS__, NULL})

static enum brume_code run_words(const char *scene, const char *const *word)
{
    struct options options;
    struct diag diag;
    struct reel reel;
    int count = 0;
    FILE *in = fmemopen((void *)(uintptr_t)scene, strlen(scene), "r");
    assert_non_null(in);
    const struct reel_events events = {
        .report = on_report,
        .message = on_message,
        .frame = on_frame,
        .planned = on_planned,
        .progress = on_progress,
        .finished = on_finished,
        .skipped = on_skipped,
        .stopped = on_stopped,
        .in = in,
        .out = stderr,
    };
    while (word[count])
        count++;
    *told = '\0';
    finished = 0;
    diag_init(&diag);
    options_init(&options);
    assert_true(options_read_words(&options, count, word, &diag));
    enum brume_code code = reel_run(&reel, &options, &events);
    assert_int_equal(reel.records, (size_t)finished);
    reel_release(&reel);
    options_release(&options);
    diag_release(&diag);
    fclose(in);
    return code;
}

static bool is_there(const char *path)
{
    return access(path, F_OK) == 0;
}

/* ---- cases ------------------------------------------------------------- */

static const char clock_scene[] = "#debug concat(\"clock \", str(clock, 0, 2))";

static void test_reel__still(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(clock_scene, "-"), BRUME_OK);
    assert_string_equal(told, "clock 0.00; frame 0; stdin.png; ");
    assert_true(is_there("stdin.png"));
    assert_int_equal(RUN(clock_scene, "-", "-F"), BRUME_OK);
    assert_string_equal(told, "clock 0.00; frame 0; none; ");
}

static void test_reel__film(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(clock_scene, "-", "+KFF10", "+STP4", "+Oa.exr"),
                     BRUME_OK);
    assert_string_equal(told, "clock 0.00; clock 0.44; frame 1; clock 0.89; "
                              "a01.exr; frame 5; a05.exr; "
                              "frame 9; a09.exr; ");
    assert_true(is_there("a01.exr") && is_there("a09.exr"));
}

static void test_reel__check_and_explain(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(clock_scene, "-", "+KFF2", "--check", "+Oc"),
                     BRUME_OK);
    assert_string_equal(told, "frame 1; clock 0.00; frame 2; clock 1.00; ");
    assert_int_equal(RUN(clock_scene, "-", "+KFF2", "--explain", "+Oc"),
                     BRUME_OK);
    assert_string_equal(told, "frame 1; clock 0.00; plan 1; ");
    assert_false(is_there("c1.png"));
}

static void test_reel__failing_frame(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(
        RUN("#if (frame_number = 2) #error \"no\" #end", "-", "+KFF3", "+Of"),
        BRUME_ERR_SCENE);
    assert_true(is_there("f1.png"));
    assert_false(is_there("f2.png") || is_there("f3.png"));
    assert_non_null(strstr(told, "; frame 1; f1.png; "));
    assert_memory_equal(told, "error: ", 7);
    assert_null(strstr(told, "frame 2"));
}

static void test_reel__stopped(void **state)
{
    (void)state;
    stop_after = 2;
    assert_int_equal(RUN(clock_scene, "-", "+KFF4", "+Os"), BRUME_STOPPED);
    assert_int_equal(finished, 2);
    assert_true(is_there("s2.png"));
    assert_false(is_there("s3.png"));
    assert_null(strstr(told, "error"));
    /* A film that was finished when the signal came is finished. */
    assert_int_equal(RUN(clock_scene, "-", "+KFF2", "+Os"), BRUME_OK);
    stop_after = 0;
    assert_int_equal(RUN(clock_scene, "-", "+Onone"), BRUME_STOPPED);
    assert_false(is_there("none.png"));
}

static void test_reel__before_the_first_frame(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(" ", "missing.pov"), BRUME_ERR_FILE);
    assert_string_equal(told, "error: can't find the scene 'missing.pov'; ");
    assert_int_equal(RUN(" ", "-", "+SC3"), BRUME_ERR_USAGE);
    assert_string_equal(told, "error: start column 3 lies beyond the last, "
                              "2; ");
    assert_int_equal(RUN(" ", "+KFF2"), BRUME_ERR_USAGE);
    assert_string_equal(told, "error: no scene is given; ");
}

static void test_reel__foreign_extension(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(" ", "-", "+Oz.jpg"), BRUME_OK);
    assert_string_equal(told, "warning: .jpg pictures are not supported yet: "
                              "the file will be 'z.jpg.png'; "
                              "frame 0; z.jpg.png; ");
}

static void test_reel__unwritable_picture(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(" ", "-", "+Onowhere/a.png"), BRUME_ERR_FILE);
    assert_non_null(strstr(told, "nowhere/a.png"));
    assert_int_equal(finished, 0);
}

static void test_reel__resumed(void **state)
{
    (void)state;
    stop_after = 1;
    assert_int_equal(RUN(clock_scene, "-", "+KFF3", "+Or"), BRUME_STOPPED);
    stop_after = -1;
    assert_int_equal(RUN(clock_scene, "-", "+KFF3", "+Or", "--resume"),
                     BRUME_OK);
    assert_string_equal(told, "skipped r1.png; clock 0.50; clock 1.00; "
                              "frame 2; r2.png; frame 3; r3.png; ");
    /* Another seed, another picture. */
    assert_int_equal(RUN(clock_scene, "-", "+KFF3", "+Or", "+C", "--seed=1"),
                     BRUME_OK);
    assert_null(strstr(told, "skipped"));
    assert_int_equal(RUN(clock_scene, "-", "+KFF3", "+Or", "--seed=1"),
                     BRUME_OK);
    assert_null(strstr(told, "skipped"));
}

static void test_reel__shards(void **state)
{
    (void)state;
    stop_after = -1;
    assert_int_equal(RUN(clock_scene, "-", "+KFF5", "+Op", "--shard=2/3"),
                     BRUME_OK);
    assert_string_equal(told, "clock 0.25; clock 0.50; frame 2; p2.png; "
                              "frame 3; p3.png; ");
    assert_int_equal(RUN(clock_scene, "-", "+KFF2", "+Oq", "--shard=2/5"),
                     BRUME_OK);
    assert_string_equal(told, "");
    unsetenv("SLURM_ARRAY_TASK_ID");
    unsetenv("SLURM_STEP_NUM_TASKS");
    assert_int_equal(RUN(clock_scene, "-", "+KFF2", "--shard=slurm"),
                     BRUME_ERR_USAGE);
    assert_non_null(strstr(told, "SLURM_ARRAY_TASK_ID"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reel__still),
        cmocka_unit_test(test_reel__film),
        cmocka_unit_test(test_reel__check_and_explain),
        cmocka_unit_test(test_reel__failing_frame),
        cmocka_unit_test(test_reel__stopped),
        cmocka_unit_test(test_reel__resumed),
        cmocka_unit_test(test_reel__shards),
        cmocka_unit_test(test_reel__before_the_first_frame),
        cmocka_unit_test(test_reel__foreign_extension),
        cmocka_unit_test(test_reel__unwritable_picture),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
