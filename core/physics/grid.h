/* grid.h - lookup in a flat grid of bricks. */
#ifndef CORE_PHYSICS_GRID_H
#define CORE_PHYSICS_GRID_H
#include "core/physics/scene.h"

HD float grid_lerp(float a, float b, float t)
{
    return a + t * (b - a);
}

/* The samples at the corners of a voxel. */
typedef struct {
    float v[8];
} grid_eight;

HD grid_eight grid_load(const float *v)
{
    const int dy = BRICK_SIDE, dz = BRICK_SIDE * BRICK_SIDE;
    grid_eight out;
    for (int i = 0; i < 8; i++)
        out.v[i] = v[(i & 1) + (i & 2 ? dy : 0) + (i & 4 ? dz : 0)];
    return out;
}

HD float grid_trilinear(const grid_eight *c, vec3 at)
{
    const float *v = c->v;
    float a = grid_lerp(grid_lerp(v[0], v[1], at.x),
                        grid_lerp(v[2], v[3], at.x), at.y);
    float b = grid_lerp(grid_lerp(v[4], v[5], at.x),
                        grid_lerp(v[6], v[7], at.x), at.y);
    return grid_lerp(a, b, at.z);
}

HD bool grid_clipped(const flat_grid *g, vec3 p)
{
    return p.x < g->clip_min[0] || p.x > g->clip_max[0] ||
           p.y < g->clip_min[1] || p.y > g->clip_max[1] ||
           p.z < g->clip_min[2] || p.z > g->clip_max[2];
}

/* From the grid's lowest corner on. */
HD vec3 grid_from(const flat_grid *g, vec3 p)
{
    return vec3_sub(p, vec3_make((float)g->origin[0], (float)g->origin[1],
                                 (float)g->origin[2]));
}

/* A point in the grid's own space, in which voxels begin at whole numbers.
 * Local before conversion, so that huge points compare as outside. */
HD vec3 grid_local(const flat_grid *g, vec3 p)
{
    if (g->nearest)
        p = vec3_add(p, vec3_make(0.5f, 0.5f, 0.5f));
    return grid_from(g, p);
}

/* Where a point lies among bricks: the same for all grids of a layout. */
typedef struct {
    uint32_t brick;         /* or GRID_OUTSIDE                             */
    uint32_t sample;        /* that of its voxel's lowest corner, in there */
    vec3 corner;
} grid_spot;

#define GRID_OUTSIDE UINT32_MAX

/* NaN fails every test. */
HD grid_spot grid_spot_of(const flat_grid *g, vec3 p)
{
    grid_spot out;
    out.brick = GRID_OUTSIDE;
    out.sample = 0u;
    out.corner = vec3_make(0.0f, 0.0f, 0.0f);
    if (!(p.x >= 0.0f && p.x < (float)(8 * g->bricks[0]) && p.y >= 0.0f &&
          p.y < (float)(8 * g->bricks[1]) && p.z >= 0.0f &&
          p.z < (float)(8 * g->bricks[2])))
        return out;
    int x = (int)p.x, y = (int)p.y, z = (int)p.z;
    out.brick = (uint32_t)(x >> 3) +
                (uint32_t)g->bricks[0] *
                    ((uint32_t)(y >> 3) +
                     (uint32_t)g->bricks[1] * (uint32_t)(z >> 3));
    out.sample = (uint32_t)(((z & 7) * BRICK_SIDE + (y & 7)) * BRICK_SIDE +
                            (x & 7));
    out.corner = vec3_make((float)x, (float)y, (float)z);
    return out;
}

/* A voxel, or the value of all places around it. */
typedef struct {
    bool stored;
    const float *sample;    /* of what is stored: that of its lowest corner */
    float value;            /* ... of what is not                          */
} grid_voxel;

/* The first constant is that of all places outside of the bricks. */
HD grid_voxel grid_voxel_at(const flat_scene *s, const flat_grid *g,
                            uint32_t brick, uint32_t sample)
{
    grid_voxel v;
    int32_t slot = brick != GRID_OUTSIDE ? s->slots[g->slot + brick] : -1;
    v.stored = slot >= 0;
    v.sample = s->voxels;
    v.value = 0.0f;
    if (v.stored)
        v.sample += (g->brick + (uint64_t)slot) * BRICK_FLOATS + sample;
    else
        v.value = s->tiles[g->tile + (uint64_t)(-1 - slot)];
    return v;
}

/* Value at a place from its corner on. */
HD float grid_inside(const flat_grid *g, const grid_voxel *v, vec3 at)
{
    if (g->nearest)
        return v->sample[0];
    grid_eight c = grid_load(v->sample);
    return grid_trilinear(&c, at);
}

/* Value at a point of index space. */
HD float grid_lookup(const flat_scene *s, const flat_grid *g, vec3 p)
{
    if (g->clip && grid_clipped(g, p))
        return 0.0f;
    p = grid_local(g, p);
    grid_spot spot = grid_spot_of(g, p);
    grid_voxel v = grid_voxel_at(s, g, spot.brick, spot.sample);
    return v.stored ? grid_inside(g, &v, vec3_sub(p, spot.corner)) : v.value;
}

#endif
