/* As photons_lit.cu, and the medium glows. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_EMISSION | MAY_SKY | MAY_LAMPS | MAY_FIELD)
#define HD_INLINE __forceinline__
#define PHOTON_STAGE photons_fire
#include "core/cuda/photons_kernel.cuh"
