/* glow.h - emitting voxels as a light: choose a point by its emission.
 *
 * A list holds the voxels of one emitting medium, brick by brick, with
 * cumulative probabilities. Emission that reaches a vertex can be found by
 * choosing such a point, or along the ray that leaves the vertex; both sides
 * weigh by the pair of densities below, so that they add to one point by
 * point (METHODS.md 3; Villemin and Hery 2013). */
#ifndef CORE_PHYSICS_GLOW_H
#define CORE_PHYSICS_GLOW_H
#include "core/physics/grid.h"
#include "core/physics/rng.h"

typedef struct {
    vec3 p;
    int32_t medium;
    float pdf;              /* per unit-space volume; 0: nothing chosen    */
} glow_sample;

HD float glow_below(const float *cumulative, int i)
{
    return i > 0 ? cumulative[i - 1] : 0.0f;
}

/* First index whose cumulative probability exceeds u. */
HD int glow_find(const float *cumulative, int count, double u)
{
    int lo = 0, hi = count - 1;
    while (lo < hi) {
        int mid = (lo + hi) / 2;
        if ((double)cumulative[mid] > u)
            hi = mid;
        else
            lo = mid + 1;
    }
    return lo;
}

HD int glow_find_brick(const glow_brick *bricks, uint64_t count, double u)
{
    int lo = 0, hi = (int)count - 1;
    while (lo < hi) {
        int mid = (lo + hi) / 2;
        if ((double)bricks[mid].cumulative > u)
            hi = mid;
        else
            lo = mid + 1;
    }
    return lo;
}

/* Probability of brick i of a list. */
HD float glow_share(const glow_brick *list, int64_t i)
{
    return list[i].cumulative - (i > 0 ? list[i - 1].cumulative : 0.0f);
}

HD float glow_brick_probability(const flat_scene *s, const flat_glow *g,
                                int64_t i)
{
    return glow_share(s->glow_bricks + g->first, i);
}

/* Density with which glow_choose takes the point p of this list. */
HD float glow_pdf(const flat_scene *s, const flat_glow *g, vec3 p)
{
    vec3 q = affine_point(&g->to_index, p);
    float limit = 1e9f;
    if (!(fabsf(q.x) < limit && fabsf(q.y) < limit && fabsf(q.z) < limit))
        return 0.0f;
    int x = hd_floor(q.x) - g->origin[0];
    int y = hd_floor(q.y) - g->origin[1];
    int z = hd_floor(q.z) - g->origin[2];
    if (x < 0 || y < 0 || z < 0 || x >= 8 * g->bricks[0] ||
        y >= 8 * g->bricks[1] || z >= 8 * g->bricks[2])
        return 0.0f;
    int64_t brick = (x >> 3) + (int64_t)g->bricks[0] *
                    ((y >> 3) + (int64_t)g->bricks[1] * (z >> 3));
    int32_t i = s->glow_slots[g->slot + (uint64_t)brick];
    if (i < 0)
        return 0.0f;
    const float *v = s->glow_voxels + (g->first + (uint64_t)i) * 512;
    int voxel = ((z & 7) * 8 + (y & 7)) * 8 + (x & 7);
    float probability = v[voxel] - glow_below(v, voxel);
    return g->probability * probability * glow_brick_probability(s, g, i) /
           g->voxel_volume;
}

/* *u: what is left of it within the list. */
HD int glow_choose_list(const flat_scene *s, double *u)
{
    int last = (int)s->glows_count - 1;
    for (int i = 0; i < last; i++) {
        if (*u < (double)s->glows[i].probability)
            return i;
        *u -= (double)s->glows[i].probability;
    }
    return last;
}

/* A point of a voxel of brick i of a list. */
HD glow_sample glow_point(const flat_scene *s, const flat_glow *g, int i,
                          int voxel, rng *r)
{
    const glow_brick *bricks = s->glow_bricks + g->first;
    const float *v = s->glow_voxels + (g->first + (uint64_t)i) * 512;
    /* One after the other: arguments have no order. */
    float x = rng_float(r), y = rng_float(r), z = rng_float(r);
    vec3 q = vec3_make((float)(bricks[i].corner[0] + (voxel & 7)) + x,
                       (float)(bricks[i].corner[1] + (voxel >> 3 & 7)) + y,
                       (float)(bricks[i].corner[2] + (voxel >> 6)) + z);
    glow_sample out;
    out.p = affine_point(&g->from_index, q);
    out.medium = g->medium;
    out.pdf = g->probability * glow_brick_probability(s, g, i) *
              (v[voxel] - glow_below(v, voxel)) / g->voxel_volume;
    return out;
}

/* A point of some emitting voxel; the scene has at least one list. */
HD glow_sample glow_choose(const flat_scene *s, rng *r)
{
    double u = (double)rng_float(r);
    const flat_glow *g = &s->glows[glow_choose_list(s, &u)];
    int i = glow_find_brick(s->glow_bricks + g->first, g->count,
                            (double)rng_float(r));
    const float *v = s->glow_voxels + (g->first + (uint64_t)i) * 512;
    return glow_point(s, g, i, glow_find(v, 512, (double)rng_float(r)), r);
}

/* The same, its voxel at the place u, in [0, 1), of all that are in order: of
 * n even places each voxel has its share of n, rounded up or down (PAPER.md,
 * section 3). */
HD glow_sample glow_choose_at(const flat_scene *s, double u, rng *r)
{
    const flat_glow *g = &s->glows[glow_choose_list(s, &u)];
    const glow_brick *bricks = s->glow_bricks + g->first;
    u /= (double)g->probability;
    int i = glow_find_brick(bricks, g->count, u);
    double below = i > 0 ? (double)bricks[i - 1].cumulative : 0.0;
    double share = (double)bricks[i].cumulative - below;
    const float *v = s->glow_voxels + (g->first + (uint64_t)i) * 512;
    return glow_point(s, g, i, glow_find(v, 512, (u - below) / share), r);
}

/* Share of the emission of `medium` at p, distance t from a vertex, that the
 * ray leaving the vertex with density p_dir per solid angle counts; choosing
 * points counts the rest. p_dir 0: nothing was chosen, all is counted. */
HD float glow_ray_share(const flat_scene *s, int medium, vec3 p, float t,
                        float p_dir)
{
    if (p_dir == 0.0f)
        return 1.0f;
    const flat_medium *m = scene_medium(s, medium);
    if (m->glow < 0)
        return 1.0f;
    float chosen = glow_pdf(s, &s->glows[m->glow], p) * t * t;
    /* A ratio, so that the peak of a phase function cannot overflow. */
    return 1.0f / (1.0f + chosen / (p_dir * m->kappa));
}

#endif
