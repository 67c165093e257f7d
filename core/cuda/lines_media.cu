/* One gray medium, and nothing else that is seen. */
#define SCENE_MAY (MAY_SKY | MAY_FIELD | MAY_BALLS)
#define HD_INLINE __forceinline__
#define LINES_STAGE lines_media
#include "core/cuda/lines_kernel.cuh"
