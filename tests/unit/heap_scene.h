/* heap_scene.h - a heap of density and a sun, for tests of photons. */
#ifndef TESTS_UNIT_HEAP_SCENE_H
#define TESTS_UNIT_HEAP_SCENE_H
#include "core/physics/grid.h"
#include "tests/unit/truth.h"

/* A field of so many voxels a side, a multiple of 8, over a cube of sides 2
 * around the origin: exp(-steep r^2), r in voxels, within `reach` of its
 * middle. Returns its number. */
static inline int heap_add(brume_scene *s, int voxels, double steep,
                           double reach)
{
    const int32_t origin[3] = {0, 0, 0};
    const int32_t size[3] = {voxels / 8, voxels / 8, voxels / 8};
    struct grid *grid = grid_new(origin, size, 0.0f, truth_error());
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            grid->to_world[i][j] = i == j   ? 2.0 / voxels
                                   : j == 3 ? -1.0 + 1.0 / voxels
                                            : 0.0;
    for (int i = 0; i < voxels * voxels * voxels; i++) {
        int x = i % voxels, y = i / voxels % voxels, z = i / voxels / voxels;
        double middle = 0.5 * (voxels - 1);
        double p[3] = {x - middle, y - middle, z - middle};
        double r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        float *v = grid_brick(grid, x >> 3, y >> 3, z >> 3, truth_error());
        v[((z & 7) * 8 + (y & 7)) * 8 + (x & 7)] =
            (float)(r < reach ? exp(-steep * r * r) : 0.0);
    }
    grid_finish(grid);
    struct brume_field f = BRUME_FIELD_INIT;
    f.kind = BRUME_FIELD_GRID;
    f.grid = brume_add_grid(s, grid, truth_error());
    grid_free(grid);
    return brume_add_field(s, &f, truth_error());
}

/* White, from the left, above and before. */
static inline void heap_sun(brume_scene *s)
{
    struct brume_light l = BRUME_LIGHT_INIT;
    l.location[0] = -100.0;
    l.location[1] = 40.0;
    l.location[2] = -30.0;
    l.parallel = true;
    l.color[0] = l.color[1] = l.color[2] = 1.0;
    assert_true(brume_add_light(s, &l, truth_error()) >= 0);
}

#endif
