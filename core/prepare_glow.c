/* The emitting voxels of media as lights (physics/glow.h): each voxel weighs
 * by the mean luminance that its parts emit. Only where light is followed
 * beyond the first event can such a light reach anything. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/twin.h"
#include "core/prepare.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* Of a medium that is seen by its heat alone: what weighs at a temperature,
 * between nodes even in its inverse, from 500 to 64,000 K. Off by 1e-4 at most,
 * which only shifts a little where points are chosen. */
enum { HEAT_NODES = 4096, HEAT_FIRST = 32 };
#define HEAT_NODE(kelvin)                                                      \
    (BLACKBODY_LOWEST_KELVIN * (float)(HEAT_NODES - 1) / (kelvin))

struct glow_job {
    const struct flat *flat;
    const flat_medium *medium;
    flat_glow *glow;
    float *voxels; /* 512 a brick: weights, then cumulative       */
    glow_brick *bricks;
    double *weight; /* of each brick                               */
    float *heat;    /* HEAT_NODES, or NULL: it is asked for colour */
};

/* Negative channels of saturated colours count by their size. */
static float color_weight(rgb q)
{
    return fabsf(q.r) * 0.2126f + fabsf(q.g) * 0.7152f + fabsf(q.b) * 0.0722f;
}

/* The i-th eighth of a voxel: its centre. */
static field_point eighth(const struct glow_job *job, const glow_brick *b,
                          int voxel, int i)
{
    vec3 q = vec3_make(
        (float)(b->corner[0] + (voxel & 7)) + (i & 1 ? 0.75f : 0.25f),
        (float)(b->corner[1] + (voxel >> 3 & 7)) + (i & 2 ? 0.75f : 0.25f),
        (float)(b->corner[2] + (voxel >> 6)) + (i & 4 ? 0.75f : 0.25f));
    return field_point_make(&job->flat->view, job->medium->lead,
                            affine_point(&job->glow->from_index, q));
}

static bool only_heat(const flat_medium *m)
{
    return m->fire && !m->functions && rgb_is_black(m->emission);
}

static float heat_exactly(const struct glow_job *job, float kelvin)
{
    const flat_medium *m = job->medium;
    rgb q = fire_color(&job->flat->view, m, kelvin);
    return color_weight(m->additive ? q : rgb_mul(q, m->sigma_a));
}

/* All that is even is in the table, so that one number is left of a point. */
static bool make_heat(struct glow_job *job, struct brume_error *err)
{
    if (!only_heat(job->medium))
        return true;
    job->heat = memory_new(HEAT_NODES, sizeof *job->heat, err);
    for (int i = HEAT_FIRST; job->heat && i < HEAT_NODES; i++)
        job->heat[i] = heat_exactly(job, HEAT_NODE((float)i));
    return job->heat != NULL;
}

static float heat_weight(const struct glow_job *job, float temperature)
{
    const flat_medium *m = job->medium;
    float kelvin = m->kelvin_offset + m->kelvin_scale * temperature;
    if (!(kelvin >= BLACKBODY_LOWEST_KELVIN))
        return 0.0f;
    float at = HEAT_NODE(kelvin);
    if (at < HEAT_FIRST)
        return heat_exactly(job, kelvin);
    int i = at < HEAT_NODES - 2 ? (int)at : HEAT_NODES - 2;
    return job->heat[i] + (at - (float)i) * (job->heat[i + 1] - job->heat[i]);
}

/* The eighths of a voxel. */
struct eighths {
    const struct glow_job *job;
    const glow_brick *brick;
    int voxel;
    twin_point ends; /* the first and the last: most often all lie in one
                        voxel of the lead's grid, as these tell            */
};

/* Of two of them. */
static twin_point eighths_pair(const struct eighths *e, int i, int j)
{
    return twin_point_of(&e->job->flat->view, e->job->medium,
                         eighth(e->job, e->brick, e->voxel, i),
                         eighth(e->job, e->brick, e->voxel, j));
}

/* ---- by temperatures alone ----------------------------------------------- */

/* Between a voxel's samples, which are fetched once. */
static void eighths_within(const struct eighths *e, const grid_voxel *v,
                           float out[8])
{
    vec3 a = e->ends.in_a, b = e->ends.in_b;
    grid_eight c = grid_load(v->sample);
    for (int i = 0; i < 8; i++)
        out[i] = grid_trilinear(
            &c,
            vec3_make(i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z));
}

/* Of a grid that has them in the same voxel. */
static void eighths_share(const struct eighths *e, const flat_grid *g,
                          float out[8])
{
    grid_voxel v = grid_voxel_at(&e->job->flat->view, g, e->ends.brick,
                                 e->ends.sample);
    if (v.stored)
        eighths_within(e, &v, out);
    for (int i = 0; !v.stored && i < 8; i++)
        out[i] = v.value;
}

/* Of any field. */
static void eighths_apart(const struct eighths *e, const flat_field *f,
                          float out[8])
{
    for (int i = 0; i < 8; i += 2) {
        twin_point x = eighths_pair(e, i, i + 1);
        twin_float pair = twin_eval(&e->job->flat->view, f, &x);
        out[i] = pair.a;
        out[i + 1] = pair.b;
    }
}

/* Multiplies by a field. Whether anything is left. */
static bool eighths_times(const struct eighths *e, const flat_field *f,
                          float out[8])
{
    const flat_scene *s = &e->job->flat->view;
    bool fits = !field_is_function(f) && twin_fits(s, f, &e->ends);
    float factor[8], scale = fits ? f->scale : 1.0f, most = 0.0f;
    if (fits)
        eighths_share(e, scene_grid(s, f), factor);
    else
        eighths_apart(e, f, factor);
    for (int i = 0; i < 8; i++) {
        out[i] *= scale * factor[i];
        most = hd_max(most, fabsf(out[i]));
    }
    return most > 0.0f;
}

/* How much is hot at each; false: nothing is. */
static bool eighths_much(const struct eighths *e, float out[8])
{
    const flat_scene *s = &e->job->flat->view;
    const flat_medium *m = e->job->medium;
    for (int i = 0; i < 8; i++)
        out[i] = 1.0f;
    for (int k = 0; !m->additive && k < m->densities; k++)
        if (!eighths_times(e, scene_density(s, m, k), out))
            return false;
    for (int i = 0; !m->additive && i < 8; i++)
        out[i] = hd_min(out[i], m->densest);
    return m->amount < 0 || eighths_times(e, scene_amount(s, m), out);
}

/* The sum over them. */
static float heat_eighths(struct eighths *e)
{
    const struct glow_job *job = e->job;
    float much[8], kelvin[8] = {1, 1, 1, 1, 1, 1, 1, 1}, sum = 0.0f;
    e->ends = eighths_pair(e, 0, 7);
    if (!eighths_much(e, much))
        return 0.0f;
    eighths_times(e, scene_temperature(&job->flat->view, job->medium), kelvin);
    for (int i = 0; i < 8; i++)
        sum += much[i] * heat_weight(job, kelvin[i]);
    return sum;
}

/* ---- of any colour ------------------------------------------------------- */

static float color_eighths(const struct eighths *e)
{
    const flat_scene *s = &e->job->flat->view;
    float sum = 0.0f;
    for (int i = 0; i < 8; i += 2) {
        twin_point x = eighths_pair(e, i, i + 1);
        twin_rgb density = twin_density(s, e->job->medium, &x);
        twin_rgb q = twin_source(s, e->job->medium, &x, &density);
        sum += color_weight(q.a) + color_weight(q.b);
    }
    return sum;
}

/* ---- bricks -------------------------------------------------------------- */

/* Mean over the centres of the voxel's eighths. */
static float voxel_weight(const struct glow_job *job, const glow_brick *b,
                          int voxel)
{
    struct eighths e = {.job = job, .brick = b, .voxel = voxel};
    float sum = job->heat ? heat_eighths(&e) : color_eighths(&e);
    return isfinite(sum) ? sum / 8.0f : 0.0f;
}

static void weigh_brick(void *context, size_t index, int thread)
{
    (void)thread;
    const struct glow_job *job = context;
    float *v = job->voxels + 512 * index;
    double sum = 0.0;
    for (int i = 0; i < 512; i++) {
        sum += (double)voxel_weight(job, &job->bricks[index], i);
        v[i] = (float)sum;
    }
    job->weight[index] = sum;
    for (int i = 0; sum > 0.0 && i < 512; i++)
        v[i] = (float)(v[i] / sum);
}

/* One brick for each cell of the majorant lattice that may glow. */
static bool list_bricks(struct flat *f, const flat_medium *m, flat_glow *g,
                        struct brume_error *err)
{
    size_t cells = (size_t)m->cells[0] * (size_t)m->cells[1] *
                   (size_t)m->cells[2];
    g->slot = f->glow_slots_count;
    g->first = f->glow_bricks_count;
    int32_t *slots = FLAT_EXTEND(f, glow_slots, cells, err);
    if (!slots)
        return false;
    for (size_t i = 0; i < cells; i++)
        slots[i] = f->cells[m->cell + i].rate > 0.0f ? (int32_t)g->count++ : -1;
    glow_brick *bricks = FLAT_EXTEND(f, glow_bricks, g->count, err);
    if (!bricks || !FLAT_EXTEND(f, glow_voxels, 512 * g->count, err))
        return false;
    for (size_t i = 0; i < cells; i++) {
        if (slots[i] < 0)
            continue;
        size_t rest = i;
        for (int k = 0; k < 3; k++) {
            int at = (int)(rest % (size_t)m->cells[k]);
            bricks[slots[i]].corner[k] = g->origin[k] + 8 * at;
            rest /= (size_t)m->cells[k];
        }
    }
    return true;
}

static bool place(flat_glow *g, const flat_medium *m)
{
    matrix to_cell, to_index, from_index;
    const double none[3] = {0, 0, 0};
    for (int i = 0; i < 12; i++)
        to_cell.m[i / 4][i % 4] = m->to_cell.m[i];
    to_index = matrix_scale_move(8.0, none);
    to_index = matrix_compose(&to_index, &to_cell);
    if (!matrix_invert(&to_index, &from_index))
        return false;
    g->to_index = matrix_affine(&to_index);
    g->from_index = matrix_affine(&from_index);
    g->voxel_volume = (float)fabs(matrix_determinant(&from_index));
    memcpy(g->bricks, m->cells, sizeof g->bricks);
    return g->voxel_volume > 0.0f;
}

/* Weighs the bricks; the list's whole power in *power. */
static bool weigh(const struct prepare *job, const flat_medium *m, flat_glow *g,
                  double *power, struct brume_error *err)
{
    struct flat *f = job->flat;
    struct glow_job w = {.flat = f, .medium = m, .glow = g};
    w.voxels = f->glow_voxels + 512 * g->first;
    w.bricks = f->glow_bricks + g->first;
    w.weight = calloc(g->count + 1, sizeof *w.weight);
    if (!w.weight)
        return brume_fail(err, BRUME_ERR_MEMORY,
                          "out of memory for %zu emitting bricks",
                          (size_t)g->count);
    flat_view(f);
    if (!make_heat(&w, err)) {
        free(w.weight);
        return false;
    }
    parallel_for(job->threads, g->count, weigh_brick, &w, NULL);
    free(w.heat);
    double total = 0.0, sum = 0.0;
    for (size_t i = 0; i < g->count; i++)
        total += w.weight[i];
    for (size_t i = 0; total > 0.0 && i < g->count; i++) {
        sum += w.weight[i];
        w.bricks[i].cumulative = (float)(sum / total);
    }
    *power = total * g->voxel_volume;
    free(w.weight);
    return true;
}

static bool add_glow(const struct prepare *job, int32_t medium, double *power,
                     struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_glow g;
    memset(&g, 0, sizeof g);
    g.medium = medium;
    *power = 0.0;
    if (!place(&g, &f->media[medium]))
        return true;
    if (!list_bricks(f, &f->media[medium], &g, err) ||
        (g.count > 0 && !weigh(job, &f->media[medium], &g, power, err)))
        return false;
    if (!(*power > 0.0))
        return true;
    g.probability = (float)*power; /* of all lists: below */
    f->media[medium].glow = (int32_t)f->glows_count;
    flat_glow *out = FLAT_EXTEND(f, glows, 1, err);
    if (out)
        *out = g;
    return out != NULL;
}

bool prepare_glow(const struct prepare *job, struct brume_error *err)
{
    struct flat *f = job->flat;
    double total = 0.0;
    const struct brume_globals *g = &job->scene->globals;
    if (!g->media_multiple && !g->surfaces_indirect)
        return true;
    for (size_t i = 0; i < f->media_count; i++) {
        double power = 0.0;
        if (f->media[i].emits && !f->media[i].uniform &&
            !add_glow(job, (int32_t)i, &power, err))
            return false;
        total += power;
    }
    for (size_t i = 0; i < f->glows_count; i++) {
        f->glows[i].probability = (float)(f->glows[i].probability / total);
        f->glows[i].power = (float)(4.0 * M_PI * total);
    }
    flat_view(f);
    return true;
}
