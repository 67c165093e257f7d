/* team.h - threads that share a work: those of a warp on a GPU, or one alone.
 * All of a team come to each of these calls together. */
#ifndef CORE_PHYSICS_TEAM_H
#define CORE_PHYSICS_TEAM_H
#include "core/physics/hd.h"

/* A thread's place in its team. */
typedef struct {
    int place, size;        /* 0 and 1, or 0 to 31 and 32                  */
} team;

HD team team_alone(void)
{
    team t = {0, 1};
    return t;
}

/* The value of the one at that place. */
HD float team_float(team t, float value, int place)
{
#ifdef __CUDACC__
    if (t.size > 1)
        return __shfl_sync(~0u, value, place);
#endif
    (void)t;
    (void)place;
    return value;
}

/* Whether it is so of any. */
HD bool team_any(team t, bool is)
{
#ifdef __CUDACC__
    if (t.size > 1)
        return __any_sync(~0u, is);
#endif
    (void)t;
    return is;
}

/* The first place of those of which it is so; the team's size if there is
 * none. */
HD int team_first(team t, bool is)
{
#ifdef __CUDACC__
    if (t.size > 1) {
        unsigned all = __ballot_sync(~0u, is);
        return all != 0u ? __ffs(static_cast<int>(all)) - 1 : t.size;
    }
#endif
    return is ? 0 : t.size;
}

/* The sum of all: the same bits for each of them, in whatever run. */
HD double team_sum(team t, double value)
{
#ifdef __CUDACC__
    for (int i = t.size / 2; i > 0; i /= 2)
        value += __shfl_xor_sync(~0u, value, i);
#endif
    (void)t;
    return value;
}

#endif
