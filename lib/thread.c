#include "lib/thread.h"
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

/* A loop. Threads that have nothing to do join it while it has places. */
struct loop {
    atomic_size_t next; /* the index that nobody has taken yet         */
    size_t count;
    parallel_body *body;
    void *context;
    const atomic_bool *cancel;
    int threads, joined; /* at most, and so far: the next one's number  */
    int inside;          /* beside the caller                           */
    struct loop *after;  /* of those that are open                      */
};

/* Threads that were started once stay and wait: to start them anew costs a
 * loop of a millisecond as much again. */
static struct {
    pthread_mutex_t lock;
    pthread_cond_t opened, left; /* a loop, by a thread                  */
    struct loop *open;
    int workers;
    bool forks; /* what a fork needs is known                            */
} pool = {PTHREAD_MUTEX_INITIALIZER,
          PTHREAD_COND_INITIALIZER,
          PTHREAD_COND_INITIALIZER,
          NULL,
          0,
          false};

int thread_processors(void)
{
    /* A mask of the usual size is refused on machines with more processors
     * than it has bits, so larger ones are tried. */
    for (int bits = 1024; bits <= 1 << 20; bits *= 4) {
        cpu_set_t *set = CPU_ALLOC(bits);
        if (!set)
            break;
        size_t size = CPU_ALLOC_SIZE(bits);
        int count = sched_getaffinity(0, size, set) == 0
                        ? CPU_COUNT_S(size, set)
                        : 0;
        CPU_FREE(set);
        if (count > 0)
            return count;
    }
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

static bool is_over(struct loop *loop)
{
    return atomic_load(&loop->next) >= loop->count ||
           (loop->cancel && atomic_load(loop->cancel));
}

static void run(struct loop *loop, int number)
{
    while (!is_over(loop)) {
        size_t index = atomic_fetch_add(&loop->next, 1);
        if (index < loop->count)
            loop->body(loop->context, index, number);
    }
}

static struct loop *find_open(void)
{
    struct loop *loop = pool.open;
    while (loop && (loop->joined == loop->threads || is_over(loop)))
        loop = loop->after;
    return loop;
}

static void *work(void *nothing)
{
    pthread_mutex_lock(&pool.lock);
    for (;;) {
        struct loop *loop = find_open();
        if (!loop) {
            pthread_cond_wait(&pool.opened, &pool.lock);
            continue;
        }
        int number = loop->joined++;
        loop->inside++;
        pthread_mutex_unlock(&pool.lock);
        run(loop, number);
        pthread_mutex_lock(&pool.lock);
        if (--loop->inside == 0)
            pthread_cond_broadcast(&pool.left);
    }
    return nothing;
}

/* A child process has none of the threads, and starts its own. */
static void before_fork(void)
{
    pthread_mutex_lock(&pool.lock);
}

static void after_fork(void)
{
    pthread_mutex_unlock(&pool.lock);
}

static void begin_child(void)
{
    pthread_mutex_init(&pool.lock, NULL);
    pthread_cond_init(&pool.opened, NULL);
    pthread_cond_init(&pool.left, NULL);
    pool.open = NULL;
    pool.workers = 0;
}

int thread_begin(pthread_t *thread, void *(*run)(void *), void *context)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    int reason = pthread_create(thread, NULL, run, context);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return reason;
}

/* Starts the threads that are missing, as far as the system lets it. */
static void start_workers(int count)
{
    pthread_t thread;
    if (pool.workers >= count)
        return;
    pool.forks = pool.forks ||
                 pthread_atfork(before_fork, after_fork, begin_child) == 0;
    while (pool.workers < count && thread_begin(&thread, work, NULL) == 0) {
        pthread_detach(thread);
        pool.workers++;
    }
}

static void open_loop(struct loop *loop)
{
    pthread_mutex_lock(&pool.lock);
    start_workers(loop->threads - 1);
    loop->after = pool.open;
    pool.open = loop;
    pthread_cond_broadcast(&pool.opened);
    pthread_mutex_unlock(&pool.lock);
}

static void close_loop(struct loop *loop)
{
    pthread_mutex_lock(&pool.lock);
    struct loop **place = &pool.open;
    while (*place != loop)
        place = &(*place)->after;
    *place = loop->after;
    while (loop->inside > 0)
        pthread_cond_wait(&pool.left, &pool.lock);
    pthread_mutex_unlock(&pool.lock);
}

bool parallel_for(int threads, size_t count, parallel_body *body, void *context,
                  const atomic_bool *cancel)
{
    if (threads <= 0)
        threads = thread_processors();
    if ((size_t)threads > count)
        threads = (int)count;
    struct loop loop = {.count = count,
                        .body = body,
                        .context = context,
                        .cancel = cancel,
                        .threads = threads,
                        .joined = 1};
    atomic_init(&loop.next, 0);
    if (threads > 1)
        open_loop(&loop);
    run(&loop, 0);
    if (threads > 1)
        close_loop(&loop);
    return atomic_load(&loop.next) >= count;
}
