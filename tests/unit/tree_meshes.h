/* tree_meshes.h - meshes and rays to hold trees against each other with. */
#ifndef TESTS_UNIT_TREE_MESHES_H
#define TESTS_UNIT_TREE_MESHES_H
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/kdtree.h"
#include "core/physics/bvh.h"
#include "core/physics/rng.h"
#include "core/physics/warp.h"
#include "lib/ply.h"

/* A list of triangles that grows. */
struct triangles {
    vec3 (*corner)[3];
    size_t count;
};

static void triangles_add(struct triangles *t, vec3 a, vec3 b, vec3 c)
{
    if ((t->count & (t->count - 1)) == 0)
        t->corner = realloc(t->corner, (t->count ? 2 * t->count : 1) *
                                           sizeof *t->corner);
    t->corner[t->count][0] = a;
    t->corner[t->count][1] = b;
    t->corner[t->count++][2] = c;
}

static bool triangles_load(struct triangles *t, const char *path,
                           struct brume_error *err)
{
    struct mesh *m = ply_load(path, err);
    for (size_t i = 0; m && i < m->triangles; i++) {
        vec3 p[3];
        for (int k = 0; k < 3; k++) {
            const double *from = m->position[m->corner[i][k]];
            p[k] = vec3_make((float)from[0], (float)from[1], (float)from[2]);
        }
        triangles_add(t, p[0], p[1], p[2]);
    }
    mesh_free(m);
    return m != NULL;
}

static vec3 middle(vec3 a, vec3 b)
{
    return vec3_scale(vec3_add(a, b), 0.5f);
}

/* Each triangle into four, in its plane. */
static struct triangles triangles_divide(const struct triangles *from)
{
    struct triangles t = {NULL, 0};
    for (size_t i = 0; i < from->count; i++) {
        const vec3 *p = from->corner[i];
        vec3 a = middle(p[0], p[1]), b = middle(p[1], p[2]);
        vec3 c = middle(p[2], p[0]);
        triangles_add(&t, p[0], a, c);
        triangles_add(&t, a, p[1], b);
        triangles_add(&t, c, b, p[2]);
        triangles_add(&t, a, b, c);
    }
    return t;
}

/* What meshes from the wild have: points, needles, triangles twice and turned
 * over, all in one plane of an axis, or as large as the scene. */
static struct triangles triangles_degenerate(size_t count)
{
    struct triangles t = {NULL, 0};
    rng r = rng_make(7, 0, 0, 1);
    vec3 a = vec3_make(0, 0, 0), b = a, c = a;
    for (size_t i = 0; i < count; i++) {
        vec3 at = vec3_make(rng_float(&r) - 0.5f, rng_float(&r) - 0.5f,
                            rng_float(&r) - 0.5f);
        vec3 x = vec3_make(0.1f * rng_float(&r), 0.1f * rng_float(&r),
                           0.1f * rng_float(&r));
        vec3 y = vec3_make(0.1f * rng_float(&r), -0.1f * rng_float(&r),
                           0.1f * rng_float(&r));
        switch (i % 64 == 12 ? 4 : i % 8 == 4 ? 5 : i % 8) {
        case 0:                         /* a point                     */
            a = b = c = at;
            break;
        case 1:                         /* a needle                    */
            a = at;
            b = vec3_add(at, x);
            c = vec3_add(at, vec3_scale(x, 3.0f));
            break;
        case 2:                         /* in the plane y = 1/8        */
            a = vec3_make(at.x, 0.125f, at.z);
            b = vec3_make(at.x + x.x, 0.125f, at.z);
            c = vec3_make(at.x, 0.125f, at.z + x.z);
            break;
        case 3:                         /* the one before, turned over */
        {
            vec3 swap = b;
            b = c;
            c = swap;
            break;
        }
        case 4:                         /* as large as all             */
            a = vec3_scale(at, 2.0f);
            b = vec3_scale(x, 9.0f);
            c = vec3_scale(y, -9.0f);
            break;
        default:
            a = at;
            b = vec3_add(at, x);
            c = vec3_add(at, y);
        }
        triangles_add(&t, a, b, c);
    }
    return t;
}

/* ---- trees -------------------------------------------------------------- */

enum tree { TREE_NONE, TREE_BVH, TREE_KD, TREE_BOTH };

static struct bvh_item triangle_bounds(const vec3 p[3], uint32_t name)
{
    struct bvh_item item;
    vec3 lo = vec3_min(p[0], vec3_min(p[1], p[2]));
    vec3 hi = vec3_max(p[0], vec3_max(p[1], p[2]));
    for (int k = 0; k < 3; k++) {
        item.lo[k] = vec3_get(lo, k);
        item.hi[k] = vec3_get(hi, k);
    }
    item.name = name;
    return item;
}

/* A scene of one mesh; of both trees, each holds every other triangle. */
static struct flat *tree_scene(const struct triangles *t, enum tree tree,
                               int stack, struct brume_error *err)
{
    struct flat *f = flat_new(err);
    flat_shape *shape = FLAT_EXTEND(f, shapes, 1, err);
    flat_triangle *out = FLAT_EXTEND(f, triangles, t->count, err);
    struct bvh_item *item = malloc((t->count + 1) * sizeof *item);
    size_t last = t->count, first = 0;
    shape->kind = SHAPE_MESH;
    shape->interior = shape->node = shape->tree = -1;
    shape->triangles = t->count;
    for (size_t i = 0; i < t->count; i++) {
        memcpy(out[i].p, t->corner[i], sizeof out[i].p);
        out[i].smooth = -1;
        struct bvh_item bounds = triangle_bounds(t->corner[i],
                                                 (uint32_t)(1 + i));
        if (tree == TREE_KD || (tree == TREE_BOTH && i % 2))
            item[--last] = bounds;
        else
            item[first++] = bounds;
    }
    bool good = tree == TREE_NONE ||
                (bvh_build(f, item, first, err) &&
                 kd_build(f, item + last, t->count - last, stack, err));
    f->view.bvh_root = f->bvh_count > 0 ? 0 : -1;
    free(item);
    flat_view(f);
    if (good)
        return f;
    flat_free(f);
    return NULL;
}

/* ---- rays --------------------------------------------------------------- */

/* From around the mesh into any direction; some along the axes, some in the
 * planes of them, some through a corner or along an edge of a triangle. */
static bvh_ray tree_ray(const struct triangles *t, uint64_t number)
{
    rng r = rng_make(11, 0, 0, number);
    vec3 o = vec3_make(3.0f * rng_float(&r) - 1.5f,
                       3.0f * rng_float(&r) - 1.5f,
                       3.0f * rng_float(&r) - 1.5f);
    float u = rng_float(&r), v = rng_float(&r);
    vec3 d = warp_sphere(u, v);
    size_t i = (size_t)(rng_float(&r) * (float)t->count) % t->count;
    const vec3 *p = t->corner[i];
    switch (number % 16) {
    case 0:
        d = vec3_make(0.0f, v < 0.5f ? -1.0f : 1.0f, 0.0f);
        break;
    case 1:
        d = vec3_normalize(vec3_make(d.x, 0.0f, d.z));
        break;
    case 2:
        o.y = p[0].y;
        d = vec3_normalize(vec3_make(d.x, 0.0f, d.z));
        break;
    case 3:
        d = vec3_normalize(vec3_sub(p[1], o));
        break;
    case 4:
        o = vec3_sub(p[0], vec3_scale(vec3_sub(p[1], p[0]), 3.0f));
        d = vec3_sub(p[1], p[0]);
        if (vec3_dot(d, d) > 0.0f)
            d = vec3_normalize(d);
        else
            d = vec3_make(0.0f, 0.0f, 1.0f);
        break;
    case 5:
        o = p[2];
        break;
    default:
        /* At the mesh: most others pass it by. */
        d = vec3_normalize(vec3_sub(vec3_scale(d, 0.5f), o));
    }
    return bvh_ray_make(o, d);
}

static bool same_hit(const ray_hit *a, const ray_hit *b)
{
    return a->t == b->t && a->key == b->key && a->shape == b->shape &&
           a->triangle == b->triangle && a->u == b->u && a->v == b->v;
}

#endif
