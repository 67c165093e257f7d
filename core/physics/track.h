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

/* A line through media: the piece where it is, and how far it has come. */
typedef struct {
    media_walk walk;
    float t;
    float tau;              /* optical depth to the next tentative collision */
    float majorant;         /* ... by which it is drawn in this piece      */
} track_line;

/* On to the next tentative collision, or, false, to the end of the piece. */
HD bool track_advance(track_line *l, float *step)
{
    float left = l->majorant * (l->walk.t_end - l->t);
    bool collides = l->tau < left;
    *step = collides ? l->tau / l->majorant : l->walk.t_end - l->t;
    l->t += *step;
    if (!collides)
        l->tau -= left;
    return collides;
}

/* What media hold at a tentative collision, as far as they may hold something
 * there. */
typedef struct {
    rgb density[MAX_ACTIVE];
    field_point at[MAX_ACTIVE];
} track_point;

HD void track_look(const flat_scene *s, const media_walk *w, vec3 p, float t,
                   track_point *out)
{
    out->density[0] = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const majorant_cell *bound = &walk_part(w, i)->bound;
        int k = part_place(i);
        out->density[k] = rgb_gray(0.0f);
        if (bound->density == 0.0f && bound->rate == 0.0f)
            continue;
        out->at[k] = lattice_point(s, walk_part(w, i), p, t);
        out->density[k] = medium_density(s, walk_medium(s, w, i), &out->at[k]);
    }
}

/* Of all but homogeneous media. */
HD rgb track_sigma_t(const flat_scene *s, const media_walk *w,
                     const track_point *x)
{
    rgb sum = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (!m->uniform && walk_part(w, i)->bound.density != 0.0f)
            sum = rgb_add(sum, rgb_mul(m->sigma_t, x->density[part_place(i)]));
    }
    return sum;
}

/* What is left of a product after a tentative collision with attenuation
 * `sigma`; false when it is dead. Beyond a majorant that does not hold it
 * changes its sign: still unbiased. */
HD bool track_collide(rgb sigma, float majorant, rng *r, rgb *product,
                      track_counters *c)
{
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

/* Transmittance of what a line goes through, as far as it has come. */
typedef struct {
    rgb even;               /* of homogeneous media, all along             */
    rgb product;            /* of the others, by ratio tracking            */
} track_passed;

HD void track_enter(const flat_scene *s, track_line *l)
{
    l->majorant = track_majorant(s, &l->walk);
    l->t = l->walk.t;
}

/* Begins with the line's walk; false: all is known already. */
HD bool track_begin(const flat_scene *s, track_line *l, rng *r,
                    track_passed *out)
{
    bool uneven;
    out->even = out->product = rgb_gray(1.0f);
    if (!track_attenuates(s, &l->walk, &uneven))
        return false;
    rgb even = rgb_scale(track_uniform(s, &l->walk),
                         -(l->walk.t_max - l->walk.t));
    out->even = rgb_make(fm_exp(even.r), fm_exp(even.g), fm_exp(even.b));
    if (!uneven)
        return false;
    l->tau = rng_optical_depth(r);
    track_enter(s, l);
    return true;
}

HD_APART rgb track_media(const flat_scene *s, const container_set *set,
                         bool atmosphere, vec3 o, vec3 d, float t0, float t1,
                         rng *r, track_counters *c)
{
    track_line l;
    track_passed passed;
    walk_begin(s, &l.walk, set, atmosphere, o, d, t0, t1);
    c->overflow += l.walk.overflow;
    bool goes_on = track_begin(s, &l, r, &passed);
    while (goes_on) {
        float step;
        track_point x;
        if (track_advance(&l, &step)) {
            l.tau = rng_optical_depth(r);
            track_look(s, &l.walk, vec3_mad(o, l.t, d), l.t, &x);
            if (!track_collide(track_sigma_t(s, &l.walk, &x), l.majorant, r,
                               &passed.product, c))
                return rgb_gray(0.0f);
            continue;
        }
        goes_on = walk_next(s, &l.walk);
        if (goes_on)
            track_enter(s, &l);
    }
    return rgb_mul(passed.product, passed.even);
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
