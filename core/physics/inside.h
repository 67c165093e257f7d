/* inside.h - which containers of media a point lies in. */
#ifndef CORE_PHYSICS_INSIDE_H
#define CORE_PHYSICS_INSIDE_H
#include "core/physics/bvh.h"
#include "core/physics/walk.h"

/* A mesh's first boundary along some ray tells: it is left, or entered. */
HD bool inside_mesh(const flat_scene *s, int32_t shape, vec3 p)
{
    bvh_ray r = bvh_ray_make(p, vec3_make(0.5626f, 0.6874f, 0.4593f));
    ray_hit after = hit_start(0.0f);
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, INFINITY);
        if (h.shape < 0)
            return (s->shapes[shape].flags & SHAPE_INVERSE) != 0;
        if (h.shape == shape)
            return h.turn == TURN_OUT;
        after = h;
    }
}

HD bool inside_shape(const flat_scene *s, int32_t shape, vec3 p)
{
    const flat_shape *f = &s->shapes[shape];
    csg_place at = csg_at_point(p);
    if (scene_may(MAY_COMPOSITES) && f->kind == SHAPE_COMPOSITE)
        return csg_holds(s, f->node, &at);
    if (scene_may(MAY_MESHES) && f->kind == SHAPE_MESH && f->tree < 0)
        return f->triangles > 0 && inside_mesh(s, shape, p);
    return csg_primitive(s, shape, &at);
}

/* A point beside p, on its way along d, about of length 1: where p is on a face
 * it is on the side to which d leads. */
HD vec3 inside_beside(vec3 p, vec3 d)
{
    float size = hd_max(fabsf(p.x), hd_max(fabsf(p.y), fabsf(p.z)));
    return vec3_mad(p, 1.52587891e-05f * hd_max(size, 1.0f), d);
}

/* All hollow shapes with media around the point p. */
HD void inside_find(const flat_scene *s, vec3 p, container_set *set)
{
    set->count = 0;
    set->lost = 0;
    for (uint64_t i = 0; i < s->shapes_count; i++) {
        const flat_shape *f = &s->shapes[i];
        if (f->interior >= 0 && (f->flags & SHAPE_HOLLOW) &&
            inside_shape(s, (int32_t)i, p))
            container_enter(set, (int32_t)i);
    }
}

#endif
