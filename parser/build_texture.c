/* build_texture.c - pigment, finish, texture, material and #default. */
#include <string.h>

#include "parser/builder.h"

/* ---- where a statement starts from ------------------------------------- */

/* What the statement around has by now, so that `pigment { scale 2 }` changes
 * what is there; the default texture where nothing is. */
static const struct texture *texture_around(struct parser *parser,
                                            transform *by)
{
    const struct frame *around = build_around(parser);
    const struct object *object;

    *by = transform_identity();
    if (around && around->kind == BUILD_TEXTURE)
        return around->node;
    object = around ? build_object_of(around) : NULL;
    if (object && object->texture.what) {
        *by = object->texture.by;
        return object->texture.what;
    }
    return &parser->builder->default_texture;
}

/* ---- pigment ----------------------------------------------------------- */

static void open_pigment(struct parser *parser, struct frame *frame)
{
    struct pigment *pigment = frame->node;
    transform by;

    *pigment = texture_around(parser, &by)->pigment;
    pigment->by = transform_then(&pigment->by, &by);
}

/* POV-Ray's colours of a checker that names none: blue, then green. */
static void open_checker(struct pigment *pigment)
{
    static const double color[2][5] = {{0, 0, 1, 0, 0}, {0, 1, 0, 0, 0}};

    pigment->kind = BRUME_PIGMENT_CHECKER;
    memcpy(pigment->color, color, sizeof color);
    pigment->by = transform_identity();
}

static const struct param pigment_params[] = {
    PARAM_WORD("checker", PARAM_MARK, BRUME_PIGMENT_CHECKER, 0, struct pigment,
               kind),
    PARAM_WITHOUT("quick_color", "Brume has no previews of that kind"),
    PARAM_WITHOUT("quick_colour", "Brume has no previews of that kind"),
    {0}};

static void set_pigment(struct parser *parser, struct frame *frame,
                        const struct param *row, struct location at)
{
    (void)parser;
    (void)at;
    if (!strcmp(row->word, "checker")) {
        open_checker(frame->node);
        frame->arguments = 0;
        frame->given |= PIGMENT_PATTERN;
    }
}

static const struct param pigment_colors[] = {
    PARAM_ANY("color", PARAM_COLOR, 0, 0, struct pigment, color[0]),
    PARAM_ANY("second color", PARAM_COLOR, 0, 0, struct pigment, color[1])};

static void pigment_argument(struct parser *parser, struct frame *frame,
                             const struct value *number, struct location at)
{
    struct pigment *pigment = frame->node;
    int room = frame->given & PIGMENT_PATTERN ? 2 : 1;

    if (frame->arguments >= room) {
        parser_error(parser, at, "a pigment of this kind takes %d color%s",
                     room, room == 1 ? "" : "s");
        return;
    }
    if (room == 1) {
        pigment->kind = BRUME_PIGMENT_SOLID;
        pigment->by = transform_identity();
    }
    param_set(parser, &pigment_colors[frame->arguments], pigment, at, number, 1,
              at);
}

static void apply_pigment(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (value->kind == VALUE_PIGMENT)
        *(struct pigment *)frame->node = *(const struct pigment *)value->node;
    else
        build_misplaced(parser, frame, value, at);
}

static void move_pigment(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct pigment *pigment = frame->node;

    (void)parser;
    pigment->by = transform_then(&pigment->by, by);
}

const struct statement build_statement_pigment = {
    .word = "pigment",
    .makes = VALUE_PIGMENT,
    .takes = BUILD_TAKES(VALUE_PIGMENT),
    .size = sizeof(struct pigment),
    .params = pigment_params,
    .open = open_pigment,
    .argument = pigment_argument,
    .apply = apply_pigment,
    .move = move_pigment,
    .set = set_pigment,
};

/* ---- finish ------------------------------------------------------------ */

#define FINISH(word, kind, start, low, open)                                   \
    PARAM_ROW(#word, kind, start, low, INFINITY, open, 0, struct finish, word)

const struct param build_finish_params[] = {
    FINISH(ambient, PARAM_RGB, 0.1, -INFINITY, 0),
    FINISH(emission, PARAM_RGB, 0, -INFINITY, 0),
    FINISH(diffuse, PARAM_FLOAT, 0.6, 0, 0),
    FINISH(brilliance, PARAM_FLOAT, 1, 0, 0),
    FINISH(phong, PARAM_FLOAT, 0, 0, 0),
    FINISH(phong_size, PARAM_FLOAT, 40, 0, 0),
    FINISH(specular, PARAM_FLOAT, 0, 0, 0),
    FINISH(roughness, PARAM_FLOAT, 0.05, 0, PARAM_ABOVE),
    {.word = "metallic",
     .kind = PARAM_FLOAT,
     .high = 1,
     .alone = 1,
     .offset = offsetof(struct finish, metallic)},
    {0}};

static void open_finish(struct parser *parser, struct frame *frame)
{
    transform by;

    *(struct finish *)frame->node = texture_around(parser, &by)->finish;
}

static void apply_finish(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    if (value->kind == VALUE_FINISH)
        *(struct finish *)frame->node = *(const struct finish *)value->node;
    else
        build_misplaced(parser, frame, value, at);
}

const struct statement build_statement_finish = {
    .word = "finish",
    .makes = VALUE_FINISH,
    .takes = BUILD_TAKES(VALUE_FINISH),
    .size = sizeof(struct finish),
    .params = build_finish_params,
    .open = open_finish,
    .apply = apply_finish,
};

/* ---- texture ----------------------------------------------------------- */

static bool set_part(struct texture *texture, const struct value *value)
{
    switch (value->kind) {
    case VALUE_TEXTURE:
        *texture = *(const struct texture *)value->node;
        return true;
    case VALUE_PIGMENT:
        texture->pigment = *(const struct pigment *)value->node;
        return true;
    case VALUE_FINISH:
        texture->finish = *(const struct finish *)value->node;
        return true;
    default:
        return false;
    }
}

static void open_texture(struct parser *parser, struct frame *frame)
{
    *(struct texture *)frame->node = parser->builder->default_texture;
}

static void apply_texture(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (!set_part(frame->node, value))
        build_misplaced(parser, frame, value, at);
}

static void move_texture(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct texture *texture = frame->node;

    (void)parser;
    texture->pigment.by = transform_then(&texture->pigment.by, by);
}

const struct statement build_statement_texture = {
    .word = "texture",
    .makes = VALUE_TEXTURE,
    .takes = BUILD_TAKES(VALUE_TEXTURE) | BUILD_TAKES(VALUE_PIGMENT) |
             BUILD_TAKES(VALUE_FINISH),
    .size = sizeof(struct texture),
    .open = open_texture,
    .apply = apply_texture,
    .move = move_texture,
};

static void open_default(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->default_texture;
}

const struct statement build_statement_default = {
    .word = "#default",
    .takes = BUILD_TAKES(VALUE_TEXTURE) | BUILD_TAKES(VALUE_PIGMENT) |
             BUILD_TAKES(VALUE_FINISH),
    .open = open_default,
    .apply = apply_texture,
};

/* ---- what an object wears ---------------------------------------------- */

bool build_wear_placed(struct parser *parser, struct placed_texture *worn,
                       const struct placed_texture *over, struct location at)
{
    if (worn->what && !model_is_opaque(over->what))
        return parser_error(parser, at,
                            "layered textures are not supported yet");
    if (worn->owned)
        build_give_up(parser, VALUE_TEXTURE, worn->what);
    *worn = *over;
    return true;
}

/* Makes what is worn a texture of its own, with its maps in the pigment. */
static bool own_texture(struct parser *parser, struct placed_texture *worn)
{
    struct texture *texture = worn->what;

    if (!worn->owned) {
        texture = build_node(parser, VALUE_TEXTURE, sizeof *texture);
        if (!texture)
            return false;
        *texture = worn->what ? *worn->what : parser->builder->default_texture;
    }
    if (worn->what)
        texture->pigment.by = transform_then(&texture->pigment.by, &worn->by);
    *worn = (struct placed_texture){texture, transform_identity(), true};
    return true;
}

bool build_wear(struct parser *parser, struct placed_texture *worn,
                const struct value *value, struct location at)
{
    if (value->kind == VALUE_TEXTURE) {
        struct placed_texture over = {value->node, transform_identity(),
                                      value->node == parser->builder->fresh};
        return build_wear_placed(parser, worn, &over, at);
    }
    return own_texture(parser, worn) && set_part(worn->what, value);
}

/* ---- material ---------------------------------------------------------- */

static void open_material(struct parser *parser, struct frame *frame)
{
    struct material *material = frame->node;

    (void)parser;
    material->texture.by = material->interior.by = transform_identity();
}

static void apply_material(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    struct material *material = frame->node;

    switch (value->kind) {
    case VALUE_MATERIAL:
        *material = *(const struct material *)value->node;
        break;
    case VALUE_TEXTURE:
        build_wear(parser, &material->texture, value, at);
        break;
    case VALUE_INTERIOR:
        material->interior.what = value->node;
        material->interior.by = transform_identity();
        break;
    default:
        build_misplaced(parser, frame, value, at);
        break;
    }
}

static void move_material(struct parser *parser, struct frame *frame,
                          const transform *by)
{
    struct material *material = frame->node;

    (void)parser;
    material->texture.by = transform_then(&material->texture.by, by);
    material->interior.by = transform_then(&material->interior.by, by);
}

const struct statement build_statement_material = {
    .word = "material",
    .makes = VALUE_MATERIAL,
    .takes = BUILD_TAKES(VALUE_MATERIAL) | BUILD_TAKES(VALUE_TEXTURE) |
             BUILD_TAKES(VALUE_INTERIOR),
    .size = sizeof(struct material),
    .open = open_material,
    .apply = apply_material,
    .move = move_material,
};

struct value build_layer(struct parser *parser, const struct value *below,
                         const struct value *above, struct location at)
{
    (void)above;
    parser_mistake(parser, at, "layered textures are not supported yet");
    return *below;
}
