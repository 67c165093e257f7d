/* test_words.c - each word of the language's statements shows in the scene, or
 * a warning tells that it does not: for every row of the statements' tables.
 *
 * A scene with the word is read, and one without; what core was told of both,
 * what else was read of them, and the diagnostics are compared. A word that is
 * new in a table is tried with a value of its kind; where that is not enough
 * it needs a line in words.h. Words that all patterns have are tried in
 * pigment and in density. Run from the root of the tree. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "core/scene.h"
#include "core/query.h"
#include "parser/parse.h"
#include "tests/unit/words.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

enum { TEXT = 4096, SAID = 8192 };

static const struct statement *const statements[] = {
#define X(kind, name) &build_statement_##name,
    BUILD_STATEMENTS(X)
#undef X
};

static const char *const names[] = {
#define X(kind, name) #kind,
    BUILD_STATEMENTS(X)
#undef X
};

/* ---- what a scene comes to --------------------------------------------- */

struct outcome {
    bool fine;
    uint64_t scene;
    char said[SAID];
};

static void mix(uint64_t *hash, const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;

    for (size_t i = 0; i < size; i++)
        *hash = (*hash ^ byte[i]) * UINT64_C(1099511628211);
}

static void mix_ids(uint64_t *hash, const int *ids, size_t count)
{
    if (count > 0)
        mix(hash, ids, count * sizeof *ids);
}

/* What its pointers refer to in place of them. */
static void mix_shape(uint64_t *hash, const struct brume_shape *shape)
{
    struct brume_shape plain;

    memcpy(&plain, shape, sizeof plain);
    plain.parts = plain.clips = NULL;
    plain.data = NULL;
    mix(hash, &plain, sizeof plain);
    mix_ids(hash, shape->parts, shape->part_count);
    mix_ids(hash, shape->clips, shape->clip_count);
    if (shape->count > 0)
        mix(hash, shape->data, shape->count * sizeof *shape->data);
}

static void mix_mesh(uint64_t *hash, const struct mesh *mesh)
{
    size_t n = mesh->triangles;

    mix(hash, mesh->position, mesh->vertices * sizeof *mesh->position);
    mix(hash, mesh->corner, n * sizeof *mesh->corner);
    if (mesh->corner_normal)
        mix(hash, mesh->corner_normal, n * sizeof *mesh->corner_normal);
    if (mesh->normals > 0)
        mix(hash, mesh->normal, mesh->normals * sizeof *mesh->normal);
}

static void mix_grid(uint64_t *hash, const struct grid *grid)
{
    mix(hash, &grid->filter, sizeof grid->filter);
    mix(hash, grid->to_world, sizeof grid->to_world);
    mix(hash, grid->voxel, grid->stored * GRID_BRICK_VOXELS * sizeof(float));
}

#define MIX_LIST(hash, scene, list)                                            \
    do {                                                                       \
        if ((scene)->list##_count > 0)                                         \
            mix(hash, (scene)->list,                                           \
                (scene)->list##_count * sizeof *(scene)->list);                \
    } while (0)

static uint64_t hash_scene(const brume_scene *scene,
                           const struct parse_result *result)
{
    uint64_t hash = UINT64_C(14695981039346656037);

    mix(&hash, &scene->camera, sizeof scene->camera);
    mix(&hash, &scene->globals, sizeof scene->globals);
    mix(&hash, &scene->atmosphere, sizeof scene->atmosphere);
    if (scene->sky.width > 0)
        mix(&hash, scene->sky.radiance,
            3 * sizeof(float) * (size_t)scene->sky.width *
                (size_t)scene->sky.height);
    if (scene->plate.width > 0) {
        mix(&hash, scene->plate.radiance,
            3 * sizeof(float) * (size_t)scene->plate.width *
                (size_t)scene->plate.height);
        mix(&hash, &scene->plate.along_ray, sizeof scene->plate.along_ray);
    }
    MIX_LIST(&hash, scene, lights);
    MIX_LIST(&hash, scene, materials);
    MIX_LIST(&hash, scene, fields);
    MIX_LIST(&hash, scene, media);
    MIX_LIST(&hash, scene, interiors);
    MIX_LIST(&hash, scene, code);
    MIX_LIST(&hash, scene, functions);
    MIX_LIST(&hash, scene, pool);
    MIX_LIST(&hash, scene, images);
    MIX_LIST(&hash, scene, texels);
    for (size_t i = 0; i < scene->shapes_count; i++)
        mix_shape(&hash, &scene->shapes[i]);
    for (size_t i = 0; i < scene->meshes_count; i++)
        mix_mesh(&hash, scene->meshes[i]);
    for (size_t i = 0; i < scene->grids_count; i++)
        mix_grid(&hash, scene->grids[i]);
    mix(&hash, &result->accuracy, sizeof result->accuracy);
    mix(&hash, &result->time_limit, sizeof result->time_limit);
    mix(&hash, &result->has_integrator, sizeof result->has_integrator);
    mix(&hash, &result->photons, sizeof result->photons);
    return hash;
}

static void read_scene(const char *text, struct outcome *out)
{
    struct parse_input in = {.path = "scene.pov",
                             .text = text,
                             .length = strlen(text),
                             .ambient = PARSE_AMBIENT_INIT};
    struct parse_result result = {0};
    struct diag diag;
    size_t used = 0;

    memset(out, 0, sizeof *out);
    diag_init(&diag);
    out->fine = parse_scene(&in, &result, &diag);
    for (const struct diag_item *d = diag.first; d && used < SAID; d = d->next)
        used += (size_t)snprintf(out->said + used, SAID - used, "%s\n",
                                 d->text);
    if (out->fine)
        out->scene = hash_scene(result.scene, &result);
    brume_scene_free(result.scene);
    diag_release(&diag);
}

/* ---- scenes ------------------------------------------------------------ */

static const struct words_scene *scene_of(enum build_kind kind)
{
    for (size_t i = 0; i < COUNT(words_scenes); i++)
        if (words_scenes[i].kind == kind)
            return &words_scenes[i];
    return NULL;
}

/* The scene with `words` for %, and without what is between @ if not
 * `whole`. */
static void write_scene(const char *scene, const char *words, bool whole,
                        char text[TEXT])
{
    bool skip = false;
    size_t used = 0;

    for (; *scene; scene++) {
        if (*scene == '@') {
            skip = !whole && !skip;
        } else if (*scene == '%' && !skip) {
            used += (size_t)snprintf(text + used, TEXT - used, "%s", words);
        } else if (!skip) {
            text[used++] = *scene;
        }
        assert_true(used < TEXT - 1);
    }
    text[used] = '\0';
}

static const struct words_use *use_of(enum build_kind kind, const char *word)
{
    const struct words_use *any = NULL;

    for (size_t i = 0; i < COUNT(words_uses); i++)
        if (!strcmp(words_uses[i].word, word)) {
            if (words_uses[i].kind == kind)
                return &words_uses[i];
            if (words_uses[i].kind == BUILD_KINDS &&
                (words_uses[i].scene || statements[kind]->groups))
                any = &words_uses[i];
        }
    return any;
}

/* A number that the row takes, and that is not its default. */
static double number_for(const struct param *row)
{
    static const double some[] = {0.375, 3, 0.75, 2, 1, 0};

    for (size_t i = 0; i < COUNT(some); i++)
        if (some[i] >= row->low && some[i] <= row->high &&
            some[i] != row->start[0] &&
            (row->kind != PARAM_INTEGER || some[i] == (int)some[i]))
            return some[i];
    return row->high;
}

static void write_words(const struct param *row, char words[TEXT])
{
    double x = number_for(row);

    switch (row->kind) {
    case PARAM_FLOAT:
    case PARAM_INTEGER:
        snprintf(words, TEXT, "%s %g", row->word, x);
        break;
    case PARAM_VECTOR:
        snprintf(words, TEXT, "%s <%g, %g, %g>", row->word, x, x / 2, x / 4);
        break;
    case PARAM_RGB:
    case PARAM_COLOR:
        snprintf(words, TEXT, "%s rgb %g", row->word, x);
        break;
    case PARAM_PAIR:
        snprintf(words, TEXT, "%s %g, %g", row->word, x, x);
        break;
    case PARAM_SWITCH:
        snprintf(words, TEXT, "%s %s", row->word,
                 row->start[0] != 0 ? "off" : "on");
        break;
    case PARAM_CHOICE:
        snprintf(words, TEXT, "%s %s", row->word, row->choice[1]);
        break;
    default:
        snprintf(words, TEXT, "%s", row->word);
        break;
    }
}

/* ---- the words --------------------------------------------------------- */

static int faults;

static void fault(enum build_kind kind, const char *word, const char *what)
{
    print_message("%s: '%s': %s\n", names[kind], word, what);
    faults++;
}

static void compare(enum build_kind kind, const char *word, const char *with,
                    const char *without, const char *lacks)
{
    struct outcome one, other;

    read_scene(with, &one);
    read_scene(without, &other);
    if (lacks && strstr(one.said, lacks))
        return;
    if (!one.fine || !other.fine)
        fault(kind, word, one.fine ? other.said : one.said);
    else if (lacks)
        fault(kind, word, "nothing tells that it is not drawn");
    else if (one.scene == other.scene && !strcmp(one.said, other.said))
        fault(kind, word, "nothing shows");
}

static void try_word(enum build_kind kind, const struct param *row)
{
    const struct words_scene *scene = scene_of(kind);
    const struct words_use *use = use_of(kind, row->word);
    const char *text = use && use->scene ? use->scene : scene->text;
    char words[TEXT], with[TEXT], without[TEXT];

    write_words(row, words);
    write_scene(text, use && use->with ? use->with : words, true, with);
    write_scene(text, use && use->without ? use->without : "", true, without);
    compare(kind, row->word, with, without,
            use && use->lacks ? use->lacks : scene->lacks);
}

static void try_rows(enum build_kind kind, const struct param *rows)
{
    for (; rows && rows->word; rows++)
        try_word(kind, rows);
}

static bool tries_patterns(enum build_kind kind)
{
    return kind == BUILD_PIGMENT || kind == BUILD_DENSITY;
}

static void every_word_shows_or_is_told_of(void **state)
{
    (void)state;
    faults = 0;
    for (int i = 0; i < BUILD_KINDS; i++) {
        enum build_kind kind = (enum build_kind)i;
        const struct param_group *group = statements[kind]->groups;
        if (!scene_of(kind))
            continue;
        try_rows(kind, statements[kind]->params);
        for (; group && group->rows; group++)
            if (group->rows != build_pattern_groups[0].rows)
                try_rows(kind, group->rows);
            else if (!tries_patterns(kind))
                break;
            else
                try_rows(kind, group->rows);
    }
    assert_int_equal(faults, 0);
}

static void every_statement_shows_or_is_told_of(void **state)
{
    char with[TEXT], without[TEXT];
    (void)state;

    faults = 0;
    for (int i = 0; i < BUILD_KINDS; i++) {
        enum build_kind kind = (enum build_kind)i;
        const struct words_scene *scene = scene_of(kind);
        const struct words_use *use = use_of(kind, "");
        if (!scene) {
            fault(kind, statements[kind]->word, "words.h has no scene of it");
            continue;
        }
        write_scene(scene->text, use ? use->with : "", true, with);
        write_scene(scene->text, "", false, without);
        if (strchr(scene->text, '@') || use || scene->lacks)
            compare(kind, statements[kind]->word, with, without, scene->lacks);
    }
    assert_int_equal(faults, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_statement_shows_or_is_told_of),
        cmocka_unit_test(every_word_shows_or_is_told_of),
    };

    return cmocka_run_group_tests_name("words", tests, NULL, NULL);
}
