/* A sparse grid of 1024^3 voxels, deterministic: balls whose bricks take one
 * part in a hundred of it. For long/memory.sh.
 *
 *   sparse FILE            writes an OpenVDB file, prints what it holds */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "lib/grid.h"
#include "lib/vdb.h"

enum { SIDE = 1024, BRICKS = SIDE / GRID_BRICK, BALLS = 64 };

/* Radius of each ball in voxels: 64 of them with the bricks at their faces take
 * 1 % of the cube. */
#define RADIUS 30.0

static struct brume_error err;

static void require(bool good)
{
    if (good)
        return;
    fprintf(stderr, "sparse: %s\n", err.text);
    exit(err.code ? (int)err.code : 1);
}

/* The middles: multiples of powers of the generalised golden ratio, x^4 = x + 1
 * [Roberts 2018]. */
static void middle(int ball, double out[3])
{
    const double step[3] = {0.8191725133961645, 0.6710436067037893,
                            0.5497004779019703};
    for (int i = 0; i < 3; i++) {
        double u = 0.5 + step[i] * (ball + 1);
        out[i] = RADIUS + 8.0 + (u - floor(u)) * (SIDE - 2.0 * (RADIUS + 8.0));
    }
}

/* Thick in the middle, thin outside, 0 at the radius. */
static float density(const double m[3], int x, int y, int z)
{
    double dx = x + 0.5 - m[0], dy = y + 0.5 - m[1], dz = z + 0.5 - m[2];
    double r = sqrt(dx * dx + dy * dy + dz * dz) / RADIUS;
    return r < 1.0 ? (float)(1.0 - r * r) : 0.0f;
}

/* Of one brick, if anything of the ball is in it. */
static void fill_brick(struct grid *g, const double m[3], const int at[3])
{
    float value[GRID_BRICK_VOXELS];
    bool any = false;
    for (int i = 0; i < GRID_BRICK_VOXELS; i++) {
        value[i] = density(m, 8 * at[0] + i % 8, 8 * at[1] + i / 8 % 8,
                           8 * at[2] + i / 64);
        any = any || value[i] > 0.0f;
    }
    if (!any)
        return;
    float *brick = grid_brick(g, at[0], at[1], at[2], &err);
    require(brick != NULL);
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        brick[i] = fmaxf(brick[i], value[i]);
}

static void fill_ball(struct grid *g, int ball)
{
    double m[3];
    int lo[3], hi[3], at[3];
    middle(ball, m);
    for (int i = 0; i < 3; i++) {
        lo[i] = (int)((m[i] - RADIUS) / GRID_BRICK);
        hi[i] = (int)((m[i] + RADIUS) / GRID_BRICK);
    }
    for (at[2] = lo[2]; at[2] <= hi[2]; at[2]++)
        for (at[1] = lo[1]; at[1] <= hi[1]; at[1]++)
            for (at[0] = lo[0]; at[0] <= hi[0]; at[0]++)
                fill_brick(g, m, at);
}

int main(int count, char **word)
{
    const int32_t origin[3] = {0, 0, 0}, bricks[3] = {BRICKS, BRICKS, BRICKS};
    if (count != 2) {
        fprintf(stderr, "usage: sparse FILE\n");
        return 2;
    }
    struct grid *g = grid_new(origin, bricks, 0.0f, &err);
    require(g != NULL);
    for (int i = 0; i < BALLS; i++)
        fill_ball(g, i);
    snprintf(g->name, sizeof g->name, "density");
    for (int i = 0; i < 3; i++) {
        g->to_world[i][i] = 2.0 / SIDE;
        g->to_world[i][3] = 1.0 / SIDE - 1.0;
    }
    grid_finish(g);
    const struct grid *all[1] = {g};
    require(vdb_save(word[1], all, 1, VDB_SAVE_HALF | VDB_SAVE_ZIP, &err));
    printf("%d^3 voxels, %zu of %d bricks stored: %.2f %%\n", SIDE, g->stored,
           BRICKS * BRICKS * BRICKS,
           100.0 * (double)g->stored / (BRICKS * (double)BRICKS * BRICKS));
    grid_free(g);
    return 0;
}
