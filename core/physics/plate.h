/* plate.h - a picture that was made elsewhere, as one ray of the eye sees it: a
 * flat piece at the depth of its pixel, of its own light, which what is behind
 * it passes by what its alpha leaves.
 *
 * It is seen by the eye alone: it gives no light to the scene, and no shadow.
 * All samples of a pixel have that pixel's colour and depth, so that edges are
 * as sharp, and as mixed, as the plate has them. */
#ifndef CORE_PHYSICS_PLATE_H
#define CORE_PHYSICS_PLATE_H
#include "core/physics/ray.h"

typedef struct {
    rgb color;
    float pass;
    float t;                /* along the ray; infinite: behind all, or none */
} plate_view;

HD plate_view plate_none(void)
{
    plate_view v;
    v.color = rgb_gray(0.0f);
    v.pass = 1.0f;
    v.t = INFINITY;
    return v;
}

/* Of the ray along the unit vector d through that pixel of the picture. */
HD plate_view plate_seen(const flat_scene *s, uint64_t pixel, vec3 d)
{
    plate_view v = plate_none();
    if (!scene_may(MAY_PLATE) || s->plate_count == 0)
        return v;
    const plate_pixel *p = &s->plate[pixel];
    v.color = p->color;
    v.pass = p->pass;
    v.t = p->depth;
    if (!s->plate_ray)
        v.t /= vec3_dot(d, vec3_normalize(s->view.direction));
    return v;
}

/* Whether it is met before a ray's next hit, which then ends there. A surface
 * at the very same distance is before it. */
HD bool plate_cuts(const plate_view *v, ray_hit *h)
{
    if (!scene_may(MAY_PLATE) || !(v->t < h->t))
        return false;
    *h = hit_none(v->t);
    return true;
}

/* The ray goes on behind it, and meets it no more; none of the surfaces at its
 * distance is lost, or met again. */
HD void plate_cross(plate_view *v, ray_hit *after)
{
    const float before = 0.9999999f;
    if (after->t < before * v->t)
        *after = hit_start(before * v->t);
    *v = plate_none();
}

#endif
