/* test_build_solid.c - shapes by numbers and groups of objects, as text. */
#include "tests/unit/scene_text.h"

static void quadrics(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "torus { 2, -.5 }\n"
        "quadric { <1,2,3>, <4,5,6>, <7,8,9>, 10 }\n"
        "poly { 2, <1,2,3,4,5,6,7,8,9,10> sturm }\n"
        "cubic { <1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20> }\n"
        "superellipsoid { <.25, .5> }\n");
    assert_int_equal(s->shapes, 5);
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_TORUS);
    NUMBERS(&s->shape[0].radius, 2, .5);
    assert_int_equal(s->shape[1].kind, BRUME_SHAPE_QUADRIC);
    NUMBERS(s->list[1].data, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10);
    assert_int_equal(s->shape[2].order, 2);
    assert_int_equal(s->shape[2].count, 10);
    assert_int_equal(s->shape[3].order, 3);
    assert_int_equal(s->shape[3].count, 20);
    NUMBERS(s->shape[4].a, .25, .5);
    expect_error("poly { 2, <1,2,3> }", BRUME_ERR_SCENE, 1, 11,
                 "a vector of 10 terms here, not 3");
    expect_error("poly { 36, <1,2,3> }", BRUME_ERR_SCENE, 1, 8, "2 to 35");
    expect_error("quadric { <1,2,3>, <1,2,3>, <1,2,3> }", BRUME_ERR_SCENE, 1,
                 37, "needs its constant");
    expect_error("quartic { 5 }", BRUME_ERR_SCENE, 1, 11, "35 terms");
}

/* The numbers are those of poly's x^2, xy, xz, x, y^2, yz, y, z^2, z and 1. */
static void polynomials(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "polynomial { 2, xyz(2,0,0):1, xyz(0,2,0):2 xyz(0,0,2):3,\n"
        "  xyz(0,0,0):-4 sturm }\n"
        "polynomial { 2, xyz(1,1,0):1 xyz(1,0,1):2 xyz(1,0,0):3\n"
        "  xyz(0,1.9,0):9 xyz(0,1,1):4 xyz(0,1,0):1+4 xyz(0,0,1):6 }\n"
        "polynomial { 4, xyz(4,0,0):1, xyz(2,2,0):2, xyz(2,0,2):2,\n"
        "  xyz(2,0,0):-104, xyz(0,4,0):1, xyz(0,2,2):2, xyz(0,2,0):56,\n"
        "  xyz(0,0,4):1, xyz(0,0,2):-104, xyz(0,0,0):784 }\n"
        "polynomial { 2, xyz(2,0,0):1, xyz(2,0,0):7 scale 2 }\n");
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_POLY);
    assert_int_equal(s->shape[0].order, 2);
    assert_int_equal(s->shape[0].count, 10);
    NUMBERS(s->list[0].data, 1, 0, 0, 0, 2, 0, 0, 3, 0, -4);
    NUMBERS(s->list[1].data, 0, 1, 2, 3, 0, 4, 5, 0, 6, 0);
    /* The torus of the manual, 3.4.5.3.2. */
    NUMBERS(s->list[2].data, 1, 0, 0, 0, 2, 0, 0, 2, 0, -104, 0, 0, 0, 0, 0, 0,
            0, 0, 0, 0, 1, 0, 0, 2, 0, 56, 0, 0, 0, 0, 1, 0, -104, 0, 784);
    NUMBERS(s->list[3].data, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    expect_error("polynomial { 2, xyz(2,1,0):1 }", BRUME_ERR_SCENE, 1, 17,
                 "order 3, not of 2");
    expect_error("polynomial { 2, xyz(-1,0,0):1 }", BRUME_ERR_SCENE, 1, 17,
                 "three powers");
    expect_error("polynomial { xyz(1,0,0):1 }", BRUME_ERR_SCENE, 1, 14,
                 "behind the order");
    expect_error("polynomial { 36 }", BRUME_ERR_SCENE, 1, 14, "2 to 35");
}

static void fractals(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "julia_fractal { <1,2,3,4> hypercomplex pwr(5, 6) max_iteration 9\n"
        "  precision 30 slice <0,1,0,0>, 7 }\n"
        "julia_fractal { <1,2,3,4> cube }\n");
    assert_int_equal(s->shape[0].julia_kind, BRUME_JULIA_HYPERCOMPLEX);
    assert_int_equal(s->shape[0].julia_function, BRUME_JULIA_PWR);
    assert_int_equal(s->shape[0].order, 9);
    NUMBERS(&s->shape[0].accuracy, 30);
    NUMBERS(s->list[0].data, 1, 2, 3, 4, 0, 1, 0, 0, 7, 5, 6);
    assert_int_equal(s->shape[1].julia_function, BRUME_JULIA_CUBE);
    NUMBERS(s->list[1].data, 1, 2, 3, 4, 0, 0, 0, 1, 0, 0, 0);
    assert_int_equal(s->shape[1].order, 20);
}

static void curves(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "lathe { bezier_spline 4, <1,2>, <3,4>, <5,6>, <7,8> }\n"
        "prism { conic_sweep linear_spline 1, 2, 3 <1,2> <3,4> <1,2> open }\n"
        "sor { 4, <1,2> <3,4> <5,6> <7,8> }\n"
        "sphere_sweep { b_spline 2, <1,2,3>, 4, <5,6,7>, 8 tolerance .1 }\n"
        "polygon { 3, <1,2>, <3,4,5>, <1,2> }\n"
        "bicubic_patch { type 1 u_steps 2 v_steps 3 flatness .5\n"
        "  0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, <15,16,17> }\n");
    assert_int_equal(s->shape[0].curve, BRUME_CURVE_BEZIER);
    NUMBERS(s->list[0].data, 1, 2, 3, 4, 5, 6, 7, 8);
    assert_true(s->shape[1].conic && s->shape[1].open);
    NUMBERS(&s->shape[1].radius, 1, 2);
    NUMBERS(s->list[1].data, 1, 2, 3, 4, 1, 2);
    assert_int_equal(s->shape[2].count, 8);
    assert_int_equal(s->shape[3].curve, BRUME_CURVE_B_SPLINE);
    NUMBERS(&s->shape[3].accuracy, .1);
    NUMBERS(s->list[3].data, 1, 2, 3, 4, 5, 6, 7, 8);
    NUMBERS(s->list[4].data, 1, 2, 0, 3, 4, 5, 1, 2, 0);
    assert_int_equal(s->shape[5].count, 48);
    assert_int_equal(s->shape[5].steps[1], 3);
    NUMBERS(s->list[5].data + 45, 15, 16, 17);
    expect_error("lathe { 3, <1,2>, <3,4> }", BRUME_ERR_SCENE, 1, 25,
                 "announces 3 points but has 2");
    expect_error("sphere_sweep { linear_spline 2, <1,2,3>, 4, <5,6,7> }",
                 BRUME_ERR_SCENE, 1, 53, "no radius");
    expect_error("lathe { x }", BRUME_ERR_SCENE, 1, 9, "begins with 1 float");
}

static void blobs(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "blob { threshold .5 sphere { <1,2,3>, 4, strength 5 scale 2 }\n"
        "  cylinder { <1,2,3>, <4,5,6>, 7, 8 } component 9, 10, <11,12,13> }");
    const double *d = s->list[0].data;
    NUMBERS(&s->shape[0].radius, .5);
    assert_int_equal(s->shape[0].count, 3 * BRUME_BLOB_NUMBERS);
    NUMBERS(d, 0, 5, 4, 1, 2, 3, 0, 0, 0, 2, 0, 0, 0, 0, 2);
    d += BRUME_BLOB_NUMBERS;
    NUMBERS(d, 1, 8, 7, 1, 2, 3, 4, 5, 6, 1, 0, 0, 0, 0, 1);
    d += BRUME_BLOB_NUMBERS;
    NUMBERS(d, 0, 9, 10, 11, 12, 13);
    expect_error("blob { threshold 1 }", BRUME_ERR_SCENE, 1, 20,
                 "no components");
}

/* Parts come before the group, placed in the world. */
static void groups(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "difference { sphere { 0, 1 translate x }\n"
        "  intersection { box { 0, 1 } sphere { 0, 0 } }\n"
        "  merge { box { 0, 1 } box { 0, 1 } } scale 2 inverse no_shadow }\n");
    assert_int_equal(s->shapes, 6);
    assert_true(s->shape[0].part && s->shape[4].part && !s->shape[5].part);
    NUMBERS(s->shape[0].transform[0], 2, 0, 0, 2);
    assert_int_equal(s->shape[4].kind, BRUME_SHAPE_MERGE);
    assert_int_equal(s->list[4].parts[0], 2);
    assert_int_equal(s->list[4].parts[1], 3);
    assert_int_equal(s->shape[5].kind, BRUME_SHAPE_DIFFERENCE);
    assert_int_equal(s->shape[5].part_count, 2);
    assert_int_equal(s->list[5].parts[1], 4);
    assert_true(s->shape[5].inverse && !s->shape[5].shadow);
    assert_true(s->shape[0].shadow == s->shape[5].shadow);
    /* Nothing is left of it. */
    s = scene("difference { sphere { 0, 0 } box { 0, 1 } }");
    assert_int_equal(s->shapes, 1);
    assert_true(s->shape[0].part);
}

/* A clip is where it was written, whatever came before it. */
static void clips(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "sphere { 0, 1 translate x clipped_by { plane { y, 0 } } scale 2 }\n"
        "union { box { 0, 1 } bounded_by { box { 0, 3 } }\n"
        "  clipped_by { bounded_by } translate y sphere { 0, 1 } }\n");
    assert_int_equal(s->shapes, 6);
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_PLANE);
    /* It moves with the sphere, so it is told where it is in its space. */
    NUMBERS(s->shape[0].transform[0], 1, 0, 0, -1);
    NUMBERS(s->shape[1].transform[0], 2, 0, 0, 2);
    assert_int_equal(s->shape[1].clip_count, 1);
    assert_int_equal(s->list[1].clips[0], 0);
    assert_int_equal(s->shape[5].kind, BRUME_SHAPE_UNION);
    assert_int_equal(s->shape[5].part_count, 2);
    assert_int_equal(s->list[5].clips[0], 4);
    NUMBERS(s->shape[2].transform[1], 0, 1, 0, 1);
    NUMBERS(s->shape[3].transform[1], 0, 1, 0, 0);
    expect_error("sphere { 0, 1 clipped_by { } }", BRUME_ERR_SCENE, 1, 28,
                 "needs an object");
}

static void what_pictures_lack(void **state)
{
    (void)state;
    expect_warning("#declare O = sphere { 0, 1 no_image }\n"
                   "light_group { light_source { 0, 1 } object { O } }\n"
                   "object { O no_reflection }\n",
                   2, 1,
                   "not drawn yet: light groups, no_image, "
                   "no_reflection");
    scene("#declare O = sphere { 0, 1 no_image }\n sphere { 0, 1 }");
    assert_null(first_of(DIAG_WARNING));
}

/* Colours under one finish are all that there is to draw of textures. */
static void textures_of_one_finish_lack_nothing(void **state)
{
    static const char *const plain[] = {
        "bozo texture_map { [0 pigment { rgb x }] [1 pigment { rgb y }] }",
        "checker texture { pigment { rgb x } finish { phong 1 } }"
        " texture { pigment { bozo } finish { phong 1 } }",
        "bozo texture_map { [0 pigment { rgb x }] [1 checker"
        " texture { pigment { rgb 0 } } texture { pigment { rgb 1 } }] }",
        "pigment { rgb x } } texture { pigment { rgbt <1, 1, 1, .5> }"};
    static const char *const varied[] = {
        "bozo texture_map { [0 pigment { rgb x }] [1 finish { phong 1 }] }",
        "bozo texture_map { [0 pigment { rgb x }] [1 normal { bumps }] }",
        "bozo texture_map { [0 pigment { rgb x }] [1 checker"
        " texture { pigment { rgb 0 } } texture { finish { ambient 1 } }] }"};
    char text[400];
    (void)state;

    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++) {
        snprintf(text, sizeof text, "sphere { 0, 1 texture { %s } }", plain[i]);
        scene(text);
        assert_null(first_of(DIAG_WARNING));
    }
    for (size_t i = 0; i < sizeof varied / sizeof *varied; i++) {
        snprintf(text, sizeof text, "sphere { 0, 1 texture { %s } }",
                 varied[i]);
        expect_warning(text, 1, 1, "finishes and normals by patterns");
    }
    expect_warning("sphere { 0, 1 texture { pigment { rgb x } finish { phong 1"
                   " } } texture { pigment { rgbt 1 } finish { phong 1 } } }",
                   1, 1, "the finishes of lower layers");
}

static void texts(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "ovus { 2, 1 }\n"
        "text { ttf \"timrom.ttf\" \"I !\" .5, <.1, 0> scale 2 }\n");
    assert_int_equal(s->shapes, 2);
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_OVUS);
    NUMBERS(&s->shape[0].radius, 2, 1);
    assert_int_equal(s->shape[1].kind, BRUME_SHAPE_TEXT);
    NUMBERS(&s->shape[1].radius, .5);
    assert_true(s->shape[1].transform[1][1] == 2);
    /* An I with serifs, and two glyphs' worth of an exclamation mark. */
    size_t segments = (size_t)s->list[1].data[0];
    assert_true(segments >= 12 && s->shape[1].count > 2 + 8 * segments);
    expect_error("text { scale 2 }", BRUME_ERR_SCENE, 1, 16,
                 "a text needs its 'ttf'");
    expect_error("text { ttf 1, \"I\", 1, 0 }", BRUME_ERR_SCENE, 1, 8,
                 "'ttf' needs a font, a text, a thickness and an offset");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts),
        cmocka_unit_test(quadrics),
        cmocka_unit_test(polynomials),
        cmocka_unit_test(fractals),
        cmocka_unit_test(curves),
        cmocka_unit_test(blobs),
        cmocka_unit_test(groups),
        cmocka_unit_test(clips),
        cmocka_unit_test(what_pictures_lack),
        cmocka_unit_test(textures_of_one_finish_lack_nothing),
    };

    return cmocka_run_group_tests_name("build_solid", tests, NULL,
                                       forget_scene);
}
