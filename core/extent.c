/* Extents of shapes as POV-Ray reports them: boxes in the shape's own space,
 * transformed as boxes with each composite. */
#include <math.h>
#include <stdlib.h>
#include "core/physics/leaf.h"
#include "core/query.h"
#include "core/shapes.h"
#include "lib/memory.h"

/* A round frame's sides as POV-Ray's boxes have them, whatever ours: z is
 * turned about y and then about z into the axis, and before that about itself
 * by the last angle, a disc the other way (tests/oracle/shapes.py). */
static void turn_frame(matrix *m, bool disc)
{
    double z = 0.0, radius = 0.0;
    for (int i = 0; i < 3; i++) {
        z += m->m[i][2] * m->m[i][2];
        radius += m->m[i][0] * m->m[i][0];
    }
    z = m->m[2][2] / sqrt(z);
    radius = sqrt(radius);
    double rho = hypot(m->m[0][2], m->m[1][2]), r = sqrt(fmax(0, 1 - z * z));
    double c = rho > 0.0 ? m->m[0][2] / rho : 1.0;
    double s = rho > 0.0 ? m->m[1][2] / rho : 0.0;
    double a[3] = {z * c, z * s, -r}, b[3] = {-s, c, 0};
    for (int i = 0; i < 3; i++) {
        m->m[i][0] = radius * (c * a[i] + (disc ? -s : s) * b[i]);
        m->m[i][1] = radius * (c * b[i] - (disc ? -s : s) * a[i]);
    }
}

/* Round shapes have boxes along their own axis. */
static struct box round_box(const struct leaf *leaf, const matrix *transform)
{
    double low = leaf->kind == SHAPE_DISC ? -0.001 : 0.0;
    double high = leaf->kind == SHAPE_DISC ? 0.001 : 1.0;
    struct box own = {{-1, -1, low}, {1, 1, high}};
    matrix map = leaf->map;
    turn_frame(&map, leaf->kind == SHAPE_DISC);
    map = matrix_compose(transform, &map);
    return box_transform(&own, &map);
}

/* A ball that was turned and then stretched along the axes has a tight box. */
static bool is_tight(const struct brume_shape *s)
{
    const double(*m)[4] = s->transform;
    if (s->kind == BRUME_SHAPE_PLANE)
        return true;
    for (int i = 0; i < 3; i++) {
        const double *a = m[i], *b = m[(i + 1) % 3];
        double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        double size = fabs(a[0] * b[0]) + fabs(a[1] * b[1]) + fabs(a[2] * b[2]);
        if (fabs(dot) > 1e-9 * size)
            return false;
    }
    return s->kind == BRUME_SHAPE_SPHERE;
}

static bool leaf_extent(const brume_scene *scene, const struct brume_shape *s,
                        struct box *out, struct brume_error *err)
{
    struct arena arena;
    struct leaf leaf;
    matrix placed = matrix_from(s->transform), none = matrix_identity();
    bool tight = is_tight(s);
    struct leaf_request request = {scene, s, LEAF_ALL, true,
                                   tight ? &placed : &none};
    arena_init(&arena, 0);
    bool good = leaf_make(&request, &arena, &leaf, err);
    if (good) {
        bool round = leaf.kind == SHAPE_CYLINDER || leaf.kind == SHAPE_CONE ||
                     leaf.kind == SHAPE_DISC;
        *out = round   ? round_box(&leaf, &placed)
               : tight ? leaf.bounds
                       : box_transform(&leaf.bounds, &placed);
        leaf_release(&leaf);
    }
    arena_release(&arena);
    return good;
}

/* Of a composite, from those of its parts; inverted ones bound nothing. */
static struct box composite_extent(const brume_scene *scene,
                                   const struct brume_shape *s)
{
    bool hull = s->kind == BRUME_SHAPE_UNION || s->kind == BRUME_SHAPE_MERGE;
    struct box out = hull ? box_empty() : box_endless();
    matrix placed = matrix_from(s->transform);
    for (size_t i = 0; i < s->part_count; i++) {
        const struct box *part = &scene->queries[s->parts[i]].extent;
        if (hull)
            out = box_hull(&out, part);
        else if (!scene->shapes[s->parts[i]].inverse)
            out = box_common(&out, part);
        if (s->kind == BRUME_SHAPE_DIFFERENCE)
            break;
    }
    return box_transform(&out, &placed);
}

static double box_volume(const struct box *b)
{
    return (b->hi[0] - b->lo[0]) * (b->hi[1] - b->lo[1]) *
           (b->hi[2] - b->lo[2]);
}

/* Clips matter only where their box is smaller than the shape's, and then it
 * is taken as it is. */
static void clip_extent(const brume_scene *scene, const struct brume_shape *s,
                        struct box *box)
{
    matrix placed = matrix_from(s->transform);
    struct box common = box_endless();
    for (size_t i = 0; i < s->clip_count; i++)
        if (!scene->shapes[s->clips[i]].inverse)
            common = box_common(&common, &scene->queries[s->clips[i]].extent);
    common = box_transform(&common, &placed);
    if (box_is_bounded(&common) && !box_is_empty(&common) &&
        !(box_volume(&common) >= box_volume(box)))
        *box = common;
}

static bool find_extent(brume_scene *scene, int shape, struct brume_error *err)
{
    const struct brume_shape *s = &scene->shapes[shape];
    struct scene_query *q = &scene->queries[shape];
    if (shape_is_composite(s))
        q->extent = composite_extent(scene, s);
    else if (!leaf_extent(scene, s, &q->extent, err))
        return false;
    clip_extent(scene, s, &q->extent);
    q->has_extent = true;
    return true;
}

/* A shape on the way down, and how many of its parts and clips are done. */
struct step {
    int shape;
    size_t done;
};

/* The next part or clip, or -1. */
static int next_part(const brume_scene *scene, struct step *step)
{
    const struct brume_shape *s = &scene->shapes[step->shape];
    size_t i = step->done++;
    if (i < s->part_count)
        return s->parts[i];
    i -= s->part_count;
    return i < s->clip_count ? s->clips[i] : -1;
}

/* Parts come before what they are part of. A path of parts is never longer
 * than there are shapes, as their ids fall. */
static bool find_extents(brume_scene *scene, int shape, struct brume_error *err)
{
    struct step *stack = memory_new((size_t)shape + 1, sizeof *stack, err);
    size_t depth = 0;
    bool good = stack != NULL;
    if (good)
        stack[depth++].shape = shape;
    while (good && depth > 0) {
        int part = next_part(scene, &stack[depth - 1]);
        if (part < 0)
            good = find_extent(scene, stack[--depth].shape, err);
        else if (!scene->queries[part].has_extent)
            stack[depth++] = (struct step){part, 0};
    }
    free(stack);
    return good;
}

static double limited(double x)
{
    return fmax(-BRUME_ENDLESS, fmin(x, BRUME_ENDLESS));
}

bool brume_extent(brume_scene *scene, int shape, double lowest[3],
                  double highest[3], struct brume_error *err)
{
    const struct scene_query *q = query_of(scene, shape, err);
    if (!q || (!q->has_extent && !find_extents(scene, shape, err)))
        return false;
    /* POV-Ray knows of no box that ends on some sides only. */
    bool bounded = box_is_bounded(&q->extent);
    for (int i = 0; i < 3; i++) {
        lowest[i] = bounded ? limited(q->extent.lo[i]) : -BRUME_ENDLESS;
        highest[i] = bounded ? limited(q->extent.hi[i]) : BRUME_ENDLESS;
    }
    return true;
}
