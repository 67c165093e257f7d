/* test_directive.c - the front end against texts that mean harm, folders that
 * are off limits, and memory that runs out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/parse.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- reading a text ---------------------------------------------------- */

struct outcome {
    int code; /* BRUME_OK, or that of the first error        */
    int line, column;
    char text[256];
};

static struct outcome read_input(const struct parse_input *in)
{
    struct parse_result result;
    struct diag diag;
    struct outcome outcome = {.code = BRUME_OK};
    diag_init(&diag);
    bool done = parse_scene(in, &result, &diag);
    assert_int_equal(done, diag.errors == 0);
    assert_true(diag.errors <= 1);
    for (const struct diag_item *i = diag.first; i; i = i->next) {
        if (i->severity == DIAG_ERROR) {
            outcome.line = i->line;
            outcome.column = i->column;
            snprintf(outcome.text, sizeof outcome.text, "%s", i->text);
        }
    }
    outcome.code = diag.code;
    brume_scene_free(result.scene);
    diag_release(&diag);
    return outcome;
}

static struct outcome read_bytes(const char *text, size_t length)
{
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = length,
                             .ambient = PARSE_AMBIENT_INIT};
    in.limits.iterations = 10000;
    in.limits.memory = (size_t)1 << 30;
    return read_input(&in);
}

static struct outcome read_text(const char *text)
{
    return read_bytes(text, strlen(text));
}

/* `head`, `unit` so many times, `tail`. */
static struct outcome read_repeated(const char *head, const char *unit,
                                    size_t count, const char *tail)
{
    size_t step = strlen(unit), at = strlen(head);
    char *text = malloc(at + step * count + strlen(tail) + 1);
    assert_non_null(text);
    memcpy(text, head, at);
    for (size_t i = 0; i < count; i++, at += step) {
        memcpy(text + at, unit, step);
    }
    strcpy(text + at, tail);
    struct outcome outcome = read_text(text);
    free(text);
    return outcome;
}

/* ---- nesting and length ------------------------------------------------ */

enum { DEEP = 1200000 };

static void test_brackets_are_limited(void **state)
{
    (void)state;
    const char *const unit[] = {"(", "-", "<", "sin(", "rgb ", "(1?", "!"};
    for (size_t i = 0; i < sizeof unit / sizeof *unit; i++) {
        struct outcome got = read_repeated("#declare A = ", unit[i], DEEP, "");
        assert_int_equal(got.code, BRUME_ERR_LIMIT);
        assert_non_null(strstr(got.text, "nested deeper"));
    }
}

static void test_indices_are_limited(void **state)
{
    (void)state;
    struct outcome got = read_repeated("#declare A = array[1] {0}\n"
                                       "#declare B = ",
                                       "A[", DEEP, "");
    assert_int_equal(got.code, BRUME_ERR_LIMIT);
}

static void test_values_in_values_are_limited(void **state)
{
    (void)state;
    struct outcome got = read_repeated("", "#declare A = array[1] { ", DEEP,
                                       "");
    assert_int_equal(got.code, BRUME_ERR_LIMIT);
    got = read_repeated("#macro M(A) #end\n", "M(1+", DEEP, "");
    assert_int_equal(got.code, BRUME_ERR_LIMIT);
}

static void test_blocks_may_be_deep(void **state)
{
    (void)state;
    struct outcome got = read_repeated("", "#if (1) ", DEEP, "");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
    assert_string_equal(got.text, "'#if' has no '#end'");
    got = read_repeated("#if (0) ", "#if (1) #else #end ", DEEP, "#end");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#if (0) ", "#while (1) ", DEEP, "");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
}

static void test_comments_may_be_deep(void **state)
{
    (void)state;
    struct outcome got = read_repeated("", "/*", DEEP, "");
    assert_string_equal(got.text, "comment is not closed");
    assert_int_equal(got.column, 1);
}

static void test_long_lists(void **state)
{
    (void)state;
    struct outcome got = read_repeated("#declare A = max(0", ", 1", 300000,
                                       ");");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#declare A = <0", ", 1", 300000, ">;");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#declare A = 1 + <0", ", 1", 300000, ">;");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
    got = read_repeated("#declare A = 0", " + 1", 300000, ";");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#macro M(A", ", B", 300000, ") #end M(1)");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
}

static void test_long_words(void **state)
{
    (void)state;
    struct outcome got = read_repeated("#debug ", "A", 65536, "");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
    got = read_repeated("#declare ", "A", 65536, " = 1;");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#declare A = ", "9", 1000000, ";");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#declare A = \"", "a", 5000000, "\";");
    assert_int_equal(got.code, BRUME_OK);
    got = read_repeated("#error \"", "a", 100000, "\"");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
    got = read_repeated("#include \"", "a", 100000, "\"");
    assert_int_equal(got.code, BRUME_ERR_SCENE);
}

/* ---- bytes ------------------------------------------------------------- */

static void test_texts_of_nothing(void **state)
{
    (void)state;
    char nuls[4096] = {0};
    assert_int_equal(read_text("").code, BRUME_OK);
    assert_int_equal(read_text("\xEF\xBB\xBF").code, BRUME_OK);
    assert_int_equal(read_text(" \t\r\n\f\v\x1A").code, BRUME_OK);
    assert_int_equal(read_text("#").code, BRUME_OK);
    assert_int_equal(read_text("\"").code, BRUME_ERR_SCENE);
    assert_int_equal(read_text("\"\\").code, BRUME_ERR_SCENE);
    assert_int_equal(read_text("/*").code, BRUME_ERR_SCENE);
    assert_int_equal(read_text("//").code, BRUME_OK);
    assert_int_equal(read_bytes(nuls, sizeof nuls).code, BRUME_ERR_SCENE);
}

static void test_every_byte_alone(void **state)
{
    (void)state;
    for (int c = 0; c < 256; c++) {
        char text[] = {'#', 'd', 'e',     'b', 'u',    'g',
                       ' ', '"', (char)c, '"', (char)c};
        read_bytes(text, sizeof text);
    }
}

/* Texts with a few bytes, and pieces of others, put into them. */
static void test_broken_texts(void **state)
{
    (void)state;
    static const char *const seed[] = {
        "#declare A = array[3] {1,<1,2,3>,\"c\"} #debug str(A[0],0,0)",
        "#macro M(P Q) #local R = P; #declare Q = R * 2; #end "
        "#declare B = 1; M(3, B) #for (I, 0, 5, 1) M(I, B) #end",
        "#switch (3) #case (1) #break #range (2, 4) #debug \"x\" #else #end "
        "#while (defined(A)) #undef A #end #ifdef (x) #end",
        "#declare C = rgb <1, .5, 0> filter 0.1; #if (C.red = 1 & !0 ? 1 : 0) "
        "#debug concat(\"a\", vstr(3, C, \",\", 0, 1)) #elseif (2) #end",
        "#version 3.1; #declare D = 1 #include \"none\" /* a /* b */ */ // c",
    };
    enum { SEEDS = sizeof seed / sizeof *seed, ROUNDS = 20000, ROOM = 1024 };
    uint32_t random = 12345;
    char text[ROOM];
    for (int round = 0; round < ROUNDS; round++) {
        size_t length = 0;
        for (int piece = 0; piece < 3; piece++) {
            random = random * 1664525u + 1013904223u;
            const char *from = seed[(random >> 16) % SEEDS];
            random = random * 1664525u + 1013904223u;
            size_t skip = (random >> 8) % strlen(from);
            size_t left = strlen(from + skip);
            memcpy(text + length, from + skip, left);
            length += left;
        }
        for (int flip = 0; flip < round % 4; flip++) {
            random = random * 1664525u + 1013904223u;
            text[(random >> 8) % length] = (char)(random >> 24);
        }
        read_bytes(text, length);
    }
}

/* ---- files ------------------------------------------------------------- */

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static struct outcome read_file_in(const char *path, const char *const *allowed,
                                   size_t count)
{
    struct parse_input in = {.path = path,
                             .ambient = PARSE_AMBIENT_INIT,
                             .allow_read = allowed,
                             .allow_reads = count};
    return read_input(&in);
}

static int enter_folder(void **state)
{
    char folder[] = "/tmp/test_directive.XXXXXX";
    if (!mkdtemp(folder) || chdir(folder) != 0) {
        return -1;
    }
    *state = strdup(folder);
    mkdir("scene", 0700);
    mkdir("other", 0700);
    mkdir("scenery", 0700);
    write_file("other/secret.inc", "#declare Secret = 1;");
    write_file("scenery/near.inc", "");
    return 0;
}

static int leave_folder(void **state)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", (char *)*state);
    free(*state);
    return chdir("/") == 0 && system(command) == 0 ? 0 : -1;
}

static void test_links_are_followed_first(void **state)
{
    (void)state;
    assert_int_equal(symlink("../other/secret.inc", "scene/link.inc"), 0);
    write_file("scene/a.pov", "#include \"link.inc\"");
    struct outcome got = read_file_in("scene/a.pov", NULL, 0);
    assert_int_equal(got.code, BRUME_ERR_ACCESS);
    const char *const allowed[] = {"other"};
    assert_int_equal(read_file_in("scene/a.pov", allowed, 1).code, BRUME_OK);
}

static void test_a_folder_of_a_like_name_is_another(void **state)
{
    (void)state;
    write_file("scene/b.pov", "#include \"../scenery/near.inc\"");
    struct outcome got = read_file_in("scene/b.pov", NULL, 0);
    assert_int_equal(got.code, BRUME_ERR_ACCESS);
    assert_int_equal(got.column, 10);
}

static void test_the_working_folder_needs_permission(void **state)
{
    (void)state;
    write_file("work.inc", "");
    write_file("scene/c.pov", "#include \"work.inc\"");
    assert_int_equal(read_file_in("scene/c.pov", NULL, 0).code,
                     BRUME_ERR_ACCESS);
    const char *const allowed[] = {"."};
    assert_int_equal(read_file_in("scene/c.pov", allowed, 1).code, BRUME_OK);
}

static void test_pipes_are_no_texts(void **state)
{
    (void)state;
    assert_int_equal(mkfifo("scene/pipe.inc", 0600), 0);
    write_file("scene/d.pov", "#include \"pipe.inc\"");
    assert_int_equal(read_file_in("scene/d.pov", NULL, 0).code, BRUME_ERR_FILE);
}

static void test_files_next_to_an_included_one(void **state)
{
    (void)state;
    mkdir("scene/parts", 0700);
    write_file("scene/e.pov", "#include \"parts/one.inc\"");
    write_file("scene/parts/one.inc", "#include \"two.inc\"");
    write_file("scene/parts/two.inc", "");
    assert_int_equal(read_file_in("scene/e.pov", NULL, 0).code, BRUME_OK);
}

static void test_a_scene_that_is_not_there(void **state)
{
    (void)state;
    struct outcome got = read_file_in("scene/none.pov", NULL, 0);
    assert_int_equal(got.code, BRUME_ERR_FILE);
    assert_int_equal(got.line, 0);
    assert_int_equal(read_file_in("scene", NULL, 0).code, BRUME_ERR_FILE);
}

static void test_a_header_is_read_first(void **state)
{
    (void)state;
    struct parse_input in = {.path = "scene.pov",
                             .text = "#debug Greeting",
                             .length = 15,
                             .header = "header.inc",
                             .ambient = PARSE_AMBIENT_INIT};
    assert_int_equal(read_input(&in).code, BRUME_ERR_FILE);
    write_file("header.inc", "#declare Greeting = \"hello\";");
    assert_int_equal(read_input(&in).code, BRUME_OK);
}

/* ---- limits and interruption ------------------------------------------- */

static bool stop(void *user)
{
    int *asked = user;
    return ++*asked > 3;
}

static void test_the_caller_stops_it(void **state)
{
    (void)state;
    static const char text[] = "#for (I, 0, 1e9) #end";
    int asked = 0;
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = sizeof text - 1,
                             .stopped = stop,
                             .user = &asked,
                             .ambient = PARSE_AMBIENT_INIT};
    assert_int_equal(read_input(&in).code, BRUME_STOPPED);
}

static void test_time_is_limited(void **state)
{
    (void)state;
    static const char text[] = "#while (1) #end";
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = sizeof text - 1,
                             .ambient = PARSE_AMBIENT_INIT};
    in.limits.seconds = 0.05;
    struct outcome got = read_input(&in);
    assert_int_equal(got.code, BRUME_ERR_LIMIT);
    assert_non_null(strstr(got.text, "takes longer than"));
}

/* Whatever the memory, the end is orderly. */
static void test_memory_of_every_size(void **state)
{
    (void)state;
    static const char text[] =
        "#macro M(A,B) #local C = A + B; #declare B = concat(\"a\",\"b\"); "
        "#end\n#declare D = array[300] #for (I,0,299) #declare D[I] = "
        "<I,I,I>; #end #declare S = \"x\"; M(1, S)\n"
        "#declare R = seed(1); #if (rand(R) < Undeclared) #end";
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = sizeof text - 1,
                             .ambient = PARSE_AMBIENT_INIT};
    int limited = 0, complete = 0;
    for (size_t memory = 64; memory < 400000; memory += 1 + memory / 64) {
        in.limits.memory = memory;
        struct outcome got = read_input(&in);
        limited += got.code == BRUME_ERR_LIMIT;
        complete += got.code == BRUME_ERR_SCENE;
        assert_true(got.code == BRUME_ERR_LIMIT || got.code == BRUME_ERR_SCENE);
    }
    assert_true(limited > 100);
    assert_true(complete > 0);
}

int main(void)
{
    const struct CMUnitTest texts[] = {
        cmocka_unit_test(test_brackets_are_limited),
        cmocka_unit_test(test_indices_are_limited),
        cmocka_unit_test(test_values_in_values_are_limited),
        cmocka_unit_test(test_blocks_may_be_deep),
        cmocka_unit_test(test_comments_may_be_deep),
        cmocka_unit_test(test_long_lists),
        cmocka_unit_test(test_long_words),
        cmocka_unit_test(test_texts_of_nothing),
        cmocka_unit_test(test_every_byte_alone),
        cmocka_unit_test(test_broken_texts),
        cmocka_unit_test(test_the_caller_stops_it),
        cmocka_unit_test(test_time_is_limited),
        cmocka_unit_test(test_memory_of_every_size)};
    const struct CMUnitTest files[] = {
        cmocka_unit_test(test_links_are_followed_first),
        cmocka_unit_test(test_a_folder_of_a_like_name_is_another),
        cmocka_unit_test(test_the_working_folder_needs_permission),
        cmocka_unit_test(test_pipes_are_no_texts),
        cmocka_unit_test(test_files_next_to_an_included_one),
        cmocka_unit_test(test_a_scene_that_is_not_there),
        cmocka_unit_test(test_a_header_is_read_first)};
    int failed = cmocka_run_group_tests(texts, NULL, NULL);
    return failed + cmocka_run_group_tests(files, enter_folder, leave_folder);
}
