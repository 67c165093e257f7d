/* line.h - absorption and emission along a ray.
 *
 * The ray is cut at the voxel planes of every grid it reads. Between them a
 * trilinear density is a cubic along the ray, which the two-point Gauss rule
 * integrates exactly; the source is taken as constant over each half of the
 * piece, attenuated within it (METHODS.md 1.5, 1.6). Homogeneous media come
 * out in closed form.
 *
 * A density that is a function has no planes at which it is known: rays
 * through such media take samples at jittered places of each cell of the
 * majorants and each voxel, more in thick ones. Two sets of them, X and Y, each
 * of which alone tells the optical depth without bias, are taken for the
 * complex number
 *     Z = (X + Y) / 2 + i (X - Y) / 2 = (X (1 + i) + Y (1 - i)) / 2,
 * and the real part of what comes of it is the answer: exp(-(X + Y) / 2)
 * cos((X - Y) / 2) for the transmittance, and likewise for emission. As
 * (1 + i)^2 is imaginary, the variance k2 of X drops out, for which exp(-X)
 * alone would be exp(k2 / 2) too large. Of its further cumulants remains the
 * factor
 *     exp(k3 / 12 - k4 / 48 - ...),
 * exactly 1 where X and Y are normal. Parts whose bounds make a depth D at most
 * add up to |k3| / 12 <= D^2 / 125 times the depth of the bounds, for a density
 * that is 0 or its bound by chance. */
#ifndef CORE_PHYSICS_LINE_H
#define CORE_PHYSICS_LINE_H
#include "core/physics/fmath.h"
#include "core/physics/glow.h"
#include "core/physics/line_sum.h"
#include "core/physics/radiance.h"
#include "core/physics/rng.h"
#include "core/physics/twin.h"
#include "core/physics/walk.h"

/* The last is the field's. Where there is one more at most, each has a place
 * of its own and a GPU keeps both in registers. */
enum { LINE_LATTICES = (SCENE_MAY & MAY_MANY)    ? 20
                       : (SCENE_MAY & MAY_FIELD) ? 2 : 1 };

/* Places of samples, independent and uniform in [0, 1). */
typedef struct {
    float first, second;
} line_jitter;

/* A plane of voxels that is ahead, and its distance. */
typedef struct {
    float plane, next;
} line_near;

/* A voxel lattice along the ray. */
typedef struct {
    vec3 o, d, inverse;
    vec3 plane, next;       /* each axis' next plane, and its distance     */
} line_lattice;

typedef struct {
    vec3 o, d;
    float p_dir;            /* see glow_ray_share                          */
    bool emission;          /* the radiance is wanted                      */
    bool scattered;         /* ... and what the field's light gives        */
    bool sampled;           /* some density is a function                  */
    float rate;             /* ... and takes so many samples per length    */
    line_jitter jitter;     /* places of the next samples                  */
    int lattices;
    bool cells;             /* one of them is the field's                  */
    int place;              /* without MAY_MANY: radiance_sight_place      */
    line_lattice lattice[LINE_LATTICES];
} line_job;

/* One without planes. */
HD void line_no_lattice(line_lattice *l)
{
    l->o = l->d = l->inverse = vec3_make(0.0f, 0.0f, 0.0f);
    l->plane = l->o;
    l->next = vec3_make(INFINITY, INFINITY, INFINITY);
}

/* `place`: where it lies if there is one other at most. */
HD void line_add_lattice(line_job *job, int place, vec3 o, vec3 d)
{
    int i = job->lattices++;
    line_lattice *l = &job->lattice[scene_may(MAY_MANY) ? i : place];
    l->o = o;
    l->d = d;
    l->inverse = vec3_make(1.0f / d.x, 1.0f / d.y, 1.0f / d.z);
    l->plane = vec3_make(NAN, NAN, NAN);
    l->next = vec3_make(-INFINITY, -INFINITY, -INFINITY);
}

HD void line_add_lattices(const flat_scene *s, line_job *job,
                          const flat_medium *m)
{
    int room = scene_may(MAY_MANY) ? LINE_LATTICES - 1 - job->lattices : 1;
    int planes = part_bound(m->planes);
    for (int i = 0; i < planes && i < room; i++) {
        const flat_field *f = &s->fields[m->plane_field[i]];
        float shift = s->grids[f->grid].nearest ? 0.5f : 0.0f;
        line_add_lattice(job, 0,
                         vec3_add(affine_point(&f->to_index, job->o),
                                  vec3_make(shift, shift, shift)),
                         affine_vector(&f->to_index, job->d));
    }
}

/* The light of the field is read between planes of the media's voxels, but once
 * a cell at least: where voxels are larger, at planes of cells too. */
HD void line_add_field(const flat_scene *s, line_job *job, const flat_medium *m)
{
    const float enough = 0.8f;
    const radiance_lattice *f = &s->field;
    vec3 o = vec3_sub(job->o, vec3_make(f->origin[0], f->origin[1],
                                        f->origin[2]));
    vec3 d = vec3_scale(job->d, 1.0f / f->side);
    if (m && m->planes > 0) {
        const affine *a = &s->fields[m->plane_field[0]].to_index;
        if (vec3_length(affine_vector(a, job->d)) >= enough * vec3_length(d))
            return;
    }
    line_add_lattice(job, LINE_LATTICES - 1, vec3_scale(o, 1.0f / f->side), d);
    job->cells = true;
}

HD int line_lattices(const line_job *job)
{
    return scene_may(MAY_MANY) ? job->lattices : (int)LINE_LATTICES;
}

/* The first plane of one axis beyond t, and its distance; none beyond 2^30
 * voxels from the grid's origin, where the spacing of floats is over 64
 * voxels. */
HD_SHARED line_near line_plane(float o, float d, float inverse, float t)
{
    line_near out;
    float x = o + t * d, step = inverse > 0.0f ? 1.0f : -1.0f;
    out.plane = NAN;
    out.next = INFINITY;
    if (d == 0.0f || !(fabsf(x) < 1073741824.0f))
        return out;
    int at = hd_floor(x);
    out.plane = (float)(d > 0.0f ? at + 1 : (float)at == x ? at - 1 : at);
    if (!((out.plane - o) * inverse > t))
        out.plane += step;
    out.next = (out.plane - o) * inverse;
    return out;
}

/* The same of an axis: most often t has come no farther than to its last. */
HD void line_pass_plane(float o, float d, float inverse, float t, float *plane,
                        float *next)
{
    if (*next > t)
        return;
    *plane += inverse > 0.0f ? 1.0f : -1.0f;
    *next = (*plane - o) * inverse;
    if (*next > t)
        return;
    line_near near = line_plane(o, d, inverse, t);
    *plane = near.plane;
    *next = near.next;
}

/* Whether the place of a lattice has one. */
HD bool line_has_lattice(const line_job *job, int i)
{
    return scene_may(MAY_MANY) || i == 0 || job->cells;
}

/* Finds the planes beyond t, of the axes whose planes t has reached. */
HD void line_advance(line_job *job, float t)
{
    for (int i = 0; i < line_lattices(job); i++) {
        line_lattice *l = &job->lattice[i];
        if (!line_has_lattice(job, i))
            continue;
        line_pass_plane(l->o.x, l->d.x, l->inverse.x, t, &l->plane.x,
                        &l->next.x);
        line_pass_plane(l->o.y, l->d.y, l->inverse.y, t, &l->plane.y,
                        &l->next.y);
        line_pass_plane(l->o.z, l->d.z, l->inverse.z, t, &l->plane.z,
                        &l->next.z);
    }
}

HD float line_stop(const line_job *job, float t, float t_end)
{
    float stop = t_end;
    for (int i = 0; i < line_lattices(job); i++) {
        vec3 n = job->lattice[i].next;
        if (line_has_lattice(job, i))
            stop = hd_min(stop, hd_min(n.x, hd_min(n.y, n.z)));
    }
    return stop > t ? stop : t_end;
}

/* Whether a medium scatters of the field's light. */
HD bool line_scatters(const line_job *job, const flat_medium *m)
{
    return scene_may(MAY_FIELD) && job->scattered &&
           !rgb_is_black(may_gray(m->sigma_s));
}

/* The field's light as read cell by cell of any size. */
HD_APART radiance_sight line_light_apart(const flat_scene *s,
                                         const flat_medium *m, vec3 p, vec3 d)
{
    radiance_sight out;
    radiance_point x = radiance_at(s, p, m->kind);
    out.births = x.births;
    if (s->field.ball)
        out.light = x.eye;
    else if (s->field.lit)
        out.light = x.lit;
    else
        out.light = radiance_seen(s, &x, m->phase, m->g,
                                  vec3_scale(d, -1.0f));
    return out;
}

/* What a medium scatters of the field's light at p, per line_share. */
HD radiance_sight line_light(const flat_scene *s, const line_job *job,
                             const flat_medium *m, vec3 p)
{
    int place = scene_may(MAY_MANY) ? radiance_sight_place(&s->field, m->kind)
                                    : job->place;
    return place >= 0 && !s->field.refined
               ? radiance_sight_at(s, p, place)
               : line_light_apart(s, m, p, job->d);
}

/* Whether that is the same for all media of a kind. */
HD bool line_reads_alike(const flat_scene *s)
{
    const radiance_lattice *f = &s->field;
    return f->ball || f->eye >= 0 || f->flux < 0;
}

HD rgb line_share(const flat_scene *s, const flat_medium *m, rgb density)
{
    return s->field.ball ? rgb_gray(radiance_thickness(m, density))
                         : rgb_mul(m->sigma_s, density);
}

/* Whether births tell of emission. */
HD bool line_has_births(const flat_scene *s, const line_job *job)
{
    return scene_may(MAY_FIELD) && job->scattered && s->field.ball &&
           s->field.births;
}

/* Whether part i of the walk emits what is asked for. */
HD bool line_emits(const line_job *job, const media_walk *w, int i)
{
    return scene_may(MAY_EMISSION) && job->emission &&
           walk_part(w, i)->bound.rate != 0.0f;
}

/* The share of its emission q at p that counts. */
HD rgb line_glow(const flat_scene *s, const line_job *job,
                 const media_walk *w, int i, rgb q, vec3 p, float t)
{
    if (rgb_is_black(q))
        return q;
    return rgb_scale(q, glow_ray_share(s, walk_part(w, i)->medium, p, t,
                                       job->p_dir));
}

/* A point of a line outside of lattices: where there are any, it seldom is. */
HD_SHARED field_point line_outside(const flat_scene *s, const flat_medium *m,
                                   vec3 o, vec3 d, float t)
{
    return medium_point(s, m, vec3_mad(o, t, d));
}

/* Two of its points in part i of the walk. */
HD twin_point line_twin_point(const flat_scene *s, const line_job *job,
                              const media_walk *w, int i, float ta, float tb)
{
    const lattice_walk *part = walk_part(w, i);
    const flat_medium *m = walk_medium(s, w, i);
    field_point a, b;
    if (part->inside) {
        a = lattice_inside(s, part, vec3_mad(job->o, ta, job->d), ta);
        b = lattice_inside(s, part, vec3_mad(job->o, tb, job->d), tb);
    } else {
        a = line_outside(s, m, job->o, job->d, ta);
        b = line_outside(s, m, job->o, job->d, tb);
    }
    return twin_point_of(s, m, a, b);
}

HD bool line_part_empty(const lattice_walk *part)
{
    return part->bound.density == 0.0f && part->bound.rate == 0.0f;
}

/* The field is read where something comes of it alone. */
HD line_point line_at(const flat_scene *s, const line_job *job,
                      const media_walk *w, float t)
{
    line_point out;
    radiance_sight light = radiance_no_sight();
    int read = RADIANCE_ANYWHERE;
    bool births = line_has_births(s, job);
    out.sigma_t = out.source = rgb_gray(0.0f);
    vec3 p = vec3_mad(job->o, t, job->d);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (line_part_empty(walk_part(w, i)))
            continue;
        field_point x = lattice_point(s, walk_part(w, i), p, t);
        rgb density = medium_density(s, m, &x), q = rgb_gray(0.0f);
        out.sigma_t = rgb_add(out.sigma_t, rgb_mul(m->sigma_t, density));
        if (line_emits(job, w, i))
            q = line_glow(s, job, w, i, medium_source(s, m, &x, density), p,
                          t);
        bool scatters = line_scatters(job, m) && !rgb_is_black(density);
        if (read != m->kind &&
            (scatters || (births && !rgb_is_black(q)))) {
            light = line_light(s, job, m, p);
            read = line_reads_alike(s) ? m->kind : RADIANCE_ANYWHERE;
        }
        if (scatters)
            out.source = rgb_add(out.source,
                rgb_mul(light.light, line_share(s, m, density)));
        if (!rgb_is_black(q))
            out.source = rgb_add(out.source,
                                 births ? rgb_scale(q, light.births) : q);
    }
    return out;
}

/* The same at two points between planes; the field is read in their middle. */
HD line_twins line_at_twins(const flat_scene *s, const line_job *job,
                            const media_walk *w, float ta, float tb)
{
    line_twins out;
    radiance_sight light = radiance_no_sight();
    int read = RADIANCE_ANYWHERE;
    bool births = line_has_births(s, job);
    out.a.sigma_t = out.a.source = rgb_gray(0.0f);
    out.b = out.a;
    vec3 pa = vec3_mad(job->o, ta, job->d), pb = vec3_mad(job->o, tb, job->d);
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (line_part_empty(walk_part(w, i)))
            continue;
        twin_point x = line_twin_point(s, job, w, i, ta, tb);
        twin_rgb density = twin_density(s, m, &x), q;
        q.a = q.b = rgb_gray(0.0f);
        out.a.sigma_t = rgb_add(out.a.sigma_t, rgb_mul(m->sigma_t, density.a));
        out.b.sigma_t = rgb_add(out.b.sigma_t, rgb_mul(m->sigma_t, density.b));
        if (line_emits(job, w, i)) {
            q = twin_source(s, m, &x, &density);
            q.a = line_glow(s, job, w, i, q.a, pa, ta);
            q.b = line_glow(s, job, w, i, q.b, pb, tb);
        }
        bool scatters = line_scatters(job, m) &&
                        !(rgb_is_black(density.a) && rgb_is_black(density.b));
        bool emits = !rgb_is_black(q.a) || !rgb_is_black(q.b);
        if (read != m->kind && (scatters || (births && emits))) {
            light = line_light(s, job, m,
                               vec3_mad(job->o, 0.5f * (ta + tb), job->d));
            read = line_reads_alike(s) ? m->kind : RADIANCE_ANYWHERE;
        }
        if (scatters) {
            out.a.source = rgb_add(out.a.source,
                rgb_mul(light.light, line_share(s, m, density.a)));
            out.b.source = rgb_add(out.b.source,
                rgb_mul(light.light, line_share(s, m, density.b)));
        }
        float scale = births ? light.births : 1.0f;
        out.a.source = rgb_add(out.a.source, rgb_scale(q.a, scale));
        out.b.source = rgb_add(out.b.source, rgb_scale(q.b, scale));
    }
    return out;
}

HD bool line_piece_empty(const media_walk *w)
{
    for (int i = 0; i < walk_parts(w); i++)
        if (!line_part_empty(walk_part(w, i)))
            return false;
    return true;
}

/* Optical depth of a stretch, as far as the bounds tell. */
HD float line_depth(const flat_scene *s, const media_walk *w, float length)
{
    float sum = 0.0f;
    for (int i = 0; i < walk_parts(w); i++)
        sum += rgb_max(walk_medium(s, w, i)->sigma_t) *
               walk_part(w, i)->bound.density;
    return sum * length;
}

/* Samples per length of a line through a medium that is a function. */
HD float line_rate(const flat_medium *m, const lattice_walk *w)
{
    const float along = 12.0f;
    int most = m->cells[0] > m->cells[1] ? m->cells[0] : m->cells[1];
    most = most > m->cells[2] ? most : m->cells[2];
    return along * vec3_length(w->d) / (float)most;
}

/* The next place, in [0, 1), of those that fill it evenly. */
HD float line_place(float *jitter)
{
    const float golden = 0.61803399f;
    float at = *jitter;
    *jitter += golden;
    *jitter -= *jitter >= 1.0f ? 1.0f : 0.0f;
    return at;
}

/* From t on over `length`, by samples: one a part where next to nothing is
 * lost, as its square is what is wrong. */
HD void line_sample(const flat_scene *s, line_job *job, const media_walk *w,
                    float t, float length, line_integral *out)
{
    const float deep = 0.5f, most = 64.0f, thin = 1e-3f;
    float depth = line_depth(s, w, length);
    float rate = depth < thin ? job->rate : 0.5f * job->rate;
    int count = 1 + (int)hd_min(hd_max(depth / deep, rate * length), most);
    float part = length / (float)count;
    for (int i = 0; i < count; i++, t += part) {
        line_point a = line_at(s, job, w,
                               t + part * line_place(&job->jitter.first));
        if (depth < thin) {
            line_half(out, &a, part);
            continue;
        }
        line_point b = line_at(s, job, w,
                               t + part * line_place(&job->jitter.second));
        line_pair(out, &a, &b, part);
    }
}

/* Of a line through media: where it is in its walk's piece. A step goes to the
 * next plane of a lattice: on a GPU the threads of a warp take steps side by
 * side, however many each line has. */
typedef struct {
    line_job job;
    media_walk walk;
    float t;
} line_flight;

/* Whether the only medium takes as much of each channel. */
HD bool line_dims_evenly(const flat_scene *s)
{
    return SCENE_SOLE && line_is_even(s->sole.medium.sigma_t);
}

/* Adds the depth of two halves alone, as line_halves does. */
HD void line_dim(const flat_scene *s, const line_job *job, const media_walk *w,
                 float ta, float tb, float half, line_integral *out)
{
    rgb a = rgb_gray(0.0f), b = a;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(s, w, i);
        if (line_part_empty(walk_part(w, i)))
            continue;
        twin_point x = line_twin_point(s, job, w, i, ta, tb);
        twin_rgb density = twin_density(s, m, &x);
        a = rgb_add(a, rgb_mul(m->sigma_t, density.a));
        b = rgb_add(b, rgb_mul(m->sigma_t, density.b));
    }
    if (line_dims_evenly(s)) {
        line_deepen(out, (double)a.r * (double)half);
        line_deepen(out, (double)b.r * (double)half);
        return;
    }
    for (int c = 0; c < line_channels(); c++) {
        out->tau[c] += (double)rgb_get(a, c) * (double)half;
        out->tau[c] += (double)rgb_get(b, c) * (double)half;
    }
}

/* The first of Gauss's two points in [0, 1]: (1 - 1/sqrt 3) / 2. */
#define LINE_NODE 0.211324865f

/* From t on over `length`, between planes. */
HD void line_stretch(const flat_scene *s, line_job *job, const media_walk *w,
                     float t, float stop, line_integral *out)
{
    float length = stop - t, off = LINE_NODE * length;
    if (scene_may(MAY_FUNCTIONS) && job->sampled) {
        line_sample(s, job, w, t, length, out);
        return;
    }
    if (!job->emission && !job->scattered) {
        line_dim(s, job, w, t + off, stop - off, 0.5f * length, out);
        return;
    }
    line_twins x = line_at_twins(s, job, w, t + off, stop - off);
    line_halves(out, &x, 0.5f * length);
}

/* Whether there is nothing more in the current piece. */
HD bool line_passed_piece(const line_flight *f)
{
    return !(f->t < f->walk.t_end) || line_piece_empty(&f->walk);
}

/* To the beginning of the next. False: the line has ended. */
HD bool line_next_piece(const flat_scene *s, line_flight *f)
{
    if (!walk_next(s, &f->walk))
        return false;
    f->t = f->walk.t;
    return true;
}

/* The end of the stretch between planes from f->t on, in a piece in which there
 * is more. */
HD float line_find_stop(line_flight *f)
{
    line_advance(&f->job, f->t);
    return line_stop(&f->job, f->t, f->walk.t_end);
}

/* Finds the next stretch between planes that is not empty, from f->t to *stop.
 * False: the line has ended. */
HD bool line_next(const flat_scene *s, line_flight *f, float *stop)
{
    while (line_passed_piece(f))
        if (!line_next_piece(s, f))
            return false;
    *stop = line_find_stop(f);
    return true;
}

/* Adds the stretch from f->t on. */
HD void line_add_stretch(const flat_scene *s, line_flight *f, float stop,
                         line_integral *out)
{
    line_stretch(s, &f->job, &f->walk, f->t, stop, out);
    f->t = stop;
}

/* False: the line has ended. */
HD bool line_step(const flat_scene *s, line_flight *f, line_integral *out)
{
    float stop;
    if (!line_next(s, f, &stop))
        return false;
    line_add_stretch(s, f, stop, out);
    return true;
}

HD line_jitter line_jitter_make(float first, float second)
{
    line_jitter j;
    j.first = first;
    j.second = second;
    return j;
}

HD line_jitter line_jitter_draw(const flat_scene *s, rng *random)
{
    line_jitter j = line_jitter_make(0.5f, 0.5f);
    if (s->procedures_count > 0) {
        j.first = rng_float(random);
        j.second = rng_float(random);
    }
    return j;
}

/* What there is to be known of the media of a walk. */
HD void line_add_media(const flat_scene *s, line_flight *f)
{
    line_job *job = &f->job;
    job->lattices = 0;
    job->cells = false;
    job->place = radiance_sight_place(&s->field, 0);
    job->sampled = false;
    job->rate = 0.0f;
    for (int i = 0; !scene_may(MAY_MANY) && i < LINE_LATTICES; i++)
        line_no_lattice(&job->lattice[i]);
    for (int i = 0; i < walk_parts(&f->walk); i++) {
        const flat_medium *m = walk_medium(s, &f->walk, i);
        line_add_lattices(s, job, m);
        if (scene_may(MAY_FUNCTIONS) && m->sampled) {
            job->sampled = true;
            job->rate = hd_max(job->rate,
                               line_rate(m, walk_part(&f->walk, i)));
        }
    }
    if (job->scattered)
        line_add_field(s, job, f->walk.count == 1 ? walk_medium(s, &f->walk, 0)
                                                  : 0);
}

/* Begins the ray from t0 to t1 (finite) through the media of `set`; d of unit
 * length. False: there are none. */
HD bool line_begin(const flat_scene *s, const container_set *set, vec3 o,
                   vec3 d, float t0, float t1, float p_dir, bool emission,
                   bool scattered, line_jitter jitter, line_integral *out,
                   line_flight *f)
{
    walk_begin(s, &f->walk, set, true, o, d, t0, t1);
    out->overflow += f->walk.overflow;
    f->t = t0;
    if (f->walk.count == 0)
        return false;
    f->job.o = o;
    f->job.d = d;
    f->job.p_dir = p_dir;
    f->job.emission = emission;
    f->job.scattered = scene_may(MAY_FIELD) && scattered &&
                       s->field.numbers > 0;
    f->job.jitter = jitter;
    line_add_media(s, f);
    return true;
}

/* Adds that ray to `out`. Call with line_zero first; it can be continued over
 * further segments of the same ray. */
HD void line_integrate(const flat_scene *s, const container_set *set,
                       vec3 o, vec3 d, float t0, float t1, float p_dir,
                       bool emission, bool scattered, line_jitter jitter,
                       line_integral *out)
{
    line_flight f;
    bool more = line_begin(s, set, o, d, t0, t1, p_dir, emission, scattered,
                           jitter, out, &f);
    while (more)
        more = line_step(s, &f, out);
}

#endif
