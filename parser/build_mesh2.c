/* build_mesh2.c - mesh2: lists of vectors and of indices. */
#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"

/* ---- its lists --------------------------------------------------------- */

enum { LIST_FACES, LIST_NORMALS, LIST_UVS };

static void open_list(struct parser *parser, struct frame *frame)
{
    struct object *object = build_around(parser)->node;

    frame->node = object;
    parser->builder->announced = -1;
    parser->builder->listed = 0;
    if (object->mesh)
        build_literal_own(parser, object->mesh, frame->at);
}

/* The first number of a list says how many items follow. */
static bool announced(struct parser *parser, struct frame *frame,
                      const struct value *number, struct location at)
{
    struct builder *builder = parser->builder;

    if (frame->arguments == 0) {
        bool sound = number->terms == 1 && number->v[0] >= 0 &&
                     number->v[0] <= 4294967294.0;
        if (!sound)
            parser_error(parser, at,
                         "the count of a list must be from 0 to "
                         "4294967294");
        builder->announced = sound ? (int64_t)number->v[0] : 0;
        /* Counted on in 64 bits by `listed`. */
        return false;
    }
    frame->arguments = 1;
    if (builder->listed++ < builder->announced)
        return true;
    return parser_error(parser, at,
                        "this list announces %lld items but has "
                        "more",
                        (long long)builder->announced);
}

/* Bytes of a vector or a face; arrays grow by doubling. */
enum { ITEM = 12 };

static void list_vector(struct parser *parser, struct frame *frame,
                        const struct value *number, struct location at)
{
    struct object *object = frame->node;
    struct mesh *mesh = object->mesh->mesh;
    struct value v = value_promote(*number, 3);
    struct brume_error err = {0};
    bool fine;

    if (!announced(parser, frame, number, at) ||
        !parser_hold(parser, at, 2 * ITEM))
        return;
    if (frame->kind == BUILD_VERTEX_VECTORS) {
        fine = mesh_add_vertex(mesh, v.v, &err);
    } else if (frame->kind == BUILD_NORMAL_VECTORS) {
        fine = build_mesh_normal(mesh, v.v, &err);
    } else {
        float uv[2] = {(float)v.v[0], (float)v.v[1]};
        fine = mesh_add_uv(mesh, uv, &err);
    }
    if (!fine)
        parser_relay(parser, at, &err);
}

static struct index_list *list_of(struct parser *parser, enum build_kind kind)
{
    struct index_list *lists = parser->builder->indices;

    if (kind == BUILD_FACE_INDICES)
        return &lists[LIST_FACES];
    return &lists[kind == BUILD_NORMAL_INDICES ? LIST_NORMALS : LIST_UVS];
}

static const char lacks_textures[] = "textures of single triangles";

static void list_index(struct parser *parser, struct frame *frame,
                       const struct value *number, struct location at)
{
    struct index_list *list = list_of(parser, frame->kind);
    struct brume_error err = {0};
    uint32_t(*item)[3];

    if (frame->arguments > 0 && number->terms == 1) {
        ((struct object *)frame->node)->lacks = lacks_textures;
        return;
    }
    if (!announced(parser, frame, number, at) ||
        !parser_hold(parser, at, 2 * ITEM))
        return;
    item = memory_grow(list->item, &list->room, list->count + 1, sizeof *item,
                       &err);
    if (!item) {
        parser_relay(parser, at, &err);
        return;
    }
    list->item = item;
    for (int i = 0; i < 3; i++) {
        double index = number->v[i];
        if (!(index >= 0 && index <= 4294967294.0)) {
            parser_error(parser, at, "%g is no index", index);
            return;
        }
        item[list->count][i] = (uint32_t)index;
    }
    list->count++;
}

static void close_list(struct parser *parser, struct frame *frame,
                       struct location at)
{
    struct builder *builder = parser->builder;

    (void)at;
    if (builder->listed < builder->announced)
        parser_error(parser, frame->at,
                     "this list announces %lld items but "
                     "has %lld",
                     (long long)builder->announced, (long long)builder->listed);
}

static const enum build_kind in_mesh2[] = {BUILD_MESH2, BUILD_KINDS};
static const struct param list_rows[] = {{.word = "count"}, {0}};

#define LIST_STATEMENT(name, item)                                             \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .within = in_mesh2,                                                    \
        .arguments = list_rows,                                                \
        .needed = 1,                                                           \
        .open = open_list,                                                     \
        .argument = item,                                                      \
        .close = close_list,                                                   \
    }

LIST_STATEMENT(vertex_vectors, list_vector);
LIST_STATEMENT(normal_vectors, list_vector);
LIST_STATEMENT(uv_vectors, list_vector);
LIST_STATEMENT(face_indices, list_index);
LIST_STATEMENT(normal_indices, list_index);
LIST_STATEMENT(uv_indices, list_index);

/* Textures that triangles name by their places in the list. */
static void list_texture(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    (void)value;
    frame->arguments = 1;
    if (parser->builder->listed++ == parser->builder->announced)
        parser_mistake(parser, at,
                       "this list announces %lld textures but has "
                       "more",
                       (long long)parser->builder->announced);
    ((struct object *)frame->node)->lacks = lacks_textures;
}

static void list_texture_count(struct parser *parser, struct frame *frame,
                               const struct value *number, struct location at)
{
    if (number->kind != VALUE_NUMBER || frame->arguments > 0)
        parser_mistake(parser, at, "a texture_list has a count and textures");
    else
        announced(parser, frame, number, at);
}

const struct statement build_statement_texture_list = {
    .word = "texture_list",
    .within = in_mesh2,
    .takes = BUILD_TAKES(VALUE_TEXTURE),
    .arguments = list_rows,
    .needed = 1,
    .open = open_list,
    .argument = list_texture_count,
    .apply = list_texture,
    .close = close_list,
};

/* ---- its triangles ----------------------------------------------------- */

static const struct param mesh2_params[] = {BUILD_MESH_ROWS, {0}};

static void open_mesh2(struct parser *parser, struct frame *frame)
{
    for (int i = 0; i < 3; i++)
        parser->builder->indices[i].count = 0;
    build_mesh_open(parser, frame, "mesh2");
    parser->builder->begun = frame->node;
}

/* Without indices of their own, as many normals or uvs as vertices go with
 * the vertices. */
static const struct index_list *indices_for(const struct builder *builder,
                                            int which, size_t items,
                                            size_t vertices)
{
    const struct index_list *own = &builder->indices[which];

    if (items == 0 || own->count > 0)
        return own;
    return items == vertices ? &builder->indices[LIST_FACES] : own;
}

static bool make_triangles(const struct builder *builder, struct mesh *mesh,
                           struct brume_error *err)
{
    static const uint32_t none[3] = {MESH_NONE, MESH_NONE, MESH_NONE};
    const struct index_list *faces = &builder->indices[LIST_FACES];
    const struct index_list *normals = indices_for(
        builder, LIST_NORMALS, mesh->normals, mesh->vertices);
    const struct index_list *uvs = indices_for(builder, LIST_UVS, mesh->uvs,
                                               mesh->vertices);

    for (size_t i = 0; i < faces->count; i++) {
        const uint32_t *normal = i < normals->count ? normals->item[i] : none;
        if (!mesh_add_triangle(mesh, faces->item[i],
                               normals->count ? normal : NULL,
                               uvs->count ? uvs->item[i] : NULL, err))
            return false;
    }
    return true;
}

/* POV-Ray's rules of how many indices go with how many faces. */
static bool check_counts(struct parser *parser, const struct mesh *mesh,
                         struct location at)
{
    const struct index_list *list = parser->builder->indices;

    if (list[LIST_FACES].count == 0)
        return parser_error(parser, at, "this mesh2 has no face_indices");
    if (list[LIST_NORMALS].count > list[LIST_FACES].count)
        return parser_error(parser, at,
                            "this mesh2 has %zu normal_indices "
                            "for %zu faces",
                            list[LIST_NORMALS].count, list[LIST_FACES].count);
    if (list[LIST_UVS].count > 0 &&
        list[LIST_UVS].count != list[LIST_FACES].count)
        return parser_error(parser, at,
                            "this mesh2 has %zu uv_indices for "
                            "%zu faces",
                            list[LIST_UVS].count, list[LIST_FACES].count);
    if (mesh->normals > 0 && list[LIST_NORMALS].count == 0 &&
        mesh->normals != mesh->vertices)
        return parser_error(parser, at,
                            "this mesh2 needs normal_indices: it "
                            "has %zu normals for %zu vertices",
                            mesh->normals, mesh->vertices);
    return true;
}

static void close_mesh2(struct parser *parser, struct frame *frame,
                        struct location at)
{
    struct object *object = frame->node;
    struct mesh *mesh = object->mesh->mesh;
    struct brume_error err = {0};

    (void)at;
    if (object->mesh->taken)
        return;
    parser->out->counts.meshes_read++;
    bool whole = build_literal_is_whole(parser, object->mesh);
    if (!check_counts(parser, mesh, frame->at))
        return;
    if (!make_triangles(parser->builder, mesh, &err) || !mesh_check(mesh, &err))
        parser_relay(parser, frame->at, &err);
    else if (whole)
        build_literal_keep(parser, object->mesh, true);
}

const struct statement build_statement_mesh2 = {
    .word = "mesh2",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .size = sizeof(struct object),
    .params = mesh2_params,
    .open = open_mesh2,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_mesh2,
    .set = build_mesh_set,
};
