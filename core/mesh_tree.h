/* mesh_tree.h - trees over the triangles of large meshes, each built once in a
 * film: in the mesh's own space, so that it serves wherever the mesh goes, its
 * bounds found anew. What a ray hits does not depend on the tree. */
#ifndef CORE_MESH_TREE_H
#define CORE_MESH_TREE_H
#include "core/bvh.h"
#include "core/physics/ray.h"
#include "lib/mesh.h"

struct mesh_tree {
    struct mesh_tree *next;
    struct mesh *mesh;          /* a share of it                           */
    struct flat own;            /* bvh and bvh_items: numbers of triangles */
    int room;                   /* places of a search                      */
    bool used;                  /* by the frame that is prepared           */
};

/* Meshes of fewer triangles are not worth one. */
enum { MESH_TREE_WORTH = 1024 };

/* Places that a search of one keeps, or it is not used: the others are for the
 * tree that it is part of. */
enum { MESH_TREE_ROOM = BVH_STACK / 2 };

/* The tree of a mesh with these triangles, from the list or built and put
 * there. NULL: no memory. */
struct mesh_tree *mesh_tree_of(struct mesh_tree **list, struct mesh *mesh,
                               int *builds);
/* Drops those that were not used since, and marks the others as not used. */
void mesh_trees_drop(struct mesh_tree **list, bool all);

/* Adds the tree to flat->bvh, over the triangles of flat from `first` on; its
 * root is the next node. */
bool mesh_tree_add(const struct mesh_tree *tree, struct flat *flat,
                   uint64_t first, struct brume_error *err);
#endif
