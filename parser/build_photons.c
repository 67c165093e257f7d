/* volume_photons: how the integrator photon keeps scattered light. */
#include "parser/builder.h"
#include <math.h>
#include <stddef.h>

enum { PHOTONS_PRESET = 1, PHOTONS_TEMPORAL = 2 };

static const char *const gather_words[] = {"tally", "ball", NULL};
static const char *const single_words[] = {"ray", "field", NULL};
static const char *const emission_words[] = {"line", "photons", NULL};
static const char *const preset_words[] = {"paper", NULL};

#define NUMBER(word, kind, low, high, open)                                    \
    PARAM_ROW(#word, kind, 0, low, high, open, 0, struct volume_photons, word)

static const struct param photons_params[] = {
    NUMBER(count, PARAM_FLOAT, 1, 1e15, 0),
    PARAM_WORDS("preset", preset_words, PHOTONS_PRESET, struct volume_photons,
                preset),
    PARAM_WORDS("gather", gather_words, 0, struct volume_photons, gather),
    PARAM_WORDS("single", single_words, 0, struct volume_photons, single),
    PARAM_WORDS("emission", emission_words, 0, struct volume_photons, emission),
    NUMBER(radius, PARAM_FLOAT, 0, INFINITY, PARAM_ABOVE),
    NUMBER(field_spacing, PARAM_FLOAT, 0, INFINITY, PARAM_ABOVE),
    NUMBER(field_depth, PARAM_FLOAT, 0, INFINITY, 0),
    PARAM_ROW("temporal", PARAM_INTEGER, 0, 1, BRUME_MAX_TAPS, 0,
              PHOTONS_TEMPORAL, struct volume_photons, temporal),
    PARAM_ANY("frustum", PARAM_SWITCH, 1, 0, struct volume_photons, frustum),
    PARAM_ANY("far_plane", PARAM_SWITCH, 0, 0, struct volume_photons,
              far_plane),
    {0}};

static void open_photons(struct parser *parser, struct frame *frame)
{
    struct globals *globals = &parser->builder->globals;

    globals->has_volume_photons = true;
    param_defaults(photons_params, &globals->volume_photons);
    frame->node = &globals->volume_photons;
}

/* What is written after a preset still counts. */
static void set_photons(struct parser *parser, struct frame *frame,
                        const struct param *row, struct location at)
{
    struct brume_photon_options published = BRUME_PHOTONS_INIT;
    struct volume_photons *to = frame->node;

    if (row->given == PHOTONS_TEMPORAL) {
        to->weights = to->adaptive = 0;
        if (!brume_film_taps(&published, to->temporal))
            parser_mistake(parser, at,
                           "weights of 1, 3 and 5 frames are known; others "
                           "are written out: temporal { ... }");
    }
    if (row->given != PHOTONS_PRESET)
        return;
    brume_photons_paper(&published);
    to->gather = (int)published.gather;
    to->single = (int)published.single;
    to->emission = (int)published.emission;
    to->far_plane = published.far_plane;
}

static const enum build_kind in_globals[] = {BUILD_GLOBAL_SETTINGS,
                                             BUILD_KINDS};

const struct statement build_statement_volume_photons = {
    .word = "volume_photons",
    .within = in_globals,
    .params = photons_params,
    .open = open_photons,
    .set = set_photons,
};

/* ---- weights ------------------------------------------------------------ */

enum { TEMPORAL_REACH = 1 };

static const struct param temporal_params[] = {
    PARAM_WORD("adaptive", PARAM_MARK, 1, 0, struct volume_photons, adaptive),
    PARAM_ROW("reach", PARAM_INTEGER, BRUME_ADAPTIVE_REACH, 1, BRUME_MAX_REACH,
              0, TEMPORAL_REACH, struct volume_photons, reach),
    {0}};

static void open_temporal(struct parser *parser, struct frame *frame)
{
    struct volume_photons *to = &parser->builder->globals.volume_photons;

    to->weights = 0;
    param_defaults(temporal_params, to);
    frame->node = to;
}

static void take_weight(struct parser *parser, struct frame *frame,
                        const struct value *number, struct location at)
{
    struct volume_photons *to = frame->node;

    if (number->kind != VALUE_NUMBER || number->terms != 1 ||
        !(number->v[0] >= 0) || !(number->v[0] <= 1e6))
        parser_mistake(parser, at, "a weight is a number from 0 to 1e6");
    else if (to->weights == BRUME_MAX_TAPS)
        parser_mistake(parser, at, "there are more than %d weights",
                       BRUME_MAX_TAPS);
    else
        to->weight[to->weights++] = number->v[0];
}

/* Where a film ends the frame's own weight may be all that is left. */
static void close_temporal(struct parser *parser, struct frame *frame,
                           struct location at)
{
    struct volume_photons *to = frame->node;

    if (to->adaptive && to->weights > 0)
        parser_mistake(parser, at,
                       "there are weights, and 'adaptive', which finds them");
    else if (frame->given & TEMPORAL_REACH && !to->adaptive)
        parser_mistake(parser, at, "'reach' is for 'adaptive'");
    else if (to->adaptive)
        return;
    else if (to->weights % 2 == 0)
        parser_mistake(parser, at,
                       "weights are of an odd number of frames, the middle "
                       "one the frame's own; there are %d",
                       to->weights);
    else if (!(to->weight[to->weights / 2] > 0))
        parser_mistake(parser, at, "the frame's own weight is 0");
    to->temporal = to->weights;
}

static const enum build_kind in_photons[] = {BUILD_VOLUME_PHOTONS, BUILD_KINDS};

const struct statement build_statement_temporal = {
    .word = "temporal",
    .within = in_photons,
    .params = temporal_params,
    .open = open_temporal,
    .argument = take_weight,
    .close = close_temporal,
};

static void set_taps(const struct volume_photons *said,
                     struct brume_photon_options *to)
{
    if (said->adaptive) {
        to->taps = 2 * said->reach + 1;
        to->adaptive = true;
        return;
    }
    if (said->weights == 0) {
        brume_film_taps(to, said->temporal);
        return;
    }
    to->taps = said->weights;
    for (int i = 0; i < to->taps; i++)
        to->weight[i] = said->weight[i];
}

void build_photons_finish(struct parser *parser)
{
    const struct globals *globals = &parser->builder->globals;
    const struct volume_photons *said = &globals->volume_photons;
    struct brume_photon_options *to = &parser->out->photons;

    if (!globals->has_volume_photons)
        return;
    to->count = (uint64_t)said->count;
    to->gather = (enum brume_gather)said->gather;
    to->single = (enum brume_single)said->single;
    to->emission = (enum brume_emission)said->emission;
    to->radius = said->radius;
    to->spacing = said->field_spacing;
    to->depth = said->field_depth;
    to->everywhere = !said->frustum;
    to->far_plane = said->far_plane;
    set_taps(said, to);
}
