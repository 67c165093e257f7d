/* surfaces.h - primitives that become meshes: bicubic patches, height fields
 * and parametric surfaces. */
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

/* The point at u, v; what is not finite is no part of the surface. */
typedef void surface_point(void *context, double u, double v, double p[3]);

/* What BRUME_SHAPE_PARAMETRIC tells, with smooth normals along d/du x d/dv, to
 * its accuracy: how far the middles of edges may lie off their chords, though
 * along u and along v there are not more than 1025 lines. max_gradient and the
 * depth of precompute are not needed. Nothing in the container: no triangle. */
struct mesh *surface_parametric(const struct brume_shape *shape,
                                surface_point *point, void *context,
                                struct brume_error *err);
#endif
