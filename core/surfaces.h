/* surfaces.h - primitives that become meshes: bicubic patches and height
 * fields. */
#ifndef CORE_SURFACES_H
#define CORE_SURFACES_H
#include "core/brume.h"

/* A patch as a grid of 2^u_steps by 2^v_steps with the normals of the patch;
 * fewer where its control points are as near to it as its flatness. NULL with
 * err set on failure. */
struct mesh *surface_patch(const struct brume_shape *shape,
                           struct brume_error *err);

/* A height field over the unit square, cut at the water level. What closes it
 * down to y = 0 follows *seen triangles of it, where `closed` asks for that. */
struct mesh *surface_heights(const struct brume_shape *shape, bool closed,
                             size_t *seen, struct brume_error *err);
#endif
