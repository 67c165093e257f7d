/* build_media.c - scattering, fire, media and interior. */
#include <string.h>

#include "parser/builder.h"

/* ---- fire -------------------------------------------------------------- */

static const enum build_kind in_media[] = {BUILD_MEDIA, BUILD_KINDS};

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
    media->velocity.by = transform_identity();
}

static void add_density(struct parser *parser, struct media *media,
                        const struct density *density, struct location at)
{
    bool grid = model_density_is_grid(density);

    for (int i = 0; i < 3 && !model_density_is_patterned(density); i++)
        media->tint[i] *= density->color[i];
    if (!grid && !model_density_is_patterned(density))
        return;
    if (media->densities == BRUME_MAX_DENSITIES)
        parser_error(parser, at, "a media takes %d densities with patterns",
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

#define INTERIOR(word, kind, start, low, high)                                 \
    PARAM_ROW(#word, kind, start, low, high, 0, 0, struct interior, word)

const struct param build_interior_params[] = {
    INTERIOR(ior, PARAM_FLOAT, 1, 0, INFINITY),
    INTERIOR(caustics, PARAM_FLOAT, 0, 0, INFINITY),
    INTERIOR(dispersion, PARAM_FLOAT, 1, 0, INFINITY),
    INTERIOR(dispersion_samples, PARAM_INTEGER, 7, 2, 1000),
    INTERIOR(fade_distance, PARAM_FLOAT, 0, 0, INFINITY),
    INTERIOR(fade_power, PARAM_FLOAT, 0, 0, INFINITY),
    INTERIOR(fade_color, PARAM_RGB, 0, -INFINITY, INFINITY),
    PARAM_ROW("fade_colour", PARAM_RGB, 0, -INFINITY, INFINITY, 0, 0,
              struct interior, fade_color),
    PARAM_WITHOUT("refraction", "'ior' alone bends light"),
    {0}};

static void open_interior(struct parser *parser, struct frame *frame)
{
    (void)parser;
    param_defaults(build_interior_params, frame->node);
}

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
    .params = build_interior_params,
    .open = open_interior,
    .apply = apply_interior,
};
