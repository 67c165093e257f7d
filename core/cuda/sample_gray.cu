/* One gray medium, lit from afar by lights alone, and nothing else. */
#define SCENE_MAY 0
#define HD_INLINE __forceinline__
#define SAMPLE_STAGE sample_gray
#include "core/cuda/sample_kernel.cuh"
