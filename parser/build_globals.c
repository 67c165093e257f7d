/* build_globals.c - global_settings, and what the end of a scene sets. */
#include <string.h>

#include "parser/builder.h"

enum { GLOBAL_INTEGRATOR = 1, GLOBAL_GAMMA = 2, GLOBAL_CHARSET = 4 };
enum { TRANSPORT_MEDIA = 1, TRANSPORT_SURFACES = 2, TRANSPORT_ENVIRONMENT = 4 };

static const char *const unit_words[] = {"pov", "physical", NULL};
static const char *const integrator_words[] = {"path", "photon", "progressive",
                                               NULL};

enum { CHARSET_ASCII, CHARSET_UTF8, CHARSET_SYS };
static const char *const charset_words[] = {"ascii", "utf8", "sys", NULL};
static const char picture_note[] = "Brume has no pictures of that kind";
static const char depth_note[] = "paths end by chance, so that no light is "
                                 "lost at a depth";

#define GLOBAL(word, kind, start, low, high, open, given)                      \
    PARAM_ROW(#word, kind, start, low, high, open, given, struct globals, word)

/* Checked, and without effect. */
#define GLOBAL_NOTED(word_, kind_, low_, high_, note_)                         \
    {                                                                          \
        .word = #word_, .kind = kind_, .low = low_, .high = high_,             \
        .offset = offsetof(struct globals, word_), .alone = NAN, .note = note_ \
    }

const struct param build_globals_params[] = {
    GLOBAL(ambient_light, PARAM_RGB, 1, -INFINITY, INFINITY, 0, 0),
    /* A number, or the word srgb: about 2.2. */
    {.word = "assumed_gamma",
     .kind = PARAM_FLOAT,
     .start = {1},
     .high = INFINITY,
     .open = PARAM_ABOVE,
     .given = GLOBAL_GAMMA,
     .alone = 2.2,
     .offset = offsetof(struct globals, assumed_gamma)},
    {.word = "srgb", .kind = PARAM_IGNORED},
    PARAM_WORDS("charset", charset_words, GLOBAL_CHARSET, struct globals,
                charset),
    PARAM_WITHOUT("hf_gray_16", picture_note),
    GLOBAL_NOTED(max_trace_level, PARAM_INTEGER, 1, 256, depth_note),
    GLOBAL_NOTED(adc_bailout, PARAM_FLOAT, 0, INFINITY, depth_note),
    GLOBAL(accuracy, PARAM_FLOAT, 0, 0, INFINITY, PARAM_ABOVE, 0),
    GLOBAL(time_limit, PARAM_FLOAT, 0, 0, INFINITY, PARAM_ABOVE, 0),
    PARAM_WITHOUT("max_intersections", "Brume has no such bound"),
    GLOBAL(number_of_waves, PARAM_INTEGER, 10, 1, 100, 0, 0),
    GLOBAL(noise_generator, PARAM_INTEGER, 2, 1, 3, 0, 0),
    GLOBAL(irid_wavelength, PARAM_RGB, 0.25, 0, INFINITY, 0, 0),
    GLOBAL(mm_per_unit, PARAM_FLOAT, 10, 0, INFINITY, PARAM_ABOVE, 0),
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
        parser->out->has_integrator = true;
        parser->out->integrator = (enum brume_integrator)globals->integrator;
    }
    if (row->given == GLOBAL_CHARSET && globals->charset == CHARSET_SYS)
        parser_warn(parser, at, "charset sys is taken as utf8");
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

/* ---- what POV-Ray finds indirect light with ---------------------------- */

#define PHOTONS(word, kind, start)                                             \
    PARAM_ANY(#word, kind, start, 0, struct photons, word)

static const struct param photons_params[] = {
    PHOTONS(spacing, PARAM_FLOAT, 0),
    PHOTONS(count, PARAM_FLOAT, 0),
    PHOTONS(gather, PARAM_PAIR, 0),
    PHOTONS(media, PARAM_PAIR, 0),
    PHOTONS(jitter, PARAM_FLOAT, 0.4),
    PHOTONS(autostop, PARAM_FLOAT, 0),
    PHOTONS(expand_thresholds, PARAM_PAIR, 0),
    PHOTONS(radius, PARAM_PAIR, 0),
    PHOTONS(max_trace_level, PARAM_FLOAT, 0),
    PHOTONS(adc_bailout, PARAM_FLOAT, 0),
    PARAM_OWN("save_file", 1, 1, 0),
    PARAM_OWN("load_file", 1, 1, 0),
    {0}};

static void open_photons(struct parser *parser, struct frame *frame)
{
    struct globals *globals = &parser->builder->globals;

    globals->has_photons = true;
    frame->node = &globals->photons;
}

static void photon_file(struct parser *parser, struct frame *frame,
                        const struct param *row, const struct value *value,
                        int count, struct location at)
{
    (void)frame;
    (void)count;
    if (value->kind != VALUE_STRING)
        parser_mistake(parser, at, "'%s' needs the name of a file", row->word);
}

const struct statement build_statement_photons = {
    .word = "photons",
    .within = in_globals,
    .params = photons_params,
    .open = open_photons,
    .values = photon_file,
};

#define RADIOSITY(word, kind, start)                                           \
    PARAM_ANY(#word, kind, start, 0, struct radiosity, word)
#define RADIOSITY_SWITCH(word, start)                                          \
    PARAM_ROW(#word, PARAM_SWITCH, start, 0, 1, 0, 0, struct radiosity, word)

static const struct param radiosity_params[] = {
    RADIOSITY(adc_bailout, PARAM_FLOAT, 0.01),
    RADIOSITY_SWITCH(always_sample, 1),
    RADIOSITY(brightness, PARAM_FLOAT, 1),
    RADIOSITY(count, PARAM_PAIR, 35),
    RADIOSITY(error_bound, PARAM_FLOAT, 1.8),
    RADIOSITY(gray_threshold, PARAM_FLOAT, 0),
    RADIOSITY(importance, PARAM_FLOAT, 1),
    RADIOSITY(low_error_factor, PARAM_FLOAT, 0.5),
    RADIOSITY(max_sample, PARAM_FLOAT, -1),
    RADIOSITY(maximum_reuse, PARAM_FLOAT, 0.2),
    RADIOSITY_SWITCH(media, 0),
    RADIOSITY(minimum_reuse, PARAM_FLOAT, 0.015),
    RADIOSITY(nearest_count, PARAM_PAIR, 5),
    RADIOSITY_SWITCH(normal, 0),
    RADIOSITY(pretrace_end, PARAM_FLOAT, 0.04),
    RADIOSITY(pretrace_start, PARAM_FLOAT, 0.08),
    RADIOSITY(recursion_limit, PARAM_FLOAT, 2),
    RADIOSITY_SWITCH(subsurface, 0),
    PARAM_OWN("save_file", 1, 1, 0),
    PARAM_OWN("load_file", 1, 1, 0),
    {0}};

static void open_radiosity(struct parser *parser, struct frame *frame)
{
    struct globals *globals = &parser->builder->globals;

    param_defaults(radiosity_params, &globals->radiosity);
    globals->has_radiosity = true;
    frame->node = &globals->radiosity;
}

const struct statement build_statement_radiosity = {
    .word = "radiosity",
    .within = in_globals,
    .params = radiosity_params,
    .open = open_radiosity,
    .values = photon_file,
};

static const struct param subsurface_params[] = {
    PARAM_ANY("samples", PARAM_PAIR, 50, 0, struct subsurface, samples),
    PARAM_ANY("radiosity", PARAM_SWITCH, 0, 0, struct subsurface, radiosity),
    {0}};

static void open_subsurface(struct parser *parser, struct frame *frame)
{
    frame->node = &parser->builder->globals.subsurface;
}

const struct statement build_statement_global_subsurface = {
    .word = "subsurface",
    .within = in_globals,
    .params = subsurface_params,
    .open = open_subsurface,
};

/* `light_units physical` and --transport full ask for all transport; what is
 * written out wins. */
static bool transported(const struct globals *globals, unsigned bit, int said,
                        bool full)
{
    return globals->transport_given & bit ? said != 0 : full;
}

static bool is_full(const struct parser *parser)
{
    return parser->builder->globals.light_units == 1 ||
           parser->builder->globals.has_volume_photons ||
           parser->in->full_transport;
}

static bool is_indirect(const struct parser *parser)
{
    const struct globals *globals = &parser->builder->globals;

    return transported(globals, TRANSPORT_SURFACES, globals->transport.surfaces,
                       is_full(parser));
}

static void globals_lacks(struct parser *parser)
{
    const struct globals *globals = &parser->builder->globals;
    const struct location here = {0, UINT32_MAX};

    if (globals->has_photons)
        build_lacks(parser, "POV-Ray's photons", here);
    if (globals->has_radiosity)
        build_lacks(parser, "radiosity", here);
    else if (parser->builder->no_radiosity && is_indirect(parser))
        build_lacks(parser, "no_radiosity", here);
}

/* ---- the end of the scene ---------------------------------------------- */

static bool finish_globals(struct parser *parser, struct brume_error *err)
{
    const struct globals *globals = &parser->builder->globals;
    const struct transport *said = &globals->transport;
    struct brume_globals to = BRUME_GLOBALS_INIT;
    bool full = is_full(parser);

    memcpy(to.background, globals->background, sizeof to.background);
    memcpy(to.ambient_light, globals->ambient_light, sizeof to.ambient_light);
    to.media_multiple = transported(globals, TRANSPORT_MEDIA, said->media,
                                    full);
    to.surfaces_indirect = is_indirect(parser);
    to.environment = transported(globals, TRANSPORT_ENVIRONMENT,
                                 said->environment, full);
    to.physical_units = globals->light_units == 1;
    build_photons_finish(parser);
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
    camera = parser->builder->camera;
    if (!camera)
        camera = &model_default_camera;
    globals_lacks(parser);
    build_camera_lacks(parser, camera);
    if (!build_finish_sky(parser, &err))
        return parser_relay(parser, camera->at, &err);
    if (!build_finish_plate(parser))
        return false;
    build_report_lacks(parser);

    if (finish_globals(parser, &err) && finish_camera(parser, &err))
        return true;
    return parser_relay(parser, camera->at, &err);
}
