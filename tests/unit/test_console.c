#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include "parser/console.h"
#include "tests/unit/temp_folder.h"

/* ---- a console that writes to the file "said" -------------------------- */

static struct options options;
static struct console console;
static struct diag diag;
static FILE *said;

static bool open_with(const char *const *word, bool terminal)
{
    struct brume_error err = {0};
    int count = 0;
    while (word[count])
        count++;
    said = fopen("said", "w");
    assert_non_null(said);
    diag_init(&diag);
    options_init(&options);
    assert_true(options_read_words(&options, count, word, &diag));
    return console_open(&console, &options, said, terminal, &err);
}

#define OPEN(...)                                                              \
    assert_true(open_with((const char *const[]){__VA_ARGS__, NULL}, false))

static void close_all(void)
{
    console_close(&console);
    options_release(&options);
    diag_release(&diag);
    fclose(said);
}

static void assert_file(const char *path, const char *expected)
{
    char text[1024];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(text, expected);
}

static void add_warning(const char *text, int line)
{
    diag_add(&diag, &(struct diag_item){
                        .severity = DIAG_WARNING,
                        .text = text,
                        .file = "s.pov",
                        .line = line,
                        .column = 1,
                    });
}

/* ---- cases ------------------------------------------------------------- */

static void test_console__warnings_once(void **state)
{
    (void)state;
    OPEN("s.pov");
    add_warning("mind the gap", 3);
    console_diag(&console, &diag);
    add_warning("mind the gap", 4);
    console_diag(&console, &diag);
    close_all();
    assert_file("said", "s.pov:3:1: warning: mind the gap\n"
                        "s.pov:4:1: warning: mind the gap\n");
}

static void test_console__errors_always(void **state)
{
    (void)state;
    OPEN("s.pov", "+GFfatal.txt", "-GA", "+WL0");
    add_warning("mind the gap", 3);
    diag_error(&diag, BRUME_ERR_SCENE, "wrong");
    console_diag(&console, &diag);
    console_diag(&console, &diag);
    console_message(&console, PARSE_DEBUG, "hidden\n");
    close_all();
    assert_file("said", "error: wrong\nerror: wrong\n");
    assert_file("fatal.txt", "error: wrong\nerror: wrong\n");
}

static void test_console__copies(void **state)
{
    (void)state;
    OPEN("s.pov", "+GDdebug.txt", "+GAall.txt", "-GD", "+GWwarning.txt");
    console_message(&console, PARSE_DEBUG, "one\n");
    console_message(&console, PARSE_WARNING, "two");
    add_warning("two", 2);
    console_diag(&console, &diag);
    close_all();
    assert_file("said", "s.pov:2:1: warning: two\n");
    assert_file("warning.txt", "s.pov:2:1: warning: two\n");
    assert_file("debug.txt", "one\n");
    assert_file("all.txt", "one\ns.pov:2:1: warning: two\n");
    OPEN("s.pov", "+GDdebug.txt", "+GP");
    console_message(&console, PARSE_DEBUG, "three\n");
    close_all();
    assert_file("said", "three\n");
    assert_file("debug.txt", "one\nthree\n");
}

static void test_console__no_file(void **state)
{
    (void)state;
    const char *const words[] = {"s.pov", "+GDnowhere/debug.txt", NULL};
    assert_false(open_with(words, false));
    close_all();
}

static const struct reel_record record = {
    .picture = "a.png",
    .stats = {.backend = "cpu",
              .spp = 16,
              .error = 0.034,
              .seconds_prepare = 0.25,
              .seconds_render = 2,
              .bytes = 2048},
    .seconds_parse = 0.5,
    .seconds_write = 0.25,
};
static const char line[] =
    "a.png: 16 samples a pixel, error 3.4 %, 3 s (scene 0.5, preparing 0.25, "
    "rendering 2), 2 KiB, cpu\n";

static void test_console__frames(void **state)
{
    (void)state;
    OPEN("s.pov", "Statistic_File=stats.txt");
    console_finished(&console, &record);
    close_all();
    assert_file("said", "");
    assert_file("stats.txt", line);
    OPEN("s.pov", "+V");
    console_finished(&console, &record);
    close_all();
    assert_file("said", line);
    assert_true(open_with((const char *const[]){"s.pov", NULL}, true));
    console_finished(&console, &record);
    close_all();
    assert_file("said", line);
    assert_true(open_with((const char *const[]){"s.pov", "-V", NULL}, true));
    console_finished(&console, &record);
    close_all();
    assert_file("said", "");
}

static void test_console__progress(void **state)
{
    (void)state;
    struct frames frames = {.animation = true, .last = 9};
    struct brume_progress progress = {
        .stage = "path",
        .fraction = 1,
        .seconds = 2,
        .rate = 1e6,
        .item = "paths",
    };
    char text[256] = "";
    OPEN("s.pov", "--progress", "json");
    console_frame(&console, &frames, 3);
    console_progress(&console, &progress);
    close_all();
    FILE *file = fopen("said", "r");
    assert_non_null(fgets(text, sizeof text, file));
    fclose(file);
    assert_non_null(strstr(text, "\"stage\":\"3/9 path\""));
    assert_non_null(strstr(text, "\"fraction\":1"));
    OPEN("s.pov");
    console_progress(&console, &progress);
    close_all();
    assert_file("said", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_console__warnings_once),
        cmocka_unit_test(test_console__errors_always),
        cmocka_unit_test(test_console__copies),
        cmocka_unit_test(test_console__no_file),
        cmocka_unit_test(test_console__frames),
        cmocka_unit_test(test_console__progress),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
