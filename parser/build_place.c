/* build_place.c - finished values to core: unions are flattened, other groups
 * become composites of parts, textures and interiors are handed down to those
 * who have none, equal things are sent once. */
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"
#include "parser/expander.h"

/* What a group hands down to its members. */
struct inheritance {
    transform by;
    struct placed_texture texture; /* placed in the world             */
    struct placed_interior interior;
    bool hollow, shadow;
};

enum placing_phase {
    PLACING_LOOSE, /* members are placed one by one           */
    PLACING_PARTS, /* members become parts of a composite,    */
    PLACING_CLIPS  /* and what cuts it                        */
};

/* A group, or what is cut, whose members are being placed. */
struct placing {
    const struct object *object;
    struct inheritance has;
    const struct child *next;
    enum placing_phase phase;
    bool part;           /* it is a part itself                     */
    size_t first, clips; /* of builder.part: its parts, its clips   */
};

/* Core shares a mesh, so ours goes when its first user is placed. */
static int send_mesh(struct parser *parser, struct model_mesh *mesh,
                     struct brume_error *err)
{
    if (mesh->id < 0) {
        mesh->id = brume_share_mesh(parser->out->scene, mesh->mesh, err);
        mesh_free(mesh->mesh);
        mesh->mesh = NULL;
    }
    return mesh->id;
}

/* ---- objects ----------------------------------------------------------- */

static void inherit(const struct object *object, const struct inheritance *from,
                    struct inheritance *out)
{
    *out = *from;
    out->by = transform_then(&object->by, &from->by);
    if (object->texture.what) {
        out->texture.what = object->texture.what;
        out->texture.by = transform_then(&object->texture.by, &from->by);
    }
    if (object->interior.what) {
        out->interior.what = object->interior.what;
        out->interior.by = transform_then(&object->interior.by, &from->by);
    }
    if (object->says_hollow)
        out->hollow = object->hollow;
    out->shadow = from->shadow && !object->no_shadow;
}

/* POV-Ray shows the media of hollow objects only, and says nothing. */
static bool shows_media(struct parser *parser, const struct object *object,
                        const struct inheritance *has)
{
    struct interior *interior = has->interior.what;

    if (!interior || interior->count == 0)
        return false;
    if (!has->hollow && !interior->warned) {
        interior->warned = true;
        parser_warn(parser, object->at,
                    "the media of this %s is not shown: "
                    "it is not 'hollow'",
                    object->word);
    }
    return has->hollow;
}

static void note_lacks(struct parser *parser, const struct object *object)
{
    if (object->lacks)
        build_lacks(parser, object->lacks, object->at);
    if (object->no_image)
        build_lacks(parser, "no_image", object->at);
    if (object->no_reflection)
        build_lacks(parser, "no_reflection", object->at);
    if (object->double_illuminate)
        build_lacks(parser, "double_illuminate", object->at);
    if (object->no_radiosity)
        parser->builder->no_radiosity = true;
    if (object->cutaway)
        build_lacks(parser, "cutaway_textures", object->at);
}

static bool vanishes(const struct brume_shape *shape)
{
    return shape->radius == 0 &&
           (shape->kind == BRUME_SHAPE_SPHERE ||
            shape->kind == BRUME_SHAPE_CYLINDER ||
            shape->kind == BRUME_SHAPE_DISC ||
            (shape->kind == BRUME_SHAPE_CONE && shape->radius_b == 0));
}

/* What it is made of, which does not matter to queries. */
static bool dress(struct parser *parser, const struct object *object,
                  const struct inheritance *has, struct brume_shape *shape,
                  struct brume_error *err)
{
    const struct placed_texture bare = {&parser->builder->default_texture,
                                        transform_identity(), false};

    if (parser->builder->querying)
        return true;
    const struct placed_texture *worn = has->texture.what ? &has->texture
                                                          : &bare;
    note_lacks(parser, object);
    build_lacks_of(parser, object, worn->what, has->interior.what);
    shape->hollow = has->hollow;
    shape->shadow = has->shadow;
    shape->material = build_send_material(parser, worn, err);
    if (shows_media(parser, object, has))
        shape->interior = build_send_interior(parser, has->interior.what->media,
                                              has->interior.what->count,
                                              &has->interior.by, err);
    return err->code == BRUME_OK;
}

/* The object's own shape to core; -1: an error. */
static int send_shape(struct parser *parser, const struct object *object,
                      const struct inheritance *has, struct brume_shape *shape,
                      struct brume_error *err)
{
    shape->inverse = object->inverse;
    if (object->kind == OBJECT_MESH) {
        memcpy(shape->a, object->inside, sizeof shape->a);
        shape->mesh = send_mesh(parser, object->mesh, err);
    }
    if (err->code != BRUME_OK || !dress(parser, object, has, shape, err))
        return -1;
    return brume_add_shape(parser->out->scene, shape, err);
}

enum { VANISHED = -1 };

static bool keep_part(struct parser *parser, int id, struct brume_error *err)
{
    struct builder *builder = parser->builder;
    int *grown = memory_grow(builder->part, &builder->part_room,
                             builder->parts + 1, sizeof *grown, err);

    if (!grown)
        return false;
    builder->part = grown;
    grown[builder->parts++] = id;
    return true;
}

static bool place_leaf(struct parser *parser, const struct object *object,
                       const struct inheritance *has, bool part,
                       struct brume_error *err)
{
    struct brume_shape shape = object->shape;

    if (vanishes(&shape)) {
        parser_warn(parser, object->at, "this %s has radius 0 and is left out",
                    object->word);
        return !part || keep_part(parser, VANISHED, err);
    }
    memcpy(shape.transform, has->by.m, sizeof shape.transform);
    shape.part = part;
    int id = send_shape(parser, object, has, &shape, err);
    return id >= 0 && parser_hold(parser, object->at, 2 * sizeof shape) &&
           (!part || keep_part(parser, id, err));
}

static bool place_light(struct parser *parser, const struct object *object,
                        const struct inheritance *has, struct brume_error *err)
{
    struct brume_light light = object->light;

    if (parser->builder->querying)
        return true;
    note_lacks(parser, object);
    transform_point(&has->by, light.location, light.location);
    transform_point(&has->by, light.point_at, light.point_at);
    for (int i = 0; i < 2; i++)
        transform_vector(&has->by, light.area_axis[i], light.area_axis[i]);
    return brume_add_light(parser->out->scene, &light, err) >= 0 &&
           parser_hold(parser, object->at, 2 * sizeof light);
}

static bool place_one(struct parser *parser, const struct object *object,
                      const struct inheritance *from, bool part, size_t *depth,
                      struct brume_error *err);

/* What a light looks like is about its place, and in nobody's light. */
static bool place_looks(struct parser *parser, const struct object *object,
                        const struct inheritance *has, size_t *depth,
                        struct brume_error *err)
{
    transform there = transform_translate(object->light.location);
    struct inheritance from = {.by = transform_then(&there, &has->by)};
    const struct child *child = object->members.first;

    if (!child || parser->builder->querying)
        return true;
    return place_one(parser, child->object, &from, false, depth, err);
}

/* ---- composites -------------------------------------------------------- */

/* Takes those that vanished from a list of parts; true if the composite does
 * so with them. */
static bool drop_vanished(enum brume_shape_kind kind, int *part, size_t *count)
{
    size_t kept = 0;

    if (kind == BRUME_SHAPE_DIFFERENCE && *count > 0 && part[0] == VANISHED)
        return true;
    for (size_t i = 0; i < *count; i++)
        if (part[i] != VANISHED)
            part[kept++] = part[i];
    bool lost = kept < *count;
    *count = kept;
    return kept == 0 || (kind == BRUME_SHAPE_INTERSECTION && lost);
}

/* All parts and clips of a composite are known. */
static bool place_composite(struct parser *parser, const struct placing *top,
                            struct brume_error *err)
{
    struct builder *builder = parser->builder;
    const struct object *object = top->object;
    struct brume_shape shape = object->shape;
    int *part = builder->part ? builder->part + top->first : NULL;
    int *clip = builder->part ? builder->part + top->clips : NULL;
    bool group = object->kind == OBJECT_GROUP;
    int id = VANISHED;

    shape.part_count = top->clips - top->first;
    shape.clip_count = builder->parts - top->clips;
    bool gone = (group && drop_vanished(shape.kind, part, &shape.part_count)) ||
                (shape.clip_count > 0 &&
                 drop_vanished(BRUME_SHAPE_INTERSECTION, clip,
                               &shape.clip_count));
    if (!gone) {
        shape.parts = group ? part : NULL;
        shape.clips = clip;
        shape.part = top->part;
        if (!group)
            memcpy(shape.transform, top->has.by.m, sizeof shape.transform);
        id = send_shape(parser, object, &top->has, &shape, err);
    }
    builder->parts = top->first;
    return (gone || id >= 0) && (!top->part || keep_part(parser, id, err));
}

/* A stack in place of recursion: groups may be nested as deep as a user's
 * script likes. */
static struct placing *push(struct builder *builder, size_t depth,
                            struct brume_error *err)
{
    struct placing *stack = memory_grow(builder->placing,
                                        &builder->placing_room, depth + 1,
                                        sizeof *stack, err);

    if (stack)
        builder->placing = stack;
    return stack;
}

static bool place_one(struct parser *parser, const struct object *object,
                      const struct inheritance *from, bool part, size_t *depth,
                      struct brume_error *err)
{
    struct inheritance has;
    bool group = object->kind == OBJECT_GROUP;
    bool loose = group && !part && !object->clips.first && !object->inverse &&
                 object->shape.kind == BRUME_SHAPE_UNION;

    inherit(object, from, &has);
    if (object->kind == OBJECT_LIGHT)
        return place_light(parser, object, &has, err) &&
               place_looks(parser, object, &has, depth, err);
    if (!group && !object->clips.first)
        return place_leaf(parser, object, &has, part, err);
    struct placing *stack = push(parser->builder, *depth, err);
    if (!stack)
        return false;
    if (loose)
        note_lacks(parser, object);
    stack[(*depth)++] = (struct placing){.object = object,
                                         .has = has,
                                         .next = object->members.first,
                                         .phase = loose ? PLACING_LOOSE
                                                        : PLACING_PARTS,
                                         .part = part,
                                         .first = parser->builder->parts};
    return true;
}

/* The next member of the innermost group, or its end. */
static bool place_next(struct parser *parser, size_t *depth,
                       struct brume_error *err)
{
    struct placing *top = &parser->builder->placing[*depth - 1];
    const struct child *child = top->next;
    struct inheritance from = top->has;

    if (child) {
        top->next = child->next;
        /* A single shape takes its clips along (brume.h); those of a group
         * come where its parts do. */
        if (top->phase == PLACING_CLIPS && top->object->kind != OBJECT_GROUP)
            from.by = transform_identity();
        if (child->before)
            from.by = transform_then(child->before, &from.by);
        return place_one(parser, child->object, &from,
                         top->phase != PLACING_LOOSE, depth, err);
    }
    if (top->phase == PLACING_PARTS) {
        top->phase = PLACING_CLIPS;
        top->clips = parser->builder->parts;
        top->next = top->object->clips.first;
        return true;
    }
    struct placing done = *top;
    (*depth)--;
    return done.phase == PLACING_LOOSE || place_composite(parser, &done, err);
}

static bool place_object(struct parser *parser, const struct object *object,
                         bool part)
{
    struct inheritance world = {.by = transform_identity(), .shadow = true};
    struct brume_error err = {0};
    size_t depth = 0;

    parser->builder->parts = 0;
    bool fine = place_one(parser, object, &world, part, &depth, &err);
    while (fine && depth > 0) {
        /* A few lines can name a thing more often than there is time for. */
        expander_spend(parser, 1, object->at);
        if (parser->failed)
            return false;
        fine = place_next(parser, &depth, &err);
    }
    return fine || parser_relay(parser, object->at, &err);
}

int build_place_query(struct parser *parser, const struct object *object,
                      struct location at)
{
    struct builder *builder = parser->builder;

    builder->querying = true;
    bool fine = place_object(parser, object, true);
    builder->querying = false;
    if (!fine)
        return -1;
    if (builder->parts == 1 && builder->part[0] != VANISHED)
        return builder->part[0];
    parser_error(parser, at, "this object is empty");
    return -1;
}

/* ---- what stands on its own in a scene --------------------------------- */

static void add_atmosphere(struct parser *parser, const struct media *media,
                           struct location at)
{
    struct builder *builder = parser->builder;

    if (builder->atmospheres == BRUME_MAX_INTERIOR_MEDIA) {
        parser_error(parser, at, "a scene takes %d media of its own",
                     BRUME_MAX_INTERIOR_MEDIA);
        return;
    }
    if (builder->atmospheres == 0)
        builder->atmosphere_at = at;
    builder->atmosphere[builder->atmospheres++] = media;
}

bool build_place_atmosphere(struct parser *parser)
{
    struct builder *builder = parser->builder;
    transform here = transform_identity();
    struct brume_error err = {0};

    if (builder->atmospheres == 0)
        return true;
    int id = build_send_interior(parser, builder->atmosphere,
                                 builder->atmospheres, &here, &err);
    if (id >= 0 && brume_set_atmosphere(parser->out->scene, id, &err))
        return true;
    return parser_relay(parser, builder->atmosphere_at, &err);
}

/* An object that was made for its place alone. */
static void give_up_object(struct parser *parser, const struct value *value)
{
    struct object *object = value->node;

    if (value->node != parser->builder->fresh)
        return;
    if (object->texture.owned)
        build_give_up(parser, VALUE_TEXTURE, object->texture.what);
    build_give_up(parser, value->kind, object);
    parser->builder->fresh = NULL;
}

void build_place(struct parser *parser, const struct value *value,
                 struct location at)
{
    if (parser->failed)
        return;
    switch (value->kind) {
    case VALUE_OBJECT:
    case VALUE_LIGHT:
        place_object(parser, value->node, false);
        give_up_object(parser, value);
        break;
    case VALUE_CAMERA:
        parser->builder->camera = value->node;
        break;
    case VALUE_FOG:
        build_lacks(parser, "fog", at);
        break;
    case VALUE_RAINBOW:
        build_lacks(parser, "rainbows", at);
        break;
    case VALUE_SKY_SPHERE:
        parser->builder->sky = value->node;
        break;
    case VALUE_MEDIA:
        add_atmosphere(parser, value->node, at);
        break;
    default:
        break;
    }
}
