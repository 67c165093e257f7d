/* ball_glow.h - how much of a list of glowing voxels lies in a ball.
 *
 * Lines through the ball, along a row of voxels each and even in the other two
 * axes, are cut by it at places that are known; what the voxels between these
 * have together tell the running sums of each brick, at two places of it. So a
 * line costs as much as the bricks that it crosses, not as its voxels. */
#ifndef CORE_PHYSICS_BALL_GLOW_H
#define CORE_PHYSICS_BALL_GLOW_H
#include "core/physics/glow.h"

/* Lines in a ball's radius, at least, and the most of them in a voxel. */
#define BALL_LINES 12.0f
#define BALL_MOST_LINES 16

/* A ball over voxels. */
typedef struct {
    vec3 at;                /* its middle, from the list's origin on       */
    vec3 x, y, z;           /* a voxel's edges                             */
    float square;           /* of its radius                               */
    int lines;              /* of each voxel, along y and along z          */
    int lo[2], hi[2];       /* y and z of those that may meet it: lo to
                               hi - 1                                      */
} ball_box;

/* The column i of an affine map. */
HD vec3 ball_edge(const affine *a, int i)
{
    return vec3_make(a->m[i], a->m[4 + i], a->m[8 + i]);
}

HD float ball_reach(const affine *a, int i, float r)
{
    const float *m = a->m + 4 * i;
    return r * vec3_length(vec3_make(m[0], m[1], m[2]));
}

HD ball_box ball_box_make(const flat_glow *g, vec3 x, float r)
{
    ball_box b;
    float reach[2];
    b.at = vec3_sub(affine_point(&g->to_index, x),
                    vec3_make((float)g->origin[0], (float)g->origin[1],
                              (float)g->origin[2]));
    b.x = ball_edge(&g->from_index, 0);
    b.y = ball_edge(&g->from_index, 1);
    b.z = ball_edge(&g->from_index, 2);
    b.square = r * r;
    reach[0] = ball_reach(&g->to_index, 1, r);
    reach[1] = ball_reach(&g->to_index, 2, r);
    float least = hd_min(reach[0], reach[1]);
    b.lines = 1;
    while (b.lines < BALL_MOST_LINES && (float)b.lines * least < BALL_LINES)
        b.lines++;
    for (int i = 0; i < 2; i++) {
        float at = i ? b.at.z : b.at.y, lines = (float)b.lines;
        b.lo[i] = hd_floor((at - reach[i]) * lines);
        b.hi[i] = hd_floor((at + reach[i]) * lines) + 1;
    }
    return b;
}

/* Running sum of a row of a brick's voxels, up to the place x of 0 to 8;
 * `below`: that before the row. */
HD float ball_running(const float *row, float below, float x)
{
    int i = (int)x;
    float from = i > 0 ? row[i - 1] : below;
    return i < 8 ? from + (x - (float)i) * (row[i] - from) : from;
}

/* What the voxels of row (y, z) have between a and b, of the list's all. */
HD float ball_row(const flat_scene *s, const flat_glow *g, int y, int z,
                  float a, float b)
{
    float sum = 0.0f;
    if (y < 0 || z < 0 || y >= 8 * g->bricks[1] || z >= 8 * g->bricks[2])
        return sum;
    const int32_t *slots = s->glow_slots + g->slot + (int64_t)g->bricks[0] *
                           ((y >> 3) + (int64_t)g->bricks[1] * (z >> 3));
    int row = ((z & 7) * 8 + (y & 7)) * 8;
    a = hd_max(a, 0.0f);
    b = hd_min(b, (float)(8 * g->bricks[0]));
    for (int brick = (int)a >> 3; a < b; brick++) {
        float first = (float)(8 * brick), end = hd_min(b, first + 8.0f);
        int32_t i = slots[brick];
        if (i >= 0) {
            const float *v = s->glow_voxels + (g->first + (uint64_t)i) * 512;
            float below = glow_below(v, row);
            sum += (ball_running(v + row, below, end - first) -
                    ball_running(v + row, below, a - first)) *
                   glow_brick_probability(s, g, i);
        }
        a = end;
    }
    return sum;
}

/* Mean of glow_pdf over a ball, of a list. */
HD float ball_glow(const flat_scene *s, const flat_glow *g, vec3 x, float r)
{
    ball_box b = ball_box_make(g, x, r);
    float inverse = 1.0f / vec3_dot(b.x, b.x), step = 1.0f / (float)b.lines;
    double sum = 0.0, all = 0.0;
    for (int k = b.lo[1]; k < b.hi[1]; k++) {
        float z = ((float)k + 0.5f) * step;
        vec3 across = vec3_scale(b.z, z - b.at.z);
        for (int j = b.lo[0]; j < b.hi[0]; j++) {
            float y = ((float)j + 0.5f) * step;
            vec3 off = vec3_mad(across, y - b.at.y, b.y);
            float near = -vec3_dot(off, b.x) * inverse;
            float half = near * near +
                         (b.square - vec3_dot(off, off)) * inverse;
            if (!(half > 0.0f))
                continue;
            half = sqrtf(half);
            all += (double)(2.0f * half);
            sum += (double)ball_row(s, g, hd_floor(y), hd_floor(z),
                                    b.at.x + near - half,
                                    b.at.x + near + half);
        }
    }
    /* Smaller than what is between lines, it lies in a voxel. */
    return all > 0.0 ? g->probability * (float)(sum / all) / g->voxel_volume
                     : glow_pdf(s, g, x);
}

#endif
