/* In gray light. */
#define SCENE_MAY MAY_FIELD
#define HD_INLINE __forceinline__
#define LONE_STAGE lone_gray
#include "core/cuda/lone_kernel.cuh"
