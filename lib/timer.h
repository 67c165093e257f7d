/* timer.h - seconds of a clock that never steps back, from some fixed point. */
#ifndef LIB_TIMER_H
#define LIB_TIMER_H
#include <time.h>

static inline double timer_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
#endif
