/* One medium and nothing else that is seen. */
#define SCENE_MAY                                                              \
    (MAY_EMISSION | MAY_SKY | MAY_LAMPS | MAY_FIELD | MAY_COLORS | MAY_BALLS | \
     MAY_TINTS)
#define HD_INLINE __forceinline__
#define PHOTON_STAGE photons_colors
#include "core/cuda/photons_kernel.cuh"
