/* radiance.h - the field of scattered light: how flights are laid into it,
 * and what a medium makes of it.
 *
 * A photon adds its power times the length that it flies in a cell to that
 * cell's fluence, to the vector flux the same times its direction, and to what
 * goes toward the eye the same times the phase function [Lucy 1999; METHODS.md
 * 4.4]: divided by the cell's volume the sums are unbiased for its means. They
 * are kept in fixed point, so that no order of additions can be told from
 * another. */
#ifndef CORE_PHYSICS_RADIANCE_H
#define CORE_PHYSICS_RADIANCE_H
#include "core/physics/phase.h"
#include "core/physics/walk.h"

/* A deposit of 1 (the mean photon's power across one side of a cell) counts
 * as much; and no single one counts as more than RADIANCE_MOST, so that 2^33
 * of the mean size have room in a cell. */
#define RADIANCE_ONE 268435456.0
#define RADIANCE_MOST 1048576.0f

/* An event at p of a photon that came along d, for a field of balls. */
typedef struct {
    vec3 p, d;
    int32_t phase;          /* or RADIANCE_BIRTH                           */
    float g;
    rgb power;
} radiance_event;

/* Not a phase function: a birth, of which the first channel counts. */
#define RADIANCE_BIRTH (-1)

typedef struct {
    int64_t *sum;           /* field.numbers a cell                        */
    uint64_t clipped;       /* deposits above RADIANCE_MOST                */
    radiance_event *later;  /* where an event waits for the threads that will
                               store it together; NULL: it is stored at once */
    int32_t waits;          /* one does                                    */
} radiance_tally;

/* To the nearest whole number; halves go away from 0. As a float times a power
 * of two loses nothing, and a sum rounded toward 0 leaves its whole part as it
 * is, floats are enough for a GPU. */
HD void radiance_add(int64_t *sum, float value)
{
#ifdef __CUDA_ARCH__
    float x = value * (float)RADIANCE_ONE;
    int64_t n = __float2ll_rz(__fadd_rz(x, copysignf(0.5f, x)));
    atomicAdd((unsigned long long *)sum, (unsigned long long)n);
#else
    double x = (double)value * RADIANCE_ONE;
    __atomic_fetch_add(sum, (int64_t)(x + (x < 0.0 ? -0.5 : 0.5)),
                       __ATOMIC_RELAXED);
#endif
}

/* The slot of a brick, or -1 where it has no cells: its number. In a refined
 * field four times the number of its first cell, and the level: its cells are
 * 2^level times as large, 8 >> level along each axis. */
HD int32_t radiance_slot(const flat_scene *s, int x, int y, int z)
{
    const radiance_lattice *f = &s->field;
    int64_t brick = (x >> 3) + (int64_t)f->bricks[0] *
                    ((y >> 3) + (int64_t)f->bricks[1] * (z >> 3));
    return s->radiance_slots[brick];
}

HD int radiance_level(const flat_scene *s, int32_t slot)
{
    return s->field.refined && slot >= 0 ? (int)(slot & 3) : 0;
}

/* The first cell of a brick that is there. */
HD int64_t radiance_first(const flat_scene *s, int32_t slot)
{
    return s->field.refined ? (int64_t)(slot >> 2) : (int64_t)slot * 512;
}

/* Number of the cell's first value over field.numbers, or -1, of the smallest
 * cell there may be at that place. */
HD int64_t radiance_cell(const flat_scene *s, int x, int y, int z)
{
    int32_t slot = radiance_slot(s, x, y, z);
    if (slot < 0)
        return -1;
    int level = radiance_level(s, slot), n = 8 >> level;
    return radiance_first(s, slot) +
           (((z & 7) >> level) * n + ((y & 7) >> level)) * n +
           ((x & 7) >> level);
}

/* The middle of cell i of a brick. */
HD vec3 radiance_middle(const flat_scene *s, uint64_t brick, int i)
{
    const radiance_lattice *f = &s->field;
    int level = radiance_level(s, s->radiance_slots[brick]);
    int bits = 3 - level, mask = 7 >> level;
    float half = 0.5f * (float)(1 << level);
    uint64_t row = brick / (uint64_t)f->bricks[0];
    int x = 8 * (int)(brick % (uint64_t)f->bricks[0]) + ((i & mask) << level);
    int y = 8 * (int)(row % (uint64_t)f->bricks[1]) +
            ((i >> bits & mask) << level);
    int z = 8 * (int)(row / (uint64_t)f->bricks[1]) + (i >> 2 * bits << level);
    return vec3_make(f->origin[0] + ((float)x + half) * f->side,
                     f->origin[1] + ((float)y + half) * f->side,
                     f->origin[2] + ((float)z + half) * f->side);
}

/* A cell's neighbour along an axis, or -1. */
HD int64_t radiance_neighbor(const flat_scene *s, int x, int y, int z,
                             int axis, int step)
{
    x += axis == 0 ? step : 0;
    y += axis == 1 ? step : 0;
    z += axis == 2 ? step : 0;
    int at = axis == 0 ? x : axis == 1 ? y : z;
    return at >= 0 && at < 8 * s->field.bricks[axis] ? radiance_cell(s, x, y, z)
                                                     : -1;
}

/* Takes from cell i of a brick that is there what means of cells and the
 * interpolation between them add to a curved field: together they blur by a
 * kernel whose second moment is side^2 / 12 + side^2 / 6 along each axis, so
 * an eighth of the second differences is too much. */
HD void radiance_sharpen(const flat_scene *s, const float *means,
                         uint64_t brick, int i, float *cells)
{
    const radiance_lattice *f = &s->field;
    uint64_t row = brick / (uint64_t)f->bricks[0];
    int x = 8 * (int)(brick % (uint64_t)f->bricks[0]) + (i & 7);
    int y = 8 * (int)(row % (uint64_t)f->bricks[1]) + (i >> 3 & 7);
    int z = 8 * (int)(row / (uint64_t)f->bricks[1]) + (i >> 6);
    int64_t n = f->numbers;
    int64_t at = ((int64_t)s->radiance_slots[brick] * 512 + i) * n;
    for (int axis = 0; axis < 3; axis++) {
        int64_t a = n * radiance_neighbor(s, x, y, z, axis, -1);
        int64_t b = n * radiance_neighbor(s, x, y, z, axis, 1);
        for (int64_t k = 0; a >= 0 && b >= 0 && k < n; k++)
            cells[at + k] -= 0.125f * ((means[a + k] - means[at + k]) +
                                       (means[b + k] - means[at + k]));
    }
}

/* By what a field of balls is spread over a medium. */
HD float radiance_thickness(const flat_medium *m, rgb density)
{
    return rgb_mean(rgb_mul(density, m->sigma_s));
}

/* Without MAY_TINTS the channels' sums are alike, and the first one is added to
 * for all of them. */
HD void radiance_add_rgb(int64_t *sum, rgb value)
{
    radiance_add(sum, value.r);
    if (!scene_may(MAY_TINTS))
        return;
    radiance_add(sum + 1, value.g);
    radiance_add(sum + 2, value.b);
}

/* Phase functions that the field knows; of one medium there is one. */
HD int radiance_phases(const radiance_lattice *f)
{
    return scene_may(MAY_MANY) ? f->phases : 1;
}

/* The way from p to the eye. */
HD vec3 radiance_to_eye(const flat_scene *s, vec3 p)
{
    const camera *c = &s->view;
    return vec3_normalize(c->orthographic ? vec3_scale(c->direction, -1.0f)
                                          : vec3_sub(c->location, p));
}

/* Whether a deposit is too large to count, or no number. */
HD bool radiance_clips(radiance_tally *t, rgb value)
{
    bool clips = !(fabsf(value.r) + fabsf(value.g) + fabsf(value.b) <
                   RADIANCE_MOST);
    t->clipped += clips;
    return clips;
}

/* Lays power times length (in sides of a cell) of a flight along d into one
 * cell, which it crosses around p. */
HD void radiance_deposit(const flat_scene *s, radiance_tally *t, int64_t cell,
                         vec3 p, vec3 d, rgb value)
{
    const radiance_lattice *f = &s->field;
    int64_t *sum = t->sum + cell * f->numbers;
    if (radiance_clips(t, value))
        return;
    for (int i = 0; f->eye >= 0 && i < radiance_phases(f); i++)
        radiance_add_rgb(sum + f->eye + 3 * i,
                         rgb_scale(value, phase_eval_between(f->phase[i],
                             f->g[i], d, radiance_to_eye(s, p))));
    if (f->fluence >= 0)
        radiance_add_rgb(sum + f->fluence, value);
    const int channels = scene_may(MAY_TINTS) ? 3 : 1;
    for (int c = 0; f->flux >= 0 && c < channels; c++) {
        float x = rgb_get(value, c);
        radiance_add(sum + f->flux + 3 * c, x * d.x);
        radiance_add(sum + f->flux + 3 * c + 1, x * d.y);
        radiance_add(sum + f->flux + 3 * c + 2, x * d.z);
    }
}

/* First and last cell of an axis whose middles lie within r cells of q. */
HD void radiance_span(const radiance_lattice *f, int axis, float q, float r,
                      int *first, int *last)
{
    int end = 8 * f->bricks[axis] - 1;
    *first = -hd_floor(r - q);
    *last = hd_floor(q + r);
    *first = *first < 0 ? 0 : *first;
    *last = *last > end ? end : *last;
}

/* Cells whose middles may lie in the ball around an event. */
typedef struct {
    float q[3];             /* the event, in cells from their middles      */
    int lo[3], hi[3];
} radiance_box;

HD radiance_box radiance_box_of(const flat_scene *s, vec3 p)
{
    const radiance_lattice *f = &s->field;
    radiance_box b;
    float r = f->radius / f->side;
    for (int i = 0; i < 3; i++) {
        b.q[i] = (vec3_get(p, i) - f->origin[i]) / f->side - 0.5f;
        radiance_span(f, i, b.q[i], r, &b.lo[i], &b.hi[i]);
    }
    return b;
}

/* Adds an event to a cell of its box, if it lies in the cell's ball. */
HD bool radiance_splat_cell(const flat_scene *s, int64_t *sums,
                            const radiance_event *e, const radiance_box *b,
                            int x, int y, int z)
{
    const radiance_lattice *f = &s->field;
    float r = f->radius / f->side;
    vec3 off = vec3_make((float)x - b->q[0], (float)y - b->q[1],
                         (float)z - b->q[2]);
    int64_t cell = radiance_cell(s, x, y, z);
    if (cell < 0 || !(vec3_dot(off, off) <= r * r))
        return false;
    int64_t *sum = sums + cell * f->numbers;
    if (e->phase == RADIANCE_BIRTH) {
        radiance_add(sum + f->births, e->power.r);
        return true;
    }
    vec3 eye = radiance_to_eye(s, vec3_mad(e->p, f->side, off));
    radiance_add_rgb(sum, rgb_scale(e->power, phase_eval_between(
                              e->phase, e->g, e->d, eye)));
    return true;
}

/* Adds an event to the cells in whose ball it lies: the sums of a gather over
 * all photons there [Jensen and Christensen 1998], without a list of photons.
 * False: it lies in none, or waits. */
HD bool radiance_store(const flat_scene *s, radiance_tally *t,
                       const radiance_event *e)
{
    bool stored = false;
    if (!(rgb_max(e->power) < RADIANCE_MOST &&
          rgb_min(e->power) > -RADIANCE_MOST)) {
        t->clipped++;
        return false;
    }
    if (t->later) {
        *t->later = *e;
        t->waits = 1;
        return false;
    }
    radiance_box b = radiance_box_of(s, e->p);
    for (int z = b.lo[2]; z <= b.hi[2]; z++)
        for (int y = b.lo[1]; y <= b.hi[1]; y++)
            for (int x = b.lo[0]; x <= b.hi[0]; x++)
                if (radiance_splat_cell(s, t->sum, e, &b, x, y, z))
                    stored = true;
    return stored;
}

/* A flight on its way through the lattice. */
typedef struct {
    vec3 o;                 /* in cells                                    */
    float inverse[3];       /* of the direction; 0: crosses no plane       */
    float t, end;
    float next[3];          /* distances of the next plane of each axis    */
    int32_t cell[3];
} radiance_walk;

HD void radiance_set_out(const radiance_lattice *f, vec3 o, float t0, float t1,
                         radiance_walk *w)
{
    w->t = t0;
    w->end = t1;
    w->o = vec3_make((o.x - f->origin[0]) / f->side,
                     (o.y - f->origin[1]) / f->side,
                     (o.z - f->origin[2]) / f->side);
}

/* False where o + t d, t in [t0, t1], misses the lattice. */
HD bool radiance_begin(const flat_scene *s, vec3 o, vec3 d, float t0, float t1,
                       radiance_walk *w)
{
    const radiance_lattice *f = &s->field;
    radiance_set_out(f, o, t0, t1, w);
    for (int i = 0; i < 3; i++) {
        float from = vec3_get(w->o, i);
        w->inverse[i] = walk_inverse(vec3_get(d, i) / f->side);
        float size = (float)(8 * f->bricks[i]);
        if (w->inverse[i] == 0.0f) {
            if (!(from >= 0.0f && from < size))
                return false;
            continue;
        }
        float a = -from * w->inverse[i], b = (size - from) * w->inverse[i];
        w->t = hd_max(w->t, hd_min(a, b));
        w->end = hd_min(w->end, hd_max(a, b));
    }
    if (!(w->t < w->end))
        return false;
    for (int i = 0; i < 3; i++) {
        int c = hd_floor(vec3_get(w->o, i) +
                         w->t * (vec3_get(d, i) / f->side));
        int last = 8 * f->bricks[i] - 1;
        w->cell[i] = c < 0 ? 0 : c > last ? last : c;
        w->next[i] = walk_plane(vec3_get(w->o, i), w->inverse[i], w->cell[i]);
    }
    return true;
}

/* Goes over the nearest plane to the next cell; false beyond the lattice. */
HD bool radiance_step(const flat_scene *s, radiance_walk *w)
{
    int32_t at;
    int axis = walk_cross(w->o, w->inverse, w->cell, w->next, &at);
    return at >= 0 && at < 8 * s->field.bricks[axis];
}

/* Lays what a walk crosses of its current cell, of a flight o + t d, d of unit
 * length, of a photon of that power. False: that was the last. */
HD bool radiance_lay(const flat_scene *s, radiance_tally *t, radiance_walk *w,
                     vec3 o, vec3 d, rgb power)
{
    float from = w->t;
    const int32_t *at = w->cell;
    int level = radiance_level(s, radiance_slot(s, at[0], at[1], at[2]));
    int64_t cell = radiance_cell(s, at[0], at[1], at[2]);
    bool more;
    do {
        float next = hd_min(w->next[0], hd_min(w->next[1], w->next[2]));
        w->t = hd_max(w->t, hd_min(next, w->end));
        more = w->t < w->end && radiance_step(s, w);
    } while (more && level > 0 &&
             radiance_cell(s, at[0], at[1], at[2]) == cell);
    float length = w->t - from;
    /* Over the volume of the smallest cells, as all sums are. */
    float side = s->field.side * (float)(1 << 3 * level);
    if (cell >= 0 && length > 0.0f)
        radiance_deposit(s, t, cell, vec3_mad(o, from + 0.5f * length, d), d,
                         rgb_scale(power, length / side));
    return more;
}

/* ---- reading ----------------------------------------------------------- */

typedef struct {
    rgb eye, fluence, lit;
    vec3 flux[3];           /* of each channel                             */
    float births;
} radiance_point;

HD rgb radiance_rgb(const float *v)
{
    return rgb_make(v[0], v[1], v[2]);
}

/* Asks for what goes anywhere. */
#define RADIANCE_ANYWHERE (-1)

/* What a cell has, `weight` times; `kind`: only what that phase function sends
 * to the eye, if the field has it. */
HD void radiance_blend(const radiance_lattice *f, const float *v, int kind,
                       float weight, radiance_point *out)
{
    bool eye = kind != RADIANCE_ANYWHERE;
    int place = scene_may(MAY_MANY) ? 3 * kind : 0;
    if (eye && f->lit)
        out->lit = rgb_add(out->lit,
                           rgb_scale(radiance_rgb(v + f->lit + place),
                                     weight));
    if (eye && f->eye >= 0) {
        out->eye = rgb_add(out->eye,
                           rgb_scale(radiance_rgb(v + f->eye + place),
                                     weight));
        if (f->births)
            out->births += v[f->births] * weight;
        return;
    }
    out->fluence = rgb_add(out->fluence,
                           rgb_scale(radiance_rgb(v + f->fluence), weight));
    for (int c = 0; f->flux >= 0 && c < 3; c++) {
        const float *x = v + f->flux + 3 * c;
        out->flux[c] = vec3_mad(out->flux[c], weight,
                                vec3_make(x[0], x[1], x[2]));
    }
}

/* Of a cell that has 4 numbers in all: with one load. */
HD void radiance_four(const float *v, float *out)
{
#ifdef __CUDACC__
    const float4 x = *reinterpret_cast<const float4 *>(v);
    out[0] = x.x;
    out[1] = x.y;
    out[2] = x.z;
    out[3] = x.w;
#else
    memcpy(out, v, 4 * sizeof *out);
#endif
}

HD radiance_point radiance_nothing(void)
{
    radiance_point out;
    out.births = 0.0f;
    out.eye = out.fluence = out.lit = rgb_gray(0.0f);
    out.flux[0] = out.flux[1] = out.flux[2] = vec3_make(0.0f, 0.0f, 0.0f);
    return out;
}

/* Place of p between the centres of cells of 2^level sides along one axis,
 * within the lattice. */
HD int radiance_place(const radiance_lattice *f, float p, int axis, int level,
                      float *fraction)
{
    float last = (float)((8 * f->bricks[axis] >> level) - 1);
    float x = (p - f->origin[axis]) / (f->side * (float)(1 << level)) - 0.5f;
    x = hd_min(hd_max(x, 0.0f), last);
    int i = (int)hd_max(hd_min(x, last - 1.0f), 0.0f);
    *fraction = x - (float)i;
    return i;
}

/* Adds what cells of 2^level sides tell of p to *out, `share` times, and the
 * weight of those that are there to *sum: interpolated between their centres,
 * at each of which stands the cell that is there, whatever its level. */
HD void radiance_gather(const flat_scene *s, vec3 p, int kind, int level,
                        float share, radiance_point *out, float *sum)
{
    float fraction[3];
    int at[3], half = (1 << level) >> 1;
    for (int i = 0; i < 3; i++)
        at[i] = radiance_place(&s->field, vec3_get(p, i), i, level,
                               &fraction[i]);
    HD_ROLLED
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        float weight = share * (x ? fraction[0] : 1.0f - fraction[0]) *
                       (y ? fraction[1] : 1.0f - fraction[1]) *
                       (z ? fraction[2] : 1.0f - fraction[2]);
        if (level > 0 && weight == 0.0f)
            continue;
        int64_t cell = radiance_cell(s, ((at[0] + x) << level) + half,
                                     ((at[1] + y) << level) + half,
                                     ((at[2] + z) << level) + half);
        if (cell < 0)
            continue;
        radiance_blend(&s->field, s->radiance + cell * s->field.numbers, kind,
                       weight, out);
        *sum += weight;
    }
}

/* The same from levels that change: within a cell of a brick's face the next
 * one's level has its part, half of it at the face, so that nothing jumps. */
HD_APART radiance_point radiance_mixed(const flat_scene *s, vec3 p, int kind,
                                       float *sum)
{
    const radiance_lattice *f = &s->field;
    radiance_point out = radiance_nothing();
    float part[4] = {0.0f, 0.0f, 0.0f, 0.0f}, near[3];
    int at[3], step[3];
    for (int i = 0; i < 3; i++) {
        float last = (float)(8 * f->bricks[i]) - 0.5f;
        float x = (vec3_get(p, i) - f->origin[i]) / f->side;
        x = hd_min(hd_max(x, 0.0f), last);
        at[i] = (int)x;
        float in = x - (float)(at[i] & ~7);
        step[i] = in < 4.0f ? -8 : 8;
        near[i] = 0.5f - 0.5f * (in < 4.0f ? in : 8.0f - in);
        int beside = at[i] + step[i];
        if (!(near[i] > 0.0f) || beside < 0 || beside >= 8 * f->bricks[i])
            near[i] = 0.0f;
    }
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        float weight = (x ? near[0] : 1.0f - near[0]) *
                       (y ? near[1] : 1.0f - near[1]) *
                       (z ? near[2] : 1.0f - near[2]);
        if (!(weight > 0.0f))
            continue;
        int32_t slot = radiance_slot(s, at[0] + (x ? step[0] : 0),
                                     at[1] + (y ? step[1] : 0),
                                     at[2] + (z ? step[2] : 0));
        part[radiance_level(s, slot)] += weight;
    }
    for (int level = 0; level < 4; level++)
        if (part[level] > 0.0f)
            radiance_gather(s, p, kind, level, part[level], &out, sum);
    return out;
}

/* Interpolated between the centres of those cells that are there. `kind`: for
 * the light that goes on to the eye by that phase function, see radiance_seen;
 * of balls, 0: all of it. Where there are none, nothing tells against as many
 * births as should be. */
HD radiance_point radiance_at(const flat_scene *s, vec3 p, int kind)
{
    radiance_point out;
    float sum = 0.0f;
    if (s->field.refined) {
        float weight = 0.0f;
        out = radiance_mixed(s, p, kind, &weight);
        sum = weight;
    } else {
        out = radiance_nothing();
        radiance_gather(s, p, kind, 0, 1.0f, &out, &sum);
    }
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    out.births = sum > 0.0f ? out.births * scale : 1.0f;
    out.eye = rgb_scale(out.eye, scale);
    out.fluence = rgb_scale(out.fluence, scale);
    out.lit = rgb_scale(out.lit, scale);
    for (int c = 0; c < 3; c++)
        out.flux[c] = vec3_scale(out.flux[c], scale);
    return out;
}

/* What of the cells' light came straight from lights, and goes on to the eye:
 * `lit` has all of it (lit_cell.h). */
HD rgb radiance_lit(const flat_scene *s, vec3 p, int kind)
{
    radiance_point x = radiance_at(s, p, kind);
    return rgb_sub(x.lit, s->field.eye >= 0
                              ? x.eye
                              : rgb_scale(x.fluence, WARP_INV_4PI));
}

/* The slots of the bricks of the eight cells from `at` on, of a field that is
 * not refined: most often one brick's. */
HD void radiance_slots_of(const flat_scene *s, const int *at, int32_t *slot)
{
    const radiance_lattice *f = &s->field;
    uint32_t row = (uint32_t)f->bricks[0];
    uint32_t plane = row * (uint32_t)f->bricks[1];
    const int32_t *first = s->radiance_slots +
                           (plane * (uint32_t)(at[2] >> 3) +
                            row * (uint32_t)(at[1] >> 3) +
                            (uint32_t)(at[0] >> 3));
    uint32_t x = (at[0] & 7) == 7 ? 1 : 0;
    uint32_t y = (at[1] & 7) == 7 ? row : 0;
    uint32_t z = (at[2] & 7) == 7 ? plane : 0;
    for (int k = 0; k < 8; k++)
        slot[k] = k ? slot[0] : first[0];
    for (int k = 1; (x | y | z) != 0 && k < 8; k++)
        slot[k] = first[(k & 1 ? x : 0) + (k & 2 ? y : 0) + (k & 4 ? z : 0)];
}

/* What lines ask of the field: light that goes on to the eye, as it is or, of
 * balls, per thickness; and of births. */
typedef struct {
    rgb light;
    float births;
} radiance_sight;

HD radiance_sight radiance_no_sight(void)
{
    radiance_sight out;
    out.light = rgb_gray(0.0f);
    out.births = 0.0f;
    return out;
}

/* The place of three numbers that are that light, but for a factor; -1: there
 * are none. */
HD int radiance_sight_place(const radiance_lattice *f, int kind)
{
    int place = scene_may(MAY_MANY) ? 3 * kind : 0;
    if (scene_may(MAY_BALLS) && f->ball)
        return f->eye;
    if (f->lit)
        return f->lit + place;
    return f->eye >= 0 ? f->eye + place : f->flux < 0 ? f->fluence : -1;
}

/* Whether cells have three numbers of that light, one of births, no more. */
HD bool radiance_has_four(const radiance_lattice *f)
{
    return scene_may(MAY_BALLS) && f->ball && f->numbers == 4;
}

/* Adds a cell's, the first of them at v, `weight` times. */
HD void radiance_see(const float *v, bool four, float weight,
                     radiance_sight *out)
{
    float x[4];
    if (four) {
        radiance_four(v, x);
        out->births += weight * x[3];
    } else {
        x[0] = v[0];
        x[1] = v[1];
        x[2] = v[2];
    }
    out->light.r += weight * x[0];
    out->light.g += weight * x[1];
    out->light.b += weight * x[2];
}

/* A point among the eight cells around it, from `at` on. */
typedef struct {
    int at[3];
    float part[3][2];       /* of those before and behind it               */
} radiance_eight;

HD radiance_eight radiance_eight_of(const flat_scene *s, vec3 p)
{
    const radiance_lattice *f = &s->field;
    radiance_eight e;
    for (int i = 0; i < 3; i++) {
        float last = (float)(8 * f->bricks[i] - 1);
        float x = (vec3_get(p, i) - f->origin[i]) * f->per_side - 0.5f;
        x = hd_at_most(hd_at_least(x, 0.0f), last);
        e.at[i] = (int)hd_at_most(x, last - 1.0f);
        e.part[i][1] = x - (float)e.at[i];
        e.part[i][0] = 1.0f - e.part[i][1];
    }
    return e;
}

/* The mean of those cells that are there. Where there are none, nothing tells
 * against as many births as should be. */
HD radiance_sight radiance_see_some(const flat_scene *s,
                                    const radiance_eight *e, int place)
{
    const radiance_lattice *f = &s->field;
    radiance_sight out = radiance_no_sight();
    float sum = 0.0f;
    HD_ROLLED
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        float weight = (x ? e->part[0][1] : e->part[0][0]) *
                       (y ? e->part[1][1] : e->part[1][0]) *
                       (z ? e->part[2][1] : e->part[2][0]);
        int64_t cell = radiance_cell(s, e->at[0] + x, e->at[1] + y,
                                     e->at[2] + z);
        if (cell < 0)
            continue;
        radiance_see(s->radiance + cell * f->numbers + place,
                     radiance_has_four(f), weight, &out);
        sum += weight;
    }
    float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
    out.births = sum > 0.0f ? out.births * scale : 1.0f;
    out.light = rgb_scale(out.light, scale);
    return out;
}

/* The mean where all of them are there, in bricks of those slots. */
HD radiance_sight radiance_see_all(const flat_scene *s,
                                   const radiance_eight *e,
                                   const int32_t *slot, int place, bool four)
{
    const uint32_t bytes = sizeof(float) * (uint32_t)s->field.numbers;
    const char *first = (const char *)(s->radiance + place);
    radiance_sight out = radiance_no_sight();
    for (int k = 0; k < 8; k++) {
        int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        float weight = e->part[0][x] * e->part[1][y] * e->part[2][z];
        uint32_t in = (uint32_t)(((e->at[2] + z) & 7) * 64 +
                                 ((e->at[1] + y) & 7) * 8 +
                                 ((e->at[0] + x) & 7));
        uint32_t cell = (uint32_t)slot[k] * 512u + in;
        /* One product and sum, as 32 bits hold its factors. */
        const void *v = first + (uint64_t)cell * bytes;
        radiance_see((const float *)v, four, weight, &out);
    }
    return out;
}

/* At p, of a field that is not refined: interpolated between the centres of
 * cells, as by radiance_at. `place`: radiance_sight_place. */
HD radiance_sight radiance_sight_at(const flat_scene *s, vec3 p, int place)
{
    const radiance_lattice *f = &s->field;
    radiance_eight e = radiance_eight_of(s, p);
    int32_t slot[8], all = 0;
    radiance_slots_of(s, e.at, slot);
    for (int k = 0; k < 8; k++)
        all |= slot[k];
    radiance_sight out;
    if (all < 0)
        out = radiance_see_some(s, &e, place);
    else if (radiance_has_four(f))
        out = radiance_see_all(s, &e, slot, place, true);
    else
        out = radiance_see_all(s, &e, slot, place, false);
    if (!f->ball && !f->lit && f->eye < 0)
        out.light = rgb_scale(out.light, WARP_INV_4PI);
    return out;
}

/* A phase function as an isotropic part and a lobe of Henyey and Greenstein
 * of the same mean cosine; returns the lobe's part. Rayleigh's, which is even,
 * counts as isotropic. */
HD float radiance_lobe(int kind, float g, float *lobe_g)
{
    switch (kind) {
    case PHASE_MIE_HAZY:
        *lobe_g = 0.8f;
        return 0.5f;
    case PHASE_MIE_MURKY:
        *lobe_g = 0.941176471f;
        return 1.0f - PHASE_MURKY_ISOTROPIC;
    case PHASE_HENYEY_GREENSTEIN:
        *lobe_g = g;
        return 1.0f;
    default:
        *lobe_g = 0.0f;
        return 0.0f;
    }
}

/* Int p L over all directions of one channel, toward w: the light is taken as
 * a lobe of Henyey and Greenstein around the flux, of its mean cosine; that
 * folded with the medium's is one again, their g multiplied (METHODS.md
 * 6.1). */
HD float radiance_channel(float fluence, vec3 flux, float lobe, float g,
                          vec3 w)
{
    float even = (1.0f - lobe) * WARP_INV_4PI * fluence;
    float size = vec3_length(flux);
    if (lobe == 0.0f)
        return even;
    if (!(size > 0.0f) || !(fluence > 0.0f))
        return even + lobe * WARP_INV_4PI * fluence;
    float mean = hd_min(size / fluence, 0.999f);
    float cosine = hd_max(hd_min(vec3_dot(flux, w) / size, 1.0f), -1.0f);
    return even + lobe * fluence *
           phase_hg_eval(g * mean, 1.0f - cosine, 1.0f + cosine);
}

/* What a medium scatters of the field's light toward the unit vector w, per
 * scattering coefficient. */
HD rgb radiance_toward(const radiance_point *x, int kind, float g, vec3 w)
{
    float lobe_g, lobe = radiance_lobe(kind, g, &lobe_g);
    return rgb_make(
        radiance_channel(x->fluence.r, x->flux[0], lobe, lobe_g, w),
        radiance_channel(x->fluence.g, x->flux[1], lobe, lobe_g, w),
        radiance_channel(x->fluence.b, x->flux[2], lobe, lobe_g, w));
}

/* The same of a point read for the eye, w the way there. */
HD rgb radiance_seen(const flat_scene *s, const radiance_point *x, int kind,
                     float g, vec3 w)
{
    return s->field.eye >= 0 ? x->eye : radiance_toward(x, kind, g, w);
}

#endif
