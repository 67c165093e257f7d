/* One medium among simple surfaces and meshes, with lamps. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_SKY | MAY_LAMPS | MAY_FIELD |             \
     MAY_COLORS | MAY_BALLS | MAY_SINGLE)
#define HD_INLINE __forceinline__
#define SAMPLE_STAGE sample_lit
#include "core/cuda/sample_kernel.cuh"
