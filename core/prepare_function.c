/* Fields that are functions, evaluated where they are asked for: the box of
 * the function's own space that their containers take, in cells, each with a
 * bound on the values in it.
 *
 * The bounds come of samples, at the corners of half cells, and allow for
 * what these may have missed; tracking stays unbiased where they do not hold
 * (physics/path_track.h), and counts it. */
#define PHYSICS_DOUBLE
#include "core/function.h"
#include <math.h>
#include <stdlib.h>
#include "core/prepare.h"
#include "lib/thread.h"

/* Cells along the longest side, at first and at most, and at least across. */
enum { FEW_CELLS = 8, MOST_CELLS = 64, LEAST_CELLS = 4 };

/* Free paths across the mean cell that scatters, above which smaller ones are
 * better: as in prepare_media.c. */
#define THICK 2.0

struct procedure {
    const brume_scene *scene;
    const struct brume_field *field;
    matrix to_world;
    struct box box; /* of the function's space                     */
    int cells[3];
    float *sample; /* 2 n + 1 along each side                     */
    float *bound;  /* of the cells                                */
};

/* ---- where ------------------------------------------------------------- */

static bool medium_uses(const struct brume_medium *m, int field)
{
    for (int i = 0; i < m->densities; i++)
        if (m->density[i] == field)
            return true;
    return m->fire.on &&
           (m->fire.temperature == field || m->fire.amount == field);
}

static bool interior_uses(const brume_scene *s, int interior, int field)
{
    if (interior < 0)
        return false;
    const struct scene_interior *in = &s->interiors[interior];
    for (int i = 0; i < in->count; i++)
        if (medium_uses(&s->media[in->media[i]], field))
            return true;
    return false;
}

/* The bounds of all containers with the field, in its own space; false: of one
 * that has none. */
static bool find_box(struct procedure *p, const struct assembly *a, int field)
{
    matrix to_field, map;
    p->box = box_empty();
    if (interior_uses(p->scene, p->scene->atmosphere, field) ||
        !matrix_invert(&p->to_world, &to_field))
        return false;
    for (size_t i = 0; i < a->parts_count; i++) {
        const struct part *part = &a->parts[i];
        if (!interior_uses(p->scene, a->wholes[part->whole].interior, field) ||
            box_is_empty(&part->seen))
            continue;
        map = matrix_compose(&to_field, &part->leaf.map);
        struct box own = leaf_bounds(&part->leaf, &map);
        struct box seen = box_transform(&part->seen, &to_field);
        own = box_common(&own, &seen);
        if (!box_is_bounded(&own))
            return false;
        p->box = box_hull(&p->box, &own);
    }
    return true;
}

/* A margin for rounding, and some thickness where there is none. */
static void widen(struct box *box)
{
    if (box_is_empty(box))
        *box = (struct box){{0, 0, 0}, {0, 0, 0}};
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, box->hi[i] - box->lo[i]);
    for (int i = 0; i < 3; i++) {
        double side = box->hi[i] - box->lo[i];
        double margin = 1e-3 * (side > 0.0 ? side : longest);
        margin = margin > 0.0 ? margin : 1.0;
        box->lo[i] -= margin;
        box->hi[i] += margin;
    }
}

static double world_side(const struct procedure *p, int axis)
{
    double v[3] = {0, 0, 0}, out[3];
    v[axis] = p->box.hi[axis] - p->box.lo[axis];
    matrix_vector(&p->to_world, v, out);
    return sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
}

static void set_cells(struct procedure *p, int along)
{
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, world_side(p, i));
    for (int i = 0; i < 3; i++) {
        int n = (int)ceil(along * world_side(p, i) / longest);
        p->cells[i] = n < LEAST_CELLS ? LEAST_CELLS : n > along ? along : n;
    }
}

/* ---- bounds ------------------------------------------------------------ */

static double positive(double v)
{
    return v > 0.0 && v < HUGE_VAL ? v : 0.0;
}

static float value_at(const struct procedure *p, const double at[3])
{
    double r[MACHINE_REGISTERS];
    machine m = function_machine(p->scene);
    int component = p->field->component;
    for (int i = 0; i < 3; i++)
        r[i] = at[i];
    if (!machine_run(&m, p->field->function, r))
        return 0.0f;
    double most = component >= 0 ? positive(r[component])
                                 : fmax(positive(r[0]),
                                        fmax(positive(r[1]), positive(r[2])));
    return (float)(p->field->scale * fmin(most, 1e30));
}

static void sample_layer(void *context, size_t z, int thread)
{
    (void)thread;
    const struct procedure *p = context;
    double at[3], step[3];
    size_t nx = 2 * (size_t)p->cells[0] + 1, ny = 2 * (size_t)p->cells[1] + 1;
    float *out = p->sample + nx * ny * z;
    for (int i = 0; i < 3; i++)
        step[i] = 0.5 * (p->box.hi[i] - p->box.lo[i]) / p->cells[i];
    at[2] = p->box.lo[2] + step[2] * (double)z;
    for (size_t y = 0; y < ny; y++) {
        at[1] = p->box.lo[1] + step[1] * (double)y;
        for (size_t x = 0; x < nx; x++) {
            at[0] = p->box.lo[0] + step[0] * (double)x;
            *out++ = value_at(p, at);
        }
    }
}

static float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Largest of the samples from `reach` half cells before a cell to as far
 * behind it. */
static float samples_near(const struct procedure *p, const int cell[3],
                          int reach)
{
    int first[3], last[3];
    size_t nx = 2 * (size_t)p->cells[0] + 1, ny = 2 * (size_t)p->cells[1] + 1;
    float most = 0.0f;
    for (int i = 0; i < 3; i++) {
        first[i] = 2 * cell[i] - reach;
        last[i] = 2 * cell[i] + 2 + reach;
        first[i] = first[i] < 0 ? 0 : first[i];
        last[i] = last[i] > 2 * p->cells[i] ? 2 * p->cells[i] : last[i];
    }
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++) {
            const float *row = p->sample + nx * ((size_t)y + ny * (size_t)z);
            for (int x = first[0]; x <= last[0]; x++)
                most = larger(row[x], most);
        }
    return most;
}

/* What a cell's samples have missed is taken to be a quarter of what they
 * have, an eighth of what there is near, a 64th of what there is at all, but
 * little more than the most of all; and never nothing. */
static void bound_cells(struct procedure *p)
{
    size_t n[3], at = 0;
    float all = 0.0f;
    for (int i = 0; i < 3; i++)
        n[i] = 2 * (size_t)p->cells[i] + 1;
    for (size_t i = 0; i < n[0] * n[1] * n[2]; i++)
        all = larger(p->sample[i], all);
    for (int z = 0; z < p->cells[2]; z++)
        for (int y = 0; y < p->cells[1]; y++)
            for (int x = 0; x < p->cells[0]; x++) {
                const int cell[3] = {x, y, z};
                float own = samples_near(p, cell, 0);
                float near = samples_near(p, cell, 2);
                float bound = 1.25f * own + 0.125f * near + all / 64.0f;
                p->bound[at++] = fmaxf(fminf(bound, 1.02f * all), 1e-30f);
            }
}

static bool sample_cells(struct procedure *p, int threads,
                         struct brume_error *err)
{
    size_t samples = 1, cells = 1;
    for (int i = 0; i < 3; i++) {
        samples *= 2 * (size_t)p->cells[i] + 1;
        cells *= (size_t)p->cells[i];
    }
    free(p->sample);
    free(p->bound);
    p->sample = malloc(samples * sizeof *p->sample);
    p->bound = malloc(cells * sizeof *p->bound);
    if (!p->sample || !p->bound)
        return brume_fail(err, BRUME_ERR_MEMORY,
                          "out of memory for the bounds of a function");
    parallel_for(threads, 2 * (size_t)p->cells[2] + 1, sample_layer, p, NULL);
    bound_cells(p);
    return true;
}

/* Whether bounds matter: where a medium with the field takes light away. */
static bool attenuates(const struct procedure *p, int field)
{
    const brume_scene *s = p->scene;
    for (size_t i = 0; i < s->media_count; i++) {
        const struct brume_medium *m = &s->media[i];
        for (int c = 0; c < 3; c++)
            if (m->scattering[c] + m->absorption[c] > 0.0 &&
                medium_uses(m, field))
                return true;
    }
    return false;
}

/* Free paths across a cell of the mean bound in the thickest of the media
 * that scatter by the field. */
static double thickness(const struct procedure *p, int field)
{
    const brume_scene *s = p->scene;
    double most = 0.0, sum = 0.0, side = 0.0;
    size_t cells = 1;
    for (int i = 0; i < 3; i++) {
        cells *= (size_t)p->cells[i];
        side = fmax(side, world_side(p, i) / p->cells[i]);
    }
    for (size_t i = 0; i < cells; i++)
        sum += (double)p->bound[i];
    for (size_t i = 0; i < s->media_count; i++) {
        const struct brume_medium *m = &s->media[i];
        double all = 0.0, scattering = 0.0;
        for (int c = 0; c < 3; c++) {
            all = fmax(all, m->scattering[c] + m->absorption[c]);
            scattering = fmax(scattering, m->scattering[c]);
        }
        if (scattering > 0.0 && medium_uses(m, field))
            most = fmax(most, all);
    }
    return most * sum / (double)cells * side;
}

/* ---- all of it --------------------------------------------------------- */

static bool add_procedure(struct flat *f, const struct procedure *p,
                          struct brume_error *err)
{
    size_t cells = (size_t)p->cells[0] * (size_t)p->cells[1] *
                   (size_t)p->cells[2];
    flat_procedure *out = FLAT_EXTEND(f, procedures, 1, err);
    float *bounds = out ? FLAT_EXTEND(f, bounds, cells, err) : NULL;
    if (!bounds)
        return false;
    for (size_t i = 0; i < cells; i++)
        bounds[i] = p->bound[i];
    out->bound = f->bounds_count - cells;
    out->function = p->field->function;
    out->component = p->field->component;
    for (int i = 0; i < 3; i++) {
        double side = (p->box.hi[i] - p->box.lo[i]) / p->cells[i];
        out->origin[i] = (float)p->box.lo[i];
        out->step[i] = (float)(side / PROCEDURE_SIDE);
        out->cells[i] = p->cells[i];
    }
    return true;
}

/* Index space to the scene's. */
static matrix index_to_world(const struct procedure *p)
{
    matrix to_field = matrix_identity();
    for (int i = 0; i < 3; i++) {
        to_field.m[i][i] = (p->box.hi[i] - p->box.lo[i]) /
                           (p->cells[i] * (double)PROCEDURE_SIDE);
        to_field.m[i][3] = p->box.lo[i];
    }
    return matrix_compose(&p->to_world, &to_field);
}

bool prepare_function(const struct prepare *job, const struct assembly *a,
                      int field, matrix *to_world, bool *bounded,
                      struct brume_error *err)
{
    struct procedure p = {.scene = job->scene,
                          .field = &job->scene->fields[field]};
    p.to_world = matrix_from(p.field->transform);
    *bounded = find_box(&p, a, field);
    if (!*bounded)
        return true;
    widen(&p.box);
    bool good = true;
    int along = attenuates(&p, field) ? FEW_CELLS : LEAST_CELLS;
    do {
        set_cells(&p, along);
        good = sample_cells(&p, job->threads, err);
        along *= 2;
    } while (good && along <= MOST_CELLS && thickness(&p, field) > THICK);
    good = good && add_procedure(job->flat, &p, err);
    *to_world = index_to_world(&p);
    free(p.sample);
    free(p.bound);
    return good;
}
