/* builder.h - what the files of the builder share; see build.h for what it
 * does. Private to parser/build*.c and parser/load.c. */
#ifndef PARSER_BUILDER_H
#define PARSER_BUILDER_H
#include "parser/build.h"
#include "parser/intern.h"
#include "parser/load.h"
#include "parser/model.h"
#include "parser/param.h"

/* Statements with braces, a row each: the name of its enum build_kind, and of
 * its build_statement_. BUILD_KINDS parts a value from what is around. */
#define BUILD_STATEMENTS(X)                                                   \
    X(TRIANGLE, triangle) X(SMOOTH_TRIANGLE, smooth_triangle)                 \
    X(SPHERE, sphere) X(BOX, box) X(CYLINDER, cylinder) X(CONE, cone)         \
    X(PLANE, plane) X(DISC, disc) X(MESH, mesh) X(MESH2, mesh2)               \
    X(TORUS, torus) X(OVUS, ovus) X(TEXT, text)                         \
    X(QUADRIC, quadric) X(CUBIC, cubic) X(QUARTIC, quartic)                   \
    X(POLY, poly) X(POLYNOMIAL, polynomial)                                   \
    X(SUPERELLIPSOID, superellipsoid)                                         \
    X(JULIA_FRACTAL, julia_fractal)                                           \
    X(LATHE, lathe) X(PRISM, prism) X(SOR, sor)                               \
    X(SPHERE_SWEEP, sphere_sweep) X(POLYGON, polygon)                         \
    X(BICUBIC_PATCH, bicubic_patch)                                           \
    X(BLOB, blob) X(BLOB_SPHERE, blob_sphere) X(BLOB_CYLINDER, blob_cylinder) \
    X(ISOSURFACE, isosurface) X(PARAMETRIC, parametric)                       \
    X(HEIGHT_FIELD, height_field) X(CONTAINED_BY, contained_by)               \
    X(UNION, union) X(MERGE, merge) X(INTERSECTION, intersection)             \
    X(DIFFERENCE, difference) X(OBJECT, object)                               \
    X(CLIPPED_BY, clipped_by) X(BOUNDED_BY, bounded_by)                       \
    X(LIGHT_GROUP, light_group)                                               \
    X(OBJECT_PHOTONS, object_photons)                                         \
    X(OBJECT_RADIOSITY, object_radiosity)                                     \
    X(VERTEX_VECTORS, vertex_vectors) X(NORMAL_VECTORS, normal_vectors)       \
    X(UV_VECTORS, uv_vectors) X(FACE_INDICES, face_indices)                   \
    X(NORMAL_INDICES, normal_indices) X(UV_INDICES, uv_indices)               \
    X(TEXTURE_LIST, texture_list)                                             \
    X(PIGMENT, pigment) X(NORMAL, normal) X(FINISH, finish)                   \
    X(TEXTURE, texture) X(INTERIOR_TEXTURE, interior_texture)                 \
    X(REFLECTION, reflection) X(IRID, irid) X(SUBSURFACE, subsurface)         \
    X(COLOR_MAP, color_map) X(COLOUR_MAP, colour_map)                         \
    X(PIGMENT_MAP, pigment_map) X(NORMAL_MAP, normal_map)                     \
    X(SLOPE_MAP, slope_map) X(TEXTURE_MAP, texture_map)                       \
    X(DENSITY_MAP, density_map) X(COLOR_ENTRY, color_entry)                   \
    X(PIGMENT_ENTRY, pigment_entry) X(NORMAL_ENTRY, normal_entry)             \
    X(SLOPE_ENTRY, slope_entry) X(TEXTURE_ENTRY, texture_entry)               \
    X(DENSITY_ENTRY, density_entry)                                           \
    X(PATTERN, pattern) X(WARP, warp) X(SLOPE, slope)                         \
    X(PIGMENT_PATTERN, pigment_pattern) X(OBJECT_PATTERN, object_pattern)     \
    X(IMAGE_MAP, image_map) X(IMAGE_PATTERN, image_pattern)                   \
    X(BUMP_MAP, bump_map) X(MATERIAL_MAP, material_map) X(TILES, tiles)       \
    X(MATERIAL, material) X(INTERIOR, interior) X(MEDIA, media)               \
    X(SCATTERING, scattering) X(DENSITY, density) X(FIRE, fire)               \
    X(TEMPERATURE, temperature) X(AMOUNT, amount) X(VELOCITY, velocity)       \
    X(TRANSFORM, transform) X(CAMERA, camera) X(MESH_CAMERA, mesh_camera)     \
    X(BOKEH, bokeh) X(LIGHT, light) X(LOOKS_LIKE, looks_like)                 \
    X(PROJECTED_THROUGH, projected_through)                                   \
    X(BACKGROUND, background) X(FOG, fog) X(RAINBOW, rainbow)                 \
    X(SKY_SPHERE, sky_sphere) X(SPLINE, spline)                               \
    X(GLOBAL_SETTINGS, global_settings) X(TRANSPORT, transport)               \
    X(PHOTONS, photons) X(RADIOSITY, radiosity)                               \
    X(VOLUME_PHOTONS, volume_photons) X(TEMPORAL, temporal)                   \
    X(GLOBAL_SUBSURFACE, global_subsurface) X(DEFAULT, default)

enum build_kind {
#define X(kind, name) BUILD_##kind,
    BUILD_STATEMENTS(X)
#undef X
    BUILD_KINDS
};

/* An open statement. */
struct frame {
    enum build_kind kind;
    struct location at;         /* of its keyword                          */
    int arguments;              /* numbers given before its modifiers      */
    unsigned given;             /* bits of the parameters that were set    */
    void *node;                 /* what is being made: the kind's struct   */
    const struct param *row;    /* the word whose numbers are being read   */
    const struct param_group *group;    /* that it is of, or NULL          */
    struct location row_at;
    int values;                 /* of them so far, in builder.value        */
    double position;            /* of an entry in its map                  */
    const struct param *open;   /* a word that another one belongs to      */
    size_t mark;                /* the first of its own builder.number     */
    void *more;                 /* what is known beside the node, until the
                                   statement is closed                     */
};

/* Rows that several statements share, and where what they set lies: in the
 * statement's node, or in what `node` gives. Members as in struct statement.
 */
struct param_group {
    const struct param *rows;   /* NULL ends a list of groups              */
    size_t offset;
    void *(*node)(struct parser *parser, struct frame *frame);
    void (*set)(struct parser *parser, struct frame *frame,
                const struct param *row, struct location at);
    void (*values)(struct parser *parser, struct frame *frame,
                   const struct param *row, const struct value *value,
                   int count, struct location at);
};

#define BUILD_TAKES(kind) (UINT64_C(1) << (kind))
/* What every object wears and holds. */
#define BUILD_TAKES_WORN                                                      \
    (BUILD_TAKES(VALUE_TEXTURE) | BUILD_TAKES(VALUE_PIGMENT) |                \
     BUILD_TAKES(VALUE_NORMAL) | BUILD_TAKES(VALUE_FINISH) |                  \
     BUILD_TAKES(VALUE_MATERIAL) | BUILD_TAKES(VALUE_INTERIOR) |              \
     BUILD_TAKES(VALUE_INTERIOR_TEXTURE))

/* How statements of a kind behave; NULL where they do not do that. */
struct statement {
    const char *word;
    enum value_kind makes;      /* VALUE_NONE: goes to the statement around */
    uint64_t takes;             /* kinds of values it has room for         */
    /* Statements that this one belongs into, ending with BUILD_KINDS; NULL:
     * it stands on its own, or where a value of its kind can. */
    const enum build_kind *within;
    bool in_objects;            /* it belongs into any object or light     */
    size_t size;                /* of the node; 0: it shares the one around */
    const struct param *params;
    const struct param_group *groups;
    const struct param *arguments;  /* a row each, in order                */
    int needed;                 /* of the arguments                        */
    enum build_kind entry;      /* what `[ ... ]` in it is; 0: no entries  */
    void (*open)(struct parser *parser, struct frame *frame);
    /* A number, or a string, that no word takes. */
    void (*argument)(struct parser *parser, struct frame *frame,
                     const struct value *number, struct location at);
    /* A parameter was stored. */
    void (*set)(struct parser *parser, struct frame *frame,
                const struct param *row, struct location at);
    /* A row of PARAM_VALUES with its `count` numbers and strings. */
    void (*values)(struct parser *parser, struct frame *frame,
                   const struct param *row, const struct value *value,
                   int count, struct location at);
    void (*apply)(struct parser *parser, struct frame *frame,
                  const struct value *value, struct location at);
    void (*move)(struct parser *parser, struct frame *frame,
                 const transform *by);
    void (*close)(struct parser *parser, struct frame *frame,
                  struct location at);
};

#define X(kind, name) extern const struct statement build_statement_##name;
BUILD_STATEMENTS(X)
#undef X

/* Bits of frame.given with a meaning beyond their file. */
enum { OBJECT_HOLLOW = 1, OBJECT_NAMED = 2, OBJECT_INVERSE = 4 };
/* Of statements with patterns: their pattern is their own copy; it was chosen
 * here; they have a list of their own; they have a colour of their own; as an
 * entry of a map they have a position; they began as, or got, a part. */
enum { FRAME_PATTERN = 1 << 16, FRAME_CHOSEN = 1 << 17, FRAME_LIST = 1 << 18,
       FRAME_PLAIN = 1 << 19, FRAME_POSITION = 1 << 20,
       FRAME_BEGUN = 1 << 21 };

/* The modifiers of every object. */
#define BUILD_OBJECT_ROWS                                                     \
    PARAM_WORD("hollow", PARAM_SWITCH, 1, OBJECT_HOLLOW, struct object,       \
               hollow),                                                       \
    PARAM_WORD("no_shadow", PARAM_SWITCH, 1, 0, struct object, no_shadow),    \
    PARAM_WORD("no_image", PARAM_SWITCH, 1, 0, struct object, no_image),      \
    PARAM_WORD("no_reflection", PARAM_SWITCH, 1, 0, struct object,            \
               no_reflection),                                                \
    PARAM_WORD("no_radiosity", PARAM_SWITCH, 1, 0, struct object,             \
               no_radiosity),                                                 \
    PARAM_WORD("double_illuminate", PARAM_SWITCH, 1, 0, struct object,        \
               double_illuminate),                                            \
    {.word = "inverse", .kind = PARAM_IGNORED, .given = OBJECT_INVERSE},      \
    PARAM_WITHOUT("sturm", "Brume solves in one way"),                        \
    PARAM_WITHOUT("hierarchy", "Brume builds its own hierarchies")
#define BUILD_MESH_ROWS                                                       \
    BUILD_OBJECT_ROWS,                                                        \
    PARAM_ANY("inside_vector", PARAM_VECTOR, 0, 0, struct object, inside)
/* Of those that hold others. */
#define BUILD_GROUP_ROWS                                                      \
    BUILD_OBJECT_ROWS,                                                        \
    PARAM_WITHOUT("split_union", "it is for photons, which are to come"),     \
    PARAM_WORD("cutaway_textures", PARAM_SWITCH, 1, 0, struct object,         \
               cutaway)

extern const struct param build_camera_params[], build_light_params[],
    build_object_params[], build_finish_params[],
    build_fire_params[], build_scattering_params[], build_media_params[],
    build_globals_params[], build_transport_params[],
    build_reflection_params[], build_interior_params[];

struct transport {
    int media, surfaces;        /* 1: multiple; indirect                   */
    bool environment;
};

/* POV-Ray's ways to find indirect light: kept, and told to be missing. */
struct photons {
    double spacing, count, gather[2], media[2], jitter, autostop;
    double expand_thresholds[2], radius[2];
    double max_trace_level, adc_bailout;
};

struct radiosity {
    double adc_bailout, brightness, count[2], error_bound, gray_threshold;
    double importance, low_error_factor, max_sample, maximum_reuse;
    double minimum_reuse, nearest_count[2], pretrace_end, pretrace_start;
    double recursion_limit;
    bool always_sample, media, normal, subsurface;
};

struct subsurface {
    double samples[2];
    bool radiosity;
};

struct volume_photons {
    double count, radius, field_spacing, field_depth;
    int preset, gather, single, emission;
    bool frustum, far_plane;
    int temporal;               /* frames, 0: not said                     */
    int weights;                /* that were written out, 0: the published */
    int adaptive, reach;        /* 1: weights are found; over so many frames
                                   on each side                            */
    double weight[BRUME_MAX_TAPS];
};

/* A plate as a background names it. */
struct background_plate {
    struct string name, layer;  /* text NULL: none                         */
    struct location at;         /* of the name                             */
    int depth;                  /* as in enum parse_depth, from 0          */
};

struct globals {
    struct background_plate plate;
    struct volume_photons volume_photons;
    bool has_volume_photons;
    struct photons photons;
    struct radiosity radiosity;
    struct subsurface subsurface;
    bool has_photons, has_radiosity;
    double ambient_light[3], background[3];
    double assumed_gamma, adc_bailout, accuracy, time_limit;
    int max_trace_level, light_units, integrator;
    int charset, noise_generator, number_of_waves;
    double irid_wavelength[3], mm_per_unit;
    struct transport transport;
    unsigned transport_given;
};

/* Three indices for each triangle of a mesh2. */
struct index_list {
    uint32_t (*item)[3];
    size_t count, room;
};

/* What a word means in a statement. */
struct meaning {
    const struct name *word;    /* NULL: not known yet                     */
    enum build_kind in;
    enum build_kind begins;     /* BUILD_KINDS: no statement               */
    const struct param *row;    /* NULL: it is none of its parameters      */
    const struct param_group *group;    /* that the row is of, or NULL     */
};

enum { BUILD_NOTES = 16, BUILD_LACKS = 32, BUILD_MEANINGS = 512 };

/* A node that nothing refers to any more. */
struct spare {
    struct spare *next;
};

struct builder {
    struct frame *frame;            /* open statements, innermost last     */
    size_t frames, frame_room;
    struct spare *spare[VALUE_KINDS];
    struct meaning meaning[BUILD_MEANINGS]; /* found before, by hash       */
    const void *fresh;              /* the value made last, while only the
                                       grammar has it                      */
    struct value value[PARAM_MOST]; /* of the innermost frame's row        */
    struct location value_at;       /* of the first of them                */
    struct texture default_texture;
    struct globals globals;
    const struct camera *camera;    /* the last one placed                 */
    const struct sky_sphere *sky;
    const struct media *atmosphere[BRUME_MAX_INTERIOR_MEDIA];
    int atmospheres;
    bool no_radiosity;              /* something placed says so            */
    struct location atmosphere_at;
    struct model_mesh *meshes;      /* all that were made                  */
    double corner[6][3];            /* arguments of the open triangle      */
    float uv[3][2];                 /* and its uv_vectors,                 */
    int uvs;                        /* 3 where it has them                 */
    struct index_list indices[3];   /* of the open mesh2: faces, normals,
                                       uvs                                 */
    struct object *begun;           /* mesh that was opened just now       */
    struct object *literal;         /* mesh whose lists are kept           */
    int64_t announced, listed;      /* items of its open list              */
    struct intern intern[4];        /* what core has: see build_send.c     */
    struct intern functions;        /* and build_function.c                */
    int cover;                      /* function of two layers, + 1; or 0   */
    struct location placed_at;      /* of the object that is being placed  */
    double *number;                 /* of long lists that are being read   */
    size_t numbers, number_room;
    struct placing *placing;        /* the objects being placed            */
    size_t placing_room;
    bool querying;                  /* what is placed is for a query       */
    int *part;                      /* of composites being placed          */
    size_t parts, part_room;
    struct loader loader;
    const char *note[BUILD_NOTES];  /* given already                       */
    int notes;
    const char *lack[BUILD_LACKS];  /* see build_lacks                     */
    int lacked;
    struct location lacks_at;       /* the first thing that lacks one      */
};

struct frame *build_top(struct parser *parser);
const struct statement *build_statement_of(const struct frame *frame);
/* The frame around the innermost one, or NULL. */
struct frame *build_around(struct parser *parser);

/* A zeroed node for a value of the kind: a loop that makes a million objects
 * needs the memory of one. A node that is given up must be fresh. */
void *build_node(struct parser *parser, enum value_kind kind, size_t size);
void build_give_up(struct parser *parser, enum value_kind kind, void *node);

/* Reports that a value of that kind has no place in the open statement. */
void build_misplaced(struct parser *parser, const struct frame *frame,
                     const struct value *value, struct location at);

/* Adds to the numbers of the innermost statement. False: reported. */
bool build_number(struct parser *parser, double number, struct location at);
/* Moves them to the parse arena, as data of its shape. */
bool build_take_numbers(struct parser *parser, struct frame *frame,
                        struct object *object);

/* The object that a frame makes, or NULL if it makes something else. */
const struct object *build_object_of(const struct frame *frame);
/* What the statements of objects have in common. */
struct object *build_object_start(struct frame *frame, enum object_kind kind,
                                  enum brume_shape_kind shape,
                                  const char *word);
void build_object_set(struct parser *parser, struct frame *frame,
                      const struct param *row, struct location at);
void build_object_apply(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at);
void build_object_move(struct parser *parser, struct frame *frame,
                       const transform *by);

/* Puts a texture over what an object wears; pigment, normal and finish change
 * that, or the default texture. False: reported. */
bool build_wear(struct parser *parser, struct placed_texture *worn,
                const struct value *value);
bool build_wear_placed(struct parser *parser, struct placed_texture *worn,
                       const struct placed_texture *over);
/* The texture that the statement around has by now, and what was applied to
 * it since. */
const struct texture *build_texture_around(struct parser *parser,
                                           transform *by);

/* What statements with patterns have in common: their rows, and what else they
 * take. `apply` is false for a value that is none of a pattern's. */
extern const struct param_group build_pattern_groups[];
#define BUILD_TAKES_PATTERN BUILD_TAKES(VALUE_FUNCTION)
extern const enum build_kind build_patterned[], build_entries[];
struct patterned *build_patterned_of(const struct frame *frame);
/* A part of the statement's own kind: what it begins with, or an item of a
 * list. */
void build_begin_with(struct parser *parser, struct frame *frame,
                      const struct value *value, size_t size,
                      struct location at);
/* The pattern of the open statement, to be changed. NULL: no memory. */
struct pattern *build_pattern_of(struct parser *parser, struct frame *frame);
struct pattern *build_pattern_begin(struct parser *parser, struct frame *frame,
                                    enum pattern_kind kind);
bool build_pattern_apply(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at);
/* A colour (number) or a node for the list of a block pattern. */
void build_pattern_choice(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at);
/* Whether the open statement is at a list. */
bool build_pattern_lists(const struct frame *frame);
void build_pattern_close(struct parser *parser, struct frame *frame,
                         struct location at);

/* Whether a data file is there; reported if not. */
bool build_has_file(struct parser *parser, struct string name,
                    struct location at);

/* Whether a number is the position of the open entry; then it is taken. */
bool build_entry_position(struct frame *frame, const struct value *number);
/* Closes an entry: its node goes to the map around. */
void build_entry_close(struct parser *parser, struct frame *frame,
                       struct location at);
bool build_map_add(struct parser *parser, struct map *map, double at,
                   const double *color, int terms, const void *node);
/* A color_map's number. */
void build_color_argument(struct parser *parser, struct frame *frame,
                          const struct value *number, struct location at);

/* Tells, once for each `note`, that a word has no effect. */
void build_note(struct parser *parser, const char *word, const char *note,
                struct location at);
/* Notes what the picture does not show ("normals"), of something that is
 * placed: of a placed object with its texture, and interior or NULL. */
void build_lacks(struct parser *parser, const char *what, struct location at);
void build_lacks_of(struct parser *parser, const struct object *object,
                    const struct texture *texture,
                    const struct interior *interior);
/* One warning of all of it. */
void build_report_lacks(struct parser *parser);

/* Adds an object to a list of them; NULL: no memory. */
struct child *build_add_child(struct parser *parser, struct members *members,
                              const struct object *object);
/* What a camera has that is not drawn. */
void build_camera_lacks(struct parser *parser, const struct camera *camera);
/* The end of the scene: its sky. */
bool build_finish_sky(struct parser *parser, struct brume_error *err);
/* build_plate.c. False: reported. */
bool build_finish_plate(struct parser *parser);

/* A spline as a function of core; -1 with err set. */
int build_spline_function(struct parser *parser, const struct value *spline,
                          struct brume_error *err);

/* A shape whose kind its frame's tells. */
void build_shape_open(struct parser *parser, struct frame *frame);
/* Whether a function is of x, y and z and gives a float; else reported. */
bool build_is_function_of_space(struct parser *parser,
                                const struct value *value,
                                struct location at);

/* The object as a shape of core that is seen nowhere, for queries; -1:
 * reported. */
int build_place_query(struct parser *parser, const struct object *object,
                      struct location at);

/* Ids of core; -1: nothing shows (material), or err is set. */
int build_send_material(struct parser *parser,
                        const struct placed_texture *worn,
                        struct brume_error *err);
int build_send_interior(struct parser *parser, const struct media *const *media,
                        int count, const transform *by,
                        struct brume_error *err);
/* The density, with its own maps, as a function of 3 parameters whose first
 * three results are its colour. -1: core cannot do it. */
int build_density_function(struct parser *parser,
                           const struct density *density);
/* The function of a colour and the one below it, each of five numbers. -1:
 * `err`. */
int build_cover(struct parser *parser, struct brume_error *err);
/* The colours of a texture, with its own maps, as a function of 3 parameters
 * with 5 results. -1: core cannot do it. */
int build_texture_function(struct parser *parser,
                           const struct texture *texture);
int build_pigment_function(struct parser *parser,
                           const struct pigment *pigment);

/* What mesh and mesh2 have in common. */
void build_mesh_open(struct parser *parser, struct frame *frame,
                     const char *word);
/* Before a mesh is closed: whether it is what is spelt out in its text and
 * nothing else. */
bool build_literal_is_whole(const struct parser *parser,
                            const struct model_mesh *mesh);
/* It is closed, and sound. `lists`: it is a mesh2. */
void build_literal_keep(const struct parser *parser, struct model_mesh *mesh,
                        bool lists);
/* Before something is added to a mesh: it shares none any more. False:
 * reported. */
bool build_literal_own(struct parser *parser, struct model_mesh *mesh,
                       struct location at);
void build_mesh_set(struct parser *parser, struct frame *frame,
                    const struct param *row, struct location at);
bool build_mesh_normal(struct mesh *mesh, const double n[3],
                       struct brume_error *err);
void build_globals_start(struct globals *globals);
/* build_photons.c: what volume_photons says, to the result. */
void build_photons_finish(struct parser *parser);
bool build_place_atmosphere(struct parser *parser);

#endif
