/* vdb_file.h - the outside of a .vdb file: its header and directory, and a
 * check of a tree's bytes. For vdb_list.c and vdb_module.cc.
 *
 * OpenVDB 10 believes every count and size in a file: it makes strings and
 * tables as large as they say, and reads blocks of a negative size into the
 * buffer before it compares that size with the buffer's. So what it is given
 * has passed here first. The layout is that of OpenVDB's io and tree folders
 * (RootNode::readTopology, io::readCompressedValues, ...). */
#ifndef LIB_VDB_FILE_H
#define LIB_VDB_FILE_H
#include <stdio.h>
#include "lib/vdb.h"

#ifdef __cplusplus
extern "C" {
#endif

struct vdb_record {
    struct vdb_entry entry;
    char unique[256];       /* the name with its number                    */
    char parent[256];       /* the unique name of the grid whose tree this
                               one shares; empty where it has its own      */
    char tree[64];          /* "Tree_float_5_4_3"                          */
    char map[64];           /* "UniformScaleMap"                           */
    uint64_t grid_at;       /* of the compression word                     */
    uint64_t transform_at;
    uint32_t compression;   /* 1 ZIP, 2 active values only, 4 Blosc        */
};

struct vdb_file {
    const char *path;
    FILE *stream;
    uint64_t size, at;      /* bytes; at <= size                           */
    uint32_t version;       /* of the format                               */
    uint32_t library[2];    /* major and minor version of the writer       */
    size_t count, capacity;
    struct vdb_record *record;
    struct brume_error *err;
};

/* Opens a file and reads its directory; false with err set. `file` is to be
 * closed in both cases; `path` and `err` stay in use until then. */
bool vdb_file_open(struct vdb_file *file, const char *path,
                   struct brume_error *err);
void vdb_file_close(struct vdb_file *file);

/* True where `name` is the grid's, with or without its number. */
bool vdb_file_named(const struct vdb_entry *entry, const char *name);

/* False with err set where a grid is a level set, which no medium is. */
bool vdb_check_class(const struct vdb_entry *entry, const char *path,
                     struct brume_error *err);

struct vdb_layout {
    uint32_t compression;
    unsigned value;         /* bytes of a value in memory and as a tile    */
    unsigned stored;        /* bytes of a value in a block: 2 for halves   */
    bool bits;              /* leaves are bit masks: bool                  */
};

/* Walks the tree (topology, then buffers) that begins at byte `at`. */
bool vdb_file_check_tree(struct vdb_file *file, uint64_t at,
                         const struct vdb_layout *layout);

#ifdef __cplusplus
}
#endif
#endif
