/* surface.h - what the statements about surfaces hold: patterns, maps,
 * pigments, normals, finishes and textures.
 *
 * As for all of model.h nodes never change once their statement is closed.
 * Whatever a pattern chooses from may be nested as deep as a user likes, so
 * that what is asked of a node (its mean colour) is computed when its
 * statement is closed and its parts are complete: nothing recurses. */
#ifndef PARSER_SURFACE_H
#define PARSER_SURFACE_H
#include <stdbool.h>
#include <stddef.h>
#include "core/brume.h"
#include "parser/token.h"
#include "parser/transform.h"
#include "parser/value.h"

struct data_file;
struct function;
struct object;
struct pigment;

/* ---- patterns ---------------------------------------------------------- */

/* A row each: name, word, how many numbers the word takes at least and at
 * most. Where a '(' begins it statements stand for the pattern. */
#define SURFACE_PATTERNS(X)                                                   \
    X(AGATE, "agate", 0, 0) X(AOI, "aoi", 0, 0)                               \
    X(AVERAGE, "average", 0, 0) X(BOXED, "boxed", 0, 0)                       \
    X(BOZO, "bozo", 0, 0) X(BRICK, "brick", 0, 0)                             \
    X(BUMPS, "bumps", 0, 0) X(CELLS, "cells", 0, 0)                           \
    X(CHECKER, "checker", 0, 0) X(CRACKLE, "crackle", 0, 0)                   \
    X(CUBIC, "cubic", 0, 0) X(CYLINDRICAL, "cylindrical", 0, 0)               \
    X(DENSITY_FILE, "density_file", 0, 0) X(DENTS, "dents", 0, 0)             \
    X(FACETS, "facets", 0, 0) X(GRADIENT, "gradient", 1, 1)                   \
    X(GRANITE, "granite", 0, 0) X(HEXAGON, "hexagon", 0, 0)                   \
    X(JULIA, "julia", 2, 2) X(LEOPARD, "leopard", 0, 0)                       \
    X(MAGNET, "magnet", 1, 1) X(MANDEL, "mandel", 1, 1)                       \
    X(MARBLE, "marble", 0, 0) X(ONION, "onion", 0, 0)                         \
    X(PAVEMENT, "pavement", 0, 0) X(PLANAR, "planar", 0, 0)                   \
    X(QUILTED, "quilted", 0, 0) X(RADIAL, "radial", 0, 0)                     \
    X(RIPPLES, "ripples", 0, 0) X(SLOPE, "slope", 1, 1)                       \
    X(SPHERICAL, "spherical", 0, 0) X(SPIRAL1, "spiral1", 1, 1)               \
    X(SPIRAL2, "spiral2", 1, 1) X(SPOTTED, "spotted", 0, 0)                   \
    X(SQUARE, "square", 0, 0) X(TILING, "tiling", 1, 1)                       \
    X(TRIANGULAR, "triangular", 0, 0) X(WAVES, "waves", 0, 0)                 \
    X(WOOD, "wood", 0, 0) X(WRINKLES, "wrinkles", 0, 0)                       \
    X(FUNCTION, "(function)", 0, 0) X(PIGMENT, "(pigment_pattern)", 0, 0)     \
    X(IMAGE, "(image_pattern)", 0, 0) X(OBJECT, "(object)", 0, 0)             \
    X(IMAGE_MAP, "(image_map)", 0, 0) X(BUMP_MAP, "(bump_map)", 0, 0)         \
    X(MATERIAL_MAP, "(material_map)", 0, 0) X(TILES, "(tiles)", 0, 0)

enum pattern_kind {
    PATTERN_NONE,               /* modifiers of a plain colour             */
#define X(kind, word, least, most) PATTERN_##kind,
    SURFACE_PATTERNS(X)
#undef X
    PATTERN_KINDS
};

enum pattern_wave {
    WAVE_RAMP, WAVE_TRIANGLE, WAVE_SINE, WAVE_SCALLOP, WAVE_CUBIC, WAVE_POLY
};

enum warp_kind {
    WARP_NONE, WARP_REPEAT, WARP_BLACK_HOLE, WARP_TURBULENCE, WARP_CYLINDRICAL,
    WARP_SPHERICAL, WARP_TOROIDAL, WARP_PLANAR, WARP_CUBIC
};

/* The classic noise-driven displacement, of patterns and of warps. */
struct turbulence {
    double amount[3];           /* all 0: none                             */
    int octaves;
    double omega, lambda;
};

struct warp {
    enum warp_kind kind;
    double vector[3];           /* repeat: the period along its one axis;
                                   black hole: its place                   */
    double offset[3], flip[3];
    double radius, strength, falloff;   /* of a black hole                 */
    double repeat[3], jitter[3];
    bool inverse, repeats;
    struct turbulence turbulence;
    double orientation[3], dist_exp, major_radius;  /* planar: normal and
                                                       distance in dist_exp */
    transform before;           /* maps since the warp that is older       */
    const struct warp *older;
};

/* A bitmap as the scene names it; or a function in its place. */
struct image_palette {          /* the last one first                      */
    bool transmit;              /* else filter                             */
    int index;                  /* -1: all                                 */
    double amount;
    const struct image_palette *next;
};

struct image {
    const char *format;         /* the word; NULL: none, or a function     */
    struct string name;
    struct location at;
    const struct function *function;
    int map_type, interpolate;
    int use;                    /* enum image_use                          */
    bool once, has_premultiplied, premultiplied;
    double gamma;               /* 0: as the format has it; -1: sRGB       */
    double bump_size;
    const struct image_palette *palette;
    bool clear, indexed;        /* as loaded: it has an alpha, a palette   */
    int id;                     /* in core, plus 1; 0: not yet, -1: none   */
};

enum image_use { IMAGE_USE_DEFAULT, IMAGE_USE_INDEX, IMAGE_USE_COLOR,
                 IMAGE_USE_ALPHA };

struct pattern {
    enum pattern_kind kind;
    int wave;                   /* enum pattern_wave                       */
    double exponent;            /* of poly_wave                            */
    double frequency, phase;
    int noise_generator;        /* 0: that of the scene                    */
    struct turbulence turbulence;
    const struct warp *warps;   /* newest first; maps since: see patterned */
    double agate_turb;
    double vector[3];           /* gradient; julia's number; slope's
                                   direction or point                      */
    int number;                 /* arms; tiling; iterations                */
    int magnet;                 /* 1, 2; 0: none                           */
    int fractal_exponent;
    double exterior[2], interior[2];    /* type and factor                 */
    double brick_size[3], mortar;
    double form[3], metric, offset;
    bool solid;
    double facet_coords, facet_size;    /* 0: not given                    */
    double control[2];
    int sides, tiles, variant;          /* of a pavement                   */
    double slope[2], altitude[3], heights[2];
    bool slope_to_point, has_altitude;
    int grid;                   /* density_file: id in core                */
    transform grid_by;          /* from the grid's own world               */
    const struct data_file *file;
    const struct image *image;
    const struct function *function;
    const struct pigment *pigment;
    const struct object *object;
};

/* Neither turbulence nor warps nor waves change it. */
bool surface_is_plain(const struct pattern *pattern);
/* How many things a block pattern chooses from; 0: it gives a number. */
int surface_choices(enum pattern_kind kind);

/* Its colours where it is given none. */
struct brume_map surface_default_map(const struct pattern *pattern);

/* ---- maps -------------------------------------------------------------- */

/* What a value of 0 to 1 chooses from, or (a list) a block pattern. */
struct map_entry {
    double at;
    double color[5];            /* of a color_map; slope_map: height, slope */
    const void *node;           /* pigment, normal, texture, density       */
    struct map_entry *next;
};

struct map {
    int kind;                   /* enum value_kind: VALUE_COLOR_MAP to
                                   VALUE_DENSITY_MAP                       */
    bool list;                  /* of a block pattern                      */
    int count;
    struct map_entry *first, *last;
};

/* What pigment, normal, density and a patterned texture have in common. */
struct patterned {
    const struct pattern *pattern;  /* NULL: none                          */
    const struct map *map;          /* NULL: the pattern's own             */
    transform by;                   /* after the pattern's warps           */
    int uv_mapping;
};

/* ---- surfaces ---------------------------------------------------------- */

/* Each begins with its patterned. */
struct pigment {
    struct patterned on;
    double color[5];            /* red, green, blue, filter, transmit; of a
                                   pattern: the mean of what it has        */
};

struct normal {
    struct patterned on;        /* no pattern: none                        */
    double amount;
    double accuracy;
    bool no_bump_scale;
};

struct reflection {
    double low[3], high[3];
    double falloff, exponent, metallic;
    bool fresnel;
};

struct finish {
    double ambient[3], emission[3];
    double diffuse[2];          /* seen from the light's side; from behind */
    double brilliance;
    double phong, phong_size;
    double specular, roughness;
    bool diffuse_albedo, phong_albedo, specular_albedo;
    double metallic, crand;
    struct reflection reflection;
    bool conserve_energy;
    double irid, irid_thickness, irid_turbulence;
    double translucency[3];
    bool subsurface;
};

/* A layer, and those below. Of a patterned texture pigment and finish stand
 * for what its pattern chooses from. */
struct texture {
    struct pigment pigment;
    struct normal normal;
    struct finish finish;
    struct patterned on;            /* of textures                         */
    bool varied;                    /* they differ in more than pigments   */
    const struct texture *below;
    transform below_by;             /* since it was put there              */
};

/* POV-Ray's default texture: black, ambient 0.1, diffuse 0.6. */
extern const struct texture model_default_texture;

void surface_pattern_start(struct pattern *pattern, enum pattern_kind kind);
/* The mean of what a pattern chooses from, when all is said. */
void surface_mean_pigment(struct pigment *pigment);
void surface_mean_texture(struct texture *texture);
/* Whether a texture and its layers are more than colours under one finish:
 * highlights of lower layers count as more, normals too. */
bool surface_is_varied(const struct texture *texture);
/* The list of a checker of two colours, which core draws; else NULL. */
const struct map *surface_checker(const struct pigment *pigment);
/* Of densities the first three count. */
void surface_mean(const struct patterned *on, double color[5]);

/* Whether a density chooses from what is not grey. */
bool surface_is_colored(const struct patterned *on);

void surface_texture_transform(struct texture *texture, const transform *by);

/* Nothing of a surface shows: it lets all light through and has no highlight.
 * Such an object is but a container for its interior. */
bool model_is_invisible(const struct texture *texture);
/* No light comes through, so that layers below it do not show. */
bool model_is_opaque(const struct texture *texture);
/* `by` is applied to the texture after its own maps. */
void model_material(const struct texture *texture, const transform *by,
                    struct brume_material *out);

#endif
