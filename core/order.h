/* order.h - a tree that is left to a backend: what it is to be over, and how
 * the CPU builds it if the backend does not. */
#ifndef CORE_ORDER_H
#define CORE_ORDER_H
#include "core/bvh.h"

/* A BVH or a kd-tree of some shapes and, behind them, of all triangles. */
struct tree_order {
    enum brume_tree tree;
    struct bvh_item *shape;
    size_t shapes;
    int stack;              /* of a kd-tree                                */
};

/* Leaves a tree over copies of these shapes and all triangles to the backend,
 * in flat->order. */
bool order_tree(struct flat *flat, enum brume_tree tree, int stack,
                const struct bvh_item *shapes, size_t count,
                struct brume_error *err);
void order_free(struct tree_order *order);

/* Items of the tree that is ordered; 0: there is none. */
size_t order_count(const struct flat *flat);
/* Bytes of it on a device, or about as many. */
uint64_t order_bytes(const struct flat *flat);

/* Builds it here; it is ordered no more. */
bool order_build(struct flat *flat, struct brume_error *err);
#endif
