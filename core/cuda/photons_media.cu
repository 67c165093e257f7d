/* One gray medium, lit from afar, and nothing else that is seen. */
#define SCENE_MAY (MAY_SKY | MAY_FIELD | MAY_TINTS)
#define HD_INLINE __forceinline__
#define PHOTON_STAGE photons_media
#include "core/cuda/photons_kernel.cuh"
