#include "lib/vdb.h"
#include <dlfcn.h>
#include "lib/output.h"
#include "lib/vdb_module.h"

/* It stays, as OpenVDB can't be loaded twice; later calls find it. */
const struct vdb_module *vdb_module_for(const char *path,
                                        struct brume_error *err)
{
    void *handle = dlopen(VDB_MODULE_FILE,
                          RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const struct vdb_module *module = handle ? dlsym(handle, VDB_MODULE_SYMBOL)
                                             : NULL;
    if (!module)
        brume_fail_file(err, path, "OpenVDB's module can't be loaded: %s",
                        dlerror());
    if (handle)
        dlclose(handle);
    return module;
}

/* The grid that has the role in this file. */
static bool choose(const char *path, enum vdb_role role,
                   struct vdb_entry *chosen, struct brume_error *err)
{
    struct vdb_list *list = vdb_list_new(path, err);
    const struct vdb_entry *e = list ? vdb_choose(list, role, path, err) : NULL;
    if (e)
        *chosen = *e;
    vdb_list_free(list);
    return e != NULL;
}

struct grid *vdb_load(const char *path, const char *name, enum vdb_role role,
                      struct brume_error *err)
{
    struct vdb_entry chosen;
    if (!name || !*name) {
        if (!choose(path, role, &chosen, err))
            return NULL;
        name = chosen.name;
    }
    const struct vdb_module *module = vdb_module_for(path, err);
    return module ? module->load(path, name, err) : NULL;
}

bool vdb_load_velocity(const char *path, const char *name,
                       struct grid *component[3], struct brume_error *err)
{
    struct vdb_entry chosen;
    if (!name || !*name) {
        if (!choose(path, VDB_VELOCITY, &chosen, err))
            return false;
        name = chosen.name;
    }
    const struct vdb_module *module = vdb_module_for(path, err);
    return module && module->load_velocity(path, name, component, err);
}

bool vdb_save(const char *path, const struct grid *const *grids, size_t count,
              int flags, struct brume_error *err)
{
    const struct vdb_module *module = vdb_module_for(path, err);
    struct output *o = module ? output_open(path, err) : NULL;
    if (!o)
        return false;
    bool ok = module->save(path, output_name(o), grids, count, flags, err);
    return output_close(o, ok, err);
}
