#include <stdlib.h>
#include "lib/memory.h"
#include "lib/vdb_file.h"

struct vdb_list *vdb_list_new(const char *path, struct brume_error *err)
{
    struct vdb_file file;
    struct vdb_list *list = NULL;
    if (vdb_file_open(&file, path, err))
        list = memory_new(1, sizeof *list, err);
    if (list)
        list->entry = memory_new(file.count, sizeof *list->entry, err);
    if (list && list->entry) {
        list->count = file.count;
        for (size_t i = 0; i < file.count; i++)
            list->entry[i] = file.record[i].entry;
    } else {
        free(list);
        list = NULL;
    }
    vdb_file_close(&file);
    return list;
}

void vdb_list_free(struct vdb_list *list)
{
    if (!list)
        return;
    free(list->entry);
    free(list);
}

/* The names of a role, best first. */
static const char *const *names_of(enum vdb_role role)
{
    static const char *const names[][4] = {
        {"density", "smoke"},
        {"temperature", "heat"},
        {"flame", "flames", "burn"},
        {"velocity", "vel", "v"},
    };
    return names[role];
}

static const struct vdb_entry *find(const struct vdb_list *list,
                                    const char *name)
{
    for (size_t i = 0; i < list->count; i++)
        if (vdb_file_named(&list->entry[i], name))
            return &list->entry[i];
    return NULL;
}

/* The one scalar grid that is no level set, if there is just one. */
static const struct vdb_entry *find_only_fog(const struct vdb_list *list)
{
    const struct vdb_entry *only = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const struct vdb_entry *e = &list->entry[i];
        if (!e->scalar || e->kind == VDB_LEVEL_SET)
            continue;
        if (only)
            return NULL;
        only = e;
    }
    return only;
}

/* "density (float), velocity (vec3s)" */
static void describe(const struct vdb_list *list, char *text, size_t size)
{
    size_t used = 0;
    snprintf(text, size, "no grids");
    for (size_t i = 0; i < list->count && used < size; i++) {
        const struct vdb_entry *e = &list->entry[i];
        int n = snprintf(text + used, size - used, "%s%s (%s%s)",
                         i > 0 ? ", " : "", e->name, e->type,
                         e->kind == VDB_LEVEL_SET ? ", level set" : "");
        used += n > 0 ? (size_t)n : 0;
    }
}

const struct vdb_entry *vdb_choose(const struct vdb_list *list,
                                   enum vdb_role role, const char *path,
                                   struct brume_error *err)
{
    const char *const *names = names_of(role);
    for (int i = 0; i < 4 && names[i]; i++) {
        const struct vdb_entry *e = find(list, names[i]);
        if (e)
            return e;
    }
    const struct vdb_entry *only = role == VDB_DENSITY ? find_only_fog(list)
                                                       : NULL;
    if (only)
        return only;
    char held[640];
    describe(list, held, sizeof held);
    brume_fail_file(err, path, "has no grid named %s%s%s%s%s; it holds %s",
                    names[0], " or ", names[1], names[2] ? " or " : "",
                    names[2] ? names[2] : "", held);
    return NULL;
}
