/* vdb_module.h - what the module around OpenVDB, vdb_module.cc, gives to
 * vdb_load.c.
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
    /* The grid of that name, as vdb_load. */
    struct grid *(*load)(const char *path, const char *name,
                         struct brume_error *err);
    /* As vdb_save, into a file of another name; errors name `path`. */
    bool (*save)(const char *path, const char *file,
                 const struct grid *const *grids, size_t count, int flags,
                 struct brume_error *err);
};

/* The file, which the dynamic linker looks for in the folders that the
 * program was linked with (see rpath in the Makefile), and its one symbol. */
#define VDB_MODULE_FILE "brume_vdb.so"
#define VDB_MODULE_SYMBOL "brume_vdb_module"

#ifdef __cplusplus
}
#endif
#endif
