/* track.h - transmittance of media along a ray by ratio tracking.
 *
 * Unbiased in any density (Cramer 1978; Novak et al. 2014): the product over
 * tentative collisions, drawn against the majorant of the widest channel, of
 * 1 - sigma_t / majorant. Homogeneous media are taken out of the draw and come
 * in exactly. */
#ifndef CORE_PHYSICS_TRACK_H
#define CORE_PHYSICS_TRACK_H
#include "core/physics/fmath.h"
#include "core/physics/rng.h"
#include "core/physics/walk.h"

/* What is counted; `rejected` are samples that were not finite. */
#define TRACK_COUNTERS(X)                                                     \
    X(paths) X(rays) X(shadow_rays) X(collisions) X(lookups)                  \
    X(majorant_exceeded) X(overflow) X(rejected)

/* A GPU's threads count a launch each, in registers. */
#ifdef __CUDACC__
typedef uint32_t track_count;
#else
typedef uint64_t track_count;
#endif

typedef struct {
#define X(name) track_count name;
    TRACK_COUNTERS(X)
#undef X
} track_counters;

/* Attenuation of all homogeneous media of the walk: it is constant. */
HD rgb track_uniform(const flat_scene *s, const media_walk *w)
{
    rgb sum = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (m->uniform)
            sum = rgb_add(sum, rgb_scale(m->sigma_t, m->outside.density));
    }
    return sum;
}

/* Whether any medium of the walk takes light away, and any unevenly. */
HD bool track_attenuates(const flat_scene *s, const media_walk *w,
                         bool *uneven)
{
    bool some = false;
    *uneven = false;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        bool takes = !rgb_is_black(m->sigma_t);
        some = some || takes;
        *uneven = *uneven || (takes && !m->uniform);
    }
    return some;
}

/* Majorant of the others over the current piece. */
HD float track_majorant(const flat_scene *s, const media_walk *w)
{
    rgb sum = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (!m->uniform)
            sum = rgb_add(sum, rgb_scale(m->sigma_t,
                                         walk_part(w, i)->bound.density));
    }
    return rgb_max(sum);
}

HD rgb track_sigma_t(const flat_scene *s, const media_walk *w, vec3 p,
                     float t)
{
    rgb sum = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (m->uniform || walk_part(w, i)->bound.density == 0.0f)
            continue;
        field_point x = lattice_point(s, walk_part(w, i), p, t);
        sum = rgb_add(sum, rgb_mul(m->sigma_t, medium_density(s, m, &x)));
    }
    return sum;
}

/* One tentative collision; false when the product is dead. Beyond a majorant
 * that does not hold it changes its sign: still unbiased. */
HD bool track_collide(const flat_scene *s, const media_walk *w, vec3 p,
                      float t, float majorant, rng *r, rgb *product,
                      track_counters *c)
{
    rgb sigma = track_sigma_t(s, w, p, t);
    c->lookups++;
    if (rgb_max(sigma) > majorant * 1.00001f)
        c->majorant_exceeded++;
    rgb keep = rgb_sub(rgb_gray(1.0f), rgb_scale(sigma, 1.0f / majorant));
    *product = rgb_mul(*product, keep);
    float left = rgb_size(*product);
    if (left >= 0.1f)
        return true;
    if (!(left > 0.0f))
        return false;
    /* Roulette: a dim ray ends, or goes on as if its product were 0.1. */
    float survive = left / 0.1f;
    if (!rng_chance(r, survive))
        return false;
    *product = rgb_scale(*product, 1.0f / survive);
    return true;
}

HD_APART rgb track_media(const flat_scene *s, const container_set *set,
                         bool atmosphere, vec3 o, vec3 d, float t0, float t1,
                         rng *r, track_counters *c)
{
    media_walk w;
    walk_begin(s, &w, set, atmosphere, o, d, t0, t1);
    c->overflow += w.overflow;
    rgb product = rgb_gray(1.0f);
    bool uneven;
    if (!track_attenuates(s, &w, &uneven))
        return product;
    rgb uniform = rgb_scale(track_uniform(s, &w), -(t1 - t0));
    float tau = uneven ? rng_optical_depth(r) : 0.0f;
    do {
        float majorant = track_majorant(s, &w);
        if (!(majorant > 0.0f))
            continue;
        float t = w.t;
        for (;;) {
            float left = majorant * (w.t_end - t);
            if (!(tau < left)) {
                tau -= left;
                break;
            }
            t += tau / majorant;
            tau = rng_optical_depth(r);
            if (!track_collide(s, &w, vec3_mad(o, t, d), t, majorant, r,
                               &product, c))
                return rgb_gray(0.0f);
        }
    } while (uneven && walk_next(s, &w));
    return rgb_mul(product, rgb_make(fm_exp(uniform.r), fm_exp(uniform.g),
                                     fm_exp(uniform.b)));
}

/* Unbiased transmittance from t0 to t1 through the media of `set`. */
HD rgb track_transmittance(const flat_scene *s, const container_set *set,
                           bool atmosphere, vec3 o, vec3 d, float t0,
                           float t1, rng *r, track_counters *c)
{
    HD_COPY(container_set, set);
    HD_COPY(rng, r);
    rgb left = track_media(s, HD_COPIED(set), atmosphere, o, d, t0, t1,
                           HD_COPIED(r), c);
    HD_RETURN(r);
    return left;
}

#endif
