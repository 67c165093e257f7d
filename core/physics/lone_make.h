/* lone_make.h - whether a scene is one even medium in one container and nothing
 * else, and what is alike for all of its photons (photon_lone.h). */
#ifndef CORE_PHYSICS_LONE_MAKE_H
#define CORE_PHYSICS_LONE_MAKE_H
#include "core/physics/lone_scene.h"
#include "core/physics/photon.h"

/* Of all shapes the first is a ball or a box with one medium, and the others
 * are places of composites that are none. */
HD bool lone_has_container(const flat_scene *s)
{
    if (s->shapes_count == 0 || s->triangles_count > 0 || s->atmosphere >= 0)
        return false;
    for (uint64_t i = 1; i < s->shapes_count; i++)
        if (s->shapes[i].kind != SHAPE_MESH || s->shapes[i].interior >= 0)
            return false;
    const flat_shape *f = &s->shapes[0];
    return (f->kind == SHAPE_SPHERE || f->kind == SHAPE_BOX) &&
           (f->flags & ~SHAPE_NO_SHADOW) == SHAPE_HOLLOW &&
           f->container == 0 && f->material < 0 && f->interior >= 0 &&
           s->interiors[f->interior].count == 1;
}

/* Room for the rounding of places, in the container's own space. */
HD float lone_deep_limit(const affine *to_local)
{
    float most = 0.0f;
    for (int i = 0; i < 3; i++) {
        const float *m = to_local->m + 4 * i;
        most = hd_max(most, LONE_NEAR * (fabsf(m[0]) + fabsf(m[1]) +
                                         fabsf(m[2])) + fabsf(m[3]));
    }
    return 1.0f - (1e-4f + 1e-6f * most);
}

/* The medium's constants, by the functions that else ask for them at each
 * collision; false: it is not of the kind. */
HD bool lone_make_medium(const flat_scene *s, lone_scene *l)
{
    container_set inside;
    media_walk w;
    path_state p;
    path_point at;
    track_counters count;
    vec3 o = vec3_make(0.0f, 0.0f, 0.0f), d = vec3_make(0.0f, 0.0f, 1.0f);
    count.lookups = 0;
    p.o = o;
    p.d = d;
    p.straight = 1;
    p.count = &count;
    inside.count = 1;
    inside.lost = 0;
    inside.shape[0] = 0;
    walk_begin(s, &w, &inside, true, o, d, 0.0f, 1.0f);
    rgb majorant = path_majorant(s, &w, false);
    path_point_at(s, &p, &w, 0.0f, majorant, &at);
    float drawn = at.all_a.r + at.all_s.r;
    float chance = fabsf(majorant.r - drawn);
    l->driver = majorant.r;
    l->per_driver = 1.0f / majorant.r;
    l->sigma_s = at.all_s.r;
    l->sigma_a = at.all_a.r;
    l->ratio = at.all_s.r * (1.0f / at.all_s.r);
    l->nulls = chance > 0.0f;
    l->null_beta = (majorant.r - at.all_t.r) * (1.0f / chance);
    l->null_r = chance * (1.0f / chance);
    return w.count == 1 && count.lookups == 1 && l->driver > 0.0f &&
           l->sigma_s > 0.0f && !(drawn - majorant.r * 1.00001f > 0.0f);
}

/* Whether a cell's number has 31 bits, and its place 16 along each axis. */
HD bool lone_has_room(const flat_scene *s)
{
    const radiance_lattice *f = &s->field;
    for (int i = 0; i < 3; i++)
        if (f->bricks[i] > 4095)
            return false;
    return s->radiance_count / 2147483647u < (uint64_t)f->numbers;
}

/* Whether the lattice of the field holds the container. */
HD bool lone_is_covered(const flat_scene *s)
{
    const radiance_lattice *f = &s->field;
    for (int i = 0; i < 3; i++) {
        float end = f->origin[i] + (float)(8 * f->bricks[i]) * f->side;
        float slack = 1e-5f * (end - f->origin[i]);
        if (!(f->origin[i] <= s->reach.lo[i] + slack &&
              end >= s->reach.hi[i] - slack))
            return false;
    }
    return true;
}

/* The phase function's constants, as phase_hg_eval has them. */
HD void lone_make_law(const flat_scene *s, lone_scene *l)
{
    const radiance_lattice *f = &s->field;
    float g = f->g[0];
    l->peaked = f->eye >= 0 && f->fluence < 0 && f->flux < 0 &&
                f->phase[0] == PHASE_HENYEY_GREENSTEIN && g >= 0.0f;
    l->law[0] = (1.0f - g) * (1.0f - g);
    l->law[1] = 2.0f * g;
    l->law[2] = WARP_INV_4PI * (1.0f - g) * (1.0f + g);
}

/* Whether the scene, of one gray medium, is of the kind; `seed` and `frame` are
 * those of photons. */
HD bool lone_make(const flat_scene *s, uint64_t seed, uint32_t frame,
                  lone_scene *l)
{
    if (!lone_has_container(s) || s->media_count != 1 || s->field.ball)
        return false;
    if (s->field.refined || !lone_has_room(s))
        return false;
    rng r = rng_make(seed, frame, PHOTON_PASS, 0);
    const flat_shape *f = &s->shapes[0];
    l->to_local = f->to_local;
    l->ball = f->kind == SHAPE_SPHERE;
    l->deep = lone_deep_limit(&l->to_local);
    l->key[0] = r.key[0];
    l->key[1] = r.key[1];
    for (uint32_t i = 0; i < RNG_ROUNDS; i++) {
        l->round_key[2 * i] = r.key[0] + i * RNG_STEP0;
        l->round_key[2 * i + 1] = r.key[1] + i * RNG_STEP1;
    }
    l->per_side = 1.0f / s->field.side;
    l->covered = lone_is_covered(s);
    lone_make_law(s, l);
    l->medium = s->media[0];
    return l->deep > 0.5f && l->medium.uniform && lone_make_medium(s, l);
}

#endif
