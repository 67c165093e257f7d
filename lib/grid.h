/* grid.h - a sparse scalar grid on the host: what the readers of df3 and
 * OpenVDB files fill, and what core/ takes over.
 *
 * Samples sit at integer coordinates of index space. The grid covers whole
 * bricks of 8x8x8 samples; a brick is stored, or is one constant. */
#ifndef LIB_GRID_H
#define LIB_GRID_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { GRID_BRICK = 8, GRID_BRICK_VOXELS = 512 };

enum grid_filter { GRID_NEAREST, GRID_TRILINEAR };

struct grid {
    char name[64];
    int32_t origin[3];      /* index of the first sample; multiples of 8   */
    int32_t bricks[3];      /* extent in bricks                            */
    int32_t *slot;          /* per brick, x fastest: >= 0 names a stored
                               brick, -1-k the constant tile[k]            */
    float *tile;            /* constants; tile[0] is the background        */
    size_t tiles;           /* >= 1                                        */
    float *voxel;           /* stored bricks of 512, x fastest             */
    size_t stored;          /* number of stored bricks                     */
    enum grid_filter filter;
    bool clip;              /* 0 outside [clip_min, clip_max] (df3's cube);
                               otherwise the background is outside         */
    double clip_min[3], clip_max[3];    /* index space                     */
    double to_world[3][4];  /* index space to the file's world: p' = A p + b */
    float lowest, highest;  /* over all samples, background included       */
    bool any_sign;          /* samples below 0 stay: a part of a velocity  */
    size_t bad_nan, bad_inf, bad_negative;  /* samples that were set to 0;
                               of particles: points that were left out     */
    size_t points;          /* particles that it was made of, or 0         */
    float radius[2];        /* the least and the largest of their balls    */
    bool own_radii;         /* each particle had its own                   */
    unsigned shares;        /* owners beside the first                     */
};

/* An empty grid of the given brick extent: every brick is tile 0, which is
 * `background`. NULL with err set where memory or the extent is too large. */
struct grid *grid_new(const int32_t origin[3], const int32_t bricks[3],
                      float background, struct brume_error *err);
/* Gives up a share; the last one frees it. */
void grid_free(struct grid *g);
/* One owner more, of any thread, to call grid_free too: from now on the grid
 * must not be changed. */
struct grid *grid_share(struct grid *g);
struct grid *grid_copy(const struct grid *g, struct brume_error *err);

/* The 512 samples of a brick, made (filled with its constant) if it was a
 * constant. Earlier pointers become invalid. NULL: out of memory, err set. */
float *grid_brick(struct grid *g, int bx, int by, int bz,
                  struct brume_error *err);
/* Makes a brick the constant `value`. */
bool grid_set_tile(struct grid *g, int bx, int by, int bz, float value,
                   struct brume_error *err);
/* The sample at integer index-space coordinates; background outside. */
float grid_sample(const struct grid *g, int x, int y, int z);

/* Last step of every reader: sets NaN, Inf and negative samples to 0 and
 * counts them, turns constant bricks into tiles, computes the range. */
void grid_finish(struct grid *g);

#ifdef __cplusplus
}
#endif
#endif
