/* One gray medium among simple surfaces and meshes, in a field of balls. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_SKY | MAY_LAMPS | MAY_FIELD | MAY_BALLS | \
     MAY_TINTS)
#define HD_INLINE __forceinline__
#define PHOTON_STAGE photons_balls
#include "core/cuda/photons_kernel.cuh"
