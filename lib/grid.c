#include "lib/grid.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

/* A slot array beyond this takes more than 1 GiB: such an extent comes from
 * a broken file, or from samples so far apart that no grid should hold them. */
#define MAX_BRICKS ((size_t)1 << 28)

/* The slots of bricks that are tile 0 are -1, all of whose bytes are 255. */
enum { BACKGROUND_SLOT = -1, BACKGROUND_BYTE = 0xff };

static size_t brick_count(const struct grid *g)
{
    return (size_t)g->bricks[0] * (size_t)g->bricks[1] * (size_t)g->bricks[2];
}

static bool check_extent(const int32_t origin[3], const int32_t bricks[3],
                         struct brume_error *err)
{
    size_t total = 1;
    for (int i = 0; i < 3; i++) {
        if (bricks[i] < 1 || origin[i] % GRID_BRICK != 0)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "a grid of %d bricks from sample %d is not one "
                              "of whole bricks",
                              bricks[i], origin[i]);
        int64_t end = origin[i] + (int64_t)bricks[i] * GRID_BRICK;
        if (!memory_multiply(total, (size_t)bricks[i], &total) ||
            total > MAX_BRICKS || end > INT32_MAX)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "a grid of %d x %d x %d bricks of 8^3 samples "
                              "is too large; the limit is %zu bricks",
                              bricks[0], bricks[1], bricks[2], MAX_BRICKS);
    }
    return true;
}

struct grid *grid_new(const int32_t origin[3], const int32_t bricks[3],
                      float background, struct brume_error *err)
{
    if (!check_extent(origin, bricks, err))
        return NULL;
    struct grid *g = memory_new(1, sizeof *g, err);
    if (!g)
        return NULL;
    memcpy(g->origin, origin, sizeof g->origin);
    memcpy(g->bricks, bricks, sizeof g->bricks);
    size_t slots = brick_count(g);
    g->slot = memory_new(slots, sizeof *g->slot, err);
    g->tile = memory_new(1, sizeof *g->tile, err);
    if (!g->slot || !g->tile) {
        grid_free(g);
        return NULL;
    }
    memset(g->slot, BACKGROUND_BYTE, slots * sizeof *g->slot);
    g->tile[0] = g->lowest = g->highest = background;
    g->tiles = 1;
    g->filter = GRID_TRILINEAR;
    for (int i = 0; i < 3; i++)
        g->to_world[i][i] = 1;
    return g;
}

void grid_free(struct grid *g)
{
    if (!g || __atomic_fetch_sub(&g->shares, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    free(g->voxel);
    free(g->tile);
    free(g->slot);
    free(g);
}

struct grid *grid_share(struct grid *g)
{
    __atomic_fetch_add(&g->shares, 1, __ATOMIC_RELAXED);
    return g;
}

static size_t slot_index(const struct grid *g, int bx, int by, int bz)
{
    return (size_t)bx + (size_t)g->bricks[0] *
                            ((size_t)by + (size_t)g->bricks[1] * (size_t)bz);
}

/* The struct keeps counts, not capacities: capacities are the powers of two
 * that the counts have outgrown. */
static void *grow(void *array, size_t count, size_t size,
                  struct brume_error *err)
{
    if (count & (count - 1))
        return array;
    size_t capacity = count, wanted = count > 0 ? 2 * count : 1;
    return memory_grow(array, &capacity, wanted, size, err);
}

float *grid_brick(struct grid *g, int bx, int by, int bz,
                  struct brume_error *err)
{
    int32_t *slot = &g->slot[slot_index(g, bx, by, bz)];
    if (*slot >= 0)
        return g->voxel + (size_t)*slot * GRID_BRICK_VOXELS;
    float *voxel = grow(g->voxel, g->stored, GRID_BRICK_VOXELS * sizeof *voxel,
                        err);
    if (!voxel)
        return NULL;
    g->voxel = voxel;
    float value = g->tile[-1 - *slot];
    float *brick = voxel + g->stored * GRID_BRICK_VOXELS;
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        brick[i] = value;
    *slot = (int32_t)g->stored++;
    return brick;
}

/* The slot of a constant, or 0 with err set. Runs of equal tiles, which are
 * what readers make, share one constant at once; grid_finish merges others. */
static int32_t tile_slot(struct grid *g, float value, struct brume_error *err)
{
    if (value == g->tile[0])
        return BACKGROUND_SLOT;
    if (value != g->tile[g->tiles - 1]) {
        float *tile = grow(g->tile, g->tiles, sizeof *tile, err);
        if (!tile)
            return 0;
        g->tile = tile;
        g->tile[g->tiles++] = value;
    }
    return -(int32_t)g->tiles;
}

bool grid_set_tile(struct grid *g, int bx, int by, int bz, float value,
                   struct brume_error *err)
{
    int32_t slot = tile_slot(g, value, err);
    if (slot == 0)
        return false;
    g->slot[slot_index(g, bx, by, bz)] = slot;
    return true;
}

float grid_sample(const struct grid *g, int x, int y, int z)
{
    int64_t at[3] = {x, y, z};
    for (int i = 0; i < 3; i++) {
        at[i] -= g->origin[i];
        if (at[i] < 0 || at[i] >= (int64_t)g->bricks[i] * GRID_BRICK)
            return g->tile[0];
    }
    int32_t slot = g->slot[slot_index(g, (int)(at[0] / GRID_BRICK),
                                      (int)(at[1] / GRID_BRICK),
                                      (int)(at[2] / GRID_BRICK))];
    if (slot < 0)
        return g->tile[-1 - slot];
    int64_t in_brick = at[0] % GRID_BRICK +
                       GRID_BRICK * (at[1] % GRID_BRICK +
                                     GRID_BRICK * (at[2] % GRID_BRICK));
    return g->voxel[(size_t)slot * GRID_BRICK_VOXELS + (size_t)in_brick];
}

/* ---- grid_finish: its steps in their order ---- */

/* What a bad sample counts as, and 0 in its place. */
static float clean(struct grid *g, float value, size_t samples)
{
    if (isnan(value))
        g->bad_nan += samples;
    else if (isinf(value))
        g->bad_inf += samples;
    else if (value < 0 && !g->any_sign)
        g->bad_negative += samples;
    else
        return value;
    return 0;
}

static bool is_clean(const struct grid *g, const float *brick)
{
    float least = g->any_sign ? -FLT_MAX : 0.0f;
    int bad = 0;
    for (int v = 0; v < GRID_BRICK_VOXELS; v++)
        bad |= !((brick[v] >= least) & (brick[v] <= FLT_MAX));
    return !bad;
}

static void clean_samples(struct grid *g)
{
    size_t slots = brick_count(g);
    for (size_t i = 0; i < slots; i++) {
        int32_t slot = g->slot[i];
        if (slot < 0) {
            clean(g, g->tile[-1 - slot], GRID_BRICK_VOXELS);
            continue;
        }
        float *brick = g->voxel + (size_t)slot * GRID_BRICK_VOXELS;
        if (is_clean(g, brick))
            continue;
        for (int v = 0; v < GRID_BRICK_VOXELS; v++)
            brick[v] = clean(g, brick[v], 1);
    }
    for (size_t k = 0; k < g->tiles; k++)
        g->tile[k] = clean(g, g->tile[k], 0);
}

static bool is_constant(const float *brick)
{
    for (int i = 1; i < GRID_BRICK_VOXELS; i++)
        if (brick[i] != brick[0])
            return false;
    return true;
}

/* Where memory for a tile is short a brick stays stored, which is right too. */
static void bricks_to_tiles(struct grid *g)
{
    size_t slots = brick_count(g);
    for (size_t i = 0; i < slots; i++) {
        if (g->slot[i] < 0)
            continue;
        const float *brick = g->voxel + (size_t)g->slot[i] * GRID_BRICK_VOXELS;
        int32_t slot = is_constant(brick) ? tile_slot(g, brick[0], NULL) : 0;
        if (slot != 0)
            g->slot[i] = slot;
    }
}

struct numbered {
    float value;
    int32_t from; /* its number among the tiles before              */
};

static int by_value(const void *a, const void *b)
{
    const struct numbered *p = a, *q = b;
    if (p->value != q->value)
        return p->value < q->value ? -1 : 1;
    return (p->from > q->from) - (p->from < q->from);
}

/* Lists the tiles that bricks use, sorted; `used` is one flag a tile. */
static size_t sort_used_tiles(const struct grid *g, const int32_t *used,
                              struct numbered *list)
{
    size_t count = 0;
    for (size_t k = 1; k < g->tiles; k++)
        if (used[k]) {
            list[count].value = g->tile[k];
            list[count++].from = (int32_t)k;
        }
    qsort(list, count, sizeof *list, by_value);
    return count;
}

/* Each constant once, in rising order after the background, and none that no
 * brick uses. Where memory is short the tiles stay as they are. */
static void merge_tiles(struct grid *g)
{
    size_t slots = brick_count(g);
    int32_t *place = calloc(g->tiles, sizeof *place);
    struct numbered *list = malloc(g->tiles * sizeof *list);
    if (place && list) {
        for (size_t i = 0; i < slots; i++)
            if (g->slot[i] < 0)
                place[-1 - g->slot[i]] = 1;
        size_t count = sort_used_tiles(g, place, list);
        g->tiles = 1;
        place[0] = 0;
        for (size_t k = 0; k < count; k++) {
            bool background = list[k].value == g->tile[0];
            if (!background &&
                (g->tiles == 1 || list[k].value != g->tile[g->tiles - 1]))
                g->tile[g->tiles++] = list[k].value;
            place[list[k].from] = background ? 0 : (int32_t)g->tiles - 1;
        }
        for (size_t i = 0; i < slots; i++)
            if (g->slot[i] < 0)
                g->slot[i] = -1 - place[-1 - g->slot[i]];
    }
    free(list);
    free(place);
}

/* Moves the stored bricks that are still in use to the front. */
static void compact_bricks(struct grid *g)
{
    size_t slots = brick_count(g), kept = 0;
    int32_t *place = calloc(g->stored + 1, sizeof *place);
    if (!place)
        return;
    for (size_t i = 0; i < slots; i++)
        if (g->slot[i] >= 0)
            place[g->slot[i]] = 1;
    for (size_t s = 0; s < g->stored; s++) {
        if (!place[s])
            continue;
        if (kept != s)
            memcpy(g->voxel + kept * GRID_BRICK_VOXELS,
                   g->voxel + s * GRID_BRICK_VOXELS,
                   GRID_BRICK_VOXELS * sizeof *g->voxel);
        place[s] = (int32_t)kept++;
    }
    for (size_t i = 0; i < slots; i++)
        if (g->slot[i] >= 0)
            g->slot[i] = place[g->slot[i]];
    g->stored = kept;
    free(place);
}

static void widen(struct grid *g, float low, float high)
{
    g->lowest = low < g->lowest ? low : g->lowest;
    g->highest = high > g->highest ? high : g->highest;
}

/* Numbers that are finite, side by side: fminf would be a call for each. */
static void widen_by_brick(struct grid *g, const float *brick)
{
    enum { LANES = 8 };
    float low[LANES], high[LANES];
    for (int k = 0; k < LANES; k++)
        low[k] = high[k] = brick[k];
    for (int i = LANES; i < GRID_BRICK_VOXELS; i += LANES)
        for (int k = 0; k < LANES; k++) {
            float x = brick[i + k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    for (int k = 0; k < LANES; k++)
        widen(g, low[k], high[k]);
}

static void find_range(struct grid *g)
{
    g->lowest = g->highest = g->tile[0];
    for (size_t i = 0; i < g->tiles; i++)
        widen(g, g->tile[i], g->tile[i]);
    for (size_t i = 0; i < g->stored; i++)
        widen_by_brick(g, g->voxel + i * GRID_BRICK_VOXELS);
}

/* The capacity that grow() counts on for so many items. */
static size_t power_capacity(size_t count)
{
    size_t capacity = 1;
    while (capacity < count)
        capacity *= 2;
    return capacity;
}

/* Gives back what was removed. */
static void trim(struct grid *g)
{
    if (g->stored == 0) {
        free(g->voxel);
        g->voxel = NULL;
        return;
    }
    size_t capacity = power_capacity(g->stored);
    float *voxel = realloc(g->voxel,
                           capacity * GRID_BRICK_VOXELS * sizeof *voxel);
    if (voxel)
        g->voxel = voxel;
}

void grid_finish(struct grid *g)
{
    clean_samples(g);
    bricks_to_tiles(g);
    merge_tiles(g);
    compact_bricks(g);
    find_range(g);
    trim(g);
}

static void *copy_array(const void *from, size_t used, size_t count,
                        size_t size, struct brume_error *err)
{
    void *out = memory_new(count, size, err);
    if (out && used > 0)
        memcpy(out, from, used * size);
    return out;
}

struct grid *grid_copy(const struct grid *g, struct brume_error *err)
{
    struct grid *out = memory_new(1, sizeof *out, err);
    if (!out)
        return NULL;
    size_t slots = brick_count(g);
    *out = *g;
    out->shares = 0;
    out->slot = copy_array(g->slot, slots, slots, sizeof *g->slot, err);
    out->tile = copy_array(g->tile, g->tiles, power_capacity(g->tiles),
                           sizeof *g->tile, err);
    out->voxel = copy_array(g->voxel, g->stored * GRID_BRICK_VOXELS,
                            power_capacity(g->stored) * GRID_BRICK_VOXELS,
                            sizeof *g->voxel, err);
    if (!out->slot || !out->tile || !out->voxel) {
        grid_free(out);
        return NULL;
    }
    return out;
}
