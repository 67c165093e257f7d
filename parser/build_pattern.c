/* build_pattern.c - patterns and their modifiers, wherever a pattern is. */
#include <float.h>
#include <string.h>

#include "parser/builder.h"
#include "parser/formula.h"

/* Statements that have a pattern. */
const enum build_kind build_patterned[] = {
    BUILD_PIGMENT,          BUILD_NORMAL,       BUILD_TEXTURE,
    BUILD_INTERIOR_TEXTURE, BUILD_DENSITY,      BUILD_TEMPERATURE,
    BUILD_AMOUNT,           BUILD_PATTERN,      BUILD_PIGMENT_PATTERN,
    BUILD_PIGMENT_ENTRY,    BUILD_NORMAL_ENTRY, BUILD_TEXTURE_ENTRY,
    BUILD_DENSITY_ENTRY,    BUILD_KINDS};

/* ---- the pattern of a statement ---------------------------------------- */

/* It lies at the start of the node, save that of a texture. */
struct patterned *build_patterned_of(const struct frame *frame)
{
    struct texture *texture = frame->node;

    return build_statement_of(frame)->takes & BUILD_TAKES(VALUE_TEXTURE)
               ? &texture->on
               : frame->node;
}

/* Identifiers share patterns: what is changed is a copy. */
struct pattern *build_pattern_of(struct parser *parser, struct frame *frame)
{
    struct patterned *on = build_patterned_of(frame);
    struct pattern *own;

    if (frame->given & FRAME_PATTERN)
        return (struct pattern *)on->pattern;
    own = parser_alloc(parser, sizeof *own);
    if (!own)
        return NULL;
    if (on->pattern)
        *own = *on->pattern;
    else
        surface_pattern_start(own, PATTERN_NONE);
    on->pattern = own;
    frame->given |= FRAME_PATTERN;
    return own;
}

/* A list of a block pattern fits no other. */
struct pattern *build_pattern_begin(struct parser *parser, struct frame *frame,
                                    enum pattern_kind kind)
{
    struct patterned *on = build_patterned_of(frame);
    struct pattern *pattern = build_pattern_of(parser, frame);

    if (!pattern)
        return NULL;
    surface_pattern_start(pattern, kind);
    if (surface_choices(kind) > 0 || (on->map && on->map->list))
        on->map = NULL;
    on->by = transform_identity();
    frame->given |= FRAME_CHOSEN;
    frame->given &= ~(unsigned)(FRAME_LIST | FRAME_PLAIN);
    return pattern;
}

/* ---- words of patterns ------------------------------------------------- */

#define OF(word_, kind_, start_, low_, high_, id_, member)                     \
    {                                                                          \
        .word = word_, .kind = kind_, .start = {start_, start_, start_},       \
        .low = low_, .high = high_,                                            \
        .offset = offsetof(struct pattern, member), .alone = NAN, .id = id_    \
    }
#define ANY(word, kind, id, member)                                            \
    OF(word, kind, 0, -INFINITY, INFINITY, id, member)
#define WAVE_WORD(word, wave_)                                                 \
    PARAM_WORD(word, PARAM_MARK, wave_, 0, struct pattern, wave)

/* Which patterns a modifier belongs to; 0: to all. */
enum {
    FOR_ALL,
    FOR_BRICK,
    FOR_AGATE,
    FOR_CRACKLE,
    FOR_FACETS,
    FOR_QUILTED,
    FOR_PAVEMENT,
    FOR_CRACKLE_PAVEMENT,
    FOR_FRACTAL,
    FOR_FRACTAL_PAVEMENT,
    FOR_TURBULENCE,
    FOR_POLY
};

static bool belongs(int id, enum pattern_kind kind)
{
    bool fractal = kind == PATTERN_MANDEL || kind == PATTERN_JULIA;

    switch (id) {
    case FOR_BRICK:
        return kind == PATTERN_BRICK;
    case FOR_AGATE:
        return kind == PATTERN_AGATE;
    case FOR_CRACKLE:
        return kind == PATTERN_CRACKLE;
    case FOR_FACETS:
        return kind == PATTERN_FACETS;
    case FOR_QUILTED:
        return kind == PATTERN_QUILTED;
    case FOR_PAVEMENT:
        return kind == PATTERN_PAVEMENT;
    case FOR_CRACKLE_PAVEMENT:
        return kind == PATTERN_CRACKLE || kind == PATTERN_PAVEMENT;
    case FOR_FRACTAL:
        return fractal;
    case FOR_FRACTAL_PAVEMENT:
        return fractal || kind == PATTERN_PAVEMENT;
    default:
        return true;
    }
}

static const struct param modifier_rows[] = {
    ANY("turbulence", PARAM_VECTOR, FOR_TURBULENCE, turbulence.amount),
    OF("octaves", PARAM_INTEGER, 6, 0, 1000, FOR_ALL, turbulence.octaves),
    ANY("omega", PARAM_FLOAT, FOR_ALL, turbulence.omega),
    ANY("lambda", PARAM_FLOAT, FOR_ALL, turbulence.lambda),
    ANY("frequency", PARAM_FLOAT, FOR_ALL, frequency),
    ANY("phase", PARAM_FLOAT, FOR_ALL, phase),
    WAVE_WORD("ramp_wave", WAVE_RAMP),
    WAVE_WORD("triangle_wave", WAVE_TRIANGLE),
    WAVE_WORD("sine_wave", WAVE_SINE),
    WAVE_WORD("scallop_wave", WAVE_SCALLOP),
    WAVE_WORD("cubic_wave", WAVE_CUBIC),
    {.word = "poly_wave",
     .kind = PARAM_FLOAT,
     .low = -INFINITY,
     .high = INFINITY,
     .offset = offsetof(struct pattern, exponent),
     .alone = 1,
     .id = FOR_POLY},
    OF("noise_generator", PARAM_INTEGER, 2, 0, 3, FOR_ALL, noise_generator),
    ANY("agate_turb", PARAM_FLOAT, FOR_AGATE, agate_turb),
    ANY("brick_size", PARAM_VECTOR, FOR_BRICK, brick_size),
    ANY("mortar", PARAM_FLOAT, FOR_BRICK, mortar),
    ANY("form", PARAM_VECTOR, FOR_CRACKLE_PAVEMENT, form),
    ANY("metric", PARAM_FLOAT, FOR_CRACKLE, metric),
    ANY("offset", PARAM_FLOAT, FOR_CRACKLE, offset),
    {.word = "solid",
     .kind = PARAM_SWITCH,
     .offset = offsetof(struct pattern, solid),
     .id = FOR_CRACKLE},
    ANY("coords", PARAM_FLOAT, FOR_FACETS, facet_coords),
    ANY("size", PARAM_FLOAT, FOR_FACETS, facet_size),
    ANY("control0", PARAM_FLOAT, FOR_QUILTED, control[0]),
    ANY("control1", PARAM_FLOAT, FOR_QUILTED, control[1]),
    OF("exponent", PARAM_INTEGER, 2, 2, 33, FOR_FRACTAL, fractal_exponent),
    OF("exterior", PARAM_PAIR, 1, -INFINITY, INFINITY, FOR_FRACTAL_PAVEMENT,
       exterior),
    OF("interior", PARAM_PAIR, 1, -INFINITY, INFINITY, FOR_FRACTAL_PAVEMENT,
       interior),
    OF("number_of_sides", PARAM_INTEGER, 3, 3, 6, FOR_PAVEMENT, sides),
    OF("number_of_tiles", PARAM_INTEGER, 1, 1, 6, FOR_PAVEMENT, tiles),
    OF("pattern", PARAM_INTEGER, 1, 1, 35, FOR_PAVEMENT, variant),
    {0}};

static void *modified(struct parser *parser, struct frame *frame)
{
    return build_pattern_of(parser, frame);
}

static void set_modifier(struct parser *parser, struct frame *frame,
                         const struct param *row, struct location at)
{
    struct pattern *pattern = build_pattern_of(parser, frame);

    if (row->id == FOR_POLY)
        pattern->wave = WAVE_POLY;
    if (pattern->kind == PATTERN_PAVEMENT && pattern->sides == 5)
        parser_mistake(parser, at, "'%s' must be 3, 4 or 6", row->word);
    if (!belongs(row->id, pattern->kind))
        parser_mistake(parser, at, "'%s' does not belong to this pattern",
                       row->word);
}

/* Words that choose a pattern. */
static const struct param pattern_rows[] = {
#define X(kind, word, least, most) PARAM_OWN(word, least, most, PATTERN_##kind),
    SURFACE_PATTERNS(X)
#undef X
        {0}};

static const struct param axis_arguments[] = {
    ANY("gradient", PARAM_VECTOR, 0, vector), {0}};
static const struct param slope_arguments[] = {
    ANY("slope", PARAM_VECTOR, 0, vector), {0}};
static const struct param tiling_arguments[] = {
    OF("tiling", PARAM_INTEGER, 1, 1, 27, 0, number), {0}};
static const struct param count_arguments[] = {
    OF("number", PARAM_INTEGER, 0, 0, INT32_MAX, 0, number), {0}};
static const struct param julia_arguments[] = {
    ANY("julia", PARAM_VECTOR, 0, vector),
    OF("iterations", PARAM_INTEGER, 0, 0, INT32_MAX, 0, number),
    {0}};
static const struct param magnet_arguments[] = {
    OF("magnet", PARAM_INTEGER, 1, 1, 2, 0, magnet), {0}};

/* Rows of the numbers that stand behind the word of a pattern. */
static const struct param *const arguments[PATTERN_KINDS] = {
    [PATTERN_GRADIENT] = axis_arguments, [PATTERN_SLOPE] = slope_arguments,
    [PATTERN_SPIRAL1] = count_arguments, [PATTERN_SPIRAL2] = count_arguments,
    [PATTERN_TILING] = tiling_arguments, [PATTERN_MANDEL] = count_arguments,
    [PATTERN_JULIA] = julia_arguments,   [PATTERN_MAGNET] = magnet_arguments};

static void choose_pattern(struct parser *parser, struct frame *frame,
                           const struct param *row, const struct value *value,
                           int count, struct location at)
{
    enum pattern_kind kind = (enum pattern_kind)row->id;
    struct pattern *pattern = build_pattern_of(parser, frame);
    int magnet = pattern && pattern->kind == PATTERN_MAGNET ? pattern->magnet
                                                            : 0;

    if (kind == PATTERN_FACETS &&
        !(build_statement_of(frame)->takes & BUILD_TAKES(VALUE_NORMAL_MAP)))
        parser_mistake(parser, at, "'facets' is a pattern for normals only");
    pattern = build_pattern_begin(parser, frame, kind);
    if (!pattern)
        return;
    pattern->magnet = magnet;
    for (int i = 0; i < count; i++)
        param_set(parser, &arguments[kind][i], pattern, at, &value[i], 1,
                  parser->builder->value_at);
}

static const struct param patterned_rows[] = {
    PARAM_WORD("uv_mapping", PARAM_MARK, 1, 0, struct patterned, uv_mapping),
    {0}};

static void *patterned(struct parser *parser, struct frame *frame)
{
    (void)parser;
    return build_patterned_of(frame);
}

static void set_nothing(struct parser *parser, struct frame *frame,
                        const struct param *row, struct location at)
{
    (void)parser;
    (void)frame;
    (void)row;
    (void)at;
}

/* ---- density_file ------------------------------------------------------ */

enum {
    FILE_NAMED,
    FILE_INTERPOLATE,
    FILE_FIT,
    FILE_UP,
    FILE_RADIUS,
    FILE_VOXEL,
    FILE_NEIGHBORS
};

static const struct param file_rows[] = {
    PARAM_OWN("df3", 1, 1, FILE_NAMED),
    PARAM_OWN("vdb", 1, 2, FILE_NAMED),
    PARAM_OWN("nvdb", 1, 2, FILE_NAMED),
    PARAM_OWN("particles", 1, 2, FILE_NAMED),
    PARAM_OWN("interpolate", 1, 1, FILE_INTERPOLATE),
    PARAM_OWN("fit", 0, 0, FILE_FIT),
    PARAM_OWN("up", 1, 1, FILE_UP),
    PARAM_OWN("radius", 1, 1, FILE_RADIUS),
    PARAM_OWN("voxel", 1, 1, FILE_VOXEL),
    PARAM_OWN("neighbors", 1, 1, FILE_NEIGHBORS),
    {0}};

struct data_file data_file(const char *format, struct string name,
                           struct location at)
{
    return (struct data_file){
        .format = format, .name = name, .at = at, .interpolate = -1};
}

static void name_file(struct parser *parser, struct data_file *file,
                      const struct param *row, const struct value *value,
                      int count)
{
    for (int i = 0; i < count; i++)
        if (value[i].kind != VALUE_STRING) {
            parser_mistake(parser, parser->builder->value_at,
                           "'%s' needs the name of a %s", row->word,
                           i == 0 ? "file" : "grid");
            return;
        }
    *file = data_file(row->word, value->string, parser->builder->value_at);
    if (count > 1)
        file->grid = value[1].string;
}

static void interpolate_file(struct parser *parser, struct data_file *file,
                             const struct value *number, struct location at)
{
    double type = trunc(number->v[0]);

    if (number->kind != VALUE_NUMBER || number->terms != 1 ||
        !(type >= 0 && type <= 2))
        parser_mistake(parser, at, "'interpolate' must be 0, 1 or 2");
    else
        file->interpolate = (int)type;
}

static void turn_file(struct parser *parser, struct data_file *file,
                      const struct value *axis, struct location at)
{
    struct value v = value_promote(*axis, 3);
    bool y = v.v[0] == 0 && v.v[1] == 1 && v.v[2] == 0;

    file->up_z = v.v[0] == 0 && v.v[1] == 0 && v.v[2] == 1;
    if (axis->kind != VALUE_NUMBER || (!y && !file->up_z))
        parser_mistake(parser, at, "'up' must be y or z");
}

/* A number that tells of particles. */
static void size_file(struct parser *parser, struct data_file *file,
                      const struct param *row, const struct value *number,
                      struct location at)
{
    double v = number->v[0];
    double most = row->id == FILE_NEIGHBORS ? BRUME_MAX_NEIGHBORS : DBL_MAX;

    if (strcmp(file->format, "particles"))
        parser_mistake(parser, at, "'%s' belongs to particles, not to '%s'",
                       row->word, file->format);
    else if (number->kind != VALUE_NUMBER || number->terms != 1 ||
             !(v > 0 && v <= most))
        parser_mistake(parser, at, "'%s' must be a number above 0%s", row->word,
                       row->id == FILE_NEIGHBORS ? ", at most 1024" : "");
    else if (row->id == FILE_RADIUS)
        file->radius = v;
    else if (row->id == FILE_VOXEL)
        file->voxel = v;
    else
        file->neighbors = (int)ceil(v);
}

static void set_file(struct parser *parser, struct frame *frame,
                     const struct param *row, const struct value *value,
                     int count, struct location at)
{
    struct pattern *pattern = build_pattern_of(parser, frame);
    struct data_file *file;

    if (!pattern)
        return;
    if (pattern->kind != PATTERN_DENSITY_FILE) {
        parser_mistake(parser, at, "'%s' belongs behind 'density_file'",
                       row->word);
        return;
    }
    if (!pattern->file)
        pattern->file = parser_alloc(parser, sizeof *pattern->file);
    file = (struct data_file *)pattern->file;
    if (!file)
        return;
    if (row->id == FILE_NAMED)
        name_file(parser, file, row, value, count);
    else if (!file->format)
        parser_mistake(parser, at, "'%s' belongs behind the name of a file",
                       row->word);
    else if (row->id == FILE_INTERPOLATE)
        interpolate_file(parser, file, value, parser->builder->value_at);
    else if (row->id == FILE_UP)
        turn_file(parser, file, value, parser->builder->value_at);
    else if (row->id >= FILE_RADIUS)
        size_file(parser, file, row, value, parser->builder->value_at);
    else
        file->fit = true;
}

static enum vdb_role role_of(enum build_kind kind)
{
    if (kind == BUILD_TEMPERATURE)
        return VDB_TEMPERATURE;
    return kind == BUILD_AMOUNT ? VDB_FLAME : VDB_DENSITY;
}

/* All that belongs to the file is said. */
static void load_file(struct parser *parser, struct frame *frame,
                      struct pattern *pattern)
{
    const struct data_file *file = pattern->file;

    if (!file || !file->format)
        parser_mistake(parser, frame->at, "'density_file' needs a file");
    else if (build_has_file(parser, file->name, file->at))
        load_density(parser, file, role_of(frame->kind), pattern);
}

const struct param_group build_pattern_groups[] = {
    {.rows = pattern_rows, .values = choose_pattern},
    {.rows = modifier_rows, .node = modified, .set = set_modifier},
    {.rows = patterned_rows, .node = patterned, .set = set_nothing},
    {.rows = file_rows, .values = set_file},
    {0}};

/* ---- what a pattern chooses from --------------------------------------- */

bool build_pattern_lists(const struct frame *frame)
{
    const struct pattern *pattern = build_patterned_of(frame)->pattern;

    return frame->given & FRAME_CHOSEN && pattern &&
           surface_choices(pattern->kind) > 0;
}

/* The map that lists for this kind of value make; VALUE_NONE: there is none. */
static int list_kind(enum value_kind kind)
{
    switch (kind) {
    case VALUE_PIGMENT:
        return VALUE_PIGMENT_MAP;
    case VALUE_NORMAL:
        return VALUE_NORMAL_MAP;
    case VALUE_TEXTURE:
        return VALUE_TEXTURE_MAP;
    case VALUE_DENSITY:
        return VALUE_DENSITY_MAP;
    case VALUE_NUMBER:
        return VALUE_COLOR_MAP;
    default:
        return VALUE_NONE;
    }
}

static size_t node_size(enum value_kind kind)
{
    switch (kind) {
    case VALUE_PIGMENT:
        return sizeof(struct pigment);
    case VALUE_NORMAL:
        return sizeof(struct normal);
    case VALUE_TEXTURE:
        return sizeof(struct texture);
    default:
        return sizeof(struct density);
    }
}

static struct map *own_list(struct parser *parser, struct frame *frame,
                            int kind)
{
    struct patterned *on = build_patterned_of(frame);

    if (frame->given & FRAME_LIST)
        return (struct map *)on->map;
    struct map *list = parser_alloc(parser, sizeof *list);
    if (!list)
        return NULL;
    list->kind = kind;
    list->list = true;
    on->map = list;
    frame->given |= FRAME_LIST;
    return list;
}

/* The value's node may be given up after this: the list has a copy. */
static bool add_choice(struct parser *parser, struct map *list,
                       const struct value *value)
{
    void *copy = NULL;

    if (value->kind == VALUE_NUMBER) {
        struct value color = value_promote(*value, 5);
        return build_map_add(parser, list, list->count, color.v, 5, NULL);
    }
    copy = parser_alloc(parser, node_size(value->kind));
    if (!copy)
        return false;
    memcpy(copy, value->node, node_size(value->kind));
    return build_map_add(parser, list, list->count, NULL, 0, copy);
}

void build_pattern_choice(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    const struct pattern *pattern = build_patterned_of(frame)->pattern;
    int room = surface_choices(pattern->kind);
    int kind = list_kind(value->kind);
    struct map *list;

    if (kind == VALUE_NONE) {
        build_misplaced(parser, frame, value, at);
        return;
    }
    list = own_list(parser, frame, kind);
    if (!list)
        return;
    if (list->kind != kind)
        parser_mistake(parser, at, "a list has things of one kind");
    else if (list->count == room)
        parser_mistake(parser, at, "this pattern chooses from %d things", room);
    else
        add_choice(parser, list, value);
}

/* POV-Ray's colours where a block pattern has too few of its own. */
static struct value block_color(enum pattern_kind kind, int index)
{
    static const double list[3][6][3] = {
        {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
        {{0.5, 0.5, 0.5}, {0.6, 0.15, 0.15}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}};
    int used = kind == PATTERN_BRICK ? 1 : surface_choices(kind) > 3 ? 2 : 0;
    const double *c = list[used][index];

    return value_color(c[0], c[1], c[2], 0, 0);
}

static void fill_colors(struct parser *parser, struct frame *frame,
                        enum pattern_kind kind)
{
    struct map *list = own_list(parser, frame, VALUE_COLOR_MAP);

    while (list && list->count < surface_choices(kind)) {
        struct value color = block_color(kind, list->count);
        if (!add_choice(parser, list, &color))
            return;
    }
}

static void fill_pigments(struct parser *parser, struct frame *frame,
                          enum pattern_kind kind)
{
    struct map *list = own_list(parser, frame, VALUE_PIGMENT_MAP);

    while (list && list->count < surface_choices(kind)) {
        struct pigment pigment = {.on = {.by = transform_identity()}};
        struct value value = value_node(VALUE_PIGMENT, &pigment);
        struct value color = block_color(kind, list->count);
        memcpy(pigment.color, color.v, sizeof pigment.color);
        if (!add_choice(parser, list, &value))
            return;
    }
}

static void complete_list(struct parser *parser, struct frame *frame,
                          const struct pattern *pattern, struct location at)
{
    const struct map *map = build_patterned_of(frame)->map;
    int choices = surface_choices(pattern->kind);
    bool colors = build_statement_of(frame)->takes &
                  (BUILD_TAKES(VALUE_PIGMENT_MAP) |
                   BUILD_TAKES(VALUE_DENSITY_MAP));

    if (map && !map->list) {
        parser_mistake(parser, at,
                       "this pattern chooses from a list, not "
                       "from a map");
        return;
    }
    if (pattern->kind == PATTERN_MATERIAL_MAP || (!map && !colors))
        return;
    if (!map || map->kind == VALUE_COLOR_MAP)
        fill_colors(parser, frame, pattern->kind);
    else if (map->kind == VALUE_PIGMENT_MAP)
        fill_pigments(parser, frame, pattern->kind);
    else if (map->count < choices)
        parser_mistake(parser, at,
                       "this pattern chooses from %d things, "
                       "not %d",
                       choices, map->count);
}

void build_pattern_close(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct patterned *on = build_patterned_of(frame);
    struct pattern *pattern = (struct pattern *)on->pattern;

    if (!(frame->given & FRAME_CHOSEN))
        return;
    if (pattern->kind == PATTERN_DENSITY_FILE)
        load_file(parser, frame, pattern);
    if (pattern->kind == PATTERN_MAGNET)
        parser_mistake(parser, at, "'magnet' needs 'mandel' or 'julia'");
    if (surface_choices(pattern->kind) > 0)
        complete_list(parser, frame, pattern, at);
    else if (pattern->kind == PATTERN_AVERAGE && !on->map)
        parser_mistake(parser, at, "'average' needs a map");
}

/* ---- values in statements with patterns -------------------------------- */

static void apply_function(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    const struct function *function = value->node;
    struct pattern *pattern = build_pattern_begin(parser, frame,
                                                  PATTERN_FUNCTION);

    if (!pattern)
        return;
    pattern->function = function;
    if (function->parameters != 3 || function->results != 1)
        parser_mistake(parser, at,
                       "a pattern's function takes x, y and z "
                       "and gives a float");
}

bool build_pattern_apply(struct parser *parser, struct frame *frame,
                         const struct value *value, struct location at)
{
    switch (value->kind) {
    case VALUE_FUNCTION:
        apply_function(parser, frame, value, at);
        return true;
    case VALUE_COLOR_MAP:
    case VALUE_PIGMENT_MAP:
    case VALUE_NORMAL_MAP:
    case VALUE_SLOPE_MAP:
    case VALUE_TEXTURE_MAP:
    case VALUE_DENSITY_MAP:
        build_patterned_of(frame)->map = value->node;
        frame->given &= ~(unsigned)FRAME_LIST;
        return true;
    default:
        return false;
    }
}
