/* test_parse.c - scenes of tests/parse against what they must say.
 *
 * A file holds cases:
 *
 *     == name of the case
 *     the text of scene.pov
 *     -- file NAME          another text beside it
 *     -- set LIMIT NUMBER   a limit of struct parse_limits, or a predeclared
 *                           float; `standard 1`: with scenes/include
 *     -- out                what #debug writes, a line end added if there
 *                           is none; without it, nothing
 *     -- wrote NAME         what the scene writes to a file
 *     -- diag               the diagnostics; without it, none
 *
 * In a text, `%NUL` stands for a NUL byte and `%xHH` for any byte. With
 * POVRAY=1 in the environment, cases without diagnostics are also given to
 * POV-Ray, whose #debug output must be the same. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "parser/parse.h"
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- cases ------------------------------------------------------------- */

struct section {
    char *head; /* "file x.inc", "out", "diag", "set a 1"      */
    char *body;
    struct section *next;
};

struct test_case {
    char *name;
    struct section *section; /* the first one is the scene              */
};

static char *standard; /* scenes/include                          */
static struct test_case cases[2000];
static size_t case_count;

static char *read_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = calloc(1, 1 << 20);
    assert_non_null(file);
    assert_non_null(text);
    size_t length = fread(text, 1, (1 << 20) - 1, file);
    assert_true(length < (1 << 20) - 1);
    fclose(file);
    return text;
}

static struct section *add_section(struct section **tail, char *head)
{
    struct section *section = calloc(1, sizeof *section);
    assert_non_null(section);
    section->head = head;
    section->body = head + strlen(head);
    *tail = section;
    return section;
}

/* Cuts the text of a file into cases; it is kept. */
static void cut_cases(const char *file, char *text)
{
    struct section **tail = NULL;
    struct section *section = NULL;
    for (char *line = text, *next; line && *line; line = next) {
        next = strchr(line, '\n');
        bool begins = strncmp(line, "== ", 3) == 0;
        if (begins || (section && strncmp(line, "-- ", 3) == 0)) {
            assert_non_null(next);
            *line = 0;
            *next++ = 0;
            if (begins) {
                struct test_case *made = &cases[case_count++];
                assert_true(case_count < sizeof cases / sizeof *cases);
                assert_true(asprintf(&made->name, "%s: %s", file, line + 3) >
                            0);
                tail = &made->section;
            }
            section = add_section(tail, begins ? strdup("scene") : line + 3);
            section->body = next;
            tail = &section->next;
        } else if (next) {
            next++;
        }
    }
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void find_cases(const char *folder)
{
    char *files[200], path[600];
    size_t count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        size_t length = strlen(entry->d_name);
        if (length > 4 && strcmp(entry->d_name + length - 4, ".txt") == 0 &&
            count < 200) {
            files[count++] = strdup(entry->d_name);
        }
    }
    closedir(dir);
    qsort(files, count, sizeof *files, by_name);
    for (size_t i = 0; i < count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, files[i]);
        files[i][strlen(files[i]) - 4] = 0;
        cut_cases(files[i], read_file(path));
        free(files[i]);
    }
}

/* ---- running one ------------------------------------------------------- */

struct output {
    char *text;
    size_t length;
};

static void collect(void *user, enum parse_stream stream, const char *text)
{
    FILE *to = user;
    if (stream == PARSE_DEBUG) {
        fputs(text, to);
    }
}

/* Writes a text with its %xHH replaced. */
static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    while (*text) {
        unsigned byte;
        if (strncmp(text, "%NUL", 4) == 0) {
            fputc(0, file);
            text += 4;
        } else if (sscanf(text, "%%x%2x", &byte) == 1) {
            fputc((int)byte, file);
            text += 4;
        } else {
            fputc(*text++, file);
        }
    }
    fclose(file);
}

static const char *body_of(const struct test_case *test, const char *head)
{
    for (const struct section *s = test->section; s; s = s->next) {
        if (strcmp(s->head, head) == 0) {
            return s->body;
        }
    }
    return "";
}

static void set(struct parse_input *in, struct parse_declare *declare,
                const char *what)
{
    char name[64];
    double value;
    assert_int_equal(sscanf(what, "set %63s %lf", name, &value), 2);
    if (strcmp(name, "include_depth") == 0) {
        in->limits.include_depth = (int)value;
    } else if (strcmp(name, "macro_depth") == 0) {
        in->limits.macro_depth = (int)value;
    } else if (strcmp(name, "iterations") == 0) {
        in->limits.iterations = (uint64_t)value;
    } else if (strcmp(name, "tokens") == 0) {
        in->limits.tokens = (uint64_t)value;
    } else if (strcmp(name, "memory") == 0) {
        in->limits.memory = (size_t)value;
    } else if (strcmp(name, "standard") == 0) {
        in->libraries = 2;
    } else if (strcmp(name, "clock") == 0) {
        in->ambient.clock = value;
    } else if (strcmp(name, "frame_number") == 0) {
        in->ambient.frame_number = value;
    } else {
        declare->name = strdup(name);
        declare->value = value;
        in->declare = declare;
        in->declares = 1;
    }
}

/* Makes the case's files in the working folder. */
static void prepare(const struct test_case *test, struct parse_input *in,
                    struct parse_declare *declare)
{
    write_text("scene.pov", test->section->body);
    for (const struct section *s = test->section; s; s = s->next) {
        if (strncmp(s->head, "file ", 5) == 0) {
            write_text(s->head + 5, s->body);
        } else if (strncmp(s->head, "set ", 4) == 0) {
            set(in, declare, s->head);
        }
    }
}

static void clean(const struct test_case *test)
{
    unlink("scene.pov");
    for (const struct section *s = test->section; s; s = s->next) {
        if (strncmp(s->head, "file ", 5) == 0) {
            unlink(s->head + 5);
        } else if (strncmp(s->head, "wrote ", 6) == 0) {
            unlink(s->head + 6);
        }
    }
}

/* The files that the scene should have written. */
static void check_written(const struct test_case *test)
{
    for (const struct section *s = test->section; s; s = s->next) {
        if (strncmp(s->head, "wrote ", 6) == 0) {
            char *text = read_file(s->head + 6);
            size_t length = strlen(text);
            if (length > 0 && text[length - 1] != '\n') {
                text[length] = '\n';
            }
            assert_string_equal(text, s->body);
            free(text);
        }
    }
}

static void run_case(void **state)
{
    const struct test_case *test = *state;
    char *said = NULL, *wrong = NULL;
    size_t said_length, wrong_length;
    FILE *out = open_memstream(&said, &said_length);
    FILE *list = open_memstream(&wrong, &wrong_length);
    const char *const library[] = {"library", standard};
    const char *const here[] = {"."};
    struct parse_written written = {0};
    struct parse_declare declare = {0};
    struct parse_input in = {.path = "scene.pov",
                             .library = library,
                             .libraries = 1,
                             .allow_write = here,
                             .allow_writes = 1,
                             .written = &written,
                             .ambient = PARSE_AMBIENT_INIT,
                             .message = collect,
                             .user = out};
    struct parse_result result;
    struct diag diag;
    prepare(test, &in, &declare);
    diag_init(&diag);
    bool done = parse_scene(&in, &result, &diag);
    diag_write(&diag, list);
    if (!done) {
        fprintf(list, "code %d\n", (int)diag.code);
    }
    assert_int_equal(done, diag.errors == 0);
    brume_scene_free(result.scene);
    diag_release(&diag);
    fflush(out);
    if (said_length > 0 && said[said_length - 1] != '\n') {
        fputc('\n', out);
    }
    fclose(out);
    fclose(list);
    assert_string_equal(wrong, body_of(test, "diag"));
    assert_string_equal(said, body_of(test, "out"));
    check_written(test);
    clean(test);
    free(said);
    free(wrong);
    free((char *)declare.name);
    parse_written_release(&written);
}

int main(int argc, char **argv)
{
    char folder[] = "/tmp/test_parse.XXXXXX";
    find_cases(argc > 1 ? argv[1] : "tests/parse");
    standard = realpath("scenes/include", NULL);
    if (!mkdtemp(folder) || chdir(folder) != 0 || mkdir("library", 0700)) {
        return 1;
    }
    struct CMUnitTest *tests = calloc(case_count, sizeof *tests);
    for (size_t i = 0; tests && i < case_count; i++) {
        tests[i] = (struct CMUnitTest){.name = cases[i].name,
                                       .test_func = run_case,
                                       .initial_state = &cases[i]};
    }
    int failed = _cmocka_run_group_tests("parse", tests, case_count, NULL,
                                         NULL);
    free(tests);
    free(standard);
    rmdir("library");
    return chdir("/") == 0 && rmdir(folder) == 0 ? failed : 1;
}
