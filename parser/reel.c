#include "parser/reel.h"
#include "lib/hash.h"
#include "lib/timer.h"
#include "parser/input.h"
#include "parser/naming.h"
#include "parser/picture.h"
#include "parser/settings.h"
#include <inttypes.h>
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

/* The code of an error that is told now. */
static enum brume_code fail(const struct reel *reel,
                            const struct brume_error *err)
{
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

static void warn(void *user, const char *text)
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
    warn(reel, text);
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

static bool begin(struct reel *reel, struct brume_error *err)
{
    frames_init(&reel->frames, reel->options);
    if (!choose_part(reel, err) ||
        !frames_region(reel->options, reel->region, err) ||
        !find_scene(reel, err) || !find_folders(reel, err) ||
        !open_manifest(reel, err))
        return false;
    warn_of_extension(reel);
    if (reel->options->tree == BRUME_TREE_BOTH)
        reel->still = brume_still_new(err);
    return reel->options->tree != BRUME_TREE_BOTH || reel->still;
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
        .all_errors = checks(options->action),
        .dry = checks(options->action),
        .library = reel->library,
        .libraries = reel->libraries,
        .allow_read = options->allow_read.item,
        .allow_reads = options->allow_read.count,
        .allow_write = reel->allow_write,
        .allow_writes = reel->allow_writes,
        .written = &reel->written,
        .origins = reel->manifest ? origins : NULL,
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
    record->number = number;
    record->clock = in.ambient.clock;
    record->clock_on = in.ambient.clock_on;
    double start = timer_seconds();
    bool ok = parse_scene(&in, result, diag);
    record->seconds_parse = timer_seconds() - start;
    return ok;
}

static struct brume_options render_options(struct reel *reel, int number,
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
    r.still = reel->still;
    r.threads = o->threads;
    r.seed = o->seed;
    r.frame = (uint32_t)number;
    r.memory = o->memory;
    r.photons = scene->photons;
    if (o->photons > 0)
        r.photons.count = o->photons;
    if (o->preset) {
        r.photons.gather = BRUME_GATHER_BALL;
        r.photons.single = BRUME_SINGLE_FIELD;
        r.photons.emission = BRUME_EMISSION_PHOTONS;
    }
    r.progress = on_progress;
    r.warn = warn;
    r.user = reel;
    r.omit_background = o->alpha;
    return r;
}

/* What an EXR says of itself: nothing that differs from run to run. */
enum { TEXTS = 6, TEXT_SIZE = 64 };

static size_t describe(const struct reel *reel, const struct reel_record *r,
                       struct exr_text text[TEXTS],
                       char value[TEXTS][TEXT_SIZE])
{
    size_t count = 0;
    const char *slash = strrchr(reel->options->input, '/');
    text[count++] = (struct exr_text){"software", "Brume " BRUME_VERSION};
    text[count++] = (struct exr_text){
        "scene",
        slash ? slash + 1 : reel->options->input,
    };
    if (reel->frames.animation) {
        snprintf(value[count], TEXT_SIZE, "%d", r->number);
        text[count] = (struct exr_text){"frame", value[count]};
        count++;
    }
    if (r->clock_on) {
        snprintf(value[count], TEXT_SIZE, "%.17g", r->clock);
        text[count] = (struct exr_text){"clock", value[count]};
        count++;
    }
    snprintf(value[count], TEXT_SIZE, "%d", r->stats.spp);
    text[count] = (struct exr_text){"samplesPerPixel", value[count]};
    count++;
    snprintf(value[count], TEXT_SIZE, "%.6g", r->stats.error);
    text[count] = (struct exr_text){"relativeError", value[count]};
    return count + 1;
}

static bool write_frame(struct reel *reel, const struct brume_frame *frame,
                        struct reel_record *record, struct brume_error *err)
{
    const struct options *options = reel->options;
    struct exr_text text[TEXTS];
    char value[TEXTS][TEXT_SIZE];
    struct picture picture = {
        .frame = frame,
        .format = naming_format(options),
        .bits = options->bits,
        .alpha = options->alpha,
        .text = text,
        .texts = describe(reel, record, text, value),
    };
    if (!options->to_file)
        return true;
    double start = timer_seconds();
    bool ok = picture_write(&picture, record->picture, reel->events->out, err);
    record->seconds_write = timer_seconds() - start;
    return ok;
}

static double all_seconds(const struct reel_record *r)
{
    return r->seconds_parse + r->stats.seconds_prepare +
           r->stats.seconds_render + r->seconds_write;
}

/* A scene from a stream is no file that could be looked at. */
static uint64_t settings_of(const struct reel *reel, int number)
{
    uint64_t hash = settings_hash(reel->options, &reel->frames, number);
    return reel->text ? hash_bytes(hash, reel->text, reel->length) : hash;
}

static bool note_picture(const struct reel *reel,
                         const struct reel_record *record,
                         const struct parse_origins *origins,
                         struct brume_error *err)
{
    struct manifest_entry entry = {
        .number = record->number,
        .clock_on = record->clock_on,
        .clock = record->clock,
        .picture = record->picture,
        .settings = settings_of(reel, record->number),
        .origins = origins,
        .writes = reel->written.count > 0,
        .stats = &record->stats,
        .seconds = all_seconds(record),
    };
    return !reel->manifest || manifest_add(reel->manifest, &entry, err);
}

static bool keep_record(struct reel *reel, const struct reel_record *record,
                        struct brume_error *err)
{
    void *records = reel->record;
    if (!arena_grow(&reel->arena, &records, &reel->room, reel->records + 1,
                    sizeof *record))
        return brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
    reel->record = records;
    reel->record[reel->records++] = *record;
    return true;
}

static void warn_of_samples(struct reel *reel, const struct brume_stats *stats)
{
    char text[160];
    if (stats->rejected > 0) {
        snprintf(text, sizeof text,
                 "%" PRIu64 " samples were not finite and "
                 "were left out",
                 stats->rejected);
        warn(reel, text);
    }
    if (stats->majorant_exceeded > 0) {
        snprintf(text, sizeof text,
                 "a density was above its bound %" PRIu64
                 " times: the picture may be wrong",
                 stats->majorant_exceeded);
        warn(reel, text);
    }
}

static bool render(struct reel *reel, const struct parse_result *scene,
                   struct reel_record *record,
                   const struct parse_origins *origins, struct brume_error *err)
{
    struct brume_options options = render_options(reel, record->number, scene);
    struct brume_frame frame = {0};
    if (!brume_render(scene->scene, &options, &frame, err))
        return false;
    record->stats = frame.stats;
    warn_of_samples(reel, &frame.stats);
    bool ok = write_frame(reel, &frame, record, err) &&
              note_picture(reel, record, origins, err) &&
              keep_record(reel, record, err);
    brume_frame_free(&frame);
    if (ok)
        reel->events->finished(reel->events->user, record);
    return ok;
}

static bool explain(struct reel *reel, const struct parse_result *scene,
                    int number, struct brume_error *err)
{
    struct brume_options options = render_options(reel, number, scene);
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
        .options = render_options(reel, number, scene),
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

static bool act_on(struct reel *reel, const struct parse_result *scene,
                   struct reel_record *record,
                   const struct parse_origins *origins, struct brume_error *err)
{
    switch (reel->options->action) {
    case OPTIONS_RENDER:
        return render(reel, scene, record, origins, err);
    case OPTIONS_EXPLAIN:
    case OPTIONS_EXPLAIN_JSON:
        return explain(reel, scene, record->number, err);
    case OPTIONS_MEASURE:
        return measure(reel, scene, record->number, err);
    default:
        return true;
    }
}

/* Reads the scene; `act`: and does with it what is asked for. */
static enum brume_code read_and_act(struct reel *reel,
                                    struct reel_record *record, bool act)
{
    const struct reel_events *events = reel->events;
    struct parse_result scene = {0};
    struct parse_origins origins = {0};
    struct brume_error err = {0};
    struct diag diag;
    diag_init(&diag);
    bool ok = read_scene(reel, record->number, &scene, record, &origins, &diag);
    enum brume_code code = ok ? BRUME_OK : diag.code;
    if (code != BRUME_STOPPED)
        report(reel, &diag);
    diag_release(&diag);
    if (ok && events->stopped(events->user))
        code = BRUME_STOPPED;
    else if (ok && act && !act_on(reel, &scene, record, &origins, &err))
        code = err.code == BRUME_STOPPED ? BRUME_STOPPED : fail(reel, &err);
    if (scene.scene)
        brume_scene_free(scene.scene);
    parse_origins_release(&origins);
    return code;
}

/* Whether the picture is there already, as this run would make it. */
static bool is_finished(const struct reel *reel,
                        const struct reel_record *record, bool *writes)
{
    const struct options *o = reel->options;
    return reel->manifest && o->resume &&
           manifest_has(reel->manifest, record->number,
                        settings_of(reel, record->number), record->picture,
                        writes);
}

static enum brume_code run_frame(struct reel *reel, int number)
{
    const struct reel_events *events = reel->events;
    const struct options *o = reel->options;
    struct reel_record record = {.number = number};
    bool writes = false;
    events->frame(events->user, &reel->frames, number);
    if (o->to_file && o->action == OPTIONS_RENDER) {
        record.picture = naming_picture(o, &reel->frames, number, &reel->arena);
        if (!record.picture)
            return fail(reel, &(struct brume_error){.code = BRUME_ERR_MEMORY,
                                                    .text = "out of memory"});
    }
    if (!is_finished(reel, &record, &writes))
        return read_and_act(reel, &record, true);
    reel->skipped++;
    events->skipped(events->user, record.picture);
    return writes ? read_and_act(reel, &record, false) : BRUME_OK;
}

/* ---- the film ---------------------------------------------------------- */

static bool goes_on(const struct reel *reel)
{
    enum options_action action = reel->options->action;
    return action == OPTIONS_RENDER || checks(action);
}

enum brume_code reel_run(struct reel *reel, struct options *options,
                         const struct reel_events *events)
{
    struct brume_error err = {0};
    *reel = (struct reel){.options = options, .events = events};
    arena_init(&reel->arena, 0);
    if (!begin(reel, &err))
        return events->stopped(events->user) ? BRUME_STOPPED : fail(reel, &err);
    const struct frames *f = &reel->frames;
    if (f->none)
        return BRUME_OK;
    for (int i = f->first;; i += f->step) {
        enum brume_code code = run_frame(reel, i);
        bool more = goes_on(reel) && f->last - i >= f->step;
        bool stopped = (more || code) && events->stopped(events->user);
        if (code || stopped || !more)
            return stopped ? BRUME_STOPPED : code;
    }
}

void reel_release(struct reel *reel)
{
    parse_written_release(&reel->written);
    brume_still_free(reel->still);
    manifest_close(reel->manifest);
    arena_release(&reel->arena);
}
