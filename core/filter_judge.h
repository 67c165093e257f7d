/* filter_judge.h - how far the frames of a film differ from one of them, block
 * by block of 2^3 cells. */
#ifndef CORE_FILTER_JUDGE_H
#define CORE_FILTER_JUDGE_H
#include "core/filter_detail.h"

enum {
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
    float apart;                    /* of its halves, see filter_half.h     */
};

struct filter_judge {
    struct flat *flat;
    struct filter_view view[BRUME_MAX_TAPS];
    int reach, primary;             /* the first of the numbers that count  */
    struct filter_places *places;   /* in each frame, of each brick that is
                                       there; NULL: nothing moves           */
    struct filter_stats *stats[2];  /* of each block of each brick that is
                                       there: where it is, and where it was;
                                       the second NULL: nothing moves       */
    struct filter_common *common[2];    /* of each brick, likewise          */
    float *kept;                    /* cells where they were, of each brick in
                                       each frame; NULL: too many to keep   */
    bool *found;                    /* ... which there are                  */
    bool has[BRUME_MAX_TAPS];       /* the frames that there are            */
    int frames;
};

/* Finds where blocks are in other frames, see filter_path.c; false: no memory.
 */
bool filter_follow(struct filter_judge *judge, int threads,
                   struct filter_scratch *scratch, struct brume_error *err);

/* The cells of the frame at k where the middle one has a brick, or where it
 * was then. */
static inline bool filter_load(const struct filter_judge *judge, int k,
                               bool moved, size_t slot, const int corner[3],
                               struct filter_room *room,
                               struct filter_brick *out)
{
    const struct filter_places *places = moved && k != FILTER_MIDDLE
                                      ? judge->places + slot * BRUME_MAX_TAPS +
                                            (size_t)k
                                      : NULL;
    return filter_view_brick(&judge->view[k], corner, places, room, out);
}

static inline size_t filter_kept_at(size_t slot, int k)
{
    return slot * BRUME_MAX_TAPS + (size_t)k;
}

static inline float *filter_kept(const struct filter_judge *judge, size_t slot,
                                 int k)
{
    return judge->kept + filter_kept_at(slot, k) * FILTER_CELLS *
                             (size_t)judge->flat->view.field.numbers;
}

/* The same again, after filter_judge; where `there` is not asked for. */
static inline const float *filter_again(const struct filter_judge *judge,
                                        int k, bool moved, size_t slot,
                                        const int corner[3],
                                        struct filter_room *room)
{
    struct filter_brick brick;
    if (moved && k != FILTER_MIDDLE && judge->kept)
        return judge->found[filter_kept_at(slot, k)]
                   ? filter_kept(judge, slot, k)
                   : NULL;
    return filter_load(judge, k, moved, slot, corner, room, &brick)
               ? brick.cells
               : NULL;
}

/* Fills the stats, places, and what is kept, which are of the scratch; false:
 * no memory. */
bool filter_judge(struct filter_judge *judge, int threads,
                  struct filter_scratch *scratch, struct brume_error *err);

/* The place in the list above of the frame at `k`, FILTER_MIDDLE the middle
 * one's. */
static inline int filter_other(int k)
{
    return k < FILTER_MIDDLE ? FILTER_MIDDLE - k - 1 : k - 1;
}
#endif
