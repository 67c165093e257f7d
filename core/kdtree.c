#include "core/kdtree.h"
#include "core/physics/kdtree.h"
#include "lib/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 48, MAX_DEPTH = 60 };

/* Of the cost of a node, in tests of an item; what an empty child saves. */
#define VISIT 3.0f
#define EMPTY 0.8f

/* References to items, each with the part of its bounds in its node. Those of
 * the nodes still to be made lie one behind the other, the next at the end. */
struct references {
    struct bvh_item *item;
    size_t count, room;
};

struct task {
    float lo[3], hi[3];
    size_t count; /* the last so many references             */
    uint32_t node;
    int depth, worse; /* splits above that cost more than a leaf */
};

struct build {
    struct flat *flat;
    struct brume_error *err;
    struct references refs, below; /* below: of the split at hand */
    struct task task[MAX_DEPTH + 2];
    int tasks, deepest;
};

struct split {
    int axis;
    float at, cost;
};

/* ---- where to split ----------------------------------------------------- */

static float half_area(const float lo[3], const float hi[3])
{
    float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
}

/* The plane below bin i; the same number wherever it is asked for. */
static float plane_of(const struct task *t, int axis, int i)
{
    float extent = t->hi[axis] - t->lo[axis];
    return t->lo[axis] + extent * ((float)i / (float)BINS);
}

static int bin_of(const struct task *t, int axis, float x)
{
    float extent = t->hi[axis] - t->lo[axis];
    int b = (int)((float)BINS * ((x - t->lo[axis]) / extent));
    return b < 0 ? 0 : b >= BINS ? BINS - 1 : b;
}

/* Items that begin in each bin, and that end in it. */
static void fill_bins(const struct task *t, const struct bvh_item *item,
                      int axis, size_t begin[BINS], size_t end[BINS])
{
    memset(begin, 0, BINS * sizeof *begin);
    memset(end, 0, BINS * sizeof *end);
    for (size_t i = 0; i < t->count; i++) {
        begin[bin_of(t, axis, item[i].lo[axis])]++;
        end[bin_of(t, axis, item[i].hi[axis])]++;
    }
}

static void try_axis(const struct task *t, const struct bvh_item *item,
                     int axis, struct split *best)
{
    size_t begin[BINS], end[BINS], left = 0, right = t->count;
    float lo[3], hi[3];
    fill_bins(t, item, axis, begin, end);
    memcpy(lo, t->lo, sizeof lo);
    memcpy(hi, t->hi, sizeof hi);
    for (int i = 1; i < BINS; i++) {
        left += begin[i - 1];
        right -= end[i - 1];
        float at = plane_of(t, axis, i);
        if (!(at > t->lo[axis] && at < t->hi[axis]))
            continue;
        hi[axis] = lo[axis] = at;
        float cost = half_area(t->lo, hi) * (float)left +
                     half_area(lo, t->hi) * (float)right;
        if (left == 0 || right == 0)
            cost *= EMPTY;
        if (cost < best->cost)
            *best = (struct split){axis, at, cost};
    }
}

/* Of an axis -1: make it a leaf. */
static struct split find_split(const struct build *b, struct task *t,
                               const struct bvh_item *item)
{
    struct split best = {-1, 0.0f, INFINITY};
    float area = half_area(t->lo, t->hi);
    float leaf = area * (float)t->count;
    if (t->count <= 1 || t->depth >= b->deepest)
        return best;
    for (int axis = 0; axis < 3; axis++)
        if (t->hi[axis] > t->lo[axis])
            try_axis(t, item, axis, &best);
    best.cost += VISIT * area;
    t->worse += best.cost > leaf;
    if (best.cost > 4.0f * leaf || t->worse > 2 ||
        (best.cost > leaf && t->count < 8))
        best.axis = -1;
    return best;
}

/* ---- references --------------------------------------------------------- */

static bool reserve(struct build *b, struct references *r, size_t count)
{
    void *grown = memory_grow(r->item, &r->room, count, sizeof *r->item,
                              b->err);
    if (grown)
        r->item = grown;
    return grown != NULL;
}

/* A copy with its bounds cut at the plane. */
static struct bvh_item cut(const struct bvh_item *item, const struct split *s,
                           bool below)
{
    struct bvh_item part = *item;
    if (below)
        part.hi[s->axis] = fminf(part.hi[s->axis], s->at);
    else
        part.lo[s->axis] = fmaxf(part.lo[s->axis], s->at);
    return part;
}

/* The task's references give way to those above the plane, then those below.
 * What touches it is in both. */
static bool part_references(struct build *b, const struct task *t,
                            const struct split *s, size_t *below, size_t *above)
{
    struct references *refs = &b->refs;
    size_t first = refs->count - t->count, kept = first;
    b->below.count = 0;
    if (!reserve(b, &b->below, t->count) ||
        !reserve(b, refs, refs->count + t->count))
        return false;
    struct bvh_item *left = b->below.item;
    for (size_t i = first; i < refs->count; i++) {
        struct bvh_item item = refs->item[i];
        if (item.lo[s->axis] <= s->at)
            left[b->below.count++] = cut(&item, s, true);
        if (item.hi[s->axis] >= s->at)
            refs->item[kept++] = cut(&item, s, false);
    }
    *below = b->below.count;
    *above = kept - first;
    memcpy(refs->item + kept, left, *below * sizeof *left);
    refs->count = kept + *below;
    return true;
}

/* ---- nodes -------------------------------------------------------------- */

static bool make_leaf(struct build *b, const struct task *t)
{
    struct flat *f = b->flat;
    size_t first = f->kd_items_count;
    if (first + t->count > UINT32_MAX)
        return brume_fail(b->err, BRUME_ERR_LIMIT,
                          "the kd-tree has more than 2^32 references");
    f->kd[t->node].first = (uint32_t)first;
    f->kd[t->node].kind = KD_LEAF + (uint32_t)t->count;
    uint32_t *name = FLAT_EXTEND(f, kd_items, t->count, b->err);
    if (!name && t->count > 0)
        return false;
    b->refs.count -= t->count;
    for (size_t i = 0; i < t->count; i++)
        name[i] = b->refs.item[b->refs.count + i].name;
    return true;
}

static bool make_node(struct build *b, struct task t)
{
    struct split s = find_split(b, &t, b->refs.item + b->refs.count - t.count);
    if (s.axis < 0)
        return make_leaf(b, &t);
    struct flat *f = b->flat;
    uint32_t child = (uint32_t)f->kd_count;
    struct task below = t, above = t;
    if (!FLAT_EXTEND(f, kd, 2, b->err) ||
        !part_references(b, &t, &s, &below.count, &above.count))
        return false;
    f->kd[t.node].split = s.at;
    f->kd[t.node].first = child;
    f->kd[t.node].kind = (uint32_t)s.axis;
    below.hi[s.axis] = above.lo[s.axis] = s.at;
    below.depth = above.depth = t.depth + 1;
    below.node = child;
    above.node = child + 1;
    b->task[b->tasks++] = above;
    b->task[b->tasks++] = below;
    return true;
}

static bool take_items(struct build *b, const struct bvh_item *items,
                       size_t count, struct task *root)
{
    if (!reserve(b, &b->refs, count))
        return false;
    for (int k = 0; k < 3; k++) {
        root->lo[k] = INFINITY;
        root->hi[k] = -INFINITY;
    }
    for (size_t i = 0; i < count; i++) {
        struct bvh_item *to = &b->refs.item[i];
        *to = items[i];
        bvh_widen(to);
        for (int k = 0; k < 3; k++) {
            root->lo[k] = fminf(root->lo[k], to->lo[k]);
            root->hi[k] = fmaxf(root->hi[k], to->hi[k]);
        }
    }
    b->refs.count = root->count = count;
    return true;
}

bool kd_build(struct flat *flat, const struct bvh_item *items, size_t count,
              int stack, struct brume_error *err)
{
    struct build b = {.flat = flat, .err = err};
    struct task root = {.count = 0};
    if (count == 0)
        return true;
    bool good = take_items(&b, items, count, &root) &&
                FLAT_EXTEND(flat, kd, 1, err);
    b.deepest = (int)(8.0 + 1.3 * log2((double)count));
    b.deepest = b.deepest < MAX_DEPTH ? b.deepest : MAX_DEPTH;
    memcpy(flat->view.kd_box.lo, root.lo, sizeof root.lo);
    memcpy(flat->view.kd_box.hi, root.hi, sizeof root.hi);
    flat->view.kd_stack = stack;
    b.task[b.tasks++] = root;
    while (good && b.tasks > 0) {
        b.tasks--;
        good = make_node(&b, b.task[b.tasks]);
    }
    free(b.refs.item);
    free(b.below.item);
    return good;
}
