/* vdb.h - OpenVDB files (.vdb) to and from sparse grids.
 *
 * Reads what OpenVDB 2 to 13 write: file formats 222 to 225, trees of
 * branching 5-4-3, values saved as half or in full, plain, ZIP or Blosc, of
 * any class but level sets. Structure and sizes are checked before OpenVDB
 * sees the file, as it trusts them. Errors are BRUME_ERR_FILE and name the
 * file; BRUME_ERR_LIMIT where its samples are too far apart for a grid. */
#ifndef LIB_VDB_H
#define LIB_VDB_H
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"
#include "lib/grid.h"

#ifdef __cplusplus
extern "C" {
#endif

enum vdb_class { VDB_UNKNOWN, VDB_LEVEL_SET, VDB_FOG, VDB_STAGGERED };

struct vdb_entry {
    char name[64];          /* "density"; "density[1]" where names repeat  */
    char type[32];          /* "float", "vec3s", ... as OpenVDB has them   */
    bool scalar;            /* of a type that vdb_load takes               */
    bool vector;            /* vec3s or vec3d: vdb_load_velocity           */
    bool half;              /* saved as 16-bit floats                      */
    enum vdb_class kind;
    int64_t active_voxels;  /* as the file says; -1 where it does not      */
};

/* The grids of a file, in its order. */
struct vdb_list {
    size_t count;
    struct vdb_entry *entry;
};

struct vdb_list *vdb_list_new(const char *path, struct brume_error *err);
void vdb_list_free(struct vdb_list *list);

/* What a grid is wanted for, where the scene does not name it. */
enum vdb_role { VDB_DENSITY, VDB_TEMPERATURE, VDB_FLAME, VDB_VELOCITY };

/* The grid for a role, by name: "density", "smoke", else the only scalar grid
 * that is no level set; "temperature", "heat"; "flame", "flames", "burn";
 * "velocity", "vel", "v". NULL with err set, listing what the file holds. */
const struct vdb_entry *vdb_choose(const struct vdb_list *list,
                                   enum vdb_role role, const char *path,
                                   struct brume_error *err);

/* Loads a scalar grid (float, double, int32, int64 or bool) by name, or by
 * role where `name` is NULL or empty. The grid covers the bricks that hold
 * active voxels or tiles; inactive samples in them keep their stored values,
 * as OpenVDB samples them. Its transform must be linear. */
struct grid *vdb_load(const char *path, const char *name, enum vdb_role role,
                      struct brume_error *err);

/* The components of a velocity, a grid of vectors (vec3s or vec3d), as grids
 * whose samples have any sign; those of a staggered grid lie on the faces of
 * its voxels. */
bool vdb_load_velocity(const char *path, const char *name,
                       struct grid *component[3], struct brume_error *err);

enum { VDB_SAVE_HALF = 1, VDB_SAVE_ZIP = 2 };

/* Writes grids as fog volumes; three with `any_sign`, one after the other and
 * of one name and extent, are one grid of vectors. Samples that differ from the
 * background are active. The file appears only when complete. It holds a random
 * identifier (OpenVDB's), so its bytes differ from run to run. */
bool vdb_save(const char *path, const struct grid *const *grids,
              size_t count, int flags, struct brume_error *err);

#ifdef __cplusplus
}
#endif
#endif
