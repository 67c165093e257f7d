#include "core/order.h"
#include <stdlib.h>
#include <string.h>
#include "core/kdtree.h"
#include "lib/memory.h"

void order_free(struct tree_order *order)
{
    if (order)
        free(order->shape);
    free(order);
}

bool order_tree(struct flat *flat, enum brume_tree tree, int stack,
                const struct bvh_item *shapes, size_t count,
                struct brume_error *err)
{
    if (count + flat->triangles_count == 0)
        return true;
    struct tree_order *order = memory_new(1, sizeof *order, err);
    struct bvh_item *copy = memory_new(count, sizeof *copy, err);
    if (!order || !copy) {
        free(order);
        free(copy);
        return false;
    }
    if (count > 0)
        memcpy(copy, shapes, count * sizeof *copy);
    *order = (struct tree_order){tree, copy, count, stack};
    order_free(flat->order);
    flat->order = order;
    flat->view.kd_stack = stack;
    return true;
}

size_t order_count(const struct flat *flat)
{
    return flat->order ? flat->order->shapes + flat->triangles_count : 0;
}

uint64_t order_bytes(const struct flat *flat)
{
    uint64_t n = order_count(flat);
    if (n == 0)
        return 0;
    return flat->order->tree == BRUME_TREE_KD
               ? n * (3 * sizeof(kd_node) + 6 * sizeof(uint32_t))
               : (n / 3 + 1) * sizeof(bvh_node) + n * sizeof(uint32_t);
}

static struct bvh_item *list_items(const struct flat *flat,
                                   struct brume_error *err)
{
    const struct tree_order *order = flat->order;
    struct bvh_item *items = memory_new(order_count(flat), sizeof *items, err);
    struct bvh_item *to = items;
    for (size_t i = 0; items && i < order->shapes; i++)
        *to++ = order->shape[i];
    for (size_t i = 0; items && i < flat->triangles_count; i++) {
        bvh_triangle(flat, i, to);
        to++->name = (uint32_t)(flat->shapes_count + i);
    }
    return items;
}

bool order_build(struct flat *flat, struct brume_error *err)
{
    const struct tree_order *order = flat->order;
    size_t count = order_count(flat), root = flat->bvh_count;
    if (count == 0)
        return true;
    struct bvh_item *items = list_items(flat, err);
    if (!items)
        return false;
    bool good = order->tree == BRUME_TREE_KD
                    ? kd_build(flat, items, count, order->stack, err)
                    : bvh_build(flat, items, count, err);
    free(items);
    if (flat->bvh_count > root)
        flat->view.bvh_root = (int32_t)root;
    flat_view(flat);
    order_free(flat->order);
    flat->order = NULL;
    return good;
}
