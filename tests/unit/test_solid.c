/* test_solid.c - the further primitives against POV-Ray's trace, inside and
 * extents (tests/data/solids), against their own insides sampled finely, and
 * from afar. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "core/physics/rng.h"
#include "tests/unit/solids.h"

enum { ROOM = 256 };

/* One solid of a file, and where to look at it. */
struct subject {
    const struct solid_kind *kind;
    struct solid solid;
    char name[200];
    double size; /* half the longest side of its bounds, or 2    */
    dvec3 middle;
};

static dvec3 at(dvec3 o, double t, dvec3 d)
{
    return dvec3_mad(o, t, d);
}

static int roots_of(const struct subject *s, dvec3 o, dvec3 d, double *t,
                    int *part)
{
    int n = s->kind->roots(s->solid.data, o, d, t, part, ROOM);
    assert_in_range(n, 0, ROOM);
    for (int i = 1; i < n; i++)
        assert_true(t[i - 1] <= t[i]);
    return n;
}

/* Reads numbers up to the end of the line. */
static size_t numbers_of(const char *text, double *numbers, size_t room)
{
    size_t n = 0;
    char *end;

    for (;; text = end) {
        double x = strtod(text, &end);
        if (end == text)
            return n;
        assert_true(n < room);
        numbers[n++] = x;
    }
}

static void subject_measure(struct subject *s)
{
    s->size = 2;
    s->middle = dvec3_make(0, 0, 0);
    if (!s->solid.bounded)
        return;
    const double *a = s->solid.min, *b = s->solid.max;
    s->middle = dvec3_make((a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
                           (a[2] + b[2]) / 2);
    s->size = fmax(b[0] - a[0], fmax(b[1] - a[1], b[2] - a[2])) / 2;
}

static void subject_build(struct subject *s, struct arena *arena,
                          const struct solid_kind *kind, const char *text)
{
    static double numbers[20000];
    size_t count = numbers_of(text, numbers, 20000);
    struct brume_error err = {0};

    s->kind = kind;
    snprintf(s->name, sizeof s->name, "%s%.180s", kind->name, text);
    s->name[strcspn(s->name, "\n")] = '\0';
    if (!kind->build(arena, numbers, count, &s->solid, &err))
        fail_msg("%s: %s", s->name, err.text);
    subject_measure(s);
}

/* ---- what POV-Ray says */

/* POV-Ray passes by what is within this distance of a ray's origin. */
static const double AHEAD = 1e-5;

/* The first root ahead, past pairs that are a touch. */
static int first_root(const struct subject *s, const double *t, int count,
                      double length)
{
    int i = 0;

    while (i < count && t[i] * length < AHEAD)
        i++;
    while (i + 1 < count && (t[i + 1] - t[i]) * length < 1e-6 * s->size)
        i += 2;
    return i;
}

/* POV-Ray's root finders overlook some surfaces; where the inside, which is
 * compared with its own, turns, there is one. Ours may miss what is thin. */
static int overlooked, missed;

static bool turns(const struct subject *s, dvec3 p, dvec3 d)
{
    double step = 1e-6 * s->size / dvec3_length(d);
    return s->kind->inside(s->solid.data, at(p, -step, d)) !=
           s->kind->inside(s->solid.data, at(p, step, d));
}

static void check_trace(const struct subject *s, const char *text)
{
    double n[12], t[ROOM];
    int part[ROOM];
    size_t given = numbers_of(text, n, 12);
    dvec3 o = dvec3_make(n[0], n[1], n[2]), d = dvec3_make(n[3], n[4], n[5]);
    int count = roots_of(s, o, d, t, part);
    int first = first_root(s, t, count, dvec3_length(d));

    if (given == 6 && first == count)
        return;
    if (first == count && s->kind->thin) {
        missed++;
        return;
    }
    if (first == count)
        fail_msg("%s: no root along %s", s->name, text);
    dvec3 p = dvec3_make(n[6], n[7], n[8]);
    dvec3 mine = at(o, t[first], d);
    double off = given >= 9 ? dvec3_length(dvec3_sub(mine, p)) : INFINITY;
    if (given == 6 || dvec3_dot(dvec3_sub(p, mine), d) > s->size * 1e-3) {
        overlooked += turns(s, mine, d);
        if (turns(s, mine, d))
            return;
    }
    if (s->kind->thin && off > 0.1 * s->size) {
        missed++;
        return;
    }
    if (!(off < s->kind->tolerance * s->size))
        fail_msg("%s: %g off: %.9g %.9g %.9g along %s", s->name, off, mine.x,
                 mine.y, mine.z, text);
    if (given == 9)
        return;
    dvec3 normal = s->kind->normal(s->solid.data, mine, part[first]);
    dvec3 given_normal = dvec3_make(n[9], n[10], n[11]);
    double bend = dvec3_length(dvec3_cross(normal, given_normal)) /
                  dvec3_length(normal);
    if (!(bend < 1000 * s->kind->tolerance) ||
        (!s->kind->either && dvec3_dot(normal, given_normal) < 0))
        fail_msg("%s: normal %g off: %.9g %.9g %.9g along %s", s->name, bend,
                 normal.x, normal.y, normal.z, text);
}

static void check_inside(const struct subject *s, const char *text)
{
    double n[4];

    assert_int_equal(numbers_of(text, n, 4), 4);
    dvec3 p = dvec3_make(n[0], n[1], n[2]);
    if (s->kind->inside(s->solid.data, p) != (n[3] != 0))
        fail_msg("%s: inside %s", s->name, text);
}

/* Ours lie within POV-Ray's; that they hold the solid is tested below. */
static void check_bounds(const struct subject *s, const char *text)
{
    double n[6];

    assert_int_equal(numbers_of(text, n, 6), 6);
    if (!s->solid.bounded)
        return;
    for (int i = 0; i < 3; i++)
        if (s->solid.min[i] < n[i] - 1e-6 * s->size ||
            s->solid.max[i] > n[3 + i] + 1e-6 * s->size)
            fail_msg("%s: bounds %g to %g are beyond %s", s->name,
                     s->solid.min[i], s->solid.max[i], text);
}

static void check_line(const struct subject *s, const char *line)
{
    if (!strncmp(line, "trace ", 6))
        check_trace(s, line + 6);
    else if (!strncmp(line, "inside ", 7))
        check_inside(s, line + 7);
    else if (!strncmp(line, "bounds ", 7))
        check_bounds(s, line + 7);
    else
        assert_int_equal(line[0], '#');
}

/* Calls `each` with every line of every file, a solid's own line first. */
static void for_lines(void (*each)(const struct subject *s, const char *line))
{
    static char line[100000];
    struct arena arena;

    for (size_t k = 0; k < SOLID_KINDS; k++) {
        struct subject s = {0};
        snprintf(line, sizeof line, "tests/data/solids/%s.txt",
                 solid_kinds[k].name);
        FILE *file = fopen(line, "r");
        assert_non_null(file);
        arena_init(&arena, 0);
        while (fgets(line, sizeof line, file)) {
            size_t skip = 6 + strlen(solid_kinds[k].name);
            if (!strncmp(line, "solid ", 6))
                subject_build(&s, &arena, &solid_kinds[k], line + skip);
            each(&s, line);
        }
        fclose(file);
        arena_release(&arena);
    }
}

static void compare_line(const struct subject *s, const char *line)
{
    if (strncmp(line, "solid ", 6))
        check_line(s, line);
}

static void test_solid__as_povray(void **state)
{
    (void)state;
    overlooked = missed = 0;
    for_lines(compare_line);
    print_message("%d roots that POV-Ray overlooks, %d that we do\n",
                  overlooked, missed);
    assert_in_range(overlooked, 0, 10);
    assert_in_range(missed, 0, 10);
}

/* ---- what the insides say */

static dvec3 random_point(rng *r, const struct subject *s, double size)
{
    double u[3];

    for (int i = 0; i < 3; i++)
        u[i] = size * s->size * (2 * (double)rng_float(r) - 1);
    return dvec3_add(s->middle, dvec3_make(u[0], u[1], u[2]));
}

/* Between two roots in turn inside and outside; before and beyond all of a
 * bounded solid, outside. */
static void check_turns(const struct subject *s, dvec3 o, dvec3 d)
{
    double t[ROOM], length = dvec3_length(d);
    int part[ROOM], n = roots_of(s, o, d, t, part);

    if (s->solid.bounded)
        assert_int_equal(n % 2, 0);
    for (int i = 0; i + 1 < n; i++) {
        if ((t[i + 1] - t[i]) * length < 1e-6 * s->size)
            continue;
        dvec3 between = at(o, 0.5 * (t[i] + t[i + 1]), d);
        bool in = s->kind->inside(s->solid.data, between);
        dvec3 before = at(o, t[i] - 1e-7 * s->size / length, d);
        bool was = s->solid.bounded ? i % 2
                                    : s->kind->inside(s->solid.data, before);
        if (in == was)
            fail_msg("%s: root %d of %d, t = %.17g, does not part inside "
                     "from outside along %.17g %.17g %.17g, %.17g %.17g %.17g",
                     s->name, i, n, t[i], o.x, o.y, o.z, d.x, d.y, d.z);
    }
}

/* Samples of the inside along a line change just where there are roots. */
static void check_samples(const struct subject *s, dvec3 o, dvec3 d)
{
    enum { SAMPLES = 300 };
    double t[ROOM];
    int part[ROOM], n = roots_of(s, o, d, t, part), next = 0;
    bool was = s->kind->inside(s->solid.data, o);

    while (next < n && t[next] < 0)
        next++;
    for (int i = 1; i <= SAMPLES; i++) {
        double here = (double)i / SAMPLES;
        bool in = s->kind->inside(s->solid.data, at(o, here, d)), turned = was;
        bool close = false;
        for (; next < n && t[next] < here; next++)
            turned = !turned;
        for (int k = 0; k < n; k++)
            close |= fabs(t[k] - here) < 1e-9 ||
                     fabs(t[k] - here + 1.0 / SAMPLES) < 1e-9;
        if (in != turned && !close && s->kind->thin)
            missed++;
        else if (in != turned && !close)
            fail_msg("%s: inside turns and no root near t = %.17g along "
                     "%.17g %.17g %.17g, %.17g %.17g %.17g",
                     s->name, here, o.x, o.y, o.z, d.x, d.y, d.z);
        was = in;
    }
}

/* Roots lie in the bounds, and normals there point out; but for the branch
 * cuts of functions, which have none. */
static int seen, right;

static void check_surface(const struct subject *s, dvec3 o, dvec3 d)
{
    double t[ROOM], step = 1e-5 * s->size;
    int part[ROOM], n = roots_of(s, o, d, t, part);

    for (int i = 0; i < n; i++) {
        dvec3 p = at(o, t[i], d);
        dvec3 normal = s->kind->normal(s->solid.data, p, part[i]);
        double length = dvec3_length(normal);
        double across = fabs(dvec3_dot(normal, d)) / length / dvec3_length(d);
        const double c[3] = {p.x, p.y, p.z};
        for (int k = 0; s->solid.bounded && k < 3; k++)
            if (c[k] < s->solid.min[k] - 1e-9 * s->size ||
                c[k] > s->solid.max[k] + 1e-9 * s->size)
                fail_msg("%s: %.9g %.9g %.9g is out of bounds", s->name, p.x,
                         p.y, p.z);
        if (!(across > 0.1) || (i && (t[i] - t[i - 1]) * length < 9 * step) ||
            (i + 1 < n && (t[i + 1] - t[i]) * length < 9 * step))
            continue;
        if (!s->kind->inside(s->solid.data, at(p, step / length, normal)) &&
            s->kind->inside(s->solid.data, at(p, -step / length, normal)))
            right++;
        else if (!s->kind->thin)
            fail_msg("%s: normal %g %g %g of part %d at %.17g %.17g %.17g",
                     s->name, normal.x, normal.y, normal.z, part[i], p.x, p.y,
                     p.z);
        seen++;
    }
}

enum { LINES = 200 };

static void sample_solid(const struct subject *s, const char *line)
{
    rng r = rng_make(1, 0, 0, 0);

    if (strncmp(line, "solid ", 6))
        return;
    seen = right = missed = 0;
    for (int i = 0; i < LINES; i++) {
        dvec3 o = random_point(&r, s, 1.5);
        dvec3 d = dvec3_sub(random_point(&r, s, i % 2 ? 1.2 : 0.5), o);
        if (i % 16 == 1)
            d.x = 0;
        if (i % 16 == 3)
            d.y = d.z = 0;
        if (i % 16 == 5)
            d.x = d.z = 0;
        check_turns(s, o, d);
        check_samples(s, o, d);
        check_surface(s, o, d);
    }
    assert_in_range(missed, 0, 20); /* of 60 000 samples            */
    if (right < 0.7 * seen)
        fail_msg("%s: %d normals of %d are right", s->name, right, seen);
}

static void test_solid__roots_where_insides_turn(void **state)
{
    (void)state;
    for_lines(sample_solid);
}

/* ---- from afar, and what is no line */

/* As many roots from 10 000 sizes away as from near by, at the same points;
 * lines that graze may differ. */
static void look_from_afar(const struct subject *s, const char *line)
{
    rng r = rng_make(2, 0, 0, 0);
    double near[ROOM], far[ROOM];
    int part[ROOM], differ = 0;

    if (strncmp(line, "solid ", 6))
        return;
    for (int i = 0; i < LINES; i++) {
        dvec3 p = random_point(&r, s, 0.7);
        dvec3 d = dvec3_sub(random_point(&r, s, 0.7), p);
        d = dvec3_scale(d, 1 / dvec3_length(d));
        int n = roots_of(s, p, d, near, part);
        if (roots_of(s, at(p, -1e4 * s->size, d), d, far, part) != n) {
            differ++;
            continue;
        }
        for (int k = 0; k < n; k++) {
            dvec3 normal = s->kind->normal(s->solid.data, at(p, near[k], d),
                                           part[k]);
            double slope = fabs(dvec3_dot(normal, d)) / dvec3_length(normal);
            if (slope > 0.1 && fabs(near[k]) < 10 * s->size &&
                fabs(far[k] - near[k] - 1e4 * s->size) >
                    (s->kind->thin ? 1e-6 : 1e-9) * s->size)
                fail_msg("%s: root %d at %.17g, from afar at %.17g", s->name, k,
                         near[k], far[k] - 1e4 * s->size);
        }
    }
    if (differ > LINES / 50)
        fail_msg("%s: %d lines of %d differ from afar", s->name, differ, LINES);
}

static void test_solid__from_afar(void **state)
{
    (void)state;
    for_lines(look_from_afar);
}

static void look_along_nothing(const struct subject *s, const char *line)
{
    const double bad[] = {0, NAN, INFINITY, -INFINITY};
    double t[ROOM];
    int part[ROOM];

    if (strncmp(line, "solid ", 6))
        return;
    for (int i = 0; i < 4; i++) {
        dvec3 o = s->middle, d = dvec3_make(bad[i], bad[i], bad[i]);
        assert_int_equal(roots_of(s, o, d, t, part), 0);
        o.y = bad[i];
        d = dvec3_make(1, 1e-300, 0);
        int n = roots_of(s, o, d, t, part);
        assert_true(i == 0 || n == 0);
        s->kind->inside(s->solid.data, o);
        s->kind->normal(s->solid.data, o, 0);
    }
}

static void test_solid__no_line(void **state)
{
    (void)state;
    for_lines(look_along_nothing);
}

/* Less room gives the first roots; of closed solids, an even number. */
static void look_with_little_room(const struct subject *s, const char *line)
{
    rng r = rng_make(3, 0, 0, 0);
    double all[ROOM], few[ROOM];
    int part[ROOM];

    if (strncmp(line, "solid ", 6))
        return;
    for (int i = 0; i < LINES; i++) {
        dvec3 o = random_point(&r, s, 1.5);
        dvec3 d = dvec3_sub(random_point(&r, s, 0.7), o);
        int n = roots_of(s, o, d, all, part);
        for (int room = 0; room <= 4; room++) {
            few[room] = -7;
            int m = s->kind->roots(s->solid.data, o, d, few, part, room);
            int most = s->solid.bounded ? room & ~1 : room;
            assert_int_equal(m, n < most ? n : most);
            for (int k = 0; k < m; k++)
                assert_true(fabs(few[k] - all[k]) < 1e-9);
            assert_true(few[room] == -7);
        }
    }
}

static void test_solid__little_room(void **state)
{
    (void)state;
    for_lines(look_with_little_room);
}

/* Coefficients that only rounding leaves give no roots far away: of x^3 -
 * 27 y^3 + z along (3, 1, 0.1) there is but z. */
static void test_solid__poly_degree(void **state)
{
    (void)state;
    double c[20] = {0}, data[21] = {3}, t[3];
    int part[3];

    c[solid_poly_index(3, 3, 0, 0)] = 1;
    c[solid_poly_index(3, 0, 3, 0)] = -27;
    c[solid_poly_index(3, 0, 0, 1)] = 1;
    memcpy(data + 1, c, sizeof c);
    for (int i = 1; i <= 200; i++) {
        dvec3 d = dvec3_make(0.03 * i, 0.01 * i, 0.0001 * i);
        dvec3 o = dvec3_make(0, 0, -0.00005 * i);
        assert_int_equal(poly_roots(data, o, d, t, part, 3), 1);
        assert_true(fabs(t[0] - 0.5) < 1e-9);
    }
}

/* ---- without caps */

static int open_roots(const char *kind, const double *numbers, size_t count,
                      dvec3 o, dvec3 d)
{
    double t[ROOM];
    int part[ROOM], n = -1;
    struct arena arena;
    struct solid solid;

    arena_init(&arena, 0);
    for (size_t k = 0; k < SOLID_KINDS; k++)
        if (!strcmp(solid_kinds[k].name, kind)) {
            assert_true(
                solid_kinds[k].build(&arena, numbers, count, &solid, NULL));
            n = solid_kinds[k].roots(solid.data, o, d, t, part, ROOM);
        }
    arena_release(&arena);
    return n;
}

/* A tube, square or round: through both walls, one of them, none. */
static void test_solid__open(void **state)
{
    (void)state;
    const double prism[] = {0, 0, 1, 0, 1, -1, -1, 1, -1, 1, 1, -1, 1, -1, -1};
    const double sor[] = {1, 1, -1, 1, 0, 1, 1, 1, 2};
    const dvec3 o = dvec3_make(0.1, 0.5, 0.2);

    for (int i = 0; i < 2; i++) {
        const char *kind = i ? "sor" : "prism";
        const double *numbers = i ? sor : prism;
        size_t count = i ? 9 : 15;
        assert_int_equal(
            open_roots(kind, numbers, count, o, dvec3_make(1, 0, 0.1)), 2);
        assert_int_equal(
            open_roots(kind, numbers, count, o, dvec3_make(1, 0.4, 0)), 2);
        assert_int_equal(
            open_roots(kind, numbers, count, o, dvec3_make(1, 0.5, 0)), 1);
        assert_int_equal(
            open_roots(kind, numbers, count, o, dvec3_make(0, 1, 0)), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid__as_povray),
        cmocka_unit_test(test_solid__roots_where_insides_turn),
        cmocka_unit_test(test_solid__from_afar),
        cmocka_unit_test(test_solid__no_line),
        cmocka_unit_test(test_solid__little_room),
        cmocka_unit_test(test_solid__poly_degree),
        cmocka_unit_test(test_solid__open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
