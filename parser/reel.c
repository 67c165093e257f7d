#include "parser/reel_parts.h"
#include "lib/output.h"
#include "lib/timer.h"
#include "parser/input.h"
#include "parser/naming.h"
#include <string.h>

/* ---- telling ----------------------------------------------------------- */

static bool checks(enum options_action action)
{
    return action == OPTIONS_CHECK || action == OPTIONS_CHECK_JSON;
}

static void report(const struct reel *reel, const struct diag *diag)
{
    if (diag->first || diag->errors || diag->warnings)
        reel->events->report(reel->events->user, diag);
}

static void report_item(const struct reel *reel, const struct diag_item *item)
{
    struct diag diag;
    diag_init(&diag);
    diag_add(&diag, item);
    report(reel, &diag);
    diag_release(&diag);
}

enum brume_code reel_fail(const struct reel *reel,
                          const struct brume_error *err)
{
    if (err->code == BRUME_STOPPED)
        return err->code;
    report_item(reel, &(struct diag_item){
                          .severity = DIAG_ERROR,
                          .code = err->code,
                          .text = err->text,
                          .file = err->line ? err->file : NULL,
                          .line = err->line,
                          .column = err->column,
                      });
    return err->code;
}

void reel_warn(void *user, const char *text)
{
    report_item(user, &(struct diag_item){
                          .severity = DIAG_WARNING,
                          .text = text,
                      });
}

static bool on_progress(void *user, const struct brume_progress *progress)
{
    const struct reel_events *events = ((struct reel *)user)->events;
    events->progress(events->user, progress);
    return !events->stopped(events->user);
}

/* ---- before the first frame -------------------------------------------- */

/* `list` with one text more. */
static const char *const *with_one(struct arena *arena,
                                   const struct options_list *list,
                                   const char *one, size_t *count)
{
    const char **items = arena_array(arena, list->count + 1, sizeof *items);
    if (!items)
        return NULL;
    for (size_t i = 0; i < list->count; i++)
        items[i] = list->item[i];
    items[list->count] = one;
    *count = list->count + (one ? 1 : 0);
    return items;
}

static bool find_folders(struct reel *reel, struct brume_error *err)
{
    const struct options *options = reel->options;
    struct arena *arena = &reel->arena;
    const char *out = naming_folder(options, arena);
    reel->library = with_one(arena, &options->library, input_own_folder(arena),
                             &reel->libraries);
    reel->allow_write = with_one(arena, &options->allow_write, out,
                                 &reel->allow_writes);
    if (!out || !reel->library || !reel->allow_write)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    return true;
}

static bool find_scene(struct reel *reel, struct brume_error *err)
{
    if (!reel->options->input)
        return brume_fail(err, BRUME_ERR_USAGE, "no scene is given");
    reel->path = reel->options->input;
    if (strcmp(reel->path, "-") == 0)
        return input_read(reel->events->in, "standard input", SIZE_MAX / 4,
                          &reel->arena, &reel->text, &reel->length, err);
    return (reel->path = input_find(reel->options, err));
}

static void warn_of_extension(struct reel *reel)
{
    char text[512];
    const char *extension = naming_foreign(reel->options);
    if (!extension)
        return;
    snprintf(text, sizeof text,
             "%s pictures are not supported yet: the file "
             "will be '%s.png'",
             extension, reel->options->output);
    reel_warn(reel, text);
}

static bool choose_part(struct reel *reel, struct brume_error *err)
{
    struct shard *shard = &reel->options->shard;
    if (shard->slurm && !shard_ask_slurm(shard, err))
        return false;
    if (shard->slurm || shard->count > 0)
        frames_shard(&reel->frames, shard);
    return true;
}

/* Films have one, and pictures that shall be left out if they are finished. */
static bool open_manifest(struct reel *reel, struct brume_error *err)
{
    struct options *o = reel->options;
    bool wanted = o->action == OPTIONS_RENDER && o->to_file &&
                  (reel->frames.animation || o->resume);
    if (!wanted || naming_is_stream(o))
        return true;
    const char *path = naming_beside(o, ".frames.jsonl", &reel->arena);
    if (!path)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    reel->manifest = manifest_open(path, o->resume, err);
    return reel->manifest;
}

/* Pictures that go to files are kept while they are not finished. */
static bool open_partials(struct reel *reel, struct brume_error *err)
{
    struct options *o = reel->options;
    if (o->action != OPTIONS_RENDER || !o->to_file || naming_is_stream(o))
        return true;
    const char *path = naming_beside(o, "", &reel->arena);
    if (!path)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    output_sweep(path);
    reel->partials = partial_new(err);
    return reel->partials;
}

static bool begin(struct reel *reel, struct brume_error *err)
{
    frames_init(&reel->frames, reel->options);
    if (!choose_part(reel, err) ||
        !frames_region(reel->options, reel->region, err) ||
        !find_scene(reel, err) || !find_folders(reel, err) ||
        !open_manifest(reel, err) || !open_partials(reel, err))
        return false;
    warn_of_extension(reel);
    if (reel->options->tree != BRUME_TREE_BOTH && !reel->frames.animation)
        return true;
    reel->still = brume_still_new(err);
    reel->cache = parse_cache_new(err);
    return reel->still && reel->cache;
}

/* ---- one frame --------------------------------------------------------- */

static bool read_scene(struct reel *reel, int number,
                       struct parse_result *result, struct reel_record *record,
                       struct parse_origins *origins, struct diag *diag)
{
    const struct options *options = reel->options;
    const struct reel_events *events = reel->events;
    struct parse_input in = {
        .path = reel->path,
        .text = reel->text,
        .length = reel->length,
        .header = options->header,
        .version = options->version,
        .full_transport = options->full_transport,
        .plate = {.layer = options->plate_layer,
                  .depth = (enum parse_depth)options->plate_depth},
        .all_errors = checks(options->action),
        .dry = checks(options->action),
        .library = reel->library,
        .libraries = reel->libraries,
        .allow_read = options->allow_read.item,
        .allow_reads = options->allow_read.count,
        .allow_write = reel->allow_write,
        .allow_writes = reel->allow_writes,
        .written = &reel->written,
        .cache = reel->cache,
        .origins = reel->manifest || reel->partials ? origins : NULL,
        .declare = options->declare,
        .declares = options->declares,
        .limits = {.include_depth = options->include_depth,
                   .macro_depth = options->macro_depth,
                   .iterations = options->iterations,
                   .tokens = options->tokens,
                   .memory = options->memory,
                   .seconds = options->parse_seconds},
        .message = events->message,
        .stopped = events->stopped,
        .user = events->user,
    };
    frames_ambient(&reel->frames, options, number, &in.ambient);
    if (options->plate && !(in.plate.path = naming_numbered(
                                options->plate, number, &reel->arena)))
        return diag_error(diag, BRUME_ERR_MEMORY, "out of memory");
    record->number = number;
    record->clock = in.ambient.clock;
    record->clock_on = in.ambient.clock_on;
    double start = timer_seconds();
    bool ok = parse_scene(&in, result, diag);
    record->seconds_parse = timer_seconds() - start;
    record->parsed = result->counts;
    return ok;
}

/* A film's fields are filtered unless that is turned off; stills have none
 * besides their own. */
static void choose_filter(const struct reel *reel,
                          struct brume_photon_options *p)
{
    const struct options *o = reel->options;
    if (o->taps > 0) {
        p->taps = o->taps;
        p->adaptive = o->adaptive;
        memcpy(p->weight, o->weight, sizeof o->weight);
    }
    if (!reel->frames.animation) {
        p->taps = 1;
    } else if (p->taps == 0 && p->gather == BRUME_GATHER_TALLY) {
        p->taps = 2 * BRUME_ADAPTIVE_REACH + 1;
        p->adaptive = true;
    }
}

struct brume_options reel_options(struct reel *reel, int number,
                                  const struct parse_result *scene)
{
    const struct options *o = reel->options;
    bool chosen = o->spp || o->error > 0 || o->seconds > 0;
    struct brume_options r = BRUME_OPTIONS_INIT;
    r.width = o->width;
    r.height = o->height;
    r.x0 = reel->region[0];
    r.y0 = reel->region[1];
    r.x1 = reel->region[2];
    r.y1 = reel->region[3];
    if (o->has_integrator)
        r.integrator = o->integrator;
    else if (scene->has_integrator)
        r.integrator = scene->integrator;
    r.backend = o->backend;
    r.spp = o->spp;
    r.error = chosen ? o->error : scene->accuracy;
    r.seconds = chosen ? o->seconds : scene->time_limit;
    r.tree = o->tree;
    r.tree_stack = o->tree_stack;
    r.tree_on_cpu = o->tree_on_cpu != 0;
    r.still = reel->still;
    r.threads = o->threads;
    r.seed = o->seed;
    r.frame = (uint32_t)number;
    r.memory = o->memory;
    r.photons = scene->photons;
    if (o->photons > 0)
        r.photons.count = o->photons;
    if (o->field_spacing > 0)
        r.photons.spacing = o->field_spacing;
    if (o->field_depth > 0)
        r.photons.depth = o->field_depth;
    if (o->preset)
        brume_photons_paper(&r.photons);
    choose_filter(reel, &r.photons);
    r.progress = on_progress;
    r.warn = reel_warn;
    r.user = reel;
    r.omit_background = o->alpha;
    r.keeper = partial_keeper(reel->partials);
    return r;
}

static bool explain(struct reel *reel, const struct parse_result *scene,
                    int number, struct brume_error *err)
{
    struct brume_options options = reel_options(reel, number, scene);
    struct brume_plan plan = {0};
    if (!brume_plan_frame(scene->scene, &options, &plan, err))
        return false;
    reel->events->planned(reel->events->user, &plan);
    return true;
}

static bool name_files(struct reel *reel, struct measure *m,
                       struct brume_error *err)
{
    struct options *o = reel->options;
    if (!o->to_file)
        return true;
    m->csv_path = naming_beside(o, ".csv", &reel->arena);
    m->svg_path = naming_beside(o, ".svg", &reel->arena);
    m->picture_path = naming_beside(o, "-reference.exr", &reel->arena);
    if (!m->csv_path || !m->svg_path || !m->picture_path)
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    return true;
}

static bool measure(struct reel *reel, const struct parse_result *scene,
                    int number, struct brume_error *err)
{
    const struct options *o = reel->options;
    const char *slash = strrchr(o->input, '/');
    struct measure m = {
        .scene = slash ? slash + 1 : o->input,
        .options = reel_options(reel, number, scene),
        .only = o->has_integrator ? (int)o->integrator : -1,
        .budget = o->budget > 0 ? o->budget : MEASURE_BUDGET,
        .reference = o->reference,
    };
    m.options.error = m.options.seconds = 0;
    m.options.omit_background = false;
    if (!name_files(reel, &m, err) || !measure_run(&m, scene->scene, err))
        return false;
    reel->events->measured(reel->events->user, &m);
    return true;
}

static enum brume_code measure_temporal(struct reel *reel)
{
    struct brume_error err = {0};
    const struct options *o = reel->options;
    struct measure_temporal m = {.spp = o->spp,
                                 .repeat = o->repeat,
                                 .taps = o->taps,
                                 .photons = {o->photons}};
    memcpy(m.photons + 1, o->more_photons, sizeof o->more_photons);
    bool named = !reel->options->to_file ||
                 (m.csv_path = naming_beside(reel->options, ".flicker.csv",
                                             &reel->arena));
    if (!named)
        brume_fail(&err, BRUME_ERR_MEMORY, "out of memory");
    enum brume_code code = named ? measure_temporal_run(&m, reel)
                                 : reel_fail(reel, &err);
    if (!code)
        reel->events->flickered(reel->events->user, &m);
    return code;
}

static bool act_on(struct reel *reel, const struct parse_result *scene,
                   int number, struct brume_error *err)
{
    switch (reel->options->action) {
    case OPTIONS_EXPLAIN:
    case OPTIONS_EXPLAIN_JSON:
        return explain(reel, scene, number, err);
    case OPTIONS_MEASURE:
        return measure(reel, scene, number, err);
    default:
        return true;
    }
}

enum brume_code reel_read(struct reel *reel, struct reel_record *record,
                          struct parse_result *scene,
                          struct parse_origins *origins)
{
    const struct reel_events *events = reel->events;
    struct diag diag;
    diag_init(&diag);
    bool ok = read_scene(reel, record->number, scene, record, origins, &diag);
    enum brume_code code = ok ? BRUME_OK : diag.code;
    if (code != BRUME_STOPPED)
        report(reel, &diag);
    diag_release(&diag);
    if (!ok || !events->stopped(events->user))
        return code;
    brume_scene_free(scene->scene);
    scene->scene = NULL;
    return BRUME_STOPPED;
}

static enum brume_code run_frame(struct reel *reel, int number)
{
    const struct reel_events *events = reel->events;
    struct reel_record record = {.number = number};
    struct parse_result scene = {0};
    struct brume_error err = {0};
    events->frame(events->user, &reel->frames, number);
    enum brume_code code = reel_read(reel, &record, &scene, NULL);
    if (!code && !act_on(reel, &scene, number, &err))
        code = reel_fail(reel, &err);
    brume_scene_free(scene.scene);
    return code;
}

/* ---- all frames -------------------------------------------------------- */

static enum brume_code run_frames(struct reel *reel)
{
    const struct reel_events *events = reel->events;
    const struct frames *f = &reel->frames;
    for (int i = f->first;; i += f->step) {
        enum brume_code code = run_frame(reel, i);
        bool more = checks(reel->options->action) && f->last - i >= f->step;
        bool stopped = (more || code) && events->stopped(events->user);
        if (code || stopped || !more)
            return stopped ? BRUME_STOPPED : code;
    }
}

enum brume_code reel_run(struct reel *reel, struct options *options,
                         const struct reel_events *events)
{
    struct brume_error err = {0};
    *reel = (struct reel){.options = options, .events = events};
    arena_init(&reel->arena, 0);
    if (!begin(reel, &err))
        return events->stopped(events->user) ? BRUME_STOPPED
                                             : reel_fail(reel, &err);
    if (reel->frames.none)
        return BRUME_OK;
    switch (options->action) {
    case OPTIONS_RENDER:
        return reel_film(reel);
    case OPTIONS_MEASURE_TEMPORAL:
        return measure_temporal(reel);
    default:
        return run_frames(reel);
    }
}

void reel_release(struct reel *reel)
{
    parse_written_release(&reel->written);
    brume_still_free(reel->still);
    parse_cache_free(reel->cache);
    manifest_close(reel->manifest);
    partial_free(reel->partials);
    arena_release(&reel->arena);
}
