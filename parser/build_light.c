/* build_light.c - light_source. */
#include <string.h>

#include "parser/builder.h"

enum { LIGHT_AIMED_ONLY = 1 };

#define LIGHT(word, start, low, high, bit)                                     \
    PARAM_ROW(#word, PARAM_FLOAT, start, low, high, 0, bit, struct object,     \
              light.word)

static const char area_note[] = "Brume samples the whole area of a light";

const struct param build_light_params[] = {
    PARAM_WORD("spotlight", PARAM_MARK, BRUME_LIGHT_SPOT, 0, struct object,
               light.kind),
    {.word = "point_at",
     .kind = PARAM_VECTOR,
     .start = {0, 0, 1},
     .low = -INFINITY,
     .high = INFINITY,
     .alone = NAN,
     .given = LIGHT_AIMED_ONLY,
     .offset = offsetof(struct object, light.point_at)},
    PARAM_WORD("cylinder", PARAM_MARK, BRUME_LIGHT_CYLINDER, 0, struct object,
               light.kind),
    PARAM_WORD("parallel", PARAM_SWITCH, 1, 0, struct object, light.parallel),
    LIGHT(radius, 30, -INFINITY, INFINITY, LIGHT_AIMED_ONLY),
    LIGHT(falloff, 45, -INFINITY, INFINITY, LIGHT_AIMED_ONLY),
    PARAM_OWN("area_light", 4, 4, 0),
    PARAM_WITHOUT("adaptive", area_note),
    PARAM_WITHOUT("jitter", area_note),
    PARAM_WORD("circular", PARAM_SWITCH, 1, 0, struct object,
               light.area_circular),
    PARAM_WORD("orient", PARAM_SWITCH, 1, 0, struct object, light.area_orient),
    PARAM_WORD("area_illumination", PARAM_SWITCH, 1, 0, struct object,
               light.area_illumination),
    LIGHT(tightness, 0, 0, INFINITY, LIGHT_AIMED_ONLY),
    LIGHT(fade_distance, 0, 0, INFINITY, 0),
    LIGHT(fade_power, 0, 0, INFINITY, 0),
    PARAM_WORD("shadowless", PARAM_CLEAR, 0, 0, struct object, light.shadows),
    PARAM_ANY("media_interaction", PARAM_SWITCH, 1, 0, struct object,
              light.media_interaction),
    PARAM_ANY("media_attenuation", PARAM_SWITCH, 0, 0, struct object,
              light.media_attenuation),
    {0}};

static const struct param light_arguments[] = {
    PARAM_ANY("location", PARAM_VECTOR, 0, 0, struct object, light.location),
    PARAM_ANY("color", PARAM_RGB, 1, 0, struct object, light.color),
    {0}};

static void open_light(struct parser *parser, struct frame *frame)
{
    static const struct brume_light start = BRUME_LIGHT_INIT;
    struct object *light = build_object_start(
        frame, OBJECT_LIGHT, BRUME_SHAPE_SPHERE, "light_source");

    (void)parser;
    light->light = start;
    param_defaults(build_light_params, light);
}

/* A declared light needs no numbers of its own. */
static void apply_light(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct object *light = frame->node;

    if (value->kind != VALUE_LIGHT) {
        build_misplaced(parser, frame, value, at);
        return;
    }
    *light = *(const struct object *)value->node;
    light->at = frame->at;
    frame->arguments = 2;
}

/* `area_light axis, axis, lamps, lamps` */
static void light_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    struct brume_light *light = &((struct object *)frame->node)->light;

    light->area = true;
    for (int i = 0; i < count; i++) {
        double x = value[i].v[0];
        if (value[i].kind != VALUE_NUMBER) {
            parser_mistake(parser, at, "'%s' needs numbers", row->word);
        } else if (i < 2) {
            memcpy(light->area_axis[i], value_promote(value[i], 3).v,
                   sizeof light->area_axis[i]);
        } else if (!(x >= 1 && x <= 1e6)) {
            parser_mistake(parser, at, "an area_light has 1 to 1e6 lamps");
        } else {
            light->area_size[i - 2] = (int)x;
        }
    }
}

static void close_light(struct parser *parser, struct frame *frame,
                        struct location at)
{
    struct brume_light *light = &((struct object *)frame->node)->light;

    (void)at;
    light->radius = fabs(light->radius);
    light->falloff = fabs(light->falloff);
    /* A cone wider than a half space is one. */
    if (light->kind == BRUME_LIGHT_SPOT) {
        light->radius = fmin(light->radius, 90);
        light->falloff = fmin(light->falloff, 90);
    }
    if (light->kind == BRUME_LIGHT_POINT && !light->parallel &&
        frame->given & LIGHT_AIMED_ONLY)
        parser_warn(parser, frame->at,
                    "point_at, radius, falloff and tightness have no effect "
                    "without 'spotlight', 'cylinder' or 'parallel'");
}

const struct statement build_statement_light = {
    .word = "light_source",
    .makes = VALUE_LIGHT,
    .takes = BUILD_TAKES(VALUE_LIGHT),
    .size = sizeof(struct object),
    .params = build_light_params,
    .arguments = light_arguments,
    .needed = 2,
    .open = open_light,
    .values = light_values,
    .apply = apply_light,
    .move = build_object_move,
    .close = close_light,
};

/* ---- looks_like, projected_through ------------------------------------- */

static const enum build_kind in_light[] = {BUILD_LIGHT, BUILD_KINDS};

static void open_inner(struct parser *parser, struct frame *frame)
{
    frame->node = build_around(parser)->node;
}

/* An object of the light's own, about the origin of its place. */
static void apply_looks_like(struct parser *parser, struct frame *frame,
                             const struct value *value, struct location at)
{
    struct object *light = frame->node;

    (void)at;
    if (frame->kind == BUILD_LOOKS_LIKE)
        build_add_child(parser, &light->members, value->node);
    else
        light->lacks = "projected_through";
}

const struct statement build_statement_looks_like = {
    .word = "looks_like",
    .within = in_light,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .open = open_inner,
    .apply = apply_looks_like,
};

const struct statement build_statement_projected_through = {
    .word = "projected_through",
    .within = in_light,
    .takes = BUILD_TAKES(VALUE_OBJECT),
    .open = open_inner,
    .apply = apply_looks_like,
};
