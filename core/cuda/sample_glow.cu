/* As sample_media.cu, and the medium glows. */
#define SCENE_MAY                                                              \
    (MAY_EMISSION | MAY_SKY | MAY_FIELD | MAY_COLORS | MAY_BALLS | MAY_SINGLE)
#define HD_INLINE __forceinline__
#define SAMPLE_STAGE sample_glow
#include "core/cuda/sample_kernel.cuh"
