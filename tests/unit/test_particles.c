#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include "core/brume.h"
#include "core/neighbors.h"

enum { MOST = 30000 };

static double at[3 * MOST], radius[MOST], mass[MOST], value[MOST];

static double uniform(void)
{
    static uint64_t state = 1;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

static struct grid *grid_of(const struct brume_particles *p)
{
    struct brume_error err = {0};
    struct grid *g = brume_particles_grid(p, &err);
    if (!g)
        fail_msg("%s", err.text);
    return g;
}

static double sum_of(const struct grid *g)
{
    double sum = 0, voxel = g->to_world[0][0];
    for (size_t i = 0; i < g->stored * GRID_BRICK_VOXELS; i++)
        sum += (double)g->voxel[i];
    return sum * voxel * voxel * voxel;
}

static struct brume_particles cloud(size_t count, double scale, double power)
{
    struct brume_particles p = BRUME_PARTICLES_INIT;
    p.count = count;
    p.at = at;
    for (size_t i = 0; i < count; i++) {
        double shrink = pow(uniform(), power);
        for (int a = 0; a < 3; a++)
            at[3 * i + (size_t)a] = scale * shrink * (uniform() - 0.5);
        mass[i] = uniform();
        radius[i] = scale * uniform() / 10;
        value[i] = 1000 + 1000 * uniform();
    }
    return p;
}

/* ---- mass ---- */

static void assert_kept(const struct brume_particles *p)
{
    double wanted = 0;
    for (size_t i = 0; i < p->count; i++)
        wanted += p->mass ? p->mass[i] : 1;
    struct grid *g = grid_of(p);
    double got = sum_of(g);
    if (!(fabs(got - wanted) <= 1e-6 * wanted))
        fail_msg("mass %.9g, wanted %.9g", got, wanted);
    assert_int_equal(g->points, p->count);
    grid_free(g);
}

static void test_particles__mass_is_kept(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-6, 1e9};
    for (int s = 0; s < 3; s++)
        for (int power = 0; power < 8; power += 3) {
            struct brume_particles p = cloud(2000, scales[s], power);
            assert_kept(&p);
            p.mass = mass;
            assert_kept(&p);
            p.radius = radius;
            assert_kept(&p);
            p.neighbors = 12;
            assert_kept(&p);
            p.voxel = scales[s] / 10; /* over most radii                  */
            assert_kept(&p);
        }
}

static void test_particles__mass_at_the_edges_of_bricks(void **state)
{
    (void)state;
    struct brume_particles p = cloud(500, 1, 0);
    p.voxel = 0.125;
    for (int i = 0; i < 1500; i++)
        at[i] = floor(40 * (uniform() - 0.5)) * (i % 2 ? 1 : 0.125 / 2);
    static const double radii[] = {0, 1e-9, 0.1, 0.125, 0.3, 1, 1.5};
    for (int i = 0; i < 7; i++) {
        p.radius = radius;
        for (int k = 0; k < 500; k++)
            radius[k] = radii[i];
        assert_kept(&p);
    }
}

static void test_particles__mass_of_one_and_of_many_at_one_place(void **state)
{
    (void)state;
    struct brume_particles p = cloud(MOST, 1, 0);
    for (int i = 0; i < 3 * MOST; i++)
        at[i] = 1e6 + i % 3;
    p.default_radius = 0.5;
    p.mass = mass;
    assert_kept(&p);
    p.count = 1;
    assert_kept(&p);
    p.voxel = 3;
    assert_kept(&p);
    /* Two places: nearest points at 0, and some at 1. */
    p = cloud(1000, 1, 0);
    for (int i = 0; i < 3000; i++)
        at[i] = i < 30 ? 0 : 1;
    assert_kept(&p);
}

static void test_particles__mass_of_any_size(void **state)
{
    (void)state;
    static const double sizes[] = {1e-30, 1e-12, 1e12, 1e30};
    struct brume_particles p = cloud(300, 1, 2);
    p.mass = mass;
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < 300; i++)
            mass[i] = sizes[s] * (1 + i % 2);
        assert_kept(&p);
    }
}

/* ---- shape ---- */

/* One ball: the kernel of brume.h, and along a line through its centre the
 * optical depth 9 m / (2 pi r^2). */
static void test_particles__one_ball(void **state)
{
    (void)state;
    struct brume_particles p = cloud(1, 0, 0);
    mass[0] = 3;
    p.mass = mass;
    p.default_radius = 2;
    p.voxel = 0.1;
    struct grid *g = grid_of(&p);
    double depth = 0;
    for (int x = -25; x <= 25; x++) {
        double q = 1 - x * x * 0.01 / 4;
        double wanted = q > 0 ? 3 * 315 / (64 * M_PI * 8) * q * q * q : 0;
        int i = x - (int)lround(g->to_world[0][3] / 0.1);
        int j = -(int)lround(g->to_world[1][3] / 0.1);
        int k = -(int)lround(g->to_world[2][3] / 0.1);
        assert_float_equal(grid_sample(g, i, j, k), wanted, 1e-5);
        depth += 0.1 * (double)grid_sample(g, i, j, k);
    }
    assert_float_equal(depth, 9 * 3 / (2 * M_PI * 4), 1e-5);
    assert_true(g->radius[0] == 2 && g->radius[1] == 2);
    assert_string_equal(g->name, "density");
    grid_free(g);
}

/* 27000 points, one at random in each cell of a cube of side 2: their density
 * away from the faces is 3375. */
static void test_particles__random_points_have_their_density(void **state)
{
    (void)state;
    struct brume_particles p = cloud(27000, 1, 0);
    for (int i = 0; i < 27000; i++) {
        int cell[3] = {i % 30, i / 30 % 30, i / 900};
        for (int a = 0; a < 3; a++)
            at[3 * i + a] = (cell[a] + uniform()) / 15 - 1;
    }
    struct grid *g = grid_of(&p);
    double sum = 0, voxel = g->to_world[0][0], squares = 0;
    int count = 0;
    for (int k = 0; k < 8 * g->bricks[2]; k++)
        for (int j = 0; j < 8 * g->bricks[1]; j++)
            for (int i = 0; i < 8 * g->bricks[0]; i++) {
                double far = fmax(fabs(i * voxel + g->to_world[0][3]),
                                  fmax(fabs(j * voxel + g->to_world[1][3]),
                                       fabs(k * voxel + g->to_world[2][3])));
                double d = (double)grid_sample(g, i, j, k) / 3375;
                sum += far < 0.7 ? d : 0;
                squares += far < 0.7 ? (d - 1) * (d - 1) : 0;
                count += far < 0.7 ? 1 : 0;
            }
    assert_true(count > 10000);
    assert_float_equal(sum / count, 1, 0.003);
    /* 32 neighbours by this kernel leave some 20 % of noise. */
    assert_true(sqrt(squares / count) < 0.25);
    grid_free(g);
}

static void assert_sum(const struct grid *sum, const struct grid *a,
                       const struct grid *b, double factor)
{
    double voxel = sum->to_world[0][0];
    const struct grid *part[2] = {a, b};
    for (int k = 0; k < 8 * sum->bricks[2]; k++)
        for (int j = 0; j < 8 * sum->bricks[1]; j++)
            for (int i = 0; i < 8 * sum->bricks[0]; i++) {
                double wanted = 0;
                for (int n = 0; n < 2 && part[n]; n++) {
                    int c[3] = {i, j, k};
                    for (int x = 0; x < 3; x++)
                        c[x] += (int)lround(
                            (sum->to_world[x][3] - part[n]->to_world[x][3]) /
                            voxel);
                    wanted += factor *
                              (double)grid_sample(part[n], c[0], c[1], c[2]);
                }
                assert_float_equal(grid_sample(sum, i, j, k), wanted,
                                   1e-6 * wanted + 1e-30);
            }
}

/* The density of two clouds is the sum of theirs, and that of a mass three
 * times as large three times as large. */
static void test_particles__density_is_linear(void **state)
{
    (void)state;
    struct brume_particles p = cloud(400, 1, 1);
    p.mass = mass;
    p.radius = radius;
    p.voxel = 0.05;
    struct grid *whole = grid_of(&p);
    p.count = 150;
    struct grid *a = grid_of(&p);
    p.count = 250;
    p.at += 3 * 150;
    p.mass += 150;
    p.radius += 150;
    struct grid *b = grid_of(&p);
    assert_sum(whole, a, b, 1);
    for (int i = 150; i < 400; i++)
        mass[i] *= 3;
    struct grid *c = grid_of(&p);
    assert_sum(c, b, NULL, 3);
    grid_free(c);
    grid_free(b);
    grid_free(a);
    grid_free(whole);
}

static void test_particles__values_are_means(void **state)
{
    (void)state;
    struct brume_particles p = cloud(3, 1, 0);
    static const double places[] = {0, 0, 0, 0, 0, 0, 9, 0, 0};
    memcpy(at, places, sizeof places);
    p.default_radius = 1;
    p.mass = mass;
    p.value = value;
    mass[0] = mass[2] = 1e-20;
    mass[1] = 3e-20;
    value[0] = 1000;
    value[1] = 2000;
    value[2] = 0.5;
    struct grid *g = grid_of(&p);
    size_t first = 0, second = 0;
    for (size_t i = 0; i < g->stored * GRID_BRICK_VOXELS; i++) {
        float v = g->voxel[i];
        assert_true(v == 0 || fabsf(v - 1750) < 1e-3f || v == 0.5f);
        first += v > 1 ? 1 : 0;
        second += v == 0.5f ? 1 : 0;
    }
    assert_int_equal(first, second);
    assert_true(first > 80);
    grid_free(g);
}

/* ---- radii ---- */

/* A cubic lattice of spacing 1/4: within 1/4 there are 6 others, within 1/4
 * of the root of 2 18 of them, and 32 within 1/2. */
static void test_particles__radii_follow_the_neighbours(void **state)
{
    (void)state;
    static const struct {
        int neighbors;
        double given, least;
    } cases[] = {
        {0, 0, 0.5},   {6, 0, 0.25},           {18, 0, M_SQRT2 / 4},
        {6, 0.3, 0.3}, {18, 0.3, M_SQRT2 / 4}, {0, 0.3, 0.3},
    };
    struct brume_particles p = cloud(1000, 1, 0);
    for (int i = 0; i < 1000; i++) {
        at[3 * i] = 0.25 * (i % 10);
        at[3 * i + 1] = 0.25 * (i / 10 % 10);
        at[3 * i + 2] = 0.25 * (i / 100);
    }
    for (int i = 0; i < 6; i++) {
        p.neighbors = cases[i].neighbors;
        p.default_radius = cases[i].given;
        struct grid *g = grid_of(&p);
        assert_float_equal(g->radius[0], cases[i].least, 1e-6);
        grid_free(g);
    }
    /* One far away is widened to 8 times the median at most. */
    at[0] = -1000;
    p.neighbors = 0;
    p.default_radius = 0;
    struct grid *g = grid_of(&p);
    assert_true(g->radius[1] < 5);
    assert_true(g->radius[1] > 4);
    grid_free(g);
}

static int by_size(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

/* Against all distances, sorted; also of points that coincide. */
static void test_particles__nearest_points_are_found(void **state)
{
    (void)state;
    enum { COUNT = 700 };
    static double got[COUNT], all[COUNT];
    static const int wanted[] = {1, 7, 32, COUNT - 1, 1000};
    for (int round = 0; round < 10; round++) {
        int k = wanted[round / 2];
        cloud(COUNT, 1, round);
        for (int i = 0; i < 3 * COUNT && round % 2; i++)
            at[i] = floor(at[i] * 6);
        assert_true(neighbors_distances(at, COUNT, k, 2, got, NULL));
        for (int i = 0; i < COUNT; i += 13) {
            size_t others = 0;
            for (int j = 0; j < COUNT; j++)
                if (j != i)
                    all[others++] = hypot(hypot(at[3 * i] - at[3 * j],
                                                at[3 * i + 1] - at[3 * j + 1]),
                                          at[3 * i + 2] - at[3 * j + 2]);
            qsort(all, others, sizeof *all, by_size);
            double least = all[k < COUNT ? k - 1 : COUNT - 2];
            assert_float_equal(got[i], least, 1e-12);
        }
    }
    assert_true(neighbors_distances(at, 1, 32, 1, got, NULL));
    assert_true(got[0] == 0);
}

static void test_particles__threads_do_not_matter(void **state)
{
    (void)state;
    struct brume_particles p = cloud(5000, 1, 2);
    p.mass = mass;
    p.threads = 1;
    struct grid *a = grid_of(&p);
    p.threads = 5;
    struct grid *b = grid_of(&p);
    assert_int_equal(a->stored, b->stored);
    assert_memory_equal(a->voxel, b->voxel,
                        a->stored * GRID_BRICK_VOXELS * sizeof(float));
    grid_free(b);
    grid_free(a);
}

/* ---- what is wrong ---- */

static void test_particles__bad_points_are_left_out_and_counted(void **state)
{
    (void)state;
    struct brume_particles p = cloud(200, 1, 0);
    p.mass = mass;
    p.radius = radius;
    p.value = value;
    p.voxel = 0.1;
    struct grid *clean = grid_of(&p);
    at[3 * 200] = NAN;
    at[3 * 201 + 1] = -INFINITY;
    radius[202] = NAN;
    radius[203] = -1;
    mass[204] = INFINITY;
    mass[205] = -1e-30;
    value[206] = -5;
    value[207] = INFINITY;
    mass[208] = 0;
    mass[207] = -1;
    p.count = 209;
    struct grid *g = grid_of(&p);
    assert_int_equal(g->bad_nan, 2);
    assert_int_equal(g->bad_inf, 3);
    assert_int_equal(g->bad_negative, 3);
    assert_int_equal(g->points, 200);
    assert_int_equal(g->stored, clean->stored);
    assert_memory_equal(g->voxel, clean->voxel,
                        g->stored * GRID_BRICK_VOXELS * sizeof(float));
    grid_free(g);
    grid_free(clean);
}

static void test_particles__none_make_an_empty_grid(void **state)
{
    (void)state;
    struct brume_particles p = cloud(2, 1, 0);
    p.mass = mass;
    mass[0] = 0;
    mass[1] = NAN;
    struct grid *g = grid_of(&p);
    assert_int_equal(g->points, 0);
    assert_int_equal(g->bad_nan, 1);
    assert_int_equal(g->stored, 0);
    assert_true(g->highest == 0);
    grid_free(g);
}

static void refused(const struct brume_particles *p, enum brume_code code,
                    const char *word)
{
    struct brume_error err = {0};
    assert_null(brume_particles_grid(p, &err));
    assert_int_equal(err.code, code);
    if (!strstr(err.text, word))
        fail_msg("no \"%s\" in: %s", word, err.text);
}

static void test_particles__refuses(void **state)
{
    (void)state;
    struct brume_particles p = cloud(10, 1, 0);
    p.count = 1;
    refused(&p, BRUME_ERR_SCENE, "there is only one; give a radius");
    p.count = 10;
    p.default_radius = -1;
    refused(&p, BRUME_ERR_SCENE, "radius of particles is -1");
    p.default_radius = 0;
    p.voxel = INFINITY;
    refused(&p, BRUME_ERR_SCENE, "their voxel inf");
    p.voxel = 1e-12;
    refused(&p, BRUME_ERR_LIMIT, "too large a grid");
    p.voxel = 0;
    p.neighbors = 1025;
    refused(&p, BRUME_ERR_SCENE, "neighbors of particles are 1025");
    p.neighbors = 0;
    p.mass = mass;
    mass[3] = 1e300;
    refused(&p, BRUME_ERR_SCENE, "beyond 3.40282e+38");
    p.mass = NULL;
    p.radius = radius;
    memset(radius, 0, sizeof radius);
    refused(&p, BRUME_ERR_SCENE, "their radii are 0");
    p.radius = NULL;
    at[4] = -1e200;
    refused(&p, BRUME_ERR_LIMIT, "coordinate -1e+200");
    for (int i = 0; i < 30; i++)
        at[i] = 7;
    refused(&p, BRUME_ERR_SCENE, "all are at one place");
}

/* Whatever lies how far from what, an answer, and soon. */
static void test_particles__wild_clouds_end(void **state)
{
    (void)state;
    struct brume_particles p = cloud(1000, 1, 0);
    p.radius = radius;
    for (int round = 0; round < 6; round++) {
        for (int i = 0; i < 1000; i++) {
            double e = round < 3 ? 8 : 90;
            for (int a = 0; a < 3; a++)
                at[3 * i + a] = (uniform() - 0.5) * pow(10, e * uniform());
            radius[i] = round % 3 == 0   ? pow(10, -e * uniform())
                        : round % 3 == 1 ? pow(10, e * uniform())
                                         : 1e-300;
        }
        if (round < 3)
            assert_kept(&p);
        else /* densities of so large voxels are 0 in a float             */
            grid_free(grid_of(&p));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_particles__mass_is_kept),
        cmocka_unit_test(test_particles__mass_at_the_edges_of_bricks),
        cmocka_unit_test(test_particles__mass_of_one_and_of_many_at_one_place),
        cmocka_unit_test(test_particles__mass_of_any_size),
        cmocka_unit_test(test_particles__one_ball),
        cmocka_unit_test(test_particles__random_points_have_their_density),
        cmocka_unit_test(test_particles__density_is_linear),
        cmocka_unit_test(test_particles__values_are_means),
        cmocka_unit_test(test_particles__radii_follow_the_neighbours),
        cmocka_unit_test(test_particles__nearest_points_are_found),
        cmocka_unit_test(test_particles__threads_do_not_matter),
        cmocka_unit_test(test_particles__bad_points_are_left_out_and_counted),
        cmocka_unit_test(test_particles__none_make_an_empty_grid),
        cmocka_unit_test(test_particles__refuses),
        cmocka_unit_test(test_particles__wild_clouds_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
