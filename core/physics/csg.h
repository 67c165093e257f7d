/* csg.h - composites: whether a place is inside of one, and what a crossing
 * of one of its leaves is to the whole.
 *
 * A place on a ray lies behind (distance, key), and each leaf is inside or
 * out there by the roots of the line before it: exact, and the same whichever
 * leaf is asked about first, so that crossings of many leaves at one distance
 * come one after the other. What the tree says follows from that without any
 * epsilon. It is walked by its links, without a stack, however deep it is;
 * subtrees beyond whose bounds the place lies are not walked.
 *
 * The surface of a leaf is part of that of the composite where, on the way up,
 * all siblings in intersections and none in merges hold the place; unions do
 * not ask. The inside of the whole changes there where no union's sibling
 * holds it either. */
#ifndef CORE_PHYSICS_CSG_H
#define CORE_PHYSICS_CSG_H
#include "core/physics/leaf.h"

/* Behind (t, key) on a ray, at the point p; or the point alone, without ray. */
typedef struct {
    const bvh_ray *ray;
    real t;
    uint64_t key;
    real3 p;
    real slack;             /* how far p may be off the line, by rounding  */
} csg_place;

HD csg_place csg_on_ray(const bvh_ray *r, real t, uint64_t key)
{
    csg_place at;
    at.ray = r;
    at.t = t;
    at.key = key;
    at.p = real3_mad(r->o, t, r->d);
    at.slack = REAL(1e-6) * (real_abs(r->o.x) + real_abs(r->o.y) +
                             real_abs(r->o.z) + real_abs(t));
    return at;
}

HD csg_place csg_at_point(real3 p)
{
    csg_place at;
    at.ray = 0;
    at.t = 0;
    at.key = UINT64_MAX;
    at.p = p;
    at.slack = 0;
    return at;
}

/* Triangles of a leaf of a mesh's tree that the ray crosses behind h. */
HD int csg_count_leaf(const flat_scene *s, const bvh_ray *r,
                      const uint32_t *items, uint32_t n, const ray_hit *h)
{
    int count = 0;
    for (uint32_t i = 0; i < n; i++) {
        uint64_t item = items[i];
        const flat_triangle *f = &s->triangles[item - s->shapes_count];
        real t, u, v;
        if (triangle_hit(&r->shear, r->o, real3_from(f->p[0]),
                         real3_from(f->p[1]), real3_from(f->p[2]), &t, &u,
                         &v) &&
            hit_after(t, ray_key(item, 0), h))
            count++;
    }
    return count;
}

/* Whether a mesh's walls ahead of the place are odd in number. */
HD_APART bool csg_mesh(const flat_scene *s, const flat_shape *f,
                       const csg_place *at)
{
    if (f->tree < 0)
        return false;
    bvh_ray own = at->ray ? *at->ray
                          : bvh_ray_make(at->p, real3_from(f->inside));
    ray_hit h = hit_none(at->t);
    h.key = at->key;
    uint32_t stack[BVH_STACK], node = (uint32_t)f->tree;
    int held = 0, count = 0;
    for (;;) {
        real t[BVH_WIDTH];
        bvh_enter_all(&s->bvh[node], &own, at->t, INFINITY, t);
        for (int i = 0; i < BVH_WIDTH; i++)
            if (t[i] < INFINITY)
                stack[held++] = BVH_WIDTH * node + (uint32_t)i;
        for (;;) {
            if (held == 0)
                return count & 1;
            uint32_t child = stack[--held], i = child % BVH_WIDTH;
            const bvh_node *n = &s->bvh[child / BVH_WIDTH];
            node = n->first[i];
            if (n->count[i] == 0)
                break;
            count += csg_count_leaf(s, &own, s->bvh_items + node, n->count[i],
                                    &h);
        }
    }
}

/* Whether a primitive, inverted if it says so, holds the place. */
HD bool csg_primitive(const flat_scene *s, int32_t shape, const csg_place *at)
{
    const flat_shape *f = &s->shapes[shape];
    bool mesh = scene_may(MAY_MESHES) && f->kind == SHAPE_MESH;
    bool in = mesh ? csg_mesh(s, f, at)
            : at->ray ? leaf_state(s, shape, at->ray, at->t, at->key)
                      : leaf_inside(s, f, at->p);
    return in != ((f->flags & SHAPE_INVERSE) != 0);
}

HD bool csg_beyond(const csg_node *n, const csg_place *at)
{
    return at->p.x + at->slack < n->lo[0] || at->p.x - at->slack > n->hi[0] ||
           at->p.y + at->slack < n->lo[1] || at->p.y - at->slack > n->hi[1] ||
           at->p.z + at->slack < n->lo[2] || at->p.z - at->slack > n->hi[2];
}

/* Whether a child that is `value` makes its parent so, whatever the others. */
HD bool csg_decides(const csg_node *parent, bool value)
{
    return value == (parent->op != CSG_INTERSECTION);
}

/* Whether the place is inside of the node. */
HD bool csg_holds(const flat_scene *s, int32_t top, const csg_place *at)
{
    int32_t i = top;
    for (;;) {
        const csg_node *n = &s->csg[i];
        bool value;
        if (csg_beyond(n, at)) {
            value = n->beyond;
        } else if (n->shape >= 0) {
            value = csg_primitive(s, n->shape, at);
        } else {
            i = n->first;
            continue;
        }
        /* Up, until a sibling is left to ask. */
        while (i != top) {
            n = &s->csg[i];
            if (!csg_decides(&s->csg[n->parent], value) && n->next >= 0)
                break;
            i = n->parent;
        }
        if (i == top)
            return value;
        i = s->csg[i].next;
    }
}

/* Whether any of the node's siblings decides what their parent is. */
HD bool csg_decided(const flat_scene *s, int32_t node, const csg_place *at)
{
    const csg_node *parent = &s->csg[s->csg[node].parent];
    for (int32_t i = parent->first; i >= 0; i = s->csg[i].next)
        if (i != node && csg_decides(parent, csg_holds(s, i, at)))
            return true;
    return false;
}

/* Whether the primitive bounds media that are seen, alone or in the whole. */
HD bool csg_has_media(const flat_scene *s, const flat_shape *f)
{
    const flat_shape *whole = &s->shapes[f->container];
    return whole->interior >= 0 && (whole->flags & SHAPE_HOLLOW) &&
           !(f->flags & SHAPE_THIN);
}

/* From what a hit at the place is to the primitive to what it is to the
 * composite: clears the hit's seen and turn where the tree does; false if
 * nothing is left. */
HD bool csg_crossing(const flat_scene *s, const flat_shape *f,
                     const csg_place *at, ray_hit *h)
{
    int32_t i = f->node;
    while ((h->seen || h->turn != TURN_NONE) && s->csg[i].parent >= 0) {
        bool is_union = s->csg[s->csg[i].parent].op == CSG_UNION;
        bool ask = !is_union || h->turn != TURN_NONE;
        if (ask && csg_decided(s, i, at)) {
            h->seen = h->seen && is_union;
            h->turn = TURN_NONE;
        }
        i = s->csg[i].parent;
    }
    return h->seen || h->turn != TURN_NONE;
}

#endif
