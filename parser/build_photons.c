/* volume_photons: how the integrator photon keeps scattered light. */
#include "parser/builder.h"
#include <math.h>
#include <stddef.h>

enum { PHOTONS_PRESET = 1 };

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
    PARAM_ANY("frustum", PARAM_SWITCH, 1, 0, struct volume_photons, frustum),
    {0}};

static void open_photons(struct parser *parser, struct frame *frame)
{
    struct globals *globals = &parser->builder->globals;

    globals->has_volume_photons = true;
    param_defaults(photons_params, &globals->volume_photons);
    frame->node = &globals->volume_photons;
}

/* What is written after it still counts. */
static void set_photons(struct parser *parser, struct frame *frame,
                        const struct param *row, struct location at)
{
    struct volume_photons *to = frame->node;

    (void)parser;
    (void)at;
    if (row->given != PHOTONS_PRESET)
        return;
    to->gather = BRUME_GATHER_BALL;
    to->single = BRUME_SINGLE_FIELD;
    to->emission = BRUME_EMISSION_PHOTONS;
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
    to->everywhere = !said->frustum;
}
