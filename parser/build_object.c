/* build_object.c - what all objects have, and the simple shapes. */
#include <string.h>

#include "lib/memory.h"
#include "parser/builder.h"

#define POINT(word, member)                                                    \
    PARAM_ANY(word, PARAM_VECTOR, 0, 0, struct object, shape.member)
#define LENGTH(word, member)                                                   \
    PARAM_ANY(word, PARAM_FLOAT, 0, 0, struct object, shape.member)

/* ---- modifiers that all objects have ----------------------------------- */

const struct param build_object_params[] = {BUILD_OBJECT_ROWS, {0}};

void build_object_set(struct parser *parser, struct frame *frame,
                      const struct param *row, struct location at)
{
    struct object *object = frame->node;

    (void)parser;
    (void)at;
    if (row->given & OBJECT_HOLLOW)
        object->says_hollow = true;
    if (row->given & OBJECT_INVERSE)
        object->inverse = !object->inverse;
}

const struct object *build_object_of(const struct frame *frame)
{
    return build_statement_of(frame)->makes == VALUE_OBJECT ? frame->node
                                                            : NULL;
}

void build_object_apply(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *object = frame->node;
    const struct material *material;

    switch (value->kind) {
    case VALUE_TEXTURE:
    case VALUE_PIGMENT:
    case VALUE_NORMAL:
    case VALUE_FINISH:
        build_wear(parser, &object->texture, value);
        break;
    case VALUE_INTERIOR_TEXTURE:
        object->inner = (struct placed_texture){value->node,
                                                transform_identity(), false};
        break;
    case VALUE_INTERIOR:
        object->interior.what = value->node;
        object->interior.by = transform_identity();
        break;
    case VALUE_MATERIAL:
        material = value->node;
        if (material->interior.what)
            object->interior = material->interior;
        if (material->texture.what) {
            struct placed_texture over = material->texture;
            over.owned = false;
            build_wear_placed(parser, &object->texture, &over);
        }
        if (material->inner.what)
            object->inner = material->inner;
        break;
    default:
        build_misplaced(parser, frame, value, at);
        break;
    }
}

void build_object_move(struct parser *parser, struct frame *frame,
                       const transform *by)
{
    (void)parser;
    model_object_transform(frame->node, by);
}

struct object *build_object_start(struct frame *frame, enum object_kind kind,
                                  enum brume_shape_kind shape, const char *word)
{
    static const struct brume_shape start = BRUME_SHAPE_INIT;
    struct object *object = frame->node;

    object->kind = kind;
    object->word = word;
    object->at = frame->at;
    object->shape = start;
    object->shape.kind = shape;
    object->by = object->texture.by = object->inner.by = object->interior.by =
        transform_identity();
    return object;
}

/* ---- numbers of long lists --------------------------------------------- */

bool build_number(struct parser *parser, double number, struct location at)
{
    struct builder *builder = parser->builder;
    struct brume_error err = {0};
    double *grown = memory_grow(builder->number, &builder->number_room,
                                builder->numbers + 1, sizeof *grown, &err);

    if (!grown)
        return parser_relay(parser, at, &err);
    builder->number = grown;
    grown[builder->numbers++] = number;
    return true;
}

bool build_take_numbers(struct parser *parser, struct frame *frame,
                        struct object *object)
{
    struct builder *builder = parser->builder;
    size_t count = builder->numbers - frame->mark;
    double *data = parser_array(parser, count, sizeof *data);

    if (!data)
        return false;
    if (count > 0)
        memcpy(data, builder->number + frame->mark, count * sizeof *data);
    builder->numbers = frame->mark;
    object->shape.data = data;
    object->shape.count = count;
    return true;
}

/* ---- simple shapes ----------------------------------------------------- */

void build_shape_open(struct parser *parser, struct frame *frame)
{
    static const int kinds[BUILD_KINDS] = {
        [BUILD_SPHERE] = BRUME_SHAPE_SPHERE,
        [BUILD_BOX] = BRUME_SHAPE_BOX,
        [BUILD_CYLINDER] = BRUME_SHAPE_CYLINDER,
        [BUILD_CONE] = BRUME_SHAPE_CONE,
        [BUILD_PLANE] = BRUME_SHAPE_PLANE,
        [BUILD_DISC] = BRUME_SHAPE_DISC,
        [BUILD_TORUS] = BRUME_SHAPE_TORUS,
        [BUILD_OVUS] = BRUME_SHAPE_OVUS,
        [BUILD_TEXT] = BRUME_SHAPE_TEXT,
        [BUILD_QUADRIC] = BRUME_SHAPE_QUADRIC,
        [BUILD_CUBIC] = BRUME_SHAPE_POLY,
        [BUILD_QUARTIC] = BRUME_SHAPE_POLY,
        [BUILD_POLY] = BRUME_SHAPE_POLY,
        [BUILD_POLYNOMIAL] = BRUME_SHAPE_POLY,
        [BUILD_SUPERELLIPSOID] = BRUME_SHAPE_SUPERELLIPSOID,
        [BUILD_JULIA_FRACTAL] = BRUME_SHAPE_JULIA,
        [BUILD_LATHE] = BRUME_SHAPE_LATHE,
        [BUILD_PRISM] = BRUME_SHAPE_PRISM,
        [BUILD_SOR] = BRUME_SHAPE_SOR,
        [BUILD_SPHERE_SWEEP] = BRUME_SHAPE_SPHERE_SWEEP,
        [BUILD_POLYGON] = BRUME_SHAPE_POLYGON,
        [BUILD_BICUBIC_PATCH] = BRUME_SHAPE_BICUBIC_PATCH,
        [BUILD_BLOB] = BRUME_SHAPE_BLOB,
        [BUILD_ISOSURFACE] = BRUME_SHAPE_ISOSURFACE,
        [BUILD_PARAMETRIC] = BRUME_SHAPE_PARAMETRIC,
        [BUILD_HEIGHT_FIELD] = BRUME_SHAPE_HEIGHT_FIELD};

    build_object_start(frame, OBJECT_SHAPE,
                       (enum brume_shape_kind)kinds[frame->kind],
                       build_statement_of(frame)->word);
    frame->mark = parser->builder->numbers;
}

static const struct param sphere_arguments[] = {
    POINT("center", a), LENGTH("radius", radius), {0}};
static const struct param box_arguments[] = {
    POINT("first corner", a), POINT("second corner", b), {0}};
static const struct param cylinder_arguments[] = {POINT("base point", a),
                                                  POINT("cap point", b),
                                                  LENGTH("radius", radius),
                                                  {0}};
static const struct param cone_arguments[] = {POINT("base point", a),
                                              LENGTH("base radius", radius),
                                              POINT("cap point", b),
                                              LENGTH("cap radius", radius_b),
                                              {0}};
static const struct param plane_arguments[] = {
    POINT("normal", a), LENGTH("distance", radius), {0}};
static const struct param disc_arguments[] = {POINT("center", a),
                                              POINT("normal", b),
                                              LENGTH("radius", radius),
                                              LENGTH("hole radius", radius_b),
                                              {0}};
static const struct param torus_arguments[] = {
    LENGTH("major radius", radius), LENGTH("minor radius", radius_b), {0}};

static const struct param ovus_arguments[] = {
    LENGTH("bottom radius", radius), LENGTH("top radius", radius_b), {0}};

static const struct param tube_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_WORD("open", PARAM_SWITCH, 1, 0, struct object, shape.open),
    {0}};

/* Corners may be named in any order, radii may be negative, as in POV-Ray. */
static void close_shape(struct parser *parser, struct frame *frame,
                        struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;

    (void)parser;
    (void)at;
    for (int i = 0; i < 3 && shape->kind == BRUME_SHAPE_BOX; i++)
        if (shape->a[i] > shape->b[i]) {
            double low = shape->b[i];
            shape->b[i] = shape->a[i];
            shape->a[i] = low;
        }
    if (shape->kind != BRUME_SHAPE_PLANE) {
        shape->radius = fabs(shape->radius);
        shape->radius_b = fabs(shape->radius_b);
    }
}

#define SHAPE_STATEMENT(name, count, table)                                    \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = VALUE_OBJECT,                                                 \
        .takes = BUILD_TAKES_WORN,                                             \
        .size = sizeof(struct object),                                         \
        .params = table,                                                       \
        .arguments = name##_arguments,                                         \
        .needed = count,                                                       \
        .open = build_shape_open,                                              \
        .apply = build_object_apply,                                           \
        .move = build_object_move,                                             \
        .close = close_shape,                                                  \
        .set = build_object_set,                                               \
    }

SHAPE_STATEMENT(sphere, 2, build_object_params);
SHAPE_STATEMENT(box, 2, build_object_params);
SHAPE_STATEMENT(cylinder, 3, tube_params);
SHAPE_STATEMENT(cone, 4, tube_params);
SHAPE_STATEMENT(plane, 2, build_object_params);
SHAPE_STATEMENT(disc, 3, build_object_params);
SHAPE_STATEMENT(torus, 2, build_object_params);
SHAPE_STATEMENT(ovus, 2, build_object_params);

/* ---- what objects say of photons and radiosity: POV-Ray's own ways ----- */

static const char own_light[] = "Brume finds indirect light in its own way";

static const struct param photons_params[] = {
    PARAM_WITHOUT("target", own_light),
    PARAM_WITHOUT("reflection", own_light),
    PARAM_WITHOUT("refraction", own_light),
    PARAM_WITHOUT("collect", own_light),
    PARAM_WITHOUT("pass_through", own_light),
    PARAM_WITHOUT("area_light", own_light),
    {0}};
static const struct param radiosity_params[] = {
    PARAM_WITHOUT("importance", own_light), {0}};

/* They belong into whatever makes an object or a light. */
static void open_aside(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

const struct statement build_statement_object_photons = {
    .word = "photons",
    .in_objects = true,
    .params = photons_params,
    .open = open_aside,
};

const struct statement build_statement_object_radiosity = {
    .word = "radiosity",
    .in_objects = true,
    .params = radiosity_params,
    .open = open_aside,
};
