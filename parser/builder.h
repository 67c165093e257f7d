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
    X(UNION, union) X(OBJECT, object)                                         \
    X(VERTEX_VECTORS, vertex_vectors) X(NORMAL_VECTORS, normal_vectors)       \
    X(UV_VECTORS, uv_vectors) X(FACE_INDICES, face_indices)                   \
    X(NORMAL_INDICES, normal_indices) X(UV_INDICES, uv_indices)               \
    X(PIGMENT, pigment) X(FINISH, finish) X(TEXTURE, texture)                 \
    X(MATERIAL, material) X(INTERIOR, interior) X(MEDIA, media)               \
    X(SCATTERING, scattering) X(DENSITY, density) X(FIRE, fire)               \
    X(TEMPERATURE, temperature) X(AMOUNT, amount)                             \
    X(TRANSFORM, transform) X(CAMERA, camera) X(LIGHT, light)                 \
    X(BACKGROUND, background) X(GLOBAL_SETTINGS, global_settings)             \
    X(TRANSPORT, transport) X(DEFAULT, default)

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
    struct location row_at;
    int values;                 /* of them so far, in builder.value        */
};

/* Rows that several statements share, and where what they set lies in the
 * statement's node. */
struct param_group {
    const struct param *rows;   /* NULL ends a list of groups              */
    size_t offset;
};

#define BUILD_TAKES(kind) (UINT64_C(1) << (kind))
/* What every object wears and holds. */
#define BUILD_TAKES_WORN                                                      \
    (BUILD_TAKES(VALUE_TEXTURE) | BUILD_TAKES(VALUE_PIGMENT) |                \
     BUILD_TAKES(VALUE_FINISH) | BUILD_TAKES(VALUE_MATERIAL) |                \
     BUILD_TAKES(VALUE_INTERIOR))

/* How statements of a kind behave; NULL where they do not do that. */
struct statement {
    const char *word;
    enum value_kind makes;      /* VALUE_NONE: goes to the statement around */
    uint64_t takes;             /* kinds of values it has room for         */
    /* Statements that this one belongs into, ending with BUILD_KINDS; NULL:
     * it stands on its own, or where a value of its kind can. */
    const enum build_kind *within;
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
enum { PIGMENT_PATTERN = 1, OBJECT_HOLLOW = 1, OBJECT_NAMED = 2 };

/* The modifiers of every object. */
#define BUILD_OBJECT_ROWS                                                     \
    PARAM_WORD("hollow", PARAM_SWITCH, 1, OBJECT_HOLLOW, struct object,       \
               hollow),                                                       \
    PARAM_WORD("no_shadow", PARAM_CLEAR, 0, 0, struct object, shadow),        \
    PARAM_WITHOUT("inverse", NULL),                                           \
    PARAM_WITHOUT("sturm", "Brume solves in one way"),                        \
    PARAM_WITHOUT("split_union", "it is for photons, which are to come")

extern const struct param build_camera_params[], build_light_params[],
    build_object_params[], build_mesh_params[], build_finish_params[],
    build_fire_params[], build_scattering_params[], build_media_params[],
    build_globals_params[], build_transport_params[];

struct transport {
    int media, surfaces;        /* 1: multiple; indirect                   */
    bool environment;
};

struct globals {
    double ambient_light[3], background[3];
    double assumed_gamma, adc_bailout, accuracy, time_limit;
    int max_trace_level, light_units, integrator;
    struct transport transport;
    unsigned transport_given;
};

/* Three indices for each triangle of a mesh2. */
struct index_list {
    uint32_t (*item)[3];
    size_t count, room;
};

enum { BUILD_NOTES = 16 };

/* A node that nothing refers to any more. */
struct spare {
    struct spare *next;
};

struct builder {
    struct frame *frame;            /* open statements, innermost last     */
    size_t frames, frame_room;
    struct spare *spare[VALUE_KINDS];
    const void *fresh;              /* the value made last, while only the
                                       grammar has it                      */
    struct value value[PARAM_MOST]; /* of the innermost frame's row        */
    struct location value_at;       /* of the first of them                */
    struct texture default_texture;
    struct globals globals;
    const struct camera *camera;    /* the last one placed                 */
    const struct media *atmosphere[BRUME_MAX_INTERIOR_MEDIA];
    int atmospheres;
    struct location atmosphere_at;
    struct model_mesh *meshes;      /* all that were made                  */
    double corner[6][3];            /* arguments of the open triangle      */
    float uv[3][2];                 /* and its uv_vectors,                 */
    int uvs;                        /* 3 where it has them                 */
    struct index_list indices[3];   /* of the open mesh2: faces, normals,
                                       uvs                                 */
    int64_t announced, listed;      /* items of its open list              */
    struct intern intern[4];        /* what core has: see build_place.c    */
    struct placing *placing;        /* the unions being placed             */
    size_t placing_room;
    struct data_file file;          /* of the open density                 */
    struct loader loader;
    const char *note[BUILD_NOTES];  /* given already                       */
    int notes;
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

/* Puts a texture over what an object wears; a pigment or a finish changes
 * that, or the default texture. False: reported. */
bool build_wear(struct parser *parser, struct placed_texture *worn,
                const struct value *value, struct location at);
bool build_wear_placed(struct parser *parser, struct placed_texture *worn,
                       const struct placed_texture *over, struct location at);

/* What mesh and mesh2 have in common. */
void build_mesh_open(struct parser *parser, struct frame *frame,
                     const char *word);
void build_mesh_set(struct parser *parser, struct frame *frame,
                    const struct param *row, struct location at);
bool build_mesh_normal(struct mesh *mesh, const double n[3],
                       struct brume_error *err);
void build_globals_start(struct globals *globals);
bool build_place_atmosphere(struct parser *parser);

#endif
