#include "core/filter_view.h"
#include <math.h>
#include <string.h>
#include "core/physics/phase.h"

/* By how much light toward the eye may change for the eye's moving, relative,
 * at most. */
#define MOST_CHANGE 0.2

void filter_corner(const radiance_lattice *f, size_t brick, int at[3])
{
    size_t x = (size_t)f->bricks[0], y = (size_t)f->bricks[1];
    at[0] = 8 * (int)(brick % x);
    at[1] = 8 * (int)(brick / x % y);
    at[2] = 8 * (int)(brick / x / y);
}

static bool same_numbers(const radiance_lattice *a, const radiance_lattice *b)
{
    return a->numbers == b->numbers && a->eye == b->eye &&
           a->fluence == b->fluence && a->flux == b->flux &&
           a->phases == b->phases && a->phase[0] == b->phase[0] &&
           a->g[0] == b->g[0] && a->ball == b->ball && a->births == b->births &&
           a->lit == b->lit;
}

/* The most by which the logarithm of a phase function changes per radian;
 * Henyey and Greenstein's: 3 g sin / (1 + g^2 - 2 g cos). */
static double steepness(const radiance_lattice *f)
{
    double g = fabs((double)f->g[0]);
    switch (f->phase[0]) {
    case PHASE_HENYEY_GREENSTEIN:
        return 3.0 * g / (1.0 - g * g);
    case PHASE_RAYLEIGH:
        return 0.71;
    case PHASE_MIE_HAZY:
        return 2.5;
    case PHASE_MIE_MURKY:
        return 7.5;
    default:
        return 0.0;
    }
}

/* Whether two frames are seen from the same side everywhere. */
static bool same_eye(const struct flat *a, const struct filter_field *b)
{
    const camera *x = &a->view.view, *y = &b->eye;
    const float *p = &x->location.x, *q = &y->location.x;
    const float *d = &x->direction.x, *e = &y->direction.x;
    bool same = x->orthographic == y->orthographic;
    for (int i = 0; i < 3; i++) {
        double moved = (double)p[i] / a->unit + a->centre[i] -
                       (double)q[i] / b->unit - b->centre[i];
        same = same && fabs(moved) * a->unit < 1e-5 &&
               (!x->orthographic || d[i] == e[i]);
    }
    return same;
}

/* Lattices of a film begin at multiples of a brick (radiance.c), so that those
 * of one side differ by whole bricks. */
static void align(struct filter_view *v, const radiance_lattice *a,
                  const struct flat *from)
{
    const struct filter_field *field = v->field;
    const radiance_lattice *b = &field->lattice;
    v->aligned = fabs(v->scale - 1.0) < 1e-6;
    for (int i = 0; i < 3; i++) {
        double first = (double)a->origin[i] + 0.5 * (double)a->side;
        double world = first / from->unit + from->centre[i];
        double there = (world - field->centre[i]) * field->unit;
        v->shift[i] = (there - (double)b->origin[i]) / (double)b->side - 0.5;
        double bricks = fmin(fmax(rint(v->shift[i] / 8.0), -1e6), 1e6);
        v->brick[i] = (int)bricks;
        v->aligned = v->aligned && fabs(v->shift[i] - 8.0 * bricks) < 1e-3;
    }
}

void filter_view_init(struct filter_view *v, const struct flat *from,
                      const struct filter_field *field)
{
    memset(v, 0, sizeof *v);
    if (!field || !same_numbers(&from->view.field, &field->lattice))
        return;
    const radiance_lattice *a = &from->view.field, *b = &field->lattice;
    v->field = field;
    v->scale = (double)a->side / from->unit * field->unit / (double)b->side;
    align(v, a, from);
    double steep = a->eye >= 0 ? steepness(a) : 0.0;
    if (steep > 0.0 && !same_eye(from, field)) {
        v->from = from;
        v->turn = cos(fmin(MOST_CHANGE / steep, 3.14159265358979));
    }
}

/* ---- single cells ------------------------------------------------------- */

static const float *cell_at(const struct filter_field *f, int x, int y, int z)
{
    const int32_t *n = f->lattice.bricks;
    if (x < 0 || y < 0 || z < 0 || x >= 8 * n[0] || y >= 8 * n[1] ||
        z >= 8 * n[2])
        return NULL;
    size_t brick = (size_t)(x >> 3) +
                   (size_t)n[0] *
                       ((size_t)(y >> 3) + (size_t)n[1] * (size_t)(z >> 3));
    int32_t slot = f->slots[brick];
    size_t inside = (size_t)(((z & 7) * 8 + (y & 7)) * 8 + (x & 7));
    return slot < 0 ? NULL
                    : f->cells + ((size_t)slot * 512 + inside) *
                                     (size_t)f->lattice.numbers;
}

/* At q, in cells of the field. */
static bool interpolate(const struct filter_view *v, const double q[3],
                        float out[FILTER_MAX_NUMBERS])
{
    const struct filter_field *f = v->field;
    double fraction[3], sum[FILTER_MAX_NUMBERS] = {0}, weights = 0.0;
    int low[3], numbers = f->lattice.numbers;
    for (int i = 0; i < 3; i++) {
        double whole = fmin(fmax(floor(q[i]), -1e6), 1e6);
        low[i] = (int)whole;
        fraction[i] = q[i] - whole;
    }
    for (int k = 0; k < 8; k++) {
        double weight = 1.0;
        for (int i = 0; i < 3; i++)
            weight *= k >> i & 1 ? fraction[i] : 1.0 - fraction[i];
        const float *cell = cell_at(f, low[0] + (k & 1), low[1] + (k >> 1 & 1),
                                    low[2] + (k >> 2));
        if (!cell || !(weight > 0.0))
            continue;
        weights += weight;
        for (int i = 0; i < numbers; i++)
            sum[i] += weight * (double)cell[i];
    }
    if (!(weights >= 0.5))
        return false;
    for (int i = 0; i < numbers; i++)
        out[i] = (float)(sum[i] / weights);
    return true;
}

/* The unit vector from a place of the world to a frame's eye. */
static void way_to_eye(const camera *eye, double unit, const double centre[3],
                       const double p[3], double out[3])
{
    double d[3] = {(double)eye->direction.x, (double)eye->direction.y,
                   (double)eye->direction.z};
    double at[3] = {(double)eye->location.x, (double)eye->location.y,
                    (double)eye->location.z};
    double size = 0.0;
    for (int i = 0; i < 3; i++) {
        out[i] = eye->orthographic ? -d[i] : at[i] / unit + centre[i] - p[i];
        size += out[i] * out[i];
    }
    for (int i = 0; i < 3; i++)
        out[i] /= sqrt(fmax(size, 1e-300));
}

static bool is_seen_alike(const struct filter_view *v, const int at[3])
{
    const struct filter_field *f = v->field;
    const radiance_lattice *l = &v->from->view.field;
    double p[3], a[3], b[3], dot = 0.0;
    for (int i = 0; i < 3; i++)
        p[i] = ((double)l->origin[i] + (at[i] + 0.5) * (double)l->side) /
                   v->from->unit +
               v->from->centre[i];
    way_to_eye(&v->from->view.view, v->from->unit, v->from->centre, p, a);
    way_to_eye(&f->eye, f->unit, f->centre, p, b);
    for (int i = 0; i < 3; i++)
        dot += a[i] * b[i];
    return dot >= v->turn;
}

/* ---- bricks ------------------------------------------------------------- */

static const float *aligned_cells(const struct filter_view *v,
                                  const int corner[3])
{
    return cell_at(v->field, corner[0] + 8 * v->brick[0],
                   corner[1] + 8 * v->brick[1], corner[2] + 8 * v->brick[2]);
}

const struct filter_power *filter_view_power(const struct filter_view *v,
                                             const int corner[3])
{
    const struct filter_field *f = v->field;
    const float *cells = f && f->power && v->aligned ? aligned_cells(v, corner)
                                                     : NULL;
    return cells ? f->power + (size_t)(cells - f->cells) /
                                  (FILTER_CELLS * (size_t)f->lattice.numbers)
                 : NULL;
}

/* One of the 2^3 cells of a block of a brick. */
static int cell_of_block(int block, int k)
{
    int x = 2 * (block & 3) + (k & 1), y = 2 * (block >> 2 & 3) + (k >> 1 & 1);
    return (2 * (block >> 4) + (k >> 2)) * 64 + y * 8 + x;
}

/* Whether there is a cell, whose numbers are 0 if not. */
static bool put_cell(struct filter_room *room, int cell, int numbers,
                     bool there)
{
    for (int k = 0; !there && k < numbers; k++)
        room->cells[cell * numbers + k] = 0.0f;
    room->there[cell] = there ? 1.0f : 0.0f;
    return there;
}

static bool fill_cells(const struct filter_view *v, const int corner[3],
                       struct filter_room *room)
{
    int numbers = v->field->lattice.numbers;
    float *out = room->cells;
    bool any = false;
    for (int i = 0; i < FILTER_CELLS; i++, out += numbers) {
        int at[3] = {corner[0] + (i & 7), corner[1] + (i >> 3 & 7),
                     corner[2] + (i >> 6)};
        double q[3];
        for (int k = 0; k < 3; k++)
            q[k] = v->scale * at[k] + v->shift[k];
        any |= put_cell(room, i, numbers, interpolate(v, q, out));
    }
    return any;
}

/* ---- moved blocks ------------------------------------------------------- */

/* The 3^3 cells around a block's place. */
struct around {
    const float *cell[27]; /* NULL: none */
    float fraction[3];
    int count; /* of those that are there */
};

/* Of those that lie in one brick. */
static void load_within(const struct filter_field *f, const int low[3],
                        struct around *a)
{
    const float *first = cell_at(f, low[0], low[1], low[2]);
    for (int k = 0; k < 27; k++) {
        int cell = 64 * (k / 9) + 8 * (k / 3 % 3) + k % 3;
        a->cell[k] = first ? first + cell * f->lattice.numbers : NULL;
    }
    a->count = first ? 27 : 0;
}

static void load_around(const struct filter_view *v, const float place[3],
                        struct around *a)
{
    int low[3], numbers = v->field->lattice.numbers;
    for (int i = 0; i < 3; i++) {
        float whole = floorf(place[i]);
        low[i] = (int)whole;
        a->fraction[i] = place[i] - whole;
    }
    if ((low[0] & 7) < 6 && (low[1] & 7) < 6 && (low[2] & 7) < 6) {
        load_within(v->field, low, a);
        return;
    }
    a->count = 0;
    for (int z = 0, k = 0; z < 3; z++)
        for (int y = 0; y < 3; y++)
            for (int x = 0; x < 3; x++, k++) {
                /* In a brick cells follow each other along x. */
                bool begins = x == 0 || ((low[0] + x) & 7) == 0;
                a->cell[k] = begins ? cell_at(v->field, low[0] + x, low[1] + y,
                                              low[2] + z)
                             : a->cell[k - 1] ? a->cell[k - 1] + numbers
                                              : NULL;
                a->count += a->cell[k] != NULL;
            }
}

/* Between each number and that so many behind it; more than are asked for,
 * since a loop without gaps is faster. */
static inline void blend(const float *restrict from, int count, int behind,
                         float t, float *restrict to)
{
    for (int i = 0; i < count; i++)
        to[i] = from[i] + t * (from[i + behind] - from[i]);
}

enum { MOST = FILTER_MAX_NUMBERS + 1 };

/* Between 3^3 cells of so many numbers, along x, y, z; returns where a block's
 * own begin, with rows of 3 and layers of 9 cells. */
static inline const float *blend_cells(float p[27 * MOST], float q[27 * MOST],
                                       int numbers, const float fraction[3])
{
    blend(p, 26 * numbers, numbers, fraction[0], q);
    blend(q, 23 * numbers, 3 * numbers, fraction[1], p);
    blend(p, 14 * numbers, 9 * numbers, fraction[2], q);
    return q;
}

static int place_in(int cell)
{
    return (cell & 1) + 3 * (cell >> 1 & 1) + 9 * (cell >> 2);
}

/* Three cells along x; of two bricks they are copied side by side. */
static inline const float *row_of(const float *const cell[3], int numbers,
                                  float copy[3 * MOST])
{
    if (cell[1] == cell[0] + numbers && cell[2] == cell[1] + numbers)
        return cell[0];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < numbers; i++)
            copy[k * numbers + i] = cell[k][i];
    return copy;
}

static inline void between(const float *restrict a, const float *restrict b,
                           int count, float t, float *restrict to)
{
    for (int i = 0; i < count; i++)
        to[i] = a[i] + t * (b[i] - a[i]);
}

/* A block whose surroundings are all there: two cells of each row at a time. */
static inline void put_whole(const struct around *a, int numbers, int block,
                             struct filter_room *room)
{
    float x[9][2 * MOST], y[6][2 * MOST], copy[3 * MOST];
    int two = 2 * numbers;
    for (int i = 0; i < 9; i++) {
        const float *row = row_of(a->cell + 3 * i, numbers, copy);
        between(row, row + numbers, two, a->fraction[0], x[i]);
    }
    for (int i = 0; i < 6; i++) {
        int row = 3 * (i >> 1) + (i & 1);
        between(x[row], x[row + 1], two, a->fraction[1], y[i]);
    }
    for (int i = 0; i < 4; i++) {
        int cell = cell_of_block(block, 2 * i);
        between(y[i], y[i + 2], two, a->fraction[2],
                room->cells + cell * numbers);
        room->there[cell] = room->there[cell + 1] = 1.0f;
    }
}

/* One some of whose surroundings are not there: their weights are one number
 * more. */
static inline void put_part(const struct around *a, int numbers, int block,
                            struct filter_room *room)
{
    float p[27 * MOST], q[27 * MOST];
    int all = numbers + 1;
    for (int k = 0; k < 27; k++) {
        const float *from = a->cell[k];
        for (int i = 0; i < numbers; i++)
            p[k * all + i] = from ? from[i] : 0.0f;
        p[k * all + numbers] = from ? 1.0f : 0.0f;
    }
    const float *x = blend_cells(p, q, all, a->fraction);
    for (int k = 0; k < 8; k++) {
        const float *from = x + place_in(k) * all;
        int cell = cell_of_block(block, k);
        bool there = from[numbers] >= 0.5f;
        for (int i = 0; there && i < numbers; i++)
            room->cells[cell * numbers + i] = from[i] / from[numbers];
        put_cell(room, cell, numbers, there);
    }
}

static void put_nothing(int numbers, int block, struct filter_room *room)
{
    for (int k = 0; k < 8; k++)
        put_cell(room, cell_of_block(block, k), numbers, false);
}

/* With the numbers known, loops over them are none. */
static void put_block(const struct around *a, int numbers, int block,
                      struct filter_room *room)
{
    if (a->count == 0)
        put_nothing(numbers, block, room);
    else if (a->count == 27 && numbers == 3)
        put_whole(a, 3, block, room);
    else if (a->count == 27)
        put_whole(a, numbers, block, room);
    else if (numbers == 3)
        put_part(a, 3, block, room);
    else
        put_part(a, numbers, block, room);
}

static bool fill_moved(const struct filter_view *v,
                       const struct filter_places *places,
                       struct filter_room *room)
{
    int numbers = v->field->lattice.numbers;
    bool any = false;
    for (int b = 0; b < FILTER_BLOCKS; b++) {
        struct around around;
        around.count = 0;
        if (!isnan(places->first[b][0]))
            load_around(v, places->first[b], &around);
        put_block(&around, numbers, b, room);
        any = any || around.count > 0;
    }
    return any;
}

/* Leaves out blocks that were seen from elsewhere, by their first cells. */
static bool drop_unlike(const struct filter_view *v, const int corner[3],
                        float there[FILTER_CELLS])
{
    bool any = false;
    for (int b = 0; b < FILTER_BLOCKS; b++) {
        int at[3] = {corner[0] + 2 * (b & 3), corner[1] + 2 * (b >> 2 & 3),
                     corner[2] + 2 * (b >> 4)};
        bool alike = is_seen_alike(v, at);
        for (int k = 0; k < 8; k++) {
            float *cell = &there[cell_of_block(b, k)];
            *cell = alike ? *cell : 0.0f;
            any = any || *cell > 0.0f;
        }
    }
    return any;
}

bool filter_view_brick(const struct filter_view *v, const int corner[3],
                       const struct filter_places *places,
                       struct filter_room *room, struct filter_brick *out)
{
    if (!v->field)
        return false;
    room->cells = room->kept ? room->kept : room->own;
    out->there = NULL;
    if (places) {
        out->cells = room->cells;
        if (!fill_moved(v, places, room))
            return false;
    } else if (v->aligned) {
        out->cells = aligned_cells(v, corner);
        if (!out->cells || !v->from)
            return out->cells;
        for (int i = 0; i < FILTER_CELLS; i++)
            room->there[i] = 1.0f;
    } else {
        out->cells = room->cells;
        if (!fill_cells(v, corner, room))
            return false;
    }
    out->there = room->there;
    return !v->from || drop_unlike(v, corner, room->there);
}
