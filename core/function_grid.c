/* Grids looked up by functions while the scene is read: in double, in the
 * host's bricks, as physics/grid.h does it in those of a renderer. */
#define PHYSICS_DOUBLE
#include <math.h>
#include "core/function.h"

static bool is_outside(const struct grid *g, const double p[3])
{
    for (int i = 0; i < 3; i++) {
        double low = g->clip ? g->clip_min[i] : -1e9;
        double high = g->clip ? g->clip_max[i] : 1e9;
        if (!(p[i] >= low && p[i] <= high))
            return true;
    }
    return false;
}

static double trilinear(const struct grid *g, const double p[3])
{
    double sum = 0.0;
    int at[3];
    for (int i = 0; i < 3; i++)
        at[i] = (int)floor(p[i]);
    for (int c = 0; c < 8; c++) {
        double weight = 1.0;
        int near[3];
        for (int i = 0; i < 3; i++) {
            int far = c >> i & 1;
            double u = p[i] - at[i];
            weight *= far ? u : 1.0 - u;
            near[i] = at[i] + far;
        }
        if (weight > 0.0)
            sum += weight * (double)grid_sample(g, near[0], near[1], near[2]);
    }
    return sum;
}

double machine_grid(const machine *m, int id, real3 index)
{
    const struct grid *g = ((struct grid *const *)m->grids)[id];
    const double p[3] = {index.x, index.y, index.z};
    if (is_outside(g, p))
        return g->clip ? 0.0 : (double)g->tile[0];
    if (g->filter == GRID_TRILINEAR)
        return trilinear(g, p);
    return (double)grid_sample(g, (int)floor(p[0] + 0.5),
                               (int)floor(p[1] + 0.5), (int)floor(p[2] + 0.5));
}

bool brume_function_grid(struct brume_function *function, int grid,
                         struct brume_error *err)
{
    const struct brume_scene *s = function_scene(function);
    int32_t first = 0;
    if (grid < 0 || (size_t)grid >= s->grids_count)
        return function_fail(function, err, BRUME_ERR_SCENE,
                             "there is no such grid for a function");
    const struct grid *g = s->grids[grid];
    matrix to_world = matrix_from(g->to_world), to_index;
    matrix_invert(&to_world, &to_index);
    return function_numbers(function, to_index.m[0], 12, &first, err) &&
           function_wide(function, MACHINE_GRID, 3, 1, first, 0, grid, err);
}
