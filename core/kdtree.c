#include "core/kdtree.h"
#include "core/physics/kd_step.h"
#include "lib/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* References to items, each with the part of its bounds in its node. Those of
 * the nodes still to be made lie one behind the other, the next at the end. */
struct references {
    struct bvh_item *item;
    size_t count, room;
};

struct task {
    kd_task part; /* its items: the last so many references  */
    uint32_t node;
};

struct build {
    struct flat *flat;
    struct brume_error *err;
    struct references refs, below; /* below: of the split at hand */
    struct task task[KD_MAX_DEPTH + 2];
    int tasks, deepest;
};

/* ---- where to split ----------------------------------------------------- */

/* Items that begin in each bin, and that end in it. */
static void fill_bins(const kd_task *t, const struct bvh_item *item, int axis,
                      size_t begin[KD_BINS], size_t end[KD_BINS])
{
    memset(begin, 0, KD_BINS * sizeof *begin);
    memset(end, 0, KD_BINS * sizeof *end);
    for (size_t i = 0; i < t->count; i++) {
        begin[kd_bin(t, axis, item[i].lo[axis])]++;
        end[kd_bin(t, axis, item[i].hi[axis])]++;
    }
}

static void try_axis(const kd_task *t, const struct bvh_item *item, int axis,
                     kd_split *best)
{
    size_t begin[KD_BINS], end[KD_BINS], left = 0, right = t->count;
    fill_bins(t, item, axis, begin, end);
    for (int i = 1; i < KD_BINS; i++) {
        left += begin[i - 1];
        right -= end[i - 1];
        float cost = kd_cost(t, axis, i, left, right);
        if (cost < best->cost)
            *best = (kd_split){axis, kd_plane(t, axis, i), cost};
    }
}

/* Of an axis -1: make it a leaf. */
static kd_split find_split(const struct build *b, kd_task *t,
                           const struct bvh_item *item)
{
    kd_split best = {-1, 0.0f, INFINITY};
    if (!kd_may_split(t, b->deepest))
        return best;
    for (int axis = 0; axis < 3; axis++)
        if (t->hi[axis] > t->lo[axis])
            try_axis(t, item, axis, &best);
    kd_decide(t, &best);
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
static struct bvh_item cut(const struct bvh_item *item, const kd_split *s,
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
static bool part_references(struct build *b, const kd_task *t,
                            const kd_split *s, uint64_t *below, uint64_t *above)
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
    size_t first = f->kd_items_count, count = t->part.count;
    if (first + count > UINT32_MAX)
        return brume_fail(b->err, BRUME_ERR_LIMIT,
                          "the kd-tree has more than 2^32 references");
    f->kd[t->node].first = (uint32_t)first;
    f->kd[t->node].kind = KD_LEAF + (uint32_t)count;
    uint32_t *name = FLAT_EXTEND(f, kd_items, count, b->err);
    if (!name && count > 0)
        return false;
    b->refs.count -= count;
    for (size_t i = 0; i < count; i++)
        name[i] = b->refs.item[b->refs.count + i].name;
    return true;
}

static bool make_node(struct build *b, struct task t)
{
    kd_task *part = &t.part;
    kd_split s = find_split(b, part,
                            b->refs.item + b->refs.count - part->count);
    if (s.axis < 0)
        return make_leaf(b, &t);
    struct flat *f = b->flat;
    uint32_t child = (uint32_t)f->kd_count;
    struct task below = {.node = child}, above = {.node = child + 1};
    kd_cut(part, &s, &below.part, &above.part);
    if (!FLAT_EXTEND(f, kd, 2, b->err) ||
        !part_references(b, part, &s, &below.part.count, &above.part.count))
        return false;
    f->kd[t.node].split = s.at;
    f->kd[t.node].first = child;
    f->kd[t.node].kind = (uint32_t)s.axis;
    b->task[b->tasks++] = above;
    b->task[b->tasks++] = below;
    return true;
}

static bool take_items(struct build *b, const struct bvh_item *items,
                       size_t count, kd_task *root)
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

int kd_deepest(size_t count)
{
    int deepest = (int)(8.0 + 1.3 * log2((double)count));
    return deepest < KD_MAX_DEPTH ? deepest : KD_MAX_DEPTH;
}

bool kd_build(struct flat *flat, const struct bvh_item *items, size_t count,
              int stack, struct brume_error *err)
{
    struct build b = {.flat = flat, .err = err};
    struct task root = {.node = 0};
    if (count == 0)
        return true;
    bool good = take_items(&b, items, count, &root.part) &&
                FLAT_EXTEND(flat, kd, 1, err);
    b.deepest = kd_deepest(count);
    memcpy(flat->view.kd_box.lo, root.part.lo, sizeof root.part.lo);
    memcpy(flat->view.kd_box.hi, root.part.hi, sizeof root.part.hi);
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
