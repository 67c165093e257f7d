/* One medium, that may glow, among simple surfaces and meshes. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_EMISSION | MAY_SKY | MAY_FIELD |          \
     MAY_COLORS | MAY_BALLS)
#define HD_INLINE __forceinline__
#define LINES_STAGE lines_lit
#include "core/cuda/lines_kernel.cuh"
