/* mesh.h - a triangle mesh on the host: what the readers of PLY and OBJ files
 * and the parser's mesh statements fill, and what core/ takes over. */
#ifndef LIB_MESH_H
#define LIB_MESH_H
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

struct mesh {
    size_t vertices, normals, uvs, triangles;   /* counts                 */
    double (*position)[3];
    float (*normal)[3];         /* unit length not required                */
    float (*uv)[2];
    uint32_t (*corner)[3];      /* a triangle's vertices                   */
    uint32_t (*corner_normal)[3];   /* its normals; NULL: a flat mesh      */
    uint32_t (*corner_uv)[3];       /* its uvs; NULL: none                 */
    size_t vertex_capacity, normal_capacity, uv_capacity, triangle_capacity;
    unsigned shares;            /* owners beside the first                 */
};

struct mesh *mesh_new(struct brume_error *err);
/* Gives up a share; the last one frees it. */
void mesh_free(struct mesh *m);
/* One owner more, of any thread, to call mesh_free too: from now on the mesh
 * must not be changed. */
struct mesh *mesh_share(struct mesh *m);
struct mesh *mesh_copy(const struct mesh *m, struct brume_error *err);

/* Append one item and return true; false with err set when out of memory or
 * beyond 2^32 - 2 items. */
bool mesh_add_vertex(struct mesh *m, const double p[3],
                     struct brume_error *err);
bool mesh_add_normal(struct mesh *m, const float n[3],
                     struct brume_error *err);
bool mesh_add_uv(struct mesh *m, const float uv[2], struct brume_error *err);
/* `normal` and `uv` may be NULL, but alike for all triangles of a mesh that
 * is to be smooth or textured: a mesh with both sorts gets geometric normals
 * where there are none. Indices are checked by mesh_check, not here. */
bool mesh_add_triangle(struct mesh *m, const uint32_t corner[3],
                       const uint32_t normal[3], const uint32_t uv[3],
                       struct brume_error *err);

/* Triangles whose corner_normal entry is this have no vertex normals. */
#define MESH_NONE UINT32_MAX

/* False with err set when a triangle names an item that is not there or a
 * position is not finite. */
bool mesh_check(const struct mesh *m, struct brume_error *err);

/* Triangles with a vertex normal that is zero or not finite lose theirs
 * (MESH_NONE); texture coordinates that are not finite become 0. Programs
 * write such values for slivers, and a mesh need not be refused for them. */
void mesh_mend(struct mesh *m);
#endif
