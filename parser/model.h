/* model.h - what the scene language's values other than numbers hold.
 *
 * Nodes lie in the parse arena and never change once their statement is
 * closed, so that identifiers share them; to modify one is to copy it. What
 * can be transformed after it was made is kept as a pair of the node and the
 * map that was applied since. Units are those of core/brume.h. */
#ifndef PARSER_MODEL_H
#define PARSER_MODEL_H
#include <stdbool.h>
#include <stddef.h>
#include "core/brume.h"
#include "parser/surface.h"
#include "parser/token.h"
#include "parser/transform.h"

/* ---- maps -------------------------------------------------------------- */

/* transform { ... }: what `inverse` asks for is done when it is used. */
struct transform_block {
    transform by;
    int inverse;
};
transform model_transform_result(const struct transform_block *block);

/* ---- media ------------------------------------------------------------- */

/* One factor of a medium's density: a colour, or a pattern; times a colour. */
struct density {
    struct patterned on;
    double color[3];            /* of a pattern: the mean of what it has   */
    bool colored;               /* a pattern's colours are not all grey    */
};
/* Of a pattern that core has as a grid: a file without a map of its own. */
bool model_density_is_grid(const struct density *density);
/* Of any other pattern. */
bool model_density_is_patterned(const struct density *density);
void model_mean_density(struct density *density);

struct fire {
    bool on;
    bool has_amount;
    struct density temperature, amount;
    double kelvin[2];           /* factor and offset                       */
    double intensity, reference;
    int brightness;             /* enum brume_brightness                   */
    int additive;               /* 1: density has no say                   */
    int preset;                 /* enum fire_preset; -1: none              */
};

/* The values of the word `preset`. */
enum fire_preset { FIRE_CYCLES, FIRE_PBRT, FIRE_HOUDINI };
void model_fire_preset(struct fire *fire, enum fire_preset preset);
void model_fire_transform(struct fire *fire, const transform *by);

enum velocity_units { VELOCITY_PER_SECOND, VELOCITY_PER_FRAME,
                      VELOCITY_VOXELS };

/* What a medium's matter does from frame to frame. */
struct velocity {
    bool on, file;
    bool known;                 /* its grids are in core                   */
    int said;                   /* vectors and files                       */
    double constant[3];
    int grid[3];                /* in core, of the components              */
    double fps, strength;
    int units;                  /* enum velocity_units                     */
    transform by;
};

struct media {
    double absorption[3], emission[3], scattering[3];
    int type;                   /* enum brume_phase, of scattering         */
    double eccentricity, extinction;
    double tint[3];             /* product of all the densities' colours   */
    struct density density[BRUME_MAX_DENSITIES];
    int densities;
    struct fire fire;
    struct velocity velocity;
};
/* Applies `by` to the densities, the fire's fields and the velocity that are
 * there now. */
void model_media_transform(struct media *media, const transform *by);

struct interior {
    const struct media *media[BRUME_MAX_INTERIOR_MEDIA];
    int count;
    double ior, caustics, dispersion;
    int dispersion_samples;
    double fade_distance, fade_power, fade_color[3];
    bool warned;                /* that it sits in a solid object          */
};

/* ---- objects ----------------------------------------------------------- */

struct placed_texture {
    struct texture *what;           /* NULL: none                          */
    transform by;
    bool owned;                     /* nothing else refers to it           */
};

struct placed_interior {
    struct interior *what;          /* NULL: none                          */
    transform by;
};

struct material {
    struct placed_texture texture, inner;   /* inner: interior_texture     */
    struct placed_interior interior;
};

struct kept_mesh;

enum { MODEL_LISTS = 7 };

/* Read from a file or from triangles; given to core when first placed. */
struct model_mesh {
    struct mesh *mesh;              /* freed once core has it              */
    struct kept_mesh *literal;      /* that it begins as, to be kept;      */
    size_t listed[MODEL_LISTS];     /* items that there were at its end    */
    const struct kept_mesh *taken;  /* that it was taken from, and shares  */
    int id;                         /* in core, or -1                      */
    struct model_mesh *next;        /* of all meshes of the scene          */
};

/* OBJECT_GROUP: shape.kind tells how the members make one. */
enum object_kind { OBJECT_SHAPE, OBJECT_MESH, OBJECT_GROUP, OBJECT_LIGHT };

struct child;

struct members {
    struct child *first, *last;
};

struct object {
    enum object_kind kind;
    const char *word;               /* the statement's keyword             */
    struct location at;
    struct brume_shape shape;       /* kind, a, b, radii, open             */
    struct model_mesh *mesh;
    double inside[3];               /* inside_vector of a mesh; 0: none    */
    struct brume_light light;
    struct members members;         /* of a group                          */
    struct members clips, bounds;   /* clipped_by, bounded_by              */
    transform by;                   /* all maps of this statement          */
    struct placed_texture texture, inner;   /* inner: interior_texture     */
    struct placed_interior interior;
    bool hollow, says_hollow;       /* else as the union it is in          */
    bool inverse;
    bool no_shadow, no_image, no_reflection, no_radiosity, double_illuminate;
    bool cutaway;                   /* cutaway_textures                    */
    bool global_lights;             /* of a light_group                    */
    uint32_t points, listed;        /* announced and read, of long lists   */
    const char *lacks;              /* what no picture shows of it; or NULL */
    int query;                      /* its shape in core for queries, plus 1;
                                       0: none yet                         */
};

struct child {
    const struct object *object;
    const transform *before;        /* undoes the group's maps that were there
                                       before it; NULL: none were          */
    struct child *next;
};

/* Applies a map to an object and to what it has by now. */
void model_object_transform(struct object *object, const transform *by);

/* ---- the air and the sky ----------------------------------------------- */

/* Nothing draws fog and rainbow yet. */
struct fog {
    int type;
    double distance, color[5];
    double turbulence[3], turb_depth, omega, lambda;
    int octaves;
    double offset, alt, up[3];
};

struct rainbow {
    double direction[3], angle, width, distance, jitter, up[3];
    double arc_angle, falloff_angle;
    const void *map;                /* its color_map                       */
};

struct sky_sphere {
    const struct pigment *pigment[8];   /* layers, the lowest first        */
    int pigments;
    double emission[3];
    transform by;
};

/* ---- camera ------------------------------------------------------------ */

/* The language's, of which core has the first two. */
enum camera_type {
    CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC, CAMERA_FISHEYE,
    CAMERA_ULTRA_WIDE_ANGLE, CAMERA_OMNIMAX, CAMERA_PANORAMIC,
    CAMERA_SPHERICAL, CAMERA_CYLINDER, CAMERA_MESH
};

struct camera {
    enum camera_type type;
    int cylinder;                   /* type of a cylinder camera, 1 to 4   */
    double location[3], direction[3], up[3], right[3], sky[3], look_at[3];
    double angle, angle_v;          /* degrees; 0: none                    */
    double focal_point[3], aperture, confidence, variance;
    int blur_samples[2];
    bool bokeh, normal;             /* it has these                        */
    struct members meshes;          /* of a mesh_camera                    */
    int rays, distribution;         /* of it                               */
    double max_distance;
    bool mesh_smooth;
    bool has_look_at, has_up, has_right;
    transform by;
    struct location at;
};
extern const struct camera model_default_camera;

/* Turns what a camera statement says into the four vectors, in POV-Ray's
 * order: the angle sets the length of direction, look_at turns all of them
 * about sky, an orthographic view is fitted to the distance of look_at, and
 * the transformations come last, wherever they are written. */
enum camera_fault {
    CAMERA_FINE,
    CAMERA_LOOKS_AT_ITSELF,         /* look_at is the location             */
    CAMERA_SKY_AHEAD                /* fine, but sky is the way it looks:
                                       right stays as it was given         */
};
enum camera_fault model_camera(const struct camera *camera,
                               struct brume_camera *out);

#endif
