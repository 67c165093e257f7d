#include "parser/input.h"
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool input_read(FILE *from, const char *name, size_t limit, struct arena *arena,
                char **text, size_t *length, struct brume_error *err)
{
    void *bytes = NULL;
    size_t room = 0, used = 0;
    for (;;) {
        if (!arena_grow(arena, &bytes, &room, used + 4096, 1))
            return brume_fail(err, BRUME_ERR_MEMORY,
                              "no memory left to read '%s'", name);
        size_t got = fread((char *)bytes + used, 1, room - used - 1, from);
        used += got;
        if (used > limit)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "'%s' is longer than %zu bytes", name, limit);
        if (got == 0)
            break;
    }
    if (ferror(from))
        return brume_fail(err, BRUME_ERR_FILE, "can't read '%s': %s", name,
                          strerror(errno));
    *text = bytes;
    (*text)[used] = '\0';
    *length = used;
    return true;
}

bool input_read_file(const char *path, size_t limit, struct arena *arena,
                     char **text, size_t *length, struct brume_error *err)
{
    FILE *from = fopen(path, "rb");
    if (!from)
        return brume_fail(err, BRUME_ERR_FILE, "can't open '%s': %s", path,
                          strerror(errno));
    bool ok = input_read(from, path, limit, arena, text, length, err);
    fclose(from);
    return ok;
}

static bool is_there(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0;
}

static bool has_extension(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strchr(slash ? slash + 1 : path, '.');
}

/* folder + name + extension if such a file is there. */
static const char *try_file(struct arena *arena, const char *folder,
                            const char *name, const char *extension)
{
    size_t length = strlen(folder);
    const char *slash = length && folder[length - 1] != '/' ? "/" : "";
    size_t size = length + strlen(name) + strlen(extension) + 2;
    char *path = arena_alloc(arena, size);
    if (!path)
        return NULL;
    snprintf(path, size, "%s%s%s%s", folder, slash, name, extension);
    return is_there(path) ? path : NULL;
}

static const char *try_folder(struct options *options, const char *folder)
{
    const char *name = options->input;
    const char *path = try_file(&options->arena, folder, name, "");
    if (!path && !has_extension(name))
        path = try_file(&options->arena, folder, name, ".pov");
    return path;
}

const char *input_find(struct options *options, struct brume_error *err)
{
    const char *path = try_folder(options, "");
    bool elsewhere = options->input[0] != '/';
    if (!path && elsewhere && options->input_folder)
        path = try_folder(options, options->input_folder);
    for (size_t i = 0; !path && elsewhere && i < options->library.count; i++)
        path = try_folder(options, options->library.item[i]);
    if (!path)
        brume_fail(err, BRUME_ERR_FILE, "can't find the scene '%s'",
                   options->input);
    return path;
}

const char *input_own_folder(struct arena *arena)
{
    static const char *const below[] = {
        "../share/brume/scenes/include",
        "../scenes/include",
        "../../scenes/include",
    };
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0)
        return NULL;
    program[length] = '\0';
    program[strrchr(program, '/') - program] = '\0';
    for (size_t i = 0; i < sizeof below / sizeof *below; i++) {
        const char *path = try_file(arena, program, below[i], "");
        if (path)
            return path;
    }
    return NULL;
}
