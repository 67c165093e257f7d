/* ply.h - meshes from PLY files (Turk 1994), ASCII and binary of either
 * endianness.
 *
 * Taken: of "vertex" x y z, nx ny nz and u v (also s t, texture_u texture_v);
 * of "face" the list vertex_indices or vertex_index, in any integer types.
 * Other elements and properties are skipped. A polygon of n corners becomes
 * the fan of its first corner, n - 2 triangles: right for convex ones. */
#ifndef LIB_PLY_H
#define LIB_PLY_H
#include "lib/error.h"
#include "lib/mesh.h"

/* The mesh, or NULL with err set: BRUME_ERR_FILE, naming the file and, in
 * ASCII, the line. Memory grows with what the file holds, not with what its
 * header says. */
struct mesh *ply_load(const char *path, struct brume_error *err);
#endif
