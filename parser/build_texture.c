/* build_texture.c - pigment, normal, texture, material and #default. */
#include <string.h>

#include "parser/builder.h"

/* ---- where a statement starts from ------------------------------------- */

static bool is_texture(const struct frame *frame)
{
    return build_statement_of(frame)->makes == VALUE_TEXTURE ||
           frame->kind == BUILD_TEXTURE_ENTRY;
}

/* What the statement around has by now, so that `pigment { scale 2 }` changes
 * what is there; the default texture where nothing is. */
const struct texture *build_texture_around(struct parser *parser, transform *by)
{
    const struct frame *around = build_around(parser);
    const struct object *object;

    *by = transform_identity();
    if (around && is_texture(around) && around->node)
        return around->node;
    object = around ? build_object_of(around) : NULL;
    if (object && object->texture.what) {
        *by = object->texture.by;
        return object->texture.what;
    }
    return &parser->builder->default_texture;
}

static void move_patterned(struct parser *parser, struct frame *frame,
                           const transform *by)
{
    struct patterned *on = frame->node;

    (void)parser;
    on->by = transform_then(&on->by, by);
}

/* ---- pigment ----------------------------------------------------------- */

static void open_pigment(struct parser *parser, struct frame *frame)
{
    struct pigment *pigment = frame->node;
    transform by;

    *pigment = build_texture_around(parser, &by)->pigment;
    pigment->on.by = transform_then(&pigment->on.by, &by);
}

static void open_default_pigment(struct parser *parser, struct frame *frame)
{
    *(struct pigment *)frame->node = parser->builder->default_texture.pigment;
}

static const struct param pigment_params[] = {
    PARAM_WITHOUT("quick_color", "Brume has no previews of that kind"),
    PARAM_WITHOUT("quick_colour", "Brume has no previews of that kind"),
    {0}};

static const struct param pigment_color = PARAM_ANY("color", PARAM_COLOR, 0, 0,
                                                    struct pigment, color);

/* `pigment { Orange*0.8 filter 0.6 }`: a colour of filter and transmit alone
 * belongs to the one before it. */
static bool lets_through(struct pigment *pigment, const struct frame *frame,
                         const struct value *color)
{
    const double *v = color->v;

    if (!(frame->given & FRAME_PLAIN) || color->kind != VALUE_NUMBER ||
        color->terms != VALUE_TERMS || v[0] != 0 || v[1] != 0 || v[2] != 0 ||
        (v[3] == 0 && v[4] == 0))
        return false;
    for (int i = 3; i < VALUE_TERMS; i++)
        if (v[i] != 0)
            pigment->color[i] = v[i];
    return true;
}

static void pigment_argument(struct parser *parser, struct frame *frame,
                             const struct value *number, struct location at)
{
    struct pigment *pigment = frame->node;

    if (build_entry_position(frame, number))
        return;
    if (build_pattern_lists(frame)) {
        build_pattern_choice(parser, frame, number, at);
    } else if (lets_through(pigment, frame, number)) {
        return;
    } else if (frame->given & (FRAME_CHOSEN | FRAME_PLAIN)) {
        parser_mistake(parser, at, "a pigment of this kind takes %s",
                       frame->given & FRAME_PLAIN ? "1 color" : "no color");
    } else {
        pigment->on = (struct patterned){.by = transform_identity()};
        frame->given &= ~(unsigned)FRAME_PATTERN;
        frame->given |= FRAME_PLAIN;
        param_set(parser, &pigment_color, pigment, at, number, 1, at);
    }
}

void build_begin_with(struct parser *parser, struct frame *frame,
                      const struct value *value, size_t size,
                      struct location at)
{
    if (build_pattern_lists(frame)) {
        build_pattern_choice(parser, frame, value, at);
    } else if (frame->given & (FRAME_PATTERN | FRAME_CHOSEN | FRAME_LIST |
                               FRAME_PLAIN | FRAME_BEGUN)) {
        parser_mistake(parser, at, "the %s that a %s begins with comes first",
                       value_name(value), value_name(value));
    } else {
        memcpy(frame->node, value->node, size);
        frame->given |= FRAME_BEGUN;
    }
}

static void apply_pigment(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (value->kind == VALUE_PIGMENT)
        build_begin_with(parser, frame, value, sizeof(struct pigment), at);
    else if (!build_pattern_apply(parser, frame, value, at))
        build_misplaced(parser, frame, value, at);
}

static void close_pigment(struct parser *parser, struct frame *frame,
                          struct location at)
{
    build_pattern_close(parser, frame, at);
    surface_mean_pigment(frame->node);
}

static void close_pigment_entry(struct parser *parser, struct frame *frame,
                                struct location at)
{
    close_pigment(parser, frame, at);
    build_entry_close(parser, frame, at);
}

static void close_pigment_pattern(struct parser *parser, struct frame *frame,
                                  struct location at)
{
    struct pattern *pattern = build_pattern_begin(parser, build_around(parser),
                                                  PATTERN_PIGMENT);

    close_pigment(parser, frame, at);
    if (pattern)
        pattern->pigment = frame->node;
}

static const enum build_kind in_pigment_map[] = {BUILD_PIGMENT_MAP,
                                                 BUILD_KINDS};

#define PIGMENT_STATEMENT                                                      \
    .takes = BUILD_TAKES_PATTERN | BUILD_TAKES(VALUE_PIGMENT) |                \
             BUILD_TAKES(VALUE_COLOR_MAP) | BUILD_TAKES(VALUE_PIGMENT_MAP),    \
    .size = sizeof(struct pigment), .params = pigment_params,                  \
    .groups = build_pattern_groups, .argument = pigment_argument,              \
    .apply = apply_pigment, .move = move_patterned

const struct statement build_statement_pigment = {
    PIGMENT_STATEMENT,    .word = "pigment",      .makes = VALUE_PIGMENT,
    .open = open_pigment, .close = close_pigment,
};

const struct statement build_statement_pigment_entry = {
    PIGMENT_STATEMENT,
    .word = "[",
    .within = in_pigment_map,
    .open = open_default_pigment,
    .close = close_pigment_entry,
};

const struct statement build_statement_pigment_pattern = {
    PIGMENT_STATEMENT,
    .word = "pigment_pattern",
    .within = build_patterned,
    .open = open_default_pigment,
    .close = close_pigment_pattern,
};

/* ---- normal ------------------------------------------------------------ */

static void open_normal(struct parser *parser, struct frame *frame)
{
    struct normal *normal = frame->node;
    transform by;

    *normal = build_texture_around(parser, &by)->normal;
    normal->on.by = transform_then(&normal->on.by, &by);
}

static void open_default_normal(struct parser *parser, struct frame *frame)
{
    *(struct normal *)frame->node = parser->builder->default_texture.normal;
}

static const struct param normal_params[] = {
    PARAM_ANY("bump_size", PARAM_FLOAT, 0, 0, struct normal, amount),
    PARAM_ROW("accuracy", PARAM_FLOAT, 0.02, 0, INFINITY, PARAM_ABOVE, 0,
              struct normal, accuracy),
    PARAM_WORD("no_bump_scale", PARAM_SWITCH, 1, 0, struct normal,
               no_bump_scale),
    {0}};

static void normal_argument(struct parser *parser, struct frame *frame,
                            const struct value *number, struct location at)
{
    if (!build_entry_position(frame, number))
        param_set(parser, &normal_params[0], frame->node, at, number, 1, at);
}

static void apply_normal(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    if (value->kind == VALUE_NORMAL)
        build_begin_with(parser, frame, value, sizeof(struct normal), at);
    else if (!build_pattern_apply(parser, frame, value, at))
        build_misplaced(parser, frame, value, at);
}

static void close_normal_entry(struct parser *parser, struct frame *frame,
                               struct location at)
{
    build_pattern_close(parser, frame, at);
    build_entry_close(parser, frame, at);
}

static const enum build_kind in_normal_map[] = {BUILD_NORMAL_MAP, BUILD_KINDS};

#define NORMAL_STATEMENT                                                       \
    .takes = BUILD_TAKES_PATTERN | BUILD_TAKES(VALUE_NORMAL) |                 \
             BUILD_TAKES(VALUE_NORMAL_MAP) | BUILD_TAKES(VALUE_SLOPE_MAP),     \
    .size = sizeof(struct normal), .params = normal_params,                    \
    .groups = build_pattern_groups, .argument = normal_argument,               \
    .apply = apply_normal, .move = move_patterned

const struct statement build_statement_normal = {
    NORMAL_STATEMENT,
    .word = "normal",
    .makes = VALUE_NORMAL,
    .open = open_normal,
    .close = build_pattern_close,
};

const struct statement build_statement_normal_entry = {
    NORMAL_STATEMENT,
    .word = "[",
    .within = in_normal_map,
    .open = open_default_normal,
    .close = close_normal_entry,
};

/* ---- texture ----------------------------------------------------------- */

static bool set_part(struct texture *texture, const struct value *value)
{
    switch (value->kind) {
    case VALUE_PIGMENT:
        texture->pigment = *(const struct pigment *)value->node;
        return true;
    case VALUE_NORMAL:
        texture->normal = *(const struct normal *)value->node;
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

static void texture_argument(struct parser *parser, struct frame *frame,
                             const struct value *number, struct location at)
{
    if (!build_entry_position(frame, number))
        build_misplaced(parser, frame, number, at);
}

static void apply_texture(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    const struct texture *texture = frame->node;

    if (value->kind == VALUE_TEXTURE) {
        build_begin_with(parser, frame, value, sizeof *texture, at);
    } else if (set_part(frame->node, value)) {
        frame->given |= FRAME_BEGUN;
        if (texture->on.map)
            parser_mistake(parser, at,
                           "a texture with a pattern has no %s of "
                           "its own",
                           value_name(value));
    } else if (!build_pattern_apply(parser, frame, value, at)) {
        build_misplaced(parser, frame, value, at);
    }
}

static void move_texture(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    (void)parser;
    surface_texture_transform(frame->node, by);
}

static void close_texture(struct parser *parser, struct frame *frame,
                          struct location at)
{
    struct texture *texture = frame->node;

    build_pattern_close(parser, frame, at);
    if (frame->given & FRAME_CHOSEN && !texture->on.map)
        parser_mistake(parser, at,
                       "a texture with a pattern needs textures "
                       "to choose from");
    /* Of a texture without a pattern of its own it is that of its parts. */
    if (texture->on.uv_mapping)
        texture->pigment.on.uv_mapping = texture->normal.on.uv_mapping = 1;
    surface_mean_texture(texture);
}

static void close_texture_entry(struct parser *parser, struct frame *frame,
                                struct location at)
{
    close_texture(parser, frame, at);
    build_entry_close(parser, frame, at);
}

static const enum build_kind in_texture_map[] = {BUILD_TEXTURE_MAP,
                                                 BUILD_KINDS};

#define TEXTURE_PARTS                                                          \
    (BUILD_TAKES(VALUE_TEXTURE) | BUILD_TAKES(VALUE_PIGMENT) |                 \
     BUILD_TAKES(VALUE_NORMAL) | BUILD_TAKES(VALUE_FINISH))
#define TEXTURE_STATEMENT                                                      \
    .takes = TEXTURE_PARTS | BUILD_TAKES_PATTERN |                             \
             BUILD_TAKES(VALUE_TEXTURE_MAP),                                   \
    .size = sizeof(struct texture), .groups = build_pattern_groups,            \
    .open = open_texture, .argument = texture_argument,                        \
    .apply = apply_texture, .move = move_texture

const struct statement build_statement_texture = {
    TEXTURE_STATEMENT,
    .word = "texture",
    .makes = VALUE_TEXTURE,
    .close = close_texture,
};

const struct statement build_statement_interior_texture = {
    TEXTURE_STATEMENT,
    .word = "interior_texture",
    .makes = VALUE_INTERIOR_TEXTURE,
    .close = close_texture,
};

const struct statement build_statement_texture_entry = {
    TEXTURE_STATEMENT,
    .word = "[",
    .within = in_texture_map,
    .close = close_texture_entry,
};

static void open_default(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->default_texture;
}

static void apply_default(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (value->kind == VALUE_TEXTURE)
        *(struct texture *)frame->node = *(const struct texture *)value->node;
    else if (!set_part(frame->node, value))
        build_misplaced(parser, frame, value, at);
}

const struct statement build_statement_default = {
    .word = "#default",
    .takes = TEXTURE_PARTS,
    .open = open_default,
    .apply = apply_default,
};

/* ---- tiles: an older word for a checker of textures --------------------- */

static const struct param tiles_params[] = {PARAM_OWN("tile2", 0, 0, 1), {0}};

static void open_tiles(struct parser *parser, struct frame *frame)
{
    (void)frame;
    build_pattern_begin(parser, build_around(parser), PATTERN_TILES);
}

static void tiles_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    const struct map *map = build_patterned_of(build_around(parser))->map;

    (void)frame;
    (void)value;
    (void)count;
    if (!map || map->count != 1)
        parser_mistake(parser, at, "'%s' stands before the second texture",
                       row->word);
}

static void apply_tiles(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    (void)frame;
    build_pattern_choice(parser, build_around(parser), value, at);
}

static const enum build_kind in_texture[] = {
    BUILD_TEXTURE, BUILD_INTERIOR_TEXTURE, BUILD_TEXTURE_ENTRY, BUILD_KINDS};

const struct statement build_statement_tiles = {
    .word = "tiles",
    .within = in_texture,
    .takes = BUILD_TAKES(VALUE_TEXTURE),
    .params = tiles_params,
    .open = open_tiles,
    .values = tiles_values,
    .apply = apply_tiles,
};

/* ---- layers ------------------------------------------------------------ */

/* A texture over another: its lowest layer gets what is below. */
static struct texture *lay(struct parser *parser,
                           const struct placed_texture *above,
                           const struct placed_texture *below)
{
    struct texture *top = build_node(parser, VALUE_TEXTURE, sizeof *top);
    struct texture *layer = top;

    if (!top)
        return NULL;
    *top = *above->what;
    surface_texture_transform(top, &above->by);
    while (layer->below) {
        struct texture *copy = parser_alloc(parser, sizeof *copy);
        if (!copy)
            return NULL;
        *copy = *layer->below;
        surface_texture_transform(copy, &layer->below_by);
        layer->below = copy;
        layer->below_by = transform_identity();
        layer = copy;
    }
    layer->below = below->what;
    layer->below_by = below->by;
    return top;
}

struct value build_layer(struct parser *parser, const struct value *below,
                         const struct value *above, struct location at)
{
    struct placed_texture upper = {above->node, transform_identity(), false};
    struct placed_texture lower = {below->node, transform_identity(), false};

    (void)at;
    if (parser->failed || below->kind != VALUE_TEXTURE ||
        above->kind != VALUE_TEXTURE)
        return *below;
    struct texture *top = lay(parser, &upper, &lower);
    return top ? value_node(VALUE_TEXTURE, top) : *below;
}

/* ---- what an object wears ---------------------------------------------- */

bool build_wear_placed(struct parser *parser, struct placed_texture *worn,
                       const struct placed_texture *over)
{
    struct texture *top;

    if (!worn->what || model_is_opaque(over->what)) {
        if (worn->owned)
            build_give_up(parser, VALUE_TEXTURE, worn->what);
        *worn = *over;
        return true;
    }
    top = lay(parser, over, worn);
    if (!top)
        return false;
    *worn = (struct placed_texture){top, transform_identity(), true};
    return true;
}

/* Makes what is worn a texture of its own, with its maps in its parts. */
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
        surface_texture_transform(texture, &worn->by);
    *worn = (struct placed_texture){texture, transform_identity(), true};
    return true;
}

bool build_wear(struct parser *parser, struct placed_texture *worn,
                const struct value *value)
{
    if (value->kind == VALUE_TEXTURE) {
        struct placed_texture over = {value->node, transform_identity(),
                                      value->node == parser->builder->fresh};
        return build_wear_placed(parser, worn, &over);
    }
    return own_texture(parser, worn) && set_part(worn->what, value);
}

/* ---- material ---------------------------------------------------------- */

static void open_material(struct parser *parser, struct frame *frame)
{
    struct material *material = frame->node;

    (void)parser;
    material->texture.by = material->inner.by = material->interior.by =
        transform_identity();
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
        build_wear(parser, &material->texture, value);
        break;
    case VALUE_INTERIOR_TEXTURE:
        material->inner = (struct placed_texture){value->node,
                                                  transform_identity(), false};
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
    material->inner.by = transform_then(&material->inner.by, by);
    material->interior.by = transform_then(&material->interior.by, by);
}

const struct statement build_statement_material = {
    .word = "material",
    .makes = VALUE_MATERIAL,
    .takes = BUILD_TAKES(VALUE_MATERIAL) | BUILD_TAKES(VALUE_TEXTURE) |
             BUILD_TAKES(VALUE_INTERIOR_TEXTURE) | BUILD_TAKES(VALUE_INTERIOR),
    .size = sizeof(struct material),
    .open = open_material,
    .apply = apply_material,
    .move = move_material,
};
