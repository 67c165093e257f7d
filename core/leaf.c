/* Frames, numbers and bounds of each kind of primitive. */
#include "core/leaf.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/leaf.h"
#include "core/surfaces.h"
#include "lib/memory.h"

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

static matrix cone_frame(const struct brume_shape *in, double params[4])
{
    double axis[3], radius = in->radius;
    for (int i = 0; i < 3; i++)
        axis[i] = in->b[i] - in->a[i];
    if (in->kind == BRUME_SHAPE_CONE) {
        radius = fmax(in->radius, in->radius_b);
        params[0] = (in->radius / radius);
        params[1] = (in->radius_b / radius);
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

static matrix disc_frame(const struct brume_shape *in, double params[4])
{
    double n[3] = {in->b[0], in->b[1], in->b[2]};
    normalize(n);
    params[0] = (in->radius_b / in->radius);
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

/* The plane in which a polygon's corners lie: the frame of its first corner
 * and the widest turn between its sides. */
static bool polygon_frame(const struct brume_shape *in, matrix *frame)
{
    double best = 0.0, normal[3] = {0, 0, 0}, a[3], b[3], n[3];
    const double *p = in->data;
    for (size_t i = 1; i + 1 < in->count / 3; i++) {
        for (int k = 0; k < 3; k++) {
            a[k] = p[3 * i + (size_t)k] - p[k];
            b[k] = p[3 * i + 3 + (size_t)k] - p[k];
        }
        cross(a, b, n);
        double size = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        if (size > best) {
            best = size;
            for (int k = 0; k < 3; k++)
                normal[k] = n[k];
        }
    }
    if (!(best > 0.0))
        return false;
    normalize(normal);
    *frame = axis_frame(p, normal, 1.0);
    return true;
}

static bool make_polygon(const struct brume_shape *in, struct arena *arena,
                         struct leaf *out, matrix *local,
                         struct brume_error *err)
{
    matrix to_plane;
    size_t corners = in->count / 3;
    if (!polygon_frame(in, local) || !matrix_invert(local, &to_plane))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a polygon's corners lie on one line");
    if (!solid_alloc(arena, 1 + 2 * corners, &out->solid, err))
        return false;
    struct box b = box_empty();
    out->solid.data[0] = (double)corners;
    for (size_t i = 0; i < corners; i++) {
        double p[3];
        matrix_point(&to_plane, in->data + 3 * i, p);
        out->solid.data[1 + 2 * i] = p[0];
        out->solid.data[2 + 2 * i] = p[1];
        p[2] = 0.0;
        box_add(&b, p);
    }
    solid_bounds(&out->solid, b.lo[0], b.lo[1], 0, b.hi[0], b.hi[1], 0);
    out->kind = SOLID_POLYGON;
    out->flags |= SHAPE_THIN;
    return true;
}

/* The segments of one glyph of a text or of all; the number. */
static size_t text_segments(const struct brume_shape *in, size_t glyph,
                            double *out)
{
    size_t count = 0;
    for (size_t i = 0; i < in->count; i += 1 + 8 * (size_t)in->data[i]) {
        size_t segments = (size_t)in->data[i];
        if (glyph != LEAF_ALL && glyph != i)
            continue;
        memcpy(out + 8 * count, in->data + i + 1, 8 * segments * sizeof *out);
        count += segments;
    }
    return count;
}

/* A prism along z. */
static bool make_text(const struct leaf_request *r, struct arena *arena,
                      struct leaf *out, matrix *local, struct brume_error *err)
{
    static const double upright[3][4] = {
        {1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}};
    const struct brume_shape *in = r->shape;
    double *points = memory_new(in->count + 1, sizeof *points, err);
    if (!points)
        return false;
    size_t segments = text_segments(in, r->glyph, points);
    out->kind = SOLID_PRISM;
    *local = matrix_from(upright);
    bool good = solid_prism(arena, BRUME_CURVE_BEZIER, false, false, 0.0,
                            in->radius, points, 4 * segments, &out->solid, err);
    free(points);
    return good;
}

static bool make_solid(const struct leaf_request *r, struct arena *arena,
                       struct leaf *out, matrix *local, struct brume_error *err)
{
    const struct brume_shape *in = r->shape;
    struct solid *solid = &out->solid;
    switch (in->kind) {
    case BRUME_SHAPE_TORUS:
        out->kind = SOLID_TORUS;
        return solid_torus(arena, in->radius, in->radius_b, solid, err);
    case BRUME_SHAPE_QUADRIC:
        out->kind = SOLID_QUADRIC;
        return solid_quadric(arena, in->data, solid, err);
    case BRUME_SHAPE_POLY:
        out->kind = SOLID_POLY;
        if (in->order < 2 || in->order > 35 ||
            in->count != (size_t)solid_poly_terms(in->order))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "polynomial of order %d with %zu numbers",
                              in->order, in->count);
        return solid_poly(arena, in->order, in->data, solid, err);
    case BRUME_SHAPE_SUPERELLIPSOID:
        out->kind = SOLID_SUPERELLIPSOID;
        return solid_superellipsoid(arena, in->a[0], in->a[1], solid, err);
    case BRUME_SHAPE_OVUS:
        out->kind = SOLID_OVUS;
        return solid_ovus(arena, in->radius, in->radius_b, solid, err);
    case BRUME_SHAPE_BLOB:
        out->kind = SOLID_BLOB;
        return solid_blob(arena, in->radius, in->data,
                          in->count / BRUME_BLOB_NUMBERS, solid, err);
    case BRUME_SHAPE_TEXT:
        return make_text(r, arena, out, local, err);
    case BRUME_SHAPE_LATHE:
        out->kind = SOLID_LATHE;
        return solid_lathe(arena, in->curve, in->data, in->count / 2, solid,
                           err);
    case BRUME_SHAPE_PRISM:
        out->kind = SOLID_PRISM;
        out->flags |= in->open ? SHAPE_OPEN : 0;
        return solid_prism(arena, in->curve, in->conic, false, in->radius,
                           in->radius_b, in->data, in->count / 2, solid, err);
    case BRUME_SHAPE_SOR:
        out->kind = SOLID_SOR;
        out->flags |= in->open ? SHAPE_OPEN : 0;
        return solid_sor(arena, false, in->data, in->count / 2, solid, err);
    case BRUME_SHAPE_SPHERE_SWEEP:
        out->kind = SOLID_SPHERE_SWEEP;
        return solid_sphere_sweep(arena, in->curve, in->data, in->count / 4,
                                  solid, err);
    case BRUME_SHAPE_JULIA:
        out->kind = SOLID_JULIA;
        return solid_julia(arena, in->julia_kind, in->julia_function, in->order,
                           in->accuracy, in->data, solid, err);
    case BRUME_SHAPE_ISOSURFACE: {
        struct brume_shape closed = *in;
        closed.open = false;
        out->kind = SOLID_ISOSURFACE;
        out->flags |= in->open ? SHAPE_OPEN : 0;
        return solid_isosurface(arena, &closed, in->function[0], solid, err);
    }
    default:
        return make_polygon(in, arena, out, local, err);
    }
}

/* One of shape.h's: its canonical space in that of its parameters. */
static matrix make_shape(const struct brume_shape *in, struct leaf *out)
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
        out->flags |= in->open ? SHAPE_OPEN : 0;
        return cone_frame(in, out->params);
    case BRUME_SHAPE_CONE:
        out->kind = SHAPE_CONE;
        out->flags |= in->open ? SHAPE_OPEN : 0;
        return cone_frame(in, out->params);
    case BRUME_SHAPE_PLANE:
        out->kind = SHAPE_PLANE;
        out->flags |= SHAPE_ENDLESS;
        return plane_frame(in);
    default:
        out->kind = SHAPE_DISC;
        out->flags |= SHAPE_ENDLESS;
        return disc_frame(in, out->params);
    }
}

/* A half space across an axis is a box without end; others are endless. */
static struct box plane_bounds(const matrix *map)
{
    struct box out = box_endless();
    matrix inverse;
    if (!matrix_invert(map, &inverse))
        return out;
    const double *n = inverse.m[2]; /* p is inside: n p + n[3] < 0 */
    for (int i = 0; i < 3; i++)
        if (n[(i + 1) % 3] == 0.0 && n[(i + 2) % 3] == 0.0)
            *(n[i] > 0.0 ? &out.hi[i] : &out.lo[i]) = -n[3] / n[i];
    return out;
}

/* Bounds of one of shape.h's under its map. */
static struct box shape_bounds(int kind, const matrix *m)
{
    struct box out;
    if (kind == SHAPE_PLANE)
        return plane_bounds(m);
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
        out.lo[i] = centre - half;
        out.hi[i] = centre + half;
    }
    return out;
}

static struct box mesh_bounds(const struct mesh *m, const matrix *map)
{
    struct box out = box_empty();
    for (size_t i = 0; i < m->vertices; i++) {
        double p[3];
        matrix_point(map, m->position[i], p);
        box_add(&out, p);
    }
    return out;
}

static struct box solid_box(const struct solid *solid)
{
    struct box out = box_endless();
    for (int i = 0; solid->bounded && i < 3; i++) {
        out.lo[i] = solid->min[i];
        out.hi[i] = solid->max[i];
    }
    return out;
}

struct box leaf_bounds(const struct leaf *leaf, const matrix *map)
{
    if (leaf->kind == SHAPE_MESH)
        return mesh_bounds(leaf->mesh, map);
    if (leaf->kind <= SHAPE_DISC)
        return shape_bounds(leaf->kind, map);
    struct box own = solid_box(&leaf->solid);
    return box_transform(&own, map);
}

/* A surface_point of the shape's functions; NAN where they have no value. */
static void parametric_point(void *context, double u, double v, double p[3])
{
    const struct leaf_request *r = context;
    const double at[3] = {u, v, 0.0};
    for (int i = 0; i < 3; i++) {
        int id = r->shape->function[i], parameters, results;
        double out[BRUME_MAX_RESULTS];
        bool good = brume_function_arity(r->scene, id, &parameters, &results) &&
                    brume_eval_function(r->scene, id, at, parameters, out,
                                        NULL);
        p[i] = good ? out[0] : NAN;
    }
}

/* A mesh of the scene, or one that is made of the shape's numbers. */
static bool take_mesh(const struct leaf_request *r, struct leaf *out,
                      struct brume_error *err)
{
    const struct brume_shape *in = r->shape;
    const double *v = in->a, up[3] = {0.0, 1.0, 0.0};
    bool heights = in->kind == BRUME_SHAPE_HEIGHT_FIELD;
    if (heights)
        out->made = surface_heights(in, r->closed, &out->seen_triangles, err);
    else if (in->kind == BRUME_SHAPE_BICUBIC_PATCH)
        out->made = surface_patch(in, err);
    else if (in->kind == BRUME_SHAPE_PARAMETRIC)
        out->made = surface_parametric(in, parametric_point, (void *)r, err);
    out->mesh = in->kind == BRUME_SHAPE_MESH ? r->scene->meshes[in->mesh]
                                             : out->made;
    if (!out->mesh)
        return false;
    if (!heights)
        out->seen_triangles = out->mesh->triangles;
    out->kind = SHAPE_MESH;
    for (int i = 0; i < 3; i++)
        out->inside[i] = heights ? up[i] : v[i];
    if (in->kind == BRUME_SHAPE_BICUBIC_PATCH ||
        in->kind == BRUME_SHAPE_PARAMETRIC ||
        (r->closed && !heights && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0))
        out->flags |= SHAPE_THIN;
    out->map = *r->place;
    out->bounds = leaf_bounds(out, &out->map);
    return true;
}

static bool is_mesh(enum brume_shape_kind kind)
{
    return kind == BRUME_SHAPE_MESH || kind == BRUME_SHAPE_BICUBIC_PATCH ||
           kind == BRUME_SHAPE_HEIGHT_FIELD || kind == BRUME_SHAPE_PARAMETRIC;
}

bool leaf_make(const struct leaf_request *r, struct arena *arena,
               struct leaf *out, struct brume_error *err)
{
    const struct brume_shape *in = r->shape;
    matrix local = matrix_identity();
    *out = (struct leaf){.kind = SHAPE_MESH};
    if (is_mesh(in->kind))
        return take_mesh(r, out, err);
    if (in->kind < BRUME_SHAPE_MESH) {
        local = make_shape(in, out);
        out->map = matrix_compose(r->place, &local);
        out->bounds = leaf_bounds(out, &out->map);
        return true;
    }
    if (!make_solid(r, arena, out, &local, err))
        return false;
    out->map = matrix_compose(r->place, &local);
    out->bounds = leaf_bounds(out, &out->map);
    if (!out->solid.bounded)
        out->flags |= SHAPE_ENDLESS;
    return true;
}

void leaf_release(struct leaf *leaf)
{
    mesh_free(leaf->made);
    leaf->made = NULL;
}
