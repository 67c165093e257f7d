/* Splines: their knots sorted, the natural spline's bending solved, the whole
 * laid out as physics/spline.h reads it. */
#define PHYSICS_DOUBLE
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "core/function.h"
#include "lib/memory.h"

enum { KNOT_LIMIT = 1 << 20 };

static bool check(const struct brume_spline *spline, struct brume_error *err)
{
    if ((unsigned)spline->kind >= SPLINE_TYPES)
        return brume_fail(err, BRUME_ERR_SCENE, "there is no such spline");
    if (spline->terms < 1 || spline->terms > SPLINE_TERMS)
        return brume_fail(err, BRUME_ERR_SCENE,
                          "a spline of vectors of %d numbers", spline->terms);
    if (spline->count < 1)
        return brume_fail(err, BRUME_ERR_SCENE, "the spline has no points");
    if (spline->count > KNOT_LIMIT)
        return brume_fail(err, BRUME_ERR_LIMIT,
                          "a spline has %d points but at most %d are possible",
                          spline->count, KNOT_LIMIT);
    for (int i = 0; i < spline->count; i++)
        if (!isfinite(spline->parameters[i]))
            return brume_fail(err, BRUME_ERR_SCENE,
                              "a spline's parameter is not finite");
    return true;
}

struct knot {
    double t;
    int index; /* of the point in the order they were given   */
};

static int by_parameter(const void *a, const void *b)
{
    const struct knot *k = a, *l = b;
    return k->t != l->t ? (k->t > l->t) - (k->t < l->t) : k->index - l->index;
}

/* The points in order of their parameters, one for each. As in POV-Ray, a
 * point replaces an earlier one of the same parameter, unless no point before
 * it has a greater one. Returns how many are left. */
static int sort(const struct brume_spline *spline, struct knot *knots)
{
    int count = 0;
    double greatest = -INFINITY;
    for (int i = 0; i < spline->count; i++) {
        double t = spline->parameters[i];
        if (t != greatest)
            knots[count++] = (struct knot){t, i};
        greatest = fmax(greatest, t);
    }
    qsort(knots, (size_t)count, sizeof *knots, by_parameter);
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (i + 1 == count || knots[i].t != knots[i + 1].t)
            knots[kept++] = knots[i];
    return kept;
}

/* Second derivatives of the natural spline, of term k: the tridiagonal system
 * of continuous slopes, zero at both ends. `work` has room for count. */
static void solve_natural(const double *t, const double *values, int count,
                          int terms, int k, double *seconds, double *work)
{
    work[0] = seconds[k] = 0.0;
    for (int i = 1; i < count - 1; i++) {
        double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
        double bend = (values[(i + 1) * terms + k] - values[i * terms + k]) /
                          after -
                      (values[i * terms + k] - values[(i - 1) * terms + k]) /
                          before;
        double pivot = 2.0 * (before + after) - before * work[i - 1];
        work[i] = after / pivot;
        seconds[i * terms + k] = (6.0 * bend -
                                  before * seconds[(i - 1) * terms + k]) /
                                 pivot;
    }
    seconds[(count - 1) * terms + k] = 0.0;
    for (int i = count - 2; i > 0; i--)
        seconds[i * terms + k] -= work[i] * seconds[(i + 1) * terms + k];
}

static void lay_out(const struct brume_spline *spline, const struct knot *knots,
                    int count, double *out, double *work)
{
    int terms = spline->terms;
    double *t = out + SPLINE_HEAD, *values = t + count;
    out[0] = (double)spline->kind;
    out[1] = terms;
    out[2] = count;
    for (int i = 0; i < count; i++) {
        t[i] = knots[i].t;
        memcpy(values + i * terms, spline->values + knots[i].index * terms,
               (size_t)terms * sizeof *values);
    }
    for (int k = 0; k < terms; k++)
        solve_natural(t, values, count, terms, k, values + count * terms, work);
}

int brume_add_spline(brume_scene *scene, const struct brume_spline *spline,
                     struct brume_error *err)
{
    if (!check(spline, err))
        return -1;
    int id = -1, count;
    size_t n = (size_t)spline->count, size;
    struct knot *knots = memory_new(n, sizeof *knots, err);
    double *work = memory_new(n, sizeof *work, err), *out = NULL;
    void *grown;
    int32_t first;
    if (!knots || !work)
        goto done;
    count = sort(spline, knots);
    size = SPLINE_HEAD + (size_t)count * (1 + 2 * (size_t)spline->terms);
    out = memory_new(size, sizeof *out, err);
    if (!out)
        goto done;
    lay_out(spline, knots, count, out, work);
    grown = memory_grow(scene->splines, &scene->splines_capacity,
                        scene->splines_count + 1, sizeof *scene->splines, err);
    if (!grown)
        goto done;
    scene->splines = grown;
    if (!pool_add(scene, out, size, &first, err))
        goto done;
    id = (int)scene->splines_count;
    scene->splines[scene->splines_count++] = first;
done:
    free(out);
    free(work);
    free(knots);
    return id;
}

bool spline_check(const struct brume_scene *s, int id, int kind,
                  struct brume_error *err)
{
    if (id < 0 || (size_t)id >= s->splines_count)
        return brume_fail(err, BRUME_ERR_SCENE, "there is no spline %d", id);
    return (kind >= -1 && kind < SPLINE_TYPES) ||
           brume_fail(err, BRUME_ERR_SCENE, "there is no such spline");
}

bool brume_eval_spline(const brume_scene *scene, int id, int kind, double t,
                       double out[BRUME_MAX_RESULTS], struct brume_error *err)
{
    if (!spline_check(scene, id, kind, err))
        return false;
    spline_eval(scene->pool + scene->splines[id], kind, t, out);
    return true;
}
