/* brume.h - the public C API: build a scene, render frames, read results.
 *
 * The parser is one user of this header, any other program may be another.
 * No global state: two scenes can be built and rendered by two threads; one
 * scene may be used by one thread at a time.
 *
 * Lengths are scene units; colours are linear Rec.709; angles are degrees as
 * in the scene language; transforms are rows of A|b with p' = A p + b.
 * Add calls copy what they are given, check it, and return an id >= 0, or -1
 * with `err` set. Ids count from 0 for each kind. Structures have an INIT
 * value with every default: start from it, so that new members stay at theirs.
 * Light follows POV-Ray unless the scene's globals say otherwise (brume.5). */
#ifndef CORE_BRUME_H
#define CORE_BRUME_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "lib/error.h"
#include "lib/grid.h"
#include "lib/mesh.h"

#if defined(__GNUC__)
#define BRUME_API __attribute__((visibility("default")))
#else
#define BRUME_API
#endif

#define BRUME_VERSION "0.1.0"

typedef struct brume_scene brume_scene;

#include "core/particles.h"
#include "core/volume_photons.h"

#define BRUME_IDENTITY {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}

/* ---- scene ------------------------------------------------------------- */

BRUME_API brume_scene *brume_scene_new(struct brume_error *err);
BRUME_API void brume_scene_free(brume_scene *scene);

enum brume_camera_kind { BRUME_CAMERA_PERSPECTIVE, BRUME_CAMERA_ORTHOGRAPHIC };

/* A pixel at (u, v) in [-1/2, 1/2], v upward, sees along direction + u right
 * + v up from location; orthographic: along direction from location + u right
 * + v up. */
struct brume_camera {
    enum brume_camera_kind kind;
    double location[3], direction[3], up[3], right[3];
};
#define BRUME_CAMERA_INIT                                                     \
    {BRUME_CAMERA_PERSPECTIVE, {0, 0, 0}, {0, 0, 1}, {0, 1, 0},               \
     {1.3333333333333333, 0, 0}}
BRUME_API bool brume_set_camera(brume_scene *scene,
                                const struct brume_camera *camera,
                                struct brume_error *err);

/* What is transported belongs to the scene, never to the integrator. */
struct brume_globals {
    double background[3];
    double ambient_light[3];
    bool media_multiple;        /* else single scattering                  */
    bool surfaces_indirect;     /* else direct light, ambient as in POV-Ray;
                                   with it, ambient terms are left out     */
    bool environment;           /* the sky or background lights the scene  */
    bool physical_units;        /* surfaces and media agree on irradiance;
                                   all but parallel light falls off as
                                   1/d^2                                   */
};
#define BRUME_GLOBALS_INIT                                                    \
    {{0, 0, 0}, {1, 1, 1}, false, false, false, false}
BRUME_API bool brume_set_globals(brume_scene *scene,
                                 const struct brume_globals *globals,
                                 struct brume_error *err);

/* The sky as a picture around the scene, seen in place of the background and,
 * with globals.environment, a light. Column x of `width` lies at the azimuth
 * 2 pi (x/width - 1/2), counted from +z of the map's space to its +x; row 0 is
 * about +y. `radiance` is copied: 3 floats a texel, finite, >= 0. In place of
 * a picture it may be a function of the world's unit direction, whose first
 * three results are the radiance (below 0 it counts as 0). */
struct brume_sky {
    int width, height;          /* 0: none, the background is all          */
    const float *radiance;
    double scale;
    bool interpolate;           /* between texels' centres                 */
    double transform[3][4];     /* map space to world; no shift counts     */
    int function;               /* from brume_add_function; -1: the picture */
};
#define BRUME_MAX_SKY 32768     /* texels on a side */
#define BRUME_SKY_INIT {0, 0, NULL, 1, true, BRUME_IDENTITY, -1}
BRUME_API bool brume_set_sky(brume_scene *scene, const struct brume_sky *sky,
                             struct brume_error *err);

/* A picture that was made elsewhere: of `width` x `height` pixels, by rows from
 * the top, which the rendered one has to have too; width 0: there is none. It
 * is seen by the eye alone, each pixel as a piece at its depth: media before
 * it are before it, and what is behind shows where alpha is below 1. It is
 * copied. */
struct brume_plate {
    int width, height;
    const float *radiance;      /* 3 a pixel, finite, associated with alpha */
    const float *alpha;         /* in [0, 1]; NULL: 1                      */
    const float *depth;         /* scene units; NULL, and where a number is
                                   not finite or not above 0: the pixel is
                                   behind all there is                     */
    bool along_ray;             /* depths are along the rays through pixels,
                                   and not along the direction of view     */
};
#define BRUME_PLATE_INIT {0, 0, NULL, NULL, NULL, false}
BRUME_API bool brume_set_plate(brume_scene *scene,
                               const struct brume_plate *plate,
                               struct brume_error *err);

enum brume_light_kind { BRUME_LIGHT_POINT, BRUME_LIGHT_SPOT,
                        BRUME_LIGHT_CYLINDER };

/* A cylinder's light is parallel too, within a tube about the axis from
 * location to point_at; distances of parallel light count along that axis. */
struct brume_light {
    enum brume_light_kind kind;
    double location[3], color[3];
    double point_at[3];             /* all but the plain point light       */
    double radius, falloff;         /* spot: half-angles; cylinder: lengths */
    double tightness;               /* exponent of the spot's cosine, of the
                                       cylinder's 1 - distance / falloff   */
    double fade_distance, fade_power;   /* factor 2/(1 + (d/D)^p); 0: none */
    bool shadows;                   /* false: no highlights either         */
    bool media_interaction;         /* false: media scatter none of it     */
    bool media_attenuation;         /* the atmosphere attenuates it        */
    bool parallel;
    /* Spread over the rectangle of two axes about location, or the ellipse in
     * it. POV-Ray's grid of lamps tends to this: it is sampled as an area,
     * not as a grid, so adaptive and jitter have nothing to tell. */
    bool area;
    double area_axis[2][3];
    int area_size[2];               /* lamps along the axes; 1: no width   */
    bool area_circular, area_orient;    /* orient: a disc that faces what it
                                           lights, half of axis 0 in radius */
    bool area_illumination;         /* else the area tells in shadows only;
                                       physical units always have it       */
    int looks_like, projected_through;  /* unsupported: other than -1 fails */
};
#define BRUME_LIGHT_INIT                                                      \
    {BRUME_LIGHT_POINT, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, 30, 45, 0, 0, 0,     \
     true, true, false, false, false, {{1, 0, 0}, {0, 1, 0}}, {1, 1}, false,  \
     false, false, -1, -1}
BRUME_API int brume_add_light(brume_scene *scene,
                              const struct brume_light *light,
                              struct brume_error *err);

/* ---- surfaces ---------------------------------------------------------- */

enum brume_pigment_kind { BRUME_PIGMENT_SOLID, BRUME_PIGMENT_CHECKER };

/* Colours are red, green, blue, filter, transmit. */
struct brume_material {
    enum brume_pigment_kind pigment;
    double color[2][5];
    double pigment_transform[3][4];     /* pattern space to world          */
    int function;           /* from brume_add_function, of a point of pattern
                               space, in place of the above; -1: none      */
    double ambient[3], emission[3];
    double diffuse, brilliance;
    double phong, phong_size;
    double specular, roughness;
    double metallic;
};
#define BRUME_MATERIAL_INIT                                                   \
    {BRUME_PIGMENT_SOLID, {{0, 0, 0, 0, 0}, {1, 1, 1, 0, 0}}, BRUME_IDENTITY, \
     -1, {0.1, 0.1, 0.1}, {0, 0, 0}, 0.6, 1, 0, 40, 0, 0.05, 0}
BRUME_API int brume_add_material(brume_scene *scene,
                                 const struct brume_material *material,
                                 struct brume_error *err);

/* Members of struct brume_shape that a kind reads, and the layout of `data`
 * (numbers in POV-Ray's order where it has one). Angles and axes as there. */
enum brume_shape_kind {
    BRUME_SHAPE_SPHERE,     /* a: centre; radius                           */
    BRUME_SHAPE_BOX,        /* a, b: corners                               */
    BRUME_SHAPE_CYLINDER,   /* a: base, b: cap centre; radius; open        */
    BRUME_SHAPE_CONE,       /* as the cylinder; radius at a, radius_b at b */
    BRUME_SHAPE_PLANE,      /* a: normal (outward); radius: distance of the
                               plane from the origin along it; the inside is
                               the half space behind                       */
    BRUME_SHAPE_DISC,       /* a: centre, b: normal; radius, radius_b: hole */
    BRUME_SHAPE_MESH,       /* mesh; inside_vector in a, zero: no inside   */
    BRUME_SHAPE_TORUS,      /* about y: radius major, radius_b minor       */
    BRUME_SHAPE_QUADRIC,    /* data: the 10 numbers A to J                 */
    BRUME_SHAPE_POLY,       /* order 2 to 35; data: its (order + 1) (order
                               + 2) (order + 3) / 6 coefficients           */
    BRUME_SHAPE_SUPERELLIPSOID, /* a[0]: e, a[1]: n                        */
    BRUME_SHAPE_OVUS,       /* about y: radius of the bottom ball, radius_b of
                               the top one                                 */
    BRUME_SHAPE_BLOB,       /* radius: threshold; data: BRUME_BLOB_NUMBERS a
                               component: 0 sphere or 1 cylinder, strength,
                               radius, centre or base xyz, end xyz, then its
                               transform of 12                             */
    BRUME_SHAPE_LATHE,      /* curve; data: x, y a point                   */
    BRUME_SHAPE_PRISM,      /* curve, conic, open; radius: height 1,
                               radius_b: height 2; data: x, z a point, closed
                               sub-shapes one after the other              */
    BRUME_SHAPE_SOR,        /* open; data: radius, height a point          */
    BRUME_SHAPE_SPHERE_SWEEP,   /* curve; data: x, y, z, radius a sphere;
                               accuracy: depth tolerance                   */
    BRUME_SHAPE_JULIA,      /* julia_kind, julia_function, order: the most
                               iterations; accuracy: precision; data: the
                               parameter's 4, the slice's normal's 4 and its
                               distance, the exponent of pwr: re, im        */
    BRUME_SHAPE_ISOSURFACE, /* function[0], contained, a, b, radius,
                               threshold, accuracy, max_gradient, evaluate,
                               open, order: max_trace, 0 for all           */
    BRUME_SHAPE_PARAMETRIC, /* function[0..2], contained, a, b, radius,
                               accuracy, max_gradient, order: precompute
                               depth; data: u and v at the lower corner, u
                               and v at the upper one                      */
    BRUME_SHAPE_POLYGON,    /* data: x, y, z a point, closed sub-shapes one
                               after the other                             */
    BRUME_SHAPE_BICUBIC_PATCH,  /* steps: u_steps, v_steps; accuracy:
                               flatness; data: 16 points                   */
    BRUME_SHAPE_HEIGHT_FIELD,   /* steps: columns, rows; data: heights of 0
                               to 1 by rows, the first at z = 1; radius:
                               water level; smooth                         */
    BRUME_SHAPE_TEXT,       /* radius: thickness along z; data: for each
                               glyph the number of its segments, then 8
                               numbers a segment: x, y of a cubic Bezier's
                               four points (lib/font.h makes it)           */
    BRUME_SHAPE_UNION,      /* parts; those of a union that is not itself a
                               part are as good as added one by one        */
    BRUME_SHAPE_MERGE, BRUME_SHAPE_INTERSECTION,    /* parts               */
    BRUME_SHAPE_DIFFERENCE  /* parts: the first less the others            */
};

enum { BRUME_BLOB_NUMBERS = 21 };

enum brume_curve { BRUME_CURVE_LINEAR, BRUME_CURVE_QUADRATIC,
                   BRUME_CURVE_CUBIC, BRUME_CURVE_BEZIER,
                   BRUME_CURVE_B_SPLINE };

enum brume_julia_kind { BRUME_JULIA_QUATERNION, BRUME_JULIA_HYPERCOMPLEX };

enum brume_julia_function {
    BRUME_JULIA_SQR, BRUME_JULIA_CUBE, BRUME_JULIA_EXP,
    BRUME_JULIA_RECIPROCAL, BRUME_JULIA_SIN, BRUME_JULIA_ASIN,
    BRUME_JULIA_SINH, BRUME_JULIA_ASINH, BRUME_JULIA_COS, BRUME_JULIA_ACOS,
    BRUME_JULIA_COSH, BRUME_JULIA_ACOSH, BRUME_JULIA_TAN, BRUME_JULIA_ATAN,
    BRUME_JULIA_TANH, BRUME_JULIA_ATANH, BRUME_JULIA_LN, BRUME_JULIA_PWR
};

/* What an isosurface or a parametric surface is cut by. */
enum brume_contained {
    BRUME_CONTAINED_BOX,        /* a, b: corners                           */
    BRUME_CONTAINED_SPHERE      /* a: centre; radius                       */
};

/* As a part's material or interior: that of what it is a part of. */
#define BRUME_INHERIT (-2)

/* A surface, and the container of its interior's media.
 *
 * A part is seen only as part of a composite (or not at all: for queries).
 * Parts are shapes with smaller ids; one shape may be part of several. The
 * inside of a composite, whose interior is the first that it or its parts
 * name, is a single container; `hollow` and `shadow` are those of its own.
 *
 * clips cut away what is outside any of them, the surface and the inside,
 * without closing the hole. `inverse` comes before them. */
struct brume_shape {
    enum brume_shape_kind kind;
    double a[3], b[3], radius, radius_b;
    bool open;
    int mesh;               /* from brume_add_mesh                         */
    double transform[3][4];     /* applied after the parameters, to parts and
                               clips too                                   */
    int material;           /* -1: invisible, a container only             */
    int interior;           /* -1: none. Needs `hollow` to have effect     */
    bool hollow, inverse;
    bool shadow;            /* casts shadows                               */
    bool part;
    const int *parts, *clips;   /* shapes                                  */
    size_t part_count, clip_count;
    const double *data;
    size_t count;           /* of data                                     */
    enum brume_curve curve;
    bool conic, smooth;
    int order, steps[2];
    enum brume_julia_kind julia_kind;
    enum brume_julia_function julia_function;
    int function[3];        /* from brume_add_function                     */
    enum brume_contained contained;
    double threshold, accuracy, max_gradient;
    bool evaluate;          /* adapt the gradient: evaluate_factors        */
    double evaluate_factors[3];
};
#define BRUME_SHAPE_INIT                                                      \
    {BRUME_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0}, 1, 0, false, -1,               \
     BRUME_IDENTITY, -1, -1, false, false, true, false, NULL, NULL, 0, 0,     \
     NULL, 0, BRUME_CURVE_LINEAR, false, false, 0, {0, 0},                    \
     BRUME_JULIA_QUATERNION, BRUME_JULIA_SQR, {-1, -1, -1},                   \
     BRUME_CONTAINED_BOX, 0, 0.001, 1.1, false, {0, 0, 0}}
BRUME_API int brume_add_shape(brume_scene *scene,
                              const struct brume_shape *shape,
                              struct brume_error *err);
BRUME_API int brume_add_mesh(brume_scene *scene, const struct mesh *mesh,
                             struct brume_error *err);
/* The same without a copy: the scene takes a share, and the mesh must not be
 * changed any more. A film knows it again by that from frame to frame. */
BRUME_API int brume_share_mesh(brume_scene *scene, struct mesh *mesh,
                               struct brume_error *err);

/* ---- queries of shapes ------------------------------------------------- */
/* Of any shape, part or not, in double. What they need is made at a shape's
 * first query and kept. */

/* The surface nearest to the origin along the direction (any length): 1 with
 * the point and the unit normal on it, 0 if there is none, -1 with err set. */
BRUME_API int brume_trace(brume_scene *scene, int shape,
                          const double origin[3], const double direction[3],
                          double point[3], double normal[3],
                          struct brume_error *err);
/* 1 where the point is inside, 0 where it is not, -1 with err set. */
BRUME_API int brume_inside(brume_scene *scene, int shape,
                           const double point[3], struct brume_error *err);
/* Corners of the box that POV-Ray's min_extent and max_extent report: bounds
 * transformed as boxes, so not always the tightest; BRUME_ENDLESS where there
 * are none. */
#define BRUME_ENDLESS 1e10
BRUME_API bool brume_extent(brume_scene *scene, int shape, double lowest[3],
                            double highest[3], struct brume_error *err);

/* ---- media ------------------------------------------------------------- */

BRUME_API int brume_add_grid(brume_scene *scene, const struct grid *grid,
                             struct brume_error *err);
/* As brume_share_mesh. */
BRUME_API int brume_share_grid(brume_scene *scene, struct grid *grid,
                               struct brume_error *err);

enum brume_field_kind { BRUME_FIELD_CONSTANT, BRUME_FIELD_GRID,
                        BRUME_FIELD_FUNCTION };

/* A scalar function of position, times `scale`; of functions also a colour. A
 * grid's own transform places it; `transform` follows. Functions are evaluated
 * where their values are needed, those below 0 count as 0. Where one of its
 * containers has no bounds a function is drawn from a grid over all that has,
 * so fine that the root of the mean squared error is at most 1 % of that of
 * the mean square, or of some two million samples, and a warning tells. */
struct brume_field {
    enum brume_field_kind kind;
    double scale;               /* the value of a constant                 */
    int grid;
    double transform[3][4];
    int function;               /* from brume_add_function, of x, y, z     */
    int component;              /* the result that counts, from 0, or
                                   BRUME_COMPONENT_COLOR: the first three,
                                   of a density                            */
};
#define BRUME_COMPONENT_COLOR (-1)
#define BRUME_FIELD_INIT {BRUME_FIELD_CONSTANT, 1, -1, BRUME_IDENTITY, -1, 0}
BRUME_API int brume_add_field(brume_scene *scene,
                              const struct brume_field *field,
                              struct brume_error *err);

enum brume_phase {
    BRUME_PHASE_ISOTROPIC = 1, BRUME_PHASE_MIE_HAZY = 2,
    BRUME_PHASE_MIE_MURKY = 3, BRUME_PHASE_RAYLEIGH = 4,
    BRUME_PHASE_HENYEY_GREENSTEIN = 5       /* POV-Ray's numbers           */
};

enum brume_brightness {
    BRUME_BRIGHTNESS_PHYSICAL,      /* luminance of Planck's law over that at
                                       `reference` kelvin                  */
    BRUME_BRIGHTNESS_NORMALIZED,    /* the largest channel is 1            */
    BRUME_BRIGHTNESS_CONSTANT,      /* luminance 1                         */
    BRUME_BRIGHTNESS_TOTAL          /* luminance (T / reference)^4, as the
                                       black body's whole radiance         */
};

/* Thermal emission; kelvin = scale * temperature + offset. */
struct brume_fire {
    bool on;
    int temperature;            /* field                                   */
    int amount;                 /* field multiplying the emission, or -1   */
    double kelvin_scale, kelvin_offset;
    double intensity, reference;
    enum brume_brightness brightness;
    bool additive;              /* per length as it is; else times sigma_a */
};
#define BRUME_FIRE_INIT                                                       \
    {false, -1, -1, 1000, 0, 1, 2000, BRUME_BRIGHTNESS_PHYSICAL, false}

/* How what it is made of moves, along which the frames of a film are compared
 * (brume_film.h): three grids, of which `scale` times the numbers at a place
 * are its move from this frame to the next, in the grids' own space, or in
 * voxels; grids of components have `any_sign`. `transform` follows. */
struct brume_velocity {
    bool on, voxels;
    int grid[3];
    double scale;
    double transform[3][4];
};
#define BRUME_VELOCITY_INIT {false, false, {-1, -1, -1}, 1, BRUME_IDENTITY}

enum { BRUME_MAX_DENSITIES = 4, BRUME_MAX_INTERIOR_MEDIA = 8 };

/* Coefficients per scene unit at density 1; density is the product of the
 * fields, 1 without any. */
struct brume_medium {
    double absorption[3], emission[3], scattering[3];
    enum brume_phase phase;
    double eccentricity;        /* Henyey-Greenstein's g, in (-1, 1); > 0 is
                                   forward                                 */
    double extinction;          /* attenuation by scattering is this times
                                   scattering (single scattering only)     */
    int density[BRUME_MAX_DENSITIES], densities;
    struct brume_fire fire;
    struct brume_velocity velocity;
};
#define BRUME_MEDIUM_INIT                                                     \
    {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, BRUME_PHASE_ISOTROPIC, 0, 1,            \
     {-1, -1, -1, -1}, 0, BRUME_FIRE_INIT, BRUME_VELOCITY_INIT}
BRUME_API int brume_add_medium(brume_scene *scene,
                               const struct brume_medium *medium,
                               struct brume_error *err);
BRUME_API int brume_add_interior(brume_scene *scene, const int *media,
                                 int count, struct brume_error *err);
/* The interior that fills all space outside of other things. */
BRUME_API bool brume_set_atmosphere(brume_scene *scene, int interior,
                                    struct brume_error *err);

#include "core/brume_function.h"

/* ---- plan and render --------------------------------------------------- */

struct brume_progress {
    const char *stage;
    double fraction;            /* of the stage, 0 to 1                    */
    double seconds;             /* since the frame began                   */
    double rate;                /* items per second, 0 if not known        */
    const char *item;           /* what is counted: "paths"                */
};

/* How surfaces are found: pictures are the same. BOTH: a kd-tree of what stands
 * still from frame to frame, kept in a brume_still; a BVH of the rest. */
enum brume_tree { BRUME_TREE_BVH, BRUME_TREE_KD, BRUME_TREE_BOTH };
struct brume_still;
BRUME_API struct brume_still *brume_still_new(struct brume_error *err);
BRUME_API void brume_still_free(struct brume_still *still);

/* A picture that is not finished: with it, it goes on to the same bytes. */
struct brume_part {
    const char *backend;        /* that rendered it                        */
    uint32_t samples;           /* of each pixel                           */
    uint32_t left, met;         /* of the pass that it is in; checks passed */
    double error;
    uint64_t count[8];
    void *pixel;                /* sums of the pixels                      */
    size_t bytes;
    double seconds;             /* in which it must be kept, or it is not;
                                   0: as long as it takes                  */
};

/* Keeps such parts: called when the rendering is stopped, and each minute,
 * from the thread that renders. */
struct brume_keeper {
    void *user;
    void (*save)(void *user, uint32_t frame, const struct brume_part *part);
    /* Asked for the part of a picture that is begun: fills in all but the
     * backend, which has to be the same, and `bytes` at `pixel`, which are 0.
     * False: there is none, and they are left so. */
    bool (*load)(void *user, uint32_t frame, struct brume_part *part);
};

/* Rendering goes on until `spp` samples, or the estimated relative error
 * `error`, or `seconds`, whichever are given (> 0), the first to be met. */
struct brume_options {
    int width, height;
    int x0, y0, x1, y1;         /* part to render, half open; all 0: whole */
    enum brume_integrator integrator;
    enum brume_backend backend;
    int spp;
    double error, seconds;
    int threads;                /* 0: as many as processors                */
    uint64_t seed;
    uint32_t frame;             /* number of the frame in its film         */
    uint64_t memory;            /* bytes that may be used, 0: no limit     */
    /* Called from the rendering thread; false stops with BRUME_STOPPED. */
    bool (*progress)(void *user, const struct brume_progress *progress);
    void (*warn)(void *user, const char *text);
    void *user;
    bool omit_background;       /* radiance without the plate's and without
                                   the background's that the camera sees
                                   past the scene, for pictures with alpha */
    enum brume_tree tree;
    int tree_stack;             /* entries of the kd-tree's, 1 to 32; 0: 4 */
    struct brume_still *still;  /* of BRUME_TREE_BOTH, or NULL             */
    struct brume_photon_options photons;
    const struct brume_keeper *keeper;  /* or NULL                         */
    bool tree_on_cpu;           /* where else a GPU would build it         */
};
#define BRUME_OPTIONS_INIT                                                    \
    {640, 480, 0, 0, 0, 0, BRUME_INTEGRATOR_PATH, BRUME_BACKEND_AUTO, 0, 0,   \
     0, 0, 0, 0, 0, NULL, NULL, NULL, false, BRUME_TREE_BVH, 0, NULL,         \
     BRUME_PHOTONS_INIT, NULL, false}
/* The error aimed at when neither spp, error nor seconds is given, and the
 * most samples that an error is chased with. */
#define BRUME_DEFAULT_ERROR 0.05
#define BRUME_MAX_SPP 65536

enum { BRUME_MAX_STAGES = 16, BRUME_MAX_NOTES = 64 };

struct brume_stage {
    char name[16];
    bool runs;
    char reason[160];
    uint64_t bytes;             /* allocated for it                        */
};

/* What a frame needs and why; notes tell of grids, value and kelvin ranges. */
struct brume_plan {
    int stages, notes;
    struct brume_stage stage[BRUME_MAX_STAGES];
    char note[BRUME_MAX_NOTES][256];
};
BRUME_API bool brume_plan_frame(brume_scene *scene,
                                const struct brume_options *options,
                                struct brume_plan *plan,
                                struct brume_error *err);

/* On a GPU, by its own clock. */
struct brume_device_seconds {
    double upload, tree;            /* of the scene; its tree, built there */
    double trace, gather;           /* of photons; the field               */
    double lines, paths;            /* straight lines, and what has noise  */
};

struct brume_stats {
    char backend[64];
    uint64_t paths, rays, shadow_rays, collisions, lookups;
    uint64_t majorant_exceeded;     /* must be 0                           */
    uint64_t overflow;              /* media left out where more overlap than
                                       a ray can follow                    */
    uint64_t rejected;              /* samples that were not finite, left out */
    int spp;
    double error;                   /* estimated relRMSE (DESIGN.md)       */
    double seconds_prepare, seconds_render;
    struct brume_device_seconds device;     /* 0: no GPU                   */
    uint64_t bytes;
    /* Of large meshes of a film: trees that were built, and had from the frame
     * before. */
    uint64_t trees_built, trees_kept;
    int worker;                     /* of a film, from 0: its device       */
    /* Of large arrays, to that device, since the worker's last picture. */
    uint64_t uploaded;
    uint64_t allocated;             /* bytes of its memory, anew           */
    struct brume_photon_stats photons;
};

/* Row 0 is the top; pixels outside the rendered part are 0. */
struct brume_frame {
    int width, height;
    float *radiance;            /* 3 per pixel, background included unless
                                   it was omitted                          */
    float *opacity;             /* 3 per pixel, 1 - transmittance of media and
                                   surfaces before plate and background    */
    float *depth;               /* distance along the view direction to the
                                   first visible surface, or the plate;
                                   infinite if none                        */
    struct brume_stats stats;
};
BRUME_API bool brume_render(brume_scene *scene,
                            const struct brume_options *options,
                            struct brume_frame *frame,
                            struct brume_error *err);
BRUME_API void brume_frame_free(struct brume_frame *frame);

#include "core/brume_film.h"

#endif
