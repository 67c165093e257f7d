#include "parser/surface.h"

#include <math.h>
#include <string.h>

#include "parser/model.h"

#define IDENTITY                                                               \
    {                                                                          \
        {                                                                      \
            {1, 0, 0, 0}, {0, 1, 0, 0},                                        \
            {                                                                  \
                0, 0, 1, 0                                                     \
            }                                                                  \
        }                                                                      \
    }

const struct texture model_default_texture = {
    .pigment = {.on = {.by = IDENTITY}},
    .normal = {.on = {.by = IDENTITY}, .amount = 0.5, .accuracy = 0.02},
    .finish = {.ambient = {0.1, 0.1, 0.1},
               .diffuse = {0.6, 0},
               .brilliance = 1,
               .phong_size = 40,
               .roughness = 0.05,
               .reflection = {.exponent = 1, .falloff = 1}},
    .on = {.by = IDENTITY},
    .below_by = IDENTITY};

/* ---- patterns ---------------------------------------------------------- */

static bool is_triangular(enum pattern_kind kind)
{
    return kind == PATTERN_MARBLE || kind == PATTERN_WOOD ||
           kind == PATTERN_SPIRAL1 || kind == PATTERN_SPIRAL2;
}

void surface_pattern_start(struct pattern *pattern, enum pattern_kind kind)
{
    static const struct pattern start = {
        .exponent = 1,
        .frequency = 1,
        .turbulence = {.octaves = 6, .omega = 0.5, .lambda = 2},
        .agate_turb = 1,
        .fractal_exponent = 2,
        .exterior = {1, 1},
        .interior = {0, 1},
        .brick_size = {8, 3, 4.5},
        .mortar = 0.5,
        .form = {-1, 1, 0},
        .metric = 2,
        .control = {1, 1},
        .sides = 3,
        .tiles = 1,
        .variant = 1,
        .slope = {0, 1},
        .heights = {0, 1},
        .grid = -1,
        .grid_by = IDENTITY};

    *pattern = start;
    pattern->kind = kind;
    if (is_triangular(kind))
        pattern->wave = WAVE_TRIANGLE;
    if (kind == PATTERN_PAVEMENT) {
        memset(pattern->form, 0, sizeof pattern->form);
        pattern->exterior[0] = 0;
    }
}

int surface_choices(enum pattern_kind kind)
{
    switch (kind) {
    case PATTERN_BRICK:
    case PATTERN_CHECKER:
    case PATTERN_OBJECT:
    case PATTERN_TILES:
        return 2;
    case PATTERN_HEXAGON:
        return 3;
    case PATTERN_SQUARE:
        return 4;
    case PATTERN_CUBIC:
    case PATTERN_TRIANGULAR:
        return 6;
    case PATTERN_MATERIAL_MAP:
        return 256;
    default:
        return 0;
    }
}

/* ---- means ------------------------------------------------------------- */

static const double *entry_color(const struct map *map,
                                 const struct map_entry *entry)
{
    switch (map->kind) {
    case VALUE_PIGMENT_MAP:
        return ((const struct pigment *)entry->node)->color;
    case VALUE_TEXTURE_MAP:
        return ((const struct texture *)entry->node)->pigment.color;
    case VALUE_DENSITY_MAP:
        return ((const struct density *)entry->node)->color;
    default:
        return entry->color;
    }
}

/* How much of the values from 0 to 1 is an entry's: between two entries what
 * they choose from is blended. */
static double share(double low, const struct map_entry *entry)
{
    double high = entry->next ? entry->next->at : 2 - entry->at;

    return fmax(0, high - low) / 2;
}

static void add_mean(double mean[5], const double *color, int terms,
                     double weight, double *sum)
{
    for (int i = 0; i < terms; i++)
        mean[i] += weight * color[i];
    *sum += weight;
}

/* Zeros after the terms that an entry has. */
static void mean_of_map(const struct map *map, enum pattern_kind kind,
                        double color[5])
{
    int terms = map->kind == VALUE_DENSITY_MAP ? 3 : 5;
    const struct map_entry *entry = map->first;
    double low = entry ? -entry->at : 0, sum = 0, mean[5] = {0};

    for (; entry; low = entry->at, entry = entry->next)
        add_mean(mean, entry_color(map, entry), terms,
                 map->list                 ? 1
                 : kind == PATTERN_AVERAGE ? entry->at
                                           : share(low, entry),
                 &sum);
    for (int i = 0; i < 5; i++)
        color[i] = sum > 0 ? mean[i] / sum : 0;
}

static void mean_of_default(const struct pattern *pattern, double color[5])
{
    struct brume_map map = surface_default_map(pattern);
    double sum = 0, mean[5] = {0};

    for (int i = 0; i < map.count; i++) {
        double low = i > 0 ? map.places[i - 1] : -map.places[i];
        double high = i + 1 < map.count ? map.places[i + 1] : 2 - map.places[i];
        add_mean(mean, map.values + 5 * i, 5, (high - low) / 2, &sum);
    }
    for (int i = 0; i < 5; i++)
        color[i] = mean[i] / sum;
}

void surface_mean(const struct patterned *on, double color[5])
{
    if (on->map)
        mean_of_map(on->map, on->pattern ? on->pattern->kind : PATTERN_NONE,
                    color);
    else
        mean_of_default(on->pattern, color);
}

static bool is_gray(const double *color)
{
    return color[0] == color[1] && color[1] == color[2];
}

bool surface_is_colored(const struct patterned *on)
{
    const struct map *map = on->map;
    const struct map_entry *entry = map ? map->first : NULL;
    struct brume_map usual = surface_default_map(on->pattern);
    bool colored = false;

    for (; entry; entry = entry->next) {
        const struct density *density = entry->node;
        colored |= !is_gray(entry_color(map, entry));
        colored |= map->kind == VALUE_DENSITY_MAP && density->colored;
    }
    for (int i = 0; !map && i < usual.count; i++)
        colored |= !is_gray(usual.values + 5 * i);
    return colored;
}

void surface_mean_pigment(struct pigment *pigment)
{
    if (pigment->on.pattern && pigment->on.pattern->kind != PATTERN_NONE)
        surface_mean(&pigment->on, pigment->color);
}

static bool differs(const struct texture *layer, const struct finish *from)
{
    const struct pattern *bumps = layer->normal.on.pattern;

    return layer->varied || (bumps && bumps->kind != PATTERN_NONE) ||
           memcmp(&layer->finish, from, sizeof *from) != 0 ||
           (layer->below && (from->phong != 0 || from->specular != 0));
}

static bool is_other_than(const struct texture *texture,
                          const struct finish *finish)
{
    for (; texture; texture = texture->below)
        if (differs(texture, finish))
            return true;
    return false;
}

bool surface_is_varied(const struct texture *texture)
{
    return is_other_than(texture, &texture->finish);
}

void surface_mean_texture(struct texture *texture)
{
    const struct texture *first;

    if (!texture->on.map || !texture->on.map->first)
        return;
    first = texture->on.map->first->node;
    texture->finish = first->finish;
    texture->pigment = first->pigment;
    surface_mean(&texture->on, texture->pigment.color);
    texture->varied = false;
    for (const struct map_entry *e = texture->on.map->first; e; e = e->next)
        texture->varied |= is_other_than(e->node, &first->finish);
}

/* ---- textures ---------------------------------------------------------- */

static void move(transform *by, const transform *then)
{
    *by = transform_then(by, then);
}

void surface_texture_transform(struct texture *texture, const transform *by)
{
    move(&texture->pigment.on.by, by);
    move(&texture->normal.on.by, by);
    move(&texture->on.by, by);
    move(&texture->below_by, by);
}

/* A colour's own reflection counts 1 - filter - transmit, at least 0. */
static bool color_is_clear(const double color[5])
{
    if (color[3] + color[4] < 1)
        return false;
    for (int i = 0; i < 3; i++)
        if (color[3] * color[i] + color[4] != 1)
            return false;
    return true;
}

static bool reflects(const struct finish *finish)
{
    for (int i = 0; i < 3; i++)
        if (finish->reflection.low[i] != 0 || finish->reflection.high[i] != 0)
            return true;
    return finish->phong != 0 || finish->specular != 0;
}

bool model_is_invisible(const struct texture *texture)
{
    for (; texture; texture = texture->below)
        if (!color_is_clear(texture->pigment.color) ||
            reflects(&texture->finish))
            return false;
    return true;
}

bool model_is_opaque(const struct texture *texture)
{
    for (; texture; texture = texture->below)
        if (texture->pigment.color[3] == 0 && texture->pigment.color[4] == 0)
            return true;
    return false;
}

bool surface_is_plain(const struct pattern *pattern)
{
    const double *amount = pattern->turbulence.amount;

    return !pattern->warps && amount[0] == 0 && amount[1] == 0 &&
           amount[2] == 0 && pattern->wave == WAVE_RAMP &&
           pattern->frequency == 1 && pattern->phase == 0;
}

const struct map *surface_checker(const struct pigment *pigment)
{
    const struct pattern *pattern = pigment->on.pattern;

    return pattern && pattern->kind == PATTERN_CHECKER &&
                   surface_is_plain(pattern) && !pigment->on.uv_mapping &&
                   pigment->on.map->kind == VALUE_COLOR_MAP
               ? pigment->on.map
               : NULL;
}

static double own_part(const double color[5])
{
    return fmax(0, 1 - color[3] - color[4]);
}

/* Light that a layer lets through falls on what is below it. */
static void cover(double color[5], const double below[5])
{
    double through = fmin(1, color[3] + color[4]);
    double both[5] = {0, 0, 0, through * below[3], through * below[4]};

    for (int i = 0; i < 3; i++) {
        double shown = own_part(color) * color[i] +
                       (color[3] * color[i] + color[4]) * own_part(below) *
                           below[i];
        both[i] = own_part(both) > 0 ? shown / own_part(both) : below[i];
    }
    memcpy(color, both, sizeof both);
}

static void colors_of(const struct texture *texture, const transform *by,
                      struct brume_material *out)
{
    const struct pigment *pigment = &texture->pigment;
    const struct map *checker = texture->below ? NULL
                                               : surface_checker(pigment);
    transform placing = transform_identity();

    out->pigment = BRUME_PIGMENT_SOLID;
    memcpy(out->color[0], pigment->color, sizeof out->color[0]);
    if (checker) {
        placing = transform_then(&pigment->on.by, by);
        out->pigment = BRUME_PIGMENT_CHECKER;
        for (int i = 0; i < 2; i++)
            memcpy(out->color[i],
                   i == 0 ? checker->first->color : checker->first->next->color,
                   sizeof out->color[i]);
    }
    memcpy(out->pigment_transform, placing.m, sizeof placing.m);
    for (const struct texture *t = texture->below; t; t = t->below)
        cover(out->color[0], t->pigment.color);
}

void model_material(const struct texture *texture, const transform *by,
                    struct brume_material *out)
{
    const struct finish *finish = &texture->finish;

    memset(out, 0, sizeof *out);
    out->function = -1;
    colors_of(texture, by, out);
    memcpy(out->ambient, finish->ambient, sizeof out->ambient);
    memcpy(out->emission, finish->emission, sizeof out->emission);
    out->diffuse = finish->diffuse[0];
    out->brilliance = finish->brilliance;
    out->phong = finish->phong;
    out->phong_size = finish->phong_size;
    out->specular = finish->specular;
    out->roughness = finish->roughness;
    out->metallic = finish->metallic;
}
