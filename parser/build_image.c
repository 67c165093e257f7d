/* build_image.c - image_map, image_pattern, bump_map and material_map. */
#include <string.h>

#include "parser/builder.h"
#include "parser/formula.h"

enum {
    IMAGE_FILE,
    IMAGE_FILTER,
    IMAGE_TRANSMIT,
    IMAGE_ALL,
    IMAGE_GAMMA,
    IMAGE_SRGB,
    IMAGE_PREMULTIPLIED
};

#define IMAGE_ROW(word, kind, start, low, high, member)                        \
    PARAM_ROW(word, kind, start, low, high, 0, 0, struct image, member)
#define IMAGE_WORD(word, kind, alone, member)                                  \
    PARAM_WORD(word, kind, alone, 0, struct image, member)

#define IMAGE_ROWS                                                             \
    PARAM_OWN("bmp", 1, 1, IMAGE_FILE), PARAM_OWN("exr", 1, 1, IMAGE_FILE),    \
        PARAM_OWN("gif", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("hdr", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("iff", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("jpeg", 1, 1, IMAGE_FILE),                                   \
        PARAM_OWN("pgm", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("png", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("ppm", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("sys", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("tga", 1, 1, IMAGE_FILE),                                    \
        PARAM_OWN("tiff", 1, 1, IMAGE_FILE),                                   \
        PARAM_OWN("gamma", 0, 1, IMAGE_GAMMA),                                 \
        PARAM_OWN("srgb", 0, 0, IMAGE_SRGB),                                   \
        PARAM_OWN("premultiplied", 0, 1, IMAGE_PREMULTIPLIED),                 \
        IMAGE_ROW("map_type", PARAM_INTEGER, 0, 0, 5, map_type),               \
        IMAGE_ROW("interpolate", PARAM_INTEGER, 0, 0, 4, interpolate),         \
        IMAGE_WORD("once", PARAM_SWITCH, 1, once)

static const struct param image_map_rows[] = {
    IMAGE_ROWS,
    PARAM_OWN("filter", 0, 2, IMAGE_FILTER),
    PARAM_OWN("transmit", 0, 2, IMAGE_TRANSMIT),
    PARAM_OWN("all", 1, 1, IMAGE_ALL),
    {0}};
static const struct param image_pattern_rows[] = {
    IMAGE_ROWS,
    IMAGE_WORD("use_alpha", PARAM_MARK, IMAGE_USE_ALPHA, use),
    IMAGE_WORD("use_color", PARAM_MARK, IMAGE_USE_COLOR, use),
    IMAGE_WORD("use_colour", PARAM_MARK, IMAGE_USE_COLOR, use),
    PARAM_WITHOUT("use_index", "of a palette the colors count, as in POV-Ray"),
    {0}};
static const struct param bump_map_rows[] = {
    IMAGE_ROWS,
    IMAGE_WORD("use_color", PARAM_MARK, IMAGE_USE_COLOR, use),
    IMAGE_WORD("use_colour", PARAM_MARK, IMAGE_USE_COLOR, use),
    IMAGE_WORD("use_index", PARAM_MARK, IMAGE_USE_INDEX, use),
    IMAGE_ROW("bump_size", PARAM_FLOAT, 0, -INFINITY, INFINITY, bump_size),
    {0}};
static const struct param material_map_rows[] = {IMAGE_ROWS, {0}};

static void open_image(struct parser *parser, struct frame *frame,
                       enum pattern_kind kind)
{
    struct image *image = frame->node;
    struct pattern *pattern = build_pattern_begin(parser, build_around(parser),
                                                  kind);

    image->bump_size = NAN;
    if (pattern)
        pattern->image = image;
}

static void open_image_map(struct parser *parser, struct frame *frame)
{
    open_image(parser, frame, PATTERN_IMAGE_MAP);
}

static void open_image_pattern(struct parser *parser, struct frame *frame)
{
    open_image(parser, frame, PATTERN_IMAGE);
}

static void open_bump_map(struct parser *parser, struct frame *frame)
{
    open_image(parser, frame, PATTERN_BUMP_MAP);
}

static void open_material_map(struct parser *parser, struct frame *frame)
{
    open_image(parser, frame, PATTERN_MATERIAL_MAP);
}

/* ---- the file ---------------------------------------------------------- */

/* Where all errors are told, the rest of the scene can do without. */
bool build_has_file(struct parser *parser, struct string name,
                    struct location at)
{
    if (!parser->in->all_errors || parser_file_exists(parser, at, name))
        return parser_find_file(parser, at, name, PARSER_DATA) != NULL;
    parser_warn(parser, at, "file '%s' not found", name.text);
    return false;
}

static void name_file(struct parser *parser, struct image *image,
                      const char *format, const struct value *name,
                      struct location at)
{
    if (name->kind != VALUE_STRING) {
        parser_mistake(parser, at, "'%s' needs the name of a file", format);
        return;
    }
    image->format = format;
    image->name = name->string;
    image->at = at;
}

static void image_argument(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    struct image *image = frame->node;

    if (value->kind != VALUE_STRING || image->name.text)
        build_misplaced(parser, frame, value, at);
    else
        name_file(parser, image, NULL, value, at);
}

/* ---- its words --------------------------------------------------------- */

/* A colour of the file's palette, or all of them (index -1), becomes
 * transparent. */
static void add_palette(struct parser *parser, struct image *image,
                        bool transmit, int index, double amount)
{
    struct image_palette *entry = parser_alloc(parser, sizeof *entry);

    if (!entry)
        return;
    *entry = (struct image_palette){transmit, index, amount, image->palette};
    image->palette = entry;
}

/* `filter 3, 0.5`, or `filter all 0.5`. */
static void set_palette(struct parser *parser, struct frame *frame,
                        const struct param *row, const struct value *value,
                        int count, struct location at)
{
    frame->open = count == 0 ? row : NULL;
    if (count == 1)
        parser_mistake(parser, at,
                       "'%s' needs the number of a color and how "
                       "much",
                       row->word);
    else if (count == 2)
        add_palette(parser, frame->node, row->id == IMAGE_TRANSMIT,
                    (int)value[0].v[0], value[1].v[0]);
}

static void set_all(struct parser *parser, struct frame *frame, double amount,
                    struct location at)
{
    if (frame->open)
        add_palette(parser, frame->node, frame->open->id == IMAGE_TRANSMIT, -1,
                    amount);
    else
        parser_mistake(parser, at,
                       "'all' belongs behind 'filter' or "
                       "'transmit'");
    frame->open = NULL;
}

static void image_values(struct parser *parser, struct frame *frame,
                         const struct param *row, const struct value *value,
                         int count, struct location at)
{
    struct image *image = frame->node;

    for (int i = 0; i < count && row->id != IMAGE_FILE; i++)
        if (value[i].kind != VALUE_NUMBER || value[i].terms != 1) {
            parser_mistake(parser, at, "'%s' needs a float", row->word);
            return;
        }
    switch (row->id) {
    case IMAGE_FILE:
        name_file(parser, image, row->word, value, parser->builder->value_at);
        break;
    case IMAGE_FILTER:
    case IMAGE_TRANSMIT:
        set_palette(parser, frame, row, value, count, at);
        break;
    case IMAGE_ALL:
        set_all(parser, frame, value->v[0], at);
        break;
    case IMAGE_GAMMA:
        image->gamma = count > 0 ? value->v[0] : 1;
        break;
    case IMAGE_SRGB:
        image->gamma = -1;
        break;
    default:
        image->has_premultiplied = true;
        image->premultiplied = count == 0 || value_is_true(value->v[0]);
        break;
    }
}

static void apply_image(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct image *image = frame->node;

    if (value->kind == VALUE_FUNCTION)
        image->function = value->node;
    else
        build_pattern_choice(parser, build_around(parser), value, at);
}

static void close_image(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct image *image = frame->node;

    if (image->map_type > 2 && image->map_type != 5)
        parser_mistake(parser, at, "'map_type' must be 0, 1, 2 or 5");
    if (image->function && image->function->columns == 0)
        parser_mistake(parser, at,
                       "a function as an image needs its width "
                       "and height");
    if (image->function &&
        (image->function->parameters != 3 ||
         (image->function->results != 1 && image->function->results != 5)))
        parser_mistake(parser, at,
                       "a picture's function takes x, y and z and gives a "
                       "float or a color");
    if (image->name.text)
        build_has_file(parser, image->name, image->at);
    else if (!image->function)
        parser_mistake(parser, at, "'%s' needs a file",
                       build_statement_of(frame)->word);
}

static const enum build_kind in_pigment[] = {
    BUILD_PIGMENT, BUILD_PIGMENT_ENTRY, BUILD_PIGMENT_PATTERN, BUILD_KINDS};
static const enum build_kind in_normal[] = {BUILD_NORMAL, BUILD_NORMAL_ENTRY,
                                            BUILD_KINDS};
static const enum build_kind in_texture[] = {
    BUILD_TEXTURE, BUILD_INTERIOR_TEXTURE, BUILD_TEXTURE_ENTRY, BUILD_KINDS};

#define IMAGE_STATEMENT(name, within_, takes_)                                 \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .within = within_,                                                     \
        .takes = takes_,                                                       \
        .size = sizeof(struct image),                                          \
        .params = name##_rows,                                                 \
        .open = open_##name,                                                   \
        .argument = image_argument,                                            \
        .values = image_values,                                                \
        .apply = apply_image,                                                  \
        .close = close_image,                                                  \
    }

IMAGE_STATEMENT(image_map, in_pigment, BUILD_TAKES_PATTERN);
IMAGE_STATEMENT(image_pattern, build_patterned, BUILD_TAKES_PATTERN);
IMAGE_STATEMENT(bump_map, in_normal, BUILD_TAKES_PATTERN);
IMAGE_STATEMENT(material_map, in_texture,
                BUILD_TAKES_PATTERN | BUILD_TAKES(VALUE_TEXTURE));
