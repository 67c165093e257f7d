/* Lights (physics/light.h). */
#include <math.h>
#include "core/prepare.h"

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
bool prepare_lights(const struct prepare *job, struct brume_error *err)
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
