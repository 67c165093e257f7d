/* build_mesh.c - triangle, smooth_triangle and mesh. */
#include <string.h>

#include "lib/mesh.h"
#include "parser/builder.h"

static const struct param mesh_params[] = {
    BUILD_MESH_ROWS, PARAM_OWN("ply", 1, 1, 0), PARAM_OWN("obj", 1, 1, 0), {0}};
static const struct param triangle_params[] = {
    BUILD_OBJECT_ROWS, PARAM_OWN("uv_vectors", 3, 3, 0), {0}};

/* A mesh of the builder's list, so that nothing is lost when a parse fails. */
static struct model_mesh *new_mesh(struct parser *parser, struct location at)
{
    struct model_mesh *mesh = parser_alloc(parser, sizeof *mesh);
    struct brume_error err = {0};

    if (!mesh)
        return NULL;
    mesh->id = -1;
    mesh->mesh = mesh_new(&err);
    mesh->next = parser->builder->meshes;
    parser->builder->meshes = mesh;
    if (mesh->mesh)
        return mesh;
    parser_relay(parser, at, &err);
    return NULL;
}

void build_mesh_open(struct parser *parser, struct frame *frame,
                     const char *word)
{
    struct object *object = build_object_start(frame, OBJECT_MESH,
                                               BRUME_SHAPE_MESH, word);

    object->mesh = new_mesh(parser, frame->at);
}

/* ---- triangles --------------------------------------------------------- */

/* In a mesh a triangle makes no node: meshes are large. */
static void open_triangle(struct parser *parser, struct frame *frame)
{
    const struct frame *around = build_around(parser);

    parser->builder->uvs = 0;
    if (around && around->kind == BUILD_MESH)
        return;
    frame->node = build_node(parser, VALUE_OBJECT, sizeof(struct object));
    if (frame->node)
        build_mesh_open(parser, frame, "triangle");
}

static void triangle_argument(struct parser *parser, struct frame *frame,
                              const struct value *number, struct location at)
{
    static const struct param row = {.word = "corner",
                                     .kind = PARAM_VECTOR,
                                     .low = -INFINITY,
                                     .high = INFINITY,
                                     .alone = NAN};
    int needed = frame->kind == BUILD_TRIANGLE ? 3 : 6;

    if (frame->arguments >= needed)
        parser_error(parser, at, "a triangle takes no more vectors here");
    else
        param_set(parser, &row, parser->builder->corner[frame->arguments], at,
                  number, 1, at);
}

bool build_mesh_normal(struct mesh *mesh, const double n[3],
                       struct brume_error *err)
{
    float normal[3] = {(float)n[0], (float)n[1], (float)n[2]};

    return mesh_add_normal(mesh, normal, err);
}

static bool add_uvs(struct builder *builder, struct mesh *mesh,
                    struct brume_error *err)
{
    for (int i = 0; i < builder->uvs; i++)
        if (!mesh_add_uv(mesh, builder->uv[i], err))
            return false;
    return true;
}

/* The last three of `count` items that were added. */
static void last_three(size_t count, uint32_t index[3])
{
    for (uint32_t i = 0; i < 3; i++)
        index[i] = (uint32_t)count - 3 + i;
}

static bool add_triangle(struct builder *builder, struct mesh *mesh,
                         bool smooth, struct brume_error *err)
{
    uint32_t corner[3], normal[3] = {0}, uv[3] = {0};

    for (int i = 0; i < 3; i++) {
        int at = smooth ? 2 * i : i;
        if (!mesh_add_vertex(mesh, builder->corner[at], err) ||
            (smooth && !build_mesh_normal(mesh, builder->corner[at + 1], err)))
            return false;
    }
    if (!add_uvs(builder, mesh, err))
        return false;
    last_three(mesh->vertices, corner);
    if (smooth)
        last_three(mesh->normals, normal);
    if (builder->uvs)
        last_three(mesh->uvs, uv);
    return mesh_add_triangle(mesh, corner, smooth ? normal : NULL,
                             builder->uvs ? uv : NULL, err);
}

static void close_triangle(struct parser *parser, struct frame *frame,
                           struct location at)
{
    bool smooth = frame->kind == BUILD_SMOOTH_TRIANGLE;
    bool full = !frame->node && build_around(parser)->given & OBJECT_NAMED;
    const struct object *object = frame->node ? frame->node
                                              : build_around(parser)->node;
    struct brume_error err = {0};

    enum { BYTES = 150 }; /* three vertices and indices, as arrays grow */

    parser_hold(parser, at, BYTES);
    if (full)
        parser_mistake(parser, frame->at, "a mesh takes triangles or one mesh");
    if (full || !build_literal_own(parser, object->mesh, at))
        return;
    if (!add_triangle(parser->builder, object->mesh->mesh, smooth, &err))
        parser_relay(parser, at, &err);
}

static void apply_triangle(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    if (frame->node)
        build_object_apply(parser, frame, value, at);
    else
        parser_error(parser, at,
                     "a %s of one triangle of a mesh is not "
                     "supported yet",
                     value_name(value));
}

static void move_triangle(struct parser *parser, struct frame *frame,
                          const transform *by)
{
    if (frame->node)
        build_object_move(parser, frame, by);
    else
        parser_error(parser, frame->at,
                     "a triangle of a mesh can't be transformed alone");
}

static void set_triangle(struct parser *parser, struct frame *frame,
                         const struct param *row, struct location at)
{
    build_object_set(parser, frame, row, at);
}

/* `uv_vectors` and its three vectors. */
static void triangle_values(struct parser *parser, struct frame *frame,
                            const struct param *row, const struct value *uv,
                            int count, struct location at)
{
    struct builder *builder = parser->builder;

    (void)frame;
    (void)row;
    builder->uvs = count;
    for (int i = 0; i < count; i++) {
        if (uv[i].kind != VALUE_NUMBER) {
            parser_mistake(parser, at, "'uv_vectors' needs three vectors");
            return;
        }
        builder->uv[i][0] = (float)uv[i].v[0];
        builder->uv[i][1] = (float)value_promote(uv[i], 2).v[1];
    }
}

static const struct param triangle_rows[] = {{.word = "first corner"},
                                             {.word = "second corner"},
                                             {.word = "third corner"},
                                             {0}};
static const struct param smooth_rows[] = {{.word = "first corner"},
                                           {.word = "first normal"},
                                           {.word = "second corner"},
                                           {.word = "second normal"},
                                           {.word = "third corner"},
                                           {.word = "third normal"},
                                           {0}};

const struct statement build_statement_triangle = {
    .word = "triangle",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .params = triangle_params,
    .values = triangle_values,
    .arguments = triangle_rows,
    .needed = 3,
    .open = open_triangle,
    .argument = triangle_argument,
    .apply = apply_triangle,
    .move = move_triangle,
    .close = close_triangle,
    .set = set_triangle,
};

const struct statement build_statement_smooth_triangle = {
    .word = "smooth_triangle",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .params = triangle_params,
    .values = triangle_values,
    .arguments = smooth_rows,
    .needed = 6,
    .open = open_triangle,
    .argument = triangle_argument,
    .apply = apply_triangle,
    .move = move_triangle,
    .close = close_triangle,
    .set = set_triangle,
};

/* ---- mesh -------------------------------------------------------------- */

static void open_mesh(struct parser *parser, struct frame *frame)
{
    build_mesh_open(parser, frame, "mesh");
    parser->builder->begun = frame->node;
    frame->more = parser->builder->begun->mesh;
}

void build_mesh_set(struct parser *parser, struct frame *frame,
                    const struct param *row, struct location at)
{
    const struct object *object = frame->node;
    const double *v = object->inside;

    if (!strcmp(row->word, "inside_vector") && v[0] == 0 && v[1] == 0 &&
        v[2] == 0)
        parser_error(parser, at, "'inside_vector' has no direction");
    build_object_set(parser, frame, row, at);
}

static void mesh_file(struct parser *parser, struct frame *frame,
                      const struct param *row, const struct value *name,
                      int count, struct location at)
{
    struct object *object = frame->node;

    (void)count;
    if (name->kind != VALUE_STRING) {
        parser_mistake(parser, at, "'%s' needs the name of a file", row->word);
        return;
    }
    if (object->mesh->mesh == NULL || object->mesh->mesh->triangles > 0) {
        parser_error(parser, parser->builder->value_at,
                     "a mesh has triangles or one file, not both");
        return;
    }
    struct data_file file = data_file(row->word, name->string,
                                      parser->builder->value_at);
    struct model_mesh *mesh = load_mesh(parser, &file);
    if (mesh)
        object->mesh = mesh;
}

/* A triangle adds itself when it is closed. */
static void apply_mesh(struct parser *parser, struct frame *frame,
                       const struct value *value, struct location at)
{
    struct object *mesh = frame->node;
    const struct object *named = value->node;

    if (value->kind != VALUE_OBJECT) {
        build_object_apply(parser, frame, value, at);
    } else if (named->kind != OBJECT_MESH || mesh->mesh->mesh == NULL ||
               mesh->mesh->mesh->triangles > 0) {
        parser_mistake(parser, at, "a mesh takes triangles or one mesh");
    } else {
        /* `mesh { IDENTIFIER ... }` */
        *mesh = *named;
        frame->given |= OBJECT_NAMED;
        mesh->texture.owned = false;
        mesh->query = 0;
        mesh->at = frame->at;
    }
}

static void close_mesh(struct parser *parser, struct frame *frame,
                       struct location at)
{
    const struct object *object = frame->node;
    const struct mesh *mesh = object->mesh->mesh;

    (void)at;
    if (mesh && mesh->triangles == 0)
        parser_error(parser, frame->at, "this mesh has no triangles");
    parser->out->counts.meshes_read += object->mesh == frame->more &&
                                       !object->mesh->taken;
    if (mesh && build_literal_is_whole(parser, object->mesh))
        build_literal_keep(parser, object->mesh, false);
}

const struct statement build_statement_mesh = {
    .word = "mesh",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_OBJECT),
    .size = sizeof(struct object),
    .params = mesh_params,
    .open = open_mesh,
    .values = mesh_file,
    .apply = apply_mesh,
    .move = build_object_move,
    .close = close_mesh,
    .set = build_mesh_set,
};
