/* assembly.h - the shapes of a scene, or one of them, with composites laid
 * out as trees: what is common to rendering and queries.
 *
 * Lengths are the scene's. A whole is what is placed: one leaf, or a tree of
 * nodes in the order in which parents come before their children, save those
 * that group many children by place. */
#ifndef CORE_ASSEMBLY_H
#define CORE_ASSEMBLY_H
#include "core/leaf.h"

struct part {
    struct leaf leaf;
    int material, flags;    /* flags of the whole, and the leaf's          */
    int whole, node;        /* node: -1 if the leaf is the whole           */
    struct box seen;        /* where its surface can be part of the whole's */
};

struct node {
    int op;                 /* CSG_* of physics/scene.h                    */
    int parent, first, last, next, part;    /* or -1                       */
    bool beyond;            /* outside of the bounds is inside             */
    struct box bounds;
};

struct whole {
    int node, interior, flags;
};

struct assembly {
    struct arena arena;
    struct part *parts;
    struct node *nodes;
    struct whole *wholes;
    size_t parts_count, parts_capacity;
    size_t nodes_count, nodes_capacity;
    size_t wholes_count, wholes_capacity;
};

/* Of all shapes that are not parts, or where `shape` >= 0 of that one. */
bool assembly_make(const brume_scene *scene, int shape, struct assembly *out,
                   struct brume_error *err);
void assembly_release(struct assembly *a);

/* Bounds of the nodes, what of the parts can be seen, and groups. */
bool assembly_bound(struct assembly *a, struct brume_error *err);
#endif
