/* ply.h - meshes and points from PLY files (Turk 1994), ASCII and binary of
 * either endianness.
 *
 * Taken for meshes: of "vertex" x y z, nx ny nz and u v (also s t, texture_u
 * texture_v); of "face" the list vertex_indices or vertex_index, in any integer
 * types.
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

/* Points, from "vertex": x y z; radius (also pscale), mass, and one more. */
struct points {
    size_t count;
    double *at;             /* x y z of each; they need not be finite      */
    double *radius, *mass, *value;  /* NULL where the file has none        */
};

/* The points, or NULL with err set as above. `value` names the one more
 * property, which must be there; NULL: none is wanted. */
struct points *ply_load_points(const char *path, const char *value,
                               struct brume_error *err);
void points_free(struct points *points);
#endif
