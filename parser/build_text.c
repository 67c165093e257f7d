/* build_text.c - text: the outlines of a line of a font. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lib/font.h"
#include "parser/builder.h"

enum { TEXT_FONT, TEXT_LINE, TEXT_THICKNESS, TEXT_OFFSET, TEXT_VALUES };
enum { TEXT_TTF, TEXT_INTERNAL };
enum { PATH_ROOM = 512 };

/* Fonts that come with POV-Ray, by the numbers of `internal`; others are told
 * to be missing. */
static const char *const fonts[] = {"povlogo.ttf", "timrom.ttf", "cyrvetic.ttf",
                                    "crystal.ttf"};
enum { FONTS = sizeof fonts / sizeof *fonts };

static bool comes_along(const char *name)
{
    for (int i = 0; i < FONTS; i++)
        if (strcmp(name, fonts[i]) == 0)
            return true;
    return false;
}

/* `internal N`: a number out of range is 0, as in POV-Ray. */
static struct string font_named(const struct value *font)
{
    double x = font->kind == VALUE_NUMBER ? font->v[0] : 0;
    const char *name = fonts[x >= 0 && x < FONTS ? (int)x : 0];

    return font->kind == VALUE_STRING ? font->string
                                      : (struct string){name, strlen(name)};
}

/* The font's file, or that of one that stands for it, in `room`. */
static const char *find_font(struct parser *parser, struct string name,
                             struct location at, char room[PATH_ROOM])
{
    if (access(name.text, R_OK) == 0 || parser_file_exists(parser, at, name) ||
        !font_substitute(name.text, room, PATH_ROOM))
        return parser_find_file(parser, at, name, PARSER_DATA);
    if (!comes_along(name.text))
        parser_warn(parser, at, "font '%s' not found; '%s' stands for it",
                    name.text, room);
    return room;
}

static void add_line(struct parser *parser, const struct value *value,
                     struct location at)
{
    char room[PATH_ROOM];
    const char *path = find_font(parser, font_named(&value[TEXT_FONT]), at,
                                 room);
    struct value offset = value_promote(value[TEXT_OFFSET], 2);
    struct brume_error err = {0};
    double *number;
    size_t count;

    if (!path)
        return;
    if (!font_outline(path, value[TEXT_LINE].string.text, offset.v, &number,
                      &count, &err)) {
        parser_relay(parser, at, &err);
        return;
    }
    for (size_t i = 0; i < count && build_number(parser, number[i], at); i++)
        ;
    free(number);
}

static void text_values(struct parser *parser, struct frame *frame,
                        const struct param *row, const struct value *value,
                        int count, struct location at)
{
    struct brume_shape *shape = &((struct object *)frame->node)->shape;

    enum value_kind font = row->id == TEXT_INTERNAL ? VALUE_NUMBER
                                                    : VALUE_STRING;
    if (count != TEXT_VALUES || value[TEXT_FONT].kind != font ||
        value[TEXT_LINE].kind != VALUE_STRING ||
        value[TEXT_THICKNESS].kind != VALUE_NUMBER ||
        value[TEXT_OFFSET].kind != VALUE_NUMBER) {
        parser_mistake(parser, at,
                       "'%s' needs a font, a text, a thickness and an offset",
                       row->word);
        return;
    }
    shape->radius = value[TEXT_THICKNESS].v[0];
    shape->smooth = true;
    add_line(parser, value, at);
}

static void close_text(struct parser *parser, struct frame *frame,
                       struct location at)
{
    struct object *object = frame->node;

    if (!object->shape.smooth)
        parser_mistake(parser, at, "a text needs its 'ttf'");
    build_take_numbers(parser, frame, object);
}

static const struct param text_params[] = {
    BUILD_OBJECT_ROWS,
    PARAM_OWN("ttf", TEXT_VALUES, TEXT_VALUES, TEXT_TTF),
    PARAM_OWN("internal", TEXT_VALUES, TEXT_VALUES, TEXT_INTERNAL),
    {0}};

const struct statement build_statement_text = {
    .word = "text",
    .makes = VALUE_OBJECT,
    .takes = BUILD_TAKES_WORN,
    .size = sizeof(struct object),
    .params = text_params,
    .open = build_shape_open,
    .values = text_values,
    .apply = build_object_apply,
    .move = build_object_move,
    .close = close_text,
    .set = build_object_set,
};
