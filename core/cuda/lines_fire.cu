/* As lines_media.cu, and the medium glows. */
#define SCENE_MAY (MAY_EMISSION | MAY_SKY | MAY_FIELD | MAY_BALLS)
#define HD_INLINE __forceinline__
#define LINES_STAGE lines_fire
#include "core/cuda/lines_kernel.cuh"
