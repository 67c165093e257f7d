/* shoot.h - trees that a GPU builds, and rays that it sends through them; what
 * tests/gpu/trees.c asks of shoot.cu. */
#ifndef TESTS_GPU_SHOOT_H
#define TESTS_GPU_SHOOT_H
#include "core/flat.h"
#include "core/physics/bvh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum shoot_tree { SHOOT_BVH, SHOOT_KD };

/* A scene on the device, with the tree that is in it, or none. */
struct shoot;
struct shoot *shoot_new(const struct flat *flat, struct brume_error *err);
void shoot_free(struct shoot *s);

/* Builds a tree over all its triangles, so many times, and takes the median of
 * the milliseconds; it is the scene's from now on. Of a BVH a
 * search keeps `places` at most; *even: it had to be halved for that. */
bool shoot_build(struct shoot *s, enum shoot_tree tree, int places, int times,
                 double *milliseconds, bool *even, struct brume_error *err);

/* Puts the tree into a flat scene that has none. */
bool shoot_fetch(const struct shoot *s, struct flat *to,
                 struct brume_error *err);

/* The first hit of each ray; milliseconds: the median of so many times.
 * `shared`: stacks of the kd-tree lie in a block's memory. */
bool shoot_rays(struct shoot *s, bool shared, const bvh_ray *ray, size_t rays,
                ray_hit *hit, int times, double *milliseconds,
                struct brume_error *err);

#ifdef __cplusplus
}
#endif
#endif
