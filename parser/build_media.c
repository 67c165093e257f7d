/* build_media.c - density, scattering, fire, media and interior. */
#include <string.h>

#include "parser/builder.h"

/* ---- density: of a medium, and the fields of a fire -------------------- */

static void open_density(struct parser *parser, struct frame *frame)
{
    struct density *density = frame->node;

    parser->builder->file.format = NULL;
    density->by = transform_identity();
    for (int i = 0; i < 3; i++)
        density->color[i] = 1;
}

static const struct param density_arguments[] = {
    PARAM_ROW("color", PARAM_RGB, 1, 0, INFINITY, 0, 0, struct density, color),
    {0}};

static void apply_density(struct parser *parser, struct frame *frame,
                          const struct value *value, struct location at)
{
    if (value->kind == VALUE_DENSITY)
        *(struct density *)frame->node = *(const struct density *)value->node;
    else
        build_misplaced(parser, frame, value, at);
}

/* ---- the file of a density --------------------------------------------- */

enum { FILE_NAMED, FILE_INTERPOLATE, FILE_FIT, FILE_UP };

static const struct param density_params[] = {
    PARAM_OWN("density_file", 0, 0, -1),
    PARAM_OWN("df3", 1, 1, FILE_NAMED),
    PARAM_OWN("vdb", 1, 2, FILE_NAMED),
    PARAM_OWN("interpolate", 1, 1, FILE_INTERPOLATE),
    PARAM_OWN("fit", 0, 0, FILE_FIT),
    PARAM_OWN("up", 1, 1, FILE_UP),
    {0}};

static enum vdb_role role_of(enum build_kind kind)
{
    if (kind == BUILD_TEMPERATURE)
        return VDB_TEMPERATURE;
    return kind == BUILD_AMOUNT ? VDB_FLAME : VDB_DENSITY;
}

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

static void density_values(struct parser *parser, struct frame *frame,
                           const struct param *row, const struct value *value,
                           int count, struct location at)
{
    struct data_file *file = &parser->builder->file;

    if (row->id == FILE_NAMED)
        name_file(parser, file, row, value, count);
    else if (row->id >= 0 && !file->format)
        parser_mistake(parser, at, "'%s' belongs behind the name of a file",
                       row->word);
    else if (row->id == FILE_INTERPOLATE)
        interpolate_file(parser, file, value, parser->builder->value_at);
    else if (row->id == FILE_UP)
        turn_file(parser, file, value, parser->builder->value_at);
    else if (row->id == FILE_FIT)
        file->fit = true;
    (void)frame;
}

/* All that belongs to the file is said: what follows is about the density. */
static void load_file(struct parser *parser, struct frame *frame)
{
    struct data_file *file = &parser->builder->file;

    if (file->format)
        load_density(parser, file, role_of(frame->kind), frame->node);
    file->format = NULL;
}

static void move_density(struct parser *parser, struct frame *frame,
                         const transform *by)
{
    struct density *density = frame->node;

    load_file(parser, frame);
    density->by = transform_then(&density->by, by);
}

static void close_density(struct parser *parser, struct frame *frame,
                          struct location at)
{
    (void)at;
    load_file(parser, frame);
}

const struct statement build_statement_density = {
    .word = "density",
    .makes = VALUE_DENSITY,
    .takes = BUILD_TAKES(VALUE_DENSITY),
    .size = sizeof(struct density),
    .params = density_params,
    .values = density_values,
    .arguments = density_arguments,
    .open = open_density,
    .apply = apply_density,
    .move = move_density,
    .close = close_density,
};

/* ---- fire -------------------------------------------------------------- */

static void close_temperature(struct parser *parser, struct frame *frame,
                              struct location at)
{
    struct fire *fire = build_around(parser)->node;

    close_density(parser, frame, at);
    fire->on = true;
    fire->temperature = *(const struct density *)frame->node;
}

static void close_amount(struct parser *parser, struct frame *frame,
                         struct location at)
{
    struct fire *fire = build_around(parser)->node;

    close_density(parser, frame, at);
    fire->has_amount = true;
    fire->amount = *(const struct density *)frame->node;
}

static const enum build_kind in_fire[] = {BUILD_FIRE, BUILD_KINDS};
static const enum build_kind in_media[] = {BUILD_MEDIA, BUILD_KINDS};

const struct statement build_statement_temperature = {
    .word = "temperature",
    .within = in_fire,
    .takes = BUILD_TAKES(VALUE_DENSITY),
    .size = sizeof(struct density),
    .params = density_params,
    .values = density_values,
    .arguments = density_arguments,
    .open = open_density,
    .apply = apply_density,
    .move = move_density,
    .close = close_temperature,
};

const struct statement build_statement_amount = {
    .word = "amount",
    .within = in_fire,
    .takes = BUILD_TAKES(VALUE_DENSITY),
    .size = sizeof(struct density),
    .params = density_params,
    .values = density_values,
    .arguments = density_arguments,
    .open = open_density,
    .apply = apply_density,
    .move = move_density,
    .close = close_amount,
};

static const char *const brightness_words[] = {
    [BRUME_BRIGHTNESS_PHYSICAL] = "physical",
    [BRUME_BRIGHTNESS_NORMALIZED] = "normalized",
    [BRUME_BRIGHTNESS_CONSTANT] = "constant",
    [BRUME_BRIGHTNESS_TOTAL] = "total",
    NULL};
static const char *const coupling_words[] = {"absorption", "additive", NULL};
static const char *const preset_words[] = {[FIRE_CYCLES] = "cycles",
                                           [FIRE_PBRT] = "pbrt",
                                           [FIRE_HOUDINI] = "houdini",
                                           NULL};

const struct param build_fire_params[] = {
    {.word = "kelvin",
     .kind = PARAM_PAIR,
     .start = {1000, 0, 0},
     .low = -INFINITY,
     .high = INFINITY,
     .alone = NAN,
     .offset = offsetof(struct fire, kelvin)},
    PARAM_ROW("intensity", PARAM_FLOAT, 1, 0, INFINITY, 0, 0, struct fire,
              intensity),
    PARAM_ROW("reference", PARAM_FLOAT, 2000, 500, INFINITY, 0, 0, struct fire,
              reference),
    PARAM_WORDS("brightness", brightness_words, 0, struct fire, brightness),
    PARAM_WORDS("coupling", coupling_words, 0, struct fire, additive),
    PARAM_WORDS("preset", preset_words, 0, struct fire, preset),
    {0}};

static void open_fire(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(build_fire_params, frame->node);
}

static void set_fire(struct parser *parser, struct frame *frame,
                     const struct param *row, struct location at)
{
    struct fire *fire = frame->node;

    (void)parser;
    (void)at;
    if (!strcmp(row->word, "preset"))
        model_fire_preset(fire, (enum fire_preset)fire->preset);
}

static void move_fire(struct parser *parser, struct frame *frame,
                      const transform *by)
{
    (void)parser;
    model_fire_transform(frame->node, by);
}

static void close_fire(struct parser *parser, struct frame *frame,
                       struct location at)
{
    struct media *media = build_around(parser)->node;
    const struct fire *fire = frame->node;

    if (!fire->on)
        parser_error(parser, at, "'fire' needs its 'temperature'");
    media->fire = *fire;
}

const struct statement build_statement_fire = {
    .word = "fire",
    .within = in_media,
    .size = sizeof(struct fire),
    .params = build_fire_params,
    .open = open_fire,
    .move = move_fire,
    .close = close_fire,
    .set = set_fire,
};

/* ---- scattering -------------------------------------------------------- */

struct scattering {
    int type;
    double color[3], eccentricity, extinction;
};

const struct param build_scattering_params[] = {
    PARAM_ROW("eccentricity", PARAM_FLOAT, 0, -1, 1, PARAM_ABOVE | PARAM_BELOW,
              0, struct scattering, eccentricity),
    PARAM_ROW("extinction", PARAM_FLOAT, 1, 0, INFINITY, 0, 0,
              struct scattering, extinction),
    {0}};

static const struct param scattering_arguments[] = {
    PARAM_ROW("type", PARAM_INTEGER, 1, 1, 5, 0, 0, struct scattering, type),
    PARAM_ROW("color", PARAM_RGB, 0, 0, INFINITY, 0, 0, struct scattering,
              color),
    {0}};

static void open_scattering(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(build_scattering_params, frame->node);
}

static void close_scattering(struct parser *parser, struct frame *frame,
                             struct location at)
{
    struct media *media = build_around(parser)->node;
    const struct scattering *said = frame->node;

    (void)at;
    media->type = said->type;
    memcpy(media->scattering, said->color, sizeof said->color);
    media->eccentricity = said->eccentricity;
    media->extinction = said->extinction;
}

const struct statement build_statement_scattering = {
    .word = "scattering",
    .within = in_media,
    .size = sizeof(struct scattering),
    .params = build_scattering_params,
    .arguments = scattering_arguments,
    .needed = 2,
    .open = open_scattering,
    .close = close_scattering,
};

/* ---- media ------------------------------------------------------------- */

static const char sampling_note[] = "Brume chooses its own sampling of media";

const struct param build_media_params[] = {
    PARAM_ROW("absorption", PARAM_RGB, 0, 0, INFINITY, 0, 0, struct media,
              absorption),
    PARAM_ROW("emission", PARAM_RGB, 0, 0, INFINITY, 0, 0, struct media,
              emission),
    PARAM_WITHOUT("intervals", sampling_note),
    PARAM_WITHOUT("samples", sampling_note),
    PARAM_WITHOUT("confidence", sampling_note),
    PARAM_WITHOUT("variance", sampling_note),
    PARAM_WITHOUT("ratio", sampling_note),
    PARAM_WITHOUT("method", sampling_note),
    PARAM_WITHOUT("aa_threshold", sampling_note),
    PARAM_WITHOUT("aa_level", sampling_note),
    PARAM_WITHOUT("jitter", sampling_note),
    {0}};

static void open_media(struct parser *parser, struct frame *frame)
{
    struct media *media = frame->node;

    (void)parser;
    media->type = BRUME_PHASE_ISOTROPIC;
    media->extinction = 1;
    for (int i = 0; i < 3; i++)
        media->tint[i] = 1;
    param_defaults(build_fire_params, &media->fire);
}

static void add_density(struct parser *parser, struct media *media,
                        const struct density *density, struct location at)
{
    for (int i = 0; i < 3; i++)
        media->tint[i] *= density->color[i];
    if (!density->has_grid)
        return;
    if (media->densities == BRUME_MAX_DENSITIES)
        parser_error(parser, at, "a media takes %d densities with files",
                     BRUME_MAX_DENSITIES);
    else
        media->density[media->densities++] = *density;
}

static void apply_media(struct parser *parser, struct frame *frame,
                        const struct value *value, struct location at)
{
    struct media *media = frame->node;

    if (value->kind == VALUE_MEDIA)
        *media = *(const struct media *)value->node;
    else if (value->kind == VALUE_DENSITY)
        add_density(parser, media, value->node, at);
    else
        build_misplaced(parser, frame, value, at);
}

static void move_media(struct parser *parser, struct frame *frame,
                       const transform *by)
{
    (void)parser;
    model_media_transform(frame->node, by);
}

const struct statement build_statement_media = {
    .word = "media",
    .makes = VALUE_MEDIA,
    .takes = BUILD_TAKES(VALUE_MEDIA) | BUILD_TAKES(VALUE_DENSITY),
    .size = sizeof(struct media),
    .params = build_media_params,
    .open = open_media,
    .apply = apply_media,
    .move = move_media,
};

/* ---- interior ---------------------------------------------------------- */

static void apply_interior(struct parser *parser, struct frame *frame,
                           const struct value *value, struct location at)
{
    struct interior *interior = frame->node;

    if (value->kind == VALUE_INTERIOR)
        *interior = *(const struct interior *)value->node;
    else if (value->kind != VALUE_MEDIA)
        build_misplaced(parser, frame, value, at);
    else if (interior->count == BRUME_MAX_INTERIOR_MEDIA)
        parser_error(parser, at, "an interior takes %d media",
                     BRUME_MAX_INTERIOR_MEDIA);
    else
        interior->media[interior->count++] = value->node;
}

const struct statement build_statement_interior = {
    .word = "interior",
    .makes = VALUE_INTERIOR,
    .takes = BUILD_TAKES(VALUE_INTERIOR) | BUILD_TAKES(VALUE_MEDIA),
    .size = sizeof(struct interior),
    .apply = apply_interior,
};
