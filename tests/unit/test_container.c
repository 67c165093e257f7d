/* test_container.c - composites and solids as containers of media: a ray
 * through their middle loses what its chord in them says, exp(-sigma chord),
 * from outside, from within, small, large and far away. */
#include "truth.h"
#include <string.h>
#include "core/physics/scene.h"

#define SIGMA 0.7

struct built {
    brume_scene *scene;
    double size; /* of everything                               */
};

static struct brume_shape shape(const struct built *b,
                                enum brume_shape_kind kind, double radius)
{
    struct brume_shape s = BRUME_SHAPE_INIT;
    s.kind = kind;
    s.radius = radius;
    s.part = true;
    for (int i = 0; i < 3; i++)
        s.transform[i][i] = b->size;
    return s;
}

static int add(const struct built *b, struct brume_shape s)
{
    int id = brume_add_shape(b->scene, &s, truth_error());
    assert_true(id >= 0);
    return id;
}

static int add_ball(const struct built *b, double z, double radius)
{
    struct brume_shape s = shape(b, BRUME_SHAPE_SPHERE, radius);
    s.a[2] = z;
    return add(b, s);
}

static int add_box(const struct built *b, double z0, double z1)
{
    struct brume_shape s = shape(b, BRUME_SHAPE_BOX, 0);
    s.a[0] = s.a[1] = -1;
    s.b[0] = s.b[1] = 1;
    s.a[2] = z0;
    s.b[2] = z1;
    return add(b, s);
}

static struct brume_shape compose(enum brume_shape_kind kind, int *parts, int n)
{
    struct brume_shape s = BRUME_SHAPE_INIT;
    s.kind = kind;
    s.parts = parts;
    s.part_count = (size_t)n;
    return s;
}

/* ---- containers along the z axis, and their chord ------------------------ */

static struct brume_shape hollow_ball(const struct built *b, int *parts)
{
    parts[0] = add_ball(b, 0, 1);
    parts[1] = add_ball(b, 0, 0.5);
    return compose(BRUME_SHAPE_DIFFERENCE, parts, 2);
}

static struct brume_shape two_balls(const struct built *b, int *parts)
{
    parts[0] = add_ball(b, -0.3, 0.6);
    parts[1] = add_ball(b, 0.3, 0.6);
    return compose(BRUME_SHAPE_MERGE, parts, 2);
}

static struct brume_shape lens(const struct built *b, int *parts)
{
    parts[0] = add_ball(b, -0.3, 0.6);
    parts[1] = add_ball(b, 0.3, 0.6);
    return compose(BRUME_SHAPE_INTERSECTION, parts, 2);
}

/* Two holes, one of them with something in it. */
static struct brume_shape nested(const struct built *b, int *parts)
{
    int inner[2] = {add_box(b, 0.2, 0.8), add_ball(b, 0.5, 0.1)};
    struct brume_shape hole = compose(BRUME_SHAPE_DIFFERENCE, inner, 2);
    hole.part = true;
    parts[0] = add_ball(b, 0, 1);
    parts[1] = add_ball(b, -0.5, 0.2);
    parts[2] = add(b, hole);
    return compose(BRUME_SHAPE_DIFFERENCE, parts, 3);
}

static struct brume_shape half_space(const struct built *b, int *parts)
{
    struct brume_shape plane = shape(b, BRUME_SHAPE_PLANE, 0.25);
    plane.a[2] = 1;
    parts[0] = add_ball(b, 0, 1);
    parts[1] = add(b, plane);
    return compose(BRUME_SHAPE_INTERSECTION, parts, 2);
}

static struct brume_shape clipped(const struct built *b, int *parts)
{
    struct brume_shape s = shape(b, BRUME_SHAPE_SPHERE, 1);
    /* A clip moves with what it clips, which is as large as it already. */
    struct brume_shape clip = shape(b, BRUME_SHAPE_BOX, 0);
    memcpy(clip.transform, (const double[3][4])BRUME_IDENTITY,
           sizeof clip.transform);
    clip.a[0] = clip.a[1] = -2;
    clip.b[0] = clip.b[1] = clip.b[2] = 2;
    clip.a[2] = -0.25;
    parts[0] = add(b, clip);
    s.clips = parts;
    s.clip_count = 1;
    s.part = false;
    return s;
}

static struct brume_shape open_tube(const struct built *b, int *parts)
{
    struct brume_shape s = shape(b, BRUME_SHAPE_CYLINDER, 0.5);
    s.a[2] = -0.5;
    s.b[2] = 0.75;
    s.open = true;
    s.part = false;
    (void)parts;
    return s;
}

/* Along the axis of z, through both sides of the ring. */
static struct brume_shape ring(const struct built *b, int *parts)
{
    struct brume_shape s = shape(b, BRUME_SHAPE_TORUS, 0.75);
    s.radius_b = 0.25;
    s.part = false;
    (void)parts;
    return s;
}

static const struct {
    const char *name;
    struct brume_shape (*make)(const struct built *b, int *parts);
    double chord, from_middle; /* and of the half from z = 0 on            */
} containers[] = {
    {"hollow ball", hollow_ball, 1, 0.5},
    {"two balls", two_balls, 1.8, 0.9},
    {"lens", lens, 0.6, 0.3},
    {"nested", nested, 1.2, 0.6},
    {"half space", half_space, 1.25, 0.25},
    {"clipped", clipped, 1.25, 1},
    {"open tube", open_tube, 1.25, 0.75},
    {"ring", ring, 1, 0.5},
};
enum { CONTAINERS = sizeof containers / sizeof *containers };

/* From z = -distance, through a thousandth of the container. */
static double opacity_of(int which, double size, double distance)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    double window = 1e-3 / fmax(distance / size, 10);
    struct built b = {truth_scene(&globals, distance, window), size};
    struct brume_medium m = truth_medium(SIGMA / size, 0, 0);
    int parts[4];
    if (distance > 0)
        m.emission[0] = m.emission[1] = m.emission[2] = SIGMA / size;
    truth_fill(b.scene, containers[which].make(&b, parts), &m);
    struct estimate e = truth_render(b.scene, 4, 4);
    /* Emission that equals absorption shines as the medium covers. */
    if (distance > 0)
        assert_true(fabs(e.mean[1] - e.opacity) < 1e-4 * e.opacity);
    return e.opacity;
}

static void check(int which, double size, double distance, double chord,
                  double most)
{
    double truth = 1 - exp(-SIGMA * chord);
    double found = opacity_of(which, size, distance);
    if (!(fabs(found - truth) <= most * truth))
        fail_msg("%s, size %g from %g: opacity %.9g, not %.9g",
                 containers[which].name, size, distance, found, truth);
}

static void test_container__chords(void **state)
{
    (void)state;
    for (int i = 0; i < CONTAINERS; i++) {
        check(i, 1, 10, containers[i].chord, 1e-5);
        check(i, 1, 0, containers[i].from_middle, 1e-5);
    }
}

static void test_container__scales(void **state)
{
    (void)state;
    for (int i = 0; i < CONTAINERS; i++) {
        check(i, 1e-3, 1e-2, containers[i].chord, 1e-5);
        check(i, 1e6, 1e7, containers[i].chord, 1e-5);
        /* Distances in float are good to some 1e-7 of themselves. */
        check(i, 1, 1e3, containers[i].chord, 1e-3);
        check(i, 1, 1e4, containers[i].chord, 1e-2);
    }
}

/* What a narrow window shows of a container, on whose face the eye is. */
static double from_face(struct brume_shape container, double eye,
                        enum brume_camera_kind kind)
{
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    brume_scene *s = truth_scene(&globals, -eye, 1e-4);
    struct brume_camera c = BRUME_CAMERA_INIT;
    c.kind = kind;
    c.location[2] = eye;
    c.right[0] = c.up[1] = 1e-4;
    if (kind == BRUME_CAMERA_ORTHOGRAPHIC)
        c.right[0] = c.up[1] = 1e-4 * fabs(eye);
    struct brume_medium m = truth_medium(SIGMA / fabs(eye), 0, 0);
    assert_true(brume_set_camera(s, &c, truth_error()));
    truth_fill(s, container, &m);
    return truth_render(s, 4, 4).opacity;
}

/* At the front it sees all of the medium, at the back nothing. */
static void test_container__face(void **state)
{
    (void)state;
    const enum brume_camera_kind kinds[2] = {BRUME_CAMERA_PERSPECTIVE,
                                             BRUME_CAMERA_ORTHOGRAPHIC};
    const double sizes[4] = {1, 0.3, 1e-3, 12345};
    double truth = 1 - exp(-2 * SIGMA);
    for (int i = 0; i < 8; i++) {
        double size = sizes[i / 2];
        struct brume_shape ball = BRUME_SHAPE_INIT;
        ball.kind = BRUME_SHAPE_SPHERE;
        ball.radius = size;
        double box = from_face(truth_box(size, -size, size), -size,
                               kinds[i % 2]);
        double sphere = from_face(ball, -size, kinds[i % 2]);
        double behind = from_face(truth_box(size, -2 * size, -size), -size,
                                  kinds[i % 2]);
        if (!(fabs(box - truth) < 1e-4 && fabs(sphere - truth) < 1e-4))
            fail_msg("size %g: opacities %g and %g, not %g", size, box, sphere,
                     truth);
        assert_true(behind == 0);
    }
}

/* Boxes in boxes, each with its medium: all count, up to the limit. */
static void test_container__overlapping(void **state)
{
    (void)state;
    for (int count = 9; count <= MAX_ACTIVE + 1; count += 4) {
        struct brume_globals globals = BRUME_GLOBALS_INIT;
        brume_scene *s = truth_scene(&globals, 3, 1e-4);
        for (int i = 0; i < count; i++) {
            struct brume_medium m = truth_medium(0.01 * (i + 1), 0, 0);
            double half = 1 + 0.01 * i;
            truth_fill(s, truth_box(half, -half, half), &m);
        }
        struct estimate e = truth_render(s, 2, 4);
        double tau = 0;
        for (int i = 0; i < count; i++)
            tau += 0.01 * (i + 1) * 2 * (1 + 0.01 * i);
        bool all = fabs(e.opacity + expm1(-tau)) < 1e-5;
        assert_true(all == (count <= MAX_ACTIVE));
        assert_true(all == (e.stats.overflow == 0));
    }
}

/* Grains in a row, the last ones in the way: a tree finds them. */
static void test_container__many_parts(void **state)
{
    (void)state;
    enum { GRAINS = 20000 };
    static int grains[GRAINS];
    struct brume_globals globals = BRUME_GLOBALS_INIT;
    struct built b = {truth_scene(&globals, 10, 1e-4), 1};
    struct brume_medium m = truth_medium(SIGMA, 0, 0);
    for (int i = 0; i < GRAINS; i++) {
        struct brume_shape s = shape(&b, BRUME_SHAPE_SPHERE, 0.05);
        int turn = i % 9;
        s.a[0] = turn == 0 ? 0 : 0.1 * turn;
        s.a[2] = -0.9 + 1.8 * i / GRAINS;
        s.a[1] = turn == 0 ? 0 : 0.3;
        grains[i] = add(&b, s);
    }
    struct brume_shape all = compose(BRUME_SHAPE_UNION, grains, GRAINS);
    all.part = true;
    int parts[2] = {add_ball(&b, 0, 1), add(&b, all)};
    truth_fill(b.scene, compose(BRUME_SHAPE_DIFFERENCE, parts, 2), &m);
    struct estimate e = truth_render(b.scene, 4, 4);
    /* Grains on the axis lie from -0.95 to 0.95 less a step of 9. */
    double chord = 2 - (1.8 * (GRAINS - 2) / GRAINS + 0.1);
    double truth = 1 - exp(-SIGMA * chord);
    if (!(fabs(e.opacity - truth) < 1e-4))
        fail_msg("opacity %.9g, not %.9g", e.opacity, truth);
}

/* A ball less (a ball less (...)): its shells are inside in turn. */
static void test_container__deep(void **state)
{
    (void)state;
    enum { DEPTH = 20000 };
    struct brume_error err = {0};
    struct built b = {brume_scene_new(&err), 1};
    int last = add_ball(&b, 0, 1);
    for (int i = 1; i < DEPTH; i++) {
        int parts[2] = {add_ball(&b, 0, 1 + i), last};
        struct brume_shape s = compose(BRUME_SHAPE_DIFFERENCE, parts, 2);
        s.part = true;
        last = add(&b, s);
    }
    for (int i = 0; i < 40; i++) {
        int shell = i < 20 ? i : DEPTH - 40 + i;
        double p[3] = {shell + 0.5, 0, 0};
        int truth = (DEPTH - 1 - shell) % 2 == 0;
        assert_int_equal(brume_inside(b.scene, last, p, &err), truth);
    }
    brume_scene_free(b.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_container__chords),
        cmocka_unit_test(test_container__scales),
        cmocka_unit_test(test_container__face),
        cmocka_unit_test(test_container__overlapping),
        cmocka_unit_test(test_container__many_parts),
        cmocka_unit_test(test_container__deep),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
