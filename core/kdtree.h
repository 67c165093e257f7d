/* kdtree.h - builds the kd-tree of physics/kdtree.h on the host: surface area
 * heuristic over bins (Shevtsov, Soupikov, Kapustin 2007), in O(n log n). */
#ifndef CORE_KDTREE_H
#define CORE_KDTREE_H
#include "core/bvh.h"

enum { KD_MAX_DEPTH = 60 };

/* Levels of the tree over so many items, at most. */
int kd_deepest(size_t count);

/* Makes flat->kd, kd_items and kd_box of the items, which an earlier tree must
 * not be in; `stack` is the ring's size, 1 to KD_MAX_STACK. The tree is the
 * same for the same items in the same order. An item is in all leaves that its
 * bounds touch. */
bool kd_build(struct flat *flat, const struct bvh_item *items, size_t count,
              int stack, struct brume_error *err);
#endif
