/* In light of any colours. */
#define SCENE_MAY (MAY_FIELD | MAY_TINTS)
#define HD_INLINE __forceinline__
#define LONE_STAGE lone_tints
#include "core/cuda/lone_kernel.cuh"
