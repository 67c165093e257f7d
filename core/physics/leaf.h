/* leaf.h - one primitive on a line: its roots, whatever it is made of, and
 * whether the line is inside of it behind some of them.
 *
 * Floats render shapes, doubles solids; where this is compiled in double
 * (queries), both are in double. */
#ifndef CORE_PHYSICS_LEAF_H
#define CORE_PHYSICS_LEAF_H
#include "core/physics/isosurface.h"
#include "core/physics/ray.h"
#include "core/physics/shape.h"
#include "core/physics/solids.h"

enum { SHAPE_MESH = 100, SHAPE_COMPOSITE };
enum { LEAF_MAX_ROOTS = (SCENE_MAY & MAY_SOLIDS) ? (int)SOLID_MAX_ROOTS
                                                 : (int)SHAPE_MAX_ROOTS };

HD bool leaf_is_solid(const flat_shape *f)
{
    return scene_may(MAY_SOLIDS) && f->kind >= SOLID_FIRST &&
           f->kind < SHAPE_MESH;
}

HD dvec3 leaf_solid_point(const double *m, dvec3 p)
{
    return dvec3_make(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                      m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                      m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
}

HD dvec3 leaf_solid_vector(const double *m, dvec3 v)
{
    return dvec3_make(m[0] * v.x + m[1] * v.y + m[2] * v.z,
                      m[4] * v.x + m[5] * v.y + m[6] * v.z,
                      m[8] * v.x + m[9] * v.y + m[10] * v.z);
}

HD dvec3 leaf_solid_normal(const double *m, dvec3 n)
{
    return dvec3_make(m[0] * n.x + m[4] * n.y + m[8] * n.z,
                      m[1] * n.x + m[5] * n.y + m[9] * n.z,
                      m[2] * n.x + m[6] * n.y + m[10] * n.z);
}

#ifdef PHYSICS_DOUBLE
HD real3 leaf_point(const flat_scene *s, const flat_shape *f, real3 p)
{
    return leaf_solid_point(s->numbers + f->number, p);
}

HD real3 leaf_vector(const flat_scene *s, const flat_shape *f, real3 v)
{
    return leaf_solid_vector(s->numbers + f->number, v);
}

HD real3 leaf_normal(const flat_scene *s, const flat_shape *f, real3 n)
{
    return leaf_solid_normal(s->numbers + f->number, n);
}

HD const real *leaf_params(const flat_scene *s, const flat_shape *f)
{
    return s->numbers + f->number + NUMBERS_MAP;
}
#else
HD real3 leaf_point(const flat_scene *s, const flat_shape *f, real3 p)
{
    (void)s;
    return affine_point(&f->to_local, p);
}

HD real3 leaf_vector(const flat_scene *s, const flat_shape *f, real3 v)
{
    (void)s;
    return affine_vector(&f->to_local, v);
}

HD real3 leaf_normal(const flat_scene *s, const flat_shape *f, real3 n)
{
    (void)s;
    return affine_normal(&f->to_local, n);
}

HD const real *leaf_params(const flat_scene *s, const flat_shape *f)
{
    (void)s;
    return f->params;
}
#endif

/* Roots of a solid in double, as they are found. */
HD int leaf_solid_roots(const flat_scene *s, const flat_shape *f,
                        const bvh_ray *r, double t[SOLID_MAX_ROOTS],
                        int part[SOLID_MAX_ROOTS])
{
    const double *m = s->numbers + f->number, *data = m + NUMBERS_MAP;
    dvec3 o = leaf_solid_point(m, real3_double(r->o));
    dvec3 d = leaf_solid_vector(m, real3_double(r->d));
    return f->kind == SOLID_ISOSURFACE
               ? isosurface_roots(s, data, o, d, t, part, SOLID_MAX_ROOTS)
               : solid_roots(f->kind, data, o, d, t, part);
}

/* Normal of a solid in the space of rays, unit, at a point of its own. */
HD dvec3 leaf_solid_side(const flat_scene *s, const flat_shape *f, dvec3 p,
                         int part)
{
    const double *m = s->numbers + f->number, *data = m + NUMBERS_MAP;
    dvec3 n = f->kind == SOLID_ISOSURFACE
                  ? isosurface_normal(s, data, p, part)
                  : solid_normal(f->kind, data, p, part);
    n = leaf_solid_normal(m, n);
    double length = dvec3_length(n);
    return dvec3_scale(n, length > 0.0 ? 1.0 / length : 0.0);
}

HD int leaf_rounded_roots(const flat_scene *s, const flat_shape *f,
                          const bvh_ray *r, real *t, int *part)
{
    double u[SOLID_MAX_ROOTS];
    int n = leaf_solid_roots(s, f, r, u, part);
    for (int i = 0; i < n; i++)
        t[i] = (real)u[i];
    return n;
}

/* All roots of a primitive along the ray's line, ascending. */
HD int leaf_roots(const flat_scene *s, const flat_shape *f, const bvh_ray *r,
                  real t[LEAF_MAX_ROOTS], int part[LEAF_MAX_ROOTS])
{
    if (!leaf_is_solid(f))
        return shape_roots(f->kind, leaf_params(s, f), leaf_point(s, f, r->o),
                           leaf_vector(s, f, r->d), t, part);
    return leaf_rounded_roots(s, f, r, t, part);
}

/* Whether the point is inside; not of a mesh. */
HD bool leaf_inside(const flat_scene *s, const flat_shape *f, real3 p)
{
    if (f->flags & SHAPE_THIN)
        return false;
    if (!leaf_is_solid(f)) {
        int kind = f->kind == SHAPE_DISC ? SHAPE_PLANE : f->kind;
        return shape_inside(kind, leaf_params(s, f), leaf_point(s, f, p));
    }
    const double *m = s->numbers + f->number, *data = m + NUMBERS_MAP;
    dvec3 q = leaf_solid_point(m, real3_double(p));
    return f->kind == SOLID_ISOSURFACE ? isosurface_inside(s, data, q)
                                       : solid_inside(f->kind, data, q);
}

/* Whether the line is inside before all of its n roots, at t = -infinity. */
HD bool leaf_inside_first(const flat_scene *s, const flat_shape *f,
                          const bvh_ray *r, const real *t, int n)
{
    if (!(f->flags & SHAPE_ENDLESS))
        return false;
    if (n == 0)
        return leaf_inside(s, f, r->o);
    if (f->kind == SHAPE_PLANE || f->kind == SHAPE_DISC)
        return leaf_vector(s, f, r->d).z > 0;
    real far = t[0] - real_max(1, real_abs(t[0]));
    return leaf_inside(s, f, real3_mad(r->o, far, r->d));
}

/* Whether the line is inside behind (t, key), by its roots alone: what roots
 * make it enter makes it leave, whatever the rounding. `item` is the shape's.
 * The half space below a disc is taken as its inside, as in POV-Ray. */
HD bool leaf_state(const flat_scene *s, int32_t item, const bvh_ray *r,
                   real t, uint64_t key)
{
    const flat_shape *f = &s->shapes[item];
    real root[LEAF_MAX_ROOTS];
    int part[LEAF_MAX_ROOTS];
    if (f->flags & SHAPE_THIN)
        return false;
    flat_shape plane;
    if (f->kind == SHAPE_DISC) {
        plane = *f;
        plane.kind = SHAPE_PLANE;
        f = &plane;
    }
    int n = leaf_roots(s, f, r, root, part), passed = 0;
    while (passed < n &&
           (root[passed] < t ||
            (root[passed] == t &&
             ray_key((uint64_t)item, passed) <= key)))
        passed++;
    return leaf_inside_first(s, f, r, root, n) != ((passed & 1) != 0);
}

#endif
