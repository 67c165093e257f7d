/* filter_detail.h - how fast the detail of a film's field changes.
 *
 * Noise has nothing in common from frame to frame: the mean product of what two
 * frames have above the mean of a brick is the energy of the detail that both
 * have. How that falls with their distance, and so how much of the detail a
 * mean over frames loses, shows over the whole field where it is far below the
 * noise of any cell. */
#ifndef CORE_FILTER_DETAIL_H
#define CORE_FILTER_DETAIL_H
#include "core/filter_view.h"

/* A brick's blocks of 2^3 cells in all frames. */
struct filter_detail {
    float block[BRUME_MAX_TAPS][FILTER_BLOCKS];
    float there[FILTER_BLOCKS];     /* 1: in all frames so far              */
    int frames;
};

void filter_detail_begin(struct filter_detail *detail);
/* The brick in the next frame at k: three numbers a cell, and for each block
 * 1 or 0, whether it is there. */
void filter_detail_add(struct filter_detail *detail, int k, const float *color,
                       const float there[FILTER_BLOCKS]);

enum { FILTER_PAIRS = BRUME_MAX_TAPS * (BRUME_MAX_TAPS - 1) / 2 };

/* Sums over a brick's blocks of what each two frames have, in the order of the
 * first, then the second. */
struct filter_common {
    float pair[FILTER_PAIRS];
};

/* 0 for a brick that is not there in all `frames` that `has` tells of. */
void filter_detail_sum(struct filter_detail *detail,
                       const bool has[BRUME_MAX_TAPS], int frames,
                       struct filter_common *out);

/* The part of the detail that a frame of distance 1 to BRUME_MAX_REACH lacks;
 * frames count by their weights. */
void filter_detail_fit(const struct filter_common *brick, size_t bricks,
                       const double weight[BRUME_MAX_TAPS],
                       float lost[BRUME_MAX_REACH + 1]);

/* Changes weights of sum 1 so that they lose no more of the detail than they
 * may, least noise for what was most precise; some can become negative. */
void filter_detail_keep(const float lost[BRUME_MAX_REACH + 1],
                        float weight[BRUME_MAX_TAPS]);
#endif
