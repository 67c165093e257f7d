/* wide.h - a binary tree made one whose nodes have BVH_WIDTH children, alike on
 * the host and on a GPU: of all the ways to leave out nodes between, the one
 * that costs rays least by the surface area heuristic (Ylitie, Karras, Laine
 * 2017), found from below: what a part costs as 1, 2 or 3 children at most. */
#ifndef CORE_PHYSICS_WIDE_H
#define CORE_PHYSICS_WIDE_H
#include "core/physics/scene.h"

/* A part of the binary tree. `split` tells of it as so many children: how many
 * come of its left part; 0: it is one child itself (wide_left). */
typedef struct {
    uint32_t child[2];      /* a leaf has none                             */
    uint8_t items;          /* BVH_LEAF + 1: more                          */
    uint8_t leaf;           /* 1: all of them lie in one leaf              */
    uint8_t split;          /* bits 0, 1: as 4; 2, 3: as 3; 4: as 2        */
    uint8_t depth;          /* levels below it; 255: or more               */
} wide_part;

/* In areas; of 1, 2 and 3 children at most. */
typedef struct {
    float as[BVH_WIDTH - 1];
} wide_cost;

HD wide_cost wide_leaf(float cost)
{
    wide_cost c;
    for (int i = 0; i < BVH_WIDTH - 1; i++)
        c.as[i] = cost;
    return c;
}

/* Takes `cost` if it is less; the left part has i children then. */
HD void wide_try(float cost, int i, float *best, int *left)
{
    if (cost < *best) {
        *best = cost;
        *left = i;
    }
}

/* Of a part with a box of that area over two others. */
HD wide_cost wide_inner(float area, const wide_cost *a, const wide_cost *b,
                        uint8_t *split)
{
    wide_cost c;
    float two = a->as[0] + b->as[0], three = a->as[0] + b->as[1];
    float four = a->as[1] + b->as[1];
    int as_three = 1, as_four = 2, as_two = 1;
    wide_try(a->as[1] + b->as[0], 2, &three, &as_three);
    wide_try(a->as[0] + b->as[2], 1, &four, &as_four);
    wide_try(a->as[2] + b->as[0], 3, &four, &as_four);
    c.as[0] = area + four;
    wide_try(c.as[0], 0, &two, &as_two);
    c.as[1] = two;
    wide_try(c.as[1], 0, &three, &as_three);
    c.as[2] = three;
    *split = (uint8_t)(as_four | as_three << 2 | as_two << 4);
    return c;
}

/* How many of so many children, at most, come of the left part; 0: the part is
 * a child itself. */
HD int wide_left(const wide_part *p, int children)
{
    int three = p->split >> 2 & 3, two = p->split >> 4 & 1;
    if (p->leaf || children < 2)
        return 0;
    return children > 2 && three > 0 ? three : two;
}

/* The children of the node made of a part, of which BVH_WIDTH at most are put
 * into `child`; returns how many. A search has room for `room` places: as many
 * as there are levels below, or more, and so it is for each child, too, with
 * room for its siblings taken from it. */
HD int wide_open(const wide_part *part, uint32_t at, int room,
                 uint32_t child[BVH_WIDTH])
{
    const wide_part *p = &part[at];
    int as[BVH_WIDTH], n = 2;
    child[0] = at;
    if (p->leaf)
        return 1;
    child[0] = p->child[0];
    child[1] = p->child[1];
    as[0] = p->split & 3;
    as[1] = BVH_WIDTH - as[0];
    for (int i = 0; i < n;) {
        const wide_part *c = &part[child[i]];
        int left = wide_left(c, as[i]);
        if (left == 0) {
            i++;
            continue;
        }
        child[n] = c->child[1];
        as[n++] = as[i] - left;
        child[i] = c->child[0];
        as[i] = left;
    }
    for (int i = 0; i < n; i++)
        if (part[child[i]].depth > room - (n - 1)) {
            child[0] = p->child[0];
            child[1] = p->child[1];
            return 2;
        }
    return n;
}

/* A node whose children are yet to be put. */
HD void wide_clear(bvh_node *node)
{
    for (int i = 0; i < BVH_WIDTH; i++) {
        for (int k = 0; k < 3; k++)
            node->lo[k][i] = node->hi[k][i] = INFINITY;
        node->first[i] = node->count[i] = 0;
    }
}

HD void wide_put(bvh_node *node, int i, const bvh_box *box, uint32_t first,
                 uint32_t count)
{
    for (int k = 0; k < 3; k++) {
        node->lo[k][i] = box->lo[k];
        node->hi[k][i] = box->hi[k];
    }
    node->first[i] = first;
    node->count[i] = count;
}

#endif
