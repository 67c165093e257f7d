/* kd_step.h - where a node of the kd-tree is split: the surface area heuristic
 * over bins (Shevtsov, Soupikov, Kapustin 2007), alike on the host and on a
 * GPU. */
#ifndef CORE_PHYSICS_KD_STEP_H
#define CORE_PHYSICS_KD_STEP_H
#include "core/physics/kdtree.h"

enum { KD_BINS = 48 };

/* Of the cost of a node, in tests of an item; what an empty child saves. */
#define KD_VISIT 3.0f
#define KD_EMPTY 0.8f

/* A node that is still to be made. */
typedef struct {
    float lo[3], hi[3];
    uint64_t count;         /* items                                       */
    int32_t depth, worse;   /* splits above that cost more than a leaf     */
} kd_task;

typedef struct {
    int32_t axis;           /* -1: there is none, it is to be a leaf       */
    float at, cost;
} kd_split;

HD float kd_half_area(const float lo[3], const float hi[3])
{
    float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
}

/* The plane below bin i; the same number wherever it is asked for. */
HD float kd_plane(const kd_task *t, int axis, int i)
{
    float extent = t->hi[axis] - t->lo[axis];
    return t->lo[axis] + extent * ((float)i / (float)KD_BINS);
}

/* The bin of a coordinate in the node. */
HD int kd_bin(const kd_task *t, int axis, float x)
{
    float extent = t->hi[axis] - t->lo[axis];
    int b = (int)((float)KD_BINS * ((x - t->lo[axis]) / extent));
    return b < 0 ? 0 : b >= KD_BINS ? KD_BINS - 1 : b;
}

/* Whether the node may be split at all. */
HD bool kd_may_split(const kd_task *t, int deepest)
{
    return t->count > 1 && t->depth < deepest;
}

/* Cost of a split below bin i > 0, with so many items on its sides; infinite
 * where it is none. */
HD float kd_cost(const kd_task *t, int axis, int i, uint64_t below,
                 uint64_t above)
{
    float at = kd_plane(t, axis, i), lo[3], hi[3];
    if (!(at > t->lo[axis] && at < t->hi[axis]))
        return INFINITY;
    for (int k = 0; k < 3; k++) {
        lo[k] = k == axis ? at : t->lo[k];
        hi[k] = k == axis ? at : t->hi[k];
    }
    float cost = kd_half_area(t->lo, hi) * (float)below +
                 kd_half_area(lo, t->hi) * (float)above;
    return below == 0 || above == 0 ? KD_EMPTY * cost : cost;
}

/* Takes the best split of all, or none; a node may have some that cost more
 * than a leaf. */
HD void kd_decide(kd_task *t, kd_split *best)
{
    float area = kd_half_area(t->lo, t->hi), leaf = area * (float)t->count;
    best->cost += KD_VISIT * area;
    t->worse += best->cost > leaf;
    if (best->cost > 4.0f * leaf || t->worse > 2 ||
        (best->cost > leaf && t->count < 8))
        best->axis = -1;
}

/* The parts below and above a split. */
HD void kd_cut(const kd_task *t, const kd_split *s, kd_task *below,
               kd_task *above)
{
    *below = *above = *t;
    below->hi[s->axis] = above->lo[s->axis] = s->at;
    below->depth = above->depth = t->depth + 1;
}

#endif
