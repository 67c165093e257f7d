/* build_curve.c - shapes by lists of points: lathe, prism, sor, sphere_sweep,
 * polygon and bicubic_patch. */
#include <string.h>

#include "parser/builder.h"

/* How the numbers of a shape come: `floats` of them, the last of which says
 * how many points follow, unless `points` does; then the points. */
struct listing {
    int floats, points;
    int terms;  /* of a point                              */
    bool radii; /* each point is followed by a radius      */
};

static const struct listing *listing_of(enum build_kind kind)
{
    static const struct listing lathe = {1, 0, 2, false},
                                prism = {3, 0, 2, false},
                                sweep = {1, 0, 3, true},
                                polygon = {1, 0, 3, false},
                                patch = {0, 16, 3, false};

    switch (kind) {
    case BUILD_PRISM:
        return &prism;
    case BUILD_SPHERE_SWEEP:
        return &sweep;
    case BUILD_POLYGON:
        return &polygon;
    case BUILD_BICUBIC_PATCH:
        return &patch;
    default:
        return &lathe;
    }
}

/* Heights of a prism, or how many points there are. */
static void take_float(struct parser *parser, struct frame *frame,
                       const struct listing *listing, const struct value *value,
                       struct location at)
{
    struct object *object = frame->node;
    double x = value->kind == VALUE_NUMBER ? value->v[0] : -1;

    if (value->kind != VALUE_NUMBER || value->terms != 1)
        parser_error(parser, at, "'%s' begins with %d float%s", object->word,
                     listing->floats, listing->floats > 1 ? "s" : "");
    else if (frame->arguments == listing->floats - 1 &&
             !(x >= 1 && x <= 4294967295.0))
        parser_error(parser, at, "the count of points must be at least 1");
    else if (frame->arguments == listing->floats - 1)
        object->points = (uint32_t)x;
    else if (frame->arguments == 0)
        object->shape.radius = x;
    else
        object->shape.radius_b = x;
}

static void curve_argument(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    const struct listing *listing = listing_of(frame->kind);
    struct object *object = frame->node;
    int item = frame->arguments - listing->floats;
    bool radius = listing->radii && item % 2 == 1;

    if (item < 0) {
        take_float(parser, frame, listing, value, at);
        return;
    }
    if (value->kind != VALUE_NUMBER || (radius && value->terms != 1)) {
        parser_mistake(parser, at, "'%s' needs a %s here", object->word,
                       radius ? "radius" : "vector");
        return;
    }
    struct value v = value_promote(*value, listing->terms);
    for (int i = 0; i < (radius ? 1 : listing->terms); i++)
        if (!build_number(parser, v.v[i], at))
            return;
    object->listed += !radius;
}

static void open_curve(struct parser *parser, struct frame *frame)
{
    struct object *object;

    build_shape_open(parser, frame);
    object = frame->node;
    object->points = (uint32_t)listing_of(frame->kind)->points;
    if (frame->kind == BUILD_SPHERE_SWEEP)
        object->shape.accuracy = 1e-6;
    if (frame->kind == BUILD_BICUBIC_PATCH)
        object->shape.accuracy = 0;
}

static void close_curve(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct listing *listing = listing_of(frame->kind);
    struct object *object = frame->node;
    size_t numbers = parser->builder->numbers - frame->mark;
    size_t each = (size_t)listing->terms + listing->radii;

    if (object->listed != object->points)
        parser_mistake(parser, at, "this %s announces %u points but has %u",
                       object->word, object->points, object->listed);
    else if (numbers != each * object->points)
        parser_mistake(parser, at, "the last point of this %s has no radius",
                       object->word);
    build_take_numbers(parser, frame, object);
}

#define SPLINE(word, kind)                                                     \
    PARAM_WORD(word, PARAM_MARK, BRUME_CURVE_##kind, 0, struct object,         \
               shape.curve)
#define OPEN PARAM_WORD("open", PARAM_SWITCH, 1, 0, struct object, shape.open)

static const struct param lathe_params[] = {
    BUILD_OBJECT_ROWS,
    SPLINE("linear_spline", LINEAR),
    SPLINE("quadratic_spline", QUADRATIC),
    SPLINE("cubic_spline", CUBIC),
    SPLINE("bezier_spline", BEZIER),
    {0}};
enum { SWEEP_LINEAR, SWEEP_CONIC };

static const struct param prism_params[] = {
    BUILD_OBJECT_ROWS,
    SPLINE("linear_spline", LINEAR),
    SPLINE("quadratic_spline", QUADRATIC),
    SPLINE("cubic_spline", CUBIC),
    SPLINE("bezier_spline", BEZIER),
    OPEN,
    PARAM_OWN("linear_sweep", 0, 0, SWEEP_LINEAR),
    PARAM_OWN("conic_sweep", 0, 0, SWEEP_CONIC),
    {0}};
static const struct param sor_params[] = {BUILD_OBJECT_ROWS, OPEN, {0}};
static const struct param sweep_params[] = {
    BUILD_OBJECT_ROWS,
    SPLINE("linear_spline", LINEAR),
    SPLINE("cubic_spline", CUBIC),
    SPLINE("b_spline", B_SPLINE),
    PARAM_ROW("tolerance", PARAM_FLOAT, 1e-6, 0, INFINITY, PARAM_ABOVE, 0,
              struct object, shape.accuracy),
    {0}};
static const struct param patch_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_WITHOUT("type", "it trades memory for time in POV-Ray alone"),
    PARAM_ROW("flatness", PARAM_FLOAT, 0, 0, INFINITY, 0, 0, struct object,
              shape.accuracy),
    PARAM_ROW("u_steps", PARAM_INTEGER, 0, 0, 16, 0, 0, struct object,
              shape.steps[0]),
    PARAM_ROW("v_steps", PARAM_INTEGER, 0, 0, 16, 0, 0, struct object,
              shape.steps[1]),
    PARAM_OWN("uv_vectors", 4, 4, 0),
    PARAM_WITHOUT("uv_mapping", "patterns are not laid over patches yet"),
    {0}};

/* The kind of sweep, behind which the heights follow. */
static void prism_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    (void)parser;
    (void)value;
    (void)count;
    (void)at;
    ((struct object *)frame->node)->shape.conic = row->id == SWEEP_CONIC;
}

/* Corners of the pattern that is laid over a patch. */
static void patch_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    (void)frame;
    for (int i = 0; i < count; i++)
        if (value[i].kind != VALUE_NUMBER)
            parser_mistake(parser, at, "'%s' needs four vectors", row->word);
}

static const struct param count_rows[] = {{.word = "count of points"}, {0}};
static const struct param prism_rows[] = {{.word = "first height"},
                                          {.word = "second height"},
                                          {.word = "count of points"},
                                          {0}};
static const struct param point_rows[] = {{.word = "points"}, {0}};

#define CURVE_STATEMENT(name, table, count, rows, ...)                         \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = VALUE_OBJECT,                                                 \
        .takes = BUILD_TAKES_WORN,                                             \
        .size = sizeof(struct object),                                         \
        .params = table,                                                       \
        .arguments = rows,                                                     \
        .needed = count,                                                       \
        .open = open_curve,                                                    \
        .argument = curve_argument,                                            \
        .apply = build_object_apply,                                           \
        .move = build_object_move,                                             \
        .close = close_curve,                                                  \
        .set = build_object_set,                                               \
        __VA_ARGS__}

CURVE_STATEMENT(lathe, lathe_params, 1, count_rows, .values = NULL);
CURVE_STATEMENT(prism, prism_params, 3, prism_rows, .values = prism_values);
CURVE_STATEMENT(sor, sor_params, 1, count_rows, .values = NULL);
CURVE_STATEMENT(sphere_sweep, sweep_params, 1, count_rows, .values = NULL);
CURVE_STATEMENT(polygon, build_object_params, 1, count_rows, .values = NULL);
CURVE_STATEMENT(bicubic_patch, patch_params, 1, point_rows,
                .values = patch_values);
