#include "core/bvh.h"
#include <math.h>
#include <string.h>
#include "core/physics/lbvh.h"

enum { BINS = 16, LEAF = 4 };

struct box {
    float lo[3], hi[3];
};

struct bin {
    struct box box;
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
};

struct split {
    int axis, bin; /* items of bins <= bin go left                */
    float cost;
};

static void box_clear(struct box *b)
{
    for (int i = 0; i < 3; i++) {
        b->lo[i] = INFINITY;
        b->hi[i] = -INFINITY;
    }
}

static void box_add(struct box *b, const float lo[3], const float hi[3])
{
    for (int i = 0; i < 3; i++) {
        b->lo[i] = fminf(b->lo[i], lo[i]);
        b->hi[i] = fmaxf(b->hi[i], hi[i]);
    }
}

static float box_area(const struct box *b)
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
                      const struct box *centres, struct bin bins[BINS])
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
    struct box box;
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
                               const struct box *centres)
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
                        const struct split *s, const struct box *centres)
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
                  const struct box *box, const struct box *centres,
                  const struct shape *shape)
{
    if (count <= 1)
        return 0;
    bool must = count > LEAF || has_tree(items, count, shape->from);
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

static bool make_node(struct flat *f, struct bvh_item *items,
                      struct task *stack, int *tasks, struct task t,
                      const struct shape *shape, struct brume_error *err)
{
    struct box box, centres;
    struct bvh_item *part = items + t.first;
    box_clear(&box);
    box_clear(&centres);
    for (size_t i = 0; i < t.count; i++) {
        float c[3] = {centre(&part[i], 0), centre(&part[i], 1),
                      centre(&part[i], 2)};
        box_add(&box, part[i].lo, part[i].hi);
        box_add(&centres, c, c);
    }
    memcpy(f->bvh[t.node].lo, box.lo, sizeof box.lo);
    memcpy(f->bvh[t.node].hi, box.hi, sizeof box.hi);
    size_t left = cut(part, t.count, t.depth, &box, &centres, shape);
    if (left == 0) {
        f->bvh[t.node].first = (uint32_t)(f->bvh_items_count + t.first);
        f->bvh[t.node].count = (uint32_t)t.count;
        return true;
    }
    uint32_t child = (uint32_t)f->bvh_count;
    if (!FLAT_EXTEND(f, bvh, 2, err))
        return false;
    f->bvh[t.node].first = child;
    f->bvh[t.node].count = 0;
    stack[(*tasks)++] = (struct task){t.first + left, t.count - left, child + 1,
                                      t.depth + 1};
    stack[(*tasks)++] = (struct task){t.first, left, child, t.depth + 1};
    return true;
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

static bool build(struct flat *flat, struct bvh_item *items, size_t count,
                  const struct shape *shape, struct brume_error *err)
{
    if (count == 0)
        return true;
    uint32_t root = (uint32_t)flat->bvh_count;
    if (!FLAT_EXTEND(flat, bvh, 1, err))
        return false;
    struct task stack[2 * BVH_STACK] = {{0, count, root, 0}};
    int tasks = 1;
    for (size_t i = 0; i < count; i++)
        bvh_widen(&items[i]);
    while (tasks > 0)
        if (tasks--,
            !make_node(flat, items, stack, &tasks, stack[tasks], shape, err))
            return false;
    uint32_t *names = FLAT_EXTEND(flat, bvh_items, count, err);
    for (size_t i = 0; names && i < count; i++)
        names[i] = items[i].name;
    return names != NULL;
}

bool bvh_build(struct flat *flat, struct bvh_item *items, size_t count,
               struct brume_error *err)
{
    const struct shape shape = {UINT64_MAX, BVH_STACK / 2 - 2};
    return build(flat, items, count, &shape, err);
}

/* Halving count items takes as many levels as it has bits. */
bool bvh_build_over(struct flat *flat, struct bvh_item *items, size_t count,
                    uint64_t from, int depth, struct brume_error *err)
{
    int bits = 0;
    while (count >> bits > 0)
        bits++;
    const struct shape shape = {from, depth - bits - 1};
    return build(flat, items, count, &shape, err);
}

int bvh_depth(const struct flat *flat, uint32_t root)
{
    struct {
        uint32_t node;
        int depth;
    } stack[2 * BVH_STACK] = {{root, 0}}, top;
    int most = 0, held = 1;
    while (held > 0) {
        top = stack[--held];
        most = top.depth > most ? top.depth : most;
        const bvh_node *node = &flat->bvh[top.node];
        for (uint32_t i = 0; node->count == 0 && i < 2; i++) {
            stack[held].node = node->first + i;
            stack[held++].depth = top.depth + 1;
        }
    }
    return most;
}
