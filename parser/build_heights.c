/* build_heights.c - height_field: heights of a function or of a picture. */
#include <math.h>
#include <string.h>

#include "lib/raster.h"
#include "lib/srgb.h"
#include "parser/builder.h"
#include "parser/formula.h"

enum { HEIGHTS_FILE, HEIGHTS_GAMMA, HEIGHTS_SRGB };

/* The picture that is named, before it is read. */
struct heights {
    const char *format; /* NULL: as the name ends                  */
    struct string name;
    struct location at;
    double gamma; /* that its codes are decoded by           */
    bool srgb;    /* ... or by sRGB's curve                  */
};

/* ---- of a function ----------------------------------------------------- */

static bool has_heights(const struct frame *frame)
{
    const struct object *object = frame->node;
    const struct heights *heights = frame->more;

    return object->shape.steps[0] > 0 || heights->name.text;
}

/* A function's value, or its colour's gray, within 0 to 1. */
static double height_of(const struct function *function, const double *out)
{
    double x = function->results == 5
                   ? 0.297 * out[0] + 0.589 * out[1] + 0.114 * out[2]
                   : out[0];

    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static bool gives_heights(struct parser *parser, const struct value *value,
                          struct location at)
{
    const struct function *function = value->node;

    return (function->parameters == 3 && function->results == 5) ||
           build_is_function_of_space(parser, value, at);
}

static void function_heights(struct parser *parser, struct frame *frame,
                             const struct value *value, struct location at)
{
    const struct function *function = value->node;
    struct brume_shape *shape = &((struct object *)frame->node)->shape;
    double out[BRUME_MAX_RESULTS];

    if (function->columns == 0) {
        parser_mistake(parser, at,
                       "a height field needs `function columns, rows { ... }`");
        return;
    }
    shape->steps[0] = function->columns;
    shape->steps[1] = function->rows;
    parser->builder->numbers = frame->mark;
    for (int row = 0; row < function->rows; row++)
        for (int column = 0; column < function->columns; column++) {
            if (!load_cell(parser, function, column, row, out, at))
                return;
            double height = height_of(function, out);
            if (!build_number(parser, height, at))
                return;
        }
}

static void apply_height_field(struct parser *parser, struct frame *frame,
                               const struct value *value, struct location at)
{
    if (value->kind != VALUE_FUNCTION)
        build_object_apply(parser, frame, value, at);
    else if (has_heights(frame))
        parser_mistake(parser, at,
                       "a height field has one picture or one function");
    else if (gives_heights(parser, value, at))
        function_heights(parser, frame, value, at);
}

/* ---- of a picture ------------------------------------------------------ */

static void name_picture(struct parser *parser, struct frame *frame,
                         const char *format, const struct value *name,
                         struct location at)
{
    struct heights *heights = frame->more;

    if (name->kind != VALUE_STRING)
        parser_mistake(parser, at, "a height field needs the name of a file");
    else if (has_heights(frame))
        parser_mistake(parser, at,
                       "a height field has one picture or one function");
    else
        *heights = (struct heights){format, name->string, at, 1, false};
}

static void height_field_argument(struct parser *parser, struct frame *frame,
                                  const struct value *value, struct location at)
{
    name_picture(parser, frame, NULL, value, at);
}

static void height_field_values(struct parser *parser, struct frame *frame,
                                const struct param *row,
                                const struct value *value, int count,
                                struct location at)
{
    struct heights *heights = frame->more;

    if (row->id == HEIGHTS_FILE)
        name_picture(parser, frame, row->word, value,
                     parser->builder->value_at);
    else if (!heights->name.text)
        parser_mistake(parser, at, "'%s' belongs behind the picture's name",
                       row->word);
    else if (row->id == HEIGHTS_SRGB)
        heights->srgb = true;
    else if (count == 1 && value->kind == VALUE_NUMBER && value->v[0] > 0)
        heights->gamma = value->v[0];
    else if (count == 1)
        parser_mistake(parser, at, "'gamma' needs a float above 0");
}

/* A code from 0 to 1; POV-Ray's own default is to take it as it is. */
static double decode(const struct heights *heights, double code)
{
    return heights->srgb ? srgb_decode(code) : pow(code, heights->gamma);
}

/* The number in a palette, the grey, the red and green of 8 bits as one number
 * of 16, or the grey of red, green and blue of 16 bits, as POV-Ray has it. */
static double picture_height(const struct heights *heights,
                             const struct raster *raster, size_t pixel)
{
    const uint16_t *sample = raster->sample + pixel * (size_t)raster->channels;
    double v[3];

    if (raster->colors > 0)
        return sample[0] / 256.0;
    for (int i = 0; i < 3; i++)
        v[i] = decode(heights, sample[raster->channels < 3 ? 0 : i] /
                                   (double)raster->max);
    if (raster->channels < 3)
        return v[0];
    if (raster->max <= 255)
        return (256 * 255 * v[0] + 255 * v[1]) / 65535;
    return 0.297 * v[0] + 0.589 * v[1] + 0.114 * v[2];
}

/* Where errors do not end the parse, a flat field stands for a picture that
 * cannot be read. */
static void picture_heights(struct parser *parser, struct frame *frame)
{
    const struct heights *heights = frame->more;
    struct brume_shape *shape = &((struct object *)frame->node)->shape;
    struct raster *raster = load_raster(parser, heights->format, heights->name,
                                        heights->at);
    size_t pixels = 4;

    shape->steps[0] = shape->steps[1] = 2;
    if (raster) {
        shape->steps[0] = raster->width;
        shape->steps[1] = raster->height;
        pixels = (size_t)raster->width * (size_t)raster->height;
    }
    for (size_t i = 0; i < pixels; i++) {
        double height = raster ? picture_height(heights, raster, i) : 0;
        if (!build_number(parser, height, heights->at))
            break;
    }
    raster_free(raster);
}

/* ---- the statement ----------------------------------------------------- */

static void open_height_field(struct parser *parser, struct frame *frame)
{
    build_shape_open(parser, frame);
    ((struct object *)frame->node)->shape.radius = 0;
    frame->more = parser_alloc(parser, sizeof(struct heights));
}

static void close_height_field(struct parser *parser, struct frame *frame,
                               struct location at)
{
    const struct heights *heights = frame->more;

    if (!has_heights(frame))
        parser_mistake(parser, at,
                       "a height field needs a picture or a function");
    if (heights->name.text)
        picture_heights(parser, frame);
    build_take_numbers(parser, frame, frame->node);
}

#define HEIGHTS_PICTURE(word) PARAM_OWN(word, 1, 1, HEIGHTS_FILE)

static const struct param height_field_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_WORD("smooth", PARAM_SWITCH, 1, 0, struct object, shape.smooth),
    PARAM_ROW("water_level", PARAM_FLOAT, 0, -INFINITY, INFINITY, 0, 0,
              struct object, shape.radius),
    HEIGHTS_PICTURE("bmp"),
    HEIGHTS_PICTURE("exr"),
    HEIGHTS_PICTURE("gif"),
    HEIGHTS_PICTURE("hdr"),
    HEIGHTS_PICTURE("iff"),
    HEIGHTS_PICTURE("jpeg"),
    HEIGHTS_PICTURE("pgm"),
    HEIGHTS_PICTURE("png"),
    HEIGHTS_PICTURE("pot"),
    HEIGHTS_PICTURE("ppm"),
    HEIGHTS_PICTURE("sys"),
    HEIGHTS_PICTURE("tga"),
    HEIGHTS_PICTURE("tiff"),
    PARAM_OWN("gamma", 0, 1, HEIGHTS_GAMMA),
    PARAM_OWN("srgb", 0, 0, HEIGHTS_SRGB),
    PARAM_WITHOUT("premultiplied", "heights have no opacity"),
    {0}};

const struct statement build_statement_height_field = {
    .word = "height_field",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN | BUILD_TAKES(VALUE_FUNCTION),
    .size = sizeof(struct object),
    .params = height_field_params,
    .open = open_height_field,
    .argument = height_field_argument,
    .values = height_field_values,
    .apply = apply_height_field,
    .move = build_object_move,
    .close = close_height_field,
    .set = build_object_set,
};
