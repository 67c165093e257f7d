/* lbvh.h - the steps in which a GPU builds a binary BVH from its leaves up, of
 * which wide.h makes the one that rays go through.
 *
 * Items are sorted by the Morton codes of their centres, the codes make a
 * hierarchy (Karras 2012), and within its nodes, from below, clusters are
 * merged with those of their neighbours with which they share the smallest box
 * (Meister, Bittner 2018; Benthin et al. 2024). The tree depends on nothing but
 * the items and their order. */
#ifndef CORE_PHYSICS_LBVH_H
#define CORE_PHYSICS_LBVH_H
#include "core/physics/ray.h"
#include "core/physics/wide.h"

/* Clusters that are merged at a time; those that a node leaves to the one
 * above it, at most; how far among them neighbours are sought. */
enum { LBVH_WARP = 32, LBVH_LEFT = 16, LBVH_REACH = 8 };
enum { LBVH_NONE = -1 };

/* A part of the binary tree. `id` is its root's: items, in the order of their
 * codes, come first, then inner nodes. A merge takes the place of its right
 * part for the inner node that it makes, and passes on that of the left one:
 * each place is taken once, in whatever order merges happen. */
typedef struct {
    bvh_box box;
    uint32_t id, place;
    wide_cost cost;         /* of rays in the box                          */
    uint8_t items, leaf, split, depth;      /* as of its wide_part         */
} lbvh_cluster;

/* What a ray's hit may lie outside of its item: without it a tree could miss
 * what a loop over all items would find. */
HD void lbvh_widen(float lo[3], float hi[3])
{
    for (int k = 0; k < 3; k++) {
        float size = fmaxf(fabsf(lo[k]), fabsf(hi[k]));
        float slack = 2e-6f * size + 2e-7f;
        lo[k] -= slack;
        hi[k] += slack;
    }
}

HD void lbvh_triangle_box(const vec3 p[3], float lo[3], float hi[3])
{
    vec3 a = vec3_min(p[0], vec3_min(p[1], p[2]));
    vec3 b = vec3_max(p[0], vec3_max(p[1], p[2]));
    for (int k = 0; k < 3; k++) {
        lo[k] = vec3_get(a, k);
        hi[k] = vec3_get(b, k);
    }
}

HD float lbvh_area(const bvh_box *b)
{
    float x = b->hi[0] - b->lo[0], y = b->hi[1] - b->lo[1];
    float z = b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

HD bvh_box lbvh_union(const bvh_box *a, const bvh_box *b)
{
    bvh_box out;
    for (int k = 0; k < 3; k++) {
        out.lo[k] = hd_min(a->lo[k], b->lo[k]);
        out.hi[k] = hd_max(a->hi[k], b->hi[k]);
    }
    return out;
}

/* ---- codes -------------------------------------------------------------- */

/* The low 21 bits, two places apart. */
HD uint64_t lbvh_spread(uint32_t bits)
{
    uint64_t x = bits & 0x1fffffu;
    x = (x | x << 32) & 0x001f00000000ffffu;
    x = (x | x << 16) & 0x001f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

/* Of 0 to 2^21 - 1; what is no number is 0. */
HD uint32_t lbvh_step(float x, float lo, float scale)
{
    const float most = 2097151.0f;
    float at = (x - lo) * scale;
    return at > 0.0f ? (uint32_t)hd_min(at, most) : 0u;
}

/* Steps to a length, the same along all axes, where centres lie in a box. */
HD float lbvh_scale(const float lo[3], const float hi[3])
{
    float most = hd_max(hd_max(hi[0] - lo[0], hi[1] - lo[1]), hi[2] - lo[2]);
    return most > 0.0f && most < INFINITY ? 2097152.0f / most : 0.0f;
}

HD uint64_t lbvh_code(const float centre[3], const float lo[3], float scale)
{
    return lbvh_spread(lbvh_step(centre[0], lo[0], scale)) << 2 |
           lbvh_spread(lbvh_step(centre[1], lo[1], scale)) << 1 |
           lbvh_spread(lbvh_step(centre[2], lo[2], scale));
}

/* ---- hierarchy ---------------------------------------------------------- */

/* Whether the codes of items i and i + 1 differ in a higher place than those
 * of k and k + 1. Equal codes differ by their items' numbers. */
HD bool lbvh_differs_more(const uint64_t *code, uint32_t i, uint32_t k)
{
    uint64_t a = code[i] ^ code[i + 1], b = code[k] ^ code[k + 1];
    if (a == 0 && b == 0)
        return (i ^ (i + 1)) > (k ^ (k + 1));
    return a > b;
}

/* Whether the node of items left ... right, not of all n, is its parent's left
 * child (Apetrei 2014). */
HD bool lbvh_is_left(const uint64_t *code, uint32_t n, uint32_t left,
                     uint32_t right)
{
    return left == 0 ||
           (right != n - 1 && lbvh_differs_more(code, left - 1, right));
}

/* ---- clusters ----------------------------------------------------------- */

HD lbvh_cluster lbvh_item(const bvh_box *box, uint32_t number)
{
    lbvh_cluster c;
    c.box = *box;
    c.id = c.place = number;
    c.cost = wide_leaf(lbvh_area(box));
    c.items = c.leaf = 1;
    c.split = c.depth = 0;
    return c;
}

/* How ill two clusters go together, those in places i and k of their row: the
 * least is the best. The lower bits name k to i, and i to k; among equals
 * those go together that make the row half as long. */
HD uint64_t lbvh_distance(const bvh_box *a, const bvh_box *b, uint32_t i,
                          uint32_t k, bool even)
{
    union {
        float area;
        uint32_t bits;
    } of;
    bvh_box both = lbvh_union(a, b);
    of.area = even ? 0.0f : lbvh_area(&both);
    return (uint64_t)of.bits << 32 | (i ^ k);
}

HD uint32_t lbvh_partner(uint64_t distance, uint32_t i)
{
    return (uint32_t)distance ^ i;
}

/* The inner node over a and b, of n items in all. */
HD lbvh_cluster lbvh_merge(const lbvh_cluster *a, const lbvh_cluster *b,
                           uint32_t n)
{
    lbvh_cluster c;
    c.box = lbvh_union(&a->box, &b->box);
    c.id = n + b->place;
    c.place = a->place;
    uint32_t items = (uint32_t)a->items + b->items;
    c.items = (uint8_t)(items > BVH_LEAF ? BVH_LEAF + 1 : items);
    float area = lbvh_area(&c.box), whole = area * (float)c.items;
    c.cost = wide_inner(area, &a->cost, &b->cost, &c.split);
    c.leaf = items <= BVH_LEAF && whole <= c.cost.as[0];
    if (c.leaf)
        c.cost = wide_leaf(whole);
    int depth = 1 + (a->depth > b->depth ? a->depth : b->depth);
    c.depth = (uint8_t)(c.leaf ? 0 : depth < 255 ? depth : 255);
    return c;
}

#endif
