/* vdb_module.h - what the module around OpenVDB and Blosc, vdb_module.cc, gives
 * to vdb_load.c and nvdb_file.c.
 *
 * OpenVDB is a library of 60 000 relocations, 30 ms of work for the dynamic
 * linker: so what uses it is a shared object of its own, which is loaded when
 * the first grid is. It holds its own copies of what it uses of lib/. */
#ifndef LIB_VDB_MODULE_H
#define LIB_VDB_MODULE_H
#include "lib/vdb.h"

#ifdef __cplusplus
extern "C" {
#endif

struct vdb_module {
    /* A Blosc buffer of `size` bytes into `room`: how many it makes, or 0
     * where it is none, or makes more. */
    size_t (*unpack)(const void *from, size_t size, void *to, size_t room);
    /* The grid of that name, as vdb_load. */
    struct grid *(*load)(const char *path, const char *name,
                         struct brume_error *err);
    /* As vdb_load_velocity. */
    bool (*load_velocity)(const char *path, const char *name,
                          struct grid *component[3], struct brume_error *err);
    /* As vdb_save, into a file of another name; errors name `path`. */
    bool (*save)(const char *path, const char *file,
                 const struct grid *const *grids, size_t count, int flags,
                 struct brume_error *err);
};

/* The file, which the dynamic linker looks for in the folders that the
 * program was linked with (see rpath in the Makefile), and its one symbol. */
#define VDB_MODULE_FILE "brume_vdb.so"
#define VDB_MODULE_SYMBOL "brume_vdb_module"

/* The module, loaded by the first call; it stays. NULL with err set, which
 * names `path`, the file that needs it. */
const struct vdb_module *vdb_module_for(const char *path,
                                        struct brume_error *err);

#ifdef __cplusplus
}
#endif
#endif
