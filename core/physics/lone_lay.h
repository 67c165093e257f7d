/* lone_lay.h - how flights of photon_lone.h are laid into the field: what
 * radiance.h does, to the bit, in fewer instructions of a GPU. */
#ifndef CORE_PHYSICS_LONE_LAY_H
#define CORE_PHYSICS_LONE_LAY_H
#include "core/physics/photon_lone.h"

/* What is laid of a flight, and how far that is, as radiance_walk has it. */
typedef struct {
    vec3 o, d;
    rgb power;
    vec3 at;                /* o, in cells                                 */
    float inverse[3];
} lone_line;

typedef struct {
    float t, end;
    float next[3];
    int32_t cell[3];
} lone_walk;

/* Floor of a number well within those of 32 bits. */
HD int lone_floor(float x)
{
#ifdef __CUDA_ARCH__
    return __float2int_rd(x);
#else
    return hd_floor(x);
#endif
}

/* Cuts a walk off at the ends of an axis of the lattice; false: it misses
 * that. */
HD bool lone_clip(float at, float inverse, float size, lone_walk *w)
{
    if (inverse == 0.0f)
        return at >= 0.0f && at < size;
    float a = -at * inverse, b = (size - at) * inverse;
    w->t = hd_max(w->t, hd_min(a, b));
    w->end = hd_min(w->end, hd_max(a, b));
    return true;
}

/* radiance_begin; `inside`: both ends are inside of the lattice. */
HD bool lone_begin_walk(const flat_scene *s, const lone_scene *l, bool inside,
                        const lone_photon *p, lone_line *y, lone_walk *w)
{
    const radiance_lattice *f = &s->field;
    float at[3], along[3];
    bool meets = true;
    for (int i = 0; i < 3; i++) {
        along[i] = fm_over_known(vec3_get(p->d, i), f->side, l->per_side);
        at[i] = fm_over_known(vec3_get(p->o, i) - f->origin[i], f->side,
                              l->per_side);
        y->inverse[i] = fabsf(along[i]) > 1e-30f ? fm_inverse_within(along[i])
                                                 : 0.0f;
    }
    y->at = vec3_make(at[0], at[1], at[2]);
    for (int i = 0; !inside && i < 3; i++)
        if (!lone_clip(at[i], y->inverse[i], (float)(8 * f->bricks[i]), w))
            meets = false;
    for (int i = 0; i < 3; i++) {
        int c = lone_floor(at[i] + w->t * along[i]);
        int last = 8 * f->bricks[i] - 1;
        w->cell[i] = c < 0 ? 0 : c > last ? last : c;
        w->next[i] = walk_plane(at[i], y->inverse[i], w->cell[i]);
    }
    return meets && w->t < w->end;
}

/* Begins to lay a flight; false: there is nothing to lay. */
HD bool lone_lays(const flat_scene *s, const lone_scene *l,
                  const lone_photon *p, const lone_end *f,
                  lone_line *line, lone_walk *w)
{
    bool sure = (p->marks & (LONE_SURE | LONE_BEHIND | LONE_SOUGHT)) ==
                LONE_SURE;
    if (!(p->marks & LONE_STORED))
        return false;
    line->o = p->o;
    line->d = p->d;
    line->power = lone_beta(p->lays);
    w->t = p->laid;
    w->end = f->t;
    return lone_begin_walk(s, l, sure && l->covered, p, line, w);
}

/* radiance_to_eye. */
HD vec3 lone_to_eye(const flat_scene *s, vec3 p)
{
    const camera *c = &s->view;
    return warp_normalize(c->orthographic ? vec3_scale(c->direction, -1.0f)
                                          : vec3_sub(c->location, p));
}

/* radiance_deposit, of any field; returns how many were too large. */
HD_APART track_count lone_deposit_any(const flat_scene *s, int64_t *sum,
                                      int32_t cell, vec3 p, vec3 d, rgb value)
{
    radiance_tally t;
    t.sum = sum;
    t.clipped = 0;
    radiance_deposit(s, &t, cell, p, d, value);
    return (track_count)t.clipped;
}

HD void lone_deposit(const flat_scene *s, const lone_scene *l, int64_t *sum,
                     lone_counts *count, int32_t cell, vec3 p, vec3 d,
                     rgb value)
{
    radiance_tally t;
    t.clipped = 0;
    if (!l->peaked) {
        count->clipped += lone_deposit_any(s, sum, cell, p, d, value);
        return;
    }
    if (radiance_clips(&t, value)) {
        count->clipped++;
        return;
    }
    vec3 off = vec3_sub(d, lone_to_eye(s, p));
    float x = l->law[0] + l->law[1] * (0.5f * vec3_dot(off, off));
    float law = fm_over_within(l->law[2], x * fm_root_within(x));
    uint64_t first = (uint64_t)(uint32_t)cell * (uint32_t)s->field.numbers;
    radiance_add_rgb(sum + s->field.eye + first, rgb_scale(value, law));
}

/* The cell in which a walk is: its number, or -1. */
HD int32_t lone_cell(const flat_scene *s, const int32_t *at)
{
    const radiance_lattice *f = &s->field;
    int32_t brick = (at[2] >> 3) * f->bricks[1] + (at[1] >> 3);
    int32_t slot = s->radiance_slots[brick * f->bricks[0] + (at[0] >> 3)];
    int32_t in = ((at[2] & 7) << 6) + ((at[1] & 7) << 3) + (at[0] & 7);
    return slot < 0 ? -1 : slot * 512 + in;
}

/* Where the walk leaves its cell, or ends. */
HD float lone_leaves_cell(const lone_walk *w)
{
#ifdef __CUDA_ARCH__
    float next = fminf(fminf(w->next[0], w->next[1]), w->next[2]);
    return fmaxf(w->t, fminf(next, w->end));
#else
    float next = hd_min(w->next[0], hd_min(w->next[1], w->next[2]));
    return hd_max(w->t, hd_min(next, w->end));
#endif
}

/* radiance_lay for a field whose cells are of one size. */
HD bool lone_lay(const flat_scene *s, const lone_scene *l, int64_t *sum,
                 lone_counts *count, const lone_line *y, lone_walk *w)
{
    float from = w->t;
    int32_t cell = lone_cell(s, w->cell), at;
    bool more = false;
    w->t = lone_leaves_cell(w);
    if (w->t < w->end) {
        int axis = walk_cross(y->at, y->inverse, w->cell, w->next, &at);
        const int32_t *n = s->field.bricks;
        more = (uint32_t)at >> 3 <
               (uint32_t)(axis == 2 ? n[2] : axis == 1 ? n[1] : n[0]);
    }
    float length = w->t - from;
    if (cell < 0 || !(length > 0.0f))
        return more;
    float share = fm_over_known(length, s->field.side, l->per_side);
    lone_deposit(s, l, sum, count, cell,
                 vec3_mad(y->o, from + 0.5f * length, y->d), y->d,
                 rgb_scale(lone_beta(y->power), share));
    return more;
}

#endif
