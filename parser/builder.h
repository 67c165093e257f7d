/* builder.h - what the files of the builder share; see build.h for what it
 * does. Private to parser/build*.c and parser/load.c. */
#ifndef PARSER_BUILDER_H
#define PARSER_BUILDER_H
#include "parser/build.h"
#include "parser/intern.h"
#include "parser/load.h"
#include "parser/model.h"
#include "parser/param.h"

/* Statements with braces. BUILD_KINDS parts a value from what is around. */
enum build_kind {
    BUILD_TRIANGLE, BUILD_SMOOTH_TRIANGLE,
    BUILD_SPHERE, BUILD_BOX, BUILD_CYLINDER, BUILD_CONE, BUILD_PLANE,
    BUILD_DISC, BUILD_MESH, BUILD_MESH2, BUILD_UNION, BUILD_OBJECT,
    BUILD_PIGMENT, BUILD_FINISH, BUILD_TEXTURE, BUILD_MATERIAL,
    BUILD_INTERIOR, BUILD_MEDIA, BUILD_SCATTERING, BUILD_DENSITY,
    BUILD_FIRE, BUILD_TEMPERATURE, BUILD_AMOUNT,
    BUILD_VERTEX_VECTORS, BUILD_NORMAL_VECTORS, BUILD_UV_VECTORS,
    BUILD_FACE_INDICES, BUILD_NORMAL_INDICES, BUILD_UV_INDICES,
    BUILD_TRANSFORM, BUILD_CAMERA, BUILD_LIGHT, BUILD_BACKGROUND,
    BUILD_GLOBAL_SETTINGS, BUILD_TRANSPORT, BUILD_DEFAULT,
    BUILD_KINDS
};

/* An open statement. */
struct frame {
    enum build_kind kind;
    struct location at;         /* of its keyword                          */
    int arguments;              /* numbers given before its modifiers      */
    unsigned given;             /* bits of the parameters that were set    */
    void *node;                 /* what is being made: the kind's struct   */
};

/* How statements of a kind behave; NULL where they do not do that. */
struct statement {
    const char *word;
    enum value_kind makes;      /* VALUE_NONE: goes to the statement around */
    size_t size;                /* of the node; 0: it shares the one around */
    const struct param *params;
    const struct param *arguments;  /* a row each, in order                */
    int needed;                 /* of the arguments                        */
    void (*open)(struct parser *parser, struct frame *frame);
    void (*argument)(struct parser *parser, struct frame *frame,
                     const struct value *number, struct location at);
    /* A parameter was stored. */
    void (*set)(struct parser *parser, struct frame *frame,
                const struct param *row, struct location at);
    void (*apply)(struct parser *parser, struct frame *frame,
                  const struct value *value, struct location at);
    void (*move)(struct parser *parser, struct frame *frame,
                 const transform *by);
    void (*close)(struct parser *parser, struct frame *frame,
                  struct location at);
};

extern const struct statement build_statement_camera,
    build_statement_light, build_statement_sphere, build_statement_box,
    build_statement_cylinder, build_statement_cone, build_statement_plane,
    build_statement_disc, build_statement_triangle,
    build_statement_smooth_triangle, build_statement_mesh,
    build_statement_mesh2, build_statement_union, build_statement_object,
    build_statement_vertex_vectors, build_statement_normal_vectors,
    build_statement_uv_vectors, build_statement_face_indices,
    build_statement_normal_indices, build_statement_uv_indices,
    build_statement_pigment, build_statement_finish, build_statement_texture,
    build_statement_material, build_statement_interior,
    build_statement_media, build_statement_scattering,
    build_statement_density, build_statement_fire,
    build_statement_temperature, build_statement_amount,
    build_statement_transform, build_statement_background,
    build_statement_global_settings, build_statement_transport,
    build_statement_default;

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
    struct loader loader;
    const char *note[BUILD_NOTES];  /* given already                       */
    int notes;
};

struct frame *build_top(struct parser *parser);
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
