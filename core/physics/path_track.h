/* path_track.h - what a path carries, and its flights through media between
 * two surfaces (see path.h). */
#ifndef CORE_PHYSICS_PATH_TRACK_H
#define CORE_PHYSICS_PATH_TRACK_H
#include "core/physics/aim.h"
#include "core/physics/glow.h"
#include "core/physics/line.h"
#include "core/physics/ray.h"
#include "core/physics/rng.h"
#include "core/physics/sobol.h"
#include "core/physics/track.h"

enum { PATH_THROUGH, PATH_SCATTERED, PATH_ENDED };

/* The media of a segment, seen coarsely: what both ways of lighting its
 * points agree on. */
typedef struct {
    int32_t on;             /* lights are sought along the ray too         */
    float first, last;      /* where there are media                       */
    float extinction;       /* mean, between them                          */
    float stop;             /* the same of what ends a flight as it is drawn */
} path_stretch;

/* A scattering event. */
typedef struct {
    float t;
    int32_t medium;
    float sigma_s;          /* of all media there, mean over channels      */
} path_event;

typedef struct {
    rgb beta, r_u;
    rgb radiance;           /* gathered so far                             */
    int32_t driver;
    int32_t straight;       /* still on the line from the eye              */
    float along;            /* where on the eye's line single.h looks      */
    int32_t spread;         /* so many more vertices take numbers that fill
                               their space evenly over a pixel's samples   */
    float depth;            /* optical depth that is left of the flight, which
                               goes on behind boundaries; < 0: none is yet */
    float boost;            /* scattering events of this segment are drawn
                               so many times as often, and weigh so much less */
    path_stretch stretch;
    lamp_aim aim;           /* of the vertex that is being left            */
    float p_dir;            /* density per solid angle with which d was
                               chosen at o; 0: not chosen                  */
    vec3 o, d;
    ray_hit after;          /* the ray goes on behind this                 */
    container_set inside;
    rng random;
    track_counters *count;
} path_state;

/* Of a throughput that no more than media have changed: where these are gray
 * its channels are alike. */
HD rgb path_gray(rgb beta)
{
    return scene_may(MAY_COLORS | MAY_SURFACES) ? beta : rgb_gray(beta.r);
}

HD void path_add(path_state *p, rgb value)
{
    p->radiance = rgb_add(p->radiance,
                          rgb_scale(value, 1.0f / rgb_mean(p->r_u)));
}

/* What pairs of numbers are for, at each vertex that takes them. */
enum { PATH_PAIR_FLIGHT, PATH_PAIR_TURN, PATH_PAIRS };

/* The stream of their seeds, apart from those of samples and places. */
#define PATH_PAIR_PASS 0xfffffffeu

/* Two words, each as likely as any, for the next vertex. The number of the
 * sample is that of the path's stream. */
HD void path_pair(path_state *p, int what, uint32_t out[2])
{
    if (p->spread == 0) {
        out[0] = rng_u32(&p->random);
        out[1] = rng_u32(&p->random);
        return;
    }
    rng_block b;
    b.word[0] = p->random.counter[0];
    b.word[1] = p->random.counter[1];
    b.word[2] = PATH_PAIR_PASS;
    b.word[3] = (uint32_t)(p->spread * PATH_PAIRS + what);
    b = rng_block_of(b, p->random.key[0], p->random.key[1]);
    sobol_pair(p->random.counter[2], b.word, out);
}

/* The same, in [0, 1). */
HD void path_pair_floats(path_state *p, int what, float *u, float *v)
{
    uint32_t x[2];
    path_pair(p, what, x);
    *u = sobol_float(x[0]);
    *v = sobol_float(x[1]);
}

/* Optical depth of the flight from a vertex, or what boundaries behind it have
 * left of that. A vertex has one such number: another flight by it would know
 * that the first had not ended. */
HD float path_depth(path_state *p)
{
    uint32_t x[2];
    if (p->depth >= 0.0f)
        return p->depth;
    if (p->spread == 0)
        return rng_optical_depth(&p->random);
    path_pair(p, PATH_PAIR_FLIGHT, x);
    return rng_depth_of(x[0], rng_depth_is_end(x[0])
                              ? rng_u32(&p->random) : 0u);
}

/* ---- media between two surfaces ---------------------------------------- */

/* Coefficients of all active media at a tentative collision. */
typedef struct {
    rgb sigma_s[MAX_ACTIVE];
    rgb all_s, all_a, all_t;    /* sums; all_t is what attenuates          */
} path_point;

HD void path_point_of(const flat_scene *s, path_state *p, const media_walk *w,
                      float t, const track_point *x, rgb majorant,
                      path_point *out)
{
    rgb source = rgb_gray(0.0f);
    out->all_s = out->all_a = out->all_t = source;
    out->sigma_s[0] = source;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        const majorant_cell *bound = &walk_part(w, i)->bound;
        out->sigma_s[part_place(i)] = rgb_gray(0.0f);
        if (bound->density == 0.0f && bound->rate == 0.0f)
            continue;
        rgb density = may_gray(x->density[part_place(i)]);
        p->count->lookups++;
        out->sigma_s[part_place(i)] = rgb_mul(may_gray(m->sigma_s), density);
        out->all_s = rgb_add(out->all_s, out->sigma_s[part_place(i)]);
        out->all_a = rgb_add(out->all_a,
                             rgb_mul(may_gray(m->sigma_a), density));
        out->all_t = rgb_add(out->all_t,
                             rgb_mul(may_gray(m->sigma_t), density));
        if (!scene_may(MAY_EMISSION) || bound->rate == 0.0f || p->straight ||
            m->uniform)
            continue;
        const field_point *at = &x->at[part_place(i)];
        rgb q = medium_source(s, m, at, density);
        if (rgb_is_black(q))
            continue;
        float share = glow_ray_share(s, walk_part(w, i)->medium,
                                     vec3_mad(p->o, t, p->d), t, p->p_dir);
        source = rgb_add(source, rgb_scale(q, share));
    }
    if (!rgb_is_black(source))
        p->radiance = rgb_add(p->radiance,
            rgb_scale(rgb_mul(p->beta, source),
                      1.0f / rgb_mean(rgb_mul(p->r_u, majorant))));
}

HD void path_point_at(const flat_scene *s, path_state *p,
                      const media_walk *w, float t, rgb majorant,
                      path_point *out)
{
    track_point x;
    track_look(s, w, vec3_mad(p->o, t, p->d), t, &x);
    path_point_of(s, p, w, t, &x, majorant, out);
}

/* Emission is sampled at tentative collisions, so where it is wanted they are
 * drawn more often than the coefficients ask. */
HD rgb path_majorant(const flat_scene *s, const media_walk *w, bool emission)
{
    rgb sum = rgb_gray(0.0f);
    for (int i = 0; i < walk_parts(w); i++) {
        const majorant_cell *b = &walk_part(w, i)->bound;
        const flat_medium *m = walk_medium(s, w, i);
        sum = rgb_add(sum, rgb_scale(may_gray(m->bound), b->density));
        if (scene_may(MAY_EMISSION) && emission && !m->uniform)
            sum = rgb_add(sum, rgb_gray(b->rate));
    }
    return sum;
}

/* Majorant transmittance of each channel over that of the driver. */
HD rgb path_ratio(const path_state *p, rgb majorant, float distance)
{
    if (!scene_may(MAY_COLORS))
        return rgb_gray(1.0f);
    float driver = rgb_get(majorant, p->driver);
    rgb over = rgb_sub(majorant, rgb_gray(driver));
    if (rgb_is_black(over))
        return rgb_gray(1.0f);
    return rgb_make(fm_exp(-over.r * distance), fm_exp(-over.g * distance),
                    fm_exp(-over.b * distance));
}

HD void path_fly(path_state *p, rgb majorant, float distance)
{
    rgb ratio = path_ratio(p, majorant, distance);
    p->beta = rgb_mul(p->beta, ratio);
    p->r_u = rgb_mul(p->r_u, ratio);
}

/* Emission per length of the homogeneous media of a walk that no straight
 * line counts. */
HD rgb path_uniform_source(const flat_scene *s, const path_state *p,
                           const media_walk *w)
{
    rgb sum = rgb_gray(0.0f);
    field_point anywhere = field_point_make(s, -1, p->o);
    for (int i = 0; i < walk_parts(w) && !p->straight; i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (scene_may(MAY_EMISSION) && m->uniform && m->emits)
            sum = rgb_add(sum, medium_source(s, m, &anywhere,
                                             rgb_gray(m->outside.density)));
    }
    return sum;
}

/* A flight over `distance` gathers that emission all along, as its end is
 * drawn with the transmittance; where that differs in the channels, at a
 * point of it. */
HD void path_gather(path_state *p, rgb source, rgb majorant, float distance)
{
    if (!scene_may(MAY_EMISSION) || rgb_is_black(source))
        return;
    rgb ratio = path_ratio(p, majorant, distance * rng_float(&p->random));
    rgb value = rgb_mul(rgb_mul(p->beta, ratio), rgb_scale(source, distance));
    p->radiance = rgb_add(p->radiance,
        rgb_scale(value, 1.0f / rgb_mean(rgb_mul(p->r_u, ratio))));
}

HD int path_null(path_state *p, const path_point *at, rgb drawn, rgb majorant)
{
    rgb chance = rgb_sub(majorant, drawn);
    chance = rgb_make(fabsf(chance.r), fabsf(chance.g), fabsf(chance.b));
    float driver = rgb_get(chance, p->driver);
    if (!(driver > 0.0f))
        return PATH_ENDED;      /* density 0: drawn by rounding only */
    float scale = 1.0f / driver;
    p->beta = rgb_mul(p->beta, rgb_scale(rgb_sub(majorant, at->all_t),
                                         scale));
    p->r_u = rgb_mul(may_gray(p->r_u), rgb_scale(chance, scale));
    return PATH_THROUGH;
}

/* Where a majorant does not hold, events are drawn in proportion to their
 * size, and nulls, of less than nothing, change the path's sign: unbiased
 * [Galtier et al. 2013]. The factor is what all sizes add up to over the
 * majorant. */
HD float path_excess(float drawn, float majorant)
{
    return hd_max(2.0f * drawn / majorant - 1.0f, 1.0f);
}

HD_APART rgb path_excesses(rgb drawn, rgb majorant)
{
    return rgb_make(path_excess(drawn.r, majorant.r),
                    path_excess(drawn.g, majorant.g),
                    path_excess(drawn.b, majorant.b));
}

HD float path_exceed(path_state *p, rgb drawn, rgb majorant)
{
    rgb k = path_excesses(drawn, majorant);
    float driver = rgb_get(k, p->driver);
    p->beta = rgb_scale(p->beta, driver);
    p->r_u = rgb_mul(p->r_u, rgb_make(driver / k.r, driver / k.g,
                                      driver / k.b));
    return driver;
}

/* What happens at a tentative collision. On PATH_SCATTERED *which is the
 * medium's place in the walk. */
HD int path_collide(path_state *p, const media_walk *w,
                    const path_point *at, rgb majorant, int *which)
{
    float m = rgb_get(majorant, p->driver);
    rgb drawn = rgb_add(at->all_a, rgb_scale(at->all_s, p->boost));
    rgb over = rgb_sub(drawn, rgb_scale(majorant, 1.00001f));
    if (rgb_max(over) > 0.0f) {
        p->count->majorant_exceeded++;
        m *= path_exceed(p, drawn, majorant);
    }
    float x = rng_fine(&p->random) * m;
    for (int i = 0; i < walk_parts(w); i++) {
        float sigma = rgb_get(at->sigma_s[part_place(i)], p->driver);
        if (x < p->boost * sigma) {
            rgb ratio = rgb_scale(at->sigma_s[part_place(i)], 1.0f / sigma);
            p->beta = rgb_mul(p->beta, rgb_scale(ratio, 1.0f / p->boost));
            p->r_u = rgb_mul(may_gray(p->r_u), ratio);
            *which = i;
            return PATH_SCATTERED;
        }
        x -= p->boost * sigma;
    }
    if (x < rgb_get(at->all_a, p->driver))
        return PATH_ENDED;
    return path_null(p, at, drawn, majorant);
}

/* How far tentative collisions outnumber the majorant's. With a boost they
 * must leave room for nulls everywhere: these carry the weight of what is
 * scattered too often. */
HD float path_room(const path_state *p)
{
    return p->boost > 1.0f ? 2.0f * p->boost : 1.0f;
}

/* A flight: what is asked along its line. */
typedef struct {
    rgb majorant;           /* of the current piece                        */
    rgb source;             /* what homogeneous media emit there           */
} path_flight;

HD void path_enter(const flat_scene *s, const path_state *p, track_line *l,
                   path_flight *f)
{
    f->majorant = rgb_scale(path_majorant(s, &l->walk, !p->straight),
                            path_room(p));
    l->majorant = rgb_get(f->majorant, p->driver);
    l->t = l->walk.t;
}

HD void path_depart(const flat_scene *s, path_state *p, track_line *l,
                    path_flight *f)
{
    l->tau = path_depth(p);
    f->source = path_uniform_source(s, p, &l->walk);
    path_enter(s, p, l, f);
}

/* What happens at a tentative collision where media hold x. */
HD int path_meet(const flat_scene *s, path_state *p, const track_line *l,
                 const path_flight *f, const track_point *x, path_event *out)
{
    path_point at;
    int which;
    path_point_of(s, p, &l->walk, l->t, x, f->majorant, &at);
    int event = path_collide(p, &l->walk, &at, f->majorant, &which);
    out->t = l->t;
    if (event == PATH_SCATTERED) {
        out->medium = walk_part(&l->walk, which)->medium;
        out->sigma_s = rgb_mean(at.all_s);
        p->count->collisions++;
    }
    return event;
}

/* Delta tracking along the line's walk. On PATH_SCATTERED, *out tells where. */
HD int path_track(const flat_scene *s, path_state *p, track_line *l,
                  path_event *out)
{
    path_flight f;
    path_depart(s, p, l, &f);
    for (;;) {
        float step;
        bool collides = track_advance(l, &step);
        path_gather(p, f.source, f.majorant, step);
        path_fly(p, f.majorant, step);
        if (collides) {
            track_point x;
            l->tau = rng_optical_depth(&p->random);
            track_look(s, &l->walk, vec3_mad(p->o, l->t, p->d), l->t, &x);
            int event = path_meet(s, p, l, &f, &x, out);
            if (event != PATH_THROUGH)
                return event;
        } else if (walk_next(s, &l->walk)) {
            path_enter(s, p, l, &f);
        } else {
            p->depth = l->tau;
            return PATH_THROUGH;
        }
    }
}

/* Scattering, and in *all attenuation, of all active media in the middle of
 * the walk's piece. */
HD float path_middle(const flat_scene *s, const path_state *p,
                     const media_walk *w, float *all)
{
    float t = 0.5f * (w->t + w->t_end), sum = 0.0f;
    vec3 x = vec3_mad(p->o, t, p->d);
    *all = 0.0f;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (walk_part(w, i)->bound.density == 0.0f)
            continue;
        field_point at = lattice_point(s, walk_part(w, i), x, t);
        rgb density = medium_density(s, m, &at);
        sum += rgb_max(rgb_mul(m->sigma_s, density));
        *all += rgb_max(rgb_mul(m->sigma_t, density));
    }
    return sum;
}

/* Thin media scatter few of the eye's rays: draw such events more often, up
 * to about one ray in two, by one look at each piece. Each then carries less,
 * and what passes unscattered as much more as it comes less often: unbiased
 * for any factor that only the ray decides. */
HD float path_boost(const path_state *p, float tau)
{
    const float enough = 0.75f, most = 8.0f;
    return p->straight ? hd_max(hd_min(enough / tau, most), 1.0f) : 1.0f;
}

HD bool path_has_lamps(const flat_scene *s)
{
    return scene_may(MAY_LAMPS) && s->local_lights;
}

/* Looks at each piece once, as far as it matters. */
HD void path_look(const flat_scene *s, path_state *p, float t1)
{
    const float enough = 0.75f;
    media_walk w;
    float scattered = 0.0f, lost = 0.0f, all;
    path_stretch *look = &p->stretch;
    look->on = path_has_lamps(s);
    look->first = look->last = p->after.t;
    walk_begin(s, &w, &p->inside, true, p->o, p->d, p->after.t, t1);
    do {
        float length = w.t_end - w.t;
        float sigma_s = path_middle(s, p, &w, &all);
        if (!(lost > 0.0f))
            look->first = w.t;
        if (all > 0.0f)
            look->last = w.t_end;
        scattered += sigma_s * length;
        lost += all * length;
    } while ((look->on || scattered < enough) && walk_next(s, &w));
    p->boost = path_boost(p, scattered);
    float length = look->last - look->first;
    look->on = look->on && scattered > 0.0f && length > 0.0f;
    look->extinction = lost / length;
    look->stop = p->boost * scattered / length + (lost - scattered) / length;
    /* Not where next to nothing comes through. */
    look->last = hd_min(look->last, look->first + 30.0f * length / lost);
}

HD bool path_walk_scatters(const flat_scene *s, const media_walk *w)
{
    for (int i = 0; i < walk_parts(w); i++)
        if (!rgb_is_black(walk_medium(s, w, i)->sigma_s))
            return true;
    return false;
}

HD bool path_walk_attenuates(const flat_scene *s, const media_walk *w)
{
    for (int i = 0; i < walk_parts(w); i++)
        if (!rgb_is_black(s->media[w->part[i].medium].sigma_t))
            return true;
    return false;
}

/* Where nothing scatters, the line integral is exact. On the straight line
 * from the eye only what passes is asked for. */
HD int path_line(const flat_scene *s, path_state *p, const media_walk *w,
                 float t0, float t1)
{
    if (p->straight && !path_walk_attenuates(s, w))
        return PATH_THROUGH;
    line_integral line = line_zero();
    line_integrate(s, &p->inside, p->o, p->d, t0, t1, p->p_dir, !p->straight,
                   false, line_jitter_draw(s, &p->random), &line);
    path_add(p, rgb_mul(p->beta, line.radiance));
    p->beta = rgb_mul(p->beta, line_transmittance(&line));
    return rgb_is_black(p->beta) ? PATH_ENDED : PATH_THROUGH;
}

#endif
