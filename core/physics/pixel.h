/* pixel.h - one sample of one pixel, whole: what both backends loop over. */
#ifndef CORE_PHYSICS_PIXEL_H
#define CORE_PHYSICS_PIXEL_H
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/single.h"

/* Sums over samples. Halves of even and odd samples stand apart: their
 * difference tells the error (METHODS.md 10). */
typedef struct {
    double path[2][3];
    double line[2][3];
    double background[3];   /* part of line                                */
    double opacity[3];
    float depth;            /* of the first line, along the view direction */
} film_pixel;

/* What is asked of every pixel. */
typedef struct {
    int32_t width, height;
    uint64_t seed;
    uint32_t frame;
    int32_t path;           /* 0: nothing but the straight line gives light */
    int32_t lines;          /* 1: the straight line has noise too          */
} pixel_job;

/* The straight line needs no noise cut, only edges smoothed: it is run by all
 * of the first samples, then by every eighth. Where each sample has a field of
 * its own, by `all`. */
enum { PIXEL_LINES_FIRST = 4, PIXEL_LINES_EVERY = 8 };

HD bool pixel_has_line(uint32_t i, bool all)
{
    return all || i < PIXEL_LINES_FIRST || i % PIXEL_LINES_EVERY == 0u;
}

/* The half to which a sample's line counts: they alternate. */
HD int pixel_line_half(uint32_t i, bool all)
{
    return (int)(all || i < PIXEL_LINES_FIRST ? i & 1u
                                              : i / PIXEL_LINES_EVERY & 1u);
}

/* Lines of one half among the first n samples. */
HD uint32_t pixel_lines(uint32_t n, int half, bool all)
{
    if (all || n <= PIXEL_LINES_FIRST)
        return (n + (half == 0 ? 1u : 0u)) / 2u;
    uint32_t more = (n - 1u) / PIXEL_LINES_EVERY;   /* 8, 16, ... */
    return PIXEL_LINES_FIRST / 2u + (more + (half == 1 ? 1u : 0u)) / 2u;
}

HD bool pixel_finite(rgb c)
{
    return isfinite(c.r) && isfinite(c.g) && isfinite(c.b);
}

HD void pixel_sum(double out[3], rgb c)
{
    out[0] += (double)c.r;
    out[1] += (double)c.g;
    out[2] += (double)c.b;
}

HD void pixel_line(const flat_scene *s, const pixel_job *job, vec3 o, vec3 d,
                   const container_set *set, uint32_t sample, float along,
                   film_pixel *out, track_counters *count)
{
    march_result m = march_line(s, set, o, d, along);
    count->overflow += m.overflow;
    if (!pixel_finite(m.radiance) || !pixel_finite(m.opacity)) {
        count->rejected++;
        return;
    }
    pixel_sum(out->line[pixel_line_half(sample, job->lines != 0)], m.radiance);
    pixel_sum(out->background, m.background);
    pixel_sum(out->opacity, m.opacity);
    if (sample == 0u)
        out->depth = m.depth * vec3_dot(d, vec3_normalize(s->view.direction)) /
                     s->unit;
}

/* Containers of a ray's origin. */
HD void pixel_containers(const flat_scene *s, vec3 o, vec3 d,
                         container_set *set)
{
    if (s->view.orthographic || s->eye_on_face) {
        inside_find(s, inside_beside(o, d), set);
        return;
    }
    set->count = (int32_t)s->camera_containers_count;
    set->lost = 0;
    for (int i = 0; i < container_count(set); i++)
        set->shape[part_place(i)] = s->camera_containers[i];
}

/* Numbers of a sample that fill the unit cube evenly with those of the other
 * samples of its pixel, from a corner of their own [Roberts 2018]. Even and
 * odd samples go apart, so that their difference still tells the error. */
HD void pixel_spread(const pixel_job *job, uint64_t index, uint32_t i,
                     float u[3])
{
    rng corner = rng_make(job->seed, job->frame, 0xfffffffeu | (i & 1u), index);
    uint32_t n = i >> 1;
    uint32_t x = rng_u32(&corner) + n * 0xd1b54a33u;
    uint32_t y = rng_u32(&corner) + n * 0xabc98389u;
    uint32_t z = rng_u32(&corner) + n * 0x8cb92ba7u;
    u[0] = (float)(x >> 8) * 5.96046448e-08f;
    u[1] = (float)(y >> 8) * 5.96046448e-08f;
    u[2] = (float)(z >> 8) * 5.96046448e-08f;
}

/* The eye's ray of sample i of pixel (x, y), and where it starts; *along is
 * the sample's place in the third dimension. */
HD rng pixel_ray(const flat_scene *s, const pixel_job *job, int32_t x,
                 int32_t y, uint32_t i, vec3 *o, vec3 *d, container_set *set,
                 float *along)
{
    uint64_t index = (uint64_t)y * (uint64_t)job->width + (uint64_t)x;
    float spread[3];
    pixel_spread(job, index, i, spread);
    float u = ((float)x + spread[0]) / (float)job->width - 0.5f;
    float v = 0.5f - ((float)y + spread[1]) / (float)job->height;
    camera_ray(&s->view, u, v, o, d);
    pixel_containers(s, *o, *d, set);
    *along = spread[2];
    return rng_make(job->seed, job->frame, i, index);
}

/* The straight lines of samples [first, first + n) of pixel (x, y). */
HD void pixel_lines_run(const flat_scene *s, const pixel_job *job, int32_t x,
                        int32_t y, uint32_t first, uint32_t n,
                        film_pixel *out, track_counters *count)
{
    for (uint32_t i = first; i < first + n; i++) {
        vec3 o, d;
        float along;
        container_set set;
        if (!pixel_has_line(i, job->lines != 0))
            continue;
        pixel_ray(s, job, x, y, i, &o, &d, &set, &along);
        pixel_line(s, job, o, d, &set, i, along, out, count);
    }
}

HD void pixel_begin(const flat_scene *s, const pixel_job *job, int32_t x,
                    int32_t y, uint32_t i, path_state *path,
                    track_counters *count)
{
    vec3 o, d;
    float along;
    container_set set;
    rng random = pixel_ray(s, job, x, y, i, &o, &d, &set, &along);
    path_begin(path, o, d, &set, true, random);
    path->along = along;
    count->paths++;
}

HD void pixel_end(const path_state *path, uint32_t i, film_pixel *out,
                  track_counters *count)
{
    if (pixel_finite(path->radiance))
        pixel_sum(out->path[i & 1u], path->radiance);
    else
        count->rejected++;
}

/* The paths of samples [first, first + n) of pixel (x, y), in order. One loop
 * over segments, not paths: on a GPU a thread whose path has ended takes up
 * its next one while its neighbours go on with theirs. */
HD void pixel_paths_run(const flat_scene *s, const pixel_job *job, int32_t x,
                        int32_t y, uint32_t first, uint32_t n,
                        film_pixel *out, track_counters *count)
{
    path_state path;
    bool alive = false;
    uint32_t i = first;
    if (!job->path) {
        count->paths += n;
        return;
    }
    while (alive || i < first + n) {
        if (!alive)
            pixel_begin(s, job, x, y, i++, &path, count);
        alive = single_segment(s, &path, count);
        if (!alive)
            pixel_end(&path, i - 1u, out, count);
    }
}

#endif
