#include "parser/naming.h"
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const char *const extensions[] = {
    [OPTIONS_FORMAT_PNG] = ".png",
    [OPTIONS_FORMAT_EXR] = ".exr",
    [OPTIONS_FORMAT_PPM] = ".ppm",
};
enum { FORMATS = sizeof extensions / sizeof *extensions };

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* From the last dot of the name on, or "". A name may begin with a dot. */
static const char *extension_of(const char *path)
{
    const char *base = base_name(path);
    const char *dot = strrchr(base, '.');
    return dot && dot != base ? dot : path + strlen(path);
}

static bool is_standard_output(const struct options *options)
{
    return options->output && strcmp(options->output, "-") == 0;
}

enum options_format naming_format(const struct options *options)
{
    if (options->has_format || !options->output)
        return options->format;
    const char *extension = extension_of(options->output);
    for (int i = 0; i < FORMATS; i++)
        if (strcasecmp(extension, extensions[i]) == 0)
            return (enum options_format)i;
    return options->format;
}

const char *naming_foreign(const struct options *options)
{
    static const char *const others[] = {
        ".png", ".exr", ".ppm", ".jpg",  ".jpeg", ".tga",
        ".bmp", ".hdr", ".tif", ".tiff", ".gif",  ".webp",
    };
    if (!options->output || options->has_format)
        return NULL;
    const char *extension = extension_of(options->output);
    const char *own = extensions[naming_format(options)];
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcasecmp(extension, others[i]) == 0 &&
            strcasecmp(extension, own) != 0)
            return extension;
    return NULL;
}

/* Without the extension that will be put behind it again. */
static const char *stem_of_output(const struct options *options,
                                  const char **extension, struct arena *arena)
{
    const char *output = options->output;
    const char *own = extensions[naming_format(options)];
    const char *given = extension_of(output);
    *extension = own;
    if (strcasecmp(given, own) != 0)
        return output;
    *extension = given;
    return arena_copy(arena, output, (size_t)(given - output));
}

/* The scene's name without its extension: with its folder, or, for a folder
 * given by +O, in that one. */
static const char *stem_of_scene(const struct options *options,
                                 struct arena *arena)
{
    const char *folder = options->output ? options->output : "";
    const char *scene = options->input;
    if (strcmp(scene, "-") == 0)
        scene = "stdin";
    if (*folder)
        scene = base_name(scene);
    size_t length = (size_t)(extension_of(scene) - scene);
    size_t size = strlen(folder) + length + 1;
    char *stem = arena_alloc(arena, size);
    if (stem)
        snprintf(stem, size, "%s%.*s", folder, (int)length, scene);
    return stem;
}

static bool names_no_file(const char *output)
{
    return !output || !*output || output[strlen(output) - 1] == '/';
}

/* A device or a pipe has the name it has. */
static bool is_special(const char *path)
{
    struct stat status;
    return path && stat(path, &status) == 0 && !S_ISREG(status.st_mode) &&
           !S_ISDIR(status.st_mode);
}

bool naming_is_stream(const struct options *options)
{
    return is_standard_output(options) || is_special(options->output);
}

const char *naming_picture(const struct options *options,
                           const struct frames *frames, int number,
                           struct arena *arena)
{
    if (naming_is_stream(options))
        return options->output;
    const char *extension = extensions[naming_format(options)];
    const char *stem = names_no_file(options->output)
                           ? stem_of_scene(options, arena)
                           : stem_of_output(options, &extension, arena);
    if (!stem)
        return NULL;
    size_t size = strlen(stem) + strlen(extension) + 16;
    char *path = arena_alloc(arena, size);
    if (path && frames->animation)
        snprintf(path, size, "%s%0*d%s", stem, frames->digits, number,
                 extension);
    else if (path)
        snprintf(path, size, "%s%s", stem, extension);
    return path;
}

const char *naming_beside(const struct options *options, const char *end,
                          struct arena *arena)
{
    const char *extension;
    const char *stem = names_no_file(options->output)
                           ? stem_of_scene(options, arena)
                           : stem_of_output(options, &extension, arena);
    size_t size = stem ? strlen(stem) + strlen(end) + 1 : 0;
    char *path = stem ? arena_alloc(arena, size) : NULL;
    if (path)
        snprintf(path, size, "%s%s", stem, end);
    return path;
}

const char *naming_numbered(const char *name, int number, struct arena *arena)
{
    size_t size = strlen(name) + 16, used = 0;
    char *path = arena_alloc(arena, size);
    if (!path)
        return NULL;
    for (const char *at = name; *at; at++) {
        int digits = 0;
        if (*at != '%' || at[1] == '%') {
            path[used++] = *at;
            at += *at == '%';
            continue;
        }
        if (at[1] == '0') {
            digits = at[2] - '0';
            at += 2;
        }
        at++;
        used += (size_t)snprintf(path + used, size - used, "%0*d", digits,
                                 number);
    }
    path[used] = '\0';
    return path;
}

const char *naming_folder(const struct options *options, struct arena *arena)
{
    struct frames still = {.animation = false};
    const char *path = naming_picture(options, &still, 0, arena);
    if (!path)
        return NULL;
    const char *base = base_name(path);
    if (base == path)
        return ".";
    return arena_copy(arena, path, (size_t)(base - path));
}
