/* ball_glow.h - how much of a list of glowing voxels lies in a ball.
 *
 * Lines through the ball, along a row of voxels each and even in the other two
 * axes, are cut by it at places that are known; what the voxels between these
 * have together tell the running sums of each brick, at two places of it. So a
 * line costs as much as the bricks that it crosses, not as its voxels. */
#ifndef CORE_PHYSICS_BALL_GLOW_H
#define CORE_PHYSICS_BALL_GLOW_H
#include "core/physics/glow.h"
#include "core/physics/team.h"

/* Lines in a ball's radius, at least, and the most of them in a voxel. */
#define BALL_LINES 12.0f
#define BALL_MOST_LINES 16

/* A ball over the voxels of a list. */
typedef struct {
    const int32_t *slots;   /* of the list's bricks                        */
    const float *voxels;
    const glow_brick *brick;
    int bricks[3];
    vec3 at;                /* its middle, from the list's origin on       */
    vec3 x, y, z;           /* a voxel's edges                             */
    float square;           /* of its radius                               */
    float inverse;          /* 1 / x^2                                     */
    float step;             /* between lines, in voxels                    */
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

HD ball_box ball_box_make(const flat_scene *s, const flat_glow *g, vec3 x,
                          float r)
{
    ball_box b;
    float reach[2];
    b.slots = s->glow_slots + g->slot;
    b.voxels = s->glow_voxels + g->first * 512;
    b.brick = s->glow_bricks + g->first;
    for (int i = 0; i < 3; i++)
        b.bricks[i] = g->bricks[i];
    b.at = vec3_sub(affine_point(&g->to_index, x),
                    vec3_make((float)g->origin[0], (float)g->origin[1],
                              (float)g->origin[2]));
    b.x = ball_edge(&g->from_index, 0);
    b.y = ball_edge(&g->from_index, 1);
    b.z = ball_edge(&g->from_index, 2);
    b.square = r * r;
    b.inverse = 1.0f / vec3_dot(b.x, b.x);
    reach[0] = ball_reach(&g->to_index, 1, r);
    reach[1] = ball_reach(&g->to_index, 2, r);
    float least = hd_min(reach[0], reach[1]);
    b.lines = 1;
    while (b.lines < BALL_MOST_LINES && (float)b.lines * least < BALL_LINES)
        b.lines++;
    b.step = 1.0f / (float)b.lines;
    for (int i = 0; i < 2; i++) {
        float at = i ? b.at.z : b.at.y, lines = (float)b.lines;
        b.lo[i] = hd_floor((at - reach[i]) * lines);
        b.hi[i] = hd_floor((at + reach[i]) * lines) + 1;
    }
    return b;
}

/* Running sum of a brick's voxels, up to the place x of 0 to 8 in the row whose
 * first is voxel `row`. */
HD float ball_running(const float *v, int row, float x)
{
    int i = (int)x;
    float from = glow_below(v, row + i);
    return i < 8 ? from + (x - (float)i) * (v[row + i] - from) : from;
}

/* What the voxels of row (y, z) have between a and b, of the list's all. */
HD float ball_row(const ball_box *box, int y, int z, float a, float b)
{
    float sum = 0.0f;
    if (y < 0 || z < 0 || y >= 8 * box->bricks[1] || z >= 8 * box->bricks[2])
        return sum;
    const int32_t *slots = box->slots + (int64_t)box->bricks[0] *
                           ((y >> 3) + (int64_t)box->bricks[1] * (z >> 3));
    int row = ((z & 7) * 8 + (y & 7)) * 8;
    a = hd_max(a, 0.0f);
    b = hd_min(b, (float)(8 * box->bricks[0]));
    for (int brick = (int)a >> 3; a < b; brick++) {
        float first = (float)(8 * brick), end = hd_min(b, first + 8.0f);
        int64_t i = slots[brick];
        if (i >= 0) {
            const float *v = box->voxels + i * 512;
            sum += (ball_running(v, row, end - first) -
                    ball_running(v, row, a - first)) *
                   glow_share(box->brick, i);
        }
        a = end;
    }
    return sum;
}

/* Of lines: what glows on them, and their lengths. */
typedef struct {
    double glow, length;
} ball_sums;

/* Adds the line j along y and k along z, as far as it lies in the ball. */
HD void ball_line(const ball_box *b, int j, int k, ball_sums *sum)
{
    float y = ((float)j + 0.5f) * b->step, z = ((float)k + 0.5f) * b->step;
    vec3 off = vec3_mad(vec3_scale(b->z, z - b->at.z), y - b->at.y, b->y);
    float near = -vec3_dot(off, b->x) * b->inverse;
    float half = near * near + (b->square - vec3_dot(off, off)) * b->inverse;
    if (!(half > 0.0f))
        return;
    half = sqrtf(half);
    sum->length += (double)(2.0f * half);
    sum->glow += (double)ball_row(b, hd_floor(y), hd_floor(z),
                                  b->at.x + near - half,
                                  b->at.x + near + half);
}

/* All lines, each by one of the team. */
HD ball_sums ball_lines(const ball_box *b, team t)
{
    ball_sums sum = {0.0, 0.0};
    int j = b->lo[0] + t.place, k = b->lo[1], wide = b->hi[0] - b->lo[0];
    for (;; j += t.size) {
        for (; j >= b->hi[0] && k < b->hi[1]; k++)
            j -= wide;
        if (k >= b->hi[1])
            break;
        ball_line(b, j, k, &sum);
    }
    sum.glow = team_sum(t, sum.glow);
    sum.length = team_sum(t, sum.length);
    return sum;
}

/* Mean of glow_pdf over a ball, of a list. */
HD float ball_glow(const flat_scene *s, const flat_glow *g, vec3 x, float r,
                   team t)
{
    ball_box b = ball_box_make(s, g, x, r);
    ball_sums sum = ball_lines(&b, t);
    /* Smaller than what is between lines, it lies in a voxel. */
    return sum.length > 0.0 ? g->probability *
                                  (float)(sum.glow / sum.length) /
                                  g->voxel_volume
                            : glow_pdf(s, g, x);
}

#endif
