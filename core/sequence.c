/* The frames of a film: what is handed over and asked for is done by workers,
 * a thread for each device, which tell what they warn of and how far they are
 * by way of the caller's. What a task needs is done before it, by whichever
 * worker: the pictures are the same however many there are. */
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "core/filter.h"
#include "core/frame.h"
#include "lib/memory.h"
#include "lib/timer.h"

/* A frame that was pushed. */
struct shot {
    struct shot *next;
    uint32_t number;
    brume_scene *scene; /* until it is prepared                        */
    struct brume_options options;
    struct brume_still *still; /* of its options as they were given    */
    bool picture;              /* will be asked for                    */
    bool open;                 /* the job is                           */
    struct frame_job job;
    struct brume_frame out;
    bool traced; /* the field below is there                    */
    struct filter_field field;
    struct brume_error err; /* what it failed by                           */
};

enum task_kind { TASK_PUSH, TASK_ASK, TASK_FORGET };

struct result {
    struct result *next;
    struct brume_frame frame;
    struct brume_error err;
    bool ready;
};

struct task {
    struct task *next;
    enum task_kind kind;
    bool running;
    struct shot *shot;            /* that is pushed                        */
    struct result *result;        /* of what is asked for                  */
    uint32_t number, first, last; /* frames                                */
};

struct text {
    struct text *next;
    char text[];
};

struct worker {
    struct brume_film *film;
    pthread_t thread;
    int number;                /* also of its device                   */
    struct brume_still *still; /* of all but the first, who have that
                                  of the options; it lies on the device,
                                  and so is freed by the worker        */
    struct filter_scratch *scratch;
};

struct brume_film {
    struct brume_film_events events;
    struct worker *worker;
    int workers, wanted;
    pthread_mutex_t lock; /* of what follows, up to `stop`               */
    pthread_cond_t work, news;
    struct task *task;     /* first to do; those that run too             */
    struct result *result; /* in the order of what was asked for      */
    struct text *warning;
    struct brume_progress progress;
    bool quit;
    int asked; /* pictures that next() has yet to give            */
    struct shot *shot;
    uint64_t ring; /* bytes of the fields of all shots            */
    atomic_bool stop;
};

/* Items of these lists begin with their link. */
static void append(void *list, void *item)
{
    void **at = list;
    while (*at)
        at = (void **)*at;
    *(void **)item = NULL;
    *at = item;
}

static void *take_first(void *list)
{
    void **at = list, *first = *at;
    if (first)
        *at = *(void **)first;
    return first;
}

/* ---- what the thread tells ---------------------------------------------- */

/* Wakes nobody: it is looked at every tenth of a second (wait_for_news), and
 * a row of a small picture takes less time than to wake another thread. */
static bool on_progress(void *user, const struct brume_progress *progress)
{
    struct brume_film *film = user;
    pthread_mutex_lock(&film->lock);
    film->progress = *progress;
    pthread_mutex_unlock(&film->lock);
    return !atomic_load(&film->stop);
}

static void on_warn(void *user, const char *text)
{
    struct brume_film *film = user;
    size_t size = strlen(text) + 1;
    struct text *warning = malloc(sizeof *warning + size);
    if (!warning)
        return;
    memcpy(warning->text, text, size);
    pthread_mutex_lock(&film->lock);
    append(&film->warning, warning);
    pthread_cond_signal(&film->news);
    pthread_mutex_unlock(&film->lock);
}

/* ---- shots -------------------------------------------------------------- */

/* The list changes; what is on it stays until it is forgotten. */
static struct shot *find_shot(struct brume_film *film, uint32_t number)
{
    pthread_mutex_lock(&film->lock);
    struct shot *shot = film->shot;
    while (shot && shot->number != number)
        shot = shot->next;
    pthread_mutex_unlock(&film->lock);
    return shot;
}

static void close_job(struct shot *shot)
{
    if (shot->open)
        frame_close(&shot->job);
    shot->open = false;
    brume_scene_free(shot->scene);
    shot->scene = NULL;
}

static void free_shot(struct brume_film *film, struct shot *shot)
{
    close_job(shot);
    if (shot->traced) {
        __atomic_fetch_sub(&film->ring, filter_bytes(&shot->field),
                           __ATOMIC_RELAXED);
        filter_release(&shot->field);
    }
    brume_frame_free(&shot->out);
    free(shot);
}

/* A frame whose scene has no field has none to keep. */
static bool keep_field(struct brume_film *film, struct shot *shot)
{
    struct frame_job *job = &shot->job;
    if (!plan_stages(job->flat, &shot->options).photons)
        return true;
    job->held = __atomic_load_n(&film->ring, __ATOMIC_RELAXED);
    if (!frame_trace(job, &shot->err) ||
        !filter_keep(job->flat, job->power, &shot->field, &shot->err))
        return false;
    shot->traced = true;
    __atomic_fetch_add(&film->ring, filter_bytes(&shot->field),
                       __ATOMIC_RELAXED);
    return true;
}

/* What stays on a device stays on that of the worker who looks for it. */
static void use_still(const struct worker *worker, struct shot *shot)
{
    if (shot->still)
        shot->options.still = worker->still ? worker->still : shot->still;
}

static bool open_job(const struct worker *worker, struct shot *shot)
{
    shot->open = true;
    use_still(worker, shot);
    bool good = frame_open(&shot->job, shot->scene, &shot->options, &shot->out,
                           &shot->err);
    brume_scene_free(shot->scene);
    shot->scene = NULL;
    return good;
}

/* Where no filter is asked for, nothing is done before the picture is. */
static void push(const struct worker *worker, struct shot *shot)
{
    struct brume_film *film = worker->film;
    pthread_mutex_lock(&film->lock);
    append(&film->shot, shot);
    pthread_mutex_unlock(&film->lock);
    if (brume_film_reach(&shot->options) == 0)
        return;
    if (!open_job(worker, shot) || !keep_field(film, shot) || !shot->picture)
        close_job(shot);
}

static void forget(struct brume_film *film, uint32_t below)
{
    struct shot *gone = NULL;
    pthread_mutex_lock(&film->lock);
    struct shot **at = &film->shot;
    while (*at) {
        struct shot *shot = *at;
        if (shot->number >= below) {
            at = &shot->next;
            continue;
        }
        *at = shot->next;
        shot->next = gone;
        gone = shot;
    }
    pthread_mutex_unlock(&film->lock);
    while (gone) {
        struct shot *next = gone->next;
        free_shot(film, gone);
        gone = next;
    }
}

/* ---- pictures ----------------------------------------------------------- */

/* The fields within reach; false with err set where a frame failed. */
static bool list_fields(struct brume_film *film, const struct task *task,
                        int reach, const struct filter_field **fields,
                        struct brume_error *err)
{
    for (int k = -reach; k <= reach; k++) {
        int64_t number = (int64_t)task->number + k;
        fields[k + reach] = NULL;
        if (number < task->first || number > task->last)
            continue;
        const struct shot *shot = find_shot(film, (uint32_t)number);
        if (!shot)
            return brume_fail(err, BRUME_ERR_USAGE,
                              "frame %lld, which is within the reach of frame "
                              "%lu, was not pushed",
                              (long long)number, (unsigned long)task->number);
        if (shot->err.code) {
            *err = shot->err;
            return false;
        }
        if (shot->traced)
            fields[k + reach] = &shot->field;
    }
    return true;
}

static bool run_filter(const struct worker *worker, struct shot *shot,
                       const struct filter_field *const *fields, int reach,
                       struct brume_error *err)
{
    const struct brume_options *o = &shot->options;
    if (o->photons.adaptive)
        return filter_adapt(shot->job.flat, fields, reach, o->threads,
                            worker->scratch, err);
    return filter_mean(shot->job.flat, fields, o->photons.weight, reach,
                       o->threads, err);
}

static bool filter_shot(const struct worker *worker, const struct task *task,
                        struct shot *shot, struct brume_error *err)
{
    struct brume_film *film = worker->film;
    const struct filter_field *fields[BRUME_MAX_TAPS];
    int reach = brume_film_reach(&shot->options);
    struct brume_photon_stats *stats = &shot->out.stats.photons;
    double start = timer_seconds();
    if (!list_fields(film, task, reach, fields, err))
        return false;
    if (!run_filter(worker, shot, fields, reach, err))
        return false;
    stats->ring = shot->job.held = __atomic_load_n(&film->ring,
                                                   __ATOMIC_RELAXED);
    stats->drifts = shot->field.drift != NULL;
    stats->seconds_filter = timer_seconds() - start;
    return true;
}

static bool render_shot(const struct worker *worker, const struct task *task,
                        struct shot *shot, struct brume_error *err)
{
    if (!shot)
        return brume_fail(err, BRUME_ERR_USAGE, "frame %lu was not pushed",
                          (unsigned long)task->number);
    if (!shot->err.code && !shot->open && !shot->scene)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "frame %lu was pushed without a picture, or has had "
                          "its own",
                          (unsigned long)task->number);
    if (!shot->err.code && !shot->open)
        open_job(worker, shot);
    if (shot->err.code) {
        *err = shot->err;
        return false;
    }
    use_still(worker, shot);
    return (!shot->traced || filter_shot(worker, task, shot, err)) &&
           frame_render(&shot->job, shot->traced, err);
}

static void make_picture(const struct worker *worker, const struct task *task)
{
    struct result *result = task->result;
    struct shot *shot = find_shot(worker->film, task->number);
    if (render_shot(worker, task, shot, &result->err)) {
        result->frame = shot->out;
        result->frame.stats.worker = worker->number;
        memset(&shot->out, 0, sizeof shot->out);
    }
    if (shot)
        close_job(shot);
}

/* ---- workers ------------------------------------------------------------ */

/* Whether what stands before a task lets it begin: a picture needs what was
 * pushed before it, and what is forgotten must not be in use. */
static bool may_begin(const struct brume_film *film, const struct task *task)
{
    for (const struct task *t = film->task; t != task; t = t->next) {
        bool above = t->kind == TASK_FORGET && task->kind != TASK_FORGET &&
                     task->number >= t->number;
        if (task->kind == TASK_FORGET ||
            (task->kind == TASK_ASK && t->kind == TASK_PUSH) ||
            (t->kind == TASK_FORGET && !above))
            return false;
    }
    return true;
}

static struct task *next_task(const struct brume_film *film)
{
    struct task *task = film->task;
    while (task && (task->running || !may_begin(film, task)))
        task = task->next;
    return task;
}

static void do_task(const struct worker *worker, struct task *task)
{
    switch (task->kind) {
    case TASK_PUSH:
        push(worker, task->shot);
        break;
    case TASK_FORGET:
        forget(worker->film, task->number);
        break;
    case TASK_ASK:
        make_picture(worker, task);
        break;
    }
}

/* Takes a task that is done off the list; others may wait for it. */
static void finish_task(struct brume_film *film, struct task *task)
{
    void *at = &film->task;
    while (*(void **)at != task)
        at = *(void **)at;
    *(void **)at = task->next;
    if (task->result) {
        task->result->ready = true;
        pthread_cond_signal(&film->news);
    }
    pthread_cond_broadcast(&film->work);
    free(task);
}

static void *run(void *context)
{
    struct worker *worker = context;
    struct brume_film *film = worker->film;
    struct task *task = NULL;
    struct filter_scratch scratch = {.desk = NULL};
    worker->scratch = &scratch;
    frame_use_device(worker->number);
    pthread_mutex_lock(&film->lock);
    while (!film->quit) {
        task = next_task(film);
        if (!task) {
            pthread_cond_wait(&film->work, &film->lock);
            continue;
        }
        task->running = true;
        pthread_mutex_unlock(&film->lock);
        do_task(worker, task);
        pthread_mutex_lock(&film->lock);
        finish_task(film, task);
    }
    pthread_mutex_unlock(&film->lock);
    filter_scratch_release(&scratch);
    brume_still_free(worker->still);
    return NULL;
}

static bool start_one(struct brume_film *film, struct brume_error *err)
{
    struct worker *worker = &film->worker[film->workers];
    *worker = (struct worker){.film = film, .number = film->workers};
    if (film->workers > 0 && !(worker->still = brume_still_new(err)))
        return false;
    int reason = pthread_create(&worker->thread, NULL, run, worker);
    film->workers += reason == 0;
    if (reason == 0)
        return true;
    brume_still_free(worker->still);
    return brume_fail(err, BRUME_ERR_MEMORY,
                      "the thread that renders can't be started: %s",
                      strerror(reason));
}

/* Signals are for the caller's thread. */
static bool start(struct brume_film *film, struct brume_error *err)
{
    sigset_t all, before;
    int count = film->wanted;
    film->worker = memory_new((size_t)count, sizeof *film->worker, err);
    bool good = film->worker;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (good && film->workers < count)
        good = start_one(film, err);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return good;
}

/* ---- for the caller ----------------------------------------------------- */

struct brume_film *brume_film_new(const struct brume_film_events *events,
                                  struct brume_error *err)
{
    struct brume_film *film = memory_new(1, sizeof *film, err);
    if (!film)
        return NULL;
    if (events)
        film->events = *events;
    film->wanted = 1;
    pthread_mutex_init(&film->lock, NULL);
    pthread_cond_init(&film->work, NULL);
    pthread_cond_init(&film->news, NULL);
    return film;
}

bool brume_film_workers(struct brume_film *film, int count,
                        struct brume_error *err)
{
    if (count < 1 || count > BRUME_MAX_WORKERS)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "a film of %d workers; it has 1 to %d", count,
                          BRUME_MAX_WORKERS);
    if (film->workers > 0)
        return brume_fail(err, BRUME_ERR_USAGE,
                          "the film's workers have begun already");
    film->wanted = count;
    return true;
}

static void free_task(struct brume_film *film, struct task *task)
{
    if (task->shot)
        free_shot(film, task->shot);
    free(task);
}

static void stop_workers(struct brume_film *film)
{
    atomic_store(&film->stop, true);
    pthread_mutex_lock(&film->lock);
    film->quit = true;
    pthread_cond_broadcast(&film->work);
    pthread_mutex_unlock(&film->lock);
    for (int i = 0; i < film->workers; i++)
        pthread_join(film->worker[i].thread, NULL);
    free(film->worker);
}

void brume_film_free(struct brume_film *film)
{
    void *item;
    if (!film)
        return;
    stop_workers(film);
    while ((item = take_first(&film->task)))
        free_task(film, item);
    while ((item = take_first(&film->shot)))
        free_shot(film, item);
    while ((item = take_first(&film->warning)))
        free(item);
    while ((item = take_first(&film->result))) {
        brume_frame_free(&((struct result *)item)->frame);
        free(item);
    }
    pthread_cond_destroy(&film->news);
    pthread_cond_destroy(&film->work);
    pthread_mutex_destroy(&film->lock);
    free(film);
}

/* Cha, Yi and Ihm 2010. */
bool brume_film_taps(struct brume_photon_options *options, int taps)
{
    static const double weights[][5] = {
        {1.0},
        {0.25, 0.5, 0.25},
        {0.1, 0.2, 0.4, 0.2, 0.1},
    };
    if (taps != 1 && taps != 3 && taps != 5)
        return false;
    memcpy(options->weight, weights[taps / 2],
           (size_t)taps * sizeof *options->weight);
    options->taps = taps;
    options->adaptive = false;
    return true;
}

int brume_film_reach(const struct brume_options *options)
{
    int taps = options->photons.taps;
    bool filters = options->integrator == BRUME_INTEGRATOR_PHOTON && taps > 1;
    return filters ? taps / 2 : 0;
}

static void put(struct brume_film *film, struct task *task)
{
    pthread_mutex_lock(&film->lock);
    append(&film->task, task);
    if (task->result) {
        append(&film->result, task->result);
        film->asked++;
    }
    pthread_cond_signal(&film->work);
    pthread_mutex_unlock(&film->lock);
}

bool brume_film_push(struct brume_film *film, brume_scene *scene,
                     const struct brume_options *options, bool picture,
                     struct brume_error *err)
{
    struct task *task = memory_new(1, sizeof *task, err);
    struct shot *shot = memory_new(1, sizeof *shot, err);
    if (!task || !shot || (film->workers == 0 && !start(film, err))) {
        brume_scene_free(scene);
        free(task);
        free(shot);
        return false;
    }
    shot->number = options->frame;
    shot->scene = scene;
    shot->picture = picture;
    shot->options = *options;
    shot->still = options->still;
    shot->options.progress = on_progress;
    shot->options.warn = on_warn;
    shot->options.user = film;
    task->kind = TASK_PUSH;
    task->number = shot->number;
    task->shot = shot;
    put(film, task);
    return true;
}

bool brume_film_ask(struct brume_film *film, uint32_t frame, uint32_t first,
                    uint32_t last, struct brume_error *err)
{
    struct task *task = memory_new(1, sizeof *task, err);
    struct result *result = memory_new(1, sizeof *result, err);
    if (!task || !result) {
        free(task);
        free(result);
        return false;
    }
    *task = (struct task){.kind = TASK_ASK,
                          .number = frame,
                          .first = first,
                          .last = last,
                          .result = result};
    put(film, task);
    return true;
}

bool brume_film_forget(struct brume_film *film, uint32_t below,
                       struct brume_error *err)
{
    struct task *task = memory_new(1, sizeof *task, err);
    if (!task)
        return false;
    task->kind = TASK_FORGET;
    task->number = below;
    put(film, task);
    return true;
}

/* Waits a tenth of a second, or less where something is new. */
static void wait_for_news(struct brume_film *film)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += 100000000;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_cond_timedwait(&film->news, &film->lock, &until);
}

static void tell_warning(const struct brume_film *film, struct text *warning)
{
    if (film->events.warn)
        film->events.warn(film->events.user, warning->text);
    free(warning);
}

/* Asked also while a frame is prepared, which tells of no progress. */
static void tell_progress(struct brume_film *film,
                          struct brume_progress progress)
{
    if (!progress.stage)
        progress.stage = "prepare";
    if (film->events.progress &&
        !film->events.progress(film->events.user, &progress))
        atomic_store(&film->stop, true);
}

/* The next result; what is told meanwhile is told without the lock. */
static struct result *wait_for_result(struct brume_film *film)
{
    pthread_mutex_lock(&film->lock);
    for (;;) {
        struct text *warning = take_first(&film->warning);
        bool ready = !warning && film->result && film->result->ready;
        struct result *result = ready ? take_first(&film->result) : NULL;
        if (result) {
            film->asked--;
            memset(&film->progress, 0, sizeof film->progress);
            pthread_mutex_unlock(&film->lock);
            return result;
        }
        if (!warning)
            wait_for_news(film);
        struct brume_progress progress = film->progress;
        bool quiet = (film->result && film->result->ready) || film->warning;
        pthread_mutex_unlock(&film->lock);
        if (warning)
            tell_warning(film, warning);
        else if (!quiet)
            tell_progress(film, progress);
        pthread_mutex_lock(&film->lock);
    }
}

bool brume_film_next(struct brume_film *film, struct brume_frame *frame,
                     struct brume_error *err)
{
    pthread_mutex_lock(&film->lock);
    bool due = film->asked > 0;
    pthread_mutex_unlock(&film->lock);
    memset(frame, 0, sizeof *frame);
    if (!due)
        return brume_fail(err, BRUME_ERR_USAGE, "no picture was asked for");
    struct result *result = wait_for_result(film);
    bool good = result->err.code == BRUME_OK;
    if (good)
        *frame = result->frame;
    else
        *err = result->err;
    free(result);
    return good;
}
