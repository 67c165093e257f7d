/* build_literal.c - meshes that are kept from frame to frame of a film. */
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"
#include "parser/kept.h"

bool build_literal_begins(struct parser *parser)
{
    struct object *object = parser->builder->begun;

    if (!object)
        return false;
    parser->builder->begun = NULL;
    parser->builder->literal = object;
    return !parser->failed && object->mesh && object->mesh->mesh;
}

/* How many items of each sort there are before the mesh is closed. */
static void count_items(const struct builder *builder, const struct mesh *mesh,
                        size_t out[MODEL_LISTS])
{
    out[0] = mesh->vertices;
    out[1] = mesh->normals;
    out[2] = mesh->uvs;
    out[3] = mesh->triangles;
    for (int i = 0; i < 3; i++)
        out[4 + i] = builder->indices[i].count;
}

void build_literal_take(struct parser *parser, const struct kept_mesh *kept)
{
    struct object *object = parser->builder->literal;
    struct model_mesh *mesh = object->mesh;

    mesh_free(mesh->mesh);
    mesh->mesh = mesh_share(kept->mesh);
    mesh->taken = kept;
    object->lacks = kept->lacks;
    parser->out->counts.meshes_kept++;
}

void build_literal_reached(struct parser *parser, struct kept_mesh *kept)
{
    struct object *object = parser->builder->literal;

    object->mesh->literal = kept;
    kept->lacks = object->lacks;
    count_items(parser->builder, object->mesh->mesh, object->mesh->listed);
}

bool build_literal_is_whole(const struct parser *parser,
                            const struct model_mesh *mesh)
{
    size_t now[MODEL_LISTS];

    if (!mesh->literal)
        return false;
    count_items(parser->builder, mesh->mesh, now);
    return memcmp(now, mesh->listed, sizeof now) == 0;
}

void build_literal_keep(const struct parser *parser, struct model_mesh *mesh,
                        bool lists)
{
    struct kept_mesh *kept = mesh->literal;

    if (parser->failed || kept->mesh)
        return;
    memcpy(kept->listed, mesh->listed + 4, sizeof kept->listed);
    kept->lists = lists;
    kept->mesh = mesh_share(mesh->mesh);
}

/* The indices that a list had when its mesh was closed. */
static bool restore(struct index_list *list, uint32_t (*corner)[3],
                    size_t count, struct brume_error *err)
{
    uint32_t(*item)[3] = memory_grow(list->item, &list->room, count + 1,
                                     sizeof *item, err);

    if (!item)
        return false;
    list->item = item;
    list->count = count;
    if (count > 0)
        memcpy(item, corner, count * sizeof *item);
    return true;
}

/* A mesh2 makes its triangles of the lists when it is closed. */
static bool restore_lists(struct builder *builder, const struct kept_mesh *kept,
                          struct mesh *mesh, struct brume_error *err)
{
    uint32_t(*corner[3])[3] = {mesh->corner, mesh->corner_normal,
                               mesh->corner_uv};

    for (int i = 0; i < 3; i++)
        if (!restore(&builder->indices[i], corner[i], kept->listed[i], err))
            return false;
    for (int i = 0; i < 3; i++)
        free(corner[i]);
    mesh->corner = mesh->corner_normal = mesh->corner_uv = NULL;
    mesh->triangles = mesh->triangle_capacity = 0;
    return true;
}

bool build_literal_own(struct parser *parser, struct model_mesh *mesh,
                       struct location at)
{
    struct brume_error err = {0};

    if (!mesh->taken)
        return true;
    struct mesh *copy = mesh_copy(mesh->mesh, &err);
    if (!copy)
        return parser_relay(parser, at, &err);
    mesh_free(mesh->mesh);
    mesh->mesh = copy;
    bool lists = mesh->taken->lists;
    const struct kept_mesh *kept = mesh->taken;
    mesh->taken = NULL;
    return !lists || restore_lists(parser->builder, kept, copy, &err) ||
           parser_relay(parser, at, &err);
}
