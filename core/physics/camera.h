/* camera.h - from a point of the picture to a ray. */
#ifndef CORE_PHYSICS_CAMERA_H
#define CORE_PHYSICS_CAMERA_H
#include "core/physics/vec.h"

typedef struct {
    int32_t orthographic;
    vec3 location, direction, up, right;    /* unit space, as brume_camera */
} camera;

/* The ray of the picture's point (u, v) in [-1/2, 1/2], v upward; *d is of
 * unit length. */
HD void camera_ray(const camera *c, float u, float v, vec3 *o, vec3 *d)
{
    vec3 side = vec3_mad(vec3_scale(c->right, u), v, c->up);
    *o = c->orthographic ? vec3_add(c->location, side) : c->location;
    *d = vec3_normalize(c->orthographic ? c->direction
                                        : vec3_add(c->direction, side));
}

#endif
