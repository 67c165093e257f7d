/* build_map.c - color_map and the other maps, and their entries. */
#include "parser/builder.h"

/* ---- entries ----------------------------------------------------------- */

const enum build_kind build_entries[] = {
    BUILD_COLOR_ENTRY, BUILD_PIGMENT_ENTRY, BUILD_NORMAL_ENTRY,
    BUILD_SLOPE_ENTRY, BUILD_TEXTURE_ENTRY, BUILD_DENSITY_ENTRY,
    BUILD_KINDS};

static bool is_entry(const struct frame *frame)
{
    for (int i = 0; build_entries[i] != BUILD_KINDS; i++)
        if (build_entries[i] == frame->kind)
            return true;
    return false;
}

bool build_entry_position(struct frame *frame, const struct value *number)
{
    if (frame->arguments > 0 || !is_entry(frame) ||
        number->kind != VALUE_NUMBER || number->terms != 1)
        return false;
    frame->position = number->v[0];
    frame->given |= FRAME_POSITION;
    return true;
}

bool build_map_add(struct parser *parser, struct map *map, double at,
                   const double *color, int terms, const void *node)
{
    struct map_entry *entry = parser_alloc(parser, sizeof *entry);

    if (!entry)
        return false;
    entry->at = at;
    for (int i = 0; i < terms; i++)
        entry->color[i] = color[i];
    entry->node = node;
    if (map->last)
        map->last->next = entry;
    else
        map->first = entry;
    map->last = entry;
    map->count++;
    return true;
}

/* `average` counts its entries alike where they do not say how much. */
static bool is_averaged(struct parser *parser)
{
    struct builder *builder = parser->builder;
    const struct frame *user = builder->frame + builder->frames - 3;

    if (builder->frames < 3 || user->kind == BUILD_KINDS ||
        !(build_statement_of(user)->takes & BUILD_TAKES_PATTERN))
        return false;
    const struct pattern *pattern = build_patterned_of(user)->pattern;
    return pattern && pattern->kind == PATTERN_AVERAGE;
}

void build_entry_close(struct parser *parser, struct frame *frame,
                       struct location at)
{
    struct map *map = build_around(parser)->node;

    if (!(frame->given & FRAME_POSITION)) {
        frame->position = 1;
        if (!is_averaged(parser))
            parser_mistake(parser, at, "an entry of a map begins with a float");
    }
    build_map_add(parser, map, frame->position, NULL, 0, frame->node);
}

/* `[at color]`, or `[from, to color color]`. */
struct color_entry {
    double to;
    double color[2][5];
    int numbers, colors;
};

static void color_argument(struct parser *parser, struct frame *frame,
                           const struct value *number, struct location at)
{
    struct color_entry *entry = frame->node;
    struct value color = value_promote(*number, 5);

    if (build_entry_position(frame, number))
        return;
    if (number->kind != VALUE_NUMBER || entry->colors == 2) {
        build_misplaced(parser, frame, number, at);
    } else if (number->terms == 1 && frame->arguments == 1) {
        entry->to = number->v[0];
        entry->numbers = 1;
    } else {
        for (int i = 0; i < 5; i++)
            entry->color[entry->colors][i] = color.v[i];
        entry->colors++;
    }
}

static void close_color(struct parser *parser, struct frame *frame,
                        struct location at)
{
    const struct color_entry *entry = frame->node;
    struct map *map = build_around(parser)->node;

    if (!(frame->given & FRAME_POSITION) ||
        entry->colors != entry->numbers + 1) {
        parser_mistake(parser, at,
                       "an entry of a color_map has a float and a "
                       "color, or two of each");
        return;
    }
    build_map_add(parser, map, frame->position, entry->color[0], 5, NULL);
    if (entry->numbers)
        build_map_add(parser, map, entry->to, entry->color[1], 5, NULL);
}

static const enum build_kind in_color_map[] = {BUILD_COLOR_MAP,
                                               BUILD_COLOUR_MAP, BUILD_KINDS};

const struct statement build_statement_color_entry = {
    .word = "[",
    .within = in_color_map,
    .size = sizeof(struct color_entry),
    .argument = color_argument,
    .close = close_color,
};

static void slope_argument(struct parser *parser, struct frame *frame,
                           const struct value *number, struct location at)
{
    double *slope = frame->node;
    struct value both = value_promote(*number, 2);

    if (build_entry_position(frame, number))
        return;
    if (number->kind != VALUE_NUMBER || number->terms < 2 ||
        frame->arguments > 1)
        parser_mistake(parser, at,
                       "an entry of a slope_map has a float and "
                       "<height, slope>");
    slope[0] = both.v[0];
    slope[1] = both.v[1];
}

static void close_slope(struct parser *parser, struct frame *frame,
                        struct location at)
{
    struct map *map = build_around(parser)->node;

    if (frame->arguments < 2 || !(frame->given & FRAME_POSITION))
        parser_mistake(parser, at,
                       "an entry of a slope_map has a float and "
                       "<height, slope>");
    build_map_add(parser, map, frame->position, frame->node, 2, NULL);
}

static const enum build_kind in_slope_map[] = {BUILD_SLOPE_MAP, BUILD_KINDS};

const struct statement build_statement_slope_entry = {
    .word = "[",
    .within = in_slope_map,
    .size = 2 * sizeof(double),
    .argument = slope_argument,
    .close = close_slope,
};

/* ---- maps -------------------------------------------------------------- */

static void open_map(struct parser *parser, struct frame *frame)
{
    struct map *map = frame->node;

    (void)parser;
    map->kind = (int)build_statement_of(frame)->makes;
}

static void apply_map(struct parser *parser, struct frame *frame,
                      const struct value *value, struct location at)
{
    struct map *map = frame->node;

    if (map->count > 0)
        parser_mistake(parser, at, "a name stands before all entries");
    *map = *(const struct map *)value->node;
}

/* POV-Ray sorts nothing either, but its maps go up. */
static void close_map(struct parser *parser, struct frame *frame,
                      struct location at)
{
    const struct map *map = frame->node;

    if (map->count == 0)
        parser_error(parser, at, "a %s needs an entry",
                     build_statement_of(frame)->word);
}

#define MAP_STATEMENT(name, makes_, entry_)                                    \
    const struct statement build_statement_##name = {                          \
        .word = #name,                                                         \
        .makes = makes_,                                                       \
        .takes = BUILD_TAKES(makes_),                                          \
        .size = sizeof(struct map),                                            \
        .entry = entry_,                                                       \
        .open = open_map,                                                      \
        .apply = apply_map,                                                    \
        .close = close_map,                                                    \
    }

MAP_STATEMENT(color_map, VALUE_COLOR_MAP, BUILD_COLOR_ENTRY);
MAP_STATEMENT(colour_map, VALUE_COLOR_MAP, BUILD_COLOR_ENTRY);
MAP_STATEMENT(pigment_map, VALUE_PIGMENT_MAP, BUILD_PIGMENT_ENTRY);
MAP_STATEMENT(normal_map, VALUE_NORMAL_MAP, BUILD_NORMAL_ENTRY);
MAP_STATEMENT(slope_map, VALUE_SLOPE_MAP, BUILD_SLOPE_ENTRY);
MAP_STATEMENT(texture_map, VALUE_TEXTURE_MAP, BUILD_TEXTURE_ENTRY);
MAP_STATEMENT(density_map, VALUE_DENSITY_MAP, BUILD_DENSITY_ENTRY);
