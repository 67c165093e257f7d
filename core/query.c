/* Queries of shapes while the scene is told: the same trees and the same
 * physics as when it is rendered, in double. */
#define PHYSICS_DOUBLE
#include <stdlib.h>
#include "core/physics/bvh.h"
#include "core/prepare.h"
#include "core/query.h"
#include "core/shapes.h"

/* Surfaces nearer than this to a ray's origin are those that it starts on. */
#define NEAR 1e-6

struct scene_query *query_of(brume_scene *scene, int shape,
                             struct brume_error *err)
{
    if (shape < 0 || (size_t)shape >= scene->shapes_count) {
        brume_fail(err, BRUME_ERR_SCENE, "there is no shape %d", shape);
        return NULL;
    }
    size_t have = scene->queries_count;
    if (have < scene->shapes_count &&
        !flat_extend((void **)&scene->queries, &scene->queries_capacity,
                     &scene->queries_count, scene->shapes_count - have,
                     sizeof *scene->queries, err))
        return NULL;
    return &scene->queries[shape];
}

static struct flat *make_flat(const brume_scene *scene, int shape,
                              struct brume_error *err)
{
    struct prepare job = {.scene = scene, .exact = true};
    struct assembly assembly;
    job.flat = flat_new(err);
    if (!job.flat)
        return NULL;
    job.flat->unit = 1.0;
    job.flat->to_unit = job.flat->from_unit = matrix_identity();
    bool good = assembly_make(scene, shape, &assembly, err);
    if (good) {
        good = prepare_shapes(&job, &assembly, err);
        assembly_release(&assembly);
    }
    if (good)
        return job.flat;
    flat_free(job.flat);
    return NULL;
}

static const flat_scene *query_scene(brume_scene *scene, int shape,
                                     struct brume_error *err)
{
    struct scene_query *q = query_of(scene, shape, err);
    if (q && !q->flat)
        q->flat = make_flat(scene, shape, err);
    if (!q || !q->flat)
        return NULL;
    q->flat->view.host_grids = scene->grids;
    q->flat->view.images = scene->images;
    q->flat->view.texels = scene->texels;
    return &q->flat->view;
}

static dvec3 make_point(const double p[3])
{
    return dvec3_make(p[0], p[1], p[2]);
}

static void put_point(dvec3 p, double out[3])
{
    out[0] = p.x;
    out[1] = p.y;
    out[2] = p.z;
}

/* A smooth triangle's normal between those of its corners. */
static dvec3 triangle_normal(const flat_scene *s, const ray_hit *h)
{
    const flat_triangle *f = &s->triangles[h->triangle];
    dvec3 p = real3_from(f->p[0]);
    dvec3 flat = dvec3_cross(dvec3_sub(real3_from(f->p[1]), p),
                             dvec3_sub(real3_from(f->p[2]), p));
    if (f->smooth < 0)
        return flat;
    const vec3 *n = s->normals + f->smooth;
    dvec3 mean = dvec3_scale(real3_from(n[0]), 1.0 - h->u - h->v);
    mean = dvec3_mad(mean, h->u, real3_from(n[1]));
    return dvec3_mad(mean, h->v, real3_from(n[2]));
}

static dvec3 hit_normal(const flat_scene *s, const bvh_ray *r, const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    dvec3 p = dvec3_mad(r->o, h->t, r->d), n;
    if (h->triangle >= 0)
        n = triangle_normal(s, h);
    else if (leaf_is_solid(f))
        n = leaf_solid_side(s, f, leaf_point(s, f, p), h->surface);
    else
        n = leaf_normal(s, f,
                        shape_normal(f->kind, leaf_params(s, f),
                                     leaf_point(s, f, p), h->surface));
    double length = dvec3_length(n);
    double turn = f->flags & SHAPE_INVERSE && h->triangle < 0 ? -1.0 : 1.0;
    return dvec3_scale(n, length > 0.0 ? turn / length : 0.0);
}

int brume_trace(brume_scene *scene, int shape, const double origin[3],
                const double direction[3], double point[3], double normal[3],
                struct brume_error *err)
{
    const flat_scene *s = query_scene(scene, shape, err);
    dvec3 d = make_point(direction);
    double length = dvec3_length(d);
    if (!s)
        return -1;
    if (!(length > 0.0 && length < INFINITY))
        return 0;
    bvh_ray r = bvh_ray_make(make_point(origin), dvec3_scale(d, 1.0 / length));
    ray_hit h = hit_start(NEAR);
    do {
        ray_hit after = h;
        h = bvh_nearest(s, &r, &after, INFINITY);
    } while (h.shape >= 0 && !h.seen);
    if (h.shape < 0)
        return 0;
    put_point(dvec3_mad(r.o, h.t, r.d), point);
    put_point(hit_normal(s, &r, &h), normal);
    return 1;
}

/* A plain union lies there as what it is made of. */
int brume_inside(brume_scene *scene, int shape, const double point[3],
                 struct brume_error *err)
{
    const flat_scene *s = query_scene(scene, shape, err);
    csg_place at = csg_at_point(make_point(point));
    if (!s)
        return -1;
    for (uint64_t i = 0; i < s->shapes_count; i++) {
        const flat_shape *f = &s->shapes[i];
        bool whole = f->container == (int32_t)i;
        if (whole &&
            (f->kind == SHAPE_COMPOSITE ? csg_holds(s, f->node, &at)
                                        : csg_primitive(s, (int32_t)i, &at)))
            return 1;
    }
    return 0;
}
