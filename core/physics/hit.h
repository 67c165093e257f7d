/* hit.h - what a ray finds at a hit: position, normals, material, pigment. */
#ifndef CORE_PHYSICS_HIT_H
#define CORE_PHYSICS_HIT_H
#include "core/physics/bvh.h"
#include "core/physics/scene_machine.h"
#include "core/physics/surface.h"

typedef struct {
    vec3 p;
    vec3 ng, ns;            /* geometric and shading normals, unit, on the
                               side that the ray comes from                */
    rgb color;              /* pigment                                     */
    float opacity;          /* 1 - filter - transmit, in [0, 1]            */
    rgb pass;               /* filter color + transmit                     */
    const flat_material *material;
} hit_point;

HD vec3 hit_position(const flat_scene *s, const bvh_ray *r, const ray_hit *h)
{
    if (!scene_may(MAY_MESHES) || h->triangle < 0)
        return vec3_mad(r->o, h->t, r->d);
    /* Barycentric: closer to the triangle than the ray is at a far hit. */
    const flat_triangle *f = &s->triangles[h->triangle];
    vec3 p = vec3_scale(f->p[0], 1.0f - h->u - h->v);
    p = vec3_mad(p, h->u, f->p[1]);
    return vec3_mad(p, h->v, f->p[2]);
}

HD void hit_triangle_normals(const flat_scene *s, const ray_hit *h,
                             vec3 *ng, vec3 *ns)
{
    const flat_triangle *f = &s->triangles[h->triangle];
    *ng = vec3_normalize(vec3_cross(vec3_sub(f->p[1], f->p[0]),
                                    vec3_sub(f->p[2], f->p[0])));
    *ns = *ng;
    if (f->smooth < 0)
        return;
    const vec3 *n = s->normals + f->smooth;
    vec3 mean = vec3_scale(n[0], 1.0f - h->u - h->v);
    mean = vec3_mad(mean, h->u, n[1]);
    mean = vec3_normalize(vec3_mad(mean, h->v, n[2]));
    if (vec3_dot(mean, mean) > 0.0f)
        *ns = mean;
}

/* A solid's point is found anew, in double: a float's distance is too far
 * off for some normals. */
HD vec3 hit_solid_normal(const flat_scene *s, const flat_shape *f,
                         const bvh_ray *r, const ray_hit *h)
{
    const double *m = s->numbers + f->number;
    double t[SOLID_MAX_ROOTS];
    int part[SOLID_MAX_ROOTS];
    leaf_solid_roots(s, f, r, t, part);
    dvec3 o = leaf_solid_point(m, real3_double(r->o));
    dvec3 d = leaf_solid_vector(m, real3_double(r->d));
    dvec3 p = dvec3_mad(o, t[h->root], d);
    dvec3 n = leaf_solid_side(s, f, p, part[h->root]);
    return vec3_make((float)n.x, (float)n.y, (float)n.z);
}

HD vec3 hit_shape_normal(const flat_scene *s, const bvh_ray *r,
                         const ray_hit *h)
{
    const flat_shape *f = &s->shapes[h->shape];
    if (leaf_is_solid(f))
        return hit_solid_normal(s, f, r, h);
    vec3 local = vec3_mad(leaf_point(s, f, r->o), h->t,
                          leaf_vector(s, f, r->d));
    vec3 n = shape_normal(f->kind, f->params, local, h->surface);
    return vec3_normalize(leaf_normal(s, f, n));
}

/* The material of what is seen at the hit, or -1. */
HD int32_t hit_material(const flat_scene *s, const ray_hit *h)
{
    bool seen = scene_may(MAY_SURFACES) && h->seen;
    return seen ? s->shapes[h->shape].material : -1;
}

/* A pigment at a point: the light that goes back takes `color`, what comes
 * through filter color + transmit. */
typedef struct {
    rgb color;
    float filter, transmit;
} hit_color;

HD_APART hit_color hit_pattern(const flat_scene *s, const flat_material *m,
                               vec3 p)
{
    float r[MACHINE_REGISTERS];
    machine code = scene_machine(s);
    hit_color out;
    vec3 q = affine_point(&m->to_pattern, p);
    r[0] = q.x;
    r[1] = q.y;
    r[2] = q.z;
    machine_run(&code, m->function, r);
    for (int i = 0; i < 5; i++)
        r[i] = fabsf(r[i]) < 1e30f ? r[i] : 0.0f;
    out.color = rgb_make(r[0], r[1], r[2]);
    out.filter = r[3];
    out.transmit = r[4];
    return out;
}

HD hit_color hit_pigment(const flat_scene *s, const flat_material *m, vec3 p)
{
    hit_color out;
    if (scene_may(MAY_FUNCTIONS) && m->function >= 0)
        return hit_pattern(s, m, p);
    int i = m->checker ? surface_checker(affine_point(&m->to_pattern, p)) : 0;
    out.color = m->color[i];
    out.filter = m->filter[i];
    out.transmit = m->transmit[i];
    return out;
}

HD rgb hit_pass(const hit_color *c)
{
    return rgb_add(rgb_scale(c->color, c->filter), rgb_gray(c->transmit));
}

/* Of one colour, or a checker of two, and nothing passes either. */
HD bool hit_is_opaque(const flat_material *m)
{
    return m->function < 0 && m->filter[0] == 0.0f && m->transmit[0] == 0.0f &&
           m->filter[1] == 0.0f && m->transmit[1] == 0.0f;
}

HD rgb hit_transparency(const flat_scene *s, const bvh_ray *r,
                        const ray_hit *h)
{
    const flat_material *m = &s->materials[s->shapes[h->shape].material];
    if (hit_is_opaque(m))
        return rgb_gray(0.0f);
    hit_color c = hit_pigment(s, m, hit_position(s, r, h));
    return hit_pass(&c);
}

/* The hit's shape has a material. */
HD hit_point hit_resolve(const flat_scene *s, const bvh_ray *r,
                         const ray_hit *h)
{
    hit_point out;
    const flat_material *m = &s->materials[s->shapes[h->shape].material];
    out.material = m;
    out.p = hit_position(s, r, h);
    if (scene_may(MAY_MESHES) && h->triangle >= 0)
        hit_triangle_normals(s, h, &out.ng, &out.ns);
    else
        out.ng = out.ns = hit_shape_normal(s, r, h);
    if (vec3_dot(out.ng, r->d) > 0.0f)
        out.ng = vec3_scale(out.ng, -1.0f);
    if (vec3_dot(out.ns, out.ng) < 0.0f)
        out.ns = vec3_scale(out.ns, -1.0f);
    hit_color c = hit_pigment(s, m, out.p);
    out.color = c.color;
    out.opacity = hd_min(hd_max(1.0f - c.filter - c.transmit, 0.0f), 1.0f);
    out.pass = hit_pass(&c);
    return out;
}

#endif
