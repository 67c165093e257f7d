#include <dirent.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>
#include "lib/output.h"
#include "lib/progress.h"
#include "lib/thread.h"

static char folder[] = "/tmp/brume-test-output-XXXXXX";
static char path[256];

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof path, "%s/out.json", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

static int entries(void)
{
    int count = 0;
    DIR *d = opendir(folder);
    while (readdir(d))
        count++;
    closedir(d);
    return count - 2;
}

static void assert_content(const char *name, const char *expected)
{
    char text[64] = "";
    FILE *f = fopen(name, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    assert_string_equal(text, expected);
}

static void test_output__appears_when_complete(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct output *o = output_open(path, &err);
    assert_non_null(o);
    fputs("new", output_stream(o));
    fflush(output_stream(o));
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(entries(), 1);
    assert_true(output_commit(o, &err));
    assert_content(path, "new");
    assert_int_equal(entries(), 1);
}

static void test_output__discard_leaves_the_old(void **state)
{
    (void)state;
    assert_true(output_write(path, "old", 3, NULL));
    struct output *o = output_open(path, NULL);
    assert_non_null(o);
    fputs("half", output_stream(o));
    output_discard(o);
    assert_content(path, "old");
    assert_int_equal(entries(), 1);
}

static void test_output__keeps_permissions_and_links(void **state)
{
    (void)state;
    char link[300];
    struct stat st;
    snprintf(link, sizeof link, "%s/link", folder);
    assert_true(output_write(path, "a", 1, NULL));
    assert_int_equal(chmod(path, 0640), 0);
    assert_int_equal(symlink("out.json", link), 0);
    assert_true(output_write(link, "b", 1, NULL));
    assert_int_equal(lstat(link, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    unlink(link);
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 0777, 0640);
    assert_content(path, "b");
}

static void test_output__error_names_path_and_reason(void **state)
{
    (void)state;
    struct brume_error err = {0};
    assert_null(output_open("/no/such/folder/x.png", &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    assert_non_null(strstr(err.text, "/no/such/folder/x.png"));
    assert_non_null(strstr(err.text, "No such file or directory"));
    err = (struct brume_error){0};
    assert_null(output_open(folder, &err));
    assert_non_null(strstr(err.text, "Is a directory"));
}

/* /dev/full refuses every byte; a device is written in place. */
static void test_output__full_disk_is_an_error(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0)
        skip();
    struct brume_error err = {0};
    assert_false(output_write("/dev/full", "x", 1, &err));
    assert_int_equal(err.code, BRUME_ERR_FILE);
    assert_non_null(strstr(err.text, "No space left"));
    assert_true(output_write("/dev/null", "x", 1, NULL));
}

/* ---- thread.h ---- */

enum { COUNT = 1000 };

struct job {
    int runs[COUNT];
    atomic_int highest_thread;
    atomic_bool cancel;
    size_t cancel_at;
};

static void body(void *context, size_t index, int thread)
{
    struct job *job = context;
    job->runs[index]++;
    if (thread > job->highest_thread)
        job->highest_thread = thread;
    if (index == job->cancel_at)
        job->cancel = true;
}

static void test_thread__runs_each_index_once(void **state)
{
    (void)state;
    for (int threads = 0; threads < 9; threads++) {
        struct job job = {.cancel_at = SIZE_MAX};
        assert_true(parallel_for(threads, COUNT, body, &job, &job.cancel));
        for (int i = 0; i < COUNT; i++)
            assert_int_equal(job.runs[i], 1);
        if (threads > 0)
            assert_in_range(job.highest_thread, 0, threads - 1);
    }
    struct job none = {.cancel_at = SIZE_MAX};
    assert_true(parallel_for(4, 0, body, &none, NULL));
    assert_in_range(thread_processors(), 1, 1 << 20);
}

static void test_thread__cancel_stops(void **state)
{
    (void)state;
    struct job job = {.cancel_at = 10};
    assert_false(parallel_for(1, COUNT, body, &job, &job.cancel));
    assert_int_equal(job.runs[10], 1);
    assert_int_equal(job.runs[11], 0);
}

/* ---- progress.h ---- */

static void test_progress__line_tells_what_is_left(void **state)
{
    (void)state;
    char text[200];
    struct progress_report r = {"march", 0.25, 2.4e7, "photons"};
    progress_line(&r, 20, text, sizeof text);
    assert_string_equal(text, "march       25 %  0:20, 1:00 left, "
                              "1.2 M photons/s");
    r = (struct progress_report){"gather", 0, 0, NULL};
    progress_line(&r, 4000, text, sizeof text);
    assert_string_equal(text, "gather       0 %  1:06:40, ? left");
}

static void test_progress__json_is_one_object_a_line(void **state)
{
    (void)state;
    char text[200];
    struct progress_report r = {"march", 0.5, 100, "rays"};
    progress_json(&r, 2, text, sizeof text);
    assert_string_equal(text, "{\"stage\":\"march\",\"fraction\":0.500000,"
                              "\"elapsed_s\":2.000,\"left_s\":2.000,"
                              "\"rate\":50,\"unit\":\"rays\"}\n");
}

/* Of a thousand reports in a moment: the first of each stage and the last. */
static void test_progress__shows_few_reports(void **state)
{
    (void)state;
    int ends[2];
    char text[4096];
    struct progress p;
    assert_int_equal(pipe(ends), 0);
    progress_init(&p, PROGRESS_LINE, ends[1]);
    assert_int_equal(p.mode, PROGRESS_OFF);
    progress_init(&p, PROGRESS_JSON, ends[1]);
    for (int i = 0; i <= 1000; i++) {
        struct progress_report r = {i < 500 ? "emit" : "march", i / 1000.0, i,
                                    "photons"};
        progress_update(&p, &r);
    }
    progress_clear(&p);
    close(ends[1]);
    ssize_t size = read(ends[0], text, sizeof text);
    close(ends[0]);
    int lines = 0;
    for (ssize_t i = 0; i < size; i++)
        lines += text[i] == '\n';
    assert_in_range(lines, 3, 5);
}

static void *sweep_for_long(void *stop)
{
    while (!atomic_load((atomic_bool *)stop))
        output_sweep(path);
    return NULL;
}

/* Another run that begins in the folder takes nothing away that is being
 * written, nor what is just given its name. */
static void test_output__is_not_swept_away(void **state)
{
    (void)state;
    enum { TIMES = 1500 };
    atomic_bool stop = false;
    pthread_t sweeper[2];
    for (int i = 0; i < 2; i++)
        assert_int_equal(
            pthread_create(&sweeper[i], NULL, sweep_for_long, &stop), 0);
    int failed = 0;
    for (int i = 0; i < TIMES; i++) {
        struct brume_error err = {0};
        struct output *o = output_open(path, &err);
        if (o) {
            fputs("text", output_stream(o));
            output_hurry(o);
        }
        failed += !o || !output_commit(o, &err);
    }
    atomic_store(&stop, true);
    for (int i = 0; i < 2; i++)
        pthread_join(sweeper[i], NULL);
    assert_int_equal(failed, 0);
    assert_content(path, "text");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_output__appears_when_complete),
        cmocka_unit_test(test_output__discard_leaves_the_old),
        cmocka_unit_test(test_output__keeps_permissions_and_links),
        cmocka_unit_test(test_output__error_names_path_and_reason),
        cmocka_unit_test(test_output__full_disk_is_an_error),
        cmocka_unit_test(test_output__is_not_swept_away),
        cmocka_unit_test(test_thread__runs_each_index_once),
        cmocka_unit_test(test_thread__cancel_stops),
        cmocka_unit_test(test_progress__line_tells_what_is_left),
        cmocka_unit_test(test_progress__json_is_one_object_a_line),
        cmocka_unit_test(test_progress__shows_few_reports),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
