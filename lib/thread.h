/* thread.h - one parallel loop over indices, on POSIX threads; a thread.
 *
 * Indices are handed out one by one as threads come free, so which thread
 * runs an index differs from run to run: a body writes only what belongs to
 * its index, and nothing may depend on the thread but scratch memory. */
#ifndef LIB_THREAD_H
#define LIB_THREAD_H
#ifdef __cplusplus
#include <atomic>
using std::atomic_bool;
#else
#include <stdatomic.h>
#endif
#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>

/* Processors that this process may run on (its affinity mask); at least 1. */
int thread_processors(void);

/* `thread` counts from 0 and is below the `threads` of parallel_for. */
typedef void parallel_body(void *context, size_t index, int thread);

/* Runs body for every index in [0, count) on `threads` threads, the caller
 * among them; 0 threads means thread_processors(). Where the system refuses
 * a thread, fewer do the work. Once *cancel is true (it may be NULL) no more
 * indices begin. Returns when all that began have ended: true when every
 * index ran, false when it was cancelled before. */
bool parallel_for(int threads, size_t count, parallel_body *body,
                  void *context, const atomic_bool *cancel);

/* Starts a thread, to be joined. Signals are for the others. 0, or the number
 * of the error with which the system refuses it. */
int thread_begin(pthread_t *thread, void *(*run)(void *), void *context);
#endif
