#include <stdlib.h>
#include "core/bvh.h"
#include "core/physics/lbvh.h"
#include "lib/memory.h"

/* What parts cost as children, and how; and levels below them. */
static void find_splits(struct bvh_binary *b, wide_cost *cost)
{
    for (size_t i = b->count; i-- > 0;) {
        wide_part *p = &b->part[i];
        float area = lbvh_area(&b->box[i]);
        if (p->leaf) {
            cost[i] = wide_leaf(area * (float)p->items);
            continue;
        }
        uint8_t left = b->part[p->child[0]].depth;
        uint8_t right = b->part[p->child[1]].depth;
        p->depth = (uint8_t)(1 + (left > right ? left : right));
        cost[i] = wide_inner(area, &cost[p->child[0]], &cost[p->child[1]],
                             &p->split);
    }
}

/* A node that is still to be made. */
struct task {
    uint32_t part, node;
    int room;
};

static bool make_node(struct flat *f, const struct bvh_binary *b, struct task t,
                      struct task *stack, int *tasks, struct brume_error *err)
{
    uint32_t child[BVH_WIDTH];
    int n = wide_open(b->part, t.part, t.room, child);
    wide_clear(&f->bvh[t.node]);
    for (int i = 0; i < n; i++) {
        const wide_part *p = &b->part[child[i]];
        uint32_t first = p->child[0] + (uint32_t)f->bvh_items_count;
        if (!p->leaf) {
            first = (uint32_t)f->bvh_count;
            if (!FLAT_EXTEND(f, bvh, 1, err))
                return false;
            stack[(*tasks)++] = (struct task){child[i], first,
                                              t.room - (n - 1)};
        }
        wide_put(&f->bvh[t.node], i, &b->box[child[i]], first,
                 p->leaf ? p->items : 0);
    }
    return true;
}

bool bvh_collapse(struct flat *flat, struct bvh_binary *binary, int room,
                  struct brume_error *err)
{
    wide_cost *cost = memory_new(binary->count, sizeof *cost, err);
    int tasks = 1;
    if (!cost)
        return false;
    find_splits(binary, cost);
    free(cost);
    if (room < binary->part[0].depth)
        room = binary->part[0].depth;
    struct task stack[2 * BVH_STACK] = {{0, (uint32_t)flat->bvh_count, room}};
    bool good = FLAT_EXTEND(flat, bvh, 1, err) != NULL;
    while (good && tasks > 0) {
        struct task next = stack[--tasks];
        good = make_node(flat, binary, next, stack, &tasks, err);
    }
    return good && (flat->bvh_count <= UINT32_MAX / BVH_WIDTH ||
                    brume_fail(err, BRUME_ERR_LIMIT, "more than 2^30 nodes"));
}

int bvh_room(const struct flat *flat, uint32_t root)
{
    struct {
        uint32_t node;
        int held;
    } stack[2 * BVH_STACK] = {{root, 0}}, top;
    int most = 0, tasks = 1;
    while (tasks > 0) {
        top = stack[--tasks];
        const bvh_node *n = &flat->bvh[top.node];
        int children = 0;
        for (int i = 0; i < BVH_WIDTH; i++)
            children += n->lo[0][i] < INFINITY;
        top.held += children - 1;
        most = top.held > most ? top.held : most;
        for (int i = 0; i < children; i++)
            if (n->count[i] == 0) {
                stack[tasks].node = n->first[i];
                stack[tasks++].held = top.held;
            }
    }
    return most;
}
