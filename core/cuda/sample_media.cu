/* One medium, lit from afar, and nothing else that is seen. */
#define SCENE_MAY (MAY_SKY | MAY_FIELD | MAY_COLORS | MAY_BALLS | MAY_SINGLE)
#define HD_INLINE __forceinline__
#define SAMPLE_STAGE sample_media
#include "core/cuda/sample_kernel.cuh"
