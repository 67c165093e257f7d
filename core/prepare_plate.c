/* The plate, with its depths in unit space (physics/plate.h). */
#include "core/prepare.h"
#include <math.h>

/* Where rays end at the latest there is nothing before the plate. */
static float unit_depth(const struct flat *f, const float *depth, size_t i)
{
    double d = depth ? (double)depth[i] * f->unit : 0.0;
    return d > 0.0 && d < (double)f->view.far ? (float)d : INFINITY;
}

bool prepare_plate(const struct prepare *job, struct brume_error *err)
{
    const struct brume_plate *p = &job->scene->plate;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    if (pixels == 0)
        return true;
    plate_pixel *out = FLAT_EXTEND(job->flat, plate, pixels, err);
    if (!out)
        return false;
    for (size_t i = 0; i < pixels; i++) {
        const float *c = p->radiance + 3 * i;
        out[i].color = rgb_make(c[0], c[1], c[2]);
        out[i].pass = p->alpha ? 1.0f - p->alpha[i] : 0.0f;
        out[i].depth = unit_depth(job->flat, p->depth, i);
    }
    job->flat->view.plate_ray = p->along_ray;
    return true;
}
