#include "lib/stamp.h"
#include <time.h>

bool stamp_is_same(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino &&
           a->st_size == b->st_size && a->st_mtim.tv_sec == b->st_mtim.tv_sec &&
           a->st_mtim.tv_nsec == b->st_mtim.tv_nsec &&
           a->st_ctim.tv_sec == b->st_ctim.tv_sec &&
           a->st_ctim.tv_nsec == b->st_ctim.tv_nsec;
}

static double seconds(const struct timespec *t)
{
    return (double)t->tv_sec + 1e-9 * (double)t->tv_nsec;
}

bool stamp_is_settled(const struct stat *now)
{
    static const double ticks = 0.1;
    struct timespec clock;
    clock_gettime(CLOCK_REALTIME, &clock);
    double latest = seconds(&clock) - ticks;
    return seconds(&now->st_mtim) < latest && seconds(&now->st_ctim) < latest;
}
