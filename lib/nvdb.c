#include "lib/nvdb.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"
#include "lib/nvdb_file.h"
#include "lib/vdb_file.h"

/* ---- the layout of nodes: bytes from the begin of each ---- */

enum level { LEAF, LOWER, UPPER, LEVELS };

static const struct {
    int log2;      /* children along a side                               */
    int side_log2; /* samples along a side                                */
    unsigned mask; /* of values, from the begin of the node; children's
                      comes behind                                         */
} levels[] = {{3, 3, 16}, {4, 7, 32}, {5, 12, 32}};

enum { NODE_ALIGN = 32, ROOT_VALUES = 28, LEAF_RANGE = 80, LEAF_CODES = 96 };

/* Where the parts of a tree's nodes lie; they hang on the size of a value. */
struct layout {
    enum nvdb_type type;
    uint64_t value;      /* bytes                                         */
    uint64_t background; /* in the root                                   */
    uint64_t tiles;      /* of the root                                   */
    uint64_t tile, tile_value; /* bytes of a root's tile; in it            */
    uint64_t table[LEVELS];    /* of values and children, or of a leaf's
                                  values                                   */
    uint64_t entry;            /* bytes of one in the tables of inner nodes */
};

static uint64_t align(uint64_t at, uint64_t to)
{
    return (at + to - 1) / to * to;
}

/* Behind minimum and maximum, then mean and deviation, which stand in floats
 * but where a value has eight bytes; bool keeps its own. */
static uint64_t skip_range(uint64_t at, const struct layout *l)
{
    uint64_t mean = l->value == 8 ? 8 : l->type == NVDB_BOOL ? 1 : 4;
    at = align(at, l->value) + 2 * l->value;
    return align(align(at, mean) + 2 * mean, NODE_ALIGN);
}

static struct layout layout_of(enum nvdb_type type)
{
    struct layout l = {.type = type, .value = 4};
    if (type == NVDB_DOUBLE || type == NVDB_INT64)
        l.value = 8;
    if (type == NVDB_BOOL)
        l.value = 1;
    l.background = align(ROOT_VALUES, l.value);
    l.tiles = skip_range(l.background + l.value, &l);
    l.tile_value = align(20, l.value);
    l.tile = align(l.tile_value + l.value, NODE_ALIGN);
    l.entry = 8;
    l.table[UPPER] = skip_range(32 + 2 * 4096, &l);
    l.table[LOWER] = skip_range(32 + 2 * 512, &l);
    l.table[LEAF] = type == NVDB_BOOL  ? LEAF_RANGE
                    : type >= NVDB_FP4 ? LEAF_CODES
                                       : skip_range(LEAF_RANGE, &l);
    return l;
}

/* ---- reading what is not trusted ---- */

struct walk {
    const char *path;
    const struct nvdb_record *record;
    struct layout layout;
    const unsigned char *bytes;
    uint64_t size, tree;
    uint64_t unread;         /* bytes of nodes that may still be read         */
    uint64_t unset;          /* bricks that tiles may still fill              */
    int32_t low[3], high[3]; /* of what is active                          */
    struct grid *grid;       /* NULL while the box is measured                */
    struct brume_error *err;
};

static bool broken(struct walk *w, const char *what)
{
    return brume_fail_file(w->err, w->path, "grid '%s' %s: the file is damaged",
                           w->record->entry.name, what);
}

/* A part of the grid, or NULL with err set where it is not all there. No byte
 * is read twice, so nodes that lie on each other don't make a small file a
 * large grid. */
static const unsigned char *part(struct walk *w, uint64_t at, uint64_t size)
{
    if (at > w->size || size > w->size - at) {
        broken(w, "points outside of itself");
        return NULL;
    }
    if (size > w->unread) {
        broken(w, "has nodes that lie on each other");
        return NULL;
    }
    w->unread -= size;
    return w->bytes + at;
}

static int64_t get_i64(const unsigned char *from)
{
    int64_t value;
    memcpy(&value, from, sizeof value);
    return value;
}

static uint32_t get_u32(const unsigned char *from)
{
    uint32_t value;
    memcpy(&value, from, sizeof value);
    return value;
}

static uint64_t child_at(uint64_t from, int64_t offset)
{
    return from + (uint64_t)offset;
}

static float get_float(const unsigned char *from)
{
    float value;
    memcpy(&value, from, sizeof value);
    return value;
}

static double get_double(const unsigned char *from)
{
    double value;
    memcpy(&value, from, sizeof value);
    return value;
}

static float get_value(const unsigned char *from, enum nvdb_type type)
{
    switch (type) {
    case NVDB_DOUBLE:
        return (float)get_double(from);
    case NVDB_INT32:
        return (float)(int32_t)get_u32(from);
    case NVDB_INT64:
        return (float)get_i64(from);
    case NVDB_BOOL:
        return *from != 0;
    default:
        return get_float(from);
    }
}

static bool bit(const unsigned char *mask, unsigned i)
{
    return mask[i / 8] >> i % 8 & 1;
}

/* ---- leaves ---- */

/* Codes of 1 to 16 bits, the lowest first; a value is minimum + code times
 * quantum. */
static void get_codes(const unsigned char *leaf, unsigned bits, float *out)
{
    const unsigned char *codes = leaf + LEAF_CODES;
    float minimum = get_float(leaf + LEAF_RANGE);
    float quantum = get_float(leaf + LEAF_RANGE + 4);
    for (unsigned i = 0; i < GRID_BRICK_VOXELS; i++) {
        unsigned at = i * bits, code = codes[at / 8];
        if (bits == 16)
            code |= (unsigned)codes[at / 8 + 1] << 8;
        else
            code = code >> at % 8 & ((1u << bits) - 1);
        out[i] = (float)code * quantum + minimum;
    }
}

/* Bits of a code; 0 for values in full. The widths of FpN are powers of two,
 * whose exponents stand in the flags. */
static unsigned code_bits(enum nvdb_type type, const unsigned char *leaf)
{
    switch (type) {
    case NVDB_FP4:
        return 4;
    case NVDB_FP8:
        return 8;
    case NVDB_FP16:
        return 16;
    case NVDB_FPN:
        return 1u << (leaf[15] >> 5);
    default:
        return 0;
    }
}

/* The 512 values of a leaf, z fastest; NULL with err set. */
static bool get_leaf(struct walk *w, uint64_t at, float *out)
{
    const struct layout *l = &w->layout;
    uint64_t table = l->table[LEAF];
    const unsigned char *leaf = part(w, at, table);
    if (!leaf)
        return false;
    unsigned bits = code_bits(l->type, leaf);
    if (bits > 16)
        return broken(w, "has codes of over 16 bits");
    uint64_t size = bits                   ? bits * GRID_BRICK_VOXELS / 8
                    : l->type == NVDB_BOOL ? GRID_BRICK_VOXELS / 8
                                           : l->value * GRID_BRICK_VOXELS;
    const unsigned char *values = part(w, at + table, size);
    if (!values)
        return false;
    if (bits)
        get_codes(leaf, bits, out);
    for (unsigned i = 0; i < GRID_BRICK_VOXELS && !bits; i++)
        out[i] = l->type == NVDB_BOOL
                     ? bit(values, i)
                     : get_value(values + i * l->value, l->type);
    return true;
}

/* ---- what is done with a box of one value, and with a leaf ---- */

static void widen(struct walk *w, const int32_t at[3], int32_t side)
{
    for (int i = 0; i < 3; i++) {
        w->low[i] = at[i] < w->low[i] ? at[i] : w->low[i];
        int32_t last = at[i] + (side - 1);
        w->high[i] = last > w->high[i] ? last : w->high[i];
    }
}

/* Bricks from and to which a cube reaches; false where it reaches none. */
static bool meet(const struct grid *g, const int32_t at[3], int32_t side,
                 int low[3], int high[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t from = ((int64_t)at[i] - g->origin[i]) / GRID_BRICK;
        int64_t to = from + side / GRID_BRICK - 1;
        if (to < 0 || from >= g->bricks[i])
            return false;
        low[i] = from < 0 ? 0 : (int)from;
        high[i] = to < g->bricks[i] ? (int)to : g->bricks[i] - 1;
    }
    return true;
}

static bool do_tile(struct walk *w, const int32_t at[3], int32_t side,
                    float value, bool active)
{
    struct grid *g = w->grid;
    int low[3], high[3];
    if (!g && active)
        widen(w, at, side);
    if (!g || value == g->tile[0] || !meet(g, at, side, low, high))
        return true;
    uint64_t bricks = (uint64_t)(high[0] - low[0] + 1) *
                      (uint64_t)(high[1] - low[1] + 1) *
                      (uint64_t)(high[2] - low[2] + 1);
    if (bricks > w->unset)
        return broken(w, "has tiles that lie on each other");
    w->unset -= bricks;
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            for (int x = low[0]; x <= high[0]; x++)
                if (!grid_set_tile(g, x, y, z, value, w->err))
                    return false;
    return true;
}

/* A leaf's active values count one by one, as they do in OpenVDB's box. */
static void widen_by_leaf(struct walk *w, const unsigned char *mask,
                          const int32_t at[3])
{
    for (unsigned i = 0; i < GRID_BRICK_VOXELS; i++)
        if (bit(mask, i)) {
            int32_t p[3] = {at[0] + (int32_t)(i >> 6),
                            at[1] + (int32_t)(i >> 3 & 7),
                            at[2] + (int32_t)(i & 7)};
            widen(w, p, 1);
        }
}

static bool do_leaf(struct walk *w, uint64_t from, const int32_t at[3])
{
    int low[3], high[3];
    float values[GRID_BRICK_VOXELS];
    if (!w->grid) {
        const unsigned char *leaf = part(w, from, LEAF_RANGE);
        if (leaf)
            widen_by_leaf(w, leaf + levels[LEAF].mask, at);
        return leaf;
    }
    if (!meet(w->grid, at, GRID_BRICK, low, high))
        return true;
    float *brick = grid_brick(w->grid, low[0], low[1], low[2], w->err);
    if (!brick || !get_leaf(w, from, values))
        return false;
    for (int i = 0; i < GRID_BRICK_VOXELS; i++)
        brick[(i >> 6) + GRID_BRICK * ((i >> 3 & 7) + GRID_BRICK * (i & 7))] =
            values[i];
    return true;
}

/* ---- the walk ---- */

/* The corner of child i, whose index has z fastest. */
static void corner_of(enum level level, unsigned i, const int32_t from[3],
                      int32_t at[3])
{
    int log2 = levels[level].log2;
    int side = levels[level].side_log2 - log2;
    unsigned mask = (1u << log2) - 1;
    unsigned n[3] = {i >> 2 * log2, i >> log2 & mask, i & mask};
    for (int k = 0; k < 3; k++)
        at[k] = from[k] + (int32_t)(n[k] << side);
}

typedef bool child_function(struct walk *, uint64_t, const int32_t[3]);

static bool do_inner(struct walk *w, enum level level, uint64_t from,
                     const int32_t at[3], child_function *child)
{
    unsigned count = 1u << 3 * levels[level].log2;
    int32_t side = 1 << (levels[level].side_log2 - levels[level].log2);
    uint64_t table = w->layout.table[level];
    const unsigned char *node = part(w, from, table + count * w->layout.entry);
    if (!node)
        return false;
    const unsigned char *active = node + levels[level].mask;
    const unsigned char *children = active + count / 8;
    for (unsigned i = 0; i < count; i++) {
        const unsigned char *entry = node + table + i * w->layout.entry;
        int32_t corner[3];
        corner_of(level, i, at, corner);
        if (!(bit(children, i)
                  ? child(w, child_at(from, get_i64(entry)), corner)
                  : do_tile(w, corner, side, get_value(entry, w->layout.type),
                            bit(active, i))))
            return false;
    }
    return true;
}

static bool do_lower(struct walk *w, uint64_t from, const int32_t at[3])
{
    return do_inner(w, LOWER, from, at, do_leaf);
}

static bool do_upper(struct walk *w, uint64_t from, const int32_t at[3])
{
    return do_inner(w, UPPER, from, at, do_lower);
}

/* A tile's key: 20 bits of x, 21 of y and of z, each the sample's number over
 * 4096, as unsigned 32-bit numbers. */
static void corner_of_key(uint64_t key, int32_t at[3])
{
    enum { BITS = 21 };
    for (int i = 0; i < 3; i++) {
        uint32_t n = (uint32_t)(key >> (2 - i) * BITS & 0xfffff) << 12;
        memcpy(&at[i], &n, sizeof n);
    }
}

static bool do_root(struct walk *w)
{
    const struct layout *l = &w->layout;
    uint64_t from = child_at(w->tree, get_i64(w->bytes + w->tree + 24));
    const unsigned char *root = part(w, from, l->tiles);
    if (!root)
        return false;
    uint32_t tiles = get_u32(root + 24);
    for (uint32_t i = 0; i < tiles; i++) {
        int32_t at[3];
        const unsigned char *tile = part(w, from + l->tiles + i * l->tile,
                                         l->tile);
        if (!tile)
            return false;
        corner_of_key((uint64_t)get_i64(tile), at);
        int64_t child = get_i64(tile + 8);
        if (!(child ? do_upper(w, child_at(from, child), at)
                    : do_tile(w, at, 1 << levels[UPPER].side_log2,
                              get_value(tile + l->tile_value, l->type),
                              get_u32(tile + 16) != 0)))
            return false;
    }
    return true;
}

/* ---- the grid ---- */

static bool measure(struct walk *w)
{
    for (int i = 0; i < 3; i++) {
        w->low[i] = INT32_MAX;
        w->high[i] = INT32_MIN;
    }
    w->unread = w->size;
    return do_root(w);
}

static float background(const struct walk *w)
{
    uint64_t root = child_at(w->tree, get_i64(w->bytes + w->tree + 24));
    return get_value(w->bytes + root + w->layout.background, w->layout.type);
}

static int32_t brick_floor(int32_t x)
{
    return x & ~(GRID_BRICK - 1);
}

/* An empty grid that covers the box, or one brick of background. */
static struct grid *make_grid(const struct walk *w)
{
    int32_t origin[3] = {0, 0, 0}, bricks[3] = {1, 1, 1};
    for (int i = 0; i < 3 && w->low[i] <= w->high[i]; i++) {
        int64_t last = brick_floor(w->high[i]);
        origin[i] = brick_floor(w->low[i]);
        bricks[i] = (int32_t)((last - origin[i]) / GRID_BRICK + 1);
    }
    struct brume_error own = {0};
    struct grid *g = grid_new(origin, bricks, background(w), &own);
    if (!g)
        brume_fail(w->err, own.code, "'%s': grid '%s': %.900s", w->path,
                   w->record->entry.name, own.text);
    return g;
}

/* The map of doubles: rows of a matrix, then a vector. */
static bool place(struct walk *w, struct grid *g)
{
    const unsigned char *matrix = w->bytes + 296 + 88;
    const unsigned char *vector = matrix + 2 * 9 * 8;
    double(*m)[4] = g->to_world;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            m[i][j] = get_double(j < 3 ? matrix + 8 * (3 * i + j)
                                       : vector + 8 * i);
            if (!isfinite(m[i][j]))
                return broken(w, "has a transform that is not finite");
        }
    double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                 m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                 m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    return det != 0 || broken(w, "has a transform that flattens it");
}

static struct grid *convert(struct walk *w)
{
    if (!measure(w))
        return NULL;
    struct grid *g = make_grid(w);
    if (!g)
        return NULL;
    snprintf(g->name, sizeof g->name, "%s", w->record->entry.name);
    w->grid = g;
    w->unread = w->size;
    w->unset = (uint64_t)g->bricks[0] * (uint64_t)g->bricks[1] *
               (uint64_t)g->bricks[2];
    if (!place(w, g) || !do_root(w)) {
        grid_free(g);
        return NULL;
    }
    grid_finish(g);
    return g;
}

/* ---- the file ---- */

static struct vdb_list *list_of(const struct nvdb_file *f,
                                struct brume_error *err)
{
    struct vdb_list *list = memory_new(1, sizeof *list, err);
    if (!list)
        return NULL;
    list->entry = memory_new(f->count, sizeof *list->entry, err);
    if (!list->entry) {
        free(list);
        return NULL;
    }
    list->count = f->count;
    for (size_t i = 0; i < f->count; i++)
        list->entry[i] = f->record[i].entry;
    return list;
}

struct vdb_list *nvdb_list_new(const char *path, struct brume_error *err)
{
    struct nvdb_file f;
    struct vdb_list *list = nvdb_file_open(&f, path, err) ? list_of(&f, err)
                                                          : NULL;
    nvdb_file_close(&f);
    return list;
}

/* The record of a name or, where there is none, of a role. */
static const struct nvdb_record *find(const struct nvdb_file *f,
                                      const char *name, enum vdb_role role)
{
    struct brume_error *err = f->bytes.err;
    const char *path = f->bytes.path;
    const struct nvdb_record *found = NULL;
    if (name && *name) {
        for (size_t i = f->count; i-- > 0;)
            if (vdb_file_named(&f->record[i].entry, name))
                found = &f->record[i];
        if (!found)
            brume_fail_file(err, path, "has no grid named '%s'", name);
        return found;
    }
    struct vdb_list *list = list_of(f, err);
    const struct vdb_entry *e = list ? vdb_choose(list, role, path, err) : NULL;
    if (e)
        found = &f->record[e - list->entry];
    vdb_list_free(list);
    return found;
}

static struct grid *load(struct nvdb_file *f, const char *name,
                         enum vdb_role role)
{
    struct brume_error *err = f->bytes.err;
    const struct nvdb_record *r = find(f, name, role);
    if (!r || !vdb_check_class(&r->entry, f->bytes.path, err))
        return NULL;
    if (!r->entry.scalar) {
        brume_fail_file(err, f->bytes.path,
                        "grid '%s' is of type %s; a scalar grid is needed: "
                        "float, double, int32, int64, bool, fp4, fp8, fp16 or "
                        "fpN",
                        r->entry.name, r->entry.type);
        return NULL;
    }
    unsigned char *bytes = nvdb_file_grid(f, r);
    if (!bytes)
        return NULL;
    struct walk w = {.path = f->bytes.path,
                     .record = r,
                     .bytes = bytes,
                     .layout = layout_of(r->type),
                     .size = r->size,
                     .tree = NVDB_GRID,
                     .err = err};
    struct grid *g = convert(&w);
    free(bytes);
    return g;
}

struct grid *nvdb_load(const char *path, const char *name, enum vdb_role role,
                       struct brume_error *err)
{
    struct nvdb_file f;
    struct grid *g = nvdb_file_open(&f, path, err) ? load(&f, name, role)
                                                   : NULL;
    nvdb_file_close(&f);
    return g;
}
