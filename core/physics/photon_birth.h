/* photon_birth.h - where photons come from.
 *
 * Photons come from lights, from the sky, from glowing voxels and from bodies
 * that glow, in proportion to their power, along a sequence that fills the
 * space of their births evenly. They fly as paths do (path.h: null-collision
 * tracking, drivers of colour, roulette), and lay their flights into the field
 * of scattered light (radiance.h) - but not the flights from a light to its
 * first event: that light the eye's path finds by itself.
 *
 * Power is counted in units of the mean photon's. In POV-Ray's units of light,
 * power depends on where it is told: a light without falloff gives a photon
 * the more the farther it flies, and a surface sees a quarter of what a medium
 * sees. A photon of a light therefore gets its power at its first event. */
#ifndef CORE_PHYSICS_PHOTON_BIRTH_H
#define CORE_PHYSICS_PHOTON_BIRTH_H
#include "core/physics/inside.h"
#include "core/physics/path.h"
#include "core/physics/radiance.h"

/* The streams of photons, apart from those of pixels' samples. */
#define PHOTON_PASS 0xffffffffu

/* No photon has more events; what is left of its power is told. */
enum { PHOTON_EVENTS = 1 << 16 };

/* Births in a plane or cone around the ball that holds the scene, and as many
 * in a wider one where media go on beyond it. */
#define PHOTON_WIDE 4.0f

/* Surfaces without an end send light from so many radii away. */
#define PHOTON_FAR 1000.0f

enum { PHOTON_LIGHT, PHOTON_SKY, PHOTON_GLOW, PHOTON_BODY };

typedef struct {
    int32_t kind;           /* PHOTON_LIGHT ...                            */
    int32_t light;
    double cumulative;      /* share of photons of this and all before     */
    double share;
} photon_source;

enum { PHOTON_DIMENSIONS = 4 };

/* What is asked of every photon. */
typedef struct {
    const photon_source *source;
    int32_t sources;
    uint64_t count;         /* of all photons of the field                 */
    uint64_t first;         /* photons of fields before                    */
    uint64_t seed;
    uint32_t frame;
    uint64_t shift[PHOTON_DIMENSIONS];      /* of the sequence, from seed  */
    float shift_share;
    double power;           /* of all sources                              */
} photon_job;

/* Where power came from and went, in units of the mean photon's power, mean
 * over the channels. `units` is what POV-Ray's units of light add after the
 * birth; `walls` what came straight to surfaces without an end, which give
 * light on their own account; `roulette` what chance took more than it gave. */
#define PHOTON_BOOKS(X)                                                       \
    X(emitted) X(units)                                                       \
    X(media) X(surfaces) X(walls) X(escaped) X(roulette) X(dropped)

/* On a GPU whole numbers, which any order adds up to the same. */
#define PHOTON_BOOK_ONE 4294967296.0
#ifdef __CUDACC__
typedef int64_t photon_sum;
#else
typedef double photon_sum;
#endif

HD void photon_book(photon_sum *sum, double value)
{
#ifdef __CUDACC__
    *sum += (int64_t)rint(value * PHOTON_BOOK_ONE);
#else
    *sum += value;
#endif
}

typedef struct {
#define X(name) photon_sum name;
    PHOTON_BOOKS(X)
#undef X
} photon_books;

typedef struct {
    track_count photons, events, bounces;
    track_count stored;     /* events and births, where balls gather them  */
    photon_books books;
    radiance_tally tally;
    track_counters track;
} photon_counters;

/* Aligned for a GPU, which keeps lists of photons in words of 16 bytes. */
typedef struct HD_ALIGNED(16) {
    path_state path;        /* beta: power of the photon                   */
    int32_t light;          /* whose first flight this is, or -1           */
    int32_t direct;         /* on its first flight, from a light or the sky */
    int32_t stored;         /* its flights are laid into the field         */
    int32_t emission;       /* a medium's                                  */
    vec3 from;              /* where the light counts from                 */
    float nominal;          /* the light's law where the books tell power  */
    float laid;             /* the flight is laid up to here               */
    uint32_t events;
} photon_state;

/* ---- births ------------------------------------------------------------ */

/* Even in all dimensions for successive photons: multiples of powers of the
 * generalised golden ratio, x^5 = x + 1 [Roberts 2018]. */
HD void photon_place(const photon_job *job, uint64_t photon,
                     float u[PHOTON_DIMENSIONS])
{
    const uint64_t step[PHOTON_DIMENSIONS] = {
        0xdb4f0b9175ae2165ull, 0xbbe0563303a4615full,
        0xa0f2ec75a1fe1575ull, 0x89e182857d9ed689ull};
    for (int i = 0; i < PHOTON_DIMENSIONS; i++)
        u[i] = (float)((job->shift[i] + photon * step[i]) >> 40) *
               5.96046448e-08f;
}

/* A cone to send photons into, or a disc to send them through. */
typedef struct {
    vec3 axis;
    float size;             /* 1 - cosine of its half-angle; the radius    */
} photon_aim;

/* What a light at `lamp` is sent into: the ball, or its own cone. */
HD photon_aim photon_cone(const flat_scene *s, const flat_light *l, vec3 lamp,
                          bool wide)
{
    photon_aim out;
    vec3 to = vec3_sub(s->reach.centre, lamp);
    float d = vec3_length(to), r = s->reach.radius;
    out.axis = d > 0.0f ? vec3_scale(to, 1.0f / d)
                        : vec3_make(0.0f, 0.0f, 1.0f);
    out.size = 2.0f;
    if (!wide && d > r) {
        float sine2 = (r / d) * (r / d);
        out.size = sine2 / (1.0f + sqrtf(1.0f - sine2));
    }
    if (l->kind != LIGHT_SPOT)
        return out;
    float own = 1.0f - hd_max(hd_min(l->inner, l->outer), 0.0f);
    if (own < out.size) {
        out.axis = l->axis;
        out.size = own;
    }
    return out;
}

HD float photon_in_cone(const photon_aim *a, vec3 d)
{
    vec3 off = vec3_sub(d, a->axis);
    return 0.5f * vec3_dot(off, off) <= a->size ? warp_cone_pdf(a->size)
                                                : 0.0f;
}

/* A direction from the lamp, and 1 / its density per solid angle. */
HD vec3 photon_aim_cone(const flat_scene *s, const flat_light *l, vec3 lamp,
                        float u, float v, float *measure)
{
    photon_aim near = photon_cone(s, l, lamp, false), far;
    vec3 d;
    if (!s->reach.media) {
        d = warp_cone(u, v, near.size);
        *measure = 1.0f / warp_cone_pdf(near.size);
        return warp_frame_to_world(warp_frame(near.axis), d);
    }
    far = photon_cone(s, l, lamp, true);
    photon_aim a = u < 0.5f ? near : far;
    d = warp_cone(u < 0.5f ? 2.0f * u : 2.0f * u - 1.0f, v, a.size);
    d = warp_frame_to_world(warp_frame(a.axis), d);
    *measure = 2.0f / (photon_in_cone(&near, d) + photon_in_cone(&far, d));
    return d;
}

/* A point in the plane of the ball's centre, of photons along d, and 1 / its
 * density per area. */
HD vec3 photon_aim_disc(const flat_scene *s, vec3 d, float u, float v,
                        float *measure)
{
    float r = s->reach.radius, wide = r * PHOTON_WIDE;
    float area = FM_PI * r * r, wide_area = FM_PI * wide * wide;
    warp_basis b = warp_frame(d);
    if (!s->reach.media) {
        *measure = area;
    } else {
        bool near = u < 0.5f;
        u = near ? 2.0f * u : 2.0f * u - 1.0f;
        r = near ? r : wide;
        *measure = 2.0f / ((r * r * u < s->reach.radius * s->reach.radius
                                ? 1.0f / area : 0.0f) + 1.0f / wide_area);
    }
    vec3 at = vec3_scale(warp_disc(u, v), r);
    return vec3_add(s->reach.centre, warp_frame_to_world(b, at));
}

/* How the power of a light's photon goes with the place x on its flight, `t`
 * from the lamp: what the light gives there, times what the flights' thinning
 * has taken. */
HD float photon_law(const flat_scene *s, const photon_state *p, float t)
{
    const flat_light *l = &s->lights[p->light];
    vec3 x = vec3_mad(p->path.o, t, p->path.d);
    float distance;
    vec3 wi = light_toward(l, p->from, x, &distance);
    if (!l->parallel && !(distance > 0.0f))
        return 0.0f;
    float factor = light_factor(s, l, p->from, x, wi, distance);
    return l->parallel ? factor : factor * t * t;
}

/* Direction in which the light of the first flight comes to its point at t:
 * an area that tells in shadows only shines from its middle. */
HD vec3 photon_arrives(const flat_scene *s, const photon_state *p, float t)
{
    const flat_light *l = &s->lights[p->light];
    float distance;
    if (l->parallel)
        return p->path.d;
    vec3 x = vec3_mad(p->path.o, t, p->path.d);
    return vec3_scale(light_toward(l, p->from, x, &distance), -1.0f);
}

HD void photon_start(const flat_scene *s, photon_state *p, vec3 o, vec3 d,
                     rgb power, rng random)
{
    container_set set;
    inside_find(s, o, &set);
    path_begin(&p->path, o, d, &set, true, random);
    p->path.boost = 1.0f;
    p->path.beta = power;
    p->light = -1;
    p->direct = p->emission = 0;
    p->stored = 1;
    p->events = 0;
}

/* How far before the plane of births flights begin: clear of the ball, and of
 * what goes on beyond it. */
HD float photon_before(const flat_scene *s)
{
    return (s->reach.media ? 2.0f * PHOTON_WIDE : 1.01f) * s->reach.radius;
}

/* Through the point `at`, of light that starts `back` before it. */
HD void photon_start_far(const flat_scene *s, photon_state *p, vec3 at, vec3 d,
                         rgb power, float back, rng random,
                         track_counters *count)
{
    float before = hd_min(photon_before(s), back);
    photon_start(s, p, vec3_mad(at, -before, d), d, power, random);
    if (!(s->reach.media || s->reach.walls) || !(back > before))
        return;
    container_set set = p->path.inside;
    rgb left = shadow_transmittance(s, &set, true, p->path.o,
                                    vec3_scale(d, -1.0f), back - before,
                                    &p->path.random, count);
    p->path.beta = rgb_mul(p->path.beta, left);
}

HD void photon_from_parallel(const flat_scene *s, photon_state *p,
                             const flat_light *l, vec3 lamp, const float *u,
                             rgb power, rng random, track_counters *count)
{
    float measure;
    vec3 at;
    if (l->kind == LIGHT_CYLINDER && l->outer < s->reach.radius) {
        vec3 disc = vec3_scale(warp_disc(u[0], u[1]), l->outer);
        at = vec3_add(p->from, warp_frame_to_world(warp_frame(l->axis), disc));
        measure = FM_PI * l->outer * l->outer;
        float along = vec3_dot(vec3_sub(s->reach.centre, at), l->axis);
        at = vec3_mad(at, along, l->axis);
    } else {
        at = photon_aim_disc(s, l->axis, u[0], u[1], &measure);
    }
    float back = vec3_dot(vec3_sub(at, lamp), l->axis);
    vec3 from = p->from;
    photon_start_far(s, p, at, l->axis, rgb_scale(power, measure),
                     back, random, count);
    p->from = from;
}

/* A light's photon has its power without the light's law. */
HD void photon_from_light(const flat_scene *s, photon_state *p, int i,
                          const float *u, rng random, track_counters *count)
{
    const flat_light *l = &s->lights[i];
    vec3 lamp = l->position;
    if (l->area)
        lamp = light_lamp_at(l, s->reach.centre, u[2], u[3]);
    p->from = l->illumination ? lamp : l->position;
    rgb power = rgb_scale(l->color, light_medium_factor(s));
    if (l->parallel) {
        photon_from_parallel(s, p, l, lamp, u, power, random, count);
    } else {
        float measure;
        vec3 from = p->from;
        vec3 d = photon_aim_cone(s, l, lamp, u[0], u[1], &measure);
        photon_start(s, p, lamp, d, rgb_scale(power, measure), random);
        p->from = from;
    }
    p->light = i;
    p->direct = 1;
    p->stored = 0;
    float middle = vec3_dot(vec3_sub(s->reach.centre, p->path.o), p->path.d);
    p->nominal = photon_law(s, p, hd_max(middle, 0.5f * s->reach.radius));
}

/* Half of the sky's photons from where it is brightest, if that is told. */
HD void photon_from_sky(const flat_scene *s, photon_state *p, const float *u,
                        rng random, track_counters *count)
{
    float chosen = 0.0f, measure;
    bool both = sky_is_light(s);
    vec3 wi = warp_sphere(u[2], u[3]);
    if (both && rng_chance(&random, 0.5f))
        wi = sky_choose(s, &random, &chosen);
    else if (both)
        chosen = sky_pdf(s, wi);
    float pdf = both ? 0.5f * (chosen + WARP_INV_4PI) : WARP_INV_4PI;
    vec3 d = vec3_scale(wi, -1.0f);
    vec3 at = photon_aim_disc(s, d, u[0], u[1], &measure);
    rgb power = rgb_scale(sky_radiance(s, wi), measure / pdf);
    photon_start_far(s, p, at, d, power, s->far, random, count);
    p->direct = 1;
}

HD void photon_from_glow(const flat_scene *s, photon_state *p, const float *u,
                         double place, rng random)
{
    glow_sample g = glow_choose_at(s, place, &random);
    const flat_medium *m = &s->media[g.medium];
    field_point x = field_point_make(s, m->lead, g.p);
    rgb q = medium_source(s, m, &x, medium_density(s, m, &x));
    float scale = g.pdf > 0.0f ? 4.0f * FM_PI / g.pdf : 0.0f;
    photon_start(s, p, g.p, warp_sphere(u[0], u[1]), rgb_scale(q, scale),
                 random);
    p->emission = 1;
    if (!path_medium_at(s, &p->path.inside, g.medium))
        p->path.beta = rgb_gray(0.0f);
}

/* ---- bodies that glow --------------------------------------------------- */

/* A place on a line at which light is given along it, chosen among all such
 * places in proportion. */
typedef struct {
    float all;              /* weight so far                               */
    vec3 o;                 /* the choice                                  */
    rgb power;              /* ... and its radiance over its weight        */
    container_set inside;
    int32_t emission;       /* of a medium                                 */
} photon_choice;

HD bool photon_choose(photon_choice *c, float weight, rgb radiance, rng *r)
{
    if (!(weight > 0.0f))
        return false;
    c->all += weight;
    if (!rng_chance(r, weight / c->all))
        return false;
    c->power = rgb_scale(radiance, 1.0f / weight);
    return true;
}

/* Emission per length of the media without a lattice around the line. */
HD rgb photon_even_source(const flat_scene *s, const container_set *set,
                          vec3 o, vec3 d)
{
    media_walk w;
    path_state anywhere;
    anywhere.straight = 0;
    anywhere.o = o;
    walk_begin(s, &w, set, true, o, d, 0.0f, 1.0f);
    return path_uniform_source(s, &anywhere, &w);
}

/* What a surface sends along d, the way of the line r: its own light, and
 * where it has no end what it reflects of lights and the sky, whose photons
 * would come to it too far away. */
HD rgb photon_sent(const flat_scene *s, photon_state *p, const bvh_ray *r,
                   const ray_hit *h, const container_set *inside, vec3 d,
                   vec3 *o)
{
    hit_point x = hit_resolve(s, r, h);
    *o = surface_offset(x.p, vec3_scale(x.ng, -1.0f));
    rgb glow = surface_glow(x.material, x.color, x.opacity);
    if (!container_is_unbounded(s, h->shape))
        return glow;
    path_state look;
    path_vertex v;
    path_connection c;
    /* Seen from where the light goes. */
    x.ng = vec3_scale(x.ng, -1.0f);
    x.ns = vec3_scale(x.ns, -1.0f);
    v.p = x.p;
    v.d = vec3_scale(d, -1.0f);
    v.on_surface = true;
    v.medium = 0;
    v.event = 0;
    v.surface = &x;
    path_begin(&look, v.p, v.d, inside, false, p->path.random);
    look.count = p->path.count;
    path_light(s, &look, &v);
    if (path_sky(s, &look, &v, &c))
        path_follow(s, &look, &c);
    if (path_sky_rest(s, &look, &v, &c))
        path_follow(s, &look, &c);
    p->path.random = look.random;
    return rgb_add(glow, look.radiance);
}

/* Considers what is sent at one hit. */
HD void photon_consider(const flat_scene *s, photon_state *p,
                        const bvh_ray *r, const ray_hit *h,
                        const container_set *inside, vec3 d,
                        photon_choice *c)
{
    if (hit_material(s, h) < 0)
        return;
    vec3 o;
    rgb sent = photon_sent(s, p, r, h, inside, d, &o);
    if (!photon_choose(c, rgb_mean(sent), sent, &p->path.random))
        return;
    c->o = o;
    c->emission = 0;
    c->inside = *inside;
}

HD void photon_consider_media(const flat_scene *s, photon_state *p,
                              const container_set *inside, float from,
                              float to, photon_choice *c)
{
    rgb q = rgb_scale(photon_even_source(s, inside, p->path.o, p->path.d),
                      to - from);
    if (!photon_choose(c, rgb_mean(q), q, &p->path.random))
        return;
    float t = from + (to - from) * rng_float(&p->path.random);
    c->o = vec3_mad(p->path.o, t, p->path.d);
    c->emission = 1;
    c->inside = *inside;
}

/* Lines through the ball, even in place and direction, meet every surface as
 * its light leaves it, and every volume by its size. Where surfaces go on, the
 * line comes from far. */
HD void photon_from_body(const flat_scene *s, photon_state *p, const float *u,
                         rng random, track_counters *count)
{
    float measure;
    vec3 d = warp_sphere(u[2], u[3]);
    vec3 at = photon_aim_disc(s, d, u[0], u[1], &measure);
    float before = photon_before(s) *
                   (s->reach.walls ? PHOTON_FAR : 1.0f);
    photon_start(s, p, vec3_mad(at, -before, d), d, rgb_gray(0.0f), random);
    p->path.count = count;
    bvh_ray r = bvh_ray_make(p->path.o, d);
    ray_hit after = hit_start(0.0f);
    container_set set = p->path.inside;
    photon_choice c;
    c.all = 0.0f;
    c.emission = 0;
    c.o = p->path.o;
    c.power = rgb_gray(0.0f);
    for (;;) {
        ray_hit h = bvh_nearest(s, &r, &after, before + photon_before(s));
        photon_consider_media(s, p, &set, after.t, h.t, &c);
        if (h.shape < 0)
            break;
        shadow_cross(s, &h, &set);
        photon_consider(s, p, &r, &h, &set, d, &c);
        after = h;
    }
    if (!(c.all > 0.0f))
        return;
    p->path.beta = rgb_scale(c.power, c.all * measure * 4.0f * FM_PI);
    p->path.o = c.o;
    p->emission = c.emission;
    p->path.inside = c.inside;
}

/* Power at the birth as the books tell it. */
HD double photon_power(const photon_state *p)
{
    float power = rgb_mean(p->path.beta) / rgb_mean(may_gray(p->path.r_u));
    return p->light >= 0 ? (double)power * (double)p->nominal : (double)power;
}

/* The birth of one photon of a source, at a place in [0, 1) of all of them;
 * its power in the scene's units. */
HD void photon_birth(const flat_scene *s, const photon_source *source,
                     const float *u, double place, rng random,
                     photon_state *p, track_counters *count)
{
    p->nominal = 1.0f;
    switch (source->kind) {
    case PHOTON_LIGHT:
        photon_from_light(s, p, source->light, u, random, count);
        break;
    case PHOTON_SKY:
        photon_from_sky(s, p, u, random, count);
        break;
    case PHOTON_GLOW:
        photon_from_glow(s, p, u, place, random);
        break;
    default:
        photon_from_body(s, p, u, random, count);
        break;
    }
    p->path.count = count;
}

#endif
