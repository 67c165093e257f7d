/* field.h - fields at a point: constants, grids, and functions by the
 * byte-code machine. */
#ifndef CORE_PHYSICS_FIELD_H
#define CORE_PHYSICS_FIELD_H
#include "core/physics/grid.h"
#include "core/physics/scene_machine.h"

/* A point, and its place in the lattice that the fields around it share. */
typedef struct {
    vec3 p;                 /* unit space                                  */
    vec3 index;
    int32_t lattice;        /* whose index space; -1: none                 */
} field_point;

/* In the index space of the field `lead`; NULL: in none. */
HD field_point field_point_of(const flat_field *lead, vec3 p)
{
    field_point x;
    x.p = x.index = p;
    x.lattice = -1;
    if (lead) {
        x.index = affine_point(&lead->to_index, p);
        x.lattice = lead->lattice;
    }
    return x;
}

/* `lead` is a field with an index space, or -1. */
HD field_point field_point_make(const flat_scene *s, int32_t lead, vec3 p)
{
    return field_point_of(lead >= 0 ? &s->fields[lead] : 0, p);
}

/* In that of a medium's lead. */
HD field_point medium_point(const flat_scene *s, const flat_medium *m, vec3 p)
{
    return field_point_of(m->lead >= 0 ? scene_lead(s, m) : 0, p);
}

/* Whether its index space is that of the point's lattice: a medium's grids are
 * all on its lead's, unless scenes hold more. */
HD bool field_shares(const flat_field *f, const field_point *x)
{
    return !scene_may(MAY_MANY | MAY_FUNCTIONS) || f->lattice == x->lattice;
}

HD vec3 field_index(const flat_field *f, const field_point *x)
{
    return field_shares(f, x) ? x->index : affine_point(&f->to_index, x->p);
}

/* What is no positive number counts as 0. */
HD float field_positive(real v)
{
    return v > REAL(0.0) && v < (real)INFINITY ? (float)v : 0.0f;
}

/* Value of a function at a point of its index space. */
HD_APART rgb field_procedure(const flat_scene *s, const flat_procedure *f,
                             vec3 index)
{
    real r[MACHINE_REGISTERS];
    machine code = scene_machine(s);
    r[0] = (real)(f->origin[0] + f->step[0] * index.x);
    r[1] = (real)(f->origin[1] + f->step[1] * index.y);
    r[2] = (real)(f->origin[2] + f->step[2] * index.z);
    if (!machine_run(&code, f->function, r))
        return rgb_gray(0.0f);
    if (f->component >= 0)
        return rgb_gray(field_positive(r[f->component]));
    return rgb_make(field_positive(r[0]), field_positive(r[1]),
                    field_positive(r[2]));
}

/* Whether it is evaluated, or has a colour. */
HD bool field_is_function(const flat_field *f)
{
    return scene_may(MAY_FUNCTIONS) &&
           (f->kind == FIELD_FUNCTION || f->colored);
}

/* Value of a field that is none. */
HD float field_plain(const flat_scene *s, const flat_field *f,
                     const field_point *x)
{
    if (f->kind == FIELD_CONSTANT)
        return f->scale;
    return f->scale * grid_lookup(s, scene_grid(s, f), field_index(f, x));
}

HD rgb field_color(const flat_scene *s, const flat_field *f,
                   const field_point *x)
{
    vec3 at = field_index(f, x);
    if (f->kind == FIELD_FUNCTION)
        return rgb_scale(field_procedure(s, &s->procedures[f->grid], at),
                         f->scale);
    const flat_grid *g = &s->grids[f->grid];
    return rgb_scale(rgb_make(grid_lookup(s, g, at),
                              grid_lookup(s, g + 1, at),
                              grid_lookup(s, g + 2, at)), f->scale);
}

/* Value of a field that is no colour. */
HD float field_eval(const flat_scene *s, const flat_field *f,
                    const field_point *x)
{
    return field_is_function(f) ? field_color(s, f, x).r
                                 : field_plain(s, f, x);
}

#endif
