#include "parser/origins.h"
#include "lib/memory.h"
#include "lib/stamp.h"
#include <stdlib.h>
#include <string.h>

/* More are not compared one by one. */
enum { MOST = 4096 };

/* Its number, counted from 1; 0: it is not known. */
static size_t find(const struct parse_paths *list, const char *path)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->path[i], path) == 0)
            return i + 1;
    return 0;
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

/* A file that can't be looked at has the stamp of none. */
static struct stat stamp_of(const char *path)
{
    struct stat now;
    if (stat(path, &now) != 0)
        memset(&now, 0, sizeof now);
    return now;
}

static bool add_read(struct parse_origins *origins, const char *path,
                     const struct stat *was)
{
    size_t count = origins->read.count;
    struct stat *grown = memory_grow(origins->was, &origins->was_room,
                                     count + 1, sizeof *grown, NULL);
    if (!grown)
        return false;
    origins->was = grown;
    grown[count] = *was;
    return add(&origins->read, path);
}

static void note_read(struct parse_origins *origins, const char *path,
                      const struct stat *was)
{
    size_t known = find(&origins->read, path);
    if (origins->incomplete)
        return;
    if (known == 0)
        origins->incomplete = !add_read(origins, path, was);
    else if (!stamp_is_same(&origins->was[known - 1], was))
        origins->changed = known;
}

void origins_add(struct parse_origins *origins, const char *path)
{
    if (!origins)
        return;
    struct stat was = stamp_of(path);
    note_read(origins, path, &was);
}

void origins_miss(struct parse_origins *origins, const char *path)
{
    if (origins && !origins->incomplete && !find(&origins->missing, path) &&
        !add(&origins->missing, path))
        origins->incomplete = true;
}

void origins_merge(struct parse_origins *origins,
                   const struct parse_origins *from)
{
    for (size_t i = 0; i < from->read.count; i++)
        note_read(origins, from->read.path[i], &from->was[i]);
    for (size_t i = 0; i < from->missing.count; i++)
        origins_miss(origins, from->missing.path[i]);
    if (from->changed > 0 && origins->changed == 0)
        origins->changed = find(&origins->read,
                                from->read.path[from->changed - 1]);
    origins->incomplete = origins->incomplete || from->incomplete;
}

const char *origins_changed(const struct parse_origins *origins)
{
    const struct parse_paths *read = &origins->read;
    if (origins->changed > 0)
        return read->path[origins->changed - 1];
    for (size_t i = 0; i < read->count; i++) {
        struct stat now = stamp_of(read->path[i]);
        if (!stamp_is_same(&origins->was[i], &now))
            return read->path[i];
    }
    return NULL;
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
    free(origins->was);
    *origins = (struct parse_origins){0};
}
