/* build_warp.c - statements inside of statements with patterns: warp, slope,
 * pigment_pattern, object; and pattern itself, of functions. */
#include <string.h>

#include "parser/builder.h"

/* ---- warp -------------------------------------------------------------- */

#define WARP_ANY(word, kind, member)                                           \
    PARAM_ANY(word, kind, 0, 0, struct warp, member)
#define WARP_KIND(word, kind_)                                                 \
    PARAM_WORD(word, PARAM_MARK, kind_, 0, struct warp, kind)

enum { WARP_INVERSE = 1, WARP_REPEATS = 2, WARP_TURBULENT = 4 };

/* `repeat` and `turbulence` name a warp, or belong to a black hole. */
enum { WORD_REPEAT = 1, WORD_TURBULENCE, WORD_PLANAR, WORD_HOLE };

static const struct param warp_rows[] = {
    PARAM_OWN("repeat", 1, 1, WORD_REPEAT),
    PARAM_OWN("turbulence", 1, 1, WORD_TURBULENCE),
    PARAM_OWN("black_hole", 2, 2, WORD_HOLE),
    PARAM_OWN("planar", 0, 2, WORD_PLANAR),
    WARP_KIND("cylindrical", WARP_CYLINDRICAL),
    WARP_KIND("spherical", WARP_SPHERICAL),
    WARP_KIND("toroidal", WARP_TOROIDAL),
    WARP_KIND("cubic", WARP_CUBIC),
    WARP_ANY("offset", PARAM_VECTOR, offset),
    WARP_ANY("flip", PARAM_VECTOR, flip),
    WARP_ANY("strength", PARAM_FLOAT, strength),
    WARP_ANY("falloff", PARAM_FLOAT, falloff),
    PARAM_WORD("inverse", PARAM_SWITCH, 1, 0, struct warp, inverse),
    PARAM_ROW("octaves", PARAM_INTEGER, 6, 1, 10, 0, 0, struct warp,
              turbulence.octaves),
    WARP_ANY("omega", PARAM_FLOAT, turbulence.omega),
    WARP_ANY("lambda", PARAM_FLOAT, turbulence.lambda),
    WARP_ANY("orientation", PARAM_VECTOR, orientation),
    WARP_ANY("dist_exp", PARAM_FLOAT, dist_exp),
    WARP_ANY("major_radius", PARAM_FLOAT, major_radius),
    {0}};

static const struct param warp_vector = WARP_ANY("warp", PARAM_VECTOR, vector);
static const struct param warp_radius = WARP_ANY("radius", PARAM_FLOAT, radius);
static const struct param warp_distance = WARP_ANY("planar", PARAM_FLOAT,
                                                   dist_exp);
static const struct param warp_normal = WARP_ANY("planar", PARAM_VECTOR,
                                                 orientation);
static const struct param hole_repeat = WARP_ANY("repeat", PARAM_VECTOR,
                                                 repeat);
static const struct param hole_jitter = WARP_ANY("turbulence", PARAM_VECTOR,
                                                 jitter);
static const struct param warp_amount = WARP_ANY("turbulence", PARAM_VECTOR,
                                                 turbulence.amount);

static void open_warp(struct parser *parser, struct frame *frame)
{
    struct warp *warp = frame->node;

    (void)parser;
    warp->strength = 1;
    warp->falloff = 2;
    warp->turbulence = (struct turbulence){
        .octaves = 6, .omega = 0.5, .lambda = 2};
    warp->orientation[2] = 1;
    warp->major_radius = 1;
}

/* One axis at a time is repeated. */
static void check_repeat(struct parser *parser, const struct warp *warp)
{
    int axes = 0;

    for (int i = 0; i < 3; i++)
        axes += warp->vector[i] != 0;
    if (axes != 1)
        parser_mistake(parser, parser->builder->value_at,
                       "'repeat' needs one axis");
}

static void warp_values(struct parser *parser, struct frame *frame,
                        const struct param *row, const struct value *value,
                        int count, struct location at)
{
    struct warp *warp = frame->node;
    struct location where = parser->builder->value_at;
    bool hole = warp->kind == WARP_BLACK_HOLE;

    switch (row->id) {
    case WORD_REPEAT:
        warp->repeats |= hole;
        param_set(parser, hole ? &hole_repeat : &warp_vector, warp, at, value,
                  1, where);
        if (!hole)
            warp->kind = WARP_REPEAT;
        if (!hole)
            check_repeat(parser, warp);
        break;
    case WORD_TURBULENCE:
        param_set(parser, hole ? &hole_jitter : &warp_amount, warp, at, value,
                  1, where);
        if (!hole)
            warp->kind = WARP_TURBULENCE;
        break;
    case WORD_HOLE:
        warp->kind = WARP_BLACK_HOLE;
        param_set(parser, &warp_vector, warp, at, value, 1, where);
        param_set(parser, &warp_radius, warp, at, value + 1, 1, where);
        break;
    default:
        warp->kind = WARP_PLANAR;
        if (count > 0)
            param_set(parser, &warp_normal, warp, at, value, 1, where);
        if (count > 1)
            param_set(parser, &warp_distance, warp, at, value + 1, 1, where);
        break;
    }
}

/* Maps that were applied before it are its own from now on. */
static void close_warp(struct parser *parser, struct frame *frame,
                       struct location at)
{
    struct warp *warp = frame->node;
    struct frame *around = build_around(parser);
    struct patterned *on = build_patterned_of(around);
    struct pattern *pattern = build_pattern_of(parser, around);

    if (warp->kind == WARP_NONE)
        parser_mistake(parser, at, "'warp' needs its kind");
    if (!pattern)
        return;
    warp->before = on->by;
    warp->older = pattern->warps;
    pattern->warps = warp;
    on->by = transform_identity();
}

const struct statement build_statement_warp = {
    .word = "warp",
    .within = build_patterned,
    .size = sizeof(struct warp),
    .params = warp_rows,
    .open = open_warp,
    .values = warp_values,
    .close = close_warp,
};

/* ---- slope ------------------------------------------------------------- */

enum { SLOPE_DIRECTION, SLOPE_POINT, SLOPE_ALTITUDE };

static const struct param slope_rows[] = {
    PARAM_OWN("point_at", 1, 3, SLOPE_POINT),
    PARAM_OWN("altitude", 1, 3, SLOPE_ALTITUDE),
    {0}};

static const struct param slope_arguments[] = {
    PARAM_ANY("direction", PARAM_VECTOR, 0, 0, struct pattern, vector),
    PARAM_ANY("lowest slope", PARAM_FLOAT, 0, 0, struct pattern, slope[0]),
    PARAM_ANY("highest slope", PARAM_FLOAT, 0, 0, struct pattern, slope[1]),
    {0}};
static const struct param altitude_arguments[] = {
    PARAM_ANY("altitude", PARAM_VECTOR, 0, 0, struct pattern, altitude),
    PARAM_ANY("lowest altitude", PARAM_FLOAT, 0, 0, struct pattern, heights[0]),
    PARAM_ANY("highest altitude", PARAM_FLOAT, 0, 0, struct pattern,
              heights[1]),
    {0}};

/* Its node is the pattern of the statement around. */
static void open_slope(struct parser *parser, struct frame *frame)
{
    frame->node = build_pattern_begin(parser, build_around(parser),
                                      PATTERN_SLOPE);
}

static void slope_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    struct pattern *pattern = frame->node;
    const struct param *argument = row->id == SLOPE_ALTITUDE
                                       ? altitude_arguments
                                       : slope_arguments;

    for (int i = 0; i < count; i++)
        param_set(parser, &argument[i], pattern, at, &value[i], 1,
                  parser->builder->value_at);
    if (row->id == SLOPE_ALTITUDE)
        pattern->has_altitude = true;
    else
        pattern->slope_to_point = true;
}

static void close_slope(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct pattern *pattern = frame->node;

    if (pattern->slope[0] == pattern->slope[1] ||
        pattern->heights[0] == pattern->heights[1])
        parser_mistake(parser, at, "the bounds of 'slope' are the same");
}

const struct statement build_statement_slope = {
    .word = "slope",
    .within = build_patterned,
    .params = slope_rows,
    .arguments = slope_arguments,
    .open = open_slope,
    .values = slope_values,
    .close = close_slope,
};

/* ---- object: inside and outside ---------------------------------------- */

static void apply_object(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    struct frame *around = build_around(parser);

    if (value->kind != VALUE_OBJECT) {
        if (build_patterned_of(around)->pattern->object)
            build_pattern_choice(parser, around, value, at);
        else
            parser_mistake(parser, at, "'object' needs its object first");
        return;
    }
    build_pattern_of(parser, around)->object = value->node;
    (void)frame;
}

static void open_object(struct parser *parser, struct frame *frame)
{
    (void)frame;
    build_pattern_begin(parser, build_around(parser), PATTERN_OBJECT);
}

static void object_argument(struct parser *parser, struct frame *frame,
                            const struct value *number, struct location at)
{
    apply_object(parser, frame, number, at);
}

static void close_object(struct parser *parser, struct frame *frame,
                         struct location at)
{
    if (!build_patterned_of(build_around(parser))->pattern->object)
        parser_error(parser, at, "'object' needs an object before this");
    (void)frame;
}

const struct statement build_statement_object_pattern = {
    .word = "object",
    .within = build_patterned,
    .takes = BUILD_TAKES(VALUE_OBJECT) | BUILD_TAKES(VALUE_PIGMENT) |
             BUILD_TAKES(VALUE_NORMAL) | BUILD_TAKES(VALUE_TEXTURE) |
             BUILD_TAKES(VALUE_DENSITY),
    .open = open_object,
    .argument = object_argument,
    .apply = apply_object,
    .close = close_object,
};

/* ---- pattern, of functions --------------------------------------------- */

static void open_pattern(struct parser *parser, struct frame *frame)
{
    struct patterned *on = frame->node;

    (void)parser;
    on->by = transform_identity();
}

static void apply_pattern(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (!build_pattern_apply(parser, frame, value, at))
        build_misplaced(parser, frame, value, at);
}

static void move_pattern(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct patterned *on = frame->node;

    (void)parser;
    on->by = transform_then(&on->by, by);
}

static void close_pattern(struct parser *parser, struct frame *frame,
                          struct location at)
{
    if (!(frame->given & FRAME_CHOSEN))
        parser_mistake(parser, at, "'pattern' needs a pattern");
    build_pattern_close(parser, frame, at);
}

const struct statement build_statement_pattern = {
    .word = "pattern",
    .makes = VALUE_PATTERN,
    .takes = BUILD_TAKES_PATTERN,
    .size = sizeof(struct patterned),
    .groups = build_pattern_groups,
    .open = open_pattern,
    .apply = apply_pattern,
    .move = move_pattern,
    .close = close_pattern,
};
