#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cmocka.h>
#include "lib/thread.h"

enum { MANY = 1000, THREADS = 4 };

struct marks {
    atomic_int run[MANY];
    atomic_int busy[THREADS]; /* by each number just now */
    atomic_int wrong;
    atomic_bool cancel;
    size_t last;
};

static void mark(void *context, size_t index, int thread)
{
    struct marks *m = context;
    if (thread < 0 || thread >= THREADS ||
        atomic_fetch_add(&m->busy[thread], 1) != 0)
        atomic_fetch_add(&m->wrong, 1);
    atomic_fetch_add(&m->run[index], 1);
    if (index == m->last)
        atomic_store(&m->cancel, true);
    for (volatile int i = 0; i < 1000; i++)
        ;
    if (thread >= 0 && thread < THREADS)
        atomic_fetch_sub(&m->busy[thread], 1);
}

static bool each_once(const struct marks *m, int before)
{
    for (int i = 0; i < MANY; i++)
        if (atomic_load(&m->run[i]) != (i < before))
            return false;
    return atomic_load(&m->wrong) == 0;
}

static struct marks *clean(struct marks *m)
{
    memset(m, 0, sizeof *m);
    m->last = SIZE_MAX;
    return m;
}

/* A number is never that of two threads at once; also of fewer indices than
 * threads, and of none. */
static void test_thread__each_index_once(void **state)
{
    (void)state;
    static struct marks m;
    const int counts[] = {MANY, 2, 1, 0};
    for (int round = 0; round < 50; round++)
        for (int i = 0; i < 4; i++) {
            clean(&m);
            assert_true(
                parallel_for(THREADS, (size_t)counts[i], mark, &m, NULL));
            assert_true(each_once(&m, counts[i]));
        }
}

/* What began ends, and nothing begins after. */
static void test_thread__cancelled(void **state)
{
    (void)state;
    static struct marks m;
    clean(&m);
    m.last = 10;
    assert_false(parallel_for(THREADS, MANY, mark, &m, &m.cancel));
    int run = 0;
    for (int i = 0; i < MANY; i++)
        run += atomic_load(&m.run[i]);
    assert_in_range(run, 11, 10 + THREADS);
    assert_int_equal(atomic_load(&m.wrong), 0);
}

static void loop_within(void *context, size_t index, int thread)
{
    (void)thread;
    struct marks *m = (struct marks *)context + index;
    parallel_for(THREADS, MANY, mark, m, NULL);
}

static void test_thread__loops_within_loops(void **state)
{
    (void)state;
    static struct marks m[8];
    for (int i = 0; i < 8; i++)
        clean(&m[i]);
    assert_true(parallel_for(THREADS, 8, loop_within, m, NULL));
    for (int i = 0; i < 8; i++)
        assert_true(each_once(&m[i], MANY));
}

static void *loop_again(void *context)
{
    for (int i = 0; i < 50; i++) {
        struct marks *m = clean(context);
        if (!parallel_for(THREADS, MANY, mark, m, NULL) || !each_once(m, MANY))
            return context;
    }
    return NULL;
}

static void test_thread__loops_side_by_side(void **state)
{
    (void)state;
    static struct marks m[3];
    pthread_t thread[3];
    for (int i = 0; i < 3; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, loop_again, &m[i]),
                         0);
    for (int i = 0; i < 3; i++) {
        void *failed;
        pthread_join(thread[i], &failed);
        assert_null(failed);
    }
}

/* How many threads a signal may come to: the caller alone. */
static void ask_signals(void *context, size_t index, int thread)
{
    sigset_t blocked;
    (void)index;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    if ((thread > 0) != (sigismember(&blocked, SIGTERM) == 1))
        atomic_fetch_add((atomic_int *)context, 1);
    usleep(1000);
}

static void test_thread__signals_are_the_callers(void **state)
{
    (void)state;
    atomic_int wrong = 0;
    assert_true(parallel_for(THREADS, 4 * THREADS, ask_signals, &wrong, NULL));
    assert_int_equal(atomic_load(&wrong), 0);
}

static void find_last(void *context, size_t index, int thread)
{
    atomic_int *last = context;
    int before = atomic_load(last);
    (void)index;
    while (before < thread &&
           !atomic_compare_exchange_weak(last, &before, thread))
        ;
    usleep(5000);
}

/* A child process has none of the threads that wait, and starts its own. */
static void test_thread__after_a_fork(void **state)
{
    (void)state;
    atomic_int last = 0;
    int status;
    assert_true(parallel_for(THREADS, 4 * THREADS, find_last, &last, NULL));
    assert_true(atomic_load(&last) > 0);
    pid_t child = fork();
    if (child == 0) {
        alarm(20);
        atomic_store(&last, 0);
        bool all = parallel_for(THREADS, 4 * THREADS, find_last, &last, NULL);
        _exit(all && atomic_load(&last) > 0 ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_thread__each_index_once),
        cmocka_unit_test(test_thread__cancelled),
        cmocka_unit_test(test_thread__loops_within_loops),
        cmocka_unit_test(test_thread__loops_side_by_side),
        cmocka_unit_test(test_thread__signals_are_the_callers),
        cmocka_unit_test(test_thread__after_a_fork),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
