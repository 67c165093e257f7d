/* filter_judge.h - how far the frames of a film differ from one of them, block
 * by block of 2^3 cells. */
#ifndef CORE_FILTER_JUDGE_H
#define CORE_FILTER_JUDGE_H
#include "core/filter_view.h"

enum {
    FILTER_BLOCKS = 64,                     /* of a brick                  */
    FILTER_OTHERS = 2 * BRUME_MAX_REACH,    /* frames besides the middle   */
    FILTER_MIDDLE = BRUME_MAX_REACH         /* its place among all         */
};

/* Sums over cells; of the frames m before and after the middle one in places
 * m - 1 and BRUME_MAX_REACH + m - 1. Nothing but floats, all of which are
 * added up over a block's surroundings. */
struct filter_stats {
    float shift[3][FILTER_OTHERS];  /* middle frame less that one, channels */
    float differ[FILTER_OTHERS];    /* squares of that                      */
    float count[FILTER_OTHERS];     /* cells that both have                 */
    float pair[BRUME_MAX_REACH];    /* squares: less the mean of the frames
                                       before and after                     */
    float pairs[BRUME_MAX_REACH];   /* cells that all three have            */
    float mean[3], cells;           /* of the middle frame                  */
};

struct filter_judge {
    struct flat *flat;
    struct filter_view view[BRUME_MAX_TAPS];
    int reach, primary;             /* the first of the numbers that count  */
    struct filter_stats *stats;     /* of each block of each brick that is
                                       there                                */
};

/* Fills the stats; false: no memory. */
bool filter_judge(struct filter_judge *judge, int threads,
                  struct brume_error *err);

/* The place in the list above of the frame at `k`, FILTER_MIDDLE the middle
 * one's. */
static inline int filter_other(int k)
{
    return k < FILTER_MIDDLE ? FILTER_MIDDLE - k - 1 : k - 1;
}
#endif
