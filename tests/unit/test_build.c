/* test_build.c - view, objects, surfaces and settings of scenes as text. */
#include "tests/unit/scene_text.h"

/* ---- the view ---------------------------------------------------------- */

static void cameras(void **state)
{
    (void)state;
    const brume_scene *s = scene("");
    NUMBERS(s->camera.right, 1.33, 0, 0);
    NUMBERS(s->camera.direction, 0, 0, 1);
    s = scene("camera { orthographic location -z*3 up 2*y right 4*x "
              "sky y direction z scale 2 translate x }");
    assert_int_equal(s->camera.kind, BRUME_CAMERA_ORTHOGRAPHIC);
    NUMBERS(s->camera.location, 1, 0, -6);
    NUMBERS(s->camera.up, 0, 4, 0);
    s = scene("#declare C = camera { perspective location <0, 0, -4> "
              "angle 90 look_at 0 }\n"
              "camera { C rotate 90*y }\n");
    NUMBERS(s->camera.location, -4, 0, 0);
    NUMBERS(s->camera.direction, 0.665, 0, 0);
    expect_error("camera { angle 180 }", BRUME_ERR_SCENE, 1, 16,
                 "'angle' is 180, must be at least 0 and less than 180");
    expect_error("camera { look_at 0 }", BRUME_ERR_SCENE, 1, 1,
                 "the same point");
    expect_warning("camera { look_at y }", 1, 1, "along its sky");
}

static void lights(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "light_source { <1, 2, 3>, rgb <4, 5, 6> }\n"
        "#declare L = light_source { 0 color 1 spotlight radius 10\n"
        "  falloff 20 tightness 3 point_at -y fade_distance 5 fade_power 2\n"
        "  shadowless media_interaction off media_attenuation on }\n"
        "light_source { L translate 2*x }\n"
        "union { object { L } light_source { L scale 2 } rotate 90*z }\n");
    assert_int_equal(s->lights, 4);
    const struct brume_light *l = &s->light[0];
    assert_int_equal(l->kind, BRUME_LIGHT_POINT);
    NUMBERS(l->location, 1, 2, 3);
    NUMBERS(l->color, 4, 5, 6);
    assert_true(l->shadows && l->media_interaction && !l->media_attenuation);
    l = &s->light[1];
    assert_int_equal(l->kind, BRUME_LIGHT_SPOT);
    NUMBERS(l->location, 2, 0, 0);
    NUMBERS(l->point_at, 2, -1, 0);
    NUMBERS(&l->radius, 10, 20, 3, 5, 2);
    assert_true(!l->shadows && !l->media_interaction && l->media_attenuation);
    NUMBERS(s->light[2].point_at, 1, 0, 0);
    NUMBERS(s->light[3].point_at, 2, 0, 0);
    s = scene("light_source { 0, 1 spotlight radius -30 falloff 100 }");
    NUMBERS(&s->light[0].radius, 30, 90);
    expect_error("light_source { 0 }", BRUME_ERR_SCENE, 1, 18,
                 "'light_source' needs its color");
    expect_error("light_source { 0, 1 pigment { rgb 1 } }", BRUME_ERR_SCENE, 1,
                 21, "pigment");
    expect_warning("light_source { 0, 1 radius 5 }", 1, 1, "without");
    s = scene("light_source { <1,2,3>, 1 cylinder radius 5 falloff 100\n"
              "  area_light <1,0,0>, <0,2,0>, 3, 4 circular parallel\n"
              "  looks_like { sphere { 0, 1 translate x } } translate y }");
    l = &s->light[0];
    assert_int_equal(l->kind, BRUME_LIGHT_CYLINDER);
    assert_true(l->area && l->area_circular && l->parallel);
    assert_false(l->area_orient);
    NUMBERS(l->area_axis[1], 0, 2, 0);
    assert_int_equal(l->area_size[1], 4);
    assert_false(s->shape[0].shadow);
    NUMBERS(s->shape[0].transform[0], 1, 0, 0, 2);
    NUMBERS(s->shape[0].transform[1], 0, 1, 0, 3);
}

static void backgrounds(void **state)
{
    (void)state;
    const brume_scene *s = scene("background { color rgb <1, 2, 3> }");
    NUMBERS(s->globals.background, 1, 2, 3);
    s = scene("#declare C = rgb <0, .5, 1>; background { C }");
    NUMBERS(s->globals.background, 0, 0.5, 1);
}

/* ---- objects ----------------------------------------------------------- */

static void shapes(void **state)
{
    (void)state;
    const brume_scene *s = scene("sphere { <1, 2, 3>, -4 }\n"
                                 "box { <1, 0, 1>, <0, 2, 3> inverse }\n"
                                 "cylinder { 0, y, 2 open no_shadow }\n"
                                 "cone { 0, 1, 2*y, 3 hollow }\n"
                                 "plane { y, -1 hollow off }\n"
                                 "disc { x, y, 3, 1 } disc { x, y 3 }\n");
    assert_int_equal(s->shapes, 7);
    assert_int_equal(s->shape[0].kind, BRUME_SHAPE_SPHERE);
    NUMBERS(s->shape[0].a, 1, 2, 3);
    NUMBERS(&s->shape[0].radius, 4);
    assert_true(s->shape[0].shadow && !s->shape[0].hollow);
    assert_int_equal(s->shape[1].kind, BRUME_SHAPE_BOX);
    NUMBERS(s->shape[1].a, 0, 0, 1);
    NUMBERS(s->shape[1].b, 1, 2, 3);
    assert_true(s->shape[1].inverse);
    assert_int_equal(s->shape[2].kind, BRUME_SHAPE_CYLINDER);
    assert_true(s->shape[2].open && !s->shape[2].shadow);
    assert_int_equal(s->shape[3].kind, BRUME_SHAPE_CONE);
    NUMBERS(&s->shape[3].radius, 1, 3);
    assert_true(s->shape[3].hollow);
    assert_int_equal(s->shape[4].kind, BRUME_SHAPE_PLANE);
    NUMBERS(&s->shape[4].radius, -1);
    assert_int_equal(s->shape[5].kind, BRUME_SHAPE_DISC);
    NUMBERS(&s->shape[5].radius, 3, 1);
    NUMBERS(&s->shape[6].radius, 3, 0);
    /* All wear the default texture. */
    assert_int_equal(s->materials, 1);
    NUMBERS(s->material[0].color[0], 0, 0, 0, 0, 0);
}

static void shapes_that_are_wrong(void **state)
{
    (void)state;
    expect_error("sphere { 0 }", BRUME_ERR_SCENE, 1, 12,
                 "'sphere' needs its radius");
    expect_error("sphere { 0, 1, 2 }", BRUME_ERR_SCENE, 1, 16, "no more");
    expect_error("sphere { 0, x }", BRUME_ERR_SCENE, 1, 13, "a float");
    expect_error("sphere { 0, 1 open }", BRUME_ERR_SCENE, 1, 15,
                 "'open' has no place in 'sphere'");
    expect_error("object { }", BRUME_ERR_SCENE, 1, 10, "needs an object");
    expect_error("sphere { 0, 1 matrix <1, 2, 3> }", BRUME_ERR_SCENE, 1, 22,
                 "12 numbers");
    expect_error("sphere { 0, 1 matrix <1,0,0, 0,1,0, 0,0,0, 0,0,0> }",
                 BRUME_ERR_SCENE, 1, 22, "no inverse");
    expect_warning("sphere { 0, 0 }", 1, 1, "radius 0");
    assert_int_equal(result.scene->shapes, 0);
    expect_warning("sphere { 0, 1 scale <1, 0, 1> }", 1, 21, "scale of y");
    expect_warning("union { }", 1, 1, "empty");
}

static void transformations(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare T = transform { scale 2 translate x inverse }\n"
        "sphere { 0, 1 rotate 90*z translate <1, 2, 3>\n"
        "  matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 10, 20, 30> }\n"
        "sphere { 0, 1 transform T }\n"
        "sphere { 0, 1 transform { T translate z } transform { T inverse } "
        "}\n");
    NUMBERS(s->shape[0].transform[0], 0, -1, 0, 11);
    NUMBERS(s->shape[0].transform[1], 1, 0, 0, 22);
    NUMBERS(s->shape[0].transform[2], 0, 0, 1, 33);
    NUMBERS(s->shape[1].transform[0], 0.5, 0, 0, -0.5);
    NUMBERS(s->shape[2].transform[0], 1, 0, 0, 0);
    NUMBERS(s->shape[2].transform[2], 0, 0, 1, 2);
    s = scene("sphere { <1, 2, 3>*2, 1 scale <1, 2, 3>/2 }");
    NUMBERS(s->shape[0].a, 2, 4, 6);
    NUMBERS(s->shape[0].transform[1], 0, 1, 0, 0);
    NUMBERS(s->shape[0].transform[2], 0, 0, 1.5, 0);
}

static void unions_hand_down(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "union {\n"
        "  sphere { 0, 1 }\n"
        "  sphere { 0, 1 pigment { checker rgb 1, rgb 0 } scale 2 }\n"
        "  union { box { 0, 1 hollow off } sphere { 0, 1 } no_shadow }\n"
        "  hollow\n"
        "  translate x\n"
        "  texture { pigment { checker rgb 1 rgb .5 } scale 3 }\n"
        "  rotate 90*z\n"
        "}\n");
    assert_int_equal(s->shapes, 4);
    NUMBERS(s->shape[0].transform[1], 1, 0, 0, 1);
    const struct brume_material *m = &s->material[s->shape[0].material];
    NUMBERS(m->color[1], 0.5, 0.5, 0.5, 0, 0);
    /* Not moved by x, which stands before it; turned by what stands after. */
    NUMBERS(m->pigment_transform[0], 0, -3, 0, 0);
    NUMBERS(m->pigment_transform[1], 3, 0, 0, 0);
    m = &s->material[s->shape[1].material];
    NUMBERS(m->pigment_transform[1], 2, 0, 0, 1);
    assert_true(s->shape[0].hollow && !s->shape[2].hollow);
    assert_true(s->shape[3].hollow && !s->shape[3].shadow);
    assert_true(s->shape[1].shadow);
    assert_int_equal(s->shape[2].material, s->shape[0].material);
    assert_int_equal(s->materials, 2);
}

static void declared_objects_are_copied(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare B = box { 0, 1 pigment { rgb x } translate x }\n"
        "#declare U = union { object { B } object { B scale 2 } }\n"
        "object { B translate y pigment { rgb y } }\n"
        "object { U translate z texture { pigment { rgb z } } }\n"
        "object { sphere { 0, 1 } scale 3 }\n");
    assert_int_equal(s->shapes, 4);
    NUMBERS(s->shape[0].transform[1], 0, 1, 0, 1);
    NUMBERS(s->material[s->shape[0].material].color[0], 0, 1, 0, 0, 0);
    NUMBERS(s->material[s->shape[1].material].color[0], 1, 0, 0, 0, 0);
    NUMBERS(s->shape[2].transform[0], 2, 0, 0, 2);
    NUMBERS(s->shape[2].transform[2], 0, 0, 2, 1);
    NUMBERS(s->shape[3].transform[0], 3, 0, 0, 0);
}

/* As deep as a script may nest: a stack, not recursion, walks it. */
static void unions_nest_deep(void **state)
{
    enum { DEEP = 100000 };
    size_t room = DEEP * 10 + 100;
    char *text = malloc(room), *at = text;
    (void)state;

    assert_non_null(text);
    for (int i = 0; i < DEEP; i++)
        at += sprintf(at, "union{");
    at += sprintf(at, "sphere{0,1}");
    for (int i = 0; i < DEEP; i++)
        at += sprintf(at, "}");
    assert_int_equal(scene(text)->shapes, 1);
    free(text);
}

/* ---- meshes ------------------------------------------------------------ */

static void meshes(void **state)
{
    (void)state;
    const brume_scene *s = scene("#declare M = mesh {\n"
                                 "  triangle { 0, x, y }\n"
                                 "  smooth_triangle { 0, z, x, z, y, z\n"
                                 "    uv_vectors <0, 0>, <1, 0>, <0, 1> }\n"
                                 "  inside_vector y hierarchy on\n"
                                 "  pigment { rgb 1 } }\n"
                                 "object { M } object { M translate x }\n"
                                 "triangle { 0, x, y pigment { rgb x } }\n"
                                 "smooth_triangle { 0, z, x, z, y, z }\n");
    assert_int_equal(s->meshes, 3);
    assert_int_equal(s->shapes, 4);
    assert_int_equal(s->mesh[0].triangles, 2);
    assert_int_equal(s->mesh[0].vertices, 6);
    assert_int_equal(s->mesh[0].normals, 3);
    assert_true(s->mesh[0].smooth && s->mesh[0].mapped);
    assert_int_equal(s->mesh[0].corner_normal[0][0], MESH_NONE);
    assert_int_equal(s->shape[1].mesh, 0);
    assert_int_equal(s->shape[1].kind, BRUME_SHAPE_MESH);
    assert_int_equal(s->mesh[1].triangles, 1);
    NUMBERS(s->mesh[1].position[2], 0, 1, 0);
    assert_true(s->mesh[2].smooth && !s->mesh[1].smooth);
    expect_error("mesh { }", BRUME_ERR_SCENE, 1, 1, "no triangles");
    expect_error("mesh { triangle { 0, x, y scale 2 } }", BRUME_ERR_SCENE, 1, 8,
                 "transformed");
    expect_error("mesh { triangle { 0, x, y texture { } } }", BRUME_ERR_SCENE,
                 1, 27, "not supported yet");
    expect_error("mesh { triangle { 0, x } }", BRUME_ERR_SCENE, 1, 24,
                 "third corner");
    expect_error("mesh { triangle { 0, x, y } inside_vector 0 }",
                 BRUME_ERR_SCENE, 1, 29, "no direction");
}

static void mesh2s(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "mesh2 {\n"
        "  vertex_vectors { 4, <0,0,0>, <1,0,0>, <0,1,0>, <1,1,0> }\n"
        "  normal_vectors { 4, z, z, z, z }\n"
        "  uv_vectors { 1 <0, 0> }\n"
        "  face_indices { 2, <0,1,2>, <1,2,3>, }\n"
        "  uv_indices { 2, <0,0,0>, <0,0,0> }\n"
        "}\n"
        "mesh2 {\n"
        "  vertex_vectors { 3 <0,0,0> <1,0,0> <0,1,0> }\n"
        "  normal_vectors { 1 z }\n"
        "  face_indices { 2 <0,1,2> <0,1,2> }\n"
        "  normal_indices { 1 <0,0,0> }\n"
        "}\n");
    assert_int_equal(s->mesh[0].triangles, 2);
    assert_true(s->mesh[0].smooth && s->mesh[0].mapped);
    assert_int_equal(s->mesh[0].corner_normal[1][2], 3);
    assert_true(s->mesh[1].smooth && !s->mesh[1].mapped);
    assert_int_equal(s->mesh[1].corner_normal[0][2], 0);
    assert_int_equal(s->mesh[1].corner_normal[1][0], MESH_NONE);
}

static void mesh2s_that_are_wrong(void **state)
{
    (void)state;
    expect_error("mesh2 { vertex_vectors { 3, 0, x } }", BRUME_ERR_SCENE, 1, 9,
                 "announces 3 items but has 2");
    expect_error("mesh2 { vertex_vectors { 1, 0, x } }", BRUME_ERR_SCENE, 1, 32,
                 "more");
    expect_error("mesh2 { vertex_vectors { 3, 0, x, y } }", BRUME_ERR_SCENE, 1,
                 1, "no face_indices");
    expect_error("mesh2 { vertex_vectors { 3, 0, x, y }\n"
                 "face_indices { 1, <0, 1, 3> } }",
                 BRUME_ERR_SCENE, 1, 1, "");
    expect_warning("mesh2 { vertex_vectors { 3, 0, x, y }\n"
                   "texture_list { 1, texture { pigment { rgb 1 } } }\n"
                   "face_indices { 1, <0, 1, 2>, 0 } }",
                   1, 1, "textures of single triangles");
    expect_error("mesh2 { vertex_vectors { 3, 0, x, y }\n"
                 "texture_list { 2, texture { pigment { rgb 1 } } }",
                 BRUME_ERR_SCENE, 2, 1, "announces 2 items but has 1");
    expect_error("mesh2 { vertex_vectors { 3, 0, x, y }\n"
                 "normal_vectors { 1, z } face_indices { 1, <0, 1, 2> } }",
                 BRUME_ERR_SCENE, 1, 1, "needs normal_indices");
}

/* ---- surfaces ---------------------------------------------------------- */

static const struct brume_material *material_of(const char *modifiers)
{
    char text[1000];

    snprintf(text, sizeof text, "sphere { 0, 1 %s }", modifiers);
    const brume_scene *s = scene(text);
    assert_int_equal(s->shape[0].material, 0);
    return &s->material[0];
}

static void finishes(void **state)
{
    (void)state;
    const struct brume_material *m = material_of(
        "pigment { rgbft <.1, .2, .3, .4, .5> } finish { ambient rgb <1, 2, 3>"
        " emission 4 diffuse 5 brilliance 6 phong 7 phong_size 8 specular 9"
        " roughness .5 metallic }");
    NUMBERS(m->color[0], 0.1, 0.2, 0.3, 0.4, 0.5);
    NUMBERS(m->ambient, 1, 2, 3);
    NUMBERS(m->emission, 4, 4, 4);
    NUMBERS(&m->diffuse, 5, 6, 7, 8, 9, 0.5, 1);
    m = material_of("finish { metallic .5 }");
    NUMBERS(&m->diffuse, 0.6, 1, 0, 40, 0, 0.05, 0.5);
    expect_error("sphere { 0, 1 finish { roughness 0 } }", BRUME_ERR_SCENE, 1,
                 34, "'roughness' is 0, must be greater than 0");
    expect_error("sphere { 0, 1 finish { diffuse <1, 2> } }", BRUME_ERR_SCENE,
                 1, 32, "'diffuse' needs a float");
}

static void pigments(void **state)
{
    (void)state;
    const struct brume_material *m = material_of("pigment { checker }");
    NUMBERS(m->color[0], 0, 0, 1, 0, 0);
    NUMBERS(m->color[1], 0, 1, 0, 0, 0);
    m = material_of("pigment { checker rgb 1 }");
    NUMBERS(m->color[0], 1, 1, 1, 0, 0);
    NUMBERS(m->color[1], 0, 1, 0, 0, 0);
    m = material_of("pigment { checker color rgb 1, color rgb .5 scale 2 } "
                    "translate x");
    assert_int_equal(m->pigment, BRUME_PIGMENT_CHECKER);
    NUMBERS(m->pigment_transform[0], 2, 0, 0, 1);
    m = material_of("translate x pigment { checker } pigment { scale 2 }");
    NUMBERS(m->pigment_transform[0], 2, 0, 0, 0);
    m = material_of("pigment { rgb 1 quick_color rgb 0 }");
    assert_int_equal(diag.warnings, 1);
    expect_error("sphere { 0, 1 pigment { rgb 1, rgb 0 } }", BRUME_ERR_SCENE, 1,
                 32, "1 color");
    const brume_scene *t = scene(
        "sphere { 0, 1 pigment { rgb <1, .5, 0>*.5 filter .6 } }");
    NUMBERS(t->material[0].color[0], .5, .25, 0, .6, 0);
}

static void textures(void **state)
{
    (void)state;
    const struct brume_material *m = material_of(
        "texture { pigment { checker } scale 2 finish { ambient 1 } }\n"
        "finish { diffuse 0 }");
    NUMBERS(m->ambient, 1, 1, 1);
    NUMBERS(&m->diffuse, 0);
    NUMBERS(m->pigment_transform[0], 2, 0, 0, 0);
    const brume_scene *s = scene(
        "#declare P = pigment { rgb x }\n"
        "#declare F = finish { ambient .5 }\n"
        "#declare T = texture { P F }\n"
        "#declare I = T\n"
        "sphere { 0, 1 texture { I finish { diffuse .25 } } }\n"
        "sphere { 0, 1 pigment { P } finish { F phong 1 } }\n"
        "sphere { 0, 1 texture { T } texture { pigment { rgb y } } }\n");
    NUMBERS(s->material[0].color[0], 1, 0, 0, 0, 0);
    NUMBERS(s->material[0].ambient, 0.5, 0.5, 0.5);
    NUMBERS(&s->material[0].diffuse, 0.25);
    NUMBERS(&s->material[1].phong, 1);
    NUMBERS(s->material[2].color[0], 0, 1, 0, 0, 0);
    NUMBERS(s->material[2].ambient, 0.1, 0.1, 0.1);
}

/* Of what is not drawn yet the mean is. */
static void patterns_have_means(void **state)
{
    (void)state;
    const struct brume_material *m = material_of(
        "pigment { bozo color_map { [0 rgb 0] [1 rgb <1, .5, 0>] } }");
    NUMBERS(m->color[0], 0.5, 0.25, 0, 0, 0);
    m = material_of("pigment { granite colour_map { [0.0 0.5 rgb x rgb x]"
                    "  [0.5 1 color rgb y color rgb y] } }");
    NUMBERS(m->color[0], 0.5, 0.5, 0, 0, 0);
    m = material_of("pigment { wood pigment_map {"
                    "  [0.5 hexagon rgb 1, rgb 0, rgb .5] [0.5 rgb z] } }");
    NUMBERS(m->color[0], 0.25, 0.25, 0.75, 0, 0);
    m = material_of("pigment { brick pigment { rgb 1 } pigment { rgbt 1 } }");
    NUMBERS(m->color[0], 1, 1, 1, 0, 0.5);
    m = material_of("pigment { average pigment_map { [3 rgb x] [1 rgb y] } }");
    NUMBERS(m->color[0], 0.75, 0.25, 0, 0, 0);
    m = material_of("texture { gradient x texture_map {"
                    "  [0 pigment { rgb x } finish { ambient 1 }]"
                    "  [1 pigment { rgb z } finish { ambient 0 }] } }");
    NUMBERS(m->color[0], 0.5, 0, 0.5, 0, 0);
    NUMBERS(m->ambient, 1, 1, 1);
    m = material_of("texture { tiles { texture { pigment { rgb 1 } } tile2 "
                    "texture { pigment { rgb 0 } } } }");
    NUMBERS(m->color[0], 0.5, 0.5, 0.5, 0, 0);
}

static void layers_cover(void **state)
{
    (void)state;
    const struct brume_material *m = material_of(
        "texture { pigment { rgb <1, 0, 0> } }\n"
        "texture { pigment { rgbt <0, 1, 0, .5> } }");
    NUMBERS(m->color[0], 0.5, 0.5, 0, 0, 0);
    m = material_of("texture { pigment { rgb 1 } }\n"
                    "texture { pigment { rgbf <0, 0, 1, 1> } }");
    NUMBERS(m->color[0], 0, 0, 1, 0, 0);
    const brume_scene *s = scene(
        "#declare T = texture { pigment { checker rgb 1 rgb 0 } }\n"
        "            texture { pigment { rgbt 1 } }\n"
        "#declare U = texture { T } texture { pigment { rgbt 1 } }\n"
        "sphere { 0, 1 texture { U scale 2 } }\n"
        "sphere { 0, 1 texture { T } pigment { rgb x } }\n");
    NUMBERS(s->material[0].color[0], 0.5, 0.5, 0.5, 0, 0);
    NUMBERS(s->material[1].color[0], 1, 0, 0, 0, 0);
}

static void surfaces_that_are_wrong(void **state)
{
    (void)state;
    expect_error("sphere { 0, 1 pigment { bozo mortar 1 } }", BRUME_ERR_SCENE,
                 1, 30, "'mortar' does not belong to this pattern");
    expect_error("sphere { 0, 1 pigment { facets size 1 } }", BRUME_ERR_SCENE,
                 1, 25, "for normals only");
    expect_error("sphere { 0, 1 texture { bozo } }", BRUME_ERR_SCENE, 1, 30,
                 "needs textures");
    expect_error("sphere { 0, 1 pigment { average } }", BRUME_ERR_SCENE, 1, 33,
                 "needs a map");
    expect_error("sphere { 0, 1 pigment { checker rgb 1 color_map { [0 rgb 1] "
                 "} } }",
                 BRUME_ERR_SCENE, 1, 63, "from a list");
    expect_error("sphere { 0, 1 pigment { bozo pigment_map { [checker] } } }",
                 BRUME_ERR_SCENE, 1, 52, "begins with a float");
    expect_error("sphere { 0, 1 pigment { bozo color_map { } } }",
                 BRUME_ERR_SCENE, 1, 42, "needs an entry");
    expect_error("sphere { 0, 1 pigment { bozo warp { repeat x + y } } }",
                 BRUME_ERR_SCENE, 1, 44, "one axis");
    expect_error("sphere { 0, 1 pigment { tiling 28 } }", BRUME_ERR_SCENE, 1,
                 32, "'tiling' is 28");
    expect_error("sphere { 0, 1 finish { albedo 1 } }", BRUME_ERR_SCENE, 1, 24,
                 "'albedo' belongs behind");
    expect_error("sphere { 0, 1 pigment { magnet 1 } }", BRUME_ERR_SCENE, 1, 34,
                 "'mandel' or 'julia'");
    expect_error("sphere { 0, 1 pigment { image_map { png \"none.png\" } } }",
                 BRUME_ERR_FILE, 1, 41, "not found");
}

/* What is not drawn yet is told once, of what is placed. */
static void lacks(void **state)
{
    (void)state;
    scene("#declare T = texture { normal { bumps } }\n"
          "sphere { 0, 1 pigment { checker rgb 1 rgb 0 } }");
    assert_null(first_of(DIAG_WARNING));
    expect_warning("sphere { 0, 1 }\n"
                   "sphere { 0, 1 normal { bumps .3 } finish { reflection .1 "
                   "irid { .2 } } pigment { agate } interior { ior 2 } }\n"
                   "sphere { 0, 1 normal { bumps } }\n"
                   "sphere { 0, 1 pigment { rgbf 1 } interior { ior 2 } }\n",
                   2, 1,
                   "lacks what is not drawn yet: normals, "
                   "reflection, iridescence, refraction");
    assert_ptr_equal(first_of(DIAG_WARNING), diag.first);
    assert_null(diag.first->next);
}

static void defaults(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare S = sphere { 0, 1 }\n"
        "sphere { 0, 1 }\n"
        "#default { pigment { rgb x } finish { ambient 1 } }\n"
        "sphere { 0, 1 texture { finish { diffuse 0 } } }\n"
        "#default { texture { pigment { rgb y } } }\n"
        "object { S }\n");
    NUMBERS(s->material[0].color[0], 0, 0, 0, 0, 0);
    NUMBERS(s->material[1].color[0], 1, 0, 0, 0, 0);
    NUMBERS(s->material[1].ambient, 1, 1, 1);
    NUMBERS(s->material[2].color[0], 0, 1, 0, 0, 0);
    NUMBERS(s->material[2].ambient, 1, 1, 1);
}

/* A declaration inside of a statement does not begin with that statement's
 * pigment. */
static void declarations_inside_of_statements(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "sphere { 0, 1 pigment { rgb x }\n"
        "  #declare P = pigment { scale 2 }\n"
        "  #declare C = sphere { 0, 2 }\n"
        "  finish { ambient 1 } }\n"
        "sphere { 0, 1 pigment { P } } object { C }\n");
    NUMBERS(s->material[0].color[0], 1, 0, 0, 0, 0);
    NUMBERS(s->material[0].ambient, 1, 1, 1);
    NUMBERS(s->material[1].color[0], 0, 0, 0, 0, 0);
    assert_int_equal(s->shapes, 3);
}

/* Nodes of statements are used again; those with a name must not be. */
static void identifiers_keep_their_values(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare P = pigment { rgb x }\n"
        "#declare F = finish { ambient .5 }\n"
        "#declare T = texture { pigment { P } finish { F } }\n"
        "#declare M = transform { scale 3 }\n"
        "#declare S = sphere { 0, 1 pigment { rgb z } }\n"
        "#declare A = array[2] {pigment { rgb <0, 1, 1> }, texture { T }}\n"
        "#for (I, 1, 3)\n"
        "  sphere { 0, I pigment { rgb y } finish { ambient .1*I }\n"
        "    transform { scale I } }\n"
        "#end\n"
        "sphere { 0, 1 pigment { P } finish { F } transform M }\n"
        "sphere { 0, 1 texture { T } }\n"
        "object { S }\n"
        "sphere { 0, 1 pigment { A[0] } }\n"
        "sphere { 0, 1 texture { A[1] } finish { diffuse 0 } }\n"
        "object { S texture { T } }\n"
        "object { S }\n"
        "#declare Q = pigment { rgb z }\n"
        "sphere { 0, 1 texture { Q } }\n"
        "sphere { 0, 1 pigment { rgb y } }\n"
        "sphere { 0, 1 texture { Q } }\n");
    NUMBERS(s->material[s->shape[2].material].ambient, 0.3, 0.3, 0.3);
    NUMBERS(s->material[s->shape[3].material].color[0], 1, 0, 0, 0, 0);
    NUMBERS(s->material[s->shape[3].material].ambient, 0.5, 0.5, 0.5);
    NUMBERS(s->shape[3].transform[0], 3, 0, 0, 0);
    assert_int_equal(s->shape[4].material, s->shape[3].material);
    NUMBERS(s->material[s->shape[5].material].color[0], 0, 0, 1, 0, 0);
    NUMBERS(s->material[s->shape[6].material].color[0], 0, 1, 1, 0, 0);
    NUMBERS(s->material[s->shape[7].material].color[0], 1, 0, 0, 0, 0);
    assert_int_equal(s->shape[8].material, s->shape[3].material);
    assert_int_equal(s->shape[9].material, s->shape[5].material);
    assert_int_equal(s->shape[10].material, s->shape[5].material);
    assert_int_equal(s->shape[12].material, s->shape[5].material);
}

/* ---- global settings --------------------------------------------------- */

static void globals(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "global_settings { ambient_light rgb <1, 2, 3> assumed_gamma 1\n"
        "  max_trace_level 10 adc_bailout .01 integrator path\n"
        "  accuracy .02 time_limit 5 }\n");
    NUMBERS(s->globals.ambient_light, 1, 2, 3);
    assert_false(s->globals.media_multiple || s->globals.surfaces_indirect ||
                 s->globals.environment || s->globals.physical_units);
    assert_true(result.has_integrator && result.assumed_gamma == 1);
    NUMBERS(&result.accuracy, 0.02, 5);
    s = scene("global_settings { volume_photons { count 5e4 preset paper\n"
              "  emission line radius 0.5 field_spacing 0.1 frustum off } }\n");
    assert_int_equal(result.photons.count, 50000);
    assert_int_equal(result.photons.gather, BRUME_GATHER_BALL);
    assert_int_equal(result.photons.single, BRUME_SINGLE_FIELD);
    assert_int_equal(result.photons.emission, BRUME_EMISSION_LINE);
    NUMBERS(&result.photons.radius, 0.5);
    NUMBERS(&result.photons.spacing, 0.1);
    assert_true(result.photons.everywhere);
    assert_true(s->globals.media_multiple && s->globals.surfaces_indirect);
    expect_error("global_settings { max_trace_level 257 }", BRUME_ERR_SCENE, 1,
                 35, "at most 256");
    expect_warning("global_settings { assumed_gamma 2.2 }", 1, 19, "2.2");
}

static void check_transport(const char *text, bool media, bool surfaces,
                            bool environment)
{
    const brume_scene *s = scene(text);

    assert_int_equal(s->globals.media_multiple, media);
    assert_int_equal(s->globals.surfaces_indirect, surfaces);
    assert_int_equal(s->globals.environment, environment);
}

static void transports(void **state)
{
    (void)state;
    check_transport("global_settings { transport { media multiple\n"
                    "  surfaces indirect environment on } }",
                    true, true, true);
    check_transport("global_settings { light_units physical }", true, true,
                    true);
    assert_true(result.scene->globals.physical_units);
    check_transport("global_settings { light_units physical\n"
                    "  transport { media single environment off } }",
                    false, true, false);
    check_transport("global_settings { light_units pov }", false, false, false);
    assert_true(
        parse("global_settings { transport { surfaces direct } }", true));
    assert_true(result.scene->globals.media_multiple &&
                !result.scene->globals.surfaces_indirect &&
                result.scene->globals.environment);
}

/* Words of Brume's own are names where a scene declares them. */
static void extension_words_can_be_names(void **state)
{
    (void)state;
    const brume_scene *s = scene(
        "#declare fire = 2; #declare intensity = 3; #declare path = x;\n"
        "sphere { path, fire*intensity }\n");
    NUMBERS(&s->shape[0].radius, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras),
        cmocka_unit_test(lights),
        cmocka_unit_test(backgrounds),
        cmocka_unit_test(shapes),
        cmocka_unit_test(shapes_that_are_wrong),
        cmocka_unit_test(transformations),
        cmocka_unit_test(unions_hand_down),
        cmocka_unit_test(declared_objects_are_copied),
        cmocka_unit_test(unions_nest_deep),
        cmocka_unit_test(meshes),
        cmocka_unit_test(mesh2s),
        cmocka_unit_test(mesh2s_that_are_wrong),
        cmocka_unit_test(finishes),
        cmocka_unit_test(pigments),
        cmocka_unit_test(textures),
        cmocka_unit_test(patterns_have_means),
        cmocka_unit_test(layers_cover),
        cmocka_unit_test(surfaces_that_are_wrong),
        cmocka_unit_test(lacks),
        cmocka_unit_test(defaults),
        cmocka_unit_test(declarations_inside_of_statements),
        cmocka_unit_test(identifiers_keep_their_values),
        cmocka_unit_test(globals),
        cmocka_unit_test(transports),
        cmocka_unit_test(extension_words_can_be_names),
    };

    return cmocka_run_group_tests_name("build", tests, NULL, forget_scene);
}
