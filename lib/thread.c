#include "lib/thread.h"
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <unistd.h>

struct loop {
    atomic_size_t next; /* the index that nobody has taken yet    */
    size_t count;
    parallel_body *body;
    void *context;
    const atomic_bool *cancel;
};

struct worker {
    pthread_t thread;
    struct loop *loop;
    int number;
};

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

static bool cancelled(const struct loop *loop)
{
    return loop->cancel && atomic_load(loop->cancel);
}

static void *work(void *argument)
{
    struct worker *w = argument;
    struct loop *loop = w->loop;
    while (!cancelled(loop)) {
        size_t index = atomic_fetch_add(&loop->next, 1);
        if (index >= loop->count)
            break;
        loop->body(loop->context, index, w->number);
    }
    return NULL;
}

bool parallel_for(int threads, size_t count, parallel_body *body, void *context,
                  const atomic_bool *cancel)
{
    if (threads <= 0)
        threads = thread_processors();
    if ((size_t)threads > count)
        threads = count > 0 ? (int)count : 1;
    struct loop loop = {
        .count = count, .body = body, .context = context, .cancel = cancel};
    atomic_init(&loop.next, 0);
    struct worker caller = {.loop = &loop, .number = 0};
    struct worker *others = calloc((size_t)threads, sizeof *others);
    int started = 0;
    while (others && started < threads - 1) {
        struct worker *w = &others[started];
        w->loop = &loop;
        w->number = started + 1;
        if (pthread_create(&w->thread, NULL, work, w) != 0)
            break;
        started++;
    }
    work(&caller);
    for (int i = 0; i < started; i++)
        pthread_join(others[i].thread, NULL);
    free(others);
    return atomic_load(&loop.next) >= count;
}
