#include "core/bvh.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/lbvh.h"
#include "lib/memory.h"

enum { BINS = 16 };

struct bin {
    bvh_box box;
    size_t count;
};

struct task {
    size_t first, count;
    uint32_t node;
    int depth;
};

/* What a tree is to be like. */
struct shape {
    uint64_t from; /* names of items that are trees               */
    int median;    /* from this depth on nodes are halved         */
    int room;      /* places of a search                          */
};

struct split {
    int axis, bin; /* items of bins <= bin go left                */
    float cost;
};

static void box_clear(bvh_box *b)
{
    for (int i = 0; i < 3; i++) {
        b->lo[i] = INFINITY;
        b->hi[i] = -INFINITY;
    }
}

static void box_add(bvh_box *b, const float lo[3], const float hi[3])
{
    for (int i = 0; i < 3; i++) {
        b->lo[i] = fminf(b->lo[i], lo[i]);
        b->hi[i] = fmaxf(b->hi[i], hi[i]);
    }
}

static float box_area(const bvh_box *b)
{
    float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1];
    float z = b->hi[2] - b->lo[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
}

static float centre(const struct bvh_item *item, int axis)
{
    return 0.5f * (item->lo[axis] + item->hi[axis]);
}

static int bin_of(float c, float lo, float extent)
{
    int b = (int)((float)BINS * ((c - lo) / extent));
    return b < 0 ? 0 : b >= BINS ? BINS - 1 : b;
}

static void fill_bins(const struct bvh_item *items, size_t count, int axis,
                      const bvh_box *centres, struct bin bins[BINS])
{
    float lo = centres->lo[axis], extent = centres->hi[axis] - lo;
    for (int i = 0; i < BINS; i++) {
        box_clear(&bins[i].box);
        bins[i].count = 0;
    }
    for (size_t i = 0; i < count; i++) {
        struct bin *b = &bins[bin_of(centre(&items[i], axis), lo, extent)];
        box_add(&b->box, items[i].lo, items[i].hi);
        b->count++;
    }
}

static void try_axis(const struct bin bins[BINS], int axis, struct split *best)
{
    float right_cost[BINS];
    bvh_box box;
    size_t n = 0;
    box_clear(&box);
    for (int i = BINS - 1; i > 0; i--) {
        box_add(&box, bins[i].box.lo, bins[i].box.hi);
        n += bins[i].count;
        right_cost[i] = box_area(&box) * (float)n;
    }
    box_clear(&box);
    n = 0;
    for (int i = 0; i + 1 < BINS; i++) {
        box_add(&box, bins[i].box.lo, bins[i].box.hi);
        n += bins[i].count;
        float cost = box_area(&box) * (float)n + right_cost[i + 1];
        if (n > 0 && right_cost[i + 1] > 0.0f && cost < best->cost) {
            best->cost = cost;
            best->axis = axis;
            best->bin = i;
        }
    }
}

static struct split find_split(const struct bvh_item *items, size_t count,
                               const bvh_box *centres)
{
    struct split best = {-1, 0, INFINITY};
    struct bin bins[BINS];
    for (int axis = 0; axis < 3; axis++) {
        if (!(centres->hi[axis] > centres->lo[axis]))
            continue;
        fill_bins(items, count, axis, centres, bins);
        try_axis(bins, axis, &best);
    }
    return best;
}

static size_t partition(struct bvh_item *items, size_t count,
                        const struct split *s, const bvh_box *centres)
{
    float lo = centres->lo[s->axis], extent = centres->hi[s->axis] - lo;
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        if (bin_of(centre(&items[i], s->axis), lo, extent) > s->bin)
            continue;
        struct bvh_item swap = items[i];
        items[i] = items[left];
        items[left++] = swap;
    }
    return left;
}

static bool has_tree(const struct bvh_item *items, size_t count, uint64_t from)
{
    for (size_t i = 0; i < count; i++)
        if (items[i].name >= from)
            return true;
    return false;
}

/* Where to cut the items of a node; 0: make it a leaf. */
static size_t cut(struct bvh_item *items, size_t count, int depth,
                  const bvh_box *box, const bvh_box *centres,
                  const struct shape *shape)
{
    if (count <= 1)
        return 0;
    bool must = count > BVH_LEAF || has_tree(items, count, shape->from);
    if (depth < shape->median) {
        struct split s = find_split(items, count, centres);
        float leaf_cost = box_area(box) * (float)count;
        bool worth = s.axis >= 0 && s.cost + box_area(box) < leaf_cost;
        if (s.axis >= 0 && (worth || must)) {
            size_t left = partition(items, count, &s, centres);
            if (left > 0 && left < count)
                return left;
        }
    }
    return must ? count / 2 : 0;
}

static void make_part(struct bvh_binary *to, struct bvh_item *items,
                      struct task *stack, int *tasks, struct task t,
                      const struct shape *shape)
{
    bvh_box *box = &to->box[t.node], centres;
    wide_part *part = &to->part[t.node];
    struct bvh_item *own = items + t.first;
    box_clear(box);
    box_clear(&centres);
    for (size_t i = 0; i < t.count; i++) {
        float c[3] = {centre(&own[i], 0), centre(&own[i], 1),
                      centre(&own[i], 2)};
        box_add(box, own[i].lo, own[i].hi);
        box_add(&centres, c, c);
    }
    size_t left = cut(own, t.count, t.depth, box, &centres, shape);
    part->leaf = left == 0;
    part->items = (uint8_t)(left == 0 ? t.count : BVH_LEAF + 1);
    part->child[0] = (uint32_t)t.first;
    if (left == 0)
        return;
    uint32_t child = (uint32_t)to->count;
    to->count += 2;
    part->child[0] = child;
    part->child[1] = child + 1;
    stack[(*tasks)++] = (struct task){t.first + left, t.count - left, child + 1,
                                      t.depth + 1};
    stack[(*tasks)++] = (struct task){t.first, left, child, t.depth + 1};
}

void bvh_widen(struct bvh_item *item)
{
    lbvh_widen(item->lo, item->hi);
}

void bvh_triangle(const struct flat *flat, uint64_t triangle,
                  struct bvh_item *out)
{
    lbvh_triangle_box(flat->triangles[triangle].p, out->lo, out->hi);
}

static void build_binary(struct bvh_binary *to, struct bvh_item *items,
                         size_t count, const struct shape *shape)
{
    struct task stack[2 * BVH_STACK] = {{0, count, 0, 0}};
    int tasks = 1;
    to->count = 1;
    while (tasks > 0)
        tasks--, make_part(to, items, stack, &tasks, stack[tasks], shape);
}

static bool build(struct flat *flat, struct bvh_item *items, size_t count,
                  const struct shape *shape, struct brume_error *err)
{
    if (count == 0)
        return true;
    struct bvh_binary binary = {
        memory_new(2 * count - 1, sizeof *binary.part, err),
        memory_new(2 * count - 1, sizeof *binary.box, err), 0};
    bool good = binary.part && binary.box;
    for (size_t i = 0; i < count; i++)
        bvh_widen(&items[i]);
    if (good) {
        build_binary(&binary, items, count, shape);
        good = bvh_collapse(flat, &binary, shape->room, err);
    }
    free(binary.part);
    free(binary.box);
    uint32_t *names = good ? FLAT_EXTEND(flat, bvh_items, count, err) : NULL;
    for (size_t i = 0; names && i < count; i++)
        names[i] = items[i].name;
    return names != NULL;
}

bool bvh_build(struct flat *flat, struct bvh_item *items, size_t count,
               struct brume_error *err)
{
    return bvh_build_within(flat, items, count, BVH_STACK - 1, err);
}

bool bvh_build_within(struct flat *flat, struct bvh_item *items, size_t count,
                      int room, struct brume_error *err)
{
    const struct shape shape = {UINT64_MAX, BVH_STACK / 2 - 2, room};
    return build(flat, items, count, &shape, err);
}

/* Halving count items takes as many levels as it has bits. */
bool bvh_build_over(struct flat *flat, struct bvh_item *items, size_t count,
                    uint64_t from, int room, struct brume_error *err)
{
    int bits = 0;
    while (count >> bits > 0)
        bits++;
    const struct shape shape = {from, room - bits - 1, room};
    return build(flat, items, count, &shape, err);
}
