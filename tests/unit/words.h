/* words.h - a scene for each statement of the language, and a use for each
 * word in it that does not show by itself; see test_words.c.
 *
 * In a scene % is where the words of its statement stand, and what is between
 * two @ is what is left out to see whether the statement shows. */
#ifndef TESTS_WORDS_H
#define TESTS_WORDS_H
#include "parser/builder.h"

struct words_scene {
    enum build_kind kind;
    const char *text;
    const char *lacks; /* a warning has this: nothing of it is drawn  */
};

/* `with` where the scene has %, and `without` it; NULL: nothing. */
struct words_use {
    enum build_kind kind; /* BUILD_KINDS: any with patterns; or, where it
                               brings a scene, any                         */
    const char *word, *with, *without;
    const char *scene; /* in place of that of the statement           */
    const char *lacks; /* as above                                    */
};

#define WORDS_BODY(kind, body)                                                 \
    {                                                                          \
        BUILD_##kind, "@" body " % }@", NULL                                   \
    }
#define WORDS_IN(kind, text)                                                   \
    {                                                                          \
        BUILD_##kind, text, NULL                                               \
    }
#define WORDS_LACK(kind, lacks, text)                                          \
    {                                                                          \
        BUILD_##kind, text, lacks                                              \
    }
#define WORDS_WORN(text) "sphere { 0, 1 " text " }"
#define WORDS_GLOW "sphere { 0, 1 pigment { rgbt 1 } hollow "
#define WORDS_MESH "vertex_vectors { 4, 0, x, y, z } "
#define WORDS_MAPPED "texture { uv_mapping pigment { bozo } } "
#define WORDS_FACES                                                            \
    "face_indices { 4, <0, 1, 2>, <0, 1, 3>, <0, 2, 3>, <1, 2, 3> } "

static const struct words_scene words_scenes[] = {
    WORDS_BODY(TRIANGLE, "triangle { 0, x, y"),
    WORDS_BODY(SMOOTH_TRIANGLE, "smooth_triangle { 0, z, x, z, y, z + x"),
    WORDS_BODY(SPHERE, "sphere { 0, 1"),
    WORDS_BODY(BOX, "box { 0, 1"),
    WORDS_BODY(CYLINDER, "cylinder { 0, y, 1"),
    WORDS_BODY(CONE, "cone { 0, 1, y, 0.5"),
    WORDS_BODY(PLANE, "plane { y, 0"),
    WORDS_BODY(DISC, "disc { 0, y, 1"),
    WORDS_BODY(MESH, "mesh { triangle { 0, x, y }"),
    WORDS_BODY(MESH2, "mesh2 { " WORDS_MESH WORDS_FACES),
    WORDS_BODY(TORUS, "torus { 1, 0.3"),
    WORDS_BODY(OVUS, "ovus { 1, 0.5"),
    WORDS_BODY(TEXT, "text { internal 1 \"A\" 1, 0"),
    WORDS_BODY(QUADRIC, "quadric { x, y, z, -1"),
    WORDS_BODY(CUBIC, "cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0,"
                      " 0, 0, 0, 0, 0, 0, 0, 0, 0, 1>"),
    WORDS_BODY(QUARTIC, "quartic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0,"
                        " 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,"
                        " 0, 0, 0, 0, 0, 0, 0, 0, 0, -1>"),
    WORDS_BODY(POLY, "poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -1>"),
    WORDS_BODY(POLYNOMIAL, "polynomial { 2, xyz(2, 0, 0): 1"),
    WORDS_BODY(SUPERELLIPSOID, "superellipsoid { <0.5, 0.5>"),
    WORDS_BODY(JULIA_FRACTAL, "julia_fractal { <0.1, 0.2, 0.3, 0.4>"),
    WORDS_BODY(LATHE, "lathe { 4, <1, 0>, <2, 1>, <1, 2>, <1, 3>"),
    WORDS_BODY(PRISM, "prism { 0, 1, 5, <0, 0>, <1, 0>, <1, 1>, <0, 1>,"
                      " <0, 0>"),
    WORDS_BODY(SOR, "sor { 4, <1, -1>, <1, 0>, <2, 1>, <1, 2>"),
    WORDS_BODY(SPHERE_SWEEP, "sphere_sweep { linear_spline 4, 0, 1, x, 1,"
                             " 2 * x, 1, 3 * x, 1"),
    WORDS_BODY(POLYGON, "polygon { 4, <0, 0>, <1, 0>, <1, 1>, <0, 0>"),
    WORDS_BODY(BICUBIC_PATCH,
               "bicubic_patch { u_steps 2 v_steps 2 <0, 0, 0>, x, 2*x, 3*x, "
               "z, x+z, 2*x+z, 3*x+z, 2*z, x+2*z, 2*x+2*z, 3*x+2*z, "
               "3*z, x+3*z, 2*x+3*z, 3*x+3*z"),
    WORDS_BODY(BLOB, "blob { threshold 0.6 sphere { 0, 1, 2 }"),
    WORDS_IN(BLOB_SPHERE,
             "blob { cylinder { 0, y, 1, 2 } @sphere { 0, 1, 2 % }@ }"),
    WORDS_IN(BLOB_CYLINDER, "blob { sphere { 0, 1, 2 } "
                            "@cylinder { 0, y, 1, 2 % }@ }"),
    WORDS_BODY(ISOSURFACE, "isosurface { function { x + y + z }"),
    WORDS_BODY(PARAMETRIC, "parametric { function { u } function { v } "
                           "function { u + v } <0, 0>, <1, 1>"),
    WORDS_BODY(HEIGHT_FIELD, "height_field { function 3, 3 { x }"),
    WORDS_IN(CONTAINED_BY, "isosurface { function { x + y + z } "
                           "@contained_by { sphere { 0, 2 } }@ }"),
    WORDS_BODY(UNION, "union { sphere { 0, 1 } box { 0, 1 }"),
    WORDS_BODY(MERGE, "merge { sphere { 0, 1 } box { 0, 1 }"),
    WORDS_BODY(INTERSECTION, "intersection { sphere { 0, 1 } box { 0, 1 }"),
    WORDS_BODY(DIFFERENCE, "difference { sphere { 0, 1 } box { 0, 1 }"),
    WORDS_BODY(OBJECT, "object { sphere { 0, 1 }"),
    WORDS_IN(CLIPPED_BY, "sphere { 0, 1 @clipped_by { box { 0, 1 } % }@ }"),
    WORDS_LACK(BOUNDED_BY, "'bounded_by' has no effect",
               "sphere { 0, 1 bounded_by { box { 0, 1 } % } }"),
    WORDS_BODY(LIGHT_GROUP, "light_group { light_source { y, 1 } "
                            "sphere { 0, 1 }"),
    WORDS_IN(OBJECT_PHOTONS, "sphere { 0, 1 photons { % } }"),
    WORDS_IN(OBJECT_RADIOSITY, "sphere { 0, 1 radiosity { % } }"),
    WORDS_IN(VERTEX_VECTORS,
             "mesh2 { vertex_vectors { 4, 0, x, y, % z } " WORDS_FACES "}"),
    WORDS_IN(FACE_INDICES,
             "mesh2 { " WORDS_MESH "face_indices { 1, <0, 1, 2 %> } }"),
    WORDS_IN(NORMAL_VECTORS,
             "mesh2 { " WORDS_MESH
             "@normal_vectors { 4, x, y, z, x + y }@ " WORDS_FACES "}"),
    WORDS_LACK(UV_VECTORS, "pigments of some patterns",
               "mesh2 { " WORDS_MESH
               "uv_vectors { 4, <0, 0>, <1, 0>, <0, 1>, <1, 1> } " WORDS_FACES
                   WORDS_MAPPED "}"),
    WORDS_LACK(UV_INDICES, "pigments of some patterns",
               "mesh2 { " WORDS_MESH "uv_vectors { 2, <0, 0>, <1, 0> } "
               "uv_indices { 4, <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0> "
               "} " WORDS_FACES WORDS_MAPPED "}"),
    WORDS_IN(NORMAL_INDICES,
             "mesh2 { " WORDS_MESH
             "normal_vectors { 4, x, y, z, x + y } " WORDS_FACES
             "@normal_indices { 4, <1, 1, 1>, <1, 1, 1>, <1, 1, 1>, "
             "<1, 1, 1> }@ }"),
    WORDS_LACK(TEXTURE_LIST, "textures of single triangles",
               "mesh2 { " WORDS_MESH
               "@texture_list { 1, texture { pigment { rgb x } } }@ "
               "face_indices { 1, <0, 1, 2>, 0 } }"),
    WORDS_IN(PIGMENT, WORDS_WORN("@pigment { % }@")),
    WORDS_LACK(NORMAL, "normals", WORDS_WORN("@normal { bumps % }@")),
    WORDS_IN(FINISH, WORDS_WORN("@finish { emission 0.1 % }@")),
    WORDS_IN(TEXTURE, WORDS_WORN("@texture { pigment { rgb x } }@")),
    WORDS_LACK(INTERIOR_TEXTURE, "interior textures",
               WORDS_WORN("@interior_texture { pigment { rgb x } }@")),
    WORDS_LACK(REFLECTION, "reflection",
               WORDS_WORN("finish { @reflection { 0.2, 0.5 % }@ }")),
    WORDS_LACK(IRID, "iridescence", WORDS_WORN("finish { @irid { 0.5 % }@ }")),
    WORDS_LACK(SUBSURFACE, "light below surfaces",
               WORDS_WORN("finish { @subsurface { translucency 0.5 % }@ }")),
    WORDS_IN(COLOR_MAP, WORDS_WORN("pigment { bozo "
                                   "@color_map { [0 rgb x] [1 rgb y] }@ }")),
    WORDS_IN(COLOUR_MAP, WORDS_WORN("pigment { bozo "
                                    "@colour_map { [0 rgb x] [1 rgb y] }@ }")),
    WORDS_IN(PIGMENT_MAP, WORDS_WORN("pigment { bozo "
                                     "@pigment_map { [0 rgb x] [1 rgb y] }@ "
                                     "}")),
    WORDS_LACK(NORMAL_MAP, "normals",
               WORDS_WORN("normal { bozo "
                          "@normal_map { [0 bumps 1] [1 dents 1] }@ }")),
    WORDS_LACK(SLOPE_MAP, "normals",
               WORDS_WORN("normal { bozo "
                          "@slope_map { [0 <0, 1>] [1 <1, 0>] }@ }")),
    WORDS_IN(TEXTURE_MAP, WORDS_WORN("texture { @bozo texture_map { "
                                     "[0 pigment { rgb x }] "
                                     "[1 pigment { rgb y }] }@ }")),
    WORDS_IN(DENSITY_MAP,
             WORDS_GLOW "interior { media { emission 1 density "
                        "{ bozo @density_map { [0 rgb x] [1 rgb y] }@ } } } }"),
    WORDS_IN(COLOR_ENTRY, WORDS_WORN("pigment { bozo color_map { "
                                     "[0 rgb x] @[0.5 rgb z]@ [1 rgb y] } }")),
    WORDS_IN(PIGMENT_ENTRY, WORDS_WORN("pigment { bozo pigment_map { [0 rgb x] "
                                       "@[0.5 %]@ [1 rgb y] } }")),
    WORDS_LACK(NORMAL_ENTRY, "normals",
               WORDS_WORN("normal { bozo normal_map { [0 dents 1] "
                          "[0.5 bumps 2 %] } }")),
    WORDS_LACK(SLOPE_ENTRY, "normals",
               WORDS_WORN("normal { bozo slope_map { [0 <0, 1>] } }")),
    WORDS_IN(TEXTURE_ENTRY,
             WORDS_WORN("texture { bozo texture_map { "
                        "[0 pigment { rgb x }] @[0.5 pigment { rgb z }]@ "
                        "[1 pigment { rgb y }] } }")),
    WORDS_IN(DENSITY_ENTRY, WORDS_GLOW
             "interior { media { emission 1 density { bozo "
             "density_map { [0 rgb x] @[0.5 %]@ [1 rgb y] } } } } }"),
    WORDS_IN(PATTERN, "#declare F = function { pattern { % } }" WORDS_WORN(
                          "pigment { function { F(x, y, z) } }")),
    WORDS_IN(WARP, WORDS_WORN("pigment { bozo @warp { % }@ }")),
    WORDS_IN(SLOPE, WORDS_WORN("pigment { @slope { % y }@ }")),
    WORDS_IN(PIGMENT_PATTERN,
             WORDS_WORN("pigment { @pigment_pattern { % }@ }")),
    WORDS_IN(OBJECT_PATTERN,
             WORDS_WORN("pigment { @object { box { 0, 1 } rgb x rgb y }@ }")),
    WORDS_IN(IMAGE_MAP,
             WORDS_WORN("pigment { @image_map { png \"tests/data/dots.png\" "
                        "% }@ }")),
    WORDS_IN(IMAGE_PATTERN, WORDS_WORN("pigment { @image_pattern { png "
                                       "\"tests/data/dots.png\" % }@ }")),
    WORDS_LACK(BUMP_MAP, "normals",
               WORDS_WORN("normal { @bump_map { png \"tests/data/dots.png\" "
                          "% }@ }")),
    WORDS_LACK(MATERIAL_MAP, "pigments of some patterns",
               WORDS_WORN("texture { @material_map { png "
                          "\"tests/data/dots.png\" % texture { pigment "
                          "{ rgb x } } texture { pigment { rgb y } } }@ }")),
    WORDS_IN(TILES, WORDS_WORN("texture { @tiles { texture { pigment { rgb x "
                               "} } tile2 texture { pigment { rgb y } } }@ "
                               "}")),
    WORDS_IN(MATERIAL, "sphere { 0, 1 @material { texture { pigment { rgb x "
                       "} } }@ }"),
    WORDS_IN(INTERIOR, "sphere { 0, 1 pigment { rgbf 1 } "
                       "@interior { ior 1.2 % }@ }"),
    WORDS_IN(MEDIA, WORDS_GLOW "interior { @media { scattering { 1, 1 } "
                               "% }@ } }"),
    WORDS_IN(SCATTERING, WORDS_GLOW "interior { media { emission 1 "
                                    "@scattering { 5, 1 % }@ } } }"),
    WORDS_IN(DENSITY, WORDS_GLOW "interior { media { emission 1 "
                                 "@density { % }@ } } }"),
    WORDS_IN(FIRE, WORDS_GLOW "interior { media { absorption 1 "
                              "@fire { temperature { spherical } % }@ } } }"),
    WORDS_IN(VELOCITY, WORDS_GLOW "interior { media { scattering { 1, 1 } "
                                  "@velocity { y % }@ } } }"),
    WORDS_IN(TEMPERATURE, WORDS_GLOW "interior { media { absorption 1 fire { "
                                     "temperature { % } } } } }"),
    WORDS_IN(AMOUNT, WORDS_GLOW "interior { media { absorption 1 fire { "
                                "temperature { spherical } "
                                "@amount { % }@ } } } }"),
    WORDS_IN(TRANSFORM, "sphere { 0, 1 @transform { scale 2 % }@ }"),
    WORDS_BODY(CAMERA, "camera { "),
    WORDS_LACK(MESH_CAMERA, "mesh_camera",
               "@camera { mesh_camera { 1, 0 mesh { triangle { 0, x, y } } % "
               "} }@"),
    WORDS_LACK(BOKEH, "focal blur",
               "camera { aperture 1 blur_samples 5 focal_point 0 "
               "@bokeh { pigment { rgb 1 } }@ }"),
    WORDS_BODY(LIGHT, "light_source { <1, 2, 3>, 1"),
    WORDS_IN(LOOKS_LIKE,
             "light_source { y, 1 @looks_like { sphere { 0, 1 } }@ }"),
    WORDS_IN(PROJECTED_THROUGH,
             "light_source { y, 1 @projected_through { sphere { 0, 1 } }@ }"),
    WORDS_IN(BACKGROUND, "@background { rgb 0.5 }@"),
    WORDS_LACK(FOG, "fog", "@fog { distance 10 rgb 1 % }@"),
    WORDS_LACK(RAINBOW, "rainbows",
               "@rainbow { angle 40 width 5 distance 10 direction x "
               "color_map { [0 rgb 1] } % }@"),
    WORDS_IN(SKY_SPHERE, "@sky_sphere { pigment { rgb x } % }@"),
    WORDS_IN(SPLINE, "#declare S = spline { % 0, 1 1, 2 2, 5 3, 2 4, 9 } "
                     "sphere { 0, S(1.5).x }"),
    WORDS_IN(GLOBAL_SETTINGS, "global_settings { % }"),
    WORDS_IN(TRANSPORT, "global_settings { transport { % } }"),
    WORDS_IN(VOLUME_PHOTONS, "global_settings { @volume_photons { % }@ }"),
    WORDS_IN(TEMPORAL, "global_settings { volume_photons { "
                       "@temporal { adaptive % }@ } }"),
    WORDS_LACK(PHOTONS, "POV-Ray's photons",
               "global_settings { @photons { % }@ }"),
    WORDS_LACK(RADIOSITY, "radiosity", "global_settings { @radiosity { % }@ }"),
    WORDS_LACK(GLOBAL_SUBSURFACE, "light below surfaces",
               "global_settings { subsurface { % } } " WORDS_WORN(
                   "finish { subsurface { translucency 0.5 } }")),
    WORDS_IN(DEFAULT, "@#default { pigment { rgb x } }@ sphere { 0, 1 }"),
};

/* ---- words that need more than their row tells ------------------------- */

#define WORDS_ANY(word, with, without)                                         \
    {                                                                          \
        BUILD_KINDS, word, with, without, NULL, NULL                           \
    }
#define WORDS_USE(kind, word, with, without)                                   \
    {                                                                          \
        BUILD_##kind, word, with, without, NULL, NULL                          \
    }
#define WORDS_THERE(kind, word, with, without, scene)                          \
    {                                                                          \
        BUILD_##kind, word, with, without, scene, NULL                         \
    }
#define WORDS_TOLD(kind, word, with, scene, lacks)                             \
    {                                                                          \
        BUILD_##kind, word, with, NULL, scene, lacks                           \
    }

#define WORDS_LATHE "lathe { % 4, <1, 0>, <2, 1>, <1, 2>, <1, 3> }"
#define WORDS_PRISM(more)                                                      \
    "prism { % 0, 1, 9, <0, 0>, <1, 0>, <2, 0>, <2, 1>, <2, 2>, <1, 2>, "      \
    "<0, 2>, <0, 1>, <0, 0> }"
#define WORDS_SWEEP "sphere_sweep { % 4, 0, 1, x, 1, y, 1, 3 * x, 1 }"
#define WORDS_MIRROR "sphere { 0, 1 finish { reflection { 0.1, 0.9 } % } }"
#define WORDS_GLASS "sphere { 0, 1 pigment { rgbf 1 } interior { % } }"
#define WORDS_AVERAGE "color_map { [1 rgb x] [2 rgb y] }"
#define WORDS_FACETS WORDS_WORN("normal { facets coords 1 % }")
#define WORDS_PLATE "\"tests/data/plate.exr\""
#define WORDS_BLUR " aperture 1 blur_samples 5 focal_point y "

#define WORDS_WAVE(word, with)                                                 \
    WORDS_ANY(word, "gradient x " with, "gradient x frequency 3")
#define WORDS_FRACTAL(word, with) WORDS_ANY(word, "mandel 9 " with, "mandel 9")
#define WORDS_PAVEMENT(word, with) WORDS_ANY(word, "pavement " with, "pavement")
#define WORDS_HEIGHTS(word, file)                                              \
    WORDS_THERE(HEIGHT_FIELD, word, word " \"tests/data/" file "\"",           \
                "function 3, 3 { x }", "height_field { % }")
#define WORDS_NO_HEIGHTS(word)                                                 \
    WORDS_TOLD(HEIGHT_FIELD, word, word " \"tests/data/dots.png\"",            \
               "height_field { % }", "'" word "' are not supported")
#define WORDS_READ(kind, word)                                                 \
    WORDS_USE(kind, word, word " \"tests/data/dots." word "\"",                \
              "png \"tests/data/dots_alpha.png\"")
#define WORDS_UNREAD(kind, word)                                               \
    WORDS_TOLD(kind, word, word " \"tests/data/dots.png\"", NULL,              \
               "'" word "' are not read yet")
#define WORDS_DRAWN(kind)                                                      \
    WORDS_READ(kind, "png"), WORDS_READ(kind, "ppm"), WORDS_READ(kind, "tga"), \
        WORDS_READ(kind, "pgm"), WORDS_READ(kind, "gif"),                      \
        WORDS_READ(kind, "jpeg"), WORDS_UNREAD(kind, "bmp"),                   \
        WORDS_UNREAD(kind, "hdr"), WORDS_UNREAD(kind, "iff"),                  \
        WORDS_UNREAD(kind, "sys"), WORDS_UNREAD(kind, "tiff"),                 \
        WORDS_USE(kind, "exr", "exr \"tests/data/tiled_half.exr\"", NULL),     \
        WORDS_USE(kind, "interpolate", "interpolate 2", NULL),                 \
        WORDS_USE(kind, "map_type", "map_type 2", NULL)
/* Pictures that are not drawn are not read either. */
#define WORDS_PICTURE(kind, word)                                              \
    WORDS_USE(kind, word, word " \"tests/data/dots.png\"", NULL)
#define WORDS_PICTURES(kind)                                                   \
    WORDS_PICTURE(kind, "bmp"), WORDS_PICTURE(kind, "exr"),                    \
        WORDS_PICTURE(kind, "gif"), WORDS_PICTURE(kind, "hdr"),                \
        WORDS_PICTURE(kind, "iff"), WORDS_PICTURE(kind, "jpeg"),               \
        WORDS_PICTURE(kind, "pgm"), WORDS_PICTURE(kind, "png"),                \
        WORDS_PICTURE(kind, "ppm"), WORDS_PICTURE(kind, "sys"),                \
        WORDS_PICTURE(kind, "tga"), WORDS_PICTURE(kind, "tiff"),               \
        WORDS_USE(kind, "interpolate", "interpolate 2", NULL),                 \
        WORDS_USE(kind, "map_type", "map_type 2", NULL)

static const struct words_use words_uses[] = {
    WORDS_USE(PIGMENT, "", "bozo", NULL),
    WORDS_USE(DENSITY, "", "bozo", NULL),
    WORDS_USE(CAMERA, "", "location x", NULL),
    WORDS_USE(WARP, "", "turbulence 1", NULL),
    WORDS_USE(VERTEX_VECTORS, "", "2 * ", ""),
    WORDS_USE(FACE_INDICES, "", "+ 1", ""),

    /* Indirect light does not leave it out yet. */
    {BUILD_KINDS, "no_radiosity", NULL, NULL,
     "global_settings { transport { surfaces indirect } } "
     "sphere { 0, 1 % }",
     "no_radiosity"},
    WORDS_TOLD(TRIANGLE, "uv_vectors", "uv_vectors <0, 0>, <1, 0>, <0, 1>",
               "triangle { 0, x, y % " WORDS_MAPPED "}",
               "pigments of some patterns"),
    WORDS_TOLD(TEXTURE, "uv_mapping", NULL,
               WORDS_WORN("texture { uv_mapping pigment { bozo } }"),
               "pigments of some patterns"),
    WORDS_TOLD(SMOOTH_TRIANGLE, "uv_vectors",
               "uv_vectors <0, 0>, <1, 0>, <0, 1>",
               "smooth_triangle { 0, z, x, z, y, z % " WORDS_MAPPED "}",
               "pigments of some patterns"),
    WORDS_TOLD(BICUBIC_PATCH, "uv_vectors",
               "uv_mapping uv_vectors <0, 0>, <1, 0>, <1, 1>, <0, 1>", NULL,
               "patterns are not laid over patches yet"),
    WORDS_USE(BICUBIC_PATCH, "uv_mapping", "uv_mapping", NULL),
    WORDS_THERE(MESH, "obj", "obj \"tests/data/corner.obj\"",
                "triangle { 0, x, z }", "mesh { % }"),
    WORDS_THERE(MESH, "ply", "ply \"tests/data/corner.ply\"",
                "triangle { 0, x, z }", "mesh { % }"),

    WORDS_THERE(TEXT, "ttf", "ttf \"cyrvetic.ttf\"", "internal 1",
                "text { % \"A\" 1, 0 }"),
    WORDS_THERE(TEXT, "internal", "internal 2", "internal 1",
                "text { % \"A\" 1, 0 }"),
    WORDS_USE(POLYNOMIAL, "xyz", "xyz(0, 1, 1): 3", NULL),
    WORDS_USE(JULIA_FRACTAL, "quaternion", "hypercomplex quaternion",
              "hypercomplex"),
    WORDS_USE(JULIA_FRACTAL, "sqr", "hypercomplex exp sqr", "hypercomplex exp"),
    WORDS_USE(JULIA_FRACTAL, "pwr", "hypercomplex pwr(2, 1)", "hypercomplex"),
    WORDS_USE(JULIA_FRACTAL, "slice", "slice <1, 0, 0, 1>, 0.5", NULL),
    WORDS_THERE(LATHE, "linear_spline", "cubic_spline linear_spline",
                "cubic_spline", WORDS_LATHE),
    WORDS_THERE(LATHE, "quadratic_spline", NULL, NULL, WORDS_LATHE),
    WORDS_THERE(LATHE, "cubic_spline", NULL, NULL, WORDS_LATHE),
    WORDS_THERE(LATHE, "bezier_spline", NULL, NULL, WORDS_LATHE),
    WORDS_THERE(PRISM, "linear_spline", "linear_spline", "quadratic_spline",
                WORDS_PRISM()),
    WORDS_THERE(PRISM, "quadratic_spline", NULL, NULL, WORDS_PRISM()),
    WORDS_THERE(PRISM, "cubic_spline", NULL, NULL, WORDS_PRISM()),
    WORDS_THERE(PRISM, "bezier_spline", NULL, NULL,
                "prism { % 0, 1, 8, <0, 0>, <1, 0>, <2, 0>, <2, 1>, <2, 1>, "
                "<1, 2>, <0, 1>, <0, 0> }"),
    WORDS_THERE(PRISM, "conic_sweep", NULL, NULL, WORDS_PRISM()),
    WORDS_THERE(PRISM, "linear_sweep", "conic_sweep linear_sweep",
                "conic_sweep", WORDS_PRISM()),
    WORDS_THERE(SPHERE_SWEEP, "linear_spline", "linear_spline", "cubic_spline",
                WORDS_SWEEP),
    WORDS_THERE(SPHERE_SWEEP, "cubic_spline", "cubic_spline", "linear_spline",
                WORDS_SWEEP),
    WORDS_THERE(SPHERE_SWEEP, "b_spline", "b_spline", "linear_spline",
                WORDS_SWEEP),
    WORDS_USE(BLOB, "component", "component 1, 2, y", NULL),
    WORDS_USE(ISOSURFACE, "evaluate", "evaluate 5, 1.2, 0.9", NULL),
    WORDS_USE(PARAMETRIC, "precompute", "precompute 5 x, y, z", NULL),
    WORDS_HEIGHTS("png", "dots.png"),
    WORDS_HEIGHTS("ppm", "dots.ppm"),
    WORDS_HEIGHTS("pgm", "dots.pgm"),
    WORDS_HEIGHTS("tga", "dots.tga"),
    WORDS_NO_HEIGHTS("bmp"),
    WORDS_NO_HEIGHTS("exr"),
    WORDS_HEIGHTS("gif", "dots.gif"),
    WORDS_NO_HEIGHTS("hdr"),
    WORDS_NO_HEIGHTS("iff"),
    WORDS_HEIGHTS("jpeg", "dots.jpeg"),
    WORDS_HEIGHTS("pot", "dots.pot"),
    WORDS_NO_HEIGHTS("sys"),
    WORDS_NO_HEIGHTS("tiff"),
    WORDS_THERE(HEIGHT_FIELD, "gamma", "gamma 2", NULL,
                "height_field { png \"tests/data/dots.png\" % }"),
    WORDS_THERE(HEIGHT_FIELD, "srgb", "srgb", NULL,
                "height_field { png \"tests/data/dots.png\" % }"),
    WORDS_TOLD(LIGHT_GROUP, "global_lights", NULL, NULL, "light groups"),
    WORDS_USE(CLIPPED_BY, "bounded_by", "bounded_by", "box { 0, 2 }"),
    WORDS_THERE(CLIPPED_BY, "bounded_by",
                "bounded_by { box { 0, 2 } } "
                "clipped_by { bounded_by }",
                "bounded_by { box { 0, 2 } }", "sphere { 0, 1 % }"),

    /* patterns */
    WORDS_TOLD(PIGMENT, "facets", NULL, NULL, "for normals only"),
    WORDS_TOLD(DENSITY, "facets", NULL, NULL, "for normals only"),
    WORDS_TOLD(PIGMENT, "coords", NULL, WORDS_FACETS, "normals"),
    WORDS_TOLD(DENSITY, "coords", NULL, WORDS_FACETS, "normals"),
    WORDS_TOLD(PIGMENT, "size", NULL, WORDS_FACETS, "normals"),
    WORDS_TOLD(DENSITY, "size", NULL, WORDS_FACETS, "normals"),
    WORDS_USE(PIGMENT, "(image_map)",
              "image_map { png \"tests/data/dots.png\" }", NULL),
    /* These no density takes. */
    WORDS_TOLD(DENSITY, "(image_map)", "bozo", NULL, ""),
    WORDS_TOLD(PIGMENT, "(bump_map)", NULL,
               WORDS_WORN("normal { bump_map { png \"tests/data/dots.png\" "
                          "} }"),
               "normals"),
    WORDS_TOLD(DENSITY, "(bump_map)", "bozo", NULL, ""),
    WORDS_TOLD(PIGMENT, "(material_map)", NULL,
               WORDS_WORN("texture { material_map { png "
                          "\"tests/data/dots.png\" texture { "
                          "pigment { rgb 1 } } } }"),
               "pigments of some patterns"),
    WORDS_TOLD(DENSITY, "(material_map)", "bozo", NULL, ""),
    WORDS_TOLD(PIGMENT, "(tiles)", NULL,
               WORDS_WORN("texture { tiles { texture { pigment { rgb x } } "
                          "tile2 texture { pigment { rgb y } } } }"),
               "pigments of some patterns"),
    WORDS_TOLD(DENSITY, "(tiles)", "bozo", NULL, ""),
    WORDS_ANY("average", "average " WORDS_AVERAGE, "bozo"),
    WORDS_ANY("density_file", "density_file vdb \"tests/data/tiles.vdb\"",
              NULL),
    WORDS_ANY("gradient", "gradient x", NULL),
    WORDS_ANY("julia", "julia <0.3, 0.5>, 10", NULL),
    WORDS_ANY("magnet", "magnet 2 mandel 10", "mandel 10"),
    WORDS_ANY("mandel", "mandel 10", NULL),
    WORDS_ANY("slope", "slope y", NULL),
    WORDS_ANY("spiral1", "spiral1 3", NULL),
    WORDS_ANY("spiral2", "spiral2 3", NULL),
    WORDS_ANY("tiling", "tiling 3", NULL),
    WORDS_ANY("(function)", "function { x }", NULL),
    WORDS_ANY("(pigment_pattern)", "pigment_pattern { bozo }", NULL),
    WORDS_ANY("(image_pattern)",
              "image_pattern { png \"tests/data/dots.png\" }", NULL),
    WORDS_ANY("(object)", "object { box { 0, 1 } rgb 0, rgb x }", NULL),
    WORDS_ANY("turbulence", "bozo turbulence 1", "bozo"),
    WORDS_ANY("octaves", "bozo turbulence 1 octaves 3", "bozo turbulence 1"),
    WORDS_ANY("omega", "bozo turbulence 1 omega 0.3", "bozo turbulence 1"),
    WORDS_ANY("lambda", "bozo turbulence 1 lambda 3", "bozo turbulence 1"),
    WORDS_WAVE("frequency", "frequency 2"),
    WORDS_WAVE("phase", "phase 0.3"),
    WORDS_ANY("ramp_wave", "gradient x sine_wave ramp_wave",
              "gradient x sine_wave"),
    WORDS_WAVE("triangle_wave", "triangle_wave"),
    WORDS_WAVE("sine_wave", "sine_wave"),
    WORDS_WAVE("scallop_wave", "scallop_wave"),
    WORDS_WAVE("cubic_wave", "cubic_wave"),
    WORDS_WAVE("poly_wave", "poly_wave 3"),
    WORDS_ANY("noise_generator", "bozo noise_generator 3", "bozo"),
    WORDS_ANY("agate_turb", "agate agate_turb 3", "agate"),
    WORDS_ANY("brick_size", "brick brick_size 3", "brick"),
    WORDS_ANY("mortar", "brick mortar 3", "brick"),
    WORDS_ANY("form", "crackle form x", "crackle"),
    WORDS_ANY("metric", "crackle metric 3", "crackle"),
    WORDS_ANY("offset", "crackle offset 0.3", "crackle"),
    WORDS_ANY("solid", "crackle solid", "crackle"),
    WORDS_ANY("control0", "quilted control0 0.3", "quilted"),
    WORDS_ANY("control1", "quilted control1 0.3", "quilted"),
    WORDS_FRACTAL("exponent", "exponent 3"),
    WORDS_FRACTAL("exterior", "exterior 2, 3"),
    WORDS_FRACTAL("interior", "interior 2, 3"),
    WORDS_PAVEMENT("number_of_sides", "number_of_sides 4"),
    WORDS_PAVEMENT("number_of_tiles", "number_of_tiles 2"),
    WORDS_PAVEMENT("pattern", "number_of_sides 4 number_of_tiles 3 pattern 2"),
    WORDS_ANY("uv_mapping", "bozo uv_mapping", "bozo"),
    WORDS_ANY("vdb", "density_file vdb \"tests/data/tiles.vdb\"", "spherical"),
    WORDS_ANY("nvdb", "density_file nvdb \"tests/data/tiles.nvdb\"",
              "spherical"),
    WORDS_ANY("particles", "density_file particles \"tests/data/dust.ply\"",
              "spherical"),
    WORDS_ANY("radius",
              "density_file particles \"tests/data/corner.ply\" radius 3",
              "density_file particles \"tests/data/corner.ply\""),
    WORDS_ANY("neighbors",
              "density_file particles \"tests/data/dust.ply\" neighbors 2",
              "density_file particles \"tests/data/dust.ply\""),
    WORDS_ANY("voxel",
              "density_file particles \"tests/data/dust.ply\" voxel 0.5",
              "density_file particles \"tests/data/dust.ply\""),
    WORDS_ANY("df3", "density_file df3 \"tests/data/cube.df3\"", "spherical"),
    WORDS_ANY("interpolate",
              "density_file df3 \"tests/data/cube.df3\" interpolate 1",
              "density_file df3 \"tests/data/cube.df3\""),
    WORDS_ANY("fit", "density_file vdb \"tests/data/tiles.vdb\" fit",
              "density_file vdb \"tests/data/tiles.vdb\""),
    WORDS_ANY("up", "density_file vdb \"tests/data/tiles.vdb\" up z",
              "density_file vdb \"tests/data/tiles.vdb\""),

    WORDS_USE(FINISH, "diffuse", "diffuse 0.3", NULL),
    WORDS_USE(FINISH, "phong", "phong 0.3", NULL),
    WORDS_USE(FINISH, "specular", "specular 0.3", NULL),
    WORDS_USE(FINISH, "albedo", "diffuse albedo 0.6", NULL),
    WORDS_USE(FINISH, "reflection", "reflection 0.5", NULL),
    WORDS_TOLD(FINISH, "conserve_energy", NULL, WORDS_MIRROR, "reflection"),
    WORDS_TOLD(FINISH, "reflection_exponent", NULL, WORDS_MIRROR, "reflection"),

    WORDS_USE(WARP, "repeat", "repeat x", "repeat y"),
    WORDS_USE(WARP, "turbulence", "turbulence 2", "repeat x"),
    WORDS_USE(WARP, "black_hole", "black_hole x, 1", "repeat x"),
    WORDS_USE(WARP, "planar", "planar", "repeat x"),
    WORDS_USE(WARP, "cylindrical", "cylindrical", "repeat x"),
    WORDS_USE(WARP, "spherical", "spherical", "repeat x"),
    WORDS_USE(WARP, "toroidal", "toroidal", "repeat x"),
    WORDS_USE(WARP, "cubic", "cubic", "repeat x"),
    WORDS_USE(WARP, "offset", "repeat x offset y", "repeat x"),
    WORDS_USE(WARP, "flip", "repeat x flip y", "repeat x"),
    WORDS_USE(WARP, "strength", "black_hole x, 1 strength 2",
              "black_hole x, 1"),
    WORDS_USE(WARP, "falloff", "black_hole x, 1 falloff 3", "black_hole x, 1"),
    WORDS_USE(WARP, "inverse", "black_hole x, 1 inverse", "black_hole x, 1"),
    WORDS_USE(WARP, "octaves", "turbulence 1 octaves 3", "turbulence 1"),
    WORDS_USE(WARP, "omega", "turbulence 1 omega 0.3", "turbulence 1"),
    WORDS_USE(WARP, "lambda", "turbulence 1 lambda 3", "turbulence 1"),
    WORDS_USE(WARP, "orientation", "toroidal orientation x", "toroidal"),
    WORDS_USE(WARP, "dist_exp", "toroidal dist_exp 0.5", "toroidal"),
    WORDS_USE(WARP, "major_radius", "toroidal major_radius 2", "toroidal"),
    WORDS_TOLD(SLOPE, "point_at", "point_at y",
               WORDS_WORN("pigment { slope "
                          "{ % } }"),
               "pigments of some patterns"),
    WORDS_TOLD(SLOPE, "altitude", "altitude y",
               WORDS_WORN("pigment { slope "
                          "{ x % } }"),
               "pigments of some patterns"),

    WORDS_DRAWN(IMAGE_MAP),
    WORDS_DRAWN(IMAGE_PATTERN),
    WORDS_USE(IMAGE_MAP, "filter", "filter all 0.5", NULL),
    WORDS_USE(IMAGE_MAP, "transmit", "transmit all 0.5", NULL),
    WORDS_USE(IMAGE_MAP, "all", "filter all 0.5", NULL),
    WORDS_USE(IMAGE_MAP, "gamma", "gamma 3", NULL),
    WORDS_USE(IMAGE_MAP, "srgb", "gamma srgb", "gamma 1"),
    WORDS_USE(IMAGE_PATTERN, "gamma", "gamma 3", NULL),
    WORDS_USE(IMAGE_PATTERN, "srgb", "gamma srgb", NULL),
    WORDS_THERE(IMAGE_MAP, "premultiplied", "premultiplied on", NULL,
                WORDS_WORN("pigment { image_map { png "
                           "\"tests/data/dots_alpha.png\" % } }")),
    WORDS_THERE(IMAGE_PATTERN, "premultiplied", "premultiplied on", NULL,
                WORDS_WORN("pigment { image_pattern { png "
                           "\"tests/data/dots_alpha.png\" % } }")),
    WORDS_USE(IMAGE_PATTERN, "use_color", "use_alpha use_color", "use_alpha"),
    WORDS_USE(IMAGE_PATTERN, "use_colour", "use_alpha use_colour", "use_alpha"),
    WORDS_PICTURES(BUMP_MAP),
    WORDS_PICTURES(MATERIAL_MAP),
    WORDS_THERE(TILES, "tile2", "texture { pigment { rgb x } } tile2",
                "texture { pigment { rgb z } } tile2",
                WORDS_WORN("texture { tiles { % texture { pigment "
                           "{ rgb y } } } }")),

    WORDS_USE(INTERIOR, "ior", "ior 1.5", "ior 1"),
    WORDS_TOLD(INTERIOR, "dispersion_samples",
               "dispersion 1.1 "
               "dispersion_samples 9",
               WORDS_GLASS, "dispersion"),
    WORDS_TOLD(INTERIOR, "fade_distance", "fade_power 1 fade_distance 3",
               WORDS_GLASS, "fading in interiors"),
    WORDS_TOLD(INTERIOR, "fade_power", "fade_power 1 fade_distance 3",
               WORDS_GLASS, "fading in interiors"),
    WORDS_TOLD(INTERIOR, "fade_color",
               "fade_power 1 fade_distance 3 "
               "fade_color rgb x",
               WORDS_GLASS, "fading in interiors"),
    WORDS_TOLD(INTERIOR, "fade_colour",
               "fade_power 1 fade_distance 3 "
               "fade_colour rgb x",
               WORDS_GLASS, "fading in interiors"),
    WORDS_THERE(VELOCITY, "vdb", "vdb \"tests/data/kinds.vdb\"", "y",
                WORDS_GLOW "interior { media { scattering { 1, 1 } "
                           "velocity { % } } } }"),
    WORDS_USE(FIRE, "reference", "reference 1500", NULL),

    WORDS_USE(VOLUME_PHOTONS, "preset", "preset paper", NULL),
    WORDS_THERE(TEMPORAL, "adaptive", "adaptive", "1, 2, 1",
                "global_settings { volume_photons { temporal { % } } }"),
    WORDS_USE(CAMERA, "perspective", "orthographic perspective",
              "orthographic"),
    WORDS_USE(CAMERA, "cylinder", "cylinder 1", NULL),
    WORDS_THERE(BACKGROUND, "exr", "exr " WORDS_PLATE, "rgb 0",
                "background { % }"),
    WORDS_THERE(BACKGROUND, "depth", "exr " WORDS_PLATE " depth ray",
                "exr " WORDS_PLATE, "background { % }"),
    WORDS_THERE(BACKGROUND, "layer",
                "exr \"tests/data/plate_layers.exr\" layer \"ViewLayer\"",
                "rgb 0", "background { % }"),
    WORDS_USE(CAMERA, "sky", "sky x look_at z", "look_at z"),
    WORDS_TOLD(CAMERA, "focal_point", WORDS_BLUR, NULL, "focal blur"),
    WORDS_TOLD(CAMERA, "aperture", WORDS_BLUR, NULL, "focal blur"),
    WORDS_TOLD(CAMERA, "blur_samples", WORDS_BLUR, NULL, "focal blur"),
    WORDS_TOLD(CAMERA, "confidence", WORDS_BLUR "confidence 0.5", NULL,
               "focal blur"),
    WORDS_TOLD(CAMERA, "variance", WORDS_BLUR "variance 0.5", NULL,
               "focal blur"),
    WORDS_USE(CAMERA, "angle", "angle 30", NULL),
    WORDS_USE(LIGHT, "area_light", "area_light x, y, 3, 3", NULL),
    WORDS_USE(LIGHT, "point_at", "spotlight point_at x", "spotlight"),
    WORDS_USE(LIGHT, "circular", "area_light x, y, 3, 3 circular",
              "area_light x, y, 3, 3"),
    WORDS_USE(LIGHT, "orient", "area_light x, y, 3, 3 circular orient",
              "area_light x, y, 3, 3 circular"),
    WORDS_USE(LIGHT, "area_illumination",
              "area_light x, y, 3, 3 "
              "area_illumination",
              "area_light x, y, 3, 3"),
    WORDS_USE(SPLINE, "linear_spline", "linear_spline", "cubic_spline"),

    WORDS_USE(GLOBAL_SETTINGS, "srgb", "assumed_gamma srgb", "assumed_gamma 1"),
    WORDS_USE(GLOBAL_SETTINGS, "charset", "charset sys", NULL),
    WORDS_TOLD(GLOBAL_SETTINGS, "irid_wavelength", NULL,
               "global_settings { % } " WORDS_WORN("finish { irid { 0.3 } }"),
               "iridescence"),
    WORDS_TOLD(GLOBAL_SETTINGS, "mm_per_unit", NULL,
               "global_settings { % } " WORDS_WORN(
                   "finish { subsurface { translucency 0.3 } }"),
               "light below surfaces"),
    WORDS_THERE(GLOBAL_SETTINGS, "number_of_waves", NULL, NULL,
                "global_settings { % } " WORDS_WORN("pigment { ripples }")),
    WORDS_THERE(GLOBAL_SETTINGS, "noise_generator", NULL, NULL,
                "global_settings { % } " WORDS_WORN("pigment { bozo }")),
    WORDS_USE(GLOBAL_SETTINGS, "integrator", "integrator path", NULL),
    WORDS_USE(PHOTONS, "save_file", "save_file \"x\"", NULL),
    WORDS_USE(PHOTONS, "load_file", "load_file \"x\"", NULL),
    WORDS_USE(RADIOSITY, "save_file", "save_file \"x\"", NULL),
    WORDS_USE(RADIOSITY, "load_file", "load_file \"x\"", NULL),
};
#endif
