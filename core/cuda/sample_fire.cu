/* As sample_lit.cu, and the medium glows. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_EMISSION | MAY_SKY | MAY_LAMPS |          \
     MAY_FIELD | MAY_COLORS | MAY_BALLS | MAY_SINGLE)
#define HD_INLINE __forceinline__
#define SAMPLE_STAGE sample_fire
#include "core/cuda/sample_kernel.cuh"
