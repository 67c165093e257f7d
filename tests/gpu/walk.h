/* walk.h - the walks of tests/unit/truth_walk.h on a GPU, where the program has
 * CUDA in it. */
#ifndef TESTS_GPU_WALK_H
#define TESTS_GPU_WALK_H
#include <stddef.h>
#include "core/brume.h"
#include "core/flat.h"

#ifdef __cplusplus
extern "C" {
#endif

struct walk;

/* The means of so many batches of n paths each. All batches are followed
 * together; where that takes too much room, one part of each after another. */
bool walk_on_gpu(const struct walk *w, const struct flat *f, size_t n,
                 int batches, double *mean, struct brume_error *err);

#ifdef __cplusplus
}
#endif
#endif
