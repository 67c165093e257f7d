#include "core/still.h"
#include "core/backend.h"
#include "core/kdtree.h"
#include "lib/memory.h"
#include <stdlib.h>
#include <string.h>

BRUME_API struct brume_still *brume_still_new(struct brume_error *err)
{
    return memory_new(1, sizeof(struct brume_still), err);
}

static void forget_tree(struct brume_still *s)
{
    free(s->node);
    free(s->reference);
    s->node = NULL;
    s->reference = NULL;
    s->nodes = s->references = s->items = 0;
}

static void forget_bvh(struct brume_still *s)
{
    free(s->all);
    free(s->bvh);
    free(s->bvh_item);
    s->all = NULL;
    s->bvh = NULL;
    s->bvh_item = NULL;
    s->alls = s->bvhs = s->bvh_items = 0;
}

BRUME_API void brume_still_free(struct brume_still *still)
{
    if (!still)
        return;
    forget_tree(still);
    forget_bvh(still);
    mesh_trees_drop(&still->tree, true);
    if (still->device)
        still->release(still->device);
    free(still->before);
    free(still->item);
    free(still->pixels);
    free(still);
}

void **still_device(struct brume_still *still, void (*release)(void *))
{
    still->release = release;
    return &still->device;
}

/* ---- what stands still -------------------------------------------------- */

enum { BOUNDS = offsetof(struct bvh_item, name) };

/* FNV-1a, 64 bits, of the bounds: the tree depends on nothing else. */
static uint64_t item_hash(const struct bvh_item *item)
{
    uint64_t hash = 0xcbf29ce484222325u;
    uint32_t word[BOUNDS / 4];
    memcpy(word, item, BOUNDS);
    for (int i = 0; i < BOUNDS / 4; i++)
        hash = (hash ^ word[i]) * 0x100000001b3u;
    return hash;
}

static int compare(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static bool was_there(const struct brume_still *s, uint64_t hash)
{
    return s->befores > 0 &&
           bsearch(&hash, s->before, s->befores, sizeof hash, compare) != NULL;
}

/* What moves goes to the front, the rest keeps its order behind it. */
static bool divide(struct brume_still *s, struct bvh_item *items, size_t count,
                   size_t *moving, struct brume_error *err)
{
    uint64_t *hash = memory_new(count, sizeof *hash, err);
    struct bvh_item *still = memory_new(count, sizeof *still, err);
    bool good = hash && still;
    size_t kept = 0, moved = 0;
    for (size_t i = 0; good && i < count; i++) {
        struct bvh_item item = items[i];
        hash[i] = item_hash(&item);
        if (was_there(s, hash[i]))
            still[kept++] = item;
        else
            items[moved++] = item;
    }
    if (good) {
        memcpy(items + moved, still, kept * sizeof *still);
        qsort(hash, count, sizeof *hash, compare);
        free(s->before);
        s->before = hash;
        s->befores = count;
        *moving = moved;
    } else {
        free(hash);
    }
    free(still);
    return good;
}

/* ---- its tree ----------------------------------------------------------- */

static bool is_same(const struct brume_still *s, const struct bvh_item *items,
                    size_t count)
{
    if (!s->node || count != s->items)
        return false;
    for (size_t i = 0; i < count; i++)
        if (memcmp(&s->item[i], &items[i], BOUNDS) != 0)
            return false;
    return true;
}

/* Keeps the tree that `flat` has just got, its items by number. */
static bool keep_tree(struct brume_still *s, const struct flat *flat,
                      struct brume_error *err)
{
    s->node = memory_new(flat->kd_count, sizeof *s->node, err);
    s->reference = memory_new(flat->kd_items_count, sizeof *s->reference, err);
    if (!s->node || !s->reference) {
        forget_tree(s);
        return false;
    }
    s->nodes = flat->kd_count;
    s->references = flat->kd_items_count;
    s->box = flat->view.kd_box;
    memcpy(s->node, flat->kd, s->nodes * sizeof *s->node);
    memcpy(s->reference, flat->kd_items, s->references * sizeof *s->reference);
    return true;
}

static bool make_tree(struct brume_still *s, struct flat *flat,
                      const struct bvh_item *items, size_t count, int stack,
                      struct brume_error *err)
{
    forget_tree(s);
    struct bvh_item *own = memory_grow(s->item, &s->item_room, count,
                                       sizeof *own, err);
    if (!own)
        return false;
    s->item = own;
    for (size_t i = 0; i < count; i++) {
        own[i] = items[i];
        own[i].name = (uint32_t)i;
    }
    s->builds++;
    if (!kd_build(flat, own, count, stack, err) || !keep_tree(s, flat, err))
        return false;
    s->items = count;
    return true;
}

static bool take_tree(const struct brume_still *s, struct flat *flat, int stack,
                      struct brume_error *err)
{
    kd_node *node = FLAT_EXTEND(flat, kd, s->nodes, err);
    uint32_t *reference = FLAT_EXTEND(flat, kd_items, s->references, err);
    if (!node || !reference)
        return false;
    memcpy(node, s->node, s->nodes * sizeof *node);
    memcpy(reference, s->reference, s->references * sizeof *reference);
    flat->view.kd_box = s->box;
    flat->view.kd_stack = stack;
    return true;
}

bool still_build(struct brume_still *still, struct flat *flat,
                 struct bvh_item *items, size_t count, int stack,
                 struct brume_error *err)
{
    size_t moving = count;
    if (still && !divide(still, items, count, &moving, err))
        return false;
    const struct bvh_item *rest = items + moving;
    size_t rests = count - moving;
    bool good = true;
    if (rests > 0 && is_same(still, rest, rests))
        good = take_tree(still, flat, stack, err);
    else if (rests > 0)
        good = make_tree(still, flat, rest, rests, stack, err);
    for (size_t i = 0; good && i < flat->kd_items_count; i++)
        flat->kd_items[i] = rest[flat->kd_items[i]].name;
    return good && bvh_build(flat, items, moving, err);
}

/* ---- a tree of all ------------------------------------------------------ */

static bool take_bvh(const struct brume_still *s, struct flat *flat,
                     struct brume_error *err)
{
    bvh_node *node = FLAT_EXTEND(flat, bvh, s->bvhs, err);
    uint32_t *item = FLAT_EXTEND(flat, bvh_items, s->bvh_items, err);
    if (!node || !item)
        return false;
    memcpy(node, s->bvh, s->bvhs * sizeof *node);
    memcpy(item, s->bvh_item, s->bvh_items * sizeof *item);
    return true;
}

/* Without memory for it nothing is kept. */
static void keep_bvh(struct brume_still *s, const struct flat *flat)
{
    s->bvh = memory_new(flat->bvh_count, sizeof *s->bvh, NULL);
    s->bvh_item = memory_new(flat->bvh_items_count, sizeof *s->bvh_item, NULL);
    if (!s->bvh || !s->bvh_item) {
        forget_bvh(s);
        return;
    }
    s->bvhs = flat->bvh_count;
    s->bvh_items = flat->bvh_items_count;
    memcpy(s->bvh, flat->bvh, s->bvhs * sizeof *s->bvh);
    memcpy(s->bvh_item, flat->bvh_items, s->bvh_items * sizeof *s->bvh_item);
}

bool still_bvh(struct brume_still *still, struct flat *flat,
               struct bvh_item *items, size_t count, uint64_t from, int room,
               struct brume_error *err)
{
    bool first = flat->bvh_count == 0 && flat->bvh_items_count == 0;
    if (!still || !first || count == 0)
        return bvh_build_over(flat, items, count, from, room, err);
    size_t size = count * sizeof *items;
    if (still->bvh && still->alls == count && still->room == room &&
        memcmp(still->all, items, size) == 0)
        return take_bvh(still, flat, err);
    forget_bvh(still);
    still->all = memory_new(count, sizeof *items, NULL);
    if (still->all) {
        memcpy(still->all, items, size);
        still->alls = count;
    }
    still->bvh_builds++;
    still->room = room;
    if (!bvh_build_over(flat, items, count, from, room, err))
        return false;
    if (still->all)
        keep_bvh(still, flat);
    return true;
}
