#include "core/mesh_tree.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "lib/memory.h"

/* ---- in the mesh's own space -------------------------------------------- */

struct frame_box {
    double lo[3], size[3];
};

/* Positions are brought to [0, 1], where floats have room for them. */
static struct frame_box box_of(const struct mesh *m)
{
    struct frame_box box;
    for (int k = 0; k < 3; k++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < m->vertices; i++) {
            lo = fmin(lo, m->position[i][k]);
            hi = fmax(hi, m->position[i][k]);
        }
        box.lo[k] = lo;
        box.size[k] = hi > lo && isfinite(hi - lo) ? hi - lo : 1.0;
    }
    double most = fmax(box.size[0], fmax(box.size[1], box.size[2]));
    for (int k = 0; k < 3; k++)
        box.size[k] = most;
    return box;
}

static void own_item(const struct mesh *m, size_t t,
                     const struct frame_box *box, struct bvh_item *out)
{
    for (int k = 0; k < 3; k++) {
        out->lo[k] = INFINITY;
        out->hi[k] = -INFINITY;
        for (int i = 0; i < 3; i++) {
            double p = m->position[m->corner[t][i]][k];
            float x = (float)((p - box->lo[k]) / box->size[k]);
            out->lo[k] = fminf(out->lo[k], x);
            out->hi[k] = fmaxf(out->hi[k], x);
        }
    }
    out->name = (uint32_t)t;
}

static bool build(struct mesh_tree *tree)
{
    const struct mesh *m = tree->mesh;
    struct frame_box box = box_of(m);
    struct bvh_item *items = memory_new(m->triangles, sizeof *items, NULL);
    if (!items)
        return false;
    for (size_t t = 0; t < m->triangles; t++)
        own_item(m, t, &box, &items[t]);
    bool good = bvh_build_within(&tree->own, items, m->triangles,
                                 MESH_TREE_ROOM, NULL);
    free(items);
    tree->room = bvh_room(&tree->own, 0);
    return good;
}

/* ---- the list ----------------------------------------------------------- */

static bool is_same(const struct mesh *a, const struct mesh *b)
{
    return a == b ||
           (a->triangles == b->triangles && a->vertices == b->vertices &&
            memcmp(a->position, b->position,
                   a->vertices * sizeof *a->position) == 0 &&
            memcmp(a->corner, b->corner, a->triangles * sizeof *a->corner) ==
                0);
}

static void free_tree(struct mesh_tree *tree)
{
    mesh_free(tree->mesh);
    free(tree->own.bvh);
    free(tree->own.bvh_items);
    free(tree);
}

struct mesh_tree *mesh_tree_of(struct mesh_tree **list, struct mesh *mesh,
                               int *builds)
{
    struct mesh_tree *tree = *list;
    while (tree && !is_same(tree->mesh, mesh))
        tree = tree->next;
    if (!tree) {
        tree = memory_new(1, sizeof *tree, NULL);
        if (!tree)
            return NULL;
        tree->mesh = mesh_share(mesh);
        if (!build(tree)) {
            free_tree(tree);
            return NULL;
        }
        ++*builds;
        tree->next = *list;
        *list = tree;
    }
    tree->used = true;
    return tree;
}

void mesh_trees_drop(struct mesh_tree **list, bool all)
{
    while (*list) {
        struct mesh_tree *tree = *list;
        if (tree->used && !all) {
            tree->used = false;
            list = &tree->next;
            continue;
        }
        *list = tree->next;
        free_tree(tree);
    }
}

/* ---- where the mesh is -------------------------------------------------- */

static void add_box(bvh_box *to, const float lo[3], const float hi[3])
{
    for (int k = 0; k < 3; k++) {
        to->lo[k] = fminf(to->lo[k], lo[k]);
        to->hi[k] = fmaxf(to->hi[k], hi[k]);
    }
}

/* Around the items of a leaf. */
static void fit_items(const struct flat *f, const uint32_t *name,
                      uint32_t count, bvh_box *box)
{
    for (uint32_t i = 0; i < count; i++) {
        struct bvh_item item;
        bvh_triangle(f, name[i] - f->shapes_count, &item);
        bvh_widen(&item);
        add_box(box, item.lo, item.hi);
    }
}

/* Around the children of a node; those that are not there are infinite. */
static void fit_children(const bvh_node *node, bvh_box *box)
{
    for (int i = 0; i < BVH_WIDTH; i++) {
        const float lo[3] = {node->lo[0][i], node->lo[1][i], node->lo[2][i]};
        const float hi[3] = {node->hi[0][i], node->hi[1][i], node->hi[2][i]};
        if (lo[0] < INFINITY)
            add_box(box, lo, hi);
    }
}

/* Children come behind their parent: from the last node to the root. */
static void fit(const struct flat *f, bvh_node *node)
{
    for (int i = 0; i < BVH_WIDTH && node->lo[0][i] < INFINITY; i++) {
        uint32_t first = node->first[i], count = node->count[i];
        bvh_box box = {{INFINITY, INFINITY, INFINITY},
                       {-INFINITY, -INFINITY, -INFINITY}};
        if (count > 0)
            fit_items(f, f->bvh_items + first, count, &box);
        else
            fit_children(&f->bvh[first], &box);
        wide_put(node, i, &box, first, count);
    }
}

bool mesh_tree_add(const struct mesh_tree *tree, struct flat *flat,
                   uint64_t first, struct brume_error *err)
{
    const struct flat *own = &tree->own;
    uint32_t root = (uint32_t)flat->bvh_count;
    uint32_t item = (uint32_t)flat->bvh_items_count;
    uint32_t name = (uint32_t)(flat->shapes_count + first);
    bvh_node *node = FLAT_EXTEND(flat, bvh, own->bvh_count, err);
    uint32_t *names = FLAT_EXTEND(flat, bvh_items, own->bvh_items_count, err);
    if (!node || !names)
        return false;
    for (size_t i = 0; i < own->bvh_items_count; i++)
        names[i] = name + own->bvh_items[i];
    for (size_t i = own->bvh_count; i-- > 0;) {
        node[i] = own->bvh[i];
        for (int k = 0; k < BVH_WIDTH; k++)
            node[i].first[k] += node[i].count[k] > 0 ? item : root;
        fit(flat, &node[i]);
    }
    return true;
}
