/* line.h - absorption and emission along a ray.
 *
 * The ray is cut at the voxel planes of every grid it reads. Between them a
 * trilinear density is a cubic along the ray, which the two-point Gauss rule
 * integrates exactly; the source is taken as constant over each half of the
 * piece, attenuated within it (METHODS.md 1.5, 1.6). Homogeneous media come
 * out in closed form.
 *
 * A density that is a function has no planes at which it is known: rays
 * through such media take one sample at a jittered place of each cell of the
 * majorants and each voxel, more in thick ones. Emission is then unbiased, but
 * for what half the variance of the optical depth before it makes of the
 * transmittance: of parts of depth D at most D^2 / 8 each. */
#ifndef CORE_PHYSICS_LINE_H
#define CORE_PHYSICS_LINE_H
#include "core/physics/fmath.h"
#include "core/physics/glow.h"
#include "core/physics/radiance.h"
#include "core/physics/rng.h"
#include "core/physics/walk.h"

/* The last is the field's. Where there is one more at most, each has a place
 * of its own and a GPU keeps both in registers. */
enum { LINE_LATTICES = (SCENE_MAY & MAY_MANY)    ? 20
                       : (SCENE_MAY & MAY_FIELD) ? 2 : 1 };

typedef struct {
    double tau[3];          /* optical depth: long sums, so double         */
    rgb radiance;           /* emitted toward the ray's origin, attenuated */
    uint32_t overflow;      /* media that were left out                    */
} line_integral;

/* A voxel lattice along the ray. */
typedef struct {
    vec3 o, d, inverse;
    vec3 next;              /* distances of the next plane of each axis    */
} line_lattice;

typedef struct {
    const flat_scene *s;
    vec3 o, d;
    float p_dir;            /* see glow_ray_share                          */
    bool emission;          /* the radiance is wanted                      */
    bool scattered;         /* ... and what the field's light gives        */
    bool sampled;           /* some density is a function                  */
    float jitter;           /* in [0, 1): place of the next sample         */
    int lattices;
    line_lattice lattice[LINE_LATTICES];
} line_job;

typedef struct {
    rgb sigma_t, source;
} line_point;

/* One without planes. */
HD void line_no_lattice(line_lattice *l)
{
    l->o = l->d = l->inverse = vec3_make(0.0f, 0.0f, 0.0f);
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
    l->next = vec3_make(-INFINITY, -INFINITY, -INFINITY);
}

HD void line_add_lattices(line_job *job, const flat_medium *m)
{
    int room = scene_may(MAY_MANY) ? LINE_LATTICES - 1 - job->lattices : 1;
    int planes = part_bound(m->planes);
    for (int i = 0; i < planes && i < room; i++) {
        const flat_field *f = &job->s->fields[m->plane_field[i]];
        float shift = job->s->grids[f->grid].nearest ? 0.5f : 0.0f;
        line_add_lattice(job, 0,
                         vec3_add(affine_point(&f->to_index, job->o),
                                  vec3_make(shift, shift, shift)),
                         affine_vector(&f->to_index, job->d));
    }
}

/* The light of the field is read once a cell, at least. */
HD void line_add_field(line_job *job)
{
    const radiance_lattice *f = &job->s->field;
    vec3 o = vec3_sub(job->o, vec3_make(f->origin[0], f->origin[1],
                                        f->origin[2]));
    line_add_lattice(job, LINE_LATTICES - 1, vec3_scale(o, 1.0f / f->side),
                     vec3_scale(job->d, 1.0f / f->side));
}

HD int line_lattices(const line_job *job)
{
    return scene_may(MAY_MANY) ? job->lattices : (int)LINE_LATTICES;
}

/* Distance of the first plane of one axis beyond t; none beyond 2^30 voxels
 * from the grid's origin, where the spacing of floats is over 64 voxels. */
HD float line_plane(float o, float d, float inverse, float t)
{
    float x = o + t * d;
    if (d == 0.0f || !(fabsf(x) < 1073741824.0f))
        return INFINITY;
    int at = hd_floor(x);
    float plane = (float)(d > 0.0f ? at + 1 : (float)at == x ? at - 1 : at);
    float next = (plane - o) * inverse;
    return next > t ? next
                    : (plane + (d > 0.0f ? 1.0f : -1.0f) - o) * inverse;
}

/* Finds the planes beyond t, of the axes whose planes t has reached. */
HD void line_advance(line_job *job, float t)
{
    for (int i = 0; i < line_lattices(job); i++) {
        line_lattice *l = &job->lattice[i];
        if (!(l->next.x > t))
            l->next.x = line_plane(l->o.x, l->d.x, l->inverse.x, t);
        if (!(l->next.y > t))
            l->next.y = line_plane(l->o.y, l->d.y, l->inverse.y, t);
        if (!(l->next.z > t))
            l->next.z = line_plane(l->o.z, l->d.z, l->inverse.z, t);
    }
}

HD float line_stop(const line_job *job, float t, float t_end)
{
    float stop = t_end;
    for (int i = 0; i < line_lattices(job); i++) {
        vec3 n = job->lattice[i].next;
        stop = hd_min(stop, hd_min(n.x, hd_min(n.y, n.z)));
    }
    return stop > t ? stop : t_end;
}

/* Radiance per length that the media scatter of the field's light. */
HD rgb line_scattered(const line_job *job, const flat_medium *m,
                      const radiance_point *light, rgb density)
{
    rgb in = radiance_seen(job->s, light, m->phase, m->g,
                           vec3_scale(job->d, -1.0f));
    return rgb_mul(in, rgb_mul(m->sigma_s, density));
}

HD line_point line_at(const line_job *job, const media_walk *w, float t)
{
    line_point out;
    radiance_point light;
    bool read = false;
    out.sigma_t = out.source = rgb_gray(0.0f);
    vec3 p = vec3_mad(job->o, t, job->d);
    rgb ball = rgb_gray(0.0f);
    if (scene_may(MAY_FIELD) && job->scattered && job->s->field.ball)
        ball = radiance_at(job->s, p, true).eye;
    if (!job->s->field.thick)
        out.source = ball;
    for (int i = 0; i < walk_parts(w); i++) {
        const flat_medium *m = walk_medium(job->s, w, i);
        const majorant_cell *bound = &walk_part(w, i)->bound;
        if (bound->density == 0.0f && bound->rate == 0.0f)
            continue;
        field_point x = lattice_point(job->s, walk_part(w, i), p, t);
        rgb density = medium_density(job->s, m, &x);
        out.sigma_t = rgb_add(out.sigma_t, rgb_mul(m->sigma_t, density));
        if (scene_may(MAY_FIELD) && job->s->field.thick)
            out.source = rgb_add(out.source, rgb_scale(ball,
                radiance_thickness(job->s, m, density)));
        if (scene_may(MAY_FIELD) && job->scattered && !job->s->field.ball &&
            !rgb_is_black(density) && !rgb_is_black(m->sigma_s)) {
            if (!read)
                light = radiance_at(job->s, p, true);
            read = true;
            out.source = rgb_add(out.source,
                                 line_scattered(job, m, &light, density));
        }
        if (!scene_may(MAY_EMISSION) || !job->emission || bound->rate == 0.0f)
            continue;
        rgb q = medium_source(job->s, m, &x, density);
        if (!rgb_is_black(q))
            q = rgb_scale(q, glow_ray_share(job->s, walk_part(w, i)->medium, p,
                                            t, job->p_dir));
        out.source = rgb_add(out.source, q);
    }
    return out;
}

/* Int_0^length exp(-sigma x) dx, good down to sigma = 0. */
HD float line_reach(float sigma, float length)
{
    float tau = sigma * length;
    return tau < 1e-4f ? length * (1.0f - 0.5f * tau)
                       : -fm_expm1(-tau) / sigma;
}

HD float line_half_channel(float source, float sigma, float length,
                           double *tau)
{
    float transmittance = fm_exp((float)-*tau);
    *tau += (double)sigma * (double)length;
    return source == 0.0f ? 0.0f
                          : transmittance * source * line_reach(sigma, length);
}

/* Adds one half piece of constant coefficients. */
HD void line_half(line_integral *out, const line_point *p, float length)
{
    out->radiance.r += line_half_channel(p->source.r, p->sigma_t.r, length,
                                         &out->tau[0]);
    out->radiance.g += line_half_channel(p->source.g, p->sigma_t.g, length,
                                         &out->tau[1]);
    out->radiance.b += line_half_channel(p->source.b, p->sigma_t.b, length,
                                         &out->tau[2]);
}

HD bool line_piece_empty(const media_walk *w)
{
    for (int i = 0; i < walk_parts(w); i++) {
        const majorant_cell *bound = &walk_part(w, i)->bound;
        if (bound->density != 0.0f || bound->rate != 0.0f)
            return false;
    }
    return true;
}

/* Optical depth of a stretch, as far as the bounds tell. */
HD float line_depth(const line_job *job, const media_walk *w, float length)
{
    float sum = 0.0f;
    for (int i = 0; i < walk_parts(w); i++)
        sum += rgb_max(walk_medium(job->s, w, i)->sigma_t) *
               walk_part(w, i)->bound.density;
    return sum * length;
}

/* From t on over `length`, by samples. */
HD void line_sample(line_job *job, const media_walk *w, float t, float length,
                    line_integral *out)
{
    const float deep = 0.1f, most = 64.0f, golden = 0.61803399f;
    float parts = hd_min(line_depth(job, w, length) / deep, most);
    int count = 1 + (int)parts;
    float part = length / (float)count;
    for (int i = 0; i < count; i++) {
        line_point x = line_at(job, w, t + part * ((float)i + job->jitter));
        line_half(out, &x, part);
        job->jitter += golden;
        job->jitter -= job->jitter >= 1.0f ? 1.0f : 0.0f;
    }
}

HD void line_piece(line_job *job, const media_walk *w,
                   line_integral *out)
{
    const float node = 0.211324865f;    /* (1 - 1/sqrt 3) / 2 */
    float t = w->t;
    while (t < w->t_end) {
        line_advance(job, t);
        float stop = line_stop(job, t, w->t_end), length = stop - t;
        if (scene_may(MAY_FUNCTIONS) && job->sampled) {
            line_sample(job, w, t, length, out);
            t = stop;
            continue;
        }
        line_point a = line_at(job, w, t + node * length);
        line_point b = line_at(job, w, stop - node * length);
        line_half(out, &a, 0.5f * length);
        line_half(out, &b, 0.5f * length);
        t = stop;
    }
}

HD float line_jitter(const flat_scene *s, rng *random)
{
    return s->procedures_count > 0 ? rng_float(random) : 0.5f;
}

HD line_integral line_zero(void)
{
    line_integral line;
    line.tau[0] = line.tau[1] = line.tau[2] = 0.0;
    line.radiance = rgb_gray(0.0f);
    line.overflow = 0;
    return line;
}

/* Adds the ray from t0 to t1 (finite) through the media of `set` to `out`; d
 * of unit length; jitter in [0, 1). Call with line_zero first; it can be
 * continued over further segments of the same ray. */
HD void line_integrate(const flat_scene *s, const container_set *set,
                       vec3 o, vec3 d, float t0, float t1, float p_dir,
                       bool emission, bool scattered, float jitter,
                       line_integral *out)
{
    media_walk w;
    walk_begin(s, &w, set, true, o, d, t0, t1);
    out->overflow += w.overflow;
    if (w.count == 0)
        return;
    line_job job;
    job.s = s;
    job.o = o;
    job.d = d;
    job.p_dir = p_dir;
    job.emission = emission;
    job.scattered = scene_may(MAY_FIELD) && scattered &&
                    s->field.numbers > 0;
    job.lattices = 0;
    job.jitter = jitter;
    job.sampled = false;
    for (int i = 0; !scene_may(MAY_MANY) && i < LINE_LATTICES; i++)
        line_no_lattice(&job.lattice[i]);
    for (int i = 0; i < walk_parts(&w); i++) {
        const flat_medium *m = walk_medium(s, &w, i);
        line_add_lattices(&job, m);
        job.sampled = job.sampled || m->sampled != 0;
    }
    if (job.scattered)
        line_add_field(&job);
    do {
        if (!line_piece_empty(&w))
            line_piece(&job, &w, out);
    } while (walk_next(s, &w));
}

HD rgb line_transmittance(const line_integral *l)
{
    return rgb_make(fm_exp((float)-l->tau[0]), fm_exp((float)-l->tau[1]),
                    fm_exp((float)-l->tau[2]));
}

/* 1 - transmittance, exact where it is tiny. */
HD rgb line_opacity(const line_integral *l)
{
    return rgb_make(-fm_expm1((float)-l->tau[0]),
                    -fm_expm1((float)-l->tau[1]),
                    -fm_expm1((float)-l->tau[2]));
}

#endif
