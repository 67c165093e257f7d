/* scene_text.h - a scene as text, and what of it reaches the fake core. */
#ifndef TESTS_SCENE_TEXT_H
#define TESTS_SCENE_TEXT_H
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>
#include "parser/parse.h"
#include "tests/unit/fake_brume.h"

static struct diag diag;
static struct parse_result result;

static inline bool parse(const char *text, bool full)
{
    struct parse_input in = {.path = "scene.pov", .text = text,
                             .length = strlen(text),
                             .ambient = PARSE_AMBIENT_INIT,
                             .full_transport = full};

    brume_scene_free(result.scene);
    diag_release(&diag);
    diag_init(&diag);
    return parse_scene(&in, &result, &diag);
}

/* The scene of a text without fault. */
static inline const brume_scene *scene(const char *text)
{
    if (!parse(text, false))
        fail_msg("%d:%d: %s\n%s", diag.first ? diag.first->line : 0,
                 diag.first ? diag.first->column : 0,
                 diag.first ? diag.first->text : "no diagnostic", text);
    return result.scene;
}

static inline const struct diag_item *first_of(enum diag_severity severity)
{
    const struct diag_item *item = diag.first;

    while (item && item->severity != severity)
        item = item->next;
    return item;
}

static inline void check_item(const struct diag_item *item, int line,
                              int column, const char *text,
                              const char *source)
{
    if (!item)
        fail_msg("no diagnostic: %s", source);
    if (item->line != line || item->column != column ||
        !strstr(item->text, text))
        fail_msg("%d:%d: %s, not %d:%d: %s\n%s", item->line, item->column,
                 item->text, line, column, text, source);
}

static inline void expect_error(const char *source, enum brume_code code,
                                int line, int column, const char *text)
{
    if (parse(source, false))
        fail_msg("no error: %s", source);
    check_item(first_of(DIAG_ERROR), line, column, text, source);
    assert_int_equal(diag.code, code);
}

static inline void expect_warning(const char *source, int line, int column,
                                  const char *text)
{
    scene(source);
    check_item(first_of(DIAG_WARNING), line, column, text, source);
}

static inline void check_numbers(const double *got, const double *want,
                                 int count)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(got[i] - want[i]) <= 1e-9))
            fail_msg("number %d is %.12g, not %.12g", i, got[i], want[i]);
}

#define NUMBERS(got, ...)                                                     \
    check_numbers(got, (const double[]){__VA_ARGS__},                         \
                  sizeof((const double[]){__VA_ARGS__}) / sizeof(double))

/* The last of a program's tests. */
static inline int forget_scene(void **state)
{
    (void)state;
    brume_scene_free(result.scene);
    diag_release(&diag);
    return 0;
}

#endif
