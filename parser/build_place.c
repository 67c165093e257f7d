/* build_place.c - finished values to core: unions are flattened, textures and
 * interiors handed down to those who have none, equal things sent once. */
#include <stdlib.h>
#include <string.h>

#include "lib/memory.h"
#include "lib/mesh.h"
#include "parser/builder.h"

/* What a union hands down to its parts. */
struct inheritance {
    transform by;
    struct placed_texture texture; /* placed in the world             */
    struct placed_interior interior;
    bool hollow, shadow;
};

/* A union whose parts are being placed. */
struct placing {
    struct inheritance from;
    const struct child *next;
};

/* ---- one time to core -------------------------------------------------- */

enum { SENT_MATERIAL, SENT_FIELD, SENT_MEDIUM, SENT_INTERIOR };

static int remember(struct parser *parser, int what, const void *bytes,
                    size_t size, int id)
{
    if (id >= 0)
        intern_keep(&parser->builder->intern[what], &parser->arena, bytes, size,
                    id);
    return id;
}

static int sent(struct parser *parser, int what, const void *bytes, size_t size)
{
    return intern_find(&parser->builder->intern[what], bytes, size);
}

static int send_material(struct parser *parser,
                         const struct placed_texture *worn,
                         struct brume_error *err)
{
    struct brume_material material;
    int id;

    if (model_is_invisible(worn->what))
        return -1;
    model_material(worn->what, &worn->by, &material);
    id = sent(parser, SENT_MATERIAL, &material, sizeof material);
    if (id >= 0)
        return id;
    id = brume_add_material(parser->out->scene, &material, err);
    return remember(parser, SENT_MATERIAL, &material, sizeof material, id);
}

static int send_field(struct parser *parser, const struct density *density,
                      const transform *by, struct brume_error *err)
{
    transform placing = transform_identity();
    struct brume_field field;
    int id;

    memset(&field, 0, sizeof field);
    field.kind = BRUME_FIELD_CONSTANT;
    field.scale = density->color[0];
    field.grid = -1;
    if (model_density_is_grid(density)) {
        const struct pattern *pattern = density->on.pattern;
        field.kind = BRUME_FIELD_GRID;
        field.grid = pattern->grid;
        placing = transform_then(&pattern->grid_by, &density->on.by);
        placing = transform_then(&placing, by);
    }
    memcpy(field.transform, placing.m, sizeof placing.m);
    id = sent(parser, SENT_FIELD, &field, sizeof field);
    if (id >= 0)
        return id;
    id = brume_add_field(parser->out->scene, &field, err);
    return remember(parser, SENT_FIELD, &field, sizeof field, id);
}

static bool send_fire(struct parser *parser, const struct fire *fire,
                      const transform *by, struct brume_fire *to,
                      struct brume_error *err)
{
    to->on = fire->on;
    to->temperature = to->amount = -1;
    if (!fire->on)
        return true;
    to->kelvin_scale = fire->kelvin[0];
    to->kelvin_offset = fire->kelvin[1];
    to->intensity = fire->intensity;
    to->reference = fire->reference;
    to->brightness = (enum brume_brightness)fire->brightness;
    to->additive = fire->additive != 0;
    to->temperature = send_field(parser, &fire->temperature, by, err);
    if (to->temperature < 0)
        return false;
    if (fire->has_amount)
        to->amount = send_field(parser, &fire->amount, by, err);
    return !fire->has_amount || to->amount >= 0;
}

/* A density's colour scales what the medium does, not the fire in it. */
static int send_medium(struct parser *parser, const struct media *media,
                       const transform *by, struct brume_error *err)
{
    struct brume_medium to;
    int id;

    memset(&to, 0, sizeof to);
    for (int i = 0; i < 3; i++) {
        to.absorption[i] = media->absorption[i] * media->tint[i];
        to.emission[i] = media->emission[i] * media->tint[i];
        to.scattering[i] = media->scattering[i] * media->tint[i];
    }
    to.phase = (enum brume_phase)media->type;
    to.eccentricity = media->eccentricity;
    to.extinction = media->extinction;
    to.densities = media->densities;
    for (int i = 0; i < BRUME_MAX_DENSITIES; i++) {
        to.density[i] = -1;
        if (i >= media->densities)
            continue;
        struct density plain = media->density[i];
        plain.color[0] = 1;
        to.density[i] = send_field(parser, &plain, by, err);
        if (to.density[i] < 0)
            return -1;
    }
    if (!send_fire(parser, &media->fire, by, &to.fire, err))
        return -1;
    id = sent(parser, SENT_MEDIUM, &to, sizeof to);
    if (id >= 0)
        return id;
    id = brume_add_medium(parser->out->scene, &to, err);
    return remember(parser, SENT_MEDIUM, &to, sizeof to, id);
}

static int send_interior(struct parser *parser,
                         const struct media *const *media, int count,
                         const transform *by, struct brume_error *err)
{
    int list[BRUME_MAX_INTERIOR_MEDIA] = {0};
    size_t size = (size_t)count * sizeof *list;
    int id;

    for (int i = 0; i < count; i++) {
        list[i] = send_medium(parser, media[i], by, err);
        if (list[i] < 0)
            return -1;
    }
    id = sent(parser, SENT_INTERIOR, list, size);
    if (id >= 0)
        return id;
    id = brume_add_interior(parser->out->scene, list, count, err);
    return remember(parser, SENT_INTERIOR, list, size, id);
}

/* Core copies a mesh, so ours goes when its first user is placed. */
static int send_mesh(struct parser *parser, struct model_mesh *mesh,
                     struct brume_error *err)
{
    if (mesh->id < 0) {
        mesh->id = brume_add_mesh(parser->out->scene, mesh->mesh, err);
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
    out->shadow = from->shadow && object->shadow;
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

static bool vanishes(const struct brume_shape *shape)
{
    return shape->radius == 0 &&
           (shape->kind == BRUME_SHAPE_SPHERE ||
            shape->kind == BRUME_SHAPE_CYLINDER ||
            shape->kind == BRUME_SHAPE_DISC ||
            (shape->kind == BRUME_SHAPE_CONE && shape->radius_b == 0));
}

static bool place_shape(struct parser *parser, const struct object *object,
                        const struct inheritance *has, struct brume_error *err)
{
    struct brume_shape shape = object->shape;
    const struct placed_texture bare = {&parser->builder->default_texture,
                                        transform_identity(), false};

    if (vanishes(&shape)) {
        parser_warn(parser, object->at, "this %s has radius 0 and is left out",
                    object->word);
        return true;
    }
    memcpy(shape.transform, has->by.m, sizeof shape.transform);
    shape.hollow = has->hollow;
    shape.inverse = object->inverse;
    shape.shadow = has->shadow;
    const struct placed_texture *worn = has->texture.what ? &has->texture
                                                          : &bare;
    build_lacks_of(parser, object, worn->what, has->interior.what);
    shape.material = send_material(parser, worn, err);
    if (shows_media(parser, object, has))
        shape.interior = send_interior(parser, has->interior.what->media,
                                       has->interior.what->count,
                                       &has->interior.by, err);
    if (object->kind == OBJECT_MESH)
        shape.mesh = send_mesh(parser, object->mesh, err);
    return err->code == BRUME_OK &&
           brume_add_shape(parser->out->scene, &shape, err) >= 0;
}

static bool place_light(struct parser *parser, const struct object *object,
                        const struct inheritance *has, struct brume_error *err)
{
    struct brume_light light = object->light;

    transform_point(&has->by, light.location, light.location);
    transform_point(&has->by, light.point_at, light.point_at);
    return brume_add_light(parser->out->scene, &light, err) >= 0;
}

/* A stack in place of recursion: unions may be nested as deep as a user's
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
                      const struct inheritance *from, size_t *depth,
                      struct brume_error *err)
{
    struct inheritance has;

    inherit(object, from, &has);
    if (object->kind == OBJECT_LIGHT)
        return place_light(parser, object, &has, err);
    if (object->kind != OBJECT_UNION)
        return place_shape(parser, object, &has, err);
    struct placing *stack = push(parser->builder, *depth, err);
    if (!stack)
        return false;
    stack[*depth].from = has;
    stack[(*depth)++].next = object->first;
    return true;
}

static void place_object(struct parser *parser, const struct object *object)
{
    struct inheritance world = {.by = transform_identity(), .shadow = true};
    const struct object *culprit = object;
    struct brume_error err = {0};
    size_t depth = 0;

    bool fine = place_one(parser, object, &world, &depth, &err);
    while (fine && depth > 0) {
        struct placing *top = &parser->builder->placing[depth - 1];
        if (!top->next) {
            depth--;
            continue;
        }
        struct inheritance from = top->from;
        culprit = top->next->object;
        top->next = top->next->next;
        fine = place_one(parser, culprit, &from, &depth, &err);
    }
    if (!fine)
        parser_relay(parser, culprit->at, &err);
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
    int id = send_interior(parser, builder->atmosphere, builder->atmospheres,
                           &here, &err);
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
        place_object(parser, value->node);
        give_up_object(parser, value);
        break;
    case VALUE_CAMERA:
        parser->builder->camera = value->node;
        break;
    case VALUE_MEDIA:
        add_atmosphere(parser, value->node, at);
        break;
    default:
        break;
    }
}
