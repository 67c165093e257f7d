/* pixel.h - one sample of one pixel, whole: what both backends loop over. */
#ifndef CORE_PHYSICS_PIXEL_H
#define CORE_PHYSICS_PIXEL_H
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/single.h"
#include "core/physics/sobol.h"

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
 * its own, or functions are sampled and it shows, by `all`. */
enum { PIXEL_LINES_FIRST = 4, PIXEL_LINES_EVERY = 8 };

HD bool pixel_has_line(uint32_t i, bool all)
{
    return all || i < PIXEL_LINES_FIRST || i % PIXEL_LINES_EVERY == 0u;
}

/* Which of the points of one half of the samples, or lines. */
typedef struct {
    uint32_t half, number;
} pixel_place;

HD pixel_place pixel_sample_place(uint32_t i)
{
    pixel_place p;
    p.half = i & 1u;
    p.number = i >> 1;
    return p;
}

/* Of a sample's line. Halves alternate in the order of lines. */
HD pixel_place pixel_line_place(uint32_t i, bool all)
{
    if (all || i < PIXEL_LINES_FIRST)
        return pixel_sample_place(i);
    uint32_t later = i / PIXEL_LINES_EVERY;     /* from 1 on: the odd half */
    pixel_place p = pixel_sample_place(later - 1u);
    p.half ^= 1u;
    p.number += PIXEL_LINES_FIRST / 2u;
    return p;
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

HD void pixel_line(const flat_scene *s, vec3 o, vec3 d,
                   const container_set *set, uint32_t sample, uint32_t half,
                   float along, film_pixel *out, track_counters *count)
{
    march_result m = march_line(s, set, o, d, along);
    count->overflow += m.overflow;
    if (!pixel_finite(m.radiance) || !pixel_finite(m.opacity)) {
        count->rejected++;
        return;
    }
    pixel_sum(out->line[half], m.radiance);
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

/* Three numbers that fill the unit cube evenly with those of the same half of
 * the pixel's samples. The halves are apart, so that their difference tells
 * the error. */
HD void pixel_spread(const pixel_job *job, uint64_t index, pixel_place at,
                     float u[SOBOL_DIMENSIONS])
{
    rng seed = rng_make(job->seed, job->frame, 0xfffffffeu | at.half, index);
    uint32_t x[SOBOL_DIMENSIONS];
    sobol_point(at.number, x);
    for (int i = 0; i < SOBOL_DIMENSIONS; i++)
        u[i] = sobol_float(sobol_scramble(x[i], rng_u32(&seed)));
}

/* An eye's ray of pixel (x, y), and where it starts; *along is its place in
 * the third dimension. */
HD void pixel_ray(const flat_scene *s, const pixel_job *job, int32_t x,
                  int32_t y, pixel_place at, vec3 *o, vec3 *d,
                  container_set *set, float *along)
{
    uint64_t index = (uint64_t)y * (uint64_t)job->width + (uint64_t)x;
    float spread[SOBOL_DIMENSIONS];
    pixel_spread(job, index, at, spread);
    float u = ((float)x + spread[0]) / (float)job->width - 0.5f;
    float v = 0.5f - ((float)y + spread[1]) / (float)job->height;
    camera_ray(&s->view, u, v, o, d);
    pixel_containers(s, *o, *d, set);
    *along = spread[2];
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
        pixel_place at = pixel_line_place(i, job->lines != 0);
        pixel_ray(s, job, x, y, at, &o, &d, &set, &along);
        pixel_line(s, o, d, &set, i, at.half, along, out, count);
    }
}

HD void pixel_begin(const flat_scene *s, const pixel_job *job, int32_t x,
                    int32_t y, uint32_t i, path_state *path,
                    track_counters *count)
{
    vec3 o, d;
    float along;
    container_set set;
    uint64_t index = (uint64_t)y * (uint64_t)job->width + (uint64_t)x;
    pixel_ray(s, job, x, y, pixel_sample_place(i), &o, &d, &set, &along);
    rng random = rng_make(job->seed, job->frame, i, index);
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
