/* Leaves get their map from unit space, meshes become triangles of it, and
 * what can be seen goes into one tree. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/bvh.h"
#include "core/kdtree.h"
#include "core/physics/bvh.h"
#include "core/order.h"
#include "core/photons.h"
#include "core/plan.h"
#include "core/prepare.h"
#include "core/still.h"
#include "lib/memory.h"

static vec3 to_vec3(const double p[3])
{
    return vec3_make((float)p[0], (float)p[1], (float)p[2]);
}

static int32_t add_normals(struct flat *f, const struct mesh *m, size_t t,
                           const matrix *normal_map, struct brume_error *err)
{
    if (!m->corner_normal || m->corner_normal[t][0] == MESH_NONE)
        return -1;
    int32_t first = (int32_t)f->normals_count;
    vec3 *out = FLAT_EXTEND(f, normals, 3, err);
    for (int i = 0; out && i < 3; i++) {
        const float *n = m->normal[m->corner_normal[t][i]];
        double v[3] = {n[0], n[1], n[2]}, w[3];
        for (int k = 0; k < 3; k++) /* transposed: normals */
            w[k] = normal_map->m[0][k] * v[0] + normal_map->m[1][k] * v[1] +
                   normal_map->m[2][k] * v[2];
        out[i] = vec3_normalize(to_vec3(w));
    }
    return first;
}

/* Six times the signed volume below a triangle: its sum tells which way a
 * mesh's normals point. */
static double triangle_volume(const vec3 p[3])
{
    return (double)vec3_dot(p[0], vec3_cross(p[1], p[2]));
}

static bool add_triangles(struct flat *f, const struct leaf *leaf,
                          const matrix *to_unit, int32_t shape,
                          struct brume_error *err)
{
    const struct mesh *m = leaf->mesh;
    matrix from_unit;
    double volume = 0.0;
    if (!matrix_invert(to_unit, &from_unit))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a mesh's transform has no inverse");
    f->shapes[shape].triangle = f->triangles_count;
    f->shapes[shape].triangles = m->triangles;
    if (!FLAT_EXTEND(f, triangles, m->triangles, err))
        return false;
    flat_triangle *out = f->triangles + f->shapes[shape].triangle;
    for (size_t t = 0; t < m->triangles; t++) {
        for (int i = 0; i < 3; i++) {
            double p[3];
            matrix_point(to_unit, m->position[m->corner[t][i]], p);
            out[t].p[i] = to_vec3(p);
        }
        out[t].shape = shape;
        out[t].unseen = t >= leaf->seen_triangles;
        out[t].smooth = add_normals(f, m, t, &from_unit, err);
        if (err && err->code != BRUME_OK)
            return false;
        volume += triangle_volume(out[t].p);
    }
    if (volume < 0.0)
        f->shapes[shape].flags |= SHAPE_FLIPPED;
    return true;
}

/* The map to_local, and what follows it there. */
static bool add_numbers(struct flat *f, flat_shape *out, const matrix *to_local,
                        const double *data, size_t count,
                        struct brume_error *err)
{
    out->number = f->numbers_count;
    double *to = FLAT_EXTEND(f, numbers, NUMBERS_MAP + count, err);
    if (!to)
        return false;
    memcpy(to, to_local->m, sizeof to_local->m);
    memcpy(to + NUMBERS_MAP, data, count * sizeof *data);
    return true;
}

/* A shape that its map flattens is left out: nothing of it can be seen, or
 * (a box without thickness) it is not closed. */
static bool add_leaf(const struct prepare *job, const struct leaf *leaf,
                     int32_t id, struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_shape *out = &f->shapes[id];
    matrix map = matrix_compose(&f->to_unit, &leaf->map), inverse;
    out->kind = leaf->kind;
    out->tree = -1;
    if (leaf->kind == SHAPE_MESH)
        return add_triangles(f, leaf, &map, id, err);
    if (!matrix_finite(&map) || !matrix_invert(&map, &inverse)) {
        out->kind = SHAPE_MESH; /* of no triangles */
        out->flags |= SHAPE_THIN;
        if (job->warn)
            job->warn(job->user, "a shape without extent is left out");
        return true;
    }
    out->to_local = matrix_affine(&inverse);
    for (int i = 0; i < 4; i++)
        out->params[i] = (float)leaf->params[i];
    if (leaf->kind >= SOLID_FIRST)
        return add_numbers(f, out, &inverse, leaf->solid.data,
                           leaf->solid.count, err);
    return !job->exact || add_numbers(f, out, &inverse, leaf->params, 4, err);
}

static bool add_parts(const struct prepare *job, const struct assembly *a,
                      struct brume_error *err)
{
    struct flat *f = job->flat;
    if (!FLAT_EXTEND(f, shapes, a->parts_count, err) && a->parts_count > 0)
        return false;
    for (size_t i = 0; i < a->parts_count; i++) {
        const struct part *p = &a->parts[i];
        const struct whole *whole = &a->wholes[p->whole];
        flat_shape *out = &f->shapes[i];
        out->material = p->material;
        out->interior = p->node < 0 ? whole->interior : -1;
        out->flags = p->flags;
        out->node = p->node;
        out->container = (int32_t)(p->node < 0
                                       ? i
                                       : a->parts_count + (size_t)p->whole);
        if (!add_leaf(job, &p->leaf, (int32_t)i, err))
            return false;
    }
    return true;
}

/* Composites follow the parts, in the places of all wholes. */
static bool add_wholes(struct flat *f, const struct assembly *a,
                       struct brume_error *err)
{
    flat_shape *out = FLAT_EXTEND(f, shapes, a->wholes_count, err);
    if (!out && a->wholes_count > 0)
        return false;
    for (size_t i = 0; i < a->wholes_count; i++) {
        const struct whole *whole = &a->wholes[i];
        out[i].kind = whole->node < 0 ? SHAPE_MESH : SHAPE_COMPOSITE;
        out[i].material = out[i].tree = -1;
        out[i].interior = whole->node < 0 ? -1 : whole->interior;
        out[i].flags = whole->flags;
        out[i].node = whole->node;
        out[i].container = (int32_t)(a->parts_count + i);
    }
    return true;
}

/* A box of unit space in float, widened by the rounding. */
static void unit_box(const struct flat *f, const struct box *b, float lo[3],
                     float hi[3])
{
    for (int i = 0; i < 3; i++) {
        double x = (b->lo[i] - f->centre[i]) * f->unit;
        double y = (b->hi[i] - f->centre[i]) * f->unit;
        double slack = 1e-6 * (fabs(x) + fabs(y));
        if (!isfinite(slack))
            slack = 1e-6 * (isfinite(x) ? fabs(x) : fabs(y));
        lo[i] = (float)(x - slack);
        hi[i] = (float)(y + slack);
    }
}

static bool add_nodes(struct flat *f, const struct assembly *a,
                      struct brume_error *err)
{
    csg_node *out = FLAT_EXTEND(f, csg, a->nodes_count, err);
    if (!out && a->nodes_count > 0)
        return false;
    for (size_t i = 0; i < a->nodes_count; i++) {
        const struct node *n = &a->nodes[i];
        out[i].parent = n->parent;
        out[i].first = n->first;
        out[i].next = n->next;
        out[i].shape = n->part;
        out[i].op = (uint8_t)n->op;
        out[i].beyond = n->beyond;
        unit_box(f, &n->bounds, out[i].lo, out[i].hi);
    }
    return true;
}

/* Queries read the scene's own. */
static bool add_images(const struct prepare *job, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    struct flat *f = job->flat;
    if (s->images_count == 0)
        return true;
    flat_image *images = FLAT_EXTEND(f, images, s->images_count, err);
    float *texels = images ? FLAT_EXTEND(f, texels, s->texels_count, err)
                           : NULL;
    if (!texels)
        return false;
    memcpy(images, s->images, s->images_count * sizeof *images);
    memcpy(texels, s->texels, s->texels_count * sizeof *texels);
    return true;
}

/* The scene's functions go along where an isosurface, a pigment, the sky or a
 * field asks for their values. */
static bool add_functions(const struct prepare *job, const struct assembly *a,
                          struct brume_error *err)
{
    const brume_scene *s = job->scene;
    struct flat *f = job->flat;
    bool needed = s->sky.function >= 0;
    for (size_t i = 0; i < a->parts_count; i++)
        needed = needed || a->parts[i].leaf.kind == SOLID_ISOSURFACE;
    for (size_t i = 0; i < s->materials_count; i++)
        needed = needed || s->materials[i].function >= 0;
    for (size_t i = 0; i < s->fields_count && !job->exact; i++)
        needed = needed || s->fields[i].kind == BRUME_FIELD_FUNCTION;
    if (!needed)
        return true;
    machine_instruction *code = FLAT_EXTEND(f, code, s->code_count, err);
    machine_function *functions = FLAT_EXTEND(f, functions, s->functions_count,
                                              err);
    float *pool = FLAT_EXTEND(f, pool, s->pool_count + 1, err);
    double *exact = FLAT_EXTEND(f, exact_pool, s->pool_count + 1, err);
    if (!code || !functions || !pool || !exact)
        return false;
    memcpy(code, s->code, s->code_count * sizeof *code);
    memcpy(functions, s->functions, s->functions_count * sizeof *functions);
    if (!job->exact && !add_images(job, err))
        return false;
    for (size_t i = 0; i < s->pool_count; i++) {
        pool[i] = (float)s->pool[i];
        exact[i] = s->pool[i];
    }
    return true;
}

/* ---- trees ------------------------------------------------------------- */

/* Part by part: the tree of a large mesh, and where it is in the flat one. */
struct trees {
    struct mesh_tree **of;
    uint32_t *root;
    uint64_t from; /* names of those of the parts                 */
    int room;      /* places of a search of one of them           */
    bool later;    /* the tree of all is left to the backend      */
};

static void triangle_item(const struct flat *f, size_t i, struct bvh_item *out)
{
    bvh_triangle(f, i, out);
    out->name = (uint32_t)(f->shapes_count + i);
}

/* What only bounds media is not looked for where there are none. */
static bool is_sought(const struct flat *f, size_t i)
{
    const flat_shape *s = &f->shapes[i];
    bool seen = s->material >= 0 && !(s->flags & SHAPE_UNSEEN);
    return seen || csg_has_media(&f->view, s);
}

/* Places that are left for the tree of all. */
static int room(const struct trees *trees)
{
    return BVH_STACK - 1 - trees->room;
}

static bool build_tree(const struct prepare *job, const struct trees *trees,
                       struct bvh_item *items, size_t count,
                       struct brume_error *err)
{
    struct flat *f = job->flat;
    size_t first = f->bvh_count;
    bool good = false;
    if (trees->later)
        return order_tree(f, job->tree, job->tree_stack, items, count, err);
    switch (job->tree) {
    case BRUME_TREE_BVH:
        good = still_bvh(job->still, f, items, count, trees->from, room(trees),
                         err);
        break;
    case BRUME_TREE_KD:
        good = kd_build(f, items, count, job->tree_stack, err);
        break;
    case BRUME_TREE_BOTH:
        good = still_build(job->still, f, items, count, job->tree_stack, err);
        break;
    }
    f->view.bvh_root = f->bvh_count > first ? (int32_t)first : -1;
    return good;
}

/* What rays look for beside meshes. */
static bool list_shapes(const struct prepare *job, const struct assembly *a,
                        struct bvh_item *items, size_t *count,
                        struct brume_error *err)
{
    struct flat *f = job->flat;
    for (size_t i = 0; i < a->parts_count; i++) {
        const struct box *seen = &a->parts[i].seen;
        if (f->shapes[i].kind == SHAPE_MESH || box_is_empty(seen) ||
            !(job->exact || is_sought(f, i)))
            continue;
        if (!box_is_bounded(seen)) {
            int32_t *u = FLAT_EXTEND(f, unbounded, 1, err);
            if (!u)
                return false;
            *u = (int32_t)i;
            continue;
        }
        unit_box(f, seen, items[*count].lo, items[*count].hi);
        items[(*count)++].name = (uint32_t)i;
    }
    return true;
}

/* All triangles of a part as one. */
static void tree_item(const struct flat *f, const struct trees *trees,
                      size_t part, struct bvh_item *out)
{
    const flat_shape *s = &f->shapes[part];
    triangle_item(f, s->triangle, out);
    for (size_t t = 1; t < s->triangles; t++) {
        struct bvh_item item;
        bvh_triangle(f, s->triangle + t, &item);
        for (int k = 0; k < 3; k++) {
            out->lo[k] = fminf(out->lo[k], item.lo[k]);
            out->hi[k] = fmaxf(out->hi[k], item.hi[k]);
        }
    }
    out->name = (uint32_t)(trees->from + part);
}

static void list_meshes(const struct flat *f, const struct assembly *a,
                        const struct trees *trees, struct bvh_item *items,
                        size_t *count)
{
    for (size_t i = 0; i < a->parts_count; i++) {
        const flat_shape *s = &f->shapes[i];
        if (s->kind != SHAPE_MESH)
            continue;
        if (trees->of && trees->of[i]) {
            tree_item(f, trees, i, &items[(*count)++]);
            continue;
        }
        for (size_t t = 0; t < s->triangles; t++)
            triangle_item(f, s->triangle + t, &items[(*count)++]);
    }
}

/* The leaf of a large mesh becomes the root of its tree. */
static bool add_tree(struct flat *f, struct trees *trees, size_t node,
                     uint32_t child, struct brume_error *err)
{
    size_t part = f->bvh_items[f->bvh[node].first[child]] - trees->from;
    trees->root[part] = (uint32_t)f->bvh_count;
    if (!mesh_tree_add(trees->of[part], f, f->shapes[part].triangle, err))
        return false;
    f->bvh[node].first[child] = trees->root[part];
    f->bvh[node].count[child] = 0;
    return true;
}

static bool add_trees(struct flat *f, struct trees *trees, size_t first,
                      struct brume_error *err)
{
    size_t end = f->bvh_count;
    for (size_t i = first; trees->of && i < end; i++)
        for (uint32_t k = 0; k < BVH_WIDTH; k++)
            if (f->bvh[i].count[k] == 1 &&
                f->bvh_items[f->bvh[i].first[k]] >= trees->from &&
                !add_tree(f, trees, i, k, err))
                return false;
    return true;
}

/* The tree of all that rays look for comes first. */
static bool make_tree(const struct prepare *job, const struct assembly *a,
                      struct trees *trees, struct bvh_item *items,
                      struct brume_error *err)
{
    size_t count = 0, first = job->flat->bvh_count;
    if (!list_shapes(job, a, items, &count, err))
        return false;
    if (!trees->later)
        list_meshes(job->flat, a, trees, items, &count);
    return build_tree(job, trees, items, count, err) &&
           add_trees(job->flat, trees, first, err);
}

/* Meshes whose inside is asked for have trees of their own. */
static bool make_mesh_trees(const struct prepare *job, const struct assembly *a,
                            const struct trees *trees, struct bvh_item *items,
                            struct brume_error *err)
{
    struct flat *f = job->flat;
    for (size_t i = 0; i < a->parts_count; i++) {
        flat_shape *s = &f->shapes[i];
        const double *v = a->parts[i].leaf.inside;
        if (s->kind != SHAPE_MESH || s->triangles == 0 ||
            (s->flags & SHAPE_THIN) || (s->node < 0 && !job->exact))
            continue;
        s->inside = to_vec3(v);
        if (trees->of && trees->of[i]) {
            s->tree = (int32_t)trees->root[i];
            continue;
        }
        s->tree = (int32_t)f->bvh_count;
        for (size_t t = 0; t < s->triangles; t++)
            triangle_item(f, s->triangle + t, &items[t]);
        if (!bvh_build(f, items, s->triangles, err))
            return false;
    }
    return true;
}

/* Those of a film's large meshes, built or kept; a mesh for which there is no
 * memory, or too deep a tree, goes into the tree of all. */
static bool find_trees(const struct prepare *job, const struct assembly *a,
                       struct trees *trees, struct brume_error *err)
{
    struct brume_still *still = job->still;
    struct flat *f = job->flat;
    size_t count = a->parts_count;
    trees->from = f->shapes_count + f->triangles_count;
    if (!still || job->tree != BRUME_TREE_BVH || job->exact || trees->later)
        return true;
    trees->of = memory_new(count, sizeof(struct mesh_tree *), err);
    trees->root = memory_new(count, sizeof *trees->root, err);
    if (!trees->of || !trees->root)
        return false;
    for (size_t i = 0; i < count; i++) {
        struct mesh_tree *tree = NULL;
        if (f->shapes[i].kind == SHAPE_MESH &&
            f->shapes[i].triangles >= MESH_TREE_WORTH)
            tree = mesh_tree_of(&still->tree, a->parts[i].leaf.mesh,
                                &still->tree_builds);
        if (!tree || tree->room > MESH_TREE_ROOM)
            continue;
        still->tree_uses++;
        trees->of[i] = tree;
        if (trees->room < tree->room)
            trees->room = tree->room;
    }
    mesh_trees_drop(&still->tree, false);
    return true;
}

/* Surfaces that have no end or glow: pilots of their photons look into the tree
 * on the host (photons_seek). Where those of even media do, plan_layout builds
 * it. */
static bool has_births(const struct flat *f, const struct assembly *a)
{
    if (photons_glow(&f->view))
        return true;
    for (size_t i = 0; i < a->parts_count; i++)
        if (f->shapes[i].material >= 0 && !box_is_bounded(&a->parts[i].seen))
            return true;
    return false;
}

static bool make_trees(const struct prepare *job, const struct assembly *a,
                       struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_view(f);
    struct trees trees = {.of = NULL,
                          .later = job->later && !job->exact &&
                                   plan_leaves_tree(f, job->tree) &&
                                   !(job->traced && has_births(f, a))};
    size_t most = f->shapes_count + f->triangles_count;
    if (most + f->shapes_count > UINT32_MAX)
        return brume_fail(err, BRUME_ERR_LIMIT, "more than 2^32 surfaces");
    struct bvh_item *items = malloc((most + 1) * sizeof *items);
    if (!items)
        return brume_fail(err, BRUME_ERR_MEMORY,
                          "out of memory for a tree over %zu surfaces", most);
    bool good = find_trees(job, a, &trees, err) &&
                make_tree(job, a, &trees, items, err) &&
                make_mesh_trees(job, a, &trees, items, err);
    free(trees.of);
    free(trees.root);
    free(items);
    return good;
}

bool prepare_shapes(const struct prepare *job, const struct assembly *a,
                    struct brume_error *err)
{
    struct flat *f = job->flat;
    if (!add_parts(job, a, err) || !add_wholes(f, a, err) ||
        !add_nodes(f, a, err) || !add_functions(job, a, err) ||
        !make_trees(job, a, err))
        return false;
    flat_view(f);
    return true;
}
