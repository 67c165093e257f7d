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

typedef struct {
    field_point a, b;
} twin_point;

/* Whether a place within a voxel counts as in it: rounding at planes may put
 * it a little beyond. */
HD bool twin_within(vec3 at)
{
    const float lo = -0.001f, hi = 1.001f;
    return at.x >= lo && at.x <= hi && at.y >= lo && at.y <= hi &&
           at.z >= lo && at.z <= hi;
}

HD_APART float twin_apart(const flat_scene *s, const flat_grid *g, vec3 p)
{
    return grid_lookup(s, g, p);
}

/* Of a grid, at places of its index space. */
HD twin_float twin_grid(const flat_scene *s, const flat_grid *g, vec3 a,
                        vec3 b)
{
    twin_float out;
    vec3 at = grid_local(g, a);
    grid_voxel v = grid_voxel_at(s, g, at);
    out.a = out.b = v.value;
    if (v.sample) {
        vec3 next = vec3_sub(grid_local(g, b), v.corner);
        out.a = grid_inside(g, &v, vec3_sub(at, v.corner));
        out.b = twin_within(next) ? grid_inside(g, &v, next)
                                  : twin_apart(s, g, b);
    }
    if (g->clip && grid_clipped(g, a))
        out.a = 0.0f;
    if (g->clip && grid_clipped(g, b))
        out.b = 0.0f;
    return out;
}

/* Of a field that is none, see field_is_function. */
HD twin_float twin_plain(const flat_scene *s, const flat_field *f,
                         const twin_point *x)
{
    twin_float out;
    out.a = out.b = f->scale;
    if (f->kind == FIELD_CONSTANT)
        return out;
    out = twin_grid(s, scene_grid(s, f), field_index(f, &x->a),
                    field_index(f, &x->b));
    out.a *= f->scale;
    out.b *= f->scale;
    return out;
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
    d.a = d.b = 1.0f;
    if (scene_may(MAY_FUNCTIONS) && m->functions) {
        out.a = medium_density(s, m, &x->a);
        out.b = medium_density(s, m, &x->b);
        return out;
    }
    for (int i = 0; i < m->densities && (d.a != 0.0f || d.b != 0.0f); i++) {
        twin_float f = twin_plain(s, scene_density(s, m, i), x);
        d.a *= f.a;
        d.b *= f.b;
    }
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
