/* obj.h - meshes from Wavefront OBJ files: v, vt, vn and f.
 *
 * Faces are v, v/vt, v//vn or v/vt/vn; negative indices count from the end;
 * an index names an item further up in the file. Polygons become the fan of
 * their first corner (right for convex ones). Groups, materials, lines,
 * points and words that are not known are passed over. */
#ifndef LIB_OBJ_H
#define LIB_OBJ_H
#include "lib/error.h"
#include "lib/mesh.h"

/* The mesh, or NULL with err set: BRUME_ERR_FILE with file and line. */
struct mesh *obj_load(const char *path, struct brume_error *err);
#endif
