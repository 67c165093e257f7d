/* BVH and kd-tree find what a loop over all triangles finds, in its order. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#include "core/order.h"
#include "core/plan.h"
#include "core/prepare.h"
#include "core/still.h"
#include "tests/unit/tree_meshes.h"

static const char spot[] = "scenes/campfire/spot.ply";

enum { SCENES = 6 };

/* The same mesh in all ways; the first has no tree. */
struct scenes {
    struct flat *flat[SCENES];
};

static struct scenes make_scenes(const struct triangles *t)
{
    static const enum tree tree[] = {TREE_NONE, TREE_BVH, TREE_KD,
                                     TREE_KD,   TREE_KD,  TREE_BOTH};
    static const int stack[] = {1, 1, 1, 4, KD_MAX_STACK, 3};
    struct scenes s;
    for (int i = 0; i < SCENES; i++) {
        struct brume_error err = {0};
        s.flat[i] = tree_scene(t, tree[i], stack[i], &err);
        assert_non_null(s.flat[i]);
    }
    return s;
}

static void free_scenes(struct scenes *s)
{
    for (int i = 0; i < SCENES; i++)
        flat_free(s->flat[i]);
}

static ray_hit nearest_of_all(const flat_scene *s, const bvh_ray *r,
                              const ray_hit *after)
{
    ray_hit best = hit_none(INFINITY);
    best.key = 0;
    for (uint64_t i = 0; i < s->triangles_count; i++)
        item_hit_triangle(s, r, i, after, &best);
    return best;
}

/* Follows rays through up to `deep` hits in every scene from `first` on. */
static void compare(const struct triangles *t, int first, uint64_t rays,
                    int deep)
{
    struct scenes s = make_scenes(t);
    uint64_t hits = 0;
    for (uint64_t i = 0; i < rays; i++) {
        bvh_ray r = tree_ray(t, i);
        ray_hit after = hit_start(0.0f);
        for (int k = 0; k < deep; k++) {
            ray_hit want = first == 0
                               ? nearest_of_all(&s.flat[0]->view, &r, &after)
                               : bvh_nearest(&s.flat[1]->view, &r, &after,
                                             INFINITY);
            for (int n = 1; n < SCENES; n++) {
                ray_hit got = bvh_nearest(&s.flat[n]->view, &r, &after,
                                          INFINITY);
                if (!same_hit(&got, &want))
                    fail_msg("scene %d, ray %d, hit %d: t %.9g of triangle "
                             "%d, not %.9g of %d",
                             n, (int)i, k, (double)got.t, (int)got.triangle,
                             (double)want.t, (int)want.triangle);
            }
            if (want.shape < 0)
                break;
            after = want;
            hits++;
        }
    }
    assert_true(hits > rays / 2);
    free_scenes(&s);
}

static struct triangles load(void)
{
    struct triangles t = {NULL, 0};
    struct brume_error err = {0};
    assert_true(triangles_load(&t, spot, &err));
    assert_int_equal(t.count, 5856);
    return t;
}

static void test_trees__all_triangles(void **state)
{
    (void)state;
    struct triangles t = load();
    compare(&t, 0, 480, 4);
    free(t.corner);
}

static void test_trees__degenerate(void **state)
{
    (void)state;
    struct triangles t = triangles_degenerate(1000);
    compare(&t, 0, 1600, 6);
    free(t.corner);
}

static void test_trees__divided(void **state)
{
    (void)state;
    struct triangles t = load(), four = triangles_divide(&t);
    compare(&four, 1, 8000, 4);
    free(t.corner);
    free(four.corner);
}

static void test_trees__few(void **state)
{
    (void)state;
    for (size_t n = 1; n < 6; n++) {
        struct triangles t = {NULL, 0};
        for (size_t i = 0; i < n; i++)
            triangles_add(&t, vec3_make(0, 0, 0), vec3_make(0.4f, 0, 0),
                          vec3_make(0, 0.4f, 0.1f * (float)(i / 2)));
        struct scenes s = make_scenes(&t);
        for (uint64_t i = 0; i < 64; i++) {
            bvh_ray r = tree_ray(&t, i);
            ray_hit after = hit_start(0.0f);
            ray_hit want = nearest_of_all(&s.flat[0]->view, &r, &after);
            for (int k = 1; k < SCENES; k++) {
                ray_hit got = bvh_nearest(&s.flat[k]->view, &r, &after,
                                          INFINITY);
                assert_true(same_hit(&got, &want));
            }
        }
        free_scenes(&s);
        free(t.corner);
    }
}

/* Nothing in it, or not reached within t_max. */
static void test_trees__nothing(void **state)
{
    (void)state;
    struct triangles t = {NULL, 0};
    ray_hit after = hit_start(0.0f);
    bvh_ray r = bvh_ray_make(vec3_make(0, 0, -1), vec3_make(0, 0, 1));
    for (int n = 0; n < 2; n++) {
        struct scenes s = make_scenes(&t);
        for (int k = 1; k < SCENES; k++)
            assert_int_equal(
                bvh_nearest(&s.flat[k]->view, &r, &after, n ? 0.5f : INFINITY)
                    .shape,
                -1);
        free_scenes(&s);
        triangles_add(&t, vec3_make(-1, -1, 0), vec3_make(1, -1, 0),
                      vec3_make(0, 1, 0));
    }
    free(t.corner);
}

/* A tree of which a leaf holds all would do all of the above. */
static void test_trees__kd_divides(void **state)
{
    (void)state;
    struct triangles t = load();
    struct brume_error err = {0};
    struct flat *f = tree_scene(&t, TREE_KD, 4, &err);
    uint32_t most = 0;
    assert_true(f->kd_items_count < 8 * t.count);
    for (size_t i = 0; i < f->kd_count; i++)
        if (f->kd[i].kind >= KD_LEAF && f->kd[i].kind - KD_LEAF > most)
            most = f->kd[i].kind - KD_LEAF;
    assert_in_range(most, 1, 64);
    flat_free(f);
    free(t.corner);
}

/* ---- a film ------------------------------------------------------------- */

/* A frame of a mesh of which the triangles from `moving` on are shifted. */
static struct flat *film_frame(struct brume_still *still, struct triangles *t,
                               size_t moving, float shift)
{
    struct brume_error err = {0};
    struct flat *f = tree_scene(t, TREE_NONE, 1, &err);
    struct bvh_item *item = malloc(t->count * sizeof *item);
    for (size_t i = 0; i < t->count; i++) {
        for (int k = 0; i >= moving && k < 3; k++)
            f->triangles[i].p[k].x += shift;
        item[i] = triangle_bounds(f->triangles[i].p, (uint32_t)(1 + i));
    }
    assert_true(still_build(still, f, item, t->count, 4, &err));
    f->view.bvh_root = f->bvh_count > 0 ? 0 : -1;
    flat_view(f);
    free(item);
    return f;
}

static void assert_finds_all(const struct flat *f, const struct triangles *t)
{
    for (uint64_t i = 0; i < 200; i++) {
        bvh_ray r = tree_ray(t, i);
        ray_hit after = hit_start(0.0f);
        ray_hit want = nearest_of_all(&f->view, &r, &after);
        ray_hit got = bvh_nearest(&f->view, &r, &after, INFINITY);
        assert_true(same_hit(&got, &want));
    }
}

/* Of frame after frame: what is in the kd-tree, how often it was built. */
static void test_still__film(void **state)
{
    static const struct {
        float shift;
        size_t moving, nodes; /* triangles; 0: no kd-tree            */
        int builds;
    } frame[] = {{0.0f, 800, 0, 0}, {0.1f, 800, 1, 1}, {0.2f, 800, 1, 1},
                 {0.3f, 400, 1, 2}, {0.4f, 400, 1, 2}, {0.4f, 400, 1, 3},
                 {0.4f, 400, 1, 3}};
    (void)state;
    struct brume_error err = {0};
    struct brume_still *still = brume_still_new(&err);
    struct triangles t = triangles_degenerate(1000);
    for (size_t i = 0; i < sizeof frame / sizeof *frame; i++) {
        struct flat *f = film_frame(still, &t, frame[i].moving, frame[i].shift);
        assert_int_equal(f->kd_count > 0, frame[i].nodes);
        assert_int_equal(still->builds, frame[i].builds);
        assert_finds_all(f, &t);
        flat_free(f);
    }
    brume_still_free(still);
    free(t.corner);
}

/* The BVH of a film in which nothing moves is built once, and once more for
 * each frame in which something did. */
static void test_still__bvh(void **state)
{
    static const float shift[] = {0.0f, 0.0f, 0.0f, 0.1f, 0.1f, 0.0f};
    static const int builds[] = {1, 1, 1, 2, 2, 3};
    (void)state;
    struct brume_error err = {0};
    struct brume_still *still = brume_still_new(&err);
    struct triangles t = triangles_degenerate(1000);
    struct bvh_item *item = malloc(t.count * sizeof *item);
    for (int i = 0; i < 6; i++) {
        struct flat *f = tree_scene(&t, TREE_NONE, 1, &err);
        for (size_t k = 0; k < t.count; k++) {
            f->triangles[k].p[0].x += k == 500 ? shift[i] : 0.0f;
            item[k] = triangle_bounds(f->triangles[k].p, (uint32_t)(1 + k));
        }
        assert_true(still_bvh(still, f, item, t.count, UINT64_MAX,
                              BVH_STACK - 1, &err));
        assert_int_equal(still->bvh_builds, builds[i]);
        f->view.bvh_root = 0;
        flat_view(f);
        assert_finds_all(f, &t);
        flat_free(f);
    }
    free(item);
    brume_still_free(still);
    free(t.corner);
}

/* A mesh twice, one of them turned and moved from frame to frame, among
 * spheres, and inside of a difference. */
static brume_scene *mesh_scene(struct mesh *mesh, double t)
{
    struct brume_error err = {0};
    brume_scene *scene = brume_scene_new(&err);
    struct brume_material paint = BRUME_MATERIAL_INIT;
    memset(paint.ambient, 0, sizeof paint.ambient);
    struct brume_shape shape = BRUME_SHAPE_INIT;
    int id = brume_share_mesh(scene, mesh, &err);
    const double turned[3][4] = {{cos(t), -sin(t), 0.3 * t, t},
                                 {sin(t), cos(t), 0, 0.2 * t},
                                 {0, 0.1, 1 + t, -0.3 * t}};
    shape.material = brume_add_material(scene, &paint, &err);
    for (int i = 0; i < 40; i++) {
        shape.radius = 0.05;
        for (int k = 0; k < 3; k++)
            shape.a[k] = sin(1.0 + 3 * i + k);
        assert_true(brume_add_shape(scene, &shape, &err) >= 0);
    }
    shape.kind = BRUME_SHAPE_MESH;
    shape.mesh = id;
    shape.a[0] = shape.a[2] = 0;
    shape.a[1] = 1;
    assert_true(brume_add_shape(scene, &shape, &err) >= 0);
    memcpy(shape.transform, turned, sizeof turned);
    shape.part = true;
    int parts[2] = {brume_add_shape(scene, &shape, &err), 0};
    struct brume_shape ball = BRUME_SHAPE_INIT;
    ball.radius = 0.4;
    ball.part = true;
    parts[1] = brume_add_shape(scene, &ball, &err);
    struct brume_shape cut = BRUME_SHAPE_INIT;
    cut.kind = BRUME_SHAPE_DIFFERENCE;
    cut.material = shape.material;
    cut.parts = parts;
    cut.part_count = 2;
    assert_true(brume_add_shape(scene, &cut, &err) >= 0);
    return scene;
}

static void assert_same_hits(const struct flat *f, const struct flat *plain)
{
    uint64_t hits = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        rng random = rng_make(7, 0, 0, i);
        float u = rng_float(&random), v = rng_float(&random);
        vec3 o = warp_sphere(u, v);
        u = rng_float(&random);
        v = rng_float(&random);
        vec3 d = vec3_scale(warp_sphere(u, v), 0.5f);
        bvh_ray r = bvh_ray_make(o, vec3_normalize(vec3_sub(d, o)));
        ray_hit after = hit_start(0.0f);
        for (int k = 0; k < 4; k++) {
            ray_hit want = bvh_nearest(&plain->view, &r, &after, INFINITY);
            ray_hit got = bvh_nearest(&f->view, &r, &after, INFINITY);
            assert_true(same_hit(&got, &want));
            if (want.shape < 0)
                break;
            after = want;
            hits += want.triangle >= 0;
        }
    }
    assert_true(hits > 300);
}

/* Its tree is built once, wherever the mesh goes, and finds what a tree finds
 * that is built anew; another mesh gets another. */
static void test_still__meshes(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct brume_still *still = brume_still_new(&err);
    struct mesh *mesh = ply_load(spot, &err);
    for (int i = 0; i < 5; i++) {
        if (i == 3)
            mesh->position[0][0] += 0.1;
        brume_scene *scene = mesh_scene(mesh, i == 1 ? 0.0 : 0.4 * i);
        struct prepare with = {.scene = scene, .still = still};
        struct prepare without = {.scene = scene};
        struct flat *f = prepare_scene(&with, &err);
        struct flat *plain = prepare_scene(&without, &err);
        assert_non_null(f);
        assert_non_null(plain);
        assert_same_hits(f, plain);
        assert_int_equal(still->tree_builds, i < 3 ? 1 : 2);
        flat_free(f);
        flat_free(plain);
        brume_scene_free(scene);
        /* As a file does that is read again. */
        struct mesh *copy = mesh_copy(mesh, &err);
        mesh_free(mesh);
        mesh = copy;
    }
    mesh_free(mesh);
    brume_still_free(still);
}

/* A tree is not left to a backend where births of photons look for surfaces. */
static void test_order__photons(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct mesh *mesh = ply_load(spot, &err);
    struct brume_options o = BRUME_OPTIONS_INIT;
    for (int i = 0; i < 8; i++) {
        bool photons = i & 1, glows = i & 2, walls = i & 4;
        brume_scene *scene = mesh_scene(mesh, 0.4);
        struct brume_globals g = BRUME_GLOBALS_INIT;
        struct brume_medium m = BRUME_MEDIUM_INIT;
        struct brume_material seen = BRUME_MATERIAL_INIT;
        struct brume_shape air = BRUME_SHAPE_INIT, plane = BRUME_SHAPE_INIT;
        struct brume_light l = BRUME_LIGHT_INIT;
        g.media_multiple = true;
        assert_true(brume_set_globals(scene, &g, &err));
        l.location[1] = 10.0;
        assert_true(brume_add_light(scene, &l, &err) >= 0);
        for (int k = 0; k < 3; k++)
            m.scattering[k] = 1.0;
        for (int k = 0; k < 3; k++)
            seen.emission[k] = glows ? 1.0f : 0.0f;
        memset(seen.ambient, 0, sizeof seen.ambient);
        int medium = brume_add_medium(scene, &m, &err);
        air.kind = BRUME_SHAPE_SPHERE;
        air.radius = 0.1;
        air.hollow = true;
        air.interior = brume_add_interior(scene, &medium, 1, &err);
        air.material = -1;
        assert_true(brume_add_shape(scene, &air, &err) >= 0);
        if (glows || walls) {
            plane.kind = walls ? BRUME_SHAPE_PLANE : BRUME_SHAPE_SPHERE;
            plane.radius = 0.1;
            plane.material = brume_add_material(scene, &seen, &err);
            assert_true(brume_add_shape(scene, &plane, &err) >= 0);
        }
        o.integrator = photons ? BRUME_INTEGRATOR_PHOTON
                               : BRUME_INTEGRATOR_PATH;
        struct prepare with = {
            .scene = scene, .later = true, .traced = photons};
        struct flat *f = prepare_scene(&with, &err);
        assert_non_null(f);
        assert_true(plan_layout(f, &o, &err));
        bool here = photons && (glows || walls);
        assert_int_equal(order_count(f) == 0, here);
        assert_int_equal(f->view.bvh_root >= 0, here);
        flat_free(f);
        brume_scene_free(scene);
    }
    mesh_free(mesh);
}

/* A tree that was left to a backend that builds none. */
static void test_order__build(void **state)
{
    (void)state;
    static const enum brume_tree tree[] = {BRUME_TREE_BVH, BRUME_TREE_KD};
    struct brume_error err = {0};
    struct mesh *mesh = ply_load(spot, &err);
    brume_scene *scene = mesh_scene(mesh, 0.4);
    struct prepare with = {.scene = scene, .tree_stack = 4};
    struct flat *plain = prepare_scene(&with, &err);
    assert_non_null(plain);
    assert_int_equal(order_count(plain), 0);
    with.later = true;
    for (int i = 0; i < 2; i++) {
        with.tree = tree[i];
        struct flat *f = prepare_scene(&with, &err);
        assert_non_null(f);
        assert_int_equal(order_count(f), 40 + 2 * mesh->triangles);
        assert_int_equal(f->view.bvh_root, -1);
        assert_true(order_bytes(f) > 40 * order_count(f));
        assert_true(order_build(f, &err));
        assert_int_equal(order_count(f), 0);
        assert_int_equal(f->kd_count > 0, i);
        assert_same_hits(f, plain);
        flat_free(f);
    }
    with.tree = BRUME_TREE_BOTH;
    struct flat *both = prepare_scene(&with, &err);
    assert_int_equal(order_count(both), 0);
    flat_free(both);
    flat_free(plain);
    brume_scene_free(scene);
    mesh_free(mesh);
}

/* Things that came and went give the others other numbers. */
static void test_still__renumbered(void **state)
{
    (void)state;
    struct brume_error err = {0};
    struct brume_still *still = brume_still_new(&err);
    struct triangles t = triangles_degenerate(600);
    for (int i = 0; i < 4; i++) {
        struct triangles part = {t.corner + (i == 2 ? 100 : 0),
                                 i == 3 ? 500 : 600 - (i == 2 ? 100 : 0)};
        struct flat *f = film_frame(still, &part, 600, 0.0f);
        assert_finds_all(f, &part);
        flat_free(f);
    }
    brume_still_free(still);
    free(t.corner);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trees__all_triangles),
        cmocka_unit_test(test_trees__degenerate),
        cmocka_unit_test(test_trees__divided),
        cmocka_unit_test(test_trees__few),
        cmocka_unit_test(test_trees__nothing),
        cmocka_unit_test(test_trees__kd_divides),
        cmocka_unit_test(test_still__film),
        cmocka_unit_test(test_still__bvh),
        cmocka_unit_test(test_still__meshes),
        cmocka_unit_test(test_still__renumbered),
        cmocka_unit_test(test_order__build),
        cmocka_unit_test(test_order__photons),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
