/* grid.h - lookup in a flat grid of bricks. */
#ifndef CORE_PHYSICS_GRID_H
#define CORE_PHYSICS_GRID_H
#include "core/physics/scene.h"

HD float grid_lerp(float a, float b, float t)
{
    return a + t * (b - a);
}

HD float grid_trilinear(const float *v, float fx, float fy, float fz)
{
    const int dy = BRICK_SIDE, dz = BRICK_SIDE * BRICK_SIDE;
    float a = grid_lerp(grid_lerp(v[0], v[1], fx),
                        grid_lerp(v[dy], v[dy + 1], fx), fy);
    float b = grid_lerp(grid_lerp(v[dz], v[dz + 1], fx),
                        grid_lerp(v[dz + dy], v[dz + dy + 1], fx), fy);
    return grid_lerp(a, b, fz);
}

HD bool grid_clipped(const flat_grid *g, vec3 p)
{
    return p.x < g->clip_min[0] || p.x > g->clip_max[0] ||
           p.y < g->clip_min[1] || p.y > g->clip_max[1] ||
           p.z < g->clip_min[2] || p.z > g->clip_max[2];
}

/* A point in the grid's own space, in which voxels begin at whole numbers.
 * Local before conversion, so that huge points compare as outside. */
HD vec3 grid_local(const flat_grid *g, vec3 p)
{
    if (g->nearest)
        p = vec3_add(p, vec3_make(0.5f, 0.5f, 0.5f));
    return vec3_sub(p, vec3_make((float)g->origin[0], (float)g->origin[1],
                                 (float)g->origin[2]));
}

/* The voxel around a point, or, sample being NULL, the value of all places
 * around it. */
typedef struct {
    const float *sample;    /* that of its lowest corner                   */
    vec3 corner;
    float value;
} grid_voxel;

/* NaN fails every test. */
HD grid_voxel grid_voxel_at(const flat_scene *s, const flat_grid *g, vec3 p)
{
    grid_voxel v;
    v.sample = 0;
    v.corner = vec3_make(0.0f, 0.0f, 0.0f);
    v.value = 0.0f;
    if (!(p.x >= 0.0f && p.x < (float)(8 * g->bricks[0]) && p.y >= 0.0f &&
          p.y < (float)(8 * g->bricks[1]) && p.z >= 0.0f &&
          p.z < (float)(8 * g->bricks[2]))) {
        v.value = s->tiles[g->tile];
        return v;
    }
    int x = (int)p.x, y = (int)p.y, z = (int)p.z;
    uint64_t brick = (uint64_t)(x >> 3) +
        (uint64_t)g->bricks[0] * ((uint64_t)(y >> 3) +
                                  (uint64_t)g->bricks[1] * (uint64_t)(z >> 3));
    int32_t slot = s->slots[g->slot + brick];
    if (slot < 0) {
        v.value = s->tiles[g->tile + (uint64_t)(-1 - slot)];
        return v;
    }
    v.sample = s->voxels + (g->brick + (uint64_t)slot) * BRICK_FLOATS +
               ((z & 7) * BRICK_SIDE + (y & 7)) * BRICK_SIDE + (x & 7);
    v.corner = vec3_make((float)x, (float)y, (float)z);
    return v;
}

/* Value at a place from its corner on. */
HD float grid_inside(const flat_grid *g, const grid_voxel *v, vec3 at)
{
    return g->nearest ? v->sample[0]
                      : grid_trilinear(v->sample, at.x, at.y, at.z);
}

/* Value at a point of index space. */
HD float grid_lookup(const flat_scene *s, const flat_grid *g, vec3 p)
{
    if (g->clip && grid_clipped(g, p))
        return 0.0f;
    p = grid_local(g, p);
    grid_voxel v = grid_voxel_at(s, g, p);
    return v.sample ? grid_inside(g, &v, vec3_sub(p, v.corner)) : v.value;
}

#endif
