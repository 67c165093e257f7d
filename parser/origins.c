#include "parser/origins.h"
#include "lib/memory.h"
#include <stdlib.h>
#include <string.h>

/* More are not compared one by one. */
enum { MOST = 4096 };

static bool knows(const struct parse_paths *list, const char *path)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->path[i], path) == 0)
            return true;
    return false;
}

static bool add(struct parse_paths *list, const char *path)
{
    if (list->count == MOST)
        return false;
    char **grown = memory_grow(list->path, &list->room, list->count + 1,
                               sizeof *grown, NULL);
    if (!grown)
        return false;
    list->path = grown;
    list->path[list->count] = strdup(path);
    return list->path[list->count] && ++list->count;
}

static void note(struct parse_origins *origins, struct parse_paths *list,
                 const char *path)
{
    if (origins && !origins->incomplete && !knows(list, path) &&
        !add(list, path))
        origins->incomplete = true;
}

void origins_add(struct parse_origins *origins, const char *path)
{
    note(origins, origins ? &origins->read : NULL, path);
}

void origins_miss(struct parse_origins *origins, const char *path)
{
    note(origins, origins ? &origins->missing : NULL, path);
}

void origins_merge(struct parse_origins *origins,
                   const struct parse_origins *from)
{
    for (size_t i = 0; i < from->read.count; i++)
        origins_add(origins, from->read.path[i]);
    for (size_t i = 0; i < from->missing.count; i++)
        origins_miss(origins, from->missing.path[i]);
    origins->incomplete = origins->incomplete || from->incomplete;
}

static void release(struct parse_paths *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->path[i]);
    free(list->path);
}

void parse_origins_release(struct parse_origins *origins)
{
    release(&origins->read);
    release(&origins->missing);
    *origins = (struct parse_origins){0};
}
