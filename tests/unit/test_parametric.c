/* test_parametric.c - meshes of parametric surfaces: places, areas, normals
 * and what containers leave of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <math.h>
#include <string.h>
#include "core/surfaces.h"

/* The manual's sphere. */
static void sphere(void *context, double u, double v, double p[3])
{
    int *calls = context;

    if (calls)
        ++*calls;
    p[0] = sin(u) * cos(v);
    p[1] = sin(u) * sin(v);
    p[2] = cos(u);
}

static void half_sphere(void *context, double u, double v, double p[3])
{
    sphere(context, u, v, p);
    if (v > M_PI)
        p[1] = NAN;
}

static void flat(void *context, double u, double v, double p[3])
{
    (void)context;
    p[0] = u;
    p[1] = v;
    p[2] = 0;
}

static const double whole[4] = {0, 0, M_PI, 2 * M_PI};

static struct brume_shape shape_of(const double range[4], double accuracy)
{
    struct brume_shape s = BRUME_SHAPE_INIT;

    s.kind = BRUME_SHAPE_PARAMETRIC;
    s.data = range;
    s.count = 4;
    s.accuracy = accuracy;
    s.contained = BRUME_CONTAINED_SPHERE;
    s.radius = 1.1;
    return s;
}

static double corner_area(const struct mesh *m, const uint32_t c[3],
                          double cross[3])
{
    double a[3], b[3];

    for (int i = 0; i < 3; i++) {
        a[i] = m->position[c[1]][i] - m->position[c[0]][i];
        b[i] = m->position[c[2]][i] - m->position[c[0]][i];
    }
    for (int i = 0; i < 3; i++)
        cross[i] = a[(i + 1) % 3] * b[(i + 2) % 3] -
                   a[(i + 2) % 3] * b[(i + 1) % 3];
    return sqrt(cross[0] * cross[0] + cross[1] * cross[1] +
                cross[2] * cross[2]) /
           2;
}

static double area_of(const struct mesh *m)
{
    double sum = 0, cross[3];

    for (size_t i = 0; i < m->triangles; i++)
        sum += corner_area(m, m->corner[i], cross);
    return sum;
}

static struct mesh *make(const struct brume_shape *s, surface_point *point)
{
    struct brume_error err = {0};
    struct mesh *m = surface_parametric(s, point, NULL, &err);

    if (!m)
        fail_msg("%s", err.text);
    assert_true(mesh_check(m, NULL));
    return m;
}

/* Corners on the sphere, the middles of triangles as near as was asked for,
 * normals outward as du x dv is, also at the poles. */
static void test_parametric__sphere(void **state)
{
    (void)state;
    for (double accuracy = 0.01; accuracy > 1e-5; accuracy /= 10) {
        struct brume_shape s = shape_of(whole, accuracy);
        struct mesh *m = make(&s, sphere);
        assert_true(fabs(area_of(m) - 4 * M_PI) < 8 * M_PI * 4 * accuracy);
        for (size_t i = 0; i < m->vertices; i++) {
            const double *p = m->position[i];
            const float *n = m->normal[i];
            double r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            assert_true(fabs(r - 1) < 1e-12);
            assert_true(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > 0.999);
        }
        for (size_t i = 0; i < m->triangles; i++) {
            double middle[3] = {0, 0, 0}, r = 0;
            for (int k = 0; k < 9; k++)
                middle[k % 3] += m->position[m->corner[i][k / 3]][k % 3] / 3;
            for (int k = 0; k < 3; k++)
                r += middle[k] * middle[k];
            assert_true(sqrt(r) > 1 - 3 * accuracy && sqrt(r) <= 1);
        }
        mesh_free(m);
    }
}

/* Triangles turn as their normals point. */
static void test_parametric__turn(void **state)
{
    (void)state;
    struct brume_shape s = shape_of(whole, 0.01);
    struct mesh *m = make(&s, sphere);
    for (size_t i = 0; i < m->triangles; i++) {
        double cross[3], dot = 0;
        const float *n = m->normal[m->corner_normal[i][0]];
        double area = corner_area(m, m->corner[i], cross);
        for (int k = 0; k < 3; k++)
            dot += cross[k] * n[k];
        assert_true(dot >= 0 || area < 1e-12);
    }
    mesh_free(m);
}

/* What is left of the sphere in a box up to z = h, and of a square in a ball:
 * 2 pi (1 + h), pi r^2. */
static void test_parametric__container(void **state)
{
    (void)state;
    const double square[4] = {-1, -1, 1, 1};
    struct brume_shape s = shape_of(whole, 1e-4);
    s.contained = BRUME_CONTAINED_BOX;
    for (int i = 0; i < 3; i++) {
        s.a[i] = 1.5;
        s.b[i] = -1.5;
    }
    s.a[2] = 0.37;
    struct mesh *m = make(&s, sphere);
    assert_true(fabs(area_of(m) - 2 * M_PI * 1.37) < 0.005);
    for (size_t i = 0; i < m->vertices; i++)
        assert_true(m->position[i][2] <= 0.37);
    mesh_free(m);

    s = shape_of(square, 1e-4);
    s.a[0] = 0.1;
    s.radius = 0.7;
    m = make(&s, flat);
    assert_true(fabs(area_of(m) - M_PI * 0.49) < 0.02);
    mesh_free(m);

    s.a[2] = 5;
    m = make(&s, flat);
    assert_int_equal(m->triangles, 0);
    assert_int_equal(m->vertices, 0);
    mesh_free(m);
}

static void test_parametric__not_finite(void **state)
{
    (void)state;
    struct brume_shape s = shape_of(whole, 0.003);
    struct mesh *m = make(&s, half_sphere);
    assert_true(fabs(area_of(m) - 2 * M_PI) < 0.2);
    mesh_free(m);
}

/* Nothing bends: no lines are added. Nothing is fine enough: there is an end,
 * and it is not beyond 1025 lines along u and v. */
static void test_parametric__lines(void **state)
{
    (void)state;
    const double square[4] = {0.5, 0.5, -0.5, -0.5};
    struct brume_shape s = shape_of(square, 1e-9);
    struct mesh *m = make(&s, flat);
    assert_int_equal(m->triangles, 2 * 16 * 16);
    mesh_free(m);
    s = shape_of(whole, 1e-300);
    int calls = 0;
    m = surface_parametric(&s, sphere, &calls, NULL);
    assert_int_equal(m->triangles, 2 * 1024 * 1024);
    assert_in_range(calls, 1, 40000000);
    mesh_free(m);
}

static void refuse(const double range[4], double accuracy, const char *text)
{
    struct brume_error err = {0};
    struct brume_shape s = shape_of(range, accuracy);

    assert_null(surface_parametric(&s, flat, NULL, &err));
    assert_int_equal(err.code, BRUME_ERR_SCENE);
    assert_non_null(strstr(err.text, text));
}

static void test_parametric__refusals(void **state)
{
    (void)state;
    const double thin[4] = {0, 0, 0, 1}, endless[4] = {0, 0, INFINITY, 1};
    const double nan[4] = {0, NAN, 1, 1};
    refuse(whole, 0, "accuracy 0;");
    refuse(whole, NAN, "accuracy nan;");
    refuse(thin, 1, "from <0, 0> to <0, 1>");
    refuse(endless, 1, "to <inf, 1>");
    refuse(nan, 1, "from <0, nan>");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parametric__sphere),
        cmocka_unit_test(test_parametric__turn),
        cmocka_unit_test(test_parametric__container),
        cmocka_unit_test(test_parametric__not_finite),
        cmocka_unit_test(test_parametric__lines),
        cmocka_unit_test(test_parametric__refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
