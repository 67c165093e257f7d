/* file.c - where the files that a scene names are. */
#include "parser/origins.h"
#include "parser/parser.h"
#include "parser/permit.h"
#include "parser/source.h"
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A search under way, and the places that were tried. */
struct search {
    struct parser *parser;
    struct string name;
    enum parser_purpose purpose;
    bool exact; /* no extension is added                   */
    const char *found;
    const char *denied; /* the first that is there but off limits  */
    char tried[600];
    size_t used;
};

static const char *text_folder(const struct parser *parser, uint32_t source)
{
    return source < parser->sources ? parser->source[source]->folder : "";
}

/* ---- search ------------------------------------------------------------ */

static bool is_regular(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

static void note_tried(struct search *search, const char *path)
{
    size_t room = sizeof search->tried - search->used;
    int wrote = snprintf(search->tried + search->used, room, "%s%s",
                         search->used ? ", " : "", path);
    if (wrote > 0 && (size_t)wrote < room) {
        search->used += (size_t)wrote;
    } else {
        search->tried[search->used] = 0;
    }
}

/* Tries folder/name.extension. */
static void try_path(struct search *search, const char *folder,
                     const char *extension)
{
    size_t room = strlen(folder) + search->name.length + strlen(extension) + 24;
    char *path = parser_alloc(search->parser, room);
    if (!path) {
        return;
    }
    snprintf(path, room, "%s%s%s%s", folder,
             *folder && folder[strlen(folder) - 1] != '/' ? "/" : "",
             search->name.text, extension);
    int kept = permit_kept(search->parser, path);
    if (kept >= 0 && search->purpose == PARSER_DATA) {
        snprintf(path, room, "/proc/self/fd/%d", kept);
        search->found = path;
    } else if (kept >= 0) {
        search->found = path;
    } else if (!is_regular(path)) {
        note_tried(search, path);
        origins_miss(search->parser->in->origins, path);
    } else if (search->purpose == PARSER_DATA ||
               permit_reads(search->parser, path)) {
        search->found = path;
        if (!permit_wrote(search->parser, path)) {
            origins_add(search->parser->in->origins, path);
        }
    } else if (!search->denied) {
        search->denied = path;
    }
}

/* The name as it is, then with the extension that POV-Ray adds. */
static void try_folder(struct search *search, const char *folder)
{
    const char *last = strrchr(search->name.text, '/');
    bool plain = !search->exact &&
                 !strchr(last ? last : search->name.text, '.');
    if (!search->found) {
        try_path(search, folder, "");
    }
    if (!search->found && plain && search->purpose == PARSER_TEXT) {
        try_path(search, folder, ".inc");
    }
}

static void try_all(struct search *search, const char *around)
{
    const struct parser *parser = search->parser;
    const struct parse_input *in = parser->in;
    if (search->name.text[0] == '/') {
        try_folder(search, "");
        return;
    }
    const char *scene = text_folder(parser, 0);
    try_folder(search, around);
    if (strcmp(around, scene) != 0) {
        try_folder(search, scene);
    }
    for (size_t i = 0; i < in->libraries; i++) {
        try_folder(search, in->library[i]);
    }
    for (size_t i = 0; i < in->allow_reads; i++) {
        try_folder(search, in->allow_read[i]);
    }
    /* What the scene wrote. */
    bool wrote = in->written && in->written->count > 0;
    for (size_t i = 0; wrote && i < in->allow_writes; i++) {
        try_folder(search, in->allow_write[i]);
    }
    /* POV-Ray looks in the working folder; here that takes permission. */
    if (*scene && *around) {
        try_folder(search, "");
    }
}

static bool name_is_sound(struct string name)
{
    return name.length > 0 && name.length < PATH_MAX &&
           !memchr(name.text, 0, name.length);
}

static void report_missing(const struct search *search, struct location at)
{
    char hint[sizeof search->tried + 64];
    if (search->denied) {
        snprintf(hint, sizeof hint, "give its folder with --allow-read");
        parser_fail(search->parser, BRUME_ERR_ACCESS, at, hint,
                    "reading '%s' is not allowed: it is neither in the "
                    "scene's folder nor on the library path",
                    search->denied);
        return;
    }
    snprintf(hint, sizeof hint, "looked for %s", search->tried);
    parser_fail(search->parser, BRUME_ERR_FILE, at, hint, "file '%s' not found",
                search->name.text);
}

const char *parser_find_file(struct parser *parser, struct location at,
                             struct string name, enum parser_purpose purpose)
{
    struct search search = {.parser = parser, .name = name, .purpose = purpose};
    if (!name_is_sound(name)) {
        parser_error(parser, at,
                     "the file's name is empty, holds a NUL or "
                     "is longer than %d bytes",
                     PATH_MAX);
        return NULL;
    }
    try_all(&search, text_folder(parser, at.source));
    if (!search.found) {
        report_missing(&search, at);
    }
    return search.found;
}

bool parser_file_exists(struct parser *parser, struct location at,
                        struct string name)
{
    struct search search = {
        .parser = parser, .name = name, .purpose = PARSER_TEXT, .exact = true};
    if (name_is_sound(name)) {
        try_all(&search, text_folder(parser, at.source));
    }
    return search.found != NULL;
}
