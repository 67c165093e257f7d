/* nvdb_file.h - the outside of a .nvdb file: its directory, and the bytes of
 * its grids. For nvdb.c alone.
 *
 * A file is a row of segments: a header (magic, version, number of grids,
 * codec), a record of metadata and a name for each grid, then the grids'
 * bytes; or a row of bare grids. The layout is the one of NanoVDB's manual
 * ("The NanoVDB file format", "Memory layout"), little-endian. */
#ifndef LIB_NVDB_FILE_H
#define LIB_NVDB_FILE_H
#include "lib/bytes.h"
#include "lib/nvdb.h"

enum nvdb_type {
    NVDB_FLOAT = 1,
    NVDB_DOUBLE,
    NVDB_INT32 = 4,
    NVDB_INT64,
    NVDB_BOOL = 11,
    NVDB_FP4 = 13,
    NVDB_FP8,
    NVDB_FP16,
    NVDB_FPN
};

struct nvdb_record {
    struct vdb_entry entry;
    uint64_t at, packed;    /* where its bytes lie in the file             */
    uint64_t size;          /* of them, unpacked                           */
    unsigned codec;         /* 0 none, 1 ZIP, 2 Blosc                      */
    enum nvdb_type type;    /* or another that the format has              */
};

struct nvdb_file {
    struct bytes bytes;
    size_t count, capacity;
    struct nvdb_record *record;
};

/* Opens a file and reads its directory; false with err set. `file` is to be
 * closed in both cases; `path` and `err` stay in use until then. */
bool nvdb_file_open(struct nvdb_file *file, const char *path,
                    struct brume_error *err);
void nvdb_file_close(struct nvdb_file *file);

enum { /* bytes that every grid has: of the grid and of its tree           */
    NVDB_GRID = 672,
    NVDB_TREE = 64
};

/* The bytes of a grid, unpacked: at least those of NVDB_GRID and NVDB_TREE.
 * Freed with free(); NULL with err set. */
unsigned char *nvdb_file_grid(struct nvdb_file *file,
                              const struct nvdb_record *record);
#endif
