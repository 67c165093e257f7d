/* Media and their majorant lattices: cells of 8^3 or 4^3 voxels of the grid
 * that leads, each with a bound on the product of the density fields and a word
 * on whether something glows there. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "core/blackbody.h"
#include "core/prepare.h"
#include "lib/thread.h"

/* More cells than this and the lattice itself would be the cost. */
#define MAX_CELLS ((size_t)1 << 27)

/* Emission samples per voxel that a ray crosses; a medium without a grid needs
 * none, and has a rate only to say that it emits. */
#define SAMPLES_PER_VOXEL 1.0

/* The most extinction per unit-space length of a medium that scatters: events
 * lie about eight roundings of a place apart then. The albedo stays, and so
 * what comes back of light; nothing comes through the scene's width anyhow. A
 * thin layer may let through what it should not: a warning tells. */
#define MOST_EXTINCTION 2097152.0f

/* Weight of finding emission along a ray against choosing a glowing voxel, in
 * units of the emission samples' rate. On the campfire the error fell from
 * 1 to 0.03 by a fifth, and stayed from there. */
#define GLOW_KAPPA 0.03f

/* Free paths across a cell of 8 voxels, above which 4 are better: in the cloud
 * of tests/bench/media.c, not in its smoke. */
#define THICK 2.0

struct lattice {
    const struct flat *flat;
    flat_medium *medium;
    matrix to_unit; /* lattice index space to unit space           */
    int32_t origin[3];
    int32_t side; /* voxels along a side of a cell               */
    float rate;
    majorant_cell *cell;
};

static bool is_grid(const struct flat *f, int field)
{
    return field >= 0 && f->fields[field].kind == FIELD_GRID;
}

/* Whether it has an index space, in which it varies. */
static bool has_lattice(const struct flat *f, int field)
{
    return field >= 0 && f->fields[field].kind != FIELD_CONSTANT;
}

/* The first density of a kind, or what an additive fire reads. */
static int first_of(const struct flat *f, const flat_medium *m,
                    bool (*is)(const struct flat *f, int field))
{
    for (int i = 0; i < m->densities; i++)
        if (is(f, m->density[i]))
            return m->density[i];
    if (m->fire && is(f, m->amount))
        return m->amount;
    return m->fire && is(f, m->temperature) ? m->temperature : -1;
}

/* The field whose bricks or cells become the lattice: a grid, or else a
 * function; -1 where all is constant. */
static int lead_field(const struct flat *f, const flat_medium *m)
{
    int grid = first_of(f, m, is_grid);
    return grid >= 0 ? grid : first_of(f, m, has_lattice);
}

/* Bricks of 8^3 samples from the lowest index on. */
static void field_extent(const struct flat *f, int field, int32_t origin[3],
                         int32_t bricks[3])
{
    bool grid = is_grid(f, field);
    for (int i = 0; i < 3; i++) {
        int32_t at = f->fields[field].grid;
        origin[i] = grid ? f->grids[at].origin[i] : 0;
        bricks[i] = grid ? f->grids[at].bricks[i] : f->procedures[at].cells[i];
    }
}

static matrix affine_matrix(const affine *a)
{
    matrix out;
    for (int i = 0; i < 12; i++)
        out.m[i / 4][i % 4] = a->m[i];
    return out;
}

static void field_box(const struct flat *f, int field, double lo[3],
                      double hi[3])
{
    int32_t origin[3], bricks[3];
    field_extent(f, field, origin, bricks);
    for (int i = 0; i < 3; i++) {
        lo[i] = origin[i] - 1.0;
        hi[i] = origin[i] + 8.0 * bricks[i];
    }
}

/* Widens [lo, hi] of the lead's index space by another field's box. */
static bool include_field(const struct flat *f, const matrix *to_lead,
                          int field, double lo[3], double hi[3])
{
    matrix to_index = affine_matrix(&f->fields[field].to_index), back, map;
    if (!matrix_invert(&to_index, &back))
        return false;
    map = matrix_compose(to_lead, &back);
    double a[3], b[3];
    field_box(f, field, a, b);
    for (int c = 0; c < 8; c++) {
        double p[3] = {c & 1 ? b[0] : a[0], c & 2 ? b[1] : a[1],
                       c & 4 ? b[2] : a[2]},
               q[3];
        matrix_point(&map, p, q);
        for (int i = 0; i < 3; i++) {
            lo[i] = fmin(lo[i], q[i]);
            hi[i] = fmax(hi[i], q[i]);
        }
    }
    return true;
}

/* Cells from the lowest brick to the highest that may hold something. */
static bool lattice_extent(struct lattice *l, int lead, struct brume_error *err)
{
    const struct flat *f = l->flat;
    const flat_medium *m = l->medium;
    int32_t origin[3], bricks[3];
    matrix to_lead = affine_matrix(&f->fields[lead].to_index);
    double lo[3], hi[3];
    field_extent(f, lead, origin, bricks);
    for (int i = 0; i < 3; i++) {
        lo[i] = origin[i];
        hi[i] = origin[i] + 8.0 * bricks[i];
    }
    int more[2] = {m->fire && m->additive ? m->amount : -1,
                   m->fire && m->additive ? m->temperature : -1};
    for (int i = 0; i < 2; i++)
        if (has_lattice(f, more[i]) && more[i] != lead)
            include_field(f, &to_lead, more[i], lo, hi);
    double cells = 1.0;
    for (int i = 0; i < 3; i++) {
        double first = floor((lo[i] - origin[i]) / l->side);
        double count = ceil((hi[i] - origin[i]) / l->side) - first;
        cells *= count;
        if (cells > (double)MAX_CELLS)
            return brume_fail(err, BRUME_ERR_LIMIT,
                              "a medium's grids lie so far apart that their "
                              "common lattice has over %zu cells",
                              MAX_CELLS);
        l->origin[i] = origin[i] + l->side * (int32_t)first;
        l->medium->cells[i] = (int32_t)count;
    }
    return true;
}

static bool glows(const flat_medium *m, float density, float kelvin,
                  float amount)
{
    bool plain = density > 0.0f && !rgb_is_black(m->emission);
    if (!m->fire || m->intensity == 0.0f)
        return plain;
    bool coupled = m->additive || (density > 0.0f && !rgb_is_black(m->sigma_a));
    return plain ||
           (coupled && amount > 0.0f && kelvin >= BLACKBODY_LOWEST_KELVIN);
}

typedef float field_bound(const struct lattice *l, int field,
                          const double lo[3], const double hi[3]);

static float bound_in_box(const struct lattice *l, int field,
                          const double lo[3], const double hi[3])
{
    return prepare_field_bound(l->flat, field, &l->to_unit, lo, hi);
}

static float bound_everywhere(const struct lattice *l, int field,
                              const double lo[3], const double hi[3])
{
    (void)lo;
    (void)hi;
    return prepare_field_bound_everywhere(l->flat, field);
}

/* What a field is beyond its bricks or cells. */
static float beyond_all(const struct flat *f, const flat_field *field)
{
    float most = 0.0f;
    if (field->kind == FIELD_FUNCTION)
        return 0.0f;
    for (int i = 0; i < (field->colored ? 3 : 1); i++) {
        const flat_grid *g = &f->grids[field->grid + i];
        most = fmaxf(most, g->clip ? 0.0f : f->tiles[g->tile]);
    }
    return field->scale * most;
}

/* Beyond the lattice: a grid that the lattice covers is its background. */
static float bound_beyond(const struct lattice *l, int field,
                          const double lo[3], const double hi[3])
{
    const struct flat *f = l->flat;
    if (!has_lattice(f, field))
        return f->fields[field].scale;
    matrix to_index = affine_matrix(&f->fields[field].to_index), back, map;
    matrix to_lattice;
    double a[3], b[3];
    field_box(f, field, a, b);
    if (!matrix_invert(&to_index, &back) ||
        !matrix_invert(&l->to_unit, &to_lattice))
        return prepare_field_bound_everywhere(f, field);
    map = matrix_compose(&to_lattice, &back);
    const double slack = 1.001; /* the margin of field_box, and rounding */
    for (int c = 0; c < 8; c++) {
        double p[3] = {c & 1 ? b[0] : a[0], c & 2 ? b[1] : a[1],
                       c & 4 ? b[2] : a[2]},
               q[3];
        matrix_point(&map, p, q);
        for (int i = 0; i < 3; i++)
            if (q[i] < lo[i] - slack || q[i] > hi[i] + slack)
                return prepare_field_bound_everywhere(f, field);
    }
    return beyond_all(f, &f->fields[field]);
}

static majorant_cell cell_bound(const struct lattice *l, field_bound *bound,
                                const double lo[3], const double hi[3])
{
    const flat_medium *m = l->medium;
    majorant_cell out = {1.0f, 0.0f, 0};
    for (int i = 0; i < m->densities; i++)
        out.density *= bound(l, m->density[i], lo, hi);
    out.density = fminf(out.density, m->densest);
    float kelvin = 0.0f, amount = 1.0f;
    if (m->fire) {
        float t = bound(l, m->temperature, lo, hi);
        kelvin = m->kelvin_offset + fmaxf(m->kelvin_scale * t, 0.0f);
        if (m->amount >= 0)
            amount = bound(l, m->amount, lo, hi);
    }
    if (glows(m, out.density, kelvin, amount))
        out.rate = l->rate;
    return out;
}

static void fill_cell(void *context, size_t index, int thread)
{
    (void)thread;
    struct lattice *l = context;
    double lo[3], hi[3];
    size_t rest = index;
    for (int i = 0; i < 3; i++) {
        size_t n = (size_t)l->medium->cells[i];
        lo[i] = l->origin[i] + l->side * (double)(rest % n);
        hi[i] = lo[i] + l->side;
        rest /= n;
    }
    l->cell[index] = cell_bound(l, bound_in_box, lo, hi);
}

static float neighbours_bound(const struct lattice *l, size_t index)
{
    const int32_t *n = l->medium->cells;
    int c[3] = {(int)(index % (size_t)n[0]),
                (int)(index / (size_t)n[0] % (size_t)n[1]),
                (int)(index / (size_t)n[0] / (size_t)n[1])};
    float most = l->medium->outside.density;
    for (int i = 0; i < 27; i++) {
        int x = c[0] + i % 3 - 1, y = c[1] + i / 3 % 3 - 1,
            z = c[2] + i / 9 - 1;
        if (x < 0 || y < 0 || z < 0 || x >= n[0] || y >= n[1] || z >= n[2])
            continue;
        size_t at = (size_t)x +
                    (size_t)n[0] * ((size_t)y + (size_t)n[1] * (size_t)z);
        most = fmaxf(most, l->cell[at].density);
    }
    return most;
}

/* A position that rounding puts up to 2^-10 voxel into the next cell reads a
 * value between this cell's bound and that one's: allow for it, in cells that
 * are read at all. Works in place: a bound that has its share already only
 * makes the next one's larger by 2^-20. */
static void allow_for_rounding(struct lattice *l, size_t cells)
{
    for (size_t i = 0; i < cells; i++) {
        float *d = &l->cell[i].density;
        if (*d > 0.0f)
            *d = *d * 1.000001f + neighbours_bound(l, i) / 1024.0f;
    }
}

/* The lattice of cells of l->side voxels; their bounds behind those of the
 * media before. */
static bool fill_lattice(const struct prepare *job, struct lattice *l, int lead,
                         const matrix *to_index, struct brume_error *err)
{
    flat_medium *m = l->medium;
    if (!lattice_extent(l, lead, err))
        return false;
    double lo[3], hi[3], back[3];
    size_t cells = 1;
    for (int i = 0; i < 3; i++) {
        lo[i] = l->origin[i];
        hi[i] = lo[i] + (double)l->side * m->cells[i];
        back[i] = -lo[i] / l->side;
        cells *= (size_t)m->cells[i];
        m->origin[i] = (float)l->origin[i];
    }
    matrix shift = matrix_scale_move(1.0 / l->side, back);
    shift = matrix_compose(&shift, to_index);
    m->to_cell = matrix_affine(&shift);
    m->side = (float)l->side;
    m->outside = cell_bound(l, bound_beyond, lo, hi);
    job->flat->cells_count = m->cell;
    l->cell = FLAT_EXTEND(job->flat, cells, cells, err);
    if (!l->cell)
        return false;
    parallel_for(job->threads, cells, fill_cell, l, NULL);
    allow_for_rounding(l, cells);
    return true;
}

/* Whether cells of half the side pay: where the mean cell that is not empty is
 * over THICK free paths wide at its bound (METHODS 1.1), and there are not too
 * many. */
static bool is_thick(const struct lattice *l, double voxel)
{
    const flat_medium *m = l->medium;
    size_t cells = (size_t)m->cells[0] * (size_t)m->cells[1] *
                   (size_t)m->cells[2];
    double sum = 0.0, sigma = rgb_max(m->bound);
    size_t full = 0;
    for (size_t i = 0; i < cells; i++) {
        sum += (double)l->cell[i].density;
        full += l->cell[i].density > 0.0f ? 1 : 0;
    }
    return full > 0 && cells <= MAX_CELLS / 8 &&
           sigma * sum / (double)full * l->side * voxel > THICK;
}

static bool make_lattice(const struct prepare *job, struct lattice *l, int lead,
                         struct brume_error *err)
{
    flat_medium *m = l->medium;
    matrix to_index = affine_matrix(&l->flat->fields[lead].to_index);
    if (!matrix_invert(&to_index, &l->to_unit))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a grid's place in the scene has no inverse");
    double voxel = cbrt(fabs(matrix_determinant(&l->to_unit)));
    l->rate = (float)(SAMPLES_PER_VOXEL / voxel);
    m->lead = lead;
    m->cell = job->flat->cells_count;
    l->side = 8;
    if (!fill_lattice(job, l, lead, &to_index, err))
        return false;
    if (!is_grid(l->flat, lead) || !is_thick(l, voxel))
        return true;
    l->side = 4;
    return fill_lattice(job, l, lead, &to_index, err);
}

static bool make_bounds(const struct prepare *job, flat_medium *m,
                        struct brume_error *err)
{
    struct lattice l = {.flat = job->flat, .medium = m};
    int lead = lead_field(job->flat, m);
    m->uniform = lead < 0;
    l.rate = 1.0f;
    if (m->uniform)
        m->outside = cell_bound(&l, bound_everywhere, NULL, NULL);
    else if (!make_lattice(job, &l, lead, err))
        return false;
    m->kappa = GLOW_KAPPA * l.rate;
    m->emits = !rgb_is_black(m->emission) || (m->fire && m->intensity > 0.0f);
    return true;
}

static void add_plane_field(const struct flat *f, flat_medium *m, int field)
{
    if (!is_grid(f, field))
        return;
    const flat_field *a = &f->fields[field];
    for (int i = 0; i < m->planes; i++) {
        const flat_field *b = &f->fields[m->plane_field[i]];
        if (f->grids[a->grid].nearest == f->grids[b->grid].nearest &&
            a->lattice == b->lattice)
            return;
    }
    m->plane_field[m->planes++] = field;
}

static rgb color_per_unit(const double c[3], double unit)
{
    return rgb_make((float)(c[0] / unit), (float)(c[1] / unit),
                    (float)(c[2] / unit));
}

static void set_fire(const struct prepare *job, flat_medium *m,
                     const struct brume_fire *fire)
{
    if (!fire->on)
        return;
    double intensity = fire->intensity;
    if (fire->brightness == BRUME_BRIGHTNESS_PHYSICAL)
        intensity /= blackbody_luminance(job->flat->blackbody,
                                         (float)fire->reference);
    if (fire->brightness == BRUME_BRIGHTNESS_TOTAL)
        intensity /= pow(fire->reference, 4);
    m->fire = 1;
    m->temperature = fire->temperature;
    m->amount = fire->amount;
    m->kelvin_scale = (float)fire->kelvin_scale;
    m->kelvin_offset = (float)fire->kelvin_offset;
    m->additive = fire->additive;
    m->brightness = (int32_t)fire->brightness;
    m->intensity = (float)(fire->additive ? intensity / job->flat->unit
                                          : intensity);
}

static void warn(const struct prepare *job, const char *text)
{
    if (job->warn)
        job->warn(job->user, text);
}

static void set_coefficients(const struct prepare *job, flat_medium *m,
                             const struct brume_medium *in)
{
    double unit = job->flat->unit, extinction = in->extinction;
    if (extinction != 1.0 && job->scene->globals.media_multiple) {
        extinction = 1.0;
        warn(job, "extinction other than 1 has no meaning in multiple "
                  "scattering; 1 is used");
    }
    m->sigma_a = color_per_unit(in->absorption, unit);
    m->sigma_s = color_per_unit(in->scattering, unit);
    m->emission = color_per_unit(in->emission, unit);
    m->sigma_t = rgb_add(m->sigma_a, rgb_scale(m->sigma_s, (float)extinction));
    rgb sum = rgb_add(m->sigma_a, m->sigma_s);
    m->bound = rgb_make(fmaxf(m->sigma_t.r, sum.r), fmaxf(m->sigma_t.g, sum.g),
                        fmaxf(m->sigma_t.b, sum.b));
    m->densest = rgb_is_black(m->sigma_s) ? INFINITY
                                          : MOST_EXTINCTION / rgb_max(m->bound);
    m->phase = (int32_t)in->phase;
    m->g = (float)in->eccentricity;
}

/* Whether it is drawn less dense than it is. */
static bool is_cut(const struct flat *f, const flat_medium *m)
{
    if (m->outside.density >= m->densest)
        return true;
    size_t cells = m->uniform ? 0
                              : (size_t)m->cells[0] * (size_t)m->cells[1] *
                                    (size_t)m->cells[2];
    for (size_t i = 0; i < cells; i++)
        if (f->cells[m->cell + i].density >= m->densest)
            return true;
    return false;
}

static void tell_cut(const struct prepare *job, const flat_medium *m)
{
    char text[200];
    if (!is_cut(job->flat, m))
        return;
    snprintf(text, sizeof text,
             "medium %zu scatters and is drawn with an extinction of at most "
             "%.3g per unit of length: thin layers of it let too much through",
             job->flat->media_count, (double)MOST_EXTINCTION * job->flat->unit);
    warn(job, text);
}

static bool is_evaluated(const struct flat *f, int field)
{
    return field >= 0 && f->fields[field].kind == FIELD_FUNCTION;
}

static void set_functions(const struct flat *f, flat_medium *m)
{
    m->sampled = is_evaluated(f, m->temperature) || is_evaluated(f, m->amount);
    for (int i = 0; i < m->densities; i++) {
        const flat_field *field = &f->fields[m->density[i]];
        m->sampled |= field->kind == FIELD_FUNCTION;
        m->functions |= field->kind == FIELD_FUNCTION || field->colored;
    }
}

static bool add_medium(const struct prepare *job, const struct brume_medium *in,
                       struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_medium m;
    memset(&m, 0, sizeof m);
    m.glow = m.amount = m.temperature = m.lead = -1;
    set_coefficients(job, &m, in);
    m.densities = in->densities;
    for (int i = 0; i < in->densities; i++)
        m.density[i] = in->density[i];
    set_fire(job, &m, &in->fire);
    if (!make_bounds(job, &m, err))
        return false;
    for (int i = 0; i < m.densities; i++)
        add_plane_field(f, &m, m.density[i]);
    add_plane_field(f, &m, m.temperature);
    add_plane_field(f, &m, m.amount);
    set_functions(f, &m);
    tell_cut(job, &m);
    flat_medium *slot = FLAT_EXTEND(f, media, 1, err);
    if (!slot)
        return false;
    *slot = m;
    f->view.scatters |= !rgb_is_black(m.sigma_s);
    return true;
}

static bool add_interior(const struct prepare *job,
                         const struct scene_interior *in,
                         struct brume_error *err)
{
    struct flat *f = job->flat;
    flat_interior *out = FLAT_EXTEND(f, interiors, 1, err);
    if (!out)
        return false;
    out->first = (int32_t)f->interior_media_count;
    out->count = in->count;
    int32_t *media = FLAT_EXTEND(f, interior_media, (size_t)in->count, err);
    if (!media)
        return false;
    for (int i = 0; i < in->count; i++)
        media[i] = in->media[i];
    return true;
}

static bool is_endless(const flat_medium *m)
{
    return m->uniform || m->outside.density > 0.0f;
}

/* Light of a channel that unbounded media scatter and do not absorb goes on
 * until a surface or bounded media absorb it: in an open scene, nothing. */
static void tell_endless(const struct prepare *job)
{
    const struct flat *f = job->flat;
    rgb scattered = rgb_gray(0.0f), absorbed = scattered;
    if (!job->scene->globals.media_multiple || f->view.atmosphere < 0)
        return;
    const flat_interior *in = &f->interiors[f->view.atmosphere];
    for (int i = 0; i < in->count; i++) {
        const flat_medium *m = &f->media[f->interior_media[in->first + i]];
        if (is_endless(m)) {
            scattered = rgb_add(scattered, m->sigma_s);
            absorbed = rgb_add(absorbed, m->sigma_a);
        }
    }
    for (int c = 0; c < 3; c++)
        if (rgb_get(scattered, c) > 0.0f && !(rgb_get(absorbed, c) > 0.0f)) {
            warn(job, "unbounded media scatter light without absorbing any: "
                      "where no surface holds it, it goes on without end, and "
                      "so may the rendering");
            return;
        }
}

bool prepare_media(const struct prepare *job, struct brume_error *err)
{
    const brume_scene *s = job->scene;
    for (size_t i = 0; i < s->media_count; i++)
        if (!add_medium(job, &s->media[i], err))
            return false;
    for (size_t i = 0; i < s->interiors_count; i++)
        if (!add_interior(job, &s->interiors[i], err))
            return false;
    job->flat->view.atmosphere = s->atmosphere;
    tell_endless(job);
    flat_view(job->flat);
    return true;
}
