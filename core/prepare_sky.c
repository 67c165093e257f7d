/* The sky, as what is seen and as a light (physics/sky.h). A sky that is a
 * function is asked for its radiance; the texels by which it is chosen as a
 * light are averages of it, fine enough for what it shows. */
#define PHYSICS_DOUBLE
#include "core/function.h"
#include <math.h>
#include <stdlib.h>
#include "core/prepare.h"
#include "lib/memory.h"
#include "lib/thread.h"

#define PI 3.14159265358979323846

/* Rows of texels of a function, at first and at most; and how far points may
 * be from their texel's mean, of the mean of all. */
enum { LEAST_ROWS = 32, MOST_ROWS = 512 };
#define SKY_DETAIL 0.1

static const float *texel(const struct brume_sky *sky, int x, int y)
{
    x = (x + sky->width) % sky->width;
    y = y < 0 ? 0 : y >= sky->height ? sky->height - 1 : y;
    return sky->radiance + 3 * ((size_t)y * (size_t)sky->width + (size_t)x);
}

static double luminance(const float *c)
{
    return 0.2126 * (double)c[0] + 0.7152 * (double)c[1] +
           0.0722 * (double)c[2];
}

/* Interpolated, a texel's area takes part of its neighbours. */
static double brightness(const struct brume_sky *sky, int x, int y)
{
    if (!sky->interpolate)
        return luminance(texel(sky, x, y));
    double sum = 0.0;
    for (int i = 0; i < 9; i++)
        sum += luminance(texel(sky, x + i % 3 - 1, y + i / 3 - 1));
    return sum / 9.0;
}

static double row_angle(const struct brume_sky *sky, int y)
{
    double band = PI / sky->height;
    return 2.0 * PI / sky->width * (cos(y * band) - cos((y + 1) * band));
}

/* What each texel is chosen for, times its solid angle; the sum of all. */
static double weigh(const struct brume_sky *sky, double *weight)
{
    double mean = 0.0, sum = 0.0;
    for (int y = 0; y < sky->height; y++)
        for (int x = 0; x < sky->width; x++)
            mean += luminance(texel(sky, x, y)) * row_angle(sky, y);
    mean /= 4.0 * PI;
    for (int y = 0; y < sky->height; y++)
        for (int x = 0; x < sky->width; x++) {
            double above = brightness(sky, x, y) - mean;
            *weight = above > 1e-6 * mean ? above * row_angle(sky, y) : 0.0;
            sum += *weight++;
        }
    return sum;
}

/* Vose's alias table: each light column is filled up by a heavy one. `list`
 * holds the light columns from below, the heavy ones from above. */
static void make_aliases(sky_texel *t, double *share, uint32_t *list,
                         uint32_t n)
{
    uint32_t light = 0, heavy = n;
    for (uint32_t i = 0; i < n; i++) {
        t[i].keep = 1.0f;
        t[i].alias = i;
        if (share[i] < 1.0)
            list[light++] = i;
        else
            list[--heavy] = i;
    }
    while (light > 0 && heavy < n) {
        uint32_t i = list[--light], j = list[heavy];
        t[i].keep = (float)share[i];
        t[i].alias = j;
        share[j] -= 1.0 - share[i];
        if (share[j] < 1.0) {
            heavy++;
            list[light++] = j;
        }
    }
}

static bool choose_texels(const struct brume_sky *sky, flat_sky *out,
                          sky_texel *t, struct brume_error *err)
{
    size_t n = (size_t)sky->width * (size_t)sky->height;
    double *weight = memory_new(n, sizeof *weight, err);
    uint32_t *list = memory_new(n, sizeof *list, err);
    if (weight && list) {
        double sum = weigh(sky, weight);
        out->lights = sum > 0.0;
        for (size_t i = 0; sum > 0.0 && i < n; i++) {
            weight[i] /= sum;
            t[i].density = (float)(weight[i] /
                                   row_angle(sky, (int)i / sky->width));
            weight[i] *= (double)n;
        }
        if (sum > 0.0)
            make_aliases(t, weight, list, (uint32_t)n);
    }
    free(weight);
    free(list);
    return weight && list;
}

static void set_directions(const struct brume_sky *sky, flat_sky *out)
{
    matrix from = matrix_from(sky->transform), to;
    matrix_invert(&from, &to);
    out->from_map = matrix_affine(&from);
    out->to_map = matrix_affine(&to);
    out->jacobian = (float)fabs(matrix_determinant(&to));
}

/* Without texels where none is to be chosen. */
static bool add_texels(const struct prepare *job, const struct brume_sky *sky,
                       flat_sky *out, struct brume_error *err)
{
    size_t n = (size_t)sky->width * (size_t)sky->height;
    sky_texel *t = FLAT_EXTEND(job->flat, sky_texels, n, err);
    if (!t)
        return false;
    out->width = sky->width;
    out->height = sky->height;
    out->smooth = sky->interpolate;
    set_directions(sky, out);
    for (size_t i = 0; i < n; i++)
        t[i].radiance = rgb_make(
            (float)(sky->radiance[3 * i] * sky->scale),
            (float)(sky->radiance[3 * i + 1] * sky->scale),
            (float)(sky->radiance[3 * i + 2] * sky->scale));
    return choose_texels(sky, out, t, err);
}

/* ---- a function as a sky ----------------------------------------------- */

struct sky_points {
    const brume_scene *scene;
    int width, height; /* of the points: two by two in a texel      */
    float *radiance;
};

static void fill_row(void *context, size_t row, int thread)
{
    (void)thread;
    const struct sky_points *p = context;
    machine m = function_machine(p->scene);
    double polar = PI * ((double)row + 0.5) / p->height;
    float *out = p->radiance + 3 * row * (size_t)p->width;
    for (int x = 0; x < p->width; x++, out += 3) {
        double azimuth = 2.0 * PI * ((x + 0.5) / p->width - 0.5);
        double r[MACHINE_REGISTERS] = {sin(polar) * sin(azimuth), cos(polar),
                                       sin(polar) * cos(azimuth)};
        bool known = machine_run(&m, p->scene->sky.function, r);
        for (int c = 0; c < 3; c++)
            out[c] = known && r[c] > 0.0 && r[c] < 1e30 ? (float)r[c] : 0.0f;
    }
}

static const float *corner(const struct sky_points *p, int x, int y, int k)
{
    return p->radiance + 3 * ((size_t)(2 * y + (k >> 1)) * (size_t)p->width +
                              (size_t)(2 * x + (k & 1)));
}

/* The means of four points each, and how far these are from them. */
static double average(const struct sky_points *p, const struct brume_sky *sky,
                      float *texel)
{
    double off = 0.0, all = 0.0;
    for (int y = 0; y < sky->height; y++)
        for (int x = 0; x < sky->width; x++, texel += 3) {
            for (int c = 0; c < 3; c++)
                texel[c] = 0.25f *
                           (corner(p, x, y, 0)[c] + corner(p, x, y, 1)[c] +
                            corner(p, x, y, 2)[c] + corner(p, x, y, 3)[c]);
            double mean = luminance(texel), angle = row_angle(sky, y);
            for (int k = 0; k < 4; k++)
                off += angle * fabs(luminance(corner(p, x, y, k)) - mean);
            all += 4.0 * angle * mean;
        }
    return all > 0.0 ? off / all : 0.0;
}

/* Its picture, twice as fine each time until it shows what there is. */
static bool draw(const struct prepare *job, struct brume_sky *sky,
                 struct brume_error *err)
{
    for (int rows = LEAST_ROWS;; rows *= 2) {
        size_t n = 2 * (size_t)rows * (size_t)rows;
        float *texel = memory_new(3 * n, sizeof *texel, err);
        struct sky_points p = {
            .scene = job->scene, .width = 4 * rows, .height = 2 * rows};
        p.radiance = memory_new(12 * n, sizeof *texel, err);
        free((void *)sky->radiance);
        sky->radiance = texel;
        sky->width = 2 * rows;
        sky->height = rows;
        if (!texel || !p.radiance)
            return false;
        parallel_for(job->threads, (size_t)p.height, fill_row, &p, NULL);
        double detail = average(&p, sky, texel);
        free(p.radiance);
        if (detail <= SKY_DETAIL || rows == MOST_ROWS)
            return true;
    }
}

static bool add_function_texels(const struct prepare *job, flat_sky *out,
                                struct brume_error *err)
{
    struct brume_sky sky = BRUME_SKY_INIT;
    bool good = draw(job, &sky, err) && add_texels(job, &sky, out, err);
    free((void *)sky.radiance);
    return good;
}

bool prepare_sky(const struct prepare *job, struct brume_error *err)
{
    const struct brume_sky *sky = &job->scene->sky;
    if (sky->width == 0 && sky->function < 0)
        return true;
    flat_sky *out = FLAT_EXTEND(job->flat, sky, 1, err);
    if (!out)
        return false;
    out->function = sky->function;
    if (sky->function < 0)
        return add_texels(job, sky, out, err);
    return !job->scene->globals.environment ||
           add_function_texels(job, out, err);
}
