/* filter_detail.h - how fast the detail of a film's field changes.
 *
 * Noise has nothing in common from frame to frame, nor from one half of a
 * frame's photons to the other: the mean product of what two have above the
 * mean of a brick is the energy of the detail that both have. How that falls
 * with the frames' distance, and so how much of the detail a mean over frames
 * loses, shows over the whole field where it is far below the noise of any
 * cell. */
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

/* Sums over a brick's blocks of what each two frames have in common, in the
 * order of the first, then the second; what the halves of each frame have (of
 * those that are `given`, a bit each), and the mean of their noise. */
struct filter_common {
    float pair[FILTER_PAIRS], own[BRUME_MAX_TAPS];
    float sum[BRUME_MAX_TAPS], whole[BRUME_MAX_TAPS];
    float noise, whole_noise;
    float mean[3], apart;           /* sums of its stats, of the middle     */
    uint32_t given;
    bool counts;                    /* it is there in all frames            */
};

/* Fills the pairs; false for a brick that is not there as a whole in all
 * `frames` that `has` tells of. */
bool filter_detail_sum(struct filter_detail *detail,
                       const bool has[BRUME_MAX_TAPS], int frames,
                       struct filter_common *out);

/* Blocks that lose alike: their energies, mean weights and the mean of their
 * sums of squares; `slope` is filled. */
struct filter_group {
    float lost[BRUME_MAX_REACH + 1], weight[BRUME_MAX_TAPS];
    double energy, noise, variance;
    float slope;
};

/* So that all groups together lose no more of the detail than they may, for the
 * least noise. */
void filter_detail_slopes(struct filter_group *group, int groups);

/* Changes weights of sum 1 accordingly; some can become negative. */
void filter_detail_keep(const float lost[BRUME_MAX_REACH + 1], float slope,
                        float weight[BRUME_MAX_TAPS]);
#endif
