/* Blobs: their components in their own spaces, and a tree over them. */
#include "core/brume.h"
#include "core/matrix.h"
#include "core/physics/solid_blob.h"
#include "core/solid.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct component {
    double strength, length;
    matrix to_local;
    double box[6];
    double key; /* what a split sorts by                    */
};

/* Its own space: the radius 1, the axis from the origin along z. */
static matrix local_frame(const double from[3], const double axis[3],
                          double length, double radius)
{
    double z[3] = {0, 0, 1}, x[3], y[3];
    matrix m;

    for (int i = 0; length > 0 && i < 3; i++)
        z[i] = axis[i] / length;
    int least = fabs(z[0]) < fabs(z[1]) ? 0 : 1;
    least = fabs(z[2]) < fabs(z[least]) ? 2 : least;
    double sum = sqrt(1 - z[least] * z[least]);
    for (int i = 0; i < 3; i++)
        x[i] = ((i == least) - z[least] * z[i]) / sum;
    for (int i = 0; i < 3; i++)
        y[i] = z[(i + 1) % 3] * x[(i + 2) % 3] -
               z[(i + 2) % 3] * x[(i + 1) % 3];
    for (int i = 0; i < 3; i++) {
        m.m[i][0] = radius * x[i];
        m.m[i][1] = radius * y[i];
        m.m[i][2] = radius * z[i];
        m.m[i][3] = from[i];
    }
    return m;
}

/* Around the unit balls at both ends of the axis. */
static void component_box(const matrix *to_world, struct component *c)
{
    for (int i = 0; i < 3; i++) {
        const double *row = to_world->m[i];
        double reach = sqrt(row[0] * row[0] + row[1] * row[1] +
                            row[2] * row[2]);
        double end = row[3] + c->length * row[2];
        c->box[i] = fmin(row[3], end) - reach;
        c->box[3 + i] = fmax(row[3], end) + reach;
    }
}

static bool component_make(const double *n, struct component *c,
                           struct brume_error *err)
{
    double axis[3], radius = n[2], length = 0;
    double transform[3][4];
    matrix to_world, local;

    memcpy(transform, n + 9, sizeof transform);
    for (int i = 0; i < 3; i++)
        axis[i] = n[0] != 0 ? n[6 + i] - n[3 + i] : 0;
    length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    if (!(radius > 0))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "blob component of radius %g; expected one above 0",
                          radius);
    c->strength = n[1];
    c->length = length / radius;
    local = local_frame(n + 3, axis, length, radius);
    to_world = matrix_from((const double(*)[4])transform);
    to_world = matrix_compose(&to_world, &local);
    if (!matrix_invert(&to_world, &c->to_local) || !isfinite(c->length))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "blob component that a transform makes flat");
    component_box(&to_world, c);
    return true;
}

static int by_key(const void *a, const void *b)
{
    double x = ((const struct component *)a)->key;
    double y = ((const struct component *)b)->key;

    return (x > y) - (x < y);
}

/* The box around components, a little wider, so that no root is lost to
 * rounding. */
static void box_around(const struct component *c, size_t count, double *box)
{
    for (int i = 0; i < 3; i++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t k = 0; k < count; k++) {
            lo = fmin(lo, c[k].box[i]);
            hi = fmax(hi, c[k].box[3 + i]);
        }
        double margin = 1e-9 * (hi - lo) + 1e-12 * fmax(fabs(lo), fabs(hi));
        box[i] = lo - margin;
        box[3 + i] = hi + margin;
    }
}

static void sort_by_longest(struct component *c, size_t count,
                            const double *box)
{
    int axis = 0;

    for (int i = 1; i < 3; i++)
        if (box[3 + i] - box[i] > box[3 + axis] - box[axis])
            axis = i;
    for (size_t k = 0; k < count; k++)
        c[k].key = c[k].box[axis] + c[k].box[3 + axis];
    qsort(c, count, sizeof *c, by_key);
}

/* A subtree of n components has 2 n - 1 nodes: the first is its root, then
 * come those of its lower half and those of its upper half. */
static void build_tree(struct component *c, size_t count, double *nodes)
{
    struct {
        size_t first, count, node;
    } todo[64];
    int left = 1;

    todo[0].first = todo[0].node = 0;
    todo[0].count = count;
    while (left > 0) {
        size_t first = todo[--left].first, n = todo[left].count;
        size_t at = todo[left].node, half = n / 2;
        double *node = nodes + BLOB_NODE * at;
        box_around(c + first, n, node);
        node[6] = (double)(at + 2 * n - 1);
        node[7] = n == 1 ? (double)first : -1;
        if (n == 1)
            continue;
        sort_by_longest(c + first, n, node);
        todo[left].first = first + half;
        todo[left].count = n - half;
        todo[left++].node = at + 2 * half;
        todo[left].first = first;
        todo[left].count = half;
        todo[left++].node = at + 1;
    }
}

static void store_component(const struct component *c, double *out)
{
    out[0] = c->strength;
    out[1] = c->length;
    memcpy(out + 2, c->to_local.m, sizeof c->to_local.m);
}

/* There is surface only around components that attract. */
static void blob_bounds(const struct component *c, size_t count,
                        struct solid *solid)
{
    double box[6] = {INFINITY,  INFINITY,  INFINITY,
                     -INFINITY, -INFINITY, -INFINITY};

    for (size_t k = 0; k < count; k++)
        for (int i = 0; c[k].strength > 0 && i < 3; i++) {
            box[i] = fmin(box[i], c[k].box[i]);
            box[3 + i] = fmax(box[3 + i], c[k].box[3 + i]);
        }
    if (!(box[0] <= box[3]))
        memset(box, 0, sizeof box);
    solid_bounds(solid, box[0], box[1], box[2], box[3], box[4], box[5]);
}

static bool blob_fill(double threshold, struct component *c, size_t count,
                      struct arena *arena, struct solid *solid,
                      struct brume_error *err)
{
    size_t nodes = count ? 2 * count - 1 : 0;
    size_t base = BLOB_HEAD + BLOB_NODE * nodes;

    if (!solid_alloc(arena, base + BLOB_COMPONENT * count, solid, err))
        return false;
    solid->data[0] = threshold;
    solid->data[1] = (double)nodes;
    solid->data[2] = (double)base;
    if (count)
        build_tree(c, count, solid->data + BLOB_HEAD);
    for (size_t k = 0; k < count; k++)
        store_component(&c[k], solid->data + base + BLOB_COMPONENT * k);
    blob_bounds(c, count, solid);
    return true;
}

bool solid_blob(struct arena *arena, double threshold, const double *components,
                size_t count, struct solid *solid, struct brume_error *err)
{
    const size_t most = 100000000; /* offsets stay within an int       */
    size_t used = 0;

    if (!(threshold > 0) || !isfinite(threshold))
        return brume_fail(err, BRUME_ERR_SCENE,
                          "blob threshold %g; expected one above 0", threshold);
    if (count == 0 || count > most)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "blob of %zu components; expected 1 to %zu", count,
                          most);
    if (!solid_finite(components, count * BRUME_BLOB_NUMBERS, "blob", err))
        return false;
    struct component *c = arena_array(arena, count, sizeof *c);
    if (!c)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    for (size_t k = 0; k < count; k++) {
        const double *n = components + k * BRUME_BLOB_NUMBERS;
        if (n[1] != 0 && !component_make(n, &c[used++], err))
            return false;
    }
    return blob_fill(threshold, c, used, arena, solid, err);
}
