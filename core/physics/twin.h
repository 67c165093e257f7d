/* twin.h - fields and media at two points of one voxel.
 *
 * A line integral asks for two points between planes of voxels at once: of a
 * grid they read the same samples, so these are sought and fetched once. */
#ifndef CORE_PHYSICS_TWIN_H
#define CORE_PHYSICS_TWIN_H
#include "core/physics/medium.h"

typedef struct {
    float a, b;
} twin_float;

typedef struct {
    rgb a, b;
} twin_rgb;

/* Two points, most often in one voxel. */
typedef struct {
    field_point a, b;
    int32_t layout;         /* they are, of grids on the lead's lattice that
                               have this layout and interpolate; -1: of none */
    uint32_t brick, sample; /* that voxel, as of grid_spot                 */
    vec3 in_a, in_b;        /* the places from its corner on               */
} twin_point;

/* Whether a place within a voxel counts as in it: rounding at planes may put
 * it a little beyond. */
HD bool twin_within(vec3 at)
{
    const float lo = -0.001f, hi = 1.001f;
    return at.x >= lo && at.x <= hi && at.y >= lo && at.y <= hi &&
           at.z >= lo && at.z <= hi;
}

/* Of a medium: in its lead's grid, whose layout its others have most often. */
HD twin_point twin_point_of(const flat_scene *s, const flat_medium *m,
                            field_point a, field_point b)
{
    twin_point x;
    x.a = a;
    x.b = b;
    x.layout = -1;
    x.brick = x.sample = 0u;
    x.in_a = x.in_b = vec3_make(0.0f, 0.0f, 0.0f);
    if (m->lead < 0 || scene_lead(s, m)->kind != FIELD_GRID)
        return x;
    const flat_grid *g = scene_grid(s, scene_lead(s, m));
    if (g->nearest)
        return x;
    vec3 p = grid_from(g, a.index);
    grid_spot spot = grid_spot_of(g, p);
    x.brick = spot.brick;
    x.sample = spot.sample;
    x.in_a = vec3_sub(p, spot.corner);
    x.in_b = vec3_sub(grid_from(g, b.index), spot.corner);
    if (twin_within(x.in_b))
        x.layout = g->layout;
    return x;
}

/* Of a grid, at places of its index space. */
HD twin_float twin_grid(const flat_scene *s, const flat_grid *g, vec3 a,
                        vec3 b)
{
    twin_float out;
    vec3 at = grid_local(g, a);
    grid_spot spot = grid_spot_of(g, at);
    grid_voxel v = grid_voxel_at(s, g, spot.brick, spot.sample);
    out.a = out.b = v.value;
    if (v.stored) {
        vec3 next = vec3_sub(grid_local(g, b), spot.corner);
        out.a = grid_inside(g, &v, vec3_sub(at, spot.corner));
        out.b = twin_within(next) ? grid_inside(g, &v, next)
                                  : grid_lookup(s, g, b);
    }
    if (g->clip && grid_clipped(g, a))
        out.a = 0.0f;
    if (g->clip && grid_clipped(g, b))
        out.b = 0.0f;
    return out;
}

/* The same where they are in one voxel. */
HD twin_float twin_voxel(const flat_scene *s, const flat_grid *g,
                         const twin_point *x)
{
    twin_float out;
    grid_voxel v = grid_voxel_at(s, g, x->brick, x->sample);
    out.a = out.b = v.value;
    if (v.stored) {
        grid_eight c = grid_load(v.sample);
        out.a = grid_trilinear(&c, x->in_a);
        out.b = grid_trilinear(&c, x->in_b);
    }
    return out;
}

HD_SHARED twin_float twin_apart(const flat_scene *s, const flat_field *f,
                                field_point a, field_point b)
{
    twin_float out;
    out.a = out.b = f->scale;
    if (f->kind == FIELD_CONSTANT)
        return out;
    out = twin_grid(s, scene_grid(s, f), field_index(f, &a),
                    field_index(f, &b));
    out.a *= f->scale;
    out.b *= f->scale;
    return out;
}

/* Whether the points' voxel is one of a field that is no function. */
HD bool twin_fits(const flat_scene *s, const flat_field *f, const twin_point *x)
{
    if (f->kind == FIELD_CONSTANT || !field_shares(f, &x->a))
        return false;
    const flat_grid *g = scene_grid(s, f);
    return x->layout == g->layout && !g->clip;
}

/* Of a field that is none, see field_is_function. */
HD twin_float twin_plain(const flat_scene *s, const flat_field *f,
                         const twin_point *x)
{
    if (!twin_fits(s, f, x))
        return twin_apart(s, f, x->a, x->b);
    twin_float out = twin_voxel(s, scene_grid(s, f), x);
    out.a *= f->scale;
    out.b *= f->scale;
    return out;
}

/* The product of the medium's densities but for the first, times d. */
HD_SHARED twin_float twin_others(const flat_scene *s, const flat_medium *m,
                                 field_point a, field_point b, twin_float d)
{
    for (int i = 1; i < m->densities && (d.a != 0.0f || d.b != 0.0f); i++) {
        twin_float f = twin_apart(s, scene_density(s, m, i), a, b);
        d.a *= f.a;
        d.b *= f.b;
    }
    return d;
}

/* As field_eval. */
HD twin_float twin_eval(const flat_scene *s, const flat_field *f,
                        const twin_point *x)
{
    twin_float out;
    if (!field_is_function(f))
        return twin_plain(s, f, x);
    out.a = field_color(s, f, &x->a).r;
    out.b = field_color(s, f, &x->b).r;
    return out;
}

/* As medium_density. */
HD twin_rgb twin_density(const flat_scene *s, const flat_medium *m,
                         const twin_point *x)
{
    twin_rgb out;
    twin_float d;
    if (scene_may(MAY_FUNCTIONS) && m->functions) {
        out.a = medium_density(s, m, &x->a);
        out.b = medium_density(s, m, &x->b);
        return out;
    }
    d.a = d.b = 1.0f;
    if (m->densities > 0)
        d = twin_plain(s, scene_density(s, m, 0), x);
    if (m->densities > 1)
        d = twin_others(s, m, x->a, x->b, d);
    out.a = rgb_gray(hd_min(d.a, m->densest));
    out.b = rgb_gray(hd_min(d.b, m->densest));
    return out;
}

/* As medium_source. */
HD twin_rgb twin_source(const flat_scene *s, const flat_medium *m,
                        const twin_point *x, const twin_rgb *density)
{
    twin_rgb out;
    twin_float amount, kelvin;
    out.a = rgb_mul(m->emission, density->a);
    out.b = rgb_mul(m->emission, density->b);
    if (!m->fire || (!m->additive && rgb_is_black(density->a) &&
                     rgb_is_black(density->b)))
        return out;
    amount.a = amount.b = 1.0f;
    if (m->amount >= 0)
        amount = twin_eval(s, scene_amount(s, m), x);
    if (amount.a == 0.0f && amount.b == 0.0f)
        return out;
    kelvin = twin_eval(s, scene_temperature(s, m), x);
    out.a = rgb_add(out.a, fire_light(s, m, density->a, amount.a, kelvin.a));
    out.b = rgb_add(out.b, fire_light(s, m, density->b, amount.b, kelvin.b));
    return out;
}

#endif
