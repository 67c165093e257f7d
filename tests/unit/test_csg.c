/* test_csg.c - composites against what their definition says: random trees of
 * parts, asked about points and lines, in double and as they are rendered. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>
#include "core/brume.h"
#include "core/physics/inside.h"
#include "core/physics/rng.h"
#include "core/prepare.h"

enum { MOST = 200, TREES = 400, LINES = 60, POINTS = 40, HITS = 200 };

/* What the test knows of the shapes that it has told the scene. */
struct told {
    struct brume_shape shape[MOST];
    int parts[MOST][4], clips[MOST];
    int count;
};

struct forest {
    brume_scene *scene;
    struct told told;
    rng random;
    int material;
};

static double uniform(rng *r, double lo, double hi)
{
    return lo + (hi - lo) * (double)rng_float(r);
}

static int choose(rng *r, int n)
{
    int i = (int)(rng_float(r) * (float)n);
    return i < n ? i : n - 1;
}

/* Scaled, turned about an axis of space, and moved. */
static void random_transform(rng *r, double m[3][4])
{
    double a = uniform(r, 0, 6.28), c = cos(a), s = sin(a);
    int i = choose(r, 3), j = (i + 1) % 3, k = (i + 2) % 3;
    memset(m, 0, 12 * sizeof **m);
    m[i][i] = uniform(r, 0.5, 1.5);
    m[j][j] = m[k][k] = c;
    m[j][k] = -s;
    m[k][j] = s;
    for (int row = 0; row < 3; row++)
        m[row][3] = uniform(r, -0.6, 0.6);
}

static int tell(struct forest *f, const struct brume_shape *shape)
{
    struct brume_error err = {0};
    int id = brume_add_shape(f->scene, shape, &err);
    if (id < 0)
        fail_msg("%s", err.text);
    assert_int_equal(id, f->told.count);
    f->told.shape[f->told.count++] = *shape;
    return id;
}

static int random_leaf(struct forest *f)
{
    static const enum brume_shape_kind kinds[] = {
        BRUME_SHAPE_SPHERE, BRUME_SHAPE_BOX,   BRUME_SHAPE_CYLINDER,
        BRUME_SHAPE_CONE,   BRUME_SHAPE_PLANE, BRUME_SHAPE_TORUS};
    struct brume_shape s = BRUME_SHAPE_INIT;
    s.kind = kinds[choose(&f->random, 6)];
    s.part = true;
    s.material = BRUME_INHERIT;
    s.inverse = rng_chance(&f->random, 0.2f);
    s.radius = s.kind == BRUME_SHAPE_PLANE ? 0.1 : 0.8;
    s.radius_b = 0.3;
    s.a[1] = s.kind == BRUME_SHAPE_TORUS ? 0 : 0.4;
    s.b[0] = s.b[2] = s.kind == BRUME_SHAPE_BOX ? 0.7 : 0;
    s.b[1] = s.kind == BRUME_SHAPE_BOX ? 1.1 : -0.7;
    random_transform(&f->random, s.transform);
    return tell(f, &s);
}

/* Takes one of the ids out of the pool. */
static int draw(rng *r, int *pool, int *count)
{
    int i = choose(r, *count), id = pool[i];
    pool[i] = pool[--*count];
    return id;
}

/* Composites of leaves and of each other; no shape is part of two, as what
 * coincides with itself has skins without thickness. */
static int random_tree(struct forest *f, int composites)
{
    int pool[MOST], count = 0;
    for (int i = 0; i < composites; i++) {
        struct brume_shape s = BRUME_SHAPE_INIT;
        bool clipped = rng_chance(&f->random, 0.2f);
        for (int k = 0; k < 3; k++)
            pool[count++] = random_leaf(f);
        if (clipped)
            pool[count++] = random_leaf(f);
        int id = f->told.count;
        s.kind = BRUME_SHAPE_MERGE + choose(&f->random, 3);
        s.part = i + 1 < composites;
        s.material = s.part ? BRUME_INHERIT : f->material;
        s.inverse = rng_chance(&f->random, 0.2f);
        s.parts = f->told.parts[id];
        s.part_count = 2 + (size_t)choose(&f->random, 2);
        for (size_t k = 0; k < s.part_count; k++)
            f->told.parts[id][k] = draw(&f->random, pool, &count);
        s.clips = &f->told.clips[id];
        s.clip_count = clipped;
        if (clipped)
            f->told.clips[id] = draw(&f->random, pool, &count);
        random_transform(&f->random, s.transform);
        pool[count++] = tell(f, &s);
    }
    return f->told.count - 1;
}

/* ---- the truth --------------------------------------------------------- */

static void to_local(const double m[3][4], const double p[3], double out[3])
{
    matrix a = matrix_from(m), inverse;
    assert_true(matrix_invert(&a, &inverse));
    matrix_point(&inverse, p, out);
}

/* Negative inside; its size tells how near the boundary is, about. */
static double leaf_value(const struct brume_shape *s, const double p[3])
{
    double round = hypot(p[0], p[2]), y = p[1];
    switch (s->kind) {
    case BRUME_SHAPE_SPHERE:
        return sqrt(p[0] * p[0] + (y - 0.4) * (y - 0.4) + p[2] * p[2]) - 0.8;
    case BRUME_SHAPE_BOX:
        return fmax(fmax(fabs(p[0] - 0.35), fabs(p[2] - 0.35)) - 0.35,
                    fabs(y - 0.75) - 0.35);
    case BRUME_SHAPE_CYLINDER:
        return fmax(round - 0.8, fabs(y + 0.15) - 0.55);
    case BRUME_SHAPE_CONE:
        return fmax(round - (0.3 + 0.5 * (y + 0.7) / 1.1),
                    fabs(y + 0.15) - 0.55);
    case BRUME_SHAPE_PLANE:
        return y - 0.1;
    default:
        return hypot(round - 0.8, y) - 0.3;
    }
}

/* Whether shape `id` holds the point; *near falls to the least distance. */
static bool holds(const struct told *t, int id, const double p[3], double *near)
{
    const struct brume_shape *s = &t->shape[id];
    double q[3], value;
    bool in;
    to_local(s->transform, p, q);
    if (s->kind < BRUME_SHAPE_UNION) {
        value = leaf_value(s, q);
        *near = fmin(*near, fabs(value));
        return (value < 0) != s->inverse;
    }
    in = s->kind != BRUME_SHAPE_UNION && s->kind != BRUME_SHAPE_MERGE;
    for (size_t i = 0; i < s->part_count; i++) {
        bool part = holds(t, s->parts[i], q, near);
        if (s->kind == BRUME_SHAPE_DIFFERENCE && i > 0)
            part = !part;
        if (s->kind == BRUME_SHAPE_UNION || s->kind == BRUME_SHAPE_MERGE)
            in = in || part;
        else
            in = in && part;
    }
    in = in != s->inverse;
    for (size_t i = 0; i < s->clip_count; i++)
        in = holds(t, s->clips[i], q, near) && in;
    return in;
}

/* Under an odd number of inversions clips cut what is inverted, so that trees
 * with both are no sets any more; the truth above has no word for them. */
static bool plain(const struct told *t, int id)
{
    bool inverted = false, clipped = false;
    for (int i = 0; i <= id; i++) {
        const struct brume_shape *s = &t->shape[i];
        clipped = clipped || s->clip_count > 0;
        inverted = inverted || (s->kind >= BRUME_SHAPE_UNION && s->inverse) ||
                   s->kind == BRUME_SHAPE_DIFFERENCE;
    }
    return !(inverted && clipped);
}

static void random_point(rng *r, double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = uniform(r, -2, 2);
}

static struct forest *new_forest(uint64_t seed)
{
    static struct forest f;
    struct brume_error err = {0};
    memset(&f, 0, sizeof f);
    f.scene = brume_scene_new(&err);
    f.random = rng_make(seed, 0, 0, 0);
    struct brume_material m = BRUME_MATERIAL_INIT;
    f.material = brume_add_material(f.scene, &m, &err);
    return &f;
}

static void test_csg__points(void **state)
{
    (void)state;
    int asked = 0;
    for (int tree = 0; tree < TREES; tree++) {
        struct forest *f = new_forest(100 + (uint64_t)tree);
        struct brume_error err = {0};
        int id = random_tree(f, 1 + tree % 9);
        for (int i = 0; plain(&f->told, id) && i < POINTS; i++) {
            double p[3], near = INFINITY;
            random_point(&f->random, p);
            bool truth = holds(&f->told, id, p, &near);
            if (near < 1e-9)
                continue;
            assert_int_equal(brume_inside(f->scene, id, p, &err), truth);
            asked++;
        }
        brume_scene_free(f->scene);
    }
    assert_true(asked > 3000);
}

/* Distances of the surfaces along a line, by one query after the other. */
static int query_hits(brume_scene *scene, int id, const double o[3],
                      const double d[3], double hit[HITS])
{
    struct brume_error err = {0};
    double from[3], p[3], n[3], travelled = 0;
    int count = 0;
    memcpy(from, o, sizeof from);
    while (count < HITS && brume_trace(scene, id, from, d, p, n, &err) == 1) {
        travelled += sqrt((p[0] - from[0]) * (p[0] - from[0]) +
                          (p[1] - from[1]) * (p[1] - from[1]) +
                          (p[2] - from[2]) * (p[2] - from[2]));
        hit[count++] = travelled;
        memcpy(from, p, sizeof from);
    }
    return count;
}

/* The same as rays find them when the scene is rendered. */
static int render_hits(const struct flat *flat, const double o[3],
                       const double d[3], double hit[HITS])
{
    double q[3];
    matrix_point(&flat->to_unit, o, q);
    vec3 at = vec3_make((float)q[0], (float)q[1], (float)q[2]);
    vec3 along = vec3_make((float)d[0], (float)d[1], (float)d[2]);
    bvh_ray r = bvh_ray_make(at, along);
    ray_hit h = hit_start(0.0f);
    int count = 0;
    for (;;) {
        ray_hit after = h;
        h = bvh_nearest(&flat->view, &r, &after, flat->view.far);
        if (h.shape < 0 || count == HITS)
            return count;
        if (h.seen)
            hit[count++] = (double)h.t / flat->unit;
    }
}

/* Whatever point of the line is asked about: it is inside if what the line
 * has crossed before says so. */
static void check_line(struct forest *f, int id, const double o[3],
                       const double d[3], const double *hit, int count,
                       double close)
{
    double near = INFINITY;
    bool first = holds(&f->told, id, o, &near);
    if (near < close)
        return;
    for (int i = 0; i < POINTS; i++) {
        double t = uniform(&f->random, 0, 8), p[3], least = INFINITY;
        int crossed = 0;
        for (int k = 0; k < 3; k++)
            p[k] = o[k] + t * d[k];
        while (crossed < count && hit[crossed] < t)
            crossed++;
        bool truth = holds(&f->told, id, p, &least);
        if (least > close && truth != (first != (crossed & 1)))
            fail_msg("tree %d: %d crossings before %g of (%g %g %g) along "
                     "(%g %g %g), inside %d then %d",
                     id, crossed, t, o[0], o[1], o[2], d[0], d[1], d[2], first,
                     truth);
    }
}

static void random_line(rng *r, double o[3], double d[3])
{
    double length;
    random_point(r, o);
    random_point(r, d);
    length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int i = 0; i < 3; i++)
        d[i] /= length;
}

static bool has_clips(const struct told *t)
{
    for (int i = 0; i < t->count; i++)
        if (t->shape[i].clip_count > 0)
            return true;
    return false;
}

static void test_csg__lines(void **state)
{
    (void)state;
    int crossings = 0;
    for (int tree = 0; tree < TREES; tree++) {
        struct forest *f = new_forest((uint64_t)tree);
        struct brume_error err = {0};
        int id = random_tree(f, 1 + tree % 9);
        double o[3], d[3], hit[HITS];
        struct prepare job = {.scene = f->scene};
        struct flat *flat = NULL;
        if (!has_clips(&f->told))
            flat = prepare_scene(&job, &err);
        for (int i = 0; flat && i < LINES; i++) {
            random_line(&f->random, o, d);
            int count = query_hits(f->scene, id, o, d, hit);
            check_line(f, id, o, d, hit, count, 2e-6);
            crossings += count;
            count = render_hits(flat, o, d, hit);
            check_line(f, id, o, d, hit, count, 3e-5);
        }
        flat_free(flat);
        brume_scene_free(f->scene);
    }
    assert_true(crossings > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_csg__points),
        cmocka_unit_test(test_csg__lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
