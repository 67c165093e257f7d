/* walk.h - a ray through the media around it, in pieces over which every
 * medium's majorant is constant.
 *
 * Each medium has a lattice of majorant cells (or one bound for all space);
 * the walk steps through all active lattices at once. Plane crossings are
 * computed from integer planes, never accumulated, and a piece never goes
 * backward, so that the walk ends after at most the sum of the lattices'
 * dimensions in steps (METHODS.md 1.1 and 12). */
#ifndef CORE_PHYSICS_WALK_H
#define CORE_PHYSICS_WALK_H
#include "core/physics/medium.h"

/* The shapes whose interiors a point lies in. */
typedef struct {
    int32_t count;
    uint32_t lost;          /* entered beyond MAX_CONTAINERS: not followed */
    int32_t shape[MAX_CONTAINERS];
} container_set;

/* The bounds and places of these small lists: where they hold one at most,
 * a GPU keeps them in registers. */
HD int part_bound(int count)
{
    return scene_may(MAY_MANY) ? count : count > 0;
}

HD int part_place(int i)
{
    return scene_may(MAY_MANY) ? i : 0;
}

HD int container_count(const container_set *set)
{
    return part_bound(set->count);
}

HD int32_t container_shape(const container_set *set, int i)
{
    return set->shape[part_place(i)];
}

/* The interior of container i, or -1; i = -1: the atmosphere's. */
HD int32_t container_interior(const flat_scene *s, const container_set *set,
                              int i)
{
    return i < 0 ? s->atmosphere : s->shapes[container_shape(set, i)].interior;
}

/* One medium's lattice along the ray. */
typedef struct {
    int32_t medium;
    int32_t cell[3];
    int32_t inside;         /* of the lattice                              */
    float enter, leave;     /* distances to the lattice; enter < leave, or
                               both infinite where the ray misses it       */
    float next[3];          /* distances to the next plane of each axis    */
    vec3 o, d;              /* the ray in lattice coordinates              */
    float inverse[3];       /* walk_inverse of d                           */
    float t_end;            /* end of the current piece                    */
    majorant_cell bound;
} lattice_walk;

typedef struct {
    int32_t count;
    lattice_walk part[MAX_ACTIVE];
    float t, t_end;         /* the current piece                           */
    float t_max;
    uint32_t overflow;      /* media left out: more than MAX_ACTIVE        */
} media_walk;

HD int walk_parts(const media_walk *w)
{
    return part_bound(w->count);
}

HD const lattice_walk *walk_part(const media_walk *w, int i)
{
    return &w->part[part_place(i)];
}

HD const flat_medium *walk_medium(const flat_scene *s, const media_walk *w,
                                  int i)
{
    return scene_medium(s, walk_part(w, i)->medium);
}

/* 1 / d; 0 where the ray crosses no plane of the axis. */
HD float walk_inverse(float d)
{
    return fabsf(d) > 1e-30f ? 1.0f / d : 0.0f;
}

/* Distance at which an axis leaves a cell. */
HD float walk_plane(float o, float inverse, int32_t cell)
{
    return inverse == 0.0f ? INFINITY
                           : ((float)(cell + (inverse > 0.0f)) - o) * inverse;
}

/* Goes over the nearest plane of a lattice of unit cells into *at, the new
 * place along the axis that is returned. Chosen by values, not by ways: threads
 * stay together. */
HD int walk_cross(vec3 o, const float *inverse, int32_t *cell, float *next,
                  int32_t *at)
{
    bool y = !(next[0] <= next[1]);
    bool z = !((y ? next[1] : next[0]) <= next[2]);
    int axis = z ? 2 : y ? 1 : 0;
    float from = z ? o.z : y ? o.y : o.x;
    float slope = z ? inverse[2] : y ? inverse[1] : inverse[0];
    *at = (z ? cell[2] : y ? cell[1] : cell[0]) + (slope > 0.0f ? 1 : -1);
    float plane = walk_plane(from, slope, *at);
    for (int i = 0; i < 3; i++) {
        cell[i] = i == axis ? *at : cell[i];
        next[i] = i == axis ? plane : next[i];
    }
    return axis;
}

HD float lattice_next(const lattice_walk *w)
{
    return hd_min(hd_min(w->next[0], hd_min(w->next[1], w->next[2])), w->leave);
}

HD void lattice_load(const flat_scene *s, lattice_walk *w)
{
    const flat_medium *m = scene_medium(s, w->medium);
    uint32_t i = (uint32_t)w->cell[0] +
        (uint32_t)m->cells[0] * ((uint32_t)w->cell[1] +
                                 (uint32_t)m->cells[1] * (uint32_t)w->cell[2]);
    w->bound = s->cells[m->cell + i];
}

HD void lattice_outside(const flat_scene *s, lattice_walk *w, float t_end)
{
    w->inside = 0;
    w->bound = scene_medium(s, w->medium)->outside;
    w->t_end = t_end;
}

/* Starts the cell that contains distance t. */
HD void lattice_enter(const flat_scene *s, lattice_walk *w, float t)
{
    const flat_medium *m = scene_medium(s, w->medium);
    w->inside = 1;
    for (int axis = 0; axis < 3; axis++) {
        float x = vec3_get(w->o, axis) + t * vec3_get(w->d, axis);
        int c = hd_floor(hd_max(x, 0.0f));
        w->cell[axis] = c < m->cells[axis] ? c : m->cells[axis] - 1;
        w->next[axis] = walk_plane(vec3_get(w->o, axis), w->inverse[axis],
                                   w->cell[axis]);
    }
    lattice_load(s, w);
    w->t_end = hd_max(lattice_next(w), t);
}

/* Where the ray is inside the lattice's box. */
HD void lattice_clip(const flat_medium *m, lattice_walk *w)
{
    float enter = -INFINITY, leave = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        float o = vec3_get(w->o, axis), size = (float)m->cells[axis];
        float inverse = walk_inverse(vec3_get(w->d, axis));
        w->inverse[axis] = inverse;
        if (inverse == 0.0f) {
            if (!(o >= 0.0f && o < size))
                leave = -INFINITY;
            continue;
        }
        float a = (0.0f - o) * inverse, b = (size - o) * inverse;
        enter = hd_max(enter, hd_min(a, b));
        leave = hd_min(leave, hd_max(a, b));
    }
    bool hit = enter < leave;
    w->enter = hit ? enter : INFINITY;
    w->leave = hit ? leave : INFINITY;
}

HD void lattice_begin(const flat_scene *s, lattice_walk *w, int medium,
                      vec3 o, vec3 d, float t)
{
    const flat_medium *m = scene_medium(s, medium);
    w->medium = medium;
    if (m->uniform) {
        lattice_outside(s, w, INFINITY);
        w->enter = w->leave = INFINITY;
        return;
    }
    w->o = affine_point(&m->to_cell, o);
    w->d = affine_vector(&m->to_cell, d);
    lattice_clip(m, w);
    if (t < w->enter)
        lattice_outside(s, w, w->enter);
    else if (t < w->leave)
        lattice_enter(s, w, t);
    else
        lattice_outside(s, w, INFINITY);
}

/* Over the nearest plane; false: out of the lattice. */
HD bool lattice_cross(lattice_walk *w, const int32_t *cells)
{
    int32_t at;
    int axis = walk_cross(w->o, w->inverse, w->cell, w->next, &at);
    int32_t end = axis == 2 ? cells[2] : axis == 1 ? cells[1] : cells[0];
    return at >= 0 && at < end;
}

/* Goes on from the end of the current piece. */
HD void lattice_step(const flat_scene *s, lattice_walk *w)
{
    float t = w->t_end;
    if (!w->inside) {
        lattice_enter(s, w, t);
        return;
    }
    if (!(t < w->leave)) {
        lattice_outside(s, w, INFINITY);
        return;
    }
    if (!lattice_cross(w, scene_medium(s, w->medium)->cells)) {
        lattice_outside(s, w, INFINITY);
        return;
    }
    lattice_load(s, w);
    w->t_end = hd_max(lattice_next(w), t);
}

HD float lattice_clamp(float x, int32_t cell)
{
    return hd_at_most(hd_at_least(x, (float)cell), (float)(cell + 1));
}

/* The point p at distance t, in the current cell of the lattice however far the
 * ray has come: the cell's bound holds for what is read there. Where all fields
 * are on that lattice its place in space is not told. */
HD field_point lattice_inside(const flat_scene *s, const lattice_walk *w,
                              vec3 p, float t)
{
    const flat_medium *m = scene_medium(s, w->medium);
    vec3 q = vec3_mad(w->o, t, w->d);
    field_point x;
    x.p = scene_may(MAY_MANY | MAY_FUNCTIONS) ? p : q;
    const float side = m->side;
    x.index = vec3_make(side * lattice_clamp(q.x, w->cell[0]) + m->origin[0],
                        side * lattice_clamp(q.y, w->cell[1]) + m->origin[1],
                        side * lattice_clamp(q.z, w->cell[2]) + m->origin[2]);
    x.lattice = scene_lead(s, m)->lattice;
    return x;
}

/* The same, also outside of the lattice. */
HD field_point lattice_point(const flat_scene *s, const lattice_walk *w,
                             vec3 p, float t)
{
    return w->inside ? lattice_inside(s, w, p, t)
                     : medium_point(s, scene_medium(s, w->medium), p);
}

HD void walk_set_end(media_walk *w)
{
    w->t_end = w->t_max;
    for (int i = 0; i < walk_parts(w); i++)
        w->t_end = hd_min(w->t_end, walk_part(w, i)->t_end);
}

HD void walk_add_interior(const flat_scene *s, media_walk *w, int interior,
                          vec3 o, vec3 d)
{
    if (interior < 0)
        return;
    const flat_interior *in = &s->interiors[interior];
    for (int i = 0; i < in->count; i++) {
        if (w->count == MAX_ACTIVE) {
            w->overflow++;
            continue;
        }
        lattice_begin(s, &w->part[part_place(w->count)],
                      s->interior_media[in->first + i], o, d, w->t);
        w->count++;
    }
}

/* Begins a walk from distance t0 to t1 through the interiors of `set` and the
 * atmosphere; its first piece is current. d need not be of unit length as far
 * as the walk goes: t counts multiples of d. */
HD void walk_begin(const flat_scene *s, media_walk *w,
                   const container_set *set, bool atmosphere, vec3 o, vec3 d,
                   float t0, float t1)
{
    w->count = 0;
    w->overflow = set->lost;
    w->t = t0;
    w->t_max = t1;
    if (atmosphere)
        walk_add_interior(s, w, s->atmosphere, o, d);
    for (int i = 0; i < container_count(set); i++)
        walk_add_interior(s, w, container_interior(s, set, i), o, d);
    walk_set_end(w);
}

/* The walk ends at t, which its current piece does not lie beyond. */
HD void walk_stop(media_walk *w, float t)
{
    w->t_max = t;
    walk_set_end(w);
}

/* Whether the current piece lies in a cell without boundaries. */
HD bool walk_is_clear(const media_walk *w)
{
    return w->count == 1 && w->part[0].inside && w->part[0].bound.clear;
}

/* The next piece; false at the end of the ray. */
HD bool walk_next(const flat_scene *s, media_walk *w)
{
    if (!(w->t_end < w->t_max))
        return false;
    w->t = w->t_end;
    for (int i = 0; i < walk_parts(w); i++)
        while (w->part[part_place(i)].t_end <= w->t)
            lattice_step(s, &w->part[part_place(i)]);
    walk_set_end(w);
    return true;
}

HD bool container_has(const container_set *set, int shape)
{
    for (int i = 0; i < container_count(set); i++)
        if (container_shape(set, i) == shape)
            return true;
    return false;
}

/* Entering twice, or leaving what was not entered, changes nothing: it is
 * what rounding at edges can make of one boundary. */
HD void container_enter(container_set *set, int shape)
{
    if (container_has(set, shape))
        return;
    if (set->count < MAX_CONTAINERS)
        set->shape[part_place(set->count++)] = shape;
    else
        set->lost++;
}

HD bool container_is_unbounded(const flat_scene *s, int shape)
{
    for (uint64_t i = 0; i < s->unbounded_count; i++)
        if (s->unbounded[i] == shape)
            return true;
    return false;
}

/* A ray that hits nothing is in nothing bounded: where rounding put its origin
 * beyond a boundary, it has left. */
HD void container_leave_bounded(const flat_scene *s, container_set *set)
{
    int kept = 0;
    for (int i = 0; i < container_count(set); i++)
        if (container_is_unbounded(s, container_shape(set, i)))
            set->shape[part_place(kept++)] = container_shape(set, i);
    set->count = kept;
}

HD void container_leave(container_set *set, int shape)
{
    for (int i = 0; i < container_count(set); i++)
        if (container_shape(set, i) == shape) {
            set->shape[part_place(i)] = set->shape[part_place(--set->count)];
            return;
        }
}

#endif
