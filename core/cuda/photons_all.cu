/* Any scene. */
#define SCENE_MAY MAY_ALL
#define PHOTON_STAGE photons_all
#include "core/cuda/photons_kernel.cuh"
