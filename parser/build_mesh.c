/* build_mesh.c - triangle, smooth_triangle, mesh and mesh2. */
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"

const struct param build_mesh_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_ANY("inside_vector", PARAM_VECTOR, 0, 0, struct object, inside),
    PARAM_WITHOUT("hierarchy", "Brume builds its own hierarchies"),
    {0}};

/* A mesh of the builder's list, so that nothing is lost when a parse fails. */
struct model_mesh *build_mesh_new(struct parser *parser, struct location at)
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

static void open_any_mesh(struct parser *parser, struct frame *frame,
                          const char *word)
{
    struct object *object = build_object_start(frame, OBJECT_MESH,
                                               BRUME_SHAPE_MESH, word);

    object->mesh = build_mesh_new(parser, frame->at);
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
        open_any_mesh(parser, frame, "triangle");
}

static void triangle_argument(struct parser *parser, struct frame *frame,
                              const struct value *number, struct location at)
{
    static const struct param row = {
        .word = "corner", .kind = PARAM_VECTOR, .low = -INFINITY,
        .high = INFINITY, .alone = NAN};
    int needed = frame->kind == BUILD_TRIANGLE ? 3 : 6;

    if (frame->arguments >= needed)
        parser_error(parser, at, "a triangle takes no more vectors here");
    else
        param_set(parser, &row, parser->builder->corner[frame->arguments], at,
                  number, 1, at);
}

static bool add_normal(struct mesh *mesh, const double n[3],
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
            (smooth && !add_normal(mesh, builder->corner[at + 1], err)))
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
    const struct object *object =
        frame->node ? frame->node : build_around(parser)->node;
    struct brume_error err = {0};

    if (!add_triangle(parser->builder, object->mesh->mesh, smooth, &err))
        parser_relay(parser, at, &err);
}

static void apply_triangle(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    if (frame->node)
        build_object_apply(parser, frame, value, at);
    else
        parser_error(parser, at, "a %s of one triangle of a mesh is not "
                     "supported yet", value_name(value));
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

void build_uv_vectors(struct parser *parser, const struct value *uv,
                      int count, struct location at)
{
    struct frame *frame = build_top(parser);
    struct builder *builder = parser->builder;

    if (!frame)
        return;
    if (frame->kind != BUILD_TRIANGLE &&
        frame->kind != BUILD_SMOOTH_TRIANGLE) {
        parser_error(parser, at, "'uv_vectors' belongs to triangles here");
        return;
    }
    if (count != 3) {
        parser_error(parser, at, "a triangle has 3 uv_vectors, not %d",
                     count);
        return;
    }
    builder->uvs = 3;
    for (int i = 0; i < 3; i++) {
        builder->uv[i][0] = (float)uv[i].v[0];
        builder->uv[i][1] = (float)value_promote(uv[i], 2).v[1];
    }
}

static const struct param triangle_rows[] = {
    {.word = "first corner"}, {.word = "second corner"},
    {.word = "third corner"}, {0}};
static const struct param smooth_rows[] = {
    {.word = "first corner"}, {.word = "first normal"},
    {.word = "second corner"}, {.word = "second normal"},
    {.word = "third corner"}, {.word = "third normal"}, {0}};

const struct statement build_statement_triangle = {
    .word = "triangle",
    .makes = VALUE_OBJECT,
    .params = build_object_params,
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
    .params = build_object_params,
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
    open_any_mesh(parser, frame, "mesh");
}

static void set_mesh(struct parser *parser, struct frame *frame,
                     const struct param *row, struct location at)
{
    const struct object *object = frame->node;
    const double *v = object->inside;

    if (!strcmp(row->word, "inside_vector") &&
        v[0] == 0 && v[1] == 0 && v[2] == 0)
        parser_error(parser, at, "'inside_vector' has no direction");
    build_object_set(parser, frame, row, at);
}

void build_mesh_file(struct parser *parser, const char *format,
                     struct string name, struct location at)
{
    struct build_file file = build_file_named(format, name, at);
    struct frame *frame = build_top(parser);

    if (!frame)
        return;
    struct object *object = frame->node;
    if (object->mesh->mesh == NULL || object->mesh->mesh->triangles > 0) {
        parser_error(parser, at, "a mesh has triangles or one file, not both");
        return;
    }
    struct model_mesh *mesh = load_mesh(parser, &file);
    if (mesh)
        object->mesh = mesh;
}

static void close_mesh(struct parser *parser, struct frame *frame,
                       struct location at)
{
    const struct object *object = frame->node;
    const struct mesh *mesh = object->mesh->mesh;

    (void)at;
    if (mesh && mesh->triangles == 0)
        parser_error(parser, frame->at, "this mesh has no triangles");
}

const struct statement build_statement_mesh = {
    .word = "mesh",
    .makes = VALUE_OBJECT,
    .size = sizeof(struct object),
    .params = build_mesh_params,
    .open = open_mesh,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_mesh,
    .set = set_mesh,
};

/* ---- mesh2: its lists -------------------------------------------------- */

enum { LIST_FACES, LIST_NORMALS, LIST_UVS };

static void open_list(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
    parser->builder->announced = -1;
    parser->builder->listed = 0;
}

/* The first number of a list says how many items follow. */
static bool announced(struct parser *parser, struct frame *frame,
                      const struct value *number, struct location at)
{
    struct builder *builder = parser->builder;

    if (frame->arguments == 0) {
        if (number->terms != 1 || !(number->v[0] >= 0) ||
            number->v[0] > 4294967294.0)
            parser_error(parser, at, "the count of a list must be from 0 to "
                         "4294967294");
        builder->announced = (int64_t)number->v[0];
        /* Counted on in 64 bits by `listed`. */
        return false;
    }
    frame->arguments = 1;
    if (builder->listed++ < builder->announced)
        return true;
    return parser_error(parser, at, "this list announces %lld items but has "
                        "more", (long long)builder->announced);
}

static void list_vector(struct parser *parser, struct frame *frame,
                        const struct value *number, struct location at)
{
    struct object *object = frame->node;
    struct mesh *mesh = object->mesh->mesh;
    struct value v = value_promote(*number, 3);
    struct brume_error err = {0};
    bool fine;

    if (!announced(parser, frame, number, at))
        return;
    if (frame->kind == BUILD_VERTEX_VECTORS) {
        fine = mesh_add_vertex(mesh, v.v, &err);
    } else if (frame->kind == BUILD_NORMAL_VECTORS) {
        fine = add_normal(mesh, v.v, &err);
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

static void list_index(struct parser *parser, struct frame *frame,
                       const struct value *number, struct location at)
{
    struct index_list *list = list_of(parser, frame->kind);
    struct brume_error err = {0};
    uint32_t (*item)[3];

    if (frame->arguments > 0 && number->terms == 1) {
        parser_error(parser, at, "textures of single triangles are not "
                     "supported yet");
        return;
    }
    if (!announced(parser, frame, number, at))
        return;
    item = memory_grow(list->item, &list->room, list->count + 1,
                       sizeof *item, &err);
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
        parser_error(parser, frame->at, "this list announces %lld items but "
                     "has %lld", (long long)builder->announced,
                     (long long)builder->listed);
}

static const struct param list_rows[] = {{.word = "count"}, {0}};

#define LIST_STATEMENT(name, item)                                            \
    const struct statement build_statement_##name = {                         \
        .word = #name,                                                        \
        .arguments = list_rows,                                               \
        .needed = 1,                                                          \
        .open = open_list,                                                    \
        .argument = item,                                                     \
        .close = close_list,                                                  \
    }

LIST_STATEMENT(vertex_vectors, list_vector);
LIST_STATEMENT(normal_vectors, list_vector);
LIST_STATEMENT(uv_vectors, list_vector);
LIST_STATEMENT(face_indices, list_index);
LIST_STATEMENT(normal_indices, list_index);
LIST_STATEMENT(uv_indices, list_index);

/* ---- mesh2: its triangles ---------------------------------------------- */

static void open_mesh2(struct parser *parser, struct frame *frame)
{
    for (int i = 0; i < 3; i++)
        parser->builder->indices[i].count = 0;
    open_any_mesh(parser, frame, "mesh2");
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
        const uint32_t *normal =
            i < normals->count ? normals->item[i] : none;
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
        return parser_error(parser, at, "this mesh2 has %zu normal_indices "
                            "for %zu faces", list[LIST_NORMALS].count,
                            list[LIST_FACES].count);
    if (list[LIST_UVS].count > 0 &&
        list[LIST_UVS].count != list[LIST_FACES].count)
        return parser_error(parser, at, "this mesh2 has %zu uv_indices for "
                            "%zu faces", list[LIST_UVS].count,
                            list[LIST_FACES].count);
    if (mesh->normals > 0 && list[LIST_NORMALS].count == 0 &&
        mesh->normals != mesh->vertices)
        return parser_error(parser, at, "this mesh2 needs normal_indices: it "
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
    if (!check_counts(parser, mesh, frame->at))
        return;
    if (!make_triangles(parser->builder, mesh, &err) ||
        !mesh_check(mesh, &err))
        parser_relay(parser, frame->at, &err);
}

const struct statement build_statement_mesh2 = {
    .word = "mesh2",
    .makes = VALUE_OBJECT,
    .size = sizeof(struct object),
    .params = build_mesh_params,
    .open = open_mesh2,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_mesh2,
    .set = set_mesh,
};
