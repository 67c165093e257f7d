/* Shapes get their canonical space, meshes become triangles of unit space,
 * and both go into one tree. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/bvh.h"
#include "core/physics/bvh.h"
#include "core/prepare.h"

static void normalize(double v[3])
{
    double l = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= l;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* Columns (radius x, radius y, axis) and origin: x and y any unit vectors
 * normal to the axis. */
static matrix axis_frame(const double origin[3], const double axis[3],
                         double radius)
{
    double z[3] = {axis[0], axis[1], axis[2]}, x[3], y[3];
    normalize(z);
    double side[3] = {0, 0, 0};
    side[fabs(z[0]) < 0.5 ? 0 : 1] = 1.0;
    cross(side, z, x);
    normalize(x);
    cross(z, x, y);
    matrix out;
    for (int i = 0; i < 3; i++) {
        out.m[i][0] = radius * x[i];
        out.m[i][1] = radius * y[i];
        out.m[i][2] = axis[i];
        out.m[i][3] = origin[i];
    }
    return out;
}

static matrix cone_frame(const struct brume_shape *in, float params[4])
{
    double axis[3], radius = in->radius;
    for (int i = 0; i < 3; i++)
        axis[i] = in->b[i] - in->a[i];
    if (in->kind == BRUME_SHAPE_CYLINDER) {
        params[0] = in->open;
    } else {
        radius = fmax(in->radius, in->radius_b);
        params[0] = (float)(in->radius / radius);
        params[1] = (float)(in->radius_b / radius);
        params[2] = in->open;
    }
    return axis_frame(in->a, axis, radius);
}

static matrix plane_frame(const struct brume_shape *in)
{
    double n[3] = {in->a[0], in->a[1], in->a[2]}, origin[3];
    normalize(n);
    for (int i = 0; i < 3; i++)
        origin[i] = n[i] * in->radius;
    return axis_frame(origin, n, 1.0);
}

static matrix disc_frame(const struct brume_shape *in, float params[4])
{
    double n[3] = {in->b[0], in->b[1], in->b[2]};
    normalize(n);
    params[0] = (float)(in->radius_b / in->radius);
    return axis_frame(in->a, n, in->radius);
}

static matrix box_frame(const struct brume_shape *in)
{
    matrix out = matrix_identity();
    for (int i = 0; i < 3; i++) {
        out.m[i][i] = 0.5 * fabs(in->b[i] - in->a[i]);
        out.m[i][3] = 0.5 * (in->a[i] + in->b[i]);
    }
    return out;
}

/* The shape's canonical space (shape.h) in that of its parameters. */
static matrix canonical(const struct brume_shape *in, flat_shape *out)
{
    switch (in->kind) {
    case BRUME_SHAPE_SPHERE:
        out->kind = SHAPE_SPHERE;
        return matrix_scale_move(in->radius, in->a);
    case BRUME_SHAPE_BOX:
        out->kind = SHAPE_BOX;
        return box_frame(in);
    case BRUME_SHAPE_CYLINDER:
        out->kind = SHAPE_CYLINDER;
        return cone_frame(in, out->params);
    case BRUME_SHAPE_CONE:
        out->kind = SHAPE_CONE;
        return cone_frame(in, out->params);
    case BRUME_SHAPE_PLANE:
        out->kind = SHAPE_PLANE;
        return plane_frame(in);
    case BRUME_SHAPE_DISC:
        out->kind = SHAPE_DISC;
        return disc_frame(in, out->params);
    default:
        out->kind = SHAPE_MESH;
        return matrix_identity();
    }
}

/* Bounds of the canonical shape under a map, widened by float's rounding. */
static void shape_bounds(int kind, const matrix *m, struct bvh_item *box)
{
    for (int i = 0; i < 3; i++) {
        const double *r = m->m[i];
        double centre = r[3], half;
        if (kind == SHAPE_SPHERE) {
            half = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
        } else if (kind == SHAPE_BOX) {
            half = fabs(r[0]) + fabs(r[1]) + fabs(r[2]);
        } else {
            double tall = kind == SHAPE_DISC ? 0.0 : 0.5;
            centre += tall * r[2];
            half = sqrt(r[0] * r[0] + r[1] * r[1]) + tall * fabs(r[2]);
        }
        double slack = 1e-6 * (fabs(centre) + half);
        box->lo[i] = (float)(centre - half - slack);
        box->hi[i] = (float)(centre + half + slack);
    }
}

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

static bool add_triangles(struct flat *f, const struct mesh *m,
                          const matrix *to_unit, int32_t shape,
                          struct brume_error *err)
{
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
        out[t].smooth = add_normals(f, m, t, &from_unit, err);
        if (err && err->code != BRUME_OK)
            return false;
        volume += triangle_volume(out[t].p);
    }
    if (volume < 0.0)
        f->shapes[shape].flags |= SHAPE_FLIPPED;
    return true;
}

static int32_t shape_flags(const struct brume_shape *in)
{
    return (in->hollow ? SHAPE_HOLLOW : 0) | (in->inverse ? SHAPE_INVERSE : 0) |
           (in->shadow ? 0 : SHAPE_NO_SHADOW);
}

/* A shape that its map flattens is left out: nothing of it can be seen, or
 * (a box without thickness) it is not closed. */
static bool add_shape(const struct prepare *job, const struct brume_shape *in,
                      struct brume_error *err)
{
    struct flat *f = job->flat;
    int32_t id = (int32_t)f->shapes_count;
    flat_shape *out = FLAT_EXTEND(f, shapes, 1, err);
    if (!out)
        return false;
    matrix local = canonical(in, out), placed = matrix_from(in->transform);
    matrix map = matrix_compose(&placed, &local), inverse;
    map = matrix_compose(&f->to_unit, &map);
    out->material = in->material;
    out->interior = in->interior;
    out->flags = shape_flags(in);
    if (out->kind == SHAPE_MESH)
        return add_triangles(f, job->scene->meshes[in->mesh], &map, id, err);
    if (!matrix_finite(&map) || !matrix_invert(&map, &inverse)) {
        out->kind = SHAPE_MESH; /* of no triangles */
        if (job->warn)
            job->warn(job->user, "a shape without extent is left out");
        return true;
    }
    out->to_local = matrix_affine(&inverse);
    return true;
}

static matrix shape_map(const flat_shape *s)
{
    matrix to_local, out = matrix_identity();
    for (int i = 0; i < 12; i++)
        to_local.m[i / 4][i % 4] = s->to_local.m[i];
    matrix_invert(&to_local, &out);
    return out;
}

static void triangle_item(const struct flat *f, size_t i, struct bvh_item *out)
{
    const vec3 *p = f->triangles[i].p;
    vec3 lo = vec3_min(p[0], vec3_min(p[1], p[2]));
    vec3 hi = vec3_max(p[0], vec3_max(p[1], p[2]));
    for (int k = 0; k < 3; k++) {
        out->lo[k] = vec3_get(lo, k);
        out->hi[k] = vec3_get(hi, k);
    }
    out->name = (uint32_t)(f->shapes_count + i);
}

static bool make_tree(struct flat *f, struct brume_error *err)
{
    size_t n = 0, most = f->shapes_count + f->triangles_count;
    if (most > UINT32_MAX)
        return brume_fail(err, BRUME_ERR_LIMIT, "more than 2^32 surfaces");
    struct bvh_item *items = malloc((most + 1) * sizeof *items);
    if (!items)
        return brume_fail(err, BRUME_ERR_MEMORY,
                          "out of memory for a tree over %zu surfaces", most);
    bool good = true;
    for (size_t i = 0; good && i < f->shapes_count; i++) {
        int kind = f->shapes[i].kind;
        if (kind == SHAPE_PLANE) {
            int32_t *u = FLAT_EXTEND(f, unbounded, 1, err);
            good = u != NULL;
            if (u)
                *u = (int32_t)i;
        } else if (kind != SHAPE_MESH) {
            matrix map = shape_map(&f->shapes[i]);
            shape_bounds(kind, &map, &items[n]);
            items[n++].name = (uint32_t)i;
        }
    }
    for (size_t i = 0; i < f->triangles_count; i++)
        triangle_item(f, i, &items[n++]);
    good = good && bvh_build(f, items, n, err);
    free(items);
    return good;
}

bool prepare_shapes(const struct prepare *job, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    for (size_t i = 0; i < s->shapes_count; i++)
        if (!s->shapes[i].part && !add_shape(job, &s->shapes[i], err))
            return false;
    if (!make_tree(job->flat, err))
        return false;
    flat_view(job->flat);
    return true;
}
