/* Bounds of composites, and trees over their many children.
 *
 * Beyond its bounds a node is wholly outside, or (an inverted ball, say)
 * wholly inside: `beyond` says which. A union is inside beyond where one of
 * its children is, an intersection outside where one is; the children that
 * are so decide, and their bounds in common bound it. Else all may matter,
 * and their hull does. */
#include <math.h>
#include <stdlib.h>
#include "core/assembly.h"
#include "core/flat.h"
#include "core/physics/leaf.h"

/* More children than this that only their bounds tell apart get a tree. */
enum { FEW = 4 };

static void bound_node(struct assembly *a, struct node *n)
{
    bool strong = n->op != CSG_INTERSECTION, decided = false;
    n->bounds = box_empty();
    n->beyond = false;
    if (n->first < 0)
        return;
    for (int i = n->first; i >= 0; i = a->nodes[i].next)
        decided = decided || a->nodes[i].beyond == strong;
    n->beyond = decided ? strong : !strong;
    if (decided)
        n->bounds = box_endless();
    for (int i = n->first; i >= 0; i = a->nodes[i].next) {
        const struct node *child = &a->nodes[i];
        if (!decided)
            n->bounds = box_hull(&n->bounds, &child->bounds);
        else if (child->beyond == strong)
            n->bounds = box_common(&n->bounds, &child->bounds);
    }
}

/* Nothing beyond the bounds of an inverted half space across an axis but the
 * other half space is inside. */
static bool turn_half(struct box *b)
{
    struct box other = box_endless();
    int sides = 0;
    for (int i = 0; i < 3; i++) {
        bool low = isfinite(b->lo[i]), high = isfinite(b->hi[i]);
        sides += low + high;
        if (low)
            other.hi[i] = b->lo[i];
        if (high)
            other.lo[i] = b->hi[i];
    }
    if (sides == 1)
        *b = other;
    return sides == 1;
}

static void bound_part(struct node *n, const struct part *p)
{
    n->bounds = p->leaf.bounds;
    n->beyond = false;
    if (p->flags & SHAPE_THIN)
        n->bounds = box_empty();
    if (p->leaf.kind == SHAPE_DISC)
        n->bounds = box_endless();
    if (p->flags & SHAPE_INVERSE)
        n->beyond = p->leaf.kind != SHAPE_PLANE || !turn_half(&n->bounds);
}

/* Where a node's surfaces can be seen in the whole, from its parent's `seen`:
 * where the parent may be decided against them they can't. */
static struct box seen_below(const struct node *parent, struct box seen)
{
    bool cuts = parent->op == CSG_INTERSECTION ? !parent->beyond
                                               : parent->beyond;
    if (parent->op == CSG_UNION || !cuts)
        return seen;
    return box_common(&seen, &parent->bounds);
}

static bool bound_seen(struct assembly *a, struct brume_error *err)
{
    struct box *seen = malloc((a->nodes_count + 1) * sizeof *seen);
    if (!seen)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    for (size_t i = 0; i < a->nodes_count; i++) {
        const struct node *n = &a->nodes[i];
        seen[i] = n->parent < 0
                      ? box_endless()
                      : seen_below(&a->nodes[n->parent], seen[n->parent]);
    }
    for (size_t i = 0; i < a->parts_count; i++) {
        struct part *p = &a->parts[i];
        p->seen = p->leaf.bounds;
        if (p->node >= 0)
            p->seen = box_common(&p->seen, &seen[p->node]);
    }
    free(seen);
    return true;
}

/* ---- groups ------------------------------------------------------------ */

struct child {
    int node;
    double centre[3];
};

struct range {
    int parent;
    size_t first, count;
};

static int by_x(const void *a, const void *b)
{
    double x = ((const struct child *)a)->centre[0];
    double y = ((const struct child *)b)->centre[0];
    return (x > y) - (x < y);
}

static int by_y(const void *a, const void *b)
{
    double x = ((const struct child *)a)->centre[1];
    double y = ((const struct child *)b)->centre[1];
    return (x > y) - (x < y);
}

static int by_z(const void *a, const void *b)
{
    double x = ((const struct child *)a)->centre[2];
    double y = ((const struct child *)b)->centre[2];
    return (x > y) - (x < y);
}

static void sort_children(struct child *c, size_t count)
{
    struct box b = box_empty();
    for (size_t i = 0; i < count; i++)
        box_add(&b, c[i].centre);
    double x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1];
    double z = b.hi[2] - b.lo[2];
    qsort(c, count, sizeof *c, x >= y && x >= z ? by_x : y >= z ? by_y : by_z);
}

static void link_child(struct assembly *a, int parent, int child)
{
    struct node *p = &a->nodes[parent];
    a->nodes[child].parent = parent;
    a->nodes[child].next = -1;
    *(p->last < 0 ? &p->first : &a->nodes[p->last].next) = child;
    p->last = child;
}

/* A node over some of a parent's children, with its operation. */
static int add_group(struct assembly *a, int parent, const struct child *c,
                     size_t count, struct brume_error *err)
{
    struct node *n = flat_extend((void **)&a->nodes, &a->nodes_capacity,
                                 &a->nodes_count, 1, sizeof *a->nodes, err);
    if (!n)
        return -1;
    *n = a->nodes[parent];
    n->first = n->last = n->part = -1;
    n->beyond = a->nodes[c[0].node].beyond;
    n->bounds = box_empty();
    for (size_t i = 0; i < count; i++)
        n->bounds = box_hull(&n->bounds, &a->nodes[c[i].node].bounds);
    int id = (int)a->nodes_count - 1;
    link_child(a, parent, id);
    return id;
}

static bool group_half(struct assembly *a, int parent, struct child *c,
                       struct range r, struct range *stack, int *depth,
                       struct brume_error *err)
{
    if (r.count <= FEW) {
        for (size_t i = 0; i < r.count; i++)
            link_child(a, parent, c[r.first + i].node);
        return true;
    }
    r.parent = add_group(a, parent, c + r.first, r.count, err);
    if (r.parent >= 0)
        stack[(*depth)++] = r;
    return r.parent >= 0;
}

/* Halves by place until few are left. */
static bool group_children(struct assembly *a, int parent, struct child *c,
                           size_t count, struct brume_error *err)
{
    struct range stack[64] = {{parent, 0, count}};
    int depth = 1;
    while (depth > 0) {
        struct range r = stack[--depth];
        size_t half = r.count / 2;
        sort_children(c + r.first, r.count);
        struct range left = {r.parent, r.first, half};
        struct range right = {r.parent, r.first + half, r.count - half};
        if (!group_half(a, r.parent, c, right, stack, &depth, err) ||
            !group_half(a, r.parent, c, left, stack, &depth, err))
            return false;
    }
    return true;
}

/* Takes the children that do not decide beyond their bounds out of the list,
 * and gives them a tree. */
static bool group_node(struct assembly *a, int id, struct child *room,
                       struct brume_error *err)
{
    struct node *n = &a->nodes[id];
    bool weak = n->op == CSG_INTERSECTION;
    size_t count = 0;
    for (int i = n->first; i >= 0; i = a->nodes[i].next)
        if (a->nodes[i].beyond == weak && box_is_bounded(&a->nodes[i].bounds))
            count++;
    if (count <= FEW)
        return true;
    int next, first = n->first;
    n->first = n->last = -1;
    count = 0;
    for (int i = first; i >= 0; i = next) {
        const struct node *child = &a->nodes[i];
        next = child->next;
        if (child->beyond != weak || !box_is_bounded(&child->bounds)) {
            link_child(a, id, i);
            continue;
        }
        struct child *c = &room[count++];
        c->node = i;
        for (int k = 0; k < 3; k++)
            c->centre[k] = 0.5 * (child->bounds.lo[k] + child->bounds.hi[k]);
    }
    return group_children(a, id, room, count, err);
}

bool assembly_bound(struct assembly *a, struct brume_error *err)
{
    size_t told = a->nodes_count;
    for (size_t i = told; i-- > 0;) {
        struct node *n = &a->nodes[i];
        if (n->part >= 0)
            bound_part(n, &a->parts[n->part]);
        else
            bound_node(a, n);
    }
    struct child *room = malloc((told + 1) * sizeof *room);
    bool good = room != NULL && bound_seen(a, err);
    if (!room)
        brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    for (size_t i = 0; good && i < told; i++)
        good = group_node(a, (int)i, room, err);
    free(room);
    return good;
}
