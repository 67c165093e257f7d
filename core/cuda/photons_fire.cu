/* As photons_lit.cu, and the medium may glow and have colours. */
#define SCENE_MAY                                                              \
    (MAY_MESHES | MAY_SURFACES | MAY_EMISSION | MAY_SKY | MAY_LAMPS |          \
     MAY_FIELD | MAY_COLORS | MAY_BALLS | MAY_TINTS)
#define HD_INLINE __forceinline__
#define PHOTON_STAGE photons_fire
#include "core/cuda/photons_kernel.cuh"
