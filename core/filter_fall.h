/* filter_fall.h - how much of the detail the frames of a film lack that are so
 * far from one. */
#ifndef CORE_FILTER_FALL_H
#define CORE_FILTER_FALL_H
#include "core/filter_detail.h"

/* Kinds of bricks, the brightest first, by their noise. */
enum { FILTER_KINDS = 4 };

struct filter_kinds {
    int top, of[32];
};

/* Frames count by their weights, here and below. */
void filter_fall_sort(const struct filter_common *brick, size_t bricks,
                      const double weight[BRUME_MAX_TAPS],
                      struct filter_kinds *kinds);
int filter_kind(const struct filter_kinds *kinds,
                const struct filter_common *brick);

/* The part of the detail that a frame of distance 0 to BRUME_MAX_REACH lacks,
 * of all bricks and of those of a kind; energies of the kinds' detail and
 * noise. */
struct filter_falls {
    float all[BRUME_MAX_REACH + 1], lost[FILTER_KINDS][BRUME_MAX_REACH + 1];
    double energy[FILTER_KINDS], noise[FILTER_KINDS];
};

void filter_fall_fit(const struct filter_common *brick, size_t bricks,
                     const double weight[BRUME_MAX_TAPS],
                     const struct filter_kinds *kinds,
                     struct filter_falls *out);
#endif
