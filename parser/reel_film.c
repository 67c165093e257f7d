/* The film: scenes are read ahead of the picture that is rendered, as far as
 * its filter reaches; pictures are written behind it, beside the reading. */
#include "lib/hash.h"
#include "lib/memory.h"
#include "parser/naming.h"
#include "parser/origins.h"
#include "parser/reel_parts.h"
#include "parser/reel_write.h"
#include "parser/settings.h"
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* A frame whose scene was read and handed over. */
struct reading {
    struct reel_record record;
    struct parse_origins origins;
    bool picture; /* wanted                                      */
    int reach;
};

/* A picture that was asked for. */
struct order {
    struct reel_record record;
    struct parse_origins origins; /* of all frames within its reach      */
};

/* At most, see orders_ahead. */
enum { MOST_ORDERS = 2 * BRUME_MAX_WORKERS + 1 };

struct film_run {
    struct reel *reel;
    struct brume_film *film;
    struct reading *reading;
    size_t readings, room;
    struct order order[MOST_ORDERS];
    int orders;
    struct order written; /* whose picture is being written             */
    struct reel_write write;
    bool writes;
    int workers; /* 0: not known yet                            */
};

/* ---- pictures that are written ------------------------------------------- */

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

/* Whether the files are still those that the picture was made of; it would be
 * taken for one of what they hold now. */
static bool knows_files(struct reel *reel, const struct reel_record *record,
                        const struct parse_origins *origins)
{
    char text[512];
    const char *changed = origins_changed(origins);
    if (changed) {
        snprintf(text, sizeof text,
                 "'%s' has changed since '%s' was begun: --resume will render "
                 "it again",
                 changed, record->picture);
        reel_warn(reel, text);
    }
    return !changed && !origins->incomplete;
}

static bool note_picture(struct reel *reel, const struct reel_record *record,
                         const struct parse_origins *origins,
                         struct brume_error *err)
{
    if (!reel->manifest)
        return true;
    struct manifest_entry entry = {
        .number = record->number,
        .clock_on = record->clock_on,
        .clock = record->clock,
        .picture = record->picture,
        .settings = settings_of(reel, record->number),
        .origins = origins,
        .known = knows_files(reel, record, origins),
        .writes = reel->written.count > 0,
        .stats = &record->stats,
        .seconds = all_seconds(record),
    };
    return manifest_add(reel->manifest, &entry, err);
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
        reel_warn(reel, text);
    }
}

/* ---- pictures that are finished ---------------------------------------- */

/* Whether the picture is there already, as this run would make it. */
static bool is_finished(const struct reel *reel,
                        const struct reel_record *record, bool *writes)
{
    return reel->manifest && reel->options->resume &&
           manifest_has(reel->manifest, record->number,
                        settings_of(reel, record->number), record->picture,
                        writes);
}

/* Whether this run renders a frame of the film. */
static bool is_ours(const struct reel *reel, int number)
{
    const struct frames *f = &reel->frames;
    return number >= f->first && number <= f->last &&
           (number - f->first) % f->step == 0;
}

static bool name_picture(struct reel *reel, struct reel_record *record,
                         struct brume_error *err)
{
    if (!reel->options->to_file || reel->sink)
        return true;
    record->picture = naming_picture(reel->options, &reel->frames,
                                     record->number, &reel->arena);
    return record->picture ||
           brume_fail(err, BRUME_ERR_MEMORY, "out of memory");
}

/* ---- reading ----------------------------------------------------------- */

static struct reading *find_reading(const struct film_run *run, int number)
{
    for (size_t i = 0; i < run->readings; i++)
        if (run->reading[i].record.number == number)
            return &run->reading[i];
    return NULL;
}

static struct reading *new_reading(struct film_run *run, int number,
                                   struct brume_error *err)
{
    struct reading *grown = memory_grow(run->reading, &run->room,
                                        run->readings + 1, sizeof *grown, err);
    if (!grown)
        return NULL;
    run->reading = grown;
    struct reading *reading = &grown[run->readings++];
    *reading = (struct reading){.record.number = number};
    return reading;
}

/* A worker for each GPU that the first frame can use, or as many as the user
 * says. */
static bool choose_workers(struct film_run *run,
                           const struct brume_options *options,
                           struct brume_error *err)
{
    const struct options *o = run->reel->options;
    char why[256];
    int devices = brume_film_devices(options, why, sizeof why);
    if (o->gpus != 0 && devices == 0)
        return brume_fail(err, BRUME_ERR_DEVICE,
                          "--gpus: no GPU can be used: %s", why);
    if (o->gpus > devices)
        return brume_fail(err, BRUME_ERR_DEVICE, "--gpus %d: there %s %d GPU%s",
                          o->gpus, devices == 1 ? "is" : "are", devices,
                          devices == 1 ? "" : "s");
    run->workers = o->gpus > 0 ? o->gpus : devices > 0 ? devices : 1;
    if (run->workers > BRUME_MAX_WORKERS)
        run->workers = BRUME_MAX_WORKERS;
    return brume_film_workers(run->film, run->workers, err);
}

/* The device is started while the first scene is read: of the options only
 * those of the command line are known yet. */
static void begin_device(struct film_run *run)
{
    const struct parse_result none = {0};
    struct brume_options options = reel_options(run->reel, 0, &none);
    brume_film_begin(run->film, &options);
}

/* Reads a frame's scene and hands it over. */
static enum brume_code read_frame(struct film_run *run, struct reading *reading)
{
    struct reel *reel = run->reel;
    struct parse_result scene = {0};
    struct brume_error err = {0};
    if (run->workers == 0)
        begin_device(run);
    enum brume_code code = reel_read(reel, &reading->record, &scene,
                                     &reading->origins);
    if (code)
        return code;
    struct brume_options options = reel_options(reel, reading->record.number,
                                                &scene);
    if (reel->sink)
        reel->sink->adjust(reel->sink->user, &options);
    reading->reach = brume_film_reach(&options);
    if (run->workers == 0 && !choose_workers(run, &options, &err)) {
        brume_scene_free(scene.scene);
        return reel_fail(reel, &err);
    }
    if (brume_film_push(run->film, scene.scene, &options, reading->picture,
                        &err))
        return BRUME_OK;
    return reel_fail(reel, &err);
}

/* Makes sure that a frame was read; *reading is NULL where neither its picture
 * nor (`needed`) its field is wanted. */
static enum brume_code take_frame(struct film_run *run, int number, bool needed,
                                  struct reading **reading)
{
    struct reel *reel = run->reel;
    struct brume_error err = {0};
    struct reel_record record = {.number = number};
    bool writes = false;
    *reading = find_reading(run, number);
    if (*reading)
        return BRUME_OK;
    if (!name_picture(reel, &record, &err))
        return reel_fail(reel, &err);
    bool ours = is_ours(reel, number);
    bool finished = ours && is_finished(reel, &record, &writes);
    if (!needed && finished && !writes)
        return BRUME_OK;
    *reading = new_reading(run, number, &err);
    if (!*reading)
        return reel_fail(reel, &err);
    (*reading)->record = record;
    (*reading)->picture = ours && !finished;
    return read_frame(run, *reading);
}

/* What lies below a frame is needed no more. */
static bool forget_below(struct film_run *run, int64_t number,
                         struct brume_error *err)
{
    size_t kept = 0;
    for (size_t i = 0; i < run->readings; i++) {
        if (run->reading[i].record.number >= number)
            run->reading[kept++] = run->reading[i];
        else
            parse_origins_release(&run->reading[i].origins);
    }
    run->readings = kept;
    return brume_film_forget(run->film, number > 0 ? (uint32_t)number : 0, err);
}

/* ---- orders ------------------------------------------------------------ */

static void end_order(struct film_run *run, struct order *order, bool good)
{
    if (run->reel->partials)
        partial_end(run->reel->partials, (uint32_t)order->record.number, !good);
    parse_origins_release(&order->origins);
}

/* Waits for the picture that is being written, if there is one. */
static enum brume_code finish_writing(struct film_run *run)
{
    struct reel *reel = run->reel;
    struct order *order = &run->written;
    struct reel_record *record = &order->record;
    struct brume_error *err = &run->write.err;
    if (!run->writes)
        return BRUME_OK;
    run->writes = false;
    bool good = reel_write_end(&run->write) &&
                note_picture(reel, record, &order->origins, err) &&
                keep_record(reel, record, err);
    if (good)
        reel->events->finished(reel->events->user, record);
    end_order(run, order, good);
    return good ? BRUME_OK : reel_fail(reel, err);
}

static void begin_writing(struct film_run *run, const struct order *order,
                          const struct brume_frame *frame)
{
    run->written = *order;
    run->write = (struct reel_write){
        .reel = run->reel, .record = &run->written.record, .frame = *frame};
    run->writes = true;
    reel_write_begin(&run->write);
}

/* Waits for an order's picture, and sends it where it goes. */
static bool take_picture(struct film_run *run, struct order *order,
                         struct brume_error *err)
{
    struct reel *reel = run->reel;
    const struct reel_sink *sink = reel->sink;
    struct brume_frame frame = {0};
    if (!brume_film_next(run->film, &frame, err))
        return false;
    order->record.stats = frame.stats;
    warn_of_samples(reel, &frame.stats);
    if (!sink) {
        begin_writing(run, order, &frame);
        return true;
    }
    bool good = sink->take(sink->user, order->record.number, &frame, err);
    brume_frame_free(&frame);
    return good;
}

/* Waits for the picture of the first order, and for that which is written. */
static enum brume_code finish_order(struct film_run *run)
{
    const struct reel_events *events = run->reel->events;
    struct brume_error err = {0};
    enum brume_code code = finish_writing(run);
    if (code)
        return code;
    if (events->stopped(events->user))
        return BRUME_STOPPED;
    struct order order = run->order[0];
    run->orders--;
    memmove(run->order, run->order + 1,
            (size_t)run->orders * sizeof *run->order);
    events->frame(events->user, &run->reel->frames, order.record.number);
    bool good = take_picture(run, &order, &err);
    if (!run->writes)
        end_order(run, &order, good);
    return good ? BRUME_OK : reel_fail(run->reel, &err);
}

static bool add_order(struct film_run *run, const struct reading *reading,
                      struct brume_error *err)
{
    const struct frames *f = &run->reel->frames;
    struct order *order = &run->order[run->orders];
    int number = reading->record.number;
    *order = (struct order){.record = reading->record};
    for (size_t i = 0; i < run->readings; i++)
        if (abs(run->reading[i].record.number - number) <= reading->reach)
            origins_merge(&order->origins, &run->reading[i].origins);
    run->orders++;
    if (run->reel->partials && order->record.picture)
        partial_begin(run->reel->partials, (uint32_t)number,
                      order->record.picture, settings_of(run->reel, number),
                      &order->origins, run->reel->options->resume);
    return brume_film_ask(run->film, (uint32_t)number, (uint32_t)f->initial,
                          (uint32_t)f->final, err);
}

/* ---- the film ---------------------------------------------------------- */

/* Reads the frames within reach of one. */
static enum brume_code take_neighbours(struct film_run *run, int number,
                                       int reach)
{
    const struct frames *f = &run->reel->frames;
    enum brume_code code = BRUME_OK;
    struct reading *neighbour;
    for (int k = -reach; !code && k <= reach; k++)
        if (number + k >= f->initial && number + k <= f->final)
            code = take_frame(run, number + k, true, &neighbour);
    return code;
}

static enum brume_code leave_out(struct reel *reel, int number)
{
    struct brume_error err = {0};
    struct reel_record record = {.number = number};
    if (!name_picture(reel, &record, &err))
        return reel_fail(reel, &err);
    reel->skipped++;
    reel->events->skipped(reel->events->user, record.picture);
    return BRUME_OK;
}

/* Pictures asked for beside the one that is waited for: for each that is
 * rendered one that is prepared, and where fields are filtered one more, whose
 * field is traced before the picture of the one before. */
static int orders_ahead(const struct film_run *run, int reach)
{
    return reach > 0 ? 2 * run->workers : run->workers;
}

static enum brume_code run_frame(struct film_run *run, int number)
{
    struct reel *reel = run->reel;
    struct brume_error err = {0};
    struct reading *reading;
    enum brume_code code = take_frame(run, number, false, &reading);
    if (code)
        return code;
    if (!reading || !reading->picture)
        return leave_out(reel, number);
    int reach = reading->reach;
    code = take_neighbours(run, number, reach);
    if (code)
        return code;
    if (!add_order(run, find_reading(run, number), &err) ||
        !forget_below(run, (int64_t)number + reel->frames.step - reach, &err))
        return reel_fail(reel, &err);
    return run->orders <= orders_ahead(run, reach) ? BRUME_OK
                                                   : finish_order(run);
}

/* What was asked for before a frame that failed is finished. */
static enum brume_code finish_orders(struct film_run *run, enum brume_code code)
{
    while (run->orders > 0 && code != BRUME_STOPPED) {
        enum brume_code now = finish_order(run);
        if (now && code)
            break;
        code = code ? code : now;
    }
    enum brume_code last = finish_writing(run);
    return code ? code : last;
}

static enum brume_code run_frames(struct film_run *run)
{
    const struct frames *f = &run->reel->frames;
    enum brume_code code = BRUME_OK;
    for (int64_t i = f->first; !code && i <= f->last; i += f->step)
        code = run_frame(run, (int)i);
    return finish_orders(run, code);
}

static void release(struct film_run *run)
{
    brume_film_free(run->film);
    for (size_t i = 0; i < run->readings; i++)
        parse_origins_release(&run->reading[i].origins);
    for (int i = 0; i < run->orders; i++)
        parse_origins_release(&run->order[i].origins);
    free(run->reading);
}

static bool on_progress(void *user, const struct brume_progress *progress)
{
    const struct reel_events *events = ((struct reel *)user)->events;
    events->progress(events->user, progress);
    return !events->stopped(events->user);
}

enum brume_code reel_film(struct reel *reel)
{
    const struct brume_film_events events = {reel, on_progress, reel_warn};
    struct brume_error err = {0};
    struct film_run run = {.reel = reel};
    run.film = brume_film_new(&events, &err);
    if (!run.film)
        return reel_fail(reel, &err);
    enum brume_code code = run_frames(&run);
    release(&run);
    return code;
}
