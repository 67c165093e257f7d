#include "core/plan.h"
#include "core/order.h"
#include "core/photons.h"
#include "core/prepare.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include "core/physics/pixel.h"
#include "core/radiance.h"

static bool has_surfaces(const struct flat *f)
{
    for (size_t i = 0; i < f->shapes_count; i++)
        if (f->shapes[i].material >= 0)
            return true;
    return false;
}

static bool has_emission(const struct flat *f)
{
    for (size_t i = 0; i < f->media_count; i++)
        if (f->media[i].emits)
            return true;
    return false;
}

/* Whether any light can reach a scattering event in a medium. */
static bool is_lit(const struct flat *f)
{
    const flat_scene *v = &f->view;
    return f->lights_count > 0 || (v->media_multiple && has_emission(f)) ||
           (v->environment &&
            (f->sky_count > 0 || !rgb_is_black(v->background)));
}

/* Whether light can reach a medium that has been scattered before, or that
 * no light gives. */
static bool needs_field(const struct flat *f)
{
    const scene_reach *r = &f->view.reach;
    return f->view.scatters && f->view.media_multiple && r->lo[0] <= r->hi[0];
}

bool plan_layout(struct flat *flat, const struct brume_options *options,
                 struct brume_error *err)
{
    if (!plan_stages(flat, options).photons)
        return true;
    return (!photons_seek(&flat->view) || order_build(flat, err)) &&
           radiance_layout(flat, options, err);
}

/* From so many on: below, a GPU's launches take longer than the CPU does. */
#define WORTH_LEAVING 1024

bool plan_leaves_tree(const struct flat *flat, enum brume_tree tree)
{
    return tree != BRUME_TREE_BOTH &&
           flat->shapes_count + flat->triangles_count >= WORTH_LEAVING;
}

/* Whether a point may lie in several media, or shapes with media, or there are
 * several at all: of one a GPU has the records as constants. */
static bool has_many(const struct flat *f)
{
    int shapes = 0, media = 0, atmosphere = 0;
    for (size_t i = 0; i < f->shapes_count; i++) {
        const flat_shape *shape = &f->shapes[i];
        if (shape->interior < 0 || !(shape->flags & SHAPE_HOLLOW))
            continue;
        shapes++;
        media += f->interiors[shape->interior].count;
    }
    if (f->view.atmosphere >= 0)
        atmosphere = f->interiors[f->view.atmosphere].count;
    for (size_t i = 0; i < f->media_count; i++)
        if (f->media[i].planes > 1)
            return true;
    return shapes > 1 || media + atmosphere > 1 || f->media_count > 1;
}

static bool has_clear(const struct flat *f)
{
    for (size_t i = 0; i < f->media_count; i++)
        if (rgb_is_black(f->media[i].sigma_s))
            return true;
    return false;
}

static bool is_gray(rgb c)
{
    return c.r == c.g && c.g == c.b;
}

/* Whether the channels fly differently through some medium. */
static bool has_colors(const struct flat *f)
{
    for (size_t i = 0; i < f->media_count; i++) {
        const flat_medium *m = &f->media[i];
        if (m->functions || !is_gray(m->sigma_a) || !is_gray(m->sigma_s) ||
            !is_gray(m->sigma_t) || !is_gray(m->bound))
            return true;
    }
    return false;
}

/* Whether light of several colours can come to media, or become so. */
static bool has_tints(const struct flat *f)
{
    for (size_t i = 0; i < f->lights_count; i++)
        if (!is_gray(f->lights[i].color))
            return true;
    return has_colors(f) || has_emission(f) || has_surfaces(f) ||
           f->sky_count > 0 || !is_gray(f->view.background);
}

static bool has_solids(const struct flat *f)
{
    for (size_t i = 0; i < f->shapes_count; i++)
        if (leaf_is_solid(&f->shapes[i]))
            return true;
    return false;
}

static bool has_functions(const struct flat *f)
{
    for (size_t i = 0; i < f->materials_count; i++)
        if (f->materials[i].function >= 0)
            return true;
    for (size_t i = 0; i < f->media_count; i++)
        if (f->media[i].functions || f->media[i].sampled)
            return true;
    return f->sky_count > 0 && f->sky[0].function >= 0;
}

static bool has_kd(const struct flat *f)
{
    return f->kd_count > 0 || (f->order && f->order->tree == BRUME_TREE_KD);
}

/* Whether paths end at their first event, in a medium or on a surface. */
static bool is_single(const struct flat *f)
{
    return !f->view.media_multiple ||
           (has_surfaces(f) && !f->view.surfaces_indirect);
}

static int scene_needs(const struct flat *f)
{
    return (has_solids(f) ? MAY_SOLIDS : 0) |
           (f->csg_count > 0 ? MAY_COMPOSITES : 0) |
           (has_functions(f) ? MAY_FUNCTIONS : 0) |
           (f->triangles_count > 0 ? MAY_MESHES : 0) |
           (has_surfaces(f) ? MAY_SURFACES : 0) |
           (has_emission(f) ? MAY_EMISSION : 0) |
           (f->sky_count > 0 ? MAY_SKY : 0) |
           (f->plate_count > 0 ? MAY_PLATE : 0) |
           (f->view.local_lights ? MAY_LAMPS : 0) |
           (has_kd(f) ? MAY_KDTREE : 0) | (has_many(f) ? MAY_MANY : 0) |
           (has_colors(f) ? MAY_COLORS : 0) |
           (f->view.field.ball ? MAY_BALLS : 0) |
           (has_clear(f) ? MAY_CLEAR : 0) | (has_tints(f) ? MAY_TINTS : 0);
}

/* Whether samples of functions along straight lines make noise that is seen,
 * and that surfaces do not drown. */
static bool has_noisy_lines(const struct flat *f)
{
    bool seen = f->sky_count > 0 || f->plate_count > 0 ||
                !rgb_is_black(f->view.background);
    bool sampled = false;
    for (size_t i = 0; i < f->media_count; i++) {
        sampled |= f->media[i].sampled != 0;
        seen |= f->media[i].sampled && f->media[i].emits;
    }
    return sampled && seen && !has_surfaces(f);
}

struct stages plan_stages(const struct flat *f,
                          const struct brume_options *options)
{
    struct stages s;
    s.load = f->tiles_count > 0;
    s.accel = f->bvh_count > 0 || f->kd_count > 0 || f->order;
    s.glow = f->glows_count > 0;
    s.march = true;
    bool lit = f->view.scatters && is_lit(f);
    s.photons = options->integrator != BRUME_INTEGRATOR_PATH &&
                needs_field(f) && (lit || has_surfaces(f));
    s.passes = s.photons && options->integrator == BRUME_INTEGRATOR_PROGRESSIVE;
    /* What the field holds no path looks for. */
    s.cells = s.photons && f->lights_count > 0 &&
              options->photons.single == BRUME_SINGLE_FIELD;
    s.single = f->view.scatters && f->lights_count > 0 && !s.cells;
    s.path = has_surfaces(f) || (lit && !s.photons);
    /* What cells hold of it comes along lines: edges are smoothed there. */
    s.lines = s.passes || has_noisy_lines(f) ||
              (s.photons && radiance_keeps_lit(f, options));
    s.needs = scene_needs(f) | (s.photons ? MAY_FIELD : 0) |
              (s.photons || is_single(f) ? MAY_SINGLE : 0);
    return s;
}

static void add_stage(struct brume_plan *plan, const char *name, bool runs,
                      uint64_t bytes, const char *reason)
{
    struct brume_stage *s = &plan->stage[plan->stages++];
    snprintf(s->name, sizeof s->name, "%s", name);
    snprintf(s->reason, sizeof s->reason, "%s", reason);
    s->runs = runs;
    s->bytes = runs ? bytes : 0;
}

BRUME_PRINTF(2, 3)
static void add_note(struct brume_plan *plan, const char *format, ...)
{
    if (plan->notes == BRUME_MAX_NOTES)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(plan->note[plan->notes], sizeof plan->note[0], format, args);
    va_end(args);
    plan->notes++;
}

static const char *photon_reason(const struct flat *f,
                                 const struct brume_options *options,
                                 const struct stages *s)
{
    if (options->integrator == BRUME_INTEGRATOR_PATH)
        return "the integrator is path";
    if (s->photons)
        return "media scatter, many times";
    if (!f->view.scatters)
        return "no medium scatters";
    if (!f->view.media_multiple)
        return "the transport scatters once";
    return is_lit(f) || has_surfaces(f) ? "no medium that scatters has a place"
                                        : "nothing lights the media";
}

/* Bytes of the fields that are kept while one is filtered. */
static uint64_t ring_bytes(const struct flat *f,
                           const struct brume_options *options)
{
    return (uint64_t)(2 * brume_film_reach(options) + 1) *
           (f->radiance_count * sizeof *f->radiance +
            f->radiance_slots_count * sizeof *f->radiance_slots);
}

static const char *filter_reason(const struct brume_options *options,
                                 const struct stages *s)
{
    if (!s->photons)
        return "there is no field of scattered light";
    return brume_film_reach(options) > 0
               ? "the field is a mean over frames of the film"
               : "a picture alone, or temporal is 1";
}

static const char *single_reason(const struct flat *f,
                                 const struct brume_options *options,
                                 const struct stages *s)
{
    if (s->cells)
        return "the cells of the field hold it";
    if (s->photons && radiance_keeps_lit(f, options))
        return "lights reach media: cells hold it, and the eye's rays sample "
               "what they are wrong by";
    if (s->single)
        return "lights reach media: sampled along the eye's rays";
    return f->view.scatters ? "there is no light" : "no medium scatters";
}

static const char *path_reason(const struct flat *f, const struct stages *s)
{
    if (!s->path && s->photons)
        return "no surface, and the field holds the rest";
    if (!s->path)
        return f->view.scatters ? "nothing lights the scattering media"
                                : "no surface, and no medium scatters";
    if (!f->view.scatters || s->photons)
        return "surfaces are lit";
    return f->view.media_multiple ? "media scatter, many times"
                                  : "media scatter, once";
}

static const char *glow_reason(const struct flat *f, const struct stages *s)
{
    if (s->glow)
        return "emission of media lights the scene";
    if (!has_emission(f))
        return "no medium emits";
    if (!f->view.media_multiple && !f->view.surfaces_indirect)
        return "the transport follows no light beyond the first event";
    return "emission has no grid, or is zero";
}

static const char *accel_reason(const struct flat *f)
{
    if (f->order)
        return has_kd(f)
                   ? "there is bounded geometry, in a kd-tree, built on the GPU"
                   : "there is bounded geometry, in a BVH, built on the GPU";
    if (f->bvh_count > 0 && f->kd_count > 0)
        return "there is bounded geometry, in a BVH and a kd-tree";
    if (f->bvh_count > 0)
        return "there is bounded geometry, in a BVH";
    return f->kd_count > 0 ? "there is bounded geometry, in a kd-tree"
                           : "there is no bounded geometry";
}

static uint64_t grid_bytes(const struct flat *f)
{
    return f->voxels_count * sizeof *f->voxels +
           f->slots_count * sizeof *f->slots +
           f->cells_count * sizeof *f->cells;
}

/* Bricks of each level. */
static void note_levels(const struct flat *f, struct brume_plan *plan)
{
    const radiance_lattice *l = &f->view.field;
    size_t bricks[4] = {0};
    for (size_t i = 0; i < f->radiance_slots_count; i++)
        if (f->radiance_slots[i] >= 0)
            bricks[f->radiance_slots[i] & 3]++;
    add_note(plan,
             "field of scattered light: %zu cells, %zu of %d x %d x %d bricks "
             "with cells of %g on a side, %zu, %zu, %zu with cells 2, 4, 8 "
             "times as large; %d numbers in each",
             radiance_cells(f), bricks[0], l->bricks[0], l->bricks[1],
             l->bricks[2], (double)l->side / f->unit, bricks[1], bricks[2],
             bricks[3], l->numbers);
}

static void note_field(const struct flat *f,
                       const struct brume_options *options,
                       struct brume_plan *plan)
{
    const radiance_lattice *l = &f->view.field;
    if (l->numbers == 0)
        return;
    if (l->refined) {
        note_levels(f, plan);
        return;
    }
    add_note(plan,
             "field of scattered light: %zu of %d x %d x %d bricks of 8^3 "
             "cells, %g on a side, %d numbers in each",
             radiance_cells(f) / 512, l->bricks[0], l->bricks[1], l->bricks[2],
             (double)l->side / f->unit, l->numbers);
    if (radiance_drawn_numbers(f, options) > l->numbers)
        add_note(plan,
                 "its cells have %d numbers once it is filtered, with light "
                 "straight from lights",
                 radiance_drawn_numbers(f, options));
    if (options->photons.depth > 0.0)
        add_note(plan, "its cells are of one size: %s",
                 l->ball ? "balls gather it"
                         : "a film's have to agree, and "
                           "progressive ones shrink");
}

static void note_function(const struct flat *f, size_t field,
                          struct brume_plan *plan)
{
    const flat_field *in = &f->fields[field];
    if (in->kind == FIELD_FUNCTION) {
        const flat_procedure *p = &f->procedures[in->grid];
        add_note(plan,
                 "field %zu: a function, evaluated where it is needed; bounds "
                 "by samples in %d x %d x %d cells",
                 field, p->cells[0], p->cells[1], p->cells[2]);
        return;
    }
    const flat_grid *g = &f->grids[in->grid];
    add_note(plan,
             "field %zu: a function that fills unbounded space, on a grid of "
             "%d x %d x %d bricks of 8^3 samples",
             field, g->bricks[0], g->bricks[1], g->bricks[2]);
}

static void note_grids(const brume_scene *scene, const struct flat *f,
                       struct brume_plan *plan)
{
    for (size_t i = 0; i < scene->grids_count; i++) {
        const struct grid *g = scene->grids[i];
        add_note(plan,
                 "grid %zu '%s': %zu of %zu bricks stored, values %g "
                 "to %g",
                 i, g->name, g->stored,
                 (size_t)g->bricks[0] * (size_t)g->bricks[1] *
                     (size_t)g->bricks[2],
                 (double)g->lowest, (double)g->highest);
        if (g->points > 0)
            add_note(plan,
                     "grid %zu: of %zu particles of radius %g to %g, on voxels "
                     "of %g",
                     i, g->points, (double)g->radius[0], (double)g->radius[1],
                     g->to_world[0][0]);
    }
    for (size_t i = 0; i < scene->fields_count; i++)
        if (scene->fields[i].kind == BRUME_FIELD_FUNCTION)
            note_function(f, i, plan);
    for (size_t i = 0; i < f->media_count; i++) {
        const flat_medium *m = &f->media[i];
        if (!m->uniform)
            add_note(plan,
                     "medium %zu: majorants of %d x %d x %d cells of "
                     "%g^3 voxels",
                     i, m->cells[0], m->cells[1], m->cells[2], (double)m->side);
    }
}

/* The range a field's file says it has; of a function, up to its largest. */
static void field_range(const brume_scene *s, const struct flat *flat,
                        int field, double *lo, double *hi)
{
    const struct brume_field *f = &s->fields[field];
    *lo = *hi = f->scale;
    if (f->kind == BRUME_FIELD_FUNCTION) {
        *lo = 0.0;
        *hi = (double)prepare_field_bound_everywhere(flat, field);
    }
    if (f->kind == BRUME_FIELD_GRID) {
        *lo *= (double)s->grids[f->grid]->lowest;
        *hi *= (double)s->grids[f->grid]->highest;
    }
}

static void note_fires(const brume_scene *scene, const struct flat *flat,
                       struct brume_plan *plan)
{
    for (size_t i = 0; i < scene->media_count; i++) {
        const struct brume_fire *f = &scene->media[i].fire;
        double lo, hi;
        if (!f->on)
            continue;
        field_range(scene, flat, f->temperature, &lo, &hi);
        lo = f->kelvin_scale * lo + f->kelvin_offset;
        hi = f->kelvin_scale * hi + f->kelvin_offset;
        add_note(plan, "fire of medium %zu: %.0f to %.0f kelvin%s", i,
                 fmin(lo, hi), fmax(lo, hi),
                 fmax(lo, hi) < 500.0
                     ? ", too cold to be seen (a black body glows from 500)"
                     : "");
        if (!f->additive && scene->media[i].absorption[0] == 0.0 &&
            scene->media[i].absorption[1] == 0.0 &&
            scene->media[i].absorption[2] == 0.0)
            add_note(plan,
                     "fire of medium %zu: its coupling is absorption, "
                     "which is zero, so it emits nothing",
                     i);
    }
}

static const char *plate_reason(const struct flat *f)
{
    if (f->plate_count == 0)
        return "there is no plate";
    for (size_t i = 0; i < f->plate_count; i++)
        if (f->plate[i].depth < INFINITY)
            return "the eye sees a plate, at the depths of its pixels";
    return "the eye sees a plate, behind all that there is";
}

static void note_plate(const struct flat *f,
                       const struct brume_options *options,
                       struct brume_plan *plan)
{
    size_t deep = 0, clear = 0;
    double lo = INFINITY, hi = 0.0;
    for (size_t i = 0; i < f->plate_count; i++) {
        const plate_pixel *p = &f->plate[i];
        clear += p->pass > 0.0f;
        if (!(p->depth < INFINITY))
            continue;
        deep++;
        lo = fmin(lo, (double)p->depth / f->unit);
        hi = fmax(hi, (double)p->depth / f->unit);
    }
    if (f->plate_count == 0)
        return;
    add_note(plan, "plate of %d x %d pixels: %zu with a depth, %zu not opaque",
             options->width, options->height, deep, clear);
    if (deep > 0)
        add_note(plan, "the plate's depths: %g to %g, along %s", lo, hi,
                 f->view.plate_ray ? "rays" : "the direction of view");
}

void plan_describe(const brume_scene *scene, const struct flat *f,
                   const struct brume_options *options, struct brume_plan *plan)
{
    struct stages s = plan_stages(f, options);
    uint64_t pixels = (uint64_t)options->width * (uint64_t)options->height;
    memset(plan, 0, sizeof *plan);
    add_stage(plan, "load", s.load, grid_bytes(f),
              s.load ? "media read grids" : "no medium reads a grid");
    add_stage(plan, "accel", s.accel,
              order_bytes(f) + f->bvh_count * sizeof *f->bvh +
                  f->kd_count * sizeof *f->kd +
                  (f->bvh_items_count + f->kd_items_count) * 4u +
                  f->triangles_count * sizeof *f->triangles,
              accel_reason(f));
    add_stage(plan, "glow", s.glow, f->glow_voxels_count * sizeof(float),
              glow_reason(f, &s));
    const char *reason = photon_reason(f, options, &s);
    add_stage(plan, "emit", s.photons, 0, reason);
    add_stage(plan, "trace", s.photons, radiance_sum_bytes(f), reason);
    add_stage(plan, "gather", s.photons,
              radiance_cells(f) * (size_t)radiance_drawn_numbers(f, options) *
                      sizeof *f->radiance +
                  f->radiance_slots_count * sizeof *f->radiance_slots,
              reason);
    add_stage(plan, "filter", s.photons && brume_film_reach(options) > 0,
              ring_bytes(f, options), filter_reason(options, &s));
    add_stage(plan, "march", s.march, pixels * sizeof(film_pixel),
              "opacity, depth, background and emission toward the eye");
    add_stage(plan, "single", s.single, 0, single_reason(f, options, &s));
    add_stage(plan, "path", s.path, 0, path_reason(f, &s));
    add_stage(plan, "composite", f->plate_count > 0,
              f->plate_count * sizeof *f->plate, plate_reason(f));
    note_plate(f, options, plan);
    note_field(f, options, plan);
    note_grids(scene, f, plan);
    note_fires(scene, f, plan);
}
