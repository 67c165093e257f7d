#include "core/radiance.h"
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/far.h"
#include "core/physics/radiance.h"
#include "core/physics/rng.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* Cells along the side of a cube as large as the media's box, at most: finer
 * ones would hold more noise than detail. */
#define FIELD_CELLS 64.0

/* Lights that cells hold the light of, at most. */
#define LIT_LIGHTS 16

/* Cells of a refined field, whose numbers have 29 bits of a slot. */
#define MOST_REFINED (UINT64_C(1) << 29)

/* The streams of lattices' places. */
#define SHIFT_PASS 0xfffffffbu

/* Bytes of a number while photons are added up, and after. */
#define NUMBER_BYTES (sizeof(int64_t) + sizeof(float))

struct layout {
    struct flat *flat;
    const struct brume_photon_options *options;
    bool seen;       /* only what the eye can see is asked for  */
    bool passes;     /* one of many fields                      */
    double shift[3]; /* of the lattice, in cells                */
    bool snap;       /* other frames shall have the same cells  */
    bool lit;        /* light straight from lights is kept      */
    int later;       /* numbers for that once all is filtered   */
    radiance_lattice field;
};

/* A medium's lattice asks for cells no finer than its voxels. */
static double voxel_side(const struct flat *f)
{
    double side = 0.0;
    for (size_t i = 0; i < f->media_count; i++) {
        const flat_medium *m = &f->media[i];
        if (m->uniform || rgb_is_black(m->sigma_s))
            continue;
        matrix map;
        for (int k = 0; k < 12; k++)
            map.m[k / 4][k % 4] = (double)m->to_cell.m[k];
        double voxel = 1.0 /
                       ((double)m->side * cbrt(fabs(matrix_determinant(&map))));
        side = side == 0.0 ? voxel : fmin(side, voxel);
    }
    return side;
}

static bool phase_is_even(int32_t phase, float g)
{
    return phase == PHASE_ISOTROPIC ||
           (phase == PHASE_HENYEY_GREENSTEIN && g == 0.0f);
}

static bool is_alike(const flat_medium *a, const flat_medium *b)
{
    return (phase_is_even(a->phase, a->g) && phase_is_even(b->phase, b->g)) ||
           (a->phase == b->phase && a->g == b->g);
}

/* Place of a medium's phase function among those known, or `count`. */
static int place_of(const flat_medium *m, const flat_medium *const *known,
                    int count)
{
    int i = 0;
    while (i < count && !is_alike(m, known[i]))
        i++;
    return i;
}

/* Finds a medium of each phase function that scatters. False: there are more
 * than MAX_PHASES. */
static bool list_phases(const struct flat *f, const flat_medium **known,
                        int *count)
{
    *count = 0;
    for (size_t i = 0; i < f->media_count; i++) {
        const flat_medium *m = &f->media[i];
        if (rgb_is_black(m->sigma_s) || place_of(m, known, *count) < *count)
            continue;
        if (*count == MAX_PHASES)
            return false;
        known[(*count)++] = m;
    }
    return true;
}

/* Names the phase functions of the field, and of each medium its own. Where
 * there are too many, or balls need none, all go by the first. */
static bool choose_phases(const struct flat *f, bool passes,
                          radiance_lattice *out)
{
    const flat_medium *known[MAX_PHASES];
    int count;
    bool told = list_phases(f, known, &count);
    out->ball = out->ball || (passes && !told);
    bool all = told && !out->ball;
    out->phases = all ? count : 1;
    for (int i = 0; i < out->phases; i++) {
        out->phase[i] = known[i]->phase;
        out->g[i] = known[i]->g;
    }
    for (size_t i = 0; i < f->media_count; i++) {
        int place = place_of(&f->media[i], known, out->phases);
        f->media[i].kind = place < out->phases ? place : 0;
    }
    return told;
}

static bool has_surfaces(const struct flat *f)
{
    for (size_t i = 0; i < f->shapes_count; i++)
        if (f->shapes[i].material >= 0)
            return true;
    return false;
}

static bool is_films(const struct brume_options *options)
{
    return brume_film_reach(options) > 0 || options->photons.film_cells;
}

/* Where lights are few enough to look at all; in a film's cells, which may
 * hold what goes anywhere instead of what goes to the eye, of one phase
 * function. */
bool radiance_keeps_lit(const struct flat *f,
                        const struct brume_options *options)
{
    const struct brume_photon_options *o = &options->photons;
    const flat_medium *known[MAX_PHASES];
    int count;
    return options->integrator == BRUME_INTEGRATOR_PHOTON &&
           list_phases(f, known, &count) &&
           (count == 1 || !is_films(options)) &&
           o->gather != BRUME_GATHER_BALL && o->single != BRUME_SINGLE_FIELD &&
           f->lights_count >= 1 && f->lights_count <= LIT_LIGHTS;
}

/* The next place of so many numbers. */
static int32_t add_numbers(radiance_lattice *out, int32_t count)
{
    out->numbers += count;
    return out->numbers - count;
}

/* The eye's rays ask for what goes there, those that surfaces send on for
 * what goes anywhere, and so do other frames' of a film where media scatter
 * differently. Of many fields none may be wrong but by its cells: where a
 * fluence and a flux are not enough, only the eye's straight lines read them,
 * and media of more phase functions than cells keep are gathered by balls. */
static void choose_numbers(struct layout *l)
{
    const struct flat *f = l->flat;
    radiance_lattice *out = &l->field;
    bool known = choose_phases(f, l->passes, out);
    bool alike = known && out->phases == 1;
    bool even = alike && phase_is_even(out->phase[0], out->g[0]);
    bool bounces = f->view.surfaces_indirect && has_surfaces(f);
    out->eye = out->fluence = out->flux = -1;
    out->numbers = 0;
    out->straight = l->passes && (out->ball || !even);
    bounces = bounces && !out->straight;
    l->seen = !bounces && !l->options->everywhere && !f->view.view.orthographic;
    if (out->ball)
        out->eye = add_numbers(out, 3);
    else if (known && !even && (alike || !l->snap))
        out->eye = add_numbers(out, 3 * out->phases);
    if (out->ball && out->births)
        out->births = add_numbers(out, 1);
    if (out->ball)
        return;
    if (out->eye < 0 || bounces)
        out->fluence = add_numbers(out, 3);
    if (out->fluence >= 0 && !even)
        out->flux = add_numbers(out, 9);
    if (l->lit)
        out->lit = add_numbers(out, 3 * out->phases);
}

/* The largest density that a medium may have in a box of unit space. */
static float densest_in_box(const struct layout *l, const flat_medium *m,
                            const float lo[3], const float hi[3])
{
    const struct flat *f = l->flat;
    float most = m->outside.density;
    if (m->uniform)
        return most;
    vec3 a = vec3_make(INFINITY, INFINITY, INFINITY), b = vec3_scale(a, -1.0f);
    for (int i = 0; i < 8; i++) {
        vec3 p = affine_point(&m->to_cell, vec3_make(i & 1 ? lo[0] : hi[0],
                                                     i & 2 ? lo[1] : hi[1],
                                                     i & 4 ? lo[2] : hi[2]));
        a = vec3_min(a, p);
        b = vec3_max(b, p);
    }
    int first[3], last[3];
    for (int i = 0; i < 3; i++) {
        first[i] = hd_floor(hd_max(vec3_get(a, i), 0.0f));
        last[i] = hd_floor(hd_min(vec3_get(b, i), (float)m->cells[i] - 0.5f));
    }
    for (int z = first[2]; z <= last[2]; z++)
        for (int y = first[1]; y <= last[1]; y++)
            for (int x = first[0]; x <= last[0]; x++)
                most = fmaxf(most,
                             f->cells[m->cell + (uint64_t)x +
                                      (uint64_t)m->cells[0] *
                                          ((uint64_t)y +
                                           (uint64_t)m->cells[1] * (uint64_t)z)]
                                 .density);
    return most;
}

/* Whether a plane through the eye with that normal, which the picture lies
 * before, leaves some corner of the box less than `margin` behind it. */
static bool box_before(const camera *c, vec3 n, const float lo[3],
                       const float hi[3], float margin)
{
    vec3 far = vec3_make(n.x > 0.0f ? hi[0] : lo[0], n.y > 0.0f ? hi[1] : lo[1],
                         n.z > 0.0f ? hi[2] : lo[2]);
    return vec3_dot(n, vec3_sub(far, c->location)) >= -margin * vec3_length(n);
}

/* Whether the box touches the view of a perspective camera, its planes moved
 * out by the margin. */
static bool box_seen(const camera *c, const float lo[3], const float hi[3],
                     float margin)
{
    vec3 side[2] = {c->right, c->up}, other[2] = {c->up, c->right};
    if (!box_before(c, c->direction, lo, hi, margin))
        return false;
    for (int i = 0; i < 4; i++) {
        float half = i & 1 ? 0.5f : -0.5f;
        vec3 edge = vec3_mad(c->direction, half, side[i >> 1]);
        vec3 n = vec3_cross(edge, other[i >> 1]);
        if (vec3_dot(n, c->direction) < 0.0f)
            n = vec3_scale(n, -1.0f);
        if (!box_before(c, n, lo, hi, margin))
            return false;
    }
    return true;
}

/* Whether a part of the box lies before the plane at that depth. */
static bool box_nearer(const camera *c, const float lo[3], const float hi[3],
                       float depth)
{
    vec3 axis = vec3_normalize(c->direction);
    vec3 near = vec3_make(axis.x < 0.0f ? hi[0] : lo[0],
                          axis.y < 0.0f ? hi[1] : lo[1],
                          axis.z < 0.0f ? hi[2] : lo[2]);
    return vec3_dot(axis, vec3_sub(near, c->location)) <= depth;
}

/* The largest level, up to 3, whose cells are no thicker than is asked for,
 * where the media's extinction is `sigma` at most. */
static int level_for(const struct layout *l, float sigma)
{
    int level = 0;
    if (!l->field.refined)
        return 0;
    while (level < 3 &&
           (double)(sigma * l->field.side) * (2 << level) <= l->options->depth)
        level++;
    return level;
}

/* The level of a brick's cells, or -1 where nothing gives light: scatters it,
 * or where births are asked for emits it. What emits shines on what is beside
 * it: its cells are the smallest. With a margin of a cell, for what is
 * interpolated. */
static int brick_level(const struct layout *l, const int32_t at[3])
{
    const radiance_lattice *f = &l->field;
    float lo[3], hi[3];
    for (int i = 0; i < 3; i++) {
        lo[i] = f->origin[i] + (8.0f * (float)at[i] - 1.0f) * f->side;
        hi[i] = lo[i] + 10.0f * f->side;
    }
    const camera *view = &l->flat->view.view;
    float margin = 1.8f * f->side;
    if (l->seen && !(box_seen(view, lo, hi, margin) &&
                     box_nearer(view, lo, hi, f->far + margin)))
        return -1;
    bool gives = false, emits = false;
    float sigma = 0.0f;
    for (size_t i = 0; i < l->flat->media_count; i++) {
        const flat_medium *m = &l->flat->media[i];
        float most = densest_in_box(l, m, lo, hi);
        if (!(m->uniform || most > 0.0f))
            continue;
        gives |= !rgb_is_black(m->sigma_s) || (f->births && m->emits);
        emits |= m->emits && !m->uniform;
        sigma += most * rgb_max(m->sigma_t);
    }
    return !gives ? -1 : emits ? 0 : level_for(l, sigma);
}

/* Cells of the bricks that have some; their slots go to `slots` if it is not
 * NULL. */
static uint64_t number_cells(const struct layout *l, int32_t *slots)
{
    const int32_t *n = l->field.bricks;
    uint64_t count = 0;
    int32_t at[3];
    for (at[2] = 0; at[2] < n[2]; at[2]++)
        for (at[1] = 0; at[1] < n[1]; at[1]++)
            for (at[0] = 0; at[0] < n[0]; at[0]++) {
                int level = brick_level(l, at);
                int32_t slot = l->field.refined ? (int32_t)(4 * count) + level
                                                : (int32_t)(count / 512);
                if (slots)
                    *slots++ = level < 0 ? -1 : slot;
                count += level < 0 ? 0u : 512u >> 3 * level;
            }
    return count;
}

/* Bricks that begin at multiples of their side in the scene's space. */
static void snap_axis(struct layout *l, int i, double side)
{
    const struct flat *f = l->flat;
    double brick = 8.0 * side / f->unit, slack = 1e-4 * brick;
    double lo = (double)f->view.reach.lo[i] / f->unit + f->centre[i];
    double hi = (double)f->view.reach.hi[i] / f->unit + f->centre[i];
    double first = floor((lo + slack) / brick);
    double count = fmax(ceil((hi - slack) / brick - first), 1.0);
    l->field.bricks[i] = (int32_t)count;
    l->field.origin[i] = (float)((first * brick - f->centre[i]) * f->unit);
}

/* The next of four sides to an octave, in the scene's space. */
static double snap_side(const struct flat *f, double side)
{
    return exp2(ceil(4.0 * log2(side / f->unit) - 1e-6) / 4.0) * f->unit;
}

/* The lattice with cells of that side around the middle of the media. */
static void set_cells(struct layout *l, double side)
{
    const scene_reach *r = &l->flat->view.reach;
    l->field.side = (float)side;
    l->field.per_side = 1.0f / l->field.side;
    for (int i = 0; i < 3; i++) {
        if (l->snap) {
            snap_axis(l, i, side);
            continue;
        }
        double extent = (double)(r->hi[i] - r->lo[i]) +
                        (l->passes ? side : 0.0);
        double bricks = fmax(ceil(extent / side / 8.0 * 0.9999), 1.0);
        double middle = 0.5 * ((double)r->lo[i] + (double)r->hi[i]);
        l->field.bricks[i] = (int32_t)bricks;
        l->field.origin[i] = (float)(middle -
                                     (4.0 * bricks - l->shift[i]) * side);
    }
}

static double first_side(const struct flat *f)
{
    const scene_reach *r = &f->view.reach;
    double volume = 1.0, longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, (double)(r->hi[i] - r->lo[i]));
    longest = fmax(longest, 1e-6);
    for (int i = 0; i < 3; i++)
        volume *= fmax((double)(r->hi[i] - r->lo[i]), 1e-2 * longest);
    return fmax(cbrt(volume) / FIELD_CELLS, voxel_side(f));
}

static uint64_t field_bytes(const struct layout *l, uint64_t cells)
{
    return cells * (uint64_t)(l->field.numbers + l->later) * NUMBER_BYTES;
}

static bool check_options(const struct layout *l, struct brume_error *err)
{
    const struct brume_photon_options *o = l->options;
    if (l->passes && o->single == BRUME_SINGLE_FIELD)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "integrator progressive samples light scattered once "
                          "along the eye's rays, not in the field");
    if (l->passes && o->emission == BRUME_EMISSION_PHOTONS)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "integrator progressive counts emission along the "
                          "eye's rays, not by photons");
    if (l->snap && o->adaptive && l->field.ball)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "temporal adaptive needs gather tally");
    if (l->field.births && !l->field.ball)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "emission by photons needs gather ball");
    return true;
}

/* Bytes that the field may have. */
static uint64_t room_for(const struct layout *l, uint64_t memory)
{
    uint64_t used = flat_bytes(l->flat);
    if (memory == 0)
        return UINT64_MAX;
    return memory > used ? (memory - used) / 2 : 0;
}

/* Cells of that side, or as coarse as the room asks for. */
static bool lay_out(struct layout *l, double side, uint64_t room,
                    struct brume_error *err)
{
    struct flat *flat = l->flat;
    double ball = l->options->radius > 0.0
                      ? l->options->radius * flat->unit / side
                      : 2.0;
    uint64_t cells;
    for (;; side *= 1.1) {
        set_cells(l, side);
        cells = number_cells(l, NULL);
        bool fits = !l->field.refined || cells < MOST_REFINED;
        if (fits && (field_bytes(l, cells) <= room || cells <= 8 * 512))
            break;
    }
    size_t all = (size_t)l->field.bricks[0] * (size_t)l->field.bricks[1] *
                 (size_t)l->field.bricks[2];
    int32_t *slots = FLAT_EXTEND(flat, radiance_slots, all, err);
    if (!slots ||
        !FLAT_EXTEND(flat, radiance, cells * (size_t)l->field.numbers, err))
        return false;
    number_cells(l, slots);
    l->field.radius = (float)(l->options->radius > 0.0 && !l->passes
                                  ? l->options->radius * flat->unit
                                  : ball * (double)l->field.side);
    flat->view.field = l->field;
    flat_view(flat);
    return true;
}

struct look {
    const struct brume_options *options;
    const flat_scene *scene;
    int step;         /* between pixels                          */
    atomic_uint most; /* the farthest, as the bits of a float    */
};

static float most_yet(struct look *job)
{
    unsigned bits = atomic_load_explicit(&job->most, memory_order_relaxed);
    float far;
    memcpy(&far, &bits, sizeof far);
    return far;
}

/* Floats that are not negative are in the order of their bits. */
static void keep_farther(struct look *job, float far)
{
    unsigned bits, most = atomic_load(&job->most);
    memcpy(&bits, &far, sizeof bits);
    while (bits > most &&
           !atomic_compare_exchange_weak(&job->most, &most, bits))
        ;
}

static void look_along_row(void *context, size_t index, int thread)
{
    (void)thread;
    struct look *job = context;
    const struct brume_options *o = job->options;
    int y = (int)index * job->step;
    for (int x = 0; x < o->width; x += job->step)
        keep_farther(job, far_of_pixel(job->scene, o->width, o->height, x, y,
                                       most_yet(job)));
}

/* The farthest that a pixel's middle sees of media. A few pixels tell nearly
 * as much as all: whoever comes after them sees soon that he sees no farther.
 * Which is seen first changes what that takes, but not the answer. */
static void find_far(struct layout *l, const struct brume_options *options)
{
    enum { FEW = 16 };
    l->field.far = INFINITY;
    if (!l->options->far_plane || !l->seen || l->snap || options->height < 1)
        return;
    struct look job = {.options = options, .scene = &l->flat->view};
    for (int step = FEW; step >= 1; step /= FEW) {
        job.step = step;
        parallel_for(options->threads,
                     (size_t)((options->height + step - 1) / step),
                     look_along_row, &job, NULL);
    }
    l->field.far = most_yet(&job);
}

static struct layout begin(struct flat *flat,
                           const struct brume_options *options)
{
    struct layout l = {.flat = flat, .options = &options->photons};
    l.passes = options->integrator == BRUME_INTEGRATOR_PROGRESSIVE;
    l.field.ball = l.options->gather == BRUME_GATHER_BALL;
    l.field.single = l.options->single == BRUME_SINGLE_FIELD &&
                     flat->lights_count > 0;
    l.field.births = l.options->emission == BRUME_EMISSION_PHOTONS;
    l.snap = !l.passes && is_films(options);
    l.field.refined = l.options->depth > 0.0 && !l.passes && !l.snap &&
                      !l.field.ball;
    bool lit = radiance_keeps_lit(flat, options);
    l.lit = lit && brume_film_reach(options) == 0;
    choose_numbers(&l);
    l.later = lit && !l.lit ? 3 * l.field.phases : 0;
    return l;
}

static double side_of(const struct layout *l)
{
    double spacing = l->options->spacing;
    if (spacing > 0.0)
        return spacing * l->flat->unit;
    double side = first_side(l->flat);
    return l->field.refined ? fmax(0.5 * side, voxel_side(l->flat)) : side;
}

bool radiance_layout(struct flat *flat, const struct brume_options *options,
                     struct brume_error *err)
{
    struct layout l = begin(flat, options);
    double side = side_of(&l);
    if (l.snap)
        side = snap_side(flat, side);
    if (!check_options(&l, err))
        return false;
    find_far(&l, options);
    return lay_out(&l, side, room_for(&l, options->memory), err);
}

/* ---- room for what no filter has to do with ----------------------------- */

struct widening {
    const float *from;
    float *to;
    size_t before, after; /* numbers of a cell */
};

static void widen_brick(void *context, size_t brick, int thread)
{
    (void)thread;
    const struct widening *w = context;
    const float *from = w->from + brick * 512 * w->before;
    float *to = w->to + brick * 512 * w->after;
    for (int i = 0; i < 512; i++, from += w->before, to += w->after)
        memcpy(to, from, w->before * sizeof *to);
}

size_t radiance_cells(const struct flat *flat)
{
    int numbers = flat->view.field.numbers;
    return numbers > 0 ? flat->radiance_count / (size_t)numbers : 0;
}

int radiance_drawn_numbers(const struct flat *flat,
                           const struct brume_options *options)
{
    const radiance_lattice *f = &flat->view.field;
    bool widens = f->numbers > 0 && !f->lit &&
                  radiance_keeps_lit(flat, options);
    return f->numbers + (widens ? 3 * f->phases : 0);
}

bool radiance_widen(struct flat *flat, const struct brume_options *options,
                    struct brume_error *err)
{
    radiance_lattice *f = &flat->view.field;
    int numbers = radiance_drawn_numbers(flat, options);
    if (numbers == f->numbers)
        return true;
    struct widening w = {.from = flat->radiance,
                         .before = (size_t)f->numbers,
                         .after = (size_t)numbers};
    size_t cells = radiance_cells(flat);
    w.to = memory_new(cells * w.after, sizeof *w.to, err);
    if (!w.to)
        return false;
    parallel_for(options->threads, cells / 512, widen_brick, &w, NULL);
    free(flat->radiance);
    flat->radiance = w.to;
    flat->radiance_count = flat->radiance_capacity = cells * w.after;
    f->lit = f->numbers;
    f->numbers = numbers;
    flat_view(flat);
    return true;
}

/* Without a field, as before the first. */
static void drop_field(struct flat *flat)
{
    free(flat->radiance);
    free(flat->radiance_slots);
    flat->radiance = NULL;
    flat->radiance_slots = NULL;
    flat->radiance_count = flat->radiance_capacity = 0;
    flat->radiance_slots_count = flat->radiance_slots_capacity = 0;
}

/* What cells blur is as side^2, the variance of a field along a ray as
 * 1 / side: with sides as the -1/4th power of the pass the bias of the mean
 * falls as all other noise does, as 1 / sqrt(passes), and the noise of the
 * fields a little slower, as their -3/8th power. (With the -1/5th both would
 * fall as the -2/5th; most noise is not the fields'.) Lattices that lie
 * anywhere blur their own planes. */
bool radiance_renew(struct flat *flat, const struct brume_options *options,
                    uint32_t pass, struct brume_error *err)
{
    struct layout l = begin(flat, options);
    rng random = rng_make(options->seed, options->frame, SHIFT_PASS, pass);
    for (int i = 0; i < 3; i++)
        l.shift[i] = (double)rng_float(&random) - 0.5;
    l.field.far = flat->view.field.far;
    drop_field(flat);
    return lay_out(&l, side_of(&l) * pow(pass + 1.0, -0.25),
                   room_for(&l, options->memory), err);
}

size_t radiance_blocks(const struct flat *flat)
{
    return radiance_cells(flat) / 8;
}

uint64_t radiance_sum_bytes(const struct flat *flat)
{
    return flat->radiance_count * sizeof(int64_t);
}

double radiance_scale(const radiance_lattice *f, double unit)
{
    double side = (double)f->side, r = (double)f->radius;
    double volume = f->ball ? 4.0 / 3.0 * 3.14159265358979 * r * r * r
                            : side * side;
    return unit / (RADIANCE_ONE * volume);
}

void radiance_resolve(struct flat *flat, const int64_t *sum, double unit)
{
    double scale = radiance_scale(&flat->view.field, unit);
    for (size_t i = 0; i < flat->radiance_count; i++)
        flat->radiance[i] = (float)((double)sum[i] * scale);
}
