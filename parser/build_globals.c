/* build_globals.c - global_settings, and what the end of a scene sets. */
#include <string.h>

#include "parser/builder.h"

enum { GLOBAL_INTEGRATOR = 1, GLOBAL_GAMMA = 2 };
enum { TRANSPORT_MEDIA = 1, TRANSPORT_SURFACES = 2, TRANSPORT_ENVIRONMENT = 4 };

static const char *const unit_words[] = {"pov", "physical", NULL};
static const char *const integrator_words[] = {"path", "photon", "progressive",
                                               NULL};

static const char finish_note[] = "there are no finishes that it is for yet";

#define GLOBAL(word, kind, start, low, high, open, given)                      \
    PARAM_ROW(#word, kind, start, low, high, open, given, struct globals, word)

const struct param build_globals_params[] = {
    GLOBAL(ambient_light, PARAM_RGB, 1, -INFINITY, INFINITY, 0, 0),
    GLOBAL(assumed_gamma, PARAM_FLOAT, 1, 0, INFINITY, PARAM_ABOVE,
           GLOBAL_GAMMA),
    GLOBAL(max_trace_level, PARAM_INTEGER, 5, 1, 256, 0, 0),
    GLOBAL(adc_bailout, PARAM_FLOAT, 1.0 / 255, 0, INFINITY, 0, 0),
    GLOBAL(accuracy, PARAM_FLOAT, 0, 0, INFINITY, PARAM_ABOVE, 0),
    GLOBAL(time_limit, PARAM_FLOAT, 0, 0, INFINITY, PARAM_ABOVE, 0),
    PARAM_WITHOUT("max_intersections", "Brume has no such bound"),
    GLOBAL(number_of_waves, PARAM_INTEGER, 10, 1, 100, 0, 0),
    GLOBAL(noise_generator, PARAM_INTEGER, 2, 1, 3, 0, 0),
    PARAM_WITHOUT("irid_wavelength", finish_note),
    PARAM_WITHOUT("mm_per_unit", finish_note),
    PARAM_WORDS("integrator", integrator_words, GLOBAL_INTEGRATOR,
                struct globals, integrator),
    PARAM_WORDS("light_units", unit_words, 0, struct globals, light_units),
    {0}};

static const char *const media_words[] = {"single", "multiple", NULL};
static const char *const surfaces_words[] = {"direct", "indirect", NULL};

const struct param build_transport_params[] = {
    PARAM_WORDS("media", media_words, TRANSPORT_MEDIA, struct transport, media),
    PARAM_WORDS("surfaces", surfaces_words, TRANSPORT_SURFACES,
                struct transport, surfaces),
    PARAM_ANY("environment", PARAM_SWITCH, 0, TRANSPORT_ENVIRONMENT,
              struct transport, environment),
    {0}};

void build_globals_start(struct globals *globals)
{
    param_defaults(build_globals_params, globals);
}

/* ---- the statements ---------------------------------------------------- */

static void open_globals(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->globals;
}

static void set_globals(struct parser *parser, struct frame *frame,
                        const struct param *row, struct location at)
{
    const struct globals *globals = frame->node;

    if (row->given == GLOBAL_INTEGRATOR) {
        if (globals->integrator != 0)
            parser_error(parser, at, "integrator '%s' is not supported yet",
                         integrator_words[globals->integrator]);
        parser->out->has_integrator = true;
        parser->out->integrator = BRUME_INTEGRATOR_PATH;
    }
    if (row->given == GLOBAL_GAMMA) {
        parser->out->assumed_gamma = globals->assumed_gamma;
        if (globals->assumed_gamma != 1)
            parser_warn(parser, at,
                        "assumed_gamma %g is taken as 1: Brume "
                        "computes with linear light",
                        globals->assumed_gamma);
    }
}

const struct statement build_statement_global_settings = {
    .word = "global_settings",
    .params = build_globals_params,
    .open = open_globals,
    .set = set_globals,
};

static void open_transport(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->globals.transport;
}

static void close_transport(struct parser *parser, struct frame *frame,
                            struct location at)
{
    (void)at;
    parser->builder->globals.transport_given |= frame->given;
}

static const enum build_kind in_globals[] = {BUILD_GLOBAL_SETTINGS,
                                             BUILD_KINDS};

const struct statement build_statement_transport = {
    .word = "transport",
    .within = in_globals,
    .params = build_transport_params,
    .open = open_transport,
    .close = close_transport,
};

/* ---- the end of the scene ---------------------------------------------- */

/* `light_units physical` and --transport full ask for all transport; what is
 * written out wins. */
static bool transported(const struct globals *globals, unsigned bit, int said,
                        bool full)
{
    return globals->transport_given & bit ? said != 0 : full;
}

static bool finish_globals(struct parser *parser, struct brume_error *err)
{
    const struct globals *globals = &parser->builder->globals;
    const struct transport *said = &globals->transport;
    struct brume_globals to = BRUME_GLOBALS_INIT;
    bool full = globals->light_units == 1 || parser->in->full_transport;

    memcpy(to.background, globals->background, sizeof to.background);
    memcpy(to.ambient_light, globals->ambient_light, sizeof to.ambient_light);
    to.media_multiple = transported(globals, TRANSPORT_MEDIA, said->media,
                                    full);
    to.surfaces_indirect = transported(globals, TRANSPORT_SURFACES,
                                       said->surfaces, full);
    to.environment = transported(globals, TRANSPORT_ENVIRONMENT,
                                 said->environment, full);
    to.physical_units = globals->light_units == 1;
    parser->out->accuracy = globals->accuracy;
    parser->out->time_limit = globals->time_limit;
    return brume_set_globals(parser->out->scene, &to, err);
}

static bool finish_camera(struct parser *parser, struct brume_error *err)
{
    const struct camera *camera = parser->builder->camera;
    struct brume_camera to;

    model_camera(camera ? camera : &model_default_camera, &to);
    return brume_set_camera(parser->out->scene, &to, err);
}

bool build_finish(struct parser *parser)
{
    const struct camera *camera;
    struct brume_error err = {0};

    if (parser->failed || !build_place_atmosphere(parser))
        return false;
    build_report_lacks(parser);
    camera = parser->builder->camera;
    if (!camera)
        camera = &model_default_camera;

    if (finish_globals(parser, &err) && finish_camera(parser, &err))
        return true;
    return parser_relay(parser, camera->at, &err);
}
