/* Lights, and the sky as one (physics/light.h, physics/sky.h). */
#include <math.h>
#include <stdlib.h>
#include "core/prepare.h"
#include "lib/memory.h"

#define PI 3.14159265358979323846

static vec3 unit_vector(const struct flat *f, const double v[3])
{
    return vec3_make((float)(v[0] * f->unit), (float)(v[1] * f->unit),
                     (float)(v[2] * f->unit));
}

static double light_weight(const struct brume_light *l)
{
    return fabs(l->color[0]) + fabs(l->color[1]) + fabs(l->color[2]);
}

static void set_place(const struct flat *f, const struct brume_light *in,
                      flat_light *out)
{
    double p[3], axis[3];
    matrix_point(&f->to_unit, in->location, p);
    out->position = vec3_make((float)p[0], (float)p[1], (float)p[2]);
    for (int i = 0; i < 3; i++)
        axis[i] = in->point_at[i] - in->location[i];
    double size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] +
                       axis[2] * axis[2]);
    if (size > 0.0)
        out->axis = vec3_make((float)(axis[0] / size), (float)(axis[1] / size),
                              (float)(axis[2] / size));
}

/* An ellipse of one width is a line as much as a rectangle is. */
static void set_area(const struct flat *f, const struct brume_light *in,
                     flat_light *out)
{
    if (!in->area || (in->area_size[0] == 1 && in->area_size[1] == 1))
        return;
    bool line = in->area_size[0] == 1 || in->area_size[1] == 1;
    out->area = !in->area_circular || line ? LIGHT_RECTANGLE
                : in->area_orient          ? LIGHT_FACING_DISC
                                           : LIGHT_ELLIPSE;
    out->illumination = in->area_illumination || f->view.physical_units;
    for (int i = 0; i < 2; i++)
        if (in->area_size[i] > 1)
            out->side[i] = unit_vector(f, in->area_axis[i]);
}

/* An area that is lit from all over is as blunt as it is wide. */
static void set_fall_off(const struct flat *f, const struct brume_light *in,
                         flat_light *out)
{
    bool fades = in->fade_distance > 0.0 && in->fade_power > 0.0;
    out->local = !out->parallel && (f->view.physical_units || fades);
    if (!f->view.physical_units)
        out->blunt = out->fade_distance;
    if (out->illumination)
        out->blunt = fmaxf(out->blunt, 0.5f * fmaxf(vec3_length(out->side[0]),
                                                    vec3_length(out->side[1])));
}

static bool add_light(const struct prepare *job, const struct brume_light *in,
                      struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_light *out = FLAT_EXTEND(f, lights, 1, err);
    if (!out)
        return false;
    bool spot = in->kind == BRUME_LIGHT_SPOT;
    out->kind = (int32_t)in->kind;
    out->parallel = in->parallel || in->kind == BRUME_LIGHT_CYLINDER;
    out->color = rgb_make((float)in->color[0], (float)in->color[1],
                          (float)in->color[2]);
    out->inner = (float)(spot ? cos(in->radius * PI / 180.0)
                              : in->radius * f->unit);
    out->outer = (float)(spot ? cos(in->falloff * PI / 180.0)
                              : in->falloff * f->unit);
    out->tightness = (float)in->tightness;
    out->fade_distance = (float)(in->fade_distance * f->unit);
    out->fade_power = (float)in->fade_power;
    out->shadows = in->shadows;
    out->media_interaction = in->media_interaction;
    out->media_attenuation = in->media_attenuation;
    set_place(f, in, out);
    set_area(f, in, out);
    set_fall_off(f, in, out);
    f->view.local_lights |= out->local;
    return true;
}

/* Lights are chosen in proportion to their colour; black ones never. */
static bool add_lights(const struct prepare *job, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    double total = 0.0, sum = 0.0;
    for (size_t i = 0; i < s->lights_count; i++)
        total += light_weight(&s->lights[i]);
    for (size_t i = 0; total > 0.0 && i < s->lights_count; i++) {
        sum += light_weight(&s->lights[i]);
        if (!add_light(job, &s->lights[i], err))
            return false;
        job->flat->lights[i].cumulative = (float)(sum / total);
    }
    return true;
}

/* ---- the sky ------------------------------------------------------------ */

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

static bool add_sky(const struct prepare *job, struct brume_error *err)
{
    struct flat *f = job->flat;
    const struct brume_sky *sky = &job->scene->sky;
    size_t n = (size_t)sky->width * (size_t)sky->height;
    if (n == 0)
        return true;
    flat_sky *out = FLAT_EXTEND(f, sky, 1, err);
    sky_texel *t = FLAT_EXTEND(f, sky_texels, n, err);
    if (!out || !t)
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

bool prepare_lights(const struct prepare *job, struct brume_error *err)
{
    return add_lights(job, err) && add_sky(job, err);
}
