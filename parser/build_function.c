/* build_function.c - pigments, patterns, densities and transformations as
 * functions of core.
 *
 * What a map or a pigment_pattern refers to becomes a function first, which
 * the function of what refers to it calls. They may be nested as deep as a
 * user likes: a stack in place of recursion. Equal ones are made once. */
#include <math.h>
#include <string.h>

#include "parser/builder.h"
#include "parser/formula.h"

/* Something that gives a value at each point: 5 numbers, or (`bare`) the
 * pattern's one; of a layered texture those below too. Its bytes tell it from
 * others, so there are none that no member has. */
struct field_key {
    const struct pattern *pattern;
    const struct map *map;
    transform by;
    double color[5];
    const struct texture *below;
    transform below_by;
    int uv_mapping, bare;
};

/* A function in the making. */
struct writer {
    struct parser *parser;
    struct brume_function *to;
    struct brume_error *err;
    const char *missing; /* what core cannot do                     */
};

static struct field_key key_of(const struct patterned *on, const double *color,
                               int terms)
{
    struct field_key key;

    memset(&key, 0, sizeof key);
    key.pattern = on->pattern;
    key.map = on->map;
    key.by = on->by;
    key.uv_mapping = on->uv_mapping;
    for (int i = 0; i < terms; i++)
        key.color[i] = color[i];
    key.bare = terms == 0;
    return key;
}

static struct field_key pigment_key(const struct pigment *pigment)
{
    return key_of(&pigment->on, pigment->color, 5);
}

static struct field_key density_key(const struct density *density)
{
    return key_of(&density->on, density->color, 3);
}

/* What a texture's colours are: of a patterned one, of those that it chooses
 * from. */
static struct field_key texture_key(const struct texture *texture)
{
    struct field_key key;

    if (texture->on.map)
        return key_of(&texture->on, texture->pigment.color, 5);
    key = pigment_key(&texture->pigment);
    key.below = texture->below;
    if (texture->below)
        key.below_by = texture->below_by;
    return key;
}

static struct field_key entry_key(const struct map *map,
                                  const struct map_entry *entry)
{
    switch (map->kind) {
    case VALUE_DENSITY_MAP:
        return density_key(entry->node);
    case VALUE_TEXTURE_MAP:
        return texture_key(entry->node);
    default:
        return pigment_key(entry->node);
    }
}

static bool has_pattern(const struct field_key *key)
{
    return key->pattern && key->pattern->kind != PATTERN_NONE;
}

static struct intern *known(struct parser *parser)
{
    return &parser->builder->functions;
}

static int id_of(struct parser *parser, const struct field_key *key)
{
    struct intern_key bytes = intern_key(key, sizeof *key);

    return intern_find(known(parser), &bytes);
}

/* ---- numbers of patterns and warps ------------------------------------- */

enum { NUMBERS = 16 };

struct numbers {
    double n[NUMBERS];
    int count;
};

static void put(struct numbers *to, double x)
{
    to->n[to->count++] = x;
}

static void put_vector(struct numbers *to, const double v[3])
{
    for (int i = 0; i < 3; i++)
        put(to, v[i]);
}

/* POV-Ray takes more and fewer octaves as 10 and 1. */
static double octaves_of(const struct turbulence *turbulence)
{
    return fmin(fmax(turbulence->octaves, 1), 10);
}

static void put_noise(struct numbers *to, const struct turbulence *turbulence)
{
    put(to, octaves_of(turbulence));
    put(to, turbulence->lambda);
    put(to, turbulence->omega);
}

static double generator_of(const struct parser *parser,
                           const struct pattern *pattern)
{
    return pattern->noise_generator ? pattern->noise_generator
                                    : parser->builder->globals.noise_generator;
}

static void put_fractal(struct numbers *to, const struct pattern *pattern)
{
    put(to, pattern->magnet);
    put(to, pattern->number);
    put(to, pattern->fractal_exponent);
    for (int i = 0; i < 2; i++)
        put(to, pattern->exterior[i]);
    for (int i = 0; i < 2; i++)
        put(to, pattern->interior[i]);
    put(to, pattern->kind == PATTERN_JULIA);
    put(to, pattern->vector[0]);
    put(to, pattern->vector[1]);
}

static void put_own(struct parser *parser, const struct pattern *pattern,
                    struct numbers *to)
{
    const struct turbulence *turbulence = &pattern->turbulence;

    switch (pattern->kind) {
    case PATTERN_AGATE:
        put(to, generator_of(parser, pattern));
        put_noise(to, turbulence);
        put(to, pattern->agate_turb);
        break;
    case PATTERN_BRICK:
        put_vector(to, pattern->brick_size);
        put(to, pattern->mortar);
        break;
    case PATTERN_CRACKLE:
        put(to, generator_of(parser, pattern));
        put_vector(to, pattern->form);
        put(to, pattern->metric);
        put(to, pattern->offset);
        put(to, pattern->solid);
        break;
    case PATTERN_GRADIENT:
        put_vector(to, pattern->vector);
        break;
    case PATTERN_MARBLE:
    case PATTERN_SPIRAL1:
    case PATTERN_SPIRAL2:
        put(to, generator_of(parser, pattern));
        put_noise(to, turbulence);
        put(to, turbulence->amount[0]);
        if (pattern->kind != PATTERN_MARBLE)
            put(to, pattern->number);
        break;
    case PATTERN_PAVEMENT:
        put(to, pattern->sides);
        put(to, pattern->tiles);
        put(to, pattern->variant);
        break;
    case PATTERN_TILING:
        put(to, pattern->number);
        break;
    case PATTERN_QUILTED:
        put(to, pattern->control[0]);
        put(to, pattern->control[1]);
        break;
    case PATTERN_RIPPLES:
    case PATTERN_WAVES:
        put(to, parser->builder->globals.number_of_waves);
        put(to, pattern->frequency);
        put(to, pattern->phase);
        break;
    case PATTERN_WOOD:
        put_noise(to, turbulence);
        put(to, turbulence->amount[0]);
        put(to, turbulence->amount[1]);
        break;
    case PATTERN_JULIA:
    case PATTERN_MANDEL:
        put_fractal(to, pattern);
        break;
    default:
        break;
    }
}

/* Patterns of core that bear the same name; -1: none. */
static int core_pattern(enum pattern_kind kind)
{
#define SAME(name)                                                             \
    case PATTERN_##name:                                                       \
        return BRUME_PATTERN_##name;
    switch (kind) {
        SAME(AGATE)
        SAME(BOXED)
        SAME(BOZO)
        SAME(BRICK)
        SAME(CELLS)
        SAME(CHECKER)
        SAME(CRACKLE)
        SAME(CUBIC)
        SAME(CYLINDRICAL)
        SAME(DENTS)
        SAME(GRADIENT)
        SAME(GRANITE)
        SAME(HEXAGON)
        SAME(LEOPARD)
        SAME(MARBLE)
        SAME(ONION)
        SAME(PAVEMENT)
        SAME(PLANAR)
        SAME(QUILTED)
        SAME(RADIAL)
        SAME(RIPPLES)
        SAME(SPHERICAL)
        SAME(SPIRAL1)
        SAME(SPIRAL2)
        SAME(SQUARE)
        SAME(TILING)
        SAME(TRIANGULAR)
        SAME(WAVES)
        SAME(WOOD)
        SAME(WRINKLES)
    case PATTERN_BUMPS:
    case PATTERN_SPOTTED:
        return BRUME_PATTERN_BOZO;
    case PATTERN_JULIA:
    case PATTERN_MANDEL:
        return BRUME_PATTERN_FRACTAL;
    default:
        return -1;
    }
#undef SAME
}

static bool has_noise(int pattern)
{
    return pattern == BRUME_PATTERN_BOZO || pattern == BRUME_PATTERN_DENTS ||
           pattern == BRUME_PATTERN_GRANITE ||
           pattern == BRUME_PATTERN_WRINKLES;
}

/* Turbulence that is among a pattern's numbers. */
static bool is_turbulent_itself(enum pattern_kind kind)
{
    return kind == PATTERN_MARBLE || kind == PATTERN_WOOD;
}

/* ---- the point where a pattern is looked up ---------------------------- */

static void put_unit(struct numbers *to, const double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    for (int i = 0; i < 3; i++)
        put(to, length > 0 ? v[i] / length : i == 2);
}

static void put_turbulence(struct numbers *to,
                           const struct turbulence *turbulence)
{
    put_noise(to, turbulence);
    put_vector(to, turbulence->amount);
}

static bool moves(const double v[3])
{
    return v[0] != 0 || v[1] != 0 || v[2] != 0;
}

static void put_hole(struct numbers *to, const struct warp *warp)
{
    put_vector(to, warp->vector);
    put(to, warp->radius);
    put(to, warp->strength);
    put(to, warp->falloff);
    put(to, warp->inverse);
    put_vector(to, warp->repeat);
    put_vector(to, warp->jitter);
    put(to, moves(warp->jitter));
}

static void put_repeat(struct numbers *to, const struct warp *warp)
{
    int axis = warp->vector[0] != 0 ? 0 : warp->vector[1] != 0 ? 1 : 2;

    put(to, axis);
    put(to, warp->vector[axis]);
    put_vector(to, warp->offset);
    put_vector(to, warp->flip);
}

static enum brume_warp core_warp(const struct warp *warp, struct numbers *to)
{
    switch (warp->kind) {
    case WARP_REPEAT:
        put_repeat(to, warp);
        return BRUME_WARP_REPEAT;
    case WARP_BLACK_HOLE:
        put_hole(to, warp);
        return BRUME_WARP_BLACK_HOLE;
    case WARP_TURBULENCE:
        put_turbulence(to, &warp->turbulence);
        return BRUME_WARP_TURBULENCE;
    case WARP_CUBIC:
        return BRUME_WARP_CUBIC;
    default:
        break;
    }
    put_unit(to, warp->orientation);
    put(to, warp->dist_exp);
    if (warp->kind == WARP_TOROIDAL)
        put(to, warp->major_radius);
    return warp->kind == WARP_CYLINDRICAL ? BRUME_WARP_CYLINDRICAL
           : warp->kind == WARP_SPHERICAL ? BRUME_WARP_SPHERICAL
           : warp->kind == WARP_TOROIDAL  ? BRUME_WARP_TOROIDAL
                                          : BRUME_WARP_PLANAR;
}

static bool write_inverse(struct writer *w, const transform *by)
{
    return transform_is_identity(by) ||
           brume_function_inverse(w->to, by->m, w->err);
}

/* Turbulence comes before all maps and warps, wherever it is written: the
 * point goes through it last. */
static bool write_place(struct writer *w, const struct field_key *key)
{
    const struct pattern *pattern = key->pattern;
    struct numbers turbulence = {.count = 0};

    if (!write_inverse(w, &key->by))
        return false;
    for (const struct warp *warp = pattern->warps; warp; warp = warp->older) {
        struct numbers numbers = {.count = 0};
        enum brume_warp kind = core_warp(warp, &numbers);
        if (!brume_function_warp(w->to, kind, numbers.n, numbers.count,
                                 w->err) ||
            !write_inverse(w, &warp->before))
            return false;
    }
    if (!moves(pattern->turbulence.amount) ||
        is_turbulent_itself(pattern->kind))
        return true;
    put_turbulence(&turbulence, &pattern->turbulence);
    return brume_function_warp(w->to, BRUME_WARP_TURBULENCE, turbulence.n,
                               turbulence.count, w->err);
}

/* ---- a pattern's value ------------------------------------------------- */

/* A pigment_pattern gives the grey of its pigment. */
static bool write_pigment_pattern(struct writer *w,
                                  const struct pattern *pattern)
{
    struct field_key key = pigment_key(pattern->pigment);

    return brume_function_call(w->to, id_of(w->parser, &key), 3, w->err) &&
           brume_function_op(w->to, BRUME_OP_GRAY, w->err);
}

static bool write_wave(struct writer *w, const struct pattern *pattern)
{
    static const enum brume_wave waves[] = {
        [WAVE_RAMP] = BRUME_WAVE_RAMP,   [WAVE_TRIANGLE] = BRUME_WAVE_TRIANGLE,
        [WAVE_SINE] = BRUME_WAVE_SINE,   [WAVE_SCALLOP] = BRUME_WAVE_SCALLOP,
        [WAVE_CUBIC] = BRUME_WAVE_CUBIC, [WAVE_POLY] = BRUME_WAVE_POLY};

    return surface_choices(pattern->kind) > 0 ||
           brume_function_wave(w->to, waves[pattern->wave], pattern->exponent,
                               pattern->frequency, pattern->phase, w->err);
}

/* Its own world lies in the pattern's by a map of the file's. */
static bool write_grid(struct writer *w, const struct pattern *pattern)
{
    if (pattern->grid < 0) {
        w->missing = "its file";
        return false;
    }
    return write_inverse(w, &pattern->grid_by) &&
           brume_function_grid(w->to, pattern->grid, w->err);
}

/* Of an image_pattern the grey, or how clear it is: what has no alpha gives
 * its first number, as in POV-Ray. */
static bool write_image(struct writer *w, const struct pattern *pattern)
{
    struct brume_image_use use;

    if (!load_image(w->parser, pattern, &use)) {
        w->missing = "its picture";
        return false;
    }
    bool fine = brume_function_image(w->to, &use, w->err);
    if (!fine || pattern->kind == PATTERN_IMAGE_MAP)
        return fine;
    if (pattern->image->use != IMAGE_USE_ALPHA)
        return brume_function_op(w->to, BRUME_OP_GRAY, w->err);
    return brume_function_pick(w->to, 5, pattern->image->clear ? 4 : 0, w->err);
}

/* Patterns that core has in part. */
static bool is_missing(const struct pattern *pattern)
{
    bool shaped = pattern->form[0] != 0 || pattern->interior[0] != 0 ||
                  pattern->exterior[0] != 0;

    return (pattern->kind == PATTERN_TILING && pattern->number > 24) ||
           (pattern->kind == PATTERN_PAVEMENT && shaped);
}

/* Takes a point and leaves a value. */
static bool write_value(struct writer *w, const struct pattern *pattern)
{
    struct numbers numbers = {.count = 0};
    int kind = core_pattern(pattern->kind);
    bool fine;

    if (pattern->kind == PATTERN_FUNCTION) {
        fine = brume_function_call(w->to, pattern->function->id, 3, w->err);
    } else if (pattern->kind == PATTERN_PIGMENT) {
        fine = write_pigment_pattern(w, pattern);
    } else if (pattern->kind == PATTERN_IMAGE) {
        fine = write_image(w, pattern);
    } else if (pattern->kind == PATTERN_DENSITY_FILE) {
        fine = write_grid(w, pattern);
    } else if (kind < 0 || is_missing(pattern)) {
        w->missing = "its pattern";
        return false;
    } else {
        if (has_noise(kind))
            put(&numbers, generator_of(w->parser, pattern));
        put_own(w->parser, pattern, &numbers);
        fine = brume_function_pattern(w->to, (enum brume_pattern)kind,
                                      numbers.n, numbers.count, w->err);
    }
    return fine && write_wave(w, pattern);
}

/* ---- what a value chooses ---------------------------------------------- */

/* Arrays of a map for core. */
struct map_arrays {
    double *places, *values;
    int *functions;
};

/* Entries that stand before others stand at their place. */
static void fill_arrays(struct parser *parser, const struct map *map,
                        struct map_arrays *to)
{
    double low = 0;
    int i = 0;

    for (const struct map_entry *e = map->first; e; e = e->next, i++) {
        low = map->list ? low : fmin(fmax(e->at, low), 1);
        to->places[i] = low;
        if (map->kind == VALUE_COLOR_MAP) {
            memcpy(to->values + 5 * i, e->color, sizeof e->color);
        } else {
            struct field_key key = entry_key(map, e);
            to->functions[i] = id_of(parser, &key);
        }
    }
}

static bool write_map(struct writer *w, const struct map *map, bool average)
{
    size_t count = (size_t)map->count;
    bool colors = map->kind == VALUE_COLOR_MAP;
    struct map_arrays arrays = {
        parser_array(w->parser, count, sizeof(double)),
        parser_array(w->parser, 5 * count, sizeof(double)),
        parser_array(w->parser, count, sizeof(int))};
    struct brume_map to = {.count = map->count, .terms = 5};

    if (!arrays.places || !arrays.values || !arrays.functions)
        return false;
    fill_arrays(w->parser, map, &arrays);
    to.places = map->list ? NULL : arrays.places;
    to.values = colors ? arrays.values : NULL;
    to.functions = colors ? NULL : arrays.functions;
    if (!average)
        return brume_function_map(w->to, &to, w->err);
    int i = 0;
    for (const struct map_entry *e = map->first; e; e = e->next)
        arrays.places[i++] = e->at;
    return brume_function_average(w->to, &to, w->err);
}

static bool write_default_map(struct writer *w, const struct pattern *pattern)
{
    struct brume_map to = surface_default_map(pattern);

    return brume_function_map(w->to, &to, w->err);
}

static bool write_point(struct writer *w)
{
    return brume_function_parameter(w->to, 0, w->err) &&
           brume_function_parameter(w->to, 1, w->err) &&
           brume_function_parameter(w->to, 2, w->err);
}

static bool write_color(struct writer *w, const double color[5])
{
    for (int i = 0; i < 5; i++)
        if (!brume_function_constant(w->to, color[i], w->err))
            return false;
    return true;
}

static bool write_field(struct writer *w, const struct field_key *key)
{
    const struct pattern *pattern = key->pattern;

    if (!has_pattern(key))
        return write_color(w, key->color);
    if (key->uv_mapping) {
        w->missing = "uv_mapping";
        return false;
    }
    if (!write_point(w) || !write_place(w, key))
        return false;
    if (pattern->kind == PATTERN_IMAGE_MAP)
        return write_image(w, pattern);
    if (pattern->kind == PATTERN_AVERAGE && !key->map) {
        w->missing = "its map";
        return false;
    }
    if (pattern->kind == PATTERN_AVERAGE)
        return write_map(w, key->map, true);
    if (key->bare)
        return write_value(w, pattern);
    return brume_function_copy(w->to, 3, w->err) && write_value(w, pattern) &&
           (key->map ? write_map(w, key->map, false)
                     : write_default_map(w, pattern));
}

/* ---- layers ------------------------------------------------------------ */

static struct field_key upper_key(const struct field_key *key)
{
    struct field_key upper = *key;

    upper.below = NULL;
    memset(&upper.below_by, 0, sizeof upper.below_by);
    return upper;
}

static bool write_layers(struct writer *w, const struct field_key *key)
{
    struct field_key upper = upper_key(key), lower = texture_key(key->below);
    int both = build_cover(w->parser, w->err);

    return both >= 0 && write_point(w) &&
           brume_function_call(w->to, id_of(w->parser, &upper), 3, w->err) &&
           write_point(w) && write_inverse(w, &key->below_by) &&
           brume_function_call(w->to, id_of(w->parser, &lower), 3, w->err) &&
           brume_function_call(w->to, both, 10, w->err);
}

/* ---- parts first ------------------------------------------------------- */

/* Its parts are functions by now. -1: `err`, or `missing`. */
static int make(struct writer *w, const struct field_key *key)
{
    struct intern_key bytes = intern_key(key, sizeof *key);
    int id = -1;

    w->to = brume_function_new(w->parser->out->scene, 3, w->err);
    if (w->to && (key->below ? write_layers(w, key) : write_field(w, key)))
        id = brume_add_function(w->parser->out->scene, w->to, w->err);
    else
        brume_function_free(w->to);
    if (id >= 0)
        intern_keep(known(w->parser), &w->parser->arena, &bytes, id);
    return id;
}

/* A part that is no function yet; false: all are. */
static bool open_part(struct parser *parser, const struct field_key *key,
                      struct field_key *part)
{
    const struct map *map = key->map;

    if (key->below) {
        *part = upper_key(key);
        if (id_of(parser, part) < 0)
            return true;
        *part = texture_key(key->below);
        return id_of(parser, part) < 0;
    }
    if (!has_pattern(key))
        return false;
    if (key->pattern->kind == PATTERN_PIGMENT) {
        *part = pigment_key(key->pattern->pigment);
        if (id_of(parser, part) < 0)
            return true;
    }
    if (!map || map->kind == VALUE_COLOR_MAP)
        return false;
    for (const struct map_entry *e = map->first; e; e = e->next) {
        *part = entry_key(map, e);
        if (id_of(parser, part) < 0)
            return true;
    }
    return false;
}

static int make_all(struct writer *w, const struct field_key *root)
{
    struct parser *parser = w->parser;
    void *stack = NULL;
    size_t room = 0, depth = 1;
    int id = id_of(parser, root);

    if (id >= 0)
        return id;
    if (!arena_grow(&parser->arena, &stack, &room, 1, sizeof *root))
        return -1;
    *(struct field_key *)stack = *root;
    while (depth > 0) {
        if (!arena_grow(&parser->arena, &stack, &room, depth + 1, sizeof *root))
            return -1;
        struct field_key *keys = stack;
        if (open_part(parser, &keys[depth - 1], &keys[depth])) {
            depth++;
            continue;
        }
        id = make(w, &keys[--depth]);
        if (id < 0)
            return -1;
    }
    return id;
}

/* What is too much for core it cannot do either. */
int build_texture_function(struct parser *parser, const struct texture *texture)
{
    struct brume_error err = {0};
    struct writer writer = {.parser = parser, .err = &err};
    struct field_key key = texture_key(texture);

    return make_all(&writer, &key);
}

int build_pigment_function(struct parser *parser, const struct pigment *pigment)
{
    struct brume_error err = {0};
    struct writer writer = {.parser = parser, .err = &err};
    struct field_key key = pigment_key(pigment);

    return make_all(&writer, &key);
}

int build_density_function(struct parser *parser, const struct density *density)
{
    struct brume_error err = {0};
    struct writer writer = {.parser = parser, .err = &err};
    struct field_key key = density_key(density);

    return make_all(&writer, &key);
}

static int transform_function(struct parser *parser,
                              const struct transform_block *block,
                              struct brume_error *err)
{
    const transform by = model_transform_result(block);
    struct brume_function *to = brume_function_new(parser->out->scene, 3, err);
    struct writer w = {.parser = parser, .to = to, .err = err};

    if (to && write_point(&w) && brume_function_transform(to, by.m, err))
        return brume_add_function(parser->out->scene, to, err);
    brume_function_free(to);
    return -1;
}

int build_function(struct parser *parser, const struct value *value,
                   struct location at, struct brume_error *err)
{
    struct writer writer = {.parser = parser, .err = err};
    struct field_key key;
    int id = -1;

    if (value->kind == VALUE_TRANSFORM)
        return transform_function(parser, value->node, err);
    if (value->kind == VALUE_SPLINE)
        return build_spline_function(parser, value, err);
    if (value->kind == VALUE_PIGMENT) {
        key = pigment_key(value->node);
        id = make_all(&writer, &key);
    } else if (value->kind == VALUE_DENSITY) {
        key = density_key(value->node);
        id = make_all(&writer, &key);
    } else if (value->kind == VALUE_PATTERN) {
        key = key_of(value->node, NULL, 0);
        id = make_all(&writer, &key);
    } else {
        parser_mistake(parser, at, "a function of a %s is not supported yet",
                       value_name(value));
    }
    if (writer.missing)
        parser_mistake(parser, at,
                       "a function of this %s is not supported "
                       "yet: %s",
                       value_name(value), writer.missing);
    return id;
}
