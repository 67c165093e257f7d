/* test_triangle.c - no ray slips between the triangles of a closed mesh; the
 * distance and weights of a hit are right. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include "core/physics/rng.h"
#include "core/physics/triangle.h"
#include "core/physics/warp.h"

/* A ball of irregular triangles: a grid of angles, its corners moved. */
enum { RINGS = 7, SECTORS = 9, FACES = 2 * SECTORS * (RINGS - 1) };

struct ball {
    vec3 corner[RINGS + 1][SECTORS];
    vec3 face[FACES][3];
    int faces;
};

static void add_face(struct ball *b, vec3 p, vec3 q, vec3 r)
{
    b->face[b->faces][0] = p;
    b->face[b->faces][1] = q;
    b->face[b->faces++][2] = r;
}

static void make_ball(struct ball *b, float size, vec3 centre)
{
    rng r = rng_make(1, 0, 0, 0);
    for (int i = 0; i <= RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            bool pole = i == 0 || i == RINGS;
            float polar = FM_PI * (float)i / RINGS, around = (float)j;
            around += pole ? 0.0f : 0.8f * rng_float(&r);
            vec3 w = warp_around_z(fm_cos(polar), pole ? 0.0f : fm_sin(polar),
                                   around / SECTORS);
            float radius = pole ? 1.0f : 0.7f + 0.6f * rng_float(&r);
            b->corner[i][j] = vec3_mad(centre, size * radius, w);
        }
    b->faces = 0;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            vec3 *above = b->corner[i], *below = b->corner[i + 1];
            int k = (j + 1) % SECTORS;
            if (i > 0)
                add_face(b, above[j], below[j], above[k]);
            if (i < RINGS - 1)
                add_face(b, above[k], below[j], below[k]);
        }
}

/* Triangles hit before and behind the ray's origin. */
static void count_hits(const struct ball *b, vec3 o, vec3 d, int *ahead,
                       int *behind)
{
    triangle_ray ray = triangle_ray_make(d);
    *ahead = *behind = 0;
    for (int i = 0; i < b->faces; i++) {
        const vec3 *p = b->face[i];
        float t, u, v;
        if (triangle_hit(&ray, o, p[0], p[1], p[2], &t, &u, &v)) {
            *ahead += t > 0.0f;
            *behind += t < 0.0f;
        }
    }
}

/* A point of a random edge; every fourth time, one of its corners. */
static vec3 edge_point(const struct ball *b, rng *r)
{
    uint32_t draw = rng_u32(r);
    const vec3 *p = b->face[draw % (uint32_t)b->faces];
    int side = (int)(draw >> 16) % 3;
    float along = (draw >> 24) % 4u ? rng_float(r) : 0.0f;
    vec3 edge = vec3_sub(p[(side + 1) % 3], p[side]);
    return vec3_mad(p[side], along, edge);
}

/* From inside, each way out is through the mesh. */
static void check_tight(float size, vec3 centre, int count)
{
    struct ball b;
    rng r = rng_make(2, 0, 0, 0);
    make_ball(&b, size, centre);
    for (int i = 0; i < count; i++) {
        vec3 w = warp_sphere(rng_float(&r), rng_float(&r));
        vec3 o = vec3_mad(centre, 0.2f * size * rng_float(&r), w);
        vec3 d = vec3_sub(edge_point(&b, &r), o);
        int ahead, behind;
        count_hits(&b, o, d, &ahead, &behind);
        if (ahead < 1 || behind < 1)
            fail_msg("leak from (%a %a %a) along (%a %a %a)", o.x, o.y, o.z,
                     d.x, d.y, d.z);
    }
}

static void test_triangle__no_leaks(void **state)
{
    (void)state;
    check_tight(1.0f, vec3_make(0, 0, 0), 200000);
    check_tight(1e-3f, vec3_make(1.0f, -2.0f, 0.5f), 100000);
    check_tight(1e6f, vec3_make(3e6f, 0, -1e6f), 100000);
}

/* Corners on whole numbers and rays along axes and diagonals: edge functions
 * that are exactly 0. */
static void test_triangle__exact_edges(void **state)
{
    (void)state;
    vec3 p[4] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    for (int i = 0; i < 9 * 25; i++) {
        vec3 o = vec3_make((float)(i % 3 - 1), (float)(i / 3 % 3 - 1), 0);
        vec3 at = vec3_make(0.5f * (float)(i / 9 % 5 - 2),
                            0.5f * (float)(i / 45 - 2), 1);
        triangle_ray ray = triangle_ray_make(vec3_sub(at, o));
        float t, u, v;
        bool first = triangle_hit(&ray, o, p[0], p[1], p[2], &t, &u, &v);
        bool second = triangle_hit(&ray, o, p[0], p[2], p[3], &t, &u, &v);
        assert_true(first || second);
        assert_true(fabsf(t - 1.0f) < 1e-6f);
    }
}

/* Aimed at a point of known weights, from any side and distance. */
static void test_triangle__distance_and_weights(void **state)
{
    (void)state;
    rng r = rng_make(3, 0, 0, 0);
    for (int i = 0; i < 300000; i++) {
        vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = warp_sphere(rng_float(&r), rng_float(&r));
        vec3 e = vec3_sub(p[1], p[0]), f = vec3_sub(p[2], p[0]);
        vec3 n = vec3_cross(e, f);
        float u0 = 0.1f + 0.4f * rng_float(&r);
        float v0 = 0.1f + 0.3f * rng_float(&r);
        vec3 at = vec3_mad(vec3_mad(p[0], u0, e), v0, f);
        vec3 d = warp_sphere(rng_float(&r), rng_float(&r));
        float steep = fabsf(vec3_dot(n, d)), t, u, v;
        if (steep < 0.02f)
            continue;
        triangle_ray ray = triangle_ray_make(d);
        vec3 o = vec3_mad(at, -5.0f, d);
        assert_true(triangle_hit(&ray, o, p[0], p[1], p[2], &t, &u, &v));
        assert_true(fabsf(t - 5.0f) < 5e-6f / steep);
        assert_true(fabsf(u - u0) < 5e-6f / steep);
        assert_true(fabsf(v - v0) < 5e-6f / steep);
    }
}

static void test_triangle__misses(void **state)
{
    (void)state;
    const vec3 p[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const vec3 out[4] = {
        {0.51f, 0.51f, 0}, {-0.01f, 0.5f, 0}, {0.5f, -0.01f, 0}, {2, 2, 0}};
    float t, u, v;
    for (int i = 0; i < 4; i++) {
        vec3 o = vec3_make(0.3f, 0.2f, 2.0f), d = vec3_sub(out[i], o);
        triangle_ray ray = triangle_ray_make(d);
        assert_false(triangle_hit(&ray, o, p[0], p[1], p[2], &t, &u, &v));
    }
    /* In the plane, and a triangle without area. */
    triangle_ray flat = triangle_ray_make(vec3_make(1, 0, 0));
    triangle_ray down = triangle_ray_make(vec3_make(0, 0, -1));
    vec3 o = vec3_make(0.25f, 0.25f, 0), high = vec3_make(0.25f, 0, 1);
    assert_false(triangle_hit(&flat, o, p[0], p[1], p[2], &t, &u, &v));
    assert_false(triangle_hit(&down, high, p[0], p[1], p[1], &t, &u, &v));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_triangle__no_leaks),
        cmocka_unit_test(test_triangle__exact_edges),
        cmocka_unit_test(test_triangle__distance_and_weights),
        cmocka_unit_test(test_triangle__misses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
