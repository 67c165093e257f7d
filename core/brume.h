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
    bool environment;           /* the background lights the scene         */
    bool physical_units;        /* surfaces and media agree on irradiance;
                                   point lights fall off as 1/d^2          */
};
#define BRUME_GLOBALS_INIT                                                    \
    {{0, 0, 0}, {1, 1, 1}, false, false, false, false}
BRUME_API bool brume_set_globals(brume_scene *scene,
                                 const struct brume_globals *globals,
                                 struct brume_error *err);

enum brume_light_kind { BRUME_LIGHT_POINT, BRUME_LIGHT_SPOT };

struct brume_light {
    enum brume_light_kind kind;
    double location[3], color[3];
    double point_at[3];             /* spot                                */
    double radius, falloff;         /* spot: half-angles                   */
    double tightness;               /* spot: exponent of the cosine        */
    double fade_distance, fade_power;   /* factor 2/(1 + (d/D)^p); 0: none */
    bool shadows;
    bool media_interaction;         /* false: media scatter none of it     */
    bool media_attenuation;         /* the atmosphere attenuates it        */
};
#define BRUME_LIGHT_INIT                                                      \
    {BRUME_LIGHT_POINT, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, 30, 45, 0, 0, 0,     \
     true, true, false}
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
    double ambient[3], emission[3];
    double diffuse, brilliance;
    double phong, phong_size;
    double specular, roughness;
    double metallic;
};
#define BRUME_MATERIAL_INIT                                                   \
    {BRUME_PIGMENT_SOLID, {{0, 0, 0, 0, 0}, {1, 1, 1, 0, 0}}, BRUME_IDENTITY, \
     {0.1, 0.1, 0.1}, {0, 0, 0}, 0.6, 1, 0, 40, 0, 0.05, 0}
BRUME_API int brume_add_material(brume_scene *scene,
                                 const struct brume_material *material,
                                 struct brume_error *err);

enum brume_shape_kind {
    BRUME_SHAPE_SPHERE,     /* a: centre; radius                           */
    BRUME_SHAPE_BOX,        /* a, b: corners                               */
    BRUME_SHAPE_CYLINDER,   /* a: base, b: cap centre; radius; open        */
    BRUME_SHAPE_CONE,       /* as the cylinder; radius at a, radius_b at b */
    BRUME_SHAPE_PLANE,      /* a: normal (outward); radius: distance of the
                               plane from the origin along it; the inside is
                               the half space behind                       */
    BRUME_SHAPE_DISC,       /* a: centre, b: normal; radius, radius_b: hole */
    BRUME_SHAPE_MESH        /* mesh                                        */
};

/* A surface, and the container of its interior's media. */
struct brume_shape {
    enum brume_shape_kind kind;
    double a[3], b[3], radius, radius_b;
    bool open;
    int mesh;               /* from brume_add_mesh                         */
    double transform[3][4];     /* applied after the parameters            */
    int material;           /* -1: invisible, a container only             */
    int interior;           /* -1: none. Needs `hollow` to have effect     */
    bool hollow, inverse;
    bool shadow;            /* casts shadows                               */
};
#define BRUME_SHAPE_INIT                                                      \
    {BRUME_SHAPE_SPHERE, {0, 0, 0}, {0, 0, 0}, 1, 0, false, -1,               \
     BRUME_IDENTITY, -1, -1, false, false, true}
BRUME_API int brume_add_shape(brume_scene *scene,
                              const struct brume_shape *shape,
                              struct brume_error *err);
BRUME_API int brume_add_mesh(brume_scene *scene, const struct mesh *mesh,
                             struct brume_error *err);

/* ---- media ------------------------------------------------------------- */

BRUME_API int brume_add_grid(brume_scene *scene, const struct grid *grid,
                             struct brume_error *err);

enum brume_field_kind { BRUME_FIELD_CONSTANT, BRUME_FIELD_GRID };

/* A scalar function of position, times `scale`. A grid's own transform places
 * it; `transform` follows. */
struct brume_field {
    enum brume_field_kind kind;
    double scale;               /* the value of a constant                 */
    int grid;
    double transform[3][4];
};
#define BRUME_FIELD_INIT {BRUME_FIELD_CONSTANT, 1, -1, BRUME_IDENTITY}
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
};
#define BRUME_MEDIUM_INIT                                                     \
    {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, BRUME_PHASE_ISOTROPIC, 0, 1,            \
     {-1, -1, -1, -1}, 0, BRUME_FIRE_INIT}
BRUME_API int brume_add_medium(brume_scene *scene,
                               const struct brume_medium *medium,
                               struct brume_error *err);
BRUME_API int brume_add_interior(brume_scene *scene, const int *media,
                                 int count, struct brume_error *err);
/* The interior that fills all space outside of other things. */
BRUME_API bool brume_set_atmosphere(brume_scene *scene, int interior,
                                    struct brume_error *err);

/* ---- plan and render --------------------------------------------------- */

enum brume_integrator { BRUME_INTEGRATOR_PATH };
enum brume_backend { BRUME_BACKEND_AUTO, BRUME_BACKEND_CPU,
                     BRUME_BACKEND_CUDA };

struct brume_progress {
    const char *stage;
    double fraction;            /* of the stage, 0 to 1                    */
    double seconds;             /* since the frame began                   */
    double rate;                /* items per second, 0 if not known        */
    const char *item;           /* what is counted: "paths"                */
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
    bool omit_background;       /* radiance without the background that the
                                   camera sees past the scene, for pictures
                                   with alpha                              */
};
#define BRUME_OPTIONS_INIT                                                    \
    {640, 480, 0, 0, 0, 0, BRUME_INTEGRATOR_PATH, BRUME_BACKEND_AUTO, 0, 0,   \
     0, 0, 0, 0, 0, NULL, NULL, NULL, false}
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
    uint64_t bytes;
};

/* Row 0 is the top; pixels outside the rendered part are 0. */
struct brume_frame {
    int width, height;
    float *radiance;            /* 3 per pixel, background included unless
                                   it was omitted                          */
    float *opacity;             /* 3 per pixel, 1 - transmittance of media and
                                   surfaces before the background          */
    float *depth;               /* distance along the view direction to the
                                   first visible surface; infinite if none */
    struct brume_stats stats;
};
BRUME_API bool brume_render(brume_scene *scene,
                            const struct brume_options *options,
                            struct brume_frame *frame,
                            struct brume_error *err);
BRUME_API void brume_frame_free(struct brume_frame *frame);

#endif
