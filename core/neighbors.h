/* neighbors.h - how far each of many points is from its k-th nearest. */
#ifndef CORE_NEIGHBORS_H
#define CORE_NEIGHBORS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "core/brume.h"

/* Distances from each point to its k-th nearest other one, to the farthest
 * where there are not so many, 0 where there is none; k is 1 to
 * BRUME_MAX_NEIGHBORS. `at` is x y z of each, finite, below 1e150. Exact: by a
 * kd-tree. */
bool neighbors_distances(const double *at, size_t count, int k, int threads,
                         double *distance, struct brume_error *err);
#endif
