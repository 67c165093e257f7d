/* Extents of shapes as POV-Ray reports them: boxes in the shape's own space,
 * transformed as boxes with each composite. */
#include <math.h>
#include <stdlib.h>
#include "core/physics/leaf.h"
#include "core/query.h"
#include "core/shapes.h"
#include "lib/memory.h"

/* A round frame's sides as POV-Ray's boxes have them, whatever ours: turned
 * about the axis by twice the angle of its x and y. Measured. */
static void turn_frame(matrix *m)
{
    double axis[3], size = 0.0, radius = 0.0;
    for (int i = 0; i < 3; i++) {
        size += m->m[i][2] * m->m[i][2];
        radius += m->m[i][0] * m->m[i][0];
    }
    size = sqrt(size);
    radius = sqrt(radius);
    for (int i = 0; i < 3; i++)
        axis[i] = m->m[i][2] / size;
    double x = axis[0], y = axis[1], z = axis[2], k = 1.0 / (1.0 + fabs(z));
    double flat = x * x + y * y;
    double c = flat > 0.0 ? (x * x - y * y) / flat : 1.0;
    double s = flat > 0.0 ? 2.0 * x * y / flat : 0.0;
    double up = z < 0.0 ? -1.0 : 1.0;
    double a[3] = {1.0 - x * x * k, -x * y * k, -x * up};
    double b[3] = {-x * y * k, 1.0 - y * y * k, -y * up};
    for (int i = 0; i < 3; i++) {
        m->m[i][0] = radius * (s * a[i] - c * b[i]);
        m->m[i][1] = radius * (c * a[i] + s * b[i]);
    }
}

/* Round shapes have boxes along their own axis. */
static struct box round_box(const struct leaf *leaf, const matrix *transform)
{
    double low = leaf->kind == SHAPE_DISC ? -0.001 : 0.0;
    double high = leaf->kind == SHAPE_DISC ? 0.001 : 1.0;
    struct box own = {{-1, -1, low}, {1, 1, high}};
    matrix map = leaf->map;
    turn_frame(&map);
    map = matrix_compose(transform, &map);
    return box_transform(&own, &map);
}

static bool leaf_extent(const brume_scene *scene, const struct brume_shape *s,
                        struct box *out, struct brume_error *err)
{
    struct arena arena;
    struct leaf leaf;
    matrix placed = matrix_from(s->transform), none = matrix_identity();
    bool tight = s->kind == BRUME_SHAPE_SPHERE || s->kind == BRUME_SHAPE_PLANE;
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

/* Planes that clip are not reckoned with. */
static void clip_extent(const brume_scene *scene, const struct brume_shape *s,
                        struct box *box)
{
    matrix placed = matrix_from(s->transform);
    for (size_t i = 0; i < s->clip_count; i++) {
        struct box clip = scene->queries[s->clips[i]].extent;
        clip = box_transform(&clip, &placed);
        if (!scene->shapes[s->clips[i]].inverse)
            *box = box_common(box, &clip);
    }
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
