/* What photons are sent to: the ball around all that is bounded, and the box
 * in which media scatter. */
#include <math.h>
#include "core/prepare.h"

/* The lattice of a medium that is empty beyond it, in the scene's space. */
static struct box lattice_box(const struct flat *f, const flat_medium *m)
{
    if (m->uniform || m->outside.density > 0.0f)
        return box_endless();
    matrix to_cell, back;
    for (int i = 0; i < 12; i++)
        to_cell.m[i / 4][i % 4] = (double)m->to_cell.m[i];
    if (!matrix_invert(&to_cell, &back))
        return box_endless();
    back = matrix_compose(&f->from_unit, &back);
    struct box cells = {{0.0, 0.0, 0.0},
                        {m->cells[0], m->cells[1], m->cells[2]}};
    return box_transform(&cells, &back);
}

/* Widens `out` by the scattering media of an interior within its bounds. */
static void add_media(const struct flat *f, int interior,
                      const struct box *bounds, struct box *out)
{
    if (interior < 0)
        return;
    const flat_interior *in = &f->interiors[interior];
    for (int i = 0; i < in->count; i++) {
        const flat_medium *m = &f->media[f->interior_media[in->first + i]];
        struct box box = lattice_box(f, m);
        box = box_common(&box, bounds);
        if (!rgb_is_black(m->sigma_s) && !box_is_empty(&box))
            *out = box_hull(out, &box);
    }
}

static void set_ball(struct flat *f, const struct box *all)
{
    scene_reach *out = &f->view.reach;
    double lo[3], hi[3], square = 0.0;
    if (box_is_empty(all)) {
        out->radius = 1.0f;
        return;
    }
    matrix_point(&f->to_unit, all->lo, lo);
    matrix_point(&f->to_unit, all->hi, hi);
    for (int i = 0; i < 3; i++)
        square += 0.25 * (hi[i] - lo[i]) * (hi[i] - lo[i]);
    out->centre = vec3_make((float)(0.5 * (lo[0] + hi[0])),
                            (float)(0.5 * (lo[1] + hi[1])),
                            (float)(0.5 * (lo[2] + hi[2])));
    out->radius = (float)fmax(sqrt(square), 1e-6);
}

/* Of all bounded parts. */
static struct box parts_box(const struct assembly *a)
{
    struct box out = box_empty();
    for (size_t i = 0; i < a->parts_count; i++) {
        const struct box *seen = &a->parts[i].seen;
        if (box_is_bounded(seen) && !box_is_empty(seen))
            out = box_hull(&out, seen);
    }
    return out;
}

static struct box media_box(const struct flat *f, const struct assembly *a)
{
    struct box out = box_empty(), everywhere = box_endless();
    for (size_t i = 0; i < a->parts_count; i++)
        add_media(f, a->wholes[a->parts[i].whole].interior, &a->parts[i].seen,
                  &out);
    add_media(f, f->view.atmosphere, &everywhere, &out);
    return out;
}

/* Where endless parts are, and hold media. */
static void find_endless(struct flat *f, const struct assembly *a)
{
    scene_reach *out = &f->view.reach;
    out->media = f->view.atmosphere >= 0;
    for (size_t i = 0; i < a->parts_count; i++) {
        if (box_is_bounded(&a->parts[i].seen) ||
            box_is_empty(&a->parts[i].seen))
            continue;
        out->media |= a->wholes[a->parts[i].whole].interior >= 0;
        out->walls |= f->shapes[i].material >= 0;
    }
}

/* Media without an end are followed as far as the rest of the scene goes, the
 * eye included. */
void prepare_reach(const struct prepare *job, const struct assembly *a)
{
    struct flat *f = job->flat;
    scene_reach *out = &f->view.reach;
    struct box all = parts_box(a), media = media_box(f, a);
    if (!box_is_bounded(&media) && !box_is_empty(&media)) {
        box_add(&all, job->scene->camera.location);
        media = box_common(&media, &all);
    }
    if (!box_is_empty(&media))
        all = box_hull(&all, &media);
    set_ball(f, &all);
    find_endless(f, a);
    for (int i = 0; i < 3; i++) {
        bool none = box_is_empty(&media);
        double move = -f->centre[i] * f->unit;
        out->lo[i] = none ? 1.0f : (float)(media.lo[i] * f->unit + move);
        out->hi[i] = none ? -1.0f : (float)(media.hi[i] * f->unit + move);
    }
}
