/* nvdb.h - NanoVDB files (.nvdb) as sparse grids.
 *
 * Reads what NanoVDB 32 writes (its conversion program, OpenVDB 9 to 13,
 * Warp): segments of several grids, plain, ZIP or Blosc, with the magic
 * numbers of 32.0 and of 32.6, and bare grids of the latter; trees of
 * branching 5-4-3 of float, double, int32, int64, bool, and the quantised
 * Fp4, Fp8, Fp16 and FpN. Each offset is compared with the grid's size before
 * it is followed, and no node is read twice. Errors are BRUME_ERR_FILE and
 * name the file; BRUME_ERR_LIMIT where its samples are too far apart for a
 * grid. Checksums are not compared. */
#ifndef LIB_NVDB_H
#define LIB_NVDB_H
#include "lib/vdb.h"

/* The grids of a file, in its order; freed by vdb_list_free. */
struct vdb_list *nvdb_list_new(const char *path, struct brume_error *err);

/* Loads a scalar grid as vdb_load does. */
struct grid *nvdb_load(const char *path, const char *name, enum vdb_role role,
                       struct brume_error *err);
#endif
