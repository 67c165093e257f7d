/* pixel.h - one sample of one pixel, whole: what both backends loop over. */
#ifndef CORE_PHYSICS_PIXEL_H
#define CORE_PHYSICS_PIXEL_H
#include "core/physics/inside.h"
#include "core/physics/march.h"
#include "core/physics/single.h"
#include "core/physics/sobol.h"

/* Vertices of a path whose numbers are spread over a pixel's samples. */
enum { PIXEL_SPREAD = 2 };

/* Sums over samples. Two halves of them stand apart: their difference tells
 * the error (METHODS.md 10). */
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
    int32_t single;         /* 1: one sample a pixel is all there will be  */
    uint32_t share;         /* so many samples see the same field          */
} pixel_job;

/* The straight line needs no noise cut, only edges smoothed: it is run by all
 * of the first samples, then by every eighth. Where each sample has a field of
 * its own, or functions are sampled and it shows, by `all`. */
enum { PIXEL_LINES_FIRST = 4, PIXEL_LINES_EVERY = 8 };

/* The half that sample, or line, number n is counted in. Of each two that
 * follow one another one is; and as the second, fifth, eighth ... of the
 * number's digits do not tell, each rectangle of a pixel (sobol.h) that has
 * four of the first 2^k points has two of each half. So an edge parts the
 * halves less and less; by most other digits they lie in a checkerboard of a
 * few squares, however many points there are, and part as those do. */
HD uint32_t pixel_half(uint32_t n)
{
    n &= 0x6db6db6du;
    n ^= n >> 16;
    n ^= n >> 8;
    n ^= n >> 4;
    n ^= n >> 2;
    n ^= n >> 1;
    return n & 1u;
}

/* Samples of one half among the first n. */
HD uint32_t pixel_samples(uint32_t n, uint32_t half)
{
    return n / 2u + ((n & 1u) && pixel_half(n - 1u) == half ? 1u : 0u);
}

/* The same where `share` samples see one field, and are of one half. */
HD uint32_t pixel_shared(uint32_t n, uint32_t share, uint32_t half)
{
    uint32_t fields = n / share;
    return share * pixel_samples(fields, half) +
           (pixel_half(fields) == half ? n % share : 0u);
}

/* Lines among the first n samples. */
HD uint32_t pixel_lines(uint32_t n, bool all)
{
    return all || n <= PIXEL_LINES_FIRST
         ? n : PIXEL_LINES_FIRST + (n - 1u) / PIXEL_LINES_EVERY;
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

/* Adds line `number` of all lines, along d. */
HD void pixel_add_line(const flat_scene *s, const pixel_job *job,
                       uint32_t number, vec3 d, const march_result *m,
                       film_pixel *out, track_counters *count)
{
    uint32_t half = pixel_half(number / job->share);
    count->overflow += m->overflow;
    if (!pixel_finite(m->radiance) || !pixel_finite(m->opacity)) {
        count->rejected++;
        return;
    }
    pixel_sum(out->line[half], m->radiance);
    pixel_sum(out->background, m->background);
    pixel_sum(out->opacity, m->opacity);
    if (number == 0u)
        out->depth = m->depth *
                     vec3_dot(d, vec3_normalize(s->view.direction)) / s->unit;
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

/* Where an eye's ray is, in [0, 1): of the pixel, and of what is left to its
 * own samples along it. */
typedef struct {
    float x, y;
    line_jitter along;
} pixel_place;

/* Places that fill the unit cube evenly with those of the pixel's other
 * samples. As both halves do so together, their difference tells rather more
 * than the error where it comes of edges, never less. A single sample is in
 * the middle: nearest to the pixel's mean. */
HD pixel_place pixel_spread(const pixel_job *job, uint64_t index,
                            uint32_t number)
{
    rng seed = rng_make(job->seed, job->frame, 0xffffffffu, index);
    uint32_t x[SOBOL_DIMENSIONS];
    float u[SOBOL_DIMENSIONS];
    pixel_place p;
    sobol_point(number, x);
    for (int i = 0; i < SOBOL_DIMENSIONS; i++)
        u[i] = sobol_float(sobol_scramble(x[i], rng_u32(&seed)));
    p.x = job->single ? 0.5f : u[0];
    p.y = job->single ? 0.5f : u[1];
    p.along = line_jitter_make(u[2], sobol_float(
        sobol_scramble(x[2], rng_u32(&seed))));
    return p;
}

HD uint64_t pixel_index(const pixel_job *job, int32_t x, int32_t y)
{
    return (uint64_t)y * (uint64_t)job->width + (uint64_t)x;
}

/* The first of the places along the ray alone. */
HD float pixel_along(const pixel_job *job, uint64_t index, uint32_t number)
{
    rng seed = rng_make(job->seed, job->frame, 0xffffffffu, index);
    uint32_t x[SOBOL_DIMENSIONS];
    sobol_point(number, x);
    rng_u32(&seed);
    rng_u32(&seed);
    return sobol_float(sobol_scramble(x[2], rng_u32(&seed)));
}

/* An eye's ray of pixel (x, y), and where it starts. */
HD void pixel_ray(const flat_scene *s, const pixel_job *job, int32_t x,
                  int32_t y, uint32_t number, vec3 *o, vec3 *d,
                  container_set *set, line_jitter *along)
{
    pixel_place at = pixel_spread(job, pixel_index(job, x, y), number);
    float u = ((float)x + at.x) / (float)job->width - 0.5f;
    float v = 0.5f - ((float)y + at.y) / (float)job->height;
    camera_ray(&s->view, u, v, o, d);
    pixel_containers(s, *o, *d, set);
    *along = at.along;
}

/* Straight lines of a pixel's samples, one after the other, in steps: what is
 * next of them. */
enum { PIXEL_TAKES, PIXEL_SEEKS, PIXEL_STEPS, PIXEL_LANDS, PIXEL_ADDS,
       PIXEL_ENDS };

typedef struct {
    int32_t next;           /* PIXEL_*                                     */
    int32_t x, y;
    uint32_t number, end;   /* of the line that is on, and beyond the last's */
    uint32_t apart;         /* from one line's to the next one's           */
    march_state march;
} pixel_liner;

/* Of pixel (x, y): every apart-th of its lines from number `first` on. */
HD void pixel_lines_begin(pixel_liner *l, int32_t x, int32_t y,
                          uint32_t first, uint32_t end, uint32_t apart)
{
    l->next = first < end ? PIXEL_TAKES : PIXEL_ENDS;
    l->x = x;
    l->y = y;
    l->number = first;
    l->end = end;
    l->apart = apart;
}

HD void pixel_take(const flat_scene *s, const pixel_job *job, pixel_liner *l)
{
    vec3 o, d;
    line_jitter along;
    container_set set;
    pixel_ray(s, job, l->x, l->y, l->number, &o, &d, &set, &along);
    march_begin(&l->march, &set, o, d, along);
    l->march.plate = plate_seen(s, pixel_index(job, l->x, l->y), d);
    l->next = PIXEL_SEEKS;
}

HD void pixel_seek(const flat_scene *s, pixel_liner *l)
{
    l->next = march_seek(s, &l->march) ? PIXEL_STEPS : PIXEL_LANDS;
}

HD void pixel_step(const flat_scene *s, pixel_liner *l)
{
    if (!march_step(s, &l->march))
        l->next = PIXEL_LANDS;
}

HD void pixel_land(const flat_scene *s, pixel_liner *l)
{
    l->next = march_land(s, &l->march) ? PIXEL_SEEKS : PIXEL_ADDS;
}

/* The line has been added. */
HD void pixel_pass(pixel_liner *l)
{
    l->number += l->apart;
    l->next = l->number < l->end ? PIXEL_TAKES : PIXEL_ENDS;
}

/* Those of samples [first, first + n). */
HD void pixel_lines_run(const flat_scene *s, const pixel_job *job, int32_t x,
                        int32_t y, uint32_t first, uint32_t n,
                        film_pixel *out, track_counters *count)
{
    pixel_liner l;
    bool all = job->lines != 0;
    pixel_lines_begin(&l, x, y, pixel_lines(first, all),
                      pixel_lines(first + n, all), 1u);
    while (l.next != PIXEL_ENDS)
        if (l.next == PIXEL_TAKES) {
            pixel_take(s, job, &l);
        } else if (l.next == PIXEL_SEEKS) {
            pixel_seek(s, &l);
        } else if (l.next == PIXEL_STEPS) {
            pixel_step(s, &l);
        } else if (l.next == PIXEL_LANDS) {
            pixel_land(s, &l);
        } else {
            march_result m = march_end(s, &l.march);
            pixel_add_line(s, job, l.number, l.march.d, &m, out, count);
            pixel_pass(&l);
        }
}

HD void pixel_begin(const flat_scene *s, const pixel_job *job, int32_t x,
                    int32_t y, uint32_t i, path_state *path,
                    plate_view *plate, track_counters *count)
{
    vec3 o, d;
    line_jitter along;
    container_set set;
    uint64_t index = pixel_index(job, x, y);
    pixel_ray(s, job, x, y, i, &o, &d, &set, &along);
    rng random = rng_make(job->seed, job->frame, i, index);
    path_begin(path, o, d, &set, true, random);
    *plate = plate_seen(s, index, d);
    path->along = along.first;
    path->spread = PIXEL_SPREAD;
    count->paths++;
}

HD void pixel_end(rgb radiance, uint32_t half, film_pixel *out,
                  track_counters *count)
{
    if (pixel_finite(radiance))
        pixel_sum(out->path[half], radiance);
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
    plate_view plate = plate_none();
    bool alive = false;
    uint32_t i = first;
    if (!job->path) {
        count->paths += n;
        return;
    }
    while (alive || i < first + n) {
        if (!alive)
            pixel_begin(s, job, x, y, i++, &path, &plate, count);
        alive = single_segment(s, &path, &plate, count);
        if (!alive)
            pixel_end(path.radiance, pixel_half((i - 1u) / job->share), out,
                      count);
    }
}

#endif
