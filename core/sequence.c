/* The frames of a film: what is handed over and asked for becomes steps, which
 * are taken by workers, one for each device. A worker has threads for what is
 * done before a frame is on the device, there, and between: while one frame is
 * rendered, the next is prepared and its field filtered. What a step needs is
 * done before it, by whichever thread: the pictures are the same however many
 * there are. They tell what they warn of and how far they are by way of the
 * caller's. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "core/shot.h"
#include "lib/memory.h"
#include "lib/thread.h"

/* The first three are those of a frame that is pushed, the next two of a
 * picture that is asked for. */
enum step {
    STEP_PREPARE,
    STEP_TRACE,
    STEP_KEEP,
    STEP_FILTER,
    STEP_RENDER,
    STEP_FORGET
};

struct result {
    struct result *next;
    struct brume_frame frame;
    struct brume_error err;
    bool ready;
};

struct task {
    struct task *next;
    enum step step, end; /* the next, and the last of it          */
    bool running;
    struct shot *shot;            /* that is pushed, until it is prepared  */
    struct result *result;        /* of what is asked for                  */
    uint32_t number, first, last; /* frames                                */
};

struct text {
    struct text *next;
    char text[];
};

/* A thread, or what one would do that could not be started. */
struct lane {
    struct worker *worker;
    unsigned steps;   /* bits                                  */
    pthread_t thread; /* of all but a worker's first           */
    struct filter_scratch scratch;
};

enum { LANES = 3 };

struct worker {
    struct brume_film *film;
    pthread_t thread;          /* of the first lane                        */
    struct lane lane[LANES];   /* the first is the device's                */
    int number;                /* also of its device                       */
    struct brume_still *still; /* of all but the first, who have that
                                  of the options; it lies on the device,
                                  and so is freed by the first lane        */
};

struct brume_film {
    struct brume_film_events events;
    struct worker *worker;
    int workers, wanted;
    bool serial; /* a worker has one thread                      */
    struct brume_options first; /* of the first frame: which backend      */
    struct brume_options early; /* the starter's                          */
    pthread_t starter;          /* starts the first device, if `begun`    */
    bool begun;
    struct shots shots;
    pthread_mutex_t lock; /* of what follows, up to `stop`                */
    pthread_cond_t work, news;
    struct task *task;     /* first to do; those that run too              */
    struct result *result; /* in the order of what was asked for           */
    struct text *warning;
    struct brume_progress progress;
    bool quit;
    int asked; /* pictures that next() has yet to give         */
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

/* ---- steps -------------------------------------------------------------- */

/* Whether a task waits for one that stands before it: a frame's steps are in
 * order, a filter needs all that was traced, and what is forgotten must not be
 * in use. */
static bool waits_for(const struct task *task, const struct task *t)
{
    if (task->step == STEP_FORGET)
        return true;
    if (t->step == STEP_FORGET)
        return task->number < t->number;
    bool fills = t->step <= STEP_KEEP;
    return task->number == t->number || (task->step == STEP_FILTER && fills);
}

static bool may_begin(const struct brume_film *film, const struct task *task)
{
    for (const struct task *t = film->task; t != task; t = t->next)
        if (waits_for(task, t))
            return false;
    return true;
}

/* The first that may begin; but fields go before pictures, so that they are
 * filtered while a picture is rendered. */
static struct task *next_task(const struct brume_film *film, unsigned steps)
{
    struct task *found = NULL;
    for (struct task *t = film->task; t; t = t->next) {
        if (t->running || !(steps >> t->step & 1) || !may_begin(film, t))
            continue;
        if (t->step == STEP_TRACE)
            return t;
        found = found ? found : t;
    }
    return found;
}

static void render(struct worker *worker, struct shot *shot,
                   const struct task *task)
{
    struct result *result = task->result;
    if (result->err.code)
        return;
    if (!shot) {
        brume_fail(&result->err, BRUME_ERR_USAGE, "frame %lu was not pushed",
                   (unsigned long)task->number);
        return;
    }
    if (shot_render(&worker->film->shots, shot, worker->still, &result->err)) {
        result->frame = shot->out;
        result->frame.stats.worker = worker->number;
        memset(&shot->out, 0, sizeof shot->out);
    }
    shot_close(&worker->film->shots, shot);
}

static struct shot *take_shot(struct task *task)
{
    struct shot *shot = task->shot;
    task->shot = NULL;
    return shot;
}

static void do_step(struct lane *lane, struct task *task)
{
    struct worker *worker = lane->worker;
    struct shots *shots = &worker->film->shots;
    if (task->step == STEP_PREPARE)
        shots_add(shots, take_shot(task));
    struct shot *shot = shots_find(shots, task->number);
    switch (task->step) {
    case STEP_PREPARE:
        shot_prepare(shots, shot, worker->still);
        break;
    case STEP_TRACE:
        shot_trace(shots, shot, worker->still);
        break;
    case STEP_KEEP:
        shot_keep(shots, shot);
        break;
    case STEP_FILTER:
        if (shot)
            shot_filter(shots, shot, task->first, task->last, &lane->scratch,
                        &task->result->err);
        break;
    case STEP_RENDER:
        render(worker, shot, task);
        break;
    case STEP_FORGET:
        shots_forget(shots, task->number);
        break;
    }
}

static void take_off(struct brume_film *film, struct task *task)
{
    struct task **at = &film->task;
    while (*at != task)
        at = &(*at)->next;
    *at = task->next;
}

/* Others may wait for it, or for what comes next of the task. */
static void finish_step(struct brume_film *film, struct task *task)
{
    bool last = task->step == task->end;
    pthread_cond_broadcast(&film->work);
    task->running = false;
    if (!last) {
        task->step++;
        return;
    }
    take_off(film, task);
    if (task->result) {
        task->result->ready = true;
        pthread_cond_signal(&film->news);
    }
    free(task);
}

/* ---- workers ------------------------------------------------------------ */

static void work(struct lane *lane)
{
    struct brume_film *film = lane->worker->film;
    pthread_mutex_lock(&film->lock);
    while (!film->quit) {
        struct task *task = next_task(film, lane->steps);
        if (!task) {
            pthread_cond_wait(&film->work, &film->lock);
            continue;
        }
        task->running = true;
        pthread_mutex_unlock(&film->lock);
        do_step(lane, task);
        pthread_mutex_lock(&film->lock);
        finish_step(film, task);
    }
    pthread_mutex_unlock(&film->lock);
    filter_scratch_release(&lane->scratch);
}

static void *run_lane(void *lane)
{
    work(lane);
    return NULL;
}

/* The first lane's thread, which starts the others. What these can't do it
 * does itself. */
static void *run_worker(void *context)
{
    static const unsigned steps[LANES] = {
        1u << STEP_TRACE | 1u << STEP_RENDER,
        1u << STEP_PREPARE,
        1u << STEP_KEEP | 1u << STEP_FILTER | 1u << STEP_FORGET,
    };
    struct worker *worker = context;
    struct lane *first = worker->lane;
    int lanes = 1;
    for (int i = 0; i < LANES; i++)
        worker->lane[i] = (struct lane){.worker = worker, .steps = steps[i]};
    while (lanes < LANES && !worker->film->serial &&
           pthread_create(&worker->lane[lanes].thread, NULL, run_lane,
                          &worker->lane[lanes]) == 0)
        lanes++;
    for (int i = lanes; i < LANES; i++)
        first->steps |= steps[i];
    backend_use_device(&worker->film->first, worker->number);
    work(first);
    for (int i = 1; i < lanes; i++)
        pthread_join(worker->lane[i].thread, NULL);
    brume_still_free(worker->still);
    return NULL;
}

static bool start_one(struct brume_film *film, struct brume_error *err)
{
    struct worker *worker = &film->worker[film->workers];
    *worker = (struct worker){.film = film, .number = film->workers};
    if (film->workers > 0 && !(worker->still = brume_still_new(err)))
        return false;
    int reason = thread_begin(&worker->thread, run_worker, worker);
    film->workers += reason == 0;
    if (reason == 0)
        return true;
    brume_still_free(worker->still);
    return brume_fail(err, BRUME_ERR_MEMORY,
                      "the thread that renders can't be started: %s",
                      strerror(reason));
}

static bool start(struct brume_film *film, const struct brume_options *first,
                  struct brume_error *err)
{
    int count = film->wanted;
    film->serial = brume_film_in_turn(first->threads, first->memory);
    film->first = *first;
    film->worker = memory_new((size_t)count, sizeof *film->worker, err);
    bool good = film->worker;
    while (good && film->workers < count)
        good = start_one(film, err);
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
    shots_init(&film->shots);
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

/* One that was not begun. */
static void free_task(struct brume_film *film, struct task *task)
{
    if (task->shot)
        shot_free(&film->shots, task->shot);
    free(task);
}

static void *run_starter(void *film)
{
    backend_use_device(&((struct brume_film *)film)->early, 0);
    return NULL;
}

void brume_film_begin(struct brume_film *film,
                      const struct brume_options *options)
{
    if (film->begun || film->workers > 0)
        return;
    film->early = *options;
    film->begun = thread_begin(&film->starter, run_starter, film) == 0;
}

static void stop_workers(struct brume_film *film)
{
    if (film->begun)
        pthread_join(film->starter, NULL);
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
    shots_release(&film->shots);
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
    pthread_cond_broadcast(&film->work);
    pthread_mutex_unlock(&film->lock);
}

bool brume_film_push(struct brume_film *film, brume_scene *scene,
                     const struct brume_options *options, bool picture,
                     struct brume_error *err)
{
    struct task *task = memory_new(1, sizeof *task, err);
    struct shot *shot = memory_new(1, sizeof *shot, err);
    if (!task || !shot || (film->workers == 0 && !start(film, options, err))) {
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
    task->step = STEP_PREPARE;
    task->end = brume_film_reach(options) > 0 ? STEP_KEEP : STEP_PREPARE;
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
    *task = (struct task){.step = STEP_FILTER,
                          .end = STEP_RENDER,
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
    task->step = task->end = STEP_FORGET;
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
